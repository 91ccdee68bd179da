/// Cells for the tests of gradients and quadratic fields, and their exact gradients by elimination.
#pragma once

#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "barycert/simplex.hpp"
#include "core/base/random.hpp"
#include "core/base/text.hpp"
#include "tests/audit/exact/cases.hpp"
#include "tests/audit/exact/second_path.hpp"

namespace barycert::testing_fields {

/// The simplices that fill their space.
inline constexpr std::array<Simplex, 2> full{Simplex::triangle, Simplex::tetrahedron};

/// A number of ordinary size, or of any from 2^-4 to 2^4.
inline double nodal_value(base::Random& r) {
    return r.coin() ? r.uniform(-1, 1) : r.scaled(-1, 1, -4, 4);
}

/// Cells that are round, flat askew to the axes by up to 2^-flattest, anisotropic, far from the origin; the point
/// inside, outside, or level with a vertex. Mostly within the ranges of the double-double tier.
inline Case stretched_cell(base::Random& r, Simplex s, int flattest = 36) {
    Case c{.simplex = s};
    const int n = vertex_count(s), d = space_dimension(s);
    const int flat = r.coin() ? 0 : r.integer(0, flattest);
    const double distance = r.coin() ? 0 : r.scaled(1, 2, 0, 24);
    const double height = std::ldexp(1, -flat);
    for (int i = 0; i < n; ++i) {
        double v[3], mean = 0;
        for (double& x : v) x = r.uniform(-1, 1);
        for (int k = 0; k < d; ++k) mean += v[k] / d;
        for (int k = 0; k < d; ++k) c.vertex(i, k) = v[k] - mean * (1 - height);
        c.values[static_cast<std::size_t>(i)] = nodal_value(r);
    }
    double w[4];
    for (double& x : w) x = r.uniform(-0.5, 1);
    for (int k = 0; k < d; ++k) {
        const int shift = r.integer(0, 3) == 0 ? r.integer(-60, 60) : 0;
        double p = 0;
        for (int i = 0; i < n; ++i) p += w[i] * c.vertex(i, k);
        for (int i = 0; i < n; ++i) c.vertex(i, k) = std::ldexp(c.vertex(i, k) + distance, shift);
        c.point[static_cast<std::size_t>(k)] = std::ldexp(p + distance, shift);
        const bool level = r.integer(0, 9) == 0;
        if (level) c.point[static_cast<std::size_t>(k)] = c.vertex(0, k);
    }
    return c;
}

/// A multiple of 1 of at most 2^bits in magnitude, often the largest that is a double.
inline double of_width(base::Random& r, int bits) {
    const int how = r.integer(0, 3);
    const double sign = r.coin() ? 1 : -1;
    if (how < 2) return sign * (std::ldexp(1, bits) - std::ldexp(1, bits > 53 ? bits - 53 : 0));
    return how == 2 ? sign * std::trunc(std::ldexp(r.uniform(0, 1), bits)) : sign * r.integer(0, 1);
}

/// A cell, point and values whose coordinates and values need about so many bits as integers.
inline Case case_of_widths(base::Random& r, Simplex s, int coordinate_bits, int value_bits) {
    Case c{.simplex = s};
    for (double& x : c.vertices) x = of_width(r, coordinate_bits);
    for (double& x : c.point) x = of_width(r, coordinate_bits);
    for (double& f : c.values) f = of_width(r, value_bits);
    // An odd number in each: the unit is 1.
    for (int k = 0; k < space_dimension(s); ++k) c.vertex(0, k) = r.coin() ? 1 : -1;
    c.values[0] = 1;
    return c;
}

/// The exact gradient of the values at the vertices; nothing if degenerate.
inline std::optional<std::vector<mpq_class>> exact_gradient(const Case& c) {
    using second_path::Q;
    auto rows = second_path::edges(c);
    const std::size_t d = rows.size();
    for (std::size_t j = 0; j < d; ++j) rows[j].push_back(Q(c.values[j + 1]) - Q(c.values[0]));
    if (second_path::eliminate(rows, d) < d) return std::nullopt;
    std::vector<Q> g;
    for (const auto& row : rows) g.push_back(row[d]);
    return g;
}

/// A case with values at the mid-edge nodes besides, in the order of weights.hpp.
struct QuadraticCase {
    Case linear;
    std::vector<double> mids;

    /// Corners first.
    std::vector<double> nodal() const {
        const auto n = static_cast<std::ptrdiff_t>(vertex_count(linear.simplex));
        std::vector<double> all(linear.values.begin(), linear.values.begin() + n);
        all.insert(all.end(), mids.begin(), mids.end());
        return all;
    }
};

inline std::string describe(const QuadraticCase& q) {
    std::string text = testing_cases::describe(q.linear) + "\n  mids";
    for (const double f : q.mids) text += ' ' + base::hexadecimal(f);
    return text;
}

/// The corners of edge e.
inline std::array<int, 2> edge(std::size_t e) {
    constexpr std::array<std::array<int, 2>, 6> edges{{{0, 1}, {1, 2}, {0, 2}, {0, 3}, {1, 3}, {2, 3}}};
    return edges[e];
}

/// The exact value by the formula as it stands; nothing if degenerate.
inline std::optional<mpq_class> exact_quadratic(const QuadraticCase& q) {
    using second_path::Q;
    const auto l = second_path::weights(q.linear);
    if (!l) return std::nullopt;
    Q sum(0);
    for (std::size_t i = 0; i < l->size(); ++i) sum += (*l)[i] * (2 * (*l)[i] - 1) * Q(q.linear.values[i]);
    for (std::size_t e = 0; e < q.mids.size(); ++e) {
        const auto [i, j] = edge(e);
        sum += 4 * (*l)[static_cast<std::size_t>(i)] * (*l)[static_cast<std::size_t>(j)] * Q(q.mids[e]);
    }
    return sum;
}

}  // namespace barycert::testing_fields
