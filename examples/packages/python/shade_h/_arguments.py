"""Turns what callers pass into the arrays and numbers that the library takes, or refuses it by its
name."""
from __future__ import annotations

import ctypes
import math
import warnings
from typing import Any, Sequence, Union

import numpy as np

from ._native import Array, Bytes, Doubles, Error, Floats, Indices, asked, library, pointer

Color = Union[str, Sequence[float], Array]
MOST = 2**31 - 1
WRAPS = ["repeat", "clamp", "mirror"]
NOT_RIGID = "must be a rotation and a translation, without scale, with 0, 0, 0, 1 in the last row"


def shown(value: object) -> str:
    """A short name of what was passed, for a message."""
    if isinstance(value, np.ndarray):
        return f"an array {value.dtype} of shape {value.shape}"
    text = repr(value)
    return text if len(text) < 40 else f"{type(value).__name__} {text[:36]}..."


def array(name: str, value: object, shape: tuple[int | None, ...]) -> Array:
    """An array of numbers with the shape; None stands for any length."""
    if isinstance(value, np.ma.MaskedArray) and np.any(value.mask):
        raise Error(f"{name} has masked values, which have no number")
    try:
        got = np.asarray(value)
    except Exception as why:
        raise Error(f"{name} is no array: {shown(value)} ({why})") from None
    if got.dtype.kind not in "fiub":
        raise Error(f"{name} must hold numbers, not {got.dtype} ({shown(value)})")
    if got.ndim != len(shape) or any(w is not None and w != g for w, g in zip(shape, got.shape)):
        wanted = ", ".join("nmk"[i] if n is None else str(n) for i, n in enumerate(shape))
        raise Error(f"{name} must have the shape ({wanted}), not {got.shape}")
    if got.size > MOST:
        raise Error(f"{name} has {got.size} elements; at most {MOST} are drawn")
    return got


def dimensions(name: str, value: object) -> int:
    """How many dimensions an array or a number has."""
    try:
        return int(np.ndim(value))    # type: ignore[arg-type]
    except Exception as why:
        raise Error(f"{name} is no array: {shown(value)} ({why})") from None


def several(name: str, value: object) -> list[Any]:
    """What a list, a tuple or an array of any things holds."""
    try:
        return list(value)    # type: ignore[call-overload,no-any-return]
    except TypeError:
        raise Error(f"{name} must be a list, not {shown(value)}") from None


def floats(name: str, value: object, shape: tuple[int | None, ...], finite: bool = False) -> Floats:
    """A contiguous array of float32, the caller's own never; with finite, one without NaN and
    infinity."""
    with np.errstate(over="ignore"):
        got = np.array(array(name, value, shape), np.float32, order="C")
    if finite and not np.isfinite(got).all():
        raise Error(f"{name} must hold finite numbers that fit float32")
    return got


def doubles(name: str, value: object, shape: tuple[int | None, ...],
            finite: bool = False) -> Doubles:
    """A contiguous array of float64; with finite, one whose numbers fit float32."""
    with np.errstate(over="ignore"):
        got = np.ascontiguousarray(array(name, value, shape), dtype=np.float64)
    if finite and not (np.abs(got) <= 3e38).all():
        raise Error(f"{name} must hold finite numbers that fit float32")
    return got


def number(name: str, value: object, low: float = -math.inf, high: float = math.inf) -> float:
    """A finite number from low to high."""
    try:
        if isinstance(value, (str, bytes)):
            raise TypeError
        got = float(value)  # type: ignore[arg-type]
    except (TypeError, ValueError, OverflowError):
        raise Error(f"{name} must be a number, not {shown(value)}") from None
    if not math.isfinite(got) or not low <= got <= high:
        limits = "finite" if math.isinf(high) and math.isinf(low) else f"from {low:g} to {high:g}"
        raise Error(f"{name} must be {limits}, not {shown(value)}")
    return got


def flag(name: str, value: object) -> bool:
    """True or False, of Python or NumPy."""
    if not isinstance(value, (bool, np.bool_)):
        raise Error(f"{name} must be True or False, not {shown(value)}")
    return bool(value)


def integer(name: str, value: object, low: int, high: int) -> int:
    """A whole number from low to high."""
    if isinstance(value, (bool, np.bool_)) or not isinstance(value, (int, np.integer)):
        raise Error(f"{name} must be a whole number, not {shown(value)}")
    if not low <= value <= high:
        raise Error(f"{name} must be from {low} to {high}, not {value}")
    return int(value)


def choice(name: str, value: object, choices: Sequence[str]) -> str:
    """One of some words."""
    if not isinstance(value, str) or value not in choices:
        raise Error(f"{name} must be one of {', '.join(choices)}, not {shown(value)}")
    return value


def size(name: str, value: object) -> tuple[int, int]:
    """Width and height; one number is both."""
    pair: Any = (value, value) if isinstance(value, (int, np.integer)) else value
    try:
        width, height = pair
    except (TypeError, ValueError):
        raise Error(f"{name} must be (width, height), not {shown(value)}") from None
    return integer(f"{name}[0]", width, 1, 16384), integer(f"{name}[1]", height, 1, 16384)


