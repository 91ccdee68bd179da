/// Files that are not read: what they are, and the command that makes of them what is.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "barycert/result.hpp"

namespace barycert::io {

/// How to get at the mesh.
enum class Way {
    meshio,          ///< `meshio convert IN OUT.vtu`
    gmsh,            ///< `gmsh IN -save -format msh41 -o OUT.msh`
    gmsh_or_meshio,  ///< either, by the form of the file
    mesher,          ///< a geometry: `gmsh -3 IN -format msh41 -o OUT.msh`
    surface,         ///< `barycert mesh IN`
    pyvista,         ///< several blocks: by pyvista
    unpack,          ///< compressed
    other,           ///< as its remedy tells
};

struct OtherFormat {
    std::string_view suffixes;  ///< with their dots, each between blanks; lower case
    const char* what;           ///< "a mesh of Medit"
    Way way;
    const char* remedy;  ///< Way::unpack: the command; other: all of it; else nothing
};

/// By the end of the path; nullptr if it is none of these.
const OtherFormat* other_format_by_suffix(std::string_view path);

/// By its first bytes; nullptr if they could be anything. `strict`: only what cannot be taken for another file.
const OtherFormat* other_format_by_content(std::string_view head, std::string_view path, bool strict);

/// Compressed, or a .npy file, by its first bytes; else nullptr. No text begins so.
const OtherFormat* packed_format(std::string_view head);

/// That the file is not read, and what to do.
Error other_format_error(const OtherFormat& format, const std::string& path);

/// The command that writes a file of Gmsh anew, in version 4.1, with `more` arguments; in backquotes.
std::string gmsh_command(const std::string& path, const std::string& more = {});

inline constexpr const char* formats_read =
    "a file of Gmsh (.msh), VTK (.vtu .vtk .vtp .pvtu .vtm .pvd .vtu.series), TetGen or Triangle (.node .ele)";

}  // namespace barycert::io
