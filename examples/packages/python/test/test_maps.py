"""Normal, bump and emissive maps, and what a picture of metal and roughness says, against squares
whose normals, light and factors are given outright."""
import io
import pickle
import warnings

import numpy as np
import pytest
from test_formats import Glb, colored

import shade_h as shade
from shade_h import section

CORNERS = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0.0]])
FACES, UV = [[0, 1, 2], [0, 2, 3]], CORNERS[:, :2]
MATTE = shade.Material((0, 0, 0), (0.6, 0.6, 0.6), (0.6, 0.6, 0.6), (0.3, 0.3, 0.3), 20)
LAMPS = [shade.Light.directional((-0.4, -0.3, -1.0)), shade.Light.directional((0.7, 0.1, -0.3), (0.4, 0.5, 0.6))]


def square(colors=None, **surface):
    """A unit square, u to the right and v upward."""
    surface.setdefault("material", MATTE)
    return shade.Mesh(CORNERS, FACES, uv=UV, normals="flat", color=colors,
                      surfaces=([0, 0], [shade.Surface(**surface)]))


def seen(mesh, pose=None, lamps=(), light="scene", **options):
    scene = shade.Scene(list(lamps), **options)
    scene.add(mesh, pose)
    camera = shade.Camera.look_at((0.4, 0.3, 4), (0.4, 0.5, 0), fov=20)
    return scene.render(camera, (48, 48), samples=1, light=light)


def inner(picture):
    """The pixels of the square, without its edges."""
    there = picture.ids >= 0
    for axis in (0, 1):
        there &= np.roll(there, 2, axis) & np.roll(there, -2, axis)
    assert there.sum() > 150
    return picture.rgba[there][:, :3].astype(int)


def turned(matrix):
    pose = np.eye(4)
    pose[:3, :3] = matrix
    return pose


def about(axis, degrees):
    a, b = [i for i in range(3) if i != axis]
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    out = np.eye(3)
    out[[a, a, b, b], [a, b, a, b]] = c, -s, s, c
    return out


@pytest.mark.parametrize("light", ["scene", "studio"])
@pytest.mark.parametrize("matrix", [np.eye(3), about(2, 90) @ about(0, -30), about(1, 25) * 0.7,
                                    np.diag([0.5, 1, 2]) @ about(2, 30)])
@pytest.mark.parametrize("way", [(0.5, 0.0, 0.8), (0.0, 0.5, 0.8), (-0.4, 0.3, 0.8)])
def test_a_normal_map_of_one_colour_is_a_square_with_that_normal(way, matrix, light):
    texel = np.round((np.array(way) / np.linalg.norm(way) + 1) / 2 * 255)
    normal = texel / 255 * 2 - 1
    told = shade.Mesh(CORNERS, FACES, normals=np.tile(normal, (4, 1)),
                      surfaces=([0, 0], [shade.Surface(MATTE)]))
    bent = square(relief=np.full((4, 4, 3), texel, np.uint8))
    a, b = (seen(mesh, turned(matrix), LAMPS, light) for mesh in (bent, told))
    assert np.abs(inner(a) - inner(b)).max() <= 1
    flat = seen(square(), turned(matrix), LAMPS, light)
    assert np.abs(inner(a) - inner(flat)).max() > 5
    # the notes are of the surface, not of its relief
    assert np.array_equal(a.depth, flat.depth) and np.array_equal(a.ids, flat.ids)
    assert np.abs(a.normals - flat.normals).max() < 1e-6


def test_strength_is_a_factor_of_the_slopes():
    texel = np.round((np.array([0.3, 0.0, 0.954]) + 1) / 2 * 255)
    n = texel / 255 * 2 - 1
    normal = np.array([2 * n[0], 2 * n[1], n[2]])
    told = shade.Mesh(CORNERS, FACES, normals=np.tile(normal / np.linalg.norm(normal), (4, 1)),
                      surfaces=([0, 0], [shade.Surface(MATTE)]))
    bent = square(relief=np.full((4, 4, 3), texel, np.uint8), strength=2)
    assert np.abs(inner(seen(bent, None, LAMPS)) - inner(seen(told, None, LAMPS))).max() <= 1


