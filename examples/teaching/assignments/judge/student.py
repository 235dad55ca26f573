"""The process of a student's Python file: python3 -I student.py TASK FILE OUTPUTS INPUTS PIPE.

It reads inputs from standard input, calls the student's function, and writes numbers to a pipe: for
each input a 1 and the answer, or a 0 where the function raises.  The judge keeps the right answers:
nothing of them is here.
"""
# What a file may import is loaded before files are closed: pylint: disable=unused-import
import cmath  # noqa: F401
import collections  # noqa: F401
import copy  # noqa: F401
import dataclasses  # noqa: F401
import functools  # noqa: F401
import importlib
import itertools  # noqa: F401
import math
import operator  # noqa: F401
import os
import random  # noqa: F401
import resource
import signal
import struct
import sys
import typing  # noqa: F401
from types import SimpleNamespace as Fields

REFUSED = 3  # the exit status where the file is not run


def hold():
    """From here on this process opens no file and starts no process, whatever its code is, and
    printing too much ends it."""
    signal.signal(signal.SIGXFSZ, signal.SIG_DFL)
    for what in (resource.RLIMIT_NPROC, resource.RLIMIT_NOFILE):
        resource.setrlimit(what, (0, 0))


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


def polygon(f, v):
    """Calls clip_near; returns how many corners are left, and four of them."""
    kept = [flat(corner) for corner in f.clip_near([v[0:4], v[4:8], v[8:12]])]
    numbers = [x for corner in kept[:4] for x in corner]
    return [len(kept)] + numbers + [0.0] * (16 - len(numbers))


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
    "11_barycentric": lambda f, v: f.color_at(v[0:3], v[3:6], [v[6:9], v[9:12], v[12:15]], *v[15:17]),
    "12_bilinear": lambda f, v: [f.level(*v[0:5]), f.bilinear(v[5:21], v[21], v[22])],
    "13_clip": polygon,
    "14_bump": lambda f, v: f.bumped(v[0:3], v[3:6], v[6:9]),
    "15_shadow": lambda f, v: bool(f.lit(v[0:16], v[16:32], v[32:35], v[35])),
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


def load(source, file):
    """Runs a student's file and returns its functions, or ends the process with a sentence."""
    space = {"__name__": "answer", "__file__": file}
    try:
        exec(compile(source, file, "exec"), space)  # pylint: disable=exec-used
        return Functions(space)
    except (SyntaxError, ValueError, RecursionError, MemoryError) as error:
        says = f"The file cannot be read: {type(error).__name__}: {error}."
    except BaseException as error:  # SystemExit too
        says = f"The file cannot be run: {told(error)}."
    print(says, file=sys.stderr, flush=True)
    os._exit(REFUSED)


def told(error):
    """Returns what was raised, in words."""
    text = f"{type(error).__name__}: {str(error)[:200]}"
    if isinstance(error, OSError):
        text += ": it can open no file, socket or other module here, and start no process"
    return text + (": a power is **" if "for ^" in text else "")


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
        says = f"raises {told(error)}"
    os.write(2, f"\0{says}\0".encode())
    return [0] + outputs * [math.nan]


def main():
    """Answers until the pipe of inputs is at its end."""
    task, path, outputs, inputs, answers = sys.argv[1], sys.argv[2], *map(int, sys.argv[3:6])
    call = CALLS.get(task)
    if task == "project":  # needs NumPy, which is loaded before files are closed
        os.environ["OPENBLAS_NUM_THREADS"] = "1"
        sys.path.insert(0, os.getcwd())
        call = importlib.import_module("scene").call
    with open(path, "rb") as file:
        source = file.read()
    size = 4 * inputs
    hold()
    functions = load(source, path)
    pending = b""
    while True:
        more = os.read(0, 1 << 20)
        if not more:
            break
        pending += more
        while len(pending) >= size:
            numbers = list(struct.unpack(f"{inputs}f", pending[:size]))
            pending = pending[size:]
            frame = memoryview(struct.pack(f"{outputs + 1}d", *reply(
                call, functions, numbers, outputs)))
            while frame:
                frame = frame[os.write(answers, frame):]
    sys.stdout.flush()


if __name__ == "__main__":
    main()
