/// Defects that a check may find in a mesh or surface, and which of them break the certificate.
///
/// Example:
///
///     const DefectText& text = defect_text(DefectKind::hanging_node);
///     const bool breaks = text.breaks;                          // the certificate
///     const DefectSet set = defect_bit(DefectKind::hanging_node) | defect_bit(DefectKind::crack);
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "barycert/mesh.hpp"
#include "barycert/severity.hpp"

namespace barycert {

/// Kinds of defects. defect_texts says what they are, and which break the certificate. Their numbers are the bits of
/// DefectSet.
enum class DefectKind : std::uint8_t {
    bad_structure,
    index_out_of_range,
    not_finite,
    repeated_node,
    degenerate_cell,
    duplicate_cell,
    overfull_facet,
    same_side,
    open_boundary,
    boundary_contact,
    nested_part,
    overlapping_cells,
    wrong_neighbour,
    wrong_face,
    unfit_array,
    mixed_orientation,
    plain_sign_wrong,
    coincident_nodes,
    unused_node,
    pinched_ridge,
    pinched_node,
    hanging_node,
    near_nodes,  ///< CheckOptions::near
    crack,
    missing_cell,
    near_hanging,  ///< CheckOptions::near
    // Defects of surfaces and PLCs.
    bad_facet,
    degenerate_triangle,
    duplicate_triangle,
    self_intersection,
    node_on_facet,
    segment_in_facet,
    segments_meet,
    open_edge,
    nonmanifold_edge,
    nonmanifold_node,
    misoriented_edge,
    inside_out,
    facet_off_plane,
    misplaced_point,
    folded_cell,  ///< of Mesh::shapes
    uncut_cell,   ///< of Mesh::shapes
};

struct DefectText {
    DefectKind kind;
    std::string_view name;                 ///< as in reports
    std::string_view condition;            ///< "P1" ... or "" if it does not break the certificate by itself
    std::string_view text;                 ///< what it is
    std::string_view remedy;               ///< what to do about it; empty if nothing need be done
    bool breaks;                           ///< the certificate
    std::string_view one = {}, more = {};  ///< of those that do: what it means for the verdict, after its count
};

inline constexpr std::array<DefectText, 42> defect_texts{{
    {DefectKind::bad_structure, "bad_structure", "P1", "arrays whose sizes are no whole number of nodes or cells",
     "give d coordinates per node and d + 1 vertices per cell", true, "array has a wrong size",
     "arrays have a wrong size"},
    {DefectKind::index_out_of_range, "index_out_of_range", "P1", "cells with a vertex index out of range",
     "check the index base and the node count", true, "cell has an invalid index", "cells have an invalid index"},
    {DefectKind::not_finite, "not_finite", "P1", "nodes with a NaN or infinite coordinate",
     "find where these coordinates were computed", true, "node is not finite", "nodes are not finite"},
    {DefectKind::repeated_node, "repeated_node", "P1", "cells that name a node twice",
     "check --fix drops these collapsed cells", true, "cell has a node twice", "cells have a node twice"},
    {DefectKind::degenerate_cell, "degenerate_cell", "P1", "cells with a volume of exactly zero",
     "mesh again with a quality bound, or move a node", true, "cell is degenerate", "cells are degenerate"},
    {DefectKind::duplicate_cell, "duplicate_cell", "P2", "cells with the same nodes as another",
     "check --fix keeps one of each", true, "cell is a duplicate", "cells are duplicates"},
    {DefectKind::overfull_facet, "overfull_facet", "P2", "facets that belong to more than two cells",
     "cells overlap there or are duplicates: remove them", true, "facet belongs to more than two cells",
     "facets belong to more than two cells"},
    {DefectKind::same_side, "same_side", "P2", "facets with both cells on the same side",
     "move back the node that passed through the facet", true, "facet has both cells on the same side",
     "facets have both cells on the same side"},
    {DefectKind::open_boundary, "open_boundary", "", "ridges where the boundary is not closed",
     "remove the defects above: this one follows from them", true, "ridge leaves the boundary open",
     "ridges leave the boundary open"},
    {DefectKind::boundary_contact, "boundary_contact", "P3",
     "pairs of boundary facets that meet outside common vertices and edges",
     "move the parts apart, or cut both where they cross", true, "pair of boundary facets meets",
     "pairs of boundary facets meet"},
    {DefectKind::nested_part, "nested_part", "P4", "pieces of the boundary where a cell overlaps others",
     "a part lies inside another one: remove one of them", true, "piece of the boundary lies in cells",
     "pieces of the boundary lie in cells"},
    {DefectKind::overlapping_cells, "overlapping_cells", "", "pairs of cells whose interiors meet",
     "remove the other defects: this one follows from them", true, "pair of cells overlaps", "pairs of cells overlap"},
    {DefectKind::wrong_neighbour, "wrong_neighbour", "P5", "entries of .neigh that disagree with the cells",
     "delete the .neigh file or write it again", true, "entry of .neigh is wrong", "entries of .neigh are wrong"},
    {DefectKind::wrong_face, "wrong_face", "P5", "faces in the files that are not facets of a cell",
     "delete the .face file (of Medit the section Triangles) or write it again", true,
     "face in the files is not a facet", "faces in the files are not facets"},
    {DefectKind::unfit_array, "unfit_array", "P5", "other arrays that do not fit the nodes and cells",
     "give one value per component of each node or cell, and valid node indices", true,
     "array does not fit nodes and cells", "arrays do not fit nodes and cells"},
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
     "split that cell at the node", true, "node hangs on a cell", "nodes hang on cells"},
    {DefectKind::near_nodes, "near_nodes", "", "pairs of boundary nodes that nearly coincide",
     "check --fix --merge-within DISTANCE merges them, if their cells should be neighbours", false},
    {DefectKind::crack, "crack", "", "pairs of boundary facets that merging these nodes would join", "", false},
    {DefectKind::missing_cell, "missing_cell", "", "voids that one cell would fill", "is one cell missing?", false},
    {DefectKind::near_hanging, "near_hanging", "", "nodes that nearly lie within an edge or a facet of another cell",
     "split that cell at the node, if the cells on both sides should be neighbours", false},
    {DefectKind::bad_facet, "bad_facet", "S1", "facets whose segments cross, or whose nodes fold over or lie on a line",
     "correct the polygons of the facet, or cut it into triangles", true, "facet is not simple",
     "facets are not simple"},
    {DefectKind::degenerate_triangle, "degenerate_triangle", "S1", "triangles with an area of exactly zero",
     "remove them, and split the triangle at their longest side", true, "triangle is degenerate",
     "triangles are degenerate"},
    {DefectKind::duplicate_triangle, "duplicate_triangle", "S2", "triangles with the same nodes as another",
     "keep one of each", true, "triangle is a duplicate", "triangles are duplicates"},
    {DefectKind::self_intersection, "self_intersection", "S2",
     "pairs of triangles that meet outside common nodes and edges", "move them apart, or cut both where they meet",
     true, "pair of triangles intersects", "pairs of triangles intersect"},
    {DefectKind::node_on_facet, "node_on_facet", "S2", "nodes on a segment or a facet that does not have them",
     "make the node one of its nodes", true, "node lies on a facet that does not have it",
     "nodes lie on facets that do not have them"},
    {DefectKind::segment_in_facet, "segment_in_facet", "S2", "segments inside a facet that does not have them",
     "add the segment to that facet, as a polygon of two nodes", true, "segment lies in a facet that does not have it",
     "segments lie in facets that do not have them"},
    {DefectKind::segments_meet, "segments_meet", "S2", "segments that meet other than in a common node",
     "split both at a node where they meet", true, "pair of segments meets other than in a common node",
     "pairs of segments meet other than in common nodes"},
    {DefectKind::open_edge, "open_edge", "S3", "edges of one triangle, where the surface is open", "close the surface",
     false, "edge is open", "edges are open"},
    {DefectKind::nonmanifold_edge, "nonmanifold_edge", "", "edges of more than two triangles", "", false},
    {DefectKind::nonmanifold_node, "nonmanifold_node", "", "nodes where the surface touches itself", "", false},
    {DefectKind::misoriented_edge, "misoriented_edge", "", "edges whose two triangles are turned against each other",
     "turn the triangles on one side", false},
    {DefectKind::inside_out, "inside_out", "", "closed shells whose normals point into what they enclose",
     "turn their triangles", false},
    {DefectKind::facet_off_plane, "facet_off_plane", "", "facets whose nodes do not lie exactly in one plane", "",
     false},
    {DefectKind::misplaced_point, "misplaced_point", "S3", "hole and region points on a facet, or in no closed part",
     "move the point into the part that is meant", false, "hole or region point is misplaced",
     "hole or region points are misplaced"},
    {DefectKind::folded_cell, "folded_cell", "P2",
     "cells with parts that are turned both ways: warped too far, or folded",
     "move a node of the cell, or correct the order of its nodes", true, "cell is folded", "cells are folded"},
    {DefectKind::uncut_cell, "uncut_cell", "P1", "cells that cannot be cut into simplices between their own nodes",
     "correct the order of their nodes, or split them into convex cells", true, "cell cannot be cut",
     "cells cannot be cut"},
}};

