/// What calls and batches require of their input, as Errors.
#pragma once

#include <algorithm>
#include <cmath>

#include "barycert/base/finite.hpp"
#include "barycert/base/strict_math.hpp"
#include "barycert/result.hpp"
#include "barycert/simplex.hpp"

namespace barycert::core {

/// All cells of a mesh, a batch without points: vertex i of cell j is node corners[n * j + i].
struct MeshCells {
    Simplex simplex;
    std::span<const double> nodes;
    std::span<const std::int32_t> corners;

    std::size_t count() const { return corners.size() / static_cast<std::size_t>(vertex_count(simplex)); }
};

inline Error size_error(const char* what, const std::string& expected, std::size_t found) {
    return {.what = what, .expected = expected, .found = std::to_string(found)};
}

/// Sizes that must fit together do. Indices are not looked at: that would cost as much as the answers.
inline Status check_output(std::size_t places, std::size_t per_case, std::size_t count, const char* what) {
    if (places == per_case * count) return Done{};
    return size_error("size of the output",
                      std::to_string(per_case) + " for each of " + std::to_string(count) + " " + what + "s", places);
}
inline Status check_sizes(const CaseArrays& cases, std::size_t places, std::size_t per_case) {
    return check_output(places, per_case, cases.count, "case");
}
inline Status check_sizes(const MeshQueries& q, std::size_t places, std::size_t per_case) {
    const auto d = static_cast<std::size_t>(space_dimension(q.simplex));
    if (q.points.size() != d * q.cells.size())
        return size_error("size of the points",
                          std::to_string(d) + " coordinates for each of " + std::to_string(q.cells.size()) + " queries",
                          q.points.size());
    return check_output(places, per_case, q.count(), "case");
}
inline Status check_sizes(const MeshCells& cells, std::size_t places, std::size_t per_case) {
    const auto n = static_cast<std::size_t>(vertex_count(cells.simplex));
    if (cells.corners.size() % n != 0)
        return size_error("size of the corners", "a multiple of " + std::to_string(n), cells.corners.size());
    return check_output(places, per_case, cells.count(), "cell");
}

inline Status check_components(int components) {
    if (components >= 1) return Done{};
    return Error{.what = "number of components", .expected = "at least 1", .found = std::to_string(components)};
}

/// The simplex fills its space. `what` names what is asked for.
inline Status check_fills_space(Simplex s, const std::string& what) {
    if (s == Simplex::triangle || s == Simplex::tetrahedron) return Done{};
    return Error{.what = "unsupported simplex for " + what,
                 .expected = "triangle or tetrahedron",
                 .found = std::string(name(s))};
}

inline bool all_finite(const double* x, int count) {
    return std::all_of(x, x + count, [](double v) { return std::isfinite(v); });
}

/// `point` may be null.
inline bool all_finite(Simplex s, const double* vertices, const double* point) {
    return all_finite(vertices, space_dimension(s) * vertex_count(s)) &&
           (point == nullptr || all_finite(point, space_dimension(s)));
}

/// Names the first coordinate that is not finite. Precondition: there is one. `which` goes before it.
inline Error not_finite_error(Simplex s, const double* vertices, const double* point, const std::string& which = {}) {
    const auto d = static_cast<std::size_t>(space_dimension(s)), all = d * static_cast<std::size_t>(vertex_count(s));
    if (const std::size_t i = base::first_not_finite({vertices, all}); i < all)
        return base::not_finite(which + "coordinate " + std::to_string(i % d) + " of vertex " + std::to_string(i / d),
                                vertices[i]);
    const std::size_t k = base::first_not_finite({point, d});
    return base::not_finite(which + "coordinate " + std::to_string(k) + " of the point", point[k]);
}

}  // namespace barycert::core
