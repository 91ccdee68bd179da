// Laws S1 and S2 on cases made by hand and at random. See signs_test.cpp for signs against exact rationals.
#include "barycert/predicates.hpp"

#include <algorithm>
#include <numeric>
#include <vector>

#include "tests/audit/exact/cases.hpp"
#include "tests/core/environments.hpp"
#include "tests/core/rational.hpp"

namespace barycert {
namespace {

using testing_cases::all_kinds;
using testing_cases::describe;
using testing_cases::Kind;
using testing_cases::random_case;

WeightSigns signs(const Case& c) {
    return weight_signs(c.simplex, c.vertices.data(), c.point.data());
}

Sign negated(Sign s) {
    return s == Sign::zero ? s : s == Sign::positive ? Sign::negative : Sign::positive;
}

/// Calls use(order, odd) for every order of 0 ... n-1.
template <class Use>
void for_permutations(std::size_t n, Use use) {
    std::vector<std::size_t> order(n);
    std::iota(order.begin(), order.end(), std::size_t{0});
    do {
        int inversions = 0;
        for (std::size_t i = 0; i < n; ++i) {
            for (std::size_t j = i + 1; j < n; ++j) inversions += order[i] > order[j] ? 1 : 0;
        }
        use(order, inversions % 2 != 0);
    } while (std::next_permutation(order.begin(), order.end()));
}

Case permuted(const Case& c, const std::vector<std::size_t>& order) {
    Case r = c;
    for (std::size_t i = 0; i < order.size(); ++i) {
        for (int k = 0; k < space_dimension(c.simplex); ++k)
            r.vertex(static_cast<int>(i), k) = c.vertex(static_cast<int>(order[i]), k);
    }
    return r;
}

/// Orientations of the vertices by themselves.
Sign orient(const Case& c) {
    const double* const v = c.vertices.data();
    return c.simplex == Simplex::triangle ? orient2d(v, v + 2, v + 4) : orient3d(v, v + 3, v + 6, v + 9);
}

bool solid(Simplex s) {
    return s == Simplex::triangle || s == Simplex::tetrahedron;
}

void expect_law_of_permutations(const Case& c) {
    const WeightSigns original = signs(c);
    for_permutations(static_cast<std::size_t>(vertex_count(c.simplex)), [&](const auto& order, bool odd) {
        const Case p = permuted(c, order);
        const WeightSigns got = signs(p);
        EXPECT_EQ(got.degenerate(), original.degenerate());
        for (std::size_t i = 0; i < order.size(); ++i)
            EXPECT_EQ(got.sign(static_cast<int>(i)), original.sign(static_cast<int>(order[i]))) << describe(p);
        EXPECT_EQ(got.region(), original.region());
        const bool flips = odd && solid(c.simplex);
        EXPECT_EQ(got.orientation(), flips ? negated(original.orientation()) : original.orientation()) << describe(p);
        if (!solid(c.simplex)) return;
        EXPECT_EQ(orient(p), odd ? negated(orient(c)) : orient(c)) << describe(p);
        EXPECT_EQ(orient(p), got.orientation()) << describe(p);
    });
}

// Every tier answers some of these kinds. Catches a formula that treats vertices unequally, in any of them.
TEST(LawS2, EvenPermutationsKeepOddOnesFlip) {
    for (const Simplex s : all_simplices) {
        for (const Kind kind : all_kinds) {
            for (std::uint64_t k = 0; k < 300 && !HasFailure(); ++k) {
                base::Random r = base::Random::stream(1, base::hash64("permutations"), k);
                expect_law_of_permutations(random_case(r, s, kind));
            }
        }
    }
}

/// All coordinates of an axis times 2^shift; nothing if that is not exact.
std::optional<Case> scaled(const Case& c, const std::array<int, 3>& shifts) {
    Case r = c;
    const auto scale = [](double& x, int shift) {
        const double y = std::ldexp(x, shift);
        const bool exact = std::isfinite(y) && std::ldexp(y, -shift) == x;
        x = y;
        return exact;
    };
    for (int k = 0; k < space_dimension(c.simplex); ++k) {
        const auto axis = static_cast<std::size_t>(k);
        for (int i = 0; i < vertex_count(c.simplex); ++i) {
            if (!scale(r.vertex(i, k), shifts[axis])) return std::nullopt;
        }
        if (!scale(r.point[axis], shifts[axis])) return std::nullopt;
    }
    return r;
}

// To the ends of the range, where the filter may not answer, and across its limits at 2^+-100 and 2^+-300.
TEST(LawS2, PowersOfTwoOnAnAxisChangeNoSign) {
    int done = 0;
    for (const Simplex s : all_simplices) {
        for (const Kind kind : {Kind::ordinary, Kind::lattice, Kind::thin, Kind::anisotropic}) {
            for (std::uint64_t k = 0; k < 400 && !HasFailure(); ++k) {
                base::Random r = base::Random::stream(1, base::hash64("powers of two"), k);
                Case c = random_case(r, s, kind);
                if (r.coin()) {  // few bits, so that subnormals hold them
                    const auto shorten = [](double& x) { x = static_cast<float>(x); };
                    std::for_each(c.vertices.begin(), c.vertices.end(), shorten);
                    std::for_each(c.point.begin(), c.point.end(), shorten);
                }
                for (const int range : {40, 310, 1070}) {
                    std::array<int, 3> shifts{};
                    for (int& shift : shifts) shift = r.integer(-range, std::min(range, 1020));
                    if (!solid(s)) shifts.fill(shifts[0]);  // all axes alike, for these
                    const auto image = scaled(c, shifts);
                    if (!image) continue;
                    ++done;
                    EXPECT_EQ(signs(*image), signs(c)) << describe(c) << describe(*image);
                    if (solid(s)) {
                        EXPECT_EQ(orient(*image), orient(c)) << describe(c) << describe(*image);
                    }
                }
            }
        }
    }
    EXPECT_GT(done, 8000);
}

// Stage A of the classical adaptive predicate, as it is used without a look at the range: naive determinant, and the
// bound (7 + 56 e) e times the permanent. Here products underflow, the filter passes and the sign is wrong.
TEST(LawS1, WhereTheClassicalFilterCertifiesAWrongSign) {
    const double a[3] = {0.6 * 0x1p-537, 0, 0x1p600}, b[3] = {1.4 * 0x1p-537, 0, 1.5 * 0x1p600},
                 c[3] = {0, 0x1p-537, 0}, d[3] = {0, 0, 0};
    // As predicates.c has it: differences to the last point, expanded along z. Volatile: evaluated as written.
    const auto product = [](double x, double y) {
        volatile double p = x * y;
        return p;
    };
    const double bdxcdy = product(b[0], c[1]), cdxbdy = product(c[0], b[1]), cdxady = product(c[0], a[1]);
    const double adxcdy = product(a[0], c[1]), adxbdy = product(a[0], b[1]), bdxady = product(b[0], a[1]);
    const double det = product(a[2], bdxcdy - cdxbdy) + product(b[2], cdxady - adxcdy) + product(c[2], adxbdy - bdxady);
    const double permanent = product(std::fabs(bdxcdy) + std::fabs(cdxbdy), std::fabs(a[2])) +
                             product(std::fabs(cdxady) + std::fabs(adxcdy), std::fabs(b[2])) +
                             product(std::fabs(adxbdy) + std::fabs(bdxady), std::fabs(c[2]));
    constexpr double e = 0x1p-53;
    ASSERT_GT(std::fabs(det), (7 + 56 * e) * e * permanent);  // stage A is sure of itself
    ASSERT_LT(det, 0);

    // det(a-d, b-d, c-d) by rationals: its sign is Shewchuk's, the opposite of det(b-a, c-a, d-a).
    using testing_rational::Q;
    const Q exact = Q(a[2]) * Q(b[0]) * Q(c[1]) - Q(b[2]) * Q(a[0]) * Q(c[1]);
    ASSERT_GT(exact, 0);
    EXPECT_EQ(orient3d(a, b, c, d), Sign::negative);
    EXPECT_EQ(orient3d(b, a, c, d), Sign::positive);

    // As the weight of a fourth vertex: the cell's own orientation, and the point d in a cell with far vertex.
    Case t{.simplex = Simplex::tetrahedron,
           .vertices = {a[0], a[1], a[2], b[0], b[1], b[2], c[0], c[1], c[2], 0, 0, 0},
           .point = {0, 0, 0}};
    EXPECT_EQ(signs(t).orientation(), Sign::negative);
    EXPECT_EQ(signs(t).feature(Simplex::tetrahedron), Feature::vertex);
    t.vertex(3, 0) = -0x1p-500;  // now d is only the point: the weight of vertex 3 has the sign of orient3d(a, b, c, d)
    const double* const v = t.vertices.data();
    const Sign cell = orient3d(v, v + 3, v + 6, v + 9);
    ASSERT_NE(cell, Sign::zero);
    EXPECT_EQ(signs(t).sign(3), cell == Sign::negative ? Sign::positive : Sign::negative);
}

/// Coordinates of the point and what should be found there.
struct At {
    std::array<double, 3> point;
    Feature feature;
    const char* signs;  ///< of the weights
};

void expect_features(Case c, const std::vector<At>& places) {
    for (const At& at : places) {
        c.point = at.point;
        for_permutations(static_cast<std::size_t>(vertex_count(c.simplex)), [&](const auto& order, bool odd) {
            const Case p = permuted(c, order);
            const WeightSigns got = signs(p);
            EXPECT_EQ(got.feature(c.simplex), at.feature) << describe(p);
            EXPECT_FALSE(got.degenerate());
            EXPECT_EQ(got.contains(), at.feature != Feature::outside);
            for (std::size_t i = 0; i < order.size(); ++i) {
                const char sign = at.signs[order[i]];
                EXPECT_EQ(got.sign(static_cast<int>(i)), sign == '-'   ? Sign::negative
                                                         : sign == '0' ? Sign::zero
                                                                       : Sign::positive)
                    << describe(p);
            }
            if (solid(c.simplex)) {
                EXPECT_EQ(got.orientation(), odd ? Sign::negative : Sign::positive);
            } else {
                EXPECT_EQ(got.orientation(), Sign::positive);
            }
        });
    }
}

// Both orientations, through the permutations. The numbers are small and even: exact by hand.
TEST(Features, Tetrahedron) {
    const Case c{.simplex = Simplex::tetrahedron, .vertices = {0, 0, 0, 8, 0, 0, 0, 8, 0, 0, 0, 8}};
    expect_features(c, {{{1, 1, 1}, Feature::interior, "++++"},
                        {{0, 2, 2}, Feature::face, "+0++"},
                        {{2, 0, 2}, Feature::face, "++0+"},
                        {{2, 2, 0}, Feature::face, "+++0"},
                        {{2, 2, 4}, Feature::face, "0+++"},
                        {{4, 0, 0}, Feature::edge, "++00"},
                        {{0, 4, 0}, Feature::edge, "+0+0"},
                        {{0, 0, 4}, Feature::edge, "+00+"},
                        {{4, 4, 0}, Feature::edge, "0++0"},
                        {{4, 0, 4}, Feature::edge, "0+0+"},
                        {{0, 4, 4}, Feature::edge, "00++"},
                        {{0, 0, 0}, Feature::vertex, "+000"},
                        {{8, 0, 0}, Feature::vertex, "0+00"},
                        {{0, 8, 0}, Feature::vertex, "00+0"},
                        {{0, 0, 8}, Feature::vertex, "000+"},
                        {{-1, 1, 1}, Feature::outside, "+-++"},
                        {{4, 4, 4}, Feature::outside, "-+++"},
                        {{-4, 12, 0}, Feature::outside, "0-+0"},
                        {{-1, -1, 8}, Feature::outside, "+--+"},
                        {{-1, -1, -1}, Feature::outside, "+---"},
                        {{0, 2, -0x1p-1074}, Feature::outside, "+0+-"},
                        {{0x1p-1074, 2, 2}, Feature::interior, "++++"}});
}

TEST(Features, Triangle) {
    const Case c{.simplex = Simplex::triangle, .vertices = {0, 0, 8, 0, 0, 8}};
    expect_features(c, {{{1, 1}, Feature::interior, "+++"},
                        {{4, 4}, Feature::edge, "0++"},
                        {{0, 4}, Feature::edge, "+0+"},
                        {{4, 0}, Feature::edge, "++0"},
                        {{0, 0}, Feature::vertex, "+00"},
                        {{8, 0}, Feature::vertex, "0+0"},
                        {{0, 8}, Feature::vertex, "00+"},
                        {{5, 5}, Feature::outside, "-++"},
                        {{-1, 1}, Feature::outside, "+-+"},
                        {{1, -1}, Feature::outside, "++-"},
                        {{9, -1}, Feature::outside, "0+-"},
                        {{-1, -1}, Feature::outside, "+--"},
                        {{16, 0}, Feature::outside, "-+0"},
                        {{0x1p-1074, 4}, Feature::interior, "+++"}});
}

// Points off the plane stand for their projection, from either side.
TEST(Features, TriangleInSpace) {
    for (const double height : {0.0, 5.0, -1e6}) {
        const Case c{.simplex = Simplex::triangle3d, .vertices = {0, 0, 0, 8, 0, 0, 0, 8, 0}};
        expect_features(c, {{{1, 1, height}, Feature::interior, "+++"},
                            {{4, 4, height}, Feature::edge, "0++"},
                            {{0, 4, height}, Feature::edge, "+0+"},
                            {{4, 0, height}, Feature::edge, "++0"},
                            {{0, 0, height}, Feature::vertex, "+00"},
                            {{8, 0, height}, Feature::vertex, "0+0"},
                            {{0, 8, height}, Feature::vertex, "00+"},
                            {{5, 5, height}, Feature::outside, "-++"},
                            {{-1, -1, height}, Feature::outside, "+--"},
                            {{-0x1p-1074, 4, height}, Feature::outside, "+-+"}});
    }
}

TEST(Features, Segment) {
    const Case c{.simplex = Simplex::segment, .vertices = {1, 2, 3, 3, 6, 7}};
    expect_features(c, {{{2, 4, 5}, Feature::interior, "++"},
                        {{1, 2, 3}, Feature::vertex, "+0"},
                        {{3, 6, 7}, Feature::vertex, "0+"},
                        {{0, 0, 1}, Feature::outside, "+-"},
                        {{4, 8, 9}, Feature::outside, "-+"},
                        // off the line, along (2, -1, 0) and (0, 1, -1), normal to it
                        {{4, 3, 5}, Feature::interior, "++"},
                        {{1, 5, 0}, Feature::vertex, "+0"},
                        {{5, 5, 7}, Feature::vertex, "0+"},
                        {{0, -9, 10}, Feature::outside, "+-"}});
}

TEST(Features, DegenerateSimplicesOfEachKind) {
    const std::vector<Case> all{
        {.simplex = Simplex::segment, .vertices = {1, 2, 3, 1, 2, 3}},
        {.simplex = Simplex::triangle, .vertices = {1, 2, 1, 2, 1, 2}},              // a point
        {.simplex = Simplex::triangle, .vertices = {0, 0, 1, 1, 3, 3}},              // a line
        {.simplex = Simplex::triangle, .vertices = {0, 0, 0, 0, 3, 3}},              // two vertices in one
        {.simplex = Simplex::triangle, .vertices = {0.1, 0.1, 0.2, 0.2, 0.3, 0.3}},  // a line off the lattice
        {.simplex = Simplex::triangle3d, .vertices = {1, 2, 3, 1, 2, 3, 1, 2, 3}},
        {.simplex = Simplex::triangle3d, .vertices = {0, 0, 0, 1, 2, 3, 2, 4, 6}},
        {.simplex = Simplex::triangle3d, .vertices = {0.1, 0.1, 0.1, 0.7, 0.7, 0.7, 1e300, 1e300, 1e300}},
        {.simplex = Simplex::tetrahedron, .vertices = {1, 2, 3, 1, 2, 3, 1, 2, 3, 1, 2, 3}},  // a point
        {.simplex = Simplex::tetrahedron, .vertices = {0, 0, 0, 1, 1, 1, 2, 2, 2, 5, 5, 5}},  // a line
        {.simplex = Simplex::tetrahedron, .vertices = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0}},  // a plane
        {.simplex = Simplex::tetrahedron, .vertices = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1, 0}},  // two vertices in one
        {.simplex = Simplex::tetrahedron, .vertices = {.1, .2, .1, .7, .3, .7, 1e-320, 5, 1e-320, 1e300, 1, 1e300}},
    };
    TierCounts tiers;
    std::uint64_t asked = 0;
    for (Case c : all) {
        for (const double x : {0.0, 0.5, 1.0, -3.0}) {
            c.point = {x, x, x};
            const WeightSigns got = weight_signs(c.simplex, c.vertices.data(), c.point.data(), &tiers);
            ++asked;
            EXPECT_EQ(got, WeightSigns::degenerate_simplex()) << describe(c);
            EXPECT_EQ(got.feature(c.simplex), Feature::degenerate);
            EXPECT_FALSE(got.contains());
            EXPECT_EQ(got.sign(0), Sign::zero);
            if (solid(c.simplex)) {
                EXPECT_EQ(orient(c), Sign::zero);
            }
        }
    }
    EXPECT_EQ(tiers, (TierCounts{.exact = asked, .degenerate = asked}));
}

