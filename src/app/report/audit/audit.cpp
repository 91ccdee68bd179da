// Report of an audit, for people.

#include "barycert/audit.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/report/audit/audit_words.hpp"
#include "app/report/common/document.hpp"
#include "app/report/common/terminal_text.hpp"
#include "barycert/audit_report.hpp"
#include "barycert/certificate.hpp"
#include "barycert/finding.hpp"
#include "barycert/report.hpp"
#include "barycert/result.hpp"
#include "barycert/simplex.hpp"
#include "barycert/statistics.hpp"
#include "barycert/witness.hpp"

namespace barycert {

using namespace report;

namespace {

/// Additions to the style of pages.
constexpr std::string_view audit_style = R"(
.small-figures{display:grid;grid-template-columns:repeat(auto-fill,minmax(min(100%,236px),1fr));gap:14px 18px}
.small-figures figcaption{overflow-wrap:anywhere;color:var(--ink);line-height:1.3}
.small-figures small{color:var(--soft);font-size:13px}
.signs,.maps{display:grid;grid-template-columns:repeat(auto-fill,minmax(160px,1fr));gap:14px 17px;align-items:start}
.signs img,.maps img{display:block;width:100%;height:auto;max-width:320px;border:1px solid var(--line)}
.maps img{image-rendering:pixelated}.signs img{max-width:256px}.signs .exact img{outline:3px solid var(--good)}
.signs figcaption,.maps figcaption{font-size:13px;line-height:1.3;overflow-wrap:anywhere}
.key span{white-space:nowrap}.key i{display:inline-block;width:12px;height:12px;margin:0 5px 0 14px;border:1px solid var(--line);vertical-align:-1px}
svg .dot{fill:var(--bar);fill-opacity:.75}svg .dot.front{fill:var(--good);fill-opacity:1}
svg .front{stroke:var(--good);stroke-width:1.6px}svg text.front{fill:var(--good);stroke:none;font-size:11px}
)";

/// How many cases lie in each region, exactly: "12 interior, 3 boundary, ...".
std::string regions_text(const AuditReport& report) {
    return joined(all_regions, ", ",
                  [&](Region r) { return fmt::format("{} {}", report.regions[static_cast<std::size_t>(r)], name(r)); });
}

/// Says what makes the same report again, and how long it took.
std::string how_it_was_made(const AuditReport& report) {
    return fmt::format("seed {}, {} cases per family and simplex, {} threads, {:.1f} s", report.seed, report.count,
                       report.threads, report.seconds);
}

/// A kernel's results, or those of one of its families: a row of a table.
struct Known {
    std::string name, tip;
    const KernelStatistics* statistics;
    double meshes = -1, ns = 0;  ///< of a kernel
};

/// A table of kernels, worst first; or of the families of one kernel.
Listing statistics_table(const std::vector<Known>& all, bool kernels) {
    const std::string error = kernels ? "error," : "error";
    const For of_families = kernels ? For::page : For::all;
    Listing table{
        .columns = {left(kernels ? "kernel" : "family", 6), right("cases", 6, "", of_families),
                    right("wrong\n%", 6, "wrong, %"), right("in as\nout %", 6, "inside called outside, %"),
                    right("out as\nin %", 6, "outside called inside, %"), right("no\nans. %", 6, "no answer, %"),
                    right("error\n99 %", 6, "error of 99 %"), right(error + "\nmax", 8, "largest error", of_families)},
        .sorts = true,
        .style = kernels ? "kernels" : ""};
    if (kernels) table.columns.push_back(right(error + "\nmeshes", 8, "largest error on meshes"));
    table.columns.push_back(right(error + "\nulps", 8, "largest, ulps"));
    if (kernels) table.columns.push_back(right("ns", 5));
    for (const Known& k : all) {
        const KernelStatistics& s = *k.statistics;
        Row row{.cells = {k.name,
                          {kernels ? std::to_string(s.cases) : brief_count(s.cases), static_cast<double>(s.cases)},
                          s.cases == 0 ? Cell("not run", -1) : share_cell({s.wrong_cases, s.cases}, true),
                          share_cell(inside_called_outside(s)),
                          share_cell(outside_called_inside(s)),
                          share_cell(unanswered(s)),
                          {usual_error(s), s.errors.within(0.99)},
                          number_cell(s.errors.worst.value)},
                .tone = (kernels ? perfect(s) : s.cases != 0 && s.wrong_cases == 0) ? Tone::good : Tone::plain,
                .tip = k.tip};
        if (kernels) row.cells.push_back(number_cell(k.meshes));
        row.cells.push_back(number_cell(s.weight_ulp.value));
        if (kernels) row.cells.emplace_back(brief_time(k.ns), k.ns);
        if (kernels && !incidents(s).empty()) row.below.push_back(incidents(s));
        table.rows.push_back(std::move(row));
    }
    return table;
}

void tell_legend(Document& d, bool kernels) {
    const auto line = [&](std::string name, std::vector<std::string> lines) {
        d.add(Named{std::move(name), std::move(lines), Tone::soft});
    };
    line("wrong", {"cases with a wrong sign, zero, region or declaration"});
    line("in as out", {"points inside or on the boundary that the kernel takes for outside; out as in: reverse"});
    line("no ans.",
         {"cases without a finite answer (a crash, a hang, an exception), or wrongly declared", "degenerate"});
    line("error", {"of the weights of a case, relative to 1 or the largest weight: what 99 % of the answers",
                   "are below; the largest; that in the families mesh.*; and in units in the last place of",
                   "the exact weight, which are tiny for weights near zero"});
    if (kernels) line("ns", {"median time of one evaluation"});
}

/// The meshes by what is known of them.
void tell_meshes(Document& d, const AuditReport& r, const TerminalStyle& style, Breaks wrap) {
    if (r.meshes.empty()) d.say("meshes: none");
    for (const auto& [verdict, text] : {std::pair(Verdict::certified, "certified to be partitions"),
                                        {Verdict::not_certified, "NOT certified to be partitions"},
                                        {Verdict::not_checked, "not checked"}}) {
        std::string names;
        for (std::size_t i = 0; i < r.meshes.size(); ++i) {
            if (r.verdicts[i] == verdict) names += (names.empty() ? "" : ", ") + r.meshes[i];
        }
        const bool bad = verdict == Verdict::not_certified;
        const std::string why = bad ? fmt::format(" (why: {} check MESH)", style.command) : "";
        if (!names.empty())
            d.say(fmt::format("meshes, {}: {}{}", text, names, why), bad ? Tone::bad : Tone::plain, For::all, wrap);
    }
}

void tell_families(Document& d, const AuditReport& r) {
    struct Line {
        std::uint64_t cases = 0;
        std::size_t kernels = 0;
        std::vector<std::pair<std::uint64_t, std::string>> wrong;  ///< wrong cases and kernel
    };
    std::map<std::pair<std::size_t, Simplex>, Line> lines;
    for (const KernelResult& k : r.kernels) {
        for (const FamilyResult& f : k.families) {
            Line& line = lines[{f.family, k.kernel.simplex}];
            line.cases = std::max(line.cases, f.statistics.cases);
            ++line.kernels;
            if (f.statistics.cases != 0)
                line.wrong.emplace_back(f.statistics.wrong_cases, k.kernel.name.substr(k.kernel.name.find('.') + 1));
        }
    }
    Listing table{.columns = {left("family", 6), left("simplex", 11, 2), right("cases", 7),
                              right("clean", 7, "kernels without a finding"), right("median %", 9, "median wrong, %"),
                              right("worst %", 8, "worst wrong, %"), left("worst kernel", 0, 2)},
                  .sorts = true};
    for (auto& [key, line] : lines) {
        auto& wrong = line.wrong;
        std::ranges::stable_sort(wrong, [](const auto& a, const auto& b) { return a.first > b.first; });
        if (wrong.empty()) wrong.emplace_back(0, "not run");
        const std::uint64_t worst = wrong.front().first;
        const auto with = [&all = wrong](std::uint64_t n) {
            return static_cast<std::size_t>(std::ranges::count(all, n, &std::pair<std::uint64_t, std::string>::first));
        };
        const std::size_t clean = line.cases == 0 ? 0 : with(0);
        const std::string more = with(worst) > 1 ? fmt::format(" (+{} more)", with(worst) - 1) : "";
        table.rows.push_back({{r.families[key.first].name,
                               std::string(name(key.second)),
                               {brief_count(line.cases), static_cast<double>(line.cases)},
                               {fmt::format("{}/{}", clean, line.kernels),
                                static_cast<double>(clean) / static_cast<double>(line.kernels)},
                               share_cell({wrong[(wrong.size() - 1) / 2].first, line.cases}),
                               share_cell({worst, line.cases}),
                               worst == 0 && line.cases != 0 ? "-" : wrong.front().second + more}});
    }
    d.table(std::move(table), "Families of cases");
    d.say("clean: kernels without a finding / all kernels. median, worst: share of wrong cases, over the kernels.",
          Tone::soft);
}

/// Adds a kernel's witnesses. On a page of several kernels all but the first fold.
void tell_witnesses_of(Document& d, const AuditReport& r, const KernelResult& k, const TerminalStyle& style) {
    if (k.witnesses.empty() && k.total.not_run == 0) d.say("No witness: every weight and value is correctly rounded.");
    for (const Witness& w : k.witnesses) {
        d.add(Item{.title = w.reason + ": " + finding_sentence(k, w),
                   .lines = {{place_of(w) + ": " + shows(w)}, {replay_command(r, k, w, style), true}},
                   .folds = r.kernels.size() > 1 && &w != &k.witnesses.front()});
    }
}

/// Adds, for each kernel, the witnesses of all its findings.
void tell_witnesses(Document& d, const AuditReport& r, const TerminalStyle& style) {
    d.section("Witnesses");
    d.say("The worst case of each finding, and the command that shows the kernel's answer beside the exact one.",
          Tone::soft);
    for (const KernelResult& k : r.kernels) {
        d.section(k.kernel.name, For::all, 3);
        if (!k.kernel.fails.empty()) d.say(k.kernel.fails, Tone::soft);
        if (!k.kernel.note.empty()) d.say(k.kernel.note);
        if (k.total.not_run != 0) d.say(fmt::format("Given up: {} cases were not run.", k.total.not_run));
        tell_witnesses_of(d, r, k, style);
    }
}

/// The report on the only kernel, family by family.
void tell_kernel(Document& d, const AuditReport& r, const TerminalStyle& style) {
    const KernelResult& k = r.kernels.front();
    for (const auto& [what, text] : {std::pair("formula", k.kernel.formula),
                                     {"source", k.kernel.source},
                                     {"fails", k.kernel.fails},
                                     {"note", k.kernel.note},
                                     {"time", k.ns > 0 ? brief_time(k.ns) + " ns an evaluation" : std::string()}}) {
        if (!text.empty()) d.add(Named{.name = what, .lines = {text}, .wrap = Breaks::words});
    }
    std::vector<Known> families;
    for (const FamilyResult& f : k.families)
        families.push_back({r.families[f.family].name, r.families[f.family].tests, &f.statistics});
    std::ranges::stable_sort(families, std::greater<>(), [](const Known& f) { return f.statistics->wrong_cases; });
    d.table(statistics_table(families, false), "Families of cases");
    if (!style.wide) tell_legend(d, false);
    d.section(k.kernel.raised != nullptr ? "Worst case of each finding:"
                                         : "Worst case of each finding, and the command that replays it:");
    if (!incidents(k.total).empty()) d.say(incidents(k.total), Tone::bad);
    tell_witnesses_of(d, r, k, style);
}

void tell_kernels(Document& d, const AuditReport& r) {
    std::vector<Known> kernels;
    for (const KernelResult& k : r.kernels)
        kernels.push_back({k.kernel.name, "", &k.total, worst_on_meshes(r, k), k.ns});
    d.table(statistics_table(kernels, true), "Kernels, worst first");
    tell_legend(d, true);
}

/// Wrong cases of the families that draw from meshes.
Share wrong_on_meshes(const AuditReport& report, const KernelResult& k) {
    Share share;
    for (const FamilyResult& f : k.families) {
        if (!report.families[f.family].needs_mesh) continue;
        share.part += f.statistics.wrong_cases;
        share.whole += f.statistics.cases;
    }
    return share;
}

/// All columns: wider than most terminals.
void tell_all_counts(Document& d, const AuditReport& r) {
    Listing table{.columns = {left("kernel", 6), right("cases", 5), right("wrong\n%", 6), right("wrong%\nmeshes", 6),
                              right("opp.\nsign", 5), right("false\nzero", 5), right("false\nnon-0", 5),
                              right("not\nfinite", 6), right("false\ninside", 6), right("false\noutside", 7),
                              right("false\ndegen.", 6), right("missed\ndegen.", 6), right("ulps\n99.9%", 9),
                              right("ulps\nworst", 9), right("value\n99.9%", 9), right("ns", 5)}};
    for (const KernelResult& k : r.kernels) {
        const KernelStatistics& s = k.total;
        Row row{.cells = {k.kernel.name, brief_count(s.cases), percent({s.wrong_cases, s.cases}),
                          percent(wrong_on_meshes(r, k))},
                .tone = perfect(s) ? Tone::good : Tone::plain};
        for (const Finding f :
             {Finding::opposite_sign, Finding::false_zero, Finding::false_nonzero, Finding::not_finite,
              Finding::false_inside, Finding::false_outside, Finding::false_declaration, Finding::missed_degenerate})
            row.cells.emplace_back(brief_count(count_of(s, f)));
        row.cells.insert(row.cells.end(), {brief(s.p999_weight_ulp()), brief(s.weight_ulp.value),
                                           brief(s.p999_value_ulp()), brief_time(k.ns)});
        if (const std::string beside = incidents(s); !beside.empty()) row.below.push_back(beside);
        if (const std::uint64_t broken = count_of(s, Finding::false_certificate); broken != 0)
            row.below.push_back(fmt::format("certifies its answers, and {} of them are wrong", broken));
        table.rows.push_back(std::move(row));
    }
    d.add(std::move(table));
    d.notes(
        {"wrong %: share of cases with a finding, over all families and over the families mesh.*. A finding is a wrong "
         "sign, zero, region or declaration.",
         "ulps: error of a weight in ulps of the correctly rounded weight; value: the same for the interpolated value. "
         "Signs, zeros and not",
         "finite count weights; inside, outside and degenerate count cases.  ns: median time of one evaluation, over "
         "blocks of cases."});
}

void tell_wide(Document& d, const AuditReport& r, const TerminalStyle& style) {
    d.say(environment_line(r.environment));
    d.say(how_it_was_made(r));
    d.say(fmt::format("{} kernels, {} families, {} cases in all, exactly {}", r.kernels.size(), r.families.size(),
                      r.cases, regions_text(r)));
    tell_meshes(d, r, style, Breaks::none);
    d.say(oracle_line(r.oracles));
    d.part();
    tell_all_counts(d, r);
    tell_families(d, r);
    d.section("Worst witness of each kernel, and the command that replays it:");
    for (const KernelResult& k : r.kernels) {
        const Witness* const w = worst_witness(k);
        Item item{.title = k.kernel.name,
                  .text = w != nullptr           ? fmt::format(": {} in {} ({})", w->reason, place_of(*w), shows(*w))
                          : k.total.not_run != 0 ? ": no witness"
                                                 : ": no witness, every weight and value is correctly rounded"};
        if (w != nullptr) item.lines.push_back({replay_command(r, k, *w, style), true});
        d.add(std::move(item));
    }
}

/// Adds the last lines on a terminal.
void tell_hints(Document& d, const AuditReport& r, const TerminalStyle& style) {
    const KernelResult& worst = r.kernels.front();
    const Witness* const w = worst_witness(worst);
    const std::string replay = w == nullptr ? "" : replay_command(r, worst, *w, style);
    if (!replay.empty()) {
        d.add(Section{}, For::terminal);
        d.add(
            Item{.text = fmt::format("See the worst kernel fail ({}, {}):", w->reason, shows(*w)), .lines = {{replay}}},
            For::terminal);
    }
    d.say("One kernel, family by family: --kernel NAME. All counts and witnesses: --wide, --html FILE.", Tone::soft,
          For::terminal);
}

/// The parts that only a page has.
Document page_of(const AuditReport& r, const TerminalStyle& style, const AuditPage& page) {
    Document d;
    const bool one = r.kernels.size() == 1;
    d.add(Pictures{[&r, &page, one] {
        return (one ? "" : pareto_figures(r)) + sign_figures(page.signs) + map_figures(r, page.maps) +
               error_histograms(r);
    }});
    if (!one) {
        tell_witnesses(d, r, style);
        tell_families(d, r);
    }
    tell_others(d, page.others);
    d.section("How it was made");
    if (!page.command_line.empty()) d.add(Named{.name = "command", .lines = {page.command_line}, .command = true});
    d.name("run", how_it_was_made(r));
    d.name("by", environment_line(r.environment));
    d.name("on", fmt::format("a processor of {} threads", r.environment.hardware_threads));
    d.say(
        "The same seed gives the same cases on every machine; figures other than times do not depend on the number of "
        "threads.",
        Tone::soft);
    return d;
}

/// `page`: what is on it beside.
Document audit_document(const AuditReport& r, const TerminalStyle& style, const AuditPage& page) {
    Document d;
    d.title = "barycert audit: " + verdict_sentence(r);
    d.heading = "barycert audit: floating-point kernels for barycentric weights, held against exact arithmetic";
    d.footer = "barycert " + r.environment.version;
    d.style = audit_style;
    d.script = true;
    d.data = audit_data(r);
    // Kernels know corners alone: what rounding has left of middles is in the JSON.
    for (std::size_t i = 0; i < r.curved.size(); ++i) {
        if (r.curved[i].cells != 0 || r.curved[i].by_corners != 0) d.curved(r.curved[i], r.meshes[i]);
    }
    if (style.wide) {
        tell_wide(d, r, style);
        return d;
    }
    const bool one = r.kernels.size() == 1;
    d.add(Headline{
        .tone = any_wrong(r) ? Tone::bad : Tone::good, .text = verdict_sentence(r), .sentences = verdict_details(r)});
    if (one)
        tell_kernel(d, r, style);
    else
        tell_kernels(d, r);
    d.part();
    d.say(fmt::format("{} cases of {}, exactly {}", r.cases, counted(r.families.size(), "family", "families"),
                      regions_text(r)),
          Tone::plain, For::all, Breaks::words);
    d.say(oracle_line(r.oracles), Tone::plain, For::all, Breaks::words);
    tell_meshes(d, r, style, Breaks::commas);
    d.append(page_of(r, style, page), For::page);
    d.say(how_it_was_made(r), Tone::plain, For::terminal);
    d.say(environment_line(r.environment), Tone::plain, For::terminal);
    if (!one) tell_hints(d, r, style);
    return d;
}

}  // namespace

std::string audit_text(const AuditReport& report, const TerminalStyle& style) {
    return written_text([&] { return audit_document(report, style, {}); }, style.colour);
}

std::string audit_json(const AuditReport& report) {
    return written_json([&] { return audit_document(report, {}, {}); }, 1);
}

Result<std::string> audit_html(const AuditReport& report, const AuditPage& page) {
    TerminalStyle style = page.style;
    style.wide = false;
    try {
        return written_page([&] { return audit_document(report, style, page); });
    } catch (const Exception& e) {
        return e.error();
    }
}

}  // namespace barycert
