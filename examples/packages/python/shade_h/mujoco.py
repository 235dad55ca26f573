"""mujoco.Renderer without OpenGL: the same calls, shapes and units.

    from shade_h.mujoco import Renderer
    renderer = Renderer(model, height=240, width=320)
    renderer.update_scene(data, camera="eye")
    pixels = renderer.render()

The scene is made by mujoco's own mjv_updateScene; geoms, lights and the camera of it are drawn here.
What is changed in renderer.scene before render() is drawn: flags, geoms that mjv_initGeom adds.  Of
the lamps that cast shadows the first one does.  Skins, flexes, arrows, lines, fog, haze and
reflections are left out.
"""
from __future__ import annotations

import importlib
import math
from typing import Any, cast

import numpy as np

from . import _arguments as arguments
from ._native import SOLID, Array, Error
from .light import Light
from .renderer import _HIDDEN, Frame, Renderer as _Base

_HEIGHT_FIELD, _MESH, _KINDS = 1, 7, (1, 0, 2, 4, 3, 5, 6, 0)    # of mjGEOM_..., as kinds here
_CUBE, _SKYBOX, _SPOT, _DIRECTIONAL = 1, 2, 0, 1                 # mjTEXTURE_..., mjLIGHT_...
_SHADOWS, _SKIES, _LAMPS = 0, 4, 8                               # mjRND_...


def _texels(model: Any, i: int) -> tuple[Array, int]:
    """A texture as RGBA, and its faces."""
    width, height = int(model.tex_width[i]), int(model.tex_height[i])
    n, first = int(model.tex_nchannel[i]), int(model.tex_adr[i])
    flat = np.asarray(model.tex_data).reshape(-1)[first:first + width * height * n]
    rgba = np.full((height, width, 4), 255, np.uint8)
    data = flat.reshape(height, width, n)
    rgba[..., :n] = data if n >= 3 else data[..., :1]
    if n < 3:
        rgba[..., :3] = data[..., :1]
        rgba[..., 3] = 255
    return rgba, 6 if model.tex_type[i] in (_CUBE, _SKYBOX) else 1


def _mesh(model: Any, i: int) -> tuple[Any, ...]:
    """A mesh, whose corners have numbers of their own for normals and texture coordinates."""
    def part(name: str, adr: str, num: str, width: int) -> Array:
        rows = np.asarray(getattr(model, name)).reshape(-1, width)
        first = int(getattr(model, adr)[i])
        return rows[first:first + int(getattr(model, num)[i])]
    corners = [part("mesh_face", "mesh_faceadr", "mesh_facenum", 3).ravel(),
               part("mesh_facenormal", "mesh_faceadr", "mesh_facenum", 3).ravel()]
    mapped = model.mesh_texcoordadr[i] >= 0 and model.mesh_texcoordnum[i] > 0
    if mapped:
        corners.append(part("mesh_facetexcoord", "mesh_faceadr", "mesh_facenum", 3).ravel())
    known, index = np.unique(np.stack(corners, 1), axis=0, return_inverse=True)
    uv = None
    if mapped:
        uv = part("mesh_texcoord", "mesh_texcoordadr", "mesh_texcoordnum", 2)[known[:, 2]]
    return (part("mesh_vert", "mesh_vertadr", "mesh_vertnum", 3)[known[:, 0]],
            part("mesh_normal", "mesh_normaladr", "mesh_normalnum", 3)[known[:, 1]], uv, None,
            np.ascontiguousarray(index.reshape(-1, 3), np.uint32))


