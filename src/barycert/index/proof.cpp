#include "barycert/index/proof.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <bit>
#include <cstddef>

#include "barycert/base/disjoint_sets.hpp"
#include "barycert/index/crossing.hpp"
#include "barycert/index/open_sheets.hpp"
#include "barycert/index/overlap.hpp"

namespace barycert::index {
namespace {

class Prover {
public:
    Prover(const CellIndex& index, const FacetLinks& links, const std::function<const CellTree&()>& tree)
        : index_(index), links_(links), tree_(tree), facets_(links.open.size()) {
        tbb::parallel_for(std::size_t{0}, facets_.size(),
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

    Corners corners(Place cell) const {
        Corners at{};
        for (std::size_t i = 0; i < index_.corners(); ++i)
            at[i] =
                index_.nodes[static_cast<std::size_t>(index_.cells[static_cast<std::size_t>(cell)].node[i])].at.data();
        return at;
    }
    bool degenerate(Place cell) const {
        return std::binary_search(links_.degenerate.begin(), links_.degenerate.end(), cell);
    }

    /// The interior of another cell that is not degenerate meets that of `cell`.
    bool overlapped(Place cell) const {
        const Corners at = corners(cell);
        bool found = false;
        tree_().for_each_meeting(box_of(index_, at.data(), index_.corners()), [&](std::size_t i) {
            const auto other = static_cast<Place>(i);
            if (other != cell && !degenerate(other)) found = interiors_meet(d(), at, corners(other));
            return !found;
        });
        return found;
    }

    /// Is m certainly 1 on the inner side of the sheet? A few of its cells are asked: others may cross some of them.
    bool good(const std::vector<std::uint32_t>& sheet) const {
        constexpr std::size_t tries = 8;
        const std::size_t step = (sheet.size() + tries - 1) / tries;
        for (std::size_t i = 0; i < sheet.size(); i += step) {
            if (!overlapped(links_.open[sheet[i]].cell)) return true;
        }
        return false;
    }

    std::vector<PlacedFacet> bad_facets() const {
        std::vector<std::uint8_t> bad = find_conflicts(index_, facets_);
        const std::vector<std::vector<std::uint32_t>> sheets = find_sheets(d(), facets_, bad);
        const bool one = sheets.size() == 1 && sheets.front().size() == facets_.size();
        if (!one) {
            tbb::parallel_for(std::size_t{0}, sheets.size(), [&](std::size_t s) {
                if (good(sheets[s])) return;
                for (const std::uint32_t f : sheets[s]) bad[f] = 1;
            });
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
        const CellTree& tree = tree_();
        tbb::parallel_for(std::size_t{0}, bad.size(), [&](std::size_t f) {
            tree.for_each_meeting(box_of(index_, bad[f].at.data(), index_.dimension()), [&](std::size_t cell) {
                const auto place = static_cast<Place>(cell);
                if (!contested(place) && may_cross(index_, place, bad[f])) contest(place);
                return true;
            });
        });
        for (const Place cell : links_.degenerate) contest(cell);
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
        std::vector<Place> roots;
        for (std::size_t c = 0; c < index_.cell_count(); ++c) {
            if (contested(static_cast<Place>(c))) continue;
            const std::uint32_t root = sets.find(c);
            if (root == c) roots.push_back(static_cast<Place>(c));
            ++size[root];
        }
        std::vector<std::uint8_t> bad(roots.size());
        tbb::parallel_for(std::size_t{0}, roots.size(), [&](std::size_t r) {
            bad[r] = size[static_cast<std::size_t>(roots[r])] < smallest || overlapped(roots[r]) ? 1 : 0;
        });
        for (std::size_t r = 0; r < roots.size(); ++r) size[static_cast<std::size_t>(roots[r])] = bad[r];
        for (std::size_t c = 0; c < index_.cell_count(); ++c) {
            if (!contested(static_cast<Place>(c)) && size[sets.find(c)] != 0) contest(static_cast<Place>(c));
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
