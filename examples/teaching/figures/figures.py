#!/usr/bin/env python3
"""Draws the plane figures whose curves are computed: vectors, lobes, attenuation, cone, projection.

    python3 figures.py [OUT [COURSE]]

writes them beside itself, as SVG, black on white. Into OUT it writes all figures, those of the slides in
../course too, black on white and, with COURSE (uw, massey, shirley, berkeley), in the letters of it.
"""
import math
import re
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
from letters import COURSES, letters  # noqa: E402

STYLE = ("text{font:italic 22px serif}.b{font-weight:bold;font-style:normal}.n{font-style:normal}"
         "path,line,circle{fill:none;stroke:#000;stroke-width:2}.thin{stroke-width:1}"
         ".dash{stroke-dasharray:6 5;stroke-width:1.5}.grey{stroke:#777}")


def tip(x, y, angle):
    """Returns the head of an arrow that points along an angle."""
    points = [(x - 13 * math.cos(angle + s), y - 13 * math.sin(angle + s)) for s in (0.35, 0, -0.35)]
    points[1] = x, y
    return '<polygon points="' + " ".join(f"{a:.1f},{b:.1f}" for a, b in points) + '"/>'


def arrow(x, y, degrees, length, name, style=""):
    """Returns an arrow from a point; 0 degrees is up, positive ones to the right."""
    turn = math.radians(degrees - 90)
    to = x + length * math.cos(turn), y + length * math.sin(turn)
    at = x + (length + 22) * math.cos(turn), y + (length + 22) * math.sin(turn) + 7
    return (f'<line class="{style}" x1="{x}" y1="{y}" x2="{to[0]:.1f}" y2="{to[1]:.1f}"/>'
            + tip(*to, turn) + word(*at, name, "b"))


def word(x, y, text, style="", anchor="middle"):
    """Returns a text."""
    return f'<text class="{style}" x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}">{text}</text>'


def arc(x, y, radius, start, end, name):
    """Returns an arc between two angles, and its name beside its middle."""
    a, b = (math.radians(t - 90) for t in (start, end))
    middle = (a + b) / 2
    return (f'<path class="thin" d="M{x + radius * math.cos(a):.1f} {y + radius * math.sin(a):.1f}A{radius} '
            f'{radius} 0 0 {int(end > start)} {x + radius * math.cos(b):.1f} {y + radius * math.sin(b):.1f}"/>'
            + word(x + (radius + 16) * math.cos(middle), y + (radius + 16) * math.sin(middle) + 7, name))


def curve(points, style=""):
    """Returns a line through points."""
    return f'<path class="{style}" d="M' + "L".join(f"{x:.1f} {y:.1f}" for x, y in points) + '"/>'


def vectors():
    """N, L, V, R and H at a point."""
    x, y = 300, 280
    return 600, 320, (f'<line x1="40" y1="{y}" x2="560" y2="{y}"/>' + arrow(x, y, 0, 220, "N")
                      + arrow(x, y, -50, 220, "L") + arrow(x, y, 50, 220, "R", "dash")
                      + arrow(x, y, 74, 220, "V") + arrow(x, y, 12, 180, "H", "dash")
                      + arc(x, y, 95, -50, 0, "θ") + arc(x, y, 120, 50, 74, "φ")
                      + word(x, y + 30, "P"))


def lobes():
    """(R.V)^n around R for three exponents."""
    x, y, out = 300, 280, ""
    for n, style in ((1, "dash"), (5, ""), (50, "thin")):
        points = []
        for k in range(-90, 91, 2):
            length = 210 * max(0, math.cos(math.radians(k))) ** n
            turn = math.radians(40 + k - 90)
            points.append((x + length * math.cos(turn), min(y, y + length * math.sin(turn))))
        out += curve(points, style)
    out += word(482, 200, "n = 1", anchor="start") + word(376, 274, "n = 5", anchor="start")
    out += word(488, 84, "n = 50", anchor="start")
    return 600, 320, (f'<line x1="40" y1="{y}" x2="560" y2="{y}"/>' + out + arrow(x, y, 0, 200, "N")
                      + arrow(x, y, -40, 200, "L") + arrow(x, y, 40, 225, "R", "dash"))


