#!/usr/bin/env python3
"""Judges a checkpoint of the project: renderer.c or renderer.py.

    python3 check.py 1 renderer.c
    python3 check.py 6_shadow renderer.py --picture difference.png

It draws scenes with your renderer and with shade.h, and compares the pictures.  The exit status is 0
for full points.  It needs Python 3.8 or newer and a C compiler; for renderer.py NumPy.
"""
import argparse
import math
import os
import shlex
import struct
import subprocess
import sys
import tempfile
import textwrap
from pathlib import Path

sys.dont_write_bytecode = True
HERE = Path(__file__).resolve().parent
ASSIGNMENTS = HERE.parent / "assignments"
ROOT = HERE.parents[2]
sys.path[:0] = [str(HERE / "judge"), str(ASSIGNMENTS)]
try:
    from grade import seed_of, write_json, write_png
    from judge.process import Refused, Student
    from judge.room import KINDS
    from scenes import CASES, MISTAKES, TRIES, numbered, scenes
except ImportError as error:
    sys.exit(f"{error}: the judge needs Linux or macOS; on Windows use WSL.")
WIDTH, HEIGHT, ENLARGED = 64, 48, 4
CODES = 2  # of 255, by which a channel may be off
PIXELS = 100  # one in so many pixels that are drawn may be wrong, as where an edge meets a centre


class Renderer(Student):
    """A renderer that a student hands in."""

    megabytes, needs = 1024, ", numpy"

    def prepare(self, task, path):
        """Brings what a renderer includes to the room."""
        for name in ("scene.h", "scene.py"):
            self.room.put(name, (HERE / "starter" / name).read_text(encoding="utf-8"))
        super().prepare("project", path)

    def declared(self, _):
        """Returns the number that student.c has for the project, and the declaration of render."""
        return 20, (HERE / "starter/scene.h").read_text(encoding="utf-8")


class Right:
    """The pictures that shade.h draws."""

    def __init__(self):
        self.folder = tempfile.TemporaryDirectory()  # pylint: disable=R1732
        self.numbers, self.program = numbered(), os.path.join(self.folder.name, "right")
        made = subprocess.run(
            [*shlex.split(os.environ.get("CC", "cc")), "-std=gnu99", "-O1", "-w", f"-I{ROOT}",
             f"-I{ASSIGNMENTS}", f"-I{HERE}/starter", str(HERE / "judge/right.c"), "-lm", "-o",
             self.program], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)
        if made.returncode:
            raise Refused(f"right.c does not compile:\n{made.stdout.decode()[:2000]}")

    def pictures(self, scene_list, mistake="NONE"):
        """Returns pictures of scenes, right ones or with a mistake, as codes of 255."""
        sent = b"".join(struct.pack(f"{1 + len(s)}f", self.numbers[mistake], *s) for s in scene_list)
        got = subprocess.run([self.program], input=sent, stdout=subprocess.PIPE, check=True).stdout
        size = 3 * WIDTH * HEIGHT
        return [codes(struct.unpack_from(f"{size}f", got, 4 * size * k))
                for k in range(len(scene_list))]


def codes(numbers):
    """Returns colours as codes of 255; one that is no number as -1."""
    return [int(255 * min(1, max(0, x)) + 0.5) if math.isfinite(x) else -1 for x in numbers]


