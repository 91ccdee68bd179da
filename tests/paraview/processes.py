"""Values that do not depend on the number of processes: mpirun -n N pvbatch tests/paraview/processes.py PLUGIN FILE.csv

Every process has a part of the image, and shares points with its neighbours; of the mesh all (Barycert Resample) or a part
(distributed). A line each tells how many processes there were, and of all rows in FILE.csv, each once, how many there are,
how many lie in the mesh, and their hash.
"""
import hashlib
import os
import sys

import numpy as np
from paraview import simple
from vtkmodules.vtkParallelCore import vtkMultiProcessController

plugin, path = sys.argv[1:3]
simple.LoadPlugin(plugin, remote=False, ns=globals())
here = os.path.dirname(os.path.abspath(__file__))
mesh = simple.OpenDataFile(os.path.join(here, "..", "..", "data", "meshes", "lattice-eighths.node"))
image = simple.Transform(Input=simple.Wavelet(WholeExtent=[-2, 34, -2, 34, -2, 34]), Transform="Transform")
image.Transform.Scale = [1 / 32, 1 / 32, 1 / 32]
processes = vtkMultiProcessController.GetGlobalController().GetNumberOfProcesses()


def tell(words, values):
    simple.SaveData(path, proxy=values, Precision=17)
    table = np.genfromtxt(path, delimiter=",", names=True)
    names = sorted(name for name in table.dtype.names if name.startswith(("Points", "attribute", "vtkValid")))
    rows = np.unique(np.stack([table[name] for name in names], axis=1), axis=0)
    inside = int(rows[:, names.index("vtkValidPointMask")].sum())
    print(f"{processes} {words}: {len(rows)} rows, {inside} inside, {hashlib.sha256(rows.tobytes()).hexdigest()}")


tell("processes", BarycertResample(SourceDataArrays=mesh, DestinationMesh=image))
parts = simple.RedistributeDataSet(Input=mesh)
tell("processes, distributed", BarycertResampleDistributed(SourceDataArrays=parts, DestinationMesh=image))
