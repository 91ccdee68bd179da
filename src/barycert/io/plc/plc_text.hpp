/// The lines of a file of polygons as words, with errors that know where they are.
///
/// Errors are thrown as Exception.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "barycert/io.hpp"

namespace barycert::io {

class PlcText {
public:
    /// Both texts must outlive the object. Words are parted by blanks and commas; `#` starts a comment. `size`: of the
    /// file, of which the text may be the beginning.
    PlcText(const std::string& path, std::string_view text, std::size_t size)
        : path_(path), rest_(text), end_(text.data() + text.size()), size_(size) {}

    const std::string& path() const { return path_; }
    /// What has not been read.
    std::string_view rest() const { return rest_; }

    /// Goes to the next line that has words. False at the end of the file.
    bool next_line();
    /// As next_line(), but the end of the file is an error: `expected` says what is missing.
    void need_line(std::string_view expected);
    /// The same, with the words made when they are needed.
    template <class Expected>
    requires std::is_invocable_v<Expected>
    void need_line(Expected expected) {
        if (!next_line()) need_line(std::string_view(expected()));
    }

    std::size_t words_left() const { return words_.size() - at_; }
    std::string_view word(std::size_t i) const { return words_[i]; }
    std::string_view line() const { return line_; }

    /// The next word of the line as a string, a decimal integer, or a finite number; `expected` names it in errors.
    std::string_view take(std::string_view expected);
    /// `end`: a character at which the word ends for this purpose.
    std::int32_t take_integer(std::string_view expected, char end = ' ');
    double take_number(std::string_view expected, bool finite = true);  ///< or any

    /// A count of things that take at least two bytes each: one that the file cannot hold is an error.
    std::size_t take_count(std::string_view expected);

    [[noreturn]] void fail(std::string_view what, std::string_view expected = {}, std::string_view found = {},
                           std::string_view remedy = {}) const;

private:
    /// A word that something follows: what the end of the file has cut may be the beginning of another number.
    std::string_view take_whole(std::string_view expected);

    const std::string& path_;
    std::string_view rest_;
    const char* end_;
    std::size_t size_;
    std::string_view line_;
    std::size_t line_number_ = 0;
    std::vector<std::string_view> words_;
    std::size_t at_ = 0;
};

/// The whole file as text. `check`: of a beginning in whole lines, and the file's size, throws what is wrong there
/// already. Throws an Exception if the file cannot be read.
std::string read_surface_text(const std::string& path, const std::function<void(PlcText&)>& check);

}  // namespace barycert::io
