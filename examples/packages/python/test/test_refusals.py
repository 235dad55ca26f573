"""No argument crashes the interpreter: each is drawn, or refused by its name."""
import numpy as np
import pytest
from shapes import box, torus

import shade_h as shade

VERTICES, FACES = box()
VERY = float("nan"), float("inf"), -1e30, 0, -1, 1e-30, 2**31, 2**63, 10**400, "x", None, b"", {}


@pytest.mark.parametrize("words,arguments", [
    ("vertices", {"vertices": np.zeros((3, 2))}), ("vertices", {"vertices": "no such"}),
    ("vertices", {"vertices": np.zeros((3, 3), complex)}), ("faces", {"faces": [[0, 1, 8]]}),
    ("faces", {"faces": [[0, 1, -1]]}), ("faces", {"faces": [[0, 1, 0.5]]}),
    ("faces.*index past|faces", {"faces": [[0, 1, 2**40]]}), ("size", {"size": (0, 10)}),
    ("size", {"size": (16385, 10)}), ("samples", {"samples": 9}), ("view", {"view": "behind"}),
    ("view", {"view": (1, float("nan"))}), ("color", {"color": "#12"}),
    ("color", {"color": np.zeros((5, 3))}), ("normals", {"normals": np.zeros((8, 2))}),
    ("normals", {"normals": "round"}), ("uv", {"uv": np.zeros((8, 2))}),
    ("background", {"background": (1, 2)}), ("threads", {"threads": -1}),
    ("material", {"material": 7}), ("material must be one of", {"material": "wood"}), ("up", {"up": "w"}),
    ("light", {"light": "candle"}), ("samples", {"size": (9000, 10), "samples": 2})])
def test_the_word_that_is_wrong_is_named(words, arguments):
    given = {"vertices": VERTICES, "faces": FACES, **arguments}
    with pytest.raises(shade.Error, match=words):
        shade.render(**given)


NAN, LAMP, BYTES = float("nan"), shade.Light.directional((0, 0, -1)), np.zeros((4, 4, 3), np.uint8)
EYE = shade.Camera.look_at((3, 3, 3))


def made(**options):
    return shade.Mesh(VERTICES, FACES, **options)


def surface(**options):
    return made(uv=VERTICES[:, :2], surfaces=(np.zeros(len(FACES), int), [shade.Surface(**options)]))


def renderer(call):
    return call(shade.Renderer(8, 8))


@pytest.mark.parametrize("words, call", [
    ("color must be #RRGGBB", lambda: made(color="##ff0000")), ("color must be #RRGGBB", lambda: made(color="+0x0ff")),
    ("faces must have the shape (n, m)", lambda: shade.Mesh(VERTICES, FACES.ravel())),
    ("cmap, clim and title need scalars", lambda: made(cmap="grey")),
    ("cmap, clim and title need scalars", lambda: made(clim=(0, 1))),
    ("cmap, clim and title need scalars", lambda: made(title="x")),
    *(("texture must hold bytes, or numbers from 0 to 1", lambda fill=fill: surface(texture=np.full((4, 4, 3), fill)))
      for fill in (300, -1, 2.0, NAN, True)),
    ("wrap must be two names", lambda: surface(texture=BYTES, wrap="repeat")),
    ("wrap must be two names", lambda: renderer(lambda r: r.texture(BYTES, wrap="repeat"))),
    ("opacity must be from 0 to 1", lambda: surface(opacity=2.0)), ("opacity must be", lambda: surface(opacity=NAN)),
    ("cutoff must be", lambda: surface(cutoff=NAN)), ("blend must be True or False", lambda: surface(blend="yes")),
    ("shininess must be a number, not '32'", lambda: shade.Material(shininess="32").native()),
    ("constant must be from 0", lambda: shade.Light((0, 0, 1, 1), constant=-1).native()),
    ("spot_exponent must be from 0", lambda: shade.Light((0, 0, 1, 1), spot_exponent=-1).native()),
    ("spot_cos_cutoff must be from -1 to 1", lambda: shade.Light((0, 0, 1, 1), spot_cos_cutoff=45).native()),
    ("flags must be from 0 to 63, not 64", lambda: shade.Scene([LAMP], flags=64)),
    ("flags must be a whole number", lambda: shade.Lighting([LAMP], flags="TWO_SIDED").native()),
    ("lights must be a sequence", lambda: renderer(lambda r: r.light(LAMP))),
    ("eye must hold finite", lambda: shade.lit(shade.Lighting([LAMP]), shade.Material(), (0, 0, NAN), VERTICES, VERTICES)),
    ("K must have", lambda: shade.Camera.opencv(np.diag([100, 100, 2]), np.eye(4), (9, 9))),
    ("K must have", lambda: shade.Camera.opencv(np.zeros((3, 3)), np.eye(4), (9, 9))),
    ("extrinsics must be 3 x 4 or 4 x 4", lambda: shade.Camera.opencv(np.eye(3), np.zeros((5, 4)), (9, 9))),
    ("projection must have near and far planes", lambda: shade.Camera.opengl(np.zeros((4, 4)), np.eye(4))),
    ("aspect must be a number", lambda: shade.Camera.look_at((3, 3, 3), aspect="1")),
    ("margin must be from", lambda: shade.fitted(VERTICES, margin=-1)),
    ("at does not go with pose", lambda: renderer(lambda r: r.add("sphere", 1, at=(1, 0, 0), pose=np.eye(4)))),
    ("half[1] must be from", lambda: renderer(lambda r: r.height_field(np.zeros((4, 4)), (1, 0)))),
    ("normals must be True or False", lambda: renderer(lambda r: r.render(EYE, normals=1))),
    ("solid must be True or False", lambda: renderer(lambda r: r.render(EYE, solid="yes"))),
    ("color must be True or False", lambda: renderer(lambda r: r.frame(color=0))),
    ("points[0] must have two rows", lambda: shade.Scene().add_lines([(0, 0, 0)])),
    ("material must be one of", lambda: shade.Scene().add((VERTICES, FACES), material="Gold")),
    ("depth must have the shape (4, 4)", lambda: shade.Picture(np.zeros((4, 4, 4), np.uint8), np.zeros((3, 4)))),
    ("limit must be", lambda: shade.assert_same(shade.render(VERTICES, FACES, size=9), "none.png", -1)),
    ("outside must be True or False", lambda: shade.load(__file__, outside=1))])
