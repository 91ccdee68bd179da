/// Triangles off the plane z = 0: a surface where a mesh was read.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "barycert/gmsh_files.hpp"
#include "barycert/mesh.hpp"
#include "barycert/mesh_files.hpp"
#include "barycert/result.hpp"

namespace barycert::io {

/// Data of a file of triangles off the plane z = 0 that the mesh in the plane, of their x and y, does not have.
struct InSpace {
    std::vector<double> points;       ///< 3 coordinates a node; empty: it is a mesh in the plane
    std::vector<Mesh::Index> facets;  ///< as of Surface
};
/// By the end of the path: one of polygons, or .vtp.
bool is_surface_file(const std::string& path);
Result<Mesh> read_mesh_in_space(const std::string& path, const ReadOptions& options, InSpace* space);
Result<Mesh> read_vtk_in_space(const std::string& path, const ReadOptions& options, InSpace* space);
Result<Mesh> read_gmsh_in_space(const std::string& path, const GmshReadOptions& options, InSpace* space);

/// Whether all points lie in that plane; what to do where it is not z = 0. `path`: if it holds linear triangles.
bool in_plane(std::span<const double> points, double z = 0);
std::string plane_remedy(std::span<const double> points, const std::string& path);

}  // namespace barycert::io
