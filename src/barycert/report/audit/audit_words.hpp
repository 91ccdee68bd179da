/// The words of reports on audited kernels: the same on the terminal and in HTML.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "barycert/audit.hpp"
#include "barycert/report.hpp"

namespace barycert::report {

inline std::uint64_t count_of(const KernelStatistics& s, Finding f) {
    return s.counts[static_cast<std::size_t>(f)];
}

/// A share: how many of how many.
struct Share {
    std::uint64_t part = 0, whole = 0;
};
std::string percent(const Share& share);  ///< "-" if there are none

/// Points exactly inside or on the boundary that the kernel calls outside, and points outside that it calls inside or
/// on the boundary.
Share inside_called_outside(const KernelStatistics& s);
Share outside_called_inside(const KernelStatistics& s);
/// Wrong cases of the families that draw from meshes.
Share wrong_on_meshes(const AuditReport& report, const KernelResult& k);

/// All cases were run, and none has a finding.
bool without_finding(const KernelStatistics& s);
/// Every weight of every case is correctly rounded, and nothing else is wrong.
bool perfect(const KernelStatistics& s);

/// Cases without a finite answer, of those whose simplex is not degenerate.
Share unanswered(const KernelStatistics& s);
/// The largest error over the families that draw from meshes, of cases with a finite answer; -1 if there are none.
double worst_on_meshes(const AuditReport& report, const KernelResult& k);

/// "<1e-13": 99 % of the cases with an answer are below; "0"; ">=100"; "-": no such cases.
std::string usual_error(const KernelStatistics& s);

/// How many kernels are wrong: "56 of 62 kernels give wrong answers"; of one kernel, how often.
std::string verdict_sentence(const AuditReport& report);
bool any_wrong(const AuditReport& report);
/// What is wrong with a kernel, how often and by how much.
std::string kernel_sentence(const AuditReport& report, const KernelResult& k);
/// Sentences below the verdict: the worst kernel, broken certificates, the kernels without a finding.
std::vector<std::string> verdict_details(const AuditReport& report);
/// How many cases lie in each region, exactly: "12 interior, 3 boundary, ...".
std::string regions_text(const AuditReport& report);
/// What was audited: cases, families, exact regions.
std::string cases_sentence(const AuditReport& report);
/// What makes the same report again, and how long it took: "seed 1, 100 cases per family and simplex, ...".
std::string how_it_was_made(const AuditReport& report);

/// The families of a kernel, most wrong cases first, in the order of the report where they are equal.
std::vector<const FamilyResult*> families_worst_first(const KernelResult& k);

/// The meshes by what is known of them: "meshes, certified to be partitions: a, b". `bad`: they are no partitions.
struct MeshLine {
    std::string text;
    bool bad = false;
};
std::vector<MeshLine> mesh_lines(const AuditReport& report, std::string_view command);

/// What a kernel in a process of its own did besides answering; empty if nothing.
std::string incidents(const KernelStatistics& s);

/// What the witness's kind of finding means, and of a finding how often the kernel has it.
std::string finding_sentence(const KernelResult& k, const Witness& w);
/// "certifies its answers, and 3 of them are wrong"; empty if none is.
std::string broken_certificates(const KernelStatistics& s);
/// Where a witness comes from: family, case, cell of a mesh.
std::string place_of(const Witness& w);
/// What a witness shows.
std::string shows(const Witness& w);
/// The command that shows the witnesses of style.witness_path with that kernel and reason.
std::string replay_from_file(const std::string& kernel, const std::string& reason, const TerminalStyle& style);
/// The command that shows a witness.
/// Empty of a callable.
std::string replay_command(const AuditReport& report, const KernelResult& k, const Witness& w,
                           const TerminalStyle& style);

/// A family and simplex over all kernels.
struct FamilyLine {
    std::string family, simplex;
    std::uint64_t cases = 0;
    std::size_t clean = 0, kernels = 0;   ///< without a finding, and all
    std::uint64_t median = 0, worst = 0;  ///< wrong cases, over the kernels
    std::string worst_kernel;             ///< "-" if none is wrong; without the simplex
};
std::vector<FamilyLine> family_lines(const AuditReport& report);

}  // namespace barycert::report
