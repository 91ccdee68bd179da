/// The files of a job: what can be known of them before the work.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "barycert/base/named_file.hpp"
#include "barycert/io.hpp"
#include "barycert/jobs.hpp"
#include "barycert/jobs/series.hpp"
#include "barycert/result.hpp"

namespace barycert::jobs {

/// What can be known of files before the work: of a job with those outputs and, besides the common ones, those inputs.
/// Those that are called --output are one for each step, where they have a place for it. Errors: an output is an input
/// or another output, or cannot be written; an input cannot be read; more steps than can be columns.
Status check_files(const SamplingJob& job, const std::vector<Step>& steps,
                   const std::vector<base::NamedFile>& more_inputs, std::vector<base::NamedFile> outputs);

/// An input and, of VTK's files that name others, those.
std::vector<base::NamedFile> input_files(const std::string& what, const std::string& path);

/// Refuses a choice of data for an output that is no file of VTK, and one that its format does not know.
Status check_vtk_data(std::optional<VtkData> data, const std::string& path);

/// That the suffix of the output is none of those `expected`.
Error unknown_output(const std::string& path, const std::string& expected);

/// Refuses what open_rows would refuse by its suffix alone.
Status check_rows_format(const std::string& path);

/// The output of the job as rows; names in a header that a terminal shows are without control characters.
Result<std::unique_ptr<TableSink>> open_rows(const SamplingJob& job, const TableFormat& format);

}  // namespace barycert::jobs
