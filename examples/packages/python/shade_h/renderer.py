"""Cameras for simulators, learners and graders: one scene, many pictures of colour, depth, numbers of
objects and normals."""
from __future__ import annotations

import copy
import ctypes
import functools
import os
import re
import threading
import weakref
from typing import Any, NamedTuple, Sequence

import numpy as np

from . import _arguments as arguments
from ._native import (SHOT, SOLID, Array, Bytes, Error, Floats, Heights, Image, Integers,
                      Light as NativeLight, Mesh as NativeMesh, Moved, check, interruptible, library, pointer)
from .annotate import display
from .camera import Camera
from .light import Light, lamps_of
from .mesh import Mesh, counted, mesh as as_mesh
from .picture import Picture

#: The shapes that are made once for all scenes, and the numbers that their size is.
SHAPES = {"plane": 2, "sphere": 1, "ellipsoid": 3, "capsule": 2, "cylinder": 2, "box": 3}
_KINDS = {"mesh": 0, "plane": 1, "sphere": 2, "ellipsoid": 3, "capsule": 4, "cylinder": 5, "box": 6}
_HIDDEN, _TWO_SIDED, _NO_SHADOW, _BLENDED, _HEIGHTS, _UNLIT = 1, 2, 4, 8, 16, 32
_LAMPS, MOST = 8, 2**31 - 1
_PLAIN = np.zeros(1, SOLID)    # white, without a texture
_PLAIN["rgba"], _PLAIN["shininess"], _PLAIN["turn"] = 1, 32, np.eye(3)


_alive: weakref.WeakSet[Any] = weakref.WeakSet()    # Renderers, whose locks a fork must find free
_held: list[Any] = []


def _before_fork() -> None:
    _held[:] = list(_alive)
    for renderer in _held:
        renderer._change.acquire()


def _in_parent() -> None:
    while _held:
        _held.pop()._change.release()


def _in_child() -> None:
    while _held:
        _held.pop()._change = threading.RLock()


if hasattr(os, "register_at_fork"):
    os.register_at_fork(before=_before_fork, after_in_parent=_in_parent, after_in_child=_in_child)


def _changes(call: Any) -> Any:
    """A change of a Renderer: one at a time, while any number of pictures are drawn."""
    @functools.wraps(call)
    def alone(self: Any, *given: Any, **options: Any) -> Any:
        with self._change:
            return call(self, *given, **options)
    return alone


class Frame(NamedTuple):
    """What render() gives; None is what was left out.

    color is (height, width, 3) bytes; depth (height, width) float32, metres along the camera's axis;
    ids (height, width, 2) int32, object and triangle, -1 where there is nothing; normals
    (height, width, 3) float32, unit vectors in the world, zero where there is nothing.
    """

    color: Bytes | None
    depth: Floats | None
    ids: Integers | None
    normals: Floats | None

    def picture(self) -> Picture:
        """What there is of colour, depth (near is bright), objects (a colour for each) and normals,
        side by side: notebooks show it."""
        parts: list[Any] = [] if self.color is None else [self.color[..., :3]]
        if self.depth is not None:
            seen = np.isfinite(self.depth)
            low, high = (self.depth[seen].min(), self.depth[seen].max()) if seen.any() else (0, 1)
            near = (high - np.where(seen, self.depth, high)) / max(high - low, 1e-30)
            grey = np.where(seen, 40 + 215 * near, 0)
            parts.append(np.repeat(grey[..., None], 3, 2))
        if self.ids is not None:
            number = self.ids[..., :1].astype(np.int64) + 1
            parts.append(np.where(number > 0, 64 + number * (67, 113, 151) % 192, 0))
        if self.normals is not None:
            parts.append(127.5 + 127.5 * self.normals)
        if not parts:
            raise Error("frame has no arrays")
        rgb = np.concatenate([np.asarray(part, np.uint8) for part in parts], 1)
        return Picture(np.concatenate([rgb, np.full_like(rgb[..., :1], 255)], 2))

    def _repr_png_(self) -> bytes:
        return self.picture().png()


class _World:
    """Tells a Renderer's shapes from those of others, in copies too."""


class Shape:
    """A mesh of a renderer, of which any number of objects are instances."""

    def __init__(self, number: int, records: Array, world: _World) -> None:
        """Keeps its number and what its surfaces look like; only a Renderer makes shapes."""
        self.number, self.records, self.world = number, records, world
        self.textures: list[int] = []    # those that came with it
        self.source: tuple[Any, ...] = ()    # what update() makes it of; (): it was removed
        self.quick: tuple[Array, int] | None = None    # faces and vertices, where these alone can be moved

    @property
    def count(self) -> int:
        """Its triangles."""
        return int(self.records["count"].sum())


class _Number(int):
    """A number that belongs to one Renderer: pickled, and in arithmetic, a plain int."""

    renderer: Renderer

    def __new__(cls, number: int, renderer: Renderer) -> Any:
        """Only a Renderer makes them."""
        made = super().__new__(cls, number)
        made.renderer = renderer
        return made

    def __reduce__(self) -> Any:
        return int, (int(self),)

    def __copy__(self) -> Any:
        return self

    def __deepcopy__(self, known: Any) -> Any:
        return self


class Texture(_Number):
    """A texture of a Renderer, and its number."""


