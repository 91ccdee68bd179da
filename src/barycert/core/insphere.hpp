/// Exact predicates: a point against the circle through three others, or the sphere through four.
///
/// Enters: coordinates as doubles, all axes in one unit. Leaves: signs of the exact polynomials in these very doubles.
///
/// What holds, under the names of predicates.hpp (S1, S2 and E are tests of that name in tests/core/insphere_test.cpp):
///   S1  A sign is exact for every finite input, subnormals and 1e308 included, in every rounding mode, with
///       flush-to-zero or without: floating point answers only what its error bound proves, integers answer the rest.
///   S2  An even permutation of all arguments, the last one included, keeps a sign, an odd one flips it. Multiplying
///       all axes by one power of two (without leaving the doubles) changes none; one axis alone does.
///   D1  Answers depend on the input bits alone.
///   E   NaN or infinity among the coordinates gives an Error, never a sign.
///
/// Conventions, those of CGAL's side_of_oriented_circle and side_of_oriented_sphere, with predicates.hpp's orient2d
/// and orient3d:
///   simplex           last point inside    on the circle or sphere    outside
///   positive          positive             zero                       negative
///   negative          negative             zero                       positive
///
///          c           incircle(a, b, c, p) > 0, for a, b, c turn counter-clockwise and p is inside
///      .   |\  .
///     .    | \  .      The answer without orientation, as Delaunay tests want it, is a product of signs:
///     .  p |  \ .          incircle(a, b, c, p) * orient2d(a, b, c)            positive inside, negative outside
///      .   a---b           insphere(a, b, c, d, p) * orient3d(a, b, c, d)
///        . _ .
///
/// What does not hold: a flat simplex has no circle or sphere. The product is zero for it, wherever the point; the sign
/// alone is that of the determinant. Three distinct points on a line: incircle has one sign on one side of the line,
/// the other sign on the other, zero on it. Likewise insphere and the plane of a, b, c, d; but it is zero everywhere if
/// these lie on one circle or line. Both are zero everywhere if two vertices coincide.
/// Integers as wide as 1e-300 beside 1e300 asks for take tens of microseconds, and a hundred KiB of stack (core.hpp).
#pragma once

#include "barycert/core/result.hpp"
#include "barycert/core/weight_signs.hpp"

namespace barycert {

/// Sign of det(q - d, |q - d|^2) over rows q = a, b, c of points with 2 coordinates: positive if d lies inside the
/// circle through a, b, c and these turn counter-clockwise. Error: a coordinate is not finite.
Result<Sign> incircle(const double* a, const double* b, const double* c, const double* d);

/// Sign of -det(q - e, |q - e|^2) over rows q = a, b, c, d of points with 3 coordinates: positive if e lies inside the
/// sphere through a, b, c, d and these are positive under orient3d. Error: a coordinate is not finite.
Result<Sign> insphere(const double* a, const double* b, const double* c, const double* d, const double* e);

}  // namespace barycert
