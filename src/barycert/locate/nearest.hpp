/// The search for the nearest point of a mesh, with its work counted.
#pragma once

#include <cstdint>

#include "barycert/locate/locator_data.hpp"
#include "barycert/locator.hpp"

namespace barycert::locate {

/// How much a search looked at, for tests of its cost.
struct NearestWork {
    std::uint64_t boxes = 0;        ///< of groups of cells
    std::uint64_t cells = 0;        ///< of which corners were read
    std::uint64_t exact = 0;        ///< cells whose feature was found exactly
    std::uint64_t comparisons = 0;  ///< in integers
};

/// As Locator::nearest. Precondition: coordinates are finite.
Nearest find_nearest(const LocatorData& data, const double* point, double limit, NearestWork* work = nullptr);

}  // namespace barycert::locate
