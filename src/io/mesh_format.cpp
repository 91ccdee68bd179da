#include "io/mesh_format.hpp"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "barycert/gmsh_files.hpp"
#include "barycert/mesh.hpp"
#include "barycert/mesh_files.hpp"
#include "barycert/result.hpp"
#include "barycert/tetgen_files.hpp"
#include "barycert/vtk_files.hpp"
#include "core/base/nearest_name.hpp"
#include "files/format.hpp"
#include "files/input_file.hpp"
#include "io/converted/converted.hpp"
#include "io/errors.hpp"
#include "io/in_space.hpp"
#include "io/medit/medit.hpp"
#include "io/mesh_notes.hpp"
#include "io/other_formats.hpp"
#include "io/paths.hpp"
#include "io/series_steps.hpp"
#include "io/table_format.hpp"
#include "mesh/pulling.hpp"
#include "mesh/threads/arena.hpp"

namespace barycert::io {

namespace fs = std::filesystem;

bool is_read_once(const std::string& path) {
    std::error_code ignored;
    return path == "-" || (fs::exists(path, ignored) && !fs::is_regular_file(path, ignored));
}

Error unknown_suffix(const std::string& path, std::string what, std::string expected, std::string remedy) {
    const std::string suffix = suffix_of(path);
    return file_error("file.suffix", path, std::move(what), std::move(expected),
                      suffix.empty() ? "no suffix" : '"' + suffix + '"', std::move(remedy));
}

Result<FormatKind> format_of_table(const std::string& path) {
    const FormatKind kind = path == "-" ? FormatKind::csv : base::kind_of(path);
    if (kind == FormatKind::csv || kind == FormatKind::npy || kind == FormatKind::node || kind == FormatKind::vtu)
        return kind;
    return unknown_suffix(path, "unknown file suffix",
                          ".csv, .npy, .node or .vtu, or - for CSV from standard input or on standard output",
                          "rename the file, or convert it");
}

Result<FormatKind> format_of_points(const std::string& path) {
    Result<FormatKind> by_suffix = format_of_table(path);
    if (by_suffix && *by_suffix != FormatKind::vtu) return by_suffix;
    std::error_code ignored;
    const fs::file_type type = fs::status(path, ignored).type();
    // A pipe, device or socket that is opened here cannot be read again.
    if (type == fs::file_type::fifo || type == fs::file_type::character || type == fs::file_type::socket)
        return FormatKind::csv;
    const std::size_t name = path.find_last_of('/') + 1;
    if (type != fs::file_type::regular || exists(path + ".node") || path.find('.', name) != std::string::npos)
        return by_suffix;
    const Result<std::string> head = base::InputFile::head(path, 1024);
    if (!head) return head.error();
    if (head->starts_with("\x93NUMPY")) return FormatKind::npy;
    const bool text = head->find('\0') == std::string::npos && !head->starts_with('<') && !head->starts_with('$') &&
                      !head->starts_with("# vtk");
    return text ? Result<FormatKind>(FormatKind::csv) : by_suffix;
}

namespace {

bool is_tetgen_file(const std::string& path) {
    return tetgen_stem(path) != path;
}

std::optional<MeshFormat> format_by_suffix(const std::string& path) {
    if (is_tetgen_file(path)) return MeshFormat::tetgen;
    const FormatKind kind = base::kind_of(path);
    if (base::is_vtk(kind)) return MeshFormat::vtk;
    if (kind == FormatKind::gmsh) return MeshFormat::gmsh;
    if (kind == FormatKind::medit) return MeshFormat::medit;
    return std::nullopt;
}

std::optional<MeshFormat> format_by_content(std::string_view head) {
    if (head.starts_with("\xEF\xBB\xBF")) head.remove_prefix(3);
    if (head.starts_with("$MeshFormat") || head.starts_with("$NOD")) return MeshFormat::gmsh;
    if (head.starts_with("# vtk DataFile") || head.find("<VTKFile") != std::string_view::npos ||
        head.find("\"file-series-version\"") != std::string_view::npos)
        return MeshFormat::vtk;
    if (is_medit(head)) return MeshFormat::medit;
    return std::nullopt;
}

Error missing(const std::string& path) {
    Error error{.code = "file.missing", .what = "no such file", .file = path};
    for (const std::string_view suffix : base::suffixes_with(&base::Format::read, base::Use::mesh)) {
        const std::string named = path + std::string(suffix);
        if (!exists(named) || is_tetgen_file(named)) continue;
        error.remedy = "there is " + named + ": name it with its suffix";
        return error;
    }
    const base::Format* const other = other_format_by_suffix(path);
    if (const std::string near = base::near_file(path); !near.empty() && fs::path(path).has_extension()) {
        error.remedy = "did you mean " + near + "?";
    } else if (other != nullptr && other->meshio == nullptr) {
        error.remedy = "check the path; it would not be read (" + std::string(other->what) +
                       "): " + other_format_error(*other, path).remedy;
    } else if (other != nullptr || (format_by_suffix(path) && !is_tetgen_file(path))) {
        error.remedy = "check the path";
    } else {
        error.remedy = "MESH is the stem of TetGen's files, or one of them: part.1 for part.1.node and part.1.ele";
    }
    return error;
}

/// Format of a file that is there, and is not TetGen's by a stem: one that is read, or another one.
struct KnownFormat {
    std::optional<MeshFormat> format;
    const base::Format* other = nullptr;
};

Result<KnownFormat> look_at(const std::string& path) {
    const Result<std::string> head = base::InputFile::head(path, 4096);
    if (!head) return head.error();
    const std::optional<MeshFormat> by_content = format_by_content(*head), by_suffix = format_by_suffix(path);
    if (by_content) return KnownFormat{by_content};
    if (const base::Format* other = other_format_by_content(*head, path, by_suffix.has_value()); other != nullptr)
        return KnownFormat{{}, other};
    if (by_suffix) return KnownFormat{by_suffix};
    return KnownFormat{{}, other_format_by_suffix(path)};
}

Result<MeshFormat> format_of_file(const std::string& path) {
    const Result<KnownFormat> found = look_at(path);
    if (!found) return found.error();
    if (found->format) return *found->format;
    if (found->other != nullptr && found->other->meshio != nullptr) return MeshFormat::by_meshio;
    if (found->other != nullptr) return other_format_error(*found->other, path);
    return file_error("file.format", path, "barycert does not read this format", formats_read(), {},
                      "TetGen's files have to be named STEM.node and STEM.ele; save others as .vtu or Gmsh's .msh in "
                      "the program that they are of");
}

template <class Read>
Result<Mesh> on_threads(int threads, const Read& read) {
    return threads <= 0 ? read() : base::in_arena(threads, std::numeric_limits<std::size_t>::max(), read);
}

}  // namespace

Result<MeshFormat> mesh_format(const std::string& path) {
    std::error_code code;
    const fs::file_status status = fs::status(path, code);
    if (code == std::errc::permission_denied)
        return file_error("file.unreadable", path, "cannot read the file", {}, "permission denied",
                          "check the permissions of its folder");
    const bool stem = !is_tetgen_file(path) && exists(plain_or_packed(path + ".node"));
    if (stem && (!format_by_suffix(path) || !fs::exists(status))) return MeshFormat::tetgen;
    if (fs::is_directory(status) && exists(path + "/constant/polyMesh"))
        return other_format_error(*other_format_by_suffix("case.foam"), path);
    if (fs::is_directory(status))
        return file_error("file.unreadable", path, "this is a folder", formats_read(), {},
                          "name the file of the mesh in it, or the stem of TetGen's files");
    if (fs::exists(status)) return format_of_file(path);
    // One of TetGen's files may be missing where others are there: their reader knows which.
    if (is_tetgen_file(path) && exists(plain_or_packed(tetgen_stem(path) + ".node"))) return MeshFormat::tetgen;
    return missing(path);
}

std::string meshio_format(const std::string& path) {
    const Result<KnownFormat> found = look_at(path);
    return found && found->other != nullptr && found->other->meshio != nullptr ? found->other->meshio : "";
}

Result<MeshFormat> mesh_output_format(const std::string& path) {
    if (const auto format = format_by_suffix(path); format && base::is_written_as(path, base::Use::mesh))
        return *format;
    const std::string suffix = suffix_of(path);
    // part.1 is a stem: only what others use as a suffix is refused.
    const bool digits = suffix.find_first_not_of("0123456789", 1) == std::string::npos;
    if (digits || is_tetgen_file(path)) return MeshFormat::tetgen;
    return unknown_suffix(path, "unknown format of a mesh to be written",
                          base::suffixes_written(base::Use::mesh) + ", or a stem of TetGen's files",
                          "name a file with one of these suffixes");
}

void note_by_corners(std::size_t cells, const std::string& path, Mesh& mesh) {
    mesh.by_corners = cells;
    const std::string text = std::to_string(cells) + " cells of a higher order: they are taken by their corners";
    if (cells != 0) mesh.notes.push_back({Note::Kind::converted, text, path, true});
}

void cut_into_simplices(Mesh& mesh, const std::string& path) {
    if (mesh.shapes.types.empty()) return;
    std::size_t otherwise = 0;
    if (const auto open = mesh::cut_into_simplices(mesh, {}, &otherwise))
        refuse_file("mesh.faces", path,
                    "the faces of cell " + std::to_string(mesh.cell_number(mesh.shapes.parts[*open])) +
                        " (from 0) do not close",
                    "each edge in two faces of the polyhedron", {}, "write the file again with all faces");
    std::string how = ", each cell and face at its node of lowest number";
    if (otherwise != 0) how += " that sees all of it, or between other nodes (" + std::to_string(otherwise) + " cells)";
    mesh.notes.push_back({Note::Kind::converted,
                          std::to_string(mesh.shapes.count()) + " cells are cut into " +
                              std::to_string(mesh.cell_count()) + (mesh.dimension == 3 ? " tetrahedra" : " triangles") +
                              how,
                          path});
    if (std::string uncut = mesh::told_uncut(mesh); !uncut.empty())
        mesh.notes.push_back({Note::Kind::left_out, std::move(uncut), path, true});
}

void note_lost_names(const std::vector<std::string>& columns, const char* file, Notes& notes) {
    std::string lost;
    for (std::size_t i = 0; i < columns.size(); ++i) {
        if (const std::string own = "attribute" + std::to_string(i); columns[i] != own)
            lost += (lost.empty() ? "" : ", ") + own + " is " + columns[i];
    }
    const Note note{Note::Kind::left_out,
                    std::string("the names of fields, which ") + file + " file cannot hold: " + lost};
    if (!lost.empty() && std::find(notes.begin(), notes.end(), note) == notes.end()) notes.push_back(note);
}

}  // namespace barycert::io

