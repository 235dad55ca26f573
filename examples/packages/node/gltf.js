// Reads glTF 2.0, GLB or JSON with its buffers inside, as ../python/shade_h/gltf.py does: each
// surface becomes one mesh, as render takes them.
import { ShadeError, record } from "./arguments.js";

const TRIANGLES = 20e6, NODES = 100_000, DEPTH = 200;    // of all instances together
const KINDS = { 5120: Int8Array, 5121: Uint8Array, 5122: Int16Array, 5123: Uint16Array,
                5125: Uint32Array, 5126: Float32Array };
const WIDTHS = { SCALAR: 1, VEC2: 2, VEC3: 3, VEC4: 4 };
// Extensions without which a file can be shown; others that a file requires are refused.
const KNOWN = ["KHR_mesh_quantization", "KHR_texture_transform", "KHR_materials_unlit",
               "KHR_materials_emissive_strength", "KHR_materials_specular", "KHR_materials_ior",
               "KHR_materials_clearcoat", "KHR_materials_sheen", "KHR_materials_transmission",
               "KHR_materials_volume", "KHR_lights_punctual", "EXT_mesh_gpu_instancing"];

const fail = (words) => { throw new ShadeError(`model: ${words}`); };
const isObject = (x) => x !== null && typeof x === "object" && !Array.isArray(x);
const object = (where, name) => (isObject(where) && isObject(where[name]) ? where[name] : {});
const clamp = (x, low, high) => Math.min(Math.max(x, low), high);

function list(where, name) {
    const got = where[name] ?? [];
    return Array.isArray(got) ? got : fail(`${name} is no array`);
}

function whole(where, name, usual) {
    const got = where[name] ?? usual;
    return Number.isInteger(got) && got >= 0 && got < 2 ** 40 ? got : fail(`${name} is no whole number`);
}

function number(where, name, usual) {
    const got = where[name] ?? usual;
    return typeof got === "number" && Math.abs(got) < 1e30 ? got : fail(`${name} is no number`);
}

function numbers(where, name, usual) {
    const got = where[name] ?? usual;
    return Array.isArray(got) && got.length === usual.length &&
        got.every((x) => typeof x === "number" && Math.abs(x) < 1e30)
        ? got : fail(`${name} must be ${usual.length} numbers`);
}

/** The JSON and the buffer of a GLB file. */
function chunks(bytes) {
    const data = new DataView(bytes.buffer, bytes.byteOffset, bytes.length);
    if (bytes.length < 20) fail("the header of GLB is cut off");
    if (data.getUint32(4, true) !== 2) fail(`glTF ${data.getUint32(4, true)} is not read, 2 is`);
    const end = Math.min(data.getUint32(8, true), bytes.length);
    let text = null, binary = null;
    for (let at = 12; at + 8 <= end;) {
        const size = data.getUint32(at, true), kind = data.getUint32(at + 4, true);
        if (at + 8 + size > bytes.length) fail("a chunk of GLB is cut off");
        const body = bytes.subarray(at + 8, at + 8 + size);
        if (kind === 0x4E4F534A) text ??= body;
        if (kind === 0x004E4942) binary ??= body;
        at += 8 + size;
    }
    return [text ?? new Uint8Array(0), binary ?? new Uint8Array(0)];
}

/** The JSON of a file and what it refers to, each access checked. */
class File {
    buffers = new Map();

    constructor(bytes) {
        const glb = bytes.length > 3 && String.fromCharCode(...bytes.subarray(0, 4)) === "glTF";
        const [text, binary] = glb ? chunks(bytes) : [bytes, new Uint8Array(0)];
        try {
            this.json = JSON.parse(new TextDecoder("utf-8", { fatal: true }).decode(text));
        } catch (why) {
            fail(`its JSON is wrong: ${why.message.slice(0, 100)}`);
        }
        if (!isObject(this.json)) fail("its JSON is no object");
        this.binary = binary;
        const version = `${object(this.json, "asset").version ?? 1}`;
        if (!version.startsWith("2")) fail(`glTF ${version.slice(0, 10)} is not read, 2 is`);
        const needed = list(this.json, "extensionsRequired").filter((name) => !KNOWN.includes(name));
        if (needed.length) fail(`it needs ${needed.join(", ").slice(0, 100)}, which is not read`);
    }

