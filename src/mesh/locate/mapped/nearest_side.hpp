/// The nearest point of a mesh in which cells have maps.
///
/// Cells without maps are asked as ever (nearest.hpp). The search goes through the boundary facets of the others, the
/// nearest boxes first, and looks at the vertices and edges of each, and at the facet itself. On a vertex there is one
/// point. On edges and facets the square of the distance is cut into parts (square_parts.hpp): left out are parts that
/// are certainly farther than the best so far, or where it slopes; Newton's method finds a point where it does not, and
/// proves that around it there is no other (core/isoparametric/near_patch.hpp). Parts that are too small to tell are
/// kept as they are, with a bound. The nearest of the points found is taken, compared in up to 300 bits or in rational
/// numbers; of several equally near the one in the lowest cell, then one on a vertex before one on an edge before one
/// on a facet, then the one with the lowest nodes, then with the lowest parameters.
#pragma once

#include <memory>
#include <utility>

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

/// Requires: cells have maps; the point is finite, stays where it is, and is outside.
NearestInMaps nearest_in_maps(const LocatorData& data, const double* point, double limit);

}  // namespace barycert::locate
