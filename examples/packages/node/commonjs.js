// commonjs.js file - joins index.js and what it imports into one CommonJS module.  It knows the
// forms of import and export that these files have, and refuses others.
import { readFileSync, writeFileSync } from "node:fs";

const made = [];    // { file, text, names }, each after those that it imports

/** The name of a module within the file that is made. */
function joined(file) {
    if (made.some((other) => other.file === file)) return `_${file}`;
    const names = [], own = (name) => { names.push(name); };
    const text = readFileSync(new URL(`${file}.js`, import.meta.url), "utf8")
        .replace(/^import \* as (\w+) from "\.\/(\w+)\.js";$/gm, (_, name, other) =>
            `const ${name} = ${joined(other)};`)
        .replace(/^import (\{[^}]*\}) from "\.\/(\w+)\.js";$/gm, (_, list, other) =>
            `const ${list} = ${joined(other)};`)
        .replace(/^import (\w+) from "\.\/(\w+)\.js";$/gm, (_, name, other) =>
            `const ${name} = ${joined(other)}.default;`)
        .replace(/^export default /gm, () => `${own("default: value") ?? ""}const value = `)
        .replace(/^export \{ ([^}]*) \};$/gm, (_, list) => own(list) ?? "")
        .replace(/^export (class|const|function|async function) (\w+)/gm, (_, kind, name) =>
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
