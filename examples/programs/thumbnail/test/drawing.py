"""drawing.py PROGRAM FOLDER - draws the parts of parts.py and holds sheets, maps and JSON to what is
known of these parts.  It reads 16-bit pictures by Pillow and takes points back to the file's units
by the matrices of the JSON."""
import base64
import json
import math
import os
import struct
import subprocess
import sys

import numpy as np
from PIL import Image

import parts

PROGRAM, T = sys.argv[1], sys.argv[2]
ALL = "front,back,right,left,top,bottom,iso"
passed = failed = 0


def check(what, good, *tell):
    global passed, failed
    passed, failed = passed + bool(good), failed + (not good)
    if not good:
        print("FAIL  drawing:", what, *tell)


def run(*words):
    return subprocess.run([PROGRAM, *map(str, words)], capture_output=True, stdin=subprocess.DEVNULL,
                          text=True, timeout=300)


class Drawing:
    """A sheet with its maps and its description."""
    number = 0

    def __init__(self, part, *options):
        Drawing.number += 1
        base = f"{T}/{Drawing.number}"
        made = run(f"{T}/{part}", base + ".png", "--depth", base + ".d.png", "--id-map",
                   base + ".i.png", "--json", base + ".json", *options)
        check(f"{part} {options} is drawn", made.returncode == 0 and not made.stderr, made.stderr)
        self.text = json.load(open(base + ".json"))
        self.sheet = np.asarray(Image.open(base + ".png").convert("RGB")).astype(int)
        self.depth = np.asarray(Image.open(base + ".d.png")).astype(int)
        self.ids = np.asarray(Image.open(base + ".i.png")).astype(int)
        self.views = {v["name"]: v for v in self.text["views"]}
        shape = (self.text["height"], self.text["width"])
        check("all pictures have the size told", self.sheet.shape[:2] == shape and
              self.depth.shape == shape and self.ids.shape == shape)
        check("depth and parts cover the same pixels",
              ((self.depth == self.text["nothing"]) == (self.ids == 0)).all())

    def pixel(self, view, point):
        m = np.array(self.views[view]["pixel_from_file"]).reshape(4, 4)
        q = m @ np.append(point, 1.0)
        return q[:3] / q[3]

    def points(self, view):
        """Points of the file, and parts, of all pixels of a view that show something"""
        v = self.views[view]
        at = np.zeros(self.ids.shape, bool)
        at[v["y"]:v["y"] + v["height"], v["x"]:v["x"] + v["width"]] = True
        row, column = np.nonzero(at & (self.ids > 0))
        q = np.stack([column + 0.5, row + 0.5, self.depth[row, column], np.ones(len(row))])
        q = np.array(v["file_from_pixel"]).reshape(4, 4) @ q
        return (q[:3] / q[3]).T, self.ids[row, column]

    def outline(self, view):
        """First and last columns and rows of a view that show something"""
        v = self.views[view]
        part = self.ids[v["y"]:v["y"] + v["height"], v["x"]:v["x"] + v["width"]] > 0
        x, y = np.nonzero(part.any(0))[0], np.nonzero(part.any(1))[0]
        return v["x"] + x[0], v["x"] + x[-1] + 1, v["y"] + y[0], v["y"] + y[-1] + 1


def off_box(points, low, high):
    """Distance of points from the surface of a box"""
    outside = np.maximum(np.maximum(low - points, points - high), 0)
    inside = np.minimum(points - low, high - points).min(1)
    return np.where((outside > 0).any(1), np.sqrt((outside ** 2).sum(1)), np.abs(inside))


def off_plate(p):
    """Distance from the surface of plate.stl: 80 x 50 x 20, a hole of radius 12.5 of 64 chords"""
    radius = np.hypot(p[:, 0], p[:, 1])
    on_hole = np.where(radius < 12.5, np.maximum(0, 12.5 * np.cos(np.pi / 64) - radius), radius - 12.5)
    on_box = off_box(p, np.array([-40, -25, 0]), np.array([40, 25, 20]))
    return np.minimum(on_hole, np.where(radius < 12.4, 99, on_box))


