#include "mesh/locate/contested_cells.hpp"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "barycert/predicates.hpp"
#include "barycert/simplex.hpp"
#include "mesh/index/cell_index.hpp"
#include "mesh/index/cell_tree.hpp"
#include "mesh/index/facet_contact.hpp"
#include "mesh/index/overlap.hpp"
#include "mesh/index/proof.hpp"
#include "mesh/locate/cell_signs.hpp"
#include "mesh/locate/lanes.hpp"
#include "mesh/threads/arena.hpp"

namespace barycert::locate {
namespace {

std::vector<Place> list_of(const CellIndex& index, const Proof& proof, std::span<const Place> degenerate) {
    std::vector<Place> cells;
    cells.reserve(proof.contested_count);
    for (std::size_t c = 0; c < index.cell_count(); ++c) {
        const auto place = static_cast<Place>(c);
        if (proof.is_contested(place) && !std::binary_search(degenerate.begin(), degenerate.end(), place))
            cells.push_back(place);
    }
    return cells;
}

}  // namespace

ContestedCells::ContestedCells(const CellIndex& index, const Proof& proof, std::span<const Place> degenerate)
    : index_(index),
      cells_(list_of(index, proof, degenerate)),
      tree_(cells_.size(), [&](std::size_t i) { return box_of(index, cells_[i]); }) {}

ContestedCells::Lists ContestedCells::make_lists() const {
    const std::size_t most = 64 * cells_.size();  // pairs whose boxes meet
    const std::size_t groups = (cells_.size() + 7) / 8;
    using Pair = std::pair<std::uint32_t, Place>;  // which cell, and a lower one
    std::vector<std::vector<Pair>> found(groups);
    std::atomic<std::size_t> count = 0;
    base::parallel_for(groups, [&](std::size_t g) {
        if (count.load(std::memory_order_relaxed) > most) return;
        std::size_t pairs = 0;
        tree_.for_pairs(g, [&](std::span<index::FacetPair> some) {
            pairs += some.size();
            for (auto [i, j] : some) {
                if (index_.original[cells_[i]] < index_.original[cells_[j]]) std::swap(i, j);
                if (may_overlap(static_cast<int>(index_.dimension()), index_.corner_points(cells_[i]),
                                index_.corner_points(cells_[j])))
                    found[g].push_back({i, cells_[j]});
            }
        });
        count.fetch_add(pairs, std::memory_order_relaxed);
    });
    if (count.load() > most) return {};
    return Lists(cells_.size(), [&](const auto& add) {
        for (const auto& pairs : found) {
            for (const auto& [cell, lower] : pairs) add(cell, lower);
        }
    });
}

void ContestedCells::find_owners(const PointRecord* points, const std::uint32_t* which, std::size_t count, Place* owner,
                                 Feature* feature, TierCounts& tests) const {
    const auto ask = [&](std::uint32_t i, Place cell) {
        const double* const point = points[i].at.data();
        if (index_.original[cell] >= index_.original[owner[i]] || !box_holds(index_, cell, point)) return;
        const WeightSigns signs = cell_signs(index_, cell, point, tests);
        if (!signs.contains()) return;
        owner[i] = cell;
        feature[i] = feature_of(index_, cell, signs);
    };
    const Lists* const lists = lists_.made();
    if (lists != nullptr && lists->size() != 0) {
        for (std::size_t i = 0; i < count; ++i) {
            const auto found = std::lower_bound(cells_.begin(), cells_.end(), owner[which[i]]);
            const auto at = static_cast<std::size_t>(found - cells_.begin());
            for (const Place lower : (*lists)[at]) ask(which[i], lower);
        }
        return;
    }
    constexpr std::size_t points_at_once = 16;
    std::vector<Candidate> candidates;
    for (std::size_t at = 0; at < count; at += points_at_once) {
        candidates.clear();
        find_candidates(index_, tree_, points, which + at, std::min(points_at_once, count - at), candidates);
        for (const Candidate& c : candidates) ask(c.point, cells_[static_cast<std::size_t>(c.cell)]);
    }
}

}  // namespace barycert::locate
