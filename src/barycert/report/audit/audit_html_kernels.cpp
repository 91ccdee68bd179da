// Tables, histograms and witnesses of the audit's HTML page.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "barycert/base/decades.hpp"
#include "barycert/base/text.hpp"
#include "barycert/report/audit/audit_html_cells.hpp"
#include "barycert/report/audit/audit_html_parts.hpp"
#include "barycert/report/audit/audit_words.hpp"
#include "barycert/report/common/html_text.hpp"
#include "barycert/report/common/picture.hpp"
#include "barycert/report/common/terminal_text.hpp"

namespace barycert::report {
namespace {

constexpr std::string_view statistics_heads =
    "<th scope=\"col\" class=\"n\">wrong, %</th>"
    "<th scope=\"col\" class=\"n\">inside called outside, %</th><th scope=\"col\" class=\"n\">outside called inside, "
    "%</th><th scope=\"col\" class=\"n\">no answer, %</th><th scope=\"col\" class=\"n\">error of 99 %</th><th "
    "scope=\"col\" class=\"n\">largest error</th>"
    "<th scope=\"col\" class=\"n\">largest, ulps</th><th scope=\"col\" class=\"n\">cases</th>";

std::string statistics_cells(const KernelStatistics& s) {
    return (s.cases == 0 ? number_cell("not run", -1) : share_cell({s.wrong_cases, s.cases}, true)) +
           share_cell(inside_called_outside(s), false) + share_cell(outside_called_inside(s), false) +
           share_cell(unanswered(s), false) + number_cell(usual_error(s), s.errors.within(0.99)) +
           number_cell(brief(s.errors.worst.value), s.errors.worst.value) +
           number_cell(brief(s.weight_ulp.value), s.weight_ulp.value) + count_cell(s.cases);
}

constexpr std::string_view statistics_legend =
    "<p class=\"small\">Wrong: a wrong sign, zero, region or declaration. Inside counts the boundary. Error: the "
    "largest of the weights of a case, relative to 1 or to the largest weight; \"error of 99 %\" is the power of ten "
    "that 99 % of the answers stay below. No answer: a crash, a hang or an exception, a weight that is not "
    "finite, or a simplex wrongly declared degenerate. Ulps: units in the last place of the exact weight, which are "
    "tiny for weights near zero.";

std::string error_bin_label(std::size_t bin) {
    if (bin == 0) return "no error";
    return bin == ErrorSizes::bins - 1 ? "no finite answer" : base::decade_label(bin);
}

constexpr double histogram_width = 236, histogram_height = 92, histogram_floor = 74, histogram_top = 6;

/// Bars on a logarithmic axis, for few cases with large errors are what matters.
std::string error_histogram(const KernelResult& k) {
    const ErrorSizes& e = k.total.errors;
    Picture svg(histogram_width, histogram_height, k.kernel.name + ": number of cases by the size of the error");
    const std::uint64_t most = *std::max_element(e.counts.begin(), e.counts.end());
    const double wide = histogram_width / static_cast<double>(ErrorSizes::bins);
    const double scale = (histogram_floor - histogram_top) / std::log10(2.0 * static_cast<double>(most) + 2);
    for (std::size_t b = 0; b < ErrorSizes::bins; ++b) {
        if (e.counts[b] == 0) continue;
        const double tall = std::max(scale * std::log10(2.0 * static_cast<double>(e.counts[b])), 1.0);
        svg.bar({wide * static_cast<double>(b) + 0.5, histogram_floor - tall}, wide - 1, tall,
                b >= 19 ? "bar bad" : "bar", fmt::format("{}: {} cases", error_bin_label(b), e.counts[b]));
    }
    svg.line({0, histogram_floor}, {histogram_width, histogram_floor}, "axis");
    const auto label = [&](std::size_t bin, const char* text, std::string_view style) {
        svg.text({wide * static_cast<double>(bin), histogram_height - 4}, text, style);
    };
    label(0, "0", "tick");
    label(3, "1e-16", "tick m");
    label(11, "1e-8", "tick m");
    label(19, "1", "tick m");
    label(ErrorSizes::bins, "none", "tick e");
    return std::move(svg).finish();
}

std::string witness_html(const AuditReport& report, const KernelResult& k, const Witness& w,
                         const TerminalStyle& style) {
    const std::string replay = html_escaped(replay_command(report, k, w, style));
    return fmt::format("<p><b>{}</b>: {}. Worst: {}: {}.</p>{}\n", html_escaped(w.reason),
                       html_escaped(finding_sentence(k, w)), html_escaped(place_of(w)), html_escaped(shows(w)),
                       replay.empty() ? "" : "<p><code class=\"copy\">" + replay + "</code></p>");
}

}  // namespace

std::string league_html(const AuditReport& r) {
    std::string out = fmt::format(
        "<h2>Kernels, worst first</h2>\n<div class=\"scroll\" tabindex=\"0\"><table class=\"sortable league "
        "kernels\"><thead>"
        "<tr><th scope=\"col\">kernel</th>{}<th scope=\"col\" class=\"n\">largest error on meshes</th>"
        "<th scope=\"col\" class=\"n\">ns</th></tr></thead>\n<tbody>\n",
        statistics_heads);
    for (const KernelResult& k : r.kernels)
        out += fmt::format("<tr><th scope=\"row\">{}</th>{}{}{}</tr>\n", html_name(k.kernel.name),
                           statistics_cells(k.total), number_cell(brief(worst_on_meshes(r, k)), worst_on_meshes(r, k)),
                           number_cell(brief_time(k.ns), k.ns));
    return fmt::format("{}</tbody></table></div>\n{} ns: median time of one evaluation.</p>\n", out, statistics_legend);
}

std::string kernel_families_html(const AuditReport& r, const KernelResult& k) {
    std::string out;
    const auto line = [&](std::string_view what, const std::string& text) {
        if (!text.empty()) out += fmt::format("<dt>{}</dt><dd>{}</dd>\n", what, html_escaped(text));
    };
    line("formula", k.kernel.formula);
    line("source", k.kernel.source);
    line("fails", k.kernel.fails);
    if (k.ns > 0) line("time", brief_time(k.ns) + " ns an evaluation");
    out = "<dl>\n" + out + "</dl>\n";
    out += fmt::format(
        "<h2>Families of cases</h2>\n<div class=\"scroll\" tabindex=\"0\"><table class=\"sortable league\"><thead><tr>"
        "<th scope=\"col\">family</th>{}</tr></thead>\n<tbody>\n",
        statistics_heads);
    for (const FamilyResult* f : families_worst_first(k))
        out += fmt::format("<tr><th scope=\"row\" title=\"{}\">{}</th>{}</tr>\n",
                           html_escaped(r.families[f->family].tests), html_name(r.families[f->family].name),
                           statistics_cells(f->statistics));
    return fmt::format("{}</tbody></table></div>\n{}</p>\n", out, statistics_legend);
}

std::string families_html(const AuditReport& r) {
    std::string out =
        "<h2>Families of cases</h2>\n<div class=\"scroll\" tabindex=\"0\"><table class=\"sortable\"><thead><tr>"
        "<th scope=\"col\">family</th><th scope=\"col\">simplex</th><th scope=\"col\" class=\"n\">cases</th>"
        "<th scope=\"col\" class=\"n\">kernels without a finding</th><th scope=\"col\" class=\"n\">median wrong, %</th>"
        "<th scope=\"col\" class=\"n\">worst wrong, %</th><th scope=\"col\">worst kernel</th></tr></thead>\n<tbody>\n";
    for (const FamilyLine& f : family_lines(r))
        out += fmt::format("<tr><th scope=\"row\">{}</th><td>{}</td>{}{}{}{}<td>{}</td></tr>\n", html_name(f.family),
                           f.simplex, count_cell(f.cases),
                           number_cell(fmt::format("{} of {}", f.clean, f.kernels),
                                       static_cast<double>(f.clean) / static_cast<double>(f.kernels)),
                           share_cell({f.median, f.cases}, false), share_cell({f.worst, f.cases}, false),
                           html_name(f.worst_kernel));
    return out + "</tbody></table></div>\n";
}

std::string error_histograms_html(const AuditReport& r) {
    std::string out =
        "<h2>Sizes of errors</h2>\n<p class=\"small\">Cases by the largest error of a weight, in powers of ten from no "
        "error (left) to 100 and more, and without a finite answer (right); heights are logarithmic. Red: errors of 1 "
        "and more, and no answer. Simplices that are degenerate are not counted.</p>\n<div class=\"small-figures\">\n";
    for (const KernelResult& k : r.kernels) {
        if (k.total.errors.total() == 0) continue;
        out += fmt::format("<figure><figcaption>{}<br/><small>99 %: {}, largest {}</small></figcaption>{}</figure>\n",
                           html_escaped(k.kernel.name), html_escaped(usual_error(k.total)),
                           brief(k.total.errors.worst.value), error_histogram(k));
    }
    return out + "</div>\n";
}

std::string witnesses_html(const AuditReport& r, const TerminalStyle& style) {
    std::string out =
        "<h2>Witnesses</h2>\n<p class=\"small\">The worst case of each finding, and the command that shows the "
        "kernel's "
        "answer beside the exact one.</p>\n";
    for (const KernelResult& k : r.kernels) {
        out += fmt::format("<section class=\"card\"><h3>{}</h3>\n", html_escaped(k.kernel.name));
        if (!k.kernel.fails.empty()) out += fmt::format("<p class=\"small\">{}</p>\n", html_escaped(k.kernel.fails));
        if (!k.kernel.note.empty()) out += fmt::format("<p>{}</p>\n", html_escaped(k.kernel.note));
        if (k.total.not_run != 0) out += fmt::format("<p>Given up: {} cases were not run.</p>\n", k.total.not_run);
        if (k.witnesses.empty() && k.total.not_run == 0)
            out += "<p>No witness: every weight and value is correctly rounded.</p>\n";
        const bool fold = r.kernels.size() > 1 && k.witnesses.size() > 1;
        for (std::size_t i = 0; i < k.witnesses.size(); ++i) {
            if (i == 1 && fold) out += fmt::format("<details><summary>{} more</summary>\n", k.witnesses.size() - 1);
            out += witness_html(r, k, k.witnesses[i], style);
        }
        out += fold ? "</details></section>\n" : "</section>\n";
    }
    return out;
}

}  // namespace barycert::report