def directions():
    """The box of box.stl: the file's z is up, the front is seen from -y."""
    low, high = np.array([10, 20, 30.0]), np.array([40, 40, 40.0])
    face = {"front": (1, 20), "back": (1, 40), "right": (0, 40), "left": (0, 10), "top": (2, 40),
            "bottom": (2, 30)}
    for options in ([], ["--ortho"], ["--angle", "first"]):
        d = Drawing("box.stl", "--views", ALL, "--edges", *options)
        check("the box of the file", d.text["box"] == {"low": [10, 20, 30], "high": [40, 40, 40],
                                                       "size": [30, 20, 10]}, d.text["box"])
        for view in d.views:
            points, _ = d.points(view)
            worst = off_box(points, low, high).max()
            check(f"{view}: pixels are points of the box", worst < 0.01, worst)
            corners = np.array([d.pixel(view, np.where([k & 1, k & 2, k & 4], high, low))
                                for k in range(8)])
            want = [corners[:, 0].min(), corners[:, 0].max(), corners[:, 1].min(),
                    corners[:, 1].max()]
            check(f"{view}: corners lie at its outline",
                  np.abs(np.array(d.outline(view)) - want).max() <= 1, want, d.outline(view))
            if view in face:
                axis, value = face[view]
                check(f"{view} shows its face", np.abs(points[:, axis] - value).max() < 0.01)
                scale = d.views[view]["pixels_per_unit"]
                check("flat views share a scale", scale == d.views["front"]["pixels_per_unit"])
        check("in iso three faces are seen", all(
            (np.abs(d.points("iso")[0][:, axis] - value) < 0.01).sum() > 1000
            for axis, value in (face["front"], face["right"], face["top"])))
        check("iso by a lens or not", d.views["iso"]["projection"] ==
              ("parallel" if options == ["--ortho"] else "perspective"))
        aligned(d, options == ["--angle", "first"])


def aligned(d, first_angle):
    front, right, left, top = (d.outline(v) for v in ("front", "right", "left", "top"))
    check("front, right and left stand in one row", front[2:] == right[2:] == left[2:])
    check("front and top stand in one column", front[:2] == top[:2])
    check("top is above, in first angle below", (top[3] < front[2]) != first_angle)
    check("right is right, in first angle left", (right[0] > front[1]) != first_angle)
    boxes = [(v["x"], v["y"], v["x"] + v["width"], v["y"] + v["height"]) for v in d.views.values()]
    check("no two views overlap", not any(
        a < b and a[0] < b[2] and b[0] < a[2] and a[1] < b[3] and b[1] < a[3]
        for a in boxes for b in boxes))


def up_axes():
    for up in ("x", "y", "z", "-x", "-y", "-z"):
        d = Drawing("box.stl", "--views", "front,right,top,iso", "--up", up, "--size", "640x480")
        axis, sign = "xyz".index(up[-1]), -1 if up[0] == "-" else 1
        want = np.zeros(3)
        want[axis] = sign
        check(f"up {up} is up", np.allclose(d.views["front"]["up"], want))
        check(f"up {up} faces who sees the top", np.allclose(d.views["top"]["toward_eye"], want))
        for view in d.views:
            v = d.views[view]
            check("directions are right-handed", np.allclose(
                np.cross(v["right"], v["up"]), v["toward_eye"], atol=1e-6))
            worst = off_box(d.points(view)[0], np.array([10, 20, 30]), np.array([40, 40, 40])).max()
            check(f"up {up}, {view}: points of the box", worst < 0.02, worst)


def hole():
    d = Drawing("plate.stl", "--views", "front,right,top,iso")
    for view in d.views:
        worst = off_plate(d.points(view)[0]).max()
        check(f"plate, {view}: pixels are points of the plate", worst < 0.02, worst)
    x, y, _ = d.pixel("top", (0, 0, 20))
    check("one sees through the hole", d.ids[int(y), int(x)] == 0)


def ink(d, view, a, b):
    """Which pixels along a line between two points are dark on one of three pixels across"""
    a, b = d.pixel(view, a)[:2], d.pixel(view, b)[:2]
    n = int(np.abs(b - a).max())
    way = (b - a) / n
    across = np.array([-way[1], way[0]]) / np.hypot(*way)
    dark = np.zeros(n - 8, bool)
    for shift in (-1, 0, 1):
        p = a + np.outer(np.arange(4, n - 4) + 0.5, way) + shift * across
        dark |= d.sheet[p[:, 1].astype(int), p[:, 0].astype(int)].sum(1) < 240
    return dark


