/// The points, cells and arrays of a VTK file before anything is asked of them, and the mesh that they make.
/// Errors are thrown as Exceptions.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <iterator>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "barycert/error_codes.hpp"
#include "barycert/mesh.hpp"
#include "barycert/result.hpp"
#include "io/errors.hpp"
#include "io/in_space.hpp"
#include "io/parallel.hpp"
#include "io/vtk/numbers.hpp"
#include "mesh/cell_types.hpp"

namespace barycert::io {

using mesh::cell_types;
using mesh::CellKind;
using mesh::CellType;

/// The sections of polygon data. VTK numbers the cells of all sections in this order, whatever the order in the file.
enum Section : std::size_t { vertices, lines, polygons, strips, section_count };

/// VTK's array of flags, which say which cells or points are ghosts.
inline constexpr const char* ghost_name = "vtkGhostType";

struct RawArray {
    std::string name;
    int components = 1;
    Column::Values values = std::vector<double>();  ///< doubles are those of a field; others, one a row, are labels
    NumberType type = NumberType::float64;          ///< in the file; of pieces that differ, what holds of all
    std::string fault = {};                         ///< why it is neither a field nor labels; empty: it is

    bool has_labels() const { return !std::holds_alternative<std::vector<double>>(values); }
    /// Which cells (or points) are ghosts.
    bool is_ghost_flags() const { return name == ghost_name && fault.empty() && !has_labels() && components == 1; }
    bool is_wide_integer() const { return type == NumberType::int64 || type == NumberType::uint64; }
    /// Requires: it has no labels.
    std::vector<double>& numbers() { return std::get<std::vector<double>>(values); }
    const std::vector<double>& numbers() const { return std::get<std::vector<double>>(values); }
    std::vector<std::int64_t>* integers() { return std::get_if<std::vector<std::int64_t>>(&values); }
    /// Makes integers of doubles, which are whole, if int64 holds all of them and there is no fault.
    void make_labels();
};

struct RawCells {
    std::vector<std::int32_t> connectivity;  ///< nodes of all cells
    std::vector<std::int64_t> ends;          ///< where the nodes of each cell end in the connectivity

    std::span<const std::int32_t> nodes(std::size_t cell) const {
        const std::int64_t begin = cell == 0 ? 0 : ends[cell - 1];
        return {connectivity.data() + begin, connectivity.data() + ends[cell]};
    }
};

/// Faces of polyhedra, as of Mesh::Shapes.
struct RawFaces {
    std::vector<std::int64_t> face_ends, ring_ends;
    std::vector<std::int32_t> rings;

    /// Appends the faces of the next cell, as VTK writes them: how many, then how many nodes and these, face after
    /// face. False if the numbers do not fit, or a node is none of `points`.
    bool append(std::span<const std::int64_t> stream, std::size_t points);
    /// Behind those of `before` cells.
    void append(RawFaces more, std::size_t before, std::size_t cells, std::size_t points);
};

/// How much of a file is wanted. Texts of points, and integers of theirs that no doubles represent, are labels only
/// where there is no mesh that would have to carry them: with point_arrays.
enum class Wanted : std::uint8_t { points, point_arrays, all };

struct RawGrid;

/// The points and cells of a structured grid, the first axis running fastest.
struct StructuredGrid {
    std::array<std::size_t, 3> counts{};           ///< of points along each axis
    std::array<std::vector<double>, 3> axes = {};  ///< coordinates along them; empty where the points are given

    static constexpr std::size_t listed = 400;  ///< bytes a point, with cells: their nodes, and six parts each

    /// Says what is wrong with the number of points; empty: nothing. Few bytes describe any number: no more than memory
    /// holds, with so many bytes each.
    std::string fault(std::size_t bytes_a_point) const;
    std::string fault(Wanted part, bool along_axes) const {
        if (!along_axes || part != Wanted::all) return fault(3 * sizeof(double));
        constexpr std::size_t most = 1 << 20;
        return fault(std::max({counts[0], counts[1], counts[2]}) <= most ? 1 : listed);
    }
    std::size_t point_count() const { return counts[0] * counts[1] * counts[2]; }
    std::size_t cell_count() const;
    /// Appends points, and with Part::all cells. Cells along axes stay unlisted then.
    void append_to(RawGrid& grid, Wanted part) const;
};

struct RawGrid {
    std::vector<double> points;  ///< 3 coordinates a point
    RawCells cells;
    RawFaces faces;
    std::vector<std::uint8_t> types;         ///< VTK's number of each cell's type
    std::optional<StructuredGrid> unlisted;  ///< along axes, instead of points and cells
    std::vector<RawArray> point_arrays, cell_arrays;
    std::vector<std::string> unread_arrays;       ///< of points, by name, where only points were asked for (XML)
    bool narrow_points = false;                   ///< float32 in the file
    std::string global_ids;                       ///< name of the point array with them, where the file says so
    std::vector<std::string> loose_arrays;        ///< names of arrays of neither points nor cells
    bool has_steps = false;                       ///< of arrays with several time steps only the first was read
    std::vector<std::size_t> piece_points = {0};  ///< the first point of each piece of the data set
    Notes notes;                                  ///< what was left out on the way

