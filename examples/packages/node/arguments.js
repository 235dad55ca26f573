// Turns what callers pass into arrays and numbers, or refuses it by its name.

/** What render and Mesh throw: a sentence that begins with the name of the argument. */
export class ShadeError extends TypeError {}

const NAMES = {
    white: 0xFFFFFF, black: 0, gray: 0x808080, grey: 0x808080, red: 0xD62728, green: 0x2CA02C,
    blue: 0x1F77B4, orange: 0xFF7F0E, yellow: 0xF2C037, purple: 0x9467BD, brown: 0x8C564B,
    pink: 0xE377C2, cyan: 0x17BECF, steel: 0x8FA3B5, clay: 0xBFB2A4,
};

// The rest of the names of CSS Color Module Level 4, section 6.1
const CSS = new Map(Array.from(`
    aliceblue f0f8ff antiquewhite faebd7 aqua 00ffff aquamarine 7fffd4 azure f0ffff beige f5f5dc
    bisque ffe4c4 blanchedalmond ffebcd blueviolet 8a2be2 burlywood deb887 cadetblue 5f9ea0
    chartreuse 7fff00 chocolate d2691e coral ff7f50 cornflowerblue 6495ed cornsilk fff8dc
    crimson dc143c darkblue 00008b darkcyan 008b8b darkgoldenrod b8860b darkgray a9a9a9
    darkgreen 006400 darkgrey a9a9a9 darkkhaki bdb76b darkmagenta 8b008b darkolivegreen 556b2f
    darkorange ff8c00 darkorchid 9932cc darkred 8b0000 darksalmon e9967a darkseagreen 8fbc8f
    darkslateblue 483d8b darkslategray 2f4f4f darkslategrey 2f4f4f darkturquoise 00ced1
    darkviolet 9400d3 deeppink ff1493 deepskyblue 00bfff dimgray 696969 dimgrey 696969
    dodgerblue 1e90ff firebrick b22222 floralwhite fffaf0 forestgreen 228b22 fuchsia ff00ff
    gainsboro dcdcdc ghostwhite f8f8ff gold ffd700 goldenrod daa520 greenyellow adff2f
    honeydew f0fff0 hotpink ff69b4 indianred cd5c5c indigo 4b0082 ivory fffff0 khaki f0e68c
    lavender e6e6fa lavenderblush fff0f5 lawngreen 7cfc00 lemonchiffon fffacd lightblue add8e6
    lightcoral f08080 lightcyan e0ffff lightgoldenrodyellow fafad2 lightgray d3d3d3
    lightgreen 90ee90 lightgrey d3d3d3 lightpink ffb6c1 lightsalmon ffa07a lightseagreen 20b2aa
    lightskyblue 87cefa lightslategray 778899 lightslategrey 778899 lightsteelblue b0c4de
    lightyellow ffffe0 lime 00ff00 limegreen 32cd32 linen faf0e6 magenta ff00ff maroon 800000
    mediumaquamarine 66cdaa mediumblue 0000cd mediumorchid ba55d3 mediumpurple 9370db
    mediumseagreen 3cb371 mediumslateblue 7b68ee mediumspringgreen 00fa9a mediumturquoise 48d1cc
    mediumvioletred c71585 midnightblue 191970 mintcream f5fffa mistyrose ffe4e1 moccasin ffe4b5
    navajowhite ffdead navy 000080 oldlace fdf5e6 olive 808000 olivedrab 6b8e23 orangered ff4500
    orchid da70d6 palegoldenrod eee8aa palegreen 98fb98 paleturquoise afeeee
    palevioletred db7093 papayawhip ffefd5 peachpuff ffdab9 peru cd853f plum dda0dd
    powderblue b0e0e6 rebeccapurple 663399 rosybrown bc8f8f royalblue 4169e1 saddlebrown 8b4513
    salmon fa8072 sandybrown f4a460 seagreen 2e8b57 seashell fff5ee sienna a0522d silver c0c0c0
    skyblue 87ceeb slateblue 6a5acd slategray 708090 slategrey 708090 snow fffafa
    springgreen 00ff7f steelblue 4682b4 tan d2b48c teal 008080 thistle d8bfd8 tomato ff6347
    turquoise 40e0d0 violet ee82ee wheat f5deb3 whitesmoke f5f5f5 yellowgreen 9acd32`.matchAll(/([a-z]+) ([0-9a-f]{6})/g), (found) => found.slice(1)));

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

/** Display colours, 0 .. 1; integers are bytes. */
export function displayed(name, value, width) {
    if (value instanceof Uint8Array || value instanceof Uint8ClampedArray) {
        return Float32Array.from(value, (x) => x * Math.fround(1 / 255));
    }
    const got = rows(name, value, width);
    if (!got.every((x) => x >= 0 && x <= 1)) throw new ShadeError(`${name} must be from 0 to 1`);
    return got;
}

/** One display colour: #RRGGBB, #RGB, a name of ours or of CSS, or three numbers. */
export function color(label, value) {
    if (typeof value !== "string") return vector(label, displayed(label, value, 3), 3);
    const name = value.toLowerCase();
    let bits = Object.hasOwn(NAMES, name) ? NAMES[name] : undefined;
    const digits = CSS.get(name) ?? /^#?([0-9a-f]{3}|[0-9a-f]{6})$/i.exec(value)?.[1];
    if (bits === undefined && digits) {
        bits = parseInt(digits.length === 3 ? digits.replace(/./g, "$&$&") : digits, 16);
    }
    if (bits === undefined) {
        throw new ShadeError(`${label} must be #RRGGBB, #RGB, a name of CSS or one of ` +
                             `${Object.keys(NAMES).join(", ")}, not ${shown(value)}`);
    }
    return Float32Array.of((bits >> 16) / 255, ((bits >> 8) & 255) / 255, (bits & 255) / 255);
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
