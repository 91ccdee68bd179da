#include "barycert/core/condition.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

#include "barycert/core/fixed_integer.hpp"
#include "barycert/core/integer.hpp"
#include "barycert/core/quotient.hpp"
#include "barycert/core/scaled_double.hpp"
#include "barycert/core/strict_math.hpp"

namespace barycert {
namespace {

double absolute(double x) {
    return std::fabs(x);
}
template <int N>
Fixed<N> absolute(const Fixed<N>& x) {
    return x.negative() ? Fixed<N>{} - x : x;
}
Integer absolute(const Integer& x) {
    return x.sign() < 0 ? Integer() - x : x;
}

template <class T>
auto permanent(const T (&a)[2], const T (&b)[2]) {
    return a[0] * b[1] + a[1] * b[0];
}
template <class T>
auto permanent(const T (&a)[3], const T (&b)[3], const T (&c)[3]) {
    return a[0] * (b[1] * c[2] + b[2] * c[1]) + a[1] * (b[0] * c[2] + b[2] * c[0]) + a[2] * (b[0] * c[1] + b[1] * c[0]);
}
template <class T>
auto determinant(const T (&a)[2], const T (&b)[2]) {
    return a[0] * b[1] - a[1] * b[0];
}
template <class T>
auto determinant(const T (&a)[3], const T (&b)[3], const T (&c)[3]) {
    return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
}

/// The determinant, and the permanent of absolute values at each corner.
template <class V, int d>
struct Volumes {
    V det, perm[d + 1];
};

template <class T, int d>
[[gnu::always_inline]] inline auto volumes(const T (&x)[d + 1][d], T (&edge)[d + 1][d + 1][d]) {
    T from_0[d][d];  // edges with their signs; edge[i][j] for i < j without
    for (int i = 0; i < d; ++i) {
        for (int j = i + 1; j <= d; ++j) {
            for (int k = 0; k < d; ++k) {
                const T difference = x[j][k] - x[i][k];
                if (i == 0) from_0[j - 1][k] = difference;
                edge[i][j][k] = absolute(difference);
            }
        }
    }
    const auto& e = edge;
    if constexpr (d == 2) {
        const auto det = determinant(from_0[0], from_0[1]);
        return Volumes<std::remove_const_t<decltype(det)>, d>{
            det, {permanent(e[0][1], e[0][2]), permanent(e[0][1], e[1][2]), permanent(e[0][2], e[1][2])}};
    } else {
        const auto det = determinant(from_0[0], from_0[1], from_0[2]);
        return Volumes<std::remove_const_t<decltype(det)>, d>{
            det,
            {permanent(e[0][1], e[0][2], e[0][3]), permanent(e[0][1], e[1][2], e[1][3]),
             permanent(e[0][2], e[1][2], e[2][3]), permanent(e[0][3], e[1][3], e[2][3])}};
    }
}

template <int N>
Magnitude magnitude(const Fixed<N>& x) {
    return x.limbs;
}
Magnitude magnitude(const Integer& x) {
    return x.magnitude();
}

/// Rounded once. Widths: coordinates below 2^(64 N - 3) in N limbs give differences below 2^(64 N - 2), 2x2 permanents
/// below 2^(128 N - 3) and 3x3 ones below 6 * 2^(192 N - 6) < 2^(192 N - 3): no sum overflows.
template <class T, int d>
double quotient(const Unit (&units)[d], const ScaledDouble (&parts)[d + 1][d]) {
    T x[d + 1][d], edge[d + 1][d + 1][d];
    for (int i = 0; i <= d; ++i) {
        for (int k = 0; k < d; ++k) x[i][k] = units[k].template multiple<T>(parts[i][k]);
    }
    const auto v = volumes<T, d>(x, edge);
    const auto det = absolute(v.det);
    const Magnitude limbs = magnitude(det);
    if (std::all_of(limbs.begin(), limbs.end(), [](std::uint64_t limb) { return limb == 0; }))
        return std::numeric_limits<double>::infinity();
    double kappa = 1;
    for (const auto& perm : v.perm) kappa = std::max(kappa, round_quotient(false, magnitude(perm), limbs, 0));
    return std::min(kappa, std::numeric_limits<double>::max());
}

/// Each axis as integers in its own unit, which cancels in the quotient.
template <int d>
[[gnu::noinline]] double exact_condition(const double* vertices) {
    ScaledDouble parts[d + 1][d];
    Unit units[d];
    for (int i = 0; i <= d; ++i) {
        for (int k = 0; k < d; ++k) {
            const double x = vertices[d * i + k];
            if (!std::isfinite(x)) return std::numeric_limits<double>::quiet_NaN();
            parts[i][k] = scaled(x);
            units[k].add(parts[i][k]);
        }
    }
    int bits = 0;
    for (const Unit& u : units) bits = std::max(bits, u.bits());
    if (bits <= 64 - 3) return quotient<Fixed<1>, d>(units, parts);
    if (bits <= 128 - 3) return quotient<Fixed<2>, d>(units, parts);
    return quotient<Integer, d>(units, parts);
}

/// In floating point where that is certain to be right, else in integers.
///
/// A term of det meets at most 8 roundings (3 differences, 2 products, 3 sums), each of at most 2^-52 in any rounding
/// mode: det is off by at most 8 * 2^-52 perm[0], to first order. With perm[0] <= 2^38 |det| that is 2^-11 of |det|;
/// 2^-10 leaves room for higher orders and the rounding of the permanents, whose terms are all positive. What underflow
/// adds, even if it flushes to zero: with edges below 2^150, 2^-1022 to a difference or product is 2^-722 to each of 6
/// terms and so nothing to a det above 2^-650. Where anything overflowed or is NaN, a comparison fails.
template <int d>
[[gnu::always_inline]] inline double condition(const double* vertices) {
    double x[d + 1][d], edge[d + 1][d + 1][d];
    for (int i = 0; i <= d; ++i) std::copy_n(vertices + d * i, d, x[i]);
    const auto v = volumes<double, d>(x, edge);
    double longest = 0, perm = 0;  // corner 0's edges: no other is more than twice as long
    for (int j = 1; j <= d; ++j) {
        for (int k = 0; k < d; ++k) longest = std::max(longest, edge[0][j][k]);
    }
    for (const double p : v.perm) perm = std::max(perm, p);
    const double det = std::fabs(v.det);
    if (longest <= 0x1p149 && det >= 0x1p-650 && v.perm[0] <= 0x1p38 * det) return std::max(perm / det, 1.0);
    return exact_condition<d>(vertices);
}

}  // namespace

double condition_number(Simplex simplex, const double* vertices) {
    if (simplex == Simplex::triangle) return condition<2>(vertices);
    if (simplex == Simplex::tetrahedron) return condition<3>(vertices);
    return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace barycert
