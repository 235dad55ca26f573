"""The scenes of the checkpoints, drawn by a seed, and the mistakes that right.c can draw.

A scene is a list of numbers in the order of `struct scene` of scene.h.
"""
import math
import re
from pathlib import Path

from judge.tools import Draw, add, cross, dot, scale, sub, unit

VERTICES, TRIANGLES, LAMPS, MAP = 96, 160, 2, 16
FLAT, GOURAUD, PHONG = 0, 1, 2
SHADOW, BUMP, CLIP, SILHOUETTES = 0, 1, 2, 3
TRIES = 5  # scenes of a case


def product(a, b):
    """Returns the product of two matrices of 16 numbers, column after column."""
    return [sum(a[4 * k + i] * b[4 * j + k] for k in range(4)) for j in range(4) for i in range(4)]


IDENTITY = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]


def looks(eye, at, up):
    """Returns the matrix of a camera, from the world to its space."""
    z = unit(sub(eye, at))
    x = unit(cross(up, z))
    y = cross(z, x)
    return [x[0], y[0], z[0], 0, x[1], y[1], z[1], 0, x[2], y[2], z[2], 0, -dot(x, eye), -dot(y, eye),
            -dot(z, eye), 1]


def perspective(fovy, aspect, near, far):
    """Returns the matrix from a camera's space to clip space."""
    f = 1 / math.tan(fovy / 2)
    return [f / aspect, 0, 0, 0, 0, f, 0, 0, 0, 0, (far + near) / (near - far), -1, 0, 0,
            2 * far * near / (near - far), 0]


# ---- meshes: vertices of position, normal, colour, uv, tangent; triangles -------------------------

def vertex(draw, position, normal=(0, 0, 1), uv=(0, 0), tangent=(1, 0, 0), color=None):
    """Returns the 14 numbers of a vertex."""
    return [*position, *normal, *(color or draw.some(0.15, 1, 3)), *uv, *tangent]


def sphere(draw, columns=10, rows=7):
    """Returns a sphere of radius 1."""
    vertices, triangles = [], []
    for j in range(rows + 1):
        for i in range(columns + 1):
            theta, phi = math.pi * j / rows, 2 * math.pi * i / columns
            n = [math.sin(theta) * math.cos(phi), math.cos(theta), -math.sin(theta) * math.sin(phi)]
            n = [round(c, 6) + 0.0 for c in n]  # one place has the same numbers, also at seam and poles
            vertices.append(vertex(draw, n, n, (2 * i / columns, j / rows),
                                   (-math.sin(phi), 0, -math.cos(phi))))
    for j in range(rows):
        for i in range(columns):
            a = j * (columns + 1) + i
            b = a + columns + 1
            if j:
                triangles.append((a, b, a + 1))
            if j < rows - 1:
                triangles.append((a + 1, b, b + 1))
    return vertices, triangles


def sheet(draw, corners, repeat=1, color=None):
    """Returns a rectangle of two triangles from its lower left corner on, counter-clockwise."""
    normal = unit(cross(sub(corners[1], corners[0]), sub(corners[3], corners[0])))
    tangent = unit(sub(corners[1], corners[0]))
    places = ((0, repeat), (repeat, repeat), (repeat, 0), (0, 0))
    vertices = [vertex(draw, c, normal, uv, tangent, color) for c, uv in zip(corners, places)]
    return vertices, [(0, 1, 2), (0, 2, 3)]


def grid(draw, turned):
    """Returns triangles that face the camera, in the plane z = 0; some with their corners turned
    round."""
    vertices, triangles = [], []
    for j in range(5):
        for i in range(6):
            at = [0.5 * (i - 2.5) + draw.between(-0.18, 0.18), 0.5 * (j - 2) + draw.between(-0.18, 0.18)]
            vertices.append(vertex(draw, [*at, 0]))
    for j in range(4):
        for i in range(5):
            a = 6 * j + i
            for t in ((a, a + 1, a + 7), (a, a + 7, a + 6)):
                if draw.random() < 0.75:
                    triangles.append(t[::-1] if turned and draw.random() < 0.5 else t)
    return vertices, triangles


