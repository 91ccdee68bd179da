/// Is a mesh really a partition? Proved in exact arithmetic, or the reasons why not.
///
/// Enters: a Mesh of tetrahedra in 3-space or triangles in the plane, as read from a file or made in memory; its
/// indices and coordinates may be anything. Cells lie where their corners do: those of second order have straight
/// sides. Leaves: a Report. What is said of it as exact (signs, volumes, counts, contacts, the certificate) is so for
/// every finite double; shape measures are plain double. Nothing prints; only want of memory throws.
///
/// Words. d is the dimension. A facet of a cell has all its corners but one, and two facets are the same if they have
/// the same nodes, wherever these lie. A facet of exactly one cell is a boundary facet. Facets are neighbours over a
/// ridge, the d - 1 nodes that two of them share (an edge in 3D, a node in 2D). A piece of the boundary is what
/// boundary facets are connected to over ridges that exactly two of them hold.
///
/// Theorem. Let a mesh satisfy
///   P1  every coordinate is finite, every corner of every cell is a node, and no cell is degenerate;
///   P2  no facet belongs to more than two cells, and where it belongs to two these lie on opposite sides of it;
///   P3  two boundary facets meet, if at all, in a common vertex or edge of both (the same nodes);
///   P4  of each piece of the boundary, one cell at it has its interior free of all other cells.
/// Then the cells are a simplicial complex: any two of them meet in a common face of both or not at all. Hence they
/// partition the domain that is their union: no overlap, no crack, and the boundary facets are the boundary of that
/// domain. Which way a cell's corners are ordered does not matter: P2 speaks of where cells lie. The domain may have
/// several parts, cavities and tunnels, and may touch itself in common vertices and edges.
///
/// Proof. For x on no facet, let m(x) be the number of cells that hold x. Walk from outside the box of the mesh, where
/// m = 0, to x, past all faces of dimension d - 2 and less, which do not separate space. Crossing a facet of two cells
/// changes nothing by P2: one is left, the other entered. Crossing a boundary facet changes m by one, as by P3 no other
/// boundary facet passes there. So m is constant on each region into which the boundary facets divide space, and
/// greater by one on the cell's side of each of them. Let two boundary facets of a piece share a ridge that no third
/// one has. Near a point inside that ridge no other boundary facet is, by P3, so the two divide a small ball into two
/// sectors, of which one has the greater m: it lies on the cell's side of both. So, from facet to facet, one region
/// lies on the cells' side all along a piece, and one on the other side. By P4 m = 1 on the former, hence m = 0 on the
/// latter. Every region but one that fills all space borders on a piece, so m <= 1 everywhere: interiors of cells are
/// disjoint. Let now x be a point of two cells c and c', in the relative interior of the face F of c, and let F be no
/// face of c'. In a small ball around x let k count, point by point, the cells that have F: k <= m, and k changes at
/// boundary facets that have F alone, by P2. If there are such, then by P3 no other boundary facet meets x; each region
/// of the ball borders on one of them, and has k = m = 1 on its cell's side, m = 0 on the other. If there are none, k
/// is constant and, as c counts, k = 1 = m in all of the ball. Either way k = m, so no point of the ball is in the
/// interior of a cell that has not F. But x is in the closed cell c', whose interior comes as near to it as one likes:
/// a contradiction. So each point that c and c' share lies in a common face, and as all they share is convex, it is one
/// common face.
///
/// Conditions are necessary, too, up to the choice of cells in P4, so a simplicial complex is certified.
/// Besides, P5: neighbours and faces that came with the mesh (.neigh, .face) are those of its cells; a mesh of
/// triangles has no faces; what belongs to nodes and cells (fields, markers, nodes at mid-edges) fits them. A
/// certificate says that P1 to P5 hold, so Locator::build takes a certified mesh.
///
/// Costs: time O(n log n) and the pairs of facets that may meet: few in most meshes, also around nodes that very many
/// cells share, but up to n^2 where thin cells lie side by side askew to the axes (candidates.hpp, about 0.1
/// microseconds a pair). No search is given up before it has found what breaks the certificate. A mesh without
/// certificate is also searched for overlapping cells, which takes as long again, and longer where boxes of cells
/// overlap each other much; Options::verdict_only spares that. A witness takes some ten microseconds, and up to some
/// milliseconds where the coordinates of its two cells span the whole range of doubles; there are at most
/// Options::contacts.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "barycert/mesh.hpp"
#include "barycert/plc.hpp"

