// Triangles in space by CGAL's kernel of exact predicates and exact constructions.

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <mpfr.h>

#include <algorithm>

#include "barycert/environment.hpp"
#include "barycert/exact/rational.hpp"
#include "barycert/oracle.hpp"

namespace barycert {
namespace {

using Epeck = CGAL::Exact_predicates_exact_constructions_kernel;
using Point = Epeck::Point_3;

Point point(const double* x) {
    return {x[0], x[1], x[2]};
}

Epeck::Triangle_3 triangle(std::span<const double> t) {
    return {point(&t[0]), point(&t[3]), point(&t[6])};
}

/// sqrt(x), rounded once. With k such that x 4^k has more than 2 * 56 bits, its root has more than 56, which stand in
/// front of a last bit that says whether there is more.
double rounded_root(mpq_srcptr x) {
    if (mpq_sgn(x) == 0) return 0;
    mpz_t n, rest;
    mpz_inits(n, rest, nullptr);
    const long bits =
        static_cast<long>(mpz_sizeinbase(mpq_numref(x), 2)) - static_cast<long>(mpz_sizeinbase(mpq_denref(x), 2));
    const long k = std::max(0L, (116 - bits) / 2);
    mpz_mul_2exp(n, mpq_numref(x), static_cast<mp_bitcnt_t>(2 * k));
    mpz_fdiv_qr(n, rest, n, mpq_denref(x));
    const bool divides = mpz_sgn(rest) == 0;
    mpz_sqrtrem(n, rest, n);
    const bool more = !divides || mpz_sgn(rest) != 0;
    mpz_mul_2exp(n, n, 1);
    if (more) mpz_add_ui(n, n, 1);
    const double root = exact::Rounder()([&](mpfr_t to) { return mpfr_set_z_2exp(to, n, -k - 1, MPFR_RNDN); });
    mpz_clears(n, rest, nullptr);
    return root;
}

}  // namespace

double oracle_distance(std::span<const double> t, const double* p) {
    const ExactEnvironment environment;
    return rounded_root(exact::rational(CGAL::squared_distance(point(p), triangle(t)).exact()));
}

bool oracle_meet(std::span<const double> a, std::span<const double> b) {
    const ExactEnvironment environment;
    return CGAL::do_intersect(triangle(a), triangle(b));
}

int oracle_side(std::span<const std::array<double, 9>> triangles, const double* p) {
    const ExactEnvironment environment;
    const Point from = point(p);
    double far = 1;
    for (const auto& t : triangles) {
        if (triangle(t).has_on(from)) return 0;
        for (const double x : t) far = std::max(far, std::fabs(x));
    }
    // A power of two well outside, and the next such segment until one meets no edge: each edge rules out a plane.
    far = std::ldexp(4, std::ilogb(far));
    for (int turn = 1;; ++turn) {
        const Point to(far, far * (turn / 1024.0), far * (turn * turn % 1021 / 1024.0));
        bool odd = false, doubtful = false;
        for (const auto& t : triangles) {
            const Point a = point(&t[0]), b = point(&t[3]), c = point(&t[6]);
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
