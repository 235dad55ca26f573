"""pyrender's names without OpenGL.

    import shade_h.compat.pyrender as pyrender

Scenes, nodes, meshes, points, cameras, lights and OffscreenRenderer are there.  Light is Blinn-Phong
in place of pyrender's physically based materials, so that colours are close and not equal; depth and
segmentation are the same up to the edges of pixels.  Viewer opens no window: it draws one picture.
There is no skin, no wireframe, no map but that of the base colour and no alpha of vertices.
"""
from __future__ import annotations

import functools
import math
import warnings
from dataclasses import replace
from typing import Any, Iterable, List, Sequence

import numpy as np

from .. import _arguments as arguments
from .._native import SOLID, Array, Error
from ..light import Light as _Lamp
from ..mesh import counted
from ..renderer import _KINDS, _NO_SHADOW, Frame, Renderer as _Renderer

_BALL = _KINDS["sphere"]


class RenderFlags:
    """What OffscreenRenderer.render is asked for; flags may be added."""

    NONE, DEPTH_ONLY, OFFSCREEN, FLIP_WIREFRAME, ALL_WIREFRAME, ALL_SOLID = 0, 1, 2, 4, 8, 16
    SHADOWS_DIRECTIONAL, SHADOWS_POINT, SHADOWS_SPOT, SHADOWS_ALL = 32, 64, 128, 224
    VERTEX_NORMALS, FACE_NORMALS, SKIP_CULL_FACES, RGBA, FLAT, SEG = 256, 512, 1024, 2048, 4096, 8192


class GLTF:
    """The modes of a Primitive, of which POINTS and TRIANGLES are drawn and the others refused."""

    POINTS, LINES, LINE_LOOP, LINE_STRIP, TRIANGLES, TRIANGLE_STRIP, TRIANGLE_FAN = range(7)


class Texture:
    """A picture: bytes, or what numpy makes an array of."""

    def __init__(self, name: str | None = None, sampler: Any = None, source: Any = None,
                 source_channels: str | None = None, width: int | None = None,
                 height: int | None = None, **others: Any) -> None:
        """Keeps source; the rest is taken and not used."""
        self.name, self.source = name, source


def _vector(name: str, value: Any, length: int) -> Array:
    """A colour of so many channels, 0 .. 1: whole numbers are bytes, and what is missing is 1."""
    given: Array = np.atleast_1d(np.asarray(value)).ravel()
    if np.issubdtype(given.dtype, np.integer):
        given = given / 255.0
    if given.size == 1:
        given = np.repeat(given, length)
    whole = np.concatenate([given, np.ones(max(0, length - given.size))])[:length]
    return arguments.doubles(name, whole, (length,), finite=True)


class _Attribute:
    """An attribute of an object that is checked when it is set: checked returns what it becomes."""

    def __set_name__(self, owner: type, name: str) -> None:
        self.name = name

    def __get__(self, one: Any, kind: type | None = None) -> Any:
        return one.__dict__[self.name]

    def __set__(self, one: Any, value: Any) -> None:
        one.__dict__[self.name] = self.checked(one, value)

    def checked(self, one: Any, value: Any) -> Any:
        raise NotImplementedError


class _Number(_Attribute):
    """A number of an object within bounds, which may be attributes of it; those that are open do not
    belong to the range.  As in pyrender None is a TypeError, a number out of range a ValueError."""

    def __init__(self, low: float | str, high: float | str, open_low: bool = True, none: bool = False) -> None:
        self.low, self.high, self.open_low, self.none = low, high, open_low, none

    def checked(self, one: Any, value: Any) -> Any:
        if value is None and self.none:
            return None
        if value is None:
            raise TypeError(f"{self.name} must be a number, not None")
        low, high = (one.__dict__.get(end, math.inf) if isinstance(end, str) else end
                     for end in (self.low, self.high))
        got = arguments.number(self.name, value, low, high)
        if self.open_low and got <= low:
            raise Error(f"{self.name} must be above {low:g}, not {got:g}")
        return got


class _Slot(_Attribute):
    """An object of one kind, or None."""

    def __init__(self, kind: type) -> None:
        self.kind = kind

    def checked(self, one: Any, value: Any) -> Any:
        if value is not None and not isinstance(value, self.kind):
            raise TypeError(f"{self.name} must be a {self.kind.__name__}, not {arguments.shown(value)}")
        return value


class _Colour(_Attribute):
    """A colour of 3 or 4 channels."""

    def __init__(self, channels: int) -> None:
        self.channels = channels

    def checked(self, one: Any, value: Any) -> Any:
        if value is None:
            raise Error(f"{self.name} must be a colour, not None")
        return _vector(self.name, value, self.channels)


class _Rows(_Attribute):
    """An array with a row for each position, or None; of rows that are too long the start, where cut."""

    def __init__(self, columns: int, cut: bool = False) -> None:
        self.columns, self.cut = columns, cut

    def checked(self, one: Any, value: Any) -> Any:
        if value is None:
            return None
        given = np.asarray(value)
        if self.cut and given.ndim == 2:
            given = given[:, :self.columns]
        return arguments.floats(self.name, given, (len(one.positions), self.columns))


class _VertexColours(_Attribute):
    """Factors of the base colour with alpha: a row for each position, or one for all; or None."""

    def checked(self, one: Any, value: Any) -> Any:
        if value is None:
            return None
        given, count = np.asarray(value), len(one.positions)
        if np.issubdtype(given.dtype, np.integer):
            given = given / 255.0
        if given.ndim == 1:
            given = np.tile(given, (count, 1))
        if given.ndim == 2 and given.shape[1] == 3:
            given = np.concatenate([given, np.ones((len(given), 1))], 1)
        got = arguments.floats(self.name, given, (count, 4), finite=True)
        if (got[:, 3] != 1).any():
            warnings.warn(f"{self.name}: its alpha is not drawn", stacklevel=3)
        return got


