/// From the points of a data set to the arrays of a probe.
#pragma once

#include "barycert/sampler.hpp"
#include "vtk/exact_index.hpp"
#include "vtk/probe_arrays.hpp"

namespace barycert::in_vtk {

/// Samples the arrays' choices at all points of `input`, and writes what is found. Memory for rows does not grow with
/// the number of points.
Status sample_data_set(const Sampler& sampler, const ExactIndex& index, vtkDataSet& input, const SampleOptions& options,
                       double tolerance, ProbeArrays& arrays);

}  // namespace barycert::in_vtk
