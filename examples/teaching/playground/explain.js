// explain.js - the equation at the marked pixel, line after line, each with its symbols, its numbers
// and its value; copied as LaTeX or as a C program that prints them.  Values are the module's.

const ROOM = 4;                         // decimals that are written
const short = v => {
    const text = Math.abs(v) >= 1e6 || (v && Math.abs(v) < 1e-4)
        ? v.toExponential(2).replace(/e\+?(-?)(\d+)$/, ' \\cdot 10^{$1$2}')
        : String(+v.toFixed(ROOM)).replace(/^(-?)0\./, '$1.');
    return v < 0 ? `(${text})` : text;
};
// what rounding leaves beside a component that is a million times as large is 0
const triad = v => {
    const most = Math.max(...v.map(Math.abs));
    return `(${v.map(x => short(Math.abs(x) < 1e-6 * most ? 0 : x).replace(/[()]/g, '')).join(',\\,')})`;
};
const write = value => Array.isArray(value) ? triad(value) : short(value).replace(/^\((.*)\)$/, '$1');
// as few digits as give the same float
const inC = v => {
    let places = 1;
    while (places < 9 && Math.fround(+v.toPrecision(places)) !== Math.fround(v)) places++;
    const text = String(+v.toPrecision(places));
    return /[.e]/.test(text) ? text : text + '.0';
};
const vecC = v => `{ ${v.map(inC).join(', ')} }`;
const bold = name => `\\mathbf{${name}}`;
const minus = (a, b) => a.map((v, i) => v - b[i]);
const dotted = (a, b) => a.map((v, i) => `${short(v)} \\cdot ${short(b[i])}`).join(' + ');

// A line: the name in C and in LaTeX, its formula, the same with numbers, what C computes it by, and
// the value, and why.  given: the value alone, from which the rest follows, and what it is.
const lineOf = (c, tex, formula, numbers, code, value, why = '', what = '') =>
    ({ c, tex, formula, numbers, code, value, why, what });
const given = (c, tex, value, what = '') => lineOf(c, tex, '', '', '', value, '', what);

// Why a term is 0, as the first of these that holds
const whyZero = (value, reasons) => Math.max(...value) === 0 ? (reasons.find(([holds]) => holds) || [0, ''])[1] : '';
const dark = rgb => Math.max(...rgb) === 0;

