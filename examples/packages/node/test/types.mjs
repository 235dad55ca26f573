// types.mjs folder modules - compiles a program in TypeScript that uses all of index.d.ts, as a module
// and as CommonJS; and programs whose mistakes the types must tell.
import { execFileSync } from "node:child_process";
import { writeFileSync } from "node:fs";
import { join } from "node:path";

const [folder, modules] = process.argv.slice(2);
const right = `
import { Camera, Mesh, PRESETS, Picture, Renderer, ShadeError, mujoco, read3mf, readModel, render } from "shade-h";
import type { CameraMatrices, Color, Frame, Light, Lighting, Material, MeshSource, Numbers, Options, Texture, Viewpoint } from "shade-h";
const positions: Numbers = new Float64Array(9), texture: Texture = { data: [1, 2, 3], width: 1, height: 1 };
const material: Material = { diffuse: [1, 0, 0], shininess: 3 }, color: Color = "steel";
const source: MeshSource = { positions, indices: [0, 1, 2], normals: "flat", color, material, edges: true,
    colors: new Uint8Array(9), pose: new Float32Array(16), twoSided: false, opacity: 0.5, blend: true, cutoff: 0.1 };
const view: Viewpoint = [30, 20], camera: Camera = { view: [], projection: [] };
const made: CameraMatrices = Camera.lookAt([1, 2, 3], [0, 0, 0], { aspect: 2 });
const image = new ImageData(render({ positions }).data, 640, 480), file0 = render({ positions }).png().then((png) => new Blob([png]));
void [Camera.opencv([], [], 64), Camera.opengl([], []), Camera.fitted([], { view: "top" }), made, image, file0];
const lamp: Light = { position: [1, 2, 3, 0], color: [1, 1, 1], spotCosCutoff: 0.5, linear: 1 };
const light: Lighting = { lights: [lamp], ambient: [0, 0, 0], model: "phong", flags: 4 };
const options: Options = { light, view, size: 64, samples: 2, background: null, ortho: true, up: "y", depth: true };
const mesh = new Mesh({ ...source, uv: [0, 0, 0, 0, 0, 0], texture, relief: texture, strength: 2, glow: texture,
    glowFactor: [1, 1, 0.5] });
const picture: Picture = render([mesh, source], options);
render(mesh, { view: camera, size: [1, 2] });
const bytes: Uint8ClampedArray = picture.data, depth: Float32Array | null = picture.depth;
const ids: Int32Array | null = picture.ids, file: Promise<Uint8Array> = picture.png();
const names: readonly string[] = PRESETS, wrong: TypeError = new ShadeError("size");
mesh.free();
const sim = new Renderer(8, 8, { samples: 2 }), ball = sim.add("sphere", 1, { color: "red" }), which: number = ball.number;
sim.light([lamp], [0, 0, 0], 0);
const pairs: Int32Array | null = sim.render(camera, sim.frame({ normals: true })).ids;
const batch: Frame = sim.render_batch([camera], [[new Float32Array(16)]], sim.frame({ pictures: 1 }), { solid: true });
const robot = new mujoco.Renderer({}, {}, 8, 8), rgb: Uint8Array = robot.render();
const parts: Promise<MeshSource[]> = read3mf(new Uint8Array(9), { picture: () => null });
const read: Promise<MeshSource[]> = readModel(new Uint8Array(9), { format: "obj", beside: (name) => (name ? null : new Uint8Array(1)) });
const solid = sim.object(which);
ball.pose = [1, 2, 3];
solid.pose = [1, 2, 3];
solid.color = "tomato";
sim.pose(solid, solid.pose);
void [solid === ball, batch, pairs, parts, read, rgb];
const shown = new ImageData(picture.data, picture.width, picture.height);
const kept = async () => [new Blob([await picture.png()]), new Response(await picture.png()), new Blob([picture.data])];
void [shown, kept, readModel(new Uint8Array(9), { color: "red" })];
export { bytes, depth, file, ids, names, wrong };
`;
const mistakes = ['render({})', 'render({ positions: "0" })', 'render({ positions: [], edges: 1 })',
                  'render({ positions: [] }, { veiw: "top" })', 'render({ positions: [] }, { up: "x" })',
                  'new Mesh()', 'render({ positions: [] }).data = null',
                  'new Renderer(8, 8).add("sphere", 1) === 0'];

// one program in one run: the compiler tells the mistakes of all lines
const wrong = ['import { Mesh, Renderer, render } from "shade-h";', ...mistakes.map((line) => `${line};`),
               "void [Mesh, Renderer];"].join("\n");
const files = { "right.mts": right, "right.cts": right, "wrong.mts": wrong };
for (const [name, text] of Object.entries(files)) writeFileSync(join(folder, name), text);
const flags = ["--strict", "--noEmit", "--module", "node16", "--moduleResolution", "node16", "--target",
               "es2022", "--lib", "es2022,dom", "--skipLibCheck"];
let said = "";
try {
    execFileSync(process.execPath, [join(modules, "typescript/bin/tsc"), ...flags, ...Object.keys(files)],
                 { cwd: folder, stdio: ["ignore", "pipe", "pipe"] });
} catch (error) { said = `${error.stdout}`; }
const told = said.split("\n").filter((line) => /^\S/.test(line)).map((line) => /^wrong\.mts\((\d+),/.exec(line)?.[1] - 2);
const missing = mistakes.filter((_, i) => !told.includes(i));
if (missing.length || !told.every((i) => i >= 0 && i < mistakes.length)) {
    console.log(said, "no error:", missing);
    process.exit(1);
}
