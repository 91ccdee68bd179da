"""Meshes: their geometry, fields, and what can be asked of them."""

from __future__ import annotations

import difflib
import os
import warnings
from collections.abc import MutableMapping
from typing import Any, Callable, Dict, Iterable, Iterator, List, Mapping, Optional, Sequence, Tuple, Union

import numpy as np

from . import _core
from ._arguments import (
    Progress, count_of, exact_doubles, forwarded, options_of, points_of, real, telling, values_of,
)  # fmt: skip
from ._check import CheckReport, Repair
from ._exchange import GivenBack, Parts, parts_of
from ._figure import Picture
from ._location import Location

Fields = Union[None, str, Sequence[str]]


def _no_field(name: object, names: Iterable[str]) -> KeyError:
    all_names = list(names)
    near = difflib.get_close_matches(str(name), all_names, 1)
    meant = f"did you mean {near[0]!r}?" if near else f"there are {', '.join(all_names) or 'none'}"
    return KeyError(f"no field {name!r}; {meant}")


def _refuse(code: str, bad: np.ndarray, array: np.ndarray, name: str, why: str, **more: str) -> None:
    """Error that names the first entry that is bad, if there is one."""
    if bad.any():
        row, column = np.argwhere(bad)[0]
        _core.fail(code, f"{name}[{row}, {column}] {why}", found=str(array[row, column]), **more)


class FieldData(MutableMapping):
    """The fields of nodes or cells of a mesh, by name. What is put in is copied, as float64; what comes out cannot be
    written to: put an array in again to change values."""

    def __init__(self, core: _core.Mesh, of_cells: bool, count: int) -> None:
        self._core = core
        self._of_cells = of_cells
        self._count = count
        self._shapes: Dict[str, Tuple[int, ...]] = {}

    def __getitem__(self, name: str) -> np.ndarray:
        array = self._core.field(name, self._of_cells)
        if array is None:
            raise _no_field(name, self)
        return array.reshape((self._count,) + self._shape(name, array.shape[1]))

    def _shape(self, name: str, components: int) -> Tuple[int, ...]:
        """Of one value of that many components: as it was put in, if that fits."""
        shape = self._shapes.get(name, ())
        return shape if np.prod(shape, dtype=np.int64) == components else (components,)

    def __setitem__(self, name: str, values: Any) -> None:
        if not isinstance(name, str) or not name:
            _core.fail("argument.type", "name of a field", expected="a text", found=repr(name))
        rows, shape = values_of(values, self._count, f'values of field "{name}"')
        self._core.set_field(name, rows, self._of_cells)
        self._shapes[name] = shape

    def __delitem__(self, name: str) -> None:
        if name not in self:
            raise _no_field(name, self)
        self._core.set_field(name, None, self._of_cells)
        self._shapes.pop(name, None)

    def __contains__(self, name: object) -> bool:
        return name in self._core.field_names(self._of_cells)

    def __iter__(self) -> Iterator[str]:
        return iter(self._core.field_names(self._of_cells))

    def __len__(self) -> int:
        return len(self._core.field_names(self._of_cells))

    def __repr__(self) -> str:
        items = ", ".join(f"{name!r}: {self[name].shape}" for name in self)
        return f"<{'cells' if self._of_cells else 'nodes'}: {{{items}}}>"


