// The nearest point of a mesh against exact rational numbers over all cells.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "barycert/gmsh_files.hpp"
#include "barycert/locator.hpp"
#include "barycert/mesh_files.hpp"
#include "barycert/plc_files.hpp"
#include "barycert/point_files.hpp"
#include "barycert/series.hpp"
#include "barycert/surface_files.hpp"
#include "barycert/table_files.hpp"
#include "barycert/tetgen_files.hpp"
#include "barycert/vtk_files.hpp"
#include "core/base/text.hpp"
#include "tests/limits.hpp"
#include "tests/mesh/check/meshes.hpp"
#include "tests/mesh/locate/judge.hpp"
#include "tests/mesh/locate/nearest_judge.hpp"
#include "tests/mesh/locate/points.hpp"

namespace barycert::testing {
namespace {

double root(const mpq_class& square) {
    return mpf_class(sqrt(mpf_class(square, 4000))).get_d();
}

/// One answer, but for its accuracy: a proper cell, nodes of it in order, the lowest cell that has these.
void expect_sound(const Mesh& mesh, const NearestJudge& judge, const Nearest& found, const std::string& what) {
    ASSERT_GE(found.cell, 0) << what;
    ASSERT_LT(static_cast<std::size_t>(found.cell), mesh.cell_count()) << what;
    std::vector<Mesh::Index> nodes;
    for (const Mesh::Index n : found.nodes) {
        if (n >= 0) nodes.push_back(n);
    }
    ASSERT_FALSE(nodes.empty()) << what;
    for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(found.nodes[i], i < nodes.size() ? nodes[i] : -1) << what;
    EXPECT_TRUE(std::is_sorted(nodes.begin(), nodes.end(), std::less_equal<>())) << what;
    EXPECT_LE(nodes.size(), static_cast<std::size_t>(mesh.dimension)) << what;
    const auto has = [&](std::size_t cell) {
        const auto first = mesh.cells.begin() + static_cast<std::ptrdiff_t>(cell * mesh.corners());
        return std::all_of(nodes.begin(), nodes.end(), [&](Mesh::Index n) {
            return std::find(first, first + mesh.dimension + 1, n) != first + mesh.dimension + 1;
        });
    };
    EXPECT_TRUE(has(static_cast<std::size_t>(found.cell))) << what;
    EXPECT_FALSE(judge.degenerate(found.cell)) << what;
    for (Mesh::Index c = 0; c < found.cell; ++c)
        EXPECT_FALSE(has(static_cast<std::size_t>(c)) && !judge.degenerate(c)) << what << ": cell " << c << " has it";
}

/// Distances in double come from differences of coordinates, so their errors are relative to the size of these: the
/// distance to the farthest corner of the cell.
double reach(const Mesh& mesh, Mesh::Index cell, const double* point) {
    double max = 0;
    const auto d = static_cast<std::size_t>(mesh.dimension);
    for (std::size_t i = 0; i <= d; ++i) {
        const auto node = static_cast<std::size_t>(mesh.cells[static_cast<std::size_t>(cell) * (d + 1) + i]);
        double sum = 0;
        for (std::size_t k = 0; k < d; ++k) sum = std::hypot(sum, mesh.points[d * node + k] - point[k]);
        max = std::max(max, sum);
    }
    return max;
}

/// Checks points outside. Distances, and how much farther the chosen cell and feature are than the nearest, are right
/// to eight roundings of the reach: differences, products and sums, divisions and roots follow each other no farther.
void expect_nearest(const Mesh& mesh, const std::vector<double>& points, const std::string& what) {
    const auto locator = Locator::build(mesh, {.prove = Prove::never});
    ASSERT_TRUE(locator) << what;
    const NearestJudge judge(mesh);
    const PointJudge holders(mesh);
    const auto d = static_cast<std::size_t>(mesh.dimension);
    std::size_t outside = 0;
    double worst = 0;
    for (std::size_t i = 0; i < points.size(); i += d) {
        const double* const p = points.data() + i;
        if (!holders.holders(p).empty()) continue;
        ++outside;
        const std::string where = what + " at " + text_of(p, mesh.dimension);
        const auto found = locator->nearest(p, infinity);
        ASSERT_TRUE(found) << where;
        expect_sound(mesh, judge, *found, where);
        if (::testing::Test::HasFatalFailure()) return;
        const TrueNearest truth = judge.nearest(p);
        const double tolerance = 8 * 0x1p-53 * reach(mesh, found->cell, p) + 0x1p-1074;
        const double true_distance = root(truth.square);
        worst = std::max(worst, std::abs(found->distance - true_distance) / reach(mesh, found->cell, p) * 0x1p53);
        ASSERT_NEAR(found->distance, true_distance, tolerance) << where;
        EXPECT_NEAR(root(judge.to_cell(p, found->cell)), true_distance, tolerance) << where << ": not the nearest cell";
        std::vector<Mesh::Index> nodes(found->nodes.begin(), found->nodes.end());
        std::erase(nodes, -1);
        EXPECT_NEAR(root(judge.to_hull(p, nodes)), true_distance, tolerance) << where << ": not the nearest feature";
    }
    EXPECT_GT(outside, 0U) << what;
    ::testing::Test::RecordProperty(what, std::to_string(worst));
}

/// Without the extremes: exact numbers of 2000 bits take their time.
std::vector<double> moderate(std::vector<double> points, double instead) {
    for (double& x : points) x = std::abs(x) < 1e20 ? x : instead;
    return points;
}

TEST(LocateNearest, OwnMeshes) {
    for (const char* stem : {"cube-hole", "bracket", "needle-slit", "plate", "torus"}) {
        base::Random random(base::hash64(stem));
        const Mesh mesh = own_mesh(stem);
        expect_nearest(mesh, moderate(awkward_points(mesh, 12, random), 7.3), stem);
    }
}

TEST(LocateNearest, AnyMagnitude) {
    for (const int d : {2, 3}) {
        for (const double factor : {1e-300, 1e300, 0x1p-1060, 1e6}) {
            base::Random random(3);
            const Mesh mesh = mapped(box(d, {3, 2, 2}), {factor, factor, factor}, {factor, -factor, 0});
            std::vector<double> points = awkward_points(mesh, 10, random);
            for (double& x : points) x = std::abs(x) < 10 * factor ? x : 7.3 * factor;
            expect_nearest(mesh, points, "factor " + base::hexadecimal(factor));
        }
    }
}

TEST(LocateNearest, InsideACavity) {
    for (const int d : {2, 3}) {
        std::vector<bool> keep(static_cast<std::size_t>(d == 2 ? 18 : 162), true);
        const std::size_t middle = d == 2 ? 4 : 13, each = d == 2 ? 2 : 6;
        for (std::size_t c = each * middle; c < each * (middle + 1); ++c) keep[c] = false;
        const Mesh mesh = only(box(d, {3, 3, 3}), keep);
        base::Random random(4);
        std::vector<double> points;
        for (int i = 0; i < 60 * d; ++i) points.push_back(random.uniform(1, 2));
        // The middle is as far from all sides: of those, the lowest cell's.
        for (int k = 0; k < d; ++k) points.push_back(1.5);
        expect_nearest(mesh, points, "cavity");
    }
}

// Thin cells askew to the axes: faces with hardly a normal.
TEST(LocateNearest, ThinCells) {
    for (const int d : {2, 3}) {
        for (const double thin : {1e-6, 1e-12, 1e-15}) {
            Mesh mesh = mapped(box(d, {4, d == 2 ? 1 : 3, 1}), {0.1, d == 2 ? thin : 0.1, thin}, {0.1, 0.3, 0.7});
            const auto n = static_cast<std::size_t>(d);
            for (std::size_t i = 0; i < mesh.points.size(); i += n) mesh.points[i + n - 1] += 0.3 * mesh.points[i];
            base::Random random(5);
            expect_nearest(mesh, moderate(awkward_points(mesh, 12, random), 7.3), "thin " + base::hexadecimal(thin));
        }
    }
}

TEST(LocateNearest, FarPoints) {
    for (const int d : {2, 3}) {
        base::Random random(6);
        const Mesh mesh = mapped(box(d, {2, 2, 2}), {0.1, 0.1, 0.1}, {0.3, -0.1, 0.2});
        std::vector<double> points;
        for (int i = 0; i < 12 * d; ++i) {
            static constexpr double some[]{1e15, -1e9, 0.35, 1e300, -1e300, 0.25 * max_double};
            points.push_back(some[random.below(std::size(some))]);
        }
        expect_nearest(mesh, points, "far points");
        const auto locator = Locator::build(mesh, {.prove = Prove::never});
        const std::array<double, 3> corner{max_double, -max_double, max_double};
        const auto found = locator->nearest(corner.data(), infinity);
        ASSERT_TRUE(found);
        EXPECT_GE(found->cell, 0);
        EXPECT_GE(found->distance, max_double);  // more than that, or infinity
    }
}

// L3: what is not there cannot be near.
TEST(LocateNearest, L3DegenerateCellsAreNeverChosen) {
    for (const int d : {2, 3}) {
        Mesh mesh = box(d, {2, 1, 1});
        const auto far = add_node(mesh, d == 2 ? std::vector<double>{9, 0.5} : std::vector<double>{9, 0.5, 0.5});
        std::vector<Mesh::Index> flat(mesh.corners(), far);
        flat[0] = 0;
        if (d == 3) flat[1] = 1;
        mesh.cells.insert(mesh.cells.begin(), flat.begin(), flat.end());
        base::Random random(7);
        std::vector<double> points = moderate(awkward_points(mesh, 15, random), 9);
        const std::vector<double> at = node_at(mesh, far);
        points.insert(points.end(), at.begin(), at.end());
        expect_nearest(mesh, points, "flat cells");
        Mesh only_flat = mesh;
        only_flat.cells = flat;
        const auto locator = Locator::build(only_flat, {.prove = Prove::never});
        ASSERT_TRUE(locator);
        const auto found = locator->nearest(points.data(), infinity);
        ASSERT_TRUE(found);
        EXPECT_EQ(found->cell, -1);
    }
}

TEST(LocateNearest, NoCell) {
    Mesh mesh;
    mesh.dimension = 2;
    const auto locator = Locator::build(mesh, {.prove = Prove::never});
    ASSERT_TRUE(locator);
    const std::array<double, 2> p{1, 2};
    const auto found = locator->nearest(p.data(), infinity);
    ASSERT_TRUE(found);
    EXPECT_EQ(found->cell, -1);
}

/// Points outside a mesh, some of them very near.
std::vector<double> outside_of(const Mesh& mesh, base::Random& random) {
    std::vector<double> points;
    const PointJudge holders(mesh);
    const auto d = static_cast<std::size_t>(mesh.dimension);
    const std::vector<double> all = moderate(awkward_points(mesh, 40, random), 1.7);
    for (std::size_t i = 0; i < all.size(); i += d) {
        const auto at = all.begin() + static_cast<std::ptrdiff_t>(i);
        if (holders.holders(&*at).empty()) points.insert(points.end(), at, at + mesh.dimension);
    }
    return points;
}

// A point as near as the limit counts: so it is found again with the distance that was reported as its limit.
TEST(LocateNearest, TheLimitIncludesItself) {
    for (const char* stem : {"cube-hole", "plate"}) {
        base::Random random(8);
        const Mesh mesh = own_mesh(stem);
        const auto locator = Locator::build(mesh, {.prove = Prove::never});
        const std::vector<double> points = outside_of(mesh, random);
        std::size_t lost = 0, beyond = 0;
        const auto d = static_cast<std::size_t>(mesh.dimension);
        for (std::size_t i = 0; i < points.size(); i += d) {
            const Nearest found = *locator->nearest(&points[i], infinity);
            lost += locator->nearest(&points[i], found.distance)->cell != found.cell ? 1 : 0;
            // Very near a slanted face the distance computed in double may be zero: there is no lower limit.
            if (found.distance == 0) continue;
            beyond += locator->nearest(&points[i], std::nextafter(found.distance, 0))->cell >= 0 ? 1 : 0;
        }
        EXPECT_EQ(lost, 0U) << stem << ": of " << points.size() / d;
        EXPECT_EQ(beyond, 0U) << stem << ": farther than the limit, of " << points.size() / d;
    }
}

TEST(LocateNearest, NothingIsNearerThanAllDistances) {
    const Mesh mesh = box(3, {1, 1, 1});
    const auto locator = Locator::build(mesh, {.prove = Prove::never});
    const std::array<double, 3> outside{-0.5, 0.25, 0.5};
    for (const double limit : {-1.0, -infinity, 0.0, 0.4999}) {
        const auto found = locator->nearest(outside.data(), limit);
        ASSERT_TRUE(found);
        EXPECT_EQ(found->cell, -1) << limit;
    }
    EXPECT_EQ(locator->nearest(outside.data(), 0.5)->distance, 0.5);
}

// Halves of the smallest subnormal are nothing: boxes of such cells have no width in them.
TEST(LocateNearest, OneOrTwoSubnormalsWide) {
    for (const int d : {2, 3}) {
        for (const int cubes : {1, 2}) {
            const Mesh mesh = mapped(box(d, {cubes, cubes, cubes}), {5e-324, 5e-324, 5e-324}, {});
            std::vector<double> points;
            for (int x = -4; x <= 5; ++x) {
                for (int y = -4; y <= 5; ++y) {
                    for (int z = -4; z <= (d == 2 ? -4 : 5); ++z) {
                        points.insert(points.end(), {5e-324 * x, 5e-324 * y});
                        if (d == 3) points.push_back(5e-324 * z);
                    }
                }
            }
            expect_nearest(mesh, points, "subnormals");
        }
    }
}

// Squares of such distances are zero in double.
TEST(LocateNearest, VeryNearIsNotZero) {
    const Mesh mesh = box(3, {1, 1, 1});
    const auto locator = Locator::build(mesh, {.prove = Prove::never});
    for (const double away : {1e-150, 1e-170, 1e-300, 5e-324}) {
        const std::array<double, 3> p{-away, 0.25, 0.5};
        EXPECT_EQ(locator->nearest(p.data(), infinity)->distance, away);
        EXPECT_EQ(locator->nearest(p.data(), 0)->cell, -1) << away;
    }
}

TEST(LocateNearest, CoordinatesThatAreNotFinite) {
    const Mesh mesh = box(3, {1, 1, 1});
    const auto locator = Locator::build(mesh, {.prove = Prove::never});
    for (const double bad : {infinity, -infinity, std::numeric_limits<double>::quiet_NaN()}) {
        const std::array<double, 3> p{0.5, bad, 0.5};
        EXPECT_FALSE(locator->nearest(p.data(), infinity));
    }
}

}  // namespace
}  // namespace barycert::testing
