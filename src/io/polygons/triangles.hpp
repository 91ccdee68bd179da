/// Surfaces of polygons and PLCs.
#pragma once

#include <string>

#include "barycert/mesh.hpp"
#include "barycert/plc.hpp"
#include "barycert/surface.hpp"
#include "io/in_space.hpp"
#include "io/polygons/polygons.hpp"

namespace barycert::io {

/// By extension: polygons are all that read_plc takes; a PLC may have segments, holes and regions besides.
bool is_polygons_file(const std::string& path);
bool is_plc_file(const std::string& path);

Surface surface_of(Mesh mesh, InSpace space);

/// Polygons that cannot be cut are left out, and noted.
Surface surface_of(Polygons polygons, const std::string& path);
Surface surface_of(const Plc& plc, const std::string& path);

}  // namespace barycert::io
