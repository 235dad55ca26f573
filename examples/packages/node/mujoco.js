// MuJoCo's own Renderer without OpenGL: the same calls, shapes and units, over @mujoco/mujoco.
import * as check from "./arguments.js";
import { AT, HIDDEN, PLACE, TURN, plainRecord } from "./renderer.js";

const { ShadeError } = check;

const HEIGHT_FIELD = 1, MESH = 7, KINDS = [1, 0, 2, 4, 3, 5, 6, 0, 0];    // of mjGEOM_..., as kinds here
const CUBE = 1, SKYBOX = 2, SPOT = 0, DIRECTIONAL = 1;                    // mjTEXTURE_..., mjLIGHT_...
const SHADOWS = 0, SKIES = 4, FIXED = 2, CAMERA = 7, LAMPS = 8;          // mjRND_..., mjCAMERA_FIXED, mjOBJ_CAMERA

/** Texels as RGBA. */
function texels(model, i) {
    const [width, height, n] = [model.tex_width[i], model.tex_height[i], model.tex_nchannel[i]];
    const from = model.tex_data.subarray(model.tex_adr[i], model.tex_adr[i] + width * height * n);
    const data = new Uint8Array(4 * width * height).fill(255);
    for (let k = 0; k < width * height; k++) {
        for (let c = 0; c < 4; c++) if (c < n || c < 3) data[4 * k + c] = from[n * k + Math.min(c, n - 1)];
    }
    const faces = model.tex_type[i] === CUBE || model.tex_type[i] === SKYBOX ? 6 : 1;
    return { data, width, height, faces };
}

/** A mesh of the model, whose corners have numbers of their own for normals and texture coordinates. */
function meshOf(model, i) {
    const slice = (name, adr, num, width) => model[name].subarray(width * model[adr][i], width * (model[adr][i] + model[num][i]));
    const vertices = slice("mesh_vert", "mesh_vertadr", "mesh_vertnum", 3);
    const normals = slice("mesh_normal", "mesh_normaladr", "mesh_normalnum", 3);
    const faces = slice("mesh_face", "mesh_faceadr", "mesh_facenum", 3);
    const ofNormals = slice("mesh_facenormal", "mesh_faceadr", "mesh_facenum", 3);
    const mapped = model.mesh_texcoordadr[i] >= 0 && model.mesh_texcoordnum[i] > 0;
    const uv = mapped ? slice("mesh_texcoord", "mesh_texcoordadr", "mesh_texcoordnum", 2) : null;
    const ofUv = mapped ? slice("mesh_facetexcoord", "mesh_faceadr", "mesh_facenum", 3) : null;
    const made = { positions: [], normals: [], indices: [], ...(uv ? { uv: [] } : {}) }, known = new Map();
    for (let k = 0; k < faces.length; k++) {
        const [v, n, t] = [faces[k], ofNormals[k], ofUv ? ofUv[k] : 0], key = `${v} ${n} ${t}`;
        if (!known.has(key)) {
            known.set(key, known.size);
            made.positions.push(...vertices.subarray(3 * v, 3 * v + 3));
            made.normals.push(...normals.subarray(3 * n, 3 * n + 3));
            if (uv) made.uv.push(...uv.subarray(2 * t, 2 * t + 2));
        }
        made.indices.push(known.get(key));
    }
    return made;
}

/** Ground with sides, down to its base. */
function groundOf(model, i) {
    const [rows, columns] = [model.hfield_nrow[i], model.hfield_ncol[i]];
    const [a, b, high, base] = model.hfield_size.subarray(4 * i, 4 * i + 4);
    const data = model.hfield_data.subarray(model.hfield_adr[i], model.hfield_adr[i] + rows * columns);
    const positions = [], indices = [], top = (r, c) => r * columns + c;
    for (let r = 0; r < rows; r++) {
        for (let c = 0; c < columns; c++) {
            positions.push(2 * a * c / (columns - 1) - a, 2 * b * r / (rows - 1) - b, high * data[top(r, c)]);
        }
    }
    for (let r = 0; r + 1 < rows; r++) {
        for (let c = 0; c + 1 < columns; c++) {
            const k = top(r, c);
            indices.push(k, k + 1, k + columns + 1, k, k + columns + 1, k + columns);
        }
    }
    const rim = [];
    for (let c = 0; c < columns - 1; c++) rim.push(top(0, c));
    for (let r = 0; r < rows - 1; r++) rim.push(top(r, columns - 1));
    for (let c = columns - 1; c > 0; c--) rim.push(top(rows - 1, c));
    for (let r = rows - 1; r > 0; r--) rim.push(top(r, 0));
    rim.forEach((from, k) => {    // a wall has vertices of its own, so that its rim is sharp
        const to = rim[(k + 1) % rim.length], first = positions.length / 3;
        for (const [v, low] of [[from, 1], [to, 1], [to, 0], [from, 0]]) {
            positions.push(positions[3 * v], positions[3 * v + 1], low ? -base : positions[3 * v + 2]);
        }
        indices.push(first, first + 1, first + 2, first, first + 2, first + 3);
    });
    return { positions, indices, normals: "smooth" };
}

