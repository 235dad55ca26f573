#!/usr/bin/env python3
"""Tests of what holds a student's program, by programs that do no harm: each gives the right answer
and tries one thing that it may not do.  It gets its points, and what it tried is told.

    python3 guards.py ASSIGNMENTS [ROOM]

ASSIGNMENTS is the folder of the judge, ROOM is bubblewrap or plain.  It works as root and as a user.
"""
import os
import re
import sys
import tempfile
from pathlib import Path

sys.dont_write_bytecode = True
ASSIGNMENTS, ROOM = Path(sys.argv[1]).resolve(), sys.argv[2]
sys.path.insert(0, str(ASSIGNMENTS))
from judge.points import Judge, Task  # noqa: E402
from judge.process import Refused, Student  # noqa: E402
from judge.room import nobody  # noqa: E402

SEED = "81526354"
COUNTS = {"passed": 0, "failed": 0}
ROOT = os.geteuid() == 0
FOLDER = Path(tempfile.mkdtemp())
SECRET = FOLDER / "secret"  # what only the judge may read
SECRET.write_text(SEED, encoding="utf-8")
SECRET.chmod(0o600)
os.environ["SEED_OF_THE_CLASS"] = SEED


def check(name, good, says=""):
    """Counts a check, and tells of one that fails."""
    COUNTS["passed" if good else "failed"] += 1
    if not good:
        print(f"FAIL      {ROOM}, {'root' if ROOT else 'user'}: {name}\n    {str(says)[:1200]}")


def judged(language, text):
    """Returns points, sentences and notes of a file that is handed in for Lambert's law."""
    path = FOLDER / f"tried.{language}"
    path.write_text(text, encoding="utf-8")
    task = Task("01_lambert")
    try:
        one = Student(task.name, path, task.sent, task.outputs, 5, ROOM)
        results = Judge(task, SEED).judge(one.ask)
    except Refused as refused:
        return 0, str(refused), ""
    return sum(r.score for r in results), "\n".join(r.says for r in results), one.notes()


HEADERS = "".join(f"#include <{name}.h>\n" for name in (
    "errno fcntl signal stdio stdlib string unistd sys/resource sys/socket sys/wait".split()))
ANSWER = "float lambert(shade_vec3 N, shade_vec3 L) { %s return fmaxf(0, shade_dot(N, L)); }\n"
# What is tried, in C: an expression that is true where it comes off
TRIED = {
    "opens a file of the system": 'open("/etc/passwd", O_RDONLY) >= 0',
    "opens a file of the judge": f'open("{ASSIGNMENTS}/judge/01_lambert.py", O_RDONLY) >= 0',
    "opens a file with a secret": f'open("{SECRET}", O_RDONLY) >= 0',
    "opens a file in place of one that it closed": '(close(0), open("/etc/passwd", O_RDONLY)) >= 0',
    "writes a file": f'open("{FOLDER}/results.json", O_WRONLY | O_CREAT, 0666) >= 0',
    "opens a socket": "socket(AF_UNIX, SOCK_STREAM, 0) >= 0",
    "starts a process": "({ int p = fork(); if (!p) _exit(0); p > 0; })",
    "starts a shell": 'system("exit 7") == 7 << 8',
    "raises its bounds": "({ struct rlimit r = { 9, 9 }; setrlimit(RLIMIT_NOFILE, &r) == 0; })",
    "takes 300 MB": "({ char *volatile p = malloc(300 << 20); p != NULL; })",
    "finds the seed in its environment": 'getenv("SEED_OF_THE_CLASS") != NULL',
}
AS_ROOT = {
    "becomes root": "setuid(0) == 0",
    "may signal the judge": "kill(getppid(), 0) == 0 && getppid() > 1 && getuid() != %d" % nobody(),
}
# Those that close what they read from end early; they need not answer.
ENDS = "opens a file in place of one that it closed",
ONCE = 'static int told; if (!told++) puts((%s) ? "it came off" : "it did not");'
TWICE = ('static int told; if (!told++) { puts((%s) ? "it came off" : "it did not"); '
         'puts(early ? "before main it came off" : "before main not"); }')
EARLY = ('static int early; __attribute__((constructor)) static void before(void) { early = (%s); }\n')


