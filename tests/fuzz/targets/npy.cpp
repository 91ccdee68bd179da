// Points in NPY. The first byte: the dimension, and what is read of the columns.
#include <array>

#include "fuzz/files.hpp"
#include "fuzz/points_round_trip.hpp"
#include "fuzz/target.hpp"

namespace barycert::fuzz {

BARYCERT_FUZZ_TARGET(npy, {std::size_t{16} << 20, 256}) {
    static InputFile file("in.npy");
    static const std::array<std::string, 3> out{scratch_path("out.csv"), scratch_path("out.npy"),
                                                scratch_path("out.vtu")};
    const unsigned how = input.empty() ? 0 : static_cast<unsigned char>(input.front());
    if (!input.empty()) input.remove_prefix(1);
    PointOptions options;
    if ((how & 2) != 0) options.keep = {"all"};
    if ((how & 8) != 0) options.columns = {(how & 1) != 0 ? "1,2" : "2,1,3"};
    if ((how & 16) != 0) options.keep = {"new=a", "b"};
    const std::string& path = file.put(input);
    read_and_write_points(path, (how & 1) != 0 ? 2 : 3, options, lines_of(input), out[(how >> 5) % out.size()]);
}

}  // namespace barycert::fuzz
