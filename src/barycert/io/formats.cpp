#include "barycert/io/formats.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>

namespace barycert::io {
namespace {

struct Suffix {
    std::string_view text;
    FileFormat format;
};

constexpr std::array<Suffix, 4> suffixes{
    {{".csv", FileFormat::csv}, {".npy", FileFormat::npy}, {".node", FileFormat::node}, {".vtu", FileFormat::vtu}}};

}  // namespace

bool has_suffix(std::string_view path, std::string_view suffix) {
    if (path.size() < suffix.size()) return false;
    return std::equal(
        suffix.begin(), suffix.end(), path.end() - static_cast<std::ptrdiff_t>(suffix.size()),
        [](char a, char b) { return a == static_cast<char>(std::tolower(static_cast<unsigned char>(b))); });
}

bool is_vtk_file(std::string_view path) {
    constexpr std::array<std::string_view, 10> suffixes_of_vtk{".vtu", ".vtk",  ".vtp",  ".pvtu", ".pvtp",
                                                               ".vtm", ".vtpd", ".vtpc", ".pvd",  ".series"};
    return std::any_of(suffixes_of_vtk.begin(), suffixes_of_vtk.end(),
                       [&](std::string_view suffix) { return has_suffix(path, suffix); });
}

Result<FileFormat> format_of(const std::string& path) {
    if (path == "-") return FileFormat::csv;
    for (const Suffix& suffix : suffixes) {
        if (has_suffix(path, suffix.text)) return suffix.format;
    }
    const std::size_t dot = path.find_last_of("./");
    const bool has_suffix = dot != std::string::npos && path[dot] == '.';
    return Error{.what = "unknown file suffix",
                 .file = path,
                 .expected = ".csv, .npy, .node or .vtu, or - for CSV from standard input or on standard output",
                 .found = has_suffix ? '"' + path.substr(dot) + '"' : "no suffix",
                 .remedy = "rename the file, or convert it"};
}

bool is_vtk_points_file(std::string_view path) {
    return is_vtk_file(path) || has_suffix(path, ".vti") || has_suffix(path, ".vtr") || has_suffix(path, ".vts");
}

}  // namespace barycert::io
