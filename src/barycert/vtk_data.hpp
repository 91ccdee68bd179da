/// How the numbers of VTK's files are written.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace barycert {

enum class VtkData : std::uint8_t {
    raw,   ///< appended as they stand in memory: the fastest to write and to read
    zlib,  ///< appended in blocks, each compressed
    lz4,   ///< the same, faster and larger
    lzma,  ///< the same, slower and smaller
    ascii  ///< as text, for people: the shortest decimal form that reads back to the same bits
};

inline constexpr std::array<std::string_view, 5> vtk_data_names{"raw", "zlib", "lz4", "lzma", "ascii"};

constexpr std::string_view name(VtkData data) {
    return vtk_data_names[static_cast<std::size_t>(data)];
}

constexpr std::optional<VtkData> vtk_data_named(std::string_view name) {
    for (std::size_t i = 0; i < vtk_data_names.size(); ++i) {
        if (vtk_data_names[i] == name) return static_cast<VtkData>(i);
    }
    return std::nullopt;
}

}  // namespace barycert
