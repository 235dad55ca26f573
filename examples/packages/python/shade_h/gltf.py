"""Reads glTF 2.0: GLB, and JSON with buffers beside it."""
from __future__ import annotations

import base64
import binascii
import json
import math
import os
import struct
from typing import Any, Callable

import numpy as np

from ._native import Array, Doubles, Error
from .light import Material
from .mesh import Surface

TRIANGLES = 20_000_000    # of all instances together
NODES = 100_000
DEPTH = 200
KINDS = {5120: "<i1", 5121: "<u1", 5122: "<i2", 5123: "<u2", 5125: "<u4", 5126: "<f4"}
WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}
#: Extensions without which a file can be shown; others that a file requires are refused.
KNOWN = {"KHR_mesh_quantization", "KHR_texture_transform", "KHR_materials_unlit",
         "KHR_materials_emissive_strength", "KHR_materials_specular", "KHR_materials_ior",
         "KHR_materials_clearcoat", "KHR_materials_sheen", "KHR_materials_transmission",
         "KHR_materials_volume", "KHR_lights_punctual", "EXT_mesh_gpu_instancing"}


def _chunks(data: bytes) -> tuple[bytes, bytes]:
    """The JSON and the buffer of a GLB file."""
    if len(data) < 20:
        raise Error("the header of GLB is cut off")
    version, length = struct.unpack_from("<II", data, 4)
    if version != 2:
        raise Error(f"glTF {version} is not read, 2 is")
    text, binary, at = b"", b"", 12
    while at + 8 <= min(length, len(data)):
        size, kind = struct.unpack_from("<II", data, at)
        if at + 8 + size > len(data):
            raise Error("a chunk of GLB is cut off")
        body = data[at + 8:at + 8 + size]
        text = body if kind == 0x4E4F534A and not text else text
        binary = body if kind == 0x004E4942 and not binary else binary
        at += 8 + size
    return text, binary


