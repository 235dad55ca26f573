// raster.js - the rasterizer a pixel at a time: triangles to drag on 16 x 12 pixels, their edge
// functions, weights and depths at a pixel, and the loops that visit them.  Every number is the
// module's, which has it from shade.h.

const GRID = [16, 12];
const ORDERS = [
    ['for each triangle', '  for each pixel of its box'],
    ['for each pixel', '  for each triangle whose box has it']];
const LOOP = ['    E = three edge functions', '    if all E > 0, or 0 on a top or left edge',
    '      z = depth of the triangle there', '      if z < stored depth',
    '        store z and the colour'];
// name: triangles, each three corners of x, y and w
const SCENES = {
    'Shared edges': [[3.5, 1.5, 3, 3.5, 9.5, 3, 11.5, 9.5, 3], [3.5, 1.5, 3, 11.5, 9.5, 3, 11.5, 1.5, 3]],
    Crossing: [[1, 1, 2, 3, 11, 2, 14, 5, 6], [15, 1, 2, 2, 6.5, 6, 13, 11, 2]],
    Perspective: [[1, 11, 1, 15, 11, 1, 8, 1, 9]],
    Slivers: [[1, 1, 3, 15, 2, 3, 15, 3, 3], [1, 11, 3, 15, 3, 3, 15, 3.5, 3]] };
// how bright a triangle's colour is at its corners (raster_fragment of raster.h), interpolated between them
const BRIGHT = [1.5, 0.7, 0.2];
const INKS = ['E', 'F', 'G'];           // edges are E_0 E_1 E_2; these name their colours

let running = 0, cellFrom = '', rasterSteps = 0;
let tabbed = true;                      // keys belong to a control that was reached by Tab, not to one that was clicked
const triangles = () => Array.from({ length: S.count }, (_, t) => t);
const corners = t => S['t' + (t + 1)];

function tellRaster() {
    const fit = t => corners(t).map((v, i) => i % 3 === 2 ? limit(v, 1, 10) : Math.round(16 * v) / 16);
    const list = [S.count, S.order, ...[0, 1, 2].flatMap(fit)];
    floats(wasm.page_raster(), list.length).set(list);
    rasterSteps = wasm.page_raster_run(0);
    S.cell[1] = Math.min(S.cell[1], GRID[1] - 1);
    S.step = limit(S.step, 0, rasterSteps);
    wasm.page_raster_run(S.step);
}
function askRaster(t, x, y) {
    const names = ['covered', 'edge', 'owns', 'area', 'share', 'weight', 'rw', 'z', 'before',
        'passes', 'after'], answer = {};
    const values = new Float64Array(wasm.memory.buffer, wasm.page_raster_ask(t, x, y), 19);
    let at = 0;
    for (const name of names) {
        const three = ['edge', 'owns', 'share', 'weight'].includes(name);
        answer[name] = three ? Array.from(values.slice(at, at + 3)) : values[at];
        at += three ? 3 : 1;
    }
    return answer;
}
// The step that was made last, as triangle, x and y
function rasterStep() {
    if (!S.step) return null;
    const [t, x, y] = new Int32Array(wasm.memory.buffer, wasm.page_raster_step(S.step - 1), 3);
    return { t, x, y };
}
// The pixel that the numbers are about: the one pointed at, else that of the last step
const rasterCell = () => S.cell[0] >= 0 ? { x: S.cell[0], y: S.cell[1] } : rasterStep();

// ---- the picture --------------------------------------------------------------------------------

