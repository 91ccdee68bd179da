// vtkBarycertCheck on surfaces in space: triangles against check_surface, polygons and strips against their triangles.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <vector>

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkFieldData.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkStringArray.h>
#include <vtkStripper.h>
#include <vtkTable.h>
#include <vtkUnsignedCharArray.h>

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
#include "tests/mesh/check/surfaces.hpp"
#include "tests/vtk/grids.hpp"
#include "vtkBarycertCheck.h"

namespace barycert::testing {
namespace {

struct CheckedSurface {
    explicit CheckedSurface(vtkDataSet* data) {
        const Messages messages;
        check->SetInputData(data);
        check->SetContacts(1000);
        check->Update();
        said = messages.all();
    }
    vtkDataArray* array(std::string_view name) {
        return check->GetOutput()->GetCellData()->GetArray(std::string(name).c_str());
    }
    /// The row of the table, "count breaks"; empty if there is none.
    std::string row(std::string_view defect) {
        vtkTable* const table = check->GetDefects();
        for (vtkIdType r = 0; r < table->GetNumberOfRows(); ++r)
            if (table->GetValueByName(r, "defect").ToString() == std::string(defect))
                return table->GetValueByName(r, "count").ToString() + " " +
                       table->GetValueByName(r, "breaks").ToString();
        return {};
    }
    std::string report() {
        auto* const lines =
            vtkStringArray::SafeDownCast(check->GetOutput()->GetFieldData()->GetAbstractArray("barycert_check"));
        std::string all;
        for (vtkIdType i = 0; lines != nullptr && i < lines->GetNumberOfValues(); ++i) all += lines->GetValue(i) + "\n";
        return all;
    }

