// Turns what callers pass into arrays and numbers, or refuses it by its name.

/** What render and Mesh throw: a sentence that begins with the name of the argument. */
export class ShadeError extends TypeError {}

const NAMES = {
    white: 0xFFFFFF, black: 0, gray: 0x808080, grey: 0x808080, red: 0xD62728, green: 0x2CA02C,
    blue: 0x1F77B4, orange: 0xFF7F0E, yellow: 0xF2C037, purple: 0x9467BD, brown: 0x8C564B,
    pink: 0xE377C2, cyan: 0x17BECF, steel: 0x8FA3B5, clay: 0xBFB2A4,
};

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
    if (Array.isArray(value) && !value.every((x) => typeof x === "number")) {
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

/** Display colours, 0 .. 1; integers are bytes. */
export function displayed(name, value, width) {
    if (value instanceof Uint8Array || value instanceof Uint8ClampedArray) {
        return Float32Array.from(value, (x) => x * Math.fround(1 / 255));
    }
    return rows(name, value, width);
}

/** One display colour: #RRGGBB, #RGB, a name, or three numbers. */
export function color(name, value) {
    if (typeof value !== "string") return vector(name, displayed(name, value, 3), 3);
    let bits = Object.hasOwn(NAMES, value) ? NAMES[value] : undefined;
    const digits = /^#?([0-9a-f]{3}|[0-9a-f]{6})$/i.exec(value)?.[1];
    if (bits === undefined && digits) {
        bits = parseInt(digits.length === 3 ? digits.replace(/./g, "$&$&") : digits, 16);
    }
    if (bits === undefined) {
        throw new ShadeError(`${name} must be #RRGGBB, #RGB or one of ` +
                             `${Object.keys(NAMES).join(", ")}, not ${shown(value)}`);
    }
    return Float32Array.of((bits >> 16) / 255, ((bits >> 8) & 255) / 255, (bits & 255) / 255);
}

/** A picture of RGB or RGBA bytes, as RGBA. */
export function texture(name, value) {
    const { data, width, height } = record(name, value, ["data", "width", "height"]);
    integer(`${name}.width`, width, 1, 16384);
    integer(`${name}.height`, height, 1, 16384);
    const channels = numbers(`${name}.data`, data).length / (width * height);
    if (channels !== 3 && channels !== 4) {
        throw new ShadeError(`${name}.data must hold 3 or 4 bytes a pixel, not ${data.length} in all`);
    }
    const bytes = Uint8ClampedArray.from(data);
    if (channels === 4) return { data: bytes, width, height };
    const rgba = new Uint8ClampedArray(4 * width * height).fill(255);
    for (let i = 0; i < width * height; i++) rgba.set(bytes.subarray(3 * i, 3 * i + 3), 4 * i);
    return { data: rgba, width, height };
}
