// The rules on triangles in space that are in use, faults included.

#include "barycert/surface_rules.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <vector>

#include "audit/kernels/space_formulas.hpp"
#include "audit/kernels/vectors.hpp"
#include "barycert/certificate.hpp"
#include "barycert/check.hpp"
#include "barycert/defect.hpp"
#include "barycert/mesh.hpp"
#include "barycert/surface.hpp"
#include "barycert/surface_locator.hpp"

namespace barycert {

using namespace audit;

namespace {

template <class T>
using Vector = kernels::Vector3<T>;
template <class T>
using Corners = std::array<Vector<T>, 3>;
using V = Vector<double>;
using Triangle = Corners<double>;

template <class T = double>
Vector<T> vector_from(const double* x) {
    return {static_cast<T>(x[0]), static_cast<T>(x[1]), static_cast<T>(x[2])};
}

template <class T = double>
Corners<T> corners_from(const TriangleInSpace& t) {
    return {vector_from<T>(&t[0]), vector_from<T>(&t[3]), vector_from<T>(&t[6])};
}

template <class T = double>
Vector<T> point_of(const SurfaceCase& c) {
    return vector_from<T>(c.point.data());
}

template <class T>
T length(Vector<T> v) {
    return std::sqrt(dot(v, v));
}

template <class T>
Vector<T> along(Vector<T> a, Vector<T> b, T t) {
    return {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y), a.z + t * (b.z - a.z)};
}

V normal_of(const Triangle& t) {
    return cross(t[1] - t[0], t[2] - t[0]);
}

/// The triangles as they are, no node shared.
Surface surface_of(const SurfaceCase& c) {
    Surface s;
    for (const TriangleInSpace& t : c.triangles) {
        s.points.insert(s.points.end(), t.begin(), t.end());
        for (int k = 0; k < 3; ++k) s.cells.push_back(static_cast<Mesh::Index>(s.cells.size()));
    }
    return s;
}

// How far a point is from a triangle.

double to_segment(V p, V a, V b) {
    return length(p - along(a, b, std::clamp(dot(p - a, b - a) / dot(b - a, b - a), 0.0, 1.0)));
}

double clamped_weights(const SurfaceCase& c) {
    const double* const t = c.triangles[0].data();
    std::array<double, 3> w{}, at{};
    kernels::gram(t, c.point.data(), w.data());
    for (double& x : w) x = std::max(x, 0.0);
    const double sum = w[0] + w[1] + w[2];
    for (std::size_t k = 0; k < 3; ++k) at[k] = (w[0] * t[k] + w[1] * t[3 + k] + w[2] * t[6 + k]) / sum;
    return length(point_of(c) - vector_from(at.data()));
}

double edges_or_plane(const SurfaceCase& c) {
    const Triangle t = corners_from(c.triangles[0]);
    const V p = point_of(c), n = normal_of(t);
    for (std::size_t k = 0; k < 3; ++k) {
        if (dot(cross(n, t[(k + 1) % 3] - t[k]), p - t[k]) < 0)
            return std::min({to_segment(p, t[0], t[1]), to_segment(p, t[1], t[2]), to_segment(p, t[2], t[0])});
    }
    return std::fabs(dot(n, p - t[0])) / length(n);
}

/// |a + s e + t f - p|^2 as a polynomial of s and t, least in the triangle.
double quadratic_form(const SurfaceCase& c) {
    const Triangle t = corners_from(c.triangles[0]);
    const V e = t[1] - t[0], f = t[2] - t[0], g = t[0] - point_of(c);
    const double ee = dot(e, e), ef = dot(e, f), ff = dot(f, f), eg = dot(e, g), fg = dot(f, g), gg = dot(g, g);
    const auto at = [&](double s, double r) { return s * (ee * s + 2 * ef * r + 2 * eg) + r * (ff * r + 2 * fg) + gg; };
    const auto root = [](double square) { return std::sqrt(std::max(square, 0.0)); };
    const double det = ee * ff - ef * ef, s = (ef * fg - ff * eg) / det, r = (ef * eg - ee * fg) / det;
    if (s >= 0 && r >= 0 && s + r <= 1) return root(at(s, r));
    const double on_e = std::clamp(-eg / ee, 0.0, 1.0), on_f = std::clamp(-fg / ff, 0.0, 1.0);
    const double across = std::clamp((ff + fg - ef - eg) / (ee - 2 * ef + ff), 0.0, 1.0);
    return root(std::min({at(on_e, 0), at(0, on_f), at(across, 1 - across)}));
}

/// From corner to corner, edge to edge, face: the first region of Voronoi that dot products say holds the point.
template <class T>
T by_regions(const Corners<T>& t, Vector<T> p) {
    std::array<T, 3> areas{};  // of the part opposite to the corner
    for (std::size_t k = 0; k < 3; ++k) {
        const auto &a = t[k], &b = t[(k + 1) % 3], &c = t[(k + 2) % 3];
        if (dot(b - a, p - a) <= 0 && dot(c - a, p - a) <= 0) return length(p - a);
        areas[(k + 2) % 3] = dot(b - a, p - a) * dot(c - a, p - b) - dot(b - a, p - b) * dot(c - a, p - a);
    }
    for (std::size_t k = 0; k < 3; ++k) {
        const auto &a = t[k], &b = t[(k + 1) % 3];
        const T from_a = dot(b - a, p - a), from_b = dot(a - b, p - b);
        if (areas[(k + 2) % 3] <= 0 && from_a >= 0 && from_b >= 0)
            return length(p - along(a, b, from_a / (from_a + from_b)));
    }
    const T whole = areas[0] + areas[1] + areas[2];
    const auto v = t[1] - t[0], w = t[2] - t[0];
    const T s = areas[1] / whole, r = areas[2] / whole;
    return length(p - Vector<T>{t[0].x + s * v.x + r * w.x, t[0].y + s * v.y + r * w.y, t[0].z + s * v.z + r * w.z});
}

template <class T>
double regions(const SurfaceCase& c) {
    return by_regions(corners_from<T>(c.triangles[0]), point_of<T>(c));
}

double by_locator(const SurfaceCase& c) {
    const Surface surface = surface_of(c);
    return SurfaceLocator::build(surface, {.threads = 1}).value().nearest(c.point.data(), HUGE_VAL).value().distance;
}

// Whether a point is inside a closed surface.

/// Where the ray p + t d meets the triangle: t, or NaN. A determinant within `tolerance` counts as parallel.
double moller_trumbore(const Triangle& t, V p, V d, double tolerance) {
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    const auto e = t[1] - t[0], f = t[2] - t[0], h = cross(d, f), s = p - t[0], q = cross(s, e);
    const double det = dot(e, h);
    if (std::fabs(det) <= tolerance) return none;
    const double u = dot(s, h) / det, v = dot(d, q) / det;
    return u < 0 || v < 0 || u + v > 1 ? none : dot(f, q) / det;
}

template <class Crosses>
bool odd(const SurfaceCase& c, const Crosses& crosses) {
    const V p = point_of(c);
    bool is_odd = false;
    for (const TriangleInSpace& t : c.triangles) is_odd = is_odd != crosses(corners_from(t), p);
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
    const V p = point_of(c);
    double sum = 0;
    for (const TriangleInSpace& triangle : c.triangles) {
        Triangle t = corners_from(triangle);
        for (V& corner : t) corner = corner - p;
        const double a = length(t[0]), b = length(t[1]), d = length(t[2]);
        sum += std::atan2(kernels::determinant(t[0], t[1], t[2]),
                          a * b * d + dot(t[0], t[1]) * d + dot(t[1], t[2]) * a + dot(t[2], t[0]) * b);
    }
    return std::fabs(sum) > std::numbers::pi;
}

double nearest_normal(const SurfaceCase& c) {
    const V p = point_of(c);
    double least = HUGE_VAL, height = 0;
    for (const TriangleInSpace& triangle : c.triangles) {
        const Triangle t = corners_from(triangle);
        const double distance = by_regions(t, p);
        if (!(distance < least)) continue;
        least = distance;
        height = dot(normal_of(t), p - t[0]);
    }
    return height < 0;
}

double by_winding(const SurfaceCase& c) {
    const Surface surface = surface_of(c);
    return SurfaceLocator::build(surface, {.threads = 1}).value().locate(c.point.data()).value().winding != 0;
}

// Whether two triangles have a point in common.

double coordinate(V v, int axis) {
    return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}

int longest_axis(V v) {
    const double x = std::fabs(v.x), y = std::fabs(v.y), z = std::fabs(v.z);
    return x >= y && x >= z ? 0 : y >= z ? 1 : 2;
}

/// In one plane: an edge crosses another one, or a corner is in the other triangle.
bool meet_in_plane(const Triangle& s, const Triangle& t, V normal) {
    const int drop = longest_axis(normal), i = (drop + 1) % 3, j = (drop + 2) % 3;
    const auto turn = [&](V a, V b, V c) {
        return (coordinate(b, i) - coordinate(a, i)) * (coordinate(c, j) - coordinate(a, j)) -
               (coordinate(b, j) - coordinate(a, j)) * (coordinate(c, i) - coordinate(a, i));
    };
    const auto holds = [&](const Triangle& of, V p) {
        const double a = turn(of[0], of[1], p), b = turn(of[1], of[2], p), c = turn(of[2], of[0], p);
        return (a >= 0 && b >= 0 && c >= 0) || (a <= 0 && b <= 0 && c <= 0);
    };
    for (std::size_t k = 0; k < 3; ++k) {
        const V a = s[k], b = s[(k + 1) % 3];
        for (std::size_t l = 0; l < 3; ++l) {
            const V c = t[l], d = t[(l + 1) % 3];
            const double to_c = turn(a, b, c), to_d = turn(a, b, d);
            if (to_c != to_d && to_c * to_d <= 0 && turn(c, d, a) * turn(c, d, b) <= 0) return true;
        }
    }
    return holds(s, t[0]) || holds(t, s[0]);
}

/// Heights of t's corners over the plane of s, those within the tolerance as 0.
std::array<double, 3> heights(const Triangle& t, const Triangle& s, double tolerance) {
    std::array<double, 3> h{};
    const V n = normal_of(s);
    const double offset = -dot(n, s[0]);
    for (std::size_t k = 0; k < 3; ++k) {
        h[k] = dot(n, t[k]) + offset;
        if (std::fabs(h[k]) < tolerance) h[k] = 0;
    }
    return h;
}

bool one_side(const std::array<double, 3>& h) {
    return (h[0] > 0 && h[1] > 0 && h[2] > 0) || (h[0] < 0 && h[1] < 0 && h[2] < 0);
}

/// The interval, along an axis, that the plane cuts out of a triangle.
std::array<double, 2> interval(const Triangle& t, const std::array<double, 3>& h, int axis) {
    std::array<double, 2> cut{HUGE_VAL, -HUGE_VAL};
    const auto take = [&](double x) { cut = {std::min(cut[0], x), std::max(cut[1], x)}; };
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t l = (k + 1) % 3;
        const double a = coordinate(t[k], axis), b = coordinate(t[l], axis);
        if (h[k] == 0) take(a);
        if (h[k] * h[l] < 0) take(a + (b - a) * h[k] / (h[k] - h[l]));
    }
    return cut;
}

