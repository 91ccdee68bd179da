#include "tests/fuzz/small_meshes.hpp"

#include <utility>

namespace barycert::fuzz {
namespace {

Mesh with_fields(int dimension, std::vector<double> points, std::vector<Mesh::Index> cells) {
    Mesh mesh;
    mesh.dimension = dimension;
    mesh.points = std::move(points);
    mesh.cells = std::move(cells);
    std::vector<double> t, v;
    for (std::size_t i = 0; i < mesh.point_count(); ++i) t.push_back(static_cast<double>(i) / 4);
    for (const double x : mesh.points) v.push_back(1 - 3 * x);
    mesh.point_fields = {{"T", 1, t}, {"v", dimension, v}};
    mesh.cell_fields = {{"q", 1, {-1, 2}}};
    return mesh;
}

}  // namespace

const Mesh& small_mesh(int dimension) {
    static const Mesh flat = with_fields(2, {0, 0, 1, 0, 0, 1, 1, 1.5}, {0, 1, 2, 1, 3, 2});
    static const Mesh solid = with_fields(3, {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1.5}, {0, 1, 2, 3, 1, 2, 3, 4});
    return dimension == 2 ? flat : solid;
}

}  // namespace barycert::fuzz
