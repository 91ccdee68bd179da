/// A VTK file of whatever kind as a grid.
#pragma once

#include <string>

#include "barycert/io/vtk/raw_grid.hpp"

namespace barycert::io {

/// The data set of a file, told by its first bytes; of a file that names files all of them, of a series the first step.
Result<RawGrid> read_grid(const std::string& path, Part part);

}  // namespace barycert::io
