/// The middle tier of perspective-correct interpolation: points of one triangle on SIMD lanes, dispatched as lanes.hpp.
///
/// `vertices` as perspective.hpp has them; x[j], y[j] is point j. Arrays of points and answers have room for a multiple
/// of 8, or count is 1. Each writes what its bound proves, lists the numbers of the points it leaves undecided in
/// undecided[0 ...], ascending, and returns how many they are. Points and values that are not finite are undecided.
#pragma once

#include <cstddef>
#include <cstdint>

namespace barycert::core {

struct PointBlock {
    const double* x;
    const double* y;
    std::size_t count;  ///< below 2^32
};

/// out[i][j] is weight i of point j.
std::size_t perspective_weight_lanes(const double* vertices, const PointBlock& points, double* const* out,
                                     std::uint32_t* undecided);

/// out[j] is the depth of point j.
std::size_t perspective_depth_lanes(const double* vertices, const PointBlock& points, double* out,
                                    std::uint32_t* undecided);

/// values[components * i + c] is component c at vertex i; out[c][j] at point j.
std::size_t perspective_value_lanes(const double* vertices, const PointBlock& points, const double* values,
                                    int components, double* const* out, std::uint32_t* undecided);

}  // namespace barycert::core
