"""Meshes: what callers have, as the arrays that the library draws."""
from __future__ import annotations

import ctypes
import os
import warnings
from dataclasses import dataclass
from typing import Any, Iterable, Sequence, Union

import numpy as np

from . import _arguments as arguments
from ._native import Array, Asked, Bytes, Chunk, Doubles, Error, Floats, Texture, check, copied, library, pointer
from ._native import Mesh as NativeMesh
from .annotate import NONE, Bar, bar_of, sampled
from .camera import UPRIGHT
from .others import parts_of
from .cloud import balls
from .light import Material

NORMALS = ["flat", "auto", "smooth"]    # BUILD_FLAT, ...


def counted(exact: Array, faces: Array) -> tuple[Floats, Doubles]:
    """Vertices as floats that count from an origin, and that: zero but for doubles far away."""
    origin, local = np.zeros(3), np.empty(exact.shape, np.float32)
    if exact.dtype.itemsize <= 4 or not len(exact):
        local[:] = exact
        return local, origin
    at = np.ascontiguousarray(exact, np.float64)
    if library.python_local(pointer(at), len(at), pointer(faces), faces.size, pointer(local), pointer(origin)):
        raise MemoryError("memory is not enough for the mesh")
    return local, origin


@dataclass(frozen=True, eq=False)
class Surface:
    """What faces look like: a material, or None for that of the part, and a texture, (h, w, 3 or
    4), or None.  With blend the alpha of the texture times opacity shows what is behind; with a
    cutoff texels of less alpha are holes; else alpha is ignored.  wrap, "repeat", "clamp" or
    "mirror" for u and v, says how the pictures go on beyond their edges; with squares texels are seen
    as such, in pictures of at most 512 x 512.  metal, 0 to 1, is how much
    of what the studio's light shows in it has its colour, and roughness how blurred that is, 0 by
    the exponent of the material.

    relief is a normal map, green up, or a bump map, whose brightness is height: its colours tell
    which.  strength is a factor of the slopes of a normal map, and of a bump map how high white is
    above black, in units of the mesh.  glow is the light that a surface sends by itself, a picture
    that glow_factor, linear red, green and blue, multiplies.

    With unlit neither lamps nor shadows change its color: it is the diffuse one of the material, times
    texture and colors of the mesh."""

    material: Material | None = None
    texture: object = None
    blend: bool = False
    opacity: float = 1.0
    cutoff: float = 0.0
    wrap: tuple[str, str] = ("repeat", "repeat")
    squares: bool = False
    metal: float = 0.0
    roughness: float = 0.0
    relief: object = None
    strength: float = 1.0
    glow: object = None
    glow_factor: Sequence[float] = (1.0, 1.0, 1.0)
    unlit: bool = False

    @property
    def mapped(self) -> bool:
        """Whether it has a picture of any kind."""
        return any(one is not None for one in (self.texture, self.relief, self.glow))


def _not_finite(rows: Floats) -> Array:
    out: Array = ~np.isfinite(rows).all(1)
    return out


