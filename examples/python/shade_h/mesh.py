"""Meshes: what callers have, as the arrays that the library draws."""
from __future__ import annotations

import ctypes
import os
from typing import Any, Iterable, Union

import numpy as np

from . import _arguments as arguments
from ._native import (Array, Bytes, Chunk, Edge, Error, Floats, Indices, Texture, check, library,
                      pointer)
from ._native import Mesh as NativeMesh

CREASE_TRIANGLES = 200_000
COS_CREASE = 0.766    # faces that meet at less than 40 degrees are rounded


class Mesh:
    """Triangles, checked and ready to be drawn: it may be added to many scenes.

    vertices is (n, 3), faces (m, 3) or (m, 4).  color is one colour, or an array by vertex or by
    face, as display colours 0 .. 1 or bytes.  normals is (n, 3), or "auto": rounded where faces
    meet at less than 40 degrees (beyond 200,000 triangles "flat"), "smooth" or "flat".  uv is
    (n, 2) with v upward, as in OBJ files, and needs a texture, (h, w, 3 or 4).
    """

    def __init__(self, vertices: object, faces: object, *, color: object = None,
                 normals: object = "auto", uv: object = None, texture: object = None) -> None:
        """Refuses arrays of a wrong shape, type or size by their names."""
        self.vertices = arguments.floats("vertices", points(vertices), (None, 3))
        self.faces = arguments.faces("faces", _listed(faces), len(self.vertices))
        if not len(self.faces):
            self.faces = self.faces.reshape(0, 3)
        self.color: tuple[float, float, float] | None = None
        self.colors: Floats | None = None
        self.positions, self.indices = self.vertices, self.faces
        self.normals: Floats | None = None
        self.uv: Floats | None = None
        self.texture: Bytes | None = None
        self._edges: Array | None = None
        by_face = self._take_color(color)
        if (uv is None) != (texture is None):
            raise Error("uv and texture belong together: one of them is missing")
        if uv is not None:
            self.uv = arguments.floats("uv", uv, (len(self.vertices), 2)) 
            self.uv = np.stack([self.uv[:, 0], 1 - self.uv[:, 1]], 1)
            self.texture = arguments.texture("texture", texture)
        self._take_normals(normals, by_face)
        self._chunks = self._make_chunks()
        self._map = self._make_map()

    def _take_color(self, color: object) -> bool:
        """Returns whether there is a colour by face."""
        if color is None or isinstance(color, str):
            self.color = None if color is None else arguments.color("color", color)
            return False
        got = np.asarray(color)
        if got.ndim == 1:
            self.color = arguments.color("color", color)
            return False
        self.colors = arguments.linear("color", color)
        if len(self.colors) == len(self.vertices):
            return False
        if len(self.colors) == len(self.faces):
            return True
        raise Error(f"color must have a row for each of {len(self.vertices)} vertices or "
                    f"{len(self.faces)} faces, not {len(self.colors)}")

    def _take_normals(self, normals: object, by_face: bool) -> None:
        own = None
        if isinstance(normals, str):
            kind = arguments.choice("normals", normals, ("auto", "smooth", "flat"))
            if kind == "auto" and 0 < len(self.faces) <= CREASE_TRIANGLES:
                own = self._creased()
            if kind == "smooth" and len(self.faces):
                self.normals = np.empty_like(self.vertices)
                native = ctypes.byref(self.native())
                check(library.shade_mesh_normals(native, pointer(self.normals)), "normals")
        elif normals is not None:
            self.normals = arguments.floats("normals", normals, self.vertices.shape)
        flat = own is None and self.normals is None
        if flat:
            own = self._flat()
        if own is not None or by_face:
            self._take_corners(own, by_face, not flat)

    def _flat(self) -> Floats:
        """The normal of each corner's face."""
        out = np.empty((3 * len(self.faces), 3), np.float32)
        library.python_face_normals(ctypes.byref(self.native()), pointer(out))
        return out

    def _take_corners(self, own: Floats | None, by_face: bool, weld: bool) -> None:
        """Gives corners with a normal or a colour of their own a vertex for each of these; without
        weld, which then would find little, one for each corner."""
        corner = self.faces.reshape(-1)
        made = index = np.arange(len(corner), dtype=np.uint32)
        if weld:
            index, made = self._welded(corner, own, by_face)
            own = None if own is None else own[made]
        vertex = corner[made]
        self.positions, self.indices = self.vertices.take(vertex, 0), index.reshape(-1, 3)
        self.normals = own if own is not None else None if self.normals is None \
            else self.normals.take(vertex, 0)
        self.uv = None if self.uv is None else self.uv.take(vertex, 0)
        if self.colors is not None:
            self.colors = self.colors.take(made // 3 if by_face else vertex, 0)

    def _welded(self, corner: Indices, own: Floats | None,
                by_face: bool) -> tuple[Indices, Indices]:
        """The vertex of each corner, and a corner of each vertex."""
        values = [v for v in (own, np.repeat(self.colors, 3, 0)
                              if by_face and self.colors is not None else None) if v is not None]
        value = np.ascontiguousarray(np.concatenate(values, 1) if len(values) > 1 else values[0])
        index, made, link = (np.empty(len(corner), np.uint32) for _ in range(3))
        first = np.full(len(self.vertices), -1, np.int32)
        count = library.python_weld(pointer(corner), len(corner), pointer(value), value.shape[1],
                                    pointer(index), pointer(made), pointer(first), pointer(link))
        return index, made[:count]

    def _creased(self) -> Floats | None:
        """One normal for each corner, or None where many faces around a point would cost much."""
        if np.bincount(self.faces.reshape(-1)).max() > 2000:
            return None
        native = ctypes.byref(self.native())
        memory = np.empty(library.shade_mesh_corner_normals_bytes(native), np.uint8)
        out = np.empty((3 * len(self.faces), 3), np.float32)
        check(library.shade_mesh_corner_normals(native, COS_CREASE, pointer(out), pointer(memory),
                                                memory.size), "normals")
        return out

    def drawn_vertices(self) -> Floats:
        """The vertices that faces have."""
        used = np.zeros(len(self.vertices), bool)
        used[self.faces.reshape(-1)] = True
        out: Floats = self.vertices if used.all() else self.vertices[used]
        return out

    def native(self) -> Any:
        """The struct of the library, which points into this mesh."""
        chunks = getattr(self, "_chunks", None)
        mesh = NativeMesh(
            positions=pointer(self.positions), normals=pointer(self.normals),
            texcoords=pointer(self.uv), colors=pointer(self.colors),
            vertex_count=len(self.positions), indices=pointer(self.indices),
            index_count=self.indices.size)
        if chunks is not None:
            mesh.chunks, mesh.chunk_count = ctypes.addressof(chunks), len(chunks)
        return mesh

    def _make_chunks(self) -> Any:
        count = library.shade_chunk_count(self.indices.size, 0)
        if count < 8:
            return None
        chunks = (Chunk * count)()
        native = ctypes.byref(self.native())
        check(library.shade_mesh_chunks(native, 0, chunks, count, None), "faces")
        return chunks

    def _make_map(self) -> Any:
        """The texture with its mipmaps."""
        if self.texture is None:
            return None
        h, w = self.texture.shape[:2]
        out = Texture(pixels=pointer(self.texture), width=w, height=h, srgb=1, filter=2)
        self._mipmaps = np.empty(library.shade_mipmap_bytes(w, h, 0), np.uint8)
        self._levels = (Texture * max(1, library.shade_mipmap_count(w, h)))()
        check(library.shade_build_mipmaps(ctypes.byref(out), self._levels, pointer(self._mipmaps),
                                          self._mipmaps.size), "texture")
        return out

    def map(self) -> Any:
        """The texture as the library has it, or None."""
        return self._map

    def edges(self) -> Array:
        """Each edge once, with its faces, where vertices of one position count as one."""
        if self._edges is None:
            bits = np.ascontiguousarray(self.vertices + np.float32(0)).view(np.uint32)
            _, first, place = np.unique(bits, axis=0, return_index=True, return_inverse=True)
            welded = np.ascontiguousarray(first[place.reshape(-1)][self.faces], np.uint32)
            good = (welded[:, 0] != welded[:, 1]) & (welded[:, 1] != welded[:, 2]) & \
                (welded[:, 0] != welded[:, 2])
            welded = np.ascontiguousarray(welded[good])
            mesh = NativeMesh(positions=pointer(self.vertices), vertex_count=len(self.vertices),
                              indices=pointer(welded), index_count=welded.size)
            room, count = (Edge * max(1, welded.size))(), ctypes.c_int()
            if welded.size:
                check(library.shade_mesh_edges(ctypes.byref(mesh), room, welded.size,
                                               ctypes.byref(count)), "faces")
            self._edges = np.ctypeslib.as_array(room).view(np.int32).reshape(-1, 4)[:count.value]
            self._normals_of_edges(welded)
        return self._edges

    def _normals_of_edges(self, welded: Indices) -> None:
        p = self.vertices[welded].astype(np.float64)
        self._face_normals = np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0])
        with np.errstate(all="ignore"):
            self._face_normals /= np.linalg.norm(self._face_normals, axis=1, keepdims=True)
        self._centres = p[:, 0]

    def drawn_edges(self, eye: Floats, ortho_back: Floats | None, angle: float = 30.0) -> Floats:
        """Pairs of points of the edges that an illustrator draws from an eye in object space:
        silhouettes, creases sharper than the angle, and boundaries."""
        edges = self.edges()
        if not len(edges):
            return np.empty((0, 3), np.float32)
        a, b, f, g = edges.T
        n0, n1 = self._face_normals[f], self._face_normals[g]
        to_eye = eye - self.vertices[a] if ortho_back is None else ortho_back
        with np.errstate(all="ignore"):
            outline = (n0 * to_eye).sum(1) * (n1 * to_eye).sum(1) <= 0
            crease = (n0 * n1).sum(1) <= np.cos(np.radians(angle))
        keep = (g < 0) | outline | crease
        pairs = self.vertices[np.stack([a[keep], b[keep]], 1)].reshape(-1, 3)
        return np.ascontiguousarray(pairs, np.float32)


