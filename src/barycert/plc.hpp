/// Piecewise linear complexes (PLCs): polygons in space that bound and cut the region to be meshed.
///
/// barycert reads PLC files itself and hands TetGen arrays: TetGen's own loaders read `010` as 8 and `1.0D+03` as 1,
/// shift columns at a `nan`, ignore node numbers and crash on truncated files.
/// In: .poly .smesh (nodes in the file or in STEM.node), .off, .stl (text or binary), .ply (text). Counts are
/// checked against the file's size, so memory stays within a small multiple of it. A number with which the file ends is
/// refused, for more digits may have been cut. Indices in memory are 0-based.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
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

    std::size_t point_count() const { return points.size() / 3; }
};

inline constexpr std::array<std::string_view, 5> plc_extensions{".poly", ".smesh", ".off", ".stl", ".ply"};

/// An error of a whole file.
inline Error file_error(std::string file, std::string what, std::string expected = {}, std::string found = {},
                        std::string remedy = {}) {
    return {std::move(what), std::move(file), 0, std::move(expected), std::move(found), std::move(remedy)};
}

/// The paths of the files that the PLC may be in: `path`, and STEM.node beside STEM.poly or STEM.smesh.
std::vector<std::string> plc_files(const std::string& path);

/// Reads the PLC in the format that the path's extension names, from regular files or pipes. An error names the file
/// and, for text, the line.
Result<Plc> read_plc(const std::string& path);

}  // namespace barycert