// The lines of one lamp at one point.  q: the point's index in names, or ''
function lampLines(j, q, a, model, used, out) {
    const of = field => S[field + j], at = (name, letter = name) => [`${name}_${j}${q && '_' + q}`,
        `${/^[LHR]$/.test(letter) ? bold(letter) : letter}_{${j}${q && ',' + q}}`];
    const P = q ? [`P_${q}`, `${bold('P')}_{${q}}`] : ['P', bold('P')], N = q ? [`N_${q}`, `${bold('N')}_{${q}}`]
        : ['N', bold('N')], V = q ? [`V_${q}`, `${bold('V')}_{${q}}`] : ['V', bold('V')];
    const X = [`X_${j}`, `${bold('X')}_${j}`], L = at('L'), r = at('r'), NL = at('NL', 'n'), f = at('f'),
        B = at('B'), spot = at('spot', '\\text{spot}'), LS = at('LS', 's');
    NL[1] = `${N[1]} \\cdot ${L[1]}`;
    const lit = used & 12, gooch = model === 5, dims = (lit && !gooch) || (used & 2 && S.flags & 16);
    if (!lit && !dims) { ambientLine(); return; }
    out.push(given('', X[1], of('p'), (of('far') ? 'toward lamp ' : 'the place of lamp ') + j));
    if (of('far')) out.push(lineOf(L[0], L[1], `\\frac{${X[1]}}{|${X[1]}|}`, '', `unit(${X[0]})`, a.unitL));
    else {
        out.push(lineOf(r[0], r[1], `|${X[1]} - ${P[1]}|`,
            `\\sqrt{${minus(of('p'), a.place).map(v => short(v) + '^2').join(' + ')}}`,
            `length(sub(${X[0]}, ${P[0]}))`, a.r));
        out.push(lineOf(L[0], L[1], `\\frac{${X[1]} - ${P[1]}}{${r[1]}}`, '',
            `scale(1 / ${r[0]}, sub(${X[0]}, ${P[0]}))`, a.unitL));
    }
    if (lit) out.push(lineOf(NL[0], NL[1], '', dotted(a.unitN, a.unitL), `dot(${N[0]}, ${L[0]})`, a.nl));
    if (gooch) return;
    const none = of('far') || of('a') + of('b') + of('c') === 0;
    out.push(none ? lineOf(f[0], f[1], '', '', '1', a.attenuation, '\\text{it is not attenuated}')
        : lineOf(f[0], f[1], `\\frac{1}{a_${j} + b_${j} ${r[1]} + c_${j} ${r[1]}^2}`,
            `\\frac{1}{${short(of('a'))} + ${short(of('b'))} \\cdot ${short(a.r)} + ` +
            `${short(of('c'))} \\cdot ${short(a.r)}^2}`,
            `1 / (${inC(of('a'))} + ${inC(of('b'))} * ${r[0]} + ${inC(of('c'))} * ${r[0]} * ${r[0]})`,
            a.attenuation));
    if (of('beta') < 180) {
        const axis = of('p').map(v => v / Math.hypot(...of('p'))), cosine = axis.reduce((sum, v, i) =>
            sum + v * a.unitL[i], 0), edge = Math.cos(of('beta') * Math.PI / 180);
        out.push(lineOf(LS[0], `${L[1]} \\cdot ${bold('S')}_${j}`, '', dotted(a.unitL, axis),
            `dot(${L[0]}, unit(${X[0]}))`, cosine));
        out.push(lineOf(spot[0], spot[1], a.spot ? `(${L[1]} \\cdot ${bold('S')}_${j})^{e_${j}}` : '',
            a.spot ? `${short(cosine)}^{${short(of('e'))}}` : '',
            `${LS[0]} >= ${inC(edge)} ? pow(${LS[0]}, ${inC(of('e'))}) : 0`, a.spot,
            `${short(cosine)} ${a.spot ? '\\ge' : '<'} \\cos \\beta_${j} = ${short(edge)}`));
    } else out.push(lineOf(spot[0], spot[1], '', '', '1', a.spot, '\\text{it is no spotlight}'));
    const arrives = `${f[1]}\\,${spot[1]}`, arrivesC = `${f[0]} * ${spot[0]}`, I = `I_${j}`;
    const arrived = `${short(a.attenuation)} \\cdot ${short(a.spot)}`;
    const nothing = (k, value, gated) => [[gated, `${B[1]} = 0`], [!a.spot, `${spot[1]} = 0`], [dark(value), `${k} = 0`],
        [dark(of('I')), `${I} = 0`]];
    ambientLine();
    if (lit) out.push(lineOf(B[0], B[1], '', '', `${NL[0]} > 0`, a.gate,
        `${NL[1]} ${a.gate ? '>' : '\\le'} 0`));
    if (used & 4) {
        const d = at('diffuse', '\\text{diffuse}'), abs = S.flags & 2;
        out.push(lineOf(d[0], d[1], `${arrives}\\,${abs ? '' : B[1]} k_d ${I} ${abs ? '|' : '('}${NL[1]}${abs ? '|' : ')'}`,
            `${arrived} \\cdot ${abs ? '' : a.gate + ' \\cdot '}${triad(a.kd)} \\cdot ${triad(of('I'))} \\cdot ` +
                (abs ? `|${write(a.nl)}|` : short(a.nl)),
            `scale(${arrivesC} * ${abs ? `fabs(${NL[0]})` : `${B[0]} * ${NL[0]}`}, mul(k_d, ${I}))`,
            a.lampDiffuse, whyZero(a.lampDiffuse, nothing('k_d', a.kd, !a.gate && !abs))));
    }
    if (used & 8) {
        const H = at(model === 1 ? 'R' : 'H'), s = at('specular', '\\text{specular}'), base = at('base');
        const power = at('power', 'p'), pair = model === 1 ? [H, V, a.unitH, a.unitV] : [N, H, a.unitN, a.unitH];
        base[1] = `${pair[0][1]} \\cdot ${pair[1][1]}`;
        out.push(model === 1
            ? lineOf(H[0], H[1], `2 (${NL[1]}) ${N[1]} - ${L[1]}`, '',
                `sub(scale(2 * ${NL[0]}, ${N[0]}), ${L[0]})`, a.unitH)
            : lineOf(H[0], H[1], `\\frac{${L[1]} + ${V[1]}}{|${L[1]} + ${V[1]}|}`, '',
                `unit(add(${L[0]}, ${V[0]}))`, a.unitH));
        out.push(lineOf(base[0], base[1], '', dotted(pair[2], pair[3]), `dot(${pair[0][0]}, ${pair[1][0]})`, a.base));
        out.push(lineOf(power[0], `\\max(0,\\,${base[1]})^n`, '', `${a.base > 0 ? short(a.base) : 0}^{${short(a.n)}}`,
            `pow(fmax(0, ${base[0]}), n)`, a.power));
        const open = S.flags & 4, weighted = S.flags & 8;
        out.push(lineOf(s[0], s[1], `${arrives}\\,${open ? '' : B[1]} k_s ${I} ` +
                `${weighted ? `\\max(0,\\,${NL[1]}) ` : ''}\\max(0,\\,${base[1]})^n`,
            `${arrived} \\cdot ${open ? '' : a.gate + ' \\cdot '}${triad(a.ks)} \\cdot ${triad(of('I'))} \\cdot ` +
                (weighted ? short(Math.max(0, a.nl)) + ' \\cdot ' : '') + short(a.power),
            `scale(${arrivesC} * ${open ? '' : B[0] + ' * '}${weighted ? `fmax(0, ${NL[0]}) * ` : ''}${power[0]}, ` +
                `mul(k_s, ${I}))`, a.lampSpecular, whyZero(a.lampSpecular,
            [...nothing('k_s', a.ks, !a.gate && !open), [a.power < 1e-9, `${base[1]}\\text{ is far below 1}`]])));
    }
    function ambientLine() {
        const name = at('ambient', '\\text{ambient}');
        if (!(used & 2) || dark(of('A'))) return;
        const dimmed = S.flags & 16;
        out.push(lineOf(name[0], name[1], `${dimmed ? arrives + '\\,' : ''}k_a I_{La,${j}}`,
            `${dimmed ? arrived + ' \\cdot ' : ''}${triad(a.ka)} \\cdot ${triad(of('A'))}`,
            `scale(${dimmed ? arrivesC : '1'}, mul(k_a, A_${j}))`, a.lampAmbient));
    }
}

