// commonjs.js file - joins index.js and what it imports into one CommonJS module.  It knows the
// forms of import and export that these files have, and refuses others.
import { readFileSync, writeFileSync } from "node:fs";

const made = [];    // { file, text, names }, each after those that it imports

/** Refuses an import of a name that its module does not export: it would be undefined. */
function refuseMissing(file, list, other) {
    const { names } = made.find((one) => one.file === other);
    for (const name of list.match(/\w+/g)) {
        if (!names.includes(name)) throw new Error(`${file}.js: ${other}.js exports no ${name}`);
    }
}

/** The name of a module within the file that is made. */
function joined(file) {
    if (made.some((other) => other.file === file)) return `_${file}`;
    const names = [], own = (name) => { names.push(name); };
    const text = readFileSync(new URL(`${file}.js`, import.meta.url), "utf8")
        .replace(/^import \* as (\w+) from "\.\/(\w+)\.js";$/gm, (_, name, other) =>
            `const ${name} = ${joined(other)};`)
        .replace(/^import (\{[^}]*\}) from "\.\/(\w+)\.js";$/gm, (_, list, other) => {
            const from = joined(other);
            refuseMissing(file, list, other);
            return `const ${list} = ${from};`;
        })
        .replace(/^import (\w+) from "\.\/(\w+)\.js";$/gm, (_, name, other) =>
            `const ${name} = ${joined(other)}.default;`)
        .replace(/^export default /gm, () => `${own("default: value") ?? ""}const value = `)
        .replace(/^export \{ ([^}]*) \};$/gm, (_, list) => own(list) ?? "")
        .replace(/^export (class|const(?!.*, \w+ = )|function|async function) (\w+)/gm, (_, kind, name) =>
            `${own(name) ?? ""}${kind} ${name}`);
    if (/^(import|export)\b/m.test(text)) throw new Error(`${file}.js: a new form of import or export`);
    made.push({ file, text, names: names.join(", ").split(", ") });
    return `_${file}`;
}

joined("index");
const modules = made.map(({ file, text, names }) =>
    `const _${file} = (() => {\n${text}\nreturn { ${names.join(", ")} };\n})();\n`);
// a line for each name, by which import finds it as well
const lines = made.at(-1).names.map((name) => `exports.${name} = _index.${name};\n`);
writeFileSync(process.argv[2], ['"use strict";\n', ...modules, ...lines].join(""));
