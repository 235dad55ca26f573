"""The programs of pyrender's README with one changed import, and what its names promise."""
from types import SimpleNamespace

import numpy as np
import pytest
from PIL import Image
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
    light = pyrender.SpotLight(color=np.ones(3), intensity=300.0, innerConeAngle=np.pi / 16.0,
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


def test_what_pyrenders_readme_shows_runs_with_another_import(tmp_path):
    """Meshes with a texture, with colours of vertices and of faces, and points; nodes with translations;
    a viewer, and a picture from a camera."""
    rng = np.random.default_rng(1)
    tube, (corners, quads) = trimesh(), box(0.5, 0.5, 0.5)
    cube = corners, quads[:, [0, 1, 2, 0, 2, 3]].reshape(-1, 3)
    image = Image.new("RGB", (8, 8), (255, 40, 20))
    textured = SimpleNamespace(**{**vars(tube), "visual": SimpleNamespace(
        kind="texture", uv=rng.random((len(tube.vertices), 2)), defined=True,
        material=SimpleNamespace(image=image))})
    def coloured(**colors):    # noqa: E306
        kind = next(iter(colors)).split("_")[0]
        return SimpleNamespace(vertices=cube[0], faces=cube[1], visual=SimpleNamespace(
            kind=kind, defined=True, **colors))
    by_vertex = coloured(vertex_colors=rng.integers(0, 255, (len(cube[0]), 4), dtype=np.uint8))
    by_face = coloured(face_colors=rng.integers(0, 255, (len(cube[1]), 4), dtype=np.uint8))
    points = pyrender.Mesh.from_points(rng.random((200, 3)), colors=rng.random((200, 3)))
    made = pyrender.Scene(ambient_light=np.array([0.02, 0.02, 0.02]))
    ring = made.add(pyrender.Mesh.from_trimesh(textured))
    low = pyrender.Node(mesh=pyrender.Mesh.from_trimesh(by_vertex, smooth=False),
                        translation=np.array([-4, 0, 0]))
    high = pyrender.Node(mesh=pyrender.Mesh.from_trimesh(by_face, smooth=False),
                         translation=np.array([4, 0, 0]), rotation=[0, 0, 1, 0], scale=[2, 2, 2])
    for node in (low, high):
        made.add_node(node)
    cloud = made.add(points, pose=_at(0, 3.2, 0))
    made.add(pyrender.DirectionalLight(color=np.ones(3), intensity=2.0), pose=pose())
    made.add(pyrender.SpotLight(color=np.ones(3), intensity=100.0, innerConeAngle=np.pi / 16,
                                outerConeAngle=np.pi / 6), pose=pose())
    with pytest.warns(UserWarning, match="no window"):
        view = pyrender.Viewer(made, shadows=True, viewport_size=(80, 60))
    assert view.color.shape == (60, 80, 3) and (view.depth > 0).sum() > 300
    assert view._repr_png_().startswith(b"\x89PNG") and not made.camera_nodes
    made.add(pyrender.PerspectiveCamera(yfov=np.pi / 3.0), pose=pose())
    r = pyrender.OffscreenRenderer(viewport_width=160, viewport_height=120, point_size=3.0)
    color, depth = r.render(made)
    colors = {ring: (255, 0, 0), low: (0, 255, 0), high: (0, 0, 255), cloud: (255, 255, 0)}
    seg, _ = r.render(made, pyrender.RenderFlags.SEG, colors)
    x = {n: np.nonzero((seg == c).all(-1))[1] for n, c in colors.items()}
    assert all(len(at) > 20 for at in x.values()), {n.name: len(at) for n, at in x.items()}
    assert x[low].max() < x[ring].min() and x[high].min() > x[ring].max()
    assert 2.2 < len(x[high]) / len(x[low]) < 6 and x[cloud].size > 200
    red = color[(seg == (255, 0, 0)).all(-1)].astype(int)
    assert (red[:, 0] >= red[:, 1]).all() and red[:, 0].max() > 100
    r.delete()


def test_nodes_keep_rotation_scale_and_translation():
    turn = pyrender.Node(rotation=[0.5, 0.5, 0.5, 0.5], scale=[1, 2, 3], translation=[4, 5, 6])
    assert np.allclose(turn.matrix, [[0, 0, 3, 4], [1, 0, 0, 5], [0, 2, 0, 6], [0, 0, 0, 1]])
    again = pyrender.Node(matrix=turn.matrix)
    assert np.allclose(again.rotation, turn.rotation) and np.allclose(again.scale, (1, 2, 3))
    again.translation = (7, 8, 9)
    assert np.allclose(again.matrix[:3, :3], turn.matrix[:3, :3])
    assert np.allclose(again.matrix[:3, 3], (7, 8, 9))
    rng = np.random.default_rng(4)
    for _ in range(50):
        q = rng.normal(size=4)
        q /= np.linalg.norm(q)
        got = pyrender.Node(matrix=pyrender.Node(rotation=q).matrix).rotation
        assert min(np.abs(got - q).max(), np.abs(got + q).max()) < 1e-7
    for words, bad in (("rotation must be a unit", {"rotation": [1, 1, 0, 0]}),
                       ("translation must have the shape", {"translation": [1, 2]}),
                       ("scale must hold finite", {"scale": [1, np.nan, 1]})):
        with pytest.raises(shade.Error, match=words):
            pyrender.Node(**bad)
    with pytest.raises(TypeError, match="mesh must be a Mesh"):
        pyrender.Node(mesh=3)


def test_light_falls_with_the_square_of_the_distance_and_to_the_rim_of_a_spot():
    """Beside the formula of pyrender's shader, for what scatters evenly .96 of the .96 that goes in, and
    mirrors .01."""
    wall = SimpleNamespace(vertices=[[-9, -9, 0], [9, -9, 0], [9, 9, 0], [-9, 9, 0]],
                           faces=[[0, 1, 2], [0, 2, 3]])
    chalk = pyrender.MetallicRoughnessMaterial(metallicFactor=0, roughnessFactor=1)
    eye = pyrender.PerspectiveCamera(np.pi / 3)
    inner, outer = 0.2, 0.5
    for light in (pyrender.PointLight(intensity=20.0),
                  pyrender.SpotLight(intensity=20.0, innerConeAngle=inner, outerConeAngle=outer)):
        made = pyrender.Scene(bg_color=[0, 0, 0])
        made.add(pyrender.Mesh.from_trimesh(wall, material=chalk))
        made.add(eye, pose=pose(4))
        made.add(light, pose=pose(4))
        color, _ = pyrender.OffscreenRenderer(101, 101).render(made)
        shown = color[50, :, 1] / 255
        got = np.where(shown <= 0.04045, shown / 12.92, ((shown + 0.055) / 1.055) ** 2.4)
        x = (np.arange(101) - 50) / 50.5 * 4 * np.tan(np.pi / 6)
        cosine = 4 / np.hypot(x, 4)
        wanted = 0.9316 * 20 / np.pi * cosine / (x * x + 16)
        if isinstance(light, pyrender.SpotLight):
            low = np.cos(outer)
            wanted = wanted * np.clip((cosine - low) / (np.cos(inner) - low), 0, 1) ** 2
        # a power of the cosine stands in for the fall within a spot's cone
        most = 0.25 if isinstance(light, pyrender.SpotLight) else 0.05
        assert np.abs(got - wanted).max() < most * 20 / np.pi / 16, np.abs(got - wanted).max()
        assert np.abs(got - wanted).mean() < 0.1 * wanted.max()


def test_scenes_tell_what_they_hold():
    made = pyrender.Scene(bg_color=[255, 0, 0])
    assert np.array_equal(made.bg_color, (1, 0, 0, 1)) and made.scale == 0
    node = made.add(pyrender.Mesh.from_points([[0, 0, 0], [1, 2, 3]]), pose=_at(1, 0, 0))
    assert np.array_equal(made.bounds, [[1, 0, 0], [2, 2, 3]])
    assert np.array_equal(made.centroid, (1.5, 1, 1.5)) and np.array_equal(made.extents, (1, 2, 3))
    assert made.meshes == {node.mesh} and made.has_node(node) and not made.lights | made.cameras
    with pytest.raises(ValueError, match="already"):
        made.add_node(node)
    with pytest.raises(ValueError, match="have a camera"):
        made.main_camera_node = node
    with pytest.raises(shade.Error, match="mode must be GLTF.POINTS or GLTF.TRIANGLES"):
        pyrender.Primitive([[0, 0, 0]], mode=1)
    child = pyrender.Node(name="child")
    assert pyrender.Scene(nodes=[pyrender.Node(children=[child]), child]).nodes.count(child) == 1
    whole = SimpleNamespace(geometry={"ring": trimesh()}, graph=SimpleNamespace(
        nodes_geometry=["a", "b"]))
    graph = {"a": (np.eye(4), "ring"), "b": (_at(9, 0, 0), "ring")}
    whole.graph = type("Graph", (), {"nodes_geometry": ["a", "b"],
                                     "__getitem__": lambda self, name: graph[name]})()
    both = pyrender.Scene.from_trimesh_scene(whole)
    assert len(both.mesh_nodes) == 2 and len(both.meshes) == 1 and both.extents[0] > 9
    both.clear()
    assert not both.nodes
    whole.geometry["ring"] = trimesh(kind="face", face_colors=np.tile(np.uint8([0, 255, 0, 255]), (2304, 1)))
    painted = pyrender.Scene.from_trimesh_scene(whole).meshes.pop().primitives[0]
    assert painted.color_0.shape == (3 * 2304, 4) and not painted.is_transparent


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
    color, depth = r.render(small, pyrender.RenderFlags.FLAT | pyrender.RenderFlags.RGBA)
    assert color.shape == (60, 60, 4) and (color[depth == 0] == 255).all()
    assert (color[depth > 0] == (76, 76, 76, 255)).all() or (color[depth > 0] == (77, 77, 77, 255)).all()
    red = pyrender.MetallicRoughnessMaterial(baseColorFactor=[1.0, 0.0, 0.0, 1.0])
    for primitive in mesh.mesh.primitives:
        primitive.material = red
    color, depth = r.render(small)
    assert color[depth > 0][:, 0].mean() > 4 * color[depth > 0][:, 1].mean()
    painted = trimesh(kind="vertex", vertex_colors=np.tile(np.uint8([0, 255, 0, 255]), (1152, 1)))
    color, depth = r.render(scene(painted))
    assert color[depth > 0][:, 1].mean() > 3 * color[depth > 0][:, 0].mean()


def test_flat_colours_are_those_that_were_given():
    """Colours of vertices, the factor and textures, as labels of things have them."""
    square = [[-1, -1, -3], [1, -1, -3], [1, 1, -3], [-1, 1, -3]]
    texture = np.full((2, 2, 3), (10, 200, 90), np.uint8)
    material = pyrender.MetallicRoughnessMaterial(baseColorFactor=[0.2, 0.4, 0.8, 1.0])
    mapped = pyrender.MetallicRoughnessMaterial(baseColorTexture=texture)
    r = pyrender.OffscreenRenderer(60, 60)
    for own, wanted in (({"color_0": [[40 / 255, 200 / 255, 3 / 255, 1]] * 4,
                          "material": pyrender.MetallicRoughnessMaterial(baseColorFactor=[1.0] * 4)},
                         (40, 200, 3)),
                        ({"material": material}, (51, 102, 204)),
                        ({"material": mapped, "texcoord_0": [[0, 0], [1, 0], [1, 1], [0, 1]]}, (10, 200, 90))):
        made = pyrender.Scene(bg_color=[1.0, 0.2, 0.0])
        made.add(pyrender.Mesh([pyrender.Primitive(square, indices=[[0, 1, 2], [0, 2, 3]], **own)]))
        made.add(pyrender.PerspectiveCamera(yfov=1.5))
        lit = r.render(made)[0][0, 0]
        color, depth = r.render(made, pyrender.RenderFlags.FLAT)
        assert (color[depth > 0] == wanted).all() and (color[0, 0] == lit).all(), (own, color[30, 30])


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


def sphere(material, intensity, ambient):
    """A unit ball of a material, lit from 44 degrees: colours of its pixels, normals, and ways to the eye and
    to the lamp."""
    n, w = 48, 97
    theta, phi = np.meshgrid(np.linspace(0, np.pi, n + 1), np.linspace(0, 2 * np.pi, w), indexing="ij")
    ball = np.stack([np.sin(theta) * np.cos(phi), np.sin(theta) * np.sin(phi), np.cos(theta)], -1).reshape(-1, 3)
    k = (np.arange(n)[:, None] * w + np.arange(w - 1)).ravel()
    faces = np.concatenate([np.stack([k, k + w, k + w + 1], 1), np.stack([k, k + w + 1, k + 1], 1)])
    made = pyrender.Scene(bg_color=[0, 0, 0], ambient_light=ambient)
    made.add(pyrender.Mesh([pyrender.Primitive(ball, ball, indices=faces, **material)]))
    eye, lamp = np.eye(4), np.eye(4)
    eye[2, 3] = 3
    toward = np.array([0.5, 0.6, 0.8]) / np.sqrt(1.25)
    x = np.cross([0, 1, 0], toward) / np.linalg.norm(np.cross([0, 1, 0], toward))
    lamp[:3, :3] = np.stack([x, np.cross(toward, x), toward], 1)
    made.add(pyrender.PerspectiveCamera(np.pi / 4), pose=eye)
    made.add(pyrender.DirectionalLight(intensity=intensity), pose=lamp)
    color, depth = pyrender.OffscreenRenderer(64, 64).render(made)
    across = ((2 * np.arange(64) + 1) / 64 - 1) * np.tan(np.pi / 8)
    way = np.stack(np.broadcast_arrays(across[None], -across[:, None], -1.0), -1)
    N = (way * depth[..., None] + [0, 0, 3])[depth > 0]
    N, V = (v / np.linalg.norm(v, axis=-1, keepdims=True) for v in (N, np.array([0, 0, 3]) - N))
    return color[depth > 0].astype(float), N, V, toward


def pyrenders(light):
    """Bytes of linear light, by the power that pyrender's shader takes."""
    return 255 * np.clip(light, 0, 1) ** (1 / 2.2)


# metal: how far bytes are off on the mean, at roughness .2, .4, .6, .8 and 1
NEAR = {0.0: (1.7, 1.7, 1.5, 1.5, 1.9), 0.5: (2.6, 3.4, 3.4, 3.7, 4.9), 1.0: (6, 6.1, 6, 6.6, 9.2)}


@pytest.mark.parametrize("rough", [0.2, 0.4, 0.6, 0.8, 1.0])
@pytest.mark.parametrize("metal", [0.0, 0.5, 1.0])
def test_metals_are_near_the_law_of_pyrenders_shader(metal, rough):
    """Its microfacets in double: GGX, Schlick's masking of Smith and his Fresnel term, Lambert below."""
    base = np.array([0.9, 0.6, 0.2])
    color, N, V, toward = sphere({"material": pyrender.MetallicRoughnessMaterial(
        baseColorFactor=[*base, 1.0], metallicFactor=metal, roughnessFactor=rough)}, 3.0, [0, 0, 0])
    H = (toward + V) / np.linalg.norm(toward + V, axis=-1, keepdims=True)
    nl, nv, nh, vh = (np.clip((a * b).sum(-1), 1e-3, 1) for a, b in ((N, toward), (N, V), (N, H), (V, H)))
    f0, a2, k = 0.04 * (1 - metal) + metal * base, rough ** 4, (rough + 1) ** 2 / 8
    fresnel = f0 + (1 - f0) * ((1 - vh) ** 5)[:, None]
    masked = nl * nv / ((nl * (1 - k) + k) * (nv * (1 - k) + k))
    lobe = masked * a2 / (np.pi * (nh**2 * (a2 - 1) + 1) ** 2) / (4 * nl * nv + 0.001)
    light = 3 * nl[:, None] * ((1 - fresnel) * base * 0.96 * (1 - metal) / np.pi + fresnel * lobe[:, None])
    apart = np.abs(pyrenders(light) - color).mean()
    assert apart < NEAR[metal][round(5 * rough) - 1] + 2, apart


@pytest.mark.parametrize("metal", [0.0, 0.5, 1.0])
def test_metals_reflect_ambient_light_with_all_of_their_base_colour(metal):
    """As pyrender's shader adds it, with and without a texture and colours of vertices."""
    base, grey = np.array([0.9, 0.6, 0.2]), np.array([0.3, 0.3, 0.3])
    material = {"metallicFactor": metal, "roughnessFactor": 0.5, "baseColorFactor": [*base, 1.0]}
    for given, shown in (({}, base * grey), ({"color_0": [0.5, 1.0, 1.0]}, base * grey * [0.5, 1, 1]),
                         ({"texcoord_0": np.zeros((49 * 97, 2))}, base * grey)):
        image = np.full((2, 2, 3), 255, np.uint8) if "texcoord_0" in given else None
        color = sphere({"material": pyrender.Material(**material, baseColorTexture=image), **given}, 0.0, grey)[0]
        assert np.abs(color - pyrenders(shown)).max() < 8, (given, color[0], pyrenders(shown))


def of_square(normals=None, **material):
    """The colour of a square's middle, linear, lit from the eye by 2 times pi."""
    square = pyrender.Primitive([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], indices=[[0, 1, 2], [0, 2, 3]],
                                texcoord_0=[[0, 0], [1, 0], [1, 1], [0, 1]],
                                normals=np.broadcast_to(normals or [0, 0, 1], (4, 3)),
                                material=pyrender.Material(metallicFactor=0, **material))
    made = pyrender.Scene(bg_color=[0, 0, 0])
    made.add(pyrender.Mesh([square]))
    made.add(pyrender.OrthographicCamera(xmag=1, ymag=1), pose=pose(2))
    made.add(pyrender.DirectionalLight(intensity=2.0), pose=pose(2))
    stored = pyrender.OffscreenRenderer(9, 9).render(made)[0][4, 4] / 255.0
    return np.where(stored <= 0.04045, stored / 12.92, ((stored + 0.055) / 1.055) ** 2.4)


def test_what_glows_shines_by_the_square_of_its_factor_as_in_pyrenders_shader():
    dark = {"baseColorFactor": [0, 0, 0, 1.0]}
    unlit = of_square(**dark)
    assert np.allclose(of_square(**dark, emissiveFactor=[0.5, 0.25, 0]) - unlit, [0.25, 0.0625, 0], atol=0.004)
    picture = np.full((2, 2, 3), (255, 188, 0), np.uint8)    # 188: .503 of white
    for given in (picture, Image.fromarray(picture), pyrender.Texture(source=picture)):
        got = of_square(**dark, emissiveFactor=[0.5, 0.8, 1], emissiveTexture=given) - unlit
        assert np.allclose(got, [0.25, 0.64 * 0.503, 0], atol=0.005)


def test_a_normal_texture_bends_the_light_as_normals_do():
    """A square whose texels all say (.6, 0, .8) is one with that normal; its green is up."""
    for n in ((0.6, 0, 0.8), (0, -0.6, 0.8), (0, 0, 1)):
        texels = np.rint(127.5 + 127.5 * np.broadcast_to(n, (2, 2, 3))).astype(np.uint8)
        assert np.allclose(of_square(normalTexture=texels), of_square(list(n)), atol=0.01)
    assert of_square().max() > of_square([0.6, 0, 0.8]).max() + 0.05
