/// The camera of a figure, and what it sees as triangles and lines.
#pragma once

#include <cmath>

#include "barycert/draw/colour_map.hpp"
#include "barycert/figure.hpp"
#include "barycert/raster/layers.hpp"

namespace barycert::draw {

struct Range {
    double low = HUGE_VAL, high = -HUGE_VAL;

    void add(double x) {
        low = std::min(low, x);
        high = std::max(high, x);
    }
    bool empty() const { return !(low <= high); }
    double middle() const { return 0.5 * low + 0.5 * high; }
    double half() const { return 0.5 * high - 0.5 * low; }
};

/// Coordinates moved and scaled so that the middle of the box of what is drawn is the origin and its longest side 2.
struct Space {
    std::size_t dimension;
    std::array<Range, 3> box;
    double half = 1;

    explicit Space(const Figure& figure);
    Vector3 operator()(const double* point) const {
        Vector3 at{};
        // Halves, for the difference of two coordinates may be too large a number.
        for (std::size_t k = 0; k < dimension; ++k) at[k] = 2 * ((0.5 * point[k] - 0.5 * box[k].middle()) / half);
        return at;
    }
};

/// The axes of a camera: to the right and up in the picture, and towards the viewer. Unit vectors.
struct ViewAxes {
    Vector3 right, up, towards;

    explicit ViewAxes(const FigureCamera& camera);
};

/// A figure in a window of that size.
class View {
public:
    /// `part` of the window is what it may fill.
    View(const Figure& figure, RasterSize window, double part);

    /// Where a point is, from the upper left corner of the window.
    Pixel at(const Vector3& point) const;
    /// What the window shows of an axis of the plane.
    std::array<double, 2> seen(std::size_t axis) const;
    const Space& space() const { return space_; }
    const ViewAxes& axes() const { return axes_; }

    /// `extra`: more lines, between points.
    Image draw(const ColourScale& scale, std::span<const FigureLines> extra, FigureCounts& counts) const;

private:
    const Figure& figure_;
    RasterSize window_;
    Space space_;
    ViewAxes axes_;
    Matrix4 to_clip_;
};

/// Values of a grid as colours, row by row from the top.
class GridImage {
public:
    /// Precondition: the grid is consistent.
    GridImage(const FigureGrid& grid, const ColourScale& scale);

    std::size_t width() const { return width_; }
    std::size_t height() const { return height_; }
    /// RGBA; nothing is clear.
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
