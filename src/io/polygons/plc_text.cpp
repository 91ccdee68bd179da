#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include "barycert/error_codes.hpp"
#include "barycert/result.hpp"
#include "files/format.hpp"
#include "files/input_file.hpp"
#include "io/errors.hpp"
#include "io/number_word.hpp"
#include "io/other_formats.hpp"
#include "io/paths.hpp"
#include "io/polygons/polygons.hpp"
#include "io/tetgen/scanner.hpp"
#include "io/words.hpp"

namespace barycert::io {

bool PlcText::next_line() {
    words_.clear();
    at_ = 0;
    while (words_.empty() && !rest_.empty()) {
        line_ = rest_.substr(0, rest_.find('\n'));
        rest_.remove_prefix(std::min(line_.size() + 1, rest_.size()));
        ++line_number_;
        words_ = cut_fields(comments_ ? line_.substr(0, line_.find('#')) : line_, separators_, "");
    }
    return !words_.empty();
}

void PlcText::need_line(std::string_view expected) {
    if (!next_line()) fail("file.truncated", "the file is truncated", expected, "the end of the file");
}

void PlcText::need_line(std::string_view what, std::size_t i, std::size_t count) {
    if (!next_line()) need_line(std::string(what) + " " + std::to_string(i) + " of " + std::to_string(count));
}

std::string_view PlcText::take(std::string_view expected) {
    if (words_left() == 0) fail("file.syntax", "cannot read", expected, "the end of the line");
    return words_[at_++];
}

std::string_view PlcText::take_numeric(std::string_view expected) {
    const std::string_view text = take(expected);
    ends_with_number_ = text.data() + text.size() == end_;
    return text;
}

std::int32_t PlcText::take_integer(std::string_view expected) {
    const std::string_view text = take_numeric(expected);
    const std::optional<std::int32_t> value = integer_of_word<std::int32_t>(text);
    if (!value)
        fail("file.number", "cannot read", expected, text,
             text.find(',') == std::string_view::npos ? "" : "part the numbers by blanks, without commas");
    return *value;
}

double PlcText::take_number(std::string_view expected, bool finite) {
    const std::string_view text = take_numeric(expected);
    const std::optional<double> value = real_of_word(text, finite);
    if (!value)
        fail("file.number", "cannot read", std::string(expected) + (finite ? ", a finite number" : ", a number"), text,
             remedy_for_number(text));
    return *value;
}

void PlcText::need_end(std::string_view expected) const {
    if (words_left() == 0) return;
    // The commas that part words may be decimal ones.
    const bool commas = line_.find(',') != std::string_view::npos;
    fail("file.syntax", "more words in a line than it may have", expected, line_.substr(line_.find_first_not_of(" \t")),
         commas ? "commas part numbers here: if these are decimal ones, write points" : "");
}

void PlcText::note_last_number(Notes& notes) const {
    if (ends_with_number_ && rest_.empty())
        notes.push_back({Note::Kind::guessed,
                         "the last line has no end: its last number is taken as whole, as nothing else is missing",
                         path_, true});
}

std::size_t PlcText::take_count(std::string_view expected) {
    const std::int32_t value = take_integer(expected);
    if (value < 0) fail("file.number", "cannot read", expected, std::to_string(value));
    if (static_cast<std::size_t>(value) > size_ / 2)
        fail("file.count", "the count is more than the file can hold", {}, std::to_string(value));
    return static_cast<std::size_t>(value);
}

void PlcText::fail(ErrorCode code, std::string_view what, std::string_view expected, std::string_view found,
                   std::string_view remedy) const {
    constexpr std::size_t longest = 60;
    std::string shown(found.substr(0, longest));
    if (found.size() > longest) shown += "...";
    refuse_line(code, path_, line_number_, std::string(what), std::string(expected), std::move(shown),
                std::string(remedy));
}

std::string remedy_for_number(std::string_view word) {
    return about_real(word, {}, {}).remedy;
}

std::string read_surface_text(const std::string& path, Separators separators,
                              const std::function<void(PlcText&)>& check) {
    std::error_code code;
    const std::filesystem::file_status status = std::filesystem::status(path, code);
    if (code == std::errc::permission_denied)
        refuse_file("file.unreadable", path, "cannot read", "a file in a folder that you may search",
                    "permission denied");
    if (!std::filesystem::exists(status)) refuse_file("file.missing", path, "no such file");
    if (std::filesystem::is_directory(status))
        refuse_file("file.unreadable", path, "cannot read", "a file", "a directory");
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
        PlcText in(path, block, size, separators);
        const Status read = status_of([&] { check(in); });
        return in.rest().empty() ? Status(Done{}) : read;
    };
    const base::Text certain = binary || base::kind_of(path) == FormatKind::stl ? base::Text::none : base::Text::all;
    std::string text = base::read_file(path, base::longest_pipe, certain, header).value();
    if (text.empty()) refuse_file("file.empty", path, "cannot read", "a PLC", "an empty file");
    if (const base::Format* packed = base::format_that_begins(text); packed != nullptr)
        throw Exception(other_format_error(*packed, path));
    if (text.starts_with("\xEF\xBB\xBF")) text.erase(0, 3);  // byte order mark
    return text;
}

}  // namespace barycert::io
