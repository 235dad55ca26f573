"""Pictures of a Renderer beside those of Mesa's llvmpipe: the same triangles, lamp and camera."""
import numpy as np
import pytest
from osmesa import Mesa

import shade_h as shade

SIZE, COUNT = 160, 24


def ball(n=48):
    """A unit sphere, so fine that light by vertex is nearly light by pixel."""
    u, v = np.meshgrid(2 * np.pi * np.arange(n + 1) / n, np.pi * np.arange(n // 2 + 1) / (n // 2),
                       indexing="ij")
    points = np.stack([np.cos(u) * np.sin(v), np.sin(u) * np.sin(v), np.cos(v)], -1).reshape(-1, 3)
    i, j = (x.ravel() for x in np.meshgrid(np.arange(n), np.arange(n // 2), indexing="ij"))
    k, m = i * (n // 2 + 1) + j, (i + 1) * (n // 2 + 1) + j
    faces = np.concatenate([np.stack([k, k + 1, m + 1], 1)[j < n // 2 - 1],
                            np.stack([k, m + 1, m], 1)[j > 0]])
    return points, faces, points


def cube():
    """A cube of side 2 with the normals of its faces."""
    points, normals = [], []
    for axis in range(3):
        for side in (-1.0, 1.0):
            a, b, n = (np.roll(np.eye(3), -axis, 0)[k] for k in (1, 2, 0))
            points += [side * n + s * side * a + t * b for s, t in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
            normals += [side * n] * 4
    first = 4 * np.arange(6)[:, None]
    return (np.array(points), np.concatenate([first + [0, 1, 2], first + [0, 2, 3]]), np.array(normals))


def poses():
    """A floor and objects that cross each other; scales stand apart."""
    rng = np.random.default_rng(11)
    turns, scales = [np.eye(4)], [np.array([3.0, 3.0, 0.1])]
    for _ in range(COUNT - 1):
        pose = np.eye(4)
        q = np.linalg.qr(rng.normal(size=(3, 3)))[0]
        pose[:3, :3] = q * np.sign(np.linalg.det(q))
        pose[:3, 3] = rng.uniform((-2, -2, 0.2), (2, 2, 1.2))
        turns.append(pose)
        scales.append(np.full(3, rng.uniform(0.25, 0.5)))
    return turns, scales


@pytest.mark.parametrize("parallel", [False, True])
def test_pictures_are_those_of_llvmpipe(parallel):
    meshes, (turns, scales) = [ball(), cube()], poses()
    places = [1] + [i % 2 for i in range(1, COUNT)]
    rng = np.random.default_rng(2)
    colors = [tuple(c) for c in rng.uniform(0.3, 0.9, (COUNT, 3))]
    toward, diffuse, ambient = np.array([0.4, -0.5, 0.9]), (0.7, 0.7, 0.7), (0.25, 0.25, 0.25)
    camera = shade.Camera.look_at((4, -4, 3.5), (0, 0, 0.3), fov=45, aspect=1, near=1, far=15)
    if parallel:
        flat = np.diag([0.4, 0.4, -2 / 14, 1.0])
        flat[2, 3] = -16 / 14
        camera = shade.Camera(camera.view, flat)
    try:
        mesa = Mesa(meshes, (SIZE, SIZE), toward, diffuse, ambient)
    except OSError as why:
        pytest.skip(str(why))
    wholes = [p @ np.diag([*s, 1]) for p, s in zip(turns, scales)]
    color, z, ids = mesa.draw(camera.view, camera.projection, places, wholes, colors)
    made = shade.Renderer(SIZE, SIZE, srgb=False)
    shapes = [made.mesh(p, f, normals=n) for p, f, n in meshes]
    for place, pose, scale, tint in zip(places, turns, scales, colors):
        made.add(shapes[place], scale, pose=pose, color=tint)
    made.light([shade.Light.directional(-toward, diffuse)], ambient)
    made.background((0.0, 0.0, 0.0))
    frame = made.render(camera)
    near, far = 1.0, 15.0
    depth = near + z * (far - near) if parallel else near * far / (far - z * (far - near))
    # Mesa 22.3 shows the same object in each of the 25,600 pixels
    apart = frame.ids[..., 0] != ids
    assert (ids >= 0).sum() > 8000 and len(np.unique(ids)) > COUNT / 2
    assert apart.sum() <= 8, apart.sum()
    gap = np.abs(frame.depth - depth)[~apart & (ids >= 0)]
    assert np.quantile(gap, 0.99) < 5e-4 and gap.max() < 0.01, (np.quantile(gap, 0.99), gap.max())
    # light by vertex differs from light by pixel at the rims of the spheres: 14 and 29 pixels here
    steps = np.abs(frame.color.astype(int) - color)[~apart].max(-1)
    assert (steps > 1).sum() <= 60 and steps.max() <= 8, (np.bincount(steps))
