// The oracle against CGAL: its exact predicates for signs, its rationals for weights.

#include <CGAL/Cartesian.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Gmpq.h>
#include <gtest/gtest.h>
#include <cmath>

#include "barycert/audit.hpp"
#include "barycert/baseline.hpp"
#include "barycert/certificate.hpp"
#include "barycert/check.hpp"
#include "barycert/check_results.hpp"
#include "barycert/choices.hpp"
#include "barycert/defect.hpp"
#include "barycert/environment.hpp"
#include "barycert/family.hpp"
#include "barycert/finding.hpp"
#include "barycert/fix.hpp"
#include "barycert/inverse_rules.hpp"
#include "barycert/kernels.hpp"
#include "barycert/measures.hpp"
#include "barycert/not_finite.hpp"
#include "barycert/oracle.hpp"
#include "barycert/plc.hpp"
#include "barycert/rule_audit.hpp"
#include "barycert/statistics.hpp"
#include "barycert/surface.hpp"
#include "barycert/surface_report.hpp"
#include "barycert/surface_rules.hpp"
#include "barycert/threshold.hpp"
#include "barycert/witness.hpp"

namespace barycert::exact {
namespace {

using Epick = CGAL::Exact_predicates_inexact_constructions_kernel;

/// Sign of 1/Z: the eye and the point (x, y, 1) of the ray, seen from the plane of the triangle before the projection:
/// the plane's distance along the ray is positive if the ray leaves the eye towards it.
int side_of_horizon(const Case& c) {
    using Q = CGAL::Gmpq;
    using Vector = CGAL::Cartesian<Q>::Vector_3;
    const auto vertex = [&](int i) {
        return Vector(Q(c.vertex(i, 0)) * Q(c.depth(i)), Q(c.vertex(i, 1)) * Q(c.depth(i)), Q(c.depth(i)));
    };
    const Vector normal = CGAL::cross_product(vertex(1) - vertex(0), vertex(2) - vertex(0));
    return CGAL::sign(normal * vertex(0)) * CGAL::sign(normal * Vector(Q(c.point[0]), Q(c.point[1]), Q(1)));
}

/// Sign of the weight of vertex i by CGAL's orientation predicates: the simplex with vertex i replaced by the point,
/// against the simplex. Perspective turns all signs round where the ray meets the plane behind the eye.
int predicate_sign(const Case& c, int replaced) {
    const auto coordinate = [&](int i, int axis, int r) {
        return i == r ? c.point[static_cast<std::size_t>(axis)] : c.vertex(i, axis);
    };
    const auto orientation = [&](int r) {
        if (c.simplex == Simplex::triangle) {
            std::array<Epick::Point_2, 3> v;
            for (int i = 0; i < 3; ++i) v[static_cast<std::size_t>(i)] = {coordinate(i, 0, r), coordinate(i, 1, r)};
            return static_cast<int>(CGAL::orientation(v[0], v[1], v[2]));
        }
        std::array<Epick::Point_3, 4> v;
        for (int i = 0; i < 4; ++i)
            v[static_cast<std::size_t>(i)] = {coordinate(i, 0, r), coordinate(i, 1, r), coordinate(i, 2, r)};
        return static_cast<int>(CGAL::orientation(v[0], v[1], v[2], v[3]));
    };
    const int sign = orientation(replaced) * orientation(-1);
    return c.perspective ? sign * side_of_horizon(c) : sign;
}

// Every family that lives within the range of CGAL's filters: on subnormal and huge coordinates its kernel makes no
// promise.
TEST(OracleAgainstCgal, SignsOfEveryFamily) {
    std::uint64_t asked = 0;
    for (const Family& f : all_families()) {
        if (f.needs_mesh || f.name == "huge" || f.name == "subnormal") continue;
        for (const Simplex s : {Simplex::triangle, Simplex::tetrahedron}) {
            if (!f.applies_to(s)) continue;
            for (std::uint64_t i = 0; i < 1000; ++i) {
                const Case c = make_case(f, s, 7, i, {});
                const OracleAnswer a = ask_oracle(c);
                for (int k = 0; k < vertex_count(s); ++k) {
                    ASSERT_EQ(a.signs[static_cast<std::size_t>(k)], predicate_sign(c, k)) << f.name << " case " << i;
                    ++asked;
                }
            }
        }
    }
    EXPECT_GT(asked, 100000U);
}

// Weight i in CGAL's rationals by Cramer's rule; the rounded weight must be no further from it than either neighbour.
TEST(OracleAgainstCgal, WeightsAreNearest) {
    using Q = CGAL::Gmpq;
    for (const char* name : {"random", "lattice.tenths", "anisotropic-plane", "sliver.1e-15", "mixed-scale"}) {
        const Family f = families_matching(name).at(0);
        for (std::uint64_t i = 0; i < 300; ++i) {
            const Case c = make_case(f, Simplex::tetrahedron, 7, i, {});
            const OracleAnswer a = ask_oracle(c);
            if (a.region == Region::degenerate) continue;
            const auto volume = [&](int r) {
                std::array<std::array<Q, 3>, 3> e;
                const auto at = [&](int j, int axis) {
                    return Q(j == r ? c.point[static_cast<std::size_t>(axis)] : c.vertex(j, axis));
                };
                for (int j = 0; j < 3; ++j) {
                    for (int axis = 0; axis < 3; ++axis)
                        e[static_cast<std::size_t>(j)][static_cast<std::size_t>(axis)] = at(j + 1, axis) - at(0, axis);
                }
                return Q(e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) -
                         e[0][1] * (e[1][0] * e[2][2] - e[1][2] * e[2][0]) +
                         e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0]));
            };
            for (int k = 0; k < 4; ++k) {
                const double w = a.weights[static_cast<std::size_t>(k)];
                if (!std::isfinite(w)) continue;
                const Q exact = volume(k) / volume(-1);
                const auto distance = [&](double x) { return Q(CGAL::abs(Q(x) - exact)); };
                ASSERT_LE(distance(w), distance(std::nextafter(w, 1e308))) << name << " case " << i;
                ASSERT_LE(distance(w), distance(std::nextafter(w, -1e308))) << name << " case " << i;
            }
        }
    }
}

}  // namespace
}  // namespace barycert::exact
