"""Results of any tool, held against the exact ones."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, List, Mapping, Optional, Tuple, Union

import numpy as np

from . import _core
from ._arguments import Progress, count_of, exact_doubles, points_of, telling
from ._location import Feature
from ._mesh import Fields, Mesh


@dataclass(frozen=True)
class WrongRow:
    """A row that is wrong.

    Attributes:
        verdict: "missed", "invented", "wrong cell" or "wrong value".
        row: its number. point: its coordinates.
        claimed_cell: -1 none, or outside. cell, feature: the exact owner, -1 outside. cells: how many contain the point.
        column, claimed, value: where the error is largest; of missed and invented rows the first value that is a number.
            "" and NaN if no values were given. ulps, relative: that error; NaN of missed and invented rows.
        distance: of an invented row, to the mesh.
    """

    verdict: str
    row: int
    point: Tuple[float, ...]
    claimed_cell: int
    cell: int
    feature: Feature
    cells: int
    column: str
    claimed: float
    value: float
    ulps: float
    relative: float
    distance: float


@dataclass(frozen=True)
class ColumnErrors:
    """Errors of the values of one column.

    Attributes:
        range: what `max_relative` is relative to: max - min of the nodal values; where that is 0 their magnitude, and 1
            where they are 0.
        values: compared. identical: with the bits of the exact one. over: off by more than the tolerance.
        missing: NaN where there is a value. spurious: a number where the exact one is NaN.
        max_ulps, max_relative: the largest errors.
    """

    name: str
    range: float
    values: int
    identical: int
    over: int
    missing: int
    spurious: int
    max_ulps: float
    max_relative: float


@dataclass(frozen=True)
class Verification:
    """What `verify` found; it is true if every row is right.

    Attributes:
        rows, right: how many. missed: in a cell, and said to be outside. invented: the reverse. wrong_cell: inside, but not
            the cell that is named. wrong_value: off by more than the tolerance.
        inside, outside, on_boundary: of all rows, exactly.
        invented_distance: of the farthest row invented that was measured, to the mesh.
        columns: list of ColumnErrors. examples: list of WrongRow, the worst of each kind.
    """

    rows: int
    right: int
    missed: int
    invented: int
    wrong_cell: int
    wrong_value: int
    inside: int
    outside: int
    on_boundary: int
    invented_distance: float
    columns: List[ColumnErrors]
    examples: List[WrongRow]

    @property
    def wrong(self) -> int:
        return self.rows - self.right

    def __bool__(self) -> bool:
        return self.wrong == 0

    def __repr__(self) -> str:
        kinds = {"missed": self.missed, "invented": self.invented, "in a wrong cell": self.wrong_cell,
                 "with a wrong value": self.wrong_value}  # fmt: skip
        found = ", ".join(f"{count} {text}" for text, count in kinds.items() if count)
        return f"<barycert.Verification: {self.right} of {self.rows} rows right{': ' if found else ''}{found}>"


def verify(
    mesh: Mesh, points: Any, values: Union[None, Any, Mapping[str, Any]] = None, *, cells: Any = None,
    inside: Any = None, fields: Fields = None, tolerance: float = 1e-9, exact: bool = False,
    outside_value: Optional[float] = None, examples: int = 5, nonfinite_points: str = "error", threads: int = 0,
    progress: Progress = None,
) -> Verification:  # fmt: skip
    """Holds what some tool says of points against the exact cells and values.

    Args:
        mesh: with the fields.
        points: (..., d).
        values: what the tool interpolated: a dict of field name to array (...) or (..., components), or one array, of the
            field `fields`. NaN in all of them: outside, if neither cells nor inside says so.
        cells: (...) integers, the cell it found; below 0: outside. Any cell that contains the point is right.
        inside: (...) 0 or False: outside; such as vtkValidPointMask.
        tolerance: the largest error of a value that is right, in parts of the field's range (of its magnitude where it is
            constant; of 1 where it is 0).
        exact: right is what has the bits of the correctly rounded value.
        outside_value: a row of this number alone means outside.
        examples: rows kept of each kind of error.
        nonfinite_points: "nan": points with a coordinate that is NaN, infinite or masked are outside.

    Raises:
        Error: shapes do not fit; there is nothing to compare.
    """
    rows, shape = points_of(points, mesh.dimension, nonfinite_points)
    count = len(rows)
    if values is not None and not isinstance(values, Mapping):
        if not isinstance(fields, str):
            _core.fail("option.missing", "values without a name", expected='a dict, or fields="NAME"')
        values = {fields: values}
    claimed = dict(values or {})
    if not claimed and cells is None and inside is None:
        _core.fail("option.missing", "nothing to compare", expected="values, cells or inside")

    def flat(array: Any, dtype: Any, what: str) -> Optional[np.ndarray]:
        if array is None:
            return None
        array = np.asarray(array)
        if array.size != count:
            _core.fail("argument.size", f"shape of {what}", expected=str(shape), found=str(array.shape))
        return np.ascontiguousarray(array, dtype=dtype).reshape(-1)

    if cells is not None and np.asarray(cells).dtype.kind not in "iu":
        _core.fail("argument.type", "type of cells", expected="integers", found=str(np.asarray(cells).dtype))
    sampler = mesh._core.sampler(list(claimed), telling(progress)) if claimed else mesh._core.sampler_of(None, telling(progress))
    parts = []
    for name, components in sampler.fields:
        part = exact_doubles(claimed[name], f'values of "{name}"')
        if part.size != count * components:
            _core.fail("argument.size", f'shape of the values of "{name}"', expected=f"{shape}, {components} numbers each",
                       found=str(part.shape))  # fmt: skip
        parts.append(part.reshape(count, components))
    table = np.ascontiguousarray(np.hstack(parts)) if parts else None
    found = _core.verify(
        sampler, rows, flat(cells, np.int64, "cells"),
        None if inside is None else flat(np.asarray(inside) != 0, np.uint8, "inside"),
        table, tolerance, exact, outside_value, count_of(examples, "examples="), count_of(threads, "threads="), telling(progress),
        nonfinite_points,
    )  # fmt: skip
    columns = [ColumnErrors(**c) for c in found.pop("columns")]
    wrong = [WrongRow(feature=Feature(row.pop("feature")), **row) for row in found.pop("examples")]
    return Verification(columns=columns, examples=wrong, **found)
