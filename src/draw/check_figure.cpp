// Finds what cannot be drawn of a figure.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "barycert/figure.hpp"
#include "barycert/raster.hpp"
#include "barycert/result.hpp"
#include "barycert/scene.hpp"
#include "core/base/finite.hpp"
#include "core/base/strict_math.hpp"
#include "core/base/text.hpp"
#include "draw/layout.hpp"
#include "draw/png/png_file.hpp"

namespace barycert::draw {
namespace {

Error refusal(const std::string& what, const std::string& expected, const std::string& found) {
    return {.code = "argument.value", .what = what, .expected = expected, .found = found};
}

Status check_points(std::span<const double> points, std::size_t d, const char* of) {
    if (points.size() % d != 0)
        return refusal(fmt::format("coordinates of {}", of), std::to_string(d) + " numbers a point",
                       std::to_string(points.size()) + " numbers");
    const std::size_t i = base::first_not_finite(points);
    if (i == points.size()) return Done{};
    return refusal(fmt::format("coordinate {} of point {} of {}", i % d, i / d, of), "a finite number",
                   base::shortest(points[i]));
}

Status check_indices(std::span<const std::int32_t> indices, std::size_t each, std::size_t points, const char* of) {
    if (indices.size() % each != 0)
        return refusal(of, std::to_string(each) + " points each", std::to_string(indices.size()) + " indices");
    for (std::size_t i = 0; i < indices.size(); ++i) {
        if (indices[i] < 0 || static_cast<std::size_t>(indices[i]) >= points)
            return refusal(fmt::format("point {} of one of the {}, number {}", i % each, of, i / each),
                           "an index below " + std::to_string(points), std::to_string(indices[i]));
    }
    return Done{};
}

Status check_surface(const FigureSurface& s, std::size_t d) {
    const std::size_t points = s.points.size() / d, triangles = s.triangles.size() / 3;
    if (Status good = check_points(s.points, d, "a surface"); !good) return good;
    if (Status good = check_indices(s.triangles, 3, points, "triangles"); !good) return good;
    if ((!s.point_values.empty() && s.point_values.size() != points) ||
        (!s.triangle_values.empty() && s.triangle_values.size() != triangles) ||
        (!s.point_values.empty() && !s.triangle_values.empty()))
        return refusal("values of a surface", "one a point, or one a triangle, or none",
                       fmt::format("{} for {} points and {} for {} triangles", s.point_values.size(), points,
                                   s.triangle_values.size(), triangles));
    return Done{};
}

Status check_arrows(const FigureArrows& a, std::size_t d) {
    if (Status good = check_points(a.points, d, "arrows"); !good) return good;
    if (a.vectors.size() != a.points.size() || !base::all_finite(a.vectors) ||
        (!a.values.empty() && a.values.size() != a.points.size() / d) || !std::isfinite(a.longest) || a.longest < 0)
        return refusal("arrows", "a finite vector for each point, a value for each or none, and a length",
                       fmt::format("{} numbers for {} points", a.vectors.size(), a.points.size() / d));
    return Done{};
}

Status check_discs(const FigurePoints& p, std::size_t d) {
    constexpr std::size_t most = 5'000'000;
    if (Status good = check_points(p.points, d, "discs"); !good) return good;
    const std::size_t count = p.points.size() / d;
    if (count > most || (!p.values.empty() && p.values.size() != count) || !(p.size >= 0 && p.size <= 1000))
        return refusal("discs", fmt::format("at most {} points, a value each or none, 0 to 1000 pixels", most),
                       fmt::format("{} points, {} values, {} pixels", count, p.values.size(), p.size));
    return Done{};
}

Status check_grid(const FigureGrid& g) {
    if (g.width < 1 || g.height < 1 || std::max(g.width, g.height) > png::longest_png_side)
        return refusal("a grid of that size cannot be a picture",
                       fmt::format("1 to {} values a side", png::longest_png_side),
                       fmt::format("{} by {}", g.width, g.height));
    if (g.values.size() != g.width * g.height || (!g.valid.empty() && g.valid.size() != g.values.size()))
        return refusal("the arrays of the grid do not fit together", fmt::format("{} by {} values", g.width, g.height),
                       fmt::format("{} values and {} marks of which are valid", g.values.size(), g.valid.size()));
    for (std::size_t k = 0; k < 2; ++k) {
        if (!(g.spacing[k] > 0) || !std::isfinite(g.spacing[k]) || !std::isfinite(g.origin[k]))
            return refusal("the place of a grid", "a finite origin, and finite spacings above 0",
                           base::shortest(g.origin[k]) + " and " + base::shortest(g.spacing[k]));
    }
    return Done{};
}

}  // namespace

Status check(const Figure& f) {
    const FigureOptions& o = f.options;
    if (f.dimension != 2 && f.dimension != 3)
        return refusal("the dimension of a figure", "2 or 3", std::to_string(f.dimension));
    const auto d = static_cast<std::size_t>(f.dimension);
    for (const FigureSurface& s : f.surfaces)
        if (Status good = check_surface(s, d); !good) return good;
    for (const FigureLines& l : f.lines) {
        if (Status good = check_points(l.points, d, "lines"); !good) return good;
        if (Status good = check_indices(l.segments, 2, l.points.size() / d, "segments"); !good) return good;
        if (!(l.width >= 0 && l.width <= 1000))
            return refusal("the width of lines", "0 to 1000 pixels", base::shortest(l.width));
    }
    for (const FigureArrows& a : f.arrows)
        if (Status good = check_arrows(a, d); !good) return good;
    for (const FigurePoints& p : f.points)
        if (Status good = check_discs(p, d); !good) return good;
    if (f.grid &&
        (f.dimension != 2 || !f.surfaces.empty() || !f.lines.empty() || !f.arrows.empty() || !f.points.empty()))
        return refusal("a figure of a grid", "one in the plane, of nothing else", "more");
    if (f.grid)
        if (Status good = check_grid(*f.grid); !good) return good;
    if (Status good = check_raster_size(o.window.value_or(o.size)); !good) return good;
    if (o.samples < 1 || o.samples > max_samples)
        return refusal("samples a pixel, across and up", fmt::format("1 to {}", max_samples),
                       std::to_string(o.samples));
    if (o.background[3] != 0 && o.background[3] != 255)
        return refusal("the opacity of the background", "0 or 255", std::to_string(o.background[3]));
    const auto by_points = [](const FigureSurface& s) { return !s.point_values.empty(); };
    if (o.labels && std::ranges::any_of(f.surfaces, by_points))
        return refusal("labels", "values of triangles, which cells have", "values of points");
    if (!(o.scale >= 0) || !std::isfinite(o.scale))
        return refusal("pixels for a unit", "a finite number above 0", base::shortest(o.scale));
    if (!(o.resolution > 0 && o.resolution <= 32))
        return refusal("the resolution", "above 0, at most 32", base::shortest(o.resolution));
    for (const double angle : {o.camera.azimuth, o.camera.elevation}) {
        if (!std::isfinite(angle)) return refusal("the place of the camera", "finite angles", base::shortest(angle));
    }
    if (!(o.camera.zoom >= 0x1p-20 && o.camera.zoom <= 0x1p20))
        return refusal("the zoom of the camera", "a number from 2^-20 to 2^20", base::shortest(o.camera.zoom));
    if (o.range &&
        !(std::isfinite(o.range->first) && std::isfinite(o.range->second) && o.range->first <= o.range->second))
        return refusal("the range of colours", "two finite numbers, the lower one first",
                       base::shortest(o.range->first) + " and " + base::shortest(o.range->second));
    return Done{};
}

}  // namespace barycert::draw
