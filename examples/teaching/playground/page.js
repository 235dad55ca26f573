// page.js - the playground's half in JavaScript: controls, pointer, address, equation, program.
// State is a set of decimal numbers of at most four places.  The module takes them as floats, the
// address keeps them, the C program prints them: all three mean the same bits.

// ---- the state: what each number is called, may be, and is at first -----------------------------

const TERMS = ['emission', 'ambient', 'diffuse', 'specular'];
const MODELS = ['Blinn–Phong', 'Phong', 'Lambert', 'Ambient', 'Emissive', 'Cool to warm'];
const FLAGS = [['two-sided', 'N is turned toward the viewer'], ['|N·L|', 'in the diffuse term'],
    ['ungated', 'no B: highlights reach behind the terminator'],
    ['weighted', 'the highlight times N·L'],
    ['attenuated ambient', 'of a lamp, by cone and distance'],
    ['distant eye', 'V is the same everywhere']];
const LAMPS = [1, 2, 3];

const MARK = [-0.0557, 0.2281, 0.4574]; // on the teapot, beside the highlight of lamp 1

// name: [lowest, highest, first value ...]
const FIELDS = {
    shape: [0, 4, 0], detail: [1, 24, 12], room: [0, 1, 0], view: [0, 2, 0], compare: [0, 1, 0],
    wire: [0, 1, 0], vectors: [0, 1, 1], maps: [0, 1, 1], curve: [0, 1, 0], lobe: [0, 1, 0],
    mark: [-20, 20, ...MARK], part: [0, 1, 0], panel: [0, 2, 1],
    turn: [0, 1, 1], model: [0, 5, 0], shading: [0, 2, 0], flags: [0, 63, 0], terms: [1, 15, 15],
    lamp: [1, 3, 1], yaw: [-7, 7, 0.5], pitch: [-1.6, 1.6, 0.4], zoom: [0.4, 4, 1],
    // the vectors in a plane: degrees from N to L and to V; rays: 1 for R, 2 for H, 4 for a bent surface, 8 for -R
    plane: [0, 1, 0], toL: [-180, 180, -40], toV: [-180, 180, 20], rays: [0, 15, 3],
    simd: [0, 1, 1], lecture: [0, 5, 0], bare: [0, 1, 0],
    // the stepper of the rasterizer; a triangle is three corners of x, y and w
    raster: [0, 1, 0], order: [0, 1, 0], step: [0, 576, 0], count: [1, 3, 2], hand: [1, 3, 1],
    cell: [-1, 15, -1, -1], t1: [-2, 18, 3.5, 1.5, 3, 3.5, 9.5, 3, 11.5, 9.5, 3],
    t2: [-2, 18, 3.5, 1.5, 3, 11.5, 9.5, 3, 11.5, 1.5, 3], t3: [-2, 18, 1, 10, 2, 15, 11, 2, 8, 2, 5],
    ke: [0, 1, 0, 0, 0], ka: [0, 1, 0.02, 0.16, 0.2], kd: [0, 1, 0.02, 0.16, 0.2],
    ks: [0, 1, 0.7, 0.7, 0.7], n: [0, 256, 81], Ia: [0, 1, 0.1, 0.11, 0.13],
    ...lamp(1, 1, 0, [3, 2.5, 3.5], [1.9, 1.75, 1.5], 0),
    ...lamp(2, 1, 1, [-5, 1.5, -2], [0.7, 0.8, 1.2], 0),
    ...lamp(3, 0, 0, [0, 4, 1], [1, 0.6, 0.2], 0.1, 25, 4),
};
function lamp(j, on, far, position, color, c, beta = 180, e = 0) {
    return { ['on' + j]: [0, 1, on], ['far' + j]: [0, 1, far], ['p' + j]: [-6, 6, ...position],
        ['I' + j]: [0, 3, ...color], ['A' + j]: [0, 1, 0, 0, 0], ['a' + j]: [0, 2, 1],
        ['b' + j]: [0, 1, 0], ['c' + j]: [0, 1, c], ['beta' + j]: [1, 180, beta],
        ['e' + j]: [0, 64, e] };
}
// those that are whole numbers
const WHOLE = RegExp('^(plane|toL|toV|rays|shape|detail|room|view|compare|wire|vectors|maps|curve|lobe|part|panel|turn|' +
    'model|shading|flags|terms|lamp|simd|lecture|bare|raster|order|step|count|hand|cell|on.|far.)$');

const S = {};
let course = '';                        // in whose letters symbols are: letters=uw
let asked = [];                         // names of the controls that a bare page shows: with=n,c1
const round = v => Math.round(v * 1e4) / 1e4 + 0;
const limit = (v, low, high) => Math.min(Math.max(v, low), high);

