"""Depth, ids, normals, cameras and files of pictures, against geometry."""
import errno
import io
import os
import struct
import subprocess
import sys
import threading
import zlib

import numpy as np
import pytest
from shapes import box, torus

import shade_h as shade


def ray(camera, size, x, y):
    """The eye, and the direction through a pixel's centre whose part along the view is 1."""
    at = np.array([(x + .5) / size[0] * 2 - 1, 1 - (y + .5) / size[1] * 2])
    way = np.array([at[0] / camera.projection[0, 0], at[1] / camera.projection[1, 1], -1])
    return camera.eye, camera.view[:3, :3].T @ way


def test_depth_is_the_distance_along_the_axis_of_view():
    camera = shade.Camera.look_at((7, -8, 6), (1, 1, 0.5), fov=30, near=0.1, far=1000)
    scene = shade.Scene()
    scene.add(box())
    got = scene.render(camera, (160, 160), samples=2)
    seen = 0
    for y in range(5, 160, 10):
        for x in range(5, 160, 10):
            eye, way = ray(camera, (160, 160), x, y)
            with np.errstate(divide="ignore"):
                low, high = (0 - eye) / way, (np.array([3, 2, 1]) - eye) / way
            enter, leave = np.minimum(low, high).max(), np.maximum(low, high).min()
            if enter < leave - 0.1:
                assert got.depth[y, x] == pytest.approx(enter, rel=1e-4)
                assert got.ids[y, x] == 0
                axis = np.minimum(low, high).argmax()
                assert got.normals[y, x] == pytest.approx(-np.sign(way[axis]) * np.eye(3)[axis],
                                                          abs=1e-5)
                seen += 1
            elif enter > leave + 0.1:
                assert np.isinf(got.depth[y, x]) and got.ids[y, x] == -1
    assert seen > 20


def test_the_nearest_part_has_the_pixel():
    scene = shade.Scene()
    numbers = []
    for z in (2.0, 0.0, 4.0):
        pose = np.eye(4)
        pose[2, 3] = z
        numbers.append(scene.add(box(1, 1, 0.1), pose, color="red"))
    got = scene.render("top", (64, 64), ortho=True)
    assert numbers == [0, 1, 2]
    assert got.ids[32, 32] == 2
    assert set(np.unique(got.ids)) == {-1, 2}


@pytest.mark.parametrize("view", [*shade.VIEWS, (30, 20), (200, -50)])
@pytest.mark.parametrize("ortho", [False, True])
def test_a_fitted_view_shows_all_and_fills_the_picture(view, ortho):
    vertices, faces, _ = torus(24)
    got = shade.render(vertices * 1e-3 + 5, faces, view=view, ortho=ortho, size=(120, 90),
                       samples=1)
    there = np.argwhere(got.ids == 0)
    low, high = there.min(0), there.max(0)
    assert (low >= 1).all() and (high <= (88, 118)).all()
    assert ((high - low) / (90, 120)).max() > 0.8


def test_opencv_cameras_project_as_their_equation_says():
    k = np.array([[150.0, 0, 70], [0, 140, 50], [0, 0, 1]])
    turn = np.array([[1.0, 0, 0], [0, 0, -1], [0, 1, 0]])
    extrinsics = np.column_stack([turn, [0.1, 0.2, 5]])
    camera = shade.Camera.opencv(k, extrinsics, (128, 96))
    point = np.array([0.3, 0.4, -0.2])
    u, v, w = k @ (extrinsics @ [*point, 1])
    clip = camera.projection @ camera.view @ [*point, 1]
    assert (clip[0] / clip[3] + 1) * 64 - 0.5 == pytest.approx(u / w, abs=1e-4)
    assert (1 - clip[1] / clip[3]) * 48 - 0.5 == pytest.approx(v / w, abs=1e-4)
    again = shade.Camera.opengl(camera.projection, np.linalg.inv(camera.view))
    assert np.allclose(again.view, camera.view, atol=1e-5)


