#include <tbb/parallel_sort.h>

#include <algorithm>
#include <numeric>
#include <span>
#include <tuple>

#include "barycert/base/disjoint_sets.hpp"
#include "barycert/check/stages.hpp"

namespace barycert::check {
namespace {

/// A ridge as one boundary facet has it: nodes first -> second (2D: a node, twice, at which the facet starts or ends).
struct FacetRidge {
    Mesh::Index low = 0, high = 0;
    std::uint32_t facet = 0;
    std::uint8_t at = 0;  ///< position in the facet's nodes where it starts
    bool forward = true;  ///< from the lower node to the higher (2D: the facet starts there)

    auto key() const { return std::tie(low, high); }
};

std::vector<FacetRidge> ridges_of(int d, const std::vector<BoundaryFacet>& facets) {
    std::vector<FacetRidge> ridges;
    ridges.reserve(facets.size() * static_cast<std::size_t>(d));
    for (std::size_t f = 0; f < facets.size(); ++f) {
        const auto& n = facets[f].nodes;
        const auto facet = static_cast<std::uint32_t>(f);
        if (d == 2) {
            ridges.push_back({n[0], n[0], facet, 0, true});
            ridges.push_back({n[1], n[1], facet, 1, false});
        } else {
            for (std::uint8_t i = 0; i < 3; ++i) {
                const Mesh::Index from = n[i], to = n[(i + 1U) % 3];
                ridges.push_back({std::min(from, to), std::max(from, to), facet, i, from < to});
            }
        }
    }
    tbb::parallel_sort(ridges.begin(), ridges.end(), [](const FacetRidge& a, const FacetRidge& b) {
        return std::tie(a.low, a.high, a.facet, a.at) < std::tie(b.low, b.high, b.facet, b.at);
    });
    return ridges;
}

class BoundaryChecker {
public:
    BoundaryChecker(const Mesh& mesh, const std::vector<BoundaryFacet>& facets, DefectList& defects)
        : mesh_(mesh),
          d_(mesh.dimension),
          facets_(facets),
          defects_(defects),
          piece_(facets.size()),
          fans_(facets.size() * 3) {}

    BoundaryPieces run(const ExactVolumes& volumes) {
        const std::vector<FacetRidge> ridges = ridges_of(d_, facets_);
        std::size_t distinct = 0;
        for (std::size_t i = 0; i < ridges.size(); ++distinct) {
            std::size_t next = i + 1;
            while (next < ridges.size() && ridges[next].key() == ridges[i].key()) ++next;
            at_ridge({ridges.data() + i, next - i});
            i = next;
        }
        const std::size_t fans = d_ == 3 ? find_pinched_nodes() : distinct;
        out_.summary.facets = facets_.size();
        gather_pieces(volumes);
        const bool counted = out_.summary.closed && defects_.count(DefectKind::pinched_ridge) == 0;
        if (counted) out_.summary.cavities = cavities_;
        // Vertices - edges + faces is 2 - 2 tunnels, summed over closed surfaces.
        if (d_ == 3 && counted) {
            const auto euler = static_cast<std::int64_t>(fans) - static_cast<std::int64_t>(distinct) +
                               static_cast<std::int64_t>(facets_.size());
            out_.summary.tunnels = static_cast<std::int64_t>(out_.summary.pieces) - euler / 2;
        }
        return std::move(out_);
    }

private:
    void at_ridge(std::span<const FacetRidge> same) {
        std::size_t forward = 0;
        bool oriented = true;
        for (const FacetRidge& r : same) {
            forward += r.forward ? 1 : 0;
            oriented = oriented && facets_[r.facet].oriented;
        }
        const DefectPlace place{.cells = {cell(same.front()), cell(same.back())},
                                .nodes = {same[0].low, d_ == 2 ? -1 : same[0].high, -1}};
        if (oriented ? 2 * forward != same.size() : same.size() % 2 != 0) {
            out_.summary.closed = false;
            defects_.add(DefectKind::open_boundary, place);
        }
        if (same.size() > 2) {
            out_.summary.manifold = false;
            defects_.add(DefectKind::pinched_ridge, place);
        }
        if (same.size() == 2) piece_.join(same[0].facet, same[1].facet);
        if (d_ == 3) {
            for (std::size_t i = 1; i < same.size(); ++i) join_fans(same[i - 1], same[i]);
        }
    }

