/// From VTK's cells to a mesh of simplices.
#pragma once

#include <string>

#include "vtk/exact_index.hpp"

namespace barycert::in_vtk {

/// Second-order cells are refused, for they are curved, or taken as simplices with nodes at mid-edges.
enum class SecondOrder { refused, taken };

/// Sets mesh, ids, normal, plane and axes of `index`, or returns why the data set has no mesh of simplices: a clause.
std::string read_simplices(vtkDataSet& data, ExactIndex& index, SecondOrder second_order = SecondOrder::refused);

}  // namespace barycert::in_vtk
