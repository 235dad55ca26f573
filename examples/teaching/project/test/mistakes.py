#!/usr/bin/env python3
"""Each mistake that right.c draws loses points, and is told by its sentence."""
import sys
from pathlib import Path

sys.dont_write_bytecode = True
sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import check  # noqa: E402
from scenes import CASES, MISTAKES, scenes  # noqa: E402

passed, failed, right = 0, 0, check.Right()
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
    passed, failed = passed + bool(good), failed + (not good)
    if not good:
        print(f"FAIL      {name}: {told}")
# changes of a whole picture
for change, says in check.CHANGES:
    case = CASES["1"][1]
    made = scenes("1", case, "7")
    want = right.pictures(made)
    text = check.why("1", case, made, [change(w) for w in want], want, right)
    passed, failed = passed + (text == says), failed + (text != says)
    if text != says:
        print(f"FAIL      {says}: {text}")
print(f"{passed} passed, {failed} failed")
sys.exit(failed > 0)
