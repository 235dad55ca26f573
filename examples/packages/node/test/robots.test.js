// MuJoCo's own engine, from MUJOCO (a path of its mujoco.js): what it steps is drawn by the Renderer that
// has its names.  RECORDING is python/test/robots.json, which holds one state and the hashes of
// its pictures; with UPDATE=1 it is written.
import assert from "node:assert/strict";
import { createHash } from "node:crypto";
import { readFileSync, writeFileSync } from "node:fs";
import test from "node:test";
import { mujoco, ShadeError } from "shade-h";
import { drives, recorded, robots } from "./robots.js";

const mj = await (await import(process.env.MUJOCO)).default();
const model_of = (xml) => mj.MjModel.from_xml_string?.(xml) ?? mj.from_xml_string(xml);
const hash = (array) => createHash("sha256").update(new Uint8Array(array.buffer, array.byteOffset, array.byteLength)).digest("hex");
const GEOM = 5;

for (const [name, xml] of Object.entries(robots)) {
    test(`${name}: 24 frames`, () => {
        const model = model_of(xml), data = new mj.MjData(model), renderer = new mujoco.Renderer(mj, model, 90, 120);
        const seen = new Set(), pictures = new Set();
        for (let frame = 0; frame < 24; frame++) {
            if (drives[name]) data.ctrl.set(drives[name](frame));
            for (let k = 0; k < 20; k++) mj.mj_step(model, data);
            renderer.update_scene(data, "eye");
            renderer.disable_segmentation_rendering();
            pictures.add(hash(renderer.render()));
            renderer.enable_depth_rendering();
            const depth = renderer.render();
            renderer.enable_segmentation_rendering();
            const pairs = renderer.render();
            const far = depth.reduce((a, b) => Math.max(a, b), 0);
            depth.forEach((d, i) => {
                assert.ok(pairs[2 * i] >= 0 ? pairs[2 * i + 1] === GEOM : pairs[2 * i + 1] === -1);
                assert.ok(d > 0 && (pairs[2 * i] >= 0 || d === far));
                seen.add(pairs[2 * i]);
            });
        }
        assert.ok(pictures.size >= 8, `${pictures.size} pictures differ`);
        assert.ok(seen.size >= Math.min(4, model.ngeom), `${seen.size} geoms of ${model.ngeom} are seen`);
        renderer.close();
        [data, model].forEach((one) => one.delete());
    });
}

test("a sphere has the depth of MuJoCo's units and the number of its geom", () => {
    const model = model_of(`<mujoco><worldbody><camera name="eye" pos="0 0 3"/><geom type="sphere" size=".5"/></worldbody></mujoco>`);
    const data = new mj.MjData(model), renderer = new mujoco.Renderer(mj, model, 65, 65);
    mj.mj_forward(model, data);
    renderer.update_scene(data, 0);
    renderer.enable_depth_rendering();
    const depth = renderer.render();
    assert.ok(Math.abs(depth[32 * 65 + 32] - 2.5) < 0.01, `${depth[32 * 65 + 32]}`);
    const extent = model.stat.extent, far = model.vis.map.zfar * extent;
    assert.ok(Math.abs(depth[0] / far - 1) < 1e-5);
    renderer.enable_segmentation_rendering();
    assert.deepEqual([...renderer.render().subarray(2 * (32 * 65 + 32), 2 * (32 * 65 + 32) + 2)], [0, GEOM]);
    assert.throws(() => renderer.update_scene(data, "nobody"), ShadeError);
    assert.throws(() => renderer.update_scene(data, 7), /camera 7/);
    assert.throws(() => renderer.render(new Uint8Array(5)), /out must be/);
    renderer.close();
});

test("flags of the scene count that are set before render", () => {
    const model = model_of(`<mujoco><worldbody><light pos="0 0 3" dir="1 0 -1" directional="true"/><camera name="eye" pos="0 0 3"/>
        <geom type="plane" size="2 2 .1"/><geom type="sphere" pos="0 0 .6" size=".3"/></worldbody></mujoco>`);
    const data = new mj.MjData(model), renderer = new mujoco.Renderer(mj, model, 60, 80);
    mj.mj_forward(model, data);
    renderer.update_scene(data, "eye");
    const shadows = renderer.render();
    renderer.scene.flags[0] = 0;    // mjRND_SHADOW
    const bright = renderer.render();
    assert.ok(bright.every((x, i) => x >= shadows[i]) && bright.some((x, i) => x > shadows[i] + 20));
    renderer.close();
});

const FIELDS = ["tex_type", "tex_width", "tex_height", "tex_nchannel", "tex_adr", "tex_data", "mesh_vertadr", "mesh_vertnum",
    "mesh_vert", "mesh_normaladr", "mesh_normalnum", "mesh_normal", "mesh_faceadr", "mesh_facenum", "mesh_face", "mesh_facenormal",
    "mesh_texcoordadr", "mesh_texcoordnum", "mesh_texcoord", "mesh_facetexcoord", "hfield_nrow", "hfield_ncol", "hfield_size",
    "hfield_adr", "hfield_data"];

test("the recorded state has the recorded pictures", () => {
    const model = model_of(recorded), data = new mj.MjData(model), renderer = new mujoco.Renderer(mj, model, 60, 80);
    for (let k = 0; k < 60; k++) mj.mj_step(model, data);
    let scene;
    const take = renderer.take.bind(renderer);
    renderer.take = (taken) => { scene = taken; };
    renderer.update_scene(data, "eye");
    assert.ok(renderer.render().every((x) => x === 0), "black before a scene is taken, as in MuJoCo");
    const kept = process.env.UPDATE ? null : JSON.parse(readFileSync(process.env.RECORDING, "utf8"));
    delete renderer.take;
    take(kept?.scene ?? scene);
    const hashes = { color: hash(renderer.render()) };
    renderer.enable_depth_rendering();
    hashes.depth = hash(renderer.render());
    renderer.enable_segmentation_rendering();
    hashes.segmentation = hash(renderer.render());
    if (!kept) {
        const fields = Object.fromEntries(FIELDS.map((name) => [name, Array.from(model[name])]));
        writeFileSync(process.env.RECORDING, `${JSON.stringify({ model: fields, scene, hashes })}\n`);
    } else assert.deepEqual(hashes, kept.hashes);
    renderer.close();
    assert.throws(() => renderer.render(), /after close/);
    assert.throws(() => renderer.update_scene(data), /after close/);
});
