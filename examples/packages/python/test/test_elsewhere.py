"""Looks by the names of other programs, beside arithmetic of their own."""
import math

import numpy as np
import pytest

import shade_h as shade
from shade_h import elsewhere


def test_vtk_is_phong_with_its_numbers():
    look = elsewhere.vtk(color=(1, .5, .2), diffuse=.6, specular=.8, power=30)
    assert look.model == shade.Model.PHONG
    np.testing.assert_allclose(look.material.diffuse, (.6, .3, .12), rtol=1e-6)
    np.testing.assert_allclose(look.material.specular, (.8, .8, .8), rtol=1e-6)
    assert look.material.shininess == 30


def test_numbers_are_the_programs_own():
    povray = elsewhere.povray(color=1, specular=.5, roughness=.01).material
    assert math.isclose(povray.shininess, 100, rel_tol=1e-5)
    assert math.isclose(elsewhere.x_ite(shininess=.25).material.shininess, 32, rel_tol=1e-6)
    three = elsewhere.three_phong(specular=.05, shininess=30)
    assert math.isclose(three.material.specular[0], .05 * 32 / 8, rel_tol=1e-5)
    assert three.flags == shade.Flag.WEIGHTED_SPECULAR
    assert elsewhere.babylon().flags == shade.Flag.UNGATED_SPECULAR
    y = .3 * 1 + .59 * .5 + .11 * .2
    raster = elsewhere.raster3d(color=(1, .5, .2), ambient=.1, specular=.3).material
    assert math.isclose(raster.specular[0], .3 * (.2 + .8 * math.sqrt(y)), rel_tol=1e-5)


def test_text_and_calls_agree():
    assert elsewhere.look("vtk(specular=.5, power=30)") == elsewhere.vtk(specular=.5, power=30)
    assert elsewhere.look("vtk") == elsewhere.vtk()
    assert "vtk" in dir(elsewhere) and "power=1" in elsewhere.PROGRAMS["vtk"]


@pytest.mark.parametrize("text, why", [
    ("nope(x=1)", "no program is named nope"), ("vtk(x=1)", "vtk has no number x"),
    ("vtk(power=1,2)", "power takes 1 number"), ("vtk(power=30) and", "something stands behind"),
    ("povray(phong=.5 specular=.5)", "two highlights"), ("three_toon", "not iteration four")])
def test_refusals(text, why):
    with pytest.raises(shade.Error, match=why):
        elsewhere.look(text)


def test_refusals_of_calls():
    with pytest.raises(AttributeError, match="no program is named 'nope'"):
        elsewhere.nope
    with pytest.raises(shade.Error, match="power"):
        elsewhere.vtk(power="x")
    with pytest.raises(shade.Error, match="exclude"):
        shade.render([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]], look="vtk", material="gold")
    with pytest.raises(shade.Error, match="look must be"):
        shade.render([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]], look=3)


def test_render_takes_a_look():
    vertices, faces = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]
    look = elsewhere.vtk(color=(1, .5, .2), specular=.8, power=30)
    drawn = shade.render(vertices, faces, look=look, size=(40, 40))
    scene = shade.Scene(model=shade.Model.PHONG)
    scene.add((vertices, faces), material=look.material)
    np.testing.assert_array_equal(drawn.rgba, scene.render(size=(40, 40)).rgba)
    same = shade.render(vertices, faces, look="vtk(color=1,.5,.2 specular=.8 power=30)", size=(40, 40))
    np.testing.assert_array_equal(drawn.rgba, same.rgba)
    assert not np.array_equal(drawn.rgba, shade.render(vertices, faces, size=(40, 40)).rgba)


def test_mtl_says_illum_and_roughness(tmp_path):
    def material(text):
        (tmp_path / "a.mtl").write_text("newmtl m\nKd .6 .3 .1\n" + text)
        (tmp_path / "a.obj").write_text("mtllib a.mtl\nusemtl m\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
        return shade.load(str(tmp_path / "a.obj")).pieces[-1].surface.material

    assert material("Ks .8 .8 .8\nNs 30\nillum 2\n").specular[0] > .5
    assert material("illum 1\nKs .8 .8 .8\nNs 30\n").specular == (0, 0, 0)
    assert material("Ks .8 .8 .8\nNs 30\nillum 1\n").specular == (0, 0, 0)
    rough = material("Ks .8 .8 .8\nNs 30\nPr .5\n")
    assert math.isclose(rough.shininess, 2 / .5 ** 4 - 2, rel_tol=1e-5)
    assert math.isclose(rough.specular[0], .04 * .5 * .75, rel_tol=1e-5)
    with pytest.warns(UserWarning, match="illum 0"):
        material("illum 0\n")
    with pytest.warns(UserWarning, match="Ps"):
        material("Ps .5\n")
