/// The points, cells and arrays of a VTK file before anything is asked of them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "barycert/io/vtk/numbers.hpp"
#include "barycert/mesh.hpp"
#include "barycert/result.hpp"

namespace barycert::io {

struct RawArray {
    Field field;
    std::string fault;  ///< why it cannot be a field; empty: it can
};

struct RawGrid {
    std::vector<double> points;              ///< 3 coordinates a point
    std::vector<std::int32_t> connectivity;  ///< nodes of all cells
    std::vector<std::int64_t> ends;          ///< where the nodes of each cell end in the connectivity
    std::vector<std::uint8_t> types;         ///< VTK's number of each cell's type
    std::vector<RawArray> point_arrays;
    std::vector<RawArray> cell_arrays;
    std::vector<std::int64_t> point_markers;  ///< the array of write_vtu, if it is there
};

/// How much of a file is wanted.
enum class Part : bool { points, all };

/// Name of the array in which write_vtu keeps point markers: 64-bit integers of one component.
inline constexpr const char* marker_name = "marker";

/// Node and cell numbers of Mesh go up to this.
inline constexpr std::uint64_t max_entities = INT32_MAX;

inline std::string in_quotes(std::string_view name) {
    return '"' + std::string(name) + '"';
}

/// Words for a fault in the array `what`, of `count` numbers.
Error number_error(const std::string& path, std::size_t line, const std::string& what, std::uint64_t count,
                   const NumberFault& fault);

/// Why the integers of an array cannot be those of a field.
std::string inexact(const NumberFault& fault);

/// A file of either kind. `bytes` is all of it, and VTK is not asked to print.
Result<RawGrid> read_legacy(std::string_view bytes, const std::string& path, Part part);
Result<RawGrid> read_xml(std::string_view bytes, const std::string& path, Part part);

}  // namespace barycert::io
