// playground.mjs - the playground in a real browser: every control is moved, and after each move
// the module's pixels are those of the native build.   node playground.mjs page native cc browser
import { chromium } from 'playwright-core';
import { execFileSync } from 'child_process';
import fs from 'fs';
import http from 'http';
import path from 'path';

const [page_file, native, cc, browser_path] = process.argv.slice(2);
const T = fs.mkdtempSync(path.join(path.dirname(page_file), 'test-'));
let passed = 0, failed = 0;
function check(what, good, more = '') {
    if (good) { passed++; return; }
    failed++;
    console.log(`playground: ${what} ${more}`);
}

async function soon(holds) {
    for (const begin = Date.now(); Date.now() - begin < 30000;) {
        if (await holds()) return true;
        await new Promise(done => setTimeout(done, 50));
    }
    return false;
}

// every lamp on, near, coned and attenuated, so that each slider shows
const RICH = 'turn=0&Ia=.3,.3,.3&ke=.05,.02,.01&n=30&' + [1, 2, 3].map(j =>
    `on${j}=1&far${j}=0&p${j}=${[[2, 2.5, 3], [-3, 1, 2], [0.5, -3, 2]][j - 1]}&I${j}=1,.9,.8&` +
    `A${j}=.2,.1,.1&a${j}=.5&b${j}=.1&c${j}=.05&beta${j}=5&e${j}=4`).join('&');

// the fields of the rows, in their order; the lamp's number follows from I on
const SYMBOLS = ['detail', 'ke', 'ka', 'kd', 'ks', 'n', 'Ia', 'I', 'A', 'p', 'p', 'p', 'a', 'b', 'c', 'beta',
    'e'];

const browser = await chromium.launch({ executablePath: browser_path, args: ['--no-sandbox',
    '--disable-gpu', '--disable-quic', '--no-first-run', '--disable-background-networking',
    '--disable-component-update', '--disable-sync', '--disable-gpu-watchdog',
    '--disable-hang-monitor'] });
const server = http.createServer((request, answer) => {
    answer.setHeader('content-type', 'text/html');
    answer.end(fs.readFileSync(page_file));
});
await new Promise(ready => server.listen(0, '127.0.0.1', ready));
const served = `http://127.0.0.1:${server.address().port}/`, opened = 'file://' + page_file;
const complaints = [], requests = [];

async function open(hash, options = {}, url = opened) {
    const context = await browser.newContext({ viewport: { width: 960, height: 700 }, ...options });
    context.setDefaultTimeout(90000);           // the machine may be busy
    const page = await context.newPage();
    await page.addInitScript(() => {
        window.base64 = bytes => {
            let text = '';
            for (let i = 0; i < bytes.length; i += 8192)
                text += String.fromCharCode(...bytes.subarray(i, i + 8192));
            return btoa(text);
        };
    });
    page.on('console', line => complaints.push(line.text()));
    page.on('pageerror', error => complaints.push(error.stack));
    page.on('request', request => requests.push(request.url()));
    await page.goto(url + '#' + hash);
    await page.waitForFunction(() => document.querySelectorAll('.presets canvas').length === 24 &&
        document.querySelector('#speed').textContent);
    return page;
}

const differing = (a, b) => Object.keys(b).filter(name => String(a[name]) !== String(b[name]));

// Goes to another address in the same page, until its picture stands.
async function go(page, hash) {
    await page.evaluate(hash => new Promise(done => {
        addEventListener('hashchange', () => setTimeout(done), { once: true });
        location.hash = hash + '&';
    }), hash);
    await page.waitForFunction(() =>
        !requested && !stale && performance.now() > probeAfter + 100);
}

// The state, its floats and the module's picture of it
async function draws(page, width = 160, height = 120) {
    const got = await page.evaluate(([w, h]) => {
        const pixels = base64(draw(w, h, 1));    // which also builds the mesh, for its bounds
        return { state: { ...S }, pixels,
            words: base64(new Uint8Array(Float32Array.from(words(w, h, 1)).buffer)) };
    }, [width, height]);
    return { state: got.state, words: Buffer.from(got.words, 'base64'),
        pixels: Buffer.from(got.pixels, 'base64') };
}
async function same(page, what, model = []) {
    const { state, words, pixels } = await draws(page), file = path.join(T, 'state');
    fs.writeFileSync(file, words);
    const want = execFileSync(native, ['draw', file, ...model], { maxBuffer: 1 << 28 });
    let differ = 0;
    for (let i = 0; i < want.length; i++) differ += want[i] !== pixels[i];
    check('pixels are the native build\'s: ' + what, want.length === pixels.length && !differ,
        `${differ} bytes differ`);
    return { state, pixels };
}

// The program of the page compiles without a warning and writes the page's picture.
async function compiles(page, what, files = []) {
    const [text, width, height, pixels] = await page.evaluate(() => {
        const [w, h] = size(finest());
        return [program(), w, h, base64(draw(w, h, round(finest())))];
    });
    const shown = Buffer.from(pixels, 'base64');
    for (const [name, bytes] of files) fs.writeFileSync(path.join(T, name), bytes);
    fs.writeFileSync(path.join(T, 'picture.c'), text);
    try {
        execFileSync(cc, ['-std=c99', '-O2', '-Wall', '-Wextra', '-Werror', '-I.',
            '-DSHADE__IMPLEMENTED', '-Wno-missing-field-initializers', T + '/picture.c',
            'build/shade.o', '-lm', '-o', T + '/picture'], { stdio: 'pipe' });
        execFileSync('./picture', { cwd: T });
    } catch (error) {
        check('the program compiles and runs: ' + what, false, String(error.stderr || error));
        return;
    }
    const got = fs.readFileSync(T + '/picture.ppm').subarray(-3 * width * height);
    let differ = 0;
    for (let i = 0; i < width * height; i++)
        for (let k = 0; k < 3; k++) differ += got[3 * i + k] !== shown[4 * i + k];
    check('the program draws the picture: ' + what, !differ, `${differ} bytes differ`);
    check('lines of 100 columns: ' + what, text.split('\n').every(line => line.length <= 100));
}

// ---- it loads from a file and from a host, moves, and asks nobody else for anything -------------

for (const [url, name] of [[opened, 'a file'], [served, 'a host']]) {
    const page = await open('', {}, url);
    const shot = () => page.locator('canvas').first().screenshot();
    const total = () => page.locator('#formula .v').first().textContent();
    const first = await shot(), value = await total();
    check('moves, from ' + name, await soon(async () => !first.equals(await shot())));
    check('values change, from ' + name, await soon(async () => value !== await total()));
    check('no address until something is done', await page.evaluate(() => !location.hash));
    await page.context().close();
}

