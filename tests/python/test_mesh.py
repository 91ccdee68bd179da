"""Meshes: what they are made of, files, copies."""

import copy
import os
import pickle

import numpy as np
import pytest

import barycert
from conftest import delaunay, kuhn


@pytest.mark.parametrize("dtype", [np.int8, np.uint8, np.int16, np.uint16, np.int32, np.uint32, np.int64, np.uint64, ">i4", ">i8"])
@pytest.mark.parametrize("dimension", [2, 3])
def test_cells_of_any_integer_type(dtype, dimension):
    points, cells = kuhn(2, dimension)
    mesh = barycert.Mesh(points, cells.astype(dtype))
    np.testing.assert_array_equal(mesh.cells, cells)
    assert mesh.cells.dtype == np.int32 and mesh.dimension == dimension
    np.testing.assert_array_equal(mesh.points, points)
    np.testing.assert_array_equal(barycert.Mesh(points.tolist(), cells.tolist()).cells, cells)
    np.testing.assert_array_equal(barycert.Mesh(np.asfortranarray(points), np.asfortranarray(cells.astype(dtype))).cells, cells)
    np.testing.assert_array_equal(barycert.Mesh(points[::-1], cells[::2].astype(dtype)).cells, cells[::2])


@pytest.mark.parametrize("dtype, bad", [(np.int64, -1), (np.int64, 2**40), (np.uint64, 2**63), (np.int8, -128), (np.int32, 9)])
def test_indices_out_of_range_are_named(dtype, bad):
    points, cells = kuhn(2, 2)
    cells = cells.astype(dtype)
    cells[5, 1] = bad
    with pytest.raises(barycert.Error, match=rf"cells\[5, 1\] is no node: expected 0 to 8, found {bad};"):
        barycert.Mesh(points, cells)


def test_shapes_and_types_are_checked():
    points, cells = kuhn(2, 3)
    bad = points.copy()
    bad[4, 2] = np.inf
    for arguments, message in (
        ((points[:, :1], cells), "shape of the points of a mesh"),
        ((points, cells[:, :2]), "shape of the cells"),
        ((points, cells[:, :3]), "triangles in space"),
        ((points, cells.astype(float)), "expected integers, found float64"),
        ((points, cells.ravel()), "shape of the cells"),
        ((points.astype(str), cells), "real numbers"),
        ((bad, cells), r"points\[4, 2\] is not finite"),
        ((points.astype(np.longdouble), cells), "float64 can hold"),
    ):
        with pytest.raises(barycert.Error, match=message):
            barycert.Mesh(*arguments)
    with pytest.raises(barycert.Error, match="no cells, as there are no nodes"):
        barycert.Mesh(np.zeros((0, 3)), cells)
    empty = barycert.Mesh(np.zeros((0, 3)), np.zeros((0, 4), dtype=int))
    assert empty.locate([[1, 2, 3]]).cell == -1


def test_fields():
    points, cells = kuhn(2, 2)
    mesh = barycert.Mesh(points, cells, point_data={"T": points[:, 0]}, cell_data={"c": np.arange(8)})
    mesh.point_data["v"] = np.ones((9, 2), dtype=np.float32)
    mesh.point_data["tensor"] = np.arange(36).reshape(9, 2, 2)
    assert list(mesh.point_data) == ["T", "v", "tensor"] and list(mesh.cell_data) == ["c"]
    assert mesh.point_data["tensor"].shape == (9, 2, 2) and mesh.point_data["v"].dtype == np.float64
    np.testing.assert_array_equal(mesh.point_data["tensor"], np.arange(36).reshape(9, 2, 2))
    old = mesh.point_data["T"]
    mesh.point_data["T"] = points[:, 1]
    np.testing.assert_array_equal(old, points[:, 0])
    np.testing.assert_array_equal(mesh.point_data["T"], points[:, 1])
    assert mesh.sample([0.5, 1.5], "T") == 1.5
    mesh.point_data["T"] = points[:, 0]
    assert mesh.sample([0.5, 1.5], "T") == 0.5
    del mesh.point_data["v"]
    assert "v" not in mesh.point_data and len(mesh.point_data) == 2
    for name in ("v", "none"):
        with pytest.raises(KeyError):
            mesh.point_data[name]
        with pytest.raises(KeyError):
            del mesh.point_data[name]
    with pytest.raises(barycert.Error, match=r"one value each"):
        mesh.point_data["bad"] = np.ones(8)
    with pytest.raises(barycert.Error, match="at least one component"):
        mesh.point_data["bad"] = np.ones((9, 0))
    with pytest.raises(barycert.Error, match="name of a field"):
        mesh.point_data[3] = np.ones(9)
    assert repr(mesh) == "<barycert.Mesh: 9 nodes, 8 triangles, point_data T, tensor, cell_data c>"
    assert "tensor" in repr(mesh.point_data)


