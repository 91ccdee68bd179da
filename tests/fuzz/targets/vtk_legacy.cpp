// A mesh in VTK's legacy format, text or binary.
#include "tests/fuzz/files.hpp"
#include "tests/fuzz/target.hpp"
#include "tests/fuzz/vtk_round_trip.hpp"

namespace barycert::fuzz {

BARYCERT_FUZZ_TARGET(vtk_legacy) {
    static InputFile file("in.vtk");
    static const std::string out = scratch_path("out.vtk");
    const std::string& path = file.put(input);
    read_and_write_vtk(path, lines_of(input), out, input.size() % 2 == 0 ? VtkData::raw : VtkData::ascii);
}

}  // namespace barycert::fuzz