class _Poses(_Attribute):
    """Places of one primitive, or None: one matrix is a list of one."""

    def checked(self, one: Any, value: Any) -> Any:
        if value is None:
            return None
        given = np.asarray(value)
        return arguments.doubles(self.name, given[None] if given.ndim == 2 else given, (None, 4, 4), True)


class _AlphaMode(_Attribute):
    """A word of glTF."""

    def checked(self, one: Any, value: Any) -> Any:
        if arguments.choice(self.name, value, ["OPAQUE", "BLEND", "MASK"]) == "MASK":
            warnings.warn("alphaMode: MASK is drawn as OPAQUE", stacklevel=3)
        return value


def _picture(given: Any) -> Any:
    """What numpy makes of a picture: a Texture's source, Pillow's as RGBA."""
    source = getattr(given, "source", given)
    if hasattr(source, "convert"):
        source = source.convert("RGBA")
    return None if source is None else np.asarray(source)


class MetallicRoughnessMaterial:
    """baseColorFactor is a colour, 0 .. 1, with alpha.  baseColorTexture, emissiveTexture and
    normalTexture, whose green is up, are arrays of bytes, pictures of Pillow's or a Texture."""

    baseColorFactor, emissiveFactor, alphaMode = _Colour(4), _Colour(3), _AlphaMode()
    metallicFactor, roughnessFactor = _Number(0, 1, open_low=False), _Number(0, 1, open_low=False)
    alphaCutoff, doubleSided = _Number(0, 1, open_low=False), _Slot(bool)

    def __init__(self, name: str | None = None, normalTexture: Any = None, occlusionTexture: Any = None,
                 emissiveTexture: Any = None, emissiveFactor: Any = 0.0, alphaMode: str = "OPAQUE",
                 alphaCutoff: float = 0.5, doubleSided: bool = False, smooth: bool = True,
                 wireframe: bool = False, baseColorFactor: Any = 1.0, baseColorTexture: Any = None,
                 metallicFactor: float = 1.0, roughnessFactor: float = 1.0,
                 metallicRoughnessTexture: Any = None) -> None:
        """The order is pyrender's.  A warning names what is given and not drawn."""
        self.occlusionTexture, self.metallicRoughnessTexture = occlusionTexture, metallicRoughnessTexture
        self.smooth, self.wireframe = smooth, wireframe
        lost = [k for k, v in vars(self).items() if k != "smooth" and v is not None and v is not False]
        if lost:
            warnings.warn(f"material: {', '.join(lost)} left out", stacklevel=2)
        self.name, self.baseColorFactor, self.emissiveFactor = name, baseColorFactor, emissiveFactor
        self.metallicFactor, self.roughnessFactor = metallicFactor, roughnessFactor
        self.alphaMode, self.alphaCutoff, self.doubleSided = alphaMode, alphaCutoff, doubleSided
        self.baseColorTexture, self.normalTexture, self.emissiveTexture = map(
            _picture, (baseColorTexture, normalTexture, emissiveTexture))

    @property
    def is_transparent(self) -> bool:
        """Whether what lies behind shows through."""
        return bool(self.alphaMode == "BLEND" and self.baseColorFactor[3] < 1)


Material = MetallicRoughnessMaterial


class _Surface(_Slot):
    """A material; None is one of white metal."""

    def checked(self, one: Any, value: Any) -> Any:
        return super().checked(one, MetallicRoughnessMaterial() if value is None else value)


class _Bounded:
    """What has bounds has these."""

    @property
    def bounds(self) -> Array:
        """(2, 3): the lowest and the highest coordinates."""
        raise NotImplementedError

    @property
    def centroid(self) -> Array:
        """The middle of the bounds."""
        return np.asarray(self.bounds.mean(0))

    @property
    def extents(self) -> Array:
        """The sides of the bounds."""
        return np.asarray(self.bounds[1] - self.bounds[0])

    @property
    def scale(self) -> float:
        """The diagonal of the bounds."""
        return float(np.linalg.norm(self.extents))


class Primitive(_Bounded):
    """Triangles: positions (n, 3), and normals, texcoord_0, color_0 and indices (m, 3) or None.  With
    mode GLTF.POINTS, points."""

    normals, tangents, texcoord_0, texcoord_1 = _Rows(3), _Rows(4), _Rows(2, cut=True), _Rows(2)
    color_0, material, poses = _VertexColours(), _Surface(MetallicRoughnessMaterial), _Poses()

    def __init__(self, positions: Any, normals: Any = None, tangents: Any = None,
                 texcoord_0: Any = None, texcoord_1: Any = None, color_0: Any = None,
                 joints_0: Any = None, weights_0: Any = None, indices: Any = None,
                 material: Any = None, mode: Any = None, targets: Any = None,
                 poses: Any = None) -> None:
        """Refuses arrays of a wrong shape by their names."""
        self.positions = arguments.doubles("positions", positions, (None, 3), finite=True).copy()
        self.mode = GLTF.TRIANGLES if mode is None else arguments.integer("mode", mode, 0, 6)
        if self.mode not in (GLTF.POINTS, GLTF.TRIANGLES):
            raise Error(f"mode must be GLTF.POINTS or GLTF.TRIANGLES, not {self.mode}")
        count = len(self.positions)
        given = np.arange(count - count % 3).reshape(-1, 3) if indices is None else indices
        self.indices = arguments.faces("indices", given, count)
        self.normals, self.tangents = normals, tangents
        self.texcoord_0, self.texcoord_1, self.color_0 = texcoord_0, texcoord_1, color_0
        self.material, self.poses, self.targets = material, poses, targets
        self.joints_0, self.weights_0 = joints_0, weights_0

    @property
    def bounds(self) -> Array:
        """(2, 3): the lowest and the highest coordinates, of all poses."""
        low, high = self.positions.min(0), self.positions.max(0)
        if self.poses is None:
            return np.array([low, high], float)
        return _bounds_of(_moved(pose, low, high) for pose in self.poses)

    @property
    def is_transparent(self) -> bool:
        """Whether its material is, or one of its colours."""
        painted = self.color_0 is not None and bool((self.color_0[:, 3] != 1).any())
        return painted or bool(self.material.is_transparent)