def runs(dark):
    edge = np.flatnonzero(np.diff(np.concatenate(([0], dark.astype(int), [0]))))
    return edge[1::2] - edge[::2], edge[2::2] - edge[1:-1:2]


def dashes():
    """inner.stl: a box of 100 x 80 x 60 with a box from (30, 20, 10) to (70, 60, 40) inside"""
    edges = {"front": [((30, 0, 10), (70, 0, 10)), ((30, 0, 40), (70, 0, 40)),
                       ((30, 0, 10), (30, 0, 40)), ((70, 0, 10), (70, 0, 40))],
             "right": [((0, 20, 10), (0, 60, 10)), ((0, 60, 10), (0, 60, 40))],
             "top": [((30, 20, 0), (70, 20, 0)), ((70, 20, 0), (70, 60, 0))]}
    outer = {"front": ((0, 0, 60), (100, 0, 60)), "right": ((0, 0, 0), (0, 0, 60)),
             "top": ((0, 80, 0), (100, 80, 0))}
    words = "--views", "front,right,top,iso"
    hidden, edged, plain = (Drawing("inner.stl", *words, *more)
                            for more in (["--hidden"], ["--edges"], []))
    for view in edges:
        for a, b in edges[view]:
            dark, light = runs(ink(hidden, view, a, b))
            check(f"{view}: the hidden edge {a} {b} has dashes", len(dark) > 4 and len(light) > 3, dark, light)
            inner = dark[1:-1] if len(dark) > 2 else np.zeros(1)
            check("its dashes are alike", inner.max() - inner.min() <= 2, dark)
            check("its gaps are alike, a third to two thirds of a dash",
                  len(light) and light.max() - light.min() <= 2 and
                  0.25 < light.mean() / inner.mean() < 0.75, dark, light)
            check("without --hidden it is not drawn", not ink(edged, view, a, b).any())
        check(f"{view}: an outline is whole", ink(hidden, view, *outer[view]).all() and
              ink(edged, view, *outer[view]).all())
        check("without --edges it is not drawn", not ink(plain, view, *outer[view]).any())
    check("iso has no hidden lines", not ink(hidden, "iso", (30, 20, 40), (70, 20, 40)).any())
    check("the front of inner.stl is two parts", len(hidden.text["parts"]) == 2)


def one_behind_another():
    """Edges of two boxes inside of a third lie on one line of the front, the nearer 2 units deep."""
    parts.write_stl(f"{T}/behind.stl", parts.box((0, 0, 0), (100, 80, 60)) +
                    parts.box((30, 2, 10), (70, 30, 40)) + parts.box((17, 50, 10), (63, 70, 40)))
    d = Drawing("behind.stl", "--views", "front,right,top,iso", "--hidden")
    for z in (10, 40):
        dark, light = runs(ink(d, "front", (17, 0, z), (70, 0, z)))
        check("dashes do not fill each other's gaps", len(dark) > 8 and dark.max() < 28, dark)
        check("nor make them wider", len(light) and light.max() < 12, light)


def number_beside(d, view, across):
    """The pixels about the number of a dimension below a view, or left of it"""
    x0, x1, y0, y1 = d.outline(view)
    if across:
        x, y = (x0 + x1) // 2, y1 + 42
    else:
        x, y = x0 - 40, (y0 + y1) // 2
    return d.sheet[y - 22:y + 22, x - 24:x + 24].sum(2)


def unlike(a, b):
    """How far two pictures of numbers differ where they lie on each other best"""
    inner = a[6:-6, 6:-6]
    return min(np.abs(inner - b[j:j + inner.shape[0], i:i + inner.shape[1]]).sum()
               for j in range(12) for i in range(12))