def test_what_was_taken_in_silence_is_refused_by_name(words, call):
    with pytest.raises(shade.Error) as told:
        call()
    assert str(told.value).startswith(words)


def test_numbers_that_are_none_are_told():
    lost = np.where(np.arange(8)[:, None] == 7, NAN, VERTICES)
    count = (made().faces == 7).any(1).sum()
    with pytest.warns(UserWarning, match=f"^vertices: {count} triangles have corners that are no finite numbers"):
        shade.Mesh(lost, FACES)
    with pytest.warns(UserWarning, match="^uv: 1 rows are no finite numbers: they count as 0"):
        made(uv=lost[:, :2], texture=BYTES)


def test_a_folder_that_is_missing_is_named(tmp_path):
    with pytest.raises(FileNotFoundError) as told:
        shade.render(VERTICES, FACES, size=9).save(tmp_path / "none" / "a.png")
    assert told.value.filename == str(tmp_path / "none" / "a.png")


def test_odd_arrays_are_drawn_right():
    plain = shade.render(VERTICES, FACES, size=(40, 30))
    backward = np.ascontiguousarray(VERTICES[::-1])[::-1]
    spread = np.zeros((8, 6))
    spread[:, ::2] = VERTICES
    for vertices in (backward, spread[:, ::2], np.asfortranarray(VERTICES), VERTICES.tolist(),
                     VERTICES.astype(">f8"), VERTICES.astype(np.int16)):
        for faces in (FACES, FACES.astype(np.int8), FACES.astype(">u8"), FACES.tolist(),
                      FACES.astype(float), np.asfortranarray(FACES)):
            assert shade.render(vertices, faces, size=(40, 30)) == plain
    with np.errstate(all="ignore"):
        nothing = shade.render(np.zeros((0, 3)), np.zeros((0, 3), int), size=(9, 7))
    assert (nothing.rgba == 255).all() and (nothing.ids == -1).all()
    partly = np.vstack([VERTICES, [[np.nan, 0, 0]]])
    assert (shade.render(partly, [*FACES.tolist(), [0, 1, 2, 8]], size=(40, 30)).ids == 0).any()


def test_an_array_to_be_filled_must_be_the_right_one():
    scene = shade.Scene()
    scene.add((VERTICES, FACES))
    cameras = [scene.fit("iso", (8, 6))] * 2
    good = np.empty((2, 6, 8, 3), np.uint8)
    assert scene.render_batch(cameras, size=(8, 6), rgb=good)[0] is good
    frozen = good.copy()
    frozen.flags.writeable = False
    for bad in (good[::-1], good[:1], good.astype(int), frozen, [1], good[..., ::-1]):
        with pytest.raises(shade.Error, match="rgb"):
            scene.render_batch(cameras, size=(8, 6), rgb=bad)
    for poses in (np.zeros((2, 2, 4, 4)), np.zeros((3, 1, 4, 4)), np.full((2, 1, 4, 4), np.nan)):
        with pytest.raises(shade.Error, match="poses"):
            scene.render_batch(cameras, poses, size=(8, 6))
    assert scene.render_batch([], size=(8, 6))[0].shape == (0, 6, 8, 3)