@pytest.mark.parametrize("high", [0.1, 0.4])
def test_a_ramp_of_heights_leans_as_a_ramp_does(high):
    ramp = np.tile(np.arange(256, dtype=np.uint8)[None, :, None], (8, 1, 3))
    normal = np.array([-high * 256 / 255, 0, 1])    # white is high over black, a width apart
    told = shade.Mesh(CORNERS, FACES, normals=np.tile(normal / np.linalg.norm(normal), (4, 1)),
                      surfaces=([0, 0], [shade.Surface(MATTE)]))
    bent = square(relief=ramp, strength=high, wrap=("clamp", "clamp"))
    assert np.abs(inner(seen(bent, None, LAMPS)) - inner(seen(told, None, LAMPS))).max() <= 1


def test_what_glows_needs_no_lamp_and_takes_no_colour_of_the_map():
    glow = np.full((4, 4, 3), (200, 100, 50), np.uint8)
    linear = ((glow[0, 0] / 255 + 0.055) / 1.055) ** 2.4
    light = linear * (0.5, 1, 2)
    wanted = 255 * (1.055 * light ** (1 / 2.4) - 0.055)
    dark = np.zeros((2, 2, 3), np.uint8)
    for texture in (None, dark):
        got = seen(square(glow=glow, glow_factor=(0.5, 1, 2), texture=texture))
        assert np.abs(inner(got) - wanted).max() <= 1
    shines = square(material=shade.Material((0.2, 0.3, 0.4), (0, 0, 0), (0.5, 0.5, 0.5)), texture=dark)
    wanted = 255 * (1.055 * np.array((0.2, 0.3, 0.4)) ** (1 / 2.4) - 0.055)
    assert np.abs(inner(seen(shines)) - wanted).max() <= 1


def file_of(change, sampler=None, **pictures):
    """A GLB of a square whose material has pictures of one colour each."""
    made = Glb()
    material = colored(0.8, 0.5, 0.3, doubleSided=True)
    made.json["textures"], made.json["images"], made.json["samplers"] = [], [], [sampler or {}]
    for name, texel in pictures.items():
        png = shade.Picture(np.full((8, 8, 4), (*texel, 255), np.uint8)).png()
        made.json["images"].append({"bufferView": made.view(png), "mimeType": "image/png"})
        made.json["textures"].append({"source": len(made.json["images"]) - 1, "sampler": 0})
        place = material["pbrMetallicRoughness"] if name in ("metallicRoughnessTexture",
                                                              "baseColorTexture") else material
        place[name] = {"index": len(made.json["textures"]) - 1}
    change(material)
    made.node(mesh=made.quad(material, [[0, 1], [1, 1], [1, 0], [0, 0]]))
    return shade.load(io.BytesIO(made.bytes()))


def pixels(mesh, light="studio"):
    return shade.render(mesh, view="iso", size=(48, 48), samples=1, light=light).rgba


@pytest.mark.parametrize("green, blue", [(128, 255), (51, 0), (204, 102)])
def test_a_picture_of_metal_and_roughness_is_a_factor_of_both(green, blue):
    def factors(rough, metal):
        return lambda m: m["pbrMetallicRoughness"].update(roughnessFactor=rough, metallicFactor=metal)

    told = pixels(file_of(factors(0.9 * green / 255, 0.8 * blue / 255)))
    shown = pixels(file_of(factors(0.9, 0.8), metallicRoughnessTexture=(0, green, blue)))
    assert np.abs(told.astype(int) - shown).max() <= 1
    whole = pixels(file_of(factors(0.9, 0.8)))
    assert np.abs(told.astype(int) - whole).max() > 3


