// The table of cases that C, Python and JavaScript run alike: examples/kit/test/cases.json, or CASES
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import test from "node:test";
import { inspect } from "node:util";
import { Camera, Mesh, Renderer, ShadeError, depthPng, idsPng, mujoco, readIdsPng } from "shade-h";

const table = process.env.CASES ?? new URL("../../../kit/test/cases.json", import.meta.url);
const { cases } = JSON.parse(readFileSync(table, "utf8"));

function near(got, want, tolerance) {
    const most = Math.max(...want.map(Math.abs));
    assert.equal(got.length, want.length);
    want.forEach((x, k) => assert.ok(Math.abs(got[k] - x) <= tolerance * most, `${got[k]} is not ${x}`));
}

function sameCamera({ view, projection }, want) {
    near(view.slice(0, 12), want.view.slice(0, 12), 1e-9);
    near(view.slice(12), want.view.slice(12), 1e-9);
    near(projection, want.projection, 1e-6);
}

/** A mesh whose faces are all of a colour, in light that shows it as it is: the middle of its picture */
const square = { positions: [-1, 0, -1, 1, 0, -1, 1, 0, 1, -1, 0, 1], indices: [0, 1, 2, 0, 2, 3] };
const columns = (m) => m.map((_, k) => m[4 * (k % 4) + Math.floor(k / 4)]);

/** Whether ids have so many pixels of each object: round shapes lie within a quarter of a pixel of the true ones,
 *  along 3.545 roots of the area. */
function counted(ids, want) {
    want.forEach((count, i) => {
        let seen = 0;
        for (let k = 0; k < ids.length; k += 2) seen += ids[k] === i;
        assert.ok(Math.abs(seen - count) <= 3 + 0.886 * Math.sqrt(count), `${seen} ${count}`);
    });
}

const GEOM = { type: 2, dataid: -1, texid: -1, texuniform: 0, segid: 0, objtype: 5, specular: 0, shininess: 0, emission: 0,
               mat: [1, 0, 0, 0, 1, 0, 0, 0, 1], rgba: [1, 1, 1, 1], texrepeat: [1, 1] };
const LAMP = "type headlight castshadow cutoff exponent pos dir ambient diffuse specular attenuation".split(" ");
const EYE = [..."near far top bottom center width".split(" ").map((name) => `frustum_${name}`), "orthographic", "pos", "forward", "up"];

/** An object of single numbers, then of arrays of three */
function spelled(names, row) {
    const single = names.length - (row.length - names.length) / 2;
    return Object.fromEntries(names.map((name, i) => [name, i < single ? row[i] : row.slice(3 * i - 2 * single, 3 * i - 2 * single + 3)]));
}

