"""Meshes cut open by a plane, the cut filled and hatched."""
from __future__ import annotations

import ctypes
import warnings
from dataclasses import replace
from typing import Any

import numpy as np

from . import _arguments as arguments
from ._native import Array, Bytes, Doubles, Error, copied, library, pointer
from .annotate import display
from .light import Material
from .mesh import Mesh, Surface

AXES = {"x": (1.0, 0.0, 0.0), "y": (0.0, 1.0, 0.0), "z": (0.0, 0.0, 1.0)}
LINES = 24            # of the hatch across a mesh
_OPEN = 2             # CUT_OPEN: sheets, which have no inside


def _facing(normal: Doubles, ways: tuple[Doubles, Doubles]) -> Doubles:
    """The normal or its opposite, toward the first way that is not along the plane."""
    along = [float(normal @ way) for way in ways]
    return -normal if (along[0] if abs(along[0]) > 0.01 else along[1]) < 0 else normal


def plane_of(section: Any, low: Doubles, high: Doubles, ways: tuple[Doubles, Doubles]
             ) -> tuple[Doubles, Doubles]:
    """A point of the plane and its unit normal, toward which all is cut away: "x", "y" or "z"
    through the middle of a box, ("x", where), or (point, normal).  ways lead toward the eye, and
    toward another that serves where the first looks along the plane."""
    if isinstance(section, str):
        normal = np.array(AXES[arguments.choice("section", section, list(AXES))])
        return (low + high) / 2, _facing(normal, ways)
    if not isinstance(section, (tuple, list)) or len(section) != 2:
        raise Error("section must be x, y, z, (axis, where) or (point, normal), "
                    f"not {arguments.shown(section)}")
    first, second = section
    if isinstance(first, str):
        normal = np.array(AXES[arguments.choice("section[0]", first, list(AXES))])
        point = normal * arguments.number("section[1]", second, -1e30, 1e30)
        return point, _facing(normal, ways)
    point = arguments.doubles("section[0]", first, (3,), finite=True)
    normal = arguments.doubles("section[1]", second, (3,), finite=True)
    length = float(np.linalg.norm(normal))
    if length < 1e-18:
        raise Error("section[1], the normal of the plane, must not be zero")
    return point, normal / length


def _clipped(corners: Doubles, side: Doubles) -> tuple[Doubles, Array, Doubles]:
    """Triangles, (m, 3, k) with a position first, behind a plane; of each the one it came from;
    and the cuts, (n, 2, 3), with the solid on their left as seen against the normal.

    side is the distance of each corner.  A corner in the plane counts as behind it.  Two triangles
    of an edge cut it at the same bits, because the ends are taken in the same order.
    """
    out = side > 0
    count = out.sum(1)
    kept, whence = [corners[count == 0]], [np.flatnonzero(count == 0)]
    cuts = []
    for alone, front in ((1, True), (2, False)):
        these = np.flatnonzero(count == alone)
        if not len(these):
            continue
        # the corner that is alone on its side comes first
        first = (out[these] == front).argmax(1)
        order = (first[:, None] + np.arange(3)) % 3
        c = np.take_along_axis(corners[these], order[:, :, None], 1)
        s = np.take_along_axis(side[these], order, 1)
        ab, ac = _between(c, s, 1), _between(c, s, 2)
        if front:
            kept += [np.stack([ab, c[:, 1], c[:, 2]], 1), np.stack([ab, c[:, 2], ac], 1)]
            whence += [these, these]
            cuts.append(np.stack([ac[:, :3], ab[:, :3]], 1))
        else:
            kept.append(np.stack([c[:, 0], ab, ac], 1))
            whence.append(these)
            cuts.append(np.stack([ab[:, :3], ac[:, :3]], 1))
    none = np.zeros((0, 2, 3))
    return np.concatenate(kept), np.concatenate(whence), np.concatenate(cuts) if cuts else none


def _between(c: Doubles, s: Doubles, k: int) -> Doubles:
    """Where the edges from corner 0 to corner k meet the plane."""
    swap = s[:, 0] > s[:, k]
    low, high = np.where(swap, s[:, k], s[:, 0]), np.where(swap, s[:, 0], s[:, k])
    a = np.where(swap[:, None], c[:, k], c[:, 0])
    b = np.where(swap[:, None], c[:, 0], c[:, k])
    return np.asarray(a + (b - a) * (-low / (high - low))[:, None])


