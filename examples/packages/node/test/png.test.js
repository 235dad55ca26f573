// Depth and numbers of objects as PNG files of 16 bits.  same.test.js compares them with those of Python.
import assert from "node:assert/strict";
import test from "node:test";
import { inflateSync } from "node:zlib";
import { Camera, Renderer, ShadeError, depthPng, idsPng, readDepthPng, readIdsPng } from "shade-h";

/** The numbers of a file of ours, by zlib and the PNG specification: filter 2 is the difference from the row above. */
function stored(bytes) {
    const view = new DataView(bytes.buffer), width = view.getUint32(16), height = view.getUint32(20), out = [];
    assert.deepEqual([...bytes.slice(24, 29)], [16, 0, 0, 0, 0]);    // 16 bits of grey
    const size = view.getUint32(33), rows = inflateSync(bytes.slice(41, 41 + size)), above = new Uint8Array(2 * width);
    assert.equal(String.fromCharCode(...bytes.slice(37, 41)), "IDAT");
    for (let y = 0, at = 0; y < height; y++) {
        assert.equal(rows[at++], 2);
        for (let i = 0; i < 2 * width; i++) above[i] += rows[at++];
        for (let x = 0; x < width; x++) out.push(256 * above[2 * x] + above[2 * x + 1]);
    }
    return out;
}

test("depth is whole millimetres and comes back", async () => {
    const made = new Renderer(48, 64);
    made.add("plane", [2, 2]);
    made.add("sphere", 0.4, { at: [0, 0, 0.4] });
    const { depth, ids } = made.render(Camera.lookAt([2, -2, 1.5], undefined, { aspect: 4 / 3 }));
    const file = await depthPng(depth, 64, 48), there = (x) => x < Infinity;
    assert.deepEqual(stored(file), Array.from(depth, (x) => (there(x) ? Math.floor(x / 0.001 + 0.5) : 0)));
    const again = await readDepthPng(file);
    assert.ok(depth.some(there) && !depth.every(there));
    assert.ok(again.width === 64 && again.height === 48 && again.depth.every((x, i) => x === depth[i] || Math.abs(x - depth[i]) <= 0.0005001));
    const numbers = await idsPng(ids, 64, 48), first = ids.filter((_, i) => i % 2 === 0);
    assert.deepEqual(stored(numbers), Array.from(first, (x) => x + 1));
    assert.deepEqual((await readIdsPng(numbers)).ids, first);
    assert.deepEqual(stored(await idsPng(first, 64, 48)), stored(numbers));
    made.free();
});

test("what is near stays, and what cannot be stored or read is refused", async () => {
    assert.deepEqual(stored(await depthPng([0.0001, 65.535, 0, -1, Infinity, NaN], 6, 1)), [1, 65535, 0, 0, 0, 0]);
    const good = await depthPng([1, 2, 3, 4], 2, 2), bent = good.slice(), early = good.slice(0, -20);
    bent[45] ^= 1;
    for (const [words, call] of [
        [/^depth must be at most 65.535/, () => depthPng([1, 65.6], 2, 1)], [/^unit must be/, () => depthPng([1], 1, 1, 0)],
        [/^depth must hold 4 numbers, not 3/, () => depthPng([1, 2, 3], 2, 2)], [/^width must be/, () => depthPng([], 0, 1)],
        [/^depth must be an array/, () => depthPng("x", 1, 1)], [/^ids must be an Int32Array/, () => idsPng([1], 1, 1)],
        [/^ids must be from -1/, () => idsPng(Int32Array.of(65535), 1, 1)], [/^ids must hold 4/, () => idsPng(new Int32Array(3), 2, 2)],
        [/^bytes is no PNG file/, () => readIdsPng(new Uint8Array(9))], [/^bytes must be a Uint8Array/, () => readIdsPng([1])],
        [/^bytes has a chunk whose checksum/, () => readDepthPng(bent)], [/^bytes ends early/, () => readDepthPng(early)],
        [/^unit must be/, () => readDepthPng(good, NaN)]]) {
        await assert.rejects(call, (error) => error instanceof ShadeError && words.test(error.message), `${words}`);
    }
    assert.deepEqual([...(await readDepthPng(good)).depth], [1, 2, 3, 4]);
});
