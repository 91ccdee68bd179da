// Layout: the window with what the camera sees, axes, the colour bar, the title.
#include "barycert/figure.hpp"

#include <algorithm>
#include <cmath>

#include "barycert/base/finite.hpp"
#include "barycert/base/strict_math.hpp"
#include "barycert/base/text.hpp"
#include "barycert/draw/axes.hpp"
#include "barycert/draw/files.hpp"
#include "barycert/draw/view.hpp"
#include "barycert/environment.hpp"
#include "barycert/io/formats.hpp"
#include "barycert/io/png/png_file.hpp"

namespace barycert {
namespace draw {
namespace {

Error refusal(const std::string& what, const std::string& expected, const std::string& found) {
    return {.what = what, .expected = expected, .found = found};
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

Status check_grid(const FigureGrid& g) {
    if (g.width < 1 || g.height < 1 || std::max(g.width, g.height) > io::longest_png_side)
        return refusal("a grid of that size cannot be a picture",
                       fmt::format("1 to {} values a side", io::longest_png_side),
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
    if (f.grid && (f.dimension != 2 || !f.surfaces.empty() || !f.lines.empty() || !f.arrows.empty()))
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

/// Of the window that a figure may fill; beside a box its numbers have room.
double part_of(const Figure& f) {
    if (f.dimension == 2 && (f.options.window || f.options.scale > 0)) return 1;
    if (f.options.axes == Axes::box && f.dimension == 3) return 0.76;
    return f.dimension == 2 && f.options.axes != Axes::none ? 0.97 : 0.94;
}

Ground ground_of(const FigureOptions& o) {
    const auto& [r, g, b, opacity] = o.background;
    constexpr int half = 128 * 1000;
    return {o.background, opacity != 0 && 299 * r + 587 * g + 114 * b < half};
}

Rgba ink(const FigureOptions& o) {
    return look_of("axis", ground_of(o).dark).colour;
}

class Layout {
public:
    Layout(const Figure& figure, double resolution, FigureCounts& counts)
        : f_(figure),
          o_(figure.options),
          picture_(o_.size.width, o_.size.height, o_.title.empty() ? "a mesh" : o_.title),
          resolution_(resolution),
          counts_(counts) {}

    Result<Picture> run() {
        Result<ColourScale> scale = scale_of(f_, counts_);
        if (!scale) return scale.error();
        const bool plane = f_.dimension == 2 && o_.axes != Axes::none;
        double left = plane ? 68 : 0, right = plane ? 16 : 0, top = plane ? 16 : 0, bottom = plane ? 54 : 0;
        if (!o_.title.empty()) top += 34;
        ColourBar bar{.scale = *scale,
                      .title = o_.unit.empty() ? o_.bar_title : o_.bar_title + " (" + o_.unit + ")",
                      .below = counts_.below != 0,
                      .above = counts_.above != 0};
        const bool with_bar = o_.bar && !std::isnan(scale->low);
        bar.none = with_bar && has_none();
        if (with_bar) right = std::max(right, bar.width());
        std::optional<GridImage> grid;
        if (f_.grid) grid.emplace(*f_.grid, *scale);
        if (grid && std::max(grid->width(), grid->height()) > static_cast<std::size_t>(max_raster_side))
            return file_error({}, "a grid of that size cannot be a picture on axes or beside a bar",
                              fmt::format("at most {} pixels a side", max_raster_side),
                              fmt::format("{} by {}", grid->width(), grid->height()),
                              "draw it without axes, bar and title");
        least_tall_ = with_bar ? bar.least_height() : 0;
        if (grid) window_of({grid->width(), grid->height()}, left + right, top + bottom);
        if (const auto given = given_window(); !grid && given)
            window_of({static_cast<std::size_t>(given->width), static_cast<std::size_t>(given->height)}, left + right,
                      top + bottom);
        double wide = picture_.width - left - right, tall = picture_.height - top - bottom;
        constexpr double least = 16;
        if (!window_ && (wide < least || tall < std::max(least, least_tall_)))
            return file_error({}, "there is no room beside bar and axes",
                              fmt::format("more than {:.0f} by {:.0f} pixels", left + right + least,
                                          top + bottom + std::max(least, least_tall_)),
                              fmt::format("{} by {}", o_.size.width, o_.size.height), "choose a larger size");
        const double bar_top = top, bar_room = tall;
        if (window_) wide = window_->width, tall = window_->height;
        // Whole pixels of the file.
        const auto pixels = [&](double x) { return static_cast<std::int32_t>(std::lround(x * resolution_)); };
        const double x0 = std::round(left * resolution_) / resolution_,
                     y0 = std::round(top * resolution_) / resolution_;
        origin_ = {x0, y0};
        if (grid) {
            Result<Image> image = blank_image(window_->width, window_->height, {});
            if (!image) return image.error();
            for (std::int32_t j = 0; j < image->height; ++j)
                grid->row(static_cast<std::size_t>(image->height - 1 - j), &image->data[image->offset(0, j)]);
            picture_.place({x0, y0}, wide, tall, std::make_shared<Image>(std::move(*image)), "pixels");
            if (plane) draw_plane_axes(grid_ends(), {x0, y0}, {x0 + wide, y0 + tall});
        } else {
            const RasterSize window{std::max(1, pixels(wide)), std::max(1, pixels(tall))};
            if (Status good = check_raster_size(window); !good) return good.error();
            if (std::int64_t{window.width} * window.height > max_image_pixels)
                return file_error({}, "the picture is too large", fmt::format("at most {} pixels", max_image_pixels),
                                  fmt::format("{} by {}", window.width, window.height), "choose a smaller size");
            const View view(f_, window, part_of(f_));
            std::vector<FigureLines> extra;
            if (f_.dimension == 3 && o_.axes == Axes::box) extra.push_back(box_lines(view));
            auto image = std::make_shared<Image>(view.draw(*scale, extra, counts_));
            picture_.place({x0, y0}, window.width / resolution_, window.height / resolution_, std::move(image));
            if (plane) draw_plane_axes({view.seen(0), view.seen(1)}, {x0, y0}, {x0 + wide, y0 + tall});
            if (!extra.empty()) draw_box_numbers(view);
            const bool triad = o_.axes == Axes::triad || o_.axes == Axes::automatic;
            if (f_.dimension == 3 && triad) draw_triad(view, {x0, y0 + tall});
        }
        if (!o_.title.empty()) picture_.text({x0 + wide / 2, 24}, o_.title, "head m");
        if (with_bar) {
            const double room = std::min(bar_room, std::max(120.0, 0.92 * bar_room));
            bar.draw(picture_, {picture_.width - bar.width(), bar_top + (bar_room - room) / 2}, room);
        }
        return std::move(picture_);
    }

private:
    /// The picture is as large as this window and what is beside it; a bar has some height.
    void window_of(std::array<std::size_t, 2> size, double beside, double above) {
        const auto wide = static_cast<double>(size[0]), tall = static_cast<double>(size[1]);
        window_ = RasterSize{static_cast<std::int32_t>(size[0]), static_cast<std::int32_t>(size[1])};
        picture_.width = std::ceil(wide + beside);
        picture_.height = std::ceil(std::max(tall, least_tall_) + above);
    }

    std::optional<RasterSize> given_window() const {
        if (f_.dimension != 2 || !(o_.scale > 0)) return o_.window;
        const Space space(f_);
        std::array<std::int32_t, 2> sides{};
        for (std::size_t k = 0; k < 2; ++k) {
            const double side = space.box[k].empty() ? 0 : 2 * space.box[k].half() * o_.scale;
            sides[k] = static_cast<std::int32_t>(std::clamp(std::round(side), 1.0, 1.0 * max_raster_side));
        }
        return RasterSize{sides[0], sides[1]};
    }

    /// From the lower side of the first pixel to the upper one of the last.
    std::array<std::array<double, 2>, 2> grid_ends() const {
        std::array<std::array<double, 2>, 2> ends;
        for (std::size_t k = 0; k < 2; ++k) {
            const double count = static_cast<double>(k == 0 ? f_.grid->width : f_.grid->height);
            ends[k][0] = f_.grid->origin[k] - 0.5 * f_.grid->spacing[k];
            ends[k][1] = ends[k][0] + count * f_.grid->spacing[k];
        }
        return ends;
    }

    /// A value that is drawn is not finite, or has no logarithm.
    bool has_none() const {
        if (f_.grid) return false;  // nothing is drawn there
        const auto none = [&](double x) { return !std::isfinite(x) || (o_.log && !(x > 0)); };
        return std::ranges::any_of(f_.surfaces, [&](const FigureSurface& s) {
            return std::ranges::any_of(s.triangle_values, none) ||
                   (!s.point_values.empty() && std::ranges::any_of(s.triangles, [&](std::int32_t i) {
                       return none(s.point_values[static_cast<std::size_t>(i)]);
                   }));
        });
    }

    void draw_plane_axes(const std::array<std::array<double, 2>, 2>& ends, Pixel from, Pixel to) {
        const auto axis = [&](std::size_t k, double begin, double end, double room) {
            const auto [low, high] = ends[k];
            const bool turned = o_.axis_names[k].starts_with('-');
            Axis a{.low = low,
                   .high = high,
                   .from = begin,
                   .to = end,
                   .title = o_.axis_names[k].substr(turned ? 1 : 0),
                   .grid = false};
            const int most = std::max(2, static_cast<int>(std::fabs(end - begin) / room));
            a.set(turned ? round_ticks(-high, -low, most) : round_ticks(low, high, most));
            for (Tick& t : a.ticks) t.at = turned ? -t.at : t.at;
            return a;
        };
        // Beside the pixels, not over them.
        constexpr double across = 80, up = 50, half = 0.5;
        from = {from.x - half, from.y - half};
        to = {to.x + half, to.y + half};
        const Axis x = axis(0, from.x, to.x, across), y = axis(1, to.y, from.y, up);
        picture_.lines({{{from.x, from.y}, {to.x, from.y}}, {{to.x, from.y}, {to.x, to.y}}}, "axis");
        draw_axes(picture_, x, y);
    }

    /// Bit k of a corner is its side along axis k.
    Vector3 corner(const View& view, unsigned i) const {
        Vector3 at;
        for (std::size_t k = 0; k < 3; ++k) {
            const Range& r = view.space().box[k];
            at[k] = (i >> k & 1U) != 0 ? r.high : r.low;
        }
        return at;
    }

    FigureLines box_lines(const View& view) {
        if (view.space().box[0].empty()) return {};
        for (unsigned i = 0; i < 8; ++i) {
            const Vector3 at = corner(view, i);
            corners_.insert(corners_.end(), at.begin(), at.end());
            for (unsigned k = 0; k < 3; ++k)
                if ((i >> k & 1U) == 0)
                    edges_.insert(edges_.end(), {static_cast<int>(i), static_cast<int>(i | 1U << k)});
        }
        return {.points = corners_, .segments = edges_, .width = 1, .colour = ink(o_)};
    }

    Pixel on_page(const View& view, const Vector3& at) const {
        const Pixel p = view.at(at);
        return {origin_.x + p.x / resolution_, origin_.y + p.y / resolution_};
    }

    /// Beside the edge that is lowest in the picture, for the upright axis the one to the left.
    void draw_box_numbers(const View& view) {
        Pixel centre;
        for (unsigned i = 0; i < 8; ++i) {
            const Pixel p = on_page(view, corner(view, i));
            centre.x += p.x / 8;
            centre.y += p.y / 8;
        }
        for (unsigned k = 0; k < 3; ++k) {
            unsigned best = 8;
            double most = -HUGE_VAL;
            for (unsigned i = 0; i < 8; ++i) {
                if ((i >> k & 1U) != 0) continue;
                const Pixel a = on_page(view, corner(view, i)), b = on_page(view, corner(view, i | 1U << k));
                const double score = k == 2 ? -(a.x + b.x) : a.y + b.y;
                if (score > most) most = score, best = i;
            }
            const Vector3 low = corner(view, best), high = corner(view, best | 1U << k);
            const Pixel a = on_page(view, low), b = on_page(view, high);
            const double length = std::hypot(b.x - a.x, b.y - a.y);
            if (!(length > 24)) continue;  // seen end-on
            // Away from the middle, across the edge.
            Pixel away{(b.y - a.y) / length, (a.x - b.x) / length};
            if (away.x * ((a.x + b.x) / 2 - centre.x) + away.y * ((a.y + b.y) / 2 - centre.y) < 0)
                away = {-away.x, -away.y};
            const Ticks ticks = round_ticks(low[k], high[k], std::clamp(static_cast<int>(length / 40), 2, 8));
            for (const Tick& t : ticks.ticks) {
                Vector3 at = low;
                at[k] = t.at;
                const Pixel p = on_page(view, at);
                picture_.line(p, {p.x + 5 * away.x, p.y + 5 * away.y}, "axis");
                picture_.text({p.x + 18 * away.x, p.y + 16 * away.y + 4}, t.text, "tick m");
            }
            const std::string name{"xyz"[k]};
            picture_.text({(a.x + b.x) / 2 + 46 * away.x, (a.y + b.y) / 2 + 40 * away.y + 4},
                          ticks.common.empty() ? name : name + ", " + ticks.common, "title m");
        }
    }

    /// The directions of the axes, in the lower left corner.
    void draw_triad(const View& view, Pixel corner) {
        constexpr double length = 30, beside = 46;
        const auto& [right, up, towards] = view.axes();
        const Pixel from{corner.x + beside, corner.y - beside};
        for (std::size_t k = 0; k < 3; ++k) {
            const double x = right[k], y = -up[k];
            if (std::hypot(x, y) < 0.1) continue;  // towards the viewer
            picture_.line(from, {from.x + length * x, from.y + length * y}, "axis thick");
            picture_.text({from.x + (length + 10) * x, from.y + (length + 10) * y + 4}, std::string{"xyz"[k]},
                          "tick m");
        }
    }

    const Figure& f_;
    const FigureOptions& o_;
    Picture picture_;
    double resolution_;
    FigureCounts& counts_;
    std::optional<RasterSize> window_;
    double least_tall_ = 0;  ///< of the room for the bar
    Pixel origin_;
    std::vector<double> corners_;
    std::vector<std::int32_t> edges_;
};

Result<Picture> laid_out(const Figure& figure, double resolution, FigureCounts* counts) {
    if (Status good = check(figure); !good) return good.error();
    FigureCounts told;
    Result<Picture> picture = Layout(figure, resolution, told).run();
    if (picture && counts != nullptr) *counts = told;
    return picture;
}

/// A grid alone, in the memory of a row.
Status write_rows(const std::string& path, const Figure& figure, FigureCounts* counts) {
    if (Status good = check(figure); !good) return good;
    FigureCounts told;
    const Result<ColourScale> scale = scale_of(figure, told);
    if (!scale) return scale.error();
    const GridImage image(*figure.grid, *scale);
    if (std::max(image.width(), image.height()) > io::longest_png_side)
        return file_error(path, "a grid of that aspect cannot be a picture",
                          fmt::format("at most {} pixels a side", io::longest_png_side),
                          fmt::format("{} by {}", image.width(), image.height()), "choose spacings that differ less");
    const auto row = [&](std::size_t r, std::uint8_t* pixels) { image.row(r, pixels); };
    if (Status written = io::write_png_rows(path, image.width(), image.height(), row); !written) return written;
    if (counts != nullptr) *counts = told;
    return Done{};
}

}  // namespace
}  // namespace draw

std::optional<FigureCamera> camera_of(std::string_view view) {
    constexpr std::array<std::pair<std::string_view, std::array<double, 2>>, 7> all{{{"iso", {45, 35.264389682754654}},
                                                                                     {"+x", {0, 0}},
                                                                                     {"-x", {180, 0}},
                                                                                     {"+y", {90, 0}},
                                                                                     {"-y", {-90, 0}},
                                                                                     {"+z", {-90, 90}},
                                                                                     {"-z", {-90, -90}}}};
    for (const auto& [name, at] : all)
        if (name == view) return FigureCamera{.azimuth = at[0], .elevation = at[1]};
    return std::nullopt;
}

std::vector<std::string> colour_map_names() {
    std::vector<std::string> names;
    for (const std::string_view name : draw::colour_map_names()) names.emplace_back(name);
    return names;
}

Result<Image> draw_figure(const Figure& figure, FigureCounts* counts) {
    const ExactEnvironment environment;
    const Result<draw::Picture> picture = draw::laid_out(figure, figure.options.resolution, counts);
    if (!picture) return picture.error();
    return draw::drawn(*picture, draw::ground_of(figure.options), figure.options.resolution);
}

bool is_figure_name(std::string_view path) {
    return draw::is_picture_name(path);
}

Status write_figure(const std::string& path, const Figure& figure, FigureCounts* counts) {
    const ExactEnvironment environment;
    const auto of_file = [&](Error error) {
        if (error.file.empty()) error.file = path;
        return error;
    };
    if (!is_figure_name(path)) return of_file(draw::refusal("pictures have other names", ".png, .svg or .pdf", path));
    constexpr double dots = 300 / 96.0;
    const bool pixels = io::has_suffix(path, ".png");
    const double resolution = pixels ? figure.options.resolution : dots;
    const FigureOptions& o = figure.options;
    if (pixels && figure.grid && !o.bar && o.axes == Axes::none && o.title.empty() && o.resolution == 1) {
        const Status written = draw::write_rows(path, figure, counts);
        return written ? written : Status(of_file(written.error()));
    }
    FigureCounts told;
    Figure drawn = figure;
    if (!pixels) drawn.options.samples = std::min(o.samples, 2);  // of more pixels
    const Result<draw::Picture> picture = draw::laid_out(drawn, resolution, &told);
    if (!picture) return of_file(picture.error());
    if (const Status written = draw::write_picture(path, *picture, draw::ground_of(o), resolution); !written)
        return of_file(written.error());
    if (counts != nullptr) *counts = told;
    return Done{};
}

}  // namespace barycert
