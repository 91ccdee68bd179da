/// The values of a figure, and their colours.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "barycert/figure.hpp"
#include "barycert/result.hpp"
#include "draw/colour_map.hpp"

namespace barycert::draw {

/// Values of a grid as colours, row by row from the top.
class GridImage {
public:
    /// Requires: the grid is consistent.
    GridImage(const FigureGrid& grid, const ColourScale& scale);

    std::size_t width() const { return width_; }
    std::size_t height() const { return height_; }
    /// RGBA; clear where there is no value.
    void row(std::size_t r, std::uint8_t* pixels) const;

private:
    const FigureGrid& grid_;
    const ColourScale& scale_;
    std::size_t width_, height_;
};

/// True if it has a colour.
inline bool is_drawn(const FigureGrid& grid, bool log, std::size_t i) {
    return (grid.valid.empty() || grid.valid[i] != 0) && std::isfinite(grid.values[i]) && (!log || grid.values[i] > 0);
}

/// The range, or labels, of a figure's values. Counts what is beyond it.
Result<ColourScale> scale_of(const Figure& figure, FigureCounts& counts);

}  // namespace barycert::draw
