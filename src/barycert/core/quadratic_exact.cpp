#include "barycert/core/exact_tier.hpp"

#include <algorithm>
#include <type_traits>

#include "barycert/core/fixed_integer.hpp"
#include "barycert/core/integer.hpp"
#include "barycert/core/numerators-inl.hpp"
#include "barycert/core/quadratic_edges.hpp"
#include "barycert/core/quotient.hpp"
#include "barycert/core/scaled_double.hpp"

namespace barycert::core {
namespace {

namespace formulas = HWY_NAMESPACE;

// Differences have 2099 bits (see integer.hpp), numerators three times as many and 3 more for 6 products. The sum below
// is one of squares and products of numerators with 4 values of 2098 bits and 6 of 6 times that: 40 in all, 6 bits.
static_assert(64 * (Integer::capacity - 2) >= 2 * (3 * 2099 + 3) + 2098 + 6);

/// sum_i n_i (sum_{j >= i} n_j b_ij) over the square of the denominator, with b_ii = f_i and b_ij = 4 f_ij - f_i - f_j:
/// the form of quadratic-inl.hpp, without its division.
///
/// Widths. Numerators in 3 N limbs are below 3 * 2^(192 N - 5) (exact_weights.cpp; triangle: 2 N limbs, 2^(128 N - 3)),
/// the denominator below their range; values below 2^(64 M - 4) in M limbs give b below 6 * 2^(64 M - 4). An inner sum
/// is below (1 + 3 * 6) * 3 * 2^(192 N + 64 M - 9) < 2^(192 N + 64 M - 3), the outer one below
/// (4 + 6 * 6) * 9 * 2^(384 N + 64 M - 14) < 2^(384 N + 64 M - 5); in the plane below 13 * 2^(128 N + 64 M - 7) and
/// 21 * 2^(256 N + 64 M - 10): no sum overflows.
template <class T, Simplex s, class Number>
double value(const formulas::Fractions<s, Number>& w, const ScaledDouble* parts, const Unit& unit) {
    constexpr int n = vertex_count(s);
    const auto at = [&](int i) { return unit.multiple<T>(parts[i]); };
    using Inner = decltype(w.numerator[0] * at(0));
    using Outer = decltype(w.numerator[0] * Inner());
    Outer sum{};
    for (int i = 0; i < n; ++i) {
        Inner inner = w.numerator[i] * at(i);
        for (int j = i + 1; j < n; ++j) {
            const T mid = at(n + quadratic_edge(i, j)), twice = mid + mid;
            inner = inner + w.numerator[j] * ((twice + twice) - (at(i) + at(j)));
        }
        sum = sum + w.numerator[i] * inner;
    }
    const Integer numerator = as_integer(sum), square = as_integer(w.denominator * w.denominator);
    return round_quotient(numerator.sign() < 0, numerator.magnitude(), square.magnitude(), unit.exponent - 1074);
}

/// The same numbers without a fixed width.
template <Simplex s, class Number>
formulas::Fractions<s, Integer> as_integers(const formulas::Fractions<s, Number>& w) {
    formulas::Fractions<s, Integer> out;
    for (int i = 0; i < vertex_count(s); ++i) out.numerator[i] = as_integer(w.numerator[i]);
    out.denominator = as_integer(w.denominator);
    return out;
}

/// All components, each in integers of the narrowest type that has room.
template <Simplex s, class Number>
bool values_of(const formulas::Fractions<s, Number>& w, const double* values, int components, double* out) {
    if (as_integer(w.denominator).sign() == 0) return false;
    constexpr int nodes = s == Simplex::triangle ? 6 : 10;
    for (int c = 0; c < components; ++c) {
        ScaledDouble parts[nodes];
        Unit unit;
        for (int i = 0; i < nodes; ++i) {
            parts[i] = scaled(values[nodes * c + i]);
            unit.add(parts[i]);
        }
        if constexpr (std::is_same_v<Number, Integer>) {
            out[c] = value<Integer, s>(w, parts, unit);
        } else if (unit.bits() <= 64 - 4) {
            out[c] = value<Fixed<1>, s>(w, parts, unit);
        } else if (unit.bits() <= 128 - 4) {
            out[c] = value<Fixed<2>, s>(w, parts, unit);
        } else {
            out[c] = value<Integer, s>(as_integers<s>(w), parts, unit);
        }
    }
    return true;
}

template <Simplex s>
bool exact_quadratic(const double* vertices, const double* point, const double* values, int components, double* out) {
    constexpr int n = vertex_count(s), d = space_dimension(s);
    ScaledDouble parts[n + 1][d];
    Unit units[d];
    for (int k = 0; k < d; ++k) {
        for (int i = 0; i <= n; ++i) {
            parts[i][k] = scaled(i < n ? vertices[d * i + k] : point[k]);
            units[k].add(parts[i][k]);
        }
    }
    return with_integers<3>(max_bits(units), [&]<class T>() {
        formulas::Relative<s, T> c;
        for (int k = 0; k < d; ++k) {
            const T p = units[k].template multiple<T>(parts[n][k]);
            for (int i = 0; i < n; ++i) c.r[i][k] = units[k].template multiple<T>(parts[i][k]) - p;
        }
        formulas::Fractions<s, T> w;
        formulas::solve(c, formulas::Numerator<s, T>{}, w);
        return values_of<s>(w, values, components, out);
    });
}

}  // namespace

bool exact_quadratic(Simplex simplex, const double* vertices, const double* point, const double* values, int components,
                     double* out) {
    return simplex == Simplex::triangle
               ? exact_quadratic<Simplex::triangle>(vertices, point, values, components, out)
               : exact_quadratic<Simplex::tetrahedron>(vertices, point, values, components, out);
}

}  // namespace barycert::core
