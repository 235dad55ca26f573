"""4. Attenuation."""
import math

from .points import Case

INPUTS, OUTPUTS, TOLERANCE = "a1 b1 c1 r1", "1", 1e-5


def attenuation(a, b, c, r):
    """1 over a polynomial of the distance."""
    return 1 / (a + b * r + c * r * r)


FUNCTIONS = [attenuation]


def any_coefficients(draw):
    """No coefficient is 0 or 1."""
    return [draw.spread(0.15, 4) for _ in range(3)] + [draw.spread(0.2, 10)]


def alone(draw):
    """One coefficient is above 0, the next one in turn."""
    inputs, k = any_coefficients(draw), draw.randrange(3)
    return [x if i in (k, 3) else 0 for i, x in enumerate(inputs)]


CASES = [
    Case(5, "any coefficients", any_coefficients,
         "Compute the sum a + b r + c r^2 first, in brackets, then divide 1 by it."),
    Case(3, "one coefficient alone", alone,
         "With one coefficient above 0 the answer is 1 / a, 1 / (b r) or 1 / (c r^2)."),
    Case(2, "r = 0, where the lamp is", lambda draw: any_coefficients(draw)[:3] + [0],
         "Where r is 0 the sum is a alone, and the answer 1 / a."),
]
RIGHT, SUM = "1 / (a + b * r + c * r * r)", "(a + b * r + c * r * r)"
MISTAKES = [
    ("squared_alone", RIGHT, "1 / (r * r)",
     "This is 1 / r^2 whatever a, b and c are. The whole factor is 1 / (a + b r + c r^2)."),
    ("without_constant", "a + b * r", "b * r",
     "The coefficient a is missing: it keeps the light finite near the lamp."),
    ("constant_is_one", "a + b * r", "1 + b * r",
     "The constant of the sum is 1 here whatever a is: use a."),
    ("without_linear", "b * r + ", "",
     "The part b r is missing: the sum is a + b r + c r^2."),
    ("without_square", " + c * r * r", "",
     "The part c r^2 is missing: the sum is a + b r + c r^2."),
    ("c_alone", SUM, "(c * r * r)",
     "This is 1 / (c r^2): a and b r are missing from the sum."),
    ("one_and_square", SUM, "(1 + c * r * r)",
     "This is 1 / (1 + c r^2), as for a = 1 and b = 0. Use a and b as they are given."),
    ("not_squared", "c * r * r", "c * r", "c belongs to the square of r: c * r * r."),
    ("cubed", "c * r * r", "c * r * r * r", "c is multiplied by r^3: it belongs to r^2."),
    ("not_inverted", RIGHT, SUM, "This grows with the distance: divide 1 by the sum."),
    ("each_inverted", RIGHT, "1 / a + 1 / (b * r) + 1 / (c * r * r)",
     "Only the sum is inverted: 1 / (a + b r + c r^2) is not 1/a + 1/(b r) + 1/(c r^2)."),
    ("no_brackets", RIGHT, "1 / a + b * r + c * r * r",
     "Without brackets only a is below the 1: write 1 / (a + b r + c r^2)."),
    ("coefficient_squared", "c * r * r", "(c * r) * (c * r)", "(c r)^2 squares c as well: square r "
                                                              "alone."),
    ("other_order", SUM, "(a * r * r + b * r + c)",
     "The coefficients are in the other order: a stands alone, and c before r^2."),
    ("doubled", "c * r * r", "c * 2 * r", "r^2 is r times r; this is 2 r."),
    ("at_most_one", RIGHT, "1 / max(1, a + b * r + c * r * r)",
     "The factor is above 1 where a + b r + c r^2 is below 1. Nothing cuts it."),
    ("root", RIGHT, "1 / math.sqrt(a + b * r + c * r * r)",
     "This is the root of the factor: divide 1 by the sum itself."),
    ("squared_sum", RIGHT, "1 / (a + b * r + c * r * r) ** 2",
     "This is the square of the factor: divide 1 by the sum once."),
    ("exchanged", SUM, "(a + c * r + b * r * r)",
     "b and c are exchanged: b stands before r, c before r^2."),
    ("one_added", SUM, "(1 + a + b * r + c * r * r)",
     "A 1 is added below the line: the sum is a + b r + c r^2."),
    ("multiplied", SUM, "(a * b * r * c * r * r)",
     "The three parts are multiplied: add them, a + b r + c r^2."),
    ("higher_powers", SUM, "(a * r + b * r * r + c * r * r * r)",
     "Each power is one too high: a stands alone, b before r, c before r^2."),
    ("one_at_lamp", "    return 1", "    if r == 0:\n        return 1\n    return 1",
     "Where r is 0 the answer is 1 / a, and not always 1."),
]


def place(x, y):
    """The inputs of a place of the picture."""
    return [0.6, 0.4, 3, math.hypot(x, y)]


def color(out, x, y):
    """What an answer looks like there."""
    return 3 * [0.55 * out[0]]
