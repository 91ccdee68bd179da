/// From VTK's cells to a mesh of simplices.
#pragma once

#include <string>

#include "vtk/exact_index.hpp"

namespace barycert::in_vtk {

/// Of second-order cells.
enum class Sides {
    none,      ///< they are no simplices
    straight,  ///< quadratic triangles and tetrahedra are taken with straight sides, and their nodes at mid-edges kept
};

/// Sets the highest dimension of the data set's cells, -1 if it has none, or returns why it has no mesh of simplices.
std::string cell_dimension(vtkDataSet& data, int& dimension, Sides sides = Sides::none);

/// Sets mesh, ids, normal, plane and axes of `index`, or returns why the data set has no mesh of simplices: a clause.
std::string read_simplices(vtkDataSet& data, ExactIndex& index, const pieces::Shape& shape = {},
                           Sides sides = Sides::none);

/// Of the nodes of its triangles, ghost cells left out. Requires a data set in which cell_dimension finds no fault.
pieces::Box box_of_triangles(vtkDataSet& data);

}  // namespace barycert::in_vtk
