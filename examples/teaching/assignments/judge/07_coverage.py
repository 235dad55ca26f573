"""7. Edge functions and the top-left rule."""
from .points import Case

INPUTS, OUTPUTS, TOLERANCE = "x3 y3", "64", 0


def covers(x, y, i, j):
    """1 where all edge functions say inside, by the top-left rule."""
    px, py = 256 * i + 128, 256 * j + 128
    area = (x[1] - x[0]) * (y[2] - y[0]) - (y[1] - y[0]) * (x[2] - x[0])
    if area == 0:
        return 0
    turn = 1 if area > 0 else -1
    for k in range(3):
        n = (k + 1) % 3
        dx, dy = turn * (x[n] - x[k]), turn * (y[n] - y[k])
        edge = dx * (py - y[k]) - dy * (px - x[k])
        top, left = dy == 0 and dx > 0, dy < 0
        if edge < 0 or edge == 0 and not (top or left):
            return 0
    return 1


FUNCTIONS = [covers]


def anywhere(draw):
    """Corners anywhere, of both windings; large enough to cover pixels.  One triangle in ten has a
    corner at (0, 0), where answers in pixels show."""
    while True:
        v = [draw.randint(0, 2048) for _ in range(6)]
        if draw.random() < 0.1:
            v[0] = v[3] = 0
        if abs((v[1] - v[0]) * (v[5] - v[3]) - (v[4] - v[3]) * (v[2] - v[0])) > 400000:
            return v


def on_centres(draw):
    """Corners on pixel centres, so that many pixels lie on edges."""
    while True:
        v = [256 * draw.randint(0, 7) + 128 for _ in range(6)]
        if abs((v[1] - v[0]) * (v[5] - v[3]) - (v[4] - v[3]) * (v[2] - v[0])) > 400000:
            return v


def no_area(draw):
    """Three corners in a line, on pixel centres."""
    x, y, dx, dy = (draw.randint(0, 3) for _ in range(4))
    steps = draw.sample([0, 1, 2], 3)
    return [256 * (x + k * dx) + 128 for k in steps] + [256 * (y + k * dy) + 128 for k in steps]


CASES = [
    Case(5, "triangles anywhere, of both windings", anywhere,
         "Compute the three edge functions at the centre of the pixel: inside, they all have the "
         "sign of the area."),
    Case(4, "pixel centres on edges", on_centres,
         "Where an edge function is 0 the pixel belongs to the triangle only if the edge is a top "
         "or a left one; at a corner both edges must be."),
    Case(1, "triangles without area", no_area,
         "With the corners in a line the area is 0, and the triangle covers nothing."),
]
CENTRE, RULE = "256 * i + 128, 256 * j + 128", "dy == 0 and dx > 0, dy < 0"
UNITS = ("i and j count pixels, and corners are in 1/256 pixel: the centre of the pixel is at (256 i "
         "+ 128, 256 j + 128).")
WINDING = ("Top and left edges are right for one winding alone. In the other one each edge runs the "
           "other way: turn the signs of dx and dy as you turn that of the edge function.")
MISTAKES = [
    ("with_edges", "edge < 0 or edge == 0 and not (top or left)", "edge < 0",
     "Pixels on an edge that two triangles share are drawn twice: an edge owns them only where it "
     "is a top or a left edge."),
    ("without_edges", "edge < 0 or edge == 0 and not (top or left)", "edge <= 0",
     "Pixels on an edge that two triangles share are drawn by neither: a top or a left edge owns "
     "them."),
    ("clockwise_alone", "if area == 0", "if area <= 0",
     "Triangles of the other winding are missing: with all three edge functions negative a pixel "
     "is inside too."),
    ("other_winding_alone", "if area == 0", "if area >= 0",
     "Triangles are missing if their corners go clockwise on the screen: with all three edge "
     "functions positive a pixel is inside too."),
    ("bottom_right", "dx > 0, dy < 0", "dx < 0, dy > 0",
     "These are bottom and right edges. y runs down, so a top edge has the triangle at larger y, a "
     "left edge at larger x."),
    ("top_right", "dx > 0, dy < 0", "dx > 0, dy > 0",
     "Right edges own their pixels here instead of left ones: look at the sign of dy."),
    ("bottom_left", "dx > 0, dy < 0", "dx < 0, dy < 0",
     "Bottom edges own their pixels here instead of top ones. y runs down: a top edge has the "
     "triangle below it, at larger y."),
    ("left_alone", "dy == 0 and dx > 0, dy < 0", "False, dy < 0",
     "Horizontal edges own no pixel here: a top edge owns its pixels as a left edge does."),
    ("top_alone", "dx > 0, dy < 0", "dx > 0, False",
     "Left edges own no pixel here: a left edge owns its pixels as a top edge does."),
    ("all_horizontal", "dy == 0 and dx > 0", "dy == 0",
     "Every horizontal edge owns its pixels here, the bottom one too: only the top one does."),
    ("textbook", "edge < 0 or edge == 0 and not (top or left)", "turn * edge < 0",
     "This draws triangles of one winding alone, and pixels on a shared edge twice. Look at the "
     "sign of the area first, and on an edge whether it is a top or a left one."),
    ("corner_of_pixel", CENTRE, "256 * i, 256 * j",
     "The pixel is tested at its corner. Its centre is half a pixel on, at (256 i + 128, 256 j + "
     "128)."),
    ("other_corner", CENTRE, "256 * i + 256, 256 * j + 256",
     "The pixel is tested at its far corner: its centre is at (256 i + 128, 256 j + 128)."),
    ("exchanged", CENTRE, "256 * j + 128, 256 * i + 128",
     "i and j are exchanged: i counts pixels to the right, j downward."),
    ("box", "if edge < 0 or edge == 0 and not (top or left):",
     "if not (min(x) <= px < max(x) and min(y) <= py < max(y)):",
     "This is the box around the triangle: the three edge functions are missing."),
    ("rows_up", "256 * j + 128", "256 * (7 - j) + 128",
     "Rows are counted from below here. y runs down: row 0 is the top one."),
    ("left_border", "256 * i + 128", "256 * i",
     "x is taken at the left border of the pixel: its centre is at 256 i + 128."),
    ("upper_border", "256 * j + 128", "256 * j",
     "y is taken at the upper border of the pixel: its centre is at 256 j + 128."),
    ("whole_pixels", "    px, py", "    x, y = [a // 256 * 256 for a in x], [a // 256 * 256 for a "
                                   "in y]\n    px, py",
     "Corners are cut to whole pixels: leave them in 1/256 pixel, and give the centre of the pixel "
     "in the same unit."),
    ("pixels_alone", CENTRE, "i, j", UNITS),
    ("centres_in_pixels", CENTRE, "i + 0.5, j + 0.5", UNITS),
    ("rule_of_one_winding", RULE, "dy == 0 and turn * dx > 0, turn * dy < 0", WINDING),
    ("rule_of_other_winding", RULE, "dy == 0 and turn * dx < 0, turn * dy > 0", WINDING),
]


def place(x, y):
    """The inputs of a place of the picture: a diamond of four triangles."""
    across, down = [1920, 128, 1920], [128, 1920, 1920]
    return [v if x < 0 else 2048 - v for v in across] + [v if y > 0 else 2048 - v for v in down]


def color(out, x, y):
    """What an answer looks like there."""
    i, j = int(8 * (x + 1)) % 8, int(8 * (1 - y)) % 8
    return 3 * [0.8 * out[8 * j + i] + 0.1]
