"""Linear interpolation with the call of SciPy's LinearNDInterpolator."""

from __future__ import annotations

import functools
import threading
from typing import Any, Optional, Tuple

import numpy as np

from . import _core
from ._arguments import Progress, exact_doubles, forwarded, options_of, points_of, telling, values_of
from ._mesh import Mesh


class Interpolator:
    """Interpolates values at nodes over triangles or tetrahedra: exact cells, correctly rounded values.

    It stands where scipy.interpolate.LinearNDInterpolator stands, and is called as that is:

        f = Interpolator(points, cells, values)
        f(p)        # p (..., d)
        f(x, y)     # arrays that broadcast

    Args:
        points: (n, d) nodes, d = 2 or 3; or a mesh, and then no cells: a barycert.Mesh, a SciPy Delaunay, a matplotlib
            Triangulation, a mesh of meshio, pyvista or VTK.
        cells: (m, d + 1) node indices from 0, of any integer type, or of second order as for `Mesh`. None: SciPy's Delaunay
            triangulation of the points, as LinearNDInterpolator makes it. `Interpolator(points, values)` is the same.
        values: (n, ...) real or complex numbers at the nodes. float32 is converted, which is exact; results are float64
            or complex128.
        fill_value: what points outside get.
        outside: instead of that "nan", "raise", "nearest" or "extrapolate"; it and limit, rounding, threads: as for
            `Mesh.sample`.
        nonfinite_points: "nan": points with a coordinate that is NaN, infinite or masked get NaN, also where `fill_value`
            is another number, and `nonfinite_count` counts them; "error": an Error that names the first.

    Each value is the exact interpolation in the owner, the lowest cell that contains the point, rounded once to nearest,
    ties to even, for real and imaginary part alike; so it does not depend on threads, order or machine. A component is NaN
    where a value of its cell is not finite.

    Any number of threads may call it at the same time. It can be pickled and copied.
    """

    def __init__(
        self, points: Any, cells: Any = None, values: Any = None, *, fill_value: Any = np.nan,
        outside: Optional[str] = None, limit: float = np.inf, rounding: str = "correct", nonfinite_points: str = "nan",
        threads: int = 0, progress: Progress = None,
    ) -> None:  # fmt: skip
        if values is None:
            # Interpolator(points or mesh, values), as SciPy has it.
            cells, values = None, cells
        if values is None:
            _core.fail("option.missing", "Interpolator without values", expected="Interpolator(points, cells, values)")
        self.mesh = _mesh_of(points, cells)
        self._values = values = np.asanyarray(values)
        self._complex = values.dtype.kind == "c"
        rows, _ = values_of(_parts(values) if self._complex else values, len(self.mesh.points), "values")
        self._given = {"fill_value": fill_value, "outside": outside, "limit": limit, "rounding": rounding,
                       "nonfinite_points": nonfinite_points, "threads": threads}  # fmt: skip
        self._nonfinite_count, self._lock = 0, threading.Lock()
        # A complex number takes the place of two: it is put in afterwards.
        self._fill_after = self._complex and (outside == "fill" or (outside is None and not np.isnan(fill_value)))
        filled = ("nan", np.nan) if self._fill_after else (outside, np.real(fill_value))
        self._options = options_of(*filled, limit, rounding, threads, nonfinite_points)
        if not self._complex and np.iscomplexobj(fill_value):
            _core.fail("argument.type", "fill_value", expected="a real number, as the values are", found=repr(fill_value))
        self._sampler = self.mesh._core.sampler_of(rows, telling(progress))

    points: np.ndarray = forwarded("mesh.points", "(n, d) the nodes.")
    cells: np.ndarray = forwarded("mesh.cells", "(m, d + 1) the vertices of the cells.")
    values: np.ndarray = forwarded("_values", "(n, ...) the values, as they were given.")
    nonfinite_count: int = forwarded(
        "_nonfinite_count", "How many points of all calls so far were not finite, and got NaN."
    )

    def __call__(self, *args: Any, progress: Progress = None) -> np.ndarray:
        """Values at points.

        Args:
            args: points (..., d); or d arrays of coordinates that broadcast, as one tuple or as several arguments. One
                point of shape (d,) counts as (1, d), as in SciPy.
            progress: a callable of (stage, done, total), or True for a bar of tqdm.

        Returns:
            (...) + the shape of one value.
        """
        rows, shape = self._coordinates(args)
        finite = np.isfinite(rows).all(axis=1)
        result = self._sampler.sample(rows, self._options, telling(progress))
        if self._fill_after:
            threads, nonfinite = self._given["threads"], self._given["nonfinite_points"]
            cell, _ = _core.locate(self.mesh._core, rows, threads, telling(progress), nonfinite)
        with self._lock:
            self._nonfinite_count += len(rows) - np.count_nonzero(finite)
        if self._complex:
            result = result.view(np.complex128)
            if self._fill_after:
                result[(cell < 0) & finite] = self._given["fill_value"]
        return result.reshape(shape + self._values.shape[1:])

    def _coordinates(self, args: Tuple[Any, ...]) -> Tuple[np.ndarray, Tuple[int, ...]]:
        d, nonfinite = self.mesh.dimension, self._given["nonfinite_points"]
        if len(args) == 1 and isinstance(args[0], tuple):
            args = args[0]
        if len(args) not in (1, d):
            _core.fail("argument.size", "number of coordinates", expected=f"points (..., {d}), or {d} arrays", found=str(len(args)))
        if len(args) == 1:
            points = exact_doubles(args[0], "points", nonfinite)
            if points.ndim == 1 and points.size % d == 0:
                points = points.reshape(-1, d)
        else:
            points = np.stack(np.broadcast_arrays(*(exact_doubles(a, "coordinates", nonfinite) for a in args)), axis=-1)
        return points_of(points, d)

    def __reduce__(self) -> Tuple[Any, ...]:
        return functools.partial(Interpolator, **self._given), (self.mesh, self._values)

    def __repr__(self) -> str:
        kind = "triangles" if self.mesh.dimension == 2 else "tetrahedra"
        return f"<barycert.Interpolator: {len(self.points)} nodes, {len(self.cells)} {kind}, values {self._values.shape}>"


def _mesh_of(points: Any, cells: Any) -> Mesh:
    if isinstance(points, Mesh):
        if cells is not None:
            _core.fail("option.conflict", "cells of a mesh that has cells", expected="Interpolator(mesh, values)")
        return points
    if cells is None and isinstance(points, (np.ndarray, list, tuple)):
        try:
            from scipy.spatial import Delaunay
        except ImportError:
            _core.fail("tool.missing", "no cells, and no SciPy to make a Delaunay triangulation", remedy="pass cells, or install SciPy")
        cells = Delaunay(exact_doubles(points, "points"))
    return Mesh(points, cells)


def _parts(values: np.ndarray) -> np.ndarray:
    """Real and imaginary parts as a last axis."""
    if values.dtype.itemsize > 16:
        _core.fail("argument.type", "type of the values", expected="complex64 or complex128", found=str(values.dtype))
    if np.ma.is_masked(values):
        _core.fail("argument.not-finite", "masked entries of the values", remedy="say what they are: .filled(numpy.nan)")
    return np.stack([values.real, values.imag], axis=-1)