def faces(name: str, value: object, vertices: int) -> Indices:
    """Triangles as indices; polygons of four corners are cut in two."""
    given = array(name, value, (None, None))
    if given.size * 2 > MOST:
        raise Error(f"{name} has {given.size} indices; at most {MOST} are drawn")
    rows, columns = given.shape
    if given.dtype.kind in "iu" and columns == 3 and given.size and given.min() >= 0 and given.max() < vertices:
        return np.array(given, np.uint32, order="C")    # most are so
    out = np.empty((rows * (2 if columns == 4 else 1), 3), np.uint32)
    asked(library.python_faces, name.encode(), np.array(given, np.float64, order="C"), rows,
          columns, vertices, out)
    return out


def linear(name: str, value: object, columns: tuple[int, ...] = (3, 4)) -> Floats:
    """Linear light of an array of display colours, 0 .. 1 or bytes; alpha is left out, with a
    warning where it counts."""
    got = array(name, value, (None, None))
    if got.shape[1] not in columns:
        raise Error(f"{name} must have 3 or 4 columns, not {got.shape[1]}")
    rgb, alpha = np.empty((len(got), 3), np.float32), ctypes.c_double()
    asked(library.python_colors, name.encode(), np.array(got, np.float64, order="C"), len(got),
          got.shape[1], got.dtype.kind in "iu", got.dtype == np.uint8, rgb, ctypes.byref(alpha))
    if alpha.value < 1:
        warnings.warn(f"{name}: its alpha is left out", stacklevel=4)
    library.python_linear(pointer(rgb), len(rgb))
    return rgb


def hexadecimal(name: str, text: str) -> list[float]:
    """Red, green and blue of a name, ours or of CSS, or of #RGB, #RRGGBB."""
    rgb = np.empty(3)
    asked(library.python_color, name.encode(), text.encode(errors="replace"), rgb)
    return [float(x) for x in rgb]


def displayed(name: str, value: object) -> Array:
    """One display colour, 0 .. 1 or bytes, of three numbers or four."""
    got = array(name, hexadecimal(name, value) if isinstance(value, str) else value, (None,))
    # (1, 0, 0) is red, and np.array([1, 0, 0]) too: only bytes that say so are nearly black
    ones = got.dtype.kind in "iu" and got.dtype != np.uint8 and got.size and got.max() <= 1
    return np.asarray(got.astype(float) if ones and got.min() >= 0 else got)


def color(name: str, value: object) -> tuple[float, float, float]:
    """One display colour in linear light."""
    rgb = linear(name, displayed(name, value)[None])[0]
    return float(rgb[0]), float(rgb[1]), float(rgb[2])


def rigid(name: str, value: object) -> Doubles:
    """A matrix of 4 x 4, a rotation and a translation, whose last row is 0, 0, 0, 1."""
    got = doubles(name, value, (4, 4), finite=True)
    if library.python_not_rigid(pointer(got), 1) >= 0:
        raise Error(f"{name} {NOT_RIGID}")
    return got


def affine(name: str, value: object, shape: tuple[int | None, ...] = (4, 4)) -> Doubles:
    """Matrices of 4 x 4 whose last row is 0, 0, 0, 1."""
    got = doubles(name, value, shape, finite=True)
    if got.size and np.abs(got[..., 3, :] - (0, 0, 0, 1)).max() > 1e-3:
        raise Error(f"{name} must have 0, 0, 0, 1 in the last row: a translation stands in the last column")
    return got


def into(name: str, value: object, shape: tuple[int, ...], kind: type) -> Array:
    """An array that the caller hands in to be filled, or a new one for None."""
    if value is None:
        return np.empty(shape, kind)
    if not isinstance(value, np.ndarray):
        raise Error(f"{name} must be an array, not {shown(value)}")
    if value.shape != shape or value.dtype != np.dtype(kind):
        wanted = f"{np.dtype(kind)} of shape {shape}"
        raise Error(f"{name} must be {wanted}, not {shown(value)}")
    if not value.flags.c_contiguous or not value.flags.writeable or not value.flags.aligned:
        raise Error(f"{name} must be contiguous, aligned and writeable")
    return value


def texture(name: str, value: object) -> Bytes:
    """A picture of RGBA bytes."""
    got = array(name, value, (None, None, None))
    if got.shape[2] not in (3, 4) or not 1 <= min(got.shape[:2]) <= max(got.shape[:2]) <= 16384:
        raise Error(f"{name} must have the shape (height, width, 3 or 4), not {got.shape}")
    whole = got.dtype.kind in "iu"
    if got.dtype.kind == "b" or not (got.min() >= 0 and got.max() <= (255 if whole else 1)):
        raise Error(f"{name} must hold bytes, or numbers from 0 to 1, not {shown(got)}")
    rgba = np.full((*got.shape[:2], 4), 255, np.uint8)
    rgba[:, :, :got.shape[2]] = got if whole else got * 255 + 0.5
    return rgba


def wraps(value: object) -> tuple[int, int]:
    """How a texture goes on along u and v, as the library has it."""
    if not isinstance(value, (tuple, list)) or len(value) != 2:
        raise Error(f"wrap must be two names, for u and v, not {shown(value)}")
    u, v = (WRAPS.index(choice("wrap", how, WRAPS)) for how in value)
    return u, v
