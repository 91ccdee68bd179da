// Time and memory before the first point is asked.

#include <cstddef>
#include <optional>
#include <string>

#include "barycert/certificate.hpp"
#include "barycert/check.hpp"
#include "barycert/check_results.hpp"
#include "barycert/defect.hpp"
#include "barycert/fix.hpp"
#include "barycert/measures.hpp"
#include "barycert/not_finite.hpp"
#include "barycert/plc.hpp"
#include "barycert/surface.hpp"
#include "barycert/surface_report.hpp"
#include "core/base/random.hpp"
#include "sample_rounds.hpp"

namespace barycert::bench {
namespace {

using Which = VtkPeer::Which;

/// Each of its cells or not, by a coin: as a process has them where cells are scattered over all.
Mesh half_of(const Mesh& mesh) {
    Mesh half;
    half.dimension = mesh.dimension;
    half.points = mesh.points;
    base::Random random(1);
    for (std::size_t i = 0; i < mesh.cells.size(); i += mesh.corners()) {
        const auto cell = mesh.cells.begin() + static_cast<std::ptrdiff_t>(i);
        if (random.coin())
            half.cells.insert(half.cells.end(), cell, cell + static_cast<std::ptrdiff_t>(mesh.corners()));
    }
    return half;
}

void add_all(Round& round, Contest& contest, std::optional<Locator>& locator, std::optional<Sampler>& sampler,
             const Mesh& half) {
    const Subject& subject = round.subject;
    for (const int threads : {1, 2}) {
        contest.add(
            "half " + std::to_string(threads),
            [&, threads] { locator = demand_value(Locator::build(half, {.threads = threads})); },
            [&] { locator.reset(); });
    }
    for (const int threads : {1, 2}) {
        contest.add(
            "locator " + std::to_string(threads),
            [&, threads] { locator = demand_value(Locator::build(subject.mesh, {.threads = threads})); },
            [&] { locator.reset(); });
    }
    contest.add(
        "candidates",
        [&] {
            locator = demand_value(Locator::build(subject.mesh, {.prove = Prove::never, .threads = 1}));
            demand_value(locator->locate(subject.points.data()));  // the first one makes the tree
        },
        [&] { locator.reset(); });
    contest.add(
        "sampler", [&] { sampler = demand_value(Sampler::build(round.ours.walk, {{&subject.linear}})); },
        [&] { sampler.reset(); });
    for (const int threads : {1, 2}) {
        contest.add("check " + std::to_string(threads), [&subject, threads] {
            CheckOptions how;
            how.threads = threads;
            require(check_mesh(subject.mesh, how).certified(), "the mesh is not certified any more");
        });
    }
    if (VtkPeer* const vtk = round.vtk.get(); vtk != nullptr) {
        contest.add(
            "VTK static", [vtk] { vtk->build(Which::static_locator); }, [vtk] { vtk->drop(Which::static_locator); });
        contest.add(
            "VTK tree", [vtk] { vtk->build(Which::cell_tree); }, [vtk] { vtk->drop(Which::cell_tree); });
    }
    if (CgalPeer* const cgal = round.cgal.get(); cgal != nullptr)
        contest.add(
            "CGAL", [cgal] { cgal->build(); }, [cgal] { cgal->drop(); });
}

}  // namespace

void run_builds(Round& round, SampleTable& table) {
    Contest contest;
    std::optional<Locator> locator;
    std::optional<Sampler> sampler;
    const Mesh half = half_of(round.subject.mesh);
    require(demand_value(Locator::build(half)).certified(), "half of the cells are not certified");
    add_all(round, contest, locator, sampler, half);
    contest.run(round.how.repetitions);

    const std::string& name = round.subject.name;
    const auto cells = static_cast<double>(round.subject.mesh.cell_count());
    const auto ms = [&](const std::string& what) { return with_unit(1e3 * contest.cpu(what), "ms"); };
    const auto bytes = [&](std::size_t of) { return with_unit(static_cast<double>(of) / cells, "bytes"); };
    table.add({.what = name + ": locator built without the proof (up to 100,000 cells: until it pays)",
               .ours = ms("candidates"),
               .ratio = times_as_long(contest, "VTK's tree", "VTK tree", "candidates")});
    table.add({.what = name + ": locator built, mesh certified",
               .ours = ms("locator 1") + "; 2 threads " + with_unit(1e3 * contest.wall("locator 2"), "ms"),
               .vtk = contest.has("VTK tree") ? "tree " + ms("VTK tree") + ", static " + ms("VTK static") : "",
               .cgal = contest.has("CGAL") ? ms("CGAL") + ", the triangulation" : "",
               .ratio = times_as_long(contest, "VTK's tree", "VTK tree", "locator 1")});
    table.add({.what = name + ": locator built of half of the cells, chosen at random",
               .ours = ms("half 1") + "; 2 threads " + with_unit(1e3 * contest.wall("half 2"), "ms")});
    table.add({.what = name + ": sampler built, one field", .ours = ms("sampler")});
    table.add({.what = name + ": checked (check_mesh)",
               .ours = ms("check 1") + "; 2 threads " + with_unit(1e3 * contest.wall("check 2"), "ms")});
    const double tree = static_cast<double>(round.vtk_tree_bytes);
    table.add({.what = name + ": memory of the locator besides the mesh, a cell",
               .ours = bytes(round.bytes) + "; by malloc " + bytes(round.handed_out),
               .vtk = round.vtk != nullptr
                          ? "tree " + bytes(round.vtk_tree_bytes) + ", static " + bytes(round.vtk_static_bytes)
                          : "",
               .ratio = round.vtk != nullptr
                            ? "VTK's tree " + with_unit(tree / static_cast<double>(round.handed_out), "x")
                            : ""});
    table.demand(name + ": VTK's cell tree over ours, built", contest.cpu_ratio("VTK tree", "locator 1"), 5);
}

}  // namespace barycert::bench