def numbers():
    """Cubes show what the numbers 10, 20 and 30 look like: a box has them where they belong."""
    words = "--views", "front,right,top", "--dimensions"
    looks = {}
    for side in (10, 20, 30):
        parts.write_stl(f"{T}/cube{side}.stl", parts.box((0, 0, 0), (side, side, side)))
        d = Drawing(f"cube{side}.stl", *words)
        looks[side] = number_beside(d, "front", True), number_beside(d, "front", False)
    d = Drawing("box.stl", *words)
    for view, across, want in (("front", True, 30), ("right", True, 20), ("front", False, 10)):
        got = number_beside(d, view, across)
        far = {side: unlike(look[0 if across else 1], got) for side, look in looks.items()}
        check(f"the {view} says {want}", min(far, key=far.get) == want, far)


def assembly():
    d = Drawing("assembly.obj", "--views", "front,right,top,iso", "--ids", "--edges")
    parts_of = d.text["parts"]
    check("names are the file's", [p["name"] for p in parts_of] == ["base_plate", "hub", "pin"])
    check("parts are objects", d.text["parts_are"] == "objects of the file")
    want = [([-50, 0, -30], [50, 10, 30]), ([-20, 10, -20], [20, 40, 20]), ([-9, 10, -9], [9, 58, 9])]
    for p, (low, high) in zip(parts_of, want):
        check(f"the box of {p['name']}", np.allclose([p["box"]["low"], p["box"]["high"]], [low, high],
                                                     atol=1e-5), p["box"])
    for point, part in (((0, 58, 0), 3), ((18, 40, 18), 2), ((45, 10, 25), 1)):
        x, y, z = d.pixel("top", point)
        check(f"part {part} lies at {point}", d.ids[int(y), int(x)] == part)
        check("its depth", abs(d.depth[int(y), int(x)] - z) < 2, z, d.depth[int(y), int(x)])
        color = parts_of[part - 1]["color"]
        color = np.array([int(color[k:k + 2], 16) for k in (1, 3, 5)])
        seen = d.sheet[int(y), int(x)]
        check("it has about its color", np.abs(seen - color).max() < 24, seen, color)
        legend = np.abs(d.sheet[:, 1270:1300] - color).max(2) <= 1
        check("its color stands in the legend", legend.sum() > 100, legend.sum())
    for view in d.views:
        points, ids = d.points(view)
        for p, (low, high) in zip(parts_of, want):
            mine = points[ids == p["id"]]
            check("pixels are counted", p["pixels"][view] == len(mine), p["pixels"], len(mine))
            check("points of a part lie in its box", (mine > np.array(low) - 0.02).all() and
                  (mine < np.array(high) + 0.02).all())
    plain = Drawing("assembly.obj", "--views", "front,right,top,iso")
    check("without --ids all parts are of one color", len({p["color"] for p in plain.text["parts"]}) == 1)


