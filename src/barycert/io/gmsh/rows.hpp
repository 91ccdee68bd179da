/// Numbers of headers and rows, text or binary. Rows are read on all threads, and one parser of a row serves both.
///
/// A parser takes numbers one after the other and says what each is (for the error):
///     [&](auto& row, std::size_t i) { return row.tag(tags[i], "a node's tag"); }
#pragma once

#include "barycert/base/workers.hpp"
#include "barycert/io/gmsh/msh_file.hpp"
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

/// Numbers one after the other: words of text, or the bytes of a binary file, which must be there.
template <bool is_text>
class Row {
public:
    static constexpr bool text = is_text;

    Row(const MshFile& file, const char* at)
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
        return file.binary() ? all(Row<false>(file, part.at)) : all(Row<true>(file, part.at));
    };
    if (base::share_work(file.threads(), parts.size(), [&](std::size_t p) { return read(parts[p], false); })) return;
    // Again in their order: the first one is told, whatever the threads did.
    for (const RunPart& part : parts) read(part, true);
    file.refuse(file.end(), "a row is refused once and not again");
}

/// A section from its beginning: headers number by number, rows passed over. What is not there is refused.
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
    [[noreturn]] void refuse(const std::string& what, Parts&&... parts) const {
        file_->refuse(at_, what + " in $" + std::string(section_->name), std::forward<Parts>(parts)...);
    }
    /// Refuses what stands here as a word that is no number.
    [[noreturn]] void refuse_word(std::string expected, std::string found) const;
    void move_to(const char* at) { at_ = at; }

private:
    /// take(row), where a row begins here.
    template <class Take>
    void step(const char* name, const Take& take);

    const MshFile* file_;
    const MshSection* section_;
    bool text_;
    const char *bad_, *at_;
};

}  // namespace barycert::io
