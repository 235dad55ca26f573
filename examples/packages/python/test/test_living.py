"""A Renderer whose objects, shapes and textures come, change and go."""
import pickle

import numpy as np
import pytest
import shade_h as shade
from test_renderer import crowd, eyes, rays, resident, turned

EYE = eyes(1)[0]
SHAPES = {"sphere": 0.3, "box": (0.2, 0.3, 0.1), "capsule": (0.1, 0.3), "cylinder": (0.2, 0.2),
          "ellipsoid": (0.3, 0.2, 0.1)}


def lit(made):
    made.light([shade.Light.directional((-0.5, 0.8, -1.2), (0.5, 0.5, 0.5)),
                shade.Light.spot((2, -2, 4), (-0.4, 0.4, -1), 0.6, 1, (0.4, 0.2, 0.2))],
               (0.3, 0.3, 0.3), shadow=(0, 1))
    return made


def texels(rng):
    return rng.integers(0, 256, (4, 4, 3), np.uint8).repeat(4, 0).repeat(4, 1)


def pyramid(rng):
    """Vertices, faces and uv; the number of vertices changes."""
    n = int(rng.integers(3, 7))
    a = np.arange(n) * 2 * np.pi / n
    rim = np.stack([np.cos(a), np.sin(a), np.zeros(n)], 1) * rng.uniform(0.5, 1)
    faces = [[i, (i + 1) % n, n] for i in range(n)] + [[0, i + 1, i] for i in range(1, n - 1)]
    return np.concatenate([rim, [[0, 0, rng.uniform(0.5, 1)]]]), faces, rng.random((n + 1, 2))


