"""Where points lie in a mesh."""

from __future__ import annotations

import enum
from typing import TYPE_CHECKING, Any, Optional, Sequence, Tuple, Union

import numpy as np

from . import _core
from ._arguments import Progress, options_of, telling

if TYPE_CHECKING:
    from ._mesh import Mesh


class Feature(enum.IntEnum):
    """The open face of lowest dimension of the owner that holds a point. For triangles FACE is never used."""

    INTERIOR = 0
    FACE = 1
    EDGE = 2
    VERTEX = 3
    OUTSIDE = 4


class Location:
    """Where points lie in a mesh: the result of `Mesh.locate`.

    Attributes:
        mesh: the mesh.
        points: (..., d) the points; they cannot be written to.
        cell: (...) int32, the owner: the lowest index among all cells that contain the point; -1 outside.
        feature: (...) uint8, numbers of `Feature`.
        inside: (...) bool.
    """

    def __init__(self, mesh: Mesh, points: np.ndarray, shape: Tuple[int, ...], cell: np.ndarray, feature: np.ndarray):
        self.mesh = mesh
        self._points, self._cell, self._feature = points, cell, feature
        self._weights: Optional[np.ndarray] = None
        self.points = points.reshape(shape + points.shape[1:])
        self.cell = cell.reshape(shape)
        self.feature = feature.reshape(shape)

    @property
    def inside(self) -> np.ndarray:
        return self.cell >= 0

    @property
    def weights(self) -> np.ndarray:
        """(..., d + 1) barycentric weights in the owner, in the order of its vertices in `mesh.cells`; each the exact one
        rounded once, to nearest, ties to even. NaN outside. Computed when first asked for.

        Of cells with other nodes (curved, or whole hexahedra and the like) these are the weights in the straight simplex
        that `mesh.cells` has; `matrix` has those of all their nodes."""
        if self._weights is None:
            inside, weights = self.inside, np.full(self.cell.shape + (self.mesh.dimension + 1,), np.nan)
            weights[inside] = _core.weights_of(self.mesh._core, self.points[inside], self.cell[inside])
            self._weights = weights
        return self._weights

    def matrix(self, *, outside: str = "nan", limit: float = np.inf, progress: Progress = None) -> Any:
        """The weights of the points on the nodes of the mesh, a scipy.sparse.csr_matrix (points, nodes): `matrix @ values`
        interpolates any field of nodes.

        Each entry is the exact weight rounded once, to nearest, ties to even; what is zero is left out. So sums over a row
        need not be exactly 1, and products with nodal values, which NumPy rounds in each step, are not correctly rounded:
        `sample` gives values that are. Points outside have empty rows with "nan"; with outside="nearest" or "extrapolate"
        those of `Mesh.sample`."""
        from scipy.sparse import csr_matrix

        if outside not in ("nan", "nearest", "extrapolate"):
            _core.fail("option.value", "what points outside get (outside=)", expected="nan, nearest or extrapolate", found=repr(outside))
        begin, nodes, weights = _core.matrix(self.mesh._core, self._points, self._cell, outside, float(limit), telling(progress))
        return csr_matrix((weights, nodes, begin), shape=(len(self._cell), len(self.mesh.points)))

    def sample(
        self, fields: Union[None, str, Sequence[str]] = None, *, outside: Optional[str] = None,
        fill_value: float = np.nan, limit: float = np.inf, rounding: str = "correct", threads: int = 0,
        progress: Progress = None,
    ) -> np.ndarray:  # fmt: skip
        """As `Mesh.sample` at these points, which are not located again."""
        # Points that are not finite are here only if they were to be outside.
        options = options_of(outside, fill_value, limit, rounding, threads, "nan")
        return self.mesh._sampled(fields, self.cell.shape, progress, lambda sampler: sampler.sample(
            self._points, options, telling(progress), self._cell, self._feature))  # fmt: skip

    def __len__(self) -> int:
        return len(self.cell)

    def __repr__(self) -> str:
        inside = int(np.count_nonzero(self._cell >= 0))
        return f"<barycert.Location: {self._cell.size} points, {inside} inside, {self._cell.size - inside} outside>"
