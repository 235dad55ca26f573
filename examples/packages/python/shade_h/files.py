"""Files of models."""
from __future__ import annotations

import ctypes
import io
import os
import warnings
import zlib
from importlib import import_module
from typing import Any

import numpy as np

from . import _arguments as arguments, cloud
from ._native import INFLATE, Bytes, Error, FilePicture, Run, copied, interruptible, library, pointer
from .annotate import display as _display
from .light import Material
from .mesh import Mesh, Surface
from .picture import PICTURE_BYTES, PIXELS, SIGNATURE, Picture, read_file

MODEL_BYTES = 4_000_000_000
AXES = ("x", "y", "z", "-x", "-y", "-z")


# ---- pictures on surfaces ------------------------------------------------------------------------

def decoded(data: bytes, name: str) -> Bytes:
    """RGBA of the bytes of a picture: PNG as it is, other kinds where Pillow is installed."""
    if data.startswith(SIGNATURE):
        try:
            return Picture.open(io.BytesIO(data)).rgba
        except Error:
            pass    # palettes, 16 bits and interlaced files are for Pillow
    try:
        image = import_module("PIL.Image").open(io.BytesIO(data))
        if image.size[0] * image.size[1] > PIXELS:
            raise Error(f"{name} has {image.size[0]} x {image.size[1]} pixels; "
                        f"at most {PIXELS} are read")
        return np.asarray(image.convert("RGBA"))
    except ImportError:
        raise Error(f"{name} needs Pillow, which is not installed") from None
    except Error:
        raise
    except Exception as why:    # whatever Pillow raises for a damaged file
        raise Error(f"{name} cannot be read: {type(why).__name__}") from None


def _image(model: str, name: str, outside: bool) -> Bytes | None:
    """The pixels of a picture beside the model; None, with a warning, where it cannot be read.  A
    name that leaves the model's folder counts only where the caller wants that."""
    folder, words = os.path.dirname(model), name.replace("\\", "/")
    near = outside or library.python_beside(os.fsencode(name))
    why = f"{words} is missing" if near else f"{words} lies outside of the model's folder"
    for path in ([os.path.join(folder, words)] if near else []) + \
            [os.path.join(folder, os.path.basename(words))]:
        try:
            return decoded(read_file(path, PICTURE_BYTES), words)
        except FileNotFoundError:
            pass
        except (OSError, Error) as reason:
            why = str(reason)
    _warn(f"{model}: {why}; its faces are drawn without it")
    return None


def _warn(words: str) -> None:
    warnings.warn(words, stacklevel=4)


# ---- by the reader of the programs ---------------------------------------------------------------

def _pictures(owned: Any, model: str, outside: bool) -> list[Any]:
    """The pixels of the pictures that faces show, which the library is told; None for others."""
    beside, one = ctypes.c_int(), FilePicture()
    images: list[Any] = [None] * library.python_pictures(owned, ctypes.byref(beside))
    for i in range(len(images)):
        if not library.python_picture_shown(owned, i):
            continue
        library.python_picture_of(owned, i, ctypes.byref(one))
        if i >= beside.value:
            images[i] = _image(model, os.fsdecode(one.name), outside)
        elif one.bytes:
            try:
                images[i] = decoded(ctypes.string_at(one.bytes, one.size), "a picture")
            except Error as why:
                _warn(f"{model}: {why}; its faces are drawn without it")
    for i, image in enumerate(images):
        if image is not None:
            images[i] = rgba = np.ascontiguousarray(image)
            library.python_picture_set(owned, i, pointer(rgba), rgba.shape[1], rgba.shape[0])
    library.python_heed_pictures(owned)
    return images


def _look(owned: Any, run: Any, images: list[Any]) -> Surface:
    """A surface as Mesh takes it."""
    k, material, shown = run.material, None, {}
    for name, number in (("texture", run.map), ("relief", run.relief), ("glow", run.glow)):
        if number >= 0 and images[number] is not None:
            shown[name] = number
    if run.set:
        material = Material(tuple(k.emission[:]), tuple(k.ambient[:]), tuple(k.diffuse[:]),
                            tuple(k.specular[:]), k.shininess)
    wrap = FilePicture()
    if shown:
        library.python_picture_of(owned, next(iter(shown.values())), ctypes.byref(wrap))
    holes = "texture" in shown and not run.opaque
    return Surface(material=material, blend=bool(run.blended) or run.transparency > 0,
                   opacity=1 - run.transparency, cutoff=run.alpha_cutoff if holes else 0.0,
                   wrap=(arguments.WRAPS[wrap.wrap[0]], arguments.WRAPS[wrap.wrap[1]]), squares=bool(wrap.squares),
                   metal=run.metal, roughness=run.rough, strength=run.relief_strength,
                   glow_factor=tuple(run.glow_factor[:]), unlit=bool(run.unlit),
                   **{name: images[number] for name, number in shown.items()})


