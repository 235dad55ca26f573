// Reads 3MF, a ZIP archive of XML, as ../python/shade_h/threemf.py does.  The archive is unpacked
// by the platform, the XML parsed by the DOMParser of browsers or one that the caller has.
import { ShadeError, record } from "./arguments.js";

const TRIANGLES = 20e6, INSTANCES = 100_000, DEPTH = 100;    // of all instances together
const BYTES = 1e9, RATIO = 500, FILES = 10_000;    // of all XML, unpacked; unpacked to packed; in an archive
const CLAY = [0xBF / 255, 0xB2 / 255, 0xA4 / 255];

const fail = (words) => { throw new ShadeError(`model: ${words}`); };

// ---- ZIP

/** Where the files of an archive lie, by their names in small letters. */
function entriesOf(bytes) {
    const data = new DataView(bytes.buffer, bytes.byteOffset, bytes.length), found = new Map();
    let end = bytes.length - 22;
    while (end >= 0 && end > bytes.length - 65558 && data.getUint32(end, true) !== 0x06054B50) end--;
    if (end < 0 || data.getUint32(end, true) !== 0x06054B50) fail("it is no ZIP archive");
    const count = Math.min(data.getUint16(end + 10, true), FILES);
    for (let i = 0, at = data.getUint32(end + 16, true); i < count; i++) {
        if (at + 46 > bytes.length || data.getUint32(at, true) !== 0x02014B50) fail("its ZIP directory is damaged");
        const length = data.getUint16(at + 28, true), name = bytes.subarray(at + 46, at + 46 + length);
        found.set(new TextDecoder().decode(name).replace(/^\/+/, "").toLowerCase(), {
            method: data.getUint16(at + 10, true), packed: data.getUint32(at + 20, true),
            offset: data.getUint32(at + 42, true) });
        at += 46 + length + data.getUint16(at + 30, true) + data.getUint16(at + 32, true);
    }
    return found;
}

/** All of a stream, which must have at most so many bytes. */
async function drained(stream, most, path) {
    const reader = stream.getReader(), parts = [];
    let size = 0;
    for (;;) {
        const { done, value } = await reader.read().catch(() => fail(`${path} cannot be unpacked`));
        if (done) break;
        parts.push(value);
        size += value.length;
        if (size > most) {
            reader.cancel().catch(() => {});
            fail(`${path} unpacks to more than ${most} bytes`);
        }
    }
    const out = new Uint8Array(size);
    let at = 0;
    for (const part of parts) {
        out.set(part, at);
        at += part.length;
    }
    return out;
}

// ---- XML

/** The elements in an element. */
function* within(element) {
    for (let node = element.firstChild; node; node = node.nextSibling) if (node.nodeType === 1) yield node;
}

function text(element, name, usual) {
    const got = element.getAttribute(name);
    return got === null || got === undefined || got === "" ? usual ?? fail(`${element.localName} has no ${name}`) : got;
}

function number(element, name) {
    const got = Number(text(element, name));
    return Number.isNaN(got) ? fail(`${name} of ${element.localName} is no number`) : got;
}

function color(words) {
    const digits = /^#([0-9a-f]{6})([0-9a-f]{2})?$/i.exec(words)?.[1] ?? fail(`${words.slice(0, 20)} is no colour`);
    return [0, 2, 4].map((k) => parseInt(digits.slice(k, k + 2), 16) / 255);
}

const IDENTITY = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0];

/** Three rows of a matrix, which multiplies rows in the file. */
function placeOf(element) {
    const words = text(element, "transform", "");
    if (!words) return IDENTITY;
    const m = words.trim().split(/\s+/).map(Number);
    if (m.length !== 12 || !m.every((x) => Math.abs(x) < 1e30)) fail("a transform must be 12 numbers");
    return IDENTITY.map((_, i) => m[3 * (i % 4) + (i >> 2)]);
}

const product = (a, b) => a.map((_, i) => [0, 1, 2].reduce(
    (sum, k) => sum + a[4 * (i >> 2) + k] * b[4 * k + i % 4], i % 4 === 3 ? a[i] : 0));

/** The path of another file that an element names, or its own. */
function pathOf(element, own) {
    for (let i = 0; i < element.attributes.length; i++) {
        const attribute = element.attributes.item(i);
        if (attribute.localName === "path") return attribute.value.replace(/^\/+/, "");
    }
    return own;
}

