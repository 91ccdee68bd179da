/// Files that VTK wrote, damaged: a mesh or an error, never a crash, nothing printed.
#include <vtkXMLUnstructuredGridWriter.h>

#include "barycert/gmsh_files.hpp"
#include "barycert/mesh_files.hpp"
#include "barycert/plc_files.hpp"
#include "barycert/point_files.hpp"
#include "barycert/series.hpp"
#include "barycert/surface_files.hpp"
#include "barycert/table_files.hpp"
#include "barycert/tetgen_files.hpp"
#include "barycert/vtk_files.hpp"
#include "core/base/random.hpp"
#include "tests/io/vtk/good_files.hpp"
#include "tests/io/vtk/mixed_grid.hpp"
#include "tests/io/vtk/vtk_files.hpp"

namespace barycert::testing {
namespace {

/// Files of every kind, cut off or with bytes changed: a mesh or an error.
TEST(BadVtkFiles, NoDamageCrashes) {
    const TemporaryFolder folder;
    std::vector<std::string> files{xml, legacy};
    for (const int mode : {vtkXMLWriter::Ascii, vtkXMLWriter::Binary, vtkXMLWriter::Appended}) {
        for (const int compressor : {vtkXMLWriter::NONE, vtkXMLWriter::ZLIB, vtkXMLWriter::LZ4, vtkXMLWriter::LZMA}) {
            vtkNew<vtkXMLUnstructuredGridWriter> writer;
            writer->SetDataMode(mode);
            writer->SetEncodeAppendedData(compressor == vtkXMLWriter::LZ4 ? 1 : 0);
            writer->SetCompressorType(compressor);
            writer->SetBlockSize(64);
            writer->SetFileName((folder / "m").c_str());
            writer->SetInputData(mixed_grid());
            ASSERT_EQ(writer->Write(), 1);
            files.push_back(get(folder / "m"));
        }
    }
    for (const char* name : {"a.vtk", "b.vtk"}) {
        ASSERT_TRUE(write_vtk(mesh_of_data("plate"), folder / name));
        files.push_back(get(folder / name));
    }
    base::Random random(4);
    std::size_t refused = 0, tried = 0;
    Printed printed;
    for (const std::string& file : files) {
        for (int i = 0; i < 400; ++i) {
            std::string text = file;
            if (i % 4 == 0) {
                text.resize(random.below(text.size()));
            } else if (i % 4 == 1) {  // a digit: counts, offsets, types
                std::size_t at = random.below(text.size());
                while (at < text.size() && (text[at] < '0' || text[at] > '9')) ++at;
                if (at < text.size()) text[at] = static_cast<char>('0' + random.below(10));
            } else {
                for (std::uint64_t k = 1 + random.below(4); k != 0; --k) {
                    text[random.below(text.size())] = static_cast<char>(random.below(256));
                }
            }
            put(folder / "m", text);
            ++tried;
            if (const Result<Mesh> read = read_vtk(folder / "m"); !read) {
                ++refused;
                EXPECT_EQ(read.error().file, folder / "m");
                EXPECT_FALSE(read.error().what.empty());
            }
            (void)read_vtk_points(folder / "m", 2 + i % 2).has_value();
        }
    }
    EXPECT_EQ(printed.text(), "");
    EXPECT_GT(refused, tried / 4);
    EXPECT_LT(refused, tried);
}

}  // namespace
}  // namespace barycert::testing
