"""The plug-in in ParaView, without a window: every proxy loaded, applied, saved, judged and drawn.

pvpython tests/paraview/plugin_test.py BARYCERT PLUGIN FOLDER

BARYCERT: the program, which samples, checks and verifies the same; PLUGIN: Barycert.so; FOLDER: is made, holds files and
pictures. tests/install/paraview.sh runs this.
"""
import csv
import itertools
import json
import os
import re
import subprocess
import sys
import unittest

import numpy as np
from paraview import servermanager as sm
from paraview import simple as pv
from paraview.vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkLogger, vtkOutputWindow, vtkPoints, vtkStringOutputWindow
from vtkmodules.vtkCommonDataModel import VTK_CONVEX_POINT_SET, VTK_HEXAHEDRON, vtkImageData, vtkPolyData, vtkUnstructuredGrid
from vtkmodules.vtkIOImage import vtkPNGReader
from vtkmodules.vtkIOXML import vtkXMLDataObjectWriter

barycert, plugin, folder = sys.argv[1:4]
repository = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", ".."))
os.makedirs(folder, exist_ok=True)
pv.LoadPlugin(plugin, remote=False, ns=globals())
serial = itertools.count()


def data(name):
    return os.path.join(repository, "data", name)


def made(name):
    return os.path.join(folder, name)


def run(*args, code=0):
    done = subprocess.run([barycert, *args], capture_output=True, text=True)
    if done.returncode != code:
        raise AssertionError(f"barycert {' '.join(args)} exits with {done.returncode}\n{done.stdout}{done.stderr}")
    return done.stdout


class Messages:
    """What ParaView's window of messages would show, kept."""

    def __enter__(self):
        self.before, self.kept = vtkOutputWindow.GetInstance(), vtkStringOutputWindow()
        vtkOutputWindow.SetInstance(self.kept)
        vtkLogger.SetStderrVerbosity(vtkLogger.VERBOSITY_OFF)
        return self

    def __exit__(self, *_):
        vtkOutputWindow.SetInstance(self.before)
        vtkLogger.SetStderrVerbosity(vtkLogger.VERBOSITY_WARNING)
        self.text = self.kept.GetOutput()


def write(dataset, name):
    """Not with appended data: with libexpat1 2.5.0-1+deb12u5 ParaView 5.11 does not read back what it appends."""
    writer = vtkXMLDataObjectWriter.NewWriter(dataset.GetDataObjectType())
    path = made(f"{name}.{writer.GetDefaultFileExtension()}")
    writer.SetFileName(path)
    writer.SetInputData(dataset)
    writer.SetDataModeToBinary()
    writer.Write()
    return path


def source_of(dataset):
    return pv.OpenDataFile(write(dataset, f"source{next(serial)}"))


def points_of(x):
    points = vtkPoints()
    points.SetData(numpy_to_vtk(np.ascontiguousarray(x, dtype=np.float64), deep=1))
    made_of = vtkPolyData()
    made_of.SetPoints(points)
    return made_of


def read_mesh(stem):
    reader = pv.OpenDataFile(data(f"meshes/{stem}.node"))
    reader.UpdatePipeline()
    return reader


def broken_mesh():
    """With one node moved through its neighbours."""
    with open(data("meshes/cube-hole.node")) as file, open(made("broken.node"), "w") as copy:
        copy.write(file.read().replace("\n408 0.4", "\n408 0.5"))
    with open(data("meshes/cube-hole.ele")) as file, open(made("broken.ele"), "w") as copy:
        copy.write(file.read())
    return pv.OpenDataFile(made("broken.node"))


def arrays(attributes):
    return {attributes.GetArrayName(i): attributes.GetAbstractArray(i) for i in range(attributes.GetNumberOfArrays())}


def numbers(attributes):
    return {name: vtk_to_numpy(array) for name, array in arrays(attributes).items() if array.IsNumeric()}


def cells_of(dataset):
    return vtk_to_numpy(dataset.GetCells().GetConnectivityArray()).reshape(dataset.GetNumberOfCells(), -1)


