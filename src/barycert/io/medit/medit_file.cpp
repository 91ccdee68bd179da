#include "barycert/io/medit/medit_file.hpp"

#include <strings.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "barycert/base/input_file.hpp"
#include "barycert/base/text.hpp"
#include "barycert/io/formats.hpp"
#include "barycert/io/vtk/numbers.hpp"
#include "barycert/io/vtk/parallel.hpp"

namespace barycert::io {
namespace {

constexpr const char* cut_short = "the file may be cut short: write it again, or mend the count";
constexpr std::int64_t max_rows = INT32_MAX, max_fields = 1 << 16;
constexpr std::int64_t code_of_dimension = 3, code_of_end = 54;

/// Takes the text up to the next keyword and the keyword itself off `text`; empty, at its end, if there is none. Names
/// in quotes are passed over, and so are nan and inf.
std::string_view next_keyword(std::string_view& text) {
    for (std::size_t i = 0; i < text.size();) {
        const auto letter = static_cast<unsigned char>((text[i] | 0x20) - 'a');
        if (is_white(text[i])) {
            ++i;
            continue;
        }
        if (text[i] == '"') {
            i = std::min(text.find('"', i + 1), text.size() - 1) + 1;
            continue;
        }
        const std::size_t begin = i;
        while (i < text.size() && !is_white(text[i])) ++i;
        if (letter >= 26) continue;
        const std::string_view word = text.substr(begin, i - begin);
        if (same_word(word, "nan") || same_word(word, "inf") || same_word(word, "infinity")) continue;
        text.remove_prefix(i);
        return word;
    }
    text.remove_prefix(text.size());
    return text;
}

/// The integer of 4 or 8 bytes at the beginning, which is taken off; the bytes must be there.
std::int64_t take_integer(std::string_view& bytes, std::size_t size, bool swapped) {
    const char* const at = bytes.data();
    bytes.remove_prefix(size);
    if (size == 8) return swapped ? number_at<std::int64_t, true>(at) : number_at<std::int64_t, false>(at);
    return swapped ? number_at<std::int32_t, true>(at) : number_at<std::int32_t, false>(at);
}

template <class Real, class Integer, bool swap>
void take_rows(const char* bytes, std::size_t count, MeditRows& rows) {
    const std::size_t reals = rows.reals_a_row, integers = rows.integers_a_row;
    in_parts(count, std::size_t{1} << 15, [&](std::size_t first, std::size_t last) {
        const char* at = bytes + first * (reals * sizeof(Real) + integers * sizeof(Integer));
        for (std::size_t row = first; row < last; ++row) {
            for (std::size_t k = 0; k < reals; ++k, at += sizeof(Real))
                rows.reals[row * reals + k] = number_at<Real, swap>(at);
            for (std::size_t k = 0; k < integers; ++k, at += sizeof(Integer))
                rows.integers[row * integers + k] = number_at<Integer, swap>(at);
        }
    });
}

void make_rows(std::size_t count, MeditRows& rows) {
    base::resize_large(rows.reals, count * rows.reals_a_row);
    base::resize_large(rows.integers, count * rows.integers_a_row);
}

}  // namespace

bool same_word(std::string_view word, std::string_view name) {
    return word.size() == name.size() && strncasecmp(word.data(), name.data(), name.size()) == 0;
}

bool is_medit(std::string_view head) {
    if (head.starts_with("\xEF\xBB\xBF")) head.remove_prefix(3);
    if (same_word(first_word(head, '#').substr(0, 11), "MeshVersion")) return true;
    if (head.size() < 12) return false;
    const bool swapped = head[0] == 0;
    return take_integer(head, 4, swapped) == 1 && static_cast<std::uint64_t>(take_integer(head, 4, swapped) - 1) < 4 &&
           take_integer(head, 4, swapped) == code_of_dimension;
}

Result<MeditFile> MeditFile::open(const std::string& path) {
    MeditFile file;
    file.path_ = path;
    // A large file that is none is not read for that.
    const Result<std::string> head = base::InputFile::head(path, 4096);
    if (!head) return head.error();
    const std::string_view begin = std::string_view(*head).substr(head->starts_with("\xEF\xBB\xBF") ? 3 : 0);
    const std::string_view word = first_word(begin, '#');
    file.binary_ = is_medit(begin.substr(0, 12)) && begin[1] == 0;
    if (!file.binary_ && !same_word(word, "MeshVersionFormatted"))
        return line_error(path, 1, "not a file of Medit",
                          "\"MeshVersionFormatted\", or in a binary file the numbers 1, 1 to 4, 3",
                          head->empty() ? "an empty file" : base::quoted(word),
                          "check the path: other programs have files of this suffix, too");
    Result<base::MappedFile> data = base::MappedFile::open(path);
    if (!data) return data.error();
    file.data_ = std::move(*data);
    file.bytes_ = file.data_.bytes();
    if (file.bytes_.starts_with("\xEF\xBB\xBF")) file.bytes_.remove_prefix(3);
    if (Status s = file.binary_ ? file.list_binary() : file.list_text(); !s) return s.error();
    if (file.dimension_ == 0)
        return file.error_at(file.bytes_.data(), "the dimension", "a keyword Dimension", "none", "write it again");
    return file;
}

Error MeditFile::error_at(const char* at, std::string what, std::string expected, std::string found,
                          std::string remedy) const {
    if (binary_) what += ", at byte " + std::to_string(at - bytes_.data());
    return line_error(path_, binary_ ? 0 : line_of(bytes_, at), std::move(what), std::move(expected), std::move(found),
                      std::move(remedy));
}

Error MeditFile::error_in(const MeditSection& section, const MeditRows& rows, std::size_t row, std::size_t column,
                          std::string expected, std::string found, std::string remedy) const {
    const char* at = section.body.data();
    if (binary_) {
        const std::size_t reals = rows.reals_a_row, before = std::min(column, reals);
        at += row * (reals * real_bytes() + rows.integers_a_row * integer_bytes()) + before * real_bytes() +
              (column - before) * integer_bytes();
    } else {
        std::string_view rest = section.body, word;
        for (std::size_t i = row * (rows.reals_a_row + rows.integers_a_row) + column + 1; i != 0; --i)
            word = next_word(rest);
        at = word.data();
    }
    return error_at(at, "row " + std::to_string(row + 1) + " (from 1) of " + section.name, std::move(expected),
                    std::move(found), std::move(remedy));
}

Result<std::int64_t> MeditFile::count_at(std::string_view& text, std::size_t bytes, const char* what,
                                         std::int64_t least, std::int64_t most) const {
    const char* at = text.data();
    const std::string expected = "a number from " + std::to_string(least) + " to " + std::to_string(most);
    if (binary_) {
        if (text.size() < bytes) return error_at(at, what, expected, "the end of the section");
        const std::int64_t number = take_integer(text, bytes, swapped_);
        if (number >= least && number <= most) return number;
        return error_at(at, what, expected, std::to_string(number));
    }
    const std::string_view word = next_word(text);
    const std::optional<std::uint64_t> number = parse_count(word);
    if (number && std::cmp_greater_equal(*number, least) && std::cmp_less_equal(*number, most))
        return static_cast<std::int64_t>(*number);
    return error_at(word.data(), what, expected, word.empty() ? "the end of the section" : base::quoted(word));
}

Status MeditFile::set_header(std::int64_t& number, std::string_view text, std::int64_t least, std::int64_t most) {
    const char* const what = &number == &version_ ? "the version of the format" : "the dimension";
    if (number != 0) return error_at(text.data(), std::string(what) + " again", "it once", "it twice");
    const Result<std::int64_t> read = count_at(text, 4, what, least, most);
    if (!read) return read.error();
    number = *read;
    return Done{};
}

Status MeditFile::add(std::string name, const MeditKeyword* keyword, std::string_view body) {
    MeditSection section{.keyword = keyword == nullptr ? MeditKeyword{} : *keyword, .name = std::move(name)};
    const MeditKind kind = section.keyword.kind;
    const auto is_same = [&](const MeditSection& other) { return other.keyword.code == section.keyword.code; };
    if (kind != MeditKind::other) {
        if (std::any_of(sections_.begin(), sections_.end(), is_same))
            return error_at(body.data(), "a second section " + section.name, "one", "two");
        const Result<std::int64_t> count = count_at(body, integer_bytes(), "the number of rows", 0, max_rows);
        if (!count) return count.error();
        section.count = static_cast<std::size_t>(*count);
    }
    if (kind == MeditKind::solution) {
        const Result<std::int64_t> types = count_at(body, 4, "the number of fields", 1, max_fields);
        if (!types) return types.error();
        for (std::int64_t i = 0; i < *types; ++i) {
            const Result<std::int64_t> type = count_at(body, 4, "the type of a field", 1, 4);
            if (!type) return type.error();
            section.types.push_back(*type);
        }
    }
    section.body = body;
    sections_.push_back(std::move(section));
    return Done{};
}

Status MeditFile::list_text() {
    if (bytes_.find('#') != std::string_view::npos) {
        uncommented_.assign(bytes_.begin(), bytes_.end());
        for (auto at = uncommented_.begin(); (at = std::find(at, uncommented_.end(), '#')) != uncommented_.end();) {
            const auto end = std::find(at, uncommented_.end(), '\n');
            std::fill(at, end, ' ');
            at = end;
        }
        bytes_ = {uncommented_.data(), uncommented_.size()};
    }
    std::string_view rest = bytes_;
    for (std::string_view keyword = next_keyword(rest), next; !keyword.empty(); keyword = next) {
        std::string_view body = rest;
        next = next_keyword(rest);
        body = body.substr(0, static_cast<std::size_t>(next.data() - body.data()));
        if (same_word(keyword, "End")) {
            if (next.empty() && next_word(body).empty()) return Done{};
            return error_at(body.data(), "text after the keyword End", "the end of the file", "more");
        }
        Status added = same_word(keyword, "MeshVersionFormatted") ? set_header(version_, body, 1, 4)
                       : same_word(keyword, "Dimension")
                           ? set_header(dimension_, body, 2, 3)
                           : add(base::printable(keyword.substr(0, 40)), medit_keyword(keyword), body);
        if (!added) return added;
    }
    // Without End, what is cut may be a keyword or a number.
    if (!is_white(bytes_.back())) return base::unended_number(path_, error_at(rest.data(), "", "", "").line);
    return Done{};
}

Status MeditFile::list_binary() {
    std::string_view rest = bytes_;
    swapped_ = rest[0] == 0;
    take_integer(rest, 4, swapped_);
    version_ = take_integer(rest, 4, swapped_);
    const std::size_t head = 4 + (version_ >= 3 ? 8 : 4);
    while (true) {
        const char* const at = rest.data();
        if (rest.size() < head)
            return error_at(at, "the file ends without the keyword End", "another keyword",
                            std::to_string(rest.size()) + " bytes", cut_short);
        const std::int64_t code = take_integer(rest, 4, swapped_), here = at - bytes_.data(),
                           next = take_integer(rest, head - 4, swapped_);
        if (code == code_of_end) return Done{};
        const MeditKeyword* const known = medit_keyword(code);
        const std::string name = known != nullptr ? std::string(known->name) : "keyword " + std::to_string(code);
        if (next < here + static_cast<std::int64_t>(head) || next > static_cast<std::int64_t>(bytes_.size()))
            return error_at(at, "the place of what follows " + name,
                            "one behind it, in a file of " + std::to_string(bytes_.size()) + " bytes",
                            std::to_string(next), cut_short);
        const std::string_view body = rest.substr(0, static_cast<std::size_t>(next - here) - head);
        rest = bytes_.substr(static_cast<std::size_t>(next));
        if (Status s = code == code_of_dimension ? set_header(dimension_, body, 2, 3) : add(name, known, body); !s)
            return s;
    }
}

Status MeditFile::read_text_rows(const MeditSection& section, MeditRows& rows) const {
    const std::size_t reals = rows.reals_a_row, integers = rows.integers_a_row, width = reals + integers;
    std::string_view text = section.body;
    // Rows of both are read as real numbers.
    std::vector<double> numbers;
    const NumberFault fault = reals != 0 ? io::read_text(text, NumberType::float64, section.count * width,
                                                         integers != 0 ? numbers : rows.reals)
                                         : io::read_text(text, NumberType::int64, section.count * width, rows.integers);
    if (fault.kind == NumberFault::Kind::too_few)
        return error_at(text.data(), "the end of " + section.name,
                        std::to_string(section.count) + " rows of " + std::to_string(width) + " numbers",
                        std::to_string(fault.index) + " numbers", cut_short);
    if (fault)
        return error_in(section, rows, fault.index / width, fault.index % width,
                        fault.index % width < reals ? "a number" : "an integer", base::quoted(fault.text));
    if (const char* const at = text.data(); !next_word(text).empty())
        return error_at(at, "more numbers in " + section.name,
                        std::to_string(section.count) + " rows of " + std::to_string(width) + " numbers", "more",
                        "mend the count, or the dimension");
    if (integers == 0 || reals == 0) return Done{};
    make_rows(section.count, rows);
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        const std::size_t row = i / width, column = i % width;
        if (column < reals) {
            rows.reals[row * reals + column] = numbers[i];
        } else if (std::fabs(numbers[i]) <= 0x1p53 && std::trunc(numbers[i]) == numbers[i]) {
            rows.integers[row * integers + column - reals] = static_cast<std::int64_t>(numbers[i]);
        } else {
            return error_in(section, rows, row, column, "an integer up to 2^53", base::shortest(numbers[i]));
        }
    }
    return Done{};
}

