// Points and segments against surfaces: exact rational geometry over all triangles, and voxels, whose inside is known.
#include "barycert/surface_locator.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>
#include <optional>
#include <set>

#include "tests/mesh/check/surfaces.hpp"

namespace barycert::testing {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// No double is nearer to the exact number.
bool is_rounded(double x, const mpq_class& exact) {
    const mpq_class off = abs(mpq_class(x) - exact);
    for (const double other : {std::nextafter(x, infinity), std::nextafter(x, -infinity)}) {
        if (std::isfinite(other) && abs(mpq_class(other) - exact) < off) return false;
    }
    return true;
}

/// The same of the root of a square: by squares of the middles between x and its neighbours.
bool is_rounded_root(double x, const mpq_class& square) {
    if (square == 0) return x == 0;
    const mpq_class low = (mpq_class(x) + mpq_class(std::nextafter(x, 0))) / 2,
                    high = (mpq_class(x) + mpq_class(std::nextafter(x, infinity))) / 2;
    return x > 0 && low * low <= square && square <= high * high;
}

std::vector<RationalTriangle> triangles_of(const Surface& s) {
    std::vector<RationalTriangle> all;
    for (std::size_t t = 0; t < s.cell_count(); ++t) all.push_back(triangle_of(s, t));
    return all;
}

/// Exact weights of the projection of a point to a vertex, edge or face.
std::vector<mpq_class> weights_of(const std::vector<Rational3>& corners, const Rational3& at) {
    if (corners.size() == 1) return {1};
    if (corners.size() == 2) {
        const Rational3 e = corners[1] - corners[0];
        const mpq_class t = inner(at - corners[0], e) / inner(e, e);
        return {1 - t, t};
    }
    const auto w = weights_in({corners[0], corners[1], corners[2]}, at);
    return {w.begin(), w.end()};
}

void expect_nearest(const Surface& s, const std::vector<RationalTriangle>& triangles, const double* p,
                    const SurfaceNearest& found, const std::string& what) {
    const Rational3 at = rational(p);
    mpq_class best = -1;
    Mesh::Index lowest = -1;
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        const mpq_class square = square_to(triangles[t], at);
        if (best >= 0 && square >= best) continue;
        best = square;
        lowest = static_cast<Mesh::Index>(t);
    }
    ASSERT_EQ(found.cell, lowest) << what;
    EXPECT_TRUE(is_rounded_root(found.distance, best)) << what;
    // The nodes are the triangle's; the point is their mean by the exact weights, and those given are these, rounded.
    std::vector<Rational3> corners;
    for (const Mesh::Index n : found.nodes) {
        if (n < 0) continue;
        EXPECT_NE(std::ranges::count(s.cells.begin() + 3 * lowest, s.cells.begin() + 3 * lowest + 3, n), 0) << what;
        corners.push_back(rational(&s.points[3 * static_cast<std::size_t>(n)]));
    }
    const std::vector<mpq_class> weights = weights_of(corners, at);
    ASSERT_EQ(weights.size(), corners.size()) << what;
    Rational3 x{0, 0, 0};
    for (std::size_t i = 0; i < corners.size(); ++i) {
        EXPECT_GT(weights[i], 0) << what;
        EXPECT_TRUE(is_rounded(found.weights[i], weights[i])) << what;
        for (std::size_t k = 0; k < 3; ++k) x[k] += weights[i] * corners[i][k];
    }
    for (std::size_t k = 0; k < 3; ++k) EXPECT_TRUE(is_rounded(found.point[k], x[k])) << what << " axis " << k;
    const Rational3 away = at - x;
    EXPECT_EQ(inner(away, away), best) << what;
}

std::vector<double> random_points(const Surface& s, std::size_t count, std::uint64_t seed) {
    std::mt19937_64 random(seed);
    const auto [low, high] = std::ranges::minmax(s.points);
    std::vector<double> points;
    for (std::size_t i = 0; i < count; ++i) {
        for (int k = 0; k < 3; ++k) {
            const double part = static_cast<double>(random() % 1025) / 512 - 0.5;
            // On lattices many points are as near to several triangles.
            points.push_back(i % 3 == 0 ? std::round(low + part * (high - low)) : low + part * (high - low));
        }
        const std::size_t node = random() % s.point_count(), other = random() % s.point_count();
        for (std::size_t k = 0; k < 3 && i % 7 == 0; ++k)
            points[3 * i + k] =
                i % 2 == 0 ? s.points[3 * node + k] : (s.points[3 * node + k] + s.points[3 * other + k]) / 2;
    }
    return points;
}

void expect_all_nearest(const Surface& s, const std::vector<double>& points, const std::string& what) {
    const SurfaceLocator locator = SurfaceLocator::build(s).value();
    std::vector<SurfaceNearest> found(points.size() / 3), again = found;
    ASSERT_TRUE(locator.nearest(points, infinity, found, 1));
    ASSERT_TRUE(locator.nearest(points, infinity, again, 2));
    const std::vector<RationalTriangle> triangles = triangles_of(s);
    for (std::size_t i = 0; i < found.size(); ++i) {
        expect_nearest(s, triangles, &points[3 * i], found[i], what + ": point " + std::to_string(i));
        const SurfaceNearest one = locator.nearest(&points[3 * i], infinity).value();
        for (const SurfaceNearest& other : {one, again[i]}) {
            EXPECT_EQ(other.cell, found[i].cell);
            EXPECT_EQ(other.distance, found[i].distance);
            EXPECT_EQ(other.point, found[i].point);
            EXPECT_EQ(other.nodes, found[i].nodes);
            EXPECT_EQ(other.weights, found[i].weights);
        }
        // The limit is that of rounded distances.
        EXPECT_EQ(locator.nearest(&points[3 * i], found[i].distance).value().cell, found[i].cell) << what;
        if (found[i].distance == 0) continue;
        EXPECT_EQ(locator.nearest(&points[3 * i], std::nextafter(found[i].distance, 0)).value().cell, -1) << what;
    }
}

