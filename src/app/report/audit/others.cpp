// Measurements of `./run flags` and `./run systems`: read, and shown as tables that sort.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "app/report/audit/audit_words.hpp"
#include "app/report/common/document.hpp"
#include "app/report/common/terminal_text.hpp"
#include "audit/json_members.hpp"
#include "barycert/audit_report.hpp"
#include "barycert/environment.hpp"
#include "barycert/result.hpp"

namespace barycert {

using namespace audit;

namespace {

using OthersJson = nlohmann::json;

/// A page of so many cells of tables is none that anybody reads.
constexpr std::size_t max_cells = 20000;

void expect_at_most(std::uint64_t most, std::uint64_t n, const std::string& where, const char* what = "") {
    if (n > most) refuse(where, fmt::format("at most {}{}", most, what), std::to_string(n));
}

std::vector<std::string> texts_in(const OthersJson& object, const std::string& key, const std::string& where) {
    std::vector<std::string> texts;
    for (const OthersJson& j : list_in(object, key, where)) {
        if (!j.is_string()) refuse(fmt::format("{}, {}", where, key), "strings", found_json(j));
        texts.push_back(j.get<std::string>());
    }
    return texts;
}

/// A part of the cases or points: no more than there are.
std::uint64_t part_in(const OthersJson& object, const std::string& key, std::uint64_t whole, const std::string& where) {
    const std::uint64_t n = count_in(object, key, where);
    expect_at_most(whole, n, where + ", " + key);
    return n;
}

/// "inf" where an answer was not finite.
std::optional<double> figure_or_inf(const OthersJson& object, const std::string& key, const std::string& where) {
    return member(object, key, where) == "inf" ? HUGE_VAL : figure_in(object, key, where);
}

FlagsMatrix::Cell cell_from(const OthersJson& j, const std::string& where) {
    FlagsMatrix::Cell c{.cases = count_in(j, "cases", where)};
    c.changed = part_in(j, "changed", c.cases, where);
    c.wrong = part_in(j, "wrong", c.cases, where);
    c.newly_wrong = part_in(j, "newly_wrong", c.wrong, where);
    c.newly_right = part_in(j, "newly_right", c.cases - c.wrong, where);
    return c;
}

FlagsMatrix flags_from(const OthersJson& all) {
    const std::string top = "the flags matrix";
    FlagsMatrix m{count_in(all, "seed", top),
                  count_in(all, "count", top),
                  list_in(all, "families", top).size(),
                  texts_in(all, "compilers", top),
                  {},
                  {}};
    for (const OthersJson& j : list_in(all, "columns", top)) {
        const std::string where = "column " + std::to_string(m.columns.size());
        m.columns.push_back({text_in(j, "compiler", where), text_in(j, "label", where), text_in(j, "flags", where)});
    }
    const OthersJson& rows = list_in(all, "rows", top);
    expect_at_most(max_cells, rows.size() * m.columns.size(), top, " cells");
    for (const OthersJson& j : rows) {
        FlagsMatrix::KernelAnswers row{text_in(j, "kernel", "row " + std::to_string(m.rows.size())), {}};
        const OthersJson& cells = list_in(j, "cells", row.kernel);
        if (cells.size() != m.columns.size())
            refuse(row.kernel, std::to_string(m.columns.size()) + " cells, one a column", std::to_string(cells.size()));
        for (const OthersJson& cell : cells)
            row.cells.push_back(cell_from(cell, row.kernel + ", cell " + std::to_string(row.cells.size())));
        m.rows.push_back(std::move(row));
    }
    return m;
}

SystemsLeague::Standing standing_from(const OthersJson& j, const std::string& where) {
    SystemsLeague::Standing s;
    s.name = text_in(j, "name", where);
    s.version = text_in(j, "version", s.name);
    const std::uint64_t dimension = count_in(j, "dimension", s.name);
    if (dimension != 2 && dimension != 3) refuse(s.name + ", dimension", "2 or 3", std::to_string(dimension));
    s.dimension = static_cast<int>(dimension);
    if (j.contains("not_run")) s.not_run = text_in(j, "not_run", s.name);
    const OthersJson& t = member(j, "total", s.name);
    const std::string total = s.name + ", total";
    s.points = count_in(t, "points", total);
    s.inside = part_in(t, "inside", s.points, total);
    s.outside = part_in(t, "outside", s.points - s.inside, total);
    s.inside_called_outside = part_in(t, "inside_called_outside", s.inside, total);
    s.outside_called_inside = part_in(t, "outside_called_inside", s.outside, total);
    if (!member(t, "owner_does_not_contain", total).is_null())
        s.wrong_owner = part_in(t, "owner_does_not_contain", s.points, total);
    s.max_value_error = figure_or_inf(t, "max_value_error", total);
    s.ns = figure_or_inf(j, "ns_a_random_point", s.name);
    s.failures = texts_in(j, "failures", s.name);
    if (j.contains("not_timed")) {
        for (const std::string& text : texts_in(j, "not_timed", s.name)) s.failures.push_back("not timed: " + text);
    }
    return s;
}

SystemsLeague systems_from(const OthersJson& all) {
    const std::string top = "the league of systems";
    SystemsLeague league{count_in(all, "seed", top), count_in(all, "count", top), {}};
    const OthersJson& systems = list_in(all, "systems", top);
    expect_at_most(max_cells, systems.size(), top, " systems");
    for (const OthersJson& j : systems)
        league.standings.push_back(standing_from(j, "system " + std::to_string(league.standings.size())));
    return league;
}

}  // namespace

Result<OtherResults> read_other_results(const std::string& path) {
    const ExactEnvironment environment;
    const char* const remedy = "make one with `./run flags --json FILE` or `./run systems --json FILE`";
    const JsonFile file{.cannot_read = "cannot read the flags matrix or league of systems",
                        .is_none = "neither a flags matrix nor a league of systems",
                        .name = "the file",
                        .remedy = remedy,
                        .remedy_of_members = remedy};
    return made_of_json(path, file, [](const OthersJson& all) -> OtherResults {
        const std::string command = text_in(all, "command", "the file");
        if (command == "flags") return flags_from(all);
        if (command == "systems") return systems_from(all);
        refuse("the file, command", "\"flags\" or \"systems\"", found_json(all.at("command")));
    });
}

namespace report {
namespace {

/// The columns in which something changes, or the others.
std::vector<std::size_t> columns_of(const FlagsMatrix& m, bool change) {
    std::vector<std::size_t> some;
    for (std::size_t c = 0; c < m.columns.size(); ++c) {
        if (change == std::ranges::any_of(m.rows, [&](const auto& row) { return row.cells[c].changed != 0; }))
            some.push_back(c);
    }
    return some;
}

std::string name_of(const FlagsMatrix::Column& column) {
    return column.compiler + " " + column.label;
}

void tell_matrix(Document& d, const FlagsMatrix& m, std::string heading, std::uint64_t FlagsMatrix::Cell::*part,
                 bool red) {
    Listing table{.columns = {left("formula")}, .sorts = true};
    const std::vector<std::size_t> columns = columns_of(m, true);
    for (const std::size_t c : columns)
        table.columns.push_back({.head = name_of(m.columns[c]), .tip = m.columns[c].flags});
    for (const FlagsMatrix::KernelAnswers& row : m.rows) {
        Row& shares = table.rows.emplace_back(Row{{row.kernel}});
        for (const std::size_t c : columns)
            shares.cells.push_back(share_cell({row.cells[c].*part, row.cells[c].cases}, red));
    }
    d.section(std::move(heading), For::all, 3);
    d.add(std::move(table));
}

void tell_results(Document& d, const FlagsMatrix& m) {
    const std::string same = joined(columns_of(m, false), "; ", [&](std::size_t c) { return name_of(m.columns[c]); });
    d.section("Formulas under compiler flags");
    d.say(fmt::format("From `./run flags`: {} cases of each of {} families, seed {}. {}. In per cent of the cases of a "
                      "formula.",
                      m.count, m.families, m.seed, fmt::join(m.compilers, "; ")),
          Tone::soft);
    if (!same.empty()) d.say(fmt::format("No answer changes under: {}.", same), Tone::soft);
    if (m.rows.empty() || m.columns.empty()) return;
    tell_matrix(d, m, "Answers that change by a bit or more", &FlagsMatrix::Cell::changed, false);
    tell_matrix(d, m, "Answers that get wrong", &FlagsMatrix::Cell::newly_wrong, true);
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

void tell_results(Document& d, const SystemsLeague& league) {
    d.section("Systems: point location and interpolation");
    d.say(
        fmt::format("From `./run systems`: {} points of each set on each mesh, seed {}, held against the exact owners "
                    "and values. In per cent of the points inside, outside, and of those inside that were found. "
                    "Error: of a value, in parts of the field's range. ns: median time of a random point.",
                    league.count, league.seed),
        Tone::soft);
    for (const int dimension : {3, 2}) {
        Listing table{.columns = {left("system"), left("version"), right("inside called outside, %"),
                                  right("outside called inside, %"), right("owner does not contain the point, %"),
                                  right("largest error"), right("ns")},
                      .sorts = true};
        Item failures{.title = "Without an answer, and not counted:"};
        for (const SystemsLeague::Standing& s : league.standings) {
            if (s.dimension != dimension) continue;
            table.rows.push_back(standing_row(s));
            for (const std::string& failure : s.failures) failures.lines.push_back({s.name + ", " + failure});
        }
        if (table.rows.empty()) continue;
        d.section(dimension == 3 ? "On meshes of tetrahedra" : "On meshes of triangles", For::all, 3);
        d.add(std::move(table));
        if (!failures.lines.empty()) d.add(std::move(failures));
    }
}

}  // namespace

void tell_others(Document& d, const std::vector<OtherResults>& others) {
    for (const OtherResults& o : others) std::visit([&](const auto& results) { tell_results(d, results); }, o);
}

}  // namespace report
}  // namespace barycert
