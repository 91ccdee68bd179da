"""matplotlib's TrapezoidMapTriFinder and LinearTriInterpolator at points of edges and nodes.

Mesh: the unit square in 30^2 small squares of two triangles, inner nodes shaken; the same mesh at the place (500000,
4500000). Points: nodes; points of edges, rounded; random ones inside.
"""

import matplotlib
import numpy
from matplotlib.tri import LinearTriInterpolator, Triangulation

from finding import TemporaryDirectory, lattice, points_on, report, shaken, verify, wavy, write_mesh, write_rows

unit, triangles = lattice(30, 2)
unit = shaken(unit, 0.005, seed=5)
values = wavy(unit)
figures, rows, missed, wrong_cell, off = {}, 0, 0, 0, {}
with TemporaryDirectory() as folder:
    for where, nodes in (("unit", unit), ("far", unit + [500000, 4500000])):
        random = numpy.random.default_rng(6)
        mesh = write_mesh(folder + "/mesh", nodes, triangles, values)
        triangulation = Triangulation(nodes[:, 0], nodes[:, 1], triangles)
        find = triangulation.get_trifinder()
        interpolate = LinearTriInterpolator(triangulation, values, find)
        sets = {"nodes": nodes, "inside": points_on(nodes, triangles, 3, 10000, random),
                "edges": points_on(nodes, triangles, 2, 10000, random)}
        for name, points in sets.items():
            x, y = points[:, 0].copy(), points[:, 1].copy()
            sampled = interpolate(x, y)
            verdicts = verify(mesh, write_rows(folder + "/rows.npy", points, cell=find(x, y).astype(numpy.int64),
                                               attribute0=sampled.filled(numpy.nan)))
            error = verdicts["values"][0]["max_error"]
            counts = {k: verdicts[k] for k in ("rows", "inside", "missed", "invented", "wrong_cell")}
            figures[f"{where} {name}"] = {**counts, "largest_value_error": error}
            rows += verdicts["rows"]
            missed += verdicts["missed"]
            wrong_cell += verdicts["wrong_cell"]
            off[where] = max(off.get(where, 0), error)

report(f"matplotlib {matplotlib.__version__}", "matplotlib 3.6.3",
       wrong_cell > 0 and off["far"] > 1e-10 and off["unit"] < 1e-13,
       f"of {rows} points {wrong_cell} are given to a triangle that does not contain them, {missed} inside are lost; "
       f"values are off by up to {off['unit']:.2g} of the range, {off['far']:.2g} far from the origin",
       points=rows, wrong_cell=wrong_cell, missed=missed, largest_value_error=off, by_set=figures)
