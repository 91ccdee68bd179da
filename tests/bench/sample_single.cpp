// One point a call: a particle that moves from call to call, with its last cell as a hint; and hints from far away.

#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "sample_rounds.hpp"

namespace barycert::bench {
namespace {

/// A path through the box of the cells, mirrored at its sides, and the answers of one call for all its points.
struct Path {
    std::string name;
    std::vector<double> points;
    std::vector<Mesh::Index> owners;
};

/// Straight between mirrors: each coordinate is a triangle wave. The direction is near to no axis or diagonal.
Path path_of(const Round& round, const std::string& name, std::size_t count, double step) {
    constexpr std::array<double, 3> direction{0.6633, 0.5521, 0.5053};
    const Grid& grid = round.subject.grid;  // over the box of the cells
    Path path{name, {}, std::vector<Mesh::Index>(count)};
    for (std::size_t i = 0; i < count; ++i) {
        for (std::size_t k = 0; k < 3; ++k) {
            const double side = grid.spacing[k] * static_cast<double>(grid.counts[k] - 1);
            const double way = std::fmod(0.31 * side + step * direction[k] * static_cast<double>(i), 2 * side);
            path.points.push_back(grid.origin[k] + std::min(way, 2 * side - way));
        }
    }
    std::vector<Feature> features(count);
    demand_done(round.ours.walk.locate(path.points, path.owners, features, nullptr, 1));
    return path;
}

/// Single calls must find what one call for all finds.
void verify(const Path& path, const std::vector<Mesh::Index>& cells) {
    require(cells == path.owners, path.name + ": a single call found another cell");
}

/// The point whose cell is the far hint of point i.
std::size_t far_from(std::size_t i, std::size_t count) {
    return (i * 7919 + count / 2) % count;
}

}  // namespace

void run_single(Round& round, SampleTable& table) {
    constexpr std::size_t calls = 200'000;
    const Mesh& mesh = round.subject.mesh;
    const Locator& locator = round.ours.walk;
    double box = 1;
    for (std::size_t k = 0; k < 3; ++k)
        box *= round.subject.grid.spacing[k] * static_cast<double>(round.subject.grid.counts[k] - 1);
    const double size = std::cbrt(box / static_cast<double>(mesh.cell_count()));
    const Path slow = path_of(round, "steps of a fifth of a cell", calls, 0.2 * size);
    const Path fast = path_of(round, "steps of a cell", calls, size);
    Path any{"no hint", {}, {}};
    any.points.assign(
        round.subject.points.begin(),
        round.subject.points.begin() + static_cast<std::ptrdiff_t>(std::min(3 * calls, round.subject.points.size())));
    any.owners.assign(round.rows.cells.begin(),
                      round.rows.cells.begin() + static_cast<std::ptrdiff_t>(any.points.size() / 3));
    const std::size_t few = any.owners.size();

    std::vector<Mesh::Index> cells(calls);
    Contest contest;
    const auto follow = [&](const Path& path) {
        return [&] {
            Mesh::Index hint = -1;
            for (std::size_t i = 0; i < calls; ++i)
                cells[i] = hint = locator.locate(path.points.data() + 3 * i, hint)->cell;
        };
    };
    const auto without = [&] {
        for (std::size_t i = 0; i < few; ++i) cells[i] = locator.locate(any.points.data() + 3 * i)->cell;
    };
    const auto far = [&] {
        for (std::size_t i = 0; i < few; ++i)
            cells[i] = locator.locate(any.points.data() + 3 * i, any.owners[far_from(i, few)])->cell;
    };
    follow(slow)();
    verify(slow, cells);
    follow(fast)();
    verify(fast, cells);
    cells.resize(few);
    without();
    verify(any, cells);
    far();
    verify(any, cells);
    cells.resize(std::max(calls, few));
    contest.add("slow", follow(slow));
    contest.add("fast", follow(fast));
    contest.add("none", without);
    contest.add("far", far);
    if (VtkPeer* const vtk = round.vtk.get(); vtk != nullptr) {
        contest.add("VTK slow", [&, vtk] { vtk->find_all(VtkPeer::Which::cell_tree, slow.points, cells); });
        contest.add("VTK fast", [&, vtk] { vtk->find_all(VtkPeer::Which::cell_tree, fast.points, cells); });
        contest.add("VTK none", [&, vtk] { vtk->find_all(VtkPeer::Which::cell_tree, any.points, cells); });
    }
    if (CgalPeer* const cgal = round.cgal.get(); cgal != nullptr) {
        contest.add("CGAL slow", [&, cgal] { cgal->follow(slow.points); });
        contest.add("CGAL fast", [&, cgal] { cgal->follow(fast.points); });
        contest.add("CGAL none", [&, cgal] { cgal->find_each(any.points); });
        contest.add(
            "CGAL far", [&, cgal] { cgal->find_each_from(any.points, far_from); },
            [&, cgal] { cgal->follow(any.points); });
    }
    contest.run(round.how.repetitions);

    const auto tell = [&](const char* key, const std::string& what, std::size_t count, const char* vtk_key) {
        const std::string vtk = std::string("VTK ") + vtk_key, cgal = std::string("CGAL ") + key;
        const auto ns = [&](const std::string& name) {
            return contest.has(name) ? with_unit(1e9 * contest.cpu(name) / static_cast<double>(count), "ns")
                                     : std::string();
        };
        table.add(
            {.what = round.subject.name + ": one point a call, " + what,
             .ours = ns(key),
             .vtk = ns(vtk),
             .cgal = ns(cgal),
             .ratio = joined({times_as_long(contest, "VTK", vtk, key), times_as_long(contest, "CGAL", cgal, key)})});
    };
    tell("slow", slow.name, calls, "slow");
    tell("fast", fast.name, calls, "fast");
    tell("none", any.name, few, "none");
    tell("far", "the hint of another point", few, "none");
}

}  // namespace barycert::bench
