#include "barycert/io/vtk/codec.hpp"

#include <libdeflate.h>
#include <lz4.h>
#include <lzma.h>

#include <limits>
#include <memory>
#include <new>

namespace barycert::io {
namespace {

bool fits_int(std::size_t size) {
    return size <= static_cast<std::size_t>(std::numeric_limits<int>::max());
}

}  // namespace

bool unpack(Compressor compressor, std::string_view packed, char* to, std::size_t size) {
    switch (compressor) {
        case Compressor::zlib: {
            const std::unique_ptr<libdeflate_decompressor, void (*)(libdeflate_decompressor*)> own(
                libdeflate_alloc_decompressor(), libdeflate_free_decompressor);
            if (own == nullptr) throw std::bad_alloc();
            return libdeflate_zlib_decompress(own.get(), packed.data(), packed.size(), to, size, nullptr) ==
                   LIBDEFLATE_SUCCESS;
        }
        case Compressor::lz4:
            return fits_int(packed.size()) && fits_int(size) &&
                   static_cast<std::size_t>(LZ4_decompress_safe(packed.data(), to, static_cast<int>(packed.size()),
                                                                static_cast<int>(size))) == size;
        case Compressor::lzma: {
            // Level 9 takes 65 MiB; a damaged header may ask for gigabytes.
            std::uint64_t memory = std::uint64_t{128} << 20U;
            std::size_t read = 0, filled = 0;
            const lzma_ret result =
                lzma_stream_buffer_decode(&memory, 0, nullptr, reinterpret_cast<const std::uint8_t*>(packed.data()),
                                          &read, packed.size(), reinterpret_cast<std::uint8_t*>(to), &filled, size);
            return result == LZMA_OK && filled == size;
        }
        default:
            return false;
    }
}

std::string pack(Compressor compressor, std::string_view plain) {
    std::string packed;
    std::size_t size = 0;
    bool good = false;
    switch (compressor) {
        case Compressor::zlib: {
            constexpr int level = 2;
            const std::unique_ptr<libdeflate_compressor, void (*)(libdeflate_compressor*)> own(
                libdeflate_alloc_compressor(level), libdeflate_free_compressor);
            if (own == nullptr) return {};
            packed.resize(libdeflate_zlib_compress_bound(own.get(), plain.size()));
            size = libdeflate_zlib_compress(own.get(), plain.data(), plain.size(), packed.data(), packed.size());
            good = size != 0;
            break;
        }
        case Compressor::lz4: {
            if (!fits_int(plain.size())) return {};
            packed.resize(static_cast<std::size_t>(LZ4_compressBound(static_cast<int>(plain.size()))));
            constexpr int acceleration = 5;  // speed before size
            const int filled = LZ4_compress_fast(plain.data(), packed.data(), static_cast<int>(plain.size()),
                                                 static_cast<int>(packed.size()), acceleration);
            good = filled > 0;
            size = static_cast<std::size_t>(filled);
            break;
        }
        case Compressor::lzma: {
            packed.resize(lzma_stream_buffer_bound(plain.size()));
            good = lzma_easy_buffer_encode(
                       1, LZMA_CHECK_CRC32, nullptr, reinterpret_cast<const std::uint8_t*>(plain.data()), plain.size(),
                       reinterpret_cast<std::uint8_t*>(packed.data()), &size, packed.size()) == LZMA_OK;
            break;
        }
        default:
            break;
    }
    packed.resize(good ? size : 0);
    return packed;
}

std::uint64_t max_unpacked(Compressor compressor, std::uint64_t packed) {
    // Deflate gives at most 1032 bytes for one (258 for two bits), LZ4 255. LZMA gives at most 273 bytes for a match,
    // which takes 14 binary decisions. A probability of 11 bits, moved by a 32nd of what is left, stays within 31 and
    // 2017 of 2048, so a decision leaves at most 2017/2048 + 2^-19 of the range: 0.0220 bits. 273 bytes for 0.308 bits
    // are 7,091 for a byte. Headers of chunks (2 MiB at most) pay for the bytes that the coder has ahead. 6,856 have
    // been reached.
    const std::uint64_t ratio = compressor == Compressor::zlib   ? 1040
                                : compressor == Compressor::lz4  ? 256
                                : compressor == Compressor::lzma ? 7200
                                                                 : std::numeric_limits<std::uint64_t>::max();
    std::uint64_t most = 0;
    return __builtin_mul_overflow(packed, ratio, &most) ? std::numeric_limits<std::uint64_t>::max() : most;
}

}  // namespace barycert::io
