#!/usr/bin/env python3
"""An exam sheet: a seed draws a ball under one or two lamps and marks a pixel; the light of that pixel
is computed line by line, as the playground's "explain this pixel" does.

    python3 exam.py OUT SEED [COURSE]

writes scene.png, exam.tex and solution.tex, and the same as HTML and, where chromium is, PDF: exam has
the lines without values, solution with them.  COURSE (uw, massey, shirley, berkeley) chooses the
letters.  It needs Python 3.8, a C compiler and, for HTML and PDF, pandoc.
"""
import os
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import NamedTuple

from bank import COURSES, HERE, ROOT, printed

sys.path.insert(0, str(HERE.parent))
from letters import letters  # noqa: E402


class Line(NamedTuple):
    """A line of a sheet: what is computed, and its value; given is told on both sheets."""
    tex: str
    value: str
    given: bool = False


class Part(NamedTuple):
    """Lines under a title."""
    title: str
    lines: list


# ---- letters --------------------------------------------------------------------------------------

def spelled(tex, of):
    """Returns TeX in the letters of a course."""
    def one(found):
        return of.get(found.group(), found.group())
    tex = re.sub(r"(?<=\\mathbf\{)[NLVH](?=\})", one, tex)
    return re.sub(r"(?<![a-zA-Z\\{])(k_[ads]|I_[ads]|n)(?![a-zA-Z])", one, tex)


# ---- numbers --------------------------------------------------------------------------------------

def compiled(folder):
    """Returns the program that draws a scene."""
    program = os.path.join(folder, "exam")
    subprocess.run([*shlex.split(os.environ.get("CC", "cc")), "-std=gnu99", "-O1", "-w", f"-I{ROOT}",
                    str(HERE / "exam.c"), "-lm", "-o", program], check=True)
    return program


def numbers(program, seed, picture):
    """Returns the rows of a seed, by name, those of lamps one level deeper; and writes the picture."""
    said = subprocess.run([program, str(seed), str(picture)], stdout=subprocess.PIPE, check=True).stdout
    rows = {"lamps": []}
    into = rows
    for row in said.decode().splitlines():
        name, *values = row.split()
        if name == "lamp":
            into = {}
            rows["lamps"].append(into)
        elif name == "sum":
            into = rows
        else:
            values = [float(v) for v in values]
            into[name] = values if len(values) > 1 else values[0]
    return rows


def written(value):
    """Returns a number or a vector of four digits in TeX."""
    if isinstance(value, list):
        return "(" + ",\\ ".join(written(v) for v in value) + ")"
    text = f"{value:.4f}" if abs(value) < 10 else f"{value:.2f}"
    text = text.rstrip("0").rstrip(".") if float(text) else "0"
    return f"{{{text}}}" if text.startswith("-") else text


# ---- lines ----------------------------------------------------------------------------------------

def of_lamp(j, lamp):
    """Returns the lines of lamp j."""
    spot = "S" in lamp
    L, H, N, V = rf"\mathbf{{L}}_{j}", rf"\mathbf{{H}}_{j}", r"\mathbf{N}", r"\mathbf{V}"
    given = [(rf"\mathbf{{Q}}_{j}", "place"), (rf"I_{{{j}}}", "light"), (rf"a_{j}", "a"), (rf"b_{j}", "b"),
             (rf"c_{j}", "c")]
    lines = [(rf"r_{j} = |\mathbf{{Q}}_{j} - \mathbf{{P}}|", "r"),
             (rf"{L} = \dfrac{{\mathbf{{Q}}_{j} - \mathbf{{P}}}}{{r_{j}}}", "L"),
             (rf"{N} \cdot {L}", "NL"),
             (rf"f_{j} = \dfrac{{1}}{{a_{j} + b_{j} r_{j} + c_{j} r_{j}^2}}", "f")]
    if spot:
        given += [(rf"\mathbf{{S}}_{j}", "S"), (rf"e_{j}", "e"), (rf"\cos\beta_{j}", "cosbeta")]
        lines += [(rf"{L} \cdot \mathbf{{S}}_{j}", "LS"),
                  (rf"s_{j} = ({L} \cdot \mathbf{{S}}_{j})^{{e_{j}}} \text{{ within }} \beta_{j},"
                   r" \text{ else } 0", "cone")]
    arrives = rf"f_{j}\, s_{j}" if spot else rf"f_{j}"
    lines += [(rf"{H} = \dfrac{{{L} + {V}}}{{|{L} + {V}|}}", "H"),
              (rf"{N} \cdot {H}", "NH"),
              (rf"\text{{power}}_{j} = \max(0, {N} \cdot {H})^n", "power"),
              (rf"\text{{diffuse}}_{j} = {arrives}\, k_d I_{{{j}}} \max(0, {N} \cdot {L})", "diffuse"),
              (rf"\text{{specular}}_{j} = {arrives}\, k_s I_{{{j}}}\, \text{{power}}_{j} \text{{ where }} {N} \cdot {L} > 0",
               "specular")]
    kind = "a spotlight" if spot else "a point light"
    return Part(f"Lamp {j}, {kind}", [Line(t, written(lamp[name]), True) for t, name in given] +
                [Line(t, written(lamp[name])) for t, name in lines])


