#include <algorithm>

#include "barycert/audit_report.hpp"
#include "barycert/base/text.hpp"
#include "barycert/environment.hpp"
#include "barycert/report/audit/oracle_words.hpp"
#include "barycert/report/common/terminal_text.hpp"

namespace barycert {

using namespace report;

namespace {

std::string number_list(const std::vector<Mesh::Index>& numbers) {
    if (numbers.empty()) return "none";
    std::string text;
    for (std::size_t i = 0; i < numbers.size() && i < 8; ++i) text += (i == 0 ? "" : " ") + std::to_string(numbers[i]);
    return numbers.size() > 8 ? text + fmt::format(" and {} more", numbers.size() - 8) : text;
}

std::string claim_witness_text(ClaimFault fault, const ClaimWitness& w, int dimension) {
    std::string at;
    for (int axis = 0; axis < dimension; ++axis)
        at += (axis == 0 ? "" : ", ") + base::shortest(w.point[static_cast<std::size_t>(axis)]);
    return fmt::format("    {}: ({}), made on the {} of nodes {}\n        held by {}, claimed by {}\n", name(fault), at,
                       name(w.feature), number_list(w.nodes), number_list(w.holders), number_list(w.claimants));
}

}  // namespace

std::string gaps_text(const GapsReport& report, const TerminalStyle& style) {
    const ExactEnvironment environment;
    const Colours paint(style.colour);
    std::string out = curved_lines(report.curved, paint) + environment_line(report.environment) + "\n";
    const char* const known = report.verdict == Verdict::certified       ? "certified to be a partition"
                              : report.verdict == Verdict::not_certified ? "NOT certified to be a partition"
                                                                         : "not checked";
    out += fmt::format("{}, {}{}; seed {}, {} points on {} each, {} threads, {:.1f} s\n", base::printable(report.mesh),
                       known, for_straight_sides(report.curved), report.seed, report.count,
                       report.dimension == 2 ? "edges and vertices" : "faces, edges and vertices", report.threads,
                       report.seconds);
    out += oracle_line(report.oracles) + "\n\n";
    std::size_t width = 16;
    for (const ClaimResult& r : report.results) width = std::max(width, r.kernel.size());
    const auto row = [&](const auto&... cells) {
        return fmt::format("{:<{}}  {:<8} {:>6} {:>6} {:>7} {:>6} {:>6} {:>7} {:>7}", cells...);
    };
    out +=
        paint.bold(row("kernel", width, "rule", "inside", "gaps", "several", "wrong", "first", "outside", "claimed")) +
        "\n";
    for (const ClaimResult& r : report.results) {
        const ClaimCounts c = r.total();
        const auto n = [&](ClaimFault f) { return brief_count(c.of(f)); };
        const std::string line =
            row(r.kernel.empty() ? "exact arithmetic" : r.kernel, width, name(r.rule), brief_count(c.inside),
                n(ClaimFault::gap), n(ClaimFault::several), n(ClaimFault::wrong), n(ClaimFault::wrong_first),
                brief_count(c.outside), n(ClaimFault::outside_claimed));
        out += line + "\n";
    }
    out += paint.dim(fmt::format(
        "rule: a cell claims a point if all weights are > 0 (strict), >= 0 (exact), >= -{} (tolerant), or by the\n"
        "kernel's own rule. inside: points that a cell holds, exactly; of these gaps: no cell claims it; several:\n"
        "more than one does (right where it lies on what they share: see exact arithmetic); wrong: one that does not\n"
        "hold it; first: the lowest of those that claim it does not hold it. outside: points that no cell holds, of\n"
        "these claimed: by a cell.\n",
        base::shortest(report.tolerance)));
    for (const ClaimResult& r : report.results) {
        if (r.unanswered == 0 || r.rule != ClaimRule::exact) continue;  // the same under each rule
        out += fmt::format(
            "{} gave no answer to {} pairs of point and cell (it ended, took too long, or was no longer asked for\n"
            "that): the cell does not claim the point then.\n",
            paint.bold(r.kernel), r.unanswered);
    }
    std::string witnesses;
    for (const ClaimResult& r : report.results) {
        // The other rules have such points by their nature; the JSON names them.
        if (r.kernel.empty() || r.rule == ClaimRule::strict || r.rule == ClaimRule::tolerant) continue;
        std::string own;
        for (const auto& [fault, witness] : r.witnesses) {
            if (fault != ClaimFault::several && fault != ClaimFault::wrong_first)
                own += claim_witness_text(fault, witness, report.dimension);
        }
        if (!own.empty()) witnesses += fmt::format("{}, {}\n", paint.bold(r.kernel), name(r.rule)) + own;
    }
    if (!witnesses.empty()) out += "\n" + paint.bold("The first point of each fault:") + "\n" + witnesses;
    return out;
}

}  // namespace barycert
