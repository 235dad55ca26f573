"""Shapes that several tests draw."""
import numpy as np


def torus(n=48):
    """Vertices, faces of four corners, and the exact normals."""
    u, v = np.meshgrid(np.arange(2 * n) * np.pi / n, np.arange(n) * 2 * np.pi / n, indexing="ij")
    around = np.stack([np.cos(u), np.sin(u), 0 * u], -1)
    normals = np.cos(v)[..., None] * around + np.sin(v)[..., None] * [0, 0, 1]
    i, j = np.meshgrid(np.arange(2 * n), np.arange(n), indexing="ij")
    k, m = (i + 1) % (2 * n), (j + 1) % n
    faces = np.stack([i * n + j, k * n + j, k * n + m, i * n + m], -1).reshape(-1, 4)
    return (2 * around + 0.8 * normals).reshape(-1, 3), faces, normals.reshape(-1, 3)


def box(x=3.0, y=2.0, z=1.0):
    """A box from the origin on."""
    corners = np.array([[i, j, k] for i in (0, 1) for j in (0, 1) for k in (0, 1)], float)
    faces = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
    return corners * [x, y, z], np.array(faces)


def ply(points, form, colors=None, kind="float"):
    """A PLY file of points, with colours in bytes."""
    head = f"ply\nformat {form} 1.0\nelement vertex {len(points)}\n" + \
        "".join(f"property {kind} {k}\n" for k in "xyz") + \
        ("" if colors is None else
         "".join(f"property uchar {k}\n" for k in ("red", "green", "blue")))
    order = ">" if "big" in form else "<"
    if form == "ascii":
        rows = [[*map(repr, map(float, p)), *(() if colors is None else map(str, c))]
                for p, c in zip(points, points if colors is None else colors)]
        body = "".join(" ".join(row) + "\n" for row in rows).encode()
    else:
        body = b"".join(np.asarray(p, order + ("f8" if kind == "double" else "f4")).tobytes() +
                        (b"" if colors is None else bytes(int(v) for v in c))
                        for p, c in zip(points, points if colors is None else colors))
    return head.encode() + b"end_header\n" + body
