"""A student's code in a process of its own: built, bounded, given numbers and read numbers from.

The judge's process keeps inputs, right answers and results.  A student's process has two pipes of
numbers and a file for what it prints.  It can open no file and start no process, it may use 256 MB
and a few seconds, and where the judge is root, as it is at Gradescope, its user is nobody.
"""
import os
import re
import select
import shlex
import signal
import struct
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from . import student

HERE = Path(__file__).resolve().parent
ROOT = next(folder for folder in HERE.parents if (folder / "shade.h").is_file())
PATIENCE = 10  # a busy machine takes this many times the seconds of the processor that are allowed
BUILD = 2048, 30, 16 << 20  # megabytes, seconds and bytes of a file, for a compiler
TOO_MUCH = "Your file is too much for the compiler: large arrays with values, or macros in macros?"
WARNINGS = 3  # of a compiler, that are shown
PROTOTYPES = HERE / "prototypes.h"
AT_ONCE = 50  # inputs in the pipe at a time: both pipes hold them, so neither side waits for ever

HEADERS = "assert float inttypes limits math stdbool stddef stdint stdio stdlib string".split()
# What a C file may call, beside its own functions, and the inline functions that are the task
CALLS = re.compile(r"""_*(?:(?:a?(?:sin|cos|tan)h?|atan2|exp2?|expm1|log(?:10|2|1p)?|pow|sqrt|cbrt
    |hypot|f?abs|fmod|remainder|floor|ceil|l?l?r(?:ound|int)|trunc|nearbyint|fm(?:in|ax|a)
    |fdim|copysign|nan|ldexp|frexp|modf|scalbl?n|isnan|isinf|finite|fpclassify|signbit)[fl]?
    |mem(?:cpy|set|move|cmp)|f?printf|f?puts|f?putc|putchar|fwrite|perror|fflush|std(?:out|err)p?
    |malloc|calloc|realloc|free|abort|exit|assert_fail|assert_rtn|stack_chk_\w+
    |GLOBAL_OFFSET_TABLE_|shade_mat[34]_(?!inverse_transpose)\w+)(?:_chk)?$""",
                   re.VERBOSE)
OURS = "main read write dup dup2 setrlimit setvbuf".split()  # what student.c has or calls
POISON = "shade_reflect shade_mirror shade_halfway shade_mat3_inverse_transpose"
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


def c_tokens(source):
    """Returns C without comments and strings.  A quote without its second one ends with the line, as
    compilers have it."""
    parts = r"/\*(?:.*?\*/|.*)|//[^\n]*|\"(?:\\.|[^\"\\\n])*(?:\"|$)|'(?:\\.|[^'\\\n])*(?:'|$)"
    kept = '"shade.h"'
    return re.sub(parts, lambda m: kept if m.group() == kept else " ", source, flags=re.S | re.M)


def check_c(source):
    """Refuses a C file that could reach past the function that it is to write."""
    source = re.sub(r"\\\s*\n", "", source)  # joins split lines
    if re.search(r'\b(?:u8|[uUL])?R"', source):
        raise Refused('Your file uses R", a string of C++, which no answer needs.')
    text = c_tokens(source)
    for directive in re.findall(r"^\s*(?:#|%:|\?\?=)\s*(.*)", text, re.M):
        if not re.match(r"(define|undef|ifn?(def)?|elif|else|endif|error|include)\b|$", directive):
            raise Refused(f"Your file has a line #{directive.strip()}, which no answer needs.")
        allowed = r'include\s*("shade\.h"|<shade\.h>|<(%s)\.h>)\s*$' % "|".join(HEADERS)
        if directive.startswith("include") and not re.match(allowed, directive):
            raise Refused(f"Your file has a line #{directive.strip()}. Include shade.h and headers "
                          f"like math.h alone.")
    words = r"asm|__asm\w*|__attribute\w*|_Pragma|__pragma|(?:shade|SHADE)_{2}\w+"
    for word in re.findall(rf"##|%:%:|\[\[|\b(?:{words})\b", text):
        raise Refused(f"Your file uses {word}, which no answer needs.")


