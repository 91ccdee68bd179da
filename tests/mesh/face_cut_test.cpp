#include "mesh/face_cut.hpp"

#include "tests/mesh/cut_oracle.hpp"

namespace barycert::test {
namespace {

using Index = Mesh::Index;
using Flat = std::array<int, 2>;

std::int64_t turn_of(const Flat& a, const Flat& b, const Flat& c) {
    return std::int64_t{b[0] - a[0]} * (c[1] - a[1]) - std::int64_t{b[1] - a[1]} * (c[0] - a[0]);
}

bool between(const Flat& a, const Flat& p, const Flat& b) {
    return turn_of(a, b, p) == 0 && std::min(a, b) <= p && p <= std::max(a, b);
}

/// The segments have a common point that is no end of both.
bool cross(const Flat& a, const Flat& b, const Flat& c, const Flat& d) {
    const auto sign = [](std::int64_t x) { return x > 0 ? 1 : x < 0 ? -1 : 0; };
    if (sign(turn_of(a, b, c)) * sign(turn_of(a, b, d)) < 0 && sign(turn_of(c, d, a)) * sign(turn_of(c, d, b)) < 0)
        return true;
    for (const Flat& p : {a, b}) {
        if (p != c && p != d && between(c, p, d)) return true;
    }
    for (const Flat& p : {c, d}) {
        if (p != a && p != b && between(a, p, b)) return true;
    }
    return false;
}

/// A simple polygon through random points of a small grid, many of them on lines: crossings are taken out one by one.
std::vector<Flat> random_polygon(std::mt19937& random, std::size_t n, int side) {
    while (true) {
        std::set<Flat> places;
        while (places.size() < n) {
            const int x = static_cast<int>(random() % static_cast<unsigned>(side));
            places.insert({x, static_cast<int>(random() % static_cast<unsigned>(side))});
        }
        std::vector<Flat> ring(places.begin(), places.end());
        std::ranges::shuffle(ring, random);
        for (int tries = 0; tries < 1000; ++tries) {
            bool crossed = false;
            for (std::size_t i = 0; i < n && !crossed; ++i) {
                for (std::size_t j = i + 1; j < n && !crossed; ++j) {
                    if (!cross(ring[i], ring[(i + 1) % n], ring[j], ring[(j + 1) % n])) continue;
                    crossed = true;
                    if (random() % 4 == 0)
                        std::swap(ring[i], ring[random() % n]);
                    else
                        std::reverse(ring.begin() + static_cast<std::ptrdiff_t>(i) + 1,
                                     ring.begin() + static_cast<std::ptrdiff_t>(j) + 1);
                }
            }
            if (!crossed) return ring;
        }
    }
}

std::set<std::set<Index>> sets_of(const std::vector<mesh::NodeTriangle>& triangles) {
    std::set<std::set<Index>> sets;
    for (const auto& t : triangles) sets.emplace(t.begin(), t.end());
    return sets;
}

TEST(FaceCut, FillsConcavePolygonsWithFlatCorners) {
    std::mt19937 random(1);
    std::size_t fans = 0, others = 0;
    for (int round = 0; round < 3000; ++round) {
        const std::size_t n = 3 + random() % 10;
        const std::vector<Flat> ring = random_polygon(random, n, n < 6 ? 4 : 6);
        std::vector<Index> order(n);
        std::iota(order.begin(), order.end(), 0);
        std::ranges::shuffle(order, random);
        Mesh mesh;
        mesh.dimension = 2;
        mesh.points.resize(2 * n);
        std::int64_t area = 0;
        for (std::size_t i = 0; i < n; ++i) {
            for (std::size_t k = 0; k < 2; ++k) mesh.points[2 * static_cast<std::size_t>(order[i]) + k] = ring[i][k];
            area += std::int64_t{ring[i][0]} * ring[(i + 1) % n][1] - std::int64_t{ring[i][1]} * ring[(i + 1) % n][0];
        }
        if (area == 0) continue;  // three on a line
        add_shape(mesh, n == 4 && round % 2 == 0 ? 9 : 7, order);
        cut(mesh);
        ASSERT_EQ(fault_of_parts(mesh, area), "") << "round " << round;
        ASSERT_EQ(mesh.cell_count(), n - 2);
        ASSERT_EQ(measure(mesh, 0) > 0, area > 0);
        std::size_t with_lowest = 0;
        for (std::size_t part = 0; part < mesh.cell_count(); ++part)
            with_lowest += std::ranges::count(mesh.corners_of(part), 0) == 1 ? 1 : 0;
        ++(with_lowest == n - 2 ? fans : others);
        const auto expected = sets_of_corners(mesh);
        // The same ring from elsewhere, the other way, and in planes in space.
        for (const auto& [u, v] :
             {std::pair(WholePoint{1, 0, 2}, WholePoint{0, 1, -3}), {{0, 0, 1}, {1, 0, 0}}, {{-1, 2, 0}, {5, 1, 1}}}) {
            std::vector<double> points(3 * n);
            for (std::size_t i = 0; i < n; ++i) {
                for (std::size_t k = 0; k < 3; ++k)
                    points[3 * static_cast<std::size_t>(order[i]) + k] =
                        static_cast<double>(ring[i][0] * u[k] + ring[i][1] * v[k] + 7);
            }
            std::vector<Index> other = order;
            if (random() % 2 == 0) std::ranges::reverse(other);
            std::ranges::rotate(other, other.begin() + static_cast<std::ptrdiff_t>(random() % n));
            std::vector<mesh::NodeTriangle> triangles;
            ASSERT_TRUE(mesh::cut_face({points.data(), 3, {}}, other, triangles));
            ASSERT_EQ(sets_of(triangles), expected);
        }
    }
    EXPECT_GT(fans, 300U);
    EXPECT_GT(others, 300U);
}

TEST(FaceCut, OfConvexFacesOnlyTheLowestNodeCounts) {
    const std::vector<double> points{0, 0, 0, 4, 0, 0, 6, 3, 0, 4, 6, 0, 0, 5, 0};
    std::vector<Index> ring{0, 1, 2, 3, 4};
    do {
        std::vector<Index> numbers(5);
        for (std::size_t i = 0; i < 5; ++i) numbers[static_cast<std::size_t>(ring[i])] = static_cast<Index>(10 * i);
        std::vector<mesh::NodeTriangle> triangles;
        const std::vector<Index> face{0, 1, 2, 3, 4};
        const mesh::NumberedNodes nodes{points.data(), 3, numbers};
        ASSERT_TRUE(mesh::cut_face(nodes, face, triangles));
        EXPECT_TRUE(mesh::is_cut_from_lowest(nodes, face));
        for (const auto& t : triangles) EXPECT_EQ(t[0], ring[0]);
    } while (std::ranges::next_permutation(ring).found);
}

TEST(FaceCut, TakesTheDiagonalThatLiesInside) {
    // Concave at node 1, and flat there: the diagonal that has it.
    for (const double x : {1.0, 2.0}) {
        const std::vector<double> points{4, 0, x, x, 0, 4, 0, 0};
        std::vector<mesh::NodeTriangle> triangles;
        const mesh::NumberedNodes nodes{points.data(), 2, {}};
        EXPECT_FALSE(mesh::is_cut_from_lowest(nodes, std::vector<Index>{0, 1, 2, 3}));
        ASSERT_TRUE(mesh::cut_face(nodes, std::vector<Index>{0, 1, 2, 3}, triangles));
        EXPECT_EQ(sets_of(triangles), (std::set<std::set<Index>>{{0, 1, 3}, {1, 2, 3}}));
    }
}

TEST(FaceCut, RefusesWhatIsNoSimplePolygon) {
    const std::vector<std::vector<double>> rings{
        {0, 0, 2, 2, 2, 0, 0, 2},            // a bow
        {0, 0, 4, 0, 4, 4, 2, 0, 0, 4},      // a node on another side
        {0, 0, 4, 0, 2, 0, 2, 3},            // there and back
        {0, 0, 1, 0, 2, 0, 3, 0},            // on a line
        {0, 3, 2, -3, -3, 1, 3, 1, -2, -3},  // a star
    };
    for (const std::vector<double>& points : rings) {
        std::vector<Index> ring(points.size() / 2);
        std::iota(ring.begin(), ring.end(), 0);
        std::vector<mesh::NodeTriangle> triangles;
        EXPECT_FALSE(mesh::cut_face({points.data(), 2, {}}, ring, triangles));
        EXPECT_TRUE(triangles.empty());
    }
    // All triangles at node 0 turn one way, twice around it.
    const std::vector<double> spiral{0, 0, 4, 0, -2, 3, -2, -3, 3, -1, 1, 4};
    std::vector<mesh::NodeTriangle> triangles;
    EXPECT_FALSE(mesh::cut_face({spiral.data(), 2, {}}, std::vector<Index>{0, 1, 2, 3, 4, 5}, triangles));
}

TEST(FaceCut, WhatIsFlat) {
    const std::vector<double> points{0, 0, 0, 1, 1, 1, 2, 2, 2, 2, 2, 3, 5, 5, -4, 0, 1, 0};
    const mesh::NumberedNodes nodes{points.data(), 3, {}};
    EXPECT_TRUE(mesh::on_one_line(nodes, std::vector<Index>{0, 0, 1, 2}));
    EXPECT_FALSE(mesh::on_one_line(nodes, std::vector<Index>{0, 1, 2, 3}));
    EXPECT_TRUE(mesh::are_flat(nodes, std::vector<Index>{0, 1, 2, 3, 4}));
    EXPECT_FALSE(mesh::are_flat(nodes, std::vector<Index>{0, 1, 3, 4, 5}));
}

}  // namespace
}  // namespace barycert::test
