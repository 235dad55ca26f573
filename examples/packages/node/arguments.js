// Turns what callers pass into arrays and numbers, or refuses it by its name.

/** What render and Mesh throw: a sentence that begins with the name of the argument. */
export class ShadeError extends TypeError {}

function shown(value) {
    if (isArray(value)) return `${value.constructor?.name ?? "an array"} of ${value.length}`;
    if (typeof value === "string") return JSON.stringify(value.slice(0, 40));
    if (typeof value === "function" || typeof value === "symbol") return `a ${typeof value}`;
    if (value !== null && typeof value === "object") return "an object";
    return `${value}`;
}

export function isArray(value) {
    return Array.isArray(value) || (ArrayBuffer.isView(value) && !(value instanceof DataView));
}

/** An object with no keys but these; undefined is an empty one. */
export function record(name, value, keys) {
    if (value === undefined) return {};
    if (value === null || typeof value !== "object" || isArray(value)) {
        throw new ShadeError(`${name} must be an object, not ${shown(value)}`);
    }
    for (const key of Object.keys(value)) {
        if (!keys.includes(key)) {
            throw new ShadeError(`${name}.${key} is no option; there are ${keys.join(", ")}`);
        }
    }
    return value;
}

export function number(name, value, low, high) {
    if (typeof value !== "number" || !(value >= low && value <= high)) {
        throw new ShadeError(`${name} must be a number from ${low} to ${high}, not ${shown(value)}`);
    }
    return value;
}

export function integer(name, value, low, high) {
    if (!Number.isInteger(value)) {
        throw new ShadeError(`${name} must be a whole number, not ${shown(value)}`);
    }
    return number(name, value, low, high);
}

export function choice(name, value, choices) {
    if (!choices.includes(value)) {
        throw new ShadeError(`${name} must be one of ${choices.join(", ")}, not ${shown(value)}`);
    }
    return value;
}

export function flag(name, value) {
    if (typeof value !== "boolean") {
        throw new ShadeError(`${name} must be true or false, not ${shown(value)}`);
    }
    return value;
}

function numbers(name, value) {
    if (!isArray(value) || value instanceof BigInt64Array || value instanceof BigUint64Array) {
        throw new ShadeError(`${name} must be an array of numbers, not ${shown(value)}`);
    }
    if (Array.isArray(value) && (!value.every((x) => typeof x === "number") || value.includes(undefined))) {
        throw new ShadeError(`${name} must hold numbers alone`);
    }
    return value;
}

/** Floats, so many a row. */
export function rows(name, value, width) {
    const got = numbers(name, value);
    if (got.length % width) {
        throw new ShadeError(`${name} must hold ${width} numbers a row, not ${got.length} in all`);
    }
    return got instanceof Float32Array ? got : Float32Array.from(got);
}

/** Numbers as they are, so many a row: in double where they are not floats already. */
export function doubles(name, value, width) {
    const got = numbers(name, value);
    if (got.length % width) {
        throw new ShadeError(`${name} must hold ${width} numbers a row, not ${got.length} in all`);
    }
    return got instanceof Float32Array ? got : Float64Array.from(got);
}

/** 4 x 4 by columns, in double, of numbers that fit floats. */
export function matrix(name, value) {
    vector(name, value, 16);
    return Float64Array.from(value);
}

/** A place, in double, whose numbers fit floats. */
export function place(name, value) {
    vector(name, value, 3);
    return Float64Array.from(value);
}

/** The same for a pose, whose last row is 0 0 0 1. */
export function pose(name, value) {
    const got = matrix(name, value);
    if (got[3] || got[7] || got[11] || got[15] !== 1) {
        throw new ShadeError(`${name} must have 0, 0, 0, 1 in the last row: it goes by columns, and a translation stands in the last one`);
    }
    return got;
}

/** Floats that are finite. */
export function vector(name, value, length) {
    const got = rows(name, value, 1);
    if (got.length !== length || !got.every(Number.isFinite)) {
        throw new ShadeError(`${name} must hold ${length} finite numbers, not ${shown(value)}`);
    }
    return got;
}

/** Width and height; one number is both. */
export function size(name, value) {
    const pair = typeof value === "number" ? [value, value] : numbers(name, value);
    if (pair.length !== 2) throw new ShadeError(`${name} must be [width, height]`);
    return [integer(`${name}[0]`, pair[0], 1, 16384), integer(`${name}[1]`, pair[1], 1, 16384)];
}

/** Indices, three a triangle; words is the sentence of the library about wrong ones. */
export function indices(name, value, vertices, words) {
    const got = value === undefined ? Uint32Array.from({ length: vertices }, (_, i) => i)
                                    : numbers(name, value);
    if (got.length % 3) {
        throw new ShadeError(`${name}: ${words} (${got.length} indices)`);
    }
    for (let i = 0; i < got.length; i++) {
        if (got[i] >= 0 && got[i] < vertices && got[i] === Math.floor(got[i])) continue;
        throw new ShadeError(`${name}: ${words} (index ${got[i]} of ${vertices} vertices)`);
    }
    return got instanceof Uint32Array ? got : Uint32Array.from(got);
}

