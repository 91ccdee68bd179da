// Points of VTK's files with or without cells: grids (.vti, .vtr, .vts), polygon data, legacy files; told by the file
// itself. The first byte: the dimension, and what is read of the arrays.
#include "fuzz/files.hpp"
#include "fuzz/points_round_trip.hpp"
#include "fuzz/target.hpp"

namespace barycert::fuzz {

/// The points of image data take no room in the file: their number is bounded by that of the values, or where there are
/// none by nothing but the reader's own limit.
BARYCERT_FUZZ_TARGET(vtk_points, {std::size_t{16} << 20, std::size_t{1} << 14}) {
    static InputFile file("in.vti");
    static const std::string out = scratch_path("out.csv");
    const unsigned how = input.empty() ? 0 : static_cast<unsigned char>(input.front());
    if (!input.empty()) input.remove_prefix(1);
    PointOptions options;
    if ((how & 2) != 0) options.keep = {"all"};
    const std::string& path = file.put(input);
    read_and_write_points(path, (how & 1) != 0 ? 2 : 3, options, lines_of(input), out);
}

}  // namespace barycert::fuzz
