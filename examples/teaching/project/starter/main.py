"""main.py - draws a scene of its own for each checkpoint into a PNG: python3 main.py 4 writes 4.png.
Of 6 there are four: python3 main.py 6 0 draws the shadow, 1 bumps, 2 clipping, 3 silhouettes.
The judge does not use it; change it as you like."""
import struct
import sys
import zlib

import numpy as np

import renderer
from scene import (BACKGROUND, CLIP, HEIGHT, LAMPS, MAP, PHONG, SHADOW, TRIANGLES, VERTICES, WIDTH,
                   scene)

ENLARGED = 8


def write_png(path, picture):
    """Writes a picture of floats."""
    rows = np.clip(255 * picture + 0.5, 0, 255).astype(np.uint8).repeat(ENLARGED, 0).repeat(ENLARGED, 1)

    def chunk(name, data):
        return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))
    head = struct.pack(">IIBBBBB", rows.shape[1], rows.shape[0], 8, 2, 0, 0, 0)
    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(
            b"".join(b"\0" + row.tobytes() for row in rows))) + chunk(b"IEND", b""))


def torus(around=15, across=5):
    """Returns vertices and triangles of a torus."""
    vertices, triangles = [], []
    for j in range(across + 1):
        for i in range(around + 1):
            u, v = i / around, j / across
            a, b = 2 * np.pi * u, 2 * np.pi * v
            r, ca, sa, cb, sb = 1 + 0.45 * np.cos(b), np.cos(a), np.sin(a), np.cos(b), np.sin(b)
            vertices += [r * ca, 0.45 * sb, -r * sa, cb * ca, sb, -cb * sa, 0.5 + 0.5 * ca,
                         0.5 + 0.5 * sb, 0.5 - 0.5 * ca, 4 * u, 2 * v, -sa, 0, -ca]
            if i < around and j < across:
                at = j * (around + 1) + i
                triangles += [at, at + 1, at + around + 2, at, at + around + 2, at + around + 1]
    return vertices, triangles


def lamp(x, y, z):
    """Returns a lamp that shines at the middle."""
    return [x, y, z, 1, .05, .05, .05, 1, .95, .9, 1, .95, .9, .4, .1, .04, -x, -y, -z, 2, .85]


def main():
    """Draws one scene."""
    checkpoint = int(sys.argv[1]) if len(sys.argv) > 1 else 1
    option = int(sys.argv[2]) if len(sys.argv) > 2 else 0
    vertices, triangles = torus()
    unit = list(np.eye(4).ravel())
    # column after column: from (3, 1.5, -1) to the middle, fovy .8, near 1, far 8
    from_lamp = [-.7479, -.9616, -1.102, -.8571, 0, 2.137, -.551, -.4286, -2.2438, .3205, .3673,
                 .2857, 0, 0, 2.2143, 3.5]
    # low for the shadow, so that the torus is in its own
    place = (3, 1.5, -1) if checkpoint == 6 and option == SHADOW else (2, 3, 2)
    near = 2.4 if checkpoint == 6 and option == CLIP else .5  # cuts the torus open
    checks = [c for k in range(MAP * MAP) for x in [.9 if (k // MAP // 4 + k % MAP // 4) % 2 else .3]
              for c in ([x, .5, .9] if checkpoint == 6 else [x, x, .5])]  # normals in 6
    numbers = [checkpoint, option, PHONG, 4, 0, LAMPS, len(vertices) // 14, len(triangles) // 3, .9,
               near, 12, .03, 1, 1.8, 2.6, 0, 0, 0, 0, 1, 0, .2, .2, .2, *unit, *from_lamp, 0, 0, 0,
               .6, .35, .2, .6, .35, .2, .4, .4, .4, 20, *lamp(*place), *lamp(-3, 1, 1), *checks]
    numbers += vertices + [0] * (14 * VERTICES - len(vertices))
    numbers += triangles + [0] * (3 * TRIANGLES - len(triangles))
    picture = np.tile(np.array(BACKGROUND), (HEIGHT, WIDTH, 1))
    renderer.render(scene(numbers), picture)
    write_png(f"{checkpoint}.png", picture)
    print(f"{checkpoint}.png")


if __name__ == "__main__":
    main()
