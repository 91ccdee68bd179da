"""vtkProbeFilter onto an image, the same five times with two threads: other cells, other values.

Meshes: the unit cube in small cubes of six tetrahedra, in random order; one with inner nodes shaken, and one that is not, so
that many voxels lie exactly on faces that cells share. Each run writes the number of the cell and the interpolated value
into every voxel. Two threads have to run at the same time: with less than two processors it may not be seen.
"""

import numpy

from finding import lattice, report, shaken, wavy
from vtk_data import VERSION, array, grid_of, image_of, probe, use_threads


def runs(grid, side, count):
    """Voxels whose owner, or value, is not the same in all runs; the largest difference of a value."""
    results = [probe(grid, image_of(side, 1 / (side - 1))) for _ in range(count)]
    owners = numpy.stack([array(r, "cell") for r in results])
    values = numpy.stack([array(r, "f") for r in results])
    return {"voxels": side**3, "owners_that_differ": int((owners != owners[0]).any(0).sum()),
            "values_that_differ": int((values != values[0]).any(0).sum()),
            "largest_difference": float(numpy.ptp(values, axis=0).max() / numpy.ptp(values))}


figures = {}
for name, cubes, by, side in (("aligned", 16, 0, 65), ("shaken", 24, 0.15 / 24, 128)):
    nodes, cells = lattice(cubes)
    nodes = shaken(nodes, by, seed=5)
    cells = cells[numpy.random.default_rng(1).permutation(len(cells))]
    grid = grid_of(nodes, cells, wavy(nodes))
    use_threads(1)
    figures[name + ", one thread"] = runs(grid, side, 2)
    figures[name + ", two threads"] = runs(grid, side, 5) if use_threads(2) else {}

aligned, loose = (figures[f"{name}, two threads"] for name in ("aligned", "shaken"))
alone = sum(figures[f"{name}, one thread"][k] for name in ("aligned", "shaken")
            for k in ("owners_that_differ", "values_that_differ"))
report(VERSION, "VTK 9.1.0",
       aligned and aligned["owners_that_differ"] + loose["values_that_differ"] > 0 and alone == 0,
       f"five runs with two threads differ in {aligned['owners_that_differ']} of {aligned['voxels']} owners on the aligned "
       f"mesh; in {loose['values_that_differ']} of {loose['voxels']} values on the other, by up to "
       f"{loose['largest_difference']:.2g} of the range; with one thread in {alone}"
       if aligned else "this VTK has no threads of TBB", **figures)
