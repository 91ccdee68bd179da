/// Simplices drawn from meshes: cells, and the faces and edges of cells.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "barycert/audit.hpp"
#include "barycert/base/random.hpp"
#include "barycert/check.hpp"
#include "barycert/mesh.hpp"
#include "barycert/simplex.hpp"

namespace barycert::audit {

/// A mesh prepared for drawing simplices: its neighbours, hull and bounding box.
struct PreparedMesh {
    std::string name;
    Mesh mesh;
    std::vector<Mesh::Index> neighbours;    ///< as compute_neighbours gives them
    std::vector<std::int64_t> hull_facets;  ///< cell * corners + opposite corner
    std::array<double, 3> low{}, high{};    ///< bounding box
    Certificate certificate;                ///< what is known of the mesh
};

/// A simplex drawn from a mesh, with the cell it belongs to.
struct Draw {
    const PreparedMesh* from = nullptr;
    Mesh::Index cell = 0;
    std::array<Mesh::Index, 4> nodes{};
    Case simplex;  ///< vertices and nodal values set, point not
};

/// A random cell, or a random face or edge of one. Nodal values are a component of one of the mesh's point fields,
/// drawn as well, or random in [-1, 1) if it has none and where it is not finite. Precondition: meshes.supplies(s).
Draw draw_any(const MeshSource& meshes, Simplex s, base::Random& random);

/// A random cell at the hull, its vertices ordered so that the hull's facet is the one opposite to the last.
Draw draw_at_hull(const MeshSource& meshes, Simplex s, base::Random& random);

/// The simplex that given nodes make.
Draw draw_of_nodes(const PreparedMesh& from, Mesh::Index cell, std::array<Mesh::Index, 4> nodes, Simplex s,
                   base::Random& random);

/// The cell itself.
Draw draw_of_cell(const PreparedMesh& from, Mesh::Index cell, base::Random& random);

}  // namespace barycert::audit
