// The facets of a mesh that only one cell has.
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>

#include "barycert/environment.hpp"
#include "barycert/mesh/adjacency.hpp"
#include "barycert/surface.hpp"
#include "barycert/surface/parts.hpp"

namespace barycert::surface {
namespace {

using Index = Mesh::Index;

/// Each as cell * corners + corner opposite to it, ascending.
std::vector<std::int64_t> single_facets(const Mesh& mesh) {
    const mesh::FacetTable table(mesh);
    constexpr std::size_t size = 1024;
    std::vector<std::vector<std::int64_t>> parts((table.node_count() + size - 1) / size);
    tbb::parallel_for(std::size_t{0}, parts.size(), [&](std::size_t p) {
        table.for_each_group(p * size, std::min(table.node_count(), (p + 1) * size),
                             [&](std::span<const mesh::CellFacet> equal) {
                                 if (equal.size() != 1) return;
                                 const auto corners = static_cast<std::int64_t>(mesh.corners());
                                 parts[p].push_back(equal[0].cell * corners + equal[0].corner);
                             });
    });
    std::vector<std::int64_t> all;
    for (const auto& part : parts) all.insert(all.end(), part.begin(), part.end());
    std::sort(all.begin(), all.end());
    return all;
}

/// The corners of the facet opposite to corner i of a positive cell, turned so that normals point outwards (2D: the
/// cell is to the left).
template <std::size_t n>
std::array<std::size_t, n - 1> outward_facet(std::size_t i) {
    if constexpr (n == 3) {
        return {(i + 1) % 3, (i + 2) % 3};
    } else {
        constexpr std::array<std::array<std::size_t, 3>, 4> facets{{{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};
        return facets[i];
    }
}

template <std::size_t n>
void write_facets(const Mesh& mesh, const std::vector<std::int64_t>& facets, Surface& surface) {
    base::resize_large(surface.cells, (n - 1) * facets.size());
    base::resize_large(surface.mesh_cells, facets.size());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, facets.size(), 4096), [&](const auto& range) {
        for (std::size_t f = range.begin(); f != range.end(); ++f) {
            const auto place = static_cast<std::size_t>(facets[f]);
            const Index* const corners = mesh.cells.data() + place / n * n;
            const auto facet = outward_facet<n>(place % n);
            Index* const to = surface.cells.data() + (n - 1) * f;
            for (std::size_t i = 0; i < n - 1; ++i) to[i] = corners[facet[i]];
            if (orientation(mesh, corners) == Sign::negative) std::swap(to[n - 3], to[n - 2]);
            surface.mesh_cells[f] = static_cast<Index>(place / n);
        }
    });
}

/// From nodes of the mesh to points: the nodes that cells use, ascending.
void number_nodes(const Mesh& mesh, Surface& surface) {
    std::vector<Index> point_of(mesh.point_count(), -1);
    for (const Index node : surface.cells) point_of[static_cast<std::size_t>(node)] = 0;
    Index count = 0;
    for (std::size_t node = 0; node < point_of.size(); ++node) {
        if (point_of[node] < 0) continue;
        point_of[node] = count++;
        surface.mesh_edges.push_back(static_cast<Index>(node));
        surface.mesh_edges.push_back(static_cast<Index>(node));
    }
    for (Index& node : surface.cells) node = point_of[static_cast<std::size_t>(node)];
}

std::vector<double> rows_at_points(const std::vector<double>& from, std::size_t components, const Surface& surface) {
    std::vector<double> to(components * surface.mesh_edges.size() / 2);
    for (std::size_t v = 0; v < surface.mesh_edges.size() / 2; ++v)
        std::copy_n(from.data() + components * static_cast<std::size_t>(surface.mesh_edges[2 * v]), components,
                    to.data() + components * v);
    return to;
}

Surface boundary_of(const Mesh& mesh, const CutOptions& options) {
    Surface surface;
    surface.dimension = mesh.dimension;
    const std::vector<std::int64_t> facets = single_facets(mesh);
    mesh.dimension == 2 ? write_facets<3>(mesh, facets, surface) : write_facets<4>(mesh, facets, surface);
    number_nodes(mesh, surface);
    surface.points = rows_at_points(mesh.points, surface.corners(), surface);
    for (const Field* const field : options.point_fields)
        surface.point_fields.push_back(
            {field->name, field->components,
             rows_at_points(field->data, static_cast<std::size_t>(field->components), surface)});
    carry_cell_fields(options, surface);
    return surface;
}

}  // namespace
}  // namespace barycert::surface

namespace barycert {

Result<Surface> boundary(const Mesh& mesh, const CutOptions& options) {
    const ExactEnvironment environment;
    return surface::in_arena(options.threads, [&]() -> Result<Surface> {
        if (Status good = surface::check_mesh(mesh, 0); !good) return good.error();
        if (!surface::indices_fit(mesh.cells, mesh.point_count())) return surface::bad_index();
        if (Status fit = surface::check_options(mesh, options); !fit) return fit.error();
        return surface::boundary_of(mesh, options);
    });
}

}  // namespace barycert
