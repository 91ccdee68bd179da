#include "shapes.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

namespace barycert::data {
namespace {

int count(const std::vector<Point>& points) {
    return static_cast<int>(points.size());
}

/// Corners of a regular polygon around (x, y) at height z.
Ring add_circle(Shape& shape, double x, double y, double z, double radius, int corners) {
    Ring ring;
    for (int i = 0; i < corners; ++i) {
        const double angle = 2 * std::numbers::pi * i / corners;
        ring.push_back(count(shape.points));
        shape.points.push_back({rounded(x + radius * std::cos(angle)), rounded(y + radius * std::sin(angle)), z});
    }
    return ring;
}

/// Quadrilaterals between two rings of equally many corners.
void add_wall(Shape& shape, const Ring& low, const Ring& high, int marker) {
    for (std::size_t i = 0; i < low.size(); ++i) {
        const std::size_t next = (i + 1) % low.size();
        shape.facets.push_back({{{low[i], low[next], high[next], high[i]}}, {}, marker});
    }
}

/// An icosahedron whose triangles are split in four `splits` times, on a sphere; `first` is its first node.
void add_sphere(Shape& shape, const Point& centre, double radius, int splits, int marker) {
    const double g = (1 + std::sqrt(5.0)) / 2;
    std::vector<Point> unit{{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                            {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
    std::vector<std::array<int, 3>> faces{{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                                          {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                                          {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                                          {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
    for (int split = 0; split < splits; ++split) {
        std::map<std::pair<int, int>, int> middle;
        const auto middle_of = [&](int a, int b) {
            const auto [entry, fresh] = middle.try_emplace(std::minmax(a, b), count(unit));
            if (fresh) {
                const Point p = unit[static_cast<std::size_t>(a)];
                const Point q = unit[static_cast<std::size_t>(b)];
                unit.push_back({(p[0] + q[0]) / 2, (p[1] + q[1]) / 2, (p[2] + q[2]) / 2});
            }
            return entry->second;
        };
        std::vector<std::array<int, 3>> finer;
        for (const auto& [a, b, c] : faces) {
            const int ab = middle_of(a, b);
            const int bc = middle_of(b, c);
            const int ca = middle_of(c, a);
            finer.insert(finer.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
        }
        faces = finer;
    }
    const int first = count(shape.points);
    for (const Point& p : unit) {
        const double scale = radius / std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
        shape.points.push_back(
            {rounded(centre[0] + scale * p[0]), rounded(centre[1] + scale * p[1]), rounded(centre[2] + scale * p[2])});
    }
    for (const auto& [a, b, c] : faces) shape.facets.push_back({{{first + a, first + b, first + c}}, {}, marker});
}

Shape cube_hole() {
    Shape shape{"cube-hole.poly", "the unit cube with a spherical hole; facets 1 to 6 outside, 7 the hole", {}, {}, {}};
    for (int i = 0; i < 8; ++i) shape.points.push_back({double(i & 1), double(i >> 1 & 1), double(i >> 2)});
    const std::vector<Ring> sides{{0, 2, 6, 4}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 3, 7, 6}, {0, 1, 3, 2}, {4, 5, 7, 6}};
    int marker = 0;
    for (const Ring& side : sides) shape.facets.push_back({{side}, {}, ++marker});
    add_sphere(shape, {0.5, 0.5, 0.5}, 0.3, 2, 7);
    shape.cavities.push_back({0.5, 0.5, 0.5});
    return shape;
}

Shape bracket() {
    Shape shape{"bracket.poly", "an L of thin walls with a bolt hole; facet 1 the hole, 2 the rest", {}, {}, {}};
    constexpr double t = 0.25;  // wall thickness
    const std::vector<std::array<double, 2>> profile{{0, 0}, {6, 0}, {6, t}, {t, t}, {t, 5}, {0, 5}};
    Ring front;
    Ring back;
    for (const auto& [x, z] : profile) {
        front.push_back(count(shape.points));
        shape.points.push_back({x, 0, z});
        back.push_back(count(shape.points));
        shape.points.push_back({x, 4, z});
    }
    const Ring low = add_circle(shape, 3.5, 2, 0, 0.75, 24);
    const Ring high = add_circle(shape, 3.5, 2, t, 0.75, 24);
    shape.facets.push_back({{front}, {}, 2});
    shape.facets.push_back({{back}, {}, 2});
    add_wall(shape, front, back, 2);
    add_wall(shape, low, high, 1);
    // The base's lower and upper side are walls 0 and 2 after the two profiles.
    shape.facets[2].polygons.push_back(low);
    shape.facets[2].holes.push_back({3.5, 2, 0});
    shape.facets[4].polygons.push_back(high);
    shape.facets[4].holes.push_back({3.5, 2, t});
    return shape;
}

Shape needle_slit() {
    Shape shape{"needle-slit.smesh",
                "a block with a slit of 1.5 degrees and a needle of 1.1 degrees; facet 1 the slit, 2 the needle",
                {},
                {},
                {}};
    const std::vector<std::array<double, 2>> profile{{0, 0},    {3, 0},    {3, 0.1},  {3, 1},
                                                     {1.01, 1}, {1, 0.25}, {0.99, 1}, {0, 1}};
    Ring front;
    Ring back;
    for (const auto& [x, z] : profile) {
        front.push_back(count(shape.points));
        shape.points.push_back({x, 0, z});
        back.push_back(count(shape.points));
        shape.points.push_back({x, 1, z});
    }
    const int tip = count(shape.points);
    shape.points.push_back({8, 0.5, 0.05});
    shape.facets.push_back({{front}, {}, 3});
    shape.facets.push_back({{back}, {}, 3});
    for (std::size_t i = 0; i < front.size(); ++i) {
        if (i == 1) continue;  // the needle stands there
        const std::size_t next = (i + 1) % front.size();
        const int marker = i == 4 || i == 5 ? 1 : 3;
        shape.facets.push_back({{{front[i], front[next], back[next], back[i]}}, {}, marker});
    }
    const Ring base{front[1], front[2], back[2], back[1]};
    for (std::size_t i = 0; i < 4; ++i) shape.facets.push_back({{{base[i], base[(i + 1) % 4], tip}}, {}, 2});
    return shape;
}

/// All lattice points of a box, and its sides in lattice squares. Coordinates are fl(k / divisor).
Shape lattice(std::string name, std::string note, const std::array<int, 3>& cells, double divisor) {
    Shape shape{std::move(name), std::move(note), {}, {}, {}};
    const auto node = [&](int i, int j, int k) { return (k * (cells[1] + 1) + j) * (cells[0] + 1) + i; };
    for (int k = 0; k <= cells[2]; ++k) {
        for (int j = 0; j <= cells[1]; ++j) {
            for (int i = 0; i <= cells[0]; ++i) shape.points.push_back({i / divisor, j / divisor, k / divisor});
        }
    }
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::size_t u = (axis + 1) % 3;
        const std::size_t v = (axis + 2) % 3;
        for (const int level : {0, cells[axis]}) {
            Facet facet{{}, {}, static_cast<int>(axis) + 1};
            for (int a = 0; a < cells[u]; ++a) {
                for (int b = 0; b < cells[v]; ++b) {
                    Ring square;
                    for (const auto& [da, db] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}}) {
                        std::array<int, 3> at{};
                        at[axis] = level;
                        at[u] = a + da;
                        at[v] = b + db;
                        square.push_back(node(at[0], at[1], at[2]));
                    }
                    facet.polygons.push_back(square);
                }
            }
            shape.facets.push_back(facet);
        }
    }
    return shape;
}

Shape torus() {
    Shape shape{"torus.off", "", {}, {}, {}};
    constexpr int around = 36;
    constexpr int across = 18;
    for (int i = 0; i < around; ++i) {
        for (int j = 0; j < across; ++j) {
            const double u = 2 * std::numbers::pi * i / around;
            const double v = 2 * std::numbers::pi * j / across;
            const double r = 1 + 0.4 * std::cos(v);
            shape.points.push_back({rounded(r * std::cos(u)), rounded(r * std::sin(u)), rounded(0.4 * std::sin(v))});
        }
    }
    const auto node = [](int i, int j) { return i % around * across + j % across; };
    for (int i = 0; i < around; ++i) {
        for (int j = 0; j < across; ++j) {
            shape.facets.push_back({{{node(i, j), node(i + 1, j), node(i + 1, j + 1)}}, {}, 0});
            shape.facets.push_back({{{node(i, j), node(i + 1, j + 1), node(i, j + 1)}}, {}, 0});
        }
    }
    return shape;
}

Shape flange() {
    Shape shape{"flange.poly", "a flange; facet 1 below, 2 above, 3 the rim, 4 the bore, 5 the bolt holes", {}, {}, {}};
    constexpr double height = 0.5;
    Facet below{{}, {}, 1};
    Facet above{{}, {}, 2};
    const auto add_cylinder = [&](double x, double y, double radius, int corners, int marker) {
        const Ring low = add_circle(shape, x, y, 0, radius, corners);
        const Ring high = add_circle(shape, x, y, height, radius, corners);
        below.polygons.push_back(low);
        above.polygons.push_back(high);
        if (marker != 3) {
            below.holes.push_back({x, y, 0});
            above.holes.push_back({x, y, height});
        }
        add_wall(shape, low, high, marker);
    };
    add_cylinder(0, 0, 2, 64, 3);
    add_cylinder(0, 0, 0.6, 32, 4);
    for (int i = 0; i < 6; ++i) {
        const double angle = std::numbers::pi * i / 3;
        add_cylinder(rounded(1.4 * std::cos(angle)), rounded(1.4 * std::sin(angle)), 0.2, 16, 5);
    }
    shape.facets.push_back(below);
    shape.facets.push_back(above);
    return shape;
}

}  // namespace

double rounded(double x) {
    return std::round(x * 1e6) / 1e6 + 0.0;  // + 0.0: no negative zero
}

std::vector<Shape> all_shapes() {
    return {cube_hole(),
            bracket(),
            needle_slit(),
            lattice("lattice-box.poly", "a box of 10 by 8 by 6 lattice cells of spacing 0.1", {10, 8, 6}, 10),
            lattice("lattice-eighths.poly", "a cube of 8 by 8 by 8 lattice cells of spacing 1/8", {8, 8, 8}, 8),
            torus(),
            flange()};
}

Mesh plate() {
    constexpr int around = 60;  // 0.1 apart on the rectangle's rim, which is 6 long
    constexpr int rings = 18;
    Mesh mesh;
    mesh.dimension = 2;
    mesh.index_base = 1;
    for (int j = 0; j < rings; ++j) {
        for (int i = 0; i < around; ++i) {
            // The rim from (2, 0.5) counterclockwise, about the centre (1, 0.5), in tenths.
            const int x = i <= 5 ? 10 : i <= 25 ? 15 - i : i <= 35 ? -10 : i <= 55 ? i - 45 : 10;
            const int y = i <= 5 ? i : i <= 25 ? 5 : i <= 35 ? 30 - i : i <= 55 ? -5 : i - 60;
            const double inner = 2.5 / std::sqrt(double(x * x + y * y));
            const double t = double(j) / (rings - 1);
            const double scale = ((1 - t) * inner + t) / 10;
            const bool within = j > 0 && j < rings - 1;
            const double dx = within ? 0.001 * ((7 * i + 5 * j) % 7 - 3) : 0;
            const double dy = within ? 0.001 * ((3 * i + 4 * j) % 7 - 3) : 0;
            mesh.points.push_back(rounded(1 + scale * x + dx));
            mesh.points.push_back(rounded(0.5 + scale * y + dy));
            mesh.point_markers.push_back(within ? 0 : j == 0 ? 2 : 1);
        }
    }
    for (int j = 0; j + 1 < rings; ++j) {
        for (int i = 0; i < around; ++i) {
            const int a = j * around + i;
            const int b = j * around + (i + 1) % around;
            mesh.cells.insert(mesh.cells.end(), {a, a + around, b + around, a, b + around, b});
        }
    }
    return mesh;
}

}  // namespace barycert::data
