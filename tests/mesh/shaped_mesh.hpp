/// Meshes of cells of all shapes, to be cut.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

#include "core/vtk_cell.hpp"
#include "mesh/cell_types.hpp"
#include "mesh/pulling.hpp"

namespace barycert::test {

/// Places of the corners of one cell of the type, convex, with integer coordinates, in VTK's order.
inline std::vector<std::array<int, 3>> places_of(std::uint8_t type) {
    switch (type) {
        case 10:
            return {{0, 0, 0}, {6, 0, 0}, {0, 6, 0}, {0, 0, 6}};
        case 11:
            return {{0, 0, 0}, {6, 0, 0}, {0, 6, 0}, {6, 6, 0}, {0, 0, 6}, {6, 0, 6}, {0, 6, 6}, {6, 6, 6}};
        case 12:
            return {{0, 0, 0}, {6, 0, 0}, {6, 6, 0}, {0, 6, 0}, {0, 0, 6}, {6, 0, 6}, {6, 6, 6}, {0, 6, 6}};
        case 13:
            return {{0, 0, 0}, {0, 6, 0}, {6, 0, 0}, {0, 0, 6}, {0, 6, 6}, {6, 0, 6}};
        case 14:
            return {{0, 0, 0}, {6, 0, 0}, {6, 6, 0}, {0, 6, 0}, {3, 3, 6}};
        case 15:
            return {{0, 0, 0}, {6, 0, 0}, {8, 4, 0}, {4, 8, 0}, {-2, 4, 0},
                    {0, 0, 6}, {6, 0, 6}, {8, 4, 6}, {4, 8, 6}, {-2, 4, 6}};
        case 16:
            return {{0, 0, 0}, {4, 0, 0}, {8, 4, 0}, {8, 8, 0}, {4, 8, 0}, {0, 4, 0},
                    {0, 0, 6}, {4, 0, 6}, {8, 4, 6}, {8, 8, 6}, {4, 8, 6}, {0, 4, 6}};
        case 7:
            return {{0, 0, 0}, {4, 0, 0}, {8, 4, 0}, {8, 8, 0}, {4, 8, 0}, {0, 4, 0}};
        case 8:
            return {{0, 0, 0}, {6, 0, 0}, {0, 6, 0}, {6, 6, 0}};
        case 9:
            return {{0, 0, 0}, {6, 0, 0}, {8, 4, 0}, {0, 6, 0}};
        default:
            return {};
    }
}

inline void add_shape(Mesh& mesh, std::uint8_t type, const std::vector<Mesh::Index>& nodes,
                      const std::vector<std::vector<Mesh::Index>>& rings = {}) {
    Mesh::Shapes& s = mesh.shapes;
    s.types.push_back(type);
    s.nodes.insert(s.nodes.end(), nodes.begin(), nodes.end());
    s.ends.push_back(static_cast<std::int64_t>(s.nodes.size()));
    if (rings.empty() && s.face_ends.empty()) return;
    s.face_ends.resize(s.types.size() - 1, static_cast<std::int64_t>(s.ring_ends.size()));
    for (const auto& ring : rings) {
        s.rings.insert(s.rings.end(), ring.begin(), ring.end());
        s.ring_ends.push_back(static_cast<std::int64_t>(s.rings.size()));
    }
    s.face_ends.push_back(static_cast<std::int64_t>(s.ring_ends.size()));
}

/// Cut, and numbered: cell_numbers[part] is the number of the shape.
inline void cut(Mesh& mesh) {
    ASSERT_FALSE(mesh::pull(mesh).has_value());
    mesh.cell_numbers.clear();
    for (std::size_t i = 0; i < mesh.shapes.count(); ++i)
        mesh.cell_numbers.insert(mesh.cell_numbers.end(),
                                 static_cast<std::size_t>(mesh.shapes.parts[i + 1] - mesh.shapes.parts[i]),
                                 static_cast<Mesh::Index>(i));
}

/// One cell, whose corner i is node order[i]. `as_polyhedron`: by its faces.
inline Mesh one_cell(std::uint8_t type, const std::vector<Mesh::Index>& order, bool as_polyhedron = false) {
    const auto places = places_of(type);
    Mesh mesh;
    mesh.dimension = mesh::cell_type(type).dimension();
    const auto d = static_cast<std::size_t>(mesh.dimension);
    mesh.points.resize(d * places.size());
    for (std::size_t i = 0; i < places.size(); ++i) {
        for (std::size_t k = 0; k < d; ++k) mesh.points[d * static_cast<std::size_t>(order[i]) + k] = places[i][k];
    }
    std::vector<std::vector<Mesh::Index>> rings;
    if (as_polyhedron) {
        for (const auto& places_of_ring : mesh::rings_of(type)) {
            auto& ring = rings.emplace_back();
            for (const Mesh::Index place : places_of_ring) ring.push_back(order[static_cast<std::size_t>(place)]);
        }
    }
    add_shape(mesh, as_polyhedron ? std::uint8_t{vtk_polyhedron} : type, order, rings);
    return mesh;
}

/// Twice the area or six times the volume of a part, in integers.
inline std::int64_t measure(const Mesh& mesh, std::size_t part) {
    const auto at = [&](std::size_t corner, std::size_t k) {
        const auto node = static_cast<std::size_t>(mesh.cells[part * mesh.corners() + corner]);
        return static_cast<std::int64_t>(mesh.points[node * static_cast<std::size_t>(mesh.dimension) + k]);
    };
    std::array<std::array<std::int64_t, 3>, 3> e{};
    for (std::size_t i = 0; i + 1 < mesh.corners(); ++i) {
        for (std::size_t k = 0; k + 1 < mesh.corners(); ++k) e[i][k] = at(i + 1, k) - at(0, k);
    }
    if (mesh.dimension == 2) return e[0][0] * e[1][1] - e[0][1] * e[1][0];
    return e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) - e[0][1] * (e[1][0] * e[2][2] - e[1][2] * e[2][0]) +
           e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0]);
}

}  // namespace barycert::test
