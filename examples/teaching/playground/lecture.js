// lecture.js - the iterations of the notes, zero to four, one after the other on the whole screen.
// Each adds a term to the formula and to the picture, and pins the slider that it brings.

const DIFFUSE = j => `k_d (\\mathbf{N}\\cdot\\mathbf{L}${j})`;
const SPECULAR = j => `k_s (\\mathbf{N}\\cdot\\mathbf{H}${j})^n`;
const K = { e: '\\class{e}{k_e}', a: '\\class{a}{k_a I_a}', d: `\\class{d}{${DIFFUSE('')}}`,
    s: `\\class{s}{${SPECULAR('')}}`, aj: '\\class{a}{k_a I_{La,j}}', dj: `\\class{d}{${DIFFUSE('_j')}}`,
    sj: `\\class{s}{${SPECULAR('_j')}}` };
// each in pieces, between which a narrow screen breaks the line
const STEPS = [
    ['Iteration zero', `I = ${K.e}`],
    ['Iteration one', `I = ${K.e} + ${K.a}`],
    ['Iteration two', `I = ${K.e} + ${K.a}`, `+ I_L B ${K.d}`],
    ['Iteration three', `I = ${K.e} + ${K.a}`, `+ I_L B [ ${K.d} + ${K.s} ]`],
    ['Iteration four', `I = ${K.e} + ${K.a} + \\sum_j \\{ ${K.aj}`,
        '+ \\frac{\\text{spot}_j}{a_j + b_j r_j + c_j r_j^2}\\,I_{L,j} B_j',
        `[ ${K.dj} + ${K.sj} ] \\}`]];

// What a step shows; 0 is no lecture.
function stepState(step) {
    const lamps = +(step === 5);
    return step ? { model: [4, 3, 2, 0, 0][step - 1], terms: 15, flags: 0, view: 0, compare: 0,
        lamp: 1, on1: 1, on2: lamps, on3: lamps, ke: [0.12, 0.05, 0.02], turn: 0, yaw: 0.5,
        pitch: 0.4, zoom: 1, mark: MARK, part: 0, room: 0, curve: 0, detail: 12 } : {};
}
// The end of a lecture brings back what was there before it.
let before = {};
function goStep(step) {
    if (step && !S.lecture) before = { ...S };
    if (step && !document.fullscreenElement && document.documentElement.requestFullscreen)
        document.documentElement.requestFullscreen().catch(() => {});
    else if (!step && document.fullscreenElement) document.exitFullscreen().catch(() => {});
    S.lecture = limit(step, 0, STEPS.length);
    Object.assign(S, S.lecture ? stepState(S.lecture) : before);
    pointed = null, changed();
}
function buildLecture() {
    const title = make('h2'), formula = make('p'), rows = make('div', { class: 'rows' },
        color('ke', 'k_e', 'emission', 'e'), color('Ia', 'I_a', 'ambient light', 'a'),
        color('kd', 'k_d', 'diffuse reflection', 'd'),
        slider('n', 'n', 'shininess', { css: 's', curve: 2 }),
        slider('c1', 'c', 'quadratic attenuation'));
    const to = (label, name, step) => make('button', { type: 'button', 'aria-label': name,
        title: name, onclick: () => goStep(step()) }, label);
    const ways = make('nav', { 'aria-label': 'Steps of the lecture' },
        to('‹', 'Previous', () => Math.max(1, S.lecture - 1)),
        to('›', 'Next', () => S.lecture + 1), to('×', 'Exit', () => 0));
    $('#lecture').append(title, ways, rows, formula);
    shown.push(() => {
        const step = S.lecture, used = [15, 1, 3, 7, 15, 15][step];
        document.body.classList.toggle('lecture', !!step);
        document.body.classList.toggle('lobes', step > 3);
        document.body.classList.toggle('sum-of-lamps', step > 4);
        [...rows.children].forEach((row, i) => row.classList.toggle('now', i === step - 1));
        [...$('#sum').children].forEach((label, i) =>
            label.classList.toggle('unused', !(used >> i & 1)));
        if (step) title.textContent = STEPS[step - 1][0], 
            put(formula, STEPS[step - 1].slice(1).map(mathml).join(' '));
    });
    $('#teach').addEventListener('click', () => goStep(1));
    addEventListener('keydown', event => {
        const steps = { PageDown: 1, ArrowRight: 1, ArrowDown: 1, ' ': 1, Enter: 1, PageUp: -1,
            ArrowLeft: -1, ArrowUp: -1, Backspace: -1, Escape: -STEPS.length };
        // what has the focus keeps the keys that it knows
        const own = event.target.closest?.('button, input, a, .bulb') &&
            !/^Page|Escape/.test(event.key);
        if (modified(event) || own || event.shiftKey || document.querySelector('dialog[open]')) return;
        if (!S.lecture && !S.raster && event.key === 'l') goStep(1);
        else if (S.lecture && steps[event.key])
            goStep(limit(S.lecture + steps[event.key], +(event.key !== 'Escape'), STEPS.length));
        else return;
        event.preventDefault();
    });
}
// (N.H)^n about H, or (R.V)^n about R, as far as the outline is from where it begins, and the ray of
// the point's N or V
function showLobe(answer) {
    if (S.lecture < 4 && !S.lobe) return;
    const { model, n } = shownModel(), exponent = S.n * (n === '4n' ? 4 : 1);
    const at = angle => [Math.sin(angle), -Math.cos(angle)].map(v =>
        (100 * v * Math.cos(angle) ** exponent).toFixed(1));
    const outline = [];
    for (let i = -90; i <= 90; i += 1) outline.push(at(i * Math.PI / 180).join());
    const [x, y] = at(Math.acos(limit(answer.base, 0, 1)));
    $('#lobe').innerHTML = `<path d="M${outline.join('L')}Z"/><line x1="-100" x2="100"/>` +
        (answer.hit ? `<circle cx="${x}" cy="${y}" r="4"/><text x="-100" y="-105">` +
            `(${model === 1 ? 'R·V' : 'N·H'})${n === '4n' ? '⁴ⁿ' : 'ⁿ'} = ${figure(answer.power)}</text>` : '');
}
