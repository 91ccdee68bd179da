#include "command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "core/base/text.hpp"
#include "files/output_file.hpp"

namespace barycert::cli {
namespace {

/// Members of jobs and what is in them whose options have the same name, with - for _.
constexpr std::string_view same_names =
    " bounds cell_base cell_column colours columns count delaunay family field fields fix fix_orientation image "
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

std::string remembered_arguments;

}  // namespace

void tell(std::string_view text) {
    std::fwrite(text.data(), 1, text.size(), stderr);
    std::fflush(stderr);
}

int fail(Error error) {
    std::fflush(stdout);
    for (std::string* const text : {&error.what, &error.expected, &error.remedy}) *text = with_options(*text);
    tell(fmt::format("error: {}\n", with_command_name(error.message())));
    return exit_error;
}

void tell_important(const Notes& notes) {
    for (const Note& note : with_options(notes)) {
        if (note.important) tell(fmt::format("note: {}\n", with_command_name(message(note))));
    }
}

Status write_output(const std::string& path, std::string_view bytes) {
    if (path == "-") {
        if (std::fwrite(bytes.data(), 1, bytes.size(), stdout) != bytes.size() || std::fflush(stdout) != 0)
            return Error{.what = "cannot write to stdout", .found = std::strerror(errno)};
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
    for (Note& note : notes) note.text = with_options(note.text);
    return notes;
}

std::string command_line() {
    return command_name() + remembered_arguments;
}

void remember_command_line(int argc, const char* const* argv) {
    for (int i = 1; i < argc; ++i) remembered_arguments += " " + base::shell_word(argv[i]);
}

}  // namespace barycert::cli
