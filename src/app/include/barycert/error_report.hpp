/// An error as JSON, as programs write it in place of a report: Failure in doc/json.md.
///
/// Example:
///
///     #include <cstdio>
///     #include "barycert/mesh_files.hpp"
///     const Result<Mesh> mesh = read_mesh("part.1");
///     if (!mesh) std::puts(error_json(mesh.error()).c_str());
#pragma once

#include <string>
#include <string_view>

#include "barycert/result.hpp"

namespace barycert {

/// Returns the JSON, in UTF-8 whatever bytes the error's parts have. `option`: the option of a program that sets what
/// the error is about; empty: none.
std::string error_json(const Error& error, std::string_view option = {});

}  // namespace barycert
