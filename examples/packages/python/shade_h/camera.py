"""Cameras: a view from the world and a projection, as matrices of OpenGL."""
from __future__ import annotations

import ctypes
from dataclasses import dataclass, field, replace
from typing import Any, Sequence, Union

import numpy as np

from . import _arguments as arguments
from ._native import CameraOf, Doubles as Matrix, Error, Floats, Range, Side, asked, library, pointer

Viewpoint = Union[str, Sequence[float]]


def _views() -> dict[str, tuple[float, float]]:
    views: dict[str, tuple[float, float]] = {}
    angles = np.zeros(2)
    while name := library.python_view_name(len(views), pointer(angles)):
        views[name.decode()] = float(angles[0]), float(angles[1])
    return views


#: Azimuth and elevation in degrees of the views that have names.
VIEWS = _views()


#: The upright axes, in the order of the core.
UPRIGHT = ["x", "y", "z", "-x", "-y", "-z"]


@dataclass(frozen=True, eq=False)
class Camera:
    """Where a picture is seen from.

    view takes points of the world to the camera, which looks down -z with +y up; projection takes
    them on to clip space, -w <= x, y, z <= w.  Both are 4 x 4, in double precision, and multiply
    columns.
    """

    view: Matrix
    projection: Matrix
    _near: tuple[Matrix, Matrix] | None = field(default=None, repr=False)
    _free: bool = field(default=False, repr=False)    # its aspect is that of the picture
    _size: tuple[int, int] | None = field(default=None, repr=False)    # of pictures, where it has one
    _last: Any = field(default=None, init=False, repr=False)    # what seen() gave, and for which size

    def __post_init__(self) -> None:
        """Refuses matrices of another shape, with NaN, or whose view is no rigid motion."""
        view = arguments.doubles("view", self.view, (4, 4), finite=True)
        projection = arguments.floats("projection", self.projection, (4, 4), finite=True)
        object.__setattr__(self, "view", view.copy())
        object.__setattr__(self, "projection", projection.astype(np.float64))
        turn = self.view[:3, :3]
        if not np.allclose(turn @ turn.T, np.eye(3), atol=1e-3) or np.linalg.det(turn) < 0 or \
                not np.allclose(self.view[3], (0, 0, 0, 1)):
            raise Error("view must be a rotation and a translation, without scale or mirror")

    @property
    def eye(self) -> Matrix:
        """The position of the camera in the world."""
        return np.asarray(-self.view[:3, :3].T @ self.view[:3, 3])

    def view_from(self, origin: Matrix) -> Matrix:
        """The view of points whose coordinates count from an origin."""
        if self._near is not None and np.array_equal(self._near[0], origin):
            return self._near[1]
        out = self.view.copy()
        out[:3, 3] += out[:3, :3] @ origin
        return out

    def sized(self, width: int, height: int) -> Camera:
        """The camera for a picture of a size, which gives its aspect where none was said."""
        if self._size not in (None, (width, height)):
            made = "{} x {}".format(*self._size or ())
            raise Error(f"camera was made for pictures of {made} pixels, not of {width} x {height}")
        if not self._free:
            return self
        projection = self.projection.copy()
        projection[0, 0] = projection[1, 1] * height / width
        return replace(self, projection=projection)

    def seen(self, width: int, height: int, name: str) -> tuple[Any, ...]:
        """View and projection by columns, near, far and whether it is parallel, for pictures of a
        size; those of the last size are kept."""
        last = self._last
        if last is None or last[0] != (width, height):
            camera = self.sized(width, height)
            flat = np.ascontiguousarray(camera.projection.T)
            span = Range()
            asked(library.python_range_of, name.encode(), flat, ctypes.byref(span))
            last = (width, height), (camera.view.T.ravel().tolist(), flat.ravel().tolist(),
                                     span.near, span.far, bool(span.parallel))
            object.__setattr__(self, "_last", last)
        return last[1]    # type: ignore[no-any-return]

    @staticmethod
    def look_at(eye: Sequence[float], target: Sequence[float] = (0, 0, 0),
                up: Sequence[float] = (0, 0, 1), fov: float = 45.0, aspect: float | None = None,
                near: float = 0.01, far: float = 1000.0) -> Camera:
        """A camera at eye that looks at target; fov is the vertical angle in degrees.  Without
        aspect that of each picture is taken."""
        rows = [arguments.doubles(name, value, (3,)) for name, value in
                (("eye", eye), ("target", target), ("up", up))]
        others = [arguments.number(name, value) for name, value in
                  (("fov", fov), ("aspect", 1.0 if aspect is None else aspect), ("near", near), ("far", far))]
        return _made(library.python_look_at, np.concatenate([*rows, others]),
                     _free=aspect is None)

    @staticmethod
    def opencv(K: object, extrinsics: object, size: object, near: float = 0.01,
               far: float = 1000.0) -> Camera:
        """A camera of OpenCV: K is 3 x 3, in pixels whose centres are whole numbers; extrinsics,
        3 x 4 or 4 x 4, take the world to a camera that looks down +z with +y down."""
        width, height = arguments.size("size", size)
        k = arguments.doubles("K", K, (3, 3))
        out = arguments.doubles("extrinsics", extrinsics, (None, 4))
        if len(out) not in (3, 4):
            raise Error(f"extrinsics must be 3 x 4 or 4 x 4, not {len(out)} x 4")
        whole = np.concatenate([out, np.eye(4)[len(out):]])
        return _made(library.python_opencv, k, whole, width, height,
                     arguments.number("near", near), arguments.number("far", far), _size=(width, height))

    @staticmethod
    def opengl(projection: object, pose: object) -> Camera:
        """A camera of OpenGL matrices: pose takes the camera to the world, as in pyrender."""
        made = np.ascontiguousarray(arguments.doubles("projection", projection, (4, 4)).T)
        return _made(library.python_opengl, made, arguments.doubles("pose", pose, (4, 4)))


