#include "draw/figure_values.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "barycert/figure.hpp"
#include "barycert/raster.hpp"
#include "barycert/result.hpp"
#include "core/base/range.hpp"
#include "core/base/strict_math.hpp"
#include "core/base/text.hpp"
#include "draw/colour_map.hpp"

namespace barycert::draw {

GridImage::GridImage(const FigureGrid& grid, const ColourScale& scale) : grid_(grid), scale_(scale) {
    const double aspect = grid.spacing[0] / grid.spacing[1];
    constexpr double most = 1e15;  // more than a picture has
    const auto pixels = [&](double x) { return static_cast<std::size_t>(std::min(std::round(x), most)); };
    width_ = pixels(static_cast<double>(grid.width) * std::max(aspect, 1.0));
    height_ = pixels(static_cast<double>(grid.height) / std::min(aspect, 1.0));
}

void GridImage::row(std::size_t r, std::uint8_t* pixels) const {
    std::fill_n(pixels, 4 * width_, std::uint8_t{0});
    // Each shows the value whose place holds its middle.
    const std::size_t upwards = height_ - 1 - r;
    const std::size_t first = (2 * upwards + 1) * grid_.height / (2 * height_) * grid_.width;
    for (std::size_t x = 0; x < width_; ++x) {
        const std::size_t i = first + (2 * x + 1) * grid_.width / (2 * width_);
        if (!is_drawn(grid_, scale_.log, i)) continue;
        const Rgba colour = scale_(grid_.values[i]);
        std::copy_n(colour.data(), 4, pixels + 4 * x);
    }
}

Result<ColourScale> scale_of(const Figure& figure, FigureCounts& counts) {
    const FigureOptions& o = figure.options;
    ColourScale scale;
    const auto map = colour_map(o.colour_map);
    if (!map)
        return file_error("option.value", {}, "no such map of colours",
                          fmt::format("{}, perhaps with _r", fmt::join(colour_map_names(), ", ")),
                          '"' + o.colour_map + '"');
    scale.map = *map;
    scale.log = o.log;
    const auto for_values = [&](auto f) {
        for (const FigureSurface& s : figure.surfaces) {
            for (const std::int32_t i : s.triangles)
                if (!s.point_values.empty()) f(s.point_values[static_cast<std::size_t>(i)]);
            for (const double x : s.triangle_values) f(x);
        }
        for (const FigureArrows& a : figure.arrows)
            for (const double x : a.values) f(x);
        for (const FigurePoints& p : figure.points)
            for (const double x : p.values) f(x);
        for (std::size_t i = 0; figure.grid && i < figure.grid->values.size(); ++i)
            if (is_drawn(*figure.grid, false, i)) f(figure.grid->values[i]);
    };
    const auto counts_for = [&](double x) { return std::isfinite(x) && (!o.log || x > 0); };
    base::Range range;
    constexpr std::size_t most_labels = 12;
    for_values([&](double x) {
        if (!counts_for(x)) return;
        range.add(x);
        const auto at = std::ranges::lower_bound(scale.labels, x);
        if (o.labels && scale.labels.size() <= most_labels && (at == scale.labels.end() || *at != x))
            scale.labels.insert(at, x);
    });
    if (scale.labels.size() > most_labels)
        return file_error("picture.too-large", {}, "too many labels",
                          fmt::format("at most {} values that differ", most_labels), "more", "draw it without labels");
    if (o.range) range = {o.range->first, o.range->second};
    if (o.log && !range.empty() && !(range.low > 0))
        return file_error("option.value", {}, "the range of logarithmic colours", "two numbers above 0",
                          base::shortest(range.low));
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    // A zero may come with either sign: the bar says 0.
    scale.low = counts.low = range.empty() ? nan : range.low + 0.0;
    scale.high = counts.high = range.empty() ? nan : range.high + 0.0;
    for_values([&](double x) {
        if (counts_for(x) && x < scale.low) ++counts.below;
        if (counts_for(x) && x > scale.high) ++counts.above;
    });
    if (!figure.grid) return scale;
    GridCounts& of_grid = counts.grid = {};
    for (std::size_t i = 0; i < figure.grid->values.size(); ++i) {
        const bool valid = figure.grid->valid.empty() || figure.grid->valid[i] != 0;
        ++(is_drawn(*figure.grid, o.log, i) ? of_grid.drawn : valid ? of_grid.not_finite : of_grid.outside);
    }
    return scale;
}

}  // namespace barycert::draw