def what_is_a_part():
    def names(part):
        d = Drawing(part, "--views", "iso", "--size", "300x300")
        return [p["name"] for p in d.text["parts"]], d.text["parts_are"]
    cube = parts.triangles_as_object("", parts.box((0, 0, 0), (1, 1, 1)))[1:]
    lines = "".join("v %g %g %g\n" % tuple(p) for p in cube[0])
    face = "".join("f %d %d %d\n" % tuple(i + 1 for i in f) for f in cube[1])
    for k, (heads, want) in enumerate((
            (("g one\n", "g two_2\n"), ["one", "two_2"]), (("o a\ng x\n", "g y\no b\n"), ["a", "b"]),
            (("", "o second\n"), ["part 1", "second"]), (("o a\n", "o a\n"), ["part 1"]),
            (("o \"\\\xe4\n", "o \u03b1^2\n"), ["\"\\\xe4", "\u03b1^2"]))):
        halves = face[:len(face) // 2].rfind("\n") + 1
        with open(f"{T}/o{k}.obj", "w", encoding="utf-8") as file:
            file.write(lines + heads[0] + face[:halves] + heads[1] + face[halves:])
        check(f"objects {heads}", names(f"o{k}.obj")[0] == want, names(f"o{k}.obj"))
    check("pieces of an STL", names("pair.stl") == (["part 1", "part 2"], "connected triangles"))
    parts.write_stl(f"{T}/sizes.stl", parts.box((0, 0, 0), (1, 1, 1)) + parts.plate(
        9, 9, 0, 3, 2, 20))
    d = Drawing("sizes.stl", "--views", "top")
    check("the larger piece is the first", d.text["parts"][0]["triangles"] > 12)
    many = [t for i in range(70) for t in parts.box((3 * i, 0, 0), (3 * i + 1, 1, 1))]
    parts.write_stl(f"{T}/many.stl", many)
    d = Drawing("many.stl", "--views", "top,iso", "--ids")
    check("seventy pieces", [p["id"] for p in d.text["parts"]] == list(range(1, 71)))
    check("each is seen", set(d.ids.ravel()) == set(range(71)))


def nodes():
    """Two nodes of a glTF share a mesh: two parts."""
    triangle = struct.pack("<9f3H", 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1, 2)
    gltf = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1]}],
            "nodes": [{"name": "near", "mesh": 0},
                      {"name": "far", "mesh": 0, "translation": [3, 0, 0]}],
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
            "buffers": [{"byteLength": len(triangle), "uri": "data:application/octet-stream;base64,"
                         + base64.b64encode(triangle).decode()}],
            "bufferViews": [{"buffer": 0, "byteLength": 36},
                            {"buffer": 0, "byteOffset": 36, "byteLength": 6}],
            "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
                           "min": [0, 0, 0], "max": [1, 1, 0]},
                          {"bufferView": 1, "componentType": 5123, "count": 3, "type": "SCALAR"}]}
    json.dump(gltf, open(f"{T}/nodes.gltf", "w"))
    d = Drawing("nodes.gltf", "--views", "front,iso", "--ids")
    check("parts are nodes", [p["name"] for p in d.text["parts"]] == ["near", "far"])
    check("a node stands where its matrix puts it", d.text["parts"][1]["box"]["low"][0] == 3)


def difference(a, b):
    """Rows and columns of what differs"""
    return np.nonzero(np.abs(a.sheet - b.sheet).max(2))


def dimensions():
    """The same box twice as large: the sheets differ in numbers alone."""
    parts.write_stl(f"{T}/twice.stl", parts.box((20, 40, 60), (80, 80, 80)))
    words = "--views", "front,right,top,iso", "--edges"
    one, two = (Drawing(p, *words, "--dimensions") for p in ("box.stl", "twice.stl"))
    row, column = difference(one, two)
    inside = np.zeros(len(row), bool)
    for v in one.views.values():
        inside |= (row >= v["y"]) & (row < v["y"] + v["height"]) & (column >= v["x"]) & (
            column < v["x"] + v["width"])
    check("numbers differ", len(row) > 100)
    check("views do not", not inside.any())
    front, right = one.outline("front"), one.outline("right")
    above = row < one.text["height"] - 80
    for what, (x0, x1, y0, y1) in {
            "width": (front[0], front[1], front[3] + 5, front[3] + 90),
            "depth": (right[0], right[1], right[3] + 5, right[3] + 90),
            "height": (front[0] - 120, front[0] - 5, front[2], front[3])}.items():
        within = (column >= x0) & (column < x1) & (row >= y0) & (row < y1)
        check(f"the number of the {what} stands beside its view", within.sum() > 20, within.sum())
        above &= ~within
    check("and nothing else differs above the line about the model", not above.any())
    plain = Drawing("box.stl", *words)
    v = plain.views["front"]
    under = plain.sheet[v["y"] + v["height"] + 2:v["y"] + v["height"] + 11, v["x"]:v["x"] + v["width"]]
    check("no dimensions are drawn without the option", (under == 255).all())
    for x in front[:2]:
        line = one.sheet[front[3] + 15:front[3] + 40, x - 2:x + 2].min(1)
        check("extension lines stand at the ends", (line.max(1) < 120).all(), line)


def pgm(path):
    head, size, most, data = open(path, "rb").read().split(b"\n", 3)
    width, height = map(int, size.split())
    check("a PGM of 16 bits", head == b"P5" and most == b"65535")
    return np.frombuffer(data, ">u2").reshape(height, width).astype(int)


