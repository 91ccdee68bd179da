"""barycert.Interpolator beside SciPy's LinearNDInterpolator, and beside the library in C++.

    bench_python.py PEER [--quick]      PEER: the program python_peer; called by ./run bench python

Interpolates one field at a million random points in Delaunay cells of a jittered lattice, about 200,000 cells; the cells
are SciPy's for all three. Before any time is taken the values of Python and C++ must have the same bits, and those of
SciPy must be within 1e-9 where both have one. SciPy has one thread; times are the least of some repetitions.
"""

import os
import subprocess
import sys
import tempfile
import time

import numpy as np
import scipy
from scipy.interpolate import LinearNDInterpolator
from scipy.spatial import Delaunay

import barycert

peer, quick = sys.argv[1], "--quick" in sys.argv[2:]
nodes, count, repetitions = (8, 10_000, 1) if quick else (31, 1_000_000, 5)


def least(work, times=repetitions):
    seconds = []
    for _ in range(times):
        begin = time.perf_counter()
        result = work()
        seconds.append(time.perf_counter() - begin)
    return min(seconds), result


rng = np.random.default_rng(1)
lattice = np.stack(np.meshgrid(*[np.arange(nodes) / (nodes - 1)] * 3, indexing="ij"), axis=-1).reshape(-1, 3)
points = lattice + rng.uniform(-0.3, 0.3, lattice.shape) / (nodes - 1)
values = np.sin(points @ [5.0, 3.0, 2.0])
at = rng.random((count, 3))
scipy_build, triangulation = least(lambda: Delaunay(points), 1)
cells = triangulation.simplices
scipy_build += least(lambda: LinearNDInterpolator(triangulation, values), 1)[0]
theirs = LinearNDInterpolator(triangulation, values)

with tempfile.TemporaryDirectory() as folder:
    for name, array in (("points", points), ("cells", cells.astype(np.int32)), ("values", values), ("at", at)):
        array.tofile(os.path.join(folder, name))
    printed = subprocess.run([peer, folder, str(repetitions)], check=True, capture_output=True, text=True).stdout
    native = np.fromfile(os.path.join(folder, "result"))
in_cpp = {int(line.split()[0]): [float(x) for x in line.split()[1:]] for line in printed.splitlines()}

ours = barycert.Interpolator(points, cells, values)(at)
assert np.array_equal(ours, native, equal_nan=True), "Python and C++ differ"
scipy_call, other = least(lambda: theirs(at), 1 if quick else 2)
both = ~np.isnan(ours) & ~np.isnan(other)
assert both.mean() > 0.8 and np.abs(ours - other)[both].max() < 1e-9, "barycert and SciPy differ"

print(f"{len(points)} nodes, {len(cells)} cells, {count} points; scipy {scipy.__version__}, numpy {np.__version__}")
print(f"{'':34}{'build s':>10}{'ns/point':>10}{'to SciPy':>10}{'to C++':>8}")
print(f"{'scipy LinearNDInterpolator':34}{scipy_build:10.3f}{scipy_call / count * 1e9:10.1f}{1:9.1f}x{'':>8}")
for threads in (1, 0):
    label = "1 thread" if threads else "all threads"
    # The index is made by all threads, as it is for users: of one thread only calls are comparable.
    build, f = least(lambda: barycert.Interpolator(points, cells, values, threads=threads))
    call, _ = least(lambda: f(at))
    cpp_build, cpp_call = in_cpp[threads]
    print(f"{'C++ Sampler, ' + label:34}{cpp_build:10.3f}{cpp_call / count * 1e9:10.1f}{scipy_call / cpp_call:9.1f}x{1:8.2f}")
    print(f"{'barycert.Interpolator, ' + label:34}{build:10.3f}{call / count * 1e9:10.1f}{scipy_call / call:9.1f}x{call / cpp_call:8.2f}")
    if threads == 0:
        whole, native_whole = build + call, cpp_build + cpp_call
        print(f"build and call together: {(scipy_build + scipy_call) / whole:.1f}x SciPy, {whole / native_whole:.2f} of C++")
