"""fuzz.py [count [seed]] - damages models of all kinds at random, and reads them: each is read or
refused with shade_h.Error, whatever it holds.  The same seed damages in the same way."""
import collections
import io
import struct
import sys
import warnings
import zipfile

import numpy as np
from shapes import box
from test_formats import Glb

import shade_h as shade

LINES = b"\n"
WORDS = [b"-1", b"0", b"1e999", b"nan", b"4294967295", b"2147483648", b"1e-45", b"", b"/", b"\0",
         b"999999999999999999999", b"0.5", b"true", b"null", b"[]", b"{}", b'"', b"<", b">", b"&"]


def seeds():
    """A small model of each kind by the end of its name."""
    vertices, faces = box()
    faces = np.asarray(faces).tolist()
    rows = ["{!r} {!r} {!r}".format(*map(float, p)) for p in vertices]
    polygons = [" ".join(map(str, f)) for f in faces]
    obj = "".join(f"v {r} 1 0.5 0\n" for r in rows) + "vt 0 1\nvn 0 0 1\nusemtl a\n" + "".join(
        "f " + " ".join(f"{i + 1}/1/1" for i in f) + "\n" for f in faces)
    text = "solid a\n" + "".join(
        "facet normal 0 0 1\nouter loop\n" + "".join(f"vertex {rows[i]}\n" for i in f[:3]) +
        "endloop\nendfacet\n" for f in faces) + "endsolid a\n"
    binary = bytes(80) + struct.pack("<I", 6) + b"".join(
        struct.pack("<12fH", 0, 0, 1, *vertices[f[:3]].reshape(-1), 0) for f in faces)
    head = "ply\nformat {} 1.0\ncomment TextureFile a.png\nelement vertex 8\nproperty float x\n" \
        "property float y\nproperty float z\nproperty uchar red\nproperty uchar green\n" \
        "property uchar blue\n{}end_header\n"
    face = "element face 6\nproperty list uchar int vertex_indices\n"
    ascii_ply = head.format("ascii", face) + "".join(f"{r} 9 99 255\n" for r in rows)
    packed = b"".join(np.float32(p).tobytes() + b"abc" for p in vertices)
    little = head.format("binary_little_endian", face).encode() + packed + b"".join(
        b"\4" + np.int32(f).tobytes() for f in faces)
    off = "COFF\n8 6 0\n" + "".join(f"{r} 9 99 255 255\n" for r in rows)
    glb = Glb()
    glb.node(mesh=glb.quad({"pbrMetallicRoughness": {"baseColorFactor": [1, 0, 0, 0.5]},
                            "alphaMode": "BLEND"}, uv=[[0, 0], [1, 0], [1, 1], [0, 1]]),
             scale=[1, 2, 3], rotation=[0, 0, 0, 1])
    return [("a.obj", obj.encode()), ("a.stl", text.encode()), ("b.stl", binary),
            ("a.ply", (ascii_ply + "".join(f"4 {p}\n" for p in polygons)).encode()),
            ("b.ply", little), ("c.ply", head.format("binary_little_endian", "").encode() + packed),
            ("d.ply", (head.format("ascii", "") + ascii_ply.split("end_header\n")[1]).encode()),
            ("a.off", (off + "".join(f"4 {p} 1 0 0\n" for p in polygons)).encode()),
            ("a.glb", glb.bytes()), ("a.3mf", package(MODEL))]


MODEL = b"""<?xml version="1.0"?>
<model unit="millimeter" xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02"
 xmlns:m="http://schemas.microsoft.com/3dmanufacturing/material/2015/02"><resources>
<basematerials id="5"><base name="a" displaycolor="#FF8000"/></basematerials>
<m:colorgroup id="6"><m:color color="#00FF00"/><m:color color="#0000FF80"/></m:colorgroup>
<object id="1" type="model" pid="5" pindex="0"><mesh><vertices><vertex x="0" y="0" z="0"/>
<vertex x="1" y="0" z="0"/><vertex x="0" y="1" z="0"/><vertex x="0" y="0" z="1"/></vertices>
<triangles><triangle v1="0" v2="2" v3="1"/><triangle v1="0" v2="1" v3="3" pid="6" p1="0" p2="1"
 p3="0"/></triangles></mesh></object><object id="2" type="model"><components>
<component objectid="1" transform="1 0 0 0 1 0 0 0 1 3 0 0"/><component objectid="1"/></components>
</object></resources><build><item objectid="2" transform="2 0 0 0 2 0 0 0 2 0 0 0"/>
<item objectid="1"/></build></model>"""


def package(model):
    """A 3MF file."""
    made = io.BytesIO()
    with zipfile.ZipFile(made, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, data in (("[Content_Types].xml", b"<Types/>"), ("3D/3dmodel.model", model)):
            archive.writestr(zipfile.ZipInfo(name), data)
    return made.getvalue()


def damaged(data, rng):
    """The bytes with one to four wounds."""
    out = bytearray(data)
    for _ in range(rng.integers(1, 5)):
        if not out:
            break
        kind, at = rng.integers(0, 8), int(rng.integers(0, len(out)))
        end = min(len(out), at + int(rng.integers(1, 24)))
        if kind == 0:
            out[at] = int(rng.integers(0, 256))
        elif kind == 1:
            out[at] ^= 1 << int(rng.integers(0, 8))
        elif kind == 2:
            del out[at:end]
        elif kind == 3:
            out[at:at] = out[at:end] * int(rng.integers(1, 4))
        elif kind == 4:
            del out[at:]
        elif kind == 5:
            out[at:at + 4] = struct.pack("<I", int(rng.choice([0, 1, 2**31, 2**32 - 1, 65536, 7])))
        else:    # a word of a text by another
            while at and out[at - 1:at].isalnum():
                at -= 1
            end = at
            while end < len(out) and (out[end:end + 1].isalnum() or out[end] in b".-+"):
                end += 1
            out[at:end] = WORDS[rng.integers(0, len(WORDS))]
    return bytes(out)


def one(name, data, rng):
    """Reads a damaged model, and returns what came of it."""
    # the text within a 3MF, or the file as it is
    wounded = package(damaged(MODEL, rng)) if name == "a.3mf" and rng.integers(0, 4) else \
        damaged(data, rng)
    file = io.BytesIO(wounded)
    try:
        (vertices, faces), found = shade.files._any(file.read(), name, None)
        if faces is not None and rng.integers(0, 8) == 0:
            shade.Mesh(vertices, faces, **found)
        return "read"
    except shade.Error:
        return "refused"
    except Exception as why:    # what a fuzzer looks for
        print(f"{name}: {type(why).__name__}: {why}: {wounded.hex()}", flush=True)
        return f"{name} {type(why).__name__}"


def main(count, seed):
    """Returns how often which outcome was seen."""
    rng, models, seen = np.random.default_rng(seed), seeds(), collections.Counter()
    warnings.simplefilter("ignore")
    for i in range(count):
        name, data = models[i % len(models)]
        outcome = one(name, data, rng)
        seen[f"{name} {outcome}" if outcome in ("read", "refused") else outcome] += 1
        if i % 100_000 == 99_999:
            print(i + 1, dict(seen), file=sys.stderr, flush=True)
    return seen


if __name__ == "__main__":
    print(dict(main(*map(int, (sys.argv[1:] + ["100000", "1"][len(sys.argv) - 1:])))))
