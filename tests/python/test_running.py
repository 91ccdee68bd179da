"""How work runs: without the interpreter's lock, with Ctrl-C, with progress, without copies."""

import os
import signal
import subprocess
import sys
import threading
import time

import numpy as np
import pytest

import barycert
from conftest import kuhn


@pytest.fixture(scope="module")
def mesh():
    points, cells = kuhn(12, 3)
    return barycert.Mesh(points, cells, point_data={"T": points[:, 0]})


def while_another_thread_counts(work):
    """How often another thread got its turn while work() ran."""
    turns, stop = [0], threading.Event()

    def count():
        while not stop.is_set():
            turns[0] += 1
            time.sleep(0)

    thread = threading.Thread(target=count)
    thread.start()
    try:
        before = turns[0]
        work()
        return turns[0] - before
    finally:
        stop.set()
        thread.join()


def test_the_interpreter_is_free_while_work_runs(mesh):
    rng = np.random.default_rng(1)
    at = rng.random((400_000, 3)) * 12
    mesh.sample(at[:10], "T")
    location = mesh.locate(at)
    # A call that held the lock would let the other thread in once, before or after it.
    enough = 5
    assert while_another_thread_counts(lambda: mesh.sample(at, "T")) > enough
    assert while_another_thread_counts(lambda: mesh.locate(at)) > enough
    assert while_another_thread_counts(lambda: location.weights) > enough
    assert while_another_thread_counts(lambda: location.matrix()) > enough
    assert while_another_thread_counts(lambda: mesh.resample((80, 80, 80), fields="T")) > enough
    # A call of a few milliseconds may end before the other thread gets a core.
    large = barycert.Mesh(*kuhn(30, 3))
    assert while_another_thread_counts(lambda: large.check()) > enough
    far = [rng.random((2_000_000, 3)) for _ in range(5)]
    assert while_another_thread_counts(lambda: barycert.insphere(*far)) > enough


def test_threads_share_a_mesh(mesh):
    """The index is made once, by whoever asks first, and answers are those of one thread."""
    points, cells = kuhn(6, 3)
    shared = barycert.Mesh(points, cells, point_data={"T": points[:, 1]})
    at = np.random.default_rng(2).random((20_000, 3)) * 6
    results = [None] * 6

    def work(i):
        results[i] = shared.sample(at, "T")

    threads = [threading.Thread(target=work, args=(i,)) for i in range(len(results))]
    for thread in threads:
        thread.start()
    # Fields may change meanwhile: a call has those that it began with.
    for i in range(50):
        shared.point_data["other"] = points[:, 0] + i
    for thread in threads:
        thread.join()
    for result in results:
        np.testing.assert_array_equal(result, at[:, 1])


CTRL_C = """
import signal, sys
from functools import partial
import numpy as np
sys.path.insert(0, {tests!r})
import barycert
from barycert import _core
from conftest import kuhn

# A process started in the background may have been told to ignore the signal.
signal.signal(signal.SIGINT, signal.default_int_handler)
points, cells = kuhn(12, 3)
mesh = barycert.Mesh(points, cells, point_data={{"T": points[:, 0]}})
surface = barycert.Surface(points, cells[:, :3])
sampler = mesh._core.sampler(["T"], None)
options = lambda outside, threads: _core.SampleOptions(outside, np.nan, np.inf, "correct", threads, "error")
rng = np.random.default_rng(1)
inside = lambda n: rng.random((n, 3)) * 12
owners = lambda at: mesh.locate(at).cell
# Preparation, and the one call that is interrupted: about a second or more, on any machine.
prepare, make = {{
    "sample": (lambda: inside(16_000_000), lambda at: (sampler.sample, at, options("nan", 1), None)),
    "nearest": (lambda: inside(3_000_000) * 100 + 20, lambda at: (sampler.sample, at, options("nearest", 1), None)),
    "locate": (lambda: inside(16_000_000), lambda at: (_core.locate, mesh._core, at, 1, None, "error")),
    "surface_locate": (lambda: inside(2_000_000), lambda at: (surface._core.locate, at, 1)),
    "surface_nearest": (lambda: inside(2_000_000), lambda at: (surface._core.nearest, at, np.inf, [], 1)),
    "matrix": (
        lambda: inside(8_000_000), lambda at: (_core.matrix, mesh._core, at, owners(at), "nan", np.inf, None)
    ),
    "resample": (
        lambda: _core.Grid(3, [600, 600, 400], [0] * 3, [12] * 3),
        lambda grid: (sampler.on_grid, grid, options("nan", 2), None),
    ),
    "insphere": (lambda: [rng.integers(0, 3, (9_000_000, 3)) * 1.0 for _ in range(5)], lambda p: (_core.insphere, p)),
    "audit": (lambda: lambda v, p: [0, 0, 0, 1], lambda kernel: (partial(barycert.audit, count=100_000), kernel)),
    "audit_core": (lambda: "tetrahedron.*", lambda names: (partial(barycert.audit, count=10_000_000), names)),
}}[{what!r}]
call, *arguments = make(prepare())
results = []
print("begins", flush=True)
try:
    # No Python runs between the end of the call and the result: it is there if the call got to its end.
    results.extend(map(call, *([argument] for argument in arguments)))
except KeyboardInterrupt:
    print("at the end" if results else "interrupted")
"""


