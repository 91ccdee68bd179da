// Reading a large mesh: TetGen's own reader, tetgenio::load_tetmesh, against read_tetgen, in one run.
//
// The mesh is that of large_mesh.hpp. Before any time is taken, both readers must give the same
// arrays. Repetitions are interleaved and medians compared, for the machine may not be idle.
//
// Developers only: links TetGen (AGPL).
#include <tetgen.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include "barycert/gmsh_files.hpp"
#include "barycert/mesh_files.hpp"
#include "barycert/plc_files.hpp"
#include "barycert/point_files.hpp"
#include "barycert/series.hpp"
#include "barycert/surface_files.hpp"
#include "barycert/table_files.hpp"
#include "barycert/tetgen_files.hpp"
#include "barycert/vtk_files.hpp"
#include "large_mesh.hpp"

namespace {

namespace fs = std::filesystem;

void load(tetgenio& mesh, const std::string& stem) {
    const Silence silence;
    mesh.load_tetmesh(const_cast<char*>(stem.c_str()), static_cast<int>(tetgenbehavior::NODES));
}

bool same_arrays(const std::string& stem) {
    tetgenio theirs;
    load(theirs, stem);
    const barycert::Mesh ours = barycert::read_tetgen(stem).value();
    return ours.points.size() == static_cast<std::size_t>(theirs.numberofpoints) * 3 &&
           ours.cells.size() == static_cast<std::size_t>(theirs.numberoftetrahedra) * 4 &&
           std::equal(ours.points.begin(), ours.points.end(), theirs.pointlist) &&
           std::equal(ours.cells.begin(), ours.cells.end(), theirs.tetrahedronlist);
}

/// The usual table, and the medians kept aside.
class Medians : public benchmark::ConsoleReporter {
public:
    void ReportRuns(const std::vector<Run>& runs) override {
        ConsoleReporter::ReportRuns(runs);
        for (const Run& run : runs) {
            if (run.aggregate_name == "median") medians_[run.run_name.function_name] = run.GetAdjustedRealTime();
        }
    }
    double operator[](const std::string& name) const { return medians_.count(name) != 0 ? medians_.at(name) : 0; }

private:
    std::map<std::string, double> medians_;
};

}  // namespace

int main(int argc, char** argv) {
    std::vector<char*> arguments(argv, argv + argc);
    char interleave[] = "--benchmark_enable_random_interleaving=true";
    arguments.insert(arguments.begin() + 1, interleave);
    int count = static_cast<int>(arguments.size());
    benchmark::Initialize(&count, arguments.data());

    const std::string stem = large_mesh_stem();
    if (!same_arrays(stem)) {
        std::fprintf(stderr, "the two readers disagree on %s\n", stem.c_str());
        return 1;
    }
    const auto bytes = static_cast<std::int64_t>(fs::file_size(stem + ".node") + fs::file_size(stem + ".ele"));
    const auto add = [](const char* name, auto run) {
        benchmark::RegisterBenchmark(name, run)
            ->Unit(benchmark::kMillisecond)
            ->UseRealTime()
            ->Iterations(1)
            ->Repetitions(15)
            ->ReportAggregatesOnly();
    };
    add("load_tetmesh", [&](benchmark::State& state) {
        for (auto _ : state) {
            tetgenio mesh;
            load(mesh, stem);
            benchmark::DoNotOptimize(mesh.tetrahedronlist);
        }
        state.SetBytesProcessed(bytes);
    });
    const auto add_ours = [&](const char* name, int threads) {
        add(name, [&stem, bytes, threads](benchmark::State& state) {
            for (auto _ : state) benchmark::DoNotOptimize(barycert::read_tetgen(stem, {.threads = threads}));
            state.SetBytesProcessed(bytes);
        });
    };
    add_ours("read_tetgen_1_thread", 1);
    add_ours("read_tetgen_2_threads", 2);

    Medians medians;
    benchmark::RunSpecifiedBenchmarks(&medians);
    for (const char* name : {"read_tetgen_1_thread", "read_tetgen_2_threads"}) {
        if (medians[name] > 0) std::printf("load_tetmesh / %s = %.2f\n", name, medians["load_tetmesh"] / medians[name]);
    }
    return 0;
}
