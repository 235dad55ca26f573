// Pictures of meshes by shade.h, compiled for WebAssembly.  index.d.ts describes what is exported.
import * as check from "./arguments.js";
import { camerasOf } from "./camera.js";
import encoded from "./module.js";
import { readersOf } from "./model.js";
import { mujocoOf } from "./mujoco.js";
import * as pictures from "./picture.js";
import { rendererOf } from "./renderer.js";

const { ShadeError } = check, { Picture, depthPng, idsPng, readDepthPng, readIdsPng } = pictures;
export { Picture, ShadeError, depthPng, idsPng, readDepthPng, readIdsPng };

// Compiled at once, without await, which neither require nor a classic script can do.
const binary = Uint8Array.from(atob(encoded), (c) => c.charCodeAt(0));
// The C library can print, which nothing here does: what it would call fails.
const failing = () => 52;
const system = { fd_close: failing, fd_seek: failing, fd_write: failing };
// What unpacks a file of an archive, and what hands over a file beside a model: model.js sets both before a call.
const files = { inflate: () => 1, beside: () => 0 };
const library = new WebAssembly.Instance(new WebAssembly.Module(binary), {
    wasi_snapshot_preview1: system,
    shade: { inflate: (...file) => files.inflate(...file), beside: (...file) => files.beside(...file) },
}).exports;
library._initialize();

// Structs of module.c, in words of four bytes
const MESH = 27, ITEM = 58, VIEW = 67, LIGHT = 21;
[MESH, ITEM, VIEW, LIGHT].forEach((words, i) => {
    if (library.size(i) !== 4 * words) throw new Error("index.js and module.js do not fit");
});

const IDENTITY = Float32Array.of(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1);
const INFINITE_VIEWER = 32, INDEX = 7;

// ---- memory of the module

const floats = (at, count) => new Float32Array(library.memory.buffer, at, count);
const words = (at, count) => new Uint32Array(library.memory.buffer, at, count);

/** Memory of the module for so many bytes, which does not stay where the module grows. */
function take(bytes) {
    const at = library.take(bytes) >>> 0;    // i32 is signed: past 2 GB it would be negative
    if (!at) throw new RangeError("memory is not enough for the picture or the mesh");
    return at;
}

/** Calls a function with memory that is given back after it, whatever happens. */
function withMemory(work) {
    const taken = [];
    try {
        return work((bytes) => {
            taken.push(take(bytes));
            return taken[taken.length - 1];
        });
    } finally {
        taken.forEach(library.give);
    }
}

function put(at, array) {
    const bytes = new Uint8Array(array.buffer, array.byteOffset, array.byteLength);
    new Uint8Array(library.memory.buffer, at, bytes.length).set(bytes);
    return at;
}

function text(at) {
    const bytes = new Uint8Array(library.memory.buffer, at);
    return new TextDecoder().decode(bytes.slice(0, bytes.indexOf(0)));
}

function succeed(name, result) {
    if (result) throw new ShadeError(`${name}: ${text(library.words(result))}`);
}

/** What a function of the core returns; throws what it refuses, by the argument's name. */
function asked(call, ...given) {
    return withMemory((room) => {
        const why = room(452);
        words(why, 113).fill(0);
        const got = call(why, ...given);
        if (words(why, 1)[0]) throw new ShadeError(`${text(why + 4)} ${text(why + 68)}`);
        return got;
    });
}

const cameras = camerasOf({ library, withMemory, put, text, asked });

/** A display colour by its name or its digits */
function named(label, word) {
    return withMemory((room) => {
        const encoded = (string) => put(room(4 * string.length + 1), new TextEncoder().encode(`${string}\0`));
        const rgb = room(24);
        asked(library.color, encoded(label), encoded(word), rgb);
        return new Float64Array(library.memory.buffer, rgb, 3).slice();
    });
}

/** Display colours, 0 .. 1 */
function shown(label, numbers, columns, whole, bytes) {
    const count = numbers.length / columns;
    return withMemory((room) => {
        const [name, rows] = [put(room(label.length * 4 + 1), new TextEncoder().encode(`${label}\0`)),
                              put(room(8 * numbers.length + 8), Float64Array.from(numbers))];
        const [rgb, alpha] = [room(12 * count + 4), room(8)];
        asked(library.colors, name, rows, count, columns, whole ? 1 : 0, bytes ? 1 : 0, rgb, alpha);
        return floats(rgb, 3 * count).slice();
    });
}
check.useCore({ named, shown });
pictures.useCore({ library, withMemory, put, text, asked, bytes: (at, count) => new Uint8Array(library.memory.buffer, at, count) });

