/// Exact predicates: orientations, determinants of differences, in-circle and in-sphere tests, and the signs of
/// barycentric weights.
///
/// Each predicate returns the sign of the exact polynomial in its coordinates, which are doubles. `orient2d(...)`
/// requires finite ones; `checked_orient2d(...)` is for untrusted input (E).
///
/// Laws (each is a test of that name in tests/core):
///   S1  A sign is exact for every finite input, subnormals and 1e308 included, in every rounding mode, with
///       flush-to-zero or without: floating point answers only what its error bound proves, integers answer the rest.
///   S2  An even permutation of the arguments keeps an orientation and an in-circle or in-sphere sign (the last
///       argument included), an odd one flips it; the same permutation of the vertices permutes the signs of the
///       weights. Multiplying all axes by one power of two (without leaving the doubles) changes no sign. Multiplying
///       one axis changes none in a triangle or tetrahedron, but may change incircle and insphere.
///   D1  Answers, and the counts of TierCounts, depend on the input bits alone, as results do in weights.hpp.
///   E   A checked predicate returns an Error, never a sign, if a coordinate is NaN or infinite. An unchecked one
///       terminates and stays within its memory; which sign it returns is not specified. It is an assertion failure
///       where the library was built without NDEBUG.
///
/// A point computed to lie on a face most likely does not. Signs at a shared face are zero for both cells: to assign
/// the point to one of them takes a rule for ties.
///
/// Conventions, those of CGAL::orientation:
///   orient2d(a, b, c) > 0 if a, b, c turn counter-clockwise;
///   orient3d(a, b, c, d) > 0 if a, b, c turn counter-clockwise seen from d (the opposite of Shewchuk's orient3d):
///
///         d               x to the right, y away from the reader, z up:
///        /|\ .            a = (0,0,0), b = (1,0,0), c = (0,1,0), d = (0,0,1)
///       / | c             is positive
///      / .|. \ .
///     a-------b
///
/// and those of CGAL's side_of_oriented_circle and side_of_oriented_sphere:
///   simplex           last point inside    on the circle or sphere    outside
///   positive          positive             zero                       negative
///   negative          negative             zero                       positive
///
///          c           incircle(a, b, c, p) > 0, for a, b, c turn counter-clockwise and p is inside
///      .   |\  .
///     .    | \  .      The answer that does not depend on orientation, as Delaunay tests need it, is a product:
///     .  p |  \ .          incircle(a, b, c, p) * orient2d(a, b, c)            positive inside, negative outside
///      .   a---b           insphere(a, b, c, d, p) * orient3d(a, b, c, d)
///        . _ .
///
/// A flat simplex has no circle or sphere: the product is zero, the sign alone that of the determinant. For three
/// distinct points on a line it changes from one side of the line to the other; likewise insphere and the plane of a,
/// b, c, d, but it is zero everywhere if these lie on one circle or line. Both are zero if two vertices coincide.
///
/// Example:
///
///     const double a[] = {0, 0}, b[] = {1, 0}, c[] = {0, 1}, p[] = {0.3, 0.3};
///     const Sign turn = orient2d(a, b, c);                      // positive: counter-clockwise
///     const double triangle[] = {0, 0, 1, 0, 0, 1};
///     const WeightSigns signs = weight_signs(Simplex::triangle, triangle, p);
///     const bool inside = signs.region() == Region::interior;
#pragma once

#include <bit>
#include <cstdint>
#include <span>

#include "barycert/result.hpp"
#include "barycert/simplex.hpp"

