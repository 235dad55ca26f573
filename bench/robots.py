#!/usr/bin/env python3
"""robots.py - pictures a second of a simulator's cameras: 32 geoms that move, and colour, depth and
the number of the object of each pixel, by shade.h's package, Mesa's llvmpipe and VTK.

    python3 bench/robots.py [seconds]     of each figure; what is not installed is left out, with a line

The package must be importable (pip install examples/packages/python).  Each process draws by one thread on a
core of its own; two processes begin together.  Seconds are those of processor time, so that other programs of the
machine count little, and the figure of a process is the best of ten parts.  llvmpipe is called through OSMesa (Debian:
libosmesa6) by display lists, as MuJoCo draws, and VTK (python3-vtk9) needs Xvfb or a DISPLAY; both
have MuJoCo's own 28 by 16 faces a sphere, and shade.h as many as a quarter of a pixel needs.  All
three draw numbers of objects; shade.h's also tell the triangle.
"""
import os
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
from python import FOV, LAMP, Scene, Vtk, box, capsule, display

HERE = Path(__file__).resolve().parent
sys.path.append(str(HERE.parent / "examples" / "packages" / "python" / "test"))
SIZES, FRAMES, COUNT, PARTS = (64, 84, 128, 256), 16, 32, 10
GREY = (0.7, 0.65, 0.6)