@pytest.mark.parametrize("suffix", ["vtu", "vtk", "msh", "node"])
@pytest.mark.parametrize("dimension", [2, 3])
def test_files_give_back_the_mesh(tmp_path, suffix, dimension):
    points, cells = delaunay(40, dimension, 3)
    rng = np.random.default_rng(4)
    mesh = barycert.Mesh(points, cells, point_data={"T": rng.random(40)}, cell_data={"c": rng.random(len(cells))})
    path = tmp_path / f"mesh.{suffix}"
    mesh.write(path)
    again = barycert.read(path)
    np.testing.assert_array_equal(again.points, points)
    np.testing.assert_array_equal(again.cells, cells)
    names = ("attribute0", "attribute0") if suffix == "node" else ("T", "c")
    np.testing.assert_array_equal(again.point_data[names[0]], mesh.point_data["T"])
    np.testing.assert_array_equal(again.cell_data[names[1]], mesh.cell_data["c"])
    np.testing.assert_array_equal(barycert.read(str(path)).points, points)


def test_writing(tmp_path):
    points, cells = kuhn(1, 2)
    mesh = barycert.Mesh(points, cells)
    mesh.write(tmp_path / "a.vtu", data="ascii")
    assert "ascii" in (tmp_path / "a.vtu").read_text()
    with pytest.raises(barycert.Error, match="zlib"):
        mesh.write(tmp_path / "b.vtu", data="what")
    with pytest.raises(barycert.Error):
        mesh.write(tmp_path / "b.what")
    assert os.listdir(tmp_path) == ["a.vtu"]


def test_reading_of_what_is_not_there(tmp_path):
    with pytest.raises(barycert.Error) as info:
        barycert.read(tmp_path / "none.vtu")
    assert info.value.file.endswith("none.vtu")
    with pytest.raises(barycert.Error, match='step of a series: expected a number from 0, or "last"'):
        barycert.read(tmp_path / "none.pvd", step="all")


def test_the_projects_own_meshes(data):
    stems = sorted({os.path.splitext(name)[0] for name in os.listdir(data) if name.endswith(".node")})
    assert stems
    mesh = barycert.read(os.path.join(data, stems[0]))
    assert len(mesh.cells) > 0 and mesh.check().verdict in ("certified", "not certified")


def test_what_changes_meaning_is_a_warning(tmp_path, recwarn):
    points, cells = kuhn(1, 3)
    barycert.Mesh(points, cells).write(tmp_path / "a.vtu")
    mesh = barycert.read(tmp_path / "a.vtu")
    assert not recwarn.list and mesh.notes == []


def test_copies_and_pickles():
    points, cells = kuhn(2, 3)
    mesh = barycert.Mesh(points, cells, point_data={"t": np.ones((27, 2, 2))}, cell_data={"c": np.arange(48)})
    for other in (pickle.loads(pickle.dumps(mesh)), copy.copy(mesh), copy.deepcopy(mesh)):
        np.testing.assert_array_equal(other.points, points)
        np.testing.assert_array_equal(other.cells, cells)
        assert repr(other) == repr(mesh) and other.point_data["t"].shape == (27, 2, 2)
        other.point_data["new"] = np.ones(27)
        assert "new" not in mesh.point_data


def test_second_order_cells():
    points = np.array([[0, 0], [4, 0], [0, 4], [2, 0], [2, 2], [0, 2]], dtype=float)
    mesh = barycert.Mesh(points, [[0, 1, 2, 3, 4, 5]], point_data={"q": points[:, 0] ** 2})
    np.testing.assert_array_equal(mesh.cells, [[0, 1, 2]])
    np.testing.assert_array_equal(mesh.mid_nodes, [[3, 4, 5]])
    assert mesh.sample([1.0, 0.5], "q") == 1
    np.testing.assert_array_equal(mesh.gradient("q", [[1.0, 0.5]]), [[2, 0]])
    with pytest.raises(barycert.Error, match="pass points"):
        mesh.gradient("q")
    other = pickle.loads(pickle.dumps(mesh))
    np.testing.assert_array_equal(other.mid_nodes, mesh.mid_nodes)