def test_files_that_are_none(tmp_path):
    with pytest.raises(OSError):
        shade.load(tmp_path)
    with pytest.raises(OSError):
        shade.load(tmp_path / "missing.stl")
    for text in (b"", b"solid", b"ply\n", b"f 1 2 3\n", bytes(84) + b"\xff" * 40, b"\0" * 200):
        for name in ("a.stl", "a.obj", "a.ply"):
            (tmp_path / name).write_bytes(text)
            with pytest.raises((shade.Error, OSError)):
                shade.load(tmp_path / name)
    for path in (7, None, "a\0b"):
        with pytest.raises(shade.Error):
            shade.load(path)
    (tmp_path / "a.png").write_bytes(shade.render(VERTICES, FACES, size=(9, 9)).png()[:-40])
    with pytest.raises(shade.Error):
        shade.Picture.open(tmp_path / "a.png")


def anything(random):
    """A value of any kind, as callers pass them by mistake."""
    kind = random.integers(6)
    if kind == 0:
        return VERY[random.integers(len(VERY))]
    shape = tuple(random.integers(0, 5, random.integers(0, 4)))
    shape = ((random.integers(0, 9), random.integers(2, 5)), shape)[random.integers(2)]
    out = np.array(random.normal(size=shape) * 10.0 ** random.integers(-30, 30))
    if kind == 1 and out.size:
        out.reshape(-1)[random.integers(out.size)] = VERY[random.integers(3)]
    kinds = (np.int64, np.uint8, np.float16, np.float32, bool, complex, object, ">f4", "U3")
    with np.errstate(all="ignore"):
        if kind == 2:
            out = out.astype(kinds[random.integers(len(kinds))])
        if kind == 3:
            out = np.array(random.integers(-2, 12, shape))
    return out.T if kind == 4 else out[::-1] if out.ndim and kind == 5 else out


def bent(random, value):
    """The value, or where it is an array the same numbers in another order, type or memory."""
    if not isinstance(value, np.ndarray):
        return value
    kinds = (np.float32, np.int64, ">f8", np.uint16, np.float16)
    with np.errstate(all="ignore"):
        return np.roll(value, 1, 0)[::-1].astype(kinds[random.integers(len(kinds))])


CALLS = [
    (shade.render, {"vertices": VERTICES, "faces": FACES, "view": "iso", "size": (12, 9),
                    "color": "red", "normals": "auto", "background": "white", "samples": 1,
                    "ortho": True, "edges": True, "material": None, "threads": 1}),
    (shade.render, {"vertices": VERTICES, "faces": FACES, "uv": VERTICES[:, :2], "size": (9, 9),
                    "texture": np.zeros((4, 4, 3), np.uint8)}),
    (shade.lit, {"lighting": shade.Lighting([shade.Light.point((1, 2, 3))]),
                 "material": shade.Material(), "eye": (0, 0, 1), "points": VERTICES,
                 "normals": VERTICES, "albedo": VERTICES}),
    (shade.light_at, {"light": shade.Light.point((1, 2, 3)), "points": VERTICES}),
    (shade.Camera.look_at, {"eye": (1, 2, 3), "target": (0, 0, 0), "up": (0, 0, 1), "fov": 40,
                            "aspect": 1, "near": 1, "far": 9}),
    (shade.Camera.opencv, {"K": np.eye(3), "extrinsics": np.eye(4), "size": (9, 9)}),
    (shade.Camera.opengl, {"projection": np.eye(4), "pose": np.eye(4)}),
    (shade.preset, {"name": "gold"}),
    (shade.sheet, {"meshes": (VERTICES, FACES), "views": ["top"], "size": (9, 9), "gap": 1}),
]


def batch(**arguments):
    scene = shade.Scene()
    scene.add((VERTICES, FACES), arguments.pop("pose"), arguments.pop("material"))
    return scene.render_batch(**arguments)


def lamps(**arguments):
    scene = shade.Scene(**arguments)
    scene.add((VERTICES, FACES))
    return scene.render(size=(9, 9))


CALLS.append((lamps, {"lights": [shade.Light.point((1, 2, 3))], "ambient": np.zeros(3), "flags": 1,
                      "model": shade.Model.PHONG}))
CALLS.append((batch, {"cameras": shade.Camera.look_at((5, 5, 5)), "poses": np.eye(4)[None, None],
                      "size": (9, 9), "pose": np.eye(4), "material": "gold", "rgb": None,
                      "depth": None, "ids": None, "samples": 1}))


@pytest.mark.parametrize("seed", range(8))
def test_anything_is_drawn_or_refused(seed):
    random, refused, drawn = np.random.default_rng(seed), 0, 0
    for _ in range(150):
        function, good = CALLS[random.integers(len(CALLS))]
        given = dict(good)
        for name in random.choice(list(good), random.integers(1, 3)):
            given[name] = anything(random) if random.integers(2) else bent(random, good[name])
        try:
            with np.errstate(all="ignore"):
                function(**given)
            drawn += 1
        except (shade.Error, OSError) as why:
            assert str(why)
            refused += 1
    assert refused > 40 and drawn > 5


def test_a_large_mesh_of_bad_numbers():
    vertices, faces, _ = torus(40)
    vertices[::7] = np.nan
    vertices[::11] = 1e38
    assert shade.render(vertices, faces, size=(50, 50), edges=True).rgba.shape == (50, 50, 4)