/** Cameras by an eye and a target, by OpenCV's and OpenGL's matrices, and fitted: see index.d.ts. */
export const Camera = cameras.Camera;

/** Linear light of display colours. */
function linear(rgb) {
    return withMemory((room) => {
        const at = put(room(rgb.byteLength), rgb);
        library.linear(at, rgb.length / 3);
        return floats(at, rgb.length).slice();
    });
}

// ---- materials

/** The names of the 24 classic materials. */
export const PRESETS = Array.from({ length: 24 }, (_, i) => text(library.preset_name(i)));

function preset(name) {
    const index = PRESETS.indexOf(check.choice("material", name, PRESETS));
    return withMemory((room) => {
        const at = room(52);
        library.preset(index, at);
        return floats(at, 13).slice();
    });
}

/** The names of the programs of `elsewhere`, each with its numbers and their defaults. */
export const PROGRAMS = withMemory((room) => {
    const rows = {}, numbers = room(4);
    for (let i = 0, name; (name = library.look_name(i, numbers)) !== 0; i++) {
        rows[text(name)] = text(words(numbers, 1)[0]);
    }
    return rows;
});

/** The look of text such as "vtk(specular=.5, power=30)": 13 numbers, model and flags */
function look(value) {
    if (typeof value !== "string") throw new ShadeError("look must be text, as that of elsewhere.vtk({ power: 30 })");
    return withMemory((room) => {
        const spelled = new TextEncoder().encode(`${value}\0`);
        const at = put(room(spelled.length), spelled), row = room(52), lit = room(8), said = room(400);
        if (library.look(at, row, lit, said, 400)) throw new ShadeError(`look: ${text(said)}`);
        const [model, flags] = words(lit, 2);
        return { material: floats(row, 13).slice(), model, flags };
    });
}

/** Looks by the names of other programs, as text for render: elsewhere.vtk({ specular: .5, power: 30 }). */
export const elsewhere = Object.fromEntries(Object.keys(PROGRAMS).map((name) => [name, (numbers = {}) => {
    const parts = Object.entries(check.record("numbers", numbers, Object.keys(numbers))).map(([key, value]) => {
        const row = check.isArray(value) ? [...value] : [value];
        return `${key}=${row.map((x) => check.number(key, x, -1e9, 1e9)).join(",")}`;
    });
    const made = `${name}(${parts.join(" ")})`;
    look(made);
    return made;
}]));

/** k_e, k_a, k_d, k_s and n in a row. */
function material(value) {
    if (typeof value === "string") return preset(value);
    const got = check.record("material", value,
                             ["emission", "ambient", "diffuse", "specular", "shininess"]);
    const { emission = [0, 0, 0], diffuse = [1, 1, 1], specular = [0, 0, 0], shininess = 0 } = got;
    const row = new Float32Array(13);
    const colors = Object.entries({ emission, ambient: got.ambient ?? check.vector("material.diffuse", diffuse, 3),
                                    diffuse, specular });
    colors.forEach(([name, color], k) => row.set(check.vector(`material.${name}`, color, 3), 3 * k));
    row[12] = check.number("material.shininess", shininess, 0, 1e9);
    return row;
}

/** Says which triangles are left out, and why a mesh cannot be seen: a white page would not. */
function warn({ positions, indices }) {
    const corners = (i, good) => [0, 1, 2].every((c) => [0, 1, 2].every((k) => good(positions[3 * indices[i + c] + k])));
    let lost = 0, seen = false;
    for (let i = 0; i < indices.length && !seen; i += 3) seen = corners(i, (x) => Math.abs(x) <= 1e30);
    if (seen && positions.every(Number.isFinite)) return;
    for (let i = 0; i < indices.length; i += 3) lost += !corners(i, Number.isFinite);
    if (seen && !lost) return;
    console.warn(seen ? `shade-h: positions: ${lost} triangles have corners that are no finite numbers (left out)`
               : indices.length ? "shade-h: positions: no triangle has three corners within 1e30: nothing is drawn"
               : "shade-h: indices: there are no triangles: nothing is drawn");
}

/** A little gloss on a colour */
function gloss(color) {
    return Float32Array.of(0, 0, 0, ...color, ...color, 0.08, 0.08, 0.08, 40);
}

// ---- meshes

// Meshes that the module keeps, { at, bytes }, the last used last.  What the collector took is told between two turns of
// the event loop alone, so a new mesh makes room before it: those not drawn for longest are put away, and are made
// anew where somebody draws them after all.
const KEPT = 256e6, kept = new Set();
let keptBytes = 0;

