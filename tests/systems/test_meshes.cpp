#include "tests/systems/test_meshes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "barycert/gmsh_files.hpp"
#include "barycert/grid.hpp"
#include "barycert/mesh_files.hpp"
#include "barycert/plc_files.hpp"
#include "barycert/point_files.hpp"
#include "barycert/series.hpp"
#include "barycert/surface_files.hpp"
#include "barycert/table_files.hpp"
#include "barycert/tetgen_files.hpp"
#include "barycert/vtk_files.hpp"
#include "core/base/random.hpp"
#include "tests/bench/generated_mesh.hpp"

namespace barycert::systems {
namespace {

/// The unit cube (square) in n^d small ones, each in six tetrahedra (two triangles): one for each order in which a path
/// from its lowest corner to its highest may take the axes. Inner nodes are moved by up to `shake` / n along each axis.
Mesh lattice(int dimension, int n, double shake) {
    const auto d = static_cast<std::size_t>(dimension), side = static_cast<std::size_t>(n) + 1;
    Mesh mesh;
    mesh.dimension = dimension;
    base::Random random(7);
    const std::size_t nodes = d == 3 ? side * side * side : side * side;
    for (std::size_t i = 0; i < nodes; ++i) {
        const std::array<std::size_t, 3> at{i % side, i / side % side, i / side / side};
        const bool inner =
            std::all_of(at.begin(), at.begin() + dimension, [&](std::size_t k) { return k != 0 && k + 1 != side; });
        for (std::size_t k = 0; k < d; ++k) {
            const double by = random.uniform(-shake, shake);
            mesh.points.push_back((static_cast<double>(at[k]) + (inner ? by : 0)) / n);
        }
    }
    std::array<std::size_t, 3> order{0, 1, 2};
    do {
        if (d == 2 && order[2] != 2) continue;
        const bool odd = (order[0] > order[1]) ^ (order[0] > order[2]) ^ (order[1] > order[2]);
        const std::array<std::size_t, 3> step{1, side, side * side};
        for (std::size_t i = 0; i < nodes; ++i) {
            const std::array<std::size_t, 3> at{i % side, i / side % side, i / side / side};
            if (std::any_of(at.begin(), at.begin() + dimension, [&](std::size_t k) { return k + 1 == side; })) continue;
            std::array<std::size_t, 4> corner{i};
            for (std::size_t k = 0; k < d; ++k) corner[k + 1] = corner[k] + step[order[k]];
            if (odd) std::swap(corner[1], corner[2]);
            for (std::size_t k = 0; k <= d; ++k) mesh.cells.push_back(static_cast<Mesh::Index>(corner[k]));
        }
    } while (std::next_permutation(order.begin(), order.end()));
    return mesh;
}

/// Values at the nodes by a smooth function of the place in the box.
void set_field(Mesh& mesh) {
    const Bounds3 box = bounds_of_cells(mesh);
    const auto d = static_cast<std::size_t>(mesh.dimension);
    Field field{"f", 1, {}};
    for (std::size_t i = 0; i < mesh.point_count(); ++i) {
        std::array<double, 3> x{};
        for (std::size_t k = 0; k < d; ++k) x[k] = (mesh.points[d * i + k] - box.low[k]) / (box.high[k] - box.low[k]);
        field.data.push_back(std::sin(7 * x[0]) * std::cos(5 * x[1]) + x[d - 1] * x[d - 1]);
    }
    mesh.point_fields = {field};
    mesh.cell_fields.clear();
    mesh.cell_labels.clear();
}

/// The mesh with other coordinates: place(coordinates of a node).
Mesh moved(Mesh mesh, const std::function<void(double*)>& place) {
    const auto d = static_cast<std::size_t>(mesh.dimension);
    for (std::size_t i = 0; i < mesh.point_count(); ++i) place(mesh.points.data() + d * i);
    return mesh;
}

}  // namespace

std::vector<NamedMesh> meshes_for_systems() {
    std::vector<NamedMesh> meshes;
    const auto add = [&](const std::string& name, const std::string& about, Mesh mesh) {
        if (mesh.point_fields.empty()) set_field(mesh);
        meshes.push_back({name, about, std::move(mesh)});
    };
    for (const int d : {3, 2}) {
        const int n = d == 3 ? 8 : 24;
        const std::string of = d == 3 ? "" : "-2d";
        // The field belongs to the mesh before it is moved: flat cells shall not have flat values.
        Mesh shaken = lattice(d, n, 0.15);
        set_field(shaken);
        add("lattice" + of, "steps of 1/8 (1/24 in the plane)", lattice(d, n, 0));
        add("tenths" + of, "steps of 0.1, as decimal numbers are in double", moved(lattice(d, n, 0), [&](double* x) {
                for (int k = 0; k < d; ++k) x[k] = std::round(x[k] * n) * 0.1;
            }));
        add("shaken" + of, "the lattice, inner nodes moved", shaken);
        add("far" + of, "shaken, 10 wide, at (500000, 4500000)", moved(shaken, [&](double* x) {
                for (int k = 0; k < d; ++k) x[k] = 10 * x[k] + (k == 0 ? 500000 : k == 1 ? 4500000 : 0);
            }));
        // n = (1, 1, 1) / sqrt(3): all of x along n but a millionth is taken away.
        add("flat" + of, "shaken, a million times thinner along the diagonal", moved(shaken, [&](double* x) {
                double along = 0;
                for (int k = 0; k < d; ++k) along += x[k] / d;
                for (int k = 0; k < d; ++k) x[k] -= (1 - 1e-6) * along;
            }));
    }
    for (const char* name : {"bracket", "cube-hole", "flange", "lattice-box", "needle-slit", "torus", "plate"}) {
        Mesh mesh = read_mesh(std::string(BARYCERT_DATA_DIR "/meshes/") + name).value();
        mesh.mid_nodes.clear();
        mesh.neighbours.clear();
        set_field(mesh);
        add(name, "data/meshes", std::move(mesh));
    }
    // Sheared, so that sides are not parallel to axes; by powers of two, so that middles of edges stay exact.
    const auto sheared = [](Mesh mesh) {
        return moved(std::move(mesh), [](double* x) {
            x[0] += 0.25 * x[1];
            x[2] += 0.125 * x[0];
        });
    };
    using bench::CubeCells;
    const auto add_shaped = [&](const std::string& name, CubeCells what, int n) {
        add(name, "made of lattice cubes, sheared", sheared(bench::shaped_cube(what, n, 0, true, 7)));
        add(name + "-warped",
            "made of lattice cubes whose inner nodes are moved: sides of four nodes are not flat; sheared",
            sheared(bench::shaped_cube(what, n, 0.15, true, 7)));
    };
    add_shaped("hexahedra", CubeCells::hexahedra, 8);
    add_shaped("wedges", CubeCells::wedges, 6);
    add_shaped("pyramids", CubeCells::pyramids, 5);
    add_shaped("mixed", CubeCells::mixed, 8);
    add("curved", "tetrahedra of second order, half of them with curved edges",
        sheared(bench::curved_cube(4, 0.07, 7)));
    return meshes;
}

}  // namespace barycert::systems
