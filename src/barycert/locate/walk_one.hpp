/// The walk of one point, without the buffers of many.
#pragma once

#include "barycert/locate/locator_data.hpp"

namespace barycert::locate {

/// Where a walk of one point ends.
struct End {
    Place cell;
    bool inside;   ///< certainly
    bool outside;  ///< of this cell, certainly, and it has no neighbour there
};

/// `hint`: a cell of the mesh that may be near, or none of it. Preconditions: the mesh is one for walks, and has a
/// cell; a finite point.
End walk_one(const LocatorData& data, const double* point, Mesh::Index hint);

}  // namespace barycert::locate
