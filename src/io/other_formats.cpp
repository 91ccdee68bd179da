#include "io/other_formats.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "barycert/result.hpp"
#include "core/base/text.hpp"
#include "files/format.hpp"
#include "io/in_space.hpp"
#include "io/number_word.hpp"
#include "io/other_formats.hpp"
#include "io/paths.hpp"
#include "io/words.hpp"

namespace barycert::io {
namespace {

using base::Format;
using base::format_with;

// Without suffixes of their own: .msh and .poly are another format's.
constexpr Format fluent{.what = "a mesh of Fluent", .meshio = "ansys"};
constexpr Format freefem{.what = "a mesh of FreeFem",
                         .remedy = "make it a file of Medit with {freefem}; a mesh in space with mesh3 and readmesh3"};
constexpr Format flat_poly{.what = "a PLC in the plane, not a mesh",
                           .remedy = "mesh it with Triangle, whose .node and .ele are read",
                           .is_mesh = false};

/// A count and the dimension 2.
bool is_flat_poly(std::string_view head) {
    const std::string_view count = first_word(head, '#');
    if (count.empty()) return false;
    const std::string_view rest = head.substr(static_cast<std::size_t>(count.data() + count.size() - head.data()));
    return first_word(rest.substr(0, rest.find('\n')), '#') == "2";
}

/// Three counts on the first line.
bool is_freefem(std::string_view head) {
    const std::vector<std::string_view> words = cut_fields(head.substr(0, head.find('\n')), " \r", "");
    return words.size() == 3 && std::ranges::all_of(words, [](std::string_view word) {
               return word.find_first_not_of("0123456789") == std::string_view::npos;
           });
}

/// The next line that is neither blank nor a comment; taken off.
std::string_view next_line_of(std::string_view& text, std::string_view comment) {
    while (!text.empty()) {
        std::string_view line = text.substr(0, text.find('\n'));
        text.remove_prefix(std::min(line.size() + 1, text.size()));
        line.remove_prefix(std::min(line.find_first_not_of(" \t\r"), line.size()));
        if (!line.empty() && !line.starts_with(comment)) return line;
    }
    return {};
}

/// A keyword of Abaqus, behind comments.
bool is_abaqus(std::string_view head) {
    const std::string_view line = next_line_of(head, "**");
    return line.size() > 1 && line[0] == '*' && std::isalpha(static_cast<unsigned char>(line[1])) != 0;
}

/// Five counts, then an integer and three coordinates.
bool is_ucd(std::string_view head) {
    const auto are = [](std::string_view line, std::size_t integers, std::size_t reals) {
        const std::vector<std::string_view> words = cut_fields(line, " \t\r", "");
        if (words.size() != integers + reals) return false;
        for (std::size_t i = 0; i < words.size(); ++i) {
            if (i < integers ? !whole_number<std::uint64_t>(words[i]) : !real_of_word(words[i], true)) return false;
        }
        return true;
    };
    return are(next_line_of(head, "#"), 5, 0) && are(next_line_of(head, "#"), 1, 3);
}

/// HDF5, NetCDF and ZIP hold many formats: which, is told by the suffix, if it is that of one of these, each with one
/// of its suffixes.
const Format* container(std::string_view path, std::initializer_list<std::string_view> held,
                        std::string_view otherwise) {
    const Format* const format = other_format_by_suffix(path);
    const bool is_held =
        std::ranges::any_of(held, [&](std::string_view suffix) { return format_with(suffix) == format; });
    return is_held ? format : format_with(otherwise);
}

using base::shell_word;

/// x.vtu of x.vtu.xz; plain-x.vtu of x.vtu.
std::string unpacked_name(const std::string& path) {
    for (const std::string_view suffix : {".bz2", ".xz", ".zst"}) {
        if (path.ends_with(suffix)) return path.substr(0, path.size() - suffix.size());
    }
    return path.substr(0, path.rfind('/') + 1) + "plain-" + path.substr(path.rfind('/') + 1);
}

/// ParaView's Python, which makes one grid of any data set, in blocks or not.
std::string paraview_command(const std::string& in, const std::string& out,
                             const std::string& grid = "MergeBlocks(OpenDataFile(sys.argv[1]))") {
    return "`pvpython -c 'import sys; from paraview.simple import *; SaveData(sys.argv[2], " + grid + ")' " +
           shell_word(in) + " " + shell_word(out) + "`";
}

/// ParaView tells formats by their suffixes; a case of OpenFOAM has an empty file to name it.
std::string by_paraview(const std::string& path) {
    const std::string stem = stem_of(path);
    if (std::error_code ignored; std::filesystem::is_directory(path, ignored)) {
        const std::string foam = path + "/case.foam";
        return "convert it with `touch " + shell_word(foam) + "` and " +
               paraview_command(foam, path + "/case-grid.vtu");
    }
    if (has_suffix(path, ".vtkhdf"))
        return "convert it with `cp " + shell_word(path) + " " + shell_word(stem + ".hdf") + "` and " +
               paraview_command(stem + ".hdf", stem + "-grid.vtu");
    if (has_one_of(path, {".cgns", ".cas", ".foam", ".openfoam"}))
        return "convert it with " + paraview_command(path, stem + "-grid.vtu");
    return "name the folder of the case";
}

}  // namespace

std::string_view first_word(std::string_view text, char comment) {
    while (true) {
        text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
        if (!text.starts_with(comment)) return text.substr(0, text.find_first_of(" \t\r\n"));
        text.remove_prefix(std::min(text.find('\n'), text.size()));
    }
}

const Format* other_format_by_suffix(std::string_view path) {
    const Format* const format = base::format_of_mesh(path);
    return format == nullptr || format->what.empty() ? nullptr : format;
}

const Format* other_format_by_content(std::string_view head, std::string_view path, bool strict) {
    if (const Format* packed = base::format_that_begins(head); packed != nullptr) return packed;
    if (head.starts_with("\x89HDF\r\n\x1a\n"))
        return container(path, {".med", ".cgns", ".exo", ".vtkhdf", ".h5m", ".hmf", ".cas"}, ".h5");
    if (head.starts_with("CDF\x01") || head.starts_with("CDF\x02") || head.starts_with("CDF\x05"))
        return container(path, {".exo"}, ".nc");
    const std::string_view text = head.starts_with("\xEF\xBB\xBF") ? head.substr(3) : head;
    if (text.find("<Xdmf") != std::string_view::npos) return format_with(".xdmf");
    if (text.find("<dolfin") != std::string_view::npos) return format_with(".xml");
    if (text.find("FoamFile") != std::string_view::npos) return format_with(".foam");
    if (has_suffix(path, ".poly") && is_flat_poly(text)) return &flat_poly;
    if (text.starts_with("ISO-10303-21")) return format_with(".step");
    const bool msh = has_suffix(path, ".msh");
    if (msh && text.starts_with('(')) return &fluent;
    if (msh && is_freefem(text)) return &freefem;
    if (msh && is_abaqus(text)) return format_with(".inp");
    if (text.starts_with("ply")) return format_with(".ply");
    if (strict) return nullptr;
    const std::string_view word = first_word(text, '%');
    if (word.starts_with("NDIME=")) return format_with(".su2");
    if (first_word(text, '#') == "mesh3d") return format_with(".vol");
    if (is_abaqus(text)) return format_with(".inp");
    if (is_ucd(text)) return format_with(".avs");
    if (word == "-1") return format_with(".unv");
    if (text.starts_with("OFF") || text.starts_with("solid ")) return format_with(".stl");
    if (word == "SOL" || word == "CEND" || word == "BEGIN") return format_with(".bdf");
    return nullptr;
}

std::string gmsh_command(const std::string& path) {
    return "`gmsh " + shell_word(path) + " -save -save_all -format msh41 -o " + shell_word(stem_of(path) + "-new.msh") +
           "`";
}

std::string one_grid_command(const std::string& path) {
    return paraview_command(path, stem_of(path) + "-grid.vtu");
}

std::string to_simplices(const std::string& path) {
    return "cut them into simplices with " + paraview_command(path, stem_of(path) + "-simplices.vtu",
                                                              "Tetrahedralize(MergeBlocks(OpenDataFile(sys.argv[1])))");
}

bool in_plane(std::span<const double> points, double z) {
    bool level = true;
    for (std::size_t i = 2; i < points.size(); i += 3) level = level && points[i] == z;
    return level;
}

std::string plane_remedy(std::span<const double> points, const std::string& path) {
    if (const double z = points.size() < 3 ? 0 : points[2]; z != 0 && in_plane(points, z))
        return "the mesh lies in the plane z = " + base::shortest(z) + ": give its nodes z = 0";
    if (path.empty()) return "only what lies in the plane z = 0 is taken";
    const std::string file = stem_of(path) + ".stl", stl = shell_word(file);
    // meshio reads no files of VTK but these two.
    const bool paraview = is_vtk_file(path) && !has_one_of(path, {".vtu", ".vtk"});
    return "a surface in space is no mesh here; if it is closed, fill it: " +
           (paraview ? paraview_command(path, file, "ExtractSurface(MergeBlocks(OpenDataFile(sys.argv[1])))")
                     : "`meshio convert " + shell_word(path) + " " + stl + "`") +
           ", then `barycert mesh " + stl + "`";
}

std::string freefem_command(const std::string& path) {
    const std::string script = "mesh Th = readmesh(\"" + path + "\"); savemesh(Th, \"" + stem_of(path) + ".mesh\");";
    return "`echo " + shell_word(script) + " | FreeFem++ -nw -f /dev/stdin`";
}

Error other_format_error(const Format& format, const std::string& path) {
    std::string remedy =
        fmt::format(fmt::runtime(format.remedy), fmt::arg("in", shell_word(path)), fmt::arg("gmsh", gmsh_command(path)),
                    fmt::arg("msh", shell_word(stem_of(path) + ".msh")), fmt::arg("freefem", freefem_command(path)),
                    fmt::arg("unpacked", shell_word(unpacked_name(path))), fmt::arg("paraview", by_paraview(path)));
    return file_error("file.format", path,
                      "this is " + std::string(format.what) + (format.is_mesh ? ", which is not read" : ""),
                      formats_read(), {}, std::move(remedy));
}

}  // namespace barycert::io