TEST(SurfaceLocator, N1_NearestOfSoups) {
    for (std::uint64_t seed = 0; seed < 12; ++seed) {
        const Surface s = random_soup(seed % 2 == 0 ? 4 : 40, 20, 30, seed);
        expect_all_nearest(s, random_points(s, 60, seed), "soup " + std::to_string(seed));
    }
}

TEST(SurfaceLocator, N1_NearestOfSurfaces) {
    for (const auto& [s, what] :
         {std::pair(torus(20, 12), "torus"), {surface_of(random_voxels(4, 0.5, 3)), "voxels"}}) {
        const std::vector<double> points = random_points(s, 60, 9);
        expect_all_nearest(s, points, what);
        const auto scaled = [&](double factor) {
            std::vector<double> at = points;
            for (double& x : at) x *= factor;
            return at;
        };
        expect_all_nearest(mapped(s, 0x1p500), scaled(0x1p500), "times 2^500");
        expect_all_nearest(mapped(s, 0x1p-500), scaled(0x1p-500), "times 2^-500");
        std::vector<double> moved = points;
        for (double& x : moved) x += 1e6;
        expect_all_nearest(mapped(s, 1, 1e6), moved, "moved");
    }
}

TEST(SurfaceLocator, N1_NearestFromFarAway) {
    const Surface s = torus(12, 8);
    std::vector<double> points;
    for (const double far : {20.0, 1e3, 1e9, 1e30, 1e300}) {
        for (const auto& d : {std::array{1.0, 0.3, -0.2}, {-0.1, 1.0, 0.7}, {0.0, 0.0, 1.0}}) {
            for (const double x : d) points.push_back(x * far);
        }
    }
    points.insert(points.end(), {0x1p-1074, 0, 0, 1e-300, -1e-310, 1e-200});
    expect_all_nearest(s, points, "far");
}

TEST(SurfaceLocator, N1_ManyTrianglesAsNear) {
    // From the axis of a cone all are as near; and from the middle of a sphere of nodes.
    Surface cone;
    cone.points = {0, 0, 5};
    for (const int x : {3, -3, 4, -4}) {
        for (const int y : {4, -4, 3, -3}) {
            if (x * x + y * y == 25)
                cone.points.insert(cone.points.end(), {static_cast<double>(x), static_cast<double>(y), 0});
        }
    }
    for (Mesh::Index i = 1; i + 1 < static_cast<Mesh::Index>(cone.point_count()); ++i)
        cone.cells.insert(cone.cells.end(), {0, i, i + 1});
    expect_all_nearest(cone, {0, 0, 0, 0, 0, -1, 0, 0, 4, 0, 0, 9, 0, 0, 5}, "cone");
}

TEST(SurfaceLocator, V1_ValuesAreExactMeans) {
    for (const Surface& s : {torus(20, 12), random_soup(40, 20, 30, 5)}) {
        const SurfaceLocator locator = SurfaceLocator::build(s).value();
        const std::vector<double> points = random_points(s, 90, 4);
        std::vector<SurfaceNearest> found(points.size() / 3);
        ASSERT_TRUE(locator.nearest(points, infinity, found, 1));
        std::mt19937_64 random(8);
        Field field{"f", 1, {}}, cells{"c", 1, {}};
        // Values that cancel, and are not exact in sums of doubles.
        for (std::size_t i = 0; i < s.point_count(); ++i)
            field.data.push_back((i % 2 == 0 ? 1e10 : -1e10) + static_cast<double>(random() % 1000) / 7);
        for (std::size_t t = 0; t < s.cell_count(); ++t) cells.data.push_back(static_cast<double>(t) / 3);
        std::vector<double> out(found.size()), of_cells = out;
        ASSERT_TRUE(locator.values(field, false, points, found, out, 1));
        ASSERT_TRUE(locator.values(cells, true, points, found, of_cells, 1));
        for (std::size_t i = 0; i < found.size(); ++i) {
            std::vector<Rational3> corners;
            std::vector<double> rows;
            for (const Mesh::Index n : found[i].nodes) {
                if (n < 0) continue;
                corners.push_back(rational(&s.points[3 * static_cast<std::size_t>(n)]));
                rows.push_back(field.data[static_cast<std::size_t>(n)]);
            }
            const std::vector<mpq_class> weights = weights_of(corners, rational(&points[3 * i]));
            mpq_class mean = 0;
            for (std::size_t k = 0; k < rows.size(); ++k) mean += weights[k] * mpq_class(rows[k]);
            EXPECT_TRUE(is_rounded(out[i], mean)) << i;
            EXPECT_EQ(of_cells[i], cells.data[static_cast<std::size_t>(found[i].cell)]) << i;
        }
    }
}

void expect_same(const SurfaceNearest& a, const SurfaceNearest& b, std::size_t i) {
    EXPECT_EQ(a.cell, b.cell) << i;
    EXPECT_EQ(a.nodes, b.nodes) << i;
    EXPECT_EQ(a.distance, b.distance) << i;
    EXPECT_EQ(a.point, b.point) << i;
    EXPECT_EQ(a.weights, b.weights) << i;
    EXPECT_EQ(a.on, b.on) << i;
}