function setField(name, values) {
    const [low, high, ...first] = FIELDS[name];
    if (values.length !== first.length || !values.every(Number.isFinite)) return;
    const fit = values.map(v => limit(WHOLE.test(name) ? Math.round(v) : round(v), low, high));
    S[name] = fit.length > 1 ? fit : fit[0];
}
function readAddress() {
    readHash = location.hash;
    const given = new URLSearchParams(location.hash.slice(1));
    for (const name in FIELDS) setField(name, FIELDS[name].slice(2));
    setField('lecture', [Number(given.get('lecture'))]);
    before = { ...S, lecture: 0 };
    Object.assign(S, stepState(S.lecture), { bare: +given.has('bare') });
    letters = LETTERS[course = given.get('letters')] || {};
    asked = (given.get('with') || '').split(',').filter(name => /^[a-zA-Z]+\d*$/.test(name));
    for (const name of asked)                           // with=c2 is a row of lamp 2
        if (FIELDS[name] && /[a-zA-Z][123]$/.test(name)) S.lamp = +name.slice(-1);
    pointed = null;
    for (const name in FIELDS) {
        const text = given.get(name);
        if (text) setField(name, text.split(',').map(Number));
    }
    if (S.shape === 2 && !fileName) {                   // a file stays on its own machine
        S.shape = 0;
        say('This address shows a model that it cannot hold: drop its file here.');
    }
    if (!given.has('turn') && matchMedia('(prefers-reduced-motion: reduce)').matches) S.turn = 0;
}
let readHash = '';                      // of the page, as it was read or written last
function writeAddress() {
    history.replaceState(null, '', address());
    readHash = location.hash;
}
function address() {
    const parts = Object.keys(FIELDS).filter(name =>
        String(S[name]) !== String(FIELDS[name].slice(2)));
    const shown = parts.map(name => name + '=' + S[name]);
    if (asked.length) shown.push('with=' + asked);
    if (LETTERS[course]) shown.push('letters=' + course);
    return '#' + shown.join('&');
}

// ---- the module ---------------------------------------------------------------------------------

let wasm, kind, fileName = '';
const floats = (at, n) => new Float32Array(wasm.memory.buffer, at, n);
function text(at) {
    const bytes = new Uint8Array(wasm.memory.buffer, at);
    return new TextDecoder().decode(bytes.slice(0, bytes.indexOf(0)));
}
async function loadModule() {
    const bytes = base64 => Uint8Array.from(atob(base64), c => c.charCodeAt(0));
    const simd = bytes(WASM.simd);
    kind = S.simd && WebAssembly.validate(simd) ? 'simd' : 'plain';
    const made = await WebAssembly.instantiate(kind === 'simd' ? simd : bytes(WASM.plain),
        { env: { exp: Math.exp, log: Math.log } });
    wasm = made.instance.exports;
}

const bounds = () =>
    Array.from(floats(wasm.page_bounds(S.shape, S.detail), 5), v => +v.toPrecision(6));

// Where the camera stands: the ball around the model fits a panel; most models are flatter than it.
const HIGH = [0.82, 1.06, 1.06, 0.4, 0.85];
function camera(width, height) {
    const aspect = (S.compare && !S.view ? Math.floor(width / 3) : width) / height;
    const wide = 1.06 / Math.sin(Math.atan(Math.tan(0.25) * aspect));
    const distance = round(Math.max(wide, HIGH[S.shape] / Math.sin(0.25)) / S.zoom);
    const room = S.room && !S.view;
    return { distance, near: round(Math.max(distance - (room ? 4 : 1.05), 0.05)),
        far: round(distance + (room ? 12 : 1.05)) };
}

// The floats of page_state, in its order
let alone = 0;                          // the one term that is shown, as its bit; 0: all that are on
// lines are as thick on a slide as its letters want them
const thick = () => document.documentElement.classList.contains('slide')
    ? Math.max(1, parseFloat(getComputedStyle(document.documentElement).fontSize) / 14) : 1;
function words(width, height, pen, terms = alone || S.terms) {
    const { distance, near, far } = camera(width, height), [x, y, z, radius, tall] = bounds();
    return [width, height, S.shape, S.view, S.compare && !S.view, S.wire * pen * thick(), S.model, S.shading,
        S.flags, terms, S.lamp - 1, S.detail, S.room, floorOf(radius, tall), S.yaw, S.pitch,
        distance, near, far, scaleOf(radius), x, y, z,
        ...paper, ...ink, ...S.ke, ...S.ka, ...S.kd, ...S.ks, S.n, ...S.Ia,
        ...LAMPS.flatMap(j => [S['on' + j], S['far' + j], S['p' + j], S['I' + j], S['A' + j],
            S['a' + j], S['b' + j], S['c' + j], S['beta' + j], S['e' + j]].flat())];
}
const scaleOf = radius => +(1 / radius).toPrecision(6);
const floorOf = (radius, tall) => round(-tall / radius);

function tell(list) { floats(wasm.page_input(), list.length).set(list); }
function draw(width, height, pen) {
    tell(words(width, height, pen));
    const at = wasm.page_draw();
    tell(words(width, height, pen, S.terms));           // which a probe is about
    return new Uint8ClampedArray(wasm.memory.buffer, at, 4 * width * height);
}

const ANSWER = { hit: 1, part: 1, hidden: 1, mark: 3, emission: 3, ambient: 3, diffuse: 3, specular: 3, sceneAmbient: 3,
    lampAmbient: 3, lampDiffuse: 3, lampSpecular: 3, r: 1, attenuation: 1, spot: 1, gate: 1, nl: 1,
    base: 1, power: 1, point: 2, N: 2, L: 2, V: 2, H: 2, place: 3, unitN: 3, unitL: 3, unitV: 3,
    unitH: 3, weights: 3, corners: 9, normals: 9, ke: 3, ka: 3, kd: 3, ks: 3, n: 1 };
