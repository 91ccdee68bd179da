"""vtkCellTreeLocator on a mesh far from the origin: points inside are not found.

Mesh: a cube of side 10 in 10^3 small cubes of six tetrahedra at the place (500000, 4500000, 0), as maps in metres have
it. Points: random ones in the cube. vtkStaticCellLocator gets the same.
"""

import numpy
from vtkmodules.vtkCommonDataModel import vtkGenericCell, vtkStaticCellLocator
from vtkmodules.vtkFiltersGeneral import vtkCellTreeLocator

from finding import TemporaryDirectory, lattice, report, shaken, verify, wavy, write_mesh, write_rows
from vtk_data import VERSION, grid_of

unit, cells = lattice(10)
unit = shaken(unit, 0.015, seed=3)
field = wavy(unit)
nodes = 10 * unit + [500000, 4500000, 0]
grid = grid_of(nodes, cells, field)
points = 10 * numpy.random.default_rng(0).random((20000, 3)) + [500000, 4500000, 0]

missed, wrong = {}, {}
with TemporaryDirectory() as folder:
    mesh = write_mesh(folder + "/mesh", nodes, cells, field)
    for kind in (vtkCellTreeLocator, vtkStaticCellLocator):
        locator, found = kind(), vtkGenericCell()
        locator.SetDataSet(grid)
        locator.BuildLocator()
        owners = [locator.FindCell(p, 0.0, found, [0.0] * 3, [0.0] * 8) for p in points.tolist()]
        verdicts = verify(mesh, write_rows(folder + "/rows.npy", points, cell=numpy.array(owners)))
        missed[kind.__name__] = verdicts["missed"]
        wrong[kind.__name__] = verdicts["wrong_cell"]
        inside = verdicts["inside"]

tree, static = missed["vtkCellTreeLocator"], missed["vtkStaticCellLocator"]
report(VERSION, "VTK 9.1.0", tree > 100 * max(static, 1),
       f"vtkCellTreeLocator finds no cell for {tree} of {inside} points inside; vtkStaticCellLocator for {static}",
       inside=inside, missed=missed, wrong_cell=wrong)