// With the triangles known beforehand the answers are the same; on others they are those of these alone.
TEST(SurfaceLocator, N1_OnGivenTriangles) {
    for (const Surface& s : {torus(20, 12), random_soup(40, 20, 30, 5), surface_of(random_voxels(3, 0.5, 3))}) {
        const SurfaceLocator locator = SurfaceLocator::build(s).value();
        const std::vector<double> points = random_points(s, 90, 4);
        std::vector<SurfaceNearest> found(points.size() / 3), again = found;
        ASSERT_TRUE(locator.nearest(points, infinity, found, 1));
        std::vector<Mesh::Index> triangles;
        for (const SurfaceNearest& n : found) triangles.push_back(n.cell);
        triangles[0] = -1;
        ASSERT_TRUE(locator.nearest_on(triangles, points, again, 2));
        EXPECT_EQ(again[0].cell, -1);
        EXPECT_EQ(again[0].distance, infinity);
        for (std::size_t i = 1; i < found.size(); ++i) expect_same(found[i], again[i], i);
        for (std::size_t i = 0; i < triangles.size(); ++i) triangles[i] = found[7 * i % found.size()].cell;
        ASSERT_TRUE(locator.nearest_on(triangles, points, again, 2));
        for (std::size_t i = 0; i < found.size(); ++i) {
            Surface one;
            for (std::size_t k = 0; k < 3; ++k) {
                const auto node = static_cast<std::size_t>(s.cells[3 * static_cast<std::size_t>(triangles[i]) + k]);
                one.points.insert(one.points.end(), &s.points[3 * node], &s.points[3 * node] + 3);
            }
            one.cells = {0, 1, 2};
            const SurfaceLocator alone = SurfaceLocator::build(one).value();
            const SurfaceNearest n = alone.nearest(&points[3 * i], infinity).value();
            EXPECT_EQ(n.distance, again[i].distance) << i;
            EXPECT_EQ(n.point, again[i].point) << i;
        }
        triangles[3] = static_cast<Mesh::Index>(s.cell_count());
        EXPECT_FALSE(locator.nearest_on(triangles, points, again));
    }
}

// Segments and points: of three different nodes on a line, of two, of one; at places of their own and of other nodes.
TEST(SurfaceLocator, N1_TrianglesWithoutArea) {
    Surface s = torus(8, 6);
    const auto first = static_cast<Mesh::Index>(s.point_count());
    s.points.insert(s.points.end(), {3, 0, 0, 4, 0, 0, 5, 0, 0, 5, 0, 0, 3, 3, 3});
    s.points.insert(s.points.end(), &s.points[0], &s.points[3]);
    for (const auto& t : {std::array{1, 2, 0}, {0, 3, 2}, {2, 3, 2}, {4, 4, 4}, {5, 0, 0}}) {
        for (const int i : t) s.cells.push_back(first + i);
    }
    s.cells.insert(s.cells.end(), {0, 1, 1});
    std::vector<double> points = random_points(s, 200, 3);
    points.insert(points.end(), {4.5, 1, 0, 4, 1, 0, 3.5, 0, 0, 6, 0, 0, 3, 3, 4, 1e9, 1, 0, 4.25, 1e-300, 0});
    expect_all_nearest(s, points, "torus and segments");
    expect_all_nearest(mapped(s, 0x1p-500), points, "times 2^-500");
    Surface alone = s;
    alone.cells.erase(alone.cells.begin(), alone.cells.end() - 18);
    expect_all_nearest(alone, points, "segments");
    const SurfaceLocator locator = SurfaceLocator::build(alone).value();
    EXPECT_EQ(locator.turned(), Turned::open);
    const auto features = [&](std::array<double, 3> p) {
        const SurfaceNearest n = locator.nearest(p.data(), infinity).value();
        const SurfaceLocation at = locator.locate(p.data()).value();
        EXPECT_EQ(n.on, at.triangle >= 0);
        if (n.on) {
            EXPECT_EQ(n.cell, at.triangle);
        }
        return std::pair(n.nodes, at.feature);
    };
    using Nodes = std::array<Mesh::Index, 3>;
    EXPECT_EQ(features({4, 0, 0}), std::pair(Nodes({first + 1, -1, -1}), Feature::vertex));
    EXPECT_EQ(features({4.5, 0, 0}), std::pair(Nodes({first + 1, first + 2, -1}), Feature::edge));
    EXPECT_EQ(features({4.5, 1, 0}), std::pair(Nodes({first + 1, first + 2, -1}), Feature::outside));
    EXPECT_EQ(features({7, 1, 0}), std::pair(Nodes({first + 2, -1, -1}), Feature::outside));
    EXPECT_EQ(features({3, 3, 3}), std::pair(Nodes({first + 4, -1, -1}), Feature::vertex));
    Surface point;
    point.points = {1, 2, 3};
    point.cells = {0, 0, 0};
    expect_all_nearest(point, {1, 2, 3, 0, 0, 0, 1e300, 0, 0}, "a point");
}

// A sphere of nodes has nearly all triangles as near to its centre as floating point knows.
TEST(SurfaceLocator, N1_TheCentreOfASphere) {
    Surface s;
    constexpr int around = 64, along = 32;
    for (int j = 0; j <= along; ++j) {
        for (int i = 0; i < around; ++i) {
            const double u = 2 * std::numbers::pi * i / around, v = std::numbers::pi * j / along;
            s.points.insert(s.points.end(), {std::sin(v) * std::cos(u), std::sin(v) * std::sin(u), std::cos(v)});
            const auto at = [&](int a, int b) { return (j + a) * around + (i + b) % around; };
            if (j < along) s.cells.insert(s.cells.end(), {at(0, 0), at(1, 0), at(1, 1), at(0, 0), at(1, 1), at(0, 1)});
        }
    }
    expect_all_nearest(s, {0, 0, 0, 1e-17, 0, 0, 0, 0, 1e-16, 1e-3, 0, 0}, "sphere");
}

