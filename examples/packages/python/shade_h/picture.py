"""Pictures: arrays, PNG files, and tests against golden ones."""
from __future__ import annotations

import ctypes
import errno
import os
import stat
import threading
import zlib
from importlib import import_module
from pathlib import Path
from typing import Any, BinaryIO, Union

import numpy as np

from ._arguments import array, integer, shown
from ._native import Array, Bytes, Doubles, Error, Floats, Integers, library, pointer

SIGNATURE = b"\x89PNG\r\n\x1a\n"
File = Union[str, bytes, "os.PathLike[str]"]
PICTURE_BYTES = 500_000_000
PIXELS = 2**27


_writing = threading.Lock()
try:
    fcntl: Any = import_module("fcntl")
except ImportError:    # on Windows, where the lock of one process has to do
    fcntl = None


def _reserve(file: BinaryIO, size: int) -> None:
    """Takes the room that a file will need, before anything in it changes: a disk that is full
    leaves it as it was."""
    try:
        os.posix_fallocate(file.fileno(), 0, size)
    except AttributeError:    # of some systems
        pass
    except OSError as why:
        if why.errno in (errno.ENOSPC, errno.EFBIG, errno.EDQUOT):
            raise


def write_file(path: Path, data: bytes) -> None:
    """Writes a file as the programs do (kit/command/save.h): a new name appears whole or not at
    all; a file that exists is written over, one writer after the other."""
    target = Path(os.path.realpath(path))
    if target.exists():
        with _writing, target.open("r+b" if target.is_file() else "wb") as file:
            if target.is_file():
                if fcntl:
                    fcntl.flock(file, fcntl.LOCK_EX)
                _reserve(file, len(data))
            file.write(data)
            if target.is_file():
                file.truncate()
        return
    beside = target.with_name(f"{target.name}.{os.getpid()}.{threading.get_native_id()}.part")
    try:
        beside.write_bytes(data)
        os.replace(beside, target)
    finally:
        beside.unlink(missing_ok=True)


def put_file(path: Path, data: bytes) -> None:
    """The same, whose errors name the path."""
    try:
        write_file(path, data)
    except ValueError as why:
        raise Error(f"path: {why}") from None
    except OSError as why:
        raise type(why)(why.errno, why.strerror, str(path)) from None


