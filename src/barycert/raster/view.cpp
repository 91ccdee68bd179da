#include "barycert/scene.hpp"

#include <fmt/format.h>

#include <limits>
#include <numbers>

#include "barycert/base/finite.hpp"
#include "barycert/base/strict_math.hpp"
#include "barycert/base/text.hpp"
#include "barycert/base/vectors.hpp"
#include "barycert/environment.hpp"
#include "barycert/io/png/panels.hpp"

namespace barycert {
namespace raster {
namespace {

using base::dot;

constexpr double ambient = 0.35;
constexpr std::uint8_t grey = 190;  ///< of what has no value

Error refusal(const std::string& what, const std::string& expected, const std::string& found) {
    return {.what = what, .expected = expected, .found = found, .remedy = "correct the surface or its view"};
}

Status check_arrays(const SurfaceView& s) {
    if (s.dimension != 2 && s.dimension != 3)
        return refusal("dimension of a surface", "2 or 3", std::to_string(s.dimension));
    const auto d = static_cast<std::size_t>(s.dimension);
    if (s.points.size() % d != 0 || s.triangles.size() % 3 != 0)
        return refusal("arrays of a surface", std::to_string(d) + " coordinates a point and 3 points a triangle",
                       std::to_string(s.points.size()) + " and " + std::to_string(s.triangles.size()) + " numbers");
    const std::size_t points = s.points.size() / d, triangles = s.triangles.size() / 3;
    if ((!s.point_values.empty() && s.point_values.size() != points) ||
        (!s.triangle_values.empty() && s.triangle_values.size() != triangles) ||
        (!s.point_values.empty() && !s.triangle_values.empty()))
        return refusal("values of a surface", "one a point, or one a triangle, or none",
                       std::to_string(s.point_values.size()) + " for " + std::to_string(points) + " points and " +
                           std::to_string(s.triangle_values.size()) + " for " + std::to_string(triangles) +
                           " triangles");
    for (std::size_t i = 0; i < s.triangles.size(); ++i) {
        if (s.triangles[i] < 0 || static_cast<std::size_t>(s.triangles[i]) >= points)
            return refusal("corner " + std::to_string(i % 3) + " of triangle " + std::to_string(i / 3),
                           "an index below " + std::to_string(points), std::to_string(s.triangles[i]));
    }
    if (const std::size_t i = base::first_not_finite(s.points); i != s.points.size())
        return refusal("coordinate " + std::to_string(i % d) + " of point " + std::to_string(i / d), "a finite number",
                       base::shortest(s.points[i]));
    return Done{};
}

Status check(const SurfaceView& s, const ViewOptions& o) {
    if (Status good = check_arrays(s); !good) return good;
    if (Status good = check_raster_size(o.size); !good) return good;
    for (const double angle : {o.azimuth, o.elevation}) {
        if (!std::isfinite(angle)) return refusal("the place of the camera", "finite angles", base::shortest(angle));
    }
    if (o.range &&
        !(std::isfinite(o.range->first) && std::isfinite(o.range->second) && o.range->first <= o.range->second))
        return refusal("the range of colours", "two finite numbers, the lower one first",
                       base::shortest(o.range->first) + " and " + base::shortest(o.range->second));
    return Done{};
}

double value_at(const SurfaceView& s, std::size_t corner) {
    if (!s.point_values.empty()) return s.point_values[static_cast<std::size_t>(s.triangles[corner])];
    return s.triangle_values[corner / 3];
}

bool has_values(const SurfaceView& s) {
    return !s.point_values.empty() || !s.triangle_values.empty();
}

struct Range {
    double low = HUGE_VAL, high = -HUGE_VAL;

    void add(double x) {
        low = std::min(low, x);
        high = std::max(high, x);
    }
    double middle() const { return 0.5 * low + 0.5 * high; }
    double half() const { return 0.5 * high - 0.5 * low; }
};

/// From values to the u of the texture of colours.
struct ValueScale {
    double low = std::numeric_limits<double>::quiet_NaN(), high = low;

    ValueScale(const SurfaceView& s, const ViewOptions& o) {
        if (!has_values(s)) return;
        Range range;
        for (std::size_t c = 0; c < s.triangles.size(); ++c) {
            if (const double x = value_at(s, c); std::isfinite(x)) range.add(x);
        }
        if (o.range) range = {o.range->first, o.range->second};
        if (range.low <= range.high) low = range.low, high = range.high;
        // A zero may come with either sign: the bar says 0.
        if (low == 0) low = 0;
        if (high == 0) high = 0;
    }

    bool known() const { return !std::isnan(low); }

