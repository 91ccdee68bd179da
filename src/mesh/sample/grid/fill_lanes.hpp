/// Cells fill in the points of a grid that they hold, on SIMD lanes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "barycert/mesh.hpp"
#include "barycert/simplex.hpp"
#include "barycert/table.hpp"
#include "barycert/weights.hpp"
#include "mesh/index/cell_index.hpp"
#include "mesh/sample/points/value_lanes.hpp"

namespace barycert::sample {

/// The points of a grid as a raster: columns along x, rows along y (and z). 2D: z has one entry.
struct Raster {
    std::array<std::vector<double>, 3> at;  ///< coordinates of each axis, ascending
    /// Place i of an axis is near origin + i / scale, and near origin + i * spacing.
    std::array<double, 3> origin{}, scale{}, spacing{};
    /// Places (x - origin) * scale computed in double, of anything in the grid or the mesh, are off by less than half
    /// of `slack`, and so are ends of intervals along x. If that cannot be said, by whatever it takes: every
    /// point in the box of a cell is then asked for exactly.
    double slack = 0;
    bool precise = false;
};

/// Places [first, last) of an axis.
struct PlaceRange {
    std::int32_t first, last;
};

/// Points first to last - 1 of a row may be in the cell; those from inner_first to inner_last - 1 are certainly in its
/// interior. All others of the row are certainly outside.
struct Span {
    locate::Place cell;
    std::int32_t row, layer;  ///< along y and z
    std::int32_t first, inner_first, inner_last, last;
};

/// The points of some layers (2D: lines) of a grid, line after line. Each array has room for a vector more.
struct FillTarget {
    Mesh::Index* owner = nullptr;  ///< -1: none yet
    /// Feature of a point with an owner, where outside means interior; outside for a point without one.
    Feature* feature = nullptr;
    /// The value is still to be found. Set with `feature`: of no meaning before.
    std::uint8_t* value_missing = nullptr;
    double* values = nullptr;
    std::size_t stride = 1;  ///< numbers a point in `values`, of which the first are the components of the nodes
    std::size_t columns = 0, rows = 0;  ///< 2D: one row a layer
    std::int32_t first_layer = 0, last_layer = 0;

    /// Which of the lines a row is (2D: layer 0 of all rows).
    std::size_t line_of(std::int32_t row, std::int32_t layer) const {
        return static_cast<std::size_t>(layer - first_layer) * rows + static_cast<std::size_t>(row);
    }
    /// Cells may overlap: the lowest keeps a point.
    bool kept(std::size_t point, Mesh::Index cell) const { return owner[point] >= 0 && owner[point] < cell; }
    void set_feature(std::size_t point, Feature found, bool with_value) const {
        feature[point] = found;
        value_missing[point] = with_value ? 0 : 1;
    }
};

/// Data from which cells fill in the points of a grid: the components of the nodes. Cells are linear. If there are no
/// components, values are missing everywhere.
struct FillSource {
    const locate::CellIndex& index;
    const NodeValues& nodes;
    const Raster& raster;  ///< raster.precise is true
    Rounding rounding = Rounding::correct;
};

/// A point that may be in a cell or not, and what value it would have.
struct UndecidedPoint {
    locate::Place cell;
    std::int32_t column, row, layer;
    double value;
    bool certain;  ///< of the value
};

struct UndecidedFill {
    std::vector<Span> spans;             ///< with points that may be in the cell or not
    std::vector<UndecidedPoint> points;  ///< where there is one value a point
    std::vector<locate::Place> cells;    ///< of which nothing is known; they have no spans

    void clear() {
        spans.clear();
        points.clear();
        cells.clear();
    }
};

/// For points that are certainly in the interior of one of the cells: sets owner, and values, or the feature and
/// `value_missing` where their rounding is not certain. Adds the rest to `undecided`.
void fill_cells(const FillSource& source, std::span<const locate::Place> cells, const FillTarget& target,
                UndecidedFill& undecided);

/// After the cells have filled in what they can.
struct FinishedPoints {
    LocationCounts locations;  ///< of those below
    std::uint64_t with_value = 0;
    std::uint64_t outside = 0;
    std::vector<std::uint32_t> others;  ///< those without a value, by their numbers, ascending
};

/// Points [first, last) of the target: sets features, and adds to `out`. Points outside get `*outside` for each of
/// their `stride` numbers; if that is nullptr they go to `others`.
void finish_points(const FillTarget& target, std::size_t first, std::size_t last, const double* outside,
                   FinishedPoints& out);

}  // namespace barycert::sample