def test_a_file_shows_its_normal_map_and_what_shines_in_it():
    plain = file_of(lambda m: None)
    bent = file_of(lambda m: m["normalTexture"].update(scale=0.5), normalTexture=(190, 128, 230))
    surface = bent.pieces[-1].surface
    assert surface.strength == pytest.approx(0.5)
    assert np.array_equal(np.asarray(surface.relief)[0, 0, :3], (190, 128, 230))
    assert np.abs(pixels(bent).astype(int) - pixels(plain)).max() > 5
    lit = file_of(lambda m: m.update(emissiveFactor=[1, 0.5, 0.25]), emissiveTexture=(255, 128, 64))
    surface = lit.pieces[-1].surface
    assert surface.glow_factor == pytest.approx((1, 0.5, 0.25))
    assert np.array_equal(np.asarray(surface.glow)[0, 0, :3], (255, 128, 64))
    assert pixels(lit)[24, 24, 0] > pixels(plain)[24, 24, 0]


def test_what_shines_by_a_factor_alone_is_not_darkened_by_the_map():
    lit = file_of(lambda m: m.update(emissiveFactor=[0.5, 0, 0]), baseColorTexture=(0, 0, 0))
    assert lit.pieces[-1].surface.material.emission == pytest.approx((0.5, 0, 0))
    got = pixels(lit, "quick")[24, 24]
    assert got[0] > 180


def test_bump_and_emissive_maps_of_obj(tmp_path):
    ramp = np.tile(np.arange(0, 256, 4, dtype=np.uint8)[None, :, None], (64, 1, 3))
    for name, picture in (("high.png", ramp), ("glow.png", np.full((8, 8, 3), (0, 255, 0), np.uint8))):
        rgba = np.full((*picture.shape[:2], 4), 255, np.uint8)
        rgba[:, :, :3] = picture
        shade.Picture(rgba).save(tmp_path / name)
    (tmp_path / "a.mtl").write_text("newmtl m\nKd .5 .5 .5\nmap_bump -bm 0.3 high.png\nKe 1 .5 1\nmap_Ke glow.png\n")
    (tmp_path / "a.obj").write_text("mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
                                    "usemtl m\nf 1/1 2/2 3/3 4/4\n")
    got = shade.load(tmp_path / "a.obj")
    surface = got.pieces[-1].surface
    assert surface.strength == pytest.approx(0.3) and got.pieces[-1].heights
    assert surface.glow_factor == pytest.approx((1, ((0.5 + 0.055) / 1.055) ** 2.4, 1))    # of a display
    green = inner(seen(got))
    assert np.abs(green - (0, 127.5, 0)).max() <= 1


def test_what_is_wrong_is_refused():
    with pytest.raises(shade.Error, match="relief must have the shape"):
        square(relief=np.zeros((4, 4)))
    with pytest.raises(shade.Error, match="uv is missing"):
        shade.Mesh(CORNERS, FACES, surfaces=([0, 0], [shade.Surface(glow=np.zeros((2, 2, 3)))]))
    for wrong in (dict(relief=np.zeros((2, 2, 3)), strength=np.inf),
                  dict(glow=np.zeros((2, 2, 3)), glow_factor=(1, 1)),
                  dict(glow=np.zeros((2, 2, 3)), glow_factor=(1, np.nan, 1))):
        with pytest.raises(shade.Error, match="strength|glow_factor"):
            seen(square(**wrong))


def test_a_section_keeps_the_maps():
    bent = square(relief=np.full((4, 4, 3), (190, 128, 230), np.uint8),
                  glow=np.full((2, 2, 3), (0, 0, 90), np.uint8))
    with pytest.warns(UserWarning):
        cut = section.cut(bent, np.array([0.5, 0.5, 0]), np.array([1.0, 0, 0]))
    assert all(piece.relief is not None and piece.glow is not None for piece in cut.pieces[:1])


def camera_picture(mesh, pose=None, srgb=True, lamps=LAMPS, shadow=None, cube=False, **options):
    """A Renderer's picture of a square, and which pixels lie inside of it."""
    renderer = shade.Renderer(48, 48, srgb=srgb)
    if cube:
        options["texture"] = renderer.texture(np.full((6, 2, 2, 3), 255, np.uint8))
    renderer.add(renderer.mesh(mesh), pose=pose, **options)
    renderer.light(lamps, (0.1, 0.1, 0.1), shadow)
    got = renderer.render(EYE, normals=True)
    there = got.ids[..., 0] >= 0
    for axis in (0, 1):
        there &= np.roll(there, 2, axis) & np.roll(there, -2, axis)
    assert there.sum() > 100
    return got, there


