#include "barycert/io/formats.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>
#include <filesystem>
#include <system_error>

#include "barycert/base/input_file.hpp"

namespace barycert::io {
namespace {

bool has_one_of(std::string_view path, std::initializer_list<std::string_view> suffixes) {
    return std::any_of(suffixes.begin(), suffixes.end(), [&](std::string_view one) { return has_suffix(path, one); });
}

}  // namespace

void cut_fields(std::string_view line, std::string_view blanks, std::string_view separators,
                std::vector<std::string_view>& fields) {
    const auto is_one = [&](std::size_t i, std::string_view of) {
        return i < line.size() && of.find(line[i]) != std::string_view::npos;
    };
    std::size_t i = 0;
    const auto skip_blanks = [&] {
        while (is_one(i, blanks)) ++i;
    };
    fields.clear();
    bool separated = false;
    for (skip_blanks(); i < line.size(); skip_blanks()) {
        const std::size_t begin = i;
        while (i < line.size() && !is_one(i, blanks) && !is_one(i, separators)) ++i;
        fields.push_back(line.substr(begin, i - begin));
        skip_blanks();
        separated = is_one(i, separators);
        if (separated) ++i;
    }
    if (separated) fields.push_back(line.substr(line.size()));
}

std::string_view without_gz(std::string_view path) {
    return path.ends_with(".gz") ? path.substr(0, path.size() - 3) : path;
}

std::string plain_or_packed(const std::string& path) {
    std::error_code ignored;
    const std::string packed = path + ".gz";
    return !std::filesystem::exists(path, ignored) && std::filesystem::exists(packed, ignored) ? packed : path;
}

bool has_suffix(std::string_view path, std::string_view suffix) {
    path = without_gz(path);
    if (path.size() < suffix.size()) return false;
    return std::equal(
        suffix.begin(), suffix.end(), path.end() - static_cast<std::ptrdiff_t>(suffix.size()),
        [](char a, char b) { return a == static_cast<char>(std::tolower(static_cast<unsigned char>(b))); });
}

std::string suffix_of(const std::string& path) {
    const std::size_t dot = path.find_last_of("./");
    return dot == std::string::npos || path[dot] == '/' ? "" : path.substr(dot);
}

Error unknown_suffix(const std::string& path, std::string what, std::string expected, std::string remedy) {
    const std::string suffix = suffix_of(path);
    return file_error(path, std::move(what), std::move(expected), suffix.empty() ? "no suffix" : '"' + suffix + '"',
                      std::move(remedy));
}

bool is_vtk_file(std::string_view path) {
    return has_one_of(path, {".vtu", ".vtk", ".vtp", ".pvtu", ".pvtp", ".vtm", ".vtpd", ".vtpc", ".pvd", ".series"});
}

bool is_vtk_points_file(std::string_view path) {
    return is_vtk_file(path) || has_one_of(path, {".vti", ".vtr", ".vts"});
}

Result<FileFormat> format_of(const std::string& path) {
    if (path == "-" || has_suffix(path, ".csv")) return FileFormat::csv;
    if (has_suffix(path, ".npy")) return FileFormat::npy;
    if (has_suffix(path, ".node")) return FileFormat::node;
    if (has_suffix(path, ".vtu")) return FileFormat::vtu;
    return unknown_suffix(path, "unknown file suffix",
                          ".csv, .npy, .node or .vtu, or - for CSV from standard input or on standard output",
                          "rename the file, or convert it");
}

Result<FileFormat> format_of_points(const std::string& path) {
    if (has_one_of(path, {".txt", ".dat", ".xyz", ".tsv"})) return FileFormat::csv;
    Result<FileFormat> by_suffix = format_of(path);
    if (by_suffix && *by_suffix != FileFormat::vtu) return by_suffix;
    std::error_code ignored;
    const auto type = std::filesystem::status(path, ignored).type();
    using std::filesystem::file_type;
    // What is opened here cannot be read again.
    if (type == file_type::fifo || type == file_type::character || type == file_type::socket) return FileFormat::csv;
    const std::size_t name = path.find_last_of('/') + 1;
    const bool stem = std::filesystem::exists(path + ".node", ignored);
    if (type != file_type::regular || stem || path.find('.', name) != std::string::npos) return by_suffix;
    const Result<std::string> head = base::InputFile::head(path, 1024);
    if (!head) return head.error();
    if (head->starts_with("\x93NUMPY")) return FileFormat::npy;
    const bool text = head->find('\0') == std::string::npos && !head->starts_with('<') && !head->starts_with('$') &&
                      !head->starts_with("# vtk");
    return text ? Result<FileFormat>(FileFormat::csv) : by_suffix;
}

}  // namespace barycert::io
