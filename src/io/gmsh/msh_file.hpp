/// A .msh file in memory: its format, where its sections are, numbers of headers and rows. Errors are thrown as
/// Exceptions.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "barycert/error_codes.hpp"
#include "core/base/workers.hpp"
#include "files/input_file.hpp"
#include "io/errors.hpp"
#include "io/tetgen/scanner.hpp"
#include "io/vtk/numbers.hpp"

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

    /// The beginning of the word before which `number` others begin. Requires: there is one.
    const char* find(std::size_t number) const;

    /// Appends the run in parts of about a piece. Requires: its words are there.
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

/// Sections that a file has once at most.
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
    [[noreturn]] void refuse(ErrorCode code, const char* at, Parts&&... parts) const {
        const bool text = !binary_ || at < after_format_;
        refuse_line(code, path_, text ? line_of(bytes_, at) : 0, std::forward<Parts>(parts)...);
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

// Numbers of headers and rows, text or binary. Rows are read on all threads, and one parser of a row serves both.
//
// A parser takes numbers one after the other and says what each is (for the error):
//     [&](auto& row, std::size_t i) { return row.tag(tags[i], "a node's tag"); }

/// Why a row is refused. The parts are literals, for rows are refused where nothing else may be slow.
struct RowFault {
    ErrorCode code = "file.number";
    const char* what = "bad number";
    const char* expected = "a number";
    std::optional<std::int64_t> number = {};  ///< else what stands in the file is told
    const char* remedy = "";
};

/// Numbers one after the other: words of text, or the bytes of a binary file, which must be there.
template <bool is_text>
class NumberScanner {
public:
    static constexpr bool text = is_text;

    NumberScanner(const MshFile& file, const char* at)
        : at_(at), end_(file.end()), wide_(file.version() == 41), swapped_(file.swapped()) {}

    bool integer(std::int64_t& value, const char* name) {
        if constexpr (text) return take(scan_integer(skip(), value), name);
        value = next<std::int32_t>();
        return true;
    }
    /// In binary files of 4.1 it has 8 bytes, as sizes have.
    bool tag(std::int64_t& value, const char* name) {
        if (text || !wide_) return integer(value, name);
        value = next<std::int64_t>();
        return true;
    }
    bool real(double& value, const char* name) {
        if constexpr (text) return take(scan_real(skip(), end_, value), name);
        value = next<double>();
        return std::isfinite(value) || refuse({.what = "a number that is not finite", .expected = name});
    }
    /// It may be infinite or NaN, if it is written so: too large a number is none.
    bool any_real(double& value, const char* name) {
        if constexpr (text) {
            const char* const finite = scan_real(skip(), end_, value);
            return take(finite != nullptr ? finite : scan_nonfinite(at_, end_, value), name);
        }
        value = next<double>();
        return true;
    }

    /// A whole row of small integers on a line of its own; false if it is none, and then nothing has moved.
    template <std::size_t Count>
    bool plain(std::array<std::uint32_t, Count>& values) {
        const char* const after = text ? scan_plain_row(skip(), values) : nullptr;
        if (after != nullptr) at_ = after;
        return after != nullptr;
    }

    void back(const char* at) { at_ = at; }
    bool refuse(const RowFault& fault) {
        fault_ = fault;
        return false;
    }

    const char* at() const { return at_; }
    const RowFault& fault() const { return fault_; }

private:
    const char* skip() {
        while (is_blank(*at_) || *at_ == '\n' || *at_ == '\r') ++at_;
        return at_;
    }
    bool take(const char* after, const char* name) {
        if (after == nullptr || static_cast<unsigned char>(*after) > ' ') return refuse({.expected = name});
        at_ = after;
        return true;
    }
    template <class Number>
    Number next() {
        return number_at<Number>(std::exchange(at_, at_ + sizeof(Number)), swapped_);
    }

    const char* at_;
    const char* end_;  // of the file
    bool wide_, swapped_;
    RowFault fault_;
};

/// Refuses a row of $`section`, which stopped at `at`; `row` counts from 0 among those of all runs.
[[noreturn]] void refuse_row(const MshFile& file, std::string_view section, const char* at, const RowFault& fault,
                             std::size_t row);

/// Calls parse(row, run, i) for each row i of all runs, and tells the first that it refuses.
template <class Parse>
void parse_runs(const MshFile& file, std::string_view section, std::span<const Run> runs, const Parse& parse) {
    const std::vector<RunPart> parts = file.cut(runs);
    // The only place that calls the parser, so that it becomes part of the loop.
    const auto read = [&](const RunPart part, bool tell) {
        const auto all = [&](auto row) {  // a copy, whose address is not known elsewhere
            for (std::size_t i = part.run->first + part.first; i < part.run->first + part.last; ++i) {
                if (parse(row, *part.run, i)) continue;
                if (!tell) return false;
                const RowFault fault = row.fault();  // a copy, too
                refuse_row(file, section, row.at(), fault, i);
            }
            return true;
        };
        return file.binary() ? all(NumberScanner<false>(file, part.at)) : all(NumberScanner<true>(file, part.at));
    };
    if (base::share_work(file.threads(), parts.size(), [&](std::size_t p) { return read(parts[p], false); })) return;
    // Again in their order: the first one is told, whatever the threads did.
    for (const RunPart& part : parts) read(part, true);
    file.refuse("internal.error", file.end(), "a row is refused once and not again");
}

/// Walks through a section from its beginning: reads headers number by number, passes rows over. Refuses what is not
/// there.
class Walk {
public:
    /// `text`: numbers are text, as those of some headers in binary files. `bad`: what errors call a word that is none.
    Walk(const MshFile& file, const MshSection& section, bool text, const char* bad = "bad number in")
        : file_(&file), section_(&section), text_(text), bad_(bad), at_(section.body.data()) {}
    Walk(const MshFile& file, const MshSection& section) : Walk(file, section, !file.binary()) {}

    std::int64_t integer(const char* name);  ///< int
    std::int64_t size(const char* name);     ///< size_t; not negative
    /// `any`: in text it may be infinite or NaN.
    double real(const char* name, bool any = false);
    /// A number on a line of its own, which is text in binary files too; not negative.
    std::int64_t count_line(const char* name);
    /// The rest of the line, which is text in any file, without its end.
    std::string_view line() { return take_line(at_, end()); }

    bool text() const { return text_; }
    const char* at() const { return at_; }
    const char* end() const { return section_->body.data() + section_->body.size(); }
    /// Moves over rows: so many numbers or bytes each.
    void skip_rows(std::int64_t rows, std::size_t numbers, std::size_t bytes, const char* name);
    void need_end();

    template <class... Parts>
    [[noreturn]] void refuse(ErrorCode code, const std::string& what, Parts&&... parts) const {
        file_->refuse(code, at_, what + " in $" + std::string(section_->name), std::forward<Parts>(parts)...);
    }
    /// Refuses what stands here as a word that is no number.
    [[noreturn]] void refuse_word(std::string expected, std::string found) const;
    void move_to(const char* at) { at_ = at; }

private:
    /// Reads what take(row, number) takes, where a row begins here.
    template <class Number, class Take>
    Number step(const char* name, const Take& take);

    const MshFile* file_;
    const MshSection* section_;
    bool text_;
    const char *bad_, *at_;
};

}  // namespace barycert::io
