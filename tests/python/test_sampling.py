"""Location, sampling, grids and gradients against SciPy and Fractions."""

from fractions import Fraction

import numpy as np
import pytest

import barycert
from barycert import Feature
from conftest import delaunay, exact, exact_owner, exact_weights, kuhn, rounded


@pytest.fixture(params=[2, 3])
def mesh(request):
    points, cells = delaunay(150, request.param, 11)
    rng = np.random.default_rng(12)
    return barycert.Mesh(
        points, cells, point_data={"T": rng.random(150), "v": rng.random((150, 3))}, cell_data={"c": rng.random(len(cells))}
    )


def queries(mesh, count=3000, seed=13):
    return np.random.default_rng(seed).random((count, mesh.dimension)) * 1.2 - 0.1


def assert_same(a, b):
    """Equal, NaN where NaN is, member by member."""
    assert a.dtype == b.dtype and a.shape == b.shape
    for name in a.dtype.names or [...]:
        np.testing.assert_array_equal(a[name], b[name])


def lattice(dimension):
    points, cells = kuhn(3, dimension)
    rng = np.random.default_rng(2)
    at = np.concatenate([points, rng.integers(-2, 14, (200, dimension)) * 0.25, rng.random((50, dimension)) * 4 - 0.5])
    return barycert.Mesh(points, cells), at


@pytest.mark.parametrize("dimension", [2, 3])
def test_owners_features_and_weights_are_exact(dimension):
    mesh, at = lattice(dimension)
    location = mesh.locate(at)
    assert len(location) == len(at) and location.cell.dtype == np.int32
    seen = set()
    for point, cell, feature, weights in zip(at, location.cell, location.feature, location.weights):
        owner, expected = exact_owner(mesh.points, mesh.cells, point)
        assert owner == cell
        seen.add(Feature(feature))
        if cell < 0:
            assert feature == Feature.OUTSIDE and np.isnan(weights).all()
            continue
        assert [rounded(w) for w in expected] == list(weights)
        support = sum(w != 0 for w in expected)
        names = {2: {1: "VERTEX", 2: "EDGE", 3: "INTERIOR"}, 3: {1: "VERTEX", 2: "EDGE", 3: "FACE", 4: "INTERIOR"}}
        assert Feature(feature).name == names[dimension][support]
    assert len(seen) == dimension + 2
    np.testing.assert_array_equal(location.inside, location.cell >= 0)


def test_all_cells_that_hold_a_point():
    mesh, at = lattice(2)
    begin, cells = mesh.locate_all(at)
    for i, point in enumerate(at):
        expected = []
        for cell, nodes in enumerate(mesh.cells):
            weights = exact_weights(mesh.points[nodes], point)
            if min(weights) >= 0:
                expected.append(cell)
        assert list(cells[begin[i] : begin[i + 1]]) == expected
    assert begin[-1] == len(cells)


def test_owners_agree_with_scipy(mesh):
    spatial = pytest.importorskip("scipy.spatial")
    triangulation = spatial.Delaunay(mesh.points)
    # The same cells, in SciPy's order.
    again = barycert.Mesh(triangulation)
    at = queries(mesh)
    theirs, ours = triangulation.find_simplex(at), again.locate(at).cell
    assert (theirs != ours).mean() < 0.001


def test_shapes(mesh):
    d = mesh.dimension
    at = queries(mesh, 24)
    whole = mesh.locate(at)
    for shape in ((2, 3, 4), (24,), (1, 24), (4, 6)):
        location = mesh.locate(at.reshape(shape + (d,)))
        np.testing.assert_array_equal(location.cell, whole.cell.reshape(shape))
        assert location.weights.shape == shape + (d + 1,) and location.points.shape == shape + (d,)
        assert mesh.sample(at.reshape(shape + (d,)), "T").shape == shape
        assert mesh.sample(at.reshape(shape + (d,)), "v").shape == shape + (3,)
        assert mesh.sample(at.reshape(shape + (d,))).shape == shape
    assert mesh.locate(at[0]).cell.shape == () and mesh.sample(at[0], "v").shape == (3,)
    none = np.zeros((0, d))
    assert mesh.sample(none, "v").shape == (0, 3) and mesh.locate(none).matrix().shape == (0, len(mesh.points))
    assert mesh.locate(none).weights.shape == (0, d + 1)
    for bad in (at[:, :1], 3.0, at.ravel()):
        with pytest.raises(barycert.Error, match="shape of the points"):
            mesh.locate(bad)


