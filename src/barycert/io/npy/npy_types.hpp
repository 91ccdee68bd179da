/// Numbers and texts as NPY files hold them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace barycert::io {

/// A type by the letter of its kind and its bytes: 'f' 2, 4, 8; 'i', 'u' 1, 2, 4, 8; 'b' 1 (booleans); 'S' bytes, 'U'
/// characters of 4 bytes; 'V' others, that are passed over.
struct NpyType {
    char kind = 'V';
    std::size_t size = 0;
    bool swapped = false;  ///< in the byte order that is not this machine's
    std::string text{};    ///< as it stands in the file

    bool is_integer() const { return kind == 'i' || kind == 'u' || kind == 'b'; }
    bool is_number() const { return kind == 'f' || is_integer(); }
    bool is_text() const { return kind == 'S' || kind == 'U'; }
};

/// Of a simple type such as <f8. Nothing where the size of an item is not known, or an item is a Python object.
std::optional<NpyType> npy_type(std::string_view descr);

/// The number at `at`; nothing if it is an integer that is no double. Precondition: is_number().
std::optional<double> npy_double(const char* at, const NpyType& type);

/// The integer at `at`; nothing if it is beyond int64. Precondition: is_integer().
std::optional<std::int64_t> npy_integer(const char* at, const NpyType& type);

/// The text at `at`, in UTF-8 if it is of characters, without the zeros at its end; nothing if one is no character.
/// Precondition: is_text().
std::optional<std::string> npy_text(const char* at, const NpyType& type);

/// Precondition: a code of Unicode, and no surrogate.
void append_utf8(std::string& text, std::uint32_t code);

/// Whether that many bytes hold the text, as characters or as bytes.
bool fits_npy_text(std::string_view text, std::size_t size, bool characters);

/// Writes the text into `size` bytes, with zeros behind it. Precondition: it fits.
void put_npy_text(char* at, std::size_t size, std::string_view text, bool characters);

}  // namespace barycert::io
