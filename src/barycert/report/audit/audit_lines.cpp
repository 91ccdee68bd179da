// Witnesses and families in words.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "barycert/base/text.hpp"
#include "barycert/report/audit/audit_words.hpp"
#include "barycert/report/common/terminal_text.hpp"

namespace barycert::report {

std::vector<const FamilyResult*> families_worst_first(const KernelResult& k) {
    std::vector<const FamilyResult*> families;
    for (const FamilyResult& f : k.families) families.push_back(&f);
    std::stable_sort(families.begin(), families.end(), [](const FamilyResult* a, const FamilyResult* b) {
        return a->statistics.wrong_cases > b->statistics.wrong_cases;
    });
    return families;
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

std::string broken_certificates(const KernelStatistics& s) {
    const std::uint64_t broken = count_of(s, Finding::false_certificate);
    return broken == 0 ? "" : fmt::format("certifies its answers, and {} of them are wrong", broken);
}

std::string place_of(const Witness& w) {
    return fmt::format("{}, case {}{}", base::printable(w.family), w.index,
                       w.cell < 0 ? "" : fmt::format(", cell {} of {}", w.cell, base::printable(w.mesh)));
}

std::string shows(const Witness& w) {
    if (w.reason.ends_with("_ulp")) return brief(w.magnitude) + " ulps";
    if (!w.detail.empty()) return base::printable(w.detail);
    if (const auto f = finding_named(w.reason); f && *f <= Finding::printed) return "asked once more, it did not";
    if (w.reason == "false_declaration") return "declared degenerate";
    if (w.reason == "missed_degenerate") return "weights up to " + brief(w.magnitude);
    return std::isfinite(w.magnitude) ? "a weight off by " + brief(w.magnitude) : "a weight that is not finite";
}

namespace {

/// The user's libraries, and how they are run and judged.
std::string kernel_words(const TerminalStyle& style) {
    std::string words;
    for (const std::string& library : style.library_arguments) words += " --kernel-library " + shell_word(library);
    return words + style.kernel_arguments;
}

}  // namespace

std::string replay_from_file(const std::string& kernel, const std::string& reason, const TerminalStyle& style) {
    return fmt::format("{} replay {}{} --kernel {} --reason {}", style.command, shell_word(style.witness_path),
                       kernel_words(style), shell_word(kernel), reason);
}

std::string replay_command(const AuditReport& report, const KernelResult& k, const Witness& w,
                           const TerminalStyle& style) {
    if (k.kernel.raised != nullptr) return {};  // no other program has the callable
    if (!style.witness_path.empty()) return replay_from_file(k.kernel.name, w.reason, style);
    std::string command = style.command + " replay" + kernel_words(style);
    const auto family =
        std::find_if(report.families.begin(), report.families.end(), [&](const auto& f) { return f.name == w.family; });
    if (family != report.families.end() && family->needs_mesh) {
        for (const std::string& mesh : style.mesh_arguments) command += " --mesh " + shell_word(mesh);
    }
    command += fmt::format(" --kernel {} --family {} --case {} --seed {}", shell_word(k.kernel.name),
                           shell_word(w.family), w.index, w.seed);
    // The answers show what else was found; these may not come again.
    const auto f = finding_named(w.reason);
    return f && *f <= Finding::printed ? command + " --reason " + w.reason : command;
}

std::vector<FamilyLine> family_lines(const AuditReport& report) {
    struct Row {
        std::uint64_t cases = 0;
        std::size_t kernels = 0;
        std::vector<std::pair<std::uint64_t, std::string>> wrong;  ///< wrong cases and kernel
    };
    std::map<std::pair<std::size_t, Simplex>, Row> rows;
    for (const KernelResult& k : report.kernels) {
        for (const FamilyResult& f : k.families) {
            Row& row = rows[{f.family, k.kernel.simplex}];
            row.cases = std::max(row.cases, f.statistics.cases);
            ++row.kernels;
            if (f.statistics.cases == 0) continue;
            row.wrong.emplace_back(f.statistics.wrong_cases,
                                   base::printable(k.kernel.name.substr(k.kernel.name.find('.') + 1)));
        }
    }
    std::vector<FamilyLine> lines;
    for (auto& entry : rows) {
        const std::pair<std::size_t, Simplex>& key = entry.first;
        Row& row = entry.second;  // no structured binding: lambdas capture it
        std::stable_sort(row.wrong.begin(), row.wrong.end(),
                         [](const auto& a, const auto& b) { return a.first > b.first; });
        if (row.wrong.empty()) row.wrong.emplace_back(0, "not run");
        const std::uint64_t worst = row.wrong.front().first;
        const auto with = [&](std::uint64_t n) {
            return static_cast<std::size_t>(
                std::count_if(row.wrong.begin(), row.wrong.end(), [&](const auto& w) { return w.first == n; }));
        };
        const std::string more = with(worst) > 1 ? fmt::format(" (+{} more)", with(worst) - 1) : "";
        lines.push_back({.family = report.families[key.first].name,
                         .simplex = std::string(name(key.second)),
                         .cases = row.cases,
                         .clean = row.cases == 0 ? 0 : with(0),
                         .kernels = row.kernels,
                         .median = row.wrong[(row.wrong.size() - 1) / 2].first,
                         .worst = worst,
                         .worst_kernel = worst == 0 && row.cases != 0 ? "-" : row.wrong.front().second + more});
    }
    return lines;
}

}  // namespace barycert::report
