// Whole jobs, files to files, by the clock: barycert's program beside a C++ program with VTK's readers, probe and
// writers (job_vtk.cpp), with vtkCellTreeLocator and vtkStaticCellLocator; the faster one counts.
//
// Before any time is taken, values of both are looked at: barycert's against the linear field itself; VTK's against
// barycert's, and differences are told. Contenders run in turn; medians of wall-clock time, of the processor's time,
// user and system, and of the peak of memory.
//
//     bench_job [--quick] [--repetitions N] [--threads N] [ROW...]
//     bench_job read MESH      reads the mesh and ends: what a job for few points is measured by
//
// ROW: same, npy, csv, few, grid, bad, bracket, hexahedra. Files go to BARYCERT_BENCH_DIR, or else the system's
// temporary folder, and stay there for the next run; about 700 MiB. About a quarter of an hour, nearly all of it VTK's.
// --quick: small meshes and few points, to see that all of it works.

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "barycert/gmsh_files.hpp"
#include "barycert/grid.hpp"
#include "barycert/mesh_files.hpp"
#include "barycert/plc_files.hpp"
#include "barycert/point_files.hpp"
#include "barycert/series.hpp"
#include "barycert/surface_files.hpp"
#include "barycert/table_files.hpp"
#include "barycert/tetgen_files.hpp"
#include "barycert/vtk_files.hpp"
#include "generated_mesh.hpp"
#include "job_files.hpp"
#include "job_process.hpp"
#include "sample_subject.hpp"
#include "sample_table.hpp"
#ifdef BARYCERT_WITH_TETGEN
#include "large_mesh.hpp"
#endif

namespace {

using namespace barycert;
using namespace barycert::bench;
using Words = std::vector<std::string>;
namespace fs = std::filesystem;

struct Arguments {
    bool quick = false;
    int repetitions = 3, threads = 2;
    std::set<std::string> rows;

    bool wants(const char* row) const { return rows.empty() || rows.count(row) != 0; }
};

[[noreturn]] void usage() {
    std::fprintf(stderr,
                 "usage: bench_job [--quick] [--repetitions N] [--threads N] "
                 "[same] [npy] [csv] [few] [grid] [bad] [bracket] [hexahedra]\n");
    std::exit(2);
}

Arguments parse(int count, char** text) {
    Arguments out;
    const std::set<std::string> names{"same", "npy", "csv", "few", "grid", "bad", "bracket", "hexahedra"};
    for (int i = 1; i < count; ++i) {
        const std::string word = text[i];
        if (word == "--quick") {
            out.quick = true;
        } else if ((word == "--repetitions" || word == "--threads") && i + 1 < count) {
            (word == "--threads" ? out.threads : out.repetitions) = std::max(1, std::atoi(text[++i]));
        } else if (names.count(word) != 0) {
            out.rows.insert(word);
        } else {
            usage();
        }
    }
    return out;
}

/// One contender of a row.
struct Contender {
    std::string name;  ///< "ours", "tree", "static"
    Words words;
    std::string out = {};  ///< the file that it writes
    std::vector<Spent> spent = {};

    double median(double Spent::*what) const {
        std::vector<double> all;
        for (const Spent& s : spent) all.push_back(s.*what);
        std::nth_element(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2), all.end());
        return all[all.size() / 2];
    }
};

struct Row {
    std::string what;
    std::string mesh;
    std::vector<Contender> contenders;  ///< ours first
    double goal = 0;                    ///< as many times faster than the best peer; 0: none
    std::size_t side = 0;               ///< of a grid, or 0
    bool against_reading = false;       ///< goal: at most as many times what reading the mesh takes
};

fs::path folder() {
    const char* const named = std::getenv("BARYCERT_BENCH_DIR");
    const fs::path path = (named != nullptr ? fs::path(named) : fs::temp_directory_path()) / "barycert-jobs";
    fs::create_directories(path);
    return path;
}

Mesh cube(bool quick) {
    if (quick) return jittered_cube(12, 7);
#ifdef BARYCERT_WITH_TETGEN
    return demand_value(read_tetgen(large_mesh_stem()));
#else
    return jittered_cube(68, 7);
#endif
}

/// The program writes `out`; `more`: points or a grid.
Contender ours(const std::string& command, int threads, const std::string& mesh, const Words& more,
               const std::string& out) {
    Words words{BARYCERT_PROGRAM, command, mesh};
    words.insert(words.end(), more.begin(), more.end());
    for (const std::string& word :
         {std::string("--threads"), std::to_string(threads), std::string("--quiet"), std::string("--output"), out})
        words.push_back(word);
    return {"ours", words, out};
}

