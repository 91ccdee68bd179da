// Laws W1, W2, V1, V2: weights and values against exact rationals, rounded by the definition.
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
using testing_rational::bits;
using testing_rational::infinity;
using testing_rational::max;
using testing_rational::nearest;
using testing_rational::Q;

Value value_of(const Case& c) {
    return interpolate(c.simplex, c.vertices.data(), c.point.data(), c.values.data()).value();
}

Weights weights_of(const Case& c) {
    return barycentric_weights(c.simplex, c.vertices.data(), c.point.data()).value();
}

void expect_laws(const Case& c) {
    const auto exact = second_path::weights(c);
    const Weights w = weights_of(c);
    const Value v = value_of(c);
    EXPECT_EQ(w.degenerate, !exact) << describe(c);
    EXPECT_EQ(v.degenerate, !exact) << describe(c);
    if (!exact) {
        EXPECT_TRUE(std::isnan(v.value));
        for (int i = 0; i < vertex_count(c.simplex); ++i)
            EXPECT_TRUE(std::isnan(w.weights[static_cast<std::size_t>(i)]));
        return;
    }
    Q sum(0);
    for (std::size_t i = 0; i < exact->size(); ++i) {
        EXPECT_TRUE(nearest(w.weights[i], (*exact)[i])) << i << ' ' << describe(c);  // W1 and W2
        sum += (*exact)[i] * Q(c.values[i]);
    }
    EXPECT_TRUE(nearest(v.value, sum)) << describe(c);  // V1
    // Which side of a number the exact value is on: of its own rounding, of numbers around it, and of any other.
    for (const double t : {v.value, std::nextafter(v.value, infinity), std::nextafter(v.value, -infinity), 0.0,
                           c.values[0], c.vertices[0], -max}) {
        if (!std::isfinite(t)) continue;
        const Result<Sign> side = compare_value(c.simplex, c.vertices.data(), c.point.data(), c.values.data(), t);
        ASSERT_TRUE(side) << side.error().message();
        EXPECT_EQ(*side, static_cast<Sign>(sgn(Q(sum - Q(t))))) << t << ' ' << describe(c);
    }
}

TEST(CompareValue, RefusesWhatHasNoValue) {
    const double flat[] = {0, 0, 1, 1, 2, 2}, cell[] = {0, 0, 1, 0, 0, 1}, p[] = {0.25, 0.25}, f[] = {1, 2, 3};
    const double bad[] = {0.25, std::nan("")}, bad_values[] = {1, infinity, 3};
    EXPECT_EQ(*compare_value(Simplex::triangle, cell, p, f, 1.75), Sign::zero);
    EXPECT_FALSE(compare_value(Simplex::triangle, flat, p, f, 1));
    EXPECT_FALSE(compare_value(Simplex::triangle, cell, bad, f, 1));
    EXPECT_FALSE(compare_value(Simplex::triangle, cell, p, bad_values, 1));
    EXPECT_FALSE(compare_value(Simplex::triangle, cell, p, f, infinity));
}

TEST(LawW2V1, RoundedFromRationals) {
    for (const Simplex s : all_simplices) {
        for (const Kind kind : all_kinds) {
            for (std::uint64_t k = 0; k < 250 && !HasFailure(); ++k) {
                base::Random r = base::Random::stream(4, base::hash64("weights"), k);
                expect_laws(random_case(r, s, kind));
            }
        }
    }
}

/// A cell about `size` at a distance, flattened by 2^-flat, the point within or near it.
Case flat_case(base::Random& r, Simplex s, double distance, int flat) {
    Case c{.simplex = s};
    const int n = vertex_count(s), d = space_dimension(s);
    double w[4], sum = 0;
    for (double& x : w) x = r.uniform(-0.2, 1);
    for (int i = 0; i < n; ++i) sum += w[i];
    for (int i = 0; i < n; ++i) {
        double v[3];
        for (double& x : v) x = r.uniform(-1, 1);
        // Flat along (1, 1, 1): no axis shows it.
        const double along = (v[0] + v[1] + (d == 3 ? v[2] : 0)) / d * (1 - std::ldexp(1, -flat));
        for (int k = 0; k < d; ++k) c.vertex(i, k) = v[k] - along + distance;
        c.values[static_cast<std::size_t>(i)] = r.scaled(-1, 1, -3, 3);
    }
    for (int k = 0; k < d; ++k) {
        double p = 0;
        for (int i = 0; i < n; ++i) p += w[i] / sum * (c.vertex(i, k) - distance);
        c.point[static_cast<std::size_t>(k)] = p + distance + (s == Simplex::segment ? r.uniform(-1, 1) : 0);
    }
    return c;
}

