"""Cameras of one scene: depth, ids and normals beside closed forms, and the same bytes whoever draws."""
import ctypes
import multiprocessing
import os
import pickle
import threading

import numpy as np
import pytest

import shade_h as shade

KINDS = {"sphere": 0.3, "ellipsoid": (0.35, 0.2, 0.15), "capsule": (0.15, 0.3),
         "cylinder": (0.2, 0.3), "box": (0.25, 0.2, 0.3)}


def turned(generator):
    """A random place and turn."""
    pose = np.eye(4)
    q, r = np.linalg.qr(generator.normal(size=(3, 3)))
    q *= np.sign(np.diag(r))
    pose[:3, :3] = q * np.sign(np.linalg.det(q))
    pose[:3, 3] = generator.uniform((-2, -2, 0.4), (2, 2, 1))
    return pose


def crowd(height=60, width=80, shadow=0, **options):
    """A floor with 24 objects of every kind, a mesh and hills among them."""
    made = shade.Renderer(height, width, **options)
    rng = np.random.default_rng(7)
    made.add("plane", texture=made.checker(), repeat=(0.5, 0.5))
    hills = made.height_field(0.2 * rng.random((6, 9)), (1.5, 1))
    pyramid = made.mesh([[0, 0, 1], [1, 0, 0], [0, 1, 0], [-1, -1, 0]],
                        [[0, 1, 2], [0, 2, 3], [0, 3, 1], [1, 3, 2]], normals="flat")
    made.add(hills, at=(0, 2, 0), color="green")
    for i in range(22):
        name = list(KINDS)[i % 5]
        shape, size = (pyramid, 0.3) if i % 7 == 0 else (name, KINDS[name])
        made.add(shape, size, pose=turned(rng), color=tuple(rng.random(3)), specular=0.5,
                 shininess=10 + 20 * (i % 3), alpha=0.5 if i % 8 == 3 else 1)
    made.light([shade.Light.directional((-0.5, 0.8, -1.2), (0.8, 0.8, 0.8)),
                shade.Light.point((2, -2, 3), (0.3, 0.2, 0.2))], (0.3, 0.3, 0.3), shadow)
    made.sky()
    return made


@pytest.mark.parametrize("how, hues", [("repeat", "rbr"), ("clamp", "bbb"), ("mirror", "brr")])
def test_a_texture_goes_on_beyond_its_edges_as_it_is_told(how, hues):
    strip = np.array([[[255, 0, 0], [0, 0, 255]]], np.uint8)
    corners = np.array([[0, 0, 0], [3, 0, 0], [3, 0, 1], [0, 0, 1]], float)
    faces, uv = [[0, 1, 2], [0, 2, 3]], corners[:, [0, 2]]
    camera = shade.Camera.look_at((1.5, -3, 0.5), (1.5, 0, 0.5), aspect=4 / 3)
    look = shade.Surface(texture=strip, wrap=(how, "repeat"))
    whole = shade.Mesh(corners, faces, uv=uv, surfaces=([0, 0], [look]))
    for own in (True, False):
        made = shade.Renderer(90, 120)
        made.light([], (1, 1, 1))
        shape = made.mesh(whole) if own else made.mesh(corners, faces, uv=uv)
        made.add(shape, texture=None if own else made.texture(strip, (how, "repeat")))
        color = made.render(camera).color
        at = camera.projection @ camera.view @ np.array([[x, 0, 0.5, 1] for x in (1.25, 1.75, 2.25)]).T
        columns = ((at[0] / at[3] + 1) * 60).astype(int)
        assert "".join("r" if color[45, x, 0] > color[45, x, 2] else "b" for x in columns) == hues


def eyes(count=4):
    return [shade.Camera.look_at((4 * np.cos(a), 4 * np.sin(a), 2.5), (0, 0, 0.3), aspect=4 / 3,
                                 near=0.05, far=60) for a in np.arange(count)]


def drawn(made, camera):
    return b"".join(a.tobytes() for a in made.render(camera, normals=True))


def rays(camera, height, width):
    """Eye and directions of all pixels in double, of depth 1 along the axis."""
    x = (2 * np.arange(width) + 1) / width - 1
    y = 1 - (2 * np.arange(height) + 1) / height
    p, back = camera.projection, camera.view[:3, :3].T
    ny = (y + p[1, 2]) / p[1, 1]
    nx = (x[None] + p[0, 2] - p[0, 1] * ny[:, None]) / p[0, 0]
    eye = np.stack([nx, np.broadcast_to(ny[:, None], nx.shape), -np.ones_like(nx)], -1)
    return camera.eye, eye @ back.T


