/// Is a mesh really a partition? Proved in exact arithmetic, or the reasons why not.
///
/// Enters: a Mesh of tetrahedra in 3-space or triangles in the plane, as read from a file or made in memory; its
/// indices and coordinates may be anything. Cells lie where their corners do: those of second order have straight
/// sides. Leaves: a CheckReport. What is said of it as exact (signs, volumes, counts, contacts, the certificate) is so
/// for every finite double; shape measures are plain double. Nothing prints; only want of memory throws.
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
/// overlap each other much; CheckOptions::verdict_only spares that. A witness takes some ten microseconds, and up to
/// some milliseconds where the coordinates of its two cells span the whole range of doubles; there are at most
/// CheckOptions::contacts.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "barycert/certificate.hpp"
#include "barycert/defects.hpp"
#include "barycert/mesh.hpp"
#include "barycert/plc.hpp"

namespace barycert {

/// One entry a cell. A cell that has no place in space (an index out of range, a coordinate that is not finite) has
/// NaN everywhere and orientation 0.
struct CellMeasures {
    std::vector<std::int8_t> orientation;  ///< exact sign of the volume in the order of the corners: -1, 0, 1
    std::vector<DefectSet> defects;        ///< that the cell has a part in
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
    double min = 0, median = 0, max = 0;
    std::int64_t min_cell = -1, max_cell = -1;
};

Distribution distribution(const std::vector<double>& values);

/// An exact point. `point` is it, rounded; where `exact` holds, the doubles themselves are a witness, and anybody can
/// check them with weight_signs. Else only `fraction` is: "numerator/denominator", each coordinate, in lowest terms but
/// for numbers of more than 4096 bits. Where such would be needed and `exact` holds, `fraction` is of the doubles.
struct CommonPoint {
    std::array<double, 3> point{};
    bool exact = false;
    std::array<std::string, 3> fraction;
};

struct CellContact {
    std::array<Mesh::Index, 2> cells{-1, -1};
    bool overlap = false;  ///< the interiors meet, and the witness lies in both; else the closed cells touch in it
    int dimension = 0;     ///< of what they have in common: 0 a point, 1 a segment, 2 an area, 3 a volume
    CommonPoint witness;
};

/// An interior facet is locally Delaunay if the apex of neither cell lies strictly inside the circumsphere of the other
/// (exact). A partition of a convex domain all of whose interior facets are so is a Delaunay triangulation (Delaunay's
/// lemma); with a boundary or facets to respect, a constrained one.
struct DelaunayReport {
    std::uint64_t facets = 0;       ///< interior facets tested: of two cells that are not degenerate
    std::uint64_t violations = 0;   ///< not locally Delaunay
    std::uint64_t cospherical = 0;  ///< the apex lies exactly on the sphere
    /// The worst: (R - distance of the apex from the centre) / R, in plain double; 0 if there is no violation.
    double worst_depth = 0;
    Mesh::Index worst_cell = -1;  ///< whose sphere it is
    Mesh::Index worst_node = -1;  ///< that lies inside
};

/// Conformity of a mesh to the facets of a PLC: each is respected exactly, respected up to rounding, or violated.
struct ViolatedFacet {
    std::int64_t facet = -1;  ///< position in the PLC
    double covered = 0;       ///< share of its area
};

struct ConformityReport {
    std::uint64_t facets = 0;  ///< of the PLC, with an area
    std::uint64_t exact = 0, rounded = 0, violated = 0;
    std::uint64_t missing_vertices = 0;   ///< of PLC facets, where the mesh has no node
    double largest_distance = 0;          ///< of a node from the plane of a facet respected by rounding
    double relative_distance = 0;         ///< the same over the PLC's extent
    std::vector<ViolatedFacet> examples;  ///< the first ones violated
};

struct CheckOptions {
    int threads = 0;            ///< 0: as many as the machine has
    bool delaunay = false;      ///< test every interior facet, exactly
    const Plc* plc = nullptr;   ///< test conformity to its facets; tetrahedra only
    std::size_t examples = 10;  ///< places kept of each problem
    std::size_t contacts = 20;  ///< overlapping or touching pairs for which a witness is computed
    /// Stop at the first problem that breaks the certificate: the report then has the verdict and that problem, maybe
    /// more; of measures the orientations alone, no contacts, and nothing else that came later. The verdict is the
    /// same.
    bool verdict_only = false;
    std::function<void(const char* stage)> progress = {};  ///< called as each stage begins, from the calling thread
};

/// The boundary, as it is combinatorially.
struct BoundaryReport {
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
struct VolumeReport {
    double cells = 0;     ///< sum of the cells' volumes, all taken as positive
    double boundary = 0;  ///< enclosed by the boundary facets, outward
    bool equal = false;   ///< the two exact numbers are the same
};

struct CheckReport {
    int dimension = 3;
    std::uint64_t nodes = 0, cells = 0;
    int threads = 0;
    double seconds = 0;

    Certificate certificate;
    std::vector<Defect> defects;  ///< those that occur, in the order of DefectKind: first what breaks the certificate

    std::uint64_t positive = 0, negative = 0, degenerate = 0;  ///< cells by exact orientation
    std::uint64_t parts = 0;                                   ///< sets of cells connected over facets
    BoundaryReport boundary;
    VolumeReport volume;

    CellMeasures measures;              ///< of each cell
    std::vector<CellContact> contacts;  ///< pairs that overlap or touch where they must not
    std::optional<DelaunayReport> delaunay;
    std::optional<ConformityReport> conformity;

    bool certified() const { return certificate.verdict() == Verdict::certified; }
    const Defect* find(DefectKind problem) const;
};

CheckReport check_mesh(const Mesh& mesh, const CheckOptions& options = {});

/// A copy of the mesh with the last two corners of each negative cell swapped, and with them its mid-edge nodes and its
/// neighbours; so volumes change their sign and nothing else. All else stays: points, the order of cells, fields,
/// markers, faces. `orientation`: the exact sign of each cell, as in CellMeasures; a cell of 0 stays as it is.
Mesh with_positive_cells(const Mesh& mesh, const std::vector<std::int8_t>& orientation);

}  // namespace barycert
