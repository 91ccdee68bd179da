/// $Nodes.
#pragma once

#include <vector>

#include "barycert/io/gmsh/msh_file.hpp"
#include "barycert/io/gmsh/tag_index.hpp"
#include "barycert/result.hpp"

namespace barycert::io {

struct MshNodes {
    std::vector<double> points;  ///< x, y, z a node, finite
    TagIndex index;
};

/// Error: what the grammar does not have, a tag twice, a coordinate that is not finite.
Result<MshNodes> read_msh_nodes(const MshFile& file);

}  // namespace barycert::io