    double operator()(double x) const {
        constexpr double far = 0x1p40;  // beyond the range a texture goes on with its rim
        return std::clamp(io::place_in_range(x, low, high), -far, far);
    }
};

/// Row 0: the colours; row 1: the colour of what has no value.
Texture colour_texture() {
    Texture t;
    t.image = {io::colour_count, 2, std::vector<std::uint8_t>(std::size_t{8} * io::colour_count, grey)};
    for (std::int32_t i = 0; i < io::colour_count; ++i) {
        const io::Colour c = io::colour(i);
        t.image.set_pixel(i, 0, {c[0], c[1], c[2], 255});
        t.image.set_pixel(i, 1, {grey, grey, grey, 255});
    }
    return t;
}

constexpr double part = 0.94;  ///< of the window that the surface may fill
constexpr double fovy = 30;    ///< degrees

/// The axes of a camera: to the right and up in the picture, and towards the viewer. Unit vectors.
struct ViewAxes {
    Vector3 right, up, towards;
};

ViewAxes view_axes(double azimuth, double elevation) {
    constexpr double degree = std::numbers::pi / 180;
    const double a = std::fmod(azimuth, 360) * degree, e = std::fmod(elevation, 360) * degree;
    const double ca = std::cos(a), sa = std::sin(a), ce = std::cos(e), se = std::sin(e);
    return {{-sa, ca, 0}, {-se * ca, -se * sa, ce}, {ce * ca, ce * sa, se}};
}

/// The corners of triangles moved and scaled so that the middle of their box is the origin and its longest side 2, with
/// three coordinates each.
std::vector<Vector3> normalised_corners(const SurfaceView& s) {
    const auto d = static_cast<std::size_t>(s.dimension);
    const auto coordinate = [&](std::size_t corner, std::size_t k) {
        return s.points[d * static_cast<std::size_t>(s.triangles[corner]) + k];
    };
    std::vector<Vector3> corners(s.triangles.size());
    Range box[3];
    for (std::size_t c = 0; c < corners.size(); ++c) {
        for (std::size_t k = 0; k < d; ++k) box[k].add(coordinate(c, k));
    }
    double half = 0;
    for (std::size_t k = 0; k < d; ++k) half = std::max(half, box[k].half());
    if (!(half > 0)) half = 1;  // no points, or one
    for (std::size_t c = 0; c < corners.size(); ++c) {
        // Halves, for the difference of two coordinates may be too large a number.
        for (std::size_t k = 0; k < d; ++k)
            corners[c][k] = 2 * ((0.5 * coordinate(c, k) - 0.5 * box[k].middle()) / half);
    }
    return corners;
}

/// Where points lie along an axis.
Range along(const Vector3& axis, std::span<const Vector3> points) {
    Range range;
    for (const Vector3& p : points) range.add(dot(axis, p));
    return points.empty() ? Range{0, 0} : range;
}

/// The camera that sees all normalised points, in perspective, as near as the window allows.
Matrix4 fitting_camera(std::span<const Vector3> points, const ViewAxes& axes, double aspect) {
    const Range x = along(axes.right, points), y = along(axes.up, points), z = along(axes.towards, points);
    const double tangent = part * std::tan(0.5 * fovy * (std::numbers::pi / 180));
    // A point is in sight if its distance across is at most its distance along times the tangent.
    double distance = z.high + 0.1;
    for (const Vector3& p : points) {
        const double across =
            std::max(std::abs(dot(axes.right, p) - x.middle()) / aspect, std::abs(dot(axes.up, p) - y.middle()));
        distance = std::max(distance, dot(axes.towards, p) + across / tangent);
    }
    const auto& [r, u, t] = axes;
    const Matrix4 view{{r[0], r[1], r[2], -x.middle(),  //
                        u[0], u[1], u[2], -y.middle(),  //
                        t[0], t[1], t[2], -distance,    //
                        0, 0, 0, 1}};
    const double near = distance - z.high, far = distance - z.low;
    // No error can occur: 0 < near <= far, and points lie in a box of side 2.
    return perspective(fovy, aspect, 0.9 * near, 1.1 * far).value() * view;
}

/// The same from above, without perspective.
Matrix4 fitting_map(std::span<const Vector3> points, double aspect) {
    const Range x = along({1, 0, 0}, points), y = along({0, 1, 0}, points);
    double half = std::max(x.half() / aspect, y.half()) / part;
    if (!(half > 0)) half = 1;
    return orthographic(x.middle() - half * aspect, x.middle() + half * aspect, y.middle() - half, y.middle() + half,
                        -1, 1)
        .value();  // no error can occur: half is above 0
}

/// How bright a triangle is: two-sided, from 0.35 to 1.
double brightness(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& light) {
    const Vector3 n = base::cross(base::minus(b, a), base::minus(c, a));
    const double length = std::sqrt(dot(n, n));
    if (!(length > 0)) return 1;
    return ambient + (1 - ambient) * std::min(1.0, std::abs(dot(n, light)) / length);
}

/// From the upper left behind the viewer.
Vector3 light_of(const ViewAxes& axes) {
    Vector3 light;
    for (std::size_t k = 0; k < 3; ++k) light[k] = axes.towards[k] + 0.5 * axes.up[k] - 0.4 * axes.right[k];
    const double length = std::sqrt(dot(light, light));
    for (double& x : light) x /= length;
    return light;
}

/// The bar with its range in four digits, if they still tell its ends apart: all those of a computed number would take
/// half the picture.
io::ColourBar short_bar(double low, double high, std::size_t height) {
    const auto four_digits = [](double x) { return base::parse_double(fmt::format("{:.4g}", x)).value_or(x); };
    const double short_low = four_digits(low), short_high = four_digits(high);
    return short_low == short_high ? io::ColourBar(low, high, height) : io::ColourBar(short_low, short_high, height);
}

/// The scene in a window that is `width` pixels wide.
Scene scene_of(const SurfaceView& s, const ViewOptions& o, std::int32_t width, const ValueScale& scale,
               std::uint64_t& without_value) {
    Scene scene;
    scene.size = {width, o.size.height};
    scene.background = o.background;
    scene.method = o.method;
    scene.rounding = o.rounding;
    // Three vertices of its own for each triangle, for each has its own light.
    const std::vector<Vector3> points = normalised_corners(s);
    const ViewAxes axes = view_axes(o.azimuth, o.elevation);
    const double aspect = 1.0 * width / o.size.height;
    scene.to_clip = s.dimension == 2 ? fitting_map(points, aspect) : fitting_camera(points, axes, aspect);
    const Vector3 light = light_of(axes);
    const bool values = has_values(s);
    if (values) scene.texture = colour_texture();
    for (std::size_t t = 0; t < s.triangles.size(); t += 3) {
        const double shade = s.dimension == 2 ? 1 : brightness(points[t], points[t + 1], points[t + 2], light);
        const bool finite = values && std::isfinite(value_at(s, t)) && std::isfinite(value_at(s, t + 1)) &&
                            std::isfinite(value_at(s, t + 2));
        without_value += static_cast<std::uint64_t>(values && !finite);
        for (std::size_t c = 0; c < 3; ++c) {
            const Vector3& p = points[t + c];
            scene.positions.insert(scene.positions.end(), {p[0], p[1], p[2], 1});
            scene.triangles.push_back(static_cast<std::int32_t>(t + c));
            const double level = values ? shade : shade * (grey / 255.0);
            scene.colours.insert(scene.colours.end(), {level, level, level});
            if (!values) continue;
            scene.texture_coordinates.push_back(finite ? scale(value_at(s, t + c)) : 0);
            scene.texture_coordinates.push_back(finite ? 0.25 : 0.75);
        }
    }
    return scene;
}

}  // namespace
}  // namespace raster

Result<Image> draw_surface(const SurfaceView& surface, const ViewOptions& options, ViewCounts* counts) {
    const ExactEnvironment environment;
    if (Status good = raster::check(surface, options); !good) return good.error();
    const raster::ValueScale scale(surface, options);
    const bool with_bar = options.bar && scale.known();
    const auto height = static_cast<std::size_t>(options.size.height);
    const io::ColourBar bar = raster::short_bar(scale.low, scale.high, std::max(height, io::min_bar_height));
    const auto bar_width = static_cast<std::int32_t>(with_bar ? bar.width() : 0);
    if (with_bar && (height < io::min_bar_height || bar_width >= options.size.width))
        return raster::refusal(
            "there is no room for the colour bar",
            "more than " + std::to_string(bar_width) + " by " + std::to_string(io::min_bar_height - 1) + " pixels",
            std::to_string(options.size.width) + " by " + std::to_string(options.size.height));
    ViewCounts told{{}, scale.low, scale.high, 0};
    const Scene scene = raster::scene_of(surface, options, options.size.width - bar_width, scale, told.without_value);
    Result<Image> drawn = render(scene, &told.render);
    if (!drawn) return drawn;
    if (counts != nullptr) *counts = told;
    if (!with_bar) return drawn;
    Result<Image> whole = blank_image(options.size.width, options.size.height, options.background);
    if (!whole) return whole;
    for (std::int32_t j = 0; j < options.size.height; ++j) {
        std::copy_n(drawn->data.data() + drawn->offset(0, j), drawn->offset(0, 1),
                    whole->data.data() + whole->offset(0, j));
        bar.row(height - 1 - static_cast<std::size_t>(j), whole->data.data() + whole->offset(drawn->width, j));
    }
    return whole;
}

}  // namespace barycert
