/// Writers of surfaces, one a format; surface_file.cpp chooses. Precondition of each: the surface is consistent.
#pragma once

#include <string>

#include "barycert/result.hpp"
#include "barycert/surface.hpp"
#include "barycert/table.hpp"

namespace barycert::io {

/// VTK's PolyData: polygons, or lines at z = 0; fields as arrays of doubles; the cells of the mesh as the array "cell",
/// where no field has that name. Error: a name that XML cannot hold, or is there twice.
Result<SurfaceFile> write_vtp(const Surface& surface, const std::string& path, VtkData data);

/// Binary, little-endian: vertices with coordinates and fields as double properties; faces, or edges (vertex1,
/// vertex2) at z = 0, with fields of cells. Names of properties have letters, digits and underscores only, and differ.
Result<SurfaceFile> write_ply(const Surface& surface, const std::string& path);

/// Text; triangles without fields. Error: segments.
Result<SurfaceFile> write_off(const Surface& surface, const std::string& path);

}  // namespace barycert::io
