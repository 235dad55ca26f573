"""A student's code in a process of its own: built, started, given numbers and read numbers from.

The judge's process keeps inputs, right answers and results.  A student's process has two pipes of
numbers and a file for what it prints, in a room that bounds what it may do (room.py).  A C program
is linked from the student's file, student.c and the vectors of vectors.h: the answers are not in it.
"""
import os
import re
import select
import shlex
import shutil
import signal
import struct
import subprocess
import tempfile
import time
from pathlib import Path

from . import student
from .room import MEGABYTES, NoRoom, PRINTED, Room

HERE = Path(__file__).resolve().parent
PATIENCE = 10  # a busy machine takes this many times the seconds of the processor that are allowed
TOO_MUCH = "Your file is too much for the compiler: large arrays with values, or macros in macros?"
WARNINGS = 3  # of a compiler, that are shown
PROTOTYPES = HERE / "prototypes.h"
AT_ONCE = 50  # inputs in the pipe at a time, most: both pipes hold them, so neither side waits for ever
PIPE = 1 << 15  # bytes that any pipe holds
MADE = {}  # what compilers made of files of the grader
OPENED = 16  # files that a program opens where it is not linked statically: its libraries
ENDS = {
    signal.SIGSEGV: "crashed: an index beyond an array, a pointer to nothing, a recursion without "
                    "end, or more than 256 MB of memory",
    signal.SIGBUS: "crashed: a pointer to nothing, or an index beyond an array",
    signal.SIGFPE: "divided a whole number by 0",
    signal.SIGABRT: "called abort, or an assertion failed",
    signal.SIGKILL: "was stopped: it takes more than 256 MB of memory, or too much time",
    signal.SIGXCPU: "took too long: look for a loop that does not end",
    signal.SIGXFSZ: "printed more than 64 kB",
    signal.SIGILL: "crashed",
    signal.SIGTRAP: "crashed",
}




class Refused(Exception):
    """What was handed in cannot be judged; the sentence says why."""


def not_compiled(said, prototypes):
    """Returns what to say where a compiler stops, from what it says."""
    other = re.search(r"conflicting types for \W?(\w+)(?:(?!error:).)*prototypes\.h", said, re.S)
    if other:
        page = re.search(rf"^[\w ]+\b{other.group(1)}\(.*?\);", prototypes, re.M | re.S)
        return (f"Your function {other.group(1)} has other types than the page says: expected "
                f"{' '.join(page.group()[:-1].split())}.")
    errors = re.search(r"^[^\n]*error:.*?(?=^[^\n]*warning:|\Z)", said, re.M | re.S)
    return f"Your file does not compile:\n{(errors.group() if errors else said)[:2000]}"


def not_linked(said, prototypes):
    """Returns what to say where a linker stops, from what it says."""
    twice = re.search(r"multiple definition of \W?(\w+)|duplicate symbol '?_?(\w+)", said)
    if twice:
        return f"Your file has a function {twice.group(1) or twice.group(2)}, which the grader has too."
    missing = re.search(r"undefined reference to \W?(\w+)|\"_(\w+)\"", said)
    if not missing:
        return f"Your file cannot be linked:\n{said[:2000]}"
    name = missing.group(1) or missing.group(2)
    if re.search(rf"\b{name}\(", prototypes):
        return f"Your file has no function {name}."
    if name in ("max", "MAX", "min", "MIN"):
        return f"C has no {name}: use f{name.lower()}f of math.h."
    if name.startswith("shade_"):
        return (f"Your file calls {name}, which is not in vectors.h. If it is in shade.h, what it does "
                f"is yours to write; if not, is the name right?")
    return f"Your file calls {name}, which neither your file nor a header of C has."


