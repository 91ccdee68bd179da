#include "barycert/io/formats.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>

#include "barycert/io/vtk_files.hpp"

namespace barycert::io {
namespace {

struct Suffix {
    std::string_view text;
    FileFormat format;
};

constexpr std::array<Suffix, 4> suffixes{
    {{".csv", FileFormat::csv}, {".npy", FileFormat::npy}, {".node", FileFormat::node}, {".vtu", FileFormat::vtu}}};

const VtkFiles* installed = nullptr;

}  // namespace

bool has_suffix(std::string_view path, std::string_view suffix) {
    if (path.size() < suffix.size()) return false;
    return std::equal(
        suffix.begin(), suffix.end(), path.end() - static_cast<std::ptrdiff_t>(suffix.size()),
        [](char a, char b) { return a == static_cast<char>(std::tolower(static_cast<unsigned char>(b))); });
}

bool is_vtk_file(std::string_view path) {
    return has_suffix(path, ".vtu") || has_suffix(path, ".vtk") || has_suffix(path, ".vtp");
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

const VtkFiles* vtk_files() {
    return installed;
}

void set_vtk_files(const VtkFiles* files) {
    installed = files;
}

Error vtk_missing(const std::string& path) {
    return {.what = "this build has no VTK, which reads and writes .vtu, .vtk and .vtp files",
            .file = path,
            .remedy =
                "install libvtk9-dev and configure with -DBARYCERT_VTK=ON, or convert the mesh with `meshio convert "
                "IN.vtu OUT.node`, which keeps linear tetrahedra but not every field"};
}

}  // namespace barycert::io
