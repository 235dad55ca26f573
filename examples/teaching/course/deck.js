// deck.js - what slides add to reveal.js: letters that keep their share of the height, one live picture that
// moves from slide to slide, words that change it, all slides at once, and the same on paper.
const html = document.documentElement, paper = /print-pdf/.test(location.search);
html.classList.toggle('paper', paper);
const letter = () => parseFloat(getComputedStyle(html).fontSize);
// Slides are as large as the screen, never scaled: a live picture gets the pixels that it is shown with.
const size = () => paper ? { width: 960, height: 720 } : { width: innerWidth, height: innerHeight };
const current = () => Reveal.getCurrentSlide();
const make = (tag, more, ...inside) => {
    const node = Object.assign(document.createElement(tag), more);
    node.append(...inside);
    return node;
};

// Its number, and its place in the notes
function numberOf(slide) {
    const all = Reveal.getSlides(), place = slide && slide.dataset.place;
    return `${all.indexOf(slide) + 1} / ${all.length}${place ? ' · ' + place : ''}`;
}
// What it is called, in words: of a formula its letters
function nameOf(slide) {
    const title = slide.querySelector('h1, h2').cloneNode(true);
    for (const tex of title.querySelectorAll('annotation')) tex.remove();
    return title.textContent.trim();
}

