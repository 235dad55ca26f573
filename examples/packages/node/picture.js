// Pictures, and PNG files by the zlib of the platform.

const TABLE = Uint32Array.from({ length: 256 }, (_, i) => {
    for (let k = 0; k < 8; k++) i = i & 1 ? 0xEDB88320 ^ (i >>> 1) : i >>> 1;
    return i;
});
function crc32(bytes) {
    let crc = 0xFFFFFFFF;
    for (const byte of bytes) crc = TABLE[(crc ^ byte) & 255] ^ (crc >>> 8);
    return ~crc >>> 0;
}

function chunk(kind, data) {
    const out = new Uint8Array(12 + data.length), view = new DataView(out.buffer);
    view.setUint32(0, data.length);
    for (let k = 0; k < 4; k++) out[4 + k] = kind.charCodeAt(k);
    out.set(data, 8);
    view.setUint32(8 + data.length, crc32(out.subarray(4, 8 + data.length)));
    return out;
}

async function deflated(bytes) {
    const stream = new Blob([bytes]).stream().pipeThrough(new CompressionStream("deflate"));
    return new Uint8Array(await new Response(stream).arrayBuffer());
}

/** A picture: data has RGBA bytes, sRGB with straight alpha, row by row from the top. */
export class Picture {
    constructor(width, height, data, depth, ids) {
        Object.assign(this, { width, height, data, depth, ids });
    }

    /** The bytes of a PNG file: RGB where every pixel is opaque, else RGBA. */
    async png() {
        const { width, height, data } = this, opaque = data.every((x, i) => i % 4 < 3 || x === 255);
        const channels = opaque ? 3 : 4, stride = 1 + channels * width;
        const lines = new Uint8Array(stride * height), header = new Uint8Array(13);
        for (let y = 0; y < height; y++) {    // each row as its difference from the row above
            lines[y * stride] = 2;
            for (let x = 0; x < width; x++) {
                for (let k = 0; k < channels; k++) {
                    const at = 4 * (y * width + x) + k, above = y ? data[at - 4 * width] : 0;
                    lines[y * stride + 1 + channels * x + k] = data[at] - above;
                }
            }
        }
        new DataView(header.buffer).setUint32(0, width);
        new DataView(header.buffer).setUint32(4, height);
        header.set([8, opaque ? 2 : 6, 0, 0, 0], 8);
        const signature = Uint8Array.of(137, 80, 78, 71, 13, 10, 26, 10);
        const parts = [signature, chunk("IHDR", header), chunk("IDAT", await deflated(lines)),
                       chunk("IEND", new Uint8Array(0))];
        return new Uint8Array(await new Blob(parts).arrayBuffer());
    }
}