def _ground(model: Any, i: int) -> tuple[Any, ...]:
    """A height field with sides, down to its base."""
    rows, columns = int(model.hfield_nrow[i]), int(model.hfield_ncol[i])
    a, b, high, base = (float(x) for x in np.asarray(model.hfield_size).reshape(-1, 4)[i])
    first = int(model.hfield_adr[i])
    data = np.asarray(model.hfield_data, float).reshape(-1)[first:first + rows * columns]
    y, x = np.meshgrid(2 * b * np.arange(rows) / (rows - 1) - b,
                       2 * a * np.arange(columns) / (columns - 1) - a, indexing="ij")
    top = np.stack([x.ravel(), y.ravel(), high * data], 1)
    k = (np.arange(rows - 1)[:, None] * columns + np.arange(columns - 1)).ravel()
    faces = [np.stack([k, k + 1, k + columns + 1, k, k + columns + 1, k + columns], 1).reshape(-1, 3)]
    number = np.arange(rows * columns).reshape(rows, columns)
    rim = np.concatenate([number[0, :-1], number[:-1, -1], number[-1, :0:-1], number[:0:-1, 0]])
    after, walls = np.roll(rim, -1), np.empty((len(rim), 4, 3))
    for j, (v, low) in enumerate(((rim, True), (after, True), (after, False), (rim, False))):
        walls[:, j] = top[v]
        if low:    # a wall has vertices of its own, so that its rim is sharp
            walls[:, j, 2] = -base
    start = rows * columns + 4 * np.arange(len(rim))
    faces.append(np.stack([start, start + 1, start + 2, start, start + 2, start + 3],
                          1).reshape(-1, 3))
    return (np.concatenate([top, walls.reshape(-1, 3)]), None, None, None,
            np.ascontiguousarray(np.concatenate(faces), np.uint32), True)


def _floats(value: Any) -> list[float]:
    return [float(x) for x in np.asarray(value).reshape(-1)]


def _unit(v: list[float]) -> list[float]:
    n = math.sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2])
    return [x / n for x in v]


def _cross(a: list[float], b: list[float]) -> list[float]:
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def _aimed(one: Any, two: Any, aspect: float) -> tuple[Array, Array, float, float, bool]:
    """View, projection, near, far and whether it is parallel, of the two cameras of stereo."""
    def mean(name: str) -> list[float]:
        return [(a + b) / 2 for a, b in zip(_floats(getattr(one, name)), _floats(getattr(two, name)))]
    pos, f = mean("pos"), _unit(mean("forward"))
    r = _unit(_cross(f, mean("up")))
    u = _cross(r, f)
    view, p = np.eye(4), np.zeros((4, 4))
    for k, axis in enumerate((r, u, f)):
        dot = axis[0] * pos[0] + axis[1] * pos[1] + axis[2] * pos[2]
        view[k, :3], view[k, 3] = (axis, -dot) if k < 2 else ([-x for x in axis], dot)
    near, far, top, bottom = (float(getattr(one, f"frustum_{n}"))
                              for n in ("near", "far", "top", "bottom"))
    half = float(one.frustum_width) or (top - bottom) / 2 * aspect
    center = (float(one.frustum_center) + float(two.frustum_center)) / 2
    scale = 1.0 if one.orthographic else near
    p[0, 0], p[1, 1] = scale / half, 2 * scale / (top - bottom)
    if one.orthographic:
        p[0, 3], p[1, 3], p[3, 3] = -center / half, -(top + bottom) / (top - bottom), 1
    else:
        p[0, 2], p[1, 2], p[3, 2] = center / half, (top + bottom) / (top - bottom), -1
    return view, p, near, far, bool(one.orthographic)


class _Kind(Error, TypeError):
    """An array of another type, which MuJoCo's own bindings refuse with a TypeError."""


