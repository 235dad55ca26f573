"""Materials, lamps and the equations of light, over arrays of any length.

All colours here are linear light.  N, L, V and H of the equations point away from the surface.
"""
from __future__ import annotations

import ctypes
import enum
import math
from dataclasses import dataclass, field, replace
from typing import Sequence, Union

import numpy as np

from . import _arguments as arguments
from ._native import Error, Floats, library, pointer
from ._native import Light as NativeLight, Lighting as NativeLighting, Material as NativeMaterial

Vector = Union[Sequence[float], Floats]
BLACK = (0.0, 0.0, 0.0)
WHITE = (1.0, 1.0, 1.0)


class Model(enum.IntEnum):
    """Which equation surfaces answer with."""

    BLINN_PHONG = 0
    PHONG = 1
    LAMBERT = 2
    AMBIENT = 3
    EMISSIVE = 4
    COOL_TO_WARM = 5


class Flag(enum.IntFlag):
    """Changes of the equation."""

    NONE = 0
    TWO_SIDED = 1
    TWO_SIDED_ABS = 2
    UNGATED_SPECULAR = 4
    WEIGHTED_SPECULAR = 8
    ATTENUATED_AMBIENT = 16
    INFINITE_VIEWER = 32


class Term(enum.IntFlag):
    """Terms of the equation; ALL is all of them."""

    ALL = 0
    EMISSION = 1
    AMBIENT = 2
    DIFFUSE = 4
    SPECULAR = 8


def _vector(name: str, value: object, length: int = 3) -> tuple[float, ...]:
    return tuple(float(x) for x in arguments.floats(name, value, (length,), finite=True))


def _way(name: str, value: object) -> tuple[float, ...]:
    way = _vector(name, value)
    if math.hypot(*way) < 1e-18:    # whose square is no float
        raise Error(f"{name} must not be zero: it is a direction")
    return way


@dataclass(frozen=True)
class Material:
    """k_e, k_a, k_d, k_s and n of a surface."""

    emission: Vector = BLACK
    ambient: Vector = WHITE
    diffuse: Vector = WHITE
    specular: Vector = BLACK
    shininess: float = 0.0

    def native(self) -> NativeMaterial:
        """The struct of the library."""
        colors = (_vector(k, getattr(self, k)) for k in ("emission", "ambient", "diffuse",
                                                         "specular"))
        return NativeMaterial(*colors, arguments.number("shininess", self.shininess, 0, 1e9))


@dataclass(frozen=True)
class Light:
    """One lamp.  position is (x, y, z, 1) for a point, (x, y, z, 0) for the way toward a distant
    lamp; cutoff and exponent belong to a cone along spot_direction, which is zero for none."""

    position: Vector
    diffuse: Vector = WHITE
    specular: Vector = WHITE
    ambient: Vector = BLACK
    constant: float = 0.0
    linear: float = 0.0
    quadratic: float = 0.0
    spot_direction: Vector = BLACK
    spot_exponent: float = 0.0
    spot_cos_cutoff: float = 0.0

    @staticmethod
    def directional(travel: Vector, color: Vector = WHITE) -> Light:
        """A distant lamp whose light travels that way."""
        x, y, z = _way("travel", travel)
        return Light((-x, -y, -z, 0.0), color, color)

    @staticmethod
    def point(position: Vector, color: Vector = WHITE,
              attenuation: Sequence[float] = (0, 0, 0)) -> Light:
        """A lamp at a position; attenuation is a, b, c of 1 / (a + b r + c r^2)."""
        a, b, c = _vector("attenuation", attenuation)
        place = arguments.doubles("position", position, (3,), finite=True).tolist()
        return Light((*place, 1.0), color, color, BLACK, a, b, c)

    @staticmethod
    def spot(position: Vector, aim: Vector, cutoff: float, exponent: float = 0.0,
             color: Vector = WHITE) -> Light:
        """A lamp that points along aim; cutoff is in radians from the axis to the cone's edge."""
        cosine = math.cos(arguments.number("cutoff", cutoff, 0, math.pi))
        return replace(Light.point(position, color), spot_direction=_way("aim", aim),
                       spot_exponent=exponent, spot_cos_cutoff=cosine)

    def native(self) -> NativeLight:
        """The struct of the library."""
        *way, w = _vector("position", self.position, 4)
        if w == 0 and math.hypot(*way) < 1e-18:
            raise Error("position must not be zero: with w = 0 it is a direction")
        colors = (_vector(k, getattr(self, k)) for k in ("ambient", "diffuse", "specular"))
        numbers = (arguments.number(k, getattr(self, k), 0, 3e38)
                   for k in ("constant", "linear", "quadratic"))
        return NativeLight(_vector("position", self.position, 4), *colors, *numbers,
                           _vector("spot_direction", self.spot_direction),
                           arguments.number("spot_exponent", self.spot_exponent, 0, 3e38),
                           arguments.number("spot_cos_cutoff", self.spot_cos_cutoff, -1, 1))


def lamps_of(lights: object) -> list[Light]:
    """A list of lamps, and nothing else"""
    try:
        lamps: list[Light] = list(lights)  # type: ignore[call-overload]
    except TypeError:
        raise Error(f"lights must be a sequence, not {arguments.shown(lights)}") from None
    for i, lamp in enumerate(lamps):
        if not isinstance(lamp, Light):
            raise Error(f"lights[{i}] must be a shade_h.Light, not {arguments.shown(lamp)}")
    return lamps


