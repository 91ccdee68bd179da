/// Files that a program reads and writes, by what its user calls them; and the rule that no output is an input.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "barycert/result.hpp"

namespace barycert::base {

/// A file on the command line: `what` as in "--json" or "the mesh".
struct NamedFile {
    std::string what, path;
    bool of_mesh = false;  ///< the reader of meshes opens it, and tells with hints why it cannot be read
};

/// The parts of an output's name that become the number and the time of a step, where each step of a series has its own
/// file.
inline constexpr std::string_view step_place = "{step}", time_place = "{time}";

/// True if both paths lead to one file, or would once it is made. An empty one names none; "-" is the standard stream.
bool same_file(const std::string& a, const std::string& b);

std::vector<NamedFile> named_files(const std::string& what, std::vector<std::string> paths, bool of_mesh = false);

/// Error: an output is an input, or two outputs are one file. Nothing is opened.
Status check_distinct(const std::vector<NamedFile>& inputs, const std::vector<NamedFile>& outputs);

/// As check_distinct() of outputs with a path; also one cannot be written, or has a place for a step that is not there.
Status check_outputs(const std::vector<NamedFile>& inputs, std::vector<NamedFile> outputs);

/// Error: one of these cannot be read. "-" is stdin.
Status check_inputs(const std::vector<NamedFile>& inputs);

}  // namespace barycert::base
