/// The options that `barycert sample` and `barycert resample` share, and what both do around their job.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "barycert/jobs.hpp"
#include "barycert/result.hpp"

namespace CLI {
class App;
}  // namespace CLI

namespace barycert::cli {

/// Options that add fields from files; `either` names the one whose rows may belong to nodes or to cells. `series`:
/// where fields with a file for each step go; nullptr: there are none.
void add_field_files(CLI::App& sub, std::vector<FieldFile>& files, const std::string& either,
                     std::vector<FieldFile>* series = nullptr);

/// --nonfinite-points.
void nonfinite_option(CLI::App& sub, NonfinitePoints& value);

void add_sampling_options(CLI::App& sub, SamplingJob& job, bool& quiet);

/// Does the job by `run`, with progress on a terminal, and writes its reports: the JSON where it is asked for, and the
/// summary on stdout, or, where that has rows or the JSON, on stderr. Returns the exit code.
int run_sampling(SamplingJob& job, bool quiet, const std::function<Result<SampleReport>()>& run);

}  // namespace barycert::cli
