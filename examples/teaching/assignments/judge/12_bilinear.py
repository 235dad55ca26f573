"""12. Bilinear filter and level of detail."""
import math

from .points import Case

INPUTS = ("du_dx1 dv_dx1 du_dy1 dv_dy1 size1 texel[0]4 texel[4]4 texel[8]4 texel[12]4 u1 v1")
OUTPUTS, TOLERANCE = "1 1", 1e-4
PARTS = ["the level", "the texel"]


def level(du_dx, dv_dx, du_dy, dv_dy, size):
    """log2 of the texels that a step of one pixel crosses, from 0 to the last level."""
    along_x = size * math.sqrt(du_dx * du_dx + dv_dx * dv_dx)
    along_y = size * math.sqrt(du_dy * du_dy + dv_dy * dv_dy)
    rho = max(along_x, along_y)
    return min(max(0, math.log2(rho)), math.log2(size))


def bilinear(texel, u, v):
    """The mean of the four nearest texels, weighted; the map repeats."""
    x, y = 4 * u - 0.5, 4 * v - 0.5
    i, j = math.floor(x), math.floor(y)
    s, t = x - i, y - j
    a, b = texel[4 * (j % 4) + i % 4], texel[4 * (j % 4) + (i + 1) % 4]
    c, d = texel[4 * ((j + 1) % 4) + i % 4], texel[4 * ((j + 1) % 4) + (i + 1) % 4]
    return (1 - t) * ((1 - s) * a + s * b) + t * ((1 - s) * c + s * d)


FUNCTIONS = [level, bilinear]


def both(draw, low, high, inside):
    """Returns a step of some texels, and a place of the map: inside of it, or across its border."""
    size, rho = draw.choice([4, 16, 64, 256]), draw.spread(low, high)
    steps = [rho, rho * draw.between(0.1, 0.9)]
    draw.shuffle(steps)
    given = []
    for step in steps:
        turn = draw.between(0, 2 * math.pi)
        given += [step * math.cos(turn) / size, step * math.sin(turn) / size]
    at = draw.some(0.13, 0.87, 2) if inside else [
        draw.choice([draw.between(-1.9, 0.12), draw.between(0.88, 2.9)]), draw.between(-2, 3)]
    return given + [size] + draw.some(0, 1, 16) + at


