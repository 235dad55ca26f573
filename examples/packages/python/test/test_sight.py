"""Sections, reports and export_png: what programs that make parts see of them."""
import io
import subprocess
import sys

import numpy as np
import pytest
from shapes import box, torus

import shade_h as shade
from shade_h.section import cut

FLAT = {"ortho": True, "size": (120, 120), "samples": 1}


def tube(inner=0.5, outer=1.0, height=2.0, n=60):
    """A closed tube along z, about the origin."""
    t = np.arange(n) * 2 * np.pi / n
    ring = np.stack([np.cos(t), np.sin(t), 0 * t], 1)
    up = [0, 0, height]
    vertices = np.concatenate([outer * ring, inner * ring, inner * ring + up, outer * ring + up])
    i, j = np.meshgrid(np.arange(4), np.arange(n), indexing="ij")
    k, m = n * ((i + 1) % 4), (j + 1) % n
    # seen from outside the corners of each face go around counter-clockwise
    return vertices, np.stack([n * i + j, k + j, k + m, n * i + m], -1).reshape(-1, 4)


def cap_area(mesh):
    piece = mesh.pieces[-1]
    p = mesh.vertices[mesh.faces[piece.first:piece.first + piece.count]].astype(float)
    return np.linalg.norm(np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0]), axis=1).sum() / 2


@pytest.mark.parametrize("shape,point,normal,area", [
    (box(3, 2, 1), (1.5, 0, 0), (1, 0, 0), 2.0), (box(3, 2, 1), (0, 0, 0.25), (0, 0, -1), 6.0),
    (box(1, 1, 1), (0.5, 0.5, 0.5), (1, 1, 0), 2**0.5),
    (box(1, 1, 1), (0.5, 0.5, 0.5), (1, 1, 1), 27**0.5 / 4),
    (tube(), (0, 0, 1), (0, 0, 1), 30 * np.sin(np.pi / 30) * 0.75),
    (tube(), (0, 0, 1), (0, 1, 0), 2.0), (box(3, 2, 1), (9, 0, 0), (1, 0, 0), 0.0)])
@pytest.mark.parametrize("far", [0.0, 1e7])
def test_the_area_of_a_cut_is_that_of_the_section(shape, point, normal, area, far):
    mesh = shade.Mesh(np.asarray(shape[0]) + far, shape[1])
    unit = np.array(normal, float) / np.linalg.norm(normal)
    made = cut(mesh, np.array(point, float) + far, unit)
    # rows of the cap reach a little over each other
    assert cap_area(made) == pytest.approx(area, rel=4e-3, abs=1e-9)
    side = (made.vertices - (np.array(point, float) + far)) @ unit
    assert side.max() <= 2e-4


