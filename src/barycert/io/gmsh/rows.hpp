/// Numbers of headers and rows, text or binary. Rows are read on all threads, and one parser of a row serves both.
///
/// A parser takes numbers one after the other and says what each is (for the error):
///     [&](auto& row, std::size_t i) { return row.tag(tags[i], "a node's tag"); }
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "barycert/base/workers.hpp"
#include "barycert/io/gmsh/msh_file.hpp"
#include "barycert/io/tetgen/integer_row.hpp"
#include "barycert/io/tetgen/scanner.hpp"
#include "barycert/io/vtk/numbers.hpp"

namespace barycert::io {

/// Why a row is refused. The parts are literals, for rows are refused where nothing else may be slow.
struct RowFault {
    const char* what = "bad number";
    const char* expected = "a number";
    std::optional<std::int64_t> number = {};  ///< else what stands in the file is told
    const char* remedy = "";
};

/// What rows of either kind have.
class Row {
public:
    /// Back to where a step began.
    void back(const char* at) { at_ = at; }
    bool refuse(const RowFault& fault) {
        fault_ = fault;
        return false;
    }

    const char* at() const { return at_; }
    const RowFault& fault() const { return fault_; }

protected:
    explicit Row(const char* at) : at_(at) {}
    const char* at_;

private:
    RowFault fault_;
};

/// A number that may be infinite or NaN, if it is written so: too large a number is none.
inline const char* scan_any_real(const char* at, const char* end, double& value) {
    const char* const finite = scan_real(at, end, value);
    return finite != nullptr ? finite : scan_nonfinite(at, end, value);
}

/// Of text: as many words as the row has numbers.
class TextRow : public Row {
public:
    static constexpr bool text = true;

    TextRow(const char* at, const char* end) : Row(at), end_(end) {}

    bool integer(std::int64_t& value, const char* name) {
        skip();
        return take(scan_integer(at_, value), name);
    }
    bool tag(std::int64_t& value, const char* name) { return integer(value, name); }
    bool real(double& value, const char* name) {
        skip();
        return take(scan_real(at_, end_, value), name);
    }
    bool value(double& value, const char* name) {
        skip();
        return take(scan_any_real(at_, end_, value), name);
    }

    /// A whole row of small integers on a line of its own; false if it is none, and then nothing has moved.
    template <std::size_t Count>
    bool plain(std::array<std::uint32_t, Count>& values) {
        skip();
        const char* const after = scan_plain_row(at_, values);
        if (after != nullptr) at_ = after;
        return after != nullptr;
    }

private:
    void skip() {
        while (is_blank(*at_) || *at_ == '\n' || *at_ == '\r') ++at_;
    }
    bool take(const char* after, const char* name) {
        if (after == nullptr || static_cast<unsigned char>(*after) > ' ') return refuse({.expected = name});
        at_ = after;
        return true;
    }

    const char* end_;
};

/// Binary. The bytes of the row must be there.
class BinaryRow : public Row {
public:
    static constexpr bool text = false;

    /// `wide`: tags have 8 bytes, else 4.
    BinaryRow(const char* at, bool wide, bool swapped) : Row(at), wide_(wide), swapped_(swapped) {}

    bool integer(std::int64_t& value, const char*) {
        value = take<std::int32_t>();
        return true;
    }
    bool tag(std::int64_t& value, const char* name) {
        if (!wide_) return integer(value, name);
        value = take<std::int64_t>();
        return true;
    }
    bool real(double& number, const char* name) {
        value(number, name);
        return std::isfinite(number) || refuse({.what = "a number that is not finite", .expected = name});
    }
    bool value(double& value, const char*) {
        value = take<double>();
        return true;
    }
    template <std::size_t Count>
    bool plain(std::array<std::uint32_t, Count>&) {
        return false;
    }

private:
    template <class Number>
    Number take() {
        const char* const at = at_;
        at_ += sizeof(Number);
        return swapped_ ? number_at<Number, true>(at) : number_at<Number, false>(at);
    }

