"""vtkProbeFilter as it is, on a mesh of thin cells: points inside are masked out.

Mesh: a plate of 1 x 1 x 1/100 in 8^3 small boxes of six tetrahedra, inner nodes shaken. Points: random ones inside.
The same with a vtkStaticCellLocator as prototype.
"""

import numpy
from vtkmodules.vtkCommonDataModel import vtkPolyData, vtkStaticCellLocator
from vtkmodules.vtkFiltersCore import vtkProbeFilter
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter, vtkXMLUnstructuredGridWriter

from finding import TemporaryDirectory, lattice, points_on, report, shaken, verify, wavy
from vtk_data import VERSION, grid_of, points_of, use_threads, write

use_threads(1)
unit, cells = lattice(8)
unit = shaken(unit, 0.15 / 8, seed=3)
missed, inside = {}, 0
with TemporaryDirectory() as folder:
    for thinner in (1, 10, 100, 1000):
        nodes = unit * [1, 1, 1 / thinner]
        grid = grid_of(nodes, cells, wavy(unit))
        mesh = write(vtkXMLUnstructuredGridWriter(), grid, folder + "/mesh.vtu")
        points = vtkPolyData()
        points.SetPoints(points_of(points_on(nodes, cells, 4, 20000, numpy.random.default_rng(1))))
        for name, prototype in (("as it is", None), ("with vtkStaticCellLocator", vtkStaticCellLocator())):
            filter = vtkProbeFilter()
            filter.SetInputData(points)
            filter.SetSourceData(grid)
            if prototype:
                filter.SetCellLocatorPrototype(prototype)
            filter.Update()
            verdicts = verify(mesh, write(vtkXMLPolyDataWriter(), filter.GetOutput(), folder + "/probed.vtp"))
            missed[f"1/{thinner}, {name}"] = verdicts["missed"]
            inside = verdicts["inside"]

report(VERSION, "VTK 9.1.0", missed["1/100, as it is"] > 1000 and missed["1/100, with vtkStaticCellLocator"] == 0,
       f"of {inside} points inside a plate of thickness 1/10, 1/100, 1/1000 " +
       ", ".join(str(missed[f"1/{k}, as it is"]) for k in (10, 100, 1000)) + " are masked out; with vtkStaticCellLocator " +
       ", ".join(str(missed[f"1/{k}, with vtkStaticCellLocator"]) for k in (10, 100, 1000)), inside=inside, missed=missed)
