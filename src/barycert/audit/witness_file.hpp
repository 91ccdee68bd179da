/// Witnesses as JSON: coordinates in hexadecimal floating point, so that they read back to the same bits.
#pragma once

#include <string>
#include <vector>

#include "barycert/audit/runner.hpp"
#include "barycert/core/result.hpp"

namespace barycert::audit {

inline constexpr int witness_schema = 1;

/// {"schema": 1, "witnesses": [...]} of all kernels of a report, one witness a line of finding.
std::string witness_file(const Report& report);

/// Reads what witness_file() wrote, or the "witnesses" of an audit's JSON report: from a regular file, or a pipe that
/// is being written to. Errors: the file cannot be read, is not JSON or of another schema; a witness is malformed.
Result<std::vector<Witness>> read_witnesses(const std::string& path);

}  // namespace barycert::audit
