"""Points beyond a face of a cell by half a thousandth of its height: VTK's locators give many of them to that cell.

Mesh: the unit cube in 10^3 small cubes of six tetrahedra, inner nodes shaken. Points: 0.0005 of the height of a random
cell beyond one of its faces, those in the cube; each lies clearly in another cell. `FindCell` gives the cell, its
weights the value.
"""

import numpy
from vtkmodules.vtkCommonDataModel import vtkCellLocator, vtkGenericCell, vtkStaticCellLocator
from vtkmodules.vtkFiltersGeneral import vtkCellTreeLocator

from finding import TemporaryDirectory, lattice, report, shaken, verify, wavy, write_mesh, write_rows
from vtk_data import VERSION, grid_of

nodes, cells = lattice(10)
nodes = shaken(nodes, 0.015, seed=3)
field = wavy(nodes)
grid = grid_of(nodes, cells, field)

random = numpy.random.default_rng(0)
cell = random.integers(len(cells), size=20000)
corners = nodes[cells[cell]]
foot = (random.dirichlet(numpy.ones(3), len(cell))[:, :, None] * corners[:, :3]).sum(1)
points = foot - 5e-4 * (corners[:, 3] - foot)
points = points[numpy.all((points > 0) & (points < 1), axis=1)]

figures = {"points": len(points)}
with TemporaryDirectory() as folder:
    mesh = write_mesh(folder + "/mesh", nodes, cells, field)
    for kind in (vtkStaticCellLocator, vtkCellTreeLocator, vtkCellLocator):
        locator, found, weights = kind(), vtkGenericCell(), [0.0] * 8
        locator.SetDataSet(grid)
        locator.BuildLocator()
        owners = numpy.zeros(len(points), numpy.int64)
        values = numpy.full(len(points), numpy.nan)
        for i, point in enumerate(points.tolist()):
            owners[i] = locator.FindCell(point, 0.0, found, [0.0] * 3, weights)
            if owners[i] >= 0:
                values[i] = numpy.dot(weights[:4], field[cells[owners[i]]])
        verdicts = verify(mesh, write_rows(folder + "/rows.npy", points, cell=owners, attribute0=values))
        figures[kind.__name__] = {k: verdicts[k] for k in ("missed", "wrong_cell")}
        figures[kind.__name__]["largest_value_error"] = verdicts["values"][0]["max_error"]

wrong = {k: v["wrong_cell"] for k, v in figures.items() if k != "points"}
report(VERSION, "VTK 9.1.0", min(wrong.values()) > len(points) // 4,
       f"of {len(points)} points outside the cell that is returned: " + ", ".join(f"{n} by {k}" for k, n in wrong.items()),
       **figures)
