// A scene for a Renderer, which test/oracle.py, Node and the browser draw: the same bytes.
/** told: what oracle.py has written of its arrays.  Returns colour, depth, numbers and normals as bytes. */
export function sight(Renderer, { view, projection, box, faces, uv, torus }) {
    const sim = new Renderer(60, 80);
    sim.add("plane", undefined, { texture: sim.checker(), repeat: [0.5, 0.5] });
    const far = box.map((x, i) => x + (i % 3 ? 0 : 5e4)), colors = Array(4).fill([0.9, 0.4, 0.2, 0.2, 0.5, 0.9]).flat();
    const tinted = sim.mesh({ positions: far, indices: faces, colors });
    const mapped = sim.mesh({ positions: box, indices: faces, uv });
    sim.add(tinted, undefined, { at: [-5e4, 0.6, 0.1] });
    sim.add(mapped, undefined, { at: [-1.2, -0.6, 0.1], texture: sim.checker("red", "white") });
    sim.add(sim.mesh({ positions: torus[0], indices: torus[1] }), 0.2, { at: [1.2, -1, 0.4], color: "green", specular: 0.5 });
    const shapes = { sphere: 0.3, ellipsoid: [0.35, 0.2, 0.15], capsule: [0.15, 0.3], cylinder: [0.2, 0.3],
                     box: [0.25, 0.2, 0.3] };
    Object.entries(shapes).forEach(([name, size], i) => sim.add(name, size,
        { at: [i * 0.8 - 2, -0.2, 0.5], color: "yellow", alpha: i === 1 ? 0.5 : 1 }));
    const diffuse = [0.8, 0.8, 0.8];
    sim.light([{ position: [0.5, -1, 1.5, 0], diffuse, specular: diffuse }], [0.3, 0.3, 0.3], 0);
    sim.sky();
    const frame = sim.render({ view, projection }, sim.frame({ normals: true }));
    sim.free();
    const arrays = Object.values(frame).map((a) => new Uint8Array(a.buffer)), all = new Uint8Array(arrays.reduce((n, a) => n + a.length, 0));
    arrays.reduce((at, a) => (all.set(a, at), at + a.length), 0);
    return all;
}
