/// The point of a data set's simplices that is nearest to a point.
#pragma once

#include <array>

#include "vtk/exact_index.hpp"

namespace barycert::in_vtk {

struct Closest {
    Mesh::Index cell = -1;  ///< of the mesh, the lowest of those that are as near; -1: none within the limit
    double distance = 0;
    bool inside = false;  ///< the point lies in the cell
    std::array<double, 3> point{};
    std::array<double, 4> weights{};  ///< of the nearest point in the cell, in the order of its vertices
};

/// Returns x, by way of memory: across an ExactEnvironment compilers move arithmetic on numbers in registers.
inline double held(double x) {
    const volatile double there = x;
    return there;
}

/// None if a coordinate is not finite. Requires index.exact().
Closest closest(const ExactIndex& index, const double* x, double limit);

/// Correctly rounded weights of the point in a cell of the mesh that is not degenerate. Requires finite coordinates.
std::array<double, 4> weights_in(const ExactIndex& index, Mesh::Index cell, const double* x);

/// The same for a point on the axes of the mesh.
std::array<double, 4> weights_on_axes(const ExactIndex& index, Mesh::Index cell, const double* point);

}  // namespace barycert::in_vtk