// Where double-double works hardest: flat cells, far from the origin. Catches a bound that is too small by the time
// the condition of the cell multiplies it.
TEST(LawW2V1, FlatCellsFarFromTheOrigin) {
    for (const Simplex s : all_simplices) {
        for (int flat = 0; flat <= 44; flat += 2) {
            for (const double distance : {0.0, 3.0, 1e3, 1e6, 1e9}) {
                for (std::uint64_t k = 0; k < 12 && !HasFailure(); ++k) {
                    base::Random r =
                        base::Random::stream(4, base::hash64("flat"), 1000 * k + static_cast<std::uint64_t>(flat));
                    expect_laws(flat_case(r, s, distance, flat));
                }
            }
        }
    }
}

/// Half way between two vertices that are exact, so that weights are 1/2 and the value is half of a sum.
Case half_way(Simplex s, double f0, double f1) {
    Case c{.simplex = s, .values = {f0, f1, 7, -3}};
    const bool plane = s == Simplex::triangle;
    c.vertices =
        plane ? std::array<double, 12>{0, 0, 2, 4, 5, 1} : std::array<double, 12>{0, 0, 0, 2, 4, 6, 5, 1, 0, 1, 0, 7};
    c.point = {1, 2, plane ? 0.0 : 3.0};
    return c;
}

TEST(LawV1, TiesGoToEven) {
    const double odd = 0x1p-52;  // the last bit of numbers in [1, 2)
    for (const Simplex s : all_simplices) {
        // (1 + 1 odd)/2 is a tie of 1 and 1 + odd: down to 1. (1 + odd + 1 + 2 odd)/2 is one of 1 + odd and 1 + 2 odd:
        // up.
        const Value down = value_of(half_way(s, 1, 1 + odd)), up = value_of(half_way(s, 1 + odd, 1 + 2 * odd));
        EXPECT_EQ(down.value, 1);
        EXPECT_EQ(up.value, 1 + 2 * odd);
        EXPECT_EQ(value_of(half_way(s, -1, -1 - odd)).value, -1);
        EXPECT_EQ(value_of(half_way(s, -1 - odd, -1 - 2 * odd)).value, -1 - 2 * odd);
        EXPECT_EQ(down.tier, Tier::exact);
        EXPECT_EQ(up.tier, Tier::exact);
        // Among subnormals, and at the ends of the range.
        const double tiny = 0x1p-1074;
        EXPECT_TRUE(nearest(value_of(half_way(s, 0, tiny)).value, Q(tiny) / 2));  // to +0
        EXPECT_EQ(bits(value_of(half_way(s, 0, -tiny)).value), bits(-0.0));
        EXPECT_EQ(value_of(half_way(s, tiny, 2 * tiny)).value, 2 * tiny);
        EXPECT_EQ(value_of(half_way(s, 2 * tiny, 3 * tiny)).value, 2 * tiny);
        EXPECT_EQ(value_of(half_way(s, max, max)).value, max);
        EXPECT_EQ(value_of(half_way(s, max, std::nextafter(max, 0))).value, std::nextafter(max, 0));
        EXPECT_EQ(bits(value_of(half_way(s, max, -max)).value), 0U);
        EXPECT_EQ(bits(value_of(half_way(s, -0.0, -0.0)).value), 0U);  // an exact zero is +0
        EXPECT_EQ(weights_of(half_way(s, 0, 0)).weights[0], 0.5);
        EXPECT_EQ(bits(weights_of(half_way(s, 0, 0)).weights[2]), 0U);
        if (HasFailure()) FAIL() << name(s);
    }
}

// Every simplex with all nodal values -0, at a point where nothing is special: the exact zero is +0 from lanes too.
TEST(LawV1, ZerosArePositive) {
    for (const Simplex s : all_simplices) {
        base::Random r(1);
        Case c = flat_case(r, s, 0, 0);
        for (const double first : {-0.0, 0.0}) {
            c.values = {first, -0.0, -0.0, -0.0};
            EXPECT_EQ(bits(value_of(c).value), 0U) << name(s);
        }
    }
}

// Weights that are subnormal, underflow with either sign, or overflow: only cells of extreme shape have them.
TEST(LawW1, UnderflowAndOverflow) {
    const auto segment = [](double x0, double x1, double p) {
        return weights_of({.simplex = Simplex::segment, .vertices = {x0, 0, 0, x1, 0, 0}, .point = {p, 0, 0}}).weights;
    };
    const double tiny = 0x1p-1074;
    EXPECT_EQ(segment(0, 1, 3 * tiny)[1], 3 * tiny);
    EXPECT_EQ(segment(0, 2, tiny)[1], 0);  // half of the smallest subnormal: a tie, to zero
    EXPECT_EQ(segment(0, 2, 3 * tiny)[1], 2 * tiny);
    EXPECT_EQ(segment(0, 1.5, tiny)[1], tiny);  // 2/3 of it
    EXPECT_EQ(bits(segment(0, 4, tiny)[1]), 0U);
    EXPECT_EQ(bits(segment(0, -4, tiny)[1]), bits(-0.0));
    EXPECT_EQ(segment(0, 4, tiny)[0], 1);
    EXPECT_EQ(segment(0, tiny, 1)[1], infinity);
    EXPECT_EQ(segment(0, tiny, 1)[0], -infinity);
    EXPECT_EQ(segment(0, tiny, 0x1p-52)[1], 0x1p1022);
    EXPECT_EQ(segment(-max, max, 0)[0], 0.5);  // the difference overflows, not the weight
    EXPECT_EQ(bits(segment(1, 2, 1)[1]), 0U);
    const Case t{.simplex = Simplex::triangle,
                 .vertices = {0, 0, 0x1p1000, 0, 0, 0x1p1000},
                 .point = {0x1p-70, -0x1p-76},
                 .values = {0, 1, 1}};
    EXPECT_EQ(weights_of(t).weights[1], 0x1p-1070);
    EXPECT_EQ(bits(weights_of(t).weights[2]), bits(-0.0));  // 2^-1076
    EXPECT_EQ(value_of(t).value, 0x1p-1070);                // 1/64 of a subnormal's last bit away
}

