"""Audits of kernels in Python and in libraries, and verification of results."""

import os
import subprocess
import sys

import numpy as np
import pytest

import barycert
from barycert import _core
from conftest import SOURCES, delaunay, exact_weights, kuhn, rounded

pytestmark = pytest.mark.skipif(not _core.has_audit, reason="this build has no audit")


def solve(vertices, point):
    matrix = np.vstack([vertices.T, np.ones(len(vertices))])
    try:
        return np.linalg.solve(matrix, np.append(point, 1))
    except np.linalg.LinAlgError:
        return None


def exact_kernel(vertices, point):
    weights = exact_weights(vertices, point)
    if weights is None:
        return None
    try:
        return [rounded(w) for w in weights]
    except OverflowError:
        return [np.inf] * len(weights)


@pytest.mark.parametrize("simplex, shape", [("triangle", (3, 2)), ("tetrahedron", (4, 3))])
def test_a_callable_is_audited(simplex, shape):
    seen = []

    def kernel(vertices, point):
        seen.append((vertices.shape, point.shape))
        return solve(vertices, point)

    report = barycert.audit(kernel, simplex=simplex, declares_degenerate=True, count=50)
    assert set(seen) == {(shape, (shape[1],))}
    (result,) = report.kernels
    assert result.name == f"{simplex}.kernel" and result.cases == len(seen)
    assert not report and result.wrong_cases > 0 and result.findings["opposite_sign"] > 0
    assert result.witnesses and result["cases"] == result.cases and len(dict(result)) > 10
    assert "kernel" in str(report) and "cases wrong" in repr(report) and report.to_dict()["seed"] == 1
    assert report.html().startswith("<!DOCTYPE html")


def test_an_exact_callable_has_no_findings():
    """The oracle of these tests against the library's."""
    families = ["random", "sliver*", "degenerate*"]
    report = barycert.audit(exact_kernel, name="fractions", declares_degenerate=True, count=20, families=families, oracle="both")
    assert report and report.kernels[0].findings == {} and report.kernels[0].cases >= 60
    assert report.kernels[0].worst_weight_ulp <= 0.5


def test_kernels_of_the_catalogue():
    assert barycert.audit("tetrahedron.exact", count=20)
    report = barycert.audit(solve, name="solve", against=["tetrahedron.exact"], count=20, declares_degenerate=True)
    assert {kernel.name for kernel in report.kernels} == {"tetrahedron.solve", "tetrahedron.exact"}
    names = [kernel["name"] for kernel in barycert.kernels()]
    assert "tetrahedron.exact" in names and len(names) > 30
    assert "random" in [family["name"] for family in barycert.families()]


def test_meshes_give_cases():
    mesh = barycert.Mesh(*kuhn(2, 3))
    report = barycert.audit("tetrahedron.exact", meshes={"cubes": mesh}, count=20)
    assert report and report.to_dict()["meshes"] == ["cubes"]
    assert any(family["needs_mesh"] for family in report.to_dict()["families"])


def test_a_tolerance_is_a_rule():
    strict = barycert.audit(solve, count=50, declares_degenerate=True)
    tolerant = barycert.audit(solve, count=50, declares_degenerate=True, tolerance=1e-6)
    assert tolerant.kernels[0].findings["false_inside"] > strict.kernels[0].findings.get("false_inside", 0)


def test_an_exception_without_words_is_a_finding_too():
    class Mute(Exception):
        def __str__(self):
            raise ValueError("no words")

    def kernel(vertices, point):
        raise Mute()

    report = barycert.audit(kernel, count=10, families="random")
    assert report.kernels[0].findings == {"raised": report.kernels[0].cases}
    assert report.kernels[0].witnesses[0]["detail"] == "raised Mute, whose text cannot be had"


