/// Results of a check of a surface or a PLC.
///
/// Two nodes at one place are one node here, as for TetGen. A surface is certified if
///   S1  every coordinate is finite, every corner is a node, no triangle is degenerate, and every facet of a PLC can be
///       cut into triangles of its nodes (read_surface);
///   S2  two triangles meet, if at all, in a common node or edge of both, and where sheets of the surface, as its nodes
///       join triangles, have an edge at one place they do not pass through each other there; no node or segment of a
///       PLC lies on a facet that does not have it;
///   S3  it is closed: each edge has two triangles or more. Of a PLC, which may have open facets inside: the facets
///       enclose a region; and each region point is in one or on a facet.
/// All of it is decided exactly, from signs of orientations of nodes. Facets of a PLC whose nodes do not lie in one
/// plane stand for the triangles that they are cut into; how far off they are is told.
///
/// Example:
///
///     #include "barycert/check.hpp"
///     const Surface surface{.points = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, .cells = {0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0,
///     3}}; const SurfaceReport report = *check_surface(surface).surface; const double volume =
///     report.shells.front().volume.value();  // 1/6
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "barycert/mesh.hpp"

namespace barycert {

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

}  // namespace barycert
