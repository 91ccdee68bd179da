// Facets cut into triangles: their area, their edges, and what is wrong with them.
#include "mesh/facets/facet_triangles.hpp"

#include <gmpxx.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <random>

namespace barycert::testing {
namespace {

using surface::FacetFault;
using surface::FacetTriangles;
using surface::triangles_of_facet;
using Rings = std::vector<std::vector<Mesh::Index>>;

/// Twice the area along z, of triangles that turn one way; exact.
mpq_class twice_area(const std::vector<double>& points, const FacetTriangles& cut) {
    mpq_class sum = 0;
    for (const auto& t : cut.triangles) {
        const auto x = [&](std::size_t i, std::size_t k) {
            return mpq_class(points[3 * static_cast<std::size_t>(t[i]) + k]);
        };
        const mpq_class one = (x(1, 0) - x(0, 0)) * (x(2, 1) - x(0, 1)) - (x(1, 1) - x(0, 1)) * (x(2, 0) - x(0, 0));
        EXPECT_GT(one, 0);
        sum += one;
    }
    return sum;
}

mpq_class twice_area(const std::vector<double>& points, const std::vector<Mesh::Index>& ring) {
    mpq_class sum = 0;
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const auto *const a = &points[3 * static_cast<std::size_t>(ring[i])],
                          *const b = &points[3 * static_cast<std::size_t>(ring[(i + 1) % ring.size()])];
        sum += mpq_class(a[0]) * b[1] - mpq_class(a[1]) * b[0];
    }
    return sum;
}

TEST(FacetTriangles, StarsOfAnyShape) {
    std::mt19937_64 random(1);
    for (int round = 0; round < 300; ++round) {
        // Star-shaped, so simple; on a lattice, so that many nodes lie on lines.
        const auto n = 4 + random() % 20;
        std::vector<double> points;
        std::vector<Mesh::Index> ring;
        for (std::size_t i = 0; i < n; ++i) {
            const double angle = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(n),
                         r = 3 + static_cast<double>(random() % 20);
            points.insert(points.end(), {std::round(8 * r * std::cos(angle)), std::round(8 * r * std::sin(angle)), 0});
            ring.push_back(static_cast<Mesh::Index>(i));
        }
        const FacetTriangles cut = triangles_of_facet(points, Rings{ring}, {});
        if (!cut.faults.empty()) continue;  // rounding may have put a node on a side
        EXPECT_EQ(twice_area(points, cut), twice_area(points, ring)) << round;
        EXPECT_EQ(cut.triangles.size(), n - 2) << round;
        // Each side is there once, in its direction; each other edge twice.
        std::map<std::pair<Mesh::Index, Mesh::Index>, int> edges;
        for (const auto& t : cut.triangles) {
            for (std::size_t k = 0; k < 3; ++k) ++edges[{t[k], t[(k + 1) % 3]}];
        }
        for (const auto& [edge, times] : edges) {
            EXPECT_EQ(times, 1);
            const bool side = (edge.first + 1) % static_cast<Mesh::Index>(n) == edge.second;
            EXPECT_EQ(edges.contains({edge.second, edge.first}), !side);
        }
        std::ranges::reverse(ring);
        const FacetTriangles back = triangles_of_facet(points, Rings{ring}, {});
        EXPECT_EQ(back.triangles.size(), n - 2);
        for (const auto& t : back.triangles) {
            const double* const a = &points[3 * static_cast<std::size_t>(t[0])];
            const double* const b = &points[3 * static_cast<std::size_t>(t[1])];
            const double* const c = &points[3 * static_cast<std::size_t>(t[2])];
            EXPECT_LT((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]), 0) << "turned as the polygon is";
        }
    }
}

TEST(FacetTriangles, HolesSegmentsAndPoints) {
    // A square of 10 with two holes, a segment from its side to a hole, a segment and a point within.
    const std::vector<double> points{0, 0, 0, 10, 0, 0, 10, 10, 0, 0, 10, 0, 2, 2, 0, 4, 2, 0, 4, 4, 0, 2, 4, 0,
                                     6, 6, 0, 8,  6, 0, 8,  8,  0, 6, 8,  0, 1, 8, 0, 3, 8, 0, 5, 5, 0, 5, 1, 0};
    const Rings rings{{0, 1, 2, 3}, {4, 5, 6, 7}, {8, 9, 10, 11}, {0, 4}, {12, 13}, {14}, {15}};
    const std::vector<double> holes{3, 3, 0, 7, 7, 0};
    const FacetTriangles cut = triangles_of_facet(points, rings, holes);
    EXPECT_TRUE(cut.faults.empty());
    EXPECT_EQ(twice_area(points, cut), 2 * (100 - 4 - 4));
    const auto has = [&](Mesh::Index a, Mesh::Index b) {
        return std::ranges::any_of(cut.triangles, [&](const auto& t) {
            return std::ranges::count(t, a) != 0 && std::ranges::count(t, b) != 0;
        });
    };
    EXPECT_TRUE(has(0, 4) && has(12, 13));
    EXPECT_TRUE(std::ranges::any_of(cut.triangles, [](const auto& t) { return std::ranges::count(t, 14) != 0; }));
    EXPECT_EQ(twice_area(points, triangles_of_facet(points, rings, {})), 200);  // without hole points rings only cut
}

TEST(FacetTriangles, Faults) {
    const std::vector<double> points{0, 0, 0, 4, 0, 0, 4, 4, 0, 0, 4, 0, 2, 0, 0, 2, 2, 5, 8, 0, 0};
    const auto kinds = [&](const Rings& rings) {
        std::vector<FacetFault::Kind> all;
        for (const FacetFault& f : triangles_of_facet(points, rings, {}).faults) all.push_back(f.kind);
        return all;
    };
    using Kind = FacetFault::Kind;
    EXPECT_EQ(kinds({{0, 2, 1, 3}}), std::vector{Kind::crossing});
    EXPECT_EQ(kinds({{0, 1, 4, 6}}), std::vector{Kind::flat});
    EXPECT_EQ(kinds({{0, 1, 2, 3}, {4}}), std::vector{Kind::on_segment});
    const FacetFault on = triangles_of_facet(points, Rings{{0, 1, 2, 3}, {4}}, {}).faults.at(0);
    EXPECT_EQ(on.nodes[0], 4);
    std::vector<double> folded = points;
    std::copy_n(points.begin() + 6, 2, folded.begin() + 15);  // above node 2
    EXPECT_EQ(triangles_of_facet(folded, Rings{{0, 1, 2, 3}, {5}}, {}).faults.at(0).kind, Kind::folded);
    EXPECT_TRUE(kinds({{0, 1}}).empty());
    EXPECT_TRUE(triangles_of_facet(points, Rings{{0, 1}}, {}).triangles.empty());
}

}  // namespace
}  // namespace barycert::testing
