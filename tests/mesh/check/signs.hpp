/// Signed volumes by other means: exact in GMP's rationals, and as plain double arithmetic has them.
#pragma once

#include <array>
#include <cstddef>

#include "barycert/mesh.hpp"
#include "tests/audit/exact/second_path.hpp"

namespace barycert::testing {

/// det(p1 - p0, p2 - p0[, p3 - p0]): d! times the signed volume. Requires: indices in range; exact: finite.
template <class N>
N determinant(const Mesh& mesh, std::size_t cell) {
    const auto d = static_cast<std::size_t>(mesh.dimension);
    std::array<std::array<N, 3>, 3> e{};
    for (std::size_t i = 0; i < d; ++i) {
        for (std::size_t k = 0; k < d; ++k) {
            const auto at = [&](std::size_t corner) {
                return N(mesh.points[static_cast<std::size_t>(mesh.cells[cell * (d + 1) + corner]) * d + k]);
            };
            e[i][k] = at(i + 1) - at(0);
        }
    }
    if (d == 2) return e[0][0] * e[1][1] - e[0][1] * e[1][0];
    return e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) + e[0][1] * (e[1][2] * e[2][0] - e[1][0] * e[2][2]) +
           e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0]);
}

inline int exact_sign(const Mesh& mesh, std::size_t cell) {
    return sgn(determinant<second_path::Q>(mesh, cell));
}

/// 0 for NaN, which is no sign either.
inline int plain_sign(const Mesh& mesh, std::size_t cell) {
    const double v = determinant<double>(mesh, cell);
    return v > 0 ? 1 : v < 0 ? -1 : 0;
}

/// Correctly rounded.
inline double exact_volume(const Mesh& mesh, std::size_t cell) {
    return second_path::nearest(determinant<second_path::Q>(mesh, cell) / (mesh.dimension == 2 ? 2 : 6));
}

}  // namespace barycert::testing