const probe = (x, y) => answerAt(wasm.page_probe(x, y));
const probeMark = () => answerAt(wasm.page_probe_mark(S.panel, S.part, ...S.mark));
function answerAt(at) {
    const answer = {};
    for (const name in ANSWER) {
        const n = ANSWER[name], values = Array.from(floats(at, n));
        answer[name] = n > 1 ? values : values[0];
        at += 4 * n;
    }
    return answer;
}

async function openFile(file) {
    say('Reading ' + file.name + ' …');
    await new Promise(done => setTimeout(done, 30));    // lets the line above appear
    try {
        if (file.size > 1e9) throw Error(file.name + ': too large for this page');
        const bytes = new Uint8Array(await file.arrayBuffer());
        const name = new TextEncoder().encode(file.name.replace(/[^\x20-\x7e]/g, '_'));
        const at = wasm.page_room(bytes.length + name.length + 1);
        if (!at) throw Error(file.name + ': too large for this page');
        const room = new Uint8Array(wasm.memory.buffer, at, bytes.length + name.length + 1);
        room.set(bytes), room.set(name, bytes.length), room[room.length - 1] = 0;
        const wrong = text(wasm.page_load(at, bytes.length, at + bytes.length));
        if (wrong) throw Error(/\.(obj|stl|ply|gltf|glb)$/i.test(file.name) ? wrong
            : file.name + ': is no model; OBJ, STL, PLY and glTF can be opened');
        fileName = file.name;
        S.shape = 2;
        say(fileName + ': ' + wasm.page_triangles(2).toLocaleString('en') + ' triangles');
        changed();
    } catch (error) {
        say(error.name === 'Error' ? error.message : file.name + ': cannot be read');
    }
}

// ---- colour -------------------------------------------------------------------------------------

const encode = v => v <= 0.0031308 ? 12.92 * v : 1.055 * v ** (1 / 2.4) - 0.055;
const decode = v => v <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4;
const hex = rgb => '#' + rgb.map(v =>
    Math.round(255 * encode(limit(v, 0, 1))).toString(16).padStart(2, '0')).join('');
const fromHex = text => [1, 3, 5].map(i => round(decode(parseInt(text.slice(i, i + 2), 16) / 255)));
const luminance = rgb => 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];

let paper, ink;
function readTheme() {
    const style = getComputedStyle(document.documentElement);
    [paper, ink] = ['--scene', '--ink'].map(name => fromHex(style.getPropertyValue(name).trim()));
}

// ---- controls -----------------------------------------------------------------------------------

const $ = selector => document.querySelector(selector);
function make(tag, attributes, ...children) {
    const node = document.createElement(tag);
    for (const name in attributes) {
        if (name.startsWith('on')) node.addEventListener(name.slice(2), attributes[name]);
        else if (name === 'html') node.innerHTML = attributes.html;
        else node.setAttribute(name, attributes[name]);
    }
    node.append(...children);
    return node;
}

const shown = [];                       // each refreshes one control from the state
const controls = $('#controls');
const group = (title, ...children) =>
    make('fieldset', {}, make('legend', {}, title), ...children);

