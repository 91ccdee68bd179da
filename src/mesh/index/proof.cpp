#include "mesh/index/proof.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "barycert/mesh.hpp"
#include "barycert/predicates.hpp"
#include "core/base/disjoint_sets.hpp"
#include "mesh/index/candidates.hpp"
#include "mesh/index/cell_index.hpp"
#include "mesh/index/cell_tree.hpp"
#include "mesh/index/facet_contact.hpp"
#include "mesh/index/facet_links.hpp"
#include "mesh/index/open_sheets.hpp"
#include "mesh/index/overlap.hpp"
#include "mesh/threads/arena.hpp"

namespace barycert::index {
namespace {

struct Corner {
    const double* at;
    bool common;  ///< a vertex of both
};

/// The vertices of a facet of the cell, or of the facet itself.
struct Plane {
    int d;
    std::array<const double*, 3> at;

    Sign side(const double* p) const { return d == 2 ? orient2d(at[0], at[1], p) : orient3d(at[0], at[1], at[2], p); }
};

/// All that are not common lie strictly on the given side.
bool all_on_side(const Plane& plane, std::span<const Corner> corners, Sign side) {
    return std::ranges::all_of(corners, [&](const Corner& c) { return c.common || plane.side(c.at) == side; });
}

/// False if the facet certainly meets the cell in a common face (of the same nodes) or not at all, and is not a linked
/// facet of the cell. May be true where that is so. Requires: the facet is not degenerate; its nodes are places.
///
/// A plane through all common vertices that has the other vertices of one of both strictly on one side, and the other
/// one on the other side or on it, meets the first in the common face alone. Planes of facets are tried.
bool may_cross(const CellIndex& index, Place cell, const PlacedFacet& facet) {
    const auto d = static_cast<int>(index.dimension());
    const auto n = static_cast<std::size_t>(d);
    const CellRecord& record = index.cells[cell];
    std::array<Corner, 4> of_cell{};
    std::array<Corner, 3> of_facet{};
    for (std::size_t j = 0; j < n; ++j) of_facet[j] = {facet.at[j], false};
    std::size_t common = 0, apex = 0;
    for (std::size_t i = 0; i <= n; ++i) {
        of_cell[i] = {index.nodes[record.node[i]].at.data(), false};
        for (std::size_t j = 0; j < n; ++j) {
            if (record.node[i] == facet.nodes[j]) of_cell[i].common = of_facet[j].common = true;
        }
        common += of_cell[i].common ? 1 : 0;
        if (!of_cell[i].common) apex = i;
    }
    if (common == n) return record.next[apex] >= 0;
    const std::span<const Corner> cell_corners(of_cell.data(), n + 1), facet_corners(of_facet.data(), n);
    const Plane of_all{d, facet.at};
    const Sign apex_side = of_all.side(of_cell[apex].at);
    if (apex_side != Sign::zero && all_on_side(of_all, cell_corners, apex_side)) return false;
    for (std::size_t i = 0; i <= n; ++i) {
        if (of_cell[i].common) continue;  // the plane of the facet opposite to it would miss it
        Plane plane{d, {}};
        for (std::size_t j = 0, k = 0; j <= n; ++j) {
            if (j != i) plane.at[k++] = of_cell[j].at;
        }
        const Sign inner = plane.side(of_cell[i].at);
        if (inner == Sign::zero) return true;  // degenerate
        if (all_on_side(plane, facet_corners, -inner)) return false;
    }
    return true;
}

class Prover {
public:
    Prover(const CellIndex& index, const FacetLinks& links, const std::function<const CellTree&()>& tree)
        : index_(index), links_(links), tree_(tree), facets_(links.open.size()) {
        base::parallel_for_each(facets_.size(), 1024,
                                [&](std::size_t f) { facets_[f] = placed(index_, links_.open[f]); });
    }

    bool is_partition() const { return links_.degenerate.empty() && bad_facets().empty(); }

    Proof run() {
        Proof proof;
        const std::vector<PlacedFacet> bad = bad_facets();
        proof.partition = bad.empty() && links_.degenerate.empty();
        if (bad.empty()) return proof;
        contested_.assign((index_.cell_count() + 63) / 64, 0);
        mark_crossed(bad);
        mark_overlapped();
        for (const std::uint64_t bits : contested_)
            proof.contested_count += static_cast<std::uint64_t>(std::popcount(bits));
        proof.contested = std::move(contested_);
        return proof;
    }

private:
    int d() const { return static_cast<int>(index_.dimension()); }

