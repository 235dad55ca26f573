"""oracle.py folder - scenes drawn by the package for Python: what goes in as JSON, RGBA bytes, depth
and ids as they are."""
import json
import struct
import sys
import zipfile
from dataclasses import asdict
from pathlib import Path

import numpy as np

import shade_h as shade

OUT = Path(sys.argv[1])
told = []


def torus(n):
    u, v = np.meshgrid(np.arange(2 * n) * np.pi / n, np.arange(n) * 2 * np.pi / n, indexing="ij")
    around = np.stack([np.cos(u), np.sin(u), 0 * u], -1)
    normals = np.cos(v)[..., None] * around + np.sin(v)[..., None] * [0, 0, 1]
    i, j = np.meshgrid(np.arange(2 * n), np.arange(n), indexing="ij")
    k, m = (i + 1) % (2 * n), (j + 1) % n
    quads = np.stack([i * n + j, k * n + j, k * n + m, i * n + m], -1).reshape(-1, 4)
    faces = quads[:, [0, 1, 2, 0, 2, 3]].reshape(-1, 3)
    return (2 * around + 0.8 * normals).reshape(-1, 3), faces, normals.reshape(-1, 3), \
        np.stack([u / (2 * np.pi), v / (2 * np.pi)], -1).reshape(-1, 2)


def box(x, y, z):
    corners = np.array([[i, j, k] for i in (0, 1) for j in (0, 1) for k in (0, 1)], float)
    quads = np.array([[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4],
                      [1, 5, 7, 3]])
    return corners * [x, y, z], quads[:, [0, 1, 2, 0, 2, 3]].reshape(-1, 3)


def prism(n):
    """Its sides meet at 360 / n degrees."""
    t = np.arange(n) * 2 * np.pi / n
    rim = np.stack([np.cos(t), np.sin(t), 0 * t], 1)
    i, j = np.arange(n), (np.arange(n) + 1) % n
    sides = np.stack([i, j, j + n, i, j + n, i + n], 1).reshape(-1, 3)
    return np.concatenate([rim, rim + [0, 0, 1]]), sides


def plain(value):
    return value.reshape(-1).tolist() if isinstance(value, np.ndarray) else value


def own_light(lamps, ambient, model, flags):
    """The lamps as the package for JavaScript takes them."""
    keys = {"spot_direction": "spotDirection", "spot_exponent": "spotExponent",
            "spot_cos_cutoff": "spotCosCutoff"}
    models = ("blinn-phong", "phong", "lambert", "ambient", "emissive", "cool-to-warm")
    return {"lights": [{keys.get(k, k): v for k, v in asdict(lamp).items()} for lamp in lamps],
            "ambient": ambient, "model": models[model], "flags": int(flags)}


def draw(name, meshes, view="iso", size=(200, 150), lighting=None, **options):
    """meshes: dicts of vertices, faces, the options of shade.Mesh, and of Scene.add."""
    scene, given = shade.Scene(*lighting or ()), []
    for mesh in meshes:
        own = dict(mesh)
        place = {k: own.pop(k) for k in ("material", "pose", "edges", "two_sided") if k in own}
        scene.add(shade.Mesh(own.pop("vertices"), own.pop("faces"), **own), **place)
        given.append({k: plain(v) for k, v in mesh.items()})
        if "texture" in mesh:
            h, w, _ = mesh["texture"].shape
            given[-1]["texture"] = {"data": plain(mesh["texture"]), "width": w, "height": h}
        if "pose" in mesh:
            given[-1]["pose"] = plain(mesh["pose"].T)
        if isinstance(mesh.get("color"), np.ndarray):
            given[-1]["colors"], given[-1]["bytes"] = given[-1].pop("color"), \
                mesh["color"].dtype == np.uint8
    picture = scene.render(view, size, **options)
    for part in ("rgba", "depth", "ids"):
        (OUT / f"{name}.{part}").write_bytes(getattr(picture, part).tobytes())
    camera = view if not isinstance(view, shade.Camera) else \
        {"view": plain(view.view.T), "projection": plain(view.projection.T)}
    told.append({"name": name, "meshes": given, "options":
                 {"view": camera, "size": size, **options,
                  **({"light": own_light(*lighting)} if lighting else {})}})


