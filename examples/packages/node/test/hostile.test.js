// Whatever is passed, the module answers by a picture or by an error with a sentence, and goes on.
import assert from "node:assert/strict";
import test from "node:test";
import { deflateRawSync } from "node:zlib";
import { Mesh, PRESETS, Renderer, ShadeError, read3mf, readGltf, readModel, render } from "shade-h";

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
    refused(/^color must be #RRGGBB.*'toString'/, { ...box(), color: "toString" });
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
    const positions = new Float32Array(12e6);    // 48 MB
    positions.set(box().positions);
    let before = 0;
    for (let i = 0; i < 24; i++) {
        const mesh = new Mesh({ ...box(), positions, normals: "flat" });
        render(mesh, small);
        mesh.free();
        if (i === 3) before = process.memoryUsage().rss;
    }
    const more = process.memoryUsage().rss - before;    // 20 meshes that stay would be 960 MB
    assert.ok(more < 300e6, `${more} bytes`);
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
    if (mesh.uv && random() < 0.5) mesh[one(["relief", "glow"])] = { data: numbers(12, 255), width: 2, height: 2 };
    if (random() < 0.2) mesh.strength = wild(9 * random() - 4);
    if (random() < 0.2) mesh.glowFactor = wild(numbers(3, 2));
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

// ---- glTF

/** A quad that looks along +z, as GLB; change alters its JSON. */
function glb(change = () => {}) {
    const numbers = Float32Array.of(0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 1);
    const data = new Uint8Array(numbers.byteLength + 12);
    data.set(new Uint8Array(numbers.buffer));
    data.set(new Uint8Array(Uint16Array.of(0, 1, 2, 0, 2, 3).buffer), numbers.byteLength);
    const json = {
        asset: { version: "2.0" }, scene: 0, scenes: [{ nodes: [0] }],
        nodes: [{ children: [1], rotation: [0, 0, 0, 1] }, { mesh: 0, scale: [1, 1, 1] }],
        meshes: [{ primitives: [{ attributes: { POSITION: 0, TEXCOORD_0: 1 }, indices: 2, material: 0 }] }],
        materials: [{ pbrMetallicRoughness: { baseColorFactor: [1, 0, 0, 1], metallicFactor: 0 } }],
        accessors: [{ bufferView: 0, componentType: 5126, type: "VEC3", count: 4 },
                    { bufferView: 1, componentType: 5126, type: "VEC2", count: 4 },
                    { bufferView: 2, componentType: 5123, type: "SCALAR", count: 6 }],
        bufferViews: [{ buffer: 0, byteLength: 48 }, { buffer: 0, byteOffset: 48, byteLength: 32 },
                      { buffer: 0, byteOffset: 80, byteLength: 12 }],
        buffers: [{ byteLength: 92 }],
    };
    change(json);
    let text = JSON.stringify(json);
    text += " ".repeat((4 - text.length % 4) % 4);
    const out = new Uint8Array(28 + text.length + data.length), view = new DataView(out.buffer);
    [0x46546C67, 2, out.length, text.length, 0x4E4F534A].forEach((x, i) => view.setUint32(4 * i, x, true));
    out.set(new TextEncoder().encode(text), 20);
    view.setUint32(20 + text.length, data.length, true);
    view.setUint32(24 + text.length, 0x004E4942, true);
    out.set(data, 28 + text.length);
    return out;
}
const front = { ...small, view: "front", up: "y", ortho: true };

test("a GLB is what its nodes and material say", () => {
    const [mesh] = readGltf(glb());
    assert.deepEqual([...mesh.positions], [0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0]);
    assert.deepEqual([...mesh.indices], [0, 1, 2, 0, 2, 3]);
    const { data } = render(mesh, front), middle = data.subarray(4 * (16 * 32 + 16));
    assert.ok(middle[0] > 100 && middle[1] < 80 && middle[2] < 80);
    const [moved] = readGltf(glb((json) => { json.nodes[0].translation = [5, 0, 0]; json.nodes[1].scale = [-2, 1, 1]; }));
    assert.deepEqual([...moved.positions], [5, 0, 0, 3, 0, 0, 3, 1, 0, 5, 1, 0]);
    assert.deepEqual([...moved.indices], [0, 2, 1, 0, 3, 2]);    // mirrored: still counter-clockwise
    const strip = (json) => { json.meshes[0].primitives[0].mode = 5; };
    assert.deepEqual([...readGltf(glb(strip))[0].indices], [0, 1, 2, 1, 0, 2, 2, 0, 2, 0, 3, 2]);
});

test("an unlit material has its own colour in every light", () => {
    const [mesh] = readGltf(glb((json) => {
        json.materials[0] = { pbrMetallicRoughness: { baseColorFactor: [0.6, 0.3, 0.2, 1] },
                              extensions: { KHR_materials_unlit: {} } };
    }));
    assert.equal(mesh.unlit, true);
    const wanted = [203, 149, 124];    // sRGB of the linear 0.6, 0.3, 0.2
    for (const light of ["quick", "studio"]) {
        const { data } = render(mesh, { ...front, light });
        assert.deepEqual([...data.subarray(4 * (16 * 32 + 16)).subarray(0, 3)], wanted);
    }
    const renderer = new Renderer(32, 32);
    renderer.add(renderer.mesh(new Mesh(mesh)));
    renderer.light([]);
    const { color } = renderer.render({ view: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -0.5, -0.5, -3, 1],
                                        projection: [2, 0, 0, 0, 0, 2, 0, 0, 0, 0, -1.02, -1, 0, 0, -0.202, 0] });
    renderer.free();
    assert.deepEqual([...color.subarray(3 * (16 * 32 + 16)).subarray(0, 3)], wanted);
});

test("pictures of a GLB are decoded by the caller", () => {
    const textured = glb((json) => {
        json.materials[0].pbrMetallicRoughness = { baseColorTexture: { index: 0 }, metallicFactor: 0 };
        json.textures = [{ source: 0 }];
        json.images = [{ uri: "data:image/png;base64,AAEC", mimeType: "image/png" }];
    });
    const asked = [], data = Uint8Array.of(0, 0, 255, 0);
    const [mesh] = readGltf(textured, { picture: (bytes, kind) => { asked.push([...bytes], kind); return { data, width: 1, height: 1 }; } });
    assert.deepEqual(asked, [[0, 1, 2], "image/png"]);
    const middle = render(mesh, front).data.subarray(4 * (16 * 32 + 16));
    assert.ok(middle[2] > 100 && middle[0] < 80 && middle[3] === 255);
    const { warn } = console, told = [];
    console.warn = (words) => { told.push(words); };
    try { readGltf(textured); } finally { console.warn = warn; }
    assert.match(told.join(), /^shade-h: model: it has pictures/);
});

