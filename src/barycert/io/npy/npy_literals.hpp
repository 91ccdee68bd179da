/// The few Python literals that stand in the header of an NPY file.
#pragma once

#include <charconv>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "barycert/io/npy/npy_types.hpp"

namespace barycert::io {

class Literals {
public:
    explicit Literals(std::string_view text) : rest_(text) {}

    bool accept(char c) {
        skip_blanks();
        if (!rest_.starts_with(c)) return false;
        rest_.remove_prefix(1);
        return true;
    }

    bool at_end() {
        skip_blanks();
        return rest_.empty();
    }

    /// A string; escapes stand for what they say.
    bool string(std::string& value) {
        skip_blanks();
        if (rest_.empty() || (rest_.front() != '\'' && rest_.front() != '"')) return false;
        const char quote = rest_.front();
        rest_.remove_prefix(1);
        value.clear();
        while (!rest_.empty() && rest_.front() != quote) {
            if (rest_.front() != '\\') {
                value += rest_.front();
                rest_.remove_prefix(1);
            } else if (!escape(value)) {
                return false;
            }
        }
        return accept_here(quote);
    }

    /// A list, skipped over with all that stands in it.
    bool list(std::string& text) {
        skip_blanks();
        if (!rest_.starts_with('[')) return false;
        int depth = 0;
        char quote = '\0';
        for (std::size_t i = 0; i < rest_.size(); ++i) {
            const char c = rest_[i];
            if (quote != '\0') {
                if (c == '\\') ++i;
                if (c == quote) quote = '\0';
            } else if (c == '\'' || c == '"') {
                quote = c;
            } else if (c == '[') {
                ++depth;
            } else if (c == ']' && --depth == 0) {
                text = rest_.substr(0, i + 1);
                rest_.remove_prefix(i + 1);
                return true;
            }
        }
        return false;
    }

    bool boolean(bool& value) {
        skip_blanks();
        value = rest_.starts_with("True");
        if (!value && !rest_.starts_with("False")) return false;
        rest_.remove_prefix(value ? 4 : 5);
        return true;
    }

    /// (5, 3) or (5,) or (); Python 2 wrote (5L, 3L).
    bool tuple(std::vector<std::uint64_t>& values) {
        values.clear();
        if (!accept('(')) return false;
        while (!accept(')')) {
            if (!values.empty() && !accept(',')) return false;
            if (accept(')')) return !values.empty();
            skip_blanks();
            std::uint64_t value = 0;
            const auto [end, error] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), value);
            if (error != std::errc{}) return false;
            rest_.remove_prefix(static_cast<std::size_t>(end - rest_.data()));
            if (rest_.starts_with('L')) rest_.remove_prefix(1);
            values.push_back(value);
        }
        return true;
    }

private:
    bool accept_here(char c) {
        if (!rest_.starts_with(c)) return false;
        rest_.remove_prefix(1);
        return true;
    }

    /// One of those that Python writes: \\ \' \" \n \r \t, and \xHH, \uHHHH, \UHHHHHHHH.
    bool escape(std::string& value) {
        if (rest_.size() < 2) return false;
        const char c = rest_[1];
        rest_.remove_prefix(2);
        constexpr std::string_view plain = "\\'\"nrt", means = "\\'\"\n\r\t";
        if (const std::size_t at = plain.find(c); at != std::string_view::npos) {
            value += means[at];
            return true;
        }
        const std::size_t digits = c == 'x' ? 2 : c == 'u' ? 4 : c == 'U' ? 8 : 0;
        if (digits == 0 || rest_.size() < digits) return false;
        std::uint32_t code = 0;
        const auto [end, error] = std::from_chars(rest_.data(), rest_.data() + digits, code, 16);
        if (error != std::errc{} || end != rest_.data() + digits) return false;
        rest_.remove_prefix(digits);
        if (code > 0x10FFFF || (code >= 0xD800 && code < 0xE000)) return false;
        append_utf8(value, code);
        return true;
    }

    void skip_blanks() {
        while (!rest_.empty() && (rest_.front() == ' ' || rest_.front() == '\t' || rest_.front() == '\n')) {
            rest_.remove_prefix(1);
        }
    }

    std::string_view rest_;
};

}  // namespace barycert::io
