"""Point clouds as small balls, and OFF files."""
from __future__ import annotations

import re
import warnings
from typing import Any

import numpy as np

from . import _arguments as arguments
from ._native import Array, Doubles, Error

MOST = 500_000    # points; of more, every second, third, ... is drawn
_CORNERS = np.array([[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1.0]])
_FACES = np.array([[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4], [2, 0, 5], [1, 2, 5], [3, 1, 5],
                   [0, 3, 5]])


def balls(points: object, options: dict[str, Any]) -> tuple[Doubles, Array, dict[str, Any]]:
    """Vertices, faces and options of Mesh that show points as octahedra, shaded as balls, of a
    radius that follows from their number: 0.4 of the distance between as many on a square as large
    as the box around them.  A warning says so."""
    given = arguments.array("points", points, (None, 3)).astype(np.float64)
    step = max(1, -(-len(given) // MOST))
    with np.errstate(invalid="ignore"):
        good = np.flatnonzero((np.abs(given) <= 1e30).all(1))[::step]
    kept = given[good]
    extent = float(np.linalg.norm(np.ptp(kept, 0))) if len(kept) else 0.0
    radius = extent * min(0.02, max(0.001, 0.3 / max(len(kept), 1) ** 0.5)) or 1.0
    every = "" if step == 1 else f", one of {step}"
    warnings.warn(f"{len(given)} points have no faces: they are drawn as small balls of radius "
                  f"{radius:.3g}{every}", stacklevel=4)
    vertices = (kept[:, None] + radius * _CORNERS).reshape(-1, 3)
    faces = (np.arange(len(kept))[:, None, None] * 6 + _FACES).reshape(-1, 3)
    out = {"normals": np.tile(_CORNERS, (len(kept), 1)), **options}
    for name in ("color", "scalars"):
        value = options.get(name)
        if value is not None and not isinstance(value, str) and len(np.shape(value)) and \
                len(np.asarray(value)) == len(given):
            out[name] = np.repeat(np.asarray(value)[good], 6, 0)
    return vertices, faces, out


# ---- OFF -----------------------------------------------------------------------------------------

def is_off(data: bytes) -> bool:
    """Does a file begin as OFF, COFF, NOFF, STOFF or CNOFF do?"""
    return re.match(rb"\s*(#[^\n]*\n\s*)*(ST)?C?N?OFF\b", data[:4096]) is not None


def read_off(data: bytes) -> tuple[tuple[Doubles, Array], dict[str, Any]]:
    """Vertices, triangles and colours of an OFF file of text.  Its polygons are cut in fans."""
    rows = [(number, words) for number, line in enumerate(data.split(b"\n"), 1)
            if (words := line.split(b"#", 1)[0].split())]
    if not rows or b"BINARY" in rows[0][1]:
        raise Error("binary OFF is not read" if rows else "is empty")
    kind, rows[0] = rows[0][1][0], (rows[0][0], rows[0][1][1:])
    rows = rows if rows[0][1] else rows[1:]
    count, many = (int(v) for v in _numbers(rows, 0, 2, "the counts"))
    if not 0 <= count < len(rows) or not 0 <= many < len(rows):
        raise Error(f"line {rows[0][0]}: {count} vertices and {many} faces are said, but "
                    f"{len(rows) - 1} lines follow")
    vertices = np.array([_numbers(rows, i, 3, "a vertex") for i in range(1, count + 1)])
    faces, tints = [], []
    for i in range(count + 1, count + many + 1):
        size = int(_numbers(rows, i, 1, "a face")[0])
        if not 0 <= size <= len(rows[min(i, len(rows) - 1)][1]):
            raise Error(f"line {rows[i][0]}: a face of {size} corners")
        corners = [int(v) for v in _numbers(rows, i, size + 1, "a face")[1:]]
        if any(not 0 <= v < count for v in corners):
            raise Error(f"line {rows[i][0]}: a corner that is none of {count} vertices")
        tint = _tint(rows[i][1][size + 1:])
        for k in range(1, size - 1):
            faces.append((corners[0], corners[k], corners[k + 1]))
            tints.append(tint)
    out: dict[str, Any] = {"up": None}
    shift = 3 + 3 * (b"N" in kind)
    own = [_tint(words[shift:]) for _, words in rows[1:count + 1]] if b"C" in kind else []
    if own and all(tint is not None for tint in own):
        out["color"] = np.array(own)
    elif any(tint is not None for tint in tints) and len(faces) != count:
        out["color"] = np.array([tint or (0.75, 0.75, 0.75) for tint in tints])
    return (vertices.reshape(-1, 3), np.array(faces, np.int64).reshape(-1, 3)), out


def _numbers(rows: list[tuple[int, list[bytes]]], i: int, many: int, what: str) -> list[float]:
    if i >= len(rows):
        raise Error(f"line {rows[-1][0] if rows else 1}: ends before {what}")
    try:
        got = [float(word) for word in rows[i][1][:many]]
    except ValueError:
        got = []
    if len(got) < many or many < 3 and not all(abs(v) < 1e15 and v == int(v) for v in got):
        raise Error(f"line {rows[i][0]}: {what} of {many} numbers is expected")
    if what == "a face" and not all(abs(v) < 1e15 for v in got):
        raise Error(f"line {rows[i][0]}: a corner is no number of a vertex")
    return got


def _tint(words: list[bytes]) -> tuple[float, ...] | None:
    """Red, green and blue from 0 to 1: whole numbers are bytes."""
    try:
        got = [float(word) for word in words[:3]]
    except ValueError:
        return None
    scale = 1 if any(b"." in word for word in words[:3]) else 255
    return tuple(min(max(v / scale, 0.0), 1.0) if v == v else 0.0 for v in got) \
        if len(got) == 3 else None
