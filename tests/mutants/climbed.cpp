#include <gmpxx.h>

#include <cfenv>
#include <cmath>
#include <cstdio>

#include "cases.hpp"

namespace barycert::mutants {
namespace {

void move_by(double& x, base::Random& random) {
    const int ulps = random.integer(-3, 3);
    for (int i = 0; i < std::abs(ulps); ++i) x = std::nextafter(x, ulps < 0 ? -HUGE_VAL : HUGE_VAL);
}

/// A formula of numerators-inl.hpp in any arithmetic, and the quantity that the filter's constant multiplies.
template <class T>
T formula(const T (&r)[4][3], const T (&e)[2][3], Simplex s, Quantity quantity) {
    const auto cross = [](const T(&x)[3], const T(&y)[3], T(&out)[3]) {
        out[0] = x[1] * y[2] - x[2] * y[1];
        out[1] = x[2] * y[0] - x[0] * y[2];
        out[2] = x[0] * y[1] - x[1] * y[0];
    };
    const auto dot = [](const T(&x)[3], const T(&y)[3]) { return T(T(x[0] * y[0] + x[1] * y[1]) + x[2] * y[2]); };
    if (s == Simplex::tetrahedron) {
        T m01[3], m23[3];
        cross(r[0], r[1], m01);
        cross(r[2], r[3], m23);
        if (quantity == Quantity::numerator) return dot(r[1], m23);
        return T(T(dot(r[1], m23) - dot(r[0], m23)) + T(dot(r[3], m01) - dot(r[2], m01)));
    }
    if (s == Simplex::triangle) {
        const auto n = [&](int i) {
            const T(&x)[3] = r[(i + 1) % 3];
            const T(&y)[3] = r[(i + 2) % 3];
            return T(x[0] * y[1] - x[1] * y[0]);
        };
        return quantity == Quantity::numerator ? n(0) : T(T(n(0) + n(1)) + n(2));
    }
    if (s == Simplex::segment) return quantity == Quantity::numerator ? dot(r[1], e[0]) : dot(e[0], e[0]);
    T normal[3], m[3];
    cross(e[0], e[1], normal);
    cross(r[1], r[2], m);
    return quantity == Quantity::numerator ? dot(normal, m) : dot(normal, normal);
}

template <class T, class Convert>
T evaluate(const Case& c, Quantity q, Convert convert) {
    T r[4][3] = {}, e[2][3] = {};
    for (int k = 0; k < space_dimension(c.simplex); ++k) {
        const T p = convert(c.point[static_cast<std::size_t>(k)]);
        for (int i = 0; i < vertex_count(c.simplex); ++i) {
            r[i][k] = convert(c.vertex(i, k)) - p;
            if (i == 1 || i == 2) e[i - 1][k] = convert(c.vertex(i, k)) - convert(c.vertex(0, k));
        }
    }
    return formula<T>(r, e, c.simplex, q);
}

/// |determinant in double| over the filter's unit, 2^-52 times the product of extents; negative if its sign is right.
double badness(const Case& c, Quantity q) {
    const volatile double fl = evaluate<double>(c, q, [](double x) { return x; });
    const auto as_integer = [](double x) { return mpz_class(std::ldexp(x, 400)); };
    const int exact = sgn(evaluate<mpz_class>(c, q, as_integer));
    double r[3] = {}, e[3] = {};
    for (int k = 0; k < space_dimension(c.simplex); ++k) {
        for (int i = 0; i < vertex_count(c.simplex); ++i) {
            r[k] = std::max(r[k], std::fabs(c.vertex(i, k) - c.point[static_cast<std::size_t>(k)]));
            e[k] = std::max(e[k], std::fabs(c.vertex(i, k) - c.vertex(0, k)));
        }
    }
    const auto minors = [](const double* x, const double* y) {
        return 4 * (x[1] * y[1] * x[2] * y[2] + x[0] * y[0] * x[2] * y[2] + x[0] * y[0] * x[1] * y[1]);
    };
    const double unit = c.simplex == Simplex::tetrahedron ? r[0] * r[1] * r[2]
                        : c.simplex == Simplex::triangle  ? r[0] * r[1]
                        : c.simplex == Simplex::segment   ? r[0] * e[0] + r[1] * e[1] + r[2] * e[2]
                        : q == Quantity::numerator        ? minors(e, r)
                                                          : minors(e, e);
    const double size = std::fabs(fl) / (unit * 0x1p-52);
    const int computed = fl > 0 ? 1 : fl < 0 ? -1 : 0;
    return exact == 0 || exact != computed ? size : -size;
}

}  // namespace

/// Climbs from a simplex whose determinant vanishes but for the point's (or origin's) last bits.
void climb(Simplex s, Quantity q, int mode, base::Random& random, std::vector<Record>& records) {
    const int n = vertex_count(s), d = space_dimension(s);
    double best_of_all = 0;
    for (int start = 0; start < 6; ++start) {
        Case c;
        c.simplex = s;
        const auto side = [&] { return (random.coin() ? 1 : -1) * (1 + random.integer(0, 8) * 0x1p-52); };
        for (int i = 0; i < n; ++i) {
            for (int k = 0; k < d; ++k) c.vertex(i, k) = start % 2 == 0 ? side() : random.uniform(-1, 1);
        }
        // coplanar: with the point, or among themselves
        const int flat = q == Quantity::numerator ? n - 1 : n - 1;
        for (int k = 0; k < d; ++k) {
            c.point[static_cast<std::size_t>(k)] = std::ldexp(random.uniform(-1, 1), -53);
            if (q == Quantity::numerator && s != Simplex::segment && s != Simplex::triangle3d)
                c.vertex(flat, k) = n == 4 ? -(c.vertex(1, k) + c.vertex(2, k)) / 2 : -c.vertex(1, k);
            if (q == Quantity::denominator)
                c.vertex(flat, k) = n == 4
                                        ? (c.vertex(0, k) + c.vertex(1, k)) / 2 + (c.vertex(2, k) - c.vertex(1, k)) / 4
                                        : (c.vertex(0, k) + 3 * c.vertex(1, k)) / 4;
        }
        double best = -HUGE_VAL;
        Case kept = c;
        for (int step = 0; step < 25000; ++step) {
            Case next = kept;
            for (int moves = random.integer(1, 3); moves > 0; --moves) {
                const auto at = static_cast<std::size_t>(random.below(static_cast<std::uint64_t>((n + 1) * d)));
                double& x = at < static_cast<std::size_t>(n * d) ? next.vertices[at]
                                                                 : next.point[at - static_cast<std::size_t>(n * d)];
                const auto kind = random.below(4);
                if (kind == 0) move_by(x, random);
                if (kind == 1) x += std::ldexp(random.uniform(-1, 1), -random.integer(1, 60));
                if (kind == 2)
                    x = std::fabs(x) > 0x1p-30 ? x * (1 + std::ldexp(random.uniform(-1, 1), -random.integer(2, 52)))
                                               : std::ldexp(random.uniform(-1, 1), -random.integer(50, 60));
                if (kind == 3) x = -x;
            }
            std::fesetround(mode);
            const double b = badness(next, q);
            std::fesetround(FE_TONEAREST);
            if (std::isfinite(b) && b >= best) {
                if (b > 0 && b > best * 1.02) {
                    Record r;
                    r.c = next;
                    r.group = Group::climbed;
                    records.push_back(r);
                    if (s == Simplex::tetrahedron || s == Simplex::triangle) {
                        // the cell of which this quantity is a numerator that leaves the rest clear of the bound
                        Record far = r;
                        for (int k = 0; k < d; ++k) {
                            if (q == Quantity::numerator) far.c.vertex(0, k) = random.uniform(-1, 1);
                            if (q == Quantity::denominator)
                                far.c.point[static_cast<std::size_t>(k)] = random.uniform(-1, 1) * 0x1p-52 + 0x1p-53;
                        }
                        records.push_back(far);
                    }
                }
                best = b;
                kept = next;
            }
        }
        best_of_all = std::max(best_of_all, best);
    }
    std::printf("  %-11s %-11s mode %d: up to %.2f e\n", std::string(name(s)).c_str(),
                q == Quantity::numerator ? "numerator" : "denominator", mode, best_of_all);
}

}  // namespace barycert::mutants
