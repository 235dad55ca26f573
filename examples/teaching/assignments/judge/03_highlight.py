"""3. H, and the lobe of Phong."""
from .points import Case
from .tools import add, ball, dot, length, pow, scale, sub, unit

INPUTS, OUTPUTS, TOLERANCE = "N3 L3 V3 n1", "H3 lobe1", 2e-5


def halfway(L, V):
    """The unit vector between L and V, zero where there is none."""
    H = add(L, V)
    if length(H) < 1e-6:
        return [0, 0, 0]
    return unit(H)


def phong(N, L, V, n):
    """B (R.V)^n."""
    R = sub(scale(2 * dot(N, L), N), L)
    cosine = max(0, dot(R, V))
    B = 1 if dot(N, L) > 0 else 0
    return B * pow(cosine, n)


FUNCTIONS = [halfway, phong]


def scene(draw, low, high, n, cosine):
    """Returns inputs with N.L between two numbers and a cosine R.V."""
    N = draw.direction()
    L = draw.at(N, draw.between(low, high))
    R = sub(scale(2 * dot(N, L), N), L)
    return N + L + draw.at(R, cosine) + [n]


def in_front(draw):
    """Viewers who see the highlight; one exponent in ten is 0."""
    n = 0 if draw.random() < 0.1 else draw.spread(0.5, 128)
    return scene(draw, 0.05, 1, n, draw.lobe(n))


def far_from_R(draw):
    """Viewers more than 90 degrees off R, with whole exponents, half of them even."""
    return scene(draw, 0.05, 1, draw.randint(1, 8), draw.between(-1, -0.3))


def behind(draw):
    """Lamps behind, viewers on both sides, exponents that let the lobe be seen; one lamp in ten is
    at the horizon, where N.L is 0 to the bit."""
    n = draw.spread(0.5, 8)
    if draw.random() < 0.9:
        return scene(draw, -1, -0.05, n, draw.lobe(n, 0.2))
    N, L, *_ = draw.axes()
    return N + L + draw.at(scale(-1, L), draw.lobe(n, 0.2)) + [n]


def opposite(draw):
    """V = -L."""
    inputs = scene(draw, 0.05, 1, 1, 0.5)
    return inputs[:6] + [-x for x in inputs[3:6]] + [1]


CASES = [
    Case(3, "H", in_front, "H is L + V, made unit: divide the sum by its length.", slice(0, 3)),
    Case(1, "H where L = -V, which is zero", opposite,
         "Where L = -V the sum is zero: return the zero vector before you divide by a "
         "length.", slice(0, 3)),
    Case(3, "the lobe, lamps in front", in_front,
         "Compute R from L and N, then R.V, then its power n, and look at each by "
         "itself.", slice(3, 4)),
    Case(1, "the lobe, viewers far from R, where R.V is negative", far_from_R,
         "A viewer more than 90 degrees off R sees no highlight: the lobe is 0.", slice(3, 4)),
    Case(2, "the lobe, lamps behind", behind,
         "B is 0 where N.L is not above 0, and so is the lobe. One lamp in ten is at the horizon, "
         "where N.L is 0.", slice(3, 4)),
]
CLAMPED = """max(0, dot(R, V))
    B = 1 if dot(N, L) > 0 else 0
    return B * pow(cosine, n)"""