def apart(mesh):
    """Returns a mesh whose faces share no vertex."""
    vertices, triangles = mesh
    return ([vertices[k] for face in triangles for k in face],
            [(3 * k, 3 * k + 1, 3 * k + 2) for k in range(len(triangles))])


def joined(*meshes):
    """Returns meshes as one."""
    vertices, triangles = [], []
    for some, faces in meshes:
        triangles += [tuple(k + len(vertices) for k in face) for face in faces]
        vertices += some
    return vertices, triangles


# ---- scenes ---------------------------------------------------------------------------------------

def lamp(draw, at, aim):
    """Returns a lamp in front of what it lights."""
    return [*at, 1, *draw.some(0.02, 0.1, 3), *draw.some(0.6, 1.1, 3), *draw.some(0.6, 1, 3), 0.4,
            0.1, 0.04, *scale(draw.between(0.5, 2), sub(aim, at)), draw.between(1, 6),
            math.cos(draw.between(0.35, 0.6))]


def turned(draw):
    """Returns a model matrix that turns, scales by axes and moves."""
    z = draw.direction()
    x = unit(cross(draw.direction(), z))
    y = cross(z, x)
    s = [draw.between(0.7, 1.3), draw.between(0.5, 0.8), draw.between(0.9, 1.4)]
    return [*scale(s[0], x), 0, *scale(s[1], y), 0, *scale(s[2], z), 0, *draw.some(-0.4, 0.4, 3), 1]


def camera(draw, distance=(2.8, 3.6)):
    """Returns an eye around the origin, what it looks at, and up."""
    direction = draw.direction()
    while abs(direction[1]) > 0.7:
        direction = draw.direction()
    return scale(draw.between(*distance), direction), draw.some(-0.2, 0.2, 3), [0, 1, 0]


def scene(draw, checkpoint, mesh, view=None, model=None, **fields):
    """Returns the numbers of a scene; fields that are not given are drawn."""
    vertices, triangles = mesh
    eye, at, up = view or camera(draw)
    near, far = fields.get("near", 0.5), fields.get("far", 12)
    toward = unit(sub(eye, at))
    lamps = fields.get("lamp_places")
    if not lamps:
        side = unit(cross([0.3, 1, 0.1], toward))
        lamps = [add(scale(2.6, unit(add(toward, add(scale(0.8, side), [0, 0.7, 0])))), at),
                 add(scale(2.6, unit(add(scale(-0.7, toward), add(scale(-1, side), [0, 0.3, 0])))), at)]
    numbers = [checkpoint, fields.get("option", 0), fields.get("shading", PHONG),
               fields.get("iteration", 4), fields.get("mipmaps", 0), LAMPS, len(vertices),
               len(triangles), fields.get("fovy", draw.between(0.7, 1)), near, far,
               fields.get("bias", 0.01)]
    numbers += [*eye, *at, *up, *draw.some(0.1, 0.25, 3), *(model or IDENTITY),
                *fields.get("lamp_camera", IDENTITY)]
    numbers += draw.some(0.02, 0.15, 3) + draw.some(0.2, 0.5, 3) + draw.some(0.2, 0.6, 3)
    numbers += draw.some(0.3, 0.5, 3) + [draw.between(5, 20)]
    for place in lamps:
        numbers += lamp(draw, place, at)
    numbers += fields.get("map") or [c for _ in range(MAP * MAP) for c in draw.some(0.05, 1, 3)]
    numbers += [x for v in vertices for x in v] + [0] * (14 * (VERTICES - len(vertices)))
    numbers += [k for t in triangles for k in t] + [0] * (3 * (TRIANGLES - len(triangles)))
    return numbers


def square(size, z=0.0):
    """Returns the corners of a square that faces +z."""
    return [[-size, -size, z], [size, -size, z], [size, size, z], [-size, size, z]]


def front(draw, low=2.6, high=3.4):
    """Returns a camera that looks along -z."""
    return [0, 0, draw.between(low, high)], [0, 0, 0], [0, 1, 0]


