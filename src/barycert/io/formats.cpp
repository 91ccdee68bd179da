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

struct Suffix {
    std::string_view text;
    FileFormat format;
};

constexpr std::array<Suffix, 4> suffixes{
    {{".csv", FileFormat::csv}, {".npy", FileFormat::npy}, {".node", FileFormat::node}, {".vtu", FileFormat::vtu}}};

}  // namespace

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
    return file_error(path, "unknown file suffix",
                      ".csv, .npy, .node or .vtu, or - for CSV from standard input or on standard output",
                      has_suffix ? '"' + path.substr(dot) + '"' : "no suffix", "rename the file, or convert it");
}

Result<FileFormat> format_of_points(const std::string& path) {
    for (const std::string_view suffix : {".txt", ".dat", ".xyz", ".tsv"}) {
        if (has_suffix(path, suffix)) return FileFormat::csv;
    }
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
    const Result<base::InputFile> file = base::InputFile::open(path);
    std::array<char, 1024> bytes{};
    const Result<std::size_t> size = file ? file->read_at(0, bytes, path) : Result<std::size_t>(file.error());
    if (!size) return size.error();
    const std::string_view head(bytes.data(), *size);
    if (head.starts_with("\x93NUMPY")) return FileFormat::npy;
    const bool text = head.find('\0') == std::string_view::npos && !head.starts_with('<') && !head.starts_with('$') &&
                      !head.starts_with("# vtk");
    return text ? Result<FileFormat>(FileFormat::csv) : by_suffix;
}

bool is_vtk_points_file(std::string_view path) {
    return is_vtk_file(path) || has_suffix(path, ".vti") || has_suffix(path, ".vtr") || has_suffix(path, ".vts");
}

}  // namespace barycert::io
