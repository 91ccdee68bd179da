#include "barycert/raster/view_camera.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "barycert/base/strict_math.hpp"

namespace barycert::raster {
namespace {

constexpr double part = 0.94;  ///< of the window that the surface may fill
constexpr double fovy = 30;    ///< degrees

double along(const Vector3& axis, const double* p) {
    return axis[0] * p[0] + axis[1] * p[1] + axis[2] * p[2];
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

}  // namespace

ViewAxes view_axes(double azimuth, double elevation) {
    constexpr double degree = std::numbers::pi / 180;
    const double a = std::fmod(azimuth, 360) * degree, e = std::fmod(elevation, 360) * degree;
    const double ca = std::cos(a), sa = std::sin(a), ce = std::cos(e), se = std::sin(e);
    return {{-sa, ca, 0}, {-se * ca, -se * sa, ce}, {ce * ca, ce * sa, se}};
}

std::vector<double> normalised_points(std::span<const double> points, int dimension) {
    const auto d = static_cast<std::size_t>(dimension);
    Range box[3];
    for (std::size_t i = 0; i < points.size(); ++i) box[i % d].add(points[i]);
    double half = 0;
    for (std::size_t k = 0; k < d; ++k) half = std::max(half, box[k].half());
    if (!(half > 0)) half = 1;  // no points, or one
    std::vector<double> result;
    result.reserve(points.size() / d * 3);
    for (std::size_t i = 0; i < points.size(); i += d) {
        // Halves, for the difference of two coordinates may be too large a number.
        for (std::size_t k = 0; k < 3; ++k)
            result.push_back(k < d ? 2 * ((0.5 * points[i + k] - 0.5 * box[k].middle()) / half) : 0);
    }
    return result;
}

Result<Matrix4> fitting_camera(std::span<const double> points, const ViewAxes& axes, double aspect) {
    Range x, y, z;
    for (std::size_t i = 0; i < points.size(); i += 3) {
        x.add(along(axes.right, points.data() + i));
        y.add(along(axes.up, points.data() + i));
        z.add(along(axes.towards, points.data() + i));
    }
    if (points.empty()) x = y = z = {0, 0};
    const double tangent = part * std::tan(0.5 * fovy * (std::numbers::pi / 180));
    // A point is in sight if its distance across is at most its distance along times the tangent.
    double distance = z.high + 0.1;
    for (std::size_t i = 0; i < points.size(); i += 3) {
        const double* const p = points.data() + i;
        const double across =
            std::max(std::abs(along(axes.right, p) - x.middle()) / aspect, std::abs(along(axes.up, p) - y.middle()));
        distance = std::max(distance, along(axes.towards, p) + across / tangent);
    }
    Matrix4 view;
    for (std::size_t k = 0; k < 3; ++k) {
        view.m[k] = axes.right[k];
        view.m[4 + k] = axes.up[k];
        view.m[8 + k] = axes.towards[k];
    }
    view.m[3] = -x.middle();
    view.m[7] = -y.middle();
    view.m[11] = -distance;
    const double near = distance - z.high, far = distance - z.low;
    const Result<Matrix4> projection = perspective(fovy, aspect, 0.9 * near, 1.1 * far);
    if (!projection) return projection.error();
    return *projection * view;
}

Result<Matrix4> fitting_map(std::span<const double> points, double aspect) {
    Range x, y;
    for (std::size_t i = 0; i < points.size(); i += 3) {
        x.add(points[i]);
        y.add(points[i + 1]);
    }
    if (points.empty()) x = y = {0, 0};
    double half = std::max(x.half() / aspect, y.half()) / part;
    if (!(half > 0)) half = 1;
    return orthographic(x.middle() - half * aspect, x.middle() + half * aspect, y.middle() - half, y.middle() + half,
                        -1, 1);
}

}  // namespace barycert::raster
