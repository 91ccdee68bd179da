"""SciPy and matplotlib. SYSTEM: find_simplex, LinearNDInterpolator (on SciPy's own Delaunay triangulation), TriFinder.

See exchange.hpp for what is read and written.
"""

import os
import sys
import time

os.environ["OMP_NUM_THREADS"] = os.environ["OPENBLAS_NUM_THREADS"] = "1"
import numpy

system, task, folder = sys.argv[1:]
load = lambda name: numpy.fromfile(f"{folder}/{name}.{name_types[name]}", types[name_types[name]])
types = {"i32": numpy.int32, "f64": numpy.float64}
name_types = {"dimension": "i32", "nodes": "f64", "cells": "i32", "values": "f64", "points": "f64"}
dimension = int(load("dimension")[0])
nodes = load("nodes").reshape(-1, dimension)
owners = sampled = None

start = time.perf_counter()
if system == "TriFinder":
    import matplotlib
    from matplotlib.tri import LinearTriInterpolator, Triangulation

    version = matplotlib.__version__
    x, y = (load("points").reshape(-1, 2)[:, k].copy() for k in (0, 1))
    triangulation = Triangulation(nodes[:, 0], nodes[:, 1], load("cells").reshape(-1, 3))
    find = triangulation.get_trifinder()
    interpolate = LinearTriInterpolator(triangulation, load("values"), find)
    built = time.perf_counter()
    owners = find(x, y)
    sampled = interpolate(x, y).filled(numpy.nan)
else:
    import scipy
    from scipy.interpolate import LinearNDInterpolator
    from scipy.spatial import Delaunay

    version = scipy.__version__
    triangulation = Delaunay(nodes)
    if task == "triangulate":
        triangulation.simplices.astype(numpy.int32).tofile(folder + "/cells.i32")
        print(version)
        sys.exit()
    points = load("points").reshape(-1, dimension)
    if system == "find_simplex":
        triangulation.find_simplex(points[:1])  # makes what it keeps
        built = time.perf_counter()
        owners = triangulation.find_simplex(points)
    else:
        interpolate = LinearNDInterpolator(triangulation, load("values"))
        interpolate(points[:1])
        built = time.perf_counter()
        sampled = interpolate(points)
numpy.array([built - start, time.perf_counter() - built]).tofile(folder + "/seconds.f64")
if owners is not None:
    owners.astype(numpy.int64).tofile(folder + "/owners.i64")
if sampled is not None:
    sampled.astype(numpy.float64).tofile(folder + "/sampled.f64")
print(version)
