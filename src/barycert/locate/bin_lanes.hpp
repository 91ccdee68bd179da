/// The bins of many points at once, on SIMD lanes.
#pragma once

#include <cstdint>
#include <span>

#include "barycert/locate/names.hpp"

namespace barycert::locate {

class Occupancy;

/// In place of a bin: no cell holds the point.
inline constexpr std::uint32_t no_bin = ~std::uint32_t{0};

/// bin[i] = index.bins.of(point i), or no_bin if the point lies beyond the box of the cells or, if `occupancy` is
/// given, where it has no cell. Returns whether all coordinates are finite; a point with one that is not gets no_bin.
bool find_bins(const CellIndex& index, const Occupancy* occupancy, std::span<const double> points, std::uint32_t* bin);

}  // namespace barycert::locate
