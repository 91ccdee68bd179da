"""What SciPy and matplotlib say of one cell and one point, as their users ask them: python_kernel.py PACKAGE DIMENSION.

Answers python_kernel.cpp over a socket that is both stdin and stdout. First goes the version of the package, a line; without
the package nothing does. Then numbers, all doubles: a question is its kind, vertices, point and nodal values; an answer is
1 if the package refuses the cell, 1 if it says that the point is inside, and the weights (or, to a question of kind 1, the
interpolated value and zeros).
"""

import os
import sys
import warnings

os.environ["OMP_NUM_THREADS"] = os.environ["OPENBLAS_NUM_THREADS"] = "1"
warnings.simplefilter("ignore")
wire = os.fdopen(os.dup(1), "wb")
os.dup2(2, 1)  # what the package prints is no answer

package, dimension = sys.argv[1], int(sys.argv[2])
try:
    import numpy

    if package == "scipy":
        from scipy import __version__
        from scipy.spatial import Delaunay, QhullError
    else:
        from matplotlib import __version__
        from matplotlib.tri import Triangulation
except ImportError:
    sys.exit()
numpy.seterr(all="ignore")
corners = dimension + 1


class SciPy:
    """Delaunay.transform of the one cell, with the formula of SciPy's manual, and find_simplex."""

    refusals = QhullError if package == "scipy" else ()

    def __init__(self, vertices):
        self.cells = Delaunay(vertices)
        if len(self.cells.simplices) != 1:
            raise QhullError("no cell, or several")

    def weights(self, point):
        transform = self.cells.transform[0]
        first = transform[:dimension].dot(point - transform[dimension])
        weights = numpy.empty(corners)
        weights[self.cells.simplices[0]] = numpy.append(first, 1 - first.sum())
        return weights

    def inside(self, point):
        return self.cells.find_simplex(point) >= 0


class Matplotlib:
    """The planes over the triangle, as LinearTriInterpolator evaluates them, and TrapezoidMapTriFinder."""

    refusals = RuntimeError  # "Triangulation is invalid"

    def __init__(self, vertices):
        self.triangles = Triangulation(vertices[:, 0].copy(), vertices[:, 1].copy(), [[0, 1, 2]])
        self.find = self.triangles.get_trifinder()

    def value(self, point, values):
        a, b, c = self.triangles.calculate_plane_coefficients(values)[0]
        return a * point[0] + b * point[1] + c

    def weights(self, point):
        return [self.value(point, unit) for unit in numpy.eye(corners)]

    def inside(self, point):
        return self.find(point[0], point[1]) >= 0


def answers():
    library = SciPy if package == "scipy" else Matplotlib
    size = 8 * (1 + corners * dimension + dimension + corners)
    while len(question := sys.stdin.buffer.read(size)) == size:
        kind, *numbers = numpy.frombuffer(question)
        vertices = numpy.array(numbers[:corners * dimension]).reshape(corners, dimension)
        point = numpy.array(numbers[corners * dimension:-corners])
        try:
            cell = library(vertices)
            if kind == 1:
                yield [0, 0, cell.value(point, numpy.array(numbers[-corners:])), *[0] * dimension]
            else:
                yield [0, cell.inside(point), *cell.weights(point)]
        except library.refusals:
            yield [1, 0, *[numpy.nan] * corners]


wire.write(f"{__version__}\n".encode())
wire.flush()
for answer in answers():
    wire.write(numpy.array(answer, float).tobytes())
    wire.flush()