class Picture:
    """A picture and what lies at the centre of its pixels.

    rgba is (H, W, 4) bytes, sRGB with straight alpha.  depth is (H, W), along the axis of view in
    the unit of the scene, infinity where there is nothing.  ids is (H, W), the number of the mesh,
    -1 where there is none.  normals is (H, W, 3), in the world, zero where there is nothing.
    """

    def __init__(self, rgba: Bytes, depth: Floats | None = None, ids: Integers | None = None,
                 normals: Floats | None = None) -> None:
        """Keeps the arrays, without copies."""
        array("rgba", rgba, (None, None, 4))
        if not isinstance(rgba, np.ndarray) or rgba.dtype != np.uint8 or not rgba.size:
            raise Error(f"rgba must hold bytes, at least one pixel, not {shown(rgba)}")
        self.rgba = rgba
        h, w = rgba.shape[:2]
        for name, value, shape in (("depth", depth, (h, w)), ("ids", ids, (h, w)),
                                   ("normals", normals, (h, w, 3))):
            if value is not None:
                array(name, value, shape)
        self.depth = np.full((h, w), np.inf, np.float32) if depth is None else depth
        self.ids = np.full((h, w), -1, np.int32) if ids is None else ids
        self.normals = np.zeros((h, w, 3), np.float32) if normals is None else normals
        self.parts: tuple[Any, ...] = ()
        self.written: frozenset[int] = frozenset()    # the parts whose text can be seen

    @property
    def size(self) -> tuple[int, int]:
        """Width and height."""
        return self.rgba.shape[1], self.rgba.shape[0]

    def __repr__(self) -> str:
        """Says the size."""
        covered = float((self.ids >= 0).mean())
        return f"<shade_h.Picture {self.size[0]} x {self.size[1]}, {covered:.0%} covered>"

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> Any:
        """numpy.asarray(picture) is its bytes, (H, W, 4)."""
        if dtype is not None and np.dtype(dtype) != np.uint8:
            return self.rgba.astype(dtype)
        return self.rgba.copy() if copy else self.rgba

    @property
    def blank(self) -> bool:
        """Is there no part in the picture, or none that differs from what is behind?"""
        return not bool((self.ids >= 0).any()) or self._hidden()

    def _hidden(self) -> bool:
        """Do all parts have the colour of what is behind them?"""
        there = self.ids >= 0
        if there.all():
            return False
        shown = np.where(self.rgba[..., 3:] > 0, self.rgba, 0).astype(np.int32)
        behind = shown[~there]
        return bool(np.ptp(shown[there], 0).max() <= 2 and
                    np.abs(shown[there] - behind[0]).max() <= 2 and np.ptp(behind, 0).max() <= 2)

    def report(self) -> str:
        """What is in the picture, in words, for a program that cannot look: what is covered, the
        box around the scene, and of each part its sides and its share of the picture.  A part is
        thin where its least side is below a hundredth of its greatest."""
        height, width = self.ids.shape
        y, x = np.nonzero(self.ids >= 0)
        if not len(x):
            lines = [f"{width} x {height} pixels, blank: no part is in view."]
        elif self._hidden():
            lines = [f"{width} x {height} pixels, blank: all parts have the colour of what is behind "
                     "them."]
        else:
            lines = [f"{width} x {height} pixels, {_percent(len(x) / self.ids.size)} covered, "
                     f"from column {x.min()} to {x.max()} and row {y.min()} to {y.max()}."]
            cut = [side for side, there in (("left", x.min() == 0), ("top", y.min() == 0),
                                            ("right", x.max() == width - 1),
                                            ("bottom", y.max() == height - 1)) if there]
            lines += [f"Parts reach over the border: {', '.join(cut)}."] if cut else []
        boxes = [_placed_box(part) for part in self.parts]
        if boxes:
            low, high = (np.array([box[k] for box in boxes]) for k in (0, 1))
            lines.append(f"The scene is {_sides(low.min(0), high.max(0))}, from "
                         f"{_point(low.min(0))} to {_point(high.max(0))}.")
        for number, (part, box) in enumerate(zip(self.parts, boxes)):
            lines.append(self._line_of(number, part, box))
        return "\n".join(lines)

    def _line_of(self, number: int, part: Any, box: tuple[Doubles, Doubles]) -> str:
        """A part in words."""
        there, sides = self.ids == number, box[1] - box[0]
        title = f"Part {number}{' ' + part.name if part.name else ''}: "
        if part.text is not None:
            there_is = "" if number in self.written else ", not in view"
            return f"{title}the text {part.text.words!r}{there_is}."
        if part.stroke is not None:
            return f"{title}{len(part.stroke.pairs) // 2} lines or points, {_sides(*box)}."
        words = f"{title}{len(part.mesh.faces)} triangles, {_sides(*box)}, "
        if there.any():
            depth = self.depth[there]
            words += f"{_percent(float(there.mean()))} of the picture, " \
                f"{depth.min():.6g} to {depth.max():.6g} before the eye"
        else:
            words += "not in view"
        bar = part.mesh.bar
        words += f"; {bar.title or 'scalars'} from {bar.low:.6g} to {bar.high:.6g}" if bar else ""
        return words + ("; thin." if sides.min() < 0.01 * sides.max() else ".")

    def png(self) -> bytes:
        """The bytes of a PNG file: RGB where every pixel is opaque, else RGBA."""
        return encode(self.rgba)

    def ppm(self) -> bytes:
        """The bytes of a PPM file (P6), which cannot be transparent."""
        if not (self.rgba[:, :, 3] == 255).all():
            raise Error("path: PPM has no alpha: save a .png, or draw with a background")
        width, height = self.size
        return b"P6\n%d %d\n255\n" % (width, height) + self.rgba[:, :, :3].tobytes()

    def _repr_png_(self) -> bytes:
        """Shows the picture in a notebook."""
        return self.png()

    def save(self, path: Any) -> None:
        """Writes a PNG or, where the path ends in .ppm, a PPM file.  A new one appears whole or not
        at all; one that exists stays the same file, with its mode and links.  Or writes the bytes of a PNG file into a file that is open for them.  A path must end in .png
        or .ppm, so that no model is taken for a picture."""
        if callable(getattr(path, "write", None)):
            path.write(self.png())
            return
        target = png_path("path", path, ".ppm")
        put_file(target, self.ppm() if target.suffix.lower() == ".ppm" else self.png())

    @staticmethod
    def open(path: Any) -> Picture:
        """Reads a PNG file, a path or an open file: grey, palette, RGB and RGBA of every depth, of
        which 16 bits are rounded to 8."""
        if callable(getattr(path, "read", None)):
            return Picture(decode(path.read(), "the file"))
        return Picture(decode(read_file(path, PICTURE_BYTES), os.fsdecode(path)))

    def __eq__(self, other: object) -> bool:
        """Are all bytes the same, those of pixels that cannot be seen too?"""
        return isinstance(other, Picture) and np.array_equal(self.rgba, other.rgba)

    __hash__ = None  # type: ignore[assignment]

    def difference(self, other: Picture) -> Integers:
        """The greatest difference of the channels of each pixel, (H, W), 0 .. 255, rounded upward.
        Colours count as much as they cover, as shade-compare has it: with alpha 0 any two are the
        same."""
        if not isinstance(other, Picture):
            raise Error(f"other must be a Picture, not {shown(other)}")
        if self.size != other.size:
            raise Error(f"other must be {self.size[0]} x {self.size[1]}, "
                        f"not {other.size[0]} x {other.size[1]}")
        one, two = (np.ascontiguousarray(picture.rgba) for picture in (self, other))
        apart = np.empty(one.shape[:2], np.int32)
        library.python_apart(pointer(one), pointer(two), apart.size, pointer(apart))
        return apart


