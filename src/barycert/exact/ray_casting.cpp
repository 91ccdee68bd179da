#include "barycert/oracle.hpp"

#include <CGAL/Gmpq.h>

#include <array>
#include <optional>

#include "barycert/environment.hpp"

namespace barycert {
namespace {

using Fraction = CGAL::Gmpq;
using Triple = std::array<Fraction, 3>;

Triple minus(const Triple& a, const Triple& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

Triple cross_product(const Triple& a, const Triple& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Fraction dot_product(const Triple& a, const Triple& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// Weights of a point in the plane of a triangle, by signed areas; `normal` is the cross product of its edges, not
/// zero.
Triple areas(const std::array<Triple, 3>& v, const Triple& normal, const Triple& at) {
    Triple w;
    for (std::size_t i = 0; i < 3; ++i) {
        const Triple &a = v[(i + 1) % 3], &b = v[(i + 2) % 3];
        w[i] = dot_product(normal, cross_product(minus(b, a), minus(at, a))) / dot_product(normal, normal);
    }
    return w;
}

/// As the projection has it: alpha_i in the window, 1/Z = sum alpha_i / w_i, beta_i = Z alpha_i / w_i.
std::optional<Triple> by_depths(const Case& c) {
    std::array<Triple, 3> v;
    for (int i = 0; i < 3; ++i)
        v[static_cast<std::size_t>(i)] = {Fraction(c.vertex(i, 0)), Fraction(c.vertex(i, 1)), Fraction(1)};
    const Triple normal = cross_product(minus(v[1], v[0]), minus(v[2], v[0]));
    if (normal[2] == Fraction(0)) return std::nullopt;
    Triple w = areas(v, normal, {Fraction(c.point[0]), Fraction(c.point[1]), Fraction(1)});
    Fraction inverse(0);
    for (int i = 0; i < 3; ++i) {
        Fraction& share = w[static_cast<std::size_t>(i)];
        share /= Fraction(c.depth(i));
        inverse += share;
    }
    if (inverse == Fraction(0)) return std::nullopt;
    for (Fraction& share : w) share /= inverse;
    return w;
}

/// As the eye sees it: t ray with normal . (t ray - v_0) = 0.
std::optional<Triple> by_ray(const Case& c) {
    const Triple ray{Fraction(c.point[0]), Fraction(c.point[1]), Fraction(1)};
    std::array<Triple, 3> v;
    for (int i = 0; i < 3; ++i) {
        const Fraction w(c.depth(i));
        v[static_cast<std::size_t>(i)] = {Fraction(c.vertex(i, 0)) * w, Fraction(c.vertex(i, 1)) * w, w};
    }
    const Triple normal = cross_product(minus(v[1], v[0]), minus(v[2], v[0]));
    // The distance is zero where the plane holds the eye: the triangle is seen edge-on, and has no area in the window.
    const Fraction facing = dot_product(normal, ray), distance = dot_product(normal, v[0]);
    if (facing == Fraction(0) || distance == Fraction(0)) return std::nullopt;
    const Fraction t = distance / facing;
    return areas(v, normal, {t * ray[0], t * ray[1], t * ray[2]});
}

}  // namespace

IdentityVerdict perspective_is_ray_casting(const Case& c) {
    const ExactEnvironment environment;
    const auto depths = by_depths(c), ray = by_ray(c);
    if (depths.has_value() != ray.has_value()) return IdentityVerdict::fails;
    if (!depths) return IdentityVerdict::undefined;
    return *depths == *ray ? IdentityVerdict::holds : IdentityVerdict::fails;
}

}  // namespace barycert
