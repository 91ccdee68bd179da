/// Medit's files (the Gamma mesh format), text and binary: what sections there are, and the numbers in them.
///
/// text    MeshVersionFormatted VERSION (0, as bamg writes, to 4), then keywords with what belongs to them, words
/// parted by white space;
///         # starts a comment that goes to the end of the line. Vertices, cells: COUNT, rows. SolAt...: COUNT, the
///         number of fields, the type of each, rows. The last keyword is End, which may be missing.
/// binary  1 (whose bytes tell their order), version; then keyword, place of the next keyword, data, as above, up to
///         the keyword End. All are int32; places are int64 from version 3 on, counts and indices in version 4; real
///         numbers are float32 in version 1, else float64.
#pragma once

#include <strings.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "barycert/error_codes.hpp"
#include "barycert/result.hpp"
#include "core/base/large_pages.hpp"
#include "core/base/text.hpp"
#include "core/vtk_cell.hpp"
#include "files/input_file.hpp"
#include "io/errors.hpp"
#include "io/medit/medit.hpp"
#include "io/other_formats.hpp"
#include "io/parallel.hpp"
#include "io/tetgen/scanner.hpp"
#include "io/vtk/numbers.hpp"
#include "io/words.hpp"

namespace barycert::io::medit {

enum class MeditKind : std::uint8_t {
    other,
    vertices,
    cells,
    solution,  ///< fields of nodes (dimension 0), triangles (2) or tetrahedra (3)
};
using enum MeditKind;

struct MeditKeyword {
    int code;  ///< in binary files
    std::string_view name;
    MeditKind kind = MeditKind::other;
    int dimension = 0;
    std::uint8_t type = 0;  ///< of a cell by its corners, VTK's
    std::size_t nodes = 0;  ///< of a cell
};

struct MeditSection {
    MeditKeyword keyword;
    std::string name = {};                 ///< as in the file
    std::size_t count = 0;                 ///< of rows; 0 where the keyword is not known
    std::vector<std::int64_t> types = {};  ///< of the fields of a solution
    std::string_view body = {};            ///< the rows
};

/// The numbers of a section, row after row: some real ones and then some integers.
struct MeditRows {
    std::size_t reals_a_row = 0, integers_a_row = 0;
    std::vector<double> reals;  ///< any, infinities and NaN included
    std::vector<std::int64_t> integers;
};

/// Keywords of one kind, dimension and type, each behind its code; those of cells before the number of their nodes.
struct KeywordList {
    MeditKind kind;
    int dimension;
    std::uint8_t type;  ///< of cells by their corners, VTK's
    std::string_view words;
};

// Codes of libMeshb's documentation. Keywords that are not named here are left out in any case. Some programs write
// Hexaedra.
inline constexpr std::array<KeywordList, 12> keyword_lists{
    {{vertices, 0, 0, "4 Vertices"},
     {cells, 1, vtk_line, "5 Edges 2 25 EdgesP2 3 92 EdgesP3 4 93 EdgesP4 5"},
     {cells, 2, vtk_triangle, "6 Triangles 3 24 TrianglesP2 6 90 TrianglesP3 10 91 TrianglesP4 15"},
     {cells, 2, vtk_quad, "7 Quadrilaterals 4 27 QuadrilateralsQ2 9 88 QuadrilateralsQ3 16 89 QuadrilateralsQ4 25"},
     {cells, 3, vtk_tetra, "8 Tetrahedra 4 30 TetrahedraP2 10 96 TetrahedraP3 20 97 TetrahedraP4 35"},
     {cells, 3, vtk_hexahedron, "10 Hexahedra 8 10 Hexaedra 8 33 HexahedraQ2 27 98 HexahedraQ3 64 99 HexahedraQ4 125"},
     {cells, 3, vtk_wedge, "9 Prisms 6 9 Wedges 6 86 PrismsP2 18 102 PrismsP3 40 103 PrismsP4 75"},
     {cells, 3, vtk_pyramid, "49 Pyramids 5 87 PyramidsP2 14 100 PyramidsP3 30 101 PyramidsP4 55"},
     {solution, 0, 0, "62 SolAtVertices"},
     {solution, 2, 0, "64 SolAtTriangles"},
     {solution, 3, 0, "66 SolAtTetrahedra"},
     {other, 0, 0,
      "3 Dimension 13 Corners 14 Ridges 15 RequiredVertices 16 RequiredEdges 17 RequiredTriangles "
      "18 RequiredQuadrilaterals 20 NormalAtVertices 34 ExtraVerticesAtEdges 35 ExtraVerticesAtTriangles "
      "37 ExtraVerticesAtTetrahedra 59 Tangents 60 Normals 61 TangentAtVertices 63 SolAtEdges "
      "65 SolAtQuadrilaterals 67 SolAtPrisms 68 SolAtHexahedra 77 Iterations 78 Time"}}};

inline const std::vector<MeditKeyword>& keywords() {
    static const std::vector<MeditKeyword> all = [] {
        std::vector<MeditKeyword> found;
        for (auto [kind, dimension, type, words] : keyword_lists) {
            while (const auto code = parse_count(next_word(words)))
                found.push_back({static_cast<int>(*code), next_word(words), kind, dimension, type,
                                 kind == cells ? *parse_count(next_word(words)) : 0});
        }
        return found;
    }();
    return all;
}

inline constexpr const char* cut_short = "the file may be cut short: write it again, or mend the count";
inline constexpr std::int64_t max_rows = INT32_MAX, max_fields = 1 << 16;
inline constexpr std::int64_t code_of_dimension = 3, code_of_end = 54;

inline bool same_word(std::string_view word, std::string_view name) {
    return word.size() == name.size() && strncasecmp(word.data(), name.data(), name.size()) == 0;
}

template <class IsOne>
const MeditKeyword* find_keyword(const IsOne& is_one) {
    const auto found = std::find_if(keywords().begin(), keywords().end(), is_one);
    return found == keywords().end() ? nullptr : &*found;
}

/// Takes the text up to the next keyword, and that, off `text`; empty: none is left. Quoted names, nan, inf are none.
inline std::string_view next_keyword(std::string_view& text) {
    const char* const end = text.data() + text.size();
    for (std::string_view word = next_word(text); !word.empty(); word = next_word(text)) {
        const auto letter = static_cast<unsigned char>((word[0] | 0x20) - 'a');
        if (word[0] == '"') {
            text = {word.data() + 1, end};
            text.remove_prefix(std::min(text.find('"'), text.size() - 1) + 1);
        } else if (letter < 26 && !same_word(word, "nan") && !same_word(word, "inf") && !same_word(word, "infinity")) {
            return word;
        }
    }
    return text;
}

/// The integer of 4 or 8 bytes at the beginning, which is taken off; the bytes must be there.
inline std::int64_t take_integer(std::string_view& bytes, std::size_t size, bool swapped) {
    const char* const at = bytes.data();
    bytes.remove_prefix(size);
    return size == 8 ? number_at<std::int64_t>(at, swapped) : number_at<std::int32_t>(at, swapped);
}

template <class Real, class Integer>
void take_rows(const char* bytes, bool swapped, std::size_t count, MeditRows& rows) {
    const std::size_t reals = rows.reals_a_row, integers = rows.integers_a_row;
    in_parts(count, std::size_t{1} << 15, [&](std::size_t first, std::size_t last) {
        const char* at = bytes + first * (reals * sizeof(Real) + integers * sizeof(Integer));
        for (std::size_t row = first; row < last; ++row) {
            for (std::size_t k = 0; k < reals; ++k, at += sizeof(Real))
                rows.reals[row * reals + k] = number_at<Real>(at, swapped);
            for (std::size_t k = 0; k < integers; ++k, at += sizeof(Integer))
                rows.integers[row * integers + k] = number_at<Integer>(at, swapped);
        }
    });
}

inline void make_rows(std::size_t count, MeditRows& rows) {
    base::resize_large(rows.reals, count * rows.reals_a_row);
    base::resize_large(rows.integers, count * rows.integers_a_row);
}

/// Errors are thrown as Exceptions, which read_guarded() makes a Result.
class MeditFile {
public:
    /// Error: no file of Medit; a section that does not end within it; two of one kind; another dimension than 2 or 3.
    explicit MeditFile(const std::string& path) : path_(path) {
        // A large file that is none is not read for that.
        const std::string head = base::InputFile::head(path, 4096).value();
        const std::string_view begin = std::string_view(head).substr(head.starts_with("\xEF\xBB\xBF") ? 3 : 0);
        const std::string_view word = first_word(begin, '#');
        binary_ = is_medit(begin.substr(0, 12)) && begin[1] == 0;
        if (!binary_ && !same_word(word, "MeshVersionFormatted"))
            refuse_line("file.format", path, 1, "not a file of Medit",
                        "\"MeshVersionFormatted\", or in a binary file the numbers 1, 1 to 4, 3",
                        head.empty() ? "an empty file" : base::quoted(word),
                        "check the path: other programs have files of this suffix, too");
        data_ = base::MappedFile::open(path, 1, binary_ ? base::Text::none : base::Text::all).value();
        bytes_ = data_.bytes();
        if (bytes_.starts_with("\xEF\xBB\xBF")) bytes_.remove_prefix(3);
        binary_ ? list_binary() : list_text();
        if (dimension_ == 0)
            refuse("file.syntax", bytes_.data(), "the dimension", "a keyword Dimension", "none", "write it again");
    }

