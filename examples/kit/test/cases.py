#!/usr/bin/env python3
"""cases.py > cases.json - writes the table of cases that C, Python and JavaScript run alike: cases.c,
test_cases.py of the Python package, cases.test.js of the Node package.

What is wanted is computed here, by arithmetic of its own: plain doubles of Python, names of colours from
Pillow's table of CSS, faces of spheres by rays.  A case is { "call", its arguments, "want" } or, with
"refused", the argument and the beginning of the words.  A runner that does not know a call fails.
"""
import json
import math
import random

from PIL import ImageColor

rng = random.Random(53)
cases = []
OURS = {"white": 0xFFFFFF, "black": 0, "gray": 0x808080, "grey": 0x808080, "red": 0xD62728, "green": 0x2CA02C,
        "blue": 0x1F77B4, "orange": 0xFF7F0E, "yellow": 0xF2C037, "purple": 0x9467BD, "brown": 0x8C564B,
        "pink": 0xE377C2, "cyan": 0x17BECF, "steel": 0x8FA3B5, "clay": 0xBFB2A4}


def case(call, **parts):
    cases.append({"call": call, **parts})


def bytes_of(value):
    return [(value >> shift & 255) / 255 for shift in (16, 8, 0)]


# ---- colours

for name, digits in sorted(ImageColor.colormap.items()):
    if name not in OURS:
        case("color", word=name, want=bytes_of(int(ImageColor.getrgb(name)[0]) << 16 |
                                               ImageColor.getrgb(name)[1] << 8 | ImageColor.getrgb(name)[2]))
for name, value in OURS.items():
    case("color", word=name, want=bytes_of(value))
for word in ("Tomato", "REBECCAPURPLE", "sTeEl"):
    value = OURS.get(word.lower())
    if value is None:
        r, g, b = ImageColor.getrgb(word.lower())
        value = r << 16 | g << 8 | b
    case("color", word=word, want=bytes_of(value))
for _ in range(8):
    value = rng.randrange(1 << 24)
    case("color", word=rng.choice(["#", ""]) + f"{value:06{rng.choice('xX')}}", want=bytes_of(value))
for _ in range(6):
    digits = f"{rng.randrange(1 << 12):03x}"
    case("color", word="#" + digits, want=[int(d, 16) * 17 / 255 for d in digits])
for word in ("", "#", "#12", "#12345", "#1234567", "#12g", "reddish", "toString", "0xff0000", "rgb(1,2,3)", " red",
             "red ", "-1"):
    case("color", word=word, refused=["color", "must be #RRGGBB"])
for word in ("jade", "black_plastic", "Cyan-Rubber"):
    case("color", word=word, refused=["color", "must be a colour, and"])


def linear(x):
    return x / 12.92 if x <= 0.04045 else ((x + 0.055) / 1.055) ** 2.4


for row in ([0, 0.5, 1], [1, 0, 0], [0.04, 0.05, 0.001]):
    case("colors", rows=[row], whole=False, want=[[linear(x) for x in row]])
for rows, scale in (([[1, 0, 0]], 1), ([[0, 1, 1], [1, 0, 1], [0, 0, 0]], 1), ([[255, 0, 128]], 255),
                    ([[1, 0, 0], [2, 0, 0]], 255)):
    case("colors", rows=rows, whole=True, want=[[linear(x / scale) for x in row] for row in rows])
case("colors", rows=[[0.5, 0, 1.25]], whole=False, refused=["colors", "must be from 0 to 1"])
case("colors", rows=[[-0.5, 0, 1]], whole=False, refused=["colors", "must be from 0 to 1"])
case("colors", rows=[[256, 0, 0]], whole=True, refused=["colors", "must be from 0 to 255"])

# ---- cameras


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def unit(a):
    length = math.hypot(*a)
    return [x / length for x in a]


def facing(back, up):
    z = unit(back)
    x = cross(unit(up), z)
    if math.hypot(*x) < 1e-6:
        axis = [0.0, 0.0, 0.0]
        axis[min(range(3), key=lambda k: abs(z[k]))] = 1.0
        x = cross(axis, z)
    x = unit(x)
    return [x, cross(z, x), z]


