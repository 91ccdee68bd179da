#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "barycert/audit_report.hpp"
#include "barycert/base/text.hpp"
#include "barycert/environment.hpp"
#include "barycert/report/audit/terminal_tables.hpp"
#include "barycert/report/common/terminal_text.hpp"

namespace barycert {

using namespace report;

namespace {

std::string findings(const Comparison& r) {
    std::string out;
    for (std::size_t f = 0; f < finding_count; ++f) {
        if (r.counts[f] != 0) out += (out.empty() ? "" : ", ") + std::string(finding_texts[f].name);
    }
    return out;
}

std::string coordinates(int count, auto at) {
    std::string decimal, hex;
    for (int axis = 0; axis < count; ++axis) {
        decimal += (axis == 0 ? "" : ", ") + base::shortest(at(axis));
        hex += (axis == 0 ? "" : ", ") + base::hexadecimal(at(axis));
    }
    return fmt::format("({})\n        ({})\n", decimal, hex);
}

/// Interpolating along auxiliary lines is barycentric interpolation, and ray casting the perspective-correct one, in
/// exact arithmetic.
std::string identity_line(const Replay& r) {
    const Case& c = r.witness.c;
    const char* const what = c.perspective                    ? "ray casting and interpolation of 1/w"
                             : c.simplex == Simplex::triangle ? "bilinear interpolation and ratios of signed areas"
                                                              : "trilinear interpolation and ratios of signed volumes";
    switch (r.identity) {
        case IdentityVerdict::holds:
            return fmt::format("    exactly, {} give the same weights here\n", what);
        case IdentityVerdict::fails:
            return fmt::format("    exactly, {} DIFFER here: a fault of barycert\n", what);
        case IdentityVerdict::undefined:
            break;
    }
    return "";
}

constexpr std::size_t witness_width = 100;

/// Two lines an answer, weights under each other, and a third for findings: one line would be too wide.
std::string answer_table(const Replay& replay, const std::vector<KernelAnswer>& answers, const Colours& paint) {
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
        for (std::size_t i = 0; i < n; ++i) line += fmt::format(" {:>{}}", cell(i), witness_width / 4 - 1);
        return line;
    };
    std::string out = paint.bold(row("", "kernel", "region", figures("error", "ulps", "value ulps"))) + "\n" +
                      paint.bold(weights([](std::size_t i) { return fmt::format("weight {}", i); })) + "\n";
    out += paint.good(row("=", right, name(exact.region), "value " + base::shortest(exact.value))) + "\n" +
           paint.good(weights([&](std::size_t i) { return base::shortest(exact.weights[i]); })) + "\n";
    for (const KernelAnswer& a : answers) {
        const Comparison& r = a.comparison;
        const bool wrong = r.wrong();
        const auto line = [&](const std::string& text) { out += (wrong ? paint.bad(text) : text) + "\n"; };
        line(row(a.kernel == replay.witness.kernel ? ">" : "", a.kernel, name(r.claimed),
                 figures(brief(r.relative_error), brief(a.worst_weight_ulp), brief(r.value_ulp))));
        line(weights([&](std::size_t i) {
            return !a.answered ? "-" : a.status != 0 ? "declared" : base::shortest(a.weights[i]);
        }));
        if (wrong) line("      " + findings(r));
        if (!a.detail.empty()) out += "      " + wrapped(base::printable(a.detail), witness_width - 6);
    }
    return out;
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

}  // namespace

std::string witness_text(const Replay& replay, const TerminalStyle& style, bool all) {
    const ExactEnvironment environment;
    const Colours paint(style.colour);
    const Witness& witness = replay.witness;
    const Case& c = witness.c;
    const OracleAnswer& answer = replay.exact;
    std::string title(name(c.simplex));
    if (c.perspective) title += " in a window (vertices x, y, w)";
    if (!witness.kernel.empty())
        title += ", " + (witness.reason.empty() ? "" : witness.reason + " of ") + witness.kernel;
    std::string out = paint.bold(base::printable(title)) + "\n";
    if (!witness.family.empty()) {
        out += fmt::format("    family {}, case {}, seed {}\n", base::printable(witness.family), witness.index,
                           witness.seed);
    }
    if (witness.cell >= 0) out += fmt::format("    cell {} of {}\n", witness.cell, base::printable(witness.mesh));
    for (int i = 0; i < vertex_count(c.simplex); ++i)
        out += fmt::format("    v{}  ", i) + coordinates(c.stride(), [&](int axis) { return c.vertex(i, axis); });
    out += "    p   " +
           coordinates(space_dimension(c.simplex), [&](int axis) { return c.point[static_cast<std::size_t>(axis)]; });
    out += "    exact: " + std::string(name(answer.region));
    if (answer.region == Region::boundary) out += fmt::format(" ({})", name(answer.feature));
    if (answer.region == Region::degenerate)
        out += c.perspective && replay.affine_dimension == 2
                   ? std::string(" (the ray through the point is parallel to the plane)")
                   : fmt::format(" (its vertices span {} dimensions)", replay.affine_dimension);
    out += "\n";

    const std::vector<KernelAnswer> answers = answers_to_show(replay, all);
    out += answer_table(replay, answers, paint);
    if (answers.size() < replay.answers.size())
        out += paint.dim(fmt::format("  {} other kernels: --all", replay.answers.size() - answers.size())) + "\n";
    return out + identity_line(replay);
}

std::string kernels_text(const std::vector<Kernel>& kernels) {
    std::string out;
    for (const Kernel& k : kernels) {
        out += fmt::format("{}\n    formula  {}\n    source   {}\n    fails    {}\n", k.name,
                           base::printable(k.formula), base::printable(k.source), k.fails);
        std::string promises = k.certifies ? "certifies every answer" : "no certificate";
        promises += k.declares_degenerate ? "; declares degenerate simplices" : "; never declares a simplex degenerate";
        if (k.rule == RegionRule::tolerant) promises += fmt::format("; inside if every weight >= -{}", k.tolerance);
        if (k.rule == RegionRule::own) promises += "; inside by a rule of its own";
        out += "    promise  " + promises + "\n";
    }
    return out;
}

std::string families_text(const std::vector<Family>& families) {
    std::string out;
    for (const Family& f : families) {
        std::string simplices;
        for (const Simplex s : f.simplices) simplices += (simplices.empty() ? "" : ", ") + std::string(name(s));
        out += fmt::format("{}\n    tests    {}\n    recipe   {}\n    for      {}{}{}\n", f.name, f.tests, f.parameters,
                           simplices, f.needs_mesh ? " of a mesh" : "",
                           f.perspective ? " with a depth at each vertex" : "");
    }
    return out;
}

}  // namespace barycert