/// An n-gon of cells about what they share; each cell holds `shared` vertices 0 ... and its own others.
struct Pair {
    Case first, second;
};

/// Two cells that share vertices 0 ... count-1 (in another order), on dyadic coordinates.
Pair sharing(base::Random& r, Simplex s, int count) {
    Pair pair{{.simplex = s}, {.simplex = s}};
    const int n = vertex_count(s), d = space_dimension(s);
    const auto number = [&] { return r.integer(-4096, 4096) * 0x1p-4; };
    for (int i = 0; i < n; ++i) {
        const int to = n - 1 - i;
        const auto at = static_cast<std::size_t>(i), other = static_cast<std::size_t>(to);
        for (int k = 0; k < d; ++k) {
            pair.first.vertex(i, k) = number();
            pair.second.vertex(to, k) = i < count ? pair.first.vertex(i, k) : number();
        }
        pair.first.values[at] = r.scaled(-1, 1, -4, 4);
        pair.second.values[other] = i < count ? pair.first.values[at] : r.scaled(-1, 1, -4, 4);
    }
    // Weights in eighths that sum to 1 over what is shared: the point is exact.
    int rest = 8;
    std::array<int, 4> eighths{};
    for (int i = 0; i < count; ++i) {
        const int take = i == count - 1 ? rest : r.integer(0, rest);
        eighths[static_cast<std::size_t>(i)] = take;
        rest -= take;
    }
    for (int k = 0; k < d; ++k) {
        double p = 0;
        for (int i = 0; i < count; ++i) p += eighths[static_cast<std::size_t>(i)] * 0.125 * pair.first.vertex(i, k);
        pair.first.point[static_cast<std::size_t>(k)] = pair.second.point[static_cast<std::size_t>(k)] = p;
    }
    return pair;
}

// Each component has values of its own at the shared vertices. Catches a value that depends on the cell's other
// vertices, such as by a weight that is zero exactly but not as computed.
TEST(LawV2, SharedFacesEdgesAndVertices) {
    int compared = 0;
    for (const Simplex s : all_simplices) {
        for (int count = 1; count < vertex_count(s); ++count) {
            for (std::uint64_t k = 0; k < 400 && !HasFailure(); ++k) {
                base::Random r =
                    base::Random::stream(5, base::hash64("shared"), 8 * k + static_cast<std::uint64_t>(count));
                Pair pair = sharing(r, s, count);
                for (int component = 0; component < 3; ++component) {
                    const Value a = value_of(pair.first), b = value_of(pair.second);
                    if (a.degenerate || b.degenerate) continue;
                    ++compared;
                    EXPECT_EQ(bits(a.value), bits(b.value)) << describe(pair.first) << describe(pair.second);
                    const auto last = static_cast<std::size_t>(vertex_count(s) - 1);
                    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i)
                        pair.first.values[i] = pair.second.values[last - i] = r.scaled(-1, 1, -1070, 1000);
                }
            }
        }
    }
    EXPECT_GT(compared, 9000);
}

TEST(Weights, DegenerateOfEachKindIsToldNotWeighed) {
    for (const Simplex s : all_simplices) {
        for (const double x : {0.0, 0.1, 1e300, 0x1p-1074}) {
            Case c{.simplex = s, .values = {1, 2, 3, 4}};
            c.vertices.fill(x);
            expect_laws(c);  // a point
            for (int i = 0; i < vertex_count(s) - 1; ++i) {
                for (int k = 0; k < space_dimension(s); ++k) c.vertex(i, k) = s == Simplex::segment ? x : x * (i + 1);
            }
            c.point = {x, x, x};
            if (s != Simplex::segment) {
                expect_laws(c);  // a line
                EXPECT_TRUE(weights_of(c).degenerate || x == 0x1p-1074) << name(s);
            }
        }
    }
}

}  // namespace
}  // namespace barycert
