#include <tbb/parallel_sort.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "barycert/defect.hpp"
#include "barycert/mesh.hpp"
#include "core/base/large_pages.hpp"
#include "core/base/lists.hpp"
#include "mesh/adjacency.hpp"
#include "mesh/check/stages.hpp"
#include "mesh/consistency.hpp"
#include "mesh/index/cell_index.hpp"
#include "mesh/index/cell_tree.hpp"
#include "mesh/index/facet_links.hpp"
#include "mesh/index/proof.hpp"
#include "mesh/threads/arena.hpp"

namespace barycert::check {
namespace {

using Triple = std::array<Mesh::Index, 3>;

Triple ascending(Triple nodes) {
    std::ranges::sort(nodes);
    return nodes;
}

/// The nodes of the facet opposite to `corner`, in the order that turns its normal outward, if the cell is not
/// degenerate. 2D: two of them.
Triple outward_nodes(const Checked& c, Mesh::Index cell, std::int32_t corner) {
    const std::span nodes = c.mesh.corners_of(static_cast<std::size_t>(cell));
    const auto order = mesh::outward_corners(c.mesh.dimension, static_cast<std::size_t>(corner));
    Triple out{-1, -1, -1};
    for (std::size_t i = 0; i + 1 < nodes.size(); ++i) out[i] = nodes[order[i]];
    if (c.orientation[static_cast<std::size_t>(cell)] < 0) std::swap(out[0], out[1]);
    return out;
}

/// +1 if the nodes are an even permutation of the ascending ones, else -1.
int parity(int d, const Triple& n) {
    int inversions = n[0] > n[1] ? 1 : 0;
    if (d == 3) inversions += (n[0] > n[2] ? 1 : 0) + (n[1] > n[2] ? 1 : 0);
    return inversions % 2 == 0 ? 1 : -1;
}

struct FacetPart {
    DefectList defects;
    std::vector<BoundaryFacet> boundary = {};
};

/// Looks at equal facets, those of the same nodes.
struct FacetChecker {
    Checked& c;

    void operator()(std::span<const mesh::CellFacet> equal, FacetPart& part) const {
        const mesh::CellFacet &f = equal.front(), &g = equal.back();
        if (equal.size() == 1) {
            part.boundary.push_back({f.cell, f.corner, outward(f), !c.degenerate(f.cell)});
            return;
        }
        mesh::pair_facets(equal, c.mesh.corners(), c.neighbours);
        if (equal.size() > 2 || apex(f) == apex(g)) find_duplicates(equal, part);
        if (equal.size() == 2 && side(f) * side(g) <= 0) return;
        const DefectKind kind = equal.size() > 2 ? DefectKind::overfull_facet : DefectKind::same_side;
        for (const mesh::CellFacet& each : equal) part.defects.mark(each.cell, kind);
        part.defects.add(kind, {.cells = {f.cell, equal[1].cell}, .nodes = outward(f)});
    }

    Triple outward(const mesh::CellFacet& f) const { return outward_nodes(c, f.cell, f.corner); }

    /// On which side of the facet, taken with its nodes ascending, the cell lies: -1 or 1; 0 if it is degenerate.
    int side(const mesh::CellFacet& f) const { return c.degenerate(f.cell) ? 0 : parity(c.mesh.dimension, outward(f)); }

    Mesh::Index apex(const mesh::CellFacet& f) const {
        return c.mesh.corners_of(static_cast<std::size_t>(f.cell))[static_cast<std::size_t>(f.corner)];
    }

