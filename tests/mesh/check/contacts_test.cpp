// Pairs that overlap or touch, and the points that prove it: as the judge has them.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "tests/mesh/check/judge.hpp"
#include "tests/mesh/check/meshes.hpp"
#include "tests/mesh/check/random_complexes.hpp"
#include "tests/mesh/check/signs.hpp"
#include "tests/sanitized.hpp"

namespace barycert::testing {
namespace {

using Q = second_path::Q;
using Vector = std::array<Q, 3>;

/// Weights of the point in the cell times its determinant: the least of them, taken so that inside is positive.
Q min_weight(const Mesh& mesh, Mesh::Index cell, const Vector& x) {
    const auto d = static_cast<std::size_t>(mesh.dimension);
    std::array<Vector, 4> p;
    for (std::size_t i = 0; i <= d; ++i) {
        const auto at = node_at(mesh, mesh.cells[static_cast<std::size_t>(cell) * (d + 1) + i]);
        for (std::size_t k = 0; k < d; ++k) p[i][k] = Q(at[k]);
    }
    const auto det = [&](const std::array<Vector, 4>& v) {
        std::array<Vector, 3> e;
        for (std::size_t i = 0; i < d; ++i) {
            for (std::size_t k = 0; k < d; ++k) e[i][k] = v[i + 1][k] - v[0][k];
        }
        if (d == 2) return Q(e[0][0] * e[1][1] - e[0][1] * e[1][0]);
        return Q(e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) - e[0][1] * (e[1][0] * e[2][2] - e[1][2] * e[2][0]) +
                 e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0]));
    };
    const Q whole = det(p);
    Q min(1);
    for (std::size_t i = 0; i <= d; ++i) {
        auto q = p;
        q[i] = x;
        const Q weight = det(q) / whole;
        min = std::min(min, weight);
    }
    return min;
}

struct Seen {
    std::size_t overlaps = 0, touches = 0, exact = 0;
    std::array<std::size_t, 4> dimensions{};
};

void expect_witness(const Mesh& mesh, const CellContact& c, Seen& seen) {
    const Meeting m = meeting(mesh, c.cells[0], c.cells[1]);
    ASSERT_EQ(c.dimension, m.dimension);
    ASSERT_EQ(c.overlap, m.dimension == mesh.dimension);
    ++seen.dimensions[static_cast<std::size_t>(m.dimension)];
    ++(c.overlap ? seen.overlaps : seen.touches);
    Vector x, rounded;
    for (std::size_t k = 0; k < static_cast<std::size_t>(mesh.dimension); ++k) {
        x[k] = Q(c.common.fraction[k]);
        x[k].canonicalize();
        rounded[k] = Q(c.common.point[k]);
        ASSERT_EQ(c.common.point[k], second_path::nearest(x[k]));
    }
    for (const Mesh::Index cell : c.cells) {
        const Q whole = min_weight(mesh, cell, x);
        ASSERT_TRUE(c.overlap ? whole > 0 : whole >= 0);
        if (c.common.exact) {
            const Q min = min_weight(mesh, cell, rounded);
            ASSERT_TRUE(c.overlap ? min > 0 : min >= 0);
        }
    }
    seen.exact += c.common.exact ? 1 : 0;
}

void compare(const Mesh& mesh, Seen& seen) {
    const CheckReport r = quick(mesh, 1000);
    std::vector<std::array<Mesh::Index, 2>> overlaps;
    for (const CellContact& c : r.contacts) {
        expect_witness(mesh, c, seen);
        ASSERT_LT(c.cells[0], c.cells[1]);
        if (c.overlap) overlaps.push_back(c.cells);
    }
    ASSERT_EQ(overlaps, judge(mesh).overlaps);
    ASSERT_EQ(r.contacts.empty(),
              r.find(DefectKind::boundary_contact) == nullptr && r.find(DefectKind::overlapping_cells) == nullptr);
}

