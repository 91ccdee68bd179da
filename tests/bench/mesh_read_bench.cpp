// Reading a large mesh: TetGen's own reader, tetgenio::load_tetmesh, against read_tetgen, in one run.
//
// The mesh is the unit cube in about 2 million cells, made by TetGen in the first run (a minute) and kept in the folder
// BARYCERT_BENCH_DIR, or else the system's temporary folder. Before any time is taken, both readers must give the same
// arrays. Repetitions are interleaved and medians compared, for the machine may not be idle.
//
// Developers only: links TetGen (AGPL).
#include <fcntl.h>
#include <tetgen.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include "barycert/mesh/tetgen_io.hpp"

namespace {

namespace fs = std::filesystem;

/// TetGen prints; while this lives, what goes to stdout is lost.
class Silence {
public:
    Silence() : kept_((std::fflush(stdout), ::dup(STDOUT_FILENO))) {
        const int nowhere = ::open("/dev/null", O_WRONLY);
        ::dup2(nowhere, STDOUT_FILENO);
        ::close(nowhere);
    }
    ~Silence() {
        std::fflush(stdout);
        ::dup2(kept_, STDOUT_FILENO);
        ::close(kept_);
    }
    Silence(const Silence&) = delete;
    Silence& operator=(const Silence&) = delete;

private:
    int kept_;
};

void set_unit_cube(tetgenio& plc) {
    plc.firstnumber = 0;
    plc.numberofpoints = 8;
    plc.pointlist = new REAL[24];
    for (int i = 0; i < 8; ++i) {
        for (int axis = 0; axis < 3; ++axis) plc.pointlist[3 * i + axis] = (i >> axis) & 1;
    }
    constexpr int corners[6][4] = {{0, 1, 3, 2}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 3, 7, 5}};
    plc.numberoffacets = 6;
    plc.facetlist = new tetgenio::facet[6];
    for (int i = 0; i < 6; ++i) {
        tetgenio::facet& facet = plc.facetlist[i];
        tetgenio::init(&facet);
        facet.numberofpolygons = 1;
        facet.polygonlist = new tetgenio::polygon[1];
        tetgenio::init(&facet.polygonlist[0]);
        facet.polygonlist[0].numberofvertices = 4;
        facet.polygonlist[0].vertexlist = new int[4];
        std::copy_n(corners[i], 4, facet.polygonlist[0].vertexlist);
    }
}

/// The stem of the mesh's files, which are there afterwards.
std::string mesh_stem() {
    const char* const named = std::getenv("BARYCERT_BENCH_DIR");
    const fs::path folder = named != nullptr ? fs::path(named) : fs::temp_directory_path();
    fs::create_directories(folder);
    const std::string stem = (folder / "barycert-cube-2m").string();
    if (fs::exists(stem + ".node") && fs::exists(stem + ".ele")) return stem;
    std::fprintf(stderr, "making %s.node and .ele ...\n", stem.c_str());
    const Silence silence;
    tetgenio plc, mesh;
    set_unit_cube(plc);
    char switches[] = "Qpq1.4a1e-6";
    tetrahedralize(switches, &plc, &mesh);
    const std::string unfinished = stem + "-unfinished";  // an interrupted run must not leave half a mesh for the next
    mesh.save_nodes(const_cast<char*>(unfinished.c_str()));
    mesh.save_elements(const_cast<char*>(unfinished.c_str()));
    fs::rename(unfinished + ".node", stem + ".node");
    fs::rename(unfinished + ".ele", stem + ".ele");
    return stem;
}

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

    const std::string stem = mesh_stem();
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
