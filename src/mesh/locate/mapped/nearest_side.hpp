/// The nearest point of a mesh in which cells have maps.
///
/// Cells without maps are asked as ever (nearest.hpp). Of the others the facets of their boundary are gone through, the
/// nearest boxes first, and of each its vertices, edges and itself. On a vertex there is one point. On edges and facets
/// the square of the distance is cut into parts (square_parts.hpp): left out are parts that are certainly farther than
/// the best so far, or where it slopes; Newton's method finds a point where it does not, and proves that around it
/// there is no other (core/isoparametric/near_patch.hpp). What is left when parts are too small to tell is kept as it
/// is, with a bound. Of the points found the nearest is taken, compared in up to 300 bits or in rational numbers; of
/// several as near that in the lowest cell, then that on a vertex before one on an edge before one on a facet, then
/// that with the lowest nodes, then with the lowest parameters.
#pragma once

#include "barycert/locator.hpp"
#include "core/isoparametric/near_patch.hpp"
#include "mesh/locate/mapped/cell_sides.hpp"

namespace barycert::locate {

struct LocatorData;

/// The nearest point where it is one of a cell with a map.
struct PointOnSide {
    Side side;
    core::isoparametric::NearPatch at;

    PointOnSide(Side of, const double* point) : side(std::move(of)), at(side.patch, point) {}
    PointOnSide(const PointOnSide&) = delete;
    PointOnSide& operator=(const PointOnSide&) = delete;
};

struct NearestInMaps {
    Nearest nearest;
    /// The distance exceeds that to the nearest point by at most so much, beside its rounding: 0 where it is proved.
    double off = 0;
    std::unique_ptr<PointOnSide> on = {};  ///< nullptr: `nearest` is a straight cell's
};

/// Preconditions: cells have maps; the point is finite, stays where it is, and is outside.
NearestInMaps nearest_in_maps(const LocatorData& data, const double* point, double limit);

}  // namespace barycert::locate
