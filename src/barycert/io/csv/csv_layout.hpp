/// What the first line of a CSV file tells about the others, and rows that are read so. Errors are thrown as
/// Exceptions.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "barycert/io.hpp"
#include "barycert/mesh.hpp"
#include "barycert/result.hpp"

namespace barycert::io {

/// Cuts at a comma, semicolon or tab, or at runs of blanks (spaces and tabs) where the separator is ' '.
/// Blanks around a field do not belong to it, but a tab that separates is no blank. A field that begins with a double
/// quote ends at the next one that is not doubled.
class FieldCutter {
public:
    /// The byte after the line must be readable.
    FieldCutter(std::string_view line, char separator)
        : at_(line.data()), end_(line.data() + line.size()), separator_(separator) {}

    /// The next field, without quotes around it but with doubled quotes in it. False after the last, and at a quote
    /// that is not closed or not followed by a separator: see malformed().
    bool next(std::string_view& field) {
        if (!more_) return false;
        skip_blanks();
        if (separator_ == ' ' && at_ == end_) return more_ = false;
        quoted_ = at_ != end_ && *at_ == '"';
        if (quoted_) return next_quoted(field);
        const char* const start = at_;
        if (separator_ == ' ') {
            while (at_ != end_ && !is_blank(*at_)) ++at_;
        } else {
            while (at_ != end_ && *at_ != separator_) ++at_;
        }
        field = without_blanks_after(start, at_);
        pass_separator();
        return true;
    }

    bool malformed() const { return malformed_; }

    /// The last field stood in quotes.
    bool quoted() const { return quoted_; }

    /// The last field as a text: what stands between quotes with its blanks, and with doubled quotes made one.
    std::string text(std::string_view field) const { return quoted_ ? undoubled(inside_) : std::string(field); }

    /// The same without blanks around it.
    std::string name(std::string_view field) const { return quoted_ ? undoubled(field) : std::string(field); }

private:
    static std::string undoubled(std::string_view inside) {
        std::string out;
        for (std::size_t i = 0; i < inside.size(); ++i) {
            out += inside[i];
            if (inside[i] == '"') ++i;
        }
        return out;
    }

    bool is_blank(char c) const { return c == ' ' || (c == '\t' && separator_ != '\t'); }

    void skip_blanks() {
        while (at_ != end_ && is_blank(*at_)) ++at_;
    }

    std::string_view without_blanks_after(const char* start, const char* stop) const {
        while (stop != start && is_blank(stop[-1])) --stop;
        return {start, static_cast<std::size_t>(stop - start)};
    }

    void pass_separator() {
        more_ = at_ != end_;
        if (more_) ++at_;
    }

    bool next_quoted(std::string_view& field) {
        const char* const start = ++at_;
        while (at_ != end_ && (*at_ != '"' || (at_ + 1 != end_ && at_[1] == '"'))) at_ += *at_ == '"' ? 2 : 1;
        if (at_ == end_) return fail();
        const char* const stop = at_++;
        if (separator_ == ' ' && at_ != end_ && !is_blank(*at_)) return fail();
        if (separator_ != ' ') skip_blanks();
        if (separator_ != ' ' && at_ != end_ && *at_ != separator_) return fail();
        pass_separator();
        inside_ = {start, static_cast<std::size_t>(stop - start)};
        const char* first = start;
        while (first != stop && is_blank(*first)) ++first;
        field = without_blanks_after(first, stop);
        return true;
    }

    bool fail() {
        more_ = false;
        malformed_ = true;
        return false;
    }

    const char* at_;
    const char* end_;
    char separator_;
    bool more_ = true;
    bool malformed_ = false;
    bool quoted_ = false;
    std::string_view inside_;  // of the last quoted field
};

struct CsvLayout {
    /// What a field is: a coordinate (0, 1, 2; in the plane 2 is a z that must be 0), one of these, or first_kept + k
    /// for the carried column k.
    enum Role : int { passed_over = -1, must_be_empty = -2, first_kept = 3 };

    char separator = ',';              ///< ',' ';' '\t', or ' ' for blanks
    std::vector<int> role_of{};        ///< one a field
    bool header = false;               ///< the first line is a header
    bool flat = false;                 ///< there is a z that must be 0
    bool plain = true;                 ///< fields are coordinates or passed over
    bool any_point = false;            ///< points that are not finite are points
    std::vector<ColumnFormat> kept{};  ///< the carried columns
    Notes notes{};

    /// Whether the field is a coordinate, and its value: NaN of an empty field, if that may be.
    bool coordinate(std::string_view field, double& value) const;
};

/// Where a line stands.
struct LinePlace {
    std::string file;
    std::size_t line = 0;
};

/// Not blank and no comment. With tabs as separator a line of tabs is a row without values, and so not blank.
bool holds_fields(std::string_view line, char separator);

/// The separator and the fields of the first line that holds fields.
struct CsvLine {
    char separator = ',';
    std::vector<std::string> fields{};
};
CsvLine cut_first_line(std::string_view line, const LinePlace& place);

/// Begins as numbers do, or is a word for one. What is meant as a number must not make its line a header.
bool looks_numeric(std::string_view field);

/// From the first line that holds fields. Carried columns are texts.
CsvLayout settle_csv_layout(std::string_view line, int dimension, const PointOptions& options, const LinePlace& place);

std::string separator_name(char separator);

/// Why the row was refused. Slow: called once.
Error csv_row_error(std::string_view line, const CsvLayout& layout, const LinePlace& place);

/// What became of whole lines; the last of the file may lack its end.
struct CsvPiece {
    std::vector<double> points;   ///< of the lines before the bad one
    std::vector<Column> carried;  ///< likewise
    std::size_t lines = 0;        ///< parsed, the bad one included
    bool failed = false;
    std::string_view bad;  ///< the line that is no point, without its end
    bool cut = false;      ///< it ends with the file, and within a value: 0.2 may be the beginning of 0.25
};

/// Parses `text` up to its end or the first bad line. The byte after the text must be readable. Keeps the memory of
/// `piece`.
void parse_csv(std::string_view text, const CsvLayout& layout, int dimension, CsvPiece& piece);

/// The integer in its shortest decimal form, as whoever writes integers writes it: no +, no leading zero, so that 007
/// stays a text; nothing for other texts, and for integers beyond 64 bits.
std::optional<std::int64_t> integer_of(std::string_view field);

/// The number, in decimal form without leading zeros; nan and inf in any case; NaN of an empty text. Nothing for other
/// texts, and for integers that no double represents.
std::optional<double> number_of(std::string_view field);

/// True if the text is an integer, in digits alone, and no double represents it; `value` is the nearest one.
bool is_inexact(std::string_view text, double value);

/// The type that holds all texts that it has seen without loss.
struct TypeOfTexts {
    bool integers = true, numbers = true;  ///< all of them are
    bool empty = false, any = false;       ///< some are empty, some not
    bool lost = false;                     ///< some numbers are not 0, but have 0 for the nearest double
    bool rounded = false;                  ///< some have more digits than their nearest doubles

    void see(std::string_view text);

    /// Text, too, where there was none but empty ones.
    Column::Type type() const;
};

}  // namespace barycert::io
