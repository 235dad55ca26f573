// Reads models by the module.  Each surface becomes one mesh, as render takes them.  What 3MF has packed is
// unpacked by the platform, before it is read.
import { ShadeError, WRAPS, choice, color, encoded, record, texture } from "./arguments.js";

// module_model, python_part and python_picture of module.c, in words of four bytes
const MODEL = 16, PART = 31, PICTURE = 8;

/** Alpha that does not count becomes 255. */
function opaque(image) {
    const step = image.data.length / (image.width * image.height);
    return { ...image, data: Uint8ClampedArray.from(image.data, (x, i) => (step === 4 && i % 4 === 3 ? 255 : x)) };
}

/** A name as other machines than Windows understand it */
const slashed = (name) => name.replaceAll("\\", "/");

const displayed = (x) => Math.min(Math.max(encoded(x), 0), 1);

/** The rows of the vertices at, of which all has so many numbers each */
function rows(all, width, at, change = (x) => x) {
    const out = new Float64Array(width * at.length);
    at.forEach((vertex, i) => {
        for (let k = 0; k < width; k++) out[width * i + k] = change(all[width * vertex + k], k);
    });
    return out;
}

/** Raw deflate of so many bytes; null where it is damaged. */
async function unpacked(packed, size) {
    const reader = new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate-raw")).getReader();
    const out = new Uint8Array(size);
    let at = 0;
    try {
        for (let got = await reader.read(); !got.done; got = await reader.read()) {
            if (at + got.value.length > size) throw new RangeError("more bytes than the archive says");
            out.set(got.value, at);
            at += got.value.length;
        }
    } catch {
        reader.cancel().catch(() => {});
        return null;
    }
    return at === size ? out : null;
}

const FORMATS = ["obj", "stl", "ply", "off", "gltf", "glb", "3mf"];

