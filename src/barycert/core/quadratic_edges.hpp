/// The edges that mid-edge nodes stand on.
#pragma once

namespace barycert::core {

/// The corners of each edge, in the order of quadratic.hpp; the first three are those of a triangle.
inline constexpr int quadratic_edges[6][2] = {{0, 1}, {1, 2}, {0, 2}, {0, 3}, {1, 3}, {2, 3}};

/// The edge between corners i < j.
constexpr int quadratic_edge(int i, int j) {
    for (int e = 0; e < 6; ++e) {
        if (quadratic_edges[e][0] == i && quadratic_edges[e][1] == j) return e;
    }
    return -1;
}

}  // namespace barycert::core
