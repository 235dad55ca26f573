"""Scenes: meshes in their places, lamps, and pictures of them, one or many at a time."""
from __future__ import annotations

import ctypes
import warnings
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, Sequence, Union

import numpy as np

from . import _arguments as arguments
from . import elsewhere
from ._native import Array, Bytes, Doubles, Error, Floats, Integers, Item, View, check
from ._native import interruptible, library, pointer
from .annotate import Text, bar_room, display, draw_bar, words_of, write_text
from .camera import UPRIGHT, Camera, Viewpoint, at, direction, fitted, studio
from .light import PRESETS, Flag, Light, Lighting, Material, Model, preset
from .mesh import Like, Mesh, is_file, mesh as as_mesh
from .picture import Picture, png_path

Color = Union[str, Sequence[float], Array]
CLAY = arguments.color("color", "clay")
INK = arguments.color("color", "#20242a")
IDENTITY = np.eye(4)


@dataclass(frozen=True, eq=False)
class Stroke:
    """Segments of lines, pairs of points that count from the origin of their part's mesh."""

    pairs: Floats
    width: float
    color: tuple[float, float, float]
    over: bool

    def put(self, item: Any) -> None:
        """Hands the lines to an item, which points to them."""
        item.lines, item.line_points = pointer(self.pairs), len(self.pairs)
        item.line_width, item.line_color = self.width, (*self.color, 1.0)
        item.lines_over = self.over


@dataclass(frozen=True)
class Part:
    """A mesh in a scene: its number in pictures' ids is its place in scene.parts."""

    mesh: Mesh
    pose: Array
    material: Material
    name: str
    edges: bool
    two_sided: bool
    stroke: Stroke | None = None
    ends: Stroke | None = None    # of a dimension
    text: Text | None = None

    @cached_property
    def native(self) -> Any:
        """The structs of the library, one for each surface, which point into the mesh.  Where they
        are is told later."""
        items = []
        for piece in self.mesh.pieces:
            if not piece.count:
                continue
            item = Item(mesh=piece.mesh, two_sided=self.two_sided)
            item.state.material = ctypes.pointer((piece.surface.material or self.material).native())
            piece.dress(item)
            items.append(item)
        return items

    def __getstate__(self) -> dict[str, Any]:
        """All but what points into the mesh."""
        return {k: v for k, v in self.__dict__.items() if k != "native"}


