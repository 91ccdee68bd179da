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
    Field field;            ///< its name and components in any case
    Column::Values labels;  ///< where has_labels: what stands in place of the field's numbers
    bool has_labels = false;
    bool is_integer = false;  ///< of 64 bits in the file
    bool is_whole = false;    ///< integers of any size in the file
    bool is_narrow = false;   ///< float32 in the file
    std::string fault;        ///< why it is neither a field nor labels; empty: it is
};

struct RawGrid {
    std::vector<double> points;              ///< 3 coordinates a point
    std::vector<std::int32_t> connectivity;  ///< nodes of all cells
    std::vector<std::int64_t> ends;          ///< where the nodes of each cell end in the connectivity
    std::vector<std::uint8_t> types;         ///< VTK's number of each cell's type
    std::vector<RawArray> point_arrays;
    std::vector<std::string> unread_arrays;  ///< of points, by name, where only points were asked for (XML)
    std::vector<RawArray> cell_arrays;
    bool narrow_points = false;                   ///< float32 in the file
    bool checked_nodes = false;                   ///< the connectivity names points that there are
    std::string global_ids;                       ///< name of the point array with them, where the file says so
    std::vector<std::string> loose_arrays;        ///< names of arrays of neither points nor cells
    bool has_steps = false;                       ///< of arrays with several time steps only the first was read
    std::vector<std::size_t> piece_points = {0};  ///< the first point of each piece of the data set
    Notes notes;                                  ///< what was left out on the way

    std::size_t point_count() const { return points.size() / 3; }
};

/// How much of a file is wanted. Texts of points, and integers of theirs that no doubles represent, are labels only
/// where there is no mesh that would have to carry them: with point_arrays.
enum class Part : std::uint8_t { points, point_arrays, all };

/// Name of the array in which write_vtu keeps point markers: 64-bit integers of one component.
inline constexpr const char* marker_name = "marker";

/// Node and cell numbers of Mesh go up to this.
inline constexpr std::uint64_t max_entities = INT32_MAX;

/// Whether an array of neither points nor cells tells the time of a step, which belongs to a series.
inline bool is_time(std::string_view name) {
    return name == "TimeValue" || name == "TIME" || name == "CYCLE";
}

inline std::string in_quotes(std::string_view name) {
    return '"' + std::string(name) + '"';
}

/// Words for a fault in the array `what`, of `count` numbers.
Error number_error(const std::string& path, std::size_t line, const std::string& what, std::uint64_t count,
                   const NumberFault& fault);

/// Why the integers of an array cannot be those of a field.
std::string inexact(const NumberFault& fault);

/// Labels that are integers which doubles represent, all of them, become the field that they would be in a file of
/// these cells alone.
void make_field_of_doubles(RawArray& array);

/// The first node that is none of `count` points; nodes.size() if there is none.
std::size_t first_wrong_node(const std::vector<std::int32_t>& nodes, std::size_t from, std::size_t count);

/// The piece behind what is there: points and cells count on. Arrays of the same name make one; one that a piece lacks
/// has a fault. Error: more points or cells than a mesh can have.
Status append_piece(RawGrid& grid, RawGrid piece, const std::string& path);

/// A file of either kind. `bytes` is all of it.
Result<RawGrid> read_legacy(std::string_view bytes, const std::string& path, Part part);

}  // namespace barycert::io