test("a sampler of a GLB says how its texture goes on", () => {
    const data = Uint8Array.of(255, 0, 0, 255, 0, 0, 255, 255), picture = () => ({ data, width: 2, height: 1 });
    const hues = (wrapS) => {    // where u is 1.25, 1.75 and 2.25
        const [mesh] = readGltf(glb((json) => {
            const transform = { KHR_texture_transform: { scale: [3, 1] } };
            json.materials[0].pbrMetallicRoughness =
                { baseColorTexture: { index: 0, extensions: transform }, metallicFactor: 0 };
            json.samplers = [{ wrapS }];
            json.textures = [{ source: 0, sampler: 0 }];
            json.images = [{ uri: "data:image/png;base64,AAEC", mimeType: "image/png" }];
        }), { picture });
        const row = render(mesh, { ...front, size: 96, background: null }).data.subarray(4 * 96 * 48, 4 * 96 * 49);
        const seen = [...Array(96).keys()].filter((x) => row[4 * x + 3]), width = seen.at(-1) + 1 - seen[0];
        return [1.25, 1.75, 2.25].map((u) => {
            const at = 4 * (seen[0] + Math.floor(width * u / 3));
            return row[at] > row[at + 2] ? "red" : "blue";
        }).join(" ");
    };
    assert.equal(hues(10497), "red blue red");
    assert.equal(hues(33071), "blue blue blue");
    assert.equal(hues(33648), "blue red red");
    const texture = { data, width: 2, height: 1, wrap: ["clamp"] };
    refused(/^texture.wrap must be two names/, { ...box(), uv: new Array(16).fill(0), texture });
    refused(/^texture.wrap must be one of repeat, clamp, mirror/,
            { ...box(), uv: new Array(16).fill(0), texture: { ...texture, wrap: ["clamp", "clip"] } });
});

test("alpha modes of a GLB", () => {
    const picture = () => ({ data: Uint8Array.of(0, 0, 255, 100), width: 1, height: 1 });
    const shown = (mode, more) => {
        const [mesh] = readGltf(glb((json) => {
            json.materials[0] = { alphaMode: mode, ...more, pbrMetallicRoughness: {
                baseColorTexture: { index: 0 }, metallicFactor: 0, baseColorFactor: [1, 1, 1, 0.5] } };
            json.textures = [{ source: 0 }];
            json.images = [{ uri: "data:image/png;base64,AAEC" }];
        }), { picture });
        return render(mesh, { ...front, depth: true });
    };
    const middle = 16 * 32 + 16, pixel = ({ data }) => [...data.subarray(4 * middle, 4 * middle + 4)];
    const [opaque, clear] = [shown("OPAQUE"), shown("BLEND")];
    assert.ok(pixel(opaque)[0] < 80 && pixel(clear)[0] > pixel(opaque)[0] + 60, `${pixel(clear)}`);
    assert.deepEqual([opaque.ids[middle], clear.ids[middle]], [0, -1]);
    assert.deepEqual(pixel(shown("MASK")), [255, 255, 255, 255]);    // 0.39 is below 0.5 / 0.5
    assert.ok(pixel(shown("MASK", { alphaCutoff: 0.1 }))[0] < 80);
});

test("meshes that blend", () => {
    const square = (z, more) => ({ positions: [0, 0, z, 1, 0, z, 1, 1, z, 0, 1, z], indices: [0, 1, 2, 0, 2, 3],
                                   ...more });
    const options = { view: "top", size: 32, depth: true, light: { ambient: [1, 1, 1] } };
    const middle = ({ data }) => [...data.subarray(4 * (16 * 32 + 16), 4 * (16 * 32 + 16) + 3)];
    const glass = square(1, { opacity: 0.5, color: "#f00" }), floor = square(0, { color: "#00f" });
    const [a, b] = [render([glass, floor], options), render([floor, glass], options)];
    assert.deepEqual(a.data, b.data);    // what blends is drawn last
    assert.ok(middle(a)[0] > 150 && middle(a)[2] > 150, `${middle(a)}`);
    assert.deepEqual([a.ids[16 * 32 + 16], b.ids[16 * 32 + 16]], [1, 0]);
    assert.deepEqual(middle(render([square(1, { opacity: 0.5, blend: false, color: "#f00" }), floor], options)),
                     middle(render(square(1, { color: "#f00" }), options)));
    for (const [field, value] of [["opacity", 2], ["opacity", NaN], ["opacity", "1"], ["blend", 1], ["cutoff", -1]]) {
        assert.throws(() => render(square(0, { [field]: value })), (error) =>
            error instanceof ShadeError && error.message.startsWith(field));
    }
});

test("damaged GLB files are refused with a sentence", () => {
    const bad = (words, change) => assert.throws(() => readGltf(glb(change)), (error) =>
        error instanceof ShadeError && words.test(error.message) || assert.fail(`${error}`));
    bad(/^model: there is no accessors\[9\]/, (json) => { json.meshes[0].primitives[0].indices = 9; });
    bad(/go in circles/, (json) => { json.nodes[1].children = [0]; });
    bad(/ends behind its buffer/, (json) => { json.bufferViews[0].byteLength = 1e6; });
    bad(/ends behind its view/, (json) => { json.accessors[0].count = 5; });
    bad(/more than 80000000|more than 81000000/, (json) => { json.accessors[0].count = 1e11; });
    bad(/has not a value for each vertex/, (json) => { json.accessors[0].count = 3; });
    bad(/needs KHR_draco/, (json) => { json.extensionsRequired = ["KHR_draco_mesh_compression"]; });
    bad(/glTF 1 is not read/, (json) => { delete json.asset; });
    bad(/scale must be 3 numbers/, (json) => { json.nodes[1].scale = [1, null, 1]; });
    bad(/does not lie beside the model/, (json) => { json.buffers[0].uri = "../../etc/passwd"; });
    for (const value of [undefined, null, "x.glb", [1, 2], new ArrayBuffer(8)]) {
        assert.throws(() => readGltf(value), /model: must be the bytes of a file/);
    }
});

test("mutants of a GLB are read or refused", () => {
    let state = 7, read = 0, refusals = 0;
    const next = (n) => { state = (Math.imul(state, 1664525) + 1013904223) >>> 0; return Math.floor(state / 2 ** 32 * n); };
    const { warn } = console, count = Number(process.env.MUTANTS ?? 20000), whole = glb();
    const words = ["-1", "1e99", "null", "[]", "{}", "true", '"x"', "0.5", "4294967296", "9"];
    console.warn = () => {};
    try {
        for (let i = 0; i < count; i++) {
            let bytes = whole.slice();
            if (next(2)) {    // a number of the JSON by another word, so that it stays JSON
                const from = new TextDecoder().decode(whole.subarray(20, 20 + new DataView(whole.buffer).getUint32(12, true)));
                const places = [...from.matchAll(/-?[0-9.]+(?=[,\]}])/g)], place = places[next(places.length)];
                const text = from.slice(0, place.index) + words[next(words.length)] + from.slice(place.index + place[0].length);
                try { bytes = glb((json) => { for (const key of Object.keys(json)) delete json[key]; Object.assign(json, JSON.parse(text)); }); } catch { continue; }
            } else {
                for (let k = 1 + next(4); k > 0; k--) bytes[next(bytes.length)] = next(256);
                if (!next(4)) bytes = bytes.subarray(0, next(bytes.length));
            }
            try {
                const meshes = readGltf(bytes);
                read++;
                if (i % 8 === 0) render(meshes, small);
            } catch (error) {
                if (!(error instanceof ShadeError)) assert.fail(`${error.stack}: ${Buffer.from(bytes).toString("hex")}`);
                refusals++;
            }
        }
    } finally {
        console.warn = warn;
    }
    assert.ok(read > count / 20 && refusals > count / 20, `${read} read, ${refusals} refused`);
});

function crc(bytes) {
    let sum = -1;
    for (const byte of bytes) {
        sum ^= byte;
        for (let k = 0; k < 8; k++) sum = (sum >>> 1) ^ (sum & 1 ? 0xEDB88320 : 0);
    }
    return ~sum >>> 0;
}

