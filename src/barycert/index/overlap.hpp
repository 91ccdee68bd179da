/// Do the interiors of two cells meet? Exactly, by separating planes.
#pragma once

#include <array>

namespace barycert::index {

/// A cell that is not degenerate: d + 1 corners.
using Corners = std::array<const double*, 4>;

/// True if the interiors have a point in common. Preconditions: not degenerate, coordinates finite.
bool interiors_meet(int d, const Corners& a, const Corners& b);

}  // namespace barycert::index
