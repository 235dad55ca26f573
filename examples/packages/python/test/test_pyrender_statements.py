"""Statements of this project, written after pyrender's public tests: each line of STATEMENTS is one, which
runs after those before it; an error before a colon is what the rest of its line must raise."""
from types import SimpleNamespace

import numpy as np
import pytest
from shapes import box

import shade_h.compat.pyrender as pyrender

STATEMENTS = {
    "PerspectiveCamera": """
        TypeError: PerspectiveCamera()
        p = PerspectiveCamera(yfov=np.pi / 3)
        assert p.yfov == np.pi / 3
        assert p.znear == 0.05
        assert p.zfar is None
        assert p.aspectRatio is None
        p.name = "asdf"
        p.name = None
        ValueError: p.yfov = 0.0
        ValueError: p.yfov = -1.0
        ValueError: p.znear = -1.0
        p.znear = 0.0
        p.znear = 0.05
        p.zfar = 100.0
        ValueError: p.zfar = 0.03
        ValueError: p.zfar = 0.05
        p.aspectRatio = 10.0
        ValueError: p.aspectRatio = 0.0
        ValueError: p.aspectRatio = -1.0
        p.aspectRatio = None
        ValueError: p.get_projection_matrix()
        t = np.tan(np.pi / 6)
        m = np.array([[1 / (2 * t), 0, 0, 0], [0, 1 / t, 0, 0], [0, 0, -100.05 / 99.95, -10 / 99.95], [0, 0, -1, 0]])
        assert np.allclose(p.get_projection_matrix(1000, 500), m)
        p.aspectRatio = 640 / 480
        m[0, 0] = 1 / (640 / 480 * t)
        assert np.allclose(p.get_projection_matrix(1000, 500), m)
        assert np.allclose(p.get_projection_matrix(), m)
        p.zfar = None
        m[2, 2:] = -1, -0.1
        assert np.allclose(p.get_projection_matrix(), m)
        p.aspectRatio = None
        m[0, 0] = 1 / (2 * t)
        assert np.allclose(p.get_projection_matrix(1000, 500), m)
    """,
    "OrthographicCamera": """
        TypeError: OrthographicCamera()
        c = OrthographicCamera(xmag=1.0, ymag=2.0)
        assert c.xmag == 1.0
        assert c.ymag == 2.0
        assert c.znear == 0.05
        assert c.zfar == 100.0
        assert c.name is None
        TypeError: c.ymag = None
        ValueError: c.ymag = 0.0
        ValueError: c.ymag = -1.0
        TypeError: c.xmag = None
        ValueError: c.xmag = 0.0
        ValueError: c.xmag = -1.0
        TypeError: c.znear = None
        ValueError: c.znear = -1.0
        ValueError: c.znear = 0.0
        ValueError: OrthographicCamera(1.0, 2.0, znear=0.0)
        assert c.znear == 0.05
        TypeError: c.zfar = None
        ValueError: c.zfar = 0.0
        c.znear = 0.05
        ValueError: c.zfar = 0.01
        m = np.array([[1, 0, 0, 0], [0, 0.5, 0, 0], [0, 0, 2 / -99.95, -100.05 / 99.95], [0, 0, 0, 1]])
        assert np.allclose(c.get_projection_matrix(), m)
    """,
    "lights": """
        d = DirectionalLight()
        assert d.name is None
        assert np.all(d.color == 1.0)
        assert d.intensity == 1.0
        d.name = "direc"
        ValueError: d.color = None
        TypeError: d.intensity = None
        d = DirectionalLight(color=[0.0, 0.0, 0.0])
        assert np.all(d.color == 0.0)
        s = SpotLight()
        assert s.name is None
        assert np.all(s.color == 1.0)
        assert s.intensity == 1.0
        assert s.innerConeAngle == 0.0
        assert s.outerConeAngle == np.pi / 4.0
        assert s.range is None
        ValueError: s.range = -1.0
        ValueError: s.range = 0.0
        ValueError: s.innerConeAngle = -1.0
        ValueError: s.innerConeAngle = np.pi / 3.0
        ValueError: s.outerConeAngle = -1.0
        ValueError: s.outerConeAngle = np.pi
        s.range = 5.0
        s.outerConeAngle = np.pi / 2 - 0.05
        s.innerConeAngle = np.pi / 3
        s.innerConeAngle = 0.0
        s.outerConeAngle = np.pi / 4.0
        p = PointLight()
        assert p.name is None
        assert np.all(p.color == 1.0)
        assert p.intensity == 1.0
        assert p.range is None
        ValueError: p.range = -1.0
        ValueError: p.range = 0.0
        p.range = 5.0
    """,
    "meshes": """
        TypeError: Mesh()
        TypeError: Primitive()
        ValueError: Primitive([], mode=10)
        x = Mesh([])
        assert x.name is None
        assert x.is_visible
        assert x.weights is None
        x.name = "str"
    """,
    "meshes of trimesh": """
        x = Mesh.from_trimesh(cube())
        assert len(x.primitives) == 1
        assert x.is_visible
        assert np.allclose(x.bounds, [[-0.5, -0.5, -0.5], [0.5, 0.5, 0.5]])
        assert np.allclose(x.centroid, np.zeros(3))
        assert np.allclose(x.extents, np.ones(3))
        assert np.allclose(x.scale, np.sqrt(3))
        assert not x.is_transparent
        p = x.primitives[0]
        ValueError: p.normals = np.zeros(10)
        ValueError: p.tangents = np.zeros(10)
        ValueError: p.texcoord_0 = np.zeros(10)
        ValueError: p.texcoord_1 = np.zeros(10)
        ValueError: p.texcoord_1 = np.zeros((8, 3))
        TypeError: p.material = np.zeros(10)
        assert p.targets is None
        assert np.allclose(p.bounds, x.bounds)
        p.tangents = np.zeros((8, 4))
        p.texcoord_0 = np.zeros((8, 3))
        assert p.texcoord_0.shape == (8, 2)
        p.texcoord_1 = None
        p.material.baseColorFactor = np.zeros(4)
        assert p.is_transparent
        p.material = None
        assert isinstance(p.material, MetallicRoughnessMaterial)
        assert not p.is_transparent
        x = Mesh.from_trimesh([cube(), cube()], smooth=False)
        assert len(x.primitives) == 2
        TypeError: Mesh.from_trimesh(None)
        TypeError: Mesh.from_trimesh([None])
        poses = np.tile(np.eye(4), (5, 1, 1))
        poses[:, 0, 3] = np.arange(5)
        x = Mesh.from_trimesh(cube(), poses=poses)
        assert np.allclose(x.bounds, [[-0.5, -0.5, -0.5], [4.5, 0.5, 0.5]])
        x = Mesh.from_trimesh(cube(), poses=np.eye(4))
        assert x.primitives[0].poses.shape == (1, 4, 4)
        ValueError: Mesh.from_trimesh(cube(), poses=np.eye(3))
        f = cube(kind="face", face_colors=np.tile([1.0, 0.0, 0.0, 1.0], (12, 1)))
        x = Mesh.from_trimesh(f, smooth=False)
        assert not x.is_transparent
        ValueError: Mesh.from_trimesh(f, smooth=True)
        ValueError: Mesh.from_trimesh(f)
        v = cube(kind="vertex", vertex_colors=np.tile([1.0, 0.0, 0.0, 0.5], (8, 1)))
        assert Mesh.from_trimesh(v, smooth=False).is_transparent
        x = Mesh.from_trimesh(v, smooth=True)
        assert x.primitives[0].color_0 is not None
        assert x.is_transparent
        x = Mesh.from_points(cube().vertices)
    """,
    "nodes": """
        x = Node()
        assert x.name is None
        assert x.camera is None
        assert x.children == []
        assert x.skin is None
        assert np.allclose(x.matrix, np.eye(4))
        assert x.mesh is None
        assert np.allclose(x.rotation, [0, 0, 0, 1])
        assert np.allclose(x.scale, np.ones(3))
        assert np.allclose(x.translation, np.zeros(3))
        assert x.weights is None
        assert x.light is None
        x.name = "node"
        c, m, d = PerspectiveCamera(yfov=2.0), Mesh([]), DirectionalLight()
        x.camera = c
        assert x.camera == c
        TypeError: x.camera = m
        TypeError: x.camera = d
        x.camera = None
        assert x.camera is None
        x.mesh = m
        assert x.mesh == m
        TypeError: x.mesh = c
        TypeError: x.mesh = d
        x.light = d
        assert x.light == d
        TypeError: x.light = m
        TypeError: x.light = c
    """,
    "scenes": """
        s = Scene()
        assert np.allclose(s.bg_color, np.ones(4))
        assert np.allclose(s.ambient_light, np.zeros(3))
        assert len(s.nodes) == 0
        assert s.name is None
        s.name = "asdf"
        s.bg_color = None
        s.ambient_light = None
        assert np.allclose(s.bg_color, np.ones(4))
        assert np.allclose(s.ambient_light, np.zeros(3))
        assert s.nodes == set()
        assert s.cameras == set()
        assert s.lights == set()
        assert s.point_lights == set()
        assert s.spot_lights == set()
        assert s.directional_lights == set()
        assert s.meshes == set()
        assert s.camera_nodes == set()
        assert s.light_nodes == set()
        assert s.point_light_nodes == set()
        assert s.spot_light_nodes == set()
        assert s.directional_light_nodes == set()
        assert s.mesh_nodes == set()
        assert s.main_camera_node is None
        assert np.all(s.bounds == 0)
        assert np.all(s.centroid == 0)
        assert np.all(s.extents == 0)
        assert np.all(s.scale == 0)
        n = s.add(SpotLight(), name="spot")
        assert s.spot_light_nodes == {n}
        assert s.spot_lights == {n.light}
        assert s.point_lights == set()
        assert s.get_nodes(name="spot") == {n}
        assert s.has_node(n)
        s.remove_node(n)
        assert not s.has_node(n)
        ValueError: s.remove_node(n)
        TypeError: s.add(None)
    """,
    "IntrinsicsCamera": """
        TypeError: IntrinsicsCamera()
        c = IntrinsicsCamera(fx=100.0, fy=80.0, cx=50.0, cy=40.0)
        assert c.znear == 0.05
        assert c.zfar == 100.0
        TypeError: c.fx = None
        ValueError: c.fx = 0.0
        TypeError: c.fy = None
        ValueError: c.fy = -1.0
        c.cx = 30.0
        assert np.allclose(c.get_projection_matrix(100, 80)[:2], [[2, 0, 0.4, 0], [0, 2, 0, 0]])
    """,
    "materials": """
        x = MetallicRoughnessMaterial()
        assert np.all(x.baseColorFactor == 1.0)
        assert np.all(x.emissiveFactor == 0.0)
        assert x.metallicFactor == 1.0
        assert x.roughnessFactor == 1.0
        assert x.alphaMode == "OPAQUE"
        assert x.alphaCutoff == 0.5
        assert x.doubleSided is False
        assert x.smooth is True
        assert x.wireframe is False
        assert x.normalTexture is None
        assert x.occlusionTexture is None
        assert x.emissiveTexture is None
        assert x.baseColorTexture is None
        assert x.metallicRoughnessTexture is None
        assert x.is_transparent is False
        ValueError: x.metallicFactor = 1.5
        ValueError: x.roughnessFactor = -1.0
        ValueError: x.alphaCutoff = 2.0
        ValueError: x.alphaMode = "GLASS"
        TypeError: x.doubleSided = 3
        x.doubleSided = True
        x.alphaMode = "BLEND"
        x.baseColorFactor = [1.0, 0.0, 0.0, 0.5]
        assert np.allclose(x.baseColorFactor, [1, 0, 0, 0.5])
        assert x.is_transparent is True
        p = Primitive(np.eye(3), material=x)
        assert p.is_transparent is True
        assert Mesh([p]).is_transparent is True
        assert Mesh([Primitive(np.eye(3))]).is_transparent is False
    """,
    "primitives": """
        p = Primitive([[0, 0, 0], [1, 0, 0], [0, 1, 0]])
        assert p.mode == GLTF.TRIANGLES
        assert p.normals is None
        assert p.texcoord_0 is None
        assert p.color_0 is None
        assert p.poses is None
        assert p.targets is None
        assert np.allclose(p.bounds, [[0, 0, 0], [1, 1, 0]])
        assert np.allclose(p.centroid, [0.5, 0.5, 0])
        assert np.allclose(p.extents, [1, 1, 0])
        assert np.isclose(p.scale, np.sqrt(2))
        ValueError: Primitive(np.eye(3), normals=np.eye(2))
        ValueError: Primitive(np.eye(3), texcoord_0=np.zeros((2, 2)))
        ValueError: Primitive(np.eye(3), color_0=np.zeros((2, 3)))
        ValueError: Mesh.from_points(np.zeros((4, 2)))
        m = Mesh([p])
        assert np.allclose(m.bounds, p.bounds)
        m.is_visible = False
        assert not m.is_visible
    """,
    "poses of nodes": """
        x = Node(translation=[1, 2, 3])
        assert np.allclose(x.matrix[:3, 3], [1, 2, 3])
        ValueError: Node(translation=[1, 2])
        ValueError: Node(rotation=[1, 2, 3])
        ValueError: Node(rotation=[1, 1, 1, 1])
        ValueError: Node(matrix=np.eye(3))
        ValueError: Node(matrix=[[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [1, 2, 3, 1]])
        x.rotation = [1, 0, 0, 0]
        assert np.allclose(x.matrix[:3, :3], np.diag([1, -1, -1]))
        x.scale = [1, 2, 3]
        assert np.allclose(x.scale, [1, 2, 3])
        x = Node()
        x.matrix[0, 0] = 500
        assert x.matrix[0, 0] == 1.0
        x.matrix = np.diag([2, 2, 2, 1])
        assert np.allclose(x.scale, 2)
        assert np.allclose(x.translation, 0)
    """,
    "graphs": """
        n1, n2, n3 = Node(), Node(), Node()
        s = Scene(nodes=[n1, n2, n3])
        n1.children.append(n2)
        s = Scene(nodes=[n1, n2, n3])
        assert s.nodes == {n1, n2, n3}
        n3.children.append(n2)
        ValueError: Scene(nodes=[n1, n2, n3])
        n3.children = []
        n2.children.append(n3)
        n3.children.append(n2)
        ValueError: Scene(nodes=[n1, n2, n3])
        ValueError: Scene(nodes=[n2, n3])
        n1, n2, n3 = Node(name="a"), Node(name="b"), Node(name="b")
        s = Scene(nodes=[n1], bg_color=[0, 1.0, 0])
        assert np.allclose(s.bg_color, [0, 1, 0, 1])
        assert s.has_node(n1)
        assert not s.has_node(n2)
        s.add_node(n2, parent_node=n1)
        assert n2 in n1.children
        ValueError: s.add_node(n2)
        ValueError: s.add_node(n3, parent_node=Node())
        n1.translation = [1, 0, 0]
        n2.translation = [0, 1, 0]
        assert np.allclose(s.get_pose(n2)[:3, 3], [1, 1, 0])
        ValueError: s.get_pose(n3)
        ValueError: s.set_pose(n3, np.eye(4))
        s.set_pose(n1, np.eye(4))
        assert np.allclose(s.get_pose(n2)[:3, 3], [0, 1, 0])
        assert s.get_nodes(name="b") == {n2}
        assert s.get_nodes(node=n1) == {n1}
        assert s.get_nodes(node=n3) == set()
        assert s.get_nodes(obj=Mesh([])) == set()
        c = PerspectiveCamera(yfov=1.0, name="eye")
        x = s.add(c, parent_name="b")
        assert x in n2.children
        ValueError: s.add(c, parent_name="nobody")
        s.add_node(n3)
        ValueError: s.add(Mesh([]), parent_name="b")
        assert s.get_nodes(obj=c) == {x}
        assert s.get_nodes(obj_name="eye") == {x}
        assert s.main_camera_node is x
        y = s.add(OrthographicCamera(1.0, 1.0))
        assert s.main_camera_node is x
        s.main_camera_node = y
        assert s.main_camera_node is y
        ValueError: s.main_camera_node = Node()
        ValueError: s.main_camera_node = n1
        s.remove_node(y)
        assert s.main_camera_node is x
        s.clear()
        assert s.main_camera_node is None
        assert s.nodes == set()
    """,
    "pictures": """
        r = OffscreenRenderer(viewport_width=64, viewport_height=48)
        assert r.viewport_width == 64
        r.viewport_height = 32
        r.point_size = 3.0
        assert r.point_size == 3.0
        ValueError: OffscreenRenderer(0, 10)
        ValueError: r.render(Scene())
        s = Scene()
        s.add(PerspectiveCamera(yfov=1.0))
        color, depth = r.render(s)
        assert color.shape == (32, 64, 3)
        assert depth.shape == (32, 64)
        assert color.dtype == np.uint8
        assert depth.dtype == np.float32
        assert np.all(color == 255)
        assert np.all(depth == 0)
        assert r.render(s, RenderFlags.RGBA)[0].shape == (32, 64, 4)
        assert r.render(s, RenderFlags.DEPTH_ONLY).shape == (32, 64)
        r.delete()
    """,
}
LINES = [(part, line.strip()) for part, text in STATEMENTS.items() for line in text.splitlines() if line.strip()]


