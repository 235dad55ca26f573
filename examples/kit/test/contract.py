"""contract.py FOLDER THUMBNAIL [NODE] - reads the names that contract.sh lists, and demands of the programs, the
package for Python and, where NODE is the folder of the package, of Node.js what they say: a file with
one name more is drawn without a word of it, or drawn with a warning that names it, or refused by its
name.  A name in no list is told.  Prints one line for each that is not so, then the counts."""
import json
import re
import subprocess
import sys
import warnings
import zipfile
from pathlib import Path

import shade_h

FOLDER, THUMBNAIL = Path(sys.argv[1]), sys.argv[2]
NODE = sys.argv[3] if len(sys.argv) > 3 else None
CORE = "http://schemas.microsoft.com/3dmanufacturing/core/2015/02"
SPACES = {CORE: "", "http://schemas.microsoft.com/3dmanufacturing/material/2015/02": "m",
          "http://schemas.microsoft.com/3dmanufacturing/production/2015/06": "p"}
MATERIALS = ("texture2d", "colorgroup", "compositematerials", "multiproperties", "pb", "translucent")
OBJ = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nusemtl a\nf 1 3 2\nf 1 2 4\nf 2 3 4\n"
CORNERS = ("0 0 0", "1 0 0", "0 1 0", "0 0 1")
FACES = ((0, 2, 1), (0, 1, 3), (1, 2, 3))


def obj(kind, name):
    return "a.obj", OBJ if name in OBJ.split() else OBJ + f"{name} 1 2 3\n"


def mtl(kind, name):
    own = {"newmtl": "", "map_kd": "", "map_ke": "", "map_d": "", "map_bump": "", "bump": "", "norm": "",
           "map_kn": "", "illum": "illum 1\n"}.get(name, f"{name} 0.5\n")
    (FOLDER / "a.mtl").write_text("newmtl a\nKd 1 0 0\n" + own)
    return "a.obj", "mtllib a.mtl\n" + OBJ


def stl(kind, name):
    facets = "".join("facet normal 0 0 0\nouter loop\n" + "".join(f"vertex {CORNERS[k]}\n" for k in face)
                     + "endloop\nendfacet\n" for face in FACES)
    if name == "color":
        facets = facets.replace("endfacet\n", "endfacet color 1\n")
    listed = name in ("solid", "endsolid") or name in facets
    return "a.stl", f"solid a\n{facets}{'' if listed else name + chr(10)}endsolid a\n"


def off(kind, name):
    more = {"4OFF": " 1", "COFF": " 1 0 0 1", "NOFF": " 0 0 1", "CNOFF": " 1 0 0 1 0 0 1",
            "NCOFF": " 0 0 1 1 0 0 1", "STOFF": " 0 0"}
    points = "".join(c + more.get(name, "") + "\n" for c in CORNERS)
    return "a.off", f"{name}\n4 3 0\n{points}" + "".join("3 %d %d %d\n" % f for f in FACES)


def ply(kind, name):
    columns = {"vertex": ["x", "y", "z"], "face": []}
    if kind != "element" and name not in ("x", "y", "z", "vertex_indices", "vertex_index", "texcoord"):
        columns[kind].append(name)
    others = kind == "element" and name not in ("vertex", "face", "tristrips")
    head = "ply\nformat ascii 1.0\nelement vertex 4\n" + "".join(f"property float {c}\n" for c in columns["vertex"])
    head += "element face 3\nproperty list uchar int vertex_indices\n"
    head += "".join(f"property float {c}\n" for c in columns["face"])
    head += (f"element {name} 1\nproperty int q\n" if others else "") + "end_header\n"
    rows = [c + " 0.5" * (len(columns["vertex"]) - 3) for c in CORNERS]
    rows += ["3 %d %d %d" % f + " 1" * len(columns["face"]) for f in FACES] + ["7"] * others
    return "a.ply", head + "\n".join(rows) + "\n"