class _File:
    """The JSON of a file, and what it refers to, each access checked."""

    def __init__(self, data: bytes, beside: Callable[[str], bytes]) -> None:
        text, self.binary = _chunks(data) if data[:4] == b"glTF" else (data, b"")
        try:
            self.json = json.loads(text.decode("utf-8-sig"))
        except (ValueError, RecursionError) as why:
            raise Error(f"its JSON is wrong: {str(why)[:100]}") from None
        if not isinstance(self.json, dict):
            raise Error("its JSON is no object")
        version = _dict(self.json, "asset").get("version", "1")
        if not str(version).startswith("2"):
            raise Error(f"glTF {str(version)[:10]} is not read, 2 is")
        self.beside = beside
        self.buffers: dict[int, bytes] = {}
        needed = set(map(str, self.list_of(self.json, "extensionsRequired"))) - KNOWN
        if needed:
            raise Error(f"it needs {', '.join(sorted(needed))}, which is not read")

    def list_of(self, where: dict[str, Any], name: str) -> list[Any]:
        """An array of JSON, empty where there is none."""
        got = where.get(name, [])
        if not isinstance(got, list):
            raise Error(f"{name} is no array")
        return got

    def item(self, name: str, number: object) -> dict[str, Any]:
        """One object of an array at the top."""
        items = self.list_of(self.json, name)
        if isinstance(number, bool) or not isinstance(number, int) or \
                not 0 <= number < len(items) or not isinstance(items[number], dict):
            raise Error(f"there is no {name}[{str(number)[:20]}]")
        found: dict[str, Any] = items[number]
        return found

    def buffer(self, number: int) -> bytes:
        """The bytes of a buffer."""
        if number not in self.buffers:
            uri = self.item("buffers", number).get("uri")
            self.buffers[number] = self.binary if uri is None else self.uri(uri)
        return self.buffers[number]

    def uri(self, uri: object) -> bytes:
        """What a URI holds, or the file beside the model that it names."""
        if not isinstance(uri, str):
            raise Error("a URI is no text")
        if uri.startswith("data:"):
            try:
                return base64.b64decode(uri.partition(",")[2], validate=True)
            except (binascii.Error, ValueError):
                raise Error("a data URI is no base64") from None
        return self.beside(uri)

    def view(self, number: object) -> tuple[bytes, int]:
        """The bytes of a view, and its stride or 0."""
        view = self.item("bufferViews", number)
        start = whole(view, "byteOffset", 0)
        size, stride = whole(view, "byteLength", 0), whole(view, "byteStride", 0)
        got = self.buffer(whole(view, "buffer", 0))
        if start + size > len(got):
            raise Error(f"bufferViews[{number}] ends behind its buffer")
        return got[start:start + size], stride

    def accessor(self, number: object, width: int | tuple[int, ...]) -> Array:
        """The values of an accessor, (n, width)."""
        it = self.item("accessors", number)
        count = whole(it, "count", 0)
        kind = KINDS.get(it.get("componentType", 0)) if \
            isinstance(it.get("componentType"), int) else None
        wide = WIDTHS.get(str(it.get("type")))
        widths = width if isinstance(width, tuple) else (width,)
        if kind is None or wide not in widths or count > 3 * TRIANGLES:
            raise Error(f"accessors[{number}] has another type, or too many values")
        if "bufferView" in it:
            got = self._strided(it["bufferView"], whole(it, "byteOffset", 0), count, kind, wide,
                                f"accessors[{number}]")
        else:
            got = np.zeros((count, wide), kind)
        if isinstance(it.get("sparse"), dict):
            got = self._sparse(it["sparse"], got, kind, wide)
        if it.get("normalized") is True and got.dtype.kind != "f":
            most = np.iinfo(got.dtype).max
            return np.asarray(np.maximum(got.astype(np.float64) / most, -1))
        return got

    def _strided(self, view: object, start: int, count: int, kind: str, width: int,
                 what: str) -> Array:
        data, stride = self.view(view)
        size = np.dtype(kind).itemsize * width
        step = stride or size
        if step < size or (count and start + (count - 1) * step + size > len(data)):
            raise Error(f"{what} ends behind its view")
        if not count:
            return np.zeros((0, width), kind)
        return np.ndarray((count, width), kind, data, start,
                          (step, np.dtype(kind).itemsize)).copy()

    def _sparse(self, sparse: dict[str, Any], base: Array, kind: str, width: int) -> Array:
        count = whole(sparse, "count", 0)
        indices, values = sparse.get("indices"), sparse.get("values")
        if not isinstance(indices, dict) or not isinstance(values, dict) or count > len(base):
            raise Error("a sparse accessor is wrong")
        of = {5121: "<u1", 5123: "<u2", 5125: "<u4"}.get(whole(indices, "componentType", 0))
        if of is None:
            raise Error("a sparse accessor has indices of another type")
        at = self._strided(indices.get("bufferView"), whole(indices, "byteOffset", 0), count, of, 1,
                           "a sparse accessor")[:, 0]
        if count and at.max() >= len(base):
            raise Error("a sparse accessor points behind its end")
        base[at] = self._strided(values.get("bufferView"), whole(values, "byteOffset", 0), count,
                                 kind, width, "a sparse accessor")
        return base


def whole(where: dict[str, Any], name: str, default: int) -> int:
    """A number of JSON that counts something."""
    got = where.get(name, default)
    if isinstance(got, float) and abs(got) < 1e15 and got == math.floor(got):
        got = int(got)
    if isinstance(got, bool) or not isinstance(got, int) or not 0 <= got < 2**40:
        raise Error(f"{name} is no whole number")
    return got


def _floats(where: Any, name: str, default: tuple[float, ...]) -> list[float]:
    """Some finite numbers of JSON."""
    got = where.get(name, default) if isinstance(where, dict) else default
    if not isinstance(got, (list, tuple)) or len(got) != len(default) or \
            not all(isinstance(v, (int, float)) and abs(v) < 1e30 for v in got):
        raise Error(f"{name} must be {len(default)} numbers")
    return [float(v) for v in got]


