/// Points to owners, a chunk at a time.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

#include "barycert/predicates.hpp"
#include "barycert/simplex.hpp"
#include "barycert/table.hpp"
#include "mesh/index/cell_index.hpp"
#include "mesh/index/proof.hpp"
#include "mesh/locate/cell_signs.hpp"
#include "mesh/locate/lanes.hpp"
#include "mesh/locate/locator_data.hpp"
#include "mesh/locate/sorted_points.hpp"

namespace barycert::locate {

/// Not shared between threads: it keeps the memory of its work.
class Finder {
public:
    /// Walks read `nodes`, those of the index or a copy. `points`: about how many there will be.
    Finder(const LocatorData& data, const NodeRecord* nodes, std::size_t points)
        : data_(data),
          proof_(data.parts.proved() != nullptr ? &data.parts.proved()->proof : nullptr),
          nodes_(nodes),
          fetch_(points < data.index.cell_count()) {}

    /// Points of the places [first, first + count) in `sorted` will be found after those of the next find().
    void expect(const SortedPoints& sorted, std::size_t first, std::size_t count);
    /// The points expected are those of the next find().
    void begin();

    /// For each of `count` <= chunk_size points: the place of its owner, -1 outside, and the feature. On a mesh for
    /// walks they are those of the last begin(). Requires: finite points in the box of the cells.
    void find(const PointRecord* points, std::size_t count, Place* owner, Feature* feature, LocationCounts& counts);

    /// The same for one point whose walk ended in doubt: `stuck` is what step_walks says, or -1 if it did not walk.
    void settle(const PointRecord& point, Place stuck, Place& owner, Feature& feature);

    /// found(point, cell of the mesh, feature) for every cell that holds each of the points, in no order. Requires:
    /// as of find().
    template <class F>
    void find_all(const PointRecord* points, std::size_t count, LocationCounts& counts, F found) {
        counts.ways.candidates += count;
        std::array<std::uint32_t, chunk_size> which;
        std::iota(which.begin(), which.begin() + static_cast<std::ptrdiff_t>(count), 0);
        for_candidates(points, which.data(), count, counts.tests, [&](const Candidate& c, WeightSigns signs) {
            if (signs.contains()) found(c.point, data_.index.original[c.cell], feature_of(data_.index, c.cell, signs));
        });
    }

private:
    void walk(const PointRecord* points, Place* owner, Feature* feature, LocationCounts& counts);
    /// Goes on from a cell where a walk in floating point did not end, by exact signs: the cell that contains the
    /// point, or ~(a cell that does not, from which there is no way on).
    Place out_of_circle(const PointRecord& point, Place cell, TierCounts& tests) const;
    /// Who else holds the points that arrived in contested cells?
    void ask_contested(const PointRecord* points, Place* owner, Feature* feature, LocationCounts& counts);
    void resolve(const PointRecord& point, Walk stuck, Place* owner, Feature* feature, TierCounts& tests);
    void ask_candidates(const PointRecord* points, Place* owner, Feature* feature, TierCounts& tests);

    /// use(candidate, exact signs of its cell) for every cell whose box holds points[which[i]].
    template <class Use>
    void for_candidates(const PointRecord* points, const std::uint32_t* which, std::size_t count, TierCounts& tests,
                        Use use) {
        constexpr std::size_t points_at_once = 16, enough = 4096;
        candidates_.clear();
        for (std::size_t i = 0; i < count; i += points_at_once) {
            find_candidates(data_.index, data_.parts.tree(), points, which + i, std::min(points_at_once, count - i),
                            candidates_);
            if (candidates_.size() < enough && i + points_at_once < count) continue;
            for (const Candidate& c : candidates_) {
                // The tree's boxes, in whole numbers, are larger than those of the cells: much larger for cells
                // that are far smaller than the domain.
                const double* const at = points[c.point].at.data();
                if (box_holds(data_.index, c.cell, at)) use(c, cell_signs(data_.index, c.cell, at, tests));
            }
            candidates_.clear();
        }
    }

    const LocatorData& data_;
    const Proof* proof_;  ///< nullptr: every candidate is asked
    const NodeRecord* nodes_;
    bool fetch_;  ///< fewer points than cells: most memory is read for the first time
    Upcoming upcoming_;
    WalkList walking_, arrived_, stuck_;
    std::array<std::uint32_t, chunk_size> asked_;  ///< points for which every candidate is asked
    std::size_t asked_count_ = 0;
    std::vector<Candidate> candidates_;
};

}  // namespace barycert::locate
