#include "mesh/locate/near_feature.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <initializer_list>
#include <optional>

#include "barycert/predicates.hpp"
#include "barycert/simplex.hpp"
#include "barycert/weights.hpp"
#include "core/base/vectors.hpp"
#include "core/integer.hpp"
#include "core/whole_points.hpp"
#include "mesh/index/facet_contact.hpp"

namespace barycert::locate {
namespace {

// Which feature? Let x be the point of a proper cell nearest to p, p not inside, and F the open face of the cell in
// which x lies. F is the only one for which
//   vertex a:   p projects to each edge ab at a or beyond it: (p - a).(b - a) <= 0;
//   edge ab:    p projects to the inside of ab, and to the plane of each face abc on ab or on the other side than c;
//   face abc:   p projects to the inside of abc, and does not lie on the cell's side of it.
// For x is nearest if and only if (p - x).(c - x) <= 0 for all corners c, and all these are signs of such products:
// with x on ab and p - x normal to it, that of c has the sign of the weight of c of p's projection to abc. In the plane
// the edges are what faces are here. All of it are signs of weights. Of a triangle in space
//   face abc:   p projects to the inside of abc.

class Classifier {
public:
    Classifier(const NearCell& cell, const Point3& p) : cell_(cell), p_(p) {
        if (cell.in_space) return;
        std::array<double, 12> vertices{};
        const auto n = static_cast<std::size_t>(cell.count), d = n - 1;
        for (std::size_t i = 0; i < n; ++i) std::copy_n(cell.at[i].begin(), d, &vertices[d * i]);
        sides_ = weight_signs(d == 2 ? Simplex::triangle : Simplex::tetrahedron, vertices.data(), p.data());
    }

    bool degenerate() const { return !cell_.in_space && sides_.degenerate(); }
    bool inside() const { return !cell_.in_space && sides_.region() == Region::interior; }

    bool nearest(unsigned mask) {
        const int corners = std::popcount(mask);
        const int most = cell_.in_space ? cell_.count : cell_.count - 1;
        if (!cell_.in_space && corners == most && sides_.sign(std::countr_one(mask)) == Sign::positive) return false;
        for (int i = 0; i < cell_.count; ++i) {
            // Looks at what lies within the face, and on the faces of one dimension more.
            if (corners > 1 && (mask >> i & 1) != 0 && !positive(mask, i)) return false;
            if (corners < most && (mask >> i & 1) == 0 && positive(mask | 1U << i, i)) return false;
        }
        return true;
    }

private:
    /// The weight of corner i in the projection of p to the edge or face is positive.
    bool positive(unsigned mask, int i) {
        auto& known = signs_[mask];
        const NearFeature f = cell_.feature(mask);
        if (!known) known = weight_signs(f.simplex(), f.vertices().data(), p_.data());
        const int place = std::popcount(mask & ((1U << i) - 1));
        return known->sign(place) == Sign::positive;
    }

    const NearCell& cell_;
    const Point3& p_;
    WeightSigns sides_;
    std::array<std::optional<WeightSigns>, 16> signs_;
};

// Distances to features in exact integers: comparisons, and one rounding.

// Not core's Integer, which has room for degree 7 in differences of any doubles: comparisons have degree 10.
using Number = core::WholeNumber;
using Vector = core::WholeVector;
using base::cross, base::dot, base::minus;

/// Whole numbers in the unit of p and the corners of features.
struct Lattice : core::WholePoints {
    Lattice(const Point3& p, std::initializer_list<const NearFeature*> features) : WholePoints({p.data()}) {
        for (const NearFeature* const f : features) {
            for (std::size_t i = 0; i < static_cast<std::size_t>(f->count); ++i) add(f->at[i].data());
        }
    }
    Vector at(const Point3& p) const { return WholePoints::at(p.data()); }
};

/// The square of a distance: numerator / denominator.
struct Square {
    Number numerator, denominator = 1;
};

Square square_of(const Lattice& lattice, const Point3& p, const NearFeature& f) {
    const Vector a = lattice.at(f.at[0]), q = minus(lattice.at(p), a);
    if (f.count == 1) return {dot(q, q), 1};
    const Vector e = minus(lattice.at(f.at[1]), a);
    if (f.count == 2) {
        const Vector n = cross(q, e);
        return {dot(n, n), dot(e, e)};
    }
    const Vector n = cross(e, minus(lattice.at(f.at[2]), a));
    const Number height = dot(q, n);
    return {height * height, dot(n, n)};
}

/// floor(sqrt(x)). The estimate is off by far less than 2^32, so its square fits and a step of Newton's leaves less
/// than one or two; then it is counted.
std::uint64_t root_of(core::UInt128 x) {
    auto r = static_cast<core::UInt128>(std::sqrt(static_cast<double>(x)));
    r = (r + x / r) / 2;
    while (r * r > x) --r;
    while ((r + 1) * (r + 1) <= x) ++r;
    return static_cast<std::uint64_t>(r);
}

}  // namespace

NearFeature NearCell::feature(unsigned mask) const {
    NearFeature f;
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
        if ((mask >> i & 1) != 0) f.add(nodes[i], at[i].data());
    }
    return f;
}

