#include "tests/systems/league.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

namespace barycert::systems {
namespace {

using Json = nlohmann::ordered_json;

std::string share(std::uint64_t count, std::uint64_t of) {
    if (of == 0) return "-";
    if (count == 0) return "0";
    const double percent = 100 * static_cast<double>(count) / static_cast<double>(of);
    return percent < 0.001 ? fmt::format("{} (<0.001 %)", count) : fmt::format("{} ({:.2g} %)", count, percent);
}

std::string percent(std::uint64_t count, std::uint64_t of) {
    if (count == 0) return "0";
    const double p = 100 * static_cast<double>(count) / static_cast<double>(of);
    return p >= 99.95 && count != of ? "99.9" : fmt::format("{:.2g}", p);
}

/// Over meshes; 0 if there are none.
double median(std::vector<double> numbers) {
    if (numbers.empty()) return 0;
    std::sort(numbers.begin(), numbers.end());
    return numbers[numbers.size() / 2];
}

Json tally_json(const Tally& t) {
    Json j{{"points", t.points},
           {"inside", t.inside},
           {"outside", t.outside},
           {"inside_called_outside", t.missed},
           {"outside_called_inside", t.invented}};
    j["owner_does_not_contain"] = t.has_cells ? Json(t.wrong_cell) : Json();
    j["max_value_error"] = !t.has_values ? Json() : std::isfinite(t.max_error) ? Json(t.max_error) : Json("inf");
    return j;
}

void summary(std::string& text, const League& league, CellKind kind) {
    text +=
        "| system | version | inside called outside | outside called inside | owner does not contain the point | "
        "worst value error / range | ns a random point |\n|---|---|---|---|---|---|---|\n";
    for (const Standing& s : league.standings) {
        if (s.kind != kind) continue;
        if (!s.why_not.empty()) {
            text += fmt::format("| {} | {} | | | | | |\n", s.name, s.why_not);
            continue;
        }
        if (s.total.points == 0) {
            text += fmt::format("| {} | {} | no answers | | | | |\n", s.name, s.version);
            continue;
        }
        const Tally& t = s.total;
        text += fmt::format("| {} | {} | {} | {} | {} | {} | {} |\n", s.name, s.version, share(t.missed, t.inside),
                            share(t.invented, t.outside), t.has_cells ? share(t.wrong_cell, t.inside - t.missed) : "-",
                            t.has_values ? fmt::format("{:.2g}", t.max_error) : "-",
                            s.ns.empty() ? "-" : fmt::format("{:.0f}", median(s.ns)));
    }
}

/// Says, in words, which systems ended before they answered.
void failures(std::string& text, const League& league, CellKind kind) {
    for (const Standing& s : league.standings) {
        if (s.kind != kind) continue;
        const auto list = [&](const char* what, const std::vector<std::string>& reasons) {
            if (reasons.empty()) return;
            text += fmt::format("\n{}, {}:\n\n", s.name, what);
            for (const std::string& reason : reasons) text += fmt::format("- {}\n", reason);
        };
        list("not counted above", s.failures);
        list("counted, but not timed", s.not_timed);
    }
}

/// By sets of points, or by meshes; `values`: with errors of values.
void by_name(std::string& text, const League& league, CellKind kind, std::map<std::string, Tally> Standing::*tallies,
             const std::vector<std::pair<std::string, std::string>>& names, bool values) {
    std::string rule = "|---|";
    text += values ? "| mesh |" : "| points |";
    for (const Standing& s : league.standings) {
        if (s.kind != kind || !s.why_not.empty()) continue;
        text += ' ' + s.name + " |";
        rule += "---|";
    }
    text += '\n' + rule + '\n';
    for (const auto& [name, recipe] : names) {
        std::string line = "| " + name + " |";
        bool any = false;
        for (const Standing& s : league.standings) {
            if (s.kind != kind || !s.why_not.empty()) continue;
            const auto found = (s.*tallies).find(name);
            if (found == (s.*tallies).end()) {
                line += " |";
                continue;
            }
            any = true;
            const Tally& t = found->second;
            line += fmt::format(" {} / {} / {}", percent(t.missed, t.points), percent(t.invented, t.points),
                                t.has_cells ? percent(t.wrong_cell, t.points) : "-");
            if (values) line += fmt::format(" / {}", t.has_values ? fmt::format("{:.2g}", t.max_error) : "-");
            line += " |";
        }
        if (any) text += line + '\n';
    }
}

}  // namespace

void Tally::add(const Verdicts& v, bool cells, bool values) {
    points += v.rows;
    inside += v.inside;
    outside += v.outside;
    missed += v.missed;
    invented += v.invented;
    wrong_cell += v.wrong_cell;
    has_cells = has_cells || cells;
    has_values = has_values || values;
    if (values) max_error = std::max(max_error, v.columns.at(0).max_relative);
}

std::string league_markdown(const League& league) {
    std::string text = fmt::format("{} points of each set on each mesh, seed {}.\n", league.count, league.seed);
    for (const CellKind kind : all_kinds) {
        if (std::none_of(league.standings.begin(), league.standings.end(),
                         [&](const Standing& s) { return s.kind == kind; }))
            continue;
        text += kind == CellKind::tetrahedra  ? "\n### Tetrahedra\n\n"
                : kind == CellKind::triangles ? "\n### Triangles\n\n"
                                              : "\n### Other cells\n\n";
        summary(text, league, kind);
        failures(text, league, kind);
        text +=
            "\nBy set of points, in percent of its points: inside called outside / outside called inside / owner "
            "does not contain the point.\n\n";
        by_name(text, league, kind, &Standing::by_set, league.sets, false);
        if (kind != CellKind::others) continue;
        text += "\nBy mesh, the same; and the worst value error / range.\n\n";
        by_name(text, league, kind, &Standing::by_mesh, league.meshes, true);
    }
    text += "\nSets of points:\n\n";
    for (const auto& [name, recipe] : league.sets) text += fmt::format("- {}: {}\n", name, recipe);
    text += "\nMeshes:\n\n";
    for (const auto& [name, about] : league.meshes) text += fmt::format("- {}: {}\n", name, about);
    return text;
}

std::string league_json(const League& league) {
    Json j{{"schema", 1}, {"command", "systems"}, {"seed", league.seed}, {"count", league.count}};
    for (const auto& [name, about] : league.meshes) j["meshes"][name] = about;
    for (const auto& [name, recipe] : league.sets) j["sets"][name] = recipe;
    j["systems"] = Json::array();
    for (const Standing& s : league.standings) {
        Json row{{"name", s.name}, {"version", s.version}, {"dimension", s.kind == CellKind::triangles ? 2 : 3}};
        if (!s.why_not.empty()) row["not_run"] = s.why_not;
        row["total"] = tally_json(s.total);
        row["ns_a_random_point"] = s.ns.empty() ? Json() : Json(median(s.ns));
        for (const auto& [name, t] : s.by_set) row["by_set"][name] = tally_json(t);
        for (const auto& [name, t] : s.by_mesh) row["by_mesh"][name] = tally_json(t);
        row["failures"] = s.failures;
        row["not_timed"] = s.not_timed;
        j[s.kind == CellKind::others ? "systems_of_other_cells" : "systems"].push_back(row);
    }
    return j.dump(2) + "\n";
}

}  // namespace barycert::systems
