"""14. A normal from a map."""
import math

from .points import Case
from .tools import add, ball, cross, dot, length, scale, sub, unit

INPUTS, OUTPUTS, TOLERANCE = "N3 T3 texel3", "3", 1e-4


def bumped(N, T, texel):
    """The normal that a map of normals has, in the frame of T, B and N."""
    n = [2 * c - 1 for c in texel]
    T = unit(sub(T, scale(dot(N, T), N)))
    B = cross(N, T)
    return unit(add(add(scale(n[0], T), scale(n[1], B)), scale(n[2], N)))


FUNCTIONS = [bumped]


def frame(draw, cosine, flat=False):
    """Returns a normal, a tangent with a cosine to it, of any length, and a texel."""
    N = draw.direction()
    n = [0, 0, 1] if flat else unit([*draw.some(-0.8, 0.8, 2), draw.between(0.3, 1)])
    return N + scale(draw.spread(0.3, 3), draw.at(N, cosine)) + [c / 2 + 0.5 for c in n]


CASES = [
    Case(2, "a flat texel", lambda draw: frame(draw, draw.between(-0.7, 0.7), True),
         "The texel (.5, .5, 1) is the normal (0, 0, 1) of the map: the answer is N."),
    Case(5, "a tangent at a right angle", lambda draw: frame(draw, 0),
         "The texel is 2 texel - 1, in the frame of T, B = N x T and N: n_x T + n_y B + n_z N."),
    Case(3, "a tangent that is not", lambda draw: frame(draw, draw.choice([-1, 1]) *
                                                        draw.between(0.2, 0.8)),
         "Between vertices T is not at a right angle to N: take off its part along N, (N.T) N, and "
         "make it unit."),
]
SUM = "add(add(scale(n[0], T), scale(n[1], B)), scale(n[2], N))"
MISTAKES = [
    ("not_decoded", "2 * c - 1 for c", "c for c",
     "The texel is taken as it is: 0 to 1 stands for -1 to 1, so the normal is 2 texel - 1."),
    ("only_minus", "2 * c - 1 for c", "c - 1 for c", "The texel is decoded by c - 1: it is 2 c - 1."),
    ("not_straightened", "unit(sub(T, scale(dot(N, T), N)))", "unit(T)",
     "T is not at a right angle to N: take off (N.T) N first."),
    ("not_unit", "unit(sub(T, scale(dot(N, T), N)))", "sub(T, scale(dot(N, T), N))",
     "T is not made unit after its part along N is taken off."),
    ("not_unit_at_all", "unit(sub(T, scale(dot(N, T), N)))", "T",
     "T is taken as it is: take off (N.T) N, and make it unit."),
    ("left_handed", "cross(N, T)", "cross(T, N)", "B points the other way, and green is upside down: B = N x T."),
    ("exchanged", "scale(n[0], T), scale(n[1], B)", "scale(n[1], T), scale(n[0], B)",
     "T and B are exchanged: red goes along T, green along B."),
    ("map_alone", f"unit({SUM})", "unit(n)",
     "This is the normal of the map itself, in the frame of the map: turn it into that of T, B and "
     "N."),
    ("normal_alone", f"unit({SUM})", "N", "This is N: the map is not used."),
    ("added", f"unit({SUM})", "unit(add(N, n))",
     "The normal of the map is added to N: its coordinates belong to T, B and N."),
    ("without_blue", "scale(n[2], N)", "N", "N itself is added: it is times n_z, the blue of the map."),
    ("transposed", SUM, "[dot(T, n), dot(B, n), dot(N, n)]",
     "This takes n into the frame of T, B and N. It is in that frame: n_x T + n_y B + n_z N."),
    ("result_not_unit", f"unit({SUM})", f"scale(2, {SUM})", "The result is not unit."),
    ("without_tangent", "scale(n[0], T)", "scale(0, T)", "The part along T is missing."),
    ("without_bitangent", "scale(n[1], B)", "scale(0, B)", "The part along B is missing."),
    ("along_added", "unit(sub(T, scale(dot(N, T), N)))", "unit(add(T, scale(dot(N, T), N)))",
     "The part of T along N is added: subtract it."),
]


def place(x, y):
    """The inputs of a place of the picture, or None."""
    N = ball(x, y)
    texel = [0.5 + 0.3 * math.sin(12 * x), 0.5 + 0.3 * math.sin(12 * y), 0.9]
    return N and N + [1, 0, 0] + texel if N and abs(N[0]) < 0.999 else None


def color(out, x, y):
    """What an answer looks like there."""
    return [max(0, -0.4 * out[0] + 0.5 * out[1] + 0.75 * out[2])] * 3
