"""Cameras for simulators, learners and graders: one scene, many pictures of colour, depth, numbers of
objects and normals."""
from __future__ import annotations

import ctypes
import os
from typing import Any, NamedTuple, Sequence

import numpy as np

from . import _arguments as arguments
from ._native import (SHOT, SOLID, Array, Bytes, Error, Floats, Integers, Light as NativeLight,
                      Mesh as NativeMesh, check, library, pointer)
from .annotate import display
from .camera import Camera
from .light import Light
from .mesh import WRAPS, Mesh
from .picture import Picture

#: The shapes that are made once for all scenes, and the numbers that their size is.
SHAPES = {"plane": 2, "sphere": 1, "ellipsoid": 3, "capsule": 2, "cylinder": 2, "box": 3}
_KINDS = {"mesh": 0, "plane": 1, "sphere": 2, "ellipsoid": 3, "capsule": 4, "cylinder": 5, "box": 6}
_HIDDEN, _TWO_SIDED, _NO_SHADOW = 1, 2, 4
_LAMPS = 8


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


class Shape:
    """A mesh of a renderer, of which any number of objects are instances."""

    def __init__(self, number: int, count: int, texture: int = -1, alpha: float = 1.0) -> None:
        """Keeps its number, and what its objects have without a texture and alpha of their own; only
        a Renderer makes shapes."""
        self.number, self.count, self.texture, self.alpha = number, count, texture, alpha


class _Scene:
    """The meshes and textures in the library, and scratch memory that threads take and give back."""

    def __init__(self) -> None:
        self.handle = library.python_scene_open()
        self.free: list[int] = []
        self.process = os.getpid()
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

    def __del__(self) -> None:
        """Frees it all."""
        for handle in getattr(self, "free", ()):
            library.python_renderer_close(handle)
        if getattr(self, "handle", None):
            library.python_scene_close(self.handle)


def _range_of(projection: Array) -> tuple[float, float, bool]:
    """near, far and whether the projection is parallel, of a matrix of OpenGL."""
    p = projection
    parallel = bool(p[3, 3] != 0)
    if parallel:
        if not p[2, 2]:
            raise Error("camera: its projection has no depth")
        near, far = (p[2, 3] + 1) / p[2, 2], (p[2, 3] - 1) / p[2, 2]
        if p[3, 2] or not near < far:
            raise Error("camera: its projection must be that of OpenGL, with near before far")
        return float(near), float(far), True
    a, b = p[2, 2] / -p[3, 2], p[2, 3] / -p[3, 2]
    near = b / (a - 1) if a != 1 else 0.0
    far = b / (a + 1) if a < -1 else np.inf
    if not 0 < near < far:
        raise Error("camera: its projection must be that of OpenGL, with 0 < near < far")
    return float(near), float(min(far, 3e30)), False