void add_peers(Row& row, int threads, const Words& before, const std::string& out) {
    for (const char* const locator : {"tree", "static"}) {
        // Onto an image the probe goes cell by cell, and asks no locator.
        if (!with_vtk() || (before.front() == "image" && locator == std::string_view("static"))) continue;
        const std::string to = fs::path(out).replace_filename(locator + fs::path(out).filename().string()).string();
        Words more = before;
        more.push_back(to);
        row.contenders.push_back({row.side != 0 ? "its own way" : locator, vtk(threads, locator, more), to});
    }
}

/// NaN where the point is outside.
std::vector<double> values_of(const std::string& path) {
    if (path.ends_with(".npy") || path.ends_with(".csv")) return read_rows(path).values;
    const std::string raw = path + ".raw";
    run_process(vtk(1, "tree", {"unpack", path, raw}));
    std::vector<double> values = read_doubles(raw);
    fs::remove(raw);
    return values;
}

std::vector<double> points_of(const Row& row, const Bounds3& box) {
    std::vector<double> points;
    if (row.side != 0) {
        const auto n = static_cast<std::int64_t>(row.side);
        const Grid grid = demand_value(grid_over(3, {n, n, n}, box.low, box.high));
        for (std::int64_t k = 0; k < n; ++k) {
            for (std::int64_t j = 0; j < n; ++j) {
                for (std::int64_t i = 0; i < n; ++i)
                    points.insert(points.end(), {grid.coordinate(0, i), grid.coordinate(1, j), grid.coordinate(2, k)});
            }
        }
        return points;
    }
    const Words& words = row.contenders.front().words;
    const auto source = demand_value(open_points(*(std::find(words.begin(), words.end(), "--points") + 1), 3));
    demand_value(source->read(std::size_t{1} << 30, points));
    return points;
}

/// A nodal value and the formula at a point are off by at most four roundings of numbers up to the sum of the terms'
/// sizes, and so is the interpolation of such values, with one more.
void verify_ours(const Row& row, const std::vector<double>& values) {
    const Bounds3 box = bounds_of_cells(demand_value(read_mesh(row.mesh)));
    const std::vector<double> points = points_of(row, box);
    require(values.size() == points.size() / 3, "as many rows as points: " + row.what);
    const auto size = [&](std::size_t k) { return std::max(std::abs(box.low[k]), std::abs(box.high[k])); };
    const double bound = 10 * 0x1p-53 * (1.5 * size(0) + 2.5 * size(1) + size(2));
    std::size_t outside = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        outside += std::isnan(values[i]) ? 1 : 0;
        require(std::isnan(values[i]) || std::abs(values[i] - field_at(points.data() + 3 * i)) <= bound,
                "a value of " + row.what);
    }
    std::printf("%s: %zu values right, %zu points outside\n", row.what.c_str(), values.size() - outside, outside);
}

void compare_peer(const Contender& peer, const std::vector<double>& right) {
    const double limit = peer.out.ends_with(".csv") ? 1e-5 : 1e-12;  // VTK writes six digits
    const std::vector<double> theirs = values_of(peer.out);
    require(theirs.size() == right.size(), "as many values: " + peer.out);
    double max = 0, worst = 0;
    for (const double x : right) max = std::max(max, std::isnan(x) ? 0 : std::abs(x));
    std::size_t missed = 0, found = 0, off = 0;
    for (std::size_t i = 0; i < right.size(); ++i) {
        missed += std::isnan(theirs[i]) && !std::isnan(right[i]) ? 1 : 0;
        found += std::isnan(right[i]) && !std::isnan(theirs[i]) ? 1 : 0;
        const double difference = std::abs(theirs[i] - right[i]) / max;
        if (std::isnan(difference)) continue;
        off += difference > limit ? 1 : 0;
        worst = std::max(worst, difference);
    }
    std::printf("  VTK, %s: %zu inside missed, %zu outside found, %zu values off by more than %.0e of the largest, ",
                peer.name.c_str(), missed, found, off, limit);
    std::printf("at most %.1e\n", worst);
}

void verify(const Row& row) {
    apart([&] {
        const Contender& us = row.contenders.front();
        if (!with_vtk() && !us.out.ends_with(".npy") && !us.out.ends_with(".csv")) {
            std::printf("%s: no VTK to read the output\n", row.what.c_str());
            return;
        }
        const std::vector<double> right = values_of(us.out);
        verify_ours(row, right);
        for (const Contender& peer : row.contenders) {
            if (&peer != &us && !peer.out.empty()) compare_peer(peer, right);
        }
    });
}

