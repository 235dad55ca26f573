"""The light of the studio, and the one draw that gives all arrays, against what must hold."""
from dataclasses import replace

import numpy as np
import pytest
from shapes import box, torus

import shade_h as shade

SIZE = (160, 120)


def table():
    """A plate with a box that hovers above its middle."""
    made = shade.Scene()
    place = np.eye(4)
    made.add(box(6, 6, 0.2), place, color="white")
    place[:3, 3] = 2, 2, 1.5
    made.add(box(2, 2, 1), place, color="white")
    return made


def brightness(picture, where):
    return picture.rgba[where][:, :3].astype(float).mean()


def test_the_box_throws_a_shadow_on_the_plate():
    camera = shade.Camera.look_at((3, -9, 7), (3, 3, 0), fov=50, aspect=4 / 3)
    soft = table().render(camera, SIZE, samples=1, light="studio")
    quick = table().render(camera, SIZE, samples=1)
    assert np.array_equal(soft.ids, quick.ids) and np.array_equal(soft.depth, quick.depth)
    # points of the plate's upper side, in the world
    y, x = np.mgrid[0:SIZE[1], 0:SIZE[0]]
    ndc = np.stack([(x + .5) / SIZE[0] * 2 - 1, 1 - (y + .5) / SIZE[1] * 2], -1)
    scale = np.array([camera.projection[0, 0], camera.projection[1, 1]])
    seen = np.concatenate([ndc / scale, -np.ones(ndc.shape[:2] + (1,))], -1)
    with np.errstate(invalid="ignore"):
        world = camera.eye + soft.depth[..., None] * seen @ camera.view[:3, :3]
    top = (soft.ids == 0) & (soft.normals[..., 2] > 0.9)
    # the large lamp is (0.9, 0.95, 0.6) right of, above and before what the eye sees
    middle = np.array([3, 3]) - 1.8 / 0.95 * np.array([0.9, -0.6])
    below = top & (np.abs(world[..., :2] - middle) < 0.4).all(-1)
    beside = top & (world[..., 0] > 5) & (world[..., 1] < 1.5)
    assert below.sum() > 20 and beside.sum() > 50
    assert brightness(soft, below) < 0.8 * brightness(soft, beside)
    assert brightness(quick, below) > 0.95 * brightness(quick, beside)


@pytest.mark.parametrize("background", ["white", None])
def test_a_soft_shadow_lies_on_the_ground_alone(background):
    got = table().render("iso", SIZE, samples=1, light="studio", background=background)
    ground = got.rgba[got.ids < 0]
    if background is None:
        assert ground[:, 3].max() > 60 and ground[:, :3].max() == 0
    else:
        assert 100 < ground[:, :3].min() < 220 and ground[:, 3].min() == 255
    from_below = table().render("bottom", SIZE, samples=1, light="studio", ortho=True)
    assert (from_below.rgba[from_below.ids < 0] == 255).all()


def test_sheets_and_batches_have_the_studio_too():
    camera = shade.Camera.look_at((3, -9, 7), (3, 3, 0), fov=50, aspect=4 / 3)
    other = shade.Camera.look_at((9, -9, 7), (3, 3, 0), fov=50, aspect=4 / 3)
    one = table().render(camera, SIZE, samples=1, light="studio")
    rgb, depth, ids = table().render_batch([camera, other], size=SIZE, light="studio")
    assert np.array_equal(rgb[0], one.rgba[..., :3]) and np.array_equal(depth[0], one.depth)
    quick = table().render_batch([camera, other], size=SIZE)
    assert np.array_equal(quick[2], ids) and not np.array_equal(quick[0][1], rgb[1])
    poses = np.array([[part.pose for part in table().parts]] * 2)
    poses[1, 1, 2, 3] = 0.2    # the box stands on the plate: its shadow is elsewhere
    moved = table().render_batch(camera, poses, size=SIZE, light="studio")[0]
    again = table()
    again.parts[1] = replace(again.parts[1], pose=poses[1, 1])
    assert np.array_equal(moved[0], rgb[0])
    assert np.array_equal(moved[1],
                          again.render(camera, SIZE, samples=1, light="studio").rgba[..., :3])
    mesh = shade.Mesh(*box(2, 2, 1))
    soft = shade.sheet(mesh, ["front", "iso"], size=SIZE, samples=1, light="studio", edges=False)
    plain = shade.sheet(mesh, ["front", "iso"], size=SIZE, samples=1, edges=False)
    assert np.array_equal(soft.ids, plain.ids) and soft.difference(plain).max() > 20
    assert shade.export_png(mesh, views=["front", "iso"], size=SIZE, samples=1, light="studio",
                            edges=False) == soft.png()


