"""Cameras: a view from the world and a projection, as matrices of OpenGL."""
from __future__ import annotations

import math
from dataclasses import dataclass, field, replace
from typing import Any, Sequence, Union

import numpy as np

from . import _arguments as arguments
from ._native import Doubles as Matrix, Error, Floats

Viewpoint = Union[str, Sequence[float]]
MOST = 1e8
#: Azimuth and elevation in degrees of the views that have names.
VIEWS = {"front": (0.0, 0.0), "right": (90.0, 0.0), "back": (180.0, 0.0), "left": (270.0, 0.0),
         "top": (0.0, 90.0), "bottom": (0.0, -90.0),
         "iso": (45.0, math.degrees(math.atan(0.5**0.5)))}


#: The frame, z upright and -y the front, as columns, that each upright axis asks for.
_HALF_TURN = np.diag([1.0, -1.0, -1.0])
_FRAMES = {"z": np.eye(3), "y": np.array([[1.0, 0, 0], [0, 0, 1], [0, -1, 0]]),
           "x": np.array([[0.0, 0, 1], [1, 0, 0], [0, 1, 0]])}
UPRIGHT = {**_FRAMES, **{f"-{name}": frame @ _HALF_TURN for name, frame in _FRAMES.items()}}


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
        if not np.allclose(turn @ turn.T, np.eye(3), atol=1e-3) or \
                not np.allclose(self.view[3], (0, 0, 0, 1)):
            raise Error("view must be a rotation and a translation, without scale")

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
            last = (width, height), (camera.view.T.ravel().tolist(), camera.projection.T.ravel().tolist(),
                                     *_range_of(name, camera.projection))
            object.__setattr__(self, "_last", last)
        return last[1]    # type: ignore[no-any-return]

    @staticmethod
    def look_at(eye: Sequence[float], target: Sequence[float] = (0, 0, 0),
                up: Sequence[float] = (0, 0, 1), fov: float = 45.0, aspect: float | None = None,
                near: float = 0.01, far: float = 1000.0) -> Camera:
        """A camera at eye that looks at target; fov is the vertical angle in degrees.  Without
        aspect that of each picture is taken."""
        at = arguments.doubles("eye", eye, (3,), finite=True)
        back = at - arguments.doubles("target", target, (3,), finite=True)
        if not np.any(back):
            raise Error("eye and target must differ")
        turn = _facing(back, arguments.floats("up", up, (3,), finite=True).astype(float))
        view = np.eye(4)
        view[:3, :3], view[:3, 3] = turn, -turn @ at
        made = perspective(fov, 1.0 if aspect is None else aspect, near, far)
        return Camera(view, made, None, aspect is None)

    @staticmethod
    def opencv(K: object, extrinsics: object, size: object, near: float = 0.01,
               far: float = 1000.0) -> Camera:
        """A camera of OpenCV: K is 3 x 3, in pixels whose centres are whole numbers; extrinsics,
        3 x 4 or 4 x 4, take the world to a camera that looks down +z with +y down."""
        width, height = arguments.size("size", size)
        k = arguments.doubles("K", K, (3, 3), finite=True)
        out = arguments.doubles("extrinsics", extrinsics, (None, 4), finite=True)
        if len(out) not in (3, 4):
            raise Error(f"extrinsics must be 3 x 4 or 4 x 4, not {len(out)} x 4")
        if k[0, 0] == 0 or k[1, 1] == 0 or np.abs(k[2] - (0, 0, 1)).max() > 1e-6:
            raise Error("K must have focal lengths that are not 0, and 0, 0, 1 in the last row")
        if len(out) == 4:
            arguments.affine("extrinsics", out)
        view = np.eye(4)
        view[:3] = np.diag([1.0, -1.0, -1.0]) @ out[:3]
        near, far = _range(near, far)
        projection = np.zeros((4, 4))
        projection[0, :3] = (2 * k[0, 0] / width, -2 * k[0, 1] / width,
                             1 - (2 * k[0, 2] + 1) / width)
        projection[1, 1:3] = 2 * k[1, 1] / height, (2 * k[1, 2] + 1) / height - 1
        projection[2, 2:] = (far + near) / (near - far), 2 * far * near / (near - far)
        projection[3, 2] = -1
        return Camera(view, projection, None, False, (width, height))

    @staticmethod
    def opengl(projection: object, pose: object) -> Camera:
        """A camera of OpenGL matrices: pose takes the camera to the world, as in pyrender."""
        place = arguments.doubles("pose", pose, (4, 4), finite=True)
        if abs(np.linalg.det(place)) < 1e-6:
            raise Error("pose must be a rotation and a translation")
        made = arguments.doubles("projection", projection, (4, 4), finite=True)
        if np.linalg.det(made) == 0:
            raise Error("projection must have an inverse")
        return Camera(np.linalg.inv(place), made)


