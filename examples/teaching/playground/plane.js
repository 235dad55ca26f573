// plane.js - drawings of the marked point. The vectors there in one plane: L and V are dragged, R and H
// follow, angles are arcs, their degrees and cosines stand below, and the lobe says how bright the point is
// from each side. Brightness along the line through it. Values are the module's.

const turned = (angle, far) => [far * Math.sin(angle * Math.PI / 180), -far * Math.cos(angle * Math.PI / 180)];
const planeAt = (toL, toV, model) => answerAt(wasm.page_plane(toL, toV, model));
const degrees = ([x, y]) => Math.atan2(x, y) * 180 / Math.PI;
// Angles, each with one beside it that is so far from its neighbours
function setApart(angles, apart) {
    const from = [...angles].sort((a, b) => a - b), to = [...from];
    for (let round = 0; round < 40; round++) for (let i = 1; i < to.length; i++) {
        const short = (apart - to[i] + to[i - 1]) / 2;
        if (short > 0) to[i - 1] -= short, to[i] += short;
    }
    return new Map(from.map((angle, i) => [angle, to[i]]));
}
function showPlane() {
    document.body.classList.toggle('plane', !!S.plane);
    if (!S.plane) return;
    const svg = $('#plane'), wide = svg.clientWidth, tall = svg.clientHeight, rem = parseFloat(getComputedStyle(svg).fontSize);
    const by = { phong: planeAt(S.toL, S.toV, 1), blinn: planeAt(S.toL, S.toV, 0) };
    const [toR, toH] = [by.phong, by.blinn].map(answer => degrees(answer.unitH)), blinn = S.model !== 1;
    const shown = blinn ? by.blinn : by.phong, lit = shown.gate, seen = Math.abs(S.toV) < 90;
    // where L = -V there is no H
    const mirror = S.rays & 1, slip = S.rays & 8, half = S.rays & 2 && Math.hypot(...by.blinn.unitH) > 0.5;
    const name = letter => bare(`\\mathbf{${letter}}`), dot = (a, b) => `${name(a)} · ${name(b)}`;

    // what the values are; they stand in the corner or, where it is narrow, below
    const angle = (sign, value) => `${bare(sign)} = ${Math.round(Math.abs(value))}°&emsp;`;
    const raised = `<tspan dy="-.5em" font-size="75%">${bare('n')}</tspan>`;
    const lobed = (factor, { base, power }, own) => S.terms & 8 && own ? `(${factor})${raised}<tspan dy=".38em"> = ${figure(power)}</tspan>`
        : `${factor} = ${figure(base)}`;
    const line = [`${angle('\\theta', S.toL)}${dot('N', 'L')} = ${figure(shown.nl)}`];
    if (!lit) line.push(course && course !== 'uw' ? `max(0, ${dot('N', 'L')}) = 0` : 'B = 0');
    else if (!seen) line.push(`${name('V')} is behind the surface`);
    else {
        if (mirror) line.push(angle('\\phi', toR - S.toV) + lobed(dot('R', 'V'), by.phong, !blinn));
        if (half) line.push(angle('\\omega', toH) + lobed(dot('N', 'H'), by.blinn, blinn));
    }
    const high = Math.max(tall - 2.4 * rem, 1), corner = wide > 1.5 * high + 13 * rem;
    const values = corner ? rem : (0.3 + 1.3 * line.length) * rem;
    // of a vector's length what is drawn below the surface
    const sinks = Math.max(0, ...[S.toL, S.toV, ...(slip ? [toR + 180] : [])].map(v => -Math.cos(v * Math.PI / 180)));
    const far = Math.max(Math.min(wide / 2 - 1.4 * rem, (tall - values - 1.4 * rem - (S.rays & 4 && 0.14 * wide)) / (1 + sinks) - 0.8 * rem * !!sinks), 1);
    const deep = Math.max(sinks && sinks * far + 0.8 * rem, S.rays & 4 && 0.14 * wide), x = wide / 2, y = (tall + far + 1.4 * rem - values - deep) / 2;
    const at = (angle, length) => turned(angle, length).map((v, i) => (v + [x, y][i]).toFixed(1));

    const drawn = [0, S.toL, S.toV, ...(mirror ? [toR] : []), ...(half ? [toH] : []), ...(slip ? [toR + 180] : [])];
    // a letter that would touch another stands farther to its side
    const place = setApart(drawn, 1.35 * rem / (far + 0.75 * rem) * 180 / Math.PI);
    const ray = (letter, angle, css, grip = '', sign = '') => {
        const [X, Y] = turned(angle, far), [tx, ty] = at(place.get(angle), far + 0.75 * rem);
        return `<g class="${css}"${grip}>${grip && `<circle class="grip" cx="${x + X}" cy="${y + Y}" r="${1.2 * rem}"/>`}` +
            `<line x1="${x}" y1="${y}" x2="${x + X * 0.97}" y2="${y + Y * 0.97}"/>` +
            head(css, X, Y, x + X, y + Y, rem / 14) + `<text x="${tx}" y="${ty}">${sign}${name(letter)}</text></g>`;
    };
    // an arc between two directions; its letter stands in the widest gap between vectors, if that has room
    const arc = (from, to, share, sign, css) => {
        const [ax, ay] = at(from, share * far), [bx, by] = at(to, share * far), [low, high] = [from, to].sort((a, b) => a - b);
        const stops = drawn.filter(v => v >= low && v <= high).sort((a, b) => a - b);
        const [gap, middle] = stops.slice(1).map((v, i) => [v - stops[i], (v + stops[i]) / 2]).sort((a, b) => b[0] - a[0])[0] || [0, 0];
        const away = Math.max(share * far + 0.6 * rem, 0.5 * rem / Math.sin(Math.min(gap, 180) * Math.PI / 360));
        const [tx, ty] = at(middle, away);
        return `<g class="${css}"><path class="arc" d="M${ax} ${ay}A${share * far} ${share * far} 0 0 ${+(to > from)} ${bx} ${by}"/>` +
            (sign && away < 0.95 * far ? `<text class="degrees" x="${tx}" y="${ty}">${bare(sign)}</text>` : '') + '</g>';
    };
    // iteration three without colours: the light that leaves toward each side; a term that is alone has k = 1
    const k = bit => S.terms & bit && (S.terms & 12 ^ bit ? luminance(bit === 4 ? S.kd : S.ks) : 1);
    const leaves = answer => 0.9 * far * answer.gate * (k(4) * answer.nl + k(8) * answer.power * (S.flags & 8 ? answer.nl : 1));
    let lobe = '';
    if (S.terms & 12) {
        const points = [];
        for (let v = -90; v <= 90; v += 1.5) points.push(at(v, leaves(planeAt(S.toL, v, S.model))).join(' '));
        lobe = `<path class="lobe" d="M${points.join('L')}Z"/>`;
        if (seen && lit) {
            const [cx, cy] = at(S.toV, leaves(shown));
            lobe += `<circle class="value" cx="${cx}" cy="${cy}" r="${rem / 5}"/>`;
        }
    }
    const grip = (angle, way) => ` tabindex="0" role="slider" data-to="${way}" ` +
        `aria-label="${way[2]}, degrees from N" aria-valuemin="-180" aria-valuemax="180" aria-valuenow="${Math.round(angle)}"`;
    svg.innerHTML = (S.rays & 4 ? `<circle class="below bent" cx="${x}" cy="${y + wide}" r="${wide}"/>` +
            `<text class="degrees tangent" x="0" y="${0.7 * rem}">tangent</text><text class="degrees tangent" x="0" y="${1.9 * rem}">plane</text>`
        : `<rect class="below" x="0" y="${y}" width="${wide}" height="${0.5 * rem}"/>`) +
        `<line class="surface" x2="${wide}" y1="${y}" y2="${y}"/>` +
        `<clipPath id="above"><rect width="${wide}" height="${Math.max(y, 0)}"/></clipPath><g clip-path="url(#above)" class="${S.terms & 8 ? 'H' : 'N'}">${lobe}</g>` +
        arc(0, S.toL, 0.42, '\\theta', 'L') + (mirror ? arc(0, toR, 0.42, '', 'L') + arc(toR, S.toV, 0.62, '\\phi', 'H') : '') +
        (half && lit ? arc(0, toH, 0.8, '\\omega', 'H') : '') +
        ray('N', 0, 'N') + (mirror ? ray('R', toR, 'H') : '') + (half ? ray('H', toH, 'H') : '') + (slip ? ray('R', toR + 180, 'H', '', '−') : '') +
        ray('V', S.toV, 'V', grip(S.toV, 'toV')) + ray('L', S.toL, 'L', grip(S.toL, 'toL')) +
        line.map((text, i) => `<text class="values ${corner ? 'corner' : ''}" x="${corner ? wide : x}" ` +
            `y="${(corner ? 0.8 * rem : y + deep + 1.1 * rem) + 1.3 * i * rem}">${text.replace(/= -/, '= −')}</text>`).join('');
    svg.dataset.centre = [x, y];
}
function buildPlane() {
    const svg = $('#plane');
    let held = '';
    const toward = event => {
        const box = svg.getBoundingClientRect(), [x, y] = svg.dataset.centre.split(',').map(Number);
        return Math.atan2(event.clientX - box.x - x, y - event.clientY + box.y) * 180 / Math.PI;
    };
    const set = (way, angle) => { S[way] = limit(Math.round(angle), -180, 180), changed(); };
    svg.addEventListener('pointerdown', event => {
        const grip = event.target.closest('[data-to]'), angle = toward(event);
        held = grip ? grip.dataset.to : Math.abs(angle - S.toL) < Math.abs(angle - S.toV) ? 'toL' : 'toV';
        svg.setPointerCapture(event.pointerId), set(held, angle);
    });
    svg.addEventListener('pointermove', event => { if (held) set(held, toward(event)); });
    for (const end of ['pointerup', 'pointercancel']) svg.addEventListener(end, () => { held = ''; });
    svg.addEventListener('keydown', event => {
        const way = event.target.dataset.to, step = { ArrowLeft: -2, ArrowRight: 2, ArrowDown: -2, ArrowUp: 2 }[event.key];
        if (modified(event) || !way || !step) return;
        event.preventDefault();
        set(way, S[way] + step);
        showPlane();
        svg.querySelector(`[data-to=${way}]`).focus();
    });
    shown.push(showPlane);
    new ResizeObserver(showPlane).observe(svg);
}

