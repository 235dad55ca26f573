#!/usr/bin/env python3
"""Judges what a student hands in for a task: a .c file or a .py file.

    python3 grade.py 01_lambert --start my.c
    python3 grade.py 01_lambert my.c --picture out.png

The exit status is 0 for full points.  It needs Python 3.8 or newer, for C a C compiler.
"""
import argparse
import json
import math
import os
import re
import struct
import sys
import textwrap
import zlib
from pathlib import Path

sys.dont_write_bytecode = True
try:
    from judge.points import CALLS, Judge, Task, flat
    from judge.process import Refused, Student
    from judge.room import KINDS
except ImportError as error:
    sys.exit(f"{error}: the grader needs Linux or macOS; on Windows use WSL.")
HERE = Path(__file__).resolve().parent
SIDE = 160  # of a picture
NOTHING = {  # what a starter returns, by the type in C or by the words of a task's page
    "float": "0", "int": "0", "shade_vec2": "shade_v2(0, 0)", "shade_vec3": "shade_v3(0, 0, 0)",
    "shade_mat3": "shade_mat3_identity()",
    "a list of corners, each a list of four floats": "[]",
    "a float": "0.0", "a bool": "False", "[u, v]": "[0.0, 0.0]",
    "a list of three floats": "[0.0, 0.0, 0.0]",
    "three lists of three floats, column after column": "[model[0:3], model[4:7], model[8:11]]",
}


def starter(task, is_c):
    """Returns a file that runs without an answer, with the functions that the page asks for."""
    page = (HERE / task / "README.md").read_text(encoding="utf-8")
    block = page.split("```c\n" if is_c else "```python\n")[1].split("```")[0]
    if not is_c:
        heads = re.findall(r"(def .*:)  # returns (.*)", block)
        return f'"""{task}: write what the page of the task asks for."""\n' + "".join(
            f"\n\n{head}  # returns {what}\n    return {NOTHING[what]}\n" for head, what in heads)
    text = f"/* {task}: write what the page of the task asks for. */\n"
    text += '#include "vectors.h"\n#include <math.h>\n'
    for kind, name, given in re.findall(r"(\w+) (\w+)\((.*?)\);", block, re.S):
        names = re.findall(r"(\w+)(?:\[\d+\])?(?:,|$)", given)
        unused = "".join(f"    (void){one};\n" for one in names)
        text += f"\n{kind} {name}({given})\n{{\n{unused}    return {NOTHING[kind]};\n}}\n"
    return text


def pixels(task, ask):
    """Returns the rows of a picture of answers."""
    steps = [2 * (k + 0.5) / SIDE - 1 for k in range(SIDE)]
    places = [(x, -y) for y in steps for x in steps]
    inputs = [task.module.place(x, y) for x, y in places]
    unlike = list({tuple(v): None for v in inputs if v})
    answers, _ = ask([list(v[:task.sent]) for v in unlike])
    known, out = dict(zip(unlike, answers)), bytearray()
    for (x, y), v in zip(places, inputs):
        answer = v and known.get(tuple(v))
        shown = task.module.color(task.compared(v, answer), x, y) if answer else [0, 0, 0]
        shown = [c if math.isfinite(c) else 0 for c in shown]
        out += bytes(int(255 * min(1, max(0, c)) + 0.5) for c in shown)
    return [bytes(out[3 * SIDE * j:3 * SIDE * (j + 1)]) for j in range(SIDE)]


def write_png(path, rows):
    """Writes rows of red, green and blue, each less the row above it."""
    def chunk(name, data):
        size, check = len(data), zlib.crc32(name + data)
        return struct.pack(">I", size) + name + data + struct.pack(">I", check)
    above = [bytes(len(rows[0])), *rows]
    data = b"".join(b"\2" + bytes((a - b) & 255 for a, b in zip(*two)) for two in zip(rows, above))
    head = struct.pack(">IIBBBBB", len(rows[0]) // 3, len(rows), 8, 2, 0, 0, 0)
    Path(path).write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(
        b"IDAT", zlib.compress(data, 9)) + chunk(b"IEND", b""))


def write_json(path, task, scores, output):
    """Writes results as Gradescope reads them."""
    tests = [{"name": case.name, "score": score, "max_score": case.points, "output": says}
             for case, (score, says) in zip(task.cases, scores)]
    text = json.dumps({"output": output, "tests": tests}, indent=2)
    Path(path).write_text(text + "\n", encoding="utf-8")


