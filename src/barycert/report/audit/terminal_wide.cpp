#include <fmt/format.h>

#include <algorithm>

#include "barycert/report/audit/audit_words.hpp"
#include "barycert/report/audit/oracle_words.hpp"
#include "barycert/report/audit/terminal_tables.hpp"
#include "barycert/report/common/terminal_text.hpp"

namespace barycert::report {
namespace {

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
        const std::string line =
            row(k.kernel.name, width, brief_count(s.cases), percent({s.wrong_cases, s.cases}),
                percent(wrong_on_meshes(report, k)), n(Finding::opposite_sign), n(Finding::false_zero),
                n(Finding::false_nonzero), n(Finding::not_finite), n(Finding::false_inside), n(Finding::false_outside),
                n(Finding::false_declaration), n(Finding::missed_degenerate), brief(s.p999_weight_ulp()),
                brief(s.weight_ulp.value), brief(s.p999_value_ulp()), brief_time(k.ns));
        out += (perfect(s) ? paint.good(line) : line) + "\n";
        for (const std::string& beside : {incidents(s), broken_certificates(s)}) {
            if (!beside.empty()) out += paint.bad("    " + beside) + "\n";
        }
    }
    out += paint.dim(
        "wrong %: share of cases with a finding, over all families and over the families mesh.*. A finding is a wrong "
        "sign, zero, region or declaration.\nulps: error of a weight in ulps of the correctly rounded weight; value: "
        "the same for the interpolated value. Signs, zeros and not\nfinite count weights; inside, outside and "
        "degenerate count cases.  "
        "ns: median time of one evaluation, over blocks of cases.\n");
    return out;
}

std::string family_table(const AuditReport& report, const Colours& paint) {
    const std::vector<FamilyLine> lines = family_lines(report);
    std::size_t width = 6;
    for (const FamilyLine& f : lines) width = std::max(width, f.family.size());
    const auto line = [&](const auto&... cells) {
        return fmt::format("{:<{}}  {:<11} {:>7} {:>7} {:>9} {:>8}  {}", cells...);
    };
    std::string out =
        paint.bold(line("family", width, "simplex", "cases", "clean", "median %", "worst %", "worst kernel")) + "\n";
    for (const FamilyLine& f : lines) {
        out += line(f.family, width, f.simplex, brief_count(f.cases), fmt::format("{}/{}", f.clean, f.kernels),
                    percent({f.median, f.cases}), percent({f.worst, f.cases}), f.worst_kernel) +
               "\n";
    }
    return out + paint.dim(
                     "clean: kernels without a finding / all kernels. median, worst: share of wrong cases, over the "
                     "kernels.\n");
}

std::string witness_list(const AuditReport& report, const TerminalStyle& style, const Colours& paint) {
    std::string out;
    for (const KernelResult& k : report.kernels) {
        const Witness* w = worst_witness(k);
        if (w == nullptr) {
            out += paint.bold(k.kernel.name) + (k.total.not_run != 0
                                                    ? ": no witness\n"
                                                    : ": no witness, every weight and value is correctly rounded\n");
            continue;
        }
        out += fmt::format("{}: {} in {} ({})\n", paint.bold(k.kernel.name), w->reason, place_of(*w), shows(*w));
        if (const std::string replay = replay_command(report, k, *w, style); !replay.empty())
            out += fmt::format("    {}\n", replay);
    }
    return out;
}

}  // namespace

std::string wide_text(const AuditReport& report, const TerminalStyle& style) {
    const Colours paint(style.colour);
    std::string out = environment_line(report.environment) + "\n";
    out += fmt::format("{}\n{} kernels, {} families, {} cases in all, exactly {}\n", how_it_was_made(report),
                       report.kernels.size(), report.families.size(), report.cases, regions_text(report));
    for (const MeshLine& line : mesh_lines(report, style.command))
        out += (line.bad ? paint.bad(line.text) : line.text) + "\n";
    out += oracle_line(report.oracles) + "\n\n";
    out += kernel_table(report, paint) + "\n" + family_table(report, paint) + "\n";
    out += paint.bold("Worst witness of each kernel, and the command that replays it:") + "\n" +
           witness_list(report, style, paint);
    return out;
}

}  // namespace barycert::report
