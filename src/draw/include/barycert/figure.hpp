/// Pictures for people: surfaces, lines, arrows and points in colours of values, seen by a camera, with axes, a colour
/// bar and a title, as .png, .svg or .pdf.
///
/// A surface is drawn by scene.hpp's rules. Lines are as wide everywhere, and hidden where a surface is before them.
/// Surfaces in space are lit: their colour is multiplied by 0.35 to 1; light falls from the upper left behind the
/// viewer, on both sides of a triangle (Lambert). Surfaces in the plane are drawn from above, without light, on axes of
/// one scale.
///
/// Example:
///
///     Figure figure;
///     figure.surfaces.push_back({.points = std::array{0.0, 0.0, 1.0, 0.0, 0.0, 1.0}, .triangles = std::array{0, 1,
///     2}}); write_figure("triangle.svg", figure, {}).value();
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "barycert/raster.hpp"
#include "barycert/result.hpp"
#include "barycert/scene.hpp"
#include "barycert/weights.hpp"

namespace barycert {

struct CheckReport;
struct Surface;

/// Triangles, by their points.
struct FigureSurface {
    std::span<const double> points = {};           ///< coordinates in any unit, finite: dimension of the figure each
    std::span<const std::int32_t> triangles = {};  ///< three points each
    std::span<const double> point_values = {};     ///< one a point, or ...
    std::span<const double> triangle_values = {};  ///< ... one a triangle, or neither: `colour`. NaN or infinite: none
    Rgba colour{200, 204, 208, 255};               ///< without values
};

/// Segments between points.
struct FigureLines {
    std::span<const double> points = {};
    std::span<const std::int32_t> segments = {};  ///< two points each
    double width = 1;                             ///< pixels
    Rgba colour{40, 40, 40, 255};
};

/// Arrows, which begin at points; the longest is as long as `longest`, in the unit of coordinates.
struct FigureArrows {
    std::span<const double> points = {}, vectors = {};  ///< dimension numbers each
    std::span<const double> values = {};                ///< their colours: one each, or none
    double longest = 0;
    Rgba colour{40, 40, 40, 255};
};

/// Discs that face the viewer.
struct FigurePoints {
    std::span<const double> points = {};
    std::span<const double> values = {};  ///< their colours: one each, or none. NaN or infinite: none
    double size = 6;                      ///< pixels across
    Rgba colour{40, 40, 40, 255};
};

/// Values on a grid in the plane, drawn as one pixel each; where columns and lines lie differently far apart, they are
/// repeated. The figure is as large as that and what is beside it.
struct FigureGrid {
    std::size_t width = 0, height = 0;
    std::span<const double> values = {};       ///< width * height, line after line, upwards
    std::span<const std::uint8_t> valid = {};  ///< empty, or one a value: 0 where there is none (outside)
    std::array<double, 2> origin{0, 0};        ///< where the first value is
    std::array<double, 2> spacing{1, 1};       ///< of columns and lines, above 0
};

enum class Axes : std::uint8_t { automatic, box, triad, none };

/// The direction of the camera. Its distance is computed so that the whole figure is in sight (at zoom 1).
struct FigureCamera {
    double azimuth = 30, elevation = 25;  ///< degrees, from the x axis towards y, and above the xy plane; z is upwards
    double zoom = 1;                      ///< above 1: larger than the window
    bool parallel = false;                ///< no perspective
};

/// "iso", "+x", "-x", ..., "-z": azimuth and elevation of a camera there. Nothing if it is none of these.
std::optional<std::pair<double, double>> angles_of(std::string_view view);

struct FigureOptions {
    RasterSize size{800, 600};  ///< of the whole picture; of files of vectors in 96ths of an inch
    /// The size of the window that shows a figure in the plane, without axes, bar and title. Where it is given, the
    /// figure fills the window, and the whole picture is larger.
    std::optional<RasterSize> window = {};
    double scale = 0;                     ///< pixels for a unit of the plane, in place of `window`; 0: not given
    double resolution = 1;                ///< pixels of a .png for one of `size`
    int samples = 4;                      ///< see Scene
    Rgba background{255, 255, 255, 255};  ///< where it is dark, text and axes are light; opacity 0: none
    FigureCamera camera = {};
    Axes axes = Axes::automatic;                      ///< in the plane axes, in space a triad
    std::array<std::string, 2> axis_names{"x", "y"};  ///< in the plane; "-x": its numbers are those of x, negated
    std::string title = {};

    // Colours of values.
    std::string colour_map = "viridis";                   ///< see colour_map_names
    std::optional<std::pair<double, double>> range = {};  ///< without it, the least and the greatest of the values
    bool log = false;                                     ///< by the logarithm: values above 0 alone
    bool labels = false;                                  ///< a colour of its own for each value, 12 at most
    bool bar = true;                                      ///< a colour bar to the right, if there are values
    std::string bar_title = {};                           ///< the field, its component
    std::string unit = {};                                ///< of its values
    FillMethod method = FillMethod::barycentric;
    Rounding rounding = Rounding::plain;
};

struct Figure {
    int dimension = 3;  ///< or 2: the plane
    std::vector<FigureSurface> surfaces = {};
    std::vector<FigureLines> lines = {};
    std::vector<FigureArrows> arrows = {};
    std::vector<FigurePoints> points = {};
    std::optional<FigureGrid> grid = {};  ///< with no surface, and in the plane
    FigureOptions options = {};
};

/// Counts of what became of the values of a grid.
struct GridCounts {
    std::uint64_t drawn = 0;       ///< with a colour
    std::uint64_t not_finite = 0;  ///< valid but NaN or infinite, or without a logarithm: the background
    std::uint64_t outside = 0;     ///< not valid: the background
};

struct FigureCounts {
    RasterSize size;  ///< of the whole picture: pixels of a .png, else 96ths of an inch
    RenderCounts render;
    double low = 0, high = 0;            ///< the range; NaN if there are no values and none was given
    std::uint64_t without_value = 0;     ///< triangles, arrows and discs in grey, for a value is not finite
    std::uint64_t below = 0, above = 0;  ///< values beyond the range, drawn as its ends: at corners, ...
    GridCounts grid;
};

/// matplotlib's: "viridis", "cividis", ...; with "_r" behind it the same from its other end.
std::vector<std::string_view> colour_map_names();

/// As large as it fits. Error: spans that do not fit together; an index, coordinate, angle or range that is not valid;
/// a name that is none; a size that is refused, or leaves no room beside bar and axes.
Result<Image> draw_figure(const Figure& figure, FigureCounts* counts = nullptr);

/// True for the suffixes of write_figure: .png, .svg, .pdf.
bool is_figure_name(std::string_view path);

/// In .svg and .pdf text and axes are text and lines. The rest is an image of 300 dpi; or polygons and lines, if it
/// is of surfaces and lines in the plane, with a zoom of at most 1, one colour a triangle, and fewer than 20,000
/// triangles. As .png a grid without bar, axes and title, with a resolution of 1, has its pixels alone, clear where
/// there is no value, and up to a million pixels a side, written line by line. Error: as draw_figure; the file cannot
/// be written.
Status write_figure(const std::string& path, const Figure& figure, FigureCounts* counts = nullptr);

/// The triangles of a surface or PLC from in front and from behind, grey; those with defects red. At most 256 colours.
/// Error: no triangles; indices or coordinates that cannot be drawn.
Result<Image> draw_checked(const CheckReport& report, const Surface& surface);

}  // namespace barycert
