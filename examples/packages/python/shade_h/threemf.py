"""Reads 3MF: a ZIP archive of XML with objects, their components, and where they are built."""
from __future__ import annotations

import io
import zipfile
import zlib
from typing import Any
from xml.parsers import expat

import numpy as np

from ._native import Array, Doubles, Error

TRIANGLES = 20_000_000    # of all instances together
INSTANCES = 100_000
DEPTH = 100
BYTES = 1_000_000_000     # of all XML, unpacked
FILES = 10_000
RATIO = 500               # unpacked to packed: text of numbers packs 5 to 20 times
COLORS = {"base": "displaycolor", "color": "color"}


class _Object:
    """An object of a model: a mesh, or components."""

    def __init__(self, pid: str, pindex: str) -> None:
        self.vertices: list[tuple[float, float, float]] = []
        self.faces: list[tuple[int, int, int]] = []
        self.marks: list[tuple[str, str]] = []
        self.components: list[tuple[str, str, Doubles]] = []
        self.pid, self.pindex = pid, pindex
        self.arrays: tuple[Array, Array, Array | None] | None = None


def _color(text: str) -> tuple[float, float, float]:
    digits = text.lstrip("#")
    try:
        value = int(digits[:6], 16) if len(digits) in (6, 8) else -1
    except ValueError:
        value = -1
    if value < 0:
        raise Error(f"{text[:20]!r} is no colour")
    return (value >> 16) / 255, (value >> 8 & 255) / 255, (value & 255) / 255


def _place(text: str | None) -> Doubles:
    """The matrix of a transform, which multiplies rows in the file."""
    out = np.eye(4)
    if text is None:
        return out
    try:
        numbers = np.array([float(word) for word in text.split()])
    except ValueError:
        numbers = np.zeros(0)
    if len(numbers) != 12 or not (np.abs(numbers) < 1e30).all():
        raise Error("a transform must be 12 numbers")
    out[:3] = numbers.reshape(4, 3).T
    return out


class _Model:
    """One file of XML."""

    def __init__(self, path: str) -> None:
        self.path = path
        self.objects: dict[tuple[str, str], _Object] = {}
        self.colors: dict[tuple[str, str], list[tuple[float, float, float]]] = {}
        self.items: list[tuple[str, str, Doubles]] = []
        self.now: _Object | None = None
        self.group: list[tuple[float, float, float]] | None = None
        self.faces = 0

    def parse(self, data: bytes) -> None:
        """Takes what stands in the XML; entities are refused, so that none can grow."""
        parser = expat.ParserCreate(namespace_separator=" ")
        parser.StartElementHandler = self.start
        parser.EndElementHandler = self.end
        parser.StartDoctypeDeclHandler = self.refuse
        parser.EntityDeclHandler = self.refuse
        parser.buffer_text = True
        try:
            parser.Parse(data, True)
        except expat.ExpatError as why:
            raise Error(f"{self.path}: its XML is wrong: {why}") from None
        except (KeyError, ValueError) as why:
            if isinstance(why, Error):
                raise
            raise Error(f"{self.path}:{parser.CurrentLineNumber}: an attribute is missing or "
                        f"wrong: {str(why)[:60]}") from None

    def refuse(self, *_: object) -> None:
        """A document type can declare entities that grow without end."""
        raise Error(f"{self.path}: document types and entities are refused")

    def start(self, tag: str, it: dict[str, str]) -> None:
        """An element begins."""
        name = tag.rpartition(" ")[2]
        now = self.now
        if name == "vertex" and now is not None:
            now.vertices.append((float(it["x"]), float(it["y"]), float(it["z"])))
        elif name == "triangle" and now is not None:
            now.faces.append((int(it["v1"]), int(it["v2"]), int(it["v3"])))
            self.faces += 1
            if self.faces > TRIANGLES:
                raise Error(f"there are more than {TRIANGLES} triangles")
            now.marks.append((it.get("pid", now.pid), it.get("p1", now.pindex)))
        elif name == "object":
            self.now = _Object(it.get("pid", ""), it.get("pindex", "0"))
            self.objects[self.path, it["id"]] = self.now
        elif name == "component" and now is not None:
            now.components.append((self._path(it), it["objectid"], _place(it.get("transform"))))
        elif name == "item":
            self.items.append((self._path(it), it["objectid"], _place(it.get("transform"))))
        elif name in ("basematerials", "colorgroup"):
            self.group = self.colors.setdefault((self.path, it["id"]), [])
        elif name in COLORS and self.group is not None:
            self.group.append(_color(it.get(COLORS[name], "#FFFFFF")))

    def end(self, tag: str) -> None:
        """An element ends."""
        name = tag.rpartition(" ")[2]
        if name == "object":
            self.now = None
        elif name in ("basematerials", "colorgroup"):
            self.group = None

    def _path(self, it: dict[str, str]) -> str:
        for key, value in it.items():
            if key.rpartition(" ")[2] == "path":
                return value.lstrip("/")
        return self.path


