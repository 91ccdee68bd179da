// Laws of the exact weights that hold bit for bit, so that they need no second path.
#include <numeric>

#include "tests/audit/exact/checks.hpp"

namespace barycert::exact {
namespace {

using namespace testing_cases;

Case permuted(const Case& c, const std::array<int, 4>& order) {
    Case p = c;
    for (int i = 0; i < vertex_count(c.simplex); ++i) {
        const int from = order[static_cast<std::size_t>(i)];
        for (int axis = 0; axis < space_dimension(c.simplex); ++axis) p.vertex(i, axis) = c.vertex(from, axis);
        p.values[static_cast<std::size_t>(i)] = c.values[static_cast<std::size_t>(from)];
    }
    return p;
}

OracleAnswer permuted(const OracleAnswer& a, const std::array<int, 4>& order, int count) {
    OracleAnswer p = a;
    p.support = 0;
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
        const auto from = static_cast<std::size_t>(order[i]);
        p.weights[i] = a.weights[from];
        p.signs[i] = a.signs[from];
        if ((a.support >> from) % 2 != 0) p.support = static_cast<std::uint8_t>(p.support + (1 << i));
    }
    return p;
}

// Any permutation, even or odd: numerator and denominator change sign together. Catches a sign in the alternating
// determinants of the tetrahedron that only some order of vertices shows.
TEST(Laws, PermutationsPermuteTheAnswer) {
    for (int k = 0; k < 300; ++k) {
        base::Random r = base::Random::stream(1, base::hash64("permutation"), static_cast<std::uint64_t>(k));
        const Kind kind = all_kinds[r.below(all_kinds.size())];
        const Case c = random_case(r, all_simplices[r.below(4)], kind);
        const int count = vertex_count(c.simplex);
        const OracleAnswer a = ask_oracle(c);
        std::array<int, 4> order{0, 1, 2, 3};
        do {
            expect_same(ask_oracle(permuted(c, order)), permuted(a, order, count));
        } while (std::next_permutation(order.begin(), order.begin() + count));
        ASSERT_FALSE(HasFailure()) << describe(c);
    }
}

TEST(Laws, PowersOfTwoScaleNothing) {
    for (int k = 0; k < 3000; ++k) {
        base::Random r = base::Random::stream(1, base::hash64("scaling"), static_cast<std::uint64_t>(k));
        const Kind kind = r.coin() ? Kind::ordinary : Kind::lattice;
        const Case c = random_case(r, all_simplices[r.below(4)], kind);
        Case scaled = c;
        // Multiples of 2^-53 below 4: nothing is lost between 2^-1021 and 2^1021.
        const int shift = r.integer(-900, 1000);
        for (double& x : scaled.vertices) x = std::ldexp(x, shift);
        for (double& x : scaled.point) x = std::ldexp(x, shift);
        expect_same(ask_oracle(scaled), ask_oracle(c));
        // Axes of a full-dimensional simplex scale each on their own.
        if (c.simplex == Simplex::triangle || c.simplex == Simplex::tetrahedron) {
            scaled = c;
            const int own = r.integer(-900, 1000);
            for (int i = 0; i < vertex_count(c.simplex); ++i) scaled.vertex(i, 1) = std::ldexp(c.vertex(i, 1), own);
            scaled.point[1] = std::ldexp(c.point[1], own);
            expect_same(ask_oracle(scaled), ask_oracle(c));
        }
        // The value scales with the nodal values.
        scaled = c;
        for (double& f : scaled.values) f = std::ldexp(f, 100);
        expect_same_bits(ask_oracle(scaled).value, std::ldexp(ask_oracle(c).value, 100), "value");
        ASSERT_FALSE(HasFailure()) << describe(c);
    }
}

TEST(Laws, ExactTranslationsMoveNothing) {
    for (int k = 0; k < 3000; ++k) {
        base::Random r = base::Random::stream(1, base::hash64("translation"), static_cast<std::uint64_t>(k));
        Case c;
        c.simplex = all_simplices[r.below(4)];
        // Integers below 2^20 moved by integers below 2^50: every sum is exact.
        for (double& x : c.vertices) x = r.integer(-(1 << 20), 1 << 20);
        for (double& x : c.point) x = r.integer(-(1 << 20), 1 << 20);
        for (double& f : c.values) f = r.uniform(-1, 1);
        Case moved = c;
        for (int axis = 0; axis < space_dimension(c.simplex); ++axis) {
            const double by = std::trunc(r.uniform(-0x1p+50, 0x1p+50));
            for (int i = 0; i < vertex_count(c.simplex); ++i) moved.vertex(i, axis) += by;
            moved.point[static_cast<std::size_t>(axis)] += by;
        }
        expect_same(ask_oracle(moved), ask_oracle(c));
        EXPECT_EQ(affine_dimension(moved), affine_dimension(c));
        ASSERT_FALSE(HasFailure()) << describe(c);
    }
}

// A constant field is reproduced exactly, inside and far outside; so is a coordinate.
TEST(Laws, ConstantsAndCoordinatesAreReproduced) {
    for (int k = 0; k < 2000; ++k) {
        base::Random r = base::Random::stream(1, base::hash64("fields"), static_cast<std::uint64_t>(k));
        Case c =
            random_case(r, r.coin() ? Simplex::triangle : Simplex::tetrahedron, all_kinds[r.below(all_kinds.size())]);
        if (ask_oracle(c).region == Region::degenerate) continue;
        c.values.fill(c.point[0]);
        EXPECT_EQ(ask_oracle(c).value, c.point[0]);
        for (int i = 0; i < vertex_count(c.simplex); ++i) c.values[static_cast<std::size_t>(i)] = c.vertex(i, 1);
        EXPECT_EQ(ask_oracle(c).value, c.point[1]);
        ASSERT_FALSE(HasFailure()) << describe(c);
    }
}

}  // namespace
}  // namespace barycert::exact