/** readModel and its kin, with what index.js has of the module; files become what the module calls. */
export function readersOf({ library, withMemory, take, put, floats, words, text, files }) {
    [[6, MODEL], [7, PART], [10, PICTURE]].forEach(([i, count]) => {
        if (library.size(i) !== 4 * count) throw new Error("model.js and module.js do not fit");
    });

    /** A picture as the caller has decoded it; null: it is left out. */
    function decoded(name, at, size, kind, { picture, beside }, warn) {
        const bytes = at ? new Uint8Array(library.memory.buffer, at, size).slice() : beside?.(slashed(name));
        if (!bytes) warn(`${name}: the option beside has no such file; its faces are drawn without it`);
        const image = bytes ? picture(bytes, kind || undefined) : null;
        return image ? { data: image.data, width: image.width, height: image.height } : null;
    }

    /** The pictures that faces show, by their numbers.  What they say of their surfaces, such as metal and
     *  roughness, then stands in the parts. */
    function picturesOf(model, options, warn) {
        const images = new Map(), known = new Map();    // by number, by name
        withMemory((room) => {
            const at = room(4 * PICTURE), from = room(4), count = library.pictures(model, from);
            const besideFrom = words(from, 1)[0];
            for (let number = 0; number < count; number++) {
                if (!library.picture_shown(model, number)) continue;
                library.picture_of(model, number, at);
                const [named, kind, bytes, size, u, v, squares] = words(at, PICTURE), name = text(named);
                if (!bytes && number < besideFrom) continue;    // that it cannot be read has been told
                if (!options.picture) {
                    warn("it has pictures, which the option picture decodes; its faces are drawn without them");
                    break;
                }
                if (!known.has(name)) known.set(name, decoded(name, bytes, size, text(kind), options, warn));
                const image = known.get(name);
                if (!image) continue;
                const { data, width, height } = texture("picture", image);
                library.picture_set(model, number, put(room(data.length), data), width, height);
                images.set(number, { ...image, wrap: [WRAPS[u], WRAPS[v]], squares: squares !== 0 });
            }
            library.heed_pictures(model);
        });
        return images;
    }

    function meshOf(all, at, images, plain) {
        const ints = words(at, PART).slice(), values = floats(at, PART).slice();
        const corners = words(all.indices, all.corners).slice(ints[0], ints[0] + ints[1]);
        const used = Uint32Array.from(new Set(corners)).sort(), place = new Map();
        used.forEach((vertex, i) => place.set(vertex, i));
        const of = (name, width, change) => rows(floats(all[name], width * all.vertices), width, used, change);
        const form = { positions: of("positions", 3, (x, axis) => x + all.origin[axis]),
                       indices: corners.map((vertex) => place.get(vertex)),
                       ...(all.smooth ? { normals: of("normals", 3) } : {}) };
        if (plain !== undefined) return { ...form, color: plain };
        const k = [...values.subarray(8, 21)], [isSet, isOpaque, isBlended] = ints.subarray(3, 6);
        const [transparency, cutoff] = values.subarray(6, 8), blend = isBlended || transparency > 0;
        const [map, relief, glow] = [...ints.subarray(23, 26)].map((number) => images.get(number));
        const material = { emission: k.slice(0, 3), ambient: k.slice(3, 6), diffuse: k.slice(6, 9),
                           specular: k.slice(9, 12), shininess: k[12] };
        return { ...form,
                 ...(isSet ? { material, metal: values[21], roughness: values[22] } : {}),
                 ...(ints[30] ? { unlit: true } : {}),
                 ...(blend ? { blend: true, opacity: 1 - transparency } : {}),
                 ...(map && cutoff > 0 ? { cutoff } : {}),
                 ...(all.colors ? { colors: of("colors", 3, displayed) } : {}),
                 ...(map || relief || glow ? { uv: of("uv", 2, (x, axis) => (axis ? 1 - x : x)) } : {}),
                 ...(map ? { texture: isOpaque ? opaque(map) : map } : {}),
                 ...(relief ? { relief, strength: values[26] } : {}),
                 ...(glow ? { glow, glowFactor: [...values.subarray(27, 30)] } : {}) };
    }

    function meshesOf(model, options) {
        return withMemory((room) => {
            const at = room(4 * MODEL), part = room(4 * PART), told = new Set();
            library.model_of(model, at);
            const [positions, normals, uv, colors, indices, vertices, corners, parts, smooth, warning] = words(at, 10);
            const all = { positions, normals, uv, colors, indices, vertices, corners, smooth,
                          origin: [...new Float64Array(library.memory.buffer, at + 40, 3)] };
            const warn = (line) => {
                if (!told.has(line)) console.warn(`shade-h: ${line}`);
                told.add(line);
            };
            if (text(warning)) warn(unnamed(text(warning)));
            const images = options.color === undefined ? picturesOf(model, options, (line) => warn(`model: ${line}`))
                : new Map();
            return Array.from({ length: parts }, (_, i) => {
                library.model_part(model, i, part);
                return meshOf(all, part, images, options.color);
            });
        });
    }

    /** The name under which the module reads has the format, which messages leave out. */
    const unnamed = (words) => words.replace(/(^|; )model\.\w+(?=:)/g, "$1model");

    function checked(bytes, options, names) {
        const { format, ...given } = record("options", options, names);
        if (!(bytes instanceof Uint8Array)) throw new ShadeError("model: must be the bytes of a file, a Uint8Array");
        for (const name of ["picture", "beside"]) {
            if (given[name] !== undefined && typeof given[name] !== "function") {
                throw new ShadeError(`options.${name} must be a function`);
            }
        }
        if (given.color !== undefined) color("options.color", given.color);
        return { ...given, format: format === undefined ? "" : `.${choice("options.format", format, FORMATS)}` };
    }

    /** Hands a file of the caller over to the module, which frees it.  failures has what beside throws by the
     *  name; a line of several names, or a name with folders, is tried as a whole before its parts. */
    function handed(options, failures) {
        return (at, size) => {
            const name = slashed(text(at >>> 0));
            try {
                const bytes = options.beside?.(name);
                if (!(bytes instanceof Uint8Array)) return 0;
                for (const whole of failures.keys()) {
                    if (whole.endsWith(`/${name}`) || whole.split(" ").includes(name)) failures.delete(whole);
                }
                words(size >>> 0, 1)[0] = bytes.length;
                return put(take(bytes.length), bytes);
            } catch (error) {    // it must not pass through the module
                failures.set(name, error);
                return 0;
            }
        };
    }

    function opened(at, length, options) {
        return withMemory((room) => {
            const error = room(400), name = new TextEncoder().encode(`model${options.format}\0`), failures = new Map();
            files.beside = handed(options, failures);
            const model = library.model_open(at, length, put(room(name.length), name), error, 400);
            try {
                for (const [, error] of failures) throw error;
                if (!model) throw new ShadeError(unnamed(text(error)) || "model: out of memory");
                return meshesOf(model, options);
            } finally {
                library.model_close(model);
            }
        });
    }

    function readGltf(bytes, options) {
        const asked = { ...checked(bytes, options, ["picture", "color"]), format: ".glb" };
        return withMemory((room) => opened(put(room(bytes.length), bytes), bytes.length, asked));
    }

    /** Unpacks what an archive has before it is read, because the platform does it later. */
    async function unpackedFirst(bytes, options) {
        const at = put(take(bytes.length), bytes), unpackedFiles = new Map(), wanted = [];
        try {
            files.inflate = (from, length, to, size) => { wanted.push([from >>> 0, length, size]); return 1; };
            library.archive(at, bytes.length);
            for (const [from, length, size] of wanted) {
                unpackedFiles.set(from, await unpacked(new Uint8Array(library.memory.buffer, from, length).slice(), size));
            }
            files.inflate = (from, length, to, size) => {
                const file = unpackedFiles.get(from >>> 0);
                if (file?.length === size) new Uint8Array(library.memory.buffer, to >>> 0, size).set(file);
                return file?.length === size ? 0 : 1;
            };
            return opened(at, bytes.length, options);
        } finally {
            library.give(at);
        }
    }

    async function readModel(bytes, options) {
        const asked = checked(bytes, options, ["format", "picture", "beside", "color"]);
        const packed = bytes[0] === 0x50 && bytes[1] === 0x4B;    // PK
        if (asked.format === ".3mf" || (!asked.format && packed)) return unpackedFirst(bytes, asked);
        return withMemory((room) => opened(put(room(bytes.length), bytes), bytes.length, asked));
    }

    async function read3mf(bytes, options) {
        const asked = checked(bytes, options, ["picture", "color", "DOMParser"]);
        return unpackedFirst(bytes, { ...asked, format: ".3mf" });
    }
    return { readModel, readGltf, read3mf };
}
