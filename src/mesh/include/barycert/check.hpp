/// The mesh check: proves in exact arithmetic that the cells of a mesh partition their domain, or reports why they do
/// not.
///
/// The mesh has tetrahedra in 3-space or triangles in the plane; its indices and coordinates may be anything. Cells are
/// the simplices of their vertices: those of second order are taken with straight sides. Signs, volumes, counts,
/// contacts and the certificate are exact for every finite double; shape measures are plain double. Only
/// std::bad_alloc is thrown.
///
/// Words. d is the dimension. A facet of a cell has all its vertices but one; two facets are the same if they have the
/// same nodes. A boundary facet is a facet of exactly one cell. A ridge is the d - 1 nodes that two facets share (an
/// edge in 3D, a node in 2D). A piece of the boundary is a maximal set of boundary facets connected over ridges that
/// exactly two of them hold.
///
/// Theorem (proof: doc/theorem.md). Let a mesh satisfy
///   P1  every coordinate is finite, every vertex of every cell is a node, and no cell is degenerate;
///   P2  no facet belongs to more than two cells, and where it belongs to two these lie on opposite sides of it;
///   P3  two boundary facets meet, if at all, in a common vertex or edge of both (the same nodes);
///   P4  of each piece of the boundary, one cell at it has its interior free of all other cells.
/// Then any two cells meet in a common face of both or not at all: the cells partition the domain that is their union,
/// and the boundary facets are the boundary of that domain. The order of a cell's vertices does not matter. The domain
/// may have several parts, cavities and tunnels, and may touch itself in common vertices and edges. The conditions are
/// necessary, too, up to the choice of cells in P4: every simplicial complex is certified.
///
/// A certificate also requires
///   P5  neighbours and faces that came with the mesh (.neigh, .face) are those of its cells, and none if these are
///       triangles; arrays of nodes and cells (fields, markers, mid-edge nodes) have the right sizes and indices.
///
/// Time: O(n log n), plus about 0.1 microseconds for each pair of boundary facets whose boxes meet: few in most meshes,
/// up to n^2 where thin cells lie side by side askew to the axes. A mesh that is not certified is also searched for
/// overlapping cells, which takes as long again or longer; CheckOptions::verdict_only skips that. A common point of two
/// cells takes ten microseconds to some milliseconds; CheckOptions::contacts limits their number.
#pragma once

#include <functional>

#include "barycert/plc.hpp"
#include "barycert/surface.hpp"

namespace barycert {

struct CheckReport;
struct CheckOptions;

enum class Verdict : std::uint8_t { not_checked, not_certified, certified };

constexpr std::string_view name(Verdict v) {
    return v == Verdict::certified ? "certified" : v == Verdict::not_certified ? "not certified" : "not checked";
}

/// Made by check_mesh; a default-constructed one is `not_checked`. It identifies its mesh by a hash of coordinates,
/// cells, neighbours and faces.
class Certificate {
public:
    Certificate() = default;

    Verdict verdict() const { return verdict_; }

    /// The verdict if `mesh` is the mesh that was checked, else not_checked. Reads the whole mesh.
    Verdict verdict_on(const Mesh& mesh) const;

    /// True if `mesh` is the mesh that was checked and is certified: P1 to P5 of check.hpp hold.
    bool covers(const Mesh& mesh) const { return verdict_on(mesh) == Verdict::certified; }

private:
    friend CheckReport check_mesh(const Mesh&, const CheckOptions&);
    friend CheckReport check_surface(const Surface&, const CheckOptions&);
    friend CheckReport check_plc(const Plc&, const CheckOptions&);
    Certificate(Verdict verdict, const Mesh& mesh);
    explicit Certificate(Verdict verdict) : verdict_(verdict) {}