function choice(name, title, labels, values = labels.map((_, i) => i)) {
    return make('div', { class: 'choice', role: 'radiogroup', 'aria-label': title,
        'data-name': name }, ...labels.map((label, i) => {
        const input = make('input', { type: 'radio', name, value: values[i],
            onchange: () => { S[name] = values[i], changed(); } });
        shown.push(() => { input.checked = S[name] === values[i]; });
        return make('label', {}, input, make('span', {}, label));
    }));
}
// A switch for a field, or for one bit of it
function toggle(name, label, title = '', bit = 1) {
    const input = make('input', { type: 'checkbox', name: bit > 1 ? name + bit : name,
        onchange: () => {
            S[name] ^= bit;
            if (name === 'terms' && !S.terms) S.terms = 15;    // no term would mean all of them
            changed();
        } });
    shown.push(() => { input.checked = !!(S[name] & bit); });
    return make('label', { class: 'toggle', title,
        'data-name': FIELDS[name][1] > 1 ? name + bit : name }, input, make('span', { html: label }));
}
function symbol(tex, title) {
    const word = `<small>${title.split(' ')[0]}</small>`;
    return make('span', { class: 'symbol', title, html: mathml(tex) + word });
}
// What with= calls a row: its field, without the number of the lamp
const rowName = name => typeof name === 'string' ? name : name().replace(/\d$/, '');
// A row: symbol, slider, number.  name() is the field, which for lamps depends on the one chosen;
// part: of a vector.  curve 2: fine at the low end.
function slider(name, tex, title, { css = '', step = 0.01, curve = 1, part = -1,
    low = FIELDS[typeof name === 'string' ? name : name()][0],
    high = FIELDS[typeof name === 'string' ? name : name()][1] } = {}) {
    const field = () => typeof name === 'string' ? name : name();
    const value = () => part < 0 ? S[field()] : S[field()][part];
    const to = v => Math.sign(v) * Math.abs(v) ** (1 / curve);
    const number = make('span', { class: 'number' });
    const input = make('input', { type: 'range', min: to(low), max: to(high), step,
        'aria-label': title, oninput: () => {
            const v = round(Math.sign(input.value) * Math.abs(input.value) ** curve);
            if (part < 0) S[field()] = v;
            else S[field()] = S[field()].map((old, i) => i === part ? v : old);
            changed();
        } });
    shown.push(() => {
        input.value = to(value());
        number.textContent = +value().toFixed(2);
        input.setAttribute('aria-valuetext', number.textContent);
    });
    return make('div', { class: 'row ' + css, 'data-name': rowName(name) }, symbol(tex, title), input,
        number);
}
// A row: symbol, colour, slider of its brightest component, number
function color(name, tex, title, css = '') {
    const field = () => typeof name === 'string' ? name : name();
    const hues = {}, high = FIELDS[field()][1], number = make('span', { class: 'number' });
    const set = rgb => { S[field()] = rgb.map(v => limit(round(v), 0, high)), changed(); };
    const picker = make('input', { type: 'color', 'aria-label': title + ', colour',
        oninput: () => set(fromHex(picker.value)) });
    const input = make('input', { type: 'range', min: 0, max: high, step: 0.01,
        'aria-label': title + ', amount', oninput: () => {
            const hue = hues[field()] || [1, 1, 1];
            set(hue.map(v => v * input.value));
        } });
    shown.push(() => {
        const rgb = S[field()], most = Math.max(...rgb);
        if (most > 0 && document.activeElement !== input) hues[field()] = rgb.map(v => v / most);
        picker.value = hex(rgb.map(v => v / Math.max(1, most)));
        input.value = most;
        number.textContent = +most.toFixed(2);
        input.setAttribute('aria-valuetext', number.textContent);
    });
    return make('div', { class: 'row ' + css, 'data-name': rowName(name) }, symbol(tex, title), picker,
        input, number);
}

// Small balls, each drawn by the module in its material
function presets() {
    const list = make('div', { class: 'presets', role: 'group', 'aria-label': 'Materials',
        'data-name': 'presets' }), kept = { ...S };
    const size = Math.round(40 * Math.max(2, devicePixelRatio));
    for (let i = 0, name; (name = text(wasm.page_preset_name(i))); i++) {
        const m = Array.from(floats(wasm.page_preset(i), 13), round);
        const values = { ke: m.slice(0, 3), ka: m.slice(3, 6), kd: m.slice(6, 9),
            ks: m.slice(9, 12), n: m[12] };
        const canvas = make('canvas', { width: size, height: size });
        Object.assign(S, values, { shape: 1, detail: 12, room: 0, view: 0, compare: 0, wire: 0, model: 0, shading: 0,
            flags: 0, terms: 15, zoom: 1.08, on1: 1, far1: 1, p1: [3, 4, 5], I1: [1.2, 1.2, 1.2],
            beta1: 180, on2: 0, on3: 0, Ia: [0.5, 0.5, 0.5] });
        canvas.getContext('2d').putImageData(new ImageData(draw(size, size, 1), size), 0, 0);
        list.append(make('button', { type: 'button', title: name, 'aria-label': name,
            onclick: () => { Object.assign(S, values), changed(); } }, canvas));
    }
    Object.assign(S, kept);
    return list;
}

