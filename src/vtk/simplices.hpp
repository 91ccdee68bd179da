/// From VTK's cells to a mesh of simplices.
#pragma once

#include <string>

#include "barycert/grid.hpp"
#include "vtk/exact_index.hpp"

namespace barycert::in_vtk {

/// Sets the highest dimension of the data set's cells, -1 if it has none, or returns why it has no mesh of simplices.
std::string cell_dimension(vtkDataSet& data, int& dimension);

/// Sets mesh, ids, normal, plane and axes of `index`, or returns why the data set has no mesh of simplices: a clause.
std::string read_simplices(vtkDataSet& data, ExactIndex& index, const SimplexShape& shape = {});

/// Of the nodes of the cells of that dimension, ghost cells left out; low > high if there are none. Requires a data set
/// in which cell_dimension finds no fault.
Bounds3 simplex_bounds(vtkDataSet& data, int dimension);

}  // namespace barycert::in_vtk
