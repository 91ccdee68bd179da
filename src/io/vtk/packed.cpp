#include "io/vtk/packed.hpp"

#include <libdeflate.h>
#include <lz4.h>
#include <lzma.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <new>
#include <string>
#include <string_view>
#include <utility>

#include "barycert/table.hpp"
#include "files/deflate.hpp"

namespace barycert::io {
bool unpack(VtkData compressor, std::string_view packed, char* to, std::size_t size) {
    if (compressor == VtkData::zlib) {
        const std::unique_ptr<libdeflate_decompressor, void (*)(libdeflate_decompressor*)> own(
            libdeflate_alloc_decompressor(), libdeflate_free_decompressor);
        if (own == nullptr) throw std::bad_alloc();
        return libdeflate_zlib_decompress(own.get(), packed.data(), packed.size(), to, size, nullptr) ==
               LIBDEFLATE_SUCCESS;
    }
    if (compressor == VtkData::lz4)
        return std::in_range<int>(packed.size()) && std::in_range<int>(size) &&
               static_cast<std::size_t>(LZ4_decompress_safe(packed.data(), to, static_cast<int>(packed.size()),
                                                            static_cast<int>(size))) == size;
    if (compressor != VtkData::lzma) return false;
    // Level 9 takes 65 MiB; a damaged header may ask for gigabytes.
    std::uint64_t memory = std::uint64_t{128} << 20U;
    std::size_t read = 0, filled = 0;
    const lzma_ret result =
        lzma_stream_buffer_decode(&memory, 0, nullptr, reinterpret_cast<const std::uint8_t*>(packed.data()), &read,
                                  packed.size(), reinterpret_cast<std::uint8_t*>(to), &filled, size);
    return result == LZMA_OK && filled == size;
}

std::string pack(VtkData compressor, std::string_view plain, int zlib_level) {
    if (compressor == VtkData::zlib) return base::deflated(plain, zlib_level);
    std::string packed;
    std::size_t size = 0;
    if (compressor == VtkData::lz4 && std::in_range<int>(plain.size())) {
        packed.resize(static_cast<std::size_t>(LZ4_compressBound(static_cast<int>(plain.size()))));
        constexpr int acceleration = 5;  // speed before size
        size = static_cast<std::size_t>(
            std::max(0, LZ4_compress_fast(plain.data(), packed.data(), static_cast<int>(plain.size()),
                                          static_cast<int>(packed.size()), acceleration)));
    } else if (compressor == VtkData::lzma) {
        packed.resize(lzma_stream_buffer_bound(plain.size()));
        if (lzma_easy_buffer_encode(1, LZMA_CHECK_CRC32, nullptr, reinterpret_cast<const std::uint8_t*>(plain.data()),
                                    plain.size(), reinterpret_cast<std::uint8_t*>(packed.data()), &size,
                                    packed.size()) != LZMA_OK)
            size = 0;
    }
    packed.resize(size);
    return packed;
}

std::uint64_t max_unpacked(VtkData compressor, std::uint64_t packed) {
    // Deflate gives at most 1032 bytes for one (258 for two bits), LZ4 255. LZMA gives at most 273 bytes for a match,
    // which takes 14 binary decisions. A probability of 11 bits, moved by a 32nd of what is left, stays within 31 and
    // 2017 of 2048, so a decision leaves at most 2017/2048 + 2^-19 of the range: 0.0220 bits. 273 bytes for 0.308 bits
    // are 7,091 for a byte. Headers of chunks (2 MiB at most) pay for what the coder has ahead. Reached: 6,856.
    constexpr std::uint64_t all = std::numeric_limits<std::uint64_t>::max();
    constexpr std::array<std::uint64_t, 4> ratios{all, 1040, 256, 7200};
    std::uint64_t most = 0;
    return __builtin_mul_overflow(packed, ratios[static_cast<std::size_t>(compressor)], &most) ? all : most;
}

}  // namespace barycert::io