    vtkNew<vtkBarycertCheck> check;
    std::string said;
};

/// Verdict, counts, marks and common points are those of check_surface; cell i is cell i + shift of the data set.
void expect_as_checked(const Surface& s, CheckedSurface& checked, vtkIdType shift = 0) {
    const CheckReport report = check_surface(s, {.contacts = 1000});
    EXPECT_EQ(checked.check->GetCertified(), report.certified());
    EXPECT_EQ(checked.said.find("NOT certified") == std::string::npos, report.certified()) << checked.said;
    EXPECT_EQ(checked.check->GetDefects()->GetNumberOfRows(), static_cast<vtkIdType>(report.defects.size()));
    for (const Defect& d : report.defects)
        EXPECT_EQ(checked.row(defect_text(d.kind).name), std::to_string(d.count) + (d.breaks() ? " 1" : " 0"))
            << defect_text(d.kind).name;
    DefectSet found = 0;
    for (std::size_t i = 0; i < s.cell_count(); ++i) {
        const auto id = static_cast<vtkIdType>(i) + shift;
        const DefectSet its = report.measures.defects[i];
        EXPECT_EQ(checked.array("problems")->GetTuple1(id), static_cast<double>(its));
        found |= its;
        for (const DefectText& text : defect_texts)
            if ((its & defect_bit(text.kind)) != 0) {
                EXPECT_EQ(checked.array(text.name)->GetTuple1(id), 1) << text.name;
            }
    }
    for (vtkIdType id = 0; id < shift; ++id) EXPECT_EQ(checked.array("problems")->GetTuple1(id), 0);
    for (const DefectText& text : defect_texts)
        EXPECT_EQ(checked.array(text.name) != nullptr, (found & defect_bit(text.kind)) != 0) << text.name;
    vtkPolyData* const points = checked.check->GetCommonPoints();
    ASSERT_EQ(points->GetNumberOfPoints(), static_cast<vtkIdType>(report.contacts.size()));
    for (vtkIdType i = 0; i < points->GetNumberOfPoints(); ++i) {
        const CellContact& contact = report.contacts[static_cast<std::size_t>(i)];
        EXPECT_EQ(points->GetPointData()->GetArray("cell_a")->GetTuple1(i), contact.cells[0] + shift);
        EXPECT_EQ(points->GetPointData()->GetArray("cell_b")->GetTuple1(i), contact.cells[1] + shift);
        for (int a = 0; a < 3; ++a)
            EXPECT_EQ(points->GetPoint(i)[a], contact.common.point[static_cast<std::size_t>(a)]);
    }
}

TEST(SurfaceCheck, HasTheReportOfCheckSurface) {
    for (const Surface& s : {torus(20, 12), surface_of(random_voxels(4, 0.5, 3)), random_soup(6, 20, 40, 1),
                             random_soup(40, 20, 40, 2), random_soup(4, 20, 60, 5)}) {
        CheckedSurface checked(poly_data_of(s));
        expect_as_checked(s, checked);
        EXPECT_EQ(checked.array("volume"), nullptr);
    }
    CheckedSurface torus_of_12(poly_data_of(torus(20, 12)));
    EXPECT_EQ(torus_of_12.report().find("input: certified: a closed surface without self-intersections"), 0U)
        << torus_of_12.report();
    EXPECT_EQ(torus_of_12.said, "");
}

TEST(SurfaceCheck, LeavesOtherCellsOutAndKeepsIds) {
    Surface s = torus(12, 8);
    s.cells.resize(s.cells.size() - 3);
    const auto whole = poly_data_of(s);
    vtkNew<vtkUnstructuredGrid> grid;
    grid->SetPoints(whole->GetPoints());
    vtkNew<vtkIdList> nodes;
    whole->GetCellPoints(0, nodes);
    grid->InsertNextCell(VTK_LINE, 2, nodes->GetPointer(0));
    grid->InsertNextCell(VTK_TRIANGLE, nodes);  // a duplicate, but for its mark
    for (vtkIdType i = 0; i < whole->GetNumberOfCells(); ++i) {
        whole->GetCellPoints(i, nodes);
        grid->InsertNextCell(VTK_TRIANGLE, nodes);
    }
    vtkNew<vtkUnsignedCharArray> ghosts;
    ghosts->SetName("vtkGhostType");
    for (vtkIdType i = 0; i < grid->GetNumberOfCells(); ++i)
        ghosts->InsertNextValue(i == 1 ? vtkDataSetAttributes::DUPLICATECELL : 0);
    grid->GetCellData()->AddArray(ghosts);
    CheckedSurface checked(grid);
    expect_as_checked(s, checked, 2);
    EXPECT_EQ(checked.row("open_edge"), "3 1");
    // The report names cells by their ids, and counts those that are there.
    for (const Defect& d : check_surface(s).defects)
        for (const DefectPlace& place : d.places)
            if (place.cells[0] >= 0) {
                EXPECT_NE(checked.report().find("triangle " + std::to_string(place.cells[0] + 2)), std::string::npos);
            }
    EXPECT_EQ(checked.report().find("polygon"), std::string::npos) << checked.report();
}

TEST(SurfaceCheck, TakesTrianglesOfSecondOrderByTheirCorners) {
    const Surface s = torus(6, 5);
    vtkNew<vtkUnstructuredGrid> grid;
    grid->SetPoints(poly_data_of(s)->GetPoints());
    for (std::size_t t = 0; t < s.cell_count(); ++t) {
        vtkIdType nodes[6];
        for (std::size_t k = 0; k < 6; ++k) nodes[k] = s.cells[3 * t + k % 3];
        grid->InsertNextCell(VTK_QUADRATIC_TRIANGLE, 6, nodes);
    }
    CheckedSurface checked(grid);
    EXPECT_TRUE(checked.check->GetCertified());
    EXPECT_NE(checked.said.find("taken by their corners"), std::string::npos) << checked.said;
}

// Polygons.

vtkSmartPointer<vtkPolyData> polygons_of(const std::vector<double>& points,
                                         const std::vector<std::vector<vtkIdType>>& rings) {
    const auto data = points_of(points);
    vtkNew<vtkCellArray> cells;
    for (const auto& ring : rings) cells->InsertNextCell(static_cast<vtkIdType>(ring.size()), ring.data());
    data->SetPolys(cells);
    return data;
}

const std::vector<double> corners_of_cube{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1};
const std::vector<std::vector<vtkIdType>> sides_of_cube{{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4},
                                                        {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};

TEST(SurfaceCheck, TakesPolygons) {
    CheckedSurface cube(polygons_of(corners_of_cube, sides_of_cube));
    EXPECT_TRUE(cube.check->GetCertified()) << cube.said;
    EXPECT_NE(cube.report().find("12 triangles"), std::string::npos) << cube.report();
    EXPECT_EQ(cube.check->GetDefects()->GetNumberOfRows(), 0);

    auto rings = sides_of_cube;
    rings.pop_back();
    CheckedSurface open(polygons_of(corners_of_cube, rings));
    EXPECT_FALSE(open.check->GetCertified());
    EXPECT_EQ(open.row("open_edge"), "4 1");
    std::set<vtkIdType> marked;
    for (vtkIdType i = 0; i < 5; ++i)
        if (open.array("open_edge")->GetTuple1(i) != 0) marked.insert(i);
    EXPECT_EQ(marked, (std::set<vtkIdType>{0, 1, 2, 4}));

    // A side that crosses itself has no triangles: it is marked nevertheless.
    rings = sides_of_cube;
    std::swap(rings[3][1], rings[3][2]);
    CheckedSurface crossed(polygons_of(corners_of_cube, rings));
    EXPECT_FALSE(crossed.check->GetCertified());
    EXPECT_EQ(crossed.row("bad_facet"), "1 1");
    for (vtkIdType i = 0; i < 6; ++i) EXPECT_EQ(crossed.array("bad_facet")->GetTuple1(i), i == 3 ? 1 : 0);

    // Not flat: told, and cut all the same.
    std::vector<double> bent = corners_of_cube;
    bent[20] = 1.25;
    CheckedSurface roof(polygons_of(bent, sides_of_cube));
    EXPECT_TRUE(roof.check->GetCertified()) << roof.said;
    EXPECT_NE(roof.row("facet_off_plane"), "");

    // Polygons of more corners, and with a triangle before them.
    CheckedSurface prism(polygons_of({0, 0, 0, 4, 0, 0, 4, 4, 0, 2, 1, 0, 0, 4, 0, 2, 2, 3},
                                     {{0, 1, 5}, {1, 2, 5}, {2, 3, 5}, {3, 4, 5}, {4, 0, 5}, {0, 4, 3, 2, 1}}));
    EXPECT_TRUE(prism.check->GetCertified()) << prism.said << prism.report();
    CheckedSurface stab(polygons_of({0, 0, 0, 4, 0, 0, 4, 4, 0, 2, 1, 0, 0, 4, 0, 2, 3, 0.5},
                                    {{0, 1, 5}, {1, 2, 5}, {2, 3, 5}, {3, 4, 5}, {4, 0, 5}, {0, 4, 3, 2, 1}}));
    EXPECT_EQ(stab.check->GetCertified(), stab.row("self_intersection").empty());
}

TEST(SurfaceCheck, TakesStripsAsTheirTriangles) {
    const Surface s = torus(24, 10);
    vtkNew<vtkStripper> stripper;
    stripper->SetInputData(poly_data_of(s));
    stripper->Update();
    vtkPolyData* const strips = stripper->GetOutput();
    ASSERT_LT(strips->GetNumberOfCells(), static_cast<vtkIdType>(s.cell_count()));
    CheckedSurface checked(strips);
    // Turned alike, which they are only if every other triangle of a strip is turned back.
    EXPECT_TRUE(checked.check->GetCertified()) << checked.said;
    EXPECT_NE(checked.report().find("oriented outward"), std::string::npos) << checked.report();
    EXPECT_NE(checked.report().find(std::to_string(strips->GetNumberOfCells()) + " polygons, " +
                                    std::to_string(s.cell_count()) + " triangles"),
              std::string::npos)
        << checked.report();
}

TEST(SurfaceCheck, OfBadInputSaysSo) {
    // As triangles have it: in the report. Polygons cannot be cut there.
    Surface s = torus(6, 5);
    s.points[4] = std::numeric_limits<double>::quiet_NaN();
    CheckedSurface nan(poly_data_of(s));
    expect_as_checked(s, nan);
    EXPECT_EQ(nan.row("not_finite"), "1 1");
    s = torus(6, 5);
    s.cells[7] = s.cells[6];
    CheckedSurface twice(poly_data_of(s));
    expect_as_checked(s, twice);
    EXPECT_EQ(twice.row("repeated_node"), "1 1");
    std::vector<double> points = corners_of_cube;
    points[5] = std::numeric_limits<double>::infinity();
    EXPECT_NE(CheckedSurface(polygons_of(points, sides_of_cube)).said.find("a coordinate that is not finite"),
              std::string::npos);
    const vtkIdType nodes[4] = {8, 0, 1, 6};
    const auto said = [&](int type, vtkIdType size) {
        vtkNew<vtkUnstructuredGrid> grid;
        grid->SetPoints(points_of(corners_of_cube)->GetPoints());
        grid->InsertNextCell(type, size, nodes + (size == 2 ? 1 : 0));
        return CheckedSurface(grid).said;
    };
    EXPECT_NE(said(VTK_POLYGON, 2).find("cell 0 has 2 nodes"), std::string::npos);
    EXPECT_NE(said(VTK_POLYGON, 4).find("cell 0 has a vertex that is no point"), std::string::npos);
    EXPECT_NE(said(VTK_TRIANGLE, 3).find("cell 0 has a vertex that is no point"), std::string::npos);
    EXPECT_NE(CheckedSurface(polygons_of(corners_of_cube, {{0, 1, 2, 3}, {4, 5}})).said.find("VTK cannot build"),
              std::string::npos);
    vtkNew<vtkPolyData> empty;
    EXPECT_TRUE(CheckedSurface(empty).check->GetCertified());
}

}  // namespace
}  // namespace barycert::testing
