/// The report on a mesh as one HTML page, for people: to read, to print, to pass on.
#pragma once

#include <string>

#include "barycert/check/check.hpp"

namespace barycert::report {

/// The verdict; what was checked and found, with places and remedies; histograms of the measures; the worst cells and
/// those with problems drawn, and where in the mesh they are. UTF-8, self-contained: style and pictures are in the
/// page, which asks for nothing from anywhere and runs no scripts. It is well-formed XML, too. Some hundred kilobytes
/// at most, whatever the size of the mesh. `mesh` is what the report is of, `mesh_name` what the user calls it.
///
/// Cost: some passes over the mesh, and its boundary once more. Of broken meshes nothing is drawn that has no place.
std::string check_html(const check::Report& report, const Mesh& mesh, const std::string& mesh_name);

}  // namespace barycert::report
