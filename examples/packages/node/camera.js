// Cameras: views from the world and projections, as matrices of WebGL, by columns.  The core makes them.
import * as check from "./arguments.js";

const { ShadeError, choice, flag, isArray, matrix, record, vector } = check;
const FOV = 28, MARGIN = 1.08, PLACE = 20;    // PLACE: numbers of a core_place: pose, origin, reach
const AXES = ["x", "y", "z", "-x", "-y", "-z"];

/** 4 x 4 by columns, row by row */
const byRows = (m) => Float64Array.from(m, (_, k) => m[4 * (k % 4) + Math.floor(k / 4)]);

/** A number of any size, which the core looks at */
function oneNumber(name, value) {
    if (typeof value === "number") return value;
    throw new ShadeError(`${name} must be a number, not ${value === undefined ? "missing" : typeof value}`);
}

/** So many numbers of any size, which the core looks at */
function numbers(name, value, ...counts) {
    const got = check.doubles(name, value, 1);
    if (counts.includes(got.length)) return got;
    throw new ShadeError(`${name} must hold ${counts.join(" or ")} numbers, not ${got.length}`);
}

/** The cameras, over the functions of index.js that know the module's memory. */
export function camerasOf({ library, withMemory, put, text, asked }) {
    const doubles = (at, count) => new Float64Array(library.memory.buffer, at, count);
    const VIEWS = {};
    withMemory((room) => {
        const angles = room(16);
        for (let i = 0, at; (at = library.view_name(i, angles)); i++) VIEWS[text(at)] = [...doubles(angles, 2)];
    });

    /** Meshes in a world that counts from an origin: { origin, placed }. */
    function placed(meshes) {
        return withMemory((room) => {
            const rows = meshes.map(({ pose, origin, reach }) => [...pose, ...origin, reach]);
            const at = put(room(8 * PLACE * meshes.length + 8), Float64Array.from(rows.flat())), out = room(24);
            library.place_all(at, meshes.length, out);
            return { origin: [...doubles(out, 3)],
                     placed: meshes.map((mesh, i) => ({ mesh, pose: doubles(at + 8 * PLACE * i, 16).slice() })) };
        });
    }

    const listed = (room, near) => [
        put(room(4 * near.length + 4), Uint32Array.from(near, ({ mesh }) => mesh.address)),
        put(room(8 * PLACE * near.length + 8), Float64Array.from(near.flatMap(({ pose }) => [...pose, 0, 0, 0, 0]))),
        near.length];

    const read = (at) => ({ view: Float32Array.from(doubles(at, 16)), projection: Float32Array.from(doubles(at + 128, 16)) });

    /** A core_side */
    function sideOf(room, view, up, width, height, ortho, ...others) {
        const angles = isArray(view) ? (vector("view", view, 2), view) : VIEWS[choice("view", view, Object.keys(VIEWS))];
        const axis = AXES.indexOf(choice("up", up, ["y", "z"])), side = room(56);
        doubles(side, 2).set(angles);
        new Int32Array(library.memory.buffer, side + 16, 4).set([axis, width, height, flag("ortho", ortho) ? 1 : 0]);
        doubles(side + 32, 3).set(others);
        return side;
    }

    /** The nearest camera that sees all meshes from a side: { view, projection }.  room is how much deeper
     *  than the meshes the picture reaches, as a part of their extent. */
    function fitted(near, view, [width, height], up, ortho, deeper) {
        return withMemory((room) => {
            const side = sideOf(room, view, up, width, height, ortho, FOV, MARGIN, deeper), out = room(256);
            asked(library.fit, side, ...listed(room, near), out);
            return read(out);
        });
    }

    /** 4 x 4 by columns: takes the meshes to the studio, about the origin and within distance 1, with +y up
     *  and +z toward the eye. */
    function studio(near, { view }, up) {
        const axis = AXES.indexOf(choice("up", up, ["y", "z"]));
        return withMemory((room) => {
            const out = room(128), from = put(room(128), Float64Array.from(view));
            library.studio(...listed(room, near), from, axis, out);
            return Float32Array.from(doubles(out, 16));
        });
    }

    /** Refuses a view by columns that is more than a rotation and a translation. */
    function rigid(name, view) {
        if (withMemory((room) => library.not_rigid(put(room(128), byRows(view)), 1)) < 0) return;
        throw new ShadeError(`${name} must be a rotation and a translation, without scale or mirror`);
    }

    /** near, far and whether the projection, by columns, is parallel */
    function rangeOf(name, projection) {
        return withMemory((room) => {
            const out = room(24), words = put(room(128), Float64Array.from(projection));
            asked(library.range_of, put(room(64), new TextEncoder().encode(`${name}\0`)), words, out);
            const [near, far] = doubles(out, 2);
            return { near, far, parallel: new Int32Array(library.memory.buffer, out + 16, 1)[0] };
        });
    }

    /** The camera that a caller describes by its matrices, in a world that counts from an origin. */
    function given(value, origin) {
        const { view, projection } = record("view", value, ["view", "projection"]);
        const camera = { view: matrix("view.view", view), projection: vector("view.projection", projection, 16) };
        const m = camera.view;
        rigid("view.view", m);
        for (let k = 0; k < 3; k++) m[12 + k] += m[k] * origin[0] + m[4 + k] * origin[1] + m[8 + k] * origin[2];
        camera.view = Float32Array.from(m);
        return camera;
    }

    /** A camera of the core, which takes its matrices as arguments */
    function made(call, arrays, ...others) {
        return withMemory((room) => {
            const at = arrays.map((numbers) => put(room(8 * numbers.length + 8), Float64Array.from(numbers))), out = room(256);
            asked(call, ...at, ...others, out);
            return { view: doubles(out, 16).slice(), projection: doubles(out + 128, 16).slice() };
        });
    }

    /** Cameras as { view, projection }: see index.d.ts. */
    const Camera = {
        lookAt(eye, target = [0, 0, 0], options = undefined) {
            const { up = [0, 0, 1], fov = 45, aspect, near = 0.01, far = 1000 } =
                record("options", options, ["up", "fov", "aspect", "near", "far"]);
            return made(library.look_at, [[...numbers("eye", eye, 3), ...numbers("target", target, 3), ...numbers("up", up, 3),
                                           ...Object.entries({ fov, aspect, near, far }).map((one) => oneNumber(...one))]]);
        },
        opencv(K, extrinsics, size, options = undefined) {
            const { near = 0.01, far = 1000 } = record("options", options, ["near", "far"]);
            const [width, height] = check.size("size", size), whole = [...numbers("extrinsics", extrinsics, 12, 16)];
            if (whole.length === 12) whole.push(0, 0, 0, 1);
            return { ...made(library.opencv, [numbers("K", K, 9), whole], width, height, oneNumber("near", near),
                             oneNumber("far", far)), size: [width, height] };
        },
        opengl(projection, pose) {
            return made(library.opengl, [numbers("projection", projection, 16), byRows(numbers("pose", pose, 16))]);
        },
        fitted(positions, options = undefined) {
            const { view = "iso", size = [640, 480], up = "z", ortho = false, fov = FOV, margin = MARGIN } =
                record("options", options, ["view", "size", "up", "ortho", "fov", "margin"]);
            const [width, height] = check.size("size", size), points = check.rows("positions", positions, 3);
            return withMemory((room) => {
                const at = put(room(points.byteLength + 4), points), out = room(256);
                const side = sideOf(room, view, up, width, height, ortho, oneNumber("fov", fov), oneNumber("margin", margin), 0);
                asked(library.fit_points, side, at, points.length / 3, out);
                return { view: doubles(out, 16).slice(), projection: doubles(out + 128, 16).slice() };
            });
        },
    };

    return { Camera, placed, fitted, studio, rigid, rangeOf, given };
}
