// Error-free transforms, double-double, and the bounds of both tiers, on every target of this build: exact against
// rationals where they claim to be exact, within the stated bounds elsewhere.
#include <gtest/gtest.h>

#include "tests/core/rational.hpp"

// Before Highway's headers.
#include "core/simd_targets.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tests/core/error_free_test.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h.
#include <hwy/highway.h>

#include "core/refinement-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace barycert::core {
namespace HWY_NAMESPACE {

/// The same number in all lanes of the widest vectors: what the library works on.
using Wide = hn::ScalableTag<double>;
using Lane = hn::Vec<Wide>;

inline Lane lane(double x) {
    return hn::Set(Wide(), x);
}
inline double number(Lane x) {
    return hn::GetLane(x);
}

/// high and low of transform `which`.
void transform(int which, double x, double y, double* out) {
    const TwoTerms<Lane> t = which == 0   ? two_sum(lane(x), lane(y))
                             : which == 1 ? two_difference(lane(x), lane(y))
                             : which == 2 ? quick_two_sum(lane(x), lane(y))
                                          : two_product(lane(x), lane(y));
    out[0] = number(t.high);
    out[1] = number(t.low);
}

/// The form of two_product for targets without fused multiply-add, on this one; and the halves of x.
void dekker(double x, double y, double* out) {
    const TwoTerms<Lane> a = split(lane(x)), b = split(lane(y));
    const Lane p = lane(x) * lane(y);
    out[0] = number(p);
    out[1] = number(((a.high * b.high - p) + a.high * b.low + a.low * b.high) + a.low * b.low);
    out[2] = number(a.high);
    out[3] = number(a.low);
}

/// x op y of double-doubles; 0: +, 1: -, 2: *.
void double_double(int which, const double* x, const double* y, double* out) {
    const DoubleDouble<Lane> a{lane(x[0]), lane(x[1])}, b{lane(y[0]), lane(y[1])};
    const DoubleDouble<Lane> r = which == 0 ? a + b : which == 1 ? a - b : a * b;
    out[0] = number(r.high);
    out[1] = number(r.low);
}

/// weight and correction of each vertex, the bound, the magnitude; whether they are valid.
template <Simplex s>
bool refined_of(const double* vertices, const double* point, double* weight, double* correction, double* error) {
    Absolute<s, Lane> c;
    constexpr int n = vertex_count(s), d = space_dimension(s);
    for (int k = 0; k < d; ++k) {
        c.p[k] = lane(point[k]);
        for (int i = 0; i < n; ++i) c.v[i][k] = lane(vertices[d * i + k]);
    }
    Refined<s, Wide> r;
    if constexpr (s == Simplex::tetrahedron || s == Simplex::triangle) {
        r = refine<s>(Wide(), c);
    } else {
        r = refine_projected<s>(Wide(), c);
    }
    for (int i = 0; i < n; ++i) {
        weight[i] = number(r.weight[i]);
        correction[i] = number(r.correction[i]);
    }
    *error = number(r.error);
    return hn::AllTrue(Wide(), r.valid);
}

bool refined(Simplex s, const double* vertices, const double* point, double* weight, double* correction,
             double* error) {
    switch (s) {
        case Simplex::segment:
            return refined_of<Simplex::segment>(vertices, point, weight, correction, error);
        case Simplex::triangle:
            return refined_of<Simplex::triangle>(vertices, point, weight, correction, error);
        case Simplex::triangle3d:
            return refined_of<Simplex::triangle3d>(vertices, point, weight, correction, error);
        default:
            return refined_of<Simplex::tetrahedron>(vertices, point, weight, correction, error);
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace barycert::core
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "tests/audit/exact/cases.hpp"
#include "tests/audit/exact/second_path.hpp"

namespace barycert::core {

HWY_EXPORT(transform);
HWY_EXPORT(dekker);
HWY_EXPORT(double_double);
HWY_EXPORT(refined);

namespace {

using testing_rational::bits;
using testing_rational::nearest;
using testing_rational::Q;
using testing_rational::scaled_by;

const Q u(0x1p-53);

/// Runs `use` on each target that this build has and this processor can run.
template <class Use>
void on_every_target(Use use) {
    const std::vector<std::int64_t> targets = hwy::SupportedAndGeneratedTargets();
    ASSERT_FALSE(targets.empty());
    for (const std::int64_t target : targets) {
        hwy::GetChosenTarget().Update(target);
        SCOPED_TRACE(hwy::TargetName(target));
        use();
    }
    hwy::GetChosenTarget().DeInit();
}

/// Exponents that meet, cancel, or miss each other; few bits at times.
double awkward(base::Random& r, int low, int high) {
    const double x = r.integer(0, 2) == 0 ? r.integer(-9, 9) : r.uniform(-1, 1);
    const double y =
        x != 0 && r.integer(0, 3) == 0 ? std::bit_cast<double>(bits(x) | 0xfffffffffULL) : x;  // runs of ones
    return std::ldexp(y, r.integer(0, 1) == 0 ? r.integer(low, high) : r.integer(-3, 3));
}

TEST(ErrorFree, SumsAndDifferencesAreExactDownToSubnormals) {
    on_every_target([] {
        for (std::uint64_t k = 0; k < 4000 && !::testing::Test::HasFailure(); ++k) {
            base::Random r = base::Random::stream(10, base::hash64("sums"), k);
            double x = awkward(r, -110, 110), y = awkward(r, -110, 110), out[2];
            const int shift = k % 4 == 0 ? -1060 : k % 4 == 1 ? 900 : 0;  // sums never underflow inexactly
            x = std::ldexp(x, shift);
            y = std::ldexp(y, shift);
            for (int which = 0; which < 2; ++which) {
                HWY_DYNAMIC_DISPATCH(transform)(which, x, y, out);
                const Q exact = which == 0 ? Q(Q(x) + Q(y)) : Q(Q(x) - Q(y));
                EXPECT_EQ(Q(out[0]) + Q(out[1]), exact) << base::hexadecimal(x) << ' ' << base::hexadecimal(y);
                EXPECT_TRUE(exact == 0 || nearest(out[0], exact));
            }
            if (std::fabs(x) < std::fabs(y)) std::swap(x, y);
            HWY_DYNAMIC_DISPATCH(transform)(2, x, y, out);
            EXPECT_EQ(Q(out[0]) + Q(out[1]), Q(x) + Q(y));
            HWY_DYNAMIC_DISPATCH(transform)(2, 0.0, y, out);
            EXPECT_EQ(out[0], y);
            EXPECT_EQ(out[1], 0);
        }
    });
}

/// Bits from the first one to the last.
int length(double x) {
    int exponent;
    const auto m = static_cast<std::uint64_t>(std::fabs(std::frexp(x, &exponent)) * 0x1p53);
    return m == 0 ? 0 : 53 - std::countr_zero(m);
}

// In the whole range that is claimed: |x y| >= 2^-969 and |x|, |y| <= 2^995. Dekker's form and the fused one agree to
// the bit: catches the order of its terms, and a split that rounds.
TEST(ErrorFree, ProductsAreExactAndBothFormsAgree) {
    on_every_target([] {
        int tried = 0;
        for (std::uint64_t k = 0; k < 8000 && !::testing::Test::HasFailure(); ++k) {
            base::Random r = base::Random::stream(10, base::hash64("products"), k);
            const int of_x = r.integer(-1000, 994), of_y = r.integer(-1000, 994);
            const double x = std::ldexp(awkward(r, 0, 0) / 9, of_x), y = std::ldexp(awkward(r, 0, 0) / 9, of_y);
            if (x != 0 && y != 0) {
                const double p = x * y;
                if (std::fabs(p) < 0x1p-968 || std::fabs(p) > 0x1p1020) continue;
            }
            ++tried;
            double out[2], both[4];
            HWY_DYNAMIC_DISPATCH(transform)(3, x, y, out);
            EXPECT_EQ(Q(out[0]) + Q(out[1]), Q(x) * Q(y)) << base::hexadecimal(x) << ' ' << base::hexadecimal(y);
            HWY_DYNAMIC_DISPATCH(dekker)(x, y, both);
            EXPECT_EQ(both[0], out[0]);
            EXPECT_EQ(both[1], out[1]) << base::hexadecimal(x) << ' ' << base::hexadecimal(y);
            EXPECT_EQ(out[1], std::fma(x, y, -out[0]));
            // 26 bits each: every product of halves is exact.
            EXPECT_EQ(both[2] + both[3], x);
            EXPECT_LE(length(both[2]), 26) << base::hexadecimal(x);
            EXPECT_LE(length(both[3]), 26) << base::hexadecimal(x);
        }
        EXPECT_GT(tried, 3000);
    });
}

TEST(DoubleDouble, SumsAndProductsAreWithinTheirBounds) {
    on_every_target([] {
        for (std::uint64_t k = 0; k < 8000 && !::testing::Test::HasFailure(); ++k) {
            base::Random r = base::Random::stream(10, base::hash64("double-double"), k);
            double x[2], y[2], out[2];
            for (double* const z : {x, y}) {
                z[0] = awkward(r, -60, 60);
                z[1] = std::ldexp(z[0], -53) * r.uniform(-1, 1);
                if (r.integer(0, 3) == 0) z[1] = std::ldexp(z[0], -53) * 0.5;
            }
            if (r.integer(0, 2) == 0) {  // high parts cancel, altogether or to a few ulps
                y[0] = -x[0];
                if (r.coin()) y[0] = std::nextafter(y[0], 0);
                y[1] = std::ldexp(y[0], -53) * r.uniform(-1, 1);
            }
            const Q a = Q(x[0]) + Q(x[1]), b = Q(y[0]) + Q(y[1]);
            for (int which = 0; which < 3; ++which) {
                HWY_DYNAMIC_DISPATCH(double_double)(which, x, y, out);
                const Q exact = which == 0 ? Q(a + b) : which == 1 ? Q(a - b) : Q(a * b);
                const Q bound = which == 2 ? Q(9 * u * u * abs(exact)) : Q(4 * u * u * (abs(a) + abs(b)));
                EXPECT_LE(abs(Q(Q(out[0]) + Q(out[1]) - exact)), bound)
                    << which << ' ' << base::hexadecimal(x[0]) << ' ' << base::hexadecimal(y[0]);
                EXPECT_LE(abs(Q(out[1])), u * abs(Q(out[0])));  // normalised
            }
        }
    });
}

/// Cells that are round, flat, anisotropic, far away; the point inside, outside or on a vertex.
Case cell(base::Random& r, Simplex s) {
    Case c{.simplex = s};
    const int n = vertex_count(s), d = space_dimension(s), flat = r.coin() ? 0 : r.integer(0, 40);
    const double distance = r.coin() ? 0 : r.scaled(1, 2, 0, 30);
    int shift[3] = {};
    for (int& x : shift) x = r.integer(0, 3) == 0 ? r.integer(-30, 30) : 0;
    for (int k = 0; k < d; ++k) {
        for (int i = 0; i < n; ++i) {
            const double along = k == d - 1 ? std::ldexp(r.uniform(-1, 1), -flat) + c.vertex(i, 0) : r.uniform(-1, 1);
            c.vertex(i, k) = along;
        }
    }
    double w[4];
    for (double& x : w) x = r.uniform(-1, 1);
    for (int k = 0; k < d; ++k) {
        double p = 0;
        for (int i = 0; i < n; ++i) p += w[i] * c.vertex(i, k);
        c.point[static_cast<std::size_t>(k)] = std::ldexp(p, shift[k]) + distance;
        for (int i = 0; i < n; ++i) c.vertex(i, k) = std::ldexp(c.vertex(i, k), shift[k]) + distance;
        if (r.integer(0, 9) == 0) c.point[static_cast<std::size_t>(k)] = c.vertex(0, k);
    }
    return c;
}

// The claim itself, not what is made of it: weight + correction is nowhere farther from the exact weight than `error`.
// By far the sharpest test of refinement-inl.hpp: a wrong rounding needs a tie nearby, this does not.
TEST(Refinement, TheBoundHolds) {
    on_every_target([] {
        for (const Simplex s : all_simplices) {
            int valid = 0;
            for (std::uint64_t k = 0; k < 3000 && !::testing::Test::HasFailure(); ++k) {
                base::Random r = base::Random::stream(11, base::hash64("bounds"), k);
                const Case c =
                    k % 3 == 0 ? testing_cases::random_case(r, s, testing_cases::all_kinds[r.below(8)]) : cell(r, s);
                double weight[4], correction[4], error;
                if (!HWY_DYNAMIC_DISPATCH(refined)(s, c.vertices.data(), c.point.data(), weight, correction, &error))
                    continue;
                const auto exact = second_path::weights(c);
                ASSERT_TRUE(exact) << "degenerate, and told valid: " << testing_cases::describe(c);
                if (!std::isfinite(error)) continue;
                ++valid;
                for (std::size_t i = 0; i < exact->size(); ++i)
                    EXPECT_LE(abs(Q(Q(weight[i]) + Q(correction[i]) - (*exact)[i])), Q(error))
                        << testing_cases::describe(c);
            }
            EXPECT_GT(valid, 1000) << name(s);
        }
    });
}

}  // namespace
}  // namespace barycert::core
#endif
