/// Meshes and fields to cut: whatever makes it hard.
#pragma once

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "core/base/random.hpp"
#include "tests/core/rational.hpp"
#include "tests/mesh/check/meshes.hpp"

namespace barycert::testing {

inline constexpr int field_kinds = 8;

/// A number for a field; the kinds are those of difficulties.
inline double field_number(base::Random& r, int kind) {
    switch (kind) {
        case 0:
            return r.integer(-1, 1);  // plateaus
        case 1:
            return r.uniform(-1, 1);
        case 2:
            return r.integer(-3, 3) * 0x1p-1074;
        case 3:
            return testing_rational::any_finite(r);
        case 4:
            return 1 + r.integer(-3, 3) * 0x1p-52;
        case 5:
            return std::ldexp(r.uniform(-1, 1), 1024);
        case 6:
            return std::ldexp(r.uniform(-1, 1), r.integer(-1021, -1018));  // remainders of products underflow
        default: {
            const int what = r.integer(0, 9);
            if (what == 0) return std::numeric_limits<double>::quiet_NaN();
            if (what == 1) return std::numeric_limits<double>::infinity();
            if (what == 2) return -std::numeric_limits<double>::infinity();
            return r.integer(-2, 2);
        }
    }
}

inline Field random_field(base::Random& r, const std::string& name, std::size_t rows, int components, int kind) {
    Field f{name, components, {}};
    for (std::size_t i = 0; i < rows * static_cast<std::size_t>(components); ++i)
        f.data.push_back(field_number(r, kind));
    return f;
}

/// Values at which it matters: those of nodes, and between.
inline double level_of(base::Random& r, const Field& f, int component) {
    const auto components = static_cast<std::size_t>(f.components);
    double x = 0;
    for (int i = 0; i < 20; ++i) {
        x = f.data[components * r.below(f.data.size() / components) + static_cast<std::size_t>(component)];
        if (std::isfinite(x)) break;
    }
    if (!std::isfinite(x)) return 0;
    const int how = r.integer(0, 3);
    return how == 0 ? x / 2 : how == 1 ? 0 : x;
}

/// A box whose nodes are moved a little: by whole lattice steps of 1/16, or by any doubles; cells and corners in any
/// order, some turned over.
inline Mesh moved_box(base::Random& r, int d) {
    const int nx = r.integer(1, 3), ny = r.integer(1, 3), nz = r.integer(1, 2);
    Mesh mesh = box(d, {nx, ny, nz});
    const bool lattice = r.coin();
    const int shift = r.integer(0, 3) == 0 ? r.integer(-300, 300) : 0;
    for (double& x : mesh.points) {
        const double by = lattice ? r.integer(-2, 2) / 16.0 : r.uniform(-0.125, 0.125);
        x = std::ldexp(x + by, shift);
        if (x == 0 && r.coin()) x = -0.0;
    }
    mesh = renumbered(mesh, r);
    if (r.coin()) flip_some(mesh, r);
    return mesh;
}

}  // namespace barycert::testing
