#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "barycert/base/text.hpp"
#include "barycert/environment.hpp"
#include "barycert/report.hpp"
#include "barycert/report/common/html_text.hpp"
#include "barycert/report/common/page.hpp"
#include "barycert/report/common/terminal_text.hpp"
#include "barycert/report/verify/verify_words.hpp"

namespace barycert {

using namespace report;

namespace {

std::string text(std::string_view s) {
    return html_escaped(s);
}

std::string verdict_section(const VerifyReport& s) {
    const Verdicts& v = s.verdicts;
    return fmt::format("<section class=\"verdict {}\"><b>{}</b><p>{} rows: {}.</p></section>\n",
                       v.wrong() == 0 ? "good" : "bad", text(verdict_sentence(s)), v.rows, places_sentence(v));
}

std::string verdict_rows(const VerifyReport& s) {
    std::string out =
        "<div class=\"scroll\"><table><tr><th>row is</th><th class=\"n\">rows</th><th class=\"n\">%</th>"
        "<th>meaning</th></tr>\n";
    for (const VerdictLine& line : verdict_table(s)) {
        const bool bad = line.name != name(RowVerdict::right) && line.count != 0;
        out += fmt::format("<tr><td>{}</td><td class=\"n{}\">{}</td><td class=\"n\">{}</td><td>{}</td></tr>\n",
                           text(line.name), bad ? " bad" : "", line.count, percent(line.count, s.verdicts.rows),
                           text(line.what));
    }
    return out + "</table></div>\n";
}

std::string value_rows(const VerifyReport& s) {
    if (s.columns.empty()) return "<p>The results have no values to compare.</p>\n";
    std::string out = "<table class=\"stack\"><tr>";
    constexpr std::array heads{"value", "column", "compared", "bits right, %", "max ulps", "max error", "wrong"};
    for (std::size_t i = 0; i < heads.size(); ++i)
        out += fmt::format("<th scope=\"col\" class=\"h{}\">{}</th>", i < 2 ? "" : " n", heads[i]);
    out += "</tr>\n";
    for (std::size_t c = 0; c < s.columns.size(); ++c) {
        const ValueErrors& e = s.verdicts.columns[c];
        const std::uint64_t wrong = e.over + e.missing + e.spurious;
        out += fmt::format("<tr><td><b>{}</b></td><td data-l=\"{}\">{}</td>", text(s.columns[c]), heads[1],
                           text(s.found_in[c]));
        const std::array figures{std::to_string(e.values), percent(e.identical, e.values), brief(e.max_ulps),
                                 brief(e.max_relative), std::to_string(wrong)};
        for (std::size_t i = 0; i < figures.size(); ++i)
            out += fmt::format("<td class=\"n{}\" data-l=\"{}\">{}</td>",
                               i + 1 == figures.size() && wrong != 0 ? " bad" : "", heads[i + 2], figures[i]);
        out += "</tr>\n";
    }
    out += "</table>\n";
    for (const std::string& sentence : scale_sentences(s))
        out += fmt::format("<p class=\"small\">{}.</p>\n", text(sentence));
    return out;
}

std::string histograms(const VerifyReport& s) {
    std::string out;
    for (std::size_t c = 0; c < s.columns.size(); ++c) {
        const ValueErrors& e = s.verdicts.columns[c];
        if (e.values == 0) continue;
        const auto [first, last] = used_bins(e);
        std::uint64_t most = 1;
        for (std::size_t b = first; b <= last; ++b) most = std::max(most, e.by_relative[b]);
        out += fmt::format("<h3>Errors of {}</h3><table class=\"bars\">\n", text(s.columns[c]));
        for (std::size_t b = first; b <= last; ++b) {
            // From 10^(b - 19) on all are above the tolerance if that is less.
            const bool bad = b != 0 && (s.exact || std::pow(10.0, static_cast<double>(b) - 19) >= s.tolerance);
            const double width = 100 * static_cast<double>(e.by_relative[b]) / static_cast<double>(most);
            out += fmt::format("<tr><td class=\"n\">{}</td><td class=\"n\">{}</td><td class=\"w\">", text(bin_label(b)),
                               e.by_relative[b]);
            if (e.by_relative[b] != 0)
                out += fmt::format("<span class=\"bar{}\" style=\"width:{:.2f}%\"></span>", bad ? " bad" : "", width);
            out += "</td></tr>\n";
        }
        out += "</table>\n";
    }
    return out;
}

std::string examples(const VerifyReport& s) {
    std::string out;
    for (const WrongRow& row : s.verdicts.examples)
        out += fmt::format("<div class=\"card\"><p><b>{}</b>, row {} (from 0): {}</p><p><code>{}</code></p></div>\n",
                           name(row.verdict), row.row, text(example_sentence(s, row)), text(example_command(s, row)));
    return out.empty() ? out : "<h2>Worst rows</h2>\n" + out;
}

std::string notes(const VerifyReport& s) {
    std::string out = fmt::format("<p>{} cells, {} nodes: {}.</p>\n", s.cells, s.nodes, text(mesh_sentence(s)));
    for (const Note& note : s.notes)
        out += fmt::format("<p>{}: {}{}</p>\n", name(note.kind), text(note.text),
                           note.file.empty() ? "" : " (" + text(note.file) + ")");
    return "<h2>Mesh and files</h2>\n" + out;
}

}  // namespace

std::string verify_html(const VerifyReport& s, const Environment& environment) {
    const ExactEnvironment exact;
    std::string out = page_head("barycert verify: " + s.results) +
                      fmt::format("<h1>barycert verify: {} on {}</h1>\n", text(s.results), text(s.mesh));
    out += curved_section(s.curved) + verdict_section(s) + verdict_rows(s) + "<h2>Values</h2>\n" + value_rows(s) +
           histograms(s) + examples(s) + notes(s);
    return out + page_foot(environment_line(environment));
}

}  // namespace barycert
