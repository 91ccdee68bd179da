#include "barycert/weights.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "barycert/base/strict_math.hpp"
#include "barycert/core/fixed_integer.hpp"
#include "barycert/core/integer.hpp"
#include "barycert/core/quotient.hpp"
#include "barycert/core/scaled_double.hpp"
#include "barycert/environment.hpp"

namespace barycert::core {
namespace {

template <class T>
[[gnu::always_inline]] inline auto determinant(const T (&a)[2], const T (&b)[2]) {
    return a[0] * b[1] - a[1] * b[0];
}
template <class T>
[[gnu::always_inline]] inline auto determinant(const T (&a)[3], const T (&b)[3], const T (&c)[3]) {
    return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
}
template <class T>
[[gnu::always_inline]] inline auto determinant(const T (&edges)[2][2]) {
    return determinant(edges[0], edges[1]);
}
template <class T>
[[gnu::always_inline]] inline auto determinant(const T (&edges)[3][3]) {
    return determinant(edges[0], edges[1], edges[2]);
}

template <class T>
[[gnu::always_inline]] inline auto product(const T (&x)[2]) {
    return x[0] * x[1];
}
template <class T>
[[gnu::always_inline]] inline auto product(const T (&x)[3]) {
    return x[0] * (x[1] * x[2]);
}

/// A triangle fills at most half of its box, a tetrahedron a third.
template <int d>
constexpr double min_condition = d == 2 ? 2 : 3;

/// The cell's vertices with the min and the max coordinate on each axis.
template <int d>
struct Extremes {
    int low[d]{}, high[d]{};

    explicit Extremes(const double* vertices) {
        for (int k = 0; k < d; ++k) {
            for (int i = 1; i <= d; ++i) {
                if (vertices[d * i + k] < vertices[d * low[k] + k]) low[k] = i;
                if (vertices[d * i + k] > vertices[d * high[k] + k]) high[k] = i;
            }
        }
    }
};

/// Widths: coordinates below 2^(64 N - 3) in N limbs give differences below 2^(64 N - 2), 2x2 minors below 2^(128 N -
/// 3) and 3x3 determinants below 6 * 2^(192 N - 6) < 2^(192 N - 3): no sum overflows.
template <class T, int d>
double quotient(const Unit (&units)[d], const ScaledDouble (&parts)[d + 1][d], const Extremes<d>& extremes) {
    T edges[d][d], extents[d];
    for (int k = 0; k < d; ++k) {
        const auto at = [&](int i) { return units[k].template multiple<T>(parts[i][k]); };
        for (int i = 0; i < d; ++i) edges[i][k] = at(i + 1) - at(0);
        extents[k] = at(extremes.high[k]) - at(extremes.low[k]);
    }
    const Integer det = as_integer(determinant(edges)), box = as_integer(product(extents));
    if (det.sign() == 0) return std::numeric_limits<double>::infinity();
    const double factor = d == 2 ? 2 : 6;
    return std::clamp(factor * round_quotient(false, box.magnitude(), det.magnitude(), 0), min_condition<d>,
                      std::numeric_limits<double>::max());
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
    const Extremes<d> extremes(vertices);
    return with_integers<3>(max_bits(units), [&]<class T>() { return quotient<T, d>(units, parts, extremes); });
}

/// In floating point where that is certain to be right, else in integers.
///
/// A product of the determinant meets at most 8 roundings (3 differences, 2 products, 3 sums), each of at most 2^-52 in
/// any rounding mode, and there are d! of them, none larger than the box: det is off by at most 8 * 2^-52 d! X Y Z, to
/// first order. With d! X Y Z <= 2^38 |det| that is 2^-11 of |det|; 2^-10 leaves room for higher orders and the
/// rounding of the box. What underflow adds, even if it flushes to zero: with extents below 2^150, 2^-1022 to a
/// difference or product is 2^-720 to each product and so nothing to a det above 2^-650. Where anything overflowed or
/// is NaN, a comparison fails; maxima and minima may forget a NaN, but then it is in det.
template <int d>
[[gnu::always_inline]] inline double condition(const double* vertices) {
    double edges[d][d], extents[d], max_extent = 0;
    for (int k = 0; k < d; ++k) {
        double low = vertices[k], high = vertices[k];
        for (int i = 0; i < d; ++i) {
            const double x = vertices[d * (i + 1) + k];
            edges[i][k] = x - vertices[k];
            low = std::min(low, x);
            high = std::max(high, x);
        }
        extents[k] = high - low;
        max_extent = std::max(max_extent, extents[k]);
    }
    const double det = std::fabs(determinant(edges)), box = (d == 2 ? 2 : 6) * product(extents);
    if (max_extent <= 0x1p149 && det >= 0x1p-650 && box <= 0x1p38 * det) return std::max(box / det, min_condition<d>);
    return exact_condition<d>(vertices);
}

}  // namespace
}  // namespace barycert::core

namespace barycert {

double condition_number(Simplex simplex, const double* vertices) {
    const ExactEnvironment environment;
    if (simplex == Simplex::triangle) return held(core::condition<2>(vertices));
    if (simplex == Simplex::tetrahedron) return held(core::condition<3>(vertices));
    return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace barycert