    item(name, at) {
        const items = list(this.json, name);
        return Number.isInteger(at) && isObject(items[at]) ? items[at]
            : fail(`there is no ${name}[${`${at}`.slice(0, 20)}]`);
    }

    uri(uri) {
        if (typeof uri !== "string") fail("a URI is no text");
        if (!uri.startsWith("data:")) {
            fail(`${JSON.stringify(uri.slice(0, 60))} is a file of its own: pack it into a GLB`);
        }
        try {
            return Uint8Array.from(atob(uri.slice(uri.indexOf(",") + 1)), (c) => c.charCodeAt(0));
        } catch {
            return fail("a data URI is no base64");
        }
    }

    buffer(at) {
        if (!this.buffers.has(at)) {
            const { uri } = this.item("buffers", at);
            this.buffers.set(at, uri === undefined ? this.binary : this.uri(uri));
        }
        return this.buffers.get(at);
    }

    /** The bytes of a view, and its stride or 0. */
    view(at) {
        const view = this.item("bufferViews", at), start = whole(view, "byteOffset", 0);
        const end = start + whole(view, "byteLength", 0), buffer = this.buffer(whole(view, "buffer", 0));
        if (end > buffer.length) fail(`bufferViews[${at}] ends behind its buffer`);
        return [buffer.subarray(start, end), whole(view, "byteStride", 0)];
    }

    /** The values of an accessor, { values, width }, in double where they are no indices. */
    accessor(at, widths) {
        const it = this.item("accessors", at), count = whole(it, "count", 0);
        const Kind = KINDS[it.componentType], width = WIDTHS[it.type];
        if (!Kind || !widths.includes(width) || count > 3 * TRIANGLES) {
            fail(`accessors[${at}] has another type, or too many values`);
        }
        if (it.sparse !== undefined) fail(`accessors[${at}] is sparse, which is not read`);
        const values = new Float64Array(count * width), size = Kind.BYTES_PER_ELEMENT;
        if (it.bufferView !== undefined) {
            const [bytes, stride] = this.view(it.bufferView), start = whole(it, "byteOffset", 0);
            const step = stride || size * width;
            if (step < size * width || (count && start + (count - 1) * step + size * width > bytes.length)) {
                fail(`accessors[${at}] ends behind its view`);
            }
            const data = new DataView(bytes.buffer, bytes.byteOffset, bytes.length);
            const get = data[`get${Kind.name.replace("Array", "")}`].bind(data);
            for (let i = 0; i < count; i++) {
                for (let k = 0; k < width; k++) values[i * width + k] = get(start + i * step + k * size, true);
            }
        }
        if (it.normalized === true && Kind !== Float32Array) {
            const most = { 5120: 127, 5121: 255, 5122: 32767, 5123: 65535, 5125: 4294967295 }[it.componentType];
            values.forEach((x, i) => { values[i] = Math.max(x / most, -1); });
        }
        return { values, width, whole: Kind !== Float32Array };
    }
}

// ---- places, 4 x 4 by rows

function placeOf(node) {
    const usual = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];
    if (node.matrix !== undefined) {
        const m = numbers(node, "matrix", usual);
        return usual.map((_, i) => m[4 * (i % 4) + (i >> 2)]);
    }
    const q = numbers(node, "rotation", [0, 0, 0, 1]), length = Math.sqrt(q.reduce((sum, v) => sum + v * v, 0));
    const [x, y, z, w] = length > 0 ? q.map((v) => v / length) : [0, 0, 0, 1];
    const s = numbers(node, "scale", [1, 1, 1]), t = numbers(node, "translation", [0, 0, 0]);
    return [(1 - 2 * (y * y + z * z)) * s[0], 2 * (x * y - z * w) * s[1], 2 * (x * z + y * w) * s[2], t[0],
            2 * (x * y + z * w) * s[0], (1 - 2 * (x * x + z * z)) * s[1], 2 * (y * z - x * w) * s[2], t[1],
            2 * (x * z - y * w) * s[0], 2 * (y * z + x * w) * s[1], (1 - 2 * (x * x + y * y)) * s[2], t[2],
            0, 0, 0, 1];
}

