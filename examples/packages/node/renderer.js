// Cameras for simulators, learners and graders: one scene, many pictures of colour, depth, numbers of
// objects and normals.  Names and bytes are those of the package for Python.
import * as check from "./arguments.js";

const { ShadeError } = check;

// Words of renderer_object, of renderer_picture and of shade_light; the fields of shade_mesh, a word each
const OBJECT = 30, SHOT = 67, LIGHT = 21;
const MESH = ["positions", "position_stride", "normals", "normal_stride", "texcoords", "texcoord_stride",
              "colors", "color_stride", "vertex_count", "indices", "index_count", "chunks", "chunk_count",
              "indices16"];
const KINDS = { plane: 1, sphere: 2, ellipsoid: 3, capsule: 4, cylinder: 5, box: 6 };
// What the numbers of a size are for x, y and z
const SIZES = { plane: [0, 1, 1], sphere: [0, 0, 0], ellipsoid: [0, 1, 2], capsule: [0, 0, 1],
                cylinder: [0, 0, 1], box: [0, 1, 2] };
const HIDDEN = 1, TWO_SIDED = 2, NO_SHADOW = 4, LAMPS = 8;

/** The rotation and the place of a matrix of 4 x 4 by columns. */
function rigid(name, value) {
    const m = check.vector(name, value, 16);
    const refused = () => new ShadeError(`${name} must be a rotation and a translation, without scale, by columns`);
    for (let i = 0; i < 3; i++) {
        for (let j = 0; j < 3; j++) {
            const dot = [0, 1, 2].reduce((sum, k) => sum + m[4 * i + k] * m[4 * j + k], 0);
            if (Math.abs(dot - (i === j ? 1 : 0)) > 1e-3) {
                throw refused();
            }
        }
    }
    if ([3, 7, 11].some((k) => Math.abs(m[k]) > 1e-3) || Math.abs(m[15] - 1) > 1e-3) throw refused();
    const side = [m[1] * m[6] - m[2] * m[5], m[2] * m[4] - m[0] * m[6], m[0] * m[5] - m[1] * m[4]];
    if (side[0] * m[8] + side[1] * m[9] + side[2] * m[10] < 0) throw refused();
    return { turn: [0, 4, 8, 1, 5, 9, 2, 6, 10].map((k) => m[k]), place: [12, 13, 14].map((k) => m[k]) };
}

/** near, far and whether the projection is parallel, of a matrix of OpenGL by columns. */
function rangeOf(p) {
    const refused = () => new ShadeError("camera: its projection must be that of OpenGL, with near before far");
    if (p[15] !== 0) {
        const near = (p[14] + 1) / p[10], far = (p[14] - 1) / p[10];
        if (!(near < far)) throw refused();
        return { near, far, parallel: 1 };
    }
    const a = p[10] / -p[11], b = p[14] / -p[11];
    const near = b / (a - 1), far = a < -1 ? b / (a + 1) : 3e30;
    if (!(near > 0 && near < far)) throw refused();
    return { near, far: Math.min(far, 3e30), parallel: 0 };
}