def lines_of(path):
    """The rows of numbers of a file of TetGen, the first line apart."""
    with open(path) as file:
        rows = [line.split("#")[0].split() for line in file]
    rows = [row for row in rows if row]
    return rows[0], rows[1:]


def awkward_points(dataset):
    """Nodes; points on edges and faces, exactly there if coordinates are short dyadic numbers; points in cells; points
    outside. Of neighbours in the list one lies in the last cell that holds the other."""
    nodes, cells = vtk_to_numpy(dataset.GetPoints().GetData()), cells_of(dataset)
    corners = nodes[cells]
    some = []
    for weights in ([0.25, 0.25, 0.25, 0.25], [0.5, 0.25, 0.25, 0], [0, 0.25, 0.25, 0.5], [0.25, 0, 0.5, 0.25],
                    [0.5, 0.5, 0, 0], [0, 0, 0, 1], [1.5, -0.25, -0.25, 0]):
        some.append(np.einsum("k,nkd->nd", np.array(weights), corners))
    return np.stack(some, axis=1).reshape(-1, 3)


def sampled(stem, x):
    """Rows of `barycert sample` at the points: columns by name."""
    points = write(points_of(x), "points")
    run("sample", data("meshes/" + stem), "--points", points, "--output", made("rows.csv"), "--quiet")
    with open(made("rows.csv"), newline="") as file:
        rows = list(csv.DictReader(file))
    return {name: np.array([float(row[name]) for row in rows]) for name in rows[0] if name != "feature"}


def same_bits(a, b):
    return np.array_equal(np.asarray(a, np.float64).view(np.int64), np.asarray(b, np.float64).view(np.int64))


class PluginTest(unittest.TestCase):
    def tearDown(self):
        for source in pv.GetSources().values():
            pv.Delete(source)


class Proxies(PluginTest):
    def test_all_are_there(self):
        for group, name in (("cell_locators", "BarycertLocator"), ("sources", "BarycertTetGenReader"),
                            ("filters", "BarycertResample"), ("filters", "BarycertResampleDistributed"),
                            ("filters", "BarycertCheck")):
            definitions = sm.ProxyManager().SMProxyManager.GetProxyDefinitionManager()
            self.assertTrue(definitions.HasDefinition(group, name), name)
        for name in ("BarycertTetGenReader", "BarycertResample", "BarycertResampleDistributed", "BarycertCheck"):
            self.assertIn(name, globals())

    def test_blocks_are_offered_where_they_are_taken(self):
        mesh = read_mesh("bracket")
        blocks = pv.GroupDatasets(Input=[mesh, mesh])
        blocks.UpdatePipeline()
        for name, taken in (("BarycertResample", True), ("BarycertResampleDistributed", False)):
            properties = sm.CreateProxy("filters", name)
            for role, of_blocks in (("SourceDataArrays", False), ("DestinationMesh", taken)):
                kinds = properties.GetProperty(role).GetDomain("input_type")
                self.assertTrue(kinds.IsInDomain(mesh.SMProxy, 0), name)
                self.assertEqual(bool(kinds.IsInDomain(blocks.SMProxy, 0)), of_blocks, name)


