// How far a point is from a triangle in space: what is in use, faults included.

#include <algorithm>
#include <cmath>

#include "barycert/audit/surfaces/rules.hpp"
#include "barycert/surface_locator.hpp"

namespace barycert::audit {
namespace {

using V = Vector<double>;

double length(V v) {
    return std::sqrt(dot(v, v));
}

double to_segment(V p, V a, V b) {
    return length(p - along(a, b, std::clamp(dot(p - a, b - a) / dot(b - a, b - a), 0.0, 1.0)));
}

double to_edges(V p, const Corners<double>& t) {
    return std::min({to_segment(p, t[0], t[1]), to_segment(p, t[1], t[2]), to_segment(p, t[2], t[0])});
}

double clamped_weights(const SurfaceCase& c) {
    const double* const t = c.triangles[0].data();
    std::array<double, 3> w{}, at{};
    kernels::gram(t, c.point.data(), w.data());
    for (double& x : w) x = std::max(x, 0.0);
    const double sum = w[0] + w[1] + w[2];
    for (std::size_t k = 0; k < 3; ++k) at[k] = (w[0] * t[k] + w[1] * t[3 + k] + w[2] * t[6 + k]) / sum;
    return length(vector_from<double>(c.point.data()) - vector_from<double>(at.data()));
}

double edges_or_plane(const SurfaceCase& c) {
    const Corners<double> t = corners_from<double>(c.triangles[0]);
    const V p = vector_from<double>(c.point.data()), n = normal_of(t);
    for (std::size_t k = 0; k < 3; ++k) {
        if (dot(cross(n, t[(k + 1) % 3] - t[k]), p - t[k]) < 0) return to_edges(p, t);
    }
    return std::fabs(dot(n, p - t[0])) / length(n);
}

/// |a + s e + t f - p|^2 as a polynomial of s and t, least in the triangle.
double quadratic_form(const SurfaceCase& c) {
    const Corners<double> t = corners_from<double>(c.triangles[0]);
    const V e = t[1] - t[0], f = t[2] - t[0], g = t[0] - vector_from<double>(c.point.data());
    const double ee = dot(e, e), ef = dot(e, f), ff = dot(f, f), eg = dot(e, g), fg = dot(f, g), gg = dot(g, g);
    const auto at = [&](double s, double r) { return s * (ee * s + 2 * ef * r + 2 * eg) + r * (ff * r + 2 * fg) + gg; };
    const auto root = [](double square) { return std::sqrt(std::max(square, 0.0)); };
    const double det = ee * ff - ef * ef, s = (ef * fg - ff * eg) / det, r = (ef * eg - ee * fg) / det;
    if (s >= 0 && r >= 0 && s + r <= 1) return root(at(s, r));
    const double on_e = std::clamp(-eg / ee, 0.0, 1.0), on_f = std::clamp(-fg / ff, 0.0, 1.0);
    const double across = std::clamp((ff + fg - ef - eg) / (ee - 2 * ef + ff), 0.0, 1.0);
    return root(std::min({at(on_e, 0), at(0, on_f), at(across, 1 - across)}));
}

template <class T>
double regions(const SurfaceCase& c) {
    return by_regions(corners_from<T>(c.triangles[0]), vector_from<T>(c.point.data()));
}

double by_locator(const SurfaceCase& c) {
    const Surface surface = surface_of(c);
    return SurfaceLocator::build(surface, {.threads = 1}).value().nearest(c.point.data(), HUGE_VAL).value().distance;
}

}  // namespace

Surface surface_of(const SurfaceCase& c) {
    Surface s;
    for (const TriangleInSpace& t : c.triangles) {
        s.points.insert(s.points.end(), t.begin(), t.end());
        for (int k = 0; k < 3; ++k) s.cells.push_back(static_cast<Mesh::Index>(s.cells.size()));
    }
    return s;
}

std::vector<SurfaceRule> distance_rules() {
    using enum SurfaceQuestion;
    return {
        {"distance.clamped-weights", distance, "weights of the projection; those below 0 become 0; the sum is made 1",
         "a usual shortcut", "beside an obtuse or thin corner the point it takes is not the nearest one",
         clamped_weights},
        {"distance.edges-or-plane", distance, "|n.(p - a)| / |n| over the triangle, else the least of three segments",
         "signed distance fields of shaders", "the plane's distance cancels near the plane and overflows first",
         edges_or_plane},
        {"distance.quadratic-form", distance, "sqrt of |a + s e + t f - p|^2, a polynomial whose least value is sought",
         "Eberly, Distance Between Point and Triangle in 3D, in its first form",
         "near the triangle the terms cancel: half of the digits are lost, and more far from the origin",
         quadratic_form},
        {"distance.voronoi-regions", distance, "the region of a corner, edge or the face by dot products",
         "Ericson, Real-Time Collision Detection, section 5.1.5",
         "of needles and far from the origin the region is a neighbour's; squares over- and underflow",
         regions<double>},
        {"distance.voronoi-regions.float32", distance, "the same in single precision", "games, GPUs",
         "as before, at 1e-7", regions<float>},
        {"distance.exact", distance, "SurfaceLocator::nearest", "barycert", "never: correctly rounded", by_locator},
    };
}

}  // namespace barycert::audit
