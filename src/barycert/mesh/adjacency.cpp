#include "barycert/mesh/adjacency.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <tuple>

namespace barycert {
namespace {

/// A facet without its lowest node, by which the facets are gathered.
struct Facet {
    Mesh::Index middle = 0;
    Mesh::Index highest = 0;
    std::size_t place = 0;  // cell * corners + opposite corner

    auto key() const { return std::tie(middle, highest); }
};

/// The nodes of the facet at `place`, ascending; in 2D the first stands twice.
std::array<Mesh::Index, 3> sorted_nodes(const Mesh& mesh, std::size_t place) {
    const std::size_t corners = mesh.corners();
    const Mesh::Index* const cell = &mesh.cells[place / corners * corners];
    std::array<Mesh::Index, 3> nodes{};
    std::size_t count = 0;
    for (std::size_t i = 0; i < corners; ++i) {
        if (i != place % corners) nodes[count++] = cell[i];
    }
    if (count == 2) nodes[2] = std::min(nodes[0], nodes[1]);
    std::sort(nodes.begin(), nodes.end());
    return nodes;
}

/// Pairs the facets of one lowest node.
void pair_facets(Facet* begin, Facet* end, std::size_t corners, std::vector<Mesh::Index>& neighbours) {
    std::sort(begin, end, [](const Facet& a, const Facet& b) {
        return std::tie(a.middle, a.highest, a.place) < std::tie(b.middle, b.highest, b.place);
    });
    for (Facet* first = begin; first != end;) {
        Facet* const next = std::find_if(first, end, [&](const Facet& f) { return f.key() != first->key(); });
        // A cell with a repeated corner holds a facet twice and is not its own neighbour.
        const std::size_t cell = first->place / corners;
        Facet* const second = std::find_if(first, next, [&](const Facet& f) { return f.place / corners != cell; });
        if (second != next) {
            neighbours[first->place] = static_cast<Mesh::Index>(second->place / corners);
            neighbours[second->place] = static_cast<Mesh::Index>(cell);
        }
        first = next;
    }
}

}  // namespace

std::vector<Mesh::Index> compute_neighbours(const Mesh& mesh) {
    const std::size_t corners = mesh.corners();
    std::vector<Mesh::Index> neighbours(mesh.cells.size(), -1);

    // A counting sort by the lowest node leaves lists as short as a node has cells.
    std::vector<std::size_t> begin(mesh.point_count() + 1, 0);
    for (std::size_t place = 0; place < mesh.cells.size(); ++place) {
        ++begin[static_cast<std::size_t>(sorted_nodes(mesh, place)[0]) + 1];
    }
    for (std::size_t node = 0; node + 1 < begin.size(); ++node) begin[node + 1] += begin[node];
    std::vector<Facet> facets(mesh.cells.size());
    std::vector<std::size_t> next(begin.begin(), begin.end() - 1);
    for (std::size_t place = 0; place < mesh.cells.size(); ++place) {
        const auto [lowest, middle, highest] = sorted_nodes(mesh, place);
        facets[next[static_cast<std::size_t>(lowest)]++] = {middle, highest, place};
    }
    for (std::size_t node = 0; node + 1 < begin.size(); ++node) {
        pair_facets(facets.data() + begin[node], facets.data() + begin[node + 1], corners, neighbours);
    }
    return neighbours;
}

std::vector<std::int64_t> hull_facets(const Mesh& mesh, const std::vector<Mesh::Index>& neighbours) {
    std::vector<std::int64_t> hull;
    for (std::size_t place = 0; place < std::min(mesh.cells.size(), neighbours.size()); ++place) {
        if (neighbours[place] == -1) hull.push_back(static_cast<std::int64_t>(place));
    }
    return hull;
}

}  // namespace barycert
