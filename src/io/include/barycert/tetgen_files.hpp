/// TetGen's and Triangle's files: meshes in and out.
///
/// Example:
///
///     Mesh mesh = read_tetgen("part.1.node").value();
///     mesh.point_fields.clear();
///     write_tetgen(mesh, "plain").value();  // plain.node, plain.ele
#pragma once

#include <string>
#include <vector>

#include "barycert/mesh.hpp"
#include "barycert/mesh_files.hpp"
#include "barycert/result.hpp"

namespace barycert {

/// STEM of STEM.node, STEM.ele, STEM.face or STEM.neigh; any other path as it is.
std::string tetgen_stem(const std::string& path);

/// The paths of the files that a mesh may be in, by its stem or any one of them: STEM.node, .ele, .face, .neigh.
std::vector<std::string> tetgen_files(const std::string& path);

/// Reads STEM.node and STEM.ele. `path` is the stem or the path of any one of its files.
Result<Mesh> read_tetgen(const std::string& path, const ReadOptions& options = {});

/// Writes STEM.node and STEM.ele, and STEM.face and STEM.neigh where the mesh has faces and neighbours. Every double
/// reads back to the same bits. No file is left half-written.
Status write_tetgen(const Mesh& mesh, const std::string& stem, const WriteOptions& options = {});

}  // namespace barycert