class _Archive:
    """The models of an archive, as far as its items ask for them."""

    def __init__(self, data: bytes) -> None:
        try:
            self.zip = zipfile.ZipFile(io.BytesIO(data))
            self.names = {info.filename.lstrip("/").lower(): info
                          for info in self.zip.infolist()[:FILES]}
        except Exception as why:    # zipfile raises many kinds for damaged archives
            raise Error(f"it is no ZIP archive: {str(why)[:60]}") from None
        self.left = BYTES
        self.models: dict[str, _Model] = {}
        self.vertices: list[Array] = []
        self.faces: list[Array] = []
        self.colors: list[Array | None] = []
        self.count = self.triangles = self.instances = 0

    def bytes_of(self, path: str) -> bytes:
        """A file of the archive, unpacked as far as the limits go."""
        info = self.names.get(path.lower())
        if info is None:
            raise Error(f"there is no {path[:60]} in the archive")
        most = min(self.left, RATIO * info.compress_size + 100_000)
        try:
            with self.zip.open(info) as file:
                data = file.read(most + 1)
        except (zipfile.BadZipFile, zlib.error, NotImplementedError, RuntimeError, EOFError,
                OSError, ValueError) as why:
            raise Error(f"{path[:60]} cannot be unpacked: {str(why)[:60]}") from None
        if len(data) > most:
            raise Error(f"{path[:60]} unpacks to more than {most} bytes")
        self.left -= len(data)
        return data

    def model(self, path: str) -> _Model:
        """A model, read when it is first asked for."""
        if path not in self.models:
            made = _Model(path)
            made.parse(self.bytes_of(path))
            self.models[path] = made
        return self.models[path]

    def root(self) -> str:
        """The name of the model that has the items."""
        found: list[str] = []

        def start(tag: str, it: dict[str, str]) -> None:
            if tag.endswith("Relationship") and it.get("Type", "").endswith("/3dmodel"):
                found.append(it.get("Target", "").lstrip("/"))

        if "_rels/.rels" in self.names:
            parser = expat.ParserCreate(namespace_separator=" ")
            parser.StartElementHandler = start
            parser.StartDoctypeDeclHandler = _Model("_rels/.rels").refuse
            try:
                parser.Parse(self.bytes_of("_rels/.rels"), True)
            except expat.ExpatError as why:
                raise Error(f"_rels/.rels: its XML is wrong: {why}") from None
        if found:
            return found[0]
        models = [name for name in self.names if name.endswith(".model")]
        return models[0] if models else "3D/3dmodel.model"

    def build(self, path: str, number: str, place: Doubles, depth: int) -> None:
        """An object in a place, with what it is made of."""
        self.instances += 1
        if depth > DEPTH or self.instances > INSTANCES:
            raise Error(f"there are more than {INSTANCES} instances, {DEPTH} deep, "
                        "or they go in circles")
        model = self.model(path)
        it = model.objects.get((path, number))
        if it is None:
            raise Error(f"there is no object {number[:20]} in {path[:60]}")
        if it.faces:
            self._add(model, it, place)
        for where, other, move in it.components:
            with np.errstate(all="ignore"):
                self.build(where, other, place @ move, depth + 1)

    def _add(self, model: _Model, it: _Object, place: Doubles) -> None:
        if it.arrays is None:
            it.arrays = _arrays(model, it)
        vertices, faces, colors = it.arrays
        self.triangles += len(faces)
        if self.triangles > TRIANGLES:
            raise Error(f"there are more than {TRIANGLES} triangles")
        with np.errstate(all="ignore"):
            placed = vertices @ place[:3, :3].T + place[:3, 3]
            if np.linalg.det(place[:3, :3]) < 0:
                faces = faces[:, ::-1]
        self.vertices.append(placed)
        self.faces.append(faces + self.count)
        self.colors.append(colors)
        self.count += len(vertices)


def _arrays(model: _Model, it: _Object) -> tuple[Array, Array, Array | None]:
    """Vertices, faces, and the colour of each face where the file says one."""
    vertices = np.array(it.vertices, np.float64).reshape(-1, 3)
    try:
        faces = np.array(it.faces, np.int64).reshape(-1, 3)
    except OverflowError:
        raise Error("a triangle has a vertex that is not there") from None
    if not 0 <= faces.min() <= faces.max() < len(vertices):
        raise Error(f"a triangle has a vertex that is not there: there are {len(vertices)}")
    known: dict[tuple[str, str], tuple[float, float, float] | None] = {}
    for mark in it.marks:
        if mark not in known:
            group = model.colors.get((model.path, mark[0]), [])
            place = int(mark[1]) if mark[1].isdecimal() and len(mark[1]) < 9 else -1
            known[mark] = group[place] if 0 <= place < len(group) else None
    if all(color is None for color in known.values()):
        return vertices, faces, None
    clay = _color("#BFB2A4")
    return vertices, faces, np.array([known[mark] or clay for mark in it.marks])


def read(data: bytes) -> tuple[Any, dict[str, Any]]:
    """Vertices and faces, and options of Mesh."""
    archive = _Archive(data)
    root = archive.model(archive.root())
    items = root.items or [(path, number, np.eye(4)) for path, number in root.objects]
    for path, number, place in items:
        archive.build(path, number, place, 0)
    if not archive.triangles:
        raise Error("there are no triangles")
    vertices, faces = np.concatenate(archive.vertices), np.concatenate(archive.faces)
    found: dict[str, Any] = {"up": "z"}
    if any(color is not None for color in archive.colors):
        clay = np.array(_color("#BFB2A4"))
        found["color"] = np.concatenate([
            np.tile(clay, (len(f), 1)) if c is None else c
            for f, c in zip(archive.faces, archive.colors)])
        if len(vertices) == len(faces):    # else the colours would be taken for those of vertices
            vertices = np.concatenate([vertices, vertices[:1]])
    return (vertices, faces), found

