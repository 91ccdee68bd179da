/// Blocks of bytes, compressed.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace barycert::io {

enum class Compressor : std::uint8_t { none, zlib, lz4, lzma };  ///< in the order of VtkData

/// As files name them.
inline constexpr std::array<std::string_view, 4> compressor_names{"", "vtkZLibDataCompressor", "vtkLZ4DataCompressor",
                                                                  "vtkLZMADataCompressor"};

/// Fills `size` bytes from those of a block. False if it gives fewer, or is damaged.
bool unpack(Compressor compressor, std::string_view packed, char* to, std::size_t size);

/// The block compressed; empty where memory is short.
std::string pack(Compressor compressor, std::string_view plain, int zlib_level = 2);

/// No block of that size unpacks to more: a header that says so lies.
std::uint64_t max_unpacked(Compressor compressor, std::uint64_t packed);

}  // namespace barycert::io
