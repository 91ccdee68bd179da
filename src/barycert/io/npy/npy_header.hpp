/// The header of an NPY file. Its format: numpy.org/doc/stable/reference/generated/numpy.lib.format.html
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "barycert/result.hpp"

namespace barycert::io {

/// Where an NPY file keeps the sizes: 6 bytes of magic, 2 of version, then the length of the text in 2 or 4 bytes.
inline constexpr std::string_view npy_magic = "\x93NUMPY";
inline constexpr std::size_t npy_head = 12;

/// The text of a header is at most this long: more has no meaning for an array of numbers.
inline constexpr std::size_t longest_npy_text = std::size_t{1} << 20;

struct NpyHeader {
    std::string descr;  ///< the type as it stands there: <f8; of a structured type the list
    bool structured = false;
    bool fortran_order = false;
    std::vector<std::uint64_t> shape;
};

/// The place and length of the text of the header: where it begins, and how many bytes it has.
struct NpyText {
    std::size_t offset = 0;
    std::size_t size = 0;
    bool latin1 = false;  ///< else in UTF-8
};

/// From the first npy_head bytes of the file, or all of them. Errors: not an NPY file, another version.
Result<NpyText> find_npy_text(std::string_view head, const std::string& file);

/// Latin-1 text in UTF-8.
std::string utf8_of_latin1(std::string_view text);

/// From the text of the header: a Python dictionary of descr, fortran_order and shape.
Result<NpyHeader> parse_npy_text(std::string_view text, const std::string& file);

}  // namespace barycert::io
