/// Blocks of bytes, compressed.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "barycert/table.hpp"

namespace barycert::io {

/// As files name them; VtkData::raw is none.
inline constexpr std::array<std::string_view, 4> compressor_names{"", "vtkZLibDataCompressor", "vtkLZ4DataCompressor",
                                                                  "vtkLZMADataCompressor"};

/// Fills `size` bytes from those of a block. False if it gives fewer, or is damaged.
bool unpack(VtkData compressor, std::string_view packed, char* to, std::size_t size);

/// The block compressed; empty where memory is short.
std::string pack(VtkData compressor, std::string_view plain, int zlib_level = 2);

/// No block of that size unpacks to more: a header that says so lies.
std::uint64_t max_unpacked(VtkData compressor, std::uint64_t packed);

}  // namespace barycert::io
