/// Steps of series.
#pragma once

#include <string>
#include <vector>

#include "barycert/io.hpp"

namespace barycert::io {

/// The number of the step that is chosen. Error: there is none such.
Result<std::size_t> chosen_step(const std::vector<SeriesStep>& steps, const StepChoice& choice,
                                const std::string& path);

/// That a step is chosen of what is no series.
Error no_series(const std::string& path);

}  // namespace barycert::io
