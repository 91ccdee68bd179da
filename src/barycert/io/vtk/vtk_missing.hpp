/// What to tell who names a VTK file to a build without VTK.
#pragma once

#include <string>

#include "barycert/result.hpp"

namespace barycert {

inline Error vtk_missing(const std::string& path) {
    return {.what = "this build has no VTK, which reads and writes .vtu, .vtk and .vtp files",
            .file = path,
            .line = 0,
            .expected = {},
            .found = {},
            .remedy =
                "install libvtk9-dev and configure with -DBARYCERT_VTK=ON, or convert the mesh with `meshio convert "
                "IN.vtu OUT.node`, which keeps linear tetrahedra but not every field"};
}

}  // namespace barycert