/** What draws a model's scenes: geoms, lights and cameras of an mjvScene. */
class Stage {
    #renderer; #model; #meshes = new Map(); #textures = new Map(); #records = [];
    #unnumbered = [];    // geoms that depth and segmentation leave out, as MuJoCo does

    constructor(Renderer, model, height, width) {
        this.#renderer = new Renderer(height, width, { srgb: false });
        this.#model = model;
        const types = Array.from(model.tex_type ?? []), sky = types.indexOf(SKYBOX);
        this.#renderer.background([0.0, 0.0, 0.0]);
        this.sky = sky < 0 ? null : this.#texture(sky);
    }

    #texture(i) {
        if (!this.#textures.has(i)) this.#textures.set(i, this.#renderer.texture(texels(this.#model, i)));
        return this.#textures.get(i);
    }

    #mesh(type, id) {
        const name = `${type} ${id}`, make = type === MESH ? meshOf : groundOf;
        if (!this.#meshes.has(name)) this.#meshes.set(name, this.#renderer._mesh(make(this.#model, id)).mesh);
        return this.#meshes.get(name);
    }

    /** The words of a geom's record; null for what is no surface here. */
    #record(g) {
        if (!(g.type >= 0 && g.type < KINDS.length - 1)) return null;
        const { floats, ints, doubles } = plainRecord();
        const shape = g.type === MESH || g.type === HEIGHT_FIELD;
        const mapped = shape && g.type === MESH && g.texcoord;
        ints[AT.kind] = KINDS[g.type];
        if (shape) ints[AT.mesh] = this.#mesh(g.type, g.type === MESH ? g.dataid >> 1 : g.dataid);
        ints[AT.texture] = g.texid >= 0 ? 1 + this.#renderer._slot(this.#texture(g.texid)) : 0;
        floats.set(shape ? [1, 1, 1] : g.size, AT.size);
        if (g.type === 0) floats[AT.size + 2] = 0;
        doubles.set(g.mat, TURN);
        doubles.set(g.pos, PLACE);
        floats.set(g.rgba, AT.rgba);
        floats.fill(g.specular, AT.specular, AT.specular + 3);
        floats[AT.shininess] = 128 * g.shininess;
        floats[AT.emission] = g.emission;
        for (let k = 0; k < 2; k++) {
            const across = g.texuniform || mapped || shape || !(g.size[k] > 0) ? 1 : 2 * g.size[k];
            floats[AT.repeat + k] = g.texrepeat[k] / across;
        }
        return ints;
    }

    /** Takes what an mjvScene holds: arrays of geoms, lights and the two cameras of stereo. */
    take({ geoms, lights, cameras, flags }) {
        const pairs = [], records = [];
        this.#unnumbered = [];
        for (const g of geoms) {
            const record = this.#record(g);
            if (!record) continue;
            if (g.segid < 0) this.#unnumbered.push(records.length);
            record[AT.id] = records.length;
            records.push(record);
            pairs.push(g.objid, g.objtype);
        }
        this.#records = records;
        this.pairs = Int32Array.from([-1, -1, ...pairs]);
        const used = lights.slice(0, LAMPS);
        const casts = (l) => flags[SHADOWS] && l.castshadow && !l.headlight && l.type <= DIRECTIONAL;
        this.#renderer.light(used.map((l) => ({
            position: l.type === DIRECTIONAL ? [-l.dir[0], -l.dir[1], -l.dir[2], 0] : [...l.pos, 1],
            ambient: l.ambient, diffuse: l.diffuse, specular: l.specular,
            constant: l.attenuation[0], linear: l.attenuation[1], quadratic: l.attenuation[2],
            ...(l.type === SPOT && l.cutoff < 90 ? { spotDirection: l.dir, spotExponent: l.exponent,
                spotCosCutoff: Math.cos(l.cutoff * Math.PI / 180) } : {}),
        })), [0, 0, 0], used.flatMap((l, k) => (casts(l) ? [k] : [])));
        if (flags[SKIES] && this.sky !== null) this.#renderer.sky_texture(this.sky);
        else this.#renderer.background([0.0, 0.0, 0.0]);
        this.#aim(cameras);
    }

    #aim([one, two]) {
        const mean = (a, b) => [0, 1, 2].map((k) => (a[k] + b[k]) / 2);
        const unit = (v) => { const n = Math.sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]); return v.map((x) => x / n); };
        const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
        const pos = mean(one.pos, two.pos), f = unit(mean(one.forward, two.forward));
        const r = unit(cross(f, mean(one.up, two.up))), u = cross(r, f);
        const dot = (a) => a[0] * pos[0] + a[1] * pos[1] + a[2] * pos[2];
        const [n, far, t, b] = [one.frustum_near, one.frustum_far, one.frustum_top, one.frustum_bottom];
        const half = one.frustum_width ? one.frustum_width : (t - b) / 2 * (this.#renderer.width / this.#renderer.height);
        const center = (one.frustum_center + two.frustum_center) / 2, scale = one.orthographic ? 1 : n;
        this.view = Float32Array.of(r[0], u[0], -f[0], 0, r[1], u[1], -f[1], 0, r[2], u[2], -f[2], 0,
                                    -dot(r), -dot(u), dot(f), 1);
        const p = new Float32Array(16);
        p[0] = scale / half;
        p[5] = 2 * scale / (t - b);
        if (one.orthographic) {
            p[12] = -center / half;
            p[13] = -(t + b) / (t - b);
            p[15] = 1;
        } else {
            p[8] = center / half;
            p[9] = (t + b) / (t - b);
            p[11] = -1;
        }
        this.projection = p;
        this.range = { near: n, far, parallel: one.orthographic ? 1 : 0 };
    }

    draw(out, solid) {
        const count = this.#records[0]?.length ?? 0, words = new Int32Array(count * this.#records.length);
        this.#records.forEach((record, i) => words.set(record, count * i));
        if (solid) this.#unnumbered.forEach((i) => { words[count * i + AT.flags] |= HIDDEN; });
        const shot = { view: this.view, projection: this.projection, ...this.range, records: words };
        return this.#renderer._draw(out, [shot], { solid, empty_depth: this.range.far });
    }

    free() { this.#renderer.free(); }
}

