#include "barycert/check/facets.hpp"

#include <algorithm>
#include <atomic>
#include <span>
#include <utility>

#include "barycert/base/large_pages.hpp"
#include "barycert/mesh/facets.hpp"

namespace barycert::check {
namespace {

using mesh::CellFacet;

/// +1 if the nodes are an even permutation of the ascending ones, else -1.
int parity(int d, const std::array<Mesh::Index, 3>& n) {
    int inversions = n[0] > n[1] ? 1 : 0;
    if (d == 3) inversions += (n[0] > n[2] ? 1 : 0) + (n[1] > n[2] ? 1 : 0);
    return inversions % 2 == 0 ? 1 : -1;
}

struct Part {
    DefectList defects;
    std::vector<BoundaryFacet> boundary;
};

class FacetChecker {
public:
    FacetChecker(const Mesh& mesh, CellMeasures& measures, std::vector<Mesh::Index>& neighbours)
        : mesh_(mesh), m_(measures), neighbours_(neighbours) {}

    void operator()(std::span<const mesh::CellFacet> equal, Part& part) const {
        if (equal.size() == 1) {
            const mesh::CellFacet& f = equal.front();
            part.boundary.push_back({f.cell, f.corner, outward(f), m_.orientation[index(f)] != 0});
            return;
        }
        mesh::pair_facets(equal, mesh_.corners(), neighbours_);
        if (equal.size() > 2 || apex(equal[0]) == apex(equal[1])) find_duplicates(equal, part);
        if (equal.size() > 2) {
            DefectPlace place{.cells = {equal[0].cell, equal[1].cell}, .nodes = outward(equal[0])};
            for (const mesh::CellFacet& f : equal) mark(f, DefectKind::overfull_facet);
            part.defects.add(DefectKind::overfull_facet, place);
        } else if (side(equal[0]) * side(equal[1]) > 0) {
            for (const mesh::CellFacet& f : equal) mark(f, DefectKind::same_side);
            part.defects.add(DefectKind::same_side,
                             {.cells = {equal[0].cell, equal[1].cell}, .nodes = outward(equal[0])});
        }
    }

private:
    std::size_t index(const mesh::CellFacet& f) const { return static_cast<std::size_t>(f.cell); }

    std::array<Mesh::Index, 3> outward(const mesh::CellFacet& f) const {
        return outward_nodes(mesh_, index(f), static_cast<std::size_t>(f.corner), m_.orientation[index(f)]);
    }

    /// On which side of the facet, taken with its nodes ascending, the cell lies: -1 or 1; 0 if it is degenerate.
    int side(const mesh::CellFacet& f) const {
        return m_.orientation[index(f)] == 0 ? 0 : parity(mesh_.dimension, outward(f));
    }

    Mesh::Index apex(const mesh::CellFacet& f) const {
        return mesh_.cells[index(f) * mesh_.corners() + static_cast<std::size_t>(f.corner)];
    }

    /// Two cells with a common facet and apex are the same. They share every facet: it is told at the one opposite to
    /// their highest node.
    void find_duplicates(std::span<const mesh::CellFacet> equal, Part& part) const {
        std::vector<mesh::CellFacet> by_apex(equal.begin(), equal.end());
        std::sort(by_apex.begin(), by_apex.end(), [&](const mesh::CellFacet& a, const mesh::CellFacet& b) {
            return std::pair(apex(a), a.cell) < std::pair(apex(b), b.cell);
        });
        for (std::size_t i = 1, first = 0; i < by_apex.size(); ++i) {
            const mesh::CellFacet &original = by_apex[first], &copy = by_apex[i];
            if (apex(copy) != apex(original)) {
                first = i;
            } else if (apex(copy) > copy.highest) {
                part.defects.add(DefectKind::duplicate_cell, {.cells = {original.cell, copy.cell}});
                mark(original, DefectKind::duplicate_cell);
                mark(copy, DefectKind::duplicate_cell);
            }
        }
    }

    /// Blocks of facets share cells: bits are set one thread at a time.
    void mark(const mesh::CellFacet& f, DefectKind p) const {
        std::atomic_ref(m_.defects[index(f)]).fetch_or(defect_bit(p), std::memory_order_relaxed);
    }

    const Mesh& mesh_;
    CellMeasures& m_;
    std::vector<Mesh::Index>& neighbours_;
};

}  // namespace

std::array<Mesh::Index, 3> outward_nodes(const Mesh& mesh, std::size_t cell, std::size_t corner, int orientation) {
    // Seen from outside a positive cell these turn counter-clockwise.
    static constexpr std::array<std::array<std::size_t, 3>, 4> faces{{{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};
    static constexpr std::array<std::array<std::size_t, 2>, 3> edges{{{1, 2}, {2, 0}, {0, 1}}};
    const Mesh::Index* const nodes = &mesh.cells[cell * mesh.corners()];
    std::array<Mesh::Index, 3> out{-1, -1, -1};
    if (mesh.dimension == 2) {
        for (std::size_t i = 0; i < 2; ++i) out[i] = nodes[edges[corner][i]];
    } else {
        for (std::size_t i = 0; i < 3; ++i) out[i] = nodes[faces[corner][i]];
    }
    if (orientation < 0) std::swap(out[0], out[1]);
    return out;
}

Facets check_facets(const Mesh& mesh, const std::vector<std::uint8_t>& usable, CellMeasures& measures,
                    DefectList& defects) {
    Facets facets;
    base::resize_large(facets.neighbours, mesh.cells.size());
    std::fill(facets.neighbours.begin(), facets.neighbours.end(), -1);
    const mesh::FacetTable table(mesh, usable);
    const FacetChecker check(mesh, measures, facets.neighbours);
    in_blocks(
        table.node_count(), 4096,
        [&] {
            return Part{DefectList(defects.examples()), {}};
        },
        [&](std::size_t first, std::size_t last, Part& part) {
            table.for_each_group(first, last, [&](std::span<const mesh::CellFacet> equal) { check(equal, part); });
        },
        [&](const Part& part) {
            defects.append(part.defects);
            facets.boundary.insert(facets.boundary.end(), part.boundary.begin(), part.boundary.end());
        });
    return facets;
}

}  // namespace barycert::check
