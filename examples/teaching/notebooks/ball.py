"""What the notebooks share: a ball with a point and a normal in each pixel, pictures, comparisons."""
import numpy as np
import shade_h

SIZE = 200
EYE = np.array([0.0, 0.0, 5.0])


def dot(a, b):
    """Returns a.b of rows of vectors, with an axis of length 1 for colours."""
    return np.sum(a * b, axis=-1, keepdims=True)


def unit(v):
    """Returns v / |v| of rows of vectors."""
    return v / np.sqrt(dot(v, v))


def plus(x):
    """Returns max(0, x)."""
    return np.maximum(0, x)


_x, _y = np.meshgrid((np.arange(SIZE) + 0.5 - SIZE / 2) / (0.46 * SIZE),
                     (SIZE / 2 - np.arange(SIZE) - 0.5) / (0.46 * SIZE))
INSIDE = _x * _x + _y * _y < 0.99
P = np.stack([_x, _y, np.sqrt(plus(1 - _x * _x - _y * _y))], -1)[INSIDE]  # points of the ball, (n, 3)
N = unit(P)
V = unit(EYE - P)


def codes(light):
    """Returns light as sRGB bytes."""
    c = np.clip(light, 0, 1)
    return np.round(255 * np.where(c <= 0.0031308, 12.92 * c, 1.055 * c ** (1 / 2.4) - 0.055)).astype(np.uint8)


def ball(light):
    """Returns a picture of the ball, (SIZE, SIZE, 4) bytes, from the light of its points."""
    rgba = np.full((SIZE, SIZE, 4), (32, 36, 44, 255), np.uint8)
    rgba[INSIDE, :3] = codes(np.broadcast_to(light, P.shape))
    return rgba


def strip(light, height=24):
    """Returns a picture of a row of light: brightness from left to right."""
    light = np.broadcast_to(np.asarray(light, float).reshape(len(light), -1), (len(light), 3))
    rgba = np.full((height, len(light), 4), 255, np.uint8)
    rgba[..., :3] = codes(light)
    return rgba


def curve(values, height=120, ink=(21, 96, 171)):
    """Returns a picture of a curve from 0, below, to 1, above."""
    rgba = np.full((height + 8, len(values), 4), 255, np.uint8)
    rgba[[4, height + 3], :, :3] = 200
    at = height + 3 - np.clip(values, 0, 1) * (height - 1)
    for x, y in enumerate(at):
        before = at[max(x - 1, 0)]
        rgba[int(min(y, before)) - 1:int(max(y, before)) + 2, x, :3] = ink
    return rgba


def side_by_side(*pictures):
    """Returns pictures in a row, as a notebook shows them."""
    return shade_h.Picture(np.ascontiguousarray(np.concatenate(pictures, 1)))


def stacked(*pictures):
    """Returns pictures below each other, as a notebook shows them."""
    return shade_h.Picture(np.ascontiguousarray(np.concatenate(pictures, 0)))


def same(ours, theirs, within=5e-5):
    """Says by how much two arrays differ at most, and stops where that is too much."""
    worst = float(np.max(np.abs(np.asarray(ours, float) - np.asarray(theirs, float))))
    print(f"at most {worst:.1e} apart")
    assert worst < within, worst