EYE = shade.Camera.look_at((0.4, 0.3, 4), (0.4, 0.5, 0), fov=20)


def lit(normal, there, pose=np.eye(4), glow=(0, 0, 0)):
    """Bytes of the pixels of a square in the plane z = 0 of pose, in double: Blinn-Phong of the lamps, and glow."""
    def unit(v):
        return v / np.linalg.norm(v, axis=-1, keepdims=True)

    rows, columns = np.nonzero(there)
    back = np.linalg.inv(EYE.view)
    sight = np.stack([(columns + 0.5) / 24 - 1, 1 - (rows + 0.5) / 24, -np.ones(len(rows))], 1)
    sight[:, :2] *= np.tan(np.radians(10))
    sight, N = sight @ back[:3, :3].T, unit(np.asarray(normal, float))
    plane = np.linalg.inv(pose[:3, :3]).T[:, 2]
    P = EYE.eye + sight * ((pose[:3, 3] - EYE.eye) @ plane / (sight @ plane))[:, None]
    light = 0.1 * np.array(MATTE.diffuse) + np.asarray(glow, float) + 0 * P
    for lamp in LAMPS:
        L = unit(np.array(lamp.position[:3], float))
        H = unit(unit(EYE.eye - P) + L)
        light += (N @ L > 0) * (max(N @ L, 0) * np.array(MATTE.diffuse) * lamp.diffuse +
                                (np.maximum(H @ N, 0) ** MATTE.shininess)[:, None] * MATTE.specular * lamp.specular)
    return 255 * np.clip(np.where(light <= 0.0031308, 12.92 * light, 1.055 * light ** (1 / 2.4) - 0.055), 0, 1)


@pytest.mark.parametrize("size", [(1, 1, 1), (0.7, 0.7, 0.7), (0.6, 1.2, 2), (-1, 1, 1)])
@pytest.mark.parametrize("matrix", [np.eye(3), about(2, 90) @ about(0, -30), about(1, 25), about(0, 160)])
@pytest.mark.parametrize("way", [(0.5, 0.0, 0.8), (0.0, 0.5, 0.8), (-0.4, 0.3, 0.8)])
def test_a_renderer_lights_a_normal_map_as_the_equations_do(way, matrix, size):
    texel = np.round((np.array(way) / np.linalg.norm(way) + 1) / 2 * 255)
    pose, whole = turned(matrix), turned(matrix * size)
    pose[:3, 3] = whole[:3, 3] = (0.4, 0.5, 0) - whole[:3, :3] @ (0.5, 0.5, 0)
    side = 1 if matrix[2, 2] > 0 else -1    # the back is lit as the front is
    bent, flat = (camera_picture(square(**own), pose, size=size, two_sided=side < 0)
                  for own in (dict(relief=np.full((4, 4, 3), texel, np.uint8)), {}))
    for (got, there), normal in ((bent, texel / 255 * 2 - 1), (flat, (0, 0, 1))):
        wanted = lit(side * np.linalg.inv(whole[:3, :3]).T @ normal, there, whole)
        assert np.abs(got.color[there] - wanted).max() <= 1
    assert np.abs(bent[0].color.astype(int) - flat[0].color).max() > 5
    # depth, numbers and normals are of the surface, not of its relief
    assert all(np.array_equal(getattr(bent[0], k), getattr(flat[0], k)) for k in ("depth", "ids", "normals"))


@pytest.mark.parametrize("repeat, cube, colors", [((1, 1), False, None), ((0.5, 1), True, None),
                                                  ((2, 3), True, np.ones((4, 3))), ((2, 3), False, np.ones((4, 3)))])