    Verdict verdict_ = Verdict::not_checked;
    std::uint64_t fingerprint_ = 0;
};

// The defects that a check may find in a mesh, and which of them break the certificate.

/// What they are, and which break the certificate, stands in defect_texts. Their numbers are the bits of DefectSet.
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
    // Of surfaces and PLCs.
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
    /// Of the facet that those meet or would join, of the edge or facet that the node lies within or nearly, and the
    /// fourth node of a missing cell.
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

/// Exact orientation, volume, condition and shape: one entry per cell. A cell with an index out of range or a
/// coordinate that is not finite has NaN everywhere and orientation 0.
struct CellMeasures {
    std::vector<std::int8_t> orientation;  ///< exact sign of the volume: -1, 0, 1
    std::vector<DefectSet> defects;        ///< that the cell is part of
    std::vector<double> volume;            ///< signed (2D: area), correctly rounded, in the unit of coordinates cubed
    std::vector<double> condition;         ///< of the weights, see weights.hpp; infinity if degenerate

    /// Sign of the Jacobian of each cell's isoparametric map (MapReport): -1, 1; 0 not known, 2 changes. Of a cell that
    /// has none its orientation. Empty if no cell has one.
    std::vector<std::int8_t> jacobian;

    // Shape, in plain double from correctly rounded volumes. Of a degenerate cell: infinite ratios.
    std::vector<double> radius_edge;  ///< circumradius / shortest edge; regular: 0.612 (2D: 0.577)
    std::vector<double> aspect;       ///< longest edge / inradius, scaled so that the regular simplex has 1
    std::vector<double> min_angle;    ///< smallest dihedral angle (2D: angle), degrees
    std::vector<double> max_angle;    ///< largest dihedral angle (2D: angle), degrees
};

/// Those that are numbers, under the names that files and reports have.
inline constexpr std::array<std::pair<std::string_view, std::vector<double> CellMeasures::*>, 6> cell_measures{
    {{"volume", &CellMeasures::volume},
     {"condition", &CellMeasures::condition},
     {"radius_edge", &CellMeasures::radius_edge},
     {"aspect", &CellMeasures::aspect},
     {"min_angle", &CellMeasures::min_angle},
     {"max_angle", &CellMeasures::max_angle}}};

/// Distribution of a measure over the cells where it is not NaN.
struct Distribution {
    double min = 0, median = 0, max = 0;
    std::int64_t min_cell = -1, max_cell = -1;
};

Distribution distribution(const std::vector<double>& values);

/// Measures and defects of cells as fields: orientation, those of cell_measures, and problems, a DefectSet as a number.
std::vector<Field> measure_fields(const CellMeasures& measures);

/// A point that two cells share, rounded; if `exact`, the rounded point is itself shared. `fraction`: the exact point
/// as "numerator/denominator", in lowest terms unless it has more than 4096 bits, then that of `point` if `exact`.
struct CommonPoint {
    std::array<double, 3> point{};
    bool exact = false;
    std::array<std::string, 3> fraction;
};

/// Two cells that meet where they must not.
struct CellContact {
    std::array<Mesh::Index, 2> cells{-1, -1};
    bool overlap = false;  ///< the interiors meet, and `common` is in both; else only the closed cells meet
    int dimension = 0;     ///< of their intersection: 0 a point, 1 a segment, 2 an area, 3 a volume
    CommonPoint common;
};

/// An interior facet is locally Delaunay if the apex of neither cell lies strictly inside the circumsphere of the other
/// (exact). A partition of a convex domain all of whose interior facets are so is a Delaunay triangulation (Delaunay's
/// lemma); with a boundary or facets to respect, a constrained one.
struct DelaunayReport {
    std::uint64_t facets = 0;       ///< interior facets tested: of two cells that are not degenerate
    std::uint64_t violations = 0;   ///< not locally Delaunay
    std::uint64_t cospherical = 0;  ///< locally Delaunay, and an apex lies exactly on the other cell's sphere
    /// Max of (R - distance of the apex from the centre) / R, in plain double; 0 if there is no violation.
    double worst_depth = 0;
    Mesh::Index worst_cell = -1;  ///< the cell of that sphere
    Mesh::Index worst_node = -1;  ///< the node inside it
};

struct ViolatedFacet {
    std::int64_t facet = -1;  ///< position in the PLC
    double covered = 0;       ///< area that faces of cells in its plane have in common with it, over its own
};

/// Does the mesh respect the facets of a PLC? Each is respected exactly, respected up to rounding, or violated.
struct ConformityReport {
    std::uint64_t facets = 0;  ///< of the PLC, those with an area
    std::uint64_t exact = 0, rounded = 0, violated = 0;
    std::uint64_t missing_vertices = 0;   ///< of these facets at which the mesh has no node
    double max_distance = 0;              ///< of a node from the plane of a facet respected up to rounding
    double relative_distance = 0;         ///< max_distance over the PLC's extent
    std::vector<ViolatedFacet> examples;  ///< the first violated facets
};

struct CheckOptions {
    int threads = 0;           ///< 0: one per core
    bool delaunay = false;     ///< test every interior facet
    const Plc* plc = nullptr;  ///< test conformity to its facets (tetrahedra only)
    /// Of check_plc: facets are turned, as polygons of surfaces are, and two are turned alike or not.
    bool turned_facets = false;
    std::size_t examples = 10;  ///< max number of places kept of each defect
    std::size_t contacts = 20;  ///< max number of pairs of cells for which a common point is computed
    /// Boundary nodes of no common cell nearly coincide if they lie at most this times the shortest edge of the
    /// boundary at either one apart, by distances in plain double; 0: none are looked for. Likewise a node nearly hangs
    /// on an edge or a facet of the boundary, but at most at a sixteenth of an edge.
    double near = 1e-3;
    /// Stop at the first defect that breaks the certificate. The verdict is the same; the report then has that defect,
    /// maybe others, the orientations, and nothing else.
    bool verdict_only = false;
    Curved curved = Curved::isoparametric;  ///< which cells count as curved: with `exact`, those off by rounding, too
    std::function<void(const char* stage)> progress = {};  ///< called as each stage begins, from the calling thread
};

/// The combinatorial boundary.
struct BoundaryReport {
    std::uint64_t facets = 0;
    std::uint64_t pieces = 0;
    bool closed = true;    ///< at every ridge, each boundary facet is continued by another
    bool manifold = true;  ///< every ridge in two boundary facets, every node in one fan of them
    /// Pieces that enclose a void: their signed volume is negative (2D: holes). Not counted if the boundary is open or
    /// pinched along a ridge.
    std::optional<std::uint64_t> cavities;
    /// The sum of the genus of all pieces. Not counted in 2D, or if cavities are not counted.
    std::optional<std::int64_t> tunnels;
};

/// Volumes (areas in 2D), each exact and rounded once.
struct VolumeReport {
    double cells = 0;     ///< sum of the cells' absolute volumes
    double boundary = 0;  ///< enclosed by the boundary facets
    bool equal = false;   ///< the two exact numbers are equal
};

/// Isoparametric maps: of hexahedra, voxels, wedges, pyramids, quadrilaterals and pixels (CellInterpolation), and of
/// curved simplices of order 2 to 4. One is injective near each point if its Jacobian has one sign. That is told by its
/// Bernstein coefficients, exactly, of the cell or of parts of it that are bisected up to 18 times: all have the sign
/// (proved); it has both signs at corners of the cell or of a part, or is zero at one (changing); neither (unknown).
struct MapReport {
    std::uint64_t cells = 0, positive = 0, negative = 0, changing = 0, unknown = 0;
    std::vector<Mesh::Index> examples;  ///< the first that are changing or unknown
    /// Facets of curved simplices that have a cell on both sides, and those of them that are not the same in both: a
    /// node of the facet lies elsewhere in the other cell, or the facet is curved in one alone. There cells overlap, or
    /// leave a gap. Pieces of the boundary far from each other are not compared.
    std::uint64_t curved_facets = 0, split_facets = 0;
    double max_gap = 0;                             ///< between the two places of such a node
    std::vector<std::array<Mesh::Index, 2>> split;  ///< the cells of the first
    /// Sides of hexahedra and the like whose four nodes are not in one plane, and those of them that have another
    /// surface in the cell beyond: two triangles, or the side of a cell without a map. Multilinear cells overlap there,
    /// or leave a gap.
    std::uint64_t warped_sides = 0, split_sides = 0;
    std::vector<std::array<Mesh::Index, 2>> split_at_sides;  ///< the cells of the first
};

/// A field with values that are NaN or infinite.
struct NotFinite {
    std::string field;
    bool of_cells = false;
    std::uint64_t count = 0;   ///< of such numbers
    std::uint64_t values = 0;  ///< in all; each component is one
};

/// Adds the field to `to` if it has such values, and is not there yet.
void count_not_finite(const Field& field, bool of_cells, std::vector<NotFinite>& to);

/// The fields of nodes that have such values, then those of cells.
std::vector<NotFinite> not_finite_values(const Mesh& mesh);

// Surfaces and PLCs. Two nodes at one place are one node here, as for TetGen. A surface is certified if
//   S1  every coordinate is finite, every corner is a node, no triangle is degenerate, and every facet of a PLC can be
//       cut into triangles of its nodes (read_surface);
//   S2  two triangles meet, if at all, in a common node or edge of both, and where sheets of the surface, as its nodes
//       join triangles, have an edge at one place they do not pass through each other there; no node or segment of a
//       PLC lies on a facet that does not have it;
//   S3  it is closed: each edge has two triangles or more. Of a PLC, which may have open facets inside: the facets
//       enclose a region; and each region point is in one or on a facet.
// All of it is decided exactly, from signs of orientations of nodes. Facets of a PLC whose nodes do not lie in one
// plane stand for the triangles that they are cut into; how far off they are is told.

/// A set of triangles connected over edges.
struct SurfaceShell {
    std::uint64_t triangles = 0;
    bool closed = true;            ///< each edge has two triangles or more
    std::optional<double> volume;  ///< if each edge has as many one way as the other: signed, exact and rounded once
    double area = 0;               ///< in long double: sums of square roots are not rational
    std::int64_t inside = -1;      ///< the smallest shell that encloses it; -1: none
    Mesh::Index first = -1;        ///< its lowest triangle
};

/// A bounded part of space between the triangles.
struct SurfaceRegion {
    double volume = 0;        ///< exact and rounded once, without what lies inside other shells within it
    std::int64_t shell = -1;  ///< that encloses it
    bool hole = false;        ///< a hole point of the PLC lies in it
};

/// A hole or region point of a PLC.
struct PlcSeed {
    bool hole = true;
    std::uint64_t number = 0;  ///< from 0, in the order of the file
    std::int64_t region = -1;  ///< that holds it; -1: none
    Mesh::Index facet = -1;    ///< that it lies on
};

struct SurfaceReport {
    bool plc = false;          ///< facets, segments and points
    std::uint64_t facets = 0;  ///< of the file: polygons, or facets of a PLC
    std::uint64_t edges = 0;
    std::uint64_t places = 0;  ///< of nodes with finite coordinates
    bool closed = false, manifold = false, oriented = false, outward = false;
    std::uint64_t shell_count = 0;
    std::vector<SurfaceShell> shells;    ///< the first 1000; `inside` is known if S1 and S2 hold
    std::vector<SurfaceRegion> regions;  ///< in their order in space; if S1 and S2 hold
    std::vector<PlcSeed> seeds;
    std::uint64_t off_plane = 0;    ///< facets whose nodes are not exactly in one plane
    double max_off_plane = 0;       ///< distance of a node from the plane of its facet, rounded
    double relative_off_plane = 0;  ///< that over the extent of the PLC
};

struct CheckReport {
    int dimension = 3;
    std::optional<SurfaceReport> surface;  ///< of a surface or PLC: `cells` are triangles
    std::uint64_t nodes = 0, cells = 0;
    std::uint64_t shapes = 0;  ///< of the mesh: `cells` are the simplices that they are cut into; 0: there are none
    int threads = 0;
    double seconds = 0;

