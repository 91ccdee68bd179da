"""Predicates and weights against Fractions, and how they broadcast."""

from fractions import Fraction

import numpy as np
import pytest

import barycert
from conftest import determinant, exact, exact_weights, rounded


def sign(x):
    return (x > 0) - (x < 0)


def difference(a, b):
    return [x - y for x, y in zip(exact(a), exact(b))]


def lifted(a, b):
    d = difference(a, b)
    return d + [sum(x * x for x in d)]


EXACT = {
    "orient2d": (2, 3, lambda a, b, c: determinant([difference(b, a), difference(c, a)])),
    "orient3d": (3, 4, lambda a, b, c, d: determinant([difference(p, a) for p in (b, c, d)])),
    "det3d": (3, 6, lambda p, q, r, s, t, u: determinant([difference(q, p), difference(s, r), difference(u, t)])),
    "incircle": (2, 4, lambda a, b, c, d: determinant([lifted(p, d) for p in (a, b, c)])),
    "insphere": (3, 5, lambda a, b, c, d, e: -determinant([lifted(p, e) for p in (a, b, c, d)])),
}


@pytest.mark.parametrize("name", EXACT)
def test_signs_are_exact(name):
    dimension, arguments, value = EXACT[name]
    rng = np.random.default_rng(5)
    cases = [rng.integers(-2, 3, (arguments, dimension)).astype(float) for _ in range(150)]
    # Almost degenerate, tiny and huge.
    cases += [c * 0.1 + rng.integers(-1, 2, c.shape) * 1e-17 for c in cases]
    cases += [np.ldexp(c, int(rng.integers(-250, 250))) for c in cases]
    points = np.array(cases)
    signs = getattr(barycert, name)(*np.moveaxis(points, 1, 0))
    assert signs.dtype == np.int8
    expected = [sign(value(*case)) for case in points]
    assert {-1, 0, 1} == set(expected)
    np.testing.assert_array_equal(signs, expected)


@pytest.mark.parametrize("name", EXACT)
def test_arguments_broadcast(name):
    dimension, arguments, _ = EXACT[name]
    function = getattr(barycert, name)
    rng = np.random.default_rng(6)
    shapes = [(4, 1), (), (3,), (1, 3), (4, 3), (1, 1)][:arguments]
    points = [rng.integers(-2, 3, shape + (dimension,)) for shape in shapes]
    result = function(*points)
    assert result.shape == (4, 3)
    wide = [np.broadcast_to(p, (4, 3, dimension)) for p in points]
    for i in range(4):
        for j in range(3):
            one = function(*[w[i, j] for w in wide])
            assert np.ndim(one) == 0 and one == result[i, j]
    # Strides of any kind.
    strided = [np.asfortranarray(w)[::-1] for w in wide]
    np.testing.assert_array_equal(function(*strided), result[::-1])
    empty = function(*[np.zeros((0, dimension))] * arguments)
    assert empty.shape == (0,) and empty.dtype == np.int8


@pytest.mark.parametrize("name", EXACT)
def test_bad_arguments_are_named(name):
    dimension, arguments, _ = EXACT[name]
    function = getattr(barycert, name)
    points = [np.zeros((5, dimension)) for _ in range(arguments)]
    points[-1][3, 1] = np.inf
    with pytest.raises(barycert.Error, match="case 3"):
        function(*points)
    with pytest.raises(barycert.Error, match="shape of argument 0"):
        function(np.zeros(dimension + 1), *points[1:])
    with pytest.raises(barycert.Error, match="broadcast"):
        function(np.zeros((4, dimension)), *points[1:])
    with pytest.raises(barycert.Error, match="real numbers"):
        function(np.zeros((5, dimension), dtype=complex), *points[1:])


@pytest.mark.parametrize("n, d", [(3, 2), (4, 3)])
def test_weights_are_correctly_rounded(n, d):
    rng = np.random.default_rng(7)
    vertices = np.concatenate([rng.integers(-2, 3, (150, n, d)) * 0.1, rng.standard_normal((150, n, d))])
    points = np.concatenate([rng.integers(-2, 3, (150, d)) * 0.1, rng.standard_normal((150, d))])
    weights, signs = barycert.barycentric_weights(vertices, points), barycert.weight_signs(vertices, points)
    degenerate = 0
    for v, p, w, s in zip(vertices, points, weights, signs):
        expected = exact_weights(v, p)
        if expected is None:
            degenerate += 1
            assert np.isnan(w).all() and (s == 0).all()
            continue
        assert [rounded(x) for x in expected] == list(w)
        assert [sign(x) for x in expected] == list(s)
    assert 0 < degenerate < 150


def test_weights_on_segments_and_triangles_in_space():
    np.testing.assert_array_equal(barycert.barycentric_weights([[0, 0, 0], [4, 0, 0]], [1, 5, 0]), [0.75, 0.25])
    triangle = [[0, 0, 0], [4, 0, 0], [0, 4, 0]]
    np.testing.assert_array_equal(barycert.barycentric_weights(triangle, [1, 1, 9]), [0.5, 0.25, 0.25])
    np.testing.assert_array_equal(barycert.weight_signs(triangle, [2, 2, 1]), [0, 1, 1])


def test_weights_broadcast():
    triangles = np.random.default_rng(8).random((5, 1, 3, 2))
    points = np.random.default_rng(9).random((4, 2))
    weights = barycert.barycentric_weights(triangles, points)
    assert weights.shape == (5, 4, 3)
    np.testing.assert_array_equal(weights[3, 2], barycert.barycentric_weights(triangles[3, 0], points[2]))
    with pytest.raises(barycert.Error, match="segments"):
        barycert.barycentric_weights(np.zeros((5, 3)), np.zeros(3))
    with pytest.raises(barycert.Error, match="broadcast"):
        barycert.barycentric_weights(np.zeros((5, 3, 2)), np.zeros((4, 2)))


def test_more_cases_than_a_part_has():
    vertices = np.random.default_rng(1).random((10_000, 3, 2))
    points = np.random.default_rng(2).random((10_000, 2))
    whole = barycert.barycentric_weights(vertices, points)
    np.testing.assert_array_equal(whole[9000:], barycert.barycentric_weights(vertices[9000:], points[9000:]))
    signs = barycert.weight_signs(vertices, points)
    np.testing.assert_array_equal(signs, np.sign(whole))
    assert Fraction(float(whole[0].sum())) != 0
    points[9500, 1] = np.nan
    for function in (barycert.barycentric_weights, barycert.weight_signs):
        with pytest.raises(barycert.Error, match="case 9500"):
            function(vertices, points)
