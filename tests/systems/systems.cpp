// The league table of systems: what they answer on our points, held against the exact owners and values.
//
//     systems [--count N] [--seed N] [--mesh NAME]... [--system NAME]... [--json FILE] [--list]
//
// The table goes to the standard output, as Markdown. Each system runs in a process of its own, on one thread. Exits
// with 1 if barycert is wrong somewhere, and with 2 if nothing could be asked.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdio>
#include <optional>
#include <string>

#include "files/output_file.hpp"
#include "tests/systems/asking.hpp"
#include "tests/systems/point_sets.hpp"

namespace {

using namespace barycert;
using namespace barycert::systems;

using Names = std::vector<std::string>;

constexpr int usage_error = 2;

int fail(const std::string& text) {
    std::fprintf(stderr, "systems: error: %s\n", text.c_str());
    return usage_error;
}

bool contains(const Names& names, const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

/// Says which of the names that were given is not known; nothing if all are.
std::string unknown_name(const char* kind, const Names& given, const Names& known) {
    for (const std::string& name : given) {
        if (!contains(known, name))
            return fmt::format("no {} is called '{}'; there are: {}", kind, name, fmt::join(known, "; "));
    }
    return {};
}

template <class Items>
Names names_of(const Items& items) {
    Names names;
    for (const auto& item : items) names.push_back(item.name);
    return names;
}

/// The meshes and sets of points that are in the table.
void describe(const std::vector<NamedMesh>& meshes, League& league) {
    for (const NamedMesh& m : meshes) {
        league.meshes.emplace_back(m.name, m.about);
        for (const PointSet& set : make_points(m.mesh, 0, 0).sets) {
            const std::pair<std::string, std::string> named(set.name, set.recipe);
            if (std::find(league.sets.begin(), league.sets.end(), named) == league.sets.end())
                league.sets.push_back(named);
        }
    }
}

Standing standing_of(const System& system, CellKind kind, const std::vector<NamedMesh>& meshes, const League& league) {
    Standing standing;
    standing.name = system.name;
    standing.kind = kind;
    if (system.command.empty()) {
        standing.why_not = "not installed";
        return standing;
    }
    for (const NamedMesh& mesh : meshes) {
        if (kind_of(mesh.mesh) != kind) continue;
        std::fprintf(stderr, "systems: %s, %s\n", system.name.c_str(), mesh.name.c_str());
        ask(system, mesh, league, standing);
    }
    return standing;
}

/// Why no system has answered.
std::string no_answers(const League& league) {
    std::string why = "no system has answered for any point";
    for (const Standing& s : league.standings) {
        if (!s.why_not.empty()) why += fmt::format("\n  {}: {}", s.name, s.why_not);
        for (const std::string& failure : s.failures) why += fmt::format("\n  {}: {}", s.name, failure);
    }
    return why;
}

/// barycert is in the table to be judged as well.
bool barycert_is_wrong(const Standing& s) {
    return s.name == "barycert" && (s.total.missed + s.total.invented + s.total.wrong_cell != 0 ||
                                    s.total.max_error != 0 || !s.failures.empty() || !s.not_timed.empty());
}

}  // namespace

int main(int count, char** words) {
    CLI::App app("League table of systems: point location and interpolation, held against exact answers",
                 "./run systems");
    League league;
    league.count = 5000;
    Names only_meshes, only_systems;
    std::string json;
    bool list = false;
    app.add_option("--count", league.count, "Points of each set on each mesh")
        ->capture_default_str()
        ->check(CLI::Range(1, 100000000));
    app.add_option("--seed", league.seed, "Of the points")->capture_default_str();
    app.add_option("--mesh", only_meshes, "Only this mesh; may be repeated");
    app.add_option("--system", only_systems, "Only this system; may be repeated");
    app.add_option("--json", json, "Also write all counts");
    app.add_flag("--list", list, "Print the names of systems and meshes");
    try {
        app.parse(count, words);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : usage_error;
    }

    const std::vector<System> all = all_systems();
    std::vector<NamedMesh> meshes = meshes_for_systems();
    if (list) {
        for (const System& s : all) std::printf("system  %s\n", s.name.c_str());
        for (const NamedMesh& m : meshes) std::printf("mesh    %s: %s\n", m.name.c_str(), m.about.c_str());
        return 0;
    }
    for (const std::string& wrong :
         {unknown_name("mesh", only_meshes, names_of(meshes)), unknown_name("system", only_systems, names_of(all))})
        if (!wrong.empty()) return fail(wrong);
    std::optional<base::OutputFile> file;
    if (!json.empty()) {
        file.emplace(json);
        if (const Status good = file->status(); !good) return fail(good.error().message());
    }

    std::erase_if(meshes, [&](const NamedMesh& m) { return !only_meshes.empty() && !contains(only_meshes, m.name); });
    describe(meshes, league);
    for (const CellKind kind : all_kinds) {
        if (std::none_of(meshes.begin(), meshes.end(), [&](const NamedMesh& m) { return kind_of(m.mesh) == kind; }))
            continue;
        for (const System& system : all) {
            if (!system.takes(kind) || (!only_systems.empty() && !contains(only_systems, system.name))) continue;
            league.standings.push_back(standing_of(system, kind, meshes, league));
        }
    }
    if (std::all_of(league.standings.begin(), league.standings.end(),
                    [](const Standing& s) { return s.total.points == 0; }))
        return fail(no_answers(league));
    std::fputs(league_markdown(league).c_str(), stdout);
    if (file) {
        file->write(league_json(league));
        if (const Status written = file->commit(); !written) return fail(written.error().message());
    }
    return std::any_of(league.standings.begin(), league.standings.end(), barycert_is_wrong) ? 1 : 0;
}