// The lines of one point where the equation is evaluated
function pointLines(k, q, panel, used, out) {
    const lamps = LAMPS.filter(j => S['on' + j]), { model } = panel, gooch = model === 5;
    const ask = j => answerAt(wasm.page_factors(k, j - 1));
    const a = ask(1), name = letter => q ? [`${letter}_${q}`, `${bold(letter)}_{${q}}`] : [letter, bold(letter)];
    const P = name('P'), N = name('N'), V = name('V'), camera_ = [0, 0, panel.distance];
    const sum = q ? [`I_at_${q}`, `I_{${q}}`] : ['I', 'I'], parts = [];
    if (used & 12 || S.flags & 16) {
        out.push(given(P[0], P[1], a.place), given(N[0], N[1], a.unitN));
        out.push(S.flags & 32 ? given(V[0], V[1], a.unitV)
            : lineOf(V[0], V[1], `\\frac{${bold('E')} - ${P[1]}}{|${bold('E')} - ${P[1]}|}`,
                `\\frac{${triad(minus(camera_, a.place))}}{${short(Math.hypot(...minus(camera_, a.place)))}}`,
                `unit(sub(E, ${P[0]}))`, a.unitV));
    }
    if (used & 1) parts.push(['k_e', 'k_e', a.emission]);
    if (used & 2) {
        out.push(lineOf('ambient' + (q && '_' + q), `\\text{ambient}${q && '_' + q}`, 'k_a I_a',
            `${triad(a.ka)} \\cdot ${triad(S.Ia)}`, 'mul(k_a, I_a)', a.sceneAmbient));
        parts.push(['ambient' + (q && '_' + q), `\\text{ambient}${q && '_' + q}`, a.sceneAmbient]);
    }
    for (const j of gooch ? lamps.slice(0, 1) : lamps) {
        const from = out.length, b = ask(j);
        lampLines(j, q, b, model, used, out);
        const brings = [b.lampAmbient, b.lampDiffuse, b.lampSpecular].some(rgb => !dark(rgb));
        if (!brings && !gooch) for (const line of out.slice(from)) line.idle = j;
        for (const line of out.slice(from))
            if (/^(ambient|diffuse|specular)_/.test(line.c)) parts.push([line.c, line.tex, line.value, line.idle]);
        if (gooch && used & 4) {
            const tone = ['tone' + (q && '_' + q), `\\text{tone}${q && '_' + q}`];
            out.push(lineOf(tone[0], tone[1], `\\text{cool} + \\frac{1 + ${N[1]} \\cdot \\mathbf{L}_{${j}${q && ',' + q}}}{2} ` +
                '(\\text{warm} - \\text{cool})', '', `add(cool, scale((1 + NL_${j}${q && '_' + q}) / 2, sub(warm, cool)))`,
            b.diffuse));
            parts.push([...tone, b.diffuse]);
        }
    }
    const value = [0, 1, 2].map(c => parts.reduce((all, part) => all + part[2][c], 0));
    const brought = parts.filter(part => !part[3]);      // what folded lamps add is 0
    out.push(lineOf(sum[0], sum[1], brought.map(part => part[1]).join(' + ') || '0',
        brought.map(part => triad(part[2])).join(' + '),
        parts.map(part => part[0]).reduce((all, part) => all ? `add(${all}, ${part})` : part, '') || 'zero', value));
    return sum;
}

