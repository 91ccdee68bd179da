"""Surfaces: what lies inside, what is nearest, and whether they are clean."""

import copy
import pickle
import struct
from fractions import Fraction

import numpy as np
import pytest

import barycert


def cube(low=0.0, high=1.0):
    """Corners and twelve triangles, normals outwards."""
    points = np.array([[x, y, z] for x in (low, high) for y in (low, high) for z in (low, high)])
    squares = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    triangles = [t for a, b, c, d in squares for t in ((a, b, c), (a, c, d))]
    return points, np.array(triangles)


def test_cube_is_certified():
    surface = barycert.Surface(*cube())
    report = surface.check()
    assert report and report.verdict == "certified"
    facts = report.to_dict()["surface"]
    assert facts["closed"] and facts["manifold"] and facts["oriented"] and facts["outward"]
    assert facts["regions"] == [{"volume": 1.0, "shell": 0, "hole": False}]
    assert "TetGen will get a valid PLC" in facts["tetgen"]
    assert "certified" in str(report) and "<html" in report.html()
    assert repr(surface) == "<barycert.Surface: 8 points, 12 triangles>"


def test_defects_have_places():
    points, triangles = cube()
    report = barycert.Surface(points, triangles[1:]).check()
    assert not report
    assert [d.kind for d in report.defects] == ["open_edge"]
    assert report.defects[0].count == 3


def test_intersections_have_witnesses():
    points = np.array([[0, 0, 0], [3, 0, 0], [0, 3, 0], [1, 1, -1], [1, 1, 1], [2, 2, 1.0]])
    report = barycert.Surface(points, [[0, 1, 2], [3, 4, 5]]).check()
    (contact,) = report.contacts
    assert contact.cells == (0, 1)
    x, y, z = map(Fraction, contact.fraction)
    assert z == 0 and x == y and 0 <= x + y <= 3


def test_inside_and_on():
    surface = barycert.Surface(*cube())
    points = [[0.5, 0.5, 0.25], [2, 0.5, 0.5], [0.5, 0.25, 0], [0, 0, 0], [np.nextafter(1, 2), 0.5, 0.5]]
    assert surface.turned == "alike"
    assert surface.contains(points).tolist() == [True, False, True, True, False]
    assert surface.contains(points, boundary=False).tolist() == [True, False, False, False, False]
    triangle, feature, winding = surface.locate(points)
    names = [barycert.Feature(f).name.lower() for f in feature]
    assert names == ["interior", "outside", "face", "vertex", "outside"]
    assert triangle[0] == -1 and triangle[3] == 0
    assert winding.tolist() == [1, 0, 0, 0, 0]
    with pytest.raises(barycert.Error, match="the surface has no inside"):
        barycert.Surface(cube()[0], cube()[1][1:]).contains(points)


def test_inside_what_is_enclosed():
    points, triangles = cube()
    corner = {tuple(p): i for i, p in enumerate(points.tolist())}
    wall = [[corner[0, 0, 0], corner[1, 1, 0], corner[1, 1, 1]], [corner[0, 0, 0], corner[1, 1, 1], corner[0, 0, 1]]]
    turned = triangles.copy()
    turned[5] = turned[5][::-1]
    for surface in [
        barycert.Surface(points, turned),
        barycert.Surface(points, np.concatenate([triangles, triangles[:2, ::-1]])),
    ]:
        assert surface.turned == "regions"
        assert surface.contains([[0.5, 0.25, 0.25], [0.25, 0.5, 0.25], [2, 0, 0]]).tolist() == [True, True, False]
        assert surface.distance([0.5, 0.5, 0.75]).item() == -0.25
    # The wall goes along diagonals of the cube or crosses them.
    surface = barycert.Surface(points, np.concatenate([triangles, wall]))
    assert (surface.turned == "open") == (not surface.check(contacts=0).certified)


def test_triangles_without_area_are_segments_and_points():
    points = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [5, 0, 0], [6, 0, 0], [7, 0, 0.0]]
    surface = barycert.Surface(points, [[0, 1, 2], [3, 4, 5]], {"u": np.arange(6.0)})
    near = surface.nearest([[5.5, 1, 0], [6, 2, 0]])
    assert near.triangle.tolist() == [1, 1] and near.distance.tolist() == [1, 2]
    assert near.nodes.tolist() == [[3, 4, -1], [4, -1, -1]]
    assert surface.sample([5.25, 1, 0], "u").item() == 3.25
    assert surface.hits([5.5, 1, 0], [5.5, -1, 0]) == [(1, "edge", 0.5, 0)]
    triangle, feature, _ = surface.locate([[5.5, 0, 0], [5.5, 1, 0]])
    assert triangle.tolist() == [1, -1] and barycert.Feature(feature[0]).name == "EDGE"


def test_nearest_and_signed_distance():
    surface = barycert.Surface(*cube())
    points = np.array([[[0.5, 0.25, 3], [3, 4, 1]], [[0.5, 0.5, 0.75], [-1, -1, -1]]])
    found = surface.nearest(points)
    assert found.triangle.shape == (2, 2) and found.point.shape == (2, 2, 3)
    assert found.distance.tolist() == [[2, np.sqrt(13)], [0.25, np.sqrt(3)]]
    assert found.point[0].tolist() == [[0.5, 0.25, 1], [1, 1, 1]]
    assert (found.nodes[0, 1] >= 0).sum() == 1 and found.weights[0, 1, 0] == 1
    assert surface.distance(points).tolist() == [[2, np.sqrt(13)], [-0.25, np.sqrt(3)]]
    near = surface.nearest(points, limit=1)
    assert near.triangle[0].tolist() == [-1, -1] and np.isnan(near.distance[0]).all()


