// CGAL's triangle_coordinates_2, with the kernel that most users take.
#include <CGAL/Barycentric_coordinates_2/triangle_coordinates_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/version.h>

#include "library.hpp"

extern "C" void barycert_kernel_describe(struct barycert_kernel_info* info) {
    barycert::libraries::describe(info, "cgal-" CGAL_VERSION_STR ".triangle-coordinates", "triangle",
                                  "signed areas over the whole one; the last weight is 1 - sum",
                                  "CGAL::Barycentric_coordinates::triangle_coordinates_2 with Epick", false);
}

extern "C" int barycert_kernel_weights(const double* v, const double* p, double* weights) {
    using Point = CGAL::Exact_predicates_inexact_constructions_kernel::Point_2;
    CGAL::Barycentric_coordinates::triangle_coordinates_2(Point(v[0], v[1]), Point(v[2], v[3]), Point(v[4], v[5]),
                                                          Point(p[0], p[1]), weights);
    return 0;
}
