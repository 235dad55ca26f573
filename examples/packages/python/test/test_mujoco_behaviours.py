"""What MuJoCo's own class does in its public tests and in its documentation: a list, and how many."""
from types import SimpleNamespace

import numpy as np
import pytest
from test_mujoco import Engine, model, scene

from shade_h.mujoco import Renderer

SIZE = (60, 80)


@pytest.fixture()
def renderer(monkeypatch):
    monkeypatch.setitem(__import__("sys").modules, "mujoco", Engine())
    return Renderer(model(), *SIZE)


def refused(error, words, call):
    with pytest.raises(error, match=words):
        call()


def a_camera_without_a_name(r):
    refused(ValueError, 'camera "b" does not exist', lambda: r.update_scene("state", "b"))


def a_camera_below_the_range(r):
    refused(ValueError, "-2 is out of range", lambda: r.update_scene("state", -2))


def a_camera_above_the_range(r):
    refused(ValueError, "1 is out of range", lambda: r.update_scene("state", 1))


def a_picture_that_is_not_black(r):
    r.update_scene("state", "eye")
    assert r.render().any()


def an_array_for_each_picture(r):
    told = scene()
    r.take(told)
    pictures = [r.render()]
    for tint in np.eye(3):
        for geom in told.geoms:
            geom.rgba = np.array([*tint, 1])
        pictures.append(r.render())
        assert pictures[-1] is not pictures[-2] and (pictures[-1] != pictures[-2]).any()


def the_array_that_is_handed_in(r):
    r.update_scene("state", "eye")
    out = np.zeros((*SIZE, 3), np.uint8)
    assert r.render(out=out) is out and out.any()
    refused(ValueError, "out", lambda: r.render(out=np.zeros((10, 10, 3), np.uint8)))
    refused(TypeError, "out", lambda: r.render(out=np.zeros((*SIZE, 3), np.float32)))


def black_before_update_scene(r):
    assert not r.render().any()
    r.enable_segmentation_rendering()
    assert (r.render() == -1).all()


def depth_and_segmentation_by_turns(r):
    r.update_scene("state", "eye")
    r.enable_depth_rendering()
    assert r.render().shape == SIZE and r.render().dtype == np.float32
    r.enable_segmentation_rendering()
    assert r.render().shape == (*SIZE, 2) and r.render().dtype == np.int32
    r.disable_segmentation_rendering()
    assert r.render().shape == (*SIZE, 3) and r.render().dtype == np.uint8


def nothing_after_close(r):
    with r as same:
        assert same is r
    r.close()
    refused(RuntimeError, "render cannot be called after close", r.render)
    refused(RuntimeError, "update_scene cannot be called after close", lambda: r.update_scene("state"))


def no_picture_larger_than_the_framebuffer(_):
    small = SimpleNamespace(vis=SimpleNamespace(global_=SimpleNamespace(offwidth=80, offheight=60)))
    Renderer(small, 60, 80)
    refused(ValueError, "width 81 > framebuffer width 80", lambda: Renderer(small, 60, 81))
    refused(ValueError, "height 61 > framebuffer height 60", lambda: Renderer(small, 61, 80))


BEHAVIOURS = (a_camera_without_a_name, a_camera_below_the_range, a_camera_above_the_range,
              a_picture_that_is_not_black, an_array_for_each_picture, the_array_that_is_handed_in,
              black_before_update_scene, depth_and_segmentation_by_turns, nothing_after_close,
              no_picture_larger_than_the_framebuffer)


@pytest.mark.parametrize("behaviour", BEHAVIOURS, ids=lambda f: f.__name__)
def test_what_mujoco_does(behaviour, renderer):
    behaviour(renderer)


def test_how_many_behaviours():
    assert len(BEHAVIOURS) == 10
