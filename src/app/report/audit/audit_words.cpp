#include "app/report/audit/audit_words.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <numeric>
#include <span>
#include <string>
#include <vector>

#include "app/report/common/terminal_text.hpp"
#include "barycert/audit.hpp"
#include "barycert/family.hpp"
#include "barycert/finding.hpp"
#include "barycert/report.hpp"
#include "barycert/simplex.hpp"
#include "barycert/statistics.hpp"
#include "barycert/witness.hpp"

namespace barycert::report {
namespace {

std::uint64_t exactly(const KernelStatistics& s, Region r) {
    const auto& claimed = s.confusion[static_cast<std::size_t>(r)];
    return std::accumulate(claimed.begin(), claimed.end(), std::uint64_t{0});
}

/// All cases were run, and none has a finding.
bool without_finding(const KernelStatistics& s) {
    return s.wrong_cases == 0 && s.not_run == 0;
}

/// Says what is wrong with a kernel, how often and by how much.
std::string kernel_sentence(const AuditReport& report, const KernelResult& k) {
    const KernelStatistics& s = k.total;
    const Share out = inside_called_outside(s), in = outside_called_inside(s), none = unanswered(s);
    std::vector<std::string> parts;
    if (in.whole != 0) parts.push_back(fmt::format("takes {} % of the points outside for inside", percent(in)));
    if (out.whole != 0)
        parts.push_back(in.whole == 0 ? fmt::format("takes {} % of the points inside for outside", percent(out))
                                      : fmt::format("{} % of those inside for outside", percent(out)));
    if (none.part != 0) parts.push_back(fmt::format("gives no finite answer to {} % of the cases", percent(none)));
    parts.push_back(incidents(s));
    const double worst = s.errors.worst.value, meshes = worst_on_meshes(report, k), usual = s.errors.within(0.99);
    if (worst == 0 && none.part == 0) {
        parts.emplace_back("every weight is correctly rounded");
    } else if (worst >= 0) {
        parts.push_back(usual == 0
                            ? "99 % of its answers have no error"
                            : fmt::format("99 % of its answers are off by {}",
                                          std::isinf(usual) ? "up to 100 and more" : "less than " + brief(usual)));
        parts.push_back("the worst is off by " + brief(worst));
        if (meshes >= 0 && meshes != worst) parts.push_back("the worst on meshes by " + brief(meshes));
    }
    return joined(parts, "; ", [](const std::string& part) { return part; });
}

/// The user's libraries, and how they are run and judged.
std::string kernel_words(const TerminalStyle& style) {
    return joined(style.library_arguments, "", [](const auto& l) { return " --kernel-library " + shell_word(l); }) +
           style.kernel_arguments;
}

}  // namespace

Share inside_called_outside(const KernelStatistics& s) {
    return {count_of(s, Finding::false_outside), exactly(s, Region::interior) + exactly(s, Region::boundary)};
}

Share outside_called_inside(const KernelStatistics& s) {
    return {count_of(s, Finding::false_inside), exactly(s, Region::outside)};
}

bool perfect(const KernelStatistics& s) {
    return without_finding(s) && s.errors.worst.value <= 0;
}

double worst_on_meshes(const AuditReport& report, const KernelResult& k) {
    double worst = -1;
    for (const FamilyResult& f : k.families) {
        if (report.families[f.family].needs_mesh) worst = std::max(worst, f.statistics.errors.worst.value);
    }
    return worst;
}

std::string usual_error(const KernelStatistics& s) {
    const double within = s.errors.within(0.99);
    if (within <= 0) return brief(within);
    if (std::isinf(within)) return ">=100";
    const auto exponent = static_cast<int>(std::lround(std::log10(within)));
    return exponent < 0 ? fmt::format("<1e{}", exponent) : "<" + brief(within);
}

std::string incidents(const KernelStatistics& s) {
    const std::string all = joined(std::span(finding_texts).first(static_cast<std::size_t>(Finding::printed) + 1), ", ",
                                   [&](const FindingText& text) {
                                       const std::uint64_t n = count_of(s, *finding_named(text.name));
                                       return n == 0 ? "" : fmt::format("{} in {} cases", text.name, n);
                                   });
    return s.not_run == 0 ? all
                          : fmt::format("{}{}given up: {} cases were not run", all, all.empty() ? "" : "; ", s.not_run);
}

bool any_wrong(const AuditReport& report) {
    return !std::ranges::all_of(report.kernels, without_finding, &KernelResult::total);
}

std::string verdict_sentence(const AuditReport& report) {
    const auto is_wrong = [](const KernelResult& k) { return k.total.wrong_cases != 0; };
    const auto all = std::ssize(report.kernels), wrong = std::ranges::count_if(report.kernels, is_wrong);
    if (all == 1) {
        const KernelResult& k = report.kernels.front();
        const std::string left_out = k.total.not_run == 0 ? "" : fmt::format(", {} not run", k.total.not_run);
        return wrong == 0 ? fmt::format("{}: no wrong answer in {} cases{}", k.kernel.name, k.total.cases, left_out)
                          : fmt::format("{} is wrong in {} % of {} cases", k.kernel.name,
                                        percent(k.total.wrong_cases, k.total.cases), k.total.cases);
    }
    if (wrong != 0) return fmt::format("{} of {} kernels give wrong answers", wrong, all);
    return fmt::format("none of {} kernels gives a wrong answer{}", all,
                       any_wrong(report) ? ", but not all cases were run" : "");
}

std::vector<std::string> verdict_details(const AuditReport& report) {
    const KernelResult& first = report.kernels.front();
    if (report.kernels.size() == 1) {
        std::string text = kernel_sentence(report, first);
        if (text.empty()) return {};
        text.front() = static_cast<char>(text.front() >= 'a' && text.front() <= 'z' ? text.front() - 32 : text.front());
        return {text + "."};
    }
    std::vector<std::string> lines;
    if (any_wrong(report))
        lines.push_back(fmt::format("Worst: {}, wrong in {} % of its cases: {}.", first.kernel.name,
                                    percent(first.total.wrong_cases, first.total.cases),
                                    kernel_sentence(report, first)));
    const auto tell = [&](const char* what, auto which) {
        const std::string names = joined(report.kernels, ", ", [&](const KernelResult& k) {
            return which(k.total) ? k.kernel.name : std::string();
        });
        if (!names.empty()) lines.push_back(fmt::format("{}: {}.", what, names));
    };
    tell("Certified and wrong all the same",
         [](const KernelStatistics& s) { return count_of(s, Finding::false_certificate) != 0; });
    tell("Right in every case, to the last bit", perfect);
    tell("No wrong sign or region, but rounding errors",
         [](const KernelStatistics& s) { return without_finding(s) && !perfect(s); });
    return lines;
}

std::string finding_sentence(const KernelResult& k, const Witness& w) {
    const auto finding = finding_named(w.reason);
    if (!finding)
        return w.reason == "worst_value_ulp" ? "the largest error of a value, in ulps"
                                             : "the largest error of a weight, in ulps";
    return fmt::format("{} {}: {}", count_of(k.total, *finding),
                       *finding < Finding::opposite_sign ? "cases" : "weights",
                       finding_texts[static_cast<std::size_t>(*finding)].meaning);
}

std::string shows(const Witness& w) {
    if (w.reason.ends_with("_ulp")) return brief(w.magnitude) + " ulps";
    if (!w.detail.empty()) return w.detail;
    if (const auto f = finding_named(w.reason); f && *f <= Finding::printed) return "asked once more, it did not";
    if (w.reason == "false_declaration") return "declared degenerate";
    if (w.reason == "missed_degenerate") return "weights up to " + brief(w.magnitude);
    return std::isfinite(w.magnitude) ? "a weight off by " + brief(w.magnitude) : "a weight that is not finite";
}

std::string replay_from_file(const std::string& kernel, const std::string& reason, const TerminalStyle& style) {
    return fmt::format("{} replay {}{} --kernel {} --reason {}", style.command, shell_word(style.witness_path),
                       kernel_words(style), shell_word(kernel), reason);
}

std::string replay_command(const AuditReport& report, const KernelResult& k, const Witness& w,
                           const TerminalStyle& style) {
    if (k.kernel.raised != nullptr) return {};  // no other program has the callable
    if (!style.witness_path.empty()) return replay_from_file(k.kernel.name, w.reason, style);
    std::string command = style.command + " replay" + kernel_words(style);
    const auto family = std::ranges::find(report.families, w.family, &Family::name);
    if (family != report.families.end() && family->needs_mesh)
        command += joined(style.mesh_arguments, "", [](const auto& mesh) { return " --mesh " + shell_word(mesh); });
    command += fmt::format(" --kernel {} --family {} --case {} --seed {}", shell_word(k.kernel.name),
                           shell_word(w.family), w.index, w.seed);
    // The answers show what else was found; these may not come again.
    const auto f = finding_named(w.reason);
    return f && *f <= Finding::printed ? command + " --reason " + w.reason : command;
}

std::string oracle_line(const OracleCounts& o) {
    const std::string confirmed = clauses({{o.also_integers, "by integers"}, {o.also_cgal, "by CGAL"}}, ", ");
    return "decided: " +
           clauses({{o.core, "by barycert's core"},
                    {o.integers, fmt::format("by integers ({} of them wide)", o.wide)},
                    {o.cgal, "by CGAL"}},
                   ", ") +
           (confirmed.empty() ? "" : "; confirmed: " + confirmed + ", 0 disagreements");
}

}  // namespace barycert::report
