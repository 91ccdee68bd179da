// Ratios of CGAL::volume, with the kernel that most users take.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/version.h>

#include "library.hpp"

extern "C" void barycert_kernel_describe(struct barycert_kernel_info* info) {
    barycert::libraries::describe(info, "cgal-" CGAL_VERSION_STR ".volumes", "tetrahedron",
                                  "signed volumes over the whole one", "CGAL::volume with Epick", true);
}

extern "C" int barycert_kernel_weights(const double* v, const double* p, double* weights) {
    using Point = CGAL::Exact_predicates_inexact_constructions_kernel::Point_3;
    const Point a(v[0], v[1], v[2]), b(v[3], v[4], v[5]), c(v[6], v[7], v[8]), d(v[9], v[10], v[11]),
        x(p[0], p[1], p[2]);
    const double whole = CGAL::volume(a, b, c, d);
    if (whole == 0) return 1;
    weights[0] = CGAL::volume(x, b, c, d) / whole;
    weights[1] = CGAL::volume(a, x, c, d) / whole;
    weights[2] = CGAL::volume(a, b, x, d) / whole;
    weights[3] = CGAL::volume(a, b, c, x) / whole;
    return 0;
}
