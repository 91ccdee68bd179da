/// Piecewise linear complexes (PLCs): polygons in space that bound and cut the region to be meshed.
///
/// Example:
///
///     Plc plc;
///     plc.points = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
///     for (const std::vector<std::int32_t>& ring : {std::vector{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}})
///         plc.facets.push_back({.polygons = {ring}});
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "barycert/result.hpp"

namespace barycert {

struct PlcFacet {
    std::vector<std::vector<std::int32_t>> polygons;  ///< rings of nodes; a ring of two is a segment
    std::vector<double> holes;                        ///< 3 coordinates a point inside a hole of the facet
    std::int32_t marker = 0;
};

struct Plc {
    std::vector<double> points;  ///< 3 coordinates a node
    int attribute_count = 0;
    std::vector<double> attributes;           ///< attribute_count a node
    std::vector<std::int32_t> point_markers;  ///< empty, or one a node
    std::vector<PlcFacet> facets;
    bool has_facet_markers = false;
    std::vector<double> holes;    ///< 3 coordinates a point inside a cavity
    std::vector<double> regions;  ///< 5 numbers a region: a point inside, an attribute, a largest volume
    int index_base = 0;           ///< 0 or 1: the file's own numbering
    bool nodes_apart = false;     ///< the nodes were in STEM.node
    Notes notes = {};             ///< what the file has besides, and what it does not say

    std::size_t point_count() const { return points.size() / 3; }
};

}  // namespace barycert
