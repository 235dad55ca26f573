#!/usr/bin/env python3
"""Tests of the bank of questions: how many there are, answers beside formulas in double precision, files
that parse, nothing of Markdown or links left in them."""
import math
import re
import sys
import xml.etree.ElementTree as ElementTree
import zipfile
from pathlib import Path

sys.dont_write_bytecode = True
sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import bank  # noqa: E402

counts = {"passed": 0, "failed": 0}


def check(name, good, says=""):
    """Counts a check, and tells of one that fails."""
    counts["passed" if good else "failed"] += 1
    if not good:
        print(f"FAIL      {name}\n    {str(says)[:600]}")


def unit(v):
    """Returns v / |v|, zero for zero."""
    length = math.sqrt(sum(x * x for x in v))
    return [x / length if length > 1e-6 else 0 for x in v]


def lobe(L, V, n):
    """Returns (N.H)^n."""
    return max(0, unit([a + b for a, b in zip(L, V)])[2]) ** n


def view(d, near, far):
    """Returns depth from 0 to 1 at a distance."""
    return 0.5 + 0.5 * ((far + near) / (far - near) - 2 * far * near / ((far - near) * d))


RIGHT = {
    "lambert": lambda x, y, z: max(0, z),
    "mirror": lambda x, y, z: -x,
    "halfway": lambda *g: unit([a + b for a, b in zip(g[:3], g[3:])])[2],
    "phong": lambda *g: max(0, -g[0] * g[3] + g[2] * g[5]) ** g[6],
    "blinn": lambda *g: lobe(g[:3], g[3:6], g[6]),
    "attenuation": lambda a, b, c, r: 1 / (a + b * r + c * r * r),
    "spot": lambda x, y, z, cutoff, e: z ** e if z >= cutoff - 1e-6 else 0,
    "diffuse": lambda x, y, z, ka, kd, light: light * (ka + kd * z),
    "three": lambda *g: g[10] * (g[6] + g[7] * g[2] + g[8] * lobe(g[:3], g[3:6], g[9])),
    "normal": lambda s, x, y, z: unit([x, y, z / s])[2],
    "focal": lambda d: 1 / math.tan(math.radians(d) / 2),
    "depth": lambda near, far, d: view(d, near, far),
    "window": lambda a, y, d: 240 * (1 - y / (d * math.tan(math.radians(a) / 2))),
    "tone": lambda x, y, z: 0.4 + (1 + z) / 2 * 0.4,
    "srgb": lambda c: 255 * (1.055 * c ** (1 / 2.4) - 0.055),
    "brdf": lambda *g: g[6] + g[7] * lobe(g[:3], g[3:6], g[8]),
}
check("each kind has a formula", set(RIGHT) == set(bank.KINDS))
for seed in (1, 2, 77):
    rows = list(bank.rows(seed))
    check(f"seed {seed}: all kinds are drawn", {row[0] for row in rows} == set(RIGHT))
    for kind, given, answer in rows:
        want = RIGHT[kind](*map(float, given))
        check(f"{kind} {given}", abs(answer - want) <= 1e-3 * max(0.01, abs(want)), (answer, want))
questions = bank.bank(1)
check("there are 120 questions", len(questions) >= 120, len(questions))
check("of all courses", {q.course for q in questions} == set(bank.COURSES))
check("of three difficulties", {q.difficulty for q in questions} == {1, 2, 3})
slides = sum((bank.HERE.parent / f"course/{c}.md").read_text(encoding="utf-8").count("<summary>")
             for c in bank.COURSES)
check("with each question of the slides", sum(q.answer is None for q in questions) == slides, slides)
check("no two are the same", len({q.text for q in questions}) == len(questions),
      [q.text for q in questions if [p.text for p in questions].count(q.text) > 1])
check("another seed gives other numbers", [q.text for q in bank.bank(1)] == [q.text for q in questions] !=
      [q.text for q in bank.bank(2)])
for q in questions:
    left = re.search(r"\]\(|\{\d+\}|<details>", q.text + q.solution)
    check(f"{q.name}: no Markdown is left", not left and q.text and q.solution, q.text)

quiz = ElementTree.fromstring(bank.moodle(questions))
of_moodle = [q for q in quiz if q.get("type") != "category"]
check("Moodle: all questions", quiz.tag == "quiz" and len(of_moodle) == len(questions))
for q in of_moodle:
    fields = {child.tag for child in q}
    need = {"name", "questiontext", "generalfeedback", "defaultgrade"}
    need |= {"answer"} if q.get("type") == "numerical" else {"responseformat", "graderinfo"}
    check(f"Moodle: {q.find('name/text').text}", need <= fields, need - fields)
    ElementTree.fromstring(f"<p>{q.find('questiontext/text').text}</p>")
path = Path(sys.argv[1]) / "questions.zip"
bank.qti(questions, path)
with zipfile.ZipFile(path) as package:
    manifest = ElementTree.fromstring(package.read("imsmanifest.xml"))
    names = [r.get("href") for r in manifest.iter(f"{{{bank.CP}}}resource")]
    check("QTI: the manifest names each file", sorted(names + ["imsmanifest.xml"]) == sorted(
        package.namelist()))
    for name in names:
        top = ElementTree.fromstring(package.read(name))
        tags = [t.tag.replace(f"{{{bank.QTI}}}", "") for t in top]
        ask = [t for t in top.iter() if t.get("responseIdentifier")]
        declared = top.find(f"{{{bank.QTI}}}responseDeclaration").get("identifier")
        check(f"QTI: {name}", top.tag == f"{{{bank.QTI}}}assessmentItem" and tags[:3] == [
            "responseDeclaration", "outcomeDeclaration", "itemBody"] and len(ask) == 1 and
            ask[0].get("responseIdentifier") == declared and top.get("identifier") == name[:-4], tags)
print(f"{counts['passed']} passed, {counts['failed']} failed")
sys.exit(counts["failed"] > 0)