class Renderer:
    """Renders MuJoCo scenes, as mujoco.Renderer does, without OpenGL."""

    def __init__(self, model: Any, height: int = 240, width: int = 320, max_geom: int = 10000,
                 font_scale: Any = None, depth_mapping: Any = None,
                 depth_precision: Any = None) -> None:
        """model is an MjModel.  The last three, which mujoco.Renderer has, are taken and not used."""
        buffer = getattr(getattr(model, "vis", None), "global_", None)
        for name, size, most in (("width", width, getattr(buffer, "offwidth", None)),
                                 ("height", height, getattr(buffer, "offheight", None))):
            if most is not None and size > most:
                raise Error(f"Image {name} {size} > framebuffer {name} {most}: reduce it, or specify a "
                            f"larger framebuffer in the model: <visual><global off{name}=\"{size}\"/>")
        self._base = _Base(height, width, srgb=False)
        self._closed = False
        self._model, self._max_geom = model, max_geom
        self._meshes: dict[tuple[int, int], int] = {}
        self._textures: dict[int, int] = {}
        self._depth = self._segmentation = False
        self._camera: Any = None
        self._pairs = np.full((1, 2), -1, np.int32)
        self._unnumbered: list[int] = []
        self._geoms = np.zeros(0, SOLID)
        self._mujoco: Any = None
        self._scene: Any = None
        self._filled = False
        self._base.background((0.0, 0.0, 0.0))
        types = list(getattr(model, "tex_type", ()))
        self._sky = self._texture(types.index(_SKYBOX)) if _SKYBOX in types else None

    @property
    def model(self) -> Any:
        """The model."""
        return self._model

    @property
    def height(self) -> int:
        """Rows of pictures."""
        return self._base.height

    @property
    def width(self) -> int:
        """Columns of pictures."""
        return self._base.width

    @property
    def scene(self) -> Any:
        """The MjvScene that update_scene fills."""
        if self._scene is None:
            self._mujoco = importlib.import_module("mujoco")
            self._scene = self._mujoco.MjvScene(self._model, maxgeom=self._max_geom)
            self._option = self._mujoco.MjvOption()
        return self._scene

    def _texture(self, i: int) -> int:
        if i not in self._textures:
            self._textures[i] = self._base._keep_texture(None, *_texels(self._model, i))
        return self._textures[i]

    def _shape(self, kind: int, number: int) -> int:
        if (kind, number) not in self._meshes:
            made = (_mesh if kind == _MESH else _ground)(self._model, number)
            self._meshes[kind, number] = self._base._keep_mesh(None, *made).number
        return self._meshes[kind, number]

    def _put(self, o: Any, g: Any) -> None:
        shape = g.type in (_MESH, _HEIGHT_FIELD)
        mapped = g.type == _MESH and g.texcoord
        size = _floats(g.size)
        o["kind"] = _KINDS[g.type]
        if shape:
            o["mesh"] = self._shape(g.type, g.dataid >> 1 if g.type == _MESH else g.dataid)
        o["texture"] = 1 + self._base._textures[self._texture(int(g.texid))][0] if g.texid >= 0 else 0
        o["size"] = (1, 1, 1) if shape else size
        if g.type == 0:
            o["size"][2] = 0
        o["turn"], o["place"] = np.asarray(g.mat).reshape(3, 3), g.pos
        o["rgba"], o["specular"], o["emission"] = g.rgba, g.specular, g.emission
        o["shininess"] = 128 * g.shininess
        for k, repeat in enumerate(_floats(g.texrepeat)):
            once = g.texuniform or mapped or shape or not size[k] > 0
            o["repeat"][k] = repeat / (1 if once else 2 * size[k])

    def take(self, scene: Any) -> None:
        """Takes any object with the fields of an mjvScene, in place of update_scene: ngeom, geoms,
        nlight, lights, camera and flags."""
        self._scene, self._filled = scene, True

    def _read(self, scene: Any) -> None:
        base = self._base
        geoms = [scene.geoms[i] for i in range(int(scene.ngeom))]
        geoms = [g for g in geoms if 0 <= g.type < len(_KINDS)]
        self._geoms = np.zeros(len(geoms), SOLID)
        self._geoms["id"] = np.arange(len(geoms))
        for i, g in enumerate(geoms):
            self._put(self._geoms[i], g)
        self._pairs = np.array([[-1, -1]] + [[g.objid, g.objtype] for g in geoms], np.int32)
        self._unnumbered = [i for i, g in enumerate(geoms) if getattr(g, "segid", i) < 0]
        lamps = [scene.lights[i] for i in range(min(int(scene.nlight), _LAMPS))]
        shadow = [i for i, lamp in enumerate(lamps)
                  if scene.flags[_SHADOWS] and lamp.castshadow and not lamp.headlight
                  and lamp.type <= _DIRECTIONAL]
        base.light([self._lamp(lamp) for lamp in lamps], shadow=shadow)
        if scene.flags[_SKIES] and self._sky is not None:
            base.sky_texture(self._sky)
        else:
            base.background((0.0, 0.0, 0.0))
        self._camera = _aimed(scene.camera[0], scene.camera[1], base.width / base.height)

    @staticmethod
    def _lamp(lamp: Any) -> Light:
        diffuse, specular, ambient = (tuple(_floats(getattr(lamp, k)))
                                      for k in ("diffuse", "specular", "ambient"))
        way, fall = _floats(lamp.dir), cast("tuple[float, float, float]", _floats(lamp.attenuation))
        if lamp.type == _DIRECTIONAL:
            return Light((-way[0], -way[1], -way[2], 0.0), diffuse, specular, ambient, *fall)
        cone: tuple[Any, ...] = ()
        if lamp.type == _SPOT and lamp.cutoff < 90:
            cone = (tuple(way), float(lamp.exponent), math.cos(float(lamp.cutoff) * math.pi / 180))
        return Light((*_floats(lamp.pos), 1.0), diffuse, specular, ambient, *fall, *cone)

    def update_scene(self, data: Any, camera: Any = -1, scene_option: Any = None) -> None:
        """Takes the state of data as a camera sees it: a number (-1: free), a name or an MjvCamera."""
        self._open("update_scene")
        scene, used = self.scene, camera
        mj = self._mujoco
        if mj is None:
            raise Error("update_scene: there is no engine beside a scene that take() was given")
        if isinstance(camera, (int, str)):
            number = camera if isinstance(camera, int) else \
                int(mj.mj_name2id(self._model, mj.mjtObj.mjOBJ_CAMERA, camera))
            if isinstance(camera, str) and number < 0:
                raise Error(f'camera "{camera}" does not exist')
            if number < -1 or number >= self._model.ncam:
                raise Error(f"camera {number} is out of range [-1, {self._model.ncam})")
            used = mj.MjvCamera()
            used.fixedcamid = number
            if number == -1:
                used.type = mj.mjtCamera.mjCAMERA_FREE
                mj.mjv_defaultFreeCamera(self._model, used)
            else:
                used.type = mj.mjtCamera.mjCAMERA_FIXED
        mj.mjv_updateScene(self._model, data, scene_option or self._option, None, used,
                           mj.mjtCatBit.mjCAT_ALL.value, scene)
        self._filled = True

    def render(self, *, out: Any = None) -> Array:
        """Colour, (height, width, 3) bytes; or depth, (height, width) float32 in metres; or
        segmentation, (height, width, 2) int32, pairs of object and type, (-1, -1) where there is
        nothing."""
        self._open("render")
        size = (self.height, self.width)
        shape, kind = (size, np.float32) if self._depth else \
            ((*size, 2), np.int32) if self._segmentation else ((*size, 3), np.uint8)
        if isinstance(out, np.ndarray) and out.shape == shape and out.dtype != kind:
            raise _Kind(f"out must be {np.dtype(kind)}, not {out.dtype}")
        to = arguments.into("out", out, shape, kind)
        if not self._filled:    # an empty scene, as in MuJoCo
            to[...] = -1 if self._segmentation else 0
            return to
        self._read(self._scene)
        solid = self._depth or self._segmentation
        if solid:    # what has no number is in colour alone, as MuJoCo draws it
            self._geoms["flags"][self._unnumbered] |= _HIDDEN
        frame = Frame(None if self._depth or self._segmentation else to, to if self._depth else None,
                      to if self._segmentation else None, None)
        view, projection, near, far, parallel = self._camera
        seen = view.T.ravel().tolist(), projection.T.ravel().tolist(), near, far, parallel
        self._base._draw(frame, seen, solid, far, self._geoms)
        if self._segmentation:
            to[...] = self._pairs[to[..., 0] + 1]
        return to

    def enable_depth_rendering(self) -> None:
        """From now on render() gives depth."""
        self._depth, self._segmentation = True, False

    def disable_depth_rendering(self) -> None:
        """From now on render() gives colour."""
        self._depth = False

    def enable_segmentation_rendering(self) -> None:
        """From now on render() gives pairs of object and type."""
        self._depth, self._segmentation = False, True

    def disable_segmentation_rendering(self) -> None:
        """From now on render() gives colour."""
        self._segmentation = False

    def close(self) -> None:
        """From now on nothing is drawn, and the memory is given back."""
        self._closed = True
        self._base = _Base(1, 1, srgb=False)

    def _open(self, name: str) -> None:
        if self._closed:
            raise RuntimeError(f"{name} cannot be called after close.")

    def __enter__(self) -> Renderer:
        """Itself."""
        return self

    def __exit__(self, *_: object) -> None:
        """Closes it."""
        self.close()