def test_an_exception_of_a_callable_is_a_finding():
    def kernel(vertices, point):
        matrix = np.vstack([vertices.T, np.ones(len(vertices))])
        return np.linalg.solve(matrix, np.append(point, 1))

    report = barycert.audit(kernel, count=50, families=["random", "degenerate*"])
    (result,) = report.kernels
    assert not report and result.cases > 50 and 0 < result.findings["raised"] < result.cases
    (witness,) = [w for w in result.witnesses if w["reason"] == "raised"]
    assert witness["detail"] == "raised LinAlgError: Singular matrix"
    # No command would have the callable.
    assert all("barycert replay" not in text for text in (str(report), report.text(wide=True), report.html()))
    assert witness["detail"] in str(report) and f"raised in {result.findings['raised']} cases" in str(report)
    # The others are judged as if it had declared these degenerate, and so are their figures.
    declares = barycert.audit(solve, count=50, families=["random", "degenerate*"], declares_degenerate=True)
    assert result["worst_weight_ulp"] == declares.kernels[0]["worst_weight_ulp"]
    nested = barycert.audit(lambda v, p: barycert.audit(solve, count=10), count=10, families="random")
    assert nested.kernels[0].findings == {"raised": nested.kernels[0].cases}
    assert "raised Error: an audit of a callable within an audit" in nested.kernels[0].witnesses[0]["detail"]


FORKS = """
import os, sys
import barycert

def kernel(vertices, point):
    child = os.fork()
    if sys.argv[1] == "waits":
        if child == 0:
            os._exit(0)
        os.waitpid(child, 0)
    elif sys.argv[1] == "raises" and child == 0:
        sys.exit(3)
    return [1, 0, 0, 0]

try:
    barycert.audit(kernel, count=5, families="random")
    print("ended")
except barycert.Error as e:
    print(e)
"""


@pytest.mark.parametrize("what", ["goes on", "raises", "waits"])
def test_a_callable_that_forks_does_not_double_the_script(what):
    done = subprocess.run([sys.executable, "-c", FORKS, what], capture_output=True, text=True, timeout=60)
    assert done.returncode == 0 and done.stderr == ""
    (line,) = done.stdout.splitlines()
    if what == "waits":
        assert line == "ended"
    else:
        assert line.startswith("the kernel left a process behind that it had forked; let it end its processes")


def test_what_is_no_answer_and_no_exception_ends_the_audit():
    def kernel(vertices, point):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        barycert.audit(kernel, count=10)
    with pytest.raises(barycert.Error, match="expected 4 weights"):
        barycert.audit(lambda v, p: [1, 2], count=10)
    with pytest.raises(ValueError):
        barycert.audit(lambda v, p: "text", count=10)
    for arguments, message in (
        ({"simplex": "square"}, "square"),
        ({"families": ["none"]}, "no family of that name"),
        ({"oracle": "none"}, "oracle"),
        ({"against": ["none"]}, "no kernel of that name"),
    ):
        with pytest.raises(barycert.Error, match=message):
            barycert.audit(solve, count=10, **arguments)
    # And the next one is as if nothing had been.
    assert barycert.audit(exact_kernel, declares_degenerate=True, count=5, families="random")


def test_shared_libraries(tmp_path):
    source = tmp_path / "kernel.c"
    source.write_text(
        """
#include "barycert/kernel.h"
void barycert_kernel_describe(struct barycert_kernel_info* info) {
    info->abi = BARYCERT_KERNEL_ABI;
    info->name = "corner";
    info->simplex = "triangle";
}
int barycert_kernel_weights(const double* vertices, const double* point, double* weights) {
    weights[0] = 1;
    weights[1] = weights[2] = 0;
    return 0;
}
"""
    )
    library = tmp_path / "corner.so"
    command = ["cc", "-shared", "-fPIC", "-I", os.path.join(SOURCES, "src", "audit", "include"), "-o", library, source]
    subprocess.run(command, check=True)
    for contained in (True, False):
        report = barycert.audit(library, count=20, contained=contained)
        assert report.kernels[0].name == "triangle.corner" and report.kernels[0].wrong_cases > 0
    with pytest.raises(barycert.Error, match="none.so"):
        barycert.audit(tmp_path / "none.so")


@pytest.fixture
def mesh():
    points, cells = delaunay(100, 3, 3)
    rng = np.random.default_rng(4)
    return barycert.Mesh(points, cells, point_data={"T": rng.random(100), "v": rng.random((100, 2))})


def test_right_results_are_right(mesh):
    at = np.random.default_rng(5).random((2, 500, 3)) * 1.2 - 0.1
    rows = mesh.sample(at)
    location = mesh.locate(at)
    values = {"T": rows["T"], "v": rows["v"]}
    found = barycert.verify(mesh, at, values, cells=location.cell, inside=location.inside, exact=True)
    assert found and found.rows == 1000 and found.wrong == 0 and found.examples == []
    assert found.inside == np.count_nonzero(location.inside) and [c.name for c in found.columns] == ["T", "v.0", "v.1"]
    assert all(c.identical == c.values == found.inside for c in found.columns)
    assert barycert.verify(mesh, at, rows["T"], fields="T", exact=True)
    assert barycert.verify(mesh, at, cells=location.cell) and barycert.verify(mesh, at, inside=location.inside)


