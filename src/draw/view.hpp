/// The camera of a figure, and what it sees as triangles and lines.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "barycert/figure.hpp"
#include "barycert/raster.hpp"
#include "barycert/scene.hpp"
#include "core/base/range.hpp"
#include "draw/colour_map.hpp"
#include "draw/picture.hpp"

namespace barycert::draw {

using base::Range;

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
    /// A corner of the box; bit k of the index is the side along axis k.
    Vector3 corner(unsigned i) const {
        Vector3 at;
        for (std::size_t k = 0; k < 3; ++k) at[k] = (i >> k & 1U) != 0 ? box[k].high : box[k].low;
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
    Pixel at(const Vector3& point) const { return seen(space_(point.data())); }
    /// The height of a pixel of the figure there, in the normalised unit.
    double pixel_at(const Vector3& normalised) const;
    /// The range of an axis of the plane that the window shows.
    std::array<double, 2> seen(std::size_t axis) const;
    const Space& space() const { return space_; }
    const ViewAxes& axes() const { return axes_; }

    Image draw(const ColourScale& scale, FigureCounts& counts) const;
    /// True if it can be polygons, as write_figure says.
    bool is_flat() const;
    Picture polygons(const ColourScale& scale, FigureCounts& counts) const;

private:
    Pixel seen(const Vector3& normalised) const;

    const Figure& figure_;
    RasterSize window_;
    Space space_;
    ViewAxes axes_;
    Matrix4 to_clip_;
};

}  // namespace barycert::draw
