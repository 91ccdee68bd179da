/// Random meshes for the tests of files. Cells are random too: a file says nothing about geometry.
#pragma once

#include <bit>
#include <cmath>
#include <string>
#include <vector>

#include "barycert/mesh.hpp"
#include "core/base/random.hpp"
#include "mesh/mid_edges.hpp"

namespace barycert::testing {

/// Any finite double, each bit pattern equally likely, and now and then one of the ends of the range.
inline double any_double(base::Random& random) {
    constexpr double special[] = {0.0,
                                  -0.0,
                                  5e-324,
                                  -5e-324,
                                  0x1.fffffffffffffp-1023,
                                  0x1p-1022,
                                  0x1.fffffffffffffp+1023,
                                  -0x1.fffffffffffffp+1023,
                                  1.0,
                                  0.1,
                                  1e22,
                                  1e23,
                                  123456789012345678.0};
    if (random.below(8) == 0) return special[random.below(std::size(special))];
    while (true) {
        const double x = std::bit_cast<double>(random.bits());
        if (std::isfinite(x)) return x;
    }
}

inline std::vector<double> any_doubles(base::Random& random, std::size_t count) {
    std::vector<double> values(count);
    for (double& value : values) value = any_double(random);
    return values;
}

inline std::vector<Mesh::Index> any_indices(base::Random& random, std::size_t count, std::size_t limit) {
    std::vector<Mesh::Index> values(count);
    for (Mesh::Index& value : values) value = static_cast<Mesh::Index>(random.below(limit));
    return values;
}

inline std::vector<std::int64_t> any_markers(base::Random& random, std::size_t count) {
    std::vector<std::int64_t> values(count);
    for (std::int64_t& value : values) value = static_cast<std::int64_t>(random.bits() >> random.below(64));
    return values;
}

/// A linear mesh with everything a set of files can hold, each part there or not by chance.
inline Mesh any_mesh(base::Random& random) {
    Mesh mesh;
    mesh.dimension = random.integer(2, 3);
    mesh.index_base = random.integer(0, 1);
    const auto nodes = static_cast<std::size_t>(random.integer(1, 12));
    const auto cells = static_cast<std::size_t>(random.integer(0, 12));
    mesh.points = any_doubles(random, nodes * static_cast<std::size_t>(mesh.dimension));
    mesh.cells = any_indices(random, cells * mesh.corners(), nodes);
    for (std::uint64_t i = random.below(3), k = 0; k < i; ++k) {
        mesh.point_fields.push_back({"attribute" + std::to_string(k), 1, any_doubles(random, nodes)});
    }
    for (std::uint64_t i = random.below(3), k = 0; cells != 0 && k < i; ++k) {
        mesh.cell_fields.push_back({"attribute" + std::to_string(k), 1, any_doubles(random, cells)});
    }
    if (random.coin()) mesh.point_markers = any_markers(random, nodes);
    if (mesh.dimension == 3 && random.coin()) {
        const auto faces = static_cast<std::size_t>(random.integer(1, 9));
        mesh.faces = any_indices(random, faces * 3, nodes);
        if (random.coin()) mesh.face_mid_nodes = any_indices(random, faces * 3, nodes);
        if (random.coin()) mesh.face_markers = any_markers(random, faces);
    }
    if (random.coin() && cells != 0) {
        mesh.neighbours = any_indices(random, mesh.cells.size(), cells + 1);
        for (Mesh::Index& cell : mesh.neighbours) --cell;
    }
    return mesh;
}

inline std::vector<MidEdgeOrder> orders_in(int dimension) {
    if (dimension == 2) return {MidEdgeOrder::vtk, MidEdgeOrder::triangle};
    return {MidEdgeOrder::vtk, MidEdgeOrder::tetgen15, MidEdgeOrder::gmsh};
}

/// Cells apart from each other with nodes at their mid-edges, moved by up to `bend` of the cell's size.
inline Mesh second_order_mesh(int dimension, MidEdgeOrder order, std::size_t cells, std::uint64_t seed,
                              double scale = 1, double bend = 0) {
    base::Random random(seed);
    Mesh mesh;
    mesh.dimension = dimension;
    mesh.mid_edge_order = order;
    const auto size = static_cast<std::size_t>(dimension);
    for (std::size_t cell = 0; cell < cells; ++cell) {
        std::vector<std::vector<double>> corners;
        for (std::size_t i = 0; i <= size; ++i) {  // a corner of the unit cell, moved a little: never degenerate
            std::vector<double> corner(size);
            for (std::size_t axis = 0; axis < size; ++axis) {
                corner[axis] = (axis + 1 == i ? 1.0 : 0.0) + random.uniform(-0.1, 0.1);
            }
            corners.push_back(corner);
        }
        const auto add = [&](std::vector<Mesh::Index>& to, std::size_t a, std::size_t b, double noise) {
            to.push_back(static_cast<Mesh::Index>(mesh.point_count()));
            for (std::size_t axis = 0; axis < size; ++axis) {
                mesh.points.push_back(scale *
                                      (0.5 * (corners[a][axis] + corners[b][axis]) + random.uniform(-noise, noise)));
            }
        };
        for (std::size_t i = 0; i <= size; ++i) add(mesh.cells, i, i, 0);
        for (const auto& [a, b] : mesh::edges_of(dimension)) add(mesh.mid_nodes, a, b, bend);
    }
    return mesh;
}

}  // namespace barycert::testing
