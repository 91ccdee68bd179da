/// The words of a text by number, without a list of all: rows of so many numbers are found without reading those
/// before them, however they stand in lines.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

namespace barycert::io {

/// Words are parted by blanks, line ends and control characters. One at the very beginning of the text does not count.
class WordIndex {
public:
    WordIndex() = default;
    /// Looks at all of the text once, on several threads. The text must outlive the index.
    WordIndex(std::string_view text, int threads);

    /// The lines that begin with '$'.
    const std::vector<const char*>& marked() const { return marked_; }

    /// How many words begin before `at`.
    std::size_t before(const char* at) const;

    /// The beginning of the word before which `number` others begin. Precondition: there is one.
    const char* find(std::size_t number) const;

    /// Some rows of a run: `first` to `last`, not included, of its own count.
    struct Part {
        std::size_t first = 0, last = 0;
        const char* at = nullptr;  ///< the beginning of `first`
    };

    /// Cuts `rows` rows of `words` words each, from `from` on, into parts of about a piece. Precondition: they are
    /// there.
    std::vector<Part> cut(const char* from, std::size_t rows, std::size_t words) const;

private:
    std::string_view text_;
    std::vector<std::size_t> before_;  ///< words that begin before each piece, and in all of the text
    std::vector<const char*> marked_;
};

/// The end of the last of so many words from `at` on, all before `end`; `count` gets how many there were.
const char* skip_words(const char* at, const char* end, std::size_t& count);

}  // namespace barycert::io