function buildControls() {
    const file = make('input', { type: 'file', accept: '.obj,.stl,.ply,.gltf,.glb',
        'aria-label': 'Open a model', onchange: () => {
            if (file.files[0]) openFile(file.files[0]);
            file.value = '';
        } });
    const shapes = choice('shape', 'Model', ['Teapot', 'Sphere', 'Balls', 'Ribbon', 'File'],
        [0, 1, 3, 4, 2]);
    const own = shapes.lastChild.firstChild, of = field => () => field + S.lamp;
    shown.push(() => { own.disabled = own.parentNode.hidden = !fileName; });
    const on = make('label', { class: 'toggle', 'data-name': 'on' });
    const far = make('label', { class: 'toggle', 'data-name': 'far' });
    // the lamp in hand goes to a place that the courses speak of
    const place = (label, ...to) => make('button', { type: 'button', onclick: () => {
        S['p' + S.lamp] = to, changed();
    } }, label);
    for (const [label, field, name] of [[on, 'on', 'on'], [far, 'far', 'at infinity']]) {
        const input = make('input', { type: 'checkbox', name: field, onchange: () => {
            S[field + S.lamp] ^= 1, changed();
        } });
        shown.push(() => { input.checked = !!S[field + S.lamp]; });
        label.append(input, make('span', {}, name));
    }
    const row = (...nodes) => make('div', { class: 'buttons' }, ...nodes);
    const places = row(place('aside', 3, 2.5, 3.5), place('above', 0, 5, 1), place('behind', -3, 1, -3),
        place('at the eye', 0, 0, 6));
    places.dataset.name = 'place';
    const named = text => text.replace(/\b[NLV]\b/g, name => bare(`\\mathbf{${name}}`));
    const flags = row(...FLAGS.map((texts, i) => {
        const flag = toggle('flags', ...texts, 1 << i);
        shown.push(() => { [flag.lastChild.textContent, flag.title] = texts.map(named); });
        return flag;
    }));
    flags.dataset.name = 'flags';
    controls.append(
        group('Model', row(shapes, make('label', { class: 'open' }, file,
            make('span', {}, 'Open …'))),
            slider('detail', '\\text{mesh}', 'fineness of the mesh', { step: 1 })),
        group('Picture', choice('view', 'Picture', ['Light', 'Normals', 'Depth']),
            row(toggle('room', 'floor', 'a floor and a wall behind'), toggle('wire', 'wire'),
                toggle('vectors', 'vectors'), toggle('maps', 'lamps'), toggle('turn', 'turning')),
            row(toggle('curve', 'brightness', 'along a line through the marked point, term by term'),
                toggle('lobe', 'lobe', 'of the highlight, as a curve around its axis'))),
        group('Material', presets(),
            color('ke', 'k_e', 'emission', 'e'),
            color('ka', 'k_a', 'ambient reflection', 'a'),
            color('kd', 'k_d', 'diffuse reflection', 'd'),
            color('ks', 'k_s', 'specular reflection', 's'),
            slider('n', 'n', 'shininess', { css: 's', curve: 2 })),
        group('Light', color('Ia', 'I_a', 'ambient light of the scene', 'a'),
            row(choice('lamp', 'Lamp in hand', ['Lamp 1', '2', '3'], LAMPS), on, far), places,
            color(of('I'), 'I_d,\\,I_s', 'light of the lamp', 'lamps'),
            color(of('A'), 'I_{La}', 'ambient light of the lamp', 'a'),
            ...['x', 'y', 'z'].map((axis, part) =>
                slider(of('p'), `\\text{lamp}_${axis}`, 'position ' + axis, { part, step: 0.1 })),
            slider(of('a'), 'a', 'constant attenuation'),
            slider(of('b'), 'b', 'linear attenuation'),
            slider(of('c'), 'c', 'quadratic attenuation'),
            slider(of('beta'), '\\beta', 'cutoff in degrees, 180 for no cone', { step: 1 }),
            slider(of('e'), 'e', 'exponent of the cone', { curve: 2 })),
        group('Shading by', choice('shading', 'Shading by', ['Pixel', 'Vertex', 'Face'])),
        group('Flags', flags));
    controls.append($('#links').content);
    buildEquation();
    buildMaps();
    buildLecture();
    buildRaster();
    buildExplain();
    buildPlane();
}
// A bare page shows the controls that with= names.
function showAsked() {
    const plain = new Set([...asked, ...asked.map(name => /^(flags|terms)/.test(name) ? name
        : name.replace(/[123]$/, ''))]);
    for (const node of document.querySelectorAll('[data-name]'))
        node.classList.toggle('asked', plain.has(node.dataset.name));
    document.body.classList.toggle('with', !!S.bare && asked.length > 0);
}

// ---- the equation -------------------------------------------------------------------------------

const cells = {};
const VECTORS = { NL: '\\mathbf{N}\\cdot\\mathbf{L}', NH: '\\mathbf{N}\\cdot\\mathbf{H}',
    RV: '\\mathbf{R}\\cdot\\mathbf{V}' };
