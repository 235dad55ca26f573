// slide.js - the page in a frame of a slide: the slide says how large letters are, gets back the keys that
// turn it, and asks for pictures on paper.

const DECK_KEYS = ['PageDown', 'PageUp', 'Home', 'End', 'Escape', 'a', 'o', 's', 'z', 'f', 'b', '.'];
addEventListener('message', ({ data, source }) => {
    if (source !== parent || parent === window || !data) return;
    if (data.letter > 0) {
        document.documentElement.classList.add('slide');
        document.documentElement.style.fontSize = data.letter + 'px';
    }
    if (typeof data.go === 'string') {
        history.replaceState(null, '', '#' + data.go);
        readAddress(), refresh();
    }
    if (typeof data.draw === 'string') drawForPaper(source, data.draw);
});
addEventListener('keydown', event => {
    if (!S.bare || parent === window || event.defaultPrevented) return;
    if (event.ctrlKey || event.altKey || event.metaKey) return;
    const free = event.target === document.body && /^(Arrow.*|Enter| |[1-9])$/.test(event.key);
    const key = event.key.length > 1 ? event.key : event.key.toLowerCase();
    if (!free && !DECK_KEYS.includes(key)) return;
    event.preventDefault();
    parent.postMessage({ key }, '*');
});

// Draws the picture of an address, with the arrows over it, without waiting for frames.
async function drawForPaper(slide, hash) {
    while (!wasm || !shown.length) await new Promise(done => setTimeout(done, 20));
    history.replaceState(null, '', '#' + hash.replace(/with=[^&]*/, 'with=none'));
    readAddress(), refresh();
    const [width, height] = [canvas.width, canvas.height] = size(finest());
    context.putImageData(new ImageData(draw(width, height, finest()), width), 0, 0);
    showAnswer(marked(width, height));
    const copy = make('canvas', { width, height }), on = copy.getContext('2d');
    on.drawImage(canvas, 0, 0);
    for (const svg of document.querySelectorAll('#arrows, #curve.shown')) on.drawImage(await still(svg), 0, 0);
    slide.postMessage({ drawn: hash, picture: copy.toDataURL() }, '*');
}
// What lies over the canvas, with the styles of the page
async function still(svg) {
    const copy = svg.cloneNode(true), image = new Image();
    const style = $('style').textContent + `:root { font-size: ${document.documentElement.style.fontSize} }`;
    copy.prepend(make('style', {}, style));
    copy.setAttribute('xmlns', 'http://www.w3.org/2000/svg');
    copy.setAttribute('viewBox', `0 0 ${canvas.clientWidth} ${canvas.clientHeight}`);
    copy.setAttribute('width', canvas.width), copy.setAttribute('height', canvas.height);
    image.src = 'data:image/svg+xml,' + encodeURIComponent(new XMLSerializer().serializeToString(copy));
    await image.decode();
    return image;
}