def attenuation():
    """1/(a + b r + c r^2) over r."""
    left, base, wide, tall = 70, 280, 480, 230

    def at(r, value):
        return left + wide * r / 6, base - tall * min(1, value)
    out = ""
    for style, name, fall, r in (("", "1/r²", lambda r: 1 / max(r * r, 1e-9), 1.9),
                                 ("dash", "1/r", lambda r: 1 / max(r, 1e-9), 3.1),
                                 ("thin", "1/(1 + .2 r + .1 r²)", lambda r: 1 / (1 + .2 * r + .1 * r * r), 1.3)):
        points = [at(k / 40, fall(k / 40)) for k in range(0, 241)]
        out += curve(points, style)
        x, y = at(r, fall(r))
        out += word(x + 10, y + (34 if name == "1/r²" else -12), name, "n", "end" if name == "1/r²" else "start")
    axes = (f'<line x1="{left}" y1="{base}" x2="570" y2="{base}"/>' + tip(570, base, 0)
            + f'<line x1="{left}" y1="{base}" x2="{left}" y2="30"/>' + tip(left, 30, -math.pi / 2))
    ticks = "".join(word(at(r, 0)[0], base + 26, str(r), "n") for r in (1, 2, 3, 4, 5))
    return 600, 320, axes + out + ticks + word(580, base + 26, "r") + word(left - 18, base - tall + 7, "1", "n")


def cone():
    """A spotlight: S, L, alpha, beta."""
    x, y = 300, 50
    sides = "".join(f'<line class="dash" x1="{x}" y1="{y}" x2="{x + 250 * math.sin(t):.1f}" '
                    f'y2="{y + 250 * math.cos(t):.1f}"/>' for t in (-0.6, 0.6))
    px, py = x + 250 * math.sin(0.33), y + 235
    turn = math.degrees(math.atan2(x - px, py - y))
    return 600, 330, (sides + f'<circle cx="{x}" cy="{y}" r="7"/><line x1="80" y1="{py}" x2="520" y2="{py}"/>'
                      + f'<line class="thin grey" x1="{x}" y1="{y}" x2="{x}" y2="{py}"/>'
                      + f'<line class="thin" x1="{px:.1f}" y1="{py}" x2="{x}" y2="{y}"/>'
                      + arrow(px, py, turn, 62, "L") + arrow(px, py, 0, 110, "S")
                      + arc(x, y, 66, 180, 146, "β") + arc(x, y, 112, 180, 161, "α")
                      + word(px, py + 30, "P"))


def projection():
    """A point and its image, by similar triangles."""
    x, y = 60, 230
    return 640, 320, (f'<line class="thin" x1="{x}" y1="{y}" x2="610" y2="{y}"/>' + tip(615, y, 0)
                      + f'<line x1="260" y1="60" x2="260" y2="300"/>'
                      + f'<line class="dash" x1="{x}" y1="{y}" x2="540" y2="70"/>'
                      + f'<line class="thin" x1="540" y1="70" x2="540" y2="{y}"/>'
                      + f'<circle cx="{x}" cy="{y}" r="4"/><circle cx="540" cy="70" r="4"/>'
                      + f'<circle cx="260" cy="{y - 200 * 160 / 480:.1f}" r="4"/>'
                      + word(x, y + 32, "COP", "n") + word(545, 55, "P") + word(160, y + 28, "d")
                      + word(400, y + 28, "−z") + word(562, 155, "y") + word(232, 155, "y′")
                      + word(260, 48, "image plane", "n") + word(330, 292, "y′ = y d / (−z)", "n", "start"))