class Compiler:
    """The C compiler of the machine, in a room."""

    def __init__(self, room):
        self.room, self.words = room, shlex.split(os.environ.get("CC", "cc"))
        found = shutil.which(self.words[0])
        if not found:
            raise Refused(f"There is no {self.words[0]}: a C compiler is needed.")
        self.home = Path(found).absolute().parent.parent
        room.put("vectors.h", (HERE.parent / "vectors.h").read_text(encoding="utf-8"))
        room.put("shade.h", '#include "vectors.h"\n')
        self.static = ["-static"]
        if self.ours("hold.c", "hold", *self.static):
            self.static = []  # there are no libraries for it, as on macOS
            said = self.ours("hold.c", "hold")
            if said:
                raise Refused(f"{self.words[0]} does not compile the grader's hold.c:\n{said[:2000]}")

    def ours(self, source, name, *arguments):
        """Compiles a file of the grader, once for all students of this process; returns what the
        compiler says, or nothing."""
        made, key = self.room.folder / name, (source, tuple(self.words), arguments)
        if key not in MADE:
            self.room.put(source, (HERE / source).read_text(encoding="utf-8"))
            status, said = self.run("-O1", "-w", "-I.", source, "-o", name, *arguments)
            if status:
                return said or "it ends without a word."
            MADE[key] = made.read_bytes()
        made.write_bytes(MADE[key])
        made.chmod(0o755)
        return ""

    def run(self, *arguments):
        """Runs the compiler; returns its exit status and what it says."""
        status, said = self.room.run([*self.words, "-std=gnu99", *arguments], self.home)
        beyond = (r"internal compiler error|\(program \w+\)|Killed|[Ff]ile too large|File size limit|"
                  r"out of memory|memory exhausted|Stack dump|cannot allocate")
        if status is None or status < 0 or status and re.search(beyond, said):
            raise Refused(TOO_MUCH)
        return status, said

    def build(self, path, number, prototypes):
        """Builds a student's file; returns warnings of it."""
        name = f"in/{path.name}"
        (self.room.folder / "in").mkdir(exist_ok=True)
        self.room.put(name, path.read_text(encoding="utf-8", errors="replace"))
        self.room.put("prototypes.h", prototypes)
        self.room.put("before.h", f"#define TASK {number}\n#include \"vectors.h\"\n"
                                  f"#include \"prototypes.h\"\n#undef TASK\n")
        status, said = self.run("-O0", "-Wall", "-Wextra", "-Wno-error=implicit-function-declaration",
                                "-I.", "-include", "before.h", "-c", f"./{name}", "-o", "answer.o")
        said = said.replace("./in/", "").replace(f"{self.room.folder}/", "")
        if status:
            raise Refused(not_compiled(said, prototypes))
        warnings = re.findall(rf"^{re.escape(path.name)}:\d+:\d+: warning: .*", said, re.M)
        said = self.ours("student.c", "student.o", f"-DTASK={number}", "-c")
        if said:
            raise Refused(f"{self.words[0]} does not compile the grader's student.c:\n{said[:2000]}")
        status, said = self.run("student.o", "answer.o", "-lm", "-o", "answer", *self.static)
        if status:
            raise Refused(not_linked(said, prototypes))
        return warnings


def one_file(path):
    """Returns the path of the C or Python file that is handed in, alone or in a folder."""
    found = sorted(path.iterdir()) if path.is_dir() else [path]
    found = [p for p in found if p.suffix in (".c", ".py") or not path.is_dir()]
    if len(found) != 1:
        raise Refused(f"Hand in one file, a .c or a .py: there are {len(found)}.")
    if not found[0].exists():
        raise Refused(f"There is no file {found[0].name}.")
    if not found[0].is_file() or found[0].suffix not in (".c", ".py"):
        raise Refused(f"{found[0].name} is no .c and no .py file.")
    if found[0].is_symlink():
        raise Refused(f"{found[0].name} is a link: hand in the file itself.")
    if found[0].stat().st_size > 1 << 16:
        raise Refused("Your file is longer than 64 kB.")
    return found[0].resolve()