def test_a_renderer_lights_a_ramp_of_heights_as_the_equations_do(repeat, cube, colors):
    ramp = np.tile(np.arange(256, dtype=np.uint8)[None, :, None], (8, 1, 3))
    mesh = square(colors, relief=ramp, strength=0.2, wrap=("clamp", "clamp"))
    got, there = camera_picture(mesh, repeat=repeat, cube=cube)
    right = np.nonzero(there)[1].max()    # beyond the edge the clamped picture is flat
    there[:, int(right - (right - 14) * (1 - 1 / max(repeat[0], 1))) - 4 * (repeat[0] > 1):] = False
    wanted = lit((-0.2 * repeat[0] * 256 / 255, 0, 1), there)
    assert there.sum() > 100 and np.abs(got.color[there] - wanted).max() <= 1


@pytest.mark.parametrize("texture", [None, np.full((8, 8, 3), 255, np.uint8)])
def test_a_renderer_adds_what_glows_to_the_light(texture):
    texel, factor = np.array((200, 100, 50)), (0.5, 1, 2)
    glow = ((texel / 255 + 0.055) / 1.055) ** 2.4 * factor
    mesh = square(glow=np.full((4, 4, 3), texel, np.uint8), glow_factor=factor, texture=texture)
    renderers = [camera_picture(mesh), camera_picture(mesh, shadow=0)]
    for got, there in renderers:    # nothing hides the lamp
        assert np.abs(got.color[there] - lit((0, 0, 1), there, glow=glow)).max() <= 1
    plain, there = camera_picture(mesh, srgb=False, lamps=[shade.Light.directional((0, 0, 1))])
    shown = 1.055 * np.array(factor) ** (1 / 2.4) - 0.055    # of a display; no lamp shines on it
    ambient = 0.1 * (1.055 * 0.6 ** (1 / 2.4) - 0.055)
    assert np.abs(plain.color[there] - np.minimum(texel * np.minimum(shown, 1) + 255 * ambient, 255)).max() <= 1


@pytest.mark.parametrize("texture", [None, np.full((16, 16, 3), 255, np.uint8)])
@pytest.mark.parametrize("name", ["glow", "relief"])
def test_a_renderer_takes_the_level_of_detail_that_a_scene_takes(name, texture):
    noise = np.random.default_rng(3).integers(0, 256, (256, 256, 3)).astype(np.uint8)
    noise[..., 2] = 255 if name == "relief" else noise[..., 2]
    dark = shade.Material((0, 0, 0), (0.2,) * 3, (0.2,) * 3)
    mesh = square(material=dark if name == "glow" else MATTE,
                  **{name: noise, "texture": texture, "glow_factor": (0.5, 0.5, 0.5)})
    got, there = camera_picture(mesh, size=0.6)
    scene = shade.Scene(LAMPS, (0.1, 0.1, 0.1))
    scene.add(mesh, turned(0.6 * np.eye(3)))
    wanted = scene.render(EYE, (48, 48), samples=1, light="scene").rgba[..., :3]
    assert np.abs(got.color[there].astype(int) - wanted[there]).max() <= 1
    assert there.sum() > 200 and got.color[there].std(0).max() > 1


def test_objects_with_pictures_share_a_picture_and_are_copied():
    relief = np.full((4, 4, 3), (190, 128, 230), np.uint8)
    made = shade.Renderer(24, 24)
    bent, plain = made.mesh(square(relief=relief, glow=np.full((2, 2, 3), 99, np.uint8))), made.mesh(square())
    for x, shape in enumerate((bent, plain, bent)):
        made.add(shape, 0.5, at=(0.6 * x - 0.6, 0, 0))
    got = pickle.loads(pickle.dumps(made)).render(EYE, normals=True)
    one = made.render(EYE, normals=True)
    assert all(np.array_equal(a, b) for a, b in zip(got, one))
    alone = [made.show(k, False) or made.render(EYE) for k in (1, 0)]
    assert np.array_equal(alone[1].color[:, 17:], one.color[:, 17:])
    made.update(bent, square())
    assert len(made._textures) == 0 and (made.render(EYE).color != one.color).any()


