"""What was taken in silence and meant something else: colours, poses, lamps, cameras, sections, files."""
import json
import subprocess
import sys
import warnings

import numpy as np
import pytest
from shapes import box

import shade_h as shade
import shade_h.compat.pyrender as pyrender
from shade_h.mujoco import Renderer as MujocoRenderer

CUBE = box(100, 100, 100)


def face_on(made, size=40, **options):
    """A renderer's picture of what lies about the origin, from above, all lit alike."""
    made.light([], (1, 1, 1))
    return made.render(shade.Camera.look_at((0, 0, 3), up=(0, 1, 0), fov=30), **options).color


@pytest.mark.parametrize("kind", [int, np.int32, float])
def test_a_colour_of_whole_numbers_is_the_colour_it_looks_like(kind):
    made = shade.Renderer(8, 8)
    made.add("plane", (1, 1), color=np.array([1, 0, 0], kind))
    assert face_on(made)[4, 4].tolist() == [255, 0, 0]
    assert (shade.render(*CUBE, size=32, color=np.array([1, 0, 0], kind)) ==
            shade.render(*CUBE, size=32, color=(1, 0, 0)))


def test_alpha_of_a_colour_counts_or_is_told():
    made = shade.Renderer(8, 8)
    made.background((0, 0, 0))
    made.add("plane", (1, 1), color=(1, 1, 1, 0.5))
    half = face_on(made)[4, 4, 0]
    other = shade.Renderer(8, 8)
    other.background((0, 0, 0))
    other.add("plane", (1, 1), color=(1, 1, 1), alpha=0.5)
    assert half == face_on(other)[4, 4, 0] and 100 < half < 200
    with pytest.warns(UserWarning, match="color: its alpha is left out"):
        shade.Mesh(*CUBE, color=(1, 0, 0, 0.5))
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        shade.Mesh(*CUBE, color=(1, 0, 0, 1.0))
    with pytest.raises(shade.Error, match="alpha from 0 to 1"):
        made.add("plane", color=(1, 0, 0, 1.5))
    with pytest.raises(shade.Error, match="color must be from 0 to 1"):
        shade.Renderer(8, 8, srgb=False).add("plane", color=(3.0, 0, 0))


def test_directions_of_no_length_are_refused():
    for make in (lambda: shade.Light.directional((0, 0, 0)), lambda: shade.Light.spot((0, 0, 1), (0, 0, 0), 0.5),
                 lambda: shade.Light((0, 0, 0, 0)).native()):
        with pytest.raises(shade.Error, match="must not be zero"):
            make()


def test_a_pose_has_its_translation_in_the_last_column():
    made = shade.Renderer(8, 8)
    made.add("sphere", 1)
    row = np.eye(4)
    row[3, :3] = 1, 2, 3
    mirror = np.diag([1.0, 1, -1, 1])
    for wrong in (row, mirror, 2 * np.eye(4)):
        with pytest.raises(shade.Error, match=r"pose of object 0 must be a rotation"):
            made.pose(0, wrong)
        with pytest.raises(shade.Error, match=r"poses\[0\] must be a rotation"):
            made.poses(wrong[None])
        with pytest.raises(shade.Error, match="pose must be a rotation"):
            made.add("sphere", 1, pose=wrong)


def test_a_camera_has_the_aspect_of_the_picture():
    ball = shade.Scene()
    ball.add(np.zeros((1, 3)))
    made = shade.Renderer(60, 120)
    made.add("sphere", 0.5)
    free, said = shade.Camera.look_at((3, -3, 2)), shade.Camera.look_at((3, -3, 2), aspect=2.0)
    assert (made.render(free).color == made.render(said).color).all()
    y, x = np.nonzero(made.render(free).ids[..., 0] == 0)
    assert abs(np.ptp(x) - np.ptp(y)) <= 2
    assert ball.render(free, (120, 60)) == ball.render(said, (120, 60))
    assert (ball.render_batch(free, size=(64, 32))[0] == ball.render_batch(said, size=(64, 32))[0]).all()


