#include "app/cli/command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "barycert/error_report.hpp"
#include "barycert/result.hpp"
#include "core/base/text.hpp"
#include "files/named_file.hpp"
#include "files/output_file.hpp"

namespace barycert::cli {
namespace {

/// Members of jobs and what is in them whose options have the same name, with - for _.
constexpr std::string_view same_names =
    " bounds cell_base cell_column colours columns count delaunay edges family field fields fix fix_orientation image "
    "in_process keep kernel kernel_library line map mask_column merge_within mesh nonfinite_points onto output outside "
    "plane plot points picture range reason results rounding save_map scale seed simplex size spacing step time "
    "tolerance value "
    "vtk_data weights width ";

/// Members whose options have another name.
constexpr std::array<std::pair<std::string_view, std::string_view>, 7> other_names{{
    {"all", "--on-boundary"},
    {"cell_interpolation", "--interpolation"},
    {"counts", "--grid"},
    {"field_files", "--field"},
    {"measures", "--vtu"},
    {"plc", "--conforms-to"},
    {"values", "--value"},
}};

std::string option_of(std::string_view member) {
    for (const auto& [name, option] : other_names) {
        if (name == member) return std::string(option);
    }
    if (member.empty() || same_names.find(fmt::format(" {} ", member)) == std::string_view::npos) return "";
    std::string option = "--" + std::string(member);
    std::replace(option.begin() + 2, option.end(), '_', '-');
    return option;
}

/// Letters of the names of members.
constexpr std::string_view letters = "abcdefghijklmnopqrstuvwxyz_";

/// The option that sets what an error is about: a member of a job or of options, or the option itself.
std::string option_of_subject(std::string_view subject) {
    if (subject.starts_with("--")) return std::string(subject);
    for (const std::string_view owner : {"job.", "options."}) {
        if (subject.starts_with(owner)) return option_of(subject.substr(owner.size()));
    }
    return "";
}

std::vector<std::string> remembered_arguments;
std::string expected_json;

/// True if the file may be replaced by the error: there is none, or it is JSON, as of an earlier run, and no other
/// argument names it. Inputs may not have been looked at yet.
bool may_be_replaced(const std::string& path) {
    const auto names_it = [&](std::string_view argument) {
        const std::size_t value = argument.starts_with("--") ? argument.find('=') + 1 : 0;
        return base::same_file(path, std::string(argument.substr(value)));
    };
    if (std::ranges::count_if(remembered_arguments, names_it) > 1) return false;
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(path, ignored)) return true;
    std::ifstream file(path);
    return file.get() == '{';
}

/// No error of its own: the first one has been told.
void write_json(const Error& error) {
    const std::string path = std::exchange(expected_json, {});
    // Where outputs collide, the place is another file's; where the error is about that output, its name is wrong.
    if (path.empty() || error.code == "file.overwrite" || error.code == "series.place" || error.file == path) return;
    if (path != "-" && !may_be_replaced(path)) return;
    static_cast<void>(write_output(path, error_json(error, option_of_subject(error.subject))));
}

}  // namespace

void tell(std::string_view text) {
    std::fwrite(text.data(), 1, text.size(), stderr);
    std::fflush(stderr);
}

int fail(Error error) {
    std::fflush(stdout);
    for (std::string* const text : {&error.what, &error.expected, &error.remedy}) {
        if (!error.subject.empty()) *text = with_options(*text);
        *text = with_command_name(*text);
    }
    tell(fmt::format("error: {}\n", error.message()));
    write_json(error);
    return exit_error;
}

void expect_json(const std::string& path) {
    expected_json = path;
}

void tell_important(const Notes& notes) {
    for (const Note& note : with_options(notes)) {
        if (note.important) tell(fmt::format("note: {}\n", with_command_name(message(note))));
    }
}

Status write_output(const std::string& path, std::string_view bytes) {
    if (path == "-") {
        if (std::fwrite(bytes.data(), 1, bytes.size(), stdout) != bytes.size() || std::fflush(stdout) != 0)
            return Error{.code = "file.unwritable", .what = "cannot write to stdout", .found = std::strerror(errno)};
        return Done{};
    }
    base::OutputFile file(path);
    file.write(bytes);
    return file.commit();
}

std::string command_name() {
    const char* wrapper = std::getenv("BARYCERT_COMMAND");
    return wrapper == nullptr || *wrapper == '\0' ? "barycert" : base::printable(wrapper);
}

std::string with_command_name(std::string text) {
    base::replace_all(text, "`barycert ", '`' + command_name() + ' ');
    return text;
}

std::string with_options(std::string text) {
    // Options for what the rows of a file of a field belong to.
    for (const auto& [name, option] : {std::pair("FieldFile::Of::points", "--point-field"),
                                       {"FieldFile::Of::cells", "--cell-field"},
                                       {"FieldFile::Of::either", "--field"}})
        base::replace_all(text, name, option);
    for (const std::string_view owner : {"job.", "options."}) {
        for (std::size_t at = text.find(owner); at != std::string::npos; at = text.find(owner, at + 1)) {
            const std::size_t begin = at + owner.size();
            const std::size_t end = std::min(text.find_first_not_of(letters, begin), text.size());
            const std::string option = option_of(std::string_view(text).substr(begin, end - begin));
            const bool part = at > 0 && (letters.find(text[at - 1]) != std::string::npos || text[at - 1] == '"' ||
                                         text[at - 1] == '/');
            if (!option.empty() && !part) text.replace(at, end - at, option);
        }
    }
    return text;
}

Notes with_options(Notes notes) {
    for (Note& note : notes) {
        if (!note.subject.empty()) note.text = with_options(note.text);
    }
    return notes;
}

std::string command_line() {
    std::string line = command_name();
    for (const std::string& argument : remembered_arguments) line += " " + base::shell_word(argument);
    return line;
}

void remember_command_line(int argc, const char* const* argv) {
    for (int i = 1; i < argc; ++i) remembered_arguments.emplace_back(argv[i]);
}

}  // namespace barycert::cli
