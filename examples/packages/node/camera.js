// Cameras: a view from the world and a projection, as matrices of WebGL, by columns.
import { ShadeError, choice, flag, isArray, matrix, record, vector } from "./arguments.js";

// Azimuth and elevation in degrees of the views that have names
const VIEWS = {
    front: [0, 0], right: [90, 0], back: [180, 0], left: [270, 0], top: [0, 90], bottom: [0, -90],
    iso: [45, Math.atan(Math.sqrt(0.5)) * 180 / Math.PI],
};
const MARGIN = 1.08, FOV = 28, MOST = 1e8;

const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const norm = (a) => Math.sqrt(dot(a, a));
const scale = (a, s) => a.map((x) => x * s);
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                         a[0] * b[1] - a[1] * b[0]];

/** The rows of a rotation after which back is +z, and up is as near to +y as it can be. */
function facing(back, up) {
    const z = scale(back, 1 / norm(back));
    let x = cross(up, z);
    if (norm(x) < 1e-6 * norm(up)) {
        const size = z.map(Math.abs), axis = [0, 0, 0];
        axis[size.indexOf(Math.min(...size))] = 1;
        x = cross(axis, z);
    }
    x = scale(x, 1 / norm(x));
    return [x, cross(z, x), z];
}

/** The way toward the eye, and the way up. */
function direction(view, up) {
    const [azimuth, elevation] = isArray(view) ? vector("view", view, 2)
                                               : VIEWS[choice("view", view, Object.keys(VIEWS))];
    const a = azimuth * (Math.PI / 180), e = elevation * (Math.PI / 180);
    const back = [Math.sin(a) * Math.cos(e), -Math.cos(a) * Math.cos(e), Math.sin(e)];
    const head = [-Math.sin(a) * Math.sin(e), Math.cos(a) * Math.sin(e), Math.cos(e)];
    const turned = (v) => choice("up", up, ["y", "z"]) === "y" ? [v[0], v[2], -v[1]] : v;
    return [turned(back), turned(head)];
}

/** From where coordinates in a box are counted, so that floats keep their digits: zero, or for a box
    far away a round number near it, of which doubles subtract without rounding. */
export function originOf(low, high) {
    const middle = low.map((x, k) => (x + high[k]) / 2);
    const extent = Math.max(...low.map((x, k) => high[k] - x));
    const far = Math.max(...middle.map(Math.abs));
    if (!Number.isFinite(far) || !Number.isFinite(extent) || far <= 16 * extent) return [0, 0, 0];
    const step = extent > 0 ? Number(`1e${Math.ceil(Math.log10(extent))}`) : 1;
    return middle.map((x) => {
        const half = x / step, whole = Math.round(half);    // ties go to even numbers, as in NumPy
        return (whole - half === 0.5 && whole % 2 ? whole - 1 : whole) * step;
    });
}

/** The box around the rows that are finite and fit floats; marks leaves others out. */
export function boxOf(rows, marks) {
    const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
    for (let i = 0; i < rows.length; i += 3) {
        const most = Math.max(Math.abs(rows[i]), Math.abs(rows[i + 1]), Math.abs(rows[i + 2]));
        if (!(most <= 1e30) || (marks && !marks[i / 3])) continue;
        for (let k = 0; k < 3; k++) {
            low[k] = Math.min(low[k], rows[i + k]);
            high[k] = Math.max(high[k], rows[i + k]);
        }
    }
    return low[0] <= high[0] ? [low, high] : [[0, 0, 0], [0, 0, 0]];
}

/** The meshes in a world that counts from an origin: { origin, placed }. */
export function placed(meshes) {
    let low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
    const own = meshes.map(({ pose: m, origin: o, reach }) => {
        const out = Float64Array.from(m);
        for (let k = 0; k < 3; k++) out[12 + k] += m[k] * o[0] + m[4 + k] * o[1] + m[8 + k] * o[2];
        const scale = Math.max(...[0, 1, 2, 4, 5, 6, 8, 9, 10].map((k) => Math.abs(m[k])));
        const middle = [out[12], out[13], out[14]];
        low = middle.map((x, k) => Math.min(low[k], x - scale * reach));
        high = middle.map((x, k) => Math.max(high[k], x + scale * reach));
        return out;
    });
    const origin = meshes.length ? originOf(low, high) : [0, 0, 0];
    return { origin, placed: meshes.map((mesh, i) => {
        own[i].set(origin.map((x, k) => own[i][12 + k] - x), 12);
        return { mesh, positions: mesh.positions, used: mesh.used, pose: own[i] };
    }) };
}