# ---- closed forms

def test_a_plane_has_the_depth_of_its_rays():
    made = shade.Renderer(120, 160)
    made.add("plane", at=(0, 0, 0.25))
    camera = shade.Camera.look_at((1, -2, 3), (0.5, 3, 0), fov=60, aspect=4 / 3, near=0.01, far=200)
    frame = made.render(camera, normals=True)
    eye, way = rays(camera, 120, 160)
    wanted = (0.25 - eye[2]) / way[..., 2]
    seen = (wanted > 0.01) & (wanted < 150)
    assert seen.sum() > 15000 and np.isfinite(frame.depth[seen]).all()
    pixel = np.abs(np.gradient(wanted, axis=0)) + np.abs(np.gradient(wanted, axis=1))
    error = np.abs(frame.depth - wanted)    # corners are snapped to 1/256 pixel
    assert (error < 1e-5 * wanted + pixel / 256)[seen].all()
    assert (error / wanted)[seen & (wanted < 10)].max() < 1e-4
    assert (frame.ids[seen][:, 0] == 0).all()
    assert np.abs(frame.normals[seen] - [0, 0, 1]).max() < 1e-6
    assert np.isinf(frame.depth[(wanted < 0) | (wanted > 210)]).all()


@pytest.mark.parametrize("kind", ["sphere", "ellipsoid"])
def test_a_sphere_lies_within_the_tolerance(kind):
    size = np.array([0.5] * 3 if kind == "sphere" else [0.7, 0.4, 0.5])
    made = shade.Renderer(200, 200, tolerance=0.1)
    made.add(kind, 0.5 if kind == "sphere" else size, at=(0.1, 0, 0.2))
    camera = shade.Camera.look_at((2, -1.5, 1), (0, 0, 0.2), fov=30, near=0.1, far=10)
    frame = made.render(camera, normals=True)
    eye, way = rays(camera, 200, 200)
    o, d = (eye - [0.1, 0, 0.2]) / size, way / size
    a, b, c = (d * d).sum(-1), (o * d).sum(-1), (o * o).sum() - 1
    inside = b * b - a * c
    hit = inside > 0
    wanted = (-b - np.sqrt(np.where(hit, inside, 0))) / a
    pixel = 2.7 * 2 * np.tan(np.radians(15)) / 200
    assert np.count_nonzero(hit != (frame.ids[..., 0] == 0)) < 0.15 * np.sqrt(hit.sum()) * 4
    facing = hit & (inside / (a * (o @ o)) > 0.02) & (frame.ids[..., 0] == 0)
    assert facing.sum() > 3000
    steep = np.sqrt(a * (o @ o) / np.where(facing, inside, 1))
    error = (frame.depth - wanted) / (pixel * steep)
    assert -0.01 < error[facing].min() and error[facing].max() < 0.5
    normal = (o + wanted[..., None] * d) / size
    normal /= np.linalg.norm(normal, axis=-1, keepdims=True)
    assert np.abs(frame.normals - normal)[facing].max() < 0.03


@pytest.mark.parametrize("parallel", [False, True])
def test_each_kind_is_hit_where_its_equation_says(parallel):
    """A pixel far from an outline shows an object where its ray meets the solid, sampled in double."""
    inside = {"capsule": lambda p: np.hypot(np.hypot(p[0], p[1]),
                                            np.maximum(np.abs(p[2]) - 0.3, 0)) < 0.15,
              "cylinder": lambda p: (np.hypot(p[0], p[1]) < 0.2) & (np.abs(p[2]) < 0.3),
              "box": lambda p: (np.abs(p) < np.array([0.25, 0.2, 0.3])[:, None, None]).all(0)}
    rng = np.random.default_rng(3)
    for kind, solid in inside.items():
        made = shade.Renderer(48, 48, tolerance=0.02)
        pose = turned(rng)
        made.add(kind, KINDS[kind], pose=pose)
        camera = shade.Camera.look_at(pose[:3, 3] + [1, -1, 1.2], pose[:3, 3], fov=40, near=0.1, far=9)
        if parallel:
            flat = np.diag([2.0, 2.0, -2 / 8.9, 1.0])
            flat[2, 3] = -9.1 / 8.9
            camera = shade.Camera(camera.view, flat)
        frame = made.render(camera)
        steps = np.linspace(0.9, 2.9, 2001)
        x, y = (2 * np.arange(48) + 1) / 48 - 1, 1 - (2 * np.arange(48) + 1) / 48
        at = np.full((48, 48), np.inf)
        for d in steps[::-1]:
            k = (1 if parallel else d) / camera.projection[0, 0]
            e = np.stack([np.broadcast_to(k * x, (48, 48)),
                          np.broadcast_to((k * y)[:, None], (48, 48)), np.full((48, 48), -d)])
            world = np.einsum("ij,jhw->ihw", camera.view[:3, :3].T,
                              e - camera.view[:3, 3][:, None, None])
            local = np.einsum("ji,jhw->ihw", pose[:3, :3], world - pose[:3, 3][:, None, None])
            at[solid(local)] = d
        hit = np.isfinite(at)
        differ = hit != (frame.ids[..., 0] == 0)
        at[~hit | differ] = frame.depth[~hit | differ] = 0
        assert hit.sum() > 60 and differ.sum() <= 6, kind
        both = hit & ~differ
        assert np.median(np.abs(frame.depth - at)[both]) < 0.002, kind
        assert (np.abs(frame.depth - at)[both] > 0.03).sum() <= 6, kind


