// Inverse maps of cells by Newton's method, held against proved answers.

#include "barycert/report/audit/rules.hpp"

namespace barycert {

using namespace report;

namespace {

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

Json case_json(const InverseRule& rule, const InverseFamily& family, std::uint64_t seed, std::uint64_t index) {
    const InverseCase c = make_inverse_case(family, rule.type, seed, index);
    const InverseAnswer answer = rule.answer(c);
    const ExactInverse exact = exact_inverse(c);
    return record("case", index, "nodes", list(c.nodes, base::hexadecimal), "values", list(c.values, base::hexadecimal),
                  "point", list(c.point, base::hexadecimal), "answer", record(MEMBERS(answer, found, inside, x, value)),
                  "exact", record(MEMBERS(exact, region, x, value)));
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

Document inverses_document(const InverseAudit& audit) {
    Document tables;
    tell_rules(tables, audit);
    const auto rule = [](const InverseRule& r) { return record(MEMBERS(r, name, type, formula, source, fails)); };
    const auto cases = [&](const InverseRule& r, const InverseTally& t, Json& j) {
        const InverseFamily& family = inverse_families()[t.family];
        if (t.wrong.value > 0) put(j, "first_wrong", case_json(r, family, audit.seed, t.wrong.index));
        if (t.errors.worst.value > 0) put(j, "worst", case_json(r, family, audit.seed, t.errors.worst.index));
    };
    return rules_document("Inverse maps of cells", audit, inverse_families(), std::move(tables), rule, tally_json,
                          cases);
}

}  // namespace

RULES_WRITERS(inverses, InverseAudit)

}  // namespace barycert
