#!/usr/bin/env python3
"""A bank of questions: those of the four courses with their answers, and questions with numbers that a
seed draws and shade.h answers.

    python3 bank.py OUT [SEED]

writes questions.xml for Moodle, questions.zip in QTI 2.1, and sheet.html and solutions.html to print
(sheet.pdf and solutions.pdf too, where pandoc and chromium are).  It needs Python 3.8 and a C compiler.
"""
import html
import os
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
import zipfile
from pathlib import Path
from typing import NamedTuple
from xml.sax.saxutils import escape

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[2]
COURSES = {"uw": "UW CSE457", "massey": "Massey 159.709", "shirley": "Shirley, chapter 10",
           "berkeley": "Berkeley CS184"}
DRAWS = 6  # questions of each kind


class Question(NamedTuple):
    """A question; text and solution are Markdown with TeX, answer is a number or None."""
    name: str
    course: str
    topic: str
    difficulty: int  # 1 to 3
    text: str
    solution: str
    answer: float = None
    within: float = 0.0


# ---- questions of the courses ---------------------------------------------------------------------

def told(text):
    """Returns Markdown without links to the playground."""
    return re.sub(r"\[((?:[^\[\]]|\[[^\]]*\])*)\]\([^)]*\)", r"\1", " ".join(text.split()))


def of_courses():
    """Returns the questions that the slides ask."""
    for course in COURSES:
        topic, slide, count = "", "", {}
        text = (HERE.parent / f"course/{course}.md").read_text(encoding="utf-8")
        for part in re.finditer(r"^# ([^\n]*)$|^## ([^\n]*)$|<details><summary>(.*?)</summary>(.*?)</details>",
                                text, re.M | re.S):
            if part.group(1):
                topic = part.group(1)
            elif part.group(2):
                slide = part.group(2).split(" · ")[0]
            else:
                count[slide] = count.get(slide, 0) + 1
                number = f" {count[slide]}" if count[slide] > 1 else ""
                question, answer = told(part.group(3)), part.group(4)
                difficulty = 1 + (len(answer) > 160) + (len(answer) > 400)
                yield Question(f"{slide}{number}", course, told(topic or slide), difficulty,
                               f"{told(slide)}: {question}", told(answer))


# ---- questions with numbers -----------------------------------------------------------------------

def vector(x, y, z):
    """Returns a vector in TeX."""
    return f"({x}, {y}, {z})"


