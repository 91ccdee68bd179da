/// Surfaces cut out of meshes: where a field has a value, where a plane goes through, the boundary; and their files.
///
/// Input: a mesh of tetrahedra (or of triangles in the plane: then segments take the place of triangles) with fields of
/// its nodes. Output: triangles with fields carried along, in the unit of the mesh.
///
/// Definition of a cut. Take the linear interpolation of a function g of the nodes: a field less a value, or d - n.x
/// for a plane n.x = d. A node is in the set if g >= 0 there, exactly. The cut is the boundary of that set within the
/// mesh: one triangle or two in every cell that has nodes inside the set and outside. Its points lie on edges of the
/// mesh between a node inside and one outside, where g is zero; where the node inside has g = 0, at that node.
///
/// Laws (each is a test of that name in tests/mesh/surface):
///   K1  Each coordinate and each value of a carried field of nodes is that of the exact crossing, from the exact
///       parameter on the edge, rounded once to nearest, ties to even; an exact zero is +0. It is NaN if a value at an
///       end of the edge is not finite. At a node it is that of the node.
///   K2  Watertight: along each edge of the surface as many triangles go one way as the other, unless the edge lies in
///       a facet that only one used cell has. A cell is used if g is finite at all of its nodes. In the plane: as many
///       segments begin at a point as end there. Requires: each facet has at most two cells, one on each side, as in a
///       certified mesh.
///   K3  Oriented as the boundary of the set: normals (right-hand rule) point out of the set, towards lower values, or
///       along n; in the plane the set is to the left of its segments. The orientation of cells has no influence. A
///       cell of zero volume takes that which fits its neighbours.
///   K4  No point twice: one for each edge that is crossed, one for each node; no triangle with the same point twice. A
///       point belongs to some triangle. (Distinct crossings may round to the same coordinates.)
///   D1  The same bytes for any number of threads. Points are in ascending order of their edges (lower node, higher
///       node), triangles in the order of their cells.
///
/// Why K2 holds. For a slightly lower value no node has g = 0, and what the cells hold fits together on their common
/// facets: each has at most one segment of the surface, the same from both of its cells, and each cell orients it the
/// other way. Letting the value rise moves some points into nodes: a simplicial map, which takes boundary to boundary.
/// Triangles of which two points fall together are nothing then, and are dropped.
/// So where the set is only a sheet (three nodes of a face have the value, both cells are below it), both sides of the
/// sheet are there; where g = 0 in whole cells, these belong to the set. A facet of the mesh's boundary in which g = 0
/// is part of the cut only if the rest of its cell is outside.
///
/// Cells of second order are cut as linear ones, by their corners: CutCounts::second_order tells how many.
///
/// Example:
///
///     Mesh mesh{.points = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, .cells = {0, 1, 2, 3}};
///     const Field height{"z", 1, {0, 0, 0, 1}};
///     const Surface level = isosurface(mesh, height, 0.5).value().surface;  // one triangle
///     const Surface all = boundary(mesh).value();                             // four
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "barycert/mesh.hpp"
#include "barycert/result.hpp"
#include "barycert/simplex.hpp"
#include "barycert/table.hpp"

namespace barycert {

/// Triangles in space, or segments in the plane.
struct Surface {
    int dimension = 3;               ///< of space, and corners a cell: 3: triangles; 2: segments
    std::vector<double> points;      ///< `dimension` coordinates a point
    std::vector<Mesh::Index> cells;  ///< `dimension` points a cell

    std::vector<Field> point_fields, cell_fields;  ///< what was carried along, or came with the file

    /// For each cell, the polygon of the file or the facet of the PLC that it is part of; ascending. Empty: each cell
    /// is one.
    std::vector<Mesh::Index> facets;
    std::size_t facet_count = 0;  ///< facets in the file, including those without cells; 0: not known
    int index_base = 0;           ///< 0 or 1: the base of the file it came from
    Notes notes;                  ///< what its reader left out, converted or guessed

    // Where it comes from; empty if it comes from no mesh.
    std::vector<Mesh::Index> mesh_cells;  ///< of each cell: the cell of the mesh that it is in
    std::vector<Mesh::Index> mesh_edges;  ///< of each point: the ends of its edge, the one in the set first; or a node,
                                          ///< twice

