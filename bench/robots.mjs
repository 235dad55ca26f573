// robots.mjs - the scene of robots.py in Node.js: pictures a second of 32 geoms that move, with colour,
// depth, and the object and triangle of each pixel, by one thread.  Seconds are those of processor time,
// and the figure is the best of ten parts.
//     sh examples/packages/node/build.sh && node bench/robots.mjs [seconds]
import { Renderer } from "../examples/packages/node/index.js";

const seconds = Number(process.argv[2] ?? 2), FRAMES = 16, PARTS = 10;
const now = () => { const { user, system } = process.cpuUsage(); return (user + system) / 1e6; };
const back = [0, -8 / Math.hypot(8, 7), 7 / Math.hypot(8, 7)], slope = 1 / Math.tan(Math.PI / 8);
const camera = {
    view: [1, 0, 0, 0, 0, back[2], back[1], 0, 0, -back[1], back[2], 0, 0, 0, -Math.hypot(8, 7), 1],
    projection: [slope, 0, 0, 0, 0, slope, 0, 0, 0, 0, -31 / 29, -1, 0, 0, -60 / 29, 0],
};

for (const size of [64, 84, 128, 256]) {
    const sim = new Renderer(size, size), color = [0.7, 0.65, 0.6];
    sim.add("box", [12, 12, 0.1], { color, at: [0, 0, -0.1] });
    const shapes = [["box", [0.4, 0.4, 0.4]], ["sphere", 0.4], ["capsule", [0.4, 0.4]]];
    for (let i = 1; i < 32; i++) sim.add(...shapes[i % 3], { color });
    sim.light([{ position: [1, -1, 2, 0] }], [0.3, 0.3, 0.3]);
    const out = sim.frame();
    let begin = now(), count = 0, rate = 0, part = 0;
    while (part < PARTS) {
        for (let i = 1; i < 32; i++) {
            const a = 3 * (count % FRAMES) / (FRAMES - 1) + i, c = Math.cos(a), s = Math.sin(a);
            sim.pose(i, [c, 0, -s, 0, 0, 1, 0, 0, s, 0, c, 0, (i % 8 - 3.5) * 1.1,
                         (Math.floor(i / 8) - 1.5) * 1.3, 0.6, 1]);
        }
        sim.render(camera, out);
        count++;
        const spent = now() - begin;
        if (spent < seconds / PARTS || count % FRAMES) continue;
        rate = Math.max(rate, count / spent);
        [begin, count, part] = [now(), 0, part + 1];
    }
    const seen = new Set(out.ids.filter((_, k) => k % 2 === 0)).size;
    if (seen < 30) throw new Error(`${seen} objects are seen`);
    console.log(`${size} x ${size}: ${Math.round(rate)} a second`);
    sim.free();
}