class Student:
    """What a student handed in, ready to be given inputs."""

    megabytes, needs = MEGABYTES, ""  # of memory; modules of Python, as ", numpy"

    def __init__(self, task, path, inputs, outputs, seconds, room="auto"):
        self.inputs, self.outputs, self.seconds = inputs, outputs, seconds
        self.warnings, self.printed, self.late = [], "", False
        path = one_file(Path(path))
        try:
            self.room = Room(room)
            self.prepare(task, path)
        except NoRoom as no:
            raise Refused(str(no)) from no
        self.room.close()

    def prepare(self, task, path):
        """Builds the program, or brings the files of a Python program to the room."""
        self.system, self.home = path.suffix == ".py", None
        if path.suffix == ".py":
            python, self.home = self.room.python(self.needs)
            self.room.put("student.py", (HERE / "student.py").read_text(encoding="utf-8"))
            self.room.put(path.name if path.name != "student.py" else "answer.py",
                          path.read_text(encoding="utf-8", errors="replace"))
            name = path.name if path.name != "student.py" else "answer.py"
            self.command = [*python, "student.py", task, name, str(self.outputs), str(self.inputs)]
            return
        compiler = Compiler(self.room)
        self.warnings = compiler.build(path, *self.declared(task))
        self.command = ["./hold", "0" if compiler.static else str(OPENED), "./answer"]
        self.system = not compiler.static

    def declared(self, task):
        """Returns the number that student.c has for a task, and the declarations of its functions."""
        return int(task[:2]), PROTOTYPES.read_text(encoding="utf-8")

    def notes(self):
        """Returns what costs no points: warnings of the compiler, and what the file prints."""
        said, more = self.warnings[:WARNINGS], len(self.warnings) - WARNINGS
        said = ["Your compiler warns:", *said] if said else []
        if more > 0:
            said.append(f"and {more} more.")
        if self.printed:
            said.append(f"Your file prints, which the grader does not read: {self.printed[:500]}")
        return "\n".join(said)

    def read(self, pipe, size, until):
        """Returns so many bytes, or fewer where the process ends or its time is up."""
        got = b""
        while len(got) < size:
            if not select.select([pipe], [], [], max(0, until - time.monotonic()))[0]:
                break
            more = os.read(pipe, size - len(got))
            if not more:
                break
            got += more
        return got

    def ask(self, inputs):
        """Returns the answers of a new process to inputs, None where the function raised, and a
        sentence: what it raised, or why the process ended before the last answer.  After a process
        that takes too long it starts no other and returns nothing."""
        if self.late:
            return [], ""
        answers, frame = [], struct.Struct(f"{1 + self.outputs}d")
        some = max(1, min(AT_ONCE, PIPE // max(frame.size, 4 * self.inputs)))
        pipe, theirs = os.pipe()
        with tempfile.TemporaryFile() as printed:
            child = self.room.start([*self.command, str(theirs)], (self.megabytes, self.seconds, PRINTED),
                                    system=self.system, home=self.home, stdin=subprocess.PIPE,
                                    stdout=printed, stderr=printed, bufsize=0, pass_fds=[theirs])
            os.close(theirs)
            until = time.monotonic() + PATIENCE * self.seconds
            try:
                for at in range(0, len(inputs), some):
                    sent = inputs[at:at + some]
                    child.stdin.write(b"".join(struct.pack(f"{self.inputs}f", *v) for v in sent))
                    got = self.read(pipe, frame.size * len(sent), until)
                    for k in range(len(got) // frame.size):
                        good, *numbers = frame.unpack_from(got, k * frame.size)
                        answers.append(numbers if good == 1 else None)
                    if len(got) < frame.size * len(sent):
                        break
                child.stdin.close()
            except BrokenPipeError:
                pass
            ended = self.room.end(child, until if len(answers) < len(inputs) else 0)
            child.stdin.close()
            os.close(pipe)
            printed.seek(0)
            said = printed.read(2 * PRINTED).decode(errors="replace")
        raised = re.findall(r"\0(.*?)\0", said, re.S)
        said = re.sub(r"\0.*?\0", "", said, flags=re.S)
        if len(answers) == len(inputs):
            self.printed = self.printed or said.strip()
            return answers, raised[0] if raised else ""
        if ended == student.REFUSED and not answers:
            raise Refused(said.strip() or "The program ended before its first answer.")
        self.late = ended in (None, -signal.SIGXCPU)
        return answers, self.why(ended)

    def why(self, ended):
        """Returns what the end of a process says, in a sentence without its subject."""
        if ended is None:
            return f"did not come back: {ENDS[signal.SIGXCPU]}"
        if ended >= 0:
            return "ended the program itself, as exit does"
        return ENDS.get(-ended, f"was ended by signal {-ended}")
