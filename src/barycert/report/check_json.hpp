/// The report on a mesh as JSON. Every member is documented in SCHEMA.md beside this file.
#pragma once

#include <string>

#include "barycert/check/check.hpp"
#include "barycert/core/environment.hpp"

namespace barycert::report {

inline constexpr int check_schema = 1;

/// `name`: what the user calls the mesh.
std::string check_json(const check::Report& report, const std::string& name, const Environment& environment);

}  // namespace barycert::report