class Solid(_Number):
    """An object of a Renderer, and its number, which ids have: it can be changed by either."""

    @property
    def pose(self) -> Array:
        """From the object to the world, 4 x 4.  Assigned, it moves: as a matrix or as a place."""
        record = self.renderer._records_of(self)[0]
        m = np.eye(4)
        m[:3, :3], m[:3, 3] = record["turn"], record["place"]
        return m

    @pose.setter
    def pose(self, value: Any) -> None:
        m = self.pose
        if np.shape(value) == (3,):
            m[:3, 3] = arguments.doubles("pose", value, (3,), finite=True)
        else:
            m = value
        self.renderer.pose(self, m)

    @property
    def color(self) -> Any:
        """As add() and change() take it."""
        return self.renderer._options("number", self).get("color", "white")

    @color.setter
    def color(self, value: Any) -> None:
        self.renderer.change(self, color=value)

    def change(self, **options: Any) -> None:
        """As Renderer.change."""
        self.renderer.change(self, **options)

    def show(self, visible: bool = True) -> None:
        """Hides it, or shows it again."""
        self.renderer.show(self, visible)

    def remove(self) -> None:
        """Takes it away; its number is not given again."""
        self.renderer.remove(self)


class _Scene:
    """The meshes and textures in the library, and scratch memory that threads take and give back."""

    def __init__(self) -> None:
        self.handle = library.python_scene_open()
        self.free: list[int] = []
        if not self.handle:
            raise MemoryError("memory is not enough for a scene")

    def take(self) -> int:
        """Scratch memory for one picture."""
        try:
            return self.free.pop()
        except IndexError:
            handle = library.python_renderer_open()
        if not handle:
            raise MemoryError("memory is not enough for a picture")
        return int(handle)

    def rest(self) -> None:
        """Frees the scratch memory that no thread has."""
        while getattr(self, "free", None):
            library.python_renderer_close(self.free.pop())

    def records(self, number: int = -1) -> Array:
        """Copies of the records of an object, or of all."""
        room = 1 if number >= 0 else 64
        while True:
            found = np.zeros(room, SOLID)
            count = library.python_scene_records(self.handle, number, pointer(found), room)
            if count <= room:
                return found[:count]
            room = count

    def __del__(self) -> None:
        """Frees it all."""
        self.rest()
        if getattr(self, "handle", None):
            library.python_scene_close(self.handle)


