"""SciPy's Delaunay.find_simplex and LinearNDInterpolator at points of faces, edges and nodes of their triangulation.

Nodes: random in the unit square (cube), the same far from the origin, and in a thin layer. Points: nodes; points of
edges and faces, rounded; random ones inside. The judge takes the triangulation that SciPy made.
"""

import numpy
import scipy
from scipy.interpolate import LinearNDInterpolator
from scipy.spatial import Delaunay

from finding import TemporaryDirectory, points_on, report, verify, wavy, write_mesh, write_rows


def place(unit, where):
    if where == "far":
        return unit + 1000
    if where == "thin":
        return unit * numpy.append(numpy.ones(unit.shape[1] - 1), 1e-9)
    return unit


figures, rows, wrong_cell, missed, undefined = {}, 0, 0, 0, 0
with TemporaryDirectory() as folder:
    for dimension, count in ((2, 2000), (3, 500)):
        for where in ("unit", "far", "thin"):
            random = numpy.random.default_rng(3)
            unit = random.random((count, dimension))
            nodes, values = place(unit, where), wavy(unit)
            triangulation = Delaunay(nodes)
            simplices = triangulation.simplices
            interpolate = LinearNDInterpolator(triangulation, values)
            mesh = write_mesh(folder + "/mesh", nodes, simplices, values)
            sets = {"nodes": nodes, "inside": points_on(nodes, simplices, dimension + 1, 10000, random),
                    "edges": points_on(nodes, simplices, 2, 10000, random)}
            if dimension == 3:
                sets["faces"] = points_on(nodes, simplices, 3, 10000, random)
            for name, points in sets.items():
                owners = verify(mesh, write_rows(folder + "/rows.npy", points,
                                                 cell=triangulation.find_simplex(points).astype(numpy.int64)))
                sampled = verify(mesh, write_rows(folder + "/rows.npy", points, attribute0=interpolate(points)))
                figures[f"{dimension}D {where} {name}"] = {
                    "points": owners["rows"], "inside": owners["inside"],
                    "find_simplex": {k: owners[k] for k in ("missed", "invented", "wrong_cell")},
                    "LinearNDInterpolator": {**{k: sampled[k] for k in ("missed", "invented", "wrong_value")},
                                             "largest_error": sampled["values"][0]["max_error"]}}
                rows += owners["rows"]
                wrong_cell += owners["wrong_cell"]
                missed += owners["missed"]
                undefined += sampled["missed"]

report(f"SciPy {scipy.__version__}", "SciPy 1.10.1", wrong_cell > rows // 100,
       f"of {rows} points find_simplex gives {wrong_cell} to a simplex that does not contain them and loses {missed} that "
       f"are inside; LinearNDInterpolator returns nan for {undefined} inside",
       points=rows, wrong_cell=wrong_cell, missed=missed, nan_inside=undefined, by_set=figures)
