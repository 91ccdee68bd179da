/// Meshes to ask systems about, each with a field of nodes.
#pragma once

#include <string>
#include <vector>

#include "barycert/mesh.hpp"

namespace barycert::systems {

struct NamedMesh {
    std::string name;
    std::string about;  ///< one line
    Mesh mesh;          ///< has one field: f
};

/// Made ones and those of data/meshes, in a fixed order.
std::vector<NamedMesh> meshes_for_systems();

}  // namespace barycert::systems