@pytest.mark.parametrize(
    "what",
    ["sample", "nearest", "locate", "surface_locate", "surface_nearest", "matrix", "resample", "insphere", "audit",
     "audit_core"],
)  # fmt: skip
def test_ctrl_c_ends_long_work(what):
    program = CTRL_C.format(tests=os.path.dirname(os.path.abspath(__file__)), what=what)
    process = subprocess.Popen([sys.executable, "-c", program], stdout=subprocess.PIPE, text=True)
    try:
        assert process.stdout.readline() == "begins\n"
        time.sleep(0.3)
        process.send_signal(signal.SIGINT)
        # Between parts of some tenths of a second; the margin is for machines with much else to do.
        output, _ = process.communicate(timeout=60)
    finally:
        process.kill()
    assert output == "interrupted\n"


def in_child(mesh, at):
    fresh = barycert.Mesh(mesh.points, mesh.cells, point_data={"T": mesh.points[:, 0]})
    return mesh.sample(at, "T"), fresh.sample(at, "T"), fresh.certified


@pytest.mark.parametrize("method", ["fork", "spawn"])
def test_processes_work_on_a_mesh(mesh, method):
    import multiprocessing

    at = np.random.default_rng(4).random((50_000, 3)) * 12
    expected = mesh.sample(at, "T")
    with multiprocessing.get_context(method).Pool(2) as pool:
        jobs = [pool.apply_async(in_child, (mesh, at)) for _ in range(3)]
        for job in jobs:
            old, fresh, certified = job.get(timeout=120)
            np.testing.assert_array_equal(old, expected)
            np.testing.assert_array_equal(fresh, expected)
            assert certified


def test_progress_is_told(mesh):
    calls = []

    def tell(stage, done, total):
        calls.append((stage, done, total))

    at = np.full((10_000, 3), 3.3)
    fresh = barycert.Mesh(mesh.points, mesh.cells, point_data={"T": mesh.points[:, 0]})
    fresh.sample(at, "T", progress=tell)
    assert [stage for stage, done, total in calls if total == 0] == ["ordering cells"]  # it is proved when it pays
    assert calls[-1] == ("points", 10_000, 10_000)
    large = barycert.Mesh(*kuhn(26, 3))
    calls.clear()
    large.locate(at, progress=tell)
    stages = ["ordering cells", "linking cells", "proving the partition"]
    assert [stage for stage, done, total in calls if total == 0] == stages
    for work, stage in (
        (lambda: fresh.locate(at, progress=tell), "points"),
        (lambda: fresh.locate(at).matrix(progress=tell), "weights"),
        (lambda: fresh.gradient("T", progress=tell), "gradients"),
        (lambda: barycert.verify(fresh, at, cells=fresh.locate(at).cell, progress=tell), "rows"),
        (lambda: fresh.resample(9, fields="T", progress=tell), "points"),
    ):
        calls.clear()
        work()
        assert calls[-1][0] == stage and calls[-1][1] == calls[-1][2] > 0
        assert [done for _, done, total in calls if total] == sorted(done for _, done, total in calls if total)
    calls.clear()
    fresh.check(progress=tell)
    assert len(calls) > 3


def test_what_progress_raises_ends_the_work(mesh):
    class Enough(Exception):
        pass

    def tell(stage, done, total):
        raise Enough

    at = np.full((10_000, 3), 3.3)
    fresh = barycert.Mesh(mesh.points, mesh.cells, point_data={"T": mesh.points[:, 0]})
    for work in (
        lambda: fresh.locate(at, progress=tell),
        lambda: fresh.locate(at).matrix(progress=tell),
        lambda: fresh.sample(at, "T", progress=tell),
        lambda: fresh.resample((50, 50, 50), fields="T", progress=tell),
        lambda: fresh.check(progress=tell),
        lambda: barycert.audit("tetrahedron.*", count=100, progress=tell),
    ):
        with pytest.raises(Enough):
            work()
    # And the mesh is as it was.
    assert fresh.sample(at[:1], "T") == 3.3


