/// Triangles in space from files.
///
/// Example:
///
///     #include "barycert/check.hpp"
///     const Surface surface = read_surface("part.stl").value();
///     const bool closed = check_surface(surface).surface->closed;
#pragma once

#include <string>
#include <variant>

#include "barycert/mesh.hpp"
#include "barycert/mesh_files.hpp"
#include "barycert/result.hpp"
#include "barycert/surface.hpp"

namespace barycert {

/// Reads triangles in space.
///
/// - .stl (text or binary; corners of equal coordinates are one node), .ply (text or binary), .off, .obj; .poly and
///   .smesh (read_plc); triangles of any file that read_mesh takes. Second-order triangles by their corners.
/// - A polygon is cut into triangles of its own corners: four corners at the lower one, unless only the other diagonal
///   leaves triangles that turn one way; more by a triangulation in the projection along the longest axis of its
///   normal, whose signs are exact. So is a facet of a PLC, with its holes. What cannot be cut (it crosses itself, or
///   is flat) is left out, and told. Surface::facets says which cells are of one polygon.
/// - Properties of .ply files that are numbers, and fields of meshes, are fields.
///
/// Error: as in read_plc and read_mesh; tetrahedra; no triangles.
Result<Surface> read_surface(const std::string& path, const ReadOptions& options = {});

/// A mesh, or triangles in space: of files that either may be in, triangles with z = 0 throughout are a mesh.
Result<std::variant<Mesh, Surface>> read_mesh_or_surface(const std::string& path, const ReadOptions& options = {});

}  // namespace barycert