/** A ZIP archive; method 0 stores, 8 packs. */
function zip(files, method = 8) {
    const bodies = [], directory = [], uint = (size, ...values) => values.map((value) => {
        const out = Buffer.alloc(size);
        out.writeUIntLE(value, 0, size);
        return out;
    });
    let offset = 0;
    for (const [name, words] of Object.entries(files)) {
        const packed = method ? deflateRawSync(Buffer.from(words)) : Buffer.from(words), title = Buffer.from(name);
        const common = [...uint(2, 20, 0, method, 0, 0), ...uint(4, crc(Buffer.from(words)), packed.length, words.length),
                        ...uint(2, title.length, 0)];
        const local = Buffer.concat([...uint(4, 0x04034B50), ...common, title, packed]);
        directory.push(...uint(4, 0x02014B50), ...uint(2, 20), ...common, ...uint(2, 0, 0, 0), ...uint(4, 0, offset), title);
        bodies.push(local);
        offset += local.length;
    }
    const list = Buffer.concat(directory), count = Object.keys(files).length;
    return new Uint8Array(Buffer.concat([...bodies, list, ...uint(4, 0x06054B50), ...uint(2, 0, 0, count, count),
                                         ...uint(4, list.length, offset), ...uint(2, 0)]));
}

const MODEL = `<?xml version="1.0"?>
<model unit="millimeter" xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02"><resources>
<basematerials id="5"><base name="a" displaycolor="#FF8000"/></basematerials>
<object id="1" pid="5" pindex="0"><mesh><vertices><vertex x="0" y="0" z="0"/><vertex x="1" y="0" z="0"/>
<vertex x="0" y="2" z="0"/><vertex x="0" y="0" z="3"/></vertices><triangles><triangle v1="0" v2="2" v3="1"/>
<triangle v1="0" v2="1" v3="3"/><triangle v1="1" v2="2" v3="3"/></triangles></mesh></object>
<object id="2"><components><component objectid="1" transform="-1 0 0 0 1 0 0 0 1 10 0 0"/></components></object>
</resources><build><item objectid="1"/><item objectid="2"/></build></model>`;

test("a 3MF", async () => {
    const read = (change, method) => read3mf(zip({ "3D/3dmodel.model": change(MODEL) }, method));
    for (const method of [0, 8]) {
        const [{ positions, indices, colors }] = await read((words) => words, method);
        const corners = [0, 2, 1, 0, 1, 3, 1, 2, 3].map((i) => [[0, 0, 0], [1, 0, 0], [0, 2, 0], [0, 0, 3]][i]);
        const got = [...indices].map((i) => [...positions.slice(3 * i, 3 * i + 3)]);
        assert.deepEqual(got.slice(0, 9), corners);
        for (let i = 9; i < 18; i++) {    // mirrored
            const [x, y, z] = corners[3 * Math.floor(i / 3) - 9 + 2 - i % 3];
            assert.deepEqual(got[i], [10 - x, y, z]);
        }
        [1, 128 / 255, 0].forEach((x, k) => assert.ok(Math.abs(colors[k] - x) < 1e-6));
    }
    const bad = async (words, change, bytes) => assert.rejects(
        bytes ? read3mf(bytes) : read((all) => change(all)),
        (error) => error instanceof ShadeError && words.test(error.message) || assert.fail(`${error}`));
    await bad(/^model: there is no object 9 in /, (all) => all.replace('objectid="2"', 'objectid="9"'));
    await bad(/go in circles/, (all) => all.replace('component objectid="1"', 'component objectid="2"'));
    await bad(/vertex that is not there: there are 4/, (all) => all.replace('v2="2"', 'v2="4"'));
    await bad(/v2 of triangle is no whole number/, (all) => all.replace('v2="2"', 'v2="0.5"'));
    await bad(/x of vertex is no number/, (all) => all.replace('x="1"', 'x="one"'));
    await bad(/x of vertex is missing/, (all) => all.replace('x="1"', ""));
    await bad(/transform of component must be 12 numbers/, (all) => all.replace("10 0 0", "10 0"));
    await bad(/document types and entities are refused/, (all) => all.replace("<model", "<!DOCTYPE a><model"));
    await bad(/its XML is wrong/, (all) => all.replace("</build>", ""));
    await bad(/no faces in it/, (all) => all.replace(/<build>.*<.build>/, "<build/>").replaceAll(/<triangle [^>]*>/g, ""));
    await bad(/is no ZIP archive/, null, new TextEncoder().encode(MODEL));
    await bad(/there is no 3D\/3dmodel.model/, null, zip({ "a.txt": "a" }));
    await bad(/unpacks to more than/, null, zip({ "3D/3dmodel.model": " ".repeat(3e7) }));
    await bad(/3D.3dmodel.model: cannot be unpacked: it is damaged/, null,
              zip({ "3D/3dmodel.model": MODEL }, 8).map((x, i) => (i === 100 ? x ^ 8 : x)));
    await bad(/it needs http:..a.b, which is not read/, (all) => all.replace("<model", '<model xmlns:q="http://a/b" requiredextensions="q"'));
    await assert.rejects(read3mf("plate.3mf"), /must be the bytes of a file/);
    await assert.rejects(read3mf(zip({ a: "b" }), { picture: 1 }), /options.picture must be a function/);
});