function showGrid() {
    const step = rasterStep(), cell = rasterCell(), [width, height] = GRID;
    const pixels = new Uint8Array(wasm.memory.buffer, wasm.page_raster_pixels(), 4 * 192);
    let html = '';
    for (let i = 0; i < 192; i++) {
        const [r, g, b, a] = pixels.slice(4 * i, 4 * i + 4), x = i % width, y = Math.floor(i / width);
        html += `<rect class="pixel" x="${x}" y="${y}" width="1" height="1"` +
            (a ? ` style="fill:rgb(${r},${g},${b})"` : '') + `/>` +
            `<circle class="centre" cx="${x + 0.5}" cy="${y + 0.5}" r=".05"/>`;
    }
    const box = ({ x, y }, css) =>
        `<rect class="${css}" x="${x}" y="${y}" width="1" height="1"/>`;
    if (step) html += box(step, 'now');
    if (S.cell[0] >= 0) html += box(cell, 'asked-cell');
    for (const t of triangles()) {
        const c = corners(t), owns = askRaster(t, 0, 0).owns;
        for (let k = 0; k < 3; k++) {
            const [i, j] = [(k + 1) % 3, (k + 2) % 3], ends = [c[3 * i], c[3 * i + 1], c[3 * j], c[3 * j + 1]];
            html += `<line class="${INKS[k]}${owns[k] ? ' owns' : ''}${t + 1 === S.hand ? ' held' : ''}" ` +
                `x1="${ends[0]}" y1="${ends[1]}" x2="${ends[2]}" y2="${ends[3]}"/>`;
        }
    }
    put($('#pixels'), html);
    for (const node of document.querySelectorAll('#corners .corner')) {
        const [t, k] = [+node.dataset.t, +node.dataset.k], [x, y, w] = corners(t).slice(3 * k, 3 * k + 3);
        node.style.display = t < S.count ? '' : 'none';
        node.setAttribute('transform', `translate(${x} ${y})`);
        node.setAttribute('aria-valuenow', x);
        node.setAttribute('aria-valuetext', `x ${x}, y ${y}, w ${w}`);
        node.classList.toggle('held', t + 1 === S.hand);
    }
}

// ---- the numbers --------------------------------------------------------------------------------

