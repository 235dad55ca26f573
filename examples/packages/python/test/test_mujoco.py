"""mujoco.Renderer's twin, over a recording of MuJoCo's own scene: the package for JavaScript, which draws
what the real engine steps, made robots.json with the hashes of its pictures."""
import hashlib
import json
import pickle
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

import shade_h as shade
from shade_h.mujoco import Renderer

TOLD = json.loads(Path(__file__).with_name("robots.json").read_text("utf-8"))


def model():
    return SimpleNamespace(**{k: np.array(v) for k, v in TOLD["model"].items()}, ncam=1)


def scene():
    told = TOLD["scene"]
    def objects(rows):    # noqa: E306
        return [SimpleNamespace(**{k: np.array(v) if isinstance(v, list) else v
                                   for k, v in row.items()}) for row in rows]
    return SimpleNamespace(ngeom=len(told["geoms"]), geoms=objects(told["geoms"]),
                           nlight=len(told["lights"]), lights=objects(told["lights"]),
                           camera=objects(told["cameras"]), flags=told["flags"])


def test_pictures_are_those_of_the_package_for_javascript():
    with Renderer(model(), 60, 80) as renderer:
        renderer.take(scene())
        got = {"color": renderer.render()}
        renderer.enable_depth_rendering()
        got["depth"] = renderer.render()
        renderer.enable_segmentation_rendering()
        got["segmentation"] = renderer.render()
    assert [a.shape for a in got.values()] == [(60, 80, 3), (60, 80), (60, 80, 2)]
    assert [a.dtype for a in got.values()] == [np.uint8, np.float32, np.int32]
    for name, array in got.items():
        assert hashlib.sha256(array.tobytes()).hexdigest() == TOLD["hashes"][name], name
    pairs = got["segmentation"].reshape(-1, 2)
    assert len(np.unique(pairs, axis=0)) >= 8 and set(pairs[:, 1]) == {-1, 5}
    far = TOLD["scene"]["cameras"][0]["frustum_far"]
    assert np.allclose(got["depth"].reshape(-1)[pairs[:, 0] < 0], far)
    assert len(np.unique(got["color"])) > 60


def test_modes_and_out():
    renderer = Renderer(model(), 60, 80)
    assert not renderer.render().any()    # an empty scene, as in MuJoCo
    renderer.take(scene())
    first = renderer.render()
    renderer.enable_depth_rendering()
    renderer.enable_segmentation_rendering()
    assert renderer.render().shape == (60, 80, 2)
    renderer.disable_segmentation_rendering()
    out = np.zeros((60, 80, 3), np.uint8)
    assert renderer.render(out=out) is out and np.array_equal(out, first)
    with pytest.raises(shade.Error, match=r"out must be uint8 of shape \(60, 80, 3\)"):
        renderer.render(out=np.zeros((60, 80), np.float32))


def test_what_is_changed_before_render_is_drawn():
    """As programs do that turn shadows off, or add geoms of their own after update_scene."""
    renderer, told = Renderer(model(), 60, 80), scene()
    renderer.take(told)
    first = renderer.render()
    told.flags = [0, *told.flags[1:]]
    bright = renderer.render()
    assert (bright >= first).all() and (bright > first).any()
    ball = next(g for g in told.geoms if g.type == 2)
    added = SimpleNamespace(**{**vars(ball), "pos": ball.pos + [0, 0, 0.7], "objid": 77, "segid": 9,
                               "rgba": np.array([1.0, 0, 0, 1])})
    told.geoms.append(added)
    told.ngeom += 1
    more = renderer.render()
    assert (more != bright).any()
    renderer.enable_segmentation_rendering()
    assert (renderer.render()[..., 0] == 77).sum() > 20
    added.segid = -1    # what has no number is in colour alone
    assert not (renderer.render()[..., 0] == 77).any()
    renderer.disable_segmentation_rendering()
    assert np.array_equal(renderer.render(), more)


def test_a_copy_draws_the_same():
    renderer = Renderer(model(), 60, 80)
    renderer.take(scene())
    first = renderer.render()
    assert np.array_equal(pickle.loads(pickle.dumps(renderer)).render(), first)


def test_a_mesh_whose_faces_name_what_is_not_there_is_refused():
    for name in ("mesh_face", "mesh_facenormal"):
        broken = model()
        setattr(broken, name, getattr(broken, name) + 99)
        renderer = Renderer(broken, 60, 80)
        renderer.take(scene())
        with pytest.raises(shade.Error, match="model: a face of mesh 0 has no vertex"):
            renderer.render()


def test_rows_of_other_lengths_are_refused():
    for name, field in (("geoms", "rgba"), ("geoms", "mat"), ("lights", "pos"), ("camera", "up")):
        for length in (1, 2, 12):
            for everywhere in (False, True):
                taken = scene()
                for one in getattr(taken, name)[:None if everywhere else 1]:
                    setattr(one, field, np.ones(length))
                renderer = Renderer(model(), 60, 80)
                renderer.take(taken)
                with pytest.raises(shade.Error, match=f"{name} must have the fields of an mjvScene's"):
                    renderer.render()


class Engine:
    """What update_scene asks of the mujoco module."""

    mjtObj = SimpleNamespace(mjOBJ_CAMERA=7)
    mjtCamera = SimpleNamespace(mjCAMERA_FREE=0, mjCAMERA_FIXED=2)
    mjtCatBit = SimpleNamespace(mjCAT_ALL=SimpleNamespace(value=7))

    def __init__(self):
        self.asked = []

    @staticmethod
    def MjvScene(model, maxgeom):    # noqa: N802
        return scene()

    MjvOption = MjvCamera = staticmethod(SimpleNamespace)

    @staticmethod
    def mj_name2id(model, kind, name):
        return 0 if (kind, name) == (7, "eye") else -1

    @staticmethod
    def mjv_defaultFreeCamera(model, camera):    # noqa: N802
        camera.free = True

    def mjv_updateScene(self, model, data, option, perturb, camera, category, scene):    # noqa: N802
        self.asked.append((data, camera, category))


def test_cameras_by_number_name_and_object(monkeypatch):
    engine = Engine()
    monkeypatch.setitem(__import__("sys").modules, "mujoco", engine)
    renderer = Renderer(model(), 60, 80)
    renderer.update_scene("state")
    renderer.update_scene("state", camera="eye")
    own = SimpleNamespace()
    renderer.update_scene("state", camera=own)
    assert [a[0] for a in engine.asked] == ["state"] * 3 and {a[2] for a in engine.asked} == {7}
    assert engine.asked[0][1].free and engine.asked[1][1].type == 2 and engine.asked[2][1] is own
    assert hashlib.sha256(renderer.render().tobytes()).hexdigest() == TOLD["hashes"]["color"]
    assert renderer.scene is renderer.scene and renderer.scene.ngeom == len(TOLD["scene"]["geoms"])
    for wrong in ("nobody", 5, -2):
        with pytest.raises(shade.Error, match="camera"):
            renderer.update_scene("state", camera=wrong)