def wrong_pixels(got, want):
    """Returns the pixels of two pictures that differ."""
    off = [k for k, (g, w) in enumerate(zip(got, want)) if g - w > CODES or w - g > CODES]
    return list(dict.fromkeys(k // 3 for k in off))


def same(got, want):
    """Tells whether two pictures are the same, but for a few pixels at edges."""
    if got == want:
        return True
    ground = want[0:3]
    drawn = sum(want[k:k + 3] != ground for k in range(0, len(want), 3))
    return len(wrong_pixels(got, want)) <= max(2, drawn // PIXELS)


def shows(got, drawn, want):
    """Tells whether a picture is that of a mistake: the same, or up to twice as many pixels are off,
    and at least four times as many of the right one."""
    if same(got, drawn):
        return True
    off, ground = len(wrong_pixels(got, drawn)), want[0:3]
    covered = sum(drawn[k:k + 3] != ground for k in range(0, len(drawn), 3))
    return off <= 2 * covered // PIXELS and 4 * off <= len(wrong_pixels(got, want))


def empty(picture):
    """Tells whether a picture has one colour."""
    return picture == picture[0:3] * (WIDTH * HEIGHT)


def moved(picture, dx, dy):
    """Returns a picture that is moved by whole pixels."""
    out = []
    for y in range(HEIGHT):
        for x in range(WIDTH):
            i, j = x - dx, y - dy
            at = 3 * (WIDTH * j + i)
            inside = 0 <= i < WIDTH and 0 <= j < HEIGHT
            out += picture[at:at + 3] if inside else picture[0:3]
    return out


def flipped(picture, in_x, in_y):
    """Returns a picture that is mirrored, or upside down, or both."""
    rows = [picture[3 * WIDTH * y:3 * WIDTH * (y + 1)] for y in range(HEIGHT)]
    if in_y:
        rows = rows[::-1]
    if in_x:
        rows = [[c for x in range(WIDTH - 1, -1, -1) for c in row[3 * x:3 * x + 3]] for row in rows]
    return [c for row in rows for c in row]


CHANGES = [  # of a whole picture, with what they say
    (lambda p: flipped(p, False, True), "The picture is upside down: Y goes down, y goes up, so "
                                        "Y = (1 - y/w) H/2."),
    (lambda p: flipped(p, True, False), "The picture is mirrored: look at x of the camera, up x z."),
    (lambda p: flipped(p, True, True), "The picture is turned round by 180 degrees."),
] + [(lambda p, x=x, y=y: moved(p, x, y), f"The picture is moved by ({x}, {y}) pixels: pixel (i, j) "
      "reaches from i to i + 1 and from j to j + 1; its centre is in the middle.")
     for x, y in ((1, 0), (-1, 0), (0, 1), (0, -1), (1, 1), (-1, -1), (1, -1), (-1, 1))]


def why(task, case, scene_list, got, want, right):
    """Returns a sentence for pictures of which some are wrong."""
    bad = [k for k in range(len(got)) if not same(got[k], want[k])]
    about = f"This case is about: {case[3]}"
    if all(empty(got[k]) for k in bad):
        return f"Your picture is empty: all is outside of the window, or behind you. {about}"
    if any(-1 in got[k] for k in bad):
        return "There is a colour that is no number: 0 / 0, or a root or a power of a negative number."
    for name, (where, says) in MISTAKES.items():
        if task != where and (len(where) > 2 or task[0] not in where):
            continue
        drawn = right.pictures(scene_list, name)
        if all(shows(got[k], drawn[k], want[k]) for k in range(len(got))):
            return says
    for change, says in CHANGES:
        if all(same(got[k], change(want[k])) for k in bad):
            return says
    return f"No known mistake draws this. {about}"


def judge_case(task, case, seed, renderer, right):
    """Returns the points of a case, what to say, and the worst pictures: got and wanted."""
    scene_list = scenes(task, case, seed)
    answers, end = renderer.ask(scene_list)
    want = right.pictures(scene_list)
    got = [codes(a) if a else None for a in answers]
    good = [a is not None and same(a, w) for a, w in zip(got, want)]
    score = math.floor(100 * case[0] * sum(good) / TRIES) / 100
    if all(good) and len(good) == TRIES:
        return score, "", (got[0], want[0])
    if len(got) < TRIES or None in got:
        empty = [0] * len(want[0])
        says = f"Your renderer {end}." if end else "Not run: the renderer took too long before."
        return score, says, (got[0] if got and got[0] else empty, want[0])
    worst = max(range(TRIES), key=lambda k: len(wrong_pixels(got[k], want[k])))
    off = wrong_pixels(got[worst], want[worst])
    k = off[len(off) // 2]
    y, r = (picture[worst][3 * k:3 * k + 3] for picture in (got, want))
    return score, (f"{good.count(False)} of {TRIES} pictures are wrong. In the worst {len(off)} of "
                   f"{WIDTH * HEIGHT} pixels differ; pixel ({k % WIDTH}, {k // WIDTH}) of yours is "
                   f"({y[0]}, {y[1]}, {y[2]}), right is ({r[0]}, {r[1]}, {r[2]}). "
                   + why(task, case, scene_list, got, want, right)), (got[worst], want[worst])


def write_difference(path, pairs):
    """Draws for each case your picture, the right one, and where they differ, in red."""
    rows = []
    for got, want in pairs:
        off, marked = set(wrong_pixels(got, want)), []
        for k in range(WIDTH * HEIGHT):
            grey = sum(want[3 * k:3 * k + 3]) // 9
            marked += [255, 40, 40] if k in off else [grey] * 3
        for y in range(HEIGHT):
            row = b""
            for picture in (got, want, marked):
                for x in range(WIDTH):
                    at = 3 * (WIDTH * y + x)
                    row += bytes(max(0, c) for c in picture[at:at + 3]) * ENLARGED
                row += bytes([255, 255, 255]) * ENLARGED
            rows += [row] * ENLARGED
        rows += [bytes([255]) * len(rows[0])] * ENLARGED
    write_png(path, rows)


def arguments():
    """Returns the arguments of the command line."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    add = parser.add_argument
    add("checkpoint", choices=sorted(CASES), metavar="CHECKPOINT", help=", ".join(sorted(CASES)))
    add("answer", metavar="FILE", help="renderer.c or renderer.py, or a folder with one")
    add("--picture", metavar="PNG", help="draws for each case yours, the right one, and what differs")
    add("--json", metavar="RESULTS", help="writes results as Gradescope reads them")
    add("--seed-file", metavar="FILE", help="has the seed of the scenes, - for standard input")
    add("--room", choices=KINDS, default="auto", help="what holds the renderer")
    add("--seconds", type=int, default=20, help="of the processor, for the scenes of a case")
    return parser.parse_args()


class Done:  # pylint: disable=too-few-public-methods
    """Cases as write_json takes them."""

    def __init__(self, cases):
        self.cases = [type("Case", (), {"name": c[1], "points": c[0]}) for c in cases]


def main():
    """Runs the command line."""
    options = arguments()
    seed = seed_of(options.seed_file) if options.seed_file else "1"
    cases, pairs, output = CASES[options.checkpoint], [], ""
    scores = [(0, "The judge did not finish.")] * len(cases)
    if options.json:
        write_json(options.json, Done(cases), scores, output)
    try:
        inputs = len(scenes(options.checkpoint, cases[0], seed)[0])
        renderer = Renderer("project", options.answer, inputs, 3 * WIDTH * HEIGHT, options.seconds,
                            options.room)
        if options.seed_file and not renderer.room.holds():
            raise Refused("Without bubblewrap, and not as root, a program can read the seed: nothing is "
                          "judged with a seed of your own.")
        right, scores = Right(), []
        for case in cases:
            score, says, pair = judge_case(options.checkpoint, case, seed, renderer, right)
            scores.append((score, says))
            pairs.append(pair)
        output = renderer.notes()
    except Refused as refused:
        output = str(refused)
        scores = [(0, output)] * len(cases)
    for case, (score, says) in zip(cases, scores):
        print(f"{'FAIL' if score < case[0] else 'ok  '}  {case[1]}: {score:g} of {case[0]}")
        if says and says != output:
            print(textwrap.indent(textwrap.fill(says, 94), 6 * " "))
    if output:
        print(output)
    if options.picture and pairs:
        write_difference(options.picture, pairs)
    if options.json:
        write_json(options.json, Done(cases), scores, output)
    total, points = sum(score for score, _ in scores), sum(case[0] for case in cases)
    print(f"checkpoint {options.checkpoint}: {total:g} of {points} points")
    return int(total < points)


if __name__ == "__main__":
    sys.exit(main())
