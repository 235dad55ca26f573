#!/usr/bin/env python3
"""Tests of the judge of examples/teaching/assignments: right answers, wrong ones, none.

    python3 examples/teaching/assignments/test/graders.py [WORDS]     only checks that have the words in their name
"""
import inspect
import os
import re
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

sys.dont_write_bytecode = True
HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[3]
ASSIGNMENTS = ROOT / "examples/teaching/assignments"
sys.path.insert(0, str(ASSIGNMENTS))
import grade  # noqa: E402
from judge import process, student, tools  # noqa: E402
from judge.points import Judge, Task  # noqa: E402
from judge.process import Refused, Student  # noqa: E402

WORDS = " ".join(sys.argv[1:])
TASKS = {name: Task(name) for name in sorted(student.CALLS)}
FOLDER = Path(tempfile.mkdtemp())
FOLDER.chmod(0o711)
COUNTS = {"passed": 0, "failed": 0}


def check(name, good, says=""):
    """Counts a check, and tells of one that fails."""
    COUNTS["passed" if good else "failed"] += 1
    if not good:
        print(f"FAIL      {name}\n    {str(says)[:1200]}")


def wanted(name):
    """Tells whether a check is among those of the command line."""
    return WORDS in name


def handed_in(name, text):
    """Returns the path of a file with a text."""
    path = FOLDER / name
    path.write_text(text, encoding="utf-8")
    return path


def judged(task, path, seed=7, seconds=20):
    """Returns points and all sentences of a file that is handed in."""
    try:
        one = Student(task.name, path, task.sent, task.outputs, seconds)
        results = Judge(task, seed).judge(one.ask)
    except Refused as refused:
        return 0, str(refused)
    return sum(r.score for r in results), "\n".join(r.says for r in results if r.says)


def full(task):
    """Returns the points of a task."""
    return sum(case.points for case in task.cases)


class Library(Student):
    """A program of the test, which may have shade.h in it."""

    def prepare(self, task, path):
        """Links a file with the library, and brings the program to the room."""
        program = FOLDER / f"library_{task}"
        subprocess.run([*os.environ.get("CC", "cc").split(), "-std=gnu99", "-O1", "-w", f"-I{ROOT}",
                        f"-I{ASSIGNMENTS}", f"-DTASK={int(task[:2])}", "-include", str(ROOT / "shade.h"),
                        str(ASSIGNMENTS / "judge/student.c"), str(path), str(ROOT / "build/shade.o"),
                        "-lm", "-o", str(program)], check=True)
        (self.room.folder / "answer").write_bytes(program.read_bytes())
        (self.room.folder / "answer").chmod(0o755)
        self.system, self.home, self.command = True, None, ["./answer"]


# ---- right answers ------------------------------------------------------------------------------

def right_answers(task):
    """The judge's right answers beside shade.h's, and solutions by hand in both languages."""
    # Depth and texture coordinates are what the library does inside of a draw.
    # Of the tasks from 11 on it has no function of its own.
    within = task.name in ("08_depth", "09_texture") or task.name > "11"
    file = "by_hand.c" if within else "solutions.c"
    library = Library(task.name, HERE / file, task.sent, task.outputs, 20)
    for seed in (1, 2, 3):
        results = Judge(task, seed).judge(library.ask)
        says = "\n".join(r.says for r in results if r.says)
        check(f"{task.name}: the judge agrees with C, seed {seed}", not says, says)
    for name in ("by_hand.c", "by_hand.py"):
        score, says = judged(task, HERE / name, 5)
        check(f"{task.name}: {name} has full points", score == full(task), says)
        notes = Student(task.name, HERE / name, task.sent, task.outputs, 5).notes()
        check(f"{task.name}: nothing is told of {name}", not notes, notes)
    for name in ("starter.c", "starter.py"):
        path = handed_in(name, grade.starter(task.name, name.endswith(".c")))
        score, says = judged(task, path)
        check(f"{task.name}: {name} has less than half", score < full(task) / 2 and says, says)
        check(f"{task.name}: {name} runs", "raises" not in says and "compile" not in says, says)


# ---- wrong answers ------------------------------------------------------------------------------