def _moved(pose: Array, low: Any, high: Any) -> Array:
    """The corners of bounds in another place."""
    corners = np.stack(np.meshgrid(*np.stack([low, high], 1), indexing="ij"), -1).reshape(-1, 3)
    return np.asarray(corners @ pose[:3, :3].T + pose[:3, 3])


def _bounds_of(corners: Iterable[Array]) -> Array:
    points = list(corners)
    if not points:
        return np.zeros((2, 3))
    whole = np.concatenate(points)
    return np.array([whole.min(0), whole.max(0)])


class Mesh(_Bounded):
    """Primitives that share a name and a place."""

    def __init__(self, primitives: Iterable[Primitive], name: str | None = None,
                 weights: Any = None, is_visible: bool = True) -> None:
        """Keeps the primitives."""
        self.primitives, self.name, self.is_visible = list(primitives), name, bool(is_visible)
        self.weights = weights

    @property
    def bounds(self) -> Array:
        """(2, 3): the lowest and the highest coordinates."""
        return _bounds_of(p.bounds for p in self.primitives)

    @property
    def is_transparent(self) -> bool:
        """Whether one of its primitives is."""
        return any(p.is_transparent for p in self.primitives)

    @staticmethod
    def from_points(points: Any, colors: Any = None, normals: Any = None, is_visible: bool = True,
                    poses: Any = None) -> Mesh:
        """Points, as wide as the point_size of the renderer, with a colour each or one for all."""
        return Mesh([Primitive(points, color_0=colors, mode=GLTF.POINTS, poses=poses)],
                    is_visible=is_visible)

    @staticmethod
    def from_trimesh(mesh: Any, material: Any = None, is_visible: bool = True, poses: Any = None,
                     wireframe: bool = False, smooth: bool = True) -> Mesh:
        """A mesh of a trimesh.Trimesh, or of a list of them.  Colours of faces need smooth False."""
        all_of = mesh if isinstance(mesh, (list, tuple, set, np.ndarray)) else [mesh]
        return Mesh([_primitive(m, material, poses, smooth) for m in all_of], is_visible=is_visible)


def _primitive(mesh: Any, material: Any, poses: Any, smooth: bool) -> Primitive:
    if not hasattr(mesh, "vertices") or not hasattr(mesh, "faces"):
        raise TypeError(f"mesh must be a Trimesh or a list of them, not {arguments.shown(mesh)}")
    vertices, faces = np.asarray(mesh.vertices), np.asarray(mesh.faces)
    visual, colors, uv = getattr(mesh, "visual", None), None, None
    if not getattr(visual, "defined", True):
        visual = None
    kind = getattr(visual, "kind", None)
    normals = np.asarray(mesh.vertex_normals) if smooth and hasattr(mesh, "vertex_normals") else None
    if visual is not None and kind == "vertex":
        colors = np.asarray(visual.vertex_colors)
    elif visual is not None and kind == "face":
        if smooth:
            raise Error("smooth must be False for a mesh with colours of faces")
        colors = np.repeat(np.asarray(visual.face_colors), 3, axis=0)
    elif visual is not None and kind == "texture" and getattr(visual, "uv", None) is not None:
        uv, own = np.asarray(visual.uv), visual.material
        image = getattr(own, "image", None)
        image = getattr(own, "baseColorTexture", None) if image is None else image
        if material is None and image is not None:
            material = MetallicRoughnessMaterial(alphaMode="BLEND", baseColorTexture=image)
    if material is None:    # pyrender's own
        material = MetallicRoughnessMaterial(alphaMode="BLEND", baseColorFactor=(0.3, 0.3, 0.3, 1.0),
                                             metallicFactor=0.2, roughnessFactor=0.8)
    if not smooth:
        corners = vertices[faces]
        across: Array = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        length = np.linalg.norm(across, axis=1, keepdims=True)
        normals = np.repeat(across / np.where(length > 0, length, 1), 3, axis=0)
        if colors is not None and kind == "vertex":
            colors = colors[faces.ravel()]
        uv = None if uv is None else uv[faces.ravel()]
        vertices, faces = corners.reshape(-1, 3), np.arange(faces.size).reshape(-1, 3)
    return Primitive(vertices, normals, texcoord_0=uv, color_0=colors, indices=faces,
                     material=material, poses=poses)


class Camera:
    """What the cameras have in common: znear, zfar and a matrix of OpenGL."""

    znear, zfar = _Number(0, 1e9, open_low=False), _Number("znear", 1e12, none=True)

    def __init__(self, znear: float = 0.05, zfar: float | None = None, name: str | None = None) -> None:
        """zfar None: everything is seen, however far."""
        self.znear, self.zfar, self.name = znear, zfar, name

    def get_projection_matrix(self, width: int | None = None, height: int | None = None) -> Array:
        """The matrix for a picture of a size."""
        raise NotImplementedError

    def _depth(self, p: Array) -> Array:
        n, f = self.znear, self.zfar
        p[2, 2], p[2, 3], p[3, 2] = -1.0, -2 * n, -1.0
        if f is not None:
            p[2, 2:] = (f + n) / (n - f), 2 * f * n / (n - f)
        return p


class PerspectiveCamera(Camera):
    """yfov is the vertical angle in radians; without aspectRatio that of the picture is taken."""

    yfov, aspectRatio = _Number(0, 3.14), _Number(0, 1e6, none=True)

    def __init__(self, yfov: float, znear: float = 0.05, zfar: float | None = None,
                 aspectRatio: float | None = None, name: str | None = None) -> None:
        """A camera that looks down -z."""
        super().__init__(znear, zfar, name)
        self.yfov, self.aspectRatio = yfov, aspectRatio

    def get_projection_matrix(self, width: int | None = None, height: int | None = None) -> Array:
        """The matrix for a picture of a size."""
        aspect = self.aspectRatio
        if aspect is None:
            if not width or not height:
                raise Error("aspectRatio is missing, and the size of the picture too")
            aspect = width / height
        p, t = np.zeros((4, 4)), math.tan(self.yfov / 2)
        p[0, 0], p[1, 1] = 1 / (aspect * t), 1 / t
        return self._depth(p)


