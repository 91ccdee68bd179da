/// Simplices and cases as plain data: the types that every other folder exchanges.
///
/// Coordinates are doubles in whatever unit the mesh uses. Vertices are stored vertex after vertex:
/// vertex i of a simplex in d-space is v[d*i] ... v[d*i + d-1].
///
/// Example:
///
///     Case c{.simplex = Simplex::triangle, .vertices = {0, 0, 1, 0, 0, 1}, .point = {0.3, 0.3}, .values = {1, 2, 3}};
///     for (int i = 0; i < vertex_count(c.simplex); ++i) c.vertex(i, 0) += 10;
///     const std::string_view what = name(c.simplex);  // "triangle"
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

namespace barycert {

/// The simplices that barycert knows. `triangle` lies in the plane, `triangle3d` and `segment` in 3-space,
/// where a point off their plane or line stands for its orthogonal projection.
enum class Simplex : std::uint8_t { segment, triangle, triangle3d, tetrahedron };

inline constexpr std::array<Simplex, 4> all_simplices{Simplex::segment, Simplex::triangle, Simplex::triangle3d,
                                                      Simplex::tetrahedron};

/// Number of vertices, and so of barycentric weights: 2, 3, 3, 4.
constexpr int vertex_count(Simplex s) {
    return s == Simplex::segment ? 2 : s == Simplex::tetrahedron ? 4 : 3;
}

/// Number of coordinates of a vertex or point: 3, 2, 3, 3.
constexpr int space_dimension(Simplex s) {
    return s == Simplex::triangle ? 2 : 3;
}

constexpr std::string_view name(Simplex s) {
    constexpr std::array<std::string_view, 4> names{"segment", "triangle", "triangle3d", "tetrahedron"};
    return names[static_cast<std::size_t>(s)];
}

/// f.operator()<s>() for a simplex s that is known when compiling: the one place where it is told.
template <class F>
constexpr decltype(auto) with_simplex(Simplex s, F&& f) {
    switch (s) {
        case Simplex::segment:
            return f.template operator()<Simplex::segment>();
        case Simplex::triangle:
            return f.template operator()<Simplex::triangle>();
        case Simplex::triangle3d:
            return f.template operator()<Simplex::triangle3d>();
        default:
            return f.template operator()<Simplex::tetrahedron>();
    }
}

/// The simplex of that name, or nothing.
constexpr std::optional<Simplex> simplex_named(std::string_view text) {
    for (const Simplex s : all_simplices) {
        if (name(s) == text) return s;
    }
    return std::nullopt;
}

/// One question to a kernel: a simplex, a point and a value at each vertex. Unused entries are zero.
struct Case {
    Simplex simplex = Simplex::tetrahedron;
    std::array<double, 12> vertices{};
    std::array<double, 3> point{};
    std::array<double, 4> values{};
    bool perspective = false;  ///< a triangle whose vertices are x, y, w: see perspective.hpp

    /// Numbers of a vertex in `vertices`: its coordinates and, for perspective, its depth w > 0.
    int stride() const { return space_dimension(simplex) + (perspective ? 1 : 0); }

    double vertex(int i, int axis) const { return vertices[static_cast<std::size_t>(stride() * i + axis)]; }
    double& vertex(int i, int axis) { return vertices[static_cast<std::size_t>(stride() * i + axis)]; }

    /// The w of a vertex. Requires: perspective.
    double depth(int i) const { return vertex(i, 2); }
    double& depth(int i) { return vertex(i, 2); }
};

/// Where a point lies with respect to a closed simplex; `degenerate` is said of the simplex itself.
enum class Region : std::uint8_t { interior, boundary, outside, degenerate };

inline constexpr std::array<Region, 4> all_regions{Region::interior, Region::boundary, Region::outside,
                                                   Region::degenerate};

constexpr std::string_view name(Region r) {
    constexpr std::array<std::string_view, 4> names{"interior", "boundary", "outside", "degenerate"};
    return names[static_cast<std::size_t>(r)];
}

/// The open face of lowest dimension that holds the point. For a triangle "face" is never used: its sides are edges.
enum class Feature : std::uint8_t { interior, face, edge, vertex, outside, degenerate };

constexpr std::string_view name(Feature f) {
    constexpr std::array<std::string_view, 6> names{"interior", "face", "edge", "vertex", "outside", "degenerate"};
    return names[static_cast<std::size_t>(f)];
}

// How many cases lie in memory for one call.

/// `count` independent cases in structure of arrays. With d = space_dimension(simplex), coordinate k of vertex i of
/// case j is vertices[d * i + k][j] and that of its point is point[k][j]. The caller owns the arrays; they must live
/// until the call returns.
struct CaseArrays {
    Simplex simplex = Simplex::tetrahedron;
    std::size_t count = 0;
    std::array<const double*, 12> vertices{};
    std::array<const double*, 3> point{};
};

/// Points against cells of a mesh. Case j is cell cells[j] with the point at points[d * j]; its vertex i is node
/// corners[n * cells[j] + i], with coordinates nodes[d * node ...], n = vertex_count(simplex),
/// d = space_dimension(simplex). Requires every index in range: indices are not checked.
struct MeshQueries {
    Simplex simplex = Simplex::tetrahedron;
    std::span<const double> nodes;
    std::span<const std::int32_t> corners;
    std::span<const std::int32_t> cells;
    std::span<const double> points;

    std::size_t count() const { return cells.size(); }
};

/// Nodal values for CaseArrays, T double or float: component c at vertex i of case j is at[i][components * j + c].
template <class T>
struct ValueArrays {
    std::array<const T*, 4> at{};
    int components = 1;
};

/// Nodal values of a mesh, T double or float: component c at node k is data[components * k + c]. A float is converted
/// to double, which is exact.
template <class T>
struct NodalValues {
    std::span<const T> data;
    int components = 1;
};

// Which tier of arithmetic decided an answer.

/// From cheap to expensive. A tier answers only what its error bound proves; what it leaves undecided goes to the next.
enum class Tier : std::uint8_t {
    filter,         ///< double, with a bound on the error of the determinant
    double_double,  ///< double + correction, with a bound on the error of their sum
    exact,          ///< integers
};

constexpr std::string_view name(Tier t) {
    return t == Tier::filter ? "filter" : t == Tier::double_double ? "double-double" : "exact";
}

/// How many cases each tier decided. Functions add to the counts they are given; one that returns an Error leaves them
/// unchanged.
struct TierCounts {
    std::uint64_t filter = 0;
    std::uint64_t double_double = 0;
    std::uint64_t exact = 0;
    std::uint64_t degenerate = 0;  ///< cases, of those above, whose simplex is degenerate
    std::uint64_t not_finite = 0;  ///< cases, of those above, with a NaN or infinite nodal value that takes part

    std::uint64_t cases() const { return filter + double_double + exact; }
    void add(Tier t, std::uint64_t count = 1) {
        (t == Tier::filter ? filter : t == Tier::double_double ? double_double : exact) += count;
    }
    void add(const TierCounts& other) {
        filter += other.filter;
        double_double += other.double_double;
        exact += other.exact;
        degenerate += other.degenerate;
        not_finite += other.not_finite;
    }
    friend bool operator==(const TierCounts&, const TierCounts&) = default;
};

}  // namespace barycert
