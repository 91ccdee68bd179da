#include "barycert/jobs/pictures.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "barycert/base/strict_math.hpp"
#include "barycert/base/text.hpp"
#include "barycert/base/vectors.hpp"
#include "barycert/environment.hpp"
#include "barycert/jobs/job_files.hpp"

namespace barycert {

std::array<double, 3> PixelGrid::middle(std::int64_t i, std::int64_t j) const {
    const ExactEnvironment environment;
    std::array<double, 3> at{};
    for (std::size_t k = 0; k < 3; ++k)
        at[k] = base::held((base::held(origin[k]) + static_cast<double>(i) * base::held(step_right[k])) +
                           static_cast<double>(j) * base::held(step_up[k]));
    return at;
}

}  // namespace barycert

namespace barycert::jobs {
namespace {

using Vector = std::array<double, 3>;
using base::cross, base::dot;

constexpr std::int64_t max_pixels = std::int64_t{1} << 27;

double largest(const Vector& a) {
    return std::max({std::fabs(a[0]), std::fabs(a[1]), std::fabs(a[2])});
}

Vector times(double s, const Vector& a) {
    return {s * a[0], s * a[1], s * a[2]};
}

/// Of length 1 up to rounding. Precondition: not zero. Scaled first, so that squares neither over- nor underflow.
Vector normalised(const Vector& a) {
    const double max = largest(a);
    const Vector b{a[0] / max, a[1] / max, a[2] / max};
    return times(1 / std::sqrt(dot(b, b)), b);
}

/// Axes of the picture, to the right and up, and the point of the plane nearest to the origin.
struct Frame {
    Vector right, up, foot;

    explicit Frame(const Plane& plane) {
        const Vector n = normalised(plane.normal);
        const bool level = n[0] == 0 && n[1] == 0;
        const Vector vertical = level ? Vector{0, 1, 0} : Vector{0, 0, 1};
        const double along = dot(vertical, n);
        up = normalised({vertical[0] - along * n[0], vertical[1] - along * n[1], vertical[2] - along * n[2]});
        right = cross(up, n);
        // offset / |normal|, without squares of the normal as it is.
        const double max = largest(plane.normal);
        const Vector scaled = times(1 / max, plane.normal);
        foot = times(plane.offset / max / std::sqrt(dot(scaled, scaled)), n);
        for (Vector* const v : {&right, &up, &foot}) {
            for (double& x : *v) x += 0.0;  // no -0
        }
    }
};

}  // namespace

SurfaceView view_of(const Surface& s) {
    SurfaceView view{.points = s.points, .triangles = s.cells};
    if (!s.point_fields.empty()) {
        view.point_values = s.point_fields.front().data;
    } else if (!s.cell_fields.empty()) {
        view.triangle_values = s.cell_fields.front().data;
    }
    return view;
}

Result<PixelGrid> pixels_over(const Plane& plane, const std::vector<double>& points, std::int64_t width) {
    const Frame frame(plane);
    double low[2] = {HUGE_VAL, HUGE_VAL}, high[2] = {-HUGE_VAL, -HUGE_VAL};
    for (std::size_t i = 0; i < points.size(); i += 3) {
        const Vector x{points[i] - frame.foot[0], points[i + 1] - frame.foot[1], points[i + 2] - frame.foot[2]};
        const double at[2] = {dot(x, frame.right), dot(x, frame.up)};
        for (int a = 0; a < 2; ++a) {
            low[a] = std::min(low[a], at[a]);
            high[a] = std::max(high[a], at[a]);
        }
    }
    const double across = high[0] - low[0], tall = high[1] - low[1];
    if (!(across > 0) || !(tall > 0) || !std::isfinite(across) || !std::isfinite(tall))
        return file_error("", "the section has no area", "a plane that goes through the mesh",
                          points.empty() ? "no cell on both sides of it" : "a point or a line",
                          "choose another offset");
    PixelGrid grid;
    grid.width = width;
    grid.pixel = across / static_cast<double>(width);
    const double lines = std::max(1.0, std::round(tall / grid.pixel));
    if (!(lines * static_cast<double>(width) <= static_cast<double>(max_pixels)) || !(grid.pixel > 0))
        return file_error("", "the picture would be too large", "at most " + std::to_string(max_pixels) + " pixels",
                          std::to_string(width) + " by " + base::shortest(lines), "choose a smaller job.width");
    grid.height = static_cast<std::int64_t>(lines);
    // Lines are centred in the box.
    const double first[2] = {low[0] + 0.5 * grid.pixel, low[1] + 0.5 * (tall - (lines - 1) * grid.pixel)};
    for (std::size_t k = 0; k < 3; ++k) {
        grid.origin[k] = frame.foot[k] + first[0] * frame.right[k] + first[1] * frame.up[k];
        grid.step_right[k] = grid.pixel * frame.right[k];
        grid.step_up[k] = grid.pixel * frame.up[k];
    }
    return grid;
}

}  // namespace barycert::jobs