def from_judge(answer):
    """Returns what is asked in place of a student: answers of the judge's own process."""
    return lambda inputs: ([answer(v) for v in inputs], "raises an error")


def arguments():
    """Returns the arguments of the command line."""
    names = sorted(CALLS)
    numbers = {name.split("_")[0]: name for name in names}
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("task", choices=names, metavar="TASK", help=", ".join(names),
                        type=lambda text: numbers.get(text.zfill(2), text))
    add = parser.add_argument
    add("answer", nargs="?", metavar="FILE", help="a .c or a .py, or a folder with one")
    add("--start", metavar="FILE", help="writes a .c or a .py to begin with, where there is none")
    add("--seed-file", metavar="FILE", help="has the seed of the inputs, - for standard input; "
        "teachers keep theirs to themselves")
    add("--room", choices=KINDS, default="auto", help="what holds the program: auto takes bubblewrap "
        "where it works")
    add("--json", metavar="RESULTS", help="writes results as Gradescope reads them")
    add("--picture", metavar="PNG", help="draws your answers, and beside them the right ones")
    add("--mistake", metavar="NAME", help="judges a known mistake in place of a file")
    add("--seconds", type=int, default=5, help="of the processor, for the inputs of a case")
    options = parser.parse_args()
    if sum(map(bool, (options.answer, options.start, options.mistake))) != 1:
        parser.error("give a FILE, --start FILE or --mistake NAME")
    return options


def start(task, path):
    """Writes a file to begin with."""
    if path.suffix not in (".c", ".py"):
        sys.exit(f"{path} is neither a .c nor a .py.")
    try:
        with path.open("x", encoding="utf-8") as file:
            file.write(starter(task, path.suffix == ".c"))
    except OSError as error:
        sys.exit(f"{path} is not written: {error.strerror}.")
    return 0


def seed_of(path):
    """Returns the seed that a file has.  Others may not read it: the program belongs to one of them."""
    if path == "-":
        return sys.stdin.readline().strip()
    try:
        with open(path, encoding="utf-8") as file:
            if os.fstat(file.fileno()).st_mode & 0o077:
                sys.exit(f"{path} can be read by others: chmod 600 {path}")
            return file.readline().strip()
    except OSError as error:
        return sys.exit(f"{path} cannot be read: {error.strerror}.")


def mistaken(task, name):
    """Returns what is asked in place of a student who makes a known mistake."""
    for mistake in task.mistakes:
        if mistake[0] == name:
            return from_judge(task.answerer(mistake))
    return sys.exit(f"{task.name} knows the mistakes {', '.join(m[0] for m in task.mistakes)}.")


def main():
    """Runs the command line."""
    options = arguments()
    if options.start:
        return start(options.task, Path(options.start))
    task, student, output = Task(options.task), None, ""
    seed = seed_of(options.seed_file) if options.seed_file else "1"
    scores = [(0, "The grader did not finish.")] * len(task.cases)
    if options.json:
        write_json(options.json, task, scores, output)
    try:
        if options.mistake:
            ask = mistaken(task, options.mistake)
        else:
            student = Student(task.name, options.answer, task.sent, task.outputs, options.seconds,
                              options.room)
            if options.seed_file and not student.room.holds():
                raise Refused("Without bubblewrap, and not as root, a program can read the seed: "
                              "nothing is judged with a seed of your own.")
            ask = student.ask
        scores = [(r.score, r.says) for r in Judge(task, seed).judge(ask)]
        if student:
            output = student.notes()
        if options.picture:
            write_png(options.picture, [a + b for a, b in zip(
                pixels(task, ask), pixels(task, from_judge(task.answerer())))])
    except Refused as refused:
        scores = [(0, str(refused))] * len(task.cases)
        output = str(refused)
    for case, (score, says) in zip(task.cases, scores):
        word = "FAIL" if score < case.points else "ok  "
        print(f"{word}  {case.name}: {score:g} of {case.points}")
        if says and says != output:
            print(textwrap.indent(textwrap.fill(says, 94), 6 * " "))
    if output:
        print(output)
    total, points = sum(score for score, _ in scores), sum(case.points for case in task.cases)
    print(f"{task.name}: {total:g} of {points} points")
    if options.json:
        write_json(options.json, task, scores, output)
    return int(total < points)


if __name__ == "__main__":
    sys.exit(main())
