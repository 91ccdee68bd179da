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
    // These break the certificate.
    bad_structure,       ///< P1  arrays whose sizes do not make whole nodes or cells
    index_out_of_range,  ///< P1  a corner of a cell is no node
    not_finite,          ///< P1  a node has a coordinate that is NaN or infinite
    repeated_node,       ///< P1  a cell has a node twice
    degenerate_cell,     ///< P1  exactly zero volume: coplanar, collinear, or one point
    duplicate_cell,      ///< P2  two cells have the same nodes
    overfull_facet,      ///< P2  a facet belongs to more than two cells
    same_side,           ///< P2  two cells lie on the same side of their common facet
    open_boundary,       ///< at a ridge boundary facets do not continue each other: what follows from P2 failing
    boundary_contact,    ///< P3  two boundary facets meet outside common vertices and edges
    nested_part,         ///< P4  a piece of the boundary at which a cell overlaps others
    overlapping_cells,   ///< the interiors of two cells meet: what follows from the above
    wrong_neighbour,     ///< P5  .neigh names a cell that does not share that facet, or misses one that does
    wrong_face,          ///< P5  .face has a triangle that is no facet of any cell; a mesh of triangles has faces
    unfit_array,         ///< P5  fields, markers or nodes at mid-edges of cells do not fit nodes and cells
    // These are told, and harmless to a partition.
    mixed_orientation,  ///< cells are ordered in both ways
    plain_sign_wrong,   ///< the sign of the cell's volume in plain double is not the exact one
    coincident_nodes,   ///< two nodes at the same place
    unused_node,        ///< of no cell
    pinched_ridge,      ///< the boundary touches itself along a ridge that more than two of its facets have
    pinched_node,       ///< the boundary touches itself in a node of several fans
};

struct DefectText {
    DefectKind kind;
    std::string_view name;       ///< as in reports
    std::string_view condition;  ///< "P1" ... or "" if it does not break the certificate by itself
    std::string_view text;       ///< what it is, for people
    std::string_view remedy;     ///< what to do about it
    bool breaks;                 ///< the certificate
};

inline constexpr std::array<DefectText, 21> defect_texts{{
    {DefectKind::bad_structure, "bad_structure", "P1", "arrays do not make whole nodes or cells",
     "give d coordinates a node, d + 1 corners a cell", true},
    {DefectKind::index_out_of_range, "index_out_of_range", "P1", "cells with a corner that is no node",
     "check the index base and the count of nodes", true},
    {DefectKind::not_finite, "not_finite", "P1", "nodes with a coordinate that is not finite",
     "find where the coordinates were made", true},
    {DefectKind::repeated_node, "repeated_node", "P1", "cells that have a node twice",
     "remove them: they were collapsed", true},
    {DefectKind::degenerate_cell, "degenerate_cell", "P1", "cells of exactly zero volume",
     "mesh again with a quality bound, or move a node", true},
    {DefectKind::duplicate_cell, "duplicate_cell", "P2", "cells with the same nodes as another", "remove all but one",
     true},
    {DefectKind::overfull_facet, "overfull_facet", "P2", "facets that belong to more than two cells",
     "cells overlap there, or were added twice", true},
    {DefectKind::same_side, "same_side", "P2", "facets with both cells on the same side",
     "a cell is folded over: a node went through a facet", true},
    {DefectKind::open_boundary, "open_boundary", "", "ridges where the boundary does not close",
     "follows from the above", true},
    {DefectKind::boundary_contact, "boundary_contact", "P3",
     "pairs of boundary facets that meet outside common vertices and edges",
     "merge coincident nodes, or move the parts apart", true},
    {DefectKind::nested_part, "nested_part", "P4", "pieces of the boundary where a cell overlaps others",
     "a part lies inside another one: remove one of them", true},
    {DefectKind::overlapping_cells, "overlapping_cells", "", "pairs of cells whose interiors meet",
     "see the other problems", true},
    {DefectKind::wrong_neighbour, "wrong_neighbour", "P5", "entries of .neigh that are not the cells' own",
     "remove the .neigh file, or write it again", true},
    {DefectKind::wrong_face, "wrong_face", "P5", "triangles of .face that are no facet of a cell",
     "remove the .face file, or write it again", true},
    {DefectKind::unfit_array, "unfit_array", "P5", "arrays besides coordinates and cells that do not fit these",
     "give one value for each component of each node or cell, and indices of nodes", true},
    {DefectKind::mixed_orientation, "mixed_orientation", "", "cells of the rarer orientation",
     "--fix-orientation writes a copy with all positive", false},
    {DefectKind::plain_sign_wrong, "plain_sign_wrong", "", "cells whose volume has a wrong sign in plain double",
     "exact predicates are needed there", false},
    {DefectKind::coincident_nodes, "coincident_nodes", "", "nodes at the place of another",
     "merge them if cells on both sides should be neighbours", false},
    {DefectKind::unused_node, "unused_node", "", "nodes of no cell", "none needed", false},
    {DefectKind::pinched_ridge, "pinched_ridge", "", "ridges of more than two boundary facets",
     "none needed: the boundary touches itself there", false},
    {DefectKind::pinched_node, "pinched_node", "", "nodes where fans of boundary facets touch",
     "none needed: the boundary touches itself there", false},
}};

inline constexpr std::size_t defect_kind_count = defect_texts.size();

constexpr const DefectText& defect_text(DefectKind p) {
    return defect_texts[static_cast<std::size_t>(p)];
}

/// A set of problems, as a cell may have several.
using DefectSet = std::uint32_t;
constexpr DefectSet defect_bit(DefectKind p) {
    return DefectSet{1} << static_cast<unsigned>(p);
}

/// Where a problem is. Unused entries are -1.
struct DefectPlace {
    std::array<Mesh::Index, 2> cells{-1, -1};
    std::array<Mesh::Index, 3> nodes{-1, -1, -1};
    const char* detail = "";  ///< which kind, where a problem has several
};

struct Defect {
    DefectKind kind{};
    std::uint64_t count = 0;
    bool at_least = false;            ///< the search was given up after so many
    std::vector<DefectPlace> places;  ///< the first of them
};

}  // namespace barycert