// A distance that rounds to 0 is no proof that the point is on the triangle.
TEST(SurfaceLocator, W1_OnIsExact) {
    Surface s;
    s.points = {-1, -1, -3, 1, -1, 3, 0, 1, 0};  // in the plane z = 3 x
    s.cells = {0, 1, 2};
    const SurfaceLocator locator = SurfaceLocator::build(s).value();
    constexpr double least = 0x1p-1074;
    for (const auto& [p, on] : {std::pair(std::array{0.0, 0.0, 0.0}, true),
                                {std::array{0.0, 0.0, least}, false},
                                {std::array{least, 0.0, 3 * least}, true},
                                {std::array{0.0, 1.0, 0.0}, true},
                                {std::array{0.0, -1.0, least}, false},
                                {std::array{0.0, -1.0, 0.0}, true}}) {
        const SurfaceNearest n = locator.nearest(p.data(), infinity).value();
        EXPECT_EQ(n.distance, 0);
        EXPECT_EQ(n.on, on) << p[0] << ' ' << p[1] << ' ' << p[2];
        EXPECT_EQ(locator.locate(p.data()).value().triangle >= 0, on);
    }
    for (const Surface& any : {random_soup(40, 20, 6, 5), surface_of(random_voxels(3, 0.5, 3))}) {
        const SurfaceLocator of_any = SurfaceLocator::build(any).value();
        const std::vector<double> points = random_points(any, 300, 4);
        std::vector<SurfaceNearest> found(points.size() / 3);
        ASSERT_TRUE(of_any.nearest(points, infinity, found));
        for (std::size_t i = 0; i < found.size(); ++i)
            EXPECT_EQ(found[i].on, of_any.locate(&points[3 * i]).value().triangle >= 0) << i;
    }
}

TEST(SurfaceLocator, D1_OrderAndThreads) {
    const Surface s = surface_of(random_voxels(4, 0.5, 3));
    const SurfaceLocator locator = SurfaceLocator::build(s).value();
    const std::vector<double> points = random_points(s, 300, 6);
    const std::size_t count = points.size() / 3;
    std::vector<double> reversed;
    for (std::size_t i = count; i-- > 0;) reversed.insert(reversed.end(), &points[3 * i], &points[3 * i] + 3);
    std::vector<SurfaceNearest> near(count), near_reversed = near;
    std::vector<SurfaceLocation> at(count), at_reversed = at;
    ASSERT_TRUE(locator.nearest(points, infinity, near, 1));
    ASSERT_TRUE(locator.nearest(reversed, infinity, near_reversed, 2));
    ASSERT_TRUE(locator.locate(points, at, 1));
    ASSERT_TRUE(locator.locate(reversed, at_reversed, 2));
    for (std::size_t i = 0; i < count; ++i) {
        const SurfaceNearest& other = near_reversed[count - 1 - i];
        EXPECT_EQ(at[i], at_reversed[count - 1 - i]) << i;
        expect_same(near[i], other, i);
    }
}

// Inside and outside.

TEST(SurfaceLocator, W1_W2_Voxels) {
    for (std::uint64_t seed = 0; seed < 16; ++seed) {
        const Voxels v = random_voxels(5, 0.4 + 0.03 * static_cast<double>(seed % 8), seed);
        const Surface s = surface_of(v);
        const SurfaceLocator locator = SurfaceLocator::build(s).value();
        ASSERT_EQ(locator.turned(), Turned::alike);
        std::vector<double> points;
        std::vector<int> inside;  // 2: on the surface
        for (int x = -2; x <= 4 * v.n + 2; ++x) {
            for (int y = -2; y <= 4 * v.n + 2; y += seed % 2 == 0 ? 1 : 2) {
                for (int z = -2; z <= 4 * v.n + 2; ++z) {
                    // In quarters; voxels at it: one, or those around a side, an edge or a node.
                    int full = 0, all = 0;
                    const auto around = [](int q) {
                        return q % 4 == 0 ? std::array{q / 4 - 1, q / 4}
                                          : std::array{static_cast<int>(std::floor(q / 4.0)),
                                                       static_cast<int>(std::floor(q / 4.0))};
                    };
                    for (const int i : around(x)) {
                        for (const int j : around(y)) {
                            for (const int k : around(z)) full += v.at(i, j, k) ? 1 : 0, ++all;
                        }
                    }
                    inside.push_back(full == all ? 1 : full == 0 ? 0 : 2);
                    points.insert(points.end(), {x / 4.0, y / 4.0, z / 4.0});
                }
            }
        }
        std::vector<SurfaceLocation> found(inside.size()), again = found;
        ASSERT_TRUE(locator.locate(points, found, 1));
        ASSERT_TRUE(locator.locate(points, again, 2));
        for (std::size_t i = 0; i < found.size(); ++i) {
            const SurfaceLocation& f = found[i];
            EXPECT_EQ(f, again[i]);
            if (i % 11 == 0) {
                EXPECT_EQ(f, locator.locate(&points[3 * i]).value());
            }
            ASSERT_EQ(f.triangle >= 0, inside[i] == 2) << seed << " " << i;
            if (inside[i] != 2) {
                EXPECT_EQ(f.winding, inside[i]);
                EXPECT_EQ(f.feature, inside[i] == 1 ? Feature::interior : Feature::outside);
                continue;
            }
            if (i % 17 != 0) continue;
            const Rational3 p = rational(&points[3 * i]);
            for (std::size_t t = 0; t < s.cell_count(); ++t) {
                const RationalTriangle triangle = triangle_of(s, t);
                if (!lies_on(triangle, p)) continue;
                EXPECT_EQ(f.triangle, static_cast<Mesh::Index>(t));
                const auto w = weights_in(triangle, p);
                const auto zeros = std::ranges::count(w, mpq_class(0));
                EXPECT_EQ(f.feature, zeros == 0 ? Feature::face : zeros == 1 ? Feature::edge : Feature::vertex);
                break;
            }
        }
    }
}