def test_corners_of_a_checkerboard_lie_within_1_256_pixel():
    """The principal point moves by 1/64 pixel, so that the lines between corners pass the centres of
    pixels at all distances.  Centres farther than 1/256 pixel from each line, by K and the pose in
    double, show the square that they lie in; of those that are nearer some do not."""
    turn = np.linalg.qr(np.random.default_rng(8).normal(size=(3, 3)) + 4 * np.eye(3))[0]
    turn *= np.sign(np.diag(turn))
    outside = np.column_stack([turn, [0.05, -0.1, 4]])
    made, size = shade.Renderer(96, 96), 0.2
    for i in range(-3, 3):
        for j in range(-3, 3):
            corners = [[size * (i + a), size * (j + b), 0] for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))]
            made.add(made.mesh(corners, [[0, 1, 2], [0, 2, 3]], normals="flat"), two_sided=True)
    lines = size * np.arange(-3, 4)
    ends = np.array([[[x, lines[0], 0], [x, lines[-1], 0]] for x in lines] +
                    [[[lines[0], y, 0], [lines[-1], y, 0]] for y in lines])
    near = wrong = closer = 0
    for step in range(64):
        K = np.array([[301.0, 0, 47.5 + step / 64], [0, 299.0, 48.2 + step % 8 / 8], [0, 0, 1]])
        ids = made.render(shade.Camera.opencv(K, outside, (96, 96), 0.1, 20)).ids[..., 0]
        seen = (ends @ turn.T + outside[:, 3]) @ K.T
        seen = seen[..., :2] / seen[..., 2:]
        v, u = np.meshgrid(np.arange(96), np.arange(96), indexing="ij")
        # OpenCV has the centre of the first pixel at (0, 0)
        way = np.stack([u, v, np.ones_like(u)], -1) @ np.linalg.inv(K).T @ turn
        eye = -turn.T @ outside[:, 3]
        on = eye - eye[2] / way[..., 2:] * way
        cell = np.floor(on[..., :2] / size).astype(int)
        within = ((cell >= -3) & (cell < 3)).all(-1)
        wanted = np.where(within, (cell[..., 0] + 3) * 6 + cell[..., 1] + 3, -1)
        # distance of each centre from the nearest of the lines, in pixels
        a, b = seen[:, 0], seen[:, 1]
        along = (b - a) / np.linalg.norm(b - a, axis=1)[:, None]
        gap = np.abs((u[..., None] - a[:, 0]) * along[:, 1] - (v[..., None] - a[:, 1]) * along[:, 0]).min(-1)
        near += int(((gap < 1 / 32) & (gap > 1 / 256)).sum())
        wrong += int(((ids != wanted) & (gap > 1 / 256)).sum())
        closer += int((ids != wanted).sum())
    assert wrong == 0 and near > 4000 and closer > 0, (wrong, near, closer)


