#include "barycert/io/csv/csv_layout.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <iterator>
#include <limits>
#include <string>

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

bool is_rounded(std::string_view text, double value) {
    // A double holds 15 digits, unless it is subnormal, and has 767 at most.
    constexpr std::size_t held = 15, most = 767;
    const bool normal = std::fabs(value) >= std::numeric_limits<double>::min();
    if (normal && text.size() <= held) return false;
    const auto digits_of = [](std::string_view number) {
        number = number.substr(0, number.find_first_of("eE"));
        std::string digits;
        std::copy_if(number.begin(), number.end(), std::back_inserter(digits), is_digit);
        digits.erase(0, std::min(digits.find_first_not_of('0'), digits.size()));
        return digits.substr(0, digits.find_last_not_of('0') + 1);
    };
    const std::string digits = digits_of(text);
    if (digits.empty() || (normal && digits.size() <= held)) return false;
    if (digits.size() > most) return true;
    std::array<char, 800> nearest{};
    const auto [end, error] = std::to_chars(nearest.data(), nearest.data() + nearest.size(), value,
                                            std::chars_format::scientific, static_cast<int>(digits.size()) - 1);
    return digits_of({nearest.data(), static_cast<std::size_t>(end - nearest.data())}) != digits;
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
    numbers_ = value.has_value();
    if (!numbers_ || !is_rounded(text, *value)) return;
    (*value == 0 ? lost_ : rounded_) = true;
}

Column::Type TypeOfTexts::type() const {
    if (any_ && integers_ && !empty_) return Column::Type::integer;
    return any_ && numbers_ ? Column::Type::number : Column::Type::text;
}

}  // namespace barycert::io