function putAway(one) {
    if (one.at) library.mesh_free(one.at);
    keptBytes -= one.bytes;
    one.at = one.bytes = 0;
    kept.delete(one);
}

function makeRoom() {
    for (const one of kept) {
        if (keptBytes <= KEPT) return;
        putAway(one);
    }
}

function touch(one) {
    const bytes = library.mesh_bytes(one.at);
    keptBytes += bytes - one.bytes;
    one.bytes = bytes;
    kept.delete(one);
    kept.add(one);
}

const forgotten = new FinalizationRegistry(putAway);

/** Positions as floats that count from an origin: of numbers in double, near what of them can be seen. */
function localOf(exact, indices) {
    if (exact instanceof Float32Array) return { positions: exact.slice(), origin: [0, 0, 0] };
    return withMemory((room) => {
        const [at, corners] = [exact, indices].map((array) => put(room(array.byteLength + 8), array));
        const local = room(4 * exact.length + 4), origin = room(24);
        if (library.local(at, exact.length / 3, corners, indices.length, local, origin)) {
            throw new RangeError("memory is not enough for the mesh");
        }
        return { positions: floats(local, exact.length).slice(), origin: [...new Float64Array(library.memory.buffer, origin, 3)] };
    });
}

/** Indices of faces, rows of 3 or 4 corners */
function triangles(faces, vertices) {
    const columns = faces?.[0]?.length ?? 3, flat = Array.isArray(faces) ? faces.flat() : [];
    if (!Array.isArray(faces) || !faces.every((row) => row?.length === columns) || !flat.every((x) => typeof x === "number")) {
        throw new ShadeError("faces must be an array of rows of 3 or of 4 numbers");
    }
    return withMemory((room) => {
        const name = put(room(6), new TextEncoder().encode("faces\0"));
        const at = put(room(8 * flat.length + 8), Float64Array.from(flat)), out = room(24 * faces.length + 4);
        return words(out, asked(library.faces, name, at, faces.length, columns, vertices, out)).slice();
    });
}

const MESH_OPTIONS = ["positions", "indices", "faces", "normals", "color", "colors", "uv", "texture",
                      "material", "pose", "edges", "twoSided", "opacity", "blend", "cutoff", "metal", "roughness",
                      "relief", "strength", "glow", "glowFactor", "unlit"];
// What needs uv, in the order of asked_mesh
const PICTURES = ["texture", "relief", "glow"];

export class Mesh {
    #kept = { at: 0, bytes: 0 };
    #handed;    // what the module makes it of; null: it was freed