def test_each_square_of_a_checkerboard_is_told_by_opencv_and_opengl():
    """The object of a pixel is that which its ray meets, whichever convention the camera came by."""
    K = np.array([[310.7, 0, 158.3], [0, 305.2, 121.9], [0, 0, 1]])
    turn = np.linalg.qr(np.random.default_rng(5).normal(size=(3, 3)) + 3 * np.eye(3))[0]
    turn *= np.sign(np.diag(turn))
    outside = np.column_stack([turn, [0.1, -0.2, 4]])
    made = shade.Renderer(240, 320)
    size, squares = 0.25, []
    for i in range(-4, 4):
        for j in range(-4, 4):
            x, y = size * i, size * j
            mesh = made.mesh([[x, y, 0], [x + size, y, 0], [x + size, y + size, 0], [x, y + size, 0]],
                             [[0, 1, 2], [0, 2, 3]], normals="flat")
            squares.append((i, j))
            made.add(mesh, two_sided=True)
    camera = shade.Camera.opencv(K, outside, (320, 240), 0.1, 20)
    frame = made.render(camera)
    pose = np.linalg.inv(camera.view)
    other = made.render(shade.Camera.opengl(camera.projection, pose))
    assert np.array_equal(frame.ids, other.ids)
    def seen_at(u, v):    # noqa: E306
        """The square that a ray through a pixel meets."""
        way = turn.T @ np.linalg.solve(K, [u, v, 1])
        eye = -turn.T @ outside[:, 3]
        hit = eye - eye[2] / way[2] * way
        return np.floor(hit[:2] / size), np.abs(hit[:2] / size - np.round(hit[:2] / size))
    tested = 0
    numbers = {s: n for n, s in enumerate(squares)}
    # a pixel of 1/256 of the board is about this much of a square
    slack = 1.5 / 256 / (K[0, 0] * size / 5)
    for v in range(240):
        for u in range(320):
            square, border = seen_at(u, v)
            if border.min() > slack:
                wanted = numbers.get(tuple(square.astype(int)), -1)
                assert frame.ids[v, u, 0] == wanted, (u, v)
                tested += 1
    assert tested > 70000


def test_a_principal_point_shifts_the_sky_with_the_scene():
    made = shade.Renderer(64, 64)
    made.sky("#000000", "#ffffff")
    flat = made.render(shade.Camera.opencv([[60, 0, 31.5], [0, 60, 31.5], [0, 0, 1]],
                                           [[1, 0, 0, 0], [0, 0, -1, 0], [0, 1, 0, 0]], 64)).color
    down = made.render(shade.Camera.opencv([[60, 0, 31.5], [0, 60, 41.5], [0, 0, 1]],
                                           [[1, 0, 0, 0], [0, 0, -1, 0], [0, 1, 0, 0]], 64)).color
    assert np.array_equal(down[10:], flat[:-10])
    assert (np.diff(flat[:, 32, 0].astype(int)) <= 0).all() and flat[0, 32, 0] > flat[-1, 32, 0] + 30


# ---- light

def test_a_shadow_lies_where_the_lamp_is_hidden_and_nowhere_else():
    """Straight above a floor with a box: no acne, no leak, and the rim within a texel's reach."""
    made = shade.Renderer(200, 200)
    made.add("plane", (3, 3))
    made.add("box", (0.3, 0.3, 0.3), at=(0, 0, 0.3))
    made.add("sphere", 0.4, at=(1.2, 1.0, 0.9))
    lamp = shade.Light.directional((1, 0.5, -1), (1, 1, 1))
    camera = shade.Camera.look_at((0, -0.001, 9), (0, 0, 0), fov=40, near=1, far=20)
    made.light([lamp], shadow=None)
    bright = made.render(camera)
    made.light([lamp], shadow=0)
    dark = made.render(camera)
    eye, way = rays(camera, 200, 200)
    p = eye + np.where(bright.ids[..., 0] >= 0, bright.depth, 0)[..., None] * way
    floor = bright.ids[..., 0] == 0
    toward = -np.array([1, 0.5, -1.0])
    def box_gap(q):    # noqa: E306
        """Signed: below 0 the ray to the lamp crosses the box."""
        a = (np.array([-0.3, -0.3, 0]) - q) / toward
        b = (np.array([0.3, 0.3, 0.6]) - q) / toward
        return np.minimum(a, b).max(-1) - np.maximum(a, b).min(-1)
    c = np.array([1.2, 1.0, 0.9]) - p
    along = (c @ toward) / (toward @ toward)
    sphere_gap = np.linalg.norm(c - along[..., None] * toward, axis=-1) - 0.4
    lit = (dark.color == bright.color).all(-1)
    black = (dark.color == 0).all(-1)
    reach = 0.05
    gap = np.minimum(box_gap(p), sphere_gap)
    assert black[floor & (gap < -2 * reach)].all() and (floor & (gap < -2 * reach)).sum() > 300
    assert lit[floor & (gap > reach)].all()
    top = (bright.ids[..., 0] == 1) & (bright.depth < 8.5)
    assert top.sum() > 60 and lit[top].all()
    ball = (bright.ids[..., 0] == 2) & ((np.array(p) - [1.2, 1.0, 0.9]) @ toward > 0.1)
    assert ball.sum() > 200 and lit[ball].all()


