"""The programs of pyrender's README with one changed import, and what its names promise."""
from types import SimpleNamespace

import numpy as np
import pytest
from shapes import box, torus

import shade_h as shade
import shade_h.compat.pyrender as pyrender


def trimesh(**visual):
    """What from_trimesh reads of a trimesh.Trimesh."""
    vertices, faces, normals = torus(24)
    return SimpleNamespace(vertices=vertices, faces=faces[:, [0, 1, 2, 0, 2, 3]].reshape(-1, 3),
                           vertex_normals=normals, visual=SimpleNamespace(**visual))


def pose(z=9.0):
    out = np.eye(4)
    out[2, 3] = z
    return out


def scene(mesh=None):
    made = pyrender.Scene(ambient_light=[0.1, 0.1, 0.1])
    made.add(pyrender.Mesh.from_trimesh(mesh or trimesh()))
    made.add(pyrender.PerspectiveCamera(yfov=np.pi / 3.0, aspectRatio=1.0), pose=pose())
    made.add(pyrender.DirectionalLight(color=np.ones(3), intensity=3.0), pose=pose())
    return made


def test_the_offscreen_example():
    made = pyrender.Scene()
    made.add(pyrender.Mesh.from_trimesh(trimesh()))
    camera = pyrender.PerspectiveCamera(yfov=np.pi / 3.0, aspectRatio=1.0)
    s = np.sqrt(2) / 2
    camera_pose = np.array([[0.0, -s, s, 6], [1.0, 0.0, 0.0, 0.0], [0.0, s, s, 7], [0, 0, 0, 1]])
    made.add(camera, pose=camera_pose)
    light = pyrender.SpotLight(color=np.ones(3), intensity=3.0, innerConeAngle=np.pi / 16.0,
                               outerConeAngle=np.pi / 6.0)
    made.add(light, pose=camera_pose)
    r = pyrender.OffscreenRenderer(400, 300)
    color, depth = r.render(made)
    assert color.shape == (300, 400, 3) and color.dtype == np.uint8
    assert depth.shape == (300, 400) and depth.dtype == np.float32
    covered = depth > 0
    assert 0.05 < covered.mean() < 0.6 and (color[~covered] == 255).all()
    assert len(np.unique(color[covered])) > 50
    assert 4 < depth[covered].min() and depth.max() < 13


def test_depth_is_that_of_the_other_cameras():
    made, r = scene(), pyrender.OffscreenRenderer(80, 80)
    depth = r.render(made, pyrender.RenderFlags.DEPTH_ONLY)
    other = shade.Renderer(80, 80)
    vertices, faces, normals = torus(24)
    other.add(other.mesh(vertices, faces, normals=normals))
    camera = shade.Camera.look_at((0, 0, 9), up=(0, 1, 0), fov=60, near=0.05, far=1e9)
    wanted = other.render(camera, empty_depth=0).depth
    assert np.array_equal(depth > 0, wanted > 0) and np.abs(depth - wanted).max() < 1e-4
    f = 40 / np.tan(np.pi / 6)
    node = next(iter(made.camera_nodes))
    node.camera = pyrender.IntrinsicsCamera(f, f, 40, 40)
    assert np.abs(r.render(made)[1] - depth).max() < 1e-3
    node.camera = pyrender.OrthographicCamera(4, 4)
    flat = r.render(made)[1]
    assert abs(flat.max() - 9) < 0.81 and abs(flat[flat > 0].min() - (9 - 0.8)) < 0.01


