/// VTK's VTI files (XML, image data): arrays at the points of a regular grid, written block by block, without VTK.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "barycert/result.hpp"
#include "barycert/table.hpp"
#include "files/output_file.hpp"
#include "files/spool.hpp"
#include "io/vtk/out_file.hpp"

namespace barycert::io {

/// The points origin + (i, j, k) * spacing, i running fastest. A grid in the plane has counts[2] = 1.
struct VtiGrid {
    std::array<std::int64_t, 3> counts{1, 1, 1};  ///< points along each axis, 1 to 2^31 - 1
    std::array<double, 3> origin{0, 0, 0};
    std::array<double, 3> spacing{1, 1, 1};  ///< > 0; along an axis of one point 0 stands for 1
};

/// A file whose arrays are handed over in blocks of any size, each array from its first point to its last; arrays may
/// take turns. Nothing but 256 KiB is held in memory, so that a file may be larger than memory. Numbers read back to
/// the same bits; blocks do not show in the file.
///
/// The file appears whole on commit(), or not at all. Arrays that take turns go to their places block by block; on a
/// pipe they must stand in their order. Data that are not raw are kept in nameless files up to the commit.
class VtiWriter {
public:
    /// Requires: counts, origin and spacing are as said. Error: what check_arrays refuses; more than 2^63 bytes.
    static Result<std::unique_ptr<VtiWriter>> open(const std::string& path, const VtiGrid& grid,
                                                   const std::vector<ArrayFormat>& arrays, VtkData data = VtkData::raw);

    /// The next bytes of arrays[array], as in memory. Error: more bytes than it has; on a pipe, not its turn.
    Status write(std::size_t array, std::span<const std::byte> bytes);

    /// Error: an array has not got all its bytes; the file cannot be written.
    Status commit();

private:
    struct ArrayPlace {
        std::uint64_t begin = 0;  // of its header in the file
        std::uint64_t done = 0;   // bytes handed over
        base::Spool bytes;        // these, where data are not raw
    };
    VtiWriter(const std::string& path, OutFile layout, VtkData data)
        : path_(path), data_(data), layout_(std::move(layout)), file_(path) {}
    std::vector<OutArray>& arrays() { return layout_.sections.front().arrays; }
    bool put(std::uint64_t at, std::string_view bytes);

    std::string path_;
    VtkData data_;
    OutFile layout_;  // without numbers
    std::vector<ArrayPlace> places_;
    std::uint64_t tail_ = 0;  // where the end of the XML goes
    std::uint64_t end_ = 0;   // of what was written in order
    base::OutputFile file_;
};

}  // namespace barycert::io
