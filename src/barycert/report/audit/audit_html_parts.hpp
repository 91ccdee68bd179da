/// The parts of the audit's HTML page. Text from outside is escaped in each.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "barycert/audit_report.hpp"

namespace barycert::report {

/// The table of kernels, worst first.
std::string league_html(const AuditReport& report);
/// Of the only kernel: its families, most wrong cases first.
std::string kernel_families_html(const AuditReport& report, const KernelResult& k);
/// The families over all kernels.
std::string families_html(const AuditReport& report);
/// A small histogram a kernel: cases by the size of the error.
std::string error_histograms_html(const AuditReport& report);
/// Of each kernel the witnesses of all its findings, with commands.
std::string witnesses_html(const AuditReport& report, const TerminalStyle& style);

/// A figure for each kind of simplex with times: share of wrong cases over time, and the front of the best.
std::string pareto_html(const AuditReport& report);

/// The exact picture of each kind of case, and beside it those of the kernels; the same pictures are shown once.
/// Error: a picture cannot be made.
Result<std::string> signs_html(const std::vector<SignPicture>& pictures);

/// In which cells of the meshes kernels err. Error: a picture cannot be made.
Result<std::string> maps_html(const AuditReport& report, const std::vector<MeshMap>& maps);

/// What other programs measured: the flags matrix, the league of systems.
std::string others_html(const std::vector<OtherResults>& others);

/// Kinds of cases in the order that the page has them: "triangle", "triangle3d", ... "triangle.perspective".
std::string kind_of(Simplex simplex, bool perspective);

}  // namespace barycert::report
