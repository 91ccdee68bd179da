/// The commonest row of all, read 64 bytes at once: a few small integers and blanks between them.
///
/// One after the other, each integer's place is known only when the one before it has been read, and that wait is most
/// of the time. Here bit masks over the whole row give all places at once. Where the row is not as plain as assumed,
/// the answer is "don't know" (nullptr) and the general scanner reads it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "barycert/io/tetgen/scanner.hpp"

#ifdef __SSE2__
#include <emmintrin.h>
#endif

namespace barycert::io {

/// At most 8 bytes of a text, as one word.
struct FewBytes {
    std::uint64_t bytes = 0, mask = 0;  ///< mask 0: none
};

#ifdef __SSE2__

/// Number of the lowest set bit. Precondition: there is one (std::countr_zero would spend time on asking).
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

/// Reads exactly Count integers of at most 8 digits, separated by spaces and ended by LF within 64 bytes; the place
/// after the LF, or nullptr for any other row. Precondition: 72 bytes can be read.
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
/// these bytes behind the first of them; nullptr for any other row. Precondition: 72 bytes can be read.
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