def test_values_are_exact_means():
    points, triangles = cube()
    surface = barycert.Surface(points, triangles, {"x": points[:, 0], "p": points}, {"n": np.arange(12.0)})
    at = np.array([[0.3, 0.2, 5], [0.1, 0.7, -2]])
    values = surface.sample(at)
    assert values["x"].tolist() == [0.3, 0.1]
    assert values["p"].tolist() == [[0.3, 0.2, 1], [0.1, 0.7, 0]]
    assert values["n"].tolist() == surface.nearest(at).triangle.tolist()
    assert surface.sample(at, "x").tolist() == [0.3, 0.1]
    assert np.isnan(surface.sample(at, "x", limit=1)).all()
    with pytest.raises(barycert.Error, match="name of a field"):
        surface.sample(at, "y")


def test_hits_in_order():
    surface = barycert.Surface(*cube())
    hits = surface.hits([-1, 0.25, 0.5], [3, 0.25, 0.5])
    assert [(h[1], h[2], h[3]) for h in hits] == [("face", 0.25, -1), ("face", 0.5, 1)]
    assert len(surface.hits([-1, 0.25, 0.5], [-0.5, 0.25, 0.5])) == 0
    assert len(surface.hits([-1, 0.25, 0.5], [-0.5, 0.25, 0.5], ray=True)) == 2


def test_files(tmp_path):
    points, triangles = cube()
    path = tmp_path / "cube.stl"
    records = b"".join(struct.pack("<12fH", 0, 0, 0, *points[t].ravel(), 0) for t in triangles)
    path.write_bytes(b"\0" * 80 + struct.pack("<I", 12) + records)
    surface = barycert.Surface.read(path)
    assert len(surface.points) == 8 and len(surface) == 12
    assert surface.check()


def test_copies_and_pickles(tmp_path):
    points, triangles = cube()
    surface = barycert.Surface(points, triangles, {"p": points}, {"n": np.arange(12)})
    at = np.array([[0.3, 0.2, 5], [0.1, 0.7, -2]])
    for other in (pickle.loads(pickle.dumps(surface)), copy.copy(surface), copy.deepcopy(surface)):
        np.testing.assert_array_equal(other.points, points)
        np.testing.assert_array_equal(other.triangles, triangles)
        assert repr(other) == repr(surface) and other.check()
        for name, values in surface.sample(at).items():
            np.testing.assert_array_equal(other.sample(at, name), values)
        other.point_data["new"] = np.ones(8)
        assert "new" not in surface.point_data
    deep = copy.deepcopy(surface)
    deep.point_data["p"][:] = 0
    np.testing.assert_array_equal(surface.point_data["p"], points)
    # The polygons of a file go along.
    lines = ["OFF", "8 6 0", *("%g %g %g" % tuple(p) for p in points), "4 0 1 3 2", "4 4 6 7 5", "4 0 4 5 1", "4 2 3 7 6",
             "4 0 2 6 4", "4 1 5 7 3", ""]  # fmt: skip
    (tmp_path / "cube.off").write_text("\n".join(lines))
    read = barycert.Surface.read(tmp_path / "cube.off")
    other = pickle.loads(pickle.dumps(read))
    assert other.notes == read.notes and other.check().to_dict()["surface"] == read.check().to_dict()["surface"]
    assert other.check().to_dict()["surface"]["facets"] == 6


def test_more_points_than_a_part_has():
    surface = barycert.Surface(*cube(), {"x": cube()[0][:, 0]})
    at = np.random.default_rng(1).random((100_000, 3)) * 2 - 0.5
    whole, near, values = surface.locate(at), surface.nearest(at), surface.sample(at, "x")
    np.testing.assert_array_equal(whole[2] != 0, ((at > 0) & (at < 1)).all(axis=1))
    np.testing.assert_array_equal(values, near.point[:, 0])
    for all_of, part in zip(whole, surface.locate(at[90_000:])):
        np.testing.assert_array_equal(all_of[90_000:], part)
    np.testing.assert_array_equal(near.distance[90_000:], surface.nearest(at[90_000:]).distance)
    at[95_000, 1] = np.nan
    for ask in (surface.locate, surface.nearest):
        with pytest.raises(barycert.Error, match="coordinate 1 of point 95000"):
            ask(at)


def test_other_packages():
    class Trimesh:
        vertices, faces = cube()

    assert barycert.Surface(Trimesh()).check()
    meshio = pytest.importorskip("meshio")
    mesh = meshio.Mesh(cube()[0], [("triangle", cube()[1])], point_data={"x": cube()[0][:, 0]})
    surface = barycert.Surface(mesh)
    assert surface.check() and list(surface.point_data) == ["x"]


def test_vtk():
    vtk = pytest.importorskip("vtkmodules.vtkFiltersSources")
    source = vtk.vtkSphereSource()
    source.Update()
    surface = barycert.Surface(source.GetOutput())
    assert surface.check() and surface.contains([0, 0, 0])


@pytest.mark.parametrize(
    "points, triangles, what",
    [([[0, 0]], [[0, 0, 0]], "shape of the points"), (cube()[0], [[0, 1]], "triangles"),
     (cube()[0], [[0, 1, 8]], "a corner of a triangle"), (cube()[0], [[0.0, 1, 2]], "triangles"),
     (cube()[0], np.broadcast_to(np.int8(0), (2**31, 3)), "at most 2147483647 points and triangles")],
)  # fmt: skip
def test_errors(points, triangles, what):
    with pytest.raises(barycert.Error, match=what):
        barycert.Surface(points, triangles)