def test_segmentation_nodes_and_poses():
    made = pyrender.Scene(bg_color=[0.0, 0.0, 0.0, 0.0])
    vertices, faces = box(1, 1, 1)
    cube = pyrender.Mesh([pyrender.Primitive(vertices, indices=faces[:, [0, 1, 2]])])
    whole = pyrender.Mesh.from_trimesh(SimpleNamespace(
        vertices=vertices, faces=faces[:, [0, 1, 2, 0, 2, 3]].reshape(-1, 3)), smooth=False)
    left, parent = made.add(whole, name="left", pose=_at(-2, 0, 0)), made.add(cube, name="hidden")
    right = made.add(whole, parent_name="hidden", pose=_at(1, 0, 0))
    parent.mesh.is_visible = False
    made.add(pyrender.PerspectiveCamera(1.0), pose=pose(6))
    r = pyrender.OffscreenRenderer(90, 60)
    seg, depth = r.render(made, pyrender.RenderFlags.SEG, {left: (255, 0, 0), right: (0, 0, 255)})
    assert set(map(tuple, seg.reshape(-1, 3))) == {(0, 0, 0), (255, 0, 0), (0, 0, 255)}
    assert np.array_equal(depth > 0, seg.any(-1)) and seg[:, :45, 2].max() == 0
    made.set_pose(parent, _at(0, 0, -50))
    assert made.get_pose(right)[2, 3] == -50
    made.remove_node(left)
    again, _ = r.render(made, pyrender.RenderFlags.SEG, {right: (0, 0, 255)})
    assert 0 < again.any(-1).sum() < 20
    assert made.get_nodes(name="hidden") == {parent}


def _at(x, y, z):
    out = np.eye(4)
    out[:3, 3] = x, y, z
    return out


def test_scale_materials_and_flags():
    small, r = scene(), pyrender.OffscreenRenderer(60, 60)
    before = r.render(small)[1]
    mesh = small.mesh_nodes[0]
    small.set_pose(mesh, np.diag([0.5, 0.5, 0.5, 1.0]))
    assert 0.15 < (r.render(small)[1] > 0).sum() / (before > 0).sum() < 0.35
    color, _ = r.render(small, pyrender.RenderFlags.FLAT | pyrender.RenderFlags.RGBA)
    assert color.shape == (60, 60, 4) and (color == 255).all()
    red = pyrender.MetallicRoughnessMaterial(baseColorFactor=[1.0, 0.0, 0.0, 1.0])
    for primitive in mesh.mesh.primitives:
        primitive.material = red
    color, depth = r.render(small)
    assert color[depth > 0][:, 0].mean() > 4 * color[depth > 0][:, 1].mean()
    painted = trimesh(kind="vertex", vertex_colors=np.tile(np.uint8([0, 255, 0, 255]), (1152, 1)))
    color, depth = r.render(scene(painted))
    assert color[depth > 0][:, 1].mean() > 4 * color[depth > 0][:, 0].mean()


def test_shadows_and_refusals():
    made = scene()
    made.add(pyrender.Mesh.from_trimesh(SimpleNamespace(
        vertices=[[-9, -9, -2], [9, -9, -2], [9, 9, -2], [-9, 9, -2]], faces=[[0, 1, 2], [0, 2, 3]])))
    lamp = made.light_nodes[0]
    turned = np.eye(4)
    turned[:3, 2], turned[:3, 0] = (0.6, 0, 0.8), (0.8, 0, -0.6)
    made.set_pose(lamp, turned)
    r = pyrender.OffscreenRenderer(80, 80)
    bright, dark = r.render(made)[0], r.render(made, pyrender.RenderFlags.SHADOWS_DIRECTIONAL)[0]
    assert (dark <= bright).all() and 200 < (dark < bright).all(-1).sum() < 4000
    with pytest.raises(ValueError, match="no camera"):
        r.render(pyrender.Scene())
    with pytest.raises(TypeError, match="obj must be a Mesh, a Camera or a Light"):
        made.add(3)
    with pytest.raises(shade.Error, match="yfov must be from"):
        pyrender.PerspectiveCamera(yfov=60)
    with pytest.raises(shade.Error, match="indices"):
        pyrender.Primitive([[0, 0, 0]], indices=[[0, 1, 2]])
