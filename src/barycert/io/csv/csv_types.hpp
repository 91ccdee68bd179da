/// What the texts of a column of CSV are: integers, numbers, or texts.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "barycert/mesh.hpp"

namespace barycert::io {

/// The integer in its shortest decimal form, as whoever writes integers writes it: no +, no leading zero, so that 007
/// stays a text; nothing for other texts, and for integers beyond 64 bits.
std::optional<std::int64_t> integer_of(std::string_view field);

/// The number, in decimal form without leading zeros; nan and inf in any case; NaN of an empty text. Nothing for other
/// texts, and for integers that no double represents.
std::optional<double> number_of(std::string_view field);

/// True if the text is an integer, in digits alone, and no double represents it; `value` is the nearest one.
bool is_inexact(std::string_view text, double value);

/// True if the text is a decimal number that no double holds: `value`, the nearest one, is another number when it is
/// written with as many digits.
bool is_rounded(std::string_view text, double value);

/// The type that holds all texts that it has seen without loss.
class TypeOfTexts {
public:
    void see(std::string_view text);

    /// Numbers, of which some are not 0, but have 0 for the nearest double.
    bool has_lost_numbers() const { return type() == Column::Type::number && lost_; }
    /// Numbers, of which some have more digits than their nearest doubles.
    bool has_rounded_numbers() const { return type() == Column::Type::number && rounded_; }
    /// Numbers, of which some are missing.
    bool has_missing_numbers() const { return type() == Column::Type::number && empty_; }

    /// Text, too, where there was none but empty ones.
    Column::Type type() const;

private:
    bool integers_ = true, numbers_ = true, empty_ = false, any_ = false, lost_ = false, rounded_ = false;
};

}  // namespace barycert::io
