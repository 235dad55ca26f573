"""Scalars with their bar, labels and dimensions, looked for in the pixels."""
import warnings

import numpy as np
import pytest
from shapes import box, torus

import shade_h as shade
from shade_h.annotate import MAPS, map_colors, sampled, ticks

FLAT = {"ortho": True, "size": (320, 240), "samples": 1}


def plane(n=2):
    """A square from 0 to 1, seen from the top, of n points a side."""
    y, x = np.mgrid[0:n, 0:n]
    i = (np.arange(n - 1)[:, None] * n + np.arange(n - 1)).reshape(-1)
    return np.stack([x, y, 0 * x], -1).reshape(-1, 3) / (n - 1), \
        np.stack([i, i + 1, i + n + 1, i + n], 1)


def lit_evenly(mesh, **options):
    """A picture in which each pixel has the colour of its surface."""
    scene = shade.Scene([], ambient=(1, 1, 1))
    scene.add(mesh)
    return scene.render("top", **{**FLAT, **options})


def test_viridis_is_that_of_its_polynomial():
    # Matt Zucker's fit of degree six (CC0), which keeps near the table of 256
    c = [(0.2777273272234177, 0.005407344544966578, 0.3340998053353061),
         (0.1050930431085774, 1.404613529898575, 1.384590162594685),
         (-0.3308618287255563, 0.214847559468213, 0.09509516302823659),
         (-4.634230498983486, -5.799100973351585, -19.33244095627987),
         (6.228269936347081, 14.17993336680509, 56.69055260068105),
         (4.776384997670288, -13.74514537774601, -65.35303263337234),
         (-5.435455855934631, 4.645852612178535, 26.3124352495832)]
    t = np.linspace(0, 1, 101)
    wanted = sum(np.array(row) * t[:, None]**k for k, row in enumerate(c))
    assert np.abs(sampled(map_colors("viridis"), t) - wanted).max() < 0.02


def test_cool_to_warm_goes_from_blue_over_grey_to_red():
    got = map_colors("cool-to-warm") * 255
    assert len(got) == 33 and len(MAPS) == 3
    assert np.allclose(got[[0, 16, 32]], [(59, 76, 192), (221, 221, 221), (180, 4, 38)])
    light = got @ [0.2126, 0.7152, 0.0722]
    assert (np.diff(light[:17]) > 0).all() and (np.diff(light[16:]) < 0).all()
    assert np.abs(np.diff(got, 2, axis=0)).max() < 22    # no step of the table is mistyped


@pytest.mark.parametrize("cmap", ["viridis", "cool-to-warm", "grey", [(1.0, 0, 0), (0, 0, 1.0)]])
def test_numbers_by_vertex_are_mixed_before_they_become_colours(cmap):
    vertices, faces = plane()
    mesh = shade.Mesh(vertices, faces, scalars=10 + 4 * vertices[:, 0], cmap=cmap)
    got = lit_evenly(mesh)
    row = np.flatnonzero(got.ids[120] == 0)
    t = (row + 0.5 - row[0]) / len(row)
    wanted = 255 * sampled(map_colors(cmap), t)
    assert np.abs(got.rgba[120, row, :3] - wanted).max() < 5


def test_numbers_by_face_or_polygon_are_the_colours_of_faces():
    vertices, faces = plane(4)
    numbers = np.arange(9.0)
    polygons = lit_evenly(shade.Mesh(vertices, faces, scalars=numbers, cmap="grey"))
    triangles = lit_evenly(shade.Mesh(vertices, faces, scalars=np.repeat(numbers, 2), cmap="grey"))
    assert polygons == triangles
    y, x = np.nonzero(polygons.ids == 0)
    side = (np.ptp(x) + 1) / 3
    for i in range(9):
        column = int(x.min() + side * (i % 3 + 0.5))
        row = int(y.max() - side * (i // 3 + 0.3))
        assert abs(int(polygons.rgba[row, column, 0]) - 255 * i / 8) <= 1
    # as many vertices as faces: a tetrahedron's numbers belong to vertices
    corners = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1.0]])
    assert shade.Mesh(corners, [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]],
                      scalars=[0, 1, 2, 3]).uv is not None


