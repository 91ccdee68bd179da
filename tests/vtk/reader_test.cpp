// vtkBarycertTetGenReader: the mesh that read_tetgen reads, as VTK's cells and arrays; errors with file and line.

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkTypeInt64Array.h>

#include "barycert/gmsh_files.hpp"
#include "barycert/mesh_files.hpp"
#include "barycert/plc_files.hpp"
#include "barycert/point_files.hpp"
#include "barycert/series.hpp"
#include "barycert/surface_files.hpp"
#include "barycert/table_files.hpp"
#include "barycert/tetgen_files.hpp"
#include "barycert/vtk_files.hpp"
#include "tests/check/meshes.hpp"
#include "tests/scratch.hpp"
#include "tests/vtk/grids.hpp"
#include "vtkBarycertTetGenReader.h"

namespace barycert::testing {
namespace {

vtkSmartPointer<vtkUnstructuredGrid> read(const std::string& path) {
    vtkNew<vtkBarycertTetGenReader> reader;
    reader->SetFileName(path.c_str());
    reader->Update();
    return reader->GetOutput();
}

void expect_fields(const std::vector<Field>& fields, vtkDataSetAttributes* arrays) {
    for (const Field& field : fields) {
        vtkDataArray* const array = arrays->GetArray(field.name.c_str());
        ASSERT_NE(array, nullptr) << field.name;
        ASSERT_EQ(array->GetNumberOfComponents(), field.components);
        ASSERT_EQ(array->GetNumberOfValues(), static_cast<vtkIdType>(field.data.size()));
        for (std::size_t i = 0; i < field.data.size(); ++i)
            ASSERT_EQ(array->GetVariantValue(static_cast<vtkIdType>(i)).ToDouble(), field.data[i]);
    }
}

TEST(TetGenReader, HasTheMeshOfTheFiles) {
    for (const auto& [name, type] : {std::pair("bracket", VTK_TETRA), std::pair("cube-hole-o2", VTK_QUADRATIC_TETRA),
                                     std::pair("plate", VTK_TRIANGLE)}) {
        const Mesh mesh = own_mesh(name);
        const auto grid = read(std::string(BARYCERT_DATA_DIR) + "/meshes/" + name + ".ele");
        ASSERT_EQ(grid->GetNumberOfPoints(), static_cast<vtkIdType>(mesh.point_count()));
        ASSERT_EQ(grid->GetNumberOfCells(), static_cast<vtkIdType>(mesh.cell_count()));
        for (vtkIdType i = 0; i < grid->GetNumberOfPoints(); ++i) {
            std::vector<double> x = node_at(mesh, static_cast<Mesh::Index>(i));
            x.resize(3);
            for (std::size_t a = 0; a < 3; ++a) ASSERT_EQ(grid->GetPoint(i)[a], x[a]);
        }
        const std::size_t n = mesh.corners(), mids = mesh.mid_nodes.size() / mesh.cell_count();
        vtkNew<vtkIdList> nodes;
        for (std::size_t i = 0; i < mesh.cell_count(); ++i) {
            ASSERT_EQ(grid->GetCellType(static_cast<vtkIdType>(i)), type);
            grid->GetCellPoints(static_cast<vtkIdType>(i), nodes);
            ASSERT_EQ(nodes->GetNumberOfIds(), static_cast<vtkIdType>(n + mids));
            for (std::size_t k = 0; k < n + mids; ++k)
                ASSERT_EQ(nodes->GetId(static_cast<vtkIdType>(k)),
                          k < n ? mesh.cells[n * i + k] : mesh.mid_nodes[mids * i + k - n]);
        }
        expect_fields(mesh.point_fields, grid->GetPointData());
        expect_fields(mesh.cell_fields, grid->GetCellData());
        EXPECT_FALSE(mesh.point_fields.empty());
    }
}

TEST(TetGenReader, HasMarkersAndRegions) {
    const test::Scratch scratch;
    scratch.put("part.1.node", "4 3 1 1\n1 0 0 0 0.1 -7\n2 1 0 0 .2 9007199254740993\n3 0 1 0 .3 0\n4 0 0 1 .4 5\n");
    const auto grid = read((scratch.put("part.1.ele", "1 4 2\n1 1 2 3 4 3 0.5\n")));
    auto* const markers = vtkTypeInt64Array::SafeDownCast(grid->GetPointData()->GetAbstractArray("marker"));
    ASSERT_NE(markers, nullptr);
    EXPECT_EQ(markers->GetValue(0), -7);
    EXPECT_EQ(markers->GetValue(1), 9007199254740993);
    EXPECT_EQ(grid->GetPointData()->GetArray("attribute0")->GetTuple1(0), 0.1);
    EXPECT_EQ(grid->GetCellData()->GetArray("attribute0")->GetTuple1(0), 3);
    EXPECT_EQ(grid->GetCellData()->GetArray("attribute1")->GetTuple1(0), 0.5);
}

TEST(TetGenReader, TellsFileAndLine) {
    const test::Scratch scratch;
    const std::string node = scratch.put("bad.node", "4 3 0 0\n0 0 0 0\n1 1 0 0\n2 0 1x 0\n3 0 0 1\n");
    scratch.put("bad.ele", "1 4 0\n0 0 1 2 3\n");
    Messages messages;
    EXPECT_EQ(read(node)->GetNumberOfCells(), 0);
    EXPECT_GE(messages.count(read_tetgen(node).error().message()), 1) << messages.all();
    EXPECT_GE(messages.count(node + ":4: "), 1) << messages.all();
    EXPECT_EQ(read(scratch.path("none.node"))->GetNumberOfCells(), 0);
    EXPECT_GE(messages.count("none"), 1) << messages.all();
    vtkNew<vtkBarycertTetGenReader> reader;
    reader->Update();
    EXPECT_EQ(messages.count("FileName is not set"), 1) << messages.all();
}

TEST(TetGenReader, KnowsItsFilesByName) {
    vtkNew<vtkBarycertTetGenReader> reader;
    for (const char* const name : {"a.node", "b.1.ele"}) EXPECT_EQ(reader->CanReadFile(name), 1);
    for (const char* const name : {"a.vtu", "node", "a.elef", ""}) EXPECT_EQ(reader->CanReadFile(name), 0);
    EXPECT_EQ(reader->CanReadFile(nullptr), 0);
}

}  // namespace
}  // namespace barycert::testing
