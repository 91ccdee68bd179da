/// Rows of numbers on the way to a file, as text or binary.
#pragma once

#include <array>
#include <charconv>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "barycert/mesh.hpp"
#include "barycert/result.hpp"
#include "files/output_file.hpp"

namespace barycert::io {

/// As text, numbers are parted by blanks, and doubles have their shortest form; in binary they stand as in memory.
class RowOutput {
public:
    explicit RowOutput(const std::string& path, bool binary = false) : file_(path), binary_(binary) {}

    bool binary() const { return binary_; }

    template <class Number>
    void number(Number value) {
        if (buffer_.size() - used_ < longest) flush();
        char* const start = buffer_.data() + used_;
        if (binary_) {
            std::memcpy(start, &value, sizeof(value));
            used_ += sizeof(value);
            return;
        }
        *start = ' ';
        char* const digits = start + (at_row_start_ ? 0 : 1);
        at_row_start_ = false;
        used_ = static_cast<std::size_t>(std::to_chars(digits, start + longest, value).ptr - buffer_.data());
    }

    template <class Number>
    void numbers(std::span<const Number> values) {
        for (const Number value : values) number(value);
    }

    void row_of(const std::vector<Field>& fields, std::size_t row) {
        for (const Field& field : fields) {
            const auto components = static_cast<std::size_t>(field.components);
            numbers(std::span(field.data).subspan(row * components, components));
        }
    }

    /// Nothing in a binary file.
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

    Status close() {
        flush();
        return file_.close();
    }
    Status commit() {
        flush();
        return file_.commit();
    }

private:
    void flush() {
        file_.write({buffer_.data(), used_});
        used_ = 0;
    }

    static constexpr std::size_t longest = 32;  // a space and a number: at most 24 characters of a double
    base::OutputFile file_;
    bool binary_;
    bool at_row_start_ = true;
    std::array<char, 1 << 14> buffer_{};
    std::size_t used_ = 0;
};

}  // namespace barycert::io
