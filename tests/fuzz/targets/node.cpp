// Points in a .node file, which is read in pieces. The first byte: the dimension, and what is read of the columns.
#include "fuzz/files.hpp"
#include "fuzz/points_round_trip.hpp"
#include "fuzz/target.hpp"

namespace barycert::fuzz {

BARYCERT_FUZZ_TARGET(node, {std::size_t{16} << 20, 256}) {
    static InputFile file("in.node");
    static const std::string out = scratch_path("out.csv");
    const unsigned how = input.empty() ? 0 : static_cast<unsigned char>(input.front());
    if (!input.empty()) input.remove_prefix(1);
    PointOptions options;
    if ((how & 2) != 0) options.keep = {"all"};
    const std::string& path = file.put(input);
    read_and_write_points(path, (how & 1) != 0 ? 2 : 3, options, lines_of(input), out);
}

}  // namespace barycert::fuzz
