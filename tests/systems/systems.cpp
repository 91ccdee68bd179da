// The league table of systems: what they answer on our points, held against the exact owners and values.
//
//     systems [--count N] [--seed N] [--mesh NAME]... [--system NAME]... [--json FILE] [--list]
//
// The table goes to the standard output, as Markdown. Each system runs in a process of its own, on one thread.
#include <sys/wait.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>

#include "barycert/sampler.hpp"
#include "systems/exchange.hpp"
#include "systems/league.hpp"
#include "systems/point_sets.hpp"
#include "systems/test_meshes.hpp"

namespace {

using namespace barycert;
using namespace barycert::systems;
namespace fs = std::filesystem;

/// A folder that goes when it is done with.
class Folder {
public:
    Folder() {
        std::string name = (fs::temp_directory_path() / "barycert-systems-XXXXXX").string();
        if (::mkdtemp(name.data()) == nullptr) std::exit(2);
        path_ = name;
    }
    ~Folder() {
        std::error_code ignored;
        fs::remove_all(path_, ignored);
    }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;
    const std::string& path() const { return path_; }
    std::string operator/(const char* name) const { return path_ + '/' + name; }

private:
    std::string path_;
};

/// What a command prints; returns how it ended, as the shell tells: 0 well, 124 by `timeout`.
int run(const std::string& command, std::string& output) {
    output.clear();
    std::FILE* const pipe = ::popen(command.c_str(), "r");
    if (pipe == nullptr) return -1;
    char buffer[4096];
    while (std::fgets(buffer, sizeof buffer, pipe) != nullptr) output += buffer;
    while (!output.empty() && output.back() == '\n') output.pop_back();
    const int status = ::pclose(pipe);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

/// The python3 that has the module; the first of the path need not be the one that Debian's packages are for.
std::string python_with(const std::string& module) {
    std::string ignored;
    for (const char* const python : {"python3", "/usr/bin/python3"})
        if (run(std::string(python) + " -c 'import " + module + "' 2>/dev/null", ignored) == 0) return python;
    return {};
}

std::vector<System> all_systems() {
    std::vector<System> all{{"barycert", BARYCERT_SYSTEM_BARYCERT " all"}};
#ifdef BARYCERT_SYSTEM_VTK
    all.push_back({"vtkStaticCellLocator", BARYCERT_SYSTEM_VTK " static-locator"});
    all.push_back({"vtkCellTreeLocator", BARYCERT_SYSTEM_VTK " cell-tree"});
    all.push_back({"vtkCellLocator", BARYCERT_SYSTEM_VTK " cell-locator"});
    all.push_back({"vtkProbeFilter", BARYCERT_SYSTEM_VTK " probe"});
    all.push_back({"vtkResampleWithDataSet", BARYCERT_SYSTEM_VTK " resample"});
#endif
    all.push_back({"CGAL locate, exact predicates", BARYCERT_SYSTEM_CGAL " exact-predicates", true});
    all.push_back({"CGAL locate, plain doubles", BARYCERT_SYSTEM_CGAL " inexact", true, 0, 10});
    const std::string script = " " BARYCERT_SYSTEM_PYTHON " ", scipy = python_with("scipy"),
                      matplotlib = python_with("matplotlib");
    const auto by = [&](const std::string& python, const char* system) {
        return python.empty() ? python : python + script + system;
    };
    all.push_back({"SciPy find_simplex", by(scipy, "find_simplex"), true});
    all.push_back({"SciPy LinearNDInterpolator", by(scipy, "LinearNDInterpolator"), true});
    all.push_back({"matplotlib TrapezoidMapTriFinder", by(matplotlib, "TriFinder"), false, 2});
    return all;
}

/// Asks a system for one mesh, and judges its answers. Returns why there are none.
std::string ask(const System& system, const NamedMesh& asked, const League& league, Standing& standing) {
    const Folder folder;
    const auto call = [&](const char* task) -> std::string {
        std::string version;
        const int code = run("timeout " + std::to_string(system.limit) + ' ' + system.command + ' ' + task + ' ' +
                                 folder.path() + " 2>/dev/null",
                             version);
        if (code == 124) return "did not end in " + std::to_string(system.limit) + " s";
        if (code != 0) return "ended by itself with code " + std::to_string(code);
        standing.version = version;
        return {};
    };
    Mesh mesh = asked.mesh;
    write_array(folder / "dimension.i32", std::vector<std::int32_t>{mesh.dimension});
    write_array(folder / "nodes.f64", mesh.points);
    write_array(folder / "values.f64", mesh.point_fields.at(0).data);
    if (system.own_triangulation) {
        if (const std::string why = call("triangulate"); !why.empty()) return why;
        mesh.cells = read_array<std::int32_t>(folder / "cells.i32");
    } else {
        write_array(folder / "cells.i32", mesh.cells);
    }
    const Points points = make_points(mesh, league.count, league.seed);
    write_array(folder / "points.f64", points.coordinates);
    if (const std::string why = call("locate"); !why.empty()) return why;
    const auto owners = read_array<std::int64_t>(folder / "owners.i64");
    const auto sampled = read_array<double>(folder / "sampled.f64"),
               seconds = read_array<double>(folder / "seconds.f64");
    const std::size_t count = points.coordinates.size() / static_cast<std::size_t>(mesh.dimension);
    if ((owners.size() != count && !owners.empty()) || (sampled.size() != count && !sampled.empty()) ||
        seconds.size() != 2)
        return "wrote something else";
    const Locator locator = Locator::build(mesh).value();
    std::vector<FieldChoice> fields;
    if (!sampled.empty()) fields.push_back({.field = &mesh.point_fields.at(0)});
    const Sampler sampler = Sampler::build(locator, fields).value();
    const Verifier verifier(sampler, {});
    for (const PointSet& set : points.sets) {
        ClaimedRows rows;
        const auto d = static_cast<std::size_t>(mesh.dimension);
        rows.points = std::span(points.coordinates).subspan(d * set.first, d * set.count);
        if (!owners.empty()) rows.cells = std::span(owners).subspan(set.first, set.count);
        if (!sampled.empty()) rows.values = std::span(sampled).subspan(set.first, set.count);
        const Verdicts verdicts = verifier.verify(rows).value();
        for (Tally* const tally : {&standing.total, &standing.by_set[set.name], &standing.by_mesh[asked.name]})
            tally->add(verdicts, !owners.empty(), !sampled.empty());
    }

    // Times are of random points in the box alone: what users ask for.
    const Points more = make_points(mesh, 20000, league.seed + 1);
    const auto box =
        std::find_if(more.sets.begin(), more.sets.end(), [](const PointSet& set) { return set.name == "box"; });
    const auto d = static_cast<std::size_t>(mesh.dimension);
    const auto random = std::span(more.coordinates).subspan(d * box->first, d * box->count);
    write_array(folder / "points.f64", std::vector<double>(random.begin(), random.end()));
    if (const std::string why = call("locate"); !why.empty()) return "random points alone: " + why;
    standing.ns.push_back(1e9 * read_array<double>(folder / "seconds.f64").at(1) / static_cast<double>(box->count));
    return {};
}

bool chosen(const std::vector<std::string>& names, const std::string& name) {
    return names.empty() || std::find(names.begin(), names.end(), name) != names.end();
}

}  // namespace

int main(int count, char** words) {
    CLI::App app("League table of systems: point location and interpolation, held against exact answers",
                 "./run systems");
    League league;
    league.count = 5000;
    std::vector<std::string> only_meshes, only_systems;
    std::string json;
    bool list = false;
    app.add_option("--count", league.count, "Points of each set on each mesh")->capture_default_str();
    app.add_option("--seed", league.seed, "Of the points")->capture_default_str();
    app.add_option("--mesh", only_meshes, "Only this mesh; may be repeated");
    app.add_option("--system", only_systems, "Only this system; may be repeated");
    app.add_option("--json", json, "Also write all counts");
    app.add_flag("--list", list, "Print the names of systems and meshes");
    CLI11_PARSE(app, count, words);

    const std::vector<System> all = all_systems();
    std::vector<NamedMesh> meshes = meshes_for_systems();
    if (list) {
        for (const System& s : all) std::printf("system  %s\n", s.name.c_str());
        for (const NamedMesh& m : meshes) std::printf("mesh    %s: %s\n", m.name.c_str(), m.about.c_str());
        return 0;
    }
    std::erase_if(meshes, [&](const NamedMesh& m) { return !chosen(only_meshes, m.name); });
    for (const NamedMesh& m : meshes) {
        league.meshes.emplace_back(m.name, m.about);
        if (m.mesh.cell_count() == 0) continue;
        for (const PointSet& set : make_points(m.mesh, 0, 0).sets) {
            const std::pair<std::string, std::string> named(set.name, set.recipe);
            if (std::find(league.sets.begin(), league.sets.end(), named) == league.sets.end())
                league.sets.push_back(named);
        }
    }
    for (const int dimension : {3, 2}) {
        for (const System& system : all) {
            if ((system.dimension != 0 && system.dimension != dimension) || !chosen(only_systems, system.name))
                continue;
            Standing standing;
            standing.name = system.name;
            standing.dimension = dimension;
            if (system.command.empty()) standing.why_not = "not installed";
            for (const NamedMesh& mesh : meshes) {
                if (mesh.mesh.dimension != dimension || system.command.empty()) continue;
                std::fprintf(stderr, "systems: %s, %s\n", system.name.c_str(), mesh.name.c_str());
                if (const std::string failure = ask(system, mesh, league, standing); !failure.empty())
                    standing.failures.push_back(mesh.name + ": " + failure);
            }
            league.standings.push_back(standing);
        }
    }
    std::fputs(league_markdown(league).c_str(), stdout);
    if (!json.empty()) {
        std::ofstream file(json);
        file << league_json(league);
        if (!file.flush()) {
            std::fprintf(stderr, "systems: cannot write %s\n", json.c_str());
            return 2;
        }
    }
    // barycert is in the table to be judged as well.
    const auto wrong = [](const Standing& s) {
        return s.name == "barycert" && (s.total.missed + s.total.invented + s.total.wrong_cell != 0 ||
                                        s.total.max_error != 0 || !s.failures.empty());
    };
    return std::any_of(league.standings.begin(), league.standings.end(), wrong) ? 1 : 0;
}
