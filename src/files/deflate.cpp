#include "files/deflate.hpp"

#include <libdeflate.h>

#include <memory>
#include <string>
#include <string_view>

namespace barycert::base {

std::string deflated(std::string_view plain, int level) {
    const std::unique_ptr<libdeflate_compressor, void (*)(libdeflate_compressor*)> own(
        libdeflate_alloc_compressor(level), libdeflate_free_compressor);
    if (own == nullptr) return {};
    std::string packed(libdeflate_zlib_compress_bound(own.get(), plain.size()), '\0');
    packed.resize(libdeflate_zlib_compress(own.get(), plain.data(), plain.size(), packed.data(), packed.size()));
    return packed;
}

}  // namespace barycert::base