def table(name):
    """Returns the rows of a table: parts between bars, a bar in a part is written \\|."""
    for line in (HERE / name).read_text().splitlines():
        if line and line[0] != "#":
            yield [part.replace("\\|", "|").strip() for part in re.split(r"(?<!\\)\|", line)]


def rows():
    """Returns the wrong answers of wrong.txt: task, what must be said, changes."""
    for first, *changes in table("wrong.txt"):
        number, expected = first.split(" ", 1)
        task = next(task for task in TASKS.values() if task.name.startswith(number))
        yield task, expected, list(zip(changes[::2], changes[1::2]))


def changed(changes):
    """Returns by_hand.c with changes, and the first one that finds no text."""
    head, body = re.match(r"(.*?\n)(?=float)(.*)", (HERE / "by_hand.c").read_text(), re.S).groups()
    body = " ".join(body.split())
    for old, new in changes:
        if old not in body:
            return "", old
        body = body.replace(old, new)
    return f"{head}{body}\n", None


def wrong_answer(row):
    """Returns whether a wrong answer in C loses points and gets its sentence, and no other."""
    task, expected, changes = row
    name = f"{task.name}: {expected}"
    text, missing = changed(changes)
    if missing:
        return name, False, f"by_hand.c has no {missing}"
    score, says = judged(task, handed_in(f"{abs(hash(text))}.c", text))
    if not 0 <= score < full(task):
        return name, False, f"has {score} points\n{says}"
    if expected.startswith(("hint ", "says ")):
        return name, expected[5:] in says, says
    sentences = [m[3] for m in task.mistakes if m[0] in expected.split("+")]
    sure = re.sub(r"One mistake that fits this case: .*", "", says)
    named = len(sentences) == expected.count("+") + 1 and all(s in sure for s in sentences)
    others = [m[0] for m in task.mistakes if m[3] in sure and m[3] not in sentences]
    return name, named and not others, f"{score} points, also {others}\n{says}"


def in_python(task, mistake):
    """Returns a student's Python file that makes a known mistake."""
    helpers = (tools.dot, tools.add, tools.sub, tools.mul, tools.scale, tools.cross, tools.length,
               tools.unit)
    text = "import math\npow = math.pow\n" + "\n".join(map(inspect.getsource, helpers))
    assert mistake[1] in task.source, mistake
    return text + task.source.replace(mistake[1], mistake[2])


def known_mistakes(task):
    """Each known mistake loses points and is named alone, in the first case that loses points; the
    other cases point to that one."""
    for mistake in task.mistakes:
        name = f"{task.name}: the mistake {mistake[0]}"
        answer = task.answerer(mistake)
        results = Judge(task, 11).judge(lambda v, a=answer: ([a(x) for x in v], "raises"))
        lost = [r for r in results if r.score < r.case.points]
        says = [r.says for r in lost]
        check(f"{name} is named", lost and mistake[3] in says[0], says)
        first = f" inputs. See the case '{lost[0].case.name}' first."
        check(f"{name} is named once", all(s.endswith(first) for s in says[1:]), says)
        others = [m[0] for m in task.mistakes if m[3] in " ".join(says) and m[3] != mistake[3]]
        check(f"{name} is told from the others", not others, others)
    for mistake in (task.mistakes[0], task.mistakes[-1]):
        score, says = judged(task, handed_in("mistake.py", in_python(task, mistake)))
        good = score < full(task) and mistake[3] in says
        check(f"{task.name}: {mistake[0]} is named in Python", good, says)


# ---- what gets no points, and what does ---------------------------------------------------------

LAMBERT = "float lambert(shade_vec3 N, shade_vec3 L)"


def refused():
    """What is no answer gets no points and a sentence."""
    for language, name, says, code in table("refused.txt"):
        if wanted(name):
            text = re.sub(r"\\(.)", lambda m: {"n": "\n"}.get(m.group(1), m.group(1)), code)
            head = '#include "shade.h"\n' if language == "c" else ""
            path = handed_in(f"cheat.{language}", head + text.replace("LAMBERT", LAMBERT) + "\n")
            score, said = judged(TASKS["01_lambert"], path, seconds=1)
            good = score == 0 and says.replace("\\n", "\n") in said
            check(f"{language} that {name} gets a sentence", good, (score, said))


