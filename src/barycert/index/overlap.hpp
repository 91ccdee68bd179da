/// Do the interiors of two cells meet? Exactly, by separating planes.
#pragma once

#include <array>

namespace barycert::index {

/// A cell that is not degenerate: d + 1 corners. Common ones need not be at the same address, but are told faster so.
using Corners = std::array<const double*, 4>;

/// False if a facet of one cell separates the interiors of both. May be true where they are disjoint.
bool may_overlap(int d, const Corners& a, const Corners& b);

/// True if the interiors have a point in common. Preconditions: not degenerate, coordinates finite.
bool interiors_meet(int d, const Corners& a, const Corners& b);

}  // namespace barycert::index
