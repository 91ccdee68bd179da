// The bound of the double-double tier of quadratic fields, on every target of this build: value.high + value.low is
// nowhere farther from the exact value than `error`.
#include <gtest/gtest.h>

#include "barycert/environment.hpp"
#include "tests/core/rational.hpp"

// Before Highway's headers.
#include "core/simd_targets.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tests/core/quadratic_bound_test.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h.
#include <hwy/highway.h>

#include "core/quadratic-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace barycert::core {
namespace HWY_NAMESPACE {

/// high, low and error; whether they are valid.
template <Simplex s>
bool refined_in(const double* vertices, const double* point, const double* values, double* out) {
    using Wide = hn::ScalableTag<double>;
    using Lane = hn::Vec<Wide>;
    constexpr int n = vertex_count(s), d = space_dimension(s);
    Absolute<s, Lane> c;
    Lane f[quadratic_nodes<s>];
    for (int k = 0; k < d; ++k) {
        c.p[k] = hn::Set(Wide(), point[k]);
        for (int i = 0; i < n; ++i) c.v[i][k] = hn::Set(Wide(), vertices[d * i + k]);
    }
    for (int i = 0; i < quadratic_nodes<s>; ++i) f[i] = hn::Set(Wide(), values[i]);
    const auto w = quadratic_weights(Wide(), refine<s>(Wide(), c));
    const auto q = refined_quadratic<s>(Wide(), w, f);
    out[0] = hn::GetLane(q.value.high);
    out[1] = hn::GetLane(q.value.low);
    out[2] = hn::GetLane(q.error);
    return hn::AllTrue(Wide(), hn::And(w.valid, q.valid));
}

bool refined_value(Simplex s, const double* vertices, const double* point, const double* values, double* out) {
    return s == Simplex::triangle ? refined_in<Simplex::triangle>(vertices, point, values, out)
                                  : refined_in<Simplex::tetrahedron>(vertices, point, values, out);
}

/// The same from given weights, corrections and their error.
template <Simplex s>
bool from_weights_in(const double* weights, const double* corrections, double error, const double* values,
                     double* out) {
    using Wide = hn::ScalableTag<double>;
    Refined<s, Wide> r;
    r.error = hn::Set(Wide(), error);
    r.magnitude = hn::Set(Wide(), 1);
    for (int i = 0; i < vertex_count(s); ++i) {
        r.weight[i] = hn::Set(Wide(), weights[i]);
        r.correction[i] = hn::Set(Wide(), corrections[i]);
        r.magnitude = r.magnitude + hn::Abs(r.weight[i]);
    }
    r.valid = hn::Eq(r.error, r.error);
    hn::Vec<Wide> f[quadratic_nodes<s>];
    for (int i = 0; i < quadratic_nodes<s>; ++i) f[i] = hn::Set(Wide(), values[i]);
    const auto w = quadratic_weights(Wide(), r);
    const auto q = refined_quadratic<s>(Wide(), w, f);
    out[0] = hn::GetLane(q.value.high);
    out[1] = hn::GetLane(q.value.low);
    out[2] = hn::GetLane(q.error);
    return hn::AllTrue(Wide(), hn::And(w.valid, q.valid));
}

bool value_from_weights(Simplex s, const double* weights, const double* corrections, double error, const double* values,
                        double* out) {
    return s == Simplex::triangle ? from_weights_in<Simplex::triangle>(weights, corrections, error, values, out)
                                  : from_weights_in<Simplex::tetrahedron>(weights, corrections, error, values, out);
}

}  // namespace HWY_NAMESPACE
}  // namespace barycert::core
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "tests/core/field_cases.hpp"