const run = {
    color({ word, want }) {
        const r = new Renderer(1, 1, { srgb: false });
        r.background(word);
        const { color } = r.render(Camera.lookAt([0, -1, 0], [0, 0, 0], { aspect: 1 }));
        assert.deepEqual([...color], want.map((x) => Math.round(255 * x)));
    },
    colors({ rows, whole, want }) {
        const flat = rows.flat(), Kind = whole ? Int32Array : Float64Array, colors = Kind.from(flat);
        const view = Camera.lookAt([0, -5, 0], [0, 0, 0], { aspect: 1 });
        rows.forEach((_, i) => {    // all vertices in the colour of a row, which ambient light shows
            const r = new Renderer(1, 1), one = Float64Array.from({ length: 12 }, (_, k) => flat[3 * i + k % 3]);
            const scale = whole && flat.some((x) => x > 1) ? (flat.every((x) => x < 256) ? Uint8Array : Uint16Array) : Kind;
            r.light([], [1, 1, 1]);
            r.add(r.mesh({ ...square, colors: i || rows.length === 1 ? scale.from(one) : colors.length === 12 ? colors : scale.from(one) }), 1, { two_sided: true });
            const encode = (x) => (x <= 0.0031308 ? 12.92 * x : 1.055 * x ** (1 / 2.4) - 0.055);
            const { color } = r.render(view);
            want[i].forEach((x, k) => assert.ok(Math.abs(color[k] - 255 * encode(x)) <= 0.51, `${color[k]} ${x}`));
        });
    },
    look_at({ eye, target, want, ...options }) {
        const { up, fov, aspect, near: close, far } = options;
        sameCamera(Camera.lookAt(eye, target, { up, fov, aspect, near: close, far }), want);
    },
    opencv({ K, extrinsics, size, near: close, far, want }) {
        sameCamera(Camera.opencv(K, extrinsics, size, { near: close, far }), want);
    },
    opengl({ projection, pose, want }) { sameCamera(Camera.opengl(projection, columns(pose)), want); },
    fit({ points, view, size, ortho, fov, margin, want }) {
        sameCamera(Camera.fitted(points.flat(), { view, size, ortho, fov, margin }), want);
    },
    pose({ matrix, want }) {
        const r = new Renderer(8, 8), ball = r.add("sphere", 1, { pose: columns(matrix) });
        near(ball.pose.slice(12, 15), want, 0);
    },
    handles({ steps }) {
        const r = new Renderer(8, 8), still = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1], made = [];
        for (const [step, given, place] of steps) {
            if (step === "add") {
                made.push(r.add("sphere", 1));
                assert.equal(made.at(-1).number, given);
                assert.equal(inspect(made.at(-1)), `Solid ${given}`);
                assert.ok(made.at(-1) == given && made.at(-1) - given === 0 && `${made.at(-1)}` === `${given}`);
            } else if (step === "remove") {
                if (given % 2) made[given].remove();
                else r.remove(given);
            } else if (step === "move") made[given].pose = place;
            else if (step === "at") near(r.object(given).pose.slice(12, 15), place, 0);
            else if (step === "clear") r.clear();
            else if (step === "pose") r.pose(given, still);
            else if (step === "objects") assert.deepEqual(r.objects, given);
            else {
                const gone = new RegExp(`there is no object ${given}$`);
                const old = made[given] ?? { remove: () => r.remove(given), set pose(m) { r.pose(given, m); } };
                for (const call of [() => r.pose(given, still), () => r.remove(given), () => r.object(given), () => old.remove(),
                                    () => { old.pose = still; }]) assert.throws(call, gone);
            }
        }
    },
    scene({ balls, eye, target, fov, size, far, want }) {
        const r = new Renderer(size, size), moved = (p) => p.map((x, k) => x + far[k]);
        balls.forEach((ball) => r.add("sphere", ball[3], { at: moved(ball.slice(0, 3)) }));
        counted(r.render(Camera.lookAt(moved(eye), moved(target), { fov, aspect: 1 })).ids, want);
    },
    mjv({ balls, cameras, lights, size, want }) {
        const made = new mujoco.Renderer(null, {}, size, size);
        const geoms = balls.map((ball, i) => ({ ...GEOM, objid: 7 + i, pos: ball.slice(0, 3), size: Array(3).fill(ball[3]) }));
        made.take({ geoms, lights: lights.map((row) => spelled(LAMP, row)), cameras: cameras.map((row) => spelled(EYE, row)),
                    flags: Array(10).fill(1) });
        made.enable_segmentation_rendering();
        const pairs = made.render();
        counted(pairs.map((x, k) => (k % 2 ? x : x - 7)), want);
        assert.ok(pairs.every((x, k) => k % 2 === 0 || x === (pairs[k - 1] < 0 ? -1 : 5)));
    },
    ground({ heights, half, at: [x, y], want }) {
        const r = new Renderer(9, 9), shape = r.height_field(heights.flat(), heights.length, heights[0].length, half);
        assert.equal(shape.triangles, 2 * (heights.length - 1) * (heights[0].length - 1));
        r.add(shape);
        near([r.render(Camera.lookAt([x, y, 10], [x, y, 0], { up: [0, 1, 0], aspect: 1 })).depth[40]], [want], 1e-5);
    },
    local({ points, faces, origin, want }) {
        const made = new Mesh({ positions: points.flat(), indices: faces.flat() });
        near(made.origin, origin, 0);
        near(made.positions, want.flat(), 1e-7);
    },
    faces({ rows, vertices, want }) {
        const mesh = new Mesh({ positions: Array.from({ length: 3 * vertices }, (_, k) => k * k % 7), faces: rows });
        assert.deepEqual([...mesh.indices], want);
    },
};

run.depth = async ({ depth, unit, want }) => {
    const { ids } = await readIdsPng(await depthPng(depth, depth.length, 1, unit));
    assert.deepEqual(Array.from(ids, (x) => x + 1), want);
};
run.ids = async ({ ids, want }) => {
    const got = await readIdsPng(await idsPng(Int32Array.from(ids), ids.length, 1));
    assert.deepEqual(Array.from(got.ids, (x) => x + 1), want);
};

test("the table is whole", () => assert.ok(cases.length >= 400));
cases.forEach((one, i) => test(`case ${i}, ${one.call}`, () => {
    assert.ok(run[one.call], `no such call: ${one.call}`);
    if (!one.refused) return run[one.call](one);
    const [argument, words] = one.refused;
    return assert.rejects(async () => run[one.call](one), (error) => {
        assert.ok(error instanceof ShadeError, `${error}`);
        assert.ok(error.message.startsWith(`${argument} ${words}`), error.message);
        return true;
    });
}));
