// Cameras for simulators, learners and graders: one scene, many pictures of colour, depth, numbers of
// objects and normals.  Names and bytes are those of the package for Python.
import * as check from "./arguments.js";

const { ShadeError } = check;

// Words of renderer_object, renderer_picture, shade_light, renderer_image, renderer_moved and heights
const OBJECT = 58, SHOT = 68, LIGHT = 21, IMAGE = 8, MOVED = 14, GROUND = 14;
const KINDS = { plane: 1, sphere: 2, ellipsoid: 3, capsule: 4, cylinder: 5, box: 6 };
// What the numbers of a size are for x, y and z
const SIZES = { plane: [0, 1, 1], sphere: [0, 0, 0], ellipsoid: [0, 1, 2], capsule: [0, 0, 1],
                cylinder: [0, 0, 1], box: [0, 1, 2] };
const HIDDEN = 1, TWO_SIDED = 2, NO_SHADOW = 4, BLENDED = 8, HEIGHTS = 16, UNLIT = 32, LAMPS = 8;
// Where the fields of renderer_object begin, in words
const AT = { kind: 24, mesh: 25, texture: 26, flags: 27, id: 28, first: 29, count: 30, size: 31, rgba: 34,
             specular: 38, shininess: 41, emission: 42, glow: 43, repeat: 46, metal: 48, tint: 49,
             cutoff: 50, relief: 51, glow_map: 52, strength: 53, glow_factor: 54 };
// Place and turn are doubles, before all.
const PLACE = 0, TURN = 3, POSE = 12;
const NOT_RIGID = "must be a rotation and a translation, without scale, by columns";
const FRAME = ["color", "depth", "ids", "normals"];
const LOOKS = ["color", "alpha", "specular", "shininess", "emission", "texture", "repeat", "two_sided", "casts_shadow"];

function pictured(value) {
    const got = check.record("picture", value, ["data", "width", "height", "wrap", "squares", "faces"]);
    if (got !== value) throw new ShadeError("picture must be an object with data, width and height");
    return got;
}

/** An object without a texture, in white, at the origin; floats and ints are the same words. */
function plainRecord() {
    const floats = new Float32Array(OBJECT), ints = new Int32Array(floats.buffer);
    const doubles = new Float64Array(floats.buffer, 0, POSE);
    doubles.set([1, 0, 0, 0, 1, 0, 0, 0, 1], TURN);
    floats.fill(1, AT.rgba, AT.rgba + 4);
    floats[AT.shininess] = 32;
    floats.fill(1, AT.repeat, AT.repeat + 2);
    return { floats, ints, doubles };
}

/** The least number that is not taken. */
function free(taken) {
    const all = new Set(taken);
    let number = 0;
    while (all.has(number)) number++;
    return number;
}

/** An object of a renderer: what add() gives, and its number where a number is wanted */
class Solid {
    #of; #number;

