"""Depth and numbers of objects as PNG files of 16 bits, read by Pillow too."""
import io

import numpy as np
import pytest
import shade_h as shade
from PIL import Image

GREY = np.array([[0, 1, 255], [256, 65534, 65535]], np.uint16)


def frame():
    made = shade.Renderer(48, 64)
    made.add("plane", (2, 2))
    made.add("sphere", 0.4, at=(0, 0, 0.4))
    return made.render(shade.Camera.look_at((2, -2, 1.5)))


def test_depth_is_whole_millimetres_and_comes_back(tmp_path):
    depth = frame().depth
    path = tmp_path / "depth.png"
    shade.save_depth(path, depth)
    stored = np.array(Image.open(path))
    there = np.isfinite(depth)
    assert there.any() and not there.all() and stored.max() > 1000
    assert np.array_equal(stored[there], np.floor(depth[there].astype(float) / 0.001 + 0.5)) and (stored[~there] == 0).all()
    again = shade.open_depth(path)
    assert again.dtype == np.float32 and np.array_equal(np.isinf(again), ~there)
    assert np.abs(again[there] - depth[there]).max() <= 0.0005001
    shade.save_depth(path, depth, unit=0.0002)    # as TUM has it
    assert np.abs(shade.open_depth(path, unit=0.0002)[there] - depth[there]).max() <= 0.0001001


def test_what_is_near_stays_and_what_is_too_far_is_refused():
    file = io.BytesIO()
    shade.save_depth(file, [[0.0001, 65.535, 0, -1, np.inf, np.nan]])
    assert np.array(Image.open(file)).tolist() == [[1, 65535, 0, 0, 0, 0]]
    for call, words in ((lambda: shade.save_depth(file, [[1, 65.6]]), "^depth must be at most 65.535"),
                        (lambda: shade.save_depth(file, [[1]], unit=0), "^unit must be"),
                        (lambda: shade.save_depth(file, [1]), "^depth must have the shape"),
                        (lambda: shade.save_depth(file, np.zeros((0, 3))), "^depth and ids must have"),
                        (lambda: shade.save_depth("a.ppm", [[1]]), "^path must end in .png"),
                        (lambda: shade.save_ids(file, [[65535]]), "^ids must be from -1"),
                        (lambda: shade.save_ids(file, [[-2]]), "^ids must be from -1"),
                        (lambda: shade.save_ids(file, [[0.5]]), "^ids must hold whole numbers"),
                        (lambda: shade.open_ids(io.BytesIO(b"x")), "is no PNG file")):
        with pytest.raises(shade.Error, match=words):
            call()


def test_numbers_of_objects_are_one_higher_in_the_file():
    ids, file = frame().ids, io.BytesIO()
    shade.save_ids(file, ids)
    assert np.array_equal(np.array(Image.open(file)).astype(int), ids[..., 0] + 1) and set(np.unique(ids[..., 0])) == {-1, 0, 1}
    file.seek(0)
    assert np.array_equal(shade.open_ids(file), ids[..., 0])


def test_all_numbers_and_kinds_of_grey_are_read(tmp_path):
    path = tmp_path / "a.png"
    shade.save_ids(path, GREY.astype(int) - 1)
    assert np.array_equal(np.array(Image.open(path)), GREY)
    Image.fromarray(GREY).save(path)    # Pillow's own filters
    assert np.array_equal(shade.open_ids(path) + 1, GREY)
    for mode, kind in (("L", np.uint8), ("1", bool)):
        picture = Image.fromarray(np.arange(35, dtype=np.uint8).reshape(5, 7) * 7).convert(mode)
        picture.save(path)
        assert np.array_equal(shade.open_ids(path) + 1, np.array(picture).astype(int)), kind
    Image.fromarray(np.zeros((3, 3, 3), np.uint8)).save(path)
    with pytest.raises(shade.Error, match="is no PNG of one grey number a pixel"):
        shade.open_depth(path)


def test_a_golden_depth_tells_what_differs(tmp_path):
    depth, ids = frame().depth, frame().ids
    golden = tmp_path / "g.png"
    with pytest.raises(AssertionError, match="there is no"):
        shade.assert_same_depth(depth, golden)
    (tmp_path / "g.got.png").rename(golden)
    shade.assert_same_depth(depth, golden)
    shade.assert_same_depth(depth, golden, limit=0)
    far = depth + 0.003
    shade.assert_same_depth(far, golden, limit=0.003)
    with pytest.raises(AssertionError, match=r"depth differs in \d+ pixels, by 0.003 at most"):
        shade.assert_same_depth(far, golden, limit=0.001)
    hole = depth.copy()
    hole[24, 32] = np.inf
    with pytest.raises(AssertionError, match="depth differs in 1 pixels"):
        shade.assert_same_depth(hole, golden, limit=100)
    assert (np.array(Image.open(tmp_path / "g.difference.png"))[..., 0] > 0).sum() == 1
    with pytest.raises(AssertionError, match="rows and columns"):
        shade.assert_same_depth(depth[1:], golden)
    shade.save_ids(golden, ids)
    shade.assert_same_ids(ids, golden)
    ids[3, 4, 0] = 7
    with pytest.raises(AssertionError, match="ids differ in 1 pixels"):
        shade.assert_same_ids(ids, golden)
