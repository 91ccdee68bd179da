// Points in CSV.
#include "tests/fuzz/files.hpp"
#include "tests/fuzz/points_round_trip.hpp"
#include "tests/fuzz/target.hpp"

namespace barycert::fuzz {

/// Lines are gathered in buffers that are handed over whole.
BARYCERT_FUZZ_TARGET(csv, {std::size_t{16} << 20, 256}) {
    static InputFile file("in.csv");
    read_and_write_points(input, file);
}

}  // namespace barycert::fuzz
