#include "mesh/surface/edges.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "barycert/mesh.hpp"
#include "barycert/surface.hpp"
#include "core/base/strict_math.hpp"
#include "core/base/vectors.hpp"
#include "mesh/part.hpp"

namespace barycert::surface {

std::vector<std::int32_t> outline_of(const Surface& boundary) {
    if (boundary.dimension == 2) return boundary.cells;
    using Vector = std::array<double, 3>;
    const auto normal = [&](std::int32_t triangle) {
        std::array<Vector, 3> p{};
        for (std::size_t c = 0; c < 3; ++c) {
            const auto point = static_cast<std::size_t>(boundary.cells[3 * static_cast<std::size_t>(triangle) + c]);
            std::copy_n(&boundary.points[3 * point], 3, p[c].begin());
        }
        const auto unit = [](const Vector& v) { return v == Vector{} ? v : base::unit(v); };
        return unit(base::cross(unit(base::minus(p[1], p[0])), unit(base::minus(p[2], p[0]))));
    };
    constexpr double bend = 0.866;  // cosine of 30 degrees
    std::vector<std::int32_t> segments;
    for_edges(boundary, [&](std::span<const TriangleEdge> edge) {
        if (edge.size() != 2 || base::dot(normal(edge[0].second), normal(edge[1].second)) <= bend)
            segments.insert(segments.end(), {edge[0].first.first, edge[0].first.second});
    });
    return segments;
}

Surface facets_of(const Mesh& mesh) {
    Surface out;
    out.points = mesh.points;
    for (std::size_t cell = 0; cell < mesh.cell_count(); ++cell) {
        const auto nodes = mesh.corners_of(cell);
        // The facet without a corner; of a triangle itself, without its fourth, which it has not.
        for (std::size_t without = nodes.size() == 3 ? 3 : 0; without < 4; ++without) {
            for (std::size_t i = 0; i < nodes.size(); ++i)
                if (i != without) out.cells.push_back(nodes[i]);
            out.mesh_cells.push_back(static_cast<Mesh::Index>(cell));
        }
    }
    for (std::size_t i = 0; i < mesh.point_count(); ++i)
        out.mesh_edges.insert(out.mesh_edges.end(), 2, static_cast<Mesh::Index>(i));
    return out;
}

Surface facets_of(const Mesh& mesh, std::vector<Mesh::Index> cells) {
    const mesh::Submesh part = mesh::part_of(mesh, std::move(cells));
    Surface out = facets_of(part.mesh);
    for (Mesh::Index& node : out.mesh_edges) node = part.nodes[static_cast<std::size_t>(node)];
    for (Mesh::Index& cell : out.mesh_cells) cell = part.cells[static_cast<std::size_t>(cell)];
    return out;
}

}  // namespace barycert::surface