class Reader(PluginTest):
    def test_has_the_numbers_of_the_files(self):
        for stem, base in (("cube-hole", 0), ("bracket", 1)):
            grid = sm.Fetch(read_mesh(stem))
            head, rows = lines_of(data(f"meshes/{stem}.node"))
            count, _, attributes, markers = map(int, head)
            values = np.array([[float(x) for x in row] for row in rows])
            self.assertEqual(len(values), count)
            self.assertTrue(same_bits(vtk_to_numpy(grid.GetPoints().GetData()), values[:, 1:4]))
            point_arrays = numbers(grid.GetPointData())
            self.assertEqual(list(point_arrays), [f"attribute{i}" for i in range(attributes)] + ["marker"] * markers)
            for i in range(attributes):
                self.assertTrue(same_bits(point_arrays[f"attribute{i}"], values[:, 4 + i]))
            if markers:
                self.assertTrue(np.array_equal(point_arrays["marker"], values[:, -1].astype(np.int64)))
            _, rows = lines_of(data(f"meshes/{stem}.ele"))
            self.assertTrue(np.array_equal(cells_of(grid), np.array(rows, dtype=np.int64)[:, 1:5] - base))

    def test_has_regions_markers_and_triangles(self):
        with open(made("two.node"), "w") as file:
            file.write("4 2 1 1\n1 0 0 .5 7\n2 1 0 1.5 8\n3 0 1 2.5 9\n4 1 1 0.1 -1\n")
        with open(made("two.ele"), "w") as file:
            file.write("2 3 1\n1 1 2 3 4.25\n2 2 4 3 -1\n")
        reader = pv.OpenDataFile(made("two.ele"))
        grid = sm.Fetch(reader)
        self.assertEqual(grid.GetCellType(0), 5)
        self.assertEqual(vtk_to_numpy(grid.GetPoints().GetData()).tolist(), [[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0]])
        self.assertEqual(numbers(grid.GetPointData())["marker"].tolist(), [7, 8, 9, -1])
        self.assertEqual(numbers(grid.GetPointData())["attribute0"].tolist(), [0.5, 1.5, 2.5, 0.1])
        self.assertEqual(numbers(grid.GetCellData())["attribute0"].tolist(), [4.25, -1])
        self.assertEqual(cells_of(grid).tolist(), [[0, 1, 2], [1, 3, 2]])

    def test_has_cells_of_second_order(self):
        grid = sm.Fetch(read_mesh("cube-hole-o2"))
        self.assertEqual(grid.GetCellType(0), 24)
        nodes, cells = vtk_to_numpy(grid.GetPoints().GetData()), cells_of(grid)
        for at, (a, b) in enumerate(((0, 1), (1, 2), (0, 2), (0, 3), (1, 3), (2, 3))):
            middle = (nodes[cells[:, a]] + nodes[cells[:, b]]) / 2
            self.assertLess(np.abs(nodes[cells[:, 4 + at]] - middle).max(), 1e-12)

    def test_tells_file_and_line_of_a_fault(self):
        for name, fault in (("cut", lambda text: text[:-400]), ("letter", lambda text: text.replace("\n", "\nx", 3))):
            with open(data("meshes/cube-hole.ele")) as file:
                text = file.read()
            with open(made(name + ".ele"), "w") as file:
                file.write(fault(text))
            with open(data("meshes/cube-hole.node")) as file, open(made(name + ".node"), "w") as copy:
                copy.write(file.read())
            told = subprocess.run([barycert, "check", made(name)], capture_output=True, text=True).stderr.strip()
            with Messages() as messages:
                pv.OpenDataFile(made(name + ".ele")).UpdatePipeline()
            expected = told.removeprefix("barycert: ").removeprefix("error: ")
            self.assertRegex(expected, re.escape(made(name + ".ele")) + r":\d+: ")
            self.assertIn(expected, messages.text)

    def test_series_are_steps(self):
        for step in (0, 1, 2):
            with open(made(f"step.{step}.node"), "w") as file:
                file.write(f"4 3 1 0\n0 0 0 0 {step}\n1 1 0 0 0\n2 0 1 0 0\n3 0 0 1 0\n")
            with open(made(f"step.{step}.ele"), "w") as file:
                file.write("1 4 0\n0 0 1 2 3\n")
        reader = pv.OpenDataFile([made(f"step.{step}.node") for step in (0, 1, 2)])
        self.assertEqual(list(reader.TimestepValues), [0, 1, 2])
        for step in (2, 0, 1):
            reader.UpdatePipeline(time=step)
            self.assertEqual(reader.PointData["attribute0"].GetRange(), (0, step))