const product = (a, b) => a.map((_, i) => [0, 1, 2, 3].reduce(
    (sum, k) => sum + a[4 * (i >> 2) + k] * b[4 * k + i % 4], 0));
const cofactors = (m) => [0, 1, 2].map((row) => [0, 1, 2].map((column) => {
    const [a, b] = [(row + 1) % 3, (row + 2) % 3], [c, d] = [(column + 1) % 3, (column + 2) % 3];
    return m[4 * a + c] * m[4 * b + d] - m[4 * a + d] * m[4 * b + c];
}));

/** The nearest Phong: a highlight as wide as the roughness says, a metal's in its own colour. */
function phong(material) {
    const pbr = object(material, "pbrMetallicRoughness"), more = object(material, "extensions");
    const base = numbers(pbr, "baseColorFactor", [1, 1, 1, 1]).slice(0, 3).map((x) => clamp(x, 0, 1));
    let metal = clamp(number(pbr, "metallicFactor", 1), 0, 1);
    let rough = clamp(number(pbr, "roughnessFactor", 1), 0.05, 1);
    if (pbr.metallicRoughnessTexture !== undefined) [metal, rough] = [0, Math.max(rough, 0.5)];
    const shine = number(object(more, "KHR_materials_emissive_strength"), "emissiveStrength", 1);
    const none = [0, 0, 0], dark = material.emissiveTexture !== undefined;
    const emission = numbers(material, "emissiveFactor", none).map((x) => (dark ? 0 : clamp(x * shine, 0, 100)));
    if (more.KHR_materials_unlit !== undefined) return { emission: base, ambient: none, diffuse: none };
    const diffuse = base.map((x) => x * (1 - metal / 2));    // half of a metal's light is diffuse
    return { emission, ambient: diffuse, diffuse,
             specular: base.map((x) => (0.04 + (x - 0.04) * metal) * (1.5 - rough)),
             shininess: Math.min(2 / rough ** 4 - 2, 1000) };
}

/** Corners of a list, a strip or a fan of triangles. */
function cornersOf(index, mode) {
    if (mode === 4) return index.slice(0, index.length - index.length % 3);
    const out = [];
    for (let i = 0; i + 2 < index.length; i++) {
        const turned = mode === 5 && i % 2;
        out.push(index[mode === 6 ? 0 : turned ? i + 1 : i], index[mode === 6 ? i + 1 : turned ? i : i + 1],
                 index[i + 2]);
    }
    return out;
}

class Scene {
    surfaces = new Map();    // by the number of their material, in the order in which they appear
    images = new Map();
    warned = new Set();
    nodes = 0;
    triangles = 0;

    constructor(file, picture) {
        Object.assign(this, { file, picture });
    }

    warn(words) {
        if (!this.warned.has(words)) console.warn(`shade-h: model: ${words}`);
        this.warned.add(words);
    }

    image(texture) {
        const { source } = this.file.item("textures", texture.index);
        if (this.images.has(source)) return this.images.get(source);
        const image = this.file.item("images", source);
        let made = null;
        if (this.picture) {
            const bytes = image.bufferView === undefined ? this.file.uri(image.uri)
                : this.file.view(image.bufferView)[0];
            made = this.picture(bytes.slice(), image.mimeType);
        } else {
            this.warn("it has pictures, which the option picture decodes; its faces are drawn without them");
        }
        this.images.set(source, made);
        return made;
    }