def test_a_section_beside_the_part_is_refused_and_of_an_open_mesh_told():
    vertices, faces = CUBE
    for where in (101, -1):
        with pytest.raises(shade.Error, match="section does not cut the parts"):
            shade.render(vertices, faces, size=32, section=("x", where))
    tube = faces[np.ptp(vertices[faces][:, :, 2], axis=1) > 0]    # which all lines across it cross twice
    for sheet in (tube, faces[:-2]):
        with pytest.warns(UserWarning, match="section: the mesh is open where it is cut: the cut is not filled"):
            hollow = shade.render(vertices, sheet, size=64, section="x", view="right", color="red")
        assert (hollow.rgba[20:44, 20:44, 1] < 90).all()    # red: the cut is grey and white
    turned = np.array(faces)
    first = np.ptp(vertices[faces][:, :, 0], axis=1).argmax()    # which the plane crosses
    turned[first] = turned[first, ::-1]
    with pytest.warns(UserWarning, match="open, or turned both ways, where it is cut: the cut is filled between"):
        shade.render(vertices, turned, size=32, section="x")
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        picture = shade.render(vertices, faces, size=64, section="z")
    assert "100 x 100 x 50," in picture.report()


@pytest.mark.parametrize("low", [0.0, -1.0])
def test_infinite_scalars_have_the_colours_of_the_ends(low):
    """Also where all other numbers are equal, so that the ends are."""
    vertices, faces = CUBE
    values = np.zeros(len(faces))
    values[0], values[1:3] = low, (np.inf, -np.inf)
    tints = shade.Mesh(vertices, faces, scalars=values, cmap="grey", normals="flat").colors.reshape(-1, 6, 3)
    assert (tints[1] == 1).all() and (tints[2] == 0).all()


def test_letters_that_the_font_lacks_are_told():
    scene = shade.Scene()
    with pytest.warns(UserWarning, match="text: the font has no é: a question mark"):
        scene.add_label((0, 0, 0), "caf\u00e9")
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        scene.add_label((0, 0, 0), "\u00d8 12 \u00b5m \u00b1 0.5\u00b0")


def test_white_parts_on_white_are_blank():
    picture = shade.Picture(np.full((9, 9, 4), 255, np.uint8), ids=np.where(np.eye(9) > 0, 0, -1).astype(np.int32))
    assert picture.blank and "blank: all parts have the colour of what is behind" in picture.report()
    assert not shade.render(*CUBE, size=32).blank


def test_white_parts_stand_out_from_white():
    """Three lamps together are brighter than white: what they light is bent toward it, and not clipped."""
    for side in ("iso", "top", "front", (120, 40)):
        picture = shade.render(*CUBE, color="white", view=side, size=64, samples=1)
        assert (255 - picture.rgba[picture.ids == 0][:, :3].min(1)).min() >= 8


def test_a_transposed_pose_is_refused():
    row = np.eye(4)
    row[3, :3] = 1, 2, 3
    scene = shade.Scene()
    scene.add(shade.Mesh(*CUBE))
    eye = shade.Camera.look_at((3, 3, 3))
    for wrong in (row, np.diag([1, 1, 1, 2.0])):
        for call in (lambda wrong=wrong: scene.add(shade.Mesh(*CUBE), wrong),
                     lambda wrong=wrong: scene.render_batch(eye, wrong[None, None]),
                     lambda wrong=wrong: shade.Camera.opencv(np.eye(3), wrong, (100, 100))):
            with pytest.raises(shade.Error, match=r"(pose|poses|extrinsics) must .*0, 0, 0, 1 in the last row"):
                call()


def test_a_direction_too_short_for_floats_is_refused():
    for short in (1e-40, 1e-19, 0.0):
        with pytest.raises(shade.Error, match="travel must not be zero"):
            shade.Light.directional((0, 0, -short))
        with pytest.raises(shade.Error, match="position must not be zero"):
            shade.Scene([shade.Light((0, short, 0, 0))])
    shade.Scene([shade.Light.directional((0, 0, -1e-17)), shade.Light((0, 0, 0, 1))])


def test_a_title_says_what_the_font_lacks():
    with pytest.warns(UserWarning, match="title: the font has no"):
        shade.Mesh(*CUBE, scalars=np.arange(len(CUBE[0])), title="\u65e5")


