"""The table of cases that C, Python and JavaScript run alike: examples/kit/test/cases.json."""
import io
import json
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
import shade_h as shade
from shade_h import _arguments as arguments
from shade_h import mujoco

HERE = Path(__file__).resolve()
TABLE = next((top / "examples/kit/test/cases.json" for top in HERE.parents
              if (top / "examples/kit/test/cases.json").is_file()), None)
CASES = json.loads(TABLE.read_text())["cases"] if TABLE else []


def near(got, want, tolerance):
    got, want = np.asarray(got, float).ravel(), np.asarray(want, float).ravel()
    assert got.shape == want.shape and np.abs(got - want).max() <= tolerance * np.abs(want).max()


def same_camera(camera, want):
    view = camera.view.T.ravel()
    near(view[:12], want["view"][:12], 1e-9)
    near(view[12:], want["view"][12:], 1e-9)
    near(camera.projection.T, want["projection"], 1e-6)


def rows(columns):
    return np.reshape(columns, (4, 4))


def color(case):
    near(arguments.hexadecimal("color", case["word"]), case["want"], 1e-12)


def colors(case):
    kind = np.int64 if case["whole"] else np.float64
    got = arguments.linear("colors", np.array(case["rows"], kind))
    near(got, case["want"], 2e-6)


def look_at(case):
    names = ("eye", "target", "up", "fov", "aspect", "near", "far")
    same_camera(shade.Camera.look_at(**{name: case[name] for name in names}), case["want"])


def opencv(case):
    camera = shade.Camera.opencv(rows3(case["K"]), rows(case["extrinsics"]), case["size"], case["near"], case["far"])
    same_camera(camera, case["want"])


def rows3(numbers):
    return np.reshape(numbers, (3, 3))


def opengl(case):
    same_camera(shade.Camera.opengl(rows(case["projection"]).T, rows(case["pose"])), case["want"])


def fit(case):
    options = {name: case[name] for name in ("ortho", "fov", "margin")}
    same_camera(shade.fitted(np.array(case["points"]), case["view"], tuple(case["size"]), **options), case["want"])


def faces(case):
    got = arguments.faces("faces", case["rows"], case["vertices"])
    assert got.ravel().tolist() == case["want"]


def pose(case):
    made = shade.Renderer(8, 8)
    ball = made.add("sphere", 1, pose=rows(case["matrix"]))
    near(ball.pose[:3, 3], case["want"], 0)


def depth(case):
    file = io.BytesIO()
    shade.save_depth(file, [case["depth"]], case["unit"])
    file.seek(0)
    assert (shade.open_ids(file) + 1)[0].tolist() == case["want"]


def ids(case):
    file = io.BytesIO()
    shade.save_ids(file, [case["ids"]])
    file.seek(0)
    assert (shade.open_ids(file) + 1)[0].tolist() == case["want"]


def handles(case):
    made, balls = shade.Renderer(8, 8), []
    for step, *given in case["steps"]:
        if step == "add":
            balls.append(made.add("sphere", 1))
            assert balls[-1] == given[0]
        elif step == "move":
            balls[given[0]].pose = given[1]
        elif step == "at":
            near(balls[given[0]].pose[:3, 3], given[1], 0)
        elif step == "stale":
            old = balls[given[0]] if given[0] < len(balls) else given[0]
            for call in (lambda: made.pose(given[0], np.eye(4)), lambda: made.remove(given[0]),
                         lambda: made.remove(old), lambda: made.pose(old, np.eye(4))):
                with pytest.raises(shade.Error, match=f"there is no object {given[0]}"):
                    call()
        elif step == "objects":
            assert made.objects == given[0]
        else:
            {"remove": made.remove, "pose": lambda n: made.pose(n, np.eye(4)), "clear": made.clear}[step](*given)


def scene(case):
    made, far = shade.Renderer(case["size"], case["size"]), np.array(case["far"], float)
    for *at, radius in case["balls"]:
        made.add("sphere", radius, at=far + at)
    eye = shade.Camera.look_at(far + case["eye"], far + case["target"], fov=case["fov"])
    counted(made.render(eye).ids[..., 0], case["want"])


def counted(ids, wanted):
    for i, want in enumerate(wanted):
        # round shapes lie within a quarter of a pixel of the true ones, along 3.545 roots of the area
        assert abs((ids == i).sum() - want) <= 3 + 0.886 * want ** 0.5


GEOM = {"type": 2, "dataid": -1, "texid": -1, "texuniform": 0, "objtype": 5, "specular": 0, "shininess": 0, "emission": 0,
        "mat": np.eye(3), "rgba": [1, 1, 1, 1], "texrepeat": [1, 1]}
LAMP = ("type headlight castshadow cutoff exponent pos dir ambient diffuse specular attenuation").split()
EYE = [f"frustum_{name}" for name in ("near", "far", "top", "bottom", "center", "width")] + ["orthographic", "pos", "forward", "up"]


def spelled(names, row):
    """An object of single numbers, then of arrays of three."""
    single = len(names) - (len(row) - len(names)) // 2
    arrays = [row[k:k + 3] for k in range(single, len(row), 3)]
    return SimpleNamespace(**dict(zip(names, [*row[:single], *arrays])))


def mjv(case):
    geoms = [SimpleNamespace(**GEOM, objid=7 + i, pos=ball[:3], size=[ball[3]] * 3) for i, ball in enumerate(case["balls"])]
    lights, cameras = ([spelled(names, row) for row in case[key]] for names, key in ((LAMP, "lights"), (EYE, "cameras")))
    made = mujoco.Renderer(SimpleNamespace(), case["size"], case["size"])
    made.take(SimpleNamespace(ngeom=len(geoms), geoms=geoms, nlight=len(lights), lights=lights, camera=cameras, flags=[1] * 10))
    made.enable_segmentation_rendering()
    pairs = made.render()
    counted(pairs[..., 0] - 7, case["want"])
    assert set(pairs[..., 1].ravel()) == {-1, 5}


def ground(case):
    made = shade.Renderer(9, 9)
    shape = made.height_field(case["heights"], case["half"])
    assert shape.count == 2 * (len(case["heights"]) - 1) * (len(case["heights"][0]) - 1)
    made.add(shape)
    x, y = case["at"]
    near(made.render(shade.Camera.look_at((x, y, 10), (x, y, 0), (0, 1, 0))).depth[4, 4], case["want"], 1e-5)


def local(case):
    made = shade.Mesh(np.array(case["points"], float), case["faces"])
    near(made.origin, case["origin"], 0)
    near(made.local, case["want"], 1e-7)


@pytest.mark.skipif(TABLE is None, reason="the table is beside the tree")
def test_the_table_is_whole():
    assert len(CASES) >= 400


@pytest.mark.parametrize("case", CASES, ids=lambda case: case["call"])
def test_a_case(case):
    run = {"color": color, "colors": colors, "look_at": look_at, "opencv": opencv, "opengl": opengl, "fit": fit,
           "faces": faces, "pose": pose, "handles": handles, "scene": scene, "depth": depth, "ids": ids,
           "mjv": mjv, "ground": ground, "local": local}[case["call"]]
    if "refused" not in case:
        run(case)
        return
    argument, words = case["refused"]
    with pytest.raises(shade.Error) as error:
        run(case)
    assert str(error.value).startswith(f"{argument} {words}")
