/// The defects that a check may find in a mesh, and which of them break the certificate.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "barycert/mesh.hpp"

namespace barycert {

enum class DefectKind : std::uint8_t {
    // These break the certificate. P1 to P5: the condition of check.hpp that fails.
    bad_structure,       ///< P1  array sizes that are no whole number of nodes or cells
    index_out_of_range,  ///< P1  a vertex of a cell is not a node of the mesh
    not_finite,          ///< P1  a node has a NaN or infinite coordinate
    repeated_node,       ///< P1  a cell names a node twice
    degenerate_cell,     ///< P1  exactly zero volume: coplanar, collinear, or one point
    duplicate_cell,      ///< P2  two cells have the same nodes
    overfull_facet,      ///< P2  a facet belongs to more than two cells
    same_side,           ///< P2  two cells lie on the same side of their common facet
    open_boundary,       ///< the boundary does not continue at a ridge: follows from P2 failing
    boundary_contact,    ///< P3  two boundary facets meet outside common vertices and edges
    nested_part,         ///< P4  a piece of the boundary at which a cell overlaps others
    overlapping_cells,   ///< the interiors of two cells meet: caused by the defects above
    wrong_neighbour,     ///< P5  .neigh names a cell that does not share that facet, or misses one that does
    wrong_face,          ///< P5  a face in the files is not a facet of any cell; a mesh of triangles has faces
    unfit_array,         ///< P5  fields, markers or mid-edge nodes do not fit the nodes and cells
    // These are reported and do not affect the certificate.
    mixed_orientation,  ///< cells are ordered in both ways
    plain_sign_wrong,   ///< the sign of the cell's volume in plain double is not the exact one
    coincident_nodes,   ///< two nodes have the same coordinates
    unused_node,        ///< a node of no cell
    pinched_ridge,      ///< the boundary touches itself along a ridge of more than two of its facets
    pinched_node,       ///< the boundary touches itself in a node of several fans
    // Later ones stand last, so that the bits of DefectSet stay.
    hanging_node,  ///< breaks it: a node of one boundary facet lies within an edge of another one, or within that facet
    near_nodes,    ///< two nodes of the boundary nearly coincide: CheckOptions::near
    crack,         ///< two boundary facets would be one if coincident and near nodes were merged
    missing_cell,  ///< a void of the shape of one cell, whose facets are a piece of the boundary
    near_hanging,  ///< a node of the boundary nearly lies within an edge or a facet of it: CheckOptions::near
};

struct DefectText {
    DefectKind kind;
    std::string_view name;       ///< as in reports
    std::string_view condition;  ///< "P1" ... or "" if it does not break the certificate by itself
    std::string_view text;       ///< what it is
    std::string_view remedy;     ///< what to do about it; empty if nothing need be done
    bool breaks;                 ///< the certificate
};

inline constexpr std::array<DefectText, 26> defect_texts{{
    {DefectKind::bad_structure, "bad_structure", "P1", "arrays whose sizes are no whole number of nodes or cells",
     "give d coordinates per node and d + 1 vertices per cell", true},
    {DefectKind::index_out_of_range, "index_out_of_range", "P1", "cells with a vertex index out of range",
     "check the index base and the node count", true},
    {DefectKind::not_finite, "not_finite", "P1", "nodes with a NaN or infinite coordinate",
     "find where these coordinates were computed", true},
    {DefectKind::repeated_node, "repeated_node", "P1", "cells that name a node twice", "remove these collapsed cells",
     true},
    {DefectKind::degenerate_cell, "degenerate_cell", "P1", "cells with a volume of exactly zero",
     "mesh again with a quality bound, or move a node", true},
    {DefectKind::duplicate_cell, "duplicate_cell", "P2", "cells with the same nodes as another", "keep one of each",
     true},
    {DefectKind::overfull_facet, "overfull_facet", "P2", "facets that belong to more than two cells",
     "cells overlap there or are duplicates: remove them", true},
    {DefectKind::same_side, "same_side", "P2", "facets with both cells on the same side",
     "move back the node that passed through the facet", true},
    {DefectKind::open_boundary, "open_boundary", "", "ridges where the boundary is not closed",
     "remove the defects above: this one follows from them", true},
    {DefectKind::boundary_contact, "boundary_contact", "P3",
     "pairs of boundary facets that meet outside common vertices and edges",
     "move the parts apart, or cut both where they cross", true},
    {DefectKind::nested_part, "nested_part", "P4", "pieces of the boundary where a cell overlaps others",
     "a part lies inside another one: remove one of them", true},
    {DefectKind::overlapping_cells, "overlapping_cells", "", "pairs of cells whose interiors meet",
     "remove the other defects: this one follows from them", true},
    {DefectKind::wrong_neighbour, "wrong_neighbour", "P5", "entries of .neigh that disagree with the cells",
     "delete the .neigh file or write it again", true},
    {DefectKind::wrong_face, "wrong_face", "P5", "faces in the files that are not facets of a cell",
     "delete the .face file (of Medit the section Triangles) or write it again", true},
    {DefectKind::unfit_array, "unfit_array", "P5", "other arrays that do not fit the nodes and cells",
     "give one value per component of each node or cell, and valid node indices", true},
    {DefectKind::mixed_orientation, "mixed_orientation", "", "cells of the less frequent orientation",
     "check --fix writes a copy with positive cells", false},
    {DefectKind::plain_sign_wrong, "plain_sign_wrong", "", "cells whose volume has the wrong sign in plain double",
     "use exact predicates on these cells", false},
    {DefectKind::coincident_nodes, "coincident_nodes", "", "nodes with the same coordinates as another",
     "check --fix merges them, if their cells should be neighbours", false},
    {DefectKind::unused_node, "unused_node", "", "nodes that no cell uses", "", false},
    {DefectKind::pinched_ridge, "pinched_ridge", "", "ridges where the boundary touches itself", "", false},
    {DefectKind::pinched_node, "pinched_node", "", "nodes where the boundary touches itself", "", false},
    {DefectKind::hanging_node, "hanging_node", "", "nodes that lie within an edge or a facet of another cell",
     "split that cell at the node", true},
    {DefectKind::near_nodes, "near_nodes", "", "pairs of boundary nodes that nearly coincide",
     "check --fix --merge-within DISTANCE merges them, if their cells should be neighbours", false},
    {DefectKind::crack, "crack", "", "pairs of boundary facets that merging these nodes would join", "", false},
    {DefectKind::missing_cell, "missing_cell", "", "voids that one cell would fill", "is one cell missing?", false},
    {DefectKind::near_hanging, "near_hanging", "", "nodes that nearly lie within an edge or a facet of another cell",
     "split that cell at the node, if the cells on both sides should be neighbours", false},
}};

inline constexpr std::size_t defect_kind_count = defect_texts.size();

constexpr const DefectText& defect_text(DefectKind p) {
    return defect_texts[static_cast<std::size_t>(p)];
}

/// A set of kinds: bit i is kind i.
using DefectSet = std::uint32_t;
constexpr DefectSet defect_bit(DefectKind p) {
    return DefectSet{1} << static_cast<unsigned>(p);
}

/// Where a defect is. Unused entries are -1.
struct DefectPlace {
    std::array<Mesh::Index, 2> cells{-1, -1};
    std::array<Mesh::Index, 3> nodes{-1, -1, -1};
    const char* detail = "";  ///< which kind, where a defect has several
    /// Of the facet that those meet or would join, of the edge or facet that the node lies within or nearly, and the
    /// fourth node of a missing cell.
    std::array<Mesh::Index, 3> other_nodes{-1, -1, -1};
    double distance = 0;  ///< of near nodes, or of a node from what it nearly lies within; rounded
    double relative = 0;  ///< that over the shortest edge of the boundary at these nodes
};

struct Defect {
    DefectKind kind{};
    std::uint64_t count = 0;
    bool at_least = false;            ///< the search stopped at that count
    std::vector<DefectPlace> places;  ///< the first of them
    std::uint64_t curved_cells = 0;   ///< with this defect: their sides were taken as straight, and may be its cause
    /// It is why others break the certificate, though its kind does not in every case.
    bool cause = false;
    std::string_view better_remedy = {};  ///< where the cause is known

    bool breaks() const { return cause || defect_text(kind).breaks; }
    std::string_view remedy() const { return better_remedy.empty() ? defect_text(kind).remedy : better_remedy; }
};

}  // namespace barycert
