#include "sample_counters.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string_view>
#include <vector>

#include "core/base/random.hpp"
#include "job_process.hpp"
#include "sample_peers.hpp"
#include "sample_subject.hpp"

namespace barycert::bench {
namespace {

namespace fs = std::filesystem;

constexpr const char* valgrind = "/usr/bin/valgrind";

struct Counted {
    const char *subject, *what;
    std::size_t few, many;
    enum class Column { ours, vtk, cgal } column;
};

constexpr Counted all_counted[]{
    {"sample", "a random point, found and interpolated", 1'000, 1'001'000, Counted::Column::ours},
    {"locate", "found alone", 1'000, 1'001'000, Counted::Column::ours},
    {"single", "one point a call, steps of a cell", 1'000, 51'000, Counted::Column::ours},
    {"tree", "found by vtkCellTreeLocator", 100, 20'100, Counted::Column::vtk},
    {"static", "found by vtkStaticCellLocator", 100, 20'100, Counted::Column::vtk},
    {"walk", "found by CGAL, points sorted", 1'000, 1'001'000, Counted::Column::cgal},
};

struct Counters {
    double instructions = 0, first = 0, lines = 0, branches = 0, missed = 0;
};

/// Reads what cachegrind wrote: the names of events, and their sums.
Counters read_counters(const std::string& path) {
    std::ifstream file(path);
    std::string line;
    std::vector<std::string> names;
    Counters out;
    while (std::getline(file, line)) {
        std::istringstream words(line);
        std::string word;
        words >> word;
        if (word == "events:") {
            while (words >> word) names.push_back(word);
        }
        if (word != "summary:" && word != "totals:") continue;
        for (const std::string& name : names) {
            double count = 0;
            require(static_cast<bool>(words >> count), "the counts of cachegrind");
            if (name == "Ir") out.instructions += count;
            if (name == "D1mr" || name == "D1mw") out.first += count;
            if (name == "DLmr" || name == "DLmw") out.lines += count;
            if (name == "Bc" || name == "Bi") out.branches += count;
            if (name == "Bcm" || name == "Bim") out.missed += count;
        }
    }
    require(out.instructions > 0, "the counts of cachegrind in " + path);
    return out;
}

Counters count(const std::string& self, const char* subject, std::size_t points, bool quick) {
    const std::string to = (fs::temp_directory_path() / ("barycert-cachegrind-" + std::to_string(::getpid()))).string();
    run_process({valgrind, "--tool=cachegrind", "--cache-sim=yes", "--branch-sim=yes", "--D1=49152,12,64",
                 "--LL=2097152,16,64", "--cachegrind-out-file=" + to, "--log-file=/dev/null", self, "count", subject,
                 std::to_string(points), quick ? "quick" : "full"});
    const Counters counters = read_counters(to);
    fs::remove(to);
    return counters;
}

/// Along a straight line, mirrored at the sides of the box.
void follow(const Locator& locator, const Bounds3& box, double step, std::size_t count) {
    constexpr std::array<double, 3> direction{0.6633, 0.5521, 0.5053};
    Mesh::Index hint = -1;
    for (std::size_t i = 0; i < count; ++i) {
        std::array<double, 3> at;
        for (std::size_t k = 0; k < 3; ++k) {
            const double side = box.high[k] - box.low[k];
            const double way = std::fmod(0.31 * side + step * direction[k] * static_cast<double>(i), 2 * side);
            at[k] = box.low[k] + std::min(way, 2 * side - way);
        }
        hint = demand_value(locator.locate(at.data(), hint)).cell;
    }
}

}  // namespace

int count_work(std::span<char* const> words) {
    if (words.size() != 3) return 2;
    const std::string_view subject = words[0];
    const auto count = static_cast<std::size_t>(std::atoll(words[1]));
    const Mesh mesh = bench_cube(std::string_view(words[2]) == "quick");
    const Bounds3 box = bounds_of_cells(mesh);
    base::Random random(20);
    std::vector<double> points(3 * count);
    for (std::size_t i = 0; i < points.size(); ++i) points[i] = random.uniform(box.low[i % 3], box.high[i % 3]);
    std::vector<Mesh::Index> cells(count);
    if (subject == "walk") {
        CgalPeer cgal(mesh);
        cgal.build();
        cgal.sort(points);
        cgal.walk();
        return 0;
    }
#ifdef BARYCERT_WITH_VTK
    if (subject == "tree" || subject == "static") {
        const auto which = subject == "tree" ? VtkPeer::Which::cell_tree : VtkPeer::Which::static_locator;
        const std::vector<double> values(mesh.point_count());
        const std::unique_ptr<VtkPeer> vtk =
            make_vtk_peer(mesh, values, points, demand_value(grid_over(3, {2, 2, 2}, box.low, box.high)));
        vtk->build(which);
        vtk->find(which, cells);
        return 0;
    }
#endif
    BuildOptions one;
    one.threads = 1;
    const Locator locator = demand_value(Locator::build(mesh, one));
    if (subject == "single") {
        follow(locator, box, std::cbrt(1.0 / static_cast<double>(mesh.cell_count())) * (box.high[0] - box.low[0]),
               count);
    } else if (subject == "locate") {
        std::vector<Feature> features(count);
        demand_done(locator.locate(points, cells, features, nullptr, 1));
    } else if (subject == "sample") {
        Field field{"linear", 1, std::vector<double>(mesh.point_count(), 1.0)};
        for (std::size_t i = 0; i < field.data.size(); ++i) field.data[i] = mesh.points[3 * i] * 1.5;
        const Sampler sampler = demand_value(Sampler::build(locator, {{&field}}));
        Table rows;
        demand_done(sampler.sample(points, options(1), rows));
    } else {
        return 2;
    }
    return 0;
}

void run_counters(const std::string& self, bool quick, SampleTable& table) {
    if (!fs::exists(valgrind)) {
        std::printf("no valgrind: cache lines are not counted\n");
        return;
    }
    for (const Counted& counted : all_counted) {
#ifndef BARYCERT_WITH_VTK
        if (counted.column == Counted::Column::vtk) continue;
#endif
        std::fprintf(stderr, "counting: %s ...\n", counted.what);
        const std::size_t scale = quick ? 50 : 1;
        const Counters before = count(self, counted.subject, counted.few / scale, quick);
        const Counters after = count(self, counted.subject, counted.many / scale, quick);
        const auto queries = static_cast<double>(counted.many / scale - counted.few / scale);
        const auto each = [&](double Counters::*what) { return (after.*what - before.*what) / queries; };
        const std::string text = with_unit(each(&Counters::lines), "lines") + " (" +
                                 with_unit(each(&Counters::first), "from the first cache), ") +
                                 with_unit(each(&Counters::instructions), "instructions, ") +
                                 with_unit(each(&Counters::branches), "branches, ") +
                                 with_unit(each(&Counters::missed), "missed");
        SampleTable::Line line{.what = std::string("cube, counted: ") + counted.what};
        (counted.column == Counted::Column::ours  ? line.ours
         : counted.column == Counted::Column::vtk ? line.vtk
                                                  : line.cgal) = text;
        table.add(std::move(line));
    }
}

}  // namespace barycert::bench
