"""11. Colours in a triangle."""
import math

from .points import Case
from .tools import add, scale

INPUTS = "x3 y3 color[0]3 color[1]3 color[2]3 px1 py1"
OUTPUTS, TOLERANCE = "3", 1e-4
PARTS = ["red", "green", "blue"]


def color_at(x, y, color, px, py):
    """The colour of a place: alpha, beta and gamma of the three corners."""
    whole = (x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0])
    alpha = ((x[1] - px) * (y[2] - py) - (x[2] - px) * (y[1] - py)) / whole
    beta = ((x[2] - px) * (y[0] - py) - (x[0] - px) * (y[2] - py)) / whole
    gamma = ((x[0] - px) * (y[1] - py) - (x[1] - px) * (y[0] - py)) / whole
    return add(add(scale(alpha, color[0]), scale(beta, color[1])), scale(gamma, color[2]))


FUNCTIONS = [color_at]


def triangle(draw, turn, weights):
    """Returns corners that go round one way, three colours, and the place with some weights."""
    while True:
        x, y = draw.some(0, 64, 3), draw.some(0, 64, 3)
        whole = (x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0])
        if turn * whole > 200:
            break
    place = [sum(w * c for w, c in zip(weights, of)) for of in (x, y)]
    return x + y + draw.some(0, 1, 9) + place


def edge(draw):
    """Places on an edge, and at a corner one in three times."""
    t, k = draw.between(0.1, 0.9) if draw.random() < 0.7 else 1, draw.randrange(3)
    weights = [t, 1 - t, 0]
    return triangle(draw, draw.choice([-1, 1]), weights[k:] + weights[:k])


CASES = [
    Case(5, "inside", lambda draw: triangle(draw, 1, draw.weights()),
         "alpha belongs to the first corner: it is the area of the triangle of the place and the "
         "other two corners, over the area of the whole."),
    Case(2, "on an edge or a corner", edge,
         "At a corner the answer is its colour, and on an edge the third corner has no share."),
    Case(3, "corners the other way round", lambda draw: triangle(draw, -1, draw.weights()),
         "Where the corners go round the other way all areas change their sign, and their quotients "
         "do not."),
]
WEIGHTS = "return add(add(scale(alpha, color[0]), scale(beta, color[1])), scale(gamma, color[2]))"
MISTAKES = [
    ("corner_before", WEIGHTS, WEIGHTS.replace("[0]", "[3]").replace("[1]", "[0]").replace(
        "[2]", "[1]").replace("[3]", "[2]"),
     "Each weight has gone to the corner before its own: alpha is the area across from corner 0."),
    ("next_corner", WEIGHTS, WEIGHTS.replace("[0]", "[3]").replace("[2]", "[0]").replace(
        "[1]", "[2]").replace("[3]", "[1]"),
     "Each weight has gone to the corner after its own: alpha is the area across from corner 0."),
    ("exchanged", WEIGHTS, WEIGHTS.replace("[0]", "[3]").replace("[1]", "[0]").replace("[3]", "[1]"),
     "alpha and beta are exchanged: alpha is 1 at corner 0, beta at corner 1."),
    ("not_divided", "    alpha", "    whole = 1\n    alpha",
     "The areas are not divided by that of the whole triangle: the three weights add up to 1."),
    ("half_area", "    alpha", "    whole = whole / 2\n    alpha",
     "Edge functions are twice an area. Divide them by that of the whole triangle, not by half of "
     "it."),
    ("absolute", "    alpha", "    whole = abs(whole)\n    alpha",
     "The area of the whole has lost its sign. Keep it: the sign of each part is the same, and "
     "cancels."),
    ("mean", WEIGHTS, "return scale(1 / 3, add(add(color[0], color[1]), color[2]))",
     "This is the mean of the three colours, everywhere: weigh them by areas."),
    ("flat", WEIGHTS, "return color[0]", "This is the colour of the first corner, everywhere."),
    ("gamma_without_beta", "    return add", "    gamma = 1 - alpha\n    return add",
     "gamma is 1 - alpha - beta: beta is missing."),
    ("two_corners", WEIGHTS, "return add(scale(alpha, color[0]), scale(1 - alpha, color[1]))",
     "The third corner has no share: alpha, beta and gamma have a colour each."),
    ("distances", WEIGHTS, "d = [1 / max(1e-6, math.hypot(x[k] - px, y[k] - py)) for k in range(3)]\n"
     "    return scale(1 / sum(d), add(add(scale(d[0], color[0]), scale(d[1], color[1])), "
     "scale(d[2], color[2])))",
     "The weights are reciprocal distances to the corners. Barycentric weights are areas: they are "
     "linear over the triangle."),
    ("nearest", WEIGHTS, "return color[max(range(3), key=[alpha, beta, gamma].__getitem__)]",
     "This is the colour of one corner. Add the three, each times its weight."),
    ("smooth", "    return add", "    alpha, beta = [t * t * (3 - 2 * t) for t in (alpha, beta)]\n"
     "    gamma = 1 - alpha - beta\n    return add",
     "The weights are smoothed. They are the areas themselves, linear over the triangle."),
    ("exchanged_xy", "    whole", "    px, py = py, px\n    whole", "px and py are exchanged."),
]


def place(x, y):
    """The inputs of a place of the picture, or None."""
    corners = [-0.9, 0.9, 0.1, -0.8, -0.6, 0.9]
    a, b = corners[:3], corners[3:]
    sides = [(a[(k + 1) % 3] - a[k]) * (y - b[k]) - (b[(k + 1) % 3] - b[k]) * (x - a[k])
             for k in range(3)]
    return corners + [1, 0, 0, 0, 1, 0, 0, 0, 1, x, y] if min(sides) > 0 else None


def color(out, x, y):
    """What an answer looks like there."""
    return out
