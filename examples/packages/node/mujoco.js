// MuJoCo's own Renderer without OpenGL: the same calls, shapes and units, over @mujoco/mujoco.
import * as check from "./arguments.js";

const { ShadeError } = check;

const HEIGHT_FIELD = 1, MESH = 7, SKYBOX = 2, SHADOWS = 0, SKIES = 4, FIXED = 2, CAMERA = 7;    // of MuJoCo's enums
// What mjv.h knows of an mjvGeom, an mjvLight and an mjvGLCamera, in its order, and how many numbers that is
const GEOM = ["type", "dataid", "texid", "texuniform", "segid", "objid", "objtype", "specular", "shininess", "emission",
              "size", "pos", "mat", "rgba", "texrepeat"];
const LAMP = ["type", "headlight", "castshadow", "cutoff", "exponent", "pos", "dir", "ambient", "diffuse", "specular",
              "attenuation"];
const EYE = ["frustum_near", "frustum_far", "frustum_top", "frustum_bottom", "frustum_center", "frustum_width",
             "orthographic", "pos", "forward", "up"];
const NUMBERS = { geoms: [GEOM, 31], lights: [LAMP, 23], cameras: [EYE, 16] }, RECORD = 58;

/** The numbers of some of a scene, one row after the other */
function rowsOf(name, all) {
    const [fields, width] = NUMBERS[name];
    const rows = Float64Array.from(all.flatMap((one) => fields.flatMap((field) => one[field])), Number);
    if (rows.length !== width * all.length) throw new ShadeError(`${name} must have the fields of an mjvScene's`);
    return rows;
}

/** What draws a model's scenes: geoms, lights and cameras of an mjvScene. */
class Stage {
    #base; #core; #model; #numbers = new Map(); #textures = new Set(); #geoms; #seen;

    constructor(Renderer, core, model, height, width) {
        this.#base = new Renderer(height, width, { srgb: false });
        this.#core = core;
        this.#model = model;
        this.sky = Array.from(model.tex_type ?? []).indexOf(SKYBOX);
    }

