// Random points.

#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "sample_rounds.hpp"
#include "sample_verify.hpp"

namespace barycert::bench {
namespace {

using Which = VtkPeer::Which;

/// Outputs of runs, kept so that no run pays for new pages.
struct Written {
    Table rows;
    std::vector<Mesh::Index> cells;
    std::vector<Feature> features;
    std::vector<double> values;
};

void add_ours(Round& round, Written& out, Contest& contest) {
    const Subject& subject = round.subject;
    const auto sample = [&](const Sampler& sampler, SampleOptions how) {
        return [&sampler, &subject, &out, how] { demand_done(sampler.sample(subject.points, how, out.rows)); };
    };
    out.cells.resize(subject.point_count());
    out.rows.cells = round.rows.cells;
    out.rows.features = round.rows.features;
    out.features.resize(subject.point_count());
    contest.add("sample", sample(round.ours.one, options(1)));
    contest.add("plain", sample(round.ours.one, options(1, Rounding::plain)));
    contest.add("two threads", sample(round.ours.one, options(2)));
    contest.add("locate",
                [&] { demand_done(round.ours.walk.locate(subject.points, out.cells, out.features, nullptr, 1)); });
    contest.add("candidates", sample(round.ours.uncertified, options(1)));
    contest.add("three", sample(round.ours.three, options(1)));
    contest.add("evaluate", [&] { demand_done(round.ours.one.evaluate(subject.points, options(1), out.rows)); });
}

void add_peers(Round& round, Written& out, Contest& contest) {
    if (VtkPeer* const vtk = round.vtk.get(); vtk != nullptr) {
        contest.add("VTK static", [vtk, &out] { vtk->find(Which::static_locator, out.cells); });
        contest.add("VTK tree", [vtk, &out] { vtk->find(Which::cell_tree, out.cells); });
        contest.add("VTK static value", [vtk, &out] { vtk->interpolate(Which::static_locator, out.values); });
        contest.add("VTK tree value", [vtk, &out] { vtk->interpolate(Which::cell_tree, out.values); });
        // The probe's own loop is the same for both: of the better one only.
        const Which better = time([&] { vtk->find(Which::static_locator, out.cells); }).cpu <
                                     time([&] { vtk->find(Which::cell_tree, out.cells); }).cpu
                                 ? Which::static_locator
                                 : Which::cell_tree;
        contest.add("VTK probe", [vtk, better] { vtk->probe(better); });
    }
    if (CgalPeer* const cgal = round.cgal.get(); cgal != nullptr) {
        contest.add("CGAL sort", [&round, cgal] { cgal->sort(round.subject.points); });
        contest.add("CGAL", [&round, cgal] {
            cgal->sort(round.subject.points);
            cgal->walk();
        });
        contest.add("CGAL value", [&round, cgal, &out] {
            cgal->sort(round.subject.points);
            cgal->walk();
            cgal->interpolate(round.subject.linear.data, out.values);
        });
    }
}

ScipyRun scipy_of(const Round& round) {
    if (!round.how.scipy) return {.why_not = "left out"};
    std::fprintf(stderr, "  SciPy ...\n");
    ScipyRun run =
        run_scipy(round.subject.mesh, round.subject.linear.data, round.subject.points, round.how.repetitions);
    if (!run.why_not.empty()) {
        std::printf("  no SciPy: %s\n", run.why_not.c_str());
        return run;
    }
    const Comparison found = compare(round.subject, round.rows.values, run.values);
    std::printf(
        "  SciPy %s, on its own triangulation: %llu points missed; %llu values off by more than 1e-12, at most %.2g\n",
        run.version.c_str(), static_cast<unsigned long long>(found.missed), static_cast<unsigned long long>(found.off),
        found.worst);
    return run;
}

void tell(const Round& round, const Contest& contest, const std::string& best, const ScipyRun& scipy,
          SampleTable& table) {
    const auto points = static_cast<double>(round.subject.point_count());
    const std::string name = round.subject.name;
    const auto ns = [&](const std::string& what) { return with_unit(1e9 * contest.cpu(what) / points, "ns"); };
    const auto scipy_ns = [&](double seconds) {
        return scipy.why_not.empty() ? with_unit(1e9 * seconds / points, "ns") : std::string();
    };
    const auto scipy_times = [&](double seconds, const char* ours) {
        return scipy.why_not.empty() ? "SciPy " + with_unit(seconds / contest.cpu(ours), "x") : std::string();
    };
    const std::string value = best + " value";
    table.add({.what = name + ": a random point, found and interpolated",
               .ours = ns("sample"),
               .vtk = ns(value),
               .cgal = ns("CGAL value"),
               .scipy = scipy_ns(scipy.interpolate),
               .ratio = joined({times_as_long(contest, "VTK", value, "sample"),
                                times_as_long(contest, "CGAL", "CGAL value", "sample"),
                                scipy_times(scipy.interpolate, "sample")})});
    const std::string other = best == "VTK tree" ? "VTK static" : "VTK tree";
    table.add({.what = name + ": found alone",
               .ours = ns("locate"),
               .vtk = contest.has(best) ? (best == "VTK tree" ? "tree " : "static ") + ns(best) + ", " +
                                              (best == "VTK tree" ? "static " : "tree ") + ns(other)
                                        : "",
               .cgal = contest.has("CGAL") ? ns("CGAL") + ", of it sorting " + ns("CGAL sort") : "",
               .scipy = scipy_ns(scipy.find),
               .ratio = joined({times_as_long(contest, "VTK", best, "locate"),
                                times_as_long(contest, "CGAL", "CGAL", "locate"), scipy_times(scipy.find, "locate")})});
    table.add({.what = name + ": the same through vtkProbeFilter, its locator built anew",
               .ours = ns("sample"),
               .vtk = ns("VTK probe"),
               .ratio = times_as_long(contest, "VTK", "VTK probe", "sample")});
    table.add({.what = name + ": plain rounding",
               .ours = ns("plain"),
               .ratio = "correct " + times_as_long(contest, "", "sample", "plain")});
    table.add({.what = name + ": 2 threads, by the clock",
               .ours = with_unit(1e9 * contest.wall("two threads") / points, "ns"),
               .ratio = with_unit(contest.wall_ratio("sample", "two threads"), "x") + " one thread"});
    table.add({.what = name + ": 3 components", .ours = ns("three")});
    table.add({.what = name + ": interpolated alone, owners known", .ours = ns("evaluate")});
    table.add({.what = name + ": found and interpolated by candidates everywhere",
               .ours = ns("candidates"),
               .ratio = "walks " + times_as_long(contest, "", "candidates", "sample")});
}

}  // namespace

void run_points(Round& round, SampleTable& table) {
    Written out;
    Contest contest;
    add_ours(round, out, contest);
    add_peers(round, out, contest);
    contest.run(round.how.repetitions);
    const ScipyRun scipy = scipy_of(round);
    if (round.how.scipy) table.scipy = scipy.why_not.empty();
    const std::string best = contest.cpu("VTK static") < contest.cpu("VTK tree") ? "VTK static" : "VTK tree";
    tell(round, contest, best, scipy, table);

    const std::string& name = round.subject.name;
    // Ours finds and interpolates, theirs only find.
    table.demand(name + ": random points, CGAL's sorted hinted walk over sample", contest.cpu_ratio("CGAL", "sample"),
                 10);
    table.demand(name + ": random points, VTK's best locator over sample", contest.cpu_ratio(best, "sample"), 100);
    table.demand(name + ": random points, correct over plain rounding", contest.cpu_ratio("sample", "plain"), 1.25,
                 true);
    if (!round.how.two_threads) return;
    // The clock counts what others do; where one thread waited, two did not have two processors.
    const double waited = contest.wall("sample") / contest.cpu("sample");
    table.demand(name + ": random points, one thread over two, by the clock",
                 contest.wall_ratio("sample", "two threads"), 1.9, false,
                 waited > 1.03 ? "the machine was busy: one thread waited " + with_unit(100 * (waited - 1), "%") : "");
}

}  // namespace barycert::bench
