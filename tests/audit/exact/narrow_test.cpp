// When machine words are wide enough, and that they never change an answer.
#include "tests/audit/exact/checks.hpp"

namespace barycert::exact {
namespace {

using namespace testing_cases;

TEST(Narrow, OrdinaryMeshesTakeIt) {
    // Multiples of 2^-53 below 1, as unit-cube meshes have, and single precision over a wide range.
    for (const Simplex simplex : all_simplices) {
        for (int k = 0; k < 500; ++k) {
            base::Random r = base::Random::stream(1, base::hash64("narrow"), static_cast<std::uint64_t>(k));
            Case c;
            c.simplex = simplex;
            const bool single = r.coin();
            const auto draw = [&] {
                return single ? static_cast<double>(static_cast<float>(r.scaled(1, 2, -18, 18))) : r.uniform(-1, 1);
            };
            for (double& x : c.vertices) x = draw();
            for (double& x : c.point) x = draw();
            for (double& x : c.values) x = draw();
            EXPECT_TRUE(ask_oracle(c).narrow) << describe(c);
            EXPECT_FALSE(ask_wide(c).narrow);
        }
    }
}

TEST(Narrow, ZerosCostNothing) {
    Case c{Simplex::tetrahedron, {0, 0, 0, 0x1p-1074, 0, 0, 0, 1, 0, 0, 0, 0x1p+1023}, {0, 0.25, 0x1p+1022}, {}};
    EXPECT_TRUE(ask_oracle(c).narrow);  // each axis has a scale of its own
    check(c);
    c.simplex = Simplex::segment;
    EXPECT_FALSE(ask_oracle(c).narrow);  // dot products mix the axes
    check(c);
}

/// An integer below 2^span in magnitude; the largest such doubles are drawn often.
double at_the_bound(base::Random& r, int span) {
    const double top = std::ldexp(0x1.fffffffffffffp-1, span);
    switch (r.integer(0, 6)) {
        case 0:
        case 1:
            return top;
        case 2:
        case 3:
            return -top;
        case 4:
            return r.coin() ? 1 : -1;
        case 5:
            return std::ldexp(r.coin() ? 1 : -1, span - 1);
        default:
            return std::trunc(r.uniform(-top, top));
    }
}

// Coordinates with the greatest differences that 61 bits allow: catches a minor or numerator that overflows its type.
TEST(Narrow, ExtremesAtTheBound) {
    int narrow = 0;
    for (int k = 0; k < 6000; ++k) {
        base::Random r = base::Random::stream(1, base::hash64("bound"), static_cast<std::uint64_t>(k));
        Case c;
        c.simplex = all_simplices[r.below(4)];
        // 61 is the last span that is narrow; a few more must be told and still be right. Coordinates and values apart:
        // either alone must decide.
        const int span = 61 + (r.coin() ? 0 : r.integer(1, 4));
        const int value_span = 61 + (r.integer(0, 3) > 0 ? 0 : r.integer(1, 4));
        for (double& x : c.vertices) x = at_the_bound(r, span);
        for (double& x : c.point) x = at_the_bound(r, span);
        for (double& x : c.values) x = at_the_bound(r, value_span);
        const int dimension = space_dimension(c.simplex);
        for (int axis = 0; axis < dimension; ++axis) {  // so that the span is what it is meant to be
            c.vertex(0, axis) = std::ldexp(0x1.fffffffffffffp-1, span) * (r.coin() ? 1 : -1);
            c.vertex(1, axis) = r.coin() ? 1 : -1;
        }
        c.values[0] = 1;
        c.values[1] = std::ldexp(-0x1.fffffffffffffp-1, value_span);
        // Powers of two change no span.
        const int shift = r.integer(-1000, 900);
        for (double& x : c.vertices) x = std::ldexp(x, shift);
        for (double& x : c.point) x = std::ldexp(x, shift);
        const OracleAnswer a = check(c);
        EXPECT_EQ(a.narrow, span == 61 && value_span == 61) << span << ' ' << value_span;
        narrow += a.narrow ? 1 : 0;
        ASSERT_FALSE(HasFailure()) << k;
    }
    EXPECT_GT(narrow, 2000);
}

// The values have a bound of their own. Catches a condition that asks the coordinates alone.
TEST(Narrow, ValuesAloneDecideToo) {
    Case c{Simplex::triangle, {0, 0, 3, 0, 0, 3}, {1, 1}, {1, 0x1p+60, -0x1p+60}};
    EXPECT_TRUE(ask_oracle(c).narrow);
    check(c);
    c.values[1] = 0x1p+61;
    EXPECT_FALSE(ask_oracle(c).narrow);
    check(c);
    c.values = {0x1p-1074, 0x1.fffffffffffffp+1023, 1, 0};
    EXPECT_FALSE(ask_oracle(c).narrow);
    check(c);
}

}  // namespace
}  // namespace barycert::exact