// A piece of the formula over its values
function piece(name, css, tex) {
    const formula = make('span', { class: 'f', html: tex && mathml(tex) });
    cells[name] = { formula, values: make('span', { class: 'v' }) };
    const node = make('span', { class: 'piece ' + css }, formula, cells[name].values);
    if (!'eads'.includes(css)) return node;
    node.tabIndex = 0;
    for (const begin of ['pointerenter', 'focus'])
        node.addEventListener(begin, () => showAlone(css));
    for (const end of ['pointerleave', 'pointercancel', 'blur'])
        node.addEventListener(end, () => showAlone(''));
    return node;
}
// While the pointer or the focus is on a term: its part of the picture, and the rows that make it
function showAlone(css) {
    const bit = css && 1 << 'eads'.indexOf(css);
    alone = bit & usedTerms();
    if (css) controls.dataset.term = css;
    else delete controls.dataset.term;
    stale = true, request();
}
const usedTerms = () => [15, 15, 7, 3, 1, 5][shownModel().model] & S.terms;
function buildEquation() {
    const mark = html => make('span', { class: 'mark', html });
    const brace = html => make('span', { class: 'brace', html });
    $('#models').append(choice('model', 'Shading model', MODELS),
        toggle('compare', 'Phong | Blinn–Phong | 4<i>n</i>', 'the three side by side'));
    const line = (...nodes) => make('span', { class: 'line' }, ...nodes);
    $('#formula').append(line(
        piece('total', 'total', 'I'), mark('='),
        piece('emission', 'e', 'k_e'), mark('+'),
        piece('sceneAmbient', 'a', 'k_a I_a'), mark('+')), line(
        piece('lamp', 'lamp', '\\sum_j'), brace('{'),
        piece('lampAmbient', 'a', 'k_a I_{La}'), mark('+'),
        piece('arriving', 'arriving', '\\frac{\\text{spot}}{a + b r + c r^2}'),
        piece('gate', 'gate', 'B'), brace('('),
        piece('lampDiffuse', 'd', ''), mark('+'),
        make('span', { class: 'last' }, piece('lampSpecular', 's', ''), brace(')'), brace('}'))));
    $('#formula').dataset.name = 'formula';
    $('#sum').dataset.name = 'terms';
    $('#sum').append(...TERMS.map((name, i) => {
        const label = toggle('terms', name, 'switch this term on or off', 1 << i);
        label.classList.add(name[0]);
        cells['sum' + name] = { values: make('span', { class: 'v' }) };
        label.lastChild.append(cells['sum' + name].values);
        return label;
    }));
}
// The model and exponent of the panel that the point lies in
function shownModel() {
    const panel = pointed ? Math.floor(3 * pointed[0]) : S.panel, compare = S.compare && !S.view;
    return { model: compare ? +(panel < 1) : S.model, n: compare && panel > 1 ? '4n' : 'n' };
}
function showFormula({ model, n }) {
    const gooch = model === 5, weight = S.flags & 8 ? `(${VECTORS.NL})` : '';
    const used = usedTerms();
    const off = { emission: !(used & 1), sceneAmbient: !(used & 2), lampAmbient: !(used & 2),
        lampDiffuse: !(used & 4), lampSpecular: !(used & 8), gate: S.flags & 4 || gooch,
        arriving: gooch };
    for (const name in off)
        cells[name].formula.parentNode.classList.toggle('off', !!off[name]);
    put(cells.lampDiffuse.formula, mathml(gooch ? '\\text{cool} + k_w (\\text{warm} - \\text{cool})'
        : `k_d I_d ${S.flags & 2 ? `|${VECTORS.NL}|` : `(${VECTORS.NL})`}`));
    put(cells.lampSpecular.formula,
        mathml(`k_s I_s ${weight} (${model === 1 ? VECTORS.RV : VECTORS.NH})^{${n}}`));
}

const figure = v => (Math.abs(v) < 9.995 ? v.toFixed(2) : v.toFixed(1)).replace(/^(-?)0\./, '$1.');
const channel = (v, i, clips) => `<span class="${'RGB'[i]}${clips && v > 1 ? ' clip' : ''}"` +
    `${clips && v > 1 ? ' title="above 1: stored as 1"' : ''}>${figure(v)}</span>`;
const triple = (rgb, clips) => `<s style="background:${hex(rgb)}"></s>` +
    rgb.map((v, i) => channel(v, i, clips)).join(' ');
function put(node, html) {
    if (node.kept !== html) node.innerHTML = node.kept = html;
}
function showAnswer(answer) {
    const sums = TERMS.map(name => answer[name]), { model, n } = shownModel();
    const total = [0, 1, 2].map(k => sums.reduce((sum, rgb) => sum + rgb[k], 0));
    const base = model === 1 ? VECTORS.RV : VECTORS.NH;
    const value = (name, html) => put(cells[name].values, answer.hit ? html : '–');
    showFormula({ model, n });
    value('total', triple(total, true));
    for (const name of ['emission', 'sceneAmbient', 'lampAmbient'])
        value(name, triple(answer[name]));
    value('arriving', figure(answer.spot * answer.attenuation) +
        `<small>${mathml('r')} = ${answer.r > 1e9 ? '∞' : figure(answer.r)}</small>`);
    value('gate', String(answer.gate));
    value('lampDiffuse', triple(answer.lampDiffuse) +
        `<small>${mathml(VECTORS.NL)} = ${figure(answer.nl)}</small>`);
    value('lampSpecular', triple(answer.lampSpecular) +
        `<small>${mathml(base)} = ${figure(answer.base)}</small>` +
        `<small>${mathml(`(${base})^{${n}}`)} = ${figure(answer.power)}</small>`);
    put(cells.lamp.values, `<small>lamp ${S.lamp}${S['on' + S.lamp] ? '' : ', off'}</small>`);
    TERMS.forEach((name, i) => value('sum' + name, triple(sums[i], true)));
    const light = sums.map(luminance), all = light.reduce((a, b) => a + b, 0) || 1;
    [...$('#bar').children].forEach((node, i) => {
        node.style.width = 100 * light[i] / all + '%';
    });
    showVectors(answer, model === 1 ? 'R' : 'H');
    showMaps(answer, model === 1 ? 'R' : 'H');
    showLobe(answer);
    showCurve(answer);
    showExplanation();
}
// An arrow's head at (X, Y), which is (dx, dy) from where it begins; a diamond for H, so that H and N
// differ by more than colour
function head(name, dx, dy, X, Y, large = 1) {
    const length = Math.hypot(dx, dy), a = 11 * large / length, b = 4 * large / length;
    if (length < 14) return '';
    const tail = name === 'H' ? `${X - 2 * a * dx},${Y - 2 * a * dy} ` : '';
    return `<polygon points="${X},${Y} ${X - a * dx + b * dy},${Y - a * dy - b * dx} ${tail}` +
        `${X - a * dx - b * dy},${Y - a * dy + b * dx}"/>`;
}
function showVectors(answer, last) {
    const svg = $('#arrows'), ratio = canvas.clientWidth / canvas.width;
    const at = p => p.map(v => (v * ratio).toFixed(1));
    const large = Math.max(1, innerWidth / (S.lecture ? 1400 : 1920)), rem = parseFloat(getComputedStyle(svg).fontSize);
    let html = '';
    if (answer.hit) {
        const [x, y] = at(answer.point);
        if (S.vectors && !S.view) for (const name of ['V', 'H', 'L', 'N']) {
            const [X, Y] = at(answer[name]), far = Math.hypot(X - x, Y - y);
            if (name === 'L' && !S['on' + S.lamp] || name === 'H' && !(usedTerms() & 8)) continue;
            const label = far < 20 ? '' : bare(`\\mathbf{${name === 'H' ? last : name}}`);
            const [tx, ty] = [X - x, Y - y].map(v => 0.5 * rem * v / far);
            html += `<g class="${name}"><line x1="${x}" y1="${y}" x2="${X}" y2="${Y}"/>` + head(name, X - x, Y - y, X, Y, large) +
                (label && `<text x="${X}" y="${Y}" dx="${tx}" dy="${ty}">${label}</text>`) + '</g>';
        }
        html += `<circle cx="${x}" cy="${y}" r="${4 * large}"/>`;
    }
    svg.innerHTML = html;
    svg.classList.toggle('hidden', !!answer.hidden);
}

