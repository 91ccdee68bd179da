#include "draw/view.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "barycert/figure.hpp"
#include "barycert/raster.hpp"
#include "barycert/scene.hpp"
#include "barycert/weights.hpp"
#include "core/base/finite.hpp"
#include "core/base/strict_math.hpp"
#include "core/base/vectors.hpp"
#include "draw/colour_map.hpp"
#include "draw/picture.hpp"
#include "draw/raster/colour_bytes.hpp"
#include "draw/raster/layers.hpp"

namespace barycert::draw {
namespace {

using base::cross, base::dot, base::minus;

constexpr double fovy = 30;  ///< degrees
constexpr double ambient = 0.35;

/// The length of a vector; its numbers may be as large or small as they like.
double length_of(const double* v, std::size_t d) {
    double most = 0, sum = 0;
    for (std::size_t k = 0; k < d; ++k) most = std::max(most, std::fabs(v[k]));
    for (std::size_t k = 0; k < d && most > 0; ++k) sum += v[k] / most * (v[k] / most);
    return most * std::sqrt(sum);
}

double longest_of(const FigureArrows& a, std::size_t d) {
    double most = 0;
    for (std::size_t i = 0; i < a.vectors.size(); i += d) most = std::max(most, length_of(a.vectors.data() + i, d));
    return most;
}

/// f(point) of all that a figure draws: corners of triangles, ends of lines, both ends of arrows, centres of discs.
template <class F>
void for_points(const Figure& figure, F f) {
    const auto d = static_cast<std::size_t>(figure.dimension);
    for (const FigureSurface& s : figure.surfaces)
        for (const std::int32_t i : s.triangles) f(s.points.data() + d * static_cast<std::size_t>(i));
    for (const FigureLines& l : figure.lines)
        for (const std::int32_t i : l.segments) f(l.points.data() + d * static_cast<std::size_t>(i));
    for (const FigurePoints& p : figure.points)
        for (std::size_t i = 0; i < p.points.size(); i += d) f(p.points.data() + i);
    for (const FigureArrows& a : figure.arrows) {
        const double most = longest_of(a, d);
        for (std::size_t i = 0; i < a.points.size(); i += d) {
            std::array<double, 3> tip{};
            for (std::size_t k = 0; k < d; ++k)
                tip[k] = a.points[i + k] + (most > 0 ? a.vectors[i + k] / most * a.longest : 0);
            f(a.points.data() + i);
            if (base::all_finite(tip)) f(tip.data());
        }
    }
}

/// The camera that sees all points, in perspective, as near as the window allows; or in parallel.
Matrix4 fitting_camera(const Figure& figure, const Space& space, const ViewAxes& axes, double aspect, double part) {
    std::array<Range, 3> along;
    const std::array<Vector3, 3> directions{axes.right, axes.up, axes.towards};
    for_points(figure, [&](const double* p) {
        const Vector3 at = space(p);
        for (std::size_t k = 0; k < 3; ++k) along[k].add(dot(directions[k], at));
    });
    if (along[0].empty()) along = {Range{0, 0}, Range{0, 0}, Range{0, 0}};
    const Range &x = along[0], &y = along[1], &z = along[2];
    const Vector3 &r = axes.right, &u = axes.up, &t = axes.towards;
    const FigureCamera& camera = figure.options.camera;
    Matrix4 projection;
    double distance = z.high + (camera.parallel ? 1 : 0.1);
    if (camera.parallel) {
        double half = std::max(x.half() / aspect, y.half()) / part;
        if (!(half > 0)) half = 1;
        const double near = distance - z.high, far = distance - z.low;
        projection = orthographic(-half * aspect, half * aspect, -half, half, 0.9 * near, 1.1 * far).value();
    } else {
        const double tangent = part * std::tan(0.5 * fovy * (std::numbers::pi / 180));
        // A point is in sight if its distance across is at most its distance along times the tangent.
        for_points(figure, [&](const double* p) {
            const Vector3 at = space(p);
            const double across =
                std::max(std::abs(dot(r, at) - x.middle()) / aspect, std::abs(dot(u, at) - y.middle()));
            distance = std::max(distance, dot(t, at) + across / tangent);
        });
        // No error can occur: 0 < near <= far, and points lie in a box of side 2.
        projection = perspective(fovy, aspect, 0.9 * (distance - z.high), 1.1 * (distance - z.low)).value();
    }
    const Matrix4 view{{r[0], r[1], r[2], -x.middle(),  //
                        u[0], u[1], u[2], -y.middle(),  //
                        t[0], t[1], t[2], -distance,    //
                        0, 0, 0, 1}};
    return scaling({camera.zoom, camera.zoom, 1}) * projection * view;
}

/// From above, without perspective.
Matrix4 fitting_map(const Space& space, double aspect, double part, double zoom) {
    const auto side = [&](std::size_t k) { return space.box[k].empty() ? 0 : space.box[k].half() / space.half; };
    double half = std::max(side(0) / aspect, side(1)) / part / zoom;
    if (!(half > 0)) half = 1;
    // No error can occur: half is above 0.
    return orthographic(-half * aspect, half * aspect, -half, half, -1, 1).value();
}

/// How bright a triangle is: two-sided, from 0.35 to 1.
double brightness(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& light) {
    const Vector3 n = cross(minus(b, a), minus(c, a));
    const double length = std::sqrt(dot(n, n));
    if (!(length > 0)) return 1;
    return ambient + (1 - ambient) * std::min(1.0, std::abs(dot(n, light)) / length);
}

/// From the upper left behind the viewer.
Vector3 light_of(const ViewAxes& axes) {
    Vector3 light;
    for (std::size_t k = 0; k < 3; ++k) light[k] = axes.towards[k] + 0.5 * axes.up[k] - 0.4 * axes.right[k];
    return base::unit(light);
}

/// The colour of a triangle: of its values at the corners, or its own.
struct Paint {
    Rgba colour;
    float shade;
    bool by_value;
};

/// All that is drawn, by normalised points.
class Parts {
public:
    Parts(const Figure& figure, const View& view, const ColourScale& scale)
        : d_(static_cast<std::size_t>(figure.dimension)), view_(view), light_(light_of(view.axes())), scale_(scale) {
        for (const FigureSurface& s : figure.surfaces) add(s);
        for (const FigureArrows& a : figure.arrows) add(a);
        for (const FigurePoints& p : figure.points) add(p);
    }

