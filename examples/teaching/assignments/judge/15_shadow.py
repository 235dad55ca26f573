"""15. The test for shadow."""
import math

from .points import Case

INPUTS = ("depth[0]4 depth[4]4 depth[8]4 depth[12]4 lamp.col[0]4 lamp.col[1]4 lamp.col[2]4 "
          "lamp.col[3]4 P3 bias1")
OUTPUTS, TOLERANCE = "1", 0


def lit(depth, lamp, P, bias):
    """1 where the lamp sees P, 0 in shadow; what the map does not show is lit."""
    x, y, z, w = [sum(c * p for c, p in zip(lamp[k::4], [*P, 1])) for k in range(4)]
    if w <= 0:
        return 1
    u, v = (x / w + 1) / 2, (1 - y / w) / 2
    if not (0 <= u < 1 and 0 <= v < 1):
        return 1
    seen = depth[4 * math.floor(4 * v) + math.floor(4 * u)]
    return 1 if (z / w + 1) / 2 <= seen + bias else 0


FUNCTIONS = [lit]


def scene(draw, kind):
    """Returns a map of depths, the matrix of a lamp, and a place whose depth there is a little less
    or more than that of the map."""
    near, far, fov = 0.5, draw.between(6, 12), draw.between(0.8, 1.6)
    f = 1 / math.tan(fov / 2)
    projection = [[f, 0, 0, 0], [0, f, 0, 0], [0, 0, (far + near) / (near - far), -1],
                  [0, 0, 2 * far * near / (near - far), 0]]
    axis = draw.direction()
    side = draw.at(axis, 0)
    up = [axis[1] * side[2] - axis[2] * side[1], axis[2] * side[0] - axis[0] * side[2],
          axis[0] * side[1] - axis[1] * side[0]]
    eye = draw.some(-2, 2, 3)
    rows = [side, up, axis]
    view = [[r[k] for r in rows] + [0] for k in range(3)]
    view.append([-sum(a * b for a, b in zip(r, eye)) for r in rows] + [1])
    lamp = [sum(projection[k][j] * column[k] for k in range(4)) for column in view for j in range(4)]
    texels = draw.some(0.5, 0.98, 16)
    bias = draw.between(0.002, 0.01)
    i, j = draw.randrange(4), draw.randrange(4)
    u, v = (i + draw.between(0.05, 0.95)) / 4, (j + draw.between(0.05, 0.95)) / 4
    z01 = draw.between(0.55, 0.97)
    if kind == "outside":
        u, v = draw.choice([(draw.between(-1, -0.1), v), (draw.between(1.1, 2), v),
                            (u, draw.between(-1, -0.1)), (u, draw.between(1.1, 2))])
        texels = draw.some(0, 1, 16)
    elif kind == "behind":
        texels = draw.some(0, 3, 16)
    else:
        by = {"front": draw.between(-0.3, -0.05), "shadow": draw.between(0.03, 0.3) + bias,
              "acne": draw.choice([-1, 1]) * draw.between(0.1, 0.9) * bias}[kind]
        texels[4 * j + i] = z01 - by
    ndc = 2 * z01 - 1
    distance = 2 * far * near / (far + near - ndc * (far - near))
    if kind == "behind":
        distance = -draw.between(0.5, 4)
    at = [(2 * u - 1) * distance / f, (1 - 2 * v) * distance / f, -distance]
    P = [e + sum(r[k] * a for r, a in zip(rows, at)) for k, e in enumerate(eye)]
    return texels + lamp + P + [bias]


def of(*kinds):
    """Returns what makes scenes of some kinds."""
    return lambda draw: scene(draw, draw.choice(kinds))