class Renderer:
    """One scene, and pictures of it from any number of cameras.

        r = shade_h.Renderer(240, 320)
        r.add("plane", color="#808080")
        ball = r.add("sphere", 0.5, at=(0, 0, 0.5), color="red")
        frame = r.render(shade_h.Camera.look_at((3, -3, 2)))

    Objects can be moved, changed and removed, and so can shapes and textures: one Renderer serves any
    number of scenes.  Threads may draw and change it at the same time: a picture shows it as it was
    when it began.  A Renderer can be pickled, and lives on in a forked process.
    """

    def __init__(self, height: int, width: int, *, samples: int = 1, srgb: bool = True,
                 tolerance: float = 0.25) -> None:
        """samples, 1 to 8, are those of colour along the edge of a pixel.  With srgb=False colours
        are lit as they are stored, as OpenGL did.  Round shapes lie within tolerance pixels."""
        self.height = arguments.integer("height", height, 1, 16384)
        self.width = arguments.integer("width", width, 1, 16384)
        self.samples = arguments.integer("samples", samples, 1, 8)
        if max(self.height, self.width) * self.samples > 16384:
            raise Error(f"height and width times samples must be at most 16384, not "
                        f"{max(self.height, self.width) * self.samples}")
        self.srgb = arguments.flag("srgb", srgb)
        self.tolerance = arguments.number("tolerance", tolerance, 1e-3, 16)
        self._open()
        self._world = _World()
        self._meshes: dict[int, tuple[Any, ...]] = {}      # what they were made of, by their numbers
        self._textures: dict[int, tuple[Any, ...]] = {}    # where the library has them, and as what
        self._moved: dict[int, tuple[Any, ...]] = {}       # those whose vertices are others by now
        self._next_texture = 0
        self._shown: dict[int, tuple[str | Shape, dict[str, Any]]] = {}    # objects, as add() took them
        self._owned: set[int] = set()    # textures that came with shapes
        self._lit: tuple[Any, ...] = ()
        self._behind: tuple[Any, ...] = ()
        self._set_behind()
        self.light([Light.directional((-0.5, 1, -1.2), (0.75, 0.75, 0.75))], (0.25, 0.25, 0.25))

    def _open(self) -> None:
        self._scene, self._change = _Scene(), threading.RLock()
        _alive.add(self)

    # ---- what is drawn

    @_changes
    def mesh(self, vertices: object, faces: object = None, *, normals: object = "auto",
             uv: object = None, colors: object = None) -> Shape:
        """A mesh for add(): arrays as for shade_h.Mesh, of which uv needs a texture in add(); or a
        Mesh, as load() gives it, or a mesh of another library, as render() takes it, with the materials, colours, pictures, transparency and holes of its
        surfaces."""
        made = self._made_of(vertices, faces, normals, uv, colors)
        return self._shape(made, (_is_whole(vertices, faces), *map(_own, (faces, normals, uv, colors))), None)

    @staticmethod
    def _made_of(vertices: object, faces: object, normals: object, uv: object, colors: object) -> Mesh:
        if isinstance(vertices, Mesh):
            return vertices
        if faces is None and not isinstance(vertices, (np.ndarray, list, tuple)):
            if uv is not None or not (isinstance(normals, str) and normals == "auto") or colors is not None:
                raise Error("normals, uv and colors go with vertices and faces, not with a mesh of another library")
            return as_mesh(vertices)
        texture = None if uv is None else np.full((1, 1, 3), 255, np.uint8)
        try:
            return Mesh(vertices, faces, normals=normals, color=colors, uv=uv, texture=texture)
        except Error as why:    # the argument has another name here
            raise Error(re.sub(r"^color\b", "colors", str(why))) from None

    def _shape(self, made: Mesh, source: tuple[Any, ...], number: int | None) -> Shape:
        if not np.isfinite(made.positions).all():
            raise Error("vertices must hold finite numbers that fit float32")
        colors = made.colors
        if colors is not None and not self.srgb:
            colors = display(colors)
        shape = self._keep_mesh(number, made.positions, made.normals, made.uv, colors, made.indices,
                                origin=made.origin)
        shape.source = source
        kind = source[2]
        flat = isinstance(kind, str) and kind == "flat"
        if not source[0] and made.normals is not None and (flat or made.positions is made.local):
            shape.quick = made.faces, len(made.local)
        pieces = [piece for piece in made.pieces if piece.count]
        if source[0] and pieces:
            known: dict[Any, int] = {}
            shape.records = np.repeat(shape.records, len(pieces))
            for record, piece in zip(shape.records, pieces):
                self._dress(record, piece, made.color, known)
            shape.textures = list(known.values())
            self._owned.update(shape.textures)
        return shape

    def _dress(self, record: Any, piece: Any, color: Any, known: dict[Any, int]) -> None:
        """What a piece of a Mesh looks like; known are the textures that its others have."""
        surface, material = piece.surface, piece.surface.material
        record["first"], record["count"] = piece.first, piece.count
        for name, (picture, colors) in piece.pictures.items():
            if picture is None:
                continue
            key = picture.shape, picture.tobytes(), surface.wrap, surface.squares, colors
            if key not in known:
                known[key] = self._make_texture(picture, surface.wrap, surface.squares, None, colors)
            record[name] = 1 + self._textures[known[key]][0]
        def shown(rgb: Any) -> Any:
            return rgb if self.srgb else display(rgb)

        if material is not None:
            color = material.diffuse
            record["specular"], record["glow"] = shown(material.specular), shown(material.emission)
            record["shininess"] = material.shininess
        if color is not None:
            record["rgba"][:3] = shown(color)
        if surface.blend:
            record["rgba"][3] = surface.opacity
            record["flags"] |= _BLENDED if record["texture"] else 0
        record["cutoff"] = surface.cutoff
        record["strength"], record["glow_factor"] = piece.strength, shown(piece.glow_factor)
        record["flags"] |= (_HEIGHTS if piece.heights else 0) | (_UNLIT if surface.unlit else 0)

    def _keep_mesh(self, number: int | None, positions: Any, normals: Any, uv: Any, colors: Any,
                   indices: Any, origin: Any = (0.0, 0.0, 0.0)) -> Shape:
        """Gives the library a mesh whose positions count from an origin, and keeps copies."""
        kept: list[Any] = [None if a is None else np.array(a, np.float32, order="C")
                           for a in (positions, normals, uv, colors)]
        corners, origin = np.array(indices, np.uint32, order="C"), np.array(origin, np.float64)
        mesh = NativeMesh()
        for name, array in zip(("positions", "normals", "texcoords", "colors", "indices"),
                               (*kept, corners)):
            setattr(mesh, name, pointer(array))
        mesh.vertex_count, mesh.index_count = len(kept[0]), corners.size
        if number is None:
            number = _free(self._meshes)
        if not library.python_scene_mesh(self._scene.handle, number, ctypes.byref(mesh), 0, pointer(origin)):
            raise MemoryError("memory is not enough for the mesh")
        return self._shape_of(number, corners.size // 3, (*kept, corners, origin))

    def _shape_of(self, number: int, triangles: int, kept: tuple[Any, ...]) -> Shape:
        self._meshes[number] = kept
        self._moved.pop(number, None)
        records = _PLAIN.copy()
        records["mesh"], records["count"] = number, triangles
        return Shape(number, records, self._world)

    @_changes
    def height_field(self, heights: object, half: Sequence[float]) -> Shape:
        """Ground for add(): heights is (rows, columns), rows along y, over x from -half[0] to half[0]
        and y from -half[1] to half[1]."""
        return self._ground(None, heights, half)

    def _ground(self, number: int | None, heights: object, half: Sequence[float]) -> Shape:
        z = arguments.floats("heights", heights, (None, None), finite=True)
        rows, columns = z.shape
        if min(rows, columns) < 2:
            raise Error(f"heights must have two rows and columns at least, not {z.shape}")
        a, b = (arguments.number(f"half[{i}]", x, 1e-30, 1e30)
                for i, x in enumerate(arguments.doubles("half", half, (2,))))
        number = _free(self._meshes) if number is None else number
        shape = self._shape_of(number, self._heights(number, z, a, b), (z, (a, b)))
        shape.source = (_own(half),)
        return shape

    def _heights(self, number: int, z: Floats, a: float, b: float, scale: float = 1.0, base: float = -1.0) -> int:
        """Puts ground in the place of a mesh, and returns its triangles; with a base it has sides down to that."""
        h = Heights(pointer(z), *z.shape, (ctypes.c_double * 2)(a, b), scale, base, int(base >= 0), 0)
        count: int = library.python_scene_heights(self._scene.handle, number, ctypes.byref(h))
        if not count:
            raise MemoryError("memory is not enough for the mesh")
        return count

    @_changes
    def update(self, shape: Shape, vertices: object, faces: object = None, *, normals: object = None,
               uv: object = None, colors: object = None) -> None:
        """Gives a shape other vertices, and what else is not None; the rest stays as mesh() was given
        it.  A shape of a Mesh takes another Mesh, ground takes heights.  Its objects show it."""
        self._known(shape)
        if faces is None and uv is None and colors is None and self._move(shape, vertices, normals):
            return
        if not library.python_scene_hold(self._scene.handle):
            raise MemoryError("memory is not enough for the mesh")
        try:
            self._put_shape(shape, vertices, (faces, normals, uv, colors))
        finally:
            library.python_scene_done(self._scene.handle)

    def _move(self, shape: Shape, vertices: Any, normals: Any) -> bool:
        """Moves the vertices of a shape, where nothing else of it changes."""
        kind = shape.source[2] if normals is None and len(shape.source) > 2 else normals
        if shape.quick is None or isinstance(kind, str) != isinstance(shape.source[2], str) or \
                isinstance(kind, str) and kind != shape.source[2]:
            return False
        faces, rows = shape.quick
        exact = arguments.array("vertices", vertices, (None, 3))
        if len(exact) != rows:
            return False
        local, origin = counted(exact, faces)
        at = np.ascontiguousarray(local, np.float32)
        moved = Moved(pointer(at), None, pointer(faces), len(at), faces.size,
                      2 if not isinstance(kind, str) else int(kind == "smooth"), 0, (ctypes.c_double * 3)(*origin))
        if moved.normals == 2:
            given = arguments.floats("normals", kind, at.shape)
            moved.given = pointer(given)
        done = library.python_scene_deform(self._scene.handle, shape.number, ctypes.byref(moved))
        if done == -2:
            raise Error("vertices must hold finite numbers that fit float32")
        if done == 0:
            raise MemoryError("memory is not enough for the mesh")
        if done > 0:
            self._moved[shape.number] = shape, np.array(vertices)
            if normals is not None:
                shape.source = (*shape.source[:2], _own(normals), *shape.source[3:])
        return bool(done > 0)

    def _put_shape(self, shape: Shape, vertices: object, others: tuple[Any, ...]) -> None:
        if len(shape.source) == 1:
            made = self._ground(shape.number, vertices, shape.source[0])
        else:
            given = [old if new is None else _own(new) for new, old in zip(others, shape.source[1:])]
            if shape.source[0] and not _is_whole(vertices, given[0]):
                raise Error("vertices must be a Mesh: the shape was made of one")
            made = self._shape(self._made_of(vertices, *given), (_is_whole(vertices, given[0]), *given), shape.number)
        gone = shape.textures
        shape.records, shape.textures, shape.source, shape.quick = \
            made.records, made.textures, made.source, made.quick
        for number in [n for n, (of, _) in self._shown.items() if of is shape]:
            self._put(number, self._dressed(number, *self._shown[number]))
        self._drop(gone)

    @_changes
    def texture(self, picture: object, wrap: tuple[str, str] = ("repeat", "repeat"),
                squares: bool = False) -> int:
        """A picture for add(): (h, w, 3 or 4), or (6, h, h, 3 or 4) for a cube, whose faces are +x,
        -x, +y, -y, +z, -z as in OpenGL.  Mipmaps are made of it.  wrap and squares are those of
        Surface."""
        made: Texture = Texture(self._make_texture(picture, wrap, squares, None), self)
        return made

    def _make_texture(self, picture: object, wrap: tuple[str, str], squares: bool,
                      number: int | None, colors: bool = True) -> int:
        arguments.dimensions("picture", picture)
        given = np.asarray(picture)
        faces = 6 if given.ndim == 4 else 1
        if faces == 6:
            if given.shape[0] != 6 or given.shape[1] != given.shape[2]:
                raise Error(f"picture must have the shape (6, h, h, 3 or 4), not {given.shape}")
            given = given.reshape(-1, *given.shape[2:])
        rgba = arguments.texture("picture", given)
        u, v = arguments.wraps(wrap)
        return self._keep_texture(number, rgba, faces, u, v, arguments.flag("squares", squares), colors)

    def _keep_texture(self, number: int | None, rgba: Bytes, faces: int, u: int = 0,
                      v: int = 0, squares: bool = False, colors: bool = True) -> int:
        height, width = rgba.shape[:2]
        image = Image(pointer(rgba), width, height // faces, faces, self.srgb and colors, u, v,
                      squares)
        slot = _free([kept[0] for kept in self._textures.values()]) if number is None else \
            self._textures[number][0]
        if not library.python_scene_texture(self._scene.handle, slot, ctypes.byref(image)):
            raise MemoryError("memory is not enough for the texture")
        if number is None:
            number = self._next_texture
            self._next_texture += 1
        self._textures[number] = slot, rgba, faces, u, v, squares, colors
        return number

    @_changes
    def update_texture(self, number: int, picture: object,
                       wrap: tuple[str, str] = ("repeat", "repeat"), squares: bool = False) -> None:
        """Puts another picture in the place of a texture, as texture() takes it; objects and a sky that
        have the texture show it."""
        self._texture_number("number", number)
        if (arguments.dimensions("picture", picture) == 4) != (self._textures[number][2] == 6):
            raise Error(f"picture: texture {number} is {'' if self._textures[number][2] == 6 else 'no '}"
                        "cube, and the picture is not")
        self._make_texture(picture, wrap, squares, number)

    def _texture_number(self, name: str, number: object) -> int:
        got = arguments.integer(name, number, 0, MOST)
        self._mine(name, "texture", number)
        if got not in self._textures:
            raise Error(f"{name}: there is no texture {got}")
        return got

    def _mine(self, name: str, what: str, number: object) -> None:
        if isinstance(number, _Number) and number.renderer is not self:
            raise Error(f"{name}: {what} {int(number)} is of another Renderer")

    def checker(self, one: object = "#5a6e82", other: object = "#8fa3b5") -> Any:
        """A texture of 2 x 2 squares, which repeats."""
        squares = np.zeros((64, 64, 3), np.uint8)
        odd = (np.arange(64)[:, None] < 32) ^ (np.arange(64)[None] < 32)
        for name, color, where in (("one", one, odd), ("other", other, ~odd)):
            arguments.color(name, color)    # refuses what is none
            shown = arguments.displayed("color", color)[:3]
            squares[where] = shown if shown.dtype.kind in "iu" else np.round(255 * shown)
        return self.texture(squares)

    def _color(self, name: str, value: object) -> list[float]:
        if self.srgb:
            return list(arguments.color(name, value))
        rgb = arguments.displayed(name, value)
        arguments.linear(name, rgb[None])    # refuses what is out of range
        return [float(x) for x in rgb[:3] / (255 if rgb.dtype.kind in "iu" else 1)]

    @_changes
    def add(self, shape: str | Shape, size: object = None, at: Sequence[float] = (0, 0, 0),
            pose: object = None, *, color: object = None, alpha: float | None = None,
            specular: object = None, shininess: float | None = None, emission: float | None = None,
            texture: int | None = None, repeat: Sequence[float] = (1, 1), two_sided: bool = False,
            casts_shadow: bool = True) -> Solid:
        """Adds an object and returns it: a Solid, which is its number, that ids have, and has pose,
        color, change(), show() and remove().

        shape is a Shape of mesh() or height_field(), of which size is the scale, or one of "plane"
        (half its sides; none: endless), "sphere" (radius), "ellipsoid" (radii), "capsule" and
        "cylinder" (radius, half the length along z; a capsule's without its ends) and "box" (half its
        sides).  pose is 4 x 4, or at the place alone.  color and alpha, white and 1 without a word,
        multiply those of the shape; specular, a number or a colour, shininess, emission, which
        multiplies the colour, and texture take the place of what the shape has.  alpha below 1 blends
        over what is behind; such objects are not in depth, ids and normals.  repeat are texture
        repeats: of uv, or a metre.
        """
        if isinstance(shape, Shape):
            self._known(shape)
        else:
            arguments.choice("shape", shape, list(SHAPES))
        options = {name: value for name, value in (
            ("color", color), ("alpha", alpha), ("specular", specular), ("shininess", shininess),
            ("emission", emission), ("texture", texture), ("repeat", repeat),
            ("two_sided", two_sided), ("casts_shadow", casts_shadow)) if value is not None}
        options = {name: _own(value) for name, value in options.items()}
        records = self._records(shape, options)
        records["size"] = self._size(shape, size)
        if pose is None:
            records["place"] = arguments.doubles("at", at, (3,), True)
        elif np.any(at):
            raise Error("at does not go with pose, which has a place")
        else:
            m = arguments.rigid("pose", pose)
            records["place"], records["turn"] = m[:3, 3], m[:3, :3]
        number = library.python_scene_add(self._scene.handle, pointer(records), len(records))
        if number < 0:
            raise MemoryError("memory is not enough for the object")
        self._shown[number] = shape, options
        made: Solid = Solid(number, self)
        return made

    @_changes
    def change(self, number: int, *, size: object = None, **options: Any) -> None:
        """Changes what is given of an object: size, color, alpha, specular, shininess, emission,
        texture, repeat, two_sided and casts_shadow, as add() takes them.  What is None is as it would
        be without a word."""
        old, shape = self._options("number", number), self._shown[number][0]
        for name in options:
            arguments.choice("option", name, ["color", "alpha", "specular", "shininess", "emission",
                                              "texture", "repeat", "two_sided", "casts_shadow"])
        new = {name: _own(value) for name, value in {**old, **options}.items() if value is not None}
        records = self._dressed(number, shape, new)
        if size is not None:
            records["size"] = self._size(shape, size)
        self._put(number, records)
        self._shown[int(number)] = shape, new

    def _put(self, number: int, records: Array) -> None:
        if library.python_scene_put(self._scene.handle, number, pointer(records), len(records)) == 0:
            raise MemoryError("memory is not enough for the object")

    def _dressed(self, number: int, shape: str | Shape, options: dict[str, Any]) -> Array:
        """The records of an object with a shape and options as they are by now, where it is."""
        records, old = self._records(shape, options), self._records_of(number)[0]
        for name in ("id", "size", "turn", "place"):
            records[name] = old[name]
        records["flags"] |= old["flags"] & _HIDDEN
        return records

    def _records(self, shape: str | Shape, options: dict[str, Any]) -> Array:
        """The records of an object that is not in its place yet."""
        if isinstance(shape, Shape):
            records = shape.records.copy()
        else:
            records = _PLAIN.copy()
            records["kind"] = _KINDS[shape]
        rgb, own = self._clear(options.get("color", "white"))
        records["rgba"][:, :3] *= np.asarray(rgb, np.float32)
        records["rgba"][:, 3] *= own * arguments.number("alpha", options.get("alpha", 1), 0, 1)
        for name in ("specular", "shininess", "emission"):
            value: Any = options.get(name)
            if name == "specular" and (arguments.dimensions(name, value) == 1 or isinstance(value, str)):
                records[name] = self._color(name, value)
            elif value is not None:
                records[name] = arguments.number(name, value, 0, 1e6)
        if "texture" in options:
            number = self._texture_number("texture", options["texture"])
            records["texture"] = 1 + self._textures[number][0]
        records["repeat"] = arguments.floats("repeat", options.get("repeat", (1, 1)), (2,), True)
        if arguments.flag("two_sided", options.get("two_sided", False)):
            records["flags"] |= _TWO_SIDED
        if not arguments.flag("casts_shadow", options.get("casts_shadow", True)):
            records["flags"] |= _NO_SHADOW
        return records

    def _clear(self, color: object) -> tuple[list[float], float]:
        """A colour, and its alpha, 1 where it has none."""
        if isinstance(color, str):
            return self._color("color", color), 1.0
        got = arguments.displayed("color", color)
        own = float(got[3]) / (255 if got.dtype.kind in "iu" else 1) if len(got) == 4 else 1.0
        if not 0 <= own <= 1:
            raise Error(f"color must have an alpha from 0 to 1, or to 255 in whole numbers, not {own:g}")
        return self._color("color", got[:3]), own

    @staticmethod
    def _size(shape: str | Shape, size: object) -> Floats:
        given: object = size if isinstance(size, (list, tuple, range)) or isinstance(size, np.ndarray) and size.ndim else [size]
        if isinstance(shape, Shape):
            scale: Floats = np.ones(1, np.float32) if size is None else \
                arguments.floats("size", given, (None,), True)
            return arguments.floats("size", np.repeat(scale, 3) if len(scale) == 1 else scale, (3,), True)
        wanted = SHAPES[shape]
        if size is None and shape == "plane":
            return np.zeros(3, np.float32)
        if size is None:
            raise Error(f"size of a {shape} is missing")
        got = arguments.floats("size", given, (wanted,), True)
        if not (got > 0).all():
            raise Error(f"size of a {shape} must be positive, not {arguments.shown(size)}")
        full = {"sphere": [0, 0, 0], "capsule": [0, 0, 1], "cylinder": [0, 0, 1],
                "plane": [0, 1, 1]}.get(shape, [0, 1, 2])
        return np.asarray(got[full], np.float32)

    @property
    def objects(self) -> list[int]:
        """The numbers of all objects, in order."""
        return sorted(self._shown)

    def _options(self, name: str, number: object) -> dict[str, Any]:
        """What add() and change() were given of an object."""
        got = arguments.integer(name, number, 0, MOST)
        self._mine(name, "object", number)
        if got not in self._shown:
            raise Error(f"{name}: there is no object {got}")
        return self._shown[got][1]

    def _records_of(self, number: object) -> Array:
        self._options("number", number)
        return self._scene.records(int(number))    # type: ignore[call-overload]

    def _known(self, shape: object) -> None:
        if not isinstance(shape, Shape) or shape.world is not self._world:
            raise Error("shape must be of this renderer")
        if not shape.source:
            raise Error("shape must be of this renderer: it was removed")

    @_changes
    def pose(self, number: int, pose: object) -> None:
        """Moves an object: 4 x 4, a rotation and a translation."""
        self._options("number", number)
        self._pose(arguments.rigid(f"pose of object {number}", pose)[None], [number])

    @_changes
    def poses(self, poses: object, numbers: Sequence[int] | None = None) -> None:
        """Moves the objects of numbers, or all in the order of their numbers: (n, 4, 4), a row for each;
        nothing moves where one is refused."""
        which = None if numbers is None else arguments.several("numbers", numbers)
        for i, number in enumerate(which or ()):
            self._options(f"numbers[{i}]", number)
        count = len(self._shown) if which is None else len(which)
        self._pose(arguments.doubles("poses", poses, (count, 4, 4)), which)

    def _pose(self, rows: Any, which: Any) -> None:
        numbers = None if which is None else np.array(which, np.int32)
        refused = library.python_scene_pose(self._scene.handle, pointer(numbers), pointer(rows), len(rows))
        if refused >= 0:
            raise Error(f"poses[{refused}] {arguments.NOT_RIGID}")
        if refused == -3:
            raise MemoryError("memory is not enough for the poses")

    @_changes
    def show(self, number: int, visible: bool = True) -> None:
        """Hides an object, or shows it again."""
        records = self._records_of(number)
        records["flags"] &= ~_HIDDEN
        records["flags"] |= 0 if arguments.flag("visible", visible) else _HIDDEN
        self._put(number, records)

    @_changes
    def remove(self, what: int | Shape) -> None:
        """Takes away an object by its number, which none is given again, or a shape that no object
        shows, with the textures that came with it.  Its memory is given back."""
        if not isinstance(what, Shape):
            self._options("what", what)
            self._put(what, _PLAIN[:0])
            del self._shown[what]
            return
        self._known(what)
        shown = [n for n, (shape, _) in self._shown.items() if shape is what]
        if shown:
            raise Error(f"what: object {shown[0]} shows the shape; remove that before")
        library.python_scene_mesh(self._scene.handle, what.number, None, 0, None)
        del self._meshes[what.number]
        self._moved.pop(what.number, None)
        what.source = ()
        self._drop(what.textures)

    @_changes
    def remove_texture(self, number: int) -> None:
        """Gives back the memory of a texture that no object and no sky shows.  Those of a shape go with
        it."""
        number = self._texture_number("number", number)
        whole = self._scene.records()
        shown = whole["id"][whole["texture"] == 1 + self._textures[number][0]]
        if len(shown) or number in self._owned or self._behind[:2] == (2, number):
            who = f"object {shown[0]}" if len(shown) else \
                "a shape" if number in self._owned else "the sky"
            raise Error(f"number: {who} has texture {number}")
        self._drop([number])

    def _drop(self, textures: list[int]) -> None:
        for number in textures:
            library.python_scene_texture(self._scene.handle, self._textures[number][0], None)
            del self._textures[number]
        self._owned.difference_update(textures)

    @_changes
    def clear(self) -> None:
        """Takes away all objects, shapes and textures, and gives back all memory; lamps and a
        background of one colour stay."""
        if not library.python_scene_hold(self._scene.handle):
            raise MemoryError("memory is not enough")
        try:
            self._set_records(_PLAIN[:0])
            for number in self._meshes:
                library.python_scene_mesh(self._scene.handle, number, None, 0, None)
            self._drop(list(self._textures))
            if self._behind[0] == 2:
                self._set_behind(background=self._behind[4])
        finally:
            library.python_scene_done(self._scene.handle)
        self._shown, self._meshes, self._moved, self._world = {}, {}, {}, _World()
        self._scene.rest()

    def _set_records(self, records: Array) -> None:
        if not library.python_scene_put_all(self._scene.handle, pointer(np.ascontiguousarray(records)),
                                        len(records)):
            raise MemoryError("memory is not enough for the objects")

    # ---- what it is lit by

    @_changes
    def light(self, lights: Sequence[Light], ambient: Sequence[float] = (0, 0, 0),
              shadow: int | Sequence[int] | None = None) -> None:
        """Up to 8 lamps, the ambient light, and the number or numbers of the lamps, directional or
        spots, that cast shadows."""
        lamps = lamps_of(lights)
        if len(lamps) > _LAMPS:
            raise Error(f"lights: at most {_LAMPS} lamps are drawn, not {len(lamps)}")
        shadows = 0
        one = shadow is None or not isinstance(shadow, (list, tuple, set, range, np.ndarray))
        for which in [shadow] * (shadow is not None) if one else list(shadow):  # type: ignore[arg-type]
            number = arguments.integer("shadow", which, 0, len(lamps) - 1)
            lamp = lamps[number]
            if lamp.position[3] != 0 and not any(lamp.spot_direction):
                raise Error(f"shadow: lights[{number}] is a point; directional lamps and spots can "
                            "cast shadows")
            shadows |= 1 << number
        made = (NativeLight * max(1, len(lamps)))(*(lamp.native() for lamp in lamps))
        places = np.array([lamp.position for lamp in lamps] or [(0.0,) * 4], np.float64)
        around = arguments.floats("ambient", ambient, (3,), finite=True)
        library.python_scene_light(self._scene.handle, made, pointer(places), len(lamps),
                                   pointer(around), shadows)
        self._lit = tuple(lamps), around.tolist(), [k for k in range(_LAMPS) if shadows >> k & 1]

    def _set_behind(self, sky: int = 0, texture: int = -1, low: Any = (0.0,) * 3,
                    high: Any = (0.0,) * 3, background: Any = (1.0,) * 4) -> None:
        """What is behind all objects, at once: of a texture its number."""
        colors = np.array([*background, *low, *high], np.float32)
        slot = self._textures[texture][0] if sky == 2 else -1
        library.python_scene_behind(self._scene.handle, sky, slot, pointer(colors))
        self._behind = sky, texture, low, high, background

    @_changes
    def background(self, color: object) -> None:
        """One colour behind all objects."""
        self._set_behind(background=(*self._color("color", color), 1.0))

    @_changes
    def sky(self, low: object = "#dfe8f0", high: object = "#4a7ab0") -> None:
        """A sky from the colour straight below to that straight above, +z."""
        self._set_behind(1, -1, self._color("low", low), self._color("high", high), self._behind[4])

    @_changes
    def sky_texture(self, texture: int) -> None:
        """A sky of a cube texture, whose +y is up (+z of the world), as in OpenGL."""
        number = self._texture_number("texture", texture)
        if self._textures[number][2] != 6:
            raise Error(f"texture {number} is no cube")
        self._set_behind(2, number, background=self._behind[4])

    # ---- pictures

    def frame(self, color: bool = True, depth: bool = True, ids: bool = True,
              normals: bool = False, pictures: int | None = None) -> Frame:
        """New arrays for render(out=), or for so many pictures of render_batch(out=)."""
        for name, wanted in (("color", color), ("depth", depth), ("ids", ids), ("normals", normals)):
            arguments.flag(name, wanted)
        count = () if pictures is None else (arguments.integer("pictures", pictures, 0, 2**31 - 1),)
        size = (*count, self.height, self.width)
        return Frame(np.empty((*size, 3), np.uint8) if color else None,
                     np.empty(size, np.float32) if depth else None,
                     np.empty((*size, 2), np.int32) if ids else None,
                     np.empty((*size, 3), np.float32) if normals else None)

    def render(self, camera: Camera, out: Frame | None = None, *, normals: bool = False,
               solid: bool = False, empty_depth: float = float("inf")) -> Frame:
        """Draws what a camera sees, into the arrays of out or into new ones.

        out is a Frame whose arrays are filled; those that are None are left out.  color may have 4
        channels.  depth is empty_depth where there is nothing.  With solid=True alpha is ignored.
        """
        seen = self._seen("camera", camera)
        frame = self.frame(normals=normals) if out is None else self._checked(out)
        return self._draw(frame, seen, solid, empty_depth)

    def _seen(self, name: str, camera: object) -> tuple[Any, ...]:
        """View, projection, near, far and whether it is parallel, of a camera for pictures of this
        size."""
        if not isinstance(camera, Camera):
            raise Error(f"{name} must be a shade_h.Camera, not {arguments.shown(camera)}")
        return camera.seen(self.width, self.height, name)

    def render_batch(self, cameras: Sequence[Camera] | Camera, poses: object = None,
                     out: Frame | None = None, *, normals: bool = False, solid: bool = False,
                     empty_depth: float = float("inf"), threads: int = 0) -> Frame:
        """A picture for each camera, as render() draws it, in one Frame whose arrays begin with their
        number; by threads, 0 for one a core.

        poses, (pictures, objects, 4, 4), are those of all objects in the order of their numbers, for
        each picture its own; the objects stay where they were.  One camera then serves all.
        """
        moved = None
        if poses is not None:
            moved = arguments.doubles("poses", poses, (None, len(self._shown), 4, 4))
        seen = [cameras] * (1 if moved is None else len(moved)) if isinstance(cameras, Camera) \
            else arguments.several("cameras", cameras)
        if moved is not None and len(moved) != len(seen):
            raise Error(f"poses must have a row for each of {len(seen)} cameras, not {len(moved)}")
        shots = [self._seen(f"cameras[{i}]", camera) for i, camera in enumerate(seen)]
        if moved is not None:
            bad = library.python_not_rigid(pointer(moved), moved.shape[0] * moved.shape[1])
            if bad >= 0:
                raise Error(f"poses[{bad // moved.shape[1]}][{bad % moved.shape[1]}] {arguments.NOT_RIGID}")
        frame = self.frame(normals=normals, pictures=len(seen)) if out is None else \
            self._checked(out, (len(seen),))
        packed = b"".join(
            self._shot(Frame(*(None if array is None else array[i] for array in frame)), shot, solid,
                       empty_depth, poses=None if moved is None else moved[i])
            for i, shot in enumerate(shots))
        count = arguments.integer("threads", threads, 0, 256) or os.cpu_count() or 1
        scratch = [self._scene.take() for _ in range(max(1, min(count, len(seen), 256)))]

        def draw(stop: ctypes.c_int) -> int:
            handles = (ctypes.c_void_p * len(scratch))(*scratch)
            drawn: int = library.python_renderer_draw(
                handles, len(scratch), self._scene.handle, packed, len(seen), ctypes.addressof(stop))
            self._scene.free += scratch
            del kept[:]
            return drawn

        kept = [frame, moved]
        check(interruptible(draw), "camera" if moved is None else "poses or cameras")
        return frame

    def _shot(self, frame: Frame, seen: tuple[Any, ...], solid: bool, empty_depth: float, objects: Array | None = None,
              poses: Array | None = None) -> bytes:
        """A picture as the library is asked for it; objects None: those of the scene.  seen is what
        Camera.seen() gives: view and projection by columns, near, far, whether it is parallel."""
        view, projection, near, far, parallel = seen
        return SHOT.pack(
            self.width, self.height, self.samples, 3 if frame.color is None else frame.color.shape[2],
            self.srgb, arguments.flag("solid", solid), parallel, 0 if objects is None else len(objects),
            0 if poses is None else len(poses), near, far, _float("empty_depth", empty_depth),
            self.tolerance, 0, *view, *projection, pointer(objects) or 0, pointer(poses) or 0,
            *(pointer(array) or 0 for array in frame))

    def _draw(self, frame: Frame, seen: tuple[Any, ...], solid: bool, empty_depth: float,
              objects: Array | None = None) -> Frame:
        shot = self._shot(frame, seen, solid, empty_depth, objects)
        scratch = ctypes.c_void_p(self._scene.take())
        try:
            check(library.python_renderer_draw(ctypes.byref(scratch), 1, self._scene.handle, shot, 1,
                                               None), "camera")
        finally:
            self._scene.free.append(int(scratch.value or 0))
        return frame

    def _checked(self, out: object, pictures: tuple[int, ...] = ()) -> Frame:
        if not isinstance(out, Frame):
            raise Error(f"out must be a shade_h.Frame, not {arguments.shown(out)}")
        size = (*pictures, self.height, self.width)
        if out.color is not None:
            channels = np.shape(out.color)[-1:] == (4,)
            arguments.into("out.color", out.color, (*size, 4 if channels else 3), np.uint8)
        for name, array, shape, kind in (("depth", out.depth, size, np.float32),
                                         ("ids", out.ids, (*size, 2), np.int32),
                                         ("normals", out.normals, (*size, 3), np.float32)):
            if array is not None:
                arguments.into(f"out.{name}", array, shape, kind)
        return out

    # ---- other processes

    @_changes
    def __getstate__(self) -> dict[str, Any]:
        """All but what the library holds."""
        for shape, vertices in list(self._moved.values()):
            self._put_shape(shape, vertices, (None, None, None, None))
        state = {k: v for k, v in self.__dict__.items() if k not in ("_scene", "_change")}
        next_object = library.python_scene_next(self._scene.handle, 0)
        return {**state, "records": self._scene.records(), "next_object": next_object}

    def __setstate__(self, state: dict[str, Any]) -> None:
        """Gives the meshes, textures and objects to the library again."""
        records, next_object = state.pop("records"), state.pop("next_object")
        self.__dict__.update(state)
        self._open()
        for number, mesh in list(self._meshes.items()):
            put: Any = self._keep_mesh if len(mesh) > 2 else self._ground
            put(number, *mesh)
        for number, texture in list(self._textures.items()):
            self._keep_texture(number, *texture[1:])
        self._set_records(records)
        library.python_scene_next(self._scene.handle, next_object)
        self.light(*self._lit)
        self._set_behind(*self._behind)


def _is_whole(vertices: object, faces: object) -> bool:
    """A Mesh, or a mesh of another library: it has its looks."""
    return isinstance(vertices, Mesh) or (faces is None and not isinstance(vertices, (np.ndarray, list, tuple)))


def _own(value: Any) -> Any:
    """A copy of what the caller may change afterwards."""
    if isinstance(value, np.ndarray):
        return value.copy()
    return copy.deepcopy(value) if isinstance(value, (list, bytearray)) else value


def _float(name: str, value: object) -> float:
    """Any number, infinity and NaN too, as a float has it."""
    try:
        return ctypes.c_float(value).value    # type: ignore[arg-type]
    except (TypeError, ValueError, OverflowError):
        raise Error(f"{name} must be a number, not {arguments.shown(value)}") from None


def _free(taken: Any) -> int:
    """The least number that is not taken."""
    number = 0
    while number in taken:
        number += 1
    return number
