#include "barycert/oracle.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include "audit/exact/rounding.hpp"
#include "barycert/environment.hpp"
#include "barycert/simplex.hpp"

namespace barycert {

using namespace exact;

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

// Numerators and denominator of the exact weights, for any set of integer types.
//
// Bounds for the narrow types. Every coordinate, relative to its axis' scale, is below 2^61 in magnitude (the caller
// checks), so differences are below 2^62, products of two below 2^124, 2x2 minors below 2^125 and thus within Int128;
// n_i of a tetrahedron below 3 * 2^62 * 2^125 < 2^189, of a triangle3d below 3 * 2^250 < 2^252, of a segment below
// 3 * 2^124. Perspective multiplies those of a triangle, below 2^125, by two depths: below 2^247, three of them below
// 2^249. A value numerator adds 61 + 2 bits. Quotients are shifted by at most the length of the denominator plus 56
// bits. All this stays below 512 bits.

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
        const int count = vertex_count(c.simplex);
        for (int axis = 0; axis < space_dimension(c.simplex); ++axis) {
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

/// The feature that a set of non-zero weights spans.
Feature feature_of(Simplex simplex, std::uint8_t support) {
    const int nonzero = std::popcount(support);
    if (nonzero == vertex_count(simplex)) return Feature::interior;
    return nonzero == 1 ? Feature::vertex : nonzero == 2 ? Feature::edge : Feature::face;
}

template <class Types>
OracleAnswer answer(const Case& c, const Scales& scales) {
    using N = typename Types::Number;
    Solution<Types> s = solve<Types>(c, scales);
    if (c.perspective) apply_perspective<Types>(c, scales, s);
    const auto count = static_cast<std::size_t>(vertex_count(c.simplex));
    const int orientation = s.denominator.sign();
    if (orientation == 0) return degenerate_answer();
    OracleAnswer a;
    bool negative = false;
    N value(0);
    for (std::size_t i = 0; i < count; ++i) {
        const N& n = s.numerators[i];
        a.signs[i] = static_cast<std::int8_t>(n.sign() * orientation);
        negative = negative || a.signs[i] < 0;
        if (a.signs[i] != 0) a.support = static_cast<std::uint8_t>(a.support | (1U << i));
        a.weights[i] = round_quotient(n, s.denominator);
        value += n * scaled<typename Types::Coordinate>(c.values[i], scales.values.low);
    }
    a.value = round_quotient(value, s.denominator, scales.values.low);
    a.feature = negative ? Feature::outside : feature_of(c.simplex, a.support);
    a.region = negative ? Region::outside : a.feature == Feature::interior ? Region::interior : Region::boundary;
    return a;
}

/// The place in the window of sum W_i (x_i w_i, y_i w_i, w_i), less p: sum W_i w_i (v_i - p) / sum W_i w_i.
double projected_residual(const Case& c, std::span<const double> weights) {
    Scales scales(c);
    const Scale common = scales.share();
    Scale weight_scale;
    for (const double w : weights) weight_scale.include(w);
    BigInteger depth(0);
    std::array<BigInteger, 2> offset{};
    for (int i = 0; i < 3; ++i) {
        const BigInteger share = scaled<BigInteger>(weights[static_cast<std::size_t>(i)], weight_scale.low) *
                                 scaled<BigInteger>(c.depth(i), scales.depths.low);
        depth += share;
        for (int axis = 0; axis < 2; ++axis) {
            const auto k = static_cast<std::size_t>(axis);
            offset[k] += share * (scaled<BigInteger>(c.vertex(i, axis), common.low) -
                                  scaled<BigInteger>(c.point[k], common.low));
        }
    }
    const BigInteger square = offset[0] * offset[0] + offset[1] * offset[1];
    if (depth.sign() == 0) return square.sign() == 0 ? 0.0 : std::numeric_limits<double>::infinity();
    return round_root(square, depth * depth, common.low);
}

using Numbers = std::array<BigInteger, 3>;

/// The gradient of weight i times the denominator, each axis in the product of the units of the others.
Numbers weight_gradient(Simplex s, const std::array<Vector<Wide>, 4>& v, std::size_t i) {
    if (s == Simplex::triangle) {
        const auto e = difference<Wide>(v[(i + 1) % 3], v[(i + 2) % 3]);
        return {e[1], -e[0], BigInteger(0)};
    }
    constexpr std::array<std::array<std::size_t, 3>, 4> opposite{{{1, 2, 3}, {0, 3, 2}, {3, 0, 1}, {2, 1, 0}}};
    const auto [a, b, c] = opposite[i];
    const Numbers normal = cross<Wide>(difference<Wide>(v[b], v[a]), difference<Wide>(v[c], v[a]));
    return {-normal[0], -normal[1], -normal[2]};
}

}  // namespace

OracleAnswer ask_oracle(const Case& c) {
    const ExactEnvironment environment;
    const Scales scales(c);
    if (!scales.narrow) return answer<Wide>(c, scales);
    OracleAnswer a = answer<Narrow>(c, scales);
    a.narrow = true;
    return a;
}

bool same_answer(const OracleAnswer& a, const OracleAnswer& b) {
    const auto same = [](double x, double y) {
        return std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(y) || (x != x && y != y);
    };
    return a.region == b.region && a.feature == b.feature && a.support == b.support && a.signs == b.signs &&
           std::equal(a.weights.begin(), a.weights.end(), b.weights.begin(), same) && same(a.value, b.value);
}

OracleAnswer exact::ask_wide(const Case& c) {
    const ExactEnvironment environment;
    return answer<Wide>(c, Scales(c));
}

double partition_residual(std::span<const double> weights) {
    const ExactEnvironment environment;
    Scale scale;
    scale.include(1.0);
    for (const double w : weights) scale.include(w);
    BigInteger sum = -scaled<BigInteger>(1.0, scale.low);
    for (const double w : weights) sum += scaled<BigInteger>(w, scale.low);
    return round_quotient(sum, BigInteger(1), scale.low);
}

double reproduction_residual(const Case& c, std::span<const double> weights) {
    const ExactEnvironment environment;
    if (c.perspective) return projected_residual(c, weights);
    // sum w_i v_i - sum (n_i/d) v_i = sum (w_i d - n_i) v_i / d, because the exact
    // weights n_i/d give p, or its projection, whatever the weights w_i under test sum to.
    Scales scales(c);
    const Scale common = scales.share();
    const Solution<Wide> s = solve<Wide>(c, scales);
    Scale weight_scale;
    for (const double w : weights) weight_scale.include(w);
    const int low = std::min(weight_scale.low, 0);  // so that 1 is a multiple of 2^low as well
    const auto unit = static_cast<unsigned>(-low);
    BigInteger square(0);
    for (int axis = 0; axis < space_dimension(c.simplex); ++axis) {
        BigInteger component(0);
        for (int i = 0; i < vertex_count(c.simplex); ++i) {
            const auto k = static_cast<std::size_t>(i);
            const BigInteger excess = scaled<BigInteger>(weights[k], low) * s.denominator - (s.numerators[k] << unit);
            component += excess * scaled<BigInteger>(c.vertex(i, axis), common.low);
        }
        square += component * component;
    }
    return round_root(square, s.denominator * s.denominator, common.low + low);
}

int affine_dimension(const Case& c) {
    const ExactEnvironment environment;
    Scales scales(c);
    scales.share();
    const auto v = relative_vertices<Wide>(c, scales);
    const int count = vertex_count(c.simplex);
    using V = Vector<Wide>;
    const auto zero = [](const auto& a) { return a[0].sign() == 0 && a[1].sign() == 0 && a[2].sign() == 0; };
    V edge{};
    std::array<BigInteger, 3> normal{};
    int dimension = 0;
    for (int i = 1; i < count; ++i) {
        const V e = difference<Wide>(v[static_cast<std::size_t>(i)], v[0]);
        if (dimension == 0) {
            edge = e;
            dimension = zero(edge) ? 0 : 1;
        } else if (dimension == 1) {
            normal = cross<Wide>(edge, e);
            dimension = zero(normal) ? 1 : 2;
        } else if (dot(normal, e).sign() != 0) {
            dimension = 3;
        }
    }
    return dimension;
}

GradientAnswer oracle_gradient(const Case& c) {
    const ExactEnvironment environment;
    const auto d = static_cast<std::size_t>(space_dimension(c.simplex));
    Case at_vertex = c;
    for (std::size_t k = 0; k < d; ++k) at_vertex.point[k] = c.vertex(0, static_cast<int>(k));
    const Scales scales(at_vertex);
    const auto v = relative_vertices<Wide>(at_vertex, scales);
    const auto e = difference<Wide>(v[1], v[0]), f = difference<Wide>(v[2], v[0]);
    const BigInteger whole = d == 2 ? cross<Wide>(e, f)[2] : dot(cross<Wide>(e, f), difference<Wide>(v[3], v[0]));
    if (whole.sign() == 0) return {.degenerate = true, .gradient = {nan, nan, nan}};
    GradientAnswer answer;
    Numbers sum{};
    for (std::size_t i = 0; i <= d; ++i) {
        const Numbers g = weight_gradient(c.simplex, v, i);
        for (std::size_t k = 0; k < d; ++k) sum[k] += g[k] * scaled<BigInteger>(c.values[i], scales.values.low);
    }
    for (std::size_t k = 0; k < d; ++k)
        answer.gradient[k] = round_quotient(sum[k], whole, scales.values.low - scales.axes[k].low);
    return answer;
}

double oracle_quadratic_value(const Case& c, std::span<const double> mids) {
    const ExactEnvironment environment;
    constexpr std::array<std::array<std::size_t, 2>, 6> edges{{{0, 1}, {1, 2}, {0, 2}, {0, 3}, {1, 3}, {2, 3}}};
    Scales scales(c);
    for (const double f : mids) scales.values.include(f);
    const int low = scales.values.low;
    const Solution<Wide> s = solve<Wide>(c, scales);
    if (s.denominator.sign() == 0) return nan;
    const auto& n = s.numerators;
    BigInteger sum(0);
    for (std::size_t i = 0; i < static_cast<std::size_t>(vertex_count(c.simplex)); ++i)
        sum += n[i] * (n[i] + n[i] - s.denominator) * scaled<BigInteger>(c.values[i], low);
    for (std::size_t e = 0; e < mids.size(); ++e)
        sum += ((n[edges[e][0]] * n[edges[e][1]]) << 2) * scaled<BigInteger>(mids[e], low);
    return round_quotient(sum, BigInteger(s.denominator * s.denominator), low);
}

std::int64_t oracle_texel(double u, std::int64_t size, bool repeat) {
    const ExactEnvironment environment;
    const Dyadic d = dyadic(u);
    // floor(u size): a shift of the product, towards minus infinity.
    BigInteger product = BigInteger(d.mantissa) * size, floor = product;
    if (d.exponent >= 0) {
        floor <<= static_cast<unsigned>(d.exponent);
    } else {
        const BigInteger unit = BigInteger(1) << static_cast<unsigned>(-d.exponent);
        BigInteger rest;
        mp::divide_qr(product, unit, floor, rest);
        if (rest.sign() < 0) --floor;
    }
    if (repeat) {
        floor %= size;
        return static_cast<std::int64_t>(floor.sign() < 0 ? BigInteger(floor + size) : floor);
    }
    if (floor.sign() < 0) return 0;
    return floor < size ? static_cast<std::int64_t>(floor) : size - 1;
}

}  // namespace barycert