def test_transparent_edges_keep_the_colour_of_the_mesh():
    scene = shade.Scene([], ambient=(1, 1, 1))
    scene.add(torus(24)[:2], material=shade.Material(ambient=(0.2, 0.5, 0.8)))
    rgba = scene.render(background=None, size=(90, 70)).rgba
    partly = rgba[(rgba[:, :, 3] > 20) & (rgba[:, :, 3] < 235)]
    inside = rgba[rgba[:, :, 3] == 255][0]
    assert len(partly) > 50 and rgba[0, 0].tolist() == [0, 0, 0, 0]
    assert np.abs(partly[:, :3].astype(int) - inside[:3]).max() <= 1


def test_png_files_come_back_and_other_programs_read_them(tmp_path):
    image = pytest.importorskip("PIL.Image")
    for background in (None, "white"):
        got = shade.render(*torus(16)[:2], size=(70, 50), background=background)
        got.save(tmp_path / "a.png")
        assert shade.Picture.open(tmp_path / "a.png") == got
        other = image.open(io.BytesIO(got.png()))
        assert np.array_equal(np.asarray(other.convert("RGBA")), got.rgba)
        other.save(tmp_path / "b.png", optimize=True)
        assert shade.Picture.open(tmp_path / "b.png") == got
    assert [p.name for p in tmp_path.iterdir() if p.name.endswith(".part")] == []


@pytest.mark.skipif(os.name == "nt", reason="modes and links of POSIX")
def test_a_file_that_exists_stays_the_same_file(tmp_path):
    one, two = (shade.render(*box(), size=(w, 40)) for w in (90, 20))
    one.save(tmp_path / "a.png")
    os.chmod(tmp_path / "a.png", 0o640)
    (tmp_path / "link.png").symlink_to("a.png")
    (tmp_path / "new.png").symlink_to("b.png")
    os.link(tmp_path / "a.png", tmp_path / "hard.png")
    before, reader = (tmp_path / "a.png").stat(), (tmp_path / "a.png").open("rb")
    two.save(tmp_path / "link.png")
    after = (tmp_path / "a.png").stat()
    assert (tmp_path / "link.png").is_symlink() and after.st_mode == before.st_mode
    assert after.st_ino == before.st_ino and after.st_nlink == 2
    assert shade.Picture.open(reader) == two == shade.Picture.open(tmp_path / "hard.png")
    two.save(tmp_path / "new.png")
    assert (tmp_path / "new.png").is_symlink() and shade.Picture.open(tmp_path / "b.png") == two
    assert sorted(p.name for p in tmp_path.iterdir()) == ["a.png", "b.png", "hard.png", "link.png", "new.png"]


def test_threads_save_under_one_name(tmp_path):
    """None fails, and the last one to write leaves its picture whole."""
    pictures = [shade.render(*box(), size=(20 + 40 * i, 30)) for i in range(4)]
    failed = []

    def save(picture, names):
        for name in names:
            try:
                picture.save(tmp_path / name)
            except Exception as why:
                failed.append(why)

    names = [f"{i % 15}.png" for i in range(60)]
    threads = [threading.Thread(target=save, args=(p, names)) for p in pictures]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert failed == []
    for path in tmp_path.iterdir():
        assert path.suffix == ".png" and shade.Picture.open(path) in pictures


def test_a_full_disk_leaves_the_file(tmp_path):
    resource, picture = pytest.importorskip("resource"), shade.render(*box(), size=(300, 300))
    picture.save(tmp_path / "a.png")
    run = f"""
import resource, signal, shade_h
signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
resource.setrlimit(resource.RLIMIT_FSIZE, (1000, 1000))
try:
    shade_h.Picture.open({str(tmp_path / 'a.png')!r}).save({str(tmp_path / 'b.png')!r})
except OSError as why:
    print(why.errno)
import numpy as np
try:
    shade_h.Picture(np.random.default_rng(1).integers(0, 255, (90, 90, 4), np.uint8)).save({str(tmp_path / 'a.png')!r})
except OSError as why:
    print(why.errno)
"""
    said = subprocess.run([sys.executable, "-c", run], capture_output=True, text=True, check=True).stdout
    assert said.split() == [str(errno.EFBIG)] * 2
    assert shade.Picture.open(tmp_path / "a.png") == picture and len(list(tmp_path.iterdir())) == 1


