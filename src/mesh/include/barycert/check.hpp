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
///   P5  neighbours and faces that came with the mesh (.neigh, .face) are those of its cells, and no faces came with
///       triangles; arrays of nodes and cells (fields, markers, mid-edge nodes) have the right sizes and indices.
///
/// Time: O(n log n), plus about 0.1 microseconds for each pair of boundary facets whose boxes meet: few in most meshes,
/// up to n^2 where thin cells lie side by side askew to the axes. A mesh that is not certified is also searched for
/// overlapping cells, which takes as long again or longer; CheckOptions::verdict_only skips that. A common point of two
/// cells takes ten microseconds to some milliseconds; CheckOptions::contacts limits their number.
///
/// Example:
///
///     #include <cstdio>
///     #include <string>
///     const Mesh mesh{.dimension = 2, .points = {0, 0, 1, 0, 0, 1}, .cells = {0, 1, 2}};
///     const CheckReport report = check_mesh(mesh);
///     if (!report.certified()) {
///         for (const Defect& defect : report.defects) std::puts(std::string(defect_text(defect.kind).text).c_str());
///     }
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "barycert/certificate.hpp"
#include "barycert/check_results.hpp"
#include "barycert/defect.hpp"
#include "barycert/measures.hpp"
#include "barycert/mesh.hpp"
#include "barycert/not_finite.hpp"
#include "barycert/plc.hpp"
#include "barycert/result.hpp"
#include "barycert/surface.hpp"
#include "barycert/surface_report.hpp"

namespace barycert {

struct CheckOptions {
    int threads = 0;           ///< 0: one per core
    bool delaunay = false;     ///< test every interior facet
    const Plc* plc = nullptr;  ///< test conformity to its facets (tetrahedra only)
    /// For check_plc: facets have two sides, as polygons of a surface have; neighbours turned differently are defects.
    bool turned_facets = false;
    std::size_t examples = 10;  ///< max number of places kept of each defect
    std::size_t contacts = 20;  ///< max number of pairs of cells for which a common point is computed
    /// Largest distance of nodes that nearly coincide, relative to the shortest edge of the boundary at either node; 0:
    /// none are looked for. Only boundary nodes that no cell has both of count; distances are in plain double. A node
    /// nearly hangs on an edge or a facet of the boundary by the same ratio, but at most by a sixteenth of an edge.
    double near = 1e-3;
    /// Stop at the first defect that breaks the certificate. The verdict is the same; the report then has that defect,
    /// perhaps others, the orientations, and nothing else.
    bool verdict_only = false;
    Curved curved = Curved::isoparametric;  ///< which cells count as curved: with `exact`, those off by rounding, too
    std::function<void(const char* stage)> progress = {};  ///< called as each stage begins, from the calling thread
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

    /// Numbers by which users know the cells, and notes of the mesh's reader: those of Mesh. All other members count
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
    /// Returns the defect of that kind; nullptr if there is none.
    const Defect* find(DefectKind kind) const;
};

/// Checks a mesh. The report has the verdict, defects, measures and counts.
CheckReport check_mesh(const Mesh& mesh, const CheckOptions& options = {});

/// Check a surface or a PLC. These options count: `threads`, `turned_facets`, `examples`, `contacts`, `near`,
/// `verdict_only`, `progress`. Time O(n log n), and for pairs as check_mesh.
CheckReport check_surface(const Surface& surface, const CheckOptions& options = {});
CheckReport check_plc(const Plc& plc, const CheckOptions& options = {});

}  // namespace barycert
