/// What the exact locator knows of a data set of VTK, made once for all that ask.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <vtkType.h>

#include "barycert/pieces/piece.hpp"

class vtkDataArray;
class vtkDataSet;

namespace barycert::in_vtk {

/// The simplices of a data set. Cells of a lower dimension, empty cells and ghost cells (vtkGhostType: duplicate,
/// refined, hidden) are left out. There is no locator if there are no cells, or if there is a `reason`.
struct ExactIndex : pieces::IndexedPiece {
    std::vector<vtkIdType> ids;  ///< of the mesh's cells in the data set; empty: the same
    std::string reason;          ///< why points cannot be located exactly in the data set; empty if they can

    bool exact() const { return reason.empty(); }
    vtkIdType id(Mesh::Index cell) const {
        return ids.empty() || cell < 0 ? cell : ids[static_cast<std::size_t>(cell)];
    }
};

/// Of one data set at one time of modification it is made once; data sets of the same cells share it as long as one of
/// them lives. Any thread may call this, one at a time for a vtkPolyData, whose cells it may build. Never null.
/// Numbers of cells in the whole mesh are the GlobalIds of the cell data, without fault.
std::shared_ptr<const ExactIndex> exact_index(vtkDataSet& data, const pieces::Shape& shape = {});

/// The next one is made anew.
void forget_index(const vtkDataSet& data);

// The numbers of cells in a mesh of which a data set is a piece: GlobalIds of the cell data.

/// Why these, which are there, cannot be used; empty if they can.
std::string fault_of_global_ids(vtkDataSet& data);
/// Of each cell of the mesh.
std::vector<std::int64_t> global_ids(vtkDataSet& data, const ExactIndex& index);

// From VTK's cells to a mesh of simplices.

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

/// The numbers of an array as doubles, tuple after tuple.
std::vector<double> doubles_of(vtkDataArray& array);

/// Of the nodes of its triangles, ghost cells left out. Requires a data set in which cell_dimension finds no fault.
pieces::Box box_of_triangles(vtkDataSet& data);

}  // namespace barycert::in_vtk
