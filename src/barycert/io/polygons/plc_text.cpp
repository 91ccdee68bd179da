#include "barycert/io/polygons/polygons.hpp"

#include <cmath>
#include <filesystem>

namespace barycert::io {

bool PlcText::next_line() {
    words_.clear();
    at_ = 0;
    while (words_.empty() && !rest_.empty()) {
        line_ = rest_.substr(0, rest_.find('\n'));
        rest_.remove_prefix(std::min(line_.size() + 1, rest_.size()));
        ++line_number_;
        words_ = cut_fields(line_.substr(0, line_.find('#')), " \t\r,", "");
    }
    return !words_.empty();
}

void PlcText::need_line(std::string_view expected) {
    if (!next_line()) fail("the file is truncated", expected, "the end of the file");
}

void PlcText::need_line(std::string_view what, std::size_t i, std::size_t count) {
    if (!next_line()) need_line(std::string(what) + " " + std::to_string(i) + " of " + std::to_string(count));
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

std::int32_t PlcText::take_integer(std::string_view expected, char end) {
    const std::string_view text = take_whole(expected);
    std::string_view digits = text.substr(0, text.find(end));
    if (digits.size() > 1 && digits[0] == '+' && digits[1] != '-') digits.remove_prefix(1);
    const std::optional<std::int32_t> value = whole_number<std::int32_t>(digits);
    if (!value) fail("cannot read", expected, text);
    return *value;
}

double PlcText::take_number(std::string_view expected, bool finite) {
    const std::string_view text = take_whole(expected);
    const std::optional<double> value = base::parse_double(text);
    if (!value || (finite && !std::isfinite(*value)))
        fail("cannot read", std::string(expected) + (finite ? ", a finite number" : ", a number"), text);
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
    refuse_line(path_, line_number_, std::string(what), std::string(expected), std::move(shown), std::string(remedy));
}

std::string read_surface_text(const std::string& path, const std::function<void(PlcText&)>& check) {
    std::error_code code;
    const std::filesystem::file_status status = std::filesystem::status(path, code);
    if (code == std::errc::permission_denied)
        refuse_file(path, "cannot read", "a file in a folder that you may search", "permission denied");
    if (!std::filesystem::exists(status)) refuse_file(path, "no such file");
    if (std::filesystem::is_directory(status)) refuse_file(path, "cannot read", "a file", "a directory");
    // A binary file may begin with zeros; its beginning, or its size, tells at once whether it is one.
    bool binary = false;
    if (const Result<base::InputFile> file = base::InputFile::open(path); file) {
        std::string block(base::first_block, '\0');
        if (const Result<std::size_t> size = file->read_at(0, block, path); size)
            binary = is_binary_surface(path, std::string_view(block).substr(0, *size), file->size());
    }
    const auto header = [&](std::string_view block, std::uint64_t size) {
        // It ends in the middle of a line: what is wrong with the whole ones is told.
        block = block.substr(0, block.rfind('\n') + 1);
        if (block.starts_with("\xEF\xBB\xBF")) block.remove_prefix(3);
        PlcText in(path, block, size);
        const Status read = status_of([&] { check(in); });
        return in.rest().empty() ? Status(Done{}) : read;
    };
    const base::Text certain = binary || has_suffix(path, ".stl") ? base::Text::none : base::Text::all;
    std::string text = base::read_file(path, base::longest_pipe, certain, header).value();
    if (text.empty()) refuse_file(path, "cannot read", "a PLC", "an empty file");
    if (const OtherFormat* packed = packed_format(text); packed != nullptr)
        throw Exception(other_format_error(*packed, path));
    if (text.starts_with("\xEF\xBB\xBF")) text.erase(0, 3);  // byte order mark
    return text;
}

}  // namespace barycert::io