    CurvedCells curved;  ///< of cells that were taken with straight sides, as far as they have others
    Certificate certificate;
    std::vector<Defect> defects;  ///< first those that break the certificate, each in the order of DefectKind

    std::uint64_t positive = 0, negative = 0, degenerate = 0;  ///< cells by exact orientation
    std::uint64_t parts = 0;                                   ///< connected over facets
    BoundaryReport boundary;
    VolumeReport volume;
    std::optional<MapReport> maps;

    CellMeasures measures;              ///< of each cell
    std::vector<CellContact> contacts;  ///< of cells that overlap or touch where they must not
    std::optional<DelaunayReport> delaunay;
    std::optional<ConformityReport> conformity;

    /// What users know the cells as, and what the reader of the mesh has told: those of Mesh. All other members count
    /// cells from 0 as in memory; reports translate.
    std::vector<Mesh::Index> cell_numbers;
    Notes notes;
    std::vector<NotFinite> not_finite;  ///< fields with values that are not finite: they break no certificate
    std::int64_t cell_number(std::int64_t cell) const {
        return cell_numbers.empty() || cell < 0 ? cell : cell_numbers[static_cast<std::size_t>(cell)];
    }
    std::array<Mesh::Index, 2> cell_number(const std::array<Mesh::Index, 2>& two) const {
        return {static_cast<Mesh::Index>(cell_number(two[0])), static_cast<Mesh::Index>(cell_number(two[1]))};
    }

