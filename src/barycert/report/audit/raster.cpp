// Drift over the size of a triangle, and rules of texel addressing.

#include <fmt/format.h>

#include "barycert/audit_report.hpp"
#include "barycert/base/text.hpp"
#include "barycert/environment.hpp"
#include "barycert/report/common/document.hpp"
#include "barycert/report/common/terminal_text.hpp"

namespace barycert {

using namespace report;

namespace {

Document drift_document(const DriftReport& r) {
    Document d;
    d.indent = 1;
    d.say(
        fmt::format("seed {}, {} cases per size. Largest error of the value, in ulps of the exact one, by the size of "
                    "the triangle in pixels.",
                    r.seed, r.count));
    Listing table{.columns = {{"kernel", true, 6}}};
    if (!r.curves.empty()) {
        for (const DriftPoint& p : r.curves.front().points) table.columns.push_back({std::to_string(p.size), false, 9});
    }
    table.columns.push_back({"", true, 0, 2});
    for (const DriftCurve& curve : r.curves) {
        Row row{{curve.kernel.name}};
        std::uint64_t not_finite = 0;
        for (const DriftPoint& p : curve.points) {
            row.cells.emplace_back(p.cases == 0 ? "-" : brief(p.worst_ulp));
            not_finite += p.not_finite;
        }
        row.cells.emplace_back(not_finite == 0 ? "" : fmt::format("and {} cases without a finite value", not_finite));
        table.rows.push_back(std::move(row));
    }
    d.part();
    d.add(std::move(table));
    d.data = record("schema", audit_schema, "environment", environment_json(measure_environment()), "seed", r.seed,
                    "count", r.count, "kernels", list(r.curves, [](const DriftCurve& curve) {
                        return record("name", curve.kernel.name, "sizes", list(curve.points, [](const DriftPoint& p) {
                                          return record("size", p.size, "cases", p.cases, "not_finite", p.not_finite,
                                                        "worst_ulp", p.worst_ulp, "worst_relative", p.worst_relative,
                                                        "case", p.index);
                                      }));
                    }));
    return d;
}

Document texels_document(const std::vector<TexelResult>& results) {
    Document d;
    d.indent = 1;
    Listing table{.columns = {{"rule", true, 22},
                              {"wrap", true, 7},
                              {"cases", false, 7},
                              {"past\nthe end", false, 9},
                              {"before\nthe start", false, 9},
                              {"wrong\ntexel", false, 9}}};
    std::vector<Item> items;
    Json rules = Json::array();
    for (const TexelResult& r : results) {
        const bool clean = r.counts[0] + r.counts[1] + r.counts[2] == 0;
        table.rows.push_back({{r.rule.name, std::string(name(r.rule.wrap)), brief_count(r.cases),
                               brief_count(r.counts[0]), brief_count(r.counts[1]), brief_count(r.counts[2])},
                              clean                            ? Tone::good
                              : r.counts[0] + r.counts[1] != 0 ? Tone::bad
                                                               : Tone::plain});
        Item item{.title = r.rule.name, .text = ": " + r.rule.formula};
        Json rule = record("name", r.rule.name, "wrap", name(r.rule.wrap), "formula", r.rule.formula, "source",
                           r.rule.source, "fails", r.rule.fails, "cases", r.cases);
        Json witnesses = Json::array();
        for (std::size_t f = 0; f < r.counts.size(); ++f) {
            const TexelWitness& w = r.witnesses[f];
            put(rule, texel_finding_names[f], r.counts[f]);
            if (r.counts[f] == 0) continue;
            item.lines.push_back(
                {fmt::format("{}: u = {} ({}) in a row of {}: texel {}, exactly {}", texel_finding_names[f],
                             base::shortest(w.u), base::hexadecimal(w.u), w.size, w.texel, w.exact)});
            witnesses.push_back(record("finding", texel_finding_names[f], "u", base::hexadecimal(w.u), "size", w.size,
                                       "texel", w.texel, "exact", w.exact));
        }
        if (clean) item.lines.push_back({"no finding"});
        items.push_back(std::move(item));
        put(rule, "witnesses", witnesses);
        rules.push_back(std::move(rule));
    }
    d.add(std::move(table));
    d.part();
    for (Item& item : items) d.add(std::move(item));
    d.data = record("schema", audit_schema, "rules", rules);
    return d;
}

}  // namespace

std::string drift_text(const DriftReport& report, const TerminalStyle& style) {
    const ExactEnvironment environment;
    return terminal_text(drift_document(report), style.colour);
}

std::string drift_json(const DriftReport& report) {
    const ExactEnvironment environment;
    return data_text(drift_document(report));
}

std::string texels_text(const std::vector<TexelResult>& results, const TerminalStyle& style) {
    const ExactEnvironment environment;
    return terminal_text(texels_document(results), style.colour);
}

std::string texels_json(const std::vector<TexelResult>& results) {
    const ExactEnvironment environment;
    return data_text(texels_document(results));
}

}  // namespace barycert
