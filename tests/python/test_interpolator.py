"""Interpolator against SciPy, whose call it has, and against Fractions."""

import copy
import pickle

import numpy as np
import pytest

import barycert
from conftest import delaunay, exact_owner, kuhn, rounded


@pytest.fixture(params=[2, 3])
def case(request):
    points, cells = delaunay(200, request.param, 7)
    return points, cells, np.random.default_rng(8).random(len(points))


def queries(count, dimension, seed=9):
    return np.random.default_rng(seed).random((count, dimension)) * 1.2 - 0.1


def test_values_are_the_exact_ones_rounded_once():
    for dimension, n in ((2, 5), (3, 2)):
        points, cells = kuhn(n, dimension)
        points = points * 0.1
        rng = np.random.default_rng(3)
        values = rng.standard_normal(len(points))
        # Nodes, middles of edges and faces, and points anywhere, also outside.
        at = np.concatenate([points, (points[cells[:40, 0]] + points[cells[:40, 1]]) / 2, rng.random((60, dimension)) * n * 0.11])
        result = barycert.Interpolator(points, cells, values)(at)
        inside = 0
        for point, value in zip(at, result):
            cell, weights = exact_owner(points, cells, point)
            if cell < 0:
                assert np.isnan(value)
                continue
            inside += 1
            from fractions import Fraction

            assert value == rounded(sum(w * Fraction(float(values[node])) for w, node in zip(weights, cells[cell])))
        assert inside > 80


def test_agrees_with_scipy(case):
    interpolate = pytest.importorskip("scipy.interpolate")
    points, cells, values = case
    theirs = interpolate.LinearNDInterpolator(points, values)
    at = queries(5000, points.shape[1])
    ours, other = barycert.Interpolator(points, cells, values)(at), theirs(at)
    both = ~np.isnan(ours) & ~np.isnan(other)
    assert both.sum() > 2000
    assert np.abs(ours - other)[both].max() < 1e-11
    # They differ in what is inside at the hull alone, within SciPy's tolerance.
    assert (np.isnan(ours) != np.isnan(other)).sum() <= 2


def test_the_call_is_that_of_scipy(case):
    interpolate = pytest.importorskip("scipy.interpolate")
    points, cells, values = case
    d = points.shape[1]
    for more in ((), (1,), (3,), (2, 4)):
        all_values = np.random.default_rng(1).random((len(points),) + more)
        ours = barycert.Interpolator(points, cells, all_values)
        theirs = interpolate.LinearNDInterpolator(points, all_values)
        x = np.linspace(0.3, 0.7, 5)
        for arguments in (
            (np.full(d, 0.5),),
            ([0.5] * d,),
            (np.full((1, d), 0.5),),
            (np.full((7, d), 0.5),),
            (np.full((2, 3, d), 0.5),),
            (np.full((0, d), 0.5),),
            (0.5,) * d,
            ((0.5,) * d,),
            (x,) + (0.5,) * (d - 1),
            (x[:, None],) + (x,) * (d - 1),
            tuple(np.meshgrid(*[x] * d)),
        ):
            mine, other = ours(*arguments), theirs(*arguments)
            assert mine.shape == other.shape, arguments
            assert mine.dtype == other.dtype
            assert np.allclose(mine, other, equal_nan=True)


def test_triangulates_as_scipy_does(case):
    interpolate = pytest.importorskip("scipy.interpolate")
    spatial = pytest.importorskip("scipy.spatial")
    points, cells, values = case
    at = queries(100, points.shape[1])
    expected = barycert.Interpolator(points, cells, values)(at)
    for made in (
        barycert.Interpolator(points, values),
        barycert.Interpolator(points, None, values),
        barycert.Interpolator(points, values=values),
        barycert.Interpolator(spatial.Delaunay(points), values),
        barycert.Interpolator(points, spatial.Delaunay(points), values),
        barycert.Interpolator(barycert.Mesh(points, cells), values),
    ):
        np.testing.assert_array_equal(made(at), expected)
    del interpolate
    # A triangulation of scaled points is one of the points.
    scaled = spatial.Delaunay(points * 2)
    f = barycert.Interpolator(points, scaled, values)
    np.testing.assert_array_equal(f.points, points)
    with pytest.raises(barycert.Error, match="their triangulation"):
        barycert.Interpolator(points[:-1], scaled, values[:-1])