// What may be wrong with a mesh: the names of problems, and which of them break the certificate.

namespace barycert::check {

enum class Problem : std::uint8_t {
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

struct ProblemText {
    Problem problem;
    std::string_view name;       ///< as in reports
    std::string_view condition;  ///< "P1" ... or "" if it does not break the certificate by itself
    std::string_view text;       ///< what it is, for people
    std::string_view remedy;     ///< what to do about it
    bool breaks;                 ///< the certificate
};

inline constexpr std::array<ProblemText, 21> problem_texts{{
    {Problem::bad_structure, "bad_structure", "P1", "arrays do not make whole nodes or cells",
     "give d coordinates a node, d + 1 corners a cell", true},
    {Problem::index_out_of_range, "index_out_of_range", "P1", "cells with a corner that is no node",
     "check the index base and the count of nodes", true},
    {Problem::not_finite, "not_finite", "P1", "nodes with a coordinate that is not finite",
     "find where the coordinates were made", true},
    {Problem::repeated_node, "repeated_node", "P1", "cells that have a node twice", "remove them: they were collapsed",
     true},
    {Problem::degenerate_cell, "degenerate_cell", "P1", "cells of exactly zero volume",
     "mesh again with a quality bound, or move a node", true},
    {Problem::duplicate_cell, "duplicate_cell", "P2", "cells with the same nodes as another", "remove all but one",
     true},
    {Problem::overfull_facet, "overfull_facet", "P2", "facets that belong to more than two cells",
     "cells overlap there, or were added twice", true},
    {Problem::same_side, "same_side", "P2", "facets with both cells on the same side",
     "a cell is folded over: a node went through a facet", true},
    {Problem::open_boundary, "open_boundary", "", "ridges where the boundary does not close", "follows from the above",
     true},
    {Problem::boundary_contact, "boundary_contact", "P3",
     "pairs of boundary facets that meet outside common vertices and edges",
     "merge coincident nodes, or move the parts apart", true},
    {Problem::nested_part, "nested_part", "P4", "pieces of the boundary where a cell overlaps others",
     "a part lies inside another one: remove one of them", true},
    {Problem::overlapping_cells, "overlapping_cells", "", "pairs of cells whose interiors meet",
     "see the other problems", true},
    {Problem::wrong_neighbour, "wrong_neighbour", "P5", "entries of .neigh that are not the cells' own",
     "remove the .neigh file, or write it again", true},
    {Problem::wrong_face, "wrong_face", "P5", "triangles of .face that are no facet of a cell",
     "remove the .face file, or write it again", true},
    {Problem::unfit_array, "unfit_array", "P5", "arrays besides coordinates and cells that do not fit these",
     "give one value for each component of each node or cell, and indices of nodes", true},
    {Problem::mixed_orientation, "mixed_orientation", "", "cells of the rarer orientation",
     "--fix-orientation writes a copy with all positive", false},
    {Problem::plain_sign_wrong, "plain_sign_wrong", "", "cells whose volume has a wrong sign in plain double",
     "exact predicates are needed there", false},
    {Problem::coincident_nodes, "coincident_nodes", "", "nodes at the place of another",
     "merge them if cells on both sides should be neighbours", false},
    {Problem::unused_node, "unused_node", "", "nodes of no cell", "none needed", false},
    {Problem::pinched_ridge, "pinched_ridge", "", "ridges of more than two boundary facets",
     "none needed: the boundary touches itself there", false},
    {Problem::pinched_node, "pinched_node", "", "nodes where fans of boundary facets touch",
     "none needed: the boundary touches itself there", false},
}};

inline constexpr std::size_t problem_count = problem_texts.size();

constexpr const ProblemText& text_of(Problem p) {
    return problem_texts[static_cast<std::size_t>(p)];
}

/// A set of problems, as a cell may have several.
using ProblemSet = std::uint32_t;
constexpr ProblemSet bit(Problem p) {
    return ProblemSet{1} << static_cast<unsigned>(p);
}

// What is known of a mesh, as a value that others can rely on.

struct Report;
struct Options;

enum class Verdict : std::uint8_t { not_checked, not_certified, certified };

constexpr std::string_view name(Verdict v) {
    return v == Verdict::certified ? "certified" : v == Verdict::not_certified ? "not certified" : "not checked";
}

/// Only check::run makes one that is not `not_checked`. It remembers which mesh it speaks of by a fingerprint of its
/// coordinates, cells, neighbours and faces.
class Certificate {
public:
    Certificate() = default;

