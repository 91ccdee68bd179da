// Regular grids.

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <string>
#include <vector>

#include "barycert/grid.hpp"
#include "sample_rounds.hpp"
#include "sample_verify.hpp"

namespace barycert::bench {

void run_grid(Round& round, SampleTable& table) {
    const Subject& subject = round.subject;
    const std::string side = std::to_string(subject.grid.counts[0]), name = subject.name + ": grid of " + side + "^3";
    const auto points = static_cast<double>(subject.grid.point_count());
    std::vector<double> values(round.grid_values.size());  // as a caller would keep them
    const auto ours = [&](SampleOptions how) {
        return [&round, &values, how] {
            const auto keep = [&values](const TableView& block) -> Status {
                std::copy(block.values.begin(), block.values.end(),
                          values.begin() + static_cast<std::ptrdiff_t>(block.first_row));
                return Done{};
            };
            demand_value(resample(round.ours.one, round.subject.grid, how, keep));
        };
    };
    Contest contest;
    contest.add("resample", ours(options(1)));
    contest.add("plain", ours(options(1, Rounding::plain)));
    contest.add("two threads", ours(options(2)));
    if (round.vtk != nullptr) contest.add("VTK image", [&] { round.vtk->probe_image(); });
    contest.run(round.how.repetitions);

    if (round.vtk != nullptr) {
        const Comparison found = compare(subject, round.grid_values, round.vtk->probed());
        std::printf(
            "  vtkProbeFilter onto the image: %llu voxels missed, %llu found that are outside; "
            "%llu values off by more than 1e-12, at most %.2g\n",
            static_cast<unsigned long long>(found.missed), static_cast<unsigned long long>(found.found_outside),
            static_cast<unsigned long long>(found.off), found.worst);
    }
    const auto ns = [&](const char* what) { return with_unit(1e9 * contest.cpu(what) / points, "ns"); };
    table.add({.what = name + ", a voxel",
               .ours = ns("resample"),
               .vtk = ns("VTK image"),
               .ratio = times_as_long(contest, "VTK", "VTK image", "resample")});
    table.add({.what = name + ", plain rounding",
               .ours = ns("plain"),
               .ratio = "correct " + times_as_long(contest, "", "resample", "plain")});
    table.add({.what = name + ", 2 threads, by the clock",
               .ours = with_unit(1e9 * contest.wall("two threads") / points, "ns"),
               .ratio = with_unit(contest.wall_ratio("resample", "two threads"), "x") + " one thread"});
    table.demand(name + ", VTK's probe of an image over resample", contest.cpu_ratio("VTK image", "resample"), 200);
    table.demand(name + ", correct over plain rounding", contest.cpu_ratio("resample", "plain"), 1.25, true);
}

}  // namespace barycert::bench