def test_planted_errors_are_found(mesh):
    at = np.random.default_rng(5).random((1000, 3)) * 1.2 - 0.1
    values, location = mesh.sample(at, "T"), mesh.locate(at)
    inside, outside = np.flatnonzero(location.inside), np.flatnonzero(~location.inside)
    values[inside[3]] = np.nan
    values[outside[2]] = 0.5
    values[inside[7]] += 1e-3
    cells = location.cell.astype(np.int64)
    cells[inside[9]] = (cells[inside[9]] + 1) % len(mesh.cells)
    cells[inside[3]] = -1
    cells[outside[2]] = 0
    found = barycert.verify(mesh, at, {"T": values}, cells=cells)
    assert not found and (found.missed, found.invented, found.wrong_value, found.wrong_cell) == (1, 1, 1, 1)
    by_verdict = {row.verdict: row for row in found.examples}
    assert by_verdict["missed"].row == inside[3] and by_verdict["missed"].cell == location.cell[inside[3]]
    assert by_verdict["invented"].row == outside[2] and by_verdict["invented"].distance > 0
    assert by_verdict["wrong value"].row == inside[7] and by_verdict["wrong value"].column == "T"
    assert by_verdict["wrong cell"].row == inside[9]
    exact = mesh.sample(at, "T")
    invented, missed, wrong = by_verdict["invented"], by_verdict["missed"], by_verdict["wrong value"]
    assert (invented.column, missed.column) == ("T", "T")
    assert invented.claimed == 0.5 and np.isnan([invented.value, invented.ulps, invented.relative]).all()
    assert missed.value == exact[inside[3]] and np.isnan([missed.claimed, missed.ulps, missed.relative]).all()
    assert wrong.claimed == exact[inside[7]] + 1e-3 and wrong.value == exact[inside[7]] and wrong.ulps > 1 > wrong.relative > 0
    without = barycert.verify(mesh, at, cells=cells).examples[0]
    assert without.column == "" and np.isnan([without.claimed, without.value, without.ulps, without.relative]).all()
    assert "996 of 1000 rows right" in repr(found) and "1 missed" in repr(found)
    # One unit in the last place is found where bits are asked for.
    values = mesh.sample(at, "T")
    values[inside[0]] = np.nextafter(values[inside[0]], 2)
    assert barycert.verify(mesh, at, {"T": values})
    exact = barycert.verify(mesh, at, {"T": values}, exact=True)
    assert exact.wrong_value == 1 and exact.examples[0].ulps == 1


def test_scipys_results_are_judged(mesh):
    interpolate = pytest.importorskip("scipy.interpolate")
    spatial = pytest.importorskip("scipy.spatial")
    triangulation = spatial.Delaunay(mesh.points)
    at = np.random.default_rng(6).random((2000, 3))
    values = interpolate.LinearNDInterpolator(triangulation, mesh.point_data["T"])(at)
    found = barycert.verify(mesh, at, values, fields="T")
    assert found.wrong_value == 0 and found.columns[0].identical < found.columns[0].values
    filled = np.where(np.isnan(values), -1, values)
    assert barycert.verify(mesh, at, filled, fields="T", outside_value=-1).invented == found.invented


def test_verification_checks_its_arguments(mesh):
    at = np.zeros((5, 3))
    for arguments, message in (
        (({},), "nothing"),
        ((np.zeros(5),), "without a name"),
        (({"T": np.zeros(4)},), "shape of the values"),
        (({"none": np.zeros(5)},), '"none"'),
    ):
        with pytest.raises(barycert.Error, match=message):
            barycert.verify(mesh, at, *arguments)
    with pytest.raises(barycert.Error, match="nothing to compare"):
        barycert.verify(mesh, at)
    with pytest.raises(barycert.Error, match="shape of cells"):
        barycert.verify(mesh, at, cells=np.zeros(4, dtype=int))
    with pytest.raises(barycert.Error, match="expected integers"):
        barycert.verify(mesh, at, cells=np.zeros(5))