/// A turn of the axes must not matter: rays go along another one then.
TEST(SurfaceLocator, W2_AxesMayTurn) {
    const Surface s = torus(30, 17);
    const std::vector<double> points = random_points(s, 400, 4);
    std::vector<SurfaceLocation> expected;
    for (std::size_t turn = 0; turn < 3; ++turn) {
        const auto turned = [&](const std::vector<double>& x) {
            std::vector<double> y(x.size());
            for (std::size_t i = 0; i < x.size(); ++i) y[3 * (i / 3) + (i + turn) % 3] = x[i];
            return y;
        };
        Surface other = s;
        other.points = turned(s.points);
        const SurfaceLocator locator = SurfaceLocator::build(other).value();
        std::vector<SurfaceLocation> found(points.size() / 3);
        ASSERT_TRUE(locator.locate(turned(points), found));
        if (turn == 0) expected = found;
        EXPECT_EQ(found, expected);
    }
}

TEST(SurfaceLocator, W2_WindingNumbers) {
    // Three cubes one in the other, the outer ones turned outwards, the inner one inwards; and all of it twice.
    Surface s;
    for (const auto& [low, high, turn] : {std::tuple(0, 9, false), {1, 8, false}, {2, 7, true}, {0, 9, false}}) {
        Surface cube = surface_of({1, {1}});
        const auto first = static_cast<Mesh::Index>(s.point_count());
        for (const double x : cube.points) s.points.push_back(low + x * (high - low));
        for (std::size_t i = 0; i < cube.cells.size(); i += 3) {
            if (turn) std::swap(cube.cells[i], cube.cells[i + 1]);
            for (std::size_t k = 0; k < 3; ++k) s.cells.push_back(first + cube.cells[i + k]);
        }
    }
    const SurfaceLocator locator = SurfaceLocator::build(s).value();
    const auto winding = [&](double x) {
        const double p[3] = {x, x + .25, x};
        return locator.locate(p).value().winding;
    };
    EXPECT_EQ(winding(-1), 0);
    EXPECT_EQ(winding(.5), 2);
    EXPECT_EQ(winding(1.5), 3);
    EXPECT_EQ(winding(4), 2);
}

// Without one triangle there is nothing; turned at random what is enclosed, and parity of what meets itself.
TEST(SurfaceLocator, W2_LeastOfShells) {
    Surface cube = surface_of({1, {1}});
    std::swap(cube.cells[3], cube.cells[4]);
    const double middle[3] = {.5, .5, .25}, outside[3] = {2, .5, .5};
    const auto expect = [&](const Surface& s, Turned turned, int in_middle) {
        const SurfaceLocator locator = SurfaceLocator::build(s).value();
        EXPECT_EQ(locator.turned(), turned);
        EXPECT_EQ(locator.locate(middle).value().winding, in_middle);
        EXPECT_EQ(locator.locate(outside).value().winding, 0);
        std::vector<SurfaceLocation> found(40);
        std::vector<double> points;
        for (std::size_t i = 0; i < found.size(); ++i) points.insert(points.end(), middle, middle + 3);
        EXPECT_TRUE(locator.locate(points, found));
        for (const SurfaceLocation& f : found) EXPECT_EQ(f.winding, in_middle);
        EXPECT_EQ(locator.locate(s.points.data()).value().feature, Feature::vertex);
        return locator.sides();
    };
    EXPECT_EQ(expect(cube, Turned::regions, 1).by_regions, 12);
    Surface open = cube;
    open.cells.resize(open.cells.size() - 3);
    EXPECT_GE(expect(open, Turned::open, 0).open, 0);
    // A fin encloses nothing; a sheet by itself might be what is meant.
    Surface fin = cube;
    fin.points.insert(fin.points.end(), {0, 0, 3, 5, 5, 5, 6, 5, 5, 5, 6, 5});
    fin.cells.insert(fin.cells.end(), {0, 1, 8});
    EXPECT_EQ(expect(fin, Turned::regions, 1).idle, 1);
    fin.cells.insert(fin.cells.end(), {9, 10, 11});
    EXPECT_EQ(expect(fin, Turned::open, 0).open, 13);
    // Twice, once each way: what cancels is what the other side of a sheet is, and leaves the cube.
    Surface both = surface_of({1, {1}});
    for (std::size_t i = 0; i < 36; ++i) both.cells.push_back(both.cells[i]);
    for (std::size_t i = 36; i < 72; i += 3) std::swap(both.cells[i], both.cells[i + 1]);
    EXPECT_EQ(expect(both, Turned::regions, 1).by_regions, 24);
    // A long edge, and its two parts: a triangle without an area joins them.
    Surface split = surface_of({1, {1}});
    split.points.insert(split.points.end(), {.5, 0, 0});
    const auto has = [&](std::size_t t, Mesh::Index n) {
        return std::count(split.cells.begin() + 3 * t, split.cells.begin() + 3 * t + 3, n) != 0;
    };
    const auto node = [&](double x, double y, double z) {
        for (Mesh::Index n = 0; n < 8; ++n) {
            const double* const p = &split.points[3 * static_cast<std::size_t>(n)];
            if (p[0] == x && p[1] == y && p[2] == z) return n;
        }
        return Mesh::Index{-1};
    };
    const Mesh::Index a = node(0, 0, 0), b = node(1, 0, 0);
    for (std::size_t t = 0; t < 12; ++t) {
        if (!has(t, a) || !has(t, b)) continue;
        // Cut at the node, and the triangle between the parts and the whole, turned as the other side has them.
        auto* const corner = &split.cells[3 * t];
        while (corner[0] == a || corner[0] == b) std::rotate(corner, corner + 1, corner + 3);
        const Mesh::Index apex = corner[0], from = corner[1], to = corner[2];
        corner[2] = 8;
        split.cells.insert(split.cells.end(), {apex, 8, to, from, to, 8});
        break;
    }
    expect(split, Turned::alike, 1);
    // Two cubes that cross, one with a triangle turned, joined along an edge: parity.
    Surface crossing = cube;
    for (const double x : surface_of({1, {1}}).points) crossing.points.push_back(x);
    for (std::size_t i = 0; i < 36; ++i) crossing.cells.push_back(cube.cells[i] + 8);
    for (std::size_t i = 8; i < 16; ++i) {
        double* const p = &crossing.points[3 * i];
        if (p[2] == 1) p[0] += .25, p[1] += .25;
    }
    const SideRules rules = expect(crossing, Turned::even, 0);
    EXPECT_GT(rules.by_parity, 0);
}