class Piece:
    """A run of a mesh's triangles with one surface, as the library has it."""

    def __init__(self, mesh: Mesh, surface: Surface, first: int, count: int,
                 texture: Bytes | None) -> None:
        """Triangles first to first + count."""
        self.surface, self.first, self.count, self.texture = surface, first, count, texture
        arguments.flag("blend", surface.blend)
        arguments.number("opacity", surface.opacity, 0, 1)
        arguments.number("cutoff", surface.cutoff, 0, 1e9)
        self.strength = arguments.number("strength", surface.strength, -1e9, 1e9)
        self.glow_factor = arguments.floats("glow_factor", surface.glow_factor, (3,), True)
        self.mesh = mesh.native(self)
        self._kept: list[object] = []
        relief, glow = (None if one is None else arguments.texture(name, one)
                        for name, one in (("relief", surface.relief), ("glow", surface.glow)))
        #: What the fields of a renderer_object hold: a picture, whose colours are a display's or not.
        self.pictures = {"texture": (texture, True), "relief": (relief, False), "glow_map": (glow, True)}
        self.map, self.relief, self.glow = (self._make_map(*one) for one in self.pictures.values())
        self.heights = 0 if relief is None else library.python_heights(
            pointer(relief), relief.shape[1], relief.shape[0])
        self._make_chunks()

    def dress(self, item: Any) -> None:
        """Sets the surface of an item of the library, but its material."""
        look = self.surface
        item.blended, item.opacity, item.alpha_cutoff = look.blend, look.opacity, look.cutoff
        item.unlit = arguments.flag("unlit", look.unlit)
        item.metal = arguments.number("metal", look.metal, 0, 1)
        item.rough = arguments.number("roughness", look.roughness, 0, 1)
        if self.map is not None:
            item.state.diffuse_map = ctypes.pointer(self.map)
        if self.relief is not None:
            item.relief, item.relief_heights = ctypes.pointer(self.relief), self.heights
            item.relief_strength = self.strength
        if self.glow is not None:
            item.glow_map = ctypes.pointer(self.glow)
            item.glow = tuple(self.glow_factor.tolist())

    def _make_chunks(self) -> None:
        count = library.shade_chunk_count(3 * self.count, 0)
        if count < 8:
            return
        self.chunks = (Chunk * count)()
        check(library.shade_mesh_chunks(ctypes.byref(self.mesh), 0, self.chunks, count, None),
              "faces")
        self.mesh.chunks, self.mesh.chunk_count = ctypes.addressof(self.chunks), count

    def _make_map(self, texture: Bytes | None, srgb: bool) -> Any:
        """A texture with its mipmaps."""
        if texture is None:
            return None
        h, w = texture.shape[:2]
        out = Texture(pixels=pointer(texture), width=w, height=h, srgb=srgb)
        out.wrap_u, out.wrap_v = arguments.wraps(self.surface.wrap)
        mipmaps = np.empty(library.shade_mipmap_bytes(w, h, 0), np.uint8)
        levels = (Texture * max(1, library.shade_mipmap_count(w, h)))()
        check(library.python_texture_levels(ctypes.byref(out), levels, pointer(mipmaps), mipmaps.size,
                                            arguments.flag("squares", self.surface.squares)), "texture")
        self._kept += [texture, mipmaps, levels]
        return out


