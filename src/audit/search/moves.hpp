/// The numbers of a case that a search changes, as one row; the steps of a walk, and where walks start.
#pragma once

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <functional>

#include "audit/search/evaluation.hpp"
#include "barycert/simplex.hpp"
#include "core/base/finite.hpp"
#include "core/base/random.hpp"

namespace barycert::audit {

/// Which exponents coordinates may have; zero always may be.
struct ExponentRange {
    int min = -1074, max = 1023;
};

inline int vertex_numbers(const Case& c) {
    return c.stride() * vertex_count(c.simplex);
}

/// Numbers of vertices (depths included) and point.
inline int coordinate_count(const Case& c) {
    return vertex_numbers(c) + space_dimension(c.simplex);
}

inline double& coordinate(Case& c, int k) {
    const int n = vertex_numbers(c);
    return k < n ? c.vertices[static_cast<std::size_t>(k)] : c.point[static_cast<std::size_t>(k - n)];
}
inline double coordinate(const Case& c, int k) {
    return coordinate(const_cast<Case&>(c), k);  // NOLINT(cppcoreguidelines-pro-type-const-cast)
}

inline int axis_of(const Case& c, int k) {
    const int n = vertex_numbers(c);
    return k < n ? k % c.stride() : k - n;
}

inline bool is_depth(const Case& c, int k) {
    return c.perspective && k < vertex_numbers(c) && axis_of(c, k) == 2;
}

inline bool admissible(const Case& c, const ExponentRange& range) {
    for (int k = 0; k < coordinate_count(c); ++k) {
        const double x = coordinate(c, k);
        if (!std::isfinite(x) || (is_depth(c, k) && !(x > 0))) return false;
        if (x != 0 && (std::ilogb(x) < range.min || std::ilogb(x) > range.max)) return false;
    }
    return base::all_finite(c.values);
}

/// Bits from the first to the last one of the significand; 0 of zero.
inline int significant_bits(double x) {
    if (x == 0) return 0;
    int exponent = 0;
    const auto integer = static_cast<std::uint64_t>(std::ldexp(std::frexp(std::fabs(x), &exponent), 53));
    return static_cast<int>(std::bit_width(integer)) - std::countr_zero(integer);
}

/// How much there is to write down: bits, then the size of exponents, then signs.
inline int plain_cost(double x) {
    if (x == 0) return std::signbit(x) ? 1 : 0;
    const auto exponent = static_cast<unsigned>(std::abs(std::ilogb(x)));
    return 8 * significant_bits(x) + 2 * static_cast<int>(std::bit_width(exponent)) + (x < 0 ? 1 : 0);
}

inline int plain_cost(const Case& c) {
    int sum = 0;
    for (int k = 0; k < coordinate_count(c); ++k) sum += plain_cost(coordinate(c, k));
    for (const double f : c.values) sum += plain_cost(f);
    return sum;
}

/// x rounded to `bits` significant bits, to nearest, plus `steps` units of the last of them. The significand may gain a
/// bit by carrying over. Requires: x finite, not zero, bits >= 1.
inline double rounded_to(double x, int bits, int steps = 0) {
    int exponent = 0;
    const double m = std::frexp(x, &exponent);
    return std::ldexp(std::nearbyint(std::ldexp(m, bits)) + steps, exponent - bits);
}

/// A case with a pattern of exponents: one for all, one an axis, one a vertex or one a number, in a band of random
/// width; significands of full or of few bits; the point like the vertices, or between them. Admissible.
Case patterned_case(Simplex simplex, bool perspective, const ExponentRange& range, base::Random& random);

/// Changes a few numbers of the case: by ulps, or their significands, exponents, signs, or to those of others; the
/// point to one between vertices. `values`: nodal values, too. May leave a case that is not admissible.
void wander(Case& c, base::Random& random, bool values);

/// Asks for a case; nothing more may be asked once it returns null.
using Ask = std::function<const Evaluation*(const Case&)>;

/// A quantity that is to become zero, and the number that is moved for it.
struct Zero {
    std::size_t weight = 0;  ///< this weight,
    bool of_cell = false;    ///< or the determinant of the cell over the numerator of this weight
    int coordinate = 0;
};

/// Moves the coordinate by secants of the exact weights. Without rounding one secant hits: determinants are linear in
/// each number. `at`: the evaluation of `c`; `first`: the step to begin with. Cases on the way are asked, and the last
/// one asked is left in `c`.
void to_zero(Case& c, const Evaluation& at, const Zero& zero, double first, const ExponentRange& range, const Ask& ask);

/// A step to begin with: small beside the number, or beside others of its axis if it is zero.
double first_step(const Case& c, int k);

/// to_zero() of a weight or, once in a while, of the cell, then some ulps further: the case left in `c` was not asked.
void jump_to_zero(Case& c, const Evaluation& at, base::Random& random, const ExponentRange& range, const Ask& ask);

}  // namespace barycert::audit