    bool certified() const { return certificate.verdict() == Verdict::certified; }
    /// Null if there is no such defect.
    const Defect* find(DefectKind kind) const;
};

CheckReport check_mesh(const Mesh& mesh, const CheckOptions& options = {});

/// Takes `threads`, `turned_facets`, `examples`, `contacts`, `near`, `verdict_only`, `progress`. Time O(n log n); pairs
/// as check_mesh.
CheckReport check_surface(const Surface& surface, const CheckOptions& options = {});
CheckReport check_plc(const Plc& plc, const CheckOptions& options = {});

// What has one right answer, made so.

struct FixOptions {
    bool nodes = true;        ///< merge nodes of cells that coincide, and mid-edge nodes likewise or of one edge then
    double merge_within = 0;  ///< and those at most so far apart, chains of them included
    bool cells = true;        ///< drop cells that are degenerate or name a node twice, and all but one of duplicates
    bool orientation = true;  ///< turn negative cells
    int threads = 0;          ///< 0: one per core
};

struct MergedNode {
    Mesh::Index node = -1, into = -1;  ///< as the mesh given numbers them
    double moved = 0;                  ///< how far, rounded
};
struct DroppedCell {
    Mesh::Index cell = -1;
    DefectKind why{};  ///< repeated_node, degenerate_cell, duplicate_cell or uncut_cell
};
struct MergedField {
    std::string name;
    std::uint64_t differ = 0;   ///< nodes or cells that went, of another value than what is kept, NaN being one value
    double max_difference = 0;  ///< of finite values
};

struct FixReport {
    std::vector<MergedNode> merged;            ///< by node; those kept are the lowest
    std::vector<DroppedCell> dropped;          ///< by cell
    std::uint64_t collapsed = 0;               ///< of these, cells that merging made so
    std::uint64_t turned = 0;                  ///< cells
    std::uint64_t dropped_faces = 0;           ///< of Mesh::faces: those that no cell has any more, and twins
    std::uint64_t differing_markers = 0;       ///< merged nodes of another marker than the node that is kept
    std::vector<MergedField> fields;           ///< where values differ: those of the node that is kept stay
    std::vector<MergedField> cell_fields;      ///< likewise of duplicate cells: fields, then labels
    std::uint64_t differing_face_markers = 0;  ///< twins of another marker than the face that is kept
    /// Entries of Mesh::neighbours that were others, where no cell was dropped: else all are new.
    std::uint64_t changed_neighbours = 0;

    bool changed() const {
        return !merged.empty() || !dropped.empty() || turned != 0 || dropped_faces != 0 || changed_neighbours != 0;
    }
};

/// A repaired copy of the mesh; `report` says what was done. Merged nodes are taken out and the others numbered anew,
/// as are cells; all else stays with its node, cell or face. The last two vertices of turned cells are swapped.
/// Neighbours, if any, are computed anew if nodes or cells went. Whether the copy is a partition check_mesh tells:
/// facets at a dropped degenerate cell may be left unmatched. Errors: arrays of wrong sizes, indices out of range, a
/// distance that is negative or not finite.
Result<Mesh> fix_mesh(const Mesh& mesh, const FixOptions& options, FixReport& report);

}  // namespace barycert
