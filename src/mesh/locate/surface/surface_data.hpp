/// All that a SurfaceLocator keeps.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "barycert/mesh.hpp"
#include "barycert/simplex.hpp"
#include "barycert/surface.hpp"
#include "barycert/surface_locator.hpp"
#include "mesh/index/bins.hpp"
#include "mesh/index/cell_index.hpp"
#include "mesh/index/cell_tree.hpp"
#include "mesh/index/facet_contact.hpp"
#include "mesh/index/ridges.hpp"
#include "mesh/index/triangles.hpp"
#include "mesh/locate/lazy.hpp"
#include "mesh/locate/nearest.hpp"

namespace barycert::locate {

using index::PlacedFacet, index::Ridge, index::Triangles;

struct SurfaceData;

/// Numbers that triangles count in winding numbers (side_rules.cpp).
struct SideCounts {
    SideRules rules;
    /// By place: how many times a triangle counts as it is turned, or `parity`; empty: each once.
    std::vector<std::int8_t> of;
    static constexpr std::int8_t parity = 2;
};
SideCounts count_sides(const Triangles& triangles);

/// A winding number, and beside it the parity of what has no other.
class SideSum {
public:
    SideSum() = default;
    explicit SideSum(std::int16_t code) : winding_(code >> 1), parity_(code & 1) {}

    /// A triangle that a ray crosses: `crossing` as index::crossing() has it.
    void add(const SideCounts& counts, std::size_t place, int crossing) {
        const std::int8_t times = counts.of.empty() ? std::int8_t{1} : counts.of[place];
        if (times == SideCounts::parity) parity_ ^= crossing & 1;
        if (times != SideCounts::parity) winding_ += times * crossing;
    }
    int sum() const { return winding_ + parity_; }
    /// Both in one number. Requires: fits().
    std::int16_t code() const { return static_cast<std::int16_t>(2 * winding_ + parity_); }
    bool fits() const { return winding_ > -16000 && winding_ < 16000; }

private:
    int winding_ = 0, parity_ = 0;
};

/// On which side of a surface the bins of a grid lie that no triangle touches. The box of the surface in bins: whole
/// numbers of the quantizer without their last bits. All points of a bin that no triangle touches have one winding
/// number, and so have two such bins side by side: what no triangle touches is connected, and windings change nowhere
/// but on triangles.
class SideMap {
public:
    explicit SideMap(const SurfaceData& surface);

    static constexpr std::int16_t touched = INT16_MIN;
    /// The code of a SideSum of a point in the box, exactly; `touched`, if a triangle touches its bin.
    std::int16_t at(const double* point) const { return sides_[bin_of(point)]; }

    /// A point on the ray from `point` along the first axis, in the next bin that no triangle touches, and its code;
    /// beyond the box that is 0.
    std::int16_t next(const double* point, double (&end)[3]) const;

    std::size_t bytes() const { return sides_.size() * sizeof(std::int16_t); }

private:
    std::int32_t on_axis(std::size_t k, double x) const { return bins_->quantizer().at(k, x) >> shift_[k]; }
    std::size_t bin_of(const double* p) const { return bin(on_axis(0, p[0]), on_axis(1, p[1]), on_axis(2, p[2])); }
    std::size_t bin(std::int32_t i, std::int32_t j, std::int32_t k) const {
        return (static_cast<std::size_t>(k) * size_[1] + static_cast<std::size_t>(j)) * size_[0] +
               static_cast<std::size_t>(i);
    }
    void touch(const SurfaceData& surface);
    void fill(const SurfaceData& surface);
    /// A point of the bin, if rounding leaves one there.
    bool middle_of(std::size_t bin, double (&p)[3]) const;

    const Bins* bins_;
    int shift_[3] = {};
    std::size_t size_[3] = {};
    std::vector<std::int16_t> sides_;
};

// Which triangles may be the nearest to a point: in floating point, with bounds, eight at a time.

/// Triangles in groups of eight, and boxes of eight groups, in a unit in which the largest coordinate is near 1. Their
/// order halves them again and again along the longest side of the box of their middles.
struct NearGroups {
    struct alignas(64) Triangles {
        double at[3][3][8];  ///< of corner, axis, triangle
    };
    struct alignas(64) Boxes {
        double low[3][8], high[3][8];
    };

    /// Requires: there is a triangle.
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

/// Triangles that are left to be decided exactly, and how near a point of each may be, in squares.
struct NearCandidates {
    std::vector<std::uint32_t> number;  ///< in NearGroups::order
    std::vector<double> low;
};

/// All triangles that may have the nearest point, or one as near, if it is not farther than sqrt(square) in the unit.
/// `hint`: a triangle to begin with; becomes one that is near. Requires: usable; the point was taken.
void find_candidates(const NearGroups& groups, const double (&point)[3], double square, std::uint32_t& hint,
                     NearCandidates& found);

// The vertex, edge or face of a triangle that is nearest to a point, and the nearest point of that, rounded: what
// floating point can say for certain, many at a time.

/// In a unit in which all numbers are at most 16 and the largest coordinate of corners is near 1.
struct NearPair {
    double point[3];
    double at[3][3];  ///< of corner, axis; for `round_nearest` those of the feature come first
};

/// masks[i]: of the corners of the feature of pair i that is nearest, a bit each; 0 where it is not certain.
void classify_nearest(const NearPair* pairs, std::size_t count, std::uint8_t* masks);

/// The projection of the point on the first `corners` corners, and its distance; all correctly rounded, if `certain`.
struct NearRounded {
    double distance, at[3], weights[3];
    bool certain;
};
void round_nearest(const NearPair* pairs, std::size_t count, int corners, NearRounded* to);

struct SurfaceData {
    const Surface* surface = nullptr;
    int threads = 0;
    Triangles triangles;
    SideCounts sides;
    std::unique_ptr<BoxGroups> boxes;  ///< of the triangles

    bool empty() const { return triangles.size() == 0; }
    /// These require: not empty.
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
        return triangles.bytes() + sides.of.size() + (boxes ? boxes->bytes() : 0) +
               bytes_of(far_tree_, near_groups_, side_map_);
    }

    /// Exact, without the map. Requires: finite.
    SurfaceLocation locate(const double* p) const;
    SurfaceLocation locate(const double* p, SideSum& side) const;
    SurfaceLocation locate_by_map(const double* p) const;
    /// Points are best in the order of space.
    void nearest(std::span<const double* const> points, double limit, std::span<SurfaceNearest* const> to) const;
    /// Nothing of triangle -1.
    void nearest_on(Mesh::Index triangle, const double* p, SurfaceNearest& to) const;
    std::vector<SurfaceHit> hits(const double* a, const double* b, bool ray) const;

    /// Locates p by the triangles between p and the end of a ray along the first axis, which has the sum `side`: on the
    /// lowest triangle that holds it, or by its own sum.
    SurfaceLocation on_the_way(const double* p, const double* end, SideSum& side) const;
    SurfaceLocation as_location(const SideSum& side) const {
        const int winding = sides.rules.turned == Turned::open ? 0 : side.sum();
        return {-1, winding != 0 ? Feature::interior : Feature::outside, winding};
    }

private:
    Lazy<NearestTree> far_tree_;
    Lazy<NearGroups> near_groups_;
    Lazy<SideMap> side_map_;
};

}  // namespace barycert::locate
