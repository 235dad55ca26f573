"""shade-h part.stl sheet.png --views front,right,top,iso; python -m shade_h is the same."""
from __future__ import annotations

import argparse
import sys
from typing import Any

from . import Error, load, render, sheet
from .camera import UPRIGHT


def viewpoint(words: Any) -> Any:
    """A side by its name, or azimuth and elevation; what is no text as it is."""
    if not isinstance(words, str):
        return words
    try:
        azimuth, elevation = (float(word) for word in words.split(","))
    except ValueError:
        return words
    return azimuth, elevation


def main(words: list[str] | None = None) -> int:
    """Draws a file of a model.  Returns the status of the process."""
    parser = argparse.ArgumentParser(prog="shade-h", description=main.__doc__)
    parser.add_argument("model", help="STL, OBJ, PLY, OFF, GLB, glTF or 3MF")
    parser.add_argument("picture", help="a name that ends in .png or .ppm")
    parser.add_argument("--views", default="iso", help="front,right,back,left,top,bottom,iso")
    parser.add_argument("--view", default=None,
                        help="one of these, or azimuth,elevation in degrees: --view=30,20")
    parser.add_argument("--size", default="640x480", help="of each view, WxH")
    parser.add_argument("--color", default=None, help="#RRGGBB or a name")
    parser.add_argument("--no-edges", action="store_true", help="shaded faces alone")
    parser.add_argument("--up", default=None, choices=list(UPRIGHT),
                        help="the upright axis; that of the file where it is not said")
    parser.add_argument("--section", default=None,
                        help="x, y or z: cuts the model open there; x=12 says where")
    parser.add_argument("--light", default="quick", choices=["quick", "studio"],
                        help="studio: soft shadows, which take longer")
    parser.add_argument("--samples", type=int, default=3, help="1 .. 8")
    o, more = parser.parse_known_args(words)
    if any(word.startswith("-") for word in more):
        parser.error(f"unknown option {' '.join(more)} (--help lists them)")
    if more or not o.picture.lower().endswith((".png", ".ppm")):
        models = (".stl", ".obj", ".ply", ".off", ".glb", ".3mf")
        several = more or o.picture.lower().endswith(models)
        print("shade-h: " + (
            "one model and one picture: shade_h.sheet([...]) draws several" if several else
            f"the picture must end in .png or .ppm, not {o.picture!r}"), file=sys.stderr)
        return 2
    try:
        size = tuple(int(n) for n in o.size.split("x"))
        mesh = load(o.model, **({"color": o.color} if o.color else {}))
        if not len(mesh.faces):
            raise Error(f"{o.model} has no triangles")
        section = None if o.section is None else tuple(
            k if i == 0 else float(k) for i, k in enumerate(o.section.split("=")))
        section = section[0] if section is not None and len(section) == 1 else section
        edges = not o.no_edges
        views: Any = o.views.split(",") if o.view is None else [viewpoint(o.view)]
        if len(views) == 1:
            picture = render(mesh, view=views[0], size=size, samples=o.samples, up=o.up,
                             edges=edges, section=section, light=o.light)
        else:
            picture = sheet(mesh, views, size=size, samples=o.samples, up=o.up, edges=edges,
                            section=section, light=o.light)
        picture.save(o.picture)
    except (Error, OSError, ValueError) as why:
        print(f"shade-h: {why}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
