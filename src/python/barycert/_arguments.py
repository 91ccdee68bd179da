"""Arguments as the compiled part takes them: checked, and converted where they must be."""

from __future__ import annotations

import contextlib
import operator
from typing import Any, Callable, Dict, Optional, Tuple, Union

import numpy as np

from . import _core

Progress = Union[None, bool, Callable[[str, int, int], Any]]
Shape = Tuple[int, ...]


def real(array: Any, what: str) -> np.ndarray:
    """An array of real numbers, as it is; Error if it is of another kind."""
    if isinstance(array, np.ma.MaskedArray) and np.ma.is_masked(array):
        finite = what.startswith(("points", "coordinates", "vertices"))
        _core.fail("argument.not-finite", f"masked entries of the {what}",
            remedy="leave them out" if finite else "say what they are: .astype(float).filled(numpy.nan)",
        )
    array = np.asarray(array)
    if array.dtype.kind not in "fiub":
        _core.fail("argument.type", f"type of the {what}", expected="real numbers", found=str(array.dtype))
    if array.dtype.itemsize > 8:
        _core.fail("argument.type", f"type of the {what}", expected="numbers that float64 can hold", found=str(array.dtype),
                   remedy="round them yourself: .astype(float)")  # fmt: skip
    return array


def exact_doubles(array: Any, what: str, nonfinite_points: Optional[str] = None) -> np.ndarray:
    """Doubles of the same values; Error if an integer is not one. Where points may be "nan", masked entries are that."""
    if nonfinite_points is not None and isinstance(array, np.ma.MaskedArray) and np.ma.is_masked(array):
        if nonfinite_points == "nan":
            return np.where(np.ma.getmaskarray(array), np.nan, exact_doubles(array.filled(0), what))
        _core.fail("argument.not-finite", f"masked entries of the {what}", remedy='nonfinite_points="nan" takes NaN for their values')
    array = real(array, what)
    doubles = array.astype(np.float64, order="C", copy=False)
    if array.dtype.kind in "iu" and array.dtype.itemsize == 8 and array.size:
        # 2**63 and 2**64 are doubles, but no integers of these types: they would come back as others.
        inside = doubles < (2.0**63 if array.dtype.kind == "i" else 2.0**64)
        back = np.where(inside, doubles, 0).astype(array.dtype)
        if not (inside & (back == array)).all():
            _core.fail("argument.value", f"an integer of the {what}", expected="a number that a double represents",
                       found=str(array[~(inside & (back == array))][0]))  # fmt: skip
    return doubles


def points_of(points: Any, dimension: int, nonfinite_points: Optional[str] = None) -> Tuple[np.ndarray, Shape]:
    """Points as (n, dimension), without a copy where they are contiguous doubles, and their leading shape. With "nan"
    for `nonfinite_points` masked coordinates are NaN.

    Also takes what has points: a mesh, a data set of pyvista or VTK."""
    if hasattr(points, "GetPoints") or (hasattr(points, "points") and not isinstance(points, np.ndarray)):
        from ._exchange import points_of_dataset

        points = points_of_dataset(points, dimension)
    array = exact_doubles(points, "points", nonfinite_points)
    if array.ndim == 0 or (array.ndim == 1 and array.size != dimension) or array.shape[-1] != dimension:
        _core.fail("argument.size", "shape of the points", expected=f"(..., {dimension}): {dimension} coordinates each",
                   found=str(array.shape))  # fmt: skip
    return array.reshape(-1, dimension), array.shape[:-1]


def values_of(values: Any, count: int, what: str) -> Tuple[np.ndarray, Shape]:
    """Real values as doubles (count, components), and the shape of one value."""
    array = exact_doubles(values, what)
    if array.ndim == 0 or array.shape[0] != count:
        _core.fail("argument.size", f"shape of the {what}", expected=f"({count}, ...): one value each", found=str(array.shape))
    shape = array.shape[1:]
    components = int(np.prod(shape, dtype=np.int64))
    if components == 0:
        _core.fail("argument.size", f"shape of the {what}", expected="at least one component", found=str(array.shape))
    return array.reshape(count, components), shape


def count_of(number: Any, what: str) -> int:
    """An integer that is not negative; TypeError if it is none, as of range()."""
    count = operator.index(number)
    if count < 0:
        _core.fail("argument.value", what, expected="0 or more", found=str(count))
    return count


def options_of(
    outside: Optional[str], fill_value: float, limit: float, rounding: str, threads: int, nonfinite_points: str = "error",
) -> _core.SampleOptions:  # fmt: skip
    return _core.SampleOptions(outside, float(fill_value), float(limit), rounding, count_of(threads, "threads="), nonfinite_points)


def telling(progress: Progress) -> Optional[Callable[[str, int, int], Any]]:
    """Who is told of progress: None, a callable, or for True a bar of tqdm where that is installed. It is to be held by the
    call that tells alone: tqdm closes a bar that nobody holds any more."""
    if not isinstance(progress, bool):
        if progress is not None and not callable(progress):
            _core.fail("argument.type", "progress=", expected="None, True or a callable of (stage, done, total)", found=repr(progress))
        return progress
    bars: Dict[str, Any] = {}  # of the last stage

    def show(stage: str, done: int, total: int) -> None:
        if stage not in bars:
            bars.clear()
            bars[stage] = tqdm(total=total or None, desc=stage, unit_scale=True, leave=False)
        bars[stage].update(done - bars[stage].n)

    with contextlib.suppress(ImportError):
        if progress:
            from tqdm.auto import tqdm

            return show
    return None


def forwarded(path: str, doc: str) -> Any:
    """A property that another attribute answers, such as "_core.points"."""
    return property(operator.attrgetter(path), doc=doc)
