// Whether two triangles in space have a point in common: what is in use, faults included.

#include <algorithm>
#include <cmath>

#include "barycert/audit/surfaces/rules.hpp"
#include "barycert/check.hpp"

namespace barycert::audit {
namespace {

using V = Vector<double>;
using Triangle = Corners<double>;

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

/// What the plane cuts out of a triangle, along an axis.
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
    const Triangle s = corners_from<double>(c.triangles[0]), t = corners_from<double>(c.triangles[1]);
    const auto of_t = heights(t, s, tolerance), of_s = heights(s, t, tolerance);
    if (one_side(of_t) || one_side(of_s)) return 0;
    if (of_t == std::array<double, 3>{}) return meet_in_plane(s, t, normal_of(s));
    const int axis = longest_axis(cross(normal_of(s), normal_of(t)));
    const auto a = interval(s, of_s, axis), b = interval(t, of_t, axis);
    return a[0] <= b[1] && b[0] <= a[1];
}

double edges_through(const SurfaceCase& c) {
    for (std::size_t i = 0; i < 2; ++i) {
        const Triangle s = corners_from<double>(c.triangles[i]), t = corners_from<double>(c.triangles[1 - i]);
        for (std::size_t k = 0; k < 3; ++k) {
            const double at = moller_trumbore(t, s[k], s[(k + 1) % 3] - s[k], 1e-8);
            if (at >= 0 && at <= 1) return 1;
        }
    }
    return 0;
}

double separating_axes(const SurfaceCase& c) {
    const std::array<Triangle, 2> both{corners_from<double>(c.triangles[0]), corners_from<double>(c.triangles[1])};
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

std::vector<SurfaceRule> meet_rules() {
    using enum SurfaceQuestion;
    return {
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
}

}  // namespace barycert::audit
