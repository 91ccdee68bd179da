/// Reports on rules that answer cases of their own: what they share.
#pragma once

#include "barycert/report/audit/audit_words.hpp"

namespace barycert::report {

/// Reached by that share of the errors: the edge of a bin, at most the worst; -1 if there are no errors.
inline double reached(const LogHistogram& errors, double share, const WorstCase& worst) {
    return std::min(errors.quantile(share), worst.value);
}

template <class Tally>
double share_of_wrong(const Tally& t) {
    return t.wrong_cases() == 0 ? 0 : static_cast<double>(t.wrong_cases()) / static_cast<double>(t.cases);
}

/// How many are wrong; `tables`; each rule with the families that show its faults, worst first; the families; how it
/// was made. rule_of(rule), tally_of(tally), worst_of(rule, tally, JSON): members of the JSON.
template <class Audit, class Families, class RuleOf, class TallyOf, class WorstOf>
Document rules_document(std::string title, const Audit& audit, const Families& families, Document tables,
                        const RuleOf& rule_of, const TallyOf& tally_of, const WorstOf& worst_of) {
    Document d;
    d.title = d.heading = std::move(title);
    d.indent = 1;
    d.script = true;
    const auto wrong = std::ranges::count_if(audit.results, [](const auto& r) { return r.total.wrong_cases() != 0; });
    d.add(Headline{.tone = wrong == 0 ? Tone::good : Tone::bad,
                   .text = fmt::format("{} of {} rules give wrong answers", wrong, audit.results.size())});
    d.append(std::move(tables), For::all);
    d.section("The rules");
    for (const auto& r : audit.results) {
        Item item{.title = r.rule.name, .text = ": " + r.rule.formula};
        item.lines.push_back({"source: " + r.rule.source});
        item.lines.push_back({"fails: " + r.rule.fails});
        auto own = r.families;
        std::erase_if(own, [](const auto& t) { return t.wrong_cases() == 0; });
        std::ranges::stable_sort(own, std::greater(), [](const auto& t) { return share_of_wrong(t); });
        for (const auto& t : own)
            item.lines.push_back(
                {fmt::format("wrong in {} % of {}, first in case {}", percent({t.wrong_cases(), t.cases}),
                             families[t.family].name, t.wrong.index)});
        if (own.empty()) item.lines.push_back({"no finding"});
        d.add(std::move(item));
    }
    d.section("The families");
    for (const auto& f : families) d.name(f.name, f.tests);
    d.say(fmt::format("seed {}, {} cases a family, {} threads; {}", audit.seed, audit.count, audit.threads,
                      environment_line(measure_environment())),
          Tone::soft);
    d.data = record("schema", audit_schema, "environment", measure_environment(), MEMBERS(audit, seed, count, threads),
                    "rules", list(audit.results, [&](const auto& r) {
                        Json j = rule_of(r.rule);
                        put(j, "total", tally_of(r.total), "families", list(r.families, [&](const auto& t) {
                                Json of = record("family", families[t.family].name);
                                of.update(tally_of(t));
                                worst_of(r.rule, t, of);
                                return of;
                            }));
                        return j;
                    }));
    return d;
}

/// With a page.
#define RULES_WRITERS(name, Audit)                \
    AUDIT_TEXT_AND_JSON(name, Audit)              \
    std::string name##_html(const Audit& audit) { \
        const ExactEnvironment environment;       \
        return page_text(name##_document(audit)); \
    }

}  // namespace barycert::report