def test_a_spot_casts_shadows_and_a_point_is_refused():
    made = shade.Renderer(100, 100)
    made.add("plane", (3, 3))
    made.add("sphere", 0.4, at=(0, 0, 1))
    camera = shade.Camera.look_at((0, -6, 5), (0, 0, 0), fov=40, near=1, far=20)
    spot = shade.Light.spot((0, 0, 4), (0, 0, -1), 0.6, 0, (1, 1, 1))
    made.light([spot])
    bright = made.render(camera)
    made.light([spot], shadow=0)
    dark = made.render(camera)
    eye, way = rays(camera, 100, 100)
    p = eye + np.where(np.isfinite(bright.depth), bright.depth, 0)[..., None] * way
    floor, r = bright.ids[..., 0] == 0, np.hypot(p[..., 0], p[..., 1])
    rim = 4 * np.tan(np.arcsin(0.4 / 3))
    assert (dark.color[floor & (r < rim - 0.06)] == 0).all()
    rest = floor & (r > rim + 0.06)
    assert np.array_equal(dark.color[rest], bright.color[rest])
    with pytest.raises(shade.Error, match=r"shadow: lights\[0\] is a point"):
        made.light([shade.Light.point((0, 0, 2))], shadow=0)


@pytest.mark.parametrize("height", [2, 10, 40])
@pytest.mark.parametrize("kind", ["directional", "spot"])
def test_what_is_high_over_the_ground_casts_shadows(kind, height):
    """A point of the ground is dark where its ray to the lamp passes the ball's centre closely."""
    made, way = shade.Renderer(64, 64), np.array([-0.6, 0, -1])
    made.add("plane")
    ball, lamp = -height * way, -3 * height * way
    made.add("sphere", 0.5, at=ball)
    made.light([shade.Light.directional(way) if kind == "directional" else
                shade.Light.spot(lamp, way, 0.4, 0, (1, 1, 1))], (0.1, 0.1, 0.1), shadow=0)
    camera = shade.Camera.look_at((0, -9, 6), (0, 0, 0), fov=40, near=1, far=50)
    frame = made.render(camera)
    made.light([], (0.1, 0.1, 0.1))
    dark = (frame.color == made.render(camera).color).all(-1)
    eye, ways = rays(camera, 64, 64)
    ground = eye - eye[2] / ways[..., 2:] * ways
    toward = -way if kind == "directional" else lamp - ground
    toward = toward / np.linalg.norm(toward, axis=-1, keepdims=True)
    off = np.linalg.norm(np.cross(ball - ground, toward), axis=-1)
    within = frame.ids[..., 0] == 0
    if kind == "spot":
        within &= -toward @ way / np.linalg.norm(way) > np.cos(0.38)
    assert dark[within & (off < 0.42)].all() and not dark[within & (off > 0.58)].any()
    assert (within & (off < 0.42)).sum() > 15 and (within & (off > 0.58)).sum() > 500