vertices, faces, normals, uv = torus(24)
ring = {"vertices": vertices, "faces": faces}
brick = dict(zip(("vertices", "faces"), box(3, 2, 1)))
rng = np.random.default_rng(5)
draw("auto", [ring])
draw("given", [{**ring, "normals": normals, "color": "steel"}], samples=1)
draw("smooth", [{**brick, "normals": "smooth"}], "front", samples=2)
draw("flat", [{**ring, "normals": "flat", "color": "#0af", "edges": True}], (200, -70))
draw("edges", [{**brick, "edges": True, "color": "#d4a017"}], up="y")
draw("parallel", [{**brick, "edges": True}], (30, 20), ortho=True)
for side in ("right", "back", "left", "top", "bottom"):
    draw(side, [{**ring, "material": "gold", "edges": True}], side, samples=1, ortho=side == "top")
for count in (8, 10, 14):    # 45 degrees: an edge and a crease; 36: an edge; 26: none of them
    draw(f"prism {count}", [{**dict(zip(("vertices", "faces"), prism(count))), "edges": True}])
draw("vertices", [{**ring, "color": rng.integers(0, 256, (len(vertices), 3)).astype(np.uint8)}])
draw("faces", [{**brick, "color": rng.random((12, 3)), "edges": True}], (60, 40))
draw("creased", [{**ring, "color": rng.random((len(faces), 3)), "normals": "smooth"}], samples=1)
draw("texture", [{**ring, "uv": uv * [6, 2], "texture": np.kron(
    [[[0, 40, 90], [250, 220, 60]], [[200, 60, 60], [255, 255, 255]]],
    np.ones((8, 8, 1))).astype(np.uint8)}], (20, 50), (220, 160))
draw("clear", [{**ring, "material": "ruby"}], background=None, samples=4)
pose = np.eye(4)
pose[:3, :3], pose[:3, 3] = [[0.6, -0.8, 0], [0.8, 0.6, 0], [0, 0, 1]], (1.5, -0.5, 0.25)
draw("several", [{**ring, "material": "jade"},
                 {**brick, "pose": pose, "edges": True, "color": "orange"}], background="#203040")
draw("one-sided", [{**ring, "faces": faces[::2], "two_sided": False}], samples=1)
hole = vertices.copy()
hole[7], hole[300], hole[301] = np.nan, 3e38, -np.inf
draw("bad", [{**ring, "vertices": np.where(np.isfinite(hole), hole, 1e30)}])
n = len(vertices)    # faces with two corners at one place
draw("hidden", [{"vertices": np.concatenate([vertices, np.full((3, 3), 5e6)]),
                 "faces": np.concatenate([faces, [[n, n + 1, n + 2], [n, n, n], [0, 0, n]]])}])
draw("camera", [ring], shade.Camera.look_at((4, -6, 5), fov=40, aspect=1.5, near=1, far=20),
     (180, 120))
for side in ("iso", "top", (200, 15)):
    draw(f"studio {side}", [{**ring, "color": "steel"}, {**brick, "edges": True}], side, light="studio")
draw("studio y", [brick], up="y", light="studio", samples=2, background=None)
lamps = [shade.Light.point((3, -4, 4), (9, 8, 7), (1, 0, 0.5)),
         shade.Light.spot((0, -5, 6), (0, 0.6, -1), 0.5, 3, (0.9, 0.9, 1)),
         shade.Light.directional((1, 2, -3), (0.2, 0.3, 0.2))]
for model in shade.Model:
    draw(f"lamps {model.name}", [{**ring, "material": "gold"}],
         lighting=(lamps, (0.1, 0.1, 0.2), model, shade.Flag.UNGATED_SPECULAR), samples=1)
far = {**ring, "vertices": vertices + [1e8, -3e7, 2e6]}
far_pose = np.eye(4)
far_pose[:3, 3] = 1e8 + 4.5, -3e7, 2e6
draw("far", [{**far, "edges": True}])
draw("far by its pose", [far, {**brick, "pose": far_pose, "edges": True}], "top", ortho=True)
draw("far camera", [far], shade.Camera.look_at((1e8 + 4, -3e7 - 6, 2e6 + 5), (1e8, -3e7, 2e6),
                                               aspect=1, near=1, far=20))
