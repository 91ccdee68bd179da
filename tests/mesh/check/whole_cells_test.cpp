// Cells of other shapes: repaired before they are cut, counted as the file has them, and told where they cannot be cut.
#include <gtest/gtest.h>

#include "barycert/certificate.hpp"
#include "barycert/check.hpp"
#include "barycert/check_results.hpp"
#include "barycert/defect.hpp"
#include "barycert/fix.hpp"
#include "barycert/measures.hpp"
#include "barycert/not_finite.hpp"
#include "barycert/plc.hpp"
#include "barycert/surface.hpp"
#include "barycert/surface_report.hpp"
#include "mesh/pulling.hpp"
#include "tests/mesh/shaped_mesh.hpp"

namespace barycert::testing {
namespace {

using Index = Mesh::Index;

/// Two hexahedra side by side, the second with a node of its own at the place of node 1.
Mesh hexahedra_apart(double warp) {
    Mesh mesh;
    mesh.points = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1, 1 + warp, 0, 1, 1, 1,
                   1, 0, 1, 1, 1, 0, 0, 2, 0, 0, 2, 1, 0, 2, 1, 1,        2, 0, 1};
    test::add_shape(mesh, 12, {0, 1, 2, 3, 4, 5, 6, 7});
    test::add_shape(mesh, 12, {8, 9, 10, 2, 5, 12, 11, 6});
    mesh.cell_fields.push_back({"T", 1, {10, 20}});
    EXPECT_FALSE(mesh::cut_into_simplices(mesh));
    return mesh;
}

TEST(WholeCellsCheck, NodesAreMergedBeforeCellsAreCut) {
    for (const double warp : {0.0, 0.125}) {
        const Mesh mesh = hexahedra_apart(warp);
        EXPECT_FALSE(check_mesh(mesh).certified());
        FixReport done;
        const Mesh fixed = fix_mesh(mesh, {}, done).value();
        const CheckReport report = check_mesh(fixed);
        EXPECT_TRUE(report.certified());
        EXPECT_EQ(report.parts, 1U);
        ASSERT_EQ(done.merged.size(), 1U);
        EXPECT_TRUE(done.dropped.empty());
        ASSERT_EQ(fixed.cell_fields[0].data.size(), fixed.cell_count());
        for (std::size_t cell = 0; cell < fixed.cell_count(); ++cell)
            EXPECT_EQ(fixed.cell_fields[0].data[cell], 10 * (1 + fixed.cell_number(static_cast<Index>(cell))));
    }
}

TEST(WholeCellsCheck, OverlapsAreOfCellsOfTheFile) {
    Mesh mesh;
    for (const double at : {0.0, 0.5}) {
        for (const double z : {0.0, 1.0}) {
            for (const auto& [x, y] : {std::pair(0.0, 0.0), {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}})
                mesh.points.insert(mesh.points.end(), {x + at, y + at, z + at});
        }
    }
    test::add_shape(mesh, 12, {0, 1, 2, 3, 4, 5, 6, 7});
    test::add_shape(mesh, 12, {8, 9, 10, 11, 12, 13, 14, 15});
    EXPECT_FALSE(mesh::cut_into_simplices(mesh));
    const CheckReport report = check_mesh(mesh);
    const Defect* const overlaps = report.find(DefectKind::overlapping_cells);
    ASSERT_NE(overlaps, nullptr);
    EXPECT_EQ(overlaps->count, 1U);
    EXPECT_EQ(overlaps->places.size(), 1U);
}

TEST(WholeCellsCheck, ACellThatCannotBeCutBreaksTheCertificate) {
    Mesh mesh;
    mesh.dimension = 2;
    mesh.points = {0, 0, 2, 0, 2, 2, 0, 2, 4, 0, 4, 2};
    test::add_shape(mesh, 9, {0, 1, 2, 3});
    test::add_shape(mesh, 9, {1, 5, 4, 2});  // a bow
    EXPECT_FALSE(mesh::cut_into_simplices(mesh));
    const CheckReport report = check_mesh(mesh);
    EXPECT_FALSE(report.certified());
    const Defect* const uncut = report.find(DefectKind::uncut_cell);
    ASSERT_NE(uncut, nullptr);
    EXPECT_EQ(uncut->count, 1U);
    EXPECT_EQ(report.cell_number(uncut->places[0].cells[0]), 1);
    EXPECT_EQ(report.find(DefectKind::repeated_node), nullptr);
    EXPECT_EQ(report.find(DefectKind::unused_node), nullptr);
    FixReport done;
    EXPECT_TRUE(check_mesh(fix_mesh(mesh, {}, done).value()).certified());
    ASSERT_EQ(done.dropped.size(), 1U);
    EXPECT_EQ(done.dropped[0].why, DefectKind::uncut_cell);
}

}  // namespace
}  // namespace barycert::testing