class Resample(PluginTest):
    def expect_sampled(self, dataset, rows, outside=0.0):
        columns = numbers(dataset.GetPointData())
        inside = rows["cell"] >= 0
        self.assertTrue(inside.any() and not inside.all())
        self.assertTrue(np.array_equal(columns["vtkValidPointMask"], inside))
        names = [name for name in columns if name.startswith("attribute")]
        self.assertEqual(len(names), 5)
        for name in names:
            self.assertTrue(same_bits(columns[name][inside], rows[name][inside]), name)
            self.assertTrue(same_bits(columns[name][~inside], np.full((~inside).sum(), outside)), name)

    def test_has_the_values_of_barycert_sample(self):
        for stem in ("lattice-eighths", "lattice-box", "cube-hole"):
            reader = read_mesh(stem)
            x = awkward_points(sm.Fetch(reader))
            where, rows = source_of(points_of(x)), sampled(stem, x)
            self.expect_sampled(sm.Fetch(BarycertResample(SourceDataArrays=reader, DestinationMesh=where)), rows)
            ids = pv.GenerateGlobalIds(Input=reader)
            parts = BarycertResampleDistributed(SourceDataArrays=ids, DestinationMesh=where)
            self.expect_sampled(sm.Fetch(parts), rows)

    def test_saved_values_are_verified(self):
        reader = read_mesh("bracket")
        x = awkward_points(sm.Fetch(reader))
        filtered = BarycertResample(SourceDataArrays=reader, DestinationMesh=source_of(points_of(x)))
        for ending in ("vtp", "csv"):
            pv.SaveData(made("bracket." + ending), proxy=filtered, **({"Precision": 17} if ending == "csv" else {"DataMode": "Binary"}))
        run("verify", data("meshes/bracket"), "--results", made("bracket.vtp"), "--exact")
        run("verify", data("meshes/bracket"), "--results", made("bracket.csv"), "--exact")

    def test_takes_images_and_blocks(self):
        reader = read_mesh("lattice-eighths")
        image = vtkImageData()
        image.SetDimensions(21, 19, 18)
        image.SetOrigin(-0.0625, 0, 0)
        image.SetSpacing(0.0625, 0.0625, 0.0625)
        x = np.array([image.GetPoint(i) for i in range(image.GetNumberOfPoints())])
        rows = sampled("lattice-eighths", x)
        on_image = sm.Fetch(BarycertResample(SourceDataArrays=reader, DestinationMesh=source_of(image)))
        self.assertTrue(on_image.IsA("vtkImageData"))
        self.expect_sampled(on_image, rows)
        group = pv.GroupDatasets(Input=[source_of(image), source_of(points_of(x[::-1]))])
        blocks = BarycertResample(SourceDataArrays=reader, DestinationMesh=group)
        blocks.UpdatePipeline()
        result = blocks.GetClientSideObject().GetOutputDataObject(0)
        self.assertTrue(result.IsA("vtkCompositeDataSet"))
        iterator = result.NewIterator()
        first = iterator.GetCurrentDataObject()
        iterator.GoToNextItem()
        self.expect_sampled(first, rows)
        self.expect_sampled(iterator.GetCurrentDataObject(), {name: column[::-1] for name, column in rows.items()})

    def test_passes_arrays(self):
        reader = read_mesh("cube-hole")
        x = awkward_points(sm.Fetch(reader))
        where = points_of(x)
        own = numpy_to_vtk(np.arange(len(x)), deep=1)
        own.SetName("own")
        where.GetPointData().AddArray(own)
        field = numpy_to_vtk(np.array([5.0]), deep=1)
        field.SetName("of the input")
        where.GetFieldData().AddArray(field)
        source = source_of(where)
        plain = sm.Fetch(BarycertResample(SourceDataArrays=reader, DestinationMesh=source))
        self.assertNotIn("own", numbers(plain.GetPointData()))
        self.assertIn("of the input", arrays(plain.GetFieldData()))
        full = BarycertResample(SourceDataArrays=reader, DestinationMesh=source, PassPointArrays=1, PassFieldArrays=0,
                                OutsideIsNaN=1)
        full = sm.Fetch(full)
        self.assertEqual(numbers(full.GetPointData())["own"].tolist(), list(range(len(x))))
        self.assertNotIn("of the input", arrays(full.GetFieldData()))
        self.expect_sampled(full, sampled("cube-hole", x), outside=float("nan"))

    def test_takes_the_nearest_point_within_a_tolerance(self):
        reader = read_mesh("lattice-eighths")
        where = source_of(points_of([[0.5, 0.5, -0.125], [0.5, 0.5, -0.25], [0.5, 0.5, 0]]))
        near = sm.Fetch(BarycertResample(SourceDataArrays=reader, DestinationMesh=where, ComputeTolerance=0,
                                         Tolerance=0.125))
        columns = numbers(near.GetPointData())
        self.assertEqual(columns["vtkValidPointMask"].tolist(), [1, 0, 1])
        self.assertEqual(columns["attribute0"][0], columns["attribute0"][2])

    def test_takes_other_cells(self):
        grid = vtkUnstructuredGrid()
        x = [[i & 1, i >> 1 & 1, i >> 2] for i in (0, 1, 3, 2, 4, 5, 7, 6)]
        grid.SetPoints(points_of(x).GetPoints())
        grid.InsertNextCell(VTK_HEXAHEDRON, 8, list(range(8)))
        values = numpy_to_vtk(np.array([1.0 + p[0] for p in x]), deep=1)
        values.SetName("T")
        grid.GetPointData().AddArray(values)
        where = source_of(points_of([[0.5, 0.5, 0.5]]))
        for interpolation in ("Pulling", "Multilinear"):
            with Messages() as messages:
                result = sm.Fetch(BarycertResample(SourceDataArrays=source_of(grid), DestinationMesh=where,
                                                   Interpolation=interpolation, CurvedCells="Refuse"))
            self.assertEqual(messages.text, "")
            self.assertEqual(numbers(result.GetPointData())["T"].tolist(), [1.5])
        grid.InsertNextCell(VTK_CONVEX_POINT_SET, 8, list(range(8)))
        with Messages() as messages:
            BarycertResample(SourceDataArrays=source_of(grid), DestinationMesh=where).UpdatePipeline()
        self.assertIn("cannot be probed exactly: cell 1 is a vtkConvexPointSet", messages.text)


