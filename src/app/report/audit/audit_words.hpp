/// The words and the pictures of reports on audited kernels.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "app/report/common/document.hpp"
#include "app/report/common/json.hpp"
#include "app/report/common/terminal_text.hpp"
#include "barycert/audit.hpp"
#include "barycert/audit_pictures.hpp"
#include "barycert/audit_report.hpp"
#include "barycert/family.hpp"
#include "barycert/finding.hpp"
#include "barycert/kernels.hpp"
#include "barycert/report.hpp"
#include "barycert/statistics.hpp"
#include "barycert/witness.hpp"

namespace barycert::report {

inline std::uint64_t count_of(const KernelStatistics& s, Finding f) {
    return s.counts[static_cast<std::size_t>(f)];
}

struct Share {
    std::uint64_t part = 0, whole = 0;
};
/// "-" if there are none.
inline std::string percent(const Share& share) {
    return share.whole == 0 ? "-" : percent(share.part, share.whole);
}

/// Cells of tables that sort: a share in per cent, red where it is not none if `red`; a magnitude.
inline Cell share_cell(const Share& share, bool red = false) {
    return {percent(share), share.whole == 0 ? -1 : static_cast<double>(share.part) / static_cast<double>(share.whole),
            red && share.part != 0 ? Tone::bad : Tone::plain};
}
inline Cell number_cell(double x) {
    return {brief(x), x};
}

/// Points exactly in the closed cell that the kernel calls outside; points outside that it says are in the closed cell.
Share inside_called_outside(const KernelStatistics& s);
Share outside_called_inside(const KernelStatistics& s);
/// Cases without a finite answer, of those whose simplex is not degenerate.
inline Share unanswered(const KernelStatistics& s) {
    return {s.errors.unanswered(), s.errors.total()};
}
/// The largest error over the families that draw from meshes, of cases with a finite answer; -1 if there are none.
double worst_on_meshes(const AuditReport& report, const KernelResult& k);
/// "<1e-13": 99 % of the cases with an answer are below; "0"; ">=100"; "-": no such cases.
std::string usual_error(const KernelStatistics& s);

/// Every weight of every case is correctly rounded, and nothing else is wrong.
bool perfect(const KernelStatistics& s);
/// Some case has a finding, or was not run.
bool any_wrong(const AuditReport& report);
/// How many kernels are wrong: "56 of 62 kernels give wrong answers"; of one kernel, how often.
std::string verdict_sentence(const AuditReport& report);
/// Sentences below the verdict: the worst kernel, broken certificates, the kernels without a finding.
std::vector<std::string> verdict_details(const AuditReport& report);
/// Says what a kernel in a process of its own did besides answering; empty if nothing.
std::string incidents(const KernelStatistics& s);

/// Says what the witness's kind of finding means and, for a finding, how often the kernel has it.
std::string finding_sentence(const KernelResult& k, const Witness& w);
/// Where a witness comes from: family, case, cell of a mesh.
inline std::string place_of(const Witness& w) {
    return fmt::format("{}, case {}{}", w.family, w.index,
                       w.cell < 0 ? "" : fmt::format(", cell {} of {}", w.cell, w.mesh));
}
std::string shows(const Witness& w);
/// The command that shows the witnesses of style.witness_path with that kernel and reason.
std::string replay_from_file(const std::string& kernel, const std::string& reason, const TerminalStyle& style);
/// The command that shows a witness. Empty of a callable.
std::string replay_command(const AuditReport& report, const KernelResult& k, const Witness& w,
                           const TerminalStyle& style);

/// Who decided what is right: "decided: 900 by barycert's core, ...; confirmed: 60 by integers, ..., 0 disagreements".
std::string oracle_line(const OracleCounts& o);
/// Adds the measurements of other programs to a page: the flags matrix, the league of systems.
void tell_others(Document& d, const std::vector<OtherResults>& others);

// Data for programs.

Json kernel_json(const Kernel& kernel);
Json family_json(const Family& family);
Json audit_data(const AuditReport& report);

inline Json oracles_json(OracleChoice choice, const OracleCounts& o) {
    // With a disagreement there is no report.
    return record("choice", choice, MEMBERS(o, core, integers, wide, cgal, also_integers, also_cgal), "disagreements",
                  0);
}

// Pictures of a page, as markup.

/// A figure for each kind of simplex with times: share of wrong cases over time, and the front of the best.
std::string pareto_figures(const AuditReport& report);

/// A small histogram a kernel: cases by the size of the error.
std::string error_histograms(const AuditReport& report);

/// The exact picture of each kind of case, and beside it those of the kernels; the same pictures are shown once. Throws
/// Exception where a picture cannot be made, as does the next.
std::string sign_figures(const std::vector<SignPicture>& pictures);

/// In which cells of the meshes kernels err.
std::string map_figures(const AuditReport& report, const std::vector<MeshMap>& maps);

}  // namespace barycert::report
