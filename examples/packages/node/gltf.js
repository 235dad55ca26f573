// Reads glTF 2.0 by the module: GLB, or JSON with its buffers inside.  Each surface becomes one mesh,
// as render takes them.
import { ShadeError, record } from "./arguments.js";

// python_model and python_part of module.c, in words of four bytes
const MODEL = 16, PART = 31;

/** Alpha that does not count becomes 255. */
function opaque(image) {
    const step = image.data.length / (image.width * image.height);
    return { ...image, data: Uint8ClampedArray.from(image.data, (x, i) => (step === 4 && i % 4 === 3 ? 255 : x)) };
}

function displayed(x) {
    const shown = x <= 0.0031308 ? 12.92 * x : 1.055 * x ** (1 / 2.4) - 0.055;
    return Math.min(Math.max(shown, 0), 1);
}

/** The rows of the vertices at, of which all has so many numbers each */
function rows(all, width, at, change = (x) => x) {
    const out = new Float64Array(width * at.length);
    at.forEach((vertex, i) => {
        for (let k = 0; k < width; k++) out[width * i + k] = change(all[width * vertex + k], k);
    });
    return out;
}

/** readGltf, with what index.js has of the module */
export function gltfReaderOf({ library, withMemory, put, floats, words, text }) {
    if (library.size(6) !== 4 * MODEL || library.size(7) !== 4 * PART) {
        throw new Error("gltf.js and module.js do not fit");
    }

    /** The image of a part, decoded by the caller; null where there is none. */
    function imageOf(part, picture, images, warn) {
        const [at, size, kind] = [part[26], part[27], part[30]];
        if (!at) return null;
        if (!picture) {
            warn("it has pictures, which the option picture decodes; its faces are drawn without them");
            return null;
        }
        if (!images.has(at)) {
            const bytes = new Uint8Array(library.memory.buffer, at, size).slice();
            images.set(at, picture(bytes, text(kind) || undefined));
        }
        return images.get(at);
    }

    function meshOf(all, at, image) {
        const ints = words(at, PART).slice(), values = floats(at, PART).slice();
        const corners = words(all.indices, all.corners).slice(ints[0], ints[0] + ints[1]);
        const used = Uint32Array.from(new Set(corners)).sort(), place = new Map();
        used.forEach((vertex, i) => place.set(vertex, i));
        const of = (name, width, change) => rows(floats(all[name], width * all.vertices), width, used, change);
        const k = [...values.subarray(11, 24)], [isOpaque, isBlended] = [ints[8], ints[25]];
        const material = { emission: k.slice(0, 3), ambient: k.slice(3, 6), diffuse: k.slice(6, 9),
                           specular: k.slice(9, 12), shininess: k[12] };
        return { positions: of("positions", 3, (x, axis) => x + all.origin[axis]),
                 indices: corners.map((vertex) => place.get(vertex)), material,
                 ...(isBlended ? { blend: true, opacity: 1 - values[5] } : {}),
                 ...(image && values[24] > 0 ? { cutoff: values[24] } : {}),
                 ...(all.smooth ? { normals: of("normals", 3) } : {}),
                 ...(all.colors ? { colors: of("colors", 3, displayed) } : {}),
                 ...(image && all.uv ? { uv: of("uv", 2, (x, axis) => (axis ? 1 - x : x)),
                                         texture: isOpaque ? opaque(image) : image } : {}) };
    }

    function meshesOf(model, picture) {
        return withMemory((room) => {
            const at = room(4 * MODEL), part = room(4 * PART), told = new Set(), images = new Map();
            library.model_of(model, at);
            const [positions, normals, uv, colors, indices, vertices, corners, parts, smooth, warning] = words(at, 10);
            const all = { positions, normals, uv, colors, indices, vertices, corners, smooth,
                          origin: [...new Float64Array(library.memory.buffer, at + 40, 3)] };
            const warn = (line) => {
                if (!told.has(line)) console.warn(`shade-h: ${line}`);
                told.add(line);
            };
            if (text(warning)) warn(text(warning));
            return Array.from({ length: parts }, (_, i) => {
                library.model_part(model, i, part);
                const image = imageOf(words(part, PART).slice(), picture, images, (line) => warn(`model: ${line}`));
                return meshOf(all, part, image);
            });
        });
    }

    return function readGltf(bytes, options) {
        const { picture } = record("options", options, ["picture"]);
        if (!(bytes instanceof Uint8Array)) throw new ShadeError("model: must be the bytes of a file, a Uint8Array");
        if (picture !== undefined && typeof picture !== "function") {
            throw new ShadeError("options.picture must be a function");
        }
        return withMemory((room) => {
            const error = room(400), at = put(room(bytes.length), bytes);
            const model = library.model_open(at, bytes.length, error, 400);
            if (!model) throw new ShadeError(text(error) || "model: out of memory");
            try {
                return meshesOf(model, picture);
            } finally {
                library.model_close(model);
            }
        });
    };
}