    bool wide_, swapped_;
};

/// Rows of as many numbers each, one after the other.
struct Run {
    const char* at = nullptr;  ///< the first, perhaps after blanks
    std::size_t count = 0;
    std::size_t first = 0;               ///< its first row among those of all runs
    std::size_t numbers = 1, bytes = 1;  ///< of a row: of text, of a binary file
    std::size_t id = 0;                  ///< for the parser
};

/// Some rows of a run, to be read by one thread.
struct RunPart {
    const Run* run;
    std::size_t first, last;
    const char* at;
};
std::vector<RunPart> cut_runs(const MshFile& file, std::span<const Run> runs);

/// Refuses a row of $`section`, which stopped at `at`; `row` counts from 0 among those of all runs.
[[noreturn]] void refuse_row(const MshFile& file, const char* section, const char* at, const RowFault& fault,
                             std::size_t row);

/// Calls parse(row, run, i) for each row i of all runs, and tells the first that it refuses.
template <class Parse>
void parse_runs(const MshFile& file, const char* section, std::span<const Run> runs, const Parse& parse) {
    struct Stop {
        const char* at;
        RowFault fault;
        std::size_t row;
    };
    const std::vector<RunPart> parts = cut_runs(file, runs);
    // The only place that calls the parser, so that it becomes part of the loop.
    const auto read = [&](const RunPart part, Stop* stop) {
        const auto all = [&](auto row) {  // a copy, whose address is not known elsewhere
            for (std::size_t i = part.run->first + part.first; i < part.run->first + part.last; ++i) {
                if (parse(row, *part.run, i)) continue;
                if (stop != nullptr) *stop = {row.at(), row.fault(), i};
                return false;
            }
            return true;
        };
        return file.binary() ? all(BinaryRow(part.at, file.version() == 41, file.swapped()))
                             : all(TextRow(part.at, file.end()));
    };
    if (base::share_work(file.threads(), parts.size(), [&](std::size_t p) { return read(parts[p], nullptr); })) return;
    // Again in their order: the first one is told, whatever the threads did.
    Stop stop{};
    for (const RunPart& part : parts) {
        if (!read(part, &stop)) refuse_row(file, section, stop.at, stop.fault, stop.row);
    }
    file.refuse(file.end(), "a row is refused once and not again", {}, {});
}

/// How many rows of text of `words` words from `at` on are whole and like the first one, `most` at most: same(row)
/// looks at the beginning of each. The text of the section ends at `end`. `second`: what stands behind the first word
/// of all integer rows that are alike.
template <class Same>
std::size_t rows_alike(const MshFile& file, const char* at, const char* end, std::size_t words, std::size_t most,
                       const Same& same, const FewBytes& second = {}) {
    std::size_t alike = 0;
    for (std::size_t few = std::min<std::size_t>(most, 16); alike < few; ++alike) {
        std::size_t skipped = words;
        const char* const next = skip_words(at, end, skipped);
        if (skipped != words || (alike != 0 && !same(TextRow(at, end)))) return alike;
        at = next;
    }
    const WordIndex& index = file.words();
    const std::size_t base = alike == most ? 0 : index.before(at), first = alike;
    if (alike != most) most = std::min(most, alike + (index.before(end) - base) / words);
    // Twice as far each time, so that little is looked at for nothing.
    for (std::size_t look = 64; alike < most; look *= 2) {
        const std::size_t count = std::min(look, most - alike);
        const auto parts = index.cut(index.find(base + (alike - first) * words), count, words);
        std::atomic<std::size_t> found{count};
        base::share_work(file.threads(), parts.size(), [&](std::size_t p) {
            const char* next = parts[p].at;
            for (std::size_t i = parts[p].first; i < parts[p].last && i < found; ++i) {
                if (const char* const plain = second.mask == 0 ? nullptr : plain_row_end(next, words, second);
                    plain != nullptr) {
                    next = plain;
                    continue;
                }
                if (!same(TextRow(next, end))) {
                    for (std::size_t other = found; i < other && !found.compare_exchange_weak(other, i);) {
                    }
                }
                std::size_t skipped = words;
                next = skip_words(next, end, skipped);
            }
            return true;
        });
        alike += found;
        if (found != count) break;
    }
    return alike;
}

/// A section from its beginning: headers number by number, rows passed over. What is not there is refused.
class Walk {
public:
    /// `text`: the numbers are text, as those of some headers are in binary files too. `bad`: what errors call a word
    /// that is no number.
    Walk(const MshFile& file, const MshSection& section, bool text, const char* bad = "bad number in");
    Walk(const MshFile& file, const MshSection& section) : Walk(file, section, !file.binary()) {}

    std::int64_t integer(const char* name) { return number(4, name); }  ///< int
    std::int64_t size(const char* name);                                ///< size_t; not negative
    /// `any`: in text it may be infinite or NaN.
    double real(const char* name, bool any = false);
    /// A number on a line of its own, which is text in binary files too; not negative.
    std::int64_t count_line(const char* name);
    /// The rest of the line, which is text in any file, without its end.
    std::string_view line() { return take_line(at_, end_); }

    bool text() const { return text_; }
    const char* at() const { return at_; }
    const char* end() const { return end_; }
    /// How many words of text are left.
    std::size_t words_left() const { return file_->words().before(end_) - file_->words().before(at_); }
    /// Moves over rows: so many numbers or bytes each.
    void skip_rows(std::int64_t rows, std::size_t numbers, std::size_t bytes, const char* name);
    /// White space and nothing else is left.
    void need_end();

    [[noreturn]] void refuse(const std::string& what, std::string expected, std::string found,
                             std::string remedy = {}) const;
    /// Refuses what stands here as a word that is no number.
    [[noreturn]] void refuse_word(std::string expected, std::string found) const;
    /// Goes on at another place.
    void move_to(const char* at) { at_ = at; }

private:
    void take(const char* after, const char* name);
    void skip();
    std::int64_t number(std::size_t bytes, const char* name);

    const MshFile* file_;
    std::string_view name_;
    bool text_;
    const char* bad_;
    const char* at_;
    const char* end_;  // of the section
};

}  // namespace barycert::io
