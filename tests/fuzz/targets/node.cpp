// Points in a .node file.
#include "fuzz/files.hpp"
#include "fuzz/points_round_trip.hpp"
#include "fuzz/target.hpp"

namespace barycert::fuzz {

BARYCERT_FUZZ_TARGET(node, {std::size_t{16} << 20, 256}) {
    static InputFile file("in.node");
    read_and_write_points(input, file);
}

}  // namespace barycert::fuzz
