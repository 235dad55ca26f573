"""What would lose data, hang, race or lose digits: each a test of its own."""
import copy
import io
import os
import pickle
import subprocess
import sys
import threading
import time
import warnings
import zlib

import numpy as np
import pytest
from shapes import box, torus

import shade_h as shade

VERTICES, FACES = box()
SMALL = {"size": (64, 48), "samples": 1}


def obj_text(vertices, faces, move=(0, 0, 0)):
    return "".join(f"v {x + move[0]!r} {y + move[1]!r} {z + move[2]!r}\n"
                   for x, y, z in np.asarray(vertices).tolist()) + \
        "".join("f " + " ".join(map(str, f)) + "\n" for f in (np.asarray(faces) + 1).tolist())


# ---- files that are written ----------------------------------------------------------------------

@pytest.mark.parametrize("words", [["b.stl"], ["b.obj"], ["b.jpg"], ["b.stl", "c.png"], ["b"],
                                   ["--views", "front,top", "b.ply"]])
def test_the_command_writes_no_picture_over_a_model(tmp_path, words):
    for name in "a.obj", "b.stl", "b.obj", "b.ply", "b.jpg", "b", "c.png":
        (tmp_path / name).write_text(obj_text(VERTICES, FACES), "utf-8")
    before = {p.name: p.read_bytes() for p in tmp_path.iterdir()}
    done = subprocess.run([sys.executable, "-m", "shade_h", "a.obj", *words], cwd=tmp_path,
                          stderr=subprocess.PIPE, text=True, check=False)
    assert done.returncode == 2 and len(done.stderr) > 20 and "Traceback" not in done.stderr
    assert {p.name: p.read_bytes() for p in tmp_path.iterdir()} == before


def test_a_picture_is_saved_under_names_that_end_in_png_or_ppm_alone(tmp_path):
    got = shade.render(VERTICES, FACES, **SMALL)
    for name in ("x.jpg", "x", "x.stl", "x.png.obj", b"x.pgm"):
        with pytest.raises(shade.Error, match="must end in .png"):
            got.save(name if isinstance(name, bytes) else tmp_path / name)
    with pytest.raises(shade.Error, match="must end in .png"):
        shade.assert_same(got, tmp_path / "part.stl")
    assert not list(tmp_path.iterdir())
    got.save(tmp_path / "X.PNG")
    got.save(os.fsencode(tmp_path / "y.png"))
    memory = io.BytesIO()
    got.save(memory)
    assert memory.getvalue() == (tmp_path / "X.PNG").read_bytes() == got.png()
    memory.seek(0)
    assert shade.Picture.open(memory) == got


# ---- files that are read -------------------------------------------------------------------------

def with_picture(folder, name):
    (folder / "m.mtl").write_text(f"newmtl a\nKd 1 0 0\nmap_Kd {name}\n", "utf-8")
    (folder / "m.obj").write_text("mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1"
                                  "\nusemtl a\nf 1/1 2/2 3/3\n", "utf-8")
    return folder / "m.obj"