double intervals(const SurfaceCase& c, double tolerance) {
    const Triangle s = corners_from(c.triangles[0]), t = corners_from(c.triangles[1]);
    const auto of_t = heights(t, s, tolerance), of_s = heights(s, t, tolerance);
    if (one_side(of_t) || one_side(of_s)) return 0;
    if (of_t == std::array<double, 3>{}) return meet_in_plane(s, t, normal_of(s));
    const int axis = longest_axis(cross(normal_of(s), normal_of(t)));
    const auto a = interval(s, of_s, axis), b = interval(t, of_t, axis);
    return a[0] <= b[1] && b[0] <= a[1];
}

double edges_through(const SurfaceCase& c) {
    for (std::size_t i = 0; i < 2; ++i) {
        const Triangle s = corners_from(c.triangles[i]), t = corners_from(c.triangles[1 - i]);
        for (std::size_t k = 0; k < 3; ++k) {
            const double at = moller_trumbore(t, s[k], s[(k + 1) % 3] - s[k], 1e-8);
            if (at >= 0 && at <= 1) return 1;
        }
    }
    return 0;
}

double separating_axes(const SurfaceCase& c) {
    const std::array<Triangle, 2> both{corners_from(c.triangles[0]), corners_from(c.triangles[1])};
    const auto apart = [&](V axis) {
        std::array<double, 2> low{}, high{};
        for (std::size_t i = 0; i < 2; ++i) {
            const double x = dot(axis, both[i][0]), y = dot(axis, both[i][1]), z = dot(axis, both[i][2]);
            low[i] = std::min({x, y, z});
            high[i] = std::max({x, y, z});
        }
        return high[0] < low[1] || high[1] < low[0];
    };
    for (const Triangle& t : both) {
        if (apart(normal_of(t))) return 0;
        for (std::size_t k = 0; k < 3; ++k) {
            if (apart(cross(normal_of(t), t[(k + 1) % 3] - t[k]))) return 0;
            for (std::size_t l = 0; &t == both.data() && l < 3; ++l) {
                if (apart(cross(t[(k + 1) % 3] - t[k], both[1][(l + 1) % 3] - both[1][l]))) return 0;
            }
        }
    }
    return 1;
}