ALLOWED = {  # what a student may do: the language, the code, what is told beside the points
    "prints to both of its streams": ("c", "#include <stdio.h>\n" + LAMBERT + """ {
        fprintf(stderr, "N %g\\n", N.x); fprintf(stderr, "one\\n"); fputs("two\\n", stderr);
        perror("three"); puts("four"); printf("five\\n"); fflush(stdout); putchar('6');
        return fmaxf(0, shade_dot(N, L)); }""", "N [-0-9].*\none\ntwo\nthree.*\nfour\nfive\n6N "),
    "prints what looks like an answer": ("c", "#include <stdio.h>\n" + LAMBERT + """ {
        for (int k = 0; k < 16; k++) putc("\\0\\0\\0\\0\\0\\0\\360?"[k % 8], stderr);
        return fmaxf(0, shade_dot(N, L)); }""", "Your file prints"),
    "has a variable that is not used": ("c", LAMBERT + """ {
        int light;\n  return fmaxf(0, shade_dot(N, L)); }""",
        r"^Your compiler warns:\nallowed.c:4:13: warning: unused variable .light."),
    "includes shade.h as a header of the system": (
        "c", "#include <shade.h>\n#include <stdio.h>\n" + LAMBERT +
        " { puts(\"one\"); return fmaxf(0, shade_dot(N, L)); }", "Your file prints"),
    "has many warnings": ("c", LAMBERT + " {" + "\nint " + "; int ".join("abcdefgh") + """;
        return fmaxf(0, shade_dot(N, L)); }""", r"(\nallowed.c:4.*){3}\nand 5 more\.$"),
    "prints": ("py", "def lambert(N, L):\n    print('one')\n    return max(0, sum(n * l for n, l "
               "in zip(N, L)))\n", "Your file prints, which the grader does not read: one\none"),
}


def allowed():
    """What a student may do costs no points, and is told."""
    lambert = TASKS["01_lambert"]
    for name, (language, code, told) in ALLOWED.items():
        head = '#include "shade.h"\n#include <math.h>\n' if language == "c" else ""
        path = handed_in(f"allowed.{language}", head + code)
        score, says = judged(lambert, path)
        one = Student(lambert.name, path, lambert.sent, lambert.outputs, 20)
        one.ask(lambert.inputs(lambert.cases[0], 1))
        good = score == full(lambert) and re.search(told, one.notes(), re.M)
        check(f"{language} that {name} has full points, and is told", good, (says, one.notes()))


ONCE = {  # what is told in one case alone: the task, the language, the code, the sentence
    "a name that is not there": ("01", "py", "def lambert(N, L):\n    return foo\n",
                                 "yours raises NameError: name 'foo' is not defined.\n"),
    "a parameter too few": ("01", "py", "def lambert(N):\n    return 1\n",
                            "takes 1 positional argument but 2 were given.\n"),
    "nothing that is returned": ("01", "py", "def lambert(N, L):\n    N[0]\n",
                                 "yours returns nothing: is a return missing?\n"),
    "a text that is returned": ("03", "py", "def halfway(L, V):\n    return ['a', 0, 0]\n"
                                            "def phong(N, L, V, n):\n    return 0\n",
                                "yours returns a str, which is no number.\n"),
    "a complex number": ("01", "py", "def lambert(N, L):\n    return (-N[0] ** 2) ** .5\n",
                         "yours returns a complex number, a power or a root of a negative one.\n"),
    "a crash": ("01", "c", LAMBERT + " { return *(volatile float *)0; }",
                "The program crashed: an index beyond an array"),
    "a NaN": ("01", "c", LAMBERT + " { return (L.x - L.x) / 0 + N.x; }", "A NaN comes from 0 / 0"),
}


def once():
    """What is wrong in all cases is told in the first one, and the others point to it."""
    for name, (number, language, code, told) in ONCE.items():
        task = next(task for task in TASKS.values() if task.name.startswith(number))
        head = '#include "shade.h"\n' if language == "c" else ""
        score, says = judged(task, handed_in(f"once.{language}", head + code))
        first = f"Wrong for 100 of 100 inputs. See the case '{task.cases[0].name}' first."
        good = told in f"{says}\n" and says.count(told.strip()) == 1
        check(f"once: {name}", good and says.count(first) == len(task.cases) - 1, (score, says))


