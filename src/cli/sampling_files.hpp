/// Points in, rows out, in every format of the command line; and what can be known of files before the work.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "barycert/io.hpp"
#include "barycert/result.hpp"
#include "barycert/sampler.hpp"
#include "files.hpp"
#include "sampling.hpp"

namespace barycert::cli {

/// What both subcommands read.
std::vector<NamedFile> inputs_of(const SamplingArguments& arguments);

/// What can be known of files before the work: of a job with those targets and, besides the common ones, those inputs.
/// Errors: an output is an input or another output, or cannot be written; an input cannot be read.
Status check_files(const SamplingArguments& arguments, const std::vector<NamedFile>& more_inputs,
                   std::vector<NamedFile> outputs);

/// Points of CSV, NPY, .node, and, with VTK, .vtu, .vtp and .vtk files.
Result<std::unique_ptr<points::Source>> open_points(const std::string& path, int dimension);

/// Refuses what open_rows would refuse by its suffix alone.
Status check_rows_format(const std::string& path);

/// Rows to CSV, NPY and, with VTK, .vtu files. `fields` have the columns.
Result<std::unique_ptr<points::Sink>> open_rows(const std::string& path, int dimension,
                                                const std::vector<FieldChoice>& fields,
                                                const std::vector<std::string>& columns, const OutsidePolicy& outside);

}  // namespace barycert::cli
