#!/usr/bin/env python3
"""grade.py ANSWER.py VECTORS.json [--json RESULTS.json] - judges a student's Python function.

VECTORS.json is what the C grader of the same assignment writes with --vectors: inputs, the answers
of shade.h, and those of common mistakes.  The exit status is 0 for full points.  Nothing but the
standard library is needed.
"""
import argparse
import importlib.util
import json
import math
import re
import sys


def through_normal(columns):
    """Returns the unit normal (1, 2, 2) / 3 after a matrix of three columns."""
    out = [sum(columns[k][i] * n for k, n in enumerate((1 / 3, 2 / 3, 2 / 3))) for i in range(3)]
    length = math.sqrt(sum(x * x for x in out)) or 1
    return [x / length for x in out]


ANSWERS = {
    "01_lambert": lambda m, N, L: [m.lambert(N, L)],
    "02_mirror": lambda m, L, N: m.mirror(L, N),
    "03_highlight": lambda m, N, L, V, n: [*m.halfway(L, V), m.phong(N, L, V, n)],
    "04_attenuation": lambda m, a, b, c, r: [m.attenuation(a, b, c, r)],
    "05_spot": lambda m, L, aim, cos_cutoff, e: [m.spot(L, aim, cos_cutoff, e)],
    "06_normal_matrix": lambda m, model: through_normal(m.normal_matrix(model)),
}


def close(got, want, tolerance):
    """Tells whether two numbers are equal within the tolerance; two NaN are the same mistake."""
    if got == want or (math.isnan(got) and math.isnan(want)):
        return True
    return math.isfinite(want) and abs(got - want) <= tolerance * max(1, abs(want))


def near(got, want, tolerance):
    """Tells whether an answer is the right one."""
    return isinstance(got, list) and len(got) == len(want) and all(
        close(g, w, tolerance) for g, w in zip(got, want))


def ask_all(case, names, ask):
    """Returns the answers of a case: arguments, got or the exception, wanted, those of mistakes."""
    answers = []
    for inputs, want, *mistakes in case["tries"]:
        arguments, at = {}, 0
        for name, count in names:
            arguments[name] = inputs[at] if count == 1 else inputs[at:at + count]
            at += count
        try:
            got = [float(x) for x in ask(*arguments.values())]
        except Exception as error:  # whatever a student's function raises is its answer
            got = error
        answers.append((arguments, got, want, mistakes))
    return answers


def gives(answers, k, tolerance, whole):
    """Tells whether mistake k gives these answers, if not whole in those outputs in which it is one."""
    differs = False
    for part in range(len(answers[0][2])):
        wrong = not all(close(mistakes[k][part], want[part], tolerance)
                        for _, _, want, mistakes in answers)
        differs = differs or wrong
        if (wrong or whole) and not all(isinstance(got, list) and len(got) == len(want) and
                   close(got[part], mistakes[k][part], tolerance)
                   for _, got, want, mistakes in answers):
            return False
    return differs


def which(answers, vectors, whole):
    """Returns the numbers of the mistakes that give these answers."""
    return [k for k in range(len(vectors["mistakes"]))
            if gives(answers, k, vectors["tolerance"], whole)]


def show(numbers):
    """Returns numbers as text, one alone without brackets."""
    texts = [f"{x:.9g}" for x in (numbers if isinstance(numbers, list) else [numbers])]
    return texts[0] if len(texts) == 1 else f"({', '.join(texts)})"


def alike(answers, tolerance):
    """Tells whether all answers are the same, whatever the input."""
    first = answers[0][1]
    return isinstance(first, list) and all(near(got, first, tolerance) for _, got, _, _ in answers)


def why(case, answers, known, vectors):
    """Returns why the answers of a case are wrong: a mistake, or the hint of the case."""
    start = " Your answer is the same for every input." if known["constant"] else ""
    sure = [k for k in which(answers, vectors, False) if k in known["mistakes"]]
    if sure or start:
        return start + "".join(" " + vectors["mistakes"][k] for k in sure)
    if not alike(answers, vectors["tolerance"]):
        for k in which(answers, vectors, True)[:1]:
            return " In this case, perhaps: " + vectors["mistakes"][k]
    return " " + case["hint"]


def judge(case, answers, known, vectors):
    """Returns what is wrong with the answers of a case, or ""."""
    wrong = [a for a in answers if not near(a[1], a[2], vectors["tolerance"])]
    if not wrong:
        return ""
    arguments, got, want, _ = wrong[0]
    said = ", ".join(f"{k} = {show(v)}" for k, v in arguments.items())
    start = f"Wrong for {len(wrong)} of {len(answers)} inputs. For {said} yours "
    if isinstance(got, Exception):
        return f"{start}raises {type(got).__name__}: {got}."
    if len(got) != len(want):
        return f"{start}has {len(got)} numbers, right are {len(want)}."
    return f"{start}is {show(got)}, right is {show(want)}.{why(case, answers, known, vectors)}"


def load(path):
    """Returns the student's module, and a sentence where it cannot be run."""
    spec = importlib.util.spec_from_file_location("answer", path)
    module = importlib.util.module_from_spec(spec)
    try:
        spec.loader.exec_module(module)
    except Exception as error:  # a SyntaxError above all
        return None, f"The file cannot be run: {type(error).__name__}: {error}."
    return module, ""


def main():
    """Runs the command line."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("answer")
    parser.add_argument("vectors")
    parser.add_argument("--json")
    options = parser.parse_args()
    with open(options.vectors, encoding="utf-8") as file:
        vectors = json.load(file)
    if vectors["name"] not in ANSWERS:
        sys.exit(f"{vectors['name']} is an assignment in C alone")
    module, broken = load(options.answer)
    names = [(n, int(k)) for n, k in re.findall(r"(\w*?[A-Za-z_])(\d+)(?: |$)", vectors["names"])]

    asked = [ask_all(case, names, lambda *a: ANSWERS[vectors["name"]](module, *a))
             for case in vectors["cases"]]
    every = [answer for answers in asked for answer in answers]
    known = {"constant": alike(every, vectors["tolerance"]),
             "mistakes": which(every, vectors, False)}
    tests, total = [], 0
    for case, answers in zip(vectors["cases"], asked):
        says = broken or judge(case, answers, known, vectors)
        points = 0 if says else case["points"]
        print(f"{'FAIL' if says else 'ok  '}  {case['name']}: {points} of {case['points']}")
        if says:
            print(f"      {says}")
        total += case["points"]
        tests.append({"name": case["name"], "score": points, "max_score": case["points"],
                      "output": says})
    score = sum(test["score"] for test in tests)
    print(f"{vectors['name']}: {score} of {total} points")
    if options.json:
        with open(options.json, "w", encoding="utf-8") as file:
            json.dump({"output": vectors["name"], "tests": tests}, file, indent=2)
    return int(score < total)


if __name__ == "__main__":
    sys.exit(main())