for (const simd of [1, 0]) {
    const page = await open(`${RICH}&simd=${simd}`, { viewport: { width: 910, height: 460 } });
    const kind = simd ? 'simd' : 'plain';
    check('module', await page.evaluate(() => kind) === kind);
    await same(page, kind);

    // ---- sliders and colours, of every lamp -----------------------------------------------------
    for (const lamp of simd ? [1, 2, 3] : [1]) {
        await page.locator(`input[name=lamp][value="${lamp}"] + span`).click();
        const rows = page.locator('aside .row'), from = lamp > 1 ? 7 : 0;    // the lamp's alone
        const count = await rows.count();
        let before = await draws(page);
        for (let i = from; i < count; i++) {
            const input = rows.nth(i).locator('input[type=range]');
            const [title, part, number, coloured] = await rows.nth(i).evaluate(row => {
                const range = row.querySelector('[type=range]');
                return [range.ariaLabel, range.value / range.max,
                    row.querySelector('.number').innerText, !!row.querySelector('[type=color]')];
            });
            const name = `${title}, lamp ${lamp}, ${kind}`;
            await input.press(part > 0.8 ? 'PageDown' : 'PageUp');
            const after = await same(page, name);
            const moved = differing(before.state, after.state);
            check('the slider moves its symbol alone: ' + name,
                moved.join() === SYMBOLS[i] + (i > 6 ? lamp : ''), moved);
            check('the slider moves its number: ' + name,
                number !== await rows.nth(i).locator('.number').innerText());
            check('and the picture: ' + name, !before.pixels.equals(after.pixels));
            before = after;
            if (!coloured) continue;
            const picker = rows.nth(i).locator('input[type=color]');
            await picker.fill('#7fd0a0');
            before = await same(page, name + ', colour');
            check('so does its colour: ' + name, await picker.inputValue() === '#7fd0a0' &&
                String(before.state[moved[0]]) === '0.2122,0.6308,0.3515');
        }
    }

    // ---- buttons --------------------------------------------------------------------------------
    const inputs = type => page.locator(`:is(main, aside) input[type=${type}]:not(:disabled)`).evaluateAll(all =>
        all.map(({ name, value }) => ({ name, value })));
    for (const { name, value } of await inputs('radio')) {
        const input = page.locator(`input[name=${name}][value="${value}"]`);
        await input.locator('+ span').click();
        const { state } = await same(page, `${name} ${value}, ${kind}`);
        check(`button ${name} ${value}`, state[name] === +value && await input.isChecked());
    }
    for (const name of ['shape', 'view', 'model', 'shading'])
        await page.locator(`input[name=${name}][value="0"] + span`).click();
    let before = await draws(page);
    for (const { name } of await inputs('checkbox')) {
        const input = page.locator(`input[name=${name}]`), was = await input.isChecked();
        await input.locator('+ span').click();
        if (name === 'turn') await page.evaluate(() => { S.turn = 0; });
        const after = await same(page, `${name}, ${kind}`);
        check('switch ' + name, was !== await input.isChecked() &&
            (name === 'turn' || differing(before.state, after.state).length === 1));
        if (name !== 'turn') await input.locator('+ span').click();
        before = await draws(page);
    }
    for (let i = 0; i < 4; i++) await page.locator(`#sum input`).nth(i).locator('+ span').click();
    check('the last term turns all on', await page.evaluate(() => S.terms) === 15);
    const names = await page.locator('.presets button').evaluateAll(all =>
        all.map(button => button.ariaLabel));
    for (const [i, name] of names.entries()) {
        await page.locator('.presets button').nth(i).click();
        const { state } = await same(page, `${name}, ${kind}`);
        if (i === 10) check('gold', state.n === 51.2);
    }

    // ---- the values under the formula -----------------------------------------------------------
    for (const hash of ['', 'model=1', 'shading=1', 'shading=2', 'compare=1&shape=1', 'flags=1',
        'flags=4', 'flags=40', 'flags=16', 'model=2', 'model=5', 'terms=6', 'shape=1&view=0']) {
        await go(page, `${RICH}&simd=${simd}&${hash}`);
        const far = await page.evaluate(() => {
            const w = 320, h = 240, picture = draw(w, h, 1).slice(), pixels = [];
            let hits = 0, off = 0, wrong = 0;
            for (let y = 2; y < h; y += 9) for (let x = 2; x < w; x += 9) {
                const a = probe(x + 0.5, y + 0.5);
                if (!a.hit) continue;
                hits++;
                for (let k = 0; k < 3; k++) {
                    const sum = a.emission[k] + a.ambient[k] + a.diffuse[k] + a.specular[k];
                    const shown = 255 * encode(Math.min(1, Math.max(0, sum)));
                    if (Math.abs(shown - picture[4 * (y * w + x) + k]) > 2) off++, k = 3;
                }
                // the printed equation, in double, from the factors the page shows
                if (S.shading || S.flags || S.model > 1 || S.compare || S.terms < 15) continue;
                const arrives = a.spot / (S.a1 + S.b1 * a.r + S.c1 * a.r * a.r) * a.gate;
                for (let k = 0; k < 3; k++) {
                    const d = arrives * S.kd[k] * S.I1[k] * Math.max(0, a.nl);
                    const s = arrives * S.ks[k] * S.I1[k] * Math.max(0, a.base) ** S.n;
                    if (Math.abs(d - a.lampDiffuse[k]) > 1e-4) wrong++;
                    if (Math.abs(s - a.lampSpecular[k]) > 1e-4) wrong++;
                    if (Math.abs(S.ka[k] * S.Ia[k] - a.sceneAmbient[k]) > 1e-6) wrong++;
                }
            }
            return { hits, off, wrong };
        });
        check(`the terms make the pixel: ${hash} ${kind}`,
            far.hits > 50 && far.off <= far.hits / 50, JSON.stringify(far));
        check(`the factors make the terms: ${hash} ${kind}`, !far.wrong, far.wrong);
    }
    await go(page, 'turn=0');
    const texts = await page.evaluate(() => {
        const a = probeMark();
        return TERMS.map(n => [cells['sum' + n].values.textContent, a[n].map(figure).join(' ')]);
    });
    check('the text is the values', texts[2][1] !== '.00 .00 .00' &&
        texts.every(([shown, want]) => shown === want), texts);
    await page.context().close();
}

// ---- programs -----------------------------------------------------------------------------------

const cube = 'v -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\n' +
    'v -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1\n' +
    'f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 3 4 8 7\nf 2 3 7 6\nf 1 5 8 4\n';
{
    const page = await open('turn=0', { viewport: { width: 960, height: 620 } });
    for (const hash of ['', 'shape=1&compare=1&n=16', 'wire=1', 'view=1', 'shape=3&room=1&detail=5',
        'shape=4&flags=1&detail=20', 'room=1&compare=1&detail=3', 'view=2&wire=1',
        'shading=2&flags=63&terms=13', 'shading=1&model=1&wire=1&compare=1', 'model=5',
        RICH + '&zoom=2.3&pitch=-.7', 'on1=0&on2=0&ke=.1,.2,.3']) {
        await go(page, 'turn=0&' + hash);
        await compiles(page, hash);
    }
    await page.locator('#code').click();
    check('the program is shown', await page.evaluate(() =>
        $('#program pre').textContent === program() && $('#program').open));
    await page.keyboard.press('Escape');
    check('and goes', !await page.locator('#program').isVisible());
    await page.context().close();
}

// ---- manners ------------------------------------------------------------------------------------

