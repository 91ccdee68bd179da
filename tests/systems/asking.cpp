#include "tests/systems/asking.hpp"

#include <sys/wait.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <fstream>

#include "barycert/sampler.hpp"
#include "core/base/text.hpp"
#include "tests/mesh/whole_cells.hpp"
#include "tests/scratch.hpp"
#include "tests/systems/exchange.hpp"
#include "tests/systems/point_sets.hpp"

namespace barycert::systems {
namespace {

using Words = std::vector<std::string>;

/// Runs a program: sets `output` to what it prints, and writes its messages to the file `messages`. Returns how it
/// ended, as a shell tells: 0 well, 124 by `timeout`, 128 and more by a signal.
int run(const Words& words, const std::string& messages, std::string& output) {
    std::string line;
    for (const std::string& word : words) line += base::shell_word(word) + ' ';
    output.clear();
    std::FILE* const pipe = ::popen((line + "2>" + base::shell_word(messages)).c_str(), "r");
    if (pipe == nullptr) return -1;
    std::array<char, 4096> buffer{};
    while (std::fgets(buffer.data(), buffer.size(), pipe) != nullptr) output += buffer.data();
    while (!output.empty() && output.back() == '\n') output.pop_back();
    const int status = ::pclose(pipe);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

/// The last line that says something.
std::string last_line(const std::string& path) {
    std::ifstream file(path);
    std::string last;
    for (std::string line; std::getline(file, line);)
        if (line.find_first_not_of(" \t\r") != std::string::npos) last = line;
    return base::printable(last.substr(0, 200));
}

/// The python3 that has the module; the first of the path need not be the one that Debian's packages are for.
std::string python_with(const std::string& module) {
    std::string ignored;
    for (const char* const python : {"python3", "/usr/bin/python3"})
        if (run({python, "-c", "import " + module}, "/dev/null", ignored) == 0) return python;
    return {};
}

class Inquiry {
public:
    Inquiry(const System& system, const NamedMesh& asked, const League& league, Standing& standing)
        : system_(system), asked_(asked), league_(league), standing_(standing), mesh_(asked.mesh) {}

    /// Returns why there is no answer.
    std::string ask() {
        write_array(folder_.path("dimension.i32"), std::vector<std::int32_t>{mesh_.dimension});
        write_array(folder_.path("nodes.f64"), mesh_.points);
        write_array(folder_.path("values.f64"), mesh_.point_fields.at(0).data);
        if (system_.own_triangulation) {
            if (std::string why = call("triangulate"); !why.empty()) return why;
            mesh_.cells = read_array<std::int32_t>(folder_.path("cells.i32"));
        } else {
            const test::CellArrays cells = test::whole_cells(mesh_);
            write_array(folder_.path("cells.i32"), cells.nodes);
            if (kind_of(mesh_) == CellKind::others) {
                write_array(folder_.path("types.u8"), cells.types);
                write_array(folder_.path("ends.i64"), cells.ends);
            }
        }
        const Points points = make_points(mesh_, league_.count, league_.seed);
        write_array(folder_.path("points.f64"), points.coordinates);
        if (std::string why = call("locate"); !why.empty()) return why;
        return judge(points);
    }

    /// Random points in the box alone, for the time: what users ask for. Returns why there is none.
    std::string measure() {
        const Points more = make_points(mesh_, 20000, league_.seed + 1);
        const auto box =
            std::find_if(more.sets.begin(), more.sets.end(), [](const PointSet& set) { return set.name == "box"; });
        const auto random = std::span(more.coordinates).subspan(d() * box->first, d() * box->count);
        write_array(folder_.path("points.f64"), std::vector<double>(random.begin(), random.end()));
        if (std::string why = call("locate"); !why.empty()) return why;
        const auto seconds = read_array<double>(folder_.path("seconds.f64"));
        if (seconds.size() != 2) return "wrote something else";
        standing_.ns.push_back(1e9 * seconds[1] / static_cast<double>(box->count));
        return {};
    }

private:
    std::size_t d() const { return static_cast<std::size_t>(mesh_.dimension); }

    std::string call(const char* task) {
        Words words{"timeout", std::to_string(system_.limit)};
        words.insert(words.end(), system_.command.begin(), system_.command.end());
        words.insert(words.end(), {task, folder_.folder()});
        std::string version;
        const std::string messages = folder_.path("messages");
        const int code = run(words, messages, version);
        if (code == 124) return "did not end in " + std::to_string(system_.limit) + " s";
        if (code != 0) {
            const std::string said = last_line(messages);
            return "ended by itself with code " + std::to_string(code) + (said.empty() ? "" : ": " + said);
        }
        standing_.version = version;
        return {};
    }

    std::string judge(const Points& points) {
        auto owners = read_array<std::int64_t>(folder_.path("owners.i64"));
        const auto sampled = read_array<double>(folder_.path("sampled.f64"));
        const std::size_t count = points.coordinates.size() / d();
        if ((owners.size() != count && !owners.empty()) || (sampled.size() != count && !sampled.empty()))
            return "wrote something else";
        for (std::int64_t& owner : owners) {
            // To the judge a cell is any of its parts.
            if (!mesh_.shapes.types.empty() && owner >= 0 && owner < static_cast<std::int64_t>(mesh_.shapes.count()))
                owner = mesh_.shapes.parts[static_cast<std::size_t>(owner)];
        }
        const Locator locator =
            Locator::build(mesh_, {.interpolation = CellInterpolation::multilinear, .progress = {}}).value();
        std::vector<FieldChoice> fields;
        if (!sampled.empty()) fields.push_back({.field = &mesh_.point_fields.at(0)});
        const Sampler sampler = Sampler::build(locator, fields).value();
        const Verifier verifier(sampler, {});
        for (const PointSet& set : points.sets) {
            ClaimedRows rows;
            rows.points = std::span(points.coordinates).subspan(d() * set.first, d() * set.count);
            if (!owners.empty()) rows.cells = std::span(owners).subspan(set.first, set.count);
            if (!sampled.empty()) rows.values = std::span(sampled).subspan(set.first, set.count);
            const Verdicts verdicts = verifier.verify(rows).value();
            for (Tally* const tally : {&standing_.total, &standing_.by_set[set.name], &standing_.by_mesh[asked_.name]})
                tally->add(verdicts, !owners.empty(), !sampled.empty());
        }
        return {};
    }

    const System& system_;
    const NamedMesh& asked_;
    const League& league_;
    Standing& standing_;
    Mesh mesh_;
    test::Scratch folder_;
};

}  // namespace

std::vector<System> all_systems() {
    std::vector<System> all{{"barycert", {BARYCERT_SYSTEM_BARYCERT, "all"}}};
#ifdef BARYCERT_SYSTEM_VTK
    all.push_back({"vtkStaticCellLocator", {BARYCERT_SYSTEM_VTK, "static-locator"}});
    all.push_back({"vtkCellTreeLocator", {BARYCERT_SYSTEM_VTK, "cell-tree"}});
    all.push_back({"vtkCellLocator", {BARYCERT_SYSTEM_VTK, "cell-locator"}});
    all.push_back({"vtkProbeFilter", {BARYCERT_SYSTEM_VTK, "probe"}});
    all.push_back({"vtkResampleWithDataSet", {BARYCERT_SYSTEM_VTK, "resample"}});
#endif
    for (System& system : all) system.other_cells = true;
    all.push_back({"CGAL locate, exact predicates", {BARYCERT_SYSTEM_CGAL, "exact-predicates"}, true});
    all.push_back({"CGAL locate, plain doubles", {BARYCERT_SYSTEM_CGAL, "inexact"}, true, 0, 10});
    const std::string scipy = python_with("scipy"), matplotlib = python_with("matplotlib");
    const auto by = [](const std::string& python, const char* system) {
        return python.empty() ? Words{} : Words{python, BARYCERT_SYSTEM_PYTHON, system};
    };
    all.push_back({"SciPy find_simplex", by(scipy, "find_simplex"), true});
    all.push_back({"SciPy LinearNDInterpolator", by(scipy, "LinearNDInterpolator"), true});
    all.push_back({"matplotlib TrapezoidMapTriFinder", by(matplotlib, "TriFinder"), false, 2});
    return all;
}

void ask(const System& system, const NamedMesh& mesh, const League& league, Standing& standing) {
    Inquiry inquiry(system, mesh, league, standing);
    if (const std::string why = inquiry.ask(); !why.empty()) {
        standing.failures.push_back(mesh.name + ": " + why);
    } else if (const std::string why_not_timed = inquiry.measure(); !why_not_timed.empty()) {
        standing.not_timed.push_back(mesh.name + ": " + why_not_timed);
    }
}

}  // namespace barycert::systems