FIGURES = {"vectors": vectors, "lobes": lobes, "attenuation": attenuation, "cone": cone,
           "projection": projection}


def svg(draw):
    """Returns a figure as SVG."""
    wide, tall, body = draw()
    return (f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {wide} {tall}"><title>{draw.__doc__}</title>'
            f'<style>{STYLE}</style><rect width="{wide}" height="{tall}" fill="#fff"/>{body}</svg>\n')


# ---- black on white, in the letters of a course ----------------------------------------------------

def without_colours(text):
    """Returns an SVG of the slides in black and greys on white: lines and letters that are dark are
    black, areas of a colour of their own light grey."""
    def grey(found):
        area, r, g, b = found.group(1) or "", *(int(found.group(2)[k:k + 2], 16) for k in (0, 2, 4))
        light = (0.299 * r + 0.587 * g + 0.114 * b) / 255
        light = 0.5 + light / 2 if area else light if light > 0.55 else 0
        return area + "#" + 3 * f"{round(255 * light):02x}"
    text = re.sub(r"@media \(prefers-color-scheme: dark\) \{.*?\}\s*\}\s*", "", text, flags=re.S)
    text = re.sub(r"((?:fill|stop-color)=\")?#([0-9a-fA-F]{6})\b", grey, text)
    return text.replace("</style>", '</style>\n<rect width="100%" height="100%" fill="#ffffff"/>', 1)


def sign(tex):
    """Returns a letter in TeX as an SVG has it."""
    names = {"alpha": "α", "sigma": "σ", "phi": "φ"}
    tex = re.sub(r"\\(\w+)", lambda found: names[found.group(1)], tex)
    return re.sub(r"_\{?(\w+)\}?", r'<tspan dy=".25em" font-size="70%">\1</tspan>', tex)


def in_letters(text, of):
    """Returns an SVG in the letters of a course."""
    def one(found):
        begin, name, end = found.groups()
        if name[1:] == " = ":
            return begin + sign(of.get(name[0], name[0])) + " = " + end
        return begin + sign(of.get({"φ": "\\phi"}.get(name, name), name)) + end
    text = re.sub(r"(<text[^>]*>)([NLVRH]), ([nlve])(?=</text>)", r"\1\2", text)
    text = re.sub(r"(?<=>)L, V, N(?= and)", lambda found: ", ".join(of.get(name, name) for name in "LVN"), text)
    text = re.sub(r"(<text[^>]*>)([NLVRHφ]|n = )((?:[\d]+)?</text>)", one, text)
    return re.sub(r"\bk<tspan[^>]*>([sd])</tspan>",
                  lambda found: sign(of.get(f"k_{found.group(1)}", f"k_{found.group(1)}")), text)


OTHER = ("spaces.svg", "spectrum.svg")  # V is a matrix there, and R red


def taken_along(out, course):
    """Writes all figures into a folder."""
    of = letters(course) if course else {}
    out.mkdir(parents=True, exist_ok=True)
    for name, draw in FIGURES.items():
        (out / f"{name}.svg").write_text(in_letters(svg(draw), of), encoding="utf-8")
    for path in sorted((HERE.parent / "course").glob("*.svg")):
        text = without_colours(path.read_text(encoding="utf-8"))
        if path.name not in OTHER:
            text = in_letters(text, of)
        (out / path.name).write_text(text, encoding="utf-8")


def main():
    """Runs the command line."""
    if len(sys.argv) > 3 or sys.argv[2:] and sys.argv[2] not in COURSES:
        sys.exit("usage: figures.py [OUT [uw|massey|shirley|berkeley]]")
    if len(sys.argv) > 1:
        taken_along(Path(sys.argv[1]), sys.argv[2] if len(sys.argv) > 2 else "")
        return
    for name, draw in FIGURES.items():
        (HERE / f"{name}.svg").write_text(svg(draw), encoding="utf-8")


if __name__ == "__main__":
    main()