def test_any_history_ends_in_the_picture_of_a_new_renderer():
    """5,040 random steps; now and then what is there is built anew, and the pictures are compared."""
    for seed in range(56):
        rng = np.random.default_rng(seed)
        made = lit(shade.Renderer(48, 64))
        shapes, pictures, objects = {}, {}, {}    # what they are by now, by our own numbers

        def looks(rng=rng, pictures=pictures):
            got = {"color": tuple(rng.random(3)), "alpha": 0.5 if rng.random() < 0.2 else 1,
                   "specular": tuple(rng.random(3)) if rng.random() < 0.5 else rng.random(),
                   "shininess": float(rng.integers(1, 60)), "emission": rng.random() if rng.random() < 0.3 else 0,
                   "two_sided": bool(rng.random() < 0.5), "casts_shadow": bool(rng.random() < 0.8)}
            if pictures and rng.random() < 0.5:
                got["texture"] = sorted(pictures)[int(rng.integers(len(pictures)))]
            return got

        for step in range(90):
            what = int(rng.integers(9))
            if what == 0 or not objects:
                name = sorted(SHAPES)[int(rng.integers(5))]
                shape = sorted(shapes)[int(rng.integers(len(shapes)))] if shapes and rng.random() < 0.5 else name
                own, size, pose = looks(), SHAPES[name] if shape == name else 0.4, turned(rng)
                real = shapes[shape][0] if shape in shapes else shape
                number = made.add(real, size, pose=pose, **own)
                assert number not in objects
                objects[number] = [shape, size, pose, own, True]
            elif what == 1:
                arrays = pyramid(rng)
                shape = made.mesh(arrays[0], arrays[1], uv=arrays[2])
                shapes[100 + step] = [shape, arrays]
            elif what == 2:
                picture = texels(rng)
                pictures[made.texture(picture)] = picture
            elif what == 3 and shapes:
                one = shapes[sorted(shapes)[int(rng.integers(len(shapes)))]]
                one[1] = pyramid(rng)
                made.update(one[0], one[1][0], one[1][1], uv=one[1][2])
            elif what == 4 and pictures:
                number = sorted(pictures)[int(rng.integers(len(pictures)))]
                pictures[number] = texels(rng)
                made.update_texture(number, pictures[number])
            elif what == 5:
                number = sorted(objects)[int(rng.integers(len(objects)))]
                made.remove(number)
                del objects[number]
            elif what == 6:
                number = sorted(objects)[int(rng.integers(len(objects)))]
                new = looks()
                new.setdefault("texture", None)
                made.change(number, **new)
                objects[number][3] = {k: v for k, v in {**objects[number][3], **new}.items() if v is not None}
            elif what == 7:
                number = sorted(objects)[int(rng.integers(len(objects)))]
                objects[number][2], objects[number][4] = turned(rng), bool(rng.random() < 0.8)
                made.pose(number, objects[number][2])
                made.show(number, objects[number][4])
            elif what == 8:
                poses = [turned(rng) for _ in objects]
                made.poses(poses)
                for number, pose in zip(sorted(objects), poses):
                    objects[number][2] = pose
                used = {o[0] for o in objects.values()}
                for name in [n for n in shapes if n not in used][:1]:
                    made.remove(shapes.pop(name)[0])
                shown = {o[3].get("texture") for o in objects.values()}
                for number in [n for n in pictures if n not in shown][:1]:
                    made.remove_texture(number)
                    del pictures[number]
            assert made.objects == sorted(objects)
            if step % 22 and step < 88:
                continue
            other = lit(shade.Renderer(48, 64))
            maps = {n: other.texture(picture) for n, picture in pictures.items()}
            meshes = {n: other.mesh(a[0], a[1], uv=a[2]) for n, (_, a) in shapes.items()}
            numbers = {}
            for record in made._scene.records():    # blended ones of one distance are drawn in this order
                number = int(record["id"])
                shape, size, pose, own, visible = objects[number]
                own = {**own, "texture": maps[own["texture"]]} if "texture" in own else own
                there = other.add(meshes.get(shape, shape), size, pose=pose, **own)
                other.show(there, visible)
                numbers[there] = number
            one, two = made.render(EYE, normals=True), other.render(EYE, normals=True)
            assert np.array_equal(one.color, two.color) and np.array_equal(one.depth, two.depth)
            assert np.array_equal(one.normals, two.normals)
            table = np.array([numbers.get(i, -1) for i in range(-1, max(numbers, default=-1) + 1)])
            assert np.array_equal(one.ids[..., 0], table[two.ids[..., 0] + 1])
            assert np.array_equal(one.ids[..., 1], two.ids[..., 1])
            again = pickle.loads(pickle.dumps(made)).render(EYE)
            assert np.array_equal(again.color, one.color) and np.array_equal(again.ids, one.ids)


def test_lamps_with_shadows_add_up():
    """Light is a sum over lamps: with both it is that of each by itself."""
    lamps = [shade.Light.directional((1, 0.5, -1), (0.4, 0.1, 0.1)),
             shade.Light.directional((-1, 0.3, -1), (0.1, 0.4, 0.1)),
             shade.Light.spot((0, -1, 4), (0, 0.25, -1), 0.6, 0, (0.1, 0.1, 0.4))]

    def seen(which, shadow):
        made = shade.Renderer(120, 160, srgb=False)
        made.add("plane", (3, 3))
        made.add("box", (0.3, 0.3, 0.5), at=(0, 0, 0.5))
        made.add("sphere", 0.4, at=(-1, 0.5, 0.4))
        made.light([lamps[k] for k in which], (0, 0, 0), shadow)
        made.background("black")
        return made.render(EYE).color.astype(int)

    alone = [seen([k], 0) for k in range(3)]
    assert np.abs(sum(alone) - seen([0, 1, 2], [0, 1, 2])).max() <= 2    # each is rounded to a byte
    open_ = seen([0, 1, 2], None)
    for k in range(3):    # one of three casts: the others light its shadow
        part = sum(seen([j], 0 if j == k else None) for j in range(3))
        got = seen([0, 1, 2], [k])
        assert np.abs(part - got).max() <= 2
        assert (np.abs(open_ - got).max(-1) > 20).sum() > 100


