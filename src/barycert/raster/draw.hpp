/// The pixels of one triangle: which of them are seen, the attributes there, colours.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "barycert/raster.hpp"
#include "barycert/scene.hpp"

namespace barycert::raster {

/// x from 0 to 255, rounded to the nearest integer, halves upwards (and with them the last double below a half).
inline std::uint8_t nearest_byte(double x) {
    constexpr double half = 0.5;
    return static_cast<std::uint8_t>(x + half);
}

/// A component of a colour from 0 to 1, in 255 steps; what lies beyond as 0 and 1. NaN gives 0.
inline std::uint8_t component_byte(double x) {
    return x >= 1 ? 255 : x > 0 ? nearest_byte(x * 255) : 0;
}

/// A triangle within the clip volume, in the window. Numbers are finite, w > 0, the area in the window is not zero.
struct WindowTriangle {
    std::array<double, 6> window;  ///< x and y of each vertex
    std::array<double, 3> z;       ///< z / w, the depth
    std::array<double, 3> w;
    std::span<const double> attributes;  ///< components numbers a vertex: the colour if there is one, u and v likewise
};

/// How triangles become colours.
struct Shading {
    bool colours = false, coordinates = false;
    const Texture* texture = nullptr;
    FillMethod method = FillMethod::barycentric;
    Interpolation interpolation = Interpolation::perspective;
    Rounding rounding = Rounding::plain;

    std::size_t components() const { return (colours ? 3U : 0U) + (coordinates ? 2U : 0U); }

    /// The colour for attributes as in WindowTriangle. NaN counts as 0.
    Rgba colour(const double* attributes) const;
};

/// What is drawn on.
struct Canvas {
    Image image;
    std::vector<double> depth;          ///< of each pixel; infinite where nothing is drawn
    PixelValues* attributes = nullptr;  ///< if they are wanted
    Shading shading;
    RenderCounts counts;
};

/// Draws the triangle where it is in front, and counts the pixels that it covers.
void draw_triangle(Canvas& canvas, const WindowTriangle& triangle);

}  // namespace barycert::raster
