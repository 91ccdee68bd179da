#include <tbb/parallel_sort.h>

#include <algorithm>
#include <utility>

#include "barycert/base/large_pages.hpp"
#include "barycert/check/stages.hpp"
#include "barycert/index/proof.hpp"
#include "barycert/mesh/adjacency.hpp"

namespace barycert::check {
namespace {

/// The nodes of the facet opposite to `corner`, in the order that turns its normal outward if the cell's orientation is
/// not negative; `orientation` is that of the cell. 2D: two of them.
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

/// +1 if the nodes are an even permutation of the ascending ones, else -1.
int parity(int d, const std::array<Mesh::Index, 3>& n) {
    int inversions = n[0] > n[1] ? 1 : 0;
    if (d == 3) inversions += (n[0] > n[2] ? 1 : 0) + (n[1] > n[2] ? 1 : 0);
    return inversions % 2 == 0 ? 1 : -1;
}

struct FacetPart {
    DefectList defects;
    std::vector<BoundaryFacet> boundary;
};

/// Looks at equal facets, those of the same nodes.
struct FacetChecker {
    const Mesh& mesh;
    const std::vector<std::int8_t>& orientations;
    std::vector<Mesh::Index>& neighbours;

    void operator()(std::span<const mesh::CellFacet> equal, FacetPart& part) const {
        const mesh::CellFacet &f = equal.front(), &g = equal.back();
        if (equal.size() == 1) {
            part.boundary.push_back({f.cell, f.corner, outward(f), orientation(f) != 0});
            return;
        }
        mesh::pair_facets(equal, mesh.corners(), neighbours);
        if (equal.size() > 2 || apex(f) == apex(g)) find_duplicates(equal, part);
        if (equal.size() == 2 && side(f) * side(g) <= 0) return;
        const DefectKind kind = equal.size() > 2 ? DefectKind::overfull_facet : DefectKind::same_side;
        for (const mesh::CellFacet& each : equal) part.defects.mark(each.cell, kind);
        part.defects.add(kind, {.cells = {f.cell, equal[1].cell}, .nodes = outward(f)});
    }

    std::int8_t orientation(const mesh::CellFacet& f) const { return orientations[static_cast<std::size_t>(f.cell)]; }

    std::array<Mesh::Index, 3> outward(const mesh::CellFacet& f) const {
        return outward_nodes(mesh, static_cast<std::size_t>(f.cell), static_cast<std::size_t>(f.corner),
                             orientation(f));
    }

    /// On which side of the facet, taken with its nodes ascending, the cell lies: -1 or 1; 0 if it is degenerate.
    int side(const mesh::CellFacet& f) const { return orientation(f) == 0 ? 0 : parity(mesh.dimension, outward(f)); }

    Mesh::Index apex(const mesh::CellFacet& f) const {
        return nodes_of(mesh, static_cast<std::size_t>(f.cell))[static_cast<std::size_t>(f.corner)];
    }

    /// Two cells with a common facet and apex are the same. They share every facet: it is told at the one opposite to
    /// their highest node.
    void find_duplicates(std::span<const mesh::CellFacet> equal, FacetPart& part) const {
        std::vector<mesh::CellFacet> by_apex(equal.begin(), equal.end());
        std::sort(by_apex.begin(), by_apex.end(), [&](const mesh::CellFacet& a, const mesh::CellFacet& b) {
            return std::pair(apex(a), a.cell) < std::pair(apex(b), b.cell);
        });
        for (std::size_t i = 1, first = 0; i < by_apex.size(); ++i) {
            const mesh::CellFacet &original = by_apex[first], &copy = by_apex[i];
            if (apex(copy) != apex(original)) {
                first = i;
            } else if (apex(copy) > copy.highest) {
                part.defects.add_marked(DefectKind::duplicate_cell, {.cells = {original.cell, copy.cell}});
            }
        }
    }
};

std::vector<Mesh::Index> neighbours_of(const Mesh& mesh, const index::CellIndex& index) {
    std::vector<Mesh::Index> neighbours;
    base::resize_large(neighbours, mesh.cells.size());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, index.cell_count(), 1 << 14), [&](const auto& range) {
        for (std::size_t c = range.begin(); c < range.end(); ++c) {
            Mesh::Index* const out = &neighbours[mesh.corners() * static_cast<std::size_t>(index.original[c])];
            for (std::size_t i = 0; i < mesh.corners(); ++i) {
                const index::Place next = index.cells[c].next[i];
                out[i] = next < 0 ? -1 : index.original[static_cast<std::size_t>(next)];
            }
        }
    });
    return neighbours;
}

/// The nodes sorted; in 2D the first is none.
std::array<Mesh::Index, 3> ascending(const BoundaryFacet& facet) {
    std::array<Mesh::Index, 3> n = facet.nodes;
    std::sort(n.begin(), n.end());
    return n;
}

}  // namespace

Facets check_facets(const Mesh& mesh, const std::vector<std::uint8_t>& usable,
                    const std::vector<std::int8_t>& orientation, DefectList& defects) {
    Facets facets;
    base::resize_large(facets.neighbours, mesh.cells.size());
    std::fill(facets.neighbours.begin(), facets.neighbours.end(), -1);
    const mesh::FacetTable table(mesh, usable);
    const FacetChecker check{mesh, orientation, facets.neighbours};
    in_blocks(
        table.node_count(), 4096,
        [&] {
            return FacetPart{defects.part(), {}};
        },
        [&](std::size_t first, std::size_t last, FacetPart& part) {
            table.for_each_group(first, last, [&](std::span<const mesh::CellFacet> equal) { check(equal, part); });
        },
        [&](const FacetPart& part) {
            defects.append(part.defects);
            facets.boundary.insert(facets.boundary.end(), part.boundary.begin(), part.boundary.end());
        });
    return facets;
}

std::optional<Facets> facets_of_partition(const Mesh& mesh, const std::vector<std::int8_t>& orientation) {
    index::CellIndex index = index::make_cell_index(mesh);
    const index::FacetLinks links = index::link_facets(index);
    std::optional<index::CellTree> tree;
    const auto tree_of_cells = [&]() -> const index::CellTree& {
        return tree ? *tree : tree.emplace(index::make_cell_tree(index));
    };
    if (!index::is_partition(index, links, tree_of_cells)) return std::nullopt;
    Facets facets;
    facets.neighbours = neighbours_of(mesh, index);
    facets.boundary.reserve(links.open.size());
    for (const index::CellFacet& open : links.open) {
        const auto cell = static_cast<std::size_t>(index.original[static_cast<std::size_t>(open.cell)]);
        facets.boundary.push_back({static_cast<Mesh::Index>(cell), open.corner,
                                   outward_nodes(mesh, cell, static_cast<std::size_t>(open.corner), orientation[cell]),
                                   true});
    }
    tbb::parallel_sort(facets.boundary.begin(), facets.boundary.end(),
                       [](const BoundaryFacet& a, const BoundaryFacet& b) { return ascending(a) < ascending(b); });
    return facets;
}

}  // namespace barycert::check
