#include "barycert/io/vtk/blocks.hpp"

#include <vtkLZ4DataCompressor.h>
#include <vtkLZMADataCompressor.h>
#include <vtkSmartPointer.h>
#include <vtkZLibDataCompressor.h>

#include <array>
#include <bit>
#include <cstring>

#include "barycert/io/vtk/messages.hpp"
#include "barycert/io/vtk/xml_arrays.hpp"

namespace barycert::io {
namespace {

vtkSmartPointer<vtkDataCompressor> make(Compressor compressor) {
    if (compressor == Compressor::lz4) return vtkSmartPointer<vtkLZ4DataCompressor>::New();
    if (compressor == Compressor::lzma) return vtkSmartPointer<vtkLZMADataCompressor>::New();
    return vtkSmartPointer<vtkZLibDataCompressor>::New();
}

}  // namespace

std::optional<std::uint64_t> read_header(ByteStream& stream, const XmlLayout& layout) {
    std::array<char, 8> bytes{};
    if (stream.read(bytes.data(), layout.header_bytes) != layout.header_bytes) return std::nullopt;
    const bool big = layout.swap_bytes != (std::endian::native == std::endian::big);
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < layout.header_bytes; ++i) {
        const char byte = bytes[big ? i : layout.header_bytes - 1 - i];
        value = value << 8U | static_cast<unsigned char>(byte);
    }
    return value;
}

BlockStream::BlockStream(std::unique_ptr<ByteStream> from, const XmlLayout& layout)
    : from_(std::move(from)), layout_(layout) {}

BlockStream::~BlockStream() = default;

std::string BlockStream::open() {
    const std::optional<std::uint64_t> blocks = read_header(*from_, layout_);
    const std::optional<std::uint64_t> block = read_header(*from_, layout_);
    const std::optional<std::uint64_t> last = read_header(*from_, layout_);
    const char* const cut_off = "the data end before their header does";
    if (!blocks || !block || !last || *blocks > from_->room() / layout_.header_bytes) return cut_off;
    block_ = *block;
    last_ = *last != 0 ? *last : block_;
    if (*blocks == 0) return {};
    if (last_ > block_ || __builtin_mul_overflow(*blocks - 1, block_, &size_) ||
        __builtin_add_overflow(size_, last_, &size_)) {
        return "a header of compressed blocks that contradicts itself";
    }
    for (std::uint64_t i = 0; i < *blocks; ++i) {
        const std::optional<std::uint64_t> compressed = read_header(*from_, layout_);
        if (!compressed) return cut_off;
        compressed_.push_back(*compressed);
    }
    return {};
}

bool BlockStream::next_block() {
    if (next_ == compressed_.size()) return false;
    const std::uint64_t size = compressed_[next_];
    if (size > from_->room()) return false;
    // Not initialised: pages that no data reach take no memory, whatever the header says.
    const auto packed = std::make_unique_for_overwrite<unsigned char[]>(size);
    if (from_->read(reinterpret_cast<char*>(packed.get()), size) != size) return false;
    const std::uint64_t plain = ++next_ == compressed_.size() ? last_ : block_;
    if (bytes_ == nullptr) bytes_ = std::make_unique_for_overwrite<char[]>(block_);
    Messages messages;
    const vtkSmartPointer<vtkDataCompressor> compressor = make(layout_.compressor);
    messages.listen_to(compressor);
    if (compressor->Uncompress(packed.get(), size, reinterpret_cast<unsigned char*>(bytes_.get()), plain) != plain ||
        !messages.first().empty()) {
        next_ = compressed_.size();
        return false;
    }
    first_ = 0;
    held_ = plain;
    return true;
}

std::size_t BlockStream::read(char* to, std::size_t count) {
    std::size_t done = 0;
    while (done < count) {
        if (held_ == 0 && !next_block()) break;
        const std::size_t step = std::min(count - done, held_);
        std::memcpy(to + done, &bytes_[first_], step);
        first_ += step;
        held_ -= step;
        done += step;
    }
    return done;
}

}  // namespace barycert::io