    Verdict verdict() const { return verdict_; }

    /// The verdict if `mesh` is the mesh that was checked, else not_checked. Reads the whole mesh once.
    Verdict verdict_on(const Mesh& mesh) const;

    /// True if `mesh` is certified: it is the mesh that was checked, and P1 to P5 of check.hpp hold.
    bool covers(const Mesh& mesh) const { return verdict_on(mesh) == Verdict::certified; }

private:
    friend Report run(const Mesh&, const Options&);
    Certificate(Verdict verdict, const Mesh& mesh);

    Verdict verdict_ = Verdict::not_checked;
    std::uint64_t fingerprint_ = 0;
};

// Measures of cells: exact orientation, volume, shape, condition.

/// One entry a cell. A cell that has no place in space (an index out of range, a coordinate that is not finite) has
/// NaN everywhere and orientation 0.
struct Measures {
    std::vector<std::int8_t> orientation;  ///< exact sign of the volume in the order of the corners: -1, 0, 1
    std::vector<ProblemSet> problems;      ///< that the cell has a part in
    std::vector<double> volume;            ///< signed (2D: area), correctly rounded, in the unit of coordinates cubed
    std::vector<double> condition;         ///< of the weights, see condition.hpp; infinity if degenerate

    // Shape, in plain double from correctly rounded volumes. Of a degenerate cell: infinite ratios.
    std::vector<double> radius_edge;  ///< circumradius / shortest edge; regular: 0.612 (2D: 0.577)
    std::vector<double> aspect;       ///< longest edge / inradius, scaled so that the regular simplex has 1
    std::vector<double> min_angle;    ///< smallest dihedral angle (2D: angle), degrees
    std::vector<double> max_angle;    ///< largest one
};

/// Distribution of a measure over the cells where it is not NaN.
struct Distribution {
    double least = 0, median = 0, most = 0;
    std::int64_t least_cell = -1, most_cell = -1;
};

Distribution distribution(const std::vector<double>& values);

// Two cells that meet where they must not, with a point to prove it.

/// An exact point. `point` is it, rounded; where `exact` holds, the doubles themselves are a witness, and anybody can
/// check them with weight_signs. Else only `fraction` is: "numerator/denominator", each coordinate, in lowest terms but
/// for numbers of more than 4096 bits. Where such would be needed and `exact` holds, `fraction` is of the doubles.
struct Witness {
    std::array<double, 3> point{};
    bool exact = false;
    std::array<std::string, 3> fraction;
};

struct Contact {
    std::array<Mesh::Index, 2> cells{-1, -1};
    bool overlap = false;  ///< the interiors meet, and the witness lies in both; else the closed cells touch in it
    int dimension = 0;     ///< of what they have in common: 0 a point, 1 a segment, 2 an area, 3 a volume
    Witness witness;
};

// Is a mesh locally Delaunay?

/// An interior facet is locally Delaunay if the apex of neither cell lies strictly inside the circumsphere of the other
/// (exact). A partition of a convex domain all of whose interior facets are so is a Delaunay triangulation (Delaunay's
/// lemma); with a boundary or facets to respect, a constrained one.
struct Delaunay {
    std::uint64_t facets = 0;       ///< interior facets tested: of two cells that are not degenerate
    std::uint64_t violations = 0;   ///< not locally Delaunay
    std::uint64_t cospherical = 0;  ///< the apex lies exactly on the sphere
    /// The worst: (R - distance of the apex from the centre) / R, in plain double; 0 if there is no violation.
    double worst_depth = 0;
    Mesh::Index worst_cell = -1;  ///< whose sphere it is
    Mesh::Index worst_node = -1;  ///< that lies inside
};

// Is a mesh really a partition? Proved in exact arithmetic, or the reasons why not.
//
// Enters: a Mesh of tetrahedra in 3-space or triangles in the plane, as read from a file or made in memory; its
// indices and coordinates may be anything. Cells lie where their corners do: those of second order have straight
// sides. Leaves: a Report. What is said of it as exact (signs, volumes, counts, contacts, the certificate) is so for
// every finite double; shape measures are plain double. Nothing prints; only want of memory throws.
//
// Words. d is the dimension. A facet of a cell has all its corners but one, and two facets are the same if they have
// the same nodes, wherever these lie. A facet of exactly one cell is a boundary facet. Facets are neighbours over a
// ridge, the d - 1 nodes that two of them share (an edge in 3D, a node in 2D). A piece of the boundary is what
// boundary facets are connected to over ridges that exactly two of them hold.
//
// Theorem. Let a mesh satisfy
//   P1  every coordinate is finite, every corner of every cell is a node, and no cell is degenerate;
//   P2  no facet belongs to more than two cells, and where it belongs to two these lie on opposite sides of it;
//   P3  two boundary facets meet, if at all, in a common vertex or edge of both (the same nodes);
//   P4  of each piece of the boundary, one cell at it has its interior free of all other cells.
// Then the cells are a simplicial complex: any two of them meet in a common face of both or not at all. Hence they
// partition the domain that is their union: no overlap, no crack, and the boundary facets are the boundary of that
// domain. Which way a cell's corners are ordered does not matter: P2 speaks of where cells lie. The domain may have
// several parts, cavities and tunnels, and may touch itself in common vertices and edges.
//
// Proof. For x on no facet, let m(x) be the number of cells that hold x. Walk from outside the box of the mesh, where
// m = 0, to x, past all faces of dimension d - 2 and less, which do not separate space. Crossing a facet of two cells
// changes nothing by P2: one is left, the other entered. Crossing a boundary facet changes m by one, as by P3 no other
// boundary facet passes there. So m is constant on each region into which the boundary facets divide space, and
// greater by one on the cell's side of each of them. Let two boundary facets of a piece share a ridge that no third
// one has. Near a point inside that ridge no other boundary facet is, by P3, so the two divide a small ball into two
// sectors, of which one has the greater m: it lies on the cell's side of both. So, from facet to facet, one region
// lies on the cells' side all along a piece, and one on the other side. By P4 m = 1 on the former, hence m = 0 on the
// latter. Every region but one that fills all space borders on a piece, so m <= 1 everywhere: interiors of cells are
// disjoint. Let now x be a point of two cells c and c', in the relative interior of the face F of c, and let F be no
// face of c'. In a small ball around x let k count, point by point, the cells that have F: k <= m, and k changes at
// boundary facets that have F alone, by P2. If there are such, then by P3 no other boundary facet meets x; each region
// of the ball borders on one of them, and has k = m = 1 on its cell's side, m = 0 on the other. If there are none, k
// is constant and, as c counts, k = 1 = m in all of the ball. Either way k = m, so no point of the ball is in the
// interior of a cell that has not F. But x is in the closed cell c', whose interior comes as near to it as one likes:
// a contradiction. So each point that c and c' share lies in a common face, and as all they share is convex, it is one
// common face.
//
// Conditions are necessary, too, up to the choice of cells in P4, so a simplicial complex is certified.
// Besides, P5: neighbours and faces that came with the mesh (.neigh, .face) are those of its cells; a mesh of
// triangles has no faces; what belongs to nodes and cells (fields, markers, nodes at mid-edges) fits them. A
// certificate says that P1 to P5 hold, so Locator::build takes a certified mesh.
//
// Costs: time O(n log n) and the pairs of facets that may meet: few in most meshes, also around nodes that very many
// cells share, but up to n^2 where thin cells lie side by side askew to the axes (candidates.hpp, about 0.1
// microseconds a pair). No search is given up before it has found what breaks the certificate. A mesh without
// certificate is also searched for overlapping cells, which takes as long again, and longer where boxes of cells
// overlap each other much; Options::verdict_only spares that. A witness takes some ten microseconds, and up to some
// milliseconds where the coordinates of its two cells span the whole range of doubles; there are at most
// Options::contacts.

/// Conformity of a mesh to the facets of a PLC: each is respected exactly, respected up to rounding, or violated.
struct ViolatedFacet {
    std::int64_t facet = -1;  ///< position in the PLC
    double covered = 0;       ///< share of its area
};

struct Conformity {
    std::uint64_t facets = 0;  ///< of the PLC, with an area
    std::uint64_t exact = 0, rounded = 0, violated = 0;
    std::uint64_t missing_vertices = 0;   ///< of PLC facets, where the mesh has no node
    double largest_distance = 0;          ///< of a node from the plane of a facet respected by rounding
    double relative_distance = 0;         ///< the same over the PLC's extent
    std::vector<ViolatedFacet> examples;  ///< the first ones violated
};

struct Options {
    int threads = 0;            ///< 0: as many as the machine has
    bool delaunay = false;      ///< test every interior facet, exactly
    const Plc* plc = nullptr;   ///< test conformity to its facets; tetrahedra only
    std::size_t examples = 10;  ///< places kept of each problem
    std::size_t contacts = 20;  ///< overlapping or touching pairs for which a witness is computed
    /// Stop at the first problem that breaks the certificate: the report then has the verdict and that problem, maybe
    /// more; of measures the orientations alone, no contacts, and nothing else that came later. The verdict is the
    /// same.
    bool verdict_only = false;
    std::function<void(const char* stage)> progress;  ///< called as each stage begins, from the calling thread
};

/// Where a problem is. Unused entries are -1.
struct Place {
    std::array<Mesh::Index, 2> cells{-1, -1};
    std::array<Mesh::Index, 3> nodes{-1, -1, -1};
    const char* detail = "";  ///< which kind, where a problem has several
};

struct Finding {
    Problem problem{};
    std::uint64_t count = 0;
    bool at_least = false;      ///< the search was given up after so many
    std::vector<Place> places;  ///< the first of them
};

/// The boundary, as it is combinatorially.
struct Boundary {
    std::uint64_t facets = 0;
    std::uint64_t pieces = 0;
    bool closed = true;    ///< at every ridge boundary facets continue each other
    bool manifold = true;  ///< every ridge in two boundary facets, every node in one fan of them
    /// Pieces that enclose no cells: their signed volume is negative (2D: holes). Not counted where the boundary is
    /// open or pinched along a ridge, for what belongs together is not decided there.
    std::optional<std::uint64_t> cavities;
    /// Of all pieces, their genus: handles and holes through. Not counted likewise, and in 2D.
    std::optional<std::int64_t> tunnels;
};

/// Signed volumes (areas in 2D), each an exact number rounded once.
struct Volume {
    double cells = 0;     ///< sum of the cells' volumes, all taken as positive
    double boundary = 0;  ///< enclosed by the boundary facets, outward
    bool equal = false;   ///< the two exact numbers are the same
};

struct Report {
    int dimension = 3;
    std::uint64_t nodes = 0, cells = 0;
    int threads = 0;
    double seconds = 0;

    Certificate certificate;
    std::vector<Finding> findings;  ///< those that occur, in the order of Problem: first what breaks the certificate

    std::uint64_t positive = 0, negative = 0, degenerate = 0;  ///< cells by exact orientation
    std::uint64_t parts = 0;                                   ///< sets of cells connected over facets
    Boundary boundary;
    Volume volume;

    Measures measures;              ///< of each cell
    std::vector<Contact> contacts;  ///< pairs that overlap or touch where they must not
    std::optional<Delaunay> delaunay;
    std::optional<Conformity> conformity;

    bool certified() const { return certificate.verdict() == Verdict::certified; }
    const Finding* find(Problem problem) const;
};

Report run(const Mesh& mesh, const Options& options = {});

}  // namespace barycert::check
