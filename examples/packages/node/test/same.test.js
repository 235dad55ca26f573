// The pictures have the bytes of the package for Python, which ORACLE holds: a folder that oracle.py
// has filled.
import assert from "node:assert/strict";
import { readFileSync, writeFileSync } from "node:fs";
import test from "node:test";
import { Mesh, read3mf, readGltf, readModel, render, Renderer } from "shade-h";
import { sight } from "./sight.js";

const folder = process.env.ORACLE;
const scenes = JSON.parse(readFileSync(`${folder}/scenes.json`, "utf8"));
const bytes = (array) => Buffer.from(array.buffer, array.byteOffset, array.byteLength);

function source({ vertices, faces, two_sided: twoSided = true, bytes: whole, colors, ...rest }) {
    const own = colors && { colors: whole ? Uint8Array.from(colors) : colors };
    return { positions: vertices, indices: faces, twoSided, ...own, ...rest };
}

for (const { name, meshes, options } of scenes) {
    test(name, () => {
        const made = meshes.map((mesh) => new Mesh(source(mesh)));
        for (const drawn of [made, meshes.map(source)]) {
            const got = render(drawn, { ...options, depth: true });
            for (const [part, array] of [["rgba", got.data], ["depth", got.depth], ["ids", got.ids]]) {
                const wanted = readFileSync(`${folder}/${name}.${part}`);
                assert.ok(wanted.equals(bytes(array)), `${part} of ${got.width} x ${got.height}`);
            }
        }
        assert.deepEqual(render(made, options).data, render(made, { ...options, depth: true }).data);
        made.forEach((mesh) => mesh.free());
    });
}

test("a Renderer", () => {
    const got = sight(Renderer, Mesh, JSON.parse(readFileSync(`${folder}/sight.json`, "utf8")));
    const wanted = readFileSync(`${folder}/sight.bytes`), at = got.findIndex((x, i) => x !== wanted[i]);
    assert.ok(wanted.equals(got), `byte ${at} of ${got.length}: 14400 of colour, 19200 of depth, 38400 of numbers`);
});

for (const name of ["model", "glass"]) {
    test(`a GLB: ${name}`, () => {
        const meshes = readGltf(readFileSync(`${folder}/${name}.glb`));
        assert.equal(meshes.length, 2);
        const { data } = render(meshes, { size: [200, 150], up: "y" });
        const soft = render(meshes, { size: [100, 75], up: "y", light: "studio" });
        assert.ok(readFileSync(`${folder}/${name}.rgba`).equals(Buffer.concat([bytes(data), bytes(soft.data)])));
    });
}

test("a 3MF", async () => {
    const [mesh] = await read3mf(readFileSync(`${folder}/model.3mf`));
    const { data } = render(mesh, { size: [200, 150] });
    assert.ok(readFileSync(`${folder}/plate.rgba`).equals(bytes(data)));
});

for (const format of ["obj", "off", "ply", "stl"]) {
    test(`a model: ${format}`, async () => {
        const beside = (name) => readFileSync(`${folder}/${name}`), file = readFileSync(`${folder}/file.${format}`);
        const wanted = readFileSync(`${folder}/file.${format}.rgba`);
        for (const options of [{ beside }, { beside, format }]) {
            const { data } = render(await readModel(file, options), { size: [200, 150], up: "z" });
            assert.ok(wanted.equals(bytes(data)));
        }
    });
}

test("any format", async () => {
    const drawn = (meshes) => render(meshes, { size: 64 }).data;
    for (const [name, other] of [["model.glb", readGltf], ["model.3mf", read3mf]]) {
        const file = readFileSync(`${folder}/${name}`);
        assert.deepEqual(drawn(await readModel(file)), drawn(await other(file)));
    }
});

test("PNG files for another reader", async () => {
    for (const { name, meshes, options } of scenes) {
        writeFileSync(`${folder}/${name}.png`, await render(meshes.map(source), options).png());
    }
});
