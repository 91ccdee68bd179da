#include "barycert/io/plc/plc_text.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "barycert/base/input_file.hpp"
#include "barycert/base/text.hpp"
#include "barycert/io/formats.hpp"

namespace barycert::io {

bool PlcText::next_line() {
    words_.clear();
    at_ = 0;
    while (words_.empty() && !rest_.empty()) {
        const std::size_t end = std::min(rest_.find('\n'), rest_.size());
        line_ = rest_.substr(0, end);
        rest_.remove_prefix(std::min(end + 1, rest_.size()));
        ++line_number_;
        cut_fields(line_.substr(0, line_.find('#')), " \t\r,", "", words_);
    }
    return !words_.empty();
}

void PlcText::need_line(std::string_view expected) {
    if (!next_line()) fail("the file is truncated", expected, "the end of the file");
}

std::string_view PlcText::take(std::string_view expected) {
    if (words_left() == 0) fail("cannot read", expected, "the end of the line");
    return words_[at_++];
}

std::string_view PlcText::take_whole(std::string_view expected) {
    const std::string_view text = take(expected);
    if (text.data() + text.size() == end_) throw Exception(base::unended_number(path_, line_number_));
    return text;
}

std::int32_t PlcText::take_integer(std::string_view expected) {
    const std::string_view text = take_whole(expected);
    std::string_view digits = text;
    if (digits.size() > 1 && digits[0] == '+' && digits[1] != '-') digits.remove_prefix(1);
    const std::optional<std::int32_t> value = whole_number<std::int32_t>(digits);
    if (!value) fail("cannot read", expected, text);
    return *value;
}

double PlcText::take_number(std::string_view expected) {
    const std::string_view text = take_whole(expected);
    const std::optional<double> value = base::parse_double(text);
    if (!value || !std::isfinite(*value)) fail("cannot read", std::string(expected) + ", a finite number", text);
    return *value;
}

std::size_t PlcText::take_count(std::string_view expected) {
    const std::int32_t value = take_integer(expected);
    if (value < 0) fail("cannot read", expected, std::to_string(value));
    if (static_cast<std::size_t>(value) > size_ / 2)
        fail("the count is more than the file can hold", {}, std::to_string(value));
    return static_cast<std::size_t>(value);
}

void PlcText::fail(std::string_view what, std::string_view expected, std::string_view found,
                   std::string_view remedy) const {
    constexpr std::size_t longest = 60;
    std::string shown(found.substr(0, longest));
    if (found.size() > longest) shown += "...";
    throw Exception({.what = std::string(what),
                     .file = path_,
                     .line = line_number_,
                     .expected = std::string(expected),
                     .found = std::move(shown),
                     .remedy = std::string(remedy)});
}

}  // namespace barycert::io
