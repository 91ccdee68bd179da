// BarycentricCoords of vtkTetra, or, with BARYCERT_TRIANGLE, of vtkTriangle, in the plane.
#include <vtkTetra.h>
#include <vtkTriangle.h>
#include <vtkVersionMacros.h>

#include "library.hpp"

namespace {

#ifdef BARYCERT_TRIANGLE
constexpr const char *simplex = "triangle", *source = "vtkTriangle::BarycentricCoords",
                     *formula = "2x2 system for the first two weights; the last is 1 - sum";
constexpr int corners = 3;
int coordinates(double* x, double (*v)[2], double* weights) {
    return vtkTriangle::BarycentricCoords(x, v[0], v[1], v[2], weights);
}
#else
constexpr const char *simplex = "tetrahedron", *source = "vtkTetra::BarycentricCoords",
                     *formula = "Cramer's rule in p - x4, solved by 3x3 determinants; the last weight is 1 - sum";
constexpr int corners = 4;
int coordinates(double* x, double (*v)[3], double* weights) {
    return vtkTetra::BarycentricCoords(x, v[0], v[1], v[2], v[3], weights);
}
#endif
constexpr int axes = corners - 1;

}  // namespace

extern "C" void barycert_kernel_describe(struct barycert_kernel_info* info) {
    barycert::libraries::describe(info, "vtk-" VTK_VERSION ".barycentric-coords", simplex, formula, source, true);
}

extern "C" int barycert_kernel_weights(const double* vertices, const double* point, double* weights) {
    // VTK takes pointers to what it might change.
    double x[axes], v[corners][axes];
    for (int k = 0; k < axes; ++k) {
        x[k] = point[k];
        for (int i = 0; i < corners; ++i) v[i][k] = vertices[axes * i + k];
    }
    return coordinates(x, v, weights) == 0 ? 1 : 0;
}