namespace barycert {

Result<Mesh> io::read_mesh_in_space(const std::string& path, const ReadOptions& options, InSpace* space) {
    const Result<MeshFormat> format = mesh_format(path);
    if (!format) return format.error();
    if (options.step.made() && *format != MeshFormat::vtk) return no_series(path);
    if (*format == MeshFormat::gmsh) return read_gmsh_in_space(path, {.step = {}, .threads = options.threads}, space);
    if (*format == MeshFormat::vtk)
        return on_threads(options.threads, [&] { return read_vtk_in_space(path, options, space); });
    if (*format == MeshFormat::medit)
        return on_threads(options.threads, [&] { return read_medit(path, options, space); });
    if (*format == MeshFormat::by_meshio) return read_converted(path, meshio_format(path), space);
    return read_tetgen(path, options);
}

Result<Mesh> read_mesh(const std::string& path, const ReadOptions& options) {
    return io::read_mesh_in_space(path, options, nullptr);
}

std::vector<std::string> mesh_files(const std::string& path) {
    const Result<io::MeshFormat> format = io::mesh_format(path);
    if (format && *format == io::MeshFormat::vtk) return vtk_mesh_files(path);
    if (format && *format == io::MeshFormat::by_meshio) return io::converted_files(path);
    if (format && *format != io::MeshFormat::tetgen) return {path};
    return tetgen_files(path);
}

Status write_mesh(const Mesh& mesh, const std::string& path, const WriteOptions& options) {
    const Result<io::MeshFormat> format = io::mesh_output_format(path);
    if (!format) return format.error();
    if (*format == io::MeshFormat::gmsh) return write_gmsh(mesh, path);
    if (*format == io::MeshFormat::vtk) return write_vtk(mesh, path, options.data);
    return write_tetgen(mesh, tetgen_stem(path), options);
}

Result<std::vector<std::string>> written_mesh_files(const std::string& path) {
    const Result<io::MeshFormat> format = io::mesh_output_format(path);
    if (!format) return format.error();
    return *format == io::MeshFormat::tetgen ? tetgen_files(path) : std::vector<std::string>{path};
}

}  // namespace barycert
