"""update() of vertices alone has the bits of a new mesh, and costs less."""
import pickle

import numpy as np
import pytest
import shade_h as shade
from shapes import torus

EYE = shade.Camera.look_at((3, -3, 2), near=0.1)


def bent(vertices, step):
    out = np.array(vertices)
    out[:, 2] += 0.2 * np.sin(3 * out[:, 0] + step)
    return out


@pytest.mark.parametrize("far", [0.0, 1e6])
@pytest.mark.parametrize("kind", [np.float32, np.float64])
@pytest.mark.parametrize("colors", ["no", "by vertex", "by face"])
@pytest.mark.parametrize("normals", ["auto", "flat", "smooth", "given"])
def test_an_update_has_the_bits_of_a_new_mesh(normals, colors, kind, far):
    vertices, faces, _ = torus(24)
    vertices = (np.asarray(vertices) + (far if kind is np.float64 else 0)).astype(kind)
    rng = np.random.default_rng(1)
    tints = {"no": None, "by vertex": rng.random((len(vertices), 3)), "by face": rng.random((len(faces), 3))}[colors]
    own = rng.normal(size=vertices.shape) if normals == "given" else normals
    if normals == "given":
        own[3] = 0    # which is made of its faces
    made, eye = shade.Renderer(60, 80), EYE
    if far and kind is np.float64:
        eye = shade.Camera.look_at(np.array([3, -3, 2.0]) + far, (far,) * 3, near=0.1)
    shape = made.mesh(vertices, faces, normals=own, colors=tints)
    made.add(shape, color="orange", two_sided=True)
    for step in range(4):
        moved = bent(vertices, step)
        if step == 3 and normals == "given":
            own = rng.normal(size=vertices.shape)
            made.update(shape, moved, normals=own)
        else:
            made.update(shape, moved)
        fresh = shade.Renderer(60, 80)
        fresh.add(fresh.mesh(moved, faces, normals=own, colors=tints), color="orange", two_sided=True)
        for renderer in (made, pickle.loads(pickle.dumps(made))):
            got, want = renderer.render(eye, normals=True), fresh.render(eye, normals=True)
            assert (got.ids >= 0).sum() > 1000
            for name in ("color", "depth", "ids", "normals"):
                assert np.array_equal(getattr(got, name), getattr(want, name)), name


def test_what_an_update_cannot_move_is_refused_and_nothing_moves():
    vertices, faces, _ = torus(8)
    made = shade.Renderer(40, 40)
    shape = made.mesh(vertices, faces, normals="flat")
    made.add(shape)
    before = made.render(EYE)
    wrong = np.array(vertices)
    wrong[0, 0] = np.nan
    for value, words in ((wrong, "vertices must hold finite"), (vertices[:-1], "bad indices")):
        with pytest.raises(shade.Error, match=words):
            made.update(shape, value)
        assert np.array_equal(made.render(EYE).ids, before.ids)
