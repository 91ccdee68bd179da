#include "barycert/mesh/adjacency.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstddef>

#include "barycert/mesh/facets.hpp"

namespace barycert::mesh {

void pair_facets(std::span<const CellFacet> equal, std::size_t corners, std::vector<Mesh::Index>& neighbours) {
    // A cell with a repeated corner holds a facet twice and is not its own neighbour.
    const CellFacet& first = equal.front();
    const auto second =
        std::find_if(equal.begin(), equal.end(), [&](const CellFacet& f) { return f.cell != first.cell; });
    if (second == equal.end()) return;
    const auto place = [&](const CellFacet& f) {
        return static_cast<std::size_t>(f.cell) * corners + static_cast<std::size_t>(f.corner);
    };
    neighbours[place(first)] = second->cell;
    neighbours[place(*second)] = first.cell;
}

std::vector<Mesh::Index> compute_neighbours(const Mesh& mesh) {
    std::vector<Mesh::Index> neighbours(mesh.cells.size(), -1);
    const mesh::FacetTable table(mesh);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, table.node_count(), 1024), [&](const auto& range) {
        table.for_each_group(range.begin(), range.end(), [&](std::span<const mesh::CellFacet> equal) {
            mesh::pair_facets(equal, mesh.corners(), neighbours);
        });
    });
    return neighbours;
}

std::vector<std::int64_t> hull_facets(const Mesh& mesh, const std::vector<Mesh::Index>& neighbours) {
    std::vector<std::int64_t> hull;
    for (std::size_t place = 0; place < std::min(mesh.cells.size(), neighbours.size()); ++place) {
        if (neighbours[place] == -1) hull.push_back(static_cast<std::int64_t>(place));
    }
    return hull;
}

}  // namespace barycert::mesh
