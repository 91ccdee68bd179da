/// Arrays that are compressed block by block.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "barycert/io/vtk/encoded.hpp"
#include "barycert/io/vtk/numbers.hpp"

namespace barycert::io {

struct XmlLayout;

/// The next integer of a header; nothing at the end of the data.
std::optional<std::uint64_t> read_header(Encoded& from, const XmlLayout& layout);

/// Header: number of blocks, bytes of a block, bytes of the last one if it is shorter (else 0), then the compressed
/// bytes of each block; then the blocks.
class BlockData {
public:
    BlockData(Encoded from, const XmlLayout& layout) : from_(from), layout_(layout) {}

    /// Reads the header; what is wrong with it, or empty.
    std::string open();
    /// Bytes of all blocks, as the header has them.
    std::uint64_t size() const { return size_; }

    /// As read_binary of numbers.hpp, of exactly size() bytes. The blocks are unpacked on all threads, some at a time,
    /// so that memory grows with what the file really has.
    template <class To>
    NumberFault read(NumberType type, std::size_t count, std::vector<To>& values);

private:
    std::size_t plain_size(std::size_t block) const {
        return static_cast<std::size_t>(block + 1 == packed_.size() ? last_ : block_);
    }
    template <class To>
    NumberFault read_whole(NumberType type, std::size_t count, std::vector<To>& values);
    bool unpack_wave(std::size_t first, std::size_t last, const std::vector<std::string_view>& bytes, char* to) const;

    Encoded from_;
    const XmlLayout& layout_;
    std::vector<std::uint64_t> packed_;  // bytes of each block
    std::uint64_t block_ = 0, last_ = 0, size_ = 0;
};

}  // namespace barycert::io
