/// A picture of a surface: lit, coloured by values, from a camera that fits it, with a colour bar.
///
/// Colours are those of colour_map.hpp, 256 equal parts of the range, and are looked up at each pixel with the value
/// interpolated there: no colour appears that is not in the map. Light falls from the upper left behind the viewer, on
/// both sides of a triangle alike (Lambert): the colours of the map are multiplied by 0.35 to 1.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <utility>

#include "barycert/result.hpp"
#include "barycert/scene.hpp"
#include "barycert/texture.hpp"

namespace barycert {

/// Triangles, by their points: in space, or in the plane (then they are drawn from above, without light).
struct SurfaceView {
    int dimension = 3;                             ///< 3, or 2: coordinates a point
    std::span<const double> points = {};           ///< finite, in any unit
    std::span<const std::int32_t> triangles = {};  ///< three points each
    std::span<const double> point_values = {};     ///< one a point, or ...
    std::span<const double> triangle_values = {};  ///< ... one a triangle, or neither: grey. NaN or infinite: none
};

struct ViewOptions {
    RasterSize size{800, 600};  ///< of the whole picture
    Rgba background{255, 255, 255, 255};

    /// Where the camera stands, in degrees: azimuth from the x axis towards the y axis, elevation above the xy plane.
    /// The z axis points up in the picture. Not for the plane.
    double azimuth = 30, elevation = 25;

    /// The values of the first and the last colour; without it, the least and the greatest of the values.
    std::optional<std::pair<double, double>> range = {};
    bool bar = true;  ///< a colour bar to the right, if there are values; its numbers have four digits
    FillMethod method = FillMethod::barycentric;
    Rounding rounding = Rounding::plain;
};

struct ViewCounts {
    RenderCounts render;
    double low = 0, high = 0;         ///< the range; NaN if there are no values
    std::uint64_t without_value = 0;  ///< triangles drawn in grey, for a value of theirs is not finite
};

/// Draws the surface as large as it fits. Returns an Error if spans do not fit together, an index is out of range, a
/// coordinate, angle or range is none, or the size is refused or leaves no room beside the bar.
Result<Image> draw_surface(const SurfaceView& surface, const ViewOptions& options = {}, ViewCounts* counts = nullptr);

/// The scene that draw_surface draws, without the bar.
Result<Scene> surface_scene(const SurfaceView& surface, const ViewOptions& options = {}, ViewCounts* counts = nullptr);

}  // namespace barycert