def test_the_map_of_mtl_multiplies_what_shines(tmp_path):
    shade.Picture(np.full((8, 8, 4), (255, 128, 0, 255), np.uint8)).save(tmp_path / "map.png")
    (tmp_path / "a.mtl").write_text("newmtl m\nKd 0 0 0\nKe .5 1 1\nmap_Kd map.png\n")
    (tmp_path / "a.obj").write_text("mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
                                    "usemtl m\nf 1/1 2/2 3/3 4/4\n")
    assert np.abs(inner(seen(shade.load(tmp_path / "a.obj"))) - (127.5, 128, 0)).max() <= 1


def test_pictures_that_no_face_shows_are_not_read(tmp_path):
    (tmp_path / "a.mtl").write_text("newmtl m\nKd 1 0 0\nnewmtl other\nKd 1 1 1\nmap_Kd missing.png\nmap_bump missing.png\n")
    (tmp_path / "a.obj").write_text("mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nusemtl m\nf 1/1 2/2 3/3\n")
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        shade.load(tmp_path / "a.obj")


def test_a_picture_that_cannot_be_read_is_told_once(tmp_path):
    (tmp_path / "a.mtl").write_text("newmtl m\nKd 1 0 0\nmap_Kd missing.png\nnewmtl n\nKd 1 1 1\nmap_Kd missing.png\n")
    (tmp_path / "a.obj").write_text("mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nvt 0 0\nvt 1 0\nvt 1 1\n"
                                    "usemtl m\nf 1/1 2/2 3/3\nusemtl n\nf 3/3 2/2 1/1\n")
    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("always")
        shade.load(tmp_path / "a.obj")
    assert len([one for one in told if "missing.png" in str(one.message)]) == 1


@pytest.mark.parametrize("drawn", ["scene", "renderer", "texture"])
def test_texels_that_a_file_wants_as_squares_are(drawn):
    red, blue = (255, 0, 0), (0, 0, 255)
    rows = np.array([[red, blue], [blue, red]], np.uint8)
    camera = shade.Camera.look_at((0.5, 0.5, 4), (0.5, 0.5, 0), up=(0, 1, 0), fov=14)

    def colors(squares, times):
        picture = rows.repeat(times, 0).repeat(times, 1)
        mesh = square(texture=picture, squares=squares, wrap=("clamp", "clamp"),
                      material=shade.Material((0, 0, 0), (1, 1, 1), (1, 1, 1)))
        if drawn == "scene":
            scene = shade.Scene([], (1, 1, 1))
            scene.add(mesh)
            return scene.render(camera, (40, 40), samples=1).rgba[..., :3]
        renderer = shade.Renderer(40, 40)
        if drawn == "texture":
            mesh = renderer.mesh(CORNERS, FACES, uv=UV)
            renderer.add(mesh, texture=renderer.texture(picture, ("clamp", "clamp"), squares))
        else:
            renderer.add(renderer.mesh(mesh))
        renderer.light([], (1, 1, 1))
        return pickle.loads(pickle.dumps(renderer)).render(camera).color

    got = colors(True, 1)
    there = np.argwhere((got != 255).any(-1))
    half, middle = len(np.unique(there[:, 0])) / 2, there.mean(0)
    assert half > 15
    for y, x in there:    # the upper left is red
        assert tuple(got[y, x]) == (red if (y < middle[0]) == (x < middle[1]) else blue)
    assert (colors(False, 1) != got).any(-1).sum() > 400
    # beyond 512 texels a side they are smaller than pixels
    assert np.array_equal(colors(True, 300), colors(False, 300))
    with pytest.raises(shade.Error, match="squares must be True or False"):
        colors("no", 1)


@pytest.mark.parametrize("sampler, squares", [({"magFilter": 9728}, True), ({"magFilter": 9729}, False), ({}, False)])
def test_the_sampler_of_a_gltf_tells_which_texels_are_squares(sampler, squares):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        surface = file_of(lambda m: None, sampler, baseColorTexture=(9, 8, 7)).pieces[-1].surface
    assert surface.squares is squares