// Brightness along a line: the row of the picture through the marked point, drawn again by the module
// term by term, as areas on top of each other.
function showCurve(answer) {
    const on = S.curve && !S.view, svg = $('#curve');
    svg.classList.toggle('shown', !!on);
    if (!on) return;
    const { width, height } = canvas, across = canvas.clientWidth, tall = canvas.clientHeight;
    const fraction = pointed ? pointed[1] : answer.hit ? answer.point[1] / height : 0.5;
    const row = limit(Math.floor(fraction * height), 0, height - 1), used = usedTerms();
    const sums = [new Float32Array(width)];
    for (let i = 0; i < 4; i++) {
        const sum = Float32Array.from(sums[i]);
        if (used >> i & 1) {
            const add = floats(wasm.page_row(row, 1 << i), width);
            for (let x = 0; x < width; x++) sum[x] += add[x];
        }
        sums.push(sum);
    }
    // 1, which is the most that a screen shows, stands at a quarter of the picture's height
    const most = Math.max(1, ...sums[4]), unit = 0.25 * tall / most, floor = tall - 1;
    const path = sum => Array.from({ length: across }, (_, x) =>
        `${x},${(floor - unit * sum[Math.min(width - 1, Math.floor((x + 0.5) * width / across))])
            .toFixed(1)}`);
    const paths = sums.map(path), y = (fraction * tall).toFixed(1), one = (floor - unit).toFixed(1);
    svg.setAttribute('viewBox', `0 0 ${across} ${tall}`);
    svg.innerHTML = [...'eads'].map((css, i) => used >> i & 1
        ? `<polygon class="${css}" points="${paths[i + 1].join(' ')} ` +
            `${paths[i].reverse().join(' ')}"/>` : '').join('') +
        `<polyline points="${path(sums[4]).join(' ')}"/>` +
        `<line class="row" x2="${across}" y1="${y}" y2="${y}"/>` +
        `<line class="one" x2="${across}" y1="${one}" y2="${one}"/>` +
        `<text x="4" y="${one - 4}">1</text>`;
}
