/// Steps of a series of meshes.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "barycert/result.hpp"
#include "barycert/series.hpp"

namespace barycert::io {

/// The number of the step that is chosen. Error: there is none such.
Result<std::size_t> chosen_step(const std::vector<SeriesStep>& steps, const StepChoice& choice,
                                const std::string& path);

/// Returns the error that the file is no series, where a step is chosen.
Error no_series(const std::string& path);

}  // namespace barycert::io
