/// What the exact locator knows of a data set of VTK, made once for all that ask.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <vtkType.h>

#include "barycert/locator.hpp"
#include "barycert/mesh.hpp"

class vtkDataSet;

namespace barycert::in_vtk {

/// The simplices of a data set. Cells of a lower dimension, empty cells and ghost cells (vtkGhostType: duplicate,
/// refined, hidden) are left out.
struct ExactIndex {
    Mesh mesh;                       ///< of dimension 2 where triangles lie in a plane across an axis
    std::vector<vtkIdType> ids;      ///< of the mesh's cells in the data set; empty: the same
    std::optional<Locator> locator;  ///< none if there are no cells, or if there is a `reason`
    std::string reason;              ///< why points cannot be located exactly in the data set; empty if they can

    int normal = -1;                   ///< of the plane of triangles: axis 0, 1 or 2; -1: tetrahedra
    double plane = 0;                  ///< its coordinate on that axis
    std::array<int, 3> axes{0, 1, 2};  ///< axis of space of each axis of the mesh

    double near = 0;  ///< some cell sizes: the cell of a point so near is worth a look

    bool exact() const { return reason.empty(); }
    Simplex simplex() const { return mesh.dimension == 2 ? Simplex::triangle : Simplex::tetrahedron; }
    vtkIdType id(Mesh::Index cell) const {
        return ids.empty() || cell < 0 ? cell : ids[static_cast<std::size_t>(cell)];
    }
    /// The point on the axes of the mesh; false if it lies off the plane of the mesh.
    bool project(const double* x, double* point) const {
        for (std::size_t i = 0; i < 3; ++i) point[i] = x[axes[i]];
        return normal < 0 || x[normal] == plane;
    }
};

/// What a data set is to be taken for, if it is a piece of a mesh: the pieces of one mesh are taken alike.
struct SimplexShape {
    int dimension = 0;           ///< of the cells that count; 0: the highest of its own
    int normal = -1;             ///< triangles: the axis across which their plane lies; -1: any
    bool by_global_ids = false;  ///< the mesh's cells are in the order of GlobalIds of the cell data, integers

    friend bool operator==(const SimplexShape&, const SimplexShape&) = default;
};

/// Of one data set at one time of modification it is made once; data sets of the same cells share it as long as one of
/// them lives. Any thread may call this, one at a time for a vtkPolyData, whose cells it may build. Never null.
std::shared_ptr<const ExactIndex> exact_index(vtkDataSet& data, const SimplexShape& shape = {});

/// The next one is made anew.
void forget_index(const vtkDataSet& data);

}  // namespace barycert::in_vtk