namespace barycert::core {

HWY_EXPORT(refined_value);
HWY_EXPORT(value_from_weights);

namespace {

using testing_fields::QuadraticCase;
using testing_rational::Q;

/// Points in round cells, where the arithmetic decides, also far outside, where values cancel; flat ones, where the
/// weights do; cells of every kind.
QuadraticCase bound_case(base::Random& r, Simplex s) {
    const int how = r.integer(0, 3);
    QuadraticCase q;
    if (how == 0) {
        const auto kind = testing_cases::all_kinds[r.below(testing_cases::all_kinds.size())];
        q.linear = testing_cases::random_case(r, s, kind);
    } else {
        q.linear = testing_fields::stretched_cell(r, s, how == 1 ? 0 : 36);
    }
    const double offset = r.coin() ? 0 : r.scaled(1, 2, 0, 20);
    const double kink = r.coin() ? 1 : 0x1p-20;
    for (double& f : q.linear.values) f += offset;
    for (int e = 0; e < (s == Simplex::triangle ? 3 : 6); ++e) {
        const double bend = testing_fields::nodal_value(r);
        q.mids.push_back(offset + kink * bend);
    }
    return q;
}

TEST(QuadraticBound, HoldsOnEveryTarget) {
    for (const std::string& target : simd_targets()) {
        ASSERT_TRUE(use_simd_target(target));
        for (const Simplex s : {Simplex::triangle, Simplex::tetrahedron}) {
            int valid = 0;
            double nearest_to_bound = 0;
            for (std::uint64_t k = 0; k < 6000 && !HasFailure(); ++k) {
                base::Random r = base::Random::stream(31, base::hash64("quadratic bound"), k);
                const QuadraticCase q = bound_case(r, s);
                double v[3];
                if (!HWY_DYNAMIC_DISPATCH(refined_value)(s, q.linear.vertices.data(), q.linear.point.data(),
                                                         q.nodal().data(), v))
                    continue;
                const auto exact = testing_fields::exact_quadratic(q);
                ASSERT_TRUE(exact) << "degenerate, and told valid: " << describe(q);
                if (!std::isfinite(v[2])) continue;
                ++valid;
                const Q off = abs(Q(Q(v[0]) + Q(v[1]) - *exact));
                EXPECT_LE(off, Q(v[2])) << target << ' ' << describe(q);
                if (v[2] > 0) nearest_to_bound = std::max(nearest_to_bound, Q(off / Q(v[2])).get_d());
            }
            EXPECT_GT(valid, 4000) << name(s);
            // Worst-case bounds of weights are far from what happens: the two parts of this one are tested below.
            EXPECT_GT(nearest_to_bound, 0x1p-13) << name(s);
            RecordProperty(target + " " + std::string(name(s)), std::to_string(nearest_to_bound));
        }
    }
    use_simd_target("");
}

/// P(l) = sum_i l_i (sum_{j >= i} l_j b_ij).
Q polynomial(const std::vector<Q>& l, const std::vector<double>& f) {
    const std::size_t n = l.size();
    Q sum(0);
    for (std::size_t i = 0; i < n; ++i) sum += l[i] * l[i] * Q(f[i]);
    for (std::size_t e = 0; n + e < f.size(); ++e) {
        const auto [a, b] = testing_fields::edge(e);
        const auto i = static_cast<std::size_t>(a), j = static_cast<std::size_t>(b);
        sum += l[i] * l[j] * (4 * Q(f[n + e]) - Q(f[i]) - Q(f[j]));
    }
    return sum;
}

/// Weights that sum to about 1, as double + correction of any size, and values, mostly with b of the same magnitude.
struct Synthetic {
    std::vector<double> weights, corrections, values;
    std::vector<Q> exact;  ///< weights + corrections

