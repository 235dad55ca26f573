"""1. Lambert's law."""
import math

from .points import Case
from .tools import ball, dot, length

INPUTS, OUTPUTS, TOLERANCE = "N3 L3", "1", 1e-5


def lambert(N, L):
    """The cosine between N and L, 0 where the lamp is behind."""
    return max(0, dot(N, L))


FUNCTIONS = [lambert]


def lamp(low, high):
    """Returns what makes a normal and a lamp with N.L between two numbers."""
    def make(draw):
        N = draw.direction()
        return N + draw.at(N, draw.between(low, high))
    return make


CASES = [
    Case(4, "a lamp in front of the surface", lamp(0.01, 1),
         "Where the lamp is in front, the answer is N.L: the products of the three coordinates, "
         "added. No root, no angle, no smallest light."),
    Case(2, "a lamp near the horizon", lamp(0.001, 0.1),
         "A lamp near the horizon gives little light, N.L, and nothing is added to it."),
    Case(4, "a lamp behind the surface", lamp(-1, -0.01),
         "Where the lamp is behind, N.L is negative and the answer is exactly 0."),
]
MISTAKES = [
    ("unclamped", "max(0, dot(N, L))", "dot(N, L)",
     "A lamp behind the surface cannot take light away: where N.L is negative the answer is 0."),
    ("absolute", "max(0, dot(N, L))", "abs(dot(N, L))",
     "The absolute value lights the side away from the lamp too: where N.L is negative the answer "
     "is 0."),
    ("reversed", "max(0, dot(N, L))", "max(0, -dot(N, L))",
     "This lights the side away from the lamp. L points to the lamp already, so its sign stays."),
    ("angle", "max(0, dot(N, L))", "math.acos(dot(N, L))",
     "This is the angle between N and L. The light goes with its cosine, and N.L is that cosine."),
    ("angle_in_degrees", "max(0, dot(N, L))", "math.degrees(math.acos(dot(N, L)))",
     "This is the angle between N and L in degrees. The light goes with its cosine, which is N.L."),
    ("angle_cosine_in_degrees", "dot(N, L)", "math.cos(math.degrees(math.acos(dot(N, L))))",
     "This takes the cosine of an angle in degrees; cosf and math.cos take radians. Neither is "
     "needed: N.L is the cosine."),
    ("half", "max(0, dot(N, L))", "0.5 + 0.5 * dot(N, L)",
     "(1 + N.L) / 2 lights the back of the surface too. The light that arrives is N.L, or 0."),
    ("sine", "max(0, dot(N, L))", "math.sqrt(1 - dot(N, L) ** 2)",
     "This is the sine of the angle, largest where the lamp is at the horizon. Use the cosine, "
     "N.L."),
    ("squared", "max(0, dot(N, L))", "max(0, dot(N, L)) ** 2",
     "This is the square of the cosine: the light goes with N.L itself."),
    ("all_or_nothing", "max(0, dot(N, L))", "1 if dot(N, L) > 0 else 0",
     "The side toward the lamp has one brightness: the light falls with the angle, as N.L does."),
    ("two_coordinates", "dot(N, L)", "dot(N[:2], L[:2])",
     "The product of z is missing: N.L adds the products of all three coordinates."),
    ("smallest", "max(0, dot(N, L))", "min(0, dot(N, L))",
     "This keeps the negative numbers. Take the larger of 0 and N.L."),
    ("floor", "max(0, dot(N, L))", "max(0.1, dot(N, L))",
     "The back of the surface is not black. A little light everywhere is the ambient term; N.L "
     "ends at 0."),
    ("distance", "max(0, dot(N, L))", "length([n - l for n, l in zip(N, L)])",
     "This is the distance between the tips of N and L. The light goes with N.L."),
    ("cosine_of_cosine", "dot(N, L)", "math.cos(dot(N, L))",
     "N.L is a cosine already: this takes the cosine of a cosine."),
    ("even_fall", "max(0, dot(N, L))", "max(0, 1 - math.acos(dot(N, L)) / (math.pi / 2))",
     "This falls evenly with the angle. The light falls with its cosine, N.L."),
]


def place(x, y):
    """The inputs of a place of the picture, or None."""
    N = ball(x, y)
    return N and N + [-0.6, 0.64, 0.48]


def color(out, x, y):
    """What an answer looks like there."""
    return 3 * [0.9 * out[0] + 0.05]
