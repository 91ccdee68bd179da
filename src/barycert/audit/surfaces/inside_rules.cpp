// Whether a point is inside a closed surface of triangles: what is in use, faults included.

#include <cmath>
#include <limits>
#include <numbers>

#include "barycert/audit/surfaces/rules.hpp"
#include "barycert/surface_locator.hpp"

namespace barycert::audit {

double moller_trumbore(const Corners<double>& t, Vector<double> p, Vector<double> d, double tolerance) {
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    const auto e = t[1] - t[0], f = t[2] - t[0], h = cross(d, f), s = p - t[0], q = cross(s, e);
    const double det = dot(e, h);
    if (std::fabs(det) <= tolerance) return none;
    const double u = dot(s, h) / det, v = dot(d, q) / det;
    return u < 0 || v < 0 || u + v > 1 ? none : dot(f, q) / det;
}

namespace {

template <class Crosses>
bool odd(const SurfaceCase& c, const Crosses& crosses) {
    const auto p = vector_from<double>(c.point.data());
    bool is_odd = false;
    for (const TriangleInSpace& t : c.triangles) is_odd = is_odd != crosses(corners_from<double>(t), p);
    return is_odd;
}

double ray_along_x(const SurfaceCase& c) {
    return odd(c, [](const auto& t, const auto& p) { return moller_trumbore(t, p, {1, 0, 0}, 1e-8) > 1e-8; });
}

double ray_aslant(const SurfaceCase& c) {
    return odd(c, [](const auto& t, const auto& p) { return moller_trumbore(t, p, {0.44, 0.62, 0.65}, 0) > 0; });
}

/// Edges are half-open: they cross the line y = p.y if one end is above it and the other is not.
double ray_half_open(const SurfaceCase& c) {
    return odd(c, [](const auto& t, const auto& p) {
        bool over = false;
        for (std::size_t k = 0; k < 3; ++k) {
            const auto &a = t[k], &b = t[(k + 1) % 3];
            if ((a.y > p.y) != (b.y > p.y) && p.z < a.z + (p.y - a.y) * (b.z - a.z) / (b.y - a.y)) over = !over;
        }
        const auto n = normal_of(t);
        return over && t[0].x + (n.y * (t[0].y - p.y) + n.z * (t[0].z - p.z)) / n.x > p.x;
    });
}

double solid_angles(const SurfaceCase& c) {
    const auto p = vector_from<double>(c.point.data());
    double sum = 0;
    for (const TriangleInSpace& triangle : c.triangles) {
        Corners<double> t = corners_from<double>(triangle);
        for (auto& corner : t) corner = corner - p;
        const double a = std::sqrt(dot(t[0], t[0])), b = std::sqrt(dot(t[1], t[1])), d = std::sqrt(dot(t[2], t[2]));
        sum += std::atan2(kernels::determinant(t[0], t[1], t[2]),
                          a * b * d + dot(t[0], t[1]) * d + dot(t[1], t[2]) * a + dot(t[2], t[0]) * b);
    }
    return std::fabs(sum) > std::numbers::pi;
}

double nearest_normal(const SurfaceCase& c) {
    const auto p = vector_from<double>(c.point.data());
    double least = HUGE_VAL, height = 0;
    for (const TriangleInSpace& triangle : c.triangles) {
        const Corners<double> t = corners_from<double>(triangle);
        const double distance = by_regions(t, p);
        if (!(distance < least)) continue;
        least = distance;
        height = dot(normal_of(t), p - t[0]);
    }
    return height < 0;
}

double by_winding(const SurfaceCase& c) {
    Surface surface = surface_of(c);
    return SurfaceLocator::build(surface, {.threads = 1}).value().locate(c.point.data()).value().winding != 0;
}

}  // namespace

std::vector<SurfaceRule> inside_rules() {
    using enum SurfaceQuestion;
    return {
        {"inside.ray-along-x", inside, "triangles that a ray along x crosses, by Moller and Trumbore, within 1e-8",
         "tutorials on ray casting", "a ray through an edge or corner counts two triangles, or none; small surfaces",
         ray_along_x},
        {"inside.ray-aslant", inside, "the same along a fixed slanting direction, without a tolerance",
         "mesh libraries", "as before, but on fewer surfaces: those that are not made of round numbers", ray_aslant},
        {"inside.ray-half-open", inside, "along x, edges half-open in the plane across, as of polygons",
         "Franklin's PNPOLY, carried over to space",
         "an edge's crossing is rounded otherwise from either of its triangles, and so is where the ray meets them",
         ray_half_open},
        {"inside.solid-angles", inside, "the sum of solid angles is over 2 pi",
         "Van Oosterom and Strackee 1983; generalized winding numbers",
         "within rounding of the surface, and of needles", solid_angles},
        {"inside.nearest-normal", inside, "behind the plane of the nearest triangle", "signed distance fields",
         "at edges and corners several triangles are nearest, and the plane of the first may have the point before it",
         nearest_normal},
        {"inside.exact", inside, "SurfaceLocator::locate", "barycert", "never", by_winding},
    };
}

}  // namespace barycert::audit
