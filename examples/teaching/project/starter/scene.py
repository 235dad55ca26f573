"""scene.py - what your renderer is given, and how the judge calls it.  Do not change it: the judge has
its own.

s.checkpoint, s.option, s.shading, s.iteration     whole numbers, see scene.h
s.mipmaps                                          True to choose a level
s.fovy, s.near_z, s.far_z, s.bias                  floats; fovy in radians
s.eye, s.at, s.up, s.ambient                       arrays of 3
s.model, s.lamp_camera                             arrays of 4 x 4, for M @ p
s.material                                         emission, ambient, diffuse, specular, shininess
s.lamps                                            a list: position (of 3), ambient, diffuse, specular,
                                                   constant, linear, quadratic, spot_direction,
                                                   spot_exponent, spot_cos_cutoff
s.map                                              16 x 16 x 3, row 0 at v = 0
s.position, s.normal, s.color, s.uv, s.tangent     arrays with a row for each vertex
s.triangles                                        an array of indices, n x 3
"""
from types import SimpleNamespace as Fields

import numpy as np

WIDTH, HEIGHT, VERTICES, TRIANGLES, LAMPS, MAP, SHADOW_MAP = 64, 48, 96, 160, 2, 16, 64
FLAT, GOURAUD, PHONG = 0, 1, 2
SHADOW, BUMP, CLIP, SILHOUETTES = 0, 1, 2, 3
BACKGROUND = 0.1, 0.1, 0.15


def scene(numbers):
    """Returns the scene that numbers stand for, in the order of scene.h."""
    v, at = np.array(numbers, dtype=float), 0

    def take(count):
        nonlocal at
        at += count
        return v[at - count:at]
    s = Fields()
    s.checkpoint, s.option, s.shading, s.iteration = (int(x) for x in take(4))
    s.mipmaps = bool(take(1)[0])
    lamps, vertices, triangles = (int(x) for x in take(3))
    s.fovy, s.near_z, s.far_z, s.bias = take(4)
    s.eye, s.at, s.up, s.ambient = take(3), take(3), take(3), take(3)
    s.model, s.lamp_camera = take(16).reshape(4, 4).T, take(16).reshape(4, 4).T
    s.material = Fields(emission=take(3), ambient=take(3), diffuse=take(3), specular=take(3),
                        shininess=take(1)[0])
    s.lamps = []
    for _ in range(LAMPS):
        s.lamps.append(Fields(position=take(4)[:3], ambient=take(3), diffuse=take(3), specular=take(3),
                              constant=take(1)[0], linear=take(1)[0], quadratic=take(1)[0],
                              spot_direction=take(3), spot_exponent=take(1)[0],
                              spot_cos_cutoff=take(1)[0]))
    del s.lamps[lamps:]
    s.map = take(3 * MAP * MAP).reshape(MAP, MAP, 3)
    rows = take(14 * VERTICES).reshape(VERTICES, 14)[:vertices]
    s.position, s.normal, s.color = rows[:, 0:3], rows[:, 3:6], rows[:, 6:9]
    s.uv, s.tangent = rows[:, 9:11], rows[:, 11:14]
    s.triangles = take(3 * TRIANGLES).reshape(TRIANGLES, 3)[:triangles].astype(int)
    return s


def call(functions, numbers):
    """Returns the picture that a renderer draws of a scene, as numbers."""
    picture = np.tile(np.array(BACKGROUND), (HEIGHT, WIDTH, 1))
    functions.render(scene(numbers), picture)
    return [float(x) for x in picture.ravel()]
