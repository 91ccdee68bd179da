// FindCell against the oracle: owners, weights, and what else it sets.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <thread>
#include <vector>

#include <vtkCellType.h>
#include <vtkGenericCell.h>
#include <vtkNew.h>

#include "barycert/oracle.hpp"
#include "tests/mesh/check/meshes.hpp"
#include "tests/mesh/locate/judge.hpp"
#include "tests/mesh/locate/points.hpp"
#include "tests/vtk/grids.hpp"
#include "vtkBarycertLocator.h"

namespace barycert::testing {
namespace {

struct Found {
    vtkIdType cell = -1;
    std::array<double, 3> pcoords{};
    std::array<double, 4> weights{};
    friend bool operator==(const Found&, const Found&) = default;
};

Found find(vtkBarycertLocator* locator, double* x, vtkGenericCell* cell) {
    Found found;
    found.cell = locator->FindCell(x, 0, cell, found.pcoords.data(), found.weights.data());
    return found;
}

// Every owner is the lowest cell that the oracle finds, and every weight the oracle's.
void expect_exact_cells(const Mesh& mesh, vtkDataSet* data, int normal, double plane, std::size_t of_each) {
    vtkNew<vtkBarycertLocator> locator;
    locator->SetDataSet(data);
    locator->BuildLocator();
    ASSERT_TRUE(locator->GetExact()) << locator->GetReason();
    const PointJudge judge(mesh);
    base::Random random(7);
    const std::vector<double> points = awkward_points(mesh, of_each, random);
    const auto d = static_cast<std::size_t>(mesh.dimension);
    vtkNew<vtkGenericCell> cell;
    int inside = 0;
    for (std::size_t i = 0; i < points.size(); i += d) {
        double x[3] = {plane, plane, plane};
        std::size_t axis = 0;
        for (int a = 0; a < 3; ++a)
            if (d == 3 || a != normal) x[a] = points[i + axis++];
        const std::vector<Held> holders = judge.holders(points.data() + i);
        const vtkIdType expected = holders.empty() ? -1 : holders.front().cell;
        const Found found = find(locator, x, cell);
        ASSERT_EQ(found.cell, expected) << text_of(points.data() + i, mesh.dimension);
        ASSERT_EQ(locator->FindCell(x), expected);
        if (expected < 0) continue;
        ++inside;
        const OracleAnswer answer = ask_oracle(case_of(mesh, holders.front().cell, points.data() + i));
        for (std::size_t k = 0; k < mesh.corners(); ++k) {
            ASSERT_EQ(found.weights[k], answer.weights[k]) << text_of(points.data() + i, mesh.dimension);
            ASSERT_EQ(cell->GetPointId(static_cast<int>(k)),
                      mesh.cells[mesh.corners() * static_cast<std::size_t>(expected) + k]);
        }
        for (std::size_t k = 0; k < 3; ++k)
            ASSERT_EQ(found.pcoords[k], k + 1 < mesh.corners() ? found.weights[k + 1] : 0);
        ASSERT_EQ(cell->GetCellType(), d == 3 ? VTK_TETRA : VTK_TRIANGLE);
    }
    EXPECT_GT(inside, 100);
}

TEST(FindCell, IsTheLowestExactOwner) {
    for (const char* const name : {"cube-hole", "flange", "lattice-box", "needle-slit", "torus"}) {
        SCOPED_TRACE(name);
        const Mesh mesh = own_mesh(name);
        expect_exact_cells(mesh, grid_of(mesh), -1, 0, 40);
    }
}

TEST(FindCell, IsExactOnTrianglesInAPlaneAcrossAnyAxis) {
    const Mesh mesh = own_mesh("plate");
    ASSERT_EQ(mesh.dimension, 2);
    expect_exact_cells(mesh, grid_of(mesh, 0.1), 2, 0.1, 40);
    for (int normal = 0; normal < 3; ++normal) {
        SCOPED_TRACE(normal);
        expect_exact_cells(mesh, surface_of(mesh, normal, -0.7), normal, -0.7, 40);
    }
}

TEST(FindCell, FindsNothingOffThePlane) {
    const Mesh mesh = box(2, {2, 2, 0});
    vtkNew<vtkBarycertLocator> locator;
    const auto grid = grid_of(mesh, 1);
    locator->SetDataSet(grid);
    double on[3] = {0.5, 0.25, 1}, off[3] = {0.5, 0.25, 1 + 0x1p-52}, bad[3] = {0.5, 0.25, std::nan("")};
    EXPECT_GE(locator->FindCell(on), 0);
    EXPECT_EQ(locator->FindCell(off), -1);
    EXPECT_EQ(locator->FindCell(bad), -1);
}

TEST(FindCell, IsTheSameFromManyThreads) {
    const Mesh mesh = own_mesh("flange");
    const auto grid = grid_of(mesh);
    base::Random random(3);
    const std::vector<double> points = awkward_points(mesh, 200, random);
    const std::size_t count = points.size() / 3;
    vtkNew<vtkBarycertLocator> serial;
    serial->SetDataSet(grid);
    std::vector<Found> expected(count);
    vtkNew<vtkGenericCell> cell;
    for (std::size_t i = 0; i < count; ++i) {
        std::array<double, 3> x{points[3 * i], points[3 * i + 1], points[3 * i + 2]};
        expected[i] = find(serial, x.data(), cell);
    }
    // Not built: the threads meet at the first query.
    vtkNew<vtkBarycertLocator> shared;
    shared->SetDataSet(grid);
    std::vector<std::thread> threads;
    std::vector<int> wrong(4);
    for (std::size_t t = 0; t < wrong.size(); ++t) {
        threads.emplace_back([&, t] {
            vtkNew<vtkGenericCell> own;
            for (std::size_t k = 0; k < count; ++k) {
                const std::size_t i = t % 2 == 0 ? k : count - 1 - k;
                std::array<double, 3> x{points[3 * i], points[3 * i + 1], points[3 * i + 2]};
                wrong[t] += find(shared, x.data(), own) == expected[i] ? 0 : 1;
            }
        });
    }
    for (std::thread& thread : threads) thread.join();
    EXPECT_EQ(wrong, std::vector<int>(4));
}

}  // namespace
}  // namespace barycert::testing
