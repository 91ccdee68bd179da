/// Fields of a line of text, read fast and strictly.
///
/// Enters: a pointer into a MappedFile, whose bytes are followed by NULs; so no step compares with the end.
/// Leaves: the value, and the pointer moved over the field. A function that fails says so and no more: why a row is
/// bad is found out by row_errors.cpp, slowly and once.
///
/// integer   = [+|-] (0 | 1-9 {0-9})       leading zeros are refused: TetGen takes 010 for octal 8
/// real      = [+|-] decimal, [e|E exponent]; finite
/// separator = blanks [, blanks], not empty; blank = space or tab
/// row end   = blanks, then LF, CR LF, or a comment from # to the end of the line. A row that stops at the end of the
///             file is refused, for "0.2" may be the beginning of "0.25".
#pragma once

#include <fast_float/fast_float.h>

#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <system_error>

#ifdef __SSE2__
#include <emmintrin.h>
#endif

namespace barycert::io {

inline bool is_blank(char c) {
    return c == ' ' || c == '\t';
}
inline bool is_digit(char c) {
    return static_cast<unsigned char>(c - '0') < 10;
}

/// Any integer of 64 bits; out of line because most fit in the fast path below.
[[gnu::noinline, gnu::cold]] inline const char* scan_integer_slowly(const char* at, std::int64_t& value) {
    const bool plus = *at == '+';
    const char* const digits = at + (plus || *at == '-' ? 1 : 0);
    if (!is_digit(*digits) || (*digits == '0' && is_digit(digits[1]))) return nullptr;
    constexpr int more_than_fit = 32;
    const auto [after, error] = std::from_chars(plus ? digits : at, digits + more_than_fit, value);
    return error == std::errc{} ? after : nullptr;
}

/// Eight characters '0', as one word.
inline constexpr std::uint64_t zero_digits = 0x3030303030303030U;

/// The number whose eight decimal digits are the bytes of a little-endian word, first digit first.
inline std::uint32_t value_of_digits(std::uint64_t digits) {
    digits = digits * 10 + (digits >> 8);  // pairs of digits, in every second byte
    digits = (digits & 0x000000ff000000ffU) * 0x000f424000000064U +
             ((digits >> 16) & 0x000000ff000000ffU) * 0x0000271000000001U;
    return static_cast<std::uint32_t>(digits >> 32);
}

/// The place after the integer at `at`, or nullptr.
inline const char* scan_integer(const char* at, std::int64_t& value) {
    if constexpr (std::endian::native == std::endian::little) {
        // Eight bytes at once. A byte of `digits` is 0..9 where the text has a digit. Adding 0x76 lifts anything else
        // to the top bit; a carry reaches only bytes after the first such byte, which do not matter.
        std::uint64_t digits = 0;
        std::memcpy(&digits, at, 8);
        digits ^= zero_digits;
        const std::uint64_t others = ((digits + 0x7676767676767676U) | digits) & 0x8080808080808080U;
        const int bits = std::countr_zero(others) & ~7;  // 8 * number of leading digits
        const bool plain = bits != 0 && bits != 64 && ((digits & 0xff) != 0 || bits == 8);
        if (plain) [[likely]] {
            digits <<= 64 - bits;  // the last digit into the last byte, zeros before it
            value = value_of_digits(digits);
            return at + bits / 8;
        }
    }
    return scan_integer_slowly(at, value);
}

/// The place after the number at `at`, or nullptr; `end` is the end of the file.
inline const char* scan_real(const char* at, const char* end, double& value) {
    if (*at == '+') {
        ++at;
        if (*at == '-') return nullptr;
    }
    const auto [after, error] = fast_float::from_chars(at, end, value);
    // Underflow is rounding, and no error; infinities and NaNs, written or by overflow, are errors.
    return error == std::errc::invalid_argument || !std::isfinite(value) ? nullptr : after;
}

/// The same for nan, inf and infinity as they are written, in any case: not for what is too large.
inline const char* scan_nonfinite(const char* at, const char* end, double& value) {
    if (scan_real(at, end, value) != nullptr || (*at == '+' && at[1] == '-')) return nullptr;
    const char* const first = at + (*at == '+' ? 1 : 0);
    if (is_digit(*first) || *first == '.' || (*first == '-' && (is_digit(first[1]) || first[1] == '.'))) return nullptr;
    const auto [after, error] = fast_float::from_chars(first, end, value);
    return error == std::errc{} ? after : nullptr;
}

struct Complaint {
    std::string expected, remedy;
};

/// Returns the complaint about a field that scan_real() refuses. `finite`: the remedy for nan and inf; `separators`:
/// the remedy where nothing is known.
Complaint about_real(std::string_view field, const std::string& finite, const std::string& separators);

/// A place in the text, moved by each success and left near the fault by a failure.
struct Scanner {
    const char* at;
    const char* end;  ///< of the file

    void skip_blanks() {
        while (is_blank(*at)) ++at;
    }

    void skip_line() {
        const void* const feed = std::memchr(at, '\n', static_cast<std::size_t>(end - at));
        at = feed == nullptr ? end : static_cast<const char*>(feed) + 1;
    }

    /// Moves over blank and comment lines to the first field of a row that starts before `stop`; false if none does.
    bool next_row(const char* stop) {
        while (true) {
            skip_blanks();
            if (at >= stop) return false;
            if (*at == '#') {
                skip_line();
            } else if (*at == '\n' || (*at == '\r' && (at[1] == '\n' || at + 1 == end))) {
                ++at;
            } else {
                return true;
            }
        }
    }

