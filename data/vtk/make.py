#!/usr/bin/env python3
"""make.py STEM OUT.vtu: TetGen's STEM.node and STEM.ele as a file of the kind that pyvista's save() writes, by VTK 9.1.

VTK's writer is left at its defaults (appended, base64, zlib), as pyvista leaves it. T is the first attribute of the
nodes; id is int64 cell data; the boundary's triangles come first, as in many files of ParaView's users.
"""
import sys

import numpy as np
import vtk
from vtk.util.numpy_support import numpy_to_vtk


def rows_of(path):
    with open(path) as lines:
        rows = [line.split() for line in lines if line.strip() and not line.startswith("#")]
    return np.array([row[: len(rows[1])] for row in rows[1:]], dtype=float)


def grid_of(points, cells):
    grid = vtk.vtkUnstructuredGrid()
    grid.SetPoints(points)
    for cell in cells:
        grid.InsertNextCell(vtk.VTK_TETRA if len(cell) == 4 else vtk.VTK_TRIANGLE, len(cell), [int(node) for node in cell])
    return grid


def boundary_of(cells):
    facets = {}
    for cell in cells:
        for corner in range(4):
            facet = tuple(np.delete(cell, corner))
            facets.setdefault(frozenset(facet), []).append(facet)
    return [found[0] for found in facets.values() if len(found) == 1]


nodes, elements = rows_of(sys.argv[1] + ".node"), rows_of(sys.argv[1] + ".ele")
points = vtk.vtkPoints()
points.SetDataTypeToDouble()
points.SetData(numpy_to_vtk(nodes[:, 1:4].copy(), deep=True))
cells = (elements[:, 1:5] - nodes[0, 0]).astype(np.int64)
boundary = boundary_of(cells)
grid = grid_of(points, [*boundary, *cells])
for name, data, values in (
    ("T", grid.GetPointData(), nodes[:, 4].copy()),
    ("id", grid.GetCellData(), np.arange(len(boundary) + len(cells), dtype=np.int64)),
):
    array = numpy_to_vtk(values, deep=True)
    array.SetName(name)
    data.AddArray(array)
writer = vtk.vtkXMLUnstructuredGridWriter()
writer.SetFileName(sys.argv[2])
writer.SetInputData(grid)
sys.exit(0 if writer.Write() else 1)
