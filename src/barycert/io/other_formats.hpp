/// Files that are not read: what they are, and the command that makes of them what is.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "barycert/result.hpp"

namespace barycert::io {

/// How to get at the mesh.
enum class Way {
    meshio,   ///< it is read by way of meshio: io/converted
    gmsh,     ///< `gmsh IN -save -format msh41 -o OUT.msh`
    mesher,   ///< a geometry: `gmsh -3 IN -format msh41 -o OUT.msh`
    surface,  ///< `barycert mesh IN`
    pyvista,  ///< several blocks: by pyvista
    unpack,   ///< compressed
    other,    ///< as its remedy tells
};

struct OtherFormat {
    std::string_view suffixes;  ///< with their dots, each between blanks; lower case
    const char* what;           ///< "a mesh of Medit"
    Way way;
    const char* remedy;  ///< Way::meshio: its name there; unpack: the command; other: all of it; else nothing
};

/// By the end of the path; nullptr if it is none of these.
const OtherFormat* other_format_by_suffix(std::string_view path);

/// By its first bytes; nullptr if they could be anything. `strict`: only what cannot be taken for another file.
const OtherFormat* other_format_by_content(std::string_view head, std::string_view path, bool strict);

/// The first word of the text that is no comment.
std::string_view first_word(std::string_view text, char comment);

/// Compressed, or a .npy file, by its first bytes; else nullptr. No text begins so.
const OtherFormat* packed_format(std::string_view head);

/// That the file is not read, and what to do.
Error other_format_error(const OtherFormat& format, const std::string& path);

/// How to cut the cells of a file into simplices.
std::string to_simplices(const std::string& path);

/// Whether all points x, y, z lie in the plane z = 0; and what to do where they do not. `path`: of a file of linear
/// triangles; else empty.
bool in_plane(std::span<const double> points);
std::string plane_remedy(std::span<const double> points, const std::string& path);

/// What to do about a .ply file in binary form.
std::string text_ply_remedy(const std::string& path);

/// The command that writes a file of Gmsh anew, in version 4.1, with `more` arguments; in backquotes.
std::string gmsh_command(const std::string& path, const std::string& more = {});

inline constexpr const char* formats_read =
    "a file of Gmsh (.msh), Medit (.mesh .meshb), VTK (.vtu .vtk .vtp .pvtu .vtm .pvd .vtu.series), TetGen or Triangle "
    "(.node .ele), or one that meshio reads";

}  // namespace barycert::io
