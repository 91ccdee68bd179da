/// A mesh out of what a VTK file holds.
#pragma once

#include <string>

#include "barycert/io.hpp"
#include "barycert/io/vtk/raw_grid.hpp"

namespace barycert::io {

/// What read_vtk promises of cells, points, fields and notes, whatever the format. `path` is for messages.
Result<Mesh> to_mesh(RawGrid grid, const std::string& path);

/// The coordinates in that dimension, all finite. Error: one is not; or z is not 0 in dimension 2, with a remedy for
/// the file of linear triangles `triangles`, if that is not empty.
Result<std::vector<double>> to_points(std::vector<double> points, int dimension, const std::string& path,
                                      const std::string& triangles = {});

/// Fields of what can be one; what cannot, and what was widened, is noted. `what`: "point array".
void take_fields(std::vector<RawArray>& arrays, const std::string& what, const std::string& path,
                 std::vector<Field>& fields, std::vector<Column>* labels, Notes& notes);

/// Notes on what concerns no array of points or cells.
void note_the_rest(const RawGrid& grid, const std::string& path, Notes& notes);

/// "a", "b" and 3 others.
std::string list_of(const std::vector<std::string>& names);

}  // namespace barycert::io
