#!/usr/bin/env python3
"""python.py - the Python package beside VTK, Open3D and matplotlib: the same scenes,
each library in a process of its own, and a table in Markdown.

    python3 bench/python.py [rounds]      what is not installed is left out with a line

The package must be importable (pip install examples/packages/python).  VTK and Open3D draw by OpenGL into a
window: without a DISPLAY, Xvfb gives them one.  Pictures are of one sample a pixel.  A row stands
only where its pictures cover the pixels that those of the first row cover.
"""
import contextlib
import json
import os
import resource
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

LIBRARIES = ("shade_h", "vtk", "open3d", "matplotlib")
FRAMES = 32
SLICES, STACKS = 28, 16         # of round geoms: MuJoCo's own numbers
FOV = 45.0
LAMP = (-1.0, 1.0, -2.0)        # the way its light travels
AGREE = 0.95                    # of the pixels that either covers; outlines differ by a pixel


# ---- scenes -----------------------------------------------------------------------------------

def triangles(corners):
    """Two triangles of each face of four corners, without those that have no area."""
    cut = np.concatenate([corners[:, [0, 1, 2]], corners[:, [0, 2, 3]]])
    return cut[(cut[:, 0] != cut[:, 1]) & (cut[:, 1] != cut[:, 2]) & (cut[:, 0] != cut[:, 2])]


