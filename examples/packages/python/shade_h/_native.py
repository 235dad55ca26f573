"""The compiled library: twins of its structs, and calls that raise exceptions."""
from __future__ import annotations

import ctypes
import struct
import sys
import threading
from ctypes import (POINTER, Structure, c_char_p, c_double, c_float, c_int, c_size_t, c_uint,
                    c_void_p)
from pathlib import Path
from typing import TYPE_CHECKING, Any, Callable

import numpy as np

if TYPE_CHECKING:
    import numpy.typing as npt
    Array = npt.NDArray[Any]
    Doubles = npt.NDArray[np.float64]
    Floats = npt.NDArray[np.float32]
    Integers = npt.NDArray[np.int32]
    Bytes = npt.NDArray[np.uint8]
    Indices = npt.NDArray[np.uint32]
else:    # numpy.typing takes as long to import as the rest of this file
    Array = Doubles = Floats = Integers = Bytes = Indices = np.ndarray


class Error(ValueError):
    """A refused argument: its name, and the words of the library or what was wanted."""


class Mesh(Structure):
    """shade_mesh"""
    _fields_ = [("positions", c_void_p), ("position_stride", c_int), ("normals", c_void_p),
                ("normal_stride", c_int), ("texcoords", c_void_p), ("texcoord_stride", c_int),
                ("colors", c_void_p), ("color_stride", c_int), ("vertex_count", c_int),
                ("indices", c_void_p), ("index_count", c_int), ("chunks", c_void_p),
                ("chunk_count", c_int), ("indices16", c_void_p)]


class Material(Structure):
    """shade_material"""
    _fields_ = [("emission", c_float * 3), ("ambient", c_float * 3), ("diffuse", c_float * 3),
                ("specular", c_float * 3), ("shininess", c_float)]


class Light(Structure):
    """shade_light"""
    _fields_ = [("position", c_float * 4), ("ambient", c_float * 3), ("diffuse", c_float * 3),
                ("specular", c_float * 3), ("constant", c_float), ("linear", c_float),
                ("quadratic", c_float), ("spot_direction", c_float * 3),
                ("spot_exponent", c_float), ("spot_cos_cutoff", c_float)]


class Lighting(Structure):
    """shade_lighting"""
    _fields_ = [("lights", POINTER(Light)), ("light_count", c_int), ("ambient", c_float * 3),
                ("model", c_int), ("flags", c_uint), ("terms", c_uint), ("cool", c_float * 3),
                ("warm", c_float * 3)]


class Texture(Structure):
    """shade_texture"""
    _fields_ = [("pixels", c_void_p), ("width", c_int), ("height", c_int), ("stride", c_int),
                ("format", c_int), ("srgb", c_int), ("wrap_u", c_int), ("wrap_v", c_int),
                ("filter", c_int), ("mipmaps", c_void_p), ("mipmap_count", c_int)]


class Raster(Structure):
    """shade_raster"""
    _fields_ = [("cull", c_int), ("depth_test", c_int), ("blend", c_int),
                ("depth_read_only", c_int), ("depth_zero_to_one", c_int), ("depth_bias", c_float)]


class State(Structure):
    """shade_draw_state"""
    _fields_ = [("model", c_float * 16), ("view", c_float * 16), ("projection", c_float * 16),
                ("material", POINTER(Material)), ("lighting", Lighting), ("shading", c_int),
                ("diffuse_map", POINTER(Texture)), ("transparency", c_float),
                ("alpha_cutoff", c_float), ("raster", Raster), ("fragment", c_void_p),
                ("uniforms", c_void_p)]


class Item(Structure):
    """python_item"""
    _fields_ = [("mesh", Mesh), ("state", State), ("lines", c_void_p), ("line_points", c_int),
                ("two_sided", c_int), ("lines_over", c_int), ("line_width", c_float),
                ("line_color", c_float * 4),
                ("id", c_int), ("blended", c_int), ("opacity", c_float), ("alpha_cutoff", c_float),
                ("metal", c_float), ("rough", c_float), ("relief", POINTER(Texture)),
                ("glow_map", POINTER(Texture)), ("relief_strength", c_float),
                ("relief_heights", c_int), ("glow", c_float * 3), ("unlit", c_int)]