def test_takes_a_triangulation_of_matplotlib():
    tri = pytest.importorskip("matplotlib.tri")
    points, cells = delaunay(50, 2, 4)
    values = np.arange(50.0)
    triangulation = tri.Triangulation(points[:, 0], points[:, 1], cells)
    at = queries(100, 2)
    expected = barycert.Interpolator(points, cells, values)(at)
    np.testing.assert_array_equal(barycert.Interpolator(triangulation, values)(at), expected)
    # A masked triangle is none.
    mask = np.zeros(len(cells), dtype=bool)
    mask[::2] = True
    triangulation.set_mask(mask)
    f = barycert.Interpolator(triangulation, values)
    np.testing.assert_array_equal(f(at), barycert.Interpolator(points, cells[1::2], values)(at))
    assert "masked" in f.mesh.notes[0]
    np.testing.assert_array_equal(f.mesh.cell_numbers, np.arange(len(cells))[1::2])


@pytest.mark.parametrize("dtype", [np.float32, np.float16, np.int16, np.int64, np.uint8, bool])
def test_values_of_any_type_are_converted_exactly(case, dtype):
    points, cells, values = case
    values = (values * 100).astype(dtype)
    at = queries(200, points.shape[1])
    expected = barycert.Interpolator(points, cells, values.astype(float))(at)
    np.testing.assert_array_equal(barycert.Interpolator(points, cells, values)(at), expected)


def test_what_no_double_holds_is_refused(case):
    points, cells, _ = case
    for value in (2**53 + 1, 2**63 - 1):
        with pytest.raises(barycert.Error, match="represents.*" + str(value)):
            barycert.Interpolator(points, cells, np.full(len(points), value))
    with pytest.raises(barycert.Error, match="represents"):
        barycert.Interpolator(points, cells, np.full(len(points), 2**64 - 1, dtype=np.uint64))
    barycert.Interpolator(points, cells, np.full(len(points), -(2**63)))
    barycert.Interpolator(points, cells, np.full(len(points), 2**63, dtype=np.uint64))
    with pytest.raises(barycert.Error, match="real numbers"):
        barycert.Interpolator(points, cells, ["text"] * len(points))


def test_complex_values(case):
    points, cells, values = case
    values = values + 1j * values[::-1]
    at = queries(200, points.shape[1])
    f = barycert.Interpolator(points, cells, values)
    result = f(at)
    assert result.dtype == complex
    np.testing.assert_array_equal(result.real, barycert.Interpolator(points, cells, values.real)(at))
    np.testing.assert_array_equal(result.imag, barycert.Interpolator(points, cells, values.imag)(at))
    filled = barycert.Interpolator(points, cells, np.stack([values, -values], axis=1), fill_value=3 - 2j)(at)
    outside = np.isnan(result)
    assert outside.any() and (filled[outside] == 3 - 2j).all()
    np.testing.assert_array_equal(filled[~outside, 0], result[~outside])


def test_outside():
    points, cells = kuhn(2, 2)
    values = points @ [1.0, 10.0]
    at = np.array([[1.0, 1.0], [3.0, 1.0], [1.0, -2.0]])

    def call(**options):
        return barycert.Interpolator(points, cells, values, **options)(at)

    np.testing.assert_array_equal(call(), [11, np.nan, np.nan])
    np.testing.assert_array_equal(call(fill_value=-1), [11, -1, -1])
    np.testing.assert_array_equal(call(fill_value=-1, outside="fill"), [11, -1, -1])
    np.testing.assert_array_equal(call(outside="nearest"), [11, 12, 1])
    np.testing.assert_array_equal(call(outside="nearest", limit=1.5), [11, 12, np.nan])
    np.testing.assert_array_equal(call(outside="extrapolate"), [11, 13, -19])
    with pytest.raises(barycert.Error, match="point 1 is outside the mesh"):
        call(outside="raise")
    with pytest.raises(barycert.Error, match="expected nan, raise"):
        call(outside="what")


def test_bad_input_is_named(case):
    points, cells, values = case
    d = points.shape[1]
    f = barycert.Interpolator(points, cells, values, nonfinite_points="error")
    at = queries(10, d)
    at[7, 1] = np.nan
    with pytest.raises(barycert.Error, match="point 7"):
        f(at)
    with pytest.raises(barycert.Error, match='nonfinite_points="nan" takes NaN'):
        f(np.ma.masked_invalid(at))
    with pytest.raises(barycert.Error, match="expected error or nan"):
        barycert.Interpolator(points, cells, values, nonfinite_points="none")
    with pytest.raises(barycert.Error, match="coordinates each"):
        f(np.zeros((3, d + 1)))
    with pytest.raises(barycert.Error, match="number of coordinates"):
        f(*[0.5] * (d + 1))
    with pytest.raises(barycert.Error, match="shape of the values"):
        barycert.Interpolator(points, cells, values[:-1])
    with pytest.raises(barycert.Error, match="without values"):
        barycert.Interpolator(points)
    with pytest.raises(ValueError):
        barycert.Interpolator(points, cells, values[:-1])
    for masked in (np.ma.masked_less(values, 0.5), np.ma.masked_less(values, 0.5) + 1j):
        with pytest.raises(barycert.Error, match="masked"):
            barycert.Interpolator(points, cells, masked)