def test_a_location_keeps_its_points(mesh):
    at = queries(mesh, 100)
    location, expected = mesh.locate(at), mesh.locate(at.copy()).weights
    at[:] = 0
    np.testing.assert_array_equal(location.weights, expected)
    assert at.flags.writeable
    with pytest.raises(ValueError):
        location.points[0] = 0
    fixed = queries(mesh, 100)
    fixed.flags.writeable = False
    assert np.shares_memory(mesh.locate(fixed).points, fixed)


def test_the_matrix(mesh):
    pytest.importorskip("scipy.sparse")
    at = queries(mesh)
    location = mesh.locate(at)
    matrix = location.matrix()
    assert matrix.shape == (len(at), len(mesh.points)) and matrix.format == "csr"
    inside = location.inside
    assert (np.diff(matrix.indptr)[~inside] == 0).all()
    # The weights of the location, at the nodes of the owners.
    for row in np.flatnonzero(inside)[:200]:
        part = matrix.getrow(row)
        nodes = mesh.cells[location.cell[row]]
        assert {n: w for n, w in zip(part.indices, part.data)} == {n: w for n, w in zip(nodes, location.weights[row]) if w != 0}
    values = matrix @ mesh.point_data["v"]
    sampled = mesh.sample(at, "v")
    assert np.abs(values - sampled)[inside].max() < 1e-15
    everywhere = location.matrix(outside="nearest")
    assert (np.diff(everywhere.indptr) > 0).all()
    assert np.abs(everywhere @ mesh.point_data["T"] - mesh.sample(at, "T", outside="nearest")).max() < 1e-15
    with pytest.raises(barycert.Error, match="outside="):
        location.matrix(outside="what")
    # No weights can do that.
    for outside in ("raise", "fill"):
        with pytest.raises(barycert.Error, match="expected nan, nearest or extrapolate"):
            location.matrix(outside=outside)


def test_sampling_of_fields(mesh):
    at = queries(mesh)
    location = mesh.locate(at)
    everything = mesh.sample(at)
    assert everything.dtype.names == ("T", "v", "c") and everything["v"].shape == (len(at), 3)
    for name in ("T", "v", "c"):
        np.testing.assert_array_equal(everything[name], mesh.sample(at, name))
        np.testing.assert_array_equal(everything[name], location.sample(name))
    np.testing.assert_array_equal(everything["c"][location.inside], mesh.cell_data["c"][location.cell[location.inside]])
    some = mesh.sample(at, ["c", "v.y", "|v|"])
    assert set(some.dtype.names) == {"c", "v.y", "|v|"}
    np.testing.assert_array_equal(some["v.y"], everything["v"][:, 1])
    i = np.flatnonzero(location.inside)[0]
    weights = exact_weights(mesh.points[mesh.cells[location.cell[i]]], at[i])
    values = exact(mesh.point_data["T"][mesh.cells[location.cell[i]]])
    assert everything["T"][i] == rounded(sum(w * v for w, v in zip(weights, values)))
    for outside, options in (("fill", {"fill_value": 7}), ("nearest", {}), ("extrapolate", {}), ("nan", {})):
        np.testing.assert_array_equal(
            mesh.sample(at, "T", outside=outside, **options), location.sample("T", outside=outside, **options)
        )
    with pytest.raises(barycert.Error, match="outside the mesh"):
        location.sample("T", outside="raise")
    with pytest.raises(barycert.Error, match='"none"'):
        mesh.sample(at, "none")
    with pytest.raises(barycert.Error, match="no fields"):
        mesh.sample(at, [])
    with pytest.raises(barycert.Error, match="has no fields"):
        barycert.Mesh(mesh.points, mesh.cells).sample(at)


def test_two_fields_of_one_name(mesh):
    mesh.cell_data["T"] = np.arange(len(mesh.cells))
    at = queries(mesh, 50)
    both = mesh.sample(at, ["point:T", "cell:T"])
    assert both.dtype.names == ("T", "cell:T")
    np.testing.assert_array_equal(both["cell:T"], mesh.sample(at, "cell:T"))
    np.testing.assert_array_equal(both["T"], mesh.sample(at, "point:T"))


