/// The searches for facets and cells that meet where they must not.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "barycert/check/defect_list.hpp"
#include "barycert/check/facets.hpp"
#include "barycert/mesh.hpp"

namespace barycert::check {

/// A search is given up after so many pairs: a mesh that is wrong throughout has as many as the square of its cells.
inline constexpr std::size_t pair_limit = 1000;

using CellPair = std::array<Mesh::Index, 2>;

struct HangingNode {
    Mesh::Index node = -1;
    std::array<Mesh::Index, 3> face{-1, -1, -1};  ///< that it lies within, or nearly; ascending
    Mesh::Index cell = -1;                        ///< of the face
    double distance = 0;                          ///< from it, rounded
};

/// By node and face; of those with the same the first cell's.
void sort_hanging(std::vector<HangingNode>& all);

struct BoundaryContacts {
    std::vector<CellPair> cells;       ///< of the facets of each
    std::vector<HangingNode> hanging;  ///< at these facets
    bool complete = true;              ///< there are no more
};

/// P3: finds boundary_contact, up to `limit` of them.
BoundaryContacts find_boundary_contacts(const Mesh& mesh, const std::vector<BoundaryFacet>& facets, std::size_t limit,
                                        CellMeasures& measures, DefectList& defects);

/// P4: finds nested_part, up to `limit` of them, each with the lowest cell that overlaps. `pieces`: one of the `facets`
/// of each piece of the boundary.
std::vector<CellPair> find_nested_parts(const Mesh& mesh, const std::vector<BoundaryFacet>& facets,
                                        const std::vector<std::uint32_t>& pieces, std::size_t limit,
                                        CellMeasures& measures, DefectList& defects);

/// Finds overlapping_cells among all that are not degenerate.
std::vector<CellPair> find_overlapping_cells(const Mesh& mesh, CellMeasures& measures, DefectList& defects);

}  // namespace barycert::check
