"""renderer.py - your renderer.  It runs, and draws the vertices where they are without a camera: make it
right, checkpoint by checkpoint.  Hand in this file."""
import numpy as np

from scene import HEIGHT, WIDTH


# ---- checkpoint 1: vertices and matrices ---------------------------------------------------------

def look_at(eye, at, up):
    """The camera's matrix V, from the world to the camera's space."""
    return np.eye(4)


def perspective(fovy, aspect, near, far):
    """The projection P, from the camera's space to clip space."""
    return np.eye(4)


def draw_vertices(s, picture):
    """A pixel for each vertex."""
    V = look_at(s.eye, s.at, s.up)
    P = perspective(s.fovy, WIDTH / HEIGHT, s.near_z, s.far_z)
    for position, color in zip(s.position, s.color):
        x, y, z, w = P @ V @ np.append(position, 1)
        # from clip space to the window: yours to write
        i, j = int(np.floor(16 * x + 32)), int(np.floor(16 * y + 24))
        if 0 <= i < WIDTH and 0 <= j < HEIGHT:
            picture[j, i] = color


# ---- checkpoints 2 to 6 start here ---------------------------------------------------------------

def render(s, picture):
    """Draws the scene s into picture, an array of HEIGHT x WIDTH x 3 that has the background."""
    draw_vertices(s, picture)