# kind: course, topic, difficulty, the question and how to solve it, with {0}, {1} ... for what is given
KINDS = {
    "lambert": ("massey", "Diffuse light", 1,
                r"$\mathbf{n} = (0, 0, 1)$ and $\mathbf{l} = ({0}, {1}, {2})$, both of length 1. What is "
                r"$\max(\mathbf{l}\cdot\mathbf{n}, 0)$?",
                r"The products of the coordinates, added: $\mathbf{l}\cdot\mathbf{n} = {2}$."),
    "mirror": ("shirley", "Highlights", 1,
               r"$\mathbf{n} = (0, 0, 1)$ and $\mathbf{l} = ({0}, {1}, {2})$. What is the first coordinate "
               r"of $\mathbf{r}$?", r"$\mathbf{r} = -\mathbf{l} + 2(\mathbf{l}\cdot\mathbf{n})\mathbf{n}$: "
               r"what lies across $\mathbf{n}$ changes its sign."),
    "halfway": ("uw", "Specular light", 2,
                r"$\mathbf{L} = ({0}, {1}, {2})$ and $\mathbf{V} = ({3}, {4}, {5})$. What is the third "
                r"coordinate of $\mathbf{H}$?",
                r"$\mathbf{H} = (\mathbf{L}+\mathbf{V})/|\mathbf{L}+\mathbf{V}|$: always normalize."),
    "phong": ("berkeley", "Specular reflection", 2,
              r"$\mathbf{n} = (0, 0, 1)$, $\mathbf{l} = ({0}, {1}, {2})$, $\mathbf{v} = ({3}, {4}, {5})$. "
              r"What is $\max(\mathbf{r}\cdot\mathbf{v}, 0)^p$ for $p = {6}$?",
              r"$\mathbf{r} = -\mathbf{l} + 2(\mathbf{l}\cdot\mathbf{n})\mathbf{n}$, then the power of "
              r"$\mathbf{r}\cdot\mathbf{v}$, or of 0."),
    "blinn": ("uw", "Specular light", 2,
              r"$\mathbf{N} = (0, 0, 1)$, $\mathbf{L} = ({0}, {1}, {2})$, $\mathbf{V} = ({3}, {4}, {5})$, "
              r"$n_s = {6}$. What is $B\,(\mathbf{N}\cdot\mathbf{H})_+^{n_s}$?",
              r"$B$ is 1 here. $\mathbf{N}\cdot\mathbf{H}$ is the third coordinate of $\mathbf{H}$; raise it "
              r"to $n_s$."),
    "attenuation": ("uw", "Lamps", 1,
                    r"$a = {0}$, $b = {1}$, $c = {2}$, $r = {3}$. What is $1/(a + br + cr^2)$?",
                    r"Put the numbers in: the sum first, then its reciprocal."),
    "spot": ("uw", "Lamps", 2,
             r"A spotlight shines along $(0, 0, -1)$. $\mathbf{L} = ({0}, {1}, {2})$, $\cos\beta = {3}$, "
             r"$e = {4}$. What is its factor, $(\mathbf{L}\cdot\mathbf{S})^e$ or 0?",
             r"$\mathbf{S} = (0, 0, 1)$, so $\mathbf{L}\cdot\mathbf{S} = {2}$. It is 0 where that is below "
             r"$\cos\beta$."),
    "diffuse": ("uw", "Iteration two", 2,
                r"One channel: $k_e = 0$, $k_a = {3}$, $k_d = {4}$, $I_{La} = I_L = {5}$, $\mathbf{N} = (0, 0, "
                r"1)$, $\mathbf{L} = ({0}, {1}, {2})$. What is $I$ by iteration two?",
                r"$I = k_e + k_a I_{La} + k_d I_L B\,(\mathbf{N}\cdot\mathbf{L})$."),
    "three": ("uw", "Iteration three", 3,
              r"One channel: $k_e = 0$, $k_a = {6}$, $k_d = {7}$, $k_s = {8}$, $n_s = {9}$, $I_{La} = I_L = "
              r"{10}$, $\mathbf{N} = (0, 0, 1)$, $\mathbf{L} = ({0}, {1}, {2})$, $\mathbf{V} = ({3}, {4}, "
              r"{5})$. What is $I$ by iteration three?",
              r"$I = k_e + k_a I_{La} + I_L B\,[k_d (\mathbf{N}\cdot\mathbf{L}) + k_s "
              r"(\mathbf{N}\cdot\mathbf{H})_+^{n_s}]$."),
    "normal": ("massey", "Normals", 3,
               r"A model is scaled by $(1, 1, {0})$. A normal was $({1}, {2}, {3})$. What is the third "
               r"coordinate of its normal now, made unit?",
               r"Normals take $(\mathbf{M}^{-1})^T$: divide the third coordinate by {0}, and make the vector "
               r"unit."),
    "focal": ("massey", "The camera", 1,
              r"A projection has a whole vertical angle of {0} degrees. What is its second entry on the "
              r"diagonal?", r"$1 / \tan({0}^\circ / 2)$."),
    "depth": ("uw", "The z-buffer", 3,
              r"near is {0}, far is {1}. Which depth, from 0 at near to 1 at far, has a point that is {2} in "
              r"front of the eye?",
              r"$z/w = (f + n)/(f - n) - 2fn/((f - n)\,d)$ with $d = {2}$; the depth is half of that and "
              r"$1/2$."),
    "window": ("massey", "The camera", 3,
               r"A picture has 480 rows; the whole vertical angle is {0} degrees. A point is {1} above the "
               r"axis and {2} in front of the eye. At which $Y$, from the top, is it?",
               r"$y/w = {1} / ({2} \tan({0}^\circ/2))$, and $Y = (1 - y/w) \cdot 480/2$."),
    "tone": ("shirley", "Artistic shading", 2,
             r"Red of cool is $.4$, red of warm is $.8$; $\mathbf{n} = (0, 0, 1)$, $\mathbf{l} = ({0}, {1}, "
             r"{2})$. Which red has the tone?",
             r"$k_w = (1 + \mathbf{n}\cdot\mathbf{l})/2$, and $c = k_w c_w + (1 - k_w) c_c$."),
    "srgb": ("berkeley", "Colour and light", 2,
             r"A linear value of {0} is stored as sRGB. Which code, from 0 to 255, is it (before rounding)?",
             r"$255\,(1.055\,c^{1/2.4} - .055)$ for $c > .0031308$."),
    "brdf": ("berkeley", "The BRDF", 3,
             r"$k_d = {6}$, $k_s = {7}$, $n = {8}$, $\mathbf{n} = (0, 0, 1)$, $\mathbf{l} = ({0}, {1}, {2})$, "
             r"$\mathbf{v} = ({3}, {4}, {5})$. What is $f = k_d + k_s (\mathbf{n}\cdot\mathbf{h})^n$?",
             r"$\mathbf{h}$ is $\mathbf{l} + \mathbf{v}$ made unit; its third coordinate is "
             r"$\mathbf{n}\cdot\mathbf{h}$."),
}