def test_curved_cells_are_told_or_refused(tmp_path, recwarn):
    points = np.array([[0, 0], [4, 0], [0, 4], [2, 0], [2, 2], [0, 2]], dtype=float)
    cells = [[0, 1, 2, 3, 4, 5]]
    straight = barycert.Mesh(points, cells, curved="refuse")
    assert straight.curved == {"cells": 0, "max_deviation": 0, "rounded_cells": 0, "max_rounded": 0}
    assert not recwarn.list
    points[4] += 0.5
    with pytest.warns(UserWarning, match="1 cell is curved: mid-edge nodes lie up to 0.1") as told:
        mesh = barycert.Mesh(points, cells, curved="straight")
    assert told[0].filename == __file__
    assert mesh.curved["cells"] == 1 and abs(mesh.curved["max_deviation"] - 0.125) < 1e-15
    report = mesh.check()
    assert report.certified and str(report).startswith("curved     1 cell is curved") and "for straight sides" in str(report)
    assert report.to_dict()["curved"] == {**mesh.curved, "mapped": False} and "1 cell is curved" in report.html()
    path = str(tmp_path / "curved.vtu")
    mesh.write(path)
    with pytest.warns(UserWarning, match="curved.vtu: 1 cell is curved") as told:
        assert barycert.read(path, curved="straight").curved == mesh.curved
    assert told[0].filename == __file__
    for make in (lambda: barycert.read(path, curved="refuse"), lambda: barycert.Mesh(points, cells, curved="refuse")):
        with pytest.raises(barycert.Error, match="the mesh is curved.*1 cell is curved"):
            make()
    with pytest.raises(barycert.Error, match="curved=: expected isoparametric, straight, refuse or exact, found bent"):
        barycert.read(path, curved="bent")
    # As it is: the bulge is inside, and the node has its value.
    bulge = [[2.4, 2.4]]
    mesh.point_data["f"] = np.arange(6.0)
    assert mesh.locate(bulge).cell[0] == -1
    bent = barycert.Mesh(points, cells, point_data={"f": np.arange(6.0)})
    assert bent.locate(bulge).cell[0] == 0
    assert bent.sample(points[4:5], "f")[0] == 4


def test_nodes_off_by_rounding_count_as_middles_unless_they_are_to_be_exact():
    a, b = 0.1, 0.2
    middle = (a + b) / 2  # rounded: the sum of these doubles is none
    points = np.array([[a, a], [b, a], [a, b], [middle, a], [middle, middle], [a, middle]])
    cells = [[0, 1, 2, 3, 4, 5]]
    rounded = barycert.Mesh(points, cells)
    exact = barycert.Mesh(points, cells, curved="exact")
    assert rounded.curved["cells"] == 0 and exact.curved["cells"] == rounded.curved["rounded_cells"] == 1
    assert pickle.loads(pickle.dumps(exact)).curved == exact.curved


def test_cells_of_other_shapes(tmp_path):
    path = str(tmp_path / "hex.vtk")
    corners = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]
    with open(path, "w") as out:
        out.write("# vtk DataFile Version 3.0\nx\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 8 double\n")
        out.writelines("%d %d %d\n" % c for c in corners)
        out.write("CELLS 1 9\n8 0 1 2 3 4 5 6 7\nCELL_TYPES 1\n12\nPOINT_DATA 8\nSCALARS f double 1\nLOOKUP_TABLE default\n")
        out.writelines("%d\n" % (x * y * z) for x, y, z in corners)
    linear, multilinear = barycert.read(path), barycert.read(path, interpolation="multilinear")
    point = [[0.5, 0.25, 0.75]]
    assert linear.sample(point, "f")[0] == 0.25  # on the part with corners 0 4 7 6, or the like
    assert multilinear.sample(point, "f")[0] == 0.5 * 0.25 * 0.75
    for other in (pickle.loads(pickle.dumps(multilinear)), copy.copy(multilinear), copy.deepcopy(multilinear)):
        assert other.sample(point, "f")[0] == 0.5 * 0.25 * 0.75
        np.testing.assert_array_equal(other.cell_numbers, multilinear.cell_numbers)
    with pytest.raises(barycert.Error, match="interpolation=: expected linear or multilinear, found cubic"):
        barycert.read(path, interpolation="cubic")


