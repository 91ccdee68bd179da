// N1, N2: the nearest point, exactly and from anywhere, and what it costs to find it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/text.hpp"
#include "mesh/locate/locator_data.hpp"
#include "mesh/locate/nearest.hpp"
#include "tests/limits.hpp"
#include "tests/mesh/check/meshes.hpp"
#include "tests/mesh/check/random_complexes.hpp"
#include "tests/mesh/locate/judge.hpp"
#include "tests/mesh/locate/nearest_judge.hpp"
#include "tests/mesh/locate/points.hpp"

namespace barycert::testing {
namespace {

/// Directions along axes, along diagonals, and any; each in turn one ulp off.
std::array<double, 3> direction(std::size_t i, base::Random& random) {
    std::array<double, 3> v{};
    for (double& x : v) {
        const double any = random.uniform(-1, 1), sign = random.below(2) == 0 ? -1 : 1;
        x = i % 4 == 0 ? 0 : i % 4 == 1 ? sign : i % 4 == 2 ? sign * static_cast<double>(random.below(3)) : any;
    }
    const std::size_t axis = random.below(3);
    if (v[axis] == 0) v[axis] = random.below(2) == 0 ? -1 : 1;
    return v;
}

/// From a place in or near the box of the mesh (a lattice point of it, or any), so many sizes away; never overflowing.
std::vector<double> far_points(const Mesh& mesh, double size, const std::vector<double>& sizes, base::Random& random) {
    std::vector<double> points;
    const auto d = static_cast<std::size_t>(mesh.dimension);
    for (const double away : sizes) {
        for (std::size_t i = 0; i < 8; ++i) {
            const std::array<double, 3> v = direction(i, random);
            const std::vector<double> from = node_at(mesh, static_cast<Mesh::Index>(random.below(mesh.point_count())));
            for (std::size_t k = 0; k < d; ++k) {
                const double off = i < 4 ? 0 : random.uniform(-1, 1);
                const double x = from[k] + size * off + v[k] * away * size;
                points.push_back(std::isfinite(x) ? x : std::copysign(std::numeric_limits<double>::max(), v[k]));
            }
        }
    }
    return points;
}

const std::vector<double>& all_sizes() {
    static const std::vector<double> sizes{0.1,  1,    10,   1e3,   1e7,   1e12,  1e14,  1e15,
                                           1e16, 1e17, 1e30, 1e100, 1e154, 1e200, 1e290, 1e300};
    return sizes;
}

std::size_t expect_exact(const Mesh& mesh, const std::vector<double>& points, const std::string& what) {
    const auto locator = Locator::build(mesh, {.prove = Prove::never});
    const NearestJudge judge(mesh);
    const PointJudge holders(mesh);
    const auto d = static_cast<std::size_t>(mesh.dimension);
    std::size_t asked = 0;
    for (std::size_t i = 0; i < points.size(); i += d) {
        const double* const p = &points[i];
        if (!holders.holders(p).empty()) continue;
        ++asked;
        const std::string where = what + " at " + text_of(p, mesh.dimension);
        const Nearest found = *locator->nearest(p, infinity);
        const TrueNearest truth = judge.nearest(p);
        if (truth.cells.empty()) {
            EXPECT_EQ(found.cell, -1) << where;
            continue;
        }
        EXPECT_EQ(found.cell, truth.cells.front()) << where;
        if (::testing::Test::HasFailure()) return asked;
        std::vector<Mesh::Index> nodes(found.nodes.begin(), found.nodes.end());
        std::erase(nodes, -1);
        EXPECT_TRUE(judge.to_hull(p, nodes) == truth.square) << where << ": the feature is farther or beyond the cell";
        EXPECT_LE(ulps_from_root(found.distance, truth.square), 0.5 + 0x1p-40) << where;
    }
    return asked;
}

TEST(LocateNearest, N1ExactlyFromAnywhere) {
    for (const int d : {2, 3}) {
        for (const double size : {1.0, 0.1, 1e-300, 1e-150, 0x1p-1060, 1e290}) {
            base::Random random = base::Random::stream(71, static_cast<std::uint64_t>(d), 0);
            const Mesh lattice = mapped(box(d, {2, 2, 1}), {size, size, size}, {size, -size, 0});
            Mesh askew = lattice;
            for (double& x : askew.points) x += size * random.uniform(-0.2, 0.2);
            for (const Mesh& mesh : {lattice, askew}) {
                const std::vector<double> points = far_points(mesh, size, all_sizes(), random);
                EXPECT_GT(expect_exact(mesh, points, "size " + base::hexadecimal(size)), 50U);
            }
        }
    }
}

// Overlapping, degenerate, of any orientation; nodes of different numbers at one place, where points tie.
TEST(LocateNearest, N1ExactlyOnAnyMesh) {
    std::size_t asked = 0;
    for (const int d : {2, 3}) {
        for (std::uint64_t i = 0; i < 25 && !HasFailure(); ++i) {
            base::Random random = base::Random::stream(72, static_cast<std::uint64_t>(d), i);
            Mesh mesh = i % 2 == 0 ? random_soup(d, random) : damaged_box(d, random);
            if (i % 5 == 0) mesh = joined(mesh, mesh);
            asked += expect_exact(mesh, far_points(mesh, 1, {0.1, 1, 1e5, 1e15, 1e40, 1e300}, random), "soup");
        }
    }
    EXPECT_GT(asked, 500U);
}

// A cell and its mirror image, of which one number is an ulp away; points between them, in the mirror.
TEST(LocateNearest, N1ExactlyWhereAnUlpDecides) {
    std::size_t asked = 0;
    for (const int d : {2, 3}) {
        for (std::uint64_t i = 0; i < 1500 && !HasFailure(); ++i) {
            base::Random random = base::Random::stream(74, static_cast<std::uint64_t>(d), i);
            const auto k = static_cast<std::size_t>(d);
            const Mesh::Index corners = d + 1;
            Mesh mesh;
            mesh.dimension = d;
            for (const double side : {1, -1}) {
                base::Random same = base::Random::stream(75, static_cast<std::uint64_t>(d), i);
                for (std::size_t n = 0; n < (k + 1) * k; ++n)
                    mesh.points.push_back((n % k == 0 ? side : 1) * same.uniform(1, 2));
            }
            for (Mesh::Index n = 0; n < 2 * corners; ++n) mesh.cells.push_back(n);
            double& moved = mesh.points[random.below(mesh.points.size())];
            moved = std::nextafter(moved, random.coin() ? infinity : -infinity);
            std::vector<double> points;
            for (std::size_t n = 0; n < 4 * k; ++n) points.push_back(n % k == 0 ? 0 : random.uniform(0.8, 2.2));
            asked += expect_exact(mesh, points, "mirror " + std::to_string(i));
        }
    }
    EXPECT_EQ(asked, 12000U);
}

// Cells almost flat, whose faces have hardly a normal.
TEST(LocateNearest, N1ExactlyOnThinCells) {
    for (const int d : {2, 3}) {
        for (const double thin : {1e-8, 1e-16, 1e-150, 1e-300}) {
            base::Random random = base::Random::stream(73, static_cast<std::uint64_t>(d), 0);
            const std::array<double, 3> factor{1, d == 2 ? thin : 1, thin};
            const Mesh flat = mapped(box(d, {2, d == 2 ? 1 : 2, 1}), factor, {});
            expect_exact(flat, far_points(flat, 1, all_sizes(), random), "flat " + base::hexadecimal(thin));
            expect_exact(flat, far_points(flat, thin, {0.5, 3, 1e4}, random), "near flat " + base::hexadecimal(thin));
        }
    }
}

TEST(LocateNearest, N1InsideACellIsThatPoint) {
    for (const int d : {2, 3}) {
        const Mesh mesh = box(d, {2, 2, 2});
        const auto locator = Locator::build(mesh, {.prove = Prove::never});
        const std::array<double, 3> p{0.75, 0.25, 0.125};
        const Nearest found = *locator->nearest(p.data(), infinity);
        EXPECT_EQ(found.distance, 0);
        EXPECT_EQ(found.cell, locator->locate(p.data())->cell);
        EXPECT_EQ(found.nodes, (std::array<Mesh::Index, 3>{-1, -1, -1}));
    }
}

/// Boxes and cells looked at for the dearest of some points in one direction, so many sizes away.
std::uint64_t work_at(const Locator& locator, double away, std::size_t kind) {
    base::Random random = base::Random::stream(74, kind, 0);
    const auto d = static_cast<std::size_t>(locator.mesh().dimension);
    std::uint64_t max = 0;
    for (int i = 0; i < 20; ++i) {
        const std::array<double, 3> v = direction(kind, random);
        std::array<double, 3> p{};
        for (std::size_t k = 0; k < d; ++k) p[k] = 16 * (random.unit() + v[k] * away);
        locate::NearestWork work;
        const Nearest found = locate::find_nearest(locate::LocatorData::of(locator), p.data(), infinity, &work);
        EXPECT_GE(found.cell, 0);
        max = std::max(max, work.boxes + work.cells + 10 * work.exact);
        EXPECT_LE(work.comparisons, 64U) << away;  // where the lattice ties exactly
    }
    return max;
}

// N2: the number of boxes and cells does not grow with the distance.
TEST(LocateNearest, N2FarPointsCostNoMore) {
    for (const int d : {2, 3}) {
        Mesh mesh = d == 2 ? box(2, {64, 64, 0}) : box(3, {16, 16, 16});
        const double factor = d == 2 ? 0.25 : 1;
        mesh = mapped(mesh, {factor, factor, factor}, {});
        Mesh askew = mesh;
        base::Random random(75);
        for (double& x : askew.points) x += factor * random.uniform(-0.1, 0.1);
        for (const Mesh& m : {mesh, askew}) {
            const auto locator = Locator::build(m, {.prove = Prove::never});
            for (const std::size_t kind : {0U, 1U, 2U, 3U}) {
                const std::uint64_t near = work_at(*locator, 10, kind);
                for (const double away : {1e3, 1e9, 1e12, 1e14, 1e16, 1e20, 1e100, 1e200, 1e300})
                    EXPECT_LE(work_at(*locator, away, kind), 2 * near) << d << " " << kind << " " << away;
                RecordProperty("work", std::to_string(near));
            }
        }
    }
}

// Within a limit far below the distance nothing but the box of the mesh is looked at.
TEST(LocateNearest, N2BeyondTheLimit) {
    const Mesh mesh = box(3, {8, 8, 8});
    const auto locator = Locator::build(mesh, {.prove = Prove::never});
    for (const double away : {1e2, 1e15, 1e300}) {
        const std::array<double, 3> p{away, 4, -away};
        locate::NearestWork work;
        EXPECT_EQ(locate::find_nearest(locate::LocatorData::of(*locator), p.data(), away / 2, &work).cell, -1);
        EXPECT_LE(work.boxes, 1U);
    }
}

// A distance that no double holds is infinite: beyond every finite limit, within an infinite one.
TEST(LocateNearest, DistancesThatOverflow) {
    const Mesh mesh = mapped(box(2, {1, 1, 0}), {1e300, 1e300, 1}, {-max_double, -max_double, 0});
    const auto locator = Locator::build(mesh, {.prove = Prove::never});
    const std::array<double, 2> p{max_double, max_double};
    const Nearest found = *locator->nearest(p.data(), infinity);
    EXPECT_GE(found.cell, 0);
    EXPECT_EQ(found.distance, infinity);
    EXPECT_EQ(locator->nearest(p.data(), max_double)->cell, -1);
}

}  // namespace
}  // namespace barycert::testing
