#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "barycert/base/text.hpp"
#include "barycert/report/audit/audit_words.hpp"
#include "barycert/report/audit/oracle_words.hpp"
#include "barycert/report/audit/terminal_tables.hpp"
#include "barycert/report/common/terminal_text.hpp"

namespace barycert::report {
namespace {

constexpr std::size_t kernel_text_width = 100;

std::string what_it_is(const Kernel& k) {
    std::string out;
    const auto line = [&](std::string_view what, const std::string& text) {
        if (!text.empty()) out += wrapped(fmt::format("{:<8} {}", what, base::printable(text)), kernel_text_width);
    };
    line("formula", k.formula);
    line("source", k.source);
    line("fails", k.fails);
    return out;
}

/// The families, most wrong cases first, in the order of the report where they are equal.
std::string kernel_families(const AuditReport& report, const KernelResult& k, const Colours& paint) {
    std::size_t width = 6;
    for (const FamilyResult& f : k.families) width = std::max(width, report.families[f.family].name.size());
    const auto row = [&](const auto&... cells) {
        return fmt::format("{:<{}} {:>6} {:>6} {:>6} {:>6} {:>6} {:>6} {:>8} {:>8}", cells...);
    };
    std::string out =
        paint.bold(row("family", width, "cases", "wrong", "in as", "out as", "no", "error", "error", "error")) + "\n" +
        paint.bold(row("", width, "", "%", "out %", "in %", "ans. %", "99 %", "max", "ulps")) + "\n";
    for (const FamilyResult* f : families_worst_first(k)) {
        const KernelStatistics& s = f->statistics;
        if (s.cases == 0) {
            out += fmt::format("{:<{}} {:>6}  not run, the kernel had been given up\n", report.families[f->family].name,
                               width, 0);
            continue;
        }
        const std::string line =
            row(report.families[f->family].name, width, brief_count(s.cases), percent(s.wrong_cases, s.cases),
                percent(inside_called_outside(s)), percent(outside_called_inside(s)), percent(unanswered(s)),
                usual_error(s), brief(s.errors.worst.value), brief(s.weight_ulp.value));
        out += (s.wrong_cases == 0 ? paint.good(line) : line) + "\n";
    }
    return out;
}

std::string kernel_findings(const AuditReport& report, const KernelResult& k, const TerminalStyle& style,
                            const Colours& paint) {
    std::string out;
    for (const Witness& w : k.witnesses) {
        out += paint.bold(w.reason + ": " + finding_sentence(k, w)) + "\n";
        out += fmt::format("    {}: {}\n", place_of(w), shows(w));
        if (const std::string replay = replay_command(report, k, w, style); !replay.empty())
            out += fmt::format("    {}\n", paint.dim(replay));
    }
    if (out.empty() && k.total.not_run == 0) return "No witness: every weight and value is correctly rounded.\n";
    return out;
}

}  // namespace

std::string kernel_text(const AuditReport& report, const TerminalStyle& style) {
    const Colours paint(style.colour);
    const KernelResult& k = report.kernels.front();
    const std::string verdict = verdict_sentence(report);
    std::string out = (any_wrong(report) ? paint.bad(verdict) : paint.good(verdict)) + "\n";
    for (const std::string& line : verdict_details(report)) out += wrapped(line, kernel_text_width);
    if (k.ns > 0) out += brief_time(k.ns) + " ns an evaluation\n";
    const std::string what = what_it_is(k.kernel);
    out += (what.empty() ? "" : "\n" + what) + "\n";
    out += kernel_families(report, k, paint) + "\n";
    out += paint.bold(k.kernel.raised != nullptr ? "Worst case of each finding:"
                                                 : "Worst case of each finding, and the command that replays it:") +
           "\n" + kernel_findings(report, k, style, paint) + "\n";
    out += wrapped(cases_sentence(report), kernel_text_width) + wrapped(oracle_line(report.oracles), kernel_text_width);
    for (const MeshLine& line : mesh_lines(report, style.command)) {
        const std::string text = wrapped(line.text, kernel_text_width, ", ");
        out += line.bad ? paint.bad(text) : text;
    }
    return out + how_it_was_made(report) + "\n" + environment_line(report.environment) + "\n";
}

}  // namespace barycert::report
