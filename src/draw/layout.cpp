#include "draw/layout.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "barycert/figure.hpp"
#include "barycert/raster.hpp"
#include "barycert/result.hpp"
#include "barycert/scene.hpp"
#include "core/base/strict_math.hpp"
#include "draw/axes.hpp"
#include "draw/colour_map.hpp"
#include "draw/figure_values.hpp"
#include "draw/picture.hpp"
#include "draw/view.hpp"

namespace barycert::draw {
namespace {

/// The part of the window that a figure may fill; the numbers beside a box need room.
double part_of(const Figure& f) {
    if (f.dimension == 2 && (f.options.window || f.options.scale > 0)) return 1;
    if (f.options.axes == Axes::box && f.dimension == 3) return 0.76;
    return f.dimension == 2 && f.options.axes != Axes::none ? 0.97 : 0.94;
}

Rgba ink_of(const FigureOptions& o) {
    return look_of("axis", is_dark(o.background)).colour;
}

class Layout {
public:
    Layout(const Figure& figure, Form form, FigureCounts& counts)
        : f_(figure),
          o_(f_.options),
          picture_(o_.size.width, o_.size.height, o_.title.empty() ? "a mesh" : o_.title),
          resolution_(o_.resolution),
          form_(form),
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
            return file_error(
                "picture.too-large", {}, "a grid of that size cannot be a picture on axes or beside a bar",
                fmt::format("at most {} pixels a side", max_raster_side),
                fmt::format("{} by {}", grid->width(), grid->height()), "draw it without axes, bar and title");
        least_tall_ = with_bar ? bar.least_height() : 0;
        if (grid) window_of({grid->width(), grid->height()}, left + right, top + bottom);
        if (const auto given = given_window(); !grid && given)
            window_of({static_cast<std::size_t>(given->width), static_cast<std::size_t>(given->height)}, left + right,
                      top + bottom);
        double wide = picture_.width - left - right, tall = picture_.height - top - bottom;
        constexpr double least = 16;
        if (!window_ && (wide < least || tall < std::max(least, least_tall_)))
            return file_error("picture.too-large", {}, "there is no room beside bar and axes",
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
                return file_error("picture.too-large", {}, "the picture is too large",
                                  fmt::format("at most {} pixels", max_image_pixels),
                                  fmt::format("{} by {}", window.width, window.height), "choose a smaller size");
            const bool box = f_.dimension == 3 && o_.axes == Axes::box && add_box();
            const View view(f_, window, part_of(f_));
            if (box) set_box_edges(view);
            if (form_ == Form::vectors && view.is_flat()) {
                picture_.add(view.polygons(*scale, counts_), origin_);
            } else {
                auto image = std::make_shared<Image>(view.draw(*scale, counts_));
                picture_.place({x0, y0}, window.width / resolution_, window.height / resolution_, std::move(image));
            }
            if (plane) draw_plane_axes({view.seen(0), view.seen(1)}, {x0, y0}, {x0 + wide, y0 + tall});
            if (box) draw_box_numbers(view);
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
        const auto in_marks = [&](const auto& of) { return std::ranges::any_of(of.values, none); };
        if (std::ranges::any_of(f_.points, in_marks) || std::ranges::any_of(f_.arrows, in_marks)) return true;
        return std::ranges::any_of(f_.surfaces, [&](const FigureSurface& s) {
            return std::ranges::any_of(s.triangle_values, none) ||
                   (!s.point_values.empty() && std::ranges::any_of(s.triangles, [&](std::int32_t i) {
                       return none(s.point_values[static_cast<std::size_t>(i)]);
                   }));
        });
    }

    void draw_plane_axes(const std::array<std::array<double, 2>, 2>& ends, Pixel from, Pixel to) {
        if (!std::isfinite(ends[0][1] - ends[0][0] + ends[1][1] - ends[1][0])) return;  // too wide for numbers
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

    /// The box of what is drawn, as lines; false if there is nothing.
    bool add_box() {
        const Space space(f_);
        if (space.box[0].empty()) return false;
        for (unsigned i = 0; i < 8; ++i) {
            const Vector3 at = space.corner(i);
            corners_.insert(corners_.end(), at.begin(), at.end());
            edges_.push_back(static_cast<int>(i));  // until the camera is known, which is to see them all
        }
        f_.lines.push_back({.points = corners_, .segments = edges_, .width = 1, .colour = ink_of(o_)});
        return true;
    }

    /// The edges, but for those between two sides that look at the viewer, which lie before the mesh.
    void set_box_edges(const View& view) {
        const auto looks_at_viewer = [&](unsigned corner, unsigned across) {
            const unsigned first = corner & 1U << across, u = 1U << (across + 1) % 3, v = 1U << (across + 2) % 3;
            const auto at = [&](unsigned i) { return view.at(view.space().corner(i)); };
            const Pixel a = at(first), b = at(first | u), c = at(first | v);
            const double area = (c.x - a.x) * (b.y - a.y) - (b.x - a.x) * (c.y - a.y);  // y is downwards
            return (first != 0 ? area : -area) > 1;
        };
        edges_.clear();
        for (unsigned i = 0; i < 8; ++i) {
            for (unsigned k = 0; k < 3; ++k) {
                const bool before = looks_at_viewer(i, (k + 1) % 3) && looks_at_viewer(i, (k + 2) % 3);
                if ((i >> k & 1U) != 0 || before) continue;
                edges_.insert(edges_.end(), {static_cast<int>(i), static_cast<int>(i | 1U << k)});
            }
        }
        f_.lines.back().segments = edges_;
    }

    Pixel on_page(const View& view, const Vector3& at) const {
        const Pixel p = view.at(at);
        return {origin_.x + p.x / resolution_, origin_.y + p.y / resolution_};
    }

    /// Beside the edge that is lowest in the picture, for the upright axis the one to the left.
    void draw_box_numbers(const View& view) {
        Pixel centre;
        for (unsigned i = 0; i < 8; ++i) {
            const Pixel p = on_page(view, view.space().corner(i));
            centre.x += p.x / 8;
            centre.y += p.y / 8;
        }
        for (unsigned k = 0; k < 3; ++k) {
            unsigned best = 8;
            double most = -HUGE_VAL;
            for (unsigned i = 0; i < 8; ++i) {
                if ((i >> k & 1U) != 0) continue;
                const Pixel a = on_page(view, view.space().corner(i)),
                            b = on_page(view, view.space().corner(i | 1U << k));
                const double score = k == 2 ? -(a.x + b.x) : a.y + b.y;
                if (score > most) most = score, best = i;
            }
            const Vector3 low = view.space().corner(best), high = view.space().corner(best | 1U << k);
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

    Figure f_;  ///< with the lines of its box
    const FigureOptions& o_;
    Picture picture_;
    double resolution_;
    Form form_;
    FigureCounts& counts_;
    std::optional<RasterSize> window_;
    double least_tall_ = 0;  ///< of the room for the bar
    Pixel origin_;
    std::vector<double> corners_;
    std::vector<std::int32_t> edges_;
};

}  // namespace

Result<Picture> laid_out(const Figure& figure, Form form, FigureCounts& counts) {
    return Layout(figure, form, counts).run();
}

}  // namespace barycert::draw