def capsule(half):
    """A sphere, or with half > 0 one that is drawn out along z, with the exact normals."""
    rows = STACKS if half == 0 else STACKS + 1
    angle = np.linspace(0, np.pi, STACKS + 1)
    if half:
        angle = np.insert(angle, STACKS // 2, np.pi / 2)
    u = np.arange(SLICES) * 2 * np.pi / SLICES
    up = np.where(np.arange(rows + 1) <= rows // 2, half, -half)
    normals = np.stack([np.cos(u)[:, None] * np.sin(angle), np.sin(u)[:, None] * np.sin(angle),
                        np.tile(np.cos(angle), (SLICES, 1))], -1)
    points = normals + np.stack([0 * up, 0 * up, up], -1)
    i, j = np.meshgrid(np.arange(SLICES), np.arange(rows), indexing="ij")
    number = i * (rows + 1) + j
    number, beside = number.ravel(), (number + rows + 1).ravel() % (SLICES * (rows + 1))
    faces = triangles(np.stack([number, number + 1, beside + 1, beside], -1))
    good = np.linalg.norm(np.cross(*(points.reshape(-1, 3)[faces[:, k]]
                                     - points.reshape(-1, 3)[faces[:, 0]] for k in (1, 2))), axis=1)
    return points.reshape(-1, 3), faces[good > 1e-9], normals.reshape(-1, 3)


def box():
    """A cube whose faces have four corners of their own."""
    points, normals = [], []
    for axis in range(3):
        for side in (-1.0, 1.0):
            a, b, n = np.eye(3)[(axis + 1) % 3], np.eye(3)[(axis + 2) % 3], np.eye(3)[axis] * side
            a = a * side
            points += [n - a - b, n + a - b, n + a + b, n - a + b]
            normals += [n] * 4
    return np.array(points), triangles(np.arange(24).reshape(6, 4)), np.array(normals)


def knobbly(n):
    """A torus with knobs, of about n triangles."""
    nv = int((n / 4) ** 0.5)
    u, v = np.meshgrid(np.arange(2 * nv) * np.pi / nv, np.arange(nv) * 2 * np.pi / nv,
                       indexing="ij")
    around = np.stack([np.cos(u), np.sin(u), 0 * u], -1)
    normals = np.cos(v)[..., None] * around + np.sin(v)[..., None] * [0, 0, 1]
    knobs = 0.8 + 0.08 * np.sin(9 * u) * np.sin(7 * v)
    i, j = np.meshgrid(np.arange(2 * nv), np.arange(nv), indexing="ij")
    k, m = (i + 1) % (2 * nv), (j + 1) % nv
    faces = np.stack([i * nv + j, k * nv + j, k * nv + m, i * nv + m], -1).reshape(-1, 4)
    return ((2 * around + knobs[..., None] * normals).reshape(-1, 3), triangles(faces),
            normals.reshape(-1, 3))


class Scene:
    """Meshes, the mesh of each geom, their poses in each frame, and a camera."""

    def __init__(self, meshes, places, poses, size, eye):
        self.meshes = [(p.astype(np.float32), f.astype(np.uint32), n.astype(np.float32))
                       for p, f, n in meshes]
        self.places, self.poses, self.size, self.eye = places, poses, size, np.array(eye, float)
        self.near, self.far = 1.0, 30.0

    def view(self):
        """The rows of the matrix that takes the world to the camera, which looks down -z."""
        back = self.eye / np.linalg.norm(self.eye)
        right = np.cross([0, 0, 1], back)
        right /= np.linalg.norm(right)
        turn, out = np.stack([right, np.cross(back, right), back]), np.eye(4)
        out[:3, :3], out[:3, 3] = turn, -turn @ self.eye
        return out


def robot():
    """32 boxes, spheres and capsules that turn, 256 x 256: colours, depth and ids are asked for."""
    places = [i % 3 for i in range(32)]
    poses = np.tile(np.eye(4), (FRAMES, 32, 1, 1))
    for i in range(32):
        a = np.linspace(0, 3, FRAMES) + i
        poses[:, i, 0, 0], poses[:, i, 0, 2] = 0.4 * np.cos(a), 0.4 * np.sin(a)
        poses[:, i, 2, 0], poses[:, i, 2, 2] = -0.4 * np.sin(a), 0.4 * np.cos(a)
        poses[:, i, 1, 1] = 0.4
        poses[:, i, :3, 3] = (i % 8 - 3.5) * 1.1, (i // 8 - 1.5) * 1.3, 0
    return Scene([box(), capsule(0), capsule(1.0)], places, poses, (256, 256), (0, -8, 7))


def part(count, size):
    """One mesh that stands still."""
    return Scene([knobbly(count)], [0], np.tile(np.eye(4), (1, 1, 1, 1)), size, (4, -5, 4))


SCENES = {"robot": robot, "part": lambda: part(100_000, (640, 480)),
          "million": lambda: part(1_000_000, (1920, 1080))}


# ---- libraries: each draws frame k, returns colours, depth and ids, or None for what it lacks ---

class Shade:
    """The package, one call a picture, into the same arrays; batch() is one call for all."""

    def __init__(self, scene, cores):
        import shade_h as shade
        self.scene, self.cores = scene, cores
        self.drawn = shade.Scene([shade.Light.directional(LAMP)], (0.3, 0.3, 0.3))
        made = [shade.Mesh(p, f, normals=n) for p, f, n in scene.meshes]
        for place in scene.places:
            self.drawn.add(made[place], two_sided=False)
        w, h = scene.size
        self.camera = shade.Camera.look_at(scene.eye, fov=FOV, aspect=w / h, near=scene.near,
                                           far=scene.far)

        self.one, self.all = {}, {}

    def fill(self, arrays, poses):
        got = self.drawn.render_batch(self.camera, poses, self.scene.size, threads=self.cores,
                                      **arrays)
        arrays.update(zip(("rgb", "depth", "ids"), got))
        return got

    def draw(self, k):
        return [array[0] for array in self.fill(self.one, self.scene.poses[k:k + 1])]

    def batch(self):
        self.fill(self.all, self.scene.poses)


class Vtk:
    """Colours and depth of one draw; ids as colours without light of another."""

    def __init__(self, scene, cores):
        from vtkmodules import vtkRenderingOpenGL2  # noqa: F401 (registers the implementation)
        from vtkmodules.vtkRenderingCore import vtkRenderWindow, vtkRenderer
        del cores
        self.scene = scene
        self.window = vtkRenderWindow()
        self.window.SetOffScreenRendering(1)
        self.window.SetMultiSamples(0)
        self.window.SetSize(*scene.size)
        self.layers, self.actors = [], []
        for lit in (True, False) if len(scene.places) > 1 else (True,):
            layer = vtkRenderer()
            layer.SetBackground((1, 1, 1) if lit else (0, 0, 0))
            self.window.AddRenderer(layer)
            self.actors.append(self.fill(layer, lit))
            self.aim(layer)
            self.layers.append(layer)

    def fill(self, layer, lit):
        from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray
        from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
        from vtkmodules.vtkCommonCore import vtkPoints
        from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper
        mappers, actors = [], []
        for p, f, n in self.scene.meshes:
            points, cells, data = vtkPoints(), vtkCellArray(), vtkPolyData()
            points.SetData(numpy_to_vtk(p, deep=1))
            cells.SetData(3, numpy_to_vtkIdTypeArray(f.astype(np.int64).ravel(), deep=1))
            data.SetPoints(points)
            data.SetPolys(cells)
            data.GetPointData().SetNormals(numpy_to_vtk(n, deep=1))
            mappers.append(vtkPolyDataMapper())
            mappers[-1].SetInputData(data)
        for i, place in enumerate(self.scene.places):
            actor = vtkActor()
            actor.SetMapper(mappers[place])
            actor.GetProperty().BackfaceCullingOn()
            actor.GetProperty().SetColor(*((0.7, 0.65, 0.6) if lit else ((i + 1) / 255, 0, 0)))
            actor.GetProperty().SetLighting(lit)
            layer.AddActor(actor)
            actors.append(actor)
        return actors

    def aim(self, layer):
        from vtkmodules.vtkRenderingCore import vtkLight
        lamp, camera = vtkLight(), layer.GetActiveCamera()
        lamp.SetPositional(0)
        lamp.SetPosition(*(-x for x in LAMP))
        lamp.SetFocalPoint(0, 0, 0)
        layer.AddLight(lamp)
        camera.SetPosition(*self.scene.eye)
        camera.SetFocalPoint(0, 0, 0)
        camera.SetViewUp(0, 0, 1)
        camera.SetViewAngle(FOV)
        camera.SetClippingRange(self.scene.near, self.scene.far)

    def seen(self, which):
        from vtkmodules.util.numpy_support import vtk_to_numpy
        from vtkmodules.vtkCommonCore import vtkUnsignedCharArray
        for i, layer in enumerate(self.layers):
            layer.SetDraw(i == which)
        w, h = self.scene.size
        self.window.Render()
        got = vtkUnsignedCharArray()
        self.window.GetPixelData(0, 0, w - 1, h - 1, 0, got, 0)
        return vtk_to_numpy(got).reshape(h, w, 3)[::-1]

    def draw(self, k):
        from vtkmodules.util.numpy_support import vtk_to_numpy
        from vtkmodules.vtkCommonCore import vtkFloatArray
        for actors in self.actors:
            for actor, pose in zip(actors, self.scene.poses[k]):
                if len(actors) > 1:
                    actor.SetUserMatrix(self.matrix(pose))
        rgb, z = self.seen(0), vtkFloatArray()
        w, h = self.scene.size
        self.window.GetZbufferData(0, 0, w - 1, h - 1, z)
        z = vtk_to_numpy(z).reshape(h, w)[::-1]
        near, far = self.scene.near, self.scene.far
        depth = np.where(z < 1, near * far / (far - z * (far - near)), np.inf)
        ids = self.seen(1)[:, :, 0].astype(np.int32) - 1 if len(self.layers) > 1 else None
        return rgb, depth, ids

    @staticmethod
    def matrix(pose):
        from vtkmodules.vtkCommonMath import vtkMatrix4x4
        out = vtkMatrix4x4()
        out.DeepCopy(pose.ravel().tolist())
        return out


class Open3d:
    """Colours and depth of the window of its Visualizer; ids it has none."""

    def __init__(self, scene, cores):
        import open3d
        del cores
        self.scene = scene
        self.window = open3d.visualization.Visualizer()
        w, h = scene.size
        if not self.window.create_window(width=w, height=h, visible=False):
            raise RuntimeError("Open3D has no window")
        self.geoms = []
        for place in scene.places:
            p, f, n = scene.meshes[place]
            mesh = open3d.geometry.TriangleMesh(open3d.utility.Vector3dVector(p.astype(float)),
                                                open3d.utility.Vector3iVector(f.astype(np.int32)))
            mesh.vertex_normals = open3d.utility.Vector3dVector(n.astype(float))
            mesh.paint_uniform_color((0.7, 0.65, 0.6))
            self.geoms.append(mesh)
            self.window.add_geometry(mesh)
        self.now = np.tile(np.eye(4), (len(self.geoms), 1, 1))
        self.aim(open3d.camera.PinholeCameraParameters(), w, h)

    def aim(self, camera, w, h):
        f = 0.5 * h / np.tan(np.radians(FOV) / 2)
        inner = camera.intrinsic
        inner.set_intrinsics(w, h, f, f, w / 2 - 0.5, h / 2 - 0.5)
        camera.intrinsic = inner
        camera.extrinsic = np.diag([1.0, -1.0, -1.0, 1.0]) @ self.scene.view()
        control = self.window.get_view_control()
        if not control.convert_from_pinhole_camera_parameters(camera, True):
            raise RuntimeError("Open3D does not take this camera")
        control.set_constant_z_near(self.scene.near)
        control.set_constant_z_far(self.scene.far)

    def draw(self, k):
        if len(self.geoms) > 1:
            for i, mesh in enumerate(self.geoms):
                mesh.transform(self.scene.poses[k, i] @ np.linalg.inv(self.now[i]))
                self.window.update_geometry(mesh)
            self.now = self.scene.poses[k]
        self.window.poll_events()
        self.window.update_renderer()
        rgb = np.asarray(self.window.capture_screen_float_buffer(True))
        depth = np.asarray(self.window.capture_depth_float_buffer(False))
        return rgb, np.where(depth > 0, depth, np.inf), None


class Matplotlib:
    """Colours alone: polygons in the order of their middles, as mplot3d sorts them, here without
    its axes."""

    def __init__(self, scene, cores):
        import matplotlib
        matplotlib.use("agg")
        from matplotlib.collections import PolyCollection
        from matplotlib.figure import Figure
        from matplotlib.backends.backend_agg import FigureCanvasAgg
        del cores
        self.scene, self.polygons = scene, PolyCollection
        w, h = scene.size
        self.canvas = FigureCanvasAgg(Figure(figsize=(w / 100, h / 100), dpi=100))
        self.axes = self.canvas.figure.add_axes([0, 0, 1, 1])
        self.drawn = None

    def draw(self, k):
        scene, corners, light = self.scene, [], []
        view, slope = scene.view(), np.tan(np.radians(FOV) / 2)
        for place, pose in zip(scene.places, scene.poses[k]):
            p, f, _ = scene.meshes[place]
            corners.append((p @ pose[:3, :3].T + pose[:3, 3])[f])
        at = np.concatenate(corners)
        normal = np.cross(at[:, 1] - at[:, 0], at[:, 2] - at[:, 0])
        facing = (normal * (scene.eye - at[:, 0])).sum(1) > 0
        at, normal = at[facing], normal[facing]
        lamp = -np.array(LAMP) / np.linalg.norm(LAMP)
        light = normal @ lamp / np.maximum(np.linalg.norm(normal, axis=1), 1e-30)
        seen = at @ view[:3, :3].T + view[:3, 3]
        order = np.argsort(seen[:, :, 2].mean(1))
        flat = seen[:, :, :2] / -seen[:, :, 2:] / slope
        grey = (0.2 + 0.7 * np.maximum(light, 0))[order]
        self.axes.clear()
        self.axes.set_axis_off()
        self.axes.set_xlim(-scene.size[0] / scene.size[1], scene.size[0] / scene.size[1])
        self.axes.set_ylim(-1, 1)
        self.axes.add_collection(self.polygons(flat[order], facecolors=np.stack([grey] * 3, 1),
                                               edgecolors="none", antialiaseds=False))
        self.canvas.draw()
        rgb = np.asarray(self.canvas.buffer_rgba())[:, :, :3]
        return rgb, None, None


ADAPTERS = {"shade_h": Shade, "vtk": Vtk, "open3d": Open3d, "matplotlib": Matplotlib}


# ---- one process ------------------------------------------------------------------------------

def covered(rgb, depth):
    """The pixels of a picture that show something."""
    return np.isfinite(depth) if depth is not None else (rgb != rgb[0, 0]).any(2)


def least(work, rounds):
    """The least time of so many, in seconds."""
    times = []
    for k in range(rounds):
        begin = time.perf_counter()
        work(k)
        times.append(time.perf_counter() - begin)
    return min(times)


def measure(library, name, cores, rounds, mask):
    """Draws one scene by one library on so many cores, and prints what it took as JSON."""
    if hasattr(os, "sched_setaffinity"):
        os.sched_setaffinity(0, sorted(os.sched_getaffinity(0))[:cores])
    scene = SCENES[name]()
    begin = time.perf_counter()
    drawn = ADAPTERS[library](scene, cores)
    rgb, depth, ids = drawn.draw(0)
    first = time.perf_counter() - begin
    np.save(mask, covered(rgb, depth))
    frames = len(scene.poses)
    once = least(lambda k: drawn.draw(k % frames), rounds)
    each = getattr(drawn, "batch", lambda: [drawn.draw(k) for k in range(frames)])
    batch = least(lambda _: each(), max(2, rounds // 4)) / frames
    print(json.dumps({"first": first, "once": once, "batch": batch, "ids": ids is not None,
                      "memory": resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024}))


# ---- the table --------------------------------------------------------------------------------

def run(library, name, cores, rounds, folder, environment):
    """The figures of one process, or None with a line on standard error."""
    mask = folder / f"{library}_{name}.npy"
    words = [sys.executable, __file__, "--one", library, name, str(cores), str(rounds), str(mask)]
    got = subprocess.run(words, env=dict(environment, LP_NUM_THREADS=str(cores)), text=True,
                         stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    lines = [line for line in got.stdout.splitlines() if line.startswith("{")]
    if got.returncode or not lines:
        why = (got.stderr.strip().splitlines() or ["no figures"])[-1]
        print(f"left out: {library}, {name}: {why}", file=sys.stderr)
        return None
    wanted, have = np.load(folder / f"{LIBRARIES[0]}_{name}.npy"), np.load(mask)
    overlap = float((wanted & have).sum() / max(1, (wanted | have).sum()))
    if overlap < AGREE:
        print(f"left out: {library}, {name}: its picture covers other pixels, {overlap:.3f} of "
              "either are of both", file=sys.stderr)
        return None
    return json.loads(lines[-1])


@contextlib.contextmanager
def display():
    """An environment with a DISPLAY for those that draw into windows, where there is one or Xvfb."""
    if os.environ.get("DISPLAY") or not shutil.which("Xvfb"):
        yield dict(os.environ)
        return
    read, write = os.pipe()
    server = subprocess.Popen(["Xvfb", "-displayfd", str(write), "-screen", "0",
                               "2000x1200x24", "-nolisten", "tcp"], pass_fds=[write],
                              stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    os.close(write)
    try:
        with os.fdopen(read) as told:
            yield dict(os.environ, DISPLAY=f":{told.readline().strip()}")
    finally:
        server.terminate()
        server.wait()


def cell(figures, key, form):
    """A cell of the table; a dash where the library did not draw that scene."""
    return "-" if figures is None else form(figures[key])


def row(library, rounds, folder, environment):
    """The line of one library; "" where it is not installed."""
    if subprocess.run([sys.executable, "-c", f"import {library}"], env=environment,
                      stderr=subprocess.DEVNULL).returncode:
        if library == LIBRARIES[0]:
            sys.exit("shade-h is not installed: pip install examples/packages/python")
        print(f"left out: {library}, which is not installed", file=sys.stderr)
        return ""
    few = max(2, rounds // 8)
    slow = library == "matplotlib"
    one = run(library, "robot", 1, few if slow else rounds, folder, environment)
    two = run(library, "robot", 2, few if slow else rounds, folder, environment)
    part_of = run(library, "part", 1, few, folder, environment)
    million = None if slow else run(library, "million", 2, few, folder, environment)

    def ms(x):
        return f"{1e3 * x:.1f}" if x < 0.1 else f"{1e3 * x:.0f}"

    def rate(x):
        return f"{1 / x:.0f}" if x < 0.1 else f"{1 / x:.1f}"
    return " | ".join([f"| {library}", cell(one, "first", ms), cell(one, "once", ms),
                       cell(one, "batch", rate), cell(two, "batch", rate),
                       cell(part_of, "once", ms), cell(million, "once", ms),
                       cell(one, "memory", lambda m: f"{m:.0f}") + " |"])


def main():
    """Prints the table."""
    if sys.argv[1:2] == ["--one"]:
        library, name, cores, rounds, mask = sys.argv[2:]
        return measure(library, name, int(cores), int(rounds), mask)
    rounds = int(sys.argv[1]) if len(sys.argv) > 1 else 32
    print("| | first, ms | robot, ms | a second, 1 core | 2 cores | part, ms | million, ms | MB |\n"
          "|---|---|---|---|---|---|---|---|", flush=True)
    with display() as environment, tempfile.TemporaryDirectory() as folder:
        for library in LIBRARIES:
            line = row(library, rounds, Path(folder), environment)
            if line:
                print(line, flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