draw("far lamps", [far], lighting=(
    [shade.Light.point((1e8 + 3, -3e7 - 4, 2e6 + 4), (9, 8, 7), (1, 0, 0.5))], (0.1, 0.1, 0.2),
    shade.Model.PHONG, shade.Flag.NONE))
draw("far studio", [far], light="studio", samples=1)
draw("nothing", [{"vertices": np.zeros((0, 3)), "faces": np.zeros((0, 3), int)}], size=(9, 7))


def glb(mode, alpha):
    """A ring in two places, one of them mirrored, with normals, colours and two materials."""
    data, views, accessors = b"", [], []
    for array, kind, code in ((vertices.astype("<f4"), "VEC3", 5126), (normals.astype("<f4"), "VEC3", 5126),
                              (np.abs(normals).astype("<f4"), "VEC3", 5126),
                              (faces.astype("<u2").reshape(-1), "SCALAR", 5123),
                              (uv.astype("<f4"), "VEC2", 5126)):
        views.append({"buffer": 0, "byteOffset": len(data), "byteLength": array.nbytes})
        accessors.append({"bufferView": len(views) - 1, "componentType": code, "type": kind,
                          "count": len(array)})
        data += array.tobytes() + bytes(-array.nbytes % 4)
    base = {"POSITION": 0, "NORMAL": 1}
    text = json.dumps({
        "asset": {"version": "2.0"}, "buffers": [{"byteLength": len(data)}], "bufferViews": views,
        "accessors": accessors, "scenes": [{"nodes": [0, 2]}], "nodes": [
            {"mesh": 0, "translation": [0.5, 0.25, 1], "children": [1]},
            {"mesh": 1, "scale": [-0.5, 0.5, 0.75], "translation": [0, 2, 0]},
            {"mesh": 1, "matrix": [0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 3, -2, 0, 1]}],
        "meshes": [{"primitives": [{"attributes": {**base, "COLOR_0": 2}, "indices": 3, "material": 1}]},
                   {"primitives": [{"attributes": base, "indices": 3, "material": 0}]}],
        "materials": [{"pbrMetallicRoughness": {"baseColorFactor": [0.8, 0.3, 0.1, 1],
                                                "roughnessFactor": 0.4}},
                      {"pbrMetallicRoughness": {"metallicFactor": 0.25, "baseColorFactor": [1, 1, 1, alpha]},
                       "emissiveFactor": [0, 0, 0.1], "alphaMode": mode}],
    }).encode()
    text += b" " * (-len(text) % 4)
    return struct.pack("<4sIIII", b"glTF", 2, 28 + len(text) + len(data), len(text), 0x4E4F534A) + \
        text + struct.pack("<II", len(data), 0x004E4942) + data


for name, mode, alpha in (("model", "OPAQUE", 0.3), ("glass", "BLEND", 0.3)):
    (OUT / f"{name}.glb").write_bytes(glb(mode, alpha))
    soft = shade.render(OUT / f"{name}.glb", size=(100, 75), light="studio")    # metal's mirror image
    model = shade.render(OUT / f"{name}.glb", size=(200, 150))
    (OUT / f"{name}.rgba").write_bytes(model.rgba.tobytes() + soft.rgba.tobytes())
    assert len(np.unique(model.rgba)) > 100


