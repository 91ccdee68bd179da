/// Layout of a CSV file, which its first line decides, and rows read by it. Errors are thrown as Exceptions.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "barycert/mesh.hpp"
#include "barycert/point_files.hpp"
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

    /// The next field, without quotes around it but doubled ones in it. False: after the last, or malformed().
    bool next(std::string_view& field) {
        if (!more_) return false;
        skip_blanks();
        if (separator_ == ' ' && at_ == end_) return more_ = false;
        quoted_ = at_ != end_ && *at_ == '"';
        const char* const start = quoted_ ? ++at_ : at_;
        const char* stop = nullptr;
        if (quoted_) {
            while (at_ != end_ && (*at_ != '"' || (at_ + 1 != end_ && at_[1] == '"'))) at_ += *at_ == '"' ? 2 : 1;
            malformed_ = at_ == end_;
            if (malformed_) return more_ = false;
            stop = at_++;
            if (separator_ != ' ') skip_blanks();
        } else {
            while (at_ != end_ && !separates(*at_)) ++at_;
            stop = at_;
        }
        more_ = at_ != end_;
        malformed_ = more_ && !separates(*at_);
        if (malformed_) return more_ = false;
        if (more_) ++at_;
        inside_ = {start, static_cast<std::size_t>(stop - start)};
        field = inside_;
        while (!field.empty() && is_blank(field.front())) field.remove_prefix(1);
        while (!field.empty() && is_blank(field.back())) field.remove_suffix(1);
        return true;
    }

    bool malformed() const { return malformed_; }

    bool quoted() const { return quoted_; }

    /// The last field as a text: what stands between quotes with its blanks, and with doubled quotes made one.
    std::string text(std::string_view field) const { return quoted_ ? undoubled(inside_) : std::string(field); }

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

    bool separates(char c) const { return c == separator_ || (separator_ == ' ' && c == '\t'); }

    const char* at_;
    const char* end_;
    char separator_;
    bool more_ = true;
    bool malformed_ = false;
    bool quoted_ = false;
    std::string_view inside_;  // of the last field, with its blanks
};

struct CsvLayout {
    /// A coordinate (0, 1, 2; in the plane 2 is a z that must be 0), one of these, or carried column first_kept + k.
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

struct LinePlace {
    std::string file;
    std::size_t line = 0;
};

/// Not blank and no comment. With tabs as separator a line of tabs is a row without values, and so not blank.
inline bool holds_fields(std::string_view line, char separator) {
    const std::size_t at = line.find_first_not_of(" \t");
    if (at == std::string_view::npos) return separator == '\t' && line.find('\t') != std::string_view::npos;
    return line[at] != '#';
}

struct CsvLine {
    char separator = ',';
    std::vector<std::string> fields{};
};
CsvLine cut_first_line(std::string_view line, const LinePlace& place);

/// Begins as numbers do, or is a word for one. A field that is meant as a number must not make its line a header.
bool looks_numeric(std::string_view field);

/// From the first line that holds fields. Carried columns are texts.
CsvLayout settle_csv_layout(std::string_view line, int dimension, const PointOptions& options, const LinePlace& place);

inline std::string separator_name(char separator) {
    return separator == ',' ? "commas" : separator == ';' ? "semicolons" : separator == '\t' ? "tabs" : "blanks";
}

/// Refuses a line with `count` fields if the layout has not as many, and one with a quote that is not closed.
void check_cut(const FieldCutter& cutter, std::string_view line, std::size_t count, const CsvLayout& layout,
               const LinePlace& place);

/// Results of whole lines; the last line of the file may lack its end.
struct CsvPiece {
    std::vector<double> points;   ///< of the lines before the bad one
    std::vector<Column> carried;  ///< likewise
    std::size_t lines = 0;        ///< parsed, the bad one included
    std::optional<Error> fault;   ///< of that one, without file and number of the line
};

/// Parses `text` up to its end or the first bad line. The byte after it must be readable. Keeps the memory of `piece`.
void parse_csv(std::string_view text, const CsvLayout& layout, int dimension, CsvPiece& piece);

/// The integer of 64 bits in its shortest decimal form: no +, no leading zero, so that 007 stays a text; or nothing.
std::optional<std::int64_t> integer_of(std::string_view field);

/// The decimal number without leading zeros, nan or inf; NaN of an empty text. Nothing: another, or an inexact integer.
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
    Column::Type type() const {
        if (any && integers && !empty) return Column::Type::integer;
        return any && numbers ? Column::Type::number : Column::Type::text;
    }
};

}  // namespace barycert::io