def _percent(part: float) -> str:
    return f"{100 * part:.2g} %" if part < 0.1 else f"{100 * part:.0f} %"


def _point(p: Doubles) -> str:
    return "(" + ", ".join(f"{v:.6g}" for v in p) + ")"


def _sides(low: Doubles, high: Doubles) -> str:
    return " x ".join(f"{v:.6g}" for v in high - low)


def _placed_box(part: Any) -> tuple[Doubles, Doubles]:
    """The box around a part in its place."""
    points = part.mesh.drawn_vertices() + part.mesh.origin
    with np.errstate(all="ignore"):
        points = points @ part.pose[:3, :3].T + part.pose[:3, 3]
        points = points[(np.abs(points) <= 1e30).all(1)]
    return (points.min(0), points.max(0)) if len(points) else (np.zeros(3), np.zeros(3))


def read_file(path: Any, most: int) -> bytes:
    """The bytes of a regular file of at most so many: a device would not end, a pipe would wait."""
    try:
        name = os.fsdecode(path)
    except TypeError:
        raise Error(f"path must be a path, not {shown(path)}") from None
    if "\0" in name:
        raise Error("path must not contain a zero byte")
    more = getattr(os, "O_NONBLOCK", 0)
    with open(name, "rb", opener=lambda path, flags: os.open(path, flags | more)) as opened:
        there = os.fstat(opened.fileno())
        if not stat.S_ISREG(there.st_mode):
            raise Error(f"{name} is no regular file")
        if there.st_size > most:
            raise Error(f"{name} has {there.st_size} bytes; at most {most} are read")
        return opened.read(there.st_size)


