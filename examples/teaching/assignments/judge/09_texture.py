"""9. Texture coordinates in perspective."""
from .points import Case
from .tools import dot

INPUTS, OUTPUTS, TOLERANCE = "w3 uv[0]2 uv[1]2 uv[2]2 abc3", "2", 1e-5
PARTS = "uv"


def texture_at(w, uv, abc):
    """u/w and v/w over 1/w, each mixed by abc."""
    weight = [a / k for a, k in zip(abc, w)]
    u = sum(g * t[0] for g, t in zip(weight, uv))
    v = sum(g * t[1] for g, t in zip(weight, uv))
    whole = sum(weight)
    return [u / whole, v / whole]


FUNCTIONS = [texture_at]


def tilted(draw):
    """Every corner at a distance of its own; u and v go beyond 0 .. 1."""
    return [draw.spread(0.5, 8) for _ in range(3)] + draw.some(-1, 2, 6) + draw.weights()


def facing(draw):
    """All w the same, and not 1."""
    return 3 * [draw.spread(1.5, 8)] + draw.some(-1, 2, 6) + draw.weights()


def at_a_corner(draw):
    """abc is 1 for one corner."""
    abc = draw.sample([1, 0, 0], 3)
    return tilted(draw)[:9] + abc


CASES = [
    Case(6, "triangles that tilt away", tilted,
         "Mix u/w, v/w and 1/w by abc, each by itself, then divide the first two by the third."),
    Case(2, "triangles that face the eye", facing,
         "Where all w are the same they cancel: u and v are mixed by abc."),
    Case(2, "at a corner", at_a_corner, "At a corner the answer is the u and v of that corner."),
]
WEIGHT, RETURN = "[a / k for a, k in zip(abc, w)]", "[u / whole, v / whole]"
MISTAKES = [
    ("affine", WEIGHT, "abc",
     "This is linear on the screen, so textures swim where a triangle tilts: interpolate u/w, v/w "
     "and 1/w, then divide."),
    ("not_divided", RETURN, "[u, v]",
     "u/w and v/w are interpolated, but not divided by the interpolated 1/w."),
    ("times_w", WEIGHT, "[a * k for a, k in zip(abc, w)]",
     "The corners are multiplied by w: divide them by w."),
    ("times_mean_w", RETURN, "[u * dot(abc, w), v * dot(abc, w)]",
     "w is not linear on the screen, 1/w is: divide by the interpolated 1/w, do not multiply by an "
     "interpolated w."),
    ("over_mean_w", RETURN, "[u / dot(abc, w), v / dot(abc, w)]",
     "u/w and v/w are divided by an interpolated w: divide them by the interpolated 1/w."),
    ("nearest_corner", RETURN, "uv[abc.index(max(abc))]",
     "This is the texture coordinate of one corner: mix all three."),
    ("v_up", RETURN, "[u / whole, 1 - v / whole]",
     "v is turned upside down. Nothing here says which way pictures lie: return v as it is mixed."),
    ("exchanged", RETURN, "[v / whole, u / whole]",
     "u and v are exchanged: return u first."),
    ("wrapped", RETURN, "[u / whole % 1, v / whole % 1]",
     "The coordinates are wrapped to 0 .. 1. That is the work of the texture: return them as they "
     "are."),
    ("clamped", RETURN, "[max(0, min(1, u / whole)), max(0, min(1, v / whole))]",
     "The coordinates are cut to 0 .. 1. That is the work of the texture: return them as they "
     "are."),
    ("centre", WEIGHT, "[1 / k for k in w]",
     "This is the same all over the triangle: the weights of the corners are abc."),
    ("w_squared", WEIGHT, "[a / (k * k) for a, k in zip(abc, w)]",
     "The corners are divided by w twice: divide u, v and 1 by w once."),
    ("other_weights", WEIGHT, "[a / k for a, k in zip(abc[::-1], w)]",
     "The weights are in the reverse order: abc[k] belongs to corner k."),
    ("turned_weights", WEIGHT, "[a / k for a, k in zip(abc[1:] + abc[:1], w)]",
     "The weights belong to other corners: abc[k] belongs to corner k."),
    ("u_alone", RETURN, "[u / whole, sum(a * t[1] for a, t in zip(abc, uv))]",
     "u is in perspective and v is linear on the screen: v needs the same."),
    ("turned_corners", "zip(weight, uv)", "zip(weight, uv[1:] + uv[:1])",
     "uv belongs to other corners: uv[k] goes with w[k] and abc[k]."),
    ("u_twice", "t[1]", "t[0]",
     "v is made of the u of the corners: take the second number of uv[k]."),
    ("u_turned", RETURN, "[1 - u / whole, v / whole]",
     "u is turned round: return it as it is mixed."),
    ("w_alone", "whole = sum(weight)", "whole = sum(1 / k for k in w)",
     "1/w is added up without abc: mix it by abc, as u/w and v/w are."),
]


def place(x, y):
    """The inputs of a place of the picture."""
    c = (y + 1) / 2
    b = (1 - c) * (x + 1) / 2
    return [1, 1, 5, 0, 0, 1, 0, 0.5, 1, 1 - b - c, b, c]


def color(out, x, y):
    """What an answer looks like there."""
    return [out[0], out[1], 0]
