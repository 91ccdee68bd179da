/// What a run of sampling did, for people.
#pragma once

#include <string>

#include "barycert/report/sample_run.hpp"

namespace barycert::report {

/// A few lines of at most 120 columns, names of files aside.
std::string terminal_sample(const SampleRun& run, bool colour);

}  // namespace barycert::report
