/// A mesh of one of VTK's files, read, written as VTK's files and read again.
#pragma once

#include <string>

#include "barycert/table.hpp"

namespace barycert::fuzz {

/// `lines`: of the longest file. `out`: .vtu or .vtk.
void read_and_write_vtk(const std::string& path, std::size_t lines, const std::string& out, VtkData data);

}  // namespace barycert::fuzz