/** The class of MuJoCo's name, over the Renderer of this package. */
export function mujocoOf(Base) {
    class Renderer {
        #mj; #stage; #depth = false; #segmentation = false; #own = []; #taken = false; #live = false; #closed = false;

        /** mj is the module of @mujoco/mujoco, model one of its MjModel. */
        constructor(mj, model, height = 240, width = 320, max_geom = 10000) {
            this.height = check.integer("height", height, 1, 16384);
            this.width = check.integer("width", width, 1, 16384);
            const buffer = model.vis?.global_ ?? model.vis?.global ?? {};
            if (width > buffer.offwidth || height > buffer.offheight) {
                throw new ShadeError(`width and height must be at most the ${buffer.offwidth} x ${buffer.offheight} of ` +
                                     "the framebuffer: <visual><global offwidth=... offheight=.../></visual>");
            }
            this.#mj = mj;
            this.model = model;
            this.#stage = new Stage(Base, model, height, width);
            if (mj) this.#own = [new mj.MjvScene(model, max_geom), new mj.MjvOption(), new mj.MjvPerturb(), new mj.MjvCamera()];
        }

        /** The MjvScene that update_scene fills.  Its flags may be set before render(). */
        get scene() { return this.#own[0]; }

        /** Takes the state of data as camera sees it: a number, a name or an MjvCamera; -1 is free. */
        update_scene(data, camera = -1, scene_option = undefined) {
            if (this.#closed) throw new ShadeError("update_scene cannot be called after close");
            const [scene, option, perturb, own] = this.#own;
            let used = camera;
            if (typeof camera === "number" || typeof camera === "string") {
                const id = typeof camera === "number" ? camera : this.#mj.mj_name2id(this.model, CAMERA, camera);
                if (!(Number.isInteger(id) && id >= (camera === -1 ? -1 : 0) && id < this.model.ncam)) {
                    throw new ShadeError(`camera ${camera} is none of the model's ${this.model.ncam}`);
                }
                used = own;
                if (id < 0) this.#mj.mjv_defaultFreeCamera(this.model, used);
                else [used.type, used.fixedcamid] = [FIXED, id];
            }
            this.#mj.mjv_updateScene(this.model, data, scene_option ?? option, perturb, used, 7, scene);
            this.#live = true;
        }

        /** Takes { geoms, lights, cameras, flags } with the fields of an mjvScene. */
        take(scene) {
            this.#stage.take(scene);
            this.#taken = true;
            this.#live = false;
        }

        /** Colour, (height, width, 3) bytes; or depth, float32 metres; or pairs of object and type. */
        render(out = undefined) {
            const pixels = this.height * this.width;
            if (this.#closed) throw new ShadeError("render cannot be called after close");
            const [Kind, width] = this.#depth ? [Float32Array, 1] : this.#segmentation ? [Int32Array, 2] : [Uint8Array, 3];
            const to = out ?? new Kind(width * pixels);
            if (this.#live) {
                this.take(read(this.#own[0]));
                this.#live = true;
            }
            if (!(to instanceof Kind) || to.length !== width * pixels) {
                throw new ShadeError(`out must be a ${Kind.name} of ${width * pixels}`);
            }
            if (!this.#taken) return to.fill(this.#segmentation ? -1 : 0);    // an empty scene, as in MuJoCo
            const frame = { color: null, depth: null, ids: null, normals: null };
            frame[this.#depth ? "depth" : this.#segmentation ? "ids" : "color"] = to;
            this.#stage.draw(frame, this.#depth || this.#segmentation);
            for (let i = 0; this.#segmentation && i < to.length; i += 2) {
                const k = 2 * (to[i] + 1);
                [to[i], to[i + 1]] = [this.#stage.pairs[k], this.#stage.pairs[k + 1]];
            }
            return to;
        }

        enable_depth_rendering() { [this.#depth, this.#segmentation] = [true, false]; }
        disable_depth_rendering() { this.#depth = false; }
        enable_segmentation_rendering() { [this.#depth, this.#segmentation] = [false, true]; }
        disable_segmentation_rendering() { this.#segmentation = false; }

        close() {
            this.#closed = true;
            this.#own.forEach((one) => one.delete());
            this.#own = [];
            this.#stage.free();
        }
    }
    return { Renderer };
}

const GEOM = ["type", "dataid", "objid", "objtype", "segid", "texid", "texcoord", "texuniform", "specular", "shininess", "emission"];
const LAMP = ["type", "headlight", "castshadow", "cutoff", "exponent"];
const EYE = ["frustum_near", "frustum_far", "frustum_top", "frustum_bottom", "frustum_center", "frustum_width", "orthographic"];

/** Plain objects of the handles of @mujoco/mujoco, which must be deleted. */
function copied(handle, plain, arrays) {
    const out = Object.fromEntries(plain.map((name) => [name, Number(handle[name])]));
    for (const name of arrays) out[name] = Array.from(handle[name]);
    handle.delete();
    return out;
}

function read(scene) {
    const all = (vector, count, ...names) => {
        const out = Array.from({ length: count }, (_, i) => copied(vector.get(i), ...names));
        vector.delete?.();
        return out;
    };
    return { geoms: all(scene.geoms, scene.ngeom, GEOM, ["size", "pos", "mat", "rgba", "texrepeat"]),
             lights: all(scene.lights, scene.nlight, LAMP, ["pos", "dir", "ambient", "diffuse", "specular", "attenuation"]),
             cameras: all(scene.camera, 2, EYE, ["pos", "forward", "up"]), flags: Array.from(scene.flags) };
}
