/// Files that are not read as a mesh: what they are, and how to get at the mesh in them.
#pragma once

#include <string>
#include <string_view>

#include "barycert/result.hpp"
#include "files/format.hpp"

namespace barycert::io {

/// One that is not read as a mesh, by the end of the path; nullptr if it is none of these.
const base::Format* other_format_by_suffix(std::string_view path);

/// By its first bytes; nullptr if they could be anything. `strict`: only what cannot be taken for another file.
const base::Format* other_format_by_content(std::string_view head, std::string_view path, bool strict);

/// The first word of the text, behind lines of that comment.
std::string_view first_word(std::string_view text, char comment);

/// Returns the error that the file is not read, with a remedy.
Error other_format_error(const base::Format& format, const std::string& path);

/// "a file of Gmsh (.msh), ...": what is read as a mesh.
inline std::string formats_read() {
    return "a file of " + base::families_read(base::Use::mesh) + ", or one that meshio reads";
}

/// The command that makes one grid of the pieces of a file, in backquotes.
std::string one_grid_command(const std::string& path);

/// How to cut the cells of a file of VTK into simplices.
std::string to_simplices(const std::string& path);

/// The command that writes a file of Gmsh anew, in version 4.1; in backquotes.
std::string gmsh_command(const std::string& path);

}  // namespace barycert::io