class View(Structure):
    """python_view"""
    _fields_ = [("width", c_int), ("height", c_int), ("samples", c_int), ("channels", c_int),
                ("view", c_float * 16), ("projection", c_float * 16),
                ("background", c_float * 4), ("lighting", Lighting), ("poses", c_void_p),
                ("rgba", c_void_p), ("depth", c_void_p), ("normals", c_void_p),
                ("ids", c_void_p), ("in_studio", c_int), ("to_studio", c_float * 16), ("quick", c_int)]


#: renderer_picture: width, height, samples, channels, srgb, solid, parallel, object_count, pose_count;
#: near_z, far_z, empty_depth, tolerance; unused; view, projection; objects, poses, color, depth, ids,
#: normals
SHOT = struct.Struct("@9i4fi16d16f6P")


#: renderer_object
SOLID = np.dtype([("place", np.float64, 3), ("turn", np.float64, (3, 3)), ("kind", np.int32),
                  ("mesh", np.int32), ("texture", np.int32), ("flags", np.int32), ("id", np.int32),
                  ("first", np.int32), ("count", np.int32), ("size", np.float32, 3),
                  ("rgba", np.float32, 4), ("specular", np.float32, 3), ("shininess", np.float32),
                  ("emission", np.float32), ("glow", np.float32, 3), ("repeat", np.float32, 2),
                  ("metal", np.float32), ("tint", np.float32), ("cutoff", np.float32),
                  ("relief", np.int32), ("glow_map", np.int32), ("strength", np.float32),
                  ("glow_factor", np.float32, 3), ("unused", np.int32)])


class Image(Structure):
    """renderer_image"""
    _fields_ = [("rgba", c_void_p), ("width", c_int), ("height", c_int), ("faces", c_int),
                ("srgb", c_int), ("wrap_u", c_int), ("wrap_v", c_int), ("squares", c_int)]


class Chunk(Structure):
    """shade_chunk"""
    _fields_ = [("low", c_float * 3), ("high", c_float * 3), ("first", c_int), ("count", c_int)]


class Run(Structure):
    """python_part"""
    _fields_ = [("first", c_int), ("count", c_int), ("surface", c_int), ("set", c_int),
                ("opaque", c_int), ("blended", c_int), ("transparency", c_float),
                ("alpha_cutoff", c_float), ("material", Material), ("metal", c_float),
                ("rough", c_float), ("map", c_int), ("relief", c_int), ("glow", c_int),
                ("relief_strength", c_float), ("glow_factor", c_float * 3), ("unlit", c_int)]


class FilePicture(Structure):
    """python_picture"""
    _fields_ = [("name", c_char_p), ("kind", c_char_p), ("bytes", c_void_p), ("size", c_size_t),
                ("wrap", c_int * 2), ("squares", c_int), ("colors", c_int)]


class OwnedMesh(Structure):
    """owned_mesh, with which a model begins; its view has the counts"""
    _fields_ = [("view", Mesh), ("positions", c_void_p), ("normals", c_void_p),
                ("texcoords", c_void_p), ("colors", c_void_p), ("indices", c_void_p),
                ("chunks", c_void_p)]


class Refusal(Structure):
    """core_refusal"""
    _fields_ = [("code", c_int), ("argument", ctypes.c_char * 64), ("text", ctypes.c_char * 384)]


class Side(Structure):
    """core_side"""
    _fields_ = [("azimuth", c_double), ("elevation", c_double), ("up", c_int), ("width", c_int),
                ("height", c_int), ("ortho", c_int), ("fov", c_double), ("margin", c_double),
                ("room", c_double)]


class CameraOf(Structure):
    """core_camera"""
    _fields_ = [("view", c_double * 16), ("projection", c_double * 16)]


class Range(Structure):
    """core_range"""
    _fields_ = [("near", c_double), ("far", c_double), ("parallel", c_int)]