def rows(seed):
    """Returns kinds with what is given and the answer, as shade.h has it."""
    with tempfile.TemporaryDirectory() as folder:
        program = os.path.join(folder, "numbers")
        subprocess.run([*shlex.split(os.environ.get("CC", "cc")), "-std=gnu99", "-O1", "-w", f"-I{ROOT}",
                        str(HERE / "numbers.c"), "-lm", "-o", program], check=True)
        said = subprocess.run([program, str(seed), str(DRAWS)], stdout=subprocess.PIPE, check=True).stdout
    for line in said.decode().splitlines():
        given, answer = line.split(" | ")
        kind, *numbers = given.split()
        yield kind, numbers, float(answer)


def with_numbers(seed):
    """Returns the questions that the seed draws."""
    count, seen = {}, set()
    for kind, given, answer in rows(seed):
        if (kind, *given) in seen:
            continue
        seen.add((kind, *given))
        course, topic, difficulty, text, solution = KINDS[kind]
        for k, number in enumerate(given):
            text, solution = (s.replace(f"{{{k}}}", number) for s in (text, solution))
        count[kind] = count.get(kind, 0) + 1
        yield Question(f"{kind} {count[kind]}", course, topic, difficulty, text,
                       f"{solution} The answer is {answer:.4g}.", answer, max(1e-3, 2e-3 * abs(answer)))


# ---- Moodle, QTI, sheets --------------------------------------------------------------------------

def in_html(text):
    """Returns Markdown of a question as HTML, with TeX between the signs that MathJax looks for."""
    parts = re.split(r"(\$[^$]+\$|`[^`]+`)", text)
    out = ""
    for part in parts:
        if part.startswith("$"):
            out += r"\(" + html.escape(part[1:-1], quote=False) + r"\)"
        elif part.startswith("`"):
            out += f"<code>{html.escape(part[1:-1], quote=False)}</code>"
        else:
            out += html.escape(part, quote=False)
    return f"<p>{out}</p>"


def moodle(questions):
    """Returns the bank as Moodle's XML."""
    out, category = ['<?xml version="1.0" encoding="UTF-8"?>', "<quiz>"], None
    for q in sorted(questions, key=lambda q: (q.course, q.topic)):
        if category != (q.course, q.topic):
            category = q.course, q.topic
            name = f"{COURSES[q.course]}/{q.topic.replace('/', '//')}"
            out.append('<question type="category"><category><text>$course$/'
                       f"{escape(name)}</text></category></question>")
        kind = "essay" if q.answer is None else "numerical"
        out.append(f'<question type="{kind}"><name><text>{escape(q.name)}</text></name>'
                   f'<questiontext format="html"><text>{escape(in_html(q.text))}</text></questiontext>'
                   f'<generalfeedback format="html"><text>{escape(in_html(q.solution))}</text>'
                   "</generalfeedback><defaultgrade>1</defaultgrade>")
        if kind == "essay":
            out.append("<responseformat>editor</responseformat><responserequired>1</responserequired>"
                       "<responsefieldlines>5</responsefieldlines><attachments>0</attachments>"
                       f'<graderinfo format="html"><text>{escape(in_html(q.solution))}</text></graderinfo>'
                       '<responsetemplate format="html"><text></text></responsetemplate>')
        else:
            out.append(f'<answer fraction="100" format="moodle_auto_format"><text>{q.answer:.6g}</text>'
                       f"<tolerance>{q.within:.3g}</tolerance></answer>")
        out.append(f"<tags><tag><text>{q.course}</text></tag><tag><text>difficulty {q.difficulty}</text>"
                   "</tag></tags></question>")
    return "\n".join([*out, "</quiz>", ""])


QTI = "http://www.imsglobal.org/xsd/imsqti_v2p1"
CP = "http://www.imsglobal.org/xsd/imscp_v1p1"


