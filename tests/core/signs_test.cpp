// Law S1: signs against exact rationals, in every floating-point environment and on every SIMD target; law E: no sign
// of what is no number.

#include "barycert/environment.hpp"
#include "barycert/predicates.hpp"
#include "barycert/weights.hpp"
#include "tests/audit/exact/cases.hpp"
#include "tests/audit/exact/second_path.hpp"
#include "tests/core/environments.hpp"
#include "tests/core/rational.hpp"

namespace barycert {
namespace {

using testing_cases::all_kinds;
using testing_cases::describe;
using testing_cases::Kind;
using testing_cases::random_case;
using testing_environments::all_environments;
using testing_environments::Changed;
using testing_rational::Q;

Sign as_sign(int s) {
    return s < 0 ? Sign::negative : s > 0 ? Sign::positive : Sign::zero;
}

/// The determinant of the edges from vertex 0, expanded as written on paper.
Q determinant(const Case& c) {
    const auto e = second_path::edges(c);
    if (c.simplex == Simplex::triangle) return e[0][0] * e[1][1] - e[0][1] * e[1][0];
    return e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) - e[0][1] * (e[1][0] * e[2][2] - e[1][2] * e[2][0]) +
           e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0]);
}

bool has_orientation(Simplex s) {
    return s == Simplex::triangle || s == Simplex::tetrahedron;
}

Sign orientation_of(const Case& c) {
    const double* const v = c.vertices.data();
    return c.simplex == Simplex::triangle ? orient2d(v, v + 2, v + 4) : orient3d(v, v + 3, v + 6, v + 9);
}

/// The signs of the exact weights.
WeightSigns expected(const Case& c) {
    const auto w = second_path::weights(c);
    if (!w) return WeightSigns::degenerate_simplex();
    unsigned bits = has_orientation(c.simplex) && determinant(c) < 0 ? 1U << 8 : 0;
    for (std::size_t i = 0; i < w->size(); ++i) {
        if ((*w)[i] < 0) bits |= 1U << i;
        if ((*w)[i] == 0) bits |= 1U << (4 + i);
    }
    return WeightSigns(static_cast<WeightSigns::Bits>(bits));
}

/// Random cases, and some that are as near to a boundary as doubles allow: the point is a rounded combination of the
/// vertices, a vertex moved by an ulp, or the cell flattened into a plane but for rounding.
Case hard_case(base::Random& r, Simplex s, Kind kind) {
    Case c = random_case(r, s, kind);
    const int d = space_dimension(s), n = vertex_count(s), how = r.integer(0, 4);
    if (how == 0) return c;
    std::array<double, 4> w{};
    for (int i = 0; i < n; ++i) w[static_cast<std::size_t>(i)] = r.integer(0, 4) * 0.25;
    for (int k = 0; k < d; ++k) {
        double sum = 0;
        for (int i = how == 4 ? 1 : 0; i < n - 1; ++i)
            sum += w[static_cast<std::size_t>(i)] * (c.vertex(i, k) - c.vertex(n - 1, k));
        const double near = std::isfinite(sum + c.vertex(n - 1, k)) ? sum + c.vertex(n - 1, k) : c.vertex(0, k);
        if (how == 1) c.point[static_cast<std::size_t>(k)] = near;
        if (how == 2) c.vertex(0, k) = c.point[static_cast<std::size_t>(k)] = near;
        // The cell alone is flat, its denominator the rounding of a sum of large numerators.
        if (how == 4) c.vertex(0, k) = near;
        if (how == 3) c.point[static_cast<std::size_t>(k)] = std::nextafter(c.vertex(0, k), 0);
    }
    return c;
}

TEST(LawS1, SignsAreThoseOfRationals) {
    for (const Simplex s : all_simplices) {
        for (const Kind kind : all_kinds) {
            for (std::uint64_t k = 0; k < 250 && !HasFailure(); ++k) {
                base::Random r = base::Random::stream(2, base::hash64("signs"), k);
                const Case c = hard_case(r, s, kind);
                EXPECT_EQ(weight_signs(s, c.vertices.data(), c.point.data()), expected(c)) << describe(c);
                if (has_orientation(s)) {
                    EXPECT_EQ(orientation_of(c), as_sign(sgn(determinant(c)))) << describe(c);
                }
            }
        }
    }
}

