/// The middle tier of crossings, on SIMD lanes, dispatched at run time as those of core/lanes.hpp.
#pragma once

#include <cstddef>
#include <cstdint>

#include "barycert/surface.hpp"

namespace barycert::surface {

/// Crossings of edges: values[2 c + i][j] is number c at the end of edge j that is in the set (i = 0), or that is not
/// (i = 1). out[components * j + c] is number c where g is zero, correctly rounded where that is certain. Each returns
/// how many edges are undecided, their numbers, ascending, in undecided[0 ...], which has room for `count`.
struct EdgeBlock {
    const double* const* values;
    int components;
    std::size_t count;  ///< any; below 2^32
};

/// g = f - value; f[i][j] is the field at end i of edge j.
std::size_t level_lanes(double value, const double* const* f, const EdgeBlock& edges, double* out,
                        std::uint32_t* undecided);

/// g = offset - normal.x; the first three numbers are the coordinates.
std::size_t plane_lanes(const Plane& plane, const EdgeBlock& edges, double* out, std::uint32_t* undecided);

}  // namespace barycert::surface