    Vector3 point(std::int32_t i) const {
        const double* const p = &positions[4 * static_cast<std::size_t>(i)];
        return {p[0], p[1], p[2]};
    }

    std::vector<double> positions = {};  ///< x, y, z, 1
    std::vector<double> values = {};     ///< of points, NaN where there is none
    std::vector<std::int32_t> triangles = {};
    std::vector<Paint> paints = {};
    std::uint64_t without_value = 0;

private:
    void add_point(const Vector3& p, double value) {
        positions.insert(positions.end(), {p[0], p[1], p[2], 1});
        values.push_back(value);
    }
    void add_triangle(const std::array<std::int32_t, 3>& corners, const std::optional<Rgba>& colour) {
        triangles.insert(triangles.end(), corners.begin(), corners.end());
        const double shade = d_ == 2 ? 1 : brightness(point(corners[0]), point(corners[1]), point(corners[2]), light_);
        paints.push_back({colour.value_or(Rgba{}), static_cast<float>(shade), !colour});
    }

    Rgba colour_of(double value) {
        if (std::isfinite(value)) return scale_(value);
        ++without_value;
        return scale_.no_value;
    }

    void add(const FigureSurface& s) {
        const auto first = static_cast<std::int32_t>(values.size());
        for (std::size_t i = 0; i < s.points.size() / d_; ++i)
            add_point(view_.space()(s.points.data() + d_ * i), s.point_values.empty() ? 0 : s.point_values[i]);
        for (std::size_t t = 0; t < s.triangles.size(); t += 3) {
            std::array<std::int32_t, 3> corners{};
            bool finite = true;
            for (std::size_t c = 0; c < 3; ++c) {
                corners[c] = first + s.triangles[t + c];
                finite = finite && std::isfinite(values[static_cast<std::size_t>(corners[c])]);
            }
            std::optional<Rgba> colour;
            if (!s.triangle_values.empty()) {
                finite = std::isfinite(s.triangle_values[t / 3]);
                colour = scale_(s.triangle_values[t / 3]);
            } else if (s.point_values.empty()) {
                colour = s.colour;
            }
            if (!finite) colour = scale_.no_value;
            without_value += finite ? 0 : 1;
            add_triangle(corners, colour);
        }
    }

    /// As large in pixels wherever they are.
    void add(const FigurePoints& f) {
        constexpr std::int32_t sides = 16;
        const auto& [right, up, towards] = view_.axes();
        for (std::size_t i = 0; i < f.points.size(); i += d_) {
            Vector3 at = view_.space()(f.points.data() + i);
            const double lift = d_ == 2 ? before : std::min(0.5 * f.size * view_.pixel_at(at), 0.05);
            for (std::size_t j = 0; j < 3; ++j) at[j] += lift * towards[j];
            const double radius = 0.5 * f.size * view_.pixel_at(at);
            const Rgba colour = f.values.empty() ? f.colour : colour_of(f.values[i / d_]);
            const auto first = static_cast<std::int32_t>(values.size());
            for (std::int32_t k = 0; k < sides; ++k) {
                const double turn = 2 * std::numbers::pi * k / sides;
                Vector3 p;
                for (std::size_t j = 0; j < 3; ++j)
                    p[j] = at[j] + radius * (std::cos(turn) * right[j] + std::sin(turn) * up[j]);
                add_point(p, 0);
                if (k > 1) add_triangle({first, first + k - 1, first + k}, colour);
            }
        }
    }

