"""Vectors in double precision, and random inputs, for the tasks."""
import math
import random
import struct

pow = math.pow  # of a negative number it raises, where ** would be complex


def dot(a, b):
    """Returns a.b."""
    return sum(x * y for x, y in zip(a, b))


def add(a, b):
    """Returns a + b."""
    return [x + y for x, y in zip(a, b)]


def sub(a, b):
    """Returns a - b."""
    return [x - y for x, y in zip(a, b)]


def mul(a, b):
    """Returns the products of coordinates, as of colours."""
    return [x * y for x, y in zip(a, b)]


def scale(s, v):
    """Returns s v."""
    return [s * x for x in v]


def cross(a, b):
    """Returns a x b."""
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def length(v):
    """Returns |v|."""
    return math.sqrt(dot(v, v))


def unit(v):
    """Returns v / |v|; zero stays zero."""
    return scale(1 / (length(v) or 1), v)


def single(x):
    """Returns a number as a C float has it."""
    try:
        return struct.unpack("f", struct.pack("f", x))[0]
    except OverflowError:
        return math.copysign(math.inf, x)


def ball(x, y):
    """Returns the normal of a ball at a place of the picture, or None beside it."""
    z = 0.81 - x * x - y * y
    return [x / 0.9, y / 0.9, math.sqrt(z) / 0.9] if z > 0 else None


class Draw(random.Random):
    """Random inputs, the same on every machine for the same seed."""

    def between(self, low, high):
        """Returns a number."""
        return low + (high - low) * self.random()

    def some(self, low, high, count):
        """Returns several numbers."""
        return [self.between(low, high) for _ in range(count)]

    def direction(self):
        """Returns a unit vector."""
        while True:
            v = self.some(-1, 1, 3)
            if 0.1 < length(v) < 1:
                return unit(v)

    def at(self, axis, cosine):
        """Returns a unit vector with a cosine to an axis."""
        side = unit(cross(axis, self.direction()))
        return add(scale(cosine, axis), scale(math.sqrt(max(0, 1 - cosine * cosine)), side))

    def axes(self):
        """Returns an axis, and the two others and one of them turned round: at right angles to it,
        to the bit."""
        k, sign = self.randrange(3), self.choice([-1.0, 1.0])
        x, y, z = ([sign * (i == (k + j) % 3) for i in range(3)] for j in range(3))
        return [x, y, z, scale(-1, y)]

    def weights(self):
        """Returns three numbers above 0 with the sum 1."""
        a, b = sorted(self.some(0.02, 0.98, 2))
        return [a, b - a, 1 - b]

    def lobe(self, exponent, low=0.1):
        """Returns a cosine that has a power between low and 1."""
        return self.between(low, 1) ** (1 / max(exponent, 1))

    def spread(self, low, high):
        """Returns a number, as often from 1 to 10 as from 10 to 100."""
        return low * (high / low) ** self.random()
