// On a triangle, inside or outside.
#include <cmath>

#include "barycert/index/crossing.hpp"
#include "barycert/locate/surface/surface_data.hpp"

namespace barycert::locate {
namespace {

bool box_of_triangle_holds(const PlacedFacet& f, const double* p) {
    for (std::size_t k = 0; k < 3; ++k) {
        const auto [low, high] = std::minmax({f.at[0][k], f.at[1][k], f.at[2][k]});
        if (p[k] < low || p[k] > high) return false;
    }
    return true;
}

}  // namespace

SurfaceLocation SurfaceData::on_the_way(const double* p, const double* end, int side) const {
    CellBox ray = box_of(triangles.index, &p, 1);
    ray.high[0] = std::isfinite(end[0]) ? triangles.index.bins.quantizer().at(0, end[0]) : Quantizer::max;
    SurfaceLocation found;
    boxes->for_each_meeting(ray, [&](std::size_t t) {
        const PlacedFacet& f = triangles.facets[t];
        if (box_of_triangle_holds(f, p)) {
            const auto face = index::face_around(3, f, p);
            if (face[0] >= 0 && (found.triangle < 0 || triangles.number(t) < found.triangle)) {
                found.triangle = triangles.number(t);
                found.feature = face[2] >= 0 ? Feature::face : face[1] >= 0 ? Feature::edge : Feature::vertex;
            }
        }
        if (found.triangle >= 0) return true;
        const std::array<const double*, 3> turned = triangles.turned(t);
        found.winding += index::crossing(turned, p);
        if (std::isfinite(end[0])) found.winding -= index::crossing(turned, end);
        return true;
    });
    if (found.triangle < 0) return as_location(found.winding + side);
    found.winding = 0;
    return found;
}

SurfaceLocation SurfaceData::locate(const double* p) const {
    if (empty() || !triangles.index.box_holds(p)) return {};
    const double end[3] = {HUGE_VAL, p[1], p[2]};
    return on_the_way(p, end, 0);
}

/// With the map: most points are told by their bin alone, others by the triangles on the way to the next such bin.
SurfaceLocation SurfaceData::locate_by_map(const double* p) const {
    if (!triangles.index.box_holds(p)) return {};
    const SideMap& map = side_map();
    if (const std::int16_t side = map.at(p); side != SideMap::touched) return as_location(side);
    double end[3];
    const std::int16_t side = map.next(p, end);
    return on_the_way(p, end, side);
}

}  // namespace barycert::locate
