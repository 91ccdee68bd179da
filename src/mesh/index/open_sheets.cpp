#include "mesh/index/open_sheets.hpp"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "barycert/predicates.hpp"
#include "core/base/disjoint_sets.hpp"
#include "mesh/index/candidates.hpp"
#include "mesh/index/cell_index.hpp"
#include "mesh/index/cell_tree.hpp"
#include "mesh/index/facet_contact.hpp"
#include "mesh/index/facet_links.hpp"
#include "mesh/index/ridges.hpp"

namespace barycert::index {
namespace {

/// Joins facets that come one after the other around a ridge, if the cells of both lie between them, or neither does.
/// They are all the open facets that have the ridge, without conflicts.
void join_around(const CellIndex& index, const std::vector<CellFacet>& open, std::span<const Ridge> ridges,
                 RidgeTurn& turn, base::DisjointSets& sets) {
    if (ridges.size() == 2) return sets.join(ridges[0].facet, ridges[1].facet);
    const auto cell_follows = [&](const Ridge& ridge) {  // it comes next in the turn
        const auto& [cell, corner] = open[ridge.facet];
        const Place apex = index.cells[cell].node[static_cast<std::size_t>(corner)];
        return turn.to(ridge, index.nodes[apex].at.data()) == Sign::positive;
    };
    const std::span<const Ridge> ring = turn.sorted(ridges);
    const Ridge* before = &ring.back();
    bool follows_before = cell_follows(*before);
    for (const Ridge& ridge : ring) {
        const bool follows = cell_follows(ridge);
        if (follows != follows_before) sets.join(before->facet, ridge.facet);
        before = &ridge;
        follows_before = follows;
    }
}

/// Pairs of facets whose boxes meet and that no plane is known to separate.
class Suspects {
public:
    Suspects(const CellIndex& index, const std::vector<PlacedFacet>& facets)
        : facets_(facets), d_(static_cast<int>(index.dimension())) {
        const auto nodes_of = [&](std::size_t f) { return std::span(facets[f].nodes).first(index.dimension()); };
        if (!is_crowded(index.original_node.size(), facets.size(), nodes_of)) {
            // Facets are in the order of their cells, which is that of space.
            boxes_.emplace(facets.size(),
                           [&](std::size_t f) { return box_of(index, facets[f].at.data(), index.dimension()); });
            return;
        }
        items_.resize(facets.size());
        for (std::size_t i = 0; i < facets.size(); ++i) items_[i] = item_of(facets[i], d_);
        candidates_.emplace(d_, items_);
    }

    /// Parts of the work.
    std::size_t count() const { return (facets_.size() + 7) / 8; }

    /// use(part - first, i, j), i < j, for each pair of the parts, on all threads of the arena; each part on one.
    template <class Use>
    void for_each(std::size_t first, std::size_t last, Use use) const {
        base::parallel_for(last - first, [&](std::size_t part) {
            boxes_ ? of_boxes(first + part, [&](std::size_t i, std::size_t j) { use(part, i, j); })
                   : of_items(first + part, [&](std::size_t i, std::size_t j) { use(part, i, j); });
        });
    }

private:
    template <class Use>
    void of_boxes(std::size_t g, Use use) const {
        boxes_->for_pairs(g, [&](std::span<FacetPair> pairs) {
            if (d_ == 3) pairs = without_separated(facets_, pairs);
            for (const FacetPair& pair : pairs) use(pair.first, pair.second);
        });
    }
    template <class Use>
    void of_items(std::size_t g, Use use) const {
        for (std::size_t i = 8 * g; i < std::min(8 * g + 8, facets_.size()); ++i) {
            candidates_->for_each(items_[i], [&](std::uint32_t j) {
                if (j > i) use(i, j);
                return true;
            });
        }
    }

