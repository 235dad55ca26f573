"""parts.py FOLDER - parts for drawing.sh: a plate with a hole, a bracket, a stepped shaft, boxes."""
import math
import struct
import sys


def ring(radius, count, z, x=0.0, y=0.0):
    return [(x + radius * math.cos(2 * math.pi * i / count),
             y + radius * math.sin(2 * math.pi * i / count), z) for i in range(count)]


def strip(a, b):
    """Quads between two rings, as triangles."""
    n = len(a)
    out = []
    for i in range(n):
        k = (i + 1) % n
        out += [(a[i], a[k], b[k]), (a[i], b[k], b[i])]
    return out


def square(width, depth, count, z, x=0.0, y=0.0):
    """As many points as a ring, on the outline of a rectangle, its corners among them."""
    out = []
    for i in range(count):
        t = 8 * i / count
        side, along = int(t + 1) // 2 % 4, (t + 1) % 2 - 1
        px, py = [(1, along), (-along, 1), (-1, -along), (along, -1)][side]
        out.append((x + width / 2 * px, y + depth / 2 * py, z))
    return out


def plate(width, depth, low, high, hole, x=0.0, y=0.0, count=64):
    """A box with a round hole along z through its middle."""
    s0, s1 = (square(width, depth, count, z, x, y) for z in (low, high))
    h0, h1 = (ring(hole, count, z, x, y) for z in (low, high))
    return strip(s0, s1) + strip(s1, h1) + strip(h1, h0) + strip(h0, s0)


def box(low, high):
    """A closed box of twelve triangles."""
    p = [[(low, high)[i >> k & 1][k] for k in range(3)] for i in range(8)]
    quads = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
    out = []
    for a, b, c, d in quads:
        out += [(p[a], p[b], p[c]), (p[a], p[c], p[d])]
    return out


def turned(profile, count=96):
    """A solid of revolution about x; profile: x and radius, from end to end."""
    def circle(x, r):
        return [(x, c[0], c[1]) for c in ring(r, count, 0)]
    out = []
    for (x0, r0), (x1, r1) in zip(profile, profile[1:]):
        out += strip(circle(x1, r1), circle(x0, r0))
    (x0, r0), (x1, r1) = profile[0], profile[-1]
    for i in range(count):
        k = (i + 1) % count
        a, b = circle(x0, r0), circle(x1, r1)
        out += [((x0, 0, 0), a[i], a[k]), ((x1, 0, 0), b[k], b[i])]
    return out


def profile_part(outline, low, high):
    """A polygon in x and z, drawn out along y; as polygons, for OBJ."""
    n = len(outline)
    points = [(x, low, z) for x, z in outline] + [(x, high, z) for x, z in outline]
    faces = [list(range(n)), list(range(2 * n - 1, n - 1, -1))]
    faces += [[i, i + n, (i + 1) % n + n, (i + 1) % n] for i in range(n)]
    return points, faces


def write_stl(path, triangles):
    with open(path, "wb") as file:
        file.write(b"part".ljust(80, b" ") + struct.pack("<I", len(triangles)))
        for t in triangles:
            file.write(struct.pack("<12fH", 0, 0, 0, *(c for p in t for c in p), 0))


def write_obj(path, objects):
    base = 1
    with open(path, "w") as file:
        for name, points, faces in objects:
            file.write(f"o {name}\n" + "".join("v %.9g %.9g %.9g\n" % tuple(p) for p in points))
            for f in faces:
                file.write("f " + " ".join(str(base + i) for i in f) + "\n")
            base += len(points)


def triangles_as_object(name, triangles):
    points = [p for t in triangles for p in t]
    return name, points, [[3 * i, 3 * i + 1, 3 * i + 2] for i in range(len(triangles))]


def main(folder):
    bracket = [(0, 0), (60, 0), (60, 12), (12, 12), (12, 50), (0, 50)]
    upright = lambda part: [tuple((p[0], p[2], -p[1]) for p in t) for t in part]
    shaft = [(0, 8), (30, 8), (30, 14), (70, 14), (70, 10), (110, 10), (112, 8)]
    write_stl(f"{folder}/plate.stl", plate(80, 50, 0, 20, 12.5))
    write_stl(f"{folder}/shaft.stl", turned(shaft))
    write_stl(f"{folder}/box.stl", box((10, 20, 30), (40, 40, 40)))
    # a box inside of another: all of its edges are hidden
    write_stl(f"{folder}/inner.stl", box((0, 0, 0), (100, 80, 60)) + box((30, 20, 10), (70, 60, 40)))
    points, faces = profile_part(bracket, 0, 40)
    write_obj(f"{folder}/bracket.obj", [("bracket", points, faces)])
    base = box((-50, 0, -30), (50, 10, 30))
    hub = [tuple((p[0], p[1] + 10, p[2]) for p in t) for t in upright(plate(40, 40, 0, 30, 10))]
    pin = [tuple((p[1], p[0] + 10, -p[2]) for p in t) for t in turned([(0, 9), (45, 9), (48, 6)])]
    write_obj(f"{folder}/assembly.obj", [triangles_as_object("base_plate", base),
                                         triangles_as_object("hub", hub),
                                         triangles_as_object("pin", pin)])
    write_stl(f"{folder}/pair.stl", box((0, 0, 0), (10, 10, 10)) + box((20, 0, 0), (60, 10, 10)) * 1)


if __name__ == "__main__":
    main(sys.argv[1])
