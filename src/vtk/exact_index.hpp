/// What the exact locator knows of a data set of VTK, made once for all that ask.
#pragma once

#include <vtkType.h>

#include "barycert/io.hpp"
#include "barycert/pieces/piece.hpp"
#include "barycert/surface_locator.hpp"

class vtkCell;
class vtkDataArray;
class vtkDataSet;

namespace barycert::in_vtk {

/// The simplices of a data set. Cells of a lower dimension, empty cells and ghost cells (vtkGhostType: duplicate,
/// refined, hidden) are left out. There is no locator if there are no cells, or if there is a `reason`. Triangles that
/// lie in no plane across an axis are a surface: the mesh then has their corners, and no nodes.
struct ExactIndex : pieces::IndexedPiece {
    std::vector<vtkIdType> ids;  ///< of the mesh's cells in the data set; empty: the same
    std::string reason;          ///< why points cannot be located exactly in the data set; empty if they can
    Surface surface;             ///< empty: there is none
    std::optional<SurfaceLocator> on_surface;

    bool in_space() const { return !surface.cells.empty(); }
    bool exact() const { return reason.empty(); }
    vtkIdType id(Mesh::Index cell) const {
        return ids.empty() || cell < 0 ? cell : ids[static_cast<std::size_t>(cell)];
    }

    // As those of IndexedPiece, and of a surface.
    Status build();
    Simplex simplex() const { return in_space() ? Simplex::triangle3d : IndexedPiece::simplex(); }
    void place(const double* point, double* x) const;
    Mesh::Index owner(const double* x) const;
    pieces::Closest closest(const double* x, double limit) const;
    /// On the axes of the mesh: of VTK's cell, if it has just been fetched, for the mesh would be fetched from memory
    /// too.
    std::array<double, 12> vertices(Mesh::Index cell, vtkCell* fetched = nullptr) const;
    std::array<double, 4> weights(Mesh::Index cell, const double* point, vtkCell* fetched = nullptr) const;
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

/// Of cells that are no linear simplices.
enum class Sides {
    none,      ///< they are none at all
    straight,  ///< quadratic triangles and tetrahedra are taken with straight sides, and their nodes at mid-edges kept
    any,       ///< likewise, and strips, pixels, quads and polygons stand beside triangles
};

/// Sets the highest dimension of the data set's cells, -1 if it has none, or returns why it has no mesh of simplices.
std::string cell_dimension(vtkDataSet& data, int& dimension, Sides sides = Sides::none);

/// Sets mesh, ids, normal, plane and axes of `index`, or returns why the data set has no mesh of simplices: a clause.
/// Triangles that are no piece of a mesh may be a surface.
std::string read_simplices(vtkDataSet& data, ExactIndex& index, const pieces::Shape& shape = {},
                           Sides sides = Sides::none);

/// Sets ids and surface of `index`, if all are triangles or strips of them; else ids, and the polygons as facets of
/// `plc`. Or returns why it cannot. Requires a data set in which cell_dimension finds no more than any polygons.
std::string read_polygons(vtkDataSet& data, ExactIndex& index, Plc& plc);

/// The numbers of an array as doubles, tuple after tuple.
std::vector<double> doubles_of(vtkDataArray& array);

/// Of the nodes of its triangles, ghost cells left out. Requires a data set in which cell_dimension finds no fault.
pieces::Box box_of_triangles(vtkDataSet& data);

}  // namespace barycert::in_vtk
