// Families of simplices of bad shape: flat, thin, on lattices, degenerate; and of coordinates at the ends of the range.

#include <cstddef>

#include "barycert/audit/recipes.hpp"

namespace barycert::audit {
namespace {

// A simplex of height h; the point is a rounded combination of its vertices.
template <int decimals>
void sliver(Case& c, base::Random& random, std::uint64_t) {
    ordinary(c, random);
    const int n = vertex_count(c.simplex);
    set_vertex(c, n - 1, lifted(c, random, random_point(c, random, n - 1), decimal_height<decimals>));
    c.point = random_point(c, random, n);
}

/// Small integer vectors times small integers: sums are exact, so that the vertices span exactly `dimension` or less.
void flat(Case& c, base::Random& random, int dimension) {
    const auto integer_vector = [&] {
        return std::array<double, 3>{static_cast<double>(random.integer(-9, 9)),
                                     static_cast<double>(random.integer(-9, 9)),
                                     static_cast<double>(random.integer(-9, 9))};
    };
    const auto origin = integer_vector(), u = integer_vector(), v = integer_vector();
    const double unit = std::ldexp(1, random.integer(-20, 20));
    for (int i = 0; i < vertex_count(c.simplex); ++i) {
        const double s = dimension >= 1 ? random.integer(-9, 9) : 0;
        const double t = dimension >= 2 ? random.integer(-9, 9) : 0;
        for (std::size_t k = 0; k < static_cast<std::size_t>(space_dimension(c.simplex)); ++k)
            c.vertex(i, static_cast<int>(k)) = unit * (origin[k] + s * u[k] + t * v[k]);
    }
    const auto p = integer_vector();
    for (std::size_t k = 0; k < static_cast<std::size_t>(space_dimension(c.simplex)); ++k) c.point[k] = unit * p[k];
    random_values(c, random);
}

template <int dimension>
void degenerate(Case& c, base::Random& random, std::uint64_t) {
    flat(c, random, dimension);
}

template <int exponent>
void scaled(Case& c, base::Random& random, std::uint64_t) {
    fill(c, random, [&](int) { return std::ldexp(random.uniform(-1, 1), exponent); });
}

}  // namespace

std::vector<Family> shape_families() {
    return {
        {"sliver.1e-12", "flat cells: a small divisor magnifies every error", "height 1e-12, point fl(sum w_i v_i)",
         sided, sliver<12>},
        {"sliver.1e-13", "the same at 1e-13", "height 1e-13", sided, sliver<13>},
        {"sliver.1e-14", "the same at 1e-14", "height 1e-14", sided, sliver<14>},
        {"sliver.1e-15", "the same at 1e-15: the height is a few ulps", "height 1e-15", sided, sliver<15>},
        {"needle", "cells with one very short edge", "two vertices 2^-10 to 2^-40 apart", every,
         [](Case& c, base::Random& random, std::uint64_t) {
             ordinary(c, random);
             const double gap = std::ldexp(1, -random.integer(10, 40));
             for (int axis = 0; axis < space_dimension(c.simplex); ++axis)
                 c.vertex(1, axis) = c.vertex(0, axis) + gap * random.uniform(-1, 1);
             c.point = random_point(c, random, vertex_count(c.simplex));
         }},
        {"cap", "cells with a vertex close to the opposite facet", "height 2^-10 to 2^-40", sided,
         // Over the middle of the facet, of whose size the height is such a part.
         [](Case& c, base::Random& random, std::uint64_t) {
             ordinary(c, random);
             const int n = vertex_count(c.simplex);
             const double third = 1.0 / (n - 1);
             const auto middle = combination(c, {third, third, third, third}, n - 1);
             set_vertex(c, n - 1, lifted(c, random, middle, random.scaled(0.5, 1, -40, -10)));
             c.point = random_point(c, random, n);
         }},
        {"lattice.tenths", "ties in decimals that rounding breaks", "0.1 k, k in 0..4", every,
         [](Case& c, base::Random& random, std::uint64_t) {
             fill(c, random, [&](int) { return 0.1 * random.integer(0, 4); });
         }},
        {"lattice.integers", "exact zeros, and exactly degenerate cells", "k in 0..4", every,
         [](Case& c, base::Random& random, std::uint64_t) {
             fill(c, random, [&](int) { return static_cast<double>(random.integer(0, 4)); });
         }},
        {"midpoints", "ties: values midway between two doubles", "k 2^-20, |k| <= 2^20; amid an edge; values U[1,2)",
         every,
         // A value is half a sum of two doubles of one binade, and every other one lies midway between two doubles.
         [](Case& c, base::Random& random, std::uint64_t) {
             fill(c, random, [&](int) { return std::ldexp(random.integer(-(1 << 20), 1 << 20), -20); });
             const int n = vertex_count(c.simplex);
             const int i = random.integer(0, n - 1);
             const int j = (i + random.integer(1, n - 1)) % n;
             for (int axis = 0; axis < space_dimension(c.simplex); ++axis)
                 c.point[static_cast<std::size_t>(axis)] = (c.vertex(i, axis) + c.vertex(j, axis)) / 2;
             for (int k = 0; k < n; ++k) c.values[static_cast<std::size_t>(k)] = 1 + random.unit();
         }},
        {"degenerate.point", "degenerate cells: all vertices coincide", "small integers times 2^[-20,20]", every,
         degenerate<0>},
        {"degenerate.line", "degenerate cells: all vertices on one line", "a + s u, small integers times 2^[-20,20]",
         sided, degenerate<1>},
        {"degenerate.plane", "degenerate cells: all vertices in one plane",
         "a + s u + t v, small integers times 2^[-20,20]", tetrahedron_only, degenerate<2>},
        {"nearly-degenerate", "cells one ulp away from degenerate",
         "a flat simplex times 0.1, one coordinate moved by one ulp", every,
         [](Case& c, base::Random& random, std::uint64_t) {
             flat(c, random, vertex_count(c.simplex) - 2);
             for (double& x : c.vertices) x *= 0.1;
             for (double& x : c.point) x *= 0.1;
             const int d = space_dimension(c.simplex);
             const auto moved = random.below(static_cast<std::uint64_t>(vertex_count(c.simplex) * d));
             move_by_ulp(c, c.vertices[moved], static_cast<int>(moved) % d, random);
         }},
        // At the ends of the range of doubles, where products and differences under- and overflow.
        {"subnormal", "subnormal coordinates: every product is zero", "k 2^-1074, |k| <= 4096", every,
         [](Case& c, base::Random& random, std::uint64_t) {
             fill(c, random, [&](int) { return random.integer(-4096, 4096) * 0x1p-1074; });
         }},
        {"small", "products of three coordinates underflow", "U[-1,1) 2^-400", every, scaled<-400>},
        {"tiny", "products of two coordinates underflow", "U[-1,1) 2^-540", every, scaled<-540>},
        {"large", "products overflow, differences do not", "U[-1,1) 2^600", every, scaled<600>},
        {"huge", "differences and products overflow", "U[-1,1) 0.999 2^1024", every,
         [](Case& c, base::Random& random, std::uint64_t) {
             fill(c, random, [&](int) { return random.uniform(-1, 1) * 0.999 * 0x1p1023 * 2; });
         }},
        {"mixed-scale", "axes of very different scales", "axes times 2^512, 2^-512, 1", every,
         [](Case& c, base::Random& random, std::uint64_t) {
             fill(c, random, [&](int axis) {
                 return std::ldexp(random.uniform(-1, 1), axis == 0 ? 512 : axis == 1 ? -512 : 0);
             });
         }},
        {"filter-underflow", "filters whose error bound ignores underflow",
         "face at 2^-537 and 2^600, point at its plane's origin", tetrahedron_only,
         // Products that underflow to zero in one term and are large in another: a filter whose bound ignores underflow
         // certifies a wrong sign here.
         [](Case& c, base::Random& random, std::uint64_t) {
             const auto m = [&](int exponent) { return std::ldexp(random.uniform(0.5, 2), exponent); };
             for (const int i : {0, 1}) set_vertex(c, i, {m(-537), 0, m(600)});
             set_vertex(c, 2, {0, m(-537), 0});
             set_vertex(c, 3, {m(600), m(600), m(-537)});
             random_values(c, random);
         }},
    };
}

}  // namespace barycert::audit