    std::size_t corners() const { return static_cast<std::size_t>(dimension); }
    std::size_t point_count() const { return points.size() / corners(); }
    std::size_t cell_count() const { return cells.size() / corners(); }
    /// As many as there are facets, or numbers in their place.
    std::size_t facet_total() const {
        if (facet_count != 0 || facets.empty()) return facets.empty() ? cell_count() : facet_count;
        std::size_t count = 1;
        for (std::size_t i = 1; i < facets.size(); ++i) count += facets[i] != facets[i - 1] ? 1 : 0;
        return count;
    }
    /// The number of the polygon or facet by which users know the cell.
    Mesh::Index facet(Mesh::Index cell) const {
        return facets.empty() || cell < 0 ? cell : facets[static_cast<std::size_t>(cell)];
    }
};

/// Fields that a cut carries along. They must fit the mesh.
struct CutOptions {
    std::vector<const Field*> point_fields = {};  ///< of nodes: interpolated
    std::vector<const Field*> cell_fields = {};   ///< of cells: copied
    int threads = 0;                              ///< 0: as many as the machine has
};

/// Counts of what became of the cells of the mesh, and how the points were found.
struct CutCounts {
    std::uint64_t cells = 0;         ///< that have a part of the surface
    std::uint64_t not_finite = 0;    ///< left out: with a node at which the field is NaN or infinite
    std::uint64_t degenerate = 0;    ///< of `cells`: without volume
    std::uint64_t second_order = 0;  ///< cells of the mesh that were taken for linear ones
    std::uint64_t at_nodes = 0;      ///< points that are nodes
    std::uint64_t on_edges = 0;      ///< points between nodes
    TierCounts tiers;                ///< of `on_edges`, by the highest tier that a coordinate or value needed
};

struct Cut {
    Surface surface;
    CutCounts counts;
};

/// The boundary of the set where the component of the field of nodes is at least `value`, in a mesh of tetrahedra.
/// Returns an Error if the mesh or a field is inconsistent, the mesh is one of triangles, `value` is not finite, there
/// is no such component, or there would be more than 2^31 - 1 points or triangles. It may be empty.
Result<Cut> isosurface(const Mesh& mesh, const Field& field, double value, const CutOptions& options = {},
                       int component = 0);

/// The same in a mesh of triangles: segments.
Result<Cut> isoline(const Mesh& mesh, const Field& field, double value, const CutOptions& options = {},
                    int component = 0);

/// The plane of all x with normal.x = offset.
struct Plane {
    std::array<double, 3> normal{0, 0, 1};
    double offset = 0;
};

/// The plane through the point, but for the rounding of its offset normal.point: that is rounded once.
Plane plane_through(const std::array<double, 3>& point, const std::array<double, 3>& normal);

/// The cut of a mesh of tetrahedra by the plane: the boundary of the part with normal.x <= offset. Sides of nodes are
/// exact, for the four numbers as they are. Returns an Error as isosurface, or if a number of the plane is not finite
/// or its normal is zero.
Result<Cut> slice(const Mesh& mesh, const Plane& plane, const CutOptions& options = {});

/// The facets that only one cell has, normals outwards (segments: the mesh to their left), in ascending order of cells;
/// points are the nodes they use, in ascending order. Carries fields of nodes and cells. A facet with more than two
/// cells is not part of it; one of a cell of zero volume is turned as that cell's corners say. Returns an Error if the
/// mesh or a field is inconsistent.
Result<Surface> boundary(const Mesh& mesh, const CutOptions& options = {});

// Files: .vtp (VTK's XML, for ParaView), .ply (binary), .off (text), by the suffix. Every number reads back to the same
// bits.

/// Changes that a file's format required.
struct SurfaceFile {
    std::vector<std::string> left_out;  ///< names of fields, in the order of the surface
    std::vector<std::string> renamed;   ///< names in the file that differ, as "NAME as OTHER"
};

/// Returns an Error if the suffix is another one, the surface is inconsistent, the format cannot hold it (.off holds
/// triangles only) or the file cannot be written. The file appears whole or not at all. `data`: of a .vtp file.
Result<SurfaceFile> write_surface(const Surface& surface, const std::string& path, VtkData data = VtkData::raw);

}  // namespace barycert
