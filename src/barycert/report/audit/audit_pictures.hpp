/// Pictures of an audit's page, as markup.
#pragma once

#include <string>
#include <vector>

#include "barycert/audit_report.hpp"

namespace barycert::report {

/// A figure for each kind of simplex with times: share of wrong cases over time, and the front of the best.
std::string pareto_figures(const AuditReport& report);

/// A small histogram a kernel: cases by the size of the error.
std::string error_histograms(const AuditReport& report);

/// The exact picture of each kind of case, and beside it those of the kernels; the same pictures are shown once.
/// Error: a picture cannot be made.
Result<std::string> sign_figures(const std::vector<SignPicture>& pictures);

/// In which cells of the meshes kernels err. Error: a picture cannot be made.
Result<std::string> map_figures(const AuditReport& report, const std::vector<MeshMap>& maps);

}  // namespace barycert::report