test("a model of any format", async () => {
    const read = (text, options) => readModel(new TextEncoder().encode(text), options), said = [], { warn } = console;
    const bad = (words, ...given) => assert.rejects(read(...given), (error) =>
        error instanceof ShadeError && words.test(error.message) || assert.fail(`${error}`));
    const obj = "mtllib a.mtl\nusemtl m\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 1\nf 1/1 2/1 3/1\n";
    const files = { "a.mtl": "newmtl m\nKd 1 0.5 0\nmap_Kd a.png\n", "a.png": "as it is" };
    const beside = (name) => (files[name] ? new TextEncoder().encode(files[name]) : null);
    const data = new Uint8Array([1, 2, 3]), asked = [];
    const [mesh] = await read(obj, { beside, picture: (bytes) => { asked.push(...bytes); return { data, width: 1, height: 1 }; } });
    assert.deepEqual([...mesh.positions], [0, 0, 0, 1, 0, 0, 0, 1, 0]);
    assert.deepEqual([[...mesh.uv], [...mesh.texture.data]], [[0, 1, 0, 1, 0, 1], [1, 2, 3]]);
    assert.equal(new TextDecoder().decode(new Uint8Array(asked)), "as it is");
    [1, ((0.5 + 0.055) / 1.055) ** 2.4, 0].forEach((x, k) => assert.ok(Math.abs(mesh.material.diffuse[k] - x) < 1e-6));
    console.warn = (line) => said.push(line);
    try {
        assert.equal((await read(obj))[0].material, undefined);
        delete files["a.png"];
        await read(obj, { beside, picture: () => assert.fail("there is none") });
        await read(obj, { beside });
        await read("v 0 0 0\nv 1 0 0\nv 0 1 0\nl 1 2\nf 1 2 3\n");
        assert.equal((await read("v 0 0 0\nv 1 0 0\n"))[0].indices.length, 48);    // points are drawn as balls
        await read("v 0 0 0\nv 1 0 0\nv nan 0 0\nl 1 2\n", { format: "obj" });
    } finally { console.warn = warn; }
    const balls = "2 points have no faces: they are drawn as small balls of radius 0.03 or so";
    assert.deepEqual(said.map((line) => line.replace("shade-h: model: ", "")), [
        "a.mtl: the option beside has no such file (left out)",
        "a.png: the option beside has no such file; its faces are drawn without it",
        "it has pictures, which the option picture decodes; its faces are drawn without them",
        "its lines (left out)", balls,
        `its lines (left out); 1 points have coordinates that are no finite numbers (left out); ${balls}`]);
    await bad(/^model:1: expected OFF/, obj, { format: "off" });
    await bad(/^model:4: index "4" is out of range|^model:4: there is no v number 4/, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n");
    await bad(/^model:1: the file is empty/, "");
    await bad(/^options.format must be one of obj, stl/, obj, { format: "fbx" });
    await bad(/^options.beside must be a function/, obj, { beside: {} });
    await bad(/^options.outside is no option/, obj, { outside: true });
    const [plain] = await read(obj, { beside, color: "red", picture: () => assert.fail("no picture counts") });
    assert.deepEqual([plain.color, plain.material, plain.texture, plain.uv], ["red", undefined, undefined, undefined]);
    const [scan] = await read("v 0 0 0 1 0 0\nv 1 0 0 1 0 0\nv 0 1 0 1 0 0\nf 1 2 3\n", { color: [0, 1, 0] });
    assert.deepEqual([scan.colors, scan.color], [undefined, [0, 1, 0]]);
    await bad(/^options.color /, obj, { color: "no such colour" });
    await assert.rejects(readModel("a.obj"), /model: must be the bytes of a file/);
    await assert.rejects(read(obj, { beside: () => { throw new RangeError("mine"); } }), /RangeError: mine/);
    await read(obj, { beside, format: "obj", picture: () => null });
    // what stands for several names, or has the folders of another machine, may throw before its parts are asked for
    const held = { "b.mtl": "newmtl o\n", "a.mtl": "newmtl m\nmap_Kd sub\\a.png -bm 1\n", "sub/a.png": "is" }, shown = [];
    const strict = (name) => {
        if (!(name in held)) throw new RangeError(name);
        return new TextEncoder().encode(held[name]);
    };
    const picture = (bytes) => { shown.push(bytes.length); return { data, width: 1, height: 1 }; };
    for (const line of ["b.mtl a.mtl", "C:\\parts\\a.mtl", '"a.mtl"']) {
        await read(obj.replace("a.mtl", () => line), { beside: strict, picture });
    }
    assert.deepEqual(shown, [2, 2, 2]);
    await assert.rejects(read(obj.replace("a.mtl", "a.mtl c.mtl"), { beside: strict, picture }), /RangeError: c.mtl/);
});

test("mutants of a 3MF are read or refused", async () => {
    const { warn } = console, whole = [0, 8].map((method) => zip({ "3D/3dmodel.model": MODEL }, method));
    let state = 11, read = 0, refusals = 0;
    const next = (n) => { state = (Math.imul(state, 1664525) + 1013904223) >>> 0; return Math.floor(state / 2 ** 32 * n); };
    console.warn = () => {};
    try {
        for (let i = 0; i < Number(process.env.MUTANTS ?? 3000); i++) {
            const inner = next(4) > 0, bytes = inner ? new TextEncoder().encode(MODEL) : whole[next(2)].slice();
            for (let k = 1 + next(3); k > 0; k--) bytes[next(bytes.length)] = next(2) ? 48 + next(10) : next(256);
            try {
                render(await read3mf(inner ? zip({ "3D/3dmodel.model": bytes }, 8 * next(2)) : bytes), small);
                read++;
            } catch (error) {
                assert.ok(error instanceof ShadeError, `${i}: ${error.stack}`);
                refusals++;
            }
        }
    } finally { console.warn = warn; }
    assert.ok(read > 20 && refusals > 20, `${read} read, ${refusals} refused`);
});

test("a renderer that was freed draws nothing, and one that was not keeps little", () => {
    const camera = { view: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, -3, 1],
                     projection: [2, 0, 0, 0, 0, 2, 0, 0, 0, 0, -1.02, -1, 0, 0, -0.202, 0] };
    const drawn = () => {
        const made = new Renderer(240, 320);
        made.add("sphere", 0.5, { color: "red" });
        made.light([{ position: [0, 0, 1, 0] }], [0, 0, 0], 0);
        return { made, first: made.render(camera) };
    };
    const { made, first } = drawn();
    made.free();
    made.free();
    const lamp = { position: [0, 0, 1, 0] };
    for (const call of [() => made.render(camera), () => made.mesh(box()), () => made.checker(), () => made.add("sphere", 1),
                        () => made.pose(0, camera.view), () => made.poses([camera.view]), () => made.show(0),
                        () => made.light([lamp]), () => made.background("red"), () => made.sky(), () => made.clear(),
                        () => made.remove(0), () => made.change(0, { color: "red" })]) {
        assert.throws(call, (error) => error instanceof ShadeError && /was freed/.test(error.message));
    }
    drawn();
    const before = process.memoryUsage().rss, alive = [];
    for (let i = 0; i < 200; i++) {
        const next = drawn();
        assert.deepEqual(next.first.color, first.color);
        alive.push(next.made);    // 200 of 2 MB of shapes and 8 MB of buffers before
    }
    assert.ok(process.memoryUsage().rss - before < 150e6, `${process.memoryUsage().rss - before} bytes`);
});

test("colours, directions and poses out of range are refused", () => {
    refused(/^color must be from 0 to 1/, { ...box(), color: [255, 0, 0] });
    for (const z of [0, 1e-40, -1e-19]) {
        refused(/position must not be zero/, box(), { ...small, light: { lights: [{ position: [0, 0, z, 0] }] } });
    }
    const made = new Renderer(8, 8);
    made.add("sphere", 1);
    const row = [1, 0, 0, 1, 0, 1, 0, 2, 0, 0, 1, 3, 0, 0, 0, 1], mirror = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1];
    for (const wrong of [row, mirror]) {
        assert.throws(() => made.pose(0, wrong), /must be a rotation and a translation/);
        assert.throws(() => made.poses([wrong]), /must be a rotation and a translation/);
    }
    made.free();
});

test("a Renderer draws the colour and the texture of a Mesh", () => {
    const quad = { positions: [-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0], indices: [0, 1, 2, 0, 2, 3] };
    const camera = { view: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, -3, 1],
                     projection: [3, 0, 0, 0, 0, 3, 0, 0, 0, 0, -1.02, -1, 0, 0, -0.202, 0] };
    const pixel = (mesh, options) => {
        const made = new Renderer(8, 8, options);
        made.light([], [1, 1, 1]);
        made.add(made.mesh(new Mesh(mesh)));
        const { color } = made.render(camera);
        made.free();
        return Array.from(color.slice(3 * 36, 3 * 37));
    };
    for (const options of [{}, { srgb: false }]) {
        assert.deepEqual(pixel({ ...quad, color: "#ff8000" }, options), [255, 128, 0]);
        assert.deepEqual(pixel({ ...quad, uv: new Float32Array(8), texture: { data: [9, 200, 77], width: 1, height: 1 } }, options),
                         [9, 200, 77]);
        assert.deepEqual(pixel(quad, options), [255, 255, 255]);
    }
});

