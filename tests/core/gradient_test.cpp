// Law G1 of gradients: against the oracle and against exact rationals rounded by the definition.
#include <algorithm>

#include "core/exact_tier.hpp"
#include "tests/core/gradient_cases.hpp"

namespace barycert::core {
namespace {

using testing_cases::all_kinds;
using testing_cases::describe;
using testing_cases::Kind;
using testing_cases::random_case;
using testing_fields::expect_as_oracle;
using testing_fields::expect_gradient_law;
using testing_fields::full;
using testing_fields::gradient_in;
using testing_fields::stretched_cell;
using testing_rational::bits;
using testing_rational::infinity;
using testing_rational::max;

constexpr double tiny = 0x1p-1074;

TEST(LawG1, ByHand) {
    // f = 1 + 2x - 3y (+ 5z) in the unit cell.
    const std::array<double, 6> triangle{0, 0, 1, 0, 0, 1};
    const std::array<double, 12> tetrahedron{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
    const std::array<double, 4> f{1, 3, -2, 6};
    EXPECT_EQ(gradient(Simplex::triangle, triangle.data(), f.data())->gradient, (std::array<double, 3>{2, -3, 0}));
    EXPECT_EQ(gradient(Simplex::tetrahedron, tetrahedron.data(), f.data())->gradient,
              (std::array<double, 3>{2, -3, 5}));
    // Thirds: edges of 3 and values 0 and 1.
    const std::array<double, 6> thirds{0, 0, 3, 0, 0, 3};
    const std::array<double, 3> g{0, 1, -1};
    EXPECT_EQ(gradient(Simplex::triangle, thirds.data(), g.data())->gradient,
              (std::array<double, 3>{1.0 / 3, -1.0 / 3, 0}));
}

TEST(LawG1, EveryKindOfNumber) {
    for (const Simplex s : full) {
        for (const Kind kind : all_kinds) {
            for (std::uint64_t k = 0; k < 600 && !HasFailure(); ++k) {
                base::Random r = base::Random::stream(22, base::hash64("gradients"), k);
                expect_gradient_law(random_case(r, s, kind));
            }
        }
    }
}

// Where double-double works hardest. Most are decided there, so that its answers are what is tested.
TEST(LawG1, FlatCellsFarFromTheOrigin) {
    for (const Simplex s : full) {
        std::uint64_t easy = 0;
        for (std::uint64_t k = 0; k < 8000 && !HasFailure(); ++k) {
            base::Random r = base::Random::stream(22, base::hash64("flat gradients"), k);
            const Case c = stretched_cell(r, s, 46);
            const Gradient g = gradient_in(c);
            easy += g.tier == Tier::double_double ? 1 : 0;
            expect_as_oracle(c, g);
        }
        EXPECT_GT(easy, 5000U) << name(s);
    }
}

TEST(LawG1, RoundedAtTheEndsOfTheRange) {
    const auto slope = [](double length, double rise) {
        Case c{.simplex = Simplex::triangle, .values = {0, rise, 0}};
        c.vertices = {0, 0, length, 0, 0, 1};
        expect_gradient_law(c);
        return gradient_in(c).gradient[0];
    };
    EXPECT_EQ(slope(tiny, 1), infinity);
    EXPECT_EQ(slope(tiny, -1), -infinity);
    EXPECT_EQ(slope(0.5, max), infinity);
    EXPECT_EQ(slope(1, max), max);
    EXPECT_EQ(slope(2, tiny), 0);  // a tie of 0 and the smallest subnormal, to the even one
    EXPECT_TRUE(std::signbit(slope(2, -tiny)));
    EXPECT_EQ(slope(2, 3 * tiny), 2 * tiny);
    EXPECT_EQ(slope(max, tiny), 0);
    EXPECT_EQ(slope(0x1p60, 0x1.0000000000001p-970), 0x1p-1030);
    // Middles of two neighbours, by an edge of 2^53: up and down.
    EXPECT_EQ(slope(0x1p53, 0x1p53 + 2), 1 + 0x1p-52);
    Case c{.simplex = Simplex::triangle, .values = {-0x1p-53, 1, 0}};
    c.vertices = {0, 0, 1, 0, 0, 1};
    EXPECT_EQ(gradient_in(c).gradient[0], 1);
    EXPECT_EQ(gradient_in(c).tier, Tier::exact);
    c.values = {-0x1p-53, 1 + 0x1p-52, 0};
    EXPECT_EQ(gradient_in(c).gradient[0], 1 + 0x1p-51);
    c.values = {-0.0, -0.0, 0.0};  // zero is +0
    EXPECT_EQ(bits(gradient_in(c).gradient[0]), 0U);
    EXPECT_EQ(gradient_in(c).tier, Tier::double_double);
}

// The last tier alone, where integers of one limb give way to two, and two to more.
TEST(LawG1, IntegersOfEveryWidth) {
    for (const Simplex s : full) {
        for (const int coordinate_bits : {3, 58, 60, 61, 62, 63, 64, 122, 124, 125, 126, 127, 128, 400}) {
            for (const int value_bits : {3, 59, 60, 61, 62, 63, 64, 123, 125, 126, 128, 900}) {
                for (std::uint64_t k = 0; k < 30 && !HasFailure(); ++k) {
                    base::Random r = base::Random::stream(22, base::hash64("widths"), k);
                    const Case c = testing_fields::case_of_widths(r, s, coordinate_bits, value_bits);
                    Gradient g;
                    g.degenerate = !exact_gradient(s, c.vertices.data(), c.values.data(), g.gradient.data());
                    expect_as_oracle(c, g);
                }
            }
        }
    }
}

// A linear field with short coefficients on short coordinates is given back to the bit.
TEST(LawG1, LinearFieldsAreGivenBack) {
    for (const Simplex s : full) {
        const int n = vertex_count(s), d = space_dimension(s);
        for (std::uint64_t k = 0; k < 2000; ++k) {
            base::Random r = base::Random::stream(22, base::hash64("linear"), k);
            Case c{.simplex = s};
            std::array<double, 3> a{};
            for (int m = 0; m < d; ++m) a[static_cast<std::size_t>(m)] = r.integer(-1000, 1000) * 0x1p-7;
            for (int i = 0; i < n; ++i) {
                double f = 3;
                for (int m = 0; m < d; ++m) {
                    c.vertex(i, m) = r.integer(-100000, 100000) * 0x1p-10;
                    f += a[static_cast<std::size_t>(m)] * c.vertex(i, m);  // exact: few bits
                }
                c.values[static_cast<std::size_t>(i)] = f;
            }
            const Gradient g = gradient_in(c);
            if (g.degenerate) continue;
            EXPECT_EQ(g.gradient, a) << describe(c);
        }
    }
}

TEST(LawG1, TheOrderOfVerticesDoesNotMatter) {
    for (const Simplex s : full) {
        const std::size_t n = static_cast<std::size_t>(vertex_count(s)), d = n - 1;
        for (std::uint64_t k = 0; k < 200; ++k) {
            base::Random r = base::Random::stream(22, base::hash64("order"), k);
            const Case c = k % 2 == 0 ? stretched_cell(r, s) : random_case(r, s, all_kinds[k / 2 % all_kinds.size()]);
            const Gradient first = gradient_in(c);
            if (first.degenerate) continue;
            std::array<std::size_t, 4> order{0, 1, 2, 3};
            while (std::next_permutation(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(n))) {
                Case other = c;
                for (std::size_t i = 0; i < n; ++i) {
                    for (std::size_t m = 0; m < d; ++m) other.vertices[d * i + m] = c.vertices[d * order[i] + m];
                    other.values[i] = c.values[order[i]];
                }
                const Gradient g = gradient_in(other);
                for (std::size_t m = 0; m < d; ++m) ASSERT_EQ(bits(g.gradient[m]), bits(first.gradient[m]));
            }
        }
    }
}

}  // namespace
}  // namespace barycert::core