class Locator(PluginTest):
    def with_cell_numbers(self, stem):
        grid = sm.Fetch(read_mesh(stem))
        ids = numpy_to_vtk(np.arange(grid.GetNumberOfCells()), deep=1)
        ids.SetName("owner")
        grid.GetCellData().AddArray(ids)
        return grid

    def resampled(self, grid, x):
        filtered = pv.ResampleWithDataset(SourceDataArrays=source_of(grid), DestinationMesh=source_of(points_of(x)))
        self.assertIn("Barycert Locator (exact)", filtered.GetProperty("CellLocator").GetAvailable())
        filtered.CellLocator = "Barycert Locator (exact)"
        self.assertEqual(filtered.CellLocator.SMProxy.GetXMLName(), "BarycertLocator")
        return numbers(sm.Fetch(filtered).GetPointData())

    def test_finds_exact_owners_for_resample_with_dataset(self):
        # One point at a time: there is no last cell.
        grid = self.with_cell_numbers("lattice-eighths")
        x = awkward_points(grid)[:70]
        rows = sampled("lattice-eighths", x)
        for i, point in enumerate(x):
            columns = self.resampled(grid, [point])
            self.assertEqual(columns["vtkValidPointMask"][0], rows["cell"][i] >= 0)
            if rows["cell"][i] >= 0:
                self.assertEqual(columns["owner"][0], rows["cell"][i])

    def test_resample_with_dataset_keeps_the_last_cell(self):
        # VTK 9.2 asks the cell of the point before, and the locator only then: the lowest of several is not found.
        # Barycert Resample has no such memory.
        grid = self.with_cell_numbers("lattice-eighths")
        x = awkward_points(grid)
        owners = sampled("lattice-eighths", x)["cell"]
        inside = owners >= 0
        by_vtk = self.resampled(grid, x)["owner"]
        wrong = (by_vtk != owners)[inside].sum()
        print(f"Resample With Dataset with the locator: {wrong} of {inside.sum()} points have another owner than the "
              "lowest cell that holds them")
        self.assertGreater(wrong, 0)
        exact = sm.Fetch(BarycertResample(SourceDataArrays=source_of(grid), DestinationMesh=source_of(points_of(x))))
        self.assertTrue(np.array_equal(numbers(exact.GetPointData())["owner"][inside], owners[inside]))


