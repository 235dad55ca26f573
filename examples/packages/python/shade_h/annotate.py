"""What is drawn over a finished picture: the colours of scalars with their bar, and text."""
from __future__ import annotations

import warnings
from dataclasses import dataclass
from typing import Any

import numpy as np

from . import _arguments as arguments
from ._native import Array, Bytes, Doubles, Error, Floats, library, pointer

#: Colours at equal steps, between which colours are mixed: viridis by Nathaniel Smith and Stefan
#: van der Walt (CC0), and the smooth cool-to-warm of Kenneth Moreland, "Diverging Color Maps for
#: Scientific Visualization" (2009), as he publishes its 33 steps.
MAPS = {
    "viridis": "440154 481568 482677 453781 3f4788 39558c 32648e 2d718e 287d8e 238a8d 1f968b "
               "20a386 29af7f 3cbc75 56c667 74d055 94d840 b8de29 dce318 fde725",
    "cool-to-warm": "3b4cc0 445acc 4d68d7 5775e1 6282ea 6c8ef1 779af7 82a5fb 8db0fe 98b9ff a3c2ff "
                    "aec9fd b8d0f9 c2d5f4 ccd9ee d5dbe6 dddddd e5d8d1 ecd3c5 f1ccb9 f5c4ad f7bba0 "
                    "f7b194 f7a687 f49a7b f18d6f ec7f63 e57058 de604d d55042 cb3e38 c0282f b40426",
    "grey": "000000 ffffff",
}
NONE = (0.55, 0.55, 0.55)    # the display colour of what has no number
TEXELS = 512
MOST_TEXT = 200              # characters


def map_colors(cmap: object) -> Doubles:
    """The display colours of a map by its name, or of rows of one's own, 0 .. 1 or bytes."""
    if isinstance(cmap, str):
        words = MAPS[arguments.choice("cmap", cmap, list(MAPS))].split()
        return np.array([list(bytes.fromhex(word)) for word in words]) / 255
    rows = arguments.array("cmap", cmap, (None, 3))
    most = 255 if rows.dtype.kind in "iu" else 1
    if len(rows) < 2 or not (rows.min() >= 0 and rows.max() <= most):
        raise Error(f"cmap must hold two colours or more, from 0 to {most}")
    return np.asarray(rows / most, np.float64)


def sampled(colors: Doubles, t: Doubles) -> Doubles:
    """Display colours of numbers from 0 to 1."""
    steps = np.linspace(0, 1, len(colors))
    return np.stack([np.interp(t, steps, colors[:, k]) for k in range(3)], -1)


def display(linear: Any) -> Any:
    """Display colours, as Mesh takes them, of linear ones, in double as in the package for Node."""
    linear = np.asarray(linear, np.float64)
    out = np.where(linear <= 0.0031308, 12.92 * linear,
                   1.055 * np.maximum(linear, 0) ** (1 / 2.4) - 0.055)
    return np.clip(np.nan_to_num(out), 0, 1)


@dataclass(frozen=True, eq=False)
class Bar:
    """What a bar beside a picture tells: the colours from the least to the greatest number."""

    colors: Doubles
    low: float
    high: float
    title: str
    gaps: bool    # some faces have no number

    def place(self, values: Doubles) -> Doubles:
        """Where numbers lie between the ends, 0 .. 1; those beyond lie at the ends."""
        if self.high <= self.low:
            return np.where(np.isinf(values), (values > 0) * 1.0, np.where(np.isnan(values), np.nan, 0.5))
        with np.errstate(invalid="ignore", over="ignore"):
            return np.clip((values - self.low) / (self.high - self.low), 0.0, 1.0)

    def same(self, other: Bar) -> bool:
        """Would both bars look alike?"""
        return self.title == other.title and (self.low, self.high) == (other.low, other.high) and \
            np.array_equal(self.colors, other.colors)

    def texture(self) -> tuple[Bytes, float, float]:
        """A picture of the map, of which numbers use the middle half, so that its ends do not meet;
        and the u of 0, and its growth to 1."""
        t = (np.arange(2 * TEXELS) - TEXELS / 2) / (TEXELS - 1)
        row = sampled(self.colors, np.clip(t, 0, 1))
        made = np.asarray(np.round(255 * row)[None], np.uint8)
        return made, (TEXELS / 2 + 0.5) / (2 * TEXELS), (TEXELS - 1) / (2 * TEXELS)


