"""GLB and 3MF: what they show, and that damaged ones are drawn or refused."""
import io
import json
import re
import struct
import subprocess
import sys
import warnings
import zipfile
from types import SimpleNamespace

import numpy as np
import pytest
from shapes import box, ply

import shade_h as shade
from shade_h import files

FLAT = {"view": "front", "ortho": True, "size": (64, 48), "samples": 1}


class Glb:
    """Writes GLB files."""

    def __init__(self):
        self.binary = b""
        self.json = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
                     "nodes": [], "meshes": [], "accessors": [], "bufferViews": [],
                     "materials": [], "buffers": [{}]}

    def view(self, data):
        self.binary += bytes(-len(self.binary) % 4)
        self.json["bufferViews"].append({"buffer": 0, "byteOffset": len(self.binary),
                                         "byteLength": len(data)})
        self.binary += data
        return len(self.json["bufferViews"]) - 1

    def accessor(self, array, kind, **more):
        array = np.asarray(array)
        code = {"i1": 5120, "u1": 5121, "i2": 5122, "u2": 5123, "u4": 5125, "f4": 5126}
        self.json["accessors"].append({
            "bufferView": self.view(array.tobytes()), "count": len(array), "type": kind,
            "componentType": code[array.dtype.str[1:]], **more})
        return len(self.json["accessors"]) - 1

    def quad(self, material=None, uv=None, **more):
        """A unit square that looks along +z."""
        points = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], "<f4")
        attributes = {"POSITION": self.accessor(points, "VEC3")}
        if uv is not None:
            attributes["TEXCOORD_0"] = self.accessor(np.asarray(uv, "<f4"), "VEC2")
        index = self.accessor(np.array([0, 1, 2, 0, 2, 3], "<u2"), "SCALAR")
        it = {"attributes": attributes, "indices": index, **more}
        if material is not None:
            self.json["materials"].append(material)
            it["material"] = len(self.json["materials"]) - 1
        self.json["meshes"].append({"primitives": [it]})
        return len(self.json["meshes"]) - 1

    def node(self, **more):
        self.json["nodes"].append(more)
        return len(self.json["nodes"]) - 1

    def bytes(self):
        self.json["buffers"][0]["byteLength"] = len(self.binary)
        self.json["scenes"][0]["nodes"] = list(range(len(self.json["nodes"])))
        text = json.dumps(self.json).encode()
        text += b" " * (-len(text) % 4)
        body = struct.pack("<II", len(text), 0x4E4F534A) + text + \
            struct.pack("<II", len(self.binary), 0x004E4942) + self.binary
        return b"glTF" + struct.pack("<II", 2, 12 + len(body)) + body


def colored(red, green, blue, alpha=1.0, **more):
    return {"pbrMetallicRoughness": {"baseColorFactor": [red, green, blue, alpha],
                                     "metallicFactor": 0, "roughnessFactor": 0.9}, **more}


def drawn(data, **more):
    return shade.render(io.BytesIO(data), **{**FLAT, **more})


def test_nodes_of_glb_are_where_their_transforms_say():
    made = Glb()
    mesh = made.quad(colored(1, 0, 0))
    made.node(mesh=mesh, translation=[1e7, 0, 0])
    turn = np.diag([2.0, 2, 2, 1])
    turn[:3, 3] = 1e7 + 2, 1, 0
    made.node(mesh=mesh, matrix=turn.T.reshape(-1).tolist())
    half = np.sqrt(0.5)
    made.node(mesh=mesh, translation=[1e7, 2, 0], rotation=[0, 0, half, half], scale=[1, -1, 1])
    got = shade.load(io.BytesIO(made.bytes()))
    assert got.up == "y" and len(got.faces) == 6
    assert np.allclose(got.vertices[4:8] - [1e7, 0, 0],
                       [[2, 1, 0], [4, 1, 0], [4, 3, 0], [2, 3, 0]], atol=1e-6)
    assert np.allclose(got.vertices[8:] - [1e7, 0, 0],
                       [[0, 2, 0], [0, 3, 0], [1, 3, 0], [1, 2, 0]], atol=1e-6)
    sides = np.cross(*(got.vertices[got.faces[:, k]] - got.vertices[got.faces[:, 0]]
                       for k in (1, 2)))
    assert (sides[:, 2] > 0).all()    # the mirrored one looks the same way


def test_materials_and_alpha_of_glb():
    made = Glb()
    made.node(mesh=made.quad(colored(1, 0, 0)))
    made.node(mesh=made.quad(colored(0, 0, 1, 0.5, alphaMode="BLEND")), translation=[0.5, 0, 1])
    made.node(mesh=made.quad(colored(0, 1, 0, 0.1)), translation=[2, 0, 0])
    got = drawn(made.bytes())
    row = got.rgba[24].astype(int)
    there = np.flatnonzero(row[:, :3].min(1) < 250)
    step = (there[-1] - there[0] + 1) / 3
    red, both, blue, green = (row[int(there[0] + step * k)] for k in (0.25, 0.75, 1.25, 2.5))
    assert red[0] > 100 > red[2] and both[0] > 60 and both[2] > 60
    assert blue[2] > blue[0] > 60 and green[1] > 100 > green[0]
    ids = [got.ids[24, int(there[0] + step * at)] for at in (0.75, 1.25)]
    assert ids == [0, -1]    # what blends does not count


