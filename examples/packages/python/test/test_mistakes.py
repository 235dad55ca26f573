"""5,000 random mistakes in arguments, of the table that the package for Node.js plays too: each call is drawn, or
refused with a shade.Error that names the argument."""
import json
import pathlib
import random
import re
import warnings

import numpy as np
import shade_h as shade
from shapes import box

TABLE = json.loads((pathlib.Path(__file__).parents[3] / "kit/test/mistakes.json").read_text())
VERTICES, FACES = box()


def scene():
    made = shade.Renderer(8, 8)
    shape = made.mesh(VERTICES, FACES, normals="flat")
    return made, shape, made.add(shape), made.texture(np.zeros((2, 2, 3), np.uint8))


MADE, SHAPE, BALL, TEXTURE = scene()
EYE = shade.Camera.look_at((3, -3, 2))
MESH = shade.Mesh(VERTICES, FACES)
WORDS = {"@nan": float("nan"), "@infinity": float("inf"), "@-0": -0.0, "@nans": np.full(3, np.nan),
         "@infinities": np.full((4, 4), np.inf), "@identity": np.eye(4), "@mirror": -np.eye(4), "@bytes": np.uint8([255, 0, 0]),
         "@lambda": lambda: 1, "@shape": SHAPE, "@ball": BALL, "@balls": [BALL], "@texture": TEXTURE, "@eye": EYE, "@eyes": [EYE],
         "@vertices": VERTICES, "@faces": FACES, "@greys": VERTICES * 0 + 0.5, "@heights": np.zeros((2, 2)),
         "@picture": np.zeros((2, 2, 3), np.uint8), "@poses": np.eye(4)[None], "@lamps": [shade.Light.directional((0, 0, -1))],
         "@K": np.eye(3), "@projection": EYE.projection, "@MESH": MESH}
# What JSON has no word for
OWN = [b"x", (), [None] * 3, object(), np.float64(2), np.int8(3), np.zeros(3), np.zeros((2, 3)), np.zeros((0, 3)), np.eye(3),
       np.zeros((3, 3), complex), np.array(["a"]), np.array([None, 1]), range(3), 1 + 2j, int,
       np.ma.masked_array([1.0, 2, 3], [0, 1, 0]), {1, 2}, iter([1, 2, 3])]


def valued(value):
    return WORDS[value] if isinstance(value, str) and value in WORDS else value


WRONG = [valued(value) for value in TABLE["wrong"]] + OWN
OTHERS = {"Renderer": shade.Renderer, "Camera.look_at": shade.Camera.look_at, "Camera.opencv": shade.Camera.opencv,
          "Camera.opengl": shade.Camera.opengl, "fitted": shade.fitted, "Mesh": shade.Mesh,
          "draw": lambda MESH, **options: shade.render(MESH, **options),
          "remove": lambda what: None if what is SHAPE or isinstance(what, (int, np.integer)) and what == BALL else MADE.remove(what),
          "remove_texture": lambda number: None if isinstance(number, (int, np.integer)) and number == TEXTURE else MADE.remove_texture(number)}
CALLS = [(name, OTHERS.get(name) or getattr(MADE, name), {k: valued(v) for k, v in good.items()}) for name, good in TABLE["calls"]] + [
    ("Camera", shade.Camera, {"view": np.eye(4), "projection": np.eye(4)}),
    ("render_batch", MADE.render_batch, {"cameras": [EYE], "normals": False, "threads": 1}),
    ("Mesh", shade.Mesh, {"vertices": VERTICES, "faces": FACES, "up": "z"}),
    ("Light.directional", shade.Light.directional, {"travel": (0, 0, -1), "color": (1, 1, 1)}),
    ("Light.point", shade.Light.point, {"position": (0, 0, 1), "color": (1, 1, 1), "attenuation": (0, 0, 1)}),
    ("Light.spot", shade.Light.spot, {"position": (0, 0, 1), "aim": (0, 0, -1), "cutoff": 0.5, "exponent": 1}),
]
# Arguments whose mistake may be told by another's name, with which it does not go
BESIDE = {"lights": "lights|shadow", "MESH": "mesh|vertices|faces|path|points", "vertices": "vertices|faces|colors|normals", "numbers": "numbers|poses",
          "points": "points|positions|vertices", "number": "number|object|picture"}


def test_five_thousand_mistakes_are_named():
    rng, bad = random.Random(7), {}
    for i in range(5000):
        title, call, good = rng.choice(CALLS)
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
                if not isinstance(error, MemoryError) and not re.search(rf"\b({BESIDE.get(name, name)})\b", str(error)):
                    bad[title, name, str(error)[:120]] = i
            except BaseException as error:
                bad[title, name, f"{type(error).__name__}: {error}"[:110]] = i
    assert not bad, "\n".join(map(str, bad))
