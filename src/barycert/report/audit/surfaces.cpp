// Rules on triangles in space, held against exact answers.

#include "barycert/report/audit/audit_words.hpp"

namespace barycert {

using namespace report;

namespace {

double share_of_wrong(const SurfaceTally* t) {
    return t->cases == 0 ? 0 : static_cast<double>(t->wrong_cases()) / static_cast<double>(t->cases);
}

/// 99.9th percentile: the edge of a bin, at most the worst; -1 if there are no errors to measure.
double p999(const SurfaceTally& t) {
    return std::min(t.ulps.quantile(0.999), t.worst.value);
}

void tell_question(Document& d, const SurfaceAudit& audit, SurfaceQuestion question) {
    const bool distance = question == SurfaceQuestion::distance;
    Listing table{.columns = {left("rule", 32), right("cases", 7), right("wrong\n%", 6)}, .sorts = true};
    if (distance) {
        for (const char* head :
             {"no\nanswer %", "0 off the\ntriangle %", "not 0\non it %", "ulps,\n99.9 %", "ulps,\nworst"})
            table.columns.push_back(right(head, 9));
    } else {
        const bool inside = question == SurfaceQuestion::inside;
        table.columns.push_back(right(inside ? "out as\nin %" : "apart as\nmeeting %", 9));
        table.columns.push_back(right(inside ? "in as\nout %" : "meeting\nas apart %", 10));
        table.columns.push_back(left("worst family", 20, 2));
    }
    for (const SurfaceResult& r : audit.results) {
        if (r.rule.question != question) continue;
        const SurfaceTally& t = r.total;
        Row row{{r.rule.name, brief_count(t.cases), share_cell({t.wrong_cases(), t.cases}, true)}};
        if (distance) row.cells.push_back(share_cell({t.not_finite, t.cases}));
        row.cells.push_back(share_cell({t.false_yes, t.cases - t.yes}));
        row.cells.push_back(share_cell({t.false_no, t.yes}));
        if (distance) {
            row.cells.push_back(number_cell(p999(t)));
            row.cells.push_back(number_cell(t.worst.value));
        } else {
            const auto worst =
                std::ranges::max_element(r.families, {}, [](const SurfaceTally& f) { return share_of_wrong(&f); });
            row.cells.emplace_back(t.wrong_cases() == 0
                                       ? ""
                                       : fmt::format("{}, {} %", surface_families()[worst->family].name,
                                                     percent({worst->wrong_cases(), worst->cases})));
        }
        if (t.wrong_cases() == 0 && t.worst.value <= 0) row.tone = Tone::good;
        table.rows.push_back(std::move(row));
    }
    d.section(distance                              ? "How far a point is from a triangle"
              : question == SurfaceQuestion::inside ? "Whether a point is inside a closed surface"
                                                    : "Whether two triangles have a point in common");
    d.add(std::move(table));
}

Json case_json(const SurfaceRule& rule, const SurfaceFamily& family, std::uint64_t seed, std::uint64_t index) {
    const SurfaceCase c = make_surface_case(family, seed, index);
    Json j = record("case", index, "answer", rule.answer(c), "triangles",
                    list(c.triangles, [](const TriangleInSpace& t) { return list(t, base::hexadecimal); }));
    if (rule.question != SurfaceQuestion::meet) put(j, "point", list(c.point, base::hexadecimal));
    return j;
}

Document surfaces_document(const SurfaceAudit& audit) {
    Document d;
    d.title = d.heading = "Rules on triangles in space";
    d.indent = 1;
    d.script = true;
    const auto wrong = std::ranges::count_if(audit.results, [](const auto& r) { return r.total.wrong_cases() != 0; });
    d.add(Headline{.tone = wrong == 0 ? Tone::good : Tone::bad,
                   .text = fmt::format("{} of {} rules give wrong answers", wrong, audit.results.size())});
    for (const auto q : {SurfaceQuestion::distance, SurfaceQuestion::inside, SurfaceQuestion::meet})
        tell_question(d, audit, q);
    d.notes({"wrong: answers that are not finite, 0 for a point off the triangle or not 0 for one on it; yes for no or",
             "no for yes. ulps: errors of distances in units in the last place of the exact one. Points exactly on a",
             "closed surface are left out: either answer is right there."});
    d.section("The rules");
    for (const SurfaceResult& r : audit.results) {
        Item item{.title = r.rule.name, .text = ": " + r.rule.formula};
        item.lines.push_back({"source: " + r.rule.source});
        item.lines.push_back({"fails: " + r.rule.fails});
        std::vector<const SurfaceTally*> families;
        for (const SurfaceTally& t : r.families) {
            if (t.wrong_cases() != 0) families.push_back(&t);
        }
        std::ranges::stable_sort(families, std::greater(), share_of_wrong);
        for (const SurfaceTally* t : families)
            item.lines.push_back(
                {fmt::format("wrong in {} % of {}, first in case {}", percent({t->wrong_cases(), t->cases}),
                             surface_families()[t->family].name, t->wrong.index)});
        if (families.empty()) item.lines.push_back({"no finding"});
        d.add(std::move(item));
    }
    d.section("The families");
    for (const SurfaceFamily& f : surface_families()) d.name(f.name, f.tests);
    d.say(fmt::format("seed {}, {} cases a family, {} threads; {}", audit.seed, audit.count, audit.threads,
                      environment_line(measure_environment())),
          Tone::soft);
    const auto tally = [](const SurfaceTally& t) {
        Json j = record(MEMBERS(t, cases, yes, false_yes, false_no, not_finite), "wrong_cases", t.wrong_cases());
        if (t.worst.value >= 0) put(j, "worst_ulps", t.worst.value, "p999_ulps", p999(t));
        return j;
    };
    d.data =
        record("schema", audit_schema, "environment", measure_environment(), MEMBERS(audit, seed, count, threads),
               "rules", list(audit.results, [&](const SurfaceResult& r) {
                   return record(MEMBERS(r.rule, name, question, formula, source, fails), "total", tally(r.total),
                                 "families", list(r.families, [&](const SurfaceTally& t) {
                                     const SurfaceFamily& family = surface_families()[t.family];
                                     Json j = record("family", family.name);
                                     j.update(tally(t));
                                     if (t.wrong.value > 0)
                                         put(j, "first_wrong", case_json(r.rule, family, audit.seed, t.wrong.index));
                                     if (t.worst.value > 0)
                                         put(j, "worst", case_json(r.rule, family, audit.seed, t.worst.index));
                                     return j;
                                 }));
               }));
    return d;
}

}  // namespace

std::string surfaces_text(const SurfaceAudit& audit, const TerminalStyle& style) {
    const ExactEnvironment environment;
    return terminal_text(surfaces_document(audit), style.colour);
}

std::string surfaces_json(const SurfaceAudit& audit) {
    const ExactEnvironment environment;
    return data_text(surfaces_document(audit));
}

std::string surfaces_html(const SurfaceAudit& audit) {
    const ExactEnvironment environment;
    return page_text(surfaces_document(audit));
}

}  // namespace barycert
