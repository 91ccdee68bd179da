"""vtkProbeFilter onto an image, twice the same with two threads: other cells, other values.

Mesh: the unit cube in 16^3 small cubes of six tetrahedra, in random order. Image: 65^3 voxels, so that many lie
exactly on faces that cells share. Each run writes the number of the cell and the interpolated value into every voxel.
"""

import numpy

from finding import lattice, report, wavy
from vtk_data import VERSION, array, grid_of, image_of, probe, use_threads

nodes, cells = lattice(16)
cells = cells[numpy.random.default_rng(1).permutation(len(cells))]
grid = grid_of(nodes, cells, wavy(nodes))


def runs(count):
    """Voxels whose owner, or value, is not the same in all runs; the largest difference of a value."""
    results = [probe(grid, image_of(65, 1 / 64)) for _ in range(count)]
    owners = numpy.stack([array(r, "cell") for r in results])
    values = numpy.stack([array(r, "f") for r in results])
    differ = (owners != owners[0]).any(0)
    return int(differ.sum()), int((values != values[0]).any(0).sum()), float(numpy.ptp(values, axis=0).max())


use_threads(1)
alone, alone_values, _ = runs(3)
threads = use_threads(2)
owners, values, spread = runs(5) if threads else (0, 0, 0.0)
report(VERSION, "VTK 9.1.0", owners > 0 and alone == 0 and alone_values == 0,
       f"{owners} of {65**3} owners and {values} values differ between five runs with two threads, by up to "
       f"{spread:.2g}; {alone} owners with one thread",
       voxels=65**3, owners_that_differ=owners, values_that_differ=values, largest_difference=spread,
       owners_that_differ_with_one_thread=alone)
