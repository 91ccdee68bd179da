/// Files written in every mode, as VTK's own readers see them.
#include <vtkCellData.h>
#include <vtkErrorCode.h>
#include <vtkImageData.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkUnstructuredGridReader.h>
#include <vtkXMLImageDataReader.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLUnstructuredGridReader.h>

#include "barycert/surface.hpp"
#include "tests/io/tetgen/random_mesh.hpp"
#include "tests/io/vti/vti_files.hpp"
#include "tests/io/vtk/vtk_files.hpp"

namespace barycert::testing {
namespace {

constexpr std::array<VtkData, 5> all_data{VtkData::raw, VtkData::zlib, VtkData::lz4, VtkData::lzma, VtkData::ascii};

template <class Reader>
auto read_by_vtk(const std::string& path) {
    vtkNew<Reader> reader;
    reader->SetFileName(path.c_str());
    reader->Update();
    EXPECT_EQ(reader->GetErrorCode(), static_cast<unsigned long>(vtkErrorCode::NoError));
    return vtkSmartPointer(reader->GetOutput());
}

/// VTK's reader of text takes no number below the least normal one.
std::vector<double> readable(base::Random& random, std::size_t count) {
    std::vector<double> values = any_doubles(random, count);
    for (double& x : values) {
        if (std::abs(x) < 0x1p-1022) x = 0.5;
    }
    return values;
}

Mesh judged_mesh(const char* name) {
    Mesh mesh = mesh_of_data(name);
    base::Random random(11);
    mesh.point_fields = {{"T", 1, readable(random, mesh.point_count())},
                         {"u", 3, readable(random, 3 * mesh.point_count())}};
    mesh.cell_fields = {{"c d", 9, readable(random, 9 * mesh.cell_count())}};
    std::vector<std::string> names(mesh.cell_count(), "steel");
    names[1] = "";
    names[2] = "a b%c";
    mesh.cell_labels = {{"names", names}, {"ids", std::vector<std::int64_t>(mesh.cell_count(), -9007199254740993)}};
    return mesh;
}

void expect_judged(vtkUnstructuredGrid* grid, const Mesh& mesh) {
    ASSERT_EQ(static_cast<std::size_t>(grid->GetNumberOfCells()), mesh.cell_count());
    if (mesh.dimension == 3) {
        EXPECT_EQ(bits_of(grid->GetPoints()->GetData()), bits_of(mesh.points));
    }
    const std::size_t corners = mesh.corners(), mids = mesh.mid_nodes.size() / mesh.cell_count();
    vtkNew<vtkIdList> nodes;
    for (std::size_t cell = 0; cell < mesh.cell_count(); ++cell) {
        grid->GetCellPoints(static_cast<vtkIdType>(cell), nodes);
        ASSERT_EQ(static_cast<std::size_t>(nodes->GetNumberOfIds()), corners + mids);
        for (std::size_t i = 0; i < corners + mids; ++i) {
            ASSERT_EQ(nodes->GetId(static_cast<vtkIdType>(i)),
                      i < corners ? mesh.cells[cell * corners + i] : mesh.mid_nodes[cell * mids + i - corners]);
        }
    }
    for (const Field& field : mesh.point_fields)
        EXPECT_EQ(bits_of(grid->GetPointData()->GetArray(field.name.c_str())), bits_of(field.data)) << field.name;
    for (const Field& field : mesh.cell_fields)
        EXPECT_EQ(bits_of(grid->GetCellData()->GetArray(field.name.c_str())), bits_of(field.data)) << field.name;
    auto* const names = vtkStringArray::SafeDownCast(grid->GetCellData()->GetAbstractArray("names"));
    ASSERT_NE(names, nullptr);
    const auto& expected = std::get<std::vector<std::string>>(mesh.cell_labels[0].values);
    ASSERT_EQ(static_cast<std::size_t>(names->GetNumberOfValues()), expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i)
        EXPECT_EQ(names->GetValue(static_cast<vtkIdType>(i)), expected[i]);
    vtkDataArray* const ids = grid->GetCellData()->GetArray("ids");
    ASSERT_NE(ids, nullptr);
    EXPECT_EQ(ids->GetVariantValue(0).ToTypeInt64(), -9007199254740993);
}

TEST(VtkDataJudge, Meshes) {
    const TemporaryFolder folder;
    for (const char* name : {"cube-hole", "cube-hole-o2", "plate"}) {
        const Mesh mesh = judged_mesh(name);
        for (const VtkData data : all_data) {
            SCOPED_TRACE(std::string(name) + " " + std::string(barycert::name(data)));
            ASSERT_TRUE(write_vtu(mesh, folder / "m.vtu", data));
            expect_judged(read_by_vtk<vtkXMLUnstructuredGridReader>(folder / "m.vtu"), mesh);
            if (data != VtkData::raw && data != VtkData::ascii) continue;
            ASSERT_TRUE(write_vtk(mesh, folder / "m.vtk", data));
            expect_judged(read_by_vtk<vtkUnstructuredGridReader>(folder / "m.vtk"), mesh);
        }
    }
}

TEST(VtkDataJudge, Surfaces) {
    const Mesh mesh = mesh_of_data("cube-hole");
    const TemporaryFolder folder;
    Surface surface;
    surface.points = mesh.points;
    base::Random random(3);
    for (std::size_t i = 0; i < 100; ++i) surface.cells.push_back(mesh.cells[i + i / 3]);
    surface.cells.resize(99);
    surface.point_fields = {{"T", 1, readable(random, surface.point_count())}};
    for (const VtkData data : all_data) {
        SCOPED_TRACE(name(data));
        ASSERT_TRUE(write_surface(surface, folder / "s.vtp", data));
        const auto read = read_by_vtk<vtkXMLPolyDataReader>(folder / "s.vtp");
        ASSERT_EQ(read->GetNumberOfPolys(), 33);
        EXPECT_EQ(bits_of(read->GetPoints()->GetData()), bits_of(surface.points));
        EXPECT_EQ(bits_of(read->GetPointData()->GetArray("T")), bits_of(surface.point_fields[0].data));
        for (vtkIdType cell = 0; cell < 33; ++cell) {
            vtkNew<vtkIdList> nodes;
            read->GetCellPoints(cell, nodes);
            for (vtkIdType k = 0; k < 3; ++k)
                ASSERT_EQ(nodes->GetId(k), surface.cells[static_cast<std::size_t>(3 * cell + k)]);
        }
    }
}

TEST(VtkDataJudge, Images) {
    const TemporaryFolder folder;
    const io::VtiGrid grid{{40, 30, 20}, {0.1, 0.2, 0.3}, {0.5, 1, 2}};
    const std::size_t points = 40 * 30 * 20;
    base::Random random(5);
    const std::vector<double> values = readable(random, 2 * points);
    std::vector<std::int8_t> mask(points);
    for (std::size_t i = 0; i < points; ++i) mask[i] = static_cast<std::int8_t>(i % 3);
    for (const VtkData data : all_data) {
        SCOPED_TRACE(name(data));
        auto writer = io::VtiWriter::open(folder / "g.vti", grid,
                                          {{"u", 2, io::NumberType::float64}, {"mask", 1, io::NumberType::int8}}, data)
                          .value();
        for (std::size_t i = 0; i < points; i += 6000) {  // the arrays take turns
            ASSERT_TRUE(writer->write(0, std::as_bytes(std::span(values).subspan(2 * i, 12000))));
            ASSERT_TRUE(writer->write(1, std::as_bytes(std::span(mask).subspan(i, 6000))));
        }
        ASSERT_TRUE(writer->commit());
        const auto image = read_by_vtk<vtkXMLImageDataReader>(folder / "g.vti");
        EXPECT_EQ(image->GetDimensions()[1], 30);
        EXPECT_EQ(image->GetSpacing()[2], 2);
        EXPECT_EQ(image->GetOrigin()[0], 0.1);
        EXPECT_EQ(bits_of(image->GetPointData()->GetArray("u")), bits_of(values));
        EXPECT_EQ(image->GetPointData()->GetArray("mask")->GetTuple1(5), 2);
        const std::vector<double> own = read_vtk_points(folder / "g.vti", 3).value();
        ASSERT_EQ(own.size(), 3 * points);
        for (std::size_t i = 0; i < points; ++i) {
            for (std::size_t k = 0; k < 3; ++k)
                ASSERT_EQ(own[3 * i + k], image->GetPoint(static_cast<vtkIdType>(i))[k]);
        }
    }
}

}  // namespace
}  // namespace barycert::testing