test("texels that are wanted as squares are", () => {
    const quad = { positions: [-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0], indices: [0, 1, 2, 0, 2, 3], uv: [0, 0, 1, 0, 1, 1, 0, 1] };
    const camera = { view: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, -3, 1],
                     projection: [2.8, 0, 0, 0, 0, 2.8, 0, 0, 0, 0, -1.02, -1, 0, 0, -0.202, 0] };
    const drawn = (times, squares) => {
        const data = Array.from({ length: 4 * times * times }, (_, i) =>
            ((i % (2 * times) < times) === (i < 2 * times * times) ? [250, 0, 0] : [0, 0, 250])).flat();
        const made = new Renderer(20, 20), texture = { data, width: 2 * times, height: 2 * times, wrap: ["clamp", "clamp"], squares };
        made.add(made.mesh(new Mesh({ ...quad, texture })));
        const picture = render({ ...quad, texture }, { view: camera, size: 20, samples: 1 }), { color } = made.render(camera);
        made.free();
        return [picture.data, color];
    };
    assert.deepEqual(drawn(1, true), drawn(50, true));
    drawn(1, false).forEach((smooth, i) => assert.notDeepEqual(smooth, drawn(1, true)[i]));
    refused(/^texture.squares must be true or false/, { ...quad, texture: { ...texel(1, 2, 3), squares: 1 } });
});

test("objects, shapes and textures of a Renderer come, change and go", () => {
    const camera = { view: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, -3, 1],
                     projection: [2, 0, 0, 0, 0, 2, 0, 0, 0, 0, -1.02, -1, 0, 0, -0.202, 0] };
    const picture = (shade, faces = 1) => ({ data: Array(16 * faces).fill(shade), width: 2, height: 2 * faces, faces });
    const texture = { data: [9, 200, 77], width: 1, height: 1 }, mapped = { ...box(), uv: new Float32Array(16), texture };
    const made = new Renderer(24, 32), other = new Renderer(8, 8);
    const own = made.texture(picture(50)), cube = made.texture(picture(90, 6)), shape = made.mesh(new Mesh(mapped));
    const one = made.add(shape, 0.5, { texture: own }), two = made.add("sphere", 1, { at: [1, 0, 0] });
    const ground = made.height_field(new Float32Array(9), 3, 3, [1, 1]);
    made.sky_texture(cube);
    const before = made.render(camera).color.slice();
    for (const [words, call] of [
        [/object 0 shows the shape/, () => made.remove(shape)], [/object 0 has texture/, () => made.remove_texture(own)],
        [/a shape has texture/, () => made.remove_texture(shape.textures[0])],
        [/the sky has texture/, () => made.remove_texture(cube)], [/no texture 99/, () => made.remove_texture(99)],
        [/no object 7/, () => made.remove(7)], [/no object 7/, () => made.change(7, { color: "red" })],
        [/no object 7/, () => made.poses([camera.view], [7])], [/colour/, () => made.change(one, { colour: "red" })],
        [/alpha must be/, () => made.change(one, { alpha: 2 })],
        [/size of a sphere must be positive/, () => made.change(two, { size: -1 })],
        [/no texture 99/, () => made.change(two, { texture: 99 })],
        [/shape must be of this renderer/, () => other.add(shape)],
        [/shape must be of this renderer/, () => other.remove(shape)],
        [/is no cube/, () => made.update_texture(own, picture(1, 6))],
        [/is cube/, () => made.update_texture(cube, picture(1))], [/data must hold/, () => made.update_texture(own, { ...picture(1), data: [1] })],
        [/pose must be a rotation/, () => made.add("sphere", 1, { pose: Array(16).fill(1) })],
        [/shadow must be/, () => made.light([{ position: [0, 0, 1, 0] }], [0, 0, 0], [0, 1])],
        [/heights must/, () => made.update(ground, [1])]]) {
        assert.throws(call, (error) => error instanceof ShadeError && words.test(error.message), `${words}`);
    }
    assert.deepEqual(made.render(camera).color, before);
    assert.deepEqual(made.objects, [0, 1]);

    // what is left equals what is made so from the beginning
    made.update_texture(own, picture(200));
    made.remove(two);
    made.change(one, { size: 0.6, color: "red", texture: undefined });
    made.update(shape, new Mesh({ ...mapped, texture: { ...texture, data: [250, 20, 90] } }));
    assert.equal(made.add("box", [0.2, 0.2, 0.2], { at: [-1, 0, 0], texture: own }).number, two + 1);    // no number is given twice
    const fresh = new Renderer(24, 32), map = fresh.texture(picture(200));
    fresh.sky_texture(fresh.texture(picture(90, 6)));
    fresh.add(fresh.mesh(new Mesh({ ...mapped, texture: { ...texture, data: [250, 20, 90] } })), 0.6, { color: "red" });
    fresh.add("box", [0.2, 0.2, 0.2], { at: [-1, 0, 0], texture: map });
    const after = made.render(camera);
    after.ids = after.ids.map((id, i) => (i % 2 === 0 && id === two + 1 ? two : id));
    assert.deepEqual(after, fresh.render(camera));

    const sizes = [];
    for (let i = 0; i < 300; i++) {
        made.clear();
        const big = made.texture({ data: new Uint8Array(4 * 256 * 256).fill(i), width: 256, height: 256 });
        made.add(made.mesh(new Mesh(mapped)), 0.5, { texture: big });
        made.render(camera);
        sizes.push(process.memoryUsage().rss);
    }
    assert.ok(sizes[299] - sizes[50] < 40e6, `${sizes[299] - sizes[50]} bytes`);
    [made, other, fresh].forEach((renderer) => renderer.free());
});

test("a batch is the pictures one by one", () => {
    const camera = (x) => ({ view: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, x, 0, -3, 1],
                             projection: [2, 0, 0, 0, 0, 2, 0, 0, 0, 0, -1.02, -1, 0, 0, -0.202, 0] });
    const made = new Renderer(6, 8), cameras = [0, 0.3, -0.5].map(camera), all = { normals: true, pictures: 3 };
    made.add("sphere", 0.5, { color: "red" });
    made.remove(made.add("sphere", 1));
    made.add("box", [0.2, 0.3, 0.4], { at: [0, 0.5, 0] });
    const at = (x, y) => [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, x, y, 0, 1];
    const poses = [0, 0.2, 0.6].map((x) => [at(x, 0), at(0, x)]), home = [at(0, 0), at(0, 0.5)];
    const same = (batch, pictures) => Object.entries(batch).forEach(([name, array]) => {
        const size = array.length / pictures.length;
        pictures.forEach((one, i) => assert.deepEqual(array.slice(i * size, (i + 1) * size), one[name]));
    });
    const one = (seen, options) => made.render(seen, made.frame({ normals: true }), options);
    same(made.render_batch(cameras, undefined, made.frame(all)), cameras.map((seen) => one(seen)));
    const options = { empty_depth: -1, solid: true }, out = made.frame(all);
    assert.equal(made.render_batch(cameras[1], poses, out, options), out);
    assert.deepEqual(made.render_batch(cameras[0], [home]), made.render(cameras[0]));
    same(out, poses.map((row) => (made.poses(row), one(cameras[1], options))));
    made.poses(home);
    assert.equal(made.render_batch([]).color.length, 0);
    const bent = [...poses[0].slice(0, 1), [...home[1].slice(0, 10), 2, ...home[1].slice(11)]];
    for (const [words, ...call] of [
        [/^cameras\[1\].projection must be an array/, [cameras[0], { view: home[0] }]],
        [/^cameras\[0\].view must be an array/, null], [/^poses must have a row for each of 3 cameras, not 2/, cameras, [home, home]],
        [/^poses\[0\] must hold 2 matrices/, cameras[0], [[home[0]]]],
        [/^poses\[1\]\[1\] must be a rotation/, cameras[0], [home, bent]],
        [/^out.color must hold 432 numbers, not 288/, cameras, undefined, made.frame({ pictures: 2 })],
        [/^options.near is no option/, cameras, undefined, undefined, { near: 1 }]]) {
        assert.throws(() => made.render_batch(...call), (error) => error instanceof ShadeError && words.test(error.message), `${words}`);
    }
    assert.deepEqual(made.render_batch(cameras[0], [home]), made.render(cameras[0]));
    made.free();
});