def test_a_map_follows_a_mesh_that_changes():
    made = shade.Renderer(60, 60)
    made.add("plane", (3, 3))
    shape = made.mesh([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], [[0, 1, 2, 3]], normals="flat")
    made.add(shape, 0.5, at=(0, 0, 1), two_sided=True)
    made.light([shade.Light.directional((0, 0.2, -1), (1, 1, 1))], (0, 0, 0), shadow=0)
    low = shade.Camera.look_at((0, -4, 0.4), (0, 0, 0), fov=60)
    dark = (made.render(low).color == 0).all(-1).sum()
    made.update(shape, [[-2, -1, 0], [2, -1, 0], [2, 1, 0], [-2, 1, 0]])
    assert (made.render(low).color == 0).all(-1).sum() > 1.5 * dark > 50


QUAD = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], float)


def leaf():
    """A quad with a hole where x > 0 and y > 0, of which another surface, which blends, stands beside."""
    green, grey = np.full((64, 64, 4), (0, 255, 0, 255), np.uint8), np.full((8, 8, 4), (0, 0, 0, 255), np.uint8)
    green[:32, 32:, 3] = 0
    grey[:, :, 3] = 128
    return shade.Mesh(np.concatenate([QUAD, QUAD + (2, 0, 0)]), [[0, 1, 2, 3], [4, 5, 6, 7]], normals="flat",
                      uv=np.concatenate([QUAD[:, :2] / 2 + 0.5] * 2),
                      surfaces=([0, 1], [shade.Surface(None, green, cutoff=0.5),
                                         shade.Surface(None, grey, blend=True)]))


@pytest.mark.parametrize("samples", [1, 3])
def test_surfaces_of_a_file_keep_their_textures_holes_and_transparency(samples):
    made = shade.Renderer(80, 160, samples=samples)
    wall = made.add("plane", (3, 3), at=(1, 0, -1), color="#ff0000")
    one = made.add(made.mesh(leaf()))
    made.light([], (1, 1, 1))
    above = shade.Camera.look_at((1, 0, 6), (1, 0, 0), up=(0, 1, 0), fov=40, aspect=2)
    frame = made.render(above)
    eye, way = rays(above, 80, 160)
    flat = (eye + (-eye[2] / way[..., 2])[..., None] * way)[..., :2]    # where z is 0
    x, y = flat[..., 0], flat[..., 1]
    inside = (np.abs(y) < 0.95) & (np.abs(x) < 0.95)
    far = (np.abs(x) > 0.06) & (np.abs(y) > 0.06)
    hole = inside & far & (x > 0) & (y > 0)
    whole = inside & far & ((x < 0) | (y < 0))
    glass = (np.abs(y) < 0.95) & (np.abs(x - 2) < 0.95)
    assert hole.sum() > 200 and whole.sum() > 600 and glass.sum() > 900
    assert (frame.color[hole] == (255, 0, 0)).all() and (frame.ids[hole][:, 0] == wall).all()
    assert (frame.color[whole] == (0, 255, 0)).all() and (frame.ids[whole][:, 0] == one).all()
    assert np.abs(frame.depth[whole] - 6).max() < 0.01 and np.abs(frame.depth[hole] - 7).max() < 0.01
    half = 255 * (1.055 * (127 / 255) ** (1 / 2.4) - 0.055)    # of red in linear light
    assert np.abs(frame.color[glass] - (half, 0, 0)).max() <= 1 and (frame.ids[glass][:, 0] == wall).all()
    assert (np.unique(frame.ids[whole][:, 1]) == [0, 1]).all()
    made.change(one, color="#ff8000")
    assert np.abs(made.render(above).color[whole].astype(int) - (0, 128, 0)).max() <= 1


