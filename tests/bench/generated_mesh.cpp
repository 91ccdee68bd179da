#include "generated_mesh.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

#include "core/base/large_pages.hpp"
#include "core/base/random.hpp"
#include "io/mesh_notes.hpp"
#include "mesh/pulling.hpp"
#include "tests/mesh/curved_mesh.hpp"
#include "tests/mesh/whole_cells.hpp"

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
double moved(int at, int n, double most, base::Random& random) {
    const double by = random.uniform(-most, most);
    return at == 0 ? 0 : at == n ? 1 : (at + by) / n;
}

using Index = Mesh::Index;

/// Corners of a lattice cube as VTK numbers those of a hexahedron, and its faces: below, above, and around.
constexpr std::array<std::array<std::size_t, 3>, 8> corner_steps{
    {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}};
constexpr std::array<std::array<std::size_t, 4>, 6> cube_faces{
    {{0, 1, 2, 3}, {4, 7, 6, 5}, {0, 4, 5, 1}, {1, 5, 6, 2}, {2, 6, 7, 3}, {3, 7, 4, 0}}};

/// Adds what the cube is cut into; `halves`: its lower side is two triangles.
void add_cube(CubeCells what, const std::array<Index, 8>& c, Index middle, bool halves, test::CellArrays& to) {
    const auto add = [&](std::uint8_t type, std::initializer_list<Index> nodes) { to.add(type, nodes); };
    if (what == CubeCells::hexahedra) return to.add(12, c);
    if (what == CubeCells::wedges) {
        add(13, {c[0], c[2], c[1], c[4], c[6], c[5]});
        return add(13, {c[0], c[3], c[2], c[4], c[7], c[6]});
    }
    for (const auto& face : cube_faces) {
        const std::array<Index, 4> ring{c[face[0]], c[face[1]], c[face[2]], c[face[3]]};
        if (halves && &face == cube_faces.data()) {
            add(10, {ring[0], ring[1], ring[2], middle});
            add(10, {ring[0], ring[2], ring[3], middle});
        } else {
            add(14, {ring[0], ring[1], ring[2], ring[3], middle});
        }
    }
}

}  // namespace

Mesh shaped_cube(CubeCells what, int n, double warp, bool shuffled, std::uint64_t seed) {
    const auto side = static_cast<std::size_t>(n) + 1, lattice = static_cast<std::size_t>(n);
    const bool mixed = what == CubeCells::mixed;
    const auto in_layer = [&](std::size_t k) {
        return !mixed            ? what
               : 4 * k < lattice ? CubeCells::wedges
               : 2 * k < lattice ? CubeCells::pyramids
                                 : CubeCells::hexahedra;
    };
    base::Random random(seed);
    Mesh mesh;
    std::vector<double> lattice_points;
    for (std::size_t i = 0; i < side * side * side; ++i) {
        for (const std::size_t at : {i % side, i / side % side, i / side / side})
            lattice_points.push_back(moved(static_cast<int>(at), n, warp, random));
    }
    test::CellArrays cells;
    for (std::size_t cube = 0; cube < lattice * lattice * lattice; ++cube) {
        const std::array<std::size_t, 3> at{cube % lattice, cube / lattice % lattice, cube / lattice / lattice};
        std::array<Index, 8> corner{};
        std::array<double, 3> middle{};
        for (std::size_t i = 0; i < 8; ++i) {
            const auto& step = corner_steps[i];
            corner[i] = static_cast<Index>(((at[2] + step[2]) * side + at[1] + step[1]) * side + at[0] + step[0]);
            for (std::size_t k = 0; k < 3; ++k)
                middle[k] += lattice_points[3 * static_cast<std::size_t>(corner[i]) + k] / 8;
        }
        const CubeCells here = in_layer(at[2]);
        const auto next = static_cast<Index>(lattice_points.size() / 3);
        if (here == CubeCells::pyramids) lattice_points.insert(lattice_points.end(), middle.begin(), middle.end());
        add_cube(here, corner, next, mixed && at[2] != 0 && in_layer(at[2] - 1) == CubeCells::wedges, cells);
    }
    if (mixed) {
        for (std::size_t i = 2; i < lattice_points.size(); i += 3) lattice_points[i] *= 0.3 + 0.7 * lattice_points[i];
    }
    std::vector<Index> node(lattice_points.size() / 3), cell(cells.count());
    std::iota(node.begin(), node.end(), 0);
    std::iota(cell.begin(), cell.end(), 0);
    if (shuffled) {
        node = random_order(node.size(), random);
        cell = random_order(cell.size(), random);
    }
    mesh.points.resize(lattice_points.size());
    for (std::size_t i = 0; i < lattice_points.size(); ++i)
        mesh.points[3 * static_cast<std::size_t>(node[i / 3]) + i % 3] = lattice_points[i];
    for (const Index own : cell) {
        mesh.shapes.types.push_back(cells.types[static_cast<std::size_t>(own)]);
        for (const Index i : cells.of(static_cast<std::size_t>(own)))
            mesh.shapes.nodes.push_back(node[static_cast<std::size_t>(i)]);
        mesh.shapes.ends.push_back(static_cast<std::int64_t>(mesh.shapes.nodes.size()));
    }
    io::cut_into_simplices(mesh, "shaped cube");
    return mesh;
}

Mesh curved_cube(int n, double bend, std::uint64_t seed) {
    Mesh mesh = jittered_cube(n, seed);
    for (double& x : mesh.points) x = std::round(std::ldexp(x, 30)) * 0x1p-30;
    const std::size_t corners = mesh.points.size();
    mesh = testing::second_order(std::move(mesh));
    for (std::size_t i = corners; i < mesh.points.size(); i += 3) {
        const std::array<double, 3> x{mesh.points[i], mesh.points[i + 1], mesh.points[i + 2]};
        if (x[0] <= 0.5) continue;
        for (std::size_t k = 0; k < 3; ++k)
            mesh.points[i + k] += bend / n * (2 * x[0] - 1) * 4 * x[k] * (1 - x[k]) * std::sin(9 * x[(k + 1) % 3] + 5);
    }
    return mesh;
}

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
            mesh.points[3 * static_cast<std::size_t>(node[i]) + k] = moved(static_cast<int>(at[k]), n, 0.15, random);
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
