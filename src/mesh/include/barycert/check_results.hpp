/// Results of a check: contacts of cells, the boundary, volumes, Delaunay, conformity, isoparametric maps.
///
/// Example:
///
///     #include "barycert/check.hpp"
///     const Mesh mesh{.dimension = 2, .points = {0, 0, 1, 0, 0, 1}, .cells = {0, 1, 2}};
///     const CheckReport report = check_mesh(mesh, {.delaunay = true});
///     const bool closed = report.boundary.closed && report.volume.equal;
///     const std::uint64_t not_delaunay = report.delaunay->violations;
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "barycert/mesh.hpp"

namespace barycert {

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

}  // namespace barycert
