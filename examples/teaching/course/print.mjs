// print.mjs - slides with their answers as PDF, by headless Chromium, which is spoken to over a pipe.
// usage: node print.mjs chromium light|dark slides.html slides.pdf [...]
import { spawn } from 'child_process';
import fs from 'fs';
import path from 'path';

const [program, scheme, ...files] = process.argv.slice(2);
const chromium = spawn(program, ['--headless', '--no-sandbox', '--disable-gpu', '--remote-debugging-pipe'],
    { stdio: ['ignore', 'ignore', 'ignore', 'pipe', 'pipe'] });
const waiting = new Map();
let count = 0, rest = '';
chromium.on('error', error => { throw error; });
chromium.stdio[4].on('data', bytes => {
    const messages = (rest + bytes).split('\0');
    rest = messages.pop();
    for (const { id, result, error } of messages.map(text => JSON.parse(text))) {
        if (!waiting.has(id)) continue;
        const { done, fail } = waiting.get(id);
        waiting.delete(id);
        if (error) fail(Error(error.message));
        else done(result);
    }
});
function ask(method, params = {}, sessionId = undefined) {
    chromium.stdio[3].write(JSON.stringify({ id: ++count, method, params, sessionId }) + '\0');
    return new Promise((done, fail) => waiting.set(count, { done, fail }));
}

async function print(html, pdf) {
    const url = 'file://' + path.resolve(html) + '?print-pdf';
    const { targetId } = await ask('Target.createTarget', { url: 'about:blank' });
    const { sessionId } = await ask('Target.attachToTarget', { targetId, flatten: true });
    const page = (method, params) => ask(method, params, sessionId);
    await page('Emulation.setEmulatedMedia', { features: [{ name: 'prefers-color-scheme', value: scheme }] });
    await page('Page.navigate', { url });
    for (let ready = false; !ready; await new Promise(done => setTimeout(done, 50)))
        ready = (await page('Runtime.evaluate', { expression: 'window.printable === true' })).result.value;
    const { data } = await page('Page.printToPDF', { preferCSSPageSize: true, printBackground: true });
    fs.writeFileSync(pdf, Buffer.from(data, 'base64'));
    await ask('Target.closeTarget', { targetId });
}

const late = setTimeout(() => { throw Error('Chromium did not answer within five minutes'); }, 300000);
for (let i = 0; i < files.length; i += 2) await print(files[i], files[i + 1]);
clearTimeout(late);
await ask('Browser.close').catch(() => {});
