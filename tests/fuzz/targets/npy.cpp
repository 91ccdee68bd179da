// Points in NPY.
#include "tests/fuzz/files.hpp"
#include "tests/fuzz/points_round_trip.hpp"
#include "tests/fuzz/target.hpp"

namespace barycert::fuzz {

BARYCERT_FUZZ_TARGET(npy, {std::size_t{16} << 20, 256}) {
    static InputFile file("in.npy");
    read_and_write_points(input, file);
}

}  // namespace barycert::fuzz