    constructor(source) {
        if (source === undefined) throw new ShadeError("mesh must be an object with positions");
        const got = check.record("mesh", source, MESH_OPTIONS);
        const { normals = "auto", color, colors, edges = false, twoSided = true } = got;
        const exact = check.doubles("positions", got.positions, 3);
        const vertices = exact.length / 3, sentence = text(library.words(INDEX));
        this.indices = got.faces === undefined ? check.indices("indices", got.indices, vertices, sentence).slice()
            : triangles(got.faces, vertices);
        Object.assign(this, localOf(exact, this.indices));
        warn(this);
        this.pose = got.pose === undefined ? IDENTITY : check.pose("pose", got.pose);
        this.edges = check.flag("edges", edges);
        this.twoSided = check.flag("twoSided", twoSided);
        this.opacity = check.number("opacity", got.opacity ?? 1, 0, 1);
        this.blend = check.flag("blend", got.blend ?? this.opacity < 1);
        this.cutoff = check.number("cutoff", got.cutoff ?? 0, 0, 1000);
        this.metal = check.number("metal", got.metal ?? 0, 0, 1);
        this.roughness = check.number("roughness", got.roughness ?? 0, 0, 1);
        this.unlit = check.flag("unlit", got.unlit ?? false);
        this.strength = check.number("strength", got.strength ?? 1, -1e9, 1e9);
        this.glowFactor = check.vector("glowFactor", got.glowFactor ?? [1, 1, 1], 3);
        this.own = got.material !== undefined;
        const plain = color === undefined ? null : linear(check.color("color", color));
        const white = colors !== undefined || got.texture !== undefined;
        this.material = got.material !== undefined ? material(got.material)
            : gloss(plain ?? (white ? [1, 1, 1] : linear(check.color("color", "clay"))));
        this.tint = plain === null && got.material === undefined ? null : this.material.slice(6, 9);
        this.#handed = this.#asked(normals, colors, got);
        makeRoom();
        this.#make();
        forgotten.register(this, this.#kept, this);
    }

    /** What the module makes the mesh of, in arrays of our own: { ask, arrays }. */
    #asked(normals, colors, { uv, ...rest }) {
        const vertices = this.positions.length / 3, faces = this.indices.length / 3;
        const kinds = { flat: 0, auto: 1, smooth: 2 }, ask = new Uint32Array(MESH);
        const rows = (name, value, width, ...counts) => {
            const array = check.rows(name, value, width);
            if (!counts.includes(array.length / width)) {
                throw new ShadeError(`${name} must have a row for each of ${vertices} vertices` +
                    `${counts.length > 1 ? ` or ${faces} faces` : ""}, not ${array.length / width}`);
            }
            return array === value ? array.slice() : array;
        };
        const given = check.isArray(normals);
        if (!given) check.choice("normals", normals, Object.keys(kinds));
        this.quick = given ? 2 : ["flat", "smooth"].indexOf(normals);    // as renderer_shading has it; -1: none of it
        const pictured = PICTURES.find((name) => rest[name] !== undefined);
        if ((uv === undefined) !== (pictured === undefined)) {
            throw new ShadeError(`uv and ${pictured ?? "texture"} belong together: one of them is missing`);
        }
        const shown = colors === undefined ? null : check.displayed("colors", colors, 3);
        const lost = uv ? check.rows("uv", uv, 2).reduce((n, x) => n + !Number.isFinite(x), 0) : 0;
        if (lost) console.warn(`shade-h: uv: ${lost} of its numbers are not finite: they count as 0`);
        const maps = PICTURES.map((name) =>
            (rest[name] === undefined ? null : check.texture(name, rest[name])));
        this.maps = maps;
        const arrays = [this.positions, given && rows("normals", normals, 3, vertices),
                        shown && rows("colors", shown, 3, vertices, faces),
                        uv && rows("uv", uv, 2, vertices), this.indices, ...maps.map((map) => map?.data)];
        ask.set([vertices, this.indices.length, shown ? shown.length / 3 : 0, given ? 0 : kinds[normals]], 5);
        maps.forEach((map, i) => map && ask.set([map.width, map.height, ...map.wrap], 10 + 6 * i));
        if (normals !== "flat" && shown && shown.length !== 3 * vertices) this.quick = -1;    // corners are split
        return { ask, arrays };
    }