/** One file of XML: its objects, groups of colours, and what is built of them. */
class Model {
    objects = new Map();
    colors = new Map();
    items = [];

    constructor(path, root) {
        this.path = path;
        for (const part of within(root)) {
            if (part.localName === "resources") for (const it of within(part)) this.resource(it);
            if (part.localName === "build") for (const it of within(part)) this.items.push(this.#use(it));
        }
    }

    #use(element) {
        return { path: pathOf(element, this.path), number: text(element, "objectid"), place: placeOf(element) };
    }

    resource(it) {
        const group = { basematerials: "displaycolor", colorgroup: "color" }[it.localName];
        if (group) {
            this.colors.set(text(it, "id"), [...within(it)].map((one) => color(text(one, group, "#FFFFFF"))));
        } else if (it.localName === "object") {
            const made = { vertices: [], faces: [], marks: [], parts: [], arrays: null };
            const usual = [it.getAttribute("pid") ?? "", it.getAttribute("pindex") || "0"];
            for (const part of within(it)) {
                if (part.localName === "mesh") for (const list of within(part)) this.#mesh(made, list, usual);
                if (part.localName === "components") for (const one of within(part)) made.parts.push(this.#use(one));
            }
            this.objects.set(text(it, "id"), made);
        }
    }

    #mesh({ vertices, faces, marks }, list, [pid, pindex]) {
        for (const it of within(list)) {
            if (it.localName === "vertex") vertices.push(number(it, "x"), number(it, "y"), number(it, "z"));
            if (it.localName !== "triangle") continue;
            faces.push(number(it, "v1"), number(it, "v2"), number(it, "v3"));
            marks.push([text(it, "pid", pid), text(it, "p1", pindex)]);
            if (marks.length > TRIANGLES) fail(`there are more than ${TRIANGLES} triangles`);
        }
    }

    /** Vertices, faces, and the colours of these where the file says one. */
    arrays(it) {
        if (it.arrays) return it.arrays;
        const { vertices, faces, marks } = it, count = vertices.length / 3;
        if (!faces.every((i) => Number.isInteger(i) && i >= 0 && i < count)) {
            fail(`a triangle has a vertex that is not there: there are ${count}`);
        }
        const known = marks.map(([pid, place]) => (/^\d{1,8}$/.test(place) ? this.colors.get(pid)?.[place] : undefined));
        const colors = known.some((one) => one) ? known.flatMap((one) => one ?? CLAY) : null;
        it.arrays = { vertices, faces, colors };
        return it.arrays;
    }
}

// ---- all

class Archive {
    models = new Map();
    left = BYTES;
    instances = 0;
    runs = [];
    triangles = 0;

    constructor(bytes, parser) {
        Object.assign(this, { bytes, parser, entries: entriesOf(bytes) });
    }

    async bytesOf(path) {
        const { bytes } = this, data = new DataView(bytes.buffer, bytes.byteOffset, bytes.length);
        const name = path.slice(0, 60);
        const { method, packed, offset } = this.entries.get(path.toLowerCase()) ??
            fail(`there is no ${name} in the archive`);
        if (offset + 30 > bytes.length || data.getUint32(offset, true) !== 0x04034B50) fail(`${name} is cut off`);
        const start = offset + 30 + data.getUint16(offset + 26, true) + data.getUint16(offset + 28, true);
        const body = bytes.subarray(start, start + packed), most = Math.min(this.left, RATIO * packed + 100_000);
        if (body.length < packed) fail(`${name} is cut off`);
        if (method !== 0 && method !== 8) fail(`${name} is packed in a way that is not read`);
        const stream = new Blob([body]).stream();
        const out = await drained(method ? stream.pipeThrough(new DecompressionStream("deflate-raw")) : stream,
                                  most, name);
        this.left -= out.length;
        return out;
    }

