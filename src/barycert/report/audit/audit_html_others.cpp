// What `./run flags` and `./run systems` measured, on the audit's HTML page.

#include <fmt/format.h>

#include <algorithm>

#include "barycert/base/text.hpp"
#include "barycert/report/audit/audit_html_cells.hpp"
#include "barycert/report/audit/audit_html_parts.hpp"
#include "barycert/report/common/terminal_text.hpp"

namespace barycert::report {
namespace {

std::string escaped_line(std::string_view text) {
    return html_escaped(base::printable(text));
}

/// Flags begin with hyphens, at which lines would be broken.
std::string unbroken_words(std::string_view text) {
    std::string out;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find(' ', at), text.size());
        out += fmt::format("{}<span>{}</span>", at == 0 ? "" : " ", escaped_line(text.substr(at, end - at)));
        at = end + 1;
    }
    return out;
}

bool column_changes(const FlagsMatrix& m, std::size_t column) {
    return std::any_of(m.rows.begin(), m.rows.end(),
                       [&](const FlagsMatrix::Row& row) { return row.cells[column].changed != 0; });
}

/// Columns in which nothing changes are left out.
std::string flags_table(const FlagsMatrix& m, auto part, bool red) {
    std::string out =
        "<div class=\"scroll\" tabindex=\"0\"><table class=\"sortable league\"><thead><tr><th scope=\"col\">formula"
        "</th>";
    for (std::size_t c = 0; c < m.columns.size(); ++c) {
        if (column_changes(m, c))
            out += fmt::format("<th scope=\"col\" class=\"n\" title=\"{}\">{}</th>", escaped_line(m.columns[c].flags),
                               unbroken_words(m.columns[c].compiler + " " + m.columns[c].label));
    }
    out += "</tr></thead>\n<tbody>\n";
    for (const FlagsMatrix::Row& row : m.rows) {
        out += fmt::format("<tr><th scope=\"row\">{}</th>", html_name(base::printable(row.kernel)));
        for (std::size_t c = 0; c < m.columns.size(); ++c) {
            if (column_changes(m, c)) out += share_cell({part(row.cells[c]), row.cells[c].cases}, red);
        }
        out += "</tr>\n";
    }
    return out + "</tbody></table></div>\n";
}

std::string flags_html(const FlagsMatrix& m) {
    std::string same, compilers;
    for (std::size_t c = 0; c < m.columns.size(); ++c) {
        if (!column_changes(m, c))
            same += fmt::format("{}{} {}", same.empty() ? "" : "; ", m.columns[c].compiler, m.columns[c].label);
    }
    for (const std::string& compiler : m.compilers) compilers += (compilers.empty() ? "" : "; ") + compiler;
    std::string out = fmt::format(
        "<h2>Formulas under compiler flags</h2>\n<p class=\"small\">From <code>./run flags</code>: {} cases of each of "
        "{} families, seed {}. {}. In per cent of the cases of a formula.</p>\n",
        m.count, m.families, m.seed, escaped_line(compilers));
    if (!same.empty()) out += fmt::format("<p class=\"small\">No answer changes under: {}.</p>\n", escaped_line(same));
    if (m.rows.empty() || m.columns.empty()) return out;
    out += "<h3>Answers that change by a bit or more</h3>\n" +
           flags_table(
               m, [](const FlagsMatrix::Cell& c) { return c.changed; }, false);
    return out + "<h3>Answers that get wrong</h3>\n" +
           flags_table(
               m, [](const FlagsMatrix::Cell& c) { return c.newly_wrong; }, true);
}

std::string standing_row(const SystemsLeague::Standing& s) {
    const bool run = s.not_run.empty();
    const std::string text_cell = run ? s.version : s.not_run;
    std::string out =
        fmt::format("<tr><th scope=\"row\">{}</th><td>{}</td>", escaped_line(s.name), escaped_line(text_cell));
    out += share_cell({s.inside_called_outside, s.inside}, true) +
           share_cell({s.outside_called_inside, s.outside}, true) +
           share_cell({s.wrong_owner.value_or(0), s.wrong_owner ? s.inside - s.inside_called_outside : 0}, true);
    // No share: an error of rounding is no wrong answer.
    const auto figure_cell = [&](const std::optional<double>& x, bool time) {
        return number_cell(!x || !run ? "-" : time ? brief_time(*x) : brief(*x), x && run ? *x : -1);
    };
    return out + figure_cell(s.points == 0 ? std::nullopt : s.max_value_error, false) + figure_cell(s.ns, true) +
           "</tr>\n";
}

std::string systems_html(const SystemsLeague& league) {
    std::string out = fmt::format(
        "<h2>Systems: point location and interpolation</h2>\n<p class=\"small\">From <code>./run systems</code>: {} "
        "points of each set on each mesh, seed {}, held against the exact owners and values. In per cent of the points "
        "inside, outside, and of those inside that were found. Error: of a value, in parts of the field's range. ns: "
        "median time of a random point.</p>\n",
        league.count, league.seed);
    for (const int dimension : {3, 2}) {
        std::string rows, failures;
        for (const SystemsLeague::Standing& s : league.standings) {
            if (s.dimension != dimension) continue;
            rows += standing_row(s);
            for (const std::string& failure : s.failures)
                failures += fmt::format("<li>{}, {}</li>\n", escaped_line(s.name), escaped_line(failure));
        }
        if (rows.empty()) continue;
        out += fmt::format(
            "<h3>{}</h3>\n<div class=\"scroll\" tabindex=\"0\"><table class=\"sortable league\"><thead><tr><th "
            "scope=\"col\">system</th><th scope=\"col\">version</th><th scope=\"col\" class=\"n\">inside called "
            "outside, %</th><th scope=\"col\" class=\"n\">outside called inside, %</th><th scope=\"col\" class=\"n\">"
            "owner does not contain the point, %</th><th scope=\"col\" class=\"n\">largest error</th><th scope=\"col\" "
            "class=\"n\">ns</th></tr></thead>\n<tbody>\n{}</tbody></table></div>\n",
            dimension == 3 ? "On meshes of tetrahedra" : "On meshes of triangles", rows);
        if (!failures.empty())
            out += "<p class=\"small\">Without an answer, and not counted:</p>\n<ul class=\"small\">\n" + failures +
                   "</ul>\n";
    }
    return out;
}

}  // namespace

std::string others_html(const std::vector<OtherResults>& others) {
    std::string out;
    for (const OtherResults& o : others) {
        if (const auto* const flags = std::get_if<FlagsMatrix>(&o)) out += flags_html(*flags);
        if (const auto* const systems = std::get_if<SystemsLeague>(&o)) out += systems_html(*systems);
    }
    return out;
}

}  // namespace barycert::report