/** The sRGB value of linear light, not clamped */
export const encoded = (x) => (x <= 0.0031308 ? 12.92 * x : 1.055 * x ** (1 / 2.4) - 0.055);

let core = null;

/** Hands over what the core knows of colours: named(label, word) and shown(label, numbers, columns, whole, bytes). */
export function useCore(functions) { core = functions; }

/** Display colours, 0 .. 1, of numbers or of bytes: typed arrays of integers are bytes, but where all are 0 or 1 and
 *  the type does not say so. */
export function displayed(name, value, width) {
    const got = numbers(name, value), bytes = got instanceof Uint8Array || got instanceof Uint8ClampedArray;
    if (got.length % width) throw new ShadeError(`${name} must hold ${width} numbers a row, not ${got.length} in all`);
    return core.shown(name, got, width, bytes || /^Int|^Uint/.test(got.constructor.name), bytes);
}

/** One display colour: #RRGGBB, #RGB, a name of ours or of CSS, or three numbers. */
export function color(label, value) {
    return typeof value === "string" ? Float32Array.from(core.named(label, value)) : vector(label, displayed(label, value, 3), 3);
}

/** Of shade_wrap, by number */
export const WRAPS = ["repeat", "clamp", "mirror"];

/** How a texture goes on beyond its edges along u and v, and whether its texels are seen as squares, as numbers */
export function wraps(name, { wrap = ["repeat", "repeat"], squares = false }) {
    if (!Array.isArray(wrap) || wrap.length !== 2) throw new ShadeError(`${name}wrap must be two names, for u and v`);
    return [...wrap.map((how) => WRAPS.indexOf(choice(`${name}wrap`, how, WRAPS))), flag(`${name}squares`, squares) ? 1 : 0];
}

/** A copy of numbers that are bytes */
export function bytesOf(name, data) {
    const bytes = Uint8ClampedArray.from(data);
    if (!bytes.every((x, i) => x === data[i])) throw new ShadeError(`${name} must hold bytes, 0 to 255`);
    return bytes;
}

/** A picture of RGB or RGBA bytes, as RGBA; wrap and squares become numbers. */
export function texture(name, value) {
    const got = record(name, value, ["data", "width", "height", "wrap", "squares"]), { data, width, height } = got;
    const wrap = wraps(`${name}.`, got);
    integer(`${name}.width`, width, 1, 16384);
    integer(`${name}.height`, height, 1, 16384);
    const channels = numbers(`${name}.data`, data).length / (width * height);
    if (channels !== 3 && channels !== 4) {
        throw new ShadeError(`${name}.data must hold 3 or 4 bytes a pixel, not ${data.length} in all`);
    }
    const bytes = bytesOf(`${name}.data`, data);
    if (channels === 4) return { data: bytes, width, height, wrap };
    const rgba = new Uint8ClampedArray(4 * width * height).fill(255);
    for (let i = 0; i < width * height; i++) rgba.set(bytes.subarray(3 * i, 3 * i + 3), 4 * i);
    return { data: rgba, width, height, wrap };
}

const MODELS = ["blinn-phong", "phong", "lambert", "ambient", "emissive", "cool-to-warm"];
const LAMP = ["position", "color", "diffuse", "specular", "ambient", "constant", "linear", "quadratic",
              "spotDirection", "spotExponent", "spotCosCutoff"];

/** A lamp as the words of shade_light. */
function lamp(name, value) {
    const got = record(name, value, LAMP), row = new Float64Array(21);
    const put = (at, key, given, length = 3) => row.set(vector(`${name}.${key}`, given, length), at);
    const { color: own = [1, 1, 1], ambient = [0, 0, 0], spotDirection = [0, 0, 0] } = got;
    put(0, "position", got.position, 4);
    if (got.position[3] === 0 && Math.hypot(...got.position) < 1e-18) {    // its square is no float
        throw new ShadeError(`${name}.position must not be zero: with w = 0 it is a direction`);
    }
    row.set(got.position);    // in double, as meshes are far away
    put(4, "ambient", ambient);
    put(7, "diffuse", got.diffuse ?? own);
    put(10, "specular", got.specular ?? own);
    ["constant", "linear", "quadratic", "spotExponent", "spotCosCutoff"].forEach((key, i) => {
        const cosine = key === "spotCosCutoff";
        row[i < 3 ? 13 + i : 16 + i] = number(`${name}.${key}`, got[key] ?? 0, cosine ? -1 : 0, cosine ? 1 : 3e38);
    });
    put(16, "spotDirection", spotDirection);
    return row;
}

/** Lamps, ambient light, number of the equation, and flags of one's own. */
export function lighting(name, value) {
    const { lights = [], ambient = [0, 0, 0], model = "blinn-phong", flags = 0 } =
        record(name, value, ["lights", "ambient", "model", "flags"]);
    if (!Array.isArray(lights)) throw new ShadeError(`${name}.lights must be an array, not ${shown(lights)}`);
    return {
        lights: lights.map((one, i) => lamp(`${name}.lights[${i}]`, one)),
        ambient: vector(`${name}.ambient`, ambient, 3),
        model: MODELS.indexOf(choice(`${name}.model`, model, MODELS)),
        flags: integer(`${name}.flags`, flags, 0, 63),
    };
}
