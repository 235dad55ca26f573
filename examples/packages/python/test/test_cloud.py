"""Point clouds, OFF files, PPM pictures and the angles of the command."""
import subprocess
import sys
import warnings

import numpy as np
import pytest
from shapes import box, ply

import shade_h as shade

FLAT = {"ortho": True, "size": (200, 150), "samples": 1}
RNG = np.random.default_rng(5)
GRID = np.stack(np.meshgrid(np.arange(4.0), np.arange(3.0), [0.0]), -1).reshape(-1, 3)


@pytest.mark.parametrize("far", [0.0, 1e8])
def test_each_point_is_a_ball_where_it_lies_and_a_warning_says_so(far):
    with pytest.warns(UserWarning, match="12 points have no faces: they are drawn as small balls"):
        got = shade.render(GRID + far, view="top", color="red", **FLAT)
    y, x = np.nonzero(got.ids == 0)
    low, high = (x.min(), y.min()), (x.max(), y.max())
    radius = (high[0] - low[0] + 1) / (3 + 2 * 0.072) * 0.072
    for point in GRID:
        column = low[0] + radius + (high[0] - low[0] + 1 - 2 * radius) * point[0] / 3
        row = high[1] - radius - (high[1] - low[1] + 1 - 2 * radius) * point[1] / 2
        assert got.ids[int(row), int(column)] == 0
    between = got.ids[(low[1] + high[1]) // 2, :]
    assert (np.diff(between) > 0).sum() == 4    # four balls apart in the middle row
    assert (got.rgba[got.ids == 0][:, 0] > 60).all()


@pytest.mark.parametrize("form", ["ascii", "binary_little_endian", "binary_big_endian"])
@pytest.mark.parametrize("kind", ["float", "double"])
def test_ply_files_without_faces_are_clouds_with_their_colours(tmp_path, form, kind):
    colors = RNG.integers(0, 256, (12, 3))
    (tmp_path / "a.ply").write_bytes(ply(GRID, form, colors, kind))
    with pytest.warns(UserWarning, match="12 points"):
        got = shade.render(tmp_path / "a.ply", view="top", up="z", **FLAT)
    with pytest.warns(UserWarning):
        wanted = shade.render(GRID, color=colors / 255, view="top", **FLAT)
    assert got == wanted and not got.blank
    (tmp_path / "b.ply").write_bytes(ply(GRID, form, colors, kind)[:-6])
    with pytest.raises(shade.Error, match="ends too early|expected a number"):
        shade.load(tmp_path / "b.ply")


def test_clouds_of_any_size_are_drawn_or_refused():
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        assert not shade.render(np.zeros((1, 3)), **FLAT).blank
        assert not shade.render(RNG.random((20_000, 3)), **FLAT).blank
        assert shade.render(np.full((3, 3), np.nan), **FLAT).blank
        assert shade.render(np.zeros((0, 3)), **FLAT).blank
        field = shade.mesh.mesh(GRID, scalars=GRID[:, 0], cmap="grey")
        tinted = shade.render(field, view="top", **FLAT)
        assert np.ptp(tinted.rgba[tinted.ids == 0][:, 0].astype(int)) > 150
    with pytest.warns(UserWarning, match="600000 points .* one of 2"):
        made = shade.mesh.mesh(RNG.random((600_000, 3)))
    assert len(made.faces) == 8 * 300_000
    with pytest.raises(shade.Error, match="points must have the shape"):
        shade.render(np.zeros((5, 2)), **FLAT)


def off(vertices, faces, word="OFF", tail=None):
    return f"# a comment\n{word}\n{len(vertices)} {len(faces)} 0\n" + "".join(
        " ".join(map(repr, map(float, p))) + "\n" for p in np.asarray(vertices)) + "".join(
        f"{len(f)} " + " ".join(map(str, f)) + (tail or "") + "  # face\n" for f in faces)


def test_off_files_are_what_they_say(tmp_path):
    vertices, faces = box()
    faces = np.asarray(faces).tolist()
    for far in (0.0, 1e8):
        (tmp_path / "a.off").write_text(off(vertices + far, faces), "utf-8")
        assert shade.render(tmp_path / "a.off", **FLAT) == \
            shade.render(vertices, faces, up="y", **FLAT)
    (tmp_path / "b.off").write_text(off(vertices, faces, tail=" 214 39 40"), "utf-8")
    red = shade.Mesh(vertices, faces, color=np.tile([[214, 39, 40]], (12, 1)), up="y")
    assert shade.render(tmp_path / "b.off", **FLAT) == shade.render(red, **FLAT)
    colors = RNG.integers(0, 256, (8, 3))
    rows = np.concatenate([vertices, colors], 1)
    faces = np.asarray(faces)[:, [0, 1, 2, 0, 2, 3]].reshape(-1, 3).tolist()
    (tmp_path / "c").write_text(off(rows, faces, "COFF").replace(".0", ""), "utf-8")
    tinted = shade.Mesh(vertices, faces, color=colors / 255, up="y")
    assert shade.render(tmp_path / "c", **FLAT) == shade.render(tinted, **FLAT)
    corners = [[0, 0, 0], [8, 0, 0], [8, 8, 0], [7, 8, 0], [7, 1, 0], [0, 1, 0]]
    (tmp_path / "d.off").write_text(off(corners, [range(6)]), "utf-8")
    mesh = shade.load(tmp_path / "d.off")    # concave: an L, cut inside of it
    sides = [mesh.vertices[mesh.faces[:, k]] - mesh.vertices[mesh.faces[:, 0]] for k in (1, 2)]
    assert np.allclose(np.cross(*sides)[:, 2].sum() / 2, 15) and (np.cross(*sides)[:, 2] >= 0).all()


@pytest.mark.parametrize("text,why", [
    ("OFF\n", "ends before the counts"), ("OFF\n9 1 0\n0 0 0\n", "after 1 of 9 vertices and 1 faces"),
    ("OFF\n1 1 0\n0 0 x\n3 0 0 0\n", ":3: expected a number"), ("OFF BINARY\n", "binary OFF"),
    ("OFF\n1 1 0\n0 0 0\n3 0 0 7\n", ":4: a corner"), ("OFF\n1 1 0\n0 0 0\n-1 0\n", ":4: "),
    ("OFF\n1 1 0\n0 0 0\n3 0 0 nan\n", ":4: "), ("OFF\n1 1 0\n0 0 0\n99999 0\n", ":4: "),
    ("OFF\n1.5 1 0\n0 0 0\n3 0 0 0\n", ":2: "), ("OFF\n1 1 0\n0 0 0\n1e99 0\n", ":4: ")])
def test_damaged_off_files_are_refused_with_the_line(tmp_path, text, why):
    (tmp_path / "a.off").write_text(text, "utf-8")
    with pytest.raises(shade.Error, match=why):
        shade.load(tmp_path / "a.off")


def test_pictures_are_saved_as_ppm(tmp_path):
    got = shade.render(*box(), size=(30, 20))
    got.save(tmp_path / "a.PPM")
    assert (tmp_path / "a.PPM").read_bytes() == b"P6\n30 20\n255\n" + got.rgba[..., :3].tobytes()
    with pytest.raises(shade.Error, match="PPM has no alpha"):
        shade.render(*box(), size=(30, 20), background=None).save(tmp_path / "b.ppm")
    with pytest.raises(shade.Error, match="must end in .png or .ppm"):
        got.save(tmp_path / "b.pgm")
    assert [p.name for p in tmp_path.iterdir()] == ["a.PPM"]


def test_the_command_takes_angles_and_writes_ppm(tmp_path):
    vertices, faces = box()
    (tmp_path / "a.off").write_text(off(vertices, np.asarray(faces).tolist()), "utf-8")
    for view, wanted in (("30,20", (30, 20)), ("-30,-20", (-30, -20)), ("front", "front")):
        subprocess.run([sys.executable, "-m", "shade_h", "a.off", "a.ppm", f"--view={view}",
                        "--size", "60x40"], cwd=tmp_path, check=True)
        got = shade.render((vertices, faces), up="y", view=wanted, size=(60, 40), edges=True)
        assert (tmp_path / "a.ppm").read_bytes() == got.ppm()
    for view in ("30,x", "north", "1,2,3", ""):
        done = subprocess.run([sys.executable, "-m", "shade_h", "a.off", "b.png", f"--view={view}"],
                              cwd=tmp_path, stderr=subprocess.PIPE, text=True, check=False)
        assert done.returncode == 1 and "view must be one of" in done.stderr
