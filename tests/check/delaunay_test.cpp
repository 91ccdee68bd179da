// Locally Delaunay or not: against circumcentres in rational numbers.
#include <gtest/gtest.h>

#include <gmpxx.h>

#include <cmath>
#include <optional>

#include "barycert/gmsh_files.hpp"
#include "barycert/mesh_files.hpp"
#include "barycert/plc_files.hpp"
#include "barycert/point_files.hpp"
#include "barycert/series.hpp"
#include "barycert/surface_files.hpp"
#include "barycert/table_files.hpp"
#include "barycert/tetgen_files.hpp"
#include "barycert/vtk_files.hpp"
#include "mesh/adjacency.hpp"
#include "tests/check/meshes.hpp"

namespace barycert::testing {
namespace {

using Q = mpq_class;
using Point = std::array<Q, 3>;

Point point(const Mesh& mesh, Mesh::Index node) {
    Point p{};
    const std::vector<double> at = node_at(mesh, node);
    for (std::size_t k = 0; k < at.size(); ++k) p[k] = at[k];
    return p;
}

Q squared_distance(const Point& a, const Point& b) {
    Q sum = 0;
    for (std::size_t k = 0; k < 3; ++k) sum += (a[k] - b[k]) * (a[k] - b[k]);
    return sum;
}

/// The centre has the same distance from all corners: d linear equations, by elimination. None for a degenerate cell.
std::optional<Point> circumcentre(const Mesh& mesh, std::size_t cell) {
    const auto d = static_cast<std::size_t>(mesh.dimension);
    const Mesh::Index* const corners = &mesh.cells[cell * mesh.corners()];
    const Point origin = point(mesh, corners[0]);
    std::vector<std::vector<Q>> rows(d, std::vector<Q>(d + 1));
    for (std::size_t i = 0; i < d; ++i) {
        const Point p = point(mesh, corners[i + 1]);
        for (std::size_t k = 0; k < d; ++k) {
            rows[i][k] = 2 * (p[k] - origin[k]);
            rows[i][d] += p[k] * p[k] - origin[k] * origin[k];
        }
    }
    for (std::size_t k = 0; k < d; ++k) {
        std::size_t pivot = k;
        while (pivot < d && rows[pivot][k] == 0) ++pivot;
        if (pivot == d) return std::nullopt;
        std::swap(rows[pivot], rows[k]);
        for (std::size_t i = 0; i < d; ++i) {
            if (i == k) continue;
            const Q factor = rows[i][k] / rows[k][k];
            for (std::size_t j = 0; j <= d; ++j) rows[i][j] -= factor * rows[k][j];
        }
    }
    Point centre{};
    for (std::size_t k = 0; k < d; ++k) centre[k] = rows[k][d] / rows[k][k];
    return centre;
}

DelaunayReport slow_delaunay(const Mesh& mesh) {
    DelaunayReport out;
    const std::vector<Mesh::Index> neighbours = mesh::compute_neighbours(mesh);
    for (std::size_t cell = 0; cell < mesh.cell_count(); ++cell) {
        const auto centre = circumcentre(mesh, cell);
        for (std::size_t i = 0; i < mesh.corners(); ++i) {
            const Mesh::Index other = neighbours[cell * mesh.corners() + i];
            if (other <= static_cast<Mesh::Index>(cell) || !centre) continue;
            const auto there = static_cast<std::size_t>(other) * mesh.corners();
            if (!circumcentre(mesh, static_cast<std::size_t>(other))) continue;
            Mesh::Index apex = -1;
            for (std::size_t j = 0; j < mesh.corners(); ++j) {
                if (neighbours[there + j] == static_cast<Mesh::Index>(cell)) apex = mesh.cells[there + j];
            }
            const Q radius = squared_distance(*centre, point(mesh, mesh.cells[cell * mesh.corners()]));
            const Q distance = squared_distance(*centre, point(mesh, apex));
            ++out.facets;
            if (distance == radius) ++out.cospherical;
            if (distance >= radius) continue;
            ++out.violations;
            out.worst_depth = std::max(out.worst_depth, 1 - std::sqrt(Q(distance / radius).get_d()));
            // Cells on opposite sides: the other sphere has this cell's apex in it.
            const auto other_centre = *circumcentre(mesh, static_cast<std::size_t>(other));
            const Q there_radius = squared_distance(other_centre, point(mesh, mesh.cells[there]));
            const Q there_distance = squared_distance(other_centre, point(mesh, mesh.cells[cell * mesh.corners() + i]));
            EXPECT_LT(there_distance, there_radius);
            out.worst_depth = std::max(out.worst_depth, 1 - std::sqrt(Q(there_distance / there_radius).get_d()));
        }
    }
    return out;
}

DelaunayReport delaunay(const Mesh& mesh, int threads = 1) {
    CheckOptions options;
    options.delaunay = true;
    options.threads = threads;
    options.contacts = 0;
    return check_mesh(mesh, options).delaunay.value();
}

void expect_same(const Mesh& mesh, std::uint64_t seed) {
    const DelaunayReport fast = delaunay(mesh), slow = slow_delaunay(mesh);
    EXPECT_EQ(fast.facets, slow.facets) << seed;
    EXPECT_EQ(fast.violations, slow.violations) << seed;
    EXPECT_EQ(fast.cospherical, slow.cospherical) << seed;
    EXPECT_NEAR(fast.worst_depth, slow.worst_depth, 1e-14) << seed;  // in radii, in plain double
    EXPECT_EQ(fast.worst_cell >= 0, slow.violations > 0) << seed;
}

TEST(Delaunay, LatticesAreCosphericalAndPushedOnesAreNot) {
    std::uint64_t violations = 0, cospherical = 0;
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        base::Random random = base::Random::stream(5, seed, 0);
        const int d = random.integer(2, 3);
        Mesh mesh = box(d, {2, 2, d == 2 ? 1 : 2});
        if (seed % 3 != 0) {
            const double push = seed % 3 == 1 ? 0.2 : 0x1p-52;  // far, and by an ulp
            for (double& x : mesh.points) x += push * random.integer(-1, 1);
        }
        flip_some(mesh, random);
        expect_same(mesh, seed);
        violations += delaunay(mesh).violations;
        cospherical += delaunay(mesh).cospherical;
    }
    EXPECT_GT(violations, 100U);
    EXPECT_GT(cospherical, 400U);
}

TEST(Delaunay, OfDataAndOnAnyNumberOfThreads) {
    const Mesh torus = read_tetgen(BARYCERT_DATA_DIR "/meshes/torus").value();
    expect_same(torus, 0);
    const Mesh plate = read_tetgen(BARYCERT_DATA_DIR "/meshes/plate").value();
    expect_same(plate, 0);
    const DelaunayReport one = delaunay(torus, 1), five = delaunay(torus, 5);
    EXPECT_EQ(one.violations, five.violations);
    EXPECT_EQ(one.worst_depth, five.worst_depth);
    EXPECT_EQ(one.worst_cell, five.worst_cell);
    EXPECT_EQ(one.worst_node, five.worst_node);
}

TEST(Delaunay, AtTheEndsOfTheRange) {
    base::Random random(3);
    Mesh mesh = box(3, {2, 2, 2});
    for (double& x : mesh.points) x += 0.25 * random.integer(-1, 1);
    const DelaunayReport plain = delaunay(mesh);
    ASSERT_GT(plain.violations, 0U);
    for (const double scale : {0x1p900, 0x1p-900, 0x1p-1060}) {
        const DelaunayReport scaled = delaunay(mapped(mesh, {scale, scale, scale}, {0, 0, 0}));
        EXPECT_EQ(scaled.violations, plain.violations) << scale;
        EXPECT_EQ(scaled.cospherical, plain.cospherical) << scale;
        EXPECT_NEAR(scaled.worst_depth, plain.worst_depth, 1e-9) << scale;
    }
}

// Cells on one side of a facet: either apex may be in the other's circle.
TEST(Delaunay, OfFoldedCellsDoesNotDependOnTheirOrder) {
    Mesh mesh;
    mesh.dimension = 2;
    mesh.points = {0, 0, 1, 0, 0.5, 0.2, 0.5, 2};
    mesh.cells = {0, 1, 2, 0, 1, 3};
    EXPECT_EQ(delaunay(mesh).violations, 1U);
    mesh.cells = {0, 1, 3, 0, 1, 2};
    EXPECT_EQ(delaunay(mesh).violations, 1U);
    // Four points of one circle: the facet counts once.
    mesh.points = {0, 0, 1, 0, 0, 1, 1, 1};
    mesh.cells = {0, 1, 2, 0, 1, 3};
    EXPECT_EQ(delaunay(mesh).cospherical, 1U);
    EXPECT_EQ(delaunay(mesh).violations, 0U);
}

// The deeper of both spheres, in whatever order the cells stand.
TEST(Delaunay, TheDepthIsTheDeeper) {
    Mesh mesh;
    mesh.dimension = 2;
    mesh.points = {0, 0, 4, 0, 2, 0.5, 2, -3};
    mesh.cells = {0, 1, 2, 0, 3, 1};
    const DelaunayReport one = delaunay(mesh);
    EXPECT_EQ(one.violations, 1U);
    mesh.cells = {0, 3, 1, 0, 1, 2};
    const DelaunayReport other = delaunay(mesh);
    EXPECT_EQ(one.worst_depth, other.worst_depth);
    EXPECT_EQ(one.worst_node, other.worst_node);
    expect_same(mesh, 0);
}

TEST(Delaunay, OnlyIfAskedAndNeverOfDegenerateCells) {
    const Mesh flat = mapped(box(3, {1, 1, 1}), {1, 1, 0}, {0, 0, 0});
    EXPECT_EQ(delaunay(flat).facets, 0U);
    EXPECT_FALSE(check_mesh(flat).delaunay);
}

}  // namespace
}  // namespace barycert::testing