def test_assert_same_writes_the_difference(tmp_path):
    one = shade.render(*box(), size=(60, 40))
    two = shade.render(*box(), size=(60, 40), color="red")
    golden = tmp_path / "golden.png"
    with pytest.raises(AssertionError, match="there is no"):
        shade.assert_same(one, golden)
    one.save(golden)
    shade.assert_same(one, golden)
    with pytest.raises(AssertionError, match="pixels differ"):
        shade.assert_same(two, golden)
    shown = shade.Picture.open(tmp_path / "golden.difference.png").rgba[:, :, 0]
    assert np.array_equal(shown > 0, one.difference(two) > 0)
    assert one != two and one == shade.Picture(one.rgba.copy())


def test_colours_by_face_and_vertex_and_texture():
    vertices, faces = box(1, 1, 1)
    lit = {"view": "top", "size": (40, 40), "samples": 1, "ortho": True}
    triangles = faces[:, [0, 1, 2, 0, 2, 3]].reshape(-1, 3)
    colors = np.zeros((12, 3))
    colors[10:, 1] = 1
    middle = shade.render(vertices, triangles, color=colors, **lit).rgba[20, 20]
    assert middle[1] > 150 and middle[0] < 60
    by_vertex = np.repeat([[255, 0, 0], [0, 0, 255]], 4, 0).astype(np.uint8)
    got = shade.render(vertices, faces, color=by_vertex, **lit).rgba
    assert got[20, 5, 0] > got[20, 5, 2] and got[20, 34, 2] > got[20, 34, 0]
    texture = np.zeros((8, 8, 3), np.uint8)
    texture[:4, :, 0] = 255    # the upper half: v from 1/2 to 1
    got = shade.render(vertices, faces, uv=vertices[:, :2], texture=texture, **lit).rgba
    assert got[8, 20, 0] > 150 and got[32, 20, 0] < 60


def test_the_objects_of_other_libraries():
    vertices, faces = box()
    triangles = faces[:, [0, 1, 2, 0, 2, 3]].reshape(-1, 3)

    class Visual:
        kind = "face"
        face_colors = np.tile(np.uint8([200, 30, 30, 255]), (12, 1))

    class Trimesh:
        pass

    class Vector:
        def __init__(self, p):
            self.x, self.y, self.z = p

        def toTuple(self):
            return self.x, self.y, self.z

    class Shape:
        def tessellate(self, tolerance):
            return [Vector(p) for p in vertices], [tuple(map(int, f)) for f in triangles]

    mesh = Trimesh()
    mesh.vertices, mesh.faces, mesh.visual = vertices, triangles, Visual()
    plain = shade.render(vertices, triangles, size=(50, 50))
    assert shade.render(Shape(), size=(50, 50)) == plain
    assert shade.render(*Shape().tessellate(1), size=(50, 50)) == plain
    red = shade.render(mesh, size=(50, 50))
    assert np.array_equal(red.depth, plain.depth)
    rgb = red.rgba[red.ids == 0].mean(0)
    assert rgb[0] > 2 * rgb[1]


def stl(vertices, triangles, text):
    corner = np.asarray(vertices, np.float32)[triangles]
    if text:
        lines = ["solid box"]
        for t in corner:
            lines += ["facet normal 0 0 0", "outer loop"]
            lines += [f"vertex {x} {y} {z}" for x, y, z in t.tolist()]
            lines += ["endloop", "endfacet"]
        return "\n".join([*lines, "endsolid box", ""]).encode()
    body = b"".join(bytes(12) + t.tobytes() + b"\0\0" for t in corner)
    return bytes(80) + struct.pack("<I", len(corner)) + body


