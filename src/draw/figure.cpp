#include "barycert/figure.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "barycert/environment.hpp"
#include "barycert/raster.hpp"
#include "barycert/result.hpp"
#include "draw/colour_map.hpp"
#include "draw/figure_values.hpp"
#include "draw/files.hpp"
#include "draw/layout.hpp"
#include "draw/picture.hpp"
#include "draw/png/png_file.hpp"
#include "files/format.hpp"

namespace barycert {
namespace draw {
namespace {

/// A grid alone, in the memory of a row.
Status write_rows(const std::string& path, const Figure& figure, FigureCounts& counts) {
    const Result<ColourScale> scale = scale_of(figure, counts);
    if (!scale) return scale.error();
    const GridImage image(*figure.grid, *scale);
    if (std::max(image.width(), image.height()) > png::longest_png_side)
        return file_error("picture.too-large", path, "a grid of that aspect cannot be a picture",
                          fmt::format("at most {} pixels a side", png::longest_png_side),
                          fmt::format("{} by {}", image.width(), image.height()), "choose spacings that differ less");
    const auto row = [&](std::size_t r, std::uint8_t* pixels) { image.row(r, pixels); };
    return png::write_png_rows(path, image.width(), image.height(), row);
}

RasterSize size_of(const Picture& p, double scale) {
    const auto pixels = [&](double x) { return static_cast<std::int32_t>(std::lround(scale * x)); };
    return {pixels(p.width), pixels(p.height)};
}

Status write(const std::string& path, Figure figure, FigureCounts& counts) {
    if (!is_figure_name(path))
        return Error{.code = "file.suffix",
                     .what = "pictures have other names",
                     .expected = base::suffixes_written(base::Use::picture),
                     .found = path};
    if (Status good = check(figure); !good) return good;
    FigureOptions& o = figure.options;
    const bool pixels = base::kind_of(path) == base::FormatKind::png;
    if (pixels && figure.grid && !o.bar && o.axes == Axes::none && o.title.empty() && o.resolution == 1)
        return write_rows(path, figure, counts);
    if (!pixels) o.resolution = 300 / 96.0, o.samples = std::min(o.samples, 2);  // of more pixels
    const Result<Picture> picture = laid_out(figure, pixels ? Form::image : Form::vectors, counts);
    if (picture) counts.size = size_of(*picture, pixels ? o.resolution : 1);
    return picture ? write_picture(path, *picture, o.background, o.resolution) : Status(picture.error());
}

}  // namespace
}  // namespace draw

std::optional<std::pair<double, double>> angles_of(std::string_view view) {
    constexpr std::array<std::pair<std::string_view, std::pair<double, double>>, 7> all{
        {{"iso", {45, 35.264389682754654}},
         {"+x", {0, 0}},
         {"-x", {180, 0}},
         {"+y", {90, 0}},
         {"-y", {-90, 0}},
         {"+z", {-90, 90}},
         {"-z", {-90, -90}}}};
    for (const auto& [name, angles] : all)
        if (name == view) return angles;
    return std::nullopt;
}

Result<Image> draw_figure(const Figure& figure, FigureCounts* counts) {
    const ExactEnvironment environment;
    if (Status good = draw::check(figure); !good) return good.error();
    FigureCounts told;
    const Result<draw::Picture> picture = draw::laid_out(figure, draw::Form::image, told);
    if (!picture) return picture.error();
    told.size = draw::size_of(*picture, figure.options.resolution);
    if (counts != nullptr) *counts = told;
    return draw::drawn(*picture, figure.options.background, figure.options.resolution);
}

Status write_figure(const std::string& path, const Figure& figure, FigureCounts* counts) {
    const ExactEnvironment environment;
    FigureCounts told;
    if (const Status written = draw::write(path, figure, told); !written) {
        Error error = written.error();
        if (error.file.empty()) error.file = path;
        return error;
    }
    if (counts != nullptr) *counts = told;
    return Done{};
}

}  // namespace barycert
