"""Depth and numbers of objects as PNG files of 16 bits, and tests against golden ones."""
from __future__ import annotations

import os
from typing import Any

import numpy as np

from . import _arguments as arguments
from ._native import Array, Error, Floats, Integers, asked, library
from .picture import PICTURE_BYTES, File, Picture, decode, encode, png_path, put_file, read_file


def save_depth(path: Any, depth: object, unit: float = 0.001) -> None:
    """Writes depth, (H, W) as Frame and Picture have it, into a PNG file of 16-bit grey: the nearest
    whole unit, of a millimetre where the scene's is a metre, as data sets of depth cameras have it.
    0 is where there is nothing; what lies nearer than half a unit is 1.  What lies beyond 65,535
    units is refused.  path is one, or a file that is open for bytes."""
    _save(path, _depth_numbers(depth, unit))


def open_depth(path: Any, unit: float = 0.001) -> Floats:
    """The depth of a PNG file, (H, W) float32, infinity where it has 0.  Files of one grey number a pixel
    are read, of 1 to 16 bits."""
    grey = _open(path)
    depth: Floats = np.empty(grey.shape, np.float32)
    asked(library.python_depth_numbers, b"depth", depth, grey.size, _unit(unit), grey, 1)
    return depth


def save_ids(path: Any, ids: object) -> None:
    """Writes numbers of objects, (H, W) or (H, W, 2) as Picture and Frame have them, into a PNG file of
    16-bit grey, each one higher: 0 belongs to none.  Numbers above 65,534 are refused."""
    _save(path, _id_numbers(ids))


def open_ids(path: Any) -> Integers:
    """The numbers of objects of a PNG file, (H, W) int32, -1 where it has 0."""
    grey = _open(path)
    ids: Integers = np.empty(grey.shape, np.int32)
    asked(library.python_id_numbers, b"ids", ids, grey.size, 0, grey)
    return ids


def assert_same_depth(depth: object, golden: File, limit: float = 0.001, unit: float = 0.001) -> None:
    """Raises AssertionError where depth differs from a golden file of save_depth by more than limit, in the
    unit of the scene, or is where the file has nothing, or is not where it has something.  Files appear
    beside it as for assert_same()."""
    limit, got = arguments.number("limit", limit, 0, 1e9), _depth_numbers(depth, unit)
    wanted = _golden(golden, got)
    apart = np.abs(got.astype(np.int64) - wanted)
    wrong = (apart > limit / unit + 0.5) | ((got == 0) != (wanted == 0))    # of each file half a unit is rounded
    both = (got > 0) & (wanted > 0)
    most = apart[both].max(initial=0) * unit
    _compared(golden, got, wrong, f"depth differs in {int(wrong.sum())} pixels, by {most:g} at most where both have it")


def assert_same_ids(ids: object, golden: File) -> None:
    """Raises AssertionError where numbers of objects differ from a golden file of save_ids."""
    got = _id_numbers(ids)
    wrong = got != _golden(golden, got)
    _compared(golden, got, wrong, f"ids differ in {int(wrong.sum())} pixels")


def _unit(unit: object) -> float:
    return arguments.number("unit", unit)


def _depth_numbers(depth: object, unit: object) -> Array:
    rows = np.ascontiguousarray(arguments.array("depth", depth, (None, None)), np.float32)
    grey = np.empty(rows.shape, np.uint16)
    asked(library.python_depth_numbers, b"depth", rows, rows.size, _unit(unit), grey, 0)
    return grey


def _id_numbers(ids: object) -> Array:
    given = arguments.array("ids", ids, (None, None, 2) if arguments.dimensions("ids", ids) == 3 else (None, None))
    if given.dtype.kind not in "iu" or (given.size and not -2**31 <= int(given.min()) <= int(given.max()) < 2**31):
        raise Error(f"ids must hold whole numbers that fit int32, not {arguments.shown(ids)}")
    rows = np.ascontiguousarray(given, np.int32)
    grey = np.empty(rows.shape[:2], np.uint16)
    asked(library.python_id_numbers, b"ids", rows, grey.size, rows.ndim - 1, grey)
    return grey


def _save(path: Any, grey: Array) -> None:
    if not grey.size or max(grey.shape) > 16384:
        raise Error(f"depth and ids must have 1 to 16384 rows and columns, not {grey.shape}")
    if callable(getattr(path, "write", None)):
        path.write(encode(grey))
    else:
        put_file(png_path("path", path), encode(grey))


def _open(path: Any) -> Array:
    if callable(getattr(path, "read", None)):
        return decode(path.read(), "the file", True)
    return decode(read_file(path, PICTURE_BYTES), os.fsdecode(path), True)


def _golden(golden: File, got: Array) -> Array:
    """The numbers of a golden file that there is, of the size of what was drawn"""
    path = png_path("golden", golden)
    beside = path.with_suffix(".got.png")
    if not path.exists():
        _save(beside, got)
        raise AssertionError(f"there is no {path}; what was drawn is in {beside}")
    wanted = _open(path)
    if wanted.shape != got.shape:
        _save(beside, got)
        raise AssertionError(f"{path} has {wanted.shape} rows and columns, what was drawn {got.shape}; see {beside}")
    return wanted


def _compared(golden: File, got: Array, wrong: Array, words: str) -> None:
    if not wrong.any():
        return
    path = png_path("golden", golden)
    beside, shows = path.with_suffix(".got.png"), path.with_suffix(".difference.png")
    _save(beside, got)
    rgba = np.full((*wrong.shape, 4), 255, np.uint8)
    rgba[:, :, :3] = np.where(wrong, 255, 0)[:, :, None]
    Picture(rgba).save(shows)
    raise AssertionError(f"{words}, from {path}; see {beside} and {shows}")