class IntrinsicsCamera(Camera):
    """fx, fy, cx and cy in pixels."""

    fx, fy, cx, cy = _Number(0, 1e9), _Number(0, 1e9), _Number(-1e9, 1e9), _Number(-1e9, 1e9)

    def __init__(self, fx: float, fy: float, cx: float, cy: float, znear: float = 0.05,
                 zfar: float | None = 100.0, name: str | None = None) -> None:
        """A camera that looks down -z."""
        super().__init__(znear, zfar, name)
        self.fx, self.fy, self.cx, self.cy = fx, fy, cx, cy

    def get_projection_matrix(self, width: int | None = None, height: int | None = None) -> Array:
        """The matrix for a picture of a size."""
        if not width or not height:
            raise Error("width and height are needed")
        p = np.zeros((4, 4))
        p[0, 0], p[1, 1] = 2 * self.fx / width, 2 * self.fy / height
        p[0, 2], p[1, 2] = 1 - 2 * self.cx / width, 2 * self.cy / height - 1
        return self._depth(p)


class OrthographicCamera(Camera):
    """xmag and ymag are half the width and height of what is seen."""

    xmag, ymag = _Number(0, 1e12), _Number(0, 1e12)
    znear, zfar = _Number(0, 1e9), _Number("znear", 1e12)

    def __init__(self, xmag: float, ymag: float, znear: float = 0.05, zfar: float = 100.0,
                 name: str | None = None) -> None:
        """A camera that looks down -z."""
        super().__init__(znear, zfar, name)
        self.xmag, self.ymag = xmag, ymag

    def get_projection_matrix(self, width: int | None = None, height: int | None = None) -> Array:
        """The matrix for a picture of a size."""
        n, f = self.znear, self.zfar
        p = np.diag([1 / self.xmag, 1 / self.ymag, 2 / (n - f), 1.0])
        p[2, 3] = (f + n) / (n - f)
        return p


class Light:
    """color, 0 .. 1, times intensity."""

    color, intensity, range = _Colour(3), _Number(0, 1e12, open_low=False), _Number(0, 1e12, none=True)

    def __init__(self, color: Any = None, intensity: float = 1.0, range: float | None = None,
                 name: str | None = None) -> None:
        """range is taken and not used."""
        self.color = 1.0 if color is None else color
        self.intensity, self.range, self.name = intensity, range, name


class DirectionalLight(Light):
    """A distant lamp that shines along -z of its node."""


class PointLight(Light):
    """A lamp at its node."""


class SpotLight(Light):
    """A lamp that points along -z of its node; angles in radians from the axis."""

    innerConeAngle = _Number(0, "outerConeAngle", open_low=False)
    outerConeAngle = _Number(0, math.pi / 2 + 1e-9, open_low=False)

    def __init__(self, color: Any = None, intensity: float = 1.0, range: float | None = None,
                 innerConeAngle: float = 0.0, outerConeAngle: float = math.pi / 4,
                 name: str | None = None) -> None:
        """Light falls from innerConeAngle to nothing at outerConeAngle."""
        super().__init__(color, intensity, range, name)
        self.outerConeAngle, self.innerConeAngle = outerConeAngle, innerConeAngle


@functools.lru_cache(maxsize=64)
def _falloff(inner: float, outer: float) -> float:
    """The exponent whose power of the cosine is nearest to pyrender's fall of a spot's light."""
    low = math.cos(outer)
    cosine = np.linspace(low, 1, 200)
    wanted = np.clip((cosine - low) / max(0.001, math.cos(inner) - low), 0, 1) ** 2
    tried = np.concatenate([[0], np.geomspace(0.1, 400, 120)])
    error = ((cosine[None] ** tried[:, None] - wanted) ** 2).sum(1)
    return float(tried[error.argmin()])


class Node:
    """A mesh, a camera or a light in its place, and the nodes that move with it."""

    camera, mesh, light = _Slot(Camera), _Slot(Mesh), _Slot(Light)

    def __init__(self, name: str | None = None, camera: Any = None, children: Any = None,
                 skin: Any = None, matrix: Any = None, mesh: Any = None, rotation: Any = None,
                 scale: Any = None, translation: Any = None, weights: Any = None,
                 light: Any = None) -> None:
        """matrix is 4 x 4, from the node to its parent; without it rotation, a unit quaternion
        x, y, z, w, scale and translation, three numbers each, make it."""
        self.name, self.camera, self.mesh, self.light = name, camera, mesh, light
        self.skin, self.weights = skin, weights
        self.children = list(children or ())
        self._rotation = np.array([0.0, 0.0, 0.0, 1.0])
        self._scale, self._translation = np.ones(3), np.zeros(3)
        if matrix is not None:
            self.matrix = matrix
            return
        self.rotation = self._rotation if rotation is None else rotation
        self.scale = self._scale if scale is None else scale
        self.translation = self._translation if translation is None else translation

    @property
    def matrix(self) -> Array:
        """From the node to its parent: a copy, so that it is set as a whole."""
        return self._matrix.copy()

    @matrix.setter
    def matrix(self, value: Any) -> None:
        m = arguments.doubles("matrix", value, (4, 4), finite=True).copy()
        if not np.allclose(m[3], (0, 0, 0, 1)):
            raise Error("matrix must have 0, 0, 0, 1 in its last row: a translation is the last column")
        self._scale = np.linalg.norm(m[:3, :3], axis=0)
        self._translation = m[:3, 3].copy()
        self._rotation = _quaternion(m[:3, :3] / np.where(self._scale > 0, self._scale, 1))
        self._matrix = m

    def _compose(self) -> None:
        x, y, z, w = self._rotation
        turn = np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                         [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                         [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])
        self._matrix = np.eye(4)
        self._matrix[:3, :3], self._matrix[:3, 3] = turn * self._scale, self._translation

    @property
    def rotation(self) -> Array:
        """A unit quaternion x, y, z, w."""
        return self._rotation

    @rotation.setter
    def rotation(self, value: Any) -> None:
        q = arguments.doubles("rotation", value, (4,), finite=True).copy()
        if abs(np.linalg.norm(q) - 1) > 1e-3:
            raise Error("rotation must be a unit quaternion x, y, z, w")
        self._rotation = q
        self._compose()

    @property
    def scale(self) -> Array:
        """Factors along x, y and z."""
        return self._scale

    @scale.setter
    def scale(self, value: Any) -> None:
        self._scale = arguments.doubles("scale", value, (3,), finite=True).copy()
        self._compose()

    @property
    def translation(self) -> Array:
        """The place in the parent."""
        return self._translation

    @translation.setter
    def translation(self, value: Any) -> None:
        self._translation = arguments.doubles("translation", value, (3,), finite=True).copy()
        self._compose()