class AllFields(MutableMapping):
    """All fields of a mesh by name, those of nodes first. A field of cells that has the name of one of nodes is
    "cell:NAME". A field that is put in belongs to nodes or to cells by its length, or to what "point:NAME" and
    "cell:NAME" say."""

    def __init__(self, point_data: FieldData, cell_data: FieldData) -> None:
        self._of = {"point": point_data, "cell": cell_data}

    def _place(self, name: str, shape: Optional[Tuple[int, ...]] = None) -> Tuple[FieldData, str]:
        """The data that has the field, and its name there. Where a new one of that shape belongs."""
        of, colon, rest = str(name).partition(":")
        named = [(self._of[of], rest)] if colon and of in self._of else []
        places = [(data, name) for data in self._of.values()]
        for data, own in places + named:
            if own in data:
                return data, own
        if shape is None:
            raise _no_field(name, self)
        fits = named or [place for place in places if shape[:1] == (place[0]._count,)]
        if len(fits) != 1:
            nodes, cells = (data._count for data in self._of.values())
            _core.fail("argument.size", f"nodes or cells for field {name!r}", expected=f"{nodes} rows for nodes, or {cells} for cells",
                       found=str(shape), remedy="put it into point_data or cell_data")
        return fits[0]

    def __getitem__(self, name: str) -> np.ndarray:
        data, own = self._place(name)
        return data[own]

    def __setitem__(self, name: str, values: Any) -> None:
        data, own = self._place(name, np.shape(values))
        data[own] = values

    def __delitem__(self, name: str) -> None:
        data, own = self._place(name)
        del data[own]

    def __iter__(self) -> Iterator[str]:
        points, cells = self._of.values()
        return iter([*points, *(f"cell:{name}" if name in points else name for name in cells)])

    def __len__(self) -> int:
        return sum(map(len, self._of.values()))

    def __repr__(self) -> str:
        return f"<fields: {', '.join(self)}>"