/// Sides of unit cells, each some times, turned at random; what is inside by the words of W2, by filling cells.
class Walls {
public:
    static constexpr int n = 5;

    explicit Walls(std::uint64_t seed) {
        std::mt19937_64 random(seed);
        const Voxels v = random_voxels(n, 0.15 + 0.1 * static_cast<double>(seed % 4), seed);
        const auto one_of = [&](unsigned k) { return random() % k == 0; };
        const unsigned turned = seed % 3 == 0 ? 1000 : 12, extra = seed % 2 == 0 ? 1000 : 10,
                       missing = seed % 5 == 4 ? 40 : 100000;
        const int way = seed % 7 == 3 ? -1 : 1;
        each([&](const Side& s) {
            const auto [low, high] = cells(s);
            const bool from = v.at(low[0], low[1], low[2]), to = v.at(high[0], high[1], high[2]);
            // 1: normal along the axis.
            if (from != to && !one_of(missing)) sides_[s].push_back(from != one_of(turned) ? way : -way);
            if ((from || to) && one_of(extra)) sides_[s].push_back(one_of(2) ? 1 : -1);
        });
    }

    Surface surface() const {
        Surface s;
        std::map<Cell, Mesh::Index> nodes;
        for (const auto& [side, turns] : sides_) {
            for (const int turn : turns) {
                std::array<Mesh::Index, 4> ring{};
                for (std::size_t i = 0; i < 4; ++i) {
                    Cell at = side.low;
                    at[(side.axis + 1) % 3] += i == 1 || i == 2 ? 1 : 0;
                    at[(side.axis + 2) % 3] += i >= 2 ? 1 : 0;
                    const auto [node, fresh] = nodes.try_emplace(at, static_cast<Mesh::Index>(nodes.size()));
                    if (fresh) s.points.insert(s.points.end(), at.begin(), at.end());
                    ring[i] = node->second;
                }
                for (const std::array<std::size_t, 3>& t : {std::array<std::size_t, 3>{0, 1, 2}, {0, 2, 3}}) {
                    for (std::size_t k = 0; k < 3; ++k) s.cells.push_back(ring[t[turn > 0 ? k : 2 - k]]);
                }
            }
        }
        return s;
    }

    /// Winding numbers of the middle of each cell; nothing if there is no inside.
    std::optional<std::map<std::array<int, 3>, int>> windings() const {
        std::map<std::array<int, 3>, int> sum;
        std::set<Side> left;
        for (const auto& entry : sides_) left.insert(entry.first);
        for (const std::set<Side>& shell : shells(left)) {
            const std::set<Side> closed = peeled(shell);
            if (!closed.empty()) continue;
            if (std::ranges::any_of(shell, [&](const Side& s) { return net(s) != 0; })) return std::nullopt;
        }
        bool any = false;
        for (const std::set<Side>& shell : shells(peeled(left))) any = add(shell, sum) || any;
        return any ? std::optional(sum) : std::nullopt;
    }

private:
    using Cell = std::array<int, 3>;
    struct Side {
        Cell low;
        std::size_t axis;
        auto operator<=>(const Side&) const = default;
    };
    using Edge = std::pair<Cell, std::size_t>;

    template <class Use>
    static void each(Use use) {
        for (int x = -1; x <= n + 1; ++x) {
            for (int y = -1; y <= n + 1; ++y) {
                for (int z = -1; z <= n + 1; ++z) {
                    for (std::size_t axis = 0; axis < 3; ++axis) use(Side{{x, y, z}, axis});
                }
            }
        }
    }
    static std::array<Cell, 2> cells(const Side& s) {
        Cell low = s.low;
        --low[s.axis];
        return {low, s.low};
    }
    int net(const Side& s) const { return std::accumulate(sides_.at(s).begin(), sides_.at(s).end(), 0); }

    /// Each with the direction in which a side goes along it whose normal is along its axis.
    static std::array<std::pair<Edge, int>, 4> edges(const Side& s) {
        const std::size_t a = (s.axis + 1) % 3, b = (s.axis + 2) % 3;
        Cell beside = s.low, above = s.low;
        ++beside[a];
        ++above[b];
        return {{{{s.low, a}, 1}, {{beside, b}, 1}, {{above, a}, -1}, {{s.low, b}, -1}}};
    }
    static std::map<Edge, std::vector<Side>> by_edge(const std::set<Side>& sides) {
        std::map<Edge, std::vector<Side>> all;
        for (const Side& s : sides) {
            for (const auto& [edge, way] : edges(s)) all[edge].push_back(s);
        }
        return all;
    }
    static std::set<Side> peeled(std::set<Side> sides) {
        for (bool again = true; again;) {
            again = false;
            for (const auto& [edge, at] : by_edge(sides)) {
                if (at.size() == 1) again = sides.erase(at[0]) != 0 || again;
            }
        }
        return sides;
    }
    static std::vector<std::set<Side>> shells(std::set<Side> sides) {
        std::vector<std::set<Side>> all;
        const auto at = by_edge(sides);
        while (!sides.empty()) {
            std::vector<Side> open{*sides.begin()};
            sides.erase(sides.begin());
            std::set<Side>& shell = all.emplace_back();
            while (!open.empty()) {
                const Side side = open.back();
                open.pop_back();
                shell.insert(side);
                for (const auto& [edge, way] : edges(side)) {
                    for (const Side& other : at.at(edge)) {
                        if (sides.erase(other) != 0) open.push_back(other);
                    }
                }
            }
        }
        return all;
    }

