/// Files of surfaces as VTK's own reader sees them.
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkErrorCode.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPLYReader.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkXMLPolyDataReader.h>

#include "tests/io/surface/surface_files.hpp"
#include "tests/io/vtk/vtk_files.hpp"

namespace barycert::testing {
namespace {

vtkSmartPointer<vtkPolyData> read_by_vtk(const std::string& path) {
    Printed printed;
    vtkNew<vtkXMLPolyDataReader> reader;
    reader->SetFileName(path.c_str());
    EXPECT_EQ(reader->CanReadFile(path.c_str()), 1);
    reader->Update();
    EXPECT_EQ(reader->GetErrorCode(), static_cast<unsigned long>(vtkErrorCode::NoError));
    EXPECT_EQ(printed.text(), "");
    return reader->GetOutput();
}

void expect_cells(vtkCellArray* cells, const Surface& s) {
    ASSERT_EQ(cells->GetNumberOfCells(), static_cast<vtkIdType>(s.cell_count()));
    vtkNew<vtkIdList> ids;
    for (std::size_t c = 0; c < s.cell_count(); ++c) {
        cells->GetCellAtId(static_cast<vtkIdType>(c), ids);
        ASSERT_EQ(ids->GetNumberOfIds(), static_cast<vtkIdType>(s.corners()));
        for (std::size_t i = 0; i < s.corners(); ++i)
            EXPECT_EQ(ids->GetId(static_cast<vtkIdType>(i)), s.cells[s.corners() * c + i]);
    }
}

void expect_fields(vtkDataSetAttributes* data, const std::vector<Field>& fields) {
    for (const Field& f : fields) {
        SCOPED_TRACE(f.name);
        vtkDataArray* const array = data->GetArray(f.name.c_str());
        ASSERT_NE(array, nullptr);
        EXPECT_EQ(array->GetDataType(), VTK_DOUBLE);
        EXPECT_EQ(array->GetNumberOfComponents(), f.components);
        EXPECT_EQ(bits_of(array), bits_of(f.data));
    }
}

TEST(Vtp, VtkReadsTrianglesToTheBits) {
    const TemporaryFolder folder;
    const Surface s = two_triangles();
    write_surface(s, folder / "s.vtp").value();
    const auto read = read_by_vtk(folder / "s.vtp");
    EXPECT_EQ(bits_of(read->GetPoints()->GetData()), bits_of(s.points));
    expect_cells(read->GetPolys(), s);
    EXPECT_EQ(read->GetNumberOfCells(), 2);
    expect_fields(read->GetPointData(), s.point_fields);
    expect_fields(read->GetCellData(), s.cell_fields);
    vtkDataArray* const cell = read->GetCellData()->GetArray("cell");
    ASSERT_NE(cell, nullptr);
    EXPECT_EQ(cell->GetTuple1(0), 17);
    EXPECT_EQ(cell->GetTuple1(1), 4);
}

TEST(Vtp, VtkReadsSegments) {
    const TemporaryFolder folder;
    const Surface s = two_segments();
    write_surface(s, folder / "s.vtp").value();
    const auto read = read_by_vtk(folder / "s.vtp");
    EXPECT_EQ(bits_of(read->GetPoints()->GetData()),
              bits_of(std::vector<double>{0.1, -1e300, 0, 1, 0, 0, 1.0 / 3, 2, 0}));
    expect_cells(read->GetLines(), s);
    expect_fields(read->GetPointData(), s.point_fields);
    expect_fields(read->GetCellData(), s.cell_fields);
    EXPECT_EQ(read->GetCellData()->GetNumberOfArrays(), 1) << "a field of the name cell goes first";
}

// VTK reads coordinates of PLY files as floats, and fields not at all.
TEST(Ply, VtkReadsTriangles) {
    const TemporaryFolder folder;
    Surface s = two_triangles();
    s.points[1] = -1e30;
    s.points[2] = 0.25;
    write_surface(s, folder / "s.ply").value();
    Printed printed;
    vtkNew<vtkPLYReader> reader;
    EXPECT_EQ(vtkPLYReader::CanReadFile((folder / "s.ply").c_str()), 1);
    reader->SetFileName((folder / "s.ply").c_str());
    reader->Update();
    EXPECT_EQ(printed.text(), "");
    vtkPolyData* const read = reader->GetOutput();
    ASSERT_EQ(read->GetNumberOfPoints(), 4);
    for (std::size_t v = 0; v < 4; ++v) {
        for (std::size_t k = 0; k < 3; ++k)
            EXPECT_EQ(read->GetPoint(static_cast<vtkIdType>(v))[k], static_cast<float>(s.points[3 * v + k]));
    }
    expect_cells(read->GetPolys(), s);
}

TEST(Vtp, VtkReadsNothing) {
    const TemporaryFolder folder;
    for (const int d : {2, 3}) {
        Surface s;
        s.dimension = d;
        s.point_fields = {{"T", 1, {}}};
        write_surface(s, folder / "s.vtp").value();
        const auto read = read_by_vtk(folder / "s.vtp");
        EXPECT_EQ(read->GetNumberOfPoints(), 0);
        EXPECT_EQ(read->GetNumberOfCells(), 0);
    }
}

}  // namespace
}  // namespace barycert::testing