Like = Union[Mesh, "os.PathLike[str]", str, Any]


def _point(p: object) -> object:
    """The coordinates of a vector of cadquery, build123d or OCP."""
    for name in ("toTuple", "to_tuple"):
        if hasattr(p, name):
            return getattr(p, name)()
    for names in ("xyz", "XYZ"):
        if hasattr(p, names[0]) and hasattr(p, names[2]):
            return [getattr(p, k) for k in names]
    return p


def points(vertices: object) -> object:
    """Vertices as an array, where they are a list of vectors."""
    got = _listed(vertices)
    return [_point(p) for p in got] if isinstance(got, (list, tuple)) and got and \
        not isinstance(got[0], (list, tuple, np.ndarray)) else got


def _listed(value: object) -> object:
    """An array of no rows has no columns to check."""
    if isinstance(value, np.ndarray) or isinstance(value, (str, bytes)):
        return value
    rows: object = list(value) if isinstance(value, Iterable) else value
    return np.empty((0, 3), np.float32) if isinstance(rows, list) and not rows else rows


def _visual(mesh: Any, count: tuple[int, int]) -> dict[str, Any]:
    """Colours or texture of trimesh's .visual."""
    visual = getattr(mesh, "visual", None)
    out: dict[str, Any] = {}
    kind = getattr(visual, "kind", None)
    if kind in ("vertex", "face"):
        out["color"] = getattr(visual, f"{kind}_colors")
    elif kind == "texture":
        material = getattr(visual, "material", None)
        image = getattr(material, "image", None)
        image = getattr(material, "baseColorTexture", None) if image is None else image
        uv = getattr(visual, "uv", None)
        if image is not None and uv is not None and len(uv) == count[0]:
            convert = getattr(image, "convert", None)
            out = {"uv": uv, "texture": np.asarray(convert("RGBA") if convert else image)}
        elif material is not None and hasattr(material, "main_color"):
            out["color"] = np.asarray(material.main_color)[:3]
    return out


