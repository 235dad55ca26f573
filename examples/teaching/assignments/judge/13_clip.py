"""13. Clipping at the near plane."""
from .points import Case
from .tools import add, scale, sub

INPUTS = "corner[0]4 corner[1]4 corner[2]4"
OUTPUTS, TOLERANCE = "1 16", 1e-4


def clip_near(corners):
    """What of a triangle lies in front of the near plane, where z >= -w."""
    kept = []
    for k in range(3):
        a, b = corners[k], corners[(k + 1) % 3]
        da, db = a[2] + a[3], b[2] + b[3]
        if da >= 0:
            kept.append(a)
        if (da >= 0) != (db >= 0):
            t = da / (da - db)
            kept.append(add(a, scale(t, sub(b, a))))
    return kept


FUNCTIONS = [clip_near]


def compared(_, numbers):
    """A polygon may begin at any of its corners: it is turned to begin at that with the least x."""
    count = numbers[0]
    if not 0 < count <= 4:
        return numbers
    corners = [numbers[1 + 4 * k:5 + 4 * k] for k in range(int(count))]
    first = min(range(len(corners)), key=lambda k: corners[k:] + corners[:k])
    return [count] + [x for c in corners[first:] + corners[:first] for x in c] + [
        0.0] * (16 - 4 * len(corners))


def cut(*inside):
    """Returns what makes a triangle with corners in front of the plane, or behind."""
    def make(draw):
        signs = list(inside)
        turn = draw.randrange(3)
        signs, numbers = signs[turn:] + signs[:turn], []
        for sign in signs:
            w = draw.between(0.5, 4) if draw.random() < 0.7 or sign > 0 else draw.between(-2, -0.2)
            numbers += draw.some(-3, 3, 2) + [sign * draw.between(0.3, 2) - w, w]
        return numbers
    return make


def touching(draw):
    """A corner lies on the plane, to the bit; the others are in front of it."""
    numbers = cut(1, 1, 1)(draw)
    k = draw.randrange(3)
    numbers[4 * k + 2:4 * k + 4] = [-2.0, 2.0]
    return numbers


CASES = [
    Case(1, "all in front", cut(1, 1, 1), "Where all corners are in front the triangle stays as it is."),
    Case(1, "all behind", cut(-1, -1, -1), "Where all corners are behind nothing is left: return 0."),
    Case(3, "one corner in front", cut(1, -1, -1),
         "Of one corner in front a triangle is left: it, and a corner on each of the two edges that "
         "cross."),
    Case(4, "two corners in front", cut(1, 1, -1),
         "Of two corners in front a polygon of four is left: both, and a corner on each of the two "
         "edges that cross."),
    Case(1, "a corner on the plane, which is in front", touching,
         "A corner on the plane, where z = -w, is in front: keep it, and cut nothing there."),
]
TEST = "da, db = a[2] + a[3], b[2] + b[3]"
MISTAKES = [
    ("all_or_nothing", "            kept.append(add(a, scale(t, sub(b, a))))", "            pass",
     "Corners behind the plane are left out, and nothing takes their place: an edge that crosses the "
     "plane gives a corner there."),
    ("no_clip", "    return kept", "    return corners", "Nothing is clipped: corners with z < -w lie "
                                                         "behind the near plane."),
    ("dropped", "    return kept", "    return kept if len(kept) == 3 and all(c[2] + c[3] >= 0 for c in "
     "corners) else []", "A triangle that crosses the plane is dropped: a part of it is left."),
    ("plane_at_zero", TEST, "da, db = a[2], b[2]",
     "This clips at z = 0, as with depths from 0 to 1. Here the near plane is z = -w."),
    ("far", TEST, "da, db = a[3] - a[2], b[3] - b[2]", "This is the far plane, z <= w. Near is z >= "
                                                       "-w."),
    ("behind_kept", TEST, "da, db = -a[2] - a[3], -b[2] - b[3]",
     "What is behind the plane is kept: in front is z >= -w."),
    ("plane_of_w", TEST, "da, db = a[3], b[3]", "This clips where w is 0. The near plane is z = -w."),
    ("middle", "t = da / (da - db)", "t = 0.5",
     "The cut is in the middle of the edge: t = da / (da - db), da and db being z + w of its ends."),
    ("reversed", "t = da / (da - db)", "t = db / (db - da)",
     "t goes from the wrong end: t = da / (da - db) is 0 at a, where da is 0."),
    ("sum", "t = da / (da - db)", "t = da / (da + db)",
     "da and db have opposite signs: t = da / (da - db)."),
    ("after_divide", "t = da / (da - db)",
     "t = (a[2] / a[3] + 1) / (a[2] / a[3] - b[2] / b[3])",
     "t is taken after the division by w. Clip before it, with z + w."),
    ("w_not_cut", "kept.append(add(a, scale(t, sub(b, a))))",
     "kept.append(add(a, scale(t, sub(b, a)))[:3] + [a[3]])",
     "w is that of an end: all four coordinates are interpolated."),
    ("exclusive", "        if da >= 0:\n            kept.append(a)\n        if (da >= 0) != (db >= 0):",
     "        if da > 0:\n            kept.append(a)\n        if (da > 0) != (db > 0):",
     "A corner on the plane is in front: compare with >=."),
    ("z_set", "kept.append(add(a, scale(t, sub(b, a))))",
     "kept.append(add(a, scale(t, sub(b, a)))[:2] + [-1, 1])",
     "z and w of the new corner are set to -1 and 1: they are interpolated as x and y are."),
]


def place(x, y):
    """The inputs of a place of the picture, or None: a triangle that turns about the plane."""
    return [x, y, -1 - x, 1, x + 1, y, -1 - y, 1, x, y + 1, x + y - 1, 1]


def shown(_):
    """How many of the inputs mean something."""
    return 12


def color(out, x, y):
    """What an answer looks like there."""
    count = out[0] / 4
    return [count, 0.5 * count + 0.1 * abs(out[1]), 0.2 + 0.2 * abs(out[8])]
