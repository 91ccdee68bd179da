// Rules that answer cases of their own: on triangles in space, held against exact answers; inverse maps of cells by
// Newton's method, held against proved ones.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>

#include "app/report/audit/audit_words.hpp"
#include "app/report/common/document.hpp"
#include "app/report/common/json.hpp"
#include "app/report/common/terminal_text.hpp"
#include "barycert/audit_report.hpp"
#include "barycert/environment.hpp"
#include "barycert/inverse_rules.hpp"
#include "barycert/report.hpp"
#include "barycert/simplex.hpp"
#include "barycert/statistics.hpp"
#include "barycert/surface_rules.hpp"
#include "core/base/text.hpp"

namespace barycert {

using namespace report;

namespace {

/// Reached by that share of the errors: the edge of a bin, at most the worst; -1 if there are no errors.
inline double reached(const LogHistogram& errors, double share, const WorstCase& worst) {
    return std::min(errors.quantile(share), worst.value);
}

constexpr auto share_of_wrong = [](const auto& t) {
    return t.wrong_cases() == 0 ? 0 : static_cast<double>(t.wrong_cases()) / static_cast<double>(t.cases);
};

// Rules on triangles in space.

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
            const auto worst = std::ranges::max_element(r.families, {}, share_of_wrong);
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

Json tally_json(const SurfaceTally& t) {
    Json j = record(MEMBERS(t, cases, yes, false_yes, false_no, not_finite), "wrong_cases", t.wrong_cases());
    if (t.worst.value >= 0) put(j, "worst_ulps", t.worst.value, "p999_ulps", reached(t.ulps, 0.999, t.worst));
    return j;
}

Json case_json(const SurfaceRule& rule, const SurfaceFamily& family, std::uint64_t seed, std::uint64_t index) {
    const SurfaceCase c = make_surface_case(family, seed, index);
    Json j = record("case", index, "answer", rule.answer(c), "triangles",
                    list(c.triangles, [](const TriangleInSpace& t) { return list(t, base::hexadecimal); }));
    if (rule.question != SurfaceQuestion::meet) put(j, "point", list(c.point, base::hexadecimal));
    return j;
}

// Inverse maps of cells.

void tell_rules(Document& d, const InverseAudit& audit) {
    Listing table{.columns = {left("rule", 26), right("cases", 6), right("wrong\n%", 5)}, .sorts = true};
    for (const char* head : {"no\nanswer %", "in as\nout %", "on as\nout %", "out as\nin %", "values:\nulps, 50 %",
                             "ulps,\nworst", "of range,\nworst", "x: ulps,\n50 %", "ulps,\nworst"})
        table.columns.push_back(right(head, 7));
    for (const auto& r : audit.results) {
        const InverseTally& t = r.total;
        const auto& [interior, boundary, outside] = t.told;
        const auto sum = [](const auto& row) { return row[0] + row[1] + row[2]; };
        const std::uint64_t in = sum(interior), on = sum(boundary);
        Row row{{r.rule.name, brief_count(t.cases), share_cell({t.wrong_cases(), t.cases}, true),
                 share_cell({interior[2] + boundary[2], in + on}), share_cell({interior[1], in}),
                 share_cell({boundary[1], on}), share_cell({outside[0], sum(outside)}),
                 number_cell(reached(t.value_ulps, 0.5, t.value_ulp)), number_cell(t.value_ulp.value),
                 number_cell(t.errors.worst.value), number_cell(reached(t.x_ulps, 0.5, t.x_ulp)),
                 number_cell(t.x_ulp.value)}};
        if (t.wrong_cases() == 0 && t.value_ulp.value <= 0) row.tone = Tone::good;
        table.rows.push_back(std::move(row));
    }
    d.section("Which point of the reference cell is taken to a point, and the value there");
    d.add(std::move(table));
    d.notes(
        {"no answer: of points in the cell or on its boundary. in, on, out: inside, on the boundary, outside, exactly.",
         "values: errors where a point is rightly told inside, in units in the last place of the exact value, and in",
         "parts of the range of the values at the nodes. x: of the worst reference coordinate; of pyramids the "
         "third."});
}

Json tally_json(const InverseTally& t) {
    Json j = record(MEMBERS(t, cases), "wrong_cases", t.wrong_cases());
    for (std::size_t i = 0; i < 3; ++i)
        put(j, name(all_regions[i]),
            record("inside", t.told[i][0], "outside", t.told[i][1], "no_answer", t.told[i][2]));
    put(j, "measured", t.errors.total(), "median_value_ulps", magnitude(reached(t.value_ulps, 0.5, t.value_ulp)),
        "worst_value_ulps", magnitude(t.value_ulp.value), "worst_value_error", magnitude(t.errors.worst.value),
        "median_x_ulps", magnitude(reached(t.x_ulps, 0.5, t.x_ulp)), "worst_x_ulps", magnitude(t.x_ulp.value));
    return j;
}

Json case_json(const InverseRule& rule, const InverseFamily& family, std::uint64_t seed, std::uint64_t index) {
    const InverseCase c = make_inverse_case(family, rule.type, seed, index);
    const InverseAnswer answer = rule.answer(c);
    const ExactInverse exact = exact_inverse(c);
    return record("case", index, "nodes", list(c.nodes, base::hexadecimal), "values", list(c.values, base::hexadecimal),
                  "point", list(c.point, base::hexadecimal), "answer", record(MEMBERS(answer, found, inside, x, value)),
                  "exact", record(MEMBERS(exact, region, x, value)));
}

// Both.

/// How many are wrong; `tables`; each rule with the families that show its faults, worst first; the families; how it
/// was made. rule_json(rule); worst_of(tally): the largest error.
Document rules_document(std::string title, const auto& audit, const auto& families, Document tables,
                        const auto& rule_json, const auto& worst_of) {
    Document d;
    d.title = d.heading = std::move(title);
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
        std::ranges::stable_sort(own, std::greater(), share_of_wrong);
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
                        Json j = rule_json(r.rule);
                        put(j, "total", tally_json(r.total), "families", list(r.families, [&](const auto& t) {
                                const auto& family = families[t.family];
                                Json of = record("family", family.name);
                                of.update(tally_json(t));
                                const WorstCase worst = worst_of(t);
                                if (t.wrong.value > 0)
                                    put(of, "first_wrong", case_json(r.rule, family, audit.seed, t.wrong.index));
                                if (worst.value > 0)
                                    put(of, "worst", case_json(r.rule, family, audit.seed, worst.index));
                                return of;
                            }));
                        return j;
                    }));
    return d;
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
    return rules_document("Rules on triangles in space", audit, surface_families(), std::move(tables), rule,
                          [](const SurfaceTally& t) { return t.worst; });
}

Document inverses_document(const InverseAudit& audit) {
    Document tables;
    tell_rules(tables, audit);
    const auto rule = [](const InverseRule& r) { return record(MEMBERS(r, name, type, formula, source, fails)); };
    return rules_document("Inverse maps of cells", audit, inverse_families(), std::move(tables), rule,
                          [](const InverseTally& t) { return t.errors.worst; });
}

}  // namespace

std::string surfaces_text(const SurfaceAudit& audit, const TerminalStyle& style) {
    return written_text([&] { return surfaces_document(audit); }, style.colour);
}

std::string surfaces_json(const SurfaceAudit& audit) {
    return written_json([&] { return surfaces_document(audit); }, 1);
}

std::string surfaces_html(const SurfaceAudit& audit) {
    return written_page([&] { return surfaces_document(audit); });
}

std::string inverses_text(const InverseAudit& audit, const TerminalStyle& style) {
    return written_text([&] { return inverses_document(audit); }, style.colour);
}

std::string inverses_json(const InverseAudit& audit) {
    return written_json([&] { return inverses_document(audit); }, 1);
}

std::string inverses_html(const InverseAudit& audit) {
    return written_page([&] { return inverses_document(audit); });
}

}  // namespace barycert
