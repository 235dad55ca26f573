// A Renderer whose objects, shapes and textures come, change and go; and meshes that nobody frees.
import assert from "node:assert/strict";
import test from "node:test";
import { Camera, Mesh, Renderer, ShadeError, render } from "shade-h";

const EYE = Camera.lookAt([3, -3, 2], undefined, { aspect: 4 / 3, near: 0.1 });
const SIZES = { box: [0.2, 0.3, 0.1], capsule: [0.1, 0.3], cylinder: [0.2, 0.2], ellipsoid: [0.3, 0.2, 0.1], sphere: 0.3 };

/** Numbers from 0 to 1, and whole ones below n */
function dice(seed) {
    let state = seed >>> 0;
    const random = () => (state = (Math.imul(state, 1664525) + 1013904223) >>> 0, (state >>> 3) / 2 ** 29);
    return { random, below: (n) => Math.floor(random() * n), one: (all) => all[Math.floor(random() * all.length)] };
}

function lit(made) {
    made.light([{ position: [0.5, -0.8, 1.2, 0], color: [0.5, 0.5, 0.5] },
                { position: [2, -2, 4, 1], color: [0.4, 0.2, 0.2], spotDirection: [-0.4, 0.4, -1], spotCosCutoff: 0.8, spotExponent: 1 }],
               [0.3, 0.3, 0.3], [0, 1]);
    return made;
}

/** A rotation about an axis, and a place, by columns */
function turned({ random }) {
    const a = [0, 1, 2].map(() => random() - 0.5), length = Math.hypot(...a) + 1e-9, [x, y, z] = a.map((v) => v / length);
    const angle = 6 * random(), c = Math.cos(angle), s = Math.sin(angle), t = 1 - c;
    return [t * x * x + c, t * x * y + s * z, t * x * z - s * y, 0, t * x * y - s * z, t * y * y + c, t * y * z + s * x, 0,
            t * x * z + s * y, t * y * z - s * x, t * z * z + c, 0, random() - 0.5, random() - 0.5, random(), 1];
}

/** A pyramid; the number of its vertices changes. */
function pyramid({ random, below, one }) {
    const n = 3 + below(4), positions = [], indices = [], uv = Array.from({ length: 2 * n + 2 }, random);
    for (let i = 0; i < n; i++) {
        positions.push(Math.cos(i * 2 * Math.PI / n), Math.sin(i * 2 * Math.PI / n), 0);
        indices.push(i, (i + 1) % n, n);
        if (i && i < n - 1) indices.push(0, i + 1, i);
    }
    return { positions: [...positions, 0, 0, 0.5 + random()], indices, uv, normals: one(["auto", "flat", "smooth"]) };
}

const texels = ({ below }) => ({ data: Uint8Array.from({ length: 256 }, (_, i) => (i % 4 === 3 ? 255 : below(256))), width: 8, height: 8 });

/** What is random steps of one Renderer, and what it holds by then */
function life(seed) {
    const r = dice(seed), made = lit(new Renderer(36, 48)), shapes = new Map(), pictures = new Map(), objects = new Map();
    const looks = () => ({ color: [r.random(), r.random(), r.random()], alpha: r.random() < 0.2 ? 0.5 : 1,
                           specular: r.random(), shininess: 1 + r.below(60), emission: r.random() < 0.3 ? r.random() : 0,
                           two_sided: r.random() < 0.5, casts_shadow: r.random() < 0.8,
                           texture: pictures.size && r.random() < 0.5 ? r.one([...pictures.keys()]) : undefined });
    const steps = [
        () => {
            const kind = r.one(Object.keys(SIZES)), shape = shapes.size && r.random() < 0.5 ? r.one([...shapes.keys()]) : kind;
            const own = looks(), size = shape === kind ? SIZES[kind] : 0.4, pose = turned(r);
            const { number } = made.add(shape, size, { pose, ...own });
            assert.ok(!objects.has(number));
            objects.set(number, { shape, size, pose, own, visible: true });
        },
        () => { const arrays = pyramid(r); shapes.set(made.mesh(arrays), arrays); },
        () => { const picture = texels(r); pictures.set(made.texture(picture), picture); },
        () => {
            if (!shapes.size) return;
            const shape = r.one([...shapes.keys()]), arrays = pyramid(r);
            made.update(shape, arrays);
            shapes.set(shape, arrays);
        },
        () => {    // vertices alone
            if (!shapes.size) return;
            const shape = r.one([...shapes.keys()]), arrays = shapes.get(shape);
            const positions = arrays.positions.map((x) => x + 0.2 * r.random());
            made.update(shape, positions);
            shapes.set(shape, { ...arrays, positions });
        },
        () => {
            if (!pictures.size) return;
            const number = r.one([...pictures.keys()]), picture = texels(r);
            made.update_texture(number, picture);
            pictures.set(number, picture);
        },
        () => { const number = r.one([...objects.keys()]); made.remove(number); objects.delete(number); },
        () => {
            const number = r.one([...objects.keys()]), own = looks(), object = objects.get(number);
            made.change(number, own);
            object.own = own;
        },
        () => {
            const number = r.one([...objects.keys()]), object = objects.get(number), solid = made.object(number);
            object.pose = turned(r);
            object.visible = r.random() < 0.8;
            solid.pose = object.pose;
            solid.show(object.visible);
        },
        () => {
            const order = made.objects, poses = order.map(() => turned(r));
            made.poses(poses);
            order.forEach((number, i) => { objects.get(number).pose = poses[i]; });
            const used = new Set([...objects.values()].map(({ shape }) => shape)), idle = [...shapes.keys()].find((s) => !used.has(s));
            if (idle) { made.remove(idle); shapes.delete(idle); }
            const shown = new Set([...objects.values()].map(({ own }) => own.texture)), map = [...pictures.keys()].find((n) => !shown.has(n));
            if (map !== undefined) { made.remove_texture(map); pictures.delete(map); }
        },
    ];
    const step = () => (objects.size ? r.one(steps) : steps[0])();
    /** The same made at once */
    const anew = () => {
        const other = lit(new Renderer(36, 48)), numbers = new Map(), meshes = new Map(), maps = new Map();
        for (const [number, picture] of pictures) maps.set(number, other.texture(picture));
        for (const [shape, arrays] of shapes) meshes.set(shape, other.mesh(arrays));
        for (const [number, { shape, size, pose, own, visible }] of objects) {
            const { number: there } = other.add(meshes.get(shape) ?? shape, size, { pose, ...own, texture: maps.get(own.texture) });
            other.show(there, visible);
            numbers.set(there, number);
        }
        return { other, numbers };
    };
    return { made, objects, step, anew };
}