def png_path(name: str, path: Any, other: str = ".png") -> Path:
    """A path that ends in .png or in another ending, in small or capital letters."""
    try:
        target = Path(os.fsdecode(path))
    except TypeError:
        raise Error(f"{name} must be a path, not {shown(path)}") from None
    if target.suffix.lower() not in (".png", other):
        also = f" or {other}" if other != ".png" else ""
        raise Error(f"{name} must end in .png{also}, which tells what is written, "
                    f"not {target.name!r}")
    return target


def encode(pixels: Array) -> bytes:
    """A PNG file of RGBA bytes, (H, W, 4), or of 16-bit numbers, (H, W)."""
    height, width = pixels.shape[:2]
    kind, lines = ctypes.c_int(0), np.empty(height * (1 + pixels[0].nbytes), np.uint8)
    rows = np.ascontiguousarray(pixels)
    if pixels.ndim == 2:
        size = library.python_png_lines16(pointer(rows), width, height, pointer(lines))
    else:
        size = library.python_png_lines(pointer(rows), width, height, ctypes.addressof(kind), pointer(lines))
    if not size:
        raise MemoryError("memory is not enough for the picture")
    packed = zlib.compress(lines[:size].data, 6)
    file = np.empty(len(packed) + 70, np.uint8)    # PNG_AROUND
    return file[:library.python_png_file(width, height, kind, packed, len(packed), pointer(file))].tobytes()


def decode(data: bytes, name: str, numbers: bool = False) -> Array:
    """The pixels of a PNG file: RGBA bytes, or the numbers of a grey one as they are stored."""
    file, facts = ctypes.create_string_buffer(256), np.zeros(4)

    def refuse(wrong: Any) -> None:
        if wrong:
            raise Error(f"{name} {wrong.decode()}")

    refuse(library.python_png_open(file, data, len(data), pointer(facts)))
    width, height, packed, wanted = (int(fact) for fact in facts)
    if max(width, height) > 16384 or width * height > PIXELS:
        raise Error(f"{name} has {width} x {height} pixels; at most {PIXELS} are read, and 16384 a side")
    parts = np.empty(packed, np.uint8)
    library.python_png_gather(file, pointer(parts))
    try:
        lines = np.frombuffer(bytearray(zlib.decompressobj().decompress(parts.data, wanted)), np.uint8)
    except zlib.error as why:
        raise Error(f"{name}: {why}") from None
    if len(lines) != wanted:
        raise Error(f"{name} ends early")
    pixels: Array = np.empty((height, width) if numbers else (height, width, 4), np.uint16 if numbers else np.uint8)
    read = library.python_png_grey if numbers else library.python_png_rgba
    refuse(read(file, pointer(lines), pointer(pixels)))
    return pixels


def assert_same(picture: Picture, golden: File, limit: int = 0) -> None:
    """Raises AssertionError where a picture differs from a golden file by more than limit, as
    difference has it: what cannot be seen does not count.

    Then NAME.got.png and NAME.difference.png appear beside the golden file.  Where there is no
    golden file, the picture is written as NAME.got.png: look at it, and rename it.
    """
    path, limit = png_path("golden", golden), integer("limit", limit, 0, 255)
    got, shows = path.with_suffix(".got.png"), path.with_suffix(".difference.png")
    if not path.exists():
        picture.save(got)
        raise AssertionError(f"there is no {path}; the picture is in {got}")
    wanted = Picture.open(path)
    if wanted.size != picture.size:
        picture.save(got)
        raise AssertionError(f"{path} is {wanted.size}, the picture {picture.size}; see {got}")
    apart = picture.difference(wanted)
    count = int((apart > limit).sum())
    if count:
        picture.save(got)
        rgba = np.full((*apart.shape, 4), 255, np.uint8)
        rgba[:, :, :3] = np.where(apart > limit, np.clip(64 + 3 * apart, 0, 255), 0)[:, :, None]
        Picture(rgba).save(shows)
        raise AssertionError(f"{count} pixels differ from {path}, by {apart.max()} at most; "
                             f"see {got} and {shows}")
