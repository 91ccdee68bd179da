// CGAL's triangle_coordinates_2 with the kernel of exact predicates and inexact constructions: signs of coordinates.
//
// Random triangles in the unit square; points of their sides, rounded to double. The sign of a coordinate tells on
// which side of an edge the point is, and so does CGAL::orientation, which is exact with this kernel; barycert says the
// same.
#include <CGAL/Barycentric_coordinates_2/triangle_coordinates_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/version.h>

#include <array>
#include <cstdio>

#include "barycert/predicates.hpp"
#include "core/base/random.hpp"

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_2;

int sign_of(double x) {
    return x > 0 ? 1 : x < 0 ? -1 : 0;
}

int orientation(const Point& a, const Point& b, const Point& c) {
    return static_cast<int>(CGAL::orientation(a, b, c));
}

}  // namespace

int main() {
    constexpr int cases = 100000;
    barycert::base::Random random(1);
    const auto any = [&] {
        const double x = random.unit(), y = random.unit();
        return Point(x, y);
    };
    int wrong_signs = 0, wrong_points = 0, inside_called_outside = 0, outside_called_inside = 0, judges_differ = 0,
        at = 0;
    while (at < cases) {
        const std::array<Point, 3> v{any(), any(), any()};
        const int whole = orientation(v[0], v[1], v[2]);
        if (whole == 0) continue;
        ++at;
        const double s = random.unit();
        const Point p(v[0].x() + s * (v[1].x() - v[0].x()), v[0].y() + s * (v[1].y() - v[0].y()));
        std::array<double, 3> weights{};
        CGAL::Barycentric_coordinates::triangle_coordinates_2(v[0], v[1], v[2], p, weights.begin());
        bool wrong = false, inside = true, said = true;
        for (int i = 0; i < 3; ++i) {
            const Point &a = v[(i + 1) % 3], &b = v[(i + 2) % 3];
            const int exact = orientation(p, a, b) * whole;
            const double one[2] = {p.x(), p.y()}, two[2] = {a.x(), a.y()}, three[2] = {b.x(), b.y()};
            judges_differ += static_cast<int>(barycert::orient2d(one, two, three)) * whole != exact ? 1 : 0;
            wrong_signs += sign_of(weights[i]) != exact ? 1 : 0;
            wrong = wrong || sign_of(weights[i]) != exact;
            inside = inside && exact >= 0;
            said = said && weights[i] >= 0;
        }
        wrong_points += wrong ? 1 : 0;
        inside_called_outside += inside && !said ? 1 : 0;
        outside_called_inside += !inside && said ? 1 : 0;
    }
    std::printf(
        "{\"finding\": \"cgal-triangle-coordinates\", \"system\": \"CGAL %s\", \"documented\": \"CGAL 5.5.1\", "
        "\"reproduced\": %s, \"summary\": \"of %d points of sides %d have a coordinate of the wrong sign: %d inside "
        "called outside, %d outside called inside\", \"figures\": {\"points\": %d, \"wrong_signs\": %d, "
        "\"wrong_points\": %d, \"inside_called_outside\": %d, \"outside_called_inside\": %d, "
        "\"orientations_on_which_cgal_and_barycert_differ\": %d}}\n",
        CGAL_VERSION_STR, wrong_points > cases / 100 && judges_differ == 0 ? "true" : "false", cases, wrong_points,
        inside_called_outside, outside_called_inside, cases, wrong_signs, wrong_points, inside_called_outside,
        outside_called_inside, judges_differ);
}
