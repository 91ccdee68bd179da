/// Numbers on the way to a .msh file, as text or binary.
#pragma once

#include <array>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

#include "barycert/base/output_file.hpp"
#include "barycert/result.hpp"

namespace barycert::io {

class MshOutput {
public:
    MshOutput(const std::string& path, bool binary) : file_(path), binary_(binary) {}

    bool binary() const { return binary_; }

    void integer(std::int64_t value) { put(static_cast<std::int32_t>(value), value); }  ///< int
    void size(std::uint64_t value) { put(value, value); }                               ///< size_t
    void real(double value) { put(value, value); }
    /// The end of a row: nothing in a binary file.
    void end_row() {
        if (!binary_) text("\n");
        at_row_start_ = true;
    }

    /// Text in any file.
    void text(std::string_view text) {
        if (text.size() > buffer_.size() - used_) flush();
        if (text.size() > buffer_.size()) return file_.write(text);
        std::memcpy(buffer_.data() + used_, text.data(), text.size());
        used_ += text.size();
    }
    /// "$EndName", after binary data on a line of its own.
    void end_section(std::string_view name) {
        if (binary_) text("\n");
        text("$End");
        text(name);
        text("\n");
    }

    Status commit() {
        flush();
        return file_.commit();
    }

private:
    template <class Binary, class Text>
    void put(Binary binary, Text as_text) {
        constexpr std::size_t longest = 32;  // a space and a number: at most 24 characters of a double
        if (buffer_.size() - used_ < longest) flush();
        if (binary_) {
            std::memcpy(buffer_.data() + used_, &binary, sizeof(binary));
            used_ += sizeof(binary);
            return;
        }
        if (!at_row_start_) buffer_[used_++] = ' ';
        at_row_start_ = false;
        char* const start = buffer_.data() + used_;
        used_ += static_cast<std::size_t>(std::to_chars(start, buffer_.data() + buffer_.size(), as_text).ptr - start);
    }
    void flush() {
        file_.write({buffer_.data(), used_});
        used_ = 0;
    }

    base::OutputFile file_;
    bool binary_;
    bool at_row_start_ = true;
    std::array<char, 1 << 16> buffer_{};
    std::size_t used_ = 0;
};

}  // namespace barycert::io
