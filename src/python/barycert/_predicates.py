"""Exact predicates and weights of simplices, over arrays that broadcast."""

from __future__ import annotations

from typing import Any, Callable, Tuple

import numpy as np

from . import _core
from ._arguments import exact_doubles


def _broadcast(what: str, *shapes: Tuple[int, ...]) -> Tuple[int, ...]:
    try:
        return np.broadcast_shapes(*shapes)
    except ValueError:
        _core.fail("argument.size", what, expected="shapes that broadcast", found=" and ".join(map(str, shapes)))


def _signs(name: str, dimension: int, points: Tuple[Any, ...]) -> Any:
    arrays = [exact_doubles(p, f"points of {name}") for p in points]
    for i, array in enumerate(arrays):
        if array.ndim == 0 or array.shape[-1] != dimension:
            _core.fail("argument.size", f"{name}: shape of argument {i}", expected=f"(..., {dimension})", found=str(array.shape))
    shape = _broadcast(f"{name}: shapes of the points", *(array.shape for array in arrays))
    # Broadcast arrays have strides of 0; the module follows strides, so nothing is copied but shapes that do not flatten.
    rows = [_rows(np.broadcast_to(array, shape), dimension) for array in arrays]
    return getattr(_core, name)(rows).reshape(shape[:-1])[()]


def _rows(array: np.ndarray, dimension: int) -> np.ndarray:
    """(n, dimension); one point for all without copies."""
    leading = array.shape[:-1]
    if all(stride == 0 or n == 1 for stride, n in zip(array.strides, leading)):
        flat = int(np.prod(leading, dtype=np.int64))
        return np.lib.stride_tricks.as_strided(array, (flat, dimension), (0, array.strides[-1]), writeable=False)
    return array.reshape(-1, dimension)


def orient2d(a: Any, b: Any, c: Any) -> Any:
    """The exact sign of det(b - a, c - a): 1 if a, b, c turn counter-clockwise, -1 clockwise, 0 on a line.

    Args: (..., 2), finite; shapes broadcast. Returns int8 of the leading shape. Raises Error for NaN and infinity.

    >>> orient2d([0, 0], [1, 0], [[0, 1], [0, -1], [2, 0]])
    array([ 1, -1,  0], dtype=int8)
    """
    return _signs("orient2d", 2, (a, b, c))


def orient3d(a: Any, b: Any, c: Any, d: Any) -> Any:
    """The exact sign of det(b - a, c - a, d - a): 1 if a, b, c turn counter-clockwise seen from d, which is the opposite of
    Shewchuk's orient3d; 0 in a plane.

    Arguments (..., 3); otherwise as `orient2d`.

    >>> int(orient3d([0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 5e-324]))
    1
    """
    return _signs("orient3d", 3, (a, b, c, d))


def det3d(p: Any, q: Any, r: Any, s: Any, t: Any, u: Any) -> Any:
    """The exact sign of det(q - p, s - r, u - t).

    Arguments (..., 3); otherwise as `orient2d`.
    """
    return _signs("det3d", 3, (p, q, r, s, t, u))


def incircle(a: Any, b: Any, c: Any, d: Any) -> Any:
    """1 if d lies inside the circle through a, b, c and these turn counter-clockwise; exact. With the other orientation the
    sign is the opposite; 0 on the circle.

    Arguments (..., 2); otherwise as `orient2d`.
    """
    return _signs("incircle", 2, (a, b, c, d))


def insphere(a: Any, b: Any, c: Any, d: Any, e: Any) -> Any:
    """1 if e lies inside the sphere through a, b, c, d and orient3d(a, b, c, d) is 1; exact. With the other orientation the
    sign is the opposite; 0 on the sphere.

    Arguments (..., 3); otherwise as `orient2d`.
    """
    return _signs("insphere", 3, (a, b, c, d, e))


def _of_weights(ask: Callable[[np.ndarray, np.ndarray], np.ndarray], vertices: Any, points: Any) -> np.ndarray:
    vertices, points = exact_doubles(vertices, "vertices"), exact_doubles(points, "points")
    if vertices.ndim < 2 or points.ndim < 1 or vertices.shape[-1] != points.shape[-1]:
        _core.fail("argument.size", "shapes of vertices and points", expected="(..., n, d) and (..., d)",
                   found=f"{vertices.shape} and {points.shape}")  # fmt: skip
    leading = _broadcast("leading shapes of vertices and points", vertices.shape[:-2], points.shape[:-1])
    n, d = vertices.shape[-2:]
    simplices = np.ascontiguousarray(np.broadcast_to(vertices, leading + (n, d)).reshape(-1, n, d))
    places = np.ascontiguousarray(np.broadcast_to(points, leading + (d,)).reshape(-1, d))
    return ask(simplices, places).reshape(leading + (n,))


def barycentric_weights(vertices: Any, points: Any) -> np.ndarray:
    """Barycentric weights, each the exact one rounded once to nearest, ties to even.

    Args:
        vertices: (..., n, d): segments (2, 3), triangles (3, 2) or in space (3, 3), tetrahedra (4, 3). In space a point off
            the plane or line of its simplex stands for its orthogonal projection.
        points: (..., d); leading shapes broadcast.

    Returns:
        (..., n); NaN of a degenerate simplex.

    >>> barycentric_weights([[0, 0], [3, 0], [0, 3]], [1, 1])
    array([0.33333333, 0.33333333, 0.33333333])
    """
    return _of_weights(_core.barycentric_weights, vertices, points)


def weight_signs(vertices: Any, points: Any) -> np.ndarray:
    """The exact signs of barycentric weights; arguments as of `barycentric_weights`.

    Returns:
        (..., n) int8: a point is inside where none is negative, and on the face of those that are not zero. All are zero
        if the simplex is degenerate.

    >>> weight_signs([[0, 0], [3, 0], [0, 3]], [[1, 1], [1, 0], [4, 4]])
    array([[ 1,  1,  1],
           [ 1,  1,  0],
           [-1,  1,  1]], dtype=int8)
    """
    return _of_weights(_core.weight_signs, vertices, points)