    /// A shaft and a head of some sides; in the plane both are flat.
    void add(const FigureArrows& a) {
        const double most = longest_of(a, d_);
        for (std::size_t i = 0; most > 0 && i < a.points.size(); i += d_) {
            const double* const v = a.vectors.data() + i;
            // Not so long that it overflows.
            const double own = length_of(v, d_), length = std::min(own / most * a.longest / view_.space().half, 0x1p20);
            if (!(length > 0)) continue;
            const Rgba colour = a.values.empty() ? a.colour : colour_of(a.values[i / d_]);
            Vector3 along{};
            for (std::size_t k = 0; k < d_; ++k) along[k] = v[k] / own;
            Vector3 from = view_.space()(a.points.data() + i);
            if (d_ == 2) from[2] = before;
            add_arrow(from, along, length, colour);
        }
    }

    void add_arrow(const Vector3& from, const Vector3& along, double length, Rgba colour) {
        const std::int32_t sides = d_ == 2 ? 2 : 10;  // in the plane the left and the right one
        Vector3 other{};
        other[d_ == 2 ? 2 : std::fabs(along[0]) < 0.6 ? 0 : 1] = 1;
        const Vector3 across = base::unit(cross(along, other));
        const Vector3 third = cross(along, across);
        const auto add_at = [&](double at, double radius, double turn) {
            Vector3 p;
            for (std::size_t j = 0; j < 3; ++j)
                p[j] = from[j] + length * (at * along[j] + radius * (std::cos(turn) * across[j] +
                                                                     (d_ == 2 ? 0 : std::sin(turn)) * third[j]));
            add_point(p, 0);
        };
        const auto ring = [&](double at, double radius, std::int32_t points) {
            const auto first = static_cast<std::int32_t>(values.size());
            for (std::int32_t i = 0; i < points; ++i) add_at(at, radius, 2 * std::numbers::pi * i / sides);
            return first;
        };
        const std::int32_t tail = ring(0, 0.03, sides), neck = ring(0.7, 0.03, sides), wide = ring(0.7, 0.09, sides),
                           tip = ring(1, 0, 1);
        for (std::int32_t i = 0; i < (d_ == 2 ? 1 : sides); ++i) {
            const std::int32_t n = (i + 1) % sides;
            for (const auto& [a, b] : {std::pair(tail, neck), {neck, wide}}) {
                add_triangle({a + i, a + n, b + n}, colour);
                add_triangle({a + i, b + n, b + i}, colour);
            }
            add_triangle({wide + i, wide + n, tip}, colour);
        }
    }