class Scene:
    """Meshes in their places, and the lamps that light them.

    Without lamps of its own a scene is lit by three lamps that stay with the camera.
    """

    def __init__(self, lights: Sequence[Light] | None = None,
                 ambient: Sequence[float] | None = None, model: Model = Model.BLINN_PHONG,
                 flags: Flag = Flag.NONE) -> None:
        """An empty scene.  ambient is linear light."""
        self.parts: list[Part] = []
        Lighting(() if lights is None else lights, (0, 0, 0) if ambient is None else ambient,
                 model, flags).native()    # refuses what is wrong
        self.lights = None if lights is None else list(lights)
        self.ambient, self.model, self.flags = ambient, model, flags

    def __repr__(self) -> str:
        """Says how many parts there are."""
        names = ", ".join(part.name for part in self.parts[:5] if part.name)
        return f"<shade_h.Scene of {len(self.parts)} parts{names and ': ' + names}>"

    def add(self, mesh: Like, pose: object = None, material: Material | str | None = None,
            name: str = "", *, edges: bool = False, two_sided: bool = True,
            **options: Any) -> int:
        """Adds a mesh and returns its number.

        pose is 4 x 4 and takes the mesh to the world.  material is a Material or the name of
        a preset, which takes the place of all surfaces of a file; without one a colour of the mesh,
        or clay, is a little glossy.  edges draws its
        silhouettes, creases and boundaries.  two_sided=False leaves faces out that are seen from
        behind, which is faster.  options are those of shade_h.Mesh.
        """
        made = _made(mesh, material, options)
        place = arguments.affine("pose", IDENTITY if pose is None else pose)
        if isinstance(material, str):
            material = preset(arguments.choice("material", material, PRESETS))
        flags = arguments.flag("edges", edges), arguments.flag("two_sided", two_sided)
        if material is not None and not isinstance(material, Material):
            raise Error(f"material must be a shade_h.Material or a name, "
                        f"not {arguments.shown(material)}")
        self.parts.append(Part(made, place.copy(), material or _gloss(made),
                               str(name), *flags))
        return len(self.parts) - 1

    def add_lines(self, points: object, color: Color = "red", width: float = 2.0, *,
                  over: bool = True, name: str = "") -> int:
        """Adds a polyline through points, (n, 3), or a list of such, and returns its number.

        width is in pixels.  over=False hides what lies behind parts.  Lines count for the camera
        that is fitted, but not in ids and depth.
        """
        try:
            single = np.ndim(points) == 2    # type: ignore[arg-type]
        except ValueError:    # lines of different lengths
            single = False
        lines = [points] if single or not isinstance(points, (list, tuple)) else list(points)
        rows = [arguments.doubles(f"points[{i}]", line, (None, 3), finite=True)
                for i, line in enumerate(lines)]
        for i, row in enumerate(rows):
            if len(row) == 1:
                raise Error(f"points[{i}] must have two rows or more, not 1")
        ends = np.cumsum([0, *map(len, rows)])
        starts = [np.arange(a, b - 1) for a, b in zip(ends, ends[1:])]
        return self._add_stroke(rows, np.concatenate(starts) if starts else np.zeros(0, int), 1,
                                color, width, over, name)

    def add_points(self, points: object, color: Color = "red", width: float = 6.0, *,
                   over: bool = True, name: str = "") -> int:
        """Adds points, (n, 3), as squares of so many pixels, and returns their number."""
        rows = [arguments.doubles("points", points, (None, 3), finite=True)]
        return self._add_stroke(rows, np.arange(len(rows[0])), 0, color, width, over, name)

    def add_label(self, point: object, text: str, color: Color = "black", size: float = 14.0, *,
                  over: bool = True, name: str = "") -> int:
        """Adds text beside a point, which a small square marks, and returns its number.

        size is in pixels.  over=False leaves it out where a part hides the point.  Labels are not
        drawn into batches.
        """
        words, ink = words_of("text", text), arguments.color("color", color)
        rows = [arguments.doubles("point", point, (3,), finite=True)[None]]
        number = self._add_stroke(rows, np.arange(1), 0, color, 5.0, over, name)
        self._write(number, words, ink, size, over, False)
        return number

    def add_dimension(self, a: object, b: object, text: str | None = None, color: Color = "black",
                      size: float = 14.0, *, over: bool = True, name: str = "") -> int:
        """Adds a line between two points with text at its middle, None for their distance, and
        returns its number.  over=False hides what lies behind parts; the text as add_label does."""
        ends = [arguments.doubles(what, point, (3,), finite=True)
                for what, point in (("a", a), ("b", b))]
        words = f"{float(np.linalg.norm(ends[1] - ends[0])):.6g}" if text is None \
            else words_of("text", text)
        ink = arguments.color("color", color)
        number = self._add_stroke([np.stack(ends)], np.arange(1), 1, color, 1.4, over, name)
        part = self.parts[number]
        dots = Stroke(np.repeat(part.mesh.local, 2, 0), 5.0, ink, over)
        self.parts[number] = replace(part, ends=dots)
        self._write(number, words, ink, size, over, True)
        return number

    def _write(self, number: int, words: str, ink: tuple[float, float, float], size: float,
               over: bool, middle: bool) -> None:
        """Gives a part its text, at the mean of its points."""
        part = self.parts[number]
        shown = np.round(255 * np.asarray(display(np.array(ink))))
        text = Text(words, part.mesh.local.astype(np.float64).mean(0).astype(np.float32),
                    (int(shown[0]), int(shown[1]), int(shown[2])),
                    arguments.number("size", size, 6, 200), over, middle)
        self.parts[number] = replace(part, text=text)

    def _add_stroke(self, rows: list[Doubles], start: Array, step: int, color: Any, width: float,
                    over: bool, name: str) -> int:
        points = np.concatenate(rows) if rows else np.zeros((0, 3))
        # faces without area let the camera see the points, and draw nothing
        made = Mesh(points, np.stack([start, start + step, start + step], 1), normals="flat")
        pairs = made.local[np.stack([start, start + step], 1)].reshape(-1, 3)
        stroke = Stroke(np.ascontiguousarray(pairs), arguments.number("width", width, 0, 1000),
                        arguments.color("color", color), arguments.flag("over", over))
        self.parts.append(Part(made, IDENTITY.copy(), _gloss(made), str(name), False, True, stroke))
        return len(self.parts) - 1

    def fit(self, view: Viewpoint = "iso", size: object = (640, 480), *, up: str | None = None,
            ortho: bool = False, ground: bool = False) -> Camera:
        """The nearest camera that sees all of the scene from a side.  With ground its far plane
        lies behind the studio's ground."""
        origin, places = self._places(None)
        return self._fitted(self._points(places[0]), view, arguments.size("size", size), up, ortho,
                            room=1.5 if ground else 0.0, origin=origin)

    def _fitted(self, points: Floats, view: Viewpoint, size: tuple[int, int], up: str | None,
                ortho: bool, **options: Any) -> Camera:
        """The fitted camera, which leaves the columns of bars free."""
        room = sum(bar_room(bar, *size) for bar in self._bars())
        room = min(room, size[0] // 2)
        made = fitted(points, view, (size[0] - room, size[1]), self._up(up), ortho, **options)
        if not room:
            return made
        projection, share = made.projection.copy(), room / size[0]
        projection[0] = (1 - share) * projection[0] - share * projection[3]
        return replace(made, projection=projection)

    def _bars(self) -> list[Any]:
        """The bars of the parts, those that look alike once."""
        bars: list[Any] = []
        for part in self.parts:
            bar = part.mesh.bar
            if bar is not None and not any(bar.same(other) for other in bars):
                bars.append(bar)
        return bars

    def _annotate(self, picture: Picture, camera: Camera, places: Doubles, origin: Doubles) -> None:
        """Draws bars and text over a picture."""
        right = picture.size[0]
        for bar in self._bars():
            room = bar_room(bar, *picture.size)
            if not room or right < room:
                break
            draw_bar(picture.rgba, bar, right)
            right -= room
        view = camera.view_from(origin).astype(np.float32).astype(np.float64)
        picture.written = frozenset(
            number for number, (part, place) in enumerate(zip(self.parts, places))
            if part.text is not None and write_text(picture.rgba, picture.depth, part.text,
                                                    view @ place, camera.projection))

    def _up(self, up: str | None) -> str:
        """The upright axis: what the caller says, or that of the first part that knows one."""
        known = [part.mesh.up for part in self.parts if part.mesh.up is not None]
        return up if up is not None else known[0] if known else "z"

    def _places(self, poses: Doubles | None) -> tuple[Doubles, Doubles]:
        """The origin from which a picture counts, so that floats keep their digits far away; and
        the matrices from each mesh's own coordinates to those, (N, parts, 4, 4)."""
        if poses is None:
            poses = np.array([[part.pose for part in self.parts]]).reshape(1, -1, 4, 4)
        out, origin = np.array(poses, np.float64), np.zeros(3)
        rows = np.empty((*out.shape[:2], 20))    # core_place: pose by columns, origin, reach
        rows[..., :16] = out.swapaxes(2, 3).reshape(*out.shape[:2], 16)
        for i, part in enumerate(self.parts):
            rows[:, i, 16:] = *part.mesh.origin, part.mesh.radius
        if out.size:
            library.python_place_all(pointer(rows), out.shape[0] * out.shape[1], pointer(origin))
        return origin, rows[..., :16].reshape(out.shape).swapaxes(2, 3)

    def _points(self, places: Doubles) -> Floats:
        """Every vertex of a face, counted from the origin of the places."""
        with np.errstate(all="ignore"):
            placed = [part.mesh.drawn_vertices() @ place[:3, :3].T
                      + place[:3, 3] for part, place in zip(self.parts, places)]
        points = np.concatenate(placed) if placed else np.zeros((0, 3))
        return np.asarray(points, np.float32)

    def render(self, camera: Camera | Viewpoint = "iso", size: object = (640, 480), *,
               samples: int = 3, background: Color | None = "white", threads: int = 0,
               up: str | None = None, ortho: bool = False, light: str = "scene") -> Picture:
        """Draws one picture; a viewpoint instead of a camera is fitted to the scene.

        samples, 1 .. 8, are taken along each edge of a pixel.  background None is transparent.
        threads 0 is one a core; the picture is the same with any number.  up is the upright axis,
        x, y, z, -x, -y or -z; None is that of the file, or z.  light "studio" takes the
        place of the scene's lamps: a large lamp and a sky that throw soft shadows, also on a ground
        below the scene, which a camera of one's own must reach with its near and far.
        """
        width, height = arguments.size("size", size)
        soft = arguments.choice("light", light, ("scene", "studio")) == "studio"
        fit = not isinstance(camera, Camera)
        origin, places = self._places(None)
        points = self._points(places[0]) if soft or fit else None
        if points is not None and not isinstance(camera, Camera):
            camera = self._fitted(points, camera, (width, height), up, ortho,
                                  room=1.5 if soft else 0.0, origin=origin)
        camera = at(camera).sized(width, height)
        many = arguments.integer("samples", samples, 1, 8)
        _small_enough(width, height, many)
        rgba = np.empty((height, width, 4), np.uint8)
        depth = np.empty((height, width), np.float32)
        normals = np.empty((height, width, 3), np.float32)
        ids = np.empty((height, width), np.int32)
        view = View(width=width, height=height, samples=many, channels=4, rgba=pointer(rgba),
                    depth=pointer(depth), normals=pointer(normals), ids=pointer(ids))
        items, kept = self._items(camera, places[0], origin)
        self._aim(view, camera, _background(background), origin)
        if soft and points is not None:
            view.in_studio = 1
            view.to_studio = self._studio(places[0], camera, up)
        self._draw(items, (View * 1)(view), threads, (rgba, depth, normals, ids, kept),
                   soft)
        made = Picture(rgba, depth, ids, normals)
        made.parts = tuple(self.parts)
        self._annotate(made, camera, places[0], origin)
        if fit and made.blank and any(part.stroke is None for part in self.parts):
            warnings.warn(f"nothing of {self!r} can be seen: {self._why_blank()}", stacklevel=2)
        return made

    def _studio(self, places: Doubles, camera: Camera, up: str | None) -> tuple[float, ...]:
        """The matrix to the studio, where the parts are in their places."""
        upright = arguments.choice("up", self._up(up), list(UPRIGHT))
        return tuple(studio(self._points(places), camera, upright).T.reshape(-1))

    def _why_blank(self) -> str:
        """What keeps parts from being seen."""
        if not any(len(part.mesh.faces) for part in self.parts):
            return "there are no triangles"
        if not any((np.abs(part.mesh.drawn_vertices()) <= 1e8).all(1).any() for part in self.parts):
            return "all vertices are NaN or infinite, or lie beyond 1e8"
        return "its triangles have no area, or show their edge to the camera"

    def render_batch(self, cameras: Sequence[Camera] | Camera, poses: object = None,
                     size: object = (256, 256), *, samples: int = 1,
                     background: Color = "white", threads: int = 0, rgb: object = None,
                     depth: object = None, ids: object = None, light: str = "scene",
                     up: str | None = None) -> tuple[Bytes, Floats, Integers]:
        """Draws N pictures: rgb (N, H, W, 3), depth (N, H, W), ids (N, H, W).

        poses, (N, parts, 4, 4), are those of every part in every picture; None leaves all parts
        where they are.  One camera serves all pictures.  rgb (uint8), depth (float32) and ids
        (int32) may be handed in to be filled.  Threads share the pictures, without the
        interpreter's lock.  light and up are those of render; the studio stays where the first
        camera has it, and is lit once where no part moves.
        """
        soft = arguments.choice("light", light, ("scene", "studio")) == "studio"
        width, height = arguments.size("size", size)
        many = arguments.integer("samples", samples, 1, 8)
        _small_enough(width, height, many)
        placed = None if poses is None else arguments.affine(
            "poses", poses, (None, len(self.parts), 4, 4))
        seen = _cameras(cameras, None if placed is None else len(placed))
        n = len(seen)
        shape = (n, height, width)
        colors = arguments.into("rgb", rgb, (*shape, 3), np.uint8)
        depths = arguments.into("depth", depth, shape, np.float32)
        numbers = arguments.into("ids", ids, shape, np.int32)
        origin, places = self._places(placed)
        columns = None if placed is None else np.ascontiguousarray(
            places.transpose(0, 1, 3, 2), dtype=np.float32)
        if any(np.may_share_memory(x, y) for x, y in ((colors, depths), (depths, numbers),
                                                      (colors, numbers)) if n):
            raise Error("rgb, depth and ids must not overlap")
        seen = [camera.sized(width, height) for camera in seen]
        behind = _background(background)
        views = (View * max(n, 1))()
        for i, camera in enumerate(seen):
            view = views[i]
            view.width, view.height, view.samples, view.channels = width, height, many, 3
            view.rgba, view.depth = pointer(colors[i]), pointer(depths[i])
            view.ids = pointer(numbers[i])
            view.poses = None if columns is None else pointer(columns[i])
            self._aim(view, camera, behind, origin)
            if soft:
                view.in_studio = 1
                view.to_studio = self._studio(places[i if placed is not None else 0], seen[0], up)
        arrays = colors, depths, numbers, columns
        if soft and placed is not None:    # each picture has shadows of its own
            for i, camera in enumerate(seen):
                items, kept = self._items(camera, places[i], origin)
                self._draw(items, (View * 1)(views[i]), threads, (*arrays, kept), True)
        elif n:
            still = self._places(None)[1][0] if columns is None else places[0]
            items, kept = self._items(seen[0], still, origin)
            self._draw(items, views, threads, (*arrays, kept), soft or n > 16)
        return colors, depths, numbers

    def _draw(self, items: Any, views: Any, threads: int, kept: object, slow: bool) -> None:
        """kept are the arrays that must live until the last pixel.  What is slow can be ended by
        Ctrl-C."""
        count = arguments.integer("threads", threads, 0, 256)

        def draw(stop: ctypes.c_int) -> int:
            drawn: int = library.python_draw(items, len(items), views, len(views), count,
                                             ctypes.addressof(stop))
            del keep[:]
            return drawn

        keep = [kept]
        check(interruptible(draw) if slow else draw(ctypes.c_int(0)), "scene")

    def _items(self, camera: Camera, places: Doubles, origin: Doubles) -> tuple[Any, list[Any]]:
        """The surfaces of all parts as the library has them, those that blend last, and what must
        live as long as they."""
        kept: list[Any] = []
        solid: list[Any] = []
        clear: list[Any] = []
        for number, (part, place) in enumerate(zip(self.parts, places)):
            natives = part.native
            kept.append(natives)
            for i, native in enumerate(natives):
                item = Item.from_buffer_copy(native)
                item.id, item.state.model = number, tuple(place.T.reshape(-1))
                if part.stroke is not None:
                    part.stroke.put(item)
                elif part.edges and not i:
                    lines = _lines(part, camera, place, origin)
                    item.lines, item.line_points = pointer(lines), len(lines)
                    item.line_width, item.line_color = 1.4, (*INK, 1.0)
                    kept.append(lines)
                (clear if item.blended else solid).append(item)
                if part.ends is not None:
                    solid.append(Item.from_buffer_copy(item))
                    part.ends.put(solid[-1])
        kept += [solid, clear]
        return (Item * (len(solid) + len(clear)))(*solid, *clear), kept

    def _aim(self, view: Any, camera: Camera, background: tuple[float, ...],
             origin: Doubles) -> None:
        """Camera, lamps and background of a view."""
        local = camera.view_from(origin).astype(np.float32).astype(np.float64)
        view.view = tuple(local.T.reshape(-1))
        view.projection = tuple(camera.projection.T.reshape(-1))
        view.background = background
        view.quick = 0 if self.lights is not None else 1 if self.ambient is None else 2    # QUICK, QUICK_LAMPS
        lights = [_moved(lamp, origin) for lamp in self.lights or ()]
        flags = self.flags
        if camera.projection[3, 3] != 0:
            flags |= Flag.INFINITE_VIEWER
        ambient = (0.0, 0.0, 0.0) if self.ambient is None else self.ambient
        view.lighting = Lighting(lights, ambient, self.model, flags).native()


def _moved(lamp: Light, origin: Doubles) -> Light:
    """A lamp whose position counts from an origin."""
    if not origin.any():
        return lamp
    x, y, z, w = (float(k) for k in lamp.position)
    near = np.array([x, y, z]) - w * origin
    return replace(lamp, position=(*near.tolist(), w))


def _lines(part: Part, camera: Camera, place: Doubles, origin: Doubles) -> Floats:
    """The edges to draw of a part in a place, as seen by a camera."""
    view = np.array(camera.view_from(origin).astype(np.float32).T, np.float64, order="C")
    pose, eye, ortho = np.array(place.T, np.float64, order="C"), np.empty(3), camera.projection[3, 3] != 0
    if not library.python_eye(pointer(view), bool(ortho), pointer(pose), pointer(eye)):
        return np.empty((0, 3), np.float32)
    return part.mesh.drawn_edges(eye, eye if ortho else None)


def _gloss(made: Mesh) -> Material:
    """A little gloss on the colour of a mesh; white where vertices have colours of their own."""
    mapped = any(piece.texture is not None and piece.surface.material is None
                 for piece in made.pieces)
    white = (1.0, 1.0, 1.0) if made.colors is not None or mapped else None
    color = made.color or white or CLAY
    return Material((0, 0, 0), color, color, (0.08, 0.08, 0.08), 40.0)


def _small_enough(width: int, height: int, samples: int) -> None:
    most = max(width, height) * samples
    if most > 16384:
        raise Error(f"size times samples must be at most 16384, not {most}")


def _background(value: object) -> tuple[float, ...]:
    if value is None:
        return 0.0, 0.0, 0.0, 0.0
    return (*arguments.color("background", value), 1.0)


def _cameras(cameras: Any, poses: int | None) -> list[Camera]:
    if isinstance(cameras, Camera):
        return [cameras] * (1 if poses is None else poses)
    try:
        seen = [at(camera) for camera in cameras]
    except TypeError:
        raise Error(f"cameras must be shade_h.Camera, not {arguments.shown(cameras)}") from None
    if len(seen) == 1 and poses is not None:
        seen *= poses
    if poses is not None and len(seen) != poses:
        raise Error(f"poses must have one row for each of {len(seen)} cameras, not {poses}")
    return seen


def render(vertices: object, faces: object = None, *, view: Viewpoint = "iso",
           size: object = (640, 480), color: object = None, normals: object = "auto",
           uv: object = None, texture: object = None, edges: bool = False,
           background: Color | None = "white", ortho: bool = False, samples: int = 3,
           light: str = "quick", material: Material | str | None = None, up: str | None = None,
           threads: int = 0, section: object = None,
           look: elsewhere.Look | str | None = None) -> Picture:
    """Draws a mesh, seen from a side by a camera that is fitted to it.

    Pass vertices and faces, or a mesh alone: a path, a file, a shade_h.Mesh, an object of trimesh,
    cadquery or build123d, points (n, 3), which become small balls, or a list of these, whose places
    in it are their ids.  view is "front",
    "right", "back", "left", "top", "bottom", "iso" or (azimuth, elevation) in degrees.  light is
    "quick", three lamps beside the camera, or "studio", soft shadows that take longer.  section
    cuts away one side of a plane, and hatches the cut: of "x", "y" or "z", through the middle, and
    of ("x", where) the side of the eye; of (point, normal) that of the normal.  look is another
    program's material, shade_h.elsewhere.vtk(specular=0.5), in the place of material.
    """
    made = elsewhere.look(look) if isinstance(look, str) else look
    if made is not None and not isinstance(made, elsewhere.Look):
        raise Error(f"look must be a shade_h.elsewhere.Look or text, not {arguments.shown(look)}")
    if made is not None and material is not None:
        raise Error("look and material exclude each other")
    soft = arguments.choice("light", light, ("quick", "studio")) == "studio"
    options: dict[str, Any] = {"color": color, "normals": normals, "uv": uv, "texture": texture}
    source: Any = vertices if faces is None else (vertices, faces)
    defaults = {"normals": "auto"}
    given = {k: v for k, v in options.items()
             if v is not None and not (isinstance(v, str) and defaults.get(k) == v)}
    scene = Scene() if made is None else Scene(model=made.model, flags=made.flags)
    _add_all(scene, source if _several(source) else [source], section, view, up,
             material=material if made is None else made.material, edges=edges, **given)
    return scene.render(view, size, samples=samples, background=background, threads=threads, up=up,
                        ortho=ortho, light="studio" if soft else "scene")


def _made(source: Any, material: object, options: dict[str, Any]) -> Mesh:
    """A mesh.  A material that is asked for takes the place of what a file says of its surfaces."""
    if material is not None and is_file(source) and options.get("color") is None:
        options = {**options, "color": "white"}
    return as_mesh(source, **options)


def _add_all(scene: Scene, sources: Any, section: object, view: Viewpoint, up: str | None,
             **options: Any) -> None:
    """Adds meshes, all cut by one plane, which is seen from a side, where a section is asked for."""
    material, edges = options.pop("material", None), options.pop("edges", False)
    made = [_made(one, material, options) for one in sources]
    if section is not None:
        from .section import cut, plane_of
        boxes = np.array([mesh.box() for mesh in made])
        known = [mesh.up for mesh in made if mesh.up is not None]
        upright = up if up is not None else known[0] if known else "z"
        ways = direction(view, upright)[0], direction("iso", upright)[0]
        plane = plane_of(section, boxes[:, 0].min(0), boxes[:, 1].max(0), ways)
        corners = np.stack(np.meshgrid(*np.stack([boxes[:, 0].min(0), boxes[:, 1].max(0)], 1)), -1)
        side = (corners - plane[0]) @ plane[1]
        if side.min() > 0 or side.max() < 0:
            raise Error("section does not cut the parts, which reach from "
                        f"{boxes[:, 0].min(0).tolist()} to {boxes[:, 1].max(0).tolist()}")
        made = [cut(mesh, *plane) for mesh in made]
    for mesh in made:
        scene.add(mesh, None, material, edges=edges)


def export_png(shape: object, path: object = None, *,
               views: Sequence[Viewpoint] = ("front", "right", "top", "iso"),
               size: object = (480, 400), edges: bool = True, section: object = None,
               up: str | None = None, samples: int = 3, background: Color | None = "white",
               light: str = "quick", **options: Any) -> bytes:
    """The bytes of a PNG file with a part seen from sides, which is also written to a path where
    one is given.

    shape is all that render takes, a list of parts too, which then are one picture.  section is
    that of render, as the iso view sees it, and light as well.  options are those of Mesh.
    """
    if path is not None:
        png_path("path", path)
    scene = Scene()
    _add_all(scene, shape if _several(shape) else [shape], section, "iso", up, edges=edges,
             **options)
    drawn = _row(scene, views, size, samples, up, background, light)
    width, height = drawn[0].size
    out = np.full((height, len(drawn) * (width + 2) - 2, 4), (200, 204, 210, 255), np.uint8)
    for c, picture in enumerate(drawn):
        out[:, c * (width + 2):c * (width + 2) + width] = picture.rgba
    made = Picture(out)
    if path is not None:
        made.save(path)
    return made.png()


def _row(scene: Scene, views: Any, size: object, samples: int, up: str | None,
         background: Color | None, light: str) -> list[Picture]:
    """A scene seen from several sides, with one scale for the named ones."""
    if not isinstance(views, (list, tuple)) or not views:
        raise Error("views must be a list of at least one")
    pair = arguments.size("size", size)
    lamps = {"quick": "scene"}.get(arguments.choice("light", light, ("quick", "studio")), light)
    return [scene.render(camera, pair, samples=samples, background=background, up=up, light=lamps)
            for camera in _of_one_scale(scene, views, pair, up, lamps == "studio")]


def sheet(meshes: object, views: Sequence[Viewpoint] = ("front", "right", "top", "iso"), *,
          edges: bool = True, size: object = (480, 400), samples: int = 3, up: str | None = None,
          background: Color | None = "white", gap: int = 2, section: object = None,
          light: str = "quick") -> Picture:
    """The drawing of parts: a row for each mesh, a column for each view.

    section is that of render, for each mesh by itself, as the iso view sees it.  The named sides are orthographic and of one
    scale in a row; "iso" and angles are in perspective.  light is that of render.
    """
    rows: Any = meshes if _several(meshes) else [meshes]
    if not rows or not isinstance(views, (list, tuple)) or not views:
        raise Error("meshes and views must be lists of at least one")
    width, height = arguments.size("size", size)
    between = arguments.integer("gap", gap, 0, 1000)
    w = len(views) * (width + between) - between
    h = len(rows) * (height + between) - between
    out = np.full((h, w, 4), (200, 204, 210, 255), np.uint8)
    depth, normals = np.full((h, w), np.inf, np.float32), np.zeros((h, w, 3), np.float32)
    ids = np.full((h, w), -1, np.int32)
    for r, one in enumerate(rows):
        scene = Scene()
        _add_all(scene, [one], section, "iso", up, edges=edges)
        row = _row(scene, views, (width, height), samples, up, background, light)
        for c, got in enumerate(row):
            y, x = r * (height + between), c * (width + between)
            cell = np.s_[y:y + height, x:x + width]
            out[cell], depth[cell], normals[cell] = got.rgba, got.depth, got.normals
            ids[cell] = np.where(got.ids < 0, -1, r)
    return Picture(out, depth, ids, normals)


def _several(value: object) -> bool:
    """Is it a list of meshes, not a pair of vertices and faces?"""
    return isinstance(value, list) and not (len(value) == 2 and _is_array(value[0]))


def _is_array(value: object) -> bool:
    """Vertices; a list or tuple is one where it holds no mesh."""
    if not isinstance(value, (list, tuple)) or not value:
        return isinstance(value, (np.ndarray, list, tuple))
    first = value[0]
    pair = isinstance(value, tuple) and len(value) == 2 and isinstance(first, np.ndarray) \
        and first.ndim == 2
    return not pair and not isinstance(first, (str, bytes)) and not hasattr(first, "vertices")


def _of_one_scale(scene: Scene, views: Sequence[Viewpoint], size: tuple[int, int],
                  up: str | None, soft: bool) -> list[Camera]:
    flat = [isinstance(view, str) and view != "iso" for view in views]
    cameras = [scene.fit(view, size, up=up, ortho=o, ground=soft) for view, o in zip(views, flat)]
    scales = [c.projection[1, 1] for c, o in zip(cameras, flat) if o]
    for camera, o in zip(cameras, flat):
        if o:
            camera.projection[0, 0] *= min(scales) / camera.projection[1, 1]
            camera.projection[1, 1] = min(scales)
    return cameras


__all__ = ["Part", "Scene", "export_png", "render", "sheet"]
