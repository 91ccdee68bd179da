/// The same answers by other means: linear systems solved by elimination in GMP's rationals, and rounding read off its
/// definition. Shares nothing with the oracle but the question.
#pragma once

#include <gmpxx.h>

#include <array>
#include <bit>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "barycert/simplex.hpp"

namespace barycert::second_path {

using Q = mpq_class;
using Row = std::vector<Q>;

inline Q power_of_two(int exponent) {
    Q x(1);
    if (exponent >= 0) {
        mpq_mul_2exp(x.get_mpq_t(), x.get_mpq_t(), static_cast<mp_bitcnt_t>(exponent));
    } else {
        mpq_div_2exp(x.get_mpq_t(), x.get_mpq_t(), static_cast<mp_bitcnt_t>(-exponent));
    }
    return x;
}

/// The positive double nearest to a target, ties to even. `target_against(m)` is the sign of target - m.
/// By bisection: the bit patterns of positive doubles are ordered as the doubles are, and one past the largest is
/// infinity, which for rounding stands for 2^1024.
template <class Compare>
double nearest_positive(const Compare& target_against) {
    const std::uint64_t infinity = 0x7ff0000000000000ULL;
    const auto number = [&](std::uint64_t word) {
        return word == infinity ? power_of_two(1024) : Q(std::bit_cast<double>(word));
    };
    std::uint64_t low = 0, high = infinity;  // number(low) <= target; target < number(high), or overflow
    while (high - low > 1) {
        const std::uint64_t middle = low + (high - low) / 2;
        (target_against(number(middle)) >= 0 ? low : high) = middle;
    }
    const int side = target_against((number(low) + number(high)) / 2);
    if (side > 0 || (side == 0 && low % 2 != 0)) low = high;
    return std::bit_cast<double>(low);
}

/// x rounded to nearest, ties to even. Zero is +0; what underflows to zero keeps its sign.
inline double nearest(const Q& x) {
    if (x == 0) return 0.0;
    const Q target = abs(x);
    const double r = nearest_positive([&](const Q& m) { return cmp(target, m); });
    return x < 0 ? -r : r;
}

/// sqrt(x) rounded to nearest, by comparing squares. Requires: x >= 0.
inline double nearest_root(const Q& x) {
    if (x == 0) return 0.0;
    return nearest_positive([&](const Q& m) { return cmp(x, Q(m * m)); });
}

/// Brings rows to echelon form over the first `columns` columns; returns the rank.
inline std::size_t eliminate(std::vector<Row>& rows, std::size_t columns) {
    std::size_t rank = 0;
    for (std::size_t column = 0; column < columns && rank < rows.size(); ++column) {
        std::size_t pivot = rank;
        while (pivot < rows.size() && rows[pivot][column] == 0) ++pivot;
        if (pivot == rows.size()) continue;
        std::swap(rows[rank], rows[pivot]);
        const Q inverse = 1 / rows[rank][column];
        for (Q& x : rows[rank]) x *= inverse;
        for (std::size_t other = 0; other < rows.size(); ++other) {
            if (other == rank || rows[other][column] == 0) continue;
            const Q factor = rows[other][column];
            for (std::size_t k = column; k < rows[other].size(); ++k) rows[other][k] -= factor * rows[rank][k];
        }
        ++rank;
    }
    return rank;
}

/// The edges from vertex 0, one row each.
inline std::vector<Row> edges(const Case& c) {
    std::vector<Row> e;
    for (int i = 1; i < vertex_count(c.simplex); ++i) {
        Row row;
        for (int axis = 0; axis < space_dimension(c.simplex); ++axis)
            row.push_back(Q(c.vertex(i, axis)) - Q(c.vertex(0, axis)));
        e.push_back(row);
    }
    return e;
}

inline int affine_dimension(const Case& c) {
    auto rows = edges(c);
    return static_cast<int>(eliminate(rows, rows[0].size()));
}

/// Ray casting: beta_0, beta_1, beta_2 and Z with sum beta_i (x_i w_i, y_i w_i, w_i) = Z (x, y, 1) and sum beta_i = 1;
/// nothing if there are none, or if the plane of the triangle holds the eye.
inline std::optional<std::vector<Q>> cast_ray(const Case& c) {
    std::vector<Row> rows(3), all;
    for (int i = 0; i < 3; ++i) {
        const Q w(c.depth(i));
        rows[0].push_back(Q(c.vertex(i, 0)) * w);
        rows[1].push_back(Q(c.vertex(i, 1)) * w);
        rows[2].push_back(w);
    }
    all = rows;
    if (eliminate(rows, 3) < 3) return std::nullopt;
    const Q ray[3] = {Q(c.point[0]), Q(c.point[1]), Q(1)};
    for (std::size_t k = 0; k < 3; ++k) {
        all[k].push_back(-ray[k]);
        all[k].emplace_back(0);
    }
    all.push_back({Q(1), Q(1), Q(1), Q(0), Q(1)});
    if (eliminate(all, 4) < 4) return std::nullopt;
    return std::vector<Q>{all[0][4], all[1][4], all[2][4], all[3][4]};
}

/// Exact weights; nothing if degenerate. Full-dimensional simplices: sum of weights 1, sum of weight times vertex = p.
/// Others: least squares over the edges, whose normal equations have the Gram matrix.
inline std::optional<std::vector<Q>> weights(const Case& c) {
    if (c.perspective) {
        auto cast = cast_ray(c);
        if (cast) cast->pop_back();
        return cast;
    }
    const auto count = static_cast<std::size_t>(vertex_count(c.simplex));
    const int dimension = space_dimension(c.simplex);
    std::vector<Row> rows;
    if (static_cast<int>(count) == dimension + 1) {
        rows.emplace_back(count + 1, Q(1));
        for (int axis = 0; axis < dimension; ++axis) {
            Row row;
            for (int i = 0; i < vertex_count(c.simplex); ++i) row.emplace_back(c.vertex(i, axis));
            row.emplace_back(c.point[static_cast<std::size_t>(axis)]);
            rows.push_back(row);
        }
        if (eliminate(rows, count) < count) return std::nullopt;
        std::vector<Q> w;
        for (std::size_t i = 0; i < count; ++i) w.push_back(rows[i][count]);
        return w;
    }
    const auto e = edges(c);
    for (const Row& a : e) {
        Row row;
        for (const Row& b : e) row.push_back(a[0] * b[0] + a[1] * b[1] + a[2] * b[2]);
        Q right(0);
        for (std::size_t k = 0; k < 3; ++k) right += a[k] * (Q(c.point[k]) - Q(c.vertex(0, static_cast<int>(k))));
        row.push_back(right);
        rows.push_back(row);
    }
    if (eliminate(rows, e.size()) < e.size()) return std::nullopt;
    std::vector<Q> w{Q(1)};
    for (std::size_t i = 0; i < e.size(); ++i) {
        w.push_back(rows[i][e.size()]);
        w[0] -= rows[i][e.size()];
    }
    return w;
}

}  // namespace barycert::second_path
