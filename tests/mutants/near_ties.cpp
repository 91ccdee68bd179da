#include <gmpxx.h>

#include <cmath>

#include "cases.hpp"

namespace barycert::mutants {
namespace {

/// Exact weights, by the normal equations of the edges from vertex 0; false if the simplex is degenerate.
bool exact_weights(const Case& c, mpq_class (&w)[4]) {
    const int m = vertex_count(c.simplex) - 1, d = space_dimension(c.simplex);
    mpq_class e[4][3], a[3][4];  // edges and, last, the point; the equations
    for (int i = 0; i <= m; ++i) {
        for (int k = 0; k < d; ++k) {
            const double x = i < m ? c.vertex(i + 1, k) : c.point[static_cast<std::size_t>(k)];
            e[i][k] = mpq_class(x) - mpq_class(c.vertex(0, k));
        }
    }
    for (int i = 0; i < m; ++i) {
        for (int j = 0; j <= m; ++j) {
            for (int k = 0; k < d; ++k) a[i][j] += e[i][k] * e[j][k];
        }
    }
    for (int i = 0; i < m; ++i) {
        if (a[i][i] == 0) return false;  // the matrix is positive definite, or singular
        for (int j = m; j >= i; --j) a[i][j] /= a[i][i];
        for (int other = 0; other < m; ++other) {
            if (other == i) continue;
            const mpq_class factor = a[other][i];
            for (int j = i; j <= m; ++j) a[other][j] -= factor * a[i][j];
        }
    }
    w[0] = 1;
    for (int i = 0; i < m; ++i) {
        w[i + 1] = a[i][m];
        w[0] -= w[i + 1];
    }
    return true;
}

/// Weight `which`, or the value if that is -1.
mpq_class quantity(const Case& c, int which) {
    mpq_class w[4], sum;
    if (!exact_weights(c, w)) return 0;
    if (which >= 0) return w[which];
    for (int i = 0; i < vertex_count(c.simplex); ++i) sum += w[i] * mpq_class(c.values[static_cast<std::size_t>(i)]);
    return sum;
}

/// Replaces x, a number of `c` in which the quantity is linear, so that the quantity is as near to `target` as a double
/// can make it.
void steer(const Case& c, double& x, int which, const mpq_class& target) {
    x = 0;
    const mpq_class at_zero = quantity(c, which);
    x = 1;
    const mpq_class slope = quantity(c, which) - at_zero;
    if (slope == 0) return;
    const mpq_class exact = (target - at_zero) / slope;
    x = exact.get_d();  // truncated: nearly as good, and of both signs
}

/// A simplex with volume of the order 2^-flat, its point within or far away.
Case shape(Simplex s, int flat, base::Random& random) {
    Case c;
    c.simplex = s;
    const int n = vertex_count(s), d = space_dimension(s);
    const int far = random.below(3) == 0 ? random.integer(1, 24) : 0;
    const int offset = random.below(3) == 0 ? random.integer(1, 30) : 0;  // along the first axis alone
    double mix[3];
    for (double& m : mix) m = random.uniform(-1, 1);
    for (int k = 0; k < d; ++k) {
        for (int i = 0; i < n; ++i) c.vertex(i, k) = random.uniform(-1, 1);
        if (flat > 0 && n > 2) {
            double x = c.vertex(0, k);
            for (int i = 1; i < n - 1; ++i) x += mix[i] * (c.vertex(i, k) - c.vertex(0, k));
            c.vertex(n - 1, k) = x + std::ldexp(c.vertex(n - 1, k), -flat);
        }
        c.point[static_cast<std::size_t>(k)] = std::ldexp(random.uniform(-1, 1), far);
    }
    if (random.coin() && n > 2) {  // the flat direction is not always that of the last vertex
        const int other = random.integer(0, n - 2);
        for (int k = 0; k < d; ++k) std::swap(c.vertex(other, k), c.vertex(n - 1, k));
    }
    if (offset > 0) {
        for (int i = 0; i < n; ++i) c.vertex(i, 0) += std::ldexp(1, offset);
        c.point[0] += std::ldexp(1, offset);
    }
    for (double& f : c.values) f = random.scaled(-1, 1, -4, 0);
    return c;
}

/// Moves the point of a simplex in 3-space far off, nearly normal to the simplex and to an axis: its weights stay, the
/// terms of which they are made cancel.
void lift(Case& c, int axis, base::Random& random) {
    const int x = (axis + 1) % 3, y = (axis + 2) % 3;
    const double o[2] = {c.vertex(0, x), c.vertex(0, y)};
    const double e[2] = {c.vertex(1, x) - o[0], c.vertex(1, y) - o[1]};
    const double along = random.uniform(-1, 2), far = std::ldexp(random.coin() ? 1 : -1, random.integer(0, 40));
    if (c.simplex == Simplex::triangle3d) {  // the plane holds the axis
        const double m = random.uniform(-1, 2);
        c.vertex(2, x) = o[0] + m * e[0];
        c.vertex(2, y) = o[1] + m * e[1];
    }
    c.point[static_cast<std::size_t>(x)] = o[0] + along * e[0] - far * e[1];
    c.point[static_cast<std::size_t>(y)] = o[1] + along * e[1] + far * e[0];
}

/// To where ranges end: a power of two for each axis, or one for all where only that leaves the weights as they are.
void scale(Case& c, base::Random& random) {
    const int n = vertex_count(c.simplex), d = space_dimension(c.simplex);
    const bool projected = c.simplex == Simplex::segment || c.simplex == Simplex::triangle3d;
    static constexpr int ends[] = {-200, -300, 300, 330, -340, 500, 890};
    static constexpr int projected_ends[] = {-200, -151, -165, 99, 299, -100, 160};
    int e = 0;
    for (int k = 0; k < d; ++k) {
        const bool anew = !projected || k == 0;
        if (anew) e = (projected ? projected_ends : ends)[random.below(7)] + random.integer(-5, 5);
        if (anew && random.coin()) e = 0;
        for (int i = 0; i < n; ++i) c.vertex(i, k) = std::ldexp(c.vertex(i, k), e);
        double& p = c.point[static_cast<std::size_t>(k)];
        p = std::ldexp(p, e);
    }
    static constexpr int value_ends[] = {-800, 900, -969, -640};
    const int by = random.coin() ? 0 : value_ends[random.below(4)] + random.integer(-4, 4);
    for (double& f : c.values) f = std::ldexp(f, by);
}

}  // namespace

void add_near_ties(Simplex s, std::vector<Record>& records) {
    base::Random random = base::Random::stream(11, static_cast<std::uint64_t>(s), 7);
    const int n = vertex_count(s), d = space_dimension(s);
    for (int i = 0; i < 12000; ++i) {
        const int flat = s == Simplex::segment || random.below(3) == 0 ? 0 : random.integer(1, 22);
        Record r;
        r.group = Group::near_ties;
        Case& c = r.c = shape(s, flat, random);
        const int which = i % 3 == 0 ? -1 : random.integer(0, n - 1);
        // two numbers to steer by, the second one for what the first leaves
        double* by[2];
        if (which < 0) {
            const int first = random.integer(0, n - 1);
            by[0] = &c.values[static_cast<std::size_t>(first)];
            by[1] = &c.values[static_cast<std::size_t>((first + 1) % n)];
        } else {
            const int first = random.integer(1, d - 1);
            by[0] = &c.point[static_cast<std::size_t>(first)];
            by[1] = d == 3 ? &c.point[static_cast<std::size_t>(3 - first)] : &c.point[0];
            if (d == 2) by[1] = by[0];
        }
        const bool projected = s == Simplex::segment || s == Simplex::triangle3d;
        const bool lifted = projected && random.coin();
        if (lifted) {
            lift(c, which < 0 ? random.integer(0, 2) : static_cast<int>(by[0] - c.point.data()), random);
        } else if (by[1] != by[0] && random.coin()) {
            *by[1] = 0;
        }
        *by[0] = 0;
        const double near = quantity(c, which).get_d();
        if (near == 0) continue;
        const double next = std::nextafter(near, random.coin() ? HUGE_VAL : -HUGE_VAL);
        const mpq_class tie = (mpq_class(near) + mpq_class(next)) / 2;
        const int closeness = random.integer(100 - 2 * flat - (lifted ? 40 : 0), 112);
        const double beyond = (random.coin() ? 1 : -1) * std::ldexp(random.uniform(1, 2) * near, -closeness);
        const mpq_class target = tie + mpq_class(beyond);
        steer(c, *by[0], which, target);
        if (!lifted && by[1] != by[0] && *by[1] == 0) steer(c, *by[1], which, target);
        if (random.below(4) == 0) scale(c, random);
        records.push_back(r);
    }
}

}  // namespace barycert::mutants
