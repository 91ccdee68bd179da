/// The elements that are the cells of a mesh.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "barycert/io/gmsh/msh_elements.hpp"
#include "barycert/io/gmsh/tag_index.hpp"
#include "barycert/mesh.hpp"

namespace barycert::io {

struct MshCells {
    int dimension = 3;
    std::vector<Mesh::Index> corners, mid_nodes;  ///< in Gmsh's order
    std::vector<std::int64_t> tags;               ///< of elements
    std::vector<Mesh::Index> numbers;             ///< among all elements; empty if all are cells
    std::vector<double> physical, geometrical;    ///< tags of groups and of entities; in 2.x only
    TypeCounts left_out{};                        ///< of a lower dimension
    bool apart = false;                           ///< one of these has a node that no cell has
    bool partitioned = false;                     ///< there are further tags; 2.x only
    std::size_t unused_nodes = 0;
    std::size_t repeated = 0;  ///< elements of further groups; 2.x only
};

/// Tetrahedra, or triangles where there is nothing of dimension 3. Error: other cells of that dimension, cells of both
/// orders, an element that names a node that there is not.
Result<MshCells> read_msh_cells(const MshFile& file, const MshElements& elements, const TagIndex& nodes,
                                std::size_t node_count);

}  // namespace barycert::io
