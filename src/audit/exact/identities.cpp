#include <CGAL/Gmpq.h>
#include <CGAL/Simple_cartesian.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>

#include "barycert/environment.hpp"
#include "barycert/oracle.hpp"
#include "barycert/simplex.hpp"

namespace barycert {

using namespace exact;

namespace {

using Rational = CGAL::Gmpq;
using Weights = std::array<Rational, 4>;
using Shares = std::array<Rational, 3>;
using Point = CGAL::Simple_cartesian<Rational>::Vector_3;  // from the origin

/// A point together with its weights at the vertices of the simplex.
struct Weighted {
    Point at;
    Weights weights;
};

constexpr int the_point = -1;

/// A vertex, or the point; in the plane with that z.
Point place(const Case& c, int i, int z = 0) {
    const auto x = [&](int axis) {
        return Rational(i == the_point ? c.point[static_cast<std::size_t>(axis)] : c.vertex(i, axis));
    };
    return {x(0), x(1), space_dimension(c.simplex) == 3 ? x(2) : Rational(z)};
}

Weighted vertex(const Case& c, int i) {
    Weighted v{place(c, i), {}};
    v.weights[static_cast<std::size_t>(i)] = Rational(1);
    return v;
}

/// The point of the line ab whose coordinate `axis` is `level`; nothing if the line is parallel to that level, or there
/// is no a or b.
std::optional<Weighted> along(const std::optional<Weighted>& a, const std::optional<Weighted>& b, int axis,
                              const Rational& level) {
    if (!a || !b || a->at[axis] == b->at[axis]) return std::nullopt;
    const Rational t = (level - a->at[axis]) / (b->at[axis] - a->at[axis]);
    Weighted r{a->at + t * (b->at - a->at), {}};
    for (std::size_t k = 0; k < 4; ++k) r.weights[k] = a->weights[k] + t * (b->weights[k] - a->weights[k]);
    return r;
}

/// Ratios of signed areas or volumes: replace each vertex by the point. A triangle is lifted to the plane z = 1.
std::optional<Weights> ratios(const Case& c) {
    const bool planar = c.simplex == Simplex::triangle;
    const int count = vertex_count(c.simplex);
    const auto volume = [&](int replaced) {
        const auto v = [&](int i) { return place(c, i == replaced ? the_point : i, 1); };
        return planar ? CGAL::determinant(v(0), v(1), v(2)) : CGAL::determinant(v(1) - v(0), v(2) - v(0), v(3) - v(0));
    };
    constexpr int none = 4;
    const Rational whole = volume(none);
    if (whole == Rational(0)) return std::nullopt;
    Weights w{};
    for (int i = 0; i < count; ++i) w[static_cast<std::size_t>(i)] = volume(i) / whole;
    return w;
}

/// Weights of a point in the plane of a triangle, by signed areas; `normal` is the cross product of its edges, not
/// zero.
Shares areas(const std::array<Point, 3>& v, const Point& normal, const Point& at) {
    Shares w;
    for (std::size_t i = 0; i < 3; ++i) {
        const Point &a = v[(i + 1) % 3], &b = v[(i + 2) % 3];
        w[i] = normal * CGAL::cross_product(b - a, at - a) / normal.squared_length();
    }
    return w;
}

/// As the projection has it: alpha_i in the window, 1/Z = sum alpha_i / w_i, beta_i = Z alpha_i / w_i.
std::optional<Shares> by_depths(const Case& c) {
    std::array<Point, 3> v;
    for (int i = 0; i < 3; ++i) v[static_cast<std::size_t>(i)] = place(c, i, 1);
    const Point normal = CGAL::cross_product(v[1] - v[0], v[2] - v[0]);
    if (normal.z() == Rational(0)) return std::nullopt;
    Shares w = areas(v, normal, place(c, the_point, 1));
    Rational inverse(0);
    for (int i = 0; i < 3; ++i) {
        Rational& share = w[static_cast<std::size_t>(i)];
        share /= Rational(c.depth(i));
        inverse += share;
    }
    if (inverse == Rational(0)) return std::nullopt;
    for (Rational& share : w) share /= inverse;
    return w;
}

/// As the eye sees it: t ray with normal . (t ray - v_0) = 0.
std::optional<Shares> by_ray(const Case& c) {
    const Point ray = place(c, the_point, 1);
    std::array<Point, 3> v;
    for (int i = 0; i < 3; ++i) v[static_cast<std::size_t>(i)] = Rational(c.depth(i)) * place(c, i, 1);
    const Point normal = CGAL::cross_product(v[1] - v[0], v[2] - v[0]);
    // The distance is zero where the plane holds the eye: the triangle is seen edge-on, and has no area in the window.
    const Rational facing = normal * ray, distance = normal * v[0];
    if (facing == Rational(0) || distance == Rational(0)) return std::nullopt;
    return areas(v, normal, distance / facing * ray);
}

IdentityVerdict compare(const std::optional<Weighted>& found, const std::optional<Weights>& expected) {
    if (!found || !expected) return IdentityVerdict::undefined;
    return found->weights == *expected ? IdentityVerdict::holds : IdentityVerdict::fails;
}

}  // namespace

IdentityVerdict bilinear_is_barycentric(const Case& c) {
    const ExactEnvironment environment;
    const Point p = place(c, the_point);
    const auto expected = ratios(c);
    // The two sides meet in vertex i: three choices, of which at least one serves unless the point is level with a
    // vertex.
    for (int i = 0; i < 3; ++i) {
        const auto left = along(vertex(c, i), vertex(c, (i + 1) % 3), 1, p[1]);
        const auto right = along(vertex(c, i), vertex(c, (i + 2) % 3), 1, p[1]);
        if (const auto found = along(left, right, 0, p[0])) return compare(found, expected);
    }
    return IdentityVerdict::undefined;
}

IdentityVerdict trilinear_is_barycentric(const Case& c) {
    const ExactEnvironment environment;
    const Point p = place(c, the_point);
    const auto expected = ratios(c);
    // Edges from apex o to a, b, d; segments in the faces oab and oad; any order of vertices that has no parallels.
    std::array<int, 4> order{0, 1, 2, 3};
    do {
        const auto [o, a, b, d] = order;
        const auto on_a = along(vertex(c, o), vertex(c, a), 2, p[2]);
        const auto on_b = along(vertex(c, o), vertex(c, b), 2, p[2]);
        const auto on_d = along(vertex(c, o), vertex(c, d), 2, p[2]);
        const auto left = along(on_a, on_b, 1, p[1]);
        const auto right = along(on_a, on_d, 1, p[1]);
        if (const auto found = along(left, right, 0, p[0])) return compare(found, expected);
    } while (std::next_permutation(order.begin(), order.end()));
    return IdentityVerdict::undefined;
}

IdentityVerdict perspective_is_ray_casting(const Case& c) {
    const ExactEnvironment environment;
    const auto depths = by_depths(c), ray = by_ray(c);
    if (depths.has_value() != ray.has_value()) return IdentityVerdict::fails;
    if (!depths) return IdentityVerdict::undefined;
    return *depths == *ray ? IdentityVerdict::holds : IdentityVerdict::fails;
}

}  // namespace barycert