    /// True if it counts for something.
    bool add(const std::set<Side>& shell, std::map<std::array<int, 3>, int>& sum) const {
        std::map<Edge, int> along;
        bool any = false;
        for (const Side& s : shell) {
            any = any || net(s) != 0;
            for (const auto& [edge, way] : edges(s)) along[edge] += way * net(s);
        }
        if (any && std::ranges::all_of(along, [](const auto& e) { return e.second == 0; })) {
            // Sums what a ray along the first axis crosses.
            for (int y = -2; y <= n + 2; ++y) {
                for (int z = -2; z <= n + 2; ++z) {
                    int winding = 0;
                    for (int x = n + 2; x >= -2; --x) {
                        const Side s{{x + 1, y, z}, 0};
                        if (shell.contains(s)) winding += net(s);
                        sum[{x, y, z}] += winding;
                    }
                }
            }
            return true;
        }
        // The cells outside of it.
        std::set<Cell> outside{{-2, -2, -2}};
        std::vector<Cell> open{{-2, -2, -2}};
        while (!open.empty()) {
            const Cell from = open.back();
            open.pop_back();
            for (std::size_t axis = 0; axis < 3; ++axis) {
                for (const int step : {-1, 1}) {
                    Cell to = from;
                    to[axis] += step;
                    const bool wall = shell.contains(Side{step > 0 ? to : from, axis});
                    if (to[axis] < -2 || to[axis] > n + 2 || wall || !outside.insert(to).second) continue;
                    open.push_back(to);
                }
            }
        }
        int outward = 0;
        for (const Side& s : shell) {
            const auto [low, high] = cells(s);
            outward += net(s) * ((outside.contains(high) ? 1 : 0) - (outside.contains(low) ? 1 : 0));
        }
        for (int x = -2; x <= n + 2; ++x) {
            for (int y = -2; y <= n + 2; ++y) {
                for (int z = -2; z <= n + 2; ++z) {
                    if (!outside.contains({x, y, z})) sum[{x, y, z}] += outward < 0 ? -1 : 1;
                }
            }
        }
        return true;
    }

    std::map<Side, std::vector<int>> sides_;
};

TEST(SurfaceLocator, W2_WallsTurnsAndCopies) {
    std::array<int, 4> turned{};
    int negative = 0;
    for (std::uint64_t seed = 0; seed < 120; ++seed) {
        const Walls walls(seed);
        const Surface s = walls.surface();
        const SurfaceLocator locator = SurfaceLocator::build(s).value();
        ++turned[static_cast<std::size_t>(locator.turned())];
        const auto expected = walls.windings();
        ASSERT_EQ(locator.turned() != Turned::open, expected.has_value()) << seed;
        ASSERT_NE(locator.turned(), Turned::even) << seed;
        if (!expected) continue;
        std::vector<double> points;
        std::vector<int> windings;
        for (const auto& [cell, winding] : *expected) {
            // Off the middle, which is over the diagonals of sides.
            points.insert(points.end(), {cell[0] + .5, cell[1] + .5, cell[2] + .25});
            windings.push_back(winding);
            negative += winding < 0 ? 1 : 0;
        }
        std::vector<SurfaceLocation> found(windings.size());
        ASSERT_TRUE(locator.locate(points, found));
        for (std::size_t i = 0; i < found.size(); ++i) {
            ASSERT_EQ(found[i].winding, windings[i]) << seed << ' ' << i;
            ASSERT_EQ(locator.locate(&points[3 * i]).value(), found[i]) << seed << ' ' << i;
        }
    }
    EXPECT_GT(turned[0], 5);
    EXPECT_GT(turned[2], 20);
    EXPECT_GT(turned[3], 5);
    EXPECT_GT(negative, 0);
}

TEST(SurfaceLocator, W1_PointsAnUlpOff) {
    const Surface s = torus(40, 24);
    const SurfaceLocator locator = SurfaceLocator::build(s).value();
    const std::vector<RationalTriangle> triangles = triangles_of(s);
    std::mt19937_64 random(5);
    for (int i = 0; i < 200; ++i) {
        const std::size_t t = random() % s.cell_count();
        std::array<double, 3> p{};
        for (std::size_t k = 0; k < 3; ++k) {
            for (std::size_t c = 0; c < 3; ++c)
                p[k] += s.points[3 * static_cast<std::size_t>(s.cells[3 * t + c]) + k] / 3;
        }
        if (i % 3 == 0) std::copy_n(&s.points[3 * static_cast<std::size_t>(s.cells[3 * t])], 3, p.begin());
        if (i % 2 == 0)
            p[random() % 3] += 0;
        else
            p[random() % 3] = std::nextafter(p[random() % 3], 0);
        bool on = false;
        for (const RationalTriangle& triangle : triangles) on = on || lies_on(triangle, rational(p.data()));
        EXPECT_EQ(locator.locate(p.data()).value().triangle >= 0, on) << i;
    }
}

// Segments.