def test_unlit_surfaces_have_their_own_colour_in_every_light():
    base, dot = np.array([0.8, 0.4, 0.1]), np.array([0.5, 0.25, 1.0])
    encoded = np.array([188, 99, 255])    # about linear 0.5, 0.125, 1
    linear = np.where(encoded / 255 <= 0.04045, encoded / 255 / 12.92, ((encoded / 255 + 0.055) / 1.055) ** 2.4)
    wanted = base * dot * linear
    wanted = np.where(wanted <= 0.0031308, 12.92 * wanted, 1.055 * wanted ** (1 / 2.4) - 0.055) * 255
    made = Glb()
    material = colored(*base, emissiveFactor=[1, 1, 1], extensions={"KHR_materials_unlit": {}})
    material["pbrMetallicRoughness"]["baseColorTexture"] = {"index": 0}
    mesh = made.quad(material, [[0, 1], [1, 1], [1, 0], [0, 0]])
    made.json["meshes"][mesh]["primitives"][0]["attributes"]["COLOR_0"] = made.accessor(
        np.array([dot] * 4, "<f4"), "VEC3")
    png = shade.Picture(np.full((4, 4, 4), [*encoded, 255], np.uint8)).png()
    made.json["textures"] = [{"source": 0}]
    made.json["images"] = [{"bufferView": made.view(png), "mimeType": "image/png"}]
    made.node(mesh=mesh)
    made.node(mesh=mesh, translation=[-0.2, -0.2, 0.5], scale=[0.5, 0.5, 1])    # throws a shadow on it
    loaded = shade.load(io.BytesIO(made.bytes()))
    assert [piece.surface.unlit for piece in loaded.pieces if piece.count] == [True]
    scene = shade.Scene([shade.Light.directional((0.5, 0, -1))])
    scene.add(loaded)
    for got in (drawn(made.bytes()), drawn(made.bytes(), light="studio"),
                scene.render("front", ortho=True, size=(64, 48), samples=1, background="white")):
        rgb = got.rgba[..., :3].astype(int)[got.ids >= 0]
        assert len(rgb) > 500 and np.abs(rgb - wanted).max() <= 1
    renderer, ids = shade.Renderer(48, 48), {}
    shape, other = renderer.mesh(loaded), renderer.mesh([[0, 0, 0], [0.4, 0, 0], [0, 0.4, 0]], [[0, 1, 2]])
    ids["unlit"] = renderer.add(shape)
    ids["lit"] = renderer.add(other, at=(1.1, 0, 0), color=(1.0, 1.0, 1.0))
    renderer.light([shade.Light.directional((0, 0.8, -0.6))], shadow=0)
    camera = shade.Camera.look_at((0.6, 0.5, 4), (0.6, 0.5, 0), up=(0, 1, 0))
    seen = renderer.render(camera)
    of = {name: seen.color[seen.ids[..., 0] == k].astype(int) for name, k in ids.items()}
    assert len(of["unlit"]) > 100 and len(of["lit"]) > 10
    assert np.abs(of["unlit"] - wanted).max() <= 1 and abs(of["lit"] - 203).max() <= 1    # sRGB of 0.6


@pytest.mark.parametrize("extensions, front", [
    ({}, 0.04),
    ({"KHR_materials_specular": {"specularFactor": 0.5, "specularColorFactor": [1, 0.5, 0]}}, (0.02, 0.01, 0)),
    ({"KHR_materials_specular": {"specularFactor": 0}}, 0),
    ({"KHR_materials_specular": {"specularColorFactor": [2, 1, 1]}}, (0.08, 0.04, 0.04)),
    ({"KHR_materials_ior": {"ior": 1.0}}, 0),
    ({"KHR_materials_ior": {"ior": 1.4}}, (0.4 / 2.4) ** 2),
    ({"KHR_materials_ior": {"ior": 0}, "KHR_materials_specular": {"specularColorFactor": [0.04, 0, 0]}}, (0.04, 0, 0)),
])
def test_highlights_follow_what_reflects_from_the_front(extensions, front):
    made = Glb()
    material = {"pbrMetallicRoughness": {"metallicFactor": 0, "roughnessFactor": 0.4}, "extensions": extensions}
    made.node(mesh=made.quad(material))
    def specular():
        pieces = shade.load(io.BytesIO(made.bytes())).pieces
        return next(piece.surface.material.specular for piece in pieces if piece.count)
    # the law for 0.04 is 1/4, and less on rough surfaces
    assert specular() == pytest.approx(np.full(3, front) / 0.04 * 0.25 * 0.6 * 0.8, abs=1e-6)
    material["pbrMetallicRoughness"].update(metallicFactor=1, baseColorFactor=[1, 0.5, 0.25, 1])
    assert specular() == pytest.approx(np.array([1, 0.5, 0.25]) * 0.6 * 0.8, abs=1e-6)    # metal has its own
    material["extensions"]["KHR_materials_specular"] = {"specularTexture": {"index": 0}}
    with pytest.warns(UserWarning, match="it has specularTexture, which is not read"):
        specular()


def test_pictures_and_holes_of_glb():
    texels = np.full((2, 2, 4), 255, np.uint8)
    texels[:, :, :3] = [[[255, 0, 0], [0, 255, 0]], [[0, 0, 255], [255, 255, 0]]]
    texels[0, 0, 3] = 0
    png = shade.Picture(np.repeat(np.repeat(texels, 16, 0), 16, 1)).png()
    for mode in ("OPAQUE", "MASK"):
        made = Glb()
        material = colored(1, 1, 1, alphaMode=mode)
        material["pbrMetallicRoughness"]["baseColorTexture"] = {"index": 0}
        made.node(mesh=made.quad(material, [[0, 1], [1, 1], [1, 0], [0, 0]]))
        made.json["textures"] = [{"source": 0}]
        made.json["images"] = [{"bufferView": made.view(png), "mimeType": "image/png"}]
        got = drawn(made.bytes(), size=(48, 48))
        for y, x, wanted in ((12, 36, (0, 1, 0)), (36, 12, (0, 0, 1)), (36, 36, (1, 1, 0))):
            assert np.array_equal(got.rgba[y, x, :3] > 128, np.array(wanted, bool)), (mode, y, x)
        hole = got.rgba[12, 12].tolist() == [255] * 4
        assert hole == (mode == "MASK") and (got.ids[12, 12] == -1) == hole


