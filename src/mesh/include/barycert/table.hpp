/// Rows of results: what locators, samplers, maps and files exchange.
///
/// A row belongs to one point, or to one point and one cell that holds it. `Table` owns rows, `TableView` refers to the
/// rows of somebody else. Parts that nobody asked for are empty; all others have one entry a row.
///
/// Example:
///
///     #include "barycert/locator.hpp"
///     const Mesh mesh{.dimension = 2, .points = {0, 0, 1, 0, 0, 1}, .cells = {0, 1, 2}};
///     const Table rows = Locator::build(mesh).value().locate(std::vector<double>{0.2, 0.2, 2, 2}).value();
///     const bool inside = rows.cells[0] >= 0 && rows.features[1] == Feature::outside;
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "barycert/mesh.hpp"
#include "barycert/simplex.hpp"

namespace barycert {

// How the numbers of VTK's files are written.

enum class VtkData : std::uint8_t {
    raw,   ///< appended as they stand in memory: the fastest to write and to read
    zlib,  ///< appended in blocks, each compressed
    lz4,   ///< the same, faster and larger
    lzma,  ///< the same, slower and smaller
    ascii  ///< as text, for people: the shortest decimal form that reads back to the same bits
};

inline constexpr std::array<std::string_view, 5> vtk_data_names{"raw", "zlib", "lz4", "lzma", "ascii"};

constexpr std::string_view name(VtkData data) {
    return vtk_data_names[static_cast<std::size_t>(data)];
}

constexpr std::optional<VtkData> vtk_data_named(std::string_view name) {
    for (std::size_t i = 0; i < vtk_data_names.size(); ++i) {
        if (vtk_data_names[i] == name) return static_cast<VtkData>(i);
    }
    return std::nullopt;
}

/// How a locator found the owners of points. Points whose owners were known, and points of a grid, are not counted.
struct WayCounts {
    std::uint64_t no_cell_near = 0;  ///< outside at once: no cell is near
    std::uint64_t walk = 0;          ///< a walk ended in the owner, or at a cell that has the point on its boundary
    std::uint64_t contested = 0;     ///< a walk ended in a contested cell; the others that may overlap it were asked
    std::uint64_t candidates = 0;    ///< every cell whose box contains the point was asked

    std::uint64_t points() const { return no_cell_near + walk + contested + candidates; }
    void add(const WayCounts& other);
};

/// Rule for points with a coordinate that is NaN or infinite.
enum class NonfinitePoints : std::uint8_t {
    error,
    nan,  ///< points outside, with NaN for values whatever points outside get, and counted
};

/// Where points lie. Functions that take counts add to them, unless they fail.
struct LocationCounts {
    std::uint64_t interior = 0, face = 0, edge = 0, vertex = 0, outside = 0;
    std::uint64_t not_finite = 0;  ///< of those outside: see NonfinitePoints
    TierCounts tests;              ///< point-in-cell tests, by the tier that decided them
    WayCounts ways;

    std::uint64_t points() const { return interior + face + edge + vertex + outside; }
    std::uint64_t inside() const { return points() - outside; }
    void add(Feature f, std::uint64_t count = 1);
    void add(const LocationCounts& other);
};

/// How values were found.
struct SampleCounts {
    LocationCounts locations;
    TierCounts values;          ///< of points with point fields, by the highest tier that one of their values needed
    std::uint64_t snapped = 0;  ///< points outside that got the value of the nearest point
    std::uint64_t extrapolated = 0;
    std::uint64_t without_value = 0;  ///< points outside that got NaN, or the number to fill in
    /// Points in or beside cells with a map for which 1,200 bits do not tell how a value or a distance rounds, or for
    /// which no proof is found of which point is nearest.
    std::uint64_t undecided = 0;
    double max_off = 0;  ///< no value or distance is farther from the one rounded correctly: as a rule an ulp
    /// Points in cells with a map whose reference coordinates were not found: they have the values of the cell's parts.
    /// Extrapolated points outside have the value of the nearest point instead.
    std::uint64_t unmapped = 0;
    double farthest = 0;  ///< max distance of those snapped or extrapolated

    void add(const SampleCounts& other);
};

/// A view of rows that somebody else owns.
struct TableView {
    int dimension = 3;
    std::uint64_t first_row = 0;              ///< number of rows that came before, in a stream of blocks
    std::span<const double> points = {};      ///< `dimension` coordinates a row; empty where a grid has them
    std::span<const Mesh::Index> cells = {};  ///< 0-based; -1 outside
    std::span<const Feature> features = {};   ///< of the point in that cell
    std::span<const double> values = {};      ///< as many a row as there are columns, row after row
    std::span<const double> distances = {};   ///< from the point to the mesh: see Table
    std::span<const Column> carried = {};     ///< columns that were carried through

    std::size_t row_count() const { return cells.size(); }
};

struct Table {
    int dimension = 3;
    std::vector<double> points;        ///< `dimension` coordinates a row; empty where the caller has them
    std::vector<Mesh::Index> cells;    ///< 0-based; -1 outside
    std::vector<Feature> features;     ///< of the point in that cell
    std::vector<std::string> columns;  ///< names of the values of a row: NAME, or NAME.0, NAME.1, ...
    std::vector<double> values;        ///< columns.size() a row, row after row
    /// Distance from the point to the mesh: 0 inside, NaN where a point outside got no value. Empty unless the policy
    /// for points outside is nearest or extrapolate.
    std::vector<double> distances;
    std::vector<Column> carried;  ///< columns that were carried through: of points, or of their owners
    /// Where points have any number of rows (Locator::locate_all): the rows of point i are point_begin[i] to
    /// point_begin[i + 1] - 1. Empty where row i is for point i.
    std::vector<std::size_t> point_begin;
    SampleCounts counts;  ///< one a point

    std::size_t row_count() const { return cells.size(); }
    double value(std::size_t row, std::size_t column) const { return values[columns.size() * row + column]; }
    TableView view() const { return {dimension, 0, points, cells, features, values, distances, carried}; }
};

/// Consecutive columns of one field.
struct TableField {
    std::string name;
    int components = 1;
};

/// Returns NAME for a field of one component, else NAME.0, NAME.1, ...
std::vector<std::string> column_names(const std::vector<TableField>& fields);

/// Appends the values of the rows to the data of the fields, whose components are the columns in their order.
void append_rows(const TableView& rows, std::vector<Field>& fields);

}  // namespace barycert