    const std::string& path() const { return path_; }
    int dimension() const { return static_cast<int>(dimension_); }
    bool narrow() const { return binary_ && version_ == 1; }  ///< real numbers are float32
    const std::vector<MeditSection>& sections() const { return sections_; }

    /// Error: fewer numbers or more, or others. Memory is bounded by a multiple of the file's size.
    MeditRows rows(const MeditSection& section, std::size_t reals_a_row, std::size_t integers_a_row) const {
        if (!binary_) return text_rows(section, reals_a_row, integers_a_row);
        MeditRows rows{reals_a_row, integers_a_row, {}, {}};
        const std::size_t row_bytes = reals_a_row * real_bytes() + integers_a_row * integer_bytes();
        if (section.count * row_bytes != section.body.size())
            refuse("file.count", section.body.data(), "the size of " + section.name,
                   std::to_string(section.count * row_bytes) + " bytes for " + std::to_string(section.count) +
                       " rows, for the version is " + std::to_string(version_) + " and the dimension " +
                       std::to_string(dimension_),
                   std::to_string(section.body.size()), cut_short);
        make_rows(section.count, rows);
        const char* const at = section.body.data();
        version_ == 1   ? take_rows<float, std::int32_t>(at, swapped_, section.count, rows)
        : version_ == 4 ? take_rows<double, std::int64_t>(at, swapped_, section.count, rows)
                        : take_rows<double, std::int32_t>(at, swapped_, section.count, rows);
        return rows;
    }

