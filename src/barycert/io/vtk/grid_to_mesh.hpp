/// A mesh out of what a VTK file holds.
#pragma once

#include <string>

#include "barycert/io/vtk/raw_grid.hpp"
#include "barycert/vtk.hpp"

namespace barycert::io {

/// What read_vtk promises of cells, points and fields, whatever the format. `path` is for messages.
Result<Mesh> to_mesh(RawGrid grid, const std::string& path, VtkLeftOut* left_out);

/// The coordinates in that dimension, all finite. Error: one is not; or z is not 0 in dimension 2.
Result<std::vector<double>> to_points(std::vector<double> points, int dimension, const std::string& path);

}  // namespace barycert::io