test("the highlight and the emission of an MTL are drawn", async () => {
    const line = (text) => new TextEncoder().encode(text);
    const beside = () => line("newmtl m\nKd 0.2 0.1 0\nKs 0.3 0.3 0.3\nNs 20\nKe 0 0 0.2\n");
    const [one] = await readModel(line("mtllib one.mtl\nv -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nusemtl m\nf 1 2 3 4\n"),
                                  { format: "obj", beside });
    // light, eye and normal are one line: k_e + k_d + k_s, of linear light, whatever the exponent
    const linear = (c) => ((c + 0.055) / 1.055) ** 2.4, sums = [[0.2, 0.3], [0.1, 0.3], [0.2, 0.3]];
    const wanted = sums.map(([a, b]) => Math.round(255 * (1.055 * (linear(a) + linear(b)) ** (1 / 2.4) - 0.055)));
    const camera = { view: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, -50, 1],
                     projection: [114, 0, 0, 0, 0, 114, 0, 0, 0, 0, -1.02, -1, 0, 0, -2.02, 0] };
    const lights = [{ position: [0, 0, 1, 0] }], made = new Renderer(9, 9);
    const { data } = render(one, { view: camera, size: 9, samples: 1, light: { lights } });
    made.add(made.mesh(new Mesh(one)));
    made.light(lights);
    const { color } = made.render(camera);
    [[data, 4], [color, 3]].forEach(([bytes, width]) => wanted.forEach((c, k) => {
        assert.ok(Math.abs(bytes[40 * width + k] - c) <= 1, `${bytes.slice(40 * width, 40 * width + 3)}`);
    }));
    made.free();
});

// ---- reliefs, what shines, metal and roughness

/** The values of a display's bytes in linear light, and back */
const toLinear = (x) => (x / 255 <= 0.04045 ? x / 255 / 12.92 : ((x / 255 + 0.055) / 1.055) ** 2.4);
const toByte = (x) => Math.round(255 * Math.min(1, x <= 0.0031308 ? 12.92 * x : 1.055 * x ** (1 / 2.4) - 0.055));
const texel = (...data) => ({ data, width: 1, height: 1 });

/** A square that looks along z and its picture, whose u grows along one way and v, upward, along another */
function square(right, up, more) {
    const positions = [-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0], uv = [];
    for (let i = 0; i < 12; i += 3) {
        for (const way of [right, up]) uv.push((1 + positions[i] * way[0] + positions[i + 1] * way[1]) / 2);
    }
    return { positions, indices: [0, 1, 2, 0, 2, 3], uv, ...more };
}

/** The same without a picture, but with one normal everywhere */
function tilted(normal, { uv, relief, strength, texture, ...rest }) {
    return { ...rest, normals: [...normal, ...normal, ...normal, ...normal] };
}

const lamp = { lights: [{ position: [0.6, 0.3, 0.9, 0] }], ambient: [0.1, 0.1, 0.1] }, dark = { lights: [] };

/** The number of bytes that differ by more than 1 */
const unlike = (a, b) => a.filter((x, i) => Math.abs(x - b[i]) > 1).length;

test("a normal map is lit as the normals that it holds", () => {
    const ways = [[[1, 0], [0, 1]], [[0, 1], [-1, 0]], [[-1, 0], [0, 1]], [[0, 1], [1, 0]], [[1, 0], [0, -1]]];
    const flat = render(square([1, 0], [0, 1], { texture: texel(255, 255, 255) }), { ...front, light: lamp }).data;
    for (const [right, up] of ways) {
        for (const bytes of [[191, 128, 238], [64, 128, 238], [128, 200, 230], [90, 60, 220], [128, 128, 255]]) {
            for (const strength of [1, 0.5, 2, undefined]) {
                const [x, y, z] = bytes.map((byte) => 2 * byte / 255 - 1), s = strength ?? 1;
                const normal = [0, 1].map((k) => s * (x * right[k] + y * up[k]));
                const own = { relief: texel(...bytes), color: "steel", ...(strength ? { strength } : {}) };
                const whole = square(right, up, own), other = tilted([...normal, z], whole);
                for (const light of [lamp, "quick", "studio"]) {
                    const options = { ...front, light, size: light === "studio" ? 9 : 32 };
                    const [got, wanted] = [whole, other].map((mesh) => render(mesh, options).data);
                    assert.equal(unlike(got, wanted), 0, `${bytes} ${right} ${up} ${strength} ${light}`);
                    if (light === lamp && bytes[0] !== 128) assert.ok(unlike(got, flat) > 500);
                }
            }
        }
    }
    // a place of its own turns it, and does not lean on how long u and v are
    const pose = [0, 0, -2, 0, 0, 3, 0, 0, 1, 0, 0, 0, 5, 6, 7, 1], view = "right";
    const whole = square([1, 0], [0, 1], { relief: texel(191, 128, 238), pose, color: "steel" });
    const normal = [191, 128, 238].map((byte) => 2 * byte / 255 - 1);
    const [got, wanted] = [whole, tilted(normal, whole)].map((mesh) => render(mesh, { ...front, view, up: "y" }).data);
    assert.equal(unlike(got, wanted), 0);
});

test("a bump map is lit by its slope", () => {
    const step = 20, width = 8, ramp = (along, across) => {
        const height = (i) => 40 + step * (i % 8) * along + step * Math.floor(i / 8) * across;
        const data = Array.from({ length: 64 }, (_, i) => height(i));
        return { data: data.flatMap((x) => [x, x, x]), width, height: 8, wrap: ["clamp", "clamp"] };
    };
    for (const [along, across] of [[1, 0], [0, 1]]) {    // brighter to the right, or downward
        for (const strength of [0.3, 1, -0.5]) {
            const whole = square([1, 0], [0, 1], { relief: ramp(along, across), strength, color: "steel" });
            const slope = strength * step / 255 * width / 2;    // the picture is 2 wide
            const [got, wanted] = [whole, tilted([-slope * along, slope * across, 1], whole)].map((mesh) =>
                render(mesh, { ...front, light: lamp }).data.subarray(4 * (16 * 32 + 16), 4 * (16 * 32 + 16) + 4));
            assert.equal(unlike(got, wanted), 0, `${got} ${wanted}`);
        }
    }
});