class Renderer:
    """One scene, and pictures of it from any number of cameras.

        r = shade_h.Renderer(240, 320)
        r.add("plane", color="#808080")
        ball = r.add("sphere", 0.5, at=(0, 0, 0.5), color="red")
        frame = r.render(shade_h.Camera.look_at((3, -3, 2)))

    Threads may draw at the same time; objects, lights and shapes are changed between pictures.  A
    Renderer can be pickled, and lives on in a forked process.
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
        self._scene = _Scene()
        self._made: list[tuple[Any, ...]] = []
        self._meshes = self._textures = 0
        self._objects = np.zeros(16, SOLID)
        self._count = 0
        self._lights: list[Light] = []
        self._lamps: Any = None
        self._shadow = -1
        self._ambient: tuple[float, ...] = (0.0, 0.0, 0.0)
        self._background: tuple[float, ...] = (1.0, 1.0, 1.0, 1.0)
        self._sky: tuple[int, int, Any, Any] = (0, -1, (0.0, 0.0, 0.0), (0.0, 0.0, 0.0))
        self.light([Light.directional((-0.5, 1, -1.2), (0.75, 0.75, 0.75))], (0.25, 0.25, 0.25))

    # ---- what is drawn

    def mesh(self, vertices: object, faces: object = None, *, normals: object = "auto",
             uv: object = None, colors: object = None) -> Shape:
        """A mesh for add(): arrays as for shade_h.Mesh, of which uv needs a texture in add(); or a
        Mesh, as load() gives it, with its colours and its texture.  An object has one texture: of a
        mesh with several, or with one on a part of it, each surface must be a mesh of its own."""
        if isinstance(vertices, Mesh):
            made = vertices
        else:
            texture = None if uv is None else np.full((1, 1, 3), 255, np.uint8)
            made = Mesh(vertices, faces, normals=normals, color=colors, uv=uv, texture=texture)
        pieces = [piece for piece in made.pieces if piece.count]
        maps = [piece.texture for piece in pieces]
        if len({None if m is None else (m.shape, m.tobytes(), piece.surface.wrap)
                for m, piece in zip(maps, pieces)}) > 1:
            raise Error(f"vertices: the mesh has {len(maps)} surfaces with textures of their own, and "
                        "an object one texture: make a mesh of each")
        positions = np.ascontiguousarray(made.positions + made.origin.astype(np.float32))
        if not np.isfinite(positions).all():
            raise Error("vertices must hold finite numbers that fit float32")
        indices = np.ascontiguousarray(made.indices, np.uint32)
        rows: list[Any] = [positions, made.normals, made.uv, made.colors]
        tints = [piece.surface.material.diffuse if piece.surface.material is not None else made.color
                 for piece in pieces]
        if any(tint is not None for tint in tints):
            rows, indices = self._tinted(rows, indices, pieces, tints)
        if rows[3] is not None and not self.srgb:
            rows[3] = display(rows[3])
        shape = self._keep_mesh(rows[0], rows[1], rows[2], rows[3], indices)
        if isinstance(vertices, Mesh) and pieces:
            shape.texture = -1 if maps[0] is None else self.texture(maps[0], pieces[0].surface.wrap)
            shape.alpha = float(pieces[0].surface.opacity) if len(pieces) == 1 else 1.0
        return shape

    @staticmethod
    def _tinted(rows: list[Any], indices: Any, pieces: list[Any], tints: list[Any]) -> tuple[Any, Any]:
        """Vertices of each surface apart, with its colour."""
        used, at, colors, first = [], [], [], 0
        for piece, tint in zip(pieces, tints):
            own, index = np.unique(indices[piece.first:piece.first + piece.count], return_inverse=True)
            plain = np.array((1, 1, 1) if tint is None else tint, np.float32)
            color = np.broadcast_to(plain, (len(own), 3))
            used.append(own)
            at.append(index.reshape(-1, 3) + first)
            colors.append(color if rows[3] is None else color * rows[3][own])
            first += len(own)
        whole = np.concatenate(used)
        out = [None if row is None else row[whole] for row in rows[:3]]
        return [*out, np.concatenate(colors)], np.ascontiguousarray(np.concatenate(at), np.uint32)

    def _keep_mesh(self, positions: Any, normals: Any, uv: Any, colors: Any, indices: Any,
                   smooth: bool = False) -> Shape:
        positions, normals, uv, colors = (
            None if a is None else np.ascontiguousarray(a, np.float32)
            for a in (positions, normals, uv, colors))
        mesh = NativeMesh()
        for name, array in (("positions", positions), ("normals", normals), ("texcoords", uv),
                            ("colors", colors), ("indices", indices)):
            setattr(mesh, name, pointer(array))
        mesh.vertex_count, mesh.index_count = len(positions), indices.size
        if library.python_scene_mesh(self._scene.handle, ctypes.byref(mesh), int(smooth)) < 0:
            raise MemoryError("memory is not enough for the mesh")
        self._made.append(("mesh", positions, normals, uv, colors, indices, smooth))
        self._meshes += 1
        return Shape(self._meshes - 1, indices.size // 3)

    def height_field(self, heights: object, half: Sequence[float]) -> Shape:
        """Ground for add(): heights is (rows, columns), rows along y, over x from -half[0] to half[0]
        and y from -half[1] to half[1]."""
        z = arguments.floats("heights", heights, (None, None), finite=True)
        rows, columns = z.shape
        if min(rows, columns) < 2:
            raise Error(f"heights must have two rows and columns at least, not {z.shape}")
        a, b = arguments.doubles("half", half, (2,), finite=True)
        y, x = np.meshgrid(2 * b * np.arange(rows) / (rows - 1) - b,
                           2 * a * np.arange(columns) / (columns - 1) - a, indexing="ij")
        i, j = np.meshgrid(np.arange(rows - 1), np.arange(columns - 1), indexing="ij")
        k = (i * columns + j).ravel()
        faces = np.stack([k, k + 1, k + columns + 1, k, k + columns + 1, k + columns], 1)
        return self._keep_mesh(np.stack([x, y, z], -1).reshape(-1, 3), None, None, None,
                               np.ascontiguousarray(faces.reshape(-1, 3), np.uint32), smooth=True)

    def texture(self, picture: object, wrap: tuple[str, str] = ("repeat", "repeat")) -> int:
        """A picture for add(): (h, w, 3 or 4), or (6, h, h, 3 or 4) for a cube, whose faces are +x,
        -x, +y, -y, +z, -z as in OpenGL.  Mipmaps are made of it.  wrap is that of Surface."""
        given = np.asarray(picture)
        faces = 6 if given.ndim == 4 else 1
        if faces == 6:
            if given.shape[0] != 6 or given.shape[1] != given.shape[2]:
                raise Error(f"picture must have the shape (6, h, h, 3 or 4), not {given.shape}")
            given = given.reshape(-1, *given.shape[2:])
        rgba = arguments.texture("picture", given)
        u, v = (WRAPS.index(arguments.choice("wrap", how, WRAPS)) for how in wrap)
        return self._keep_texture(rgba, faces, u, v)

    def _keep_texture(self, rgba: Bytes, faces: int, u: int = 0, v: int = 0) -> int:
        height, width = rgba.shape[:2]
        got = library.python_scene_texture(self._scene.handle, pointer(rgba), width,
                                           height // faces, faces, int(self.srgb), u, v)
        if got < 0:
            raise MemoryError("memory is not enough for the texture")
        self._made.append(("texture", rgba, faces, u, v))
        self._textures += 1
        return int(got)

    def checker(self, one: object = "#5a6e82", other: object = "#8fa3b5") -> int:
        """A texture of 2 x 2 squares, which repeats."""
        squares = np.zeros((64, 64, 3), np.uint8)
        odd = (np.arange(64)[:, None] < 32) ^ (np.arange(64)[None] < 32)
        for color, where in ((one, odd), (other, ~odd)):
            shown = arguments.displayed("color", color)[:3]
            squares[where] = shown if shown.dtype.kind in "iu" else np.round(255 * shown)
        return self.texture(squares)

    def _color(self, name: str, value: object) -> list[float]:
        if self.srgb:
            return list(arguments.color(name, value))
        rgb = arguments.displayed(name, value)
        arguments.linear(name, rgb[None])    # refuses what is out of range
        return [float(x) for x in rgb[:3] / (255 if rgb.dtype.kind in "iu" else 1)]

    def add(self, shape: str | Shape, size: object = None, at: Sequence[float] = (0, 0, 0),
            pose: object = None, *, color: object = "white", alpha: float = 1.0,
            specular: float = 0.0, shininess: float = 32.0, emission: float = 0.0,
            texture: int | None = None, repeat: Sequence[float] = (1, 1), two_sided: bool = False,
            casts_shadow: bool = True) -> int:
        """Adds an object and returns its number, which ids have.

        shape is a Shape of mesh() or height_field(), of which size is the scale, or one of "plane"
        (half its sides; none: endless), "sphere" (radius), "ellipsoid" (radii), "capsule" and
        "cylinder" (radius, half the length along z; a capsule's without its ends) and "box" (half its
        sides).  pose is 4 x 4, or at the place alone.  alpha below 1 blends over what is behind; such
        objects are not in depth, ids and normals.  repeat are texture repeats: of uv, or a metre.
        """
        one = np.zeros(1, SOLID)
        o = one[0]
        if isinstance(shape, Shape):
            if not 0 <= shape.number < self._meshes:
                raise Error("shape must be of this renderer")
            scale = np.ones(3) if size is None else np.broadcast_to(np.asarray(size, float), 3)
            o["mesh"], o["size"] = shape.number, arguments.floats("size", scale, (3,), True)
        else:
            arguments.choice("shape", shape, list(SHAPES))
            o["kind"], o["size"] = _KINDS[shape], self._size(shape, size)
        o["texture"] = shape.texture if isinstance(shape, Shape) else -1
        if texture is not None:
            o["texture"] = arguments.integer("texture", texture, 0, self._textures - 1)
        o["flags"] = (_TWO_SIDED if arguments.flag("two_sided", two_sided) else 0) | \
            (0 if arguments.flag("casts_shadow", casts_shadow) else _NO_SHADOW)
        own = shape.alpha if isinstance(shape, Shape) else 1.0
        o["rgba"][:3], o["rgba"][3] = self._clear(color, arguments.number("alpha", alpha, 0, 1) * own)
        o["specular"] = arguments.number("specular", specular, 0, 1e6)
        o["shininess"] = arguments.number("shininess", shininess, 0, 1e6)
        o["emission"] = arguments.number("emission", emission, 0, 1e6)
        o["repeat"] = arguments.floats("repeat", repeat, (2,), True)
        self._put_pose(o, "pose" if pose is not None else "at", at, pose)
        if self._count == len(self._objects):
            self._objects = np.concatenate([self._objects, np.zeros(self._count, SOLID)])
        self._objects[self._count] = o
        self._count += 1
        return self._count - 1

    def _clear(self, color: object, alpha: float) -> tuple[list[float], float]:
        """A colour, and alpha times its own."""
        if isinstance(color, str):
            return self._color("color", color), alpha
        got = arguments.displayed("color", color)
        own = float(got[3]) / (255 if got.dtype.kind in "iu" else 1) if len(got) == 4 else 1.0
        if not 0 <= own <= 1:
            raise Error(f"color must have an alpha from 0 to 1, or to 255 in whole numbers, not {own:g}")
        return self._color("color", got[:3]), alpha * own

    @staticmethod
    def _size(shape: str, size: object) -> Floats:
        wanted = SHAPES[shape]
        if size is None and shape == "plane":
            return np.zeros(3, np.float32)
        got = arguments.floats("size", np.atleast_1d(np.asarray(size, float)), (wanted,), True)
        if not (got > 0).all():
            raise Error(f"size of a {shape} must be positive, not {arguments.shown(size)}")
        full = {"sphere": [0, 0, 0], "capsule": [0, 0, 1], "cylinder": [0, 0, 1],
                "plane": [0, 1, 1]}.get(shape, [0, 1, 2])
        return np.asarray(got[full], np.float32)

    @staticmethod
    def _put_pose(o: Any, name: str, at: object, pose: object) -> None:
        if pose is None:
            o["place"], o["turn"] = arguments.floats(name, at, (3,), True), np.eye(3)
            return
        m = arguments.rigid(name, pose)
        o["place"], o["turn"] = m[:3, 3], m[:3, :3]

    def pose(self, number: int, pose: object) -> None:
        """Moves an object: 4 x 4, a rotation and a translation."""
        arguments.integer("number", number, 0, self._count - 1)
        self._put_pose(self._objects[number], f"pose of object {number}", None, pose)

    def poses(self, poses: object) -> None:
        """Moves all objects: (n, 4, 4), a row for each; nothing moves where one is refused."""
        got = arguments.rigid("poses", poses, self._count)
        self._objects["turn"][:self._count] = got[:, :3, :3]
        self._objects["place"][:self._count] = got[:, :3, 3]

    def show(self, number: int, visible: bool = True) -> None:
        """Hides an object, or shows it again."""
        arguments.integer("number", number, 0, self._count - 1)
        kept = self._objects["flags"][number] & ~_HIDDEN
        self._objects["flags"][number] = kept | (0 if arguments.flag("visible", visible) else 1)

    # ---- what it is lit by

    def light(self, lights: Sequence[Light], ambient: Sequence[float] = (0, 0, 0),
              shadow: int | None = None) -> None:
        """Up to 8 lamps, the ambient light, and the number of the one lamp, directional or a spot,
        that casts shadows."""
        lamps = list(lights)
        if len(lamps) > _LAMPS:
            raise Error(f"lights: at most {_LAMPS} lamps are drawn, not {len(lamps)}")
        for i, lamp in enumerate(lamps):
            if not isinstance(lamp, Light):
                raise Error(f"lights[{i}] must be a shade_h.Light, not {arguments.shown(lamp)}")
        number = -1
        if shadow is not None:
            number = arguments.integer("shadow", shadow, 0, len(lamps) - 1)
            lamp = lamps[number]
            if lamp.position[3] != 0 and not any(lamp.spot_direction):
                raise Error(f"shadow: lights[{number}] is a point; directional lamps and spots can "
                            "cast shadows")
        made = (NativeLight * max(1, len(lamps)))(*(lamp.native() for lamp in lamps))
        ambient_light = arguments.doubles("ambient", ambient, (3,), finite=True).tolist()
        self._lights, self._lamps, self._shadow = lamps, made, number
        self._ambient = tuple(ambient_light)

    def background(self, color: object) -> None:
        """One colour behind all objects."""
        self._background = (*self._color("color", color), 1.0)
        self._sky = (0, -1, (0.0,) * 3, (0.0,) * 3)

    def sky(self, low: object = "#dfe8f0", high: object = "#4a7ab0") -> None:
        """A sky from the colour straight below to that straight above, +z."""
        self._sky = (1, -1, tuple(self._color("low", low)), tuple(self._color("high", high)))

    def sky_texture(self, texture: int) -> None:
        """A sky of a cube texture, whose +y is up (+z of the world), as in OpenGL."""
        number = arguments.integer("texture", texture, 0, self._textures - 1)
        if [m for m in self._made if m[0] == "texture"][number][2] != 6:
            raise Error(f"texture {number} is no cube")
        self._sky = (2, number, (0.0,) * 3, (0.0,) * 3)

    # ---- pictures

    def frame(self, color: bool = True, depth: bool = True, ids: bool = True,
              normals: bool = False) -> Frame:
        """New arrays for render(out=)."""
        h, w = self.height, self.width
        return Frame(np.empty((h, w, 3), np.uint8) if color else None,
                     np.empty((h, w), np.float32) if depth else None,
                     np.empty((h, w, 2), np.int32) if ids else None,
                     np.empty((h, w, 3), np.float32) if normals else None)

    def render(self, camera: Camera, out: Frame | None = None, *, normals: bool = False,
               solid: bool = False, empty_depth: float = float("inf")) -> Frame:
        """Draws what a camera sees, into the arrays of out or into new ones.

        out is a Frame whose arrays are filled; those that are None are left out.  color may have 4
        channels.  depth is empty_depth where there is nothing.  With solid=True alpha is ignored.
        """
        if not isinstance(camera, Camera):
            raise Error(f"camera must be a shade_h.Camera, not {arguments.shown(camera)}")
        frame = self.frame(normals=normals) if out is None else self._checked(out)
        camera = camera.sized(self.width, self.height)
        near, far, parallel = _range_of(camera.projection)
        return self._draw(frame, camera.view, camera.projection, near, far, parallel, solid,
                          empty_depth)

    def _draw(self, frame: Frame, view: Array, projection: Array, near: float, far: float,
              parallel: bool, solid: bool, empty_depth: float) -> Frame:
        sky, sky_texture, low, high = self._sky
        shot = SHOT.pack(
            self.width, self.height, self.samples, 3 if frame.color is None else frame.color.shape[2],
            self.srgb, bool(solid), parallel, self._count, len(self._lights), self._shadow,
            sky, sky_texture, near, far, ctypes.c_float(empty_depth).value,
            self.tolerance,
            *view.T.ravel().tolist(), *projection.T.ravel().tolist(), *self._background, *low, *high,
            *self._ambient, pointer(self._objects), ctypes.addressof(self._lamps),
            *(pointer(array) or 0 for array in frame))
        scratch = self._scene.take()
        try:
            check(library.python_renderer_draw(scratch, self._scene.handle, shot),
                  "camera")
        finally:
            self._scene.free.append(scratch)
        return frame

    def _checked(self, out: object) -> Frame:
        if not isinstance(out, Frame):
            raise Error(f"out must be a shade_h.Frame, not {arguments.shown(out)}")
        size = (self.height, self.width)
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

    def __getstate__(self) -> dict[str, Any]:
        """All but what the library holds."""
        state = {k: v for k, v in self.__dict__.items() if k not in ("_scene", "_lamps")}
        return {**state, "_objects": self._objects.copy()}

    def __setstate__(self, state: dict[str, Any]) -> None:
        """Gives the meshes and textures to the library again."""
        self.__dict__.update(state)
        made, self._made, self._scene = self._made, [], _Scene()
        self._meshes = self._textures = 0
        for what, *rest in made:
            if what == "mesh":
                self._keep_mesh(*rest)
            else:
                self._keep_texture(*rest)
        shadow = None if self._shadow < 0 else self._shadow
        self.light(self._lights, self._ambient, shadow)