    /// All open facets that do not conflict and whose sheet is good are good. A few cells of each sheet are asked:
    /// others may cross some of them.
    std::vector<PlacedFacet> bad_facets() const {
        std::vector<std::uint8_t> bad = find_conflicts(index_, facets_);
        std::vector<std::vector<std::uint32_t>> sheets = find_sheets(index_, links_.open, facets_, bad);
        if (sheets.size() == 1 && sheets.front().size() == facets_.size()) return {};
        constexpr std::size_t tries = 4;
        for (std::size_t n = 0; n < tries && !sheets.empty(); ++n) {
            std::vector<Place> asked(sheets.size());
            for (std::size_t s = 0; s < sheets.size(); ++s)
                asked[s] = links_.open[sheets[s][n * sheets[s].size() / tries]].cell;
            const std::vector<std::uint8_t> overlapped = find_overlapped(index_, asked, links_.degenerate, tree_);
            std::size_t left = 0;
            for (std::size_t s = 0; s < sheets.size(); ++s) {
                if (overlapped[s] != 0) sheets[left++].swap(sheets[s]);
            }
            sheets.resize(left);
        }
        for (const std::vector<std::uint32_t>& sheet : sheets) {
            for (const std::uint32_t f : sheet) bad[f] = 1;
        }
        std::vector<PlacedFacet> out;
        for (std::size_t f = 0; f < facets_.size(); ++f) {
            if (bad[f] != 0) out.push_back(facets_[f]);
        }
        return out;
    }

    bool contested(Place cell) {
        const auto i = static_cast<std::size_t>(cell);
        return (std::atomic_ref(contested_[i / 64]).load(std::memory_order_relaxed) >> (i % 64) & 1) != 0;
    }
    void contest(Place cell) {
        const auto i = static_cast<std::size_t>(cell);
        std::atomic_ref(contested_[i / 64]).fetch_or(std::uint64_t{1} << (i % 64), std::memory_order_relaxed);
    }

    void mark_crossed(const std::vector<PlacedFacet>& bad) {
        for (const Place cell : links_.degenerate) contest(cell);
        std::vector<Item> items(bad.size());
        for (std::size_t f = 0; f < bad.size(); ++f) items[f] = item_of(bad[f], d());
        const bool by_tree = for_each_near_cell(index_, items, SIZE_MAX, tree_, [&](std::size_t f, Place cell) {
            if (!contested(cell) && may_cross(index_, cell, bad[f])) contest(cell);
            return contested(cell) ? Decided::cell : Decided::nothing;
        });
        if (by_tree) return;
        // A facet of a cell's own nodes meets it in a common face, so it was no candidate.
        std::vector<std::array<Mesh::Index, 3>> nodes(bad.size());
        for (std::size_t f = 0; f < bad.size(); ++f) nodes[f] = bad[f].nodes;
        std::sort(nodes.begin(), nodes.end());
        base::parallel_for_each(index_.cell_count(), 1 << 10, [&](std::size_t c) {
            const auto cell = static_cast<Place>(c);
            for (std::size_t i = 0; i < index_.corners(); ++i) {
                if (index_.cells[c].next[i] < 0) continue;
                const auto own = placed(index_, {cell, static_cast<std::int32_t>(i)}).nodes;
                if (std::binary_search(nodes.begin(), nodes.end(), own)) contest(cell);
            }
        });
    }

    /// Sets of linked cells that are not crossed, of which one is overlapped, or which are too small to be asked for.
    void mark_overlapped() {
        constexpr std::uint32_t smallest = 8;
        base::DisjointSets sets(index_.cell_count());
        for (std::size_t c = 0; c < index_.cell_count(); ++c) {
            if (contested(static_cast<Place>(c))) continue;
            for (const Place next : index_.cells[c].next) {
                if (next > static_cast<Place>(c) && !contested(next)) sets.join(c, static_cast<std::size_t>(next));
            }
        }
        std::vector<std::uint32_t> size(index_.cell_count(), 0);
        std::vector<Place> asked;  // the first cell of each
        for (std::size_t c = 0; c < index_.cell_count(); ++c) {
            if (contested(static_cast<Place>(c))) continue;
            const std::uint32_t root = sets.find(c);
            if (root == c) asked.push_back(static_cast<Place>(c));
            ++size[root];
        }
        std::erase_if(asked, [&](Place root) { return size[static_cast<std::size_t>(root)] < smallest; });
        const std::vector<std::uint8_t> overlapped = find_overlapped(index_, asked, links_.degenerate, tree_);
        std::vector<std::uint8_t> good(index_.cell_count(), 0);  // of roots
        for (std::size_t i = 0; i < asked.size(); ++i) good[static_cast<std::size_t>(asked[i])] = 1 - overlapped[i];
        for (std::size_t c = 0; c < index_.cell_count(); ++c) {
            if (!contested(static_cast<Place>(c)) && good[sets.find(c)] == 0) contest(static_cast<Place>(c));
        }
    }

    const CellIndex& index_;
    const FacetLinks& links_;
    const std::function<const CellTree&()>& tree_;
    std::vector<PlacedFacet> facets_;
    std::vector<std::uint64_t> contested_;
};

}  // namespace

Proof prove(const CellIndex& index, const FacetLinks& links, const std::function<const CellTree&()>& tree) {
    return Prover(index, links, tree).run();
}

bool is_partition(const CellIndex& index, const FacetLinks& links, const std::function<const CellTree&()>& tree) {
    return Prover(index, links, tree).is_partition();
}

}  // namespace barycert::index