def cube(**visual):
    """What from_trimesh reads of trimesh.creation.box()."""
    corners, quads = box(1, 1, 1)
    visual = visual or {"defined": False}
    return SimpleNamespace(vertices=corners - 0.5, faces=quads[:, [0, 1, 2, 0, 2, 3]].reshape(-1, 3),
                           vertex_normals=(2 * corners - 1) / np.sqrt(3), visual=SimpleNamespace(**visual))


@pytest.mark.parametrize("part", STATEMENTS)
def test_statements_of_pyrender(part):
    names = {**{name: getattr(pyrender, name) for name in pyrender.__all__}, "np": np, "cube": cube}
    for _, line in (row for row in LINES if row[0] == part):
        error, _, code = line.partition(": ") if line.startswith(("TypeError: ", "ValueError: ")) else ("", "", line)
        if not error:
            exec(code, names)
            continue
        try:
            exec(code, names)
        except {"TypeError": TypeError, "ValueError": ValueError}[error]:
            continue
        raise AssertionError(f"no {error}: {code}")


def test_how_many_statements():
    assert len(LINES) == 362


def test_what_is_not_drawn_of_a_material_is_told():
    with pytest.warns(UserWarning, match="material: occlusionTexture, wireframe left out"):
        pyrender.Material(occlusionTexture=np.zeros((2, 2, 3)), wireframe=True)
    with pytest.warns(UserWarning, match="MASK is drawn as OPAQUE"):
        pyrender.Material(alphaMode="MASK")
    with pytest.raises(TypeError):
        pyrender.Material(colour=1)
    with pytest.warns(UserWarning, match="color_0: its alpha is not drawn"):
        pyrender.Primitive(np.eye(3), color_0=[1.0, 0.0, 0.0, 0.5])
