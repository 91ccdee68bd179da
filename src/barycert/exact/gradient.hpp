/// The gradient of a linear field, by the oracle: exact integers, rounded once, nothing shared with core.
///
/// The mathematics. The gradient of weight i is the normal of the opposite face over the signed volume: with (i, a, b,
/// c) an even permutation of the vertices, grad lambda_i = -((b - a) x (c - a)) / det(v1 - v0, v2 - v0, v3 - v0); in
/// the plane, with (i, a, b) one, grad lambda_i = (a - b) turned by a right angle over the signed area. The gradient is
/// the sum of values times these.
#pragma once

#include <array>

#include "barycert/core/simplex.hpp"

namespace barycert::exact {

struct GradientAnswer {
    bool degenerate = false;
    std::array<double, 3> gradient{};  ///< correctly rounded; NaN if degenerate
};

/// Of the field with c.values at the vertices; the point has no part in it. Preconditions: triangle or tetrahedron,
/// everything finite.
GradientAnswer gradient(const Case& c);

}  // namespace barycert::exact