def bases():
    """Iteration four with a lamp that is wrong: no case gives a hint but that of one lamp."""
    text, _ = changed([("arrives * lobe", "2 * r * arrives * lobe"),
                       ("m->ambient, l->ambient", "m->diffuse, l->ambient")])
    task = TASKS["10_iteration_four"]
    _, says = judged(task, handed_in("bases.c", text))
    base, *others = says.split("\n")
    good = base.endswith(task.cases[1].hint) and len(others) == 3
    check("bases: see one lamp first", good and all(text.endswith(
        "of 100 inputs. See the case 'one lamp' first.") for text in others), says)


def loops():
    """A loop that does not end takes the time of one case, whatever the language."""
    for language, code in (("c", f'#include "shade.h"\n{LAMBERT} {{ for (;;) {{ }} }}'),
                           ("py", "def lambert(N, L):\n    while True:\n        pass\n")):
        path = handed_in(f"loop.{language}", code)
        with tempfile.NamedTemporaryFile() as picture:
            run = subprocess.run([sys.executable, ASSIGNMENTS / "grade.py", "01", path, "--seconds", "1",
                                  "--picture", picture.name], stdout=subprocess.PIPE, check=False)
        said = " ".join(run.stdout.decode().split())
        good = said.count("look for a loop that does not end") == 1
        check(f"loops: {language} costs the time of one case, and the others say so", good and
              said.count("Not run: the program took too long before.") == 2, said)


def names():
    """Inputs are shown by the names of the page and of the fields, vectors one by one."""
    for task in TASKS.values():
        long = [name for name, count in task.names if count > 4]
        check(f"names: {task.name} shows vectors one by one", not long, long)
    fields = set(re.findall(r"(\w+)=", inspect.getsource(student.scene))) - {"lights"}
    shown = {name.split(".")[-1] for name, _ in TASKS["10_iteration_four"].names}
    check("names: iteration four shows the names of fields", fields <= shown, fields - shown)


def links():
    """A link is not read: what a compiler says of its lines would tell them, as those with the
    seed."""
    folder = FOLDER / "links"
    folder.mkdir()
    for name in ("my.c", "my.py"):
        (folder / name).symlink_to(handed_in("secret.txt", "SEED=4711\n"))
        for path in (folder / name, folder):
            score, said = judged(TASKS["01_lambert"], path)
            check(f"{name} that is a link gets a sentence", score == 0 and said.endswith(
                "is a link: hand in the file itself."), said)
        (folder / name).unlink()


def main():
    """Runs all checks."""
    for task in TASKS.values():
        if wanted(task.name):
            right_answers(task)
            known_mistakes(task)
    some = [row for row in rows() if wanted(f"{row[0].name}: {row[1]}")]
    with ThreadPoolExecutor(2) as pool:
        for name, good, says in pool.map(wrong_answer, some):
            check(f"{name} loses points and gets its sentence", good, says)
    if not WORDS:
        named = [row for row in some if not row[1].startswith("hint ")]
        check("at least 200 wrong answers", len(some) >= 200, len(some))
        check("nine of ten are named", len(named) >= 0.9 * len(some), (len(named), len(some)))
        tried = {f"{task.name} {name}" for task, names, _ in some for name in names.split("+")}
        missed = [f"{t.name} {m[0]}" for t in TASKS.values() for m in t.mistakes
                  if f"{t.name} {m[0]}" not in tried and t.name < "11"]
        check("wrong.txt has each known mistake of the tasks 01 to 10", not missed, missed)
        print(f"{len(some)} wrong answers, {len(named)} of them named")
    refused()
    for checks in (allowed, once, bases, loops, names, links):
        if wanted(checks.__name__):
            checks()
    subprocess.run(["rm", "-rf", str(FOLDER)], check=True)
    print(f"{COUNTS['passed']} passed, {COUNTS['failed']} failed")
    return COUNTS["failed"] > 0


if __name__ == "__main__":
    sys.exit(main())
