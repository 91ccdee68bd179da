/// A .msh file in memory: its format, and where its sections are. Errors are thrown as Exceptions.
#pragma once

#include "barycert/io/formats.hpp"

namespace barycert::io {

/// Rows of as many numbers each, one after the other.
struct Run {
    const char* at = nullptr;  ///< the first, perhaps after blanks
    std::size_t count = 0;
    std::size_t first = 0;               ///< its first row among those of all runs
    std::size_t numbers = 1, bytes = 1;  ///< of a row: of text, of a binary file
    std::size_t id = 0;                  ///< for the parser
};

/// Some rows of a run, `first` to `last`, not included, to be read by one thread.
struct RunPart {
    const Run* run;
    std::size_t first, last;
    const char* at;  ///< the beginning of `first`
};

/// So many words are passed one by one: the index would take longer.
inline constexpr std::size_t few_words = 1024;

/// Words are parted by blanks, line ends and control characters. One at the very beginning of the text does not count.
class WordIndex {
public:
    WordIndex() = default;
    /// Looks at all of the text once, on several threads. The text must outlive the index.
    WordIndex(std::string_view text, int threads);

    const std::vector<const char*>& marked() const { return marked_; }

    std::size_t before(const char* at) const;

    /// The beginning of the word before which `number` others begin. Precondition: there is one.
    const char* find(std::size_t number) const;

    /// Appends the run in parts of about a piece. Precondition: its words are there.
    void cut(const Run& run, std::vector<RunPart>& parts) const;

private:
    std::string_view text_;
    std::vector<std::size_t> before_;  ///< words that begin before each piece, and in all of the text
    std::vector<const char*> marked_;
};

/// The end of the last of so many words from `at` on, all before `end`; `count` gets how many there were.
const char* skip_words(const char* at, const char* end, std::size_t& count);

/// $Name, a line end, the body, $EndName.
struct MshSection {
    std::string_view name;
    std::string_view body;
};

/// Of which a file has one at most.
inline constexpr std::array<std::string_view, 7> once_sections{
    "MeshFormat", "PhysicalNames", "Entities", "PartitionedEntities", "Nodes", "ParametricNodes", "Elements"};

class MshFile {
public:
    /// Error: it cannot be read, is of another format or version, or a section has no end.
    MshFile(const std::string& path, int threads);

    const std::string& path() const { return path_; }
    int version() const { return version_; }  ///< 22 (all of 2.x), 40 or 41
    bool binary() const { return binary_; }
    bool swapped() const { return swapped_; }  ///< binary, of the other byte order
    int threads() const { return threads_; }
    const WordIndex& words() const { return words_; }  ///< of text
    const char* end() const { return bytes_.data() + bytes_.size(); }

    const std::vector<MshSection>& sections() const { return sections_; }
    const MshSection* find(std::string_view name) const;

    /// The runs in parts that take a thread some hundred microseconds.
    std::vector<RunPart> cut(std::span<const Run> runs) const;

    /// As refuse_line(), of the place `at`, whose line is told where the file is text.
    template <class... Parts>
    [[noreturn]] void refuse(const char* at, Parts&&... parts) const {
        const bool text = !binary_ || at < after_format_;
        refuse_line(path_, text ? line_of(bytes_, at) : 0, std::forward<Parts>(parts)...);
    }

private:
    void read_format();
    void list_text_sections();
    void list_binary_sections();
    void check_sections() const;
    /// The section that begins at `at` and whose end, if it has one, is `end`.
    void add_section(const char* at, const char* end);
    /// After a byte-order mark.
    const char* begin() const { return bytes_.data() + (bytes_.starts_with("\xEF\xBB\xBF") ? 3 : 0); }

    std::string path_;
    base::MappedFile data_;
    std::string_view bytes_;  // of data_
    int version_ = 41, threads_;
    bool binary_ = false, swapped_ = false;
    WordIndex words_;
    const char* after_format_ = nullptr;
    std::vector<MshSection> sections_;
};

/// The next line from `at`, without its end (LF or CR LF); moves `at` to the line after it, at most to `end`.
std::string_view take_line(const char*& at, const char* end);

std::string word_at(const char* at, const char* end);

}  // namespace barycert::io