/// The first point of a segment on a triangle without an area: a corner, its own end, or where two lines meet.
std::optional<mpq_class> first_on_flat(const RationalTriangle& t, const Rational3& a, const Rational3& b, bool ray) {
    const Rational3 d = b - a;
    std::vector<mpq_class> at{0};
    for (std::size_t i = 0; i < 3; ++i) {
        at.push_back(inner(t[i] - a, d) / inner(d, d));
        const Rational3 e = t[(i + 1) % 3] - t[i], n = outer(d, e);
        if (inner(n, n) != 0) at.push_back(inner(outer(t[i] - a, e), n) / inner(n, n));
    }
    std::optional<mpq_class> first;
    for (const mpq_class& one : at) {
        if (one < 0 || (!ray && one > 1) || (first && *first <= one)) continue;
        if (is_flat(t) && lies_on(t, between(a, b, one))) first = one;
    }
    return first;
}

TEST(SurfaceLocator, H1_HitsInOrder) {
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
        const Surface s = random_soup(seed % 2 == 0 ? 4 : 30, 20, 30, seed);
        const SurfaceLocator locator = SurfaceLocator::build(s).value();
        const std::vector<RationalTriangle> triangles = triangles_of(s);
        const std::vector<double> ends = random_points(s, 20, seed + 50);
        for (std::size_t i = 0; i + 5 < ends.size(); i += 6) {
            const double *const a = &ends[i], *const b = &ends[i + 3];
            if (std::equal(a, a + 3, b)) continue;
            for (const bool ray : {false, true}) {
                const std::vector<SurfaceHit> hits = locator.hits(a, b, ray).value();
                std::vector<std::pair<mpq_class, Mesh::Index>> expected;
                const Rational3 ra = rational(a), rb = rational(b);
                for (std::size_t t = 0; t < triangles.size(); ++t) {
                    if (const auto at = first_on_flat(triangles[t], ra, rb, ray); is_flat(triangles[t])) {
                        if (at) expected.emplace_back(*at, static_cast<Mesh::Index>(t));
                        continue;
                    }
                    const Rational3 n = outer(triangles[t][1] - triangles[t][0], triangles[t][2] - triangles[t][0]);
                    const mpq_class u = inner(n, ra - triangles[t][0]), v = inner(n, rb - triangles[t][0]);
                    mpq_class first = -1;
                    if (u != v) {
                        const mpq_class at = u / (u - v);
                        if (at >= 0 && (ray || at <= 1) && lies_on(triangles[t], between(ra, rb, at))) first = at;
                    } else if (u == 0) {
                        // In its plane: from a, or where it comes in over an edge.
                        std::vector<mpq_class> at{0};
                        for (std::size_t e = 0; e < 3; ++e) {
                            const Rational3 side = outer(n, triangles[t][(e + 1) % 3] - triangles[t][e]);
                            const mpq_class x = inner(side, ra - triangles[t][e]),
                                            y = inner(side, rb - triangles[t][e]);
                            if (x != y) at.push_back(x / (x - y));
                        }
                        for (const mpq_class& one : at) {
                            if (one >= 0 && (ray || one <= 1) && (first < 0 || one < first) &&
                                lies_on(triangles[t], between(ra, rb, one)))
                                first = one;
                        }
                    }
                    if (first >= 0) expected.emplace_back(first, static_cast<Mesh::Index>(t));
                }
                std::ranges::sort(expected);
                ASSERT_EQ(hits.size(), expected.size()) << seed << " " << i << " " << ray;
                for (std::size_t h = 0; h < hits.size(); ++h) {
                    EXPECT_EQ(hits[h].triangle, expected[h].second) << seed << " " << i << " " << ray;
                    EXPECT_TRUE(is_rounded(hits[h].parameter, expected[h].first));
                }
            }
        }
    }
}

TEST(SurfaceLocator, H1_SidesAndFeatures) {
    const Surface cube = surface_of({1, {1}});
    const SurfaceLocator locator = SurfaceLocator::build(cube).value();
    const double a[3] = {-1, .25, .5}, b[3] = {3, .25, .5};
    const std::vector<SurfaceHit> hits = locator.hits(a, b).value();
    ASSERT_EQ(hits.size(), 2);
    EXPECT_EQ(hits[0].side, -1);  // against the normal: in
    EXPECT_EQ(hits[1].side, 1);
    EXPECT_EQ(hits[0].parameter, .25);
    EXPECT_EQ(hits[0].feature, Feature::face);
    const double c[3] = {-1, -1, -1}, d[3] = {2, 2, 2};
    const std::vector<SurfaceHit> corners = locator.hits(c, d).value();
    ASSERT_FALSE(corners.empty());
    for (const SurfaceHit& hit : corners) EXPECT_EQ(hit.feature, Feature::vertex);
    EXPECT_FALSE(locator.hits(a, a));
}

TEST(SurfaceLocator, Errors) {
    Surface s = surface_of({1, {1}});
    const double nan[3] = {0, std::numeric_limits<double>::quiet_NaN(), 0};
    const SurfaceLocator locator = SurfaceLocator::build(s).value();
    EXPECT_FALSE(locator.locate(nan));
    EXPECT_FALSE(locator.nearest(nan, 1));
    EXPECT_EQ(locator.nearest(s.points.data(), -1).value().cell, -1);
    EXPECT_EQ(locator.nearest(s.points.data(), nan[1]).value().cell, -1);
    s.cells[0] = 77;
    EXPECT_FALSE(SurfaceLocator::build(s));
    const Surface none;
    const SurfaceLocator empty = SurfaceLocator::build(none).value();
    const double p[3] = {0, 0, 0};
    EXPECT_EQ(empty.locate(p).value(), SurfaceLocation());
    EXPECT_EQ(empty.nearest(p, infinity).value().cell, -1);
    EXPECT_TRUE(empty.hits(p, s.points.data() + 3).value().empty());
    std::vector<SurfaceNearest> found(1);
    EXPECT_TRUE(empty.nearest(std::span(p, 3), infinity, found));
    EXPECT_EQ(found[0].cell, -1);
}

}  // namespace
}  // namespace barycert::testing