def _quaternion(turn: Array) -> Array:
    """x, y, z, w of a rotation: of four products the largest is divided by."""
    m = turn
    own = np.array([[m[0, 0] - m[1, 1] - m[2, 2], m[0, 1] + m[1, 0], m[0, 2] + m[2, 0],
                     m[2, 1] - m[1, 2]],
                    [0, m[1, 1] - m[0, 0] - m[2, 2], m[1, 2] + m[2, 1], m[0, 2] - m[2, 0]],
                    [0, 0, m[2, 2] - m[0, 0] - m[1, 1], m[1, 0] - m[0, 1]],
                    [0, 0, 0, m[0, 0] + m[1, 1] + m[2, 2]]])
    own = own + np.triu(own, 1).T + np.eye(4)
    row = own[np.diag(own).argmax()]
    return np.asarray(row / max(float(np.linalg.norm(row)), 1e-30))


class _Nodes(List[Node]):
    """Nodes in the order in which they were added, equal to a set of them, as pyrender's are."""

    def __eq__(self, other: object) -> bool:
        return set(self) == other if isinstance(other, (set, frozenset)) else super().__eq__(other)

    __hash__ = None


class Scene(_Bounded):
    """Nodes, a background and ambient light."""

    def __init__(self, nodes: Iterable[Node] | None = None, bg_color: Any = None,
                 ambient_light: Any = None, name: str | None = None) -> None:
        """bg_color and ambient_light are colours, 0 .. 1."""
        self.bg_color, self.ambient_light = bg_color, ambient_light
        self.name = name
        self._main: Node | None = None
        given = list(nodes or ())
        below = {id(child) for node in given for child in node.children}
        self._roots: list[Node] = [node for node in given if id(node) not in below]
        self._walk(given)

    @staticmethod
    def from_trimesh_scene(trimesh_scene: Any, bg_color: Any = None,
                           ambient_light: Any = None) -> Scene:
        """A scene of all nodes with geometry of a trimesh.Scene."""
        scene = Scene(bg_color=bg_color, ambient_light=ambient_light)
        made = {name: Mesh.from_trimesh(one, smooth=getattr(getattr(one, "visual", None), "kind", "") != "face")
                for name, one in trimesh_scene.geometry.items()}
        for node in trimesh_scene.graph.nodes_geometry:
            pose, name = trimesh_scene.graph[node]
            scene.add(made[name], pose=pose)
        return scene

    @property
    def bg_color(self) -> Array:
        """The colour behind all, with alpha."""
        return self._bg_color

    @bg_color.setter
    def bg_color(self, value: Any) -> None:
        self._bg_color = _vector("bg_color", 1.0 if value is None else value, 4)

    @property
    def ambient_light(self) -> Array:
        """Light from everywhere."""
        return self._ambient_light

    @ambient_light.setter
    def ambient_light(self, value: Any) -> None:
        self._ambient_light = _vector("ambient_light", 0.0 if value is None else value, 3)

    @property
    def main_camera_node(self) -> Node | None:
        """The node whose camera is drawn by: the first one, until another is set."""
        cameras = self.camera_nodes
        if self._main is not None and self._main in cameras:
            return self._main
        return next(iter(cameras), None)

    @main_camera_node.setter
    def main_camera_node(self, value: Node) -> None:
        if not self.has_node(value) or value.camera is None:
            raise ValueError("main_camera_node must be in the scene and have a camera")
        self._main = value

    @property
    def bounds(self) -> Array:
        """(2, 3): the lowest and the highest coordinates of all meshes."""
        return _bounds_of(_moved(pose, *n.mesh.bounds) for n, pose in self._walk() if n.mesh is not None)

    @property
    def meshes(self) -> set[Mesh]:
        """All meshes."""
        return {n.mesh for n in self.mesh_nodes}

    @property
    def cameras(self) -> set[Camera]:
        """All cameras."""
        return {n.camera for n in self.camera_nodes}

    @property
    def lights(self) -> set[Light]:
        """All lights."""
        return {n.light for n in self.light_nodes}

    def has_node(self, node: Node) -> bool:
        """Whether a node is in the scene."""
        return any(node is n for n in self.nodes)

    def clear(self) -> None:
        """Takes all nodes out."""
        self._roots, self._main = [], None

    def _walk(self, wanted: Sequence[Node] = ()) -> list[tuple[Node, Array]]:
        """All nodes with their poses; those that are wanted must be among them."""
        out, left = [], [(n, np.eye(4)) for n in reversed(self._roots)]
        seen: set[int] = set()
        while left:
            node, parent = left.pop()
            if id(node) in seen:
                raise ValueError(f"node {node.name or ''} is in the scene twice: a node has one parent, "
                                 "and is not below itself")
            seen.add(id(node))
            pose = parent @ node.matrix
            out.append((node, pose))
            left += [(child, pose) for child in reversed(node.children)]
        if any(id(node) not in seen for node in wanted):
            raise ValueError("a node is below itself")
        return out

    @property
    def nodes(self) -> _Nodes:
        """All nodes."""
        return _Nodes(node for node, _ in self._walk())

    def _with(self, slot: str, kind: type = object) -> _Nodes:
        """The nodes with an object of a kind."""
        return _Nodes(n for n in self.nodes if getattr(n, slot) is not None
                      and isinstance(getattr(n, slot), kind))

    mesh_nodes = property(lambda self: self._with("mesh"), doc="Those with a mesh.")
    camera_nodes = property(lambda self: self._with("camera"), doc="Those with a camera.")
    light_nodes = property(lambda self: self._with("light"), doc="Those with a light.")
    point_light_nodes = property(lambda self: self._with("light", PointLight), doc="With a PointLight.")
    spot_light_nodes = property(lambda self: self._with("light", SpotLight), doc="With a SpotLight.")
    directional_light_nodes = property(lambda self: self._with("light", DirectionalLight),
                                       doc="With a DirectionalLight.")
    point_lights = property(lambda self: {n.light for n in self.point_light_nodes}, doc="All of them.")
    spot_lights = property(lambda self: {n.light for n in self.spot_light_nodes}, doc="All of them.")
    directional_lights = property(lambda self: {n.light for n in self.directional_light_nodes},
                                  doc="All of them.")

    def add(self, obj: Any, name: str | None = None, pose: Any = None, parent_node: Node | None = None,
            parent_name: str | None = None) -> Node:
        """Adds a mesh, a camera or a light, and returns its node."""
        kinds = {"mesh": Mesh, "camera": Camera, "light": Light}
        slot = [k for k, kind in kinds.items() if isinstance(obj, kind)]
        if not slot:
            raise TypeError(f"obj must be a Mesh, a Camera or a Light, not {arguments.shown(obj)}")
        node = Node(name or obj.name, matrix=pose)
        setattr(node, slot[0], obj)
        if parent_name is not None and parent_node is None:
            named = self.get_nodes(name=parent_name)
            if len(named) != 1:
                raise ValueError(f"{len(named) or 'no'} nodes are named {parent_name}")
            parent_node = named.pop()
        self.add_node(node, parent_node)
        return node

    def add_node(self, node: Node, parent_node: Node | None = None) -> None:
        """Adds a node below another one, or at the root."""
        if self.has_node(node):
            raise ValueError("node is in the scene already")
        if parent_node is not None and not self.has_node(parent_node):
            raise ValueError("parent_node is not in the scene")
        (self._roots if parent_node is None else parent_node.children).append(node)

    def remove_node(self, node: Node) -> None:
        """Removes a node and all below it."""
        for among in [self._roots, *(n.children for n in self.nodes)]:
            if node in among:
                among.remove(node)
                return
        raise ValueError("node is not in the scene")

    def get_nodes(self, node: Node | None = None, name: str | None = None, obj: Any = None,
                  obj_name: str | None = None) -> set[Node]:
        """The nodes of a name or with an object; all without an argument."""
        return {n for n in self.nodes if (node is None or n is node)
                and (name is None or n.name == name)
                and (obj is None or obj in (n.mesh, n.camera, n.light))
                and (obj_name is None or obj_name in (getattr(o, "name", None) for o in
                                                      (n.mesh, n.camera, n.light)))}

    def set_pose(self, node: Node, pose: Any) -> None:
        """Moves a node within its parent."""
        if not self.has_node(node):
            raise ValueError("node is not in the scene")
        node.matrix = pose

    def get_pose(self, node: Node) -> Array:
        """From the node to the world."""
        for other, pose in self._walk():
            if other is node:
                return pose
        raise ValueError("node is not in the scene")