    /** Hands the arrays over to the module. */
    #make() {
        const { ask, arrays } = this.#handed;
        this.#kept.at = withMemory((room) => {
            const at = room(4 * MESH), result = room(4), held = [];
            try {
                for (const array of arrays) held.push(array ? take(array.byteLength) : 0);
            } catch (error) {
                held.forEach(library.give);
                throw error;
            }
            arrays.forEach((array, i) => array && put(held[i], array));
            ask.set(held.slice(0, 5));
            PICTURES.forEach((_, i) => { ask[9 + 6 * i] = held[5 + i]; });
            const mesh = library.mesh_make(put(at, ask), result);
            succeed("mesh", words(result, 1)[0]);
            return mesh;
        });
        touch(this.#kept);
        this.reach = library.mesh_reach(this.#kept.at);
        if (this.reach >= 0) return;
        putAway(this.#kept);
        throw new RangeError("memory is not enough for the mesh");
    }

    /** Where the module keeps the mesh.  The memory of the module may grow. */
    get address() {
        if (!this.#handed) throw new ShadeError("mesh was freed");
        if (!this.#kept.at) this.#make();
        touch(this.#kept);
        return this.#kept.at;
    }

    free() {
        forgotten.unregister(this);
        putAway(this.#kept);
        this.#handed = null;
    }
}

/** A Mesh, or one of the fields that a Renderer's mesh has; the texture stands in for that of its objects. */
function prepared(source) {
    if (source instanceof Mesh) return source;
    const got = check.record("mesh", source, ["positions", "indices", "normals", "uv", "colors"]);
    const texture = { data: [255, 255, 255], width: 1, height: 1 };
    return new Mesh(got.uv === undefined ? got : { ...got, texture });
}

// ---- pictures

function writeItems(at, meshes, surface) {
    meshes.forEach(({ mesh, pose }, i) => {
        const start = at + 4 * ITEM * i, { address } = mesh;
        new Float64Array(library.memory.buffer, start, 16).set(pose);
        words(start + 128, 3).set([address, mesh.edges ? 1 : 0, mesh.twoSided ? 1 : 0]);
        floats(start + 140, 13).set(surface ?? mesh.material);
        words(start + 192, 1)[0] = mesh.blend ? 1 : 0;
        floats(start + 196, 8).set([mesh.opacity, mesh.cutoff, mesh.metal, mesh.roughness, mesh.strength,
                                    ...mesh.glowFactor]);
        words(start + 228, 1)[0] = mesh.unlit ? 1 : 0;
    });
}

/** Draws into memory of the module, and copies the picture out. */
function drawn(meshes, camera, { width, height, samples, background, depth, light, surface, toStudio }) {
    const pixels = width * height;
    return withMemory((room) => {
        const [view, items] = [room(4 * VIEW), room(4 * ITEM * meshes.length)];
        const [lights, rgba] = [room(4 * LIGHT * light.lights.length), room(4 * pixels)];
        const [depths, ids] = depth ? [room(4 * pixels), room(4 * pixels)] : [0, 0];
        const flags = light.flags | (camera.projection[15] !== 0 ? INFINITE_VIEWER : 0);
        light.lights.forEach((row, i) => floats(lights, light.lights.length * LIGHT).set(row, i * LIGHT));
        writeItems(items, meshes, surface);
        words(view, 10).set([lights, rgba, depths, ids, light.lights.length, width, height, samples, flags,
                             light.model]);
        floats(view + 40, 3).set(light.ambient);
        floats(view + 52, 4).set(background);
        floats(view + 68, 16).set(camera.view);
        floats(view + 132, 16).set(camera.projection);
        words(view + 196, 1)[0] = toStudio ? 1 : 0;
        floats(view + 200, 16).set(toStudio ?? IDENTITY);
        words(view + 264, 1)[0] = light.quick ? 1 : 0;
        succeed("mesh", library.draw(view, items, meshes.length));
        const data = new Uint8ClampedArray(library.memory.buffer, rgba, 4 * pixels).slice();
        return new Picture(width, height, data, depth ? floats(depths, pixels).slice() : null,
                           depth ? new Int32Array(library.memory.buffer, ids, pixels).slice() : null);
    });
}

const OPTIONS = ["view", "size", "samples", "background", "ortho", "up", "depth", "light", "look"];

export function render(meshes, options) {
    const got = check.record("options", options, OPTIONS);
    const { view = "iso", size = [640, 480], samples = 3, background = "white" } = got;
    const { ortho = false, up = "z", depth = false, light = "quick" } = got;
    const named = typeof light === "string" ? check.choice("light", light, ["quick", "studio"]) : null;
    const own = named ? null : check.lighting("light", light);
    const seen = got.look === undefined ? null : look(got.look);
    const [width, height] = check.size("size", size);
    check.integer("samples", samples, 1, 8);
    if (Math.max(width, height) * samples > 16384) {
        throw new ShadeError("size times samples must be at most 16384, not " +
                             `${Math.max(width, height) * samples}`);
    }
    const behind = background === null ? [0, 0, 0, 0]
        : [...linear(check.color("background", background)), 1];
    const made = [], all = Array.isArray(meshes) ? meshes : [meshes];
    try {
        const several = all.map((mesh) => {
            if (mesh instanceof Mesh) return mesh;
            made.push(new Mesh(mesh));
            return made[made.length - 1];
        });
        const soft = named === "studio", side = typeof view === "string" || check.isArray(view);
        const { origin, placed: near } = cameras.placed(several);
        const camera = side ? cameras.fitted(near, view, [width, height], up, ortho, soft ? 1.5 : 0)
            : cameras.given(view, origin);
        own?.lights.forEach((row) => {    // rows begin with x, y, z, w of a lamp
            row.set(origin.map((x, k) => row[k] - row[3] * x));
        });
        check.flag("depth", depth);
        const lit = own ?? { lights: [], ambient: [0, 0, 0], model: 0, flags: 0, quick: true };
        return drawn(near, camera, { width, height, samples, background: behind, depth, surface: seen?.material,
                                        light: seen ? { ...lit, model: seen.model, flags: seen.flags } : lit,
                                        toStudio: soft ? cameras.studio(near, camera, up) : null });
    } finally {
        made.forEach((mesh) => mesh.free());
    }
}

// ---- cameras

const readers = readersOf({ library, withMemory, take, put, floats, words, text, files });
/** The meshes of a file of any format: see index.d.ts. */
export const readModel = readers.readModel;
/** The meshes of a GLB: see index.d.ts. */
export const readGltf = readers.readGltf;
/** The meshes of a 3MF: see index.d.ts. */
export const read3mf = readers.read3mf;

/** One scene and many cameras: see index.d.ts. */
export const Renderer = rendererOf({ library, take, put, withMemory, linear, succeed, prepared, localOf, cameras });

/** MuJoCo's own class without OpenGL: new mujoco.Renderer(mj, model, height, width). */
export const mujoco = mujocoOf(Renderer, { library, withMemory, put, asked });
