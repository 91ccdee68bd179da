// Nodal values that are NaN or infinite: one whose exact weight is zero takes no part, any other makes its component
// NaN.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "barycert/environment.hpp"
#include "barycert/perspective.hpp"
#include "barycert/weights.hpp"

namespace barycert {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
constexpr std::array<double, 3> holes{nan, inf, -inf};
constexpr std::array<Rounding, 2> roundings{Rounding::correct, Rounding::plain};

/// In each simplex: the corners 0, e_1, e_2, ... times 8, but for a segment and a triangle in space, that are askew.
std::vector<double> corners_of(Simplex s) {
    switch (s) {
        case Simplex::segment:
            return {0, 0, 0, 8, 8, 0};
        case Simplex::triangle:
            return {0, 0, 8, 0, 0, 8};
        case Simplex::triangle3d:
            return {0, 0, 0, 8, 0, 8, 0, 8, 0};
        default:
            return {0, 0, 0, 8, 0, 0, 0, 8, 0, 0, 0, 8};
    }
}

/// Weights in eighths, each number of them: points of the simplex of which every one is exact.
std::vector<std::vector<int>> all_eighths(int n) {
    std::vector<std::vector<int>> all;
    for (int code = 0; code < (n == 2 ? 9 : n == 3 ? 81 : 729); ++code) {
        std::vector<int> w{code % 9, code / 9 % 9, code / 81};
        w.resize(static_cast<std::size_t>(n - 1));
        int rest = 8;
        for (const int x : w) rest -= x;
        w.insert(w.begin(), rest);
        if (rest >= 0) all.push_back(w);
    }
    return all;
}

std::vector<double> point_at(Simplex s, const std::vector<int>& weights) {
    const std::vector<double> corners = corners_of(s);
    const auto d = static_cast<std::size_t>(space_dimension(s));
    std::vector<double> p(d, 0.0);
    for (std::size_t i = 0; i < weights.size(); ++i) {
        for (std::size_t k = 0; k < d; ++k) p[k] += weights[i] * corners[d * i + k] / 8;
    }
    return p;
}

// A batch of all points with values of three components of which the second one has a hole at one corner.
TEST(LawV1, ANodeOfWeightZeroTakesNoPart) {
    for (const std::string& target : simd_targets()) {
        ASSERT_TRUE(use_simd_target(target));
        for (const Simplex s : all_simplices) {
            const int n = vertex_count(s);
            const std::vector<double> corners = corners_of(s);
            std::vector<double> points;
            std::vector<std::int32_t> order, cells;
            const auto weights = all_eighths(n);
            for (const auto& w : weights) {
                const std::vector<double> p = point_at(s, w);
                points.insert(points.end(), p.begin(), p.end());
            }
            for (int i = 0; i < n; ++i) order.push_back(i);
            cells.assign(weights.size(), 0);
            const MeshQueries queries{s, corners, order, cells, points};
            for (int hole = 0; hole < n; ++hole) {
                for (const double bad : holes) {
                    std::vector<double> values;
                    for (int i = 0; i < 3 * n; ++i) values.push_back(i == 3 * hole + 1 ? bad : i - 4);
                    const std::vector<float> floats(values.begin(), values.end());
                    std::vector<double> exact(3 * weights.size()), plain(exact), of_floats(exact);
                    TierCounts tiers;
                    ASSERT_TRUE(interpolate(queries, NodalValues<double>{values, 3}, exact, &tiers));
                    ASSERT_TRUE(interpolate(queries, NodalValues<float>{floats, 3}, of_floats));
                    ASSERT_TRUE(interpolate(queries, NodalValues<double>{values, 3}, plain, nullptr, Rounding::plain));
                    std::uint64_t with = 0;
                    for (std::size_t j = 0; j < weights.size(); ++j) {
                        const bool has_part = weights[j][static_cast<std::size_t>(hole)] != 0;
                        with += has_part ? 1 : 0;
                        for (std::size_t c = 0; c < 3; ++c) {
                            double expected = 0;
                            for (std::size_t i = 0; i < static_cast<std::size_t>(n); ++i)
                                expected += weights[j][i] == 0 ? 0 : weights[j][i] * values[3 * i + c] / 8;
                            if (c == 1 && has_part) expected = nan;
                            for (const std::vector<double>* found : {&exact, &of_floats, &plain}) {
                                const double x = (*found)[3 * j + c];
                                EXPECT_TRUE(x == expected || (std::isnan(x) && std::isnan(expected)))
                                    << target << ": " << x << " for " << expected;
                            }
                        }
                        std::vector<double> of_second;
                        for (std::size_t i = 0; i < static_cast<std::size_t>(n); ++i)
                            of_second.push_back(values[3 * i + 1]);
                        const double* const p = &points[static_cast<std::size_t>(space_dimension(s)) * j];
                        EXPECT_EQ(std::isnan(interpolate(s, corners.data(), p, of_second.data())->value), has_part);
                        EXPECT_EQ(!compare_value(s, corners.data(), p, of_second.data(), 0), has_part);
                    }
                    EXPECT_EQ(tiers.not_finite, with);
                }
            }
        }
    }
    use_simd_target("");
}

// The weight x / 2^1000 is not zero, though it rounds to zero.
TEST(LawV1, AWeightThatOnlyRoundsToZeroTakesPart) {
    const double corners[] = {0, 0, 0x1p1000, 0, 0, 1};
    for (const double bad : holes) {
        const double values[] = {1, bad, 3};
        for (const double x : {0.0, 5e-324, 1e-300, -5e-324}) {
            const double point[] = {x, 0.5};
            EXPECT_EQ(barycentric_weights(Simplex::triangle, corners, point)->weights[1], 0);
            const double value = interpolate(Simplex::triangle, corners, point, values)->value;
            CaseArrays one{.simplex = Simplex::triangle, .count = 1};
            ValueArrays<double> nodal;
            for (std::size_t i = 0; i < 6; ++i) one.vertices[i] = &corners[i];
            for (std::size_t i = 0; i < 3; ++i) nodal.at[i] = &values[i];
            for (std::size_t k = 0; k < 2; ++k) one.point[k] = &point[k];
            double plain = 0;
            ASSERT_TRUE(interpolate(one, nodal, std::span(&plain, 1), nullptr, Rounding::plain));
            if (x == 0) {
                EXPECT_EQ(value, 2);
                EXPECT_EQ(plain, 2);
            } else {
                EXPECT_TRUE(std::isnan(value) && std::isnan(plain)) << x << ": " << value << ' ' << plain;
            }
        }
    }
}

/// Eighths of the shape function of a node, times 8: l (2 l - 1) at corners, 4 l l' amid edges.
int shape(const std::vector<int>& w, std::size_t node) {
    static constexpr std::size_t edges[6][2]{{0, 1}, {1, 2}, {0, 2}, {0, 3}, {1, 3}, {2, 3}};
    if (node < w.size()) return w[node] * (2 * w[node] - 8);
    const auto& ends = edges[node - w.size()];
    return 4 * w[ends[0]] * w[ends[1]];
}

TEST(LawV1, AShapeFunctionOfZeroTakesNoPart) {
    for (const std::string& target : simd_targets()) {
        ASSERT_TRUE(use_simd_target(target));
        for (const Simplex s : {Simplex::triangle, Simplex::tetrahedron}) {
            const auto n = static_cast<std::size_t>(vertex_count(s));
            const std::size_t nodes = n + static_cast<std::size_t>(mid_node_count(s));
            const std::vector<double> corners = corners_of(s);
            const auto weights = all_eighths(static_cast<int>(n));
            std::vector<double> points;
            for (const auto& w : weights) {
                const std::vector<double> p = point_at(s, w);
                points.insert(points.end(), p.begin(), p.end());
            }
            std::vector<std::int32_t> order, mids;
            for (std::size_t i = 0; i < nodes; ++i) (i < n ? order : mids).push_back(static_cast<std::int32_t>(i));
            const std::vector<std::int32_t> cells(weights.size(), 0);
            std::size_t at_half = 0;
            for (std::size_t hole = 0; hole < nodes; ++hole) {
                for (const double bad : holes) {
                    std::vector<double> values;
                    for (std::size_t i = 0; i < 2 * nodes; ++i)
                        values.push_back(i == 2 * hole ? bad : static_cast<double>(i));
                    for (const Rounding rounding : roundings) {
                        std::vector<double> found(2 * weights.size());
                        TierCounts tiers;
                        ASSERT_TRUE(interpolate_quadratic(MeshQueries{s, corners, order, cells, points}, mids,
                                                          NodalValues<double>{values, 2}, found, &tiers, rounding));
                        std::uint64_t with = 0;
                        for (std::size_t j = 0; j < weights.size(); ++j) {
                            double expected[2] = {};
                            for (std::size_t i = 0; i < nodes; ++i) {
                                for (std::size_t c = 0; c < 2; ++c) {
                                    const int part = shape(weights[j], i);
                                    if (part != 0) expected[c] += part * values[2 * i + c] / 64;
                                }
                            }
                            const bool has_part = shape(weights[j], hole) != 0;
                            at_half += !has_part && hole < n && weights[j][hole] == 4 ? 1 : 0;
                            with += has_part ? 1 : 0;
                            if (has_part) {
                                EXPECT_TRUE(std::isnan(found[2 * j])) << found[2 * j];
                            } else {
                                EXPECT_EQ(found[2 * j], expected[0]) << target;
                            }
                            EXPECT_EQ(found[2 * j + 1], expected[1]);
                        }
                        EXPECT_EQ(tiers.not_finite, rounding == Rounding::correct ? with : 0);
                    }
                }
            }
            EXPECT_GT(at_half, 0U);
        }
    }
    use_simd_target("");
}

// Each component of a gradient counts for itself.
TEST(LawG1Quadratic, ADerivativeOfZeroTakesNoPart) {
    for (const Simplex s : {Simplex::triangle, Simplex::tetrahedron}) {
        const auto n = static_cast<std::size_t>(vertex_count(s)), d = n - 1;
        const std::size_t nodes = n + static_cast<std::size_t>(mid_node_count(s));
        const std::vector<double> corners = corners_of(s);
        std::size_t without = 0;
        for (const auto& w : all_eighths(static_cast<int>(n))) {
            const std::vector<double> p = point_at(s, w);
            for (std::size_t hole = 0; hole < nodes; ++hole) {
                std::vector<double> unit(nodes, 0.0), values(nodes);
                unit[hole] = 1;
                for (std::size_t i = 0; i < nodes; ++i) values[i] = static_cast<double>(i * i) - 7;
                std::vector<double> zero = values;
                values[hole] = nan;
                zero[hole] = 0;
                const Gradient part = *quadratic_gradient(s, corners.data(), p.data(), unit.data());
                for (std::size_t k = 0; k < d; ++k) without += part.gradient[k] != 0 ? 0 : 1;
                for (const Rounding rounding : roundings) {
                    const Gradient g = *quadratic_gradient(s, corners.data(), p.data(), values.data(), rounding);
                    const Gradient right = *quadratic_gradient(s, corners.data(), p.data(), zero.data(), rounding);
                    for (std::size_t k = 0; k < d; ++k) {
                        if (part.gradient[k] != 0) {
                            EXPECT_TRUE(std::isnan(g.gradient[k]));
                        } else {
                            EXPECT_EQ(g.gradient[k], right.gradient[k]);
                        }
                    }
                }
            }
        }
        EXPECT_GT(without, 100U);
    }
}

// Cells of small integers, whose gradients of weights are far from underflow: all with corners in {0, 1, 2}^d of the
// plane, and some in space.
TEST(LawG1, ADerivativeOfZeroTakesNoPart) {
    std::size_t with = 0, without = 0;
    for (const Simplex s : {Simplex::triangle, Simplex::tetrahedron}) {
        const auto n = static_cast<std::size_t>(vertex_count(s)), d = n - 1;
        for (std::uint64_t code = 0; code < 729; ++code) {
            std::vector<double> corners;
            std::uint64_t rest = s == Simplex::triangle ? code : code * 727 + 11;  // 3^12 codes
            for (std::size_t i = 0; i < n * d; ++i, rest /= 3) corners.push_back(static_cast<double>(rest % 3));
            for (std::size_t hole = 0; hole < n; ++hole) {
                std::vector<double> values, unit(n, 0.0);
                for (std::size_t i = 0; i < n; ++i) values.push_back(static_cast<double>(i * i) - 2);
                unit[hole] = 1;
                std::vector<double> zero = values;
                zero[hole] = 0;
                values[hole] = holes[hole % 3];
                const Gradient part = *gradient(s, corners.data(), unit.data());
                const Gradient right = *gradient(s, corners.data(), zero.data());
                const Gradient g = *gradient(s, corners.data(), values.data());
                EXPECT_EQ(g.degenerate, right.degenerate);
                for (std::size_t k = 0; k < d; ++k) {
                    const bool has_part = part.gradient[k] != 0;  // NaN in a degenerate cell
                    (has_part ? with : without) += 1;
                    if (has_part) {
                        EXPECT_TRUE(std::isnan(g.gradient[k]));
                    } else {
                        EXPECT_EQ(g.gradient[k], right.gradient[k]);
                    }
                }
            }
        }
    }
    EXPECT_GT(with, 2000U);
    EXPECT_GT(without, 1000U);
}

// A derivative of 2^-3000 is not zero, though it rounds to zero.
TEST(LawG1, ADerivativeThatOnlyRoundsToZeroTakesPart) {
    const double corners[] = {0, 0, 0x1p1000, 0, 0x1p-1000, 0x1p1000}, values[] = {1, 1, nan}, unit[] = {0, 0, 1};
    EXPECT_EQ(gradient(Simplex::triangle, corners, unit)->gradient[0], 0);
    const double tilted[] = {0, 0, 0x1p1000, 0x1p-1000, 0, 0x1p1000};
    EXPECT_EQ(gradient(Simplex::triangle, tilted, unit)->gradient[0], 0);
    EXPECT_EQ(gradient(Simplex::triangle, corners, values)->gradient[0], 0);
    EXPECT_TRUE(std::isnan(gradient(Simplex::triangle, tilted, values)->gradient[0]));
}

TEST(LawV1, WithoutPartInADegenerateSimplexIsNothing) {
    const double flat[] = {0, 0, 1, 1, 2, 2}, point[] = {0, 0}, values[] = {1, nan, 2, 1, 1, 1};
    const Value v = *interpolate(Simplex::triangle, flat, point, values);
    EXPECT_TRUE(std::isnan(v.value) && v.degenerate);
    const Value q = *interpolate_quadratic(Simplex::triangle, flat, point, values);
    EXPECT_TRUE(std::isnan(q.value) && q.degenerate);
    for (const Rounding rounding : roundings)
        EXPECT_TRUE(std::isnan(quadratic_gradient(Simplex::triangle, flat, point, values, rounding)->gradient[0]));
    const std::int32_t order[] = {0, 1, 2}, mids[] = {3, 4, 5}, cell[] = {0};
    const MeshQueries queries{Simplex::triangle, flat, order, cell, point};
    double out = 0;
    ASSERT_TRUE(interpolate(queries, NodalValues<double>{values, 1}, std::span(&out, 1), nullptr, Rounding::plain));
    EXPECT_TRUE(std::isnan(out));
    out = 0;
    ASSERT_TRUE(interpolate_quadratic(queries, mids, NodalValues<double>{values, 1}, std::span(&out, 1), nullptr,
                                      Rounding::plain));
    EXPECT_TRUE(std::isnan(out));
}

// Plain rounding checks no coordinates.
TEST(LawV1, PlainValuesAtPointsThatAreNone) {
    const double corners[] = {0, 0, 1, 0, 0, 1}, values[] = {1, nan, 2}, points[] = {nan, 0, 0, inf, 0, 0.5};
    const std::int32_t order[] = {0, 1, 2}, cells[] = {0, 0, 0};
    double out[3] = {};
    ASSERT_TRUE(interpolate(MeshQueries{Simplex::triangle, corners, order, cells, points},
                            NodalValues<double>{values, 1}, out, nullptr, Rounding::plain));
    EXPECT_TRUE(std::isnan(out[0]) && std::isnan(out[1]));
    EXPECT_EQ(out[2], 1.5);
}

TEST(Perspective, AVertexOfWeightZeroTakesNoPart) {
    const double vertices[] = {0, 0, 1, 8, 0, 2, 0, 8, 4};
    for (const double bad : holes) {
        for (std::size_t hole = 0; hole < 3; ++hole) {
            double values[] = {1, 10, 2, 20, 3, 30}, zeros[] = {1, 10, 2, 20, 3, 30};
            values[2 * hole] = bad;
            zeros[2 * hole] = 0;
            std::vector<double> points;
            const auto weights = all_eighths(3);
            for (const auto& w : weights) {
                points.push_back(w[1]);
                points.push_back(w[2]);
            }
            std::vector<double> found(2 * weights.size()), right(found);
            TierCounts tiers;
            ASSERT_TRUE(perspective_values(vertices, points, values, 2, found, &tiers));
            ASSERT_TRUE(perspective_values(vertices, points, zeros, 2, right));
            std::uint64_t with = 0;
            for (std::size_t j = 0; j < weights.size(); ++j) {
                const bool has_part = weights[j][hole] != 0;
                with += has_part ? 1 : 0;
                const double first[] = {values[0], values[2], values[4]};
                const double one = perspective_value(vertices, &points[2 * j], first)->value;
                EXPECT_EQ(std::isnan(found[2 * j]), has_part);
                EXPECT_EQ(std::isnan(one), has_part);
                if (!has_part) {
                    EXPECT_EQ(found[2 * j], right[2 * j]);
                    EXPECT_EQ(one, right[2 * j]);
                }
                EXPECT_EQ(found[2 * j + 1], right[2 * j + 1]);
            }
            EXPECT_EQ(tiers.not_finite, with);
        }
    }
}

}  // namespace
}  // namespace barycert
