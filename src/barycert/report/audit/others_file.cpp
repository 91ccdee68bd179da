#include <cmath>
#include <nlohmann/json.hpp>

#include "barycert/audit/json_members.hpp"
#include "barycert/audit_report.hpp"
#include "barycert/base/input_file.hpp"
#include "barycert/environment.hpp"

namespace barycert {

using namespace audit;

namespace {

using OthersJson = nlohmann::json;

/// A page of so many cells of tables is none that anybody reads.
constexpr std::size_t max_cells = 20000;

[[noreturn]] void refuse(const std::string& where, const std::string& expected, const std::string& found) {
    throw Exception({.what = where, .expected = expected, .found = found});
}

std::vector<std::string> texts_in(const OthersJson& object, const std::string& key, const std::string& where) {
    std::vector<std::string> texts;
    const std::string place = where + ", " + key;
    for (const OthersJson& j : list_in(object, key, where)) {
        if (!j.is_string()) refuse(place, "strings", found_json(j));
        texts.push_back(j.get<std::string>());
    }
    return texts;
}

/// A part of the cases or points: no more than there are.
std::uint64_t part_in(const OthersJson& object, const std::string& key, std::uint64_t whole, const std::string& where) {
    const std::uint64_t n = count_in(object, key, where);
    if (n > whole) refuse(where + ", " + key, "at most " + std::to_string(whole), std::to_string(n));
    return n;
}

/// A number >= 0, "inf", or null: nothing.
std::optional<double> figure_or_null(const OthersJson& object, const std::string& key, const std::string& where) {
    const OthersJson& j = member(object, key, where);
    if (j.is_null()) return std::nullopt;
    if (j == "inf") return HUGE_VAL;
    if (!j.is_number() || !(j.get<double>() >= 0)) refuse(where + ", " + key, "a number >= 0 or null", found_json(j));
    return j.get<double>();
}

FlagsMatrix::Cell cell_from(const OthersJson& j, const std::string& where) {
    FlagsMatrix::Cell c;
    c.cases = count_in(j, "cases", where);
    c.changed = part_in(j, "changed", c.cases, where);
    c.wrong = part_in(j, "wrong", c.cases, where);
    c.newly_wrong = part_in(j, "newly_wrong", c.wrong, where);
    c.newly_right = part_in(j, "newly_right", c.cases - c.wrong, where);
    return c;
}

FlagsMatrix flags_from(const OthersJson& all) {
    FlagsMatrix m;
    const std::string top = "the flags matrix";
    m.seed = count_in(all, "seed", top);
    m.count = count_in(all, "count", top);
    m.families = list_in(all, "families", top).size();
    m.compilers = texts_in(all, "compilers", top);
    for (const OthersJson& j : list_in(all, "columns", top)) {
        const std::string where = "column " + std::to_string(m.columns.size());
        m.columns.push_back({text_in(j, "compiler", where), text_in(j, "label", where), text_in(j, "flags", where)});
    }
    const OthersJson& rows = list_in(all, "rows", top);
    if (rows.size() * m.columns.size() > max_cells)
        refuse(top, "at most " + std::to_string(max_cells) + " cells", std::to_string(rows.size() * m.columns.size()));
    for (const OthersJson& j : rows) {
        FlagsMatrix::Row row{text_in(j, "kernel", "row " + std::to_string(m.rows.size())), {}};
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
    s.max_value_error = figure_or_null(t, "max_value_error", total);
    s.ns = figure_or_null(j, "ns_a_random_point", s.name);
    s.failures = texts_in(j, "failures", s.name);
    if (j.contains("not_timed")) {
        for (const std::string& text : texts_in(j, "not_timed", s.name)) s.failures.push_back("not timed: " + text);
    }
    return s;
}

SystemsLeague systems_from(const OthersJson& all) {
    SystemsLeague league;
    const std::string top = "the league of systems";
    league.seed = count_in(all, "seed", top);
    league.count = count_in(all, "count", top);
    const OthersJson& systems = list_in(all, "systems", top);
    if (systems.size() > max_cells)
        refuse(top, "at most " + std::to_string(max_cells) + " systems", std::to_string(systems.size()));
    for (const OthersJson& j : systems)
        league.standings.push_back(standing_from(j, "system " + std::to_string(league.standings.size())));
    return league;
}

}  // namespace

Result<OtherResults> read_other_results(const std::string& path) {
    const ExactEnvironment environment;
    const char* const remedy = "make one with `./run flags --json FILE` or `./run systems --json FILE`";
    const Result<std::string> text = base::read_file(path, base::longest_pipe, base::Text::json);
    if (!text) return text.error();
    const OthersJson all = OthersJson::parse(*text, nullptr, false);
    if (all.is_discarded())
        return Error{.what = "neither a flags matrix nor a league of systems",
                     .file = path,
                     .expected = "JSON",
                     .found = "something else, or a part of it",
                     .remedy = remedy};
    try {
        const std::string command = text_in(all, "command", "the file");
        if (command != "flags" && command != "systems")
            refuse("the file, command", "\"flags\" or \"systems\"", found_json(all.at("command")));
        if (const std::uint64_t schema = count_in(all, "schema", "the file"); schema != 1)
            refuse("the file, schema", "1", std::to_string(schema));
        if (command == "flags") return OtherResults(flags_from(all));
        return OtherResults(systems_from(all));
    } catch (const Exception& e) {
        Error error = e.error();
        error.file = path;
        error.remedy = remedy;
        return error;
    }
}

}  // namespace barycert