std::string cells_of(const Contender& c) {
    return with_unit(c.median(&Spent::wall), "s") + " | " + with_unit(c.median(&Spent::cpu), "s") + " | " +
           with_unit(c.median(&Spent::peak_mib), "MiB");
}

void print(const Row& row, int threads) {
    const Contender& us = row.contenders.front();
    const Contender* best = nullptr;
    for (std::size_t i = row.against_reading ? 2 : 1; i < row.contenders.size(); ++i) {
        const Contender& c = row.contenders[i];
        if (best == nullptr || c.median(&Spent::wall) < best->median(&Spent::wall)) best = &c;
    }
    std::printf("| %s | %d | %s |", row.what.c_str(), threads, cells_of(us).c_str());
    const auto ratio = [&](const Contender& c, double Spent::*what) { return c.median(what) / us.median(what); };
    std::string verdict;
    const double reached = row.against_reading ? 1 / ratio(row.contenders[1], &Spent::wall)
                           : best != nullptr   ? ratio(*best, &Spent::wall)
                                               : NAN;
    if (row.against_reading) verdict = "; " + with_unit(reached, "x reading the mesh");
    if (row.goal != 0 && !std::isnan(reached)) {
        verdict += (row.against_reading ? reached <= row.goal : reached >= row.goal) ? ", goal " : ", NOT the goal ";
        verdict += with_unit(row.goal, "x");
    }
    if (best == nullptr) {
        std::printf(" - | - | - | -%s | - |\n", verdict.c_str());
        return;
    }
    std::printf(" %s: %s | %s%s | %s |\n", best->name.c_str(), cells_of(*best).c_str(),
                with_unit(ratio(*best, &Spent::wall), "x").c_str(), verdict.c_str(),
                with_unit(ratio(*best, &Spent::cpu), "x").c_str());
}

/// A run must not pay for what the one before it still has to write, nor for replacing its file.
Spent run_settled(const Contender& c) {
    if (!c.out.empty()) fs::remove(c.out);
    ::sync();
    return run_process(c.words);
}

/// Runs twice what takes less than a second, the first time only to warm up: a virtual machine may have given memory
/// back to its host meanwhile, and getting it again takes up to 0.2 s.
Spent run_warm(const Contender& c) {
    constexpr double second = 1;
    const Spent cold = run_settled(c);
    return cold.wall < second ? run_settled(c) : cold;
}

void run(Row& row, const Arguments& arguments, int threads, bool look) {
    for (int repetition = 0; repetition <= arguments.repetitions; ++repetition) {
        for (Contender& c : row.contenders) {
            const Spent spent = run_warm(c);
            if (repetition != 0) c.spent.push_back(spent);  // the first round reads files into memory
        }
        if (repetition == 0 && look) verify(row);
    }
    print(row, threads);
    for (const Contender& c : row.contenders) {
        if (!c.out.empty()) fs::remove(c.out);
    }
}

