"""The process of a student's Python file: python3 -I -S student.py TASK ANSWER.py OUTPUTS INPUTS.

It reads inputs from a pipe, calls the student's function, and writes numbers to another pipe: for
each input a 1 and the answer, or a 0 where the function raises.  The judge keeps the right answers.
"""
import ast
import builtins
import math
import os
import resource
import signal
import struct
import sys
from types import SimpleNamespace as Fields

MEGABYTES = 256  # of memory, at most
PRINTED = 1 << 16  # bytes that a student's code may print
REFUSED = 3  # the exit status where the file is not run
NOBODY = 65534


def bound(megabytes, seconds, written):
    """Bounds what this process takes, and how large its files may be."""
    for what, most in ((resource.RLIMIT_AS, megabytes << 20), (resource.RLIMIT_CPU, seconds),
                       (resource.RLIMIT_FSIZE, written), (resource.RLIMIT_CORE, 0)):
        try:
            # A hard bound of time would kill without a word.
            resource.setrlimit(what, (most, most + (what == resource.RLIMIT_CPU)))
        except (ValueError, OSError):
            pass  # macOS has no bound of memory


def limit(seconds):
    """Bounds this process: its user, memory, time, files and children."""
    if os.geteuid() == 0:
        os.setgroups([])
        os.setgid(NOBODY)
        os.setuid(NOBODY)
    bound(MEGABYTES, seconds, PRINTED)
    resource.setrlimit(resource.RLIMIT_NPROC, (0, 0))
    signal.signal(signal.SIGXFSZ, signal.SIG_DFL)


def scene(f, v):
    """Calls iteration_four with fields of the names that shade.h has."""
    lamps = [Fields(position=[*q[0:3], 1.0], spot_direction=q[3:6], spot_cos_cutoff=q[6],
                    spot_exponent=q[7], ambient=q[8:11], diffuse=q[11:14], specular=q[14:17],
                    constant=q[17], linear=q[18], quadratic=q[19])
             for q in (v[at:at + 20] for at in range(26, 26 + 20 * int(v[25]), 20))]
    material = Fields(emission=v[9:12], ambient=v[12:15], diffuse=v[15:18], specular=v[18:21],
                      shininess=v[21])
    lighting = Fields(ambient=v[22:25], lights=lamps)
    return f.iteration_four(lighting, material, v[0:3], v[3:6], v[6:9])


