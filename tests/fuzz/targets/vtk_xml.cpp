// A mesh in VTK's XML: .vtu and .vtp, which the file itself tells.
#include "tests/fuzz/files.hpp"
#include "tests/fuzz/target.hpp"
#include "tests/fuzz/vtk_round_trip.hpp"

namespace barycert::fuzz {

/// Zeros compress to a thousandth and less: a file holds what it does once it is decompressed.
BARYCERT_FUZZ_TARGET(vtk_xml, {std::size_t{4} << 20, std::size_t{1} << 14}) {
    static InputFile file("in.vtu");
    static const std::string out = scratch_path("out.vtu");
    const std::string& path = file.put(input);
    read_and_write_vtk(path, lines_of(input), out, static_cast<VtkData>(input.size() % vtk_data_names.size()));
}

}  // namespace barycert::fuzz
