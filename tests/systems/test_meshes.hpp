/// Meshes to ask systems about, each with a field of nodes.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "barycert/mesh.hpp"

namespace barycert::systems {

/// Linear simplices, in space or in the plane, or anything else. Each kind has a table of its own.
enum class CellKind : std::uint8_t { tetrahedra, triangles, others };

inline constexpr std::array all_kinds{CellKind::tetrahedra, CellKind::triangles, CellKind::others};

inline CellKind kind_of(const Mesh& mesh) {
    if (!mesh.shapes.types.empty() || !mesh.mid_nodes.empty()) return CellKind::others;
    return mesh.dimension == 3 ? CellKind::tetrahedra : CellKind::triangles;
}

struct NamedMesh {
    std::string name;
    std::string about;  ///< one line
    Mesh mesh;          ///< has one field: f
};

/// Made ones and those of data/meshes, in a fixed order.
std::vector<NamedMesh> meshes_for_systems();

}  // namespace barycert::systems