/** 4 x 4 by columns, of three rows and a translation. */
function rigid(turn, move) {
    const m = new Float32Array(16);
    for (let row = 0; row < 3; row++) {
        for (let column = 0; column < 3; column++) m[4 * column + row] = turn[row][column];
        m[12 + row] = move[row];
    }
    m[15] = 1;
    return m;
}

function perspective(width, height, near, far) {
    const slope = Math.tan(FOV * (Math.PI / 180) / 2), m = new Float32Array(16);
    m[0] = 1 / (slope * (width / height));
    m[5] = 1 / slope;
    m[10] = (far + near) / (near - far);
    m[11] = -1;
    m[14] = 2 * far * near / (near - far);
    return m;
}

function orthographic(width, height, turn, low, high, reach) {
    const middle = low.map((x, k) => (x + high[k]) / 2), m = new Float32Array(16);
    const extent = low.map((x, k) => (high[k] - x) / 2);
    const half = MARGIN * Math.max(extent[1], extent[0] * height / width, 1e-4 * reach);
    m[0] = height / (half * width);
    m[5] = 1 / half;
    m[10] = -1 / (2 * reach);
    m[14] = -1;
    m[15] = 1;
    return { view: rigid(turn, [-middle[0], -middle[1], -middle[2] - 2 * reach]), projection: m };
}

/** Which vertices triangles use, 1 or 0 each; not those alone that have two corners at one place, which
    cannot be seen. */
export function used({ positions: p, indices }) {
    const marks = new Uint8Array(p.length / 3);
    const one = (i, j) => p[3 * i] === p[3 * j] && p[3 * i + 1] === p[3 * j + 1] && p[3 * i + 2] === p[3 * j + 2];
    let seen = false;
    for (let i = 0; i < indices.length; i += 3) {
        const [a, b, c] = [indices[i], indices[i + 1], indices[i + 2]];
        if (one(a, b) || one(b, c) || one(c, a)) continue;
        marks[a] = marks[b] = marks[c] = 1;
        seen = true;
    }
    if (!seen) for (const i of indices) marks[i] = 1;
    return marks;
}

/** Calls take with each point of the meshes in the world, but those with NaN or beyond 1e8. */
function eachPoint(meshes, take) {
    for (const { positions: p, pose: m, used: marks } of meshes) {
        for (let i = 0, at = 0; i < marks.length; i++, at += 3) {
            const x = Math.fround(p[at] * m[0] + p[at + 1] * m[4] + p[at + 2] * m[8] + m[12]);
            const y = Math.fround(p[at] * m[1] + p[at + 1] * m[5] + p[at + 2] * m[9] + m[13]);
            const z = Math.fround(p[at] * m[2] + p[at + 1] * m[6] + p[at + 2] * m[10] + m[14]);
            const most = Math.max(Math.abs(x), Math.abs(y), Math.abs(z));
            if (marks[i] && most <= MOST) take(x, y, z);
        }
    }
}

/** Extremes of the points in the axes of the camera, and of what bounds the eye from four sides.
    Points with NaN or beyond 1e8 do not count. */
function extremes(meshes, turn, [across, along]) {
    const [r, u, b] = turn, low = [0, 0, 0], high = [0, 0, 0], above = [0, 0], below = [0, 0];
    let none = true;
    const take = (x, y, z) => {
        const right = x * r[0] + y * r[1] + z * r[2], up = x * u[0] + y * u[1] + z * u[2];
        const back = x * b[0] + y * b[1] + z * b[2], bounds = [right, up, back];
        for (let k = 0; k < 3; k++) {
            low[k] = none ? bounds[k] : Math.min(low[k], bounds[k]);
            high[k] = none ? bounds[k] : Math.max(high[k], bounds[k]);
        }
        above[0] = Math.max(none ? -Infinity : above[0], right + across * back);
        above[1] = Math.max(none ? -Infinity : above[1], up + along * back);
        below[0] = Math.max(none ? -Infinity : below[0], across * back - right);
        below[1] = Math.max(none ? -Infinity : below[1], along * back - up);
        none = false;
    };
    eachPoint(meshes, take);
    if (none) take(0, 0, 0);
    return { low, high, above, below };
}

/** The nearest camera that sees all meshes from a side: { view, projection }.  room is how much deeper
    than the meshes the picture reaches, as a part of their extent. */
