"""2. The mirrored vector."""
from .points import Case
from .tools import add, ball, cross, dot, mul, scale, sub, unit

INPUTS, OUTPUTS, TOLERANCE = "L3 N3", "3", 1e-5


def mirror(L, N):
    """L on the other side of N."""
    return sub(scale(2 * dot(N, L), N), L)


FUNCTIONS = [mirror]


def lamp(low, high):
    """Returns what makes a lamp and a normal with N.L between two numbers."""
    def make(draw):
        N = draw.direction()
        return draw.at(N, draw.between(low, high)) + N
    return make


CASES = [
    Case(5, "lamps in front", lamp(0.1, 0.99),
         "The part of L along N is (N.L) N. The mirror keeps it, and turns round what is left "
         "over, L - (N.L) N."),
    Case(3, "lamps near the horizon", lamp(0.001, 0.1),
         "With the lamp near the horizon L and R are almost opposite. R = 2 (N.L) N - L has the "
         "length 1 without a normalize."),
    Case(2, "lamps behind the surface", lamp(-0.99, -0.1),
         "The formula holds for a lamp behind too: R is behind as well. Nothing is cut off at 0."),
]
RIGHT = "sub(scale(2 * dot(N, L), N), L)"
MISTAKES = [
    ("as_printed", RIGHT, "sub(L, scale(2 * dot(N, L), N))",
     "This points to the other side of the surface. L - 2 (N.L) N mirrors a vector that arrives, "
     "and L points away; R is its negative."),
    ("without_two", "2 * dot", "dot",
     "The way from L to R is twice the way from L to N: the factor 2 before (N.L) N is missing."),
    ("plus", RIGHT, "add(scale(2 * dot(N, L), N), L)",
     "L and R add up to 2 (N.L) N, so L is subtracted from it, not added."),
    ("exchanged", RIGHT, "sub(scale(2 * dot(N, L), L), N)",
     "This mirrors N at L. The function takes L first, then N, and mirrors L at N."),
    ("no_cosine", "2 * dot(N, L)", "2",
     "2 N - L takes all of N. Take only as much of N as L has along it, which is N.L."),
    ("half", RIGHT, "unit(add(N, L))",
     "This is halfway between L and N. N is the one halfway, between L and R."),
    ("negated", RIGHT, "scale(-1, L)",
     "This sends the light straight on through the surface: turn only what lies along the "
     "surface."),
    ("not_subtracted", RIGHT, "scale(2 * dot(N, L), N)",
     "2 (N.L) N is L + R: subtract L from it."),
    ("unchanged", RIGHT, "L",
     "This is L itself: R lies on the other side of N."),
    ("normal", RIGHT, "N",
     "This is N. N is halfway between L and R; R is as far from N as L is."),
    ("by_coordinates", "scale(2 * dot(N, L), N)", "scale(2, mul(mul(N, L), N))",
     "N.L is one number, the sum of three products. This multiplies the coordinates of N and L "
     "without adding them up."),
    ("by_cross", "scale(2 * dot(N, L), N)", "scale(2, cross(N, L))",
     "This has the cross product N x L, which stands at right angles to L and N. R lies in their "
     "plane: use the dot product."),
    ("clamped", "dot(N, L)", "max(0, dot(N, L))",
     "N.L is cut off at 0. A lamp behind the surface has its mirror direction too, by the same "
     "formula."),
    ("absolute", "dot(N, L)", "abs(dot(N, L))",
     "The absolute value of N.L brings R to the front for a lamp behind. Leave the sign as it is."),
    ("zero_behind", "    return ", "    if dot(N, L) < 0:\n        return [0, 0, 0]\n    return ",
     "A lamp behind the surface gets the zero vector here. It has its mirror direction too, by the "
     "same formula."),
    ("about_z", RIGHT, "[-L[0], -L[1], L[2]]",
     "This turns x and y round, which is right where N is the z axis alone. N is any direction: R "
     "is 2 (N.L) N - L."),
    ("two_normals", RIGHT, "unit(sub(scale(2, N), L))",
     "2 N - L has another direction than R, and to make it unit does not help. Take only as much "
     "of N as L has along it, (N.L) N."),
    ("both_doubled", RIGHT, "scale(2, sub(scale(dot(N, L), N), L))",
     "L is doubled too: the factor 2 stands before (N.L) N alone."),
]


def terms(_, inputs):
    """Returns what an answer may have too much or too little of, and what to say then."""
    return [(inputs[3:6], "All is right but how much of N it has: 2 (N.L) of it, and once."),
            (inputs[0:3], "All is right but how much of L it has: L is subtracted once.")]


def place(x, y):
    """The inputs of a place of the picture, or None."""
    N = ball(x, y)
    return N and [-0.6, 0.64, 0.48] + N


def color(out, x, y):
    """What an answer looks like there."""
    return [0.5 * r + 0.5 for r in out]