def by_columns(rows):
    return [rows[k % 4][k // 4] for k in range(16)]


def view_of(turn, at):
    return by_columns([[*turn[k], -dot(turn[k], at)] for k in range(3)] + [[0, 0, 0, 1]])


def perspective(fov, aspect, near, far):
    s = math.tan(math.radians(fov) / 2)
    return by_columns([[1 / (s * aspect), 0, 0, 0], [0, 1 / s, 0, 0],
                       [0, 0, (far + near) / (near - far), 2 * far * near / (near - far)], [0, 0, -1, 0]])


def some(scale=1.0):
    return [rng.uniform(-4, 4) * scale for _ in range(3)]


def look(eye, target, up=(0, 0, 1), fov=45, aspect=1.5, near=0.01, far=1000):
    return {"eye": list(eye), "target": list(target), "up": list(up), "fov": fov, "aspect": aspect, "near": near, "far": far}


for scale in (1, 1, 1, 1, 1, 1e-20, 1e-9, 1e4, 1e8, 1e20):
    for _ in range(3):
        asked = look(some(scale), some(scale), some(), rng.uniform(1, 170), rng.uniform(0.2, 5), 0.1 * scale, 1e4 * scale)
        turn = facing([a - b for a, b in zip(asked["eye"], asked["target"])], asked["up"])
        case("look_at", **asked, want={"view": view_of(turn, asked["eye"]),
                                       "projection": perspective(asked["fov"], asked["aspect"], asked["near"], asked["far"])})
for way in ((0, 0, 1), (0, 0, -5), (0, 0, 1e-3)):    # up is the line of sight
    asked = look(way, (0, 0, 0))
    case("look_at", **asked, want={"view": view_of(facing(list(way), [0, 0, 1]), way),
                                   "projection": perspective(45, 1.5, 0.01, 1000)})
good = look((1, 2, 3), (0, 0, 0))
for change, refused in (({"target": [1, 2, 3]}, ["eye", "and target must differ"]),
                        ({"fov": 0}, ["fov", "must be from 0.01 to 179, not 0"]), ({"fov": 180}, ["fov", "must be from 0.01"]),
                        ({"fov": -45}, ["fov", "must be from"]), ({"aspect": 0}, ["aspect", "must be from 0.0001 to 10000"]),
                        ({"aspect": -1}, ["aspect", "must be from"]), ({"near": 0}, ["near", "must be from 1e-30"]),
                        ({"near": -1}, ["near", "must be from"]), ({"far": 0.001}, ["far", "must exceed near, 0.01, not 0.001"]),
                        ({"far": 0.01}, ["far", "must exceed near"]), ({"far": 1e40}, ["far", "must be from"]),
                        ({"eye": [1e39, 0, 0]}, ["eye", "must hold finite numbers"]),
                        ({"target": [0, 1e39, 0]}, ["target", "must hold finite numbers"]),
                        ({"up": [0, 0, -1e39]}, ["up", "must hold finite numbers"])):
    case("look_at", **{**good, **change}, refused=refused)


def turned():
    return facing(some(), some())


for width, height in ((640, 480), (100, 100), (1, 7), (4000, 3000)):
    for _ in range(3):
        f, turn, t = rng.uniform(0.3, 3) * width, turned(), some()
        K = [f, rng.choice([0, 2.5]), rng.uniform(0.3, 0.7) * width, 0, f * rng.uniform(0.8, 1.2), rng.uniform(0.3, 0.7) * height, 0, 0, 1]
        rows = [[*turn[k], t[k]] for k in range(3)]
        near, far = 0.1, 50.0
        # a point in pixels (u, v), whose centres are whole numbers, lies at x = 2 (u + .5) / w - 1
        p = [[2 * K[0] / width, -2 * K[1] / width, 1 - (2 * K[2] + 1) / width, 0],
             [0, 2 * K[4] / height, (2 * K[5] + 1) / height - 1, 0],
             [0, 0, (far + near) / (near - far), 2 * far * near / (near - far)], [0, 0, -1, 0]]
        view = [rows[0], [-x for x in rows[1]], [-x for x in rows[2]], [0, 0, 0, 1]]
        case("opencv", K=K, extrinsics=[*sum(rows, []), 0, 0, 0, 1], size=[width, height], near=near, far=far,
             want={"view": by_columns(view), "projection": by_columns(p)})
IDENTITY = [1.0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]
pinhole = {"K": [100, 0, 50, 0, 100, 50, 0, 0, 1], "extrinsics": IDENTITY, "size": [100, 100], "near": 0.1, "far": 10}


def bent(k, value):
    out = list(IDENTITY)
    out[k] = value
    return out


for change, refused in (({"K": [0, 0, 50, 0, 100, 50, 0, 0, 1]}, ["K", "must have focal lengths"]),
                        ({"K": [100, 0, 50, 0, 0, 50, 0, 0, 1]}, ["K", "must have focal lengths"]),
                        ({"K": [100, 0, 50, 0, 100, 50, 0, 0, 2]}, ["K", "must have focal lengths"]),
                        ({"K": [100, 0, 50, 0, 100, 50, 0.1, 0, 1]}, ["K", "must have focal lengths"]),
                        ({"extrinsics": bent(0, -1)}, ["extrinsics", "must be a rotation"]),
                        ({"extrinsics": bent(0, 2)}, ["extrinsics", "must be a rotation"]),
                        ({"extrinsics": bent(12, 5)}, ["extrinsics", "must be a rotation"]),
                        ({"near": 0}, ["near", "must be from"]), ({"far": 0.05}, ["far", "must exceed near"])):
    case("opencv", **{**pinhole, **change}, refused=refused)

for scale in (1, 1, 1e6):
    turn, at = turned(), some(scale)
    pose = [*turn[0], at[0], *turn[1], at[1], *turn[2], at[2], 0, 0, 0, 1]
    p = perspective(60, 1.25, 0.1, 100)
    back = [[turn[k][j] for k in range(3)] for j in range(3)]
    case("opengl", projection=p, pose=pose, want={"view": view_of(back, at), "projection": p})
for change, refused in (({"pose": bent(10, -1)}, ["pose", "must be a rotation"]), ({"pose": bent(5, 0)}, ["pose", "must be a rotation"]),
                        ({"pose": bent(14, 1)}, ["pose", "must be a rotation"]),
                        ({"projection": [0.0] * 16}, ["projection", "must have near and far planes"]),
                        ({"projection": perspective(60, 1, 9, 0.1)}, ["projection", "must have near and far planes"])):
    case("opengl", **{"projection": perspective(60, 1.25, 0.1, 100), "pose": IDENTITY, **change}, refused=refused)

# ---- the nearest camera that sees all points: by its definition, over all points


def fit(points, azimuth, elevation, width, height, ortho, fov, margin):
    a, e = math.radians(azimuth), math.radians(elevation)
    turn = facing([math.sin(a) * math.cos(e), -math.cos(a) * math.cos(e), math.sin(e)],
                  [-math.sin(a) * math.sin(e), math.cos(a) * math.sin(e), math.cos(e)])
    p = [[dot(row, q) for row in turn] for q in points]
    low, high = ([f(q[k] for q in p) for k in range(3)] for f in (min, max))
    reach = max(math.hypot(*(h - l for h, l in zip(high, low))), max(abs(x) for q in p for x in q) * 1e-6) or 1.0
    slope = math.tan(math.radians(fov) / 2)
    if ortho:
        half = margin * max((high[1] - low[1]) / 2, (high[0] - low[0]) / 2 * height / width, 1e-4 * reach)
        shift, distance = [(low[k] + high[k]) / 2 for k in range(2)], (low[2] + high[2]) / 2 + 2 * reach
        projection = by_columns([[height / (half * width), 0, 0, 0], [0, 1 / half, 0, 0], [0, 0, -1 / (2 * reach), -1], [0, 0, 0, 1]])
    else:
        slopes, shift, least = (slope * width / height, slope), [], high[2] + 1e-3 * reach
        for k, s in enumerate(slopes):
            above, below = max(q[k] + s * q[2] for q in p), max(s * q[2] - q[k] for q in p)
            shift.append((above - below) / 2)
            least = max(least, (above + below) / (2 * s))
        distance = least + (margin - 1) * (least - (low[2] + high[2]) / 2)
        near, far = 0.9 * (distance - high[2]), distance - low[2]
        near, far = max(near, 1e-4 * far), 1.1 * far + 1e-3 * reach
        projection = by_columns([[1 / slopes[0], 0, 0, 0], [0, 1 / slopes[1], 0, 0],
                                 [0, 0, (far + near) / (near - far), 2 * far * near / (near - far)], [0, 0, -1, 0]])
    view = by_columns([[*turn[0], -shift[0]], [*turn[1], -shift[1]], [*turn[2], -distance], [0, 0, 0, 1]])
    return {"view": view, "projection": projection}


for exponent in (0, 0, 0, -90, -40, -20, 10, 27, 60, 90):
    for ortho in (False, True):
        # eighths: exact as floats at every scale
        points = [[rng.randrange(-32, 32) / 8 * 2.0 ** exponent for _ in range(3)] for _ in range(rng.randrange(1, 9))]
        asked = {"view": [rng.uniform(-180, 360), rng.uniform(-89, 89)], "size": [rng.choice([320, 640, 31]), 240], "ortho": ortho,
                 "fov": rng.choice([28, 60]), "margin": rng.choice([1.0, 1.08])}
        case("fit", points=points, **asked, want=fit(points, *asked["view"], *asked["size"], ortho, asked["fov"], asked["margin"]))
square = {"points": [[0, 0, 0], [1, 1, 0]], "view": [0, 0], "size": [64, 64], "ortho": False, "fov": 28, "margin": 1.08}
for change, refused in (({"fov": 0}, ["fov", "must be from 0.01"]), ({"fov": 200}, ["fov", "must be from"]),
                        ({"margin": 0}, ["margin", "must be from 0.01"]), ({"margin": 1000}, ["margin", "must be from"])):
    case("fit", **{**square, **change}, refused=refused)

# ---- faces and poses

for rows in ([[0, 1, 2]], [[3, 1, 2], [0, 2, 1]], [[0, 0, 0]]):
    case("faces", rows=rows, vertices=4, want=sum(rows, []))
for rows in ([[0, 1, 2, 3]], [[3, 0, 1, 2], [0, 1, 2, 3]]):
    case("faces", rows=rows, vertices=4, want=[i for a, b, c, d in rows for i in (a, b, c, a, c, d)])
for rows, words in (([[3, 0, 1, 2], [3, 1, 2, 0]], "begin with 3 in each row"), ([[0, 1, 4]], "bad indices (index 4 of 4"),
                    ([[0, 1, -1]], "bad indices (index -1 of 4"), ([[0, 1, 0.5]], "must hold whole numbers, not 0.5"),
                    ([[0, 1]], "must have the shape"), ([[0, 1, 2, 3, 0]], "must have the shape"),
                    ([[1e12, 0, 1]], "bad indices"), ([[0, 1, 2, 9]], "bad indices (index 9 of 4")):
    case("faces", rows=rows, vertices=4, refused=["faces", words])
for _ in range(10):
    turn, at = turned(), some(rng.choice([1, 1e8]))
    case("pose", matrix=[*turn[0], at[0], *turn[1], at[1], *turn[2], at[2], 0, 0, 0, 1], want=at)
for k, value in ((0, -1), (5, -1), (10, -1), (0, 0.99), (5, 1.01), (1, 0.01), (12, 0.5), (13, 1), (14, -1), (15, 2), (15, 0), (3, 1e39)):
    case("pose", matrix=bent(k, value), refused=["pose", "must "])

# ---- numbers of objects


def handles(*steps):
    case("handles", steps=list(steps))


handles(["add", 0], ["add", 1], ["remove", 0], ["add", 2], ["stale", 0], ["objects", [1, 2]])
handles(["add", 0], ["remove", 0], ["stale", 0], ["add", 1], ["pose", 1], ["stale", 0])
handles(["stale", 0], ["add", 0], ["stale", 1], ["stale", 7])
handles(["add", 0], ["add", 1], ["clear"], ["stale", 0], ["stale", 1], ["add", 2], ["objects", [2]])
handles(*[["add", k] for k in range(5)], ["remove", 4], ["remove", 3], ["add", 5], ["objects", [0, 1, 2, 5]])
handles(["add", 0], ["add", 1], ["add", 2], ["remove", 1], ["pose", 2], ["pose", 0], ["stale", 1], ["objects", [0, 2]])
handles(["add", 0], ["add", 1], ["move", 1, [1, -2, 3]], ["at", 0, [0, 0, 0]], ["at", 1, [1, -2, 3]])
handles(["add", 0], ["move", 0, [1e8, 0.125, -7]], ["pose", 0], ["at", 0, [0, 0, 0]], ["move", 0, [5, 6, 7]], ["at", 0, [5, 6, 7]])
handles(["add", 0], ["add", 1], ["remove", 0], ["move", 1, [0, 0, 9]], ["add", 2], ["at", 2, [0, 0, 0]], ["at", 1, [0, 0, 9]],
        ["stale", 0], ["objects", [1, 2]])
live, steps, number = [], [], 0
for _ in range(60):
    if live and rng.random() < 0.5:
        gone = live.pop(rng.randrange(len(live)))
        steps += [["remove", gone], ["stale", gone]]
    else:
        live.append(number)
        steps.append(["add", number])
        number += 1
handles(*steps, ["objects", live])

# ---- scenes: pixels of spheres by rays, at the origin and far away


def seen(balls, eye, target, fov, size):
    """Of each ball the pixels whose ray meets it first, and how many of these are within half a pixel of a rim."""
    turn, slope, count = facing([a - b for a, b in zip(eye, target)], [0, 0, 1]), math.tan(math.radians(fov) / 2), [0] * len(balls)
    for y in range(size):
        for x in range(size):
            a, b = (2 * (x + 0.5) / size - 1) * slope, (1 - 2 * (y + 0.5) / size) * slope
            ray = unit([a * turn[0][k] + b * turn[1][k] - turn[2][k] for k in range(3)])
            best, which = math.inf, -1
            for i, (at, radius) in enumerate(balls):
                way = [p - q for p, q in zip(at, eye)]
                along = dot(way, ray)
                inside = radius ** 2 - dot(way, way) + along ** 2
                if inside > 0 and along - math.sqrt(inside) < best:
                    best, which = along - math.sqrt(inside), i
            if which >= 0:
                count[which] += 1
    return count


for which in range(14):
    balls = [([rng.randrange(-12, 12) / 8 for _ in range(3)], rng.randrange(2, 7) / 8) for _ in range(3)]
    eye = [rng.randrange(-8, 8) / 8, -6.0, rng.randrange(0, 16) / 8]
    wanted = seen(balls, eye, [0, 0, 0], 50, 48)
    for far in ([0, 0, 0], [524288, 4194304, 128], [0, 0, 6400000], [2 ** 27, -2 ** 27, 2 ** 26], [-2 ** 20, 0, 2 ** 30]):
        case("scene", balls=[[*at, radius] for at, radius in balls], eye=eye, target=[0, 0, 0], fov=50, size=48, far=far, want=wanted)

# ---- the same through MuJoCo's scenes: two cameras of stereo, lamps


def lamp(kind=1, way=(0, 0, -1)):
    """type, headlight, castshadow, cutoff, exponent; pos, dir, ambient, diffuse, specular, attenuation"""
    return [kind, 0, 1, 45, 10, 0, 0, 5, *way, *[0.1] * 3, *[0.7] * 3, *[0.3] * 3, 1, 0, 0]


def mjv(balls, eye, target, fov, size, lights, apart=4, **more):
    toward = unit([a - b for a, b in zip(target, eye)])
    side = unit([toward[1], -toward[0], 0])
    top = 0.1 * math.tan(math.radians(fov) / 2)
    cameras = [[0.1, 1000, top, -top, 0, 0, 0, *(e + s * apart * d for e, d in zip(eye, side)), *toward, 0, 0, 1] for s in (-1, 1)]
    case("mjv", balls=[[*at, radius] for at, radius in balls], cameras=cameras, lights=lights, size=size, **more)


for which in range(8):
    balls = [([rng.randrange(-12, 12) / 8 for _ in range(3)], rng.randrange(2, 7) / 8) for _ in range(3)]
    eye = [rng.randrange(-8, 8) / 8, -6.0, rng.randrange(0, 16) / 8]
    mjv(balls, eye, [0, 0, 0], 50, 48, [lamp()] * (which % 3), want=seen(balls, eye, [0, 0, 0], 50, 48))
mjv([], [0, -6, 0], [0, 0, 0], 50, 48, [lamp(0), lamp(1, (0, 0, 0))], refused=["lights[1]", "must have a direction"])
mjv([], [0, -6, 0], [0, 0, 0], 50, 48, [lamp(0, (0, 1e39, 0))], refused=["lights[0]", "must hold finite numbers"])

# ---- ground: the depth straight above a point of its rows

for which in range(6):
    rows, columns, half = rng.randrange(3, 7), rng.randrange(3, 7), [rng.randrange(2, 9) / 4, rng.randrange(2, 9) / 4]
    heights = [[rng.randrange(-16, 16) / 8 for _ in range(columns)] for _ in range(rows)]
    i, j = rng.randrange(1, rows - 1), rng.randrange(1, columns - 1)
    case("ground", heights=heights, half=half, at=[2 * half[0] * j / (columns - 1) - half[0], 2 * half[1] * i / (rows - 1) - half[1]],
         want=10 - heights[i][j])

# ---- where meshes count from: 0, or a round number near what can be seen of them


def local(points, rows, origin):
    case("local", points=points, faces=rows, want=[[x - o for x, o in zip(p, origin)] for p in points], origin=origin)


corner = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]
four = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]]
for far in ([0, 0, 0], [4, -8, 2], [15, 0, 0]):
    local([[a + b for a, b in zip(p, far)] for p in corner], four, [0, 0, 0])
