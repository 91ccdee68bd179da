// The bound of the double-double tier of perspective, on every target of this build: plain + correction is nowhere
// farther from the exact quotient than `error`. Far sharper than the answers: a wrong rounding needs a tie nearby, this
// does not.
#include <gtest/gtest.h>

#include "barycert/environment.hpp"
#include "barycert/perspective.hpp"
#include "tests/core/rational.hpp"

// Before Highway's headers.
#include "core/simd_targets.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tests/core/perspective_bound_test.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h.
#include <hwy/highway.h>

#include "core/perspective-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace barycert::core {
namespace HWY_NAMESPACE {

/// plain, correction and error of three weights, depth and value, and whether each is valid.
void perspective_quotients(const double* vertices, const double* point, const double* values, double (*out)[3],
                           bool* valid) {
    using Wide = hn::ScalableTag<double>;
    using Lane = hn::Vec<Wide>;
    const auto lanes = project_lanes(Wide(), vertices, hn::Set(Wide(), point[0]), hn::Set(Wide(), point[1]));
    const Lane f[3] = {hn::Set(Wide(), values[0]), hn::Set(Wide(), values[1]), hn::Set(Wide(), values[2])};
    for (int i = 0; i < 5; ++i) {
        const auto q = i < 3    ? perspective_weight(Wide(), lanes, i)
                       : i == 3 ? perspective_depth(Wide(), lanes)
                                : perspective_value(Wide(), lanes, f);
        out[i][0] = hn::GetLane(q.plain);
        out[i][1] = hn::GetLane(q.correction);
        out[i][2] = hn::GetLane(q.error);
        valid[i] = hn::AllTrue(Wide(), q.valid);
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace barycert::core
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "tests/audit/exact/cases.hpp"
#include "tests/audit/exact/second_path.hpp"

namespace barycert::core {

HWY_EXPORT(perspective_quotients);

namespace {

using testing_rational::Q;

/// Triangles in a window, flat ones, ones far from the origin; depths of like size or far apart; points in and out.
Case bound_case(base::Random& r) {
    if (r.integer(0, 3) == 0)
        return testing_cases::random_perspective_case(
            r, testing_cases::all_kinds[r.below(testing_cases::all_kinds.size())]);
    Case c{.simplex = Simplex::triangle};
    c.perspective = true;
    const double distance = r.coin() ? 0 : r.scaled(1, 2, 0, 30);
    const double flat = r.coin() ? 1 : r.scaled(1, 2, -40, -1);
    double weights[3];
    for (double& w : weights) w = r.uniform(-0.3, 1);
    for (int i = 0; i < 3; ++i) {
        const double along = r.uniform(-1, 1);
        const double across = r.uniform(-1, 1);
        c.vertex(i, 0) = distance + along;
        c.vertex(i, 1) = distance + along + flat * across;
        c.depth(i) = r.coin() ? r.uniform(1, 10) : r.scaled(1, 2, -20, 20);
        c.values[static_cast<std::size_t>(i)] = r.coin() ? r.uniform(-1, 1) : r.scaled(-1, 1, -30, 30);
        for (std::size_t k = 0; k < 2; ++k) c.point[k] += weights[i] * c.vertex(i, static_cast<int>(k));
    }
    if (r.integer(0, 2) == 0) {  // a value near zero: its error is that of the numerator alone
        const auto w = perspective_weights(c.vertices.data(), c.point.data())->weights;
        c.values[2] = -(w[0] * c.values[0] + w[1] * c.values[1]) / w[2];
    }
    return c;
}

TEST(PerspectiveBound, HoldsOnEveryTarget) {
    for (const std::string& target : simd_targets()) {
        ASSERT_TRUE(use_simd_target(target));
        int met[5] = {};
        double nearest_to_bound[5] = {};
        for (std::uint64_t k = 0; k < 8000 && !HasFailure(); ++k) {
            base::Random r = base::Random::stream(22, base::hash64("perspective bound"), k);
            const Case c = bound_case(r);
            double q[5][3];
            bool valid[5];
            HWY_DYNAMIC_DISPATCH(perspective_quotients)
            (c.vertices.data(), c.point.data(), c.values.data(), q, valid);
            const auto exact = second_path::cast_ray(c);
            for (std::size_t i = 0; i < 5; ++i) {
                if (!valid[i] || !std::isfinite(q[i][2])) continue;
                ASSERT_TRUE(exact) << "degenerate, and told valid: " << testing_cases::describe(c);
                Q right = i < 4 ? (*exact)[i] : Q(0);
                for (std::size_t j = 0; j < 3 && i == 4; ++j) right += (*exact)[j] * Q(c.values[j]);
                ++met[i];
                const Q off = abs(Q(Q(q[i][0]) + Q(q[i][1]) - right));
                EXPECT_LE(off, Q(q[i][2])) << target << ' ' << i << ' ' << testing_cases::describe(c);
                if (q[i][2] > 0) nearest_to_bound[i] = std::max(nearest_to_bound[i], Q(off / Q(q[i][2])).get_d());
            }
        }
        for (std::size_t i = 0; i < 5; ++i) {
            EXPECT_GT(met[i], 4000) << target << ' ' << i;
            // The bound is no idle one: cases come within a small factor of it.
            EXPECT_GT(nearest_to_bound[i], 0x1p-7) << target << ' ' << i;
            RecordProperty(target + " " + std::to_string(i), std::to_string(nearest_to_bound[i]));
        }
    }
    use_simd_target("");
}

}  // namespace
}  // namespace barycert::core
#endif
