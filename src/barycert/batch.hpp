/// Many cases at once: how they lie in memory.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "barycert/simplex.hpp"

namespace barycert {

/// `count` independent cases in structure of arrays. With d = space_dimension(simplex), coordinate k of vertex i of
/// case j is vertices[d * i + k][j] and that of its point is point[k][j]. The caller keeps the arrays.
struct CaseArrays {
    Simplex simplex = Simplex::tetrahedron;
    std::size_t count = 0;
    std::array<const double*, 12> vertices{};
    std::array<const double*, 3> point{};
};

/// Points to be tested against cells of a mesh. Case j is cell cells[j] with the point at points[d * j]; its vertex i
/// is node corners[n * cells[j] + i], with coordinates nodes[d * node ...], n = vertex_count, d = space_dimension.
/// Precondition: every index in range.
struct MeshQueries {
    Simplex simplex = Simplex::tetrahedron;
    std::span<const double> nodes;
    std::span<const std::int32_t> corners;
    std::span<const std::int32_t> cells;
    std::span<const double> points;

    std::size_t count() const { return cells.size(); }
};

/// Nodal values of `components` numbers for CaseArrays: component c at vertex i of case j is at[i][components * j + c].
template <class T>
struct ValueArrays {
    std::array<const T*, 4> at{};
    int components = 1;
};

/// Nodal values of a mesh: component c at node k is data[components * k + c]. Float is taken for the double it is.
template <class T>
struct NodalValues {
    std::span<const T> data;
    int components = 1;
};

}  // namespace barycert
