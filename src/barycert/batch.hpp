/// How many cases lie in memory for one call.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "barycert/simplex.hpp"

namespace barycert {

/// `count` independent cases in structure of arrays. With d = space_dimension(simplex), coordinate k of vertex i of
/// case j is vertices[d * i + k][j] and that of its point is point[k][j]. The caller owns the arrays; they must live
/// until the call returns.
struct CaseArrays {
    Simplex simplex = Simplex::tetrahedron;
    std::size_t count = 0;
    std::array<const double*, 12> vertices{};
    std::array<const double*, 3> point{};
};

/// Points against cells of a mesh. Case j is cell cells[j] with the point at points[d * j]; its vertex i is node
/// corners[n * cells[j] + i], with coordinates nodes[d * node ...], n = vertex_count(simplex),
/// d = space_dimension(simplex). Requires every index in range: indices are not checked.
struct MeshQueries {
    Simplex simplex = Simplex::tetrahedron;
    std::span<const double> nodes;
    std::span<const std::int32_t> corners;
    std::span<const std::int32_t> cells;
    std::span<const double> points;

    std::size_t count() const { return cells.size(); }
};

/// Nodal values for CaseArrays, T double or float: component c at vertex i of case j is at[i][components * j + c].
template <class T>
struct ValueArrays {
    std::array<const T*, 4> at{};
    int components = 1;
};

/// Nodal values of a mesh, T double or float: component c at node k is data[components * k + c]. A float is converted
/// to double, which is exact.
template <class T>
struct NodalValues {
    std::span<const T> data;
    int components = 1;
};

}  // namespace barycert
