#include "barycert/check/nodes.hpp"

#include <tbb/parallel_sort.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace barycert::check {
namespace {

struct PlacedNode {
    std::array<double, 3> at;
    Mesh::Index node;
};

/// Nodes at the place of another one, each told with the lowest that is there.
void find_coincident(const Mesh& mesh, const std::vector<std::uint8_t>& finite, DefectList& defects) {
    const auto d = static_cast<std::size_t>(mesh.dimension);
    std::vector<PlacedNode> nodes;
    nodes.reserve(finite.size());
    for (std::size_t i = 0; i < finite.size(); ++i) {
        if (finite[i] == 0) continue;
        PlacedNode n{{0, 0, 0}, static_cast<Mesh::Index>(i)};
        for (std::size_t k = 0; k < d; ++k) n.at[k] = mesh.points[i * d + k];
        nodes.push_back(n);
    }
    // -0 and 0 compare equal, as they should: they are one place.
    tbb::parallel_sort(nodes.begin(), nodes.end(), [](const PlacedNode& a, const PlacedNode& b) {
        return a.at != b.at ? a.at < b.at : a.node < b.node;
    });
    std::vector<DefectPlace> places;
    for (std::size_t i = 1, first = 0; i < nodes.size(); ++i) {
        if (nodes[i].at != nodes[first].at) {
            first = i;
        } else {
            places.push_back({.nodes = {nodes[first].node, nodes[i].node, -1}});
        }
    }
    std::sort(places.begin(), places.end(),
              [](const DefectPlace& a, const DefectPlace& b) { return a.nodes[1] < b.nodes[1]; });
    for (const DefectPlace& place : places) defects.add(DefectKind::coincident_nodes, place);
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
    mark_used(mesh.mid_nodes, used);
    for (std::size_t i = 0; i < count; ++i) {
        const DefectPlace place{.nodes = {static_cast<Mesh::Index>(i), -1, -1}};
        if (finite[i] == 0) defects.add(DefectKind::not_finite, place);
        if (used[i] == 0) defects.add(DefectKind::unused_node, place);
    }
    find_coincident(mesh, finite, defects);
    return finite;
}

}  // namespace barycert::check
