/// VTK's XML files whose arrays are appended raw: what those of grids and of surfaces have in common.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "barycert/io/vti/vti.hpp"
#include "barycert/result.hpp"

namespace barycert::io {

/// Behind the last array.
inline constexpr std::string_view appended_tail = "\n  </AppendedData>\n</VTKFile>\n";

/// Bytes before each array: its size, an integer of 64 bits.
inline constexpr std::uint64_t appended_header = 8;

/// Before the arrays: their offsets count from behind the underscore.
inline constexpr std::string_view appended_begin = "  <AppendedData encoding=\"raw\">\n    _";

/// The first line, for a data set such as "ImageData". `compressor`: VTK's name of it; empty: none.
std::string vtk_file_head(std::string_view data_set, std::string_view compressor = {});

/// Bytes of a number.
std::uint64_t number_size(VtiType type);

/// The beginning of the element of an array: all but its format. Precondition: check_arrays passes it.
std::string array_begin(const VtiArray& array);

/// A line with the element of the array. Precondition: check_arrays passes it.
std::string array_element(const VtiArray& array, std::uint64_t offset);

/// Error: a name that is empty, there twice, or that XML cannot hold; fewer than one component.
Status check_arrays(const std::string& path, const std::vector<VtiArray>& arrays);

/// An error of what is to be written.
Error wrong_in_memory(const std::string& path, std::string what, std::string expected, std::string found);

}  // namespace barycert::io