def test_nan_is_grey_and_said():
    vertices, faces = plane(5)
    numbers = vertices[:, 0].copy()
    numbers[12] = np.nan
    with pytest.warns(UserWarning, match="scalars has 1 NaN"):
        mesh = shade.Mesh(vertices, faces, scalars=numbers)
    got = lit_evenly(mesh, size=(400, 300))
    y, x = np.nonzero(got.ids == 0)
    middle = got.rgba[(y.min() + y.max()) // 2, (x.min() + x.max()) // 2, :3]
    assert np.allclose(middle, 140, atol=1) and mesh.bar.gaps
    with pytest.warns(UserWarning, match="scalars has 2 NaN"):
        by_face = shade.Mesh(vertices, faces, scalars=[np.nan, np.nan] + 14 * [1.0])
    assert (lit_evenly(by_face).rgba[..., :3] == 140).all(-1).sum() > 100
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        ends = shade.Mesh(vertices, faces, scalars=np.where(vertices[:, 0] > 0.5, np.inf, 0.0))
    assert not lit_evenly(ends).blank


def test_clim_bounds_the_colours():
    vertices, faces = plane()
    mesh = shade.Mesh(vertices, faces, scalars=vertices[:, 0], clim=(0.5, 0.5), cmap="grey")
    assert (mesh.bar.low, mesh.bar.high) == (0.5, 0.5)
    wide = lit_evenly(shade.Mesh(vertices, faces, scalars=vertices[:, 0], clim=(2, 3), cmap="grey"))
    assert (wide.rgba[wide.ids == 0][:, :3] == 0).all()
    low = lit_evenly(shade.Mesh(vertices, faces, scalars=vertices[:, 0], clim=(-3, -2),
                                cmap="grey"))
    assert (low.rgba[low.ids == 0][:, :3] == 255).all()


def test_ticks_are_round_and_within():
    rng = np.random.default_rng(3)
    for _ in range(2000):
        low = rng.normal() * 10.0 ** rng.integers(-8, 8)
        high = low + abs(rng.normal()) * 10.0 ** rng.integers(-6, 8)
        most = int(rng.integers(2, 12))
        got = ticks(low, high, most)
        slack = 1e-8 * (high - low)
        assert 1 <= len(got) <= most and low - slack <= got[0] <= got[-1] <= high + slack
        if len(got) > 2:
            step = np.diff(got)
            assert np.allclose(step, step[0], rtol=1e-6)
            lead = 10 ** (np.log10(step[0]) % 1)
            assert min(abs(lead - k) for k in (1, 2, 5, 10)) < 1e-2
    assert ticks(0, 1, 6) == [0, 0.2, 0.4, 0.6000000000000001, 0.8, 1] and ticks(5, 5, 4) == [5]


def test_the_bar_stands_beside_the_part_with_its_colours_from_low_to_high():
    vertices, faces, _ = torus(24)
    numbers = vertices[:, 2]
    bare = shade.render(shade.Mesh(vertices, faces), size=(400, 300))
    got = shade.render(shade.Mesh(vertices, faces, scalars=numbers, title="height"),
                       size=(400, 300))
    columns = np.flatnonzero((got.ids >= 0).any(0))
    ink = (got.rgba[..., :3].astype(int) < 250).any(-1) & (got.ids < 0)
    bar = np.flatnonzero(ink[150])
    bar = bar[bar > columns.max() + 2]    # nothing of the bar lies over the part
    assert len(bar) >= 10 and columns.max() < np.flatnonzero((bare.ids >= 0).any(0)).max()
    column = int(np.median(bar[:10]))
    strip = got.rgba[:, column, :3].astype(float)
    inside = slice(round(0.14 * 300) + 1, round(0.84 * 300) - 1)
    t = 1 - (np.arange(300)[inside] + 0.5 - 42) / (252 - 42)
    assert np.abs(strip[inside] - 255 * sampled(map_colors("viridis"), t)).max() < 2
    assert ink[:42, columns.max() + 2:].any()      # the title above
    assert "scalars" not in got.report() and "; height from -0.8 to 0.8" in got.report()
    tiny = shade.render(shade.Mesh(vertices, faces, scalars=numbers), size=(100, 80))
    assert np.array_equal(tiny.ids, shade.render(vertices, faces, size=(100, 80)).ids)


def test_scalars_go_into_sheets_sections_and_clear_pictures():
    vertices, faces, _ = torus(24)
    mesh = shade.Mesh(vertices, faces, scalars=vertices[:, 0], title="x")
    assert shade.sheet([mesh], size=(200, 150)).size == (4 * 202 - 2, 150)
    cut = shade.render(mesh, section="y", size=(200, 150))
    assert np.ptp(cut.rgba[cut.ids == 0][:, 0]) > 100
    clear = shade.render(mesh, size=(200, 150), background=None)
    alpha = clear.rgba[..., 3]
    assert set(np.unique(alpha[:, 150:])) >= {0, 255}
    light = shade.Scene([shade.Light.directional((0, 0, -1))])
    light.add(mesh, name="ring")
    light.add(shade.Mesh(vertices + 9, faces, scalars=vertices[:, 0], title="x"))
    assert len(light._bars()) == 1
    light.add(shade.Mesh(vertices - 9, faces, scalars=vertices[:, 0], title="y"))
    assert len(light._bars()) == 2 and not light.render(size=(300, 200)).blank


@pytest.mark.parametrize("bad,word", [
    ({"scalars": [1, 2]}, "scalars must have a number for each of 8 vertices or 6 faces"),
    ({"scalars": "x"}, "scalars"), ({"scalars": np.zeros((8, 2))}, "scalars"),
    ({"scalars": range(8), "cmap": "jet"}, "cmap must be one of viridis, cool-to-warm, grey"),
    ({"scalars": range(8), "cmap": [(0, 0, 0)]}, "cmap"),
    ({"scalars": range(8), "cmap": [(0, 0, 2.0), (0, 0, 0)]}, "cmap"),
    ({"scalars": range(8), "clim": 3}, "clim"), ({"scalars": range(8), "clim": (2, 1)}, "clim"),
    ({"scalars": range(8), "clim": (0, np.nan)}, r"clim\[1\]"),
    ({"scalars": range(8), "title": 3}, "title"),
    ({"scalars": range(8), "color": "red"}, "scalars take the place of color")])
def test_wrong_scalars_are_refused_by_name(bad, word):
    with pytest.raises(shade.Error, match=word):
        shade.Mesh(*box(), **bad)


# ---- labels and dimensions -----------------------------------------------------------------------

def scene_of_a_box(**options):
    scene = shade.Scene(**options)
    scene.add(box(2, 2, 2), color="white")
    return scene


@pytest.mark.parametrize("background", [0, 90, 128, 200, 255])
@pytest.mark.parametrize("alpha", [0, 100, 255])
@pytest.mark.parametrize("ink", [0, 255])
def test_text_can_be_read_on_any_background(background, alpha, ink):
    rgba = np.full((40, 80, 4), background, np.uint8)
    rgba[..., 3] = alpha
    shade.annotate.write(rgba, "HHH", 10, 20, 24, (ink, ink, ink))
    letters = (np.abs(rgba[..., 0].astype(int) - ink) < 20) & (rgba[..., 3] == 255)
    rim = (np.abs(rgba[..., 0].astype(int) - (255 - ink)) < 20) & (rgba[..., 3] == 255)
    inside = np.zeros_like(letters)
    inside[12:28, 14:50] = True
    # 3 letters with 2 stems of 17 pixels each, which are at least 1 wide; beside them is a rim
    assert (letters & inside).sum() > 6 * 14
    left = np.flatnonzero((letters & inside)[16])[0]
    assert rim[12:26, left - 2].all() and letters[12:26, left].all()
    corner = rgba[0, 79]
    assert corner[3] == alpha and corner[0] == background


def test_labels_stand_beside_their_points_and_within_the_picture():
    scene = scene_of_a_box()
    plain = scene.render("top", **FLAT)
    for point in ((0, 0, 2), (2, 2, 2), (2, 0, 2)):
        marked = shade.Scene()
        marked.parts += scene.parts
        marked.add_label(point, "a long name of a corner")
        got = marked.render("top", **FLAT)
        changed = got.difference(plain) > 40
        columns = np.flatnonzero(changed.any(0))
        assert np.ptp(columns) > 120 and np.array_equal(got.ids, plain.ids)
        rows = np.flatnonzero(changed[:, columns.max() - 20:].any(1))
        y, x = np.nonzero(plain.ids == 0)
        at = y.max() if point[1] == 0 else y.min()
        assert abs(rows.mean() - at) < 8 or rows.min() < 3 or rows.max() > 236


def test_a_label_is_hidden_by_the_part_as_said():
    for far in (0.0, 1e8):
        scene = shade.Scene()
        scene.add((np.asarray(box(2, 2, 2)[0]) + far, box()[1]))
        behind, front = np.array([1.0, 1, 0]) + far, np.array([1.0, 1, 2]) + far
        hidden = scene.add_label(behind, "bottom", over=False)
        assert hidden not in scene.render("top", **FLAT).written
        assert "the text 'bottom', not in view." in scene.render("top", **FLAT).report()
        shown = scene.add_label(behind, "bottom")
        near = scene.add_label(front, "top", over=False)
        assert scene.render("top", **FLAT).written == {shown, near}
        assert scene.render("bottom", **FLAT).written == {hidden, shown}
        assert scene.render("iso", (320, 240)).written == {shown, near}
    away = shade.Camera.look_at((0, 0, 50), (0, 0, 90), (0, 1, 0))
    assert scene.render(away, (40, 30)).written == frozenset()


def test_a_dimension_says_its_length_where_it_lies():
    scene = scene_of_a_box()
    plain = scene.render("top", **FLAT)
    number = scene.add_dimension((0, -0.2, 2), (2, -0.2, 2))
    got = scene.render("top", **FLAT)
    assert scene.parts[number].text.words == "2" and "the text '2'." in got.report()
    y, x = np.nonzero(got.ids == 0)
    ink = (got.rgba[..., :3] < 60).all(-1)
    below = np.nonzero(ink[y.max() + 2:].any(0))[0]
    assert abs(np.ptp(below) - np.ptp(x)) < 8 and abs(below.mean() - x.mean()) < 3
    assert scene.parts[scene.add_dimension((0, 0, 0), (3, 4, 12), "wide")].text.words == "wide"
    assert scene.parts[scene.add_dimension((0, 0, 0), (3, 4, 12))].text.words == "13"
    assert plain.written == frozenset() and got.written == {number}


def test_text_of_any_kind_is_drawn_or_refused():
    scene = scene_of_a_box()
    for text in ("", "Ø 3 ± 0.1 µm", "日本", "a_b^c {x}", "\0\n\t", "\ud800", "x" * 200):
        scene.add_label((1, 1, 2), text)
    assert not scene.render(size=(64, 48)).blank
    for bad in (3, None, "x" * 201, b"x"):
        with pytest.raises(shade.Error, match="text"):
            scene.add_label((0, 0, 0), bad)
    with pytest.raises(shade.Error, match="point"):
        scene.add_label((0, 0), "x")
    with pytest.raises(shade.Error, match="b must"):
        scene.add_dimension((0, 0, 0), (0, 0, np.nan))
    with pytest.raises(shade.Error, match="size"):
        scene.add_label((0, 0, 0), "x", size=0)


def test_signs_that_mean_raised_letters_elsewhere_are_plain_text():
    masks = [shade.annotate.text_mask(words, 20) for words in ("a_b", "a^b", "ab", "a?b", "a日b")]
    assert masks[0].shape != masks[2].shape != masks[1].shape
    assert np.array_equal(masks[3], masks[4])
