/// Points to owners, a chunk at a time.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "barycert/locate/cell_signs.hpp"
#include "barycert/locate/locator_data.hpp"
#include "barycert/locate/tree_lanes.hpp"
#include "barycert/locate/walk_lanes.hpp"

namespace barycert::locate {

/// Points that are found together: enough for full lanes in every round of the walks, few enough for the first cache.
inline constexpr std::size_t chunk_size = 512;

/// Not shared between threads: it keeps the memory of its work.
class Finder {
public:
    explicit Finder(const LocatorData& data) : data_(data) {}

    /// For each of `count` <= chunk_size points: the place of its owner, -1 outside, and the feature.
    /// Precondition: finite points.
    void find(const PointRecord* points, std::size_t count, Place* owner, Feature* feature, LocationCounts& counts);

    /// The same for one point, the walk starting at a given cell.
    void find_from(Place start, const PointRecord& point, Place& owner, Feature& feature);

    /// found(point, cell of the mesh, feature) for every cell that holds each of the points, in no order.
    template <class F>
    void find_all(const PointRecord* points, std::size_t count, LocationCounts& counts, F found) {
        std::array<std::uint32_t, chunk_size> which;
        std::size_t in_box = 0;
        for (std::size_t i = 0; i < count; ++i) {
            which[in_box] = static_cast<std::uint32_t>(i);
            in_box += data_.index.box_holds(points[i].at.data()) ? 1 : 0;
        }
        for_candidates(points, which.data(), in_box, counts.tests, [&](const Candidate& c, WeightSigns signs) {
            if (signs.contains())
                found(c.point, data_.index.original[static_cast<std::size_t>(c.cell)],
                      signs.feature(data_.index.simplex));
        });
    }

private:
    void start(const PointRecord* points, std::size_t count);
    void walk(const PointRecord* points, std::size_t count, Place* owner, Feature* feature, TierCounts& tests);
    void resolve(const PointRecord& point, Walk stuck, Place* owner, Feature* feature, TierCounts& tests);
    void ask_candidates(const PointRecord* points, Place* owner, Feature* feature, TierCounts& tests);

    /// use(candidate, exact signs of its cell) for every cell whose box holds points[which[i]].
    template <class Use>
    void for_candidates(const PointRecord* points, const std::uint32_t* which, std::size_t count, TierCounts& tests,
                        Use use) {
        constexpr std::size_t points_at_once = 16, enough = 4096;
        candidates_.clear();
        for (std::size_t i = 0; i < count; i += points_at_once) {
            find_candidates(data_.index, data_.tree(), points, which + i, std::min(points_at_once, count - i),
                            candidates_);
            if (candidates_.size() < enough && i + points_at_once < count) continue;
            for (const Candidate& c : candidates_) {
                // Boxes in whole numbers are larger; in cells far smaller than their domain, much.
                const double* const at = points[c.point].at.data();
                if (box_holds(data_.index, c.cell, at)) use(c, cell_signs(data_.index, c.cell, at, tests));
            }
            candidates_.clear();
        }
    }

    const LocatorData& data_;
    std::array<Walk, chunk_size> walks_;
    std::size_t walking_ = 0;
    std::array<Walk, chunk_size + 1> stuck_;
    std::array<std::uint32_t, chunk_size> asked_;  ///< points for which every candidate is asked
    std::size_t asked_count_ = 0;
    std::vector<Candidate> candidates_;
};

}  // namespace barycert::locate
