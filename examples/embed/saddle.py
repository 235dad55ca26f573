"""saddle.py - shade.h from Python: ctypes draws into a numpy array, Pillow saves it as PNG.

    cc -O2 -shared -fPIC -DSHADE_IMPLEMENTATION -x c shade.h -lm -o libshade.so
    python3 saddle.py ./libshade.so saddle.png
"""
import sys
from ctypes import CDLL, Structure, addressof, byref, c_float, c_int, c_uint, c_void_p
import numpy
from PIL import Image

shade = CDLL(sys.argv[1])


def call(result, name, *values):
    function = getattr(shade, "shade_" + name)
    function.restype = result
    return function(*(c_float(v) if isinstance(v, float) else v for v in values))


def struct(**fields):            # a struct of shade.h, its fields in their order
    return type("struct", (Structure,), {"_fields_": list(fields.items())})


Vec3 = struct(x=c_float, y=c_float, z=c_float)
Vec4 = struct(x=c_float, y=c_float, z=c_float, w=c_float)
Mat4, Material, Light = struct(f=c_float * 16), struct(f=c_float * 13), struct(f=c_float * 21)
Target = struct(width=c_int, height=c_int, stride=c_int, format=c_int, color=c_void_p,
                depth=c_void_p, srgb=c_int, dither=c_int, clip=c_int * 4, rows=c_int * 2)
Mesh = struct(positions=c_void_p, position_stride=c_int, normals=c_void_p, normal_stride=c_int,
              texcoords=c_void_p, texcoord_stride=c_int, colors=c_void_p, color_stride=c_int,
              vertex_count=c_int, indices=c_void_p, index_count=c_int, chunks=c_void_p,
              chunk_count=c_int, indices16=c_void_p)
Lighting = struct(lights=c_void_p, light_count=c_int, ambient=Vec3, model=c_int, flags=c_uint,
                  terms=c_uint, cool=Vec3, warm=Vec3)
State = struct(model=Mat4, view=Mat4, projection=Mat4, material=c_void_p, lighting=Lighting,
               shading=c_int, diffuse_map=c_void_p, transparency=c_float, alpha_cutoff=c_float,
               raster=c_int * 5, depth_bias=c_float, fragment=c_void_p, uniforms=c_void_p)

N, WIDTH, HEIGHT = 33, 640, 480
y, x = numpy.mgrid[-1:1:N * 1j, -1:1:N * 1j]
positions = numpy.stack([x, y, (x * x - 3 * y * y) * x / 2], 2).astype(numpy.float32)
a = (numpy.arange(N - 1) + N * numpy.arange(N - 1)[:, None]).astype(numpy.uint32)
indices = numpy.stack([a, a + 1, a + N + 1, a, a + N + 1, a + N], 2)
normals, depth = numpy.zeros_like(positions), numpy.zeros((HEIGHT, WIDTH), numpy.float32)
pixels = numpy.zeros((HEIGHT, WIDTH, 4), numpy.uint8)

target = Target(WIDTH, HEIGHT, color=pixels.ctypes.data, depth=depth.ctypes.data, srgb=1)
mesh = Mesh(positions=positions.ctypes.data, normals=normals.ctypes.data, vertex_count=N * N,
            indices=indices.ctypes.data, index_count=indices.size)
lamp = call(Light, "point_light", Vec3(4, -2, 5), Vec3(1, 1, 1))
jade = call(Material, "linear_material", call(Material, "preset_material", 1))    # 1: JADE
state = State(
    view=call(Mat4, "mat4_look_at", Vec3(3, -5, 4), Vec3(0, 0, 0), Vec3(0, 0, 1)),
    projection=call(Mat4, "mat4_perspective", 0.5, WIDTH / HEIGHT, 0.1, 100.0),
    material=addressof(jade),
    lighting=Lighting(addressof(lamp), 1, Vec3(0.2, 0.2, 0.2), flags=1))    # two-sided
call(c_int, "mesh_normals", byref(mesh), c_void_p(normals.ctypes.data))
call(c_int, "clear", byref(target), Vec4(0.02, 0.03, 0.05, 1), 1.0)
if call(c_int, "draw_mesh", byref(target), byref(mesh), byref(state), None):
    sys.exit("not drawn")
Image.fromarray(pixels).save(sys.argv[2])
