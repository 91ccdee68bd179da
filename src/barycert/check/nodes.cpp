#include "barycert/check/nodes.hpp"

#include <cmath>
#include <cstddef>

#include "barycert/check/near_nodes.hpp"

namespace barycert::check {
namespace {

/// Nodes at the place of another one. Two that cells have for vertices are why these cells do not meet in a common
/// face.
void find_coincident(const Mesh& mesh, const std::vector<std::uint8_t>& finite, const std::vector<std::uint8_t>& vertex,
                     DefectList& defects) {
    std::vector<Mesh::Index> nodes;
    nodes.reserve(finite.size());
    for (std::size_t i = 0; i < finite.size(); ++i) {
        if (finite[i] != 0) nodes.push_back(static_cast<Mesh::Index>(i));
    }
    for (const auto& [first, second] : coincident_nodes(mesh, nodes)) {
        defects.add(DefectKind::coincident_nodes, {.nodes = {first, second, -1}});
        if (vertex[static_cast<std::size_t>(first)] != 0 && vertex[static_cast<std::size_t>(second)] != 0)
            defects.cause(DefectKind::coincident_nodes);
    }
}

void mark_used(const std::vector<Mesh::Index>& indices, std::vector<std::uint8_t>& used) {
    for (const Mesh::Index i : indices) {
        if (i >= 0 && static_cast<std::size_t>(i) < used.size()) used[static_cast<std::size_t>(i)] = 1;
    }
}

}  // namespace

std::vector<std::uint8_t> check_nodes(const Mesh& mesh, DefectList& defects) {
    const auto d = static_cast<std::size_t>(mesh.dimension);
    const std::size_t count = mesh.point_count();
    std::vector<std::uint8_t> finite(count, 1), used(count, 0);
    for (std::size_t i = 0; i < count * d; ++i) {
        if (!std::isfinite(mesh.points[i])) finite[i / d] = 0;
    }
    mark_used(mesh.cells, used);
    const std::vector<std::uint8_t> vertex = used;
    mark_used(mesh.mid_nodes, used);
    for (std::size_t i = 0; i < count; ++i) {
        const DefectPlace place{.nodes = {static_cast<Mesh::Index>(i), -1, -1}};
        if (finite[i] == 0) defects.add(DefectKind::not_finite, place);
        if (used[i] == 0) defects.add(DefectKind::unused_node, place);
    }
    find_coincident(mesh, finite, vertex, defects);
    return finite;
}

}  // namespace barycert::check