@pytest.mark.parametrize("lean", [0, 0.6])
def test_no_face_of_a_convex_mesh_shadows_itself(lean):
    """Normals of vertices lean away from those of the faces, as those that simulators make of meshes
    do; a convex mesh hides no part of itself that looks at the lamp."""
    gem = np.array([[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1.4], [0, 0, -1.4]])
    faces = np.array([[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4], [2, 0, 5], [1, 2, 5], [3, 1, 5],
                      [0, 3, 5]])
    normals, looked = gem + lean * np.array([0.5, -0.3, 1.0]), 0
    rng = np.random.default_rng(9)
    corners = gem[faces]
    outward = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    outward /= np.linalg.norm(outward, axis=1)[:, None]
    for i in range(12):
        made, pose = shade.Renderer(96, 96), turned(rng)
        pose[:3, 3] = 0, 0, 0
        made.add(made.mesh(gem, faces, normals=normals), (1, 1, 1) if i % 2 else (1, 0.6, 0.8),
                 pose=pose)
        way = rng.normal(size=3)
        way /= np.linalg.norm(way)
        lamp = shade.Light.directional(way) if i % 3 else \
            shade.Light.spot(-4 * way, way, 0.5, 0, (1, 1, 1))
        camera = shade.Camera.look_at(4 * (rng.normal(size=3) * 0.3 - way), (0, 0, 0), near=0.5, far=12)
        made.light([lamp], (0.1, 0.1, 0.1))
        bright = made.render(camera)
        made.light([lamp], (0.1, 0.1, 0.1), shadow=0)
        dark = made.render(camera)
        world = outward / ((1, 1, 1) if i % 2 else (1, 0.6, 0.8)) @ pose[:3, :3].T
        world /= np.linalg.norm(world, axis=1)[:, None]
        facing = np.append(-world @ way, -1)[bright.ids[..., 1]] > 0.2
        looked += facing.sum()
        assert np.array_equal(dark.color[facing], bright.color[facing]), i
    assert looked > 8000


@pytest.mark.parametrize("ball", [True, False])
@pytest.mark.parametrize("floor", ["plane", "mesh"])
def test_a_finite_floor_throws_no_shadow_on_itself(floor, ball):
    """Near spots with cones of any width and lamps at infinity, aimed past and at floors of any size:
    beside a ball every point of the floor is as lit as without shadows, below it none."""
    rng, below = np.random.default_rng(1), 0
    camera = shade.Camera.look_at((3, -3, 3), (0, 0, 0), aspect=4 / 3)
    eye, way = rays(camera, 120, 160)
    for i in range(40):
        made, (a, b) = shade.Renderer(120, 160), rng.uniform(0.5, 30 if floor == "plane" else 8, 2)
        square = [[-a, -b, 0], [a, -b, 0], [a, b, 0], [-a, b, 0]]
        shape = made.mesh(square, [[0, 1, 2], [0, 2, 3]]) if floor == "mesh" else "plane"
        made.add(shape, *([] if floor == "mesh" else [(a, b)]))
        if ball:
            made.add("sphere", 0.3, at=(0, 0, 0.3))
        at = np.array([*rng.uniform(-1, 1, 2), rng.uniform(0.8, 4)])
        aim = rng.normal(size=3) * 0.5 - [0, 0, 1]
        lamp = shade.Light.spot(at, aim, rng.uniform(0.2, 1.5)) if i % 4 else \
            shade.Light.directional(aim * (1, 1, np.sign(aim[2]) * -1))
        made.light([lamp], (0.1, 0.1, 0.1))
        bright = made.render(camera)
        made.light([lamp], (0.1, 0.1, 0.1), shadow=0)
        dark = (made.render(camera).color.astype(int) - bright.color).min(-1) < -2
        on = bright.ids[..., 0] == 0
        p = eye + np.where(on, bright.depth, 0)[..., None] * way
        toward = at - p if i % 4 else np.broadcast_to(np.array(lamp.position[:3]), p.shape)
        toward = toward / np.linalg.norm(toward, axis=-1, keepdims=True)
        off = np.linalg.norm(np.cross(np.array([0, 0, 0.3]) - p, toward), axis=-1)
        assert not dark[on & ((off > 0.6) | (not ball))].any(), i
        lit = (bright.color > 110).all(-1)
        assert not ball or dark[on & lit & (off < 0.2)].all(), i
        below += (on & lit & (off < 0.2)).sum()
    assert below > 300 or not ball, below


def test_ground_without_anything_on_it_is_lit():
    made = shade.Renderer(20, 30)
    made.add("plane")
    camera = eyes(1)[0]
    for lamp in (shade.Light.directional((0.2, 0, -1)), shade.Light.spot((0, 0, 3), (0, 0, -1), 0.6)):
        made.light([lamp])
        bright = made.render(camera)
        made.light([lamp], shadow=0)
        assert np.array_equal(made.render(camera).color, bright.color)