def test_pictures_outside_of_the_folder_are_read_only_where_wanted(tmp_path):
    shade.Picture(np.full((1, 1, 4), 200, np.uint8)).save(tmp_path / "secret.png")
    (tmp_path / "in").mkdir()
    for name in ("../secret.png", "..\\secret.png", str(tmp_path / "secret.png")):
        model = with_picture(tmp_path / "in", name)
        with pytest.warns(UserWarning, match="secret.png lies outside of the model's folder"):
            assert shade.load(model).texture is None
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            shade.load(model, outside=True)


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="no pipes")
def test_devices_and_pipes_are_refused_at_once(tmp_path):
    os.mkfifo(tmp_path / "pipe")
    for name in ("/dev/zero", "pipe", "."):
        with pytest.warns(UserWarning, match="m.obj"):
            mesh = shade.load(with_picture(tmp_path, name))
        assert mesh.texture is None and len(mesh.faces) == 1
    for path in ("/dev/zero", tmp_path / "pipe"):
        with pytest.raises(shade.Error, match="no regular file"):
            shade.load(path)
        with pytest.raises(shade.Error, match="no regular file"):
            shade.Picture.open(path)


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="no pipes")
def test_surfaces_are_not_waited_for_either(tmp_path):
    os.mkfifo(tmp_path / "pipe")
    for name in ("pipe", "/dev/zero"):
        (tmp_path / "m.obj").write_text(f"mtllib {name}\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
        with pytest.warns(UserWarning, match="m.obj"):
            assert len(shade.load(tmp_path / "m.obj").faces) == 1


def test_a_picture_that_unpacks_to_more_than_it_says_takes_no_memory(tmp_path):
    small = shade.Picture(np.zeros((4, 4, 4), np.uint8)).png()
    at = small.index(b"IDAT") - 4
    bomb = zlib.compress(bytes(300_000_000), 9)
    forged = small[:at] + len(bomb).to_bytes(4, "big") + b"IDAT" + bomb + \
        zlib.crc32(b"IDAT" + bomb).to_bytes(4, "big") + small[-12:]
    (tmp_path / "b.png").write_bytes(forged)
    program = "import resource, sys, shade_h\n" \
        "before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss\n" \
        "assert shade_h.Picture.open(sys.argv[1]).size == (4, 4)\n" \
        "grown = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before\n" \
        "assert grown < 50_000, grown\n"
    subprocess.run([sys.executable, "-c", program, tmp_path / "b.png"], check=True)
    wide = bytearray(small)
    wide[16:24] = (16384).to_bytes(4, "big") * 2
    wide[29:33] = zlib.crc32(wide[12:29]).to_bytes(4, "big")
    with pytest.raises(shade.Error, match="at most"):
        shade.Picture.open(io.BytesIO(bytes(wide)))


def test_two_pictures_of_one_obj_are_drawn_and_a_missing_one_is_a_warning(tmp_path):
    for name, color in (("r", (255, 0, 0)), ("b", (0, 0, 255))):
        texels = np.full((8, 8, 4), 255, np.uint8)
        texels[:, :, :3] = color
        shade.Picture(texels).save(tmp_path / f"{name}.png")
    (tmp_path / "t.mtl").write_text("newmtl r\nKd 1 1 1\nmap_Kd r.png\nnewmtl b\nKd 1 1 1\n"
                                    "map_Kd b.png\n", "utf-8")
    (tmp_path / "t.obj").write_text(
        "mtllib t.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\nv 2 1 0\nvt 0 0\nvt 1 0\n"
        "vt 1 1\nvt 0 1\nusemtl r\nf 1/1 2/2 3/3 4/4\nusemtl b\nf 2/1 5/2 6/3 3/4\n", "utf-8")
    flat = {"view": "top", "ortho": True, "up": "z", **SMALL}
    got = shade.render(tmp_path / "t.obj", **flat).rgba.astype(int)
    assert got[24, 16, 0] > 100 > got[24, 16, 2] and got[24, 48, 2] > 100 > got[24, 48, 0]
    (tmp_path / "b.png").unlink()
    with pytest.warns(UserWarning, match="b.png is missing"):
        got = shade.render(tmp_path / "t.obj", **flat).rgba.astype(int)
    assert got[24, 16, 0] > 100 > got[24, 16, 2] and got[24, 48].min() > 100


def test_transparent_surfaces_of_an_obj_show_what_is_behind(tmp_path):
    (tmp_path / "g.mtl").write_text("newmtl red\nKd 1 0 0\nnewmtl glass\nKd 0 0 1\nd 0.5\n")
    (tmp_path / "g.obj").write_text(
        "mtllib g.mtl\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"
        "usemtl glass\nf 1 2 3 4\nusemtl red\nf 5 6 7 8\n", "utf-8")
    got = shade.render(tmp_path / "g.obj", view="top", ortho=True, up="z", **SMALL)
    red, _, blue, alpha = got.rgba[24, 32].tolist()
    assert red > 80 and blue > 80 and alpha == 255
    assert got.depth[24, 32] > got.depth[np.isfinite(got.depth)].max() - 0.01


def test_models_from_bytes_and_paths_of_any_kind(tmp_path):
    text = obj_text(VERTICES, FACES).encode()
    (tmp_path / "x.obj").write_bytes(text)
    wanted = shade.render(tmp_path / "x.obj", **SMALL)

    class Path:
        def __fspath__(self):
            return str(tmp_path / "x.obj")

    with open(tmp_path / "x.obj", "rb") as file:
        for one in (Path(), os.fsencode(tmp_path / "x.obj"), str(tmp_path / "x.obj"),
                    io.BytesIO(text), file):
            assert shade.render(one, **SMALL) == wanted
    with pytest.raises(shade.Error, match="open for bytes"):
        shade.load(io.StringIO("v 0 0 0"))


def test_the_upright_axis_is_that_of_the_format_and_can_be_said(tmp_path):
    (tmp_path / "x.obj").write_text(obj_text(VERTICES, FACES), "utf-8")
    assert shade.load(tmp_path / "x.obj").up == "y"
    turned = shade.render(VERTICES, FACES, up="y", **SMALL)
    assert shade.render(tmp_path / "x.obj", **SMALL) == turned
    plain = shade.render(VERTICES, FACES, **SMALL)
    assert shade.render(tmp_path / "x.obj", up="z", **SMALL) == plain
    # a table that lies: its legs end in small feet around a wide rectangle, along x
    parts = [(np.asarray(box(0.1, 2, 2)[0]), FACES)]
    for y in (0, 1.9):
        for z in (0, 1.9):
            parts.append((np.asarray(box(1.5, 0.1, 0.1)[0]) + [-1.5, y, z], FACES))
    vertices = np.concatenate([v for v, _ in parts])
    faces = np.concatenate([f + 8 * i for i, (_, f) in enumerate(parts)])
    (tmp_path / "table.obj").write_text(obj_text(vertices, faces), "utf-8")
    table = shade.load(tmp_path / "table.obj")
    assert table.up in ("x", "y")
    for up in ("x", "-x", "y", "-y", "-z"):
        side = shade.render(VERTICES, FACES, view="front", ortho=True, up=up, **SMALL)
        axis = "xyz".index(up[-1])
        rows = np.argwhere((side.ids == 0).any(1))
        columns = np.argwhere((side.ids == 0).any(0))
        tall, wide = np.ptp(rows) + 1, np.ptp(columns) + 1
        across = {"x": 1, "y": 0, "z": 0}[up[-1]]
        assert tall / wide == pytest.approx((3, 2, 1)[axis] / (3, 2, 1)[across], rel=0.1)


# ---- digits --------------------------------------------------------------------------------------

def grid(vertices):
    """Coordinates that doubles keep at 1e8."""
    return np.round(np.asarray(vertices) * 1024) / 1024


@pytest.mark.parametrize("shift", [1e6, 1e8, (4.5e5, 5.2e6, 300.0)])
@pytest.mark.parametrize("ortho", [False, True])
def test_a_mesh_far_from_the_origin_has_the_same_picture(shift, ortho):
    vertices, faces, _ = torus(24)
    vertices = grid(vertices)
    one = shade.render(vertices, faces, edges=True, ortho=ortho, size=(160, 120))
    far = shade.render(vertices + shift, faces, edges=True, ortho=ortho, size=(160, 120))
    assert np.array_equal(one.ids, far.ids)
    if np.isscalar(shift):
        assert one == far and np.array_equal(one.depth, far.depth)
    assert (one.difference(far) > 8).mean() < 0.01


@pytest.mark.parametrize("kind", [np.float32, np.float64])
def test_faces_that_cannot_be_seen_do_not_shrink_the_picture(kind):
    vertices, faces, _ = torus(24)
    n = len(vertices)
    more = np.concatenate([vertices, np.full((3, 3), 5e6)]).astype(kind)
    hidden = [[n, n + 1, n + 2, n], [n, n, n, n], [0, 0, n, n]]
    got = shade.render(more, np.concatenate([faces, hidden]), size=(160, 120))
    assert got == shade.render(vertices.astype(kind), faces, size=(160, 120))


def test_cameras_lamps_and_poses_speak_the_callers_coordinates():
    vertices, faces, _ = torus(24)
    shift = np.array([1e8, -1e8, 3e7])

    def scene(move, by_pose):
        made = shade.Scene([shade.Light.point(np.array([4, -4, 5]) + move, (30, 30, 30),
                                              attenuation=(1, 0, 1))], (0.2, 0.2, 0.2))
        pose = np.eye(4)
        pose[:3, 3] = move if by_pose else 0
        made.add((grid(vertices) + (0 if by_pose else move), faces), pose, edges=True)
        camera = shade.Camera.look_at(np.array([5, -6, 4]) + move, move, aspect=4 / 3)
        return made, camera

    near, camera = scene(np.zeros(3), False)
    wanted = near.render(camera, (120, 90))
    for by_pose in (False, True):
        far, camera = scene(shift, by_pose)
        got = far.render(camera, (120, 90))
        assert np.array_equal(got.ids, wanted.ids)
        assert (got.difference(wanted) > 2).mean() < 0.02    # an edge more or less
        assert np.allclose(got.depth, wanted.depth, rtol=1e-5)
        poses = np.stack([part.pose for part in far.parts])[None]
        rgb, depth, ids = far.render_batch(camera, poses, size=(120, 90))
        assert np.array_equal(ids[0], far.render(camera, (120, 90), samples=1).ids)
        assert np.array_equal(depth[0], far.render(camera, (120, 90), samples=1).depth)
    # a pixel taken back to the world by camera and depth lies on the torus
    y, x = np.argwhere(got.ids == 0)[500]
    way = np.array([((x + .5) / 60 - 1) / camera.projection[0, 0],
                    (1 - (y + .5) / 45) / camera.projection[1, 1], -1])
    world = camera.eye + camera.view[:3, :3].T @ way * got.depth[y, x] - shift
    around = np.hypot(np.hypot(world[0], world[1]) - 2, world[2])
    assert around == pytest.approx(0.8, abs=0.02)


@pytest.mark.parametrize("kind", ["obj", "stl", "ply", "binary", "wrapped ply", "wrapped stl",
                                  "spare ply"])
def test_files_of_surveyors_are_centred_in_double(tmp_path, kind):
    vertices, faces, _ = torus(24)
    vertices, triangles = grid(vertices), faces[:, [0, 1, 2, 0, 2, 3]].reshape(-1, 3)
    far = vertices + [4.5e7, 5.2e7, 0]
    head = "ply\nformat {} 1.0\nelement vertex {}\nproperty double x\nproperty double y\n" \
        "property double z\nelement face {}\nproperty list uchar int vertex_indices\nend_header\n"
    if kind == "obj":
        text = obj_text(far, triangles).encode()
    elif kind.endswith("stl"):
        text = (f"solid {'a' * 3000}\n" + "".join(
            "facet normal 0 0 0\nouter loop\n" + "".join(
                "vertex {!r} {!r} {!r}\n".format(*p) for p in t) + "endloop\nendfacet\n"
            for t in far[triangles].tolist()) + "endsolid a\n").encode()
    elif kind.endswith("ply"):
        if kind == "spare ply":    # a vertex that no face has comes first
            far, triangles = np.concatenate([[[1.25, 1e3, -7]], far]), triangles + 1
        text = (head.format("ascii", len(far), len(triangles)) + "".join(
            "{!r} {!r} {!r}\n".format(*p) for p in far.tolist()) + "".join(
            "3 {} {} {}\n".format(*t) for t in triangles.tolist())).encode()
    else:
        rows = np.zeros(len(triangles), [("n", "u1"), ("i", "<i4", 3)])
        rows["n"], rows["i"] = 3, triangles
        text = head.format("binary_little_endian", len(far), len(triangles)).encode() + \
            far.astype("<f8").tobytes() + rows.tobytes()
    if kind.startswith("wrapped"):    # words stand on any line, and lines may be empty
        start = text.index(b"end_header\n") + 11 if kind.endswith("ply") else text.index(b"\n") + 1
        text = text[:start] + b"\n\n" + text[start:].replace(b"\n", b" ").replace(b" ", b"\n", 7)
    name = tmp_path / f"a.{'ply' if kind == 'binary' else kind[-3:]}"
    name.write_bytes(text)
    mesh = shade.load(name)
    used = mesh.vertices[np.unique(mesh.faces)]
    far, triangles = far[np.unique(triangles)], triangles - triangles.min()
    low, high = used.min(0), used.max(0)
    assert np.array_equal(low, far.min(0)) and np.array_equal(high, far.max(0))
    got = shade.render(mesh, up="z", normals="flat", **SMALL)
    plain = shade.render(vertices, triangles, normals="flat", **SMALL)
    assert (got.ids != plain.ids).mean() < 0.01 and got.difference(plain).mean() < 3


# ---- threads and signals -------------------------------------------------------------------------

def test_eight_threads_share_a_mesh_with_edges():
    vertices, faces, _ = torus(40)
    wanted = shade.render(shade.Mesh(vertices, faces), edges=True, threads=1, **SMALL)
    before = sys.getswitchinterval()
    sys.setswitchinterval(1e-5)
    try:
        for _ in range(6):
            mesh, wrong = shade.Mesh(vertices, faces), []
            start = threading.Barrier(8)

            def draw():
                start.wait()
                try:
                    if shade.render(mesh, edges=True, threads=1, **SMALL) != wanted:
                        wrong.append("another picture")
                except Exception as why:
                    wrong.append(repr(why))

            threads = [threading.Thread(target=draw) for _ in range(8)]
            for thread in threads:
                thread.start()
            for thread in threads:
                thread.join()
            assert not wrong
    finally:
        sys.setswitchinterval(before)


@pytest.mark.skipif(sys.platform == "win32", reason="signals of POSIX")
def test_ctrl_c_ends_the_studio_before_it_is_done():
    program = "import signal, numpy as np, shade_h\n" \
        "signal.signal(signal.SIGINT, signal.default_int_handler)\n" \
        "u = np.linspace(0, 6, 1200)\n" \
        "x, y = np.meshgrid(u, u)\n" \
        "v = np.stack([x, y, np.sin(3 * x) * np.cos(2 * y)], -1).reshape(-1, 3)\n" \
        "i = (np.arange(1199)[:, None] * 1200 + np.arange(1199)).reshape(-1)\n" \
        "mesh = shade_h.Mesh(v, np.stack([i, i + 1, i + 1201, i + 1200], 1), normals='smooth')\n" \
        "print('ready', flush=True)\n" \
        "shade_h.render(mesh, light='studio', size=2000, samples=4, threads=1)\n" \
        "print('drawn', flush=True)\n"
    process = subprocess.Popen([sys.executable, "-c", program], stdout=subprocess.PIPE,
                               stderr=subprocess.PIPE, text=True)
    assert process.stdout.readline() == "ready\n"
    time.sleep(0.3)
    process.send_signal(2)
    told, why = process.communicate(timeout=120)
    assert "drawn" not in told and "KeyboardInterrupt" in why


@pytest.mark.skipif(sys.platform == "win32", reason="signals of POSIX")
def test_ctrl_c_ends_load_before_it_is_done_and_frees_its_memory():
    # 4 million triangles that have nothing in common
    program = "import io, os, signal, struct, threading, time, numpy as np, shade_h\n" \
        "signal.signal(signal.SIGINT, signal.default_int_handler)\n" \
        "data = bytes(80) + struct.pack('<I', 4000000) + np.random.default_rng(1).bytes(200000000)\n" \
        "memory = lambda: int(open('/proc/self/statm').read().split()[1]) * 4096\n" \
        "before, sent = memory(), []\n" \
        "def send():\n" \
        "    while memory() < before + 150e6: time.sleep(0.01)\n" \
        "    sent.append(time.process_time())\n" \
        "    os.kill(os.getpid(), signal.SIGINT)\n" \
        "threading.Thread(target=send).start()\n" \
        "try:\n" \
        "    shade_h.load(io.BytesIO(data))\n" \
        "except KeyboardInterrupt:\n" \
        "    print(time.process_time() - sent[0])\n" \
        "for _ in range(300):    # the thread that reads may be late on a busy machine\n" \
        "    if memory() > before + 60e6: time.sleep(0.1)\n" \
        "print((memory() - before) / 1e6)\n"
    run = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True,
                         timeout=120)
    seconds, megabytes = map(float, run.stdout.split())
    assert seconds < 0.5 and megabytes < 60