class Mesh:
    """Triangles, checked and ready to be drawn: it may be added to many scenes.

    vertices is (n, 3), faces (m, 3) or (m, 4).  color is one colour, or an array by vertex or by
    face, as display colours 0 .. 1 or bytes.  normals is (n, 3), or "auto": rounded where faces
    meet at less than 40 degrees (beyond 200,000 triangles "flat"), "smooth" or "flat".  uv is
    (n, 2) with v upward, as in OBJ files, and needs a texture, (h, w, 3 or 4).

    surfaces, a pair of one number a face (0, 1, ...; of triangles or of polygons, as faces has
    them) and a list of Surface, takes the place of texture where there are several.  up is the
    upright axis that views count on, None for z.

    scalars, a number for each vertex or face, take the place of colours: cmap is "viridis",
    "cool-to-warm", "grey" or colours of one's own, (n, 3), from clim[0] to clim[1], or from the
    least number to the greatest.  Numbers beyond have the colours of the ends; faces with NaN are
    grey, and told in a warning.  Pictures show a bar with figures and the title.
    """

    def __init__(self, vertices: object, faces: object, *, color: object = None,
                 normals: object = "auto", uv: object = None, texture: object = None,
                 surfaces: tuple[object, Sequence[Surface]] | None = None,
                 up: str | None = None, scalars: object = None, cmap: object = "viridis",
                 clim: object = None, title: str = "") -> None:
        """Refuses arrays of a wrong shape, type or size by their names."""
        exact = arguments.array("vertices", points(vertices), (None, 3))
        self.origin = np.zeros(3)
        self.faces = arguments.faces("faces", _listed(faces), len(exact))
        if not len(self.faces):
            self.faces = self.faces.reshape(0, 3)
        self.local, self.origin = counted(exact, self.faces)
        lost = _not_finite(self.local)[self.faces].any(1).sum()
        if lost:
            warnings.warn(f"vertices: {lost} triangles have corners that are no finite numbers (left out)",
                          stacklevel=3)
        self.up = None if up is None else arguments.choice("up", up, list(UPRIGHT))
        self.bar: Bar | None = None
        if scalars is not None:
            if any(other is not None for other in (color, uv, texture, surfaces)):
                raise Error("scalars take the place of color, uv, texture and surfaces")
            color, uv, surfaces = self._take_scalars(scalars, len(np.asarray(_listed(faces))),
                                                     (cmap, clim, title))
            faces = self.faces
        elif clim is not None or title or not isinstance(cmap, str) or cmap != "viridis":
            raise Error("cmap, clim and title need scalars")
        order, runs, looks = self._sorted(surfaces, np.asarray(_listed(faces)), texture)
        if order is not None:
            self.faces = np.ascontiguousarray(self.faces[order])
            arguments.dimensions("color", color)
            tints = None if isinstance(color, str) else np.asarray(color)
            if tints is not None and tints.ndim == 2 and len(tints) == len(order) and \
                    len(order) != len(self.local):
                color = tints[order]
        self.color: tuple[float, float, float] | None = None
        self.colors: Floats | None = None
        self.positions, self.indices = self.local, self.faces
        self.normals: Floats | None = None
        self.uv: Floats | None = None
        self.texture: Bytes | None = None
        self._edges: tuple[Array, Doubles] | None = None
        self._seen: tuple[Array, Doubles] | None = None
        self.edged = len(self.faces)    # faces from here on have no edges: those of a cap
        self._take_color(color)
        if surfaces is None and (uv is None) != (texture is None):
            raise Error("uv and texture belong together: one of them is missing")
        if uv is not None:
            self.uv = arguments.floats("uv", uv, (len(self.local), 2))
            lost = _not_finite(self.uv).sum()
            if lost:
                warnings.warn(f"uv: {lost} rows are no finite numbers: they count as 0",
                              stacklevel=3)
            self.uv = np.stack([self.uv[:, 0], 1 - self.uv[:, 1]], 1)
        maps = [None if look.texture is None else arguments.texture("texture", look.texture)
                for look in looks]
        for look, picture in zip(looks, maps):
            if surfaces is not None and picture is not None and not look.blend and not look.cutoff:
                picture[:, :, 3] = 255
        if self.uv is None and any(look.mapped for look in looks):
            raise Error("uv is missing: a surface has a texture")
        self.texture = maps[0] if len(maps) == 1 else None
        self._take_normals(normals)
        self.pieces = [Piece(self, look, first, count, picture)
                       for look, (first, count), picture in zip(looks, runs, maps)]

    def _sorted(self, surfaces: Any, faces: Array, texture: object) -> tuple[Any, Any, Any]:
        """The order of the triangles by their surfaces, None for that of faces; of each surface
        its first triangle and how many there are; and the surfaces."""
        if surfaces is None:
            return None, [(0, len(self.faces))], [Surface(None, texture, cutoff=0.0)]
        try:
            numbers, looks = surfaces
        except (TypeError, ValueError):
            raise Error("surfaces must be a pair: a number for each face, a list of Surface") \
                from None
        if not looks or not all(isinstance(look, Surface) for look in looks):
            raise Error("surfaces[1] must hold one shade_h.Surface or more")
        number = arguments.array("surfaces[0]", numbers, (len(faces),))
        if number.dtype.kind not in "iu" or \
                number.size and not 0 <= number.min() <= number.max() < len(looks):
            raise Error(f"surfaces[0] must hold whole numbers from 0 to {len(looks) - 1}")
        if len(self.faces) != len(faces):
            number = np.repeat(number, len(self.faces) // max(1, len(faces)))
        order = np.argsort(number, kind="stable")
        count = np.bincount(number, minlength=len(looks)).tolist()
        first = np.cumsum([0, *count])[:-1].tolist()
        return order, list(zip(first, count)), list(looks)

    @property
    def vertices(self) -> Array:
        """(n, 3), in the coordinates of the caller: float32, or float64 far from the origin."""
        return self.local + self.origin if self.origin.any() else self.local

    def __repr__(self) -> str:
        """Says how many triangles there are, and how large the box around them is."""
        low, high = self.box()
        sides = " x ".join(f"{side:.6g}" for side in high - low)
        return f"<shade_h.Mesh of {len(self.faces)} triangles, {sides}>"

    def _take_scalars(self, scalars: object, rows: int, options: tuple[Any, ...]) -> Any:
        """Colours by face of numbers by face; of numbers by vertex the place in a map, so that they
        are mixed before they become colours, and the surfaces with the map."""
        got = arguments.array("scalars", scalars, (None,)).astype(np.float64)
        if np.isinf(got).any() and not np.isfinite(got).any() and options[1] is None:
            raise Error("scalars must have a finite number, or clim: all are infinite")
        count, faces = len(self.local), len(self.faces)
        if len(got) not in (count, rows, faces):
            raise Error(f"scalars must have a number for each of {count} vertices or {rows} faces, "
                        f"not {len(got)}")
        self.bar = bar = bar_of(got, *options)
        if bar.gaps:
            warnings.warn(f"scalars has {int(np.isnan(got).sum())} NaN: their faces are grey",
                          stacklevel=4)
        grey = arguments.color("color", NONE)
        plain = Surface(Material((0, 0, 0), grey, grey))
        if len(got) != count:
            each = bar.place(np.repeat(got, faces // max(rows, 1)) if len(got) == rows else got)
            number = np.isnan(each).astype(int)
            tints = sampled(bar.colors, np.nan_to_num(each))
            tints[number > 0] = 1
            if faces == count:    # else the rows would be taken for those of vertices
                self.local = np.concatenate([self.local, self.local[:1]])
            return tints, None, (number, [Surface(), plain])
        texture, first, growth = bar.texture()
        at = bar.place(got)
        uv = np.stack([first + growth * np.nan_to_num(at), np.full(count, 0.5)], 1)
        number = np.isnan(at)[self.faces].any(1).astype(int)
        return None, uv, (number, [Surface(None, texture), plain])

    def _take_color(self, color: object) -> None:
        if color is None:
            return
        if isinstance(color, str) or arguments.dimensions("color", color) == 1:
            self.color = arguments.color("color", color)
            return
        self.colors = arguments.linear("color", color)
        if len(self.colors) not in (len(self.local), len(self.faces)):
            raise Error(f"color must have a row for each of {len(self.local)} vertices or "
                        f"{len(self.faces)} faces, not {len(self.colors)}")

    def _take_normals(self, normals: object) -> None:
        """Corners with a normal or a face's colour of their own become vertices."""
        given, kind = None, "flat"
        if isinstance(normals, str):
            kind = arguments.choice("normals", normals, ("auto", "smooth", "flat"))
        elif normals is not None:
            given = arguments.floats("normals", normals, self.local.shape)
        own = {"positions": self.local, "normals": given, "colors": self.colors, "texcoords": self.uv,
               "indices": self.faces}
        why = ctypes.c_int()
        asked = Asked(*map(pointer, own.values()), len(self.local), self.faces.size,
                      0 if self.colors is None else len(self.colors), NORMALS.index(kind))
        made = library.python_build(ctypes.byref(asked), ctypes.byref(why))
        check(why.value, "normals")
        mesh = made.contents

        def row(name: str, columns: int) -> Any:
            address, array = getattr(mesh, name), own[name]
            if array is not None and address == pointer(array):
                return array
            rows = copied(address, mesh.vertex_count, columns, ctypes.c_float)
            return rows if mesh.vertex_count or not address else np.empty((0, columns), np.float32)

        try:
            self.positions, self.normals, self.colors, self.uv = (
                row(name, columns) for name, columns in
                (("positions", 3), ("normals", 3), ("colors", 3), ("texcoords", 2)))
            if len(self.faces) and mesh.indices != pointer(self.faces):
                self.indices = copied(mesh.indices, len(self.faces), 3, ctypes.c_uint)
        finally:
            library.python_build_free(made)

    def _seen_of(self) -> tuple[Array, Doubles]:
        """Which vertices can be seen, those of faces but of such whose corners meet, and the box around them."""
        if self._seen is None:
            used, box = np.zeros(len(self.local), bool), np.zeros((2, 3))
            library.python_seen(pointer(self.local), len(used), pointer(self.faces), self.faces.size,
                                pointer(used), pointer(box))
            self._seen = used, box
        return self._seen

    def box(self) -> tuple[Doubles, Doubles]:
        """The least and greatest coordinates of the vertices of faces that can be seen."""
        low, high = self._seen_of()[1] + self.origin
        return low, high

    @property
    def radius(self) -> float:
        """How far from the mesh's origin its box reaches."""
        return float(np.abs(self._seen_of()[1]).max()) * 3**0.5

    def drawn_vertices(self) -> Floats:
        """The vertices of faces that can be seen, which count from the mesh's origin."""
        used = self._seen_of()[0]
        return self.local if used.all() else self.local[used]

    def __getstate__(self) -> dict[str, Any]:
        """All but what points into this mesh."""
        pieces = [(k.surface, k.first, k.count, k.texture) for k in self.pieces]
        return {**self.__dict__, "pieces": pieces, "_edges": None}

    def __setstate__(self, state: dict[str, Any]) -> None:
        """Makes the pieces for the library again."""
        self.__dict__.update(state)
        self.pieces = [Piece(self, *piece) for piece in state["pieces"]]

    def native(self, piece: Piece | None = None) -> Any:
        """The struct of the library, which points into this mesh: all of it, or a piece."""
        indices = self.indices
        if piece is not None:
            indices = indices[piece.first:piece.first + piece.count]
        return NativeMesh(
            positions=pointer(self.positions), normals=pointer(self.normals),
            texcoords=pointer(self.uv), colors=pointer(self.colors),
            vertex_count=len(self.positions), indices=pointer(indices),
            index_count=indices.size)

    def edges(self) -> tuple[Array, Doubles]:
        """Each edge once, with its faces, where vertices of one position count as one, and the
        normals of faces.  Threads may compute them twice, but see them whole or not at all."""
        if self._edges is None:
            faces, count = self.faces[:self.edged], ctypes.c_int()
            edges, normals = np.empty((faces.size, 4), np.int32), np.empty(faces.shape)
            mesh = NativeMesh(positions=pointer(self.local), vertex_count=len(self.local),
                              indices=pointer(faces), index_count=faces.size)
            check(library.python_edges(ctypes.byref(mesh), pointer(edges), pointer(normals), ctypes.byref(count)),
                  "faces")
            self._edges = edges[:count.value], normals
        return self._edges

    def drawn_edges(self, eye: Doubles, ortho_back: Doubles | None, angle: float = 30.0) -> Floats:
        """Pairs of points of the edges that an illustrator draws from an eye: silhouettes, creases
        sharper than the angle, and boundaries.  Eye and points count from the mesh's origin."""
        edges, normals = self.edges()
        points = np.empty((2 * len(edges), 3), np.float32)
        way = np.ascontiguousarray(eye if ortho_back is None else ortho_back, np.float64)
        count = library.python_drawn_edges(
            pointer(self.local), pointer(edges), len(edges), pointer(normals), pointer(way),
            ortho_back is not None, np.cos(np.radians(angle)), pointer(points))
        return points[:count]


Like = Union[Mesh, "os.PathLike[str]", str, bytes, Any]


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
    if isinstance(value, (np.ndarray, str, bytes)):
        return value
    if isinstance(value, memoryview):
        return np.asarray(value)
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
            factor = getattr(material, "baseColorFactor", None)
            if factor is not None:    # which multiplies the picture
                out["color"] = np.asarray(factor)[:3]
        elif material is not None and hasattr(material, "main_color"):
            out["color"] = np.asarray(material.main_color)[:3]
    return out


def is_file(value: object) -> bool:
    """Is it a path, or a file that is open?"""
    return isinstance(value, (str, bytes, os.PathLike)) or callable(getattr(value, "read", None))


def mesh(value: Like, **options: Any) -> Mesh:
    """Makes a Mesh of a path, of a pair (vertices, faces), of an object with .vertices and .faces
    (trimesh), of a mesh of PyVista, VTK, meshio or Open3D, or of one with .tessellate (cadquery,
    build123d); of points alone, (n, 3), small balls.  options are those of Mesh."""
    if isinstance(value, Mesh) and not options:
        return value
    if isinstance(value, Mesh):
        return Mesh(value.vertices, value.faces, **options)
    if is_file(value) and not hasattr(value, "cells"):    # a meshio.Mesh has read() too
        from .files import load
        return load(value, **options)
    if isinstance(value, (tuple, list)) and len(value) == 2:
        return Mesh(value[0], value[1], **options)
    if isinstance(value, np.ndarray) and value.ndim == 2:
        corners, triangles, more = balls(value, options)
        return Mesh(corners, triangles, **more)
    given = {k: v for k, v in options.items() if v is not None}
    parts = parts_of(value)
    if parts is not None:
        look = {} if "color" in given or "texture" in given else parts[2]
        return Mesh(parts[0], parts[1], **{**look, **given})
    other: Any = value
    shape = other.val() if callable(getattr(other, "val", None)) else other
    faces = getattr(shape, "faces", None)
    if callable(getattr(shape, "tessellate", None)) and (faces is None or callable(faces)):
        vertices, faces = shape.tessellate(0.1)
        return Mesh(vertices, faces, **options)
    if faces is None or callable(faces) or not hasattr(shape, "vertices"):
        raise Error("mesh must have .vertices and .faces, or be (vertices, faces) or a path, "
                    f"not {arguments.shown(value)}")
    count = len(np.asarray(shape.vertices)), len(np.asarray(faces))
    extra = {} if "color" in given or "texture" in given else _visual(shape, count)
    return Mesh(shape.vertices, faces, **{**extra, **given})