test("5,000 changes of one Renderer end in the pictures of new ones", () => {
    let changes = 0, seen = 0;
    for (let seed = 0; seed < 50; seed++) {
        const { made, objects, step, anew } = life(seed);
        for (let i = 0; i < 100; i++, changes++) {
            step();
            assert.deepEqual(made.objects, [...objects.keys()].sort((a, b) => a - b));
            if (i % 20 !== 19) continue;
            const { other, numbers } = anew(), all = { normals: true };
            const one = made.render(EYE, made.frame(all)), two = other.render(EYE, other.frame(all));
            two.ids = two.ids.map((id, k) => (k % 2 === 0 && id >= 0 ? numbers.get(id) : id));
            for (const name of ["color", "depth", "ids", "normals"]) assert.deepEqual(one[name], two[name], `${name} of ${seed}, ${i}`);
            seen += one.ids.some((id) => id >= 0);
            other.free();
        }
        made.free();
    }
    assert.ok(changes === 5000 && seen > 200, `${changes} changes, ${seen} pictures with something in them`);
});

/** A torus of 2 n n triangles */
function torus(n) {
    const positions = [], indices = [], at = (i, j) => (i % n) * n + j % n;
    for (let i = 0; i < n; i++) {
        for (let j = 0; j < n; j++) {
            const [a, b] = [i, j].map((k) => 2 * Math.PI * k / n), r = 1 + 0.4 * Math.cos(b);
            positions.push(r * Math.cos(a), r * Math.sin(a), 0.4 * Math.sin(b));
            indices.push(at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j), at(i + 1, j + 1), at(i, j + 1));
        }
    }
    return { positions, indices };
}

test("ground has the bits of a mesh whose positions are computed in double", () => {
    const r = dice(9), [rows, columns, half] = [6, 8, [1.1, 0.7]], heights = Float64Array.from({ length: 48 }, () => r.below(16) / 16);
    const positions = [], indices = [];
    heights.forEach((z, k) => {
        const [i, j] = [Math.floor(k / columns), k % columns];
        positions.push(2 * half[0] * j / (columns - 1) - half[0], 2 * half[1] * i / (rows - 1) - half[1], z);
        if (i < rows - 1 && j < columns - 1) indices.push(k, k + 1, k + columns + 1, k, k + columns + 1, k + columns);
    });
    const [one, two] = [0, 1].map(() => lit(new Renderer(96, 128)));
    one.add(one.height_field(heights, rows, columns, half), 1, { two_sided: true });
    two.add(two.mesh({ positions, indices, normals: "smooth" }), 1, { two_sided: true });
    assert.deepEqual(...[one, two].map((made) => made.render(EYE, made.frame({ normals: true }))));
});