def pixels(f, v):
    """Calls covers for each pixel of 8 x 8."""
    v = [int(x) for x in v]
    return [bool(f.covers(v[0:3], v[3:6], k % 8, k // 8)) for k in range(64)]


CALLS = {  # what a task's functions are called with, f by name, from the numbers v
    "01_lambert": lambda f, v: f.lambert(v[0:3], v[3:6]),
    "02_mirror": lambda f, v: f.mirror(v[0:3], v[3:6]),
    "03_highlight": lambda f, v: [f.halfway(v[3:6], v[6:9]), f.phong(v[0:3], v[3:6], v[6:9], v[9])],
    "04_attenuation": lambda f, v: f.attenuation(*v),
    "05_spot": lambda f, v: f.spot(v[0:3], v[3:6], v[6], v[7]),
    "06_normal_matrix": lambda f, v: f.normal_matrix(v[0:16]),
    "07_coverage": pixels,
    "08_depth": lambda f, v: f.depth_at(v[0:3], v[3:6], v[6:9]),
    "09_texture": lambda f, v: f.texture_at(v[0:3], [v[3:5], v[5:7], v[7:9]], v[9:12]),
    "10_iteration_four": scene,
}


class NoAnswer(TypeError):
    """There is no answer, although the student's code raises nothing."""


class Functions:
    """What a student's file defines."""

    def __init__(self, names):
        self.__dict__.update(names)

    def __getattr__(self, name):
        raise NoAnswer(f"has no function {name}")


def flat(answer):
    """Returns the numbers of an answer, which may be lists in lists."""
    if isinstance(answer, (list, tuple)):
        return [x for part in answer for x in flat(part)]
    if answer is None:
        raise NoAnswer("returns nothing: is a return missing?")
    if isinstance(answer, complex):
        raise NoAnswer("returns a complex number, a power or a root of a negative one")
    if not isinstance(answer, (int, float)):
        raise NoAnswer(f"returns a {type(answer).__name__}, which is no number")
    return [float(answer)]


ALLOWED = """abs all any bool dict divmod enumerate filter float int isinstance iter len list map
    max min next object pow print range repr reversed round set slice sorted str sum tuple zip
    True False None Exception ArithmeticError AssertionError IndexError KeyError
    NotImplementedError OverflowError RuntimeError StopIteration TypeError ValueError
    ZeroDivisionError __build_class__""".split()
HIDDEN = ("_", "gi_", "cr_", "ag_", "f_", "tb_", "co_", "format", "mro")


def forbidden(tree):
    """Returns a sentence where a file does what no answer needs, or None."""
    own = {node.id for node in ast.walk(tree)
           if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store)}
    own |= {getattr(node, "name", None) or getattr(node, "arg", None) for node in ast.walk(tree)}
    for node in ast.walk(tree):
        modules, attributes = [], [getattr(node, "attr", ""), *getattr(node, "kwd_attrs", [])]
        if isinstance(node, ast.Import):
            modules = [alias.name for alias in node.names]
        elif isinstance(node, ast.ImportFrom):
            modules, attributes = [node.module], [alias.name for alias in node.names]
        for name in modules:
            if name != "math":
                return f"Line {node.lineno} imports {name}. Import nothing but math."
        for name in attributes:
            if name.startswith(HIDDEN):
                return f"Line {node.lineno} reads the attribute {name}, which no answer needs."
        if isinstance(node, ast.Name) and node.id not in ALLOWED and node.id != "__name__":
            built_in = hasattr(builtins, node.id) and node.id not in own
            if built_in or node.id.startswith("__"):
                return f"Line {node.lineno} uses {node.id}, which no answer needs."
    return None


def just_math(name, *_):
    """Imports math, as a student's file does."""
    if name != "math":
        raise ImportError("Import nothing but math.")
    return math


def load(source, file):
    """Runs a student's file and returns its functions, or ends the process with a sentence."""
    try:
        tree = ast.parse(source, file)
        says = forbidden(tree)
    except (SyntaxError, ValueError, RecursionError, MemoryError) as error:
        says = f"The file cannot be read: {type(error).__name__}: {error}."
    if not says:
        names = {name: getattr(builtins, name) for name in ALLOWED}
        space = {"__builtins__": {**names, "__import__": just_math}, "__name__": "answer"}
        try:
            exec(compile(tree, file, "exec"), space)  # pylint: disable=exec-used
            return Functions(space)
        except BaseException as error:  # SystemExit too
            says = f"The file cannot be run: {type(error).__name__}: {error}."
    print(says, file=sys.stderr, flush=True)
    os._exit(REFUSED)


def reply(call, functions, numbers, outputs):
    """Returns a 1 and the answer to an input, or a 0; what is raised is told beside it."""
    try:
        answer = flat(call(functions, numbers))
        if len(answer) == outputs:
            return [1, *answer]
        says = f"returns {len(answer)} numbers, not {outputs}"
    except NoAnswer as error:
        says = str(error)
    except BaseException as error:  # whatever a student's function raises
        says = f"raises {type(error).__name__}: {str(error)[:200]}"
        says += ": a power is **" if "for ^" in says else ""
    os.write(2, f"\0{says}\0".encode())
    return [0] + outputs * [math.nan]


def main():
    """Answers until the pipe of inputs is at its end."""
    task, path, outputs, inputs, seconds = sys.argv[1], sys.argv[2], *map(int, sys.argv[3:6])
    with open(path, "rb") as file:
        source = file.read()
    answers, size = os.dup(1), 4 * inputs
    os.dup2(2, 1)
    limit(seconds)
    resource.setrlimit(resource.RLIMIT_NOFILE, (0, 0))
    functions = load(source, os.path.basename(path))
    pending = b""
    while True:
        more = os.read(0, 65536)
        if not more:
            break
        pending += more
        while len(pending) >= size:
            numbers = list(struct.unpack(f"{inputs}f", pending[:size]))
            pending = pending[size:]
            frame = reply(CALLS[task], functions, numbers, outputs)
            os.write(answers, struct.pack(f"{outputs + 1}d", *frame))
    sys.stdout.flush()


if __name__ == "__main__":
    main()