def test_a_section_shows_the_hatched_cut_in_front_of_what_is_left():
    got = shade.render(*tube(), section="y", view="back", color="red", **FLAT)
    # seen along the normal the cut lies nearest, at one distance, its walls left and right
    row = got.ids[60] == 0
    depth = got.depth[60][row]
    near = np.isclose(depth, depth.min(), atol=1e-4)
    assert near[:3].all() and near[-3:].all() and not near[len(near) // 2]
    assert near.mean() == pytest.approx(0.5, abs=0.05)
    cut_pixels = np.isclose(got.depth, depth.min(), atol=1e-4)
    assert np.allclose(got.normals[cut_pixels], [0, 1, 0], atol=1e-3)
    shades = got.rgba[cut_pixels][:, 0].astype(int)
    assert shades.max() - shades.min() > 40 and (got.rgba[cut_pixels][:, 2] < 110).all()


@pytest.mark.parametrize("axis,view,up,normal", [
    ("x", "right", "z", (1, 0, 0)), ("x", "left", "z", (-1, 0, 0)), ("y", "front", "z", (0, -1, 0)),
    ("y", "iso", "z", (0, -1, 0)), ("y", "iso", "y", (0, 1, 0)), ("z", "iso", "y", (0, 0, 1)),
    (("z", 0.5), "bottom", "z", (0, 0, -1)), ("z", "front", "z", (0, 0, 1))])
def test_a_section_is_cut_open_on_the_side_of_the_eye(axis, view, up, normal):
    from shade_h.camera import direction
    from shade_h.section import plane_of
    ways = direction(view, up)[0], direction("iso", up)[0]
    assert plane_of(axis, np.zeros(3), np.ones(3), ways)[1].tolist() == list(normal)
    got = shade.render(*box(1, 1, 1), section=axis, view=view, up=up,
                       **{**FLAT, "size": (480, 360)})
    facing = np.isclose(got.normals, np.array(normal, np.float32), atol=1e-3).all(2)
    assert facing.sum() > 100 or (axis, view) == ("z", "front")
    shades = got.rgba[facing][:, :3].astype(int).max(1)
    assert not facing.any() or shades.max() - shades.min() > 40


def test_the_outline_of_a_cut_is_drawn_but_no_line_within_it():
    mesh = shade.Mesh(*tube())
    made = cut(mesh, np.zeros(3), np.array([0.0, 1, 0]))
    lines = made.drawn_edges(np.zeros(3), np.array([0.0, 1, 0])).reshape(-1, 2, 3)
    inside = lines[np.abs(lines[:, :, 1]).max(1) < 1e-6]
    x, z = np.abs(inside[:, :, 0]), inside[:, :, 2]
    on_outline = np.isclose(x, 0.5).all(1) | np.isclose(x, 1).all(1) | \
        np.isclose(z, 0).all(1) | np.isclose(z, 2).all(1)
    assert len(inside) >= 8 and on_outline.all()


def test_no_pixel_of_a_cap_is_left_out():
    vertices, faces, _ = torus(60)
    got = shade.render(vertices, faces, section="z", view="top", **{**FLAT, "size": (400, 400)})
    y, x = np.mgrid[0:400, 0:400]
    middle = got.depth[got.ids == 0].min()
    ring = np.isclose(got.depth, middle, atol=1e-3)
    scale = np.ptp(np.flatnonzero((got.ids == 0).any(0))) / (2 * 2.8)
    radius = np.hypot(x - 199.5, y - 199.5) / scale
    assert ring[(radius > 1.25) & (radius < 2.75)].all()
    assert not ring[(radius < 1.15) | (radius > 2.85)].any()


@pytest.mark.parametrize("bad", ["w", ("x",), ("x", "y"), ((0, 0, 0), (0, 0, 0)), 7,
                                 ((0, 0), (1, 0, 0)), ((0, 0, float("nan")), (1, 0, 0))])
def test_a_section_that_is_none_is_refused(bad):
    with pytest.raises(shade.Error, match="section"):
        shade.render(*box(), section=bad, **FLAT)


def test_open_meshes_and_several_parts_can_be_cut():
    vertices, faces = box()
    got = shade.render([(vertices, faces[:4]), (np.asarray(vertices) + [4, 0, 0], faces)],
                       section=("z", 0.5), **FLAT)
    assert set(np.unique(got.ids)) == {-1, 0, 1}
    textured = shade.Mesh(vertices, faces, uv=np.asarray(vertices)[:, :2],
                          texture=np.full((4, 4, 3), 200, np.uint8))
    assert not shade.render(textured, section="x", **FLAT).blank
    tinted = shade.Mesh(vertices, faces, color=np.random.default_rng(1).random((8, 3)))
    assert not shade.render(tinted, section="y", **FLAT).blank


def test_export_png_gives_and_writes_the_views(tmp_path):
    data = shade.export_png(box(), tmp_path / "a.png", size=(90, 70), color="blue")
    assert (tmp_path / "a.png").read_bytes() == data
    got = shade.Picture.open(io.BytesIO(data))
    assert got.size == (4 * 92 - 2, 70)
    mesh = shade.Mesh(*box(), color="blue")
    assert got == shade.sheet([mesh], size=(90, 70))
    both = shade.export_png([mesh, shade.Mesh(np.asarray(box()[0]) + [4, 0, 0], box()[1])],
                            views=["front"], size=(90, 70), section="z")
    assert shade.Picture.open(io.BytesIO(both)).size == (90, 70)
    with pytest.raises(shade.Error, match="must end in .png"):
        shade.export_png(box(), tmp_path / "a.stl")


def test_a_report_says_what_the_arrays_say():
    scene = shade.Scene()
    scene.add(box(3, 2, 1), name="lid")
    pose = np.eye(4)
    pose[:3, 3] = 0.5, 0.5, -1
    scene.add(box(1, 1, 0.005), pose, name="shim")
    got = scene.render("top", (100, 80), ortho=True)
    words = got.report().split("\n")
    y, x = np.nonzero(got.ids >= 0)
    assert words[0] == f"100 x 80 pixels, {100 * (got.ids >= 0).mean():.0f} % covered, from " \
        f"column {x.min()} to {x.max()} and row {y.min()} to {y.max()}."
    assert words[1] == "The scene is 3 x 2 x 2, from (0, 0, -1) to (3, 2, 1)."
    assert words[2].startswith("Part 0 lid: 12 triangles, 3 x 2 x 1, ") and "thin" not in words[2]
    assert words[3] == "Part 1 shim: 12 triangles, 1 x 1 x 0.005, not in view; thin."
    away = shade.Camera.look_at((0, 0, 50), (0, 0, 90), (0, 1, 0))
    nothing = scene.render(away, (40, 30))
    assert nothing.blank and nothing.report().startswith("40 x 30 pixels, blank")
    close = scene.render(shade.Camera.look_at((1, 1, 1.5), (1, 1, 0), (0, 1, 0)), (40, 30))
    assert "over the border: left, top, right, bottom" in close.report()
    assert not close.blank


def test_the_command_cuts(tmp_path):
    vertices, faces = box()
    (tmp_path / "a.obj").write_text(
        "".join("v {} {} {}\n".format(*p) for p in vertices.tolist()) +
        "".join("f {} {} {} {}\n".format(*f) for f in (faces + 1).tolist()), "utf-8")
    for words in (["--section", "x"], ["--section", "x=2"], []):
        name = f"{len(words)}{''.join(words[1:]).replace('=', '')}.png"
        subprocess.run([sys.executable, "-m", "shade_h", "a.obj", name, "--size", "60x40", *words],
                       cwd=tmp_path, check=True)
    pictures = [shade.Picture.open(path) for path in sorted(tmp_path.glob("*.png"))]
    assert len(pictures) == 3 and pictures[0] != pictures[1] != pictures[2]
    done = subprocess.run([sys.executable, "-m", "shade_h", "a.obj", "b.png", "--section", "q"],
                          cwd=tmp_path, stderr=subprocess.PIPE, text=True, check=False)
    assert done.returncode == 1 and "section" in done.stderr and "Traceback" not in done.stderr


def test_lines_and_points_lie_where_they_say_over_parts_or_behind():
    for far in (0.0, 1e8):
        scene = shade.Scene()
        scene.add((np.asarray(box(2, 2, 2)[0]) + far, box()[1]), color="white")
        line = np.array([[1.0, 0.5, 1], [1, 1.5, 1]]) + far
        dots = np.array([[0.5, 1, 1], [1.5, 1, 1.0]]) + far
        plain = scene.render("top", (100, 100), ortho=True, samples=1)
        for over in (True, False):
            marked = shade.Scene()
            marked.parts += scene.parts
            marked.add_lines(line, "blue", over=over)
            marked.add_points(dots, "red", 8, over=over, name="dots")
            got = marked.render("top", (100, 100), ortho=True, samples=1)
            changed = got.difference(plain) > 40
            assert changed.any() == over and np.array_equal(got.ids, plain.ids)
            assert "Part 2 dots: 2 lines or points" in got.report()
        y, x = np.nonzero((got.ids >= 0))
        middle, scale = (x.min() + x.max() + 1) / 2, np.ptp(x) + 1
        marked.parts[1:] = []
        marked.add_lines([line], "blue", 3)
        marked.add_points(dots, "red", 8)
        rgba = marked.render("top", (100, 100), ortho=True, samples=1).rgba.astype(int)
        blue = np.argwhere((rgba[..., 2] > 120) & (rgba[..., 0] < 100))
        red = np.argwhere((rgba[..., 0] > 150) & (rgba[..., 1] < 100))
        assert abs(blue[:, 1].mean() + 0.5 - middle) < 1
        assert np.ptp(blue[:, 0]) == pytest.approx(scale / 2, abs=4)
        assert len(red) == pytest.approx(2 * 64, abs=40)
        assert np.ptp(red[:, 1]) == pytest.approx(scale / 2 + 8, abs=3)
    for bad in ("x", [[1, 2]], [[[0, 0, np.nan]]], 7):
        with pytest.raises(shade.Error, match="points"):
            shade.Scene().add_lines(bad)
    alone = shade.Scene()
    alone.add_lines([[0, 0, 0], [1, 1, 1]])
    assert (alone.render("front", (40, 40)).rgba[..., 1] < 100).any()
