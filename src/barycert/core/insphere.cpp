#include "barycert/predicates.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "barycert/base/strict_math.hpp"
#include "barycert/core/exact_weights.hpp"
#include "barycert/core/lifted-inl.hpp"
#include "barycert/core/point_arguments.hpp"

namespace barycert {
namespace {

namespace formulas = HWY_NAMESPACE;

// The filter. As in filter-inl.hpp, with e = 2^-52 for one rounding in any mode: the sum of terms of k roundings each
// is off by at most (number of terms) * (largest product) * ((1+e)^k - 1). Largest products are taken over the axes'
// extents X, Y, Z of the differences and the largest square of a length L, as computed: the squares that L sums up
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
// factors in common, and what remains of the right side is larger. All far below the 2 %. Largest value: 24 * 2^1002.
// A coordinate that is not finite makes an extent infinite or the sum NaN, and comparisons with NaN are false: every
// difference is in an extent, and in the sum.
constexpr double epsilon = 0x1p-52;

bool in_range(double extent) {
    return extent >= 0x1p-180 && extent <= 0x1p200;
}

template <Simplex s>
[[gnu::always_inline]] inline int filtered(const double* const (&points)[vertex_count(s) + 1], double factor) {
    constexpr int n = vertex_count(s), d = space_dimension(s);
    formulas::Relative<s, double> c;
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
        valid = valid && in_range(extent);
    }
    formulas::lift(c, lifted);
    bound *= *std::max_element(lifted.square, lifted.square + n);
    return valid && std::fabs(lifted.sum) > bound ? (lifted.sum < 0 ? -1 : 1) : 0;
}

}  // namespace

Sign incircle(const double* a, const double* b, const double* c, const double* d) noexcept {
    const int sign = filtered<Simplex::triangle>({a, b, c, d}, 67.5);
    if (sign != 0) return static_cast<Sign>(sign);
    return exact_sign(std::array{a, b, c, d}, 2, [=] { return exact_incircle(a, b, c, d); });
}

Sign insphere(const double* a, const double* b, const double* c, const double* d, const double* e) noexcept {
    const int sign = filtered<Simplex::tetrahedron>({a, b, c, d, e}, 392);
    if (sign != 0) return static_cast<Sign>(sign);
    return exact_sign(std::array{a, b, c, d, e}, 3, [=] { return exact_insphere(a, b, c, d, e); });
}

Result<Sign> checked_incircle(const double* a, const double* b, const double* c, const double* d) {
    const int sign = filtered<Simplex::triangle>({a, b, c, d}, 67.5);
    if (sign != 0) return static_cast<Sign>(sign);
    return checked_exact_sign(std::array{a, b, c, d}, 2, [=] { return exact_incircle(a, b, c, d); });
}

Result<Sign> checked_insphere(const double* a, const double* b, const double* c, const double* d, const double* e) {
    const int sign = filtered<Simplex::tetrahedron>({a, b, c, d, e}, 392);
    if (sign != 0) return static_cast<Sign>(sign);
    return checked_exact_sign(std::array{a, b, c, d, e}, 3, [=] { return exact_insphere(a, b, c, d, e); });
}

}  // namespace barycert
