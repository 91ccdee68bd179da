// On a triangle, inside or outside.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "barycert/simplex.hpp"
#include "barycert/surface_locator.hpp"
#include "mesh/index/bins.hpp"
#include "mesh/index/cell_tree.hpp"
#include "mesh/index/crossing.hpp"
#include "mesh/index/facet_contact.hpp"
#include "mesh/locate/near_feature.hpp"
#include "mesh/locate/surface/surface_data.hpp"

namespace barycert::locate {
namespace {

bool box_of_triangle_holds(const PlacedFacet& f, const double* p) {
    for (std::size_t k = 0; k < 3; ++k) {
        const auto [low, high] = std::minmax({f.at[0][k], f.at[1][k], f.at[2][k]});
        if (p[k] < low || p[k] > high) return false;
    }
    return true;
}

Feature feature_of(int corners) {
    return corners == 3 ? Feature::face : corners == 2 ? Feature::edge : Feature::vertex;
}

/// The feature of the triangle on which the point lies; `outside` if it does not.
Feature feature_at(const Triangles& triangles, std::size_t t, const double* p) {
    const PlacedFacet& f = triangles.facets[t];
    if (triangles.is_flat(t)) {
        const unsigned corners = part_of_flat(f.at, p);
        return corners == 0 ? Feature::outside : feature_of(std::popcount(corners));
    }
    const auto face = index::face_around(3, f, p);
    if (face[0] < 0) return Feature::outside;
    return feature_of(face[2] >= 0 ? 3 : face[1] >= 0 ? 2 : 1);
}

}  // namespace

SurfaceLocation SurfaceData::on_the_way(const double* p, const double* end, SideSum& side) const {
    CellBox ray = box_of(triangles.index, &p, 1);
    ray.high[0] = std::isfinite(end[0]) ? triangles.index.bins.quantizer().at(0, end[0]) : Quantizer::max;
    SurfaceLocation found;
    boxes->for_each_meeting(ray, [&](std::size_t t) {
        if (box_of_triangle_holds(triangles.facets[t], p)) {
            const Feature feature = feature_at(triangles, t, p);
            if (feature != Feature::outside && (found.triangle < 0 || triangles.number(t) < found.triangle)) {
                found.triangle = triangles.number(t);
                found.feature = feature;
            }
        }
        if (found.triangle >= 0) return true;
        const std::array<const double*, 3> turned = triangles.turned(t);
        int crossing = index::crossing(turned, p);
        if (std::isfinite(end[0])) crossing -= index::crossing(turned, end);
        side.add(sides, t, crossing);
        return true;
    });
    return found.triangle < 0 ? as_location(side) : found;
}

SurfaceLocation SurfaceData::locate(const double* p) const {
    SideSum side;
    return locate(p, side);
}

SurfaceLocation SurfaceData::locate(const double* p, SideSum& side) const {
    if (empty() || !triangles.index.box_holds(p)) return {};
    const double end[3] = {HUGE_VAL, p[1], p[2]};
    return on_the_way(p, end, side);
}

/// With the map: most points are told by their bin alone, others by the triangles on the way to the next such bin.
SurfaceLocation SurfaceData::locate_by_map(const double* p) const {
    if (!triangles.index.box_holds(p)) return {};
    const SideMap& map = side_map();
    if (const std::int16_t code = map.at(p); code != SideMap::touched) return as_location(SideSum(code));
    double end[3];
    SideSum side(map.next(p, end));
    return on_the_way(p, end, side);
}

}  // namespace barycert::locate