class Moved(Structure):
    """renderer_moved"""
    _fields_ = [("positions", c_void_p), ("given", c_void_p), ("faces", c_void_p), ("vertex_count", c_int),
                ("index_count", c_int), ("normals", c_int), ("unused", c_int), ("origin", c_double * 3)]


class Asked(Structure):
    """build_asked"""
    _fields_ = [(name, c_void_p) for name in ("positions", "normals", "colors", "uv", "indices")] + \
        [(name, c_int) for name in ("vertices", "corners", "color_count", "normals_kind")]


class Heights(Structure):
    """heights"""
    _fields_ = [("z", c_void_p), ("rows", c_int), ("columns", c_int), ("half", c_double * 2), ("scale", c_double),
                ("base", c_double), ("sides", c_int), ("unused", c_int)]


class MeshPart(Structure):
    """mjv_part"""
    _fields_ = [(name, c_void_p) for name in ("vertices", "normals", "uv", "vertex", "normal", "texcoord")] + \
        [(name, c_int) for name in ("vertex_count", "normal_count", "uv_count", "corners")]


#: zip_inflate
INFLATE = ctypes.CFUNCTYPE(c_int, c_void_p, c_size_t, c_void_p, c_size_t)


def _open() -> Any:
    name = "libshade.dll" if sys.platform == "win32" else "libshade.so"
    path = Path(__file__).with_name(name)
    if not path.is_file():
        raise ImportError(f"{path} is missing: install the package with pip, which compiles it")
    library = ctypes.CDLL(str(path))
    for name, result, arguments in (
            ("python_draw", c_int, [c_void_p, c_int, c_void_p, c_int, c_int, c_void_p]),
            ("python_lit", None, [c_void_p, c_void_p, c_void_p, c_void_p, c_size_t, c_void_p]),
            ("python_light_at", None, [c_void_p, c_void_p, c_size_t] + 3 * [c_void_p]),
            ("python_build", POINTER(Mesh), 2 * [c_void_p]),
            ("python_build_free", None, [POINTER(Mesh)]),
            ("python_local", c_int, 2 * [c_void_p, c_size_t] + 2 * [c_void_p]),
            ("python_seen", None, 2 * [c_void_p, c_size_t] + 2 * [c_void_p]),
            ("python_edges", c_int, 4 * [c_void_p]),
            ("python_drawn_edges", c_int, 2 * [c_void_p] + [c_int, c_void_p, c_void_p, c_int, c_double, c_void_p]),
            ("python_fill", c_void_p, [c_void_p, c_size_t, c_double, c_void_p, c_void_p]),
            ("python_give", None, [c_void_p]),
            ("python_has_letter", c_int, [c_int]),
            ("python_text", c_float, [c_char_p] + 3 * [c_float] + [c_void_p, c_int, c_int]),
            ("python_png_open", c_char_p, [c_void_p, c_char_p, c_size_t, c_void_p]),
            ("python_png_gather", None, [c_void_p, c_void_p]),
            ("python_png_rgba", c_char_p, [c_void_p, c_void_p, c_void_p]),
            ("python_png_grey", c_char_p, [c_void_p, c_void_p, c_void_p]),
            ("python_png_lines", c_size_t, [c_void_p, c_int, c_int, c_void_p, c_void_p]),
            ("python_png_lines16", c_size_t, [c_void_p, c_int, c_int, c_void_p]),
            ("python_png_file", c_size_t, [c_int, c_int, c_int, c_char_p, c_size_t, c_void_p]),
            ("python_depth_numbers", c_int, [c_void_p, c_char_p, c_void_p, c_size_t, c_double, c_void_p, c_int]),
            ("python_id_numbers", c_int, [c_void_p, c_char_p, c_void_p, c_size_t, c_size_t, c_void_p]),
            ("python_apart", None, [c_void_p, c_void_p, c_size_t, c_void_p]),
            ("python_linear", None, [c_void_p, c_size_t]),
            ("python_read", POINTER(OwnedMesh),
             [c_char_p, c_size_t, c_char_p, c_char_p, INFLATE, c_char_p, c_size_t, c_void_p]),
            ("python_beside", c_int, [c_char_p]),
            ("python_unload", None, [POINTER(OwnedMesh)]),
            ("python_origin", POINTER(c_double), [POINTER(OwnedMesh)]),
            ("python_normals", c_int, [POINTER(OwnedMesh)]),
            ("python_warning", c_char_p, [POINTER(OwnedMesh)]),
            ("python_upright", c_int, [POINTER(OwnedMesh)]),
            ("python_pictures", c_int, [POINTER(OwnedMesh), POINTER(c_int)]),
            ("python_picture_shown", c_int, [POINTER(OwnedMesh), c_int]),
            ("python_picture_of", None, [POINTER(OwnedMesh), c_int, c_void_p]),
            ("python_picture_set", None, [POINTER(OwnedMesh), c_int, c_void_p, c_int, c_int]),
            ("python_heed_pictures", None, [POINTER(OwnedMesh)]),
            ("python_texture_levels", c_int, 3 * [c_void_p] + [c_size_t, c_int]),
            ("python_heights", c_int, [c_void_p, c_int, c_int]),
            ("python_part_of", c_int, [POINTER(OwnedMesh), c_int, c_void_p]),
            ("python_color", c_int, [c_void_p, c_char_p, c_char_p, c_void_p]),
            ("python_colors", c_int, [c_void_p, c_char_p, c_void_p, c_size_t] + 3 * [c_int] + 2 * [c_void_p]),
            ("python_faces", c_int, [c_void_p, c_char_p, c_void_p, c_size_t, c_int, c_int, c_void_p]),
            ("python_look_at", c_int, 3 * [c_void_p]),
            ("python_opencv", c_int, 3 * [c_void_p] + [c_int, c_int, c_double, c_double, c_void_p]),
            ("python_opengl", c_int, 4 * [c_void_p]),
            ("python_range_of", c_int, [c_void_p, c_char_p, c_void_p, c_void_p]),
            ("python_view_name", c_char_p, [c_int, c_void_p]),
            ("python_direction", None, [c_double, c_double, c_int, c_void_p]),
            ("python_fit", c_int, [c_void_p, c_void_p, c_void_p, c_size_t, c_void_p]),
            ("python_eye", c_int, [c_void_p, c_int, c_void_p, c_void_p]),
            ("python_studio", None, [c_void_p, c_size_t, c_void_p, c_int, c_void_p]),
            ("python_place_all", None, [c_void_p, c_int, c_void_p]),
            ("python_scene_open", c_void_p, []),
            ("python_scene_close", None, [c_void_p]),
            ("python_scene_mesh", c_int, [c_void_p, c_int, c_void_p, c_int, c_void_p]),
            ("python_scene_heights", c_int, [c_void_p, c_int, c_void_p]),
            ("python_scene_deform", c_int, [c_void_p, c_int, c_void_p]),
            ("python_scene_texture", c_int, [c_void_p, c_int, c_void_p]),
            ("python_scene_add", c_int, [c_void_p, c_void_p, c_int]),
            ("python_scene_put", c_int, [c_void_p, c_int, c_void_p, c_int]),
            ("python_scene_put_all", c_int, [c_void_p, c_void_p, c_int]),
            ("python_scene_records", c_int, [c_void_p, c_int, c_void_p, c_int]),
            ("python_scene_next", c_int, [c_void_p, c_int]),
            ("python_scene_hold", c_int, [c_void_p]),
            ("python_scene_done", None, [c_void_p]),
            ("python_scene_light", None, 3 * [c_void_p] + [c_int, c_void_p, c_int]),
            ("python_scene_behind", None, [c_void_p, c_int, c_int, c_void_p]),
            ("python_not_rigid", c_int, [c_void_p, c_int]),
            ("python_scene_pose", c_int, 3 * [c_void_p] + [c_int]),
            ("python_renderer_open", c_void_p, []),
            ("python_renderer_close", None, [c_void_p]),
            ("python_renderer_draw", c_int, [c_void_p, c_int, c_void_p, c_void_p, c_int, c_void_p]),
            ("python_size", c_size_t, [c_int]),
            ("shade_result_string", c_char_p, [c_int]),
            ("python_mjv_texture", c_int, [c_void_p, c_int, c_void_p] + 4 * [c_int]),
            ("python_mjv_mesh", c_int, [c_void_p, c_int, c_void_p]),
            ("python_mjv_records", c_int, [c_void_p, c_int, c_int, c_void_p, c_void_p]),
            ("python_mjv_lights", c_int, 3 * [c_void_p] + 2 * [c_int]),
            ("python_mjv_aim", None, [c_void_p, c_double, c_void_p]),
            ("shade_chunk_count", c_int, [c_int, c_int]),
            ("shade_mesh_chunks", c_int, [c_void_p, c_int, c_void_p, c_int, c_void_p]),
            ("shade_mipmap_count", c_int, [c_int, c_int]),
            ("shade_mipmap_bytes", c_size_t, [c_int, c_int, c_int]),
            ("python_look_name", c_char_p, [c_int, c_void_p]),
            ("python_look", c_int, [c_char_p, c_void_p, c_void_p, c_char_p, c_int]),
            ("shade_preset_material", Material, [c_int]),
            ("shade_preset_name", c_char_p, [c_int]),
            ("shade_linear_material", Material, [Material])):
        function = getattr(library, name)
        function.restype, function.argtypes = result, arguments
    twins = (Mesh, State, Item, View, Lighting, Texture, Light, Chunk, Run, Image)
    for i, twin in enumerate(twins):
        if library.python_size(i) != ctypes.sizeof(twin):
            raise ImportError(f"{path} does not belong to this version: {twin.__doc__}")
    if (library.python_size(10), library.python_size(11)) != (SOLID.itemsize, SHOT.size):
        raise ImportError(f"{path} does not belong to this version: renderer_object")
    for i, twin in enumerate((FilePicture, Refusal, Side, CameraOf, Asked, Heights, MeshPart)):
        if library.python_size(12 + i) != ctypes.sizeof(twin):
            raise ImportError(f"{path} does not belong to this version: {twin.__doc__}")
    return library