for far in ([1e6, 0, 0], [524288, -4194304, 128], [0, 6400000, 0]):
    moved = [[a + b for a, b in zip(p, far)] for p in corner]
    origin = [float(round(x + 0.5)) for x in far]    # the middle, in steps as large as the mesh; halves go to the even one
    local(moved, four, origin)
    local(moved + [[0, 0, 0]], four, origin)                                  # no face has the last one
    local(moved + [[5, 5, 5]], four + [[4, 4, 4], [4, 4, 0]], origin)         # nor one that can be seen

# ---- depth and numbers of objects in 16 bits

for unit in (0.001, 0.0002, 1):
    for _ in range(3):
        steps = [rng.randrange(1, 65536) for _ in range(6)] + [1, 65535]
        off = [rng.uniform(-0.4, 0.4) if k < 65535 else -0.25 for k in steps]    # far from a half, which floats would move
        case("depth", unit=unit, depth=[0, -unit, unit / 100] + [(k + d) * unit for k, d in zip(steps, off)],
             want=[0, 0, 1] + steps)
case("depth", unit=0.001, depth=[1, 65.6], want=[], refused=["depth", "must be at most 65.535"])
case("depth", unit=0, depth=[1], want=[], refused=["unit", "must be from"])
case("ids", ids=[-1, 0, 1, 65534, 77], want=[0, 1, 2, 65535, 78])
for wrong in (-2, 65535, 2147483647):
    case("ids", ids=[0, wrong], want=[], refused=["ids", "must be from -1"])

if __name__ == "__main__":
    print('{"cases": [\n' + ",\n".join(json.dumps(one) for one in cases) + "\n]}")
