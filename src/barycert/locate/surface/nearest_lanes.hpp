/// Which triangles may be the nearest to a point: in floating point, with bounds, eight at a time.
#pragma once

#include "barycert/locate/names.hpp"

namespace barycert::locate {

/// Triangles in groups of eight, and boxes of eight groups, in a unit in which the largest coordinate is near 1. Their
/// order halves them again and again along the longest side of the box of their middles.
struct NearGroups {
    struct alignas(64) Triangles {
        double at[3][3][8];  ///< of corner, axis, triangle
    };
    struct alignas(64) Boxes {
        double low[3][8], high[3][8];
    };

    /// Precondition: there is a triangle.
    explicit NearGroups(const CellIndex& index);

    bool usable = false;                ///< all coordinates are exact in that unit
    int exponent = 0;                   ///< a coordinate times 2^exponent is in the unit
    double to_unit = 1, from_unit = 1;  ///< that power of two, and its inverse
    std::vector<std::uint32_t> order;   ///< the place of each triangle in the index
    std::size_t count = 0;
    Buffer<Triangles> triangles;
    Buffer<Boxes> boxes;              ///< of groups of triangles, then of eight groups, up to one
    std::vector<std::size_t> levels;  ///< where each begins, from the groups of triangles on

    /// The point in the unit; false if it is not exact there, or so far away that the bounds would tell little.
    bool take(const double* point, double (&to)[3]) const {
        bool near = usable;
        for (int k = 0; k < 3; ++k) {
            to[k] = point[k] * to_unit;
            near = near && to[k] <= 16 && to[k] >= -16 && to[k] * from_unit == point[k];
        }
        return near;
    }
    std::size_t bytes() const { return triangles.bytes() + boxes.bytes() + order.size() * sizeof(std::uint32_t); }
};

/// What is left to be decided exactly.
struct NearCandidates {
    static constexpr std::size_t most = 64;
    std::uint32_t number[most];  ///< in NearGroups::order
    std::size_t count = 0;
};

/// All triangles that may have the nearest point, or one as near, if it is not farther than sqrt(square) in the unit.
/// `hint`: a triangle to begin with; becomes one that is near. False if there are more than fit. Precondition: usable;
/// the point was taken.
bool find_candidates(const NearGroups& groups, const double (&point)[3], double square, std::uint32_t& hint,
                     NearCandidates& found);

}  // namespace barycert::locate