def parts_of(rows):
    """Returns a sheet."""
    given = [(r"\mathbf{E} \text{, the eye}", "E"), (r"\mathbf{P}", "P"), ("k_a = k_d", "kd"), ("k_s", "ks"),
             ("n", "n"), ("I_a", "Ia")]
    lines = [(r"\mathbf{N} = \dfrac{\mathbf{P}}{|\mathbf{P}|}", "N"),
             (r"\mathbf{V} = \dfrac{\mathbf{E} - \mathbf{P}}{|\mathbf{E} - \mathbf{P}|}", "V"),
             (r"\text{ambient} = k_a I_a", "ambient")]
    terms = "".join(rf" + \text{{diffuse}}_{j} + \text{{specular}}_{j}"
                    for j in range(1, len(rows["lamps"]) + 1))
    return [Part("Given", [Line(t, written(rows[name]), True) for t, name in given]),
            Part("The point", [Line(t, written(rows[name])) for t, name in lines]),
            *[of_lamp(j + 1, lamp) for j, lamp in enumerate(rows["lamps"])],
            Part("The light of the pixel", [Line(rf"I = \text{{ambient}}{terms}", written(rows["I"]))])]


TASK = ("The ball has radius 1 and stands at the origin. The pixel in the frame shows the point P. Compute "
        "the light I of the pixel, line by line, with four digits. Colours "
        "are (red, green, blue), multiplied channel by channel.")


def markdown(parts, solved, of):
    """Returns a sheet in Markdown."""
    out = ["![](scene.png){width=60%}", TASK]
    for part in parts:
        rows = [f"| ${spelled(line.tex, of)}$ | " + (f"${line.value}$ |" if solved or line.given else " |")
                for line in part.lines]
        out += [f"### {part.title}", "\n".join(["| | |", "|:-----------|:------------|", *rows])]
    return "\n\n".join(out) + "\n"


def latex(parts, solved, of, title):
    """Returns a sheet in LaTeX."""
    out = [r"\documentclass[11pt]{article}", r"\usepackage[margin=2cm]{geometry}",
           r"\usepackage{amsmath,graphicx,longtable}", r"\setlength\parindent{0pt}",
           r"\begin{document}", rf"\section*{{{title}}}", r"\includegraphics[width=.5\textwidth]{scene.png}",
           "", TASK]
    for part in parts:
        out += ["", rf"\subsection*{{{part.title}}}", r"\renewcommand\arraystretch{1.3}",
                r"\begin{longtable}{@{}p{.6\textwidth}p{.35\textwidth}@{}}"]
        for line in part.lines:
            value = f"${line.value}$" if solved or line.given else r"\dotfill"
            out.append(rf"${spelled(line.tex, of)}$ & {value} \\")
        out.append(r"\end{longtable}")
    return "\n".join([*out, r"\end{document}", ""])


def main():
    """Runs the command line."""
    if len(sys.argv) not in (3, 4) or not sys.argv[2].isdigit() or sys.argv[3:] and sys.argv[3] not in COURSES:
        sys.exit("usage: exam.py OUT SEED [uw|massey|shirley|berkeley]")
    out, seed, course = Path(sys.argv[1]).resolve(), sys.argv[2], (sys.argv[3:] or ["uw"])[0]
    out.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as folder:
        parts = parts_of(numbers(compiled(folder), seed, out / "scene.png"))
    for name, solved in (("exam", False), ("solution", True)):
        title = f"One pixel, {seed}" + (", with its values" if solved else "")
        (out / f"{name}.tex").write_text(latex(parts, solved, letters(course), title), encoding="utf-8")
        if shutil.which("pandoc"):
            says = printed(markdown(parts, solved, letters(course)), out / f"{name}.pdf", title)
        else:
            says = "no PDF without pandoc (apt install pandoc)"
        if says:
            print(says, file=sys.stderr)
    print(f"exam {seed}: {out}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