def item(q, name):
    """Returns a question as an item of QTI 2.1."""
    head = (f'<assessmentItem xmlns="{QTI}" identifier="{name}" title="{escape(q.name, {chr(34): ""})}" '
            'adaptive="false" timeDependent="false">')
    if q.answer is None:
        return (head + '<responseDeclaration identifier="RESPONSE" cardinality="single" '
                'baseType="string"/><outcomeDeclaration identifier="SCORE" cardinality="single" '
                'baseType="float"/><itemBody>'
                f'<div>{in_html(q.text)}</div><extendedTextInteraction responseIdentifier="RESPONSE" '
                f'expectedLines="5"/><rubricBlock view="scorer"><div>{in_html(q.solution)}</div>'
                "</rubricBlock></itemBody></assessmentItem>")
    # both bounds, and not equal with a tolerance, which some players do not know
    bounds = "".join(f'<{compares}><variable identifier="RESPONSE"/><baseValue baseType="float">{bound:.6g}'
                     f"</baseValue></{compares}>"
                     for compares, bound in (("gte", q.answer - q.within), ("lte", q.answer + q.within)))
    return (head + '<responseDeclaration identifier="RESPONSE" cardinality="single" baseType="float">'
            f"<correctResponse><value>{q.answer:.6g}</value></correctResponse></responseDeclaration>"
            '<outcomeDeclaration identifier="SCORE" cardinality="single" baseType="float"/><itemBody>'
            f'<div>{in_html(q.text)}</div><p><textEntryInteraction responseIdentifier="RESPONSE" '
            f'expectedLength="10"/></p><rubricBlock view="scorer"><div>{in_html(q.solution)}</div>'
            f"</rubricBlock></itemBody><responseProcessing><responseCondition><responseIf><and>{bounds}</and>"
            '<setOutcomeValue identifier="SCORE"><baseValue baseType="float">1</baseValue></setOutcomeValue>'
            "</responseIf></responseCondition></responseProcessing></assessmentItem>")


def qti(questions, path):
    """Writes the bank as a package of QTI 2.1."""
    resources = []
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as package:
        for k, q in enumerate(questions):
            name = f"q{k + 1:03d}"
            package.writestr(f"{name}.xml", '<?xml version="1.0" encoding="UTF-8"?>\n' + item(q, name))
            resources.append(f'<resource identifier="{name}" type="imsqti_item_xmlv2p1" '
                             f'href="{name}.xml"><file href="{name}.xml"/></resource>')
        package.writestr("imsmanifest.xml", f'<?xml version="1.0" encoding="UTF-8"?>\n<manifest '
                         f'xmlns="{CP}" identifier="shade"><metadata><schema>QTIv2.1 Package</schema>'
                         "<schemaversion>1.0.0</schemaversion></metadata><organizations/><resources>"
                         + "".join(resources) + "</resources></manifest>")


def sheet(questions, solved):
    """Returns a sheet of all questions in Markdown."""
    out, last = [], None
    for k, q in enumerate(sorted(questions, key=lambda q: (q.course, q.topic, q.difficulty))):
        if last != (q.course, q.topic):
            last = q.course, q.topic
            out.append(f"## {COURSES[q.course]}: {q.topic}")
        stars = "∗" * q.difficulty
        out.append(f"**{k + 1}.** {stars} {q.text}")
        if solved:
            out.append(f"> {q.solution}")
    return "\n\n".join(out) + "\n"


def printed(markdown, path, title):
    """Writes a sheet as HTML and, where chromium is, as PDF; tells what is missing."""
    page = path.with_suffix(".html")
    subprocess.run(["pandoc", "-f", "markdown-smart", "-t", "html5", "--mathml", "-s", "--metadata",
                    f"title={title}", "-o", str(page)], input=markdown.encode(), check=True)
    browser = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")
    if not browser:
        return "no PDF without chromium (apt install chromium)"
    subprocess.run([browser, "--headless", "--no-sandbox", "--disable-gpu", "--no-pdf-header-footer",
                    f"--print-to-pdf={path}", page.as_uri()], stdout=subprocess.DEVNULL,
                   stderr=subprocess.DEVNULL, check=True, timeout=300)
    return ""


def bank(seed):
    """Returns all questions."""
    return [*of_courses(), *with_numbers(seed)]


def main():
    """Runs the command line."""
    if len(sys.argv) not in (2, 3):
        sys.exit("usage: bank.py OUT [SEED]")
    out, seed = Path(sys.argv[1]).resolve(), int(sys.argv[2]) if len(sys.argv) == 3 else 1
    out.mkdir(parents=True, exist_ok=True)
    questions = bank(seed)
    (out / "questions.xml").write_text(moodle(questions), encoding="utf-8")
    qti(questions, out / "questions.zip")
    for name, solved in (("sheet", False), ("solutions", True)):
        text = sheet(questions, solved)
        (out / f"{name}.md").write_text(text, encoding="utf-8")
        if shutil.which("pandoc"):
            says = printed(text, out / f"{name}.pdf", name.capitalize())
        else:
            says = "no sheets but Markdown without pandoc (apt install pandoc)"
        if says:
            print(says, file=sys.stderr)
    print(f"{len(questions)} questions: {out}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