namespace barycert {

enum class Sign : std::int8_t { negative = -1, zero = 0, positive = 1 };

/// The sign of -x.
constexpr Sign operator-(Sign x) {
    return static_cast<Sign>(-static_cast<int>(x));
}

/// The sign of a product.
constexpr Sign operator*(Sign x, Sign y) {
    return static_cast<Sign>(static_cast<int>(x) * static_cast<int>(y));
}

/// Sign of det(b - a, c - a) of points with 2 coordinates. Requires finite coordinates.
Sign orient2d(const double* a, const double* b, const double* c) noexcept;

/// Sign of det(b - a, c - a, d - a) of points with 3 coordinates. Requires finite coordinates.
Sign orient3d(const double* a, const double* b, const double* c, const double* d) noexcept;

/// Sign of det(q - p, s - r, u - t) of points with 3 coordinates: of three differences of any points, such as an edge
/// of each of two simplices and what joins them. orient3d(a, b, c, d) is det3d(a, b, a, c, a, d). Swapping the ends of
/// a difference, or two differences, flips it. Requires finite coordinates.
Sign det3d(const double* p, const double* q, const double* r, const double* s, const double* t,
           const double* u) noexcept;

/// Sign of det(q - d, |q - d|^2) over rows q = a, b, c of points with 2 coordinates: positive if d lies inside the
/// circle through a, b, c and these turn counter-clockwise. Requires finite coordinates.
Sign incircle(const double* a, const double* b, const double* c, const double* d) noexcept;

/// Sign of -det(q - e, |q - e|^2) over rows q = a, b, c, d of points with 3 coordinates: positive if e lies inside the
/// sphere through a, b, c, d and orient3d(a, b, c, d) is positive. Requires finite coordinates. Coordinates from 1e-300
/// to 1e300 side by side take tens of microseconds and a hundred KiB of stack (barycert.hpp).
Sign insphere(const double* a, const double* b, const double* c, const double* d, const double* e) noexcept;

/// The same for untrusted input. Each returns an Error if a coordinate is NaN or infinite; it names the coordinate and
/// the point, both counted from 0.
Result<Sign> checked_orient2d(const double* a, const double* b, const double* c);
Result<Sign> checked_orient3d(const double* a, const double* b, const double* c, const double* d);
Result<Sign> checked_det3d(const double* p, const double* q, const double* r, const double* s, const double* t,
                           const double* u);
Result<Sign> checked_incircle(const double* a, const double* b, const double* c, const double* d);
Result<Sign> checked_insphere(const double* a, const double* b, const double* c, const double* d, const double* e);

/// The exact signs of the barycentric weights of one point, in two bytes.
class WeightSigns {
public:
    /// Bit i: weight i is negative. Bit 4+i: weight i is zero. Bit 8: the simplex is oriented negatively. Bit 9: it is
    /// degenerate, and all other bits are clear.
    using Bits = std::uint16_t;

    constexpr WeightSigns() = default;
    constexpr explicit WeightSigns(Bits bits) : bits_(bits) {}
    static constexpr WeightSigns degenerate_simplex() { return WeightSigns(Bits{1} << 9); }

    constexpr Bits bits() const { return bits_; }
    constexpr bool degenerate() const { return (bits_ >> 9) != 0; }

    /// Sign of the simplex's signed area or volume. Segment and triangle3d have none: positive unless degenerate.
    constexpr Sign orientation() const {
        return degenerate() ? Sign::zero : (bits_ >> 8 & 1) != 0 ? Sign::negative : Sign::positive;
    }

    /// Sign of weight i; zero if degenerate. Requires 0 <= i < vertex_count(simplex).
    constexpr Sign sign(int i) const {
        if (degenerate() || (bits_ >> (4 + i) & 1) != 0) return Sign::zero;
        return (bits_ >> i & 1) != 0 ? Sign::negative : Sign::positive;
    }

    constexpr Region region() const {
        if (degenerate()) return Region::degenerate;
        if ((bits_ & 0xf) != 0) return Region::outside;
        return (bits_ & 0xf0) != 0 ? Region::boundary : Region::interior;
    }

    /// The open face that holds the point (or, for simplices that are projected on, its projection).
    constexpr Feature feature(Simplex s) const {
        const Region r = region();
        if (r == Region::degenerate) return Feature::degenerate;
        if (r == Region::outside) return Feature::outside;
        if (r == Region::interior) return Feature::interior;
        const int support = vertex_count(s) - std::popcount(static_cast<unsigned>(bits_ & 0xf0));
        return support == 1 ? Feature::vertex : support == 2 ? Feature::edge : Feature::face;
    }

    /// The point lies in the closed simplex.
    constexpr bool contains() const { return (bits_ & 0x20f) == 0; }

    friend constexpr bool operator==(WeightSigns, WeightSigns) = default;

private:
    Bits bits_ = 0;
};

/// Signs of the weights of `point` in the simplex at `vertices` (vertex after vertex, see Case). For a degenerate
/// simplex WeightSigns::degenerate() is true. If `tiers` is not null, this case is added to it. Requires finite
/// coordinates.
WeightSigns weight_signs(Simplex simplex, const double* vertices, const double* point,
                         TierCounts* tiers = nullptr) noexcept;

/// The same for untrusted input. Returns an Error that names the coordinate if one is NaN or infinite.
Result<WeightSigns> checked_weight_signs(Simplex simplex, const double* vertices, const double* point,
                                         TierCounts* tiers = nullptr);

/// Signs of the weights of many cases, on SIMD lanes: out[j] for case j. Returns an Error if a coordinate is NaN or
/// infinite (it names the case), if out.size() is not the number of cases, or if the sizes of the queries do not fit
/// each other; `out` is then not to be used. Requires indices in range: they are not checked.
Status weight_signs(const CaseArrays& cases, std::span<WeightSigns> out, TierCounts* tiers = nullptr);
Status weight_signs(const MeshQueries& queries, std::span<WeightSigns> out, TierCounts* tiers = nullptr);

}  // namespace barycert