MISTAKES = [
    ("not_unit", "return unit(H)", "return scale(0.5, H)",
     "(L + V) / 2 is shorter than 1, but for L = V. Divide the sum by its length."),
    ("sum_alone", "return unit(H)", "return H",
     "This is L + V itself. H is of length 1: divide the sum by its length."),
    ("unchecked", "if length(H) < 1e-6:\n        return [0, 0, 0]\n    return unit(H)",
     "return scale(1 / length(H), H)",
     "L + V is zero where L = -V, and a zero vector cannot be divided by its length: test for that "
     "first."),
    ("difference", "add(L, V)", "sub(L, V)",
     "This is L - V, which lies along the surface. Both vectors point away from it: add them."),
    ("one_of_them", "return unit(H)", "return L",
     "This is L. H lies between L and V."),
    ("ungated", "B * pow", "pow",
     "A highlight shines where the lamp is behind the surface: B is missing, which is 0 where N.L "
     "is not above 0."),
    ("gated_by_viewer", "if dot(N, L) > 0", "if dot(N, V) > 0",
     "B asks for the lamp, not for the viewer: it is 1 where N.L is above 0."),
    ("blinn", "dot(R, V)", "dot(N, unit(add(L, V)))",
     "This is Blinn's lobe, (N.H)^n. Phong's is (R.V)^n, which is narrower for the same n."),
    ("no_power", "pow(cosine, n)", "cosine",
     "This is R.V itself. Raise it to the power n, which makes the highlight small."),
    ("times_n", "pow(cosine, n)", "cosine * n",
     "n is an exponent, not a factor: powf(R.V, n), or in Python (R.V) ** n."),
    ("exchanged_power", "pow(cosine, n)", "pow(n, cosine)",
     "This is n to the power R.V. The cosine is the base, and n the exponent."),
    ("arriving", "R = sub(scale(2 * dot(N, L), N), L)", "R = sub(L, scale(2 * dot(N, L), N))",
     "R points below the surface, so the highlight is on the wrong side. R is 2 (N.L) N - L."),
    ("without_two", "scale(2 * dot", "scale(dot",
     "R is not L mirrored at N: the factor 2 is missing in 2 (N.L) N - L."),
    ("unclamped", "max(0, dot(R, V))", "dot(R, V)",
     "R.V is negative where the viewer is more than 90 degrees off R. Its power is not a number, "
     "or for an even n a second highlight: take 0 there."),
    ("absolute", "max(0, dot(R, V))", "abs(dot(R, V))",
     "The absolute value of R.V gives a second highlight opposite to R. Take 0 where R.V is "
     "negative."),
    ("lamp_for_R", "dot(R, V)", "dot(L, V)",
     "This is (L.V)^n, brightest where the viewer stands at the lamp. Mirror L first: R.V."),
    ("normal_for_R", "dot(R, V)", "dot(N, V)",
     "This is (N.V)^n, in which the place of the lamp has no part. Mirror L at N: R.V."),
    ("weighted", "B * pow(cosine, n)", "B * dot(N, L) * pow(cosine, n)",
     "The lobe is multiplied by N.L too. Phong's highlight has no such factor, only B, which is 1 "
     "or 0."),
    ("gate_at_horizon", "if dot(N, L) > 0", "if dot(N, L) >= 0",
     "B is 0 where N.L is 0 as well, for a lamp at the horizon gives no light. Compare with >, not "
     "with >=."),
    ("gated_by_both", "if dot(N, L) > 0", "if dot(N, L) > 0 and dot(N, V) > 0",
     "B is 0 here where the viewer is below the surface too. It asks for the lamp alone."),
    ("whole_power", "pow(cosine, n)", "pow(cosine, math.floor(n))",
     "n is cut to a whole number. An exponent may be any number, as powf and ** take it."),
    ("blinn_times_4", "max(0, dot(R, V))", "max(0, dot(N, unit(add(L, V)))) ** 4",
     "This is Blinn's lobe with 4 n, which looks much like Phong's and is not it: raise R.V to the "
     "power n."),
    ("mirror_exchanged", "R = sub(scale(2 * dot(N, L), N), L)",
     "R = sub(scale(2 * dot(N, L), L), N)",
     "This mirrors N at L. R is L mirrored at N, 2 (N.L) N - L."),
    ("cut_after_power", CLAMPED, CLAMPED.replace("max(0, dot(R, V))", "dot(R, V)").replace(
        "pow(cosine, n)", "max(0, pow(cosine, n))"),
     "R.V is cut off at 0 after the power, where an even n has made it positive: cut it before."),
]


def place(x, y):
    """The inputs of a place of the picture, or None."""
    N = ball(x, y)
    return N and N + [-0.48, 0.6, 0.64, 0, 0, 1, 20]


def color(out, x, y):
    """What an answer looks like there."""
    return 3 * [0.8 * out[3] + 0.1]
