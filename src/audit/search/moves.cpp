#include "audit/search/moves.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "audit/recipes.hpp"
#include "audit/search/evaluation.hpp"
#include "barycert/simplex.hpp"
#include "core/base/random.hpp"
#include "core/base/ulp.hpp"

namespace barycert::audit {
namespace {

int pick(base::Random& random, int count) {
    return static_cast<int>(random.below(static_cast<std::uint64_t>(count)));
}

/// 1, 2, 4, ... : each half as likely as the one before, at most 2^limit.
std::int64_t small_power(base::Random& random, int limit) {
    int e = 0;
    while (e < limit && random.coin()) ++e;
    return std::int64_t{1} << e;
}

double with_sign(base::Random& random, double x) {
    return random.coin() ? x : -x;
}

/// A number with that exponent and a significand of `bits` random bits.
double drawn(base::Random& random, int exponent, int bits) {
    const double m = 1 + std::ldexp(std::floor(std::ldexp(random.unit(), bits - 1)), 1 - bits);
    return std::ldexp(m, exponent);
}

/// Zero moves by the ulp of the largest on its axis: its neighbours would be subnormal.
double moved_by_ulps(const Case& c, int k, std::int64_t ulps) {
    const double x = coordinate(c, k);
    if (x != 0) return base::places_above(x, ulps);
    double max = 0;
    for (int j = 0; j < coordinate_count(c); ++j) {
        if (axis_of(c, j) == axis_of(c, k)) max = std::max(max, std::fabs(coordinate(c, j)));
    }
    return std::ldexp(static_cast<double>(ulps), base::ulp_exponent(max == 0 ? 1.0 : max));
}

void redraw_significand(Case& c, base::Random& random) {
    double& x = coordinate(c, pick(random, coordinate_count(c)));
    if (x == 0) return;
    const int exponent = std::ilogb(x);
    if (exponent < -1022) return;
    if (const int kind = pick(random, 3); kind < 2) {
        x = std::copysign(drawn(random, exponent, kind == 0 ? 53 : 1 + pick(random, 53)), x);
    } else {  // the last bits alone
        const auto span = static_cast<double>(std::int64_t{1} << pick(random, 40));
        x = base::places_above(x, static_cast<std::int64_t>(random.uniform(-span, span)));
    }
}

/// One number, all of an axis, of a vertex, or all.
void shift_exponents(Case& c, base::Random& random) {
    const int k = pick(random, coordinate_count(c)), axis = axis_of(c, k);
    int by = pick(random, 8) == 0 ? random.integer(-60, 60) : random.integer(-3, 3);
    if (by == 0) by = 1;
    const int kind = pick(random, 8);
    for (int j = 0; j < coordinate_count(c); ++j) {
        const bool chosen = kind < 5   ? j == k
                            : kind < 6 ? axis_of(c, j) == axis
                            : kind < 7 ? j / c.stride() == k / c.stride()
                                       : true;
        if (chosen) coordinate(c, j) = std::ldexp(coordinate(c, j), by);
    }
}

void take_from_another(Case& c, base::Random& random) {
    const int k = pick(random, coordinate_count(c));
    const int kind = pick(random, 8);
    if (kind == 0 && !is_depth(c, k)) {
        coordinate(c, k) = 0;
    } else if (kind == 1 && !is_depth(c, k)) {
        coordinate(c, k) = -coordinate(c, k);
    } else {
        const int j = pick(random, coordinate_count(c));
        if (axis_of(c, j) == axis_of(c, k) || kind == 2) coordinate(c, k) = coordinate(c, j);
        if (is_depth(c, k)) coordinate(c, k) = std::fabs(coordinate(c, k));
    }
}

/// Into the cell, one of its faces or edges, or onto a vertex.
void point_between(Case& c, base::Random& random) {
    const int n = vertex_count(c.simplex);
    const int first = pick(random, n), size = 1 + pick(random, n);
    const std::array<double, 4> drawn_weights = random_weights(random, size);
    std::array<double, 4> w{};
    for (int i = 0; i < size; ++i)
        w[static_cast<std::size_t>((first + i) % n)] = drawn_weights[static_cast<std::size_t>(i)];
    c.point = combination(c, w, n);
}

}  // namespace

Case patterned_case(Simplex simplex, bool perspective, const ExponentRange& range, base::Random& random) {
    Case c{.simplex = simplex, .perspective = perspective};
    const int count = coordinate_count(c);
    const int low = std::clamp(-1022, range.min, range.max);  // significands are drawn with all their bits
    // Ordinary sizes half of the time, else anywhere.
    const int middle = std::clamp(random.coin() ? 0 : random.integer(low, range.max), low, range.max);
    const int width = static_cast<int>(small_power(random, 10)) - 1;
    const auto exponent = [&] { return std::clamp(random.integer(middle - width, middle + width), low, range.max); };
    const int kind = pick(random, 4);
    const int bits = random.coin() ? 53 : 1 + pick(random, 53);
    std::array<int, 5> shared{};
    for (int& e : shared) e = exponent();
    for (int k = 0; k < count; ++k) {
        const int own = exponent();
        const int e = kind == 0   ? middle
                      : kind == 1 ? shared[static_cast<std::size_t>(axis_of(c, k))]
                      : kind == 2 ? shared[static_cast<std::size_t>(std::min(k / c.stride(), 4))]
                                  : own;
        const double x = drawn(random, e, bits);
        const bool zero = pick(random, 16) == 0;
        const double signed_x = with_sign(random, x);
        coordinate(c, k) = is_depth(c, k) ? x : zero ? 0 : signed_x;
    }
    const std::array<double, 3> drawn_point = c.point;
    if (random.coin()) point_between(c, random);
    if (!admissible(c, range)) c.point = drawn_point;
    random_values(c, random);
    return c;
}

void wander(Case& c, base::Random& random, bool values) {
    if (values && pick(random, 4) == 0) {
        double& f = c.values[static_cast<std::size_t>(pick(random, vertex_count(c.simplex)))];
        const std::int64_t by = small_power(random, 50);
        f = random.coin() ? base::places_above(f, random.coin() ? by : -by) : random.uniform(-1, 1);
        return;
    }
    const int changes = static_cast<int>(small_power(random, 2));
    for (int i = 0; i < changes; ++i) {
        constexpr std::array steps{redraw_significand, shift_exponents, take_from_another};
        const auto kind = static_cast<std::size_t>(pick(random, 8));
        if (kind < steps.size()) {
            steps[kind](c, random);
            continue;
        }
        if (kind == steps.size() && pick(random, 4) == 0) point_between(c, random);
        const int k = pick(random, coordinate_count(c));
        const std::int64_t by = small_power(random, 12);
        coordinate(c, k) = moved_by_ulps(c, k, random.coin() ? by : -by);
    }
}

void to_zero(Case& c, const Evaluation& at, const Zero& zero, double first, const ExponentRange& range,
             const Ask& ask) {
    const auto figure = [&](const Evaluation& e) {
        return zero.of_cell ? 1 / e.exact.weights[zero.weight] : e.exact.weights[zero.weight];
    };
    double x0 = coordinate(c, zero.coordinate), f0 = figure(at), x1 = x0 + first;
    constexpr int rounds = 4;
    for (int round = 0; round < rounds && x1 != x0; ++round) {
        Case next = c;
        coordinate(next, zero.coordinate) = x1;
        if (!admissible(next, range)) return;
        const Evaluation* e = ask(next);
        if (e == nullptr) return;
        c = next;
        const double f1 = figure(*e);
        if (!std::isfinite(f1) || f1 == 0) return;  // there
        const double x2 = x1 - f1 * ((x1 - x0) / (f1 - f0));
        x0 = x1;
        f0 = f1;
        x1 = x2;
    }
}

double first_step(const Case& c, int k) {
    const double x = coordinate(c, k);
    return x == 0 ? moved_by_ulps(c, k, std::int64_t{1} << 40) : x * 0x1p-12;
}

void jump_to_zero(Case& c, const Evaluation& at, base::Random& random, const ExponentRange& range, const Ask& ask) {
    const int n = vertex_count(c.simplex);
    Zero zero;
    zero.weight = static_cast<std::size_t>(pick(random, n));
    zero.of_cell = pick(random, 4) == 0;
    // Numerator i is linear in the point and in every vertex but i; the determinant of the cell over it in vertex i.
    const int i = static_cast<int>(zero.weight);
    const int vertex = zero.of_cell ? i : (i + 1 + pick(random, n - 1)) % n;
    const bool of_point = !zero.of_cell && random.coin();
    const int axis = pick(random, space_dimension(c.simplex));
    zero.coordinate = (of_point ? vertex_numbers(c) : c.stride() * vertex) + axis;
    const double first = with_sign(random, first_step(c, zero.coordinate));
    to_zero(c, at, zero, first, range, ask);
    const std::int64_t ulps = small_power(random, 6) - 1;
    coordinate(c, zero.coordinate) = moved_by_ulps(c, zero.coordinate, random.coin() ? ulps : -ulps);
}

}  // namespace barycert::audit