def test_holes_cast_light_through_a_shadow():
    made = shade.Renderer(120, 120)
    made.add("plane", (4, 4), at=(0, 0, -2))
    made.add(made.mesh(leaf()), two_sided=True)
    made.light([shade.Light.directional((0.001, 0, -1), (1, 1, 1))], (0, 0, 0), shadow=0)
    low = shade.Camera.look_at((0, -6, -1), (0, 0, -2), fov=50)
    frame = made.render(low)
    eye, way = rays(low, 120, 120)
    floor = frame.ids[..., 0] == 0
    p = eye + np.where(floor, frame.depth, 0)[..., None] * way
    lighted = frame.color[..., 0] > 100
    hole = floor & (p[..., 0] > 0.1) & (p[..., 0] < 0.9) & (p[..., 1] > 0.1) & (p[..., 1] < 0.9)
    leaf_ = floor & (p[..., 0] > -0.9) & (p[..., 0] < -0.1) & (np.abs(p[..., 1]) < 0.9)
    assert hole.sum() > 40 and leaf_.sum() > 80
    assert lighted[hole].all() and not lighted[leaf_].any()


def test_holes_hide_nothing_in_any_order():
    """Many layers with holes through each other: colour and ids belong to one surface."""
    rng, made = np.random.default_rng(5), shade.Renderer(64, 64)
    shape = made.mesh(leaf())
    colors = rng.integers(60, 255, (12, 3))
    for color in colors:
        made.add(shape, 0.7, pose=turned(rng), color=color, two_sided=True)
    made.light([], (1, 1, 1))
    for camera in eyes(4):
        frame = made.render(camera)
        plain = made.render(camera, shade.Frame(None, frame.depth.copy(), None, None))
        ids, green = frame.ids[..., 0], frame.color[..., 1].astype(int)
        seen = ids >= 0
        assert seen.sum() > 400
        assert np.array_equal(plain.depth, frame.depth)
        # the texture is green, and what blends over it is black at half of the light or less
        shown = colors[ids[seen], 1]
        assert (green[seen] <= shown + 1).all() and (np.abs(green[seen] - shown) <= 1).mean() > 0.6


def test_a_batch_is_the_pictures_one_by_one():
    made, rng = crowd(shadow=0), np.random.default_rng(3)
    cameras = eyes(5)
    for threads in (1, 2, 5, 8):
        batch = made.render_batch(cameras, normals=True, threads=threads)
        for i, camera in enumerate(cameras):
            one = made.render(camera, normals=True)
            assert all(np.array_equal(a[i], b) for a, b in zip(batch, one))
    poses = np.array([[turned(rng) for _ in made.objects] for _ in range(5)])
    home = made.render(cameras[0]).color
    for seen in (cameras, cameras[0]):
        out = made.frame(pictures=5)
        batch = made.render_batch(seen, poses, out)
        assert batch is out and np.array_equal(made.render(cameras[0]).color, home)
        for i in range(5):
            other = pickle.loads(pickle.dumps(made))
            other.poses(poses[i])
            one = other.render(cameras[i] if seen is cameras else seen)
            assert np.array_equal(one.color, batch.color[i]) and np.array_equal(one.ids, batch.ids[i])
    assert made.render_batch([]).color.shape == (0, 60, 80, 3)
    bad = poses.copy()
    bad[2, 7] *= 2
    with pytest.raises(shade.Error, match=r"poses\[2\]\[7\] must be a rotation"):
        made.render_batch(cameras, bad)
    with pytest.raises(shade.Error, match=r"poses must have the shape"):
        made.render_batch(cameras, poses[:, :3])
    with pytest.raises(shade.Error, match=r"poses must have a row for each of 5"):
        made.render_batch(cameras, poses[:3])
    with pytest.raises(shade.Error, match=r"cameras\[1\] must be a shade_h.Camera"):
        made.render_batch([EYE, None])
    with pytest.raises(shade.Error, match=r"out.color must be uint8 of shape \(2, 60, 80, 3\)"):
        made.render_batch(cameras[:2], out=made.frame(pictures=3))


