"""Triangles in space: is a surface closed and clean, what lies inside, what is nearest."""

from __future__ import annotations

import os
from dataclasses import dataclass
from typing import Any, Dict, List, Mapping, Optional, Sequence, Tuple, Union

import numpy as np

from . import _core
from ._arguments import Progress, count_of, exact_doubles, forwarded, points_of, telling, values_of
from ._check import CheckReport
from ._exchange import Parts, parts_of


@dataclass(frozen=True)
class NearestPoints:
    """The nearest point of a surface to each point.

    Attributes:
        triangle: (...) int32: the lowest of those that have a point as near; -1 where none is within the limit.
        distance: (...) correctly rounded; NaN where there is none.
        point: (..., 3) the nearest point, each coordinate correctly rounded.
        nodes: (..., 3) int32: the vertex, edge or face in which it lies, ascending; -1 where there are fewer.
        weights: (..., 3) of these nodes, correctly rounded.
    """

    triangle: np.ndarray
    distance: np.ndarray
    point: np.ndarray
    nodes: np.ndarray
    weights: np.ndarray


class Surface:
    """Triangles in space, with exact answers.

    Args:
        points: (n, 3), finite; or a trimesh.Trimesh, a meshio.Mesh, a pyvista.PolyData or VTK data set with triangles.
        triangles: (m, 3), indices of points.
        point_data, cell_data: fields by name, a value a node or triangle.

    `Surface.read(path)` reads .stl .ply .off .obj .vtp, .poly and .smesh, and triangles of any file of meshes. Surfaces
    can be pickled and copied.
    """

    def __init__(
        self, points: Any, triangles: Any = None, point_data: Optional[Mapping[str, Any]] = None,
        cell_data: Optional[Mapping[str, Any]] = None,
    ) -> None:  # fmt: skip
        parts = _triangles_of(points) if triangles is None else Parts(points, triangles)
        coordinates, corners = exact_doubles(parts.points, "points"), np.asarray(parts.cells)
        if coordinates.ndim != 2 or coordinates.shape[1] != 3:
            _core.fail("argument.size", "shape of the points", expected="(n, 3)", found=str(coordinates.shape))
        if corners.ndim != 2 or corners.shape[1] != 3 or corners.dtype.kind not in "iu":
            _core.fail("argument.size", "triangles", expected="integers (m, 3)", found=f"{corners.dtype} {corners.shape}")
        if max(len(coordinates), len(corners)) > 2**31 - 1:
            _core.fail("mesh.too-large", "a surface has at most 2147483647 points and triangles")
        if corners.size and (corners.min() < 0 or corners.max() >= len(coordinates)):
            _core.fail("mesh.node-index", "a corner of a triangle", expected=f"0 to {len(coordinates) - 1}", found=f"{corners.min()} to {corners.max()}")
        core = _core.Surface(coordinates, np.ascontiguousarray(corners, dtype=np.int32), np.empty(0, dtype=np.int32))
        self._make(core, {**parts.point_data, **(point_data or {})}, {**parts.cell_data, **(cell_data or {})}, [])

    def _make(
        self, core: _core.Surface, point_data: Mapping[str, Any], cell_data: Mapping[str, Any], notes: List[str],
    ) -> Surface:  # fmt: skip
        self._core, self._notes = core, list(notes)
        self.point_data: Dict[str, np.ndarray] = {name: np.asarray(values) for name, values in point_data.items()}
        self.cell_data: Dict[str, np.ndarray] = {name: np.asarray(values) for name, values in cell_data.items()}
        return self

    @classmethod
    def read(cls, path: Union[str, "os.PathLike[str]"]) -> Surface:
        """Reads a surface with its fields."""
        core = _core.Surface.read(os.fspath(path))
        return cls.__new__(cls)._make(core, core.point_fields, core.cell_fields, core.notes)

    points: np.ndarray = forwarded("_core.points", "(n, 3).")
    triangles: np.ndarray = forwarded("_core.triangles", "(m, 3).")
    cells: np.ndarray = forwarded("_core.triangles", "The triangles, as a mesh has its cells.")
    notes: List[str] = forwarded("_notes", "What the reader left out, converted or guessed.")
    turned: str = forwarded("_core.turned", """What tells the sides apart, of all shells the least: "alike": each edge has as
        many triangles one way as the other: winding numbers; "regions": what the triangles enclose; "even": parity, of
        triangles that meet themselves; "open": there is no inside.""")  # fmt: skip

    def check(
        self, *, examples: int = 10, contacts: int = 20, near: float = 1e-3, verdict_only: bool = False, threads: int = 0,
        progress: Progress = None,
    ) -> CheckReport:  # fmt: skip
        """Is it closed and without self-intersections? Exactly decided; arguments as for `Mesh.check`.

        `to_dict()["surface"]` has shells, the regions that they enclose, volumes and areas.
        """
        core = self._core.check(
            count_of(examples, "examples="), count_of(contacts, "contacts="), verdict_only, float(near),
            count_of(threads, "threads="), telling(progress),
        )  # fmt: skip
        return CheckReport(core, self)

    def locate(self, points: Any, *, threads: int = 0) -> Tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Where points (..., 3) lie, exactly.

        Returns:
            triangle (...) int32: the lowest that holds the point; -1: none. feature (...) uint8, as `Feature`: interior,
            outside, or face, edge or vertex of the triangle. winding (...) int32: how many times the surface goes around a
            point on no triangle; shells that are not turned alike count 1 or -1 in what they enclose. "open": 0.
        """
        rows, shape = points_of(points, 3)
        found = self._core.locate(rows, count_of(threads, "threads="))
        return tuple(part.reshape(shape) for part in found)  # type: ignore[return-value]

    def contains(self, points: Any, *, boundary: bool = True, threads: int = 0) -> np.ndarray:
        """Whether points (..., 3) lie inside, exactly; `boundary`: or on a triangle. Error: the surface has no inside."""
        if self.turned == "open":
            first = self._core.first_open
            _core.fail("surface.defect", "the surface has no inside", expected="triangles that enclose a part of space",
                       found="none" if first < 0 else f"the shell of triangle {first}, which is open or meets itself",
                       remedy="check() says where it is open, and where it meets itself")  # fmt: skip
        triangle, _, winding = self.locate(points, threads=threads)
        return (winding != 0) | ((triangle >= 0) if boundary else False)

    def nearest(self, points: Any, *, limit: float = np.inf, threads: int = 0) -> NearestPoints:
        """The nearest triangle and point of it to points (..., 3), if not farther than `limit`: exact."""
        rows, shape = points_of(points, 3)
        found = self._core.nearest(rows, float(limit), [], count_of(threads, "threads="))
        return NearestPoints(*(part.reshape(shape + part.shape[1:]) for part in found[:5]))

    def distance(self, points: Any, *, threads: int = 0) -> np.ndarray:
        """Signed distances of points (..., 3), correctly rounded: negative inside. Error: the surface has no inside."""
        inside = self.contains(points, threads=threads)
        return np.where(inside, -1.0, 1.0) * self.nearest(points, threads=threads).distance

    def sample(
        self, points: Any, fields: Union[None, str, Sequence[str]] = None, *, limit: float = np.inf, threads: int = 0,
    ) -> Union[np.ndarray, Dict[str, np.ndarray]]:  # fmt: skip
        """Fields at the nearest points of points (..., 3): exact means by exact weights, rounded once; fields of triangles
        as they are. NaN where nothing is within `limit`.

        Args:
            fields: a name for one array; names, or None for all, for a dict of them.
        """
        rows, shape = points_of(points, 3)
        known = [*self.point_data, *self.cell_data]
        names = [fields] if isinstance(fields, str) else known if fields is None else list(fields)
        given, shapes = [], []
        for name in names:
            if name not in known:
                _core.fail("argument.type", "the name of a field", expected=", ".join(known) or "none", found=name)
            of_cells = name not in self.point_data
            data, places = (self.cell_data, self.triangles) if of_cells else (self.point_data, self.points)
            values, one = values_of(data[name], len(places), f"values of {name}")
            given.append((values, of_cells))
            shapes.append(one)
        arrays = self._core.nearest(rows, float(limit), given, count_of(threads, "threads="))[5]
        found = {name: array.reshape(shape + one) for name, array, one in zip(names, arrays, shapes)}
        return found[fields] if isinstance(fields, str) else found

    def hits(self, start: Any, end: Any, *, ray: bool = False) -> List[Tuple[int, str, float, int]]:
        """The triangles that the segment meets, or the ray from `start` through `end`, in their exact order along it:
        (triangle, feature, parameter, side): 0 at the start and 1 at the end; side 1 if it leaves where the normal points.
        """
        ends = exact_doubles(np.array([start, end]), "ends")
        if ends.shape != (2, 3):
            _core.fail("argument.size", "ends of a segment", expected="two points of three coordinates", found=str(ends.shape))
        return self._core.hits(ends, ray)

    def __reduce__(self) -> Tuple[Any, ...]:
        arrays = (self.points, self.triangles, self._core.facets)
        return _unpickle, (arrays, self.point_data, self.cell_data, self.notes)

    def __len__(self) -> int:
        return len(self.triangles)

    def __repr__(self) -> str:
        return f"<barycert.Surface: {len(self.points)} points, {len(self.triangles)} triangles>"


def _triangles_of(source: Any) -> Parts:
    if hasattr(source, "vertices") and hasattr(source, "faces"):  # trimesh.Trimesh
        return Parts(np.asarray(source.vertices), np.asarray(source.faces))
    parts = parts_of(source, in_space=True)
    if parts.cells.shape[1] not in (3, 6):
        _core.fail("argument.type", "what a surface is made of", expected="triangles", found="tetrahedra")
    parts.cells = parts.cells[:, :3]
    return parts


def _unpickle(arrays: Tuple[np.ndarray, ...], *others: Any) -> Surface:
    return Surface.__new__(Surface)._make(_core.Surface(*arrays), *others)
