#include "barycert/predicates.hpp"
#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <span>
#include <string>

#include "barycert/result.hpp"
#include "barycert/simplex.hpp"
#include "core/base/finite.hpp"
#include "core/base/strict_math.hpp"
#include "core/exact_tier.hpp"
#include "core/numerators-inl.hpp"

namespace barycert::core {
namespace {

namespace formulas = HWY_NAMESPACE;

// The filters: each returns the sign that its bound proves, or zero for undecided. A coordinate that is not finite
// proves nothing: it is in a difference, which makes an extent infinite or the determinant NaN, and comparisons with
// NaN are false.

constexpr double epsilon = 0x1p-52;

// Orientations: the same ranges and constants as the numerators of filter-inl.hpp, which derives them: 2 terms of 4
// roundings, and 6 of 8 (there the last sign costs no rounding).

bool in_range(double extent) {
    return extent >= 0x1p-300 && extent <= 0x1p300;
}

/// Sign of det(b - a, c - a).
[[gnu::always_inline]] inline Sign filtered_orient2d(const double* a, const double* b, const double* c) {
    const double ux = b[0] - a[0], uy = b[1] - a[1], vx = c[0] - a[0], vy = c[1] - a[1];
    const double x = std::max(std::fabs(ux), std::fabs(vx)), y = std::max(std::fabs(uy), std::fabs(vy));
    const double det = ux * vy - uy * vx;
    if (in_range(x) && in_range(y) && std::fabs(det) > 8.5 * epsilon * (x * y))
        return det < 0 ? Sign::negative : Sign::positive;
    return Sign::zero;
}

/// Sign of det(q - p, s - r, t1 - t0).
[[gnu::always_inline]] inline Sign filtered_det3d(const double* p, const double* q, const double* r, const double* s,
                                                  const double* t0, const double* t1) {
    double u[3], v[3], w[3], extent[3];
    for (int k = 0; k < 3; ++k) {
        u[k] = q[k] - p[k];
        v[k] = s[k] - r[k];
        w[k] = t1[k] - t0[k];
        extent[k] = std::max(std::max(std::fabs(u[k]), std::fabs(v[k])), std::fabs(w[k]));
    }
    const auto [x, y, z] = extent;
    const double det =
        u[0] * (v[1] * w[2] - v[2] * w[1]) + u[1] * (v[2] * w[0] - v[0] * w[2]) + u[2] * (v[0] * w[1] - v[1] * w[0]);
    if (in_range(x) && in_range(y) && in_range(z) && std::fabs(det) > 49 * epsilon * (x * y * z))
        return det < 0 ? Sign::negative : Sign::positive;
    return Sign::zero;
}

[[gnu::always_inline]] inline Sign filtered_orient3d(const double* a, const double* b, const double* c,
                                                     const double* d) {
    return filtered_det3d(a, b, a, c, a, d);
}

// Circles and spheres. As in filter-inl.hpp, with e = 2^-52 for one rounding in any mode: the sum of terms of k
// roundings each is off by at most (number of terms) * (max product) * ((1+e)^k - 1). Max products are taken over the
// axes' extents X, Y, Z of the differences and the max square of a length L, as computed: the squares that L sums up
// are positive, so that together they count as one term of L.
//                     numerator           square                                  product, sums   k
//   incircle          2 terms, k = 4      2 differences, 1 product, 1 sum         1 + 2           11    6 * 11 =  66
//   insphere          6 terms, k = 8      2 differences, 1 product, 2 sums        1 + 2           16   24 * 16 = 384
// times e X Y L or e X Y Z L; a difference counts for each of the factors that it is in. The constants used are
// larger by 2 % at least: that covers (1+e)^k - 1 > k e, true differences that exceed computed ones by (1+e), L that
// falls short of the true squares by (1+e)^3 and the roundings of the bound itself, all together below 1 + 40 e.
//
// Under- and overflow. With every extent in [2^-180, 2^200], and so L in [2^-361, 2^402], a difference, product or sum
// that underflows is off by at most 2^-1020 (operands and result flushed to zero). It is multiplied by what else is in
// its terms: lost in a product of them all it counts 2^-1020 against e X Y Z L >= 2^-52-901; elsewhere both have
// factors in common, and what remains of the right side is larger. All far below the 2 %. Max value: 24 * 2^1002.

template <Simplex s>
[[gnu::always_inline]] inline Sign filtered_lifted(const double* const* points, double factor) {
    using Differences = formulas::Relative<s, double>;
    constexpr int n = Differences::n, d = Differences::d;
    Differences c;
    formulas::Lifted<s, double> lifted;
    double bound = factor * epsilon;
    bool valid = true;
    for (int k = 0; k < d; ++k) {
        double extent = 0;
        for (int i = 0; i < n; ++i) {
            c.r[i][k] = points[i][k] - points[n][k];
            extent = std::max(extent, std::fabs(c.r[i][k]));
        }
        bound *= extent;
        valid = valid && extent >= 0x1p-180 && extent <= 0x1p200;
    }
    formulas::lift(c, lifted);
    bound *= *std::max_element(lifted.square, lifted.square + n);
    if (valid && std::fabs(lifted.sum) > bound) return lifted.sum < 0 ? Sign::negative : Sign::positive;
    return Sign::zero;
}

[[gnu::always_inline]] inline Sign filtered_incircle(const double* a, const double* b, const double* c,
                                                     const double* d) {
    const double* const points[] = {a, b, c, d};
    return filtered_lifted<Simplex::triangle>(points, 67.5);
}

[[gnu::always_inline]] inline Sign filtered_insphere(const double* a, const double* b, const double* c, const double* d,
                                                     const double* e) {
    const double* const points[] = {a, b, c, d, e};
    return filtered_lifted<Simplex::tetrahedron>(points, 392);
}

/// Which of the points of d coordinates is the first with one that is not finite; their number if all are.
std::size_t not_finite(std::size_t d, std::initializer_list<const double*> points) {
    const auto bad = std::find_if(points.begin(), points.end(), [d](const double* p) {
        return base::first_not_finite({p, d}) != d;
    });
    return static_cast<std::size_t>(bad - points.begin());
}

/// The sign by the filter, or by integers where that is undecided. Points have d coordinates. Integers that are made of
/// NaN or infinity are as wide as those of finite numbers (scaled_double.hpp).
template <std::size_t d, auto filtered, auto exact, class... Points>
[[gnu::always_inline]] inline Sign sign(Points... points) {
    const Sign by_filter = filtered(points...);
    if (by_filter != Sign::zero) return by_filter;
    assert(not_finite(d, {points...}) == sizeof...(points));
    return exact(points...);
}

template <std::size_t d, auto exact, class... Points>
[[gnu::noinline]] Result<Sign> checked_exact(Points... points) {
    if (const std::size_t i = not_finite(d, {points...}); i != sizeof...(points)) {
        const std::span<const double> point(std::initializer_list<const double*>{points...}.begin()[i], d);
        const std::size_t k = base::first_not_finite(point);
        return base::not_finite("coordinate " + std::to_string(k) + " of point " + std::to_string(i), point[k]);
    }
    return exact(points...);
}

template <std::size_t d, auto filtered, auto exact, class... Points>
[[gnu::always_inline]] inline Result<Sign> checked_sign(Points... points) {
    const Sign by_filter = filtered(points...);
    if (by_filter != Sign::zero) return by_filter;
    return checked_exact<d, exact>(points...);
}

}  // namespace
}  // namespace barycert::core