def threemf():
    """A box in two colours, mirrored and moved, and a part of two of another file."""
    head = '<?xml version="1.0"?><model unit="millimeter" xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02"' \
        ' xmlns:p="http://schemas.microsoft.com/3dmanufacturing/production/2015/06"' \
        ' xmlns:m="http://schemas.microsoft.com/3dmanufacturing/material/2015/02"><resources>'

    def mesh(points, corners, marks):
        return "<mesh><vertices>" + "".join(
            '<vertex x="%r" y="%r" z="%r"/>' % tuple(map(float, p)) for p in points) + "</vertices><triangles>" + \
            "".join('<triangle v1="%d" v2="%d" v3="%d"%s/>' % (*f, marks[i % len(marks)])
                    for i, f in enumerate(corners)) + "</triangles></mesh>"

    root = head + '<basematerials id="5"><base name="a" displaycolor="#FF8000"/></basematerials>' \
        '<m:colorgroup id="6"><m:color color="#00FF00"/><m:color color="#0000FF"/></m:colorgroup>' \
        '<object id="1" pid="5" pindex="0">' + mesh(*box(3, 2, 1), ["", ' pid="6" p1="1"']) + '</object>' \
        '<object id="2"><components><component objectid="1" transform="1 0 0 0 1 0 0 0 1 0 0 2"/>' \
        '<component objectid="7" p:path="/3D/other.model" transform="0 1 0 -1 0 0 0 0 1 5 0 0.5"/></components></object>' \
        '</resources><build><item objectid="2"/><item objectid="1" transform="-1 0 0 0 1 0 0 0 1 -1 0.25 0"/></build></model>'
    other = head + '<object id="7">' + mesh(vertices, faces, [""]) + "</object></resources><build/></model>"
    relations = '<Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships"><Relationship ' \
        'Target="/3D/3dmodel.model" Id="r" Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/></Relationships>'
    with zipfile.ZipFile(OUT / "model.3mf", "w", zipfile.ZIP_DEFLATED) as file:
        for name, words in (("_rels/.rels", relations), ("3D/3dmodel.model", root), ("3D/other.model", other)):
            file.writestr(name, words)


threemf()
model = shade.render(OUT / "model.3mf", size=(200, 150))
(OUT / "plate.rgba").write_bytes(model.rgba.tobytes())
assert len(np.unique(model.rgba)) > 100
(OUT / "scenes.json").write_text(json.dumps(told))


def files():
    """The torus and a box beside it in other formats: red and blue in OBJ and PLY, grey in OFF and STL."""
    points, corners = box(1, 2, 1)
    both = [(vertices, faces), (points + [4, 0, 0], corners)]
    obj = "mtllib colors.mtl\n"
    for (p, f), name, first in zip(both, ("red", "blue"), (1, 1 + len(vertices))):
        obj += f"usemtl {name}\n" + "".join(f"v {x} {y} {z}\n" for x, y, z in p)
        obj += "".join(f"f {a + first} {b + first} {c + first}\n" for a, b, c in f)
    (OUT / "file.obj").write_text(obj)
    (OUT / "colors.mtl").write_text("newmtl red\nKd 0.8 0.1 0.1\nnewmtl blue\nKd 0.1 0.1 0.8\n")
    p = np.concatenate([vertices, points + [4, 0, 0]]).astype("<f4")
    f = np.concatenate([faces, corners + len(vertices)])
    rows = [" ".join(map(str, row)) for row in p.tolist()]
    (OUT / "file.off").write_text("\n".join(
        [f"OFF {len(p)} {len(f)} 0", *rows, *(f"3 {a} {b} {c}" for a, b, c in f)]))
    tints = [" 200 30 30"] * len(vertices) + [" 30 30 200"] * len(points)
    head = f"ply\nformat ascii 1.0\nelement vertex {len(p)}\n" + "".join(
        f"property float {k}\n" for k in "xyz") + "".join(
        f"property uchar {k}\n" for k in ("red", "green", "blue"))
    (OUT / "file.ply").write_text(head + f"element face {len(f)}\nproperty list uchar int vertex_indices\n"
                                  "end_header\n" + "\n".join(
        [row + tint for row, tint in zip(rows, tints)] + [f"3 {a} {b} {c}" for a, b, c in f]) + "\n")
    (OUT / "file.stl").write_bytes(bytes(80) + struct.pack("<I", len(f)) + b"".join(
        bytes(12) + p[face].tobytes() + bytes(2) for face in f))


files()
for name in ("obj", "off", "ply", "stl"):
    model = shade.render(OUT / f"file.{name}", size=(200, 150), up="z")
    (OUT / f"file.{name}.rgba").write_bytes(model.rgba.tobytes())
    assert len(np.unique(model.rgba)) > 100


LEAF = np.zeros((8, 8, 4), np.uint8)
LEAF[...] = np.arange(8)[:, None, None] * 30
LEAF[:, :4, 3] = 255