/// All rows, for that many threads.
std::vector<Row> rows_of(const Arguments& arguments, int threads, const std::string& self) {
    const bool quick = arguments.quick;
    const std::string kept = folder().string() + (quick ? "/quick-" : "/");
    const JobFiles good{kept + "cube"}, bad{kept + "bad"}, bracket{kept + "bracket"}, hexahedra{kept + "hexahedra"};
    const std::size_t many = quick ? 20'000 : 1'000'000, few = 100;
    const std::string side = quick ? "24" : "256";
    std::vector<Row> rows;
    const auto add = [&](const char* name, Row row, const Words& theirs) {
        if (!arguments.wants(name)) return;
        if (quick) row.goal = 0;
        if (!theirs.empty()) {
            const std::string out = theirs.back();
            add_peers(row, threads, Words(theirs.begin(), theirs.end() - 1), out);
        }
        rows.push_back(std::move(row));
    };
    const auto points = [&](const JobFiles& files, std::size_t count, const char* suffix) {
        return Words{"--points", files.points(count, suffix)};
    };
    const auto at_points = [&](const JobFiles& files, std::size_t count, const char* suffix) {
        return Words{"points", files.vtu(), files.points(count, suffix), kept + "vtk.vtp"};
    };
    const std::string thousand = in_thousands(many) + " points";
    if (with_vtk())
        add("same",
            {"cube, " + thousand + ", the same .vtu and .vtp; .vtu out",
             good.vtu(),
             {ours("sample", threads, good.vtu(), points(good, many, ".vtp"), kept + "ours.vtu")}},
            at_points(good, many, ".vtp"));
    add("npy",
        {"cube, " + thousand + ", .npy in and out",
         good.stem,
         {ours("sample", threads, good.stem, points(good, many, ".npy"), kept + "ours.npy")},
         20},
        at_points(good, many, ".vtp"));
    add("csv",
        {"cube, " + thousand + ", the same .csv in; .csv out",
         good.stem,
         {ours("sample", threads, good.stem, points(good, many, ".csv"), kept + "ours.csv")},
         12},
        {"points", good.vtu(), good.points(many, ".csv"), kept + "vtk.csv"});
    Row handful{"cube, 100 points, .npy in and out",
                good.stem,
                {ours("sample", threads, good.stem, points(good, few, ".npy"), kept + "ours.npy")},
                1.3};
    handful.against_reading = true;
    handful.contenders.push_back({"reading the mesh", {self, "read", good.stem, std::to_string(threads)}});
    add("few", handful, at_points(good, few, ".vtp"));
    Row grid{"cube, grid of " + side + "^3 to .vti",
             good.stem,
             {ours("resample", threads, good.stem, {"--grid", side + 'x' + side + 'x' + side}, kept + "ours.vti")},
             80};
    grid.side = static_cast<std::size_t>(std::atoi(side.c_str()));
    add("grid", grid, {"image", good.vtu(), side, kept + "vtk.vti"});
    add("bad",
        {"cube with one node moved through a facet, " + thousand,
         bad.stem,
         {ours("sample", threads, bad.stem, points(good, many, ".npy"), kept + "ours.npy")}},
        {"points", bad.vtu(), good.points(many, ".vtp"), kept + "vtk.vtp"});
    add("bracket",
        {"bracket, " + thousand + ", 91 % outside",
         bracket.stem,
         {ours("sample", threads, bracket.stem, points(bracket, many, ".npy"), kept + "ours.npy")}},
        at_points(bracket, many, ".vtp"));
    if (with_vtk())
        add("hexahedra",
            {std::string("cube of a ") + (quick ? "thousand" : "million") + " hexahedra, " + thousand +
                 ", the same .vtu and .vtp; .vtu out",
             hexahedra.vtu(),
             {ours("sample", threads, hexahedra.vtu(), points(hexahedra, many, ".vtp"), kept + "ours.vtu")},
             12},
            at_points(hexahedra, many, ".vtp"));
    return rows;
}

void make_files(const Arguments& arguments) {
    const std::string kept = folder().string() + (arguments.quick ? "/quick-" : "/");
    const std::size_t many = arguments.quick ? 20'000 : 1'000'000;
    if (arguments.wants("hexahedra")) {
        const JobFiles hexahedra{kept + "hexahedra"};
        const Mesh cubes = shaped_cube(CubeCells::hexahedra, arguments.quick ? 10 : 100, 0.15, true, 1);
        make_mesh_files(hexahedra, cubes);
        make_point_files(hexahedra, cubes, many);
        if (arguments.rows.size() == 1) return;
    }
    const Mesh good = cube(arguments.quick);
    const JobFiles files{kept + "cube"}, bad{kept + "bad"}, bracket{kept + "bracket"};
    make_mesh_files(files, good);
    make_point_files(files, good, many);
    make_point_files(files, good, 100);
    make_mesh_files(bad, with_bad_cells(good));
    const Mesh part = demand_value(read_tetgen(BARYCERT_DATA_DIR "/meshes/bracket"));
    make_mesh_files(bracket, part);
    make_point_files(bracket, part, many);
}

}  // namespace

int main(int count, char** text) {
    std::setvbuf(stdout, nullptr, _IOLBF, BUFSIZ);  // what is known so far shows in a file, too
    if (count == 4 && std::string_view(text[1]) == "read") {
        demand_value(read_mesh(text[2], {.faces = false, .neighbours = false, .threads = std::atoi(text[3])}));
        return 0;
    }
    const Arguments arguments = parse(count, text);
    apart([&] { make_files(arguments); });
    std::printf(
        "\n| job | threads | ours | CPU | peak | VTK's best | CPU | peak | ratio | of CPU |\n"
        "|---|---|---|---|---|---|---|---|---|---|\n");
    const std::string self = fs::read_symlink("/proc/self/exe").string();
    for (const int threads : std::set<int>{1, arguments.threads}) {
        for (Row& row : rows_of(arguments, threads, self)) run(row, arguments, threads, threads == arguments.threads);
    }
    if (arguments.quick) std::printf("(a quick run: these times and ratios say nothing)\n");
    return 0;
}