def bar_of(values: Doubles, cmap: object, clim: Any, title: object) -> Bar:
    """The bar of some numbers, whose ends are those of clim or the least and the greatest."""
    title = words_of("title", title)
    finite = values[np.isfinite(values)]
    low, high = (float(finite.min()), float(finite.max())) if len(finite) else (0.0, 1.0)
    if clim is not None:
        try:
            low, high = clim
        except (TypeError, ValueError):
            raise Error(f"clim must be (low, high), not {arguments.shown(clim)}") from None
        low = arguments.number("clim[0]", low, -1e300, 1e300)
        high = arguments.number("clim[1]", high, -1e300, 1e300)
        if high < low:
            raise Error(f"clim must not fall, from {low:g} to {high:g}")
    return Bar(map_colors(cmap), low, high, title, bool(np.isnan(values).any()))


def ticks(low: float, high: float, most: int) -> list[float]:
    """Round numbers from low to high, at most so many, in steps of 1, 2 or 5 powers of ten."""
    span = high - low
    if not 0 < span < np.inf or most < 2 or span <= 1e-12 * max(abs(low), abs(high)):
        return [low]
    power = 10.0 ** np.floor(np.log10(span / most))
    for step in (power, 2 * power, 5 * power, 10 * power, 20 * power):
        first, last = np.ceil(low / step - 1e-9), np.floor(high / step + 1e-9)
        if last - first + 1 <= most:
            break
    return [float(k * step) for k in np.arange(first, last + 1)]


# ---- text ----------------------------------------------------------------------------------------

@dataclass(frozen=True, eq=False)
class Text:
    """Words at a point, which counts from the origin of their part's mesh."""

    words: str
    point: Floats
    color: tuple[int, int, int]
    size: float
    over: bool
    middle: bool    # centred about the point, else beside it


def words_of(name: str, value: object) -> str:
    """Text of one line, at most so many characters."""
    if not isinstance(value, str):
        raise Error(f"{name} must be text, not {arguments.shown(value)}")
    if len(value) > MOST_TEXT:
        raise Error(f"{name} must have at most {MOST_TEXT} characters, not {len(value)}")
    missing = sorted({c for c in value if not c.isspace() and c != "\0" and not library.python_has_letter(ord(c))})
    if missing:
        warnings.warn(f"{name}: the font has no {' '.join(missing)}: a question mark stands for it",
                      stacklevel=4)
    return " ".join(value.split())


def text_mask(words: str, size: float) -> Array:
    """How much of each pixel letters cover, 0 .. 255, in a box with a border of 2 pixels."""
    data = words.encode("utf-8", "replace").replace(b"\0", b" ")
    width = int(np.ceil(library.python_text(data, size, 0, 0, None, 0, 0))) + 4
    height = int(np.ceil(1.3 * size)) + 4
    rgba = np.zeros((height, width, 4), np.uint8)
    library.python_text(data, size, 2, round(0.95 * size) + 2, pointer(rgba), width, height)
    return rgba[:, :, 0].astype(np.int64)


