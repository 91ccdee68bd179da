/// Data that VTK compressed block by block, through VTK's compressors.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "barycert/io/vtk/byte_stream.hpp"

namespace barycert::io {

struct XmlLayout;

/// The next integer of a header; nothing at the end of the data.
std::optional<std::uint64_t> read_header(ByteStream& stream, const XmlLayout& layout);

/// Header: number of blocks, bytes of a block, bytes of the last one if it is shorter (else 0), then the compressed
/// bytes of each block; then the blocks. One block is in memory at a time.
class BlockStream : public ByteStream {
public:
    BlockStream(std::unique_ptr<ByteStream> from, const XmlLayout& layout);
    ~BlockStream() override;

    /// Reads the header; what is wrong with it, or empty.
    std::string open();
    /// Bytes of all blocks, as the header has them.
    std::uint64_t size() const { return size_; }

    std::size_t read(char* to, std::size_t count) override;
    std::uint64_t room() const override { return std::min(size_, 4 * from_->room()); }

private:
    bool next_block();

    std::unique_ptr<ByteStream> from_;
    const XmlLayout& layout_;
    std::vector<std::uint64_t> compressed_;  // bytes of each block
    std::uint64_t block_ = 0, last_ = 0, size_ = 0;
    std::size_t next_ = 0;  // block
    std::unique_ptr<char[]> bytes_;
    std::size_t first_ = 0, held_ = 0;  // of bytes_, not yet given
};

}  // namespace barycert::io