TEST(Orientation, ByHand) {
    const double o[3] = {0, 0, 0}, x[3] = {1, 0, 0}, y[3] = {0, 1, 0}, z[3] = {0, 0, 1};
    EXPECT_EQ(orient2d(o, x, y), Sign::positive);
    EXPECT_EQ(orient2d(x, o, y), Sign::negative);
    EXPECT_EQ(orient2d(o, x, x), Sign::zero);
    EXPECT_EQ(orient3d(o, x, y, z), Sign::positive);
    EXPECT_EQ(orient3d(x, o, y, z), Sign::negative);
    EXPECT_EQ(orient3d(o, x, y, x), Sign::zero);
}

// det3d: three differences between six points.

using SixPoints = std::array<std::array<double, 3>, 6>;

Result<Sign> checked_det3d(const SixPoints& p) {
    return barycert::checked_det3d(p[0].data(), p[1].data(), p[2].data(), p[3].data(), p[4].data(), p[5].data());
}

Sign det3d(const SixPoints& p) {
    return barycert::det3d(p[0].data(), p[1].data(), p[2].data(), p[3].data(), p[4].data(), p[5].data());
}

Sign det3d_by_rationals(const SixPoints& p) {
    using testing_rational::Q;
    Q d[3][3];
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t k = 0; k < 3; ++k) d[i][k] = Q(p[2 * i + 1][k]) - Q(p[2 * i][k]);
    }
    Q det = 0;
    for (int k = 0; k < 3; ++k) det += d[0][k] * d[1][(k + 1) % 3] * d[2][(k + 2) % 3];
    for (int k = 0; k < 3; ++k) det -= d[0][k] * d[1][(k + 2) % 3] * d[2][(k + 1) % 3];
    return static_cast<Sign>(sgn(det));
}