def test_tqdm_shows_progress(mesh, capfd):
    pytest.importorskip("tqdm")
    mesh.sample(np.full((10_000, 3), 3.3), "T", progress=True)
    assert "points" in capfd.readouterr().err
    mesh.sample(np.full((10_000, 3), 3.3), "T", progress=False)
    assert capfd.readouterr().err == ""
    with pytest.raises(barycert.Error, match="progress="):
        mesh.sample([[1, 1, 1]], "T", progress=3)


def resident():
    with open("/proc/self/statm") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")


def test_points_and_results_are_not_copied(mesh):
    from barycert._arguments import exact_doubles, points_of

    at = np.random.default_rng(3).random((100, 4, 3))
    rows, shape = points_of(at, 3)
    assert shape == (100, 4) and np.shares_memory(rows, at)
    assert exact_doubles(at, "points") is at
    # An array that is not contiguous, or of another type, is copied, and means the same.
    flipped = np.asfortranarray(at)
    assert not np.shares_memory(points_of(flipped, 3)[0], flipped)
    np.testing.assert_array_equal(mesh.sample(flipped, "T"), mesh.sample(at, "T"))
    np.testing.assert_array_equal(mesh.sample(at.astype(np.float32), "T"), mesh.sample(at.astype(np.float32).astype(float), "T"))
    # Views of the mesh are views, and cannot be written to.
    assert mesh.points.__array_interface__["data"] == mesh.points.__array_interface__["data"]
    for view in (mesh.points, mesh.cells, mesh.point_data["T"]):
        assert not view.flags.owndata
        with pytest.raises(ValueError):
            view[0] = 0


def test_results_outlive_what_made_them():
    points, cells = kuhn(2, 3)
    mesh = barycert.Mesh(points, cells, point_data={"T": points[:, 0]})
    kept = [mesh.points, mesh.cells, mesh.point_data["T"], mesh.locate(points).weights, mesh.check().measures["volume"]]
    copies = [array.copy() for array in kept]
    mesh.point_data["T"] = points[:, 1]
    del mesh
    np.empty(1000).fill(7)
    for array, copy in zip(kept, copies):
        np.testing.assert_array_equal(array, copy)


def test_memory_comes_back():
    points, cells = kuhn(8, 3)
    at = np.random.default_rng(1).random((200_000, 3)) * 8

    def once():
        mesh = barycert.Mesh(points, cells, point_data={"T": points})
        mesh.sample(at, "T")
        mesh.locate(at).matrix()
        mesh.check()

    for _ in range(3):
        once()
    before = resident()
    for _ in range(8):
        once()
    # One round makes more than 15 MB of results.
    assert resident() - before < 40e6


def test_counts_are_not_negative(mesh):
    at = [[1, 1, 1]]
    audit = lambda **what: barycert.audit("triangle.signed-area", **{"count": 5, **what})
    for name, calls in {
        "threads": [
            lambda n: mesh.locate(at, threads=n),
            lambda n: mesh.locate_all(at, threads=n),
            lambda n: mesh.sample(at, "T", threads=n),
            lambda n: mesh.locate(at).sample("T", threads=n),
            lambda n: mesh.resample(2, fields="T", threads=n),
            lambda n: barycert.Interpolator(mesh, mesh.points, threads=n)(at),
            lambda n: mesh.check(threads=n),
            lambda n: barycert.verify(mesh, at, cells=[0], threads=n),
            lambda n: audit(threads=n),
        ],
        "examples": [lambda n: mesh.check(examples=n), lambda n: barycert.verify(mesh, at, cells=[0], examples=n)],
        "contacts": [lambda n: mesh.check(contacts=n)],
        "count": [lambda n: audit(count=n)],
        "seed": [lambda n: audit(seed=n)],
    }.items():
        for call in calls:
            call(np.int8(2))
            with pytest.raises(barycert.Error, match=f"{name}=: expected 0 or more, found -1"):
                call(-1)
            with pytest.raises(TypeError, match="interpreted as an integer"):
                call(2.5)


def test_errors_have_parts(tmp_path):
    path = tmp_path / "broken.node"
    (tmp_path / "broken.ele").write_text("1 4 0\n1 1 2 3 4\n")
    path.write_text("4 3 0 0\n1 0 0 0\n2 1 0 x\n3 0 1 0\n4 0 0 1\n")
    with pytest.raises(barycert.Error) as info:
        barycert.read(path)
    assert isinstance(info.value, ValueError)
    assert info.value.file.endswith("broken.node") and info.value.line == 3
    assert str(info.value).startswith(f"{path}:3: ")
    assert info.value.expected and info.value.found