def mix(rgba: Bytes, mask: Array, x: int, y: int, color: tuple[int, int, int]) -> None:
    """Lays a colour over part of a picture, as far as a mask covers its pixels."""
    height, width = rgba.shape[:2]
    x0, y0, x1, y1 = max(x, 0), max(y, 0), min(x + mask.shape[1], width), \
        min(y + mask.shape[0], height)
    if x0 >= x1 or y0 >= y1:
        return
    a = mask[y0 - y:y1 - y, x0 - x:x1 - x, None]
    below = rgba[y0:y1, x0:x1].astype(np.int64)
    alpha = a * 255 + below[..., 3:] * (255 - a)    # times 255
    light = np.array(color) * a * 255 + below[..., :3] * below[..., 3:] * (255 - a)
    rgba[y0:y1, x0:x1, :3] = (light + alpha // 2) // np.maximum(alpha, 1)
    rgba[y0:y1, x0:x1, 3:] = (alpha + 127) // 255


def write(rgba: Bytes, words: str, x: float, y: float, size: float,
          color: tuple[int, int, int]) -> None:
    """Writes words whose box begins at x and is centred about y, within the picture where they fit,
    with a rim of the opposite lightness, so that they can be read on any background."""
    mask = text_mask(words, size)
    height, width = mask.shape
    left = int(round(max(0.0, min(x, rgba.shape[1] - width))))
    top = int(round(max(0.0, min(y - height / 2, rgba.shape[0] - height))))
    rim = mask.copy()
    for dy in range(-2, 3):
        for dx in range(-2, 3):
            moved = np.roll(mask, (dy, dx), (0, 1))    # over the border of 2 pixels, which is empty
            rim = np.maximum(rim, moved if dx * dx + dy * dy < 5 else moved // 2)
    rim = np.minimum(2 * rim, 255)    # thin strokes have a whole rim too
    dark = 2 * color[0] + 5 * color[1] + color[2] < 8 * 128
    mix(rgba, rim, left, top, (255, 255, 255) if dark else (0, 0, 0))
    mix(rgba, mask, left, top, color)


def write_text(rgba: Bytes, depth: Floats, text: Text, camera: Array, projection: Array) -> bool:
    """Writes a text of a part in its place, and returns whether it can be seen.  camera takes its
    point to the eye.  Where it may be hidden, its point is compared with the depths around it."""
    height, width = depth.shape
    eye = camera @ np.append(text.point.astype(np.float64), 1)
    clip = projection @ eye
    if not np.isfinite(clip).all() or clip[3] <= 0 or not (np.abs(clip[:3]) <= clip[3]).all():
        return False
    x = (clip[0] / clip[3] + 1) / 2 * width
    y = (1 - clip[1] / clip[3]) / 2 * height
    column, row = min(int(x), width - 1), min(int(y), height - 1)
    near = depth[max(row - 1, 0):row + 2, max(column - 1, 0):column + 2]
    if not text.over and -eye[2] > near.max() * (1 + 1e-3):
        return False
    wide = text_mask(text.words, text.size).shape[1]
    write(rgba, text.words, x - wide / 2 if text.middle else x + text.size / 2, y, text.size,
          text.color)
    return True


# ---- the bar -------------------------------------------------------------------------------------

INK, PAPER = (32, 36, 42), (240, 240, 240)


def em_of(width: int, height: int) -> int:
    """The size of a bar's figures; 0 where the picture is too small for a bar."""
    return 0 if width < 160 or height < 100 else max(10, min(16, height // 32))


def _figures(bar: Bar, height: int, em: int) -> list[tuple[float, str]]:
    """Where a bar has marks, 0 .. 1, and what stands there."""
    marks = ticks(bar.low, bar.high, max(2, int(0.7 * height / (2.2 * em))))
    return [(float(bar.place(np.array(v))), f"{v:.6g}".replace("-", "\u2212")) for v in marks]


def bar_room(bar: Bar, width: int, height: int) -> int:
    """How many columns of a picture a bar takes."""
    em = em_of(width, height)
    if not em:
        return 0
    figures = [text_mask(words, em).shape[1] for _, words in _figures(bar, height, em)]
    title = text_mask(bar.title, em).shape[1] if bar.title else 0
    return int(min(max(3 * em + max(figures), em + 4 + title), width // 2))


def draw_bar(rgba: Bytes, bar: Bar, right: int) -> None:
    """Draws a bar whose columns end at right."""
    height, width = rgba.shape[:2]
    em, room = em_of(width, height), bar_room(bar, width, height)
    left, top, bottom = right - room + em, round(0.14 * height), round(0.84 * height)
    full = np.full((1, 1), 255)
    behind = rgba[:, max(left, 0):right].astype(np.int64)
    alpha = behind[..., 3]
    light = (behind[..., :3] @ [2, 5, 1] * alpha // 255 + 8 * (255 - alpha)).mean()
    ink = INK if light > 8 * 110 else PAPER
    mix(rgba, np.broadcast_to(full, (bottom - top + 2, em + 2)), left - 1, top - 1, ink)
    t = (bottom - 0.5 - np.arange(top, bottom)) / (bottom - top)
    rows = np.asarray(np.round(255 * sampled(bar.colors, t)), np.uint8)
    there = slice(max(left, 0), max(left + em, 0))
    rgba[top:bottom, there, :3], rgba[top:bottom, there, 3] = rows[:, None], 255
    for at, words in _figures(bar, height, em):
        y = bottom - at * (bottom - top)
        mix(rgba, np.broadcast_to(full, (1, em // 3)), left + em + 1, int(min(y, bottom - 1)), ink)
        write(rgba, words, left + em + em // 2, y, em, ink)
    if bar.title:
        write(rgba, bar.title, right - room + em // 2, top - 1.2 * em, em, ink)
    if bar.gaps:
        y = bottom + em
        grey = tuple(round(255 * k) for k in NONE)
        mix(rgba, np.broadcast_to(full, (em, em)), left, y, (grey[0], grey[1], grey[2]))
        write(rgba, "NaN", left + em + em // 2, y + em / 2, em, ink)
