"""Meshes of other libraries, by the attributes that they have: PyVista, VTK, meshio and Open3D."""
from __future__ import annotations

import warnings
from typing import Any

import numpy as np

from ._native import Array, Error



def _cut(corners: Array, ends: Array, named: str) -> Array:
    """Triangles of polygons, which follow each other: ends has where each ends."""
    counts = np.diff(ends, prepend=0)
    most = int(counts.max()) if len(counts) else 3
    if most > 4:
        raise Error(f"{named} has polygons of {most} corners: make triangles of them before, by its triangulate()")
    first = ends - counts
    parts = [corners[first[counts >= 3][:, None] + [0, 1, 2]], corners[first[counts == 4][:, None] + [0, 2, 3]]]
    return np.concatenate([part.reshape(-1, 3) for part in parts])


def _of_flat(points: Any, flat: Any, named: str) -> Any:
    """Of faces as VTK had them: 3, a, b, c, 4, a, b, c, d, ..."""
    faces, keep, at = np.asarray(flat).ravel(), np.ones(np.size(flat), bool), 0
    ends: list[int] = []
    if len(faces) % 4 == 0 and (faces[::4] == 3).all():    # most are triangles
        return points, faces.reshape(-1, 4)[:, 1:], {}
    while at < len(faces):
        keep[at] = False
        at += int(faces[at]) + 1
        ends.append(at - len(ends) - 1)
    if at != len(faces):
        raise Error(f"{named}.faces must be 3, a, b, c, ...: it ends within a face")
    return points, _cut(faces[keep], np.array(ends, np.int64), named), {}


def _of_vtk(data: Any, named: str) -> Any:
    """Of a vtkPolyData."""
    polygons = data.GetPolys()
    left = {"strips": data.GetNumberOfStrips(), "lines": data.GetNumberOfLines(), "vertices": data.GetNumberOfVerts()}
    told = [f"{count} {what}" for what, count in left.items() if count]
    if told:
        warnings.warn(f"{named} has {', '.join(told)} (left out)", stacklevel=5)
    points, corners, offsets = (np.array(memoryview(array)) for array in
                                (data.GetPoints().GetData(), polygons.GetConnectivityArray(), polygons.GetOffsetsArray()))
    return points.reshape(-1, 3), _cut(corners, offsets[1:], named), {}


def _of_meshio(mesh: Any, named: str) -> Any:
    """Of a meshio.Mesh: its triangles and quads."""
    taken = [block for block in mesh.cells if block.type in ("triangle", "quad")]
    left = sorted({block.type for block in mesh.cells} - {"triangle", "quad", "vertex", "line"})
    if left:
        warnings.warn(f"{named} has cells of type {', '.join(left)} (left out)", stacklevel=5)
    points = np.asarray(mesh.points)
    if points.ndim == 2 and points.shape[1] == 2:
        points = np.column_stack([points, np.zeros(len(points))])
    faces = [np.asarray(block.data) for block in taken]
    parts = [part for face in faces for part in ((face,) if face.shape[1] == 3 else (face[:, :3], face[:, [0, 2, 3]]))]
    return points, np.concatenate(parts) if parts else np.zeros((0, 3), int), {}


def _of_open3d(mesh: Any, named: str) -> Any:
    """Of a TriangleMesh, with the colours of its vertices."""
    colors = np.asarray(getattr(mesh, "vertex_colors", ()))
    points = np.asarray(mesh.vertices)
    return points, np.asarray(mesh.triangles), {"color": colors} if len(colors) == len(points) and len(colors) else {}


def parts_of(value: Any, named: str = "mesh") -> Any:
    """Vertices, faces and options of Mesh of a mesh of another library; None: it is none that is known."""
    if callable(getattr(value, "GetPolys", None)) and callable(getattr(value, "GetPoints", None)):
        return _of_vtk(value, named)
    faces, points = getattr(value, "faces", None), getattr(value, "points", None)
    if points is not None and faces is not None and not callable(faces) and np.ndim(faces) == 1:
        return _of_flat(np.asarray(points), faces, named)
    if points is not None and hasattr(value, "cells") and not callable(value.cells) and hasattr(value, "cell_data"):
        return _of_meshio(value, named)
    if hasattr(value, "triangles") and hasattr(value, "vertices"):
        return _of_open3d(value, named)
    return None
