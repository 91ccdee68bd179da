/// Random cases for the oracle, by kind of number, salted with coincidences.
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <ostream>
#include <string>
#include <string_view>

#include "barycert/simplex.hpp"
#include "core/base/random.hpp"
#include "core/base/text.hpp"

namespace barycert::testing_cases {

enum class Kind : std::uint8_t {
    ordinary,      // uniform in [-1, 1): multiples of 2^-53
    bit_patterns,  // every finite double is as likely as another
    subnormal,     // results underflow, ties among subnormals
    huge,          // near the largest double, both signs: differences overflow
    mixed,         // exponents from -300 to 300
    lattice,       // integers from -2 to 2: zeros, ties and degenerate simplices
    anisotropic,   // axes that differ by 2^-40 and 2^-500
    thin,          // all vertices within a few ulps of a line
};
inline constexpr std::array<Kind, 8> all_kinds{Kind::ordinary, Kind::bit_patterns, Kind::subnormal,   Kind::huge,
                                               Kind::mixed,    Kind::lattice,      Kind::anisotropic, Kind::thin};

inline std::string_view name(Kind k) {
    constexpr std::array<std::string_view, 8> names{"ordinary", "bit patterns", "subnormal",   "huge",
                                                    "mixed",    "lattice",      "anisotropic", "thin"};
    return names[static_cast<std::size_t>(k)];
}

inline void PrintTo(Kind k, std::ostream* out) {
    *out << name(k);
}

inline double finite_bits(base::Random& r) {
    while (true) {
        const auto x = std::bit_cast<double>(r.bits());
        if (std::isfinite(x)) return x;
    }
}

inline double number(base::Random& r, Kind kind, int axis) {
    switch (kind) {
        case Kind::ordinary:
            return r.uniform(-1, 1);
        case Kind::bit_patterns:
            return finite_bits(r);
        case Kind::subnormal:
            return std::bit_cast<double>(r.bits() & 0x800fffffffffffffULL) * (r.coin() ? 1 : 0x1p-40);
        case Kind::huge:
            return (r.coin() ? 1 : -1) * r.uniform(0x1p+1022, 0x1.fffffffffffffp+1023);
        case Kind::mixed:
            return r.scaled(-1, 1, -300, 300);
        case Kind::lattice:
            return r.integer(-2, 2);
        case Kind::anisotropic:
            return std::ldexp(r.uniform(-1, 1), axis == 0 ? 0 : axis == 1 ? -40 : -500);
        case Kind::thin:
            return 1 + r.integer(-3, 3) * 0x1p-52 + (axis == 0 ? r.integer(0, 8) : 0);
    }
    return 0;
}

inline Case random_case(base::Random& r, Simplex simplex, Kind kind) {
    Case c;
    c.simplex = simplex;
    const int count = vertex_count(simplex), dimension = space_dimension(simplex);
    for (int axis = 0; axis < dimension; ++axis) {
        for (int i = 0; i < count; ++i) c.vertex(i, axis) = number(r, kind, axis);
        c.point[static_cast<std::size_t>(axis)] = number(r, kind, axis);
    }
    const Kind of_values = r.coin() ? kind : Kind::ordinary;
    for (int i = 0; i < count; ++i) c.values[static_cast<std::size_t>(i)] = number(r, of_values, 0);
    // Coincidences that random numbers of most kinds never make.
    const int i = r.integer(0, count - 1), j = r.integer(0, count - 1);
    const int salt = r.integer(0, 11);
    for (int axis = 0; axis < dimension; ++axis) {
        double& p = c.point[static_cast<std::size_t>(axis)];
        if (salt == 0) p = c.vertex(i, axis);                                      // on a vertex
        if (salt == 1) p = c.vertex(i, axis) / 2 + c.vertex(j, axis) / 2;          // on an edge, or next to it
        if (salt == 2) c.vertex(i, axis) = c.vertex(j, axis);                      // degenerate unless i = j
        if (salt == 3 && axis == 1) p = c.vertex(i, axis);                         // level with a vertex
        if (salt == 4 && axis == 2) c.vertex(i, axis) = p = c.vertex(j, axis);     // level edge
        if (salt == 5) c.vertex(i, axis) = c.vertex(j, axis) = p = 0;              // zeros have no exponent
        if (salt == 6) c.values[static_cast<std::size_t>(i)] = c.vertex(i, axis);  // value near zero by cancellation
    }
    return c;
}

/// A triangle in a window: the same with a depth at each vertex, of the same kind or from 1 to 10.
inline Case random_perspective_case(base::Random& r, Kind kind) {
    const Case plain = random_case(r, Simplex::triangle, kind);
    Case c = plain;
    c.perspective = true;
    const bool of_kind = r.coin(), level = r.integer(0, 7) == 0;
    for (int i = 0; i < 3; ++i) {
        for (int axis = 0; axis < 2; ++axis) c.vertex(i, axis) = plain.vertex(i, axis);
        double w = 0;
        while (!(w > 0)) w = of_kind ? std::fabs(number(r, kind, i)) : r.uniform(1, 10);
        c.depth(i) = level && i > 0 ? c.depth(0) : w;
    }
    return c;
}

/// For messages.
inline std::string describe(const Case& c) {
    std::string text{name(c.simplex)};
    for (int i = 0; i < vertex_count(c.simplex); ++i) {
        text += "\n  v" + std::to_string(i);
        for (int axis = 0; axis < c.stride(); ++axis) text += ' ' + base::hexadecimal(c.vertex(i, axis));
    }
    text += "\n  p";
    for (int axis = 0; axis < space_dimension(c.simplex); ++axis)
        text += ' ' + base::hexadecimal(c.point[static_cast<std::size_t>(axis)]);
    text += "\n  f";
    for (int i = 0; i < vertex_count(c.simplex); ++i)
        text += ' ' + base::hexadecimal(c.values[static_cast<std::size_t>(i)]);
    return text;
}

inline std::uint64_t bits(double x) {
    return std::bit_cast<std::uint64_t>(x);
}

}  // namespace barycert::testing_cases
