/// Second-order cells, taken with straight sides.
#pragma once

#include <string>
#include <vector>

#include <vtkSmartPointer.h>

#include "barycert/mesh.hpp"

class vtkDataSet;

namespace barycert::in_vtk {

/// The data set itself or, where it has quadratic triangles or tetrahedra, one with the linear cells of their vertices:
/// with the same ids, points and ghosts.
vtkSmartPointer<vtkDataSet> straight_sides(vtkDataSet& data);

/// Adds to a mesh that was read of straight_sides(data) the nodes at mid-edges, or returns why not: a clause. `ids`: of
/// the mesh's cells in the data set; empty: the same.
std::string add_mid_nodes(vtkDataSet& data, const std::vector<vtkIdType>& ids, Mesh& mesh);

}  // namespace barycert::in_vtk
