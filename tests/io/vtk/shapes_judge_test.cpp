/// Cells of all shapes and structured grids, as VTK itself reads and writes them.
#include <vtkCell.h>
#include <vtkErrorCode.h>
#include <vtkIdList.h>
#include <vtkImageData.h>
#include <vtkRectilinearGrid.h>
#include <vtkRectilinearGridWriter.h>
#include <vtkStringArray.h>
#include <vtkStructuredGrid.h>
#include <vtkStructuredGridWriter.h>
#include <vtkStructuredPoints.h>
#include <vtkStructuredPointsWriter.h>
#include <vtkUnstructuredGridReader.h>
#include <vtkUnstructuredGridWriter.h>
#include <vtkXMLImageDataWriter.h>
#include <vtkXMLRectilinearGridWriter.h>
#include <vtkXMLStructuredGridWriter.h>
#include <vtkXMLUnstructuredGridReader.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include "tests/io/vtk/all_shapes.hpp"
#include "tests/io/vtk/vtk_files.hpp"

namespace barycert::testing {
namespace {

using Ids = std::vector<vtkIdType>;

Ids ids_of(vtkIdList* list) {
    return {list->GetPointer(0), list->GetPointer(0) + list->GetNumberOfIds()};
}

template <class Reader>
vtkSmartPointer<vtkUnstructuredGrid> grid_by(const std::string& path) {
    vtkNew<Reader> reader;
    reader->SetFileName(path.c_str());
    reader->Update();
    EXPECT_EQ(reader->GetErrorCode(), static_cast<unsigned long>(vtkErrorCode::NoError));
    return reader->GetOutput();
}

/// The faces of a polyhedron: how many, then how many nodes and these, face after face.
Ids stream_of(const Mesh::Shapes& shapes, std::size_t cell) {
    Ids stream{shapes.face_ends[cell] - shapes.face_ends[cell - 1]};
    for (auto f = static_cast<std::size_t>(shapes.face_ends[cell - 1]);
         f < static_cast<std::size_t>(shapes.face_ends[cell]); ++f) {
        const auto begin = f == 0 ? 0 : shapes.ring_ends[f - 1];
        stream.push_back(shapes.ring_ends[f] - begin);
        stream.insert(stream.end(), shapes.rings.begin() + begin, shapes.rings.begin() + shapes.ring_ends[f]);
    }
    return stream;
}

/// `sorted`: nodes of polyhedra may be in any order.
void expect_grid(vtkUnstructuredGrid* grid, const Mesh& mesh, bool sorted) {
    const Mesh::Shapes& shapes = mesh.shapes;
    const auto dimension = static_cast<std::size_t>(mesh.dimension);
    ASSERT_EQ(static_cast<std::size_t>(grid->GetNumberOfPoints()), mesh.point_count());
    for (std::size_t i = 0; i < mesh.point_count(); ++i) {
        for (std::size_t k = 0; k < 3; ++k)
            ASSERT_EQ(grid->GetPoint(static_cast<vtkIdType>(i))[k], k < dimension ? mesh.points[dimension * i + k] : 0);
    }
    ASSERT_EQ(static_cast<std::size_t>(grid->GetNumberOfCells()), shapes.count());
    vtkNew<vtkIdList> list;
    vtkDataArray* const stress = grid->GetCellData()->GetArray("stress");
    ASSERT_NE(stress, nullptr);
    auto* const names = vtkStringArray::SafeDownCast(grid->GetCellData()->GetAbstractArray("name"));
    ASSERT_NE(names, nullptr);
    for (std::size_t cell = 0; cell < shapes.count(); ++cell) {
        SCOPED_TRACE(cell);
        const auto id = static_cast<vtkIdType>(cell);
        ASSERT_EQ(grid->GetCellType(id), shapes.types[cell]);
        grid->GetCellPoints(id, list);
        Ids nodes = ids_of(list);
        if (sorted && shapes.types[cell] == 42) std::ranges::sort(nodes);
        EXPECT_EQ(nodes, Ids(shapes.nodes.begin() + (cell == 0 ? 0 : shapes.ends[cell - 1]),
                             shapes.nodes.begin() + shapes.ends[cell]));
        EXPECT_EQ(names->GetValue(id), "cell " + std::to_string(cell));
        const auto part = static_cast<std::size_t>(shapes.parts[cell]);
        for (int c = 0; c < 6; ++c)
            EXPECT_EQ(stress->GetComponent(id, c), mesh.cell_fields[1].data[6 * part + static_cast<std::size_t>(c)]);
        if (shapes.types[cell] != 42) continue;
        grid->GetFaceStream(id, list);
        EXPECT_EQ(ids_of(list), stream_of(shapes, cell));
    }
    EXPECT_EQ(bits_of(grid->GetPointData()->GetArray("velocity")), bits_of(mesh.point_fields[1].data));
}

TEST(VtkShapesJudge, VtkReadsWhatIsWrittenAndWritesItAgain) {
    const TemporaryFolder folder;
    for (const Mesh& mesh : {all_solids(), all_polygons()}) {
        for (const VtkData data : {VtkData::raw, VtkData::ascii, VtkData::zlib}) {
            SCOPED_TRACE(static_cast<int>(data));
            ASSERT_TRUE(write_vtu(mesh, folder / "m.vtu", data));
            const auto grid = grid_by<vtkXMLUnstructuredGridReader>(folder / "m.vtu");
            expect_grid(grid, mesh, false);
            vtkNew<vtkXMLUnstructuredGridWriter> writer;
            writer->SetFileName((folder / "again.vtu").c_str());
            writer->SetInputData(grid);
            ASSERT_EQ(writer->Write(), 1);
            const Result<Mesh> again = read_quietly(folder / "again.vtu");
            ASSERT_TRUE(again) << again.error().message();
            expect_same_shapes(*again, mesh);
            if (data == VtkData::zlib) continue;
            ASSERT_TRUE(write_vtk(mesh, folder / "m.vtk", data));
            const auto legacy = grid_by<vtkUnstructuredGridReader>(folder / "m.vtk");
            expect_grid(legacy, mesh, true);
            // Version 5.1, with offsets.
            vtkNew<vtkUnstructuredGridWriter> legacy_writer;
            legacy_writer->SetFileName((folder / "again.vtk").c_str());
            legacy_writer->SetFileTypeToBinary();
            legacy_writer->SetInputData(grid);
            ASSERT_EQ(legacy_writer->Write(), 1);
            const Result<Mesh> from_legacy = read_quietly(folder / "again.vtk");
            ASSERT_TRUE(from_legacy) << from_legacy.error().message();
            EXPECT_TRUE(from_legacy->shapes == mesh.shapes);
            EXPECT_EQ(bits_of(from_legacy->points), bits_of(mesh.points));
            expect_same_fields(from_legacy->cell_fields, mesh.cell_fields);
            EXPECT_EQ(from_legacy->cell_numbers, mesh.cell_numbers);
        }
    }
}

// Structured grids.

template <class Array>
void add_fields(vtkDataSet* set) {
    std::vector<double> points, cells;
    for (vtkIdType i = 0; i < 3 * set->GetNumberOfPoints(); ++i) points.push_back(0.1 * static_cast<double>(i));
    for (vtkIdType i = 0; i < set->GetNumberOfCells(); ++i) cells.push_back(static_cast<double>(i * i));
    set->GetPointData()->AddArray(array_of<Array>("u", 3, points));
    set->GetCellData()->AddArray(array_of<Array>("q", 1, cells));
}

template <class Writer>
void write_by(vtkDataSet* set, const std::string& path) {
    vtkNew<Writer> writer;
    writer->SetFileName(path.c_str());
    writer->SetInputData(set);
    // Legacy text has 11 digits.
    if constexpr (requires { writer->SetFileTypeToBinary(); }) writer->SetFileTypeToBinary();
    ASSERT_EQ(writer->Write(), 1);
}

/// Cells, nodes, places and values are those of VTK, but for cells that it hides.
void expect_set(const std::string& path, vtkDataSet* set) {
    SCOPED_TRACE(path);
    const Result<Mesh> read = read_quietly(path);
    ASSERT_TRUE(read) << read.error().message();
    const bool flat = set->GetCell(0)->GetCellDimension() == 2;
    const std::size_t dimension = flat ? 2 : 3;
    EXPECT_EQ(read->dimension, flat ? 2 : 3);
    ASSERT_EQ(static_cast<vtkIdType>(read->point_count()), set->GetNumberOfPoints());
    for (std::size_t i = 0; i < read->point_count(); ++i) {
        const double* const at = set->GetPoint(static_cast<vtkIdType>(i));
        for (std::size_t k = 0; k < dimension; ++k) ASSERT_EQ(read->points[dimension * i + k], at[k]) << i;
    }
    vtkNew<vtkIdList> list;
    std::size_t own = 0;
    vtkDataArray* const ghosts = set->GetCellGhostArray();
    for (vtkIdType cell = 0; cell < set->GetNumberOfCells(); ++cell) {
        if (ghosts != nullptr && ghosts->GetComponent(cell, 0) != 0) continue;
        ASSERT_LT(own, read->shapes.count());
        EXPECT_EQ(read->shapes.types[own], set->GetCellType(cell));
        set->GetCellPoints(cell, list);
        EXPECT_EQ(ids_of(list), Ids(read->shapes.nodes.begin() + (own == 0 ? 0 : read->shapes.ends[own - 1]),
                                    read->shapes.nodes.begin() + read->shapes.ends[own]));
        const auto part = static_cast<std::size_t>(read->shapes.parts[own]);
        EXPECT_EQ(read->cell_numbers[part], cell);
        const auto q = std::ranges::find(read->cell_fields, "q", &Field::name);
        ASSERT_NE(q, read->cell_fields.end());
        EXPECT_EQ(q->data[part], static_cast<double>(cell * cell));
        ++own;
    }
    EXPECT_EQ(own, read->shapes.count());
    const auto u = std::ranges::find(read->point_fields, "u", &Field::name);
    ASSERT_NE(u, read->point_fields.end());
    for (std::size_t i = 0; i < u->data.size(); ++i) ASSERT_EQ(u->data[i], 0.1 * static_cast<double>(i));
}

struct Extent {
    std::array<int, 6> of;
    bool flat;
};

TEST(VtkShapesJudge, StructuredGridsAreAsVtkHasThem) {
    const TemporaryFolder folder;
    for (const auto& [extent, flat] : {Extent{{0, 3, 0, 2, 0, 2}, false},
                                       {{-2, 1, 5, 7, 1, 2}, false},
                                       {{0, 1, 0, 1, 0, 1}, false},
                                       {{0, 4, 0, 3, 0, 0}, true}}) {
        for (const bool blank : {false, true}) {
            SCOPED_TRACE(std::to_string(extent[1]) + (blank ? " blank" : ""));
            if (blank && extent[1] == 1 && extent[0] == 0) continue;  // its only cell
            // Cells are hidden by an array, which image data make of it.
            const auto hide = [&](vtkDataSet* set) {
                std::vector<double> flags(static_cast<std::size_t>(set->GetNumberOfCells()), 0);
                flags[1] = 32;
                if (blank) set->GetCellData()->AddArray(array_of<vtkUnsignedCharArray>("vtkGhostType", 1, flags));
            };
            vtkNew<vtkImageData> image;
            image->SetExtent(const_cast<int*>(extent.data()));
            image->SetOrigin(0.1, -0.7, 0);
            image->SetSpacing(0.1, 0.3, 1e-3);
            add_fields<vtkDoubleArray>(image);
            hide(image);
            write_by<vtkXMLImageDataWriter>(image, folder / "g.vti");
            expect_set(folder / "g.vti", image);

            vtkNew<vtkRectilinearGrid> axes;
            axes->SetExtent(const_cast<int*>(extent.data()));
            std::array<std::vector<double>, 3> along;
            for (std::size_t axis = 0; axis < 3; ++axis) {
                for (int i = extent[2 * axis]; i <= extent[2 * axis + 1]; ++i)
                    along[axis].push_back(flat && axis == 2 ? 0 : 0.1 * i * std::abs(i));
            }
            axes->SetXCoordinates(array_of<vtkDoubleArray>("x", 1, along[0]));
            axes->SetYCoordinates(array_of<vtkDoubleArray>("y", 1, along[1]));
            axes->SetZCoordinates(array_of<vtkDoubleArray>("z", 1, along[2]));
            add_fields<vtkDoubleArray>(axes);
            hide(axes);
            write_by<vtkXMLRectilinearGridWriter>(axes, folder / "g.vtr");
            expect_set(folder / "g.vtr", axes);

            vtkNew<vtkStructuredGrid> grid;
            grid->SetExtent(const_cast<int*>(extent.data()));
            vtkNew<vtkPoints> points;
            points->SetDataTypeToDouble();
            for (vtkIdType i = 0; i < axes->GetNumberOfPoints(); ++i) {
                const double* const at = axes->GetPoint(i);
                points->InsertNextPoint(at[0] + at[1] / 8, at[1], flat ? 0 : at[2] + at[0] / 16);
            }
            grid->SetPoints(points);
            add_fields<vtkDoubleArray>(grid);
            hide(grid);
            write_by<vtkXMLStructuredGridWriter>(grid, folder / "g.vts");
            expect_set(folder / "g.vts", grid);

            write_by<vtkRectilinearGridWriter>(axes, folder / "axes.vtk");
            expect_set(folder / "axes.vtk", axes);
            write_by<vtkStructuredGridWriter>(grid, folder / "grid.vtk");
            expect_set(folder / "grid.vtk", grid);
            // Legacy images begin at 0.
            vtkNew<vtkStructuredPoints> legacy;
            legacy->SetDimensions(image->GetDimensions());
            legacy->SetOrigin(0.5, 0.25, 0);
            legacy->SetSpacing(0.125, 0.5, 2);
            add_fields<vtkDoubleArray>(legacy);
            hide(legacy);
            write_by<vtkStructuredPointsWriter>(legacy, folder / "image.vtk");
            expect_set(folder / "image.vtk", legacy);
        }
    }
}

}  // namespace
}  // namespace barycert::testing
