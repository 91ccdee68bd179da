// A surface that was checked, with its defects.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "barycert/certificate.hpp"
#include "barycert/check.hpp"
#include "barycert/defect.hpp"
#include "barycert/environment.hpp"
#include "barycert/figure.hpp"
#include "barycert/measures.hpp"
#include "barycert/raster.hpp"
#include "barycert/result.hpp"
#include "barycert/surface.hpp"

namespace barycert {

Result<Image> draw_checked(const CheckReport& report, const Surface& surface) {
    const ExactEnvironment environment;
    for (const DefectKind kind : {DefectKind::bad_structure, DefectKind::index_out_of_range, DefectKind::not_finite}) {
        if (report.find(kind) != nullptr)
            return Error{.code = "surface.defect", .what = "a surface with such defects cannot be drawn"};
    }
    const std::vector<DefectSet>& defects = report.measures.defects;
    std::vector<double> marks(surface.cell_count(), std::numeric_limits<double>::quiet_NaN());
    for (std::size_t i = 0; i < std::min(marks.size(), defects.size()); ++i) {
        if (defects[i] != 0) marks[i] = 1;
    }
    constexpr std::int32_t side = 480;
    std::array<Image, 2> views;
    std::int32_t low = side, high = 0;  // rows that have something, and a margin
    for (const bool back : {false, true}) {
        Figure figure;
        figure.surfaces.push_back({.points = surface.points, .triangles = surface.cells, .triangle_values = marks});
        FigureOptions& options = figure.options;
        options.size = {side, side};
        options.samples = 1;
        options.camera.azimuth = back ? 210 : 30;
        options.axes = Axes::none;
        options.range = {0, 1};
        options.bar = false;
        Result<Image> view = draw_figure(figure);
        if (!view) return view.error();
        for (std::int32_t k = 0; k < side * side; ++k) {
            if (view->pixel(k % side, k / side) == options.background) continue;
            low = std::min(low, std::max(k / side - 12, 0));
            high = std::max(high, std::min(k / side + 13, side));
        }
        views[back ? 1 : 0] = std::move(*view);
    }
    if (high <= low) return Error{.code = "picture.empty", .what = "there is nothing to draw"};
    Image both{2 * side, high - low,
               std::vector<std::uint8_t>(std::size_t{8} * side * static_cast<std::size_t>(high - low))};
    for (std::int32_t j = low; j < high; ++j) {
        for (std::int32_t i = 0; i < 2 * side; ++i) {
            // In 128 shades each, of grey and, where there is a colour, of red.
            auto [r, g, b, opacity] = views[static_cast<std::size_t>(i / side)].pixel(i % side, j);
            const bool grey = r == g && g == b;
            r = static_cast<std::uint8_t>(std::max({r, g, b}) | 1);
            g = b = grey ? r : static_cast<std::uint8_t>(r / 4);
            both.set_pixel(i, j - low, {r, g, b, opacity});
        }
    }
    return both;
}

}  // namespace barycert
