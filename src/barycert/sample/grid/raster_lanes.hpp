/// Which points of a grid a cell holds, row by row, on SIMD lanes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "barycert/locate/names.hpp"

namespace barycert::sample {

/// The points of a grid as a raster: columns along x, rows along y (and z). 2D: z has one entry.
struct Raster {
    std::array<std::vector<double>, 3> at;  ///< coordinates of each axis, ascending
    /// Place i of an axis is near origin + i / scale, and near origin + i * spacing.
    std::array<double, 3> origin{}, scale{}, spacing{};
    /// Places (x - origin) * scale computed in double, of anything in the grid or the mesh, are off by less than half
    /// of `slack`, and so are ends of intervals along x. If that cannot be said, by whatever it takes: rows are then
    /// not cut short, and nothing is certain.
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

/// Appends the spans of the cells in `which`, rows in the layers [first_layer, last_layer) of z (2D: rows of y in it).
void find_spans(const locate::CellIndex& index, const Raster& raster, const locate::Place* which, std::size_t count,
                std::int32_t first_layer, std::int32_t last_layer, std::vector<Span>& out);

}  // namespace barycert::sample