    /** Calls a function of the core over copies of arrays */
    #with(arrays, call) {
        const { withMemory, put } = this.#core;
        const done = withMemory((room) => {
            const at = arrays.map((array) => (array ? put(room(array.byteLength + 8), array) : 0));
            return call(room, ...at);
        });
        if (done === 0) throw new RangeError("memory is not enough for the model");
        return done;
    }

    #texture(i) {
        if (this.#textures.has(i)) return i;
        const [first, width, height, n, type] = ["adr", "width", "height", "nchannel", "type"].map((k) => this.#model[`tex_${k}`][i]);
        const texels = Uint8Array.from(this.#model.tex_data.subarray(first, first + width * height * n));
        this.#with([texels], (room, at) => this.#core.library.mjv_texture(this.#base._at, i, at, width, height, n, type));
        this.#textures.add(i);
        return i;
    }

    /** The number of a mesh or ground of the model, which is made where it is wanted */
    #mesh(type, i) {
        const name = `${type} ${i}`;
        if (!this.#numbers.has(name)) {
            (type === MESH ? this.#part : this.#ground).call(this, i, this.#numbers.size);
            this.#numbers.set(name, this.#numbers.size);
        }
        return this.#numbers.get(name);
    }

    #part(i, number) {
        const model = this.#model, { library, put } = this.#core;
        const mapped = model.mesh_texcoordadr[i] >= 0 && model.mesh_texcoordnum[i] > 0;
        const part = (Kind, name, of, width) => {
            const [first, count] = [model[`mesh_${of}adr`][i], model[`mesh_${of}num`][i]];
            return Kind.from(model[`mesh_${name}`].subarray(width * first, width * (first + count)));
        };
        const [vertices, normals] = ["vert", "normal"].map((name) => part(Float32Array, name, name, 3));
        const [vertex, normal] = ["face", "facenormal"].map((name) => part(Int32Array, name, "face", 3));
        const uv = mapped ? part(Float32Array, "texcoord", "texcoord", 2) : null;
        const texcoord = mapped ? part(Int32Array, "facetexcoord", "face", 3) : null;
        const counts = [vertices.length / 3, normals.length / 3, mapped ? uv.length / 2 : 0, vertex.length];
        const done = this.#with([vertices, normals, uv, vertex, normal, texcoord], (room, ...at) =>
            library.mjv_mesh(this.#base._at, number, put(room(40), Uint32Array.of(...at, ...counts))));
        if (done < 0) throw new ShadeError(`model: a face of mesh ${i} has no vertex, normal or texcoord`);
    }

    #ground(i, number) {
        const [rows, columns, first] = ["nrow", "ncol", "adr"].map((k) => this.#model[`hfield_${k}`][i]);
        const { hfield_data: data, hfield_size: sizes } = this.#model, heights = data.subarray(first, first + rows * columns);
        this.#base._heights(number, heights, rows, columns, sizes.subarray(4 * i, 4 * i + 4));
    }

    /** Takes what an mjvScene holds: arrays of geoms, lights and the two cameras of stereo. */
    take({ geoms, lights, cameras, flags }) {
        const { library, asked } = this.#core, base = this.#base;
        const rows = rowsOf("geoms", geoms), [, width] = NUMBERS.geoms;
        for (let k = 0; k < rows.length; k += width) {
            const [type, id, texture] = rows.subarray(k, k + 3);
            if (type === MESH || type === HEIGHT_FIELD) rows[k + 1] = this.#mesh(type, type === MESH ? id >> 1 : id);
            if (texture >= 0) this.#texture(texture);
        }
        this.#geoms = rows;
        const sky = flags[SKIES] && this.sky >= 0 ? this.#texture(this.sky) : -1;
        const black = Float32Array.of(0, 0, 0, 1, 0, 0, 0, 0, 0, 0);
        this.#with([rowsOf("lights", lights), black], (room, lamps, behind) => {
            asked(library.mjv_lights, base._at, lamps, lights.length, flags[SHADOWS] ? 1 : 0);
            library.scene_behind(base._at, sky < 0 ? 0 : 2, sky, behind);
        });
        this.#seen = this.#with([rowsOf("cameras", cameras)], (room, at) => {
            const out = room(8 * 35);
            library.mjv_aim(at, base.width / base.height, out);
            return new Float64Array(library.memory.buffer, out, 35).slice();
        });
    }

    /** Draws into out; of ids, object and type in place of object and triangle. */
    draw(out, solid) {
        const { library } = this.#core, count = this.#geoms.length / NUMBERS.geoms[1];
        const { records, pairs } = this.#with([this.#geoms], (room, at) => {
            const [made, two] = [room(4 * RECORD * count + 8), room(8 * count + 8)];
            const used = library.mjv_records(at, count, solid ? 1 : 0, made, two);
            const ints = (from, n) => new Int32Array(library.memory.buffer, from, n).slice();
            return { records: ints(made, RECORD * used), pairs: ints(two, 2 * used + 2) };
        });
        const view = this.#seen.subarray(0, 16), projection = this.#seen.subarray(16, 32);
        const [near, far, parallel] = this.#seen.subarray(32);
        this.#base._draw(out, [{ view, projection, near, far, parallel, records }], { solid, empty_depth: far });
        for (let i = 0; out.ids && i < out.ids.length; i += 2) {
            const k = 2 * (out.ids[i] + 1);
            [out.ids[i], out.ids[i + 1]] = [pairs[k], pairs[k + 1]];
        }
    }

    free() { this.#base.free(); }
}

/** The class of MuJoCo's name, over the Renderer of this package. */
export function mujocoOf(Base, core) {
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
            this.#stage = new Stage(Base, core, model, height, width);
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

/** Plain objects of the handles of @mujoco/mujoco, which must be deleted. */
function copied(handle, fields) {
    const out = Object.fromEntries(fields.map((name) => {
        const value = handle[name];
        return [name, typeof value === "object" ? Array.from(value) : Number(value)];
    }));
    handle.delete();
    return out;
}

function read(scene) {
    const all = (vector, count, fields) => {
        const out = Array.from({ length: count }, (_, i) => copied(vector.get(i), fields));
        vector.delete?.();
        return out;
    };
    return { geoms: all(scene.geoms, scene.ngeom, GEOM), lights: all(scene.lights, scene.nlight, LAMP),
             cameras: all(scene.camera, 2, EYE), flags: Array.from(scene.flags) };
}