def mesh(value: Like, **options: Any) -> Mesh:
    """Makes a Mesh of a path, of a pair (vertices, faces), of an object with .vertices and .faces
    (trimesh), or of one with .tessellate (cadquery, build123d).  options are those of Mesh."""
    if isinstance(value, Mesh) and not options:
        return value
    if isinstance(value, Mesh):
        return Mesh(value.vertices, value.faces, **options)
    if isinstance(value, (str, os.PathLike)):
        from .files import load
        return load(value, **options)
    if isinstance(value, (tuple, list)) and len(value) == 2:
        return Mesh(value[0], value[1], **options)
    shape = value.val() if callable(getattr(value, "val", None)) else value
    faces = getattr(shape, "faces", None)
    if callable(getattr(shape, "tessellate", None)) and (faces is None or callable(faces)):
        vertices, faces = shape.tessellate(0.1)
        return Mesh(vertices, faces, **options)
    if faces is None or callable(faces) or not hasattr(shape, "vertices"):
        raise Error("mesh must have .vertices and .faces, or be (vertices, faces) or a path, "
                    f"not {arguments.shown(value)}")
    count = len(np.asarray(shape.vertices)), len(np.asarray(faces))
    given = {k: v for k, v in options.items() if v is not None}
    extra = {} if "color" in given or "texture" in given else _visual(shape, count)
    return Mesh(shape.vertices, faces, **{**extra, **given})
