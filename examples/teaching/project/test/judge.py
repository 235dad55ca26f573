#!/usr/bin/env python3
"""Tests of the project's judge: solutions in C and Python get full points, starters run and get none,
each mistake that right.c draws loses points and is told by its sentence."""
import subprocess
import sys
import tempfile
from pathlib import Path

sys.dont_write_bytecode = True
HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
import check  # noqa: E402
from scenes import CASES, MISTAKES, scenes  # noqa: E402


class Right(check.Right):
    """The pictures that shade.h draws, each drawn once."""

    def __init__(self):
        super().__init__()
        self.drawn = {}

    def pictures(self, scene_list, mistake="NONE"):
        """Returns pictures of scenes; bytes are kept, where all colours are numbers."""
        key = mistake, tuple(map(tuple, scene_list))
        if key not in self.drawn:
            pictures = super().pictures(scene_list, mistake)
            self.drawn[key] = [p if -1 in p else bytes(p) for p in pictures]
        return [list(p) for p in self.drawn[key]]


passed, failed, right = 0, 0, Right()


def count(good, says):
    """Counts a check, and tells of one that fails."""
    global passed, failed
    passed, failed = passed + bool(good), failed + (not good)
    if not good:
        print(f"FAIL      {says}")


def points(path, seed, tasks=tuple(CASES)):
    """Returns for each checkpoint the points of a renderer, and what is said."""
    size = len(scenes("1", CASES["1"][0], seed)[0])
    renderer = check.Renderer("project", path, size, 3 * check.WIDTH * check.HEIGHT, 60, "auto")
    return {task: [check.judge_case(task, case, seed, renderer, right)[:2] for case in CASES[task]]
            for task in tasks}


python = subprocess.run(["/usr/bin/env", "python3", "-c", "import numpy"], check=False,
                        stderr=subprocess.DEVNULL).returncode == 0
python = python or subprocess.run(["/usr/bin/python3", "-c", "import numpy"], check=False,
                                  stderr=subprocess.DEVNULL).returncode == 0
if not python:
    print("left out  renderers in Python: no NumPy")
for end in ("c", "py")[:1 + python]:
    for seed in ("1", "5")[:2 if end == "c" else 1]:
        for task, got in points(HERE / f"solution.{end}", seed).items():
            most = sum(case[0] for case in CASES[task])
            count(sum(score for score, _ in got) == most, f"solution.{end}, {task}: {got}")
    for task, got in points(HERE.parent / f"starter/renderer.{end}", "1").items():
        count(all(says and "ended" not in says and "raises" not in says for _, says in got) and
              sum(score for score, _ in got) < 1, f"starter in {end}, {task}: {got}")
# what pages ask for loses points where it is left out of a solution
LEFT_OUT = (
    ("1", "c.w <= 0 || c.z < -c.w || c.z > c.w", "c.w <= 0 || c.z < -c.w", "far"),
    ("1", "c.w <= 0 || c.z < -c.w || c.z > c.w", "c.w <= 0 || c.z > c.w", "near"),
    ("6_bump", "shade_normalize(shade_madd(T, -shade_dot(N, T), N))", "shade_normalize(T)", "a right angle"),
    ("6_silhouettes", "!meet(v[0][0]->position, v[1][1]->position)", "v[0][0] != v[1][1]", "places"),
)
with tempfile.TemporaryDirectory() as folder:
    text = (HERE / "solution.c").read_text(encoding="utf-8")
    for task, old, new, what in LEFT_OUT:
        count(text.count(old) == 1, f"solution.c has once: {old}")
        path = Path(folder) / "renderer.c"
        path.write_text(text.replace(old, new), encoding="utf-8")
        got = points(path, "1", [task])[task]
        count(sum(score for score, _ in got) < 10, f"{task} without {what}: {got}")
# a student's picture is named where it is near to that of right.c, as where edges meet centres
MADE = (
    ("2", "    whole = (X[1]", "    for (int k = 0; k < 3; k++) X[k] = floorf(X[k]), Y[k] = floorf(Y[k]);\n    whole = (X[1]",
     "WHOLE_PIXELS"),
    ("2", "    if (whole == 0) return;", "    if (whole <= 0) return;", "OTHER_WINDING"),
    ("2", "    if (whole == 0) return;", "    if (whole >= 0) return;", "ONE_WINDING"),
)
with tempfile.TemporaryDirectory() as folder:
    text = (HERE / "solution.c").read_text(encoding="utf-8")
    for task, old, new, name in MADE:
        path = Path(folder) / "renderer.c"
        path.write_text(text.replace(old, new), encoding="utf-8")
        got = points(path, "1", [task])[task]
        count(any(MISTAKES[name][1] in says for _, says in got), f"{name}, by hand: {got}")
for task, cases in CASES.items():
    page = next(p for p in HERE.parent.glob("*.md") if p.name.startswith(task)
                and (task == p.stem or task[1:2] != "_"))
    told = "; ".join(f"{case[0]} {case[1]}" for case in cases)
    count(told in page.read_text(encoding="utf-8").replace("\n", " "), f"{page.name} has its points: {told}")
    count(f"check.py {task} renderer.c" in page.read_text(encoding="utf-8"), f"{page.name} has its command")
for name, (where, says) in MISTAKES.items():
    told = []
    for task in CASES:
        if task != where and (len(where) > 2 or task[0] not in where):
            continue
        for case in CASES[task]:
            made = scenes(task, case, "7")
            want, got = right.pictures(made), right.pictures(made, name)
            if not all(check.same(g, w) for g, w in zip(got, want)):
                told.append((case[1], check.why(task, case, made, got, want, right)))
    good = told and any(text == says for _, text in told)
    count(good, f"{name}: {told}")
# what no known mistake draws is told what a case is about, not that it is wrong
for task, cases in CASES.items():
    for case in cases:
        made = scenes(task, case, "7")
        want = right.pictures(made)
        noise = [[(c + 97 * k) % 256 for k, c in enumerate(w)] for w in want]
        ground = [w[0:3] * (check.WIDTH * check.HEIGHT) for w in want]
        text = check.why(task, case, made, noise, want, right)
        count(text == f"No known mistake draws this. This case is about: {case[3]}", f"{task}, noise: {text}")
        text = check.why(task, case, made, ground, want, right)
        count(text.startswith("Your picture is empty:") and "This case is about:" in text, f"{task}, empty: {text}")
# changes of a whole picture
for change, says in check.CHANGES:
    case = CASES["1"][1]
    made = scenes("1", case, "7")
    want = right.pictures(made)
    text = check.why("1", case, made, [change(w) for w in want], want, right)
    count(text == says, f"{says}: {text}")
print(f"{passed} passed, {failed} failed")
sys.exit(failed > 0)
