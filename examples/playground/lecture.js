// lecture.js - the iterations of the notes, zero to four, one after the other on the whole screen.
// Each adds a term to the formula and to the picture, and pins the slider that it brings.

const term = (css, html) => `<span class="${css}">${html}</span>`;
const K = { e: term('e', '<i>k</i><sub>e</sub>'),
    a: term('a', '<i>k</i><sub>a</sub> <i>I</i><sub>a</sub>'),
    d: term('d', '<i>k</i><sub>d</sub> (<b>N</b>·<b>L</b>)'),
    s: term('s', '<i>k</i><sub>s</sub> (<b>N</b>·<b>H</b>)<sup><i>n</i></sup>'),
    aj: term('a', '<i>k</i><sub>a</sub> <i>I</i><sub>La,j</sub>'),
    dj: term('d', '<i>k</i><sub>d</sub> (<b>N</b>·<b>L</b><sub>j</sub>)'),
    sj: term('s', '<i>k</i><sub>s</sub> (<b>N</b>·<b>H</b><sub>j</sub>)<sup><i>n</i></sup>') };
const STEPS = [
    ['Iteration zero', `<i>I</i> = ${K.e}`],
    ['Iteration one', `<i>I</i> = ${K.e} + ${K.a}`],
    ['Iteration two', `<i>I</i> = ${K.e} + ${K.a} + <i>I</i><sub>L</sub> <i>B</i> ${K.d}`],
    ['Iteration three',
        `<i>I</i> = ${K.e} + ${K.a} + <i>I</i><sub>L</sub> <i>B</i> [ ${K.d} + ${K.s} ]`],
    ['Iteration four', `<i>I</i> = ${K.e} + ${K.a} + Σ<sub><i>j</i></sub> { ${K.aj} + ` +
        `spot<sub>j</sub>/(<i>a</i><sub>j</sub> + <i>b</i><sub>j</sub><i>r</i><sub>j</sub> + ` +
        `<i>c</i><sub>j</sub><i>r</i><sub>j</sub>²) <i>I</i><sub>L,j</sub> <i>B</i><sub>j</sub> ` +
        `[ ${K.dj} + ${K.sj} ] }`]];

// What a step shows; 0 is no lecture.
function stepState(step) {
    const lamps = +(step === 5);
    return step ? { model: [4, 3, 2, 0, 0][step - 1], terms: 15, flags: 0, view: 0, compare: 0,
        lamp: 1, on1: 1, on2: lamps, on3: lamps, ke: [0.12, 0.05, 0.02] } : {};
}
function goStep(step) {
    if (step && !document.fullscreenElement && document.documentElement.requestFullscreen)
        document.documentElement.requestFullscreen().catch(() => {});
    else if (!step && document.fullscreenElement) document.exitFullscreen().catch(() => {});
    S.lecture = limit(step, 0, STEPS.length);
    Object.assign(S, stepState(S.lecture)), changed();
}
function buildLecture() {
    const title = make('h2'), formula = make('p'), rows = make('div', {},
        color('ke', '<i>k</i><sub>e</sub>', 'emission', 'e'),
        color('Ia', '<i>I</i><sub>a</sub>', 'ambient light', 'a'),
        color('kd', '<i>k</i><sub>d</sub>', 'diffuse reflection', 'd'),
        slider('n', '<i>n</i>', 'shininess', { css: 's', curve: 2 }),
        slider('c1', '<i>c</i>', 'quadratic attenuation'));
    $('#lecture').append(title, formula, rows);
    shown.push(() => {
        const step = S.lecture, used = [15, 1, 3, 7, 15, 15][step];
        document.body.classList.toggle('lecture', !!step);
        document.body.classList.toggle('lobes', step > 3);
        document.body.classList.toggle('sum-of-lamps', step > 4);
        [...rows.children].forEach((row, i) => row.classList.toggle('now', i === step - 1));
        [...$('#sum').children].forEach((label, i) =>
            label.classList.toggle('unused', !(used >> i & 1)));
        if (step) title.textContent = STEPS[step - 1][0], put(formula, STEPS[step - 1][1]);
    });
    $('#teach').addEventListener('click', () => goStep(1));
    addEventListener('keydown', event => {
        const steps = { PageDown: 1, PageUp: -1, Escape: -STEPS.length };
        if (!S.lecture && event.key === 'l' && !$('#program').open) goStep(1);
        else if (S.lecture && steps[event.key])
            goStep(limit(S.lecture + steps[event.key], +(event.key !== 'Escape'), STEPS.length));
        else return;
        event.preventDefault();
    });
}
// (N.H)^n about H, as far as the outline is from where it begins, and the ray of the point's N
function showLobe(answer) {
    if (S.lecture < 4) return;
    const at = angle => [Math.sin(angle), -Math.cos(angle)].map(v =>
        (100 * v * Math.cos(angle) ** S.n).toFixed(1));
    const outline = [];
    for (let i = -90; i <= 90; i += 1) outline.push(at(i * Math.PI / 180).join());
    const [x, y] = at(Math.acos(limit(answer.base, 0, 1)));
    $('#lobe').innerHTML = `<path d="M${outline.join('L')}Z"/><line x1="-100" x2="100"/>` +
        (answer.hit ? `<circle cx="${x}" cy="${y}" r="4"/><text x="-100" y="-105">` +
            `(N·H)ⁿ = ${figure(answer.power)}</text>` : '');
}
