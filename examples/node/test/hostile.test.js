// Whatever is passed, the module answers by a picture or by an error with a sentence, and goes on.
import assert from "node:assert/strict";
import test from "node:test";
import { Mesh, PRESETS, ShadeError, render } from "shade-h";

const box = () => ({
    positions: [0, 0, 0, 0, 0, 1, 0, 1, 0, 0, 1, 1, 1, 0, 0, 1, 0, 1, 1, 1, 0, 1, 1, 1],
    indices: [0, 1, 3, 0, 3, 2, 4, 6, 7, 4, 7, 5, 0, 4, 5, 0, 5, 1, 2, 3, 7, 2, 7, 6, 0, 2, 6, 0, 6, 4,
              1, 5, 7, 1, 7, 3],
});
const small = { size: 32, samples: 1 };

function refused(words, mesh, options = small) {
    assert.throws(() => render(mesh, options), (error) => {
        assert.ok(error instanceof ShadeError, `${error}`);
        assert.match(error.message, words);
        return true;
    });
}

test("a mesh far from the origin is drawn as it is at the origin", () => {
    const { positions, ...rest } = box(), near = render({ positions, ...rest }, { ...small, depth: true });
    for (const far of [1e6, 1e8, -1e11]) {
        const moved = positions.map((x) => x + far);
        for (const kind of [moved, Float64Array.from(moved)]) {
            const got = render({ positions: kind, ...rest }, { ...small, depth: true });
            for (const part of ["data", "depth", "ids"]) assert.deepEqual(got[part], near[part]);
        }
        const pose = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, far, far, far, 1];
        assert.deepEqual(render({ positions, ...rest, pose }, small).data, near.data);
    }
});

