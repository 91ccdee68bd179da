// One witness, with the exact answer and those of kernels; the catalogue and the families.

#include "barycert/witness.hpp"

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "app/report/common/document.hpp"
#include "app/report/common/terminal_text.hpp"
#include "barycert/audit_report.hpp"
#include "barycert/environment.hpp"
#include "barycert/finding.hpp"
#include "barycert/oracle.hpp"
#include "barycert/report.hpp"
#include "barycert/simplex.hpp"
#include "core/base/text.hpp"

namespace barycert {

using namespace report;

namespace {

/// In decimal, and below it as it is exactly.
void tell_coordinates(Document& d, const std::string& what, const double* at, int count) {
    d.say(fmt::format("    {:<3} ({})", what, coordinates(at, count)));
    d.say(fmt::format("        ({})", coordinates(at, count, base::hexadecimal)));
}

/// The case: where it comes from, its coordinates, what is exactly so.
void tell_case(Document& d, const Replay& replay) {
    const Witness& w = replay.witness;
    const Case& c = w.c;
    const OracleAnswer& answer = replay.exact;
    std::string title(name(c.simplex));
    if (c.perspective) title += " in a window (vertices x, y, w)";
    if (!w.kernel.empty()) title += ", " + (w.reason.empty() ? "" : w.reason + " of ") + w.kernel;
    d.say(title, Tone::strong);
    if (!w.family.empty()) d.say(fmt::format("    family {}, case {}, seed {}", w.family, w.index, w.seed));
    if (w.cell >= 0) d.say(fmt::format("    cell {} of {}", w.cell, w.mesh));
    for (int i = 0; i < vertex_count(c.simplex); ++i)
        tell_coordinates(d, fmt::format("v{}", i), c.vertices.data() + c.stride() * i, c.stride());
    tell_coordinates(d, "p", c.point.data(), space_dimension(c.simplex));
    std::string exact = fmt::format("    exact: {}", name(answer.region));
    if (answer.region == Region::boundary) exact += fmt::format(" ({})", name(answer.feature));
    if (answer.region == Region::degenerate)
        exact += c.perspective && replay.affine_dimension == 2
                     ? std::string(" (the ray through the point is parallel to the plane)")
                     : fmt::format(" (its vertices span {} dimensions)", replay.affine_dimension);
    d.say(exact);
}

/// Two lines an answer, weights under each other, and a third for findings: one line would be too wide.
void tell_answers(Document& d, const Replay& replay, const std::vector<KernelAnswer>& answers) {
    const OracleAnswer& exact = replay.exact;
    const auto n = static_cast<std::size_t>(vertex_count(replay.witness.c.simplex));
    constexpr std::string_view right = "exact, correctly rounded";
    std::size_t width = right.size();
    for (const KernelAnswer& a : answers) width = std::max(width, a.kernel.size());
    const auto row = [&](std::string_view mark, std::string_view kernel, std::string_view region,
                         const std::string& figures) {
        return fmt::format("{:1} {:<{}}  {:<10}  {}", mark, kernel, width, region, figures);
    };
    const auto figures = [](std::string_view error, std::string_view ulps, std::string_view value) {
        return fmt::format("{:>9} {:>9} {:>10}", error, ulps, value);
    };
    // A double takes at most 24 characters, and there are at most four weights.
    const auto weights = [&](auto cell) {
        std::string line;
        for (std::size_t i = 0; i < n; ++i) line += fmt::format(" {:>24}", cell(i));
        return line;
    };
    d.say(row("", "kernel", "region", figures("error", "ulps", "value ulps")), Tone::strong);
    d.say(weights([](std::size_t i) { return fmt::format("weight {}", i); }), Tone::strong);
    d.say(row("=", right, name(exact.region), "value " + base::shortest(exact.value)), Tone::good);
    d.say(weights([&](std::size_t i) { return base::shortest(exact.weights[i]); }), Tone::good);
    for (const KernelAnswer& a : answers) {
        const Comparison& r = a.comparison;
        const Tone tone = r.wrong() ? Tone::bad : Tone::plain;
        d.say(row(a.kernel == replay.witness.kernel ? ">" : "", a.kernel, name(r.claimed),
                  figures(brief(r.relative_error), brief(r.worst_weight_ulp()), brief(r.value_ulp))),
              tone);
        d.say(weights([&](std::size_t i) {
                  return !a.answered ? "-" : a.status != 0 ? "declared" : base::shortest(a.weights[i]);
              }),
              tone);
        const std::string found = joined(finding_texts, ", ", [&](const FindingText& text) {
            return r.counts[static_cast<std::size_t>(*finding_named(text.name))] == 0 ? "" : text.name;
        });
        if (!found.empty()) d.say("      " + found, tone);
        if (!a.detail.empty()) d.say("      " + a.detail, Tone::plain, For::all, Breaks::words);
    }
}

/// The kernel in question first; without `all` nothing else, if there is one.
std::vector<KernelAnswer> answers_to_show(const Replay& replay, bool all) {
    std::vector<KernelAnswer> list = replay.answers;
    const auto others = std::stable_partition(list.begin(), list.end(), [&](const KernelAnswer& a) {
        return base::glob_match(replay.witness.kernel, a.kernel);
    });
    if (!all && others != list.begin()) list.erase(others, list.end());
    return list;
}

/// In exact arithmetic interpolation along auxiliary lines is barycentric, and ray casting perspective-correct.
void tell_identity(Document& d, const Replay& r) {
    if (r.identity == IdentityVerdict::undefined) return;
    const Case& c = r.witness.c;
    const char* const what = c.perspective                    ? "ray casting and interpolation of 1/w"
                             : c.simplex == Simplex::triangle ? "bilinear interpolation and ratios of signed areas"
                                                              : "trilinear interpolation and ratios of signed volumes";
    d.say(fmt::format("    exactly, {} {} here{}", what,
                      r.identity == IdentityVerdict::holds ? "give the same weights" : "DIFFER",
                      r.identity == IdentityVerdict::holds ? "" : ": a fault of barycert"));
}

}  // namespace

std::string witness_text(const Replay& replay, const TerminalStyle& style, bool all) {
    const ExactEnvironment environment;
    Document d;
    tell_case(d, replay);
    const std::vector<KernelAnswer> answers = answers_to_show(replay, all);
    tell_answers(d, replay, answers);
    if (answers.size() < replay.answers.size())
        d.say(fmt::format("  {} other kernels: --all", replay.answers.size() - answers.size()), Tone::soft);
    tell_identity(d, replay);
    return terminal_text(d, style.colour);
}

}  // namespace barycert
