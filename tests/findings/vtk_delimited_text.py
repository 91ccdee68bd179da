"""vtkDelimitedTextWriter on the output of vtkProbeFilter: six digits, and a mask that is no text.

Points: random in the unit cube, which the mesh fills; its field is linear. The points carry their coordinates as arrays x,
y, z, so that they are in the file; VTK probes them and writes a CSV file, which the judge reads. It does not look at the
mask, whose numbers are written as control characters.
"""

import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkFiltersCore import vtkProbeFilter
from vtkmodules.vtkInfovisCore import vtkDataObjectToTable
from vtkmodules.vtkIOCore import vtkDelimitedTextWriter
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter, vtkXMLUnstructuredGridWriter

from finding import TemporaryDirectory, lattice, report, shaken, verify
from vtk_data import VERSION, grid_of, named, points_of, use_threads, write

use_threads(1)
nodes, cells = lattice(8)
nodes = shaken(nodes, 0.02, seed=3)
grid = grid_of(nodes, cells, nodes @ [1.0, 2.0, 3.0])
coordinates = numpy.random.default_rng(0).random((20000, 3))
points = vtkPolyData()
points.SetPoints(points_of(coordinates))
for k, axis in enumerate("xyz"):
    points.GetPointData().AddArray(named(numpy_to_vtk(coordinates[:, k].copy(), deep=1), axis))
filter = vtkProbeFilter()
filter.SetInputData(points)
filter.SetSourceData(grid)
filter.PassPointArraysOn()
filter.Update()
with TemporaryDirectory() as folder:
    mesh = write(vtkXMLUnstructuredGridWriter(), grid, folder + "/mesh.vtu")
    xml = verify(mesh, write(vtkXMLPolyDataWriter(), filter.GetOutput(), folder + "/probed.vtp"))
    table = vtkDataObjectToTable()
    table.SetInputConnection(filter.GetOutputPort())
    table.SetFieldType(vtkDataObjectToTable.POINT_DATA)
    writer = vtkDelimitedTextWriter()
    writer.SetInputConnection(table.GetOutputPort())
    writer.SetFileName(folder + "/probed.csv")
    writer.Write()
    text = verify(mesh, folder + "/probed.csv", "--mask-column", "none", "--tolerance", "1e-9")
    with open(folder + "/probed.csv", "rb") as file:
        controls = sum(c < 32 and c not in b"\r\n\t" for c in file.read())

off, exact = text["values"][0], xml["values"][0]
report(VERSION, "VTK 9.1.0", off["over"] > 10000 and exact["over"] == 0 and controls == 20000,
       f"{off['over']} of {xml['rows']} values off by more than 1e-9 of the range, by up to {off['max_error']:.2g} (in VTK's "
       f"XML file {exact['over']}, {exact['max_error']:.2g}); {controls} control characters for the mask",
       rows=xml["rows"], values_off_in_csv=off["over"], largest_error_in_csv=off["max_error"],
       values_off_in_xml=exact["over"], largest_error_in_xml=exact["max_error"], control_characters=controls)
