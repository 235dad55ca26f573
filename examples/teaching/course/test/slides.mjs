// slides.mjs - the courses in a real browser: pages, slides on screens of seven sizes, their keys, fingers,
// frames and paper; and each word that moves a picture changes what it names.   node slides.mjs folder browser
import { chromium } from 'playwright-core';
import fs from 'fs';
import path from 'path';

const [folder, browser_path] = process.argv.slice(2);
let passed = 0, failed = 0;
function check(what, good, more = '') {
    if (good) { passed++; return; }
    failed++;
    console.log(`slides: ${what} ${typeof more === 'object' ? JSON.stringify(more, null, 1) : more}`);
}
async function soon(holds) {
    for (const begin = Date.now(); Date.now() - begin < 30000;) {
        if (await holds()) return true;
        await new Promise(done => setTimeout(done, 50));
    }
    return false;
}
const browser = await chromium.launch({ executablePath: browser_path, args: ['--no-sandbox', '--disable-gpu',
    '--disable-quic', '--no-first-run', '--disable-background-networking', '--disable-component-update'] });
const complaints = [], asked = [];
async function open(name, options = {}, query = '', frames = true) {
    const context = await browser.newContext({ viewport: { width: 1024, height: 768 }, ...options });
    context.setDefaultTimeout(90000);
    const page = await context.newPage();
    page.on('console', line => {
        if (frames || !/ERR_FAILED/.test(line.text())) complaints.push(line.text());
    });
    page.on('pageerror', error => complaints.push(error.stack));
    page.on('request', request => asked.push(request.url()));
    if (!frames) await page.route('**/index.html*', route => route.abort());
    await page.goto('file://' + path.join(folder, name) + query);
    return page;
}
async function openDeck(name, options, query, frames = true) {
    const page = await open(name, options, query, frames);
    await page.waitForFunction(() => window.Reveal && Reveal.isReady());
    return page;
}
const named = pattern => fs.readdirSync(folder).filter(name => pattern.test(name));
const decks = named(/^slides-.*\.html$/), pages = named(/^course.*\.html$/);
check('four courses and a first screen', pages.length === 5 && decks.length === 4, [pages, decks]);

// ---- pages: pictures, and nothing beyond the screen ----------------------------------------------

for (const name of pages) {
    const page = await open(name, { viewport: { width: 390, height: 844 } });
    // the widest last: there a figure comes
    for (const [width, height, colorScheme] of [[390, 844, 'dark'], [320, 600, 'light'], [1366, 768, 'light']]) {
        await page.setViewportSize({ width, height });
        await page.emulateMedia({ media: 'screen', colorScheme });
        const what = `${name}, ${width} x ${height}`;
        const lost = await page.evaluate(async () => {
            const images = [...document.images];
            for (const image of images) image.loading = 'eager';
            await Promise.all(images.map(image => image.decode().catch(() => 0)));
            return images.filter(image => !image.naturalWidth).map(image => image.src);
        });
        check('pictures: ' + what, !lost.length, lost);
        check('no wider than the screen: ' + what, await page.evaluate(() =>
            document.documentElement.scrollWidth <= innerWidth));
        check('formulas are MathML with their TeX beside it: ' + what, await page.evaluate(() =>
            [...document.querySelectorAll('math')].every(math =>
                math.querySelector('annotation[encoding="application/x-tex"]').textContent.trim())));
        // one figure a paragraph, in the paragraph that speaks of it: a word moves it, and nothing else
        const live = await page.evaluate(() => [...document.querySelectorAll('article')].filter(article =>
            article.querySelector('a.play')).map(article => [article.querySelectorAll('iframe[loading=lazy]').length,
            [...article.querySelectorAll('a.play')].every(a => a.target === article.querySelector('iframe').name)]));
        check('live figures: ' + what, name === 'courses.html' || live.length > 10 && live.every(([n, own]) => n === 1 && own), live);
        if (width === 1366 && live.length) {
            const word = page.locator('.words > p:has(a.play:nth-of-type(2)) a.play').nth(1);
            await word.scrollIntoViewIfNeeded();
            const name = await word.getAttribute('target'), hash = (await word.getAttribute('href')).split('#')[1];
            const inside = () => page.frames().find(one => one.name() === name);
            check('a figure comes when it is seen: ' + what, await soon(() => inside().url().includes('index.html') &&
                inside().evaluate(() => !!document.querySelector('#controls fieldset'))));
            await word.click();
            check('a word moves it: ' + what, await soon(() => inside().url().endsWith(hash)));
        }
        await page.emulateMedia({ media: 'print' });
        check('answers are printed: ' + what, await page.evaluate(() => [...document.querySelectorAll('details:not(.contents) p')]
            .every(p => p.getBoundingClientRect().height > 0 && p.checkVisibility({ contentVisibilityAuto: true }))));
    }
    await page.context().close();
}
{
    const page = await open('courses.html');
    const links = await page.evaluate(() => [...document.links].map(link => link.getAttribute('href')));
    check('the first screen leads to slides, pages and playground', [...decks, ...pages, 'index.html'].every(
        name => name === 'courses.html' || links.includes(name)), links);
    await page.context().close();
}

