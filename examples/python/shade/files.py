"""Files of models."""
from __future__ import annotations

import ctypes
import os
from typing import Any, Union

import numpy as np

from ._arguments import shown
from ._native import Error, library
from .mesh import Mesh


def _copied(address: int | None, count: int, columns: int, kind: Any) -> Any:
    if not address or not count:
        return None
    made = (kind * (count * columns)).from_address(address)
    return np.frombuffer(made, kind).reshape(count, columns).copy()


def load(path: Union[str, "os.PathLike[str]"], **options: Any) -> Mesh:
    """Reads an STL (binary or text), OBJ or PLY file.  options are those of Mesh.

    Raises OSError where the file cannot be opened, and shade.Error with the line where it is wrong.
    """
    try:
        name = os.fsencode(path)
    except TypeError:
        raise Error(f"path must be a path, not {shown(path)}") from None
    if b"\0" in name:
        raise Error("path must not contain a zero byte")
    with open(name, "rb"):
        pass
    words = ctypes.create_string_buffer(400)
    owned = library.python_load(name, words, len(words))
    if not owned:
        raise Error(words.value.decode("utf-8", "replace") or "out of memory")
    try:
        view, own = owned.contents.view, owned.contents
        vertices = _copied(own.positions, view.vertex_count, 3, ctypes.c_float)
        faces = _copied(own.indices, view.index_count // 3, 3, ctypes.c_uint)
        colors = _copied(own.colors, view.vertex_count, 3, ctypes.c_float)
    finally:
        library.python_unload(owned)
    if vertices is None or faces is None:
        raise Error(f"{os.fsdecode(name)} has no triangles")
    made = Mesh(vertices, faces, **options)
    if colors is not None and "color" not in options:
        shown_colors = np.where(colors <= 0.0031308, 12.92 * colors,
                                1.055 * np.maximum(colors, 0) ** (1 / 2.4) - 0.055)
        made = Mesh(vertices, faces, color=shown_colors, **options)
    return made
