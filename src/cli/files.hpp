/// Files of the command line: options that name them, the rules for outputs, and writing.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "barycert/base/named_file.hpp"
#include "barycert/io.hpp"
#include "barycert/result.hpp"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace barycert::cli {

/// What MESH may be.
inline constexpr const char* mesh_help =
    "A mesh: TetGen's or Triangle's .node/.ele, Gmsh's .msh, Medit's .mesh .meshb, VTK's .vtu .vtk .vtp .pvtu .vtm "
    ".pvd .vtu.series .vtp.series; others by way of meshio; any packed as .gz";

/// An option, or argument, that names a file or mesh: the empty string is refused.
CLI::Option* file_option(CLI::App& sub, const std::string& name, std::string& path, const std::string& help);
CLI::Option* file_option(CLI::App& sub, const std::string& name, std::vector<std::string>& paths,
                         const std::string& help);

/// --step and --time, of a MESH that is a series. `all`: what --step all sets; nullptr: not allowed.
void step_options(CLI::App& sub, StepChoice& step, bool* all = nullptr);

/// Writes `bytes` to a file that appears whole or not at all; "-" is stdout.
Status write_output(const std::string& path, std::string_view bytes);

/// The first that is an error, once all was tried: a file that could not be written does not cost the user the others,
/// the fruit of the whole run.
Status all_written(const std::vector<Status>& written);

}  // namespace barycert::cli