// ---- frames: as many pixels as time allows while something moves, all of them at rest -----------

const canvas = $('figure canvas'), context = canvas.getContext('2d', { alpha: false });
const MOST = 4 << 20;                   // PAGE_MOST of page.c
const LEAST = 1.5;                      // in motion: 2.25 samples a pixel of the page
const times = [];                       // of the last pictures, ms
let quality = LEAST, requested = 0, last = 0, moved = -1000, stale = true, probeAfter = 0;
// The point that is marked: one of the picture, as parts of its width and height, while a pointer is
// on it; else a point of the object, S.mark, which turns with it and stands in the address.
let pointed = null, hovering = false;

const finest = () => {
    const pixels = Math.max(1, canvas.clientWidth * canvas.clientHeight);
    return Math.min(Math.max(2, devicePixelRatio), Math.sqrt(MOST / pixels));
};
function size(scale) {
    return [canvas.clientWidth, canvas.clientHeight].map(v => Math.max(3, Math.floor(v * scale)));
}
function request() {
    if (!requested) requested = requestAnimationFrame(frame);
}
function refresh() {
    for (const show of shown) show();
    document.body.classList.toggle('bare', !!S.bare);
    document.body.classList.toggle('lobe', !!S.lobe);
    showAsked();
    $('#panels').hidden = !(S.compare && !S.view);
    document.body.classList.toggle('unmapped', !S.maps || !!(S.compare && !S.view));
    stale = true, request();
}
function changed() {
    moved = performance.now(), refresh();
    clearTimeout(changed.timer);
    changed.timer = setTimeout(() => {
        // a link that was followed since then is read first
        if (location.hash === readHash) writeAddress();
    }, 300);
}
function frame(now) {
    requested = 0;
    if (S.raster) { stale = false; return; }
    const turning = S.turn && !pointers.size, moving = turning || now - moved < 200;
    const scale = moving ? Math.min(Math.floor(8 * quality) / 8, finest()) : finest();
    const [width, height] = size(scale), begin = performance.now();
    if (turning) {
        S.yaw = round(S.yaw + Math.min(now - last, 50) * 0.0004);
        if (S.yaw > 3.1416) S.yaw = round(S.yaw - 6.2832);
    }
    if (stale || moving) {
        const picture = draw(width, height, scale);
        if (canvas.width !== width || canvas.height !== height)
            canvas.width = width, canvas.height = height;
        context.putImageData(new ImageData(picture, width), 0, 0);
        adapt(performance.now() - begin, moving);
        stale = moving;                 // once more at rest
    }
    const asked = performance.now();
    clearTimeout(frame.timer);
    if (asked > probeAfter) {           // a model of a million triangles is asked less often
        const answer = marked(width, height);
        probeAfter = asked + 8 * Math.max(0, performance.now() - asked - 3);
        showAnswer(answer);
    } else frame.timer = setTimeout(request, probeAfter - asked + 1);
    if (stale) request();
    last = now;
}
function marked(width, height) {
    if (!pointed) return probeMark();
    const answer = probe(pointed[0] * width, pointed[1] * height);
    if (answer.hit) {
        S.mark = answer.mark.map(round);
        S.part = answer.part;
        if (S.compare && !S.view) S.panel = limit(Math.floor(3 * pointed[0]), 0, 2);
        if (!hovering) pointed = null, changed();
    }
    return answer;
}
function adapt(spent, moving) {
    $('#speed').textContent =
        `${canvas.width} × ${canvas.height}, ${spent.toFixed(1)} ms, ${kind}`;
    if (!moving) return;
    if (spent > 300 && S.turn) S.turn = 0, refresh();    // huge: turned by hand alone
    times.push(spent);
    if (times.length < 12) return;
    const median = times.sort((a, b) => a - b)[6];
    if (median > 11) quality = Math.max(LEAST, quality * Math.sqrt(9 / median));
    else if (median < 7) quality = Math.min(finest(), quality * 1.15);
    times.length = 0;
}