def files():
    d = Drawing("plate.stl", "--views", "front,iso")
    made = run(f"{T}/plate.stl", f"{T}/p.png", "--views", "front,iso", "--depth", f"{T}/p.d.pgm",
               "--id-map", f"{T}/p.i.pgm", "--json", "-")
    check("JSON on standard output", json.loads(made.stdout)["views"] == d.text["views"])
    check("PGM holds the depth of PNG", (pgm(f"{T}/p.d.pgm") == d.depth).all())
    check("PGM holds the parts of PNG", (pgm(f"{T}/p.i.pgm") == d.ids).all())
    for k, words in enumerate((["--threads", "1"], ["--threads", "5"], ["--samples", "2"])):
        run(f"{T}/assembly.obj", f"{T}/t{k}.ppm", "--views", "front,right,top,iso", "--hidden",
            "--ids", "--dimensions", *words)
    sheets = [open(f"{T}/t{k}.ppm", "rb").read() for k in range(3)]
    check("any number of threads draws the same sheet", sheets[0] == sheets[1] == sheets[2])
    square = Drawing("box.stl", "--views", "front,right,top,iso", "--samples", "1")
    check("maps do not depend on samples", (square.ids == Drawing(
        "box.stl", "--views", "front,right,top,iso", "--samples", "4").ids).all())


def sections():
    """plate.stl is cut open on the viewer's side: how much of each view is cut, and where it is."""
    for axis, where, view, whole, hole in (
            ("x", 6, "right", 50 * 20, 2 * math.sqrt(12.5 ** 2 - 36) * 20),
            ("y", -3, "front", 80 * 20, 2 * math.sqrt(12.5 ** 2 - 9) * 20),
            ("z", 15, "top", 80 * 50, 32 * 12.5 ** 2 * math.sin(2 * math.pi / 64))):
        k, away = "xyz".index(axis), -1 if axis == "y" else 1
        words = ["--views", view + ",iso", "--section", f"{axis}={where}"]
        d = Drawing("plate.stl", *words)
        part = [p["name"] for p in d.text["parts"]].index("section") + 1
        points, ids = d.points(view)
        cut = points[ids == part]
        share, wanted = len(cut) / len(ids), (whole - hole) / (whole if axis != "z" else whole - hole)
        check(f"{axis}: the cut's area", abs(share - wanted) < 0.012, share, wanted)
        check(f"{axis}: it lies in the plane", np.abs(cut[:, k] - where).max() < 0.05)
        beyond = np.concatenate([points, d.points("iso")[0]])[:, k] * away - where * away
        check(f"{axis}: nothing lies beyond", beyond.max() < 0.05, beyond.max())
        check(f"{axis}: iso sees the cut", (d.points("iso")[1] == part).sum() > 500)
        inside = d.ids == part
        for step in (4, -4):    # away from the lines about the cut
            inside &= (np.roll(d.ids, step, 0) == part) & (np.roll(d.ids, step, 1) == part)
        dark = (d.sheet.max(2) < 100)[inside].mean()
        check(f"{axis}: 0.28 of it is hatched", abs(dark - 0.28) < 0.03, dark)
        lines = Drawing("plate.stl", *words, "--edges")
        check(f"{axis}: no lines are drawn within it",
              (lines.sheet[inside] == d.sheet[inside]).all())
    outer, inner = parts.box((0, 0, 0), (100, 80, 60)), parts.box((30, 20, 10), (70, 60, 40))
    parts.write_stl(f"{T}/cavity.stl", outer + [(a, c, b) for a, b, c in inner])
    for part, wanted in (("inner", 1), ("cavity", 1 - 40 * 30 / (80 * 60))):
        d = Drawing(part + ".stl", "--views", "right", "--section", "x")
        n = [p["name"] for p in d.text["parts"]].index("section") + 1
        share = (d.ids == n).sum() / (d.ids > 0).sum()
        check(f"{part}: a cavity is hollow, a part within a part is not", abs(share - wanted) < 0.01,
              share, wanted)


def main():
    parts.main(T)
    for work in (directions, up_axes, hole, dashes, one_behind_another, numbers, assembly,
                 what_is_a_part, dimensions, files, sections):
        work()
    if "assimp" in sys.argv:
        nodes()
    print(f"{passed} passed, {failed} failed")
    return failed > 0


sys.exit(main())
