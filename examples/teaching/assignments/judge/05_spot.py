"""5. Spotlight."""
import math

from .points import Case
from .tools import add, dot, length, pow, scale, unit

INPUTS, OUTPUTS, TOLERANCE = "L3 aim3 cos_cutoff1 e1", "1", 2e-5


def spot(L, aim, cos_cutoff, e):
    """(L.S)^e inside the cone, 0 outside."""
    S = scale(-1, unit(aim))
    cosine = dot(L, S)
    return pow(max(0, cosine), e) if cosine >= cos_cutoff else 0


FUNCTIONS = [spot]


def beam(draw, cosine, cos_cutoff, e):
    """Returns inputs with a cosine L.S, and an aim of any length."""
    S = draw.direction()
    return draw.at(S, cosine) + scale(-draw.spread(0.2, 5), S) + [cos_cutoff, e]


def inside(draw):
    """Points in the cone; one exponent in ten is 0."""
    e = 0 if draw.random() < 0.1 else draw.spread(0.5, 128)
    cosine = draw.lobe(e)
    return beam(draw, cosine, draw.between(0, cosine - 0.002), e)


def outside(draw):
    """Points in front of the lamp, beside the cone."""
    e = draw.spread(0.2, 3)
    cosine = draw.between(0.2, 0.97)
    return beam(draw, cosine, draw.between(cosine + 0.01, 1), e)


def wide(draw):
    """Cones of more than 90 degrees on each side, up to no cone at all; one exponent in four is 0,
    where half of the points lie behind the lamp and in the cone."""
    cos_cutoff = draw.between(-0.9, -0.1) if draw.random() < 0.7 else -1
    if draw.random() < 0.25:
        low = cos_cutoff + 0.01 if draw.random() < 0.5 else -1
        return beam(draw, draw.between(low, -0.01 if low > -1 else 0.99), cos_cutoff, 0)
    return beam(draw, draw.between(-1, 0.99), cos_cutoff, draw.randint(1, 6))


def rim(draw):
    """L.S is the cutoff to the bit: along an axis, by a power of 2."""
    cosine, sine = draw.choice([(0.6, 0.8), (0.8, 0.6), (0.28, 0.96), (0.96, 0.28)])
    L, aim, k = [0, 0, 0], [0, 0, 0], draw.randrange(3)
    L[k], L[(k + 1) % 3] = -cosine, sine
    aim[k] = draw.choice([0.5, 1, 2, 4])
    return L + aim + [cosine, draw.spread(0.5, 8)]


CASES = [
    Case(4, "inside the cone", inside,
         "Inside the cone the answer is (L.S)^e, whatever the cutoff is. S is -aim, made unit."),
    Case(2, "outside", outside,
         "Where L.S is below cos_cutoff the answer is 0. Both are cosines: compare them as they "
         "are."),
    Case(2, "wide cones", wide,
         "A cone may reach behind the lamp, where L.S is negative: take 0 for the base of the "
         "power there. 0 to the power 0 is 1."),
    Case(2, "on the rim, which is lit", rim,
         "On the rim L.S equals cos_cutoff, to the bit for these inputs, and the rim is lit."),
]
POWER = "pow(max(0, cosine), e)"
MISTAKES = [
    ("wrong_way", "scale(-1, unit(aim))", "unit(aim)",
     "L points to the lamp and aim away from it: the cosine off the axis is that of L and -aim."),
    ("aim_not_unit", "unit(aim)", "aim",
     "aim is of any length, and the cosine needs a unit vector: divide it by its length first."),
    ("no_cutoff", "if cosine >= cos_cutoff else 0", "",
     "The cone is not cut: where L.S is below cos_cutoff the answer is 0."),
    ("exclusive", "cosine >= cos_cutoff", "cosine > cos_cutoff",
     "The rim itself is lit: compare with >=, not with >."),
    ("no_exponent", POWER, "1",
     "The light is the same everywhere in the cone: it is L.S to the power e."),
    ("without_e", POWER, "max(0, cosine)",
     "This is L.S itself, as for e = 1: raise it to the power e."),
    ("times_e", POWER, "e * max(0, cosine)", "e is an exponent, not a factor: (L.S)^e."),
    ("inverted", "cosine >= cos_cutoff", "cosine < cos_cutoff",
     "The light is outside of the cone. A small angle has a large cosine, so inside is where L.S "
     "is at least cos_cutoff."),
    ("exchanged_power", POWER, "pow(e, max(0, cosine))", "This is e to the power L.S: exchange the "
                                                         "two."),
    ("faded_to_rim", POWER, "pow((cosine - cos_cutoff) / (1 - cos_cutoff), e)",
     "This fades to 0 at the rim. Here the cutoff only cuts; the light falls as (L.S)^e."),
    ("cut_after_power", "cosine >= cos_cutoff", "pow(max(0, cosine), e) >= cos_cutoff",
     "The power is compared with cos_cutoff. Compare L.S itself, before it is raised to e."),
    ("angle_with_cosine", "cosine >= cos_cutoff", "math.acos(max(-1, min(1, cosine))) <= "
                                                  "cos_cutoff",
     "An angle is compared with a cosine. cos_cutoff is the cosine of the cutoff already: compare "
     "L.S with it."),
    ("angle_in_power", POWER, "pow(math.acos(max(-1, min(1, cosine))), e)",
     "The angle is raised to e. The light falls with its cosine: (L.S)^e."),
    ("unclamped", POWER, "pow(cosine, e)",
     "Behind the lamp L.S is negative, and a wide cone reaches there: take 0 for the base of the "
     "power."),
    ("dark_behind", POWER, "(pow(cosine, e) if cosine > 0 else 0)",
     "Behind the lamp, where L.S is negative, a wide cone with e = 0 is lit too: 0 to the power 0 is "
     "1."),
    ("absolute", "cosine = dot(L, S)", "cosine = abs(dot(L, S))",
     "The absolute value gives a second cone behind the lamp: use L.S with its sign."),
    ("cosine_of_cutoff", "cosine >= cos_cutoff", "cosine >= math.cos(cos_cutoff)",
     "cos_cutoff is a cosine already: this takes the cosine of a cosine."),
    ("divided_by_square", "unit(aim)", "scale(1 / dot(aim, aim), aim)",
     "aim is divided by the square of its length: the root is missing."),
    ("less_cutoff", POWER, "pow(cosine - cos_cutoff, e)",
     "cos_cutoff is subtracted before the power. It only cuts: the light falls as (L.S)^e."),
    ("held_at_rim", POWER + " if cosine >= cos_cutoff else 0", "pow(max(0, cosine, cos_cutoff), e)",
     "Outside of the cone the light is as bright as at its rim: there the answer is 0."),
]


def place(x, y):
    """The inputs of a place of the picture, or None."""
    L = unit([-x, -y, 1.6])
    return L + [0, 0, -3, 0.9, 12] if abs(L[2] - 0.9) > 1e-5 else None


def color(out, x, y):
    """What an answer looks like there."""
    return 3 * [out[0]]