Result<MeditRows> MeditFile::rows(const MeditSection& section, std::size_t reals_a_row,
                                  std::size_t integers_a_row) const {
    MeditRows rows{reals_a_row, integers_a_row, {}, {}};
    if (!binary_) {
        if (Status s = read_text_rows(section, rows); !s) return s.error();
        return rows;
    }
    const std::size_t row_bytes = reals_a_row * real_bytes() + integers_a_row * integer_bytes();
    if (section.count * row_bytes != section.body.size())
        return error_at(section.body.data(), "the size of " + section.name,
                        std::to_string(section.count * row_bytes) + " bytes for " + std::to_string(section.count) +
                            " rows, for the version is " + std::to_string(version_) + " and the dimension " +
                            std::to_string(dimension_),
                        std::to_string(section.body.size()), cut_short);
    make_rows(section.count, rows);
    const char* const at = section.body.data();
    const auto take = [&]<class Real, class Integer>() {
        swapped_ ? take_rows<Real, Integer, true>(at, section.count, rows)
                 : take_rows<Real, Integer, false>(at, section.count, rows);
    };
    version_ == 1   ? take.template operator()<float, std::int32_t>()
    : version_ == 4 ? take.template operator()<double, std::int64_t>()
                    : take.template operator()<double, std::int32_t>();
    return rows;
}

}  // namespace barycert::io