std::string describe(const SixPoints& p) {
    std::string text;
    for (const auto& x : p) {
        for (const double c : x) text += ' ' + base::hexadecimal(c);
        text += '\n';
    }
    return text;
}

/// Makes points of one kind; for most, the last difference is a combination of the other two but for rounding, or a
/// difference has one end in common with another.
SixPoints hard_six(base::Random& r, Kind kind) {
    SixPoints p;
    for (auto& x : p) {
        for (int k = 0; k < 3; ++k) x[static_cast<std::size_t>(k)] = testing_cases::number(r, kind, k);
    }
    const int how = r.integer(0, 4);
    const double f = r.integer(-4, 4) * 0.25, g = r.integer(-4, 4) * 0.25;
    for (std::size_t k = 0; k < 3; ++k) {
        const double near = p[4][k] + (f * (p[1][k] - p[0][k]) + g * (p[3][k] - p[2][k]));
        if (how >= 2 && std::isfinite(near)) p[5][k] = near;
        if (how == 1) p[2][k] = p[0][k];
    }
    if (how == 4) p[5][0] = std::nextafter(p[5][0], 0);
    return p;
}

TEST(LawS1, DeterminantsOfDifferencesAreThoseOfRationals) {
    int zeros = 0;
    for (const Kind kind : all_kinds) {
        for (std::uint64_t k = 0; k < 1500 && !HasFailure(); ++k) {
            base::Random r = base::Random::stream(1, base::hash64("det3d"), k);
            const SixPoints p = hard_six(r, kind);
            const Sign right = det3d_by_rationals(p);
            EXPECT_EQ(det3d(p), right) << describe(p);
            zeros += right == Sign::zero ? 1 : 0;
        }
    }
    EXPECT_GT(zeros, 500);
}

