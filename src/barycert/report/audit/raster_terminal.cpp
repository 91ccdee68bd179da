#include "barycert/audit_report.hpp"

#include <algorithm>

#include "barycert/base/text.hpp"
#include "barycert/environment.hpp"
#include "barycert/report/common/terminal_text.hpp"

namespace barycert {

using namespace report;

std::string drift_text(const DriftReport& report, const TerminalStyle& style) {
    const ExactEnvironment environment;
    const Colours paint(style.colour);
    std::string out = fmt::format(
        "seed {}, {} cases per size. Largest error of the value, in ulps of the exact one, by the size of the triangle "
        "in pixels.\n\n",
        report.seed, report.count);
    std::size_t width = 6;
    for (const DriftCurve& curve : report.curves) width = std::max(width, curve.kernel.name.size());
    std::string head = fmt::format("{:<{}}", "kernel", width);
    if (!report.curves.empty()) {
        for (const DriftPoint& p : report.curves.front().points) head += fmt::format(" {:>9}", p.size);
    }
    out += paint.bold(head) + "\n";
    for (const DriftCurve& curve : report.curves) {
        out += fmt::format("{:<{}}", base::printable(curve.kernel.name), width);
        std::uint64_t not_finite = 0;
        for (const DriftPoint& p : curve.points) {
            out += fmt::format(" {:>9}", p.cases == 0 ? "-" : brief(p.worst_ulp));
            not_finite += p.not_finite;
        }
        out += (not_finite == 0 ? "" : fmt::format("  and {} cases without a finite value", not_finite)) + "\n";
    }
    return out;
}

std::string texels_text(const std::vector<TexelResult>& results, const TerminalStyle& style) {
    const ExactEnvironment environment;
    const Colours paint(style.colour);
    const auto row = [](const auto&... cells) { return fmt::format("{:<22} {:<7} {:>7} {:>9} {:>9} {:>9}", cells...); };
    std::string out = paint.bold(row("rule", "wrap", "cases", "past", "before", "wrong")) + "\n" +
                      paint.bold(row("", "", "", "the end", "the start", "texel")) + "\n";
    std::string below;
    for (const TexelResult& r : results) {
        const bool clean = r.counts[0] + r.counts[1] + r.counts[2] == 0;
        const std::string line = row(r.rule.name, name(r.rule.wrap), brief_count(r.cases), brief_count(r.counts[0]),
                                     brief_count(r.counts[1]), brief_count(r.counts[2]));
        out += (clean ? paint.good(line) : r.counts[0] + r.counts[1] != 0 ? paint.bad(line) : line) + "\n";
        below += paint.bold(r.rule.name) + ": " + r.rule.formula + "\n";
        for (std::size_t f = 0; f < r.counts.size(); ++f) {
            const TexelWitness& w = r.witnesses[f];
            if (r.counts[f] == 0) continue;
            below += fmt::format("    {}: u = {} ({}) in a row of {}: texel {}, exactly {}\n", texel_finding_names[f],
                                 base::shortest(w.u), base::hexadecimal(w.u), w.size, w.texel, w.exact);
        }
        if (clean) below += "    no finding\n";
    }
    return out + "\n" + below;
}

}  // namespace barycert