const exactly = v => String(+v.toFixed(4)).replace('-', '−');
const toPlaces = (v, places = 4) => v.toFixed(places).replace(/^(-?)0\./, '$1.').replace('-', '−');
const three = list => list.map(v => toPlaces(v, 3)).join(' ');
// What one addition makes of a value for the next pixel to the right and for the one below: E and z are
// linear on the screen. The module says it of two pixels that differ by one.
function nextPixel(t, { x, y }, of) {
    const [X, Y] = [Math.min(x, GRID[0] - 2), Math.min(y, GRID[1] - 2)], here = of(askRaster(t, X, Y));
    const [right, down] = [of(askRaster(t, X + 1, Y)), of(askRaster(t, X, Y + 1))];
    const sum = v => (v < 0 ? '− ' : '+ ') + toPlaces(Math.abs(v), 4).replace(/0+$/, '').replace(/\.$/, '').replace(/^$/, '0');
    return [here, right, down].some(v => v === null) ? '' : ` <small>→ ${sum(right - here)} ↓ ${sum(down - here)}</small>`;
}
// E of one edge with its numbers; a goes before b where the triangle winds to the right
function edgeFormula(t, k, { x, y }) {
    const c = corners(t), a = askRaster(t, x, y), right = (c[3] - c[0]) * (c[7] - c[1]) - (c[4] - c[1]) * (c[6] - c[0]) > 0;
    const [i, j] = [(k + 1) % 3, (k + 2) % 3].map((v, _, both) => 3 * (right ? v : both[0] + both[1] - v));
    const [X, Y, U, V] = [c[i], c[i + 1], c[j], c[j + 1]].map(short);
    return a.area ? mathml(`E_${k} = (${U} - ${X})(${y + 0.5} - ${Y}) - (${V} - ${Y})(${x + 0.5} - ${X}) = ${short(a.edge[k])}`) : '';
}
const brightness = a => a.weight.reduce((sum, w, k) => sum + w * BRIGHT[k], 0);
function edgeText(a, k, t, cell) {
    const e = a.edge[k], sign = e > 0 ? '+' : e < 0 ? '−' : a.owns[k] ? '0, top or left' : '0, neither top nor left';
    const good = e > 0 || (e === 0 && a.owns[k]);
    return `<td class="${good ? 'in' : 'out'}">${exactly(e)} <small>${good ? 'in' : 'out'}: ${sign}</small>` +
        `${nextPixel(t, cell, a => a.edge[k])}</td>`;
}
function showNumbers() {
    const cell = rasterCell(), step = rasterStep(), asked = S.cell[0] >= 0;
    if (!cell) { put($('#numbers'), '<p>Step, or point at a pixel.</p>'); return; }
    const all = triangles().map(t => askRaster(t, cell.x, cell.y));
    const row = (name, write) => `<tr><th scope="row">${name}</th>${all.map(write).join('')}</tr>`;
    const td = text => `<td>${text}</td>`, covered = write => a => td(a.covered ? write(a) : '–');
    const stands = step && !asked;      // the numbers are of the step just made: its store is behind it
    put($('#numbers'), `<table><caption>Pixel (${cell.x}, ${cell.y}), centre ${cell.x + 0.5}, ` +
        `${cell.y + 0.5}${stands ? `: step ${S.step} is triangle ${step.t + 1}` : ''}</caption><tr><td></td>` +
        all.map((_, t) => `<th scope="col" class="of${t}">Triangle ${t + 1}</th>`).join('') + '</tr>' +
        [0, 1, 2].map(k => row(`<span class="${INKS[k]}">${mathml('E_' + k)}</span>`, (a, t) => edgeText(a, k, t, cell))).join('') +
        row(mathml('E_0 + E_1 + E_2'), a => td(exactly(a.area) + ' <small>twice the area</small>')) +
        row('inside', a => td(a.covered ? '<b>yes</b>' : 'no')) +
        row(mathml('E / \\sum E'), covered(a => three(a.share))) +
        row(mathml('\\alpha\\,\\beta\\,\\gamma'), covered(a => three(a.weight))) +
        row(mathml(`${short(BRIGHT[0])}\\alpha + ${short(BRIGHT[1])}\\beta + ${short(BRIGHT[2])}\\gamma`),
            covered(a => `${toPlaces(brightness(a), 3)} <small>of its colour</small>`)) +
        row(mathml('1 / w'), covered(a => toPlaces(a.rw))) +
        row(mathml('z'), (a, t) => td(a.covered ? toPlaces(a.z) + nextPixel(t, cell, a => a.covered ? a.z : null) : '–')) +
        row('depth before', (a, t) => td(toPlaces(before(a, t)))) +
        row(mathml('z < \\text{depth}'), (a, t) => td(!a.covered ? '–' : a.z < before(a, t) ? '<b>yes</b>' : 'no')) +
        row('depth after', (a, t) => td(toPlaces(stands && t === step.t ? depthAt(cell) : a.after))) + '</table>' +
        `<p>${mathml('E = (x_b - x_a)(y - y_a) - (y_b - y_a)(x - x_a)')}</p>` +
        [0, 1, 2].map(k => `<p>${edgeFormula(stands ? step.t : Math.min(S.hand, S.count) - 1, k, cell)}</p>`).join('') +
        '<p class="hint">→ and ↓: what one addition makes of it at the next pixel.</p>');
    // what the step found: the buffer as it stood one step earlier
    function before(a, t) {
        if (!stands || t !== step.t) return a.before;
        wasm.page_raster_run(S.step - 1);
        const value = depthAt(cell);
        wasm.page_raster_run(S.step);
        return value;
    }
}
const depthAt = ({ x, y }) => floats(wasm.page_raster_depth(), 192)[16 * y + x];
function showLoops() {
    const step = rasterStep(), lines = [...ORDERS[S.order], ...LOOP];
    let reached = 0;
    if (step) {
        wasm.page_raster_run(S.step - 1);
        const a = askRaster(step.t, step.x, step.y);
        wasm.page_raster_run(S.step);
        reached = !a.covered ? 3 : a.passes ? 6 : 5;
    }
    put($('#loops'), lines.map((line, i) =>
        `<code class="${step && i >= 2 && i <= reached ? i === reached ? 'line last' : 'line' : ''}">` +
        `${escapeXml(line)}</code>`).join('\n'));
}
function showRaster() {
    document.body.classList.toggle('raster', !!S.raster);
    if (!S.raster) { stopRaster(); return; }
    tellRaster(), showGrid(), showNumbers(), showLoops(), showGuess();
    $('#step').max = rasterSteps;
    $('#step').value = S.step;
    $('#step').setAttribute('aria-valuetext', `step ${S.step} of ${rasterSteps}`);
    $('#step-number').textContent = `${S.step} / ${rasterSteps}`;
    $('#play').textContent = running ? '❚❚' : '▶';
    $('#numbers').setAttribute('aria-live', running ? 'off' : 'polite');
}

