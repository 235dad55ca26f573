"""5,000 random mistakes in arguments: each call is drawn, or refused with a shade.Error that begins with the
name of an argument."""
import random
import re
import warnings

import numpy as np
import shade_h as shade
from shapes import box

WRONG = [None, "x", "", b"x", -1, 0, 1, 2**40, 1.5, -0.0, float("nan"), float("inf"), True, [], (), {}, [1], [1, 2],
         [1, 2, 3], (0, 0, 0), ["a", "b", "c"], [None] * 3, [[1, 2], [3]], [1, [2]], object(), np.float64(2), np.int8(3),
         np.zeros(3), np.zeros((2, 3)), np.zeros((0, 3)), np.full(3, np.nan), np.full((4, 4), np.inf), np.eye(4), np.eye(3),
         -np.eye(4), np.zeros((3, 3), complex), np.array(["a"]), np.array([None, 1]), range(3), 1 + 2j, lambda: 1, int,
         np.ma.masked_array([1.0, 2, 3], [0, 1, 0]), "red", "jade", "#12", np.uint8([255, 0, 0]), {1, 2}, iter([1, 2, 3])]
VERTICES, FACES = box()


def scene():
    made = shade.Renderer(8, 8)
    shape = made.mesh(VERTICES, FACES)
    return made, shape, made.add(shape), made.texture(np.zeros((2, 2, 3), np.uint8))


MADE, SHAPE, BALL, TEXTURE = scene()
EYE = shade.Camera.look_at((3, -3, 2))
MESH = shade.Mesh(VERTICES, FACES)
CALLS = [
    (shade.Renderer, {"height": 4, "width": 4, "samples": 1, "srgb": True, "tolerance": 0.25}),
    (MADE.mesh, {"vertices": VERTICES, "faces": FACES, "normals": "flat", "colors": VERTICES * 0 + 0.5}),
    (MADE.height_field, {"heights": np.zeros((2, 2)), "half": (1, 1)}),
    (MADE.texture, {"picture": np.zeros((2, 2, 3), np.uint8), "wrap": ("repeat", "clamp"), "squares": False}),
    (MADE.update_texture, {"number": TEXTURE, "picture": np.zeros((2, 2, 3), np.uint8)}),
    (MADE.checker, {"one": "red", "other": "blue"}),
    (MADE.add, {"shape": "sphere", "size": 1, "at": (0, 0, 0), "color": "red", "alpha": 1, "specular": 0.1, "shininess": 9,
                "emission": 0, "texture": TEXTURE, "repeat": (1, 1), "two_sided": False, "casts_shadow": True}),
    (MADE.add, {"shape": SHAPE, "size": (1, 1, 1), "pose": np.eye(4)}),
    (MADE.change, {"number": BALL, "size": 1, "color": "red", "alpha": 1, "specular": "red", "texture": TEXTURE}),
    (MADE.pose, {"number": BALL, "pose": np.eye(4)}),
    (MADE.poses, {"poses": np.eye(4)[None], "numbers": [BALL]}),
    (MADE.show, {"number": BALL, "visible": True}),
    (MADE.remove_texture, {"number": TEXTURE}),
    (MADE.light, {"lights": [shade.Light.directional((0, 0, -1))], "ambient": (0, 0, 0), "shadow": 0}),
    (MADE.background, {"color": "red"}),
    (MADE.sky, {"low": "red", "high": "blue"}),
    (MADE.sky_texture, {"texture": TEXTURE}),
    (MADE.frame, {"color": True, "depth": True, "ids": True, "normals": False, "pictures": 1}),
    (MADE.render, {"camera": EYE, "out": None, "normals": False, "solid": False, "empty_depth": 1.0}),
    (MADE.render_batch, {"cameras": [EYE], "out": None, "normals": False, "solid": False, "empty_depth": 1.0, "threads": 1}),
    (MADE.update, {"shape": SHAPE, "vertices": VERTICES, "normals": None}),
    (shade.Camera, {"view": np.eye(4), "projection": np.eye(4)}),
    (shade.Camera.look_at, {"eye": (1, 2, 3), "target": (0, 0, 0), "up": (0, 0, 1), "fov": 45, "aspect": 1, "near": 0.1, "far": 9}),
    (shade.Camera.opencv, {"K": np.eye(3), "extrinsics": np.eye(4), "size": (8, 8), "near": 0.1, "far": 9}),
    (shade.Camera.opengl, {"projection": EYE.projection, "pose": np.eye(4)}),
    (shade.fitted, {"points": VERTICES, "view": "iso", "size": (8, 8), "up": "z", "ortho": False, "fov": 28, "margin": 1.1}),
    (shade.Mesh, {"vertices": VERTICES, "faces": FACES, "color": "red", "normals": "flat", "up": "z"}),
    (lambda MESH, **options: shade.render(MESH, **options), {"MESH": MESH, "size": (8, 8), "samples": 1, "view": "iso", "background": "white", "up": "z", "ortho": False}),
    (shade.Light.directional, {"travel": (0, 0, -1), "color": (1, 1, 1)}),
    (shade.Light.point, {"position": (0, 0, 1), "color": (1, 1, 1), "attenuation": (0, 0, 1)}),
    (shade.Light.spot, {"position": (0, 0, 1), "aim": (0, 0, -1), "cutoff": 0.5, "exponent": 1}),
]
NAMED = re.compile(r"[A-Za-z_][\w.]*(\[[^\]]*\])*[ :,]|there |at does|at most|a ")


def test_five_thousand_mistakes_are_named():
    rng, bad = random.Random(7), {}
    for i in range(5000):
        call, good = rng.choice(CALLS)
        given = dict(good)
        name = rng.choice(list(given))
        given[name] = rng.choice(WRONG)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            try:
                call(**given)
            except FileNotFoundError:
                assert name == "MESH"    # a path, or a list of them
            except (shade.Error, MemoryError) as error:
                if not NAMED.match(str(error)):
                    bad[call.__qualname__, name, str(error)[:90]] = i
            except BaseException as error:
                bad[call.__qualname__, name, f"{type(error).__name__}: {error}"[:110]] = i
    assert not bad, "\n".join(map(str, bad))
