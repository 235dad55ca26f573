"""Materials of other programs, by their own names:

    shade_h.render("part.stl", look=shade_h.elsewhere.vtk(specular=0.5, power=30))

Each program of PROGRAMS is a function, whose numbers are those of its row; what is left out has the
program's default.  What they mean is measured: examples/elsewhere/README.md.
"""
from __future__ import annotations

import ctypes
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from . import _arguments as arguments
from ._native import Error, library, pointer
from ._native import Material as NativeMaterial
from .light import Flag, Material, Model, unpacked


@dataclass(frozen=True)
class Look:
    """A material, and the model and flags of the light it is meant for."""

    material: Material
    model: Model
    flags: Flag


def _rows() -> dict[str, str]:
    rows: dict[str, str] = {}
    numbers = ctypes.c_char_p()
    while name := library.python_look_name(len(rows), ctypes.byref(numbers)):
        rows[name.decode()] = (numbers.value or b"").decode()
    return rows


PROGRAMS = _rows()
"""The programs, each with its numbers and their defaults"""


def look(text: str) -> Look:
    """The look of text such as "vtk(specular=.5, power=30)"."""
    if not isinstance(text, str):
        raise Error(f"look must be a shade_h.elsewhere.Look or text, not {arguments.shown(text)}")
    material, lit = NativeMaterial(), np.zeros(2, np.uint32)
    said = ctypes.create_string_buffer(400)
    if library.python_look(text.encode(), ctypes.byref(material), pointer(lit), said, 400):
        raise Error(f"look: {said.value.decode(errors='replace')}")
    return Look(unpacked(material), Model(int(lit[0])), Flag(int(lit[1])))


def _written(name: str, value: object) -> str:
    """A number, or numbers with commas"""
    row = value if isinstance(value, (tuple, list, np.ndarray)) else (value,)
    return ",".join(f"{arguments.number(name, x, -1e9, 1e9):.9g}" for x in row)


def __getattr__(name: str) -> Callable[..., Look]:
    if name not in PROGRAMS:
        raise AttributeError(f"no program is named {name!r}; there are {', '.join(PROGRAMS)}")

    def of_program(**numbers: object) -> Look:
        words = " ".join(f"{k}={_written(k, v)}" for k, v in numbers.items())
        return look(f"{name}({words})")

    of_program.__name__ = name
    of_program.__doc__ = f"The look of {name}({PROGRAMS[name]})."
    return of_program


def __dir__() -> list[str]:
    return sorted([*globals(), *PROGRAMS])