class Mesh(GivenBack):
    """A mesh of triangles in the plane or of tetrahedra in space.

    Args:
        points: (n, 2) or (n, 3) coordinates of the nodes, real numbers in any unit; finite. Or a whole mesh, without
            `cells`: of meshio, pyvista, VTK (vtkUnstructuredGrid, vtkPolyData), matplotlib (Triangulation) or SciPy
            (Delaunay); its fields come along.
        cells: (m, 3) triangles with 2 coordinates, (m, 4) tetrahedra with 3: node indices of any integer type, from 0; or a
            SciPy Delaunay or matplotlib Triangulation of the points.
            With 6 or 10 columns cells of second order, nodes at mid-edges in VTK's order: edges 01 12 02 (03 13 23).
        point_data, cell_data: fields, name to array (n, ...) or (m, ...).
        curved: cells of second order whose mid-edge nodes are not at the middle (see `Mesh.curved`): "isoparametric", as
            they are where points are located; "straight", with straight sides, and a warning; "refuse" raises an Error;
            "exact", as they are, and so where a node is off the middle by rounding alone.
        interpolation: in hexahedra and other cells that are no simplices, which files have: "linear" on the simplices that
            each is cut into, or "multilinear", their isoparametric functions.

    The geometry is copied once and cannot be changed; fields can. The index for point location is made when it is first
    needed. Any number of threads may use a mesh at the same time. Meshes can be pickled and copied.

    Raises:
        Error: shapes or types do not fit; an index is no node (it is named); a coordinate is not finite; a data set has
            cells of other kinds.
    """

    def __init__(
        self, points: Any, cells: Any = None, *, point_data: Optional[Mapping[str, Any]] = None,
        cell_data: Optional[Mapping[str, Any]] = None, curved: str = "isoparametric",
        interpolation: str = "linear",
    ) -> None:  # fmt: skip
        parts = Parts(points, cells)
        if cells is None:
            parts = parts_of(points)
        elif hasattr(cells, "simplices") or hasattr(cells, "triangles"):
            parts = parts_of(cells)
            if len(points) != len(parts.points):
                # The points need not be those that were triangulated: they may have been scaled for that.
                _core.fail("argument.size", "points and their triangulation", expected=f"{len(parts.points)} points", found=str(len(points)))
            parts.points = points
        parts.point_data.update(point_data or {})
        parts.cell_data.update(cell_data or {})
        coordinates, indices = parts.points, parts.cells = exact_doubles(parts.points, "points"), np.asarray(parts.cells)
        if coordinates.ndim != 2 or coordinates.shape[1] not in (2, 3):
            _core.fail("argument.size", "shape of the points of a mesh", expected="(n, 2) or (n, 3)", found=str(coordinates.shape))
        dimension = coordinates.shape[1]
        columns = (3, 6) if dimension == 2 else (4, 10)
        if indices.ndim != 2 or indices.shape[1] not in columns:
            in_space = dimension == 3 and indices.ndim == 2 and indices.shape[1] in (3, 6)
            _core.fail("argument.size", "shape of the cells", found=str(indices.shape),
                       expected=f"(m, {columns[0]}), or (m, {columns[1]}) of second order, with {dimension} coordinates a point",
                       remedy="triangles in space are no mesh; in a plane z = 0 pass points[:, :2]" if in_space else "")  # fmt: skip
        if indices.dtype.kind not in "iu":
            _core.fail("argument.type", "type of the cells", expected="integers", found=str(indices.dtype))
        self._make(parts)
        self._set_cells("", curved, interpolation)

    def _make(self, parts: Parts) -> Mesh:
        points, cells = parts.points, parts.cells
        if max(len(points), len(cells)) > 2**31 - 1:
            _core.fail("mesh.too-large", "a mesh has at most 2147483647 nodes and cells")
        nodes = f"0 to {len(points) - 1}" if len(points) else "no cells, as there are no nodes"
        _refuse("mesh.node-index", (cells < 0) | (cells >= len(points)), cells, "cells", "is no node", expected=nodes,
                remedy="indices count from 0: see where they were made")  # fmt: skip
        _refuse("mesh.coordinate", ~np.isfinite(points), points, "points", "is not finite")
        corners = points.shape[1] + 1
        indices = (cells[:, :corners], cells[:, corners:], () if parts.cell_numbers is None else parts.cell_numbers)
        self._set_core(_core.Mesh(points, *(np.ascontiguousarray(some, dtype=np.int32) for some in indices)), parts.notes)
        self.point_data.update(parts.point_data)
        self.cell_data.update(parts.cell_data)
        return self

    def _set_core(self, core: _core.Mesh, notes: Sequence[str] = ()) -> Mesh:
        self._core = core
        self._more_notes = list(notes)
        self._point_data = FieldData(core, False, len(core.points))
        self._cell_data = FieldData(core, True, len(core.cells))
        return self

    def _set_cells(self, file: str, curved: str, interpolation: str) -> None:
        told = self._core.set_cells(file, curved, interpolation)
        if told:
            warnings.warn(f"{file}: {told}" if file else told, stacklevel=3)

    # Parts of the mesh.

    dimension: int = forwarded("_core.dimension", "2: triangles in the plane; 3: tetrahedra.")
    points: np.ndarray = forwarded("_core.points", "(n, d) float64, the nodes; cannot be written to.")
    cells: np.ndarray = forwarded("_core.cells", "(m, d + 1) int32, the vertices of the cells; cannot be written to.")
    mid_nodes: Optional[np.ndarray] = forwarded(
        "_core.mid_nodes", "(m, 3 or 6) int32, the nodes at mid-edges in VTK's order; None if the cells are linear."
    )
    cell_numbers: Optional[np.ndarray] = forwarded(
        "_core.cell_numbers", "(m,) int32, the number of each cell where it came from; None if all of its cells are here."
    )
    point_markers: Optional[np.ndarray] = forwarded(
        "_core.point_markers", "(n,) int64, the markers of the nodes in a file that had some."
    )
    point_data: FieldData = forwarded("_point_data", "Fields of the nodes, name to (n, ...).")
    cell_data: FieldData = forwarded("_cell_data", "Fields of the cells, name to (m, ...).")

    @property
    def fields(self) -> AllFields:
        """All of them, by name: mesh.fields["T"], or mesh["T"] for short."""
        return AllFields(self._point_data, self._cell_data)

    def __getitem__(self, name: str) -> np.ndarray:
        return self.fields[name]

    def __setitem__(self, name: str, values: Any) -> None:
        self.fields[name] = values

    def __contains__(self, name: object) -> bool:
        return name in self.fields

    def __iter__(self) -> Iterator[str]:
        return iter(self.fields)

    @property
    def notes(self) -> List[str]:
        """What was left out, converted or guessed on the way from a file or data set."""
        return self._more_notes + [text for text, _ in self._core.notes]

    @property
    def curved(self) -> Dict[str, float]:
        """How far sides are from straight ones, of which `check` speaks: `cells`, how many have a mid-edge node off the
        middle of its edge; `max_deviation`, the largest distance from it in parts of the edge's length; `rounded_cells`
        and `max_rounded`, the same of those where rounding of coordinates explains it, whose nodes count as middles;
        `by_corners`, if there are such, how many cells of a higher order are taken by their corners. All 0 for linear
        cells."""
        return self._core.curved()

    @property
    def bounds(self) -> np.ndarray:
        """(d, 2): low and high along each axis, over the nodes of cells."""
        return np.array(_core.bounds(self._core)).T[: self.dimension]

    @property
    def certified(self) -> bool:
        """Whether it is proved that the cells partition their domain: they meet in common faces or not at all. Makes the
        index if there is none. `check` says why not."""
        return _core.certified(self._core)

    # Questions to the mesh.

    def locate(
        self, points: Any, *, nonfinite_points: str = "error", threads: int = 0, progress: Progress = None,
    ) -> Location:  # fmt: skip
        """The cell of each point: exact, and the same from run to run.

        Args:
            points: (..., d), finite; or a data set with points. Copied if they could be changed later.
            nonfinite_points: "nan": points with a coordinate that is NaN, infinite or masked are outside.
            threads: 0 for as many as the machine has.
            progress: a callable of (stage, done, total); True for a bar of tqdm, where that is installed.

        Raises:
            Error: a coordinate is not finite (the point is named) nor may be, or shapes do not fit.
        """
        rows, shape = points_of(points, self.dimension, nonfinite_points)
        made_here = isinstance(points, (list, tuple)) or (
            isinstance(points, np.ndarray) and not np.may_share_memory(rows, points)
        )
        if rows.flags.writeable and not made_here:
            rows = rows.copy()
        rows.flags.writeable = False
        cell, feature = _core.locate(self._core, rows, count_of(threads, "threads="), telling(progress), nonfinite_points)
        return Location(self, rows, shape, cell, feature)

    def locate_all(
        self, points: Any, *, nonfinite_points: str = "error", threads: int = 0, progress: Progress = None,
    ) -> Tuple[np.ndarray, np.ndarray]:  # fmt: skip
        """Every cell that holds each of n points (in the order of points.reshape(-1, d)); `nonfinite_points` as for `locate`.

        Returns:
            begin (n + 1) int64 and cells int32: those of point i are cells[begin[i]:begin[i + 1]], ascending.
        """
        rows, _ = points_of(points, self.dimension, nonfinite_points)
        return _core.locate_all(self._core, rows, count_of(threads, "threads="), telling(progress), nonfinite_points)

    def nearest(
        self, points: Any, *, limit: float = np.inf, nonfinite_points: str = "error", progress: Progress = None,
    ) -> Tuple[np.ndarray, np.ndarray]:  # fmt: skip
        """The nearest cell to each point: exact, the lowest index among those as near. `nonfinite_points`: "nan" takes
        points with a coordinate that is NaN, infinite or masked for such as are near no cell.

        Returns:
            cells (...) int32, -1 where none is within `limit`; distances (...) float64, rounded to nearest, 0 inside, NaN
            where there is no cell.
        """
        rows, shape = points_of(points, self.dimension, nonfinite_points)
        cells, distances = _core.nearest(self._core, rows, float(limit), telling(progress), nonfinite_points)
        return cells.reshape(shape), distances.reshape(shape)

    def sample(
        self, points: Any, fields: Fields = None, *, outside: Optional[str] = None, fill_value: float = np.nan,
        limit: float = np.inf, rounding: str = "correct", nonfinite_points: str = "error", threads: int = 0,
        progress: Progress = None,
    ) -> np.ndarray:  # fmt: skip
        """Fields at points: each value is the exact interpolation in the owner, rounded once to nearest, ties to even.

        Args:
            points: (..., d), finite; or a data set with points.
            fields: a name for one field; names, or None for all fields. What is made of fields has names, too: "v.x",
                "|v|", "grad(T)", "mean(c)".
            outside: what points outside get: "nan", "fill" (`fill_value`), "raise" (an Error that names the first),
                "nearest" (point fields at the nearest point of the mesh, cell fields of its cell), "extrapolate" (the
                function of the nearest cell). Unless it is given: `fill_value`.
            limit: with "nearest", farther points get NaN.
            rounding: "correct"; "plain" evaluates in plain double, in cells that are exact all the same.
            threads, progress: as for `locate`.
            nonfinite_points: "nan": points with a coordinate that is NaN, infinite or masked get NaN, whatever points
                outside get; "error": an Error that names the first.

        Returns:
            Of one name an array (...) or (..., components); else a structured array (...), a member a field.
        """
        rows, shape = points_of(points, self.dimension, nonfinite_points)
        options = options_of(outside, fill_value, limit, rounding, threads, nonfinite_points)
        return self._sampled(fields, shape, progress, lambda sampler: sampler.sample(rows, options, telling(progress)))

    def resample(
        self, shape: Union[int, Sequence[int]], bounds: Any = None, fields: Fields = None, *,
        outside: Optional[str] = None, fill_value: float = np.nan, limit: float = np.inf, rounding: str = "correct",
        threads: int = 0, progress: Progress = None,
    ) -> np.ndarray:  # fmt: skip
        """Fields on a regular grid, many times faster than point by point.

        Args:
            shape: points along x, y (and z), ends included; one number for all axes.
            bounds: (d, 2) low and high along each axis; None: the box of the mesh.
            fields, outside, ...: as for `sample`.

        Returns:
            result[i, j, k] is at the i-th x, j-th y and k-th z of `grid_axes(shape, bounds)`, as of
            numpy.meshgrid(x, y, z, indexing="ij"); otherwise as `sample`. In memory x runs fastest, as VTK has it:
            result.ravel(order="F") is the array of a vtkImageData.
        """
        grid, counts = self._grid(shape, bounds)
        options = options_of(outside, fill_value, limit, rounding, threads)
        flipped = self._sampled(fields, tuple(reversed(counts)), progress,
                                lambda sampler: sampler.on_grid(grid, options, telling(progress)))  # fmt: skip
        axes = tuple(reversed(range(self.dimension)))
        return flipped.transpose(axes + tuple(range(self.dimension, flipped.ndim)))

    def grid_axes(self, shape: Union[int, Sequence[int]], bounds: Any = None) -> List[np.ndarray]:
        """The coordinates of `resample`'s points along each axis, to the bit."""
        grid, _ = self._grid(shape, bounds)
        return [grid.coordinates(axis) for axis in range(self.dimension)]

    def gradient(self, field: Any, points: Any = None, *, progress: Progress = None) -> np.ndarray:
        """The gradient of a field of nodes, each number the exact one rounded once.

        Args:
            field: its name, or values (n, ...) at the nodes.
            points: None for the gradient in each cell; or (..., d), and the name of a field.

        Returns:
            (m, ..., d) in each cell, or at each point (..., components, d): derivatives by x, y, z come last. Where cells
            meet, the gradient jumps, and a point gets that of its owner. NaN in degenerate cells, and outside.
        """
        if points is not None:
            if not isinstance(field, str):
                _core.fail("argument.type", "gradient at points", expected="the name of a field", found=type(field).__name__)
            values = self.sample(points, f"grad({field})", progress=progress)
            components = self.point_data[field].shape[1:] if field in self.point_data else ()
            return values.reshape(values.shape[:-1] + components + (self.dimension,))
        if self.mid_nodes is not None:
            _core.fail("field.location", "gradient in a cell of second order", expected="points, as it is not the same everywhere in it",
                       remedy="pass points")  # fmt: skip
        if isinstance(field, str):
            if field not in self.point_data:
                _core.fail("field.unknown", "no such field of nodes", found=repr(field), expected=", ".join(self.point_data) or "none")
            field = self.point_data[field]
        values, shape = values_of(field, len(self.points), "values")
        gradients = self._core.gradients(values, telling(progress))
        return gradients.reshape((len(self.cells),) + shape + (self.dimension,))

    def plot(self, field: str = "", **options: Any) -> Picture:
        """The mesh as a picture: its boundary, or what is chosen, in colours of a field; see `barycert render mesh`.

        Args:
            field: of one number a node or cell; also "v.x", "|v|", "cell:NAME"; without it the mesh is grey.
            edges, outline, surface: True or False: the edges of cells; where the boundary bends; the boundary itself.
            clip: ((nx, ny, nz), offset): what is beyond this plane is cut away. box: (low, high): cells with a node inside.
            threshold: (field, low, high): cells whose values are within alone.
            slices: planes as of clip. iso: values of iso-surfaces of iso_field (default: the field).
            arrows, arrow_count: a field of vectors. marked: numbers of cells, in red.
            points, point_size: an array of coordinates, in the colours of the field there; pixels across.
            view, camera, zoom, parallel: "iso", "+x", ..., or (azimuth, elevation) in degrees; above 1: nearer; no perspective.
            size, resolution, samples, background, axes: (width, height); pixels of a .png for one of these; smooth edges, 1:
                none; (red, green, blue, opacity), 0 to 255; "box", "triad" or "none".
            title, unit, colormap, range, log, labels, bar: of the colours: (low, high), by logarithm, one for each value; False:
                no colour bar.

        Raises:
            Error: no such field or option; what cannot be drawn.
        """
        if options.get("points") is not None:
            options["points"] = points_of(options["points"], self.dimension)[0]
        return Picture(lambda path: _core.plot(self._core, field, options, path))

    def plot_line(self, a: Any, b: Any, fields: Fields = None, *, count: int = 200, **options: Any) -> Picture:
        """Fields over the length from point a to point b, a curve each; broken outside the mesh.

        Args:
            fields: as for `sample`, 6 components at most. count: points on the line.
            title, unit, background, resolution: as for `plot`.
        """
        names = [] if fields is None else [fields] if isinstance(fields, str) else list(fields)
        ends, _ = points_of(np.stack([np.asarray(a, float), np.asarray(b, float)]), self.dimension)
        count = count_of(count, "count=")
        options.setdefault("title", " ")
        return Picture(lambda path: _core.plot_line(self._core, *ends.tolist(), count, names, options, path))

    def check(
        self, *, delaunay: bool = False, examples: int = 10, contacts: int = 20, verdict_only: bool = False,
        threads: int = 0, progress: Progress = None,
    ) -> CheckReport:  # fmt: skip
        """Proves that the cells partition their domain, or finds why not: exact for all finite doubles.

        Args:
            delaunay: also test every interior facet.
            examples: places kept of each defect. contacts: pairs of cells for which a common point is computed.
            verdict_only: stop at the first defect that breaks the certificate.
            progress: called with the name of each stage, 0, 0.
        """
        core = _core.check(
            self._core, delaunay, count_of(examples, "examples="), count_of(contacts, "contacts="), verdict_only,
            count_of(threads, "threads="), telling(progress),
        )  # fmt: skip
        return CheckReport(core, self)

    def fix(
        self, *, merge_within: float = 0.0, nodes: bool = True, cells: bool = True, orientation: bool = True,
        threads: int = 0,
    ) -> Tuple[Mesh, Repair]:  # fmt: skip
        """A copy with what has one right answer repaired, and what was done. `check` says what the copy is.

        Args:
            nodes: merge nodes of cells that coincide; merge_within: and those at most so far apart.
            cells: drop cells that are degenerate or name a node twice, and all but one of duplicates.
            orientation: turn negative cells.
        """
        core, done = _core.fix(self._core, float(merge_within), nodes, cells, orientation, count_of(threads, "threads="))
        return Mesh.__new__(Mesh)._set_core(core), Repair(**done)

    # Out and in.

    def write(self, path: Union[str, os.PathLike], *, comment: str = "", data: str = "raw") -> None:
        """Writes mesh and fields as the path ends: .vtu, .vtk, .msh (Gmsh), .node and .ele (TetGen, Triangle). The file
        appears whole or not at all; every double reads back to the same bits.

        data: how numbers of VTK's files are written: "raw", "zlib", "lz4", "lzma" or "ascii".
        """
        self._core.write(os.fspath(path), comment, data)

    def __reduce__(self) -> Tuple[Any, ...]:
        return _unpickle, (parts_of(self), self._core.taken())

    def __deepcopy__(self, _: Any) -> Mesh:
        return _unpickle(parts_of(self), self._core.taken())

    def __repr__(self) -> str:
        kind = "triangles" if self.dimension == 2 else "tetrahedra"
        order = "" if self.mid_nodes is None else " of second order"
        text = f"<barycert.Mesh: {len(self.points)} nodes, {len(self.cells)} {kind}{order}"
        for what, data in (("point_data", self.point_data), ("cell_data", self.cell_data)):
            if data:
                text += f", {what} {', '.join(data)}"
        return text + ">"

    # For this package.

    def _grid(self, shape: Union[int, Sequence[int]], bounds: Any) -> Tuple[_core.Grid, List[int]]:
        d = self.dimension
        counts = [int(shape)] * d if np.ndim(shape) == 0 else [int(n) for n in shape]  # type: ignore
        box = self.bounds if bounds is None else np.asarray(real(bounds, "bounds"), dtype=float)
        if len(counts) != d or box.shape != (d, 2):
            _core.fail("argument.size", "shape and bounds of the grid", expected=f"{d} numbers of points, bounds ({d}, 2)",
                       found=f"{len(counts)}, bounds {box.shape}")
        low, high = np.vstack([box, np.zeros((3 - d, 2))]).T
        return _core.Grid(d, counts + [1] * (3 - d), low, high), counts

    def _sampled(self, fields: Fields, shape: Tuple[int, ...], progress: Progress, ask: Callable) -> np.ndarray:
        """The values of ask(sampler) at points of that shape, as `sample` returns them."""
        names = [] if fields is None else [fields] if isinstance(fields, str) else list(fields)
        if fields is not None and not names:
            _core.fail("option.missing", "no fields", expected="a name, names, or None for all")
        sampler = self._core.sampler(names, telling(progress))
        values = ask(sampler)
        members: List[Tuple[str, Any, Tuple[int, ...]]] = []
        for name, components in sampler.fields:
            # If two fields have one name, that of the cells comes second.
            second = any(name == member[0] for member in members)
            data = self._cell_data if second or name not in self._point_data else self._point_data
            members.append((f"cell:{name}" if second else name, np.float64, data._shape(name, components)))
        if isinstance(fields, str) and len(members) == 1:
            return values.reshape(shape + members[0][2])
        if not members:
            _core.fail("option.missing", "the mesh has no fields", remedy="put one into mesh.point_data or mesh.cell_data")
        return values.view(np.dtype(members)).reshape(shape)


