"""8. Depth of a pixel."""
from .points import Case
from .tools import dot

INPUTS, OUTPUTS, TOLERANCE = "w3 z3 abc3", "1", 2e-6


def depth_at(w, z, abc):
    """z/w of the corners, mixed by abc, from -1 .. 1 to 0 .. 1."""
    mixed = abc[0] * z[0] / w[0] + abc[1] * z[1] / w[1] + abc[2] * z[2] / w[2]
    return 0.5 * mixed + 0.5


FUNCTIONS = [depth_at]


def tilted(draw):
    """Every corner at a distance of its own."""
    w = [draw.spread(0.5, 8) for _ in range(3)]
    return w + [k * draw.between(-1, 1) for k in w] + draw.weights()


def facing(draw):
    """All w the same, and not 1."""
    w = draw.spread(1.5, 8)
    return 3 * [w] + [w * draw.between(-1, 1) for _ in range(3)] + draw.weights()


def on_a_plane(draw):
    """Corners on the near plane or on the far one."""
    w, side = [draw.spread(0.5, 8) for _ in range(3)], draw.choice([-1, 1])
    return w + [side * k for k in w] + draw.weights()


CASES = [
    Case(6, "triangles that tilt away", tilted,
         "Divide z by w at each corner, mix the three quotients by abc, then bring -1 .. 1 to 0 .. "
         "1."),
    Case(2, "triangles that face the eye", facing,
         "Where all w are the same, z / w is mixed by abc; then bring -1 .. 1 to 0 .. 1."),
    Case(2, "triangles on the near or the far plane", on_a_plane,
         "The near plane, z = -w, has the depth 0; the far plane, z = w, has 1."),
]
MIXED = "abc[0] * z[0] / w[0] + abc[1] * z[1] / w[1] + abc[2] * z[2] / w[2]"
TWICE = " + ".join(f"{part} / w[{k}]" for k, part in enumerate(MIXED.split(" + ")))
OVER_W = "(abc[0] / w[0] + abc[1] / w[1] + abc[2] / w[2])"
HALF = "0.5 * mixed + 0.5"
WHOLE = "mixed = " + MIXED + "\n    return 0.5 * mixed + 0.5"
MISTAKES = [
    ("perspective", MIXED, f"({MIXED}) / {OVER_W}",
     "z/w is linear on the screen already. Dividing by the interpolated 1/w is for texture "
     "coordinates and colours."),
    ("not_divided", MIXED, "dot(abc, z)",
     "z is interpolated without its division: divide z by w at each corner first."),
    ("minus_to_plus", HALF, "mixed",
     "This runs from -1 to 1, as z/w does. The window has 0 near and 1 far: (z/w + 1) / 2."),
    ("divided_after", MIXED, "dot(abc, z) / dot(abc, w)",
     "z and w are interpolated and then divided. Neither is linear on the screen; z/w is: divide "
     "at the corners."),
    ("reversed", HALF, "0.5 - 0.5 * mixed",
     "This is 1 near and 0 far: the window has it the other way."),
    ("undivided_unmapped", WHOLE, "return dot(abc, z)",
     "This mixes z of clip space: divide by w at each corner, and bring -1 .. 1 to 0 .. 1."),
    ("centre", MIXED, "(z[0] / w[0] + z[1] / w[1] + z[2] / w[2]) / 3",
     "This is the same all over the triangle: the weights of the corners are abc."),
    ("half_alone", HALF, "0.5 * mixed", "z/w / 2 runs from -1/2 to 1/2: add 1/2."),
    ("plus_one", HALF, "mixed + 1", "z/w + 1 runs from 0 to 2: halve it."),
    ("clamped", HALF, "max(0, mixed)",
     "Depth in front of the middle is cut to 0: bring -1 .. 1 to 0 .. 1 by (z/w + 1) / 2."),
    ("distance", WHOLE, "return dot(abc, w)",
     "This mixes w, the distance from the eye. Window depth is made of z/w."),
    ("turned_weights", MIXED, "abc[1] * z[0] / w[0] + abc[2] * z[1] / w[1] + abc[0] * z[2] / w[2]",
     "The weights belong to other corners: abc[k] belongs to corner k."),
    ("other_weights", MIXED, "abc[2] * z[0] / w[0] + abc[1] * z[1] / w[1] + abc[0] * z[2] / w[2]",
     "The weights are in the reverse order: abc[k] belongs to corner k."),
    ("one_corner", MIXED, "z[0] / w[0]",
     "This is the depth of the first corner: mix all three by abc."),
    ("as_attribute", MIXED, f"({TWICE}) / {OVER_W}",
     "z/w is treated as a texture coordinate, divided by w once more. It is linear on the screen "
     "as it is: mix it by abc."),
    ("w_added", WHOLE, "return (dot(abc, z) + dot(abc, w)) / 2",
     "(z + w) / 2 is depth times w: divide by w at each corner before you mix."),
    ("inverse_w", WHOLE, f"return {OVER_W}", "This mixes 1/w. Window depth is made of z/w."),
]


def place(x, y):
    """The inputs of a place of the picture."""
    a, b = (1 - x) / 2, (1 - y) / 2 * (1 + x) / 2
    return [1, 1, 6, -1, -0.6, 5.7, a, b, 1 - a - b]


def color(out, x, y):
    """What an answer looks like there."""
    return 3 * [out[0]]
