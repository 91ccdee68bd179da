#include "barycert/check.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

#include "barycert/mesh/mid_edges.hpp"

namespace barycert {

Mesh with_positive_cells(const Mesh& mesh, const std::vector<std::int8_t>& orientation) {
    Mesh out = mesh;
    const std::size_t corners = mesh.corners(), last = corners - 1;
    const auto swapped = [&](std::size_t corner) {
        return corner == last ? last - 1 : corner == last - 1 ? last : corner;
    };
    // Which edge lies, after the swap, where edge e lay.
    const auto edges = mesh::edges_of(mesh.dimension);
    std::array<std::size_t, 6> edge_from{};
    for (std::size_t e = 0; e < edges.size(); ++e) {
        const std::size_t a = swapped(edges[e][0]), b = swapped(edges[e][1]);
        const auto same = std::find_if(edges.begin(), edges.end(), [&](const std::array<std::size_t, 2>& f) {
            return (f[0] == a && f[1] == b) || (f[0] == b && f[1] == a);
        });
        edge_from[e] = static_cast<std::size_t>(same - edges.begin());
    }
    for (std::size_t cell = 0; cell < std::min(orientation.size(), mesh.cell_count()); ++cell) {
        if (orientation[cell] >= 0) continue;
        std::swap(out.cells[cell * corners + last - 1], out.cells[cell * corners + last]);
        if (mesh.neighbours.size() == mesh.cells.size())
            std::swap(out.neighbours[cell * corners + last - 1], out.neighbours[cell * corners + last]);
        if (mesh.mid_nodes.size() != mesh.cell_count() * edges.size()) continue;
        for (std::size_t e = 0; e < edges.size(); ++e)
            out.mid_nodes[cell * edges.size() + e] = mesh.mid_nodes[cell * edges.size() + edge_from[e]];
    }
    return out;
}

}  // namespace barycert