bool nearest_feature(const NearCell& cell, const Point3& p, unsigned guess, NearFeature& out) {
    if (cell.in_space) {
        const std::array<const double*, 3> at{cell.at[0].data(), cell.at[1].data(), cell.at[2].data()};
        if (!index::proper(3, {{}, at})) {
            out = cell.feature(nearest_of_flat(at, p.data()));
            return true;
        }
    }
    Classifier is(cell, p);
    if (is.degenerate()) return false;
    if (is.inside()) {
        out = NearFeature{.count = 1, .at = {p}};
        return true;
    }
    const unsigned all = (1U << cell.count) - 1;
    unsigned found = is.nearest(guess) ? guess : 0;
    for (unsigned mask = 1; found == 0 && mask < all + (cell.in_space ? 1U : 0U); ++mask) {
        if (is.nearest(mask)) found = mask;
    }
    out = cell.feature(found);
    return true;
}

std::array<double, 3> weights_of(const Point3& p, const NearFeature& f) {
    if (f.count == 1) return {1, 0, 0};
    // All numbers are finite: there is no Error.
    const auto [a, b, c, none] = barycentric_weights(f.simplex(), f.vertices().data(), p.data()).value().weights;
    return {a, b, c};
}

int compare_distances(const Point3& p, const NearFeature& f, const NearFeature& g) {
    const Lattice lattice(p, {&f, &g});
    const Square a = square_of(lattice, p, f), b = square_of(lattice, p, g);
    const Number x = a.numerator * b.denominator, y = b.numerator * a.denominator;
    return x < y ? -1 : x == y ? 0 : 1;
}

double distance_to(const Point3& p, const NearFeature& f) {
    const Lattice lattice(p, {&f});
    Square s = square_of(lattice, p, f);
    if (s.numerator == 0) return 0;
    // floor(numerator 4^shift / denominator) has 124 to 126 bits, its root 62 or 63. The part that was cut off, of
    // either, counts as one more bit at the end that is not zero: it decides ties, and nothing else.
    const int excess = static_cast<int>(msb(s.numerator)) - static_cast<int>(msb(s.denominator));
    const int shift = (125 - excess) >> 1;
    (shift >= 0 ? s.numerator : s.denominator) <<= static_cast<unsigned>(2 * std::abs(shift));
    Number quotient, rest;
    divide_qr(s.numerator, s.denominator, quotient, rest);
    const auto low = static_cast<std::uint64_t>(quotient & ~std::uint64_t{0});
    const core::UInt128 q = static_cast<core::UInt128>(static_cast<std::uint64_t>(quotient >> 64)) << 64 | low;
    const std::uint64_t root = root_of(q);
    const bool inexact = rest != 0 || static_cast<core::UInt128>(root) * root != q;
    return core::round_integer(core::Integer(false, root << 1 | (inexact ? 1 : 0), 0), lattice.exponent() - shift - 1);
}

Point3 projection_on(const Point3& p, const NearFeature& f) {
    if (f.count == 1) return f.at[0];
    const Lattice lattice(p, {&f});
    // a + e (q.e) / (e.e) on an edge; p - n (q.n) / (n.n) on a face.
    const Vector a = lattice.at(f.at[0]), at_p = lattice.at(p), q = minus(at_p, a), e = minus(lattice.at(f.at[1]), a);
    const Vector n = f.count == 2 ? e : cross(e, minus(lattice.at(f.at[2]), a));
    const Number along = f.count == 2 ? dot(q, n) : Number(-dot(q, n)), square = dot(n, n);
    Point3 x{};
    for (std::size_t k = 0; k < 3; ++k)
        x[k] = core::rounded_quotient<Number>((f.count == 2 ? a : at_p)[k] * square + along * n[k], square,
                                              lattice.exponent());
    return x;
}

}  // namespace barycert::locate