// Axes beyond the filter's limits at 2^+-300 and within.
TEST(LawS1, DeterminantsOfDifferencesAboutTheLimitsOfTheFilter) {
    for (std::uint64_t k = 0; k < 3000 && !HasFailure(); ++k) {
        base::Random r = base::Random::stream(1, base::hash64("det3d limits"), k);
        SixPoints p = hard_six(r, r.coin() ? Kind::ordinary : Kind::thin);
        const int limits[] = {-540, -301, -300, 0, 299, 300, 340};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const int shift = limits[r.below(7)];
            for (auto& x : p) x[axis] = std::ldexp(x[axis], shift);
        }
        EXPECT_EQ(det3d(p), det3d_by_rationals(p)) << describe(p);
    }
}

TEST(LawS1, DeterminantsOfDifferencesAreTheSameInEveryEnvironment) {
    for (const Kind kind : all_kinds) {
        for (std::uint64_t k = 0; k < 300; ++k) {
            base::Random r = base::Random::stream(1, base::hash64("det3d environments"), k);
            const SixPoints p = hard_six(r, kind);
            const Sign right = det3d_by_rationals(p);
            for (const auto& environment : testing_environments::all_environments()) {
                Sign got = Sign::zero;
                {
                    const testing_environments::Changed changed(environment);
                    got = det3d(p);
                }
                ASSERT_EQ(got, right) << environment.name << '\n' << describe(p);
            }
        }
    }
}

