// Points of VTK's files with or without cells: grids (.vti, .vtr, .vts), polygon data, legacy files; told by the file
// itself.
#include <algorithm>
#include <array>
#include <cstdint>
#include <sstream>

#include "tests/fuzz/files.hpp"
#include "tests/fuzz/points_round_trip.hpp"
#include "tests/fuzz/target.hpp"

namespace barycert::fuzz {

/// The points of image data and of rectilinear grids stand in no array: their number is bounded by the machine's memory
/// alone, which is no matter of the fuzzer.
static bool has_large_extent(std::string_view input) {
    constexpr std::int64_t most_points = 10000;
    for (std::size_t at = input.find("Extent=\""); at != std::string_view::npos; at = input.find("Extent=\"", at + 1)) {
        std::array<std::int64_t, 6> extent{};
        std::istringstream text{std::string(input.substr(at + 8, 128))};
        for (std::int64_t& bound : extent) text >> bound;
        std::int64_t points = 1;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const std::int64_t low = std::clamp<std::int64_t>(extent[2 * axis], -most_points, most_points),
                               high = std::clamp<std::int64_t>(extent[2 * axis + 1], -most_points, most_points);
            points = std::min(points * std::max<std::int64_t>(1, high - low + 1), most_points + 1);
        }
        if (points > most_points) return true;
    }
    return false;
}

BARYCERT_FUZZ_TARGET(vtk_points, {std::size_t{16} << 20, std::size_t{1} << 14}) {
    static InputFile file("in.vti");
    if (!has_large_extent(input)) read_and_write_points(input, file);
}

}  // namespace barycert::fuzz