def run_tool(*command):
    """Runs a compiler or the like within bounds; returns its exit status and what it says."""
    try:
        done = subprocess.run(command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, check=False, timeout=120,
                              env={**os.environ, "LC_ALL": "C"},
                              preexec_fn=lambda: student.bound(*BUILD))
    except FileNotFoundError as error:
        raise Refused(f"There is no {command[0]}: a C compiler and nm are needed.") from error
    except subprocess.TimeoutExpired as error:
        raise Refused(TOO_MUCH) from error
    said = done.stdout.decode(errors="replace")
    beyond = r"signal|Killed|too large|memory|limit exceeded|Stack dump"
    if done.returncode and re.search(beyond, said):
        raise Refused(TOO_MUCH)
    return done.returncode, said


def not_compiled(said):
    """Returns what to say where a compiler stops, from what it says."""
    if poisoned := re.search(r"poisoned \W?(\w+)", said):
        return f"Your file uses {poisoned.group(1)}: what it does is yours to write."
    other = re.search(r"conflicting types for \W?(\w+)(?:(?!error:).)*prototypes\.h", said, re.S)
    if other:
        page = re.search(rf"^[\w ]+\b{other.group(1)}\(.*?\);", PROTOTYPES.read_text(), re.M | re.S)
        return (f"Your function {other.group(1)} has other types than the page says: expected "
                f"{' '.join(page.group()[:-1].split())}.")
    errors = re.search(r"^[^\n]*error:.*?(?=^[^\n]*warning:|\Z)", said, re.M | re.S)
    return f"Your file does not compile:\n{(errors.group() if errors else said)[:2000]}"


def build_c(task, path, folder):
    """Compiles a student's C file in a folder; returns the command that runs it, and warnings."""
    source = path.read_text(encoding="utf-8", errors="replace")
    check_c(source)
    cc = [*shlex.split(os.environ.get("CC", "cc")), "-std=gnu99", "-O0", f"-DTASK={int(task[:2])}"]
    made, library, copy = folder / "answer.o", [], folder / path.name
    copy.write_text(source, encoding="utf-8")
    (folder / "shade.h").write_text("/* Stands before the file already. */\n", encoding="utf-8")
    poison = folder / "poison.h"
    poison.write_text(f"#undef TASK\n#pragma GCC poison {POISON}\n", encoding="utf-8")
    before = [f"-I{folder}", *(f"-include{h}" for h in (ROOT / "shade.h", PROTOTYPES, poison))]
    status, said = run_tool(*cc, "-Wall", "-Wextra", *before, "-c", str(copy), "-o", str(made))
    said = said.replace(f"{folder}/", "").replace(f"{HERE}/", "")
    if status:
        raise Refused(not_compiled(said))
    warnings = re.findall(rf"^{re.escape(path.name)}:\d+:\d+: warning: .*", said, re.M)
    symbols = re.findall(r"(\w) (\S+)$", run_tool("nm", str(made))[1], re.M)
    called = [name for kind, name in symbols if kind == "U"]
    for kind, name in symbols:
        if kind != "U" and name.lstrip("_") in OURS:
            raise Refused(f"Your file has a function {name.lstrip('_')}, which the grader has too.")
    for name in called:
        if not CALLS.match(name):
            name = name.lstrip("_")
            if "shade_" in name and not re.search(rf"\b{name}\(", (ROOT / "shade.h").read_text()):
                raise Refused(f"shade.h has no function {name}: is the name right?")
            if name in ("max", "MAX", "min", "MIN"):
                raise Refused(f"C has no {name}: use f{name.lower()}f of math.h.")
            why = "what it does is yours to write" if "shade_" in name else "no answer needs it"
            raise Refused(f"Your file calls {name}: {why}.")
    if any("shade_" in name for name in called):
        library = ["-DSHADE_IMPLEMENTATION", "-DSHADE_NO_DISPATCH"]
    status, said = run_tool(*cc, "-w", *library, f"-I{ROOT}", str(HERE / "student.c"), str(made),
                            "-lm", "-o", str(folder / "answer"))
    if status:
        missing = re.search(r"(?:undefined reference to|\"_)\W*(\w+)", said)
        raise Refused(f"Your file has no function {missing.group(1)}." if missing else
                      f"Your file cannot be linked:\n{said[:2000]}")
    folder.chmod(0o711)
    return [str(folder / "answer")], warnings


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
    if found[0].is_symlink():  # to what, compilers would tell
        raise Refused(f"{found[0].name} is a link: hand in the file itself.")
    if found[0].stat().st_size > 1 << 16:
        raise Refused("Your file is longer than 64 kB.")
    return found[0].resolve()


