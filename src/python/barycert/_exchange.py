"""Meshes of other packages: taken as they are, by what they have rather than by their types, and given back."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any, Dict, List, Optional, Tuple

import numpy as np

from . import _core

# VTK's numbers of cell types; corners and nodes at mid-edges.
_TETRA, _QUADRATIC_TETRA, _TRIANGLE, _QUADRATIC_TRIANGLE = 10, 24, 5, 22
_COLUMNS = {_TETRA: 4, _QUADRATIC_TETRA: 10, _TRIANGLE: 3, _QUADRATIC_TRIANGLE: 6}
_KINDS = {columns: kind for kind, columns in _COLUMNS.items()}
_DIMENSION = {_TETRA: 3, _QUADRATIC_TETRA: 3, _TRIANGLE: 2, _QUADRATIC_TRIANGLE: 2}
# Vertices, poly-vertices, lines, poly-lines, quadratic edges: of lower dimension than any cell of a mesh.
_LOWER = (1, 2, 3, 4, 21)
_MESHIO = {"tetra": _TETRA, "tetra10": _QUADRATIC_TETRA, "triangle": _TRIANGLE, "triangle6": _QUADRATIC_TRIANGLE,
           "vertex": 1, "line": 3, "line3": 21}  # fmt: skip


@dataclass
class Parts:
    """What a Mesh is made of."""

    points: np.ndarray
    cells: np.ndarray
    cell_numbers: Optional[np.ndarray] = None
    point_data: Dict[str, np.ndarray] = field(default_factory=dict)
    cell_data: Dict[str, np.ndarray] = field(default_factory=dict)
    notes: List[str] = field(default_factory=list)


def parts_of(source: Any, in_space: bool = False) -> Parts:
    """The parts of a mesh of another package. `in_space`: of triangles, which keep their z."""
    if hasattr(source, "_all_nodes"):  # barycert.Mesh
        return Parts(source.points, source._all_nodes(), source.cell_numbers, dict(source.point_data), dict(source.cell_data),
                     source.notes)  # fmt: skip
    if hasattr(source, "simplices"):  # scipy.spatial.Delaunay
        return Parts(np.asarray(source.points), np.asarray(source.simplices))
    if hasattr(source, "triangles"):  # matplotlib.tri.Triangulation
        return _of_triangulation(source)
    if hasattr(source, "GetPoints"):  # of VTK, and so of pyvista
        parts = _of_vtk(source)
    elif hasattr(source, "cells") and hasattr(source, "points"):  # meshio.Mesh
        parts = _of_meshio(source)
    else:
        _core.fail("argument.type", "what a mesh is made of",
                   expected="points and cells, or a mesh of SciPy, matplotlib, meshio, pyvista or VTK",
                   found=type(source).__name__)  # fmt: skip
    if parts.cells.shape[1] in (3, 6) and not in_space:
        parts.points = _in_plane(parts.points, "triangles in space are no mesh")
    return parts


def points_of_dataset(source: Any, dimension: int) -> np.ndarray:
    """The points of a data set, in the plane without their z, which must be 0."""
    points = np.asarray(source.points) if hasattr(source, "points") else _points_of_vtk(source)
    return _in_plane(points, "points beside a mesh in the plane") if dimension == 2 else points


def _in_plane(points: np.ndarray, what: str) -> np.ndarray:
    if points.ndim != 2 or points.shape[1] != 3:
        return points
    off = np.flatnonzero(points[:, 2])
    if off.size:
        _core.fail("mesh.off-plane", what, expected="z = 0 throughout", found=f"z = {points[off[0], 2]} at point {off[0]}")
    return points[:, :2]


def _of_triangulation(source: Any) -> Parts:
    points = np.column_stack([source.x, source.y])
    triangles = np.asarray(source.triangles)
    mask = getattr(source, "mask", None)
    if mask is None or not np.any(mask):
        return Parts(points, triangles)
    kept = np.flatnonzero(~np.asarray(mask))
    note = f"left out: {triangles.shape[0] - kept.size} masked triangles"
    return Parts(points, triangles[kept], kept, notes=[note])


# Cells of one kind: VTK's type or another's word for it, their nodes, their numbers in the source.
Block = Tuple[Any, np.ndarray, np.ndarray]


def _of_blocks(points: Any, blocks: List[Block], ghosts: int, point_data: Any, cell_data: Any) -> Parts:
    """The cells of the highest dimension make a mesh. `ghosts`: cells of the source that are in no block."""
    count = {dimension: 0 for dimension in (1, 2, 3)}  # 1: of all that are left out
    for kind, _, numbers in blocks:
        if len(numbers) and kind not in _COLUMNS and kind not in _LOWER:
            _core.fail("mesh.cell-type", "cells of another kind", expected="triangles or tetrahedra",
                       found=f"{len(numbers)} cells of type {kind}, the first is cell {numbers[0]}",
                       remedy="vtkDataSetTriangleFilter, or pyvista's triangulate(), makes tetrahedra of them")  # fmt: skip
        count[_DIMENSION.get(kind, 1)] += len(numbers)
    solid = count[3] > 0
    chosen = [block for block in blocks if len(block[2]) and _DIMENSION.get(block[0]) == (3 if solid else 2)]
    left_out = {"ghost cells": ghosts, "vertices and lines": count[1], "triangles beside tetrahedra": count[2] if solid else 0}
    others = [f"{number} {what}" for what, number in left_out.items() if number]
    if len({kind for kind, _, _ in chosen}) > 1:
        _core.fail("mesh.cell-type", "cells of first and second order in one mesh", remedy="make all of them linear, or all quadratic")
    if not chosen:
        _core.fail("mesh.empty", "a mesh without triangles and tetrahedra", found=", ".join(others) or "no cells")
    nodes, numbers = (np.concatenate([block[i] for block in chosen]) for i in (1, 2))
    order = np.argsort(numbers, kind="stable")
    nodes, numbers = nodes[order], numbers[order]
    whole = numbers[0] == 0 and numbers[-1] == numbers.size - 1 and not others
    notes = [f"left out: {other}" for other in others]
    cell_arrays = _numbers_only(cell_data, notes)
    if not whole:
        cell_arrays = {name: values[numbers] for name, values in cell_arrays.items()}
    point_arrays = _numbers_only(point_data, notes)
    return Parts(np.asarray(points), nodes, None if whole else numbers, point_arrays, cell_arrays, notes)


def _numbers_only(data: Dict[str, Any], notes: List[str]) -> Dict[str, np.ndarray]:
    arrays = {name: np.asarray(values) for name, values in data.items()}
    kept = {name: a for name, a in arrays.items() if a.dtype.kind in "fiub" and a.dtype.itemsize <= 8}
    notes += [f'left out: array "{name}" of {a.dtype}' for name, a in arrays.items() if name not in kept]
    return kept


def _numpy(array: Any) -> np.ndarray:
    from vtkmodules.util.numpy_support import vtk_to_numpy

    return vtk_to_numpy(array)


def _arrays_of(attributes: Any, notes: List[str]) -> Dict[str, np.ndarray]:
    arrays = {}
    for i in range(attributes.GetNumberOfArrays()):
        array, name = attributes.GetArray(i), attributes.GetAbstractArray(i).GetName()
        if name and array is not None:
            arrays[name] = _numpy(array)
        else:
            notes.append(f"left out: array {name or i} that has no name or no numbers")
    return arrays


def _points_of_vtk(source: Any) -> np.ndarray:
    if source.GetPoints() is None:
        _core.fail("mesh.empty", "a data set without points", found=type(source).__name__)
    return _numpy(source.GetPoints().GetData())


def _of_vtk(source: Any) -> Parts:
    points = _points_of_vtk(source)
    if hasattr(source, "GetCellTypesArray"):  # vtkUnstructuredGrid
        grid = source.GetCells()
        types = _numpy(source.GetCellTypesArray()) if grid.GetNumberOfCells() else np.empty(0, dtype=np.uint8)
    elif hasattr(source, "GetPolys"):  # vtkPolyData
        grid = source.GetPolys()
        others = sum(part().GetNumberOfCells() for part in (source.GetVerts, source.GetLines, source.GetStrips))
        if others:
            _core.fail("mesh.cell-type", "polygon data with other cells than polygons", found=str(others), remedy="vtkTriangleFilter takes them out")
        types = np.full(grid.GetNumberOfCells(), _TRIANGLE)
    else:
        _core.fail("argument.type", "a data set of VTK", expected="vtkUnstructuredGrid or vtkPolyData", found=type(source).__name__,
                   remedy="vtkDataSetTriangleFilter makes an unstructured grid of it")
    notes: List[str] = []
    point_data, cell_data = (_arrays_of(data, notes) for data in (source.GetPointData(), source.GetCellData()))
    # The nodes of cell i are connectivity[offsets[i]:offsets[i + 1]].
    connectivity, offsets = _numpy(grid.GetConnectivityArray()), _numpy(grid.GetOffsetsArray())
    # Duplicate, refined and hidden cells.
    ghost = (cell_data.pop("vtkGhostType", np.zeros(types.size, dtype=np.uint8)) & (1 | 8 | 32)) != 0
    blocks: List[Block] = []
    for kind in np.unique(types[~ghost]).tolist():
        numbers = np.flatnonzero(~ghost & (types == kind))
        columns, sizes = _COLUMNS.get(kind, 0), offsets[numbers + 1] - offsets[numbers]
        wrong = np.flatnonzero(sizes != columns) if columns else numbers[:0]
        if len(wrong):
            _core.fail("mesh.node-count", f"nodes of cell {numbers[wrong[0]]}", expected=str(columns), found=str(sizes[wrong[0]]))
        blocks.append((kind, connectivity[offsets[numbers][:, None] + np.arange(columns)], numbers))
    parts = _of_blocks(points, blocks, np.count_nonzero(ghost), point_data, cell_data)
    parts.notes = notes + parts.notes
    return parts


def _of_meshio(source: Any) -> Parts:
    blocks: List[Block] = []
    first = 0
    for block in source.cells:
        # Tetrahedra of second order stand in VTK's order.
        numbers = np.arange(first, first + len(block.data))
        blocks.append((_MESHIO.get(block.type, block.type), np.asarray(block.data), numbers))
        first += len(numbers)
    cell_data = {name: np.concatenate([np.asarray(part) for part in parts]) for name, parts in source.cell_data.items()}
    return _of_blocks(source.points, blocks, 0, source.point_data, cell_data)


class GivenBack:
    """A mesh that other packages can have."""

    def _all_nodes(self: Any) -> np.ndarray:
        return self.cells if self.mid_nodes is None else np.hstack([self.cells, self.mid_nodes])

    def to_meshio(self: Any) -> Any:
        """A meshio.Mesh with the fields."""
        import meshio

        nodes = self._all_nodes().copy()
        (kind,) = (name for name, kind in _MESHIO.items() if kind == _KINDS[nodes.shape[1]])
        return meshio.Mesh(
            self.points.copy(),
            [(kind, nodes)],
            point_data={name: values.copy() for name, values in self.point_data.items()},
            cell_data={name: [values.copy()] for name, values in self.cell_data.items()},
        )

    def to_vtk(self: Any) -> Any:
        """A vtkUnstructuredGrid with the fields; triangles get z = 0."""
        from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray
        from vtkmodules.vtkCommonCore import vtkPoints
        from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkUnstructuredGrid

        nodes = self._all_nodes().astype(np.int64)
        points = np.zeros((len(self.points), 3))
        points[:, : self.points.shape[1]] = self.points
        grid = vtkUnstructuredGrid()
        places = vtkPoints()
        places.SetData(numpy_to_vtk(points, deep=True))
        grid.SetPoints(places)
        cells = vtkCellArray()
        cells.SetData(
            numpy_to_vtkIdTypeArray(np.arange(0, nodes.size + 1, nodes.shape[1], dtype=np.int64), deep=True),
            numpy_to_vtkIdTypeArray(nodes.ravel(), deep=True),
        )
        grid.SetCells(_KINDS[nodes.shape[1]], cells)
        for data, attributes in ((self.point_data, grid.GetPointData()), (self.cell_data, grid.GetCellData())):
            for name, values in data.items():
                array = numpy_to_vtk(np.ascontiguousarray(values.reshape(len(values), -1)), deep=True)
                array.SetName(name)
                attributes.AddArray(array)
        return grid

    def to_pyvista(self: Any) -> Any:
        """A pyvista.UnstructuredGrid with the fields; triangles get z = 0."""
        import pyvista

        return pyvista.wrap(self.to_vtk())
