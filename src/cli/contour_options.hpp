/// What `barycert render iso` and `barycert render slice` share.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "barycert/jobs.hpp"

namespace CLI {
class App;
}  // namespace CLI

namespace barycert::cli {

/// Finite numbers between separators; nothing if the text is something else.
std::optional<std::vector<double>> finite_numbers(std::string_view text, char separator);

/// --json, --quiet, --threads, --field-file and its kin, --fields.
void add_contour_options(CLI::App& sub, ContourJob& job, bool& quiet);

/// Refuses options of pictures that were given, where the output is a surface.
Status check_picture_only(const CLI::App& sub, const std::string& output, const std::vector<const char*>& options);

/// Does the job, with progress on a terminal, and writes its reports. Returns the exit code.
int run_contour(ContourJob& job, bool quiet);

}  // namespace barycert::cli
