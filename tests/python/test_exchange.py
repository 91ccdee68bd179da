"""Meshes of other packages: taken as they are, and given back."""

import base64
import sys
import types

import numpy as np
import pytest

import barycert
from conftest import delaunay, kuhn


@pytest.fixture(params=[(2, 1), (3, 1), (2, 2), (3, 2)], ids=["triangles", "tetrahedra", "triangles2", "tetrahedra2"])
def mesh(request):
    dimension, order = request.param
    points, cells = kuhn(2, dimension)
    if order == 2:
        points, cells = second_order(points * 2, cells)
    rng = np.random.default_rng(1)
    return barycert.Mesh(
        points,
        cells,
        point_data={"T": rng.random(len(points)), "v": rng.random((len(points), 3))},
        cell_data={"c": rng.random(len(cells))},
    )


def second_order(points, cells):
    edges = [(0, 1), (1, 2), (0, 2)] + ([(0, 3), (1, 3), (2, 3)] if cells.shape[1] == 4 else [])
    number, columns, more = {}, [], list(points)
    for a, b in edges:
        column = []
        for pair in np.sort(cells[:, [a, b]], axis=1):
            if tuple(pair) not in number:
                number[tuple(pair)] = len(more)
                more.append((points[pair[0]] + points[pair[1]]) / 2)
            column.append(number[tuple(pair)])
        columns.append(column)
    return np.array(more), np.hstack([cells, np.array(columns).T])


def same(a, b):
    np.testing.assert_array_equal(a.points, b.points)
    np.testing.assert_array_equal(a.cells, b.cells)
    if a.mid_nodes is None:
        assert b.mid_nodes is None
    else:
        np.testing.assert_array_equal(a.mid_nodes, b.mid_nodes)
    for mine, other in ((a.point_data, b.point_data), (a.cell_data, b.cell_data)):
        assert set(mine) == set(other)
        for name in mine:
            np.testing.assert_array_equal(mine[name], other[name])


def test_meshio(mesh):
    meshio = pytest.importorskip("meshio")
    there = mesh.to_meshio()
    assert isinstance(there, meshio.Mesh)
    same(barycert.Mesh(there), mesh)


def test_meshio_reads_what_barycert_writes(mesh, tmp_path):
    meshio = pytest.importorskip("meshio")
    # meshio decodes to the end of the file, and relies on Python to stop at the padding of the first array.
    if base64.b64decode(b"AA==AA==") != b"\0":
        pytest.skip("under this Python meshio 5.3 cannot read appended data of any writer")
    mesh.write(tmp_path / "a.vtu")
    same(barycert.Mesh(meshio.read(tmp_path / "a.vtu")), mesh)


def test_meshio_with_other_cells():
    meshio = pytest.importorskip("meshio")
    points, cells = kuhn(1, 3)
    there = meshio.Mesh(
        points,
        [("triangle", [[0, 1, 2]]), ("tetra", cells[:2]), ("line", [[0, 1]]), ("tetra", cells[2:])],
        cell_data={"c": [[9], [0, 1], [9], [2, 3, 4, 5]]},
    )
    mesh = barycert.Mesh(there)
    np.testing.assert_array_equal(mesh.cells, cells)
    np.testing.assert_array_equal(mesh.cell_numbers, [1, 2, 4, 5, 6, 7])
    np.testing.assert_array_equal(mesh.cell_data["c"], np.arange(6))
    assert sorted(mesh.notes) == ["left out: 1 triangles beside tetrahedra", "left out: 1 vertices and lines"]
    with pytest.raises(barycert.Error, match="hexahedron"):
        barycert.Mesh(meshio.Mesh(points, [("hexahedron", [range(8)])]))
    with pytest.raises(barycert.Error, match="without triangles and tetrahedra"):
        barycert.Mesh(meshio.Mesh(points, [("line", [[0, 1]])]))
    with pytest.raises(barycert.Error, match="first and second order"):
        barycert.Mesh(meshio.Mesh(second_order(points, cells)[0], [("tetra", cells), ("tetra10", second_order(points, cells)[1])]))
    with pytest.raises(barycert.Error, match="triangles in space.*z = 0"):
        barycert.Mesh(meshio.Mesh(points, [("triangle", [[0, 1, 3]])]))


def test_vtk(mesh):
    pytest.importorskip("vtkmodules.vtkCommonDataModel")
    there = mesh.to_vtk()
    assert there.GetNumberOfCells() == len(mesh.cells) and there.GetNumberOfPoints() == len(mesh.points)
    same(barycert.Mesh(there), mesh)


def test_vtk_reads_what_barycert_writes(mesh, tmp_path):
    io = pytest.importorskip("vtkmodules.vtkIOXML")
    mesh.write(tmp_path / "a.vtu")
    reader = io.vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(tmp_path / "a.vtu"))
    reader.Update()
    same(barycert.Mesh(reader.GetOutput()), mesh)


def test_vtk_probes_the_same_values():
    """vtkProbeFilter on the mesh that was given back, inside where it is right; with a locator, for without one that of VTK
    9.3 loses one of these points."""
    core = pytest.importorskip("vtkmodules.vtkFiltersCore")
    from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
    from vtkmodules.vtkCommonCore import vtkPoints
    from vtkmodules.vtkCommonDataModel import vtkPolyData, vtkStaticCellLocator

    points, cells = delaunay(100, 3, 5)
    mesh = barycert.Mesh(points, cells, point_data={"T": points @ [1.0, 2.0, 3.0]})
    at = np.random.default_rng(6).random((500, 3)) * 0.6 + 0.2
    places = vtkPoints()
    places.SetData(numpy_to_vtk(at, deep=True))
    data = vtkPolyData()
    data.SetPoints(places)
    probe = core.vtkProbeFilter()
    probe.SetInputData(data)
    probe.SetSourceData(mesh.to_vtk())
    probe.SetCellLocatorPrototype(vtkStaticCellLocator())
    probe.Update()
    output = probe.GetOutput().GetPointData()
    valid = vtk_to_numpy(output.GetArray("vtkValidPointMask")).astype(bool)
    assert valid.all()
    assert np.abs(vtk_to_numpy(output.GetArray("T")) - mesh.sample(at, "T")).max() < 1e-12
    # Points of a data set are taken as they are.
    np.testing.assert_array_equal(mesh.sample(data, "T"), mesh.sample(at, "T"))
    np.testing.assert_array_equal(mesh.locate(data).cell, mesh.locate(at).cell)