def test_strips_fans_vertex_colours_and_normalised_integers():
    made = Glb()
    points = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0]], "<f4")
    tint = np.array([[0, 255, 0, 255]] * 4, "<u1")
    made.json["meshes"] = [{"primitives": [{"mode": 5, "attributes": {
        "POSITION": made.accessor(points, "VEC3"),
        "COLOR_0": made.accessor(tint, "VEC4", normalized=True)}}]}, {"primitives": [{
            "mode": 6, "attributes": {"POSITION": made.accessor(
                points[[0, 1, 3, 2]] + np.float32([2, 0, 0]), "VEC3")}}]}]
    made.node(mesh=0)
    made.node(mesh=1)
    got = shade.load(io.BytesIO(made.bytes()))
    p = got.vertices[got.faces]
    area = np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0])[:, 2] / 2
    assert area == pytest.approx([0.5] * 4)
    row = drawn(made.bytes()).rgba[24].astype(int)
    assert (row[:, 1] - row[:, 0]).max() > 100


def test_points_of_gltf_without_faces_are_a_cloud():
    made, points = Glb(), np.array([[x, y, x * y] for x in range(4) for y in range(3)], "<f4")
    bright = [[i % 2, i % 3 > 0, i % 4 < 2] for i in range(12)]
    place = made.accessor(points[:8] - np.float32([1, 2, 4]), "VEC3")
    made.json["meshes"] = [{"primitives": [
        {"mode": 0, "attributes": {"POSITION": place, "COLOR_0": made.accessor(
            np.array(bright[:8], "u1") * 255, "VEC3", normalized=True)}},
        {"mode": 1, "attributes": {"POSITION": place}}]}, {"primitives": [
            {"mode": 0, "material": 0, "indices": made.accessor(np.array([2, 0, 3], "<u2"), "SCALAR"),
             "attributes": {"POSITION": made.accessor(points[8:], "VEC3")}}]}]
    made.json["materials"] = [{"pbrMetallicRoughness": {"baseColorFactor": [0, 1, 1, 1]}}]
    made.node(mesh=0, translation=[1, 2, 4])
    made.node(mesh=1)
    shown, color = points[[*range(8), 10, 8, 11]], 255 * np.array([*bright[:8], *3 * [[0, 1, 1]]])
    with pytest.warns(UserWarning) as told:
        got = drawn(made.bytes(), up="z")
    told = " ".join(str(w.message) for w in told)
    assert "model: its lines (left out)" in told and "model: 11 points have no faces" in told
    with pytest.warns(UserWarning, match="11 points"):
        same = drawn(ply(shown, "ascii", color), up="z")
    assert got == same and len(np.unique(got.rgba.reshape(-1, 4), axis=0)) > 7
    made.json["meshes"][0]["primitives"][0]["mode"] = 2
    made.json["meshes"][1]["primitives"][0]["mode"] = 3
    with pytest.raises(shade.Error, match="lines alone are not drawn"):
        drawn(made.bytes())
    made.json["nodes"][1]["mesh"] = made.quad()
    made.json["meshes"][0]["primitives"][0]["mode"] = 0
    with pytest.warns(UserWarning, match=r"^model: its points and lines \(left out\)$"):
        drawn(made.bytes())


def corners(data):
    """The corners of the triangles that a file shows."""
    got = shade.load(io.BytesIO(data))
    return got.vertices[got.faces]


QUAD = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0.0]])[[0, 1, 2, 0, 2, 3]].reshape(2, 3, 3)


@pytest.mark.parametrize("kind, most", [("<i1", 127), ("<u1", 255), ("<i2", 32767), ("<u2", 65535)])
def test_quantized_positions_are_what_they_stand_for(kind, most):
    for normalized in (True, False):
        made = Glb()
        mesh = made.quad()
        points = np.array([[0, 0, 0, 0], [1, 0, 0, 0], [1, 1, 0, 0], [0, 1, 0, 0]]) * most
        number = made.accessor(points.astype(kind), "VEC3", normalized=normalized)
        made.json["bufferViews"][-1]["byteStride"] = 4 * np.dtype(kind).itemsize
        made.json["meshes"][mesh]["primitives"][0]["attributes"]["POSITION"] = number
        made.json["extensionsRequired"] = ["KHR_mesh_quantization"]
        made.node(mesh=mesh, scale=[1 if normalized else 1 / most] * 3)
        assert np.allclose(corners(made.bytes()), QUAD, atol=1e-6)


def test_skins_and_morph_targets_are_at_rest():
    made = Glb()
    mesh = made.quad()
    part = made.json["meshes"][mesh]["primitives"][0]
    back = np.eye(4)
    back[3, :3] = 0, -5, 0    # undoes a translation by 5 in y
    part["attributes"]["JOINTS_0"] = made.accessor(np.array([[1, 0, 0, 0]] * 4, "<u1"), "VEC4")
    part["attributes"]["WEIGHTS_0"] = made.accessor(np.array([[1, 0, 0, 0]] * 4, "<f4"), "VEC4")
    made.json["skins"] = [{"joints": [1, 2], "inverseBindMatrices": made.accessor(
        np.stack([np.eye(4), back]).astype("<f4").reshape(2, 16), "MAT4")}]
    made.node(mesh=mesh, skin=0, translation=[100, 0, 0])    # which counts for no skin
    made.node(translation=[0, 3, 0], children=[2])
    made.node(translation=[7, 4, 0])
    assert np.allclose(corners(made.bytes()), QUAD + [7, 2, 0], atol=1e-6)
    made = Glb()
    mesh = made.quad()
    moved = made.accessor(np.array([[0, 0, 2]] * 4, "<f4"), "VEC3")
    made.json["meshes"][mesh]["primitives"][0]["targets"] = [{"POSITION": moved}] * 2
    made.json["meshes"][mesh]["weights"] = [0.25, 0.5]
    made.node(mesh=mesh)
    assert np.allclose(corners(made.bytes()), QUAD + [0, 0, 1.5], atol=1e-6)
    quad = made.json["meshes"][mesh]["primitives"][0]
    quad["attributes"].update(COLOR_0=made.accessor(np.ones((4, 4), "<f4"), "VEC4"),
                              TEXCOORD_0=made.accessor(np.zeros((4, 2), "<f4"), "VEC2"))
    quad["targets"][1] = {"COLOR_0": made.accessor(np.array([[-1, 0, -2]] * 4, "<f4"), "VEC3"),
                          "TEXCOORD_0": made.accessor(np.array([[1, 0.5]] * 4, "<f4"), "VEC2")}
    quad["material"] = 0
    made.json["materials"] = [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}]
    made.json["textures"] = [{"source": 0}]
    made.json["images"] = [{"bufferView": made.view(shade.Picture(np.full((1, 1, 4), 255, np.uint8)).png())}]
    found = files._read(made.bytes(), "a.glb", None)[1]
    assert np.allclose(np.asarray(found["color"]), [shown(0.5), 1, 0])
    assert np.allclose(np.asarray(found["uv"]), [0.5, 0.75])
    made.json["nodes"][0]["weights"] = [1, 0]
    assert np.allclose(corners(made.bytes()), QUAD + [0, 0, 2], atol=1e-6)