def test_plain_rounding_keeps_owners(mesh):
    at = queries(mesh)
    plain, correct = mesh.sample(at, "T", rounding="plain"), mesh.sample(at, "T")
    np.testing.assert_array_equal(np.isnan(plain), np.isnan(correct))
    assert np.nanmax(np.abs(plain - correct)) < 1e-10
    with pytest.raises(barycert.Error, match="rounding="):
        mesh.sample(at, "T", rounding="what")


def test_nearest():
    mesh, _ = lattice(2)
    cells, distances = mesh.nearest([[1.2, 1.1], [6.0, 1.5], [7.0, 6.0]])
    np.testing.assert_array_equal(distances, [0, 3, 5])
    assert (cells >= 0).all()
    cells, distances = mesh.nearest([[6.0, 1.5]], limit=2)
    assert cells == -1 and np.isnan(distances)


def test_resampling_is_sampling_on_the_grid(mesh):
    d = mesh.dimension
    shape = (5, 6, 7)[:d]
    bounds = np.array([[-0.1, 1.1], [0.2, 0.7], [0.1, 0.9]])[:d]
    axes = mesh.grid_axes(shape, bounds)
    assert [len(axis) for axis in axes] == list(shape) and [a[-1] for a in axes] == list(bounds[:, 1])
    at = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1)
    for fields in ("T", "v", ["T", "c"], None):
        assert_same(mesh.resample(shape, bounds, fields), mesh.sample(at, fields))
    np.testing.assert_array_equal(
        mesh.resample(shape, bounds, "T", fill_value=3), mesh.sample(at, "T", fill_value=3)
    )
    # In memory x runs fastest.
    assert mesh.resample(shape, bounds, "T").flags.f_contiguous
    assert mesh.resample(4, fields="T").shape == (4,) * d
    np.testing.assert_array_equal(mesh.bounds, np.stack([mesh.points.min(axis=0), mesh.points.max(axis=0)], axis=1))
    for bad in (((5,) * (d + 1), None), (4, bounds[:1]), ((0,) * d, None), ((4,) * d, bounds[:, ::-1])):
        with pytest.raises(barycert.Error):
            mesh.resample(*bad, "T")
    with pytest.raises(barycert.Error, match="outside the mesh"):
        mesh.resample(shape, bounds, "T", outside="raise")


def test_gradients(mesh):
    d = mesh.dimension
    slopes = np.arange(1.0, d + 1)
    # Differences of coordinates are exact here, and so are the gradients of a linear field.
    points, cells = kuhn(3, d)
    lattice_mesh = barycert.Mesh(points, cells, point_data={"f": points @ slopes})
    np.testing.assert_array_equal(lattice_mesh.gradient("f"), np.tile(slopes, (len(cells), 1)))
    np.testing.assert_array_equal(lattice_mesh.gradient(points @ slopes), lattice_mesh.gradient("f"))
    gradients = mesh.gradient("v")
    assert gradients.shape == (len(mesh.cells), 3, d)
    at = queries(mesh, 200)
    location = mesh.locate(at)
    np.testing.assert_array_equal(mesh.gradient("v", at)[location.inside], gradients[location.cell[location.inside]])
    assert mesh.gradient("T", at).shape == (200, d)
    for name in ("c", "none"):
        with pytest.raises(barycert.Error, match="no such field of nodes"):
            mesh.gradient(name)
    with pytest.raises(barycert.Error, match="name of a field"):
        mesh.gradient(np.ones(150), at)


def test_degenerate_cells_own_nothing():
    points = np.array([[0, 0], [2, 0], [0, 2], [1, 1]], dtype=float)
    mesh = barycert.Mesh(points, [[1, 2, 3], [0, 1, 2]], point_data={"T": [0, 1, 2, 9]})
    location = mesh.locate([[1, 1], [0.5, 0.5]])
    np.testing.assert_array_equal(location.cell, [1, 1])
    assert mesh.sample([1, 1], "T") == Fraction(3, 2)
    assert np.isnan(mesh.gradient("T")[0]).all() and not np.isnan(mesh.gradient("T")[1]).any()


