#include "mesh/part.hpp"

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "barycert/mesh.hpp"

namespace barycert::mesh {

Field rows_of(const Field& whole, const std::vector<Mesh::Index>& rows) {
    Field field{whole.name, whole.components, {}};
    append_rows_of(whole.data, static_cast<std::size_t>(whole.components), rows, field.data);
    return field;
}

Submesh part_of(const Mesh& mesh, std::vector<Mesh::Index> cells) {
    Submesh part;
    part.cells = std::move(cells);
    part.mesh.dimension = mesh.dimension;
    append_rows_of(mesh.cells, mesh.corners(), part.cells, part.mesh.cells);
    if (!mesh.shapes.inside.empty()) {
        append_rows_of(mesh.shapes.inside, 1, part.cells, part.mesh.shapes.inside);
        append_rows_of(mesh.cell_numbers, 1, part.cells, part.mesh.cell_numbers);
    }
    if (!mesh.mid_nodes.empty()) {
        const std::size_t mids = mesh.mid_nodes.size() / mesh.cell_count();
        append_rows_of(mesh.mid_nodes, mids, part.cells, part.mesh.mid_nodes);
        part.mesh.mid_edge_order = mesh.mid_edge_order;
    }
    // A bit for each node of the part, and how many there are before each word: few cells have few nodes of many.
    std::vector<std::uint64_t> used((mesh.point_count() + 63) / 64, 0);
    const std::array<std::span<Mesh::Index>, 2> uses{part.mesh.cells, part.mesh.mid_nodes};
    for (const auto& nodes : uses) {
        for (const Mesh::Index node : nodes)
            used[static_cast<std::size_t>(node) / 64] |= std::uint64_t{1} << static_cast<std::size_t>(node) % 64;
    }
    std::vector<Mesh::Index> before(used.size());
    for (std::size_t word = 0; word < used.size(); ++word) {
        before[word] = static_cast<Mesh::Index>(part.nodes.size());
        for (std::uint64_t bits = used[word]; bits != 0; bits &= bits - 1)
            part.nodes.push_back(static_cast<Mesh::Index>(64 * word) + std::countr_zero(bits));
    }
    for (const auto& nodes : uses) {
        for (Mesh::Index& node : nodes) {
            const auto word = static_cast<std::size_t>(node) / 64;
            const std::uint64_t below = (std::uint64_t{1} << static_cast<std::size_t>(node) % 64) - 1;
            node = before[word] + std::popcount(used[word] & below);
        }
    }
    append_rows_of(mesh.points, static_cast<std::size_t>(mesh.dimension), part.nodes, part.mesh.points);
    return part;
}

}  // namespace barycert::mesh