inline constexpr std::size_t defect_kind_count = defect_texts.size();

constexpr const DefectText& defect_text(DefectKind p) {
    return defect_texts[static_cast<std::size_t>(p)];
}

/// Returns error for what breaks the certificate, warning for what does not and has a remedy, note for the rest.
constexpr Severity severity(const DefectText& text) {
    if (text.breaks) return Severity::error;
    return text.remedy.empty() ? Severity::note : Severity::warning;
}

/// A set of kinds: bit i is kind i.
using DefectSet = std::uint64_t;
constexpr DefectSet defect_bit(DefectKind p) {
    return DefectSet{1} << static_cast<unsigned>(p);
}

/// Where a defect is. Unused entries are -1.
struct DefectPlace {
    std::array<Mesh::Index, 2> cells{-1, -1};
    std::array<Mesh::Index, 3> nodes{-1, -1, -1};
    const char* detail = "";  ///< which kind, where a defect has several
    /// Nodes of the facet that those meet or would join, of the edge or facet that the node lies within or nearly, and
    /// the fourth node of a missing cell.
    std::array<Mesh::Index, 3> other_nodes{-1, -1, -1};
    double distance = 0;  ///< of near nodes, or of a node from what it nearly lies within; rounded
    double relative = 0;  ///< that over the shortest edge of the boundary at these nodes
    std::optional<std::array<double, 3>> point = {};  ///< of a PLC that it is about
};

struct Defect {
    DefectKind kind{};
    std::uint64_t count = 0;
    bool at_least = false;            ///< the search stopped at that count
    std::vector<DefectPlace> places;  ///< the first of them
    std::uint64_t curved_cells = 0;   ///< with this defect: their sides were taken as straight, and may be its cause
    /// It causes others that break the certificate, although defects of its kind do not always.
    bool cause = false;
    std::string_view better_remedy = {};  ///< where the cause is known

    bool breaks() const { return cause || defect_text(kind).breaks; }
    std::string_view remedy() const { return better_remedy.empty() ? defect_text(kind).remedy : better_remedy; }
};

/// Returns the severity of a defect that was found: one of a harmless kind is an error where it causes others that
/// break the certificate.
inline Severity severity(const Defect& defect) {
    return defect.breaks() ? Severity::error : severity(defect_text(defect.kind));
}

}  // namespace barycert