# ---- arguments -----------------------------------------------------------------------------------

@pytest.mark.parametrize("vertices", [np.full((8, 3), np.nan), np.full((8, 3), 1e35),
                                      np.zeros((8, 3))])
def test_a_mesh_that_cannot_be_seen_is_a_warning(vertices):
    with pytest.warns(UserWarning, match="can be seen"):
        assert shade.render(vertices, FACES, **SMALL).blank
    with pytest.warns(UserWarning, match="no triangles"):
        shade.render(VERTICES, np.zeros((0, 3), int), **SMALL)


@pytest.mark.parametrize("color", [(2, 0, 0), (0, -1, 0), (256, 0, 0), (0.1, 1.5, 0),
                                   (float("nan"), 0, 0), np.full((8, 3), 1.5)])
def test_a_color_out_of_range_is_refused(color):
    with pytest.raises(shade.Error, match="color"):
        if np.shape(color) == (3,) and color == (2, 0, 0):
            color = (2.0, 0, 0)
        shade.render(VERTICES, FACES, color=color, **SMALL)


def test_words_and_whole_numbers_mean_what_they_look_like():
    with pytest.raises(shade.Error, match="material='jade'"):
        shade.render(VERTICES, FACES, color="jade", **SMALL)
    gold = shade.render(VERTICES, FACES, color="#ffd700", **SMALL)    # a material too, but CSS has the colour
    assert shade.render(VERTICES, FACES, color="Gold", **SMALL) == gold
    red = shade.render(VERTICES, FACES, color=(1.0, 0, 0), **SMALL)
    assert shade.render(VERTICES, FACES, color=(1, 0, 0), **SMALL) == red
    assert shade.render(VERTICES, FACES, color=np.uint8([255, 0, 0]), **SMALL) == red