// Nothing scrolls away, however low in the panel the control is that was used.
{
    const page = await open('turn=0', { viewport: { width: 1366, height: 650 } });
    const labels = page.locator('aside .row input, ' +
        ':is(main, aside) label:has(input:not(:disabled):not([type=file]))');
    for (let i = 0; i < await labels.count(); i++) {
        await labels.nth(i).click();
        await page.evaluate(() => { S.turn = 0; });    // which is drawn for ever
    }
    const covering = () => page.evaluate(() => {
        const help = $('#help').getBoundingClientRect();
        return [...document.querySelectorAll('.map, #lobe, #curve, canvas, #speed')].filter(node => {
            const box = node.getBoundingClientRect();
            return box.width && box.left < help.right && box.right > help.left &&
                box.top < help.bottom - 1 && box.bottom > help.top + 1;
        }).map(node => node.id || node.tagName);
    });
    for (const height of [600, 650, 768]) {
        await page.setViewportSize({ width: 1366, height });
        check(`nothing covers the help: ${height}`, !(await covering()).length, await covering());
    }
    await page.setViewportSize({ width: 1366, height: 650 });
    check('no click scrolls the page', await page.evaluate(() =>
        [document.documentElement, document.body, $('main')].every(node => !node.scrollTop) &&
        $('header').getBoundingClientRect().top >= 0));
    const slider = page.locator('aside .row:has([type=color]) input[type=range]').first();
    await page.locator('aside .row input[type=color]').first().focus();
    await page.keyboard.press('Tab');
    check('one ring around a slider', await slider.evaluate(node =>
        document.activeElement === node && getComputedStyle(node).outlineStyle === 'solid' &&
        getComputedStyle(node.nextSibling).outlineStyle === 'none'));
    await page.locator('.piece.d').hover();
    const opacity = css => page.locator('aside .row.' + css).first().evaluate(node =>
        new Promise(done => setTimeout(() => done(getComputedStyle(node).opacity), 300)));
    check('a term lights its rows', await opacity('d') === '1' && await opacity('s') < 1);
    await page.emulateMedia({ forcedColors: 'active' });
    const colour = on => page.locator(`.choice input[name=view]${on} + span`).first().evaluate(
        node => getComputedStyle(node).backgroundColor);
    check('the chosen button shows in forced colours',
        await colour(':checked') !== await colour(':not(:checked)'));
    await page.emulateMedia({ forcedColors: 'none' });
    await page.evaluate(() => { S.ks = [0, 1, 0], S.yaw = 2, changed(); });
    await page.locator('#reset').click();
    check('reset is the first state', /^#(yaw=[^&]*)?$/.test(await page.evaluate(() => address())));
    await page.context().close();
}
for (const [width, height] of [[1920, 1080], [1440, 900], [1366, 768], [1280, 720]]) {
    const page = await open(RICH, { viewport: { width, height } });
    check(`the equation breaks before the sum alone: ${width}`, await page.evaluate(() =>
        [...document.querySelectorAll('#formula .line')].every(line =>
            new Set([...line.querySelectorAll('.f, .mark, .brace')].map(node =>
                Math.round(node.getBoundingClientRect().top))).size === 1 &&
            line.getBoundingClientRect().right <= $('main').getBoundingClientRect().right)));
    check(`nothing is set in small letters: ${width}`, await page.evaluate(() =>
        [...document.querySelectorAll('main *, aside *')].every(node =>
            !node.textContent.trim() || parseFloat(getComputedStyle(node).fontSize) >= 12) &&
        [...document.querySelectorAll('.v')].every(node =>
            parseFloat(getComputedStyle(node).fontSize) >= 15)));
    await page.evaluate(() => say('A long line about a file that cannot be read. '.repeat(3)));
    check(`a message leaves the buttons free: ${width}`, await page.evaluate(() =>
        $('#message').getBoundingClientRect().top >= $('header').getBoundingClientRect().bottom));
    await page.context().close();
}
{
    const page = await open('', { viewport: { width: 390, height: 844 }, hasTouch: true,
        isMobile: true });
    const low = await page.evaluate(() => [...document.querySelectorAll(
        'button, .choice span, .toggle > span, .open > span')].filter(node => node.offsetParent)
        .filter(node => node.getBoundingClientRect().height < 40).map(node => node.textContent));
    check('a finger meets every button', !low.length, low);
    for (let step = 1; step <= 5; step++) {
        await go(page, 'turn=0&lecture=' + step);
        const wide = await page.evaluate(() => [...document.querySelectorAll('#lecture, #sum label, ' +
            '#lecture p')].filter(node => node.getBoundingClientRect().right > innerWidth ||
                node.getBoundingClientRect().left < 0 || node.scrollWidth > node.clientWidth + 1)
            .map(node => node.textContent));
        check(`a lecture fits a telephone: ${step}`, !wide.length, wide);
    }
    await go(page, 'turn=0');
    check('a slow machine turns with two samples a pixel', await page.evaluate(() => {
        for (let i = 0; i < 120; i++) adapt(60, true);
        return (Math.floor(8 * quality) / 8) ** 2 >= 2;
    }));
    await page.context().close();
}
{
    const page = await open('turn=0&shape=2'), said = () => page.locator('#message').innerText();
    check('an address of a file says so', /cannot hold/.test(await said()));
    await page.evaluate(() => openFile(new File(['\xff\xd8\xff\xe0 JFIF'], 'photo.jpg')));
    check('a picture is no model', /^photo\.jpg: is no model/.test(await said()), await said());
    await page.context().close();
}

// ---- lamps on maps, vectors from above, terms alone, what is clipped -----------------------------

{
    const page = await open('turn=0', { viewport: { width: 1366, height: 768 } });
    const bulb = (map, j) => page.locator('#maps svg').nth(map).locator('.bulb').nth(j - 1);
    const centre = async node => {
        const box = await node.boundingBox();
        return [box.x + box.width / 2, box.y + box.height / 2];
    };
    const position = j => page.evaluate(j => [...S['p' + j]], j);
    for (const [map, j, down, sign] of [[0, 1, 1, -1], [1, 2, 2, 1]]) {
        const [x, y] = await centre(bulb(map, j)), before = await position(j);
        const unit = await page.locator('#maps svg').first().evaluate(node =>
            10 * node.getScreenCTM().a);
        await page.mouse.move(x, y);
        await page.mouse.down();
        await page.mouse.move(x + 5, y + 5);
        await page.mouse.move(x + 18, y + 12);
        await page.mouse.up();
        const { state } = await same(page, `lamp ${j} dragged`), after = state['p' + j];
        const wanted = before.map((v, k) => v + (k === 0 ? 18 / unit : k === down
            ? sign * 12 / unit : 0));
        check(`lamp ${j} follows the pointer`, state.lamp === j &&
            after.every((v, k) => Math.abs(v - Math.min(6, wanted[k])) < 0.15), [after, wanted]);
        check('and the address follows', await soon(() => page.evaluate(j =>
            location.hash.includes(`p${j}=${S['p' + j]}`), j)));
    }
    const before = await position(3);
    await bulb(1, 3).focus();
    await page.keyboard.press('ArrowUp');
    await page.keyboard.press('Shift+ArrowRight');
    const after = await position(3);
    check('arrow keys move a lamp', await page.evaluate(() => S.lamp) === 3 &&
        Math.abs(after[2] - before[2] + 0.1) < 1e-6 && Math.abs(after[0] - before[0] - 1) < 1e-6 &&
        after[1] === before[1], after);
    check('which says where it is', /^x 1, z 0\.9$/.test(
        await bulb(1, 3).getAttribute('aria-valuetext')));
    await page.mouse.move(5, 5);
    check('V is drawn from above', await page.evaluate(() => {
        const line = document.querySelector('#side .V line'), at = name => line[name].baseVal.value;
        const a = probeMark();
        return Math.abs(at('x2') - 60 * a.unitV[0]) < 0.01 && a.unitV[2] > 0.9 &&
            Math.abs(at('y2') - 60 * a.unitV[2]) < 0.01;
    }));

    const texts = () => page.locator('#sum .v').allTextContents();
    await go(page, 'turn=0&ke=.1,0,0');
    const values = await texts();
    for (const [i, css] of ['e', 'a', 'd', 's'].entries()) {
        const node = page.locator('.piece.' + css).last();
        for (const way of ['hover', 'focus']) {
            await node[way]();
            const shown = await page.evaluate(() => base64(draw(160, 120, 1)));
            const wanted = await page.evaluate(bit => {
                const kept = [alone, S.terms];
                alone = 0, S.terms = bit;
                const text = base64(draw(160, 120, 1));
                [alone, S.terms] = kept;
                return text;
            }, 1 << i);
            check(`a term is shown alone: ${css}, ${way}`, shown === wanted);
            await page.mouse.move(5, 5);
            await node.blur();
        }
    }
    await same(page, 'after terms alone');
    await soon(async () => String(await texts()) === String(values));
    check('the values stay those of all terms', String(await texts()) === String(values));
    const clipped = () => page.locator('#formula .total .clip').allTextContents();
    check('nothing is clipped in the dark', !(await clipped()).length);
    await go(page, 'turn=0&ke=1,.1,.1&kd=1,1,.1&I1=3,3,3');
    await soon(async () => (await clipped()).length);
    check('what is above 1 is marked', (await clipped()).length === await page.evaluate(() => {
        const a = probeMark();
        return [0, 1, 2].filter(k => TERMS.reduce((sum, name) => sum + a[name][k], 0) > 1).length;
    }));
    check('red, green and blue are told apart', await page.evaluate(() =>
        [...document.querySelectorAll('#formula .total .v span')].map(node => node.className[0])
            .join('') === 'RGB'));
    await page.locator('#by-hand').click();
    check('the equation in C', />>terms[^]*\nstatic float by_hand\([^]*f_spot[^]*\n}\n?$/.test(
        await page.locator('#program pre').textContent()));
    await page.keyboard.press('Escape');
    for (const hash of ['turn=0&compare=1', 'turn=0&bare', 'turn=0&maps=0']) {
        await go(page, hash);
        check('no maps: ' + hash, !await page.locator('.map:visible').count());
    }
    await page.context().close();
}

// ---- a lecture ----------------------------------------------------------------------------------

const read = new Set();
for (const [width, height] of [[1024, 768], [1366, 768], [1920, 1080], [3840, 2160]]) {
    const page = await open('turn=0&lecture=1', { viewport: { width, height } });
    for (let step = 1; step <= 5; step++) {
        const { state } = await same(page, `lecture ${step}, ${width}`);
        const [formula, small, inside] = await page.evaluate(() => {
            const seen = [...document.querySelectorAll('#lecture *, #sum *')].filter(node =>
                [...node.childNodes].some(child => child.nodeType === 3 && child.data.trim()) &&
                node.checkVisibility() &&
                !node.closest('msub > :nth-child(2), msup > :nth-child(2), msubsup > :nth-child(n+2)'));
            return [$('#lecture p').textContent, seen.filter(node =>
                parseFloat(getComputedStyle(node).fontSize) < 24).map(node => node.textContent),
            seen.every(node => node.getBoundingClientRect().bottom <= innerHeight &&
                node.getBoundingClientRect().right <= innerWidth + 1)];
        });
        check(`step ${step} is iteration ${step - 1}: ${width}`, state.lecture === step &&
            state.model === [4, 3, 2, 0, 0][step - 1] && formula.includes('N·L') === step > 2 &&
            formula.includes('N·H') === step > 3 && formula.includes('Σ') === step > 4 &&
            formula.includes('spot') === step > 4, formula);
        check(`values are 24 px and more: ${step}, ${width}`, !small.length, small);
        check(`all of it is on the screen: ${step}, ${width}`, inside);
        check(`the formula is whole: ${step}, ${width}`, await page.evaluate(() =>
            [...document.querySelectorAll('#lecture p math')].every(node =>
                node.getBoundingClientRect().right <= innerWidth)));
        if (step === 4) read.add(await page.locator('#sum').innerText());
        check(`one slider: ${step}, ${width}`,
            await page.locator('input[type=range]:visible').count() === 1);
        await page.keyboard.press('PageDown');
    }
    for (const [key, step] of [['ArrowLeft', 4], ['ArrowUp', 3], ['Backspace', 2], ['ArrowRight', 3],
        ['ArrowDown', 4], ['Space', 5], ['Enter', 5], ['Control+ArrowLeft', 5]]) {
        await page.keyboard.press(key);
        check(`key in the lecture: ${key}, ${width}`, await page.evaluate(() => S.lecture) === step);
    }
    check('each step has its address', await soon(() => page.evaluate(() =>
        /lecture=5/.test(location.hash))));
    await page.keyboard.press('PageUp');
    check('and one can go back', await page.evaluate(() => S.lecture) === 4);
    await page.keyboard.press('Escape');
    await go(page, 'turn=0&bare');
    check('a frame has no panel', await soon(async () =>
        !await page.locator('aside').isVisible() && await page.locator('#formula').isVisible()));
    await go(page, 'turn=0');
    await go(page, 'turn=0&model=1&yaw=1&kd=.5,.4,.3&on3=1&mark=.1,.2,.3');
    const before = await page.evaluate(() => JSON.stringify(S));
    await page.keyboard.press('l');
    check('the key L begins', await page.evaluate(() => S.lecture) === 1);
    await page.keyboard.press('Space');
    await page.keyboard.press('Escape');
    check('and leave', await soon(async () => await page.evaluate(() => S.lecture) === 0 &&
        await page.locator('aside').isVisible()));
    check('which brings back what was there', before === await page.evaluate(() => JSON.stringify(S)));
    check(`type grows with the screen: ${width}`, Math.abs(Math.max(14, 14 * width / 1920) - await page.evaluate(() =>
        parseFloat(getComputedStyle(document.documentElement).fontSize))) < 0.1);
    await page.context().close();
}
check('iteration three reads the same on every screen', read.size === 1 &&
    !/specular \.00/.test([...read][0].replace(/\s+/g, ' ')), [...read]);

// ---- the rasterizer, a pixel at a time ------------------------------------------------------------

{
    const page = await open('turn=0', { viewport: { width: 1366, height: 650 } });
    await go(page, 'raster=1');
    // the module's numbers beside those of the definitions, for triangles with corners anywhere and on
    // pixel centres, of both windings
    const wrong = await page.evaluate(() => {
        let seed = 7;
        const wrong = [], next = n => (seed = (seed * 48271) % 2147483647) % n;
        const near = (a, b, most) => Math.abs(a - b) <= most;
        let covered = 0, onEdge = 0;
        for (let i = 0; i < 60; i++) {
            const grain = i % 2 ? 16 : 2, place = n => next(n * grain) / grain + (i % 2 ? 0 : 0.5);
            S.t1 = [0, 1, 2].flatMap(() => [place(16), place(12), 1 + next(36) / 4]);
            S.count = 1, S.step = 0, tellRaster();
            const c = [0, 1, 2].map(k => S.t1.slice(3 * k, 3 * k + 3));
            for (let y = 0; y < 12; y++) for (let x = 0; x < 16; x++) {
                const a = askRaster(0, x, y), P = [x + 0.5, y + 0.5];
                let e = [0, 1, 2].map(k => {
                    const [A, B] = [c[(k + 1) % 3], c[(k + 2) % 3]];
                    return (B[0] - A[0]) * (P[1] - A[1]) - (B[1] - A[1]) * (P[0] - A[0]);
                });
                const area = e[0] + e[1] + e[2], sign = area < 0 ? -1 : 1;
                e = e.map(v => sign * v);
                // a point that is a little below and, far less, to the right of the centre decides
                // what an edge through it owns
                const inside = area !== 0 && e.every((v, k) => {
                    const [A, B] = [c[(k + 1) % 3], c[(k + 2) % 3]];
                    const tilt = sign * ((B[0] - A[0]) * 1e-9 - (B[1] - A[1]) * 1e-6);
                    onEdge += v === 0;
                    return v > 0 || (v === 0 && tilt > 0);
                });
                const bad = what => wrong.push([i, x, y, what, JSON.stringify(a)].join(' '));
                if (!!a.covered !== inside) bad('coverage ' + inside);
                if (area && e.some((v, k) => v !== a.edge[k])) bad('edges ' + e);
                if (area && e.every((v, k) => v > 0 || (v === 0 && a.owns[k])) !== inside) bad('owns');
                if (!inside) continue;
                covered++;
                const share = e.map(v => v / Math.abs(area));
                const rw = share.reduce((sum, v, k) => sum + v / c[k][2], 0), w = 1 / rw;
                const z = 12 * (w - 0.5) / (w * 11.5);
                if (share.some((v, k) => !near(v, a.share[k], 2e-6))) bad('share ' + share);
                if (share.some((v, k) => !near(v * w / c[k][2], a.weight[k], 1e-5))) bad('weights');
                if (!near(rw, a.rw, 2e-6) || !near(z, a.z, 2e-6)) bad('1/w ' + rw + ' z ' + z);
                if (a.before !== 1 || a.after !== a.z || !a.passes) bad('depth');
            }
        }
        return { wrong: wrong.slice(0, 5), covered, onEdge };
    });
    check('numbers of a step are those of the definitions', !wrong.wrong.length &&
        wrong.covered > 500 && wrong.onEdge > 100, JSON.stringify(wrong));

    const SCENE = 'raster=1&count=3&t1=1,1,2,3,11,2,14,5,6&t2=15,1,2,2,6.5,6,13,11,2&t3=3,3,4,4,9,4,12,8,4';
    const buffers = order => page.evaluate(order => {
        S.order = order, tellRaster();
        const total = rasterSteps, copy = () => [...floats(wasm.page_raster_depth(), 192)];
        let before = null, stray = 0, changes = 0, order0 = [];
        for (let i = 0; i <= total; i++) {
            S.step = i, tellRaster();
            const now = copy(), step = rasterStep();
            if (before) now.forEach((z, p) => {
                if (z === before[p]) return;
                changes++;
                if (p !== 16 * step.y + step.x || z >= before[p]) stray++;
            });
            if (step) order0.push([step.t, step.x, step.y].join());
            before = now;
        }
        const pixels = new Uint32Array(wasm.memory.buffer, wasm.page_raster_pixels(), 192);
        return { total, stray, changes, picture: [...pixels].join() + before.join(),
            steps: order0, same: new Set(order0).size };
    }, order);
    await go(page, SCENE);
    const first = await buffers(0), second = await buffers(1);
    check('a step changes its own pixel alone, to what is nearer', !first.stray && !second.stray &&
        first.changes > 50, [first.stray, second.stray, first.changes]);
    check('both orders make the same steps and picture', first.picture === second.picture &&
        first.total === second.total && first.same === first.total &&
        [...first.steps].sort().join(';') === [...second.steps].sort().join(';') &&
        first.steps.join(';') !== second.steps.join(';'));

    await go(page, SCENE + '&step=30');
    const caption = () => page.locator('#numbers caption').textContent();
    check('an address holds a step', /step 30 is triangle 1/.test(await caption()), await caption());
    for (const [key, step] of [[' ', 31], ['ArrowRight', 32], ['ArrowLeft', 31], ['Backspace', 30],
        ['End', first.total], ['Home', 0], ['Control+ArrowRight', 0]]) {
        await page.keyboard.press(key === ' ' ? 'Space' : key);
        check('key of the stepper: ' + key, await page.evaluate(() => S.step) === step);
    }
    // after a click on a scene, a choice or the range keys step on
    for (const what of ['#raster-panel .buttons button >> nth=3', '#raster-panel .choice label >> nth=1']) {
        await page.locator(what).click();
        const at = await page.evaluate(() => S.step);
        await page.keyboard.press('ArrowRight');
        check('keys step after a click on ' + what, await soon(() => page.evaluate(at => S.step === at + 1, at)));
    }
    // one addition leads from pixel to pixel, and E is its formula with its numbers
    await go(page, SCENE + '&step=40');
    const sums = await page.evaluate(() => {
        const wrong = [];
        for (const t of triangles()) for (let y = 0; y < 11; y++) for (let x = 0; x < 15; x++) for (let k = 0; k < 3; k++) {
            const a = askRaster(t, x, y), [right, down] = [askRaster(t, x + 1, y), askRaster(t, x, y + 1)];
            const said = nextPixel(t, { x, y }, b => b.edge[k]).replace(/<[^>]*>/g, '').match(/→ ([+−]) (\S+) ↓ ([+−]) (\S+)/);
            const [dx, dy] = [1, 3].map(i => (said[i] === '+' ? 1 : -1) * said[i + 1]);
            if (Math.abs(a.edge[k] + dx - right.edge[k]) > 6e-5 || Math.abs(a.edge[k] + dy - down.edge[k]) > 6e-5)
                wrong.push([t, x, y, k, ...said]);
            const text = edgeFormula(t, k, { x, y }).replace(/<[^>]*>/g, '').replace(/−/g, '-').split('=');
            const value = Function('return ' + text[1].replace(/\)\(/g, ')*('))();
            if (Math.abs(value - a.edge[k]) > 1e-4) wrong.push([t, x, y, k, text, a.edge[k]]);
        }
        return wrong.slice(0, 4);
    });
    check('E by one addition, and by its formula', !sums.length, JSON.stringify(sums));
    // what is interpolated: how bright the colour is that a step stores
    await go(page, 'raster=1&count=2');
    const stored = await page.evaluate(() => {
        const wrong = [], ratio = [];
        for (S.step = 1; S.step <= 150; S.step++) {
            tellRaster();
            const { t, x, y } = rasterStep(), pixel = new Uint8Array(wasm.memory.buffer, wasm.page_raster_pixels() + 4 * (16 * y + x), 4);
            wasm.page_raster_run(S.step - 1);
            const a = askRaster(t, x, y);
            if (!a.covered || !a.passes || pixel[1] > 250) continue;
            ratio.push([t, decode(pixel[1] / 255) / brightness(a)]);
        }
        for (const t of [0, 1]) {
            const own = ratio.filter(([of]) => of === t).map(([, v]) => v);
            if (own.length < 20 || Math.max(...own) / Math.min(...own) > 1.08) wrong.push([t, own.length, Math.min(...own), Math.max(...own)]);
        }
        S.step = 40, changed();
        return wrong;
    });
    check('the colour is as bright as its corners, interpolated', !stored.length, JSON.stringify(stored));
    check('which the numbers say', /1.5α.*of its colour/.test((await page.locator('#numbers').textContent()).replace(/\s/g, '')
        .replace('ofitscolour', 'of its colour')));
    // what is foretold is asked before it is shown, and told right or wrong
    await go(page, SCENE);
    const told = await page.evaluate(() => {
        const fates = [0, 0, 0], wrong = [];
        while (S.step < rasterSteps) {
            const { t, x, y, fate } = fateOf(S.step), before = floats(wasm.page_raster_depth(), 192)[16 * y + x];
            fates[fate]++, foretell(fate), tellRaster();
            const after = floats(wasm.page_raster_depth(), 192)[16 * y + x];
            if ((fate === 2) !== (after < before) || (fate === 0) === !!askRaster(t, x, y).covered) wrong.push([t, x, y, fate]);
        }
        return { fates, wrong };
    });
    check('what the next step does', !told.wrong.length && told.fates.every(n => n > 5), JSON.stringify(told));
    await go(page, SCENE + '&step=1');
    await page.keyboard.press('3');
    check('a wrong prediction is told', await soon(async () => /^(Right|No): triangle 1 at/.test(
        await page.locator('#foretold').textContent())));
    const blend = await page.evaluate(() => {
        S.step = rasterSteps, tellRaster();
        return new Set(new Uint32Array(wasm.memory.buffer, wasm.page_raster_pixels(), 192)).size;
    });
    check('colours are interpolated', blend > 30, blend);
    await go(page, SCENE + '&step=2');
    await page.keyboard.press('Enter');
    check('it plays', await soon(() => page.evaluate(() => S.step > 3)));
    await page.keyboard.press('Enter');
    await page.locator('#grid').focus();
    await page.keyboard.press('ArrowDown');
    check('keys choose a pixel', /^Pixel \(\d+, \d+\), centre [\d.]+, [\d.]+$/.test(await caption()),
        await caption());
    const corner = page.locator('.corner').nth(0), box = await corner.boundingBox();
    const unit = await page.locator('#grid').evaluate(node => node.getScreenCTM().a);
    await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
    await page.mouse.down();
    await page.mouse.move(box.x + box.width / 2 + 2 * unit, box.y + box.height / 2 + unit, { steps: 4 });
    await page.mouse.up();
    check('a corner is dragged', String(await page.evaluate(() => S.t1.slice(0, 3))) === '3,2,2');
    await corner.focus();
    await page.keyboard.press('Shift+ArrowLeft');
    await page.keyboard.press('ArrowUp');
    check('or moved by keys', String(await page.evaluate(() => S.t1.slice(0, 3))) === '2.9375,1.5,2');
    await page.keyboard.press('Escape');
    check('Escape leads back to light', await soon(() => page.locator('#formula').isVisible()));
    await go(page, 'raster=1&cell=9,99&step=1e9&t1=nan&count=7&t2=99,-99,0,0,0,0,0,0,0');
    check('bad numbers stay within the grid', await page.evaluate(() => S.cell[1] === 11 &&
        S.step <= rasterSteps && S.count === 3));
    await page.context().close();

    const phone = await open('turn=0', { viewport: { width: 320, height: 600 }, isMobile: true,
        hasTouch: true });
    await go(phone, SCENE);
    check('the stepper fits 320 pixels', await phone.evaluate(() =>
        document.scrollingElement.scrollWidth <= innerWidth));
    await phone.locator('#steps button').nth(3).tap();
    check('a finger steps', await phone.evaluate(() => S.step) === 1);
    await phone.locator('#to-light').tap();
    for (const hash of ['', 'lecture=1', 'lecture=4', 'lecture=5', 'curve=1&lobe=1', 'bare']) {
        await go(phone, 'turn=0&' + hash);
        check('nothing overflows 320 pixels: ' + hash, await phone.evaluate(() =>
            document.scrollingElement.scrollWidth <= innerWidth && ![...document.querySelectorAll(
                '#lecture p > *, #sum label, header button')].some(node => node.checkVisibility() &&
                (node.getBoundingClientRect().right > innerWidth + 1 ||
                node.getBoundingClientRect().left < -1))));
    }
    await go(phone, 'turn=0&lecture=2');
    for (const [name, step] of [['Next', 3], ['Previous', 2], ['Exit', 0]]) {
        await phone.locator(`#lecture button[aria-label=${name}]`).tap();
        check('a finger in the lecture: ' + name, await phone.evaluate(() => S.lecture) === step);
    }
    await phone.context().close();
}

// ---- the marked pixel, explained -------------------------------------------------------------------

{
    const page = await open('turn=0', { viewport: { width: 1366, height: 768 } });
    const pandoc = (() => {
        try { execFileSync('pandoc', ['--version']); return true; } catch { return false; }
    })();
    for (const hash of ['', RICH, RICH + '&beta1=60&beta2=90&beta3=170', RICH + '&model=1&beta1=90',
        RICH + '&shading=1&beta1=90&beta2=80', 'shading=2', 'flags=1&shape=4&yaw=2', 'flags=2&pitch=-1',
        'flags=4&p1=-3,1,-3&n=4', RICH + '&flags=24&beta1=90', 'flags=32&model=1', 'model=2', 'model=3&ke=.1,.2,.3',
        'model=4&ke=.1,.2,.3', 'model=5', 'terms=9&ke=.1,.1,.1', 'on1=0&on2=0', 'room=1&part=1&mark=1,.5,1',
        'compare=1&panel=2&n=9', 'compare=1&panel=0&n=9', 'a1=0&b1=0&c1=0', 'kd=1,1,1&I1=3,3,3&on3=1']) {
        await go(page, 'turn=0&' + hash);
        const { lines, code, tex, terms } = await page.evaluate(() => {
            const found = explanation(), a = probeMark();
            return { lines: found.lines, code: asC(found), tex: asLatex(found),
                terms: [0, 1, 2].map(k => TERMS.reduce((sum, name) => sum + a[name][k], 0)) };
        });
        const last = lines[lines.length - 1].value;
        check('the lines add up to the pixel: ' + hash,
            last.every((v, k) => Math.abs(v - terms[k]) < 1e-5), [last, terms]);
        fs.writeFileSync(T + '/pixel.c', code);
        let printed = '';
        try {
            execFileSync(cc, ['-std=c99', '-Wall', '-Wextra', '-Werror', T + '/pixel.c', '-lm', '-o',
                T + '/pixel'], { stdio: 'pipe' });
            printed = String(execFileSync(T + '/pixel'));
        } catch (error) { printed = String(error.stderr || error); }
        const got = new Map(printed.trim().split('\n').map(line => line.split(' = ')));
        const off = lines.filter(line => line.c).filter(({ c, value }) => {
            const numbers = (got.get(c) || '').split(' ').map(Number), want = [value].flat();
            return numbers.length !== want.length || numbers.some((v, k) =>
                !(Math.abs(v - want[k]) <= 2e-4 * Math.max(1, Math.abs(want[k]))));
        });
        check('each line of C gives its number: ' + hash, got.size === lines.filter(line => line.c).length &&
            !off.length, JSON.stringify(off.slice(0, 3)) + printed.slice(0, 300));
        check('lines of 100 columns: ' + hash, code.split('\n').every(line => line.length <= 100));
        // each line as pandoc reads it, which complains of what is no LaTeX
        const all = tex.split('\n').slice(1, -2).map(line => '$$' + line.replace('&', '')
            .replace(/ \\\\$/, '') + '$$').join('\n\n');
        if (pandoc) check('it is LaTeX: ' + hash, execFileSync('sh', ['-c', 'pandoc -f markdown -t html ' +
            '--mathml 2>&1 >/dev/null'], { input: all }).length === 0);
    }
    await go(page, 'turn=0');
    await page.keyboard.press('e');
    check('it is shown as MathML', await page.evaluate(() => $('#explanation').open &&
        document.querySelectorAll('#lines math').length > 20 && !/undefined|NaN|\\\\/.test($('#lines').textContent)));
    // beside the picture, with the result in sight; lamps that bring nothing are one line, which says why
    for (const hash of ['turn=0&n=80', RICH + '&shading=1', 'turn=0&p1=-3,1,-3&on2=0']) {
        await go(page, hash);
        await page.evaluate(() => $('#explanation').open || explain());
        await page.waitForFunction(() => $('#lines .result'));
        const [dialog, picture, result] = await Promise.all(['#explanation', 'figure canvas', '#lines .result'].map(
            what => page.locator(what).first().boundingBox()));
        check('beside the picture: ' + hash, dialog.x >= picture.x + picture.width - 1, [dialog, picture]);
        check('with its result in sight: ' + hash, result.y + result.height <= 768 && result.x + result.width <= 1367, result);
    }
    // its vectors from the side: N and L in the plane of the picture, degrees beside them
    for (const hash of ['turn=0', 'turn=0&model=1&n=5', 'turn=0&lamp=2', 'turn=0&p1=-3,1,-3&model=1', 'turn=0&model=2', 'turn=0&on1=0']) {
        await go(page, hash);
        await page.evaluate(() => $('#explanation').open || explain());
        const { drawn, text, want, base, names } = await page.evaluate(() => {
            const a = (probeMark(), answerAt(wasm.page_factors(0, S.lamp - 1))), degrees = v => Math.acos(v) * 180 / Math.PI;
            const along = name => {
                const line = document.querySelector(`#from-side .${name} line`);
                return line && ['x', 'y'].map(n => line[n + '2'].baseVal.value - line[n + '1'].baseVal.value);
            };
            const [N, L] = [along('N'), along('L')];
            return { drawn: L && Math.atan2(L[0] - 0, -L[1]) * 180 / Math.PI, text: $('#from-side').textContent, want: degrees(a.nl),
                base: degrees(a.base), names: [...document.querySelectorAll('#from-side g')].map(g => g.getAttribute('class')).join(''), N };
        });
        if (/on1=0/.test(hash)) {
            check('no light of a lamp that is off: ' + hash, drawn === null && /lamp 1 is off/.test(text), text);
            continue;
        }
        check('N and L from the side: ' + hash, Math.abs(Math.abs(drawn) - want) < 0.5, [drawn, want]);
        check('with its degrees: ' + hash, text.includes(`θ = ${Math.round(want)}°`) && (/model=2/.test(hash) ? names === 'NVL'
            : text.includes(`${/model=1/.test(hash) ? 'φ' : 'ω'} = ${Math.round(base)}°`) && names === 'NVLH'), [text, names, want, base]);
    }
    await go(page, 'turn=0&p1=-3,1,-3&on2=0');
    check('a lamp that brings nothing is folded, and says why', await soon(async () =>
        /^Lamp 1 brings nothing here: .*=0$/.test((await page.locator('#lines summary').textContent()).replace(/\s/g, ' ')
            .replace(/ = /g, '='))), await page.locator('#lines').textContent());
    await page.evaluate(() => { S.p1 = [3, 2, 3], changed(); });
    check('and it follows what changes', await soon(() => page.evaluate(() => !document.querySelector('#lines summary'))));
    check('each term that is 0 says why', await page.evaluate(() => {
        Object.assign(S, { ks: [0, 0, 0] }), refresh(), frame(performance.now());
        return explanation().lines.filter(({ c, why }) => /^specular_1/.test(c) && /k_s = 0/.test(why)).length === 1;
    }));
    await page.context().grantPermissions(['clipboard-read', 'clipboard-write']);
    for (const [id, wanted] of [['#copy-latex', /^\\begin\{align\*\}[^]*N\}[^]*align\*\}\n$/],
        ['#copy-c', /^\/\* The equation[^]*return 0;\n\}\n$/]]) {
        await page.locator(id).click();
        check('copied: ' + id, wanted.test(await page.evaluate(() => navigator.clipboard.readText())));
    }
    await page.keyboard.press('Escape');
    for (const key of ['Control+e', 'Alt+l', 'Control+l', 'Meta+e']) await page.keyboard.press(key);
    check('keys with Ctrl, Alt and Meta are the browser\'s', await page.evaluate(() => !S.lecture &&
        !document.querySelector('dialog[open]')));
    await page.locator('canvas').first().focus();
    const state = () => page.evaluate(() => [S.zoom, S.yaw, S.pitch].join());
    const before = await state();
    for (const key of ['Control+=', 'Alt+ArrowLeft', 'Meta+-', 'Control+ArrowUp']) await page.keyboard.press(key);
    check('on the picture too', before === await state());
    check('radio groups have names', await page.evaluate(() =>
        [...document.querySelectorAll('input[type=radio]')].every(node =>
            node.closest('[role=radiogroup]')?.getAttribute('aria-label'))));
    await page.context().close();
}