def test_points_that_are_not_finite_get_nan_and_are_counted(case):
    interpolate = pytest.importorskip("scipy.interpolate")
    points, cells, values = case
    d = points.shape[1]
    at = queries(300, d)
    at[7, 1], at[8, 0], at[9] = np.nan, np.inf, -np.inf
    f = barycert.Interpolator(points, cells, values)
    expected = f(np.delete(at, [7, 8, 9], axis=0))
    assert f.nonfinite_count == 0
    result = f(at)
    assert f.nonfinite_count == 3 and np.isnan(result[7:10]).all()
    np.testing.assert_array_equal(np.delete(result, [7, 8, 9]), expected)
    theirs = interpolate.LinearNDInterpolator(points, values)(at)
    assert np.isnan(theirs[7]) and np.isnan(theirs[9])
    # A masked point is like one that is not finite, whatever stands under the mask; also for integers, and by coordinate.
    hidden = np.ma.array(np.where(np.isfinite(at), at, 0.5), mask=~np.isfinite(at))
    np.testing.assert_array_equal(f(hidden), result)
    np.testing.assert_array_equal(f(*np.moveaxis(hidden, -1, 0)), result)
    whole = np.ma.masked_equal(np.zeros((2, d), dtype=np.int64), 1)
    whole[1, 0] = np.ma.masked
    assert np.isnan(f(whole)[1]) and not np.isnan(f(np.full(d, 0.5))).any()
    # NaN, and no other number, under every policy, of real and of complex values.
    for outside in ({"fill_value": -1.0}, {"outside": "nearest"}, {"outside": "extrapolate"}):
        got = barycert.Interpolator(points, cells, values, **outside)(at)
        assert np.isnan(got[7:10]).all() and not np.isnan(np.delete(got, [7, 8, 9])).any()
    both = barycert.Interpolator(points, cells, values + 1j, fill_value=2j)(at)
    assert np.isnan(both[7:10]).all() and not np.isnan(np.delete(both, [7, 8, 9])).any()
    raising = barycert.Interpolator(points, cells, values, outside="raise")
    assert np.isnan(raising(np.where(np.isfinite(at), 0.5, at))[7:10]).all()
    assert pickle.loads(pickle.dumps(f))(at)[7] != 0


def test_masked_values_are_as_their_remedy_says(case):
    points, cells, values = case
    masked = np.ma.masked_less(values, 0.1)
    with pytest.raises(barycert.Error, match=r"\.astype\(float\)\.filled\(numpy\.nan\)"):
        barycert.Interpolator(points, cells, masked)
    assert np.isnan(barycert.Interpolator(points, cells, masked.astype(float).filled(np.nan))(points)).any()
    integers = np.ma.masked_less((values * 100).astype(int), 10)
    assert np.isnan(barycert.Interpolator(points, cells, integers.astype(float).filled(np.nan))(points)).any()


def test_blocks_do_not_show(case):
    """Work is done in parts of any size: in one call or many the bits are the same."""
    points, cells, values = case
    f = barycert.Interpolator(points, cells, values, outside="nearest")
    at = queries(30_000, points.shape[1])
    whole = f(at)
    np.testing.assert_array_equal(whole, np.concatenate([f(part) for part in np.array_split(at, 7)]))
    np.testing.assert_array_equal(whole, barycert.Interpolator(points, cells, values, outside="nearest", threads=1)(at))


def test_copies_and_pickles(case):
    points, cells, values = case
    at = queries(100, points.shape[1])
    for f in (
        barycert.Interpolator(points, cells, values, fill_value=3),
        barycert.Interpolator(points, cells, (values + 1j).astype(np.complex64), outside="nearest"),
    ):
        for other in (pickle.loads(pickle.dumps(f)), copy.copy(f), copy.deepcopy(f)):
            np.testing.assert_array_equal(other(at), f(at))
            assert repr(other) == repr(f)


def test_cells_of_second_order():
    # One triangle, and a quadratic function: it is interpolated exactly.
    points = np.array([[0, 0], [4, 0], [0, 4], [2, 0], [2, 2], [0, 2]], dtype=float)
    values = points[:, 0] ** 2 + points[:, 0] * points[:, 1]
    f = barycert.Interpolator(points, [[0, 1, 2, 3, 4, 5]], values)
    assert f(1.0, 0.5) == 1.5
