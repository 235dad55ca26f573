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

import ctypes
import importlib
from typing import Any

import numpy as np

from . import _arguments as arguments
from ._native import SOLID, Array, Error, MeshPart, asked, library, pointer
from .renderer import Frame, Renderer as _Base

_HEIGHT_FIELD, _MESH, _SKYBOX, _SHADOWS, _SKIES = 1, 7, 2, 0, 4    # of MuJoCo's enums
# What mjv.h knows of an mjvGeom, an mjvLight and an mjvGLCamera, in its order, and how many numbers that is
_NUMBERS = {
    "geoms": ("type dataid texid texuniform segid objid objtype specular shininess emission size pos mat rgba texrepeat", 31),
    "lights": ("type headlight castshadow cutoff exponent pos dir ambient diffuse specular attenuation", 23),
    "camera": ("frustum_near frustum_far frustum_top frustum_bottom frustum_center frustum_width orthographic pos "
               "forward up", 16),
}


def _rows(name: str, scene: Any, count: int) -> Array:
    """The numbers of the first objects of a scene, a row for each."""
    fields, width = _NUMBERS[name]
    if not count:
        return np.zeros((0, width))
    objects = getattr(scene, name)
    some = [objects[i] for i in range(count)]
    try:  # column by column: a row at a time takes twice as long
        rows: Array = np.concatenate([
            np.array([getattr(one, field, 0) if field == "segid" else getattr(one, field) for one in some],
                     np.float64).reshape(count, -1) for field in fields.split()], axis=1)
    except ValueError:
        rows = np.zeros((0, 0))
    if rows.shape[1] != width:
        raise Error(f"{name} must have the fields of an mjvScene's")
    return rows


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
        self._numbers: dict[tuple[int, int], int] = {}    # of meshes and ground in the base
        self._textures: set[int] = set()
        self._depth = self._segmentation = False
        self._mujoco: Any = None
        self._scene: Any = None
        self._filled = False
        types = list(getattr(model, "tex_type", ()))
        self._sky = types.index(_SKYBOX) if _SKYBOX in types else -1

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

    @property
    def _at(self) -> Any:
        return self._base._scene.handle

    def _part(self, name: str, of: str, i: int, kind: Any) -> Array:
        """Rows of an array of the model that belong to its mesh i."""
        first, count = (int(getattr(self._model, f"mesh_{of}{end}")[i]) for end in ("adr", "num"))
        rows = np.asarray(getattr(self._model, f"mesh_{name}")).reshape(-1, 2 if name == "texcoord" else 3)
        return np.array(rows[first:first + count], kind)

    def _texture(self, i: int) -> int:
        if i not in self._textures:
            m = self._model
            width, height, channels, first, kind = (
                int(getattr(m, f"tex_{k}")[i]) for k in ("width", "height", "nchannel", "adr", "type"))
            texels = np.array(np.ravel(m.tex_data)[first:first + width * height * channels], np.uint8)
            if not library.python_mjv_texture(self._at, i, pointer(texels), width, height, channels, kind):
                raise MemoryError("memory is not enough for the texture")
            self._textures.add(i)
        return i

    def _shape(self, kind: int, i: int) -> int:
        """The number of a mesh or ground of the model, which is made where it is wanted."""
        number = self._numbers.get((kind, i))
        if number is None:
            number = len(self._numbers)
            (self._put_mesh if kind == _MESH else self._put_ground)(number, i)
            self._numbers[kind, i] = number
        return number

    def _put_mesh(self, number: int, i: int) -> None:
        rows: list[Any] = [self._part("vert", "vert", i, np.float32), self._part("normal", "normal", i, np.float32), None,
                           self._part("face", "face", i, np.int32), self._part("facenormal", "face", i, np.int32), None]
        if self._model.mesh_texcoordadr[i] >= 0 and self._model.mesh_texcoordnum[i] > 0:
            rows[2] = self._part("texcoord", "texcoord", i, np.float32)
            rows[5] = self._part("facetexcoord", "face", i, np.int32)
        part = MeshPart(*map(pointer, rows), *(0 if rows[k] is None else len(rows[k]) for k in range(3)), rows[3].size)
        done = library.python_mjv_mesh(self._at, number, ctypes.byref(part))
        if done < 0:
            raise Error(f"model: a face of mesh {i} has no vertex, normal or texcoord")
        if not done:
            raise MemoryError("memory is not enough for the mesh")

    def _put_ground(self, number: int, i: int) -> None:
        rows, columns, first = (int(getattr(self._model, f"hfield_{k}")[i]) for k in ("nrow", "ncol", "adr"))
        heights = np.array(np.ravel(self._model.hfield_data)[first:first + rows * columns], np.float32)
        self._base._heights(number, heights.reshape(rows, columns), *np.reshape(self._model.hfield_size, (-1, 4))[i])

    def take(self, scene: Any) -> None:
        """Takes any object with the fields of an mjvScene, in place of update_scene: ngeom, geoms,
        nlight, lights, camera and flags."""
        self._scene, self._filled = scene, True

    def _read(self, scene: Any, solid: bool) -> tuple[Array, Array, Array]:
        """Records of the geoms, object and type of each after (-1, -1), and what they are seen by; lamps and
        sky are set."""
        geoms = _rows("geoms", scene, int(scene.ngeom))
        for row, (kind, i, texture) in zip(geoms, geoms[:, :3].astype(int).tolist()):
            if kind in (_MESH, _HEIGHT_FIELD):
                row[1] = self._shape(kind, i >> 1 if kind == _MESH else i)
            if texture >= 0:
                self._texture(texture)
        records, pairs = np.zeros(len(geoms), SOLID), np.zeros((len(geoms) + 1, 2), np.int32)
        count = library.python_mjv_records(pointer(geoms), len(geoms), solid, pointer(records), pointer(pairs))
        lamps = _rows("lights", scene, int(scene.nlight))
        asked(library.python_mjv_lights, self._at, lamps, len(lamps), int(scene.flags[_SHADOWS]))
        sky = self._texture(self._sky) if scene.flags[_SKIES] and self._sky >= 0 else -1
        black, cameras, seen = np.array([0, 0, 0, 1] + 6 * [0], np.float32), _rows("camera", scene, 2), np.empty(35)
        library.python_scene_behind(self._at, 0 if sky < 0 else 2, sky, pointer(black))
        library.python_mjv_aim(pointer(cameras), self.width / self.height, pointer(seen))
        return records[:count], pairs, seen

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
        solid = self._depth or self._segmentation    # then what has no number is left out, as MuJoCo does it
        records, pairs, seen = self._read(self._scene, solid)
        frame = Frame(None if solid else to, to if self._depth else None, to if self._segmentation else None, None)
        self._base._draw(frame, (seen[:16], seen[16:32], seen[32], seen[33], bool(seen[34])), solid, seen[33], records)
        if self._segmentation:
            to[...] = pairs[to[..., 0] + 1]
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

    def __getstate__(self) -> dict[str, Any]:
        """All but what the base has of the model, which is made anew."""
        return {**self.__dict__, "_numbers": {}, "_textures": set()}

    def __enter__(self) -> Renderer:
        """Itself."""
        return self

    def __exit__(self, *_: object) -> None:
        """Closes it."""
        self.close()
