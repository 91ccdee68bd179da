// Exact residuals of somebody else's weights, rounded once.
#include "tests/audit/exact/checks.hpp"

namespace barycert::exact {
namespace {

using namespace testing_cases;
using second_path::Q;

double expected_partition(std::span<const double> weights) {
    Q sum(-1);
    for (const double w : weights) sum += Q(w);
    return second_path::nearest(sum);
}

double expected_reproduction(const Case& c, const std::vector<Q>& exact, std::span<const double> weights) {
    Q square(0);
    for (int axis = 0; axis < space_dimension(c.simplex); ++axis) {
        Q component(0);
        for (int i = 0; i < vertex_count(c.simplex); ++i) {
            const auto k = static_cast<std::size_t>(i);
            component += (Q(weights[k]) - exact[k]) * Q(c.vertex(i, axis));
        }
        square += component * component;
    }
    return second_path::nearest_root(square);
}

TEST(Partition, ByHand) {
    const auto residual = [](std::vector<double> w) { return partition_residual(w); };
    EXPECT_EQ(residual({0.5, 0.25}), -0.25);
    EXPECT_EQ(residual({0.25, 0.25, 0.25, 0.25}), 0);
    // 1/3 rounds down by 2^-54 / 3. In doubles the sum would be 1; catches a residual computed in doubles.
    EXPECT_EQ(residual({1 / 3.0, 1 / 3.0, 1 / 3.0}), -0x1p-54);
    EXPECT_EQ(residual({1, 0x1p-1074, 0, 0}), 0x1p-1074);
    EXPECT_EQ(residual({0x1p+1023, -0x1p+1023, 1, 0x1p-60}), 0x1p-60);
    EXPECT_EQ(residual({0x1.fffffffffffffp+1023, 0x1p+1023}), HUGE_VAL);
    EXPECT_EQ(residual({0, 0, 0}), -1);
    EXPECT_EQ(residual({0x1p-54, 0, 0}), -1);                       // a tie, to even
    EXPECT_EQ(residual({0x1.8p-54, 0, 0}), -0x1.fffffffffffffp-1);  // beyond it
    EXPECT_FALSE(std::signbit(residual({0.5, 0.5})));               // zero is +0
}

TEST(Partition, EqualsTheSecondPath) {
    for (int k = 0; k < 20000; ++k) {
        base::Random r = base::Random::stream(1, base::hash64("partition"), static_cast<std::uint64_t>(k));
        const Kind kind = all_kinds[r.below(all_kinds.size())];
        std::array<double, 4> w{};
        for (double& x : w) x = number(r, kind, r.integer(0, 2));
        const auto count = static_cast<std::size_t>(r.integer(2, 4));
        const std::span<const double> used(w.data(), count);
        expect_same_bits(partition_residual(used), expected_partition(used), name(kind));
        ASSERT_FALSE(HasFailure()) << k;
    }
}

TEST(Reproduction, ByHand) {
    const std::array<double, 4> none{}, first{1, 0, 0, 0};
    const Case flat{Simplex::triangle, {0, 0, 8, 0, 0, 8}, {3, 4}, {}};
    EXPECT_EQ(reproduction_residual(flat, first), 5);
    EXPECT_EQ(reproduction_residual(flat, std::array<double, 4>{0.125, 0.375, 0.5}), 0);
    // Weights that do not sum to one: measured from the point itself, not relative to it. Catches a residual formed
    // from vertices relative to the point, which would be 0 here.
    const Case moved{Simplex::triangle, {300, 400, 301, 400, 300, 401}, {300, 400}, {}};
    EXPECT_EQ(reproduction_residual(moved, none), 500);
    // Irrational lengths: IEEE's square root of an exact operand is correctly rounded.
    EXPECT_EQ(reproduction_residual({Simplex::triangle, {0, 0, 8, 0, 0, 8}, {1, 1}, {}}, first), std::sqrt(2.0));
    EXPECT_EQ(reproduction_residual({Simplex::tetrahedron, {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, {1, 1, 1}, {}}, first),
              std::sqrt(3.0));
    // From the projection, not from the point: 5 in the plane, whatever the height.
    const Case raised{Simplex::triangle3d, {0, 0, 1, 8, 0, 1, 0, 8, 1}, {3, 4, 77}, {}};
    EXPECT_EQ(reproduction_residual(raised, first), 5);
    const Case line{Simplex::segment, {0, 0, 0, 3, 4, 0}, {3, 4, 9}, {}};
    EXPECT_EQ(reproduction_residual(line, first), 5);
}

TEST(Reproduction, EqualsTheSecondPath) {
    for (const Kind kind : all_kinds) {
        const int count = kind == Kind::bit_patterns ? 100 : 600;
        for (int k = 0; k < count; ++k) {
            base::Random r = base::Random::stream(1, base::hash64("reproduction") + base::hash64(name(kind)),
                                                  static_cast<std::uint64_t>(k));
            const Case c = random_case(r, all_simplices[r.below(4)], kind);
            const auto exact = second_path::weights(c);
            if (!exact) continue;
            SCOPED_TRACE(describe(c));
            // The best weights in doubles, the same off by ulps, and anything at all.
            std::array<double, 4> w{};
            for (std::size_t i = 0; i < exact->size(); ++i) w[i] = second_path::nearest((*exact)[i]);
            for (int variant = 0; variant < 3; ++variant) {
                for (std::size_t i = 0; i < exact->size(); ++i) {
                    if (variant == 1) w[i] = std::nextafter(w[i], r.coin() ? 1 : -1);
                    if (variant == 2) w[i] = number(r, kind, 0);
                    if (!std::isfinite(w[i])) w[i] = 0x1.fffffffffffffp+1023;
                }
                expect_same_bits(reproduction_residual(c, w), expected_reproduction(c, *exact, w), name(kind));
            }
            ASSERT_FALSE(HasFailure()) << name(kind) << k;
        }
    }
}

}  // namespace
}  // namespace barycert::exact
