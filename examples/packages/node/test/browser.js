// browser.js - draws the scene of page.html here and in the browser that is named, and compares.
//   node browser.js chromium --no-sandbox
// With ORACLE, a folder that oracle.py has filled, a Renderer's bytes are those of the package for Python.
import { spawn } from "node:child_process";
import { readFileSync } from "node:fs";
import { createServer } from "node:http";
import { Mesh, render, Renderer } from "shade-h";
import { sight } from "./sight.js";

const here = new URL(".", import.meta.url);
const page = readFileSync(new URL("page.html", here), "utf8");
const [, call] = /= (render\([^;]*);/.exec(page), [, data] = /const (positions = [^;]*);/.exec(page);
const picture = new Function("render", `const ${data}; return ${call};`)(render);
const hash = (bytes) => bytes.reduce((sum, x) => Math.imul(sum ^ x, 16777619) >>> 0, 2166136261);
const folder = process.env.ORACLE, told = folder ? readFileSync(`${folder}/sight.json`, "utf8") : "null";
const python = folder ? hash(readFileSync(`${folder}/sight.bytes`)) : "none";
const own = folder ? hash(sight(Renderer, Mesh, JSON.parse(told))) : "none";
const drawn = hash(picture.data), wanted = `drawn ${drawn}, read ${drawn}, seen ${own}`;
if (own !== python) throw new Error("the bytes of Node.js and Python differ");

const server = createServer((request, response) => {
    const name = request.url === "/" ? "test/page.html" : request.url.slice(1);
    response.setHeader("Content-Type", name.endsWith(".js") ? "text/javascript" : "text/html");
    if (name === "told.json") return response.end(told);
    try { response.end(readFileSync(new URL(`../${name}`, here))); }
    catch { response.writeHead(404).end(); }
}).listen(0, "127.0.0.1", () => {
    const [command, ...flags] = process.argv.slice(2), url = `http://127.0.0.1:${server.address().port}/`;
    const browser = spawn(command, [...flags, "--headless", "--disable-gpu", "--virtual-time-budget=60000",
                                    "--dump-dom", url], { stdio: ["ignore", "pipe", "ignore"] });
    let dom = "";
    browser.stdout.on("data", (text) => dom += text);
    browser.on("close", () => {
        const got = /<title>(.*?)<\/title>/.exec(dom)?.[1];
        console.log(got === wanted ? "the same bytes" : `got "${got}", want "${wanted}"`);
        process.exit(got === wanted ? 0 : 1);
    });
});
