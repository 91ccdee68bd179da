/// Exact proofs, case by case, that interpolation along auxiliary lines is barycentric interpolation.
///
/// Bilinear: the horizontal line through the point meets two sides of the triangle; interpolate along the sides, then
/// along the line. Trilinear: a plane through the point meets three edges of the tetrahedron, a line in it the segments
/// in two faces; interpolate along the edges, the segments, the line. Both are carried out in CGAL's rationals and
/// compared with ratios of signed areas or volumes. In floating point the three differ; the audit shows how.
#pragma once

#include <cstdint>

#include "barycert/core/simplex.hpp"

namespace barycert::exact {

enum class Identity : std::uint8_t {
    holds,      ///< equal as rational numbers, every weight
    fails,      ///< unequal: would refute the theorem
    undefined,  ///< degenerate, or every choice of auxiliary lines meets a vertex or runs along a side
};

/// Precondition: c.simplex == Simplex::triangle, finite coordinates.
Identity bilinear_is_barycentric(const Case& c);

/// Precondition: c.simplex == Simplex::tetrahedron, finite coordinates.
Identity trilinear_is_barycentric(const Case& c);

}  // namespace barycert::exact