@pytest.mark.parametrize("up", ["y", "z"])
def test_threads_and_scale_change_nothing_that_is_seen(up):
    vertices, faces, normals = torus(12)
    one, two, large = (shade.render(k * vertices, faces, normals=normals, size=SIZE, up=up,
                                    light="studio", threads=threads)
                       for k, threads in ((1, 1), (1, 3), (1000, 2)))
    assert one == two
    assert np.median(one.difference(large)) <= 1 and (one.difference(large) > 30).mean() < 0.02


def test_a_scene_without_triangles_has_a_picture():
    assert (shade.Scene().render("iso", (20, 20), light="studio").rgba == 255).all()
    with pytest.raises(shade.Error, match="light must be one of"):
        shade.Scene().render("iso", (20, 20), light="sun")


def test_what_lies_at_centres_is_alike_for_odd_and_even_samples():
    vertices, faces, _ = torus(24)
    scene = shade.Scene()
    scene.add((vertices, faces))
    one, two, three = (scene.render((30, 40), SIZE, samples=n) for n in (1, 2, 3))
    assert np.array_equal(one.ids, two.ids) and np.array_equal(one.depth, two.depth)
    # vertices are snapped to a finer grid where samples are closer
    same = one.ids == three.ids
    assert same.mean() > 0.998
    both = same & (one.ids >= 0)
    assert np.abs(one.depth[both] - three.depth[both]).max() < 0.05
    assert (one.normals[both] * three.normals[both]).sum(-1).min() > 0.9


def test_equal_corners_are_one_vertex_and_others_are_not():
    vertices, faces, _ = torus(24)
    assert len(shade.Mesh(vertices, faces).positions) == len(vertices)
    cube = shade.Mesh(*box())
    assert len(cube.positions) == 24 and len(cube.indices) == 12
    assert np.array_equal(cube.positions[cube.indices], cube.vertices[cube.faces])
    rgb = np.random.default_rng(3).random((12, 3))
    tinted = shade.Mesh(*box(), color=rgb, normals="flat")
    assert len(tinted.positions) == 36
    for k in range(3):
        assert len(np.unique(tinted.colors[tinted.indices[:, k]], axis=0)) == 12
    fan = np.concatenate([np.zeros((1, 3)), torus(24)[0][:500]])
    around = np.stack([np.zeros(499, int), np.arange(1, 500), np.arange(2, 501)], 1)
    many = shade.Mesh(fan, around, normals="flat")    # one vertex with hundreds of normals
    assert np.array_equal(many.positions[many.indices], many.vertices[many.faces])


def test_metal_reflects_the_studio_in_its_colour():
    """All that a rough metal sends is light times its colour; of another surface the mirror image, 4 %, is
    white.  Light below .6 is not bent toward white."""
    vertices, faces = torus(24)[:2]

    def sent(color, metal):
        surface = shade.Surface(shade.Material((0, 0, 0), color, (0, 0, 0)), metal=metal, roughness=1)
        made = shade.Mesh(vertices, faces, surfaces=(np.zeros(len(faces), int), [surface]), normals="smooth")
        got = shade.render(made, size=64, samples=1, light="studio")
        c = got.rgba[got.ids == 0][:, :3] / 255
        return np.where(c <= 0.04045, c / 12.92, ((c + 0.055) / 1.055) ** 2.4)
    for metal in (1, 0):
        grey, gold = sent((0.4, 0.4, 0.4), metal), sent((0.4, 0.2, 0.04), metal)
        seen = (grey.max(1) < 0.58) & (grey.min(1) > 0.1)
        assert seen.sum() > 200
        off = gold[seen] / grey[seen] - (1, 0.5, 0.1)
        assert np.abs(off).max() < 0.02 if metal else (off[:, 1:] > 0.03).mean() > 0.9