test("errors begin with the name of the argument", () => {
    refused(/^mesh must be an object/, 7);
    refused(/^mesh must be an object/, undefined);
    refused(/^positions must be an array of numbers/, {});
    refused(/^positions must hold 3 numbers a row, not 4/, { positions: [0, 0, 0, 1] });
    refused(/^positions must hold numbers alone/, { positions: [0, 0, "1"] });
    refused(/^positions must be an array/, { positions: new BigInt64Array(3) });
    refused(/^mesh\.vertices is no option/, { vertices: [] });
    refused(/^indices: bad indices.*index 8 of 8/, { ...box(), indices: [0, 1, 8] });
    refused(/^indices: bad indices.*index -1 of 8/, { ...box(), indices: [0, 1, -1] });
    refused(/^indices: bad indices.*index 0.5 of/, { ...box(), indices: [0, 1, 0.5] });
    refused(/^indices: bad indices.*4 indices/, { ...box(), indices: [0, 1, 2, 3] });
    refused(/^normals must be one of/, { ...box(), normals: "round" });
    refused(/^normals must have a row for each of 8 vertices, not 1/, { ...box(), normals: [0, 0, 1] });
    refused(/^colors must have a row for each of 8 vertices or 12 faces, not 2/,
            { ...box(), colors: [0, 0, 0, 1, 1, 1] });
    refused(/^color must be #RRGGBB.*"toString"/, { ...box(), color: "toString" });
    refused(/^uv and texture belong together/, { ...box(), uv: new Float32Array(16) });
    refused(/^texture.data must hold 3 or 4 bytes a pixel, not 5/, { ...box(),
            uv: new Float32Array(16), texture: { data: [1, 2, 3, 4, 5], width: 1, height: 1 } });
    refused(/^material must be one of emerald/, { ...box(), material: "wood" });
    refused(/^material.shininess must be a number from 0/, { ...box(), material: { shininess: -1 } });
    refused(/^pose must hold 16 finite numbers/, { ...box(), pose: [1, 2, NaN] });
    refused(/^edges must be true or false, not 1/, { ...box(), edges: 1 });
    refused(/^size\[1\] must be a number from 1 to 16384, not 0/, box(), { size: [4, 0] });
    refused(/^size\[0\] must be a whole number, not 4.5/, box(), { size: [4.5, 4] });
    refused(/^samples must be a number from 1 to 8, not 9/, box(), { samples: 9 });
    refused(/^size times samples must be at most 16384, not 16400/, box(), { size: 8200, samples: 2 });
    refused(/^view must be one of front/, box(), { view: "above" });
    refused(/^view must hold 2 finite numbers/, box(), { view: [1, 2, 3] });
    refused(/^view.view must be a rotation/, box(), { view: { view: Array(16).fill(2),
                                                             projection: Array(16).fill(1) } });
    refused(/^up must be one of y, z/, box(), { up: "x" });
    refused(/^options.sampels is no option/, box(), { sampels: 2 });
    refused(/^background must be/, box(), { background: "nowhere" });
    refused(/^light must be one of quick, studio, not "soft"/, box(), { light: "soft" });
    refused(/^light.lights must be an array, not 3/, box(), { light: { lights: 3 } });
    refused(/^light.lights\[0\].position must be an array/, box(), { light: { lights: [{}] } });
    refused(/^light.lights\[1\].colour is no option/, box(),
            { light: { lights: [{ position: [0, 0, 1, 0] }, { colour: 1 }] } });
    refused(/^light.model must be one of/, box(), { light: { model: "gouraud" } });
    refused(/^light.flags must be a number from 0 to 63/, box(), { light: { flags: 64 } });
    refused(/^mesh was freed/, (() => { const mesh = new Mesh(box()); mesh.free(); mesh.free();
                                        return mesh; })());
});

test("names of CSS", () => {
    const drawn = (color) => render({ ...box(), color }, small).data;
    for (const [name, digits] of [["tomato", "#ff6347"], ["RebeccaPurple", "#663399"],
                                  ["yellowgreen", "9acd32"], ["aliceblue", "#f0f8ff"], ["lime", "#0f0"]]) {
        assert.deepEqual(drawn(name), drawn(digits), name);
    }
    assert.deepEqual(drawn("Steel"), drawn("#8FA3B5"));
});

test("what cannot be seen is a warning", (context) => {
    const said = context.mock.method(console, "warn", () => {}).mock;
    const last = () => said.calls.at(-1)?.arguments[0];
    render(box(), small);
    assert.equal(said.callCount(), 0);
    render({ ...box(), indices: [] }, small);
    assert.match(last(), /^shade-h: indices: there are no triangles/);
    render({ positions: [] }, small);
    assert.equal(said.callCount(), 2);
    render({ positions: [NaN, 0, 0, 1, 0, 0, 0, 1, 0] }, small);
    assert.match(last(), /^shade-h: positions: no triangle has/);
    render({ positions: [1e30, 0, 0, 1, 0, 0, 0, 1, 0] }, small);
    assert.equal(said.callCount(), 4);
});

test("arrays that others change or reuse", () => {
    const source = { ...box(), positions: Float32Array.from(box().positions) };
    const mesh = new Mesh(source), before = render(mesh, small);
    source.positions.fill(9);
    source.indices.fill(0);
    assert.deepEqual(render(mesh, small).data, before.data);
    const inside = new Float32Array(40);
    inside.set(box().positions, 8);
    const part = { ...box(), positions: inside.subarray(8, 32) };
    assert.deepEqual(render(part, small).data, before.data);
    for (const kind of [Float64Array, Int8Array, Uint16Array]) {
        const other = { positions: kind.from(box().positions), indices: Uint8Array.from(box().indices) };
        assert.deepEqual(render(other, small).data, before.data);
    }
});

test("pictures of a size that makes the memory grow", () => {
    const mesh = new Mesh(box()), before = render(mesh, small), big = { size: 4096, samples: 1 };
    assert.equal(render(mesh, big).data.length, 4 * 4096 * 4096);
    assert.deepEqual(render(mesh, small).data, before.data);
});

test("memory is given back", () => {
    const positions = new Float32Array(12e6);    // 48 MB, of which 4 GB hold no 100 copies
    positions.set(box().positions);
    for (let i = 0; i < 100; i++) {
        const mesh = new Mesh({ ...box(), positions, normals: "flat" });
        render(mesh, small);
        mesh.free();
    }
});

// ---- arguments at random, from a generator that repeats

let state = 20261123;
const random = () => {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    return state / 4294967296;
};
const one = (choices) => choices[Math.floor(random() * choices.length)];
const odd = () => one([NaN, Infinity, -Infinity, -1, 0, 1e38, 1e-38, 2 ** 31, 2 ** 32, 0.5, "7", null,
                       undefined, true, {}, [], [[]], () => 0, Symbol.iterator, 7n, new Date(NaN)]);
function numbers(length, most) {
    const kind = one([Array, Float32Array, Float64Array, Int32Array, Uint8Array, Uint32Array]);
    const n = random() < 0.03 ? one([length + 1, 0, 3, 6000]) : length;
    return kind.from({ length: n }, () => one([random(), random() * most, -random(), random() < 0.01
        ? one([NaN, Infinity, -1e38, 1e30]) : 1]));
}
const wild = (good) => random() < 0.03 ? odd() : good;
function anyMesh() {
    const mesh = { ...box() };
    if (random() < 0.3) mesh.positions = wild(numbers(24, 3));
    if (random() < 0.3) mesh.indices = wild(numbers(36, 9));
    if (random() < 0.3) mesh.normals = wild(one(["auto", "flat", "smooth", numbers(24, 1)]));
    if (random() < 0.3) mesh.color = wild(one(["red", "#123", numbers(3, 1)]));
    if (random() < 0.3) mesh.colors = wild(numbers(one([24, 36]), 300));
    if (random() < 0.2) mesh.uv = wild(numbers(16, 4));
    if (random() < 0.2) mesh.texture = wild({ data: wild(numbers(12, 255)), width: wild(2), height: wild(2) });
    if (random() < 0.3) mesh.material = wild(one([one(PRESETS), { diffuse: numbers(3, 1) }]));
    if (random() < 0.2) mesh.pose = wild(numbers(16, 5));
    if (random() < 0.4) mesh.edges = wild(random() < 0.5);
    return wild(mesh);
}
function anyOptions() {
    const options = { size: wild([1 + Math.floor(random() * 60), 40]), samples: wild(one([1, 2, 3])) };
    if (random() < 0.4) options.view = wild(one(["top", "iso", numbers(2, 400),
        { view: numbers(16, 1), projection: numbers(16, 2) }]));
    if (random() < 0.2) options.background = wild(one([null, "black"]));
    if (random() < 0.2) options.ortho = wild(true);
    if (random() < 0.2) options.depth = wild(true);
    if (random() < 0.3) options.light = wild(one(["quick", "studio",
        { lights: [wild({ position: numbers(4, 9), color: wild(numbers(3, 2)), linear: wild(1) })],
          ambient: wild(numbers(3, 1)), model: wild("phong") }]));
    return wild(options);
}

test("1000 calls with arguments at random", () => {
    const mesh = new Mesh({ ...box(), edges: true }), before = render(mesh, small);
    let drawn = 0;
    console.warn = () => {};
    for (let i = 0; i < 1000; i++) {
        try {
            render(random() < 0.2 ? [anyMesh(), mesh, anyMesh()] : anyMesh(), anyOptions());
            drawn++;
        } catch (error) {
            assert.ok(error instanceof ShadeError || error instanceof RangeError, error.stack);
            assert.match(error.message, /^[a-z]/);
        }
    }
    assert.ok(drawn > 100, `${drawn} drawn`);
    assert.deepEqual(render(mesh, small).data, before.data);
});