    const std::vector<PlacedFacet>& facets_;
    int d_;
    std::optional<BoxGroups> boxes_;
    std::vector<Item> items_;  ///< where a node has so many facets that boxes would name all pairs of them
    std::optional<Candidates> candidates_;
};

}  // namespace

std::span<const Ridge> RidgeTurn::sorted(std::span<const Ridge> ridges) {
    if (ridges.size() < 3) return ridges;  // either order is one
    sorted_.assign(ridges.begin(), ridges.end());
    const auto first = sorted_.begin() + 1, last = sorted_.end();
    const auto side = [&](const Ridge& from, const Ridge& r) { return to(from, facets_[r.facet].at[r.other]); };
    // Below half a turn from the first one, at half a turn, beyond it.
    const auto half = std::partition(first, last, [&](const Ridge& r) { return side(ridges[0], r) == Sign::positive; });
    const auto beyond = std::partition(half, last, [&](const Ridge& r) { return side(ridges[0], r) == Sign::zero; });
    const auto before = [&](const Ridge& a, const Ridge& b) { return side(a, b) == Sign::positive; };
    std::sort(first, half, before);
    std::sort(beyond, last, before);
    return sorted_;
}

Sign RidgeTurn::to(const Ridge& from, const double* p) const {
    const auto& at = facets_[from.facet].at;
    if (d_ == 2) return orient2d(at[1 - from.other], at[from.other], p);
    return orient3d(at[from.other == 0 ? 1 : 0], at[from.other == 2 ? 1 : 2], at[from.other], p);
}

Item item_of(const PlacedFacet& facet, int d) {
    const auto& [nodes, at] = facet;
    return {d, {nodes[0], nodes[1], nodes[2], -1}, {at[0], at[1], at[2], nullptr}};
}

PlacedFacet placed(const CellIndex& index, const CellFacet& facet) {
    const auto& node = index.cells[facet.cell].node;
    PlacedFacet placed;
    std::size_t count = 0;
    for (std::size_t i = 0; i < index.corners(); ++i) {
        if (i != static_cast<std::size_t>(facet.corner)) placed.nodes[count++] = node[i];
    }
    std::sort(placed.nodes.begin(), placed.nodes.begin() + static_cast<std::ptrdiff_t>(count));
    for (std::size_t i = 0; i < count; ++i) placed.at[i] = index.nodes[placed.nodes[i]].at.data();
    return placed;
}

std::vector<std::uint8_t> find_conflicts(const CellIndex& index, const std::vector<PlacedFacet>& facets) {
    const auto d = static_cast<int>(index.dimension());
    std::vector<std::uint8_t> flags(facets.size(), 0);  // raised by any thread
    const auto flag = [&](std::size_t i) { return std::atomic_ref(flags[i]); };
    const Suspects suspects(index, facets);
    suspects.for_each(0, suspects.count(), [&](std::size_t, std::size_t i, std::size_t j) {
        constexpr auto relaxed = std::memory_order_relaxed;
        if (flag(i).load(relaxed) != 0 && flag(j).load(relaxed) != 0) return;
        if (facets[i].nodes != facets[j].nodes && !facets_conflict(d, facets[i], facets[j])) return;
        flag(i).store(1, relaxed);
        flag(j).store(1, relaxed);
    });
    return flags;
}

std::vector<FacetPair> conflicting_pairs(const CellIndex& index, const std::vector<PlacedFacet>& facets,
                                         std::size_t limit) {
    const auto d = static_cast<int>(index.dimension());
    const Suspects suspects(index, facets);
    std::vector<FacetPair> all;
    constexpr std::size_t wave = 4096;
    for (std::size_t first = 0; first < suspects.count() && all.size() <= limit; first += wave) {
        std::vector<std::vector<FacetPair>> found(std::min(wave, suspects.count() - first));
        suspects.for_each(first, first + found.size(), [&](std::size_t part, std::size_t i, std::size_t j) {
            // A part that has far more than anybody wants need not be searched to its end.
            if (found[part].size() > limit) return;
            if (facets[i].nodes == facets[j].nodes || facets_conflict(d, facets[i], facets[j]))
                found[part].push_back({static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j)});
        });
        for (auto& part : found) {
            std::ranges::sort(part, {}, [](const FacetPair& p) { return std::pair(p.first, p.second); });
            all.insert(all.end(), part.begin(), part.end());
        }
    }
    return all;
}

std::vector<std::vector<std::uint32_t>> find_sheets(const CellIndex& index, const std::vector<CellFacet>& open,
                                                    const std::vector<PlacedFacet>& facets,
                                                    const std::vector<std::uint8_t>& conflict) {
    base::DisjointSets sets(facets.size());
    const auto d = static_cast<int>(index.dimension());
    RidgeTurn turn(d, facets);
    for_each_ridge(ridges_of(d, facets), [&](std::span<const Ridge> same) {
        if (same.size() > 1 && std::ranges::all_of(same, [&](const Ridge& r) { return conflict[r.facet] == 0; }))
            join_around(index, open, same, turn, sets);
    });
    std::vector<std::vector<std::uint32_t>> sheets;
    std::vector<std::uint32_t> sheet_of(facets.size());
    for (std::size_t f = 0; f < facets.size(); ++f) {
        if (conflict[f] != 0) continue;
        const std::uint32_t root = sets.find(f);  // the lowest of its set, so it came by before
        if (root == f) {
            sheet_of[f] = static_cast<std::uint32_t>(sheets.size());
            sheets.emplace_back();
        }
        sheets[sheet_of[root]].push_back(static_cast<std::uint32_t>(f));
    }
    return sheets;
}

}  // namespace barycert::index
