/// Meshes as a supply of simplices for cases: cells, and the faces and edges of cells.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "barycert/check/certificate.hpp"
#include "barycert/core/random.hpp"
#include "barycert/core/simplex.hpp"
#include "barycert/mesh/mesh.hpp"

namespace barycert::audit {

/// A mesh prepared for drawing simplices: its neighbours, hull and bounding box.
struct PreparedMesh {
    std::string name;
    Mesh mesh;
    std::vector<Mesh::Index> neighbours;    ///< as compute_neighbours gives them
    std::vector<std::int64_t> hull_facets;  ///< cell * corners + opposite corner
    std::array<double, 3> low{}, high{};    ///< bounding box
    check::Certificate certificate;         ///< what is known of the mesh
};

/// A simplex drawn from a mesh, with the cell it belongs to.
struct Draw {
    const PreparedMesh* from = nullptr;
    Mesh::Index cell = 0;
    std::array<Mesh::Index, 4> nodes{};
    Case simplex;  ///< vertices and nodal values set, point not
};

class MeshSource {
public:
    /// `certificate`: of this mesh, if it was checked.
    void add(std::string name, Mesh mesh, const check::Certificate& certificate = {});

    bool supplies(Simplex s) const;
    const std::vector<PreparedMesh>& meshes() const { return meshes_; }

    /// A random cell, or a random face or edge of one. Nodal values are a component of one of the mesh's point fields,
    /// drawn as well, or random in [-1, 1) if it has none. Precondition: supplies(s).
    Draw any(Simplex s, Random& random) const;

    /// A random cell at the hull, its vertices ordered so that the hull's facet is the one opposite to the last.
    Draw at_hull(Simplex s, Random& random) const;

    /// The simplex that given nodes make.
    static Draw from_nodes(const PreparedMesh& from, Mesh::Index cell, std::array<Mesh::Index, 4> nodes, Simplex s,
                           Random& random);

private:
    const PreparedMesh& pick(Simplex s, Random& random) const;
    std::vector<PreparedMesh> meshes_;
};

}  // namespace barycert::audit
