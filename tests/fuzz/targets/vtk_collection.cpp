// Files that name files: .pvtu, .pvtp, .vtm, .vtpd, .pvd, .vtu.series; then what they may name: p0.vtu to p3.vtu, with
// form feeds between them.
#include <array>
#include <memory>

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
#include "tests/fuzz/target.hpp"
#include "tests/fuzz/vtk_round_trip.hpp"

namespace barycert::fuzz {

BARYCERT_FUZZ_TARGET(vtk_collection, {std::size_t{4} << 20, std::size_t{1} << 14}) {
    static InputFile file("in.pvtu");
    static std::array<InputFile, 4> pieces{InputFile("p0.vtu"), InputFile("p1.vtu"), InputFile("p2.vtu"),
                                           InputFile("p3.vtu")};
    static const std::string out = scratch_path("out.vtu");
    const std::size_t lines = lines_of(input);
    const std::string& path = file.put(next_part(input));
    for (InputFile& piece : pieces) {
        if (input.empty()) piece.remove();
        if (!input.empty()) piece.put(next_part(input));
    }
    const Result<std::vector<SeriesStep>> steps = read_series(path);
    if (!steps) expect_useful(steps.error(), lines);
    vtk_mesh_files(path);
    read_and_write_vtk(path, lines, out, VtkData::raw);
}

}  // namespace barycert::fuzz
