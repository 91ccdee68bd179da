#include "barycert/audit_report.hpp"

#include <algorithm>
#include <map>

#include "barycert/base/text.hpp"
#include "barycert/environment.hpp"
#include "barycert/report/audit/oracle_words.hpp"
#include "barycert/report/common/terminal_text.hpp"

namespace barycert {

using namespace report;

namespace {

std::uint64_t count_of(const KernelStatistics& s, Finding f) {
    return s.counts[static_cast<std::size_t>(f)];
}

/// Cases and wrong ones of a kernel in the families that draw from meshes.
std::pair<std::uint64_t, std::uint64_t> on_meshes(const AuditReport& report, const KernelResult& k) {
    std::uint64_t wrong = 0, cases = 0;
    for (const FamilyResult& f : k.families) {
        if (!report.families[f.family].needs_mesh) continue;
        wrong += f.statistics.wrong_cases;
        cases += f.statistics.cases;
    }
    return {wrong, cases};
}

/// What a kernel in a process of its own did besides answering.
std::string incidents(const KernelStatistics& s) {
    std::string out;
    for (const Finding f :
         {Finding::crashed, Finding::hung, Finding::out_of_bounds, Finding::changed_environment, Finding::printed}) {
        if (count_of(s, f) != 0)
            out += fmt::format("{}{} in {} cases", out.empty() ? "" : ", ", name(f), count_of(s, f));
    }
    if (s.not_run != 0) out += fmt::format("; given up: {} cases were not run", s.not_run);
    return out;
}

std::string kernel_table(const AuditReport& report, const Colours& paint) {
    std::size_t width = 6;
    for (const KernelResult& k : report.kernels) width = std::max(width, k.kernel.name.size());
    const auto row = [&](const auto&... cells) {
        return fmt::format(
            "{:<{}} {:>5} {:>6} {:>6} {:>5} {:>5} {:>5} {:>6} {:>6} {:>7} {:>6} {:>6} {:>9} {:>9} {:>9} {:>5}",
            cells...);
    };
    std::string out;
    out += paint.bold(row("kernel", width, "cases", "wrong", "wrong%", "opp.", "false", "false", "not", "false",
                          "false", "false", "missed", "ulps", "ulps", "value", "ns")) +
           "\n";
    out += paint.bold(row("", width, "", "%", "meshes", "sign", "zero", "non-0", "finite", "inside", "outside",
                          "degen.", "degen.", "99.9%", "worst", "99.9%", "")) +
           "\n";
    for (const KernelResult& k : report.kernels) {
        const KernelStatistics& s = k.total;
        const auto n = [&](Finding f) { return brief_count(count_of(s, f)); };
        const auto [mesh_wrong, mesh_cases] = on_meshes(report, k);
        const std::string line =
            row(k.kernel.name, width, brief_count(s.cases), percent(s.wrong_cases, s.cases),
                mesh_cases == 0 ? std::string("-") : percent(mesh_wrong, mesh_cases), n(Finding::opposite_sign),
                n(Finding::false_zero), n(Finding::false_nonzero), n(Finding::not_finite), n(Finding::false_inside),
                n(Finding::false_outside), n(Finding::false_declaration), n(Finding::missed_degenerate),
                brief(s.p999_weight_ulp()), brief(s.weight_ulp.value), brief(s.p999_value_ulp()), brief_time(k.ns));
        const std::uint64_t broken = count_of(s, Finding::false_certificate);
        const bool perfect = s.wrong_cases == 0 && s.weight_ulp.value == 0;
        out += (perfect ? paint.good(line) : line) + "\n";
        if (const std::string beside = incidents(s); !beside.empty()) out += paint.bad("    " + beside) + "\n";
        if (broken != 0)
            out += paint.bad(fmt::format("    certifies its answers, and {} of them are wrong", broken)) + "\n";
    }
    out += paint.dim(
        "wrong %: share of cases with a finding, over all families and over the families mesh.*. A finding is a wrong "
        "sign, zero, region or declaration.\nulps: error of a weight in ulps of the correctly rounded weight; value: "
        "the same for the interpolated value. Signs, zeros and not\nfinite count weights; inside, outside and "
        "degenerate count cases.  "
        "ns: median time of one evaluation, over blocks of cases.\n");
    return out;
}

std::string exact_regions(const AuditReport& report) {
    std::string out = "exactly: ";
    for (const Region r : all_regions) {
        out += fmt::format("{}{} {}", r == Region::interior ? "" : ", ", report.regions[static_cast<std::size_t>(r)],
                           name(r));
    }
    return out + "\n";
}

std::string family_table(const AuditReport& report, const Colours& paint) {
    struct Row {
        std::uint64_t cases = 0;
        std::size_t clean = 0;
        std::vector<std::pair<std::uint64_t, std::string>> wrong;  ///< wrong cases and kernel
    };
    std::map<std::pair<std::size_t, Simplex>, Row> rows;
    std::size_t width = 6;
    for (const KernelResult& k : report.kernels) {
        for (const FamilyResult& f : k.families) {
            Row& row = rows[{f.family, k.kernel.simplex}];
            row.cases = f.statistics.cases;
            row.clean += f.statistics.wrong_cases == 0 ? 1 : 0;
            row.wrong.emplace_back(f.statistics.wrong_cases, k.kernel.name.substr(k.kernel.name.find('.') + 1));
            width = std::max(width, report.families[f.family].name.size());
        }
    }
    const auto line = [&](const auto&... cells) {
        return fmt::format("{:<{}}  {:<11} {:>7} {:>7} {:>9} {:>8}  {}", cells...);
    };
    std::string out =
        paint.bold(line("family", width, "simplex", "cases", "clean", "median %", "worst %", "worst kernel")) + "\n";
    for (auto& [key, row] : rows) {
        std::stable_sort(row.wrong.begin(), row.wrong.end(),
                         [](const auto& a, const auto& b) { return a.first > b.first; });
        const std::uint64_t worst = row.wrong.front().first;
        const auto ties =
            std::count_if(row.wrong.begin(), row.wrong.end(), [&](const auto& w) { return w.first == worst; });
        const std::string kernel = row.wrong.front().second + (ties > 1 ? fmt::format(" (+{} more)", ties - 1) : "");
        out += line(report.families[key.first].name, width, name(key.second), brief_count(row.cases),
                    fmt::format("{}/{}", row.clean, row.wrong.size()),
                    percent(row.wrong[(row.wrong.size() - 1) / 2].first, row.cases), percent(worst, row.cases),
                    worst == 0 ? std::string("-") : kernel) +
               "\n";
    }
    return out + paint.dim(
                     "clean: kernels without a finding / all kernels. median, worst: share of wrong cases, over the "
                     "kernels.\n");
}

std::string replay_command(const AuditReport& report, const KernelResult& k, const Witness& w,
                           const TerminalStyle& style) {
    std::string libraries;
    for (const std::string& library : style.library_arguments) libraries += " --kernel-library " + shell_word(library);
    libraries += style.kernel_arguments;
    if (!style.witness_path.empty()) {
        return fmt::format("{} replay {}{} --kernel {} --reason {}", style.command, shell_word(style.witness_path),
                           libraries, shell_word(k.kernel.name), w.reason);
    }
    std::string command = style.command + " replay" + libraries;
    const auto family =
        std::find_if(report.families.begin(), report.families.end(), [&](const auto& f) { return f.name == w.family; });
    if (family != report.families.end() && family->needs_mesh) {
        for (const std::string& mesh : style.mesh_arguments) command += " --mesh " + shell_word(mesh);
    }
    return command + fmt::format(" --kernel {} --family {} --case {} --seed {}", shell_word(k.kernel.name),
                                 shell_word(w.family), w.index, w.seed);
}

/// What a witness shows, in words.
std::string shows(const Witness& w) {
    if (w.reason.ends_with("_ulp")) return brief(w.magnitude) + " ulps";
    if (!w.detail.empty()) return w.detail;
    if (w.reason == "false_declaration") return "declared degenerate";
    if (w.reason == "missed_degenerate") return "weights up to " + brief(w.magnitude);
    return std::isfinite(w.magnitude) ? "a weight off by " + brief(w.magnitude) : "a weight that is not finite";
}

std::string witness_list(const AuditReport& report, const TerminalStyle& style, const Colours& paint) {
    std::string out;
    for (const KernelResult& k : report.kernels) {
        const Witness* w = worst_witness(k);
        if (w == nullptr) {
            out += paint.bold(k.kernel.name) + ": no witness, every weight and value is correctly rounded\n";
            continue;
        }
        const std::string where = w->cell < 0 ? "" : fmt::format(", cell {} of {}", w->cell, base::printable(w->mesh));
        out += fmt::format("{}: {} in {}, case {}{} ({})\n    {}\n", paint.bold(k.kernel.name), w->reason, w->family,
                           w->index, where, base::printable(shows(*w)), replay_command(report, k, *w, style));
    }
    return out;
}

/// The meshes, by what is known of them.
std::string mesh_lines(const AuditReport& report, const TerminalStyle& style, const Colours& paint) {
    if (report.meshes.empty()) return "meshes: none\n";
    std::string out;
    const auto line = [&](Verdict verdict, std::string_view text, std::string_view hint) {
        std::string names;
        for (std::size_t i = 0; i < report.meshes.size(); ++i) {
            if (report.verdicts[i] == verdict) names += (names.empty() ? "" : ", ") + base::printable(report.meshes[i]);
        }
        if (names.empty()) return;
        const std::string whole = fmt::format("meshes, {}: {}{}", text, names, hint);
        out += (verdict == Verdict::not_certified ? paint.bad(whole) : whole) + "\n";
    };
    line(Verdict::certified, "certified to be partitions", "");
    line(Verdict::not_certified, "NOT certified to be partitions", fmt::format(" (why: {} check MESH)", style.command));
    line(Verdict::not_checked, "not checked", "");
    return out;
}

}  // namespace

std::string audit_text(const AuditReport& report, const TerminalStyle& style) {
    const ExactEnvironment environment;
    const Colours paint(style.colour);
    std::string out = environment_line(report.environment) + "\n";
    out += fmt::format(
        "seed {}, {} cases per family and simplex, {} in all, {} kernels, {} families, {} threads, {:.1f} s\n",
        report.seed, report.count, report.cases, report.kernels.size(), report.families.size(), report.threads,
        report.seconds);
    out += mesh_lines(report, style, paint) + exact_regions(report) + oracle_line(report.oracles) + "\n";
    out += kernel_table(report, paint) + "\n" + family_table(report, paint) + "\n";
    out += paint.bold("Worst witness of each kernel, and the command that replays it:") + "\n" +
           witness_list(report, style, paint);
    return out;
}

}  // namespace barycert
