/// Which cells may hold some of a few points, by one look at each cell and without an index.
///
/// A coarse grid lies over the box of the points that are in the box of the nodes (no cell holds another point); what
/// is below the box goes to bin 0 of an axis, what is above it to the last one, and what is inside to bins between, by
/// a map that is monotone whatever is rounded (bins.hpp). So the bins of a cell, from the lowest to the highest of
/// its corners, include that of every point in its box, and a cell none of whose bins holds a point holds no point.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "barycert/mesh.hpp"
#include "mesh/index/bins.hpp"
#include "mesh/index/box_tree.hpp"
#include "mesh/locate/names.hpp"

namespace barycert::locate {

/// The bins that hold points. A bin is a code: its places on the axes in one byte each, x in the lowest one.
class PointBins {
public:
    /// Requires: points with d coordinates, all finite; at least one point.
    PointBins(std::size_t d, std::span<const double> points);

    std::uint32_t code(const double* at) const {
        std::uint32_t code = 0;
        for (std::size_t k = 0; k < 3; ++k) code |= (k < d_ ? place(k, at[k]) : first) << (8 * k);
        return code;
    }

    /// Some bin from `low` to `high`, on each axis, holds a point; or there are too many bins to look at.
    bool some_in(std::uint32_t low, std::uint32_t high) const;

    /// For bins of this size (level 0), twice it (level 1), ...: a bit for each bin, x fastest, that is set if that
    /// bin, or the next one along some of the axes, holds a point. So one look suffices for a cell of at most two bins
    /// an axis.
    static constexpr std::size_t levels = 3;
    const std::int32_t* near(std::size_t level) const { return near_[level].data(); }
    int bits(std::size_t level) const { return bits_ - static_cast<int>(level); }

private:
    /// The bins before stay empty, on every level one of them, so that cells below the box of the points are not near
    /// any.
    static constexpr std::uint32_t first = 2 << (levels - 1);

    std::uint32_t place(std::size_t k, double x) const {
        if (!(x >= low_[k])) return 0;
        const std::uint32_t last = (1U << bits_) - 1;
        if (x > high_[k]) return last;
        const auto q = static_cast<std::uint64_t>(quantizer_.at(k, x));
        return first + static_cast<std::uint32_t>(q * (last - first) >> Quantizer::bits);
    }

    std::size_t d_;
    int bits_;  ///< bins on an axis: 2^bits_
    std::array<double, 3> low_ = empty_box.low, high_ = empty_box.high;
    Quantizer quantizer_;
    std::array<std::vector<std::int32_t>, levels> near_;
    std::vector<std::uint64_t> rows_;  ///< a bit for each bin, x fastest
};

/// Cells by their corners.
struct CellBlock {
    const Mesh::Index* corner;
    std::size_t count;
    std::size_t corners;                  ///< a cell: 3 or 4
    std::span<const std::int32_t> codes;  ///< bin of each node
};

/// A cell of a block and the bins that it reaches.
struct CellBins {
    std::uint32_t cell, low, high;
};

/// Every cell whose box holds one of the points, and maybe others, ascending. Nothing if there are more than `max` of
/// them, or if a corner is no node. Requires: finite points. On all threads of the arena.
std::optional<std::vector<Mesh::Index>> cells_at_points(const Mesh& mesh, std::span<const double> points,
                                                        std::size_t max);

}  // namespace barycert::locate
