// Rules on triangles in space, held against exact answers.

#include "barycert/report/audit/rules.hpp"

namespace barycert {

using namespace report;

namespace {

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
    for (const auto& r : audit.results) {
        if (r.rule.question != question) continue;
        const SurfaceTally& t = r.total;
        Row row{{r.rule.name, brief_count(t.cases), share_cell({t.wrong_cases(), t.cases}, true)}};
        if (distance) row.cells.push_back(share_cell({t.not_finite, t.cases}));
        row.cells.push_back(share_cell({t.false_yes, t.cases - t.yes}));
        row.cells.push_back(share_cell({t.false_no, t.yes}));
        if (distance) {
            row.cells.push_back(number_cell(reached(t.ulps, 0.999, t.worst)));
            row.cells.push_back(number_cell(t.worst.value));
        } else {
            const auto worst = std::ranges::max_element(r.families, {}, share_of_wrong<SurfaceTally>);
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
    Document tables;
    for (const auto q : {SurfaceQuestion::distance, SurfaceQuestion::inside, SurfaceQuestion::meet})
        tell_question(tables, audit, q);
    tables.notes(
        {"wrong: answers that are not finite, 0 for a point off the triangle or not 0 for one on it; yes for no or",
         "no for yes. ulps: errors of distances in units in the last place of the exact one. Points exactly on a",
         "closed surface are left out: either answer is right there."});
    const auto rule = [](const SurfaceRule& r) { return record(MEMBERS(r, name, question, formula, source, fails)); };
    const auto tally = [](const SurfaceTally& t) {
        Json j = record(MEMBERS(t, cases, yes, false_yes, false_no, not_finite), "wrong_cases", t.wrong_cases());
        if (t.worst.value >= 0) put(j, "worst_ulps", t.worst.value, "p999_ulps", reached(t.ulps, 0.999, t.worst));
        return j;
    };
    const auto cases = [&](const SurfaceRule& r, const SurfaceTally& t, Json& j) {
        const SurfaceFamily& family = surface_families()[t.family];
        if (t.wrong.value > 0) put(j, "first_wrong", case_json(r, family, audit.seed, t.wrong.index));
        if (t.worst.value > 0) put(j, "worst", case_json(r, family, audit.seed, t.worst.index));
    };
    return rules_document("Rules on triangles in space", audit, surface_families(), std::move(tables), rule, tally,
                          cases);
}

}  // namespace

RULES_WRITERS(surfaces, SurfaceAudit)

}  // namespace barycert