class Check(PluginTest):
    def expect_measures(self, mesh, grid, code):
        run("check", mesh, "--vtu", made("check.vtu"), "--vtk-data", "ascii", "--json", made("check.json"), "--quiet", code=code)
        expected = numbers(sm.Fetch(pv.OpenDataFile(made("check.vtu"))).GetCellData())
        found = numbers(grid.GetCellData())
        for name in ("orientation", "volume", "condition", "radius_edge", "aspect", "min_angle", "max_angle", "problems"):
            self.assertTrue(same_bits(found[name], expected[name]), name)
        with open(made("check.json")) as file:
            return json.load(file), found

    def test_certifies(self):
        for stem in ("cube-hole", "cube-hole-o2", "plate"):
            check = BarycertCheck(Input=read_mesh(stem))
            grid = sm.Fetch(check)
            self.expect_measures(data("meshes/" + stem), grid, 0)
            fields = arrays(grid.GetFieldData())
            self.assertEqual(fields["certified"].GetTuple1(0), 1)
            self.assertIn("certified", fields["barycert_check"].GetValue(0))
            self.assertEqual(check[1].GetDataInformation().GetNumberOfRows(), 0)
            self.assertEqual(check[2].GetDataInformation().GetNumberOfPoints(), 0)

    def test_marks_what_is_broken(self):
        check = BarycertCheck(Input=broken_mesh())
        with Messages() as messages:
            grid = sm.Fetch(check)
        self.assertIn("input: NOT certified: 39 pairs of cells overlap", messages.text)
        report, found = self.expect_measures(made("broken"), grid, 1)
        fields = arrays(grid.GetFieldData())
        self.assertEqual(fields["certified"].GetTuple1(0), 0)
        self.assertIn("NOT certified: 39 pairs of cells overlap", fields["barycert_check"].GetValue(0))
        self.assertGreater(found["overlapping_cells"].sum(), 0)
        self.assertEqual((found["orientation"] < 0).sum(), 1)
        self.assertEqual(found["mixed_orientation"].tolist(), (found["orientation"] < 0).astype(int).tolist())
        table = sm.Fetch(check, idx=1)
        column = lambda name: [table.GetValueByName(row, name) for row in range(table.GetNumberOfRows())]
        counts = {name.ToString(): count.ToInt() for name, count in zip(column("defect"), column("count"))}
        self.assertEqual(counts["overlapping_cells"], 39)
        self.assertEqual(counts["same_side"], 4)
        self.assertEqual({defect["name"]: defect["count"] for defect in report["findings"]}, counts)
        self.assertIn("cells 195 717, points 289 189 33", column("places")[0].ToString())
        common = sm.Fetch(check, idx=2)
        self.assertEqual(common.GetNumberOfPoints(), 20)
        self.assertEqual(numbers(common.GetPointData())["overlap"].tolist(), [1] * 20)
        self.assertEqual(numbers(common.GetPointData())["cell_a"].tolist()[:2], [116, 116])

    def test_blocks_are_checked_one_by_one(self):
        group = pv.GroupDatasets(Input=[read_mesh("cube-hole"), broken_mesh()])
        check = BarycertCheck(Input=group)
        check.UpdatePipeline()
        result = check.GetClientSideObject().GetOutputDataObject(0)
        iterator = result.NewIterator()
        certified = []
        while not iterator.IsDoneWithTraversal():
            certified.append(iterator.GetCurrentDataObject().GetFieldData().GetArray("certified").GetTuple1(0))
            iterator.GoToNextItem()
        self.assertEqual(certified, [1, 0])

    def test_takes_cells_whose_corners_are_known(self):
        with Messages() as messages:
            pv.SetActiveSource(None)
            check = BarycertCheck(Input=pv.Wavelet())
            fields = arrays(sm.Fetch(check).GetFieldData())
        self.assertEqual(messages.text, "")
        self.assertEqual(fields["certified"].GetTuple1(0), 1)
        grid = vtkUnstructuredGrid()
        grid.SetPoints(points_of([[i & 1, i >> 1 & 1, i >> 2] for i in (0, 1, 3, 2, 4, 5, 7, 6)]).GetPoints())
        grid.InsertNextCell(VTK_CONVEX_POINT_SET, 8, list(range(8)))
        with Messages() as messages:
            BarycertCheck(Input=source_of(grid)).UpdatePipeline()
        self.assertIn("cannot be checked: cell 0 is a vtkConvexPointSet", messages.text)