/** The class, over the functions of index.js that know the module's memory. */
export function rendererOf({ library, take, put, withMemory, linear, succeed, prepared }) {
    [[4, OBJECT], [5, SHOT], [3, LIGHT], [8, MESH.length]].forEach(([i, words]) => {
        if (library.size(i) !== 4 * words) throw new Error("renderer.js and module.js do not fit");
    });
    const forgotten = new FinalizationRegistry((scene) => library.scene_close(scene));
    // One picture is drawn at a time: its memory serves all renderers, so that one that is not freed
    // keeps its meshes and textures alone.
    const scratch = library.renderer_open(), held = {};    // name to { at, bytes }

    /** Memory that is kept, at least so large */
    function kept(name, bytes) {
        if (held[name]?.bytes >= bytes) return held[name].at;
        if (held[name]) library.give(held[name].at);
        delete held[name];
        held[name] = { at: take(bytes), bytes };
        return held[name].at;
    }

    return class Renderer {
        #made = library.scene_open();
        #objects = new ArrayBuffer(0);
        #count = 0;
        #meshes = 0;
        #cubes = [];
        #state = { lamps: new Float32Array(0), ambient: [0, 0, 0], shadow: -1,
                   background: [1, 1, 1, 1], sky: 0, skyTexture: -1, low: [0, 0, 0], high: [0, 0, 0] };

        constructor(height, width, options) {
            const got = check.record("options", options, ["samples", "srgb", "tolerance"]);
            this.height = check.integer("height", height, 1, 16384);
            this.width = check.integer("width", width, 1, 16384);
            this.samples = check.integer("samples", got.samples ?? 1, 1, 8);
            this.srgb = check.flag("srgb", got.srgb ?? true);
            this.tolerance = check.number("tolerance", got.tolerance ?? 0.25, 1e-3, 16);
            if (Math.max(height, width) * this.samples > 16384) {
                throw new ShadeError("height and width times samples must be at most 16384, not " +
                                     `${Math.max(height, width) * this.samples}`);
            }
            if (!this.#made || !scratch) throw new RangeError("memory is not enough for a scene");
            forgotten.register(this, this.#made, this);
            this.light([{ position: [0.5, -1, 1.2, 0], diffuse: [0.75, 0.75, 0.75],
                          specular: [0.75, 0.75, 0.75] }], [0.25, 0.25, 0.25]);
        }

        /** Where the module keeps the scene */
        get #scene() {
            if (!this.#made) throw new ShadeError("renderer was freed");
            return this.#made;
        }

        // ---- what is drawn

        /** A mesh for add(): a Mesh with its colour and its texture, or positions, indices, normals, uv and
         *  colors. */
        mesh(source) {
            const made = prepared(source);
            if (!made.positions.every(Number.isFinite)) throw new ShadeError("positions must hold finite numbers");
            const number = library.scene_made(this.#scene, made.address, ...made.origin);
            if (made !== source) made.free();
            if (number < 0) throw new RangeError("memory is not enough for the mesh");
            this.#meshes++;
            const own = made === source, map = own ? made.map : null;
            const texture = map ? this.#texture(map.data, map.width, map.height, 1, map.wrap) : undefined;
            return { mesh: number, triangles: made.indices.length / 3, texture, tint: own ? made.tint : null };
        }

        /** The same of arrays as they are: v downward, and normals "flat", "smooth" or three numbers a vertex. */
        _mesh(source) {
            const got = check.record("mesh", source, ["positions", "indices", "normals", "uv"]);
            const positions = check.rows("positions", got.positions, 3), vertices = positions.length / 3;
            if (!positions.every(Number.isFinite)) throw new ShadeError("positions must hold finite numbers");
            const indices = check.indices("indices", got.indices, vertices, "bad indices");
            const given = check.isArray(got.normals);
            const kind = given ? "flat" : check.choice("normals", got.normals ?? "flat", ["flat", "smooth"]);
            const arrays = [positions, given ? check.rows("normals", got.normals, 3) : null,
                            got.uv ? check.rows("uv", got.uv, 2) : null, indices];
            [[1, 3, "normals"], [2, 2, "uv"]].forEach(([k, width, name]) => {
                if (arrays[k] && arrays[k].length !== width * vertices) {
                    throw new ShadeError(`${name} must have a row for each of ${vertices} vertices`);
                }
            });
            const made = withMemory((room) => {
                const at = arrays.map((array) => (array ? put(room(array.byteLength || 4), array) : 0));
                const set = { positions: at[0], normals: at[1], texcoords: at[2], vertex_count: vertices,
                              indices: at[3], index_count: indices.length };
                const ask = Uint32Array.from(MESH, (name) => set[name] ?? 0);
                return library.scene_mesh(this.#scene, put(room(4 * MESH.length), ask), kind === "smooth" ? 1 : 0);
            });
            if (made < 0) throw new RangeError("memory is not enough for the mesh");
            this.#meshes++;
            return { mesh: made, triangles: indices.length / 3 };
        }

        /** Ground for add(): rows of heights along y, over x from -half[0] to half[0]. */
        height_field(heights, rows, columns, half) {
            const z = check.vector("heights", heights, rows * columns);
            const [a, b] = Array.from(half), positions = new Float32Array(3 * rows * columns), indices = [];
            if (Math.min(rows, columns) < 2) throw new ShadeError("heights must have two rows and columns at least");
            for (let i = 0, k = 0; i < rows; i++) {
                for (let j = 0; j < columns; j++, k++) {
                    positions.set([2 * a * j / (columns - 1) - a, 2 * b * i / (rows - 1) - b, z[k]], 3 * k);
                    if (i === rows - 1 || j === columns - 1) continue;
                    indices.push(k, k + 1, k + columns + 1, k, k + columns + 1, k + columns);
                }
            }
            return this._mesh({ positions, indices, normals: "smooth" });
        }

        /** A picture { data, width, height } of RGBA bytes for add(); with faces 6 a cube's, one below the
         *  other, +x, -x, +y, -y, +z, -z as in OpenGL.  Mipmaps are made of it.  wrap is that of Texture. */
        texture({ data, width, height, faces = 1, wrap = ["repeat", "repeat"] }) {
            return this.#texture(data, width, height, faces, check.wraps("wrap", wrap));
        }

        #texture(data, width, height, faces, wrap) {
            check.integer("width", width, 1, 16384);
            check.integer("height", height, 1, 16384);
            if (faces !== 1 && (faces !== 6 || height !== 6 * width)) {
                throw new ShadeError("faces must be 1, or 6 with height = 6 width");
            }
            if (!check.isArray(data) || data.length !== 4 * width * height) {
                throw new ShadeError(`data must hold ${4 * width * height} bytes`);
            }
            const made = withMemory((room) => library.scene_texture(
                this.#scene, put(room(data.length), Uint8Array.from(data)), width, height / faces, faces,
                this.srgb ? 1 : 0, ...wrap));
            if (made < 0) throw new RangeError("memory is not enough for the texture");
            this.#cubes.push(faces === 6);
            return made;
        }

        /** A texture of 2 x 2 squares, which repeats. */
        checker(one = "#5a6e82", other = "#8fa3b5") {
            const data = new Uint8Array(4 * 64 * 64).fill(255);
            const colors = [one, other].map((c) => check.color("color", c).map((x) => Math.round(255 * x)));
            for (let i = 0; i < 64 * 64; i++) data.set(colors[(i < 2048) !== (i % 64 < 32) ? 0 : 1], 4 * i);
            return this.texture({ data, width: 64, height: 64 });
        }

        #color(name, value) {
            const rgb = Float32Array.from(check.color(name, value));
            return this.srgb ? linear(rgb) : rgb;
        }

        /** Adds an object, of "plane", "sphere", "ellipsoid", "capsule", "cylinder", "box" or what mesh()
         *  and height_field() return, and gives its number, which ids have. */
        add(shape, size, options) {
            const got = check.record("options", options,
                ["at", "pose", "color", "alpha", "specular", "shininess", "emission", "texture", "repeat",
                 "two_sided", "casts_shadow"]);
            const bytes = new ArrayBuffer(4 * OBJECT), ints = new Int32Array(bytes);
            const floats = new Float32Array(bytes);
            if (typeof shape === "string") {
                check.choice("shape", shape, Object.keys(KINDS));
                ints[0] = KINDS[shape];
                floats.set(this.#size(shape, size), 4);
            } else {
                check.integer("shape", shape?.mesh, 0, this.#meshes - 1);
                ints[1] = shape.mesh;
                floats.set(size === undefined ? [1, 1, 1] : check.isArray(size) ? check.vector("size", size, 3)
                                                          : [size, size, size], 4);
            }
            const texture = got.texture ?? shape.texture;
            ints[2] = texture === undefined ? -1 : check.integer("texture", texture, 0, this.#cubes.length - 1);
            ints[3] = (got.two_sided ? TWO_SIDED : 0) | (got.casts_shadow === false ? NO_SHADOW : 0);
            const light = this.srgb ? (x) => x : check.encoded;
            floats.set(this.#color("color", got.color ?? "white").map((x, k) => x * light(shape.tint?.[k] ?? 1)), 19);
            floats[22] = check.number("alpha", got.alpha ?? 1, 0, 1);
            floats[23] = check.number("specular", got.specular ?? 0, 0, 1e6);
            floats[24] = check.number("shininess", got.shininess ?? 32, 0, 1e6);
            floats[25] = check.number("emission", got.emission ?? 0, 0, 1e6);
            floats.set(check.vector("repeat", got.repeat ?? [1, 1], 2), 26);
            floats.set([1, 0, 0, 0, 1, 0, 0, 0, 1, ...check.vector("at", got.at ?? [0, 0, 0], 3)], 7);
            this._put(this.#count, floats);
            if (got.pose !== undefined) {
                this.#count--;
                const { turn, place } = rigid("pose", got.pose);
                floats.set([...turn, ...place], 7);
                this._put(this.#count, floats);
            }
            return this.#count - 1;
        }

        #size(shape, size) {
            if (size === undefined && shape === "plane") return [0, 0, 0];
            const count = Math.max(...SIZES[shape]) + 1;
            const got = check.vector("size", check.isArray(size) ? size : [size], count);
            if (!got.every((x) => x > 0)) throw new ShadeError(`size of a ${shape} must be positive`);
            return SIZES[shape].map((k) => got[k]);
        }

        /** The words of object number, or of one more. */
        _put(number, words) {
            if (4 * OBJECT * (number + 1) > this.#objects.byteLength) {
                const grown = new ArrayBuffer(2 * 4 * OBJECT * (number + 8));
                new Uint8Array(grown).set(new Uint8Array(this.#objects));
                this.#objects = grown;
            }
            new Float32Array(this.#objects).set(words, OBJECT * number);
            new Int32Array(this.#objects).set(new Int32Array(words.buffer, words.byteOffset, 4), OBJECT * number);
            this.#count = Math.max(this.#count, number + 1);
        }

        /** Leaves the first objects alone. */
        _keep(count) { this.#count = count; }

        /** Moves an object: 4 x 4 by columns, a rotation and a translation. */
        pose(number, pose) {
            check.integer("number", number, 0, this.#count - 1);
            const { turn, place } = rigid(`pose of object ${number}`, pose);
            new Float32Array(this.#objects).set([...turn, ...place], OBJECT * number + 7);
        }

        /** Moves all objects: a matrix for each; nothing moves where one is refused. */
        poses(poses) {
            if (poses?.length !== this.#count) throw new ShadeError(`poses must hold ${this.#count} matrices`);
            const got = Array.from(poses, (pose, i) => rigid(`poses[${i}]`, pose)), floats = new Float32Array(this.#objects);
            got.forEach(({ turn, place }, i) => floats.set([...turn, ...place], OBJECT * i + 7));
        }

        /** Hides an object, or shows it again. */
        show(number, visible = true) {
            check.integer("number", number, 0, this.#count - 1);
            const flags = new Int32Array(this.#objects, 4 * (OBJECT * number + 3), 1);
            flags[0] = (flags[0] & ~HIDDEN) | (visible ? 0 : HIDDEN);
        }

        // ---- what it is lit by

        /** Up to 8 lamps, ambient light, and the number of the one lamp that casts shadows. */
        light(lights, ambient = [0, 0, 0], shadow = undefined) {
            if (lights.length > LAMPS) throw new ShadeError(`lights: at most ${LAMPS} lamps are drawn, not ${lights.length}`);
            const { lights: rows } = check.lighting("light", { lights });
            const lamps = new Float32Array(Math.max(1, rows.length) * LIGHT);
            rows.forEach((row, i) => lamps.set(row, LIGHT * i));
            let number = -1;
            if (shadow !== undefined) {
                number = check.integer("shadow", shadow, 0, rows.length - 1);
                const row = rows[number];
                if (row[3] !== 0 && !(row[16] || row[17] || row[18])) {
                    throw new ShadeError(`shadow: lights[${number}] is a point; directional lamps and spots can cast shadows`);
                }
            }
            Object.assign(this.#state, { lamps, count: rows.length, shadow: number,
                                         ambient: check.vector("ambient", ambient, 3) });
        }

        /** One colour behind all objects. */
        background(color) {
            Object.assign(this.#state, { background: [...this.#color("color", color), 1], sky: 0 });
        }

        /** A sky from the colour straight below to that straight above, +z. */
        sky(low = "#dfe8f0", high = "#4a7ab0") {
            Object.assign(this.#state, { sky: 1, low: this.#color("low", low), high: this.#color("high", high) });
        }

        /** A sky of a cube texture, whose +y is up (+z of the world), as in OpenGL. */
        sky_texture(texture) {
            check.integer("texture", texture, 0, this.#cubes.length - 1);
            if (!this.#cubes[texture]) throw new ShadeError(`texture ${texture} is no cube`);
            Object.assign(this.#state, { sky: 2, skyTexture: texture });
        }

        // ---- pictures

        /** New arrays for render(). */
        frame({ color = true, depth = true, ids = true, normals = false } = {}) {
            const pixels = this.height * this.width;
            return { color: color ? new Uint8Array(3 * pixels) : null, depth: depth ? new Float32Array(pixels) : null,
                     ids: ids ? new Int32Array(2 * pixels) : null, normals: normals ? new Float32Array(3 * pixels) : null };
        }

        /** Draws what a camera { view, projection }, matrices of WebGL, sees, into the arrays of out or new ones. */
        render(camera, out = this.frame(), options = undefined) {
            const got = check.record("options", options, ["solid", "empty_depth"]);
            const view = check.vector("camera.view", camera?.view, 16);
            const projection = check.vector("camera.projection", camera?.projection, 16);
            return this._draw(out, view, projection, rangeOf(projection), got.solid ?? false,
                              got.empty_depth ?? Infinity);
        }

        _draw(out, view, projection, { near, far, parallel }, solid, emptyDepth) {
            const pixels = this.height * this.width, s = this.#state, scene = this.#scene;
            const channels = out.color?.length === 4 * pixels ? 4 : 3;
            for (const [name, width] of [["color", channels], ["depth", 1], ["ids", 2], ["normals", 3]]) {
                if (out[name] && out[name].length !== width * pixels) {
                    throw new ShadeError(`out.${name} must hold ${width * pixels} numbers, not ${out[name].length}`);
                }
            }
            const at = {}, sizes = { color: channels, depth: 4, ids: 8, normals: 12 };
            for (const name of Object.keys(sizes)) at[name] = out[name] ? kept(name, sizes[name] * pixels) : 0;
            const objects = new Uint8Array(this.#objects, 0, 4 * OBJECT * this.#count);
            at.objects = kept("objects", this.#objects.byteLength + 4);
            at.lights = kept("lights", 4 * LIGHT * LAMPS);
            const shot = kept("shot", 4 * SHOT);
            put(at.objects, objects);
            put(at.lights, s.lamps);
            const ints = new Int32Array(library.memory.buffer, shot, SHOT);
            const floats = new Float32Array(library.memory.buffer, shot, SHOT);
            ints.set([this.width, this.height, this.samples, channels, this.srgb ? 1 : 0, solid ? 1 : 0, parallel,
                      this.#count, s.count, s.shadow, s.sky, s.skyTexture]);
            floats.set([near, far, emptyDepth, this.tolerance, ...view, ...projection, ...s.background, ...s.low,
                        ...s.high, ...s.ambient], 12);
            ints.set([at.objects, at.lights, at.color, at.depth, at.ids, at.normals], 61);
            succeed("camera", library.renderer_draw(scratch, scene, shot));
            for (const [name, Kind, width] of [["color", Uint8Array, channels], ["depth", Float32Array, 1],
                                               ["ids", Int32Array, 2], ["normals", Float32Array, 3]]) {
                if (out[name]) out[name].set(new Kind(library.memory.buffer, at[name], width * pixels));
            }
            return out;
        }

        free() {
            forgotten.unregister(this);
            if (this.#made) library.scene_close(this.#made);
            this.#made = 0;
        }
    };
}