// ---- words that move pictures ---------------------------------------------------------------------

// Of each slide the addresses of its words, in their order
const moving = [];
for (const name of decks) {
    const page = await openDeck(name, {}, '', false);
    moving.push(...await page.evaluate(name => Reveal.getSlides().map((slide, i) => ({
        slide: `${name} ${i + 1}`,
        words: [...slide.querySelectorAll('a.play')].map(a => ({ word: a.textContent,
            hash: a.getAttribute('href').split('#')[1] })),
    })).filter(slide => slide.words.length), name));
    await page.context().close();
}
check('slides with live pictures', moving.length > 75, moving.length);
{
    const page = await open('index.html', {}, '#bare&turn=0&with=none');
    await page.waitForFunction(() => document.querySelectorAll('.presets canvas').length === 24);
    const wrong = await page.evaluate(moving => {
        const [W, H] = [200, 150], wrong = [];
        const go = hash => {
            history.replaceState(null, '', '#' + hash);
            readAddress();
            return { ...S };
        };
        // the picture of a state, and what the marked point says where arrows or a curve are shown
        const seen = state => {
            Object.assign(S, state);
            const pixels = draw(W, H, 1).slice(), point = marked(W, H);
            const read = S.vectors || S.curve ? ['N', 'L', 'V', 'H', 'point'].flatMap(name => point[name]) : [];
            return { pixels, read, drawn: S.plane ? [S.toL, S.toV, S.n, S.model, S.rays, S.terms].join() : S.raster ? [S.step, S.order].join()
                : S.curve || S.lobe ? [S.n, S.curve, S.lobe, S.model, ...S.p1].join() : '' };
        };
        const differ = (a, b) => {
            let pixels = 0;
            for (let i = 0; i < a.pixels.length; i += 4)
                pixels += [0, 1, 2].some(k => Math.abs(a.pixels[i + k] - b.pixels[i + k]) > 6);
            return pixels >= 0.004 * W * H || a.drawn !== b.drawn ||
                a.read.some((v, i) => Math.abs(v - b.read[i]) > 4);
        };
        const QUIET = ['lamp', 'bare', 'lecture', 'simd', 'turn'];
        const names = hash => [...new URLSearchParams(hash).keys()].filter(n => FIELDS[n] && !QUIET.includes(n));
        for (const { slide, words } of moving) {
            const states = words.map(({ hash }) => go(hash));
            words.forEach(({ word, hash }, i) => {
                for (const [name, value] of new URLSearchParams(hash))
                    if (FIELDS[name] && !QUIET.includes(name) && String(states[i][name]) !== (value.split(',').map(Number).join() || '1'))
                        wrong.push(`${slide}: ${name} of "${word}" is ${states[i][name]}`);
                const other = words.length > 1 ? states[i ? i - 1 : 1] : null;
                if (!other) return;
                const changed = Object.keys(FIELDS).filter(name =>
                    !QUIET.includes(name) && String(states[i][name]) !== String(other[name]));
                if (!changed.length) wrong.push(`${slide}: "${word}" is its neighbour`);
                // two lamps that are as good as the absolute value, which is tested below
                if (words.some(({ word }) => word === 'opposite each other')) return;
                // where a, b and c are all 0 the falloff is 1, as if a were
                const picture = seen(states[i]), visible = changed.filter(name => /^a[123]$/.test(name) ||
                    differ(picture, seen({ ...states[i], [name]: other[name] })));
                // of a material or a lamp each number need not show alone, but together they must
                if (!differ(picture, seen(other))) wrong.push(`${slide}: "${word}" looks like its neighbour`);
                else if (changed.length < 3 && visible.length < changed.length)
                    wrong.push(`${slide}: of "${word}" ${changed} only ${visible} show`);
            });
            for (const field of (new URLSearchParams(words[0].hash).get('with') || '').split(','))
                if (field !== 'none' && !document.querySelector(`[data-name=${field}], [data-name=${
                    field.replace(/[123]$/, '')}]`)) wrong.push(`${slide}: with=${field} is no control`);
            if (words.some(({ hash }) => !names(hash).length)) wrong.push(`${slide}: an address without a name`);
        }
        return wrong;
    }, moving);
    check('each word shows what it names', !wrong.length, wrong);

    // Shirley's figure 10.3: two opposite lamps are the absolute value
    const figure = moving.find(({ words }) => words.some(({ word }) => word === 'opposite each other'));
    const most = await page.evaluate(hashes => {
        const [two, one] = hashes.map(hash => {
            history.replaceState(null, '', '#' + hash), readAddress();
            return draw(200, 150, 1).slice();
        });
        return two.reduce((most, v, i) => Math.max(most, Math.abs(v - one[i])), 0);
    }, figure.words.map(({ hash }) => hash));
    check('two opposite lamps are the absolute value', most <= 1, most);
    await page.context().close();
}

