#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "barycert/check_results.hpp"
#include "barycert/defect.hpp"
#include "barycert/mesh.hpp"
#include "core/base/disjoint_sets.hpp"
#include "core/base/lists.hpp"
#include "mesh/check/stages.hpp"
#include "mesh/index/ridges.hpp"

namespace barycert::check {
namespace {

class BoundaryChecker {
public:
    explicit BoundaryChecker(Checked& c)
        : c_(c), d_(c.mesh.dimension), facets_(c.boundary), piece_(facets_.size()), fans_(facets_.size() * 3) {}

    std::vector<std::uint32_t> run() {
        std::size_t distinct = 0;
        for_each_ridge(ridges_of(d_, facets_), [&](std::span<const Ridge> same) {
            at_ridge(same);
            ++distinct;
        });
        const std::size_t fans = d_ == 3 ? find_pinched_nodes() : distinct;
        summary_.facets = facets_.size();
        std::vector<std::uint32_t> pieces = gather_pieces();
        summary_.pieces = pieces.size();
        const bool counted = summary_.closed && c_.defects[DefectKind::pinched_ridge].count == 0;
        if (counted) summary_.cavities = cavities_;
        // Vertices - edges + faces is 2 - 2 tunnels, summed over closed surfaces.
        if (d_ == 3 && counted) {
            const auto euler = static_cast<std::int64_t>(fans) - static_cast<std::int64_t>(distinct) +
                               static_cast<std::int64_t>(facets_.size());
            summary_.tunnels = static_cast<std::int64_t>(pieces.size()) - euler / 2;
        }
        return pieces;
    }

private:
    void at_ridge(std::span<const Ridge> same) {
        std::size_t forward = 0;
        bool oriented = true;
        for (const Ridge& r : same) {
            forward += is_forward(r) ? 1 : 0;
            oriented = oriented && facets_[r.facet].oriented;
        }
        // In 2D the only node, in 3D the higher one, are the lower half of the number.
        const auto low = static_cast<Mesh::Index>(same[0].nodes >> 32), high = static_cast<Mesh::Index>(same[0].nodes);
        const DefectPlace place{.cells = {facets_[same.front().facet].cell, facets_[same.back().facet].cell},
                                .nodes = {d_ == 2 ? high : low, d_ == 2 ? -1 : high, -1}};
        if (oriented ? 2 * forward != same.size() : same.size() % 2 != 0) {
            summary_.closed = false;
            c_.defects.add(DefectKind::open_boundary, place);
        }
        if (same.size() > 2) {
            summary_.manifold = false;
            c_.defects.add(DefectKind::pinched_ridge, place);
        }
        if (same.size() == 2) piece_.join(same[0].facet, same[1].facet);
        // Two facets at a ridge belong to one fan at each of its nodes.
        for (std::size_t i = 1; d_ == 3 && i < same.size(); ++i) {
            for (const bool high_end : {false, true})
                fans_.join(corner(same[i - 1], high_end), corner(same[i], high_end));
        }
    }

    /// The facet has it from the lower node to the higher (2D: starts there: the node that it lacks is the end, 1).
    bool is_forward(const Ridge& r) const {
        const auto& nodes = facets_[r.facet].nodes;
        return d_ == 2 ? r.other == 1 : nodes[(r.other + 1) % 3] < nodes[(r.other + 2) % 3];
    }

    /// The corner of the facet, among all corners of all facets, at the lower or higher end of the ridge.
    std::size_t corner(const Ridge& r, bool high) const {
        return r.facet * std::size_t{3} + (r.other + (is_forward(r) == high ? 2 : 1)) % 3;
    }

    /// A node with more than one fan of boundary facets. Returns the number of all fans.
    std::size_t find_pinched_nodes() {
        std::vector<std::uint8_t> fans_at(c_.mesh.point_count(), 0);
        std::size_t count = 0;
        for (std::size_t i = 0; i < facets_.size() * 3; ++i) {
            if (fans_.find(i) != i) continue;
            ++count;
            const Mesh::Index node = facets_[i / 3].nodes[i % 3];
            std::uint8_t& fans = fans_at[static_cast<std::size_t>(node)];
            if (fans == 1) {
                summary_.manifold = false;
                c_.defects.add(DefectKind::pinched_node, {.cells = {facets_[i / 3].cell, -1}, .nodes = {node, -1, -1}});
            }
            if (fans < 2) ++fans;
        }
        return count;
    }

    /// A facet of each piece; the volume each encloses, and their sum.
    std::vector<std::uint32_t> gather_pieces() {
        const base::Lists<std::uint32_t> by_lowest(facets_.size(), [&](const auto& add) {
            for (std::uint32_t f = 0; f < facets_.size(); ++f) add(piece_.find(f), f);
        });
        std::vector<std::uint32_t> pieces;
        Integer all;
        for (std::size_t lowest = 0; lowest < by_lowest.size(); ++lowest) {
            const std::span piece = by_lowest[lowest];
            if (piece.empty()) continue;
            Integer enclosed;
            for (const std::uint32_t f : piece)
                enclosed = enclosed + c_.volumes.cone(placed(c_.mesh, facets_[f]).at.data());
            pieces.push_back(piece[0]);
            cavities_ += enclosed.sign() < 0 ? 1 : 0;
            if (enclosed.sign() < 0 && piece.size() == c_.mesh.corners()) add_missing_cell(piece[0], piece[1]);
            all = all + enclosed;
        }
        c_.report.volume = {c_.volumes.rounded(c_.total), c_.volumes.rounded(all), (c_.total - all).sign() == 0};
        return pieces;
    }

    /// As many facets as a cell has, closed: its nodes are those of one and the one of another that the first has not.
    void add_missing_cell(std::uint32_t f, std::uint32_t g) {
        const auto &nodes = facets_[f].nodes, &others = facets_[g].nodes;
        const auto fourth =
            std::ranges::find_if(others, [&](Mesh::Index n) { return std::ranges::find(nodes, n) == nodes.end(); });
        if (fourth == others.end()) return;
        DefectPlace place{.cells = {facets_[f].cell, facets_[g].cell}, .nodes = nodes};
        (d_ == 2 ? place.nodes[2] : place.other_nodes[0]) = *fourth;
        c_.defects.add(DefectKind::missing_cell, place);
    }

    Checked& c_;
    int d_;
    const std::vector<BoundaryFacet>& facets_;
    BoundaryReport& summary_ = c_.report.boundary;
    base::DisjointSets piece_;
    base::DisjointSets fans_;
    std::uint64_t cavities_ = 0;
};

}  // namespace

std::vector<std::uint32_t> check_boundary(Checked& c) {
    return BoundaryChecker(c).run();
}

}  // namespace barycert::check