// ---- what a slide speaks of, alone; the mark ---------------------------------------------------------

{
    const page = await open('turn=0', { viewport: { width: 700, height: 560 } });
    const names = ['n', 'kd', 'c2', 'p1', 'detail', 'shape', 'shading', 'model', 'compare', 'room', 'curve',
        'lobe', 'flags4', 'flags', 'place', 'lamp', 'presets', 'terms', 'formula', 'turn', 'e3'];
    for (const name of names) {
        await go(page, `turn=0&bare&with=${name}`);
        const [seen, height, lamp] = await page.evaluate(() => [
            [...document.querySelectorAll('[data-name]')].filter(node => node.checkVisibility() &&
                !node.querySelector('.asked') && !node.parentNode.closest('[data-name].asked')).map(node => node.dataset.name),
            canvas.clientHeight, S.lamp]);
        const want = /^(flags|terms)/.test(name) ? name : name.replace(/[123]$/, '');
        check(`with=${name} shows this control alone`, seen.length > 0 &&
            seen.every(other => other === want), seen);
        check(`and the picture: ${name}`, height > 250, height);
        if (/[a-z][123]$/.test(name)) check('of its lamp: ' + name, lamp === +name.slice(-1), lamp);
    }
    for (const name of ['steps', 'numbers', 'loops', 'order', 'count', 'hand', 'w', 'scenes']) {
        await go(page, `raster=1&step=20&bare&with=${name}`);
        const seen = await page.evaluate(() => [...document.querySelectorAll('[data-name]')].filter(node =>
            node.checkVisibility()).map(node => node.dataset.name));
        check(`with=${name} of the stepper`, seen.length > 0 && seen.every(other => other === name) &&
            await page.evaluate(() => $('#grid').clientHeight > 180), seen);
    }
    await go(page, 'turn=0&bare&with=n,shading');
    await page.locator('aside [data-name=n] input').press('PageUp');
    check('the address keeps with=', await soon(() => page.evaluate(() =>
        /n=\d/.test(location.hash) && /with=n,shading/.test(location.hash))));

    // a mark in the address is the same point of the object at every size, and turns with it
    const values = [];
    for (const [width, height] of [[700, 560], [1366, 768], [1920, 1080], [390, 844]]) {
        await page.setViewportSize({ width, height });
        await go(page, 'turn=0&yaw=.2&mark=.1,.25,.45&width=' + width);
        values.push(await page.evaluate(() => JSON.stringify(probeMark().mark.map(v => v.toFixed(3)))));
    }
    check('a mark is a point of the object', new Set(values).size === 1, values);
    const kept = await page.evaluate(() => {
        S.mark = probeMark().mark;
        const at = probeMark().place, radius = Math.hypot(at[0], at[1], at[2]);
        S.yaw = 1.2, S.pitch = -0.2, tell(words(canvas.width, canvas.height, 1));
        const then = probeMark();
        return [radius - Math.hypot(...then.place), Math.hypot(...then.place.map((v, i) => v - at[i]))];
    });
    check('and turns with it', Math.abs(kept[0]) < 1e-3 && kept[1] > 0.2, kept);
    await page.setViewportSize({ width: 1366, height: 768 });
    await go(page, 'turn=0');
    const box = await page.locator('canvas').first().boundingBox();
    await page.mouse.move(box.x + box.width * 0.45, box.y + box.height * 0.55);
    await page.mouse.move(box.x + box.width * 0.46, box.y + box.height * 0.56);
    await page.mouse.move(5, 5);
    check('where the pointer was, the mark stays, and stands in the address', await soon(() =>
        page.evaluate(() => /mark=/.test(location.hash))) && Math.hypot(...(await page.evaluate(() => {
        const { point } = probeMark();
        return [point[0] / canvas.width - 0.46, point[1] / canvas.height - 0.56];
    }))) < 0.02);

    // the brightness along the line is that of the picture
    await go(page, 'turn=0&curve=1&room=1&shape=3&terms=13');
    check('brightness along a line', await page.evaluate(() => {
        const w = 320, h = 240, picture = draw(w, h, 1).slice();
        let worst = 0;
        for (const y of [60, 120, 180]) {
            const sum = new Float32Array(w);
            for (const bit of [1, 4, 8]) floats(wasm.page_row(y, bit), w).forEach((v, x) => { sum[x] += v; });
            for (let x = 0; x < w; x++) {
                const rgb = [0, 1, 2].map(k => picture[4 * (y * w + x) + k]);
                if (rgb.some(v => v === 255) || !probe(x + 0.5, y + 0.5).hit) continue;
                worst = Math.max(worst, Math.abs(encode(luminance(rgb.map(v => decode(v / 255)))) -
                    encode(sum[x])));
            }
        }
        return worst < 3 / 255 && document.querySelectorAll('#curve polygon').length === 3;
    }));
    await page.context().close();
}

