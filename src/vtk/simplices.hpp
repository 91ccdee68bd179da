/// From VTK's cells to a mesh of simplices.
#pragma once

#include <string>

#include "vtk/exact_index.hpp"

namespace barycert::in_vtk {

/// Sets mesh, ids, normal, plane and axes of `index`, or returns why the data set has no mesh of simplices: a clause.
std::string read_simplices(vtkDataSet& data, ExactIndex& index);

}  // namespace barycert::in_vtk
