/// Coordinates and values at the full spread of exponents, where integers are widest, and every call of the exact core
/// that they can be given to. For what is measured there: stack (stack_test.cpp) and time (bench/extremes_bench.cpp).
#pragma once

#include <cmath>
#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "barycert/barycert.hpp"
#include "core/base/random.hpp"

namespace barycert::testing_extremes {

struct Extreme {
    double points[6][3];
    double values[10];
};

/// Exponents of numbers with 53 significant bits.
struct Spread {
    int low, high;
};
inline constexpr Spread full_spread{-1022, 1023}, two_limbs{-36, 36};

/// Beside the smallest numbers, beside the largest, or anywhere between them.
inline double extreme(base::Random& r, const Spread& spread) {
    const double significand = r.uniform(1, 2);
    const int kind = r.integer(0, 2), any = r.integer(spread.low, spread.high);
    const double x = std::ldexp(significand, kind == 0 ? spread.low : kind == 1 ? spread.high : any);
    return r.coin() ? -x : x;
}

inline std::vector<Extreme> extremes(std::size_t count, const Spread& spread = full_spread) {
    std::vector<Extreme> all(count);
    for (std::size_t i = 0; i < count; ++i) {
        base::Random r = base::Random::stream(9, base::hash64("extremes"), i);
        for (auto& point : all[i].points) {
            for (double& x : point) x = extreme(r, spread);
        }
        for (double& x : all[i].values) x = extreme(r, spread);
    }
    return all;
}

struct Call {
    std::string name;
    std::function<bool(const Extreme&)> ask;  ///< false: there was no answer
};

/// Where the point is: at points of its own, or at the first vertex, where no filter of signs can decide.
enum class Point { own, first };

/// A case of a simplex, vertices and point from the first numbers.
struct Numbers {
    Numbers(Simplex s, const Extreme& e, Point where) {
        const auto n = static_cast<std::size_t>(vertex_count(s)), d = static_cast<std::size_t>(space_dimension(s));
        for (std::size_t i = 0; i < n; ++i) {
            for (std::size_t k = 0; k < d; ++k) vertices[d * i + k] = e.points[i][k];
        }
        for (std::size_t k = 0; k < d; ++k) point[k] = e.points[where == Point::own ? n : 0][k];
    }
    double vertices[12] = {}, point[3] = {};
};

inline void add_predicates(Point where, std::vector<Call>& calls) {
    const auto add = [&](const char* what, auto ask) {
        calls.push_back({what, [where, ask](const Extreme& e) {
                             return ask(e.points, [&](int i) { return e.points[where == Point::own ? i : 0]; });
                         }});
    };
    add("orient2d", [](const auto& p, auto last) { return checked_orient2d(p[0], p[1], last(2)).has_value(); });
    add("orient3d", [](const auto& p, auto last) { return checked_orient3d(p[0], p[1], p[2], last(3)).has_value(); });
    add("det3d",
        [](const auto& p, auto last) { return checked_det3d(p[0], p[1], p[2], p[3], last(4), last(5)).has_value(); });
    add("incircle", [](const auto& p, auto last) { return checked_incircle(p[0], p[1], p[2], last(3)).has_value(); });
    add("insphere",
        [](const auto& p, auto last) { return checked_insphere(p[0], p[1], p[2], p[3], last(4)).has_value(); });
}

inline void add_calls_of(Simplex s, Point where, std::vector<Call>& calls) {
    const auto add = [&](const char* what, std::function<bool(const Extreme&, const Numbers&)> ask) {
        calls.push_back({std::string(what) + ", " + std::string(name(s)),
                         [s, where, ask = std::move(ask)](const Extreme& e) { return ask(e, Numbers(s, e, where)); }});
    };
    add("weight_signs",
        [s](const Extreme&, const Numbers& c) { return checked_weight_signs(s, c.vertices, c.point).has_value(); });
    add("barycentric_weights",
        [s](const Extreme&, const Numbers& c) { return barycentric_weights(s, c.vertices, c.point).has_value(); });
    add("interpolate",
        [s](const Extreme& e, const Numbers& c) { return interpolate(s, c.vertices, c.point, e.values).has_value(); });
    add("point_from_weights", [s](const Extreme& e, const Numbers& c) {
        double point[3];
        return point_from_weights(s, c.vertices, e.values, point).has_value();
    });
    if (s != Simplex::triangle && s != Simplex::tetrahedron) return;
    add("gradient", [s](const Extreme& e, const Numbers& c) { return gradient(s, c.vertices, e.values).has_value(); });
    add("interpolate_quadratic", [s](const Extreme& e, const Numbers& c) {
        return interpolate_quadratic(s, c.vertices, c.point, e.values).has_value();
    });
    add("condition_number",
        [s](const Extreme&, const Numbers& c) { return !std::isnan(condition_number(s, c.vertices)); });
}

/// A triangle in a window: depths are magnitudes of third coordinates.
struct WindowTriangle {
    WindowTriangle(const Extreme& e, Point where) {
        for (std::size_t i = 0; i < 3; ++i) {
            for (std::size_t k = 0; k < 3; ++k) vertices[3 * i + k] = e.points[i][k];
            double& w = vertices[3 * i + 2];
            w = w == 0 ? 1 : std::fabs(w);
        }
        for (std::size_t k = 0; k < 2; ++k) point[k] = e.points[where == Point::own ? 3 : 0][k];
    }
    double vertices[9] = {}, point[2] = {};
};

inline void add_perspective(Point where, std::vector<Call>& calls) {
    calls.push_back({"perspective_weights", [where](const Extreme& e) {
                         const WindowTriangle t(e, where);
                         return perspective_weights(t.vertices, t.point).has_value();
                     }});
    calls.push_back({"perspective_depth", [where](const Extreme& e) {
                         const WindowTriangle t(e, where);
                         return perspective_depth(t.vertices, t.point).has_value();
                     }});
    calls.push_back({"perspective_value", [where](const Extreme& e) {
                         const WindowTriangle t(e, where);
                         return perspective_value(t.vertices, t.point, e.values).has_value();
                     }});
}

/// Every single call.
inline std::vector<Call> single_calls(Point where = Point::own) {
    std::vector<Call> calls;
    add_predicates(where, calls);
    for (const Simplex s : all_simplices) add_calls_of(s, where, calls);
    add_perspective(where, calls);
    calls.push_back({"parameter_of_value", [](const Extreme& e) {
                         return parameter_of_value(e.values[0], e.values[1], e.values[2]).has_value();
                     }});
    calls.push_back(
        {"point_of_value", [](const Extreme& e) {
             double point[3];
             return point_of_value(e.points[0], e.points[1], e.values[0], e.values[1], e.values[2], point).has_value();
         }});
    return calls;
}

/// Every batch, of one case in a mesh of one cell.
inline std::vector<Call> batch_calls() {
    std::vector<Call> calls;
    static constexpr std::int32_t corners[4] = {0, 1, 2, 3}, cell[1] = {0}, mid[6] = {4, 5, 6, 7, 8, 9};
    for (const Simplex s : all_simplices) {
        const auto n = static_cast<std::size_t>(vertex_count(s)), d = static_cast<std::size_t>(space_dimension(s));
        const auto add = [&](const char* what, auto ask) {
            calls.push_back({"batch of " + std::string(what) + ", " + std::string(name(s)), [=](const Extreme& e) {
                                 const Numbers c(s, e, Point::own);
                                 double nodes[30] = {};  // the mid-edge nodes lie anywhere
                                 std::copy_n(c.vertices, d * n, nodes);
                                 return ask(MeshQueries{s, {nodes, 10 * d}, {corners, n}, cell, {c.point, d}},
                                            NodalValues<double>{e.values, 1});
                             }});
        };
        add("weight_signs", [](const MeshQueries& q, const auto&) {
            WeightSigns out[1];
            return weight_signs(q, out).has_value();
        });
        add("barycentric_weights", [n](const MeshQueries& q, const auto&) {
            double out[4];
            return barycentric_weights(q, {out, n}).has_value();
        });
        add("interpolate", [](const MeshQueries& q, const auto& f) {
            double out[1];
            return interpolate(q, f, out).has_value();
        });
        if (s != Simplex::triangle && s != Simplex::tetrahedron) continue;
        add("interpolate_quadratic", [s](const MeshQueries& q, const auto& f) {
            double out[1];
            return interpolate_quadratic(q, {mid, static_cast<std::size_t>(mid_node_count(s))}, f, out).has_value();
        });
        add("gradients", [s, d](const MeshQueries& q, const auto& f) {
            double out[3];
            return gradients(s, q.nodes, q.corners, f, {out, d}).has_value();
        });
    }
    return calls;
}

}  // namespace barycert::testing_extremes
