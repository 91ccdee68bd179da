/// The numbers of VTK files, of every type and in every encoding, as those that meshes hold.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace barycert::io {

enum class NumberType : std::uint8_t {
    bit,  ///< 8 a byte, the first in the highest bit
    int8,
    uint8,
    int16,
    uint16,
    int32,
    uint32,
    int64,
    uint64,
    float32,
    float64
};

/// Bytes of a number; 1 for bit.
std::size_t number_bytes(NumberType type);

/// Bytes that `count` numbers take; nothing if they do not fit in 64 bits.
std::optional<std::uint64_t> byte_count(NumberType type, std::uint64_t count);

/// What a number could not be.
struct NumberFault {
    enum class Kind : std::uint8_t {
        none,
        too_few,    ///< the data end before the last number
        no_number,  ///< text that is no number of that type
        not_exact,  ///< the number is not one of the type asked for
    };
    Kind kind = Kind::none;
    std::size_t index = 0;  ///< of the number, from 0
    std::string text;       ///< as it stands in the file

    explicit operator bool() const { return kind != Kind::none; }
};

/// Writes `count` numbers to `to`, whose type is double, std::int64_t, std::int32_t or std::uint8_t, from their bytes;
/// not those of type bit. Returns the first that is not exact (another number then stands there), or `count`.
template <class To>
std::size_t convert_numbers(std::string_view bytes, NumberType type, bool swap_bytes, std::size_t count, To* to);

/// Whether numbers of that type and order have the bytes of a `To`.
template <class To>
bool are_as_they_stand(NumberType type, bool swap_bytes);

/// That number `index` of those bytes is not exact.
NumberFault inexact_number(std::string_view bytes, NumberType type, bool swap_bytes, std::size_t index);

/// Appends `count` numbers to `values`, as convert_numbers does, of bytes that may be too few. Goes on after a number
/// that is not exact, so that what follows can be read. float32 becomes double exactly.
template <class To>
NumberFault read_binary(std::string_view bytes, NumberType type, bool swap_bytes, std::size_t count,
                        std::vector<To>& values);

/// The same from text, separated by white space; what has been read is taken off `text`. Decimal numbers are rounded to
/// the nearest of their type, as VTK does. Memory grows with what has been read.
template <class To>
NumberFault read_text(std::string_view& text, NumberType type, std::size_t count, std::vector<To>& values);

/// Takes the next word off `text`; empty at the end.
std::string_view next_word(std::string_view& text);

/// A count as XML attributes and headers give it: blanks around it, a plus before it. Nothing if it is none.
std::optional<std::uint64_t> parse_count(std::string_view text);

}  // namespace barycert::io