    constructor(of, number) { [this.#of, this.#number] = [of, number]; }

    get renderer() { return this.#of; }
    get number() { return this.#number; }
    valueOf() { return this.#number; }
    toString() { return `${this.#number}`; }
    toJSON() { return this.#number; }
    [Symbol.for("nodejs.util.inspect.custom")]() { return `Solid ${this}`; }    // what console.log shows

    /** From the object to the world, 4 x 4 by columns.  Assigned, it moves: as a matrix or as a place. */
    get pose() { return this.#of._pose(this); }
    set pose(value) {
        const m = this.pose;
        if (value?.length === 3) m.set(check.place("pose", value), 12);
        this.#of.pose(this, value?.length === 3 ? m : value);
    }

    /** As add() and change() take it */
    get color() { return this.#of._options(this).color ?? "white"; }
    set color(value) { this.#of.change(this, { color: value }); }

    change(options) { this.#of.change(this, options); }
    show(visible = true) { this.#of.show(this, visible); }

    /** Takes it away; its number is not given again. */
    remove() { this.#of.remove(this); }
}

/** A matrix of 4 x 4 by columns, row by row. */
function rows(name, value) {
    const m = check.matrix(name, value);
    return Array.from({ length: 16 }, (_, k) => m[4 * (k % 4) + Math.floor(k / 4)]);
}

/** A copy of options, whose arrays the caller may change afterwards */
function own(options) {
    return Object.fromEntries(Object.entries(options).map(([name, value]) => [name, check.isArray(value) ? value.slice() : value]));
}

/** The class, over the functions of index.js that know the module's memory. */
export function rendererOf({ library, take, put, withMemory, linear, succeed, prepared, localOf, cameras }) {
    [[4, OBJECT], [5, SHOT], [3, LIGHT], [9, IMAGE], [11, MOVED], [12, GROUND]].forEach(([i, words]) => {
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

    /** What each call does is said in index.d.ts. */
    return class Renderer {
        #made = library.scene_open();
        #shown = new Map();    // object to { shape, options, solid }: as add() took them, and what it gave
        #meshes = new Map();   // number to shape
        #textures = new Map(); // number to { slot, cube, owned }: whether it came with a shape
        #nextTexture = 0;
        #behind = { sky: 0, background: [1, 1, 1, 1] };

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
            this.#setBehind({});
            this.light([{ position: [0.5, -1, 1.2, 0], diffuse: [0.75, 0.75, 0.75],
                          specular: [0.75, 0.75, 0.75] }], [0.25, 0.25, 0.25]);
        }

        /** Where the module keeps the scene */
        get #scene() {
            if (!this.#made) throw new ShadeError("renderer was freed");
            return this.#made;
        }
        get _at() { return this.#scene; }

        // ---- what is drawn

        mesh(source) { return this.#taken(source, free(this.#meshes.keys())); }

        #taken(source, number) {
            const made = prepared(source);
            if (!made.positions.every(Number.isFinite)) throw new ShadeError("positions must hold finite numbers");
            const kept = library.scene_made(this.#scene, number, made.address, ...made.origin);
            if (made !== source) made.free();
            if (!kept) throw new RangeError("memory is not enough for the mesh");
            const shape = this.#shape(number, made.indices.length / 3), { indices, quick, positions } = made;
            if (made === source) this.#dress(shape, made);
            else Object.assign(shape, { source: own({ ...source, positions: null }), indices, quick, vertices: positions.length / 3 });
            return shape;
        }

        #shape(number, triangles) {
            const shape = { mesh: number, triangles, record: plainRecord(), textures: [] };
            shape.record.ints[AT.mesh] = number;
            if (!this.#meshes.has(number)) this.#meshes.set(number, shape);
            return shape;
        }

        /** What a Mesh looks like. */
        #dress(shape, { maps, tint, opacity, blend, cutoff, own, material, strength, glowFactor, unlit, address }) {
            const { floats, ints } = shape.record, shown = (rgb) => (this.srgb ? rgb : rgb.map(check.encoded));
            ["texture", "relief", "glow_map"].forEach((name, i) => {
                if (!maps[i]) return;
                const number = this.#texture(maps[i], null, maps[i].wrap, name !== "relief");
                ints[AT[name]] = 1 + this.#textures.get(number).slot;
                shape.textures.push(number);
                this.#textures.get(number).owned = true;
            });
            floats[AT.strength] = strength;
            floats.set(shown(glowFactor), AT.glow_factor);
            if (unlit) ints[AT.flags] |= UNLIT;
            if (library.mesh_heights(address)) ints[AT.flags] |= HEIGHTS;
            if (tint) floats.set(shown(tint), AT.rgba);
            if (own) {
                floats.set(shown(material.slice(9, 12)), AT.specular);
                floats.set(shown(material.slice(0, 3)), AT.glow);
                floats[AT.shininess] = material[12];
            }
            if (blend) {
                floats[AT.rgba + 3] = opacity;
                if (maps[0]) ints[AT.flags] |= BLENDED;
            }
            floats[AT.cutoff] = cutoff;
        }

        update(shape, source, options = undefined) {
            this.#known(shape);
            const others = check.record("options", options, ["indices", "normals", "uv", "colors"]);
            const moves = check.isArray(source) && !shape.ground;
            if (moves && !shape.source) throw new ShadeError("source must be a Mesh: the shape was made of one");
            if (!moves && options !== undefined) throw new ShadeError("options go with an array of positions");
            if (moves && this.#moved(shape, source, others)) return;
            const whole = moves ? { ...shape.source, ...others, positions: source } : source;
            this.#atOnce(() => {
                const made = shape.ground ? this.#ground(whole, ...shape.ground, shape.mesh) : this.#taken(whole, shape.mesh);
                const gone = shape.textures;
                Object.assign(shape, made);
                for (const [number, { shape: of, options }] of this.#shown) {
                    if (of === shape) this.#write(number, this.#dressed(number, shape, options));
                }
                gone.forEach((texture) => this.#drop(texture));
            });
        }

        /** Moves the vertices of a shape, where nothing else of it changes: false where more does. */
        #moved(shape, value, { normals = shape.source.normals, ...others }) {
            const given = check.isArray(normals) ? 2 : ["flat", "smooth"].indexOf(normals), { indices } = shape;
            if (Object.keys(others).length || given < 0 || given !== shape.quick) return false;
            const exact = check.doubles("positions", value, 3), vertices = exact.length / 3;
            const directions = given === 2 ? check.rows("normals", normals, 3) : null;
            if (vertices !== shape.vertices || (directions && directions.length !== exact.length)) return false;
            const { positions, origin } = localOf(exact, indices);
            const done = withMemory((room) => {
                const at = [positions, directions, indices].map((array) => (array ? put(room(array.byteLength + 4), array) : 0));
                const ask = new Float64Array(MOVED / 2);
                new Uint32Array(ask.buffer).set([...at, vertices, indices.length, given]);
                ask.set(origin, 4);
                return library.scene_deform(this.#scene, shape.mesh, put(room(4 * MOVED), ask));
            });
            if (done === -2) throw new ShadeError("positions must hold finite numbers");
            if (done === 0) throw new RangeError("memory is not enough for the mesh");
            if (done > 0 && directions) shape.source.normals = directions.slice();
            return done > 0;
        }

        height_field(heights, rows, columns, half) {
            const shape = this.#ground(heights, rows, columns, half, free(this.#meshes.keys()));
            return Object.assign(shape, { ground: [rows, columns, Float64Array.from(half)] });
        }

        #ground(heights, rows, columns, half, number) {
            for (const [name, count] of Object.entries({ rows, columns })) check.integer(name, count, 2, 1e6);
            const z = check.vector("heights", heights, rows * columns);
            if (!check.vector("half", half, 2).every((x) => x > 0)) throw new ShadeError("half must be positive");
            return this.#shape(number, this._heights(number, z, rows, columns, [...half, 1]));
        }

        /** Puts ground in the place of a mesh, and returns its triangles; with a base it has sides down to that. */
        _heights(number, heights, rows, columns, [a, b, scale, base = -1]) {
            const triangles = withMemory((room) => {
                const ask = new Float64Array(GROUND / 2), z = Float32Array.from(heights);
                new Int32Array(ask.buffer).set([put(room(z.byteLength), z), rows, columns]);
                ask.set([a, b, scale, base], 2);
                new Int32Array(ask.buffer)[12] = base < 0 ? 0 : 1;
                return library.scene_heights(this.#scene, number, put(room(4 * GROUND), ask));
            });
            if (!triangles) throw new RangeError("memory is not enough for the mesh");
            return triangles;
        }

        texture(picture) { return this.#texture(pictured(picture), null); }

        update_texture(number, picture) {
            const { cube } = this.#textureOf("number", number);
            if (cube !== (picture?.faces === 6)) {
                throw new ShadeError(`picture: texture ${number} is ${cube ? "" : "no "}cube, and the picture is not`);
            }
            this.#texture(pictured(picture), number);
        }

        #textureOf(name, number) {
            check.integer(name, number, 0, 2 ** 31 - 1);
            if (!this.#textures.has(number)) throw new ShadeError(`${name}: there is no texture ${number}`);
            return this.#textures.get(number);
        }

        #texture(picture, number, wrap = check.wraps("", picture), colors = true) {
            const { data, width, height, faces = 1 } = picture;
            check.integer("width", width, 1, 16384);
            check.integer("height", height, 1, 16384);
            if (faces !== 1 && (faces !== 6 || height !== 6 * width)) {
                throw new ShadeError("faces must be 1, or 6 with height = 6 width");
            }
            if (!check.isArray(data) || data.length !== 4 * width * height) {
                throw new ShadeError(`data must hold ${4 * width * height} bytes`);
            }
            const old = this.#textures.get(number);
            const slot = old?.slot ?? free([...this.#textures.values()].map((texture) => texture.slot));
            const made = withMemory((room) => {
                const bytes = put(room(data.length), check.bytesOf("data", data));
                const image = Uint32Array.of(bytes, width, height / faces, faces, this.srgb && colors ? 1 : 0, ...wrap);
                return library.scene_texture(this.#scene, slot, put(room(4 * IMAGE), image));
            });
            if (!made) throw new RangeError("memory is not enough for the texture");
            const named = number ?? this.#nextTexture++;
            this.#textures.set(named, { slot, cube: faces === 6, owned: old?.owned ?? false });
            return named;
        }

        checker(one = "#5a6e82", other = "#8fa3b5") {
            const data = new Uint8Array(4 * 64 * 64).fill(255);
            const colors = Object.entries({ one, other }).map((c) => check.color(...c).map((x) => Math.round(255 * x)));
            for (let i = 0; i < 64 * 64; i++) data.set(colors[(i < 2048) !== (i % 64 < 32) ? 0 : 1], 4 * i);
            return this.texture({ data, width: 64, height: 64 });
        }

        #color(name, value) {
            const rgb = Float32Array.from(check.color(name, value));
            return this.srgb ? linear(rgb) : rgb;
        }

        add(shape, size, options) {
            const got = check.record("options", options, ["at", "pose", ...LOOKS]), { at = [0, 0, 0], pose, ...looks } = got;
            if (typeof shape === "string") check.choice("shape", shape, Object.keys(KINDS));
            else this.#known(shape);
            const { floats, doubles } = this.#record(shape, looks);
            if (got.at && pose !== undefined) throw new ShadeError("at does not go with pose, which has a place");
            floats.set(this.#size(shape, size), AT.size);
            doubles.set(check.place("at", at), PLACE);
            if (pose !== undefined) {
                const m = this.#rigid(() => "pose", this.#matrices(() => "pose", 1, [pose]));
                for (let k = 0; k < 3; k++) {
                    doubles[PLACE + k] = m[4 * k + 3];
                    doubles.set(m.slice(4 * k, 4 * k + 3), TURN + 3 * k);
                }
            }
            const number = withMemory((room) => library.scene_add(this.#scene, put(room(4 * OBJECT), floats), 1));
            if (number < 0) throw new RangeError("memory is not enough for the object");
            const solid = new Solid(this, number);
            this.#shown.set(number, { shape, options: own(looks), solid });
            return solid;
        }

        object(number) { return this.#shown.get(this.#number("number", number)).solid; }

        change(number, options) {
            const at = this.#number("number", number);
            const { size, ...looks } = check.record("options", options, ["size", ...LOOKS]);
            const shown = this.#shown.get(at), { shape } = shown, all = { ...shown.options, ...own(looks) };
            const { floats, ints } = this.#dressed(at, shape, all);
            if (size !== undefined) floats.set(this.#size(shape, size), AT.size);
            this.#write(at, { floats, ints });
            shown.options = all;
        }

        /** The record of an object by now, where it is, with other looks */
        #dressed(number, shape, options) {
            const old = this.#recordOf(number), record = this.#record(shape, options);
            record.ints[AT.id] = number;
            record.ints[AT.flags] |= old.ints[AT.flags] & HIDDEN;
            record.floats.set(old.floats.subarray(AT.size, AT.rgba), AT.size);
            record.ints.set(old.ints.subarray(0, 2 * POSE));
            return record;
        }

        #record(shape, got) {
            const floats = new Float32Array((shape.record ?? plainRecord()).floats), ints = new Int32Array(floats.buffer);
            if (typeof shape === "string") ints[AT.kind] = KINDS[shape];
            const color = this.#color("color", got.color ?? "white");
            color.forEach((x, k) => { floats[AT.rgba + k] *= x; });
            floats[AT.rgba + 3] *= check.number("alpha", got.alpha ?? 1, 0, 1);
            if (typeof got.specular === "string" || check.isArray(got.specular)) {
                floats.set(this.#color("specular", got.specular), AT.specular);
            } else if (got.specular !== undefined) {
                floats.fill(check.number("specular", got.specular, 0, 1e6), AT.specular, AT.specular + 3);
            }
            for (const name of ["shininess", "emission"]) {
                if (got[name] !== undefined) floats[AT[name]] = check.number(name, got[name], 0, 1e6);
            }
            if (got.texture !== undefined) {
                ints[AT.texture] = 1 + this.#textureOf("texture", got.texture).slot;
            }
            floats.set(check.vector("repeat", got.repeat ?? [1, 1], 2), AT.repeat);
            for (const name of ["two_sided", "casts_shadow"]) if (got[name] !== undefined) check.flag(name, got[name]);
            ints[AT.flags] |= (got.two_sided ? TWO_SIDED : 0) | (got.casts_shadow === false ? NO_SHADOW : 0);
            return { floats, ints, doubles: new Float64Array(floats.buffer, 0, POSE) };
        }

        #known(shape, name = "shape") {
            if (!shape || this.#meshes.get(shape.mesh) !== shape) throw new ShadeError(`${name} must be of this renderer`);
        }

        /** The number of an object, which may be given as a Solid */
        #number(name, value) {
            if (value instanceof Solid && value.renderer !== this) {
                throw new ShadeError(`${name}: object ${value} is of another Renderer`);
            }
            const number = check.integer(name, value instanceof Solid ? value.number : value, 0, 2 ** 31 - 1);
            void this.#scene;
            if (!this.#shown.has(number)) throw new ShadeError(`${name}: there is no object ${number}`);
            return number;
        }

        /** A copy of an object's record */
        #recordOf(number) {
            const words = withMemory((room) => {
                const at = room(4 * OBJECT);
                library.scene_records(this.#scene, number, at, 1);
                return new Int32Array(library.memory.buffer, at, OBJECT).slice();
            });
            return { ints: words, floats: new Float32Array(words.buffer), doubles: new Float64Array(words.buffer, 0, POSE) };
        }

        _options(number) { return this.#shown.get(this.#number("number", number)).options; }

        _pose(number) {
            const { doubles } = this.#recordOf(this.#number("number", number)), m = new Float64Array(16);
            for (let k = 0; k < 9; k++) m[4 * (k % 3) + Math.floor(k / 3)] = doubles[TURN + k];
            m.set([...doubles.subarray(PLACE, PLACE + 3), 1], 12);
            return m;
        }

        #write(number, { ints }) {
            const done = withMemory((room) => library.scene_put(this.#scene, number, put(room(4 * OBJECT), ints), 1));
            if (!done) throw new RangeError("memory is not enough for the object");
        }

        /** A change of several steps, of which pictures show all or nothing */
        #atOnce(change) {
            if (!library.scene_hold(this.#scene)) throw new RangeError("memory is not enough");
            try { change(); } finally { library.scene_done(this.#scene); }
        }

        /** Matrices, row by row, that are rotations and translations */
        #rigid(named, matrices) {
            const at = (room) => put(room(matrices.byteLength + 8), matrices);
            const bad = withMemory((room) => library.not_rigid(at(room), matrices.length / 16));
            if (bad >= 0) throw new ShadeError(`${named(bad)} ${NOT_RIGID}`);
            return matrices;
        }

        #size(shape, size) {
            if (typeof shape !== "string") {
                return size === undefined ? [1, 1, 1] : check.isArray(size) ? check.vector("size", size, 3)
                    : Array(3).fill(check.number("size", size, -3e38, 3e38));
            }
            if (size === undefined && shape === "plane") return [0, 0, 0];
            if (size === undefined) throw new ShadeError(`size of a ${shape} is missing`);
            const count = Math.max(...SIZES[shape]) + 1;
            const got = check.vector("size", check.isArray(size) ? size : [size], count);
            if (!got.every((x) => x > 0)) throw new ShadeError(`size of a ${shape} must be positive`);
            return SIZES[shape].map((k) => got[k]);
        }

        get objects() { return [...this.#shown.keys()].sort((a, b) => a - b); }

        pose(number, pose) {
            const at = this.#number("number", number);
            this.#move(() => `pose of object ${at}`, [at], [pose]);
        }

        poses(poses, numbers = this.objects) {
            if (!check.isArray(numbers)) throw new ShadeError("numbers must be an array");
            this.#move((i) => `poses[${i}]`, Array.from(numbers, (number, i) => this.#number(`numbers[${i}]`, number)), poses);
        }

        #move(named, numbers, poses) {
            const matrices = this.#matrices(named, numbers.length, poses);
            const refused = withMemory((room) => library.scene_pose(
                this.#scene, put(room(4 * numbers.length + 4), Int32Array.from(numbers)),
                put(room(matrices.byteLength + 8), matrices), numbers.length));
            if (refused >= 0) throw new ShadeError(`${named(refused)} ${NOT_RIGID}`);
        }

        /** So many matrices, row by row */
        #matrices(named, count, poses) {
            if (poses?.length !== count) {
                throw new ShadeError(`${named("").replace("[]", "")} must hold ${count} matrices`);
            }
            return Float64Array.from(Array.from(poses, (pose, i) => rows(named(i), pose)).flat());
        }

        show(number, visible = true) {
            const at = this.#number("number", number), { ints } = this.#recordOf(at);
            check.flag("visible", visible);
            ints[AT.flags] = (ints[AT.flags] & ~HIDDEN) | (visible ? 0 : HIDDEN);
            this.#write(at, { ints });
        }

        remove(what) {
            if (typeof what === "number" || what instanceof Solid) {
                const number = this.#number("what", what);
                library.scene_put(this.#scene, number, 0, 0);
                this.#shown.delete(number);
                return;
            }
            this.#known(what, "what: shape");
            for (const [number, { shape }] of this.#shown) {
                if (shape === what) throw new ShadeError(`what: object ${number} shows the shape; remove that before`);
            }
            library.scene_mesh(this.#scene, what.mesh, 0, 0, 0);
            this.#meshes.delete(what.mesh);
            what.textures.forEach((texture) => this.#drop(texture));
        }

        remove_texture(number) {
            const { owned, slot } = this.#textureOf("number", number), { sky, texture } = this.#behind;
            const shown = this.objects.find((i) => this.#recordOf(i).ints[AT.texture] === 1 + slot);
            const who = shown !== undefined ? `object ${shown}` : owned ? "a shape"
                : sky === 2 && texture === number ? "the sky" : null;
            if (who) throw new ShadeError(`number: ${who} has texture ${number}`);
            this.#drop(number);
        }

        #drop(texture) {
            library.scene_texture(this.#scene, this.#textures.get(texture).slot, 0);
            this.#textures.delete(texture);
        }

        clear() {
            this.#atOnce(() => {
                library.scene_put_all(this.#scene, 0, 0);
                for (const number of this.#meshes.keys()) library.scene_mesh(this.#scene, number, 0, 0, 0);
                [...this.#textures.keys()].forEach((number) => this.#drop(number));
                if (this.#behind.sky === 2) this.#setBehind({ background: this.#behind.background });
            });
            this.#shown.clear();
            this.#meshes.clear();
        }

        // ---- what it is lit by

        light(lights, ambient = [0, 0, 0], shadow = []) {
            void this.#scene;    // a renderer that was freed is refused
            if (!Array.isArray(lights)) throw new ShadeError("lights must be an array");
            if (lights.length > LAMPS) throw new ShadeError(`lights: at most ${LAMPS} lamps are drawn, not ${lights.length}`);
            const { lights: rows } = check.lighting("light", { lights });
            const lamps = new Float32Array(Math.max(1, rows.length) * LIGHT);
            rows.forEach((row, i) => lamps.set(row, LIGHT * i));
            let shadows = 0;
            for (const which of check.isArray(shadow) ? shadow : [shadow]) {
                const number = check.integer("shadow", which, 0, rows.length - 1), row = rows[number];
                if (row[3] !== 0 && !(row[16] || row[17] || row[18])) {
                    throw new ShadeError(`shadow: lights[${number}] is a point; directional lamps and spots can cast shadows`);
                }
                shadows |= 1 << number;
            }
            const places = Float64Array.from(rows.flatMap((row) => [...row.slice(0, 4)])), around = check.vector("ambient", ambient, 3);
            withMemory((room) => library.scene_light(
                this.#scene, put(room(lamps.byteLength), lamps), put(room(places.byteLength + 8), places), rows.length,
                put(room(12), Float32Array.from(around)), shadows));
        }

        /** What is behind all objects, at once; of a texture its number */
        #setBehind({ sky = 0, texture = -1, low = [0, 0, 0], high = [0, 0, 0], background = this.#behind.background }) {
            const slot = sky === 2 ? this.#textures.get(texture).slot : -1;
            withMemory((room) => library.scene_behind(
                this.#scene, sky, slot, put(room(40), Float32Array.of(...background, ...low, ...high))));
            this.#behind = { sky, texture, background };
        }

        background(color) { this.#setBehind({ background: [...this.#color("color", color), 1] }); }

        sky(low = "#dfe8f0", high = "#4a7ab0") {
            this.#setBehind({ sky: 1, low: this.#color("low", low), high: this.#color("high", high) });
        }

        sky_texture(texture) {
            if (!this.#textureOf("texture", texture).cube) throw new ShadeError(`texture ${texture} is no cube`);
            this.#setBehind({ sky: 2, texture });
        }

        // ---- pictures

        frame(wanted = undefined) {
            const { color = true, depth = true, ids = true, normals = false, pictures = 1 } =
                check.record("wanted", wanted, [...FRAME, "pictures"]);
            Object.entries({ color, depth, ids, normals }).forEach((one) => check.flag(...one));
            check.integer("pictures", pictures, 0, 1e6);
            const pixels = pictures * this.height * this.width;
            return { color: color ? new Uint8Array(3 * pixels) : null, depth: depth ? new Float32Array(pixels) : null,
                     ids: ids ? new Int32Array(2 * pixels) : null, normals: normals ? new Float32Array(3 * pixels) : null };
        }

        render(camera, out = this.frame(), options = undefined) {
            return this._draw(out, [this.#seen("camera", camera)], options);
        }

        render_batch(cameras, poses = undefined, out = undefined, options = undefined) {
            const seen = check.isArray(cameras) ? Array.from(cameras) : Array(poses?.length ?? 1).fill(cameras);
            if (poses && poses.length !== seen.length) {
                throw new ShadeError(`poses must have a row for each of ${seen.length} cameras, not ${poses.length}`);
            }
            const shots = seen.map((camera, i) => this.#seen(`cameras[${i}]`, camera));
            shots.forEach((shot, i) => { if (poses) shot.poses = this.#posed(`poses[${i}]`, poses[i]); });
            return this._draw(out ?? this.frame({ pictures: seen.length }), shots, options);
        }

        #seen(name, camera) {
            const view = check.matrix(`${name}.view`, camera?.view);
            const projection = check.vector(`${name}.projection`, camera?.projection, 16);
            cameras.rigid(`${name}.view`, view);
            if (camera.size && (camera.size[0] !== this.width || camera.size[1] !== this.height)) {
                throw new ShadeError(`${name} was made for pictures of ${camera.size.join(" x ")} pixels, not of ${this.width} x ${this.height}`);
            }
            return { view, projection, ...cameras.rangeOf(name, projection) };
        }

        /** Matrices of all objects */
        #posed(name, poses) {
            const named = (i) => `${name}[${i}]`;
            return this.#rigid(named, this.#matrices(named, this.#shown.size, poses));
        }

        /** A picture for each of shots, whose records are objects, one after the other, in place of those that were
         *  added. */
        _draw(out, shots, options) {
            const got = check.record("options", options, ["solid", "empty_depth"]);
            const { solid = false, empty_depth = Infinity } = got;
            check.flag("solid", solid);
            if (typeof empty_depth !== "number") throw new ShadeError("empty_depth must be a number");
            check.record("out", out, FRAME);
            const pixels = this.height * this.width, scene = this.#scene, at = {};
            const channels = out.color?.length === 4 * shots.length * pixels ? 4 : 3;
            const arrays = [["color", channels, 1], ["depth", 1, 4], ["ids", 2, 4], ["normals", 3, 4]];
            const Kinds = { color: [Uint8Array, Uint8ClampedArray], depth: [Float32Array, Float64Array],
                            ids: [Int32Array], normals: [Float32Array, Float64Array] };
            for (const [name, width, bytes] of arrays) {
                const wanted = shots.length * width * pixels;
                if (out[name] && !Kinds[name].some((Kind) => out[name] instanceof Kind)) {
                    throw new ShadeError(`out.${name} must be ${Kinds[name].map((Kind) => Kind.name).join(" or ")}`);
                }
                if (out[name] && out[name].length !== wanted) {
                    throw new ShadeError(`out.${name} must hold ${wanted} numbers, not ${out[name].length}`);
                }
                at[name] = out[name] ? kept(name, bytes * width * pixels) : 0;
            }
            shots.forEach(({ view, projection, near, far, parallel, records, poses }, i) => {
                at.objects = records ? put(kept("objects", records.byteLength + 4), records) : 0;
                at.poses = poses ? put(kept("poses", poses.byteLength + 8), poses) : 0;
                const shot = kept("shot", 4 * SHOT);
                const ints = new Int32Array(library.memory.buffer, shot, SHOT);
                const floats = new Float32Array(library.memory.buffer, shot, SHOT);
                ints.set([this.width, this.height, this.samples, channels, this.srgb ? 1 : 0, solid ? 1 : 0, parallel,
                          records ? records.length / OBJECT : 0, poses ? poses.length / 16 : 0]);
                floats.set([near, far, empty_depth, this.tolerance, 0], 9);
                new Float64Array(library.memory.buffer, shot, SHOT / 2).set(view, 7);
                floats.set(projection, 46);
                ints.set([at.objects, at.poses, at.color, at.depth, at.ids, at.normals], 62);
                succeed("camera", library.renderer_draw(scratch, scene, shot));
                for (const [name, width, bytes] of arrays) {
                    const Kind = bytes === 1 ? Uint8Array : name === "ids" ? Int32Array : Float32Array;
                    const size = width * pixels;
                    if (out[name]) out[name].set(new Kind(library.memory.buffer, at[name], size), i * size);
                }
            });
            return out;
        }

        free() {
            forgotten.unregister(this);
            if (this.#made) library.scene_close(this.#made);
            this.#made = 0;
        }
    };
}
