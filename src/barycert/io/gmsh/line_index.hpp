/// The lines of a text by number, without a list of all.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

namespace barycert::io {

/// A place in a text. Lines count from 0.
struct Place {
    const char* at = nullptr;
    std::size_t line = 0;
};

/// Knows for each piece of the text how many lines end before it.
class LineIndex {
public:
    LineIndex() = default;
    /// Looks at all of the text once, on several threads. The text must outlive the index.
    LineIndex(std::string_view text, int threads);

    /// The lines that begin with '$'.
    const std::vector<const char*>& marked() const { return marked_; }

    /// The line that holds `at`.
    std::size_t number(const char* at) const;

    /// The start of line `number`, or nullptr if there are fewer. `from`: a start of a line not after it.
    const char* start(std::size_t number, const Place& from) const;

    /// Some lines of a run: `first` to `last`, not included, of its own count.
    struct Part {
        std::size_t first = 0, last = 0;
        const char* at = nullptr;  ///< the start of `first`
    };

    /// Cuts `count` lines from `from` on into parts of about a piece. Precondition: there are so many.
    std::vector<Part> cut(const Place& from, std::size_t count) const;

private:
    std::string_view text_;
    std::vector<std::size_t> before_;  ///< line feeds before each piece, and of all of the text
    std::vector<const char*> marked_;
};

}  // namespace barycert::io
