/// Reports as JSON. Every member is documented in SCHEMA.md beside this file.
#pragma once

#include <string>

#include "barycert/audit/runner.hpp"
#include "barycert/audit/witness_file.hpp"

namespace barycert::report {

/// One number for reports and witness files: `barycert replay` reads both.
inline constexpr int audit_schema = audit::witness_schema;

/// The whole audit, witnesses included.
std::string json_report(const audit::Report& report);

/// The catalogue and the families, as `barycert kernels --json` and `barycert families --json` print them.
std::string kernels_json(const std::vector<Kernel>& kernels);
std::string families_json(const std::vector<audit::Family>& families);

}  // namespace barycert::report
