/// Gmsh's .msh files: meshes in and out. read_mesh and write_mesh come here for what ends in .msh.
///
/// Example:
///
///     #include <cstdio>
///     for (const GmshStep& step : gmsh_steps("part.msh").value()) std::printf("%s %g\n", step.field.c_str(),
///     step.time); const Mesh mesh = read_gmsh("part.msh", {.step = 3}).value(); write_gmsh(mesh, "plain.msh", {.binary
///     = false}).value();
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "barycert/mesh.hpp"
#include "barycert/result.hpp"

namespace barycert {

struct GmshReadOptions {
    /// Which step in time fields are read of; not set: the first of each. A field with a single step is read anyway.
    std::optional<std::int64_t> step = {};
    int threads = 0;  ///< 0: as many as the machine has
};

/// Reads a .msh file of version 4.1, 4.0 or 2.x, text or binary of either byte order.
///
/// - Elements of dimension 3 make a mesh of dimension 3; where there are none, polygons one of dimension 2, with z = 0.
///   What is no simplex of order 1 or 2, or of several types, makes Mesh::shapes: of higher orders by its corners, but
///   simplices up to order 4 with all nodes.
/// - Elements of a lower dimension are left out, with a Note; `cell_numbers` are positions among all elements.
/// - Nodes stand in the order of the file whatever their tags, those of no cell included.
/// - Cell fields "gmsh:physical" (the tag of the cell's group, 0 for none; absent if no cell has one) and
///   "gmsh:geometrical" (that of its entity; absent if 1 for all cells, or 0). Cell labels "gmsh:physical_name", if a
///   group of cells has a name, and "gmsh:tag", the elements' tags, unless they are 1, 2, 3, ... in their order.
/// - $NodeData and $ElementData become fields of the view's name. Nodes and cells without a value have NaN.
/// - What else there is (values at the nodes of elements, interpolation schemes, periodic nodes) is left out: Notes.
///
/// Error: the file is missing, cut off, contradicts itself, has a coordinate that is not finite, two nodes of one tag,
/// a cell with an unknown node, other types of cells (which are named), no cells, or triangles off the plane z = 0.
/// Memory is bounded by a multiple of the file's size; where it is short: Error.
Result<Mesh> read_gmsh(const std::string& path, const GmshReadOptions& options = {});

/// One section of values of a .msh file.
struct GmshStep {
    std::string field;  ///< the view's name
    bool of_cells = false;
    int components = 1;
    std::int64_t step = 0;
    double time = 0;

    friend bool operator==(const GmshStep&, const GmshStep&) = default;
};

/// The steps of all $NodeData and $ElementData, in the order of the file; only their headers are read. Returns an Error
/// as read_gmsh does for these sections; a file that has no mesh is no error.
Result<std::vector<GmshStep>> gmsh_steps(const std::string& path);

/// The nodes, `dimension` coordinates a node. In dimension 2 every z must be 0. Elements are not read.
Result<std::vector<double>> read_gmsh_points(const std::string& path, int dimension, int threads = 0);

struct GmshWriteOptions {
    enum class Version : std::uint8_t { v41, v22 };
    Version version = Version::v41;
    bool binary = true;
};

/// Writes nodes, cells, and fields as $NodeData and $ElementData. Every double reads back to the same bits; in text,
/// NaN loses its payload.
///
/// - The cell field "gmsh:physical" becomes groups, named by the cell labels "gmsh:physical_name", and
///   "gmsh:geometrical" the entities. Where that cannot be (tags that are no integers of 32 bits; in 4.1, an entity in
///   several groups), they are $ElementData, which reads back the same. In 4.1 each group needs an entity: without
///   "gmsh:geometrical" they are numbered from 1, and read_gmsh gives them as that field.
/// - Elements have the tags of the label "gmsh:tag" if these are positive and differ, else cell_numbers from 1.
/// - point_markers become $NodeData "marker". Faces, neighbours and other labels are not written.
///
/// The file appears whole or not at all. Error: the mesh is inconsistent; a name of two fields of one kind, or with a
/// line break or a quote in it; the file cannot be written.
Status write_gmsh(const Mesh& mesh, const std::string& path, const GmshWriteOptions& options = {});

}  // namespace barycert