CASES = [
    Case(3, "in the light", of("front"),
         "The lamp sees P where its depth, (z/w + 1) / 2, is at most that of the map: return 1."),
    Case(3, "in shadow", of("shadow"),
         "Something nearer to the lamp is in the map where P's depth is larger than the map's and "
         "bias: return 0."),
    Case(2, "on the surface that the map shows", of("acne"),
         "P itself is what the map shows, but for rounding: bias is added to the map's depth, so "
         "that a surface does not shadow itself."),
    Case(2, "beside the map and behind the lamp", of("outside", "behind"),
         "What the map does not show is lit: u or v outside of 0 to 1, and w <= 0, behind the lamp."),
]
DEPTH = "(z / w + 1) / 2 <= seen + bias"
MISTAKES = [
    ("reversed", DEPTH, "(z / w + 1) / 2 > seen + bias",
     "Light and shadow are exchanged: P is in shadow where it is farther from the lamp than the map."),
    ("no_bias", DEPTH, "(z / w + 1) / 2 <= seen",
     "Without bias a surface shadows itself, in stripes: compare with the map's depth + bias."),
    ("bias_subtracted", DEPTH, "(z / w + 1) / 2 <= seen - bias",
     "bias is on the wrong side: it is added to the depth of the map."),
    ("depth_not_halved", DEPTH, "z / w <= seen + bias",
     "z/w goes from -1 to 1, and the map from 0 to 1: (z/w + 1) / 2."),
    ("not_divided", DEPTH, "(z + 1) / 2 <= seen + bias", "z is not divided by w."),
    ("place_not_divided", "u, v = (x / w + 1) / 2, (1 - y / w) / 2", "u, v = (x + 1) / 2, (1 - y) / 2",
     "x and y are not divided by w: the place in the map is in perspective."),
    ("place_not_halved", "u, v = (x / w + 1) / 2, (1 - y / w) / 2", "u, v = x / w, -y / w",
     "x/w goes from -1 to 1, and u from 0 to 1: (x/w + 1) / 2."),
    ("upside_down", "(1 - y / w) / 2", "(1 + y / w) / 2",
     "The map is upside down: row 0 is its top, and y goes up: v = (1 - y/w) / 2."),
    ("mirrored", "u, v = (x / w + 1) / 2", "u, v = (1 - x / w) / 2", "The map is mirrored: u = (x/w + "
                                                                     "1) / 2."),
    ("exchanged", "4 * math.floor(4 * v) + math.floor(4 * u)", "4 * math.floor(4 * u) + math.floor(4 * "
     "v)", "Rows and columns of the map are exchanged: depth[4 row + column]."),
    ("rounded", "4 * math.floor(4 * v) + math.floor(4 * u)",
     "4 * min(3, math.floor(4 * v + 0.5)) + min(3, math.floor(4 * u + 0.5))",
     "Texels are rounded to: texel i reaches from i / 4 to (i + 1) / 4, so cut, do not round."),
    ("outside_dark", "        return 1\n    seen", "        return 0\n    seen",
     "What lies beside the map is dark here: it is lit, for the map does not tell."),
    ("outside_clamped", "    if not (0 <= u < 1 and 0 <= v < 1):\n        return 1\n",
     "    u, v = min(max(u, 0), 0.99), min(max(v, 0), 0.99)\n",
     "Beside the map its border is taken: what the map does not show is lit."),
    ("outside_repeats", "    if not (0 <= u < 1 and 0 <= v < 1):\n        return 1\n",
     "    u, v = u % 1, v % 1\n", "Beside the map it repeats: what it does not show is lit."),
    ("behind_seen", "    if w <= 0:\n        return 1\n", "",
     "Behind the lamp, where w is negative, the map is mirrored and means nothing: there is light."),
    ("behind_dark", "    if w <= 0:\n        return 1\n", "    if w <= 0:\n        return 0\n",
     "Behind the lamp there is no shadow here: return 1."),
    ("always", "return 1 if " + DEPTH + " else 0", "return 1", "Nothing is in shadow."),
    ("rows_of_matrix", "lamp[k::4]", "lamp[4 * k:4 * k + 4]",
     "The matrix is taken by rows: col[k] is a column, and lamp P = col[0] x + col[1] y + ..."),
    ("as_direction", "[*P, 1]", "[*P, 0]", "P is a place: its fourth coordinate is 1."),
]


def place(x, y):
    """The inputs of a place of the picture."""
    block = [1.0] * 16
    block[5] = block[6] = block[9] = 0.5
    return block + [0.8, 0, 0, 0, 0, 0.8, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1] + [1.4 * x, -1.4 * y, 0.5,
                                                                         0.004]


def color(out, x, y):
    """What an answer looks like there."""
    return 3 * [0.15 + 0.8 * out[0]]
