#include "barycert/surface/parts.hpp"

#include <algorithm>
#include <cstddef>

#include "barycert/mesh/adjacency.hpp"

namespace barycert::surface {
namespace {

using Index = Mesh::Index;

constexpr std::int8_t not_asked = 2;

/// 1 or -1 as an even or an odd permutation brings the corners to: corner i, then the others in ascending order.
/// Precondition: all different.
int parity(const Index* corners, std::size_t n, std::size_t i) {
    int sign = i % 2 == 0 ? 1 : -1;
    for (std::size_t j = 0; j < n; ++j) {
        for (std::size_t k = 0; k < j; ++k) {
            if (j != i && k != i && corners[j] < corners[k]) sign = -sign;
        }
    }
    return sign;
}

bool repeats(const Index* corners, std::size_t n) {
    for (std::size_t j = 0; j < n; ++j) {
        if (std::find(corners, corners + j, corners[j]) != corners + j) return true;
    }
    return false;
}

}  // namespace

std::vector<int> flat_signs(const Mesh& mesh, const std::vector<Index>& flat) {
    const std::size_t n = mesh.corners();
    const std::vector<Index> neighbours = mesh::compute_neighbours(mesh);
    std::vector<std::int8_t> signs(mesh.cell_count(), not_asked);
    const auto corners = [&](Index cell) { return mesh.cells.data() + n * static_cast<std::size_t>(cell); };
    const auto sign_at = [&](Index cell) -> std::int8_t& { return signs[static_cast<std::size_t>(cell)]; };
    std::vector<int> answers;
    answers.reserve(flat.size());
    for (const Index start : flat) {
        if (sign_at(start) == not_asked && repeats(corners(start), n)) sign_at(start) = 0;
        if (sign_at(start) != not_asked) {
            answers.push_back(sign_at(start));
            continue;
        }
        // With respect to the start, of which it is not known.
        std::vector<Index> met{start};
        sign_at(start) = 1;
        int of_start = 0;
        for (std::size_t next = 0; next < met.size(); ++next) {
            const Index cell = met[next];
            for (std::size_t i = 0; i < n; ++i) {
                const Index other = neighbours[n * static_cast<std::size_t>(cell) + i];
                if (other < 0 || sign_at(other) != not_asked || repeats(corners(other), n)) continue;
                // The corner opposite to the common facet: the node that `cell` has not.
                const Index* const opposite = std::find_if(corners(other), corners(other) + n, [&](Index node) {
                    return std::find(corners(cell), corners(cell) + n, node) == corners(cell) + n;
                });
                const auto j = static_cast<std::size_t>(opposite - corners(other));
                if (j == n) continue;  // both have the same nodes
                const int fitting = -sign_at(cell) * parity(corners(cell), n, i) * parity(corners(other), n, j);
                const int own = static_cast<int>(orientation(mesh, corners(other)));
                if (own != 0) {
                    if (of_start == 0) of_start = own * fitting;
                    continue;
                }
                sign_at(other) = static_cast<std::int8_t>(fitting);
                met.push_back(other);
            }
        }
        if (of_start < 0)
            for (const Index cell : met) sign_at(cell) = static_cast<std::int8_t>(-sign_at(cell));
        answers.push_back(sign_at(start));
    }
    return answers;
}

}  // namespace barycert::surface
