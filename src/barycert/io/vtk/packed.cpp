#include "barycert/io/vtk/packed.hpp"

#include <libdeflate.h>
#include <lz4.h>
#include <lzma.h>

#include <algorithm>
#include <limits>
#include <new>

#include "barycert/io/parallel.hpp"

namespace barycert::io {
namespace {

constexpr int base64_space = -1, base64_padding = -2, base64_other = -3;

/// What each character stands for.
constexpr std::array<std::int8_t, 256> base64_values = [] {
    std::array<std::int8_t, 256> table{};
    table.fill(base64_other);
    constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (std::size_t i = 0; i < digits.size(); ++i)
        table[static_cast<unsigned char>(digits[i])] = static_cast<std::int8_t>(i);
    for (const char c : {' ', '\t', '\n', '\r'}) table[static_cast<unsigned char>(c)] = base64_space;
    table['='] = base64_padding;
    return table;
}();

int base64_value(char c) {
    return base64_values[static_cast<unsigned char>(c)];
}

/// Whether all `quadruples` are digits, which give three bytes each.
bool decode_digits(const char* from, std::size_t quadruples, char* to) {
    int all = 0;
    for (std::size_t i = 0; i < quadruples; ++i, from += 4, to += 3) {
        const int a = base64_value(from[0]), b = base64_value(from[1]), c = base64_value(from[2]),
                  d = base64_value(from[3]);
        all |= a | b | c | d;
        const auto word = static_cast<std::uint32_t>(a << 18 | b << 12 | c << 6 | d);
        to[0] = static_cast<char>(word >> 16U);
        to[1] = static_cast<char>(word >> 8U);
        to[2] = static_cast<char>(word);
    }
    return all >= 0;
}

}  // namespace

char* ByteRoom::of(std::size_t size) {
    if (size_ < size) {
        bytes_.reset();
        bytes_ = std::make_unique_for_overwrite<char[]>(size);
        base::ask_for_large_pages(bytes_.get(), size);
        size_ = size;
    }
    return bytes_.get();
}

bool Encoded::next_quadruple() {
    std::uint32_t word = 0;
    int digits = 0, pads = 0;
    std::size_t at = 0;
    for (; digits + pads < 4 && at < left_.size(); ++at) {
        const int value = base64_value(left_[at]);
        if (value == base64_space) continue;
        if (value == base64_padding) {
            ++pads;
        } else if (value == base64_other || pads != 0) {
            break;
        } else {
            word = word << 6U | static_cast<std::uint32_t>(value);
            ++digits;
        }
    }
    if (digits + pads < 4 || digits < 2) {
        left_ = {};
        return false;
    }
    left_.remove_prefix(at);
    word <<= 6 * static_cast<unsigned>(pads);
    for (std::size_t i = 0; i < 3; ++i) bytes_[i] = static_cast<char>(word >> (16 - 8 * i));
    first_ = 0;
    held_ = static_cast<std::size_t>(3 - pads);
    return true;
}

/// Whole quadruples without white space, on all threads; the bytes of those before the first that is none.
std::size_t Encoded::take_quadruples(char* to, std::size_t count) {
    constexpr std::size_t part = std::size_t{1} << 16;
    const std::size_t wanted = std::min(count / 3, left_.size() / 4);
    const std::size_t good = first_bad(wanted, part, [&](std::size_t first, std::size_t last) {
        return decode_digits(left_.data() + 4 * first, last - first, to + 3 * first) ? last : first;
    });
    left_.remove_prefix(4 * good);
    return 3 * good;
}

std::string_view Encoded::take_as_they_stand(std::size_t count) {
    const std::string_view taken = left_.substr(0, count);
    left_.remove_prefix(count);
    return taken;
}

std::optional<std::string_view> Encoded::take(std::uint64_t count, ByteRoom& room) {
    if (count > left()) return std::nullopt;
    const auto size = static_cast<std::size_t>(count);
    if (!base64_) {
        const std::string_view taken = take_as_they_stand(size);
        if (!is_unread()) return taken;
        read_part_(taken, room.of(size));
        return std::string_view(room.of(size), size);
    }
    char* const to = room.of(size);
    bool quick = true;
    for (std::size_t done = 0; done < size;) {
        if (quick && held_ == 0) {
            const std::size_t got = take_quadruples(to + done, size - done);
            quick = got >= 3 * (std::size_t{1} << 14);  // lines of text: one after the other from here on
            done += got;
            if (done == size) break;
        }
        if (held_ == 0 && !next_quadruple()) return std::nullopt;
        const std::size_t step = std::min(size - done, held_);
        std::copy_n(bytes_ + first_, step, to + done);
        first_ += step;
        held_ -= step;
        done += step;
    }
    return std::string_view(to, size);
}

bool unpack(Compressor compressor, std::string_view packed, char* to, std::size_t size) {
    if (compressor == Compressor::zlib) {
        const std::unique_ptr<libdeflate_decompressor, void (*)(libdeflate_decompressor*)> own(
            libdeflate_alloc_decompressor(), libdeflate_free_decompressor);
        if (own == nullptr) throw std::bad_alloc();
        return libdeflate_zlib_decompress(own.get(), packed.data(), packed.size(), to, size, nullptr) ==
               LIBDEFLATE_SUCCESS;
    }
    if (compressor == Compressor::lz4)
        return std::in_range<int>(packed.size()) && std::in_range<int>(size) &&
               static_cast<std::size_t>(LZ4_decompress_safe(packed.data(), to, static_cast<int>(packed.size()),
                                                            static_cast<int>(size))) == size;
    if (compressor != Compressor::lzma) return false;
    // Level 9 takes 65 MiB; a damaged header may ask for gigabytes.
    std::uint64_t memory = std::uint64_t{128} << 20U;
    std::size_t read = 0, filled = 0;
    const lzma_ret result =
        lzma_stream_buffer_decode(&memory, 0, nullptr, reinterpret_cast<const std::uint8_t*>(packed.data()), &read,
                                  packed.size(), reinterpret_cast<std::uint8_t*>(to), &filled, size);
    return result == LZMA_OK && filled == size;
}

std::string pack(Compressor compressor, std::string_view plain) {
    std::string packed;
    std::size_t size = 0;
    if (compressor == Compressor::zlib) {
        constexpr int level = 2;
        const std::unique_ptr<libdeflate_compressor, void (*)(libdeflate_compressor*)> own(
            libdeflate_alloc_compressor(level), libdeflate_free_compressor);
        if (own == nullptr) return {};
        packed.resize(libdeflate_zlib_compress_bound(own.get(), plain.size()));
        size = libdeflate_zlib_compress(own.get(), plain.data(), plain.size(), packed.data(), packed.size());
    } else if (compressor == Compressor::lz4 && std::in_range<int>(plain.size())) {
        packed.resize(static_cast<std::size_t>(LZ4_compressBound(static_cast<int>(plain.size()))));
        constexpr int acceleration = 5;  // speed before size
        size = static_cast<std::size_t>(
            std::max(0, LZ4_compress_fast(plain.data(), packed.data(), static_cast<int>(plain.size()),
                                          static_cast<int>(packed.size()), acceleration)));
    } else if (compressor == Compressor::lzma) {
        packed.resize(lzma_stream_buffer_bound(plain.size()));
        if (lzma_easy_buffer_encode(1, LZMA_CHECK_CRC32, nullptr, reinterpret_cast<const std::uint8_t*>(plain.data()),
                                    plain.size(), reinterpret_cast<std::uint8_t*>(packed.data()), &size,
                                    packed.size()) != LZMA_OK)
            size = 0;
    }
    packed.resize(size);
    return packed;
}

std::uint64_t max_unpacked(Compressor compressor, std::uint64_t packed) {
    // Deflate gives at most 1032 bytes for one (258 for two bits), LZ4 255. LZMA gives at most 273 bytes for a match,
    // which takes 14 binary decisions. A probability of 11 bits, moved by a 32nd of what is left, stays within 31 and
    // 2017 of 2048, so a decision leaves at most 2017/2048 + 2^-19 of the range: 0.0220 bits. 273 bytes for 0.308 bits
    // are 7,091 for a byte. Headers of chunks (2 MiB at most) pay for the bytes that the coder has ahead. 6,856 have
    // been reached.
    constexpr std::uint64_t all = std::numeric_limits<std::uint64_t>::max();
    constexpr std::array<std::uint64_t, 4> ratios{all, 1040, 256, 7200};
    std::uint64_t most = 0;
    return __builtin_mul_overflow(packed, ratios[static_cast<std::size_t>(compressor)], &most) ? all : most;
}

}  // namespace barycert::io
