/// Gmsh's .msh files: meshes in and out. read_mesh and write_mesh (io.hpp) come here for what ends in .msh.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "barycert/mesh.hpp"
#include "barycert/result.hpp"

namespace barycert {

struct GmshReadOptions {
    /// Which step in time fields are read of; not set: of each field its first one. A field with a single step is read
    /// in any case.
    std::optional<std::int64_t> step = {};
    int threads = 0;  ///< 0: as many as the machine has
};

/// Reads a .msh file of version 4.1, 4.0 or 2.x, text or binary of either byte order.
///
/// - Tetrahedra make a mesh of dimension 3. Where there are no cells of dimension 3, triangles make one of dimension 2,
///   and all nodes must have z = 0. All cells are of order 1 or all of order 2.
/// - Elements of a lower dimension are left out, with a Note; `cell_numbers` are positions among all elements.
/// - Nodes stand in the order of the file whatever their tags, those of no cell included.
/// - Cell fields "gmsh:physical" (the tag of the cell's physical group, 0 for none; absent if no cell has one) and
///   "gmsh:geometrical" (that of its entity; absent if it is 1 for all cells, or 0 for all). Cell labels
///   "gmsh:physical_name", if a group of cells has a name, and "gmsh:tag", the elements' tags, unless they are 1, 2, 3,
///   ... in the order of the file.
/// - $NodeData and $ElementData become fields of the view's name. Nodes and cells without a value have NaN.
/// - What else there is (values at the nodes of each element, interpolation schemes, periodic nodes) is left out, with
/// a
///   Note.
///
/// Error: the file is missing, cut off, contradicts itself, has a coordinate that is not finite, two nodes with one
/// tag, an element with an unknown node, cells of other types (they are named), no cells, or triangles off the plane z
/// = 0; memory is short. Memory is bounded by a multiple of the file's size.
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

/// All of $NodeData and $ElementData, in the order of the file; only their headers are read. Error: as read_gmsh, as
/// far as it concerns these. A file without a mesh is none.
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
/// - The cell field "gmsh:physical" becomes physical groups, named by the cell labels "gmsh:physical_name", and
///   "gmsh:geometrical" the entities. Where that cannot be (tags that are no integers of 32 bits; in 4.1, an entity in
///   several groups), they are written as $ElementData, which read_gmsh gives back just so. In 4.1 each group needs an
///   entity: without "gmsh:geometrical" they are numbered from 1, and read_gmsh gives them as that field.
/// - Elements have the tags of the label "gmsh:tag" if these are positive and differ, or else the numbers of the cells
///   in the file they came from, from 1.
/// - point_markers become $NodeData "marker". Faces, neighbours and other labels are not written.
///
/// The file appears whole or not at all. Error: the mesh is inconsistent; two fields of one kind have the same name, or
/// one has a line break or a quote in it; the file cannot be written.
Status write_gmsh(const Mesh& mesh, const std::string& path, const GmshWriteOptions& options = {});

}  // namespace barycert
