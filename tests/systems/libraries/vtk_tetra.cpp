// vtkTetra::BarycentricCoords.
#include <vtkTetra.h>
#include <vtkVersionMacros.h>

#include "library.hpp"

extern "C" void barycert_kernel_describe(struct barycert_kernel_info* info) {
    barycert::libraries::describe(info, "vtk-" VTK_VERSION ".barycentric-coords", "tetrahedron",
                                  "Cramer's rule in p - x4, solved by 3x3 determinants; the last weight is 1 - sum",
                                  "vtkTetra::BarycentricCoords", true);
}

extern "C" int barycert_kernel_weights(const double* vertices, const double* point, double* weights) {
    double x[3], v[4][3];
    for (int k = 0; k < 3; ++k) {
        x[k] = point[k];
        for (int i = 0; i < 4; ++i) v[i][k] = vertices[3 * i + k];
    }
    return vtkTetra::BarycentricCoords(x, v[0], v[1], v[2], v[3], weights) == 0 ? 1 : 0;
}
