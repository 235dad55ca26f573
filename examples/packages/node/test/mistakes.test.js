// 5,000 random mistakes in arguments, of the table that the package for Python plays too: each call is answered, or
// refused with a ShadeError that names the argument.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import test from "node:test";
import { Camera, Mesh, Renderer, ShadeError, render } from "shade-h";

const table = JSON.parse(readFileSync(process.env.MISTAKES, "utf8"));
const vertices = Float64Array.of(0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1);
const faces = Uint32Array.of(0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3);
const identity = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];
const picture = { data: new Uint8Array(16), width: 2, height: 2 };

function scene() {
    const made = new Renderer(8, 8), shape = made.mesh({ positions: vertices, indices: faces, normals: "flat" });
    return { made, shape, ball: made.add(shape), texture: made.texture(picture) };
}
const { made, shape, ball, texture } = scene(), other = scene();
const eye = Camera.lookAt([3, -3, 2], undefined, { aspect: 1 }), mesh = new Mesh({ positions: vertices, indices: faces });
const named = {
    "@nan": NaN, "@infinity": Infinity, "@-0": -0, "@nans": [NaN, NaN, NaN], "@infinities": Array(16).fill(Infinity),
    "@identity": identity, "@mirror": identity.map((x) => -x), "@bytes": Uint8Array.of(255, 0, 0), "@lambda": () => 1,
    "@shape": shape, "@ball": ball, "@balls": [ball], "@texture": texture, "@eye": eye, "@eyes": [eye], "@vertices": vertices,
    "@faces": faces, "@greys": Float32Array.from(vertices, () => 0.5), "@heights": [0, 0, 0, 0], "@picture": picture,
    "@poses": [identity], "@lamps": [{ position: [0, 0, 1, 0] }], "@K": [1, 0, 0, 0, 1, 0, 0, 0, 1],
    "@projection": eye.projection, "@MESH": mesh,
};
const valued = (value) => (typeof value === "string" && value in named ? named[value] : value);
// What JSON has no word for
const WRONG = [...table.wrong.map(valued), undefined, 1n, Symbol("x"), new BigInt64Array(3), new DataView(new ArrayBuffer(8)),
               new Date(0), /x/, new Map(), new Set([1]), [, 1, 2], [undefined, 1, 2], Object.create(null), [1n, 2n, 3n],
               new Float64Array(16), new Proxy({}, {}), { length: 3 }, { valueOf: () => 1 }, new Number(1), other.shape,
               other.made.object(other.ball), other.made, mesh, picture, Promise.resolve(1), class {}];
// Table's names, as they are here
const HERE = { vertices: "positions|source|indices", numbers: "numbers|poses", lights: "lights|shadow", faces: "indices", points: "positions", MESH: "mesh|positions", number: "number|texture|object|pose",
               half: "half", texture: "texture|number", heights: "heights|rows|columns", picture: "picture|data|width|height|wrap|squares|faces" };
const CALLS = {
    Renderer: ({ height, width, ...options }) => new Renderer(height, width, options).free(),
    mesh: ({ vertices: positions, faces: indices, ...rest }) => made.remove(made.mesh({ positions, indices, ...rest })),
    height_field: ({ heights, half }) => made.remove(made.height_field(heights, 2, 2, half)),
    texture: ({ picture: one, ...rest }) => made.remove_texture(made.texture(one === picture ? { ...one, ...rest } : one)),
    update_texture: (got) => made.update_texture(got.number, got.picture),
    checker: (got) => made.remove_texture(made.checker(got.one, got.other)),
    add: ({ shape: of, size, ...options }) => made.remove(made.add(of, size, options)),
    change: ({ number, ...options }) => made.change(number, options),
    pose: (got) => made.pose(got.number, got.pose),
    poses: (got) => made.poses(got.poses, got.numbers),
    show: (got) => made.show(got.number, got.visible),
    remove: (got) => got.what === ball || got.what === +ball || got.what === shape || made.remove(got.what),
    remove_texture: (got) => got.number === texture || made.remove_texture(got.number),
    light: (got) => made.light(got.lights, got.ambient, got.shadow),
    background: (got) => made.background(got.color),
    sky: (got) => made.sky(got.low, got.high),
    sky_texture: (got) => made.sky_texture(got.texture),
    frame: (got) => made.frame(got),
    render: ({ camera, out, ...options }) => made.render(camera, out ?? undefined, options),
    render_batch: ({ cameras, out, ...options }) => made.render_batch(cameras, undefined, out ?? undefined, options),
    update: ({ shape: of, vertices: positions, normals }) => made.update(of, positions, { normals }),
    "Camera.look_at": ({ eye: at, target, ...options }) => Camera.lookAt(at, target, options),
    "Camera.opencv": ({ K, extrinsics, size, ...options }) => Camera.opencv(K, extrinsics, size, options),
    "Camera.opengl": (got) => Camera.opengl(got.projection, got.pose),
    fitted: ({ points, ...options }) => Camera.fitted(points, options),
    Mesh: ({ vertices: positions, faces: indices, ...rest }) => new Mesh({ positions, indices, ...rest }).free(),
    draw: ({ MESH, ...options }) => render(MESH, options),
};

test("each call of the table is known, and right as it stands", () => {
    for (const [call, given] of table.calls) {
        if (call !== "sky_texture") CALLS[call](Object.fromEntries(Object.entries(given).map(([k, v]) => [k, valued(v)])));
    }
});

test("5,000 mistakes are named", (context) => {
    context.mock.method(console, "warn", () => {});
    let state = 7;
    const next = (n) => (state = (Math.imul(state, 1664525) + 1013904223) >>> 0, Math.floor(state / 2 ** 32 * n));
    const bad = new Map(), refused = new Set();
    for (let i = 0; i < 5000; i++) {
        const [call, good] = table.calls[next(table.calls.length)], names = Object.keys(good), name = names[next(names.length)];
        const given = Object.fromEntries(Object.entries(good).map(([k, v]) => [k, valued(v)]));
        given[name] = WRONG[next(WRONG.length)];
        try {
            CALLS[call](given);
        } catch (error) {
            refused.add(call);
            const here = new RegExp(`\\b(${HERE[name] ?? name})\\b`);
            if (error instanceof ShadeError && here.test(error.message)) continue;
            if (error instanceof RangeError && /^memory/.test(error.message)) continue;
            bad.set(`${call} ${name}: ${error.stack.split("\n").slice(0, 3).join(" |")}`, i);
        }
    }
    assert.equal(bad.size, 0, [...bad.keys()].join("\n"));
    assert.ok(refused.size >= 27, `${refused.size} calls refused something`);
});