    bool end_row() {
        skip_blanks();
        if (*at == '\n') [[likely]] {
            ++at;
            return true;
        }
        if (*at == '\r' && at + 1 < end && at[1] != '\n') return false;
        if (*at != '\r' && *at != '#') return false;
        skip_line();
        return true;
    }

    bool separator() {
        const char* const start = at;
        skip_blanks();
        if (*at == ',') {
            ++at;
            skip_blanks();
        }
        return at != start;
    }

    bool integer(std::int64_t& value) { return move_to(scan_integer(at, value)); }
    bool real(double& value) { return move_to(scan_real(at, end, value)); }
    bool nonfinite(double& value) { return move_to(scan_nonfinite(at, end, value)); }

private:
    bool move_to(const char* after) {
        if (after == nullptr) return false;
        at = after;
        return true;
    }
};

// The commonest row of all, read 64 bytes at once: a few small integers and blanks between them.
//
// One after the other, each integer's place is known only when the one before it has been read, and that wait is most
// of the time. Here bit masks over the whole row give all places at once. Where the row is not as plain as assumed,
// the answer is "don't know" (nullptr) and the general scanner reads it.

/// At most 8 bytes of a text, as one word.
struct FewBytes {
    std::uint64_t bytes = 0, mask = 0;  ///< mask 0: none
};

#ifdef __SSE2__

/// Number of the lowest set bit. Requires: there is one (std::countr_zero would spend time on asking).
inline int lowest_bit(std::uint64_t mask) {
    return __builtin_ctzll(mask);
}

/// Which of 64 bytes are what, up to the block of 16 with the first LF; the bit of a byte is its number.
struct ByteMasks {
    std::uint64_t digits = 0, zeros = 0, spaces = 0, feeds = 0;

    explicit ByteMasks(const char* bytes) {
        for (int i = 0; i < 4 && feeds == 0; ++i) {
            const __m128i block = _mm_loadu_si128(reinterpret_cast<const __m128i*>(bytes) + i);
            const __m128i code = _mm_sub_epi8(block, _mm_set1_epi8('0'));
            add(digits, _mm_cmpeq_epi8(_mm_min_epu8(code, _mm_set1_epi8(9)), code), i);
            add(zeros, _mm_cmpeq_epi8(block, _mm_set1_epi8('0')), i);
            add(spaces, _mm_cmpeq_epi8(block, _mm_set1_epi8(' ')), i);
            add(feeds, _mm_cmpeq_epi8(block, _mm_set1_epi8('\n')), i);
        }
    }

private:
    static void add(std::uint64_t& mask, __m128i bytes, int block) {
        mask |= std::uint64_t{static_cast<std::uint32_t>(_mm_movemask_epi8(bytes))} << (16 * block);
    }
};

/// As plain_row_end(), of exactly Count integers of at most 8 digits, which it reads.
template <std::size_t Count>
const char* scan_plain_row(const char* at, std::array<std::uint32_t, Count>& values) {
    const ByteMasks masks(at);
    if (masks.feeds == 0) return nullptr;
    const std::uint64_t row = (masks.feeds & (~masks.feeds + 1)) - 1;  // the bytes before the first LF
    const std::uint64_t digits = masks.digits & row;
    std::uint64_t starts = digits & ~(digits << 1);
    std::uint64_t ends = (digits << 1) & ~digits;
    if (((digits | masks.spaces) & row) != row) return nullptr;
    if ((starts & masks.zeros & (digits >> 1)) != 0) return nullptr;  // a leading zero
    for (std::size_t i = 0; i < Count; ++i) {
        if (starts == 0) return nullptr;
        const int start = lowest_bit(starts);
        const int length = lowest_bit(ends) - start;
        if (length > 8) return nullptr;
        starts &= starts - 1;
        ends &= ends - 1;
        std::uint64_t text = 0;
        std::memcpy(&text, at + start, 8);
        values[i] = value_of_digits((text ^ zero_digits) << (64 - 8 * length));
    }
    if (starts != 0) return nullptr;
    return at + lowest_bit(masks.feeds) + 1;
}

/// The place after the LF of a row of that many numbers from 0 on, separated by spaces and ended within 64 bytes, with
/// these bytes behind the first of them; nullptr for any other row. Requires: 72 bytes can be read.
inline const char* plain_row_end(const char* at, std::size_t count, const FewBytes& second) {
    const ByteMasks masks(at);
    if (masks.feeds == 0) return nullptr;
    const std::uint64_t row = (masks.feeds & (~masks.feeds + 1)) - 1;
    const std::uint64_t digits = masks.digits & row, ends = (digits << 1) & ~digits;
    if (((digits | masks.spaces) & row) != row || ends == 0) return nullptr;
    std::uint64_t bytes = 0;
    std::memcpy(&bytes, at + lowest_bit(ends), 8);
    if (((bytes ^ second.bytes) & second.mask) != 0) return nullptr;
    for (std::uint64_t starts = digits & ~(digits << 1); starts != 0; starts &= starts - 1) --count;
    return count == 0 ? at + lowest_bit(masks.feeds) + 1 : nullptr;
}

#else

inline const char* plain_row_end(const char*, std::size_t, const FewBytes&) {
    return nullptr;
}

template <std::size_t Count>
const char* scan_plain_row(const char*, std::array<std::uint32_t, Count>&) {
    return nullptr;
}

#endif

}  // namespace barycert::io