def tried_in_c():
    """In the function, and before main."""
    for name, what in {**TRIED, **(AS_ROOT if ROOT else {})}.items():
        early = "0" if name in ENDS else what
        score, says, notes = judged("c", HEADERS + '#include "vectors.h"\n' + EARLY % early +
                                    ANSWER % (TWICE % what))
        told = notes + says
        full = score == 10 or name in ENDS
        check(f"a program that {name} gets its points", full, (score, says))
        check(f"a program that {name} is told", name in ENDS or "it did not" in told, told)
        check(f"a program that {name} does not", "it came off" not in told, told)
        if name not in ENDS:
            check(f"one that {name} before main does not", "before main not" in notes, notes)


IN_PYTHON = {
    "opens a file of the system": "open('/etc/passwd')",
    "opens a file of the judge": f"open('{ASSIGNMENTS}/judge/01_lambert.py')",
    "opens a file with a secret": f"open('{SECRET}')",
    "writes a file": f"open('{FOLDER}/results.json', 'w')",
    "opens a socket": "__import__('_socket').socket()",
    "starts a process": "(os.fork() or os._exit(0))",
    "starts a shell": "os.posix_spawn('/bin/true', ['true'], {})",
    "finds the seed in its environment": "os.environ['SEED_OF_THE_CLASS']",
    "finds the answers": "__import__('judge.points')",
}


def tried_in_python():
    """In the function, and as the file is read."""
    body = "    return max(0, sum(n * l for n, l in zip(N, L)))\n"
    for name, what in IN_PYTHON.items():
        now, early = (f"    try:\n        {what}\n        print('it came off')\n"
                      f"    except BaseException as e:\n        print('{when}', type(e).__name__)\n"
                      for when in ("it did not", "at once not"))
        score, says, notes = judged("py", f"import os\nif True:\n{early}\ndef lambert(N, L):\n{now}{body}")
        for when, told in (("", "it did not"), (" at once", "at once not")):
            good = score == 10 and told in notes and "it came off" not in notes
            check(f"Python that {name}{when} does not, and gets its points", good,
                  (score, says, notes))


def who():
    """Where the judge is root the program is nobody; nothing that it is started with is a secret."""
    score, says, notes = judged("c", HEADERS + '#include "vectors.h"\n' + ANSWER % (
        'static int told; if (!told++) printf("user %d\\n", (int)getuid());'))
    user = nobody() if ROOT else os.getuid()
    check("a program that prints its user gets its points", score == 10, says)
    check("its user is " + ("nobody" if ROOT else "that of the judge"), f"user {user}\n" in f"{notes}\n",
          notes)
    score, says, notes = judged("py", "import os, sys\ndef lambert(N, L):\n    print('user',"
                                " os.getuid(), sys.orig_argv, dict(os.environ))\n    return 0\n")
    check("in Python too", f"user {user} " in notes, notes)
    check("neither its arguments nor its environment have the seed", "student.py" in notes and
          SEED not in notes + says, notes)


def called():
    """The answers are not in the program: a call of one is no program, a weak one is nothing."""
    score, says, _ = judged("c", '#include "vectors.h"\nfloat shade_lambert(shade_vec3, shade_vec3);\n'
                            "float lambert(shade_vec3 N, shade_vec3 L) { return shade_lambert(N, L); }")
    check("a call of an answer by name gets no points, and a sentence", score == 0 and
          "shade_lambert, which is not in vectors.h" in says, says)
    score, says, notes = judged("c", '#include "vectors.h"\n#include <stdio.h>\n'
                                "__attribute__((weak)) float shade_lambert(shade_vec3, shade_vec3);\n" +
                                ANSWER % (ONCE % "shade_lambert != NULL"))
    check("there is no answer to be called", score == 10 and "it did not" in notes, (says, notes))
    score, says, _ = judged("c", '#include "vectors.h"\n#define shade_dot shade_lambert\n' +
                            ANSWER % "")
    check("nor by another name", score == 0 and "shade_lambert" in says, says)


def compiler():
    """The compiler runs in the room as well: what only the judge may read it cannot include."""
    if not ROOT and ROOM == "plain":
        print("left out  the compiler's files: it is the judge's own user")
        return
    score, says, _ = judged("c", f'#include "{SECRET}"\n#include "vectors.h"\n' + ANSWER % "")
    check("a compiler does not read the judge's files", score == 0 and SEED not in says and
          re.search("No such file|Permission denied|cannot open|not found", says), says)


def main():
    """Runs all checks."""
    for checks in (who, called, compiler, tried_in_c, tried_in_python):
        checks()
    for path in FOLDER.iterdir():
        path.unlink()
    FOLDER.rmdir()
    print(f"{COUNTS['passed']} passed, {COUNTS['failed']} failed")
    return COUNTS["failed"] > 0


if __name__ == "__main__":
    sys.exit(main())