function explanation() {
    const answer = probeMark(), out = [];
    if (!answer.hit) return null;
    const { model } = shownModel(), used = usedTerms();
    const panel = { model, distance: camera(canvas.width, canvas.height).distance };
    if (used & 12 && !(S.flags & 32)) out.push(given('', bold('E'), [0, 0, panel.distance], 'the eye'));
    if (S.shading === 1) {
        const sums = [1, 2, 3].map((q, k) => pointLines(k, String(q), panel, used, out));
        const w = answer.weights, mixed = TERMS.reduce((all, name) => all.map((v, c) => v + answer[name][c]), [0, 0, 0]);
        out.push(lineOf('I', 'I', `\\alpha ${sums[0][1]} + \\beta ${sums[1][1]} + \\gamma ${sums[2][1]}`,
            sums.map((_, k) => `${short(w[k])}\\,${sums[k][1]}`).join(' + '),
            `add(add(scale(${inC(w[0])}, ${sums[0][0]}), scale(${inC(w[1])}, ${sums[1][0]})), ` +
                `scale(${inC(w[2])}, ${sums[2][0]}))`, mixed));
    } else pointLines(0, '', panel, used, out);
    const stored = out[out.length - 1].value.map(v => Math.round(255 * encode(limit(v, 0, 1))));
    return { lines: out, answer: answerAt((probeMark(), wasm.page_factors(0, 0))), panel, stored };
}

// ---- as LaTeX, as C -----------------------------------------------------------------------------

function lineTex({ tex, formula, numbers, value, why, what }, sign = '=') {
    const parts = [formula, numbers, write(value)].filter((part, i, all) => part !== '' &&
        part !== all[i + 1]);
    return `${tex} ${sign} ${parts.join(' = ')}` + (why && `\\quad\\text{since }${why}`) + (what && `\\quad\\text{${what}}`);
}
const asLatex = ({ lines }) => spell('\\begin{align*}\n' +
    lines.map(line => lineTex(line, '&=')).join(' \\\\\n') + '\n\\end{align*}\n');

