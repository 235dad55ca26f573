// player.mjs - the bank as systems of QTI take it: a converter reads the package, a player shows each item and
// scores answers.   node player.mjs questions.zip folder-of-its-items browser
import { chromium } from 'playwright-core';
import { convertPackageFile, convertQti2toQti3 } from '@citolab/qti-convert/qti-convert-node';
import fs from 'fs';
import os from 'os';
import path from 'path';

const [zip, folder, executablePath] = process.argv.slice(2);
let passed = 0, failed = 0;
function check(what, good, more = '') {
    if (good) { passed++; return; }
    failed++;
    console.log(`FAIL      ${what} ${JSON.stringify(more)}`);
}
const out = fs.mkdtempSync(path.join(os.tmpdir(), 'qti-'));
const log = console.log;
console.log = () => {};                 // the converter talks
await convertPackageFile(zip, path.join(out, 'three.zip'));
console.log = log;
check('the package is converted', fs.statSync(path.join(out, 'three.zip')).size > 10000);
fs.rmSync(out, { recursive: true });

const browser = await chromium.launch({ executablePath, args: ['--no-sandbox', '--disable-gpu'] });
const page = await browser.newPage(), complaints = [];
page.on('pageerror', error => complaints.push(error.message));
await page.setContent('<!DOCTYPE html><body></body>');
const cdn = path.join(process.env.NODE_FOLDER, 'node_modules/@citolab/qti-components/cdn/index.global.js');
await page.addScriptTag({ path: cdn });
const items = fs.readdirSync(folder).filter(name => /^q\d+\.xml$/.test(name)).sort();
let numbers = 0;
for (const name of items) {
    const two = fs.readFileSync(path.join(folder, name), 'utf8'), xml = await convertQti2toQti3(two);
    const value = +(two.match(/<correctResponse><value>(.*?)<\/value>/) || [])[1];
    const bounds = [...two.matchAll(/<baseValue baseType="float">(.*?)<\/baseValue><\/[gl]te>/g)].map(found => +found[1]);
    const number = bounds.length === 2, within = (bounds[1] - bounds[0]) / 2;
    // right, near it from both sides, and too far off
    const answers = number ? [value, value + 0.9 * within, value - 0.9 * within, value + 1.2 * within, value - 1.2 * within]
        : ['words'];
    const got = await page.evaluate(async ([xml, answers]) => {
        const plain = xml.replace(/ xmlns(:\w+)?="[^"]*"| xsi:\w+="[^"]*"/g, '')
            .replace('<qti-assessment-item', '<qti-assessment-item xmlns="http://www.w3.org/1999/xhtml"');
        const item = document.importNode(new DOMParser().parseFromString(plain, 'application/xml').documentElement, true);
        document.body.replaceChildren(item);
        await new Promise(done => setTimeout(done, 30));
        const score = () => item.variables.find(one => one.identifier === 'SCORE').value;
        return {
            scores: answers.map(answer => {
                item.updateResponseVariable('RESPONSE', String(answer));
                item.processResponse();
                return +score();
            }),
            fields: item.querySelectorAll('qti-text-entry-interaction, qti-extended-text-interaction').length,
            text: item.querySelector('qti-item-body').textContent.length,
        };
    }, [xml, answers]);
    check(`${name} has one field and words`, got.fields === 1 && got.text > 20, got);
    if (number) {
        numbers++;
        check(`${name}: scores of ${answers}`, got.scores.join() === '1,1,1,0,0', got.scores);
    }
}
check('items of the bank', items.length >= 120 && numbers >= 70, [items.length, numbers]);
check('no complaint of the player', !complaints.length, complaints.slice(0, 3));
await browser.close();
console.log(`${passed} passed, ${failed} failed`);
process.exit(+(failed > 0));