# ---- files in a Renderer

def test_a_renderer_draws_the_colours_and_textures_of_a_file(tmp_path):
    (tmp_path / "two.mtl").write_text("newmtl r\nKd 1 0 0\nnewmtl g\nKd 0 1 0\n")
    (tmp_path / "two.obj").write_text("mtllib two.mtl\nv -1 -1 0\nv 0 -1 0\nv 0 1 0\nv -1 1 0\nv 1 -1 0\nv 1 1 0\n"
                                      "usemtl r\nf 1 2 3 4\nusemtl g\nf 2 5 6 3\n")
    made = shade.Renderer(40, 40)
    made.add(made.mesh(shade.load(tmp_path / "two.obj")))
    got = face_on(made)
    assert got[20, 10].tolist() == [255, 0, 0] and got[20, 30].tolist() == [0, 255, 0]
    quad = [[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], [[0, 1, 2, 3]]
    texels = np.array([[[255, 0, 0], [0, 255, 0]], [[0, 0, 255], [255, 255, 0]]], np.uint8).repeat(32, 0).repeat(32, 1)
    mapped = shade.Mesh(*quad, uv=[[0, 0], [1, 0], [1, 1], [0, 1]], texture=texels)
    made = shade.Renderer(40, 40)
    made.add(made.mesh(mapped))
    got = face_on(made)
    assert [got[y, x].tolist() for y, x in ((10, 10), (10, 30), (30, 10), (30, 30))] == \
        [[255, 0, 0], [0, 255, 0], [0, 0, 255], [255, 255, 0]]
    made = shade.Renderer(40, 40)
    made.add(made.mesh(shade.Mesh(*quad, color="blue")))
    assert face_on(made)[20, 20].tolist() == [0x1F, 0x77, 0xB4]


def test_the_highlight_of_an_mtl_is_drawn(tmp_path):
    """Light, eye and normal are one line: k_e + k_d + k_s, of linear light, whatever the exponent."""
    (tmp_path / "one.mtl").write_text("newmtl m\nKd 0.2 0.1 0\nKs 0.3 0.3 0.3\nNs 20\nKe 0 0 0.2\n")
    (tmp_path / "one.obj").write_text("mtllib one.mtl\nv -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nusemtl m\nf 1 2 3 4\n")
    linear = [c / 12.92 if c < 0.04 else ((c + 0.055) / 1.055) ** 2.4 for c in (0, 0.1, 0.2, 0.3)]
    sums = linear[2] + linear[3], linear[1] + linear[3], linear[2] + linear[3]
    wanted = [round(255 * (1.055 * c ** (1 / 2.4) - 0.055)) for c in sums]
    lamp = shade.Light.directional((0, 0, -1))
    above = shade.Camera.look_at((0, 0, 50), up=(0, 1, 0), fov=1)
    made, scene = shade.Renderer(33, 33), shade.Scene([lamp])
    made.add(made.mesh(shade.load(tmp_path / "one.obj")))
    made.light([lamp])
    scene.add(tmp_path / "one.obj")
    for pixel in (made.render(above).color[16, 16], scene.render(above, 33, samples=1).rgba[16, 16, :3]):
        assert np.abs(pixel - np.array(wanted)).max() <= 1


# ---- the packages whose names are here

def test_primitives_of_scenes_that_are_gone_leave_the_renderer():
    renderer = pyrender.OffscreenRenderer(8, 8)
    for _ in range(60):
        scene = pyrender.Scene()
        scene.add(pyrender.PerspectiveCamera(1.0))
        for _ in range(3):
            scene.add(pyrender.Mesh([pyrender.Primitive(np.random.rand(30, 3))]))
        renderer.render(scene)
        assert len(renderer._shapes) <= 17 and len(renderer._base._meshes) <= 17
    renderer.delete()
    assert renderer.render(scene)[0].shape == (8, 8, 3)


def test_a_cycle_of_nodes_is_refused():
    scene, one, two = pyrender.Scene(), pyrender.Node("one"), pyrender.Node("two")
    scene.add_node(one)
    scene.add_node(two, parent_node=one)
    two.children.append(one)
    with pytest.raises(ValueError, match="in the scene twice"):
        scene.nodes


class Model:
    """What a Renderer reads of an MjModel without textures."""

    class vis:
        class global_:
            offwidth, offheight = 64, 48


def test_mujocos_refusals_are_those_of_its_class():
    for size in ((49, 64), (48, 65)):
        with pytest.raises(ValueError, match="> framebuffer"):
            MujocoRenderer(Model, *size)
    renderer = MujocoRenderer(Model, 48, 64)
    assert not renderer.render().any()    # black before update_scene
    with pytest.raises(TypeError, match="out must be uint8"):
        renderer.render(out=np.zeros((48, 64, 3), np.float32))
    with pytest.raises(ValueError):
        renderer.render(out=np.zeros((48, 63, 3), np.uint8))
    renderer.close()
    with pytest.raises(RuntimeError, match="render cannot be called after close"):
        renderer.render()
    with pytest.raises(RuntimeError, match="update_scene cannot be called after close"):
        renderer.update_scene(None)


# ---- the server

@pytest.mark.parametrize("line, code", [
    ('{"id": 1, "method": "tools/call", "params": [1]}', -32602),
    ('{"id": 1, "method": "tools/call", "params": 7}', -32602),
    ('{"id": 1, "method": "tools/call", "params": {"name": "render", "arguments": [1]}}', -32602),
    ('{"id": 1, "method": "tools/call", "params": {"name": ["render"]}}', -32601),
    ('{"id": 1, "method": ["ping"]}', -32600), ('{"id": [1], "method": "nothing"}', -32601),
    ('[' * 100000, -32700), ('7', -32700)])
def test_the_server_outlives_params_of_any_kind(line, code):
    ping = '{"id": 2, "method": "ping"}'
    got = subprocess.run([sys.executable, "-m", "shade_h.mcp_server"], input=f"{line}\n{ping}\n", capture_output=True, text=True)
    assert got.returncode == 0, got.stderr
    first, second = (json.loads(row) for row in got.stdout.splitlines())
    assert first["error"]["code"] == code and second == {"jsonrpc": "2.0", "id": 2, "result": {}}


def test_what_would_be_nonsense_is_refused_by_name():
    from shade_h.compat import pyrender
    scene = pyrender.Scene()
    scene.add(pyrender.PerspectiveCamera(yfov=1.0))
    drawer = pyrender.OffscreenRenderer(8, 8)
    mirrored = pyrender.Scene()
    mirrored.add(pyrender.PerspectiveCamera(yfov=1.0), pose=np.diag([-1.0, 1, 1, 1]))
    vertices, faces = CUBE
    camera = shade.Camera.opencv(np.array([[50, 0, 20], [0, 50, 20], [0, 0, 1.0]]), np.eye(4), (40, 40))
    for words, call in (
            ("flags must not have ALL_WIREFRAME", lambda: drawer.render(scene, pyrender.RenderFlags.ALL_WIREFRAME)),
            ("flags must not have FACE_NORMALS", lambda: drawer.render(scene, pyrender.RenderFlags.FACE_NORMALS)),
            ("pose of the camera must not be mirrored", lambda: drawer.render(mirrored)),
            ("scalars must have a finite number", lambda: shade.Mesh(vertices, faces, scalars=[np.inf] * len(vertices))),
            ("camera was made for pictures of 40 x 40 pixels, not of 20 x 30",
             lambda: shade.Renderer(30, 20).render(camera)),
            ("camera was made for pictures of 40 x 40", lambda: shade.render(vertices, faces, view=camera, size=(64, 48))),
            ("view must be a rotation and a translation, without scale or mirror",
             lambda: shade.Camera(np.diag([-1.0, 1, 1, 1]), np.eye(4)))):
        with pytest.raises(shade.Error, match=words):
            call()


def test_whole_colours_of_0_and_1_are_colours_by_vertex_too():
    vertices, faces = CUBE
    ones = np.tile([1, 0, 0], (len(vertices), 1))
    assert shade.render(vertices, faces, color=ones, size=32) == \
        shade.render(vertices, faces, color=ones.astype(float), size=32)