const asC = found => spellC(pixelProgram(found));
function pixelProgram({ lines, answer, panel, stored }) {
    const lamps = LAMPS.filter(j => S['on' + j]);
    const type = value => Array.isArray(value) ? 'vec' : 'double';
    const note = value => Array.isArray(value) ? `(${value.map(v => +v.toFixed(ROOM)).join(', ')})` : +value.toFixed(ROOM);
    const body = lines.filter(line => line.c).flatMap(({ c, code, value }) => {
        const right = code || (Array.isArray(value) ? vecC(value) : inC(value)), begin = `    ${type(value)} ${c} = `;
        const show = `    ${Array.isArray(value) ? 'show3' : 'show'}("${c}", ${c});`;
        return [...fold(begin, right + ';'), show + `    /* ${note(value)} */`];
    });
    const tone = rgb => rgb.map(decode);
    const constants = [['k_e', answer.ke], ['k_a', answer.ka], ['k_d', answer.kd], ['k_s', answer.ks], ['I_a', S.Ia],
        ['E', [0, 0, panel.distance]], ['cool', tone([0.4, 0.4, 0.7])], ['warm', tone([0.8, 0.6, 0.6])],
        ['zero', [0, 0, 0]], ...lamps.flatMap(j => [['X_' + j, S['p' + j]], ['I_' + j, S['I' + j]], ['A_' + j, S['A' + j]]])];
    const needed = constants.filter(([name]) => RegExp(`\\b${name}\\b`).test(body.join('\n')));
    return ['/* The equation at one pixel: cc pixel.c -lm -o pixel && ./pixel', '   X is where a lamp stands, I its light; ' +
        `the pixel is stored as ${stored.join(', ')}. */`, '#include <math.h>', '#include <stdio.h>', '',
    'typedef struct vec { double x, y, z; } vec;',
    ...[['add', '+'], ['sub', '-'], ['mul', '*']].map(([name, sign]) => `static inline vec ${name}(vec a, vec b)\n{\n` +
        `    return (vec){ a.x ${sign} b.x, a.y ${sign} b.y, a.z ${sign} b.z };\n}`),
    'static inline vec scale(double s, vec a) { return (vec){ s * a.x, s * a.y, s * a.z }; }',
    'static inline double dot(vec a, vec b) { return a.x * b.x + a.y * b.y + a.z * b.z; }',
    'static inline double length(vec a) { return sqrt(dot(a, a)); }',
    'static inline vec unit(vec a) { return scale(1 / length(a), a); }',
    'static inline void show(const char *name, double v) { printf("%s = %.6g\\n", name, v); }',
    'static inline void show3(const char *name, vec v)\n{\n    printf("%s = %.6g %.6g %.6g\\n", name, v.x, v.y, v.z);\n}', '',
    'int main(void)', '{', ...needed.map(([name, value]) => `    const vec ${name} = ${vecC(value)};`),
    ...(/\bn\)/.test(body.join('\n')) ? [`    const double n = ${inC(answer.n)};`] : []), '', ...body, '    return 0;', '}', '']
        .join('\n');
}
// A statement in lines of at most 100 columns, broken after commas and before operators
function fold(begin, rest) {
    const lines = [begin];
    for (const word of rest.split(/(?<=, )|(?= [*+?:] )/)) {
        if ((lines[lines.length - 1] + word).length > 98) lines.push('        ' + word.trimStart());
        else lines[lines.length - 1] += word;
    }
    return lines.map(line => line.trimEnd());
}

// ---- the dialog ---------------------------------------------------------------------------------

