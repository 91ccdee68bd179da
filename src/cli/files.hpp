/// Files of the command line: options that name them, the rules for outputs, and writing.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "barycert/base/named_file.hpp"
#include "barycert/result.hpp"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace barycert::cli {

/// An option, or argument, that names a file or mesh: the empty string is refused.
CLI::Option* file_option(CLI::App& sub, const std::string& name, std::string& path, const std::string& help);
CLI::Option* file_option(CLI::App& sub, const std::string& name, std::vector<std::string>& paths,
                         const std::string& help);

/// True if the path ends so, in any case.
bool has_suffix(const std::string& path, std::string_view suffix);

/// True if the name ends as those of VTK's files do: .vtu .vtk .vtp.
bool is_vtk_file(const std::string& path);

/// All files that a mesh of that name may be read from: the VTK file, or TetGen's.
std::vector<NamedFile> files_of_mesh(const std::string& what, const std::string& path);

/// All files that a PLC of that name may be read from.
std::vector<NamedFile> files_of_plc(const std::string& what, const std::string& path);

/// What can be known of outputs before the work. Error: an output is an input or another output, or cannot be written.
/// Outputs without a path are passed over.
Status check_outputs(const std::vector<NamedFile>& inputs, std::vector<NamedFile> outputs);

/// Error: one of these cannot be read. "-" is stdin.
Status check_inputs(const std::vector<NamedFile>& inputs);

/// Writes `bytes` to a file that appears whole or not at all; "-" is stdout.
Status write_output(const std::string& path, std::string_view bytes);

}  // namespace barycert::cli