    std::size_t point_count() const { return unlisted ? unlisted->point_count() : points.size() / 3; }
    std::size_t cell_count() const { return unlisted ? unlisted->cell_count() : types.size(); }
    /// Points and cells of what is unlisted. Error: they are more than memory holds.
    void list(const std::string& path);
    void list_points();

    /// The cells behind those that there are, which get the types of cells in that section, if it is given.
    void append(RawCells more, std::optional<Section> section = {});
};

/// Name of the array in which write_vtu keeps point markers: 64-bit integers of one component.
inline constexpr const char* marker_name = "marker";

/// Node and cell numbers of Mesh go up to this.
inline constexpr std::uint64_t max_entities = INT32_MAX;

/// Whether an array of neither points nor cells tells the time of a step, which belongs to a series.
inline bool is_time(std::string_view name) {
    return name == "TimeValue" || name == "TIME" || name == "CYCLE";
}

inline constexpr const char* cut_off = "write the file again: it may be cut off";

inline std::string in_quotes(std::string_view name) {
    return '"' + std::string(name) + '"';
}

/// A file in memory. Errors name the line of a place in it.
struct FileText {
    std::string_view bytes;  ///< all of it
    std::string path;
    bool has_lines = true;  ///< false: binary numbers hold line breaks by chance

    /// As refuse_line().
    template <class... Parts>
    [[noreturn]] void refuse(ErrorCode code, const char* at, Parts&&... parts) const {
        refuse_line(code, path, has_lines ? line_of(bytes, at) : 0, std::forward<Parts>(parts)...);
    }
    /// Throws what is wrong with the `count` numbers of `what`, which begin there; a number that is not exact is told
    /// in `inexact` instead, if that is given.
    void check(NumberFault fault, const char* begin, const std::string& what, std::uint64_t count,
               NumberFault* inexact) const;
};

/// Reads the numbers of an array whose name, components and type are known: as doubles or, where these are not exact,
/// as labels, if `may_label`. Markers of points are labels in any case. An array that can be neither has a fault.
/// `read`: appends all of them there, from the first on, and tells a number that is not exact.
void read_numbers(RawArray& array, bool of_points, bool may_label,
                  const std::function<void(NumbersTo values, NumberFault& inexact)>& read);

/// Whether texts are wanted of an array; if not, it gets a fault.
bool takes_texts(RawArray& array, bool may_label);

/// The first node that is none of `count` points; nodes.size() if there is none.
std::size_t first_wrong_node(const std::vector<std::int32_t>& nodes, std::size_t count);

/// Moves the entries of `from` behind those of `to`, on large pages.
template <class T>
void move_behind(std::vector<T>& to, std::vector<T>& from) {
    if (to.empty()) {
        to = std::move(from);
    } else {
        make_room(to, from.size());
        to.insert(to.end(), std::make_move_iterator(from.begin()), std::make_move_iterator(from.end()));
    }
}

/// Leaves those rows, which ascend, of all arrays without a fault.
void keep_rows(std::vector<RawArray>& arrays, const std::vector<std::int32_t>& rows);

/// The piece behind what is there: points and cells count on. Arrays of the same name make one; one that a piece lacks
/// has a fault. Error: more points or cells than a mesh can have.
void append_piece(RawGrid& grid, RawGrid piece, const std::string& path);

/// Nodes that pieces share are merged where the file gives their global numbers; else a note tells how many there are.
void join_pieces(RawGrid& grid, const std::string& path);

/// The first three lines of a file in the legacy format.
void check_legacy_head(std::string_view bytes, const std::string& path);
RawGrid read_legacy(std::string_view bytes, const std::string& path, Wanted part);

/// Makes the mesh as read_vtk promises it (cells, points, fields and notes), whatever the format. `path` is for
/// messages. `space`: as for to_points; then polygons are triangles, too. `list_grids`: see ReadOptions.
Mesh to_mesh(RawGrid grid, const std::string& path, InSpace* space = nullptr, bool list_grids = true);

/// The coordinates in that dimension, all finite. Error: one is not; or z is not 0 in dimension 2, with a remedy for
/// the file of linear triangles `triangles`, if that is not empty. `one`: of what they are. `space`: takes points that
/// are not all in that plane, of which x and y are returned.
std::vector<double> to_points(std::vector<double> points, int dimension, const std::string& path,
                              const std::string& triangles = {}, const std::string& one = "point",
                              InSpace* space = nullptr);

/// Fields of what can be one; what cannot, and what was widened, is noted. `what`: "point array".
void take_fields(std::vector<RawArray>& arrays, const std::string& what, const std::string& path,
                 std::vector<Field>& fields, std::vector<Column>* labels, Notes& notes);

void note_narrow_points(const RawGrid& grid, const std::string& path, Notes& notes);

/// "a", "b" and 3 others.
std::string list_of(const std::vector<std::string>& names);

}  // namespace barycert::io
