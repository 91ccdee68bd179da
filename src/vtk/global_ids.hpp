/// The numbers of cells in a mesh of which a data set is a piece.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "vtk/exact_index.hpp"

namespace barycert::in_vtk {

/// Whether the cell data has GlobalIds.
bool has_global_ids(vtkDataSet& data);

/// Why these cannot be used; empty if they can.
std::string fault_of_global_ids(vtkDataSet& data);

/// Of each cell of the mesh. Requires GlobalIds without fault.
std::vector<std::int64_t> global_ids(vtkDataSet& data, const ExactIndex& index);

/// Sorts the cells of the mesh by them; cells of the same number keep their order.
void order_by_global_ids(vtkDataSet& data, ExactIndex& index);

}  // namespace barycert::in_vtk