TEST(Contacts, OfRandomMeshes) {
    for (const int d : {2, 3}) {
        Seen seen;
        for (std::uint64_t i = 0; i < 400 && !HasFatalFailure(); ++i) {
            base::Random random = base::Random::stream(31, static_cast<std::uint64_t>(d), i);
            Mesh mesh = i % 2 == 0 ? random_soup(d, random) : damaged_box(d, random);
            if (judge(mesh).degenerate > 0) continue;  // contacts of such cells have no witness
            if (i % 5 == 0) mesh = mapped(mesh, {0x1p-500, 0x1p400, 3}, {0, 0, 0});
            compare(mesh, seen);
        }
        EXPECT_GT(seen.overlaps, 100U);
        EXPECT_GT(seen.touches, 15U);
        EXPECT_GT(seen.exact, 100U);
        for (int k = 0; k <= d; ++k) EXPECT_GT(seen.dimensions[static_cast<std::size_t>(k)], 2U) << k;
    }
}

/// Coordinates over the whole range of doubles: any bits of a finite number below 2^1000.
Mesh extreme_soup(int d, std::size_t nodes, std::size_t cells, base::Random& random) {
    Mesh mesh;
    mesh.dimension = d;
    while (mesh.points.size() < nodes * static_cast<std::size_t>(d)) {
        const double x = std::bit_cast<double>(random.bits());
        if (std::abs(x) < 0x1p1000) mesh.points.push_back(x);
    }
    for (std::size_t c = 0; c < cells; ++c) {
        const auto first = static_cast<std::ptrdiff_t>(mesh.cells.size());
        while (mesh.cells.size() < mesh.corners() * (c + 1)) {
            const auto node = static_cast<Mesh::Index>(random.below(nodes));
            if (std::find(mesh.cells.begin() + first, mesh.cells.end(), node) == mesh.cells.end())
                mesh.cells.push_back(node);
        }
    }
    return mesh;
}

// Each fraction in lowest terms took a tenth of a second and more, a thousand of them minutes.
TEST(Contacts, OfExtremeCoordinates) {
    for (const int d : {2, 3}) {
        base::Random random = base::Random::stream(33, static_cast<std::uint64_t>(d), 0);
        const Mesh mesh = extreme_soup(d, 60, 300, random);
        const CheckReport r = quick(mesh, 300);
        ASSERT_EQ(r.contacts.size(), 300U);
        EXPECT_LT(r.seconds, 20 * testing::slowdown) << "2 s on one core of 2.5 GHz";
        Seen seen;
        for (std::size_t i = 0; i < r.contacts.size() && !HasFatalFailure(); i += 10)
            expect_witness(mesh, r.contacts[i], seen);
        EXPECT_GT(seen.exact, 2U) << d;
        EXPECT_LT(seen.exact, 30U) << d;
        for (const CellContact& c : r.contacts) {
            for (const std::string& text : c.common.fraction) {
                // Fractions of doubles have 2^1074 and more bits, 2 * 650 digits; others have degree 13 in 2100 bits, 2
                // * 8300 digits.
                EXPECT_LT(text.size(), c.common.exact ? 2500U : 17000U);
            }
        }
    }
}

// Cells thinner than doubles lie: a fraction is the only witness.
TEST(Contacts, NoDoubleBetween) {
    Mesh mesh;
    mesh.dimension = 2;
    const double next = std::nextafter(1.0, 2.0);
    mesh.points = {1, 0, next, 0, next, 1, 1, 1, 1, -1, next, 0.5};
    mesh.cells = {0, 1, 2, 3, 4, 5};
    const CheckReport r = quick(mesh, 5);
    ASSERT_EQ(r.contacts.size(), 1U);
    Seen seen;
    expect_witness(mesh, r.contacts[0], seen);
    EXPECT_TRUE(r.contacts[0].overlap);
    EXPECT_FALSE(r.contacts[0].common.exact);
}

TEST(Contacts, AsManyAsAsked) {
    const Mesh mesh = joined(box(2, {3, 3, 0}), mapped(box(2, {3, 3, 0}), {1, 1, 1}, {0.5, 0.25, 0}));
    EXPECT_EQ(quick(mesh, 0).contacts.size(), 0U);
    EXPECT_EQ(quick(mesh, 3).contacts.size(), 3U);
    const auto all = quick(mesh, 100000).contacts;
    EXPECT_GT(all.size(), 18U);
    EXPECT_TRUE(all.front().overlap);
}

}  // namespace
}  // namespace barycert::testing