def test_files_and_the_command(tmp_path):
    vertices, faces = box()
    triangles = faces[:, [0, 1, 2, 0, 2, 3]].reshape(-1, 3)
    obj = "".join("v {} {} {}\n".format(*p) for p in vertices.tolist()) + \
        "".join("f {} {} {} {}\n".format(*f) for f in (faces + 1).tolist())
    ply = "ply\nformat ascii 1.0\nelement vertex 8\nproperty float x\nproperty float y\n" \
        "property float z\nelement face 6\nproperty list uchar int vertex_indices\nend_header\n" + \
        "".join("{} {} {}\n".format(*p) for p in vertices.tolist()) + \
        "".join("4 {} {} {} {}\n".format(*f) for f in faces.tolist())
    files = {"a.stl": stl(vertices, triangles, True), "b.stl": stl(vertices, triangles, False),
             "c.obj": obj.encode(), "d.ply": ply.encode()}
    for name, data in files.items():
        (tmp_path / name).write_bytes(data)
        mesh = shade.load(tmp_path / name)
        assert len(mesh.faces) == 12
        assert np.array_equal(mesh.vertices.max(0), [3, 2, 1])
        got = shade.render(tmp_path / name, size=(80, 60), up="z")
        assert np.array_equal(got.ids, shade.render(vertices, triangles, size=(80, 60)).ids)
    done = subprocess.run([sys.executable, "-m", "shade_h", tmp_path / "b.stl", tmp_path / "s.png",
                           "--views", "front,right,top,iso", "--size", "100x80"], check=False)
    assert done.returncode == 0
    assert shade.Picture.open(tmp_path / "s.png").size == (406, 80)
    done = subprocess.run([sys.executable, "-m", "shade_h", tmp_path, tmp_path / "t.png"],
                          stderr=subprocess.PIPE, text=True, check=False)
    assert done.returncode == 1 and done.stderr.count("\n") == 1


def test_the_surfaces_of_an_obj_file(tmp_path):
    vertices, faces = box(2, 2, 2)
    head = "mtllib b.mtl\n" + "".join("v {} {} {}\n".format(*p) for p in vertices.tolist())
    body = "".join("usemtl {}\nf {} {} {} {}\n".format("ab"[i == 5], *f)
                   for i, f in enumerate((faces + 1).tolist()))
    (tmp_path / "b.obj").write_text(head + body, "utf-8")
    (tmp_path / "b.mtl").write_text("newmtl a\nKd 1 0 0\nnewmtl b\nKd 0 0 1\n", "utf-8")
    top = {"view": "top", "size": (40, 40), "samples": 1, "ortho": True, "up": "z"}
    blue = shade.render(tmp_path / "b.obj", **top).rgba[20, 20]
    red = shade.render(tmp_path / "b.obj", **{**top, "view": "bottom"}).rgba[20, 20]
    assert blue[2] > 100 > blue[0] and red[0] > 100 > red[2]
    grey = shade.render(tmp_path / "b.obj", color="gray", **top).rgba[20, 20].astype(int)
    assert abs(grey[0] - grey[2]) < 20
    # as many faces as vertices: the colours are still those of faces
    (tmp_path / "t.obj").write_text(
        "mtllib b.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nusemtl a\nf 1 3 2\nf 1 2 4\n"
        "f 1 4 3\nusemtl b\nf 2 3 4\n", "utf-8")
    far = shade.render(tmp_path / "t.obj", view=(135, 30), size=(40, 40), samples=1, up="z")
    assert (far.rgba[far.ids == 0][:, 2] > far.rgba[far.ids == 0][:, 0]).all()


