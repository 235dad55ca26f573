"""shade_h: pictures of meshes without a GPU, a driver or a window, the same bytes on every machine.

    import shade_h
    shade_h.render("part.stl", edges=True).save("part.png")
"""
from . import elsewhere
from ._native import Error
from .camera import VIEWS, Camera, fitted
from .files import load
from .light import (PRESETS, Flag, Light, Lighting, Material, Model, Term, berkeley, light_at, lit,
                    massey, preset, shirley, shirley_surface, uw)
from .maps import assert_same_depth, assert_same_ids, open_depth, open_ids, save_depth, save_ids
from .mesh import Mesh, Surface
from .picture import Picture, assert_same
from .renderer import Frame, Renderer, Shape
from .scene import Part, Scene, export_png, render, sheet

__version__ = "1.4.0"
__all__ = ["Camera", "Error", "Flag", "Frame", "Light", "Lighting", "Material", "Mesh", "Model",
           "PRESETS", "Part", "Picture", "Renderer", "Scene", "Shape", "Surface", "Term", "VIEWS",
           "assert_same", "assert_same_depth", "assert_same_ids", "berkeley", "elsewhere", "export_png", "fitted",
           "light_at", "lit", "load", "massey", "open_depth", "open_ids", "preset", "render", "save_depth",
           "save_ids", "sheet", "shirley", "shirley_surface", "uw"]