def _unpickle(parts: Parts, taken: Any) -> Mesh:
    mesh = Mesh.__new__(Mesh)._make(parts)
    mesh._core.take(taken)
    return mesh


def read(
    path: Union[str, os.PathLike], step: Union[int, str, None] = None, time: Optional[float] = None, *,
    curved: str = "isoparametric", interpolation: str = "linear",
) -> Mesh:  # fmt: skip
    """Reads a mesh with its fields: TetGen's or Triangle's files by their stem or any one of them; .msh of Gmsh;
    .mesh and .meshb of Medit; .vtu, .vtk, .vtp, .pvtu, .vtm and .pvd of VTK. The format is told by the contents.

    Args:
        step: of a series (.pvd, .vtu.series, .vtp.series), by its number from 0, or "last"; default: the first, with a warning.
        time: likewise, by its time, exactly as the file has it.
        curved, interpolation: as for `Mesh`.

    What may change what results mean is a warning, all else that was left out, converted or guessed is in `notes`.

    Raises:
        Error: there is no such file or step, it is broken or of another kind; the message says where and why.
    """
    if step is not None and time is not None:
        _core.fail("option.conflict", "step and time", expected="one of them", found="both")
    last = isinstance(step, str) and step == "last"
    if isinstance(step, str) and not last:
        _core.fail("option.value", "step of a series", expected='a number from 0, or "last"', found=repr(step))
    number = None if step is None or last else count_of(step, "step=")
    mesh = Mesh.__new__(Mesh)._set_core(_core.read(os.fspath(path), number, last, time))
    mesh._set_cells(os.fspath(path), curved, interpolation)
    for text, important in mesh._core.notes:
        if important:
            warnings.warn(text, stacklevel=2)
    return mesh