def _made(function: Any, *given: Any, **kept: Any) -> Camera:
    """The camera that a function of the core makes."""
    out = CameraOf()
    asked(function, *given, ctypes.byref(out))
    view, projection = (np.array(m).reshape(4, 4).T for m in (out.view, out.projection))
    return Camera(view, projection, **kept)


def _angles(view: Viewpoint, up: str) -> tuple[float, float, int]:
    """Azimuth, elevation and the upright axis of a view by its name or its angles in degrees."""
    if isinstance(view, str):
        azimuth, elevation = VIEWS[arguments.choice("view", view, list(VIEWS))]
    else:
        azimuth, elevation = arguments.doubles("view", view, (2,), finite=True).tolist()
    return azimuth, elevation, UPRIGHT.index(arguments.choice("up", up, UPRIGHT))


def direction(view: Viewpoint, up: str) -> tuple[Matrix, Matrix]:
    """The way toward the eye, and the way up, of a view by its name or its angles in degrees."""
    out = np.empty((2, 3))
    library.python_direction(*_angles(view, up), pointer(out))
    return out[0], out[1]


def fitted(points: Floats, view: Viewpoint = "iso", size: tuple[int, int] = (640, 480),
           up: str = "z", ortho: bool = False, fov: float = 28.0, margin: float = 1.08,
           room: float = 0.0, origin: Matrix | None = None) -> Camera:
    """The nearest camera that sees all points, which count from an origin, from a side.

    room is how much deeper than the points the picture reaches, as a part of their extent.  Points
    with NaN or infinity do not count.
    """
    side = Side(*_angles(view, up), *arguments.size("size", size), arguments.flag("ortho", ortho),
                *(arguments.number(name, value) for name, value in (("fov", fov), ("margin", margin), ("room", room))))
    at = arguments.floats("points", points, (None, 3))
    return _moved(_made(library.python_fit, ctypes.byref(side), at, len(at)), origin)


def _moved(camera: Camera, origin: Matrix | None) -> Camera:
    """The camera in the world of one that was made for points which count from an origin."""
    if origin is None or not np.any(origin):
        return camera
    view = camera.view.copy()
    view[:3, 3] -= view[:3, :3] @ origin
    return Camera(view, camera.projection, (np.array(origin), camera.view))


def at(camera: object) -> Camera:
    """The camera itself, where it is one."""
    if not isinstance(camera, Camera):
        raise Error(f"camera must be a shade_h.Camera, not {arguments.shown(camera)}")
    return camera


Cameras = Sequence[Camera]


def studio(points: Floats, camera: Camera, up: str) -> Matrix:
    """The matrix to the thumbnail's studio: the points about the origin, within distance 1, +y up
    and +z toward the eye."""
    at, out = arguments.floats("points", points, (None, 3)), np.empty((4, 4))
    view = np.ascontiguousarray(camera.view.T)
    library.python_studio(pointer(at), len(at), pointer(view), UPRIGHT.index(up), pointer(out))
    return out.T


__all__ = ["studio", "Camera", "Cameras", "VIEWS", "Viewpoint", "fitted",
           "direction", "at"]