    surface(at) {
        if (this.surfaces.has(at)) return this.surfaces.get(at);
        const material = at === undefined ? {} : this.file.item("materials", at);
        const texture = object(object(material, "pbrMetallicRoughness"), "baseColorTexture");
        const mode = material.alphaMode ?? "OPAQUE", pbr = object(material, "pbrMetallicRoughness");
        const alpha = clamp(numbers(pbr, "baseColorFactor", [1, 1, 1, 1])[3], 0, 1);
        let image = texture.index === undefined ? null : this.image(texture);
        if (image && mode !== "BLEND" && mode !== "MASK") {    // without its alpha
            const step = image.data.length / (image.width * image.height);
            const data = Uint8ClampedArray.from(image.data, (x, i) => (step === 4 && i % 4 === 3 ? 255 : x));
            image = { ...image, data };
        }
        const plain = { pbrMetallicRoughness: { metallicFactor: 0 } };
        const clear = mode === "BLEND" ? { blend: true, opacity: alpha }
            : mode === "MASK" && image ? { cutoff: clamp(number(material, "alphaCutoff", 0.5), 0, 1) / Math.max(alpha, 1e-3) }
                : {};
        const made = { material: phong(at === undefined ? plain : material), texture, image, clear, runs: [] };
        this.surfaces.set(at, made);
        return made;
    }

    visit(at, place, depth) {
        if (++this.nodes > NODES || depth > DEPTH) {
            fail(`there are more than ${NODES} nodes, ${DEPTH} deep, or they go in circles`);
        }
        const node = this.file.item("nodes", at), here = product(place, placeOf(node));
        if (node.mesh !== undefined) {
            const { file } = this;
            list(file.item("meshes", node.mesh), "primitives").filter(isObject)
                .forEach((it) => this.primitive(it, here));
        }
        for (const child of list(node, "children")) this.visit(child, here, depth + 1);
    }

    primitive(it, m) {
        const attributes = object(it, "attributes"), mode = whole(it, "mode", 4);
        if (mode < 4 || mode > 6 || attributes.POSITION === undefined) {
            this.warn("points and lines are not drawn");
            return;
        }
        if (isObject(object(it, "extensions").KHR_draco_mesh_compression)) {
            fail("it needs KHR_draco_mesh_compression, which is not read");
        }
        const points = this.file.accessor(attributes.POSITION, [3]).values, count = points.length / 3;
        const given = it.indices !== undefined ? this.file.accessor(it.indices, [1])
            : { values: Array.from({ length: count }, (_, i) => i), whole: true };
        if (!given.whole || !given.values.every((i) => i >= 0 && i < count)) {
            fail("an index points behind the vertices");
        }
        const corners = cornersOf(given.values, mode), c = cofactors(m);
        const mirrored = m[0] * c[0][0] + m[1] * c[0][1] + m[2] * c[0][2] < 0;
        for (let i = 0; mirrored && i < corners.length; i += 3) {
            [corners[i], corners[i + 2]] = [corners[i + 2], corners[i]];
        }
        this.triangles += corners.length / 3;
        if (this.triangles > TRIANGLES) fail(`there are more than ${TRIANGLES} triangles`);
        const surface = this.surface(it.material), positions = new Float64Array(points.length);
        for (let i = 0; i < points.length; i += 3) {
            for (let k = 0; k < 3; k++) {
                positions[i + k] = points[i] * m[4 * k] + points[i + 1] * m[4 * k + 1] + points[i + 2] * m[4 * k + 2] +
                    m[4 * k + 3];
            }
        }
        surface.runs.push({ positions, corners, normals: this.normals(attributes, c, mirrored ? -1 : 1, count),
                            uv: this.uv(attributes, surface.texture, count), colors: this.colors(attributes, count) });
    }

    normals(attributes, c, sign, count) {
        if (attributes.NORMAL === undefined) return null;
        const { values } = this.file.accessor(attributes.NORMAL, [3]);
        if (values.length !== 3 * count) return null;
        for (let i = 0; i < values.length; i += 3) {
            const n = c.map((row) => sign * (values[i] * row[0] + values[i + 1] * row[1] + values[i + 2] * row[2]));
            const length = Math.sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
            for (let k = 0; k < 3; k++) values[i + k] = Number.isFinite(n[k] / length) ? n[k] / length : 0;
        }
        return values;
    }