def depths(draw, crossing):
    """Sheets behind each other, in any order, or across each other."""
    meshes = []
    for k in range(4):
        at, size = draw.some(-0.5, 0.5, 2), draw.between(0.5, 0.9)
        tilt = draw.between(-0.9, 0.9) if crossing else 0
        corners = [[x + at[0], y + at[1], tilt * x + (0 if crossing else 0.35 * k - 0.5)]
                   for x, y, _ in square(size)]
        meshes.append(sheet(draw, corners))
    draw.shuffle(meshes)
    return scene(draw, 3, joined(*meshes), front(draw))


def floor(draw, checkpoint, repeat=1, **fields):
    """A floor that runs away from the eye."""
    wide, far = draw.between(1, 1.6), draw.between(3, 6)
    corners = [[-wide, -0.7, 1.6], [wide, -0.7, 1.6], [wide, -0.5, -far], [-wide, -0.5, -far]]
    wall = [[-0.4, -0.7, 0], [0.7, -0.7, -1.5], [0.7, 0.8, -1.5], [-0.4, 0.8, 0]]
    mesh = joined(sheet(draw, corners, repeat), sheet(draw, wall, repeat))
    return scene(draw, checkpoint, mesh, ([draw.between(-0.3, 0.3), 0.1, 3], [0, -0.1, 0], [0, 1, 0]),
                 **fields)


def lit(draw, shading, iteration):
    """A sphere that is turned and scaled, under two lamps."""
    return scene(draw, 4, sphere(draw), model=turned(draw), shading=shading, iteration=iteration)


def textured(draw, kind):
    """A square with a map: near, in perspective and repeated, or far away."""
    if kind == "near":
        return scene(draw, 5, sheet(draw, square(draw.between(0.7, 1))), front(draw, 2, 2.5))
    if kind == "floor":
        return floor(draw, 5, 2)
    return scene(draw, 5, sheet(draw, square(draw.between(1, 1.4)), draw.choice([3, 4, 5])),
                 front(draw, 3, 5), mipmaps=1)


def shadowed(draw):
    """A ball over a floor, and a lamp above them that has drawn a map of depths."""
    height = draw.between(0.3, 0.8)
    ball = [[*add(scale(0.5, v[0:3]), [0, height, 0]), *v[3:]]
            for v in sphere(draw, 8, 6)[0]]
    size = draw.between(1.6, 2.2)
    ground = sheet(draw, [[-size, -0.5, size], [size, -0.5, size], [size, -0.5, -size],
                          [-size, -0.5, -size]])
    above = [draw.between(-1.2, 1.2), 3.2, draw.between(-0.8, 0.8)]
    lamp_camera = product(perspective(draw.between(0.6, 0.85), 1, 1, 6),
                          looks(above, [0, 0, 0], [0, 0, 1]))
    return scene(draw, 6, joined((ball, sphere(draw, 8, 6)[1]), ground),
                 ([draw.between(-1, 1), 2.2, 3.4], [0, 0, 0], [0, 1, 0]), option=SHADOW,
                 lamp_camera=lamp_camera, lamp_places=[above, [2.5, 2, 2]], bias=0.012)


def bumped(draw, flat):
    """A square or a ball with a map of normals."""
    bumps = []
    for _ in range(MAP * MAP):
        bumps += [c / 2 + 0.5 for c in unit([*draw.some(-0.5, 0.5, 2), 1])]
    vertices, triangles = sheet(draw, square(1)) if flat else sphere(draw)
    for v in vertices:  # tangents lean toward N
        v[11:14] = unit(add(v[11:14], scale(0.5, v[3:6])))
    mesh = vertices, triangles
    return scene(draw, 6, mesh, front(draw) if flat else None, None if flat else turned(draw),
                 option=BUMP, map=bumps)


def clipped(draw, few):
    """A floor that begins behind the eye, and more."""
    wide = draw.between(0.8, 1.5)
    corners = [[-wide, -0.6, 5], [wide, -0.6, 5], [wide, -0.3, -4], [-wide, -0.3, -4]]
    at = draw.between(-0.5, 0.4)
    meshes = [sheet(draw, corners), sheet(draw, [[x + at, y + 0.3, 0] for x, y, _ in square(0.15)])]
    if not few:
        at = draw.between(-0.6, 0.6)
        meshes.append(sheet(draw, [[at, -0.6, 4], [at + 0.3, 0.5, -3], [at + 0.5, 0.9, -3],
                                   [at + 0.4, 0.8, 4]]))
    return scene(draw, 6, joined(*meshes), ([draw.between(-0.2, 0.2), 0, 3], [0, -0.1, 0], [0, 1, 0]),
                 option=CLIP)


