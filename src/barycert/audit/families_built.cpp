// Families built for a purpose, independent of any mesh.

#include <cmath>
#include <cstddef>

#include "barycert/audit/combine.hpp"
#include "barycert/audit/families.hpp"
#include "barycert/core/ulp.hpp"

namespace barycert::audit {
namespace {

/// Every coordinate of every vertex, and of the point, from `make(axis)`.
template <class Make>
void fill(Case& c, Random& random, Make make) {
    for (int axis = 0; axis < space_dimension(c.simplex); ++axis) {
        for (int i = 0; i < vertex_count(c.simplex); ++i) c.vertex(i, axis) = make(axis);
        c.point[static_cast<std::size_t>(axis)] = make(axis);
    }
    random_values(c, random);
}

void ordinary(Case& c, Random& random, std::uint64_t = 0) {
    fill(c, random, [&](int) { return random.uniform(-1, 1); });
}

void ordinary_inside(Case& c, Random& random, std::uint64_t = 0) {
    ordinary(c, random);
    c.point = random_point(c, random, vertex_count(c.simplex));
}

// The three grids of Kettner, Mehlhorn, Pion, Schirra and Yap: p, q and r nearly on a line, p over a grid of
// neighbouring doubles.
struct Grid {
    std::array<double, 2> p, q, r, apex;
};

void ulp_grid(Case& c, Random& random, std::uint64_t index, const Grid& g) {
    const auto cell = index * 40503 % 65536;  // 256 x 256 points; an odd factor visits each once, well spread
    set_vertex(c, 0, {g.q[0], g.q[1], 0});
    set_vertex(c, 1, {g.r[0], g.r[1], 0});
    set_vertex(c, 2, {g.apex[0], g.apex[1], 0});
    const std::uint64_t column = cell % 256, row = cell / 256;
    c.point = {g.p[0] + static_cast<double>(column) * 0x1p-53, g.p[1] + static_cast<double>(row) * 0x1p-53, 0};
    random_values(c, random);
}

void ulp_grid_1(Case& c, Random& random, std::uint64_t index) {
    ulp_grid(c, random, index, {{0.5, 0.5}, {12, 12}, {24, 24}, {24, 12}});
}
void ulp_grid_2(Case& c, Random& random, std::uint64_t index) {
    ulp_grid(c, random, index,
             {{0.50000000000002531, 0.5000000000000171},
              {17.300000000000001, 17.300000000000001},
              {24.00000000000005, 24.0000000000000517765},
              {24, 17.3}});
}
void ulp_grid_3(Case& c, Random& random, std::uint64_t index) {
    ulp_grid(c, random, index, {{0.5, 0.5}, {8.8000000000000007, 8.8000000000000007}, {12.1, 12.1}, {12.1, 8.8}});
}

// The diagonal x = y = z carries an edge and the point: two weights are exactly zero.
void diagonal(Case& c, Random& random, std::uint64_t) {
    ordinary(c, random);
    const int n = vertex_count(c.simplex);
    const double t = 0.5 + 5e-14 * random.unit();
    set_vertex(c, 0, {12, 12, 12});
    set_vertex(c, 1, {24, 24, 24});
    for (int i = 2; i < n; ++i) set_vertex(c, i, {random.uniform(0, 48), random.uniform(0, 48), random.uniform(0, 48)});
    c.point = {t, t, space_dimension(c.simplex) == 3 ? t : 0.0};
}

// In the plane (on the line) of the first n - 1 vertices, not only between them.
void coplanar(Case& c, Random& random, std::uint64_t) {
    ordinary(c, random);
    const int n = vertex_count(c.simplex);
    const double s = random.uniform(-1, 2), t = n == 4 ? random.uniform(-1, 2) : 0;
    for (int axis = 0; axis < space_dimension(c.simplex); ++axis) {
        const double a = c.vertex(0, axis);
        double x = a + s * (c.vertex(1, axis) - a);
        if (n == 4) x += t * (c.vertex(2, axis) - a);
        c.point[static_cast<std::size_t>(axis)] = x;
    }
}

// Four points of a plane (three of a line) through the origin whose coordinates span 40 binary orders of magnitude:
// each product has a different size, so the sums cancel completely. The last vertex is anywhere.
void anisotropic_plane(Case& c, Random& random, std::uint64_t) {
    const std::array<double, 3> normal{random.uniform(0.5, 1), random.uniform(0.5, 1), random.uniform(0.5, 1)};
    const auto scale = [&](int sign) { return sign > 0 ? random.scaled(-1, 1, 0, 19) : random.scaled(-1, 1, -19, 0); };
    const auto point = [&] {
        const double x = scale(1);
        if (c.simplex == Simplex::triangle) return std::array<double, 3>{x, -(normal[0] * x) / normal[1], 0};
        const double y = scale(-1);
        return std::array<double, 3>{x, y, -(normal[0] * x + normal[1] * y) / normal[2]};
    };
    const int n = vertex_count(c.simplex);
    for (int i = 0; i < n - 1; ++i) set_vertex(c, i, point());
    set_vertex(c, n - 1, {scale(1), scale(-1), scale(1)});
    c.point = point();
    random_values(c, random);
}

template <int Exponent>
void offset(Case& c, Random& random, std::uint64_t) {
    const double o = std::ldexp(1, Exponent);
    fill(c, random, [&](int) { return o + random.unit(); });
}

void on_facet(Case& c, Random& random, std::uint64_t) {
    fill(c, random, [&](int) { return random.unit(); });
    c.point = random_point(c, random, vertex_count(c.simplex) - 1);
}

void on_facet_offset(Case& c, Random& random, std::uint64_t) {
    fill(c, random, [&](int) { return 1000 + random.unit(); });
    c.point = random_point(c, random, vertex_count(c.simplex) - 1);
}

/// `from` moved by `h` along the normal of the first n - 1 vertices.
std::array<double, 3> lifted(const Case& c, Random& random, std::array<double, 3> from, double h) {
    const auto normal = facet_normal(c, random);
    for (std::size_t k = 0; k < 3; ++k) from[k] += h * normal[k];
    return from;
}

// A good simplex and a point at height h over one of its facets.
template <int Decimal>
void near_facet(Case& c, Random& random, std::uint64_t) {
    constexpr double h = Decimal == 13 ? 1e-13 : Decimal == 14 ? 1e-14 : 1e-15;
    ordinary(c, random);
    const int n = vertex_count(c.simplex) - 1;
    const bool over = random.coin();
    c.point = lifted(c, random, random_point(c, random, n), over ? h : -h);
}

// A simplex of height h; the point is a rounded combination of its vertices.
template <int Decimal>
void sliver(Case& c, Random& random, std::uint64_t) {
    constexpr double h = Decimal == 12 ? 1e-12 : Decimal == 13 ? 1e-13 : Decimal == 14 ? 1e-14 : 1e-15;
    ordinary(c, random);
    const int n = vertex_count(c.simplex);
    set_vertex(c, n - 1, lifted(c, random, random_point(c, random, n - 1), h));
    c.point = random_point(c, random, n);
}

// Two vertices closer to each other than to the rest by 2^-10 to 2^-40.
void needle(Case& c, Random& random, std::uint64_t) {
    ordinary(c, random);
    const double gap = std::ldexp(1, -random.integer(10, 40));
    for (int axis = 0; axis < space_dimension(c.simplex); ++axis)
        c.vertex(1, axis) = c.vertex(0, axis) + gap * random.uniform(-1, 1);
    c.point = random_point(c, random, vertex_count(c.simplex));
}

// The last vertex over the middle of the opposite facet, at 2^-10 to 2^-40 of its size.
void cap(Case& c, Random& random, std::uint64_t) {
    ordinary(c, random);
    const int n = vertex_count(c.simplex);
    const double third = 1.0 / (n - 1);
    const auto middle = combination(c, {third, third, third, third}, n - 1);
    set_vertex(c, n - 1, lifted(c, random, middle, random.scaled(0.5, 1, -40, -10)));
    c.point = random_point(c, random, n);
}

void lattice_tenths(Case& c, Random& random, std::uint64_t) {
    fill(c, random, [&](int) { return 0.1 * random.integer(0, 4); });
}

void lattice_integers(Case& c, Random& random, std::uint64_t) {
    fill(c, random, [&](int) { return static_cast<double>(random.integer(0, 4)); });
}

/// Small integer vectors times small integers: sums are exact, so that the vertices span exactly `dimension` or less.
void flat(Case& c, Random& random, int dimension) {
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
        for (std::size_t k = 0; k < static_cast<std::size_t>(space_dimension(c.simplex)); ++k) {
            c.vertex(i, static_cast<int>(k)) = unit * (origin[k] + s * u[k] + t * v[k]);
        }
    }
    const auto p = integer_vector();
    for (std::size_t k = 0; k < static_cast<std::size_t>(space_dimension(c.simplex)); ++k) c.point[k] = unit * p[k];
    random_values(c, random);
}

void degenerate_point(Case& c, Random& random, std::uint64_t) {
    flat(c, random, 0);
}
void degenerate_line(Case& c, Random& random, std::uint64_t) {
    flat(c, random, 1);
}
void degenerate_plane(Case& c, Random& random, std::uint64_t) {
    flat(c, random, 2);
}

// Flat, then scaled by 1/10 (rounded) and one coordinate moved by an ulp.
void nearly_degenerate(Case& c, Random& random, std::uint64_t) {
    flat(c, random, vertex_count(c.simplex) - 2);
    for (double& x : c.vertices) x *= 0.1;
    for (double& x : c.point) x *= 0.1;
    const auto n = static_cast<std::uint64_t>(vertex_count(c.simplex) * space_dimension(c.simplex));
    double& x = c.vertices[random.below(n)];
    x = random.coin() ? next_up(x) : next_down(x);
}

void subnormal(Case& c, Random& random, std::uint64_t) {
    fill(c, random, [&](int) { return random.integer(-4096, 4096) * 0x1p-1074; });
}

void huge(Case& c, Random& random, std::uint64_t) {
    fill(c, random, [&](int) { return random.uniform(-1, 1) * 0.999 * 0x1p1023 * 2; });
}

void mixed_scale(Case& c, Random& random, std::uint64_t) {
    fill(c, random, [&](int axis) {
        return std::ldexp(random.uniform(-1, 1), axis == 0 ? 512 : axis == 1 ? -512 : 0);
    });
}

void tiny(Case& c, Random& random, std::uint64_t) {
    fill(c, random, [&](int) { return std::ldexp(random.uniform(-1, 1), -540); });
}

// Products that underflow to zero in one term and are large in another: a filter whose bound ignores underflow
// certifies a wrong sign here.
void filter_underflow(Case& c, Random& random, std::uint64_t) {
    const auto m = [&] { return random.uniform(0.5, 2); };
    set_vertex(c, 0, {std::ldexp(m(), -537), 0, std::ldexp(m(), 600)});
    set_vertex(c, 1, {std::ldexp(m(), -537), 0, std::ldexp(m(), 600)});
    set_vertex(c, 2, {0, std::ldexp(m(), -537), 0});
    set_vertex(c, 3, {std::ldexp(m(), 600), std::ldexp(m(), 600), std::ldexp(m(), -537)});
    random_values(c, random);
}

Family family(const char* name, const char* after, const char* parameters, Family::Recipe recipe,
              std::vector<Simplex> simplices) {
    Family f;
    f.name = name;
    f.after = after;
    f.parameters = parameters;
    f.simplices = std::move(simplices);
    f.recipe = recipe;
    return f;
}

}  // namespace

