#include "barycert/simplex.hpp"
#include "barycert/weights.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "barycert/environment.hpp"
#include "core/base/finite.hpp"
#include "core/base/strict_math.hpp"
#include "core/integer.hpp"
#include "core/numerators-inl.hpp"
#include "core/scaled_double.hpp"

namespace barycert::core {
namespace {

namespace formulas = HWY_NAMESPACE;

template <class T, int d>
[[gnu::always_inline]] inline auto product(const T (&x)[d]) {
    if constexpr (d == 2) return x[0] * x[1];
    if constexpr (d == 3) return x[0] * (x[1] * x[2]);
}

/// A triangle fills at most half of its box, a tetrahedron a third.
template <int d>
constexpr double min_condition = d == 2 ? 2 : 3;

/// Each axis as integers in its own unit, which cancels in the quotient.
///
/// Widths: coordinates below 2^(64 N - 3) in N limbs give differences below 2^(64 N - 2), 2x2 minors below 2^(128 N -
/// 3) and 3x3 determinants below 6 * 2^(192 N - 6) < 2^(192 N - 3): no sum overflows.
template <int d>
[[gnu::noinline]] double exact_condition(const double* vertices) {
    if (!base::all_finite({vertices, d * (d + 1)})) return std::numeric_limits<double>::quiet_NaN();
    const auto number = [&](int i, int k) { return vertices[d * i + k]; };
    return with_lattice<d + 1, d>(number, false, [&]<class T>(const Lattice<d + 1, d, T>& lattice) {
        T edges[d][d], extents[d];
        for (int i = 0; i < d; ++i) lattice.difference(i + 1, 0, edges[i]);
        for (int k = 0; k < d; ++k) {
            int low = 0, high = 0;  // the vertices with the min and the max coordinate
            for (int i = 1; i <= d; ++i) {
                if (number(i, k) < number(low, k)) low = i;
                if (number(i, k) > number(high, k)) high = i;
            }
            extents[k] = lattice.at(high, k) - lattice.at(low, k);
        }
        const Integer det = as_integer(formulas::determinant(edges)), box = as_integer(product(extents));
        if (det.sign() == 0) return std::numeric_limits<double>::infinity();
        const double factor = d == 2 ? 2 : 6;
        return std::clamp(factor * round_quotient(false, box.magnitude(), det.magnitude(), 0), min_condition<d>,
                          std::numeric_limits<double>::max());
    });
}

/// In floating point where that is certain to be right, else in integers.
///
/// A product of the determinant meets at most 8 roundings (3 differences, 2 products, 3 sums), each of at most 2^-52 in
/// any rounding mode, and there are d! of them, none larger than the box: det is off by at most 8 * 2^-52 d! X Y Z, to
/// first order. With d! X Y Z <= 2^38 |det| that is 2^-11 of |det|; 2^-10 leaves room for higher orders and the
/// rounding of the box. Underflow, even if it flushes to zero, adds this: with extents below 2^150, 2^-1022 to a
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
    const double det = std::fabs(formulas::determinant(edges)), box = (d == 2 ? 2 : 6) * product(extents);
    if (max_extent <= 0x1p149 && det >= 0x1p-650 && box <= 0x1p38 * det) return std::max(box / det, min_condition<d>);
    return exact_condition<d>(vertices);
}

}  // namespace
}  // namespace barycert::core

namespace barycert {

double condition_number(Simplex simplex, const double* vertices) {
    const ExactEnvironment environment;
    if (simplex == Simplex::triangle) return base::held(core::condition<2>(vertices));
    if (simplex == Simplex::tetrahedron) return base::held(core::condition<3>(vertices));
    return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace barycert