def gltf(kind, name, required=False):
    made = {"asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
            "buffers": [{"byteLength": 36, "uri": "data:;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}],
            "bufferViews": [{"buffer": 0, "byteLength": 36}],
            "accessors": [{"bufferView": 0, "count": 3, "componentType": 5126, "type": "VEC3"}]}
    if kind == "extension":
        made["extensionsRequired" if required else "extensionsUsed"] = [name]
        if "_texture_" in name and "transform" not in name:
            made["images"], made["textures"] = [], [{"extensions": {name: {"source": 0}}}]
            made["materials"] = [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}]
            made["meshes"][0]["primitives"][0]["material"] = 0
        if "draco" in name:
            made["meshes"][0]["primitives"][0]["extensions"] = {name: {}}
            del made["accessors"][0]["bufferView"]
    elif name not in ("POSITION", "NORMAL", "TEXCOORD", "COLOR", "JOINTS", "WEIGHTS"):
        made["meshes"][0]["primitives"][0]["attributes"][name] = 0
    return "a.gltf", json.dumps(made)


def threemf(kind, name, required=False):
    mark = ' %s="4"' % name if kind == "attribute" and len(name) > 3 else ""
    mesh = "<mesh><vertices>" + "".join('<vertex x="%s" y="%s" z="%s"/>' % tuple(c.split()) for c in CORNERS) + \
        "</vertices><triangles>" + "".join(f'<triangle v1="{a}" v2="{b}" v3="{c}"{mark}/>' for a, b, c in FACES) + \
        "</triangles></mesh>"
    prefix, inside, needs = "", "", ""
    if kind == "extension":
        prefix = SPACES.get(name, "q") + ":"
        inside = "" if name in SPACES else "<q:thing/>"
        needs = f' requiredextensions="{prefix[:-1]}"' if required and name != CORE else ""
        needs += f' xmlns:q="{name}"' if prefix == "q:" else ""
    elif kind == "element" and (name.startswith(MATERIALS) or name in ("metadata", "zebra")):
        inside = f'<{"m:" if name.startswith(MATERIALS) else ""}{name} id="99"/>'
    inside += f'<object id="2" type="{name}">{mesh}</object>' if kind == "type" else ""
    text = f'<model xmlns="{CORE}"' + "".join(f' xmlns:{p}="{u}"' for u, p in SPACES.items() if p) + needs + \
        f'><resources>{inside}<object id="1">{mesh}</object></resources><build><item objectid="1"/></build></model>'
    with zipfile.ZipFile(FOLDER / "a.3mf", "w", zipfile.ZIP_DEFLATED) as file:
        file.writestr("3D/3dmodel.model", text)
    return "a.3mf", None


def by_program(path):
    done = subprocess.run([THUMBNAIL, path, FOLDER / "a.ppm", "--size", "16x16", "--samples", "1"],
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    return done.returncode == 0, done.stdout


def by_python(path):
    with warnings.catch_warnings(record=True) as said:
        warnings.simplefilter("always")
        try:
            shade_h.load(path)
        except shade_h.Error as why:
            return False, str(why)
    return True, "\n".join(str(w.message) for w in said)


class Node:
    """One process that reads a path a line and answers with a line of JSON."""
    PROGRAM = """
import { readModel } from "shade-h";
import { existsSync, readFileSync } from "node:fs";
import { dirname, extname, join } from "node:path";
import { createInterface } from "node:readline";
let said = [];
console.warn = (line) => said.push(line);
for await (const path of createInterface({ input: process.stdin })) {
    said = [];
    let read = true;
    const there = (name) => join(dirname(path), name);
    const beside = (name) => (existsSync(there(name)) ? readFileSync(there(name)) : null);
    try { await readModel(readFileSync(path), { format: extname(path).slice(1), beside }); }
    catch (why) { read = false; said.push(why.message); }
    console.log(JSON.stringify([read, said.join("\\n")]));
}
"""

    def __init__(self, folder):
        program = Path(folder) / "contract.mjs"
        program.write_text(self.PROGRAM)
        self.process = subprocess.Popen(["node", program], cwd=folder, stdin=subprocess.PIPE,
                                        stdout=subprocess.PIPE, text=True)

    def __call__(self, path):
        self.process.stdin.write(f"{path}\n")
        self.process.stdin.flush()
        return tuple(json.loads(self.process.stdout.readline()))


MAKERS = {"obj": obj, "mtl": mtl, "stl": stl, "off": off, "ply": ply, "gltf": gltf, "3mf": threemf}
REFUSES = ("stl", "off")    # what is in no list is refused
readers = {"program": by_program, "Python": by_python}
node = Node(NODE) if NODE else None
passed = failed = 0


def demand(where, reader, got, what, name):
    """One of the three."""
    global passed, failed
    read, words = got
    shown = {"STOFF": "ST", "OFF BINARY": "binary OFF", "ps": "Ps"}.get(name, name)
    named = shown in words and ("not read" in words or "found" in words)
    right = {"drawn": read and "not read" not in words, "silent": read and "not read" not in words,
             "told": read and named, "refused": not read and named}[what]
    passed, failed = passed + right, failed + (not right)
    if not right:
        print(f"{where}: {reader}: {name} is {what}, got {'read' if read else 'refused'}: {words.strip()[:200]}")


lines = [line.rstrip("\n").split("\t") for line in sys.stdin]
lists = {(form, kind) for form, kind, _, _ in lines}
lines += [[form, kind, "zebra" if kind != "extension" or form == "gltf" else "http://zebra/1",
           "refused" if form in REFUSES else "told"] for form, kind in sorted(lists)]
for form, kind, name, what in lines:
    for required in (False, True) if kind == "extension" else (False,):
        if required and what == "told":
            what = "refused"
        made, text = MAKERS[form](kind, name, required) if kind == "extension" else MAKERS[form](kind, name)
        if text is not None:
            (FOLDER / made).write_text(text)
        told = []
        for reader, read in list(readers.items()) + ([("Node", node)] if node else []):
            got = read(str(FOLDER / made))
            demand(f"{form} {kind}{' required' if required else ''}", reader, got, what, name)
            told += re.findall(r": ((?:its?|binary) .* not read)", got[1])[-1:]
        words = set(told)
        if len(words) > 1:
            failed += 1
            print(f"{form} {kind}: {name}: other words: {words}")
if node:
    node.process.communicate()
print(f"{passed} passed, {failed} failed")
sys.exit(failed > 0)
