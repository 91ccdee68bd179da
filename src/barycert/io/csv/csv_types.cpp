#include "barycert/io/csv/csv_types.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>

#include "barycert/base/text.hpp"
#include "barycert/io/tetgen/scanner.hpp"

namespace barycert::io {

std::optional<std::int64_t> integer_of(std::string_view field) {
    const std::string_view digits = field.substr(field.starts_with('-') ? 1 : 0);
    if (digits.empty() || (digits.front() == '0' && field.size() != 1)) return std::nullopt;
    std::int64_t value = 0;
    const char* const last = field.data() + field.size();
    const auto [end, error] = std::from_chars(field.data(), last, value);
    if (error != std::errc{} || end != last) return std::nullopt;
    return value;
}

std::optional<double> number_of(std::string_view field) {
    if (field.empty()) return std::numeric_limits<double>::quiet_NaN();
    const std::string_view body = field.substr(field.starts_with('-') || field.starts_with('+') ? 1 : 0);
    if (body.size() > 1 && body.front() == '0' && (is_digit(body[1]) || body[1] == 'x' || body[1] == 'X'))
        return std::nullopt;
    const std::optional<double> value = base::parse_double(field);
    return value && is_inexact(field, *value) ? std::nullopt : value;
}

bool is_inexact(std::string_view text, double value) {
    if (std::fabs(value) < 0x1p53) return false;
    if (text.starts_with('-') || text.starts_with('+')) text.remove_prefix(1);
    if (text.find_first_not_of("0123456789") != std::string_view::npos) return false;
    text.remove_prefix(std::min(text.find_first_not_of('0'), text.size()));
    // Every double from 2^53 on is an integer: the same one if it has the same digits.
    std::array<char, 512> digits{};
    const auto [end, error] =
        std::to_chars(digits.data(), digits.data() + digits.size(), std::fabs(value), std::chars_format::fixed, 0);
    return std::string_view(digits.data(), static_cast<std::size_t>(end - digits.data())) != text;
}

void TypeOfTexts::see(std::string_view text) {
    if (text.empty()) {
        empty_ = true;
        return;
    }
    any_ = true;
    // An integer is a number, unless no double represents it.
    if (integers_ && !integer_of(text)) integers_ = false;
    if (!numbers_) return;
    const std::optional<double> value = number_of(text);
    if (!value) numbers_ = false;
    lost_ = lost_ || (value == 0.0 &&
                      text.substr(0, text.find_first_of("eE")).find_first_of("123456789") != std::string_view::npos);
}

Column::Type TypeOfTexts::type() const {
    if (any_ && integers_ && !empty_) return Column::Type::integer;
    return any_ && numbers_ ? Column::Type::number : Column::Type::text;
}

}  // namespace barycert::io
