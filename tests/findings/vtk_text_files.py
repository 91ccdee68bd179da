"""VTK's text files: what its own writers write, its own readers do not read back.

Mesh: the unit cube in 4^3 small cubes of six tetrahedra, inner nodes shaken, in the legacy format and in XML, both as text.
Once as it is; once with one value that is NaN, as results outside a mesh often are; once with one that is infinite.
"""

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkObject
from vtkmodules.vtkIOLegacy import vtkUnstructuredGridReader, vtkUnstructuredGridWriter
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader, vtkXMLUnstructuredGridWriter

from finding import TemporaryDirectory, lattice, report, shaken, wavy
from vtk_data import VERSION, grid_of, write

nodes, cells = lattice(4)
nodes = shaken(nodes, 0.03, seed=1)
values = wavy(nodes)
fields = {"": values, " with NaN": values.copy(), " with infinity": values.copy()}
fields[" with NaN"][3], fields[" with infinity"][3] = numpy.nan, numpy.inf
vtkObject.GlobalWarningDisplayOff()

figures = {}
with TemporaryDirectory() as folder:
    for name, writer, reader, as_text in (
            ("legacy", vtkUnstructuredGridWriter, vtkUnstructuredGridReader, "SetFileTypeToASCII"),
            ("xml", vtkXMLUnstructuredGridWriter, vtkXMLUnstructuredGridReader, "SetDataModeToAscii")):
        for which, field in fields.items():
            out, back = writer(), reader()
            getattr(out, as_text)()
            back.SetFileName(write(out, grid_of(nodes, cells, field), folder + "/file"))
            back.Update()
            mesh = back.GetOutput()
            array = mesh.GetPointData().GetArray("f")
            read = vtk_to_numpy(mesh.GetPoints().GetData()) if mesh.GetNumberOfPoints() else numpy.zeros((0, 3))
            got = vtk_to_numpy(array) if array else numpy.zeros(0)
            counts = {"points": len(read), "cells": mesh.GetNumberOfCells(), "values": len(got)}
            if len(read) == len(nodes):
                counts["coordinates_changed"] = int((read != nodes).sum())
                counts["largest_change"] = float(abs(read - nodes).max())
            if len(got) == len(field):
                counts["values_changed"] = int((~((got == field) | (numpy.isnan(got) & numpy.isnan(field)))).sum())
            figures[name + which] = counts

legacy, nan, infinite = figures["legacy"], figures["legacy with NaN"], figures["xml with infinity"]
report(VERSION, "VTK 9.1.0",
       legacy["coordinates_changed"] > 0 and infinite["points"] == 0 and figures["xml"]["coordinates_changed"] == 0,
       f"legacy: {legacy['coordinates_changed']} of {nodes.size} coordinates come back changed, by up to "
       f"{legacy['largest_change']:.2g}, and {legacy['values_changed']} of {len(values)} values, "
       f"{nan['values_changed']} if one of them is NaN; XML: {figures['xml']['coordinates_changed']}, but if one value is "
       f"infinite {infinite['points']} of {len(nodes)} points come back", **figures)
