/// Cells fill in the points of a grid that they hold, on SIMD lanes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "barycert/sample/grid/raster_lanes.hpp"
#include "barycert/sample/points/value_lanes.hpp"
#include "barycert/table.hpp"

namespace barycert::sample {

/// In FillTarget::feature, beside the feature: the value is still to be found.
inline constexpr std::uint8_t value_missing = 0x80;
constexpr Feature without_value(Feature f) {
    return static_cast<Feature>(static_cast<std::uint8_t>(f) | value_missing);
}
constexpr bool lacks_value(Feature f) {
    return (static_cast<std::uint8_t>(f) & value_missing) != 0;
}

/// The points of some layers (2D: lines) of a grid, line after line. Each array has room for a vector more.
struct FillTarget {
    Mesh::Index* owner = nullptr;  ///< -1: none yet
    /// Of a point with an owner: outside means interior. Of others: outside.
    Feature* feature = nullptr;
    double* values = nullptr;
    std::size_t stride = 1;  ///< numbers a point in `values`, of which the first are the components of the nodes
    std::size_t columns = 0, rows = 0;
    std::int32_t first_layer = 0, last_layer = 0;
};

/// What cells fill in: the points of a grid, by the components of the nodes (at least 1). Cells are linear.
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

/// What the filter leaves open.
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

/// For points that are certainly in the interior of one of the cells: sets owner, and values, or the feature where
/// their rounding is not certain. Adds the rest to `undecided`.
void fill_cells(const FillSource& source, std::span<const locate::Place> cells, const FillTarget& target,
                UndecidedFill& undecided);

/// After the cells have filled in what they can.
struct FinishedPoints {
    LocationCounts locations;  ///< of those below
    std::uint64_t with_value = 0;
    std::uint64_t outside = 0;
    std::vector<std::uint32_t> others;  ///< those without a value, by their numbers, ascending
};

/// Points [first, last) of the target: sets features, and adds to `out`. Those outside get `*outside` for each of their
/// `stride` numbers; if that is nullptr they go to `others`.
void finish_points(const FillTarget& target, std::size_t first, std::size_t last, const double* outside,
                   FinishedPoints& out);

}  // namespace barycert::sample