test("an update of positions has the bits of a new mesh", () => {
    const { positions, indices } = torus(16), r = dice(1);
    const bent = (step) => positions.map((x, i) => (i % 3 === 2 ? x + 0.2 * Math.sin(3 * positions[i - 2] + step) : x));
    const own = (step) => { const all = positions.map(() => r.random() - 0.5); return step === 0 ? all.fill(0, 9, 12) : all; };
    const tints = { no: undefined, vertex: positions.map(r.random), face: Array.from(indices, r.random) };
    for (const normals of ["auto", "flat", "smooth", "given"]) {
        for (const colors of Object.values(tints)) {
            for (const far of [0, 1e6]) {
                const seen = Camera.lookAt([3 + far, -3 + far, 2 + far], [far, far, far], { aspect: 4 / 3, near: 0.1 });
                const there = (step) => Float64Array.from(bent(step), (x) => x + far);
                let given = normals === "given" ? own(0) : normals;
                const made = new Renderer(36, 48), source = { positions: there(0), indices: indices.slice(), normals: given, colors };
                const shape = made.mesh(source);
                source.indices.fill(0);    // arrays are the caller's
                made.add(shape, 1, { color: "orange", two_sided: true });
                for (let step = 1; step < 5; step++) {
                    if (step === 3 && normals === "given") made.update(shape, there(step), { normals: given = own(1) });
                    else made.update(shape, there(step));
                    const fresh = new Renderer(36, 48);
                    fresh.add(fresh.mesh({ positions: there(step), indices, normals: given, colors }), 1, { color: "orange", two_sided: true });
                    const [got, want] = [made, fresh].map((one) => one.render(seen, one.frame({ normals: true })));
                    assert.deepEqual(got, want, `${normals}, step ${step}, ${far}`);
                    assert.ok(want.ids.filter((id) => id >= 0).length > 400);
                    fresh.free();
                }
                made.free();
            }
        }
    }
});

test("what an update cannot move is refused, and nothing moves", () => {
    const made = new Renderer(36, 48), { positions, indices } = torus(8);
    const shape = made.mesh({ positions, indices, normals: "flat" }), whole = made.mesh(new Mesh({ positions, indices }));
    const ground = made.height_field(new Float32Array(9), 3, 3, [1, 1]);
    [shape, ground].forEach((one) => made.add(one));
    const before = made.render(EYE);
    for (const [words, ...call] of [
        [/^positions must hold finite/, shape, [NaN, ...positions.slice(1)]], [/^indices: bad indices/, shape, positions.slice(3)],
        [/^positions must hold 3 numbers a row/, shape, positions.slice(1)], [/^source must be a Mesh/, whole, positions],
        [/^normals must have a row/, shape, positions, { normals: [0, 0, 1] }], [/^options.faces is no option/, shape, positions, { faces: [] }],
        [/^options go with an array/, shape, { positions }, {}], [/^heights must/, ground, [1]],
        [/^options go with an array/, ground, new Float32Array(9), { normals: "flat" }]]) {
        assert.throws(() => made.update(...call), (error) => error instanceof ShadeError && words.test(error.message), `${words}`);
    }
    assert.deepEqual(made.render(EYE), before);
    made.update(shape, positions.map((x) => 0.5 * x), { normals: "smooth", colors: positions.map(() => 0.5) });
    const fresh = new Renderer(36, 48);
    fresh.add(fresh.mesh({ positions: positions.map((x) => 0.5 * x), indices, normals: "smooth", colors: positions.map(() => 0.5) }));
    fresh.add(fresh.height_field(new Float32Array(9), 3, 3, [1, 1]));
    assert.deepEqual(made.render(EYE), fresh.render(EYE));
});

test("meshes that nobody frees stay within 500 MB, and are drawn as they were when they are wanted again", () => {
    const { positions, indices } = torus(90), small = { size: 24, samples: 1 }, first = [];
    const source = (i) => ({ positions: Float32Array.from(positions, (x, k) => (k % 3 === i % 3 ? x * (1 + i / 50) : x)), indices,
                             edges: i % 2 === 0, colors: Array.from(positions, (_, k) => ((k + i) % 7) / 7) });
    const want = Array.from({ length: 12 }, (_, i) => { const mesh = new Mesh(source(i)); first.push(mesh); return render(mesh, small).data; });
    const both = render(first.slice(0, 5), small).data, before = process.memoryUsage().rss;
    let most = 0;
    for (let i = 0; i < 250; i++) {    // of some 5 MB each, in one turn of the event loop
        const mesh = new Mesh(source(i));
        if (i % 100 === 0) render(mesh, small);
        most = Math.max(most, process.memoryUsage().rss - before);
    }
    assert.ok(most < 500e6, `${most} bytes`);
    first.forEach((mesh, i) => assert.deepEqual(render(mesh, small).data, want[i]));
    assert.deepEqual(render(first.slice(0, 5), small).data, both);
    first.forEach((mesh) => mesh.free());
    assert.throws(() => render(first[0], small), /^ShadeError|mesh was freed/);
});