def test_objects_that_blend_are_sorted_and_are_no_part_of_depth():
    made = shade.Renderer(8, 8)
    made.light([], (1, 1, 1))
    made.background((0.0, 0.0, 0.0))
    far = made.add("box", (1, 1, 0.1), at=(0, 0, 0), color=(1.0, 0.0, 0.0), alpha=0.5)
    near = made.add("box", (1, 1, 0.1), at=(0, 0, 1), color=(0.0, 1.0, 0.0), alpha=0.5)
    camera = shade.Camera.look_at((0, 0, 4), fov=20, near=1, far=10)
    assert far < near
    for low, high in ((0, 1), (1, 0)):    # whichever was added first
        made.poses([_at(0, 0, low), _at(0, 0, high)])
        frame = made.render(camera)
        front, back = (1, 0) if high else (0, 1)
        seen = frame.color[4, 4]
        assert seen[front] > seen[back] > 0
        assert (frame.ids == -1).all() and np.isinf(frame.depth).all()
        solid = made.render(camera, solid=True, empty_depth=0)
        assert (solid.ids[..., 0] == (near if high else far)).all()
        assert np.allclose(solid.depth, 2.9, atol=1e-5)


def _at(x, y, z):
    pose = np.eye(4)
    pose[:3, 3] = x, y, z
    return pose


# ---- the same bytes

def test_out_is_filled_and_nothing_else_is_needed():
    made, camera = crowd(), eyes(1)[0]
    one = made.render(camera, normals=True)
    out = made.frame(normals=True)
    for array in out:
        array.fill(7)
    assert made.render(camera, out) is out
    for a, b in zip(one, out):
        assert np.array_equal(a, b)
    rgba = shade.Frame(np.zeros((60, 80, 4), np.uint8), None, None, None)
    assert np.array_equal(made.render(camera, rgba).color[..., :3], one.color)
    depth = shade.Frame(None, np.zeros((60, 80), np.float32), None, None)
    assert np.array_equal(made.render(camera, depth).depth, one.depth)
    ids = shade.Frame(None, None, np.zeros((60, 80, 2), np.int32), None)
    assert np.array_equal(made.render(camera, ids).ids, one.ids)
    smooth = crowd(samples=3).render(camera, normals=True)
    assert np.array_equal(smooth.ids, one.ids) and np.array_equal(smooth.depth, one.depth)
    assert np.array_equal(smooth.normals, one.normals) and not np.array_equal(smooth.color, one.color)


def test_order_of_pictures_changes_no_byte():
    cameras = eyes(4)
    fresh = [drawn(crowd(), c) for c in cameras]
    made = crowd()
    assert [drawn(made, c) for c in cameras] == fresh
    assert [drawn(made, c) for c in cameras[::-1]] == fresh[::-1]
    assert len(set(fresh)) == 4


def test_eight_threads_share_a_renderer():
    made, cameras = crowd(), eyes(8)
    wanted = [drawn(made, c) for c in cameras]
    got = [[] for _ in range(8)]

    def work(k):
        for i in range(24):
            n = (k + i) % 8
            got[k].append(drawn(made, cameras[n]) == wanted[n])
    threads = [threading.Thread(target=work, args=(k,)) for k in range(8)]
    for t in threads:
        t.start()
    for t in threads:
        t.join()
    assert all(len(g) == 24 and all(g) for g in got)


def _elsewhere(made, number, out):
    out.put((number, drawn(made, eyes(8)[number])))


@pytest.mark.parametrize("way", ["fork", "spawn"])
def test_eight_processes_draw_the_same(way):
    if way not in multiprocessing.get_all_start_methods():
        pytest.skip(f"this system does not {way}")
    context = multiprocessing.get_context(way)
    made, out = crowd(), context.Queue()
    wanted = {i: drawn(made, c) for i, c in enumerate(eyes(8))}
    workers = [context.Process(target=_elsewhere, args=(made, i, out)) for i in range(8)]
    for w in workers:
        w.start()
    assert dict(out.get(timeout=120) for _ in workers) == wanted
    for w in workers:
        w.join()


def test_a_renderer_can_be_pickled():
    made, camera = crowd(), eyes(1)[0]
    again = pickle.loads(pickle.dumps(made))
    assert drawn(again, camera) == drawn(made, camera)


def test_pictures_leave_memory_where_it_was():
    made, cameras = crowd(16, 16), eyes(5)
    out = made.frame(normals=True)
    for camera in cameras:
        made.render(camera, out)
    libc = ctypes.CDLL(None)
    if not hasattr(libc, "mallinfo2"):
        pytest.skip("the C library does not count")

    class Info(ctypes.Structure):
        _fields_ = [(n, ctypes.c_size_t) for n in "abcdefghij"]
    libc.mallinfo2.restype = Info
    before = libc.mallinfo2()
    for i in range(600):
        made.render(cameras[i % 5], out)
    after = libc.mallinfo2()
    assert after.h - before.h < 50000 and after.e == before.e