export function fitted(meshes, view, [width, height], up, ortho, room) {
    const turn = facing(...direction(view, up)), slope = Math.tan(FOV * (Math.PI / 180) / 2);
    const slopes = [slope * width / height, slope];
    const { low, high, above, below } = extremes(meshes, turn, slopes);
    const most = Math.max(...low.map(Math.abs), ...high.map(Math.abs));
    const reach = Math.max(norm(high.map((x, k) => x - low[k])), most * 1e-6, 1e-6);
    if (flag("ortho", ortho)) return orthographic(width, height, turn, low, high, reach);
    const shift = [0, 1].map((k) => (above[k] - below[k]) / 2);
    const bounds = [0, 1].map((k) => (above[k] + below[k]) / (2 * slopes[k]));
    const least = Math.max(...bounds, high[2] + 1e-3 * reach);
    const distance = least + (MARGIN - 1) * (least - (low[2] + high[2]) / 2);
    const far = distance - low[2] + room * reach;
    const near = Math.max(0.9 * (distance - high[2] - room * reach), (room ? 0.01 : 1e-4) * far);
    return {
        view: rigid(turn, [-shift[0], -shift[1], -distance]),
        projection: perspective(width, height, near, 1.1 * far + 1e-3 * reach),
    };
}

/** 4 x 4 by columns: takes the meshes to the studio, about the origin and within distance 1, with +y
    up and +z toward the eye. */
export function studio(meshes, { view }, up) {
    let low = null, high = null, size = 0;
    eachPoint(meshes, (...p) => {
        low = p.map((x, k) => Math.min(x, low?.[k] ?? x));
        high = p.map((x, k) => Math.max(x, high?.[k] ?? x));
    });
    const middle = (low ?? [0, 0, 0]).map((x, k) => (x + (high?.[k] ?? 0)) / 2);
    eachPoint(meshes, (...p) => { size = Math.max(size, norm(p.map((x, k) => x - middle[k]))); });
    const y = choice("up", up, ["y", "z"]) === "z" ? [0, 0, 1] : [0, 1, 0];
    const [across, over] = [0, 1].map((row) => {
        const way = [view[row], view[row + 4], view[row + 8]];
        return way.map((x, k) => x - dot(way, y) * y[k]);
    });
    const x = norm(across) < 1e-3 ? scale(over, 1 / norm(over)) : scale(across, 1 / norm(across));
    const turn = [x, y, cross(x, y)].map((row) => scale(row, 1 / Math.max(size, 1e-12)));
    return rigid(turn, turn.map((row) => -dot(row, middle)));
}

/** The rows of the rotation of a matrix by columns, which has a translation besides, and no more */
export function rotationOf(name, view) {
    const rows = [0, 1, 2].map((k) => [view[k], view[4 + k], view[8 + k]]);
    const last = [3, 7, 11].every((k) => view[k] === 0) && view[15] === 1;
    const apart = rows.map((a, i) => rows.map((b, k) => Math.abs(dot(a, b) - (i === k ? 1 : 0))));
    if (last && Math.max(...apart.flat()) <= 1e-3) return rows;
    throw new ShadeError(`${name} must be a rotation and a translation, without scale`);
}

/** The camera that a caller describes by its matrices, in a world that counts from an origin. */
export function given(value, origin) {
    const { view, projection } = record("view", value, ["view", "projection"]);
    const camera = { view: matrix("view.view", view),
                     projection: vector("view.projection", projection, 16) };
    const rows = rotationOf("view.view", camera.view);
    for (let k = 0; k < 3; k++) camera.view[12 + k] += dot(rows[k], origin);
    camera.view = Float32Array.from(camera.view);
    return camera;
}

/** The eye of a camera in the space of a mesh, or the way toward it where all see the same way. */
export function eyeOf({ view, projection }, pose) {
    const parallel = projection[15] !== 0, inverse = inverted(pose);
    if (!inverse) return null;
    const back = [view[2], view[6], view[10]];
    const eye = [0, 1, 2].map((k) => -(view[4 * k] * view[12] + view[4 * k + 1] * view[13] +
                                       view[4 * k + 2] * view[14]));
    const p = parallel ? back : eye.map((x, k) => x - pose[12 + k]);
    return { eye: inverse.map((row) => dot(row, p)), parallel };
}

/** The rows of the inverse of the upper left 3 x 3, or null. */
function inverted(m) {
    const columns = [0, 4, 8].map((k) => [m[k], m[k + 1], m[k + 2]]);
    const rows = [cross(columns[1], columns[2]), cross(columns[2], columns[0]),
                  cross(columns[0], columns[1])];
    const det = dot(columns[0], rows[0]);
    return Math.abs(det) < 1e-30 ? null : rows.map((row) => scale(row, 1 / det));
}