test("what shines by itself needs no light", () => {
    const centre = ({ data }) => [...data.subarray(4 * (16 * 32 + 16), 4 * (16 * 32 + 16) + 3)];
    const near = (got, wanted) => assert.ok(!unlike(got, wanted), `${got} and not ${wanted}`);
    const bytes = [200, 100, 30], options = { ...front, light: dark };
    for (const glowFactor of [undefined, [0.5, 1, 3], [0, 0.25, 1]]) {
        const own = { glow: texel(...bytes), ...(glowFactor ? { glowFactor } : {}) };
        const wanted = bytes.map((x, k) => toByte(toLinear(x) * (glowFactor ?? [1, 1, 1])[k]));
        near(centre(render(square([1, 0], [0, 1], own), options)), wanted);
        near(centre(render(square([1, 0], [0, 1], { ...own, texture: texel(0, 9, 255) }), options)), wanted);
    }
    const read = (material, images) => readGltf(glb((json) => {
        json.materials[0] = material;
        json.textures = images.map((_, source) => ({ source }));
        json.images = images.map((image) => ({ uri: `data:image/png;base64,${btoa(String.fromCharCode(...image))}` }));
    }), { picture: (image) => texel(...image) })[0];
    const pbrMetallicRoughness = { baseColorTexture: { index: 0 }, metallicFactor: 0 }, emissiveFactor = [0.5, 0.25, 0];
    near(centre(render(read({ pbrMetallicRoughness, emissiveFactor }, [[9, 200, 99]]), options)),
         emissiveFactor.map(toByte));
    const shining = { pbrMetallicRoughness, emissiveFactor, emissiveTexture: { index: 1 } };
    near(centre(render(read(shining, [[9, 200, 99], bytes]), options)),
         bytes.map((x, k) => toByte(toLinear(x) * emissiveFactor[k])));
});

test("reliefs, metal and roughness of a GLB", () => {
    const asked = [], texels = [[90, 200, 230], [255, 250, 245], [77, 100, 60]];
    const picture = ([number]) => { asked.push(number); return texel(...texels[number]); };
    const read = (material, others = []) => readGltf(glb((json) => {
        json.materials = [material, ...others];
        json.textures = texels.map((_, source) => ({ source }));
        json.images = ["AA==", "AQ==", "Ag=="].map((words) => ({ uri: `data:image/png;base64,${words}` }));
    }), { picture });
    const lit = { ...front, light: lamp }, factors = { metallicFactor: 0.8, roughnessFactor: 0.9 };

    // v of the file points down, and grows upward here: the picture stands on its head
    const plain = { baseColorFactor: [0.5, 0.5, 0.5, 1], ...factors };
    const [bent] = read({ pbrMetallicRoughness: plain, normalTexture: { index: 0, scale: 1.5 } });
    assert.deepEqual([bent.strength, bent.relief.data, bent.texture], [1.5, [90, 200, 230], undefined]);
    const [x, y, z] = [90, 200, 230].map((byte) => 2 * byte / 255 - 1);
    const wanted = render(tilted([1.5 * x, -1.5 * y, z], bent), lit).data;
    assert.equal(unlike(render(bent, lit).data, wanted), 0);

    // blue is metal and green roughness, as they are: 60 and 100 of 255
    for (const base of [{}, { baseColorTexture: { index: 1 } }]) {
        const own = { ...base, baseColorFactor: [1, 0.6, 0.3, 1] };
        const [by] = read({ pbrMetallicRoughness: { ...own, ...factors, metallicRoughnessTexture: { index: 2 } } });
        const means = { metallicFactor: 0.8 * 60 / 255, roughnessFactor: 0.9 * 100 / 255 };
        const [same] = read({ pbrMetallicRoughness: { ...own, ...means } });
        const [other] = read({ pbrMetallicRoughness: { ...own, ...factors } });
        for (const light of ["quick", "studio", lamp]) {
            const [a, b, c] = [by, same, other].map((mesh) => render(mesh, { ...front, light }).data);
            assert.deepEqual(a, b);
            assert.notDeepEqual(a, c);
        }
    }

    // a picture is decoded once, and not at all where no face shows it
    asked.length = 0;
    const [shown, hidden] = [0, 1].map((index) => ({ pbrMetallicRoughness: { baseColorTexture: { index } } }));
    read({ normalTexture: { index: 0 }, emissiveTexture: { index: 0 }, ...shown }, [hidden]);
    assert.deepEqual(asked, [0]);
});

test("pictures of an MTL", async () => {
    const line = (words) => new TextEncoder().encode(words), said = [], asked = [], { warn } = console;
    const obj = line("mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl m\nf 1/1 2/2 3/3\n");
    const read = async (statements, pixels) => {
        const files = { "a.mtl": `newmtl m\nKd 1 1 1\n${statements}` };
        for (const name of Object.keys(pixels)) files[name] = name;
        const beside = (name) => (files[name] ? line(files[name]) : null);
        const picture = (bytes) => {
            const name = new TextDecoder().decode(bytes), data = pixels[name];
            asked.push(name);
            return { data: [...data, ...data], width: data.length / 4, height: 2 };
        };
        return (await readModel(obj, { beside, picture }))[0];
    };
    const colors = [9, 8, 7, 255, 6, 5, 4, 255], ramp = [0, 0, 0, 255, 255, 255, 255, 255];
    const all = await read("map_Kd a.png\nmap_Ke a.png\nmap_Bump -bm 0.01 b.png\n", { "a.png": colors, "b.png": ramp });
    assert.deepEqual(asked, ["a.png", "b.png"]);
    const first = ({ data }) => [...data.slice(0, 8)];    // of two rows
    assert.deepEqual([all.texture, all.glow, all.relief].map(first), [colors, colors, ramp]);
    assert.deepEqual(all.glowFactor, [1, 1, 1]);
    assert.ok(Math.abs(all.strength - 0.01) < 1e-6);
    render(all, small);
    const bare = await read("norm b.png\n", { "b.png": [128, 128, 255, 255] });
    assert.deepEqual([bare.strength, bare.texture, bare.glow], [1, undefined, undefined]);
    console.warn = (words) => said.push(words);
    try { assert.equal((await read("map_Bump c.png\nmap_Ke c.png\n", {})).relief, undefined); }
    finally { console.warn = warn; }
    assert.equal(said.join(), "shade-h: model: c.png: the option beside has no such file; " +
                              "its faces are drawn without it");

    // alpha is holes where it is all or nothing, else it blends
    const alpha = async (a, b) => read("map_Kd a.png\nmap_d a.png\n", { "a.png": [9, 9, 9, a, 9, 9, 9, b] });
    const [holes, glass, solid] = [await alpha(0, 255), await alpha(100, 200), await alpha(255, 255)];
    assert.deepEqual([holes, glass, solid].map(({ cutoff, blend }) => [cutoff, blend]),
                     [[0.5, undefined], [undefined, true], [undefined, undefined]]);
    for (const image of [texel(1, 2), { data: [1, 2, 3] }, { data: "abc", width: 1, height: 1 }, 7]) {
        const beside = (name) => line(name === "a.mtl" ? "newmtl m\nmap_Kd a.png\n" : "a");
        await assert.rejects(readModel(obj, { beside, picture: () => image }), (error) =>
            error instanceof ShadeError && error.message.startsWith("picture."));
    }
});

test("reliefs and what shines that are wrong are refused", () => {
    const uv = new Float32Array(16), relief = texel(128, 128, 255);
    refused(/^uv and relief belong together/, { ...box(), relief });
    refused(/^uv and glow belong together/, { ...box(), glow: relief });
    refused(/^relief.width must be a whole number/, { ...box(), uv, relief: { data: [1, 2, 3] } });
    refused(/^glow.data must hold 3 or 4 bytes a pixel, not 2/, { ...box(), uv, glow: texel(1, 2) });
    refused(/^relief.wrap must be two names/, { ...box(), uv, relief: { ...relief, wrap: "clamp" } });
    refused(/^strength must be a number from/, { ...box(), uv, relief, strength: "1" });
    refused(/^strength must be a number from/, { ...box(), uv, relief, strength: Infinity });
    refused(/^glowFactor must hold 3 finite numbers/, { ...box(), uv, glow: relief, glowFactor: [1, 2] });
    // a picture folded into one point has no directions: its relief is flat
    const flat = { ...box(), uv, texture: texel(255, 255, 255) };
    assert.deepEqual(render({ ...flat, relief: texel(191, 128, 238) }, small).data, render(flat, small).data);
});

