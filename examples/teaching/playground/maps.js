// maps.js - where the lamps stand: a map from the front and one from above, in which they can be
// dragged, or moved by the arrow keys.  Beside them the vectors of the marked point from above, V
// among them, which in the picture points at the viewer and so is a dot.

// what is to the right and what is down on a map, as parts of a position and signs
const MAPS = [{ name: 'front', right: 0, down: 1, sign: -1 },
    { name: 'above', right: 0, down: 2, sign: 1 }];
const UNIT = 10;                        // of the world, in the units of a map
const REACH = 66;                       // from its middle to its edge

const svg = (tag, attributes) => {
    const node = document.createElementNS('http://www.w3.org/2000/svg', tag);
    for (const name in attributes) node.setAttribute(name, attributes[name]);
    return node;
};
const onMap = (map, p) => [UNIT * p[map.right], UNIT * map.sign * p[map.down]];

function buildMaps() {
    for (const map of MAPS) {
        const root = svg('svg', { viewBox: `${-REACH} ${-REACH} ${2 * REACH} ${2 * REACH}`,
            class: 'map' });
        const title = svg('text', { x: -REACH + 5, y: -REACH + 15, class: 'name' });
        title.textContent = 'lamps, ' + map.name;
        map.point = svg('circle', { r: 2 });
        map.eye = svg('path', { d: 'M-5,4L0,-3L5,4Z', class: 'eye' });
        root.append(svg('circle', { r: UNIT, class: 'model' }), title, map.point);
        root.addEventListener('pointerdown', event => grab(map, event));
        if (map.name === 'above') root.append(map.eye);
        map.lamps = LAMPS.map(j => lampOn(map, root, j));
        $('#maps').append(root);
    }
    shown.push(() => MAPS.forEach(map => map.lamps.forEach((node, i) => showLamp(map, node, i + 1))));
}

// The lamp nearest to the pointer, if it is on its grip, or a finger within 24 pixels
function grab(map, event) {
    const distance = node => {
        const { x, y, width, height } = node.getBoundingClientRect();
        return Math.hypot(event.clientX - x - width / 2, event.clientY - y - height / 2);
    };
    const far = map.lamps.map(distance), j = 1 + far.indexOf(Math.min(...far));
    const node = map.lamps[j - 1], grip = node.getBoundingClientRect().width / 2;
    if (far[j - 1] > (event.pointerType === 'touch' ? Math.max(24, grip) : grip)) return;
    node.setPointerCapture(event.pointerId);
    S.lamp = j;
    changed();
}

function lampOn(map, root, j) {
    const node = svg('g', { class: 'bulb', tabindex: 0, role: 'slider', 'aria-valuemin': -6,
        'aria-valuemax': 6, 'aria-label': `Lamp ${j}, ${map.name}` });
    const label = svg('text', { 'text-anchor': 'middle', dy: 4.5 });
    label.textContent = j;
    node.append(svg('circle', { r: 12, class: 'grip' }), svg('circle', { r: 8.5 }), label);
    root.append(node);
    node.addEventListener('pointermove', event => {
        if (!node.hasPointerCapture(event.pointerId)) return;
        const at = new DOMPoint(event.clientX, event.clientY)
            .matrixTransform(root.getScreenCTM().inverse());
        moveLamp(map, j, at.x / UNIT, map.sign * at.y / UNIT);
    });
    node.addEventListener('keydown', event => {
        const way = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -map.sign],
            ArrowDown: [0, map.sign] }[event.key], p = S['p' + j];
        if (!way || modified(event)) return;
        const step = event.shiftKey ? 1 : 0.1;
        S.lamp = j;
        moveLamp(map, j, p[map.right] + step * way[0], p[map.down] + step * way[1]);
        event.preventDefault(), speak();
    });
    return node;
}
function moveLamp(map, j, right, down) {
    const p = [...S['p' + j]], fit = v => limit(Math.round(100 * v) / 100, -6, 6);
    p[map.right] = fit(right), p[map.down] = fit(down);
    S['p' + j] = p, changed();
}
function showLamp(map, node, j) {
    const p = S['p' + j], [x, y] = onMap(map, p), light = S['I' + j];
    const names = 'xyz', text = k => `${names[k]} ${+p[k].toFixed(2)}`;
    node.setAttribute('transform', `translate(${x} ${y})`);
    node.setAttribute('aria-valuenow', p[map.right]);
    node.setAttribute('aria-valuetext', text(map.right) + ', ' + text(map.down));
    node.children[1].style.fill = S['on' + j]
        ? hex(light.map(v => v / Math.max(1e-3, ...light))) : 'none';
    node.classList.toggle('off', !S['on' + j]);
    node.classList.toggle('far', !!S['far' + j]);
    node.classList.toggle('held', S.lamp === j);
}

// The marked point in the maps, and its vectors as they are from above, the longest 60 units long
function showMaps(answer, last) {
    const distance = Math.min(6.1, camera(canvas.width, canvas.height).distance);
    for (const map of MAPS) {
        const [x, y] = onMap(map, answer.place);
        map.eye.setAttribute('transform', `translate(0 ${UNIT * distance})`);
        map.point.setAttribute('transform', `translate(${x} ${y})`);
        map.point.style.display = answer.hit ? '' : 'none';
    }
    let html = '<text x="-60" y="-16" class="name">vectors, above</text>';
    for (const name of answer.hit ? ['V', 'H', 'L', 'N'] : []) {
        if (name === 'L' && !S['on' + S.lamp]) continue;
        const [x, y] = onMap(MAPS[1], answer['unit' + name]).map(v => 6 * v);
        html += `<g class="${name}"><line x2="${x}" y2="${y}"/>` + head(name, x, y, x, y) +
            (Math.hypot(x, y) < 14 ? '' : `<text x="${1.17 * x}" y="${1.17 * y}" dy="5" ` +
                `text-anchor="${name === 'H' ? 'end' : 'middle'}">${name === 'H' ? last : name}</text>`) + '</g>';
    }
    put($('#side'), html + '<circle r="4"/>');
}