// The filter's limits on extents: numbers about 2^+-100, 2^+-200, 2^+-300, some axes beyond and some within.
TEST(LawS1, AboutTheLimitsOfTheFilter) {
    for (const Simplex s : all_simplices) {
        for (std::uint64_t k = 0; k < 1500 && !HasFailure(); ++k) {
            base::Random r = base::Random::stream(2, base::hash64("limits"), k);
            Case c = hard_case(r, s, r.coin() ? Kind::ordinary : Kind::thin);
            const int limits[] = {-540, -301, -300, -200, -150, -100, 99, 100, 199, 299, 300, 340};
            int shift = limits[r.below(12)];
            for (int axis = 0; axis < space_dimension(s); ++axis) {
                if (has_orientation(s) || r.integer(0, 3) == 0) shift = limits[r.below(12)];
                for (int i = 0; i < vertex_count(s); ++i) c.vertex(i, axis) = std::ldexp(c.vertex(i, axis), shift);
                auto& p = c.point[static_cast<std::size_t>(axis)];
                p = std::ldexp(p, shift);
            }
            EXPECT_EQ(weight_signs(s, c.vertices.data(), c.point.data()), expected(c)) << describe(c);
            if (has_orientation(s)) {
                EXPECT_EQ(orientation_of(c), as_sign(sgn(determinant(c)))) << describe(c);
            }
        }
    }
}

// Catches a filter that counts on rounding to nearest, e = 2^-53 for 2^-52, or on gradual underflow.
TEST(LawS1, SignsAreTheSameInEveryEnvironmentAndOnEveryTarget) {
    constexpr std::size_t count = 256;
    for (const Simplex s : all_simplices) {
        for (const Kind kind : all_kinds) {
            std::vector<Case> cases;
            std::vector<WeightSigns> right;
            for (std::uint64_t k = 0; k < count; ++k) {
                base::Random r = base::Random::stream(3, base::hash64("environments"), k);
                cases.push_back(hard_case(r, s, kind));
                right.push_back(weight_signs(s, cases.back().vertices.data(), cases.back().point.data()));
            }
            const testing_environments::Columns columns(s, cases);
            for (const std::string& target : simd_targets()) {
                ASSERT_TRUE(use_simd_target(target));
                for (const auto& environment : all_environments()) {
                    std::vector<WeightSigns> got(count), single(count);
                    std::vector<Sign> orientations(count);
                    bool good = true;
                    {
                        const Changed changed(environment);
                        good = weight_signs(columns.arrays(), got).has_value();
                        for (std::size_t j = 0; j < count; ++j) {
                            single[j] = weight_signs(s, cases[j].vertices.data(), cases[j].point.data());
                            if (has_orientation(s)) orientations[j] = orientation_of(cases[j]);
                        }
                    }
                    ASSERT_TRUE(good);
                    for (std::size_t j = 0; j < count; ++j) {
                        ASSERT_EQ(got[j], right[j]) << environment.name << ' ' << target << ' ' << describe(cases[j]);
                        ASSERT_EQ(single[j], right[j])
                            << environment.name << ' ' << target << ' ' << describe(cases[j]);
                        if (has_orientation(s)) {
                            ASSERT_EQ(orientations[j], right[j].orientation())
                                << environment.name << describe(cases[j]);
                        }
                    }
                }
            }
        }
    }
    EXPECT_TRUE(use_simd_target(""));
}

// Under denormals-are-zero a comparison takes a subnormal for zero: catches numbers told to be zero by x == 0, which
// then have no place in the unit made for the others.
TEST(LawS1, SubnormalsBesideOrdinaryNumbersCountWhereTheyAreFlushed) {
    for (const Simplex s : all_simplices) {
        for (std::uint64_t k = 0; k < 200; ++k) {
            base::Random r = base::Random::stream(3, base::hash64("few subnormals"), k);
            Case c = random_case(r, s, r.coin() ? Kind::ordinary : Kind::lattice);
            const int n = vertex_count(s), d = space_dimension(s), axis = r.integer(0, d - 1);
            // On a face's plane but for subnormals, on one axis or on all.
            for (int i = 0; i < n; ++i) {
                for (int j = 0; j < d; ++j) {
                    if ((axis == j || r.coin()) && r.integer(0, 2) != 0) c.vertex(i, j) = r.integer(-3, 3) * 0x1p-1074;
                }
            }
            c.point[static_cast<std::size_t>(axis)] = r.integer(-3, 3) * 0x1p-1074;
            const WeightSigns right = expected(c);
            for (const auto& environment : all_environments()) {
                WeightSigns got;
                Sign orientation = Sign::zero;
                {
                    const Changed changed(environment);
                    got = weight_signs(s, c.vertices.data(), c.point.data());
                    if (has_orientation(s)) orientation = orientation_of(c);
                }
                ASSERT_EQ(got, right) << environment.name << describe(c);
                if (has_orientation(s)) {
                    ASSERT_EQ(orientation, right.orientation()) << environment.name << describe(c);
                }
            }
        }
    }
}

}  // namespace
}  // namespace barycert
