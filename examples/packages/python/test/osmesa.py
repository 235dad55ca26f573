"""Mesa's llvmpipe through OSMesa, for comparisons: the fixed functions of OpenGL 1, as simulators use
them.  Meshes are display lists; numbers of objects are colours of a second draw without light."""
import ctypes
import ctypes.util
import os

import numpy as np

_RGBA, _BYTE, _UINT, _FLOAT = 0x1908, 0x1401, 0x1405, 0x1406
_DEPTH, _NORMALIZE, _LIGHTING, _LIGHT0 = 0x1902, 0x0BA1, 0x0B50, 0x4000


def _floats(values):
    return (ctypes.c_float * np.size(values))(*np.ravel(values).tolist())


def _matrix(m):
    return (ctypes.c_double * 16)(*np.asarray(m, float).T.ravel().tolist())


class Mesa:
    """A scene of meshes [(positions, faces, normals)] with one distant lamp.  OSError: there is no
    OSMesa here."""

    def __init__(self, meshes, size, toward, diffuse, ambient, threads=0):
        """size is (width, height); toward the lamp's direction; both lights are (r, g, b)."""
        os.environ["GALLIUM_DRIVER"] = "llvmpipe"
        os.environ["LP_NUM_THREADS"] = str(threads)
        name = ctypes.util.find_library("OSMesa")
        if not name:
            raise OSError("no libOSMesa (Debian: libosmesa6)")
        gl = self.gl = ctypes.CDLL(name)
        for call in ("glClearDepth", "glMultMatrixd", "glLoadMatrixd"):
            getattr(gl, call).argtypes = [ctypes.c_double if call == "glClearDepth"
                                          else ctypes.POINTER(ctypes.c_double)]
        gl.glColor3f.argtypes = [ctypes.c_float] * 3
        gl.OSMesaCreateContextExt.restype = ctypes.c_void_p
        gl.OSMesaMakeCurrent.argtypes = [ctypes.c_void_p, ctypes.c_void_p, *[ctypes.c_int] * 3]
        gl.OSMesaDestroyContext.argtypes = [ctypes.c_void_p]
        w, h = self.size = size
        self.bytes = np.zeros((h, w, 4), np.uint8)
        self.read, self.z = np.zeros((h, w, 4), np.uint8), np.zeros((h, w), np.float32)
        context = self.context = gl.OSMesaCreateContextExt(_RGBA, 24, 0, 0, None)
        if not context or not gl.OSMesaMakeCurrent(context, self.bytes.ctypes.data, _BYTE, w, h):
            raise OSError("OSMesa gives no context")
        for what in (0x0B71, 0x0B44, _NORMALIZE, _LIGHTING, _LIGHT0, 0x0B57):
            gl.glEnable(what)    # depth, back faces, unit normals, light, colours are materials
        self.toward = _floats((*toward, 0))
        gl.glLightfv(_LIGHT0, 0x1201, _floats((*diffuse, 1)))
        gl.glLightModelfv(0x0B53, _floats((*ambient, 1)))
        self.count = len(meshes)
        for i, (positions, faces, normals) in enumerate(meshes):
            arrays = [np.ascontiguousarray(positions, np.float32), np.ascontiguousarray(normals, np.float32),
                      np.ascontiguousarray(faces, np.uint32)]
            gl.glNewList(i + 1, 0x1300)
            gl.glEnableClientState(0x8074)
            gl.glEnableClientState(0x8075)
            gl.glVertexPointer(3, _FLOAT, 0, ctypes.c_void_p(arrays[0].ctypes.data))
            gl.glNormalPointer(_FLOAT, 0, ctypes.c_void_p(arrays[1].ctypes.data))
            gl.glDrawElements(4, arrays[2].size, _UINT, ctypes.c_void_p(arrays[2].ctypes.data))
            gl.glEndList()

    def __del__(self):
        """A context writes what it has left to draw; the array for that is still here."""
        if getattr(self, "context", None):
            self.gl.OSMesaMakeCurrent(None, None, 0, 0, 0)
            self.gl.OSMesaDestroyContext(self.context)

    def draw(self, view, projection, places, poses, colors):
        """The mesh of each object, its pose and colour, to colours (bytes), window depth (0 to 1) and
        numbers of objects, -1 where there is nothing; row 0 is the top one."""
        gl, (w, h) = self.gl, self.size
        matrices = [_matrix(p) for p in poses]
        gl.glViewport(0, 0, w, h)
        gl.glMatrixMode(0x1701)
        gl.glLoadMatrixd(_matrix(projection))
        gl.glMatrixMode(0x1700)
        gl.glLoadMatrixd(_matrix(view))
        gl.glLightfv(_LIGHT0, 0x1203, self.toward)
        out = []
        for numbers in (False, True):
            (gl.glDisable if numbers else gl.glEnable)(_LIGHTING)
            gl.glClear(0x4100)
            for i, (place, matrix) in enumerate(zip(places, matrices)):
                gl.glPushMatrix()
                gl.glMultMatrixd(matrix)
                if numbers:
                    gl.glColor3f((i + 1) / 255, 0, 0)
                else:
                    gl.glColor3f(*colors[i])
                gl.glCallList(place + 1)
                gl.glPopMatrix()
            gl.glReadPixels(0, 0, w, h, _RGBA, _BYTE, ctypes.c_void_p(self.read.ctypes.data))
            out.append(self.read[::-1, :, :3].copy())
            if not numbers:
                gl.glReadPixels(0, 0, w, h, _DEPTH, _FLOAT, ctypes.c_void_p(self.z.ctypes.data))
        return out[0], self.z[::-1].copy(), out[1][..., 0].astype(np.int32) - 1