def _reflect(o: Any, primitive: Primitive, textured: bool, ambient: Array) -> None:
    """Sets what an object reflects.

    pyrender's microfacets reflect F0, .04 of white .. the metal's colour, in a peak with long tails.
    Blinn's lobe has none, so a share of Lambert's stands for them.  Share, lobe and exponent are least
    squares over a sphere lit from the eye and from 45 degrees by lamps of 1, 3 and 6, in bytes, of
    roughness .1 .. 1 and metal 0, .5 and 1: their root mean square is 5.9 of 255, the mean 3.6."""
    m = primitive.material
    metal, alpha = m.metallicFactor, max(m.roughnessFactor, 0.04) ** 2
    share = 0.4 * alpha
    lobe = (1.23 + 1.34 * metal) * (1 - alpha) ** 2 / alpha ** (1.25 - metal)
    o["shininess"] = 5.3 / alpha ** (1.5 - 0.5 * metal)
    factor = np.asarray(m.baseColorFactor[:3])
    base = np.maximum(factor / 2 if textured else factor, 1e-3)    # a texture is half bright, say
    f0 = 0.04 * (1 - metal) + metal * base
    scattered = 0.96 * (1 - metal) * (1 - f0) * base + share * f0
    if not textured and primitive.color_0 is None:
        # all of the base colour reflects ambient light, however metallic
        o["rgba"][:3], o["specular"] = scattered, lobe * f0
        o["glow"] = ambient * np.maximum(factor - scattered, 0)
        return
    kept = min(float((scattered / base).mean()), 1.0)
    o["metal"], o["tint"], o["specular"] = 1 - kept, lobe * metal, lobe * 0.04 * (1 - metal)
    o["emission"] = ambient.mean() * (1 - kept) / kept


