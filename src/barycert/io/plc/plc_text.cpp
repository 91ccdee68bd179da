#include "barycert/io/plc/plc_text.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <system_error>
#include <utility>

#include "barycert/base/input_file.hpp"
#include "barycert/base/text.hpp"
#include "barycert/environment.hpp"
#include "barycert/io/formats.hpp"

namespace barycert::io {
namespace {

/// Of the first block, which ends in the middle: what is wrong there in whole lines.
Status check_beginning_of(std::string_view block, std::size_t size, const std::string& path) {
    block = block.substr(0, block.rfind('\n') + 1);
    if (block.starts_with("\xEF\xBB\xBF")) block.remove_prefix(3);
    PlcText in(path, block, size);
    Plc ignored;
    const Status read = status_of([&] {
        if (has_suffix(path, ".off")) {
            read_off(in);
        } else if (has_suffix(path, ".ply")) {
            read_ply(in);
        } else {
            read_nodes(in, ignored);
        }
    });
    return in.rest().empty() ? Status(Done{}) : read;
}

}  // namespace

std::string read_whole_file(const std::string& path) {
    std::error_code code;
    const std::filesystem::file_status status = std::filesystem::status(path, code);
    if (code == std::errc::permission_denied)
        refuse_file(path, "cannot read", "a file in a folder that you may search", "permission denied");
    if (!std::filesystem::exists(status)) refuse_file(path, "no such file");
    if (std::filesystem::is_directory(status)) refuse_file(path, "cannot read", "a file", "a directory");
    // A binary .stl may begin with zeros; its size tells at once whether it is one.
    const bool stl = has_suffix(path, ".stl");
    if (stl) check_stl_size(path);
    const auto header = [&](std::string_view block, std::uint64_t size) {
        return check_beginning_of(block, size, path);
    };
    Result<std::string> text =
        base::read_file(path, base::longest_pipe, stl ? base::Text::none : base::Text::all, header);
    if (!text) throw Exception(text.error());
    if (text->empty()) refuse_file(path, "cannot read", "a PLC", "an empty file");
    if (const OtherFormat* packed = packed_format(*text); packed != nullptr)
        throw Exception(other_format_error(*packed, path));
    if (text->starts_with("\xEF\xBB\xBF")) text->erase(0, 3);  // byte order mark
    return std::move(*text);
}

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
    std::int32_t value = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (error != std::errc{} || end != digits.data() + digits.size()) fail("cannot read", expected, text);
    return value;
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

std::string node_path_of(const std::string& path) {
    return std::filesystem::path(path).replace_extension(".node").string();
}

}  // namespace barycert::io

namespace barycert {

using namespace io;

std::vector<std::string> plc_files(const std::string& path) {
    const std::filesystem::path p(path);
    if (p.extension() != ".poly" && p.extension() != ".smesh") return {path};
    return {path, node_path_of(path)};
}

Result<Plc> read_plc(const std::string& path) {
    const ExactEnvironment environment;
    const std::string extension = std::filesystem::path(without_gz(path)).extension().string();
    if (std::find(plc_extensions.begin(), plc_extensions.end(), extension) == plc_extensions.end())
        return file_error(path, "unknown kind of PLC", "one of .poly .smesh .off .stl .ply",
                          extension.empty() ? "no extension" : extension);
    try {
        const std::string text = read_whole_file(path);
        PlcText in(path, text);
        Plc plc = extension == ".off"   ? read_off(in)
                  : extension == ".stl" ? read_stl(in)
                  : extension == ".ply" ? read_ply(in)
                                        : read_poly(in, extension == ".smesh");
        if (plc.facets.empty()) return file_error(path, "nothing to mesh: the PLC has no facets");
        if (plc.point_count() < 4) return file_error(path, "nothing to mesh: a PLC needs four nodes");
        return plc;
    } catch (const Exception& problem) {
        return problem.error();
    }
}

}  // namespace barycert
