// The bound of the double-double tier of gradients, on every target of this build: plain + correction is nowhere
// farther from the exact gradient than `error`. Far sharper than the gradients: a wrong rounding needs a tie nearby,
// this does not.
#include <gtest/gtest.h>

#include "barycert/environment.hpp"
#include "tests/core/rational.hpp"

// Before Highway's headers.
#include "core/simd_targets.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tests/core/gradient_bound_test.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h.
#include <hwy/highway.h>

#include "core/gradient-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace barycert::core {
namespace HWY_NAMESPACE {

/// plain, correction and error of each component; whether they are valid.
template <int d>
bool refined_in(const double* vertices, const double* values, double (*out)[3]) {
    using Wide = hn::ScalableTag<double>;
    using Lane = hn::Vec<Wide>;
    Lane v[d + 1][d], f[d + 1];
    for (int i = 0; i <= d; ++i) {
        for (int k = 0; k < d; ++k) v[i][k] = hn::Set(Wide(), vertices[d * i + k]);
        f[i] = hn::Set(Wide(), values[i]);
    }
    const auto m = cell_matrix<d>(Wide(), v);
    const auto g = refined_gradient<d>(Wide(), m, f);
    for (int k = 0; k < d; ++k) {
        out[k][0] = hn::GetLane(g.plain[k]);
        out[k][1] = hn::GetLane(g.correction[k]);
        out[k][2] = hn::GetLane(g.error[k]);
    }
    return hn::AllTrue(Wide(), hn::And(m.valid, g.valid));
}

bool refined_gradients(Simplex s, const double* vertices, const double* values, double (*out)[3]) {
    return s == Simplex::triangle ? refined_in<2>(vertices, values, out) : refined_in<3>(vertices, values, out);
}

}  // namespace HWY_NAMESPACE
}  // namespace barycert::core
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "tests/core/field_cases.hpp"

namespace barycert::core {

HWY_EXPORT(refined_gradients);

namespace {

using testing_rational::Q;

/// Cells of every kind, and values that are large against their differences.
Case bound_case(base::Random& r, Simplex s) {
    const int how = r.integer(0, 3);
    if (how == 0) {
        const auto kind = testing_cases::all_kinds[r.below(testing_cases::all_kinds.size())];
        return testing_cases::random_case(r, s, kind);
    }
    Case c = testing_fields::stretched_cell(r, s);
    if (how == 1) {
        const double offset = r.scaled(1, 2, 0, 40);
        for (double& f : c.values) f += offset;
    }
    return c;
}

/// The double nearest to x . y, and the double nearest to what that leaves.
std::array<double, 2> dot_product(const std::array<double, 3>& x, const std::array<double, 3>& y, std::size_t d) {
    double high = 0, low = 0;
    for (std::size_t k = 0; k < d; ++k) {
        const double p = x[k] * y[k], sum = high + p, part = sum - high;
        low += ((high - (sum - part)) + (p - part)) + std::fma(x[k], y[k], -p);
        high = sum;
    }
    const double sum = high + low;
    return {sum, low - (sum - high)};
}

/// A field whose gradient y is nearly a double: only then may the plain solution be so good that residuals are far
/// below their own remainders, and the bound is made of the errors of these alone. With the last vertex at the origin,
/// the first edge takes the low part of its E.y to the last value; others are drawn until theirs is nearly the same.
std::optional<Case> nearly_solved(base::Random& r, Simplex s) {
    const auto d = static_cast<std::size_t>(space_dimension(s));
    std::array<double, 3> y{};
    for (double& x : y) x = r.uniform(1, 2);
    Case c{.simplex = s};
    for (std::size_t j = 0; j < d; ++j) {
        std::array<double, 3> e{};
        for (int tries = 0; tries < 10000; ++tries) {
            for (std::size_t k = 0; k < d; ++k) e[k] = r.uniform(-1, 1) + (k == j ? 2 : 0);
            const auto [high, low] = dot_product(e, y, d);
            if (j == 0) c.values[d] = -low;
            c.values[j] = high;
            if (std::fabs(low + c.values[d]) < 0x1p-64 * std::fabs(high)) break;
            if (tries == 9999) return std::nullopt;
        }
        for (std::size_t k = 0; k < d; ++k) c.vertices[d * j + k] = e[k];
    }
    return c;
}

TEST(GradientBound, HoldsWhereResidualsNearlyVanish) {
    for (const Simplex s : {Simplex::triangle, Simplex::tetrahedron}) {
        int close = 0;
        double nearest_to_bound = 0;
        for (std::uint64_t k = 0; k < 1500 && !HasFailure(); ++k) {
            base::Random r = base::Random::stream(21, base::hash64("nearly solved"), k);
            const auto c = nearly_solved(r, s);
            if (!c) continue;
            double g[3][3];
            ASSERT_TRUE(HWY_DYNAMIC_DISPATCH(refined_gradients)(s, c->vertices.data(), c->values.data(), g));
            const auto exact = testing_fields::exact_gradient(*c);
            for (std::size_t i = 0; i < exact->size(); ++i) {
                const Q off = abs(Q(Q(g[i][0]) + Q(g[i][1]) - (*exact)[i]));
                EXPECT_LE(off, Q(g[i][2])) << i << ' ' << testing_cases::describe(*c);
                nearest_to_bound = std::max(nearest_to_bound, Q(off / Q(g[i][2])).get_d());
                close += std::fabs(g[i][1]) < 0x1p-60 ? 1 : 0;
            }
        }
        EXPECT_GT(close, 40) << name(s);
        EXPECT_GT(nearest_to_bound, 0x1p-9) << name(s);
        RecordProperty(std::string(name(s)), std::to_string(nearest_to_bound));
        RecordProperty(std::string(name(s)) + " close", std::to_string(close));
    }
}

TEST(GradientBound, HoldsOnEveryTarget) {
    for (const std::string& target : simd_targets()) {
        ASSERT_TRUE(use_simd_target(target));
        for (const Simplex s : {Simplex::triangle, Simplex::tetrahedron}) {
            int valid = 0;
            double nearest_to_bound = 0;
            for (std::uint64_t k = 0; k < 6000 && !HasFailure(); ++k) {
                base::Random r = base::Random::stream(21, base::hash64("gradient bound"), k);
                const Case c = bound_case(r, s);
                double g[3][3];
                if (!HWY_DYNAMIC_DISPATCH(refined_gradients)(s, c.vertices.data(), c.values.data(), g)) continue;
                const auto exact = testing_fields::exact_gradient(c);
                ASSERT_TRUE(exact) << "degenerate, and told valid: " << testing_cases::describe(c);
                ++valid;
                for (std::size_t i = 0; i < exact->size(); ++i) {
                    if (!std::isfinite(g[i][2])) continue;
                    const Q off = abs(Q(Q(g[i][0]) + Q(g[i][1]) - (*exact)[i]));
                    EXPECT_LE(off, Q(g[i][2])) << target << ' ' << i << ' ' << testing_cases::describe(c);
                    if (g[i][2] > 0) nearest_to_bound = std::max(nearest_to_bound, Q(off / Q(g[i][2])).get_d());
                }
            }
            EXPECT_GT(valid, 4000) << name(s);
            // The bound is no idle one: cases come within a small factor of it.
            EXPECT_GT(nearest_to_bound, 0x1p-7) << name(s);
            RecordProperty(target + " " + std::string(name(s)), std::to_string(nearest_to_bound));
        }
    }
    use_simd_target("");
}

}  // namespace
}  // namespace barycert::core
#endif