def robots(size):
    """A floor with 31 boxes, spheres and capsules that turn."""
    poses = np.tile(np.eye(4), (FRAMES, COUNT, 1, 1))
    for i in range(1, COUNT):
        a = np.linspace(0, 3, FRAMES) + i
        poses[:, i, 0, 0], poses[:, i, 0, 2] = 0.4 * np.cos(a), 0.4 * np.sin(a)
        poses[:, i, 2, 0], poses[:, i, 2, 2] = -0.4 * np.sin(a), 0.4 * np.cos(a)
        poses[:, i, 1, 1] = 0.4
        poses[:, i, :3, 3] = (i % 8 - 3.5) * 1.1, (i // 8 - 1.5) * 1.3, 0.6
    poses[:, 0, :3, :3] = np.diag([12, 12, 0.1])
    poses[:, 0, 2, 3] = -0.1
    return Scene([box(), capsule(0), capsule(1.0)], [0, *(i % 3 for i in range(1, COUNT))], poses,
                 (size, size), (0, -8, 7))


class Package:
    """One Renderer, which fills the same arrays."""

    def __init__(self, scene, **options):
        import shade_h as shade
        w, h = scene.size
        self.drawn = made = shade.Renderer(h, w, **options)
        sizes = {0: ("box", (0.4, 0.4, 0.4)), 1: ("sphere", 0.4), 2: ("capsule", (0.4, 0.4))}
        made.add("box", (12, 12, 0.1), color=GREY)
        for place in scene.places[1:]:
            made.add(*sizes[place], color=GREY)
        made.light([shade.Light.directional(LAMP)], (0.3, 0.3, 0.3))
        self.camera = shade.Camera.look_at(scene.eye, fov=FOV, near=scene.near, far=scene.far)
        self.poses, self.out = scene.poses.copy(), made.frame()
        self.poses[:, 1:, :3, :3] /= 0.4
        self.poses[:, 0, :3, :3] = np.eye(3)

    def draw(self, k):
        self.drawn.poses(self.poses[k])
        color, depth, ids, _ = self.drawn.render(self.camera, self.out)
        return color, depth, ids[..., 0]


class Chequered(Package):
    """The same with a chequered floor and the lamp's shadows, which nobody else here draws."""

    def __init__(self, scene):
        super().__init__(scene)
        import shade_h as shade
        self.drawn.show(0, False)
        self.drawn.add("plane", texture=self.drawn.checker(), repeat=(0.5, 0.5))
        self.poses = np.concatenate([self.poses, np.tile(np.eye(4), (FRAMES, 1, 1, 1))], 1)
        self.drawn.light([shade.Light.directional(LAMP)], (0.3, 0.3, 0.3), shadow=0)


class Llvmpipe:
    """Light by vertex, as the fixed functions of OpenGL have it."""

    def __init__(self, scene):
        from osmesa import Mesa
        slope, (near, far) = 1 / np.tan(np.radians(FOV) / 2), (scene.near, scene.far)
        self.scene, self.near, self.far = scene, near, far
        self.projection = np.diag([slope, slope, (far + near) / (near - far), 0])
        self.projection[2, 3], self.projection[3, 2] = 2 * far * near / (near - far), -1
        toward = -np.array(LAMP) / np.linalg.norm(LAMP)
        self.drawn = Mesa(scene.meshes, scene.size, toward, (1, 1, 1), (0.3, 0.3, 0.3))

    def draw(self, k):
        scene, near, far = self.scene, self.near, self.far
        rgb, z, ids = self.drawn.draw(scene.view(), self.projection, scene.places, scene.poses[k],
                                      [GREY] * COUNT)
        return rgb, np.where(z < 1, near * far / (far - z * (far - near)), np.inf), ids


ADAPTERS = {"shade.h": Package, "shade.h, chequered and with shadows": Chequered,
            "llvmpipe, OSMesa": Llvmpipe, "VTK": lambda scene: Vtk(scene, 1)}


def worker(library, size, core, seconds):
    """Says when it is ready, draws for so long after a line of input, and prints its rate."""
    if hasattr(os, "sched_setaffinity"):
        able = sorted(os.sched_getaffinity(0))
        os.sched_setaffinity(0, [able[core % len(able)]])
    drawn, wanted = ADAPTERS[library](robots(size)), Package(robots(size))
    same = 0.0
    for k in range(3):
        same = (drawn.draw(k)[2] == wanted.draw(k)[2]).mean()
    print(f"{same:.3f}", flush=True)
    sys.stdin.readline()
    best = 0.0
    for _ in range(PARTS):
        begin, count = time.process_time(), 0
        while (spent := time.process_time() - begin) < seconds / PARTS or count % FRAMES:
            drawn.draw(count % FRAMES)
            count += 1
        best = max(best, count / spent)
    print(best, flush=True)


def rate(library, size, processes, seconds, environment):
    """Pictures a second of all processes, or None with a line on standard error."""
    words = [sys.executable, __file__, "--one", library, str(size)]
    ran = [subprocess.Popen([*words, str(core), str(seconds)], env=environment, text=True,
                            stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
           for core in range(processes)]
    same = [p.stdout.readline() for p in ran]
    for p in ran:
        if p.poll() is None:
            p.stdin.write("\n")
            p.stdin.flush()
    got = [p.communicate() for p in ran]
    if any(p.returncode for p in ran):
        why = (got[0][1].strip().splitlines() or ["no figures"])[-1]
        print(f"left out: {library}: {why}", file=sys.stderr)
        return None
    # a renderer of the same pictures may differ at outlines, of which small pictures have many
    if "chequered" not in library and float(same[0]) < 0.85:
        print(f"left out: {library}: {same[0].strip()} of the pixels show the same object",
              file=sys.stderr)
        return None
    return sum(float(out) for out, _ in got)


def main():
    """Prints the table."""
    if sys.argv[1:2] == ["--one"]:
        library, size, core, seconds = sys.argv[2:]
        return worker(library, int(size), int(core), float(seconds))
    seconds = float(sys.argv[1]) if len(sys.argv) > 1 else 2.0
    print("| pictures a second, 1 and 2 processes | " + " | ".join(f"{n} x {n}" for n in SIZES) +
          " |\n|" + "---|" * (len(SIZES) + 1), flush=True)
    with display() as environment:
        environment.update(LP_NUM_THREADS="0", OMP_NUM_THREADS="1", OPENBLAS_NUM_THREADS="1")
        for library in ADAPTERS:
            cells = []
            for size in SIZES:
                both = [rate(library, size, n, seconds, environment) for n in (1, 2)]
                if None in both:
                    break
                cells.append(", ".join(f"{x:,.0f}" for x in both))
            if cells:
                print("| " + " | ".join([library, *cells]) + " |", flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
