// Pictures, and PNG files: the core knows the format, the platform has zlib.
import * as check from "./arguments.js";

const { ShadeError } = check;
let core = null;

/** Hands over the functions of index.js that know the module's memory. */
export function useCore(functions) { core = functions; }

/** The file of rows that the core has made */
async function filed(width, height, kind, lines) {
    const stream = new Blob([lines]).stream().pipeThrough(new CompressionStream("deflate"));
    const packed = new Uint8Array(await new Response(stream).arrayBuffer());
    return core.withMemory((room) => {
        const at = core.put(room(packed.length + 1), packed), out = room(packed.length + 70);    // PNG_AROUND
        return core.bytes(out, core.library.png_file(width, height, kind, at, packed.length, out)).slice();
    });
}

/** So many bytes that zlib has packed, and no more of what may be many */
async function unpacked(bytes, count) {
    const out = new Uint8Array(count), reader = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate")).getReader();
    let at = 0;
    try {
        for (let part; at < count && !(part = await reader.read()).done;) {
            const some = part.value.subarray(0, count - at);
            out.set(some, at);
            at += some.length;
        }
    } catch { throw new ShadeError("bytes hold what zlib cannot unpack"); }
    reader.cancel().catch(() => {});
    if (at < count) throw new ShadeError("bytes of the PNG end early");
    return out;
}

/** The numbers of a grey PNG: { width, height, grey } */
async function opened(bytes) {
    if (!(bytes instanceof Uint8Array)) throw new ShadeError("bytes must be a Uint8Array");
    const { library, withMemory, put, text } = core, file = bytes.slice();
    const refuse = (wrong) => { if (wrong) throw new ShadeError(`bytes ${text(wrong)}`); };
    const { width, height, wanted, packed } = withMemory((room) => {
        const facts = room(32), png = room(256), at = put(room(file.length + 1), file);
        refuse(library.png_open(png, at, file.length, facts));
        const [columns, rows, size, count] = new Float64Array(library.memory.buffer, facts, 4);
        if (Math.max(columns, rows) > 16384) throw new ShadeError(`bytes are of ${columns} x ${rows} pixels; at most 16384 a side are read`);
        const out = room(size + 1);
        library.png_gather(png, out);
        return { width: columns, height: rows, wanted: count, packed: core.bytes(out, size).slice() };
    });
    const lines = await unpacked(packed, wanted);
    return withMemory((room) => {
        const facts = room(32), png = room(256), at = put(room(file.length + 1), file), grey = room(2 * width * height);
        refuse(library.png_open(png, at, file.length, facts));
        refuse(library.png_grey(png, put(room(lines.length + 1), lines), grey));
        return { width, height, grey: new Uint16Array(library.memory.buffer, grey, width * height).slice() };
    });
}

/** The bytes of a PNG of numbers that a function of the core makes of an array, and refuses by its name */
function numbered(name, array, width, height, step, make) {
    check.integer("width", width, 1, 16384);
    check.integer("height", height, 1, 16384);
    if (array.length !== step * width * height) {
        throw new ShadeError(`${name} must hold ${step * width * height} numbers, not ${array.length}`);
    }
    const { library, withMemory, put } = core, pixels = width * height;
    return filed(width, height, 0, withMemory((room) => {
        const grey = room(2 * pixels), at = put(room(array.byteLength), array), lines = room(height * (1 + 2 * width));
        make(put(room(16), new TextEncoder().encode(`${name}\0`)), at, pixels, grey);
        return core.bytes(lines, library.png_lines16(grey, width, height, lines)).slice();
    }));
}

/** The bytes of a PNG of 16-bit grey: depth in whole units, 0 where there is nothing. */
export async function depthPng(depth, width, height, unit = 0.001) {
    const { asked, library } = core, units = check.number("unit", unit, -Infinity, Infinity);
    return numbered("depth", Float32Array.from(check.rows("depth", depth, 1)), width, height, 1,
                    (name, at, n, grey) => asked(library.depth_numbers, name, at, n, units, grey, 0));
}

/** { width, height, depth } of such bytes: infinity where they have 0. */
export async function readDepthPng(bytes, unit = 0.001) {
    const { asked, library, withMemory, put } = core, units = check.number("unit", unit, -Infinity, Infinity);
    const { width, height, grey } = await opened(bytes);
    return withMemory((room) => {
        const at = room(4 * grey.length);
        asked(library.depth_numbers, 0, at, grey.length, units, put(room(grey.byteLength), grey), 1);
        return { width, height, depth: new Float32Array(library.memory.buffer, at, grey.length).slice() };
    });
}

/** The bytes of a PNG of 16-bit grey: numbers of objects, one or two a pixel, each one higher; 0 belongs to none. */
export async function idsPng(ids, width, height) {
    if (!(ids instanceof Int32Array)) throw new ShadeError("ids must be an Int32Array");
    const step = ids.length === 2 * width * height ? 2 : 1, { asked, library } = core;
    return numbered("ids", ids, width, height, step, (name, at, n, grey) => asked(library.id_numbers, name, at, n, step, grey));
}

/** { width, height, ids } of such bytes: -1 where they have 0. */
export async function readIdsPng(bytes) {
    const { width, height, grey } = await opened(bytes);
    return { width, height, ids: Int32Array.from(grey, (x) => x - 1) };
}

/** A picture: data has RGBA bytes, sRGB with straight alpha, row by row from the top. */
export class Picture {
    constructor(width, height, data, depth, ids) {
        Object.assign(this, { width, height, data, depth, ids });
    }

    /** The bytes of a PNG file: RGB where every pixel is opaque, else RGBA. */
    async png() {
        const { width, height, data } = this, { library, withMemory, put } = core;
        const [kind, lines] = withMemory((room) => {
            const type = room(4), at = put(room(data.length), data), out = room(height * (1 + 4 * width));
            const size = library.png_lines(at, width, height, type, out);
            if (!size) throw new RangeError("memory is not enough for the picture");
            return [new Int32Array(library.memory.buffer, type, 1)[0], core.bytes(out, size).slice()];
        });
        return filed(width, height, kind, lines);
    }
}