LEVEL, TEXEL = slice(0, 1), slice(1, 2)
CASES = [
    Case(3, "the level of a smaller picture", lambda d: both(d, 1.1, 3.9, True),
         "A step of one pixel in x crosses size |(du/dx, dv/dx)| texels, one in y size |(du/dy, "
         "dv/dy)|. The level is log2 of the larger.", LEVEL),
    Case(1, "the level of a larger picture", lambda d: both(d, 0.02, 0.9, True),
         "Where a pixel is smaller than a texel the level is 0, the map itself.", LEVEL),
    Case(1, "the last level", lambda d: both(d, 300, 3000, True),
         "The last level, log2 of size, has one texel: there is none beyond it.", LEVEL),
    Case(3, "inside the map", lambda d: both(d, 1, 9, True),
         "Texel i has its centre at (i + .5) / 4. Take the four centres around (u, v), and weigh "
         "them by how near they are.", TEXEL),
    Case(2, "across its border", lambda d: both(d, 1, 9, False),
         "The map repeats: column -1 is column 3, column 4 is column 0, rows as well.", TEXEL),
]
LIMITS = "min(max(0, math.log2(rho)), math.log2(size))"
MIX = "(1 - t) * ((1 - s) * a + s * b) + t * ((1 - s) * c + s * d)"
MISTAKES = [
    ("smaller_step", "rho = max(", "rho = min(", "The smaller step is taken: the map would flicker "
                                                 "along the larger. Take the larger."),
    ("mean_of_steps", "max(along_x, along_y)", "(along_x + along_y) / 2",
     "This is the mean of the two steps. Take the larger."),
    ("area", "max(along_x, along_y)", "math.sqrt(along_x * along_y)",
     "The two steps are multiplied. Take the larger."),
    ("only_x", "max(along_x, along_y)", "along_x", "Only the step in x counts here: take the larger "
                                                   "of both."),
    ("only_y", "max(along_x, along_y)", "along_y", "Only the step in y counts here: take the larger "
                                                   "of both."),
    ("sum_of_steps", "max(along_x, along_y)", "math.hypot(along_x, along_y)",
     "This is the length of both steps together. Take the larger of the two."),
    ("columns_of_steps", "along_x = size * math.sqrt(du_dx * du_dx + dv_dx * dv_dx)\n"
     "    along_y = size * math.sqrt(du_dy * du_dy + dv_dy * dv_dy)",
     "along_x = size * math.sqrt(du_dx * du_dx + du_dy * du_dy)\n"
     "    along_y = size * math.sqrt(dv_dx * dv_dx + dv_dy * dv_dy)",
     "The derivatives are paired by u and v. A step in x has du/dx and dv/dx, one in y has the "
     "others."),
    ("without_size", "along_x = size * math.sqrt(du_dx * du_dx + dv_dx * dv_dx)\n"
     "    along_y = size * ", "along_x = math.sqrt(du_dx * du_dx + dv_dx * dv_dx)\n    along_y = ",
     "u and v go from 0 to 1 over the map: times size they are texels."),
    ("natural", LIMITS, "min(max(0, math.log(rho)), math.log2(size))",
     "This is the natural logarithm. Each level is half as large: log2."),
    ("no_logarithm", LIMITS, "min(max(0, rho), math.log2(size))",
     "This is the number of texels itself: the level is its log2."),
    ("not_below", LIMITS, "min(math.log2(rho), math.log2(size))",
     "A level below 0 does not exist: take 0."),
    ("not_beyond", LIMITS, "max(0, math.log2(rho))",
     "There is no level beyond log2 of size, which has one texel."),
    ("one_too_many", "math.log2(size))", "math.log2(size) + 1)",
     "The last level is log2 of size: a map of 4 x 4 has the levels 0, 1 and 2."),
    ("size_as_last", "math.log2(size))", "size)",
     "The last level is log2 of size, not size."),
    ("squared_step", LIMITS, "min(max(0, 2 * math.log2(rho)), math.log2(size))",
     "The level is twice as large: the root of du^2 + dv^2 is missing."),
    ("halved_level", LIMITS, "min(max(0, 0.5 * math.log2(rho)), math.log2(size))",
     "The level is half as large: a root too many."),
    ("whole_level", LIMITS, "math.floor(min(max(0, math.log2(rho)), math.log2(size)))",
     "The level is cut to a whole number. It has a fraction: two levels are mixed by it."),
    ("rounded_level", LIMITS, "math.floor(min(max(0, math.log2(rho)), math.log2(size)) + 0.5)",
     "The level is rounded. It has a fraction: two levels are mixed by it."),
    ("nearest", MIX, "(d if s >= 0.5 and t >= 0.5 else b if s >= 0.5 else c if t >= 0.5 else a)",
     "This is the nearest texel. Mix the four around the place."),
    ("no_half", "4 * u - 0.5, 4 * v - 0.5", "4 * u, 4 * v",
     "Centres of texels lie at (i + .5) / 4: the half is missing, and the map is shifted."),
    ("half_added", "4 * u - 0.5, 4 * v - 0.5", "4 * u + 0.5, 4 * v + 0.5",
     "Half a texel is added. Subtract it: texel 0 has its centre at x = .5."),
    ("times_three", "4 * u - 0.5, 4 * v - 0.5", "3 * u, 3 * v",
     "u is multiplied by 3: u = 0 and u = 1 are the outer sides of texels, not their centres."),
    ("exchanged_weights", "s, t = x - i, y - j", "s, t = y - j, x - i", "s and t are exchanged."),
    ("reversed_weights", "s, t = x - i, y - j", "s, t = i + 1 - x, j + 1 - y",
     "The weights are reversed: at s = 0 all of the left texel counts."),
    ("only_in_u", MIX, "(1 - s) * a + s * b", "This mixes two texels of a row: mix the row below as "
                                              "well, by t."),
    ("only_in_v", MIX, "(1 - t) * a + t * c", "This mixes two texels of a column: mix the column "
                                              "beside it as well, by s."),
    ("mean", MIX, "(a + b + c + d) / 4", "The four texels count alike: weigh them by s and t."),
    ("by_columns", "4 * (j % 4) + i % 4], texel[4 * (j % 4) + (i + 1) % 4]\n"
     "    c, d = texel[4 * ((j + 1) % 4) + i % 4], texel[4 * ((j + 1) % 4) + (i + 1) % 4]",
     "4 * (i % 4) + j % 4], texel[4 * ((i + 1) % 4) + j % 4]\n"
     "    c, d = texel[4 * (i % 4) + (j + 1) % 4], texel[4 * ((i + 1) % 4) + (j + 1) % 4]",
     "Rows and columns of the map are exchanged: texel[4 j + i] is column i of row j."),
    ("upside_down", "x, y = 4 * u - 0.5, 4 * v - 0.5", "x, y = 4 * u - 0.5, 4 * (1 - v) - 0.5",
     "The map is upside down: v is 0 at row 0."),
    ("clamped", "    i, j = math.floor(x), math.floor(y)",
     "    x, y = min(max(x, 0), 3), min(max(y, 0), 3)\n    i, j = math.floor(x), math.floor(y)",
     "The border of the map goes on and on. It repeats here: column 4 is column 0."),
    ("truncated", "i, j = math.floor(x), math.floor(y)", "i, j = int(x), int(y)",
     "An int cuts towards 0: floor(-0.3) is -1."),
    ("half_wrapped", "    i, j = ", "    x, y = min(x % 4, 3), min(y % 4, 3)\n    i, j = ",
     "Between the last texel and the first of the map the two are mixed as well."),
]


def place(x, y):
    """The inputs of a place of the picture."""
    map_ = [1, 0, 0.5, 0, 0, 1, 0, 0.5, 0.5, 0, 1, 0, 0, 0.5, 0, 1]
    return [0.3 + 0.25 * x, 0, 0, 0.1, 4] + map_ + [(x + 1) * 0.75, (y + 1) * 0.75]


def color(out, x, y):
    """What an answer looks like there."""
    return [out[1], out[1], 0.5 * out[0]]
