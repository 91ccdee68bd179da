/// The places where values and weights are computed: the nodes of a cell, and the part of a mesh nearest to a point
/// outside.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "barycert/mesh.hpp"
#include "barycert/simplex.hpp"
#include "barycert/weights.hpp"
#include "mesh/locate/near_feature.hpp"

namespace barycert::sample {

/// The nodes of a cell: corners and, if it is of second order, behind them those at mid-edges.
struct CellNodes {
    std::array<Mesh::Index, 10> at{};
    std::size_t count = 0;

    CellNodes(const Mesh& mesh, std::size_t cell) : count(mesh.corners()) {
        std::copy_n(&mesh.cells[count * cell], count, at.begin());
        if (mesh.mid_nodes.empty()) return;
        const auto mids =
            static_cast<std::size_t>(mid_node_count(mesh.dimension == 2 ? Simplex::triangle : Simplex::tetrahedron));
        std::copy_n(&mesh.mid_nodes[mids * cell], mids, at.begin() + count);
        count += mids;
    }
    const Mesh::Index* begin() const { return at.data(); }
    const Mesh::Index* end() const { return at.data() + count; }
};

/// A point of a cell with unit vectors and the origin as corners. Whatever depends on weights alone, such as a
/// quadratic, is there what it is at the point of the cell that has the same weights.
struct ReferencePoint {
    std::array<double, 12> vertices{};
    std::array<double, 3> at{};
};

/// The point of the closed cell that has the rounded weights of a projection to the feature, but for the largest one,
/// which is 1 less the others, exactly: these are at most 1/2, and 2/3 together. The others are coordinates, and the
/// corner of the largest weight is the origin.
inline ReferencePoint reference_point(const Mesh& mesh, std::size_t cell, const locate::NearFeature& feature,
                                      const std::array<double, 3>& weights) {
    const std::size_t d = static_cast<std::size_t>(mesh.dimension), corners = d + 1;
    std::array<double, 4> of_corner{};
    for (std::size_t i = 0; i < corners; ++i) {
        for (std::size_t j = 0; j < static_cast<std::size_t>(feature.count); ++j) {
            if (feature.nodes[j] == mesh.cells[corners * cell + i]) of_corner[i] = weights[j];
        }
    }
    const auto origin =
        static_cast<std::size_t>(std::max_element(of_corner.begin(), of_corner.end()) - of_corner.begin());
    ReferencePoint out;
    for (std::size_t i = 0, k = 0; i < corners; ++i) {
        if (i == origin) continue;
        out.vertices[d * i + k] = 1;
        out.at[k++] = of_corner[i];
    }
    return out;
}

}  // namespace barycert::sample
