// Newton's method for the inverse maps of cells as it is in use: in plain double, with its tolerances.

#include "barycert/inverse_rules.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "audit/inverses/reference.hpp"  // IWYU pragma: keep
#include "core/base/vectors.hpp"
#include "core/shape_functions.hpp"
#include "core/vtk_cell.hpp"

namespace barycert {

using namespace audit;

namespace {

struct Newton {
    double moved = 1e-8;  ///< it ends when no coordinate moves by as much
    double beyond = 0;    ///< a point is inside if no coordinate is farther from [0, 1]
    int steps = 10;
    double start = 0.5;    ///< all coordinates
    bool floored = false;  ///< no answer where the Jacobian is below 1e-20, and 1e-5 of the cube of the size
    double apex = 0;       ///< a point as near to the apex, in heights of the pyramid, is the apex
};

double distance(const double* a, const double* b) {
    const base::Vector3<double> v{a[0] - b[0], a[1] - b[1], a[2] - b[2]};
    return std::sqrt(base::dot(v, v));
}

/// The longest diagonal of a hexahedron; the longest edge of a wedge or pyramid.
double size_of(const InverseCase& c) {
    double most = 0;
    for (std::size_t i = 0; i < c.values.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            const bool meant = c.type == vtk_hexahedron ? j < 4 && i == (j + 2) % 4 + 4
                               : c.type == vtk_wedge    ? i % 3 == j % 3 || i / 3 == j / 3
                                                        : i == 4 || i % 2 != j % 2;
            if (meant) most = std::max(most, distance(&c.nodes[3 * i], &c.nodes[3 * j]));
        }
    }
    return most;
}

bool is_at_apex(const InverseCase& c, double near) {
    std::array<double, 3> base{};
    for (std::size_t i = 0; i < 12; ++i) base[i % 3] += c.nodes[i] / 4;
    return distance(&c.nodes[12], c.point.data()) < near * distance(&c.nodes[12], base.data());
}

InverseAnswer newton(const InverseCase& c, const Newton& by) {
    const iso::Reference& of = *iso::linear_reference(c.type);
    const std::size_t d = of.dimension();
    if (by.apex > 0 && is_at_apex(c, by.apex)) return {true, true, {0, 0, 1}, c.values[4]};
    const double size = by.floored ? size_of(c) : 0, floor = std::min(1e-20, 1e-5 * (size * size * size));
    InverseAnswer a;
    std::fill_n(a.x.begin(), d, by.start);
    std::array<double, iso::max_nodes> n{};
    std::array<std::array<double, 3>, iso::max_nodes> slopes{};
    for (int step = 0; step < by.steps && !a.found; ++step) {
        iso::shape_functions(of, a.x, n, &slopes);
        // By r, s and t, and what is left to the point; in the plane t stands alone.
        std::array<std::array<double, 3>, 4> columns{};
        if (d == 2) columns[2] = {0, 0, 1};
        for (std::size_t i = 0; i < c.nodes.size(); ++i) {
            for (std::size_t j = 0; j < d; ++j) columns[j][i % d] += c.nodes[i] * slopes[i / d][j];
            columns[3][i % d] += c.nodes[i] * n[i / d];
        }
        for (std::size_t k = 0; k < d; ++k) columns[3][k] -= c.point[k];
        const auto determinant = [&](std::size_t r, std::size_t s, std::size_t t) {
            return base::dot(columns[r], base::cross(columns[s], columns[t]));
        };
        const double whole = determinant(0, 1, 2);
        if (whole == 0 || std::fabs(whole) < floor) return {};
        const std::array<double, 3> parts{determinant(3, 1, 2), determinant(0, 3, 2), determinant(0, 1, 3)};
        a.found = true;
        for (std::size_t k = 0; k < d; ++k) {
            const double moved = parts[k] / whole;
            a.x[k] -= moved;
            a.found = a.found && std::fabs(moved) < by.moved;
            if (!(std::fabs(a.x[k]) < 1e6)) return {};
        }
    }
    iso::shape_functions(of, a.x, n, nullptr);
    for (std::size_t i = 0; i < of.nodes; ++i) a.value += n[i] * c.values[i];
    a.inside = c.type != vtk_wedge || a.x[0] + a.x[1] <= 1 + by.beyond;
    for (const double x : a.x) a.inside = a.inside && x >= -by.beyond && x <= 1 + by.beyond;
    return a;
}

InverseRule rule(const char* name, std::uint8_t type, const char* formula, const char* source, const char* fails,
                 const Newton& by) {
    return {name, type, formula, source, fails, [by](const InverseCase& c) { return newton(c, by); }};
}

}  // namespace

const std::vector<InverseRule>& inverse_rules() {
    const char *const loose = "10 steps from the middle, until none moves by 1e-3; inside within 1e-3 of [0, 1]",
                      *const strict = "10 steps from the middle, until none moves by 1e-8; inside in [0, 1]",
                      *const usual = "finite element codes",
                      *const early =
                          "it ends early at corners that are nearly flat; points beside the cell are inside; a "
                          "Jacobian below 1e-20 in small thin cells is taken for 0",
                      *const rounds =
                          "at the boundary rounding decides; 10 steps are too few at corners that are nearly flat";
    static const std::vector<InverseRule> all{
        rule("hexahedron.newton-1e-3", 12, loose, "vtkHexahedron in older versions", early,
             {.moved = 1e-3, .beyond = 1e-3, .floored = true}),
        rule("hexahedron.newton-1e-5", 12,
             "10 steps from the middle, until none moves by 1e-5; inside within 1e-6 of [0, 1]", "vtkHexahedron", early,
             {.moved = 1e-5, .beyond = 1e-6, .floored = true}),
        rule("hexahedron.newton-1e-8", 12, strict, usual, rounds, {}),
        rule("wedge.newton-1e-3", 13, loose, "vtkWedge", early, {.moved = 1e-3, .beyond = 1e-3, .floored = true}),
        rule("wedge.newton-1e-8", 13, strict, usual, rounds, {}),
        rule("pyramid.newton-1e-3", 14,
             "10 steps from 1/3, until none moves by 1e-3; inside within 1e-3 of [0, 1]; within 1e-3 of the apex it is "
             "the apex",
             "vtkPyramid", early, {.moved = 1e-3, .beyond = 1e-3, .start = 0.3333333, .floored = true, .apex = 1e-3}),
        rule("pyramid.newton-1e-8", 14, strict, usual, "as the others; at the apex the Jacobian is 0", {}),
        rule("quadrilateral.newton-1e-4", 9,
             "20 steps from the middle, until none moves by 1e-4; inside within 1e-3 of [0, 1]", "vtkQuad",
             "it ends early at corners that are nearly flat; points beside the cell are inside",
             {.moved = 1e-4, .beyond = 1e-3, .steps = 20}),
        rule("quadrilateral.newton-1e-8", 9, strict, usual, rounds, {}),
    };
    return all;
}

}  // namespace barycert