def test_nodes_that_are_hidden_are_not_drawn():
    made = Glb()
    mesh = made.quad()
    made.node(mesh=mesh, extensions={"KHR_node_visibility": {"visible": True}})
    made.node(mesh=mesh, children=[0], extensions={"KHR_node_visibility": {"visible": False}})
    made.json["extensionsUsed"] = ["KHR_node_visibility"]
    assert np.allclose(corners(made.bytes()), QUAD)


def test_the_bytes_of_glb_are_those_of_its_first_buffer():
    made = Glb()
    made.node(mesh=made.quad())
    made.json["buffers"].append({"byteLength": 48})
    made.json["bufferViews"][0]["buffer"] = 1
    with pytest.raises(shade.Error, match=r"buffers\[1\] has no bytes"):
        shade.load(io.BytesIO(made.bytes()))


def test_instances_and_sparse_accessors():
    made = Glb()
    mesh = made.quad()
    places = np.array([[0, 0, 0], [4, 0, 0], [0, 9, 0]], "<f4")
    made.node(mesh=mesh, scale=[2, 2, 2], extensions={"EXT_mesh_gpu_instancing": {"attributes": {
        "TRANSLATION": made.accessor(places, "VEC3")}}})
    wanted = np.concatenate([2 * QUAD + 2 * place for place in places.astype(float)])
    assert np.allclose(corners(made.bytes()), wanted, atol=1e-5)
    made = Glb()
    mesh = made.quad()
    number = made.json["meshes"][mesh]["primitives"][0]["attributes"]["POSITION"]
    made.json["accessors"][number]["sparse"] = {
        "count": 1, "indices": {"bufferView": made.view(b"\1"), "componentType": 5121},
        "values": {"bufferView": made.view(np.array([3, 0, 0], "<f4").tobytes())}}
    made.node(mesh=mesh)
    wanted = QUAD.copy()
    wanted[0, 1, 0] = 3
    assert np.allclose(corners(made.bytes()), wanted)


@pytest.mark.parametrize("change, uv, wanted", [
    ({"offset": [0, 1], "rotation": np.pi / 2}, (0.25, 0.25), (0, 0, 1)),
    ({"scale": [3, 1]}, (0.25, 0.25), (0, 1, 0)),
    ({"clamp": True}, (1.3, 0.25), (0, 1, 0)),
    ({}, (1.3, 0.25), (1, 0, 0)),
])
def test_where_a_texture_lies(change, uv, wanted):
    texels = np.array([[[255, 0, 0], [0, 255, 0]], [[0, 0, 255], [255, 255, 0]]], np.uint8)
    png = shade.Picture(np.dstack([texels, np.full((2, 2), 255, np.uint8)]).repeat(8, 0)
                        .repeat(8, 1)).png()
    made = Glb()
    material = colored(1, 1, 1)
    material["pbrMetallicRoughness"]["baseColorTexture"] = {
        "index": 0, "extensions": {"KHR_texture_transform": {
            k: v for k, v in change.items() if k != "clamp"}}}
    made.node(mesh=made.quad(material, [uv] * 4))
    made.json["samplers"] = [{"wrapS": 33071 if "clamp" in change else 10497}]
    made.json["textures"] = [{"source": 0, "sampler": 0}]
    made.json["images"] = [{"bufferView": made.view(png)}]
    middle = drawn(made.bytes()).rgba[24, 32, :3]
    assert np.array_equal(middle > 100, np.array(wanted, bool)), middle