    /// Two cells with a common facet and apex are the same. They share every facet: it is told at the one opposite to
    /// their highest node.
    void find_duplicates(std::span<const mesh::CellFacet> equal, FacetPart& part) const {
        std::vector<mesh::CellFacet> by_apex(equal.begin(), equal.end());
        std::ranges::sort(by_apex, {}, [&](const mesh::CellFacet& f) { return std::pair(apex(f), f.cell); });
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
    base::parallel_for_each(index.cell_count(), 1 << 14, [&](std::size_t c) {
        Mesh::Index* const out = &neighbours[mesh.corners() * static_cast<std::size_t>(index.original[c])];
        for (std::size_t i = 0; i < mesh.corners(); ++i) {
            const index::Place next = index.cells[c].next[i];
            out[i] = next < 0 ? -1 : index.original[static_cast<std::size_t>(next)];
        }
    });
    return neighbours;
}

void search_facets(Checked& c) {
    base::resize_large(c.neighbours, c.mesh.cells.size());
    std::ranges::fill(c.neighbours, -1);
    const mesh::FacetTable table(c.mesh, c.usable);
    const FacetChecker check{c};
    in_blocks(
        table.node_count(), 4096, FacetPart{c.defects.part()},
        [&](std::size_t first, std::size_t last, FacetPart& part) {
            table.for_each_group(first, last, [&](std::span<const mesh::CellFacet> equal) { check(equal, part); });
        },
        [&](const FacetPart& part) {
            c.defects.append(part.defects);
            c.boundary.insert(c.boundary.end(), part.boundary.begin(), part.boundary.end());
        });
}

/// False if it is not proved that the cells partition a domain. Requires: all are usable, none degenerate.
bool find_facets_of_partition(Checked& c) {
    index::CellIndex index = index::make_cell_index(c.mesh);
    const index::FacetLinks links = index::link_facets(index);
    std::optional<index::CellTree> tree;
    const auto tree_of_cells = [&]() -> const index::CellTree& {
        return tree ? *tree : tree.emplace(index::make_cell_tree(index));
    };
    if (!index::is_partition(index, links, tree_of_cells)) return false;
    c.neighbours = neighbours_of(c.mesh, index);
    c.boundary.reserve(links.open.size());
    for (const index::CellFacet& open : links.open) {
        const Mesh::Index cell = index.original[static_cast<std::size_t>(open.cell)];
        c.boundary.push_back({cell, open.corner, outward_nodes(c, cell, open.corner), true});
    }
    tbb::parallel_sort(c.boundary.begin(), c.boundary.end(), [](const BoundaryFacet& a, const BoundaryFacet& b) {
        return ascending(a.nodes) < ascending(b.nodes);
    });
    return true;
}

Triple nodes_of_face(const Mesh& mesh, std::size_t f) {
    return {mesh.faces[3 * f], mesh.faces[3 * f + 1], mesh.faces[3 * f + 2]};
}

bool has_nodes(const Mesh& mesh, const Triple& face) {
    return std::ranges::all_of(
        face, [&](Mesh::Index n) { return n >= 0 && static_cast<std::size_t>(n) < mesh.point_count(); });
}

void check_neighbours(Checked& c) {
    const std::vector<Mesh::Index>& given = c.mesh.neighbours;
    if (!given.empty() && given.size() != c.mesh.cells.size())
        return c.defects.add(DefectKind::wrong_neighbour, {.detail = "not one for each facet of each cell"});
    for (std::size_t i = 0; i < given.size(); ++i) {
        if (given[i] == c.neighbours[i]) continue;
        const auto cell = static_cast<Mesh::Index>(i / c.mesh.corners());
        c.defects.add(DefectKind::wrong_neighbour, {.cells = {cell, given[i]}});
    }
}

void check_faces(Checked& c) {
    const auto wrong = [&](const DefectPlace& place) { c.defects.add(DefectKind::wrong_face, place); };
    if (c.mesh.faces.empty()) return;
    if (c.mesh.dimension == 2) return wrong({.detail = mesh::faces_of_triangles});
    if (c.mesh.faces.size() % 3 != 0) wrong({.detail = "the last one is not whole"});
    for (std::size_t f = 0; f < c.mesh.face_count(); ++f) {
        const Triple nodes = nodes_of_face(c.mesh, f);
        if (!has_nodes(c.mesh, nodes)) wrong({.nodes = nodes, .detail = "a corner is no node"});
    }
    const std::vector<std::uint8_t> found = faces_of_cells(c.mesh, c.usable);
    for (std::size_t f = 0; f < found.size(); ++f) {
        const Triple nodes = nodes_of_face(c.mesh, f);
        if (found[f] == 0 && has_nodes(c.mesh, nodes)) wrong({.nodes = nodes});
    }
}

}  // namespace

bool check_facets(Checked& c) {
    const bool good = c.report.degenerate == 0 && std::ranges::find(c.finite, 0) == c.finite.end() &&
                      std::ranges::find(c.usable, 0) == c.usable.end();
    const bool proved = good && find_facets_of_partition(c);
    // Where the proof fails, what is wrong is found by the slower search.
    if (!proved) search_facets(c);
    return proved;
}

std::vector<std::uint8_t> faces_of_cells(const Mesh& mesh, const std::vector<std::uint8_t>& usable) {
    struct Face {
        Triple nodes;
        std::size_t index;
    };
    const base::Lists<Face> by_lowest_node(mesh.point_count(), [&](const auto& add) {
        for (std::size_t f = 0; f < mesh.face_count(); ++f) {
            const Triple nodes = ascending(nodes_of_face(mesh, f));
            if (has_nodes(mesh, nodes)) add(static_cast<std::size_t>(nodes[0]), {nodes, f});
        }
    });
    std::vector<std::uint8_t> found(mesh.face_count(), 0);
    base::parallel_for_each(mesh.cell_count(), 4096, [&](std::size_t cell) {
        if (usable[cell] == 0) return;
        std::array<Mesh::Index, 4> n{};
        std::copy_n(&mesh.cells[4 * cell], 4, n.begin());
        std::ranges::sort(n);
        for (const Triple& facet :
             {Triple{n[0], n[1], n[2]}, {n[0], n[1], n[3]}, {n[0], n[2], n[3]}, {n[1], n[2], n[3]}}) {
            for (const Face& face : by_lowest_node[static_cast<std::size_t>(facet[0])]) {
                if (face.nodes == facet) std::atomic_ref(found[face.index]).store(1, std::memory_order_relaxed);
            }
        }
    });
    return found;
}

void check_files(Checked& c) {
    check_neighbours(c);
    check_faces(c);
}

}  // namespace barycert::check
