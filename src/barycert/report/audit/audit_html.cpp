#include <fmt/format.h>

#include "barycert/audit_report.hpp"
#include "barycert/base/text.hpp"
#include "barycert/environment.hpp"
#include "barycert/report/audit/audit_html_parts.hpp"
#include "barycert/report/audit/audit_words.hpp"
#include "barycert/report/audit/oracle_words.hpp"
#include "barycert/report/common/html_text.hpp"
#include "barycert/report/common/page.hpp"

namespace barycert {

using namespace report;

namespace {

/// What common/page_style.hpp has not.
constexpr std::string_view audit_style = R"(
.league{font-size:14px}.league th,.league td{padding-right:9px}
.league thead th{white-space:normal;vertical-align:bottom;font-size:13px;line-height:1.3}
.league tbody th{font-weight:600;white-space:nowrap}
.league th:first-child{position:sticky;left:0;background:var(--paper)}
.small-figures{display:grid;grid-template-columns:repeat(auto-fill,minmax(min(100%,236px),1fr));gap:14px 18px}
.small-figures figcaption{overflow-wrap:anywhere;color:var(--ink);line-height:1.3}
.small-figures small{color:var(--soft);font-size:13px}
.signs{display:grid;grid-template-columns:repeat(auto-fill,minmax(160px,1fr));gap:14px 16px;align-items:start}
.signs img{display:block;width:100%;max-width:256px;height:auto;border:1px solid var(--line)}
.signs figcaption{font-size:13px;line-height:1.3;overflow-wrap:anywhere}
.maps{display:grid;grid-template-columns:repeat(auto-fill,minmax(160px,1fr));gap:14px 18px;align-items:start}
.maps img{display:block;width:100%;height:auto;max-width:320px;image-rendering:pixelated;border:1px solid var(--line)}
.maps figcaption{overflow-wrap:anywhere;line-height:1.35}
.signs .exact img{outline:3px solid var(--good)}
.key span,.league thead span{white-space:nowrap}.key i{display:inline-block;width:12px;height:12px;margin:0 5px 0 14px;border:1px solid var(--line);vertical-align:-1px}
svg .dot{fill:var(--bar);fill-opacity:.75}svg .dot.front{fill:var(--good);fill-opacity:1}
svg .front{stroke:var(--good);stroke-width:1.6px}svg text.front{fill:var(--good);stroke:none;font-size:11px}
details{margin:4px 0}summary{cursor:pointer;color:var(--soft);font-size:14px}
dl{display:grid;grid-template-columns:max-content 1fr;gap:4px 18px;margin:8px 0}dt{color:var(--soft)}
dd{margin:0;overflow-wrap:anywhere}
@media (max-width:560px){.league tbody th{white-space:normal;overflow-wrap:anywhere;min-width:132px}
 dl{grid-template-columns:1fr;gap:0}dd{margin-bottom:6px}}
@media print{.league,.league thead th{font-size:9.5px}.league th,.league td{padding:2px 6px 2px 0}
 .league tbody th,td{white-space:normal;overflow-wrap:anywhere}.league tbody th{min-width:108px}.league th:first-child{position:static}}
)";

std::string verdict_html(const AuditReport& r, const TerminalStyle& style) {
    std::string out;
    for (std::size_t i = 0; i < r.curved.size(); ++i) out += curved_section(r.curved[i], r.meshes[i] + ": ");
    out += fmt::format("<section class=\"verdict {}\"><b>{}</b>", any_wrong(r) ? "bad" : "good",
                       html_escaped(verdict_sentence(r)));
    for (const std::string& line : verdict_details(r)) out += fmt::format("<p>{}</p>", html_escaped(line));
    out += "</section>\n<p>" + html_escaped(cases_sentence(r)) + ".</p>\n";
    out += "<p>" + html_escaped(oracle_line(r.oracles)) + ".</p>\n";
    for (const MeshLine& line : mesh_lines(r, style.command))
        out += fmt::format("<p{}>{}</p>\n", line.bad ? " class=\"bad\"" : "", html_escaped(line.text));
    return out;
}

std::string made_html(const AuditReport& r, const AuditPage& page) {
    std::string out = "<h2>How it was made</h2>\n<dl>\n";
    const auto line = [&](std::string_view what, const std::string& text) {
        out += fmt::format("<dt>{}</dt><dd>{}</dd>\n", what, text);
    };
    if (!page.command_line.empty())
        line("command", fmt::format("<code class=\"copy\">{}</code>", html_escaped(page.command_line)));
    line("run", html_escaped(how_it_was_made(r)));
    line("by", html_escaped(environment_line(r.environment)));
    line("on", fmt::format("a processor of {} threads", r.environment.hardware_threads));
    return out +
           "</dl>\n<p class=\"small\">The same seed gives the same cases on every machine; figures other than times do "
           "not depend on the number of threads.</p>\n";
}

}  // namespace

Result<std::string> audit_html(const AuditReport& r, const AuditPage& page) {
    const ExactEnvironment environment;
    const Result<std::string> signs = signs_html(page.signs);
    if (!signs) return signs.error();
    const Result<std::string> maps = maps_html(r, page.maps);
    if (!maps) return maps.error();
    const bool one = r.kernels.size() == 1;
    std::string out = page_head("barycert audit: " + verdict_sentence(r), audit_style);
    out += "<h1>barycert audit: floating-point kernels for barycentric weights, held against exact arithmetic</h1>\n" +
           verdict_html(r, page.style);
    if (one) {
        out += kernel_families_html(r, r.kernels.front());
    } else {
        out += league_html(r) + pareto_html(r);
    }
    out += *signs + *maps + error_histograms_html(r) + witnesses_html(r, page.style);
    if (!one) out += families_html(r);
    return out + others_html(page.others) + made_html(r, page) + page_foot("barycert " + r.environment.version, true);
}

}  // namespace barycert