/// The check of surfaces takes common nodes for granted.
double by_check(const SurfaceCase& c) {
    const auto node = [&](std::size_t i, std::size_t k) {
        return std::array{c.triangles[i][3 * k], c.triangles[i][3 * k + 1], c.triangles[i][3 * k + 2]};
    };
    for (std::size_t k = 0; k < 9; ++k) {
        if (node(0, k / 3) == node(1, k % 3)) return 1;
    }
    return check_surface(surface_of(c), {.threads = 1}).find(DefectKind::self_intersection) != nullptr;
}

}  // namespace

const std::vector<SurfaceRule>& surface_rules() {
    using enum SurfaceQuestion;
    static const std::vector<SurfaceRule> all{
        {"distance.clamped-weights", distance, "weights of the projection; those below 0 become 0; the sum is made 1",
         "a usual shortcut",
         "beside an obtuse or thin corner the point it takes is not the nearest one; squares over- and underflow",
         clamped_weights},
        {"distance.edges-or-plane", distance, "|n.(p - a)| / |n| over the triangle, else the least of three segments",
         "signed distance fields of shaders", "the plane's distance cancels near the plane and overflows first",
         edges_or_plane},
        {"distance.quadratic-form", distance, "sqrt of |a + s e + t f - p|^2, a polynomial whose least value is sought",
         "Eberly, Distance Between Point and Triangle in 3D, in its first form",
         "near the triangle the terms cancel: half of the digits are lost", quadratic_form},
        {"distance.voronoi-regions", distance, "the region of a corner, edge or the face by dot products",
         "Ericson, Real-Time Collision Detection, section 5.1.5",
         "beside the triangle digits cancel, and far from the origin the nearest point is rounded; squares over- and "
         "underflow",
         regions<double>},
        {"distance.voronoi-regions.float32", distance, "the same in single precision", "games, GPUs",
         "as before, at 1e-7", regions<float>},
        {"distance.exact", distance, "SurfaceLocator::nearest", "barycert", "never: correctly rounded", by_locator},
        {"inside.ray-along-x", inside, "triangles that a ray along x crosses, by Moller and Trumbore, within 1e-8",
         "tutorials on ray casting", "a ray through an edge or corner counts two triangles, or none; small surfaces",
         ray_along_x},
        {"inside.ray-aslant", inside, "the same along a fixed slanting direction, without a tolerance",
         "mesh libraries", "within rounding of the surface, and of needles", ray_aslant},
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
        {"meet.intervals", meet,
         "what each plane cuts out of the other triangle, on their common line; heights within 1e-6 are 0",
         "Moller, A Fast Triangle-Triangle Intersection Test, 1997, with its tolerance",
         "small triangles are all in one plane; large ones touch unseen",
         [](const SurfaceCase& c) { return intervals(c, 1e-6); }},
        {"meet.intervals-no-tolerance", meet, "the same without a tolerance", "the same",
         "where triangles touch, or lie in one plane that is not made of round numbers",
         [](const SurfaceCase& c) { return intervals(c, 0); }},
        {"meet.edges-through", meet, "an edge of one meets the other, by Moller and Trumbore, within 1e-8",
         "the usual reduction to rays", "triangles in one plane, touching ones, small ones", edges_through},
        {"meet.separating-axes", meet, "no normal, no product of edges has them apart",
         "Gottschalk, Lin and Manocha 1996", "touching triangles come apart by rounding; nearly parallel edges",
         separating_axes},
        {"meet.exact", meet, "check_surface, and common nodes", "barycert", "never", by_check},
    };
    return all;
}

}  // namespace barycert