@pytest.mark.parametrize("dimension", [2, 3])
def test_points_that_are_not_finite(dimension):
    points, cells = kuhn(2, dimension)
    mesh = barycert.Mesh(points, cells, point_data={"T": points.sum(axis=1)})
    at = np.full((4, dimension), 0.5)
    at[1, 0], at[2, -1], at[3] = np.nan, np.inf, 99
    for call in (mesh.locate, mesh.sample):
        with pytest.raises(barycert.Error, match="point 1: expected a finite number"):
            call(at)
        with pytest.raises(barycert.Error, match="expected error or nan"):
            call(at, nonfinite_points="some")
    found = mesh.locate(at, nonfinite_points="nan")
    assert found.cell[0] >= 0 and (found.cell[1:] == -1).all() and (found.feature[1:] == Feature.OUTSIDE).all()
    assert np.isnan(found.weights[1:]).all() and (found.matrix(outside="nearest").indptr[1:3] == found.matrix().indptr[1]).all()
    for options in ({}, {"fill_value": 7}, {"outside": "nearest"}):
        values = mesh.sample(at, "T", nonfinite_points="nan", **options)
        assert values[0] == 0.5 * dimension and np.isnan(values[1:3]).all()
        np.testing.assert_array_equal(found.sample("T", **options), values)
    begin, held = mesh.locate_all(at, nonfinite_points="nan")
    assert begin[1] > 0 and (begin[1:] == begin[1]).all() and len(held) == begin[1]
    nearest, distances = mesh.nearest(at, nonfinite_points="nan")
    assert (nearest[1:3] == -1).all() and np.isnan(distances[1:3]).all() and nearest[3] >= 0 and distances[3] > 0
    right = np.where(np.arange(4) == 0, 0.5 * dimension, np.nan)
    assert barycert.verify(mesh, at, {"T": right}, nonfinite_points="nan")
    for call in (mesh.locate_all, mesh.nearest, lambda p: barycert.verify(mesh, p, {"T": right})):
        with pytest.raises(barycert.Error, match="expected a finite number"):
            call(at)
    many = np.full((10_000, dimension), 0.5)
    many[9500, 1] = np.nan
    for call in (mesh.locate, mesh.locate_all):
        with pytest.raises(barycert.Error, match="coordinate 1 of point 9500"):
            call(many)
    masked = np.ma.array(np.full((2, dimension), 0.5), mask=[[False] * dimension, [True] + [False] * (dimension - 1)])
    np.testing.assert_array_equal(np.isnan(mesh.sample(masked, "T", nonfinite_points="nan")), [False, True])


@pytest.mark.parametrize("dimension", [2, 3])
@pytest.mark.parametrize("rounding", ["correct", "plain"])
def test_nodes_without_part_may_hold_anything(dimension, rounding):
    points, cells = kuhn(2, dimension)
    rng = np.random.default_rng(33)
    values = rng.integers(-8, 8, len(points)).astype(float)
    holes = rng.random(len(points)) < 0.4
    values[holes] = rng.choice([np.nan, np.inf, -np.inf], holes.sum())
    mesh = barycert.Mesh(points, cells, point_data={"T": values})
    nodes = np.where(holes, np.nan, values)
    np.testing.assert_array_equal(mesh.sample(points, "T", rounding=rounding), nodes)
    location = mesh.locate(points)
    np.testing.assert_array_equal(location.sample("T", rounding=rounding), nodes)
    np.testing.assert_array_equal(np.isfinite(location.matrix() @ values), ~holes)
    np.testing.assert_array_equal(barycert.Interpolator(points, cells, values)(points), nodes)
    corner = np.flatnonzero((points == points.max(axis=0)).all(axis=1))[0]
    np.testing.assert_array_equal(mesh.sample(points[corner] + 1, "T", outside="nearest", rounding=rounding), nodes[corner])
    report = mesh.check()
    assert f"field T: {holes.sum()} of {len(points)} values are not finite" in str(report)
    assert report.to_dict()["not_finite"] == [
        {"field": "T", "of": "nodes", "count": int(holes.sum()), "values": len(points)}
    ]