class OffscreenRenderer:
    """Draws scenes into arrays."""

    def __init__(self, viewport_width: int, viewport_height: int, point_size: float = 1.0) -> None:
        """The size of pictures, and that of points in pixels."""
        self._base: _Renderer | None = None
        self.viewport_width, self.viewport_height = viewport_width, viewport_height
        self.point_size = point_size
        self._shapes: dict[int, tuple[Any, int, dict[str, int]]] = {}
        self._srgb = True
        self._flat: OffscreenRenderer | None = None
        self._made()

    def _made(self) -> _Renderer:
        base, size = self._base, (self.viewport_height, self.viewport_width)
        if base is None or (base.height, base.width) != size:
            base = self._base = _Renderer(*size, srgb=self._srgb)
            self._shapes = {}
        return base

    def render(self, scene: Scene, flags: int = 0, seg_node_map: Any = None) -> Any:
        """color, (h, w, 3) bytes (4 with RGBA), and depth, (h, w) float32, 0 where there is nothing;
        depth alone with DEPTH_ONLY.  With SEG color has the colours of seg_node_map.  With FLAT colours
        and textures are written as they are, without the coding of sRGB, as pyrender's shader does."""
        if flags & RenderFlags.FLAT and self._srgb:
            flat = self._flat = self._flat or OffscreenRenderer(1, 1)
            flat._srgb, flat.point_size = False, self.point_size
            flat.viewport_width, flat.viewport_height = self.viewport_width, self.viewport_height
            return flat.render(scene, flags, seg_node_map)
        for name in ("FLIP_WIREFRAME", "ALL_WIREFRAME", "VERTEX_NORMALS", "FACE_NORMALS"):
            if flags & getattr(RenderFlags, name):
                raise Error(f"flags must not have {name}: neither wires nor normals are drawn as lines here")
        lamps, cameras = [], []
        used: list[Node] = []
        drawn = [p for n in scene.mesh_nodes if n.mesh.is_visible for p in n.mesh.primitives]
        if len(self._shapes) > 2 * len({id(p) for p in drawn}) + 8:    # most are of scenes that are gone
            self._base = None
        base = self._made()
        parts: list[Array] = []
        for node, pose in scene._walk():
            if node.camera is not None:
                cameras.append((node, pose))
            if node.light is not None:
                lamps.append((node.light, pose))
        main = [c for c in cameras if c[0] is scene.main_camera_node]
        if not main:
            raise ValueError("the scene has no camera")
        if np.linalg.det(main[0][1][:3, :3]) <= 0:
            raise Error("pose of the camera must not be mirrored")
        for node, pose in scene._walk():
            if node.mesh is not None and node.mesh.is_visible:
                for primitive in node.mesh.primitives:
                    parts.append(self._points(primitive, pose, main[0])
                                 if primitive.mode == GLTF.POINTS
                                 else self._records(base, primitive, pose, flags, scene.ambient_light))
                    used += [node] * len(parts[-1])
        objects = np.concatenate([*parts, np.zeros(0, SOLID)])
        objects["id"] = np.arange(len(objects))
        self._light(base, scene, lamps, flags)
        p = main[0][0].camera.get_projection_matrix(self.viewport_width, self.viewport_height)
        h, w = self.viewport_height, self.viewport_width
        seg, channels = bool(flags & RenderFlags.SEG), 4 if flags & RenderFlags.RGBA else 3
        color = None if flags & RenderFlags.DEPTH_ONLY or seg else np.empty((h, w, channels), np.uint8)
        ids = np.empty((h, w, 2), np.int32) if seg else None
        depth = np.empty((h, w), np.float32)
        camera = main[0][0].camera
        far = 3e30 if camera.zfar is None else camera.zfar
        seen = (np.linalg.inv(main[0][1]).T.ravel().tolist(), p.T.ravel().tolist(), max(camera.znear, 1e-6), far,
                bool(p[3, 3]))
        base._draw(Frame(color, depth, ids, None), seen, seg, 0.0, objects)
        if flags & RenderFlags.DEPTH_ONLY:
            return depth
        if ids is None:
            return color, depth
        table = np.zeros((len(used) + 1, 3), np.uint8)
        for i, node in enumerate(used):
            if seg_node_map and node in seg_node_map:
                shown = np.asarray(seg_node_map[node])
                table[i + 1] = np.broadcast_to(shown, 3)
        return table[ids[..., 0] + 1], depth

    def _records(self, base: _Renderer, primitive: Primitive, pose: Array, flags: int,
                 ambient: Array) -> Array:
        known = self._shapes.get(id(primitive))
        if known is None:
            m, uv = primitive.material, primitive.texcoord_0
            pictures = {"texture": m.baseColorTexture, "relief": m.normalTexture,
                        "glow_map": m.emissiveTexture}
            numbers = {name: 1 + base._textures[base._make_texture(picture, ("repeat", "repeat"), False, None,
                                                                   name != "relief")][0]
                       for name, picture in pictures.items() if picture is not None and uv is not None}
            if uv is not None:
                uv = np.stack([uv[:, 0], 1 - uv[:, 1]], 1)
            at, origin = counted(primitive.positions, np.empty((0, 3), np.uint32))
            shape = base._keep_mesh(None, at, primitive.normals, uv,
                                    None if primitive.color_0 is None else primitive.color_0[:, :3],
                                    primitive.indices, origin=origin)
            known = self._shapes[id(primitive)] = (primitive, shape.number, numbers)
        m = primitive.material
        places = [pose] if primitive.poses is None else [pose @ q for q in primitive.poses]
        made = np.zeros(len(places), SOLID)
        for o, place in zip(made, places):
            size = np.maximum(np.linalg.norm(place[:3, :3], axis=0), 1e-30)
            o["mesh"], o["size"] = known[1], size
            for name, number in known[2].items():
                o[name] = number
            o["turn"], o["place"] = place[:3, :3] / size, place[:3, 3]
            two_sided = m.doubleSided or flags & RenderFlags.SKIP_CULL_FACES
            o["flags"] = 2 if two_sided else 0
            o["rgba"] = m.baseColorFactor
            o["rgba"][3] = m.baseColorFactor[3] if m.alphaMode == "BLEND" else 1
            o["repeat"] = 1
            if flags & RenderFlags.FLAT:
                o["emission"] = 1
                continue
            _reflect(o, primitive, "texture" in known[2], ambient)
            o["strength"], o["glow_factor"] = 1, m.emissiveFactor ** 2
            if not o["glow_map"]:
                o["glow"] += m.emissiveFactor ** 2    # pyrender's shader multiplies by it twice
        return made

    def _points(self, primitive: Primitive, pose: Array, eye: tuple[Node, Array]) -> Array:
        """Balls that glow in their colours, as wide as point_size pixels, and a pixel at least."""
        p = eye[0].camera.get_projection_matrix(self.viewport_width, self.viewport_height)
        view = np.linalg.inv(eye[1])
        made = [np.zeros(0, SOLID)]
        for place in [pose] if primitive.poses is None else [pose @ q for q in primitive.poses]:
            at = primitive.positions @ place[:3, :3].T + place[:3, 3]
            depth = 1 if p[3, 3] else np.maximum(-(at @ view[2, :3] + view[2, 3]), 1e-6)
            # half the diagonal of a pixel, so that a ball reaches the centre of one
            radius = 0.71 * max(self.point_size, 1.0) * 2 / self.viewport_height * depth / p[1, 1]
            o = np.zeros(len(at), SOLID)
            made.append(o)
            o["kind"], o["place"], o["turn"] = _BALL, at, np.eye(3)
            o["size"] = np.broadcast_to(np.reshape(radius, (-1, 1)), (len(at), 3))
            o["flags"] = _NO_SHADOW
            factor = np.asarray(primitive.material.baseColorFactor)
            o["rgba"][:, :3] = factor[:3] if primitive.color_0 is None else \
                factor[:3] * primitive.color_0[:, :3]
            o["rgba"][:, 3], o["emission"] = 1, 1
        return np.concatenate(made)

    @staticmethod
    def _light(base: _Renderer, scene: Scene, lamps: list[tuple[Light, Array]], flags: int) -> None:
        made: list[_Lamp] = []
        shadow: list[int] = []
        for light, pose in lamps[:8]:
            power = light.intensity / math.pi
            color = (light.color[0] * power, light.color[1] * power, light.color[2] * power)
            at, aim = pose[:3, 3].tolist(), (-pose[:3, 2]).tolist()
            if isinstance(light, DirectionalLight):
                lamp, wanted = _Lamp.directional(aim, color), RenderFlags.SHADOWS_DIRECTIONAL
            elif isinstance(light, SpotLight):
                power = _falloff(light.innerConeAngle, light.outerConeAngle)
                lamp = replace(_Lamp.spot(at, aim, light.outerConeAngle, power, color), quadratic=1.0)
                wanted = RenderFlags.SHADOWS_SPOT
            else:
                lamp, wanted = _Lamp.point(at, color, attenuation=(0, 0, 1)), 0
            if flags & wanted:
                shadow.append(len(made))
            made.append(lamp)
        flat = bool(flags & RenderFlags.FLAT)
        base.light([] if flat else made, (0, 0, 0) if flat else scene.ambient_light.tolist(),
                   [] if flat else shadow)
        alpha = float(scene.bg_color[3]) if len(scene.bg_color) > 3 else 1.0
        base._set_behind(background=(*base._color("bg_color", scene.bg_color[:3]), alpha))

    def delete(self) -> None:
        """Gives the memory back."""
        self._base, self._shapes, self._flat = None, {}, None


