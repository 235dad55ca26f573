"""Meshes of PyVista, VTK, meshio and Open3D: the real ones where they are installed, and stand-ins of the
same attributes."""
import types

import numpy as np
import pytest
import shade_h as shade

POINTS = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0.5, 0.5, 1]], float)
TRIANGLES = np.array([[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4], [0, 2, 1], [0, 3, 2]])
SMALL = {"size": (48, 36), "samples": 1}


def vtk_mesh(quad):
    vtk = pytest.importorskip("vtk")
    points, polygons, data = vtk.vtkPoints(), vtk.vtkCellArray(), vtk.vtkPolyData()
    for p in POINTS:
        points.InsertNextPoint(p)
    for face in (*TRIANGLES[:4], [0, 3, 2, 1]) if quad else TRIANGLES:
        polygons.InsertNextCell(len(face))
        for i in face:
            polygons.InsertCellPoint(i)
    data.SetPoints(points)
    data.SetPolys(polygons)
    return data


def pyvista_mesh(quad):
    faces = [i for face in ((*TRIANGLES[:4], [0, 3, 2, 1]) if quad else TRIANGLES) for i in (len(face), *face)]
    return types.SimpleNamespace(points=POINTS, faces=np.array(faces), n_cells=5)


def meshio_mesh(quad):
    blocks = [("triangle", TRIANGLES[:4]), ("quad", np.array([[0, 3, 2, 1]]))] if quad else [("triangle", TRIANGLES)]
    try:
        import meshio
    except ImportError:
        cells = [types.SimpleNamespace(type=kind, data=data) for kind, data in blocks]
        return types.SimpleNamespace(points=POINTS, cells=cells, cell_data={})
    return meshio.Mesh(POINTS, blocks)


def open3d_mesh(quad):
    return types.SimpleNamespace(vertices=POINTS, triangles=TRIANGLES, vertex_colors=np.zeros((0, 3)))


@pytest.mark.parametrize("quad", [False, True])
@pytest.mark.parametrize("made", [vtk_mesh, pyvista_mesh, meshio_mesh, open3d_mesh])
def test_a_mesh_of_another_library_is_drawn_as_its_arrays_are(made, quad):
    given = made(quad)
    want = shade.render(POINTS, TRIANGLES, normals="flat", **SMALL)
    assert np.array_equal(shade.render(shade.Mesh(POINTS, TRIANGLES, normals="flat"), **SMALL).rgba, want.rgba)
    got = shade.render(given, normals="flat", **SMALL)
    assert (got.rgba != want.rgba).any(-1).sum() <= 12    # the square's other diagonal
    renderer = shade.Renderer(36, 48)
    shape = renderer.mesh(given)
    assert shape.count == 6
    renderer.add(shape, color="orange")
    renderer.update(shape, made(quad))
    assert (renderer.render(shade.Camera.look_at((3, -3, 2))).ids[..., 0] == 0).sum() > 60


def test_colours_of_open3d_are_taken():
    mesh = open3d_mesh(False)
    mesh.vertex_colors = np.tile([1.0, 0.0, 0.0], (5, 1))
    got = shade.render(mesh, **SMALL)
    assert got == shade.render(POINTS, TRIANGLES, color=np.tile([1.0, 0, 0], (5, 1)), **SMALL)


@pytest.mark.parametrize("words, value", [
    ("polygons of 5 corners", types.SimpleNamespace(points=POINTS, faces=np.array([5, 0, 1, 2, 3, 4]))),
    ("ends within a face", types.SimpleNamespace(points=POINTS, faces=np.array([3, 0, 1, 2, 3, 0, 1]))),
    ("bad indices", types.SimpleNamespace(points=POINTS, faces=np.array([3, 0, 1, 9]))),
    ("faces begin with 3 in each row", (POINTS, np.column_stack([np.full(6, 3), TRIANGLES]))),
])
def test_what_cannot_be_drawn_is_refused_by_name(words, value):
    with pytest.raises(shade.Error, match=words):
        shade.render(value, **SMALL)


def test_cells_that_are_left_out_are_told():
    cells = [types.SimpleNamespace(type="triangle", data=TRIANGLES),
             types.SimpleNamespace(type="tetra", data=np.array([[0, 1, 2, 4]]))]
    mesh = types.SimpleNamespace(points=POINTS, cells=cells, cell_data={})
    with pytest.warns(UserWarning, match=r"cells of type tetra \(left out\)"):
        shade.render(mesh, **SMALL)