class Student:
    """What a student handed in, ready to be given inputs."""

    def __init__(self, task, path, inputs, outputs, seconds):
        self.inputs, self.outputs, self.seconds = inputs, outputs, seconds
        self.warnings, self.printed, self.late = [], "", False
        self.folder, self.bound, path = tempfile.TemporaryDirectory(), None, one_file(Path(path))
        if path.suffix == ".py":
            self.command = [sys.executable, "-I", "-S", "-B", str(HERE / "student.py"), task,
                            str(path), str(outputs), str(inputs), str(seconds)]
        else:
            self.command, self.warnings = build_c(task, path, Path(self.folder.name))
            self.bound = lambda: student.limit(seconds)

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
            more = os.read(pipe.fileno(), size - len(got))
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
        with tempfile.TemporaryFile() as printed:
            child = subprocess.Popen(self.command, stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                                     stderr=printed, cwd="/", env={}, bufsize=0,
                                     start_new_session=True, preexec_fn=self.bound)
            until = time.monotonic() + PATIENCE * self.seconds
            try:
                for at in range(0, len(inputs), AT_ONCE):
                    some = inputs[at:at + AT_ONCE]
                    child.stdin.write(b"".join(struct.pack(f"{self.inputs}f", *v) for v in some))
                    got = self.read(child.stdout, frame.size * len(some), until)
                    for k in range(len(got) // frame.size):
                        good, *numbers = frame.unpack_from(got, k * frame.size)
                        answers.append(numbers if good == 1 else None)
                    if len(got) < frame.size * len(some):
                        break
                child.stdin.close()
            except BrokenPipeError:
                pass
            ended = self.end(child, until if len(answers) < len(inputs) else 0)
            printed.seek(0)
            said = printed.read().decode(errors="replace")
        raised = re.findall(r"\0(.*?)\0", said, re.S)
        said = re.sub(r"\0.*?\0", "", said, flags=re.S)
        if len(answers) == len(inputs):
            self.printed = self.printed or said.strip()
            return answers, raised[0] if raised else ""
        if ended == student.REFUSED and not answers:
            raise Refused(said.strip() or "The program ended before its first answer.")
        self.late = ended in (None, -signal.SIGXCPU)
        return answers, self.why(ended)

    def end(self, child, until):
        """Waits until a process ends, a second longer than its time at most; returns its status."""
        try:
            status = child.wait(max(1, until - time.monotonic()))
        except subprocess.TimeoutExpired:
            status = None
        try:
            os.killpg(child.pid, signal.SIGKILL)
        except (ProcessLookupError, PermissionError):
            pass
        child.wait()
        for pipe in (child.stdin, child.stdout):
            pipe.close()
        return status

    def why(self, ended):
        """Returns what the end of a process says, in a sentence without its subject."""
        if ended is None:
            return f"did not come back: {ENDS[signal.SIGXCPU]}"
        if ended >= 0:
            return "ended the program itself, as exit does"
        return ENDS.get(-ended, f"was ended by signal {-ended}")
