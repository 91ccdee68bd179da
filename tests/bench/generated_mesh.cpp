#include "generated_mesh.hpp"

#include <array>
#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

#include "barycert/base/large_pages.hpp"
#include "barycert/base/random.hpp"

namespace barycert::bench {
namespace {

/// Where each of `count` things goes: a random permutation (Fisher and Yates).
std::vector<Mesh::Index> random_order(std::size_t count, base::Random& random) {
    std::vector<Mesh::Index> order(count);
    std::iota(order.begin(), order.end(), 0);
    for (std::size_t i = count; i > 1; --i) std::swap(order[i - 1], order[random.below(i)]);
    return order;
}

/// A coordinate of a node: on the cube's boundary where the lattice is.
double moved(int at, int n, base::Random& random) {
    const double by = random.uniform(-0.15, 0.15);
    return at == 0 ? 0 : at == n ? 1 : (at + by) / n;
}

}  // namespace

Mesh jittered_cube(int n, std::uint64_t seed) {
    const auto side = static_cast<std::size_t>(n) + 1, lattice = static_cast<std::size_t>(n);
    base::Random random(seed);
    Mesh mesh;
    const std::vector<Mesh::Index> node = random_order(side * side * side, random);
    base::resize_large(mesh.points, 3 * node.size());
    const auto number = [&](const std::array<std::size_t, 3>& at) { return (at[2] * side + at[1]) * side + at[0]; };
    for (std::size_t i = 0; i < node.size(); ++i) {
        const std::array<std::size_t, 3> at{i % side, i / side % side, i / side / side};
        for (std::size_t k = 0; k < 3; ++k)
            mesh.points[3 * static_cast<std::size_t>(node[i]) + k] = moved(static_cast<int>(at[k]), n, random);
    }
    // One cell for each order in which a path from the lowest corner to the highest may take the axes. An odd order
    // gives a negative volume; its two middle corners are swapped.
    constexpr std::array<std::array<std::size_t, 3>, 6> orders{
        {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}}};
    const std::vector<Mesh::Index> cell = random_order(6 * lattice * lattice * lattice, random);
    base::resize_large(mesh.cells, 4 * cell.size());
    for (std::size_t c = 0; c < cell.size(); ++c) {
        const std::size_t cube = c / 6;
        std::array<std::size_t, 3> at{cube % lattice, cube / lattice % lattice, cube / lattice / lattice};
        std::array<Mesh::Index, 4> corner{node[number(at)]};
        for (std::size_t i = 0; i < 3; ++i) {
            ++at[orders[c % 6][i]];
            corner[i + 1] = node[number(at)];
        }
        if (c % 6 >= 3) std::swap(corner[1], corner[2]);
        for (std::size_t i = 0; i < 4; ++i) mesh.cells[4 * static_cast<std::size_t>(cell[c]) + i] = corner[i];
    }
    return mesh;
}

}  // namespace barycert::bench