def _range_of(name: str, projection: Matrix) -> tuple[float, float, bool]:
    """near, far and whether the projection is parallel, of a matrix of OpenGL."""
    p = projection
    parallel = bool(p[3, 3] != 0)
    if parallel:
        if not p[2, 2]:
            raise Error(f"{name}: its projection has no depth")
        near, far = (p[2, 3] + 1) / p[2, 2], (p[2, 3] - 1) / p[2, 2]
        if p[3, 2] or not near < far:
            raise Error(f"{name}: its projection must be that of OpenGL, with near before far")
        return float(near), float(far), True
    a, b = p[2, 2] / -p[3, 2], p[2, 3] / -p[3, 2]
    near = b / (a - 1) if a != 1 else 0.0
    far = b / (a + 1) if a < -1 else np.inf
    if not 0 < near < far:
        raise Error(f"{name}: its projection must be that of OpenGL, with 0 < near < far")
    return float(near), float(min(far, 3e30)), False


def _range(near: float, far: float) -> tuple[float, float]:
    near = arguments.number("near", near, 1e-12, 1e12)
    far = arguments.number("far", far, 1e-12, 1e13)
    if far <= near:
        raise Error(f"far must exceed near, {near:g}, not {far:g}")
    return near, far


def perspective(fov: float, aspect: float, near: float, far: float) -> Matrix:
    """The projection of a vertical angle of fov degrees."""
    near, far = _range(near, far)
    slope = math.tan(math.radians(arguments.number("fov", fov, 0.01, 179)) / 2)
    aspect = arguments.number("aspect", aspect, 1e-4, 1e4)
    out = np.zeros((4, 4))
    out[0, 0], out[1, 1], out[3, 2] = 1 / (slope * aspect), 1 / slope, -1
    out[2, 2:] = (far + near) / (near - far), 2 * far * near / (near - far)
    return out


def _facing(back: Matrix, up: Matrix) -> Matrix:
    """The rows of a rotation after which back is +z, and up is as near to +y as it can be."""
    z = back / np.linalg.norm(back)
    x = np.cross(up, z)
    if np.linalg.norm(x) < 1e-6 * max(float(np.linalg.norm(up)), 1e-30):
        x = np.cross(np.eye(3)[np.argmin(np.abs(z))], z)
    x /= np.linalg.norm(x)
    return np.stack([x, np.cross(z, x), z])


def direction(view: Viewpoint, up: str) -> tuple[Matrix, Matrix]:
    """The way toward the eye, and the way up, of a view by its name or its angles in degrees."""
    if isinstance(view, str):
        azimuth, elevation = VIEWS[arguments.choice("view", view, list(VIEWS))]
    else:
        angles = arguments.floats("view", view, (2,), finite=True)
        azimuth, elevation = float(angles[0]), float(angles[1])
    a, e = math.radians(azimuth), math.radians(elevation)
    back = np.array([math.sin(a) * math.cos(e), -math.cos(a) * math.cos(e), math.sin(e)])
    head = np.array([-math.sin(a) * math.sin(e), math.cos(a) * math.sin(e), math.cos(e)])
    frame = UPRIGHT[arguments.choice("up", up, list(UPRIGHT))]
    return frame @ back, frame @ head


