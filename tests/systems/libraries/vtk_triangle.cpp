// vtkTriangle::BarycentricCoords, in the plane.
#include <vtkTriangle.h>
#include <vtkVersionMacros.h>

#include "library.hpp"

extern "C" void barycert_kernel_describe(struct barycert_kernel_info* info) {
    barycert::libraries::describe(info, "vtk-" VTK_VERSION ".barycentric-coords", "triangle",
                                  "2x2 system for the first two weights; the last is 1 - sum",
                                  "vtkTriangle::BarycentricCoords", true);
}

extern "C" int barycert_kernel_weights(const double* vertices, const double* point, double* weights) {
    double x[2], v[3][2];
    for (int k = 0; k < 2; ++k) {
        x[k] = point[k];
        for (int i = 0; i < 3; ++i) v[i][k] = vertices[2 * i + k];
    }
    return vtkTriangle::BarycentricCoords(x, v[0], v[1], v[2], weights) == 0 ? 1 : 0;
}