def test_a_repaired_copy():
    points = np.array([[0, 0], [1, 0], [0, 1], [1, 0], [0, 1 + 1e-12], [1, 1]])
    mesh = barycert.Mesh(points, [[0, 1, 2], [3, 4, 5], [0, 1, 2]], point_data={"T": np.arange(6.0)})
    assert not mesh.check()
    copy, done = mesh.fix(merge_within=1e-9)
    assert copy.check() and len(copy.points) == 4
    assert [pair[:2] for pair in done.merged] == [(3, 1), (4, 2)] and 0 < done.merged[1][2] < 1e-11
    assert done.dropped == [(2, "duplicate_cell")] and done.turned == 1 and done.fields == [("T", 2, 2.0)]
    np.testing.assert_array_equal(copy.point_data["T"], [0, 1, 2, 5])
    with pytest.raises(barycert.Error, match="a finite number from 0 on"):
        mesh.fix(merge_within=-1)


def test_a_check_names_what_it_finds():
    points = np.array([[0, 0], [2, 0], [0, 2], [2, 2], [1, 1]], dtype=float)
    # The second triangle overlaps the first; the third is flat.
    mesh = barycert.Mesh(points, [[0, 1, 2], [0, 1, 3], [1, 2, 4]])
    report = mesh.check()
    assert not report and not report.certified and report.verdict == "not certified"
    kinds = {defect.kind: defect for defect in report.defects}
    flat = kinds["degenerate_cell"]
    assert flat.count == 1 and flat.breaks and flat.condition == "P1" and flat.places[0].cells == (2,) and flat.remedy
    assert any(contact.overlap and set(contact.cells) == {0, 1} and contact.dimension == 2 for contact in report.contacts)
    assert "degenerate_cell" in repr(report) and "not certified" in repr(report) and "degenerate_cell: 1" in repr(flat)
    assert "NOT certified" in str(report) and report.html().startswith("<!DOCTYPE html")
    assert report.to_dict("x")["verdict"] and report.to_dict()["schema"] == 1
    np.testing.assert_array_equal(report.measures["orientation"], [1, 1, 0])
    np.testing.assert_array_equal(report.measures["volume"], [2, 2, 0])
    good = barycert.Mesh(points[:4], [[0, 1, 2], [1, 3, 2]]).check(delaunay=True)
    assert good and good.defects == [] and repr(good) == "<barycert.CheckReport: certified, 2 cells>"
    assert not barycert.Mesh(points, [[0, 1, 2], [0, 1, 3]]).check(verdict_only=True)
    assert barycert.Mesh(points[:4], [[0, 1, 2], [1, 3, 2]]).certified and not mesh.certified


def test_fields_by_name():
    points, cells = kuhn(2, 3)
    mesh = barycert.Mesh(points, cells, point_data={"temperature": np.arange(27.0), "both": np.zeros((27, 2))},
                         cell_data={"both": np.ones(len(cells)), "region": np.arange(len(cells))})
    np.testing.assert_array_equal(mesh["temperature"], np.arange(27))
    np.testing.assert_array_equal(mesh.fields["region"], mesh.cell_data["region"])
    assert list(mesh.fields) == ["temperature", "both", "cell:both", "region"] == list(mesh)
    assert len(mesh.fields) == 4 and "region" in mesh and "cell:both" in mesh.fields and "nothing" not in mesh
    assert mesh["both"].shape == (27, 2) and (mesh["cell:both"] == 1).all() and mesh["point:both"].shape == (27, 2)
    assert dict(mesh.fields).keys() == set(mesh.fields.keys())
    mesh["new"] = np.ones(27)
    mesh.fields["cell:region"] = np.zeros(len(cells))
    mesh["temperature"] = np.zeros(27)
    assert (mesh.point_data["new"] == 1).all() and not mesh.cell_data["region"].any() and not mesh["temperature"].any()
    assert mesh.sample([0.5, 0.5, 0.5], "new") == 1
    del mesh.fields["new"]
    assert "new" not in mesh
    for data in (mesh.fields, mesh, mesh.point_data):
        with pytest.raises(KeyError, match="did you mean 'temperature'"):
            data["temprature"]
    with pytest.raises(KeyError, match="there are temperature, both"):
        mesh["q"]
    with pytest.raises(barycert.Error, match="expected 27 rows for nodes, or 48 for cells"):
        mesh["other"] = np.ones(5)
