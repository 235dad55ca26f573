// Looks by the names of other programs, and what MTL says of highlights
import assert from "node:assert/strict";
import test from "node:test";
import { elsewhere, PROGRAMS, readModel, render } from "shade-h";

const mesh = { positions: [0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1], indices: [0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3] };
const size = [40, 40];

test("a look is a material of a program's own numbers", () => {
    const look = elsewhere.vtk({ color: [1, 0.5, 0.2], diffuse: 0.6, specular: 0, power: 1 });
    assert.equal(look, "vtk(color=1,0.5,0.2 diffuse=0.6 specular=0 power=1)");
    const plain = { ambient: [0, 0, 0], diffuse: [0.6, 0.3, 0.12] };
    assert.deepEqual(render(mesh, { size, look }).data, render({ ...mesh, material: plain }, { size }).data);
    assert.notDeepEqual(render(mesh, { size, look: elsewhere.vtk({ specular: 0.8 }) }).data,
                        render(mesh, { size, look }).data);
    assert.match(PROGRAMS.vtk, /power=1/);
});

test("what is wrong is refused by name", () => {
    assert.throws(() => render(mesh, { look: "vtk(x=1)" }), /vtk has no number x/);
    assert.throws(() => render(mesh, { look: "nope" }), /no program is named nope/);
    assert.throws(() => render(mesh, { look: 3 }), /look must be text/);
    assert.throws(() => elsewhere.vtk({ power: "a" }), /power must be a number/);
    assert.throws(() => elsewhere.vtk({ strength: 1 }), /vtk has no number strength/);
    assert.throws(() => elsewhere.three_toon(), /not iteration four/);
});

test("MTL: illum 1 has no highlight, Pr is the nearest Phong", async () => {
    const text = (surface) => new TextEncoder().encode(surface);
    const obj = text("mtllib a.mtl\nusemtl m\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
    const drawn = async (surface) => {
        const beside = () => text(`newmtl m\nKd .6 .3 .1\n${surface}`);
        return render(await readModel(obj, { format: "obj", beside }), { size }).data;
    };
    const dull = await drawn("Ks 0 0 0\nNs 30\n"), glossy = await drawn("Ks .8 .8 .8\nNs 30\nillum 2\n");
    assert.notDeepEqual(dull, glossy);
    assert.deepEqual(await drawn("illum 1\nKs .8 .8 .8\nNs 30\n"), dull);
    assert.notDeepEqual(await drawn("Pr .3\n"), await drawn("Pr .9\n"));
});
