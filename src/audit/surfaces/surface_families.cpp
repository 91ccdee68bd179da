// Cases for the rules on triangles in space. Only + - * / and sqrt, so that each is the same on every machine.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "audit/recipes.hpp"
#include "barycert/environment.hpp"
#include "barycert/oracle.hpp"
#include "barycert/simplex.hpp"
#include "barycert/surface_rules.hpp"
#include "core/base/random.hpp"
#include "core/base/vectors.hpp"

namespace barycert {

using namespace audit;

namespace {

using base::Random;
using Point = std::array<double, 3>;

Point any(Random& random) {
    return {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
}

Point on_lattice(Random& random, int high) {
    return {double(random.integer(0, high)), double(random.integer(0, high)), double(random.integer(0, high))};
}

Point sum(const Point& a, double t, const Point& b) {
    return {a[0] + t * b[0], a[1] + t * b[1], a[2] + t * b[2]};
}

/// a + t b of random ones: in braces they are drawn from left to right, as arguments in any order.
struct Sum {
    Point a;
    double t;
    Point b;
    operator Point() const { return sum(a, t, b); }
};

TriangleInSpace triangle_of(const Point& a, const Point& b, const Point& c) {
    return {a[0], a[1], a[2], b[0], b[1], b[2], c[0], c[1], c[2]};
}

Point corner(const TriangleInSpace& t, std::size_t k) {
    return {t[3 * k], t[3 * k + 1], t[3 * k + 2]};
}

bool has_area(const TriangleInSpace& t) {
    Case c{.simplex = Simplex::triangle3d};
    std::ranges::copy(t, c.vertices.begin());
    return affine_dimension(c) == 2;
}

/// The first corner, then the two others: until they span an area.
template <class First, class Others>
TriangleInSpace proper(const First& first, const Others& others) {
    while (true) {
        const Point a = first(), b = others();
        const TriangleInSpace t = triangle_of(a, b, others());
        if (has_area(t)) return t;
    }
}

TriangleInSpace any_triangle(Random& random) {
    const auto corner = [&] { return any(random); };
    return proper(corner, corner);
}

TriangleInSpace lattice_triangle(Random& random) {
    const auto corner = [&] { return on_lattice(random, 3); };
    return proper(corner, corner);
}

TriangleInSpace needle(Random& random) {
    TriangleInSpace t{};
    do {
        const Point a = any(random), b = any(random);
        const Point middle = sum(a, random.unit(), base::minus(b, a));
        t = triangle_of(a, b, Sum{middle, random.scaled(0.5, 1, -40, -10), any(random)});
    } while (!has_area(t));
    return t;
}

/// Weights of the corners; on an edge one time of four, at a corner one of sixteen.
Point point_on(const TriangleInSpace& t, Random& random) {
    double u = random.unit(), v = random.unit();
    if (u + v > 1) u = 1 - u, v = 1 - v;
    if (random.below(4) == 0) v = 0;
    if (random.below(4) == 0) u = 0;
    Point p{};
    for (std::size_t k = 0; k < 3; ++k) p[k] = t[k] + (u * (t[3 + k] - t[k]) + v * (t[6 + k] - t[k]));
    return p;
}

Point few_ulps_off(Point p, Random& random) {
    for (double& x : p) x = ulps_away(x, random);
    return p;
}

/// All numbers times 2^k, then moved by as much along each axis.
SurfaceCase changed(SurfaceCase c, int k, double by) {
    for (TriangleInSpace& t : c.triangles) {
        for (double& x : t) x = std::ldexp(x, k) + by;
    }
    for (double& x : c.point) x = std::ldexp(x, k) + by;
    return c;
}

SurfaceCase still_proper(const SurfaceCase& c, int k, double by) {
    const SurfaceCase moved = changed(c, k, by);
    return std::ranges::all_of(moved.triangles, has_area) ? moved : c;
}

// Distances.

SurfaceCase near_border(Random& random) {
    const TriangleInSpace t = any_triangle(random);
    const Point a = corner(t, 0);
    // At a right angle to the edge at its end, as far as rounding goes.
    const Point side = base::cross(base::minus(corner(t, 1), a), any(random));
    return {{t}, few_ulps_off(sum(a, random.scaled(0.5, 1, -20, 3), side), random)};
}

SurfaceCase distance_random(Random& random) {
    return {{any_triangle(random)}, any(random)};
}

// Closed surfaces.

/// An octahedron whose faces are parted in four twice: 128 triangles around the origin, with random radii.
std::vector<TriangleInSpace> star(Random& random) {
    std::vector<TriangleInSpace> all;
    for (const double x : {1.0, -1.0}) {
        for (const double y : {1.0, -1.0}) {
            for (const double z : {1.0, -1.0}) {
                const Point a{x, 0, 0}, b{0, y, 0}, c{0, 0, z};
                all.push_back(x * y * z > 0 ? triangle_of(a, b, c) : triangle_of(a, c, b));
            }
        }
    }
    const auto amid = [](const Point& a, const Point& b) { return sum(sum({}, 0.5, a), 0.5, b); };
    for (int turn = 0; turn < 2; ++turn) {
        std::vector<TriangleInSpace> parts;
        for (const TriangleInSpace& t : all) {
            const Point a = corner(t, 0), b = corner(t, 1), c = corner(t, 2);
            const Point ab = amid(a, b), bc = amid(b, c), ca = amid(c, a);
            parts.insert(parts.end(), {triangle_of(a, ab, ca), triangle_of(ab, b, bc), triangle_of(ca, bc, c),
                                       triangle_of(ab, bc, ca)});
        }
        all = std::move(parts);
    }
    // A node's radius is that of its place: the coordinates are multiples of 1/4.
    const std::uint64_t seed = random.bits();
    for (TriangleInSpace& t : all) {
        for (std::size_t k = 0; k < 3; ++k) {
            const Point p = corner(t, k);
            const auto place = static_cast<std::uint64_t>((p[0] * 4 + 4) * 100 + (p[1] * 4 + 4) * 10 + (p[2] * 4 + 4));
            const double radius = Random::stream(seed, place, 0).uniform(0.5, 1);
            for (std::size_t axis = 0; axis < 3; ++axis) t[3 * k + axis] = p[axis] * radius;
        }
    }
    return all;
}

/// A box of n unit squares a side, each of two triangles.
std::vector<TriangleInSpace> box(int n) {
    std::vector<TriangleInSpace> all;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        for (const int level : {0, n}) {
            for (int i = 0; i < n * n; ++i) {
                const auto at = [&](int u, int v) {
                    Point p{};
                    p[axis] = level;
                    const int row = i / n;
                    p[(axis + 1) % 3] = i - n * row + u;
                    p[(axis + 2) % 3] = row + v;
                    return p;
                };
                const Point a = at(0, 0), b = at(1, 0), c = at(1, 1), d = at(0, 1);
                all.push_back(level == 0 ? triangle_of(a, c, b) : triangle_of(a, b, c));
                all.push_back(level == 0 ? triangle_of(a, d, c) : triangle_of(a, c, d));
            }
        }
    }
    return all;
}

/// The surface of a tetrahedron, some of them thin.
SurfaceCase tetrahedron(Random& random) {
    while (true) {
        const TriangleInSpace t = random.coin() ? needle(random) : any_triangle(random);
        const Point a = corner(t, 0), b = corner(t, 1), c = corner(t, 2);
        const Point d = Sum{point_on(t, random), random.scaled(0.5, 1, -40, 1), any(random)};
        Case solid{.simplex = Simplex::tetrahedron};
        std::ranges::copy(t, solid.vertices.begin());
        std::ranges::copy(d, solid.vertices.begin() + 9);
        if (affine_dimension(solid) != 3) continue;
        const Point p =
            few_ulps_off(Sum{point_on(t, random), random.unit() * random.unit() * 0.01, base::minus(d, a)}, random);
        return {{t, triangle_of(a, d, b), triangle_of(b, d, c), triangle_of(c, d, a)}, p};
    }
}

template <Point (*make)(const std::vector<TriangleInSpace>& all, Random& random)>
SurfaceCase star_and(Random& random) {
    SurfaceCase c{star(random), {}};
    c.point = make(c.triangles, random);
    return c;
}

Point anywhere(const std::vector<TriangleInSpace>& /*all*/, Random& random) {
    return any(random);
}

const TriangleInSpace& one_of(const std::vector<TriangleInSpace>& all, Random& random) {
    return all[random.below(all.size())];
}

Point any_corner(const std::vector<TriangleInSpace>& all, Random& random) {
    const TriangleInSpace& t = one_of(all, random);
    return corner(t, random.below(3));
}

/// Some coordinates of a node, the others any: rays along axes meet it.
Point level_with_node(const std::vector<TriangleInSpace>& all, Random& random) {
    Point p = any(random);
    const Point node = any_corner(all, random);
    for (std::size_t k = 1; k < 3; ++k) p[k] = random.below(4) == 0 ? p[k] : node[k];
    return p;
}

Point beside(const std::vector<TriangleInSpace>& all, Random& random) {
    return few_ulps_off(point_on(one_of(all, random), random), random);
}

/// In front of an edge or corner, where several triangles are nearest.
Point around_corner(const std::vector<TriangleInSpace>& all, Random& random) {
    return Sum{any_corner(all, random), random.scaled(0.5, 1, -12, -4), any(random)};
}

// Pairs of triangles.

SurfaceCase touching(Random& random) {
    const TriangleInSpace s = any_triangle(random);
    return {{s, proper([&] { return point_on(s, random); }, [&] { return any(random); })}, {}};
}

/// Two in one plane through lattice points; many touch.
SurfaceCase in_one_plane(Random& random) {
    const Point u{double(random.integer(1, 3)), double(random.integer(0, 3)), double(random.integer(0, 3))},
        v{0, double(random.integer(1, 3)), double(random.integer(-3, 3))};
    const auto at = [&] {
        const double a = random.integer(0, 4), b = random.integer(0, 4);
        return sum(sum({}, a, u), b, v);
    };
    return {{proper(at, at), proper(at, at)}, {}};
}

/// Over each other, so far apart as rounding, or less.
SurfaceCase nearly_parallel(Random& random) {
    const TriangleInSpace s = any_triangle(random);
    const auto corner = [&] { return few_ulps_off(point_on(s, random), random); };
    return {{s, proper(corner, corner)}, {}};
}

SurfaceCase any_two(Random& random) {
    return {{any_triangle(random), any_triangle(random)}, {}};
}

}  // namespace

const std::vector<SurfaceFamily>& surface_families() {
    using enum SurfaceQuestion;
    static const std::vector<SurfaceFamily> all{
        {"distance.random", distance, "ordinary triangles and points, for comparison", distance_random},
        {"distance.lattice", distance, "coordinates 0 to 3: points on triangles, and between regions",
         [](Random& random) {
             return SurfaceCase{{lattice_triangle(random)}, on_lattice(random, 3)};
         }},
        {"distance.beside", distance, "points within a few ulps of the triangle",
         [](Random& random) {
             const TriangleInSpace t = any_triangle(random);
             return SurfaceCase{{t}, few_ulps_off(point_on(t, random), random)};
         }},
        {"distance.border", distance, "points where the regions of a corner and an edge meet", near_border},
        {"distance.needle", distance, "triangles 1e-3 to 1e-12 wide",
         [](Random& random) {
             return SurfaceCase{{needle(random)}, any(random)};
         }},
        {"distance.moved", distance, "ordinary ones, moved by 2^20",
         [](Random& random) { return still_proper(distance_random(random), 0, 0x1p20); }},
        {"distance.scaled", distance, "ordinary ones, times 2^-400 to 2^400: squares under- and overflow",
         [](Random& random) {
             const int k = random.integer(-400, 400);
             return still_proper(distance_random(random), k, 0);
         }},
        {"inside.random", inside, "stars of 128 triangles, points around them", star_and<anywhere>},
        {"inside.level", inside, "points that share coordinates with a node: rays along axes meet it",
         star_and<level_with_node>},
        {"inside.beside", inside, "points within a few ulps of a triangle", star_and<beside>},
        {"inside.corner", inside, "points before edges and corners, where several triangles are nearest",
         star_and<around_corner>},
        {"inside.lattice", inside, "a box of squares, points at multiples of 1/2: rays meet edges and corners",
         [](Random& random) {
             const Point p = on_lattice(random, 8);
             return SurfaceCase{box(3), {p[0] / 2 - 0.5, p[1] / 2 - 0.5, p[2] / 2 - 0.5}};
         }},
        {"inside.needle", inside, "thin tetrahedra, points beside a face", tetrahedron},
        {"inside.moved", inside, "stars moved by 2^20, points within a few ulps of a triangle",
         [](Random& random) {
             SurfaceCase c = changed(star_and<beside>(random), 0, 0x1p20);
             c.point = beside(c.triangles, random);
             return c;
         }},
        {"inside.small", inside, "stars times 2^-10 to 2^-30, points around them",
         [](Random& random) {
             const int k = random.integer(-30, -10);
             return changed(star_and<anywhere>(random), k, 0);
         }},
        {"meet.random", meet, "ordinary triangles, for comparison", any_two},
        {"meet.lattice", meet, "coordinates 0 to 3: they touch, or lie in one plane",
         [](Random& random) {
             return SurfaceCase{{lattice_triangle(random), lattice_triangle(random)}, {}};
         }},
        {"meet.touching", meet, "a corner of one is computed on the other", touching},
        {"meet.one-plane", meet, "two in a plane through lattice points", in_one_plane},
        {"meet.parallel", meet, "over each other, as far apart as rounding", nearly_parallel},
        {"meet.needle", meet, "triangles 1e-3 to 1e-12 wide that nearly touch",
         [](Random& random) {
             const TriangleInSpace s = needle(random);
             const auto first = [&] { return few_ulps_off(point_on(s, random), random); };
             return SurfaceCase{{s, proper(first, [&] { return any(random); })}, {}};
         }},
        {"meet.moved", meet, "touching ones, moved by 2^20",
         [](Random& random) { return still_proper(touching(random), 0, 0x1p20); }},
        {"meet.scaled", meet, "ordinary and touching ones, times 2^-120 to 2^100",
         [](Random& random) {
             const int k = random.integer(-120, 100);
             return still_proper(random.coin() ? any_two(random) : touching(random), k, 0);
         }},
    };
    return all;
}

SurfaceCase make_surface_case(const SurfaceFamily& family, std::uint64_t seed, std::uint64_t index) {
    const ExactEnvironment environment;
    Random random = Random::stream(seed, base::hash64(family.name), index);
    return family.make(random);
}

}  // namespace barycert
