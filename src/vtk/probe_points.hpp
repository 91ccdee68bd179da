/// The points of a data set, as a sampler takes them.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "barycert/grid.hpp"
#include "vtk/exact_index.hpp"

namespace barycert::in_vtk {

struct ProbePoints {
    std::span<const double> coordinates;  ///< on the axes of the mesh, `dimension` a point
    std::vector<double> own;              ///< behind `coordinates`, if these had to be made
    /// Of each point in the data set; empty: all of them. Those that are not finite, or farther off the plane of the
    /// mesh than the tolerance, have no place here.
    std::vector<vtkIdType> ids;
};

/// Refers to the data set where its points are doubles. `input` is that of a probe.
ProbePoints probe_points(const ExactIndex& index, vtkDataSet& input, double tolerance);

/// The points of an image as a grid that has them to the bit, x fastest; none if it is no image along the axes.
std::optional<Grid> probe_grid(const ExactIndex& index, vtkDataSet& input);

}  // namespace barycert::in_vtk
