// A scene for a Renderer, which test/oracle.py, Node and the browser draw: the same bytes.
/** told: what oracle.py has written of its arrays.  Returns colour, depth, numbers and normals as bytes. */
export function sight(Renderer, Mesh, { view, projection, box, faces, uv, torus }) {
    const sim = new Renderer(60, 80);
    sim.add("plane", undefined, { texture: sim.checker(), repeat: [0.5, 0.5] });
    const far = box.map((x, i) => x + (i % 3 ? 0 : 5e4)), colors = Array(4).fill([0.9, 0.4, 0.2, 0.2, 0.5, 0.9]).flat();
    const tinted = sim.mesh({ positions: far, indices: faces, colors });
    const mapped = sim.mesh({ positions: box, indices: faces, uv });
    sim.add(tinted, undefined, { at: [-5e4, 0.6, 0.1] });
    sim.add(mapped, undefined, { at: [-1.2, -0.6, 0.1], texture: sim.checker("red", "white") });
    const ring = sim.mesh({ positions: torus[0], indices: torus[1] });
    sim.add(ring, 0.2, { at: [1.2, -1, 0.4], color: "green", specular: 0.5 });
    const shapes = { sphere: 0.3, ellipsoid: [0.35, 0.2, 0.15], capsule: [0.15, 0.3], cylinder: [0.2, 0.3],
                     box: [0.25, 0.2, 0.3] };
    Object.entries(shapes).forEach(([name, size], i) => sim.add(name, size,
        { at: [i * 0.8 - 2, -0.2, 0.5], color: "yellow", alpha: i === 1 ? 0.5 : 1 }));
    const diffuse = [0.8, 0.8, 0.8];
    sim.light([{ position: [0.5, -1, 1.5, 0], diffuse, specular: diffuse }], [0.3, 0.3, 0.3], 0);
    sim.sky();
    const frame = sim.render({ view, projection }, sim.frame({ normals: true }));
    sim.remove(5);
    sim.update(ring, { positions: box, indices: faces });
    sim.change(3, { size: 0.4, color: [0.9, 0.2, 0.6], specular: [0.1, 0.5, 0.9], shininess: 9 });
    const data = Array.from({ length: 64 }, (_, i) => (v => [v, v, v, i % 8 < 4 ? 255 : v])(30 * Math.floor(i / 8))).flat();
    sim.add(sim.mesh(new Mesh({ positions: box, indices: faces, uv, texture: { data, width: 8, height: 8 }, cutoff: 0.5,
        material: { emission: [0, 0.1, 0], diffuse: [0.8, 0.7, 0.6], specular: [0.5, 0.4, 0.3], shininess: 20 } })),
        undefined, { at: [0.3, -1.6, 0.3], two_sided: true });
    const plain = { diffuse: [0.6, 0.7, 0.8], specular: [0.2, 0.2, 0.2], shininess: 12 }, leaf = { data, width: 8, height: 8 };
    const opaque = { ...leaf, data: data.map((x, i) => (i % 4 < 3 ? x : 255)) }, bent = { data: [190, 128, 230], width: 1, height: 1 };
    for (const [x, own] of [[-0.5, { relief: { ...leaf, squares: true }, strength: 0.25, glow: { ...leaf, squares: true }, glowFactor: [0.2, 0.5, 0.125] }],
                            [-1.5, { relief: bent, strength: 1.5, texture: opaque }]]) {
        const dressed = new Mesh({ positions: box, indices: faces, uv, material: plain, ...own });
        sim.add(sim.mesh(dressed), [1, 0.5, 1.5], { at: [x, -1.6, 0.3], repeat: [1, 2] });
    }
    sim.pose(4, [0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, -2, 0.2, 0.9, 1]);
    const half = [0.5, 0.5, 0.5];
    sim.light([{ position: [0.5, -1, 1.5, 0], color: half },
               { position: [1, -2, 4, 1], color: half, spotDirection: [-0.2, 0.4, -1], spotExponent: 2, spotCosCutoff: 0.8 }],
              [0.3, 0.3, 0.3], [0, 1]);
    const later = sim.render_batch([{ view, projection }, { view: view.map((x, i) => (i === 12 ? x + 0.5 : x)), projection }],
                                   undefined, sim.frame({ normals: true, pictures: 2 }));
    sim.free();
    const arrays = [frame, later].flatMap(Object.values).map((a) => new Uint8Array(a.buffer)), all = new Uint8Array(arrays.reduce((n, a) => n + a.length, 0));
    arrays.reduce((at, a) => (all.set(a, at), at + a.length), 0);
    return all;
}
