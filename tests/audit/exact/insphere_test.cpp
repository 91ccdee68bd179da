// incircle and insphere against CGAL: its kernel of exact predicates where that makes a promise, its rationals
// everywhere.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Gmpq.h>
#include <CGAL/Simple_cartesian.h>

#include "tests/core/sphere_cases.hpp"

namespace barycert {
namespace {

using testing_spheres::ask;
using testing_spheres::describe;
using testing_spheres::for_hard_points;
using testing_spheres::Points;

template <class Kernel>
int side_by(const Points& p) {
    using Number = typename Kernel::FT;
    const auto flat = [&](std::size_t i) { return typename Kernel::Point_2(Number(p.at[i][0]), Number(p.at[i][1])); };
    const auto solid = [&](std::size_t i) {
        return typename Kernel::Point_3(Number(p.at[i][0]), Number(p.at[i][1]), Number(p.at[i][2]));
    };
    return p.d == 2 ? CGAL::side_of_oriented_circle(flat(0), flat(1), flat(2), flat(3))
                    : CGAL::side_of_oriented_sphere(solid(0), solid(1), solid(2), solid(3), solid(4));
}

/// Zero, or of a magnitude whose fifth power is far from the ends of the doubles.
bool moderate(const Points& p) {
    return std::all_of(p.at.begin(), p.at.end(), [](const auto& x) {
        return std::all_of(x.begin(), x.end(),
                           [](double c) { return c == 0 || (std::fabs(c) > 0x1p-80 && std::fabs(c) < 0x1p80); });
    });
}

TEST(SidesAgainstCgal, KernelOfExactPredicates) {
    using Epick = CGAL::Exact_predicates_inexact_constructions_kernel;
    int asked = 0;
    for_hard_points("cgal", 1000, [&](const Points& p, base::Random&) {
        if (!moderate(p)) return;
        EXPECT_EQ(static_cast<int>(ask(p)), side_by<Epick>(p)) << describe(p);
        ++asked;
    });
    EXPECT_GT(asked, 30000);
}

TEST(SidesAgainstCgal, Rationals) {
    for_hard_points("rationals", 100, [&](const Points& p, base::Random&) {
        EXPECT_EQ(static_cast<int>(ask(p)), side_by<CGAL::Simple_cartesian<CGAL::Gmpq>>(p)) << describe(p);
    });
}

}  // namespace
}  // namespace barycert
