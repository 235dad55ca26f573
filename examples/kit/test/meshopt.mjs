// Writes meshopt.txt: buffer views that npm's meshoptimizer 1.3.0 has packed and unpacked, one a line.
//     npm install meshoptimizer@1.3.0; node meshopt.mjs >meshopt.txt
import { MeshoptDecoder as decoder, MeshoptEncoder as encoder } from "meshoptimizer";
await encoder.ready; await decoder.ready;

const MODES = ["ATTRIBUTES", "TRIANGLES", "INDICES"], FILTERS = ["NONE", "OCTAHEDRAL", "QUATERNION", "EXPONENTIAL", "COLOR"];
const hex = (bytes) => [...bytes].map((x) => x.toString(16).padStart(2, "0")).join("");
let seed = 1;
const random = () => { seed = (Math.imul(seed, 1103515245) + 12345) >>> 0; return seed / 2 ** 32; };

function line(mode, filter, count, stride, packed) {
    const out = new Uint8Array(count * stride);
    decoder.decodeGltfBuffer(out, count, stride, packed, MODES[mode], FILTERS[filter]);
    console.log(mode, filter, count, stride, hex(packed), hex(out));
}

for (const [count, stride] of [[1, 4], [17, 8], [40, 12], [300, 4]]) {
    const kinds = [() => random() * 256, () => 0, (i) => 3 * Math.floor(i / stride) + 4 * random() + i % stride,
                   (i) => (random() < 0.1 ? random() * 256 : i % stride)];
    for (const kind of kinds) {
        const bytes = Uint8Array.from({ length: count * stride }, (_, i) => kind(i));
        for (const [level, version] of [[2, 0], [0, 1], [3, 1]]) {
            line(0, 0, count, stride, encoder.encodeVertexBufferLevel(bytes, count, stride, level, version));
        }
    }
    const waves = Float32Array.from({ length: count * stride / 4 }, (_, i) => 10 * Math.sin(i / 100));
    line(0, 0, count, stride, encoder.encodeVertexBufferLevel(new Uint8Array(waves.buffer), count, stride, 3, 1));
}
const grid = [];
for (let a = 0; a < 30; a++) if (a % 6 < 5) grid.push(a, a + 1, a + 6, a + 1, a + 7, a + 6);
const loose = Array.from({ length: 30 }, () => Math.floor(36 * random()));
for (const indices of [grid, loose, [...loose, ...grid, ...loose]]) {
    for (const kind of [Uint16Array, Uint32Array]) {
        const stride = kind.BYTES_PER_ELEMENT, bytes = new Uint8Array(kind.from(indices).buffer);
        for (const mode of [1, 2]) {
            line(mode, 0, indices.length, stride, encoder.encodeGltfBuffer(bytes, indices.length, stride, MODES[mode]));
        }
    }
}
const unit = (width) => Float32Array.from(Array.from({ length: 20 }, () => {
    const row = Array.from({ length: 4 }, () => 2 * random() - 1), length = Math.hypot(...row.slice(0, width));
    return row.map((x, k) => (k < width ? x / length : x));
}).flat());
const pack = (bytes, filter, stride) => line(0, filter, 20, stride, encoder.encodeVertexBuffer(bytes, 20, stride));
pack(encoder.encodeFilterOct(unit(3), 20, 4, 8), 1, 4);
pack(encoder.encodeFilterOct(unit(3), 20, 8, 12), 1, 8);
pack(encoder.encodeFilterQuat(unit(4), 20, 8, 12), 2, 8);
pack(encoder.encodeFilterExp(unit(3), 20, 16, 15), 3, 16);
const colors = Float32Array.from({ length: 80 }, random);
pack(encoder.encodeFilterColor(colors, 20, 4, 6), 4, 4);
pack(encoder.encodeFilterColor(colors, 20, 8, 12), 4, 8);
