// What `./run flags` and `./run systems` measured, as tables that sort.

#include <fmt/format.h>

#include <algorithm>

#include "barycert/report/audit/audit_words.hpp"
#include "barycert/report/common/terminal_text.hpp"

namespace barycert::report {
namespace {

void tell_matrix(Document& d, const FlagsMatrix& m, std::string heading, auto part, bool red) {
    Listing table{.columns = {{"formula", true}}, .sorts = true};
    for (const FlagsMatrix::Row& row : m.rows) table.rows.push_back({{row.kernel}});
    // Columns in which nothing changes are left out.
    for (std::size_t c = 0; c < m.columns.size(); ++c) {
        if (std::all_of(m.rows.begin(), m.rows.end(), [&](const auto& row) { return row.cells[c].changed == 0; }))
            continue;
        table.columns.push_back(
            {m.columns[c].compiler + " " + m.columns[c].label, false, 0, 1, "", m.columns[c].flags});
        for (std::size_t r = 0; r < m.rows.size(); ++r)
            table.rows[r].cells.push_back(share_cell({part(m.rows[r].cells[c]), m.rows[r].cells[c].cases}, red));
    }
    d.section(std::move(heading), For::page, 3);
    d.add(std::move(table), For::page);
}

void tell_flags(Document& d, const FlagsMatrix& m) {
    std::vector<std::string> same;
    for (std::size_t c = 0; c < m.columns.size(); ++c) {
        if (std::all_of(m.rows.begin(), m.rows.end(), [&](const auto& row) { return row.cells[c].changed == 0; }))
            same.push_back(m.columns[c].compiler + " " + m.columns[c].label);
    }
    d.section("Formulas under compiler flags", For::page);
    d.say(fmt::format("From `./run flags`: {} cases of each of {} families, seed {}. {}. In per cent of the cases of a "
                      "formula.",
                      m.count, m.families, m.seed, fmt::join(m.compilers, "; ")),
          Tone::soft, For::page);
    if (!same.empty()) d.say(fmt::format("No answer changes under: {}.", fmt::join(same, "; ")), Tone::soft, For::page);
    if (m.rows.empty() || m.columns.empty()) return;
    tell_matrix(
        d, m, "Answers that change by a bit or more", [](const FlagsMatrix::Cell& c) { return c.changed; }, false);
    tell_matrix(
        d, m, "Answers that get wrong", [](const FlagsMatrix::Cell& c) { return c.newly_wrong; }, true);
}

Row standing_row(const SystemsLeague::Standing& s) {
    const bool run = s.not_run.empty();
    // No share: an error of rounding is no wrong answer.
    const double error = run && s.points != 0 ? s.max_value_error.value_or(-1) : -1;
    const double ns = run ? s.ns.value_or(-1) : -1;
    return {{s.name,
             run ? s.version : s.not_run,
             share_cell({s.inside_called_outside, s.inside}, true),
             share_cell({s.outside_called_inside, s.outside}, true),
             share_cell({s.wrong_owner.value_or(0), s.wrong_owner ? s.inside - s.inside_called_outside : 0}, true),
             number_cell(error),
             {brief_time(ns), ns}}};
}

void tell_systems(Document& d, const SystemsLeague& league) {
    d.section("Systems: point location and interpolation", For::page);
    d.say(
        fmt::format("From `./run systems`: {} points of each set on each mesh, seed {}, held against the exact owners "
                    "and values. In per cent of the points inside, outside, and of those inside that were found. "
                    "Error: of a value, in parts of the field's range. ns: median time of a random point.",
                    league.count, league.seed),
        Tone::soft, For::page);
    for (const int dimension : {3, 2}) {
        Listing table{.columns = {{"system", true},
                                  {"version", true},
                                  {"inside called outside, %"},
                                  {"outside called inside, %"},
                                  {"owner does not contain the point, %"},
                                  {"largest error"},
                                  {"ns"}},
                      .sorts = true};
        Item failures{.title = "Without an answer, and not counted:"};
        for (const SystemsLeague::Standing& s : league.standings) {
            if (s.dimension != dimension) continue;
            table.rows.push_back(standing_row(s));
            for (const std::string& failure : s.failures) failures.lines.push_back({s.name + ", " + failure});
        }
        if (table.rows.empty()) continue;
        d.section(dimension == 3 ? "On meshes of tetrahedra" : "On meshes of triangles", For::page, 3);
        d.add(std::move(table), For::page);
        if (!failures.lines.empty()) d.add(std::move(failures), For::page);
    }
}

}  // namespace

void tell_others(Document& d, const std::vector<OtherResults>& others) {
    for (const OtherResults& o : others) {
        if (const auto* const flags = std::get_if<FlagsMatrix>(&o)) tell_flags(d, *flags);
        if (const auto* const systems = std::get_if<SystemsLeague>(&o)) tell_systems(d, *systems);
    }
}

}  // namespace barycert::report
