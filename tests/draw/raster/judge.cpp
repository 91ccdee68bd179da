#include "tests/draw/raster/judge.hpp"

#include <CGAL/Gmpq.h>

#include "barycert/oracle.hpp"

namespace barycert {
namespace {

using Q = CGAL::Gmpq;

struct Point {
    Q x, y;
};

Q cross(const Point& a, const Point& b, const Point& p) {
    return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
}

struct Exact {
    Point v[3], p;

    Exact(const Corners& c, std::int32_t i, std::int32_t j) : p{Q(i) + Q(1) / Q(2), Q(j) + Q(1) / Q(2)} {
        for (std::size_t k = 0; k < 3; ++k) v[k] = {Q(c[2 * k]), Q(c[2 * k + 1])};
    }
};

}  // namespace

bool judge_covers(const Corners& triangle, std::int32_t i, std::int32_t j) {
    Exact e(triangle, i, j);
    const Q area = cross(e.v[0], e.v[1], e.v[2]);
    if (area == Q(0)) return false;
    if (area < Q(0)) std::swap(e.v[1], e.v[2]);
    for (int k = 0; k < 3; ++k) {
        const Point &a = e.v[k], &b = e.v[(k + 1) % 3];  // counter-clockwise, y up
        const Q side = cross(a, b, e.p);
        if (side < Q(0)) return false;
        const bool left = b.y < a.y, top = b.y == a.y && b.x < a.x;
        if (side == Q(0) && !left && !top) return false;
    }
    return true;
}

double judge_value(const Corners& triangle, const std::array<double, 3>& values, std::int32_t i, std::int32_t j) {
    Case c;
    c.simplex = Simplex::triangle;
    std::copy(triangle.begin(), triangle.end(), c.vertices.begin());
    std::copy(values.begin(), values.end(), c.values.begin());
    c.point = {i + 0.5, j + 0.5, 0};
    return ask_oracle(c).value;
}

double judge_error(const Corners& triangle, const std::array<double, 3>& values, std::int32_t i, std::int32_t j,
                   double value) {
    const Exact e(triangle, i, j);
    Q sum(0);
    const Q area = cross(e.v[0], e.v[1], e.v[2]);
    for (int k = 0; k < 3; ++k)
        sum += cross(e.v[(k + 1) % 3], e.v[(k + 2) % 3], e.p) * Q(values[static_cast<std::size_t>(k)]);
    Q error = sum / area - Q(value);
    if (error < Q(0)) error = -error;
    return CGAL::to_double(error);
}

}  // namespace barycert
