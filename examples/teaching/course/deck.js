// deck.js - what slides add to reveal.js: letters that keep their share of the height, pictures that live in
// frames, words that move them, and the same pictures on paper.
const html = document.documentElement, paper = /print-pdf/.test(location.search);
html.classList.toggle('paper', paper);
const letter = () => parseFloat(getComputedStyle(html).fontSize);
// Slides are as large as the screen, never scaled: a live picture gets the pixels that it is shown with.
const size = () => paper ? { width: 960, height: 720 } : { width: innerWidth, height: innerHeight };
const current = () => Reveal.getCurrentSlide();

// Its number, and its place in the notes
function numberOf(slide) {
    const all = Reveal.getSlides(), place = slide && slide.dataset.place;
    return `${all.indexOf(slide) + 1} / ${all.length}${place ? ' · ' + place : ''}`;
}

function begin() {
    Reveal.initialize({
        ...size(), margin: 0, minScale: 1, maxScale: 1, center: false, hash: true, display: 'grid',
        transition: 'none', backgroundTransition: 'none', controls: true, controlsTutorial: false,
        pdfSeparateFragments: false, pdfMaxPagesPerSlide: 1, scrollActivationWidth: 0, preloadIframes: false, viewDistance: 2,
        slideNumber: (slide = current()) => [numberOf(slide)],
        keyboardCondition: event => !event.ctrlKey && !event.altKey && !event.metaKey,
        plugins: [RevealNotes],
    });
    if (!paper) addEventListener('resize', () => Reveal.configure(size()));
    Reveal.on('slidechanged', ({ previousSlide }) => {
        if (previousSlide) previousSlide.classList.remove('zoomed');
        mark(current().querySelector('a.play'));
    });
    Reveal.on('ready', () => mark(current().querySelector('a.play')));
    Reveal.addKeyBinding({ keyCode: 65, key: 'A', description: 'Answer' }, answer);
    Reveal.addKeyBinding({ keyCode: 90, key: 'Z', description: 'The picture alone' }, zoom);
    for (let i = 1; i <= 9; i++)
        Reveal.addKeyBinding({ keyCode: 48 + i, key: String(i), description: 'Word ' + i }, () => {
            const word = current().querySelectorAll('a.play')[i - 1];
            if (word) word.click();
        });
    document.getElementById('all').addEventListener('click', () => Reveal.toggleOverview());
    document.getElementById('zoom').addEventListener('click', zoom);
    document.addEventListener('click', event => {
        const word = event.target.closest('a.play');
        if (word && !event.ctrlKey && !event.metaKey) {
            event.preventDefault();
            move(word);
        } else if (event.target.closest('figure') && !Reveal.isOverview()) zoom();
    });
}
// The answer of this slide, or of the question that follows it, is shown or hidden.
function answer() {
    const here = current(), next = here.nextElementSibling;
    if (!here.querySelector('.answer') && next && next.classList.contains('ask')) Reveal.next();
    const shown = current().querySelector('.answer');
    if (shown) shown.classList.contains('visible') ? Reveal.prevFragment() : Reveal.nextFragment();
}
function zoom() {
    if (current().querySelector('figure')) current().classList.toggle('zoomed');
}
// A word moves the picture of its slide, which is not loaded anew.
function move(word) {
    const frame = document.getElementsByName(word.target)[0];
    frame.contentWindow.postMessage({ go: word.hash.slice(1) }, '*');
    mark(word);
}
// The word whose state the picture shows
function mark(word) {
    if (!word) return;
    for (const other of word.closest('section').querySelectorAll('a.play'))
        other.toggleAttribute('aria-current', other === word);
}

// ---- frames: they learn how large letters are, and hand back the keys that turn slides
addEventListener('message', ({ data }) => {
    if (!data || data.namespace) return;
    if (!data.key || !Reveal.isReady()) return;
    document.activeElement.blur();      // the next key is the deck's at once
    focus();
    Reveal.triggerKey(KEYS[data.key] || data.key.toUpperCase().charCodeAt(0));
});
const KEYS = { PageDown: 34, PageUp: 33, Home: 36, End: 35, Escape: 27, Enter: 13, ArrowLeft: 37, ArrowUp: 38,
    ArrowRight: 39, ArrowDown: 40, '.': 190 };
const tell = frame => frame.contentWindow.postMessage({ letter: letter() }, '*');
document.addEventListener('load', ({ target }) => {
    if (target.tagName === 'IFRAME' && target.getAttribute('src')) tell(target);
}, true);
addEventListener('resize', () => document.querySelectorAll('iframe[src]').forEach(tell));

// ---- paper: one frame draws the picture of every slide, one after the other
async function drawAll() {
    const frame = document.createElement('iframe'), views = document.querySelectorAll('figure.live iframe');
    const heard = test => new Promise(done => {
        const listen = ({ data }) => {
            if (!data || !test(data)) return;
            removeEventListener('message', listen), done(data);
        };
        addEventListener('message', listen);
    });
    if (!views.length) return;
    frame.style.cssText = 'position:fixed;left:0;top:0;width:440px;height:440px;border:0';
    frame.src = 'index.html#bare&turn=0&with=none';
    const loaded = new Promise(done => frame.addEventListener('load', done));
    document.body.append(frame);
    await loaded;
    for (const view of views) {
        const draw = view.dataset.src.split('#')[1], answer = heard(data => data.drawn === draw);
        frame.contentWindow.postMessage({ letter: letter(), draw }, '*');
        const image = document.createElement('img');
        image.alt = view.title, image.src = (await answer).picture;
        view.replaceWith(image);
    }
    frame.remove();
}
function numberPages() {
    for (const page of document.querySelectorAll('.pdf-page'))
        page.querySelector('.slide-number-pdf').textContent = numberOf(page.querySelector('section'));
    window.printable = true;            // for print.mjs
}
if (paper) drawAll().then(begin).then(() => Reveal.on('pdf-ready', numberPages));
else begin();
