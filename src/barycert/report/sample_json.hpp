/// What a run of sampling did, as JSON. Every member is documented in SCHEMA.md beside this file.
#pragma once

#include <string>

#include "barycert/core/environment.hpp"
#include "barycert/report/sample_run.hpp"

namespace barycert::report {

inline constexpr int sample_schema = 1;

std::string sample_json(const SampleRun& run, const Environment& environment);

}  // namespace barycert::report
