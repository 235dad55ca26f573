// slide.js - the page in a frame of slides: the deck says how large letters are and what to show, gets back the
// keys that turn slides, and takes pictures for paper and for its overview.

const DECK_KEYS = ['PageDown', 'PageUp', 'Home', 'End', 'Escape', 'a', 'o', 's', 'z', 'f', 'b', '.'];
let deck = null;                        // the window of the slides
addEventListener('message', async ({ data, source }) => {
    if (source !== parent || parent === window || !data) return;
    deck = parent;
    if (data.letter > 0) {
        document.documentElement.classList.add('slide');
        document.documentElement.style.fontSize = data.letter + 'px';
        readTheme();
    }
    if (typeof data.go !== 'string' && typeof data.draw !== 'string') return;
    while (!shown.length) await new Promise(done => setTimeout(done, 20));
    if (typeof data.go === 'string') goNow(data.go);
    else drawForPaper(data.draw, data.scale || 1);
});
// Shows an address at once: what the deck places next is this and not what was there before.
function goNow(hash) {
    history.replaceState(null, '', '#' + hash);
    readAddress(), refresh();
    frame(performance.now());
    deck.postMessage({ shows: hash }, '*');
}
// Keys are the deck's but for a control that was reached by Tab; what a finger or a mouse has let go of gives
// them back. A flick sideways turns the slide.
const isDeck = () => S.bare && deck;
addEventListener('keydown', event => {
    if (!isDeck() || event.defaultPrevented || modified(event)) return;
    const free = event.target === document.body && /^(Arrow.*|Enter| |[1-9])$/.test(event.key);
    const key = event.key.length > 1 ? event.key : event.key.toLowerCase();
    if (!free && !DECK_KEYS.includes(key)) return;
    event.preventDefault();
    deck.postMessage({ key }, '*');
});
let touched = null;
addEventListener('pointerdown', event => { touched = event; }, true);
addEventListener('pointerup', event => {
    if (!isDeck()) return;
    const x = event.clientX - touched.clientX, flick = event.pointerType === 'touch' && event.target === canvas &&
        event.timeStamp - touched.timeStamp < 300 && Math.abs(x) > 60;
    setTimeout(() => {
        document.activeElement.blur();
        deck.postMessage(flick ? { key: x < 0 ? 'ArrowRight' : 'ArrowLeft' } : { focus: true }, '*');
    });
}, true);

// Draws the picture of an address, with what lies over it, without waiting for frames.
async function drawForPaper(hash, scale) {
    history.replaceState(null, '', '#' + hash.replace(/with=[^&]*/, 'with=none'));
    readAddress(), refresh();
    const whole = (S.raster ? $('#grid') : canvas).getBoundingClientRect(), ratio = scale * finest();
    const [width, height] = [whole.width, whole.height].map(v => Math.max(3, Math.floor(v * ratio)));
    const copy = make('canvas', { width, height }), on = copy.getContext('2d');
    if (!S.raster) {
        [canvas.width, canvas.height] = [width, height];
        context.putImageData(new ImageData(draw(width, height, ratio), width), 0, 0);
        showAnswer(marked(width, height));
        on.drawImage(canvas, 0, 0);
    }
    for (const svg of document.querySelectorAll(S.raster ? '#grid' : '#arrows, #curve.shown, .plane #plane, .lobe #lobe')) {
        const box = svg.getBoundingClientRect();
        on.drawImage(await still(svg, ratio), (box.x - whole.x) * ratio, (box.y - whole.y) * ratio);
    }
    deck.postMessage({ drawn: hash, picture: copy.toDataURL() }, '*');
}
// What lies over the canvas, with the styles of the page
async function still(svg, ratio) {
    const copy = svg.cloneNode(true), image = new Image(), { width, height } = svg.getBoundingClientRect();
    const style = $('style').textContent + `:root { font-size: ${document.documentElement.style.fontSize} }`;
    copy.prepend(make('style', {}, style));
    copy.setAttribute('xmlns', 'http://www.w3.org/2000/svg');
    if (!svg.hasAttribute('viewBox')) copy.setAttribute('viewBox', `0 0 ${width} ${height}`);
    copy.setAttribute('width', width * ratio), copy.setAttribute('height', height * ratio);
    image.src = 'data:image/svg+xml,' + encodeURIComponent(new XMLSerializer().serializeToString(copy));
    await image.decode();
    return image;
}
if (parent !== window) parent.postMessage({ ready: true }, '*');