def test_the_picture_on_an_obj_file(tmp_path):
    texels = np.full((2, 2, 4), 255, np.uint8)
    texels[:, :, :3] = [[[255, 0, 0], [0, 255, 0]], [[0, 0, 255], [255, 255, 0]]]
    shade.Picture(np.repeat(np.repeat(texels, 16, 0), 16, 1)).save(tmp_path / "q.png")
    (tmp_path / "q.mtl").write_text("newmtl m\nKd 1 1 1\nmap_Kd C:\\parts\\q.png\n", "utf-8")
    (tmp_path / "q.obj").write_text(
        "mtllib q.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
        "usemtl m\nf 1/1 2/2 3/3 4/4\n", "utf-8")
    got = shade.render(tmp_path / "q.obj", view="top", size=(64, 64), ortho=True, samples=1,
                       up="z").rgba
    for y, x, wanted in ((16, 16, (1, 0, 0)), (16, 48, (0, 1, 0)), (48, 16, (0, 0, 1)),
                         (48, 48, (1, 1, 0))):
        assert np.array_equal(got[y, x, :3] > 128, np.array(wanted, bool))
    (tmp_path / "q.png").unlink()
    with pytest.warns(UserWarning, match="q.png lies outside of the model's folder"):
        assert shade.load(tmp_path / "q.obj").texture is None


def test_a_sheet_has_one_scale_in_a_row():
    got = shade.sheet(box(3, 2, 1), ["front", "right", "top"], size=(120, 100), gap=0, edges=False)
    wide = [np.ptp(np.argwhere(got.ids[:, 120 * i:120 * i + 120] == 0), 0) + 1 for i in range(3)]
    unit = wide[0][1] / 3
    assert wide[0] == pytest.approx([unit, 3 * unit], abs=2)
    assert wide[1] == pytest.approx([unit, 2 * unit], abs=2)
    assert wide[2] == pytest.approx([2 * unit, 3 * unit], abs=2)


def test_hidden_edges_stay_hidden_whatever_near_and_far_are():
    scene = shade.Scene()
    scene.add(box(3, 2, 1), edges=True)
    look = {"eye": (7, -6, 5), "target": (1.5, 1, 0.5), "fov": 25}
    pictures = [scene.render(shade.Camera.look_at(**look, near=near, far=far), (160, 160))
                for near, far in ((6, 14), (1, 1000), (0.01, 1000))]
    faces = shade.Scene()
    faces.add(box(3, 2, 1))
    plain = faces.render(shade.Camera.look_at(**look), (160, 160))
    assert pictures[0].difference(plain).max() > 60
    for other in pictures[1:]:
        assert (pictures[0].difference(other) > 8).mean() < 0.002


def test_edges_of_a_box_are_dark_lines():
    flat = {"view": "top", "ortho": True, "size": (100, 100), "samples": 2}
    got = shade.render(*box(1, 1, 1), edges=True, **flat).rgba[:, :, :3].astype(int).sum(2)
    bare = shade.render(*box(1, 1, 1), **flat).rgba[:, :, :3].astype(int).sum(2)
    rows = np.argwhere(got[:, 50] < 400).reshape(-1)
    assert bare[:, 50].min() > 400 and len(rows) >= 2
    assert (np.minimum(np.abs(rows - 3), np.abs(rows - 96)) <= 3).all()


KINDS = {"L": (1, 2, 4, 8, 16), "RGB": (8, 16), "P": (1, 2, 4, 8), "LA": (8, 16), "RGBA": (8, 16)}