def test_specular_glossiness_and_what_is_not_read():
    made = Glb()
    made.node(mesh=made.quad({"extensions": {"KHR_materials_pbrSpecularGlossiness": {
        "diffuseFactor": [0, 0, 1, 1], "glossinessFactor": 0.1}}}))
    middle = drawn(made.bytes()).rgba[24, 32].astype(int)
    assert middle[2] > 100 > middle[0]
    gold = [1, 0.7, 0.2]
    made.json["materials"][0] = {"pbrMetallicRoughness": {"baseColorFactor": [*gold, 1], "roughnessFactor": 0.4}}
    wanted = drawn(made.bytes()).rgba
    made.json["materials"][0] = {"extensions": {"KHR_materials_pbrSpecularGlossiness": {
        "diffuseFactor": [0, 0, 0, 1], "specularFactor": gold, "glossinessFactor": 0.6}}}
    assert np.array_equal(drawn(made.bytes()).rgba, wanted)
    made.json["materials"][0]["extensions"]["KHR_materials_pbrSpecularGlossiness"][
        "specularGlossinessTexture"] = {"index": 0}
    with pytest.warns(UserWarning, match="it has specularGlossinessTexture, which is not read"):
        drawn(made.bytes())
    made.json["extensionsRequired"] = ["EXT_made_up"]
    with pytest.raises(shade.Error, match="it needs EXT_made_up, which is not read"):
        shade.load(io.BytesIO(made.bytes()))
    made.json["extensionsRequired"] = []
    made.json["textures"] = [{"extensions": {"EXT_texture_webp": {"source": 0}}}, {}]
    made.json["materials"][0] = {"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}
    with pytest.warns(UserWarning, match="EXT_texture_webp"):
        assert not drawn(made.bytes()).blank
    made.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["index"] = 1
    assert not drawn(made.bytes()).blank


# ---- 3MF -----------------------------------------------------------------------------------------

CORE = "http://schemas.microsoft.com/3dmanufacturing/core/2015/02"


def mesh_xml(vertices, faces, marks=None):
    points = "".join(f'<vertex x="{x!r}" y="{y!r}" z="{z!r}"/>' for x, y, z in vertices.tolist())
    told = marks or [""] * len(faces)
    triangles = "".join(f'<triangle v1="{a}" v2="{b}" v3="{c}" {mark}/>'
                        for (a, b, c), mark in zip(faces.tolist(), told))
    return f"<mesh><vertices>{points}</vertices><triangles>{triangles}</triangles></mesh>"


def threemf(resources, items, head="", more=None, method=zipfile.ZIP_DEFLATED):
    memory = io.BytesIO()
    with zipfile.ZipFile(memory, "w", method) as archive:
        archive.writestr("_rels/.rels", '<Relationships xmlns="http://schemas.openxmlformats.org/'
                         'package/2006/relationships"><Relationship Target="/3D/3dmodel.model" '
                         'Id="r" Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/'
                         '3dmodel"/></Relationships>')
        archive.writestr(
            "3D/3dmodel.model",
            f'<?xml version="1.0"?>{head}<model unit="millimeter" xmlns="{CORE}" xmlns:p='
            '"http://schemas.microsoft.com/3dmanufacturing/production/2015/06" '
            'xmlns:m="http://schemas.microsoft.com/3dmanufacturing/material/2015/02">'
            f"<resources>{resources}</resources><build>{items}</build></model>")
        for name, data in (more or {}).items():
            archive.writestr(name, data)
    return memory.getvalue()


def plate():
    vertices, faces = box(1, 1, 1)
    return vertices, faces[:, [0, 1, 2, 0, 2, 3]].reshape(-1, 3)


def test_instances_components_and_colours_of_3mf():
    marks = ['pid="9" p1="1"'] * 12
    data = threemf(
        '<basematerials id="9"><base name="a" displaycolor="#FF0000"/>'
        '<base name="b" displaycolor="#0000FFFF"/></basematerials>'
        f'<object id="1" pid="9" pindex="0">{mesh_xml(*plate())}</object>'
        f'<object id="2">{mesh_xml(*plate(), marks)}</object>'
        '<object id="3"><components><component objectid="1"/><component objectid="2" '
        'transform="1 0 0 0 1 0 0 0 1 2 0 0"/></components></object>',
        '<item objectid="3"/><item objectid="1" transform="2 0 0 0 1 0 0 0 -1 4 0 1"/>')
    got = shade.load(io.BytesIO(data))
    assert got.up == "z" and len(got.faces) == 36
    assert np.array_equal(got.vertices.min(0), [0, 0, 0])
    assert np.array_equal(got.vertices.max(0), [6, 1, 1])
    p = got.vertices[got.faces]
    volume = (p[:, 0] * np.cross(p[:, 1], p[:, 2])).sum() / 6
    assert abs(volume) == pytest.approx(4)    # mirrored ones have not changed sides
    row = drawn(data).rgba[24].astype(int)
    there = np.flatnonzero(row[:, :3].min(1) < 250)
    step = (there[-1] - there[0] + 1) / 6
    for at, channel in ((0.5, 0), (2.5, 2), (5, 0)):
        color = row[int(there[0] + step * at)]
        assert color[channel] > 100 > color[2 - channel]


def test_models_of_3mf_in_several_files():
    vertices, faces = plate()
    other = f'<model xmlns="{CORE}"><resources><object id="7">{mesh_xml(vertices, faces)}' \
        "</object></resources></model>"
    data = threemf('<object id="1"><components><component p:path="/3D/Objects/a.model" '
                   'objectid="7"/></components></object>', '<item objectid="1"/>',
                   more={"3D/Objects/a.model": other})
    assert len(shade.load(io.BytesIO(data)).faces) == 12


def corners_of(resources, mark, more=None, items='<item objectid="1"/>', later=""):
    """Colours of the corners of a triangle that has a mark, and what is said of it."""
    mesh = mesh_xml(np.eye(3), np.array([[0, 1, 2]]), [mark])
    data = threemf(f'{resources}<object id="1">{mesh}</object>{later}', items, more=more)
    with warnings.catch_warnings(record=True) as said:
        warnings.simplefilter("always")
        (vertices, faces), found = files._read(data, "a.3mf", None)
    assert np.array_equal(vertices[faces], [np.eye(3)])
    return found, [str(w.message) for w in said], faces[0]


COLORS = '<basematerials id="1"><base name="a" displaycolor="#FF0000"/><base name="b" ' \
    'displaycolor="#0000FF"/></basematerials><m:colorgroup id="2"><m:color color="#00FF00"/>' \
    '<m:color color="#FFFFFF80"/><m:color color="#808080"/></m:colorgroup>'


def light(display):
    """Linear light of one value of a display."""
    return display / 12.92 if display <= 0.04045 else ((display + 0.055) / 1.055) ** 2.4


def shown(linear):
    """The opposite."""
    return 12.92 * linear if linear <= 0.0031308 else 1.055 * linear ** (1 / 2.4) - 0.055


@pytest.mark.parametrize("more, mark, wanted", [
    ("", 'pid="1" p1="1"', [(0, 0, 1)] * 3),
    ("", 'pid="2" p1="0" p2="2" p3="0"', [(0, 1, 0), (128 / 255,) * 3, (0, 1, 0)]),
    ('<m:compositematerials id="3" matid="1" matindices="0 1"><m:composite values="3 1"/>'
     "</m:compositematerials>", 'pid="3" p1="0"', [(shown(0.75), 0, shown(0.25))] * 3),
    ('<m:multiproperties id="4" pids="1 2"><m:multi pindices="0 1"/></m:multiproperties>',
     'pid="4" p1="0"', [(1, shown(128 / 255), shown(128 / 255))] * 3),
    ('<m:multiproperties id="4" pids="1 2" blendmethods="multiply"><m:multi pindices="0 2"/>'
     "</m:multiproperties>", 'pid="4" p1="0"', [(128 / 255, 0, 0)] * 3)])
def test_properties_of_3mf(more, mark, wanted):
    found, said, face = corners_of(COLORS + more, mark)
    assert not said
    assert np.asarray(found["color"])[face] == pytest.approx(np.array(wanted), abs=2e-6)
    assert light(128 / 255) == pytest.approx(0.21586, abs=1e-5)


def test_a_texture_of_3mf_lies_with_v_upward():
    red = np.array([[[255, 0, 0, 255]], [[0, 0, 255, 255]]], np.uint8)    # above blue
    texture = '<m:texture2d id="5" path="/3D/a.png" contenttype="image/png" tilestyleu="clamp"/>' \
        '<m:texture2dgroup id="6" texid="5"><m:tex2coord u="0.5" v="0.75"/></m:texture2dgroup>'
    found, said, face = corners_of(texture, 'pid="6" p1="0"', {"3D/a.png": shade.Picture(red).png()})
    numbers, looks = found["surfaces"]
    assert not said and np.array_equal(looks[numbers[0]].texture, red)
    assert looks[numbers[0]].wrap == ("clamp", "repeat")
    assert np.asarray(found["uv"])[face] == pytest.approx(np.array([[0.5, 0.75]] * 3))
    near = texture.replace("path", 'filter="nearest" path')
    said = corners_of(near, 'pid="6" p1="0"', {"3D/a.png": shade.Picture(red).png()})[1]
    assert "it has filter nearest, which is not read" in said[0]
    found, said, face = corners_of(texture, 'pid="6" p1="0"')
    assert "3D/a.png: it is not in the archive" in said[0]
    assert all(look.texture is None for look in found["surfaces"][1])


def test_what_3mf_has_beyond_is_told_or_refused_by_name():
    assert "it has paint_color, which is not read" in corners_of("", 'paint_color="4"')[1][0]
    assert "colours by numbers that it does not have" in corners_of(COLORS, 'pid="9" p1="1"')[1][0]
    mesh = mesh_xml(*plate())
    lattice = "http://schemas.microsoft.com/3dmanufacturing/beamlattice/2017/02"
    for change, words in (
            ("requiredextensions", f"it needs {lattice}, which is not read"),
            ("recommendedextensions", None)):
        text = threemf(f'<object id="1">{mesh}</object>', '<item objectid="1"/>',
                       method=zipfile.ZIP_STORED, head="")
        named = f'xmlns:b="{lattice}" {change}="b"'
        data = rezipped(text, lambda t, named=named: t.replace(b"<model ", b"<model " + named.encode() + b" "))
        if words:
            with pytest.raises(shade.Error, match=re.escape(words)):
                shade.load(io.BytesIO(data))
        else:
            assert len(shade.load(io.BytesIO(data)).faces) == 12


PARTS = "a.3mf: it has negative parts or modifiers, which are drawn like others"
EXTRUDERS = "a.3mf: the colours of its extruders do not count"


@pytest.mark.parametrize("name, text, told", [
    ("Slic3r_PE_model", '<metadata key="volume_type" value="NegativeVolume"/>', PARTS),
    ("Slic3r_PE_model", '<metadata key="volume_type" value="ModelPart"/>', ""),
    ("Slic3r_PE_model", '<metadata type="object" key="extruder" value="2"/>', EXTRUDERS),
    ("model_settings", '<part id="2" subtype="modifier_part"/>', PARTS),
    ("model_settings", '<metadata key="extruder" value="12"/>', EXTRUDERS),
    ("model_settings", '<part id="2" subtype="normal_part"/><metadata key="extruder" value="1"/>', "")])
def test_parts_of_slicers_that_are_no_plain_ones_are_told(name, text, told):
    more = {f"Metadata/{name}.config": f"<config>{text}</config>"}
    said = corners_of("", "", more)[1]
    assert said == ([told] if told else [])


@pytest.mark.parametrize("more, told", [
    ('type="support"', "it has type support, which is not read"),
    ('type="solidsupport"', "it has type solidsupport, which is not read"),
    ('type="other"', "it has type other, which is not read")])
def test_supports_of_3mf_are_told_and_not_drawn(more, told):
    """As an object, as a part of one, and alone."""
    support = f'<object id="2" {more}>{mesh_xml(np.eye(3) + 9, np.array([[0, 1, 2]]))}</object>'
    whole = '<object id="3"><components><component objectid="1"/><component objectid="2"/></components></object>'
    for items in ('<item objectid="1"/><item objectid="2"/>', '<item objectid="3"/>'):
        found, said, face = corners_of(support, "", items=items, later=whole)
        assert len(said) == 1 and told in said[0]
    with pytest.raises(shade.Error, match="no faces in it, but " + told[7:]):
        shade.load(io.BytesIO(threemf(support, '<item objectid="2"/>')))


def test_objects_of_3mf_that_are_not_printed_are_drawn_and_told():
    assert not corners_of("", "", items='<item objectid="1" printable="1"/>')[1]
    told = corners_of("", "", items='<item objectid="1" printable="0"/>')[1]
    assert told == ["a.3mf: it has objects that are not printed, drawn like others"]


def test_names_of_3mf_may_have_percent_signs():
    red = shade.Picture(np.full((1, 1, 4), 255, np.uint8)).png()
    texture = '<m:texture2d id="5" path="/3D/a%20%c3%bc.png" contenttype="image/png"/>' \
        '<m:texture2dgroup id="6" texid="5"><m:tex2coord u="0" v="0"/></m:texture2dgroup>'
    for name in ("3D/a \u00fc.png", "3D/a%20%c3%bc.png"):
        found, said, _ = corners_of(texture, 'pid="6" p1="0"', {name: red})
        assert not said and found["surfaces"][1][-1].texture is not None


def test_colours_of_3mf_that_no_group_has_are_told():
    assert "colours by numbers that it does not have" in corners_of("", 'pid="9" p1="0"')[1][0]


def rezipped(data, change):
    """An archive whose models are changed."""
    memory = io.BytesIO()
    with zipfile.ZipFile(io.BytesIO(data)) as old, zipfile.ZipFile(memory, "w") as new:
        for name in old.namelist():
            text = old.read(name)
            new.writestr(name, change(text) if name.endswith(".model") else text)
    return memory.getvalue()


def test_units_of_parts_in_other_files():
    vertices, faces = plate()
    other = f'<model xmlns="{CORE}" unit="inch"><resources><object id="7">' \
        f"{mesh_xml(vertices, faces)}</object></resources></model>"
    data = threemf("", '<item p:path="/3D/a.model" objectid="7" transform="1 0 0 0 1 0 0 0 1 5 0 0"/>',
                   more={"3D/a.model": other})
    got = shade.load(io.BytesIO(data)).vertices
    assert got.min(0) == pytest.approx([5, 0, 0]) and got.max(0) == pytest.approx([30.4, 25.4, 25.4])


def test_two_meshes_of_one_object_count_their_own_vertices():
    """As assimp writes them."""
    both = mesh_xml(np.eye(3), np.array([[0, 1, 2]])) + mesh_xml(np.eye(3) + 5, np.array([[2, 1, 0]]))
    got = shade.load(io.BytesIO(threemf(f'<object id="1">{both}</object>', '<item objectid="1"/>')))
    assert np.array_equal(got.vertices[got.faces], [np.eye(3), np.eye(3)[::-1] + 5])


@pytest.mark.parametrize("change, words", [
    (lambda t: t.replace(b"</mesh>", b"</mash>"), "its XML is wrong"),
    (lambda t: t.replace(b'unit="millimeter"', b'unit="ell"'), "unit of model is none of 3MF"),
    (lambda t: t.replace(b'v1="0"', b'v1="99"'), "a vertex that is not there"),
    (lambda t: t.replace(b'objectid="1"', b'objectid="2"'), "there is no object 2"),
    (lambda t: t.replace(b"<triangle ", b"<zebra "), "no faces in it, but zebra, which is not read"),
    (lambda t: t + b"<model/>", "its XML is wrong")])
def test_damaged_3mf_is_refused(change, words):
    data = threemf(f'<object id="1">{mesh_xml(*plate())}</object>', '<item objectid="1"/>')
    with pytest.raises(shade.Error, match=words):
        shade.load(io.BytesIO(rezipped(data, change)))


@pytest.mark.parametrize("change, words", [
    (lambda t: t.decode().encode("utf-16"), None),
    (lambda t: b"\xfe\xff" + t.decode().encode("utf-16-be"), None),
    (lambda t: re.sub(b' xmlns="[^"]*"', b"", t), "no name space: they count as those of 3MF"),
    (lambda t: t.replace(b"#FF0000", b"#FG0000"), '"#FG0000" is no colour: it counts as white')])
def test_3mf_of_other_writers_is_drawn(change, words):
    """UTF-16, no name space, a colour that is none: the geometry is whole, and what is odd is told."""
    colors = '<m:colorgroup id="5"><m:color color="#FF0000"/></m:colorgroup>'
    data = threemf(f'{colors}<object name="\U0001f9c0 \u00e4" id="1" pid="5" pindex="0">{mesh_xml(*plate())}'
                   "</object>", '<item objectid="1"/>')
    with warnings.catch_warnings(record=True) as said:
        warnings.simplefilter("always")
        got = shade.load(io.BytesIO(rezipped(data, change)))
    want = shade.load(io.BytesIO(data))
    assert (got.vertices[got.faces] == want.vertices[want.faces]).all()
    assert (words is None and not said) or (words and words in str(said[0].message))


# ---- bombs, and anything -------------------------------------------------------------------------

def bombs():
    vertices, faces = plate()
    mesh = f'<object id="0">{mesh_xml(vertices, faces)}</object>'
    nested = "".join(f'<object id="{i}"><components>' + f'<component objectid="{i - 1}"/>' * 10 +
                     "</components></object>" for i in range(1, 12))
    laughs = '<!DOCTYPE m [<!ENTITY a "ha">' + "".join(
        f'<!ENTITY {b} "{f"&{a};" * 10}">' for a, b in zip("abcdefgh", "bcdefghi")) + "]>"
    yield "instances", threemf(mesh + nested, '<item objectid="11"/>')
    yield "circle", threemf('<object id="1"><components><component objectid="1"/></components>'
                            "</object>", '<item objectid="1"/>')
    yield "laughs", threemf(mesh + "<object id='2'>&i;</object>", '<item objectid="0"/>', laughs)
    yield "spaces", threemf(mesh + " " * 200_000_000, '<item objectid="0"/>')
    made = Glb()
    made.quad()
    for i in range(40):
        made.node(children=[i + 1, i + 1])
    made.node(mesh=0)
    yield "tree", made.bytes()
    made = Glb()
    made.json["meshes"] = [{"primitives": [{"attributes": {"POSITION": 0}}]}]
    made.json["accessors"] = [{"count": 2**31, "componentType": 5126, "type": "VEC3"}]
    made.node(mesh=0)
    yield "accessor", made.bytes()
    made.json["nodes"] = [{"children": [0]}]
    yield "ring", made.bytes()
    yield "deep", b"glTF" + struct.pack("<IIII", 2, 200_020, 200_000, 0x4E4F534A) + b"[" * 200_000


@pytest.mark.parametrize("name", ["instances", "circle", "laughs", "spaces", "tree", "accessor",
                                  "ring", "deep"])
def test_bombs_are_refused_in_little_memory(name, tmp_path):
    (tmp_path / "bomb").write_bytes(dict(bombs())[name])
    program = "import resource, sys, shade_h\n" \
        "resource.setrlimit(resource.RLIMIT_AS, (3 << 30, 3 << 30))\n" \
        "before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss\n" \
        "try: shade_h.load(sys.argv[1])\n" \
        "except ValueError as why: print(why)\n" \
        "grown = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before\n" \
        "assert grown < 600_000, grown\n"
    done = subprocess.run([sys.executable, "-c", program, tmp_path / "bomb"], check=True,
                          stdout=subprocess.PIPE, text=True)
    assert len(done.stdout.strip()) > 20


def good_files():
    made = Glb()
    material = colored(1, 0.5, 0.5, 0.5, alphaMode="MASK", alphaCutoff=0.3)
    material["pbrMetallicRoughness"]["baseColorTexture"] = {"index": 0}
    made.node(mesh=made.quad(material, [[0, 1], [1, 1], [1, 0], [0, 0]]))
    made.node(mesh=0, rotation=[0, 0, 0, 1], scale=[1, 2, 3], children=[])
    made.json["textures"] = [{"source": 0}]
    made.json["images"] = [{"bufferView": made.view(
        shade.Picture(np.full((4, 4, 4), 200, np.uint8)).png())}]
    vertices, faces = plate()
    inside = '<basematerials id="9"><base displaycolor="#FF0000"/></basematerials>' \
        f'<object id="1" pid="9" pindex="0">{mesh_xml(vertices, faces)}</object>' \
        '<object id="3"><components><component objectid="1" transform="1 0 0 0 1 0 0 0 1 2 0 0"/>' \
        "</components></object>"
    obj = "".join(f"v {x} {y} {z}\n" for x, y, z in vertices.tolist()) + \
        "vt 0 1\nvn 0 0 1\n" + "".join(f"f {a}/1/1 {b}/1/1 {c}/1/1\n"
                                       for a, b, c in (faces + 1).tolist())
    corner = np.asarray(vertices, "<f4")[faces]
    stl = bytes(80) + struct.pack("<I", 12) + b"".join(bytes(12) + t.tobytes() + b"\0\0"
                                                       for t in corner)
    glb = made.bytes()
    size = struct.unpack_from("<I", glb, 12)[0]

    def archive(text):
        return threemf(text.decode("latin-1"), '<item objectid="3"/>')

    def rejoined(text):
        head = struct.pack("<IIIII", 0x46546C67, 2, len(glb) - size + len(text), len(text),
                           0x4E4F534A)
        return head + text + glb[20 + size:]

    # what is changed, and how a file is made of it: text within containers is changed too
    return [(glb, bytes), (archive(inside.encode()), bytes), (inside.encode(), archive),
            (glb[20:20 + size], rejoined), (obj.encode(), bytes), (stl, bytes)]


WORDS = [b"0", b"-1", b"1e999", b"4294967296", b'""', b"[]", b"{}", b"null", b"NaN", b"\xff\xfe",
         b"<", b"&", b"\0\0\0\0", b"\xff\xff\xff\xff", b"9" * 30]


@pytest.mark.parametrize("seed", range(6))
@pytest.mark.filterwarnings("ignore")
def test_mutants_of_good_files_are_drawn_or_refused(seed):
    random, drawn_ones, refused = np.random.default_rng(seed), 0, 0
    files = good_files()
    for data, whole in files:
        assert not drawn(whole(data), size=(16, 12), view="iso").blank
    for _ in range(200):
        text, whole = files[random.integers(len(files))]
        data = bytearray(text)
        for _ in range(random.integers(1, 3)):
            at, kind = int(random.integers(len(data))), random.integers(5)
            if kind == 0:
                data[at] = random.integers(256)
            elif kind == 1:
                del data[at:at + int(random.integers(1, 40))]
            elif kind == 2:
                word = WORDS[random.integers(len(WORDS))]
                data[at:at + len(word)] = word
            elif kind == 3:
                other = int(random.integers(len(data)))
                data[at:at] = data[other:other + 20]
            else:    # a number of the text becomes another
                digits = [i for i in range(at, min(at + 200, len(data))) if 48 <= data[i] <= 57]
                if digits:
                    data[digits[0]:digits[0] + 1] = WORDS[random.integers(5)]
            data = data or bytearray(b" ")
        try:
            with np.errstate(all="ignore"):
                drawn(whole(bytes(data)), size=(16, 12), view="iso")
            drawn_ones += 1
        except shade.Error as why:
            assert len(str(why)) > 8
            refused += 1
    assert refused > 40 and drawn_ones > 8


def test_the_picture_of_trimesh_is_multiplied_by_its_factor():
    white = np.full((4, 4, 3), 255, np.uint8)
    material = SimpleNamespace(baseColorTexture=white, image=None,
                               baseColorFactor=np.array([255, 0, 0, 255], np.uint8))
    visual = SimpleNamespace(kind="texture", material=material, uv=np.zeros((4, 2)))
    points = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0.0]])
    mesh = SimpleNamespace(vertices=points, faces=np.array([[0, 1, 2], [0, 2, 3]]), visual=visual)
    middle = shade.render(mesh, up="y", **FLAT).rgba[24, 32].astype(int)
    assert middle[0] > 100 > middle[1]
    del material.baseColorFactor
    middle = shade.render(mesh, up="y", **FLAT).rgba[24, 32].astype(int)
    assert middle[1] > 100


def test_what_is_asked_for_takes_the_place_of_the_colours_of_a_file(tmp_path):
    """A colour and a material alike, of MTL, vertices and textures."""
    square = "v -1 0 -1{c}\nv 1 0 -1{c}\nv 1 0 1{c}\nv -1 0 1{c}\n"
    (tmp_path / "red.mtl").write_text("newmtl red\nKd 1 0 0\n")
    for name, text in (("bare", square.format(c="")), ("scan", square.format(c=" 1 0 0")),
                       ("kd", "mtllib red.mtl\nusemtl red\n" + square.format(c=""))):
        (tmp_path / f"{name}.obj").write_text(text + "f 1 2 3 4\n")
    for asked in ({"color": "#8090A0"}, {"material": "gold"}):
        bare, scan, kd = (shade.render(tmp_path / f"{name}.obj", up="z", **FLAT, **asked).rgba
                          for name in ("bare", "scan", "kd"))
        assert (scan == bare).all() and (kd == bare).all(), asked
    bare, scan, kd = (shade.render(tmp_path / f"{name}.obj", up="z", **FLAT).rgba.astype(int)
                      for name in ("bare", "scan", "kd"))
    assert np.abs(scan - kd).max() <= 20 and np.abs(scan - bare).max() > 60