    uv(attributes, texture, count) {
        const change = object(object(texture, "extensions"), "KHR_texture_transform");
        const name = attributes[`TEXCOORD_${whole({ ...texture, ...change }, "texCoord", 0)}`];
        const got = name !== undefined && texture.index !== undefined ? this.file.accessor(name, [2]).values : [];
        const uv = got.length === 2 * count ? got : new Float64Array(2 * count);
        const angle = number(change, "rotation", 0), [cos, sin] = [Math.cos(angle), Math.sin(angle)];
        const [a, b] = numbers(change, "scale", [1, 1]), [u0, v0] = numbers(change, "offset", [0, 0]);
        for (let i = 0; i < uv.length; i += 2) {
            const [u, v] = [uv[i] * a, uv[i + 1] * b];
            uv[i] = u * cos + v * sin + u0;
            uv[i + 1] = 1 - (v * cos - u * sin + v0);
        }
        return uv.map((x) => (Number.isFinite(x) ? x : 0));
    }

    /** Display colours of the linear ones of vertices. */
    colors(attributes, count) {
        if (attributes.COLOR_0 === undefined) return null;
        const { values, width } = this.file.accessor(attributes.COLOR_0, [3, 4]);
        if (values.length !== width * count) return null;
        return Float64Array.from({ length: 3 * count }, (_, i) => {
            const x = values[Math.floor(i / 3) * width + i % 3];
            const shown = x <= 0.0031308 ? 12.92 * x : 1.055 * Math.max(x, 0) ** (1 / 2.4) - 0.055;
            return clamp(Number.isNaN(shown) ? 0 : shown, 0, 1);
        });
    }

    /** The meshes, one for each surface. */
    meshes() {
        if (!this.triangles) fail("there are no triangles");
        const made = [...this.surfaces.values()], runs = made.flatMap((surface) => surface.runs);
        const smooth = runs.every((run) => run.normals), tinted = runs.some((run) => run.colors);
        return made.filter((surface) => surface.runs.length).map(({ material, image, clear, runs: own }) => {
            const size = own.reduce((sum, run) => sum + run.positions.length / 3, 0);
            const joined = (name, width, usual) => {
                const out = new Float64Array(width * size).fill(usual);
                let at = 0;
                for (const run of own) {
                    if (run[name]) out.set(run[name], at);
                    at += width / 3 * run.positions.length;
                }
                return out;
            };
            const indices = new Uint32Array(own.reduce((sum, run) => sum + run.corners.length, 0));
            let first = 0, at = 0;
            for (const run of own) {
                run.corners.forEach((i) => { indices[at++] = i + first; });
                first += run.positions.length / 3;
            }
            return { positions: joined("positions", 3, 0), indices, material, ...clear,
                     ...(smooth ? { normals: joined("normals", 3, 0) } : {}),
                     ...(tinted ? { colors: joined("colors", 3, 1) } : {}),
                     ...(image ? { uv: joined("uv", 2, 0), texture: image } : {}) };
        });
    }
}

export function readGltf(bytes, options) {
    const { picture } = record("options", options, ["picture"]);
    if (!(bytes instanceof Uint8Array)) fail("must be the bytes of a file, a Uint8Array");
    if (picture !== undefined && typeof picture !== "function") {
        throw new ShadeError("options.picture must be a function");
    }
    const file = new File(bytes), scene = new Scene(file, picture), scenes = list(file.json, "scenes");
    const nodes = list(file.json, "nodes");
    const below = new Set(nodes.filter(isObject).flatMap((node) => list(node, "children")));
    const roots = scenes.length ? list(file.item("scenes", whole(file.json, "scene", 0)), "nodes")
        : nodes.map((_, i) => i).filter((i) => !below.has(i));
    for (const root of roots) scene.visit(root, [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1], 0);
    return scene.meshes();
}
