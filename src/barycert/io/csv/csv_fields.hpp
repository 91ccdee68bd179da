/// A line of CSV cut into its fields.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

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

}  // namespace barycert::io
