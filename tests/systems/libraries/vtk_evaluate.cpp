// EvaluatePosition of vtkTetra (or, with BARYCERT_TRIANGLE, of vtkTriangle, which projects onto its plane): the weights
// with which VTK's locators and filters interpolate, and the rule by which they take a point for inside.
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkTetra.h>
#include <vtkTriangle.h>
#include <vtkVersionMacros.h>

#include "library.hpp"

namespace {

#ifdef BARYCERT_TRIANGLE
using Cell = vtkTriangle;
constexpr const char *simplex = "triangle3d", *source = "vtkTriangle::EvaluatePosition",
                     *formula = "projected along the largest component of the normal, 2x2 determinants";
constexpr int corners = 3;
#else
using Cell = vtkTetra;
constexpr const char *simplex = "tetrahedron", *source = "vtkTetra::EvaluatePosition",
                     *formula = "3x3 determinants over one another; the first weight is 1 - sum";
constexpr int corners = 4;
#endif

/// Returns what EvaluatePosition returns: 1 inside, 0 outside, -1 degenerate.
int evaluate(const double* vertices, const double* point, double* weights) {
    // One cell a thread: to make one takes longer than to ask it.
    thread_local const vtkNew<Cell> cell;
    for (int i = 0; i < corners; ++i) cell->Points->SetPoint(i, vertices + 3 * i);
    double closest[3], parametric[3], distance2 = 0, all[8];
    int part = 0;
    const int said = cell->EvaluatePosition(point, closest, part, parametric, distance2, all);
    for (int i = 0; i < corners; ++i) weights[i] = all[i];
    return said;
}

}  // namespace

extern "C" void barycert_kernel_describe(struct barycert_kernel_info* info) {
    barycert::libraries::describe(info, "vtk-" VTK_VERSION ".evaluate-position", simplex, formula, source, true);
}

extern "C" int barycert_kernel_weights(const double* vertices, const double* point, double* weights) {
    return evaluate(vertices, point, weights) < 0 ? 1 : 0;
}

#ifndef BARYCERT_TRIANGLE
// VTK says inside of a triangle in space only near its plane; barycert asks for the projection.
extern "C" int barycert_kernel_classify(const double* vertices, const double* point, const double*) {
    double weights[4];
    const int said = evaluate(vertices, point, weights);
    return said < 0 ? BARYCERT_DEGENERATE : said == 0 ? BARYCERT_OUTSIDE : BARYCERT_INTERIOR;
}
#endif