def test_a_list_of_meshes_is_one_picture():
    moved = np.asarray(VERTICES) + [4, 0, 0]
    for both in ([(VERTICES, FACES), (moved, FACES)],
                 [shade.Mesh(VERTICES, FACES), shade.Mesh(moved, FACES)]):
        assert set(np.unique(shade.render(both, **SMALL).ids)) == {-1, 0, 1}
    pair = shade.render([VERTICES, FACES], **SMALL)
    assert pair == shade.render([np.asarray(VERTICES).tolist(), FACES.tolist()], **SMALL)
    assert set(np.unique(pair.ids)) == {-1, 0}


def test_arrays_and_words_of_objects():
    got = shade.render(VERTICES, FACES, **SMALL)
    assert np.asarray(got) is got.rgba and np.asarray(got, float).dtype == float
    assert "64 x 48" in repr(got) and "% covered" in repr(got)
    assert repr(shade.Mesh(VERTICES, FACES)) == "<shade_h.Mesh of 12 triangles, 3 x 2 x 1>"
    scene = shade.Scene()
    scene.add((VERTICES, FACES), name="lid")
    assert repr(scene) == "<shade_h.Scene of 1 parts: lid>"
    assert "Camera(view=" in repr(scene.fit())


def test_meshes_scenes_and_pictures_can_be_pickled_and_copied():
    vertices, faces = box(1, 2, 3)
    texture = np.arange(4 * 4 * 3, dtype=np.uint8).reshape(4, 4, 3)
    mesh = shade.Mesh(vertices + 1e7, faces, uv=vertices[:, :2], texture=texture, normals="flat")
    scene = shade.Scene()
    scene.add(mesh, edges=True)
    scene.add_label((1e7, 1e7, 1e7), "a")
    wanted = scene.render("iso", 48)
    for again in (lambda made: pickle.loads(pickle.dumps(made)), copy.deepcopy, copy.copy):
        got = again(wanted)
        assert got == wanted and got.report() == wanted.report()
        assert again(scene).render("iso", 48) == wanted
        assert shade.render(again(mesh), size=48) == shade.render(mesh, size=48)


def test_normals_without_a_direction_are_made_anew():
    vertices, faces = box(1, 2, 3)
    smooth = shade.render(vertices, faces, size=48, normals="smooth")
    made = shade.Mesh(vertices, faces, normals="smooth").normals
    for wrong in (0, np.nan, np.inf):
        given = made.copy()
        given[::3] = wrong
        assert shade.render(vertices, faces, size=48, normals=given) == smooth
    for length in (1e30, 1e-30):
        got = shade.render(vertices, faces, size=48, normals=made * np.float32(length))
        assert got.difference(smooth).max() <= 1


def test_masked_values_are_refused_and_views_of_memory_taken():
    vertices, faces = box(1, 2, 3)
    wanted = shade.render(vertices, faces, size=16)
    assert shade.render(memoryview(vertices), memoryview(faces), size=16) == wanted
    assert shade.render(np.ma.masked_array(vertices, False), faces, size=16) == wanted
    with pytest.raises(shade.Error, match="vertices has masked values"):
        shade.render(np.ma.masked_array(vertices, vertices > 1.5), faces)
