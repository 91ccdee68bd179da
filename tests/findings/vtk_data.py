"""Meshes for VTK, and its files."""

import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints, vtkSMPTools, vtkVersion
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkImageData, vtkUnstructuredGrid
from vtkmodules.vtkFiltersCore import vtkProbeFilter

VERSION = "VTK " + vtkVersion.GetVTKVersion()
TETRAHEDRON = 10


def points_of(coordinates):
    points = vtkPoints()
    points.SetDataTypeToDouble()
    points.SetData(numpy_to_vtk(coordinates, deep=1))
    return points


def named(array, name):
    array.SetName(name)
    return array


def grid_of(nodes, simplices, values):
    """Tetrahedra with the field f of nodes, and the field cell of cells: their numbers."""
    grid = vtkUnstructuredGrid()
    grid.SetPoints(points_of(nodes))
    cells = vtkCellArray()
    offsets = numpy.arange(0, 4 * len(simplices) + 1, 4, dtype=numpy.int64)
    cells.SetData(numpy_to_vtkIdTypeArray(offsets, deep=1),
                  numpy_to_vtkIdTypeArray(simplices.astype(numpy.int64).ravel(), deep=1))
    grid.SetCells(TETRAHEDRON, cells)
    grid.GetPointData().AddArray(named(numpy_to_vtk(values, deep=1), "f"))
    grid.GetCellData().AddArray(named(numpy_to_vtk(numpy.arange(len(simplices), dtype=numpy.int64), deep=1), "cell"))
    return grid


def image_of(side, spacing):
    image = vtkImageData()
    image.SetDimensions(side, side, side)
    image.SetOrigin(0, 0, 0)
    image.SetSpacing(spacing, spacing, spacing)
    return image


def probe(grid, where):
    """vtkProbeFilter as it is."""
    filter = vtkProbeFilter()
    filter.SetInputData(where)
    filter.SetSourceData(grid)
    filter.Update()
    return filter.GetOutput()


def array(data, name):
    return vtk_to_numpy(data.GetPointData().GetArray(name)).copy()


def use_threads(count):
    """1: no threads. Otherwise as many of TBB's; returns False if this VTK has no TBB."""
    if count == 1:
        return vtkSMPTools.SetBackend("Sequential")
    if not vtkSMPTools.SetBackend("TBB"):
        return False
    vtkSMPTools.Initialize(count)
    return True


def write(writer, data, path):
    writer.SetInputData(data)
    writer.SetFileName(path)
    if not writer.Write():
        raise RuntimeError("VTK cannot write " + path)
    return path
