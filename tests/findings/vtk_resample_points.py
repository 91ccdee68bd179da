"""vtkResampleWithDataSet onto points without cells ends the process.

Input: polygon data with points alone. Three processes: as it is; without MarkBlankPointsAndCells; with a vertex cell for
each point.
"""

import os
import resource
import signal

import numpy
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkFiltersCore import vtkResampleWithDataSet

from finding import lattice, report, wavy
from vtk_data import VERSION, grid_of, points_of

nodes, cells = lattice(2)
grid = grid_of(nodes, cells, wavy(nodes))


def ended(mark, vertices):
    """How a process ends that resamples."""
    child = os.fork()
    if child == 0:
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
        points = vtkPolyData()
        points.SetPoints(points_of(numpy.random.default_rng(0).random((10, 3))))
        if vertices:
            ones = vtkCellArray()
            for i in range(10):
                ones.InsertNextCell(1, [i])
            points.SetVerts(ones)
        filter = vtkResampleWithDataSet()
        filter.SetInputDataObject(0, points)
        filter.SetSourceData(grid)
        filter.SetMarkBlankPointsAndCells(mark)
        filter.Update()
        os._exit(0 if filter.GetOutputDataObject(0).GetNumberOfPoints() == 10 else 1)
    status = os.waitpid(child, 0)[1]
    return signal.Signals(os.WTERMSIG(status)).name if os.WIFSIGNALED(status) else f"exit code {os.WEXITSTATUS(status)}"


ends = {"as it is": ended(True, False), "without marking": ended(False, False), "with vertices": ended(True, True)}
report(VERSION, "VTK 9.1.0", ends["as it is"] == "SIGSEGV" and ends["with vertices"] == "exit code 0",
       "; ".join(f"{k}: {v}" for k, v in ends.items()), **ends)
