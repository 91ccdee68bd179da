#include "barycert/core/exact_tier.hpp"

#include <algorithm>
#include <limits>

#include "barycert/core/fixed_integer.hpp"
#include "barycert/core/integer.hpp"
#include "barycert/core/quotient.hpp"
#include "barycert/core/scaled_double.hpp"

namespace barycert::core {
namespace {

/// Row j: the edge from the last vertex to vertex j, and behind it the difference of their values.
template <class T, int d>
using System = T[d][d + 1];

template <class T>
[[gnu::always_inline]] inline auto determinant(const System<T, 2>& s, int x, int y) {
    return s[0][x] * s[1][y] - s[0][y] * s[1][x];
}
template <class T>
[[gnu::always_inline]] inline auto determinant(const System<T, 3>& s, int x, int y, int z) {
    return s[0][x] * (s[1][y] * s[2][z] - s[1][z] * s[2][y]) + s[1][x] * (s[2][y] * s[0][z] - s[2][z] * s[0][y]) +
           s[2][x] * (s[0][y] * s[1][z] - s[0][z] * s[1][y]);
}

/// Cramer's rule: component k is the determinant of the edges with column k replaced by the values, over that of the
/// edges.
///
/// Widths: coordinates and values below 2^(64 N - 3) in N limbs give differences below 2^(64 N - 2), 2x2 minors below
/// 2^(128 N - 3) and determinants below 3 * 2^(192 N - 5) < 2^(192 N - 3): no sum overflows. Integer: differences of
/// 2099 bits, three of them and 3 more, see integer.hpp.
template <class T, int d>
bool solve(const ScaledDouble (&parts)[d + 1][d + 1], const Unit (&units)[d + 1], double* out) {
    System<T, d> s;
    for (int k = 0; k <= d; ++k) {
        const auto at = [&](int i) { return units[k].template multiple<T>(parts[i][k]); };
        for (int j = 0; j < d; ++j) s[j][k] = at(j) - at(d);
    }
    const auto rounded = [&](const Integer& numerator, const Integer& denominator, int k) {
        // Each axis and the values have units of their own; all but those of the values and of axis k cancel.
        return round_quotient(numerator.sign() != denominator.sign(), numerator.magnitude(), denominator.magnitude(),
                              units[d].exponent - units[k].exponent);
    };
    if constexpr (d == 2) {
        const Integer whole = as_integer(determinant(s, 0, 1));
        if (whole.sign() == 0) return false;
        out[0] = rounded(as_integer(determinant(s, 2, 1)), whole, 0);
        out[1] = rounded(as_integer(determinant(s, 0, 2)), whole, 1);
    } else {
        const Integer whole = as_integer(determinant(s, 0, 1, 2));
        if (whole.sign() == 0) return false;
        out[0] = rounded(as_integer(determinant(s, 3, 1, 2)), whole, 0);
        out[1] = rounded(as_integer(determinant(s, 0, 3, 2)), whole, 1);
        out[2] = rounded(as_integer(determinant(s, 0, 1, 3)), whole, 2);
    }
    return true;
}

template <int d>
bool exact_gradient(const double* vertices, const double* values, double* out) {
    ScaledDouble parts[d + 1][d + 1];
    Unit units[d + 1];
    for (int i = 0; i <= d; ++i) {
        for (int k = 0; k <= d; ++k) {
            parts[i][k] = scaled(k < d ? vertices[d * i + k] : values[i]);
            units[k].add(parts[i][k]);
        }
    }
    return with_integers<3>(max_bits(units), [&]<class T>() { return solve<T, d>(parts, units, out); });
}

}  // namespace

bool exact_gradient(Simplex simplex, const double* vertices, const double* values, double* out) {
    const bool proper = simplex == Simplex::triangle ? exact_gradient<2>(vertices, values, out)
                                                     : exact_gradient<3>(vertices, values, out);
    if (!proper) std::fill_n(out, space_dimension(simplex), std::numeric_limits<double>::quiet_NaN());
    return proper;
}

}  // namespace barycert::core
