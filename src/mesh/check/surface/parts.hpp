/// A surface as it is checked: its proper triangles in the order of space, and what is found of them.
#pragma once

#include <array>
#include <vector>

#include "barycert/check_results.hpp"
#include "barycert/defect.hpp"
#include "barycert/mesh.hpp"
#include "barycert/plc.hpp"
#include "barycert/surface.hpp"
#include "barycert/surface_report.hpp"
#include "core/base/disjoint_sets.hpp"
#include "mesh/check/stages.hpp"
#include "mesh/index/cell_index.hpp"
#include "mesh/index/ridges.hpp"
#include "mesh/index/triangles.hpp"

namespace barycert::check {

/// Nodes at one place are one: that of the lowest of them.
struct SurfaceParts : CheckRun {
    const Surface& surface;
    SurfaceReport& found = *report.surface;

    Triangles triangles = {};
    std::vector<Ridge> edges = {};
    std::vector<Ridge> open = {};        ///< edges of one triangle
    std::vector<Ridge> unbalanced = {};  ///< one of each edge without as many triangles one way as the other
    std::vector<std::array<Place, 2>> pinched = {};  ///< nodes with several fans of triangles, and one of these
    bool embedded = false;                           ///< S2 holds, of those that do not break S1
    base::DisjointSets shells{0};                    ///< of places, connected over edges
    base::DisjointSets sides{0};  ///< 2 * place: where its normal points, and the other one; of one region

    std::array<Mesh::Index, 2> ends(const Ridge& edge) const {
        return {static_cast<Mesh::Index>(edge.nodes >> 32), static_cast<Mesh::Index>(edge.nodes & 0xFFFFFFFFU)};
    }
    DefectPlace place_of(const Ridge& edge) const {
        const auto [a, b] = ends(edge);
        return {.cells = {triangles.number(edge.facet), -1}, .nodes = {triangles.node(a), triangles.node(b), -1}};
    }
};

/// S1 of triangles. Finds index_out_of_range, not_finite, repeated_node, degenerate_triangle, coincident_nodes,
/// unused_node. False if nothing else can be asked.
bool check_triangles(SurfaceParts& s);

/// S2 of triangles. Finds duplicate_triangle, self_intersection and node_on_facet; returns the pairs that intersect.
std::vector<CellPair> find_intersections(SurfaceParts& s);

/// Edges and nodes. Touches nothing that find_intersections() does.
void link_triangles(SurfaceParts& s);

/// Shells and sides. Finds open_edge, nonmanifold_edge, nonmanifold_node, misoriented_edge.
void connect_triangles(SurfaceParts& s);

/// S2 of sheets, as the surface's own nodes join triangles, that have an edge at one place: where one of them comes in
/// between the triangles of another they pass through each other. Finds self_intersection; returns such pairs. What
/// lies between the triangles, and so regions, are the same.
std::vector<CellPair> find_passing_sheets(SurfaceParts& s);

/// Open edges whose ends nearly coincide. Finds near_nodes and crack.
void find_surface_cracks(SurfaceParts& s);

/// Areas and volumes of shells; if the surface is embedded, regions, and which shell lies in which, and where the seeds
/// of the PLC lie. Finds inside_out and misplaced_point.
void measure_regions(SurfaceParts& s, const Plc* plc);

/// All else of a PLC. Finds repeated_node, facet_off_plane, node_on_facet, segment_in_facet, segments_meet,
/// coincident_nodes.
void check_segments(SurfaceParts& s, const Plc& plc);

/// The intersection of two triangles, as that of cells.
CellContact common_part(const Surface& surface, const CellPair& triangles);

}  // namespace barycert::check
