/// A mesh with cells of all shapes that VTK's files hold, with fields and labels.
#pragma once

#include <numeric>

#include "tests/io/vtk/mesh_notes.hpp"
#include "tests/mesh/shaped_mesh.hpp"

namespace barycert::testing {

using Rings = std::vector<std::vector<Mesh::Index>>;

/// Adds the cell beside those that there are. Its nodes are numbered in another order than its corners.
inline std::vector<Mesh::Index> add_beside(Mesh& mesh, std::uint8_t type) {
    const auto places = test::places_of(type);
    const auto d = static_cast<std::size_t>(mesh.dimension);
    const auto first = static_cast<Mesh::Index>(mesh.point_count()), count = static_cast<Mesh::Index>(places.size());
    const double x = 20.5 * static_cast<double>(mesh.shapes.count());
    std::vector<Mesh::Index> nodes;
    mesh.points.resize(mesh.points.size() + d * places.size());
    for (Mesh::Index i = 0; i < count; ++i) {
        const Mesh::Index own = first + (i + count - 2) % count;
        nodes.push_back(own);
        for (std::size_t k = 0; k < d; ++k)
            mesh.points[d * static_cast<std::size_t>(own) + k] =
                places[static_cast<std::size_t>(i)][k] + (k == 0 ? x : 0.1);
    }
    return nodes;
}

/// Cuts it, and gives it fields, labels and markers.
inline void finish(Mesh& mesh) {
    test::cut(mesh);
    const auto f = [](std::size_t i) { return 0.1 * static_cast<double>(i) - 1.0 / 3; };
    mesh.point_fields = {{"T", 1, {}}, {"velocity", 3, {}}};
    for (std::size_t i = 0; i < mesh.point_count(); ++i) mesh.point_fields[0].data.push_back(f(i));
    for (std::size_t i = 0; i < 3 * mesh.point_count(); ++i) mesh.point_fields[1].data.push_back(f(i * i));
    mesh.cell_fields = {{"p", 1, {}}, {"stress", 6, {}}};
    std::vector<std::string> names;
    for (const Mesh::Index cell : mesh.cell_numbers) {
        const auto own = static_cast<std::size_t>(cell);
        mesh.cell_fields[0].data.push_back(f(own + 100));
        for (std::size_t c = 0; c < 6; ++c) mesh.cell_fields[1].data.push_back(f(6 * own + c));
        names.push_back("cell " + std::to_string(own));
    }
    mesh.cell_labels = {{"name", names}};
    mesh.point_markers.resize(mesh.point_count());
    std::iota(mesh.point_markers.begin(), mesh.point_markers.end(), -3);
}

/// One of each type from 10 to 16, a polyhedron on a face of the hexahedron, and one of eight faces.
inline Mesh all_solids() {
    Mesh mesh;
    std::vector<Mesh::Index> hexahedron;
    for (std::uint8_t type = 10; type <= 16; ++type) {
        const std::vector<Mesh::Index> nodes = add_beside(mesh, type);
        test::add_shape(mesh, type, nodes);
        if (type == 12) hexahedron = nodes;
    }
    // A roof. Nodes of polyhedra ascend: legacy files have their faces only.
    const auto ridge = static_cast<Mesh::Index>(mesh.point_count());
    mesh.points.insert(mesh.points.end(), {44, 0.1, 9, 44, 6.1, 9});
    const Mesh::Index a = hexahedron[4], b = hexahedron[5], c = hexahedron[6], d = hexahedron[7];
    std::vector<Mesh::Index> nodes{a, b, c, d, ridge, ridge + 1};
    std::ranges::sort(nodes);
    test::add_shape(
        mesh, 42, nodes,
        {{a, d, c, b}, {a, b, ridge}, {c, d, ridge + 1}, {b, c, ridge + 1, ridge}, {d, a, ridge, ridge + 1}});
    Rings rings;
    nodes = add_beside(mesh, 16);
    const std::string faces(mesh::cell_type(16).faces);
    std::vector<Mesh::Index> ring;
    for (const char place : faces + ' ') {
        if (place == ' ') {
            rings.push_back(std::exchange(ring, {}));
        } else {
            ring.push_back(nodes[static_cast<std::size_t>(place <= '9' ? place - '0' : place - 'a' + 10)]);
        }
    }
    std::ranges::sort(nodes);
    test::add_shape(mesh, 42, nodes, rings);
    finish(mesh);
    return mesh;
}

/// A triangle, a strip, a polygon, a pixel and a quadrilateral.
inline Mesh all_polygons() {
    Mesh mesh;
    mesh.dimension = 2;
    for (const std::uint8_t type : {std::uint8_t{7}, std::uint8_t{8}, std::uint8_t{9}}) {
        const std::vector<Mesh::Index> nodes = add_beside(mesh, type);
        test::add_shape(mesh, type, nodes);
    }
    const auto first = static_cast<Mesh::Index>(mesh.point_count());
    mesh.points.insert(mesh.points.end(), {70, 0, 71, 1, 72, 0, 73, 1, 74, 0, 75, 1});
    test::add_shape(mesh, 6, {first + 5, first + 4, first + 3, first + 2, first + 1});
    test::add_shape(mesh, 5, {first + 1, first, first + 2});
    finish(mesh);
    return mesh;
}

/// As it is read from a file of VTK.
inline void expect_same_shapes(const Mesh& read, const Mesh& mesh) {
    expect_same(read, mesh);
    EXPECT_TRUE(read.shapes == mesh.shapes);
    EXPECT_EQ(read.cell_numbers, mesh.cell_numbers);
    ASSERT_EQ(read.cell_labels.size(), mesh.cell_labels.size());
    for (std::size_t i = 0; i < mesh.cell_labels.size(); ++i)
        EXPECT_EQ(read.cell_labels[i].values, mesh.cell_labels[i].values);
    EXPECT_EQ(notes_of(read), std::vector<std::string>());
    EXPECT_EQ(notes_of(read, Note::Kind::converted),
              std::vector<std::string>{std::to_string(mesh.shapes.count()) + " cells are cut into " +
                                       std::to_string(mesh.cell_count()) +
                                       (mesh.dimension == 3 ? " tetrahedra" : " triangles") +
                                       ", each cell and face at its node of lowest number"});
}

}  // namespace barycert::testing