test("cameras of a Renderer draw what render draws of reliefs and glow", () => {
    const camera = { view: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, -3, 1],
                     projection: [2, 0, 0, 0, 0, 2, 0, 0, 0, 0, -1.02, -1, 0, 0, -0.202, 0] };
    const lights = [{ position: [0.4, 0.3, 1, 0] }], { positions, indices, uv } = square([1, 0], [0, 1]);
    const ramp = { data: Array.from({ length: 256 }, (_, i) => [i, i, i]).flat(), width: 256, height: 1, wrap: ["clamp", "clamp"] };
    const material = { diffuse: [0.5, 0.5, 0.5], specular: [0.3, 0.3, 0.3], shininess: 20 };
    const made = [{}, { relief: texel(191, 128, 238), strength: 2 }, { relief: ramp, strength: 0.3 },
                  { glow: texel(90, 60, 30), glowFactor: [1, 2, 0.5] }].map((maps) => {
        const mesh = new Mesh({ positions, indices, material, ...(Object.keys(maps).length ? { uv, ...maps } : {}) });
        const { data } = render(mesh, { view: camera, size: 16, samples: 1, light: { lights, ambient: [0.1, 0.1, 0.1] } });
        const one = new Renderer(16, 16);
        one.add(one.mesh(mesh));
        one.light(lights, [0.1, 0.1, 0.1]);
        const { color } = one.render(camera);
        one.free();
        color.forEach((x, i) => assert.ok(Math.abs(x - data[4 * Math.floor(i / 3) + i % 3]) <= 1, Object.keys(maps).join()));
        return color;
    });
    made.slice(1).forEach((color) => assert.notDeepEqual(color, made[0]));
});

test("holes of arrays, texels that are no bytes and poses by rows are refused", () => {
    const { positions, indices } = box(), holed = positions.slice(), rows = [1, 0, 0, 5, 0, 1, 0, 5, 0, 0, 1, 5, 0, 0, 0, 1];
    delete holed[3];
    refused(/^positions must hold numbers alone/, { positions: holed, indices });
    refused(/^pose must have 0, 0, 0, 1 in the last row/, { positions, indices, pose: rows });
    const uv = new Array(16).fill(0);
    for (const data of [new Float32Array(3).fill(0.5), [0, 0, 256], [0, NaN, 0]]) {
        refused(/^texture.data must hold bytes, 0 to 255/, { positions, indices, uv, texture: { data, width: 1, height: 1 } });
    }
    render({ positions, indices, uv, texture: { data: new Float32Array([0, 7, 255]), width: 1, height: 1 } }, small);
});

test("normals without a direction are made anew", () => {
    const made = { ...box(), normals: "smooth" }, smooth = render(made, small).data;
    const given = (value) => render({ ...box(), normals: new Array(24).fill(value) }, small).data;
    for (const value of [0, NaN, Infinity]) assert.deepEqual(given(value), smooth);
    assert.deepEqual(given(1e30), given(1e-30));
    assert.notDeepEqual(given(1e30), smooth);
});

test("what was taken in silence is refused by name, or told", (context) => {
    const said = context.mock.method(console, "warn", () => {}).mock;
    const lamp = { position: [0, 0, 1, 0] }, pose = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];
    const picture = (fill, more) => ({ data: Array(16).fill(fill), width: 2, height: 2, ...more });
    const made = new Renderer(8, 8), n = made.add("sphere", 1), seen = { view: pose, projection: [
        1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1.02, -1, 0, 0, -0.2, 0] };
    const lit = (more) => () => render(box(), { ...small, light: { lights: [{ ...lamp, ...more }] } });
    for (const [words, call] of [
        [/^light.lights\[0\].constant must be a number from 0/, lit({ constant: -1 })],
        [/^light.lights\[0\].spotExponent must be a number from 0/, lit({ spotExponent: -1 })],
        [/^light.lights\[0\].spotCosCutoff must be a number from -1 to 1, not 45/, lit({ spotCosCutoff: 45 })],
        [/^light.flags must be a number from 0 to 63/, () => render(box(), { ...small, light: { flags: 64 } })],
        [/^material.diffuse must hold 3/, () => render({ ...box(), material: { diffuse: [NaN, 0, 0] } }, small)],
        ...[300, -1, 0.5, NaN].map((fill) => [/^data must hold bytes/, () => made.texture(picture(fill))]),
        [/^picture.mipmaps is no option/, () => made.texture(picture(0, { mipmaps: 3 }))],
        [/^picture must be an object/, () => made.texture()], [/^picture must be an object/, () => made.texture(7)],
        [/^at does not go with pose/, () => made.add("sphere", 1, { at: [1, 0, 0], pose })],
        [/^two_sided must be true or false/, () => made.add("sphere", 1, { two_sided: 1 })],
        [/^casts_shadow must be true or false/, () => made.add("sphere", 1, { casts_shadow: null })],
        [/^size of a sphere is missing/, () => made.add("sphere")],
        [/^lights must be an array/, () => made.light()], [/^numbers must be an array/, () => made.poses([pose], 0)],
        [/^camera.view must be a rotation/, () => made.render({ ...seen, view: pose.map((x) => 2 * x) })],
        [/^cameras\[0\].view must be a rotation/, () => made.render_batch({ ...seen, view: Array(16).fill(0) })],
        [/^visible must be true or false/, () => made.show(n, 1)],
        [/^rows must be a whole number/, () => made.height_field([0, 0, 0], [1, 1])],
        [/^half must be positive/, () => made.height_field([0, 0, 0, 0], 2, 2, [1, 0])],
        [/^half must hold 2 finite/, () => made.height_field([0, 0, 0, 0], 2, 2, [1, NaN])],
        [/^wanted must be an object/, () => made.frame(0)], [/^color must be true or/, () => made.frame({ color: 0 })],
        [/^out.color must be Uint8Array/, () => made.render(seen, { color: new Float32Array(192) })],
        [/^out.depth must be Float32Array/, () => made.render(seen, { depth: new Int32Array(64) })],
        [/^out.colour is no option/, () => made.render(seen, { colour: new Uint8Array(192) })],
        [/^solid must be true or false/, () => made.render(seen, undefined, { solid: 1 })],
        [/^empty_depth must be a number/, () => made.render(seen, undefined, { empty_depth: "x" })]]) {
        assert.throws(call, (error) => error instanceof ShadeError && words.test(error.message) || assert.fail(`${error}`));
    }
    assert.equal(said.callCount(), 0);
    const positions = [0, 0, 0, 1, 0, 0, 0, 1, 0, NaN, 0, 1], indices = [0, 1, 2, 0, 1, 3];
    render({ positions, indices }, small);
    render({ ...box(), uv: Array(16).fill(Infinity), texture: picture(9) }, small);
    assert.deepEqual(said.calls.map((call) => call.arguments[0]), [
        "shade-h: positions: 1 triangles have corners that are no finite numbers (left out)",
        "shade-h: uv: 16 of its numbers are not finite: they count as 0"]);
});
