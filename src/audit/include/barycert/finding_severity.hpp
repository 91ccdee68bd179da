/// How bad a finding of an audit is.
///
///     for (std::size_t f = 0; f < finding_count; ++f)
///         if (severity(static_cast<Finding>(f)) == Severity::error) ...
#pragma once

#include "barycert/audit.hpp"
#include "barycert/severity.hpp"

namespace barycert {

/// Returns warning for what a kernel does besides answering and its answer can be right; error for all else.
constexpr Severity severity(Finding finding) {
    const bool beside =
        finding == Finding::forked || finding == Finding::changed_environment || finding == Finding::printed;
    return beside ? Severity::warning : Severity::error;
}

}  // namespace barycert