def png_of(rng, kind, depth, interlaced, width=13, height=11, clear=False, filters=range(5)):
    """A PNG of random samples, with all filters, and its samples (H, W, channels)."""
    channels = {"L": 1, "RGB": 3, "P": 1, "LA": 2, "RGBA": 4}[kind]
    samples = rng.integers(0, 1 << depth, (height, width, channels))
    passes = [(0, 0, 8, 8), (4, 0, 8, 8), (0, 4, 4, 8), (2, 0, 4, 4), (0, 2, 2, 4), (1, 0, 2, 2), (0, 1, 1, 2)]
    raw, step = b"", max(1, channels * depth // 8)
    for x, y, right, down in passes if interlaced else [(0, 0, 1, 1)]:
        part = samples[y::down, x::right]
        above = None
        for i, row in enumerate(part if part.shape[1] else []):
            bits = "".join(f"{v:0{depth}b}" for v in row.reshape(-1))
            bits += "0" * (-len(bits) % 8)
            own = np.array([int(bits[k:k + 8], 2) for k in range(0, len(bits), 8)])
            up = np.zeros_like(own) if above is None else above
            left, corner = (np.concatenate([np.zeros(step, int), line])[:len(own)] for line in (own, up))
            near = left + up - corner
            away = np.stack([abs(near - left), abs(near - up), abs(near - corner)])
            paeth = np.choose(away.argmin(0), [left, up, corner])
            which = list(filters)[i % len(list(filters))]
            guess = [0 * own, left, up, (left + up) // 2, paeth][which]
            raw += bytes([which]) + ((own - guess) % 256).astype(np.uint8).tobytes()
            above = own

    def chunk(name, data):
        return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))

    palette = rng.integers(0, 256, (1 << depth, 3), np.uint8) if kind == "P" else None
    more = chunk(b"PLTE", palette.tobytes()) if kind == "P" else b""
    more += chunk(b"tRNS", bytes(range(min(256, 1 << depth))) if kind == "P" else
                  b"".join(struct.pack(">H", v) for v in samples[0, 0])) if clear else b""
    head = struct.pack(">IIBBBBB", width, height, depth, {"L": 0, "RGB": 2, "P": 3, "LA": 4, "RGBA": 6}[kind],
                       0, 0, int(interlaced))
    packed = zlib.compress(raw)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + more + chunk(b"IDAT", packed[:50]) + \
        chunk(b"IDAT", packed[50:]) + chunk(b"IEND", b""), samples, palette


@pytest.mark.parametrize("kind", KINDS)
def test_png_of_every_kind_is_read(kind):
    rng = np.random.default_rng(3)
    for depth in KINDS[kind]:
        for interlaced in (False, True):
            for clear in (False, True)[:1 + (len(kind) in (1, 3))]:
                for width, height in ((13, 11), (1, 1), (3, 2)):
                    data, samples, palette = png_of(rng, kind, depth, interlaced, width, height, clear)
                    want = np.full((height, width, 4), 255, np.uint8)
                    shown = palette[samples[..., 0]] if kind == "P" else \
                        np.floor(samples * 255 / ((1 << depth) - 1) + 0.5).astype(np.uint8)
                    want[..., :3] = shown[..., :3] if shown.shape[2] > 2 else shown[..., :1]
                    if "A" in kind:
                        want[..., 3] = shown[..., -1]
                    if clear:
                        want[..., 3] = samples[..., 0] if kind == "P" else \
                            np.where((samples == samples[0, 0]).all(-1), 0, 255)
                    assert (shade.Picture.open(io.BytesIO(data)).rgba == want).all(), (depth, interlaced)


def test_png_that_is_damaged_is_refused():
    data = png_of(np.random.default_rng(4), "RGB", 8, False)[0]
    refused = 0
    for i in range(8, len(data)):
        changed = bytearray(data)
        changed[i] ^= 4
        with pytest.raises(shade.Error):
            shade.Picture.open(io.BytesIO(bytes(changed)))
        with pytest.raises(shade.Error):
            shade.Picture.open(io.BytesIO(data[:i]))
        refused += 1
    assert refused == len(data) - 8
    with pytest.raises(shade.Error, match="checksum is wrong"):
        shade.Picture.open(io.BytesIO(data[:60] + bytes([data[60] ^ 1]) + data[61:]))


def test_what_cannot_be_seen_is_no_difference(tmp_path):
    """As shade-compare has it; == tells bytes apart."""
    one, two = np.zeros((2, 2, 4), np.uint8), np.full((2, 2, 4), 90, np.uint8)
    two[..., 3] = 0
    assert shade.Picture(one) != shade.Picture(two)
    assert shade.Picture(one).difference(shade.Picture(two)).max() == 0
    shade.Picture(two).save(tmp_path / "golden.png")
    shade.assert_same(shade.Picture(one), tmp_path / "golden.png")
    half, other = np.full((1, 1, 4), 100, np.uint8), np.full((1, 1, 4), 100, np.uint8)
    other[..., 0] = 103    # by 3 * 100 / 255, which is more than 1
    assert shade.Picture(half).difference(shade.Picture(other)).tolist() == [[2]]
