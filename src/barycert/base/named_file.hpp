/// Files that a program reads and writes, by what its user calls them; and the rule that no output is an input.
#pragma once

#include <string>
#include <vector>

#include "barycert/result.hpp"

namespace barycert {

/// A file on the command line: `what` as in "--json" or "the mesh".
struct NamedFile {
    std::string what, path;
};

/// True if both paths lead to one file (device and inode: through links and other names), or would once it is made.
/// An empty path names no file; "-" is the standard stream, which only "-" names.
bool same_file(const std::string& a, const std::string& b);

/// Error: an output is an input, or two outputs are one file. Nothing is opened.
Status check_distinct(const std::vector<NamedFile>& inputs, const std::vector<NamedFile>& outputs);

}  // namespace barycert