def _filled(cuts: Doubles, extent: float) -> Doubles:
    """Quadrangles, (n, 4, 2), that fill the outlines (m, 2, 2); told where these are not closed."""
    flat, state, count = np.ascontiguousarray(cuts), ctypes.c_int(), ctypes.c_size_t()
    made = library.python_fill(pointer(flat), len(flat), extent, ctypes.byref(state), ctypes.byref(count))
    if not made:
        raise MemoryError("memory is not enough for the section")
    if state.value:
        warnings.warn("section: the mesh is open" + (
            " where it is cut: the cut is not filled" if state.value == _OPEN else
            ", or turned both ways, where it is cut: the cut is filled between each second pair of its lines"),
            stacklevel=6)
    try:
        quads = copied(made, count.value, 8, ctypes.c_double)
    finally:
        library.python_give(made)
    return np.zeros((0, 4, 2)) if quads is None else np.asarray(quads.reshape(-1, 4, 2))


def hatch() -> Bytes:
    """A tile of oblique lines."""
    y, x = np.mgrid[0:32, 0:32]
    out = np.full((32, 32, 3), 255, np.uint8)
    out[(x + y) % 32 < 9] = 120
    return out


def cut(mesh: Mesh, point: Doubles, normal: Doubles) -> Mesh:
    """What of a mesh lies behind a plane, with its cut filled and hatched."""
    point = point - mesh.origin
    n = mesh.indices
    parts = [mesh.positions[n], mesh.normals[n] if mesh.normals is not None else None,
             mesh.colors[n] if mesh.colors is not None else None,
             mesh.uv[n] if mesh.uv is not None else None]
    corners = np.concatenate([np.asarray(p, np.float64) for p in parts if p is not None], 2)
    good = np.isfinite(corners[:, :, :3]).all((1, 2))
    number = np.repeat(np.arange(len(mesh.pieces)), [piece.count for piece in mesh.pieces])[good]
    corners = corners[good]
    kept, whence, cuts = _clipped(corners, (corners[:, :, :3] - point) @ normal)
    u = np.cross(normal, np.eye(3)[np.abs(normal).argmin()])
    u /= np.linalg.norm(u)
    v = np.cross(normal, u)
    flat = np.stack([(cuts - point) @ u, (cuts - point) @ v], 2)
    extent = float(np.ptp(corners[:, :, :3].reshape(-1, 3), 0).max()) if len(corners) else 1.0
    quads = _filled(flat, extent)
    cap = (quads[..., :1] * u + quads[..., 1:] * v + point)[:, [0, 1, 2, 0, 2, 3]].reshape(-1, 3, 3)
    size = (extent or 1.0) / LINES
    at = [3]
    for p in parts[1:]:
        at.append(at[-1] + (0 if p is None else p.shape[2]))
    points = np.concatenate([kept[:, :, :3], cap]).reshape(-1, 3)
    uv = np.zeros((len(kept), 3, 2))
    if mesh.uv is not None:
        uv = kept[:, :, at[2]:at[3]] * [1, -1] + [0, 1]
    cap_uv = np.stack([(cap - point) @ u, (cap - point) @ v], 2) / size
    options: dict[str, Any] = {"uv": np.concatenate([uv, cap_uv]).reshape(-1, 2)}
    options["normals"] = np.concatenate([
        kept[:, :, at[0]:at[1]], np.broadcast_to(normal, cap.shape)]).reshape(-1, 3)
    if mesh.colors is not None:
        options["color"] = display(np.concatenate([
            kept[:, :, at[1]:at[2]], np.ones(cap.shape)]).reshape(-1, 3))
    tint = mesh.color or arguments.color("color", "clay")
    looks = [replace(piece.surface, texture=piece.texture) for piece in mesh.pieces]
    looks.append(Surface(Material((0, 0, 0), tint, tint), hatch()))
    numbers = np.concatenate([number[whence], np.full(len(cap), len(mesh.pieces))])
    made = Mesh(points + mesh.origin, np.arange(len(points)).reshape(-1, 3), up=mesh.up,
                surfaces=(numbers, looks), **options)
    made.bar = mesh.bar
    made.color, made.edged = mesh.color, len(kept)    # the cut's outline is a boundary
    return made
