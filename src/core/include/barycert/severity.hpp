/// How bad a defect of a mesh, a finding of an audit or a verdict on a row of results is. doc/defects.md lists all.
///
/// Example:
///
///     const std::string_view word = name(Severity::warning);  // "warning"
#pragma once

#include <cstdint>
#include <string_view>

namespace barycert {

enum class Severity : std::uint8_t {
    note,     ///< nothing need be done
    warning,  ///< it does not change the verdict, and there is something to do about it
    error,    ///< the mesh is not certified, or the answer is wrong
};

constexpr std::string_view name(Severity s) {
    return s == Severity::error ? "error" : s == Severity::warning ? "warning" : "note";
}

}  // namespace barycert
