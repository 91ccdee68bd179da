// vtkBarycertCheck: marks of cells against a slow judge, measures against check_mesh, findings with ids of the data
// set.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkStringArray.h>
#include <vtkTable.h>
#include <vtkUnsignedCharArray.h>

#include "tests/mesh/check/judge.hpp"
#include "tests/mesh/check/meshes.hpp"
#include "tests/vtk/grids.hpp"
#include "tests/vtk/mixed_grids.hpp"
#include "vtkBarycertCheck.h"

namespace barycert::testing {
namespace {

vtkDataArray* cell_array(vtkDataSet* data, const std::string& name) {
    return data->GetCellData()->GetArray(name.c_str());
}

std::set<vtkIdType> marked(vtkDataSet* data, const char* name) {
    std::set<vtkIdType> cells;
    vtkDataArray* const array = cell_array(data, name);
    for (vtkIdType i = 0; array != nullptr && i < array->GetNumberOfTuples(); ++i)
        if (array->GetTuple1(i) != 0) cells.insert(i);
    return cells;
}

std::string text(vtkTable* table, vtkIdType row, const char* column) {
    return table->GetValueByName(row, column).ToString();
}

// The row of a defect, -1 if it was not found.
vtkIdType row_of(vtkTable* table, const std::string& defect) {
    for (vtkIdType row = 0; row < table->GetNumberOfRows(); ++row)
        if (text(table, row, "defect") == defect) return row;
    return -1;
}

bool same(double a, double b) {
    return a == b || (std::isnan(a) && std::isnan(b));
}

// Cells shift, ..., of the data set are those of the mesh.
void expect_measures(const Mesh& mesh, vtkDataSet* out, vtkIdType shift = 0) {
    for (const Field& field : measure_fields(quick(mesh).measures)) {
        vtkDataArray* const array = cell_array(out, field.name);
        ASSERT_NE(array, nullptr) << field.name;
        for (std::size_t i = 0; i < mesh.cell_count(); ++i)
            ASSERT_TRUE(same(array->GetTuple1(static_cast<vtkIdType>(i) + shift), field.data[i])) << field.name;
    }
}

// Two boxes, one a little into the other, and a flat cell: overlaps that a judge counts.
Mesh broken() {
    Mesh mesh = joined(box(3, {2, 1, 1}), mapped(box(3, {1, 1, 1}), {1, 1, 1}, {1.75, 0.25, 0.125}));
    mesh.cells.insert(mesh.cells.end(), {0, 1, 3, 4});
    const Mesh::Index flat = add_node(mesh, {0.5, 0, 0});
    mesh.cells.back() = flat;
    return mesh;
}

// A point in the boxes of both cells for each pair that overlaps; cells shift, ..., of the data set are those of the
// mesh.
void expect_common_points(vtkBarycertCheck* check, const Judgement& judgement, vtkIdType shift) {
    vtkPolyData* const points = check->GetCommonPoints();
    std::set<std::pair<vtkIdType, vtkIdType>> pairs, expected;
    for (const auto& pair : judgement.overlaps) expected.insert({pair[0] + shift, pair[1] + shift});
    vtkDataArray* const a = points->GetPointData()->GetArray("cell_a");
    vtkDataArray* const b = points->GetPointData()->GetArray("cell_b");
    vtkDataArray* const overlap = points->GetPointData()->GetArray("overlap");
    for (vtkIdType i = 0; i < points->GetNumberOfPoints(); ++i) {
        if (overlap->GetTuple1(i) == 0) continue;
        pairs.insert({static_cast<vtkIdType>(a->GetTuple1(i)), static_cast<vtkIdType>(b->GetTuple1(i))});
        for (vtkDataArray* const cells : {a, b}) {
            double bounds[6];
            check->GetOutput()->GetCellBounds(static_cast<vtkIdType>(cells->GetTuple1(i)), bounds);
            for (int axis = 0; axis < 3; ++axis) {
                EXPECT_GE(points->GetPoint(i)[axis], bounds[2 * axis]);
                EXPECT_LE(points->GetPoint(i)[axis], bounds[2 * axis + 1]);
            }
        }
    }
    EXPECT_EQ(pairs, expected);
}

TEST(Check, CertifiesWithMeasures) {
    for (const char* const name : {"cube-hole", "lattice-box"}) {
        const Mesh mesh = own_mesh(name);
        vtkNew<vtkBarycertCheck> check;
        check->SetInputData(grid_of(mesh));
        check->Update();
        EXPECT_TRUE(check->GetCertified());
        vtkDataSet* const out = check->GetOutput();
        expect_measures(mesh, out);
        EXPECT_EQ(out->GetFieldData()->GetArray("certified")->GetTuple1(0), 1);
        auto* const report = vtkStringArray::SafeDownCast(out->GetFieldData()->GetAbstractArray("barycert_check"));
        ASSERT_NE(report, nullptr);
        EXPECT_EQ(report->GetValue(0).find("input: certified: "), 0U) << report->GetValue(0);
        EXPECT_EQ(check->GetDefects()->GetNumberOfRows(), 0);
        EXPECT_EQ(check->GetCommonPoints()->GetNumberOfPoints(), 0);
        EXPECT_EQ(cell_array(out, "overlapping_cells"), nullptr);
        EXPECT_EQ(out->GetPointData()->GetNumberOfArrays(), static_cast<int>(mesh.point_fields.size()));
    }
}

TEST(Check, MarksTheCellsThatAJudgeFinds) {
    const Mesh mesh = broken();
    Messages messages;
    vtkNew<vtkBarycertCheck> check;
    check->SetInputData(grid_of(mesh));
    check->SetContacts(100);
    check->Update();
    EXPECT_EQ(messages.count("input: NOT certified: "), 1) << messages.all();
    EXPECT_FALSE(check->GetCertified());
    vtkDataSet* const out = check->GetOutput();
    expect_measures(mesh, out);
    std::set<vtkIdType> overlapping;
    const Judgement judgement = judge(mesh);
    ASSERT_FALSE(judgement.overlaps.empty());
    for (const auto& pair : judgement.overlaps) overlapping.insert(pair.begin(), pair.end());
    EXPECT_EQ(marked(out, "overlapping_cells"), overlapping);
    EXPECT_EQ(marked(out, "degenerate_cell"), (std::set<vtkIdType>{static_cast<vtkIdType>(mesh.cell_count()) - 1}));

    vtkTable* const defects = check->GetDefects();
    const vtkIdType row = row_of(defects, "overlapping_cells");
    ASSERT_GE(row, 0);
    EXPECT_EQ(text(defects, row, "count"), std::to_string(judgement.overlaps.size()));
    EXPECT_EQ(text(defects, row, "breaks"), "1");
    EXPECT_EQ(text(defects, row, "meaning"), "pairs of cells whose interiors meet");
    EXPECT_NE(text(defects, row, "remedy"), "");
    const vtkIdType flat = row_of(defects, "degenerate_cell");
    ASSERT_GE(flat, 0);
    EXPECT_EQ(text(defects, flat, "places").find("cell " + std::to_string(mesh.cell_count() - 1)), 0U);

    expect_common_points(check, judgement, 0);
}

TEST(Check, LeavesOtherCellsOutAndKeepsIds) {
    const Mesh mesh = broken();
    const auto whole = grid_of(mesh);
    vtkNew<vtkUnstructuredGrid> grid;
    grid->SetPoints(whole->GetPoints());
    const vtkIdType nodes[3] = {0, 1, 2};
    grid->InsertNextCell(VTK_VERTEX, 1, nodes);
    grid->InsertNextCell(VTK_TRIANGLE, 3, nodes);
    vtkNew<vtkUnsignedCharArray> ghosts;
    ghosts->SetName("vtkGhostType");
    vtkNew<vtkIdList> cell;
    whole->GetCellPoints(0, cell);
    grid->InsertNextCell(VTK_TETRA, cell);  // a duplicate, but for its mark
    for (vtkIdType i = 0; i < whole->GetNumberOfCells(); ++i) {
        whole->GetCellPoints(i, cell);
        grid->InsertNextCell(VTK_TETRA, cell);
    }
    for (vtkIdType i = 0; i < grid->GetNumberOfCells(); ++i)
        ghosts->InsertNextValue(i == 2 ? vtkDataSetAttributes::DUPLICATECELL : 0);
    grid->GetCellData()->AddArray(ghosts);
    Messages messages;
    vtkNew<vtkBarycertCheck> check;
    check->SetInputData(grid);
    check->SetContacts(100);
    check->Update();
    vtkDataSet* const out = check->GetOutput();
    expect_measures(mesh, out, 3);
    expect_common_points(check, judge(mesh), 3);
    for (vtkIdType i = 0; i < 3; ++i) {
        EXPECT_TRUE(std::isnan(cell_array(out, "volume")->GetTuple1(i)));
        EXPECT_EQ(cell_array(out, "orientation")->GetTuple1(i), 0);
        EXPECT_EQ(cell_array(out, "problems")->GetTuple1(i), 0);
    }
    EXPECT_EQ(row_of(check->GetDefects(), "duplicate_cell"), -1);
    const vtkIdType flat = row_of(check->GetDefects(), "degenerate_cell");
    ASSERT_GE(flat, 0);
    EXPECT_EQ(text(check->GetDefects(), flat, "places").find("cell " + std::to_string(mesh.cell_count() + 2)), 0U);
}

TEST(Check, TakesTrianglesInAnyPlane) {
    Mesh mesh = joined(box(2, {2, 2, 0}), mapped(box(2, {1, 1, 0}), {1, 1, 1}, {1.5, 0.25, 0}));
    Messages messages;
    for (const int normal : {0, 1, 2}) {
        vtkNew<vtkBarycertCheck> check;
        check->SetInputData(surface_of(mesh, normal, 7));
        check->Update();
        EXPECT_FALSE(check->GetCertified());
        expect_measures(mesh, check->GetOutput());
        ASSERT_GT(check->GetCommonPoints()->GetNumberOfPoints(), 0);
        for (vtkIdType i = 0; i < check->GetCommonPoints()->GetNumberOfPoints(); ++i)
            EXPECT_EQ(check->GetCommonPoints()->GetPoint(i)[normal], 7);
    }
}

TEST(Check, TakesCellsOfSecondOrder) {
    const Mesh mesh = own_mesh("cube-hole-o2");
    const auto nodes = grid_of(mesh);
    vtkNew<vtkUnstructuredGrid> grid;
    grid->SetPoints(nodes->GetPoints());
    for (std::size_t i = 0; i < mesh.cell_count(); ++i) {
        std::vector<vtkIdType> cell(mesh.cells.begin() + static_cast<std::ptrdiff_t>(4 * i),
                                    mesh.cells.begin() + static_cast<std::ptrdiff_t>(4 * i + 4));
        for (std::size_t k = 0; k < 6; ++k) cell.push_back(mesh.mid_nodes[6 * i + k]);
        grid->InsertNextCell(VTK_QUADRATIC_TETRA, 10, cell.data());
    }
    vtkNew<vtkIdList> first;
    grid->GetCellPoints(0, first);
    grid->InsertNextCell(VTK_QUADRATIC_TETRA, first);  // a duplicate, but for its mark
    vtkNew<vtkUnsignedCharArray> ghosts;
    ghosts->SetName("vtkGhostType");
    for (vtkIdType i = 0; i < grid->GetNumberOfCells(); ++i)
        ghosts->InsertNextValue(i + 1 == grid->GetNumberOfCells() ? vtkDataSetAttributes::DUPLICATECELL : 0);
    grid->GetCellData()->AddArray(ghosts);
    vtkNew<vtkBarycertCheck> check;
    check->SetInputData(grid);
    check->Update();
    EXPECT_TRUE(check->GetCertified());
    expect_measures(mesh, check->GetOutput());
    EXPECT_EQ(row_of(check->GetDefects(), "unused_node"), -1);
    // A node off the middle of its edge: told, and the report begins with it.
    std::array<double, 3> middle{};
    grid->GetPoint(mesh.mid_nodes[0], middle.data());
    grid->GetPoints()->SetPoint(mesh.mid_nodes[0], middle[0] + 0.001, middle[1], middle[2]);
    {
        Messages curved;
        grid->GetPoints()->Modified();
        check->Modified();
        check->Update();
        EXPECT_EQ(curved.count("curved: mid-edge nodes lie up to"), 1) << curved.all();
        EXPECT_EQ(curved.count("NOT certified"), 0) << curved.all();
        EXPECT_TRUE(check->GetCertified());
    }
    const vtkIdType linear[4] = {mesh.cells[0], mesh.cells[1], mesh.cells[2], mesh.cells[3]};
    grid->InsertNextCell(VTK_TETRA, 4, linear);
    ghosts->InsertNextValue(0);
    Messages messages;
    grid->Modified();
    check->Update();
    // A linear one beside them doubles a cell.
    EXPECT_FALSE(check->GetCertified());
    EXPECT_NE(row_of(check->GetDefects(), "duplicate_cell"), -1);
}

TEST(Check, TestsDelaunayIfAsked) {
    vtkNew<vtkBarycertCheck> check;
    check->SetInputData(grid_of(own_mesh("lattice-eighths")));
    const auto report = [&] {
        check->Update();
        auto* const lines =
            vtkStringArray::SafeDownCast(check->GetOutput()->GetFieldData()->GetAbstractArray("barycert_check"));
        std::string all;
        for (vtkIdType i = 0; i < lines->GetNumberOfValues(); ++i) all += lines->GetValue(i) + "\n";
        return all;
    };
    EXPECT_EQ(report().find("elaunay"), std::string::npos);
    check->DelaunayOn();
    EXPECT_NE(report().find("elaunay"), std::string::npos);
}

TEST(Check, TakesCellsOfAllTypes) {
    const auto grid = mixed_block(4, 0.0, true);
    vtkNew<vtkBarycertCheck> check;
    check->SetInputData(grid);
    check->Update();
    EXPECT_TRUE(check->GetCertified());
    vtkDataSet* const out = check->GetOutput();
    double volume = 0;
    for (vtkIdType i = 0; i < grid->GetNumberOfCells(); ++i) {
        EXPECT_EQ(cell_array(out, "orientation")->GetTuple1(i), 1) << i;
        const int type = grid->GetCellType(i);
        const double own = type == VTK_WEDGE ? 0.5 : type == VTK_PYRAMID ? 1.0 / 6 : 1;
        EXPECT_NEAR(cell_array(out, "volume")->GetTuple1(i), own, 1e-14) << i;
        volume += own;
    }
    EXPECT_NEAR(volume, 32, 1e-12);
    // A cell whose node lies beyond the opposite side is named by its id.
    Messages messages;
    grid->GetPoints()->SetPoint(0, 1.5, 0.5, 0.5);
    grid->GetPoints()->Modified();
    grid->Modified();
    check->Update();
    EXPECT_FALSE(check->GetCertified());
    const vtkIdType row = row_of(check->GetDefects(), "uncut_cell");
    ASSERT_GE(row, 0);
    EXPECT_EQ(text(check->GetDefects(), row, "places").find("cell 0"), 0U) << text(check->GetDefects(), row, "places");
    EXPECT_EQ(cell_array(out, "uncut_cell")->GetTuple1(0), 1);
    EXPECT_EQ(cell_array(out, "orientation")->GetTuple1(0), 0);
}

TEST(Check, RefusesCellsWithoutKnownCorners) {
    Messages messages;
    vtkNew<vtkBarycertCheck> check;
    vtkNew<vtkUnstructuredGrid> grid;
    grid->SetPoints(grid_of(box(3, {1, 1, 1}))->GetPoints());
    const vtkIdType nodes[8] = {0, 1, 3, 2, 4, 5, 7, 6};
    grid->InsertNextCell(VTK_CONVEX_POINT_SET, 8, nodes);
    check->SetInputData(grid);
    check->Update();
    EXPECT_EQ(messages.count("cannot be checked: cell 0 is a vtkConvexPointSet"), 1) << messages.all();
    // Polygons beside cells that fill space are left out.
    grid->Reset();
    grid->InsertNextCell(VTK_TETRA, 4, nodes);
    grid->InsertNextCell(VTK_QUAD, 4, nodes);
    grid->Modified();
    check->Update();
    EXPECT_TRUE(std::isnan(cell_array(check->GetOutput(), "volume")->GetTuple1(1)));
}

TEST(Check, OfNothingIsCertified) {
    vtkNew<vtkBarycertCheck> check;
    vtkNew<vtkUnstructuredGrid> empty;
    check->SetInputData(empty);
    check->Update();
    EXPECT_TRUE(check->GetCertified());
    EXPECT_EQ(check->GetOutput()->GetNumberOfCells(), 0);
}

}  // namespace
}  // namespace barycert::testing