    Synthetic(base::Random& r, Simplex s) {
        const int n = vertex_count(s), mids = s == Simplex::triangle ? 3 : 6;
        const double spread = r.coin() ? 1 : r.scaled(1, 2, 0, 12);
        double sum = 0;
        for (int i = 0; i < n; ++i) {
            const double even = 1.0 / n, part = r.uniform(-1, 1);
            weights.push_back(i == n - 1 ? 1 - sum : even + spread * part / 4);
            sum += weights.back();
            corrections.push_back(r.scaled(-1, 1, -70, -20));
            exact.push_back(Q(weights.back()) + Q(corrections.back()));
        }
        for (int i = 0; i < n + mids; ++i) values.push_back(r.coin() ? 1 - r.uniform(0, 0.25) : r.uniform(-1, 1));
    }
};

TEST(QuadraticBound, CoversTheArithmetic) {
    for (const std::string& target : simd_targets()) {
        ASSERT_TRUE(use_simd_target(target));
        for (const Simplex s : {Simplex::triangle, Simplex::tetrahedron}) {
            double nearest_to_bound = 0;
            for (std::uint64_t k = 0; k < 8000 && !HasFailure(); ++k) {
                base::Random r = base::Random::stream(31, base::hash64("quadratic arithmetic"), k);
                const Synthetic c(r, s);
                double v[3];
                ASSERT_TRUE(HWY_DYNAMIC_DISPATCH(value_from_weights)(s, c.weights.data(), c.corrections.data(), 0.0,
                                                                     c.values.data(), v));
                const Q off = abs(Q(Q(v[0]) + Q(v[1]) - polynomial(c.exact, c.values)));
                EXPECT_LE(off, Q(v[2])) << target;
                if (v[2] > 0) nearest_to_bound = std::max(nearest_to_bound, Q(off / Q(v[2])).get_d());
            }
            EXPECT_GT(nearest_to_bound, 0x1p-7) << name(s);
            RecordProperty(target + " " + std::string(name(s)), std::to_string(nearest_to_bound));
        }
    }
    use_simd_target("");
}

// Weights that are off by as much as they may be, in the directions that hurt.
TEST(QuadraticBound, CoversErrorsOfWeights) {
    for (const std::string& target : simd_targets()) {
        ASSERT_TRUE(use_simd_target(target));
        for (const Simplex s : {Simplex::triangle, Simplex::tetrahedron}) {
            double nearest_to_bound = 0;
            for (std::uint64_t k = 0; k < 1500 && !HasFailure(); ++k) {
                base::Random r = base::Random::stream(31, base::hash64("quadratic weights"), k);
                Synthetic c(r, s);
                const int how = r.integer(0, 3);
                const std::size_t n = c.exact.size();
                if (how == 0) {  // b of one sign and magnitude
                    for (std::size_t i = 0; i < c.values.size(); ++i) c.values[i] = i < n ? 1 : 0.75;
                } else if (how == 1) {  // b of one corner alone
                    const std::size_t corner = r.below(n);
                    for (std::size_t i = 0; i < n; ++i) c.values[i] = i == corner ? 1 : 0;
                    for (std::size_t e = 0; n + e < c.values.size(); ++e) {
                        const auto [i, j] = testing_fields::edge(e);
                        const bool on_edge =
                            corner == static_cast<std::size_t>(i) || corner == static_cast<std::size_t>(j);
                        c.values[n + e] = on_edge ? 0.25 : 0;
                    }
                }
                const double eta = std::ldexp(1, -r.integer(10, 90));
                double v[3];
                ASSERT_TRUE(HWY_DYNAMIC_DISPATCH(value_from_weights)(s, c.weights.data(), c.corrections.data(), eta,
                                                                     c.values.data(), v));
                for (unsigned signs = 0; signs < 1U << c.exact.size(); ++signs) {
                    std::vector<Q> l = c.exact;
                    for (std::size_t i = 0; i < l.size(); ++i) l[i] += (signs >> i & 1) != 0 ? Q(eta) : Q(-eta);
                    const Q off = abs(Q(Q(v[0]) + Q(v[1]) - polynomial(l, c.values)));
                    EXPECT_LE(off, Q(v[2])) << target;
                    if (v[2] > 0) nearest_to_bound = std::max(nearest_to_bound, Q(off / Q(v[2])).get_d());
                }
            }
            EXPECT_GT(nearest_to_bound, 0.5) << name(s);
            RecordProperty(target + " " + std::string(name(s)), std::to_string(nearest_to_bound));
        }
    }
    use_simd_target("");
}

}  // namespace
}  // namespace barycert::core
#endif
