#include <fmt/format.h>

#include <algorithm>

#include "barycert/audit_report.hpp"
#include "barycert/base/text.hpp"
#include "barycert/environment.hpp"
#include "barycert/report/audit/audit_words.hpp"
#include "barycert/report/audit/oracle_words.hpp"
#include "barycert/report/audit/terminal_tables.hpp"
#include "barycert/report/common/terminal_text.hpp"

namespace barycert {

using namespace report;

namespace report {

std::string wrapped(const std::string& text, std::size_t width, std::string_view between) {
    std::string out;
    std::size_t column = 0;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t found = text.find(between, at);
        // Without the blank that `between` ends with.
        const std::size_t end = found == std::string::npos ? text.size() : found + between.size() - 1;
        if (column != 0) {
            const bool fits = column + 1 + (end - at) <= width;
            out += fits ? ' ' : '\n';
            column = fits ? column + 1 : 0;
        }
        out.append(text, at, end - at);
        column += end - at;
        at = end + 1;
    }
    return out + "\n";
}

}  // namespace report

namespace {

/// One line a kernel.
std::string league_table(const AuditReport& report, const Colours& paint) {
    std::size_t width = 6;
    for (const KernelResult& k : report.kernels) width = std::max(width, k.kernel.name.size());
    const auto row = [&](const auto&... cells) {
        return fmt::format("{:<{}} {:>6} {:>6} {:>6} {:>6} {:>6} {:>8} {:>8} {:>5}", cells...);
    };
    std::string out =
        paint.bold(row("kernel", width, "wrong", "in as", "out as", "no", "error", "error,", "error,", "ns")) + "\n" +
        paint.bold(row("", width, "%", "out %", "in %", "ans. %", "99 %", "meshes", "ulps", "")) + "\n";
    for (const KernelResult& k : report.kernels) {
        const KernelStatistics& s = k.total;
        const std::string line =
            row(k.kernel.name, width, percent({s.wrong_cases, s.cases}), percent(inside_called_outside(s)),
                percent(outside_called_inside(s)), percent(unanswered(s)), usual_error(s),
                brief(worst_on_meshes(report, k)), brief(s.weight_ulp.value), brief_time(k.ns));
        out += (perfect(s) ? paint.good(line) : line) + "\n";
        if (const std::string beside = incidents(s); !beside.empty()) out += paint.bad("    " + beside) + "\n";
    }
    return out + paint.dim(
                     "wrong   cases with a wrong sign, zero, region or declaration\n"
                     "in as   points inside or on the boundary that the kernel takes for outside; out as: the reverse\n"
                     "no ans. cases without a finite answer, or wrongly declared degenerate\n"
                     "error   of the weights of a case, relative to 1 or the largest weight: what 99 % of the answers\n"
                     "        are below; the largest in the families mesh.*; the largest in units in the last place,\n"
                     "        which are tiny for weights near zero\n"
                     "ns      median time of one evaluation\n");
}

}  // namespace

std::string audit_text(const AuditReport& report, const TerminalStyle& style) {
    const ExactEnvironment environment;
    const Colours paint(style.colour);
    std::string out;
    for (std::size_t i = 0; i < report.curved.size(); ++i) {
        const std::string text = message(report.curved[i]), line = base::printable(report.meshes[i]) + ": " + text;
        if (!text.empty()) out += (report.curved[i].cells != 0 ? paint.bold(line) : line) + "\n";
    }
    if (style.wide) return out + wide_text(report, style);
    if (report.kernels.size() == 1) return out + kernel_text(report, style);
    const std::string verdict = verdict_sentence(report);
    constexpr std::size_t width = 100;
    out += (any_wrong(report) ? paint.bad(verdict) : paint.good(verdict)) + "\n";
    for (const std::string& line : verdict_details(report)) out += wrapped(line, width);
    out += "\n" + league_table(report, paint) + "\n" + wrapped(cases_sentence(report), width) +
           wrapped(oracle_line(report.oracles), width);
    for (const MeshLine& line : mesh_lines(report, style.command)) {
        const std::string text = wrapped(line.text, width, ", ");
        out += line.bad ? paint.bad(text) : text;
    }
    out += how_it_was_made(report) + "\n" + environment_line(report.environment) + "\n";
    const KernelResult& worst = report.kernels.front();
    const Witness* const w = worst_witness(worst);
    if (const std::string replay = w == nullptr ? "" : replay_command(report, worst, *w, style); !replay.empty())
        out += fmt::format("\nSee the worst kernel fail ({}, {}):\n    {}\n", w->reason, shows(*w), replay);
    return out +
           paint.dim("One kernel, family by family: --kernel NAME. All counts and witnesses: --wide, --html FILE.\n");
}

}  // namespace barycert
