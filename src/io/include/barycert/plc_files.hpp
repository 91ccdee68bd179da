/// Piecewise linear complexes (PLCs): polygons in space that bound and cut the region to be meshed.
///
/// TetGen gets arrays: its own loaders read `010` as 8 and `1.0D+03` as 1, shift columns at a `nan`, ignore node
/// numbers and crash on truncated files. In: .poly .smesh (nodes in the file or in STEM.node); .off, .obj; .stl and
/// .ply, text or binary. Memory stays within a small multiple of the file's size. A number with which the file ends is
/// taken, and told, for more digits may have been cut. Indices in memory are 0-based.
///
/// Example:
///
///     #include "barycert/check.hpp"
///     const Plc plc = read_plc("part.poly").value();
///     const CheckReport report = check_plc(plc);
#pragma once

#include <string>
#include <vector>

#include "barycert/plc.hpp"
#include "barycert/result.hpp"

namespace barycert {

/// The paths of the files that the PLC may be in: `path`, and STEM.node beside STEM.poly or STEM.smesh.
std::vector<std::string> plc_files(const std::string& path);

/// Reads the PLC in the format of the path's extension, from files or pipes. An error names file and, of text, line.
Result<Plc> read_plc(const std::string& path);

}  // namespace barycert
