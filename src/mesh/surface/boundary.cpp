// The facets of a mesh that only one cell has.

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "barycert/mesh.hpp"
#include "barycert/predicates.hpp"
#include "barycert/result.hpp"
#include "barycert/surface.hpp"
#include "core/base/large_pages.hpp"
#include "mesh/adjacency.hpp"
#include "mesh/surface/parts.hpp"
#include "mesh/threads/arena.hpp"

namespace barycert::surface {
namespace {

using Index = Mesh::Index;

/// Each as cell * corners + corner opposite to it, ascending.
std::vector<std::size_t> single_facets(const Mesh& mesh) {
    const mesh::FacetTable table(mesh);
    std::vector<std::uint8_t> single(mesh.cells.size());
    base::parallel_for(table.node_count(), grain, [&](std::size_t first, std::size_t last) {
        table.for_each_group(first, last, [&](std::span<const mesh::CellFacet> equal) {
            if (equal.size() == 1)
                single[static_cast<std::size_t>(equal[0].cell) * mesh.corners() +
                       static_cast<std::size_t>(equal[0].corner)] = 1;
        });
    });
    std::vector<std::size_t> all;
    for (std::size_t place = 0; place < single.size(); ++place)
        if (single[place] != 0) all.push_back(place);
    return all;
}

void write_facets(const Mesh& mesh, const std::vector<std::size_t>& facets, Surface& surface) {
    const std::size_t n = mesh.corners();
    base::resize_large(surface.cells, (n - 1) * facets.size());
    base::resize_large(surface.mesh_cells, facets.size());
    base::parallel_for_each(facets.size(), grain, [&](std::size_t f) {
        const Index* const corners = mesh.cells.data() + facets[f] / n * n;
        const auto facet = mesh::outward_corners(mesh.dimension, facets[f] % n);
        Index* const to = surface.cells.data() + (n - 1) * f;
        for (std::size_t i = 0; i < n - 1; ++i) to[i] = corners[facet[i]];
        if (orientation(mesh, corners) == Sign::negative) std::swap(to[n - 3], to[n - 2]);
        surface.mesh_cells[f] = static_cast<Index>(facets[f] / n);
    });
}

/// From nodes of the mesh to points: the nodes that cells use, ascending.
void number_nodes(const Mesh& mesh, Surface& surface) {
    std::vector<Index> point_of(mesh.point_count(), -1);
    for (const Index node : surface.cells) point_of[static_cast<std::size_t>(node)] = 0;
    for (std::size_t node = 0; node < point_of.size(); ++node) {
        if (point_of[node] < 0) continue;
        point_of[node] = static_cast<Index>(surface.mesh_edges.size() / 2);
        surface.mesh_edges.insert(surface.mesh_edges.end(), 2, static_cast<Index>(node));
    }
    for (Index& node : surface.cells) node = point_of[static_cast<std::size_t>(node)];
}

}  // namespace
}  // namespace barycert::surface

namespace barycert {

Result<Surface> boundary(const Mesh& mesh, const CutOptions& options) {
    using namespace surface;
    return on_good_input(mesh, 0, options, [&]() -> Result<Surface> {
        if (!indices_fit(mesh.cells, mesh.point_count())) return bad_index();
        Surface out;
        out.dimension = mesh.dimension;
        write_facets(mesh, single_facets(mesh), out);
        number_nodes(mesh, out);
        out.points = take_rows(mesh.points, out.corners(), out.mesh_edges, 2);
        take_rows(options.point_fields, out.mesh_edges, 2, out.point_fields);
        take_rows(options.cell_fields, out.mesh_cells, 1, out.cell_fields);
        return out;
    });
}

}  // namespace barycert