    [[noreturn]] void refuse_in(ErrorCode code, const MeditSection& section, const MeditRows& rows, std::size_t row,
                                std::size_t column, std::string expected, std::string found,
                                std::string remedy = {}) const {
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
        refuse(code, at, "row " + std::to_string(row + 1) + " (from 1) of " + section.name, std::move(expected),
               std::move(found), std::move(remedy));
    }

private:
    void list_text() {
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
                if (next.empty() && next_word(body).empty()) return;
                refuse("file.count", body.data(), "text after the keyword End", "the end of the file", "more");
            }
            if (same_word(keyword, "MeshVersionFormatted")) {
                set_header(version_, body, 0, 4);
            } else if (same_word(keyword, "Dimension")) {
                set_header(dimension_, body, 2, 3);
            } else {
                add(base::printable(keyword.substr(0, 40)),
                    find_keyword([&](const MeditKeyword& k) { return same_word(k.name, keyword); }), body);
            }
        }
        // Without End, what is cut may be a keyword or a number.
        if (!is_white(bytes_.back())) throw Exception(base::unended_number(path_, line_at(rest.data())));
    }

    void list_binary() {
        std::string_view rest = bytes_;
        swapped_ = rest[0] == 0;
        take_integer(rest, 4, swapped_);
        version_ = take_integer(rest, 4, swapped_);
        const std::size_t head = 4 + (version_ >= 3 ? 8 : 4);
        while (true) {
            const char* const at = rest.data();
            if (rest.size() < head)
                refuse("file.truncated", at, "the file ends without the keyword End", "another keyword",
                       std::to_string(rest.size()) + " bytes", cut_short);
            const std::int64_t code = take_integer(rest, 4, swapped_), here = at - bytes_.data(),
                               next = take_integer(rest, head - 4, swapped_);
            if (code == code_of_end) return;
            const MeditKeyword* const known = find_keyword([&](const MeditKeyword& k) { return k.code == code; });
            const std::string name = known != nullptr ? std::string(known->name) : "keyword " + std::to_string(code);
            if (next < here + static_cast<std::int64_t>(head) || next > static_cast<std::int64_t>(bytes_.size()))
                refuse("file.truncated", at, "the place of what follows " + name,
                       "one behind it, in a file of " + std::to_string(bytes_.size()) + " bytes", std::to_string(next),
                       cut_short);
            const std::string_view body = rest.substr(0, static_cast<std::size_t>(next - here) - head);
            rest = bytes_.substr(static_cast<std::size_t>(next));
            code == code_of_dimension ? set_header(dimension_, body, 2, 3) : add(name, known, body);
        }
    }

    void add(std::string name, const MeditKeyword* keyword, std::string_view body) {
        MeditSection section{.keyword = keyword == nullptr ? MeditKeyword{} : *keyword, .name = std::move(name)};
        const MeditKind kind = section.keyword.kind;
        const auto is_same = [&](const MeditSection& one) { return one.keyword.code == section.keyword.code; };
        if (kind != other) {
            if (std::any_of(sections_.begin(), sections_.end(), is_same))
                refuse("file.duplicate", body.data(), "a second section " + section.name, "one", "two");
            section.count =
                static_cast<std::size_t>(take_count(body, integer_bytes(), "the number of rows", 0, max_rows));
        }
        if (kind == solution) {
            for (std::int64_t left = take_count(body, 4, "the number of fields", 1, max_fields); left-- > 0;)
                section.types.push_back(take_count(body, 4, "the type of a field", 1, 4));
        }
        section.body = body;
        sections_.push_back(std::move(section));
    }

    void set_header(std::int64_t& number, std::string_view text, std::int64_t least, std::int64_t most) {
        const bool is_version = &number == &version_;
        const char* const what = is_version ? "the version of the format" : "the dimension";
        if (is_version ? has_version_ : number != 0)
            refuse("file.duplicate", text.data(), std::string(what) + " again", "it once", "it twice");
        has_version_ = has_version_ || is_version;
        number = take_count(text, 4, what, least, most);
        if (binary_) return;
        if (const std::string_view more = next_word(text); !more.empty())
            refuse("file.syntax", more.data(), std::string("more behind ") + what, "a keyword", base::quoted(more));
    }

    std::int64_t take_count(std::string_view& text, std::size_t bytes, const char* what, std::int64_t least,
                            std::int64_t most) const {
        const char* at = text.data();
        std::string found = "the end of the section";
        if (!binary_) {
            const std::string_view word = next_word(text);
            const std::optional<std::uint64_t> number = parse_count(word);
            if (number && std::cmp_greater_equal(*number, least) && std::cmp_less_equal(*number, most))
                return static_cast<std::int64_t>(*number);
            at = word.data();
            if (!word.empty()) found = base::quoted(word);
        } else if (text.size() >= bytes) {
            const std::int64_t number = take_integer(text, bytes, swapped_);
            if (number >= least && number <= most) return number;
            found = std::to_string(number);
        }
        refuse("file.number", at, what, "a number from " + std::to_string(least) + " to " + std::to_string(most),
               found);
    }

    MeditRows text_rows(const MeditSection& section, std::size_t reals, std::size_t integers) const {
        MeditRows rows{reals, integers, {}, {}};
        const std::size_t width = reals + integers;
        const std::string wanted = std::to_string(section.count) + " rows of " + std::to_string(width) + " numbers";
        std::string_view text = section.body;
        // Rows of both are read as real numbers.
        std::vector<double> numbers;
        const NumberFault fault =
            reals != 0
                ? io::read_text(text, NumberType::float64, section.count * width, integers != 0 ? numbers : rows.reals)
                : io::read_text(text, NumberType::int64, section.count * width, rows.integers);
        if (fault.kind == NumberFault::Kind::too_few)
            refuse("file.truncated", text.data(), "the end of " + section.name, wanted,
                   std::to_string(fault.index) + " numbers", cut_short);
        if (fault)
            refuse_in("file.number", section, rows, fault.index / width, fault.index % width,
                      fault.index % width < reals ? "a number" : "an integer", base::quoted(fault.text),
                      about_real(fault.text, {}, {}).remedy);
        if (const char* const at = text.data(); !next_word(text).empty())
            refuse("file.count", at, "more numbers in " + section.name, wanted, "more",
                   "mend the count, or the dimension");
        if (integers == 0 || reals == 0) return rows;
        make_rows(section.count, rows);
        for (std::size_t i = 0; i < numbers.size(); ++i) {
            const std::size_t row = i / width, column = i % width;
            if (column < reals) {
                rows.reals[row * reals + column] = numbers[i];
            } else if (std::fabs(numbers[i]) <= 0x1p53 && std::trunc(numbers[i]) == numbers[i]) {
                rows.integers[row * integers + column - reals] = static_cast<std::int64_t>(numbers[i]);
            } else {
                refuse_in("file.number", section, rows, row, column, "an integer up to 2^53",
                          base::shortest(numbers[i]));
            }
        }
        return rows;
    }

    std::size_t real_bytes() const { return version_ == 1 ? 4 : 8; }
    std::size_t integer_bytes() const { return version_ == 4 ? 8 : 4; }
    std::size_t line_at(const char* at) const { return binary_ ? 0 : line_of(bytes_, at); }
    template <class... Parts>
    [[noreturn]] void refuse(ErrorCode code, const char* at, std::string what, Parts&&... parts) const {
        if (binary_) what += ", at byte " + std::to_string(at - bytes_.data());
        refuse_line(code, path_, line_at(at), std::move(what), std::forward<Parts>(parts)...);
    }

    std::string path_;
    base::MappedFile data_;
    std::vector<char> uncommented_;  ///< the text, with blanks for comments, if it has any
    std::string_view bytes_;
    bool binary_ = false, swapped_ = false, has_version_ = false;
    std::int64_t version_ = 0, dimension_ = 0;
    std::vector<MeditSection> sections_;
};

}  // namespace barycert::io::medit
