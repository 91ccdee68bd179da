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

struct BoundaryContacts {
    std::vector<CellPair> cells;           ///< of the facets of each
    std::vector<std::uint8_t> in_contact;  ///< 1 for each node of these facets; empty if there are none
};

/// P3: finds boundary_contact, up to `limit` of them, and the hanging_node of each.
BoundaryContacts find_boundary_contacts(const Mesh& mesh, const std::vector<BoundaryFacet>& facets, std::size_t limit,
                                        CellMeasures& measures, DefectList& defects);

/// P4: finds nested_part, up to `limit` of them, each with the lowest cell that overlaps. `pieces`: one of the `facets`
/// of each piece of the boundary.
void find_nested_parts(const Mesh& mesh, const std::vector<BoundaryFacet>& facets,
                       const std::vector<std::uint32_t>& pieces, std::size_t limit, CellMeasures& measures,
                       DefectList& defects);

/// Finds overlapping_cells among all that are not degenerate.
std::vector<CellPair> find_overlapping_cells(const Mesh& mesh, CellMeasures& measures, DefectList& defects);

}  // namespace barycert::check
