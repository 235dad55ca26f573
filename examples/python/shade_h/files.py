"""Files of models."""
from __future__ import annotations

import ctypes
import os
from importlib import import_module
from typing import Any, Union

import numpy as np

from ._arguments import shown
from ._native import Error, library, pointer
from .mesh import Mesh
from .picture import Picture


def _copied(address: int | None, count: int, columns: int, kind: Any) -> Any:
    if not address or not count:
        return None
    made = (kind * (count * columns)).from_address(address)
    return np.frombuffer(made, kind).reshape(count, columns).copy()


def _display(linear: Any) -> Any:
    """Display colours, as Mesh takes them, of linear ones."""
    return np.where(linear <= 0.0031308, 12.92 * linear,
                    1.055 * np.maximum(linear, 0) ** (1 / 2.4) - 0.055)


def _tints(owned: Any, faces: int) -> Any:
    """The display colour of each face's surface, or None where the file says nothing."""
    tints = np.zeros((faces, 3), np.float32)
    return _display(tints) if library.python_tints(owned, pointer(tints)) else None


def _image(model: str, name: str) -> Any:
    """The pixels of a picture beside the model; None where it cannot be read."""
    folder, words = os.path.dirname(model), name.replace("\\", "/")
    for path in (os.path.join(folder, words), os.path.join(folder, os.path.basename(words))):
        try:
            return Picture.open(path).rgba
        except (OSError, Error):
            pass
        try:
            pillow = import_module("PIL.Image")    # for JPEG and the rest, where there is Pillow
            return np.asarray(pillow.open(path).convert("RGBA"))
        except (ImportError, OSError, ValueError):
            pass
    return None


def _surfaces(owned: Any, model: str, faces: int, uv: Any) -> dict[str, Any]:
    """What the file says of its surfaces, as options of Mesh."""
    tints, name = _tints(owned, faces), library.python_map(owned)
    out: dict[str, Any] = {} if tints is None else {"color": tints}
    image = _image(model, os.fsdecode(name)) if name and uv is not None else None
    if image is not None:
        out.update(uv=np.stack([uv[:, 0], 1 - uv[:, 1]], 1), texture=image)
    return out


def load(path: Union[str, "os.PathLike[str]"], **options: Any) -> Mesh:
    """Reads an STL (binary or text), OBJ or PLY file.  options are those of Mesh.

    Without a color or texture of their own meshes have those of the file: colours by vertex, or the
    diffuse colours of OBJ's MTL, with their picture where all surfaces have the same.

    Raises OSError where the file cannot be opened, and Error with the line where it is wrong.
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
        uv = _copied(own.texcoords, view.vertex_count, 2, ctypes.c_float)
        found = _surfaces(owned, os.fsdecode(name), view.index_count // 3, uv)
    finally:
        library.python_unload(owned)
    if vertices is None or faces is None:
        raise Error(f"{os.fsdecode(name)} has no triangles")
    if colors is not None:
        found["color"] = _display(colors)
    elif "color" in found and len(faces) == len(vertices):
        # a vertex that no face has, so that the colours cannot be taken for those of vertices
        vertices = np.concatenate([vertices, vertices[:1]])
        if "uv" in found:
            found["uv"] = np.concatenate([found["uv"], found["uv"][:1]])
    plain = options.get("color") is not None or options.get("texture") is not None
    return Mesh(vertices, faces, **{**({} if plain else found), **options})