class Viewer:
    """In place of a window one picture, which notebooks show, with the bytes color and depth.  Without
    a camera in the scene it looks at its middle; with use_raymond_lighting, or without a light, three
    lamps light it."""

    def __init__(self, scene: Scene, viewport_size: Any = None, render_flags: Any = None,
                 viewer_flags: Any = None, registered_keys: Any = None, run_in_thread: bool = False,
                 **others: Any) -> None:
        """Draws and returns at once.  Of others use_raymond_lighting, shadows, flat and cull_faces
        count."""
        asked = {**(render_flags or {}), **(viewer_flags or {}), **others}
        width, height = viewport_size or (640, 480)
        flags = RenderFlags.SHADOWS_ALL if asked.get("shadows") else RenderFlags.NONE
        flags |= RenderFlags.FLAT if asked.get("flat") else RenderFlags.NONE
        flags |= RenderFlags.NONE if asked.get("cull_faces", True) else RenderFlags.SKIP_CULL_FACES
        added = []
        if scene.main_camera_node is None:
            added.append(scene.add(PerspectiveCamera(yfov=math.pi / 3), pose=self._aim(scene)))
        if asked.get("use_raymond_lighting") or not scene.light_nodes:
            camera = scene.main_camera_node
            pose = np.eye(4) if camera is None else scene.get_pose(camera)
            added += [scene.add(DirectionalLight(intensity=2.0), pose=pose @ turn)
                      for turn in self._raymond()]
        try:
            self.color, self.depth = OffscreenRenderer(width, height).render(scene, flags)
        finally:
            for node in added:
                scene.remove_node(node)
        warnings.warn("Viewer opens no window here: it drew one picture, in its color and depth",
                      stacklevel=2)

    @staticmethod
    def _aim(scene: Scene) -> Array:
        """A pose from which the whole scene is seen."""
        pose, s = np.eye(4), math.sqrt(0.5)
        pose[:3, :3] = [[0, -s, s], [1, 0, 0], [0, s, s]]
        pose[:3, 3] = scene.centroid + max(scene.scale, 1e-9) * 1.1 * pose[:3, 2]
        return pose

    @staticmethod
    def _raymond() -> list[Array]:
        """Three lamps around the way of the view, 30 degrees off."""
        turns = []
        for angle in (math.pi / 2, math.pi * 7 / 6, math.pi * 11 / 6):
            z = np.array([math.cos(angle) / 2, math.sin(angle) / 2, math.sqrt(0.75)])
            x = np.array([-math.sin(angle), math.cos(angle), 0])
            turn = np.eye(4)
            turn[:3, 0], turn[:3, 1], turn[:3, 2] = x, np.cross(z, x), z
            turns.append(turn)
        return turns

    def _repr_png_(self) -> bytes:
        return Frame(self.color, None, None, None).picture().png()


__all__ = ["Camera", "DirectionalLight", "GLTF", "IntrinsicsCamera", "Light", "Material", "Mesh",
           "MetallicRoughnessMaterial", "Node", "OffscreenRenderer", "OrthographicCamera",
           "PerspectiveCamera", "PointLight", "Primitive", "RenderFlags", "Scene", "SpotLight",
           "Texture", "Viewer"]
