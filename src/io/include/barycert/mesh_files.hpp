/// Meshes in any format.
///
/// Example:
///
///     #include <cstdio>
///     const Result<Mesh> mesh = read_mesh("part.1");  // part.1.node, part.1.ele
///     if (!mesh) std::puts(mesh.error().message().c_str());
///     if (mesh) write_mesh(*mesh, "part.vtu").value();
#pragma once

#include <string>
#include <vector>

#include "barycert/mesh.hpp"
#include "barycert/result.hpp"
#include "barycert/series.hpp"
#include "barycert/table.hpp"

namespace barycert {

struct ReadOptions {
    bool faces = true;       ///< read STEM.face if it is there, and Medit's triangles beside tetrahedra
    bool neighbours = true;  ///< read STEM.neigh if it is there
    int threads = 0;         ///< 0: as many as the machine has
    StepChoice step = {};    ///< of a series; Error: one is chosen, and there is no series
    /// False: image data and rectilinear grids of one piece without ghosts get Mesh::axes instead of points and cells,
    /// 8 bytes a node and less time. Locator::locate and Sampler::sample alone take them, with the same answers.
    bool list_grids = true;
};

/// Reads a mesh: TetGen's or Triangle's files by their stem or any one of them; a file of Gmsh, .msh, or Medit, .mesh
/// and .meshb; VTK's .vtu, .vtk, .vtp, .pvtu, .vtm, .pvd and .vtu.series. The format is told by the first bytes, or
/// else by the suffix. Error: a file of another format is named as what it is, with the command that converts it.
Result<Mesh> read_mesh(const std::string& path, const ReadOptions& options = {});

/// The paths of all files that read_mesh(path) may read.
std::vector<std::string> mesh_files(const std::string& path);

struct WriteOptions {
    std::string comment = {};     ///< TetGen's files: the last line of each, after "# "; empty: none
    VtkData data = VtkData::raw;  ///< VTK's files
};

/// Writes the mesh as its path ends: .msh, .vtu and .vtk, and TetGen's files by .node, .ele or a
/// stem. Error: another suffix; as these writers.
Status write_mesh(const Mesh& mesh, const std::string& path, const WriteOptions& options = {});

/// The files that write_mesh may write, or replace: the path, or STEM.node, .ele, .face, .neigh. Error: another suffix.
Result<std::vector<std::string>> written_mesh_files(const std::string& path);

}  // namespace barycert