// ---- what no light reaches is black, and stands out from the picture's ground on a dark slide too ----

for (const colorScheme of ['light', 'dark']) {
    const page = await openDeck('slides-uw.html', { colorScheme }, '#/34');
    const inside = () => page.frames().find(one => one.url().includes('index.html'));
    let contrast;
    check('black on the ground of a picture, ' + colorScheme, await soon(async () =>
        (contrast = inside() && await inside().evaluate(() =>
            typeof paper === 'object' && luminance(paper) / 0.05 + 1)) >= 1.7), contrast);
    await page.context().close();
}

// ---- slides on all screens: nothing beyond them, letters for a hall, ink on paper -------------------

// Of each drawing the size of its letters
const drawings = path.join(folder, 'pictures');
const letters = Object.fromEntries(fs.readdirSync(drawings).filter(name => name.endsWith('.svg')).map(name =>
    [name, +fs.readFileSync(path.join(drawings, name), 'utf8').match(/font: (\d+)px/)[1]]));
for (const name of decks) {
    const page = await openDeck(name, {}, '', false);               // the frames' turn comes below
    for (const [width, height, colorScheme] of [[1024, 768, 'light'], [1366, 768, 'dark'], [1920, 1080, 'light'],
        [3840, 2160, 'dark'], [390, 844, 'light'], [320, 600, 'dark'], [844, 390, 'light']]) {
        const what = `${name}, ${width} x ${height}`;
        await page.setViewportSize({ width, height });
        await page.emulateMedia({ colorScheme });
        await page.waitForFunction(width => innerWidth === width && Reveal.getConfig().width === width, width);
        const wrong = await page.evaluate(letters => {
            const upright = innerWidth < innerHeight, wrong = [];
            const letter = parseFloat(getComputedStyle(document.documentElement).fontSize);
            Reveal.getSlides().forEach((slide, i) => {
                Reveal.slide(i, 0, 9);
                const say = text => wrong.push(`${i + 1} ${slide.querySelector('h1, h2').textContent}: ${text}`);
                const box = selector => {
                    const part = slide.querySelector(selector);
                    return part && part.getBoundingClientRect();
                };
                for (const part of slide.querySelectorAll('h1, h2, p, li, pre, math, figure, figcaption, .answer')) {
                    if (part.closest('.notes')) continue;
                    const { right, bottom } = part.getBoundingClientRect();
                    if (right > innerWidth + 1) say(part.tagName + ' is wider than the screen');
                    if (!upright && bottom > innerHeight - letter * 1.4) say(part.tagName + ' reaches into the row below');
                }
                const [number, tools] = ['.slide-number', '.tools.low'].map(what => document.querySelector(what).getBoundingClientRect());
                if (number.right > tools.left + 1) say('the number runs into the buttons');
                const [equation, statement, figure] = ['.equation', '.statement', 'figure'].map(box);
                const row = slide.querySelector('.equation');
                if (row && !upright && row.scrollWidth > row.clientWidth + 1) say('the equation is cut');
                if (statement && equation && !upright && statement.top < equation.bottom - letter / 4 &&
                    statement.bottom > equation.top + letter / 4)
                    say('the statement runs into the equation');
                const words = slide.querySelector('.statement');
                if (words && !upright && words.scrollHeight > words.clientHeight + letter / 2) say('the statement is higher than its place');
                for (const code of slide.querySelectorAll('.statement pre code')) {
                    const lines = code.textContent.trimEnd().split('\n').length, all = document.createRange();
                    all.selectNodeContents(code);
                    const rows = new Set([...all.getClientRects()].map(box => Math.round(box.top))).size;
                    if (!upright && rows > lines) say(`code of ${lines} lines stands in ${rows}`);
                }
                if (figure && !upright && figure.height < 0.3 * innerHeight) say('the picture is small');
                const drawing = slide.querySelector('figure img[src$=".svg"]'), size = drawing && letters[drawing.src.replace(/.*\//, '')];
                const scale = drawing && Math.min(drawing.clientWidth / drawing.naturalWidth, drawing.clientHeight / drawing.naturalHeight);
                if (drawing && !upright && 0.7 * size * scale < (innerWidth > 1.5 * innerHeight ? 0.03 : 0.023) * innerHeight)
                    say(`letters of the drawing: ${(70 * size * scale / innerHeight).toFixed(1)} %`);
                if (!slide.matches('.first') && !slide.querySelector('figure, pre:not(.notes pre), .equation')) say('text alone');
                if (slide.querySelectorAll('.equation math').length > 1) say('more than one equation');
                // all letters but indices, and the tools' signs
                const nodes = document.createTreeWalker(slide, NodeFilter.SHOW_TEXT);
                while (!upright && nodes.nextNode()) {
                    const of = nodes.currentNode.parentElement;
                    if (!nodes.currentNode.textContent.trim() || of.closest('.notes, math')) continue;
                    const place = document.createRange();
                    place.selectNodeContents(nodes.currentNode);
                    if (place.getBoundingClientRect().right > innerWidth + 1) say('words are cut');
                    const block = of.closest('p, li');
                    place.setEnd(nodes.currentNode, 1);
                    if (block && !of.closest('code') && /^[,.;:)]/.test(place.toString()) && place.getBoundingClientRect().left <
                        block.getBoundingClientRect().left + 2) say('a line begins with ' + place.toString());
                    if (parseFloat(getComputedStyle(of).fontSize) * (of.closest('pre, code') ? 0.729 : 0.7) <
                        0.035 * innerHeight) say('letters of ' + getComputedStyle(of).fontSize);
                }
            });
            const number = document.querySelector('.slide-number');
            if (!upright && parseFloat(getComputedStyle(number).fontSize) * 0.7 < 0.035 * innerHeight)
                wrong.push('the number is small');
            if (document.documentElement.scrollWidth > innerWidth) wrong.push('the page scrolls sideways');
            return wrong;
        }, letters);
        check('slides on the screen: ' + what, !wrong.length, wrong);
        const [paper, ink] = await page.evaluate(() => [[document.body, 'backgroundColor'],
            [document.querySelector('.reveal p'), 'color']].map(([part, of]) => {
            const [r, g, b] = getComputedStyle(part)[of].match(/\d+/g).map(Number);
            return (r + g + b) / 3;
        }));
        check('ink on paper: ' + what, colorScheme === 'dark' ? ink > 180 && paper < 60 :
            ink < 60 && paper > 200, [paper, ink]);
    }
    await page.context().close();
}

// ---- keys ---------------------------------------------------------------------------------------

const at = page => page.evaluate(() => Reveal.getSlides().indexOf(Reveal.getCurrentSlide()));
const answered = page => page.evaluate(() => !!document.querySelector('.present .answer.visible'));
for (const name of decks) {
    const page = await openDeck(name, {}, '', false);
    const steps = await page.evaluate(() => Reveal.getSlides().length - 1 + Reveal.getSlides().reduce((sum, slide) =>
        sum + new Set([...slide.querySelectorAll('.fragment')].map(node => node.dataset.fragmentIndex)).size, 0));
    const keys = ['ArrowRight', 'Space', 'PageDown'];
    for (let i = 0; i < steps; i++) await page.keyboard.press(keys[i % 3]);
    check('keys reach the last slide and show each answer: ' + name, await page.evaluate(() =>
        Reveal.isLastSlide() && document.querySelectorAll('.answer:not(.visible)').length === 0));
    for (let i = 0; i < steps; i++) await page.keyboard.press(i % 2 ? 'PageUp' : 'ArrowLeft');
    check('and the first one: ' + name, await page.evaluate(() => Reveal.isFirstSlide()));
    await page.context().close();
}
{
    const page = await openDeck('slides-uw.html', {}, '#/9');
    const slide = test => page.evaluate(test => Reveal.getSlides().findIndex(Function('s', 'return ' + test)), test);
    const go = i => page.evaluate(i => Reveal.slide(i), i);
    // the one frame, once it shows what the slide wants
    const frameOf = async (deck = page) => {
        await deck.waitForFunction(() => wanted && frame.shows === wanted && frame.classList.contains('shown'));
        return deck.frames().find(one => one.url().includes('index.html'));
    };
    // a question follows: A goes to its answer, and hides it again
    const asking = await slide("s.nextElementSibling && s.nextElementSibling.classList.contains('ask')");
    await go(asking), await page.keyboard.press('a');
    check('A shows the answer', await answered(page) && await at(page) === asking + 1);
    await page.keyboard.press('a');
    check('and hides it', !await answered(page));

    const live = await slide("s.querySelectorAll('a.play').length > 2 && /highlight/.test(s.textContent)");
    await go(live);
    const frame = await frameOf(), picture = () => frame.evaluate(() => canvas.toDataURL());
    const other = async () => ![first, undefined].includes(await picture().catch(() => undefined));
    const first = await picture();
    check('a frame has the letters of the slide', await soon(() => frame.evaluate(() =>
        document.documentElement.style.fontSize)) && await frame.evaluate(() =>
        parseFloat(getComputedStyle(document.querySelector('.asked .symbol')).fontSize) > 0.049 * 768));
    check('and shows its control alone', await frame.evaluate(() =>
        [...document.querySelectorAll('input[type=range], button, header, #formula')].filter(node =>
            node.checkVisibility()).length === 1));
    await page.keyboard.press('2');
    check('2: the second word moves the picture', await soon(other) &&
        await page.evaluate(() => document.querySelector('.present a.play:nth-of-type(2)').hasAttribute('aria-current')));
    await page.keyboard.press('1');
    check('1: the first moves it back', await soon(async () => first === await picture()));
    await frame.locator('input[type=range]:visible').press('ArrowUp');
    check('so does the slider', await soon(other));
    check('and the slide stays', await at(page) === live);
    await frame.locator('canvas').first().click();
    await page.keyboard.press('PageDown');
    check('keys turn slides while the picture has the focus', await soon(async () => await at(page) === live + 1));
    await page.keyboard.press('PageUp');
    check('and go on doing so', await soon(async () => await at(page) === live));
    for (const key of ['Control+ArrowRight', 'Alt+ArrowRight', 'Control+a', 'Meta+ArrowRight']) {
        await page.keyboard.press(key);
        check(key + ' is the browser\'s', await at(page) === live);
    }
    await go(live), await page.keyboard.press('z');
    const large = await page.locator('.present figure').boundingBox();
    const row = await page.locator('.slide-number').boundingBox();
    check('Z: the picture alone', large.width > 1020 && large.height > 670 && large.y + large.height <= row.y, [large, row]);
    await page.keyboard.press('z'), await page.keyboard.press('o');
    check('O: all slides', await page.evaluate(() => document.querySelectorAll('#overview[open] button').length ===
        Reveal.getSlides().length));
    check('each with its name in words', await page.evaluate(() => [...document.querySelectorAll('#overview button')].every(button =>
        /^\d+ [^\\{}]+$/.test(button.textContent))));
    check('each with its picture', await soon(() => page.evaluate(() => [...document.querySelectorAll(
        '#overview button')].every(button => !button.draws || button.firstChild.src.startsWith('data:')))));
    for (const [width, height] of [[1024, 768], [1366, 768], [1920, 1080]]) {
        await page.setViewportSize({ width, height });
        check(`all of them on the screen: ${width} x ${height}`, await soon(() => page.evaluate(() => [...document.querySelectorAll(
            '#overview button')].every(button => {
            const { left, right, bottom } = button.getBoundingClientRect();
            return left >= 0 && right <= innerWidth + 1 && bottom <= innerHeight + 1;
        }))), await page.evaluate(() => [document.querySelector('#overview').scrollHeight, document.querySelector('#overview').scrollWidth]));
    }
    await page.setViewportSize({ width: 1024, height: 768 });
    await page.keyboard.press('o');
    check('the address names the slide', /#\/\d+/.test(page.url()), page.url());

    // the speaker's view has question, answer and the line of C
    await go(asking);
    const [view] = await Promise.all([page.context().waitForEvent('page'), page.keyboard.press('s')]);
    const notes = await page.evaluate(() => Reveal.getCurrentSlide().querySelector('.notes').textContent.trim());
    check('S: the speaker sees the answer', await soon(() => view.evaluate(text =>
        document.body.textContent.includes(text), notes.slice(0, 60))), notes);
    await go(live);
    const views = () => view.frames().filter(one => /slides-/.test(one.url()));
    check('and the live picture of this slide', await soon(() => views().length === 2) && await soon(() =>
        views()[0].evaluate(() => !!wanted && frame.shows === wanted && frame.classList.contains('shown'))));
    check('lines of C are whole there', await view.evaluate(() => [...document.querySelectorAll('.speaker-controls-notes pre')]
        .every(line => line.scrollWidth <= line.clientWidth + 1)));
    await page.context().close();
}

// ---- one live picture a deck ------------------------------------------------------------------------

const LETTERS = { 'slides-uw.html': ['n', 'nₛ'], 'slides-massey.html': ['n', 'α'], 'slides-shirley.html': ['n', 'p'],
    'slides-berkeley.html': ['n', 'p'] };
for (const name of decks) {
    const before = asked.length, page = await openDeck(name);
    const slides = await page.evaluate(() => Reveal.getSlides().map((slide, i) => slide.querySelector('figure.live') ? i : -1)
        .filter(i => i >= 0));
    const late = [];
    let place = true;
    await page.waitForFunction(() => frame.shows !== undefined || !wanted, null, { timeout: 60000 });
    for (const i of slides) {
        const [ms, over] = await page.evaluate(async i => {
            const begin = performance.now();
            Reveal.slide(i);
            while (frame.shows !== wanted || !frame.classList.contains('shown')) await new Promise(requestAnimationFrame);
            const [a, b] = [frame, Reveal.getCurrentSlide().querySelector('figure')].map(node => node.getBoundingClientRect());
            return [performance.now() - begin, Math.abs(a.x - b.x) + Math.abs(a.y - b.y) + Math.abs(a.width - b.width)];
        }, i);
        late.push(ms);
        place = place && over < 1;
    }
    late.sort((a, b) => a - b);
    console.log(`${name}: live pictures come after ${late[late.length >> 1].toFixed(0)} ms, half of them`);
    check('where their slide has room for them: ' + name, place);
    check('from one module: ' + name, asked.slice(before).filter(url => url.includes('index.html')).length === 1);
    const inside = page.frames().find(one => one.url().includes('index.html'));
    check('in the letters of the course: ' + name, await inside.evaluate(([letter]) => bare(letter), LETTERS[name]) ===
        LETTERS[name][1]);
    check('its switches too: ' + name, await inside.evaluate(() => document.querySelector('[data-name=flags2]').textContent) ===
        (name.includes('uw') ? '|N·L|' : '|n·l|'));
    check('and with a name in words: ' + name, /^Live picture: [^\\{}]+$/.test(await page.evaluate(() => frame.title)));
    await page.context().close();
}
{
    // iteration four: the arrow key adds term after term to equation and picture
    const page = await openDeck('slides-uw.html');
    await page.evaluate(() => Reveal.slide(Reveal.getSlides().findIndex(slide => slide.classList.contains('build'))));
    const seen = () => page.evaluate(() => [...document.querySelectorAll('.present .equation :is(mi, mo, mn)')].filter(
        node => node.checkVisibility({ opacityProperty: true, visibilityProperty: true })).map(node => node.textContent).join(''));
    const steps = [];
    for (let i = 0; i < 6; i++) {
        await page.waitForFunction(() => wanted && frame.shows === wanted);
        const inside = page.frames().find(one => one.url().includes('index.html'));
        steps.push([await seen(), await inside.evaluate(() => canvas.toDataURL())]);
        if (i < 5) await page.keyboard.press('ArrowRight');
    }
    check('iteration four begins with emission', steps[0][0] === 'I=ke', steps[0][0]);
    const grows = [['ka', '∑'], ['kd', 'Bj'], ['ks'], ['ej'], []];
    check('each key adds a term', steps.every(([text], i) => !i || (text.length > steps[i - 1][0].length || i === 5) &&
        grows[i - 1].every(part => text.includes(part))), steps.map(([text]) => text));
    check('and changes the picture', new Set(steps.map(step => step[1])).size === 6);
    await page.context().close();
}
{
    // the vectors in a plane: values of the module against their closed forms
    const page = await open('index.html', {}, '#bare&plane=1&turn=0&letters=uw&model=1&n=7');
    await page.waitForFunction(() => document.querySelector('#plane .N'));
    const wrong = await page.evaluate(() => {
        const wrong = [], rad = Math.PI / 180;
        for (let l = -175; l <= 175; l += 25) for (let v = -80; v <= 80; v += 20) for (const model of [0, 1]) {
            wasm.page_input();
            tell(words(300, 200, 1));
            const answer = planeAt(l, v, model), nl = Math.cos(l * rad);
            const base = model ? Math.cos((v + l) * rad) : Math.abs(Math.cos((l - v) / 2 * rad)) < 1e-6 ? 0
                : Math.cos((l + v) / 2 * rad) * Math.sign(Math.cos((l - v) / 2 * rad));
            if (Math.abs(answer.nl - nl) > 1e-5 || Math.abs(answer.base - base) > 1e-5 || answer.gate !== +(nl > 0) ||
                Math.abs(answer.power - Math.max(0, base) ** 7) > 1e-4) wrong.push([l, v, model, answer.nl, answer.base, base]);
        }
        return wrong;
    });
    check('values in the plane are cosines', !wrong.length, wrong.slice(0, 5));
    // no letter lies on a vector, on another letter or beyond the picture, in any figure of the decks
    const planes = [...new Set(moving.flatMap(({ words }) => words.map(({ hash }) => hash)).filter(hash => /plane=1/.test(hash)))];
    check('figures of vectors in the decks', planes.length > 15, planes.length);
    await page.setViewportSize({ width: 520, height: 360 });
    const lying = await page.evaluate(planes => {
        document.documentElement.classList.add('slide');
        document.documentElement.style.fontSize = '40px';
        const wrong = [];
        for (const hash of planes) {
            history.replaceState(null, '', '#' + hash), readAddress();
            refresh(), refresh();               // once more, beside the controls that it has
            const whole = $('#plane').getBoundingClientRect();
            const texts = [...document.querySelectorAll('#plane text')].map(node => {
                const { left, right, top, bottom } = node.getBoundingClientRect(), tall = bottom - top;
                return { node, left: left + 1, right: right - 1, top: top + 0.25 * tall, bottom: bottom - 0.3 * tall };
            });
            const meet = (a, b) => a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;
            texts.forEach((a, i) => {
                const say = what => wrong.push(`${hash.match(/plane.*/)}: ${a.node.textContent} ${what}`);
                if (a.left < whole.left || a.right > whole.right || a.top < whole.top || a.bottom > whole.bottom) say('is cut');
                for (const b of texts.slice(i + 1)) if (meet(a, b)) say('lies on ' + b.node.textContent);
                for (const line of document.querySelectorAll('#plane g line')) {
                    const m = line.getScreenCTM(), ends = [[line.x1, line.y1], [line.x2, line.y2]].map(([x, y]) =>
                        new DOMPoint(x.baseVal.value, y.baseVal.value).matrixTransform(m));
                    for (let k = 0; k <= 60; k++) {
                        const [x, y] = ['x', 'y'].map(n => ends[0][n] + (ends[1][n] - ends[0][n]) * k / 60);
                        if (x > a.left && x < a.right && y > a.top && y < a.bottom) { say('lies on ' + line.parentNode.textContent); break; }
                    }
                }
            });
        }
        document.documentElement.classList.remove('slide');
        document.documentElement.style.fontSize = '';
        return wrong;
    }, planes);
    check('letters of vectors and angles lie on nothing', !lying.length, lying);
    await page.setViewportSize({ width: 1024, height: 768 });
    await page.evaluate(() => {
        history.replaceState(null, '', '#bare&plane=1&turn=0&letters=uw&model=1&n=7'), readAddress(), refresh();
    });
    const text = () => page.evaluate(() => document.querySelector('#plane').textContent);
    const tip = await page.locator('#plane .L polygon').boundingBox();
    const before = await text();
    await page.mouse.move(tip.x + tip.width / 2, tip.y + tip.height / 2);
    await page.mouse.down();
    const box = await page.locator('#plane').boundingBox();
    await page.mouse.move(box.x + 20, box.y + box.height - 5, { steps: 4 });
    await page.mouse.up();
    check('L is dragged beyond the horizon, and B is 0', await soon(async () => await text() !== before &&
        /B = 0/.test(await text())), await text());
    await page.locator('#plane [data-to=toV]').focus();
    await page.keyboard.press('ArrowRight');
    check('keys turn V', await soon(async () => (await page.evaluate(() => S.toV)) === 22));
    await page.context().close();
}

// ---- fingers ------------------------------------------------------------------------------------

for (const name of decks) {
    const page = await openDeck(name, { hasTouch: true, viewport: { width: 820, height: 1180 } }, '', false);
    const steps = await page.evaluate(() => Reveal.getSlides().length - 1 + Reveal.getSlides().reduce((sum, slide) =>
        sum + new Set([...slide.querySelectorAll('.fragment')].map(node => node.dataset.fragmentIndex)).size, 0));
    const next = page.locator('.controls .navigate-right');
    for (let i = 0; i < steps; i++) await next.tap();
    check('taps reach the last slide and show each answer: ' + name, await page.evaluate(() =>
        Reveal.isLastSlide() && document.querySelectorAll('.answer:not(.visible)').length === 0));
    await page.locator('.controls .navigate-left').tap();
    check('and go back: ' + name, await page.evaluate(() => !Reveal.isLastSlide() ||
        document.querySelectorAll('.answer:not(.visible)').length > 0));
    await page.context().close();
}
{
    const page = await openDeck('slides-massey.html', { hasTouch: true, viewport: { width: 390, height: 844 } });
    const touch = await page.context().newCDPSession(page);
    const swipe = async (from, to) => {
        await touch.send('Input.dispatchTouchEvent', { type: 'touchStart', touchPoints: [{ x: from, y: 700 }] });
        for (let i = 1; i <= 5; i++) await touch.send('Input.dispatchTouchEvent', { type: 'touchMove',
            touchPoints: [{ x: from + (to - from) * i / 5, y: 700 }] });
        await touch.send('Input.dispatchTouchEvent', { type: 'touchEnd', touchPoints: [] });
    };
    await swipe(350, 50);
    check('a swipe goes on', await soon(async () => await at(page) === 1));
    await swipe(50, 350);
    check('and back', await soon(async () => await at(page) === 0));
    // a tap right after a swipe only ends it
    const overview = () => page.evaluate(() => document.getElementById('overview').open);
    for (let i = 0; i < 5 && !await overview(); i++) {
        await new Promise(done => setTimeout(done, 1000));
        await page.locator('#all').tap();
        await new Promise(done => setTimeout(done, 200));
    }
    check('a button shows all slides', await overview());
    await page.locator('#overview button').nth(2).tap();
    check('and leads to one', await soon(async () => await at(page) === 2 && !await overview()));
    await page.locator('.tools.high a').tap();
    check('the cross leads out', await soon(() => page.url().endsWith('courses.html')));
    await page.context().close();
}

// ---- paper --------------------------------------------------------------------------------------

{
    const page = await open('slides-berkeley.html', { viewport: { width: 960, height: 720 } }, '?print-pdf');
    await page.waitForFunction(() => window.printable);
    await page.emulateMedia({ media: 'print' });
    const paper = await page.evaluate(async () => {
        const images = [...document.querySelectorAll('.pdf-page figure img')];
        await Promise.all(images.map(image => image.decode()));
        return { pages: document.querySelectorAll('.pdf-page').length, slides: Reveal.getSlides().length,
            frames: document.querySelectorAll('iframe').length,
            live: images.filter(image => image.src.startsWith('data:')).length,
            small: images.filter(image => image.naturalWidth < 400).length,
            hidden: [...document.querySelectorAll('.answer')].filter(answer => !answer.checkVisibility({
                opacityProperty: true, visibilityProperty: true })).length,
            number: document.querySelectorAll('.slide-number-pdf')[4].textContent };
    });
    check('paper has a page for each slide, pictures in place of frames, answers and numbers',
        paper.pages === paper.slides && !paper.frames && paper.live > 20 && !paper.small && !paper.hidden &&
        paper.number === `5 / ${paper.slides}`, paper);
    await page.context().close();
}

check('nothing but files of the folder', asked.every(url => url.startsWith('data:') || url.startsWith('about:') ||
    url.startsWith('file://' + folder + '/')), asked.filter(url => !url.startsWith('file:')).slice(0, 5));
check('no word in the console', !complaints.length, complaints.slice(0, 5).join('\n'));
await browser.close();
console.log(`${passed} passed, ${failed} failed`);
process.exit(failed ? 1 : 0);