class Session(PluginTest):
    def test_state_comes_back(self):
        reader = read_mesh("cube-hole")
        x = awkward_points(sm.Fetch(reader))[:500]
        where = source_of(points_of(x))
        filtered = BarycertResample(registrationName="exact", SourceDataArrays=reader, DestinationMesh=where)
        vtks = pv.ResampleWithDataset(registrationName="located", SourceDataArrays=reader, DestinationMesh=where)
        vtks.CellLocator = "Barycert Locator (exact)"
        BarycertCheck(registrationName="checked", Input=reader, Contacts=7)
        before = numbers(sm.Fetch(filtered).GetPointData())
        pv.SaveState(made("state.pvsm"))
        pv.ResetSession()
        pv.LoadState(made("state.pvsm"))
        after = numbers(sm.Fetch(pv.FindSource("exact")).GetPointData())
        self.assertEqual(list(before), list(after))
        for name in before:
            self.assertTrue(np.array_equal(before[name], after[name]))
        self.assertEqual(pv.FindSource("located").CellLocator.SMProxy.GetXMLName(), "BarycertLocator")
        self.assertEqual(pv.FindSource("checked").Contacts, 7)


class Picture(PluginTest):
    def colours(self, view, name):
        pv.SaveScreenshot(made(name), view)
        reader = vtkPNGReader()
        reader.SetFileName(made(name))
        reader.Update()
        pixels = vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars())[:, :3]
        return {tuple(colour) for colour in pixels[:: 3]}

    def test_of_what_is_broken(self):
        mesh = broken_mesh()
        check = BarycertCheck(Input=mesh)
        view = pv.CreateRenderView(ViewSize=[500, 400], Background=[1, 1, 1], UseColorPaletteForBackground=0)
        pv.Show(mesh, view, Representation="Wireframe", AmbientColor=[0.8, 0.8, 0.8], DiffuseColor=[0.8, 0.8, 0.8])
        bad = pv.Threshold(Input=check, Scalars=["CELLS", "overlapping_cells"], LowerThreshold=1, UpperThreshold=1)
        shown = pv.Show(bad, view, Representation="Surface With Edges", Opacity=0.6)
        pv.ColorBy(shown, ("CELLS", "volume"))
        pv.Show(check[2], view, PointSize=8, AmbientColor=[1, 0, 0], DiffuseColor=[1, 0, 0])
        pv.ResetCamera(view)
        self.assertGreater(len(self.colours(view, "broken.png")), 100)

    def test_of_values_on_an_image(self):
        image = vtkImageData()
        image.SetDimensions(40, 40, 40)
        image.SetOrigin(-0.05, -0.05, -0.05)
        image.SetSpacing(1.1 / 39, 1.1 / 39, 1.1 / 39)
        values = BarycertResample(SourceDataArrays=read_mesh("cube-hole"), DestinationMesh=source_of(image), OutsideIsNaN=1)
        view = pv.CreateRenderView(ViewSize=[500, 400], Background=[1, 1, 1], UseColorPaletteForBackground=0)
        middle = pv.Slice(Input=values, SliceType="Plane")
        middle.SliceType.Origin = [0.5, 0.5, 0.5]
        piece = pv.Show(middle, view)
        pv.ColorBy(piece, ("POINTS", "attribute1"))
        view.CameraPosition, view.CameraFocalPoint = [3, 0.5, 0.5], [0.5, 0.5, 0.5]
        view.CameraViewUp = [0, 0, 1]
        self.assertGreater(len(self.colours(view, "values.png")), 100)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