function begin() {
    Reveal.initialize({
        ...size(), margin: 0, minScale: 1, maxScale: 1, center: false, hash: true, display: 'grid',
        transition: 'none', backgroundTransition: 'none', controls: true, controlsTutorial: false, overview: false,
        pdfSeparateFragments: false, pdfMaxPagesPerSlide: 1, scrollActivationWidth: 0,
        slideNumber: (slide = current()) => [numberOf(slide)],
        keyboardCondition: event => !event.ctrlKey && !event.altKey && !event.metaKey && !overview.open,
        plugins: [RevealNotes],
    });
    document.querySelectorAll('section.build').forEach(number);
    if (!paper) addEventListener('resize', () => Reveal.configure(size()));
    Reveal.on('slidechanged', ({ previousSlide }) => {
        if (previousSlide) previousSlide.classList.remove('zoomed');
        enter();
    });
    for (const event of ['fragmentshown', 'fragmenthidden']) Reveal.on(event, enter);
    Reveal.on('ready', enter);
    const bind = (keyCode, key, description, does) => Reveal.addKeyBinding({ keyCode, key, description }, does);
    bind(65, 'A', 'Answer', answer);
    bind(90, 'Z', 'The picture alone', zoom);
    bind(79, 'O', 'All slides', all);
    bind(27, 'Escape', 'All slides', all);
    for (let i = 1; i <= 9; i++) bind(48 + i, String(i), 'Word ' + i, () => {
        const word = current().querySelectorAll('a.play')[i - 1];
        if (word) word.click();
    });
    document.getElementById('all').addEventListener('click', all);
    document.getElementById('zoom').addEventListener('click', zoom);
    document.addEventListener('click', event => {
        const word = event.target.closest('a.play');
        if (word && !event.ctrlKey && !event.metaKey) {
            event.preventDefault();
            show(word);
        } else if (event.target.closest('figure')) zoom();
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
    if (current().querySelector('figure')) current().classList.toggle('zoomed'), place();
}

// ---- an equation that grows: each piece comes with the word that adds its term
function number(slide) {
    const words = [...slide.querySelectorAll('a.play')];
    const pieces = [...slide.querySelectorAll('.equation :is(mtd, mtd > mrow:not([class])) > :not(mrow:not([class]))')];
    const step = (piece, i) => {
        const text = piece.textContent, css = piece.className || piece.getAttribute('class');
        if (text === '+') return step(pieces[i + 1], i + 1) === 4 ? 2 : step(pieces[i + 1], i + 1);
        return piece.tagName === 'mfrac' ? 4 : /^[I=]$/.test(text) || css === 'e' ? 0
            : css === 'a' || /^[∑{}]/.test(text) ? 1 : css === 's' ? 3 : 2;
    };
    pieces.forEach((piece, i) => {
        const s = step(piece, i);
        if (s) piece.classList.add('fragment'), piece.setAttribute('data-fragment-index', s - 1);
    });
    words.forEach((word, i) => { if (i) word.setAttribute('data-fragment-index', i - 1); });
}

// ---- the live picture: one frame, which lies over the figure of the slide that is shown
const frame = make('iframe', { className: 'live' });
let wanted = '';                        // the address that it must show, of which it says when it does
const figure = () => current().querySelector('figure.live');
function place() {
    const box = figure() && figure().getBoundingClientRect();
    if (box) for (const side of ['left', 'top', 'width', 'height']) frame.style[side] = box[side] + 'px';
    frame.classList.toggle('shown', !!box && frame.shows === wanted && !overview.open);
}
function show(word) {
    for (const other of current().querySelectorAll('a.play')) other.toggleAttribute('aria-current', other === word);
    go(word.hash.slice(1));
}
function go(address) {
    wanted = address;
    place(), tell({ go: wanted });
}
function enter() {
    const words = [...current().querySelectorAll('a.play')].filter(word => !word.closest('.fragment:not(.visible)'));
    if (figure()) frame.title = 'Live picture: ' + nameOf(current());
    if (words.length && figure()) show(words[current().classList.contains('build') ? words.length - 1 : 0]);
    else if (figure()) go(figure().dataset.first.split('#')[1]);
    else wanted = '', place();
}
const tell = message => frame.contentWindow && frame.contentWindow.postMessage({ letter: letter(), ...message }, '*');
// It says what it shows, and hands back the keys that turn slides.
const KEYS = { PageDown: 34, PageUp: 33, Home: 36, End: 35, Escape: 27, Enter: 13, ArrowLeft: 37, ArrowUp: 38,
    ArrowRight: 39, ArrowDown: 40, '.': 190 };
addEventListener('message', ({ data, source }) => {
    if (!data || source !== frame.contentWindow) return;
    if (data.ready) tell(wanted ? { go: wanted } : {});
    if (data.shows !== undefined) frame.shows = data.shows, place();
    if (data.focus) frame.blur(), focus();
    if (!data.key || !Reveal.isReady()) return;
    document.activeElement.blur();      // the next key is the deck's at once
    focus();
    Reveal.triggerKey(KEYS[data.key] || data.key.toUpperCase().charCodeAt(0));
});
addEventListener('resize', () => requestAnimationFrame(() => { if (Reveal.isReady()) place(), tell({}); }));
document.addEventListener('scroll', () => { if (Reveal.isReady()) place(); }, true);

// The picture of an address as an image, for paper and for the overview
const drawn = (address, scale = 1) => new Promise(done => {
    const listen = ({ data }) => {
        if (!data || data.drawn !== address) return;
        removeEventListener('message', listen), done(data.picture);
    };
    addEventListener('message', listen);
    tell({ draw: address, scale });
});

// ---- all slides at once, by their parts
const overview = document.getElementById('overview');
async function all() {
    if (overview.open) { overview.close(); return; }
    const parts = new Map();
    Reveal.getSlides().forEach((slide, i) => {
        const list = parts.get(slide.dataset.part || '') || make('ol', {});
        parts.set(slide.dataset.part || '', list);
        const still = slide.querySelector('figure img'), live = slide.querySelector('figure.live');
        const button = make('button', { type: 'button', onclick: () => { overview.close(), Reveal.slide(i); } },
            still ? make('img', { src: still.src, alt: '', className: still.className }) : live
                ? make('img', { alt: '' }) : make('span', { className: 'words' }), make('span', {}, `${i + 1} ${nameOf(slide)}`));
        button.toggleAttribute('aria-current', slide === current());
        button.draws = live && live.dataset.first.split('#')[1];
        list.append(make('li', {}, button));
    });
    overview.replaceChildren(make('div', {}, ...[...parts].flatMap(([part, list]) => [make('h2', {}, part), list])));
    overview.showModal(), place();
    (overview.querySelector('[aria-current]') || overview).scrollIntoView({ block: 'center' });
    overview.querySelector('[aria-current]').focus();
    for (const button of [...overview.querySelectorAll('button')].filter(button => button.draws)) {
        if (!overview.open) return;
        button.firstChild.src = pictures[button.draws] = pictures[button.draws] || await drawn(button.draws, 0.5);
    }
}
const pictures = {};
overview.addEventListener('close', () => enter());
overview.addEventListener('keydown', event => {
    const buttons = [...overview.querySelectorAll('button')], at = buttons.indexOf(document.activeElement);
    const to = { ArrowRight: at + 1, ArrowDown: at + 1, ArrowLeft: at - 1, ArrowUp: at - 1 }[event.key];
    if (/^[oO]$/.test(event.key)) overview.close();
    else if (buttons[to]) buttons[to].focus();
    else return;
    event.preventDefault(), event.stopPropagation();
});

// ---- paper: the frame draws the picture of every slide, one after the other
async function drawAll() {
    frame.style.cssText = 'width:440px;height:440px';
    for (const view of document.querySelectorAll('figure.live'))
        view.replaceChildren(make('img', { alt: nameOf(view.closest('section')),
            src: await drawn(view.dataset.paper.split('#')[1]) }));
    frame.remove();
}
function numberPages() {
    for (const page of document.querySelectorAll('.pdf-page'))
        page.querySelector('.slide-number-pdf').textContent = numberOf(page.querySelector('section'));
    window.printable = true;            // for print.mjs
}
const views = document.querySelectorAll('figure.live');
if (views.length) {
    frame.src = views[0].dataset.first;
    document.body.append(frame);
}
if (paper) (views.length ? new Promise(done => frame.addEventListener('load', done)).then(drawAll)
    : Promise.resolve()).then(begin).then(() => Reveal.on('pdf-ready', numberPages));
else begin();