    async xml(path) {
        const words = new TextDecoder().decode(await this.bytesOf(path)), name = path.slice(0, 60);
        if (/<!(DOCTYPE|ENTITY)/i.test(words)) fail(`${name}: document types and entities are refused`);
        const wrong = (why) => fail(`${name}: its XML is wrong: ${`${why}`.split("\n")[0].slice(0, 100)}`);
        let made, first;
        const told = (level, why) => { if (level !== "warning") first ??= why; };
        try {
            made = new this.parser({ errorHandler: told }).parseFromString(words, "text/xml").documentElement;
        } catch (why) {    // what no parser can go on from
            first ??= why.message;
        }
        if (first !== undefined) wrong(first);
        if (!made) wrong("there is no element");
        for (let node = made; node; node = node.firstChild) if (node.localName === "parsererror") wrong("");
        return made;
    }

    async model(path) {
        if (!this.models.has(path)) this.models.set(path, new Model(path, await this.xml(path)));
        return this.models.get(path);
    }

    /** The name of the model that has the items. */
    async root() {
        if (this.entries.has("_rels/.rels")) {
            for (const it of within(await this.xml("_rels/.rels"))) {
                if (text(it, "Type", "").endsWith("/3dmodel")) return text(it, "Target").replace(/^\/+/, "");
            }
        }
        return [...this.entries.keys()].find((name) => name.endsWith(".model")) ?? "3D/3dmodel.model";
    }

    async build({ path, number: id, place }, depth) {
        if (++this.instances > INSTANCES || depth > DEPTH) {
            fail(`there are more than ${INSTANCES} instances, ${DEPTH} deep, or they go in circles`);
        }
        const model = await this.model(path);
        const it = model.objects.get(id) ?? fail(`there is no object ${id.slice(0, 20)} in ${path.slice(0, 60)}`);
        if (it.faces.length) {
            this.runs.push({ ...model.arrays(it), place });
            this.triangles += it.faces.length / 3;
            if (this.triangles > TRIANGLES) fail(`there are more than ${TRIANGLES} triangles`);
        }
        for (const part of it.parts) await this.build({ ...part, place: product(place, part.place) }, depth + 1);
    }

    /** All instances as one mesh. */
    mesh() {
        const { runs } = this, count = runs.reduce((sum, run) => sum + run.vertices.length, 0);
        const tinted = runs.some((run) => run.colors), spare = tinted && count / 3 === this.triangles;
        // colours of faces could be taken for those of vertices: a vertex that no face has tells them apart
        const positions = new Float64Array(count + (spare ? 3 : 0)), indices = new Uint32Array(3 * this.triangles);
        const colors = tinted ? new Float64Array(3 * this.triangles) : null;
        let vertex = 0, index = 0;
        for (const { vertices: v, faces, colors: own, place: m } of runs) {
            const c = [0, 1, 2].map((k) => m[4 + (k + 1) % 3] * m[8 + (k + 2) % 3] - m[4 + (k + 2) % 3] * m[8 + (k + 1) % 3]);
            const mirrored = m[0] * c[0] + m[1] * c[1] + m[2] * c[2] < 0;
            for (let i = 0; i < faces.length; i++) {
                indices[index + i] = vertex / 3 + faces[mirrored ? i - i % 3 + 2 - i % 3 : i];
                if (colors) colors[index + i] = own ? own[i] : CLAY[i % 3];
            }
            for (let i = 0; i < v.length; i++) {
                const k = 4 * (i % 3), at = i - i % 3;
                positions[vertex + i] = v[at] * m[k] + v[at + 1] * m[k + 1] + v[at + 2] * m[k + 2] + m[k + 3];
            }
            vertex += v.length;
            index += faces.length;
        }
        for (let k = 0; spare && k < 3; k++) positions[count + k] = positions[k];
        return colors ? { positions, indices, colors } : { positions, indices };
    }
}

export async function read3mf(bytes, options) {
    const { DOMParser: parser = globalThis.DOMParser } = record("options", options, ["DOMParser"]);
    if (!(bytes instanceof Uint8Array)) fail("must be the bytes of a file, a Uint8Array");
    if (typeof parser !== "function") {
        throw new ShadeError("options.DOMParser: Node.js has none of its own: hand over that of @xmldom/xmldom");
    }
    const archive = new Archive(bytes, parser), path = await archive.root(), root = await archive.model(path);
    const all = [...root.objects.keys()].map((id) => ({ path, number: id, place: IDENTITY }));
    for (const item of root.items.length ? root.items : all) await archive.build(item, 0);
    if (!archive.triangles) fail("there are no triangles");
    return [archive.mesh()];
}