namespace barycert {

Sign orient2d(const double* a, const double* b, const double* c) noexcept {
    return core::sign<2, core::filtered_orient2d, core::exact_orient2d>(a, b, c);
}
Result<Sign> checked_orient2d(const double* a, const double* b, const double* c) {
    return core::checked_sign<2, core::filtered_orient2d, core::exact_orient2d>(a, b, c);
}

Sign orient3d(const double* a, const double* b, const double* c, const double* d) noexcept {
    return core::sign<3, core::filtered_orient3d, core::exact_orient3d>(a, b, c, d);
}
Result<Sign> checked_orient3d(const double* a, const double* b, const double* c, const double* d) {
    return core::checked_sign<3, core::filtered_orient3d, core::exact_orient3d>(a, b, c, d);
}

Sign det3d(const double* p, const double* q, const double* r, const double* s, const double* t,
           const double* u) noexcept {
    return core::sign<3, core::filtered_det3d, core::exact_det3d>(p, q, r, s, t, u);
}
Result<Sign> checked_det3d(const double* p, const double* q, const double* r, const double* s, const double* t,
                           const double* u) {
    return core::checked_sign<3, core::filtered_det3d, core::exact_det3d>(p, q, r, s, t, u);
}

Sign incircle(const double* a, const double* b, const double* c, const double* d) noexcept {
    return core::sign<2, core::filtered_incircle, core::exact_incircle>(a, b, c, d);
}
Result<Sign> checked_incircle(const double* a, const double* b, const double* c, const double* d) {
    return core::checked_sign<2, core::filtered_incircle, core::exact_incircle>(a, b, c, d);
}

Sign insphere(const double* a, const double* b, const double* c, const double* d, const double* e) noexcept {
    return core::sign<3, core::filtered_insphere, core::exact_insphere>(a, b, c, d, e);
}
Result<Sign> checked_insphere(const double* a, const double* b, const double* c, const double* d, const double* e) {
    return core::checked_sign<3, core::filtered_insphere, core::exact_insphere>(a, b, c, d, e);
}

}  // namespace barycert