def _surfaces(owned: Any, model: str, faces: int, uv: Any, outside: bool) -> dict[str, Any]:
    """What the file says of its surfaces, as options of Mesh."""
    number, looks = np.zeros(faces, int), [Surface()]
    known: dict[int, int] = {}
    images = _pictures(owned, model, outside) if uv is not None else []
    for i in range(library.python_part_of(owned, -1, None)):
        run = Run()
        library.python_part_of(owned, i, ctypes.byref(run))
        if run.surface not in known:
            look = _look(owned, run, images)
            told = run.set or look.mapped or run.transparency
            known[run.surface] = len(looks) if told else 0
            looks += [look] if told else []
        number[run.first // 3:(run.first + run.count) // 3] = known[run.surface]
    if len(looks) == 1:
        return {}
    mapped = any(look.mapped for look in looks)
    return {"surfaces": (number, looks), **({"uv": np.stack([uv[:, 0], 1 - uv[:, 1]], 1)} if mapped else {})}


def _unpack(packed: int, packed_size: int, out: int, size: int) -> int:
    """Unpacks a file of an archive to as many bytes as the archive says."""
    try:
        made = zlib.decompressobj(-15).decompress(ctypes.string_at(packed, packed_size), size + 1)
    except (zlib.error, MemoryError):
        return 1
    if len(made) == size:
        ctypes.memmove(out, made, size)
    return int(len(made) != size)


_inflate = INFLATE(_unpack)


def _read(data: bytes, name: str, path: bytes | None, outside: bool = False) -> \
        tuple[Any, dict[str, Any]]:
    """Vertices and faces, and options of Mesh."""
    words = ctypes.create_string_buffer(400)
    title = os.fsencode(name)

    def read(stop: ctypes.c_int) -> Any:
        return library.python_read(data, len(data), title, path, _inflate, words, len(words),
                                   ctypes.addressof(stop))

    owned = interruptible(read, library.python_unload)
    if not owned:
        raise Error(words.value.decode("utf-8", "replace") or "out of memory")
    try:
        view, own = owned.contents.view, owned.contents
        vertices = copied(own.positions, view.vertex_count, 3, ctypes.c_float)
        faces = copied(own.indices, view.index_count // 3, 3, ctypes.c_uint)
        origin = np.array(library.python_origin(owned)[:3])
        if origin.any():
            vertices = vertices + origin
        colors = copied(own.colors, view.vertex_count, 3, ctypes.c_float)
        uv = copied(own.texcoords, view.vertex_count, 2, ctypes.c_float)
        found = {"up": None} if faces is None else _surfaces(owned, name, len(faces), uv, outside)
        if library.python_normals(owned):
            found["normals"] = copied(own.normals, view.vertex_count, 3, ctypes.c_float)
        if faces is not None:
            found["up"] = AXES[library.python_upright(owned)]
        if library.python_warning(owned):
            _warn(library.python_warning(owned).decode("utf-8", "replace"))
    finally:
        library.python_unload(owned)
    if colors is not None:
        found["color"] = _display(colors)
    return (vertices, faces), found


# ---- all -----------------------------------------------------------------------------------------

def load(path: Any, *, outside: bool = False, **options: Any) -> Mesh:
    """Reads an STL (binary or text), OBJ, PLY, OFF, GLB, glTF or 3MF file: a path, or a file open
    for bytes.  options are those of Mesh.  All that a file shows is one mesh.  Pictures outside of
    its folder are read where outside is set: a model of strangers names whatever it likes.

    Without a color or texture of their own meshes have those of the file: colours by vertex or
    face, the materials, pictures and transparency of OBJ's MTL, the materials of glTF as their
    nearest Phong.  What is missing there is a warning.

    Raises OSError where the file cannot be opened, and Error with the line where it is wrong.
    """
    beside: bytes | None = None
    if callable(getattr(path, "read", None)):
        data, name = path.read(), "model"
        if not isinstance(data, bytes):
            raise Error(f"path must be open for bytes, not for {type(data).__name__}")
    else:
        data = read_file(path, MODEL_BYTES)
        name, beside = os.fsdecode(path), os.fsencode(path)
    (vertices, faces), found = _read(data, name, beside, arguments.flag("outside", outside))
    plain = any(options.get(k) is not None for k in ("color", "texture", "surfaces"))
    if plain:
        found = {"up": found["up"]}
    if faces is None:
        vertices, faces, options = cloud.balls(vertices, {**found, **options}, f"{name}: ")
        found = {}
    return Mesh(vertices, faces, **{**found, **options})
