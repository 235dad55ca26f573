"""Point clouds as small balls."""
from __future__ import annotations

import warnings
from typing import Any

import numpy as np

from . import _arguments as arguments
from ._native import Array, Doubles

MOST = 500_000    # points; of more, every second, third, ... is drawn
_CORNERS = np.array([[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1.0]])
_FACES = np.array([[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4], [2, 0, 5], [1, 2, 5], [3, 1, 5],
                   [0, 3, 5]])


def balls(points: object, options: dict[str, Any],
          about: str = "") -> tuple[Doubles, Array, dict[str, Any]]:
    """Vertices, faces and options of Mesh that show points as octahedra, shaded as balls, of a
    radius that follows from their number: 0.4 of the distance between as many on a square as large
    as the box around them.  A warning says so; about stands before it."""
    given = arguments.array("points", points, (None, 3)).astype(np.float64)
    step = max(1, -(-len(given) // MOST))
    with np.errstate(invalid="ignore"):
        good = np.flatnonzero((np.abs(given) <= 1e30).all(1))[::step]
    kept = given[good]
    extent = float(np.linalg.norm(np.ptp(kept, 0))) if len(kept) else 0.0
    radius = extent * min(0.02, max(0.001, 0.3 / max(len(kept), 1) ** 0.5)) or 1.0
    every = "" if step == 1 else f", one of {step}"
    warnings.warn(f"{about}{len(given)} points have no faces: they are drawn as small balls of radius "
                  f"{radius:.3g}{every}", stacklevel=4)
    vertices = (kept[:, None] + radius * _CORNERS).reshape(-1, 3)
    faces = (np.arange(len(kept))[:, None, None] * 6 + _FACES).reshape(-1, 3)
    out = {"normals": np.tile(_CORNERS, (len(kept), 1)), **options}
    for name in ("color", "scalars"):
        value = options.get(name)
        if value is not None and not isinstance(value, str) and len(np.shape(value)) and \
                len(np.asarray(value)) == len(given):
            out[name] = np.repeat(np.asarray(value)[good], 6, 0)
    return vertices, faces, out
