/// How cells meet at their facets, and which facets are the boundary.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "barycert/check/defect_list.hpp"
#include "barycert/mesh.hpp"

namespace barycert::check {

/// A facet of exactly one cell.
struct BoundaryFacet {
    Mesh::Index cell = -1;
    std::int32_t corner = 0;  ///< opposite to it
    /// In the order that turns its normal outward (2D: two, the cell to their left).
    std::array<Mesh::Index, 3> nodes{};
    bool oriented = true;  ///< false if the cell is degenerate, and the order of the nodes by chance
};

struct Facets {
    std::vector<Mesh::Index> neighbours;  ///< as compute_neighbours gives them, of usable cells
    std::vector<BoundaryFacet> boundary;  ///< ordered by their nodes
};

/// Finds duplicate_cell, overfull_facet, same_side. `orientation`: the exact sign of each cell.
Facets check_facets(const Mesh& mesh, const std::vector<std::uint8_t>& usable, CellMeasures& measures,
                    DefectList& defects);

/// The facets of a mesh whose cells partition a domain, proved by the index (index/proof.hpp) in less time than
/// check_facets takes; nothing if that is not proved. Preconditions: indices in range, coordinates finite;
/// `orientation` as above.
std::optional<Facets> facets_of_partition(const Mesh& mesh, const std::vector<std::int8_t>& orientation);

/// The nodes of the facet opposite to `corner`, in the order that turns its normal outward if the cell's orientation is
/// not negative; `orientation` is that of the cell. 2D: two of them.
std::array<Mesh::Index, 3> outward_nodes(const Mesh& mesh, std::size_t cell, std::size_t corner, int orientation);

}  // namespace barycert::check