// ---- files --------------------------------------------------------------------------------------

{
    const page = await open('turn=0', { viewport: { width: 960, height: 620 } });
    const drop = async (name, content) => {
        const bytes = Buffer.from(content);
        await page.evaluate(async ([name, base64]) => {
            const data = new DataTransfer();
            const bytes = Uint8Array.from(atob(base64), c => c.charCodeAt(0));
            data.items.add(new File([bytes], name));
            dispatchEvent(new DragEvent('drop', { dataTransfer: data, cancelable: true }));
        }, [name, bytes.toString('base64')]);
        await page.waitForFunction(() => !/^(Reading .*|)$/.test($('#message').textContent),
            null, { timeout: 60000 });
        return page.locator('#message').innerText();
    };
    const noise = Buffer.alloc(5000);
    for (let i = 0; i < noise.length; i++) noise[i] = (i * i * 31 + i * 17) >> 3;
    for (const [name, content, line] of [
        ['empty.obj', '', /^empty\.obj:.*the file is empty$/],
        ['noise.obj', noise, /^noise\.obj:/], ['noise.stl', noise, /^noise\.stl: ends after/],
        ['faces.obj', 'f 1 2 3\n', /^faces\.obj:1: there is no v number/],
        ['cut.obj', cube.slice(0, 60), /^cut\.obj:.*expected a number/],
        ['big.obj', 'v 1e39 0 0\n', /^big\.obj:1: expected a number/],
        ['far.obj', 'v 0 0 0\nv 1e30 0 0\nv 0 1 0\nf 1 2 3\n', /^far\.obj: larger than/],
        ['point.obj', 'v 1 1 1\nf 1 1 1\n', /^point\.obj: larger than .* or smaller/],
        ['<b>\u00e9"\\.obj', 'v x', /^<b>_"\\\.obj:1: expected a number/],
        ['text.stl', 'solid\nfacet', /^text\.stl:2: expected normal/]]) {
        const said = await drop(name, content);
        check('a bad file gets one line: ' + name, line.test(said), said);
        check('and the picture stays: ' + name, await page.evaluate(() => S.shape) === 0);
    }
    await same(page, 'after bad files');
    await page.evaluate(() => openFile({ name: 'folder', size: 0,
        arrayBuffer: () => Promise.reject(new DOMException('', 'NotReadableError')) }));
    check('a folder', await page.locator('#message').innerText() === 'folder: cannot be read');
    await page.evaluate(() => openFile({ name: 'disk.obj', size: 2e9 }));
    check('too large', /^disk\.obj: too large/.test(await page.locator('#message').innerText()));
    check('memory ends with a word', await page.evaluate(() => wasm.page_room(0xfffff000)) === 0);

    check('a cube', await drop('a "cube".obj', cube) === 'a "cube".obj: 12 triangles');
    fs.writeFileSync(T + '/cube.obj', cube);
    await same(page, 'a dropped OBJ', [T + '/cube.obj']);
    await compiles(page, 'a dropped OBJ', [['a "cube".obj', cube]]);
    const [chooser] = await Promise.all([page.waitForEvent('filechooser'),
        page.locator('.open span').click()]);
    const pieces = 20000, disc = [], corners = [];
    for (let i = 0; i < pieces; i++) {
        const angle = i * 2 * Math.PI / pieces;
        disc.push(`v ${Math.cos(angle)} ${Math.sin(angle)} 0`), corners.push(i + 1);
    }
    fs.writeFileSync(T + '/disc.obj', disc.join('\n') + '\nf ' + corners.join(' '));
    await chooser.setFiles(T + '/disc.obj');
    await page.waitForFunction(() => /^disc/.test($('#message').textContent));
    check('a polygon of many corners',
        await page.evaluate(() => wasm.page_triangles(2)) === pieces - 2);
    await same(page, 'an opened OBJ', [T + '/disc.obj']);

    // 500,000 triangles, 22 MB; and again, in the memory of the first
    const side = 501, lines = [];
    for (let i = 0; i < side * side; i++)
        lines.push(`v ${i % side} ${Math.floor(i / side)} ${(Math.sin(i * 0.01) * 20).toFixed(3)}`);
    for (let i = 0; i < (side - 1) * side; i++) {
        const a = i + 1;
        if (i % side < side - 1) lines.push(`f ${a} ${a + 1} ${a + side + 1} ${a + side}`);
    }
    fs.writeFileSync(T + '/grid.obj', lines.join('\n'));
    const memory = () => page.evaluate(() => wasm.memory.buffer.byteLength);
    const memories = [];
    for (let k = 0; k < 5; k++) {    // the third may not fit into the gaps of two
        await page.evaluate(() => say(''));
        await page.locator('input[type=file]').setInputFiles(T + '/grid.obj');
        await page.waitForFunction(() => /^grid.*500,000/.test($('#message').textContent), null,
            { timeout: 60000 });
        memories.push(await memory());
    }
    await same(page, 'half a million triangles', [T + '/grid.obj']);
    check('memory is used again', memories[4] === memories[2], memories);
    await page.context().close();
}

// ---- the address --------------------------------------------------------------------------------

{
    const page = await open('yaw=nan&n=1e999&kd=1,2&ks=9,-3,.5&shape=77&p1=,,&view=1.4&zoom=1e-9&' +
        'lamp=-5&terms=0&flags=1e9&__proto__=1&I2=<script>,0,0&model=0x5&shading=', {});
    check('a bad address gives a state in its limits', await page.evaluate(() =>
        Object.entries(FIELDS).every(([name, [low, high, ...first]]) =>
            [S[name]].flat().length === first.length &&
            [S[name]].flat().every(v => v >= low && v <= high))));
    await same(page, 'a bad address');
    await go(page, RICH + '&shape=1&model=1&wire=1&yaw=-2.5');
    await page.locator('input[name=flags4] + span').click();
    await page.context().grantPermissions(['clipboard-read', 'clipboard-write']);
    await page.locator('#share').click();
    const address = await page.evaluate(() => navigator.clipboard.readText());
    const second = await open(address.split('#')[1]);
    check('an address brings the state back',
        (await draws(page)).words.equals((await draws(second)).words), address);
    await page.context().close(), await second.context().close();
}

// ---- mouse, keys, fingers -----------------------------------------------------------------------

{
    const page = await open(''), canvas = page.locator('canvas').first();
    const state = () => page.evaluate(() => ({ ...S, x: probeMark().point[0] / canvas.width }));
    const box = await canvas.boundingBox(), x = box.x + box.width / 2, y = box.y + box.height / 2;
    const start = await state();
    await page.mouse.move(x, y), await page.mouse.down(), await page.mouse.move(x + 80, y + 30);
    await page.mouse.up();
    const dragged = await state();
    check('a drag turns', dragged.pitch > start.pitch && dragged.yaw > start.yaw + 0.5 &&
        dragged.turn === 0);
    await page.mouse.wheel(0, -300);
    check('the wheel zooms', await soon(async () => (await state()).zoom > dragged.zoom));
    await canvas.focus();
    const before = await state();
    for (const key of ['ArrowRight', 'ArrowDown', '+', '+', '-', 'Shift+ArrowLeft'])
        await page.keyboard.press(key);
    const after = await state();
    await page.keyboard.press(' ');    // from here on the point moves
    check('keys', after.yaw > before.yaw && after.pitch > before.pitch &&
        after.zoom > before.zoom && after.x < before.x && (await state()).turn === 1,
        JSON.stringify([before, after]));
    await page.waitForFunction(() => /emission .*specular/.test($('#spoken').textContent));
    await page.keyboard.press('Tab');
    check('Tab goes on', await page.evaluate(() => document.activeElement.ariaLabel) ===
        'Lamp 1, front');
    const nameless = await page.evaluate(() =>
        [...document.querySelectorAll('button, input')].filter(node => !(node.ariaLabel ||
            node.textContent.trim() || node.labels?.[0]?.textContent.trim())).length);
    check('every control has a name', nameless === 0, nameless);
    await page.context().close();

    const calm = await open('', { reducedMotion: 'reduce' });
    check('still where motion is unwelcome', await calm.evaluate(() => S.turn) === 0);
    await calm.context().close();

    const phone = await open('turn=0', { viewport: { width: 360, height: 740 },
        deviceScaleFactor: 3, isMobile: true, hasTouch: true });
    check('nothing is wider than a telephone', await phone.evaluate(() =>
        document.scrollingElement.scrollWidth <= innerWidth));
    check('sharp on a dense screen', await soon(() => phone.evaluate(() =>
        canvas.width === 3 * canvas.clientWidth)));
    const raw = await phone.context().newCDPSession(phone);
    const touch = (type, ...points) => raw.send('Input.dispatchTouchEvent', { type,
        touchPoints: points.map(([x, y], id) => ({ x, y, id })) });
    const read = () => phone.evaluate(() => ({ ...S }));
    const first = await read();
    await touch('touchStart', [150, 200]), await touch('touchMove', [190, 215]);
    await touch('touchEnd');
    const turned = await read();
    check('a finger turns', turned.yaw > first.yaw && turned.pitch > first.pitch);
    await touch('touchStart', [150, 200], [200, 200]);
    await touch('touchMove', [110, 200], [240, 200]);
    await touch('touchEnd');
    check('two zoom', (await read()).zoom > turned.zoom);
    const bulb = phone.locator('#maps svg').nth(1).locator('.bulb').first();
    await bulb.scrollIntoViewIfNeeded();
    const spotOf = async () => {
        const box = await bulb.boundingBox();
        return [box.x + box.width / 2, box.y + box.height / 2];
    };
    const [left, top] = await spotOf(), was = (await read()).p1;
    const scrolled = () => phone.evaluate(() => scrollY), above = await scrolled();
    await touch('touchStart', [left, top - 20]);
    for (const k of [5, 10, 15]) await touch('touchMove', [left - k, top - 20 - k]);
    await touch('touchEnd');
    const now = (await read()).p1, [goneX, goneY] = await spotOf();
    check('a finger 20 pixels away drags a lamp on its map', now[0] < was[0] &&
        now[1] === was[1] && now[2] < was[2] &&
        Math.hypot(goneX - left + 15, goneY - top + 35) < 2,
        [was, now, goneX - left, goneY - top]);
    check('and does not scroll the page', await scrolled() === above);
    await phone.context().close();
}

// ---- light and dark -----------------------------------------------------------------------------

{
    const papers = [];
    for (const colorScheme of ['light', 'dark']) {
        const page = await open('turn=0', { colorScheme });
        const { worst, paper } = await page.evaluate(() => {
            const style = getComputedStyle(document.documentElement);
            const light = name => luminance(fromHex(style.getPropertyValue(name).trim())) + 0.05;
            const ratios = ['--ink', '--quiet', '--e', '--a', '--d', '--s'].flatMap(text =>
                ['--paper', '--panel'].map(back => light(text) / light(back)));
            return { worst: Math.min(...ratios.map(r => Math.max(r, 1 / r))), paper };
        });
        check('contrast of text, ' + colorScheme, worst >= 4.5, worst);
        papers.push(String(paper));
        await same(page, colorScheme);
        await page.emulateMedia({ colorScheme: colorScheme === 'dark' ? 'light' : 'dark' });
        await page.waitForFunction(old => String(paper) !== old, String(paper));
        await page.context().close();
    }
    check('two papers', papers[0] !== papers[1]);
}

// ---- time ---------------------------------------------------------------------------------------

for (const simd of [1, 0]) {
    const page = await open('turn=0&simd=' + simd);
    fs.writeFileSync(T + '/state', (await draws(page, 640, 480)).words);
    const times = () => page.evaluate(async () => {
        const spent = [];
        const put = document.createElement('canvas').getContext('2d', { alpha: false });
        put.canvas.width = 640, put.canvas.height = 480;
        for (let i = -20; i < 300; i++) {
            await new Promise(requestAnimationFrame);
            const begin = performance.now();
            S.yaw = round((i * 0.02) % 6);
            put.putImageData(new ImageData(draw(640, 480, 1), 640), 0, 0);
            showAnswer(probe(350, 220));
            if (i >= 0) spent.push(performance.now() - begin);
        }
        return spent.sort((a, b) => a - b);
    });
    const spent = await times();
    const name = simd ? 'with simd128' : 'without';
    console.log(`640 x 480, ${name}: median ${spent[150].toFixed(2)} ms, 99th percentile ` +
        `${spent[297].toFixed(2)} ms a frame`);
    await page.context().close();
}
process.stdout.write(execFileSync(native, ['bench', T + '/state']));

const asked = requests.filter(url => !url.startsWith(opened) && url !== served &&
    !url.startsWith(served + '#') && !url.startsWith('data:'));
check('no request to anywhere else', !asked.length, asked);
check('no word in the console', !complaints.length, complaints.slice(0, 5).join('\n'));
await browser.close();
server.close();
fs.rmSync(T, { recursive: true });
console.log(`${passed} passed, ${failed} failed`);
process.exit(failed ? 1 : 0);
