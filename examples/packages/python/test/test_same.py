"""The pictures have the bytes of the C library."""
import os
import subprocess
from pathlib import Path

import numpy as np
import pytest
from shapes import torus

import shade_h as shade

TOP = Path(__file__).resolve().parents[4]
EYE, SIZE = (4.0, -6.0, 5.0), (320, 240)


def scene():
    vertices, faces, normals = torus()
    lamp = shade.Light.directional((-1, 1, -2), (1, 0.9, 0.8))
    made = shade.Scene([lamp], (0.25, 0.25, 0.25))
    made.add((vertices, faces), material="gold", normals=normals, two_sided=False)
    camera = shade.Camera.look_at(EYE, fov=40, aspect=4 / 3, near=1, far=20)
    return made, camera


@pytest.mark.skipif(not (TOP / "shade.h").is_file(), reason="needs a clone")
def test_a_c_program_draws_the_same_bytes(tmp_path):
    program = tmp_path / "same"
    subprocess.run([os.environ.get("CC", "cc"), "-std=c99", "-O1", f"-I{TOP}",
                    Path(__file__).with_name("same.c"), "-lm", "-o", program], check=True)
    made, camera = scene()
    mesh = made.parts[0].mesh
    head = np.array([len(mesh.positions), mesh.indices.size, *SIZE], np.int32)
    parts = [head, camera.view.T.astype(np.float32), camera.projection.T.astype(np.float32),
             mesh.positions, mesh.normals, mesh.indices]
    told = subprocess.run([program], input=b"".join(p.tobytes() for p in parts), check=True,
                          stdout=subprocess.PIPE).stdout
    wanted = np.frombuffer(told, np.uint8).reshape(240, 320, 4)
    assert len(np.unique(wanted)) > 50
    assert np.array_equal(made.render(camera, SIZE, samples=1).rgba, wanted)


@pytest.mark.parametrize("samples", [1, 2, 3])
def test_threads_change_no_byte(samples):
    made, camera = scene()
    one = made.render(camera, (200, 151), samples=samples, threads=1)
    for threads in (2, 3, 7):
        other = made.render(camera, (200, 151), samples=samples, threads=threads)
        assert one == other and np.array_equal(one.depth, other.depth)
        assert np.array_equal(one.ids, other.ids) and np.array_equal(one.normals, other.normals)


def test_a_batch_has_the_pictures_of_single_renders():
    made, _ = scene()
    cameras = [shade.Camera.look_at((6 * np.cos(a), 6 * np.sin(a), 4)) for a in range(5)]
    rgb, depth, ids = made.render_batch(cameras, size=(96, 64))
    for i, camera in enumerate(cameras):
        one = made.render(camera, (96, 64), samples=1)
        assert np.array_equal(rgb[i], one.rgba[:, :, :3])
        assert np.array_equal(depth[i], one.depth) and np.array_equal(ids[i], one.ids)