def outlined(draw, mesh):
    """A ball in tones from cool to warm, with the ends of its silhouette marked."""
    return scene(draw, 6, mesh, model=turned(draw), option=SILHOUETTES)


CASES = {  # points, name, what makes a scene, what to look at
    "1": [(2, "a camera that looks along -z", lambda d: scene(d, 1, sphere(d), front(d)),
           "Go through the chain for one vertex by hand: world, camera, clip, divided by w, window. "
           "X = (x/w + 1) W/2, Y = (1 - y/w) H/2."),
          (4, "a camera anywhere", lambda d: scene(d, 1, sphere(d), camera(d)),
           "The camera's axes are the rows of its matrix, and it takes the eye to the origin."),
          (4, "a model that is turned, scaled and moved",
           lambda d: scene(d, 1, sphere(d), camera(d), turned(d), near=2.6, far=3.6),
           "The model's matrix comes first: P V M p.")],
    "2": [(5, "triangles", lambda d: scene(d, 2, grid(d, False), front(d)),
           "A pixel belongs to a triangle where its centre, (i + .5, j + .5), is inside of all edges; "
           "its colour is alpha c_0 + beta c_1 + gamma c_2."),
          (5, "triangles with their corners either way",
           lambda d: scene(d, 2, grid(d, True), front(d)),
           "Corners go round either way: divide each edge function by the whole area, with its sign.")],
    "3": [(3, "sheets behind each other", lambda d: depths(d, False),
           "Keep the depth of each pixel, and draw where the new one is less."),
          (3, "sheets that cross", lambda d: depths(d, True),
           "The depth is that of the pixel, interpolated like a colour, but without perspective."),
          (4, "a floor in perspective", lambda d: floor(d, 3),
           "Interpolate c/w and 1/w, and divide.")],
    "4": [(2, "iterations zero to two, flat", lambda d: lit(d, FLAT, d.randint(0, 2)),
           "Iteration zero is k_e, one adds k_a I_a, two adds k_d I_d (N.L)+. Flat: once for a "
           "triangle, at the mean of its corners, with its own normal."),
          (2, "iteration three, Gouraud", lambda d: lit(d, GOURAUD, 3),
           "Light the vertices, in the world, and interpolate their colours."),
          (3, "iteration three, Phong", lambda d: lit(d, PHONG, 3),
           "Interpolate N and P, make N unit, and light each pixel."),
          (3, "iteration four", lambda d: lit(d, d.choice([GOURAUD, PHONG]), 4),
           "Each lamp has its own L, H, r, cone and B; its ambient light stands outside of both.")],
    "5": [(4, "a map nearby", lambda d: textured(d, "near"),
           "Mix the four texels around u MAP - 1/2, v MAP - 1/2."),
          (3, "a map that repeats, in perspective", lambda d: textured(d, "floor"),
           "u and v are interpolated over w, like colours; the map repeats, also to the left of 0."),
          (3, "a map far away", lambda d: textured(d, "far"),
           "Level l + 1 is the mean of 2 x 2 texels of level l. The level has a fraction: mix two.")],
    "6_shadow": [(10, "a ball over a floor", shadowed,
                  "Draw depths from lamp 0 first, into 64 x 64 pixels. A point is in shadow where its own "
                  "depth there is larger than that of the map and bias; lamp 0 then adds its ambient "
                  "light alone.")],
    "6_bump": [(4, "a square", lambda d: bumped(d, True),
                "n = 2 texel - 1; N' = n_x T + n_y B + n_z N, made unit; B = N x T."),
               (6, "a ball", lambda d: bumped(d, False),
                "Take T at a right angle to N in each pixel: T - (N.T) N, made unit.")],
    "6_clip": [(5, "a floor that begins behind you", lambda d: clipped(d, True),
                "Clip before you divide by w: at z = -w, all of a vertex is interpolated."),
               (5, "a floor and a wall", lambda d: clipped(d, False),
                "One corner in front leaves a triangle, two leave a polygon of four, which is two "
                "triangles.")],
    "6_silhouettes": [(5, "a coarse ball", lambda d: outlined(d, apart(sphere(d, 5, 4))),
                       "The tone is cool + (1 + N.L)/2 (warm - cool), and k_e is added. Both ends of an "
                       "edge are marked where (e.n_0)(e.n_1) <= 0."),
                      (5, "a finer ball", lambda d: outlined(d, sphere(d, 10, 6)),
                       "Faces share an edge where both its ends are in one place.")],
}
# What right.c can draw on purpose: the checkpoint, the sentence
MISTAKES = {
    "WHOLE_ANGLE": ("1", "The picture is too small: fovy is the whole angle, so f = 1 / tan(fovy / 2)."),
    "NO_ASPECT": ("1", "The picture is too wide: x is divided by the aspect, width / height, too."),
    "NO_MODEL": ("1", "The model's matrix is missing: P V M p."),
    "NO_TRANSLATION": ("1", "The camera turns, and does not move: the last column of V has -x.e, -y.e, "
                            "-z.e."),
    "REVERSED_ORDER": ("1", "The matrices are in the other order: clip = P V M p, M first."),
    "NOT_DIVIDED": ("1", "x and y are not divided by w."),
    "WHOLE_WIDTH": ("1", "x/w goes from -1 to 1, twice the width of a unit: X = (x/w + 1) W/2."),
    "VIEW_NOT_INVERTED": ("1", "V has the camera's axes as columns: this takes the camera to the world. "
                               "It must take the world to the camera: axes as rows."),
    "UP_AS_IS": ("1", "y of the camera is `up` itself: it is z x x, at a right angle to both."),
    "AXES_AS_COLUMNS": ("1", "The camera's axes are the columns of V: they are its rows."),
    "ROWS_TIMES": ("1", "Points go through the transposed matrix: it is M @ p, or p @ M.T."),
    "ASPECT_TURNED": ("1", "The aspect is turned round: width / height."),
    "NOT_CUT": ("1", "What is nearer than near or beyond far is drawn: leave it out."),
    "NEXT_COLOR": ("2", "Each colour has gone to the wrong corner: alpha is the edge function of the "
                        "corners 1 and 2."),
    "FLAT_COLOR": ("2", "Each triangle has the colour of its first corner: weigh the three."),
    "MEAN_COLOR": ("2", "Each triangle has the mean of its colours: weigh the three by areas."),
    "CORNERS": ("2", "Pixels are tested at their corners: the centre of (i, j) is (i + .5, j + .5)."),
    "ONE_WINDING": ("2", "Triangles with corners clockwise are missing: divide by the area with its "
                         "sign, or turn them round."),
    "OTHER_WINDING": ("2", "Triangles with corners counter-clockwise are missing: with y down their e is "
                           "negative, so divide by it with its sign."),
    "WHOLE_PIXELS": ("2", "Vertices are cut to whole pixels: keep X and Y as they are."),
    "NO_DEPTH": ("3", "What is drawn last covers all: keep depths, and draw where the new one is less."),
    "REVERSED_DEPTH": ("3", "The farthest wins: nearer is less."),
    "AFFINE": ("35", "Interpolation is not in perspective: c/w and 1/w are linear in the picture, c is "
                     "not."),
    "DEPTH_OF_FACE": ("3", "Each triangle has one depth: that of its first corner. Interpolate z/w."),
    "NO_GATE": ("4", "Highlights shine behind the terminator: B is 0 where N.L <= 0, for both terms."),
    "MIRRORED": ("4", "The highlight is (R.V)^n: iteration three has (N.H)^n."),
    "HALF_SHORT": ("4", "H is (L + V) / 2: make it unit."),
    "MODEL_NORMALS": ("4", "Normals go through M, which is scaled: they take the inverse transpose."),
    "LONG_NORMALS": ("4", "Between vertices N is shorter than 1: make it unit in each pixel."),
    "AS_FLAT": ("4", "This is flat shading: look at scene.shading."),
    "AS_GOURAUD": ("4", "This is Gouraud's interpolation, of colours: look at scene.shading."),
    "AS_PHONG": ("4", "This is Phong's interpolation, of normals: look at scene.shading."),
    "NO_FALL_OFF": ("4", "Lamps do not fade: divide by a + b r + c r^2."),
    "ONE_LAMP": ("4", "Lamp 1 is missing: iteration four adds all lamps."),
    "NO_AMBIENT": ("4", "k_a I_a is missing."),
    "NO_EXPONENT": ("4", "The highlight is as wide as for n = 1: (N.H)^n."),
    "FAR_VIEWER": ("4", "V is the same everywhere: it is the unit vector from P to the eye."),
    "NO_CONE": ("4", "Lamps shine outside of their cones: (L.S)^e where L.S >= cos beta, else 0."),
    "NO_LAMP_AMBIENT": ("4", "k_a I_La is missing: each lamp has it, outside of cone and distance."),
    "NO_DIFFUSE": ("4", "The diffuse term is missing."),
    "NO_SPECULAR": ("4", "The highlight is missing."),
    "ITERATION_FEWER": ("4", "This is one iteration less: look at scene.iteration."),
    "NEAREST": ("5", "This takes the nearest texel: mix four."),
    "HALF_TEXEL": ("5", "The map is shifted by half a texel: centres are at (i + .5) / MAP."),
    "V_UP": ("5", "The map is upside down: v = 0 is its top row."),
    "UV_SWAPPED": ("5", "u and v are exchanged: map[row MAP + column], and v is the row."),
    "CLAMPED": ("5", "The map's border goes on: it repeats, u - floor(u)."),
    "NO_LEVEL": ("5", "The map sparkles: level 0 is taken where scene.mipmaps asks for a level."),
    "LEVEL_ABOVE": ("5", "The level is one too high: log2 of texels in a pixel's side."),
    "WHOLE_LEVEL": ("5", "The level is cut to a whole number: mix two levels by its fraction."),
    "NO_BIAS": ("6_shadow", "Surfaces shadow themselves in stripes: add bias to the map's depth."),
    "NO_SHADOW": ("6_shadow", "There is no shadow."),
    "DARK_SHADOW": ("6_shadow", "In shadow all is black: only what lamp 0 sends is missing, the diffuse "
                                "and specular terms."),
    "OUTSIDE_DARK": ("6_shadow", "What the map does not show is dark: it is lit."),
    "NO_MAP": ("6_bump", "The map is not used."),
    "NOT_DECODED": ("6_bump", "Texels are taken as they are: n = 2 texel - 1."),
    "GREEN_DOWN": ("6_bump", "B points the other way: B = N x T."),
    "T_AS_IS": ("6_bump", "T leans toward N: take T - (N.T) N, made unit."),
    "TB_SWAPPED": ("6_bump", "T and B are exchanged: red goes along T."),
    "MAP_ALONE": ("6_bump", "N is that of the map: turn it into T, B and N."),
    "DROPPED": ("6_clip", "Triangles that cross the near plane are dropped: a part of them is left."),
    "NO_TONES": ("6_silhouettes", "This is the light of iteration four: tones go from cool to warm."),
    "TONES_SWAPPED": ("6_silhouettes", "Warm and cool are exchanged: toward lamp 0 it is warm."),
    "NO_LINES": ("6_silhouettes", "The silhouette is not marked. Faces share an edge by its places, not by "
                                  "the numbers of its vertices."),
    "OTHER_EDGES": ("6_silhouettes", "All other edges are marked: (e.n_0)(e.n_1) <= 0."),
}


def numbered():
    """Returns the number that right.c has for each mistake."""
    text = (Path(__file__).parent / "right.c").read_text(encoding="utf-8")
    names = re.search(r"enum \{\s*(NONE,.*?)\};", text, re.S).group(1)
    return {name: k for k, name in enumerate(re.findall(r"\w+", names))}


def scenes(task, case, seed):
    """Returns the scenes of a case."""
    draw = Draw(f"{task} {case[1]} {seed}")
    return [[float(x) for x in case[2](draw)] for _ in range(TRIES)]
