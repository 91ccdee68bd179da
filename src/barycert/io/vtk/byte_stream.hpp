/// Bytes of a file one after the other, whatever their encoding.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string_view>

namespace barycert::io {

class ByteStream {
public:
    ByteStream() = default;
    virtual ~ByteStream() = default;
    ByteStream(const ByteStream&) = delete;
    ByteStream& operator=(const ByteStream&) = delete;

    /// The next `count` bytes, or as many as there are; how many.
    virtual std::size_t read(char* to, std::size_t count) = 0;
    /// Bytes to make room for in advance: about those left, and never many times what the file has.
    virtual std::uint64_t room() const = 0;
};

/// Bytes as they are.
class PlainStream : public ByteStream {
public:
    explicit PlainStream(std::string_view bytes) : left_(bytes) {}

    std::size_t read(char* to, std::size_t count) override {
        const std::size_t step = std::min(count, left_.size());
        if (step != 0) std::memcpy(to, left_.data(), step);
        left_.remove_prefix(step);
        return step;
    }
    std::uint64_t room() const override { return left_.size(); }

private:
    std::string_view left_;
};

/// Base64 (RFC 4648), white space passed over. After padding it goes on with the next quadruple: VTK encodes the head
/// of compressed data apart from the data. Ends at any other character.
class Base64Stream : public ByteStream {
public:
    explicit Base64Stream(std::string_view text) : left_(text) {}

    std::size_t read(char* to, std::size_t count) override;
    std::uint64_t room() const override { return left_.size() / 4 * 3 + 3 + held_; }

private:
    bool next_quadruple();

    std::string_view left_;
    char bytes_[3] = {};
    std::size_t first_ = 0;  // of the bytes not yet given
    std::size_t held_ = 0;   // how many they are
};

}  // namespace barycert::io