library: Any = _open()


def check(result: int, what: str) -> None:
    """Raises an exception, with what was refused and why, where a call failed."""
    if result:
        words = library.shade_result_string(result).decode()
        raise Error(f"{what}: {words}")


def asked(function: Callable[..., Any], *given: Any) -> Any:
    """What a function of the core returns, of arrays among others; raises what it refuses, by the
    argument's name."""
    why = Refusal()
    got = function(ctypes.byref(why), *(pointer(one) if isinstance(one, np.ndarray) else one for one in given))
    if why.code:
        raise Error(f"{why.argument.decode()} {why.text.decode(errors='replace')}")
    return got


def interruptible(call: Callable[[c_int], Any], late: Callable[[Any], object] = bool) -> Any:
    """What call returns, which is given a number that Ctrl-C sets: it runs in a thread, because
    signals wait for the main one.  late gets what call returns when nobody waits for it."""
    stop, results, done = c_int(0), [], threading.Event()
    if threading.current_thread() is not threading.main_thread():
        return call(stop)

    def run() -> None:
        result = call(stop)
        if stop.value:
            late(result)
        else:
            results.append(result)
        done.set()    # a thread whose join was interrupted counts as ended in some Pythons

    threading.Thread(target=run, daemon=True).start()
    try:
        while not done.wait(0.1):
            pass
    except BaseException:
        stop.value = 1
        done.wait(0.5)    # what is begun is not waited for any longer
        while results:
            late(results.pop())
        raise
    return results[0]


def pointer(array: Array | None) -> int | None:
    """The address of an array's first element, or None."""
    return None if array is None else int(array.ctypes.data)


def copied(address: int | None, count: int, columns: int, kind: Any) -> Any:
    """Rows that the library holds; None where it has none."""
    if not address or not count:
        return None
    made = (kind * (count * columns)).from_address(address)
    return np.frombuffer(made, kind).reshape(count, columns).copy()


