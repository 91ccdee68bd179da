/// The formats of files: one table. By it suffixes are known, and what is said of formats in help, errors and
/// doc/formats.md is made of it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace barycert::base {

/// Who reads or writes it.
enum class FormatKind : std::uint8_t {
    none,  ///< of no reader here
    csv,
    npy,
    npz,
    node,  ///< of TetGen and Triangle; points of their own, too
    ele,
    gmsh,
    medit,
    medit_fields,
    // VTK's, see is_vtk().
    vtu,
    vtk,
    vtp,
    vti,
    vtr,
    vts,
    pvtu,
    pvtp,
    vtm,
    vtpd,
    vtpc,
    pvd,
    series,
    // Polygons.
    stl,
    ply,
    off,
    obj,
    poly,
    smesh,
    // Pictures and pages.
    png,
    svg,
    pdf,
    html,
};

constexpr bool is_vtk(FormatKind kind) {
    return kind >= FormatKind::vtu && kind <= FormatKind::series;
}

/// Files of TetGen or Triangle that make a mesh.
constexpr bool is_tetgen(FormatKind kind) {
    return kind == FormatKind::node || kind == FormatKind::ele;
}

/// What a file is read as, or written as.
enum class Use : std::uint8_t { mesh, surface, plc, points, field, steps, rows, grid, weights, picture, page };
inline constexpr std::size_t use_count = 11;

class Uses {
public:
    constexpr Uses() = default;
    constexpr Uses(std::initializer_list<Use> uses) {
        for (const Use use : uses) bits_ = static_cast<std::uint16_t>(bits_ | bit(use));
    }
    constexpr bool has(Use use) const { return (bits_ & bit(use)) != 0; }
    bool operator==(const Uses&) const = default;

private:
    static constexpr unsigned bit(Use use) { return 1U << static_cast<unsigned>(use); }
    std::uint16_t bits_ = 0;
};

struct Format {
    std::string_view suffixes = {};  ///< with their dots, between blanks; lower case
    std::string_view family = {};    ///< whose it is, as "VTK"
    FormatKind kind = FormatKind::none;
    Uses read = {}, written = {};
    std::string_view begins = {};  ///< the first bytes, where they tell it from any text
    // Where a mesh is wanted, and it is not read as one:
    std::string_view what = {};    ///< "a mesh of Abaqus"; "a table, not a mesh" if `is_mesh` is false
    std::string_view remedy = {};  ///< how to get at the mesh, with {words} that the path fills (io/other_formats.cpp)
    const char* meshio = nullptr;  ///< its name there, if it is read by way of meshio (io/converted)
    bool is_mesh = true;
};

/// Those with readers or writers here first; then all others that are known, in the order in which they are looked for.
std::span<const Format> formats();

/// By a suffix with its dot, in lower case; nullptr if none has it.
const Format* format_with(std::string_view suffix);

/// By the end of the path but for .gz, in any case; nullptr if it has no suffix or an unknown one.
const Format* format_of(std::string_view path);

/// The same where a mesh is wanted: of several with the suffix, as .dat is, the first that is one.
const Format* format_of_mesh(std::string_view path);

/// The format whose first bytes these are; nullptr if they could be anything.
const Format* format_that_begins(std::string_view head);

FormatKind kind_of(std::string_view path);
bool is_read_as(std::string_view path, Use use);
bool is_written_as(std::string_view path, Use use);

/// Suffixes with that use, in the order of the table: &Format::read or &Format::written.
std::vector<std::string_view> suffixes_with(Uses Format::*uses, Use use);

// Lists for people.

/// ".csv, .npy or .vtu"
std::string suffixes_written(Use use);
/// ".csv .npy .vtu"
std::string suffix_list_written(Use use);
std::string suffix_list_read(Use use);
/// "Gmsh (.msh), Medit (.mesh .meshb), ...": those that are read as meshes without meshio.
std::string families_read(Use use);
/// The table of doc/formats.md, in Markdown.
std::string formats_table();

}  // namespace barycert::base
