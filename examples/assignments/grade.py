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


def near(got, want, tolerance):
    """Tells whether numbers are those wanted; a NaN never is."""
    return len(got) == len(want) and all(
        abs(g - w) <= tolerance * max(1, abs(w)) for g, w in zip(got, want))


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


def which(answers, vectors):
    """Returns the sentence of the mistake that gives all of these answers, or ""."""
    for k, says in enumerate(vectors["mistakes"]):
        if all(isinstance(got, list) and near(got, mistakes[k], vectors["tolerance"])
               for _, got, _, mistakes in answers):
            return says
    return ""


def judge(answers, of_all, vectors):
    """Returns what is wrong with the answers of a case, or ""."""
    for arguments, got, want, _ in answers:
        said = ", ".join(f"{k} = {v}" for k, v in arguments.items())
        if isinstance(got, Exception):
            return f"For {said} yours raises {type(got).__name__}: {got}."
        if not near(got, want, vectors["tolerance"]):
            return f"For {said} yours is {got}, right is {want}. {of_all or which(answers, vectors)}"
    return ""


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
    spec = importlib.util.spec_from_file_location("answer", options.answer)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    names = [(n, int(k)) for n, k in re.findall(r"(\w*?[A-Za-z_])(\d+)(?: |$)", vectors["names"])]

    asked = [ask_all(case, names, lambda *a: ANSWERS[vectors["name"]](module, *a))
             for case in vectors["cases"]]
    of_all = which([answer for answers in asked for answer in answers], vectors)
    tests, total = [], 0
    for case, answers in zip(vectors["cases"], asked):
        says = judge(answers, of_all, vectors)
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
