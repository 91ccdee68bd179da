/// Second-order meshes whose outer mid-edge nodes lie on a sphere or a circle.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <utility>

#include "barycert/mesh.hpp"
#include "mesh/mid_edges.hpp"

namespace barycert::testing {

/// With a node in the middle of each edge, rounded once.
inline Mesh second_order(Mesh mesh) {
    std::map<std::pair<Mesh::Index, Mesh::Index>, Mesh::Index> middle;
    const auto d = static_cast<std::size_t>(mesh.dimension);
    for (std::size_t cell = 0; cell < mesh.cell_count(); ++cell) {
        for (const auto& edge : mesh::edges_of(mesh.dimension)) {
            const Mesh::Index a = mesh.cells[cell * (d + 1) + edge[0]], b = mesh.cells[cell * (d + 1) + edge[1]];
            const auto next = static_cast<Mesh::Index>(mesh.point_count());
            const auto [at, is_new] = middle.try_emplace(std::minmax(a, b), next);
            mesh.mid_nodes.push_back(at->second);
            if (!is_new) continue;
            for (std::size_t k = 0; k < d; ++k)
                mesh.points.push_back(mesh.points[d * static_cast<std::size_t>(a) + k] / 2 +
                                      mesh.points[d * static_cast<std::size_t>(b) + k] / 2);
        }
    }
    mesh.mid_edge_order = MidEdgeOrder::vtk;
    return mesh;
}

/// The cells around the origin whose other vertices are those of an octahedron, in the plane of a square.
inline Mesh straight_ball(int dimension) {
    Mesh mesh;
    mesh.dimension = dimension;
    const auto d = static_cast<std::size_t>(dimension);
    mesh.points.assign(d, 0);
    for (std::size_t k = 0; k < 2 * d; ++k) {
        for (std::size_t axis = 0; axis < d; ++axis)
            mesh.points.push_back(axis != k / 2 ? 0.0 : k % 2 == 0 ? 1.0 : -1.0);
    }
    for (unsigned octant = 0; octant < 1U << d; ++octant) {
        mesh.cells.push_back(0);
        for (unsigned k = 0; k < d; ++k) mesh.cells.push_back(static_cast<Mesh::Index>(1 + 2 * k + (octant >> k & 1U)));
    }
    return second_order(std::move(mesh));
}

/// The same with the nodes amid the outer edges moved outwards by `part` of the way to the sphere: with 1 they are off
/// the middle by (1 - sqrt(1/2)) / sqrt(2) of the edge, about 0.207.
inline Mesh curved_ball(int dimension, double part = 1) {
    Mesh mesh = straight_ball(dimension);
    const auto d = static_cast<std::size_t>(dimension);
    for (std::size_t i = 0; i < mesh.points.size(); i += d) {
        double square = 0;
        for (std::size_t k = 0; k < d; ++k) square += mesh.points[i + k] * mesh.points[i + k];
        if (square != 0.5) continue;  // nodes amid inner edges have 1/4
        for (std::size_t k = 0; k < d; ++k) mesh.points[i + k] *= 1 + part * (std::sqrt(2.0) - 1);
    }
    return mesh;
}

inline const double deviation_of_ball = (1 - std::sqrt(0.5)) / std::sqrt(2.0);

}  // namespace barycert::testing
