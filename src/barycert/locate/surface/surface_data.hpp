/// All that a SurfaceLocator keeps.
#pragma once

#include "barycert/index/cell_tree.hpp"
#include "barycert/index/triangles.hpp"
#include "barycert/locate/lazy.hpp"
#include "barycert/locate/nearest.hpp"
#include "barycert/locate/surface/nearest_lanes.hpp"
#include "barycert/locate/surface/side_map.hpp"
#include "barycert/surface_locator.hpp"

namespace barycert::locate {

using index::PlacedFacet, index::Ridge, index::Triangles;

struct SurfaceData {
    const Surface* surface = nullptr;
    int threads = 0;
    Triangles triangles;
    Turned turned = Turned::open;
    std::unique_ptr<BoxGroups> boxes;  ///< of the triangles

    bool empty() const { return triangles.size() == 0; }
    /// Preconditions for these: not empty.
    const NearestTree& far_tree() const {
        return far_tree_.get([&] { return NearestTree(triangles.index); });
    }
    const NearGroups& near_groups() const {
        return near_groups_.get([&] { return NearGroups(triangles.index); });
    }
    const SideMap& side_map() const {
        return side_map_.get([&] { return SideMap(*this); });
    }
    std::size_t bytes() const {
        return triangles.bytes() + (boxes ? boxes->bytes() : 0) + bytes_of(far_tree_, near_groups_, side_map_);
    }

    /// Exact, without the map. Precondition: finite.
    SurfaceLocation locate(const double* p) const;
    SurfaceLocation locate_by_map(const double* p) const;
    /// Points are best in the order of space.
    void nearest(std::span<const double* const> points, double limit, std::span<SurfaceNearest* const> to) const;
    /// Nothing of triangle -1. False if the triangle has no area.
    bool nearest_on(Mesh::Index triangle, const double* p, SurfaceNearest& to) const;
    std::vector<SurfaceHit> hits(const double* a, const double* b, bool ray) const;

    /// By the triangles between p and the end of a ray along the first axis, which has the winding number `side`.
    SurfaceLocation on_the_way(const double* p, const double* end, int side) const;
    SurfaceLocation as_location(int winding) const {
        if (turned == Turned::even) winding &= 1;
        if (turned == Turned::open) winding = 0;
        return {-1, winding != 0 ? Feature::interior : Feature::outside, winding};
    }

private:
    Lazy<NearestTree> far_tree_;
    Lazy<NearGroups> near_groups_;
    Lazy<SideMap> side_map_;
};

}  // namespace barycert::locate
