/// The condition number of a cell: how many bits a kernel that works with differences of coordinates may lose in the
/// weights of points of the cell.
///
///     kappa = (volume of the cell's box along the axes) / (volume of the cell)        (areas in 2D)
///           = d! X Y Z / |det E|,    X, Y, Z the extents of the cell, E the matrix of its edges from a corner
///
/// It is 6 for a right-angled tetrahedron along the axes, however long its sides, and never below 3 for a tetrahedron
/// or 2 for a triangle. Multiplying an axis by a power of two changes neither kappa nor what such a kernel loses. It is
/// large where a cell is thin in a direction oblique to the axes: there the products of a determinant are as large as
/// the box and cancel to the cell.
///
/// Derivation. Let u = 2^-53 and p a point of the cell. Every difference of coordinates that a kernel forms, of two
/// vertices or of a vertex and p, is at most the extent X, Y or Z; so every product in a determinant is at most X Y Z.
/// To first order a sum of n such products, each of which meets k roundings on its way, is off by at most k n u X Y Z.
/// Counted as in filter-inl.hpp:
///   2D  a numerator has 2 products of 4 roundings: 4 u kappa |det E|. So has the denominator if it comes from the
///       edges; as the sum of three numerators it has 6 of 6: 18 u kappa |det E|.
///   3D  a numerator has 6 products of 8 roundings: 8 u kappa |det E|. So has the denominator if it comes from the
///       edges; as the sum of four numerators it has 24 of 10: 40 u kappa |det E|.
/// A weight w = numerator / denominator, 0 <= w <= 1, is off by the first, by w times the second, and by u w: at most
/// 8 u kappa + u or 22 u kappa + u in 2D, and 16 u kappa + u or 48 u kappa + u in 3D. A weight that is computed as 1
/// less the others is off by the sum of their errors. Kernels that multiply by a rounded inverse of E meet the same
/// products with a few more roundings. Measured, the constant is about 1 in 3D and 2 in 2D
/// (tests/audit/prediction_test.cpp).
///
/// Why not perm |E| / |det E|, the usual quotient: at no corner need the permanent be as large as in the middle. Where
/// two opposite edges of length h are a distance 1 apart along (1, 1, 1), |det E| is about h^2, every corner's
/// permanent about h, and the kernel loses 1 / h^2 in between.
#pragma once

#include "barycert/simplex.hpp"

namespace barycert {

/// Returns kappa of the triangle or tetrahedron at `vertices` (layout of Case), with a relative error below 2^-10:
/// infinity if and only if the cell is exactly degenerate; the max double if the quotient is beyond it; NaN if a
/// coordinate is not finite, and for segment and triangle3d (points are projected on them by dot products, which lose
/// accuracy in another way).
double condition_number(Simplex simplex, const double* vertices);

}  // namespace barycert
