#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <cstddef>
#include <utility>

#include "barycert/base/large_pages.hpp"
#include "barycert/check/facets.hpp"
#include "barycert/index/proof.hpp"

namespace barycert::check {
namespace {

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

std::array<Mesh::Index, 3> ascending(const BoundaryFacet& facet, int d) {
    std::array<Mesh::Index, 3> n = facet.nodes;
    if (n[0] > n[1]) std::swap(n[0], n[1]);
    if (d == 2) return n;
    if (n[1] > n[2]) std::swap(n[1], n[2]);
    if (n[0] > n[1]) std::swap(n[0], n[1]);
    return n;
}

}  // namespace

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
                       [&](const BoundaryFacet& a, const BoundaryFacet& b) {
                           return ascending(a, mesh.dimension) < ascending(b, mesh.dimension);
                       });
    return facets;
}

}  // namespace barycert::check