def test_vtk_with_ghosts_and_other_cells():
    model = pytest.importorskip("vtkmodules.vtkCommonDataModel")
    from vtkmodules.util.numpy_support import numpy_to_vtk

    points, cells = kuhn(1, 3)
    grid = barycert.Mesh(points, cells, cell_data={"c": np.arange(6)}).to_vtk()
    ghost = numpy_to_vtk(np.array([0, 1, 0, 0, 32, 0], dtype=np.uint8), deep=True)
    ghost.SetName("vtkGhostType")
    grid.GetCellData().AddArray(ghost)
    mesh = barycert.Mesh(grid)
    np.testing.assert_array_equal(mesh.cell_numbers, [0, 2, 3, 5])
    np.testing.assert_array_equal(mesh.cell_data["c"], [0, 2, 3, 5])
    assert "vtkGhostType" not in mesh.cell_data and mesh.notes == ["left out: 2 ghost cells"]
    with pytest.raises(barycert.Error, match="vtkUnstructuredGrid or vtkPolyData"):
        image = model.vtkStructuredGrid()
        image.SetPoints(grid.GetPoints())
        barycert.Mesh(image)
    with pytest.raises(barycert.Error, match="without points"):
        barycert.Mesh(model.vtkUnstructuredGrid())


def test_vtk_polygon_data():
    model = pytest.importorskip("vtkmodules.vtkCommonDataModel")
    points, cells = kuhn(2, 2)
    grid = barycert.Mesh(points, cells, point_data={"T": points[:, 0]}).to_vtk()
    surface = model.vtkPolyData()
    surface.SetPoints(grid.GetPoints())
    surface.SetPolys(grid.GetCells())
    surface.GetPointData().AddArray(grid.GetPointData().GetArray("T"))
    same(barycert.Mesh(surface), barycert.Mesh(points, cells, point_data={"T": points[:, 0]}))


def fake_grid(mesh):
    """As a pyvista.UnstructuredGrid is: VTK's, whose parts have other names besides."""
    model = pytest.importorskip("vtkmodules.vtkCommonDataModel")
    from vtkmodules.util.numpy_support import vtk_to_numpy

    class Grid(model.vtkUnstructuredGrid):
        points = property(lambda self: vtk_to_numpy(self.GetPoints().GetData()))
        cells = property(lambda self: vtk_to_numpy(self.GetCells().GetData()))
        celltypes = property(lambda self: vtk_to_numpy(self.GetCellTypesArray()))
        point_data = property(lambda self: {})
        cell_data = property(lambda self: {})

    grid = Grid()
    grid.ShallowCopy(mesh.to_vtk())
    return grid


def test_pyvista(mesh):
    grid = fake_grid(mesh)
    same(barycert.Mesh(grid), mesh)
    np.testing.assert_array_equal(mesh.locate(grid).cell, mesh.locate(mesh.points).cell)
    f = barycert.Interpolator(grid, mesh.point_data["T"])
    np.testing.assert_array_equal(f(mesh.points), mesh.point_data["T"])


def test_pyvista_with_other_cells():
    points, cells = kuhn(1, 3)
    for kind, nodes in ((12, range(8)), (3, range(2))):
        grid = fake_grid(barycert.Mesh(points, cells))
        grid.InsertNextCell(kind, len(nodes), list(nodes))
        if kind == 12:
            with pytest.raises(barycert.Error, match="1 cells of type 12, the first is cell 6"):
                barycert.Mesh(grid)
    mesh = barycert.Mesh(grid)
    np.testing.assert_array_equal(mesh.cells, cells)
    assert mesh.notes == ["left out: 1 vertices and lines"]


def test_pyvista_is_given_back(mesh, monkeypatch):
    pytest.importorskip("vtkmodules.vtkCommonDataModel")
    fake = types.ModuleType("pyvista")
    fake.wrap = lambda grid: ("wrapped", grid)
    monkeypatch.setitem(sys.modules, "pyvista", fake)
    word, grid = mesh.to_pyvista()
    assert word == "wrapped"
    same(barycert.Mesh(grid), mesh)


def test_what_is_no_mesh():
    with pytest.raises(barycert.Error, match="found int"):
        barycert.Mesh(3)


def test_points_off_the_plane_are_refused():
    points, cells = kuhn(1, 2)
    mesh = barycert.Mesh(points, cells)

    class Cloud:
        points = np.array([[0.5, 0.5, 0.0], [0.5, 0.25, 0.125]])

    with pytest.raises(barycert.Error, match="z = 0.125 at point 1"):
        mesh.locate(Cloud())
    Cloud.points = Cloud.points[:1]
    assert mesh.locate(Cloud()).cell == 0


def test_strings_are_left_out():
    meshio = pytest.importorskip("meshio")
    points, cells = kuhn(1, 2)
    mesh = barycert.Mesh(meshio.Mesh(points, [("triangle", cells)], point_data={"name": np.array(["a"] * len(points))}))
    assert 'array "name"' in mesh.notes[0] and not mesh.point_data