// ---- pointer, keys, files -----------------------------------------------------------------------

const pointers = new Map();
// By so many pixels of a drag
function turn(x, y) {
    S.turn = 0;
    S.yaw = round((S.yaw + 0.009 * x + 9.4248) % 6.2832 - 3.1416);
    S.pitch = limit(round(S.pitch + 0.009 * y), -1.5708, 1.5708);
    changed();
}
// Ctrl, Alt and Meta belong to the browser.
const modified = event => event.ctrlKey || event.altKey || event.metaKey;
// Moves the mark by a hundredth of the picture.
function nudge(step) {
    const { point } = probeMark(), from = pointed ||
        [point[0] / canvas.width, point[1] / canvas.height];
    hovering = false;
    pointed = from.map((v, i) => limit(v + step[i] * 0.01, 0, 1));
    request();
}
function zoom(factor) { S.zoom = limit(round(S.zoom * factor), 0.4, 4), changed(); }
function point(event) {
    const box = canvas.getBoundingClientRect();
    pointed = [(event.clientX - box.x) / box.width, (event.clientY - box.y) / box.height];
    hovering = true, request();
}
function spread() {
    const [a, b] = [...pointers.values()];
    return Math.hypot(a.clientX - b.clientX, a.clientY - b.clientY);
}
function listen() {
    canvas.addEventListener('pointerdown', event => {
        canvas.setPointerCapture(event.pointerId);
        pointers.set(event.pointerId, event), point(event);
    });
    canvas.addEventListener('pointermove', event => {
        const old = pointers.get(event.pointerId);
        const before = pointers.size === 2 ? spread() : 0;
        if (old) pointers.set(event.pointerId, event);
        if (old && before) zoom(spread() / Math.max(1, before));
        else if (old) turn(event.clientX - old.clientX, event.clientY - old.clientY);
        point(event);
    });
    for (const end of ['pointerup', 'pointercancel'])
        canvas.addEventListener(end, event => { pointers.delete(event.pointerId), changed(); });
    canvas.addEventListener('pointerleave', () => {
        if (!pointers.size) hovering = false, pointed = null, changed();
    });
    canvas.addEventListener('wheel', event => {
        event.preventDefault(), zoom(Math.exp(-limit(event.deltaY, -200, 200) * 0.0015));
    }, { passive: false });
    canvas.addEventListener('keydown', event => {
        const way = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
        const step = way[event.key];
        if (modified(event) || (S.lecture && !event.shiftKey)) return;
        if (step && event.shiftKey) nudge(step);
        else if (step) turn(9 * step[0], 9 * step[1]);
        else if (event.key === '+' || event.key === '=') zoom(1.1);
        else if (event.key === '-') zoom(1 / 1.1);
        else if (event.key === ' ') S.turn ^= 1, changed();
        else return;
        event.preventDefault(), speak();
    });
    addEventListener('dragover', event => event.preventDefault());
    addEventListener('drop', event => {
        event.preventDefault();
        if (event.dataTransfer.files[0]) openFile(event.dataTransfer.files[0]);
    });
    addEventListener('hashchange', () => { readAddress(), refresh(); });
    new ResizeObserver(refresh).observe(canvas);
    matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => {
        readTheme(), refresh();
    });
    for (const id of ['#share', '#share-raster']) $(id).addEventListener('click', async () => {
        writeAddress();
        say(await copy(location.href) ? 'The address is copied.' : 'The address shows this.');
    });
    $('#reset').addEventListener('click', () => {
        for (const name in FIELDS) setField(name, FIELDS[name].slice(2));
        pointed = null, changed();
    });
    const showProgram = text => {
        $('#program pre').textContent = text, $('#program').showModal();
    };
    $('#code').addEventListener('click', () => showProgram(program()));
    $('#by-hand').addEventListener('click', () => showProgram('/* Of examples/lessons/47_by_hand.c.  In ' +
        'shade.h search for >>terms, one at one point, and >>lit, all at many. */\n' + BY_HAND));
    $('#copy').addEventListener('click', async () => {
        $('#copy').textContent = await copy($('#program pre').textContent) ? 'Copied' : 'Select it';
        setTimeout(() => { $('#copy').textContent = 'Copy'; }, 1500);
    });
}
async function copy(words) {
    try { await navigator.clipboard.writeText(words); return true; } catch { return false; }
}
function say(line) {
    $('#message').textContent = line;
    clearTimeout(say.timer);
    say.timer = setTimeout(() => { $('#message').textContent = ''; }, 6000);
}
// For those who hear the page: what the equation says, once a key has been let go
function speak() {
    clearTimeout(speak.timer);
    speak.timer = setTimeout(() => {
        $('#spoken').textContent = TERMS.map(name =>
            name + ' ' + cells['sum' + name].values.textContent).join(', ');
    }, 600);
}

// ---- begin --------------------------------------------------------------------------------------

async function begin() {
    readAddress(), readTheme();
    await loadModule();
    buildControls(), listen(), refresh();
}
