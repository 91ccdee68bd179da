/// Rows of numbers: of text, one a line or as they come, and binary. One parser of a row serves them all.
///
/// A parser takes numbers one after the other, says what each is (for the error), and ends the row:
///     [&](auto& row, std::size_t i) { return row.tag(tags[i], "a node's tag") && row.end(); }
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <vector>

#include "barycert/base/workers.hpp"
#include "barycert/io/gmsh/msh_file.hpp"
#include "barycert/io/tetgen/integer_row.hpp"
#include "barycert/io/tetgen/scanner.hpp"

namespace barycert::io {

/// Why a row is refused. The parts are literals, for rows are refused where nothing else may be slow.
struct RowFault {
    const char* what = "bad number";
    const char* expected = "a number";
    const char* remedy = "";
    bool has_number = false;  ///< else what stands in the file is told
    std::int64_t number = 0;
};

/// A number that may be infinite or NaN, if it is written so: too large a number is none.
inline const char* scan_any_real(const char* at, const char* end, double& value) {
    if (*at == '+' && at[1] != '-') ++at;
    const auto [after, error] = fast_float::from_chars(at, end, value);
    if (error == std::errc::invalid_argument) return nullptr;
    const char first = static_cast<char>((*at == '-' ? at[1] : *at) | 0x20);
    return std::isfinite(value) || first == 'i' || first == 'n' ? after : nullptr;
}

/// Of text. With `Free`, lines do not matter.
template <bool Free>
class TextRow {
public:
    static constexpr bool text = true;

    TextRow(const char* at, const char* end) : at_(at), end_(end) {}

    bool integer(std::int64_t& value, const char* name) {
        skip();
        const char* const after = scan_integer(at_, value);
        return take(after, name);
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

    /// A whole row of small integers and its end; false if it is none, and then nothing has moved.
    template <std::size_t Count>
    bool plain(std::array<std::uint32_t, Count>& values) {
        if constexpr (Free) return false;
        const char* const after = scan_plain_row(at_, values);
        if (after != nullptr) at_ = after;
        return after != nullptr;
    }
    /// Back to where plain() began.
    void back(const char* at) { at_ = at; }

    bool end() {
        if constexpr (Free) return true;
        skip();
        if (*at_ == '\r') ++at_;
        return *at_++ == '\n';
    }

    bool refuse(const RowFault& fault) {
        if constexpr (Free) fault_ = fault;
        return false;
    }

    const char* at() const { return at_; }
    const RowFault& fault() const { return fault_; }

private:
    void skip() {
        while (is_blank(*at_) || (Free && (*at_ == '\n' || *at_ == '\r'))) ++at_;
    }
    bool take(const char* after, const char* name) {
        if (after == nullptr || static_cast<unsigned char>(*after) > ' ') {
            if constexpr (Free) fault_ = {.expected = name};
            return false;
        }
        at_ = after;
        return true;
    }

    const char* at_;
    const char* end_;
    RowFault fault_;
};

/// Binary. The bytes of the row must be there.
class BinaryRow {
public:
    static constexpr bool text = false;

    /// `wide`: tags have 8 bytes, else 4.
    BinaryRow(const char* at, bool wide, bool swapped) : at_(at), wide_(wide), swapped_(swapped) {}

    bool integer(std::int64_t& value, const char*) {
        value = static_cast<std::int32_t>(take<std::uint32_t>());
        return true;
    }
    bool tag(std::int64_t& value, const char* name) {
        if (!wide_) return integer(value, name);
        value = static_cast<std::int64_t>(take<std::uint64_t>());
        return true;
    }
    bool real(double& number, const char* name) {
        value(number, name);
        return std::isfinite(number) || refuse({.what = "a number that is not finite", .expected = name});
    }
    bool value(double& value, const char*) {
        value = std::bit_cast<double>(take<std::uint64_t>());
        return true;
    }
    template <std::size_t Count>
    bool plain(std::array<std::uint32_t, Count>&) {
        return false;
    }
    void back(const char* at) { at_ = at; }
    bool end() { return true; }
    bool refuse(const RowFault& fault) {
        fault_ = fault;
        return false;
    }

    const char* at() const { return at_; }
    const RowFault& fault() const { return fault_; }

private:
    template <class Word>
    Word take() {
        Word word = 0;
        std::memcpy(&word, at_, sizeof(Word));
        at_ += sizeof(Word);
        if constexpr (sizeof(Word) == 8) return swapped_ ? __builtin_bswap64(word) : word;
        return static_cast<Word>(swapped_ ? __builtin_bswap32(static_cast<std::uint32_t>(word)) : word);
    }

    const char* at_;
    bool wide_, swapped_;
    RowFault fault_;
};

/// Rows alike, one after the other.
struct Run {
    Place place;  ///< of the first
    std::size_t count = 0;
    std::size_t first = 0;      ///< its first row among those of all runs
    std::size_t row_bytes = 0;  ///< in a binary file
    std::size_t id = 0;         ///< for the parser
};

/// Some rows of a run, to be read by one thread.
struct RunPart {
    const Run* run;
    std::size_t first, last;
    const char* at;
};
std::vector<RunPart> cut_runs(const MshFile& file, std::span<const Run> runs);

/// The Error of a row of $`section`, which stopped at `at`; `row` counts from 0 among those of all runs.
Error row_error(const MshFile& file, const char* section, const char* at, const RowFault& fault, std::size_t row);

/// Calls parse(row, run, i) for each row i of all runs, and tells the first that it refuses. If the layout is `lines`,
/// that Error says no more than that there is one.
template <class Parse>
Status parse_runs(const MshFile& file, const char* section, std::span<const Run> runs, const Parse& parse) {
    const char* const end = file.data().bytes().data() + file.data().bytes().size();
    const bool wide = file.version() == 41;
    if (file.layout() == MshLayout::free) {
        for (const Run& run : runs) {
            TextRow<true> row(run.place.at, end);
            for (std::size_t i = run.first; i < run.first + run.count; ++i) {
                if (!parse(row, run, i)) return row_error(file, section, row.at(), row.fault(), i);
            }
        }
        return Done{};
    }
    const std::vector<RunPart> parts = cut_runs(file, runs);
    const bool good = base::share_work(file.threads(), parts.size(), [&](std::size_t p) {
        const RunPart part = parts[p];
        const auto all = [&](auto row) {  // a copy, whose address is not known elsewhere
            for (std::size_t i = part.first; i < part.last; ++i) {
                if (!parse(row, *part.run, part.run->first + i)) return false;
            }
            return true;
        };
        return file.layout() == MshLayout::lines ? all(TextRow<false>(part.at, end))
                                                 : all(BinaryRow(part.at, wide, file.swapped()));
    });
    if (good) return Done{};
    if (file.layout() == MshLayout::lines) return Error{.what = "not one row a line"};
    for (const RunPart& part : parts) {
        BinaryRow row(part.at, wide, file.swapped());
        for (std::size_t i = part.first; i < part.last; ++i) {
            if (!parse(row, *part.run, part.run->first + i))
                return row_error(file, section, row.at(), row.fault(), part.run->first + i);
        }
    }
    return Error{.what = "a row is refused once and not again", .file = file.path()};
}

}  // namespace barycert::io
