/// Index of a data set of VTK for the exact locator, made once for all that ask.
#pragma once

#include <vtkType.h>

#include "barycert/gmsh_files.hpp"
#include "barycert/mesh_files.hpp"
#include "barycert/plc_files.hpp"
#include "barycert/point_files.hpp"
#include "barycert/series.hpp"
#include "barycert/surface_files.hpp"
#include "barycert/surface_locator.hpp"
#include "barycert/table_files.hpp"
#include "barycert/tetgen_files.hpp"
#include "barycert/vtk_files.hpp"
#include "mesh/pieces/piece.hpp"

class vtkCell;
class vtkDataSet;
class vtkDataSetAttributes;
class vtkIdList;

namespace barycert::in_vtk {

/// The cells of a data set that fill space; of one that has none, its polygons. Cells of a lower dimension, empty cells
/// and ghost cells (vtkGhostType: duplicate, refined, hidden) are left out. There is no locator if there are no cells,
/// or if there is a `reason`. Polygons that lie in no plane across an axis are a surface, by their triangles: the mesh
/// then has the corners of these, and no nodes.
struct ExactIndex : pieces::IndexedPiece {
    pieces::Shape shape;  ///< what the data set is taken for
    std::string reason;   ///< why points cannot be located exactly in the data set; empty if they can
    Notes notes;          ///< of cells that are not taken as they are, or as they were asked for
    /// Into simplices; or they have more nodes than the mesh has of them, or in another order.
    bool cells_are_cut = false;
    std::size_t by_corners = 0, uncut = 0;  ///< cells taken by their corners; polygons left out
    Surface surface;                        ///< without points: there is none
    std::optional<SurfaceLocator> on_surface;

    bool in_space() const { return !surface.points.empty(); }
    bool exact() const { return reason.empty(); }
    vtkIdType id(Mesh::Index cell) const { return in_space() ? surface.facet(cell) : mesh.cell_number(cell); }

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
    /// Sets the weights of those nodes of VTK's cell in which `x` in space lies, or (`inside` is false) the point
    /// nearest to it. Nodes that have no part in the value there get 0.
    void weights_of_nodes(Mesh::Index cell, const double* x, bool inside, vtkIdList& nodes, double* out) const;
};

/// By the settings of the classes: those of CellInterpolation and Curved, by their numbers.
inline pieces::Shape shape_of(int interpolation, int curved) {
    return {.interpolation = static_cast<CellInterpolation>(interpolation), .curved = static_cast<Curved>(curved)};
}

/// Returns the index of a data set, made once for a time of modification; data sets of the same cells share it as long
/// as one of them lives. Any thread may call this, one at a time for a vtkPolyData, whose cells it may build. Never
/// null. Cells are numbered by the GlobalIds of cell data, which are without fault; nodes by those of point data.
std::shared_ptr<const ExactIndex> exact_index(vtkDataSet& data, const pieces::Shape& shape = {});

/// The next one is made anew.
void forget_index(const vtkDataSet& data);

// The numbers in a mesh of which a data set is a piece: GlobalIds.

/// Why these, of so many, cannot be used; empty if they can. `of`: "cell" or "point".
std::string fault_of_global_ids(vtkDataSetAttributes& attributes, vtkIdType count, const std::string& of);
/// The global id of each cell of the mesh.
std::vector<std::int64_t> global_ids(vtkDataSet& data, const ExactIndex& index);

// From VTK's cells to a mesh of simplices.

/// Sets the facts about the cells. Returns, as a clause, why they are no mesh; empty if they are one.
std::string look_at_cells(vtkDataSet& data, pieces::PieceFacts& facts);

/// Sets mesh, normal, plane, axes and notes of an index of that shape, or returns why the data set has no mesh. Of
/// polygons that are no piece of a mesh it may be a surface.
std::string read_cells(vtkDataSet& data, ExactIndex& index);

/// If not all are triangles or strips of them: the polygons as facets of `plc`. Returns the cell of each. Requires a
/// data set that read_cells takes for a surface.
std::vector<Mesh::Index> read_polygons(vtkDataSet& data, Plc& plc);

}  // namespace barycert::in_vtk