def fitted(points: Floats, view: Viewpoint = "iso", size: tuple[int, int] = (640, 480),
           up: str = "z", ortho: bool = False, fov: float = 28.0, margin: float = 1.08,
           room: float = 0.0, origin: Matrix | None = None) -> Camera:
    """The nearest camera that sees all points, which count from an origin, from a side.

    Each side of the picture gives one bound on the eye, linear in a point's coordinates; their
    extremes give the distance and the shift that centres.  room is how much deeper than the points
    the picture reaches, as a part of their extent.  Points with NaN or beyond 1e8 do not
    count.
    """
    turn, flat = _facing(*direction(view, up)), arguments.flag("ortho", ortho)
    margin = arguments.number("margin", margin, 0.01, 100)
    with np.errstate(invalid="ignore"):
        good = (np.abs(points) <= MOST).all(1)
    finite = points if good.all() and len(points) else points[good]
    if not len(finite):
        finite = np.zeros((1, 3), np.float32)
    p = finite.astype(np.float64) @ turn.T
    low, high = p.min(0), p.max(0)
    slope = math.tan(math.radians(arguments.number("fov", fov, 0.01, 179)) / 2)
    reach = max(float(np.linalg.norm(high - low)), float(np.abs(p).max()) * 1e-6, 1e-6)
    slopes = (slope * size[0] / size[1], slope)
    if flat:
        return _moved(_orthographic(turn, low, high, size, margin, reach), origin)
    shift, least = [0.0, 0.0], 0.0
    for axis in (0, 1):
        above = float((p[:, axis] + slopes[axis] * p[:, 2]).max())
        below = float((slopes[axis] * p[:, 2] - p[:, axis]).max())
        shift[axis] = (above - below) / 2
        least = max(least if axis else -math.inf, (above + below) / (2 * slopes[axis]))
    least = max(least, float(high[2]) + 1e-3 * reach)
    distance = least + (margin - 1) * (least - float(low[2] + high[2]) / 2)
    view_matrix = np.eye(4)
    view_matrix[:3, :3] = turn
    view_matrix[:3, 3] = -shift[0], -shift[1], -distance
    near = distance - float(high[2]) - room * reach
    far = distance - float(low[2]) + room * reach
    near = max(0.9 * near, 1e-4 * far if room == 0 else 0.01 * far)
    made = Camera(view_matrix, perspective(fov, size[0] / size[1], near, 1.1 * far + 1e-3 * reach))
    return _moved(made, origin)


def _moved(camera: Camera, origin: Matrix | None) -> Camera:
    """The camera in the world of one that was made for points which count from an origin."""
    if origin is None or not np.any(origin):
        return camera
    view = camera.view.copy()
    view[:3, 3] -= view[:3, :3] @ origin
    return Camera(view, camera.projection, (np.array(origin), camera.view))


def _orthographic(turn: Matrix, low: Matrix, high: Matrix, size: tuple[int, int], margin: float,
                  reach: float) -> Camera:
    middle, extent = (low + high) / 2, (high - low) / 2
    half = margin * max(float(extent[1]), float(extent[0]) * size[1] / size[0], 1e-4 * reach)
    view = np.eye(4)
    view[:3, :3], view[:3, 3] = turn, -middle - np.array([0, 0, 2 * reach])
    projection = np.diag([size[1] / (half * size[0]), 1 / half, -1 / (2 * reach), 1.0])
    projection[2, 3] = -1.0
    return Camera(view, projection)


def at(camera: object) -> Camera:
    """The camera itself, where it is one."""
    if not isinstance(camera, Camera):
        raise Error(f"camera must be a shade_h.Camera, not {arguments.shown(camera)}")
    return camera


Cameras = Sequence[Camera]
def studio(points: Floats, camera: Camera, up: str) -> Matrix:
    """The matrix to the thumbnail's studio: the points about the origin, within distance 1, +y up
    and +z toward the eye."""
    with np.errstate(invalid="ignore"):
        good = points[(np.abs(points) <= MOST).all(1)].astype(np.float64)
    good = good if len(good) else np.zeros((1, 3))
    middle = (good.min(0) + good.max(0)) / 2
    size = max(float(np.linalg.norm(good - middle, axis=1).max()), 1e-12)
    y = UPRIGHT[up][:, 2]
    x = camera.view[0, :3] - camera.view[0, :3] @ y * y
    if np.linalg.norm(x) < 1e-3:
        x = camera.view[1, :3] - camera.view[1, :3] @ y * y
    x /= np.linalg.norm(x)
    out = np.eye(4)
    out[:3, :3] = np.stack([x, y, np.cross(x, y)]) / size
    out[:3, 3] = -out[:3, :3] @ middle
    return out


__all__ = ["studio", "Camera", "Cameras", "VIEWS", "Viewpoint", "fitted", "perspective",
           "direction", "at"]