# a Renderer: colour, depth, numbers and normals one after the other
def sight():
    sim = shade.Renderer(60, 80)
    sim.add("plane", texture=sim.checker(), repeat=(0.5, 0.5))
    points, faces = box(0.6, 0.6, 0.6)
    uv = points[:, :2] / 0.6
    tinted = sim.mesh(points + [5e4, 0, 0], faces, colors=np.tile([[0.9, 0.4, 0.2], [0.2, 0.5, 0.9]], (4, 1)))
    mapped = sim.mesh(points, faces, uv=uv)
    sim.add(tinted, at=(-5e4, 0.6, 0.1))
    sim.add(mapped, at=(-1.2, -0.6, 0.1), texture=sim.checker("red", "white"))
    ring = sim.mesh(*torus(9)[:2])
    sim.add(ring, 0.2, at=(1.2, -1, 0.4), color="green", specular=0.5)
    for i, (name, size) in enumerate({"sphere": 0.3, "ellipsoid": (0.35, 0.2, 0.15), "capsule": (0.15, 0.3),
                                      "cylinder": (0.2, 0.3), "box": (0.25, 0.2, 0.3)}.items()):
        sim.add(name, size, at=(i * 0.8 - 2, -0.2, 0.5), color="yellow", alpha=0.5 if i == 1 else 1)
    sim.light([shade.Light.directional((-0.5, 1, -1.5), (0.8, 0.8, 0.8))], (0.3, 0.3, 0.3), 0)
    sim.sky()
    camera = shade.Camera.look_at((0, -4, 2.5), (0, 0, 0.3), fov=45, aspect=80 / 60, near=0.1, far=50)
    frame = sim.render(camera, normals=True)
    assert len(np.unique(frame.ids[..., 0])) >= 8
    # what has changed, moved, come and gone since
    sim.remove(5)
    sim.update(ring, points, faces)
    sim.change(3, size=0.4, color=(0.9, 0.2, 0.6), specular=(0.1, 0.5, 0.9), shininess=9.0)
    leaf = shade.Mesh(points, faces, uv=uv, surfaces=(np.zeros(len(faces), int), [shade.Surface(
        shade.Material((0, 0.1, 0), (1, 1, 1), (0.8, 0.7, 0.6), (0.5, 0.4, 0.3), 20.0), LEAF, cutoff=0.5)]))
    assert sim.add(sim.mesh(leaf), at=(0.3, -1.6, 0.3), two_sided=True) not in range(9)    # no number is given twice
    plain, bent = shade.Material((0, 0, 0), (0.6, 0.7, 0.8), (0.6, 0.7, 0.8), (0.2, 0.2, 0.2), 12.0), (190, 128, 230)
    for x, own in ((-0.5, {"relief": LEAF, "strength": 0.25, "glow": LEAF, "glow_factor": (0.2, 0.5, 0.125), "squares": True}),
                   (-1.5, {"relief": np.full((1, 1, 3), bent, np.uint8), "strength": 1.5, "texture": LEAF[..., :3]})):
        dressed = shade.Mesh(points, faces, uv=uv, surfaces=(np.zeros(len(faces), int), [shade.Surface(plain, **own)]))
        sim.add(sim.mesh(dressed), (1, 0.5, 1.5), at=(x, -1.6, 0.3), repeat=(1, 2))
    sim.pose(4, [[0, -1, 0, -2], [1, 0, 0, 0.2], [0, 0, 1, 0.9], [0, 0, 0, 1]])
    spot = shade.Light((1, -2, 4, 1), (0.5,) * 3, (0.5,) * 3, spot_direction=(-0.2, 0.4, -1), spot_exponent=2.0,
                       spot_cos_cutoff=0.8)
    sim.light([shade.Light.directional((-0.5, 1, -1.5), (0.5, 0.5, 0.5)), spot], (0.3, 0.3, 0.3), (0, 1))
    beside = np.eye(4)
    beside[0, 3] = 0.5
    later = sim.render_batch([camera, shade.Camera(beside @ camera.view, camera.projection)], normals=True)
    assert len(np.unique(later.ids[0, ..., 0])) >= 8 and (later.color != frame.color).any(-1).mean() > 0.2
    (OUT / "sight.bytes").write_bytes(b"".join(array.tobytes() for array in (*frame, *later)))
    told = {"view": camera.view.T.ravel().tolist(), "projection": camera.projection.T.ravel().tolist(),
            "box": points.ravel().tolist(), "faces": faces.ravel().tolist(), "uv": uv.ravel().tolist(),
            "torus": [a.ravel().tolist() for a in torus(9)[:2]]}
    (OUT / "sight.json").write_text(json.dumps(told))


sight()
