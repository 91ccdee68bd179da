// A second oracle: CGAL's kernel of exact predicates and exact constructions, rounded by MPFR.
//
// Tetrahedron and triangle: the sign of weight i is the orientation with the point in place of vertex i, times that of
// the simplex; the weight is the quotient of the volumes or areas. Triangle in space: the point's projection to the
// plane, and tetrahedra with a common apex off it. Segment: the point's projection to the line. Perspective: the line
// from the eye through (x, y, 1) is met with the plane of the vertices (x w, y w, w).

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <gmp.h>
#include <mpfr.h>

#include <algorithm>
#include <array>
#include <bit>
#include <boost/multiprecision/gmp.hpp>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <tuple>

#include "audit/exact/cgal_variant.hpp"
#include "barycert/environment.hpp"
#include "barycert/oracle.hpp"
#include "barycert/simplex.hpp"

namespace barycert {
namespace {

using Epeck = CGAL::Exact_predicates_exact_constructions_kernel;
using Number = Epeck::FT;
using Integer = boost::multiprecision::mpz_int;
using Point2 = Epeck::Point_2;
using Point3 = Epeck::Point_3;

/// GMP's rational in CGAL's exact number, whichever of its types that is.
template <class Exact>
mpq_srcptr rational(const Exact& x) {
    if constexpr (requires { x.mpq(); }) {
        return x.mpq();
    } else if constexpr (requires { x.get_mpq_t(); }) {
        return x.get_mpq_t();
    } else {
        return x.backend().data();
    }
}

/// Returns the number that `set` computes by one function of MPFR, to nearest, ties to even, subnormals and overflow
/// included. `set` sets the number it gets and returns what that function returned.
template <class Set>
double rounded(const Set& set) {
    const mpfr_exp_t low = mpfr_get_emin(), high = mpfr_get_emax();
    mpfr_t number;
    mpfr_init2(number, 53);
    mpfr_set_emin(-1073);  // the range that mpfr_subnormalize() wants
    mpfr_set_emax(1024);
    const int inexact = set(number);
    mpfr_subnormalize(number, inexact, MPFR_RNDN);
    const double result = mpfr_get_d(number, MPFR_RNDN);
    mpfr_set_emin(low);
    mpfr_set_emax(high);
    mpfr_clear(number);
    return result;
}

/// x / divisor, rounded once. Requires a divisor other than 0. Not reduced: that takes longer than all else, and MPFR
/// does not ask for it.
double quotient(const Number& x, const Number& divisor) {
    mpq_srcptr a = rational(x.exact()), b = rational(divisor.exact());
    mpq_t q;
    mpq_init(q);
    mpz_mul(mpq_numref(q), mpq_numref(a), mpq_denref(b));
    mpz_mul(mpq_denref(q), mpq_denref(a), mpq_numref(b));
    if (mpz_sgn(mpq_denref(q)) < 0) {
        mpz_neg(mpq_numref(q), mpq_numref(q));
        mpz_neg(mpq_denref(q), mpq_denref(q));
    }
    const double result = rounded([&](mpfr_t to) { return mpfr_set_q(to, q, MPFR_RNDN); });
    mpq_clear(q);
    return result;
}

/// sqrt(x), rounded once. With k such that x 4^k has more than 2 * 56 bits, its root has more than 56, which stand in
/// front of a last bit that says whether there is more.
double rounded_root(mpq_srcptr x) {
    if (mpq_sgn(x) == 0) return 0;
    const long bits =
        static_cast<long>(mpz_sizeinbase(mpq_numref(x), 2)) - static_cast<long>(mpz_sizeinbase(mpq_denref(x), 2));
    const long k = std::max(0L, (116 - bits) / 2);
    const Integer n = Integer(mpq_numref(x)) << (2 * k), d(mpq_denref(x)), whole = n / d;
    Integer rest, root = sqrt(whole, rest);
    root <<= 1;
    if (rest != 0 || whole * d != n) ++root;
    return rounded([&](mpfr_t to) { return mpfr_set_z_2exp(to, root.backend().data(), -k - 1, MPFR_RNDN); });
}

/// Weights as parts of a whole, and their signs as CGAL's predicates tell them; nothing if there are none.
struct SignedWeights {
    std::array<Number, 4> parts;
    Number whole;
    std::array<int, 4> signs{};
};

Point2 point2(const double* x) {
    return {x[0], x[1]};
}

Point3 point3(const double* x) {
    return {x[0], x[1], x[2]};
}

Epeck::Triangle_3 triangle_at(std::span<const double> t) {
    return {point3(&t[0]), point3(&t[3]), point3(&t[6])};
}

template <std::size_t n>
std::array<Point3, n> points3(const Case& c) {
    std::array<Point3, n> v;
    for (std::size_t i = 0; i < n; ++i) v[i] = point3(&c.vertices[3 * i]);
    return v;
}

/// The point in place of each of the vertices; nothing if these have no orientation.
template <std::size_t n, class Point, class Orientation, class Measure>
std::optional<SignedWeights> replaced(const std::array<Point, n>& v, const Point& p, Orientation orientation,
                                      Measure measure) {
    const int whole = std::apply(orientation, v);
    if (whole == 0) return std::nullopt;
    SignedWeights f;
    f.whole = std::apply(measure, v);
    for (std::size_t i = 0; i < n; ++i) {
        std::array<Point, n> w = v;
        w[i] = p;
        f.signs[i] = std::apply(orientation, w) * whole;
        f.parts[i] = std::apply(measure, w);
    }
    return f;
}

std::optional<SignedWeights> tetrahedron(const Case& c) {
    return replaced(
        points3<4>(c), point3(c.point.data()), [](const auto&... w) { return CGAL::orientation(w...); },
        [](const auto&... w) { return CGAL::volume(w...); });
}

std::optional<SignedWeights> triangle(const Case& c) {
    const std::array<Point2, 3> v{point2(&c.vertices[0]), point2(&c.vertices[2]), point2(&c.vertices[4])};
    return replaced(
        v, point2(c.point.data()), [](const auto&... w) { return CGAL::orientation(w...); },
        [](const auto&... w) { return CGAL::area(w...); });
}  // NOLINT(clang-analyzer-cplusplus.NewDeleteLeaks): CGAL counts references

/// The same for a point in the plane of three others: adds an apex off the plane.
std::optional<SignedWeights> in_plane(const std::array<Point3, 3>& v, const Point3& p) {
    const Point3 apex = v[0] + CGAL::cross_product(v[1] - v[0], v[2] - v[0]);
    return replaced(
        v, p, [&](const auto&... w) { return CGAL::orientation(w..., apex); },
        [&](const auto&... w) { return CGAL::volume(w..., apex); });
}

std::optional<SignedWeights> triangle3d(const Case& c) {
    const std::array<Point3, 3> v = points3<3>(c);
    if (CGAL::collinear(v[0], v[1], v[2])) return std::nullopt;
    return in_plane(v, Epeck::Plane_3(v[0], v[1], v[2]).projection(point3(c.point.data())));
}

std::optional<SignedWeights> segment(const Case& c) {
    const Point3 a = point3(&c.vertices[0]), b = point3(&c.vertices[3]);
    if (a == b) return std::nullopt;
    const Point3 q = Epeck::Line_3(a, b).projection(point3(c.point.data()));
    const Epeck::Vector_3 edge = b - a;
    SignedWeights f;
    f.parts[1] = (q - a) * edge;
    f.parts[0] = (b - q) * edge;
    f.whole = edge.squared_length();
    // The half-spaces behind the ends: planes normal to the segment.
    f.signs[0] = Epeck::Plane_3(b, a - b).oriented_side(q);
    f.signs[1] = Epeck::Plane_3(a, b - a).oriented_side(q);
    return f;
}

std::optional<SignedWeights> perspective(const Case& c) {
    if (CGAL::orientation(point2(&c.vertices[0]), point2(&c.vertices[3]), point2(&c.vertices[6])) == CGAL::ZERO)
        return std::nullopt;
    std::array<Point3, 3> v;
    for (std::size_t i = 0; i < 3; ++i) {
        const Number w = c.vertices[3 * i + 2];
        v[i] = Point3(c.vertices[3 * i] * w, c.vertices[3 * i + 1] * w, w);
    }
    const Epeck::Line_3 ray(Point3(0, 0, 0), Point3(c.point[0], c.point[1], 1));
    const auto met = CGAL::intersection(ray, Epeck::Plane_3(v[0], v[1], v[2]));
    if (!met) return std::nullopt;
    const Point3* const point = exact::met_as<Point3>(*met);
    return point == nullptr ? std::nullopt : in_plane(v, *point);
}

std::optional<SignedWeights> found(const Case& c) {
    constexpr std::array of_simplex{segment, triangle, triangle3d, tetrahedron};
    return c.perspective ? perspective(c) : of_simplex[static_cast<std::size_t>(c.simplex)](c);
}

}  // namespace

OracleAnswer ask_cgal(const Case& c) {
    const ExactEnvironment environment;
    const std::optional<SignedWeights> f = found(c);
    if (!f) return degenerate_answer();
    OracleAnswer a;
    Number value = 0;
    bool negative = false;
    const auto count = static_cast<std::size_t>(vertex_count(c.simplex));
    for (std::size_t i = 0; i < count; ++i) {
        a.signs[i] = static_cast<std::int8_t>(f->signs[i]);
        negative = negative || f->signs[i] < 0;
        if (f->signs[i] != 0) a.support = static_cast<std::uint8_t>(a.support | (1U << i));
        a.weights[i] = quotient(f->parts[i], f->whole);
        value += f->parts[i] * Number(c.values[i]);
    }
    a.value = quotient(value, f->whole);
    const int nonzero = std::popcount(a.support);
    const bool whole = nonzero == static_cast<int>(count);
    a.region = negative ? Region::outside : whole ? Region::interior : Region::boundary;
    a.feature = negative       ? Feature::outside
                : whole        ? Feature::interior
                : nonzero == 1 ? Feature::vertex
                : nonzero == 2 ? Feature::edge
                               : Feature::face;
    return a;
}

// Triangles in space.

double oracle_distance(std::span<const double> t, const double* p) {
    const ExactEnvironment environment;
    return rounded_root(rational(CGAL::squared_distance(point3(p), triangle_at(t)).exact()));
}

bool oracle_meet(std::span<const double> a, std::span<const double> b) {
    const ExactEnvironment environment;
    return CGAL::do_intersect(triangle_at(a), triangle_at(b));
}

int oracle_side(std::span<const std::array<double, 9>> triangles, const double* p) {
    const ExactEnvironment environment;
    const Point3 from = point3(p);
    double far = 1;
    for (const auto& t : triangles) {
        if (triangle_at(t).has_on(from)) return 0;
        for (const double x : t) far = std::max(far, std::fabs(x));
    }
    // A power of two well outside, and the next such segment until one meets no edge: each edge rules out a plane.
    far = std::ldexp(4, std::ilogb(far));
    for (int turn = 1;; ++turn) {
        const Point3 to(far, far * (turn / 1024.0), far * (turn * turn % 1021 / 1024.0));
        bool odd = false, doubtful = false;
        for (const auto& t : triangles) {
            const Point3 a = point3(&t[0]), b = point3(&t[3]), c = point3(&t[6]);
            const int ends = CGAL::orientation(a, b, c, from) * CGAL::orientation(a, b, c, to);
            if (ends > 0) continue;
            const int u = CGAL::orientation(from, to, a, b), v = CGAL::orientation(from, to, b, c),
                      w = CGAL::orientation(from, to, c, a);
            const int low = std::min({u, v, w}), high = std::max({u, v, w});
            if (low < 0 && high > 0) continue;
            doubtful = doubtful || ends == 0 || low == 0 || high == 0;
            odd = !odd;
        }
        if (!doubtful) return odd ? 1 : -1;
    }
}

}  // namespace barycert
