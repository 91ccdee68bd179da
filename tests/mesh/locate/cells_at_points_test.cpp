// Cells that may hold points, against the box of every cell.
#include "mesh/locate/cells_at_points.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "barycert/environment.hpp"
#include "tests/mesh/check/meshes.hpp"
#include "tests/mesh/locate/points.hpp"

namespace barycert::testing {
namespace {

bool box_holds(const Mesh& mesh, std::size_t cell, const double* point) {
    const auto d = static_cast<std::size_t>(mesh.dimension);
    for (std::size_t k = 0; k < d; ++k) {
        bool below = false, above = false;
        for (std::size_t i = 0; i <= d; ++i) {
            const double x = mesh.points[d * static_cast<std::size_t>(mesh.cells[(d + 1) * cell + i]) + k];
            below |= x <= point[k];
            above |= x >= point[k];
        }
        if (!below || !above) return false;
    }
    return true;
}

/// Every cell whose box holds a point is found, on every target the same cells. Returns how many.
std::size_t expect_found(const Mesh& mesh, const std::vector<double>& points, const std::string& what) {
    const auto all = locate::cells_at_points(mesh, points, mesh.cell_count());
    EXPECT_TRUE(all) << what;
    if (!all) return 0;
    EXPECT_TRUE(std::is_sorted(all->begin(), all->end())) << what;
    for (const std::string& target : simd_targets()) {
        use_simd_target(target);
        EXPECT_EQ(locate::cells_at_points(mesh, points, mesh.cell_count()), all) << what << ' ' << target;
    }
    use_simd_target("");
    std::vector<bool> found(mesh.cell_count(), false);
    for (const Mesh::Index cell : *all) found.at(static_cast<std::size_t>(cell)) = true;
    const auto d = static_cast<std::size_t>(mesh.dimension);
    for (std::size_t cell = 0; cell < mesh.cell_count(); ++cell) {
        for (std::size_t i = 0; i < points.size() && !found[cell]; i += d)
            EXPECT_FALSE(box_holds(mesh, cell, points.data() + i)) << what << " cell " << cell;
    }
    return all->size();
}

Mesh shuffled(Mesh mesh, base::Random& random) {
    return renumbered(mesh, random);
}

TEST(CellsAtPoints, LawEveryCellWhoseBoxHoldsAPointIsFound) {
    base::Random random(71);
    for (const int d : {2, 3}) {
        for (const auto& [factor, shift] : std::vector<std::pair<double, double>>{
                 {1, 0}, {0x1p-1050, 0}, {0x1p1015, 0}, {0x1p-30, 1e6}, {0.1, -0.3}}) {
            const Mesh mesh =
                mapped(shuffled(box(d, {7, 6, 5}), random), {factor, factor, factor}, {shift, shift, shift});
            for (int round = 0; round < 8; ++round) {
                const std::vector<double> points = awkward_points(mesh, static_cast<std::size_t>(round + 1), random);
                const std::string what = std::to_string(d) + "D times " + std::to_string(factor);
                expect_found(mesh, points, what);
                // Few of them: their own box is smaller.
                const auto size = static_cast<std::size_t>(d);
                for (std::size_t i = 0; i + 3 * size <= points.size(); i += 7 * size) {
                    expect_found(mesh, {points.data() + i, points.data() + i + size}, what);
                    expect_found(mesh, {points.data() + i, points.data() + i + 3 * size}, what);
                }
            }
        }
    }
}

TEST(CellsAtPoints, MorePointsThanTheCoarserGridIsFor) {
    base::Random random(72);
    const Mesh mesh = shuffled(box(3, {9, 9, 9}), random);
    expect_found(mesh, inner_points(mesh, 3000, random), "many");
}

TEST(CellsAtPoints, FlatMeshesAndCellsOfVeryDifferentSize) {
    base::Random random(73);
    Mesh flat = mapped(box(3, {6, 6, 2}), {1, 1, 0}, {0, 0, 0.5});
    expect_found(flat, inner_points(flat, 20, random), "flat");
    expect_found(flat, {0.25, 0.5, 0.5, 3, 3, 0.5}, "flat");
    // One cell around all others.
    Mesh nested = box(3, {8, 8, 8});
    for (const auto& at : {std::array{-90., -90., -90.}, std::array{300., -90., -90.}, std::array{-90., 300., -90.},
                           std::array{-90., -90., 300.}})
        nested.cells.push_back(add_node(nested, {at[0], at[1], at[2]}));
    expect_found(nested, inner_points(nested, 10, random), "nested");
}

TEST(CellsAtPoints, FewOthersAre) {
    base::Random random(74);
    const Mesh mesh = shuffled(box(3, {24, 24, 24}), random);
    const std::size_t cells = mesh.cell_count();  // 82,944
    const std::size_t of_one = expect_found(mesh, {3.3, 4.4, 5.5}, "one");
    EXPECT_LE(of_one, 200U);
    const std::size_t spread = expect_found(mesh, inner_points(mesh, 20, random), "spread");
    EXPECT_LE(spread, cells / 20);
    // Close together, and most cells outside of their box.
    std::vector<double> near;
    for (int i = 0; i < 30; ++i) near.push_back(11.5 + 0.01 * random.uniform(0, 1));
    EXPECT_LE(expect_found(mesh, near, "near"), 200U);
}

TEST(CellsAtPoints, NothingIfThereAreTooManyOrACornerIsNoNode) {
    base::Random random(75);
    Mesh mesh = shuffled(box(3, {10, 10, 10}), random);
    const std::vector<double> points = inner_points(mesh, 50, random);
    const auto all = locate::cells_at_points(mesh, points, mesh.cell_count());
    ASSERT_TRUE(all);
    EXPECT_TRUE(locate::cells_at_points(mesh, points, all->size()));
    EXPECT_FALSE(locate::cells_at_points(mesh, points, all->size() - 1));
    for (const Mesh::Index wrong : {-1, static_cast<int>(mesh.point_count()), 0x7fffffff}) {
        for (const std::size_t at : {std::size_t{0}, mesh.cells.size() / 2, mesh.cells.size() - 1}) {
            Mesh bad = mesh;
            bad.cells[at] = wrong;
            for (const std::string& target : simd_targets()) {
                use_simd_target(target);
                EXPECT_FALSE(locate::cells_at_points(bad, points, mesh.cell_count())) << target;
            }
            use_simd_target("");
        }
    }
}

}  // namespace
}  // namespace barycert::testing
