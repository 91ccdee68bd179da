#include "tests/mesh/check/random_complexes.hpp"

#include <cstddef>
#include <vector>

#include "tests/mesh/check/judge.hpp"
#include "tests/mesh/check/meshes.hpp"

namespace barycert::testing {
namespace {

void add_lattice_nodes(Mesh& mesh, int count, int side, base::Random& random) {
    for (int i = 0; i < count * mesh.dimension; ++i) mesh.points.push_back(random.integer(0, side));
}

Mesh::Index any_node(const Mesh& mesh, base::Random& random) {
    return static_cast<Mesh::Index>(random.below(mesh.point_count()));
}

/// Different nodes: a repeated one says little more than that.
void add_cell(Mesh& mesh, base::Random& random) {
    const auto first = static_cast<std::ptrdiff_t>(mesh.cells.size());
    while (mesh.cells.size() < static_cast<std::size_t>(first) + mesh.corners()) {
        const Mesh::Index n = any_node(mesh, random);
        bool is_new = true;
        for (auto i = mesh.cells.begin() + first; i != mesh.cells.end(); ++i) is_new = is_new && *i != n;
        if (is_new) mesh.cells.push_back(n);
    }
}

double& coordinate(Mesh& mesh, Mesh::Index node, std::uint64_t axis) {
    return mesh.points[static_cast<std::size_t>(node * mesh.dimension) + axis];
}

}  // namespace

Mesh random_soup(int d, base::Random& random) {
    Mesh mesh;
    mesh.dimension = d;
    add_lattice_nodes(mesh, random.integer(d + 1, 9), random.integer(1, 4), random);
    for (int cells = random.integer(1, random.coin() ? 2 : 8); cells > 0; --cells) add_cell(mesh, random);
    return mesh;
}

Mesh grown_complex(int d, base::Random& random) {
    Mesh mesh;
    mesh.dimension = d;
    add_lattice_nodes(mesh, random.integer(d + 2, 12), random.integer(2, 4), random);
    const int wanted = random.integer(2, 8);
    for (int tries = 0; tries < 3 * wanted; ++tries) {
        const std::vector<Mesh::Index> before = mesh.cells;
        add_cell(mesh, random);
        if (!judge(mesh, mesh.cell_count() - 1).complex) mesh.cells = before;
    }
    if (random.below(3) == 0) add_cell(mesh, random);
    return mesh;
}

Mesh damaged_box(int d, base::Random& random) {
    Mesh mesh = box(d, {2, d == 2 ? 2 : 1, 1});
    mesh = mapped(mesh, {3, 3, 3}, {0, 0, 0});
    for (double& x : mesh.points) x += random.below(3) == 0 ? random.integer(-1, 1) : 0;
    std::vector<bool> keep;
    const std::uint64_t dropped = random.below(4);
    for (std::size_t c = 0; c < mesh.cell_count(); ++c) keep.push_back(random.below(4) >= dropped);
    mesh = renumbered(only(mesh, keep), random);
    if (random.coin()) flip_some(mesh, random);
    const Mesh::Index n = any_node(mesh, random);
    switch (random.below(5)) {
        case 0:  // moved
            coordinate(mesh, n, random.below(static_cast<std::uint64_t>(d))) += random.integer(-2, 2);
            break;
        case 1: {  // split: some of its cells get a copy
            const Mesh::Index copy = add_node(mesh, node_at(mesh, n));
            for (Mesh::Index& i : mesh.cells) i = i == n && random.coin() ? copy : i;
            break;
        }
        case 2: {  // two made one, in all cells but those that would have it twice
            const Mesh::Index m = any_node(mesh, random);
            for (Mesh::Index& i : mesh.cells) i = i == n ? m : i;
            break;
        }
        default:
            break;
    }
    return mesh;
}

}  // namespace barycert::testing
