"""SciPy's LinearNDInterpolator on nodes of a lattice: flat simplices, and values that jump on faces.

Nodes: 9^3 of a lattice in the unit cube. The eight nodes of each small cube lie on one sphere, so that the Delaunay
triangulation is not unique; Qhull's has simplices of volume zero. Points: of faces, rounded to double; random ones. The
judge takes the triangulation that SciPy made: a value is right if any simplex of positive volume that contains the point
gives it. The same with nodes that are shaken by a millionth.
"""

import numpy
import scipy
from scipy.interpolate import LinearNDInterpolator
from scipy.spatial import Delaunay

from finding import TemporaryDirectory, lattice, points_on, report, shaken, verify, wavy, write_mesh, write_rows

figures = {}
with TemporaryDirectory() as folder:
    for name, by in (("lattice", 0), ("shaken", 1e-6)):
        nodes = shaken(lattice(8)[0], by, seed=1)
        values = wavy(nodes)
        triangulation = Delaunay(nodes)
        simplices = triangulation.simplices
        a, b, c, d = (nodes[simplices[:, k]] for k in range(4))
        volumes = numpy.einsum("ij,ij->i", numpy.cross(b - a, c - a), d - a) / 6
        figures[name] = {"simplices": len(simplices), "flat": int((abs(volumes) < 1e-18).sum())}
        interpolate = LinearNDInterpolator(triangulation, values)
        mesh = write_mesh(folder + "/mesh", nodes, simplices, values)
        random = numpy.random.default_rng(1)
        for which, points in (("faces", points_on(nodes, simplices, 3, 20000, random)),
                              ("random", random.random((20000, 3)))):
            verdicts = verify(mesh, write_rows(folder + "/rows.npy", points, attribute0=interpolate(points)))
            figures[name][which] = {k: verdicts[k] for k in ("rows", "missed", "invented", "wrong_value")}
            figures[name][which]["largest_error"] = verdicts["values"][0]["max_error"]

plain = figures["lattice"]
report(f"SciPy {scipy.__version__}", "SciPy 1.10.1", plain["flat"] > 0 and plain["faces"]["wrong_value"] > 0,
       f"{plain['flat']} of {plain['simplices']} simplices have volume 0; {plain['faces']['wrong_value']} of "
       f"{plain['faces']['rows']} points of faces get a value that no simplex has there, off by up to "
       f"{plain['faces']['largest_error']:.2g} of the range; {plain['random']['wrong_value']} of "
       f"{plain['random']['rows']} random ones", **figures)
