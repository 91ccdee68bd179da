/// Which cells of a mesh the HTML report draws, and their pictures.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "barycert/check.hpp"

namespace barycert::report {

/// One or two cells that are worth a look.
struct Exhibit {
    std::array<Mesh::Index, 2> cells{-1, -1};  ///< the second is -1 if it is one cell
    std::string what;                          ///< why it is shown, escaped
    const CellContact* contact = nullptr;      ///< with a witness
    bool defect = false;                       ///< else it is just the worst by shape
};

/// The cells of smallest (dihedral) angle, smallest first, that are not degenerate and can be drawn; ties by index.
std::vector<Exhibit> worst_cells(const CheckReport& report, const Mesh& mesh, std::size_t max);

/// Cells with defects, each problem in turn, so that a few of one kind leave room for the others. Contacts and places
/// of defects that name cells which can be drawn.
std::vector<Exhibit> defect_cells(const CheckReport& report, const Mesh& mesh, std::size_t max);

/// A card: the cell from two sides, at the same scale, with the numbers of its nodes; what is known of it. `number` is
/// the one it has in the map.
std::string exhibit_card(const CheckReport& report, const Mesh& mesh, const Exhibit& exhibit, std::size_t number);

/// Where in the mesh they are: its boundary, thinned out to at most 3000 marks, and the exhibits by their numbers.
std::string exhibit_map(const CheckReport& report, const Mesh& mesh, const std::vector<Exhibit>& exhibits);

}  // namespace barycert::report
