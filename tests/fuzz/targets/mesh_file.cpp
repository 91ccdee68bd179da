// Any bytes under any name, given to what tells formats apart. The first byte: the suffix.
#include <array>

#include "barycert/gmsh_files.hpp"
#include "barycert/mesh_files.hpp"
#include "barycert/plc_files.hpp"
#include "barycert/point_files.hpp"
#include "barycert/series.hpp"
#include "barycert/surface_files.hpp"
#include "barycert/table_files.hpp"
#include "barycert/tetgen_files.hpp"
#include "barycert/vtk_files.hpp"
#include "tests/fuzz/files.hpp"
#include "tests/fuzz/same.hpp"
#include "tests/fuzz/target.hpp"

namespace barycert::fuzz {

BARYCERT_FUZZ_TARGET(mesh_file, {std::size_t{4} << 20, std::size_t{1} << 14}) {
    static std::array<InputFile, 10> files{
        InputFile("in"),      InputFile("in.msh"),  InputFile("in.vtu"), InputFile("in.inp"), InputFile("in.mesh"),
        InputFile("in.xdmf"), InputFile("in.cgns"), InputFile("in.stl"), InputFile("in.pvd"), InputFile("in.bdf")};
    const std::size_t which = input.empty() ? 0 : static_cast<unsigned char>(input.front()) % files.size();
    if (!input.empty()) input.remove_prefix(1);
    const std::string& path = files[which].put(input);
    mesh_files(path);
    const Result<Mesh> mesh = read_mesh(path, {.threads = 1});
    if (!mesh) expect_useful(mesh.error(), lines_of(input));
    if (mesh) expect_whole(*mesh);
    files[which].remove();
}

}  // namespace barycert::fuzz
