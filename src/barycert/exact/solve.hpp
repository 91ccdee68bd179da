/// Numerators and denominator of the exact weights, for any set of integer types.
///
/// Bounds for the narrow types. Every coordinate, relative to its axis' scale, is below 2^61 in magnitude (the caller
/// checks), so differences are below 2^62, products of two below 2^124, 2x2 minors below 2^125 and thus within Int128;
/// n_i of a tetrahedron below 3 * 2^62 * 2^125 < 2^189, of a triangle3d below 3 * 2^250 < 2^252, of a segment below
/// 3 * 2^124. Perspective multiplies those of a triangle, below 2^125, by two depths: below 2^247, three of them below
/// 2^249. A value numerator adds 61 + 2 bits. Quotients are shifted by at most the length of the denominator plus 56
/// bits. All this stays below 512 bits.
#pragma once

#include <algorithm>

#include "barycert/exact/integers.hpp"
#include "barycert/simplex.hpp"

namespace barycert::exact {

struct Narrow {
    using Coordinate = std::int64_t;
    using Minor = Int128;
    using Number = FixedInteger;
};

struct Wide {
    using Coordinate = BigInteger;
    using Minor = BigInteger;
    using Number = BigInteger;
};

template <class Types>
struct Solution {
    std::array<typename Types::Number, 4> numerators{};
    typename Types::Number denominator{};
};

/// Scales of a case. Determinants are multilinear in the axes, so each axis may have its own scale; where dot products
/// mix the axes (triangle3d, segment) all must share one.
struct Scales {
    std::array<Scale, 3> axes{};
    Scale depths;  ///< for perspective
    Scale values;
    bool narrow = true;

    explicit Scales(const Case& c) {
        const int dimension = space_dimension(c.simplex);
        const int count = vertex_count(c.simplex);
        for (int axis = 0; axis < dimension; ++axis) {
            Scale& s = axes[static_cast<std::size_t>(axis)];
            s.include(c.point[static_cast<std::size_t>(axis)]);
            for (int i = 0; i < count; ++i) s.include(c.vertex(i, axis));
        }
        if (c.simplex == Simplex::triangle3d || c.simplex == Simplex::segment) share();
        for (int i = 0; i < count && c.perspective; ++i) depths.include(c.depth(i));
        for (int i = 0; i < count; ++i) values.include(c.values[static_cast<std::size_t>(i)]);
        narrow = values.bits() <= 61 && depths.bits() <= 61 &&
                 std::all_of(axes.begin(), axes.end(), [](const Scale& s) { return s.bits() <= 61; });
    }

    /// One scale for all axes from here on.
    const Scale& share() {
        for (const Scale& s : axes) axes[0].include(s);
        axes.fill(Scale(axes[0]));
        return axes[0];
    }
};

template <class Types>
using Vector = std::array<typename Types::Coordinate, 3>;

/// a x b, formed in the type for minors and handed over as numbers.
template <class Types>
std::array<typename Types::Number, 3> cross(const Vector<Types>& a, const Vector<Types>& b) {
    using M = typename Types::Minor;
    using N = typename Types::Number;
    return {N(M(a[1]) * M(b[2]) - M(a[2]) * M(b[1])), N(M(a[2]) * M(b[0]) - M(a[0]) * M(b[2])),
            N(M(a[0]) * M(b[1]) - M(a[1]) * M(b[0]))};
}

/// The dot product of a vector of numbers with one of numbers or coordinates.
template <class Number>
Number dot(const std::array<Number, 3>& a, const auto& b) {
    Number sum = a[0] * b[0];
    sum += a[1] * b[1];
    sum += a[2] * b[2];
    return sum;
}

/// Vertices relative to the point, as integers on the scales.
template <class Types>
std::array<Vector<Types>, 4> relative_vertices(const Case& c, const Scales& scales) {
    using C = typename Types::Coordinate;
    std::array<Vector<Types>, 4> v{};
    for (int axis = 0; axis < space_dimension(c.simplex); ++axis) {
        const auto k = static_cast<std::size_t>(axis);
        const int low = scales.axes[k].low;
        const C p = scaled<C>(c.point[k], low);
        for (int i = 0; i < vertex_count(c.simplex); ++i)
            v[static_cast<std::size_t>(i)][k] = scaled<C>(c.vertex(i, axis), low) - p;
    }
    return v;
}

template <class Types>
Vector<Types> difference(const Vector<Types>& a, const Vector<Types>& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

template <class Types>
Solution<Types> solve(const Case& c, const Scales& scales) {
    using N = typename Types::Number;
    const auto v = relative_vertices<Types>(c, scales);
    Solution<Types> s;
    auto& n = s.numerators;
    switch (c.simplex) {
        case Simplex::tetrahedron: {
            // det(a,b,c,d rows minus one): a x b and c x d give all four.
            const auto ab = cross<Types>(v[0], v[1]);
            const auto cd = cross<Types>(v[2], v[3]);
            n = {dot(cd, v[1]), -dot(cd, v[0]), dot(ab, v[3]), -dot(ab, v[2])};
            s.denominator = n[0] + n[1] + n[2] + n[3];
            break;
        }
        case Simplex::triangle: {
            for (std::size_t i = 0; i < 3; ++i) n[i] = cross<Types>(v[(i + 1) % 3], v[(i + 2) % 3])[2];
            s.denominator = n[0] + n[1] + n[2];
            break;
        }
        case Simplex::triangle3d: {
            const auto normal = cross<Types>(difference<Types>(v[1], v[0]), difference<Types>(v[2], v[0]));
            for (std::size_t i = 0; i < 3; ++i) n[i] = dot(normal, cross<Types>(v[(i + 1) % 3], v[(i + 2) % 3]));
            s.denominator = dot(normal, normal);
            break;
        }
        case Simplex::segment: {
            const auto edge = difference<Types>(v[1], v[0]);
            const std::array e{N(edge[0]), N(edge[1]), N(edge[2])};
            n[0] = dot(e, v[1]);
            n[1] = -dot(e, v[0]);
            s.denominator = dot(e, e);
            break;
        }
    }
    return s;
}

/// From the weights in the window, n_i / d, to those of perspective, n_i w_j w_k / sum n_i w_j w_k. The denominator
/// becomes zero also where the area is.
template <class Types>
void apply_perspective(const Case& c, const Scales& scales, Solution<Types>& s) {
    using N = typename Types::Number;
    if (s.denominator.sign() == 0) return;
    const auto w = [&](int i) { return N(scaled<typename Types::Coordinate>(c.depth(i % 3), scales.depths.low)); };
    s.denominator = N(0);
    for (int i = 0; i < 3; ++i) {
        N& n = s.numerators[static_cast<std::size_t>(i)];
        n *= w(i + 1) * w(i + 2);
        s.denominator += n;
    }
}

}  // namespace barycert::exact
