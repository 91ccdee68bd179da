"""Meshes and an independent oracle for the tests."""

import os
from fractions import Fraction

import numpy as np
import pytest

SOURCES = os.environ.get("BARYCERT_SOURCES", os.path.join(os.path.dirname(__file__), "..", ".."))


def kuhn(n, dimension, scale=1.0):
    """A lattice of n**dimension cubes, each in 2 triangles or 6 tetrahedra: points, cells."""
    from itertools import permutations

    axes = [np.arange(n + 1)] * dimension
    points = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, dimension) * scale
    steps = [(n + 1) ** (dimension - 1 - k) for k in range(dimension)]
    corner = np.stack(np.meshgrid(*[np.arange(n)] * dimension, indexing="ij"), axis=-1).reshape(-1, dimension) @ steps
    cells = []
    for order in permutations(range(dimension)):
        nodes = [corner]
        for axis in order:
            nodes.append(nodes[-1] + steps[axis])
        cells.append(np.stack(nodes, axis=-1))
    return points, np.concatenate(cells)


def delaunay(count, dimension, seed):
    """Random points in the unit cube and their Delaunay cells."""
    spatial = pytest.importorskip("scipy.spatial")
    points = np.random.default_rng(seed).random((count, dimension))
    return points, spatial.Delaunay(points).simplices


def determinant(rows):
    """Of Fractions, along the first row."""
    if len(rows) == 1:
        return rows[0][0]
    return sum(
        (-1) ** i * rows[0][i] * determinant([row[:i] + row[i + 1 :] for row in rows[1:]]) for i in range(len(rows))
    )


def exact(numbers):
    return [Fraction(float(x)) for x in numbers]


def exact_weights(vertices, point):
    """Barycentric weights as Fractions; None of a degenerate simplex."""
    rows = [exact(v) + [Fraction(1)] for v in vertices]
    whole = determinant(rows)
    if whole == 0:
        return None
    at = exact(point) + [Fraction(1)]
    return [determinant(rows[:i] + [at] + rows[i + 1 :]) / whole for i in range(len(rows))]


def exact_owner(points, cells, point):
    """The lowest cell that contains the point, and its weights; -1 outside. Looks at every cell."""
    for cell, nodes in enumerate(cells):
        vertices = points[nodes]
        if (point < vertices.min(axis=0)).any() or (point > vertices.max(axis=0)).any():
            continue
        weights = exact_weights(vertices, point)
        if weights is not None and min(weights) >= 0:
            return cell, weights
    return -1, None


def rounded(fraction):
    """The nearest double, ties to even: int / int is correctly rounded in Python."""
    return fraction.numerator / fraction.denominator


@pytest.fixture
def data():
    """The folder of meshes of the sources."""
    return os.path.join(SOURCES, "data", "meshes")