def _float(where: Any, name: str, default: float) -> float:
    """One finite number of JSON."""
    got = where.get(name, default) if isinstance(where, dict) else default
    if not isinstance(got, (int, float)) or not abs(got) < 1e30:
        raise Error(f"{name} is no number")
    return float(got)


def _dict(where: Any, name: str) -> dict[str, Any]:
    got = where.get(name) if isinstance(where, dict) else None
    return got if isinstance(got, dict) else {}


def _matrix(node: dict[str, Any]) -> Doubles:
    """The place of a node in its parent."""
    if "matrix" in node:
        return np.array(_floats(node, "matrix", (0.0,) * 16)).reshape(4, 4).T
    out = np.eye(4)
    q = np.array(_floats(node, "rotation", (0.0, 0.0, 0.0, 1.0)))
    length = float(np.linalg.norm(q))
    x, y, z, w = (q / length).tolist() if length > 0 else [0.0, 0.0, 0.0, 1.0]
    out[:3, :3] = [[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                   [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                   [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]]
    out[:3, :3] *= _floats(node, "scale", (1.0, 1.0, 1.0))
    out[:3, 3] = _floats(node, "translation", (0.0, 0.0, 0.0))
    return out


def _phong(material: dict[str, Any]) -> Material:
    """The nearest Phong: a highlight as wide as the roughness says, a metal's in its own colour."""
    pbr = _dict(material, "pbrMetallicRoughness")
    base = np.clip(_floats(pbr, "baseColorFactor", (1.0, 1.0, 1.0, 1.0))[:3], 0, 1)
    metal = min(max(_float(pbr, "metallicFactor", 1.0), 0.0), 1.0)
    rough = min(max(_float(pbr, "roughnessFactor", 1.0), 0.05), 1.0)
    if "metallicRoughnessTexture" in pbr:
        metal, rough = 0.0, max(rough, 0.5)    # the picture says where, which a Phong cannot
    extensions = _dict(material, "extensions")
    shine = _float(_dict(extensions, "KHR_materials_emissive_strength"), "emissiveStrength", 1.0)
    glow = np.clip(np.array(_floats(material, "emissiveFactor", (0.0, 0.0, 0.0))) * shine, 0, 100)
    if "emissiveTexture" in material:
        glow = glow * 0
    if "KHR_materials_unlit" in extensions:
        return Material(tuple(base.tolist()), (0, 0, 0), (0, 0, 0))
    # there is nothing to be mirrored: half of a metal's light is diffuse
    diffuse = tuple((base * (1 - metal / 2)).tolist())
    specular = tuple(((0.04 + (base - 0.04) * metal) * (1.5 - rough)).tolist())
    return Material(tuple(glow.tolist()), diffuse, diffuse, specular,
                    min(2 / rough**4 - 2, 1000.0))


class _Scene:
    """Collects the triangles of all nodes."""

    def __init__(self, file: _File, picture: Callable[[bytes | None, str], Array | None],
                 warn: Callable[[str], None]) -> None:
        self.file, self.picture, self.warn = file, picture, warn
        self.vertices: list[Array] = []
        self.faces: list[Array] = []
        self.normals: list[Array | None] = []
        self.uv: list[Array] = []
        self.colors: list[Array | None] = []
        self.numbers: list[Array] = []
        self.looks: list[Surface] = []
        self.known: dict[Any, int] = {}
        self.images: dict[Any, Array | None] = {}
        self.nodes = self.triangles = self.count = 0

    def image(self, texture: dict[str, Any]) -> Array | None:
        """The pixels of a texture; None where it cannot be read."""
        number = texture.get("index")
        source = self.file.item("textures", number).get("source")
        if source not in self.images:
            image = self.file.item("images", source)
            try:
                data = self.file.view(image["bufferView"])[0] if "bufferView" in image \
                    else self.file.uri(image.get("uri"))
                self.images[source] = self.picture(data, f"images[{source}]")
            except (Error, OSError) as why:
                self.warn(f"{why}; its faces are drawn without it")
                self.images[source] = None
        return self.images[source]

    def surface(self, number: object) -> tuple[int, dict[str, Any]]:
        """The number of a surface, and its texture in the JSON."""
        material = {} if number is None else self.file.item("materials", number)
        texture = _dict(_dict(material, "pbrMetallicRoughness"), "baseColorTexture")
        if number not in self.known:
            self.known[number] = len(self.looks)
            self.looks.append(self._surface(number, material, texture))
        return self.known[number], texture

    def _surface(self, number: object, material: dict[str, Any],
                 texture: dict[str, Any]) -> Surface:
        mode = material.get("alphaMode", "OPAQUE")
        image = self.image(texture) if texture else None
        pbr = _dict(material, "pbrMetallicRoughness")
        alpha = min(max(_floats(pbr, "baseColorFactor", (1.0, 1.0, 1.0, 1.0))[3], 0.0), 1.0)
        cutoff = min(max(_float(material, "alphaCutoff", 0.5), 0.0), 1.0)
        plain = {"pbrMetallicRoughness": {"metallicFactor": 0.0}} if number is None else material
        return Surface(_phong(plain), image, mode == "BLEND", alpha,
                       cutoff / max(alpha, 1e-3) if mode == "MASK" and image is not None else 0.0)

    def visit(self, number: object, place: Doubles, depth: int) -> None:
        """A node and those below it."""
        self.nodes += 1
        if depth > DEPTH or self.nodes > NODES:
            raise Error(f"there are more than {NODES} nodes, {DEPTH} deep, or they go in circles")
        node = self.file.item("nodes", number)
        with np.errstate(all="ignore"):
            here = place @ _matrix(node)
        if "mesh" in node:
            mesh = self.file.item("meshes", node["mesh"])
            for primitive in self.file.list_of(mesh, "primitives"):
                if isinstance(primitive, dict):
                    self.primitive(primitive, here)
        for child in self.file.list_of(node, "children"):
            self.visit(child, here, depth + 1)

    def primitive(self, it: dict[str, Any], place: Doubles) -> None:
        """Triangles, strips or fans in a place."""
        attributes = _dict(it, "attributes")
        mode = whole(it, "mode", 4)
        if mode < 4 or mode > 6 or "POSITION" not in attributes:
            self.warn("points and lines are not drawn")
            return
        if "KHR_draco_mesh_compression" in _dict(it, "extensions"):
            raise Error("it needs KHR_draco_mesh_compression, which is not read")
        points = self.file.accessor(attributes["POSITION"], 3).astype(np.float64)
        index = self.file.accessor(it["indices"], 1)[:, 0] if "indices" in it \
            else np.arange(len(points))
        if index.dtype.kind not in "iu" or \
                len(index) and not 0 <= index.min() <= index.max() < len(points):
            raise Error("an index points behind the vertices")
        faces = _triangles(index.astype(np.int64), mode)
        with np.errstate(all="ignore"):
            turn, placed = place[:3, :3], points @ place[:3, :3].T + place[:3, 3]
            if np.linalg.det(turn) < 0:
                faces = faces[:, ::-1]
        self.triangles += len(faces)
        if self.triangles > TRIANGLES:
            raise Error(f"there are more than {TRIANGLES} triangles")
        number, texture = self.surface(it.get("material"))
        self.vertices.append(placed)
        self.faces.append(faces + self.count)
        self.numbers.append(np.full(len(faces), number))
        self.count += len(points)
        self.normals.append(self._normals(attributes, turn, len(points)))
        self.uv.append(self._uv(attributes, texture, len(points)))
        color = attributes.get("COLOR_0")
        tint = None if color is None else self.file.accessor(color, (3, 4))[:, :3]
        self.colors.append(tint if tint is not None and len(tint) == len(points) else None)

    def _normals(self, attributes: dict[str, Any], turn: Doubles, count: int) -> Array | None:
        if "NORMAL" not in attributes:
            return None
        normals = self.file.accessor(attributes["NORMAL"], 3).astype(np.float64)
        if len(normals) != count:
            return None
        with np.errstate(all="ignore"):
            cofactor = np.stack([np.cross(turn[1], turn[2]), np.cross(turn[2], turn[0]),
                                 np.cross(turn[0], turn[1])])
            turned = normals @ cofactor.T * (-1 if np.linalg.det(turn) < 0 else 1)
            turned = turned / np.linalg.norm(turned, axis=1, keepdims=True)
        return np.asarray(np.nan_to_num(turned))

    def _uv(self, attributes: dict[str, Any], texture: dict[str, Any], count: int) -> Array:
        change = _dict(_dict(texture, "extensions"), "KHR_texture_transform")
        which = whole({**texture, **change}, "texCoord", 0)
        name = attributes.get(f"TEXCOORD_{which}")
        uv = np.zeros((count, 2))
        if name is not None and texture:
            got = self.file.accessor(name, 2).astype(np.float64)
            uv = got if len(got) == count else uv
        if change:
            angle = _float(change, "rotation", 0.0)
            c, s = math.cos(angle), math.sin(angle)
            uv = uv * _floats(change, "scale", (1.0, 1.0)) @ np.array([[c, -s], [s, c]])
            uv = uv + _floats(change, "offset", (0.0, 0.0))
        return np.stack([uv[:, 0], 1 - uv[:, 1]], 1)

    def options(self, display: Callable[[Array], Array]) -> tuple[Any, dict[str, Any]]:
        """Vertices and faces, and what Mesh takes besides."""
        if not self.triangles:
            raise Error("there are no triangles")
        found: dict[str, Any] = {"up": "y", "surfaces": (np.concatenate(self.numbers), self.looks)}
        if all(n is not None for n in self.normals):
            found["normals"] = np.concatenate([n for n in self.normals if n is not None])
        if any(look.texture is not None for look in self.looks):
            found["uv"] = np.nan_to_num(np.concatenate(self.uv))
        if any(c is not None for c in self.colors):
            found["color"] = display(np.concatenate([
                np.ones((len(v), 3)) if c is None else c
                for v, c in zip(self.vertices, self.colors)]).astype(np.float64))
        return (np.concatenate(self.vertices), np.concatenate(self.faces)), found


def _triangles(index: Array, mode: int) -> Array:
    """The triangles of a list, a strip or a fan."""
    if mode == 4:
        return np.asarray(index[:len(index) // 3 * 3].reshape(-1, 3))
    if len(index) < 3:
        return np.zeros((0, 3), np.int64)
    if mode == 6:
        return np.stack([np.full(len(index) - 2, index[0]), index[1:-1], index[2:]], 1)
    faces = np.stack([index[:-2], index[1:-1], index[2:]], 1)
    faces[1::2] = faces[1::2, [1, 0, 2]]
    return np.asarray(faces)


def read(data: bytes, beside: Callable[[str], bytes],
         picture: Callable[[bytes | None, str], Array | None], warn: Callable[[str], None],
         display: Callable[[Array], Array]) -> tuple[Any, dict[str, Any]]:
    """Vertices and faces, and options of Mesh.  beside reads a file that the model names."""
    file = _File(data, beside)
    made = _Scene(file, picture, warn)
    scenes = file.list_of(file.json, "scenes")
    if scenes:
        roots = file.list_of(file.item("scenes", whole(file.json, "scene", 0)), "nodes")
    else:
        nodes = file.list_of(file.json, "nodes")
        below = {str(c) for n in nodes if isinstance(n, dict) for c in file.list_of(n, "children")}
        roots = [i for i in range(len(nodes)) if str(i) not in below]
    for root in roots:
        made.visit(root, np.eye(4), 0)
    return made.options(display)


def beside(folder: str, name: str) -> str:
    """The path of a file that a model names, which lies in its folder or below."""
    from urllib.parse import unquote
    words = os.path.normpath(unquote(name).replace("\\", "/"))
    if os.path.isabs(words) or words.startswith("..") or ":" in words or "\0" in words:
        raise Error(f"{name[:60]!r} does not lie beside the model")
    return os.path.join(folder, words)
