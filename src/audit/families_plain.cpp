// Families of points near or on a facet of an ordinary simplex, where sums of products cancel; of simplices of bad
// shape: flat, thin, on lattices, degenerate; and of coordinates at the ends of the range.

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "audit/recipes.hpp"
#include "barycert/family.hpp"
#include "barycert/simplex.hpp"
#include "core/base/random.hpp"

namespace barycert::audit {
namespace {

/// 10 to the power of -12 to -15: Clang 14 takes no double as an argument of a template.
template <int decimals>
constexpr double decimal_height = std::array{1e-12, 1e-13, 1e-14, 1e-15}[decimals - 12];

// The three grids of Kettner, Mehlhorn, Pion, Schirra and Yap: p, q and r nearly on a line, p over a grid of
// neighbouring doubles.
struct CoordinateGrid {
    std::array<double, 2> p, q, r, apex;
};

constexpr std::array<CoordinateGrid, 3> grids{
    {{{0.5, 0.5}, {12, 12}, {24, 24}, {24, 12}},
     {{0.50000000000002531, 0.5000000000000171},
      {17.300000000000001, 17.300000000000001},
      {24.00000000000005, 24.0000000000000517765},
      {24, 17.3}},
     {{0.5, 0.5}, {8.8000000000000007, 8.8000000000000007}, {12.1, 12.1}, {12.1, 8.8}}}};

template <std::size_t number>
void ulp_grid(Case& c, base::Random& random, std::uint64_t index) {
    const CoordinateGrid& g = grids[number - 1];
    const auto cell = index * 40503 % 65536;  // 256 x 256 points; an odd factor visits each once, well spread
    set_vertex(c, 0, {g.q[0], g.q[1], 0});
    set_vertex(c, 1, {g.r[0], g.r[1], 0});
    set_vertex(c, 2, {g.apex[0], g.apex[1], 0});
    const std::uint64_t column = cell % 256, row = cell / 256;
    c.point = {g.p[0] + static_cast<double>(column) * 0x1p-53, g.p[1] + static_cast<double>(row) * 0x1p-53, 0};
    random_values(c, random);
}

template <int Exponent>
void offset(Case& c, base::Random& random, std::uint64_t) {
    const double o = std::ldexp(1, Exponent);
    fill(c, random, [&](int) { return o + random.unit(); });
}

template <int origin>
void on_facet(Case& c, base::Random& random, std::uint64_t) {
    fill(c, random, [&](int) { return origin + random.unit(); });
    c.point = random_point(c, random, vertex_count(c.simplex) - 1);
}

// A good simplex and a point at height h over one of its facets.
template <int decimals>
void near_facet(Case& c, base::Random& random, std::uint64_t) {
    ordinary(c, random);
    const int n = vertex_count(c.simplex) - 1;
    const double height = random.coin() ? decimal_height<decimals> : -decimal_height<decimals>;
    c.point = lifted(c, random, random_point(c, random, n), height);
}

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
        return std::array{double(random.integer(-9, 9)), double(random.integer(-9, 9)), double(random.integer(-9, 9))};
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

/// Points near or on a facet.
std::vector<Family> families_near_facets() {
    return {
        {"random", "random simplices and points, for comparison", "all coordinates U[-1,1)", every, ordinary},
        {"random.inside", "random simplices, points inside", "U[-1,1), point fl(sum w_i v_i)", every,
         [](Case& c, base::Random& random, std::uint64_t) {
             ordinary(c, random);
             c.point = random_point(c, random, vertex_count(c.simplex));
         }},
        {"ulp-grid.1", "points on a grid of one ulp around an edge",
         "p = (.5,.5) + 2^-53 (i,j), 256 x 256; edge (12,12)(24,24)", triangle_only, ulp_grid<1>},
        {"ulp-grid.2", "the same around a nearly diagonal edge",
         "p = (.50000000000002531,.5000000000000171) + 2^-53 (i,j); edge (17.3)^2 "
         "(24.00000000000005,24.0000000000000517765)",
         triangle_only, ulp_grid<2>},
        {"ulp-grid.3", "the same around an edge of rounded decimals",
         "p = (.5,.5) + 2^-53 (i,j); edge (8.8)^2 (12.1)^2", triangle_only, ulp_grid<3>},
        {"diagonal", "points on or near the diagonal through an edge",
         "edge (12)^n (24)^n, others U[0,48), point (.5 + 5e-14 U)^n", solid,
         // On x = y = z: the other weights are exactly zero.
         [](Case& c, base::Random& random, std::uint64_t) {
             ordinary(c, random);
             const double t = 0.5 + 5e-14 * random.unit();
             set_vertex(c, 0, {12, 12, 12});
             set_vertex(c, 1, {24, 24, 24});
             for (int i = 2; i < vertex_count(c.simplex); ++i)
                 set_vertex(c, i, {random.uniform(0, 48), random.uniform(0, 48), random.uniform(0, 48)});
             c.point = {t, t, space_dimension(c.simplex) == 3 ? t : 0.0};
         }},
        {"coplanar", "points computed in the plane of a facet", "a + s(b-a) + t(c-a), s,t U[-1,2)", solid,
         // In the plane (on the line) of the first n - 1 vertices, not only between them.
         [](Case& c, base::Random& random, std::uint64_t) {
             ordinary(c, random);
             const bool plane = vertex_count(c.simplex) == 4;
             const double s = random.uniform(-1, 2), t = plane ? random.uniform(-1, 2) : 0;
             for (int axis = 0; axis < space_dimension(c.simplex); ++axis) {
                 const double a = c.vertex(0, axis);
                 double& x = c.point[static_cast<std::size_t>(axis)] = a + s * (c.vertex(1, axis) - a);
                 if (plane) x += t * (c.vertex(2, axis) - a);
             }
         }},
        {"anisotropic-plane", "facet planes with products of very different magnitude",
         "x = U 2^[0,20), y = U 2^-[0,20), z = -(n0 x + n1 y)/n2; in 2D y = -n0 x/n1", solid,
         // Four points of a plane (three of a line) through the origin whose coordinates span 40 binary orders of
         // magnitude: each product has a different size, so the sums cancel completely. The last vertex is anywhere.
         [](Case& c, base::Random& random, std::uint64_t) {
             const std::array<double, 3> n{random.uniform(0.5, 1), random.uniform(0.5, 1), random.uniform(0.5, 1)};
             const auto large = [&] { return random.scaled(-1, 1, 0, 19); };
             const auto small = [&] { return random.scaled(-1, 1, -19, 0); };
             const auto point = [&] {
                 const double x = large();
                 if (c.simplex == Simplex::triangle) return std::array<double, 3>{x, -(n[0] * x) / n[1], 0};
                 const double y = small();
                 return std::array<double, 3>{x, y, -(n[0] * x + n[1] * y) / n[2]};
             };
             const int last = vertex_count(c.simplex) - 1;
             for (int i = 0; i < last; ++i) set_vertex(c, i, point());
             set_vertex(c, last, {large(), small(), large()});
             c.point = point();
             random_values(c, random);
         }},
        {"offset.2^17", "cells far from the origin: absolute coordinates cancel", "2^17 + U[0,1)", every, offset<17>},
        {"offset.2^20", "the same, farther out", "2^20 + U[0,1)", every, offset<20>},
        {"on-facet", "points computed on a facet, in the unit cube", "U[0,1), fl(sum w_i v_i) over n-1 vertices", sided,
         on_facet<0>},
        {"on-facet.offset", "the same at 1000, where differences are exact", "1000 + U[0,1)", sided, on_facet<1000>},
        {"near-facet.1e-13", "points at height 1e-13 above or below a facet", "U[-1,1), h = +-1e-13", sided,
         near_facet<13>},
        {"near-facet.1e-14", "the same at 1e-14", "U[-1,1), h = +-1e-14", sided, near_facet<14>},
        {"near-facet.1e-15", "the same at 1e-15", "U[-1,1), h = +-1e-15", sided, near_facet<15>},
    };
}

/// Cells of bad shape.
std::vector<Family> families_of_bad_shape() {
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
    };
}

/// Coordinates at the ends of the range of doubles, where products and differences under- and overflow.
std::vector<Family> families_at_ends_of_range() {
    return {
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

}  // namespace

std::vector<Family> plain_families() {
    std::vector<Family> all = families_near_facets();
    for (const auto& more : {families_of_bad_shape(), families_at_ends_of_range()})
        all.insert(all.end(), more.begin(), more.end());
    return all;
}

}  // namespace barycert::audit
