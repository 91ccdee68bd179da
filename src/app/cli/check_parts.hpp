/// What barycert has of `barycert check` (check_whole.cpp), and barycert-check only a part of (check_alone.cpp), so
/// that it is built in less time.
#pragma once

#include <string>

#include "barycert/check_job.hpp"
#include "barycert/result.hpp"

namespace barycert::cli {

/// As check_files(): files of all formats, or of TetGen and Triangle alone.
Result<CheckedMesh> checked_files(const CheckJob& job);

/// The page and the picture of a report, or an Error.
Result<std::string> checked_page(const CheckedMesh& checked, const FixedMesh* fixed);
Result<std::string> checked_plot(const CheckedMesh& checked, const std::string& path);

}  // namespace barycert::cli