    Mesh::Index cell(const FacetRidge& r) const { return facets_[r.facet].cell; }

    /// The corner of the facet, among all corners of all facets, at the lower or higher end of the ridge.
    static std::size_t corner(const FacetRidge& r, bool high) {
        const std::size_t end = r.forward == high ? 1 : 0;
        return r.facet * std::size_t{3} + (r.at + end) % 3;
    }

    /// Two facets at a ridge belong to one fan at each of its nodes.
    void join_fans(const FacetRidge& a, const FacetRidge& b) {
        fans_.join(corner(a, false), corner(b, false));
        fans_.join(corner(a, true), corner(b, true));
    }

    /// A node with more than one fan of boundary facets. Returns the number of all fans.
    std::size_t find_pinched_nodes() {
        std::vector<std::uint8_t> fans_at(mesh_.point_count(), 0);
        std::size_t count = 0;
        for (std::size_t i = 0; i < facets_.size() * 3; ++i) {
            if (fans_.find(i) != i) continue;
            ++count;
            const Mesh::Index node = facets_[i / 3].nodes[i % 3];
            std::uint8_t& fans = fans_at[static_cast<std::size_t>(node)];
            if (fans == 1) {
                out_.summary.manifold = false;
                defects_.add(DefectKind::pinched_node, {.cells = {facets_[i / 3].cell, -1}, .nodes = {node, -1, -1}});
            }
            if (fans < 2) ++fans;
        }
        return count;
    }

    /// Facets piece by piece, the volume each piece encloses, and their sum.
    void gather_pieces(const ExactVolumes& volumes) {
        std::vector<std::uint32_t> order(facets_.size());
        std::iota(order.begin(), order.end(), 0U);
        std::vector<std::uint32_t> root(facets_.size());
        for (std::size_t f = 0; f < facets_.size(); ++f) root[f] = piece_.find(f);
        std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return root[a] < root[b]; });
        for (std::size_t i = 0; i < order.size();) {
            const std::size_t begin = i;
            const std::uint32_t first = order[i];
            Integer enclosed;
            for (; i < order.size() && root[order[i]] == root[first]; ++i)
                enclosed = enclosed + cone(order[i], volumes);
            out_.facets.push_back(first);
            cavities_ += enclosed.sign() < 0 ? 1 : 0;
            if (enclosed.sign() < 0 && i - begin == mesh_.corners()) add_missing_cell(order[begin], order[begin + 1]);
            out_.enclosed = out_.enclosed + enclosed;
        }
        out_.summary.pieces = out_.facets.size();
    }

    /// As many facets as a cell has, closed: its nodes are those of one and the one of another that the first has not.
    void add_missing_cell(std::uint32_t f, std::uint32_t g) {
        const auto &nodes = facets_[f].nodes, &others = facets_[g].nodes;
        const auto fourth = std::find_if(others.begin(), others.end(), [&](Mesh::Index n) {
            return std::find(nodes.begin(), nodes.end(), n) == nodes.end();
        });
        if (fourth == others.end()) return;
        DefectPlace place{.cells = {facets_[f].cell, facets_[g].cell}, .nodes = nodes};
        (d_ == 2 ? place.nodes[2] : place.other_nodes[0]) = *fourth;
        defects_.add(DefectKind::missing_cell, place);
    }

    Integer cone(std::uint32_t facet, const ExactVolumes& volumes) const {
        const double* p[3]{};
        for (std::size_t i = 0; i < static_cast<std::size_t>(d_); ++i) p[i] = node_at(mesh_, facets_[facet].nodes[i]);
        return volumes.cone(p);
    }

    const Mesh& mesh_;
    int d_;
    const std::vector<BoundaryFacet>& facets_;
    DefectList& defects_;
    base::DisjointSets piece_;
    base::DisjointSets fans_;
    std::uint64_t cavities_ = 0;
    BoundaryPieces out_;
};

}  // namespace

BoundaryPieces check_boundary(const Mesh& mesh, const std::vector<BoundaryFacet>& facets, const ExactVolumes& volumes,
                              DefectList& defects) {
    return BoundaryChecker(mesh, facets, defects).run(volumes);
}

}  // namespace barycert::check