std::vector<Family> built_families() {
    const std::vector<Simplex> all(all_simplices.begin(), all_simplices.end());
    const std::vector<Simplex> triangle{Simplex::triangle};
    const std::vector<Simplex> tetrahedron{Simplex::tetrahedron};
    const std::vector<Simplex> solid{Simplex::triangle, Simplex::tetrahedron};
    const std::vector<Simplex> sided{Simplex::triangle, Simplex::triangle3d, Simplex::tetrahedron};
    return {
        family("random", "the easy case, for comparison", "all coordinates U[-1,1)", ordinary, all),
        family("random.inside", "the easy case, inside", "U[-1,1), point fl(sum w_i v_i)", ordinary_inside, all),
        family("ulp-grid.1", "the classic picture of orientation errors",
               "p = (.5,.5) + 2^-53 (i,j), 256 x 256; edge (12,12)(24,24)", ulp_grid_1, triangle),
        family("ulp-grid.2", "the same, edge nearly diagonal",
               "p = (.50000000000002531,.5000000000000171) + 2^-53 (i,j); edge (17.3)^2 "
               "(24.00000000000005,24.0000000000000517765)",
               ulp_grid_2, triangle),
        family("ulp-grid.3", "the same, edge of rounded decimals", "p = (.5,.5) + 2^-53 (i,j); edge (8.8)^2 (12.1)^2",
               ulp_grid_3, triangle),
        family("diagonal", "exact zeros away from the edge's end", "edge (12)^n (24)^n, point (.5 + 5e-14 U)^n",
               diagonal, solid),
        family("coplanar", "the sign of a point in a facet's plane, rounded", "a + s(b-a) + t(c-a), s,t U[-1,2)",
               coplanar, solid),
        family("anisotropic-plane", "cancellation of products of very different size",
               "x = U 2^[0,20), y = U 2^-[0,20), z = -(n0 x + n1 y)/n2", anisotropic_plane, solid),
        family("offset.2^17", "determinants of absolute coordinates", "2^17 + U[0,1)", offset<17>, all),
        family("offset.2^20", "the same, further out", "2^20 + U[0,1)", offset<20>, all),
        family("on-facet", "points rounded onto a facet, unit cube", "U[0,1), fl(sum w_i v_i) over n-1 vertices",
               on_facet, sided),
        family("on-facet.offset", "the same, at 1000: differences are exact", "1000 + U[0,1)", on_facet_offset, sided),
        family("near-facet.1e-13", "a point at height 1e-13 over a facet", "U[-1,1), h = +-1e-13", near_facet<13>,
               sided),
        family("near-facet.1e-14", "the same at 1e-14", "U[-1,1), h = +-1e-14", near_facet<14>, sided),
        family("near-facet.1e-15", "the same at 1e-15", "U[-1,1), h = +-1e-15", near_facet<15>, sided),
        family("sliver.1e-12", "flat cells: small divisors magnify every error", "height 1e-12, point fl(sum w_i v_i)",
               sliver<12>, sided),
        family("sliver.1e-13", "the same at 1e-13", "height 1e-13", sliver<13>, sided),
        family("sliver.1e-14", "the same at 1e-14", "height 1e-14", sliver<14>, sided),
        family("sliver.1e-15", "the same at 1e-15: the height is a few ulps", "height 1e-15", sliver<15>, sided),
        family("needle", "one edge much shorter than the rest", "two vertices 2^-10 to 2^-40 apart", needle, all),
        family("cap", "a vertex close to the middle of the facet opposite", "height 2^-10 to 2^-40", cap, sided),
        family("lattice.tenths", "exact ties spoilt by decimal rounding", "0.1 k, k in 0..4", lattice_tenths, all),
        family("lattice.integers", "exact zeros and exactly degenerate cells", "k in 0..4", lattice_integers, all),
        family("degenerate.point", "all vertices in one point", "small integers times 2^[-20,20]", degenerate_point,
               all),
        family("degenerate.line", "all vertices on one line", "a + s u, small integers times 2^[-20,20]",
               degenerate_line, sided),
        family("degenerate.plane", "all vertices in one plane", "a + s u + t v, small integers times 2^[-20,20]",
               degenerate_plane, tetrahedron),
        family("nearly-degenerate", "degenerate but for one ulp",
               "a flat simplex times 0.1, one coordinate moved by one ulp", nearly_degenerate, all),
        family("subnormal", "products underflow to zero", "k 2^-1074, |k| <= 4096", subnormal, all),
        family("tiny", "products of three underflow", "U[-1,1) 2^-540", tiny, all),
        family("huge", "differences and products overflow", "U[-1,1) 0.999 2^1024", huge, all),
        family("mixed-scale", "axes of very different scale", "axes times 2^512, 2^-512, 1", mixed_scale, all),
        family("filter-underflow", "static and dynamic filters that ignore underflow",
               "face at 2^-537 and 2^600, point at its plane's origin", filter_underflow, tetrahedron),
    };
}

}  // namespace barycert::audit