    static constexpr double before = 0x1p-10;  ///< in the plane, what lies on a surface
    std::size_t d_;
    const View& view_;
    Vector3 light_;
    const ColourScale& scale_;
};

}  // namespace

Space::Space(const Figure& figure) : dimension(static_cast<std::size_t>(figure.dimension)) {
    for_points(figure, [&](const double* p) {
        for (std::size_t k = 0; k < dimension; ++k) box[k].add(p[k]);
    });
    double most = 0;
    for (const Range& r : box) most = std::max(most, r.empty() ? 0 : r.half());
    if (most > 0) half = most;
}

ViewAxes::ViewAxes(const FigureCamera& camera) {
    constexpr double degree = std::numbers::pi / 180;
    const double a = std::fmod(camera.azimuth, 360) * degree, e = std::fmod(camera.elevation, 360) * degree;
    const double ca = std::cos(a), sa = std::sin(a), ce = std::cos(e), se = std::sin(e);
    right = {-sa, ca, 0};
    up = {-se * ca, -se * sa, ce};
    towards = {ce * ca, ce * sa, se};
}

View::View(const Figure& figure, RasterSize window, double part)
    : figure_(figure),
      window_(window),
      space_(figure),
      axes_(figure.dimension == 2 ? FigureCamera{.azimuth = -90, .elevation = 90} : figure.options.camera) {
    const double aspect = 1.0 * window.width / window.height;
    to_clip_ = figure.dimension == 2 ? fitting_map(space_, aspect, part, figure.options.camera.zoom)
                                     : fitting_camera(figure, space_, axes_, aspect, part);
}

Pixel View::seen(const Vector3& normalised) const {
    const auto& [x, y, z] = normalised;
    const auto p = raster::in_clip_space(std::array{x, y, z, 1.0}, to_clip_, Rounding::plain);
    return {(p[0] / p[3] + 1) * 0.5 * window_.width, (1 - p[1] / p[3]) * 0.5 * window_.height};
}

double View::pixel_at(const Vector3& normalised) const {
    const std::array<double, 16>& m = to_clip_.m;
    const double w = dot({m[12], m[13], m[14]}, normalised) + m[15];
    return 2 * figure_.options.resolution * w / (window_.height * dot({m[4], m[5], m[6]}, axes_.up));
}

bool View::is_flat() const {
    constexpr std::size_t most = 20'000;  // a file of them has some megabytes
    std::size_t triangles = 0;
    for (const FigureSurface& s : figure_.surfaces) triangles += s.triangles.size() / 3;
    const auto by_points = [](const FigureSurface& s) { return !s.point_values.empty(); };
    return figure_.dimension == 2 && figure_.arrows.empty() && figure_.points.empty() && triangles < most &&
           figure_.options.camera.zoom <= 1 && std::ranges::none_of(figure_.surfaces, by_points);
}

Picture View::polygons(const ColourScale& scale, FigureCounts& counts) const {
    const Parts all(figure_, *this, scale);
    const double resolution = figure_.options.resolution;
    Picture out(window_.width / resolution, window_.height / resolution, "");
    const auto placed = [&](const Vector3& at) { return Pixel{seen(at).x / resolution, seen(at).y / resolution}; };
    for (std::size_t t = 0; t < all.paints.size(); ++t) {
        std::vector<Pixel> polygon;
        for (std::size_t c = 0; c < 3; ++c) polygon.push_back(placed(all.point(all.triangles[3 * t + c])));
        out.area(std::move(polygon), "", all.paints[t].colour);
        out.items.back().width = 0.4;  // enough that programs do not let the ground through between neighbours
    }
    for (const FigureLines& l : figure_.lines) {
        std::vector<std::pair<Pixel, Pixel>> segments;
        const auto end = [&](std::size_t i) {
            return placed(space_(&l.points[2 * static_cast<std::size_t>(l.segments[i])]));
        };
        for (std::size_t i = 0; i < l.segments.size(); i += 2) segments.emplace_back(end(i), end(i + 1));
        if (segments.empty()) continue;
        out.lines(segments, "");
        out.items.back().width = l.width;
        out.items.back().colour = l.colour;
    }
    counts.without_value = all.without_value;
    counts.render.triangles = counts.render.drawn = all.paints.size();
    return out;
}

std::array<double, 2> View::seen(std::size_t axis) const {
    const double half = space_.half / to_clip_.m[5 * axis], middle = space_.box[axis].middle();
    return {middle - half, middle + half};
}

Image View::draw(const ColourScale& scale, FigureCounts& counts) const {
    const Parts parts(figure_, *this, scale);
    const FigureOptions& o = figure_.options;
    std::vector<raster::Line> lines;
    const auto add = [&](const FigureLines& of) {
        std::vector<double> positions;
        for (std::size_t i = 0; i < of.points.size(); i += space_.dimension) {
            const Vector3 p = space_(of.points.data() + i);
            positions.insert(positions.end(), {p[0], p[1], p[2], 1});
        }
        const std::vector<double> at = raster::in_clip_space(positions, to_clip_, Rounding::plain);
        for (std::size_t i = 0; i + 1 < of.segments.size(); i += 2) {
            raster::Line& line = lines.emplace_back();
            line.width = of.width * o.resolution;
            line.colour = of.colour;
            for (std::size_t k = 0; k < 2; ++k)
                std::copy_n(&at[4 * static_cast<std::size_t>(of.segments[i + k])], 4, line.ends[k].data());
        }
    };
    for (const FigureLines& l : figure_.lines) add(l);
    const std::vector<double> clip = raster::in_clip_space(parts.positions, to_clip_, Rounding::plain);
    const bool by_value = std::ranges::any_of(parts.paints, &Paint::by_value);
    raster::Layers layers{.size = window_,
                          .samples = o.samples,
                          .background = o.background,
                          .clip = clip,
                          .triangles = parts.triangles,
                          .numbers = by_value ? 1U : 0U,
                          .method = o.method,
                          .rounding = o.rounding,
                          .lines = lines};
    layers.number = [&](std::size_t vertex, double* to) {
        // A triangle with a value that is not finite has a colour of its own.
        *to = std::isfinite(parts.values[vertex]) ? parts.values[vertex] : 0;
    };
    layers.colour = [&](const double* numbers, std::size_t triangle) {
        const Paint& paint = parts.paints[triangle];
        const Rgba full = paint.by_value ? scale(numbers[0]) : paint.colour;
        if (paint.shade == 1) return full;
        Rgba out = full;
        for (std::size_t k = 0; k < 3; ++k) out[k] = raster::component_byte(double{paint.shade} * (full[k] / 255.0));
        return out;
    };
    counts.without_value = parts.without_value;
    return raster::draw(layers, counts.render);
}

}  // namespace barycert::draw