def test_a_notebook_shows_the_outputs_side_by_side():
    frame = crowd().render(eyes(1)[0], normals=True)
    shown = frame.picture()
    assert shown.size == (4 * 80, 60) and frame._repr_png_() == shown.png()
    color, depth, ids, normals = np.split(shown.rgba[..., :3].astype(int), 4, 1)
    assert np.array_equal(color, frame.color)
    near = np.unravel_index(frame.depth.argmin(), frame.depth.shape)
    seen = np.isfinite(frame.depth)
    assert (depth[near] == 255).all() and (depth[~seen] == 0).all() and (depth[seen] >= 40).all()
    numbers = frame.ids[..., 0]
    tints = {n: np.unique(ids[numbers == n], axis=0) for n in np.unique(numbers)}
    assert all(len(t) == 1 for t in tints.values())
    assert len(np.unique(np.concatenate(list(tints.values())), axis=0)) == len(tints) > 10
    assert np.abs((normals - 127) / 128 - frame.normals).max() < 0.02
    with pytest.raises(shade.Error, match="frame has no arrays"):
        shade.Frame(None, None, None, None).picture()
    empty = shade.Renderer(4, 4).render(eyes(1)[0])
    assert (empty.picture().rgba[:, 4:, :3] == 0).all()


def resident():
    """The size of this process in memory, where the system tells it."""
    try:
        with open("/proc/self/statm", encoding="ascii") as told:
            return int(told.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")
    except OSError:
        pytest.skip("this system does not tell the size of a process")


def test_many_pictures_leave_the_process_as_large_as_it_was():
    """LONG=1 draws 100,000."""
    made, cameras = crowd(24, 32), eyes(5)
    made.render(cameras[0])
    out = made.frame(normals=True)
    count = 100_000 if os.environ.get("LONG") else 2_000
    for i in range(200):
        made.render(cameras[i % 5], out)
    before = resident()
    for i in range(count):
        made.pose(3, _at(np.sin(0.01 * i), np.cos(0.01 * i), 0.7))
        made.render(cameras[i % 5], out if i % 2 else None)
    assert resident() - before < 2**20, resident() - before


# ---- refusals

def test_bad_input_has_a_name_and_changes_nothing():
    made, camera = crowd(), eyes(1)[0]
    before = drawn(made, camera)
    nan = np.full((4, 4), np.nan)
    for words, call in (
            ("height must be from 1", lambda: shade.Renderer(0, 5)),
            ("samples", lambda: shade.Renderer(9000, 9000, samples=2)),
            ("shape must be one of plane, sphere", lambda: made.add("cone", 1)),
            ("size of a sphere must be positive", lambda: made.add("sphere", 0)),
            (r"size must have the shape \(3\)", lambda: made.add("box", (1, 2))),
            ("size must hold finite", lambda: made.add("box", (1, 2, np.nan))),
            ("pose of object 3 must hold finite", lambda: made.pose(3, nan)),
            ("pose of object 3 must be a rotation", lambda: made.pose(3, 2 * np.eye(4))),
            ("number: there is no object 24", lambda: made.pose(24, np.eye(4))),
            (r"poses\[5\] must be a rotation", lambda: made.poses(
                [np.eye(4) * (2 if i == 5 else 1) for i in range(24)])),
            (r"poses must have the shape \(24, 4, 4\)", lambda: made.poses(np.zeros((3, 4, 4)))),
            ("texture: there is no texture 3", lambda: made.add("sphere", 1, texture=3)),
            ("texture 0 is no cube", lambda: made.sky_texture(0)),
            ("heights must have two rows", lambda: made.height_field([[1.0]], (1, 1))),
            ("at most 8 lamps", lambda: made.light([shade.Light.point((0, 0, 1))] * 9)),
            ("shadow must be from 0", lambda: made.light([], shadow=0)),
            ("camera must be a shade_h.Camera", lambda: made.render(None)),
            ("near before far|0 < near < far", lambda: made.render(
                shade.Camera(np.eye(4), np.eye(4)))),
            ("out must be a shade_h.Frame", lambda: made.render(camera, np.zeros((60, 80, 3)))),
            (r"out.depth must be float32 of shape \(60, 80\)", lambda: made.render(
                camera, shade.Frame(None, np.zeros((8, 8), np.float32), None, None)))):
        with pytest.raises(shade.Error, match=words):
            call()
    assert drawn(made, camera) == before