def test_a_thousand_scenes_leave_the_process_as_large_as_it_was():
    made, rng = shade.Renderer(64, 64), np.random.default_rng(1)

    def scene():
        # small in the picture, which takes most of the time otherwise
        shapes = [made.mesh(rng.random((3000, 3)) / 10, rng.integers(0, 3000, (2000, 3)), normals="smooth")
                  for _ in range(2)]
        maps = [made.texture(rng.integers(0, 256, (128, 128, 3), np.uint8)) for _ in range(2)]
        numbers = [made.add(shapes[i % 2], texture=maps[i % 2], pose=turned(rng)) for i in range(6)]
        lit(made).render(EYE)
        return shapes, maps, numbers
    most = 0
    for i in range(1000):
        shapes, maps, numbers = scene()
        if i % 2:
            for number in numbers:
                made.remove(number)
            for shape in shapes:
                made.remove(shape)
            for number in maps:
                made.remove_texture(number)
        else:
            made.clear()
        if i == 20:
            before = resident()
        if i > 20:
            most = max(most, resident())
    assert most - before < 10 * 2**20, most - before
    assert made.objects == [] and not made._meshes and not made._textures


def test_what_is_in_use_stays_and_what_is_gone_is_refused():
    made, other = shade.Renderer(20, 20), shade.Renderer(20, 20)
    own, shape = made.texture(np.zeros((2, 2, 3))), made.mesh(leaf())
    cube = made.texture(np.zeros((6, 2, 2, 3)))
    plain = made.mesh(QUAD, [[0, 1, 2, 3]])
    one, two = made.add(shape, texture=own), made.add("sphere", 1)
    made.sky_texture(cube)
    ground = made.height_field(np.zeros((3, 3)), (1, 1))
    before = made.render(EYE).color
    for words, call in (
            ("object 0 shows the shape", lambda: made.remove(shape)),
            ("object 0 has texture", lambda: made.remove_texture(own)),
            ("a shape has texture", lambda: made.remove_texture(shape.textures[0])),
            ("the sky has texture", lambda: made.remove_texture(cube)),
            ("there is no texture 99", lambda: made.remove_texture(99)),
            ("there is no object 7", lambda: made.remove(7)),
            ("there is no object 7", lambda: made.change(7, color="red")),
            ("there is no object 7", lambda: made.poses([np.eye(4)], [7])),
            ("option must be one of color", lambda: made.change(one, colour="red")),
            ("alpha must be from 0 to 1", lambda: made.change(one, alpha=2)),
            ("size of a sphere must be positive", lambda: made.change(two, size=-1)),
            ("there is no texture 99", lambda: made.change(two, texture=99)),
            ("shape must be of this renderer", lambda: other.add(shape)),
            ("shape must be of this renderer", lambda: other.remove(shape)),
            ("vertices must be a Mesh", lambda: made.update(shape, QUAD)),
            (r"picture: texture \d+ is no cube", lambda: made.update_texture(own, np.zeros((6, 2, 2, 3)))),
            (r"picture: texture \d+ is cube", lambda: made.update_texture(cube, np.zeros((2, 2, 3)))),
            ("vertices must hold finite", lambda: made.update(plain, np.full((4, 3), np.nan))),
            ("heights must have two rows", lambda: made.update(ground, [[1.0]])),
            (r"shadow must be from 0 to 0", lambda: made.light([shade.Light.directional((0, 0, -1))], (), [0, 1]))):
        with pytest.raises(shade.Error, match=words):
            call()
    assert np.array_equal(made.render(EYE).color, before)
    made.remove(one)
    made.remove(shape)
    for call in (lambda: made.add(shape), lambda: made.update(shape, leaf()), lambda: made.remove(shape),
                 lambda: made.remove(one), lambda: made.pose(one, np.eye(4))):
        with pytest.raises(shade.Error, match="shape must be of this renderer|there is no object 0"):
            call()
    assert made.add("box", (1, 1, 1)) == one + 2    # no number is given twice
    made.clear()
    made.render(EYE)
    with pytest.raises(shade.Error, match="there is no object"):
        made.show(two)
