/// The condition number of a cell: how many bits a plain kernel may lose in the weights of points of the cell.
///
/// For a corner v of a triangle or tetrahedron let E be the matrix of its edges from v, perm the permanent (the
/// determinant with every sign a plus). Then
///
///     kappa = max over corners v of  perm |E| / |det E|
///
/// |det E| is the same for every v, twice the area or six times the volume. kappa is at least 1, and 1 for a right
/// angled cell along the axes, however long its sides: multiplying an axis by a number changes neither the quotient nor
/// what a kernel loses. It is large for a cell that is thin askew to the axes, where the products of a determinant
/// cancel.
///
/// What it means. Let u = 2^-53, p a point of the cell, r_j = v_j - p. A kernel of signed areas or volumes computes the
/// numerator of weight i, det of all r_j but r_i, from rounded differences; a term of it meets at most 4 roundings (2D)
/// or 8 (3D), as in filter-inl.hpp, so that to first order the numerator is off by at most 4 u or 8 u times perm of
/// those |r_j|, and the weight by that over |det E|, besides one rounding of the quotient and the denominator's error.
///   2D: r_j = sum of w_m (v_j - v_m), w the exact weights, and perm is monotone and linear in each row. With P_v the
///   permanent at corner v, and perm(|e|, |e|) <= P_j + P_k for the edge e between j and k (replace one |e| by the
///   larger sum of the other two edges),
///     perm(|r_j|, |r_k|) <= w_i^2 P_i + w_i w_j P_j + w_i w_k P_k + w_j w_k (P_j + P_k)
///                        <= (w_i + 2 w_j w_k) max P <= max P,
///   since 2 w_j w_k <= (1 - w_i)^2 / 2. So each numerator is off by at most 4 u kappa |det E|, and so is the
///   denominator if it comes from the edges: a weight w <= 1 is off by at most 4 u kappa (1 + w) + u w <= 9 u kappa. If
///   the denominator is the sum of the three numerators, it is off by at most the sum of their bounds, 4 u times the
///   sum of the three permanents, at most (1 + 2 (w_i w_j + w_j w_k + w_k w_i)) max P <= 5/3 max P: 32/3 u kappa + 3 u.
///   3D: there is no such bound. Where two opposite edges of length h are a distance 1 apart along (1, 1, 1), |det E|
///   is about h^2 and every P_v about h, but perm |r| is about 1 in the middle between them: kappa is about 1 / h, and
///   a kernel may lose 1 / h^2. (The largest |e_x e_y e_z| of an edge e taken in with the permanents would cover such
///   cells.) With random such needles of h = 2^-12 the signed volumes are off by 800 u kappa.
/// Measured where kappa < 2^47, above which denominators may be all error: with six seeds, over all families of the
/// audit, which have no such needles, signed areas are within 4 u kappa, signed volumes too, Cramer's rule within 7.2,
/// the inverse matrix, whose weights are sums, within 17 (tests/audit/prediction_test.cpp; `barycert audit --plot`).
#pragma once

#include "barycert/core/simplex.hpp"

namespace barycert {

/// kappa of the triangle or tetrahedron at `vertices` (layout of Case), with a relative error below 2^-10. Infinite if
/// and only if the cell is exactly degenerate; a quotient beyond the largest double is given as the largest double. NaN
/// if a coordinate is not finite, and for segment and triangle3d: points are projected on them by dot products, whose
/// loss is another one.
double condition_number(Simplex simplex, const double* vertices);

}  // namespace barycert