TEST(LawS2, OrderOfDifferencesAndOfTheirEnds) {
    for (const Kind kind : all_kinds) {
        for (std::uint64_t k = 0; k < 200 && !HasFailure(); ++k) {
            base::Random r = base::Random::stream(1, base::hash64("det3d order"), k);
            const SixPoints p = hard_six(r, kind);
            const Sign original = det3d(p);
            for_permutations(3, [&](const auto& order, bool odd) {
                for (unsigned swaps = 0; swaps < 8; ++swaps) {
                    SixPoints image;
                    bool flips = odd;
                    for (std::size_t i = 0; i < 3; ++i) {
                        const std::size_t swapped = swaps >> i & 1;
                        image[2 * i] = p[2 * order[i] + swapped];
                        image[2 * i + 1] = p[2 * order[i] + 1 - swapped];
                        flips ^= swapped == 1;
                    }
                    EXPECT_EQ(det3d(image), flips ? negated(original) : original) << describe(image);
                }
            });
            const auto at = [&](std::size_t i) { return p[i].data(); };
            EXPECT_EQ(barycert::det3d(at(0), at(1), at(0), at(2), at(0), at(3)), orient3d(at(0), at(1), at(2), at(3)))
                << describe(p);
        }
    }
}

TEST(LawE, DeterminantsOfDifferences) {
    const SixPoints good{{{0, 0, 0}, {1, 2, 3}, {5, 5, 5}, {3, 2, 1}, {0, 1, 0}, {7, 7, 0}}};
    ASSERT_EQ(det3d(good), det3d_by_rationals(good));
    for (const double bad : {testing_rational::infinity, -testing_rational::infinity, std::nan("")}) {
        for (std::size_t i = 0; i < 6; ++i) {
            for (std::size_t k = 0; k < 3; ++k) {
                SixPoints p = good;
                p[i][k] = bad;
                const auto got = checked_det3d(p);
                ASSERT_FALSE(got);
                EXPECT_EQ(got.error().what, "coordinate " + std::to_string(k) + " of point " + std::to_string(i));
                p[i ^ 1U][k] = bad;  // their difference is NaN
                EXPECT_FALSE(checked_det3d(p));
            }
        }
    }
}

}  // namespace
}  // namespace barycert