function explain() {
    const found = explanation(), dialog = $('#explanation');
    if (!found) { say('No surface is marked: point at one.'); return; }
    const lines = $('#lines');
    writeLines(found);
    for (const [id, text] of [['#copy-latex', asLatex], ['#copy-c', asC]])
        $(id).onclick = async () => {
            const words = text(found), label = $(id).dataset.label;
            if (!await copy(words)) lines.replaceChildren(make('pre', {}, words));
            $(id).textContent = 'Copied';
            setTimeout(() => { $(id).textContent = label; }, 1500);
        };
    dialog.show();
    showFromSide(found);
    dialog.querySelector('form').lastElementChild.focus();
}
// Formula, numbers and value of a line may stand below each other. Lamps that bring nothing are folded; the
// result is the last line, which is always seen.
function writeLines(found) {
    const paragraph = (line, breaks = / (?==)|(?=\\quad\\text)/) => make('p', { html: lineTex(line).split(breaks).map(mathml).join(' ') });
    const nodes = [], open = new Set([...document.querySelectorAll('#lines details[open]')].map(node => node.dataset.lamp));
    for (const line of found.lines.slice(0, -1)) {
        let fold = nodes[nodes.length - 1];
        if (line.idle && (!fold || fold.dataset.lamp !== String(line.idle))) {
            const why = found.lines.filter(other => other.idle === line.idle && other.why).pop();
            fold = make('details', { 'data-lamp': line.idle }, make('summary', { html: `Lamp ${line.idle} brings nothing here` +
                (why ? `: ${mathml(why.why)}` : '') }));
            fold.open = open.has(fold.dataset.lamp);
            nodes.push(fold);
        }
        if (line.idle) fold.append(paragraph(line));
        else nodes.push(paragraph(line));
    }
    const result = paragraph(found.lines[found.lines.length - 1], / (?=[=+])/);
    result.append(make('span', {}, ` Stored as sRGB, clamped to 0 … 1: ${found.stored.join(', ')}.`));
    result.className = 'result';
    $('#lines').replaceChildren(...nodes, result);
}
// The vectors at the point as one sees them along the surface, across N and L: both have their whole length,
// and so has R; V and H are shorter as they lean out of the picture.
function showFromSide({ panel }) {
    const svg = $('#from-side'), rem = parseFloat(getComputedStyle(svg).fontSize), on = S['on' + S.lamp];
    const a = (probeMark(), answerAt(wasm.page_factors(0, S.lamp - 1))), lobe = on && usedTerms() & 8;
    const inner = (u, v) => u.reduce((sum, w, i) => sum + w * v[i], 0), N = a.unitN, leads = on ? a.unitL : a.unitV;
    const across = minus(leads, N.map(v => v * inner(N, leads))), scale = Math.hypot(...across) || 1;
    const vectors = [['N', N], ['V', a.unitV], ...(on ? [['L', a.unitL]] : []), ...(lobe ? [['H', a.unitH]] : [])].map(([css, v]) => {
        const [X, Y] = [-inner(v, across) / scale, -inner(v, N)];
        return { css, X, Y, long: Math.hypot(X, Y), angle: Math.atan2(X, -Y) * 180 / Math.PI };
    });
    // of a vector's length what is drawn below the surface
    const sinks = Math.max(0, ...vectors.map(({ Y }) => Y)), far = (svg.clientHeight - 2.8 * rem) / (1 + sinks);
    const x = far + 1.5 * rem, y = far + 1.6 * rem, place = setApart(vectors.map(({ angle }) => angle), 70 * rem / far);
    const letter = css => bare(`\\mathbf{${css === 'H' && panel.model === 1 ? 'R' : css}}`);
    const degrees = v => Math.round(Math.acos(limit(v, -1, 1)) * 180 / Math.PI), dot = (u, v) => `${letter(u)} · ${letter(v)}`;
    const lines = !on ? [`lamp ${S.lamp} is off`] : [`lamp ${S.lamp}`, `${bare('\\theta')} = ${degrees(a.nl)}°`, `${dot('N', 'L')} = ${figure(a.nl)}`,
        ...(!lobe ? [] : [`${bare(panel.model === 1 ? '\\phi' : '\\omega')} = ${degrees(a.base)}°`,
            `${panel.model === 1 ? dot('H', 'V') : dot('N', 'H')} = ${figure(a.base)}`])];
    // an angle to one of these is not as it is drawn
    const leaning = vectors.filter(({ long }) => long < 0.97).map(({ css }) => letter(css));
    if (leaning.length) lines.push(`${leaning.join(', ')}: foreshortened`);
    const arc = on && turned(degrees(a.nl), 0.42 * far);
    svg.innerHTML = `<line class="surface" x2="${2 * x}" y1="${y}" y2="${y}"/>` +
        (on ? `<path class="arc" d="M${x} ${y - 0.42 * far}A${0.42 * far} ${0.42 * far} 0 0 0 ${x - arc[0]} ${y + arc[1]}"/>` : '') +
        vectors.map(({ css, X, Y, long, angle }) => {
            const [tx, ty] = turned(place.get(angle), long * far + 0.75 * rem);
            return `<g class="${css}"><line x1="${x}" y1="${y}" x2="${x + far * X}" y2="${y + far * Y}"/>` +
                head(css, far * X, far * Y, x + far * X, y + far * Y) + `<text x="${x + tx}" y="${y + ty}">${letter(css)}</text></g>`;
        }).join('') + lines.map((text, i) => `<text class="values" x="${2 * x + rem}" y="${(1 + 1.5 * i) * rem}">${text.replace('= -', '= −')}</text>`).join('');
}
// While it is open it follows the point and the controls.
function showExplanation() {
    const found = $('#explanation').open && explanation();
    if (found) writeLines(found), showFromSide(found);
}
function buildExplain() {
    $('#models').append(make('button', { type: 'button', id: 'explain', 'data-name': 'explain',
        title: 'Every line of the equation with its numbers: E', onclick: explain }, 'Explain this pixel'));
    addEventListener('keydown', event => {
        if (event.key === 'Escape' && $('#explanation').open) { $('#explanation').close(); return; }
        if (modified(event) || event.key !== 'e' || S.raster || S.lecture || document.querySelector('dialog[open]')) return;
        explain(), event.preventDefault();
    });
}