// ---- steps, pointer, keys -----------------------------------------------------------------------

// A step ends what was pointed at, so that the numbers are those of the step.
function goTo(step, told = null) {
    guess = told, S.step = limit(step, 0, rasterSteps), S.cell = [-1, -1], changed();
}
// What the next step does is foretold before it is shown: outside, hidden by what is stored, or stored.
const FATES = ['outside', 'hidden', 'stored'];
let guess = null;                       // { step, said, fate }, of the step that was foretold last
function fateOf(step) {
    wasm.page_raster_run(step);
    const [t, x, y] = new Int32Array(wasm.memory.buffer, wasm.page_raster_step(step), 3), a = askRaster(t, x, y);
    wasm.page_raster_run(S.step);
    return { t, x, y, fate: !a.covered ? 0 : a.passes ? 2 : 1 };
}
function foretell(said) {
    if (S.step >= rasterSteps) return;
    const { t, x, y, fate } = fateOf(S.step);
    goTo(S.step + 1, { t, x, y, fate, said });
}
function showGuess() {
    const more = S.step < rasterSteps, next = more && fateOf(S.step);
    put($('#foretold'), (guess ? `${guess.said === guess.fate ? 'Right' : 'No'}: triangle ${guess.t + 1} at (${guess.x}, ` +
        `${guess.y}) is ${FATES[guess.fate]}. ` : '') + (more ? `Next: triangle ${next.t + 1} at (${next.x}, ${next.y}). It is …` : ''));
    for (const button of document.querySelectorAll('#foretell button')) button.disabled = !more;
}
function stopRaster() { clearInterval(running), running = 0; }
function playRaster() {
    if (running) stopRaster();
    else {
        if (S.step >= rasterSteps) S.step = 0;
        running = setInterval(() => {
            if (S.step >= rasterSteps) stopRaster();
            goTo(S.step + 1);
        }, 90);
    }
    changed();
}
function onGrid(event) {
    const at = new DOMPoint(event.clientX, event.clientY).matrixTransform($('#grid').getScreenCTM().inverse());
    return [at.x, at.y];
}
function point_at(x, y) {
    S.cell = [limit(x, 0, GRID[0] - 1), limit(y, 0, GRID[1] - 1)], changed();
}
function moveCorner(t, k, x, y) {
    const list = [...corners(t)];
    list[3 * k] = limit(x, -2, 18), list[3 * k + 1] = limit(y, -2, 14);
    S['t' + (t + 1)] = list, S.hand = t + 1, changed();
}
function cornerHandle(t, k) {
    const node = svg('g', { class: `corner of${t}`, tabindex: 0, role: 'slider', 'data-t': t, 'data-k': k,
        'aria-valuemin': -2, 'aria-valuemax': 18, 'aria-label': `Corner ${k} of triangle ${t + 1}` });
    const label = svg('text', { 'text-anchor': 'middle', dy: 0.14 });
    label.textContent = k;
    node.append(svg('circle', { r: 0.75, class: 'grip' }), svg('circle', { r: 0.3 }), label);
    node.addEventListener('pointerdown', event => {
        node.setPointerCapture(event.pointerId), S.hand = t + 1, changed();
    });
    node.addEventListener('pointermove', event => {
        if (!node.hasPointerCapture(event.pointerId)) return;
        event.stopPropagation();
        moveCorner(t, k, ...onGrid(event).map(v => Math.round(2 * v) / 2));
    });
    node.addEventListener('keydown', event => {
        const way = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[event.key];
        if (!way || modified(event)) return;
        const far = event.shiftKey ? 1 / 16 : 0.5, [x, y] = corners(t).slice(3 * k);
        moveCorner(t, k, x + far * way[0], y + far * way[1]);
        event.preventDefault(), event.stopPropagation();
    });
    return node;
}
function buildRaster() {
    const button = (label, name, act) => make('button', { type: 'button', title: name, 'aria-label': name,
        onclick: act }, label);
    const play = button('▶', 'Play or stop: Enter', playRaster);
    play.id = 'play';
    const range = make('input', { id: 'step', type: 'range', min: 0, step: 1, 'aria-label': 'Step',
        oninput: () => goTo(+range.value) });
    const steps = make('div', { id: 'steps', class: 'buttons', 'data-name': 'steps' },
        button('«', 'First step: Home', () => goTo(0)), button('‹', 'Step back: Backspace', () => goTo(S.step - 1)),
        play, button('›', 'Next step: space', () => goTo(S.step + 1)),
        button('»', 'Last step: End', () => goTo(rasterSteps)), range, make('span', { id: 'step-number' }));
    const scenes = Object.keys(SCENES).map(name => button(name, name, () => {
        SCENES[name].forEach((list, t) => { S['t' + (t + 1)] = list; });
        Object.assign(S, { count: SCENES[name].length, hand: 1, step: 0, cell: [-1, -1] }), changed();
    }));
    const rows = [0, 1, 2].map(k => {
        const row = slider(() => 't' + S.hand, `w_${k}`, `distance of corner ${k} from the eye`,
            { part: 3 * k + 2, step: 0.25, low: 1, high: 10 });
        row.dataset.name = 'w';
        return row;
    });
    const scene = make('div', { class: 'buttons', 'data-name': 'scenes' }, ...scenes);
    $('#grid').append(svg('g', { id: 'pixels' }), svg('g', { id: 'corners' }));
    for (let t = 0; t < 3; t++) for (let k = 0; k < 3; k++) $('#corners').append(cornerHandle(t, k));
    $('#raster-view').append(make('pre', { id: 'loops', 'data-name': 'loops' }), steps);
    const foretelling = make('div', { id: 'foretell', class: 'buttons', 'data-name': 'foretell' }, make('span', { id: 'foretold', role: 'status' }),
        ...FATES.map((name, i) => button(name, `The next pixel is ${name}: ${i + 1}`, () => foretell(i))));
    $('#raster-panel').append(
        make('div', { id: 'numbers', 'data-name': 'numbers', 'aria-live': 'polite' }),
        group('Foretell the next step', foretelling),
        group('Triangles', scene,
            choice('count', 'Number of triangles', ['One', 'Two', 'Three'], [1, 2, 3])),
        group('Order of the loops', choice('order', 'Order of the loops',
            ['Pixels in a triangle', 'Triangles at a pixel'])),
        group('Distance of the corners', choice('hand', 'Triangle in hand',
            ['Triangle 1', '2', '3'], [1, 2, 3]), ...rows));
    $('#grid').addEventListener('pointermove', event => {
        if (event.pointerType === 'touch' && !event.buttons) return;
        point_at(...onGrid(event).map(Math.floor));
    });
    $('#grid').addEventListener('pointerdown', event => {
        if (!event.target.closest('.corner')) point_at(...onGrid(event).map(Math.floor));
    });
    $('#grid').addEventListener('pointerleave', event => {
        if (event.pointerType !== 'touch') S.cell = [-1, -1], changed();
    });
    for (const [id, on] of [['#stepper', 1], ['#to-light', 0]])
        $(id).addEventListener('click', () => { S.raster = on, changed(); });
    addEventListener('keydown', rasterKey);
    addEventListener('pointerdown', () => { tabbed = false; }, true);
    shown.push(showRaster);
}
function rasterKey(event) {
    if (!S.raster || modified(event)) return;
    if (event.key === 'Tab') tabbed = true;
    const own = tabbed && event.target.closest?.('button, input, a, .corner'), { key } = event;
    const way = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[key];
    if (key === 'Escape' && !S.bare) S.raster = 0, changed();
    else if (own) return;
    else if (way && document.activeElement === $('#grid')) {
        const { x, y } = rasterCell() || { x: 8 - way[0], y: 6 - way[1] };
        point_at(x + way[0], y + way[1]);
    } else if (key === ' ' || key === 'ArrowRight' || key === 'PageDown') goTo(S.step + 1);
    else if (key === 'Backspace' || key === 'ArrowLeft' || key === 'PageUp') goTo(S.step - 1);
    else if (key === 'Home' || key === 'End') goTo(key === 'Home' ? 0 : rasterSteps);
    else if (key === 'Enter') playRaster();
    else if (FATES[key - 1]) foretell(key - 1);
    else return;
    event.preventDefault();
}