@dataclass(frozen=True)
class Lighting:
    """The light that falls on a scene, and the equation that surfaces answer with."""

    lights: Sequence[Light] = field(default_factory=tuple)
    ambient: Vector = BLACK
    model: Model = Model.BLINN_PHONG
    flags: Flag = Flag.NONE
    terms: Term = Term.ALL
    cool: Vector = BLACK
    warm: Vector = BLACK

    def native(self) -> NativeLighting:
        """The struct of the library, which keeps its lamps alive."""
        lamps = lamps_of(self.lights)
        out = NativeLighting()
        if lamps:
            out.lights = (NativeLight * len(lamps))(*(lamp.native() for lamp in lamps))
        out.light_count = len(lamps)
        out.ambient = _vector("ambient", self.ambient)
        out.model = arguments.integer("model", self.model, 0, max(Model))
        out.flags = arguments.integer("flags", self.flags, 0, 63)
        out.terms = arguments.integer("terms", self.terms, 0, 15)
        out.cool, out.warm = _vector("cool", self.cool), _vector("warm", self.warm)
        return out


def unpacked(m: NativeMaterial) -> Material:
    """The material of a struct of the library"""
    e, a, d, s = (tuple(float(x) for x in c)
                  for c in (m.emission, m.ambient, m.diffuse, m.specular))
    return Material(e, a, d, s, float(m.shininess))


PRESETS = tuple(library.shade_preset_name(i).decode() for i in range(24))


def preset(name: str, linear: bool = True) -> Material:
    """One of the 24 classic materials of PRESETS; with linear=False its numbers as printed, which
    are display colours."""
    m = library.shade_preset_material(PRESETS.index(arguments.choice("name", name, PRESETS)))
    return unpacked(library.shade_linear_material(m) if linear else m)


def lit(lighting: Lighting, material: Material, eye: Vector, points: object, normals: object,
        albedo: object = None) -> Floats:
    """The light that leaves each point toward the eye, (n, 3): the sum of iteration four.

    points and normals are (n, 3), normals of any length; albedo, (n, 3), multiplies k_d and k_a.
    eye is a position, or with Flag.INFINITE_VIEWER the direction toward the viewer.
    """
    if not isinstance(lighting, Lighting) or not isinstance(material, Material):
        raise Error("lighting must be a shade_h.Lighting and material a shade_h.Material")
    p = arguments.floats("points", points, (None, 3))
    n = arguments.floats("normals", normals, (len(p), 3))
    a = None if albedo is None else arguments.floats("albedo", albedo, (len(p), 3))
    at = arguments.floats("eye", eye, (3,), finite=True)
    rgb = np.empty_like(p)
    rows = (ctypes.c_void_p * 3)(pointer(p), pointer(n), pointer(a))
    light, surface = lighting.native(), material.native()
    library.python_lit(ctypes.byref(light), ctypes.byref(surface), pointer(at), rows, len(p),
                       pointer(rgb))
    return rgb


def light_at(light: Light, points: object) -> tuple[Floats, Floats, Floats]:
    """How much of a lamp arrives at each point if nothing is in the way: the factor (n,), the unit
    vector L toward the lamp (n, 3), and the distance (n,), 3.4e38 for a lamp at infinity."""
    if not isinstance(light, Light):
        raise Error(f"light must be a shade_h.Light, not {arguments.shown(light)}")
    p = arguments.floats("points", points, (None, 3))
    amount, distance = np.empty(len(p), np.float32), np.empty(len(p), np.float32)
    toward, lamp = np.empty_like(p), light.native()
    library.python_light_at(ctypes.byref(lamp), pointer(p), len(p), pointer(amount),
                            pointer(toward), pointer(distance))
    return amount, toward, distance


# ---- the lighting of four courses; examples/README.md explains the settings ----------------------


def uw(lights: Sequence[Light]) -> Lighting:
    """Iteration four, with I_La as each lamp's ambient and I_L as its diffuse and specular."""
    return Lighting(lights)


def massey(lights: Sequence[Light], ambient: Vector) -> Lighting:
    """k_a I_a + k_d (l.n) I_d + k_s (r.v)^alpha I_s, with one I_a and without B."""
    return Lighting(lights, ambient, Model.PHONG, Flag.UNGATED_SPECULAR)


def shirley(light: Light, ambient: Vector) -> Lighting:
    """c_r (c_a + c_l max(0, n.l)) + c_l c_p (h.n)^p, where the lamp has the colour c_l."""
    return Lighting((light,), ambient, Model.BLINN_PHONG, Flag.UNGATED_SPECULAR)


def shirley_surface(reflectance: Vector, highlight: Vector, exponent: float) -> Material:
    """The surface of c_r, c_p and p."""
    return Material(BLACK, reflectance, reflectance, highlight, exponent)


def berkeley(lights: Sequence[Light]) -> Lighting:
    """The sum over lights of k_a I + k_d I max(l.n, 0) + k_s I max(r.v, 0)^p."""
    same = tuple(replace(x, ambient=x.diffuse, specular=x.diffuse) for x in lights)
    return Lighting(same, BLACK, Model.PHONG, Flag.UNGATED_SPECULAR)
