#include "files/format.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "files/suffix.hpp"

namespace barycert::base {
namespace {

using enum Use;
using std::string_view_literals::operator""sv;

constexpr std::string_view table_not_mesh = "a table, not a mesh", surface_not_mesh = "a surface, not a mesh",
                           plc_not_mesh = "a PLC, not a mesh",
                           name_the_mesh =
                               "name the mesh first; points go with --points, values with --field NAME=FILE",
                           fill_the_surface =
                               "check and sample take surfaces; slices, pictures and all else take meshes: if it is "
                               "closed, fill it with `barycert mesh {in}`",
                           mesh_the_plc = "mesh it first with `barycert mesh {in}`";

constexpr Format table(std::string_view suffixes, std::string_view family, FormatKind kind, Uses read, Uses written,
                       std::string_view begins = {}) {
    return {suffixes, family, kind, read, written, begins, table_not_mesh, name_the_mesh, nullptr, false};
}
constexpr Format vtk(std::string_view suffixes, FormatKind kind, Uses read, Uses written = {}) {
    return {.suffixes = suffixes, .family = "VTK", .kind = kind, .read = read, .written = written};
}
constexpr Format polygons(std::string_view suffixes, std::string_view family, FormatKind kind, Uses written = {}) {
    return {suffixes, family, kind, {surface, plc}, written, {}, surface_not_mesh, fill_the_surface, nullptr, false};
}
constexpr Format facets(std::string_view suffixes, FormatKind kind) {
    return {suffixes, "TetGen", kind, {surface, plc}, {}, {}, plc_not_mesh, mesh_the_plc, nullptr, false};
}
constexpr Format output(std::string_view suffixes, std::string_view family, FormatKind kind, Uses written) {
    return {.suffixes = suffixes, .family = family, .kind = kind, .written = written};
}
/// One that meshio reads, or nobody.
constexpr Format other(std::string_view suffixes, std::string_view what, std::string_view remedy,
                       const char* meshio = nullptr, bool is_mesh = true, std::string_view begins = {}) {
    return {
        .suffixes = suffixes, .begins = begins, .what = what, .remedy = remedy, .meshio = meshio, .is_mesh = is_mesh};
}

constexpr std::array all{
    table(" .csv ", "CSV", FormatKind::csv, {points, field}, {rows, grid}),
    table(" .txt .dat .xyz .tsv ", "CSV", FormatKind::csv, {points, field}, {}),
    table(" .npy ", "NumPy", FormatKind::npy, {points, field}, {rows, grid}, "\x93NUMPY"sv),
    table(" .npz ", "NumPy", FormatKind::npz, {}, {weights}),
    Format{.suffixes = " .node ",
           .family = "TetGen and Triangle",
           .kind = FormatKind::node,
           .read = {mesh, points, field},
           .written = {mesh}},
    Format{.suffixes = " .ele ", .family = "TetGen and Triangle", .kind = FormatKind::ele, .read = {mesh, field}},
    Format{.suffixes = " .msh ",
           .family = "Gmsh",
           .kind = FormatKind::gmsh,
           .read = {mesh, surface, field},
           .written = {mesh}},
    Format{.suffixes = " .mesh .meshb ", .family = "Medit", .kind = FormatKind::medit, .read = {mesh, surface, field}},
    Format{.suffixes = " .sol .solb ", .family = "Medit", .kind = FormatKind::medit_fields, .read = {field}},
    vtk(" .vtu ", FormatKind::vtu, {mesh, surface, points, field}, {mesh, rows}),
    vtk(" .vtk ", FormatKind::vtk, {mesh, surface, points, field}, {mesh}),
    vtk(" .vtp ", FormatKind::vtp, {mesh, surface, points, field}, {surface}),
    vtk(" .vti ", FormatKind::vti, {mesh, points, field}, {grid}),
    vtk(" .vtr ", FormatKind::vtr, {mesh, points, field}),
    vtk(" .vts ", FormatKind::vts, {mesh, points, field}),
    vtk(" .pvtu ", FormatKind::pvtu, {mesh, surface, points, field}),
    vtk(" .pvtp ", FormatKind::pvtp, {mesh, surface, points, field}),
    vtk(" .vtm ", FormatKind::vtm, {mesh, surface, points, field}),
    vtk(" .vtpd ", FormatKind::vtpd, {mesh, surface, points, field}),
    vtk(" .vtpc ", FormatKind::vtpc, {mesh, surface, points, field}),
    vtk(" .pvd ", FormatKind::pvd, {mesh, surface, points, field, steps}),
    vtk(" .series ", FormatKind::series, {mesh, surface, points, field, steps}),
    facets(" .poly ", FormatKind::poly),
    facets(" .smesh ", FormatKind::smesh),
    polygons(" .off ", "Geomview", FormatKind::off, {surface}),
    polygons(" .stl ", "STL", FormatKind::stl),
    polygons(" .ply ", "PLY", FormatKind::ply, {surface}),
    polygons(" .obj ", "Wavefront", FormatKind::obj),
    output(" .png ", "pictures", FormatKind::png, {picture, grid}),
    output(" .svg ", "pictures", FormatKind::svg, {picture, grid}),
    output(" .pdf ", "pictures", FormatKind::pdf, {picture, grid}),
    output(" .html ", "pages", FormatKind::html, {page}),

    other(" .inp ", "a mesh of Abaqus", "", "abaqus"),
    other(" .xdmf .xmf ", "an XDMF file", "", "xdmf"),
    other(" .med .rmed .mmed ", "a MED file of Salome or Code_Aster", "", "med"),
    other(" .cgns ", "a CGNS file", "{paraview}"),
    other(" .exo .e .ex2 .exii .g ", "an Exodus file", "", "exodus"),
    other(" .vol ", "a mesh of Netgen", "", "netgen"),
    other(" .su2 ", "a mesh of SU2", "", "su2"),
    other(" .unv .universal ", "a universal file of I-deas",
          "convert it with {gmsh}; it numbers nodes anew, so that values in files of their own do not fit"),
    other(" .bdf .nas .fem ", "a file of Nastran", "", "nastran"),
    other(" .foam .openfoam ", "a case of OpenFOAM", "{paraview}"),
    other(" .xml ", "an XML file, perhaps a mesh of DOLFIN", "", "dolfin-xml"),
    other(" .avs .ucd ", "a mesh of AVS", "", "avsucd"),
    other(" .ugrid ", "a mesh of UGRID", "", "ugrid"),
    other(" .mdpa ", "a mesh of Kratos", "", "mdpa"),
    other(" .f3grid ", "a mesh of FLAC3D", "", "flac3d"),
    other(" .h5m ", "a mesh of MOAB", "", "h5m"),
    other(" .hmf ", "an HMF file", "", "hmf"),
    other(" .post .dato ", "a mesh of PERMAS", "", "permas"),
    other(" .tec .dat ", "a file of Tecplot", "", "tecplot"),
    other(" .cas ", "a case of Fluent", "{paraview}"),
    other(" .geo .geo_unrolled .brep .step .stp .iges .igs ", "a geometry, not a mesh",
          "mesh it with `gmsh -3 {in} -format msh41 -o {msh}` (-2 for triangles)", nullptr, false),
    other(" .vtkhdf ", "a VTKHDF file", "{paraview}; ParaView 5.11 reads version 1 of the format alone"),
    other(" .h5 .hdf5 .hdf ", "an HDF5 file", "if it belongs to an .xdmf file, name that"),
    other(" .nc ", "a NetCDF file", "", "exodus"),
    other(" .tgz ", "a TAR archive", "unpack it with `tar -xzf {in}`"),
    other(" .bz2 ", "a file packed by bzip2", "unpack it with `bzip2 -dc {in} > {unpacked}`", nullptr, true, "BZh"sv),
    other(" .xz ", "a file packed by xz", "unpack it with `xz -dc {in} > {unpacked}`", nullptr, true, "\3757zXZ\0"sv),
    other(" .zst ", "a file packed by zstd", "unpack it with `zstd -dc {in} > {unpacked}`", nullptr, true,
          "\x28\xb5\x2f\xfd"sv),
    other(" .zip ", "a ZIP archive", "unpack it with `unzip {in}`", nullptr, true, "PK\x03\x04"sv),
    other(" .tar ", "a TAR archive", "unpack it with `tar -xf {in}`"),
};

bool has(const Format& format, std::string_view suffix) {
    return suffix.starts_with('.') && format.suffixes.find(" " + std::string(suffix) + " ") != std::string_view::npos;
}

/// As the table has it; empty if the path has none.
std::string known_suffix(std::string_view path) {
    return lower(suffix_of(std::string(without_gz(path))));
}

std::string in_a_row(const std::vector<std::string_view>& words, std::string_view between, std::string_view last) {
    std::string text;
    for (std::size_t i = 0; i < words.size(); ++i)
        text.append(i == 0 ? "" : i + 1 == words.size() ? last : between).append(words[i]);
    return text;
}

constexpr std::array<std::string_view, use_count> use_names{
    "meshes", "surfaces", "PLCs", "points", "fields", "steps", "rows", "grids", "weights", "pictures", "pages"};

std::string names_of(Uses uses) {
    std::vector<std::string_view> names;
    for (std::size_t i = 0; i < use_count; ++i) {
        if (uses.has(static_cast<Use>(i))) names.push_back(use_names[i]);
    }
    return in_a_row(names, ", ", ", ");
}

}  // namespace

std::span<const Format> formats() {
    return all;
}

const Format* format_with(std::string_view suffix) {
    const auto* const found = std::ranges::find_if(all, [&](const Format& format) { return has(format, suffix); });
    return found == all.end() ? nullptr : found;
}

const Format* format_of(std::string_view path) {
    return format_with(known_suffix(path));
}

const Format* format_of_mesh(std::string_view path) {
    const std::string suffix = known_suffix(path);
    const auto* const found =
        std::ranges::find_if(all, [&](const Format& format) { return format.is_mesh && has(format, suffix); });
    return found == all.end() ? format_with(suffix) : found;
}

const Format* format_that_begins(std::string_view head) {
    const auto* const found = std::ranges::find_if(
        all, [&](const Format& format) { return !format.begins.empty() && head.starts_with(format.begins); });
    return found == all.end() ? nullptr : found;
}

FormatKind kind_of(std::string_view path) {
    const Format* const format = format_of(path);
    return format == nullptr ? FormatKind::none : format->kind;
}

bool is_read_as(std::string_view path, Use use) {
    const Format* const format = format_of(path);
    return format != nullptr && format->read.has(use);
}

bool is_written_as(std::string_view path, Use use) {
    const Format* const format = format_of(path);
    return format != nullptr && format->written.has(use);
}

std::vector<std::string_view> suffixes_with(Uses Format::*uses, Use use) {
    std::vector<std::string_view> found;
    for (const Format& format : all) {
        if (!(format.*uses).has(use)) continue;
        for (std::string_view rest = format.suffixes.substr(1); !rest.empty();) {
            const std::size_t end = rest.find(' ');
            found.push_back(rest.substr(0, end));
            rest.remove_prefix(end + 1);
        }
    }
    return found;
}

std::string suffixes_written(Use use) {
    return in_a_row(suffixes_with(&Format::written, use), ", ", " or ");
}

std::string suffix_list_written(Use use) {
    return in_a_row(suffixes_with(&Format::written, use), " ", " ");
}

std::string suffix_list_read(Use use) {
    return in_a_row(suffixes_with(&Format::read, use), " ", " ");
}

std::string families_read(Use use) {
    std::string text;
    std::string_view family;
    for (const Format& format : all) {
        if (!format.read.has(use)) continue;
        const std::string_view suffixes = format.suffixes.substr(1, format.suffixes.size() - 2);
        if (format.family == family) {
            text.insert(text.size() - 1, " " + std::string(suffixes));
            continue;
        }
        family = format.family;
        text.append(text.empty() ? "" : ", ").append(family).append(" (").append(suffixes).append(")");
    }
    return text;
}

std::string formats_table() {
    std::string text = "| files | suffixes | read as | written as |\n|---|---|---|---|\n";
    for (const auto* format = all.begin(); format != all.end();) {
        const auto* const first = format;
        std::string suffixes;
        const auto is_like_first = [&] {
            return format != all.end() && format->family == first->family && format->read == first->read &&
                   format->written == first->written;
        };
        for (; is_like_first(); ++format) {
            for (const char c : format->suffixes.substr(1))
                suffixes += c == '.' ? "`." : c == ' ' ? "` " : std::string(1, c);
        }
        if (first->family.empty()) continue;
        suffixes.pop_back();
        text.append("| ").append(first->family).append(" | ").append(suffixes).append(" | ");
        text.append(names_of(first->read)).append(" | ").append(names_of(first->written)).append(" |\n");
    }
    return text;
}

}  // namespace barycert::base
